//! Unknown parameters of a design from measured or published numbers.
//!
//! In: a `Design`, a table of what was measured, the unknowns with their bounds. Out: [`Identified`]: values, confidence,
//! correlation, residuals, what the data cannot tell apart. Absent: how a clutch works (`margin` and `wedge` are asked).
//! Equations: none; least squares after Bates & Watts, *Nonlinear Regression Analysis*, ch. 2.

mod fit;
mod law_error;
mod no_fit;
mod observation;
mod predict;
mod statistics;

pub use fit::{FitSettings, FittedPoint, Identified, Unknown, identify};
pub use law_error::Apart;
pub use no_fit::{NoFit, SoFar};
pub use observation::{Fault, Observation, ObservedQuantity, Use, observations};
pub use predict::{NoPrediction, Prediction, predict};
pub use statistics::{Doubt, Estimate, INSEPARABLE, Knowledge, STRONG, Tied};
