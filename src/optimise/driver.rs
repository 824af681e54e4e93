//! The whole run: climb, restoration where limits cannot be met from here, poll, choice on a plateau.

use super::difference::{Steps, Table};
use super::evaluate::{Evaluate, Evaluation};
use super::journal::{Halt, Memo, SearchRun};
use super::noise;
use super::outcome::{Active, Cause, Iteration, Outcome, Refusal, Residuals, Status};
use super::poll;
use super::settings::Settings;
use super::space::Space;
use super::sqp::{Climb, End, Tally};
use super::starts::rank;
use super::view::{Phase, View};

/// Restorations, and restarts from a better point that the poll found, before giving up.
const REPEATS: usize = 3;
/// First penalty weight; the steering rule raises it.
const FIRST_WEIGHT: f64 = 1.0;
/// Multipliers below this share of their sum are rounding of the interior point.
const INACTIVE: f64 = 1e-5;

/// A point with its margins.
#[derive(Debug, Clone)]
pub(super) struct Point {
    pub u: Vec<f64>,
    pub evaluation: Evaluation,
}

/// Where a climb stopped, and what it knew there.
#[derive(Debug, Clone)]
pub(super) struct Stand {
    pub point: Point,
    pub multipliers: (Vec<f64>, Vec<f64>),
    pub residuals: Residuals,
    pub weight: f64,
    pub table: Table,
}

/// How a climb sets out.
struct SetOut {
    phase: Phase,
    radius: f64,
    weight: f64,
    central: bool,
}

struct Driver<'a, 's> {
    memo: Memo<'a>,
    space: Space,
    settings: &'s Settings,
    noise: Vec<f64>,
    steps: Option<Steps>,
    history: Vec<Iteration>,
    /// Optima known beforehand, and the least margin of the one whose basin this has run into.
    known: Vec<(Vec<f64>, f64)>,
    joined: Option<f64>,
}

/// Maximises the least objective subject to limits >= 0 and lo <= x <= hi, from x0.
///
/// The optimum is local. Deterministic: neither the number of threads nor what the journal already holds changes
/// the path.
///
/// # Errors
/// [`Refusal`] for a malformed question only; every other end is a [`Status`].
pub fn maximise_least_margin<'a>(
    problem: &'a dyn Evaluate,
    x0: &[f64],
    lo: &[f64],
    hi: &[f64],
    settings: &Settings,
    run: SearchRun<'a>,
) -> Result<Outcome, Refusal> {
    settings.validate().map_err(Refusal::Setting)?;
    let space = Space::new(x0, lo, hi)?;
    let known = run.known.iter().map(|(x, least)| (space.scaled(x), *least)).collect();
    let mut memo = Memo::new(problem, run, settings.max_evaluations);
    let evaluation =
        memo.one(x0.to_vec()).map_err(|_| Refusal::StoppedAtStart)?.map_err(Refusal::StartFails)?;
    let start = Point { u: space.start(), evaluation };
    let (noise, history) = (Vec::new(), Vec::new());
    let mut driver = Driver { memo, space, settings, noise, steps: None, history, known, joined: None };
    let mut stand = Stand {
        point: start,
        multipliers: (Vec::new(), Vec::new()),
        residuals: Residuals::default(),
        weight: FIRST_WEIGHT,
        table: Table::unknown(&driver.space),
    };
    let mut chosen = None;
    let mut found = driver.keeping(settings.clearance, &mut stand, &mut chosen);
    if settings.clearance > 0.0 && found.as_ref().is_ok_and(|status| *status != Status::Converged) {
        found = driver.keeping(0.0, &mut stand, &mut chosen);
    }
    let status = match found {
        Ok(status) => status,
        Err(Halt::Limit) => Status::EvaluationLimit,
        Err(Halt::Interrupted) => Status::Interrupted,
    };
    let point = match (&status, chosen) {
        (_, Some(point)) => point,
        (Status::Converged, None) => stand.point.clone(),
        _ => driver.best_seen(&stand.point),
    };
    Ok(driver.outcome(status, point, stand))
}

impl Driver<'_, '_> {
    /// Every phase with `clearance` kept of every limit; what `stand` and `chosen` hold before and after is without.
    fn keeping(
        &mut self,
        clearance: f64,
        stand: &mut Stand,
        chosen: &mut Option<Point>,
    ) -> Result<Status, Halt> {
        let shift = |point: &mut Point, by: f64| point.evaluation = point.evaluation.clone().less(by);
        *chosen = None;
        shift(&mut stand.point, clearance);
        self.memo.clearance = clearance;
        let found = self.main_phase(stand, chosen);
        self.memo.clearance = 0.0;
        [Some(&mut stand.point), chosen.as_mut()].into_iter().flatten().for_each(|p| shift(p, -clearance));
        found
    }

    /// Runs every phase; `stand` follows the main phase, `chosen` is set once a point is better than it.
    fn main_phase(&mut self, stand: &mut Stand, chosen: &mut Option<Point>) -> Result<Status, Halt> {
        let outputs = stand.point.evaluation.outputs();
        self.noise = noise::levels(&mut self.memo, &self.space, &stand.point.u, &outputs, self.settings)?;
        let (mut restored, mut polled) = (0, 0);
        let first = self.settings.first_radius;
        let mut out = SetOut { phase: Phase::Margin, radius: first, weight: FIRST_WEIGHT, central: false };
        loop {
            match self.climb(&out, stand)? {
                End::Converged | End::Feasible => {
                    let polls = self.settings.poll && self.settings.finish;
                    let better = if polls { self.poll(stand, Phase::Margin)? } else { None };
                    let Some(better) = better else { break };
                    if polled == REPEATS {
                        return Ok(Status::Stalled(Cause::NoDescent));
                    }
                    polled += 1;
                    stand.point = better;
                    out = SetOut {
                        radius: 10.0 * self.settings.longest_difference,
                        weight: stand.weight,
                        central: true,
                        ..out
                    };
                }
                End::Joined(least) => {
                    self.joined = Some(least);
                    break;
                }
                End::Stalled(cause) => return Ok(Status::Stalled(cause)),
                End::Violated if restored == REPEATS => return Ok(Status::Stalled(Cause::RestorationCycle)),
                End::Violated => {
                    restored += 1;
                    let mut lower = stand.clone();
                    let restore =
                        SetOut { phase: Phase::Restore, radius: first, weight: FIRST_WEIGHT, central: false };
                    let mut end = self.climb(&restore, &mut lower)?;
                    for _ in 0..REPEATS {
                        if end == End::Feasible || !self.settings.poll {
                            break;
                        }
                        let Some(better) = self.poll(&lower, Phase::Restore)? else { break };
                        lower.point = better;
                        end = self.climb(&restore, &mut lower)?;
                    }
                    let violation = lower.point.evaluation.violation();
                    if violation > self.settings.violation_tolerance {
                        stand.residuals.violation = violation;
                        *chosen = Some(lower.point);
                        return Ok(match end {
                            End::Stalled(cause) => Status::Stalled(cause),
                            _ => Status::Infeasible {
                                least_violation: violation,
                                fighting: above(&lower.multipliers.0, 1e-3),
                            },
                        });
                    }
                    stand.point = lower.point;
                    out.weight = 10.0 * stand.weight;
                }
            }
        }
        *chosen = Some(stand.point.clone());
        if self.settings.finish
            && let Some(point) = self.break_tie(stand)?
        {
            *chosen = Some(point);
        }
        Ok(Status::Converged)
    }

    /// One climb from `stand.point`; `stand` is moved along even when the evaluator halts.
    fn climb(&mut self, out: &SetOut, stand: &mut Stand) -> Result<End, Halt> {
        let mut climb = Climb {
            view: View::new(out.phase, self.memo.shape()),
            memo: &mut self.memo,
            space: &self.space,
            settings: self.settings,
            noise: &self.noise,
            steps: &mut self.steps,
            history: &mut self.history,
            known: &self.known,
            u: stand.point.u.clone(),
            evaluation: stand.point.evaluation.clone(),
            radius: out.radius,
            weight: out.weight,
            central: out.central,
            multipliers: (Vec::new(), Vec::new()),
            residuals: Residuals::default(),
            table: Table::unknown(&self.space),
            taken: None,
            hessian: None,
            level: Vec::new(),
            tally: Tally::default(),
        };
        let end = climb.run();
        *stand = Stand {
            point: Point { u: climb.u, evaluation: climb.evaluation },
            multipliers: climb.multipliers,
            residuals: climb.residuals,
            weight: climb.weight,
            table: climb.table,
        };
        end
    }

    /// A better point than `stand` for `phase`: the best of the record, or one of better merit a difference step away
    /// along the active margins. `None` is the evidence that there is none at that scale.
    fn poll(&mut self, stand: &Stand, phase: Phase) -> Result<Option<Point>, Halt> {
        let view = View::new(phase, self.memo.shape());
        let least = |point: &Point| view.measure(&point.evaluation.outputs()).0;
        let scale = least(&stand.point).abs().max(1.0);
        let noise = view.noise(&self.noise, stand.weight);
        let worth = 10.0 * (self.settings.gain_tolerance * scale + noise);
        let best = self.best_seen(&stand.point);
        if least(&best) > least(&stand.point) + worth {
            return Ok(Some(best));
        }
        let mu: f64 = stand.multipliers.1.iter().sum();
        let weight = stand.weight.max(2.0 * mu);
        let here = view.merit(&stand.point.evaluation, weight);
        let around =
            poll::along_active(stand, &view, &self.space, self.settings.longest_difference, INACTIVE);
        let outcomes = self.memo.batch(around.iter().map(|u| self.space.unscaled(u)).collect())?;
        let found = around.into_iter().zip(outcomes).filter_map(|(u, outcome)| {
            let evaluation = outcome.ok()?;
            let merit = view.merit(&evaluation, weight);
            (merit < here - worth).then_some((merit, Point { u, evaluation }))
        });
        Ok(found.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, point)| point))
    }

    /// On a plateau of the least margin: the point with the lowest tie break, if it is lower than at `stand`.
    fn break_tie(&mut self, stand: &Stand) -> Result<Option<Point>, Halt> {
        let here = &stand.point.evaluation;
        let least = here.least_margin();
        let floor = least - self.settings.plateau * least.abs().max(1.0);
        let scale = if here.tie_break == 0.0 { 1.0 } else { here.tie_break.abs() };
        let phase = Phase::TieBreak { floor, scale };
        let mut lower = stand.clone();
        // Giving up the plateau's width must cost as much as the whole tie break.
        let weight = 1.0 / (least - floor);
        let out = SetOut { phase, radius: self.settings.first_radius, weight, central: true };
        self.climb(&out, &mut lower)?;
        let found = lower.point;
        let tolerance = self.settings.violation_tolerance;
        let held =
            found.evaluation.violation() <= tolerance && found.evaluation.least_margin() >= floor - tolerance;
        Ok((held && found.evaluation.tie_break < here.tie_break).then_some(found))
    }

    /// Best point this run asked for: feasible with the largest least margin, or else with the least violation.
    fn best_seen(&self, fallback: &Point) -> Point {
        let rank = |e: &Evaluation| rank(e, self.settings.violation_tolerance);
        let known = self.memo.known().map(|(x, e)| (rank(e), x, e));
        let best = known.min_by(|a, b| a.0.0.total_cmp(&b.0.0).then(a.0.1.total_cmp(&b.0.1)));
        match best {
            Some((found, x, evaluation)) if found < rank(&fallback.evaluation) => {
                Point { u: self.space.scaled(x), evaluation: evaluation.clone() }
            }
            _ => fallback.clone(),
        }
    }

    fn outcome(self, status: Status, point: Point, stand: Stand) -> Outcome {
        let (objective_multipliers, limit_multipliers) = stand.multipliers;
        let free = self.space.free();
        let on = |bound: f64| free.iter().copied().filter(|&i| point.u[i] == bound).collect();
        let active = Active {
            objectives: above(&objective_multipliers, INACTIVE),
            limits: above(&limit_multipliers, INACTIVE),
            lower: on(0.0),
            upper: on(1.0),
        };
        Outcome {
            status,
            x: self.space.unscaled(&point.u),
            evaluation: point.evaluation,
            objective_multipliers,
            limit_multipliers,
            active,
            residuals: stand.residuals,
            evaluations: self.memo.evaluations(),
            derivatives: self.memo.derivatives,
            failures: self.memo.failures,
            history: self.history,
            journal: self.memo.run.journal,
            joined: self.joined,
        }
    }
}

/// Positions whose value exceeds `share` of max(1, sum).
fn above(values: &[f64], share: f64) -> Vec<usize> {
    let least = share * values.iter().sum::<f64>().max(1.0);
    (0..values.len()).filter(|&i| values[i] > least).collect()
}
