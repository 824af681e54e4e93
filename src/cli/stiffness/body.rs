//! The JSON of `stiffness`.

use super::fem::{Distance, FemRow, distance};
use super::pressure::{PressureJson, PressureMap};
use super::{LawCurve, Study};
use crate::cli::parts::{self, Junction};
use crate::design::LawName;
use crate::report::Unit;
use crate::wedge::{StaticPoint, straddling_error};
use serde::Serialize;

/// One row.
#[derive(Debug, Clone, Serialize)]
struct Point {
    torque_nm: f64,
    normal_inner_n: f64,
    normal_outer_n: f64,
    tan_omega: f64,
    tan_nu: f64,
    alpha_rad: f64,
    windup_deg: f64,
    k_secant_nm_per_rad: f64,
    k_tangent_nm_per_rad: f64,
    /// From 1.
    arc: usize,
    /// Whether the patch at A lies on two arcs.
    straddles_junction: bool,
    hertz_inner_mpa: f64,
    /// How far that is off at most: the curve's interpolation, and the pressure's shape while a junction lies under the
    /// contact.
    hertz_inner_error_mpa: f64,
    /// With the radius at the contact point alone, as the paper takes it.
    hertz_inner_pointwise_mpa: f64,
    hertz_outer_mpa: f64,
}

#[derive(Debug, Clone, Serialize)]
struct End {
    reason: &'static str,
    torque_nm: f64,
}

#[derive(Debug, Clone, Serialize)]
struct Curve {
    points: Vec<Point>,
    /// Torques asked for that the curve does not reach, N m.
    beyond_end: Vec<f64>,
    junctions: Vec<Junction>,
    end: End,
}

#[derive(Debug, Clone, Serialize)]
struct Law {
    contact: &'static str,
    /// K of the roller law, mm and N.
    #[serde(skip_serializing_if = "Option::is_none")]
    roller_coefficient: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    slices: Option<usize>,
    #[serde(flatten)]
    curve: Curve,
}

/// Keys of `stiffness`. With one law its keys stand at the top as well.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Body {
    laws: Vec<Law>,
    #[serde(flatten)]
    only: Option<Curve>,
    /// Finite elements and the distance of each law to them, in the order of `laws`.
    #[serde(skip_serializing_if = "Option::is_none")]
    fem: Option<Vec<FemJson>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pressure: Option<PressureJson>,
}

#[derive(Debug, Clone, Serialize)]
struct FemJson {
    torque_nm: f64,
    windup_deg: f64,
    normal_inner_n: Option<f64>,
    laws: Vec<Distance>,
}

impl Body {
    pub(super) fn new(study: &Study) -> Self {
        let laws: Vec<Law> = study.laws.iter().map(law).collect();
        let only = match laws.as_slice() {
            [one] => Some(one.curve.clone()),
            _ => None,
        };
        let fem = study.fem.as_ref().map(|fem| fem.rows.iter().map(|row| against(study, row)).collect());
        Self { laws, only, fem, pressure: study.pressure.as_ref().map(PressureMap::to_json) }
    }
}

fn against(study: &Study, row: &FemRow) -> FemJson {
    FemJson {
        torque_nm: row.torque_nm,
        windup_deg: Unit::Degree.from_si(row.windup_rad),
        normal_inner_n: row.normal_n,
        laws: study.laws.iter().map(|l| distance(l, row)).collect(),
    }
}

fn law(law: &LawCurve) -> Law {
    let roller_coefficient = law.clutch.contact.roller_coefficient();
    let slices = (law.name == LawName::Slice).then_some(law.clutch.axial.slices);
    let curve = Curve {
        points: law.rows.iter().filter_map(|(t, p)| p.as_ref().map(|p| point(*t, p, law))).collect(),
        beyond_end: law.rows.iter().filter(|(_, p)| p.is_none()).map(|(t, _)| *t).collect(),
        junctions: parts::junctions(&law.curve),
        end: End { reason: law.curve.end().0.name(), torque_nm: law.curve.end_torque_nm() },
    };
    Law { contact: law.name.facts().key, roller_coefficient, slices, curve }
}

/// A row under the torque asked for, which the equilibrium meets to rounding.
fn point(torque_nm: f64, p: &StaticPoint, law: &LawCurve) -> Point {
    let shape = if p.straddles_junction { straddling_error(&law.clutch) } else { 0.0 };
    let hertz_error_pa = (law.curve.truncation() + shape) * p.hertz_inner_pa;
    Point {
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
