//! Equations of motion (11)-(15): the only room that knows stick from slip.
//!
//! In: wedge curve, inertias, friction, loads. Out: runs with located mode changes, their peaks and counters, work and heat of slip.
//! Absent: limits and verdicts (margin), scenario names. Equations: (11), (13), (15), energy-consistent form.
//!
//! # Conventions
//! State (alpha, phi, theta_bi, theta_be) and rates, angles measured from Omega t; then the signed slip
//! distances at A and B. T_bi acts on the inner race in its positive sense, -T_be on the outer race.
//! v is race minus sprag surface; in slip T_bi = -sgn(v_A) mu N_bi and T_be = +sgn(v_B) mu N_be.

mod beat;
mod cage;
mod cage_swing;
mod carried;
mod change;
mod choose;
mod crossing;
mod cusp;
mod drive;
mod driver;
mod energy;
mod events;
mod foresee;
mod many;
mod memory;
mod model;
mod outside;
mod periodic;
mod probes;
#[cfg(feature = "validation")]
mod published;
mod repeat;
mod retrace;
mod rolling;
mod run;
mod settled;
mod slip_heat;
mod start;
mod stick;
mod stick_table;
mod swing;
mod train;
mod turns;
mod watch;
mod zeno;

pub use cage::{CageFacts, overrun_in_cage, pivot_moments};
pub use cage_swing::{swing_in_cage, swing_in_cage_with_friction};
pub use carried::Carried;
pub use drive::{Drive, FlangeDrive, Loads, Ramp};
pub use energy::EnergyBalance;
pub(crate) use events::OPEN_REACH_RAD;
pub use many::{
    Axes, AxisBearing, BendingWork, FirstSlip, ManyRun, ManySample, ManyStart, OffCentre, Rings,
    SpragApproach, SpragCourse, SpragGroup, SpragMotion, StaysWith, run_many, settled_off_centre,
    settled_together,
};
pub use memory::{Memory, go_on};
pub use model::{Forces, Grip, Mode, Model, N_STATE, Place, State};
pub use outside::{events, next_mode};
pub use periodic::{FINEST_STEPS, NoOrbit, Orbit, Shooting, orbit};
#[cfg(feature = "validation")]
pub use published::{PublishedSettings, published};
pub use repeat::Jump;
pub use retrace::RollingTrack;
pub use rolling::{Rolling, rolling, rolling_quickly, rolling_read_again, rolling_retraced, rolling_tracked};
pub use run::{
    Engaged, FastMotion, History, Hold, Neglected, Peaks, Run, RunSettings, Sample, SlipRecord, Stop, run,
    run_while_it_sticks,
};
pub use slip_heat::{Rubbed, SlipWork};
pub use start::{
    Overrun, SlidingContact, alpha_max_rad, overrun, overrun_under, preloaded, settled,
    settled_end_torque_nm, settled_point,
};
pub use swing::{Swing, swing, swing_on_film, swing_with_friction};
pub use train::{NodeMotion, Train, TrainMode, TrainRun};
