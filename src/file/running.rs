//! Fits and temperatures of a file, and why a clutch would not run with them.
//!
//! In: `[races.press_fit]`, `[thermal]`, races and sprags as made. Out: races and sprags as run, [`Running`], SI. Absent:
//! what a fit does ([`Fits::run`]). Equations: none.

use super::design_file::DesignFile;
use super::findings::Findings;
use super::geometry::mm;
use super::steels;
use crate::clutch::{Fits, Joint, Materials, NotRunning, Races, Rim, Running, Sprags};
use crate::design::m;

/// Keys that change a radius, for refusals of what they lead to.
const KEYS: [&str; 3] = ["thermal", "races.press_fit", "races"];

/// Refuse a rim that is held where there is none, or where a fit says what yields beyond it.
fn rims(file: &DesignFile, out: &mut Findings) {
    let races = &file.races;
    let fit = races.press_fit.as_ref();
    if races.inner_rim == Rim::Held && races.inner_bore_radius_mm == 0.0 {
        out.refuse(
            &["races.inner_rim", "races.inner_bore_radius_mm"],
            "\"free\": a solid inner race has no bore to be held".to_owned(),
            "remove inner_rim, or give the bore".to_owned(),
        );
    }
    for (held, fitted, rim, key, partner) in [
        (
            races.inner_rim,
            fit.is_some_and(|f| f.inner_interference_um.is_some()),
            "races.inner_rim",
            "races.press_fit.inner_interference_um",
            "shaft",
        ),
        (
            races.outer_rim,
            fit.is_some_and(|f| f.outer_interference_um.is_some()),
            "races.outer_rim",
            "races.press_fit.outer_interference_um",
            "housing",
        ),
    ] {
        if held == Rim::Held && fitted {
            out.refuse(
                &[rim, key],
                format!("\"free\" together with {key}: the {partner} of the fit yields by its own radius and steel"),
                format!("remove {rim}, or the fit where the {partner} does not yield"),
            );
        }
    }
}

/// Races and sprags as run, and how; as made where the file names neither fits nor temperatures.
pub(super) fn running(
    file: &DesignFile,
    made: Races,
    sprags: Sprags,
    materials: &Materials,
    out: &mut Findings,
) -> Option<(Races, Sprags, Option<Running>)> {
    rims(file, out);
    if file.thermal.is_none() && file.races.press_fit.is_none() {
        return Some((made, sprags, None));
    }
    let [sprag_growth, inner_growth, outer_growth] = match &file.thermal {
        None => [0.0; 3],
        Some(t) => {
            let [sprag, inner, outer] = steels::expansions(&file.material, out)?;
            let rise = |celsius: f64| celsius - t.reference_c.unwrap_or(20.0);
            [sprag * rise(t.sprags_c), inner * rise(t.inner_race_c), outer * rise(t.outer_race_c)]
        }
    };
    let (inner, outer) = joints(file, &made, out)?;
    let fits = Fits { inner, outer, sprag_growth, inner_growth, outer_growth };
    match fits.run(&made, &sprags, materials) {
        Ok((races, sprags, running)) => Some((races, sprags, Some(running))),
        Err(why) => {
            refuse(&made, &why, out);
            None
        }
    }
}

fn refuse(made: &Races, why: &NotRunning, out: &mut Findings) {
    let as_run = match why {
        // A race is refused by its own rules.
        NotRunning::Rings => return,
        NotRunning::Gap { run_m } => {
            let made_mm = mm(made.outer_radius_m - made.inner_radius_m);
            out.refuse(
                &KEYS,
                format!(
                    "fits and temperatures with which the sprags still touch both races on their profile; the gap is \
                     {made_mm} mm as made and {} mm as run",
                    mm(*run_m)
                ),
                "make the tracks so that the gap as run is right, or lower interference and temperatures".to_owned(),
            );
            return;
        }
        NotRunning::Outline(why) => why.to_string(),
        NotRunning::Neighbours { overlap_m } => {
            format!("neighbours overlap by {} mm at first contact", mm(*overlap_m))
        }
    };
    out.refuse(
        &KEYS,
        format!("fits and temperatures with which the sprag keeps its outline; as run, {as_run}"),
        "move the flanks, or lower interference and temperatures".to_owned(),
    );
}

fn joints(file: &DesignFile, made: &Races, out: &mut Findings) -> Option<(Option<Joint>, Option<Joint>)> {
    let Some(fit) = &file.races.press_fit else { return Some((None, None)) };
    let before = out.problems.len();
    let key = |name: &str| format!("races.press_fit.{name}");
    let radial = |um: f64| 0.5e-6 * um;
    let inner = fit
        .inner_interference_um
        .map(|um| Joint { radial_m: radial(um), far_rim_m: m(fit.shaft_bore_radius_mm) });
    if let Some(joint) = inner {
        if made.inner_bore_radius_m <= 0.0 {
            out.refuse(
                &[&key("inner_interference_um"), "races.inner_bore_radius_mm"],
                "only with a bore: inner_bore_radius_mm above 0".to_owned(),
                "remove inner_interference_um: a solid inner race has no shaft in it".to_owned(),
            );
        } else if joint.far_rim_m >= made.inner_bore_radius_m {
            out.refuse(
                &[&key("shaft_bore_radius_mm"), "races.inner_bore_radius_mm"],
                format!("less than the bore of the inner race, {} mm", mm(made.inner_bore_radius_m)),
                "give the radius of the hole in the shaft; 0 for a solid one".to_owned(),
            );
        }
    } else if fit.shaft_bore_radius_mm > 0.0 {
        out.refuse(
            &[&key("shaft_bore_radius_mm")],
            "only together with inner_interference_um".to_owned(),
            "add inner_interference_um = ..., or remove shaft_bore_radius_mm".to_owned(),
        );
    }
    let outer = match (fit.outer_interference_um, fit.housing_outside_radius_mm) {
        (Some(um), Some(outside)) => {
            if m(outside) <= made.outer_outside_radius_m {
                out.refuse(
                    &[&key("housing_outside_radius_mm"), "races.outer_outside_radius_mm"],
                    format!("more than the outer race's outside, {} mm", mm(made.outer_outside_radius_m)),
                    "give the radius to which the housing reaches".to_owned(),
                );
            }
            Some(Joint { radial_m: radial(um), far_rim_m: m(outside) })
        }
        (None, None) => None,
        (given, _) => {
            let names = ["outer_interference_um", "housing_outside_radius_mm"];
            let [have, lack] = if given.is_some() { names } else { [names[1], names[0]] };
            out.refuse(
                &[&key(have)],
                format!("only together with {lack}, which is missing"),
                format!("add {lack} = ... to [races.press_fit], or remove {have}"),
            );
            None
        }
    };
    (out.problems.len() == before).then_some((inner, outer))
}
