//! The answer of `life` by its keys in JSON, and its tables.

use super::{LifeAnswer, LifeKnown, Swung};
use crate::answer::Said;
use crate::life::{LoadEffect, Used, WornState};
use crate::report::{Cell, Rows, Unit};
use serde::Serialize;

/// A scenario that goes on for some time, as a load.
#[derive(Debug, Clone, Serialize)]
pub struct SwingBody<'a> {
    /// How often it does in the life.
    pub engagements: f64,
    /// Its frequency, Hz.
    pub frequency_hz: f64,
    /// Least torque that the clutch carries in it, N m.
    pub from_nm: f64,
    /// How long in the life, h.
    pub hours: f64,
    /// Name of the scenario.
    pub scenario: &'a str,
    /// Largest torque that the clutch carries in it, N m.
    pub torque_nm: f64,
}

/// Wear over the life.
#[derive(Debug, Clone, Serialize)]
pub struct WearBody<'a> {
    /// After how many lives a limit is broken; null: not within those looked at.
    pub broken_after_lives: Option<f64>,
    /// What is broken first.
    pub broken_by: Option<&'static str>,
    /// Overrun in one life, h.
    pub hours: f64,
    /// The clutch as it wears, a row of [`LifeAnswer::wear`] each.
    pub states: Rows<&'a WornState>,
}

/// Keys of `life`.
#[derive(Debug, Clone, Serialize)]
pub struct LifeBody<'a> {
    /// Engagements in the life.
    pub engagements: f64,
    /// Slips expected by chance in the life; null: nothing scatters.
    pub expected_slips: Option<f64>,
    /// Whether nothing fails before the end of the life, of what is known.
    pub held: bool,
    /// By how much the largest load may grow until the inner contact is indented, a factor.
    pub indentation_inner: f64,
    /// By how much the largest load may grow until the outer contact is indented, a factor.
    pub indentation_outer: f64,
    /// Whether the largest torque indents a contact.
    pub indents: bool,
    /// Largest torque of the life, N m.
    pub largest_torque_nm: f64,
    /// Each load, a row of [`LifeAnswer::loads`].
    pub loads: Rows<&'a LoadEffect>,
    /// Codes of the places that no strength is given for.
    pub not_known: Vec<&'static str>,
    /// Each place, a row of [`LifeAnswer::places`].
    pub places: Rows<&'a Used>,
    /// How many may be; null: the file does not say.
    pub slips_allowed: Option<f64>,
    /// Scenarios that go on for some time.
    pub swings: Vec<SwingBody<'a>>,
    /// Scenarios that swing and that the service does not name.
    pub swings_not_counted: Vec<&'a str>,
    /// The answer in a sentence.
    pub verdict: String,
    /// Wear; absent where nothing is known to wear.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wear: Option<WearBody<'a>>,
}

impl<'a> SwingBody<'a> {
    fn of(swung: &'a Swung) -> Self {
        Self {
            scenario: &swung.scenario,
            hours: swung.duration_s / 3600.0,
            frequency_hz: swung.frequency_hz,
            from_nm: swung.load.from_nm,
            torque_nm: swung.load.torque_nm,
            engagements: swung.load.engagements,
        }
    }
}

impl<'a> LifeBody<'a> {
    pub(super) fn of(answer: &'a LifeAnswer<'_>) -> Self {
        let life = &answer.life;
        let wear = answer.worn.as_ref().zip(answer.wear()).map(|(worn, states)| {
            let broken = worn.broken();
            WearBody {
                hours: worn.hours,
                broken_after_lives: broken.map(|b| b.0),
                broken_by: broken.map(|b| b.1.names().0),
                states,
            }
        });
        Self {
            swings: answer.swung.iter().map(SwingBody::of).collect(),
            swings_not_counted: answer.not_counted().collect(),
            held: answer.known() != LifeKnown::NotHeld,
            verdict: answer.verdict(),
            engagements: life.engagements,
            largest_torque_nm: life.largest_nm,
            expected_slips: life.slips,
            slips_allowed: life.slips_allowed,
            indents: life.indents(),
            not_known: life.not_known().map(|place| place.names().0).collect(),
            indentation_inner: life.indentation[0],
            indentation_outer: life.indentation[1],
            places: answer.places(),
            loads: answer.loads(),
            wear,
        }
    }
}

impl LifeAnswer<'_> {
    /// The clutch as it wears; `None` where nothing is known to wear.
    pub fn wear(&self) -> Option<Rows<&WornState>> {
        let worn = self.worn.as_ref()?;
        let (hours, engagements) = (worn.hours, self.life.engagements);
        let rows = Rows::of(&worn.states)
            .number("hours", "Overrun, h", Unit::One, 4, |s| hours * s.share)
            .number("engagements", "Engagements", Unit::One, 4, |s| engagements * s.share)
            .number("flat_um", "Flat", Unit::Micrometre, 3, |s| s.flat_m);
        // The track that they slide on is shown.
        let inner = |s: &&WornState| s.wear.inner_track_m;
        let outer = |s: &&WornState| s.wear.outer_track_m;
        let rows = match self.design.clutch.slides_outside() {
            false => rows
                .number("inner_track_um", "Track", Unit::Micrometre, 3, inner)
                .json_in("outer_track_um", Unit::Micrometre, outer)
                .json("normal_inner_n", |s| s.normal_n),
            true => rows
                .number("outer_track_um", "Track", Unit::Micrometre, 3, outer)
                .number("clearance_um", "Clearance left", Unit::Micrometre, 3, |s| s.clearance_m)
                .json_in("inner_track_um", Unit::Micrometre, inner)
                .json("normal_outer_n", |s| s.normal_n),
        };
        let rows = rows
            .number("opened_um", "Gap opens", Unit::Micrometre, 3, |s| s.opened_m)
            .number("first_tan_omega", "tan ω first", Unit::One, 4, |s| s.first_tan_omega)
            .number("required_friction", "μ needed", Unit::One, 4, |s| s.required_friction)
            .number("capacity_nm", "Capacity", Unit::NewtonMetre, 4, |s| s.capacity.as_ref().map(|c| c.0))
            .number("lift_off_rpm", "Lift-off", Unit::Rpm, 4, |s| s.lift_off_rad_s)
            .text("state", "State", |s| match s.broken {
                Some(why) => Cell::Verdict(false, why.names().0.to_owned()),
                None => Cell::Verdict(true, "holds".to_owned()),
            })
            .json("share", |s| s.share)
            .json_in("half_flat_um", Unit::Micrometre, |s| s.half_flat_m)
            .json_in("inner_arcs_um", Unit::Micrometre, |s| s.wear.inner_arcs_m[0])
            .json_in("outer_arc_um", Unit::Micrometre, |s| s.wear.outer_arc_m)
            .json("capacity_by", |s| s.capacity.as_ref().map(|c| c.1.clone()))
            .json("broken", |s| s.broken.map(|why| why.names().0));
        Some(rows)
    }

    /// Each place: what is used up.
    pub fn places(&self) -> Rows<&Used> {
        let verdict = |used: &Used| match used.sum {
            Some(sum) => Cell::held(sum <= 1.0 && self.used_worn(used.place).is_none_or(|sum| sum <= 1.0)),
            None if self.life.loads.iter().any(|l| l.state.is_none()) => "torque not carried".into(),
            None => "strength not given".into(),
        };
        let worn = |used: &&Used| self.used_worn(used.place);
        let rows = Rows::of(&self.life.used)
            .text("place", "Place", |used| used.place.names().1)
            .number("cycles", "Cycles", Unit::One, 4, |used| used.cycles)
            .number("used", "Used up", Unit::One, 3, |used| used.sum)
            .shown_in(Unit::Percent);
        let rows = match self.worn.is_some() {
            true => rows.number("used_worn", "As it wears", Unit::One, 3, worn).shown_in(Unit::Percent),
            false => rows.json("used_worn", worn),
        };
        rows.number("lives", "Lives", Unit::One, 3, |used| used.lives().filter(|l| l.is_finite()))
            .number("mostly_at_nm", "Mostly at", Unit::NewtonMetre, 4, |used| {
                used.sum.map(|_| used.mostly_nm)
            })
            .text("verdict", "Verdict", |used| verdict(used))
            .json("code", |used| used.place.names().0)
    }

    /// Each load: what one engagement at it does.
    pub fn loads(&self) -> Rows<&LoadEffect> {
        Rows::of(&self.life.loads)
            .number("torque_nm", "Torque", Unit::NewtonMetre, 4, |l| l.torque_nm)
            .number("engagements", "Engagements", Unit::One, 4, |l| l.engagements)
            .number("hertz_inner_mpa", "p₀ inner", Unit::Megapascal, 4, |l| {
                l.state.map(|p| p.hertz_inner_pa)
            })
            .number("hertz_outer_mpa", "p₀ outer", Unit::Megapascal, 4, |l| {
                l.state.map(|p| p.hertz_outer_pa)
            })
            .number("hoop_inner_mpa", "Hoop+bending inner", Unit::Megapascal, 4, |l| {
                l.state.map(|_| l.hoop_pa[0])
            })
            .number("hoop_outer_mpa", "Hoop+bending outer", Unit::Megapascal, 4, |l| {
                l.state.map(|_| l.hoop_pa[1])
            })
            .number("walk_inner_mm", "Walk inner", Unit::Millimetre, 3, |l| l.state.map(|_| l.walk_m[0]))
            .number("walk_outer_mm", "Walk outer", Unit::Millimetre, 3, |l| l.state.map(|_| l.walk_m[1]))
            .number("slip_probability", "Slips, of one", Unit::One, 2, |l| l.slip)
            .json("carried", |l| l.state.is_some())
            .json("passes_inner", |l| l.passes[0])
            .json("passes_outer", |l| l.passes[1])
    }
}
