//! The figures of a stiffness curve by their keys in JSON.

use super::LawCurve;
use super::junctions::{Junction, junctions};
use crate::answer::roll_over::RollOverBody;
use crate::clutch::LawName;
use crate::report::Unit;
use crate::wedge::{StaticPoint, straddling_error};
use serde::Serialize;

/// The state under one torque.
#[derive(Debug, Clone, Serialize)]
pub struct CurvePoint {
    /// Torque asked for, N m.
    pub torque_nm: f64,
    /// Normal force of one sprag at the inner contact, N.
    pub normal_inner_n: f64,
    /// The same at the outer contact, N.
    pub normal_outer_n: f64,
    /// Tangential over normal force at the inner contact.
    pub tan_omega: f64,
    /// The same at the outer contact.
    pub tan_nu: f64,
    /// Rotation of the sprag, rad.
    pub alpha_rad: f64,
    /// Windup of the races against each other, deg.
    pub windup_deg: f64,
    /// Secant stiffness, N m/rad.
    pub k_secant_nm_per_rad: f64,
    /// Tangent stiffness, N m/rad.
    pub k_tangent_nm_per_rad: f64,
    /// Inner arc in contact, from 1.
    pub arc: usize,
    /// Whether the inner contact lies on two arcs.
    pub straddles_junction: bool,
    /// Peak Hertz pressure at the inner contact, MPa.
    pub hertz_inner_mpa: f64,
    /// How far that is off at most: the curve's interpolation, and the pressure's shape while a junction lies under the
    /// contact.
    pub hertz_inner_error_mpa: f64,
    /// Peak Hertz pressure there with the radius at the contact point alone, as the paper takes it, MPa.
    pub hertz_inner_pointwise_mpa: f64,
    /// Peak Hertz pressure at the outer contact, MPa.
    pub hertz_outer_mpa: f64,
}

/// Where a curve ends.
#[derive(Debug, Clone, Serialize)]
pub struct CurveEnd {
    /// Why the curve ends there.
    pub reason: &'static str,
    /// Torque at the end, N m.
    pub torque_nm: f64,
    /// What comes after it; absent where no equilibrium is found there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beyond: Option<RollOverBody>,
}

/// One curve.
#[derive(Debug, Clone, Serialize)]
pub struct CurveBody {
    /// One for each torque asked for that the curve reaches.
    pub points: Vec<CurvePoint>,
    /// Torques asked for that the curve does not reach, N m.
    pub beyond_end: Vec<f64>,
    /// Where one arc hands over to the next.
    pub junctions: Vec<Junction>,
    /// Where the curve ends.
    pub end: CurveEnd,
}

/// One contact law.
#[derive(Debug, Clone, Serialize)]
pub struct Law {
    /// Its key.
    pub contact: &'static str,
    /// K of the roller law, mm and N.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub roller_coefficient: Option<f64>,
    /// Slices of the slice law.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slices: Option<usize>,
    /// Its curve.
    #[serde(flatten)]
    pub curve: CurveBody,
}

/// Keys of `stiffness`. With one law its keys stand at the top as well.
#[derive(Debug, Clone, Serialize)]
pub struct StiffnessBody {
    /// Each law that was asked for.
    pub laws: Vec<Law>,
    /// The one law asked for.
    #[serde(flatten)]
    pub only: Option<CurveBody>,
}

impl StiffnessBody {
    /// Of curves with their rows.
    pub fn of(laws: &[LawCurve]) -> Self {
        let laws: Vec<Law> = laws.iter().map(law).collect();
        let only = match laws.as_slice() {
            [one] => Some(one.curve.clone()),
            _ => None,
        };
        Self { laws, only }
    }
}

fn law(law: &LawCurve) -> Law {
    let roller_coefficient = law.clutch.contact.roller_coefficient();
    let slices = (law.name == LawName::Slice).then_some(law.clutch.axial.slices);
    let curve = CurveBody {
        points: law.rows.iter().filter_map(|(t, p)| p.as_ref().map(|p| point(*t, p, law))).collect(),
        beyond_end: law.rows.iter().filter(|(_, p)| p.is_none()).map(|(t, _)| *t).collect(),
        junctions: junctions(&law.curve),
        end: CurveEnd {
            reason: law.curve.end().0.name(),
            torque_nm: law.curve.end_torque_nm(),
            beyond: law.beyond.as_ref().map(RollOverBody::of),
        },
    };
    Law { contact: law.name.facts().key, roller_coefficient, slices, curve }
}

/// A row under the torque asked for, which the equilibrium meets to rounding.
fn point(torque_nm: f64, p: &StaticPoint, law: &LawCurve) -> CurvePoint {
    let shape = if p.straddles_junction { straddling_error(&law.clutch) } else { 0.0 };
    let hertz_error_pa = (law.curve.truncation() + shape) * p.hertz_inner_pa;
    CurvePoint {
        torque_nm,
        normal_inner_n: p.normal_inner_n,
        normal_outer_n: p.normal_outer_n,
        tan_omega: p.tan_omega,
        tan_nu: p.tan_nu,
        alpha_rad: p.alpha_rad,
        windup_deg: Unit::Degree.from_si(p.windup_rad),
        k_secant_nm_per_rad: p.k_secant_nm_per_rad,
        k_tangent_nm_per_rad: p.k_tangent_nm_per_rad,
        arc: p.arc + 1,
        straddles_junction: p.straddles_junction,
        hertz_inner_pointwise_mpa: Unit::Megapascal.from_si(p.hertz_inner_pointwise_pa),
        hertz_inner_mpa: Unit::Megapascal.from_si(p.hertz_inner_pa),
        hertz_inner_error_mpa: Unit::Megapascal.from_si(hertz_error_pa),
        hertz_outer_mpa: Unit::Megapascal.from_si(p.hertz_outer_pa),
    }
}
