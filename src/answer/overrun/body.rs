//! The answer of `overrun` by its keys in JSON.

use super::{OverrunAnswer, OverrunLine};
use crate::answer::Said;
use crate::life::SlipEffect;
use crate::report::{Rows, Unit};
use serde::Serialize;

/// The slip that the file asks for.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct SlipBody {
    /// Rise of the temperature in the contact, K.
    pub flash_k: f64,
    /// Friction coefficient.
    pub friction: f64,
    /// Normal force of one sprag, N.
    pub normal_n: f64,
    /// Path of the slip, mm.
    pub path_mm: f64,
    /// Peclet number.
    pub peclet: f64,
    /// Depth worn off the race, um.
    pub race_wear_um: f64,
    /// Speed of the slip, m/s.
    pub speed_m_s: f64,
    /// Depth worn off the sprag, um.
    pub sprag_wear_um: f64,
    /// Torque that is carried, N m.
    pub torque_nm: f64,
    /// Heat of the inner contacts of all sprags, J.
    pub work_j: f64,
}

/// Keys of `overrun`.
#[derive(Debug, Clone, Serialize)]
pub struct OverrunBody<'a> {
    /// Roughness of both surfaces together, Rq, um.
    pub composite_roughness_um: f64,
    /// Speed of the outer race, in a driven cage of the inner one, at which the sprags lift off, rev/min; null: they do not.
    pub lift_off_rpm: Option<f64>,
    /// Each speed at each temperature.
    pub lines: Rows<&'a OverrunLine>,
    /// Name of the oil.
    pub oil: &'a str,
    /// Which speeds were taken.
    pub picked: String,
    /// The race that runs, `inner` or `outer`.
    pub race: &'static str,
    /// The slip that the file asks for.
    pub slip: Option<SlipBody>,
    /// The answer in a sentence.
    pub verdict: String,
    /// What one should not overlook.
    pub warnings: Vec<String>,
}

impl SlipBody {
    fn of(s: &SlipEffect) -> Self {
        Self {
            torque_nm: s.case.torque_nm,
            speed_m_s: s.case.speed_m_s,
            path_mm: Unit::Millimetre.from_si(s.case.path_m),
            normal_n: s.normal_n,
            friction: s.friction,
            flash_k: s.flash_k,
            peclet: s.peclet,
            sprag_wear_um: Unit::Micrometre.from_si(s.sprag_m),
            race_wear_um: Unit::Micrometre.from_si(s.race_m),
            work_j: s.work_j,
        }
    }
}

impl<'a> OverrunBody<'a> {
    pub(super) fn of(answer: &'a OverrunAnswer<'_>) -> Self {
        Self {
            verdict: answer.verdict(),
            picked: answer.picked(),
            oil: answer.lubrication.oil.name,
            race: answer.question.race.name(),
            composite_roughness_um: Unit::Micrometre.from_si(answer.lubrication.roughness_m()),
            lift_off_rpm: answer.lift_off_rad_s.map(|w| Unit::Rpm.from_si(w)),
            lines: answer.all(),
            slip: answer.slip.as_ref().map(SlipBody::of),
            warnings: answer.warnings(),
        }
    }
}
