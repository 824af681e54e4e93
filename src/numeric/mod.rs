//! Numerical tools that never heard of a machine part: duals, bracketed roots, tops, quadrature, Chebyshev curves,
//! Toeplitz systems, eigenvalues, courses over time, quantiles, decimals, points that fill a box evenly, ranges of settings.
//!
//! In: functions of one variable, rows of matrices. Out: roots, integrals, approximations with a stated error.
//! Absent: physics, units. Equations: none of the paper's.

pub mod chebyshev;
pub mod course;
pub mod dual;
pub mod eigen;
pub mod golden;
pub mod panels;
pub mod pieces;
pub mod quadrature;
pub mod root;
pub mod setting;
pub mod sobol;
pub mod student;
pub mod toeplitz;

/// `value` to so many significant digits: the double that this decimal reads as, whose shortest text has no more of them.
pub fn rounded(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits.saturating_sub(1)).parse().unwrap_or(value)
}
