//! A climb under tolerances that costs what it costs without: at each corner the margins are those of the clutch as drawn and
//! what the corner takes from them, which is followed by its slopes over the variables.
//!
//! The model has the values and slopes of the true problem where it was made; a point to which its climbs settle meets the
//! first-order conditions of the true one.

use rayon::prelude::*;

use super::corner::{Corner, corners, half_ranges};
use super::desk::Desk;
use super::difference::own_slopes;
use super::driver::maximise_least_margin;
use super::evaluate::{Evaluate, Evaluation, NoEvaluation};
use super::journal::{Memo, SearchRun};
use super::outcome::{Refusal, Status};
use super::problem::ClutchProblem;
use super::robust::{Passed, at_each, worse_than_set};
use super::settings::Settings;
use super::space::Space;
use super::starts::SearchMethod;
use crate::clutch::Tolerances;

/// Rounds of model and climb: a choice; they settle in three or four.
const ROUNDS: usize = 10;
/// The climbs have settled when none moves a variable by more than this share of its range.
const SETTLED: f64 = 1e-6;
/// They have come near when the least margin of all corners changes by no more than this part: a climb at the corners themselves
/// is the shorter way from there.
const NEAR: f64 = 1e-4;
/// Step of the slopes where a problem has none itself, as a share of a variable's range.
const STEP: f64 = 1e-3;
/// Up to this many corners all are evaluated in each round: slopes over the quantities would cost as much.
const FEW: usize = 4;

/// Where such climbs have come to.
pub(super) struct NearCorners {
    pub x: Vec<f64>,
    /// Corners followed, the clutch as drawn first.
    pub set: Vec<Corner>,
    /// Converged: the climbs have settled; else of the last one.
    pub status: Status,
    pub evaluations: usize,
    /// Derivatives along one variable beside them.
    pub derivatives: usize,
    /// Where its climbs ended.
    pub passed: Vec<Passed>,
}

/// The margins at all corners of a set by the clutch as drawn.
struct Model<'a> {
    drawn: &'a ClutchProblem,
    at: &'a [f64],
    /// Corner by corner what it adds to the outputs, and the slopes of that over each variable.
    blocks: Vec<(Vec<f64>, Vec<Vec<f64>>)>,
    /// How many of a corner's outputs are objectives.
    objectives: usize,
}

impl Model<'_> {
    /// What each corner makes of a row of the clutch as drawn: `more` of an output is added. Objectives, limits, the tie break.
    fn at_corners(&self, drawn: &[f64], more: impl Fn(&(Vec<f64>, Vec<Vec<f64>>), usize) -> f64) -> Vec<f64> {
        let last = drawn.len() - 1;
        let (mut objectives, mut limits) = (Vec::new(), Vec::new());
        for block in &self.blocks {
            let row = |j: usize| drawn[j] + more(block, j);
            objectives.extend((0..self.objectives).map(row));
            limits.extend((self.objectives..last).map(row));
        }
        [objectives, limits, vec![drawn[last]]].concat()
    }
}

/// sum of the slopes of output `j` times the way from `from` to `to`.
fn along(slopes: &[Vec<f64>], j: usize, from: &[f64], to: &[f64]) -> f64 {
    slopes.iter().zip(to.iter().zip(from)).map(|(s, (to, from))| s[j] * (to - from)).sum()
}

impl Evaluate for Model<'_> {
    fn evaluate(&self, x: &[f64]) -> Result<Evaluation, NoEvaluation> {
        let drawn = self.drawn.evaluate(x)?;
        let mut row =
            self.at_corners(&drawn.outputs(), |(added, slopes), j| added[j] + along(slopes, j, self.at, x));
        row.truncate(row.len() - 1);
        let limits = row.split_off(self.objectives * self.blocks.len());
        Ok(Evaluation { objectives: row, limits, tie_break: drawn.tie_break })
    }

    fn changes(&self, x: &[f64], beside: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
        let drawn = self.drawn.changes(x, beside)?;
        let change = |(row, to): (Vec<f64>, &Vec<f64>)| match row.is_empty() {
            true => row,
            false => self.at_corners(&row, |(_, slopes), j| along(slopes, j, x, to)),
        };
        Some(drawn.into_iter().zip(beside).map(change).collect())
    }
}

/// Slopes of the outputs of `problem` at `x` over each variable, `[variable][output]`; `here`: the outputs there. Its own, or where
/// it has none differences; `None` where there is no clutch beside it.
fn slopes_of(
    problem: &ClutchProblem,
    here: &[f64],
    x: &[f64],
    (lo, hi): (&[f64], &[f64]),
    (evaluations, derivatives): (&mut usize, &mut usize),
    desk: &Desk,
) -> Option<Vec<Vec<f64>>> {
    let own = desk.run(problem, |problem, run| {
        let space = Space::new(x, lo, hi).ok()?;
        let mut memo = Memo::new(problem, run, usize::MAX);
        let found = own_slopes(&mut memo, &space, &space.start(), here.len());
        *derivatives += memo.derivatives;
        found.ok()?.filter(|rows| rows.iter().flatten().all(|slope| slope.is_finite()))
    });
    if let Some(rows) = own {
        let over = |i: usize| rows.iter().map(|row| row[i] / (hi[i] - lo[i])).collect();
        return Some((0..x.len()).map(over).collect());
    }
    *evaluations += x.len();
    (0..x.len())
        .map(|i| {
            let step = STEP * (hi[i] - lo[i]);
            let step = if x[i] + step <= hi[i] { step } else { -step };
            let mut there = x.to_vec();
            there[i] += step;
            let beside = desk.look(problem, &there).ok()?.outputs();
            let alike = beside.len() == here.len();
            alike.then(|| beside.iter().zip(here).map(|(b, a)| (b - a) / step).collect())
        })
        .collect()
}

/// The model at `x`, where the corners of the set have the outputs `here`; `None` where some corner has no clutch there or rows of
/// its own.
fn model<'a>(
    problems: &'a [ClutchProblem],
    here: &[Result<Evaluation, NoEvaluation>],
    near: &mut NearCorners,
    x: &'a [f64],
    bounds: (&[f64], &[f64]),
    desk: &Desk,
) -> Option<Model<'a>> {
    let objectives = here[0].as_ref().ok()?.objectives.len();
    let outputs: Vec<Vec<f64>> =
        here.iter().map(|e| e.as_ref().ok().map(Evaluation::outputs)).collect::<Option<_>>()?;
    if outputs.iter().any(|row| row.len() != outputs[0].len()) {
        return None;
    }
    let mut slopes = Vec::new();
    for (problem, here) in problems.iter().zip(&outputs) {
        let spent = (&mut near.evaluations, &mut near.derivatives);
        slopes.push(slopes_of(problem, here, x, bounds, spent, desk)?);
    }
    let less = |row: &[f64], drawn: &[f64]| row.iter().zip(drawn).map(|(a, b)| a - b).collect::<Vec<_>>();
    let blocks = outputs.iter().zip(&slopes).map(|(row, own)| {
        let added = own.iter().zip(&slopes[0]).map(|(own, drawn)| less(own, drawn));
        (less(row, &outputs[0]), added.collect())
    });
    Some(Model { drawn: &problems[0], at: x, blocks: blocks.collect(), objectives })
}

/// Climb on such models from `x0` until the climbs settle; the worst corners of every margin are looked for at each end.
///
/// # Errors
/// As [`maximise_least_margin`].
pub(super) fn climb_on_slopes(
    problem: &ClutchProblem,
    x0: &[f64],
    (lo, hi): (&[f64], &[f64]),
    of: &Tolerances,
    method: &SearchMethod,
    desk: &Desk,
) -> Result<NearCorners, Refusal> {
    let settings = Settings { finish: false, ..method.climb.clone() };
    let set = vec![Corner::NOMINAL];
    let (x, status) = (x0.to_vec(), Status::Interrupted);
    let mut near = NearCorners { x, set, status, evaluations: 0, derivatives: 0, passed: Vec::new() };
    // Each with what it knows of its latest evaluation, for its slopes there.
    let mut problems = vec![problem.at_corners(vec![Corner::NOMINAL])];
    let mut before = f64::NAN;
    for round in 0..ROUNDS {
        desk.begins(&format!("robust search on slopes, {} corners", near.set.len()));
        let known = near.set.len();
        let here = worst_corners(&mut problems, of, &mut near, round, desk);
        let none_fresh = near.set.len() == known;
        let worst = here.iter().flatten().map(Evaluation::least_margin).fold(f64::INFINITY, f64::min);
        if none_fresh && (worst - before).abs() <= NEAR * worst.abs() {
            break;
        }
        before = worst;
        let from = near.x.clone();
        let Some(model) = model(&problems, &here, &mut near, &from, (lo, hi), desk) else { break };
        let run = SearchRun { follow: desk.follow(), ..SearchRun::default() };
        let outcome = maximise_least_margin(&model, &from, lo, hi, &settings, run)?;
        near.evaluations += outcome.evaluations;
        near.derivatives += outcome.derivatives;
        near.x = outcome.x;
        let (x, evaluations, derivatives) = (near.x.clone(), near.evaluations, near.derivatives);
        near.passed.push(Passed { x, evaluations, derivatives });
        let moved = (0..lo.len()).map(|i| (near.x[i] - from[i]).abs() / (hi[i] - lo[i])).fold(0.0, f64::max);
        near.status = outcome.status;
        if desk.stopped() || none_fresh && moved <= SETTLED {
            return Ok(near);
        }
    }
    // Not settled: what follows begins from here, and looks for itself.
    near.status = Status::Interrupted;
    Ok(near)
}

/// Rounds in which the slopes over the quantities are taken: later ones move the clutch too little to turn them.
const TURNING: usize = 2;

/// The set's corners evaluated, after those have joined it at which a margin is worse than at all others of it; where there are
/// many, of those to which the slopes over the quantities point.
fn worst_corners(
    problems: &mut Vec<ClutchProblem>,
    of: &Tolerances,
    near: &mut NearCorners,
    round: usize,
    desk: &Desk,
) -> Vec<Result<Evaluation, NoEvaluation>> {
    let x = near.x.clone();
    near.evaluations += problems.len();
    let mut at_set: Vec<_> = problems.par_iter().map(|problem| desk.look(problem, &x)).collect();
    let mut ends = corners(of);
    if ends.len() > FEW {
        if round >= TURNING {
            return at_set;
        }
        let alone = alone(of);
        near.evaluations += alone.len();
        ends = steepest(&alone, &at_each(&problems[0], &x, &alone, desk), &at_set[0]);
        ends.retain(|end| !near.set.contains(end));
    }
    near.evaluations += ends.len();
    let at_ends: Vec<ClutchProblem> = ends.iter().map(|end| problems[0].at_corners(vec![*end])).collect();
    let found: Vec<_> = at_ends.par_iter().map(|problem| desk.look(problem, &x)).collect();
    let fresh = worse_than_set(&near.set, &ends, &found, &at_set);
    for ((corner, problem), evaluation) in ends.into_iter().zip(at_ends).zip(found) {
        if fresh.contains(&corner) {
            at_set.push(evaluation);
            problems.push(problem);
            near.set.push(corner);
        }
    }
    at_set
}

/// Each quantity with a tolerance at its upper end, the others as drawn.
fn alone(of: &Tolerances) -> Vec<Corner> {
    let free = (0..7).filter(|&i| half_ranges(of)[i] > 0.0);
    free.map(|i| {
        let mut shares = [0.0; 7];
        shares[i] = 1.0;
        Corner { of: *of, shares }
    })
    .collect()
}

/// The corner at which each margin is worst if it is linear in the quantities, by its values where each is off `alone` and where
/// none is; corners once each, none where one of those has no clutch.
fn steepest(
    alone: &[Corner],
    at_alone: &[Result<Evaluation, NoEvaluation>],
    drawn: &Result<Evaluation, NoEvaluation>,
) -> Vec<Corner> {
    let values: Vec<Vec<f64>> = at_alone.iter().flatten().map(Evaluation::outputs).collect();
    let drawn = drawn.as_ref().map_or_else(|_| Vec::new(), Evaluation::outputs);
    let width = values.iter().map(Vec::len).fold(drawn.len(), usize::min);
    let mut found: Vec<Corner> = Vec::new();
    if values.len() < alone.len() {
        return found;
    }
    for j in 0..width.saturating_sub(1) {
        let mut corner = Corner::NOMINAL;
        for (upper, value) in alone.iter().zip(&values) {
            let worse = if value[j] <= drawn[j] { 1.0 } else { -1.0 };
            corner.of = upper.of;
            corner.shares = std::array::from_fn(|i| corner.shares[i] + worse * upper.shares[i]);
        }
        if !found.contains(&corner) {
            found.push(corner);
        }
    }
    found
}
