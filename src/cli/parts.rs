//! What the answers of all commands share: reading the design, the JSON object, beginning and end of a page.

use super::Context;
use super::exit::Failure;
use super::left_out::LeftOut;
use super::output::{self, Envelope, TOOL, VERSION};
use crate::design::Design;
use crate::margin::NoMargins;
use crate::profile::{Outline, Profile};
use crate::report::{Column, Drawing, Page, PageHead, Plot, SpragPose, Table, Unit};
use crate::wedge::{Closure, NoCurve, NoElastic, StaticPoint, WedgeCurve};
use serde::Serialize;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// Chords of a drawn outline leave its arcs by no more than this, m.
const OUTLINE_M: f64 = 1e-6;

/// The checked design in `path`.
///
/// # Errors
/// [`Failure::Malformed`] with every fault of the file, or where an output is one of its histories.
pub fn read_design(path: &Path, context: &Context) -> Result<Design, Failure> {
    let design = Design::read(path).map_err(|refused| Failure::Malformed(miette::Report::new(refused)))?;
    let histories = design.histories.iter().map(PathBuf::as_path);
    let read: Vec<&Path> = std::iter::once(path).chain(histories).collect();
    context.outputs.check(&read, &[])?;
    context.outputs.refuse_foreign()?;
    Ok(design)
}

/// The refusal of a clutch that has no curve: file, reason, and the keys that decide it.
pub fn no_clutch(file: &Path, why: &NoMargins) -> Failure {
    let keys = match why {
        NoMargins::Outline(_) => "sprags.flanks, sprags.inner_arcs",
        NoMargins::Curve(NoCurve::NoElastic(NoElastic::Race(_))) => "races, material",
        NoMargins::Curve(NoCurve::NoElastic(NoElastic::Contact(_))) => "contact, material, sprags.length_mm",
        NoMargins::Curve(NoCurve::NoConvergence) => {
            "contact, material, sprags.length_mm, sprags.inner_arcs, races"
        }
        NoMargins::Profile(_) | NoMargins::Curve(NoCurve::NoFirstContact) => {
            "sprags.outer_radius_mm, sprags.centre_distance_mm, sprags.inner_arcs, races.inner_radius_mm, \
             races.outer_radius_mm"
        }
    };
    Failure::NoClutch(format!("{}: {why}; keys that decide it: {keys}", file.display()))
}

/// An answer for programs: the common keys and the command's own in `body`.
#[derive(Debug)]
pub struct Answer<'a, B: Serialize> {
    /// The design.
    pub design: &'a Design,
    /// Wall time of the computation alone, s.
    pub run_time_s: f64,
    /// Terms left out.
    pub left_out: Vec<LeftOut>,
    /// Error estimate where something was integrated or iterated: a number, or an object of numbers.
    pub error_estimate: Option<Value>,
    /// The command's own keys: a struct or map.
    pub body: B,
}

impl<B: Serialize> Answer<'_, B> {
    fn envelope(&self, unwritten: Vec<String>) -> Envelope<'_, Vec<LeftOut>, B> {
        Envelope::new(
            &self.design.name,
            &self.design.hash,
            self.run_time_s,
            &self.left_out,
            self.error_estimate.clone(),
            unwritten,
            &self.body,
        )
    }

    /// The one JSON object of `--json`, with what could not be written until now; nothing without it.
    ///
    /// # Errors
    /// [`Failure::Failed`] where standard output cannot be written.
    pub fn print(&self, context: &Context) -> Result<(), Failure> {
        match context.json {
            true => output::print_json(&self.envelope(context.outputs.unwritten())),
            false => Ok(()),
        }
    }

    /// End of a page: what was left out, the results for programs, the design file.
    pub fn close(&self, page: &mut Page) {
        let mut table = Table::new(vec![
            Column::text("term", "Left out"),
            Column::text("why", "Why"),
            Column::text("cost", "What it costs"),
        ]);
        for entry in &self.left_out {
            table.row(vec![
                entry.term.as_str().into(),
                entry.why.as_str().into(),
                entry.cost.as_str().into(),
            ]);
        }
        page.heading("What the model leaves out").table("", &table);
        // Numbers that are none become null; the object holds nothing else that has no JSON form.
        page.results("results", &serde_json::to_value(self.envelope(Vec::new())).unwrap_or_default());
        page.source("Design file", &self.design.source);
    }
}

/// A page with its head; `title` names the kind of answer, e.g. `"Margin check"`.
pub fn page(title: &str, design: &Design, context: &Context) -> Page {
    Page::new(PageHead {
        title: title.to_owned(),
        tool: TOOL.to_owned(),
        version: VERSION.to_owned(),
        command: context.command_line.clone(),
        design: design.name.clone(),
        design_hash: design.hash.clone(),
    })
}

/// The sprag of `design` at first contact at rest, with its outline: the narrowest that works where the design
/// names no flanks.
pub fn pose_at_rest(label: &str, design: &Design, profile: &Profile) -> SpragPose {
    let sprags = &design.clutch.sprags;
    // A profile that no flanks close is drawn by its arcs, contacts and centres alone.
    let outline = match sprags.flanks {
        Some(flanks) => Outline::closed(profile, &flanks),
        None => Outline::narrowest(profile),
    };
    let outline = outline.map(|o| o.polyline(OUTLINE_M)).unwrap_or_default();
    SpragPose::at_first_contact(label, profile, outline, Some(sprags.centroid_m))
}

/// The same sprag under load, as the equilibrium `state` (of [`WedgeCurve::closure_at_torque`]) has it.
pub fn pose_loaded(label: &str, at_rest: &SpragPose, state: &Closure) -> SpragPose {
    at_rest.clone().moved(label, state.rotation.v, state.lengths.oc_e.v)
}

/// The same sprag at `torque_nm`, N m, or at the curve's end where that comes first; none where neither has
/// an equilibrium. The label names the torque.
pub fn pose_at_torque(at_rest: &SpragPose, curve: &WedgeCurve, torque_nm: f64) -> Option<SpragPose> {
    let end = curve.end_torque_nm();
    let (torque, tail) = if torque_nm <= end { (torque_nm, "") } else { (end, ", end of the curve") };
    let last = curve.arc_end_n(curve.arc_count() - 1);
    let (_, state) = curve.closure_at_torque(torque).or_else(|| curve.closure_at_normal(last))?;
    let label = format!("at {}{tail}", Unit::NewtonMetre.show_plain(torque, 4));
    Some(pose_loaded(&label, at_rest, &state))
}

/// Points of the curve for plots, N m ascending, up to `up_to_nm` or the curve's end, with the equilibrium
/// behind each. Every arc keeps both its ends, so jumps at a junction show as jumps.
pub fn samples(curve: &WedgeCurve, up_to_nm: f64) -> Vec<(StaticPoint, Closure)> {
    /// Points per arc: more than a plot of 720 px can tell apart from a curve.
    const PER_ARC: usize = 60;
    let mut points = Vec::new();
    let mut from_n = 0.0;
    for arc in 0..curve.arc_count() {
        let until_n = curve.arc_end_n(arc);
        for i in 0..=PER_ARC {
            // Denser towards the beginning, where angles and stiffness change most. A junction belongs to the arc
            // before it; the next one begins a hair above.
            let share = (i as f64 / PER_ARC as f64).powi(2);
            let n = from_n + (until_n - from_n) * share.max(1e-9);
            let both = curve.at_normal(n).zip(curve.closure_at_normal(n).map(|(_, c)| c));
            match both {
                Some((point, _)) if point.torque_nm > up_to_nm => {
                    let last =
                        curve.at_torque(up_to_nm).zip(curve.closure_at_torque(up_to_nm).map(|(_, c)| c));
                    points.extend(last);
                    return points;
                }
                both => points.extend(both),
            }
        }
        from_n = until_n;
    }
    points
}

/// Torque, N m, and alpha, rad, at which each arc of the curve but its last hands over to the next; `arc` counts
/// from 1 and names the arc that ends.
pub fn junctions(curve: &WedgeCurve) -> Vec<Junction> {
    (0..curve.arc_count().saturating_sub(1))
        .filter_map(|k| {
            let point = curve.at_normal(curve.arc_end_n(k))?;
            Some(Junction {
                torque_nm: point.torque_nm,
                alpha_rad: curve.arc_end_rad(k),
                arc: curve.first_arc() + k + 1,
            })
        })
        .collect()
}

/// Where one arc hands over to the next.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Junction {
    /// Torque, N m.
    pub torque_nm: f64,
    /// alpha, rad.
    pub alpha_rad: f64,
    /// Number of the arc that ends here, from 1.
    pub arc: usize,
}

impl Junction {
    /// Label in plots, e.g. `1|2`.
    pub fn label(&self) -> String {
        format!("{}|{}", self.arc, self.arc + 1)
    }
}

/// The races of `design` with `poses` of its sprags (the first in full, the others dashed over it).
pub fn drawing(design: &Design, poses: Vec<SpragPose>) -> Drawing {
    let r = &design.clutch.races;
    Drawing {
        race_radii_m: [r.inner_bore_radius_m, r.inner_radius_m, r.outer_radius_m, r.outer_outside_radius_m],
        count: design.clutch.sprags.count,
        poses,
    }
}

/// Section of a page with the drawing to scale: one sprag, then clutch and arc centres side by side.
pub fn draw(page: &mut Page, drawing: &Drawing) {
    page.heading("Geometry");
    let caption = if drawing.poses.len() > 1 {
        "One sprag between its races, to scale. The races are drawn without load: a loaded sprag overlaps them by \
         what yields."
    } else {
        "One sprag between its races, to scale."
    };
    page.figure(&drawing.detail_svg(), caption);
    page.figures(&[
        (drawing.clutch_svg(), "The clutch, to scale."),
        (drawing.centres_svg(), "Arc centres and centroid in the body frame (origin Cₑ)."),
    ]);
}

/// A plot at the size it has beside another on a page, so that its letters keep theirs.
pub fn half(plot: Plot) -> String {
    plot.sized(500.0, 320.0).to_svg()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clutch_without_a_curve_is_told_with_file_and_keys() {
        let why = NoMargins::Curve(NoCurve::NoConvergence);
        let text = no_clutch(Path::new("a.toml"), &why).to_json().unwrap()["message"].to_string();
        for word in ["a.toml", "did not converge", "contact, material", "sprags.inner_arcs"] {
            assert!(text.contains(word), "{text}");
        }
    }
}
