//! Margins at a point, as a sweep counts them.

use super::sampling::{BoxSample, NoSample, Sampling};
use crate::design::{Design, Optimize};
use crate::margin::RESOLUTION;
use crate::optimise::{ClutchProblem, Evaluate, Evaluation, Names};
use std::fmt;

/// What is looked at at each point of a sweep.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct SweepSettings {
    /// Statics alone, without scenes.
    pub at_rest: bool,
    /// Everything, also what a scene cannot feel.
    pub full: bool,
}

/// A problem and the names of its rows, which are the same at every point.
#[derive(Debug, Clone)]
pub struct Sweep {
    problem: ClutchProblem,
    task: Optimize,
    names: Names,
}

/// Why a design has no sweep.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NoSweep {
    /// The design has no `[optimize]` table.
    NoTask,
    /// There is no clutch at the start, nor at any of the first points of the box; the reason at the start.
    Nowhere(String),
}

impl fmt::Display for NoSweep {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoTask => NoSample::NoTask.fmt(f),
            Self::Nowhere(why) => {
                write!(f, "no clutch at the start nor at {LOOKED_AT} points of the box; at the start: {why}")
            }
        }
    }
}

impl std::error::Error for NoSweep {}

/// Points of the box that are asked for the names of the rows where the start is no clutch: a choice.
const LOOKED_AT: u64 = 256;

/// What there is at one point.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepRow {
    /// Values of the variables, in the units of their names.
    pub x: Vec<f64>,
    /// Objectives and limits, or why there is no clutch.
    pub found: Result<Evaluation, String>,
}

impl SweepRow {
    /// The least objective; none where nothing is raised, as slip without scenes.
    pub fn least(&self) -> Option<f64> {
        self.found.as_ref().ok().map(Evaluation::least_margin).filter(|least| least.is_finite())
    }

    /// Place and value of the limit that decides: the least of all; 0 or more is held.
    pub fn deciding(&self) -> Option<(usize, f64)> {
        let limits = self.found.as_ref().ok()?.limits.iter().copied().enumerate();
        limits.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Whether there is a clutch that holds every limit.
    pub fn feasible(&self) -> bool {
        self.found.as_ref().is_ok_and(|e| e.violation() <= RESOLUTION)
    }
}

impl Sweep {
    /// Of the `[optimize]` table of `design`; `at_rest`: without its scenes, `full`: nothing is left out that a scene cannot feel.
    ///
    /// # Errors
    /// [`NoSweep`].
    pub fn of(design: &Design, settings: &SweepSettings) -> Result<Self, NoSweep> {
        let task = design.optimize.clone().ok_or(NoSweep::NoTask)?;
        let problem = ClutchProblem::of_task(design, &task, settings.full);
        let problem = if settings.at_rest { problem.at_rest() } else { problem };
        let names = |x: &[f64]| problem.assess_at(x).map(|assessed| problem.names(&assessed));
        let start: Vec<f64> = task.variables.iter().map(|v| v.start).collect();
        let elsewhere = || {
            let sample = BoxSample::of(&task, &Sampling::Sobol { count: LOOKED_AT, seed: 0 }).ok()?;
            (0..sample.count()).find_map(|i| names(&sample.point(i)).ok())
        };
        let names =
            names(&start).or_else(|why| elsewhere().ok_or_else(|| NoSweep::Nowhere(why.to_string())))?;
        Ok(Self { problem, task, names })
    }

    /// Names of the rows' objectives and limits.
    pub fn names(&self) -> &Names {
        &self.names
    }

    /// Variables, bounds, objective.
    pub fn task(&self) -> &Optimize {
        &self.task
    }

    /// What there is at `x`, values of the variables in the file's order and units. A point beyond its bounds is refused.
    pub fn row(&self, x: Vec<f64>) -> SweepRow {
        let shape = Some((self.names.objectives.len(), self.names.limits.len()));
        let found = match self.task.outside(&x) {
            Some(why) => Err(why),
            None => self.problem.evaluate(&x).and_then(|e| e.checked(shape)).map_err(|why| why.to_string()),
        };
        SweepRow { x, found }
    }
}
