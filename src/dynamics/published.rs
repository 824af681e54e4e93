//! The paper's own scheme, kept as a reference: fixed-step RK4 with a narrow band of zero velocity.
//!
//! It does not converge at the paper's step: inside the band the contact creeps, and once the restoring force is
//! lost it runs away. Never the default.

use super::model::{Grip, Mode, Model, N_STATE, Place, State};
use crate::ode::rk4;

/// Result of the published scheme.
#[derive(Debug, Clone, Copy)]
pub struct PublishedRun {
    /// State at the end.
    pub state: State,
    /// Steps taken.
    pub steps: u64,
    /// Right-hand sides.
    pub rhs_evaluations: u64,
    /// Whether it stayed finite and on the curve to the end.
    pub finished: bool,
    /// Time with |v_A| above the band, s.
    pub slip_inner_s: f64,
    /// Smallest N_bi at step ends, N.
    pub normal_min_n: f64,
    /// Largest N_bi at step ends, N.
    pub normal_max_n: f64,
    /// Largest |T_bi|/N_bi at step ends.
    pub tan_inner: f64,
}

/// Modes by which (11) is evaluated: rolling force inside the band, limited to mu_s N; slip outside.
///
/// The three lines of (11), with (12) in the last.
fn published_slope(model: &Model, t: f64, y: &State, band_m_s: f64) -> Option<(State, f64, f64)> {
    let curve = &model.curve;
    let alpha = y[0];
    let place =
        if alpha <= curve.first_contact_rad() { Place::Open } else { Place::Arc(curve.arc_at(alpha)) };
    let p = model.point(place, alpha);
    // Rates as they are: the band lets the contacts creep.
    let rates = [y[4], y[5], y[6], y[7]];
    let (v_a, v_b) = model.slip_velocities(&p, &rates);
    let grip = |v: f64| if v.abs() < band_m_s { Grip::Stick } else { Grip::Slip(v.signum()) };
    let mut mode = Mode { place, inner: grip(v_a), outer: grip(v_b) };
    let mut f = model.forces_at(&mode, t, y, &p, &rates);
    let mu = model.friction.static_;
    // Stick-slip transition: T = mu_s N sgn(T_f). Slip(s) gives T_bi = -s mu_s N at A, T_be = s mu_s N at B
    // because s v is taken as 0 there.
    let mut limited = false;
    if mode.inner == Grip::Stick && place != Place::Open && f.t_bi.abs() > mu * f.n_bi {
        mode.inner = Grip::Slip(-f.t_bi.signum());
        limited = true;
    }
    if mode.outer == Grip::Stick && f.t_be.abs() > mu * f.n_be {
        mode.outer = Grip::Slip(f.t_be.signum());
        limited = true;
    }
    if limited {
        f = model.forces_at(&mode, t, y, &p, &rates);
    }
    let a = f.acceleration;
    let out = [y[4], y[5], y[6], y[7], a[0], a[1], a[2], a[3], v_a, v_b];
    let tan = if f.n_bi > 0.0 { f.t_bi.abs() / f.n_bi } else { 0.0 };
    out.iter().all(|x| x.is_finite()).then_some((out, f.n_bi, tan))
}

/// Eq. (11) in the printed form: T = T_f while |v| < D_V and |T_f| < mu_s N, mu_s N sgn(T_f) while |v| < D_V
/// beyond that, mu(v) N outside the band. Not as printed: sgn(Vel) stands at both contacts there, but
/// T_bi = -sgn(v_A) mu N_bi, T_be = +sgn(v_B) mu N_be, or one of them would feed energy.
///
/// Integrates from `state` over `duration_s` with fixed step `step_s` and band `band_m_s` (the paper: 1e-5 s).
#[doc(alias = "Eq. (11)")]
pub fn published(model: &Model, state: State, duration_s: f64, step_s: f64, band_m_s: f64) -> PublishedRun {
    let steps = (duration_s / step_s).round().max(1.0) as u64;
    let h = duration_s / steps as f64;
    let mut out = PublishedRun {
        state,
        steps: 0,
        rhs_evaluations: 0,
        finished: false,
        slip_inner_s: 0.0,
        normal_min_n: f64::INFINITY,
        normal_max_n: 0.0,
        tan_inner: 0.0,
    };
    let (_, end_alpha) = model.curve.end();
    for i in 0..steps {
        let t = i as f64 * h;
        let mut rhs =
            |t: f64, y: &[f64; N_STATE]| published_slope(model, t, y, band_m_s).map(|s| s.0).ok_or(());
        let Ok(next) = rk4::step(&mut rhs, t, &out.state, h) else { return out };
        out.state = next;
        out.steps += 1;
        out.rhs_evaluations += 4;
        if !(next[0] < end_alpha && next[0] > -10.0) {
            return out;
        }
        if let Some((slope, n_bi, tan)) = published_slope(model, t + h, &next, band_m_s) {
            if slope[8].abs() > band_m_s && n_bi > 0.0 {
                out.slip_inner_s += h;
            }
            out.normal_min_n = out.normal_min_n.min(n_bi);
            out.normal_max_n = out.normal_max_n.max(n_bi);
            out.tan_inner = out.tan_inner.max(tan);
        }
    }
    out.finished = true;
    out
}
