//! What a run hands back. Ending without a solution is a status; only a malformed question is an error.

use super::evaluate::{Evaluation, NoEvaluation};
use super::journal::Journal;
use super::view::Phase;
use crate::numeric::setting::BadSetting;

/// How the run ended.
#[derive(Debug, Clone, PartialEq)]
pub enum Status {
    /// A feasible point whose residuals are below the tolerances.
    Converged,
    /// No feasible point near: the largest violation has a positive local minimum, or the objective, which is to reach a
    /// value of its own (a wanted slip margin), a local maximum below it.
    Infeasible {
        /// That minimum, in the unit of the limits; or by what the objective's margin is short.
        least_violation: f64,
        /// Limits that hold it up against each other (multiplier above 1e-3 of their sum, 1), or that hold the objective
        /// down, in their order.
        fighting: Vec<usize>,
    },
    /// `max_evaluations` would have been passed; the best point seen is given.
    EvaluationLimit,
    /// The caller's flag was set; the best point seen is given.
    Interrupted,
    /// No further progress though the residuals are above the tolerances; the best point seen is given.
    Stalled(Cause),
}

impl Status {
    /// In one word.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Converged => "converged",
            Self::Infeasible { .. } => "infeasible",
            Self::EvaluationLimit => "evaluation-limit",
            Self::Interrupted => "interrupted",
            Self::Stalled(_) => "stalled",
        }
    }
}

/// Why a run stalled.
#[derive(Debug, Clone, PartialEq)]
pub enum Cause {
    /// The way up leads into a region where evaluation fails.
    FailingRegion,
    /// Every difference point of these variables failed; they were held.
    NoDerivative(Vec<usize>),
    /// No step, however short, gave the gain that the derivatives promise (a kink, or noise above the setting).
    NoDescent,
    /// Only a violation of the size of the noise is left, and steps no longer mend it.
    Noise,
    /// `max_iterations` steps were tried in one phase.
    IterationLimit,
    /// clarabel found no solution of the subproblem.
    Subproblem,
    /// Limits restored, and lost again, several times over.
    RestorationCycle,
}

impl Cause {
    /// What it means to who searches.
    pub fn words(&self) -> &'static str {
        match self {
            Self::FailingRegion => {
                "the way up leads to sprags that cannot be built or closed by their flanks"
            }
            Self::NoDerivative(_) => "near a variable's value no design can be built",
            Self::NoDescent => "no step, however short, gains what the slopes promise",
            Self::Noise => "what is violated is as small as the error of an evaluation",
            Self::IterationLimit => "its limit of steps was met",
            Self::Subproblem => "no next step was found",
            Self::RestorationCycle => "limits were restored and lost again",
        }
    }
}

/// What is left at the last point of the main phase; see the tolerances of [`Settings`](super::Settings).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Residuals {
    /// Largest component of the projected gradient of the Lagrangian, unit of the objectives per range.
    pub kkt: f64,
    /// Gain of the merit that the model still promises, unit of the objectives.
    pub gain: f64,
    /// Largest component of the step that promises it, fraction of range.
    pub step: f64,
    /// Largest violation, unit of the limits.
    pub violation: f64,
}

/// What became of one subproblem's step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TrialOutcome {
    /// Taken.
    Accepted,
    /// Taken after the second-order correction.
    Corrected,
    /// Not enough gain: the trust radius shrinks.
    Refused,
    /// Evaluation failed there: the trust radius shrinks.
    Failed,
    /// Not tried, the residuals being small.
    Nothing,
}

/// One line of the history, written at the point a step started from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Iteration {
    /// Phase of the step.
    pub phase: Phase,
    /// What became of it.
    pub tried: TrialOutcome,
    /// Evaluations so far, all phases.
    pub evaluations: usize,
    /// Failed evaluations so far.
    pub failures: usize,
    /// Least objective t.
    pub least_margin: f64,
    /// Largest violation of the limits.
    pub violation: f64,
    /// Limits violated by more than the tolerance.
    pub violated: usize,
    /// Residuals of the phase.
    pub residuals: Residuals,
    /// Trust radius after the step, fraction of range.
    pub radius: f64,
    /// Penalty weight, objectives' unit per limits' unit.
    pub weight: f64,
    /// Whether derivatives were central.
    pub central: bool,
}

/// Which margins hold the solution where it is.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Active {
    /// Objectives with a multiplier.
    pub objectives: Vec<usize>,
    /// Limits with a multiplier.
    pub limits: Vec<usize>,
    /// Variables on their lower bound.
    pub lower: Vec<usize>,
    /// Variables on their upper bound.
    pub upper: Vec<usize>,
}

/// Result of a run.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// How the run ended.
    pub status: Status,
    /// Best point, in the caller's units: the solution, or the best point seen (feasible with the largest least
    /// margin, or else with the least violation).
    pub x: Vec<f64>,
    /// Margins there.
    pub evaluation: Evaluation,
    /// Share of each objective in the least margin, sum 1: dt = sum lambda_i dm_i where the margins are shifted
    /// by dm_i. Of the main phase's last step.
    pub objective_multipliers: Vec<f64>,
    /// dt for a limit loosened by one of its units, >= 0. Of the main phase's last step.
    pub limit_multipliers: Vec<f64>,
    /// Active margins and bounds.
    pub active: Active,
    /// Residuals at the end of the main phase.
    pub residuals: Residuals,
    /// Distinct points asked for.
    pub evaluations: usize,
    /// Derivatives of all margins along one variable that the problem gave itself ([`Evaluate::changes`](super::Evaluate::changes)),
    /// beside the evaluations.
    pub derivatives: usize,
    /// Evaluations that failed.
    pub failures: usize,
    /// Steps tried, in order.
    pub history: Vec<Iteration>,
    /// Every point known, in order; hand it to a later run to resume.
    pub journal: Journal,
    /// Least margin of the known optimum into whose basin it ran, where it was ended for that
    /// ([`SearchRun::known`](super::SearchRun::known)).
    pub joined: Option<f64>,
}

impl Outcome {
    /// A run that was stopped before its start, whose margins were known beforehand, had been asked for.
    pub(super) fn stopped_at(x: Vec<f64>, evaluation: Evaluation) -> Self {
        Self {
            status: Status::Interrupted,
            x,
            evaluation,
            objective_multipliers: Vec::new(),
            limit_multipliers: Vec::new(),
            active: Active::default(),
            residuals: Residuals::default(),
            evaluations: 0,
            derivatives: 0,
            failures: 0,
            history: Vec::new(),
            journal: Journal::default(),
            joined: None,
        }
    }
}

/// A malformed question.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Refusal {
    /// Counts of variables differ or are zero.
    #[error("{x0} start values, {lo} lower and {hi} upper bounds; equal counts above zero are needed")]
    Lengths {
        /// Length of x0.
        x0: usize,
        /// Length of lo.
        lo: usize,
        /// Length of hi.
        hi: usize,
    },
    /// Bounds that cross or are not finite.
    #[error("variable {variable}: bounds {lo} and {hi} are not an interval")]
    Bounds {
        /// Index of the variable.
        variable: usize,
        /// Its lower bound.
        lo: f64,
        /// Its upper bound.
        hi: f64,
    },
    /// The start is not in the box.
    #[error("variable {variable}: start {x} is outside {lo} .. {hi}")]
    StartOutside {
        /// Index of the variable.
        variable: usize,
        /// Its start.
        x: f64,
        /// Its lower bound.
        lo: f64,
        /// Its upper bound.
        hi: f64,
    },
    /// The start has no margins, so there is nothing to improve on.
    #[error("the start cannot be evaluated: {0}")]
    StartFails(NoEvaluation),
    /// Stopped before the start was evaluated.
    #[error("stopped before the start was evaluated")]
    StoppedAtStart,
    /// A setting out of range.
    #[error("{0}")]
    Setting(BadSetting),
}
