//! A run: what it is asked for and what comes out.

use super::driver::Driver;
use super::model::{Forces, Mode, Model, State};
use crate::ode::dop853::Counters;

/// Settings of a run.
#[derive(Debug, Clone, Copy)]
pub struct RunSettings {
    /// Relative tolerance of a step, pure number; absolute ones follow (rad, rad/s, m).
    pub tolerance: f64,
    /// End time, s.
    pub duration_s: f64,
    /// Longest step, s.
    pub longest_step_s: f64,
    /// Largest number of mode changes before the run ends with a name.
    pub most_events: u64,
    /// Largest number of steps before the run ends with a name.
    pub most_steps: u64,
    /// Number of equidistant samples to keep (0: none).
    pub samples: usize,
    /// Pure rolling: no friction limit, contact held by tension below first contact.
    pub rolling: bool,
}

/// Why a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stop {
    /// The end of the scenario.
    Finished,
    /// The contact left the profile or the sprag rolled over at the curve's end.
    CurveEnd,
    /// The open sprag turned back out of reach.
    FellAway,
    /// Too many mode changes.
    EventLimit,
    /// Too many steps, or a step that became too short.
    StepLimit,
    /// The right-hand side ceased to be finite.
    NotFinite,
}

/// Slip at one contact.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SlipRecord {
    /// Time in slip under load, s.
    pub time_s: f64,
    /// Path of slip, int |v| dt, m.
    pub distance_m: f64,
    /// Signed slip, int v dt, m.
    pub net_m: f64,
}

/// Located extremes of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peaks {
    /// Largest |T_bi|/N_bi while A is in contact.
    pub tan_inner: f64,
    /// Largest |T_be|/N_be while A is in contact.
    pub tan_outer: f64,
    /// Smallest N_bi, N (negative: tension of the pure-rolling run).
    pub normal_min_n: f64,
    /// Largest N_bi, N.
    pub normal_max_n: f64,
    /// Largest N_be, N.
    pub normal_outer_max_n: f64,
}

/// One sample.
#[derive(Debug, Clone, Copy)]
pub struct Sample {
    /// Time, s.
    pub t: f64,
    /// State.
    pub state: State,
    /// Forces there.
    pub forces: Forces,
    /// Mode there.
    pub mode: Mode,
}

/// A finished run.
#[derive(Debug, Clone)]
pub struct Run {
    /// Why it ended.
    pub stop: Stop,
    /// Time reached, s.
    pub t_s: f64,
    /// State there.
    pub state: State,
    /// Mode there.
    pub mode: Mode,
    /// Slip at A.
    pub inner: SlipRecord,
    /// Slip at B.
    pub outer: SlipRecord,
    /// Total time without contact at A, s.
    pub open_s: f64,
    /// Longest stretch without contact at A, s.
    pub longest_open_s: f64,
    /// Extremes.
    pub peaks: Peaks,
    /// Located mode changes.
    pub events: u64,
    /// Work of the integrator.
    pub counters: Counters,
    /// Equidistant samples.
    pub samples: Vec<Sample>,
}

/// Integrate from `state` at t = 0 in `mode`.
pub fn run(model: &Model, state: State, mode: Mode, settings: &RunSettings) -> Run {
    Driver::new(model, state, mode, settings).run()
}
