//! One climb: trust-region SQP on the exact penalty function, for one phase.
//!
//! Method: Fletcher's Sl1QP for composite functions (*Practical Methods of Optimization*, 14.4-14.5) with the
//! largest violation as penalty term: phi = -min_i m_i + weight max_j(0, -c_j). Its subproblem is a QP that is
//! feasible whatever the limits, so one machine serves feasible and infeasible points; a trust region in the
//! largest norm is just bounds, and bounds the step where the quasi-Newton model is still wrong; one re-solve
//! with the values at the trial point (second-order correction) keeps the corner of phi from blocking full steps.
//! The weight follows the steering rule of Byrd, Nocedal and Waltz (Optim. Methods Softw. 23 (2008) 197): the step
//! must remove a tenth of the violation that the radius can remove at all.

use nalgebra::DMatrix;

use super::difference::{Steps, Table, table};
use super::evaluate::Evaluation;
use super::hessian;
use super::journal::{Halt, Memo};
use super::outcome::{Cause, Iteration, Residuals, Tried};
use super::qp::{self, Ask, Linear, Step};
use super::settings::Settings;
use super::space::Space;
use super::view::{Phase, View};

/// Share of the predicted gain below which a step is refused: a new derivative table costs more than a retry.
const ACCEPTED: f64 = 0.1;
/// Share below which the second-order correction is tried; it costs one evaluation, a derivative table many.
const CORRECTED: f64 = 0.9;
/// Penalty weight, relative to the first, at which the limits are taken to have no common point nearby.
const HEAVIEST: f64 = 1e8;
/// Share of the violation left by a step of some length at which restoration takes over.
const HOPELESS: f64 = 0.9;
/// Times a climb may lower a weight that proved far above the multipliers; bounded, so that the merit falls at last.
const LOWERINGS: usize = 8;
/// Times a climb may forget its Hessian.
const RESETS: usize = 2;
/// Distance from a bound that counts as on it.
const ON_BOUND: f64 = 1e-9;

/// Why a climb ended.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum End {
    /// Residuals below the tolerances.
    Converged,
    /// Restoration has come to a point with no limit violated.
    Feasible,
    /// Stationary, or out of steps, with limits violated.
    Violated,
    Stalled(Cause),
}

/// State of a climb.
pub(super) struct Climb<'a, 'm> {
    pub memo: &'a mut Memo<'m>,
    pub space: &'a Space,
    pub settings: &'a Settings,
    pub noise: &'a [f64],
    pub steps: &'a mut Option<Steps>,
    pub history: &'a mut Vec<Iteration>,
    pub view: View,
    pub u: Vec<f64>,
    pub evaluation: Evaluation,
    pub radius: f64,
    pub weight: f64,
    pub central: bool,
    /// Multipliers of the phase's margins and limits at the last subproblem.
    pub multipliers: (Vec<f64>, Vec<f64>),
    pub residuals: Residuals,
    /// Derivatives at `u`, once known.
    pub table: Option<Table>,
}

/// Trial of one step.
struct Trial {
    u: Vec<f64>,
    evaluation: Evaluation,
    ratio: f64,
    corrected: bool,
}

impl Climb<'_, '_> {
    /// Climbs until the residuals are small, nothing more is gained, or the evaluator halts.
    pub fn run(&mut self) -> Result<End, Halt> {
        let mut b: Option<DMatrix<f64>> = None;
        let (mut resets, mut lowered) = (0, 0);
        let mut t = self.derive()?;
        for _ in 0..self.settings.max_iterations {
            let outputs = self.evaluation.outputs();
            let (least, violation) = self.view.measure(&outputs);
            if self.view.phase == Phase::Restore && least >= 0.0 {
                return Ok(End::Feasible);
            }
            let free: Vec<usize> = self.space.free().into_iter().filter(|i| !t.held.contains(i)).collect();
            if free.is_empty() {
                return Ok(self.end(violation, t.held));
            }
            let linear = self.view.linear(&outputs, &t, &free);
            let known = match &mut b {
                Some(b) => b,
                None => b.insert(self.first_hessian(&t, &linear, &free)),
            };
            let part = DMatrix::from_fn(free.len(), free.len(), |i, k| known[(free[i], free[k])]);
            let Some(step) = self.subproblem(&linear, &part, &free, violation) else {
                return Ok(End::Stalled(Cause::Subproblem));
            };
            let mut d = vec![0.0; self.space.len()];
            for (&i, di) in free.iter().zip(&step.d) {
                d[i] = *di;
            }
            let gain = (step.rise - least) + self.weight * (violation - step.elastic)
                - half_quadratic(&part, &step.d);
            let length = d.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
            self.multipliers = (step.rise_multipliers.clone(), step.limit_multipliers.clone());
            self.residuals = Residuals { kkt: self.kkt(&t), gain, step: length, violation };
            let scale = least.abs().max(1.0);
            // Once steps are as short as the difference step, the error f'' h/2 of a forward difference is as large as
            // the change of slope that the step is after.
            let coarse = self.settings.shortest_difference;
            let small = match self.view.phase {
                Phase::TieBreak { .. } => gain <= self.settings.tie_break_gain,
                _ => {
                    gain <= self.settings.gain_tolerance * scale
                        && self.residuals.kkt <= self.settings.optimality_tolerance * scale
                }
            };
            if !self.central && (small || length <= coarse) {
                self.central = true;
                self.radius = self.radius.max(10.0 * coarse);
                t = self.derive()?;
                continue;
            }
            let met = violation <= self.settings.violation_tolerance;
            if !met && step.elastic > HOPELESS * violation && self.radius >= 10.0 * coarse {
                self.record(Tried::Nothing);
                return Ok(End::Violated);
            }
            if small && (met || step.elastic > 0.9 * violation) {
                self.record(Tried::Nothing);
                return Ok(self.end(violation, t.held));
            }
            if gain <= 0.0 {
                // Not the minimum of a convex model: the Hessian has outgrown the subproblem's accuracy.
                if resets == RESETS {
                    return Ok(End::Stalled(Cause::Subproblem));
                }
                resets += 1;
                b = None;
                continue;
            }
            let slack = 10.0 * self.view.noise(self.noise);
            match self.attempt(&linear, &part, &free, &d, gain, slack)? {
                Some(trial) if trial.ratio >= ACCEPTED => {
                    if trial.ratio > 0.75 && length >= 0.99 * self.radius {
                        self.radius = (2.0 * self.radius).min(1.0);
                    } else if trial.ratio < 0.25 {
                        self.radius = 0.5 * length;
                    }
                    let weights = self.view.weights(&self.multipliers.0, &self.multipliers.1, outputs.len());
                    let s: Vec<f64> = trial.u.iter().zip(&self.u).map(|(a, b)| a - b).collect();
                    self.record(if trial.corrected { Tried::Corrected } else { Tried::Accepted });
                    (self.u, self.evaluation) = (trial.u, trial.evaluation);
                    let next = self.derive()?;
                    let y: Vec<f64> = (0..s.len())
                        .map(|i| {
                            weights
                                .iter()
                                .zip(next.slopes.iter().zip(&t.slopes))
                                .map(|(w, (a, b))| w * (a[i] - b[i]))
                                .sum()
                        })
                        .collect();
                    let needed: f64 = self.multipliers.1.iter().sum();
                    if lowered < LOWERINGS && needed > 0.0 && self.weight > 8.0 * needed {
                        self.weight = 2.0 * needed;
                        lowered += 1;
                    }
                    if let Some(b) = &mut b {
                        if let Some(c) = &next.curvatures {
                            let bend: Vec<f64> = (0..s.len())
                                .map(|i| weights.iter().zip(c).map(|(w, c)| w * c[i]).sum())
                                .collect();
                            hessian::rescale(b, &bend);
                        }
                        hessian::update(b, &s, &y);
                    }
                    t = next;
                }
                refused => {
                    let refused_by_failure = refused.is_none();
                    self.record(if refused_by_failure { Tried::Failed } else { Tried::Refused });
                    // Minimum of the parabola through the merit at both ends of the step and its predicted slope.
                    let shrink = refused.map_or(0.4, |r| (0.5 / (1.0 - r.ratio)).clamp(0.1, 0.5));
                    self.radius = shrink * length;
                    let too_short = match (self.view.phase, refused_by_failure) {
                        (Phase::TieBreak { .. }, _) => coarse,
                        (_, true) => 0.1 * coarse,
                        _ => 1e-8,
                    };
                    if self.radius >= too_short {
                        continue;
                    }
                    if matches!(self.view.phase, Phase::TieBreak { .. }) {
                        return Ok(End::Converged);
                    }
                    if !self.central || resets < RESETS {
                        resets += usize::from(self.central);
                        self.central = true;
                        self.radius = coarse;
                        b = None;
                        t = self.derive()?;
                        continue;
                    }
                    return Ok(if violation > self.settings.violation_tolerance {
                        End::Violated
                    } else if refused_by_failure {
                        End::Stalled(Cause::FailingRegion)
                    } else {
                        End::Stalled(Cause::NoDescent)
                    });
                }
            }
        }
        Ok(End::Stalled(Cause::IterationLimit))
    }

    /// End at a stationary point.
    fn end(&self, violation: f64, held: Vec<usize>) -> End {
        if !held.is_empty() {
            End::Stalled(Cause::NoDerivative(held))
        } else if violation <= self.settings.violation_tolerance {
            End::Converged
        } else {
            End::Violated
        }
    }

    /// Derivative table at the present point.
    fn derive(&mut self) -> Result<Table, Halt> {
        let outputs = self.evaluation.outputs();
        let shortest = Steps::shortest(self.space.len(), self.settings);
        let steps = self.steps.as_ref().unwrap_or(&shortest);
        let central = self.central || self.steps.is_none();
        let h = if central { steps.central.clone() } else { steps.forward.clone() };
        let found = table(self.memo, self.space, &self.u, &outputs, &h, central)?;
        if let Some(fitted) = Steps::fitted(&found, self.noise, self.settings) {
            *self.steps = Some(match self.steps.take() {
                Some(known) => known.least(&fitted),
                None => fitted,
            });
        }
        self.table = Some(found.clone());
        Ok(found)
    }

    /// Diagonal of the Lagrangian's Hessian where the table has it, else a mild multiple of the identity: curvature
    /// that would turn a hundredth of the steepest slope over the range.
    fn first_hessian(&self, t: &Table, linear: &Linear, free: &[usize]) -> DMatrix<f64> {
        let n = self.space.len();
        let steepest = linear.rises.iter().flat_map(|r| &r.1).fold(0.0, |m: f64, g| m.max(g.abs()));
        let mild = if steepest > 0.0 { 1e-2 * steepest } else { 1e-3 };
        let mut b = DMatrix::from_diagonal_element(n, n, mild);
        if let Some(curvatures) = &t.curvatures {
            let part = DMatrix::from_diagonal_element(free.len(), free.len(), mild);
            let (lower, upper) = self.window(free);
            let ask = Ask::Merit { weight: self.weight };
            if let Some(step) = qp::solve(linear, &part, &lower, &upper, ask) {
                let weights =
                    self.view.weights(&step.rise_multipliers, &step.limit_multipliers, curvatures.len());
                for i in 0..n {
                    let bend: f64 = weights.iter().zip(curvatures).map(|(w, c)| w * c[i]).sum();
                    b[(i, i)] = bend.max(mild);
                }
            }
        }
        b
    }

    /// Range of the step: the trust region cut by the bounds.
    fn window(&self, free: &[usize]) -> (Vec<f64>, Vec<f64>) {
        free.iter().map(|&i| ((-self.u[i]).max(-self.radius), (1.0 - self.u[i]).min(self.radius))).unzip()
    }

    /// Solves the subproblem, raising the weight until the step does its share against the violation.
    fn subproblem(
        &mut self,
        linear: &Linear,
        b: &DMatrix<f64>,
        free: &[usize],
        violation: f64,
    ) -> Option<Step> {
        let (lower, upper) = self.window(free);
        let solve = |weight| qp::solve(linear, b, &lower, &upper, Ask::Merit { weight });
        let mut step = solve(self.weight)?;
        // What clarabel's tolerance leaves of the steepest limit over the range is not a violation of the model.
        let steepest = linear.limits.iter().flat_map(|r| &r.1).fold(0.0, |m: f64, g| m.max(g.abs()));
        let reach = self.settings.violation_tolerance.max(1e-9 * steepest);
        if step.elastic <= reach {
            return Some(step);
        }
        let least = qp::solve(linear, b, &lower, &upper, Ask::Feasibility).map_or(0.0, |s| s.elastic);
        let wanted = if least <= reach { reach } else { violation - 0.1 * (violation - least) };
        while step.elastic > wanted.max(least + reach) && self.weight < HEAVIEST {
            let Some(next) = solve(4.0 * self.weight) else { break };
            self.weight *= 4.0;
            step = next;
        }
        Some(step)
    }

    /// Evaluates the step, and its second-order correction where the step alone falls short.
    fn attempt(
        &mut self,
        linear: &Linear,
        b: &DMatrix<f64>,
        free: &[usize],
        d: &[f64],
        gain: f64,
        slack: f64,
    ) -> Result<Option<Trial>, Halt> {
        let here = self.view.merit(&self.evaluation, self.weight);
        let ratio = |merit: f64| (here - merit + slack) / (gain + slack);
        let u = self.moved(d);
        let Ok(evaluation) = self.memo.one(self.space.unscaled(&u))? else { return Ok(None) };
        let first = Trial {
            ratio: ratio(self.view.merit(&evaluation, self.weight)),
            u,
            evaluation,
            corrected: false,
        };
        if first.ratio >= CORRECTED {
            return Ok(Some(first));
        }
        let there = self.view.linear_values(&first.evaluation.outputs());
        let step: Vec<f64> = free.iter().map(|&i| first.u[i] - self.u[i]).collect();
        let shifted = |rows: &[(f64, Vec<f64>)], values: &[f64]| {
            rows.iter().zip(values).map(|(r, v)| (v - qp::dot(&r.1, &step), r.1.clone())).collect()
        };
        let linear =
            Linear { rises: shifted(&linear.rises, &there.0), limits: shifted(&linear.limits, &there.1) };
        let (lower, upper) = self.window(free);
        let Some(again) = qp::solve(&linear, b, &lower, &upper, Ask::Merit { weight: self.weight }) else {
            return Ok(Some(first));
        };
        let mut d = vec![0.0; d.len()];
        for (&i, di) in free.iter().zip(&again.d) {
            d[i] = *di;
        }
        let u = self.moved(&d);
        let Ok(evaluation) = self.memo.one(self.space.unscaled(&u))? else { return Ok(Some(first)) };
        let second =
            Trial { ratio: ratio(self.view.merit(&evaluation, self.weight)), u, evaluation, corrected: true };
        Ok(Some(if second.ratio > first.ratio { second } else { first }))
    }

    fn moved(&self, d: &[f64]) -> Vec<f64> {
        let snap = |v: f64| {
            if v < ON_BOUND {
                0.0
            } else if v > 1.0 - ON_BOUND {
                1.0
            } else {
                v
            }
        };
        self.u.iter().zip(d).map(|(u, d)| snap(u + d)).collect()
    }

    /// Largest component of the Lagrangian's gradient, those that a bound holds left out; per range.
    fn kkt(&self, t: &Table) -> f64 {
        let weights = self.view.weights(&self.multipliers.0, &self.multipliers.1, t.slopes.len());
        (0..self.space.len()).fold(0.0, |worst: f64, i| {
            let slope: f64 = weights.iter().zip(&t.slopes).map(|(w, row)| w * row[i]).sum();
            let free = if self.u[i] <= ON_BOUND {
                slope.min(0.0)
            } else if self.u[i] >= 1.0 - ON_BOUND {
                slope.max(0.0)
            } else {
                slope
            };
            worst.max(free.abs())
        })
    }

    fn record(&mut self, tried: Tried) {
        let iteration = Iteration {
            phase: self.view.phase,
            tried,
            evaluations: self.memo.evaluations(),
            failures: self.memo.failures,
            least_margin: self.evaluation.least_margin(),
            violation: self.evaluation.violation(),
            residuals: self.residuals,
            radius: self.radius,
            weight: self.weight,
            central: self.central,
        };
        if let Some(watch) = &mut self.memo.run.watch {
            watch.iterated(&iteration);
        }
        self.history.push(iteration);
    }
}

fn half_quadratic(b: &DMatrix<f64>, d: &[f64]) -> f64 {
    let mut sum = 0.0;
    for i in 0..d.len() {
        for k in 0..d.len() {
            sum += d[i] * b[(i, k)] * d[k];
        }
    }
    0.5 * sum
}
