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

use super::difference::{Steps, Table, own_table, table};
use super::evaluate::Evaluation;
use super::hessian;
use super::journal::{Halt, Memo};
use super::outcome::{Cause, Iteration, Residuals, TrialOutcome};
use super::qp::{self, Linear};
use super::settings::Settings;
use super::space::Space;
use super::step::{Plan, Trial};
use super::view::{Phase, View};

/// Share of the predicted gain below which a step is refused: a new derivative table costs more than a retry.
const ACCEPTED: f64 = 0.1;
/// Share of the violation left by a step of some length at which restoration takes over.
const HOPELESS: f64 = 0.9;
/// Times a climb may lower a weight that proved far above the multipliers; bounded, so that the merit falls at last.
const LOWERINGS: usize = 8;
/// Steps taken to mend a violation where all else is settled, before it is put down to noise.
const LOST: usize = 5;
/// Times a climb may forget its Hessian.
const RESETS: usize = 2;
/// Accepted steps over which slopes are followed by secants before they are taken again. A choice, tried with 0 to 8 on the
/// three problems of reports/optimiser-peers: fewer see the same top at less gain, more help no further.
const SECANTS: usize = 4;
/// Gain found over gain promised from which on a step's secants are believed.
const BELIEVED: f64 = 0.5;
/// How near, as a part of each range, and how little below, as a part of its least margin, an optimum is whose basin a climb has run
/// into, and how little more the climb may promise itself: a choice. The last is what tells two optima apart.
const BASIN: f64 = 0.05;
const LEVEL: f64 = 0.02;
const MORE: f64 = 1e-3;
/// How near, as a part of each range, slopes must have been taken to be those of one kink: a tenth of the usual shortest difference.
const AT_KINK: f64 = 1e-4;
/// So many of them are kept.
const KINKED: usize = 12;
/// Trust radius at which a climb gives up: a hundred-millionth of the range.
const SHORTEST_RADIUS: f64 = 1e-8;

/// Why a climb ended.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum End {
    /// Residuals below the tolerances.
    Converged,
    /// Restoration has come to a point with no limit violated.
    Feasible,
    /// In the basin of a known optimum, of this least margin.
    Joined(f64),
    /// Stationary, or out of steps, with limits violated.
    Violated,
    Stalled(Cause),
}

/// What to do with a plan.
enum Verdict {
    Try,
    /// Look again with central differences before believing it.
    Sharpen,
    /// Solve again without the Hessian's memory.
    Forget,
    /// Look again with slopes that are not followed.
    Refresh,
    End(End),
}

/// State of a climb.
pub(super) struct Climb<'a, 'm> {
    pub memo: &'a mut Memo<'m>,
    pub space: &'a Space,
    pub settings: &'a Settings,
    pub noise: &'a [f64],
    pub steps: &'a mut Option<Steps>,
    pub history: &'a mut Vec<Iteration>,
    /// Optima known beforehand, each with its least margin.
    pub known: &'a [(Vec<f64>, f64)],
    pub view: View,
    pub u: Vec<f64>,
    pub evaluation: Evaluation,
    pub radius: f64,
    pub weight: f64,
    pub central: bool,
    /// Multipliers of the phase's margins and limits at the last subproblem.
    pub multipliers: (Vec<f64>, Vec<f64>),
    pub residuals: Residuals,
    /// Derivatives at `u`, or followed there by secants.
    pub table: Table,
    /// Where they were last taken, and what they were there.
    pub taken: Option<(Vec<f64>, Table)>,
    /// B, once there is a first subproblem to take multipliers from.
    pub hessian: Option<DMatrix<f64>>,
    /// Points at which the model promised nothing more though its slopes had not vanished, and the Lagrangian's slopes there.
    pub level: Vec<(Vec<f64>, Vec<f64>)>,
    pub tally: Tally,
}

/// Counts of the things a climb may do a few times only.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Tally {
    resets: usize,
    lowerings: usize,
    lost: usize,
}

impl Climb<'_, '_> {
    /// Climbs until the residuals are small, nothing more is gained, or the evaluator halts.
    pub fn run(&mut self) -> Result<End, Halt> {
        self.derive()?;
        for _ in 0..self.settings.max_iterations {
            let (least, violation) = self.view.measure(&self.evaluation.outputs());
            if self.view.phase == Phase::Restore && least >= 0.0 {
                return Ok(End::Feasible);
            }
            if self.moving().is_empty() {
                return Ok(self.stationary(violation));
            }
            let Some(plan) = self.plan() else { return Ok(End::Stalled(Cause::Subproblem)) };
            if let Some(least) = self.joins(&plan) {
                self.record(TrialOutcome::Nothing);
                return Ok(End::Joined(least));
            }
            match self.judge(&plan) {
                Verdict::End(end) => {
                    self.record(TrialOutcome::Nothing);
                    return Ok(end);
                }
                Verdict::Sharpen => self.sharpen(10.0)?,
                Verdict::Forget => self.hessian = None,
                Verdict::Refresh => self.renew()?,
                Verdict::Try => match self.attempt(&plan)? {
                    Some(trial) if trial.ratio >= ACCEPTED => self.accept(&plan, trial)?,
                    refused => {
                        if let Some(end) = self.refuse(&plan, refused)? {
                            return Ok(end);
                        }
                    }
                },
            }
        }
        Ok(End::Stalled(Cause::IterationLimit))
    }

    /// The least margin of a known optimum whose basin this is: within [`BASIN`] of it, at most [`LEVEL`] below it, the plan leading
    /// towards it and, if its promise were kept, no more than [`MORE`] above it. Margins that bend down keep less than they promise, so
    /// that a better optimum next to the known one is promised from its own flank, and led to.
    fn joins(&self, plan: &Plan) -> Option<f64> {
        if self.view.phase != Phase::Margin || plan.violation > self.settings.violation_tolerance {
            return None;
        }
        let near = |(u, least): &&(Vec<f64>, f64)| {
            let way: Vec<f64> = u.iter().zip(&self.u).map(|(a, b)| a - b).collect();
            let apart = way.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
            let below = least - plan.least;
            apart <= BASIN
                && (0.0..=LEVEL * least.abs()).contains(&below)
                && qp::dot(&way, &plan.d) > 0.0
                && plan.rise <= below + MORE * least.abs()
        };
        self.known.iter().find(near).map(|(_, least)| *least)
    }

    /// Whether the plan is worth an evaluation.
    fn judge(&mut self, plan: &Plan) -> Verdict {
        let settings = self.settings;
        let violation = plan.violation;
        let met = violation <= settings.violation_tolerance;
        let scale = plan.least.abs().max(1.0);
        let flat = (settings.optimality_tolerance * scale).max(self.kkt_noise());
        let level = plan.gain <= (settings.gain_tolerance * scale).max(2.0 * plan.noise);
        let small = match self.view.phase {
            Phase::TieBreak { .. } => met && plan.rise <= settings.tie_break_gain,
            _ => level && self.residuals.kkt <= flat,
        };
        // Once steps are as short as the difference step, the error f'' h/2 of a forward difference is as large as the
        // change of slope that the step is after.
        let coarse = settings.shortest_difference;
        let doubtful = if small { settings.finish } else { plan.length <= coarse && !self.table.exact };
        let hopeless = !met && plan.elastic > HOPELESS * violation;
        let kink = level && met && self.table.exact && self.view.phase == Phase::Margin;
        if self.table.secants > 0 && (small || hopeless || kink) {
            return Verdict::Refresh;
        }
        if kink && !small {
            let left = self.left_at_kink();
            if left <= flat {
                self.residuals.kkt = left;
                return Verdict::End(self.stationary(violation));
            }
        }
        if !self.central && doubtful {
            return Verdict::Sharpen;
        }
        if hopeless && self.radius >= 10.0 * coarse {
            return Verdict::End(End::Violated);
        }
        if small && (met || hopeless) {
            return Verdict::End(self.stationary(violation));
        }
        self.tally.lost += usize::from(small);
        if self.tally.lost > LOST {
            return Verdict::End(End::Stalled(Cause::Noise));
        }
        if plan.gain > 0.0 {
            return Verdict::Try;
        }
        // Not the minimum of a convex model: the Hessian has outgrown the subproblem's accuracy.
        self.tally.resets += 1;
        if self.tally.resets > RESETS {
            Verdict::End(End::Stalled(Cause::Subproblem))
        } else {
            Verdict::Forget
        }
    }

    /// What is left of the Lagrangian's slopes where those here and those taken next to it are mixed as well as may be, its largest
    /// component. A margin that two peaks of a motion share has a kink along which the slopes of either do not vanish, only their
    /// mixture: Goldstein's condition (*Math. Prog.* 13 (1977) 14), by the slopes that the climb has met. The shortest mixture is the
    /// step of the subproblem whose rises they are under the unit Hessian.
    fn left_at_kink(&mut self) -> f64 {
        let free = self.moving();
        let slopes = combined(&self.lagrangian_weights(), &self.table.slopes);
        let rise: Vec<f64> = free.iter().map(|&i| -slopes[i]).collect();
        let near = |(u, of): &(Vec<f64>, Vec<f64>)| {
            of.len() == rise.len() && u.iter().zip(&self.u).all(|(a, b)| (a - b).abs() <= AT_KINK)
        };
        self.level.retain(near);
        self.level.truncate(KINKED - 1);
        self.level.insert(0, (self.u.clone(), rise));
        let rises: Vec<(f64, Vec<f64>)> =
            self.level.iter().map(|(_, slopes)| (0.0, slopes.clone())).collect();
        let most = rises.iter().flat_map(|r| &r.1).fold(0.0, |m: f64, g| m.max(g.abs()));
        let (lower, upper): (Vec<f64>, Vec<f64>) = free
            .iter()
            .map(|&i| (if self.u[i] <= 0.0 { 0.0 } else { -most }, if self.u[i] >= 1.0 { 0.0 } else { most }))
            .unzip();
        let linear = Linear { rises, limits: Vec::new() };
        let unit = DMatrix::identity(free.len(), free.len());
        let mixed = qp::solve(&linear, &unit, &lower, &upper, qp::Ask::Merit { weight: 1.0 });
        mixed.map_or(f64::INFINITY, |step| step.d.iter().fold(0.0, |m: f64, d| m.max(d.abs())))
    }

    /// Moves to the trial point: radius, derivatives, weight and Hessian follow.
    fn accept(&mut self, plan: &Plan, trial: Trial) -> Result<(), Halt> {
        if trial.ratio > 0.75 && plan.length >= 0.99 * self.radius {
            self.radius = (2.0 * self.radius).min(1.0);
        } else if trial.ratio < 0.25 {
            self.radius = 0.5 * plan.length;
        }
        self.record(if trial.corrected { TrialOutcome::Corrected } else { TrialOutcome::Accepted });
        let s: Vec<f64> = trial.u.iter().zip(&self.u).map(|(a, b)| a - b).collect();
        let outputs = self.evaluation.outputs();
        (self.u, self.evaluation) = (trial.u, trial.evaluation);
        if self.table.exact && trial.ratio >= BELIEVED && self.table.secants < SECANTS {
            self.table.follow(&s, &outputs, &self.evaluation.outputs());
            return Ok(());
        }
        self.renew()?;
        let needed: f64 = self.multipliers.1.iter().sum();
        let wall = matches!(self.view.phase, Phase::TieBreak { .. });
        if !wall && self.tally.lowerings < LOWERINGS && needed > 0.0 && self.weight > 8.0 * needed {
            self.weight = (2.0 * needed).max(0.1 * self.weight);
            self.tally.lowerings += 1;
        }
        Ok(())
    }

    /// Derivatives here, and what they say of the Hessian on the way from where they were taken last.
    fn renew(&mut self) -> Result<(), Halt> {
        let weights = self.lagrangian_weights();
        let before = self.taken.take();
        self.derive()?;
        let (Some(b), Some((from, before))) = (&mut self.hessian, before) else { return Ok(()) };
        let s: Vec<f64> = self.u.iter().zip(&from).map(|(a, b)| a - b).collect();
        let (before, after) = (combined(&weights, &before.slopes), combined(&weights, &self.table.slopes));
        let y: Vec<f64> = after.iter().zip(&before).map(|(a, b)| a - b).collect();
        if let Some(curvatures) = &self.table.curvatures {
            hessian::rescale(b, &combined(&weights, curvatures));
        }
        hessian::update(b, &s, &y);
        Ok(())
    }

    /// Shrinks the radius after a step without enough gain, or without an evaluation (`None`); ends where it has become
    /// too short and a fresh Hessian from central differences has not helped.
    fn refuse(&mut self, plan: &Plan, refused: Option<Trial>) -> Result<Option<End>, Halt> {
        let failed = refused.is_none();
        self.record(if failed { TrialOutcome::Failed } else { TrialOutcome::Refused });
        // Minimum of the parabola through the merit at both ends of the step and its predicted slope.
        let shrink = refused.map_or(0.4, |r| (0.5 / (1.0 - r.ratio)).clamp(0.1, 0.5));
        self.radius = shrink * plan.length;
        if self.table.secants > 0 {
            self.radius = 0.5 * plan.length;
            self.renew()?;
            return Ok(None);
        }
        let coarse = self.settings.shortest_difference;
        let wall = matches!(self.view.phase, Phase::TieBreak { .. });
        let too_short = match (wall, failed) {
            (true, _) => coarse,
            (_, true) => 0.1 * coarse,
            _ => SHORTEST_RADIUS,
        };
        if self.radius >= too_short {
            return Ok(None);
        }
        if !wall && (!self.central || self.tally.resets < RESETS) {
            self.tally.resets += usize::from(self.central);
            self.hessian = None;
            self.sharpen(1.0)?;
            return Ok(None);
        }
        Ok(Some(if wall {
            End::Converged
        } else if plan.violation > self.settings.violation_tolerance {
            End::Violated
        } else if failed {
            End::Stalled(Cause::FailingRegion)
        } else {
            End::Stalled(Cause::NoDescent)
        }))
    }

    /// End at a stationary point.
    fn stationary(&self, violation: f64) -> End {
        if !self.table.held.is_empty() {
            End::Stalled(Cause::NoDerivative(self.table.held.clone()))
        } else if violation <= self.settings.violation_tolerance {
            End::Converged
        } else {
            End::Violated
        }
    }

    /// Central differences from here on, and a radius of at least `steps` difference steps.
    fn sharpen(&mut self, steps: f64) -> Result<(), Halt> {
        self.central = true;
        self.radius = self.radius.max(steps * self.settings.shortest_difference);
        self.derive()
    }

    /// Derivative table at the present point.
    fn derive(&mut self) -> Result<(), Halt> {
        let outputs = self.evaluation.outputs();
        let shortest = Steps::shortest(self.space.len(), self.settings);
        let steps = self.steps.as_ref().unwrap_or(&shortest);
        let central = self.central || self.steps.is_none();
        let h = if central { steps.central.clone() } else { steps.forward.clone() };
        let found = match self.central {
            true => table(self.memo, self.space, &self.u, &outputs, &h, true)?,
            false => own_table(self.memo, self.space, &self.u, &outputs, &h, central)?,
        };
        if let Some(fitted) = Steps::fitted(&found, self.noise, self.settings) {
            *self.steps = Some(match self.steps.take() {
                Some(known) => known.least(&fitted),
                None => fitted,
            });
        }
        self.taken = Some((self.u.clone(), found.clone()));
        self.table = found;
        Ok(())
    }

    fn record(&mut self, tried: TrialOutcome) {
        let iteration = Iteration {
            phase: self.view.phase,
            tried,
            evaluations: self.memo.evaluations(),
            failures: self.memo.failures,
            least_margin: self.evaluation.least_margin(),
            violation: self.evaluation.violation(),
            violated: self.evaluation.violated(self.settings.violation_tolerance),
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

/// Sum of `weights` times rows.
pub(super) fn combined(weights: &[f64], rows: &[Vec<f64>]) -> Vec<f64> {
    let variables = rows.first().map_or(0, Vec::len);
    (0..variables).map(|i| weights.iter().zip(rows).map(|(w, row)| w * row[i]).sum()).collect()
}
