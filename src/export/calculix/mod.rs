//! One sector of a clutch as a complete CalculiX deck, and the result as rows of `stiffness`.
//!
//! In: a clutch, its placed profile and outline, [`Options`]; later the text of `ccx`'s `.dat`. Out: the deck;
//! [`ResultRow`]s. Absent: files and running `ccx`, stress fields, centrifugal growth (the deck is at rest).
//! Equations: none of the paper's. What the deck does and why it does so:
//!
//! - One sector of 360/n_s degrees; u_slave = R(2 pi/n_s) u_master on the cut faces is linear and exact at any
//!   rotation, so plain equations serve where `*CYCLIC SYMMETRY MODEL` and contact do not go together.
//! - The bore turns back and the rim forward, each by half the windup, both free to grow where the design does not hold them. Every node of a
//!   driven circle may move along the tangent at a quarter of the windup ahead and perpendicular to it: linear, one
//!   unknown per circle, and off by no more than that quarter, which leans the shear on the ring by
//!   tan(omega) W/4 of the pressure (0.06 % at 1.7 degrees).
//! - Sprag and races begin with a small overlap, rolled into engagement as rigid bodies by the windup
//!   W_0 = 2 delta/(tan(omega_0) R_i), the energy balance of two overlaps delta. Step 1 is one increment:
//!   within step 1 CalculiX takes penetration for initial overlap and ramps it out.
//! - Increments are fixed. Left to itself CalculiX (2.20) repeats an increment that diverged with the contact state
//!   of the failed attempt, converges, and is wrong without a word (tangential force 10 % off); fixed, it stops. They
//!   are fixed by equal smallest and largest sizes and no second attempt, not by `DIRECT`, under which CalculiX knows
//!   no limit of iterations for face-to-face contact.
//! - Chords follow their arcs in the mean, so the overlap is not changed by the mesh.
//! - Where the material is confined along the axis is the variant: [`Variant`].

mod facts;
mod mesh;
mod read;
mod spacing;
mod write;

pub use facts::Facts;
pub use read::{NoRows, Reading, ResultRow, at_torque, read};

use crate::clutch::{Clutch, InnerArc};
use crate::design::Design;
use crate::profile::{Outline, OutlineError, Profile, ProfileError};
use crate::wedge::{EndReason, StaticPoint, WedgeCurve};
use mesh::{Block, Grid, Section, Sector, axial};

/// Where the material is held along the axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Variant {
    /// No strain along the axis anywhere; races as long as the sprag.
    PlaneStrain,
    /// No stress along the axis: a layer 10 um thin, free to thicken; races as long as the sprag.
    PlaneStress,
    /// One layer from the middle of the sprag to its end, plane in the middle, free at the end: the contacts
    /// near plane strain, the rings near plane stress; races as long as the sprag.
    Layer,
    /// Several layers from the middle of the length, races as wide as designed: edges of the sprag included.
    Solid {
        /// Layers along half the sprag's length, 1 to 12.
        layers: usize,
    },
}

/// Layers along half a sprag's length in a solid deck, where nobody says another number.
pub const SOLID_LAYERS: usize = 4;

impl Variant {
    /// All of them.
    pub const ALL: [Self; 4] =
        [Self::PlaneStrain, Self::PlaneStress, Self::Layer, Self::Solid { layers: SOLID_LAYERS }];

    /// Name, as flags and decks have it.
    pub fn name(self) -> &'static str {
        match self {
            Self::PlaneStrain => "plane-strain",
            Self::PlaneStress => "plane-stress",
            Self::Layer => "layer",
            Self::Solid { .. } => "solid",
        }
    }
}

/// What the deck shall be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// Variant.
    pub variant: Variant,
    /// Spacing of the nodes at the contacts, m.
    pub mesh_m: f64,
    /// Torque to be reached, N m: the deck turns to the windup that the design's contact law needs for it.
    pub torque_nm: f64,
    /// Friction of the deck: high enough to stick; the design's own is not used.
    pub friction: f64,
    /// Contact pressure per overlap, in Young's moduli per mesh width: a contact much stiffer than its elements makes
    /// the patch's edge alternate between two states for ever (50 on a soft shaft, 25 in a thin ring), one much softer
    /// adds its own give.
    pub penalty_per_width: f64,
    /// Increments of the turning step, 4 to 1000; none: 12, or as many as keep the contacts' way per increment
    /// within 1.2 mesh widths (2 widths do not always converge).
    pub increments: Option<usize>,
}

impl Default for Options {
    /// Friction 0.3, penalty 10 E per mesh width (0.15 % of windup at 50 um from 1 GPa on, in proportion to the mesh), a layer meshed at 25 um; torque 0:
    /// give one.
    fn default() -> Self {
        Self {
            variant: Variant::Layer,
            mesh_m: 25e-6,
            torque_nm: 0.0,
            friction: 0.3,
            penalty_per_width: 10.0,
            increments: None,
        }
    }
}

/// Why there is no deck.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoDeck {
    /// An option is not a positive finite number, or out of its range.
    #[error("{name}: {allowed}")]
    Option {
        /// Name.
        name: &'static str,
        /// What is allowed.
        allowed: &'static str,
    },
    /// The curve of the design's own contact law ends below the torque.
    #[error("the curve ends ({}) at {end_nm:.4} Nm, below the {asked_nm} Nm asked", .reason.name())]
    BeyondCurve {
        /// Torque at its end, N m.
        end_nm: f64,
        /// Torque asked for, N m.
        asked_nm: f64,
        /// Why it ends there.
        reason: EndReason,
    },
    /// A contact travels beyond a flank or the sector, or so near that no mesh fits.
    #[error("{place} for a mesh at this torque{}",
        .most_nm.map_or_else(String::new, |most| format!("; the largest torque with one is {most} Nm")))]
    NoRoom {
        /// Which contact is too near to what.
        place: &'static str,
        /// The largest torque at which one fits, N m, to three digits; nothing where none is known.
        most_nm: Option<f64>,
    },
    /// The mesh would have more nodes than allowed.
    #[error("the mesh would have {nodes} nodes, {most} at most")]
    TooFine {
        /// Nodes it would have.
        nodes: usize,
        /// Nodes allowed.
        most: usize,
    },
    /// A race is narrower than the sprag is long; a solid deck wants it at least as wide.
    #[error("a solid deck needs races at least as wide as the sprag is long")]
    NarrowRace,
    /// The design has no wedge curve.
    #[error("no wedge curve: {0}")]
    NoCurve(String),
    /// No torque is given, and the design names no nominal one.
    #[error("torque: the design names no nominal torque")]
    NoTorque,
    /// The profile cannot be placed.
    #[error("the profile cannot be placed: {0}")]
    Profile(ProfileError),
    /// The outline does not close.
    #[error("the outline does not close: {0}")]
    Outline(OutlineError),
}

/// Nodes at most: beyond, `ccx` needs hours and tens of gigabytes.
const MOST_NODES: usize = 2_000_000;
/// Overlap at either contact at the start, mm: presses a sprag of steel with some 5 N per mm of length.
const OVERLAP_MM: f64 = 4e-4;
/// Windup of the deck over that of the law: laws stiffer than the material would stop short of the torque.
const BEYOND: f64 = 1.03;
/// Half thickness of the plane-stress layer, mm: a tenth of a contact's width.
const THIN_MM: f64 = 5e-3;
/// A solid shaft is given a hole of this share of its radius: Lame's growth changes by 0.05 %.
const PINHOLE: f64 = 0.015;

/// Everything the writer needs, mm.
struct Model {
    inner: Block,
    sprag: Block,
    outer: Block,
    facts: Facts,
    /// Windup that the deck turns to, beyond the start, rad.
    turn_rad: f64,
    sector_rad: f64,
    increments: usize,
    /// Rows of the driven circles in the inner and the outer block.
    driven: (usize, usize),
}

impl Design {
    /// The deck, ready for `ccx`, up to `torque_nm`, N m, or the nominal torque, whatever torque `options` have; without flanks the
    /// narrowest sprag.
    ///
    /// # Errors
    /// [`NoDeck`].
    pub fn deck(&self, torque_nm: Option<f64>, options: &Options) -> Result<String, NoDeck> {
        let torque_nm = torque_nm.or(self.limits.nominal_torque_nm).ok_or(NoDeck::NoTorque)?;
        let profile = self.clutch.profile().map_err(NoDeck::Profile)?;
        let outline = match self.clutch.sprags.flanks {
            Some(flanks) => Outline::closed(&profile, &flanks),
            None => Outline::narrowest(&profile),
        };
        let options = Options { torque_nm, ..*options };
        deck(&self.clutch, &profile, &outline.map_err(NoDeck::Outline)?, &options, &self.hash)
    }
}

/// The deck, ready for `ccx`. `hash` names the design in its head, so that [`read`] can refuse another's.
///
/// # Errors
/// [`NoDeck`].
pub fn deck(
    clutch: &Clutch,
    profile: &Profile,
    outline: &Outline,
    options: &Options,
    hash: &str,
) -> Result<String, NoDeck> {
    Ok(write::deck(&model(clutch, profile, outline, options, hash)?, clutch, options))
}

fn check(options: &Options) -> Result<(), NoDeck> {
    for (name, value) in [
        ("mesh", options.mesh_m),
        ("torque", options.torque_nm),
        ("friction", options.friction),
        ("penalty", options.penalty_per_width),
    ] {
        if !(value > 0.0 && value.is_finite()) {
            return Err(NoDeck::Option { name, allowed: "a finite number above zero is needed" });
        }
    }
    if options.increments.is_some_and(|n| !(4..=1000).contains(&n)) {
        return Err(NoDeck::Option { name: "increments", allowed: "4 to 1000" });
    }
    if let Variant::Solid { layers } = options.variant
        && !(1..=12).contains(&layers)
    {
        return Err(NoDeck::Option { name: "layers", allowed: "1 to 12" });
    }
    Ok(())
}

/// How far the contacts travel up to a torque, and the grid for it.
struct Plan {
    last: StaticPoint,
    grid: Grid,
    /// Way of the contacts, mm: of the farther one, with a reserve.
    travel: f64,
    /// Which patch does not end within fine columns, and what is in its way; `None`: both do.
    tight: Option<&'static str>,
}

/// What a contact can be too near to: inner or outer contact, its rear or its front side, the flank or the cut face of the sector.
const PLACES: [[[&str; 2]; 2]; 2] = [
    [
        [
            "the inner contact is too near to the rear flank",
            "the inner contact is too near to the sprag behind",
        ],
        [
            "the inner contact travels too near to the front flank",
            "the inner contact travels too near to the next sprag",
        ],
    ],
    [
        [
            "the outer contact travels too near to the rear flank",
            "the outer contact travels too near to the sprag behind",
        ],
        [
            "the outer contact is too near to the front flank",
            "the outer contact is too near to the next sprag",
        ],
    ],
];

/// Nothing beyond the end of the curve.
fn plan(clutch: &Clutch, curve: &WedgeCurve, section: &Section, mesh_m: f64, torque_nm: f64) -> Option<Plan> {
    let (s, r) = (&clutch.sprags, &clutch.races);
    let last = curve.at_torque(torque_nm)?;
    let (_, state) = curve.closure_at_torque(torque_nm)?;
    let inner_radius = s.inner_arcs.iter().map(|a: &InnerArc| a.radius_m).fold(0.0, f64::max);
    // The outer contact travels by the body's rotation, a little more than the inner one's turn.
    let travel = 1.05e3 * inner_radius.max(s.outer_radius_m) * last.contact_turn_rad;
    let margin = 1.5e3 * last.half_width_inner_m + 3e3 * mesh_m;
    // Half of what a race has between two sprags.
    let pitch = 1e3 * std::f64::consts::PI / s.count as f64;
    let halves = [pitch * r.inner_radius_m, pitch * r.outer_radius_m];
    let flanks = section.flanks_mm();
    let room = [0, 1].map(|i| (flanks[i].0.max(-halves[i]), flanks[i].1.min(halves[i])));
    let grid = Grid::new(1e3 * mesh_m, travel, margin, room);
    // The deck turns a shade beyond the law's windup.
    let [inner, outer] = [inner_radius * last.contact_turn_rad, s.outer_radius_m * state.rotation.v]
        .map(|way_m| BEYOND * 1e3 * way_m);
    // Hertz: the half width goes with the root of the relative radius.
    let wider = ((1.0 / r.inner_radius_m + 1.0 / inner_radius)
        / (1.0 / s.outer_radius_m - 1.0 / r.outer_radius_m))
        .sqrt()
        .max(1.0);
    let half = 1e3 * last.half_width_inner_m * wider + grid.step;
    let cut = |i: usize, front: bool| {
        let (flank, half) = (if front { flanks[i].1 } else { -flanks[i].0 }, halves[i]);
        PLACES[i][usize::from(front)][usize::from(flank > half)]
    };
    let tight = [
        (inner + half > grid.fine(true).1, cut(0, true)),
        (outer + half > -grid.fine(false).0, cut(1, false)),
        (half > -grid.fine(true).0, cut(0, false)),
        (half > grid.fine(false).1, cut(1, true)),
    ];
    let tight = tight.into_iter().find_map(|(is_tight, place)| is_tight.then_some(place));
    Some(Plan { last, grid, travel, tight })
}

/// The largest torque up to `end_nm` for which `fits`, rounded down to three digits; nothing where there is none.
fn largest(end_nm: f64, fits: impl Fn(f64) -> bool) -> Option<f64> {
    let (mut low, mut high) = (0.0, end_nm);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if fits(middle) { low = middle } else { high = middle }
    }
    if low == 0.0 {
        return None;
    }
    let digit = 10f64.powi(low.log10().floor() as i32 - 2);
    let most = crate::numeric::rounded((low / digit).floor() * digit, 3);
    fits(most).then_some(most)
}

fn model(
    clutch: &Clutch,
    profile: &Profile,
    outline: &Outline,
    options: &Options,
    hash: &str,
) -> Result<Model, NoDeck> {
    check(options)?;
    let (s, r) = (&clutch.sprags, &clutch.races);
    let curve = WedgeCurve::build(clutch, profile, 0.0).map_err(|e| NoDeck::NoCurve(format!("{e:?}")))?;
    let no_room = NoDeck::NoRoom { place: "the strut leaves the sprag's flanks no room", most_nm: None };
    let (Some(first), foot_direction) = (profile.arcs.first(), profile.contact_direction(0.0)) else {
        return Err(no_room);
    };
    let foot = first.centre_m + first.radius_m * foot_direction;
    let up = (nalgebra::Vector2::new(0.0, s.outer_radius_m) - foot).normalize();
    let Some(section) = Section::new(outline.segments(), [foot.x, foot.y], [up.x, up.y]) else {
        return Err(no_room);
    };
    let end_nm = curve.end_torque_nm();
    let planned = plan(clutch, &curve, &section, options.mesh_m, options.torque_nm);
    let beyond = NoDeck::BeyondCurve { end_nm, asked_nm: options.torque_nm, reason: curve.end().0 };
    let Plan { last, grid, travel, tight } = planned.ok_or(beyond)?;
    // The even stretches alone, four of them, before anything is built.
    let even = 4usize.saturating_mul(grid.fine_count).saturating_mul(grid.even_rows());
    if even > MOST_NODES {
        return Err(NoDeck::TooFine { nodes: even, most: MOST_NODES });
    }

    let (half, layers, beyond) = match options.variant {
        Variant::PlaneStrain | Variant::Layer => (500.0 * s.length_m, 1, 0.0),
        Variant::PlaneStress => (THIN_MM, 1, 0.0),
        Variant::Solid { layers } => (500.0 * s.length_m, layers, 500.0 * (r.width_m - s.length_m)),
    };
    if beyond < -1e-9 {
        return Err(NoDeck::NarrowRace);
    }
    let beyond = if beyond > 1e-6 { beyond } else { 0.0 };
    let race_zs = axial(half, layers, beyond);

    let [r_i, r_e, r_ed] = [r.inner_radius_m, r.outer_radius_m, r.outer_outside_radius_m].map(|v| 1e3 * v);
    let bore = 1e3 * r.inner_bore_radius_m;
    let shaft = bore < PINHOLE * r_i;
    let bore = if shaft { PINHOLE * r_i } else { bore };
    let sector_rad = std::f64::consts::TAU / s.count as f64;

    if let Some(place) = tight {
        let most_nm = largest(end_nm, |torque_nm| {
            plan(clutch, &curve, &section, options.mesh_m, torque_nm).is_some_and(|p| p.tight.is_none())
        });
        return Err(NoDeck::NoRoom { place, most_nm });
    }

    // The sprag rolled as a rigid body by the overlap: triangle (9) with OC_i shorter and OC_e longer.
    let oc_i = r_i + 1e3 * first.radius_m - OVERLAP_MM;
    let oc_e = r_e - 1e3 * s.outer_radius_m + OVERLAP_MM;
    let e_1 = 1e3 * first.centre_m.norm();
    let beta = ((oc_i * oc_i + oc_e * oc_e - e_1 * e_1) / (2.0 * oc_i * oc_e)).acos();
    let rotation =
        (oc_i * beta.sin()).atan2(oc_i * beta.cos() - oc_e) - first.centre_m.x.atan2(first.centre_m.y);
    let start_rad = 2.0 * OVERLAP_MM / (curve.touch().t_ratio * r_i);

    if beta.is_nan() {
        return Err(no_room);
    }

    let ring = |middle, track, far| Sector { middle, half_angle: 0.5 * sector_rad, track, far };
    let mut inner = ring(beta, r_i, bore).block(&grid, race_zs.clone());
    let mut outer = ring(0.0, r_e, r_ed).block(&grid, race_zs);
    let mut sprag = section.block(&grid, axial(half, layers, 0.0));
    let (sin, cos) = rotation.sin_cos();
    for p in &mut sprag.points {
        // Strut -> body frame -> global: rotated towards positive azimuth (clockwise), raised by OC_e.
        let x = 1e3 * foot.x + p[0] * up.y + p[1] * up.x;
        let y = 1e3 * foot.y - p[0] * up.x + p[1] * up.y;
        *p = [x * cos + y * sin, -x * sin + y * cos + oc_e];
    }
    for block in [&inner, &sprag, &outer] {
        let least = block.least_corner_mm2();
        if least.is_nan() || least <= 0.0 {
            return Err(no_room);
        }
    }
    let nodes = inner.nodes() + sprag.nodes() + outer.nodes();
    if nodes > MOST_NODES {
        return Err(NoDeck::TooFine { nodes, most: MOST_NODES });
    }
    sprag.first_node = 1 + inner.nodes();
    sprag.first_element = 1 + inner.elements();
    outer.first_node = sprag.first_node + sprag.nodes();
    outer.first_element = sprag.first_element + sprag.elements();
    inner.first_node = 1;

    // A shaft is driven at half its radius: the pinhole would wind up by itself.
    let driven_row = if shaft {
        (0..inner.size.1)
            .min_by(|a, b| {
                let off = |j: &usize| (inner.point(0, *j)[0].hypot(inner.point(0, *j)[1]) - 0.5 * r_i).abs();
                off(a).total_cmp(&off(b))
            })
            .unwrap_or(0)
    } else {
        0
    };
    let driven = (driven_row, outer.size.1 - 1);
    let radius = |block: &Block, j: usize| {
        let p = block.point(0, j);
        p[0].hypot(p[1])
    };
    let turn_rad = BEYOND * last.windup_rad - start_rad;
    let increments =
        options.increments.unwrap_or_else(|| ((travel / (1.2 * grid.step)).ceil() as usize).clamp(12, 1000));
    let facts = Facts {
        hash: hash.to_owned(),
        variant: options.variant.name().to_owned(),
        mesh_mm: grid.step,
        count: s.count,
        axial_factor: 1e3 * s.length_m / half,
        length_mm: 1e3 * s.length_m,
        start_rad,
        driven_mm: [radius(&inner, driven.0), radius(&outer, driven.1)],
        ahead_rad: [-0.25 * turn_rad, 0.25 * turn_rad],
        track_mm: [r_i, r_e],
    };
    Ok(Model { inner, sprag, outer, facts, turn_rad, sector_rad, increments, driven })
}

#[cfg(test)]
mod tests;
