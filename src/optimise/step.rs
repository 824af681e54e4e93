//! Planning and trying one step of a climb: subproblem, penalty weight, second-order correction.

use nalgebra::DMatrix;

use super::evaluate::Evaluation;
use super::journal::Halt;
use super::outcome::Residuals;
use super::qp::{self, Ask, Linear, Step};
use super::sqp::{Climb, combined};

/// Share below which the second-order correction is tried; it costs one evaluation, a derivative table many.
const CORRECTED: f64 = 0.9;
/// Penalty weight, relative to the first, at which the limits are taken to have no common point nearby.
const HEAVIEST: f64 = 1e8;
/// Distance from a bound that counts as on it.
const ON_BOUND: f64 = 1e-9;

/// A step and what the model promises for it.
pub(super) struct Plan {
    /// Variables that may move, and the model over them.
    free: Vec<usize>,
    linear: Linear,
    hessian: DMatrix<f64>,
    /// Step of all variables.
    pub d: Vec<f64>,
    /// Least margin and violation here.
    pub least: f64,
    pub violation: f64,
    /// Modelled gain of the least margin, and modelled violation, at the end of the step.
    pub rise: f64,
    pub elastic: f64,
    /// Modelled gain of the merit.
    pub gain: f64,
    /// Largest component of d.
    pub length: f64,
    /// Noise of the merit.
    pub noise: f64,
}

/// A step that was evaluated.
pub(super) struct Trial {
    pub u: Vec<f64>,
    pub evaluation: Evaluation,
    /// Gain found over gain promised.
    pub ratio: f64,
    /// Whether the second-order correction was the better.
    pub corrected: bool,
}

impl Climb<'_, '_> {
    /// Variables whose bounds differ and whose derivatives are known.
    pub fn moving(&self) -> Vec<usize> {
        self.space.free().into_iter().filter(|i| !self.table.held.contains(i)).collect()
    }

    /// Solves the subproblem here; multipliers and residuals are those of its solution.
    pub fn plan(&mut self) -> Option<Plan> {
        let outputs = self.evaluation.outputs();
        let (least, violation) = self.view.measure(&outputs);
        let free = self.moving();
        let linear = self.view.linear(&outputs, &self.table, &free);
        let b = match self.hessian.take() {
            Some(b) => b,
            None => self.first_hessian(&linear, &free),
        };
        let hessian = DMatrix::from_fn(free.len(), free.len(), |i, k| b[(free[i], free[k])]);
        self.hessian = Some(b);
        let step = self.subproblem(&linear, &hessian, &free, violation)?;
        let d = self.spread(&step.d, &free);
        let rise = step.rise - least;
        let gain = rise + self.weight * (violation - step.elastic) - half_quadratic(&hessian, &step.d);
        let length = d.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        self.multipliers = (step.rise_multipliers, step.limit_multipliers);
        self.residuals = Residuals { kkt: self.kkt(), gain, step: length, violation };
        let noise = self.view.noise(self.noise, self.weight);
        Some(Plan {
            free,
            linear,
            hessian,
            d,
            least,
            violation,
            rise,
            elastic: step.elastic,
            gain,
            length,
            noise,
        })
    }

    /// Step of all variables from that of the free ones.
    fn spread(&self, part: &[f64], free: &[usize]) -> Vec<f64> {
        let mut d = vec![0.0; self.space.len()];
        for (&i, v) in free.iter().zip(part) {
            d[i] = *v;
        }
        d
    }

    /// Diagonal of the Lagrangian's Hessian where the table has it, else a mild multiple of the identity: curvature
    /// that would turn a hundredth of the steepest slope over the range.
    fn first_hessian(&self, linear: &Linear, free: &[usize]) -> DMatrix<f64> {
        let n = self.space.len();
        let steepest = linear.rises.iter().flat_map(|r| &r.1).fold(0.0, |m: f64, g| m.max(g.abs()));
        let mild = if steepest > 0.0 { 1e-2 * steepest } else { 1e-3 };
        let mut b = DMatrix::from_diagonal_element(n, n, mild);
        if let Some(curvatures) = &self.table.curvatures {
            let part = DMatrix::from_diagonal_element(free.len(), free.len(), mild);
            let (lower, upper) = self.window(free);
            let ask = Ask::Merit { weight: self.weight };
            if let Some(step) = qp::solve(linear, &part, &lower, &upper, ask) {
                let weights =
                    self.view.weights(&step.rise_multipliers, &step.limit_multipliers, curvatures.len());
                for (i, bend) in combined(&weights, curvatures).into_iter().enumerate() {
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

    /// Evaluates the plan's step, and its second-order correction where the step alone falls short; `None` where
    /// evaluation fails.
    pub fn attempt(&mut self, plan: &Plan) -> Result<Option<Trial>, Halt> {
        let Some(first) = self.try_step(plan, &plan.d, false)? else { return Ok(None) };
        if first.ratio >= CORRECTED {
            return Ok(Some(first));
        }
        // The same model, with its values shifted to be exact at the trial point.
        let (rises, limits) = self.view.values_of(&first.evaluation.outputs());
        let taken: Vec<f64> = plan.free.iter().map(|&i| first.u[i] - self.u[i]).collect();
        let shifted = |rows: &[(f64, Vec<f64>)], values: &[f64]| {
            rows.iter().zip(values).map(|(r, v)| (v - qp::dot(&r.1, &taken), r.1.clone())).collect()
        };
        let linear = Linear {
            rises: shifted(&plan.linear.rises, &rises),
            limits: shifted(&plan.linear.limits, &limits),
        };
        let (lower, upper) = self.window(&plan.free);
        let ask = Ask::Merit { weight: self.weight };
        let Some(again) = qp::solve(&linear, &plan.hessian, &lower, &upper, ask) else {
            return Ok(Some(first));
        };
        let second = self.try_step(plan, &self.spread(&again.d, &plan.free), true)?;
        Ok(Some(match second {
            Some(second) if second.ratio > first.ratio => second,
            _ => first,
        }))
    }

    fn try_step(&mut self, plan: &Plan, d: &[f64], corrected: bool) -> Result<Option<Trial>, Halt> {
        let u = self.moved(d);
        let Ok(evaluation) = self.memo.one(self.space.unscaled(&u))? else { return Ok(None) };
        let merit = |e: &Evaluation| self.view.merit(e, self.weight);
        // Gains within ten times the noise count as found.
        let slack = 10.0 * plan.noise;
        let ratio = (merit(&self.evaluation) - merit(&evaluation) + slack) / (plan.gain + slack);
        Ok(Some(Trial { u, evaluation, ratio, corrected }))
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

    /// Weight of every output in the Lagrangian at the present multipliers.
    pub fn lagrangian_weights(&self) -> Vec<f64> {
        self.view.weights(&self.multipliers.0, &self.multipliers.1, self.table.slopes.len())
    }

    /// Largest component of the Lagrangian's gradient, those that a bound holds left out; per range.
    fn kkt(&self) -> f64 {
        let gradient = combined(&self.lagrangian_weights(), &self.table.slopes);
        gradient.into_iter().zip(&self.u).fold(0.0, |worst: f64, (slope, &u)| {
            let free = if u <= ON_BOUND {
                slope.min(0.0)
            } else if u >= 1.0 - ON_BOUND {
                slope.max(0.0)
            } else {
                slope
            };
            worst.max(free.abs())
        })
    }

    /// What noise leaves of the gradient: twice its weighted sum over the shortest difference step in use.
    pub fn kkt_noise(&self) -> f64 {
        let sum: f64 = self.lagrangian_weights().iter().zip(self.noise).map(|(w, n)| w.abs() * n).sum();
        let shortest = self.steps.iter().flat_map(|s| &s.central).fold(f64::INFINITY, |m: f64, h| m.min(*h));
        2.0 * sum / shortest.max(self.settings.shortest_difference)
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
