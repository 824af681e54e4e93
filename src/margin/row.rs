//! One row: a limit, what it demands, what is allowed, and the margin between them.

use super::limits::Limit;
use super::load::NOT_CARRIED;
use super::table::{CONTACT, SLIP};

/// Resolution of a margin: what the optimiser leaves of a limit that it stops at. A margin above minus this is
/// held.
pub const RESOLUTION: f64 = 1e-8;

/// Margin as a number where nothing is demanded: the allowable is a million times the demand or more.
const NOTHING_DEMANDED: f64 = 1e6;

/// Margin as a number where a limit is not held whatever is demanded: no friction suffices, or what is demanded is not known.
pub(crate) const LOST: f64 = -1.0;

/// How a margin comes of demand and allowable; 0 or more is held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rule {
    /// allowable/demand - 1.
    Ratio,
    /// The same, of a torque from which on something is carried.
    Onset,
    /// (1 + slip margin)/(1 + wanted slip margin) - 1: demand is the friction required, allowable mu_s/(1 + wanted).
    Slip,
    /// 1 - demand/allowable; -1 where nothing is allowed.
    Share,
    /// allowable/demand - 1; 1 where nothing is demanded.
    Reserve,
    /// The allowable, a length, over the gap between the tracks at rest.
    Clearance,
    /// The allowable itself.
    Itself,
    /// allowable - demand.
    Difference,
}

impl Rule {
    /// In words, for tables.
    pub fn words(self) -> &'static str {
        match self {
            Self::Ratio => "allowable / demand − 1",
            Self::Onset => "allowable / demand − 1; −1 where it is never carried",
            Self::Slip => {
                "slip margin μs / demand − 1, held from the allowable, the wanted slip margin, up; −1 where no friction suffices"
            }
            Self::Share => "1 − demand / allowable; −1 where the spring closes nothing",
            Self::Reserve => "allowable / demand − 1; 1 where the spring closes nothing",
            Self::Clearance => "clearance over the gap between the tracks at rest",
            Self::Itself => "the ratio itself; −1 where the scenario does not start or end",
            Self::Difference => "allowable − demand",
        }
    }

    /// Margin of a demand that is known; `reference` as in [`Margin`].
    fn margin(self, demand: f64, allowable: f64, reference: f64) -> f64 {
        match self {
            Self::Ratio | Self::Onset | Self::Slip => {
                match demand.abs() * NOTHING_DEMANDED <= allowable.abs() {
                    true => NOTHING_DEMANDED,
                    false => allowable / demand - 1.0,
                }
            }
            Self::Share if allowable > 0.0 => 1.0 - demand / allowable,
            Self::Share => LOST,
            Self::Reserve if demand > 0.0 => allowable / demand - 1.0,
            Self::Reserve => 1.0,
            Self::Clearance => allowable / reference,
            Self::Itself => allowable,
            Self::Difference => allowable - demand,
        }
    }
}

/// What is demanded, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Demand {
    /// So much.
    Value(f64),
    /// More than that, so far as was looked.
    MoreThan(f64),
    /// More friction than there is: the contact would open, or the scene does not start.
    NoneSuffices,
    /// The torque, or the scene, goes beyond the end of the curve.
    Overloaded {
        /// Demand at the end of the curve; `None` of friction, which is a demand of the whole scene.
        at_end: Option<f64>,
        /// What the torque lacks, end/torque - 1, or -1 for a scene: the margin is at most that. `None`: the margin is
        /// that at the end, without a jump where the end passes the torque, as a search needs it.
        shortfall: Option<f64>,
    },
    /// Not known, and why: a run met its limit of work, or the clutch does not engage in the scene.
    NotComputed(&'static str),
}

impl Demand {
    /// As a number where there is one, SI.
    pub fn value(self) -> Option<f64> {
        match self {
            Self::Value(value) | Self::MoreThan(value) => Some(value),
            Self::Overloaded { at_end, .. } => at_end,
            Self::NoneSuffices | Self::NotComputed(_) => None,
        }
    }
}

/// One limit of one design.
#[derive(Debug, Clone, PartialEq)]
pub struct Margin {
    /// The limit.
    pub limit: &'static Limit,
    /// Scenario in which it is held, if any.
    pub scene: Option<String>,
    /// Whether it is the worst sprag of a clutch off centre that is held against a limit for all.
    pub off_centre: bool,
    /// Corner of the tolerances at which the clutch stands; `None`: as drawn.
    pub corner: Option<String>,
    /// Name for people, with what is known of this row.
    pub name: String,
    /// Demand, SI.
    pub demand: Demand,
    /// Allowable, SI; of slip the friction mu_s/(1 + wanted slip margin).
    pub allowable: f64,
    /// What the rule needs besides: of [`Rule::Clearance`] the gap between the tracks, m, of [`Rule::Slip`] the wanted slip
    /// margin; else 0.
    pub reference: f64,
    /// Torque at which this limit would be reached, N m, where it depends on torque.
    pub torque_capacity_nm: Option<f64>,
    /// Whether it counts for the verdict; the others are shown only.
    pub required: bool,
}

impl Margin {
    /// A required row of `limit` under its own name.
    pub fn new(limit: &'static Limit, demand: Demand, allowable: f64) -> Self {
        Self {
            limit,
            scene: None,
            off_centre: false,
            corner: None,
            name: limit.name().to_owned(),
            demand,
            allowable,
            reference: 0.0,
            torque_capacity_nm: None,
            required: true,
        }
    }

    /// The name without the word that its torque is not carried.
    pub fn plain_name(&self) -> &str {
        self.name.split(NOT_CARRIED).next().unwrap_or(&self.name)
    }

    /// Code for scripts, such as `hoop-inner`, `slip:high-6`, `run-out-grip-inner`, `contact:low-4 @ +friction`.
    pub fn code(&self) -> String {
        let off_centre = if self.off_centre { "run-out-" } else { "" };
        let scene = self.scene.as_ref().map_or(String::new(), |scene| format!(":{scene}"));
        let corner = self.corner.as_ref().map_or(String::new(), |corner| format!(" @ {corner}"));
        format!("{off_centre}{}{scene}{corner}", self.limit.code)
    }

    /// Margin as a number for every state of the demand, as a search needs it; 0 or more is held, -1 whatever is demanded
    /// where the demand is no number.
    pub fn margin(&self) -> f64 {
        let by_rule = |demand| self.limit.rule.margin(demand, self.allowable, self.reference);
        match self.demand {
            Demand::Value(demand) => by_rule(demand),
            Demand::Overloaded { at_end, shortfall } => {
                at_end.map_or(LOST, by_rule).min(shortfall.unwrap_or(f64::INFINITY))
            }
            Demand::MoreThan(_) | Demand::NoneSuffices | Demand::NotComputed(_) => LOST,
        }
    }

    /// Whether nothing is demanded, to a millionth of the allowable.
    pub fn demands_nothing(&self) -> bool {
        self.margin() >= NOTHING_DEMANDED
    }

    /// Whether the limit is held.
    pub fn held(&self) -> bool {
        self.margin() >= -RESOLUTION
    }

    /// mu_s over the friction that the scene needs, less 1. `None` of other limits, and where no friction suffices or none
    /// is known.
    pub fn slip_margin(&self) -> Option<f64> {
        self.slip_measure().filter(|_| matches!(self.demand, Demand::Value(_)))
    }

    /// The same as a number for every state of the demand, as a search needs it; `None` of other limits.
    pub fn slip_measure(&self) -> Option<f64> {
        let margin = self.margin();
        let wanted = if margin > LOST { self.reference } else { 0.0 };
        self.is_slip().then_some((1.0 + margin) * (1.0 + wanted) - 1.0)
    }

    /// Whether it is the friction that a scenario needs.
    pub fn is_slip(&self) -> bool {
        self.limit == &SLIP
    }

    /// Whether it is the contact that a scenario keeps.
    pub fn is_contact(&self) -> bool {
        self.limit == &CONTACT
    }

    /// Whether it is a Hertz pressure at nominal or peak torque between concentric races.
    pub fn is_static_pressure(&self) -> bool {
        let key = matches!(self.limit.key, Some("hertz_nominal_mpa" | "hertz_peak_mpa"));
        key && self.scene.is_none() && !self.off_centre
    }

    /// Whether the row is of the same limit, in the same scenario, as `other`.
    pub fn is_of(&self, other: &Self) -> bool {
        let of = |m: &Self| (m.limit.code, m.off_centre, m.scene.clone(), m.corner.clone());
        of(self) == of(other)
    }

    /// Whether a run met its limit of work, so that nothing is known.
    pub fn computed(&self) -> bool {
        !matches!(self.demand, Demand::NotComputed(_))
    }

    /// Whether its scene or its torque goes beyond the end of the curve.
    pub fn overloaded(&self) -> bool {
        matches!(self.demand, Demand::Overloaded { .. })
    }

    /// Whether its torque lies beyond the end of the curve and nothing up to there breaks it: its margin is no more than what the torque
    /// lacks. The end of the curve itself is reached there.
    pub fn is_not_reached(&self) -> bool {
        let Demand::Overloaded { at_end: Some(demand), shortfall: Some(short) } = self.demand else {
            return false;
        };
        short > LOST && self.limit.rule.margin(demand, self.allowable, self.reference) > short.max(RESOLUTION)
    }

    /// Demand in the limit's unit, where it is a number; beyond the end of the curve that at the end.
    pub fn demand_in_unit(&self) -> Option<f64> {
        self.demand.value().map(|demand| demand * self.limit.per_si)
    }

    /// Allowable in the limit's unit; of slip the friction.
    pub fn allowable_in_unit(&self) -> f64 {
        self.allowable * self.limit.per_si
    }

    /// Allowable as it is shown: in the limit's unit, of slip the wanted slip margin. `None` where it is what the scene leaves and
    /// the scene says nothing.
    pub fn shown_allowable(&self) -> Option<f64> {
        match self.limit.rule {
            Rule::Slip => Some(self.reference),
            Rule::Itself if self.demand.value().is_none() => None,
            _ => Some(self.allowable_in_unit()),
        }
    }

    /// Margin as it is shown to people: of slip the slip margin itself, of all others [`Margin::margin`]. `None` where
    /// nothing is demanded.
    pub fn shown_margin(&self) -> Option<f64> {
        let margin = self.slip_measure().unwrap_or(self.margin());
        (!self.demands_nothing()).then_some(if margin.abs() < RESOLUTION { 0.0 } else { margin })
    }
}

/// The required limit among those that `counts` that is reached at the lowest torque, and that torque, N m.
pub fn lowest_capacity(rows: &[Margin], counts: impl Fn(&Margin) -> bool) -> Option<(&Margin, f64)> {
    let counted = rows.iter().filter(|r| r.required && counts(r));
    counted.filter_map(|r| Some((r, r.torque_capacity_nm?))).min_by(|a, b| a.1.total_cmp(&b.1))
}
