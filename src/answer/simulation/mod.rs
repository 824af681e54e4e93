//! What became of a scene: verdict, figures with their errors, events, notes, what was left out, history.

mod body;
mod damping;
mod errors;
mod facts;
mod history;
mod left_out;
mod notes;
mod page;
#[cfg(feature = "validation")]
mod published;
mod settings;
mod slip;
mod stretch;
mod table;
pub(in crate::answer) mod train;
pub(in crate::answer) mod unfelt;
mod verdict;

pub use body::{
    Energy, Equilibrium, Extreme, Extremes, Fast, SimulationBody, Slip, SlipHeat, Slips, WorstSlip,
};
pub use damping::Effect;
pub use errors::SimulationErrors;
pub use history::{HistoryRow, SceneHistory, Values, word};
pub use settings::{Integration, RefusedSetting, Setting, SimulationSettings};
pub use train::Eigenfrequency;
pub use verdict::LIFT_OFF_SEARCH_RAD_S;

use super::left_out::LeftOut;
use super::{Answer, Envelope, Finding, Provenance};
use crate::clutch::Scenario;
use crate::design::Design;
use crate::dynamics::Stop;
use crate::fidelity::{self, Term, Terms};
use crate::report::{Page, Screen, Table};
use crate::scenario::{Beyond, NoScenario, Prepared, Simulation, Verdict, beyond};
use serde::{Serialize, Serializer};
use serde_json::json;

/// A scene that has run, before it is looked at once more for what contact damping changes.
#[derive(Debug, Clone)]
pub struct Ran {
    /// The scenario.
    pub scenario: Scenario,
    /// The design with the scenario's overrides in its clutch.
    pub design: Design,
    /// `event`, `published`, or `equilibrium` where nothing is integrated.
    pub method: &'static str,
    /// Model and start that were run, and what happened; an error where the clutch has no such start.
    pub outcome: Result<(Prepared, Simulation), NoScenario>,
    /// What comes after the end of the curve, of a scene that went there.
    pub beyond: Option<Beyond>,
    /// Terms that the planner left out.
    pub planned: Vec<Term>,
    /// Terms that it looked at and kept.
    pub kept: Vec<Term>,
}

/// What became of a scene. As JSON it is the object of `simulate --json` without the keys that all commands share; those are
/// fields here.
#[derive(Debug, Clone)]
pub struct SimulationAnswer {
    /// What ran.
    pub ran: Ran,
    /// What contact damping changes, where both runs came to an answer.
    pub damping: Option<Effect>,
    /// What the model leaves out, each with its cost.
    pub left_out: Vec<LeftOut>,
    /// The figures by their keys in JSON.
    pub body: SimulationBody,
}

impl Serialize for SimulationAnswer {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.body.serialize(serializer)
    }
}

impl std::ops::Deref for SimulationAnswer {
    type Target = Ran;

    fn deref(&self) -> &Ran {
        &self.ran
    }
}

impl SimulationAnswer {
    /// On a terminal, with every figure.
    pub fn text_with_all_figures(&self, screen: Screen) -> String {
        format!("{}\n\n{}{}", self.verdict_line(), facts::table(self).to_text(screen), self.slip_text())
    }

    /// What slip does to its surfaces; nothing where nothing slips.
    fn slip_text(&self) -> String {
        self.simulation().map_or(Vec::new(), slip::lines).iter().map(|line| format!("\n{line}\n")).collect()
    }
}

impl Answer for SimulationAnswer {
    type Body<'a> = &'a SimulationBody;

    /// Whatever becomes of the clutch is the answer.
    fn outcome(&self) -> Finding {
        match self.simulation() {
            Some(s) if s.stop == Stop::Interrupted || s.finer_gave_up == Some(Stop::Interrupted) => {
                Finding::Stopped
            }
            Some(s) if s.verdict.is_none() || s.stop.gave_up() => Finding::NotKnown,
            // A finer run that met a limit: the errors told are larger than those asked for.
            Some(s) if s.gave_up.is_some_and(|run| run.limit.is_some()) => Finding::NotKnown,
            _ => Finding::Shown,
        }
    }

    /// Where a finer run alone did not come to its end the history is whole.
    fn part(&self) -> Option<String> {
        let s = self.simulation().filter(|s| s.finer_gave_up.is_none())?;
        if s.stop.gave_up() || s.stop == Stop::Interrupted { self.given_up() } else { None }
    }

    /// Whether the scene ended as it should.
    fn held(&self) -> bool {
        self.ran.held()
    }

    fn verdict(&self) -> String {
        self.verdict_line()
    }

    /// The history.
    fn table(&self) -> Table {
        self.history().table()
    }

    /// The verdict and the figures that say most of it.
    fn text(&self, screen: Screen) -> String {
        let (first, all) = facts::first_and_all(facts::table(self));
        let mut text = format!("{}\n\n{}{}", self.verdict_line(), first.to_text(screen), self.slip_text());
        if let Some(all) = all {
            text += &format!("\nAll {} figures: --figures, --report or --json\n", all.rows.len());
        }
        text
    }

    fn page(&self, provenance: &Provenance) -> Page {
        page::page(self, provenance)
    }

    fn envelope(&self, run_time_s: f64) -> Envelope<'_, &SimulationBody> {
        Envelope {
            design: &self.design,
            run_time_s,
            left_out: self.left_out.clone(),
            error_estimate: self.simulation().and_then(|s| s.error).map(|e| json!(e.theta_inner_rad)),
            body: &self.body,
        }
    }
}

/// Why a scene was not simulated. What can happen to a clutch is an answer, also that it has no such start.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoAnswer {
    /// The design has no scenario of this name; those that it has.
    #[error("no scenario {name}; the design has: {}", .known.join(", "))]
    NoSuchScenario {
        /// Name asked for.
        name: String,
        /// Names of the design's.
        known: Vec<String>,
    },
    /// A setting makes no sense.
    #[error("{0}")]
    Refused(RefusedSetting),
}

/// Simulate the scenario `name` of `design`.
///
/// # Errors
/// [`NoAnswer`].
pub fn simulate(
    design: &Design,
    name: &str,
    settings: &SimulationSettings,
) -> Result<SimulationAnswer, NoAnswer> {
    let scenario = design.scenario(name).ok_or_else(|| NoAnswer::NoSuchScenario {
        name: name.to_owned(),
        known: design.scenarios.iter().map(|s| s.name.clone()).collect(),
    })?;
    settings.validate_for(scenario).map_err(NoAnswer::Refused)?;
    let ran = Ran::new(design, scenario, settings);
    let damping = ran.damping_effect(settings);
    Ok(SimulationAnswer::new(ran, damping, settings))
}

impl Design {
    /// Simulate the scenario `name`: verdict, figures with errors, its history on request, what was left out.
    ///
    /// ```
    /// use sprag_design::{Design, answer::simulation::SimulationSettings};
    ///
    /// let design = Design::read("designs/huang2017-multi-arc.toml".as_ref())?;
    /// let answer = design.simulate("low-6", &SimulationSettings::default())?;
    /// assert_eq!(answer.verdict(), Some("sticks"));
    /// assert!(answer.body.slip_margin.is_some_and(|margin| margin > 0.0));
    /// let history = answer.history();
    /// assert_eq!(history.numbers("time_s").map(<[f64]>::len), history.numbers("normal_inner_n").map(<[f64]>::len));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`NoAnswer`].
    pub fn simulate(&self, name: &str, settings: &SimulationSettings) -> Result<SimulationAnswer, NoAnswer> {
        simulate(self, name, settings)
    }
}

impl Ran {
    /// Run `scenario` of `design`; [`SimulationSettings::follow`] is told how far it is.
    pub fn new(design: &Design, scenario: &Scenario, settings: &SimulationSettings) -> Self {
        let found = match settings.method {
            Integration::Event => {
                let terms = if settings.full { Terms::All } else { Terms::Felt };
                fidelity::simulate(scenario, &settings.of_run(scenario), terms)
                    .map(|planned| ((planned.prepared, planned.simulation), planned.left_out, planned.kept))
            }
            #[cfg(feature = "validation")]
            Integration::Published { .. } => {
                settings.run_published(scenario).map(|ran| (ran, Vec::new(), Vec::new()))
            }
        };
        let (outcome, planned, kept) = match found {
            Ok((outcome, planned, kept)) => (Ok(outcome), planned, kept),
            Err(why) => (Err(why), Vec::new(), Vec::new()),
        };
        let method = match settings.method {
            _ if scenario.kind.duration_s().is_none() => "equilibrium",
            Integration::Event => "event",
            #[cfg(feature = "validation")]
            Integration::Published { .. } => "published",
        };
        let overloaded = outcome.as_ref().ok().filter(|(_, s)| s.verdict == Some(Verdict::Overloaded));
        let beyond = overloaded
            .filter(|_| method == "event")
            .and_then(|(prepared, _)| beyond(&scenario.clutch, prepared, &settings.of_run(scenario)));
        let own = Design { clutch: scenario.clutch.clone(), ..design.clone() };
        Self { scenario: scenario.clone(), design: own, method, outcome, beyond, planned, kept }
    }

    /// What happened; `None` where the clutch has no such start.
    pub fn simulation(&self) -> Option<&Simulation> {
        self.outcome.as_ref().ok().map(|(_, s)| s)
    }
}

impl SimulationAnswer {
    /// All that is said of a scene that has run.
    pub fn new(ran: Ran, damping: Option<Effect>, settings: &SimulationSettings) -> Self {
        let left_out = left_out::of(&ran, damping.as_ref());
        let notes = notes::of(&ran, damping.as_ref(), settings);
        let body = SimulationBody::of(&ran, notes);
        Self { ran, damping, left_out, body }
    }
}
