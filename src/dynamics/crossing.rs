//! Velocities across a junction or first contact, where OC_g' and the rolling ratios jump.
//!
//! A rolling contact whose ratio jumps must give alpha', phi' a jump too. The jump is the limit of a fast smooth
//! change: momenta of all coordinates but alpha are kept, and so is kinetic energy, hence
//! alpha'+ = alpha'- sqrt(m-/m+) with the effective mass m = M_aa - M_ar M_rr^-1 M_ra of the rolling system.
//! Without rolling contacts nothing jumps.

use nalgebra::{Matrix3, Vector3};

use super::model::{Grip, Mode, Model, Place};
use crate::wedge::WedgePoint;

/// Rates after the change from `before` to `after`; both points lie at the same alpha.
pub(super) fn cross(
    model: &Model,
    mode_after: &Mode,
    before: &WedgePoint,
    after: &WedgePoint,
    rates: [f64; 4],
) -> [f64; 4] {
    let inner = mode_after.inner == Grip::Stick && mode_after.place != Place::Open;
    let outer = mode_after.outer == Grip::Stick;
    if !inner && !outer {
        return rates;
    }
    let (m_before, _, _) = reduced(model, before, inner, outer);
    let (m_after, coupling_after, rest) = reduced(model, after, inner, outer);
    let Some(rest_inverse) = rest.try_inverse() else { return rates };
    let alpha_rate = scaled(rates[0], m_before, m_after);
    // Momenta of (phi, free races) are kept: M_rr w_r + M_ra alpha' = const.
    let (_, coupling_before, _) = reduced(model, before, inner, outer);
    let w = Vector3::new(rates[1], if inner { 0.0 } else { rates[2] }, if outer { 0.0 } else { rates[3] });
    let momentum = rest * w + coupling_before * rates[0];
    let w = rest_inverse * (momentum - coupling_after * alpha_rate);
    [
        alpha_rate,
        w[0],
        if inner { w[0] - after.rho_i * alpha_rate } else { w[1] },
        if outer { w[0] + after.rho_e * alpha_rate } else { w[2] },
    ]
}

/// The rate whose kinetic energy is kept where its effective mass changes.
pub(super) fn scaled(rate: f64, before: f64, after: f64) -> f64 {
    rate * (before / after).max(0.0).sqrt()
}

/// (effective mass of alpha, coupling of alpha to (phi, theta_bi, theta_be), mass of those), kg m^2; a race that
/// rolls is folded into alpha and phi, its own slot holds a unit mass that nothing moves.
fn reduced(model: &Model, p: &WedgePoint, inner: bool, outer: bool) -> (f64, Vector3<f64>, Matrix3<f64>) {
    let n = model.count;
    let i_g = n * model.inertia_kg_m2;
    let orbit = n * model.mass_kg * p.oc_g * p.oc_g;
    let (i_i, i_e) = (model.inner_inertia_kg_m2, model.outer_inertia_kg_m2);
    let (mut aa, mut ap, mut pp) = (i_g, i_g, i_g + orbit);
    let mut rest = Matrix3::from_diagonal(&Vector3::new(0.0, i_i, i_e));
    if inner {
        aa += i_i * p.rho_i * p.rho_i;
        ap -= i_i * p.rho_i;
        pp += i_i;
        rest[(1, 1)] = 1.0;
    }
    if outer {
        aa += i_e * p.rho_e * p.rho_e;
        ap += i_e * p.rho_e;
        pp += i_e;
        rest[(2, 2)] = 1.0;
    }
    rest[(0, 0)] = pp;
    (aa - ap * ap / pp, Vector3::new(ap, 0.0, 0.0), rest)
}
