//! Numbers without a clutch: duals, bracketed roots, quadrature, piecewise Chebyshev curves.
//!
//! In: functions of one variable. Out: roots, integrals, curves. Absent: units and physics.
//! Equations: none.

pub mod chebyshev;
pub mod dual;
pub mod panels;
pub mod quadrature;
pub mod root;
