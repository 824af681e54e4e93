//! Numerical tools that never heard of a machine part.
//!
//! In: functions and numbers. Out: approximations with a stated error. Absent: physics, units.
//! Equations: none of the paper's.

pub mod chebyshev;
