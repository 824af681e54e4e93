//! A climb under tolerances that costs what it costs without: at each corner the margins are those of the clutch as drawn and
//! what the corner takes from them, which is followed by its slopes over the variables.
//!
//! The model has the values and slopes of the true problem where it was made; a point to which its climbs settle meets the
//! first-order conditions of the true one.

use rayon::prelude::*;

use super::corner::{Corner, corners, half_ranges};
use super::desk::Desk;
use super::driver::maximise_least_margin;
use super::evaluate::{Evaluate, Evaluation, NoEvaluation};
use super::journal::SearchRun;
use super::outcome::{Refusal, Status};
use super::problem::ClutchProblem;
use super::robust::{at_each, worse_than_set};
use super::settings::Settings;
use super::starts::SearchMethod;
use crate::clutch::Tolerances;

/// Rounds of model and climb: a choice; they settle in three or four.
const ROUNDS: usize = 10;
/// The climbs have settled when none moves a variable by more than this share of its range.
const SETTLED: f64 = 1e-6;
/// Step of the slopes, as a share of a variable's range.
const STEP: f64 = 1e-3;
/// Up to this many corners all are evaluated in each round: slopes over the quantities would cost as much.
const FEW: usize = 16;

/// Where such climbs have come to.
pub(super) struct NearCorners {
    pub x: Vec<f64>,
    /// Corners followed, the clutch as drawn first.
    pub set: Vec<Corner>,
    /// Converged: the climbs have settled; else of the last one.
    pub status: Status,
    pub evaluations: usize,
}

/// The margins at all corners of a set by the clutch as drawn.
struct Model<'a> {
    drawn: &'a ClutchProblem,
    at: &'a [f64],
    /// Corner by corner what it adds to the outputs, and the slopes of that over each variable.
    blocks: Vec<(Vec<f64>, Vec<Vec<f64>>)>,
}

impl Evaluate for Model<'_> {
    fn evaluate(&self, x: &[f64]) -> Result<Evaluation, NoEvaluation> {
        let drawn = self.drawn.evaluate(x)?;
        let (outputs, count) = (drawn.outputs(), drawn.objectives.len());
        let mut found = Evaluation { objectives: Vec::new(), limits: Vec::new(), tie_break: drawn.tie_break };
        for (added, slopes) in &self.blocks {
            for j in 0..outputs.len() - 1 {
                let moved: f64 = slopes.iter().zip(x).zip(self.at).map(|((s, x), at)| s[j] * (x - at)).sum();
                let value = outputs[j] + added[j] + moved;
                if j < count { found.objectives.push(value) } else { found.limits.push(value) }
            }
        }
        Ok(found)
    }
}

/// The model at `x`, where the corners of `set` are `here`; `None` where some corner has no clutch there or rows of its own.
fn model<'a>(
    drawn: &'a ClutchProblem,
    set: &[Corner],
    here: Vec<Result<Evaluation, NoEvaluation>>,
    x: &'a [f64],
    (lo, hi): (&[f64], &[f64]),
    desk: &Desk,
) -> Option<Model<'a>> {
    let added = |found: Vec<Result<Evaluation, NoEvaluation>>| -> Option<Vec<Vec<f64>>> {
        let found: Vec<Vec<f64>> =
            found.into_iter().map(|e| e.ok().map(|e| e.outputs())).collect::<Option<_>>()?;
        let (width, nominal) = (found[0].len(), found[0].clone());
        let alike = found.iter().all(|row| row.len() == width);
        alike
            .then(|| found.iter().map(|row| row.iter().zip(&nominal).map(|(a, b)| a - b).collect()).collect())
    };
    let here = added(here)?;
    let mut blocks: Vec<(Vec<f64>, Vec<Vec<f64>>)> =
        here.into_iter().map(|added| (added, Vec::new())).collect();
    let steps: Vec<f64> = (0..x.len())
        .map(|i| {
            let step = STEP * (hi[i] - lo[i]);
            if x[i] + step <= hi[i] { step } else { -step }
        })
        .collect();
    let beside: Vec<Vec<Vec<f64>>> = steps
        .par_iter()
        .enumerate()
        .map(|(i, step)| {
            let mut there = x.to_vec();
            there[i] += step;
            added(at_each(drawn, &there, set, desk))
        })
        .collect::<Option<_>>()?;
    for (rows, step) in beside.iter().zip(&steps) {
        for ((added, slopes), row) in blocks.iter_mut().zip(rows) {
            if row.len() != added.len() {
                return None;
            }
            slopes.push(row.iter().zip(added.iter()).map(|(b, a)| (b - a) / step).collect());
        }
    }
    Some(Model { drawn, at: x, blocks })
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
    let drawn = problem.at_corners(vec![Corner::NOMINAL]);
    let settings = Settings { finish: false, ..method.climb.clone() };
    let set = vec![Corner::NOMINAL];
    let mut near = NearCorners { x: x0.to_vec(), set, status: Status::Interrupted, evaluations: 0 };
    for _ in 0..ROUNDS {
        let known = near.set.len();
        let here = worst_corners(&drawn, of, &mut near, desk);
        let none_fresh = near.set.len() == known;
        desk.begins(&format!("robust search on slopes, {} corners", near.set.len()));
        let from = near.x.clone();
        near.evaluations += from.len() * near.set.len();
        let Some(model) = model(&drawn, &near.set, here, &from, (lo, hi), desk) else { break };
        let run = SearchRun { follow: desk.follow(), ..SearchRun::default() };
        let outcome = maximise_least_margin(&model, &from, lo, hi, &settings, run)?;
        near.evaluations += outcome.evaluations;
        near.x = outcome.x;
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

/// The set's corners evaluated, after those have joined it at which a margin is worse than at all others of it; where there are
/// many, of those to which the slopes over the quantities point.
fn worst_corners(
    drawn: &ClutchProblem,
    of: &Tolerances,
    near: &mut NearCorners,
    desk: &Desk,
) -> Vec<Result<Evaluation, NoEvaluation>> {
    let mut ends = corners(of);
    if ends.len() > FEW {
        let alone = alone(of);
        near.evaluations += alone.len();
        ends = steepest(&alone, &at_each(drawn, &near.x, &alone, desk));
    }
    near.evaluations += ends.len() + near.set.len();
    let at_ends = at_each(drawn, &near.x, &ends, desk);
    let mut at_set = at_each(drawn, &near.x, &near.set, desk);
    for corner in worse_than_set(&near.set, &ends, &at_ends, &at_set) {
        at_set.extend(ends.iter().position(|end| *end == corner).map(|i| at_ends[i].clone()));
        near.set.push(corner);
    }
    at_set
}

/// Each quantity with a tolerance at either end, the others as drawn: lower end, upper end, quantity by quantity.
fn alone(of: &Tolerances) -> Vec<Corner> {
    let free = (0..7).filter(|&i| half_ranges(of)[i] > 0.0);
    free.flat_map(|i| [-1.0, 1.0].map(|share| (i, share)))
        .map(|(i, share)| {
            let mut shares = [0.0; 7];
            shares[i] = share;
            Corner { of: *of, shares }
        })
        .collect()
}

/// The corner at which each margin is worst if it is linear in the quantities, by its values where each is off `alone`; corners
/// once each, none where one of those has no clutch.
fn steepest(ends: &[Corner], at_ends: &[Result<Evaluation, NoEvaluation>]) -> Vec<Corner> {
    let values: Vec<Vec<f64>> = at_ends.iter().flatten().map(Evaluation::outputs).collect();
    let width = values.iter().map(Vec::len).min().unwrap_or(0);
    let mut found: Vec<Corner> = Vec::new();
    if values.len() < ends.len() {
        return found;
    }
    for j in 0..width.saturating_sub(1) {
        let mut corner = Corner::NOMINAL;
        for (pair, value) in ends.chunks_exact(2).zip(values.chunks_exact(2)) {
            let worse = if value[0][j] <= value[1][j] { pair[0] } else { pair[1] };
            corner.of = worse.of;
            corner.shares = std::array::from_fn(|i| corner.shares[i] + worse.shares[i]);
        }
        if !found.contains(&corner) {
            found.push(corner);
        }
    }
    found
}
