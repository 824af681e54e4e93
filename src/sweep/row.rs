//! Margins at a point, as a sweep counts them.

use super::sampling::{BoxSample, NoSample, Sampling};
use crate::design::{Design, Optimize};
use crate::follow::Follow;
use crate::margin::RESOLUTION;
use crate::optimise::{ClutchProblem, Evaluate, Evaluation, Names};
use rayon::prelude::*;

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
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum NoSweep {
    /// The design has no `[optimize]` table.
    #[error("{}", NoSample::NoTask)]
    NoTask,
    /// There is no clutch at the start, nor at any of the first points of the box; the reason at the start.
    #[error("no clutch at the start nor at {LOOKED_AT} points of the box; at the start: {0}")]
    Nowhere(String),
}

/// Points of the box that are asked for the names of the rows where the start is no clutch: a choice.
const LOOKED_AT: u64 = 256;

/// What there is at one point.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepRow {
    /// Values of the variables, in the units of their names.
    pub x: Vec<f64>,
    /// Objectives and limits, or why there is no clutch.
    pub found: Result<Evaluation, String>,
    /// What the least slip margin, where that is an objective, leaves of the wanted one.
    pub wanted_left: Option<f64>,
}

/// What decides at a point, by its place among its like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Decides {
    /// A limit.
    Limit(usize),
    /// An objective whose slip margin is less than is wanted.
    Objective(usize),
}

impl SweepRow {
    /// The least objective; none where nothing is raised, as slip without scenes.
    pub fn least(&self) -> Option<f64> {
        self.found.as_ref().ok().map(Evaluation::least_margin).filter(|least| least.is_finite())
    }

    /// What decides, and its margin: the least of all limits and of a wanted slip margin; 0 or more is held.
    pub fn deciding(&self) -> Option<(Decides, f64)> {
        let found = self.found.as_ref().ok()?;
        let least = |values: &[f64]| values.iter().copied().enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
        let limit = least(&found.limits).map(|(i, left)| (Decides::Limit(i), left));
        let raised = least(&found.objectives).map(|(i, _)| Decides::Objective(i)).zip(self.wanted_left);
        limit.into_iter().chain(raised).min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Whether there is a clutch that holds every limit, the wanted slip margin among them.
    pub fn feasible(&self) -> bool {
        self.deciding().map_or(self.found.is_ok(), |(_, left)| left >= -RESOLUTION)
    }
}

/// How a sweep over points ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SweepEnd {
    /// Behind the last point.
    Whole,
    /// Where nobody wanted more.
    Enough,
    /// Where it was stopped; what was under way is lost.
    Stopped,
}

/// Points that a thread is given at once.
const CHUNK: usize = 64;

/// Gives points with their numbers, in order; `None` behind the last.
pub type NextPoint<'n, E> = dyn FnMut() -> Result<Option<(u64, Vec<f64>)>, E> + 'n;

impl Sweep {
    /// What there is at the points that `next` gives, some at once on all threads: what is in memory does not grow with their count.
    /// `made` is asked on any thread; `take` gets what it made, in order, and says whether more is wanted. The same for any number of
    /// threads.
    ///
    /// # Errors
    /// What `next` or `take` says.
    pub fn rows<T: Send, E>(
        &self,
        follow: &Follow,
        next: &mut NextPoint<'_, E>,
        made: impl Fn(u64, &SweepRow) -> T + Sync,
        mut take: impl FnMut(Vec<T>) -> Result<bool, E>,
    ) -> Result<SweepEnd, E> {
        let most = CHUNK * rayon::current_num_threads();
        loop {
            let mut chunk = Vec::with_capacity(most);
            while chunk.len() < most
                && let Some(point) = next()?
            {
                chunk.push(point);
            }
            if chunk.is_empty() {
                return Ok(SweepEnd::Whole);
            }
            let of = |(index, x)| (!follow.stopped()).then(|| made(index, &self.row(x)));
            let rows: Option<Vec<T>> = chunk.into_par_iter().map(of).collect();
            let Some(rows) = rows else { return Ok(SweepEnd::Stopped) };
            if !take(rows)? {
                return Ok(SweepEnd::Enough);
            }
        }
    }

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
        let wanted_left = found.as_ref().ok().and_then(|e| self.problem.wanted_left(e));
        SweepRow { x, found, wanted_left }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_come_in_order_until_enough_or_stopped() {
        let text = include_str!("../../designs/huang2017-multi-arc.toml");
        let design = Design::parse(text, "a.toml").unwrap();
        let settings = SweepSettings { at_rest: true, full: false };
        let sweep = Sweep::of(&design, &settings).unwrap();
        let sampling = Sampling::Sobol { count: 300, seed: 1 };
        let sample = BoxSample::of(sweep.task(), &sampling).unwrap();
        let run = |follow: &Follow, most: usize| {
            let (mut left, mut found) = (0..sample.count(), Vec::new());
            let mut next = || Ok::<_, String>(left.next().map(|i| (i, sample.point(i))));
            let end = sweep.rows(
                follow,
                &mut next,
                |i, row| (i, row.clone()),
                |rows| {
                    found.extend(rows);
                    Ok(found.len() < most)
                },
            );
            (end, found)
        };
        let (end, whole) = run(&Follow::new(), usize::MAX);
        assert_eq!((end, whole.len()), (Ok(SweepEnd::Whole), 300));
        for (i, row) in &whole {
            assert_eq!(*row, sweep.row(sample.point(*i)));
        }
        let (end, part) = run(&Follow::new(), 1);
        assert_eq!((end, &part[..]), (Ok(SweepEnd::Enough), &whole[..part.len()]));
        assert!(part.len() < 300 || rayon::current_num_threads() > 4);
        let stopped = Follow::new();
        stopped.stop();
        assert_eq!(run(&stopped, usize::MAX), (Ok(SweepEnd::Stopped), Vec::new()));
    }
}
