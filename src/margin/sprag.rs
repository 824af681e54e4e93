//! Friction that a sprag needs at its contacts.

use crate::design::{Design, Limits};
use crate::wedge::StaticPoint;

/// Friction that A and B need: sqrt(F_t^2 + F_a^2)/F_n. The axial load goes from race to sprag to race, so each
/// sprag hands F_a = load/n_s through both of its contacts. That of the torque alone counts on the way, with the axial load
/// at the peak (it grows without bound as the load goes to 0; `axial-from` says from where on it is carried).
pub(super) fn grip(design: &Design, limits: &Limits, p: &StaticPoint) -> [f64; 2] {
    let axial_n = limits.axial_load_n.unwrap_or(0.0) / design.clutch.sprags.count as f64;
    let need = |tangential: f64, normal_n: f64| match axial_n > 0.0 {
        true if normal_n > 0.0 => tangential.hypot(axial_n / normal_n),
        true => f64::INFINITY,
        false => tangential,
    };
    [need(p.tan_omega, p.normal_inner_n), need(p.tan_nu, p.normal_outer_n)]
}
