//! What the margin check answers: rows, verdict, torque capacities, overrun, radii as run, load round the circumference.

mod at_speed;
mod body;
mod charts;
mod lift_off;
pub mod overrun;
mod page;
pub mod run_out;
pub mod running;
mod sections;
mod sheet;
#[cfg(test)]
mod tests;
mod text;

pub use body::{Capacity, CheckBody, CheckRow, Deciding};
pub use body::{
    LETS_GO, NONE_SUFFICES, OVERLOADED, allowable_cell, csv_table, demand_cell, ends_first,
    far_more_than_asked, in_place_of_margin, is_beyond, margin_cell, margin_text, margin_words, no_friction,
    people_table, unit_cell,
};

pub(super) use text::{REACHED_AT, much_friction, size_line};

use at_speed::AtSpeedSection;

use super::left_out::{LeftOut, left_out_of, off_centre};
use super::{Answer, Envelope, Finding, Provenance};
use crate::clutch::Scenario;
use crate::design::Design;
use crate::file::beside_the_name;
use crate::follow::{Follow, News};
use crate::margin::{
    Capacities, LIFT_OFF_TO_RAD_S, LoadState, Margin, NoMargins, SceneDemand, allowed_opening_m,
    scene_demand, scene_rows, static_margins_until,
};
use crate::report::{Page, Screen, Table, Unit};
use crate::scenario::Settings;
use crate::wedge::straddling_error;
use body::Source;
use rayon::prelude::*;
use serde::{Serialize, Serializer};
use serde_json::json;

/// A design held against each of its limits. As JSON it is the object of `check --json` without the keys that all commands
/// share; those are fields here.
#[derive(Debug, Clone)]
pub struct CheckAnswer {
    /// The design.
    pub design: Design,
    /// What the static rows were read from.
    pub state: LoadState,
    /// The rows, SI.
    pub rows: Vec<Margin>,
    /// How many of them are no scene's; they come first.
    pub static_rows: usize,
    /// Demand of the scenes in which something is to stick, in their order.
    pub scenes: Vec<(String, SceneDemand)>,
    /// How far off the answer is.
    pub errors: CheckErrors,
    /// What the model leaves out, each with its cost.
    pub left_out: Vec<LeftOut>,
    /// The figures by their keys in JSON.
    pub body: CheckBody,
    /// What the text says beside the table; the body has all of it.
    notes: text::Notes,
}

/// How far off a check is.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CheckErrors {
    /// Of the static curve, by its own size.
    pub statics_relative: f64,
    /// Largest change of a finite scenario margin when the tolerance is ten times finer; none without scenarios.
    pub scenario_margins: Option<f64>,
    /// Of inner Hertz pressure, while a junction lies under the contact.
    pub hertz_at_junctions_relative: f64,
}

impl Serialize for CheckAnswer {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.body.serialize(serializer)
    }
}

impl CheckAnswer {
    /// [`Answer::text`] with notes on how the table is to be read.
    pub fn text_with_notes(&self, screen: Screen) -> String {
        text::text(self, screen, true)
    }

    /// The same answer as a design sheet: a dimensioned drawing first, and all inputs.
    pub fn sheet(&self) -> DesignSheet<'_> {
        DesignSheet(self)
    }
}

impl Answer for CheckAnswer {
    type Body<'a> = &'a CheckBody;

    fn outcome(&self) -> Finding {
        self.body.held().map_or(Finding::NotKnown, Finding::of)
    }

    fn verdict(&self) -> String {
        self.body.verdict()
    }

    /// Every number in full, nothing but numbers in number columns.
    fn table(&self) -> Table {
        body::csv_table(&self.body.margins)
    }

    fn text(&self, screen: Screen) -> String {
        text::text(self, screen, false)
    }

    fn page(&self, provenance: &Provenance) -> Page {
        page::page(self, provenance)
    }

    fn envelope(&self, run_time_s: f64) -> Envelope<'_, &CheckBody> {
        Envelope {
            design: &self.design,
            run_time_s,
            left_out: self.left_out.clone(),
            error_estimate: Some(json!(self.errors)),
            body: &self.body,
        }
    }
}

/// A check as a design sheet: its page and its few lines; figures and exit are those of the check.
#[derive(Debug, Clone, Copy)]
pub struct DesignSheet<'c>(&'c CheckAnswer);

impl Answer for DesignSheet<'_> {
    type Body<'a>
        = &'a CheckBody
    where
        Self: 'a;

    fn outcome(&self) -> Finding {
        self.0.outcome()
    }

    fn verdict(&self) -> String {
        self.0.verdict()
    }

    fn table(&self) -> Table {
        self.0.table()
    }

    fn text(&self, _: Screen) -> String {
        let body = &self.0.body;
        let lines = std::iter::once(self.verdict()).chain(body.capacity_lines());
        let lines = lines.chain(body.at_speed.as_ref().and_then(AtSpeedSection::warning));
        lines.map(|line| line + "\n").collect()
    }

    fn page(&self, provenance: &Provenance) -> Page {
        sheet::page(self.0, provenance)
    }

    fn envelope(&self, run_time_s: f64) -> Envelope<'_, &CheckBody> {
        self.0.envelope(run_time_s)
    }
}

/// Why a design was not checked.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoCheck {
    /// There is no clutch to speak of.
    #[error("{0}")]
    NoClutch(NoMargins),
    /// [`Follow`] was stopped.
    #[error("stopped before every margin was known")]
    Stopped,
}

/// Opening that a gap limit leaves, by the gap at rest, from which on it is asked about: `new` leaves 1.5 and 3 %.
const WIDE_OPENING: f64 = 0.04;

/// Notes on limits of the race gap that leave it more to open than any clutch needs: they are of the whole gap, and stay as they are where
/// a race is changed.
fn wide_gaps(design: &Design) -> Vec<String> {
    let races = &design.clutch.races;
    let rest_m = races.outer_radius_m - races.inner_radius_m;
    let limits = [("gap_nominal_mm", design.limits.gap_nominal_m), ("gap_peak_mm", design.limits.gap_peak_m)];
    let wide =
        limits.into_iter().filter_map(|(key, gap)| Some((key, allowed_opening_m(gap, design)? / rest_m)));
    wide.filter(|(_, share)| *share > WIDE_OPENING)
        .map(|(key, share)| {
            format!(
                "Note: {key} lets the gap of {} between the tracks open by {}, which bears on nothing: it is the whole gap under load, so where \
                 a race was changed, move it by as much",
                Unit::Millimetre.show(rest_m, 4),
                Unit::Percent.show(share, 2)
            )
        })
        .collect()
}

impl Design {
    /// Hold the design against each of its limits, all scenarios side by side: rows, verdict, torque capacities, overrun. `follow` is told
    /// of every scenario that is done.
    ///
    /// ```
    /// use sprag_design::{Design, Follow};
    ///
    /// let design = Design::read("designs/huang2017-multi-arc.toml".as_ref())?;
    /// let answer = design.check(&Follow::nobody())?;
    /// let deciding = answer.body.deciding.as_ref().ok_or("no limits")?;
    /// assert_eq!(answer.body.held(), Some(deciding.margin >= -sprag_design::margin::RESOLUTION));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`NoCheck`].
    pub fn check(&self, follow: &Follow) -> Result<CheckAnswer, NoCheck> {
        let (state, mut rows, ring) =
            static_margins_until(self, Capacities::Wanted, follow).map_err(NoCheck::NoClutch)?;
        if follow.stopped() {
            return Err(NoCheck::Stopped);
        }
        let static_rows = rows.len();
        let found: Vec<Option<SceneFound>> =
            self.scenarios.par_iter().map(|scenario| scene(self, &state, scenario, follow)).collect();
        let (mut scenario_margins, mut scenes) = (None, Vec::new());
        for (found, scenario) in found.into_iter().zip(&self.scenarios) {
            let SceneFound { demand, margins, error } = found.ok_or(NoCheck::Stopped)?;
            rows.extend(margins);
            scenes.extend(demand.map(|demand| (scenario.name.clone(), demand)));
            scenario_margins = Some(error.max(scenario_margins.unwrap_or(0.0)));
        }
        let limits = &self.limits;
        let (overrun, lift_off_rad_s) =
            self.overruns(&state, follow).map_err(|why| NoCheck::NoClutch(NoMargins::Curve(why)))?;
        if follow.stopped() {
            return Err(NoCheck::Stopped);
        }
        let source = Source {
            end: state.curve.end().0,
            end_torque_nm: state.curve.end_torque_nm(),
            asked_nm: limits.largest_torque_nm().unwrap_or(0.0),
            lift_off_rad_s,
            of_file: beside_the_name(&self.source).into_iter().chain(wide_gaps(self)).collect(),
            searched_to_rad_s: LIFT_OFF_TO_RAD_S,
            overrun,
            at_speed: AtSpeedSection::new(self, &state, &rows),
            running: running::RunningSection::new(self, &state),
            run_out: ring.as_ref().map(|ring| run_out::RunOutSection::new(self, &state, ring)),
        };
        let list = left_out_of(self);
        let left_out = match &source.run_out {
            Some(section) => off_centre(list, section.left_out()),
            None => list,
        };
        let errors = CheckErrors {
            statics_relative: state.curve.truncation(),
            scenario_margins,
            hertz_at_junctions_relative: straddling_error(&self.clutch),
        };
        let mut body = CheckBody::new(&rows, source);
        let notes = text::Notes::of(self, &rows, &body);
        body.notes = notes.all();
        let design = self.clone();
        Ok(CheckAnswer { design, state, rows, static_rows, scenes, errors, left_out, body, notes })
    }
}

/// One scenario: demand and margins at the finer tolerance, and how far those are off.
struct SceneFound {
    /// None of a steady overrun: nothing is to stick.
    demand: Option<SceneDemand>,
    margins: Vec<Margin>,
    error: f64,
}

/// Settings at which scenes are evaluated: ten times finer than a single run, which then says how far it is off.
pub(crate) fn fine(follow: &Follow) -> Settings {
    let coarse = Settings { follow: follow.unseen(), ..Settings::default() };
    Settings { tolerance: 0.1 * coarse.tolerance, ..coarse }
}

/// One scenario at two tolerances; nothing once somebody asked to stop.
fn scene(design: &Design, state: &LoadState, scenario: &Scenario, follow: &Follow) -> Option<SceneFound> {
    if scenario.kind.is_overrun() {
        follow.news(News::Done);
        return Some(SceneFound { demand: None, margins: Vec::new(), error: 0.0 });
    }
    let coarse = Settings { follow: follow.unseen(), ..Settings::default() };
    let required = design.check_scenarios.contains(&scenario.name);
    let at = |settings: &Settings| {
        (!follow.stopped()).then(|| {
            let demand = scene_demand(scenario, Some(state.at_rest(design)), settings);
            let rows = scene_rows(scenario, &demand, &design.limits, required);
            (demand, rows)
        })
    };
    let ((_, coarse), (demand, margins)) = (at(&coarse)?, at(&fine(follow))?);
    // Rows of a run that was cut short are none.
    if follow.stopped() {
        return None;
    }
    let error = coarse.iter().zip(&margins).map(|(a, b)| (a.margin() - b.margin()).abs()).fold(0.0, f64::max);
    follow.news(News::Done);
    Some(SceneFound { demand: Some(demand), margins, error })
}
