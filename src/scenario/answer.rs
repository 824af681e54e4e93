//! What a simulation says: the verdict and every figure.

use super::demand::RollingDemand;
use super::error::Scales;
use super::figures::ErrorEstimate;
use super::verdict::{SLIPPED_M, engaging_m};
use crate::dynamics::{
    EnergyBalance, Engaged, FastMotion, Hold, Jump, Mode, Neglected, Overrun, Peaks, Rubbed, Sample,
    SlipRecord, SlipWork, Stop, TrainRun,
};

named! {
    /// What the clutch did.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Verdict {
        /// No net slip beyond 1 um at the inner contact.
        Sticks = "sticks",
        /// Net slip towards overrunning.
        SlipsOverrunning = "slips-overrunning",
        /// Net slip towards engaging.
        SlipsEngaging = "slips-engaging",
        /// Contact open or without force at the end, open for more than 1 ms at a stretch, or the open sprag fell away.
        Disengages = "disengages",
        /// The load goes beyond the end of the curve: the sprag rolls over or leaves its profile.
        Overloaded = "overloaded",
        /// Closer to another verdict than the error estimate.
        AtThreshold = "at-threshold",
    }
    /// Name in reports and JSON.
    pub fn name;
}

/// Where and why a run did not come to its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GaveUp {
    /// Why.
    pub stop: Stop,
    /// Time reached, s.
    pub t_s: f64,
    /// The limit of steps or mode changes that it met; `None`: steps became too short, it ceased to be finite or was interrupted.
    pub limit: Option<u64>,
}

/// Result of a simulation.
#[derive(Debug, Clone)]
pub struct Simulation {
    /// Verdict; `None` where the run was interrupted or gave up before one was reached.
    pub verdict: Option<Verdict>,
    /// Why the run ended.
    pub stop: Stop,
    /// Time reached, s.
    pub t_s: f64,
    /// theta_bi at the end, rad.
    pub theta_inner_rad: f64,
    /// theta_be at the end, rad.
    pub theta_outer_rad: f64,
    /// Change of (theta_bi - theta_be) + W(alpha) over the run, rad; + towards overrunning. In an engagement since
    /// A ceased to overrun, as all slip.
    pub offset_rad: f64,
    /// Slip at A.
    pub inner: SlipRecord,
    /// Slip at B.
    pub outer: SlipRecord,
    /// Path that B slid since the clutch engaged while a driven cage carried the sprags, m.
    pub carried_m: f64,
    /// Time without contact, s.
    pub contact_lost_s: f64,
    /// Extremes.
    pub peaks: Peaks,
    /// Largest Hertz pressure, Pa.
    pub hertz_peak_pa: f64,
    /// Hertz pressure of the static load that the scene is about (preload, reversing or largest torque), Pa.
    pub hertz_static_pa: f64,
    /// Hertz pressure at A at the smallest N_bi, Pa.
    pub hertz_least_pa: f64,
    /// N_bi at the start, N.
    pub static_normal_n: f64,
    /// Rolling demand; `None` where the run was interrupted, and in overrun, where nothing is to stick.
    pub demand: Option<RollingDemand>,
    /// Whether the friction law was left out: the pure-rolling run is the run.
    pub rolled: bool,
    /// Mode changes.
    pub events: u64,
    /// Steps of all runs.
    pub steps: u64,
    /// Steps refused and tried again, of all runs.
    pub rejections: u64,
    /// Right-hand sides of all runs.
    pub rhs_evaluations: u64,
    /// Error estimate; `None` for an equilibrium ([`Self::equilibrium_error`]), and where a run was interrupted or gave up,
    /// whose figures hold up to [`Self::t_s`].
    pub error: Option<ErrorEstimate>,
    /// Relative error of every figure of an equilibrium; `None` where something is integrated.
    pub equilibrium_error: Option<f64>,
    /// By what errors are divided before they are compared with the tolerance.
    pub scales: Scales,
    /// Whether every error is below the tolerance asked for.
    pub tolerance_reached: bool,
    /// Where the answer is that of the finest runs which came to their end: why a finer one did not.
    pub finer_gave_up: Option<Stop>,
    /// The run that did not come to its end: that of the answer, or a finer one.
    pub gave_up: Option<GaveUp>,
    /// Smallest and largest theta_bi at the end over all runs made, rad: what is left where no digit is sure.
    pub spread_rad: [f64; 2],
    /// Sequences of mode changes that accumulated and were closed at their limit.
    pub zeno_closures: u64,
    /// Mode changes at which no candidate was consistent.
    pub inconsistent_choices: u64,
    /// Where the run gave up at its limit of steps or events: what was fastest then.
    pub fast_motion: Option<FastMotion>,
    /// Where the energy went, where that was asked.
    pub energy: Option<EnergyBalance>,
    /// What slip at A and B has come to, where that was asked and it has slipped; the motion feels nothing of it.
    pub slip_heat: [Option<Rubbed>; 2],
    /// Wear of sprag and race per load and path, m^2/N; `None`: not known.
    pub wear_m2_per_n: Option<[f64; 2]>,
    /// History.
    pub samples: Vec<Sample>,
    /// What the equations leave out, at its largest over the run; 0 without samples.
    pub neglected: Neglected,
    /// When A first carried load without overrunning; `None`: never, or an equilibrium.
    pub engaged: Option<Engaged>,
    /// The first stick of A since then under which the load comes to a peak.
    pub first_hold: Option<Hold>,
    /// Modes with the times at which they began, s; empty without samples.
    pub modes: Vec<(f64, Mode)>,
    /// Whole periods that were not integrated, being like the one before.
    pub jumps: Vec<Jump>,
    /// The drivetrain, where there is one: at the samples, and at the end.
    pub train: Option<TrainRun>,
    /// Steady overrun: the whole of that scenario, the start of an engagement.
    pub overrun: Option<Overrun>,
}

impl Simulation {
    /// Path that A slipped towards engaging, m: under a load that friction does not hold.
    pub fn slipped_engaging_m(&self) -> f64 {
        engaging_m(self.inner.distance_m, self.inner.net_m)
    }

    /// Whether that is slip.
    pub fn slips_under_load(&self) -> bool {
        self.slipped_engaging_m() > SLIPPED_M
    }

    /// All slip at contact 0 (A) or 1 (B); `None` where it has not slipped.
    pub fn slipped(&self, contact: usize) -> Option<SlipWork> {
        self.slip_heat[contact].map(|heat| heat.whole)
    }

    /// Depths that it wears off a sprag and the race, m; `None` also where the wear of these surfaces is not known.
    pub fn wear_m(&self, contact: usize) -> Option<[f64; 2]> {
        Some(self.slipped(contact)?.wear_m(self.wear_m2_per_n?))
    }

    /// Initial slip: how long A slips under load after an overrun has been reversed, s. From the instant at which v_A has
    /// fallen to 0 under load to the first stick under which the load comes to a peak ([`Hold`]); time without contact in
    /// between is not counted, so it is a part of the time of slip of [`Self::inner`]. The paper: about 0.5 ms. `None` without an
    /// overrun or such a stick.
    pub fn initial_slip_s(&self) -> Option<f64> {
        self.overrun?;
        Some(self.first_hold?.inner.since(&self.engaged?.inner).time_s)
    }
}
