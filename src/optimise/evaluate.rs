//! What an optimisation asks of a problem: margins at a point, or a typed failure.

use serde::{Deserialize, Serialize};

/// Problem seen by the optimiser: margins as functions of the variables, in the caller's own units.
///
/// `evaluate` must be deterministic: the journal answers a repeated x from memory.
pub trait Evaluate: Sync {
    /// Margins at x, each in its own unit, best made dimensionless and of order one by the caller.
    ///
    /// # Errors
    /// [`NoEvaluation::Refused`] where the problem has no answer at x (a geometry that does not close, say).
    fn evaluate(&self, x: &[f64]) -> Result<Evaluation, NoEvaluation>;

    /// By what every number of the evaluation at `x` (objectives, limits, tie break) changes on the way to each of the points
    /// `beside` it, at most a millionth of the box away: to the first order, without the choices that two evaluations may make
    /// differently. NaN: a number without such a change; an empty row: a point without an evaluation. `None`: this problem has
    /// nothing better than the difference of two evaluations.
    fn changes(&self, _x: &[f64], _beside: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
        None
    }

    /// Whether threads have nothing of their own to do, so that several points are worth evaluating side by side.
    fn threads_are_free(&self) -> bool {
        true
    }
}

/// Margins at one point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Evaluation {
    /// Margins whose least is maximised; at least one.
    pub objectives: Vec<f64>,
    /// Margins that must be >= 0; may be empty.
    pub limits: Vec<f64>,
    /// Minimised among points whose least margin is the same (a plateau); a constant switches it off.
    pub tie_break: f64,
}

impl Evaluation {
    /// Least objective t = min m_i, the number that is maximised.
    pub fn least_margin(&self) -> f64 {
        self.objectives.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// Largest violation max(0, max_j -c_j), in the unit of the limits.
    pub fn violation(&self) -> f64 {
        self.limits.iter().fold(0.0, |worst, c| worst.max(-c))
    }

    /// Limits violated by more than `tolerance`.
    pub fn violated(&self, tolerance: f64) -> usize {
        self.limits.iter().filter(|c| **c < -tolerance).count()
    }

    /// The same with every limit less by `clearance`.
    pub(super) fn less(mut self, clearance: f64) -> Self {
        self.limits.iter_mut().for_each(|limit| *limit -= clearance);
        self
    }

    /// All numbers in one row: objectives, limits, tie break.
    pub(super) fn outputs(&self) -> Vec<f64> {
        let mut row = self.objectives.clone();
        row.extend_from_slice(&self.limits);
        row.push(self.tie_break);
        row
    }

    /// The same evaluation, or why it cannot be used: `shape` is the count of objectives and limits seen first.
    ///
    /// # Errors
    /// [`NoEvaluation::Shape`], [`NoEvaluation::NotFinite`].
    pub fn checked(self, shape: Option<(usize, usize)>) -> Result<Self, NoEvaluation> {
        let found = (self.objectives.len(), self.limits.len());
        let expected = shape.unwrap_or((found.0.max(1), found.1));
        if found != expected {
            return Err(NoEvaluation::Shape { expected, found });
        }
        match self.outputs().iter().position(|v| !v.is_finite()) {
            None => Ok(self),
            Some(i) if i < found.0 => {
                Err(NoEvaluation::NotFinite { part: EvaluationPart::Objective, index: i })
            }
            Some(i) if i < found.0 + found.1 => {
                Err(NoEvaluation::NotFinite { part: EvaluationPart::Limit, index: i - found.0 })
            }
            Some(_) => Err(NoEvaluation::NotFinite { part: EvaluationPart::TieBreak, index: 0 }),
        }
    }
}

/// Part of an [`Evaluation`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum EvaluationPart {
    /// One of `objectives`.
    Objective,
    /// One of `limits`.
    Limit,
    /// `tie_break`.
    TieBreak,
}

/// Why a point has no margins. The optimiser shortens the step, and the journal keeps the reason.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, thiserror::Error)]
pub enum NoEvaluation {
    /// The problem has no answer here, for the reason it gives.
    #[error("{0}")]
    Refused(String),
    /// The problem returned NaN or an infinity.
    #[error("{part:?} {index} is not a finite number")]
    NotFinite {
        /// Where it stood.
        part: EvaluationPart,
        /// Its position there, from 0.
        index: usize,
    },
    /// Other counts of (objectives, limits) than at the first point, or no objective at all.
    #[error("(objectives, limits) number {found:?}, expected {expected:?}")]
    Shape {
        /// Counts at the first point (at least one objective).
        expected: (usize, usize),
        /// Counts found here.
        found: (usize, usize),
    },
}
