//! The answer of `identify` by its keys in JSON.

use super::Identification;
use super::tables::{estimates, residuals};
use crate::answer::Said;
use crate::identify::{Estimate, FittedPoint, Unknown};
use crate::report::Rows;
use serde::Serialize;

/// An unknown, its value before, what was found, and what is said of that.
pub type UnknownRow<'a> = (&'a Unknown, &'a f64, &'a Estimate, String);

/// Keys of `identify`.
#[derive(Debug, Clone, Serialize)]
pub struct IdentificationBody<'a> {
    /// Whether the last step no longer mattered.
    pub converged: bool,
    /// Correlation of what was found, by the numbers of the unknowns; null: not known.
    pub correlation: Option<&'a [Vec<f64>]>,
    /// Observations less unknowns.
    pub degrees_of_freedom: usize,
    /// Whether the data determine every unknown.
    pub determined: bool,
    /// Evaluations of all fitted observations.
    pub evaluations: usize,
    /// Each observation beside the model.
    pub observations: Rows<&'a FittedPoint>,
    /// What the tables do not say.
    pub remarks: Vec<String>,
    /// Standard deviation of the scaled residuals; null: no degree of freedom.
    pub residual_sigma: Option<f64>,
    /// Least over largest singular value of the scaled sensitivities.
    pub singular_ratio: f64,
    /// Sum of the squared scaled residuals at the end of each start.
    pub sums_of_squares: &'a [f64],
    /// Each unknown.
    pub unknowns: Rows<UnknownRow<'a>>,
    /// Where the new design was written.
    pub written: Option<&'a str>,
}

impl<'a> IdentificationBody<'a> {
    pub(super) fn of(answer: &'a Identification<'_>) -> Self {
        let (found, k) = (answer.found, &answer.found.knowledge);
        Self {
            unknowns: estimates(found),
            correlation: k.correlation.as_deref(),
            observations: residuals(found),
            residual_sigma: k.residual_sigma,
            degrees_of_freedom: k.freedom,
            singular_ratio: k.singular_ratio,
            sums_of_squares: &found.sums.0,
            evaluations: found.evaluations,
            converged: found.converged,
            determined: answer.is_held(),
            remarks: answer.remarks(),
            written: answer.written,
        }
    }
}
