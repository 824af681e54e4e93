//! What a limit is; the list of them is in `table`.

use super::load::LoadCase;
use super::row::Rule;
use super::table::LIMITS;
use crate::design::{Design, Limits};
use crate::wedge::StaticPoint;

/// When a limit is held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum When {
    /// At the nominal torque, or up to it.
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
    },
    /// Shear below a contact, Pa, and how deep it is largest, m.
    Shear {
        allowed: Allowed,
        below: fn(&LoadCase, &StaticPoint) -> (f64, f64),
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
        Self::Clutch { allowed, beside: None, demand }
    }

    pub const fn beside(
        other: fn(&Limits) -> Option<f64>,
        allowed: Allowed,
        demand: fn(&LoadCase, &StaticPoint) -> f64,
    ) -> Self {
        Self::Clutch { allowed, beside: Some(other), demand }
    }

    pub const fn shear(allowed: Allowed, below: fn(&LoadCase, &StaticPoint) -> (f64, f64)) -> Self {
        Self::Shear { allowed, below }
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
    /// Whether the state on the way to its torque counts too in which the inner contact is pressed most.
    pub(super) pressed: bool,
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
        let below_torque = match self.of {
            Of::Sprag { below_torque, .. } => below_torque,
            _ => None,
        };
        let lower = below_torque.into_iter().flat_map(|demand| below.iter().map(demand));
        self.demand(case, peak).map(|at_peak| lower.fold(at_peak, f64::max))
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

/// The limit with that code, such as `hoop-inner`, `slip` or `run-out-hertz-peak-inner`.
pub fn limit_of(code: &str) -> Option<&'static Limit> {
    let find = |code: &str| LIMITS.iter().copied().find(|limit| limit.code == code);
    let code = code.split([':', ' ']).next().unwrap_or(code);
    find(code).or_else(|| find(code.strip_prefix("run-out-")?))
}
