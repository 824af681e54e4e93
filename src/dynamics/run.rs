//! A run: what it is asked for and what comes out.

use super::energy::EnergyBalance;
use super::events::{FIGURES, N_BI};
use super::model::{Forces, Grip, Mode, Model, N_STATE, Place, State};
use super::repeat::Jump;
use super::slip_heat::Rubbed;
use super::train::{self, TrainRun};
use crate::follow::Follow;
use crate::ode::step::{Counters, Tolerance};
use serde::{Deserialize, Serialize};

/// Settings of a run.
#[derive(Debug, Clone)]
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
    /// Period of all that acts, s, where whole periods are jumped once the motion repeats ([`super::Jump`]); `None`: none are.
    pub jump_period_s: Option<f64>,
    /// Whether whole swings of a sprag are jumped once they repeat, where it slides and nothing that acts changes.
    pub jump_swings: bool,
    /// What a jump may be wrong by in any figure, by its natural size, where the tolerance of the steps is less.
    pub jump_error: f64,
    /// Pure rolling: no friction limit, contact held by tension below first contact.
    pub rolling: bool,
    /// Whether works are counted for the energy balance; costs some fifteen evaluations a step.
    pub energy: bool,
    /// Whether work, heat and wear of slip are counted; costs some fifteen evaluations a step that slips.
    pub slip_heat: bool,
    /// What the samples are of.
    pub history: History,
    /// Ends the run at the next step, and is told how far it is.
    pub follow: Follow,
}

/// A run of no duration that nothing is kept of but its end; steps as long as the tolerance bears.
impl Default for RunSettings {
    fn default() -> Self {
        Self {
            tolerance: 1e-6,
            duration_s: 0.0,
            longest_step_s: f64::INFINITY,
            most_events: 100_000,
            most_steps: 10_000_000,
            samples: 0,
            jump_period_s: None,
            jump_swings: false,
            jump_error: 0.0,
            rolling: false,
            energy: false,
            slip_heat: false,
            history: History::default(),
            follow: Follow::nobody(),
        }
    }
}

/// What a history holds.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct History {
    /// The samples lie between these times, s; `None`: from the start to the end of the run.
    pub window_s: Option<[f64; 2]>,
    /// Whether located changes of mode and extremes are samples too, at most as many as there are equidistant ones.
    pub marks: bool,
}

/// What the equations leave out, at its largest over a run, from every probe at every step. 0 where no samples were asked for.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Neglected {
    /// |OC_g' alpha''| while A carries load, m/s^2: the radial acceleration of G.
    pub radial_m_s2: f64,
    /// N_be then, N.
    pub normal_outer_n: f64,
    /// |theta_be'|, rad/s.
    pub outer_rate_rad_s: f64,
}

impl Neglected {
    /// One probe: |OC_g' alpha''| (m/s^2), N_be (N) and |theta_be'| (rad/s) there.
    pub(super) fn note(&mut self, radial_m_s2: f64, normal_outer_n: f64, outer_rate_rad_s: f64) {
        if radial_m_s2 > self.radial_m_s2 {
            (self.radial_m_s2, self.normal_outer_n) = (radial_m_s2, normal_outer_n);
        }
        self.outer_rate_rad_s = self.outer_rate_rad_s.max(outer_rate_rad_s);
    }
}

named! {
    /// Why a run ended.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
    pub enum Stop {
        /// The end of the scenario.
        Finished = "finished",
        /// The contact left the profile or the sprag rolled over at the curve's end.
        CurveEnd = "curve-end",
        /// The open sprag turned back out of reach.
        FellAway = "fell-away",
        /// Too many mode changes.
        EventLimit = "event-limit",
        /// Too many steps, or a step that became too short.
        StepLimit = "step-limit",
        /// The right-hand side ceased to be finite.
        NotFinite = "not-finite",
        /// Slip began under load or went too far, where that was to end the run ([`run_while_it_sticks`]).
        Slipped = "slipped",
        /// Asked to stop from outside.
        Interrupted = "interrupted",
    }
    /// Name in reports and JSON.
    pub fn name;
}

impl Stop {
    /// Whether the run gave up: it met a limit of work or ceased to be finite, so it says nothing of what would have come
    /// (an interrupted run was stopped from outside; the other ends are answers).
    pub fn gave_up(self) -> bool {
        matches!(self, Self::StepLimit | Self::EventLimit | Self::NotFinite)
    }
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
    /// Largest |T_be|/N_be while A is in contact; where B holds whatever that takes, it counts smoothly less below
    /// [`Model::loaded_n`] and not at all without a force.
    pub tan_outer: f64,
    /// Smallest N_bi, N (negative: tension of the pure-rolling run).
    pub normal_min_n: f64,
    /// Largest N_bi, N.
    pub normal_max_n: f64,
    /// Largest N_be, N.
    pub normal_outer_max_n: f64,
    /// When each was reached first, s, in the order above.
    pub at_s: [f64; 5],
    /// N_bi where |T|/N at A and at B was largest, N.
    pub normal_at_tan_n: [f64; 2],
}

impl Peaks {
    /// Nothing seen yet.
    pub const NONE: Self = Self {
        tan_inner: 0.0,
        tan_outer: 0.0,
        normal_min_n: f64::INFINITY,
        normal_max_n: 0.0,
        normal_outer_max_n: 0.0,
        at_s: [0.0; 5],
        normal_at_tan_n: [0.0; 2],
    };

    /// The largest so far of each figure of a probe.
    pub(super) fn figures(&self) -> [f64; FIGURES] {
        [self.tan_inner, self.tan_outer, -self.normal_min_n, self.normal_max_n, self.normal_outer_max_n]
    }

    /// Figure `i` of a probe at `t` (s) with a normal force of `n_bi` (N) is a record.
    pub(super) fn keep(&mut self, i: usize, t: f64, value: f64, n_bi: f64) {
        self.at_s[i] = t;
        match i {
            0 => (self.tan_inner, self.normal_at_tan_n[0]) = (value, n_bi),
            1 => (self.tan_outer, self.normal_at_tan_n[1]) = (value, n_bi),
            2 => self.normal_min_n = -value,
            3 => self.normal_max_n = value,
            _ => self.normal_outer_max_n = value,
        }
    }
}

/// One sample. `N`: length of the state, longer where a drivetrain is integrated too.
#[derive(Debug, Clone, Copy)]
pub struct Sample<const N: usize = N_STATE> {
    /// Time, s.
    pub t: f64,
    /// State.
    pub state: [f64; N],
    /// Signed slip at A and B since the start, m, as [`SlipRecord::net_m`]: what surfaces move past one another without contact is none.
    pub slip_m: [f64; 2],
    /// Forces there.
    pub forces: Forces,
    /// Mode there.
    pub mode: Mode,
}

/// The first moment at which A carries load without overrunning: at once in a torsional scene, at the reversal
/// in an engagement. What slipped before belongs to the free run.
#[derive(Debug, Clone, Copy)]
pub struct Engaged<const N: usize = N_STATE> {
    /// Time, s.
    pub t_s: f64,
    /// State there.
    pub state: [f64; N],
    /// Place of the contact there.
    pub place: Place,
    /// Slip at A up to it.
    pub inner: SlipRecord,
    /// Slip at B up to it.
    pub outer: SlipRecord,
}

/// A stick of A under which the load comes to a peak: N_bi reaches its largest value so far and falls again, or the run
/// ends. From a stick that is none A slips on while the load builds up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hold {
    /// When it began, s.
    pub t_s: f64,
    /// Slip at A up to it.
    pub inner: SlipRecord,
}

/// The fastest motion where a run gave up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FastMotion {
    /// Its rate, rad/s: |lambda| of the Jacobian's largest eigenvalue.
    pub rate_rad_s: f64,
    /// Its amplitude in the angle that moves most, rad.
    pub amplitude_rad: f64,
    /// What moves most: `sprag` (alpha, phi), `inner race`, `outer race` or `drivetrain`.
    pub of: &'static str,
}

impl FastMotion {
    /// From the part of the state's slope that is as fast as `rate` (rad/s): for a swing a_i cos the angle's rate and
    /// its acceleration give a_i = hypot(rate_i/lambda, acceleration_i/lambda^2).
    pub(super) fn of<const N: usize>(rate: f64, part: &[f64; N]) -> Self {
        let amplitude = |i: usize| (part[i] / rate).hypot(part[4 + i] / (rate * rate));
        let each = [
            (amplitude(0).max(amplitude(1)), "sprag"),
            (amplitude(2), "inner race"),
            (amplitude(3), "outer race"),
            (train::most(part, rate), "drivetrain"),
        ];
        let most = each.iter().fold(each[0], |m, e| if e.0 > m.0 { *e } else { m });
        Self { rate_rad_s: rate, amplitude_rad: most.0, of: most.1 }
    }
}

/// A finished run.
#[derive(Debug, Clone)]
pub struct Run<const N: usize = N_STATE> {
    /// Why it ended.
    pub stop: Stop,
    /// Time reached, s.
    pub t_s: f64,
    /// State there.
    pub state: [f64; N],
    /// Mode there.
    pub mode: Mode,
    /// Slip at A.
    pub inner: SlipRecord,
    /// Slip at B.
    pub outer: SlipRecord,
    /// Path that B slid since the clutch engaged while a driven cage carried the sprags, m: the clutch overran.
    pub carried_m: f64,
    /// Total time without contact at A, s.
    pub open_s: f64,
    /// Longest stretch without contact at A, s.
    pub longest_open_s: f64,
    /// Extremes.
    pub peaks: Peaks,
    /// Largest N_bi at which a contact that held began to slip since the clutch engaged, N; 0: none did.
    pub slip_begins_n: f64,
    /// Largest |T|/N of a contact that sticks while A carries [`Model::loaded_n`] or more; followed by [`run_while_it_sticks`].
    pub asked_under_load: Option<f64>,
    /// Located mode changes.
    pub events: u64,
    /// Work of the integrator.
    pub counters: Counters,
    /// Sequences of changes that accumulated and were closed at their limit.
    pub zeno_closures: u64,
    /// Changes of mode at which no candidate was consistent, the least inconsistent one was taken.
    pub inconsistent_choices: u64,
    /// Where the run ended at its limit of steps or events: what was fastest then.
    pub fast_motion: Option<FastMotion>,
    /// Where the energy went, where that was asked.
    pub energy: Option<EnergyBalance>,
    /// What slip at A and B since the clutch engaged has come to, where that was asked and it has slipped.
    pub slip_heat: [Option<Rubbed>; 2],
    /// Samples in the order of time: equidistant ones, and those that [`History::marks`] adds.
    pub samples: Vec<Sample<N>>,
    /// How many of these are changes of mode.
    pub(super) marked: usize,
    /// The sample at each of the extremes so far, where the history marks them.
    pub(super) extremes: [Option<Sample<N>>; FIGURES],
    /// What the equations leave out.
    pub neglected: Neglected,
    /// When the clutch began to be one; `None`: it overran or was open to the end.
    pub engaged: Option<Engaged<N>>,
    /// The first hold of the load since then that has ended.
    pub(super) hold: Option<Hold>,
    /// The stick of A that lasts.
    pub(super) stick: Option<Hold>,
    /// Every mode with the time at which it began, s; empty where no samples were asked for.
    pub modes: Vec<(f64, Mode)>,
    /// Periods that were jumped, stretch by stretch.
    pub jumps: Vec<Jump>,
    /// What the drivetrain did, where there is one.
    pub train: Option<TrainRun>,
}

/// Tolerance of the steps above which they need not follow how a slip begins: their other errors are larger.
const COARSE: f64 = 2e-3;

impl RunSettings {
    /// Error allowed of a step in `mode`, by component of the state.
    ///
    /// * While both contacts stick: a fifth of the tolerance, with which the least work gives a wanted error. What is wrong with
    ///   the state then is still wrong in the slip that follows.
    /// * alpha' and phi': none, as long as a sticking contact determines them; alpha' has an infinite slope at first contact.
    /// * Slip distances: almost no absolute error. Where friction falls with speed a slip grows from 0 like an exponential,
    ///   and its first steps decide when it is large. Steps coarser than [`COARSE`] do not follow that; they may err more.
    pub(super) fn tolerance_in<const N: usize>(&self, mode: &Mode) -> Tolerance<N> {
        tolerance_at(self.tolerance, mode)
    }
}

/// The same at `tolerance`.
pub(super) fn tolerance_at<const N: usize>(tolerance: f64, mode: &Mode) -> Tolerance<N> {
    let inner = mode.inner == Grip::Stick && mode.place != Place::Open;
    let outer = mode.outer == Grip::Stick;
    let relative = if inner && outer { 0.2 * tolerance } else { tolerance };
    let slip = if tolerance > COARSE { 1e-2 * relative } else { 1e-9 * relative };
    let (angle, rate) = (1e-2 * relative, 5.0 * relative);
    let unless = |follows: bool| if follows { f64::INFINITY } else { rate };
    let (alpha, phi) = (unless(inner && outer), unless(inner || outer));
    Tolerance {
        relative,
        absolute: train::beside(
            [angle, angle, angle, angle, alpha, phi, rate, rate, slip, slip],
            [angle, rate],
        ),
        integrated: train::beside([0.0, 0.0, 0.0, 0.0, angle, angle, angle, angle, 0.0, 0.0], [0.0, angle]),
        datum: [0.0; N],
    }
}

impl<const N: usize> Run<N> {
    /// At t = 0, before anything has happened.
    pub(super) fn start(state: [f64; N], mode: Mode, samples: usize) -> Self {
        Self {
            stop: Stop::Finished,
            t_s: 0.0,
            state,
            mode,
            inner: SlipRecord::default(),
            outer: SlipRecord::default(),
            carried_m: 0.0,
            open_s: 0.0,
            longest_open_s: 0.0,
            peaks: Peaks::NONE,
            slip_begins_n: 0.0,
            asked_under_load: None,
            events: 0,
            counters: Counters::default(),
            zeno_closures: 0,
            inconsistent_choices: 0,
            fast_motion: None,
            energy: None,
            slip_heat: [None; 2],
            samples: Vec::with_capacity(samples),
            marked: 0,
            extremes: [None; FIGURES],
            neglected: Neglected::default(),
            engaged: None,
            hold: None,
            stick: None,
            modes: Vec::new(),
            jumps: Vec::new(),
            train: None,
        }
    }

    /// Whether a contact began to slip under `loaded_n` (N) or more, or the clutch has slipped or overrun by more than `path_m` since it
    /// engaged.
    pub fn has_slipped(&self, loaded_n: f64, path_m: f64) -> bool {
        self.slipped_m() > path_m || self.slip_begins_n >= loaded_n.max(f64::MIN_POSITIVE)
    }

    /// How far the clutch has slipped or overrun since it engaged, m.
    pub fn slipped_m(&self) -> f64 {
        self.engaged.map_or(0.0, |e| self.inner.since(&e.inner).distance_m) + self.carried_m
    }

    /// A stretch without contact that began at `since` ends at `t` (s); one in which a cage carries the sprags is no contact that is lost.
    pub(super) fn end_open(&mut self, since: f64, t: f64) {
        self.open_s += t - since;
        if self.mode.place == Place::Open {
            self.longest_open_s = self.longest_open_s.max(t - since);
        }
    }

    /// Remember the first moment at which A carries load without overrunning.
    pub(super) fn note_engagement(&mut self) {
        let holds = matches!(self.mode.place, Place::Arc(_)) && self.mode.inner != Grip::Slip(1.0);
        if self.engaged.is_none() && holds {
            self.engaged = Some(Engaged {
                t_s: self.t_s,
                state: self.state,
                place: self.mode.place,
                inner: self.inner,
                outer: self.outer,
            });
        }
        self.note_stick();
    }

    /// Remember the first stick of A since then under which the load came to a peak.
    fn note_stick(&mut self) {
        let sticks = matches!(self.mode.place, Place::Arc(_)) && self.mode.inner == Grip::Stick;
        match self.stick {
            None if sticks && self.engaged.is_some() => {
                self.stick = Some(Hold { t_s: self.t_s, inner: self.inner });
            }
            Some(stick) if !sticks => {
                let peak_s = self.peaks.at_s[N_BI];
                self.hold = self.hold.or((stick.t_s < peak_s && peak_s < self.t_s).then_some(stick));
                self.stick = None;
            }
            _ => {}
        }
    }

    /// The first hold of the load since the clutch engaged; a stick that lasts to the end is one.
    pub fn first_hold(&self) -> Option<Hold> {
        self.hold.or(self.stick)
    }
}

impl SlipRecord {
    /// What slipped since `earlier`.
    pub fn since(&self, earlier: &Self) -> Self {
        Self {
            time_s: self.time_s - earlier.time_s,
            distance_m: self.distance_m - earlier.distance_m,
            net_m: self.net_m - earlier.net_m,
        }
    }
}

/// Integrate from `state` at t = 0 in `mode`.
pub fn run(model: &Model, state: State, mode: Mode, settings: &RunSettings) -> Run {
    train::integrate(model, state, mode, settings, None)
}

/// As [`run`], but ended, as [`Stop::Slipped`], once a contact begins to slip while A carries [`Model::loaded_n`] or the path
/// of slip at A since it engaged exceeds `path_m`.
pub fn run_while_it_sticks(
    model: &Model,
    state: State,
    mode: Mode,
    settings: &RunSettings,
    path_m: f64,
) -> Run {
    train::integrate(model, state, mode, settings, Some(path_m))
}
