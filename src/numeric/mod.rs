//! Numerical tools that never heard of a machine part: duals, bracketed roots, quadrature, Chebyshev curves,
//! Toeplitz systems, courses over time, quantiles.
//!
//! In: functions of one variable, rows of matrices. Out: roots, integrals, approximations with a stated error.
//! Absent: physics, units. Equations: none of the paper's.

pub mod chebyshev;
pub mod course;
pub mod dual;
pub mod panels;
pub mod pieces;
pub mod quadrature;
pub mod root;
pub mod student;
pub mod toeplitz;
