//! The design sheet: the answer and a dimensioned drawing first, then margins, scenes and all inputs, to print on A4.

use super::page::answered;
use super::text::beside_the_rows;
use super::{CheckAnswer, no_friction, people_table};
use crate::answer::page::{draw_inputs, half};
use crate::answer::{Answer, Provenance};
use crate::design::Design;
use crate::export::Part;
use crate::export::rows::{SurfaceRow, arcs};
use crate::file::names_of_bodies;
use crate::margin::{Margin, SceneDemand};
use crate::material::Material;
use crate::report::{Cell, Page, Plot, Rows, Table, Unit, greek};
use crate::wedge::{PLOTTED, StaticPoint};

/// The page.
pub(super) fn page(check: &CheckAnswer, provenance: &Provenance) -> Page {
    let design = &check.design;
    let answer = check.envelope(provenance.run_time_s);
    let (mut page, remarks) = answered("Design sheet", check, &provenance.command);
    let end_nm = check.state.curve.end_torque_nm();
    curves(&mut page, check);
    sprag(&mut page, design);
    page.heading("Margins");
    let statics = check.rows.get(..check.static_rows).unwrap_or(&check.rows);
    page.table(
        "Margin = allowable / demand − 1 (the page of check says which have another rule); held from 0 up. Reached at: \
         torque at which the limit would be reached; >: not before the curve ends.",
        &people_table(statics, end_nm),
    );
    page.list(remarks.into_iter().chain(beside_the_rows(design, &check.rows)));
    if !check.scenes.is_empty() {
        page.heading("Scenes").table(
            "Friction from which on a scene sticks, against its static friction; smallest normal force over the static one.",
            &scenes(check),
        );
    }
    page.heading("Inputs");
    draw_inputs(&mut page, design, None);
    page.heading("Materials").table("", &materials(design));
    page.heading("Radii to make");
    match &answer.body.running {
        Some(running) => page.table(
            "To make: radii with which the radii as run become those of the design file.",
            &running.table(),
        ),
        None => {
            page.paragraph("Those of the inputs: no fit and no temperature is given, the races run as made.")
        }
    };
    answer.end(&mut page);
    page
}

fn curves(page: &mut Page, check: &CheckAnswer) {
    let design = &check.design;
    let limits = &design.limits;
    let asked = limits.largest_torque_nm();
    let up_to = asked.map_or(f64::INFINITY, |t| 1.5 * t);
    let points: Vec<StaticPoint> =
        check.state.curve.samples(up_to, PLOTTED).into_iter().map(|(p, _)| p).collect();
    let named = [(limits.nominal_torque_nm, "nominal"), (limits.peak_torque_nm, "peak")];
    let named: Vec<(f64, &str)> = named.into_iter().filter_map(|(t, name)| Some((t?, name))).collect();
    let windup = points.iter().map(|p| [Unit::Degree.from_si(p.windup_rad), p.torque_nm]).collect();
    let windup = Plot::new("Windup, deg", "Torque, Nm").curve("", windup);
    let windup = named.iter().fold(windup, |plot, (t, name)| plot.level(*t, name));
    let tangent = points.iter().map(|p| [p.torque_nm, p.tan_omega]).collect();
    let tangent = Plot::new("Torque, Nm", "tan ω, inner contact")
        .curve("", tangent)
        .level(design.clutch.friction.static_, "μs");
    let tangent = named.iter().fold(tangent, |plot, (t, name)| plot.marker(*t, name));
    page.figures(&[
        (half(windup), "Torque over windup."),
        (half(tangent), "Friction that the inner contact must give; grip is lost at μs."),
    ]);
}

/// What the drawing cannot say of the sprag with all digits, as made; nothing where it cannot be placed, which the check says.
fn sprag(page: &mut Page, design: &Design) {
    let Ok(made) = design.made_clutch() else { return };
    let rows = arcs(Part::Sprag, &made.drawn(design));
    let circle = |r: &SurfaceRow, of: &dyn Fn(([f64; 2], f64)) -> f64| r.circle_m.map(of);
    let end = |r: &SurfaceRow, end: usize, axis: usize| r.ends_m.map(|ends| ends[end][axis]);
    let table = Rows::of(&rows)
        .text("surface", "Surface", |r| r.surface.as_str())
        .number("radius_mm", "Radius", Unit::Millimetre, 6, |r| circle(r, &|(_, radius)| radius))
        .number("centre_x_mm", "Centre x", Unit::Millimetre, 5, |r| circle(r, &|(centre, _)| centre[0]))
        .number("centre_y_mm", "Centre y", Unit::Millimetre, 5, |r| circle(r, &|(centre, _)| centre[1]))
        .number("start_x_mm", "From x", Unit::Millimetre, 5, |r| end(r, 0, 0))
        .number("start_y_mm", "From y", Unit::Millimetre, 5, |r| end(r, 0, 1))
        .number("end_x_mm", "To x", Unit::Millimetre, 5, |r| end(r, 1, 0))
        .number("end_y_mm", "To y", Unit::Millimetre, 5, |r| end(r, 1, 1))
        .table();
    page.heading("Sprag to make");
    page.table(
        "Anticlockwise round the body as drawn above: the origin is Cₑ, y points along the centre line to the outer race. A surface \
         without a radius is flat. export writes the same as DXF, STEP or CSV. Not on this sheet, since the design does not hold it: \
         tolerances of form, roughness, hardness and its depth, edges, cage, shape of the spring.",
        &table,
    );
}

fn scenes(check: &CheckAnswer) -> Table {
    let design = &check.design;
    let verdict = |name: &String| {
        // Held with the slip margin that is wanted, which is more than to stick.
        let held = check.rows.iter().filter(|r| r.scene.as_ref() == Some(name)).all(Margin::held);
        match (design.check_scenarios.contains(name), held) {
            (true, held) => Cell::held(held),
            (false, true) => "shown".into(),
            (false, false) => "shown, broken".into(),
        }
    };
    Rows::of(&check.scenes)
        .text("name", "Scene", |(name, _)| name.as_str())
        .number("required_friction", "μ required", Unit::One, 4, |(_, found)| friction(found))
        .number("static_friction", "μs", Unit::One, 4, |(_, found)| found.static_friction)
        // Where no friction suffices there is none, as the column before says.
        .number("slip_margin", "Slip margin", Unit::Percent, 3, |(_, found)| found.slip_margin())
        .number("contact_margin", "Contact margin", Unit::Percent, 3, |(_, found)| found.contact_margin())
        .text("verdict", "Verdict", |(name, _)| verdict(name))
        .table()
}

/// Friction that the scene needs, or why there is none.
fn friction(found: &SceneDemand) -> Cell {
    match &found.demand {
        Ok(d) if d.finished => d.required_friction.map_or(no_friction(found.is_to_let_go).into(), Cell::Si),
        Ok(d) => if d.overloaded { "overloaded" } else { "not computed" }.into(),
        Err(why) => greek(&why.to_string()).into(),
    }
}

fn materials(design: &Design) -> Table {
    let m = &design.clutch.materials;
    let bodies: [(String, &Material); 3] = [
        (format!("{} sprags", design.clutch.sprags.count), &m.sprag),
        ("inner race".into(), &m.inner_race),
        ("outer race".into(), &m.outer_race),
    ];
    let named = names_of_bodies(&design.source).into_iter().zip(design.clutch.masses_kg());
    Rows::of(bodies.into_iter().zip(named))
        .text("body", "Body", |((body, _), _)| body.clone())
        .text("material", "Material", |(_, (named, _))| {
            named.clone().unwrap_or_else(|| "by its numbers".into())
        })
        .number("youngs_modulus_gpa", "E", Unit::Gigapascal, 4, |((_, m), _)| m.youngs_modulus_pa)
        .number("poisson_ratio", "Poisson ratio", Unit::One, 3, |((_, m), _)| m.poisson_ratio)
        .number("density_kg_m3", "Density, kg/m³", Unit::One, 5, |((_, m), _)| m.density_kg_m3)
        .number("mass_g", "Mass", Unit::Gram, 4, |(_, (_, mass_kg))| *mass_kg)
        .table()
}
