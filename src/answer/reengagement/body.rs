//! The answer of `reengage` by its keys in JSON, and its table.

use super::{BlowAt, BorneSlip, ReengagementAnswer};
use crate::answer::Said;
use crate::dynamics::Stop;
use crate::reengage::{Blow, SlipEnd};
use crate::report::{Cell, Rows, Unit};
use serde::Serialize;

/// What would be borne where a blow is not.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct BorneBody {
    /// Friction from which on the shortest path asked for is borne; null: none below what the torque needs.
    pub friction: Option<f64>,
    /// Longest path of slip at the friction given, mm; null: not even the shortest that is tried.
    pub path_mm: Option<f64>,
}

/// Where the slip itself throws the sprags out of reach.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct ThrownBody {
    /// How long after the slip begins they are, ms.
    pub at_ms: f64,
    /// Speed of the outer race, rev/min.
    pub outer_rpm: f64,
    /// Path of slip until the sprags are thrown out, mm.
    pub path_mm: f64,
    /// Speed of the races against one another, rev/min.
    pub speed_rpm: f64,
}

/// Keys of `reengage`.
#[derive(Debug, Clone, Serialize)]
pub struct ReengagementBody<'a> {
    /// Code of the limit that sets the peak torque that is borne.
    pub bears_by: Option<&'a str>,
    /// Energy that the windup takes up from the torque carried to the one that the limits bear, J.
    pub bears_j: Option<f64>,
    /// Peak torque that every limit bears, N m.
    pub bears_nm: Option<f64>,
    /// Each path of slip, a row of [`ReengagementAnswer::blows`].
    pub blows: Rows<&'a Blow>,
    /// What would be borne; null where all is, or where it is not known (`verdict`: stopped).
    pub borne: Option<BorneBody>,
    /// Energy that the windup takes up from the torque carried to the end of the curve, J.
    pub end_of_curve_j: Option<f64>,
    /// Friction while it slips.
    pub friction: f64,
    /// Whether the clutch grips again after each path of slip, and every limit bears the blow.
    pub held: bool,
    /// What turns with the inner race, this included, kg m^2.
    pub inertia_inner_kg_m2: f64,
    /// What turns with the outer race, this included, kg m^2; null: it is held.
    pub inertia_outer_kg_m2: Option<f64>,
    /// Speed of the outer race at which the sprags lift off in overrun, rev/min; null: they do not.
    pub lift_off_rpm: Option<f64>,
    /// Friction that is needed where the clutch does not slip.
    pub needs_friction: Option<f64>,
    /// Each blow over friction and inertia, a row of [`ReengagementAnswer::blows_over`].
    pub over: Rows<&'a BlowAt>,
    /// Whether the outer race keeps its speed whatever acts on it.
    pub outer_held: bool,
    /// Why the slip came to an end before the longest path.
    pub slip_ended: Option<&'static str>,
    /// The scenario whose speed was taken; null: it was given, or the design names none.
    pub speed_of: Option<&'a str>,
    /// Speed of both races before, rev/min.
    pub speed_rpm: f64,
    /// Where the slip itself throws the sprags out of reach.
    pub thrown: Option<ThrownBody>,
    /// Friction that the torque carried needs; null: none suffices.
    pub torque_needs_friction: Option<f64>,
    /// Torque that is carried when the slip begins, N m.
    pub torque_nm: f64,
    /// The answer in a sentence.
    pub verdict: String,
}

impl BorneBody {
    fn of(borne: &BorneSlip) -> Self {
        Self { path_mm: borne.path_m.map(|m| Unit::Millimetre.from_si(m)), friction: borne.friction }
    }
}

impl ThrownBody {
    fn of(end: SlipEnd) -> Self {
        Self {
            at_ms: Unit::Millisecond.from_si(end.at_s),
            path_mm: Unit::Millimetre.from_si(end.path_m),
            speed_rpm: Unit::Rpm.from_si(end.speed_rad_s),
            outer_rpm: Unit::Rpm.from_si(end.outer_rad_s),
        }
    }
}

impl<'a> ReengagementBody<'a> {
    pub(super) fn of(answer: &'a ReengagementAnswer<'_>) -> Self {
        let (case, found, bears) = (&answer.case, &answer.found, answer.bears.as_ref());
        let rpm = |rad_s| Unit::Rpm.from_si(rad_s);
        let [inertia_inner_kg_m2, inertia_outer_kg_m2] = case.inertia_kg_m2;
        Self {
            held: answer.is_held(),
            verdict: answer.verdict(),
            torque_nm: case.torque_nm,
            friction: case.friction,
            speed_rpm: rpm(case.speed_rad_s),
            inertia_inner_kg_m2,
            inertia_outer_kg_m2: (!case.outer_held).then_some(inertia_outer_kg_m2),
            outer_held: case.outer_held,
            bears_nm: bears.map(|b| b.0),
            bears_by: bears.map(|b| b.1.as_str()),
            blows: answer.blows(),
            over: answer.blows_over(),
            bears_j: answer.takes_up_j.map(|j| j[0]),
            end_of_curve_j: answer.takes_up_j.map(|j| j[1]),
            torque_needs_friction: Some(found.needs).filter(|mu| mu.is_finite()),
            borne: answer.borne.as_ref().map(BorneBody::of),
            speed_of: answer.speed_of,
            needs_friction: found.holds,
            slip_ended: found.ended.map(|end| end.stop.name()),
            lift_off_rpm: answer.lift_off_rad_s.map(rpm),
            thrown: answer.thrown().map(ThrownBody::of),
        }
    }
}

impl ReengagementAnswer<'_> {
    fn word(&self, b: &Blow) -> &'static str {
        match (self.bears_it(b), b.ended) {
            (true, _) => "held",
            (false, None) => "NOT HELD",
            (false, Some(Stop::FellAway)) => "THROWN OUT",
            (false, Some(Stop::CurveEnd)) => "OVERLOADED",
            (false, Some(_)) => "NO GRIP",
        }
    }

    /// Blows over friction and inertia.
    pub fn blows_over(&self) -> Rows<&BlowAt> {
        let peak = |b: &BlowAt| b.blow.as_ref().and_then(|blow| blow.peak);
        Rows::of(&self.over)
            .number("friction", "μ in slip", Unit::One, 4, |b| b.friction)
            .number("inertia_inner_kg_m2", "Inner inertia, kg m²", Unit::One, 4, |b| b.inner_inertia_kg_m2)
            .number("path_mm", "Slip", Unit::Millimetre, 3, |b| b.path_m)
            .number("peak_torque_nm", "Blow", Unit::NewtonMetre, 4, move |b| peak(b).map(|p| p.torque_nm))
            .number("times", "Times", Unit::One, 3, move |b| {
                peak(b).map(|p| p.torque_nm / self.case.torque_nm)
            })
            .number("hertz_inner_mpa", "p₀ inner", Unit::Megapascal, 4, move |b| {
                peak(b).map(|p| p.hertz_inner_pa)
            })
            .text("verdict", "Verdict", |b| match &b.blow {
                Some(blow) => Cell::Verdict(self.bears_it(blow), self.word(blow).to_owned()),
                None if b.holds => Cell::Verdict(true, "no slip".to_owned()),
                None => Cell::Verdict(false, "THROWN OUT".to_owned()),
            })
    }

    /// Each path of slip with its blow.
    pub fn blows(&self) -> Rows<&Blow> {
        let word = |b: &Blow| self.word(b);
        Rows::of(&self.found.list)
            .number("path_mm", "Slip", Unit::Millimetre, 3, |b| b.path_m)
            .number("peak_torque_nm", "Blow", Unit::NewtonMetre, 4, |b| b.peak.map(|p| p.torque_nm))
            .text("verdict", "Verdict", |b| Cell::Verdict(self.bears_it(b), word(b).to_owned()))
            .number("times", "Times", Unit::One, 3, |b| b.peak.map(|p| p.torque_nm / self.case.torque_nm))
            .number("peak_by_energy_nm", "By energy", Unit::NewtonMetre, 4, |b| b.by_energy_nm)
            .number("energy_j", "Energy", Unit::Joule, 3, |b| self.energy(b).map(|e| e.0))
            .number("of_borne", "Of borne", Unit::One, 3, |b| self.energy(b).and_then(|e| e.1))
            .number("hertz_inner_mpa", "p₀ inner", Unit::Megapascal, 4, |b| {
                b.peak.map(|p| p.hertz_inner_pa)
            })
            .number("speed_rpm", "Speed gained", Unit::Rpm, 3, |b| self.told(b))
            .number("slip_ms", "Lasts", Unit::Millisecond, 3, |b| b.slip_s)
            .number("peak_ms", "Blow at", Unit::Millisecond, 3, |b| b.peak_s.filter(|_| b.peak.is_some()))
            .number("path_in_all_mm", "In all", Unit::Millimetre, 3, |b| b.path_in_all_m)
            .json("held", |b| self.bears_it(b))
            .json("ended", |b| b.ended.map(Stop::name))
    }
}
