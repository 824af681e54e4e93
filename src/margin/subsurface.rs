//! Shear below the contacts: against the case where it is largest, against the core at the depth of the case.

use super::load::LoadCase;
use crate::clutch::Clutch;
use crate::contact::largest_shear_below;
use crate::design::{Design, Limits};
use crate::wedge::StaticPoint;
use std::f64::consts::PI;

/// Largest shear from the depth `from_m` on, Pa, and its depth, m, below a contact with the pressure p_0, Pa, and the normal
/// force, N, of one sprag. The half width comes from force and pressure, N/l = pi a p_0/2, and so belongs to the pressure that
/// is reported (curvature averaged over the patch).
pub(super) fn shear_below(case: &LoadCase, pressed: (f64, f64), from_m: f64) -> (f64, f64) {
    shear_in(&case.design.clutch, pressed, from_m)
}

/// The same in a contact of `clutch`.
pub fn shear_in(clutch: &Clutch, (pressure_pa, normal_n): (f64, f64), from_m: f64) -> (f64, f64) {
    let half_width_m = match pressure_pa > 0.0 {
        true => 2.0 * normal_n / (PI * clutch.contact_length_m() * pressure_pa),
        false => 0.0,
    };
    largest_shear_below(pressure_pa, half_width_m, from_m)
}

/// p_0, Pa, and normal force, N, of one sprag at A.
pub(super) fn inner(p: &StaticPoint) -> (f64, f64) {
    (p.hertz_inner_pa, p.normal_inner_n)
}

/// The same at B.
pub(super) fn outer(p: &StaticPoint) -> (f64, f64) {
    (p.hertz_outer_pa, p.normal_outer_n)
}

/// Allowed shear beneath the case, Pa, where both are given.
pub(super) fn core_allowed(_: &Design, limits: &Limits) -> Option<f64> {
    limits.core_shear_pa.zip(limits.case_depth_m).map(|(allowed, _)| allowed)
}

/// Depth of the case, m.
pub(super) fn case_m(case: &LoadCase) -> f64 {
    case.limits.case_depth_m.unwrap_or(0.0)
}
