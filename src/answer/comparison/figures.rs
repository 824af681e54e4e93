//! The figures that stand side by side beside the margins.

use crate::answer::check::Capacity;
use crate::compare::Subject;
use crate::margin::overrun_at;
use crate::report::Unit;
use crate::wedge::StaticPoint;

/// One figure of a design.
pub(super) struct Figure {
    /// Key for programs, its unit at the end.
    pub(super) key: &'static str,
    /// Name for people.
    pub(super) name: &'static str,
    pub(super) unit: Unit,
    /// SI value.
    value: fn(&Subject) -> Option<f64>,
}

impl Figure {
    /// SI value.
    pub(super) fn si(&self, subject: &Subject) -> Option<f64> {
        (self.value)(subject)
    }

    /// In the unit of the key.
    pub(super) fn shown(&self, subject: &Subject) -> Option<f64> {
        self.si(subject).map(|si| self.unit.from_si(si))
    }
}

const fn figure(
    key: &'static str,
    name: &'static str,
    unit: Unit,
    value: fn(&Subject) -> Option<f64>,
) -> Figure {
    Figure { key, name, unit, value }
}

/// Lowest torque at which a required limit of one torque would be reached before the curve ends.
fn capacity(subject: &Subject, nominal: bool) -> Option<f64> {
    let both = Capacity::nominal_and_peak(&subject.margins, subject.state.curve.end_torque_nm());
    let [of_nominal, of_peak] = both.map(|c| c.map(|c| c.torque_capacity_nm));
    if nominal { of_nominal } else { of_peak }
}

fn at_nominal(subject: &Subject, value: fn(&StaticPoint) -> f64) -> Option<f64> {
    subject.nominal().map(|p| value(&p))
}

fn at_peak(subject: &Subject, value: fn(&StaticPoint) -> f64) -> Option<f64> {
    subject.peak().map(|p| value(&p))
}

/// All of them.
pub(super) const FIGURES: [Figure; 21] = [
    figure("torque_capacity_nominal_nm", "torque capacity, nominal", Unit::NewtonMetre, |s| {
        capacity(s, true)
    }),
    figure("torque_capacity_peak_nm", "torque capacity, peak", Unit::NewtonMetre, |s| capacity(s, false)),
    figure("curve_end_nm", "end of the curve", Unit::NewtonMetre, |s| Some(s.state.curve.end_torque_nm())),
    figure("windup_nominal_deg", "windup, nominal", Unit::Degree, |s| at_nominal(s, |p| p.windup_rad)),
    figure("windup_peak_deg", "windup, peak", Unit::Degree, |s| at_peak(s, |p| p.windup_rad)),
    figure("k_tangent_nominal_nm_per_rad", "tangent stiffness, nominal", Unit::NewtonMetrePerRadian, |s| {
        at_nominal(s, |p| p.k_tangent_nm_per_rad)
    }),
    figure("k_tangent_peak_nm_per_rad", "tangent stiffness, peak", Unit::NewtonMetrePerRadian, |s| {
        at_peak(s, |p| p.k_tangent_nm_per_rad)
    }),
    figure("k_secant_nominal_nm_per_rad", "secant stiffness, nominal", Unit::NewtonMetrePerRadian, |s| {
        at_nominal(s, |p| p.k_secant_nm_per_rad)
    }),
    figure("k_secant_peak_nm_per_rad", "secant stiffness, peak", Unit::NewtonMetrePerRadian, |s| {
        at_peak(s, |p| p.k_secant_nm_per_rad)
    }),
    figure("tan_omega_first_contact", "tan ω, first contact", Unit::One, |s| Some(s.state.first_tan_omega)),
    figure("tan_omega_nominal", "tan ω, nominal", Unit::One, |s| at_nominal(s, |p| p.tan_omega)),
    figure("tan_omega_peak", "tan ω, peak", Unit::One, |s| at_peak(s, |p| p.tan_omega)),
    figure("hertz_inner_nominal_mpa", "Hertz pressure A, nominal", Unit::Megapascal, |s| {
        at_nominal(s, |p| p.hertz_inner_pa)
    }),
    figure("hertz_inner_peak_mpa", "Hertz pressure A, peak", Unit::Megapascal, |s| {
        at_peak(s, |p| p.hertz_inner_pa)
    }),
    figure("hertz_outer_nominal_mpa", "Hertz pressure B, nominal", Unit::Megapascal, |s| {
        at_nominal(s, |p| p.hertz_outer_pa)
    }),
    figure("hertz_outer_peak_mpa", "Hertz pressure B, peak", Unit::Megapascal, |s| {
        at_peak(s, |p| p.hertz_outer_pa)
    }),
    figure("lift_off_rpm", "outer race at lift-off", Unit::Rpm, |s| s.lift_off_rad_s),
    figure("mass_g", "mass, sprags and races", Unit::Gram, |s| Some(s.design.clutch.mass_kg())),
    figure("outside_diameter_mm", "outside diameter", Unit::Millimetre, |s| {
        Some(2.0 * s.design.clutch.races.outer_outside_radius_m)
    }),
    figure("race_width_mm", "width of the races", Unit::Millimetre, |s| Some(s.design.clutch.races.width_m)),
    figure("drag_torque_slow_nm", "drag torque, slow overrun", Unit::NewtonMetre, |s| {
        overrun_at(&s.design, &s.state, 0.0, 0.0).ok().map(|p| p.state.drag_torque_nm)
    }),
];
