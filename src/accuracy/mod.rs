//! How far the figures can be trusted: error against work of every method, and the map of where runs come to an end.
//!
//! In: a scenario or a clutch, settings. Out: [`Precision`] (work-precision), [`Judged`] (one case of the map), [`Drives`] (which
//! cases a drive could have).
//! Absent: integrators of others, verdicts on the methods, printing. Equations: none.

mod cases;
mod drives;
mod map;
mod precision;

pub use cases::{Case, PARAMETERS, Parameter, cases};
pub use drives::Drives;
pub use map::{CaseEnd, Halved, Judged, WorkLimit, judge, map};
pub use precision::{Precision, PrecisionSettings, Scheme, WorkPoint, precision};
