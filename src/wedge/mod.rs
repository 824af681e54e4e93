//! Where geometry and elastic laws meet: the wedge curve N(alpha) of one design.
//!
//! In: `Clutch`, `Profile`, mean speed. Out: [`WedgeCurve`], static points, torque, windup, stiffness.
//! Absent: inertia, slip, limits. Equations: (10), (A.7)-(A.9), the junction crossing of Figure 5.
//!
//! Laws that know the radius are given the profile's curvature averaged over the patch at A ([`InnerCurvature`]), which
//! makes alpha, N and windup continuous at a junction by themselves; the paper's pointwise radius needs Figure 5's shift.

mod apart;
mod at_speeds;
mod axial;
mod axis_turns;
mod build;
mod bulk;
mod closure;
#[cfg(test)]
mod cost;
mod curve;
mod elastic;
mod off_centre;
mod patch;
mod quick;
mod roll_over;
mod rolling;
mod samples;
mod stiffness;
mod table;

pub use crate::contact::{Edge, Peak};
pub use apart::{Borne, SpragDeviation};
pub use at_speeds::{AtSpeed, AtSpeeds};
pub use axial::{Along, Lengthwise, Side, along, along_drawn, asks_for_slices, even_load_error};
pub use axis_turns::{AxisTurn, AxisTurns};
pub use build::Effort;
pub use closure::{Closure, FIRST_CONTACT_N, NoClosure, Statics};
pub use curve::{EndReason, NoCurve, WedgeCurve, WedgePoint};
pub use elastic::{Elastic, NoElastic};
pub use patch::{InnerCurvature, Straddle, shift_left_out, straddling_error};
pub use roll_over::{OverEnd, OverPoint, RollOver};
pub use rolling::CreepLoss;
pub use samples::PLOTTED;
pub use stiffness::{SMALLEST_TORQUE_NM, StaticPoint};
pub(crate) use table::RHO_STEEPEST_RAD;
