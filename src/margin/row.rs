//! One row: a limit, what it demands, what is allowed, and the margin between them.

use super::limits::{Limit, Of};
use super::table::{CONTACT, SLIP};

/// Resolution of a margin: what the optimiser leaves of a limit that it stops at. A margin above minus this is
/// held.
pub const RESOLUTION: f64 = 1e-8;

/// Allowable over demand from which on nothing is demanded.
const NOTHING: f64 = 1e6;

/// What is left of a limit: its margin, where that is a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Left {
    /// So much; 0 or more is held.
    Value(f64),
    /// All of it: nothing is demanded, to a millionth of the allowable.
    All,
    /// Nothing, whatever is demanded: no friction suffices, a scene goes beyond the end of the curve, or what is demanded was not
    /// found.
    Lost,
    /// Not known: [`Demand::Unknown`].
    Unknown,
}

impl Left {
    /// As a number in every state, by which rows are ordered, as JSON has it and as a search needs it: 1e6 of all, -1 of a lost
    /// limit, NaN of an unknown one, which no answer has.
    pub fn number(self) -> f64 {
        match self {
            Self::Value(left) => left,
            Self::All => NOTHING,
            Self::Lost => -1.0,
            Self::Unknown => f64::NAN,
        }
    }
}

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
            Self::Share => "1 − demand / allowable; −1 where neither spring nor speed closes",
            Self::Reserve => {
                "allowable / demand − 1; where the spring closes nothing 1, or −1 where the speed does"
            }
            Self::Clearance => "clearance over the gap between the tracks at rest",
            Self::Itself => "the ratio itself; −1 where the scenario does not start or end",
            Self::Difference => "allowable − demand",
        }
    }

    /// What is left at a demand that is known; `reference` as in [`Margin`].
    fn left(self, demand: f64, allowable: f64, reference: f64) -> Left {
        match self {
            Self::Ratio | Self::Onset | Self::Slip if demand.abs() * NOTHING <= allowable.abs() => Left::All,
            Self::Share if allowable <= 0.0 && demand < allowable => Left::All,
            Self::Share if allowable <= 0.0 => Left::Lost,
            Self::Ratio | Self::Onset | Self::Slip => Left::Value(allowable / demand - 1.0),
            Self::Share => Left::Value(1.0 - demand / allowable),
            Self::Reserve if demand > 0.0 => Left::Value(allowable / demand - 1.0),
            Self::Reserve if allowable < demand => Left::Lost,
            Self::Reserve => Left::Value(1.0),
            Self::Clearance => Left::Value(allowable / reference),
            Self::Itself => Left::Value(allowable),
            Self::Difference => Left::Value(allowable - demand),
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
    /// The scene's torque does not keep the clutch engaged, and no friction holds it: it is to let go.
    LetsGo,
    /// The torque, or the scene, goes beyond the end of the curve.
    Overloaded {
        /// Demand at the end of the curve; `None` of friction, which is a demand of the whole scene.
        at_end: Option<f64>,
        /// What that leaves of the limit.
        beyond: BeyondEnd,
    },
    /// Not looked at: a neighbour in a search that is not followed, so that a slope has to be found otherwise.
    Unknown,
    /// Not known, and why: a run met its limit of work, or the clutch does not engage in the scene.
    NotComputed(&'static str),
}

impl Demand {
    /// As a number where there is one, SI.
    pub fn value(self) -> Option<f64> {
        match self {
            Self::Value(value) | Self::MoreThan(value) => Some(value),
            Self::Overloaded { at_end, .. } => at_end,
            Self::NoneSuffices | Self::LetsGo | Self::NotComputed(_) | Self::Unknown => None,
        }
    }
}

/// What is left of a limit whose torque, or scene, goes beyond the end of the curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BeyondEnd {
    /// As a search needs it, without a jump where the end passes the torque: as much as at the end, at most `short`. For a verdict
    /// it is at most what the torque `lacks`, end/torque - 1: [`Margin::as_checked`].
    AsAtEnd {
        /// Of the end of the profile what a search counts as short; infinite of all others.
        short: f64,
        /// end/torque - 1.
        lacks: f64,
    },
    /// At most what the torque lacks, end/torque - 1.
    Short(f64),
    /// Nothing: a scene goes there, or nothing was found up to the end.
    Lost,
}

/// One limit of one design.
#[derive(Debug, Clone, PartialEq)]
pub struct Margin {
    /// The limit.
    pub limit: &'static Limit,
    /// Scenario in which it is held, if any.
    pub scene: Option<String>,
    /// Whether it is the worst sprag of a clutch off centre that is compared with a limit for all.
    pub off_centre: bool,
    /// Corner of the tolerances at which the clutch stands; `None`: as drawn.
    pub corner: Option<String>,
    /// Name for people.
    pub name: String,
    /// What is said behind it where the demand is not that of its torque or scene: not carried, overloaded, not computed.
    pub aside: Option<String>,
    /// Demand, SI.
    pub demand: Demand,
    /// Allowable, SI; of slip the friction mu_s/(1 + wanted slip margin).
    pub allowable: f64,
    /// What the rule needs besides: of [`Rule::Clearance`] the gap between the tracks, m, of [`Rule::Slip`] the wanted slip
    /// margin; else 0.
    pub reference: f64,
    /// Torque at which this limit would be reached, N m, where it depends on torque.
    pub torque_capacity_nm: Option<f64>,
    /// Torque at which the curve that it is read from ends, N m; `None`: that at rest does.
    pub end_torque_nm: Option<f64>,
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
            aside: None,
            demand,
            allowable,
            reference: 0.0,
            torque_capacity_nm: None,
            end_torque_nm: None,
            required: true,
        }
    }

    /// The name with what is said behind it.
    pub fn full_name(&self) -> String {
        let aside = self.aside.as_ref().map_or(String::new(), |aside| format!(": {aside}"));
        format!("{}{aside}", self.name)
    }

    /// Code for scripts, such as `hoop-inner`, `slip:high-6`, `run-out-grip-inner`, `contact:low-4 @ +friction`.
    pub fn code(&self) -> String {
        let off_centre = if self.off_centre { "run-out-" } else { "" };
        let scene = self.scene.as_ref().map_or(String::new(), |scene| format!(":{scene}"));
        let corner = self.corner.as_ref().map_or(String::new(), |corner| format!(" @ {corner}"));
        format!("{off_centre}{}{scene}{corner}", self.limit.code)
    }

    /// What is left by the rule at a demand that is known.
    fn by_rule(&self, demand: f64) -> Left {
        self.limit.rule.left(demand, self.allowable, self.reference)
    }

    /// What is left of the limit.
    pub fn left(&self) -> Left {
        match self.demand {
            Demand::Value(demand) => self.by_rule(demand),
            // Of a torque of which nothing is carried nothing is left.
            Demand::Overloaded {
                at_end: Some(demand),
                beyond: BeyondEnd::Short(short) | BeyondEnd::AsAtEnd { short, .. },
            } if short > -1.0 => match self.by_rule(demand) {
                Left::Value(left) => Left::Value(left.min(short)),
                Left::All if short.is_finite() => Left::Value(short),
                left => left,
            },
            Demand::Unknown => Left::Unknown,
            Demand::Overloaded { .. }
            | Demand::MoreThan(_)
            | Demand::NoneSuffices
            | Demand::LetsGo
            | Demand::NotComputed(_) => Left::Lost,
        }
    }

    /// The same as a number, [`Left::number`]; 0 or more is held.
    pub fn margin(&self) -> f64 {
        self.left().number()
    }

    /// Whether nothing is demanded, to a millionth of the allowable.
    pub fn demands_nothing(&self) -> bool {
        self.margin() >= NOTHING
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
        let wanted = if self.left() == Left::Lost { 0.0 } else { self.reference };
        self.is_slip().then_some((1.0 + self.margin()) * (1.0 + wanted) - 1.0)
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

    /// Whether it is of sprags one by one, off centre or unlike.
    pub fn of_single_sprags(&self) -> bool {
        let unlike = matches!(self.limit.of, Of::UnlikePressure | Of::UnlikeFriction);
        self.off_centre || unlike || matches!(self.limit.of, Of::RunOutEnd | Of::RunOutShare)
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

    /// As `check` counts it where a search goes on without a jump.
    pub fn as_checked(mut self) -> Self {
        if let Demand::Overloaded { beyond: beyond @ BeyondEnd::AsAtEnd { .. }, .. } = &mut self.demand
            && let BeyondEnd::AsAtEnd { lacks, .. } = *beyond
        {
            *beyond = BeyondEnd::Short(lacks);
        }
        self
    }

    /// Whether its scene or its torque goes beyond the end of the curve.
    pub fn overloaded(&self) -> bool {
        matches!(self.demand, Demand::Overloaded { .. })
    }

    /// Whether its torque lies beyond the end of the curve and nothing up to there breaks it: its margin is no more than what the torque
    /// lacks. The end of the curve itself is reached there.
    pub fn is_not_reached(&self) -> bool {
        let Demand::Overloaded { at_end: Some(demand), beyond: BeyondEnd::Short(short) } = self.demand else {
            return false;
        };
        short > -1.0 && self.by_rule(demand).number() > short.max(RESOLUTION)
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
