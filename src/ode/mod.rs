//! Runge-Kutta steps for systems that know no clutch.
//!
//! In: a fallible right-hand side on [f64; N]. Out: accepted steps with dense output, error, counters.
//! Absent: events and modes (dynamics locates those). Equations: none.

pub mod adaptive;
pub mod coefficients;
pub mod dop853;
pub mod radau5;
pub mod rhs;
pub mod rk4;
pub mod step;
