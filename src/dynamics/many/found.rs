//! What a run of many sprags comes to.

use super::{BendingWork, SpragMotion};
use crate::dynamics::model::Place;
use crate::dynamics::run::Stop;
use crate::ode::step::Counters;

/// The first slip of a sprag after it has caught under N_bi of [`crate::dynamics::Model::loaded_n`] or more: where it
/// begins, or where one that began unloaded comes to that load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FirstSlip {
    /// When, s.
    pub t_s: f64,
    /// Whether it was the inner contact.
    pub inner: bool,
    /// N_bi then, N.
    pub normal_n: f64,
}

/// What became of one group; forces are those of one of its sprags.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SpragCourse {
    /// When A first carried without overrunning, s; `None`: never.
    pub catches_s: Option<f64>,
    /// Its first slip.
    pub slips: Option<FirstSlip>,
    /// Signed slip at A and B, m.
    pub net_m: [f64; 2],
    /// Path of it, m.
    pub path_m: [f64; 2],
    /// Signed slip at A and its path until it caught, m.
    pub before_m: [f64; 2],
    /// Path that B slid since it caught while a driven cage carried it, m.
    pub carried_m: f64,
    /// Largest N_bi, N.
    pub normal_max_n: f64,
    /// When, s.
    pub normal_max_s: f64,
    /// Largest |T|/N at A and B while loaded.
    pub tan: [f64; 2],
    /// Largest share of the load, 1: the mean of all sprags, from the settings' load on; 0: never loaded.
    pub share: f64,
    /// When, s.
    pub share_s: f64,
    /// When it first passed the end of its curve, s, where its way over is followed.
    pub over_s: Option<f64>,
    /// When it has gone over and lost contact for good, s.
    pub gone_s: Option<f64>,
    /// Time without contact after it has caught, s.
    pub open_s: f64,
    /// Longest stretch without contact, s, but with a cage that carries it.
    pub longest_open_s: f64,
    /// N_bi at the end, N.
    pub end_n: f64,
    /// Whether a driven cage carries it then.
    pub carried: bool,
}

/// A stretch without contact.
#[derive(Debug, Clone, Copy)]
pub(super) struct Apart {
    pub since_s: f64,
    /// Whether the sprag had caught before.
    pub caught: bool,
}

impl SpragCourse {
    /// The stretch `apart` ends at `t_s`, s, of a sprag that has been at `place`; as of one sprag
    /// ([`crate::dynamics::Run::longest_open_s`]).
    pub(super) fn end_apart(&mut self, apart: Apart, place: Place, t_s: f64) {
        let length_s = t_s - apart.since_s;
        self.open_s += if apart.caught { length_s } else { 0.0 };
        if place == Place::Open {
            self.longest_open_s = self.longest_open_s.max(length_s);
        }
    }
}

/// All groups at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct ManySample {
    /// s.
    pub t_s: f64,
    /// theta_bi, theta_be, rad, and their rates.
    pub races: [f64; 4],
    /// N_bi of a sprag of each group, N.
    pub normal_n: Vec<f64>,
    /// |T|/N at A and B.
    pub tan: Vec<[f64; 2]>,
    /// What each does.
    pub motions: Vec<SpragMotion>,
    /// Axis of the inner race against that of the outer, in the frame of the mean speed: towards sprag 0's even place
    /// and a quarter turn ahead, m.
    pub axis_m: [f64; 2],
    /// What the bearings of the axes hold, N; 0 where these meet and are held.
    pub bearing_n: f64,
}

/// A finished run.
#[derive(Debug, Clone)]
pub struct ManyRun {
    /// Why it ended.
    pub stop: Stop,
    /// The group at which it did, where one is to blame.
    pub at_group: Option<usize>,
    /// Time reached, s.
    pub t_s: f64,
    /// Angles and rates of the races there, as in [`super::ManyStart`].
    pub races: [f64; 4],
    /// alpha, phi of each group there, rad.
    pub sprags: Vec<[f64; 2]>,
    /// Largest force that the bearings of the axes hold, N, where they do not meet or give way; a held axis is held by that.
    pub bearing_max_n: f64,
    /// When, s.
    pub bearing_max_s: f64,
    /// How far the axes lie apart at most, at the ends of steps, m.
    pub axis_max_m: f64,
    /// By group.
    pub courses: Vec<SpragCourse>,
    /// Equidistant.
    pub samples: Vec<ManySample>,
    /// Located changes.
    pub events: u64,
    /// Choices of a mode that contradicted themselves.
    pub inconsistent_choices: u64,
    /// Work of the integrator, one evaluation for all sprags.
    pub counters: Counters,
    /// Looks at all sprags, those of evaluations counted.
    pub looks: u64,
    /// Work of the races' bending.
    pub bending: BendingWork,
    /// What works and changes of energy leave over, J; 0 where the run ended because forces ceased to be finite ([`Stop::NotFinite`]).
    pub residual_j: f64,
    /// Energy that went through, J.
    pub through_j: f64,
}
