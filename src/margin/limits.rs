//! What a limit is; the list of them is in `table`.

use super::load::{LOOKS, LoadCase, LoadState};
use super::row::Rule;
use super::table::LIMITS;
use crate::design::{Design, Limits};
use crate::numeric::golden::top;
use crate::wedge::StaticPoint;

/// When a limit is held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum When {
    /// At the nominal torque.
    Nominal,
    /// At the peak torque, or up to it.
    Peak,
    /// At first contact, without load.
    FirstContact,
    /// In steady overrun.
    Overrun,
    /// In each scenario.
    Scene,
    /// In the outline of the sprag, in a search.
    Outline,
}

impl When {
    /// Key of `[limits]` that names the torque, where it is one.
    pub fn key(self) -> Option<&'static str> {
        match self {
            Self::Nominal => Some("nominal_torque_nm"),
            Self::Peak => Some("peak_torque_nm"),
            _ => None,
        }
    }

    /// The torque, N m, where it is one and the limits name it.
    pub(super) fn torque_nm(self, limits: &Limits) -> Option<f64> {
        match self {
            Self::Nominal => limits.nominal_torque_nm,
            Self::Peak => limits.peak_torque_nm,
            _ => None,
        }
    }
}

/// Allowable of a limit, SI; `None`: not checked.
type Allowed = fn(&Design, &Limits) -> Option<f64>;

/// Pressure of the contact that a limit is of, Pa.
type Pressed = fn(&StaticPoint) -> f64;

/// What is demanded. Of the first three the table says all; the others are rows of their own in the file named.
#[derive(Debug, Clone, Copy)]
pub(super) enum Of {
    /// Of one sprag in a static state, SI; off centre the worst one is held as well.
    Sprag {
        allowed: Allowed,
        demand: fn(&Design, &Limits, &StaticPoint) -> f64,
        /// What states below the torque demand, SI, where the largest on the way counts.
        below_torque: Option<fn(&StaticPoint) -> f64>,
    },
    /// Of the whole clutch in a static state, SI.
    Clutch {
        allowed: Allowed,
        /// Allowable beside which the row is shown only, where its own is not given.
        beside: Option<fn(&Limits) -> Option<f64>>,
        demand: fn(&LoadCase, &StaticPoint) -> f64,
        pressed: Option<Pressed>,
    },
    /// Shear below a contact, Pa, and how deep it is largest, m.
    Shear {
        allowed: Allowed,
        below: fn(&LoadCase, &StaticPoint) -> (f64, f64),
        pressed: Pressed,
    },
    // load.rs
    RollOver,
    AxialFrom,
    Neighbours,
    ReEngagement,
    KeepContact,
    LiftOff,
    Film,
    // scenes.rs
    Slip,
    Contact,
    ScenePressure,
    // run_out/rows.rs
    RunOutEnd,
    RunOutShare,
    // unlike.rs
    UnlikePressure,
    UnlikeFriction,
    // rooms of the flanks (`optimise`)
    Room,
}

impl Of {
    pub const fn sprag(
        allowed: Allowed,
        demand: fn(&Design, &Limits, &StaticPoint) -> f64,
        below_torque: Option<fn(&StaticPoint) -> f64>,
    ) -> Self {
        Self::Sprag { allowed, demand, below_torque }
    }

    pub const fn clutch(allowed: Allowed, demand: fn(&LoadCase, &StaticPoint) -> f64) -> Self {
        Self::Clutch { allowed, beside: None, demand, pressed: None }
    }

    pub const fn beside(
        other: fn(&Limits) -> Option<f64>,
        allowed: Allowed,
        demand: fn(&LoadCase, &StaticPoint) -> f64,
    ) -> Self {
        Self::Clutch { allowed, beside: Some(other), demand, pressed: None }
    }

    /// Along a contact: the state on the way counts too at which that is `pressed` most.
    pub const fn along(demand: fn(&LoadCase, &StaticPoint) -> f64, pressed: Pressed) -> Self {
        Self::Clutch { allowed: |_, l| l.along_pa, beside: None, demand, pressed: Some(pressed) }
    }

    pub const fn shear(
        allowed: Allowed,
        below: fn(&LoadCase, &StaticPoint) -> (f64, f64),
        pressed: Pressed,
    ) -> Self {
        Self::Shear { allowed, below, pressed }
    }
}

/// One limit.
#[derive(Debug)]
pub struct Limit {
    /// Stable code for scripts; a scenario's name comes behind it with a colon, `run-out-` before it off centre.
    pub code: &'static str,
    /// Key of `[limits]` that is its allowable, or without which there is no row; `None`: the design itself sets it.
    pub key: Option<&'static str>,
    pub(super) name: fn(&Limits) -> &'static str,
    /// Unit in which demand and allowable are printed.
    pub unit: &'static str,
    pub(super) per_si: f64,
    /// When it is held.
    pub when: When,
    /// How its margin comes of demand and allowable.
    pub rule: Rule,
    /// What it is and what moves it.
    pub explanation: &'static str,
    /// What is computed, in the symbols of the guide.
    pub formula: &'static str,
    /// Where that comes from: equation, textbook, standard.
    pub source: &'static str,
    /// Whether to reach it is to reach the end of the static curve.
    pub ends_curve: bool,
    pub(super) of: Of,
}

impl PartialEq for Limit {
    fn eq(&self, other: &Self) -> bool {
        self.code == other.code
    }
}

impl Limit {
    /// Name for people; `{scene}` stands for the name of a scenario.
    pub fn name(&self) -> &'static str {
        (self.name)(&Limits::default())
    }

    /// Whether it is the pressure along a contact.
    pub fn is_along(&self) -> bool {
        self.key == Some("along_mpa")
    }

    /// Whether demand and allowable are coefficients of friction: the grip of a contact, and that of one that slides.
    pub fn is_grip(&self) -> bool {
        self.code.starts_with("grip-") || matches!(self.of, Of::ReEngagement)
    }

    /// Allowable, SI, and whether it counts for the verdict, of what a static state demands.
    pub(super) fn allowed(&self, design: &Design, limits: &Limits) -> Option<(f64, bool)> {
        match self.of {
            Of::Sprag { allowed, .. } | Of::Shear { allowed, .. } => {
                allowed(design, limits).map(|a| (a, true))
            }
            Of::Clutch { allowed, beside, .. } => {
                let shown = || beside.and_then(|beside| beside(limits)).map(|a| (a, false));
                allowed(design, limits).map(|a| (a, true)).or_else(shown)
            }
            _ => None,
        }
    }

    /// Demand of a static state, SI.
    pub(super) fn demand(&self, case: &LoadCase, p: &StaticPoint) -> Option<f64> {
        match self.of {
            Of::Sprag { demand, .. } => Some(demand(case.design, case.limits, p)),
            Of::Clutch { demand, .. } => Some(demand(case, p)),
            Of::Shear { below, .. } => Some(below(case, p).0),
            _ => None,
        }
    }

    /// The demand at `peak`, or at one of the states `below` where one of those is larger, SI.
    pub(super) fn largest(&self, case: &LoadCase, peak: &StaticPoint, below: &[StaticPoint]) -> Option<f64> {
        let (grip, pressed) = match self.of {
            Of::Sprag { below_torque, .. } if self.is_grip() => (below_torque, None),
            Of::Sprag { below_torque, .. } => (None, below_torque),
            Of::Clutch { pressed, .. } => (None, pressed),
            Of::Shear { pressed, .. } => (None, Some(pressed)),
            _ => (None, None),
        };
        let lower = grip.into_iter().flat_map(|demand| below.iter().map(demand));
        let most_pressed = pressed.and_then(|pa| most_pressed(case.state, peak, below, pa));
        let there = most_pressed.and_then(|p| self.demand(case, &p));
        self.demand(case, peak).map(|at_peak| lower.chain(there).fold(at_peak, f64::max))
    }

    /// Name of its row at a static state.
    pub(super) fn name_at(&self, case: &LoadCase, required: bool, p: &StaticPoint) -> String {
        let name = (self.name)(case.limits);
        match (self.of, required) {
            (_, false) => {
                let own = self.key.unwrap_or_default();
                format!("{name}, beside the limit on the mean; limits.{own} would be its own")
            }
            (Of::Shear { below, .. }, _) => format!("{name}, {:.3} mm deep", below(case, p).1 * 1e3),
            _ => name.to_owned(),
        }
    }
}

/// The state on the way to `peak`, next to one of those `below`, in which a contact is pressed most; `None` where that is less than at the
/// peak: nothing of the contact is larger then.
fn most_pressed(
    state: &LoadState,
    peak: &StaticPoint,
    below: &[StaticPoint],
    pressed: Pressed,
) -> Option<StaticPoint> {
    let more = below.iter().filter(|p| pressed(p) > pressed(peak));
    let near = more.max_by(|a, b| pressed(a).total_cmp(&pressed(b)))?;
    let (at_n, step_n) = (near.normal_inner_n, peak.normal_inner_n / LOOKS as f64);
    let there = |n: f64| state.curve.at_normal(n);
    let top_n = top(at_n - step_n, at_n + step_n, |n| there(n).map_or(0.0, |p| pressed(&p)));
    there(top_n).filter(|p| pressed(p) > pressed(near)).or(Some(*near))
}

/// The limit with that code, such as `hoop-inner`, `slip` or `run-out-hertz-peak-inner`.
pub fn limit_of(code: &str) -> Option<&'static Limit> {
    let find = |code: &str| LIMITS.iter().copied().find(|limit| limit.code == code);
    let code = code.split([':', ' ']).next().unwrap_or(code);
    find(code).or_else(|| find(code.strip_prefix("run-out-")?))
}
