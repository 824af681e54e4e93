//! What a torsional excitation does once its start is forgotten: the periodic motion, found by shooting.
//!
//! Two questions, as of a transient: what would rolling demand, and what does the clutch do. Where friction suffices both are
//! one motion. A motion that Newton does not find, or that does not repeat, is an answer with a name.

use super::demand::{STEPS_PER_PERIOD_OF_DEMAND, slip_margin};
use super::prepare::Prepared;
use super::simulate::Settings;
use crate::dynamics::{
    FINEST_STEPS, Grip, Mode, NoOrbit, Orbit, Place, Rolling, RunSettings, Shooting, State, Stop, orbit,
};

/// What the clutch does in each period.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MotionKind {
    /// Both contacts roll.
    Rolls,
    /// A contact slips, A keeps its load.
    Slips,
    /// A opens.
    LiftsOff,
    /// It ends: the load goes beyond the end of the curve, off the profile or over its highest point.
    Overloaded,
    /// It ends: the sprags are thrown farther from the race than is followed.
    Disengages,
    /// No periodic motion was found.
    NotFound,
}

impl MotionKind {
    /// Name in reports and JSON; what ends goes by the words of a [`super::Verdict`].
    pub fn name(self) -> &'static str {
        match self {
            Self::Rolls => "rolls",
            Self::Slips => "slips",
            Self::LiftsOff => "lifts-off",
            Self::Overloaded => super::Verdict::Overloaded.name(),
            Self::Disengages => super::Verdict::Disengages.name(),
            Self::NotFound => "not-found",
        }
    }
}

/// The periodic state of a scene.
#[derive(Debug, Clone)]
pub struct Steady {
    /// Both contacts rolling, whatever friction that takes.
    pub rolling: Result<Orbit, NoOrbit>,
    /// With the friction there is; the rolling motion where that suffices.
    pub motion: Result<Orbit, NoOrbit>,
    /// What it does.
    pub kind: MotionKind,
    /// Static friction that rolling needs, its peak of |T|/N; `None`: rolling unloads A or needs tension, or was not found.
    pub required_friction: Option<f64>,
    /// mu_s/mu_req - 1; `None` where no mu_req is.
    pub slip_margin: Option<f64>,
    /// Smallest N_bi of the rolling motion over the static one, or over the largest where nothing is static; `None`: not
    /// found.
    pub contact_margin: Option<f64>,
    /// Periods integrated.
    pub periods: u64,
}

/// How far apart, relatively, extremes of two motions are that are not one.
const APART: f64 = 1e-3;

impl Steady {
    /// Whether the motion comes back from small disturbances; `None`: there is none, or [`Orbit::is_stable`] cannot tell.
    pub fn is_stable(&self) -> Option<bool> {
        self.motion.as_ref().ok().and_then(Orbit::is_stable)
    }

    /// Whether it is another motion than `other`.
    pub fn differs(&self, other: &Self) -> bool {
        match (&self.motion, &other.motion) {
            (Ok(a), Ok(b)) => {
                let (a, b) = (a.run.peaks, b.run.peaks);
                let size = APART * a.normal_max_n.max(b.normal_max_n);
                (a.normal_max_n - b.normal_max_n).abs() > size
                    || (a.normal_min_n - b.normal_min_n).abs() > size
            }
            _ => false,
        }
    }
}

/// Tolerance of the steps over that of the figures.
const FINER: f64 = 1e-2;
/// Last Newton step over the tolerance of the figures.
const NEWTON: f64 = 0.1;
/// Periods that are run before the first Newton where nothing is near.
const SETTLE: u64 = 3;
/// Samples of a period.
const SAMPLES: usize = 241;

/// The periodic state of `prepared`, which has an excitation; looked for from `near`, that of a scene like it, where there is
/// one. `None`: it has none. [`Settings::tolerance`] holds for every figure by its natural size, [`Settings::samples`] are
/// those of a period.
pub fn steady_motion(prepared: &Prepared, settings: &Settings, near: Option<&Steady>) -> Option<Steady> {
    let period_s = prepared.period_s?;
    let model = &prepared.model;
    let [most_steps, most_events] = settings.limits(prepared);
    let period = RunSettings {
        tolerance: (FINER * settings.tolerance).max(FINEST_STEPS),
        duration_s: period_s,
        longest_step_s: settings.longest_step_s.unwrap_or(period_s / STEPS_PER_PERIOD_OF_DEMAND),
        most_events,
        most_steps,
        samples: settings.samples,
        energy: settings.energy,
        history: settings.history,
        follow: settings.follow.clone(),
        ..RunSettings::default()
    };
    let search = |start: (State, Mode), rolling: bool, settle: u64| {
        let period = RunSettings { rolling, ..period.clone() };
        orbit(model, start.0, start.1, &Shooting { period, accuracy: NEWTON * settings.tolerance, settle })
    };
    let from = |orbit: &Orbit| (orbit.state, orbit.mode);
    let placed = |(state, mode): (State, Mode)| {
        let place = match mode.place {
            Place::Arc(_) | Place::Tension if state[0] >= model.curve.first_contact_rad() => {
                Place::Arc(model.curve.arc_at(state[0]))
            }
            Place::Arc(_) => Place::Arc(0),
            other => other,
        };
        (state, Mode { place, ..mode })
    };
    let at_rest = {
        let place = if prepared.mode.place == Place::Open { Place::Arc(0) } else { prepared.mode.place };
        (prepared.state, Mode { place, inner: Grip::Stick, outer: Grip::Stick })
    };
    let before = near.and_then(|near| near.rolling.as_ref().ok());
    let rolling = before
        .and_then(|before| search(placed(from(before)), true, 0).ok())
        .map_or_else(|| search(at_rest, true, SETTLE), Ok);
    let demand = rolling.as_ref().ok().map(|orbit| Rolling::of(model, orbit.run.clone()));
    let required_friction = demand.as_ref().and_then(|d| d.required_friction);
    let suffices = required_friction.is_some_and(|mu| mu <= model.friction.static_);
    // A motion that slips may go on beside one that rolls.
    let slipping = near.filter(|near| matches!(near.kind, MotionKind::Slips | MotionKind::LiftsOff));
    let beside = slipping.and_then(|near| near.motion.as_ref().ok());
    let continued = beside
        .and_then(|before| search(placed(from(before)), false, 0).ok())
        .filter(|found| !suffices || kind(found) != MotionKind::Rolls);
    let motion = match (continued, &rolling) {
        (Some(found), _) => Ok(found),
        (None, Ok(rolling)) if suffices => Ok(rolling.clone()),
        _ => search((prepared.state, prepared.mode), false, SETTLE),
    };
    let kind = match &motion {
        Ok(found) => kind(found),
        Err(NoOrbit::Ends(Stop::CurveEnd)) => MotionKind::Overloaded,
        Err(NoOrbit::Ends(Stop::FellAway)) => MotionKind::Disengages,
        Err(_) => MotionKind::NotFound,
    };
    let of = |orbit: &Result<Orbit, NoOrbit>| orbit.as_ref().map_or(0, |o| o.periods);
    let static_n = prepared.static_normal_n;
    Some(Steady {
        periods: of(&rolling) + of(&motion),
        kind,
        required_friction,
        slip_margin: slip_margin(model, required_friction),
        contact_margin: demand.map(|d| d.contact_margin(static_n)),
        rolling,
        motion,
    })
}

fn kind(orbit: &Orbit) -> MotionKind {
    let run = &orbit.run;
    let slips = run.inner.distance_m + run.outer.distance_m > 0.0;
    if run.open_s > 0.0 || run.peaks.normal_min_n <= 0.0 {
        MotionKind::LiftsOff
    } else if slips {
        MotionKind::Slips
    } else {
        MotionKind::Rolls
    }
}

/// Settings of one state that is looked at closely: samples and works of a period.
pub fn closely(settings: &Settings) -> Settings {
    Settings { samples: SAMPLES, energy: true, ..settings.clone() }
}
