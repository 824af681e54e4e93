//! What a search for a better design answers: the design found, its margins, how sure that is.

use super::left_out::{LeftOut, left_out};
use crate::design::{Design, DesignError};
use crate::follow::Follow;
use crate::margin::Margin;
use crate::optimise::{
    Desk, Fidelity, Forgetful, Method, NoSearch, Search, Settings, Status, Variable, search,
};
use crate::scenario;
use serde::{Serialize, Serializer};
use std::collections::BTreeMap;

/// Climbs where their number is left open: with fewer than 8 even a single optimum met each time proves nothing.
pub const STARTS: usize = 8;
/// The same at most.
pub const MOST_STARTS: usize = 32;

/// How to search. The default is what `optimize` does without flags.
#[derive(Debug, Clone)]
pub struct Ask {
    /// Most evaluations of each climb.
    pub evaluations: usize,
    /// Climbs; `None`: [`STARTS`], and more up to [`MOST_STARTS`] as long as the optima met let expect others.
    pub starts: Option<usize>,
    /// Evaluations of a particle swarm first; `None`: no swarm.
    pub swarm: Option<usize>,
    /// True error allowed of an evaluation in the search.
    pub tolerance: f64,
    /// Whether everything runs in the search too.
    pub full: bool,
    /// Ends the search; the best design so far is the answer.
    pub follow: Follow,
}

impl Default for Ask {
    fn default() -> Self {
        Self {
            evaluations: Settings::default().max_evaluations,
            starts: None,
            swarm: None,
            tolerance: scenario::Settings::default().tolerance,
            full: false,
            follow: Follow::default(),
        }
    }
}

/// What a search found.
#[derive(Debug, Clone)]
pub struct SearchAnswer {
    /// The search.
    pub found: Search,
    /// What the model leaves out, each with its cost.
    pub left_out: Vec<LeftOut>,
    /// The figures by keys that `optimize --json` has too.
    pub body: Body,
}

impl Serialize for SearchAnswer {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.body.serialize(serializer)
    }
}

/// A design of the search.
#[derive(Debug, Clone, Serialize)]
pub struct Found {
    /// Values of the variables, in the units of their names.
    pub variables: BTreeMap<String, f64>,
    /// The objective, in its own unit.
    pub objective: f64,
    /// Its margins.
    pub margins: Vec<Row>,
}

/// A margin of a design of the search.
#[derive(Debug, Clone, Serialize)]
pub struct Row {
    /// Code for scripts.
    pub code: String,
    /// Name for people.
    pub name: String,
    /// Unit of demand and allowable.
    pub unit: &'static str,
    /// Allowable, in `unit`; of slip the wanted slip margin.
    pub allowable: f64,
    /// Margin as a number; 0 or more is held.
    pub margin: f64,
    /// Of slip rows mu_s over the friction required, less 1.
    pub slip_margin: Option<f64>,
    /// Demand, in `unit`, where it is a number.
    pub demand: Option<f64>,
}

/// Keys of the answer.
#[derive(Debug, Clone, Serialize)]
pub struct Body {
    /// How the best climb ended: `converged`, `infeasible`, `evaluation-limit`, `interrupted`, `stalled`.
    pub status: &'static str,
    /// What was made better.
    pub aim: &'static str,
    /// Whether every margin of the design found is held.
    pub feasible: bool,
    /// Codes of those that are not.
    pub not_held: Vec<String>,
    /// The design found.
    pub best: Found,
    /// Values in the design file.
    pub in_file: BTreeMap<String, f64>,
    /// Where the search began.
    pub start: Found,
    /// Change of the objective when the optimum is looked at in full at a tenth of the tolerance.
    pub objective_error: f64,
    /// Evaluations of the clutch in all.
    pub evaluations: usize,
    /// Of the best climb those without an answer.
    pub failed_evaluations: usize,
    /// Limits that no design near holds together.
    pub fighting_limits: Vec<String>,
    /// Variables that move no margin.
    pub dropped_variables: Vec<String>,
}

impl Body {
    fn of(found: &Search) -> Self {
        let values = |pick: fn(&Variable) -> f64| -> BTreeMap<String, f64> {
            found.variables.iter().map(|v| (v.name.clone(), pick(v))).collect()
        };
        let rows = |list: &[Margin]| list.iter().map(Row::of).collect();
        let fighting = match &found.outcome.status {
            Status::Infeasible { fighting, .. } => fighting.as_slice(),
            _ => &[],
        };
        let (before, after) = found.objective;
        Self {
            status: found.outcome.status.name(),
            aim: found.aim.name(),
            feasible: found.feasible(),
            not_held: found.not_held(),
            best: Found { variables: values(|v| v.best), objective: after, margins: rows(&found.best) },
            in_file: values(|v| v.given),
            start: Found { variables: values(|v| v.start), objective: before, margins: rows(&found.start) },
            objective_error: found.objective_error,
            evaluations: found.evaluations,
            failed_evaluations: found.outcome.failures,
            fighting_limits: fighting.iter().filter_map(|&i| found.names.limits.get(i).cloned()).collect(),
            dropped_variables: found.variables.iter().filter(|v| v.dropped).map(|v| v.name.clone()).collect(),
        }
    }
}

impl Row {
    fn of(m: &Margin) -> Self {
        Self {
            code: m.code(),
            name: m.name.clone(),
            unit: m.limit.unit,
            allowable: m.shown_allowable(),
            margin: m.margin(),
            slip_margin: m.slip_margin(),
            demand: m.demand_in_unit(),
        }
    }
}

impl SearchAnswer {
    /// The design found.
    ///
    /// # Errors
    /// As [`Design::parse`], where a history of the design has gone meanwhile.
    pub fn design(&self, given: &Design, name_for_errors: &str) -> Result<Design, DesignError> {
        Design::parse_in(&given.folder, &self.found.file, name_for_errors)
    }
}

impl Design {
    /// Search for a better design as the `[optimize]` table says. Nothing is written.
    ///
    /// # Errors
    /// [`NoSearch`]; not finding a feasible design is an answer.
    pub fn optimise(&self, ask: &Ask) -> Result<SearchAnswer, NoSearch> {
        let (starts, most_starts) = ask.starts.map_or((STARTS, MOST_STARTS), |n| (n, n));
        let climb = Settings { max_evaluations: ask.evaluations, ..Settings::default() };
        let seed = self.optimize.as_ref().map_or(1, |task| task.seed);
        let method = Method { climb, starts, most_starts, swarm: ask.swarm, seed };
        let settings = scenario::Settings { tolerance: ask.tolerance, ..Default::default() };
        let fidelity = Fidelity { settings, reduced: !ask.full };
        let mut nobody = Forgetful;
        let found = search(self, &method, fidelity, &Desk::new(&ask.follow, &mut nobody))?;
        let body = Body::of(&found);
        Ok(SearchAnswer { left_out: left_out(&self.clutch), found, body })
    }
}
