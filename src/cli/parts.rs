//! What the answers of all commands share: reading the design, the JSON object, beginning and end of a page.

use super::Context;
use super::exit::Failure;
use super::left_out::LeftOut;
use super::output::{self, Envelope, TOOL, VERSION};
use crate::design::Design;
use crate::profile::{Outline, Profile};
use crate::report::{Column, Drawing, Page, PageHead, SpragPose, Table};
use crate::wedge::{Closure, WedgeCurve};
use serde::Serialize;
use serde_json::{Value, json};
use std::path::Path;

/// Chords of a drawn outline leave its arcs by no more than this, m.
const OUTLINE_M: f64 = 1e-6;

/// The checked design in `path`. A refused file goes to standard error in words (by the caller of the
/// command) and, with `--json`, also to standard output as `{"error": {"file", "problems": [..]}}`.
///
/// # Errors
/// [`Failure::Malformed`] with every fault of the file.
pub fn read_design(path: &Path, context: &Context) -> Result<Design, Failure> {
    Design::read(path).or_else(|refused| {
        if context.json {
            output::print_json(&json!({ "error": refused.to_json() }))?;
        }
        Err(Failure::Malformed(miette::Report::new(refused)))
    })
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
    fn envelope(&self) -> Envelope<'_, Vec<LeftOut>, B> {
        Envelope::new(
            &self.design.name,
            &self.design.hash,
            self.run_time_s,
            &self.left_out,
            self.error_estimate.clone(),
            &self.body,
        )
    }

    /// The one JSON object of `--json`; nothing without it.
    ///
    /// # Errors
    /// [`Failure::Failed`] where standard output cannot be written.
    pub fn print(&self, context: &Context) -> Result<(), Failure> {
        if context.json { output::print_json(&self.envelope()) } else { Ok(()) }
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
        page.results("results", &serde_json::to_value(self.envelope()).unwrap_or_default());
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

/// The sprag of `design` at first contact at rest, with its real outline.
pub fn pose_at_rest(label: &str, design: &Design, profile: &Profile) -> SpragPose {
    let sprags = &design.clutch.sprags;
    // A profile whose flanks miss an arc is drawn by its arcs, contacts and centres alone.
    let outline = Outline::new(profile, sprags.flanks.rear_m, sprags.flanks.front_m)
        .map(|o| o.polyline(OUTLINE_M))
        .unwrap_or_default();
    SpragPose::at_first_contact(label, profile, outline, Some(sprags.centroid_m))
}

/// The same sprag under load, as the equilibrium `state` (of [`WedgeCurve::closure_at_torque`]) has it.
pub fn pose_loaded(label: &str, at_rest: &SpragPose, state: &Closure) -> SpragPose {
    at_rest.clone().moved(label, state.rotation.v, state.lengths.oc_e.v)
}

/// The same sprag at `torque_nm`, N m, or at the curve's end where that comes first; none where neither has
/// an equilibrium. The label names the torque.
pub fn pose_at_torque(at_rest: &SpragPose, curve: &WedgeCurve, torque_nm: f64) -> Option<SpragPose> {
    use crate::report::Unit;
    let end = curve.end_torque_nm();
    let (torque, tail) = if torque_nm <= end { (torque_nm, "") } else { (end, ", end of the curve") };
    let last = curve.arc_end_n(curve.arc_count() - 1);
    let (_, state) = curve.closure_at_torque(torque).or_else(|| curve.closure_at_normal(last))?;
    let label = format!("at {}{tail}", Unit::NewtonMetre.show_plain(torque, 4));
    Some(pose_loaded(&label, at_rest, &state))
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
    page.figure(&drawing.detail_svg(), "One sprag between its races, to scale.");
    page.figures(&[
        (drawing.clutch_svg(), "The clutch, to scale."),
        (drawing.centres_svg(), "Arc centres and centroid in the body frame (origin Cₑ)."),
    ]);
}
