//! Where runs start: spring preset, preload equilibrium, steady overrun.

use super::model::{Model, Place, State};
use crate::clutch::Clutch;
use crate::friction::FilmFriction;
use crate::kinematics::levers;
use crate::numeric::root;
use crate::wedge::{StaticPoint, WedgeCurve, WedgePoint};

/// Friction coefficient behind the measured drag torque C_f from which alpha_max follows (MODEL choice).
pub(super) const DRAG_FRICTION: f64 = 0.1;

/// alpha_max of the energizing spring, rad, from the drag torque of the whole clutch in slow overrun: per sprag
/// T = C_f/(n_s R_i), N = T/mu, K_r alpha_max = (h_i - h_e) N + b_i T + b_e T R_i/R_e at first contact at rest.
/// 0 without a spring. In a cage that the inner race drives B slides in its place ([`super::overrun_in_cage`]).
pub fn alpha_max_rad(clutch: &Clutch, at_rest: &WedgeCurve) -> f64 {
    let stiffness = clutch.spring.stiffness_nm_per_rad;
    if stiffness <= 0.0 {
        return 0.0;
    }
    if let Some(cage) = &clutch.cage {
        return super::cage::alpha_max_rad(clutch, cage, at_rest);
    }
    let c = at_rest.touch();
    let (oa, ob) = (c.lengths.oa.v, c.lengths.ob.v);
    let l = levers(oa, ob, c.oc_g.v, c.beta.v + c.gamma.v, c.gamma.v);
    let t = clutch.spring.drag_torque_nm / (clutch.sprags.count as f64 * clutch.races.inner_radius_m);
    let n = t / DRAG_FRICTION;
    ((l.h_i - l.h_e) * n + l.b_i * t + l.b_e * t * oa / ob) / stiffness
}

/// State at rest under the preload `torque_nm` on the inner race held by the abutment: alpha of the spring-free
/// curve, theta_be = -C/k_ab, theta_bi = theta_be - W, phi = 0. `None` where the curve does not carry it.
pub fn preloaded(model: &Model, torque_nm: f64) -> Option<(State, Place)> {
    let mut y = [0.0; super::N_STATE];
    if torque_nm <= 0.0 {
        y[0] = model.curve.first_contact_rad();
        return Some((y, Place::Open));
    }
    if model.mean_speed(0.0).0 != model.curve.speed_rad_s() {
        // The curve has another centrifugal force than the start.
        return settled(&Model { spring_nm_per_rad: 0.0, ..model.clone() }, torque_nm);
    }
    let (_, c) = model.curve.closure_at_torque(torque_nm)?;
    let alpha = c.alpha.v;
    let outer = if model.loads.abutment_nm_per_rad > 0.0 {
        -torque_nm / model.loads.abutment_nm_per_rad
    } else {
        0.0
    };
    y[0] = alpha;
    y[2] = outer - model.curve.windup_rad(alpha);
    y[3] = outer;
    Some((y, Place::Arc(model.curve.arc_at(alpha))))
}

/// State at rest under `torque_nm` >= 0 with the spring at work, at the mean speed of t = 0: both races in balance
/// (n_s T_bi OA = n_s T_be OB = C, theta_be = -C/k_ab), the sprag by
/// T(alpha) OA (rho_i + rho_e) = C (rho_i + rho_e)/n_s + K_r(alpha_max - alpha). Open at first contact where nothing
/// presses the sprag in. `None` where the curve does not carry it.
pub fn settled(model: &Model, torque_nm: f64) -> Option<(State, Place)> {
    let mut y = [0.0; super::N_STATE];
    let (speed, _) = model.mean_speed(0.0);
    let left = |k: usize, alpha: f64| {
        let p = model.curve.in_arc(k, alpha);
        let rho = p.rho_i + p.rho_e;
        model.static_tangential_n(&p, speed) * p.oa * rho
            - torque_nm / model.count * rho
            - spring_moment_nm(model, alpha)
    };
    let mut from = model.curve.first_contact_rad();
    if left(0, from) >= 0.0 {
        y[0] = from;
        return Some((y, Place::Open));
    }
    for k in 0..model.curve.arc_count() {
        let until = model.curve.arc_end_rad(k);
        let end = left(k, until);
        if end >= 0.0 {
            let alpha = root::bracketed(from, until, left(k, from).min(-0.0), end, 1e-16, |a| left(k, a))?;
            if model.loads.abutment_nm_per_rad > 0.0 {
                y[3] = -torque_nm / model.loads.abutment_nm_per_rad;
            }
            y[0] = alpha;
            y[2] = y[3] - model.curve.windup_rad(alpha);
            return Some((y, Place::Arc(k)));
        }
        from = until;
    }
    None
}

/// What the energizing spring presses one sprag in with at `alpha` (rad), N m.
pub(super) fn spring_moment_nm(model: &Model, alpha: f64) -> f64 {
    model.spring_nm_per_rad * (model.alpha_max_rad - alpha)
}

/// What the spring takes over of the torque of the clutch at the point `p` of the curve at `alpha` (rad), N m: the curve
/// without it carries C_0, the clutch C = C_0 - n_s K_r(alpha_max - alpha)/(rho_i + rho_e).
fn spring_torque_nm(model: &Model, p: &WedgePoint, alpha: f64) -> f64 {
    model.count * spring_moment_nm(model, alpha) / (p.rho_i + p.rho_e)
}

/// Torque that the clutch with its spring carries at the end of the curve, N m.
pub fn settled_end_torque_nm(model: &Model) -> f64 {
    let (_, end) = model.curve.end();
    let p = model.curve.in_arc(model.curve.arc_count() - 1, end);
    model.curve.end_torque_nm() - spring_torque_nm(model, &p, end)
}

/// The static state of [`settled`] at rest under `torque_nm` > 0, at its alpha, rad: N_bi as the curve has it there,
/// T_bi = C/(n_s OA), T_be = C/(n_s OB), N_be by the radial equation, so that the spring lowers |T|/N. Windup from first contact.
/// `None` beyond the curve.
pub fn settled_point(model: &Model, torque_nm: f64, alpha: f64) -> Option<StaticPoint> {
    let k = model.curve.arc_at(alpha);
    let p = model.curve.in_arc(k, alpha);
    let free = model.curve.at_normal(p.n_bi)?;
    let [t_bi, t_be] = [p.oa, p.ob].map(|radius| torque_nm / (model.count * radius));
    let (sin, cos) = p.beta_gamma.sin_cos();
    let n_be = (p.n_bi * cos + t_bi * sin - t_be * p.gamma.sin()) / p.gamma.cos();
    // dC/dW with dW = (rho_i + rho_e) d alpha.
    let rho = p.rho_i + p.rho_e;
    let of_spring = model.count * model.spring_nm_per_rad / rho
        + spring_torque_nm(model, &p, alpha) * (p.rho_i_slope + p.rho_e_slope) / rho;
    Some(StaticPoint {
        torque_nm,
        normal_outer_n: n_be,
        tan_omega: t_bi / p.n_bi,
        tan_nu: t_be / n_be,
        k_secant_nm_per_rad: torque_nm / free.windup_rad,
        k_tangent_nm_per_rad: free.k_tangent_nm_per_rad + of_spring / rho,
        hertz_outer_pa: model.curve.statics().elastic.outer_contact.peak_pressure_pa(n_be),
        ..free
    })
}

/// Steady overrun: the inner race runs ahead, past sprags that the outer race carries round, or with sprags that its cage carries.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overrun {
    /// alpha of the sprag, rad.
    pub alpha_rad: f64,
    /// Normal force at A, N.
    pub normal_inner_n: f64,
    /// Normal force at B, N.
    pub normal_outer_n: f64,
    /// That of the two at the contact that slides, A, or B in a cage that the inner race drives; 0: lifted off.
    pub sliding_n: f64,
    /// What a driven cage holds each sprag with at its pivot: inward, and forward along the track, N; 0 without one.
    pub cage_n: [f64; 2],
    /// Drag torque of the clutch on the inner race, N m, positive: it brakes the inner race.
    pub drag_torque_nm: f64,
    /// |T_bi|/N_bi: the friction coefficient in overrun, 0 where A is open, and in a cage that carries the sprags for it.
    pub tan_inner: f64,
    /// |T_be|/N_be that B must hold to carry the sprags along; in a cage the friction coefficient.
    pub tan_outer: f64,
    /// Relative error of the forces: what is left of the moments, and their rounding, by what a change of N_bi leaves over.
    pub relative_error: f64,
}

/// How the contact that slides in overrun does so under its load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlidingContact {
    /// T/N.
    pub friction: f64,
    /// How far ahead of the contact, where the race comes from, its pressure acts, m.
    pub ahead_m: f64,
    /// How far apart a film keeps the bodies, m; only a driven cage makes anything of it.
    pub gap_m: f64,
}

impl SlidingContact {
    /// On a film, sliding at `speed_abs_m_s` under `normal_n`.
    pub fn on(film: &FilmFriction, speed_abs_m_s: f64, normal_n: f64) -> Self {
        let [friction, ahead_m, gap_m] = film.felt(speed_abs_m_s, normal_n);
        Self { friction, ahead_m, gap_m }
    }

    /// Without a film.
    pub fn dry(friction: f64) -> Self {
        Self { friction, ahead_m: 0.0, gap_m: 0.0 }
    }
}

/// How far beside the equilibrium, as a part of N_bi, the moments are taken again for their slope.
const BESIDE: f64 = 1e-4;

/// Equilibrium of the sprags in steady overrun at the mean speed of `curve` with friction coefficient `mu` at A.
///
/// B sticks, phi' = theta_be' = Omega, T_bi = -mu N_bi, T_be = T_bi OA/OB, and moments about G with the spring:
/// h_i N_bi - h_e N_be - b_i T_bi - b_e T_be = K_r(alpha_max - alpha), N_be by the radial equation with F_c.
/// Lift-off (no N_bi > 0 in equilibrium) is an answer. Whether the sprags stay there, and how far beside it the equations of
/// motion settle, [`super::swing()`] says.
pub fn overrun(clutch: &Clutch, curve: &WedgeCurve, alpha_max: f64, mu: f64) -> Overrun {
    overrun_under(clutch, curve, alpha_max, |_| SlidingContact::dry(mu))
}

/// The same where how A slides depends on N_bi, N. With its pressure ahead of A by x_p, N_bi goes through O at the azimuth of A less x_p/OA, which leaves T_be OB = T_bi OA.
pub fn overrun_under(
    clutch: &Clutch,
    curve: &WedgeCurve,
    alpha_max: f64,
    sliding: impl Fn(f64) -> SlidingContact,
) -> Overrun {
    let k_r = clutch.spring.stiffness_nm_per_rad;
    let speed = curve.speed_rad_s();
    let touch = curve.touch();
    // Moment that is left over for more N_bi, N m: positive means the spring presses harder; the size of its parts.
    let balance = |n: f64| -> Option<(f64, f64, Overrun)> {
        let (alpha, oa, ob, oc_g, bg, g) = if n > 0.0 {
            let (_, c) = curve.closure_at_normal(n)?;
            (c.alpha.v, c.lengths.oa.v, c.lengths.ob.v, c.oc_g.v, c.beta.v + c.gamma.v, c.gamma.v)
        } else {
            let c = touch;
            (c.alpha.v, c.lengths.oa.v, c.lengths.ob.v, c.oc_g.v, c.beta.v + c.gamma.v, c.gamma.v)
        };
        let l = levers(oa, ob, oc_g, bg, g);
        let SlidingContact { friction: mu, ahead_m, .. } = sliding(n);
        let pressed = bg - ahead_m / oa;
        let h_i = levers(oa, ob, oc_g, pressed, g).h_i;
        let t_bi = -mu * n;
        let t_be = t_bi * oa / ob;
        let f_c = clutch.sprags.mass_kg * oc_g * speed * speed;
        let n_be = (n * pressed.cos() + t_bi * bg.sin() - t_be * g.sin() + f_c) / g.cos();
        let spring = k_r * (alpha_max - alpha);
        let parts = [h_i * n, -l.h_e * n_be, -l.b_i * t_bi, -l.b_e * t_be];
        let left = spring - parts.iter().sum::<f64>();
        let size = spring.abs() + parts.iter().map(|m| m.abs()).sum::<f64>();
        let drag_torque_nm = -t_bi * oa * clutch.sprags.count as f64;
        let tan_outer = if n_be > 0.0 { t_be.abs() / n_be } else { 0.0 };
        Some((
            left,
            size,
            Overrun {
                alpha_rad: alpha,
                normal_inner_n: n,
                normal_outer_n: n_be,
                sliding_n: n,
                cage_n: [0.0; 2],
                drag_torque_nm,
                tan_inner: mu,
                tan_outer,
                relative_error: 0.0,
            },
        ))
    };
    // Nothing but the centrifugal force presses on B.
    let f_c = clutch.sprags.mass_kg * touch.oc_g.v * speed * speed;
    let lifted = Overrun {
        alpha_rad: touch.alpha.v,
        normal_inner_n: 0.0,
        normal_outer_n: f_c / touch.gamma.v.cos(),
        sliding_n: 0.0,
        cage_n: [0.0; 2],
        drag_torque_nm: 0.0,
        tan_inner: 0.0,
        tan_outer: 0.0,
        relative_error: 0.0,
    };
    settle(balance, lifted)
}

/// The overrun in which `balance` leaves nothing: what is left over for more force at the sliding contact, N m, falls with that force;
/// the size of its parts. `lifted` where it does not take any.
pub(super) fn settle(balance: impl Fn(f64) -> Option<(f64, f64, Overrun)>, lifted: Overrun) -> Overrun {
    let Some((at_touch, ..)) = balance(0.0) else { return lifted };
    if at_touch <= 0.0 {
        return lifted;
    }
    let mut high = 1e-3;
    let mut low = 0.0;
    let mut left_low = at_touch;
    for _ in 0..200 {
        let Some((left, ..)) = balance(high) else { return lifted };
        if left <= 0.0 {
            let n = root::bracketed(low, high, left_low, left, 1e-15 * high, |n| {
                balance(n).map_or(f64::NAN, |b| b.0)
            });
            let settled = |n: f64| {
                let (left, size, overrun) = balance(n)?;
                let more = n * (1.0 + BESIDE);
                let slope = (balance(more)?.0 - left).abs() / (more - n);
                let relative_error = (left.abs() + f64::EPSILON * size) / (slope * n);
                let relative_error = if relative_error.is_finite() { relative_error } else { 1.0 };
                Some(Overrun { relative_error, ..overrun })
            };
            return n.and_then(settled).unwrap_or(lifted);
        }
        (low, left_low) = (high, left);
        high *= 2.0;
    }
    lifted
}
