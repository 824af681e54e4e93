//! The whole search on a design: influence, dropped variables, SQP, the optimum looked at again more sharply.

use std::sync::atomic::AtomicBool;

use super::evaluate::Failure;
use super::influence::{Influence, influence};
use super::journal::{Journal, Run, Watch};
use super::maximise_least_margin;
use super::outcome::{Outcome, Refusal};
use super::problem::{ClutchProblem, Names};
use super::settings::Settings;
use crate::design::{Design, Optimize};
use crate::margin::Margin;
use crate::scenario;

/// One design variable before and after.
#[derive(Debug, Clone, PartialEq)]
pub struct Variable {
    /// Name with its unit.
    pub name: String,
    /// Lower bound.
    pub min: f64,
    /// Upper bound.
    pub max: f64,
    /// Value in the given design.
    pub start: f64,
    /// Value found.
    pub best: f64,
    /// Dropped from the search because it moves no margin.
    pub dropped: bool,
}

/// Result of a search.
#[derive(Debug, Clone)]
pub struct Search {
    /// Variables in the order of the file.
    pub variables: Vec<Variable>,
    /// Names of objectives and limits.
    pub names: Names,
    /// Margins of the given design.
    pub start: Vec<Margin>,
    /// Margins of the design found, at a tenth of the search's tolerance.
    pub best: Vec<Margin>,
    /// Least slip margin before and after.
    pub objective: (f64, f64),
    /// Change of the least slip margin when the optimum is evaluated at a tenth of the tolerance.
    pub objective_error: f64,
    /// Influence of every variable at the start, margins per range.
    pub influence: Influence,
    /// The optimiser's own account; its vectors hold the variables that were not dropped.
    pub outcome: Outcome,
    /// Design file of the optimum.
    pub file: String,
    /// Evaluations of the clutch in all.
    pub evaluations: usize,
}

impl Search {
    /// Whether every margin of the design found is held.
    pub fn feasible(&self) -> bool {
        self.best.iter().all(Margin::held)
    }

    /// Whether every margin of the given design was held.
    pub fn start_feasible(&self) -> bool {
        self.start.iter().all(Margin::held)
    }
}

/// Why a search did not begin.
#[derive(Debug, Clone, PartialEq)]
pub enum NoSearch {
    /// The design has no `[optimize]` table.
    NoTask,
    /// The given design cannot be evaluated.
    Start(Failure),
    /// The question was refused.
    Refused(Refusal),
    /// Stopped before anything was known.
    Stopped,
}

impl std::fmt::Display for NoSearch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::NoTask => write!(f, "the design has no [optimize] table"),
            Self::Start(e) => write!(f, "the given design cannot be evaluated: {e}"),
            Self::Refused(e) => write!(f, "{e}"),
            Self::Stopped => write!(f, "stopped before the given design was evaluated"),
        }
    }
}

impl std::error::Error for NoSearch {}

/// Search from `design` as its `[optimize]` table says.
///
/// # Errors
/// [`NoSearch`]; not finding a feasible design is a status of the outcome.
pub fn search(
    design: &Design,
    settings: &Settings,
    journal: Journal,
    stop: Option<&AtomicBool>,
    watch: Option<&mut dyn Watch>,
) -> Result<Search, NoSearch> {
    let task = design.optimize.as_ref().ok_or(NoSearch::NoTask)?;
    let simulation = scenario::Settings::default();
    let all: Vec<String> = task.variables.iter().map(|v| v.name.clone()).collect();
    let whole = ClutchProblem::new(design, task, all.clone(), simulation);
    let x0: Vec<f64> = task.variables.iter().map(|v| v.start).collect();
    let start = whole.margins_at(&x0, &simulation).map_err(NoSearch::Start)?;
    let names = ClutchProblem::names(&start);
    let (lo, hi) = bounds(task, &all);
    let refused = |e: Refusal| match e {
        Refusal::StoppedAtStart => NoSearch::Stopped,
        other => NoSearch::Refused(other),
    };
    let here = Run { journal: Journal::default(), stop, watch: None };
    let influence = influence(&whole, &x0, &lo, &hi, settings, here).map_err(refused)?;
    let dropped = influence.without();
    let kept: Vec<usize> = (0..all.len()).filter(|i| !dropped.contains(i)).collect();
    let free: Vec<String> = kept.iter().map(|&i| all[i].clone()).collect();
    let problem = ClutchProblem::new(design, task, free.clone(), simulation);
    let (lo, hi) = bounds(task, &free);
    let x_free: Vec<f64> = kept.iter().map(|&i| x0[i]).collect();
    // Coerced one by one so that the observer's borrow may shrink to the problem's.
    let run = Run { journal, stop, watch: watch.map(|w| w as &mut dyn Watch) };
    let outcome = maximise_least_margin(&problem, &x_free, &lo, &hi, settings, run).map_err(refused)?;
    let sharper = scenario::Settings { tolerance: 0.1 * simulation.tolerance, ..simulation };
    let best = problem.margins_at(&outcome.x, &sharper).map_err(NoSearch::Start)?;
    let file = super::problem::finished_file(&problem, &outcome.x, &task.limits)
        .map_err(|e| NoSearch::Start(Failure::Refused(e.to_string())))?;
    let least = problem.evaluation(&best).least_margin();
    let variables = all
        .iter()
        .enumerate()
        .map(|(i, name)| {
            let place = kept.iter().position(|&k| k == i);
            Variable {
                name: name.clone(),
                min: task.variables[i].min,
                max: task.variables[i].max,
                start: x0[i],
                best: place.map_or(x0[i], |k| outcome.x[k]),
                dropped: place.is_none(),
            }
        })
        .collect();
    Ok(Search {
        variables,
        names,
        objective: (whole.evaluation(&start).least_margin(), least),
        objective_error: (least - outcome.evaluation.least_margin()).abs(),
        start,
        best,
        evaluations: influence.evaluations + outcome.evaluations + 2,
        influence,
        outcome,
        file,
    })
}

fn bounds(task: &Optimize, names: &[String]) -> (Vec<f64>, Vec<f64>) {
    let of = |name: &String| task.variables.iter().find(|v| &v.name == name);
    (
        names.iter().map(|n| of(n).map_or(0.0, |v| v.min)).collect(),
        names.iter().map(|n| of(n).map_or(0.0, |v| v.max)).collect(),
    )
}
