//! Many unlike sprags between two races: each rolls, slips and lifts by itself, the two rotations couple them.
//!
//! Sprag g has the equations of [`Model::forces`] on its own curve. Given the accelerations x = (theta_bi'', theta_be'') of the
//! races, its rows (rolling where a contact holds, friction where it slips) are two linear equations for its T = (T_bi, T_be),
//!
//!   A_g T_g = b_g - S_g x,   S_g = diag(1 where A holds, 1 where B holds),   so   T_g = A_g^-1 b_g - A_g^-1 S_g x,
//!
//! and (15) with the sum over all of them is one 2x2 system:
//!
//!   [I + sum n_g R_g A_g^-1 S_g] x = f + sum n_g R_g A_g^-1 b_g,   I = diag(I_bi, I_be),   R_g = diag(OA_g, -OB_g),
//!
//! f the torques from outside, the damping between the races and the abutment. n_g sprags that are alike are computed once.
//! With one group this is [`Model::forces`].
//!
//! A sprag that lacks something to touch waits: until the races have wound up by its lag since torque began (in an overrun, since
//! they turned back) it is turned along without a force, as in statics. Then it is at first contact, rolling, and its grip
//! is chosen.
//!
//! Where several come to events at one time, or one of them makes another's contact give way, the modes of all are chosen together
//! (`choose`); across a junction all momenta but alpha's and the kinetic energy are kept (`jump`), with what turns along.
//!
//! Where the axes of the races do not meet, or give way on bearings, each sprag stands in its own gap (`axes`); the system has the two
//! rates of the axis beside those of the races.
//!
//! Where the races bend unevenly, what presses a sprag follows from where all of them stand (`bending`).
//!
//! Sprags that a driven cage carries turn with the inner race (`carried`).
//!
//! State: theta_bi, theta_be, their rates, five works, then of each group alpha, phi, their rates and the slips at A
//! and B; last the shift of the axis and its rate, where there are bearings.

mod approach;
mod axes;
mod bending;
mod carried;
mod change;
mod choose;
mod energy;
mod found;
mod jump;
mod locate;
mod rhs;
mod run;
mod start;
mod touch;
mod watch;

pub use approach::SpragApproach;
pub use axes::{Axes, AxisBearing, OffCentre, StaysWith};
pub use bending::{BendingWork, Rings};
pub use found::{FirstSlip, ManyRun, ManySample, SpragCourse};
pub use run::run_many;
pub use start::{settled_off_centre, settled_together};

use super::model::{Mode, Model};
use super::{N_STATE, State};
use crate::wedge::OverEnd;

/// Races and works.
const HEAD: usize = 9;
/// Of one group.
const EACH: usize = 6;
/// Works: friction, damping, torque on the inner and on the outer race, sum of all magnitudes.
const WORKS: usize = 5;
const FIRST_WORK: usize = HEAD - WORKS;
/// Probes at a step.
const PROBES: usize = crate::ode::dop853::PROBES.len();

/// Sprags that are alike, as many as `model` counts.
#[derive(Debug, Clone)]
pub struct SpragGroup {
    /// Their own curve, friction and spring; races and loads of the first group count for all.
    pub model: Model,
    /// Windup of the races from which on they touch, rad; `None`: they touch at the start.
    pub lag_rad: Option<f64>,
    /// How the way over their highest place ends, where their curve has it; `None`: the run ends where the curve does.
    pub over: Option<OverEnd>,
    /// Where they stand between axes that do not meet, or on an inner track out of round; `None`: neither, or it is not asked.
    pub off_centre: Option<OffCentre>,
}

/// Where a group is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpragMotion {
    /// What its contacts do; means nothing while it waits.
    pub mode: Mode,
    /// Whether it does not touch yet.
    pub waits: bool,
    /// Whether it will never touch again: it has gone over its highest place.
    pub gone: bool,
    /// theta_bi - theta_be + W(alpha) while both contacts hold, rad.
    phase: Option<f64>,
}

/// Where a run begins.
#[derive(Debug, Clone)]
pub struct ManyStart {
    /// Angles (rad) and rates (rad/s) of both races, inner first.
    pub races: [f64; 4],
    /// alpha and its rate, phi and its rate of each group.
    pub sprags: Vec<[f64; 4]>,
    /// What each does.
    pub motions: Vec<SpragMotion>,
    /// Shift of the axis on its bearings, m.
    pub shift_m: [f64; 2],
}

/// The state of group `g` in the order of the one-sprag model.
fn state_of(y: &[f64], g: usize) -> State {
    let s = &y[HEAD + EACH * g..HEAD + EACH * (g + 1)];
    [s[0], s[1], y[0], y[1], s[2], s[3], y[2], y[3], s[4], s[5]]
}
