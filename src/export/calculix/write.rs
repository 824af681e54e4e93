//! The deck as text, in mm, N, MPa.

use super::mesh::Block;
use super::{Model, Options, Variant};
use crate::clutch::{Clutch, Rim};
use crate::material::Material;
use std::fmt::Write;

/// Columns of elements beyond the fine stretch that may still touch.
const SPARE_COLUMNS: usize = 4;
/// Weak springs that hold the sprag before it touches, N/mm each over the whole length: below 1 N in all.
const SOFT_N_PER_MM: f64 = 0.1;

/// Points of the course by which a held circle is led along its arc: 15 nm off at a windup of 5 degrees and 26 mm.
const ARC_POINTS: usize = 20;

/// Iterations of an increment after which `ccx` ends with a message; those that converge need a dozen.
const MOST_ITERATIONS: usize = 40;

/// Which face of an element carries a contact.
#[derive(Clone, Copy)]
enum Face {
    Low,
    High,
}

pub(super) fn deck(m: &Model, clutch: &Clutch, options: &Options) -> String {
    let mut out = String::new();
    let _ = write_deck(&mut out, m, clutch, options);
    out
}

fn write_deck(out: &mut String, m: &Model, clutch: &Clutch, options: &Options) -> std::fmt::Result {
    let f = &m.facts;
    writeln!(out, "** One sector of a sprag clutch: inner race, sprag, outer race. mm, N, MPa.")?;
    writeln!(out, "** Run: ccx -i NAME; read: sprag-design export FILE --format calculix --read NAME.dat")?;
    out.push_str(&f.to_lines());

    let blocks = [("INNER", &m.inner), ("SPRAG", &m.sprag), ("OUTER", &m.outer)];
    for (name, block) in blocks {
        writeln!(out, "*NODE, NSET=N{name}")?;
        for (k, z) in block.zs.iter().enumerate() {
            for j in 0..block.size.1 {
                for i in 0..block.size.0 {
                    let p = block.point(i, j);
                    writeln!(out, "{},{:.12e},{:.12e},{:.9e}", block.node(i, j, k), p[0], p[1], z)?;
                }
            }
        }
    }
    let control = m.outer.first_node + m.outer.nodes();
    writeln!(out, "** Their first component is the driven displacement of the inner and the outer circle.")?;
    writeln!(out, "*NODE, NSET=NCONTROL\n{control},0.,0.,0.\n{},0.,0.,0.", control + 1)?;

    for (name, block) in blocks {
        writeln!(out, "*ELEMENT, TYPE=C3D8I, ELSET=E{name}")?;
        for k in 0..block.zs.len() - 1 {
            for j in 0..block.size.1 - 1 {
                for i in 0..block.size.0 - 1 {
                    write!(out, "{}", block.element(i, j, k))?;
                    for n in block.corners(i, j, k) {
                        write!(out, ",{n}")?;
                    }
                    out.push('\n');
                }
            }
        }
    }
    let mats = &clutch.materials;
    for (name, material) in [("INNER", mats.inner_race), ("SPRAG", mats.sprag), ("OUTER", mats.outer_race)] {
        let Material { youngs_modulus_pa, poisson_ratio, .. } = material;
        writeln!(out, "*MATERIAL, NAME=M{name}\n*ELASTIC\n{:e},{poisson_ratio}", youngs_modulus_pa * 1e-6)?;
        writeln!(out, "*SOLID SECTION, ELSET=E{name}, MATERIAL=M{name}")?;
    }

    let touching = m.sprag.zs.len();
    let race_layers = if m.inner.zs.len() > touching { touching } else { touching - 1 };
    surface(out, "SSPRAGIN", &m.sprag, Face::Low, touching - 1)?;
    surface(out, "SSPRAGOUT", &m.sprag, Face::High, touching - 1)?;
    surface(out, "SINNER", &m.inner, Face::High, race_layers)?;
    surface(out, "SOUTER", &m.outer, Face::Low, race_layers)?;

    writeln!(out, "** Track of the inner race: its stresses give the contact pressure.")?;
    writeln!(out, "*ELSET, ELSET=ETOUCH")?;
    for k in 0..touching - 1 {
        for i in m.inner.fine.0..m.inner.fine.1 {
            writeln!(out, "{}", m.inner.element(i, m.inner.size.1 - 2, k))?;
        }
    }

    springs(out, m)?;

    let hardest = [mats.inner_race, mats.sprag, mats.outer_race]
        .iter()
        .map(|a| a.youngs_modulus_pa)
        .fold(0.0, f64::max);
    // Pa/m -> MPa/mm: 1e-6 * 1e-3.
    let slope = 1e-9 * hardest * options.penalty_per_width / options.mesh_m;
    writeln!(out, "*SURFACE INTERACTION, NAME=TOUCH")?;
    writeln!(out, "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{slope:e}")?;
    writeln!(out, "*FRICTION\n{},{:e}", options.friction, 0.1 * slope)?;
    writeln!(out, "*CONTACT PAIR, INTERACTION=TOUCH, TYPE=SURFACE TO SURFACE\nSSPRAGIN,SINNER")?;
    writeln!(out, "*CONTACT PAIR, INTERACTION=TOUCH, TYPE=SURFACE TO SURFACE\nSSPRAGOUT,SOUTER")?;

    let rims = [clutch.races.inner_rim, clutch.races.outer_rim];
    let plane_strain = options.variant == Variant::PlaneStrain;
    if m.sprag.zs.len() == 2 {
        writeln!(out, "** One layer: its two faces move alike in the plane.\n*EQUATION")?;
        for (_, block) in blocks {
            for low in block.first_node..block.first_node + block.points.len() {
                let high = low + block.points.len();
                writeln!(out, "2\n{high},1,1.,{low},1,-1.\n2\n{high},2,1.,{low},2,-1.")?;
            }
        }
    }
    for (block, row, node, ahead, rim) in [
        (&m.inner, m.driven.0, control, f.ahead_rad[0], rims[0]),
        (&m.outer, m.driven.1, control + 1, f.ahead_rad[1], rims[1]),
    ] {
        cyclic(out, block, m.sector_rad, plane_strain)?;
        driven(out, block, row, node, ahead, rim)?;
    }

    writeln!(out, "** Held along the axis: everywhere in plane strain, else at the middle of the length.")?;
    writeln!(out, "*BOUNDARY")?;
    if plane_strain {
        writeln!(out, "NINNER,3,3\nNSPRAG,3,3\nNOUTER,3,3")?;
    } else {
        for (_, block) in blocks {
            let last = block.node(block.size.0 - 1, block.size.1 - 1, 0);
            for node in block.first_node..=last {
                writeln!(out, "{node},3,3")?;
            }
        }
    }
    let shift = |radius: f64, angle: f64, ahead: f64| radius * ((angle - ahead).sin() + ahead.sin());
    let ends = [
        shift(f.driven_mm[0], -0.5 * m.turn_rad, f.ahead_rad[0]),
        shift(f.driven_mm[1], 0.5 * m.turn_rad, f.ahead_rad[1]),
    ];
    for side in [0, 1] {
        if rims[side] == Rim::Held {
            arc(out, side, control + side, f.driven_mm[side], f.ahead_rad[side], ends[side])?;
        }
    }
    writeln!(out, "** Step 1: the overlap takes hold, in one increment.")?;
    step(out, 1, control, [0.0, 0.0], [Rim::Free; 2])?;
    writeln!(out, "** Step 2: bore and rim turn, each by half.")?;
    step(out, m.increments, control, ends, rims)
}

/// The second component of a held circle's control as a course in the time of step 2: the circle leaves its tangent by its arc.
fn arc(out: &mut String, side: usize, control: usize, radius: f64, ahead: f64, end: f64) -> std::fmt::Result {
    writeln!(out, "** A held circle keeps its radius while it turns.")?;
    writeln!(out, "*BOUNDARY\n{control},2,2\n*AMPLITUDE, NAME=ARC{side}")?;
    for k in 0..=ARC_POINTS {
        let time = k as f64 / ARC_POINTS as f64;
        let sine = time * end / radius - ahead.sin();
        writeln!(out, "{time},{:.12e}", radius * ((1.0 - sine * sine).sqrt() - ahead.cos()))?;
    }
    Ok(())
}

/// `rims`: which circles are led along their arc.
fn step(
    out: &mut String,
    increments: usize,
    control: usize,
    shift: [f64; 2],
    rims: [Rim; 2],
) -> std::fmt::Result {
    let first = 1.0 / increments as f64;
    writeln!(out, "*STEP, NLGEOM, INC=2000")?;
    // Fixed increments, as by DIRECT, which would let face-to-face contact iterate for ever: no increment is smaller or
    // larger, none is attempted again.
    writeln!(out, "*STATIC\n{first:.15e},1.,{first:.15e},{first:.15e}")?;
    writeln!(out, "*CONTROLS, PARAMETERS=TIME INCREMENTATION\n4,8,9,16,10,4,,0")?;
    writeln!(out, "*CONTROLS, PARAMETERS=CONTACT\n0.001,0.1,100,{MOST_ITERATIONS}")?;
    writeln!(out, "*BOUNDARY\n{control},1,1,{:.12e}\n{},1,1,{:.12e}", shift[0], control + 1, shift[1])?;
    for side in [0, 1] {
        if rims[side] == Rim::Held {
            writeln!(out, "*BOUNDARY, AMPLITUDE=ARC{side}\n{},2,2,1.", control + side)?;
        }
    }
    writeln!(out, "*NODE PRINT, NSET=NCONTROL\nU,RF")?;
    writeln!(out, "*CONTACT PRINT, SLAVE=SSPRAGIN, MASTER=SINNER\nCF")?;
    writeln!(out, "*CONTACT PRINT, SLAVE=SSPRAGOUT, MASTER=SOUTER\nCF")?;
    writeln!(out, "*EL PRINT, ELSET=ETOUCH\nS\n*END STEP")
}

fn surface(out: &mut String, name: &str, block: &Block, face: Face, layers: usize) -> std::fmt::Result {
    writeln!(out, "*SURFACE, NAME={name}, TYPE=ELEMENT")?;
    let (j, label) = match face {
        Face::Low => (0, "S3"),
        Face::High => (block.size.1 - 2, "S5"),
    };
    let from = block.fine.0.saturating_sub(SPARE_COLUMNS);
    let until = (block.fine.1 + SPARE_COLUMNS).min(block.size.0 - 1);
    for k in 0..layers {
        for i in from..until {
            writeln!(out, "{},{label}", block.element(i, j, k))?;
        }
    }
    Ok(())
}

/// The constant needs its decimal point: CalculiX takes a line without one for degrees of freedom.
///
/// Springs from the ground to the middle of either flank, in the plane.
fn springs(out: &mut String, m: &Model) -> std::fmt::Result {
    let (i, j) = (m.sprag.size.0 - 1, m.sprag.size.1 / 2);
    let mut element = m.outer.first_element + m.outer.elements();
    for dof in [1, 2] {
        writeln!(out, "*ELEMENT, TYPE=SPRING1, ELSET=ESOFT{dof}")?;
        for node in [m.sprag.node(0, j, 0), m.sprag.node(i, j, 0)] {
            writeln!(out, "{element},{node}")?;
            element += 1;
        }
        writeln!(out, "*SPRING, ELSET=ESOFT{dof}\n{dof}\n{:.9}", SOFT_N_PER_MM / m.facts.axial_factor)?;
    }
    Ok(())
}

/// u_slave = R u_master between the two cut faces; R turns towards positive azimuth.
fn cyclic(out: &mut String, block: &Block, sector_rad: f64, plane_strain: bool) -> std::fmt::Result {
    let (s, c) = sector_rad.sin_cos();
    writeln!(out, "*EQUATION")?;
    let tied = block.zs.len() == 2;
    for k in 0..block.zs.len() {
        for j in 0..block.size.1 {
            let (master, slave) = (block.node(0, j, k), block.node(block.size.0 - 1, j, k));
            if !plane_strain && k > 0 {
                writeln!(out, "2\n{slave},3,1.,{master},3,-1.")?;
            }
            if tied && k > 0 {
                continue;
            }
            writeln!(out, "3\n{slave},1,1.,{master},1,{:.12},{master},2,{:.12}", -c, -s)?;
            writeln!(out, "3\n{slave},2,1.,{master},1,{s:.12},{master},2,{:.12}", -c)?;
        }
    }
    Ok(())
}

/// Every node of row `j` moves by the control's component along its tangent, turned ahead, and freely across that; where the
/// circle is held, across it by the control's second component.
fn driven(
    out: &mut String,
    block: &Block,
    j: usize,
    control: usize,
    ahead: f64,
    rim: Rim,
) -> std::fmt::Result {
    writeln!(out, "*EQUATION")?;
    let planes = if block.zs.len() == 2 { 1 } else { block.zs.len() };
    for k in 0..planes {
        for i in 0..block.size.0 - 1 {
            let p = block.point(i, j);
            let azimuth = p[0].atan2(p[1]) + ahead;
            let (x, y) = (azimuth.cos(), -azimuth.sin());
            let node = block.node(i, j, k);
            if rim == Rim::Held {
                writeln!(out, "3\n{node},1,-1.,{control},1,{x:.12},{control},2,{:.12}", -y)?;
                writeln!(out, "3\n{node},2,-1.,{control},1,{y:.12},{control},2,{x:.12}")?;
                continue;
            }
            // The dependent term comes first; the larger one, lest it vanish.
            let terms = if x.abs() > y.abs() { [(1, x), (2, y)] } else { [(2, y), (1, x)] };
            writeln!(
                out,
                "3\n{node},{},{:.12},{node},{},{:.12},{control},1,-1.",
                terms[0].0, terms[0].1, terms[1].0, terms[1].1
            )?;
        }
    }
    Ok(())
}
