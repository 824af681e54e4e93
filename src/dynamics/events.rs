//! Functions whose falling through zero ends a mode.

use super::model::{Forces, Grip, Mode, Model, Place};
use crate::wedge::WedgePoint;

/// Number of event functions.
pub(super) const EVENTS: usize = 4;
/// Index: alpha falls to the lower end of its place.
pub(super) const LOWER: usize = 0;
/// Index: alpha rises to the upper end of its place.
pub(super) const UPPER: usize = 1;
/// Index: contact A changes its grip; carried sprags come off the outer race or back to it.
pub(super) const INNER: usize = 2;
/// Index: contact B changes its grip.
pub(super) const OUTER: usize = 3;

/// Number of figures of a [`Probe`].
pub(super) const FIGURES: usize = 5;
/// Index of N_bi among them.
pub(super) const N_BI: usize = 3;
/// Index of N_be among them.
pub(super) const N_BE: usize = 4;

/// How far below first contact alpha must fall before contact counts as lost, rad: N is 0 from first contact on,
/// and a sprag that neither spring nor load moves does not flutter between the two places on rounding.
pub(super) const LEAVE_RAD: f64 = 1e-12;

/// How far an open sprag may turn back before the run ends with a name, rad.
pub(crate) const OPEN_REACH_RAD: f64 = 0.5;

/// What one evaluation of the forces tells.
#[derive(Debug, Clone, Copy)]
pub(super) struct Probe {
    /// Positive inside the mode.
    pub(super) events: [f64; EVENTS],
    /// What a run keeps the largest of: |T_bi|/N_bi, |T_be|/N_be (0 without contact; [`carried`] where B holds whatever that
    /// takes), -N_bi, N_bi, N_be.
    pub(super) figures: [f64; FIGURES],
    /// rho_i + rho_e.
    pub(super) rho: f64,
    /// Windup of the rolling clutch, rad.
    pub(super) windup: f64,
    /// OC_g' alpha'' while A carries load, else 0, m/s^2.
    pub(super) radial_m_s2: f64,
    /// theta_be', rad/s.
    pub(super) outer_rate_rad_s: f64,
}

impl Probe {
    /// Before anything is seen.
    pub(super) const NOTHING: Self = Self {
        events: [f64::NAN; EVENTS],
        figures: [f64::NAN; FIGURES],
        rho: f64::NAN,
        windup: f64::NAN,
        radial_m_s2: f64::NAN,
        outer_rate_rad_s: f64::NAN,
    };
}

/// How far alpha (rad) lies from the ends of its place.
#[inline]
fn within(model: &Model, place: Place, alpha: f64) -> (f64, f64) {
    let touch = model.curve.first_contact_rad();
    match place {
        Place::Open => (alpha - touch + OPEN_REACH_RAD, touch - alpha),
        Place::Tension => (1.0, touch - alpha),
        Place::Carried => (1.0, 1.0),
        Place::Arc(k) => {
            let from = if k == 0 { touch - LEAVE_RAD } else { model.curve.arc_end_rad(k - 1) };
            (alpha - from, model.curve.arc_end_rad(k) - alpha)
        }
    }
}

/// Figures of a [`Probe`]. `closed`: whether there is contact; `share`: how much of what B is asked for counts.
#[inline(always)]
pub(super) fn figures(closed: bool, f: &Forces, share: f64) -> [f64; FIGURES] {
    let ratio = |t: f64, n: f64| if closed && n > 0.0 { t.abs() / n } else { 0.0 };
    [ratio(f.t_bi, f.n_bi), share * ratio(f.t_be, f.n_be), -f.n_bi, f.n_bi, f.n_be]
}

/// How much of what a contact is asked for counts that carries `n` (N): 1 from `loaded` (N) on, smoothly less below, nothing without a force.
fn carried(n: f64, loaded: f64) -> f64 {
    let x = n / loaded;
    if x >= 1.0 || loaded == 0.0 { 1.0 } else { x.max(0.0).powi(2) * (3.0 - 2.0 * x) }
}

/// What is seen where the forces are `f`. `grips`: whether the friction limits count (the pure-rolling run ignores
/// them). Always inlined: written where it is kept, not copied there, which would wait for the writes.
#[inline(always)]
pub(super) fn probe_of<const N: usize>(
    model: &Model,
    mode: &Mode,
    t: f64,
    y: &[f64; N],
    p: &WedgePoint,
    f: &Forces,
    grips: bool,
) -> Probe {
    let (lower, upper) = within(model, mode.place, y[0]);
    let mu = model.friction.static_;
    let inner = match mode.inner {
        _ if mode.place == Place::Open || !grips => 1.0,
        _ if mode.place == Place::Carried => model.stays_nm(mode, t, y, p),
        Grip::Slip(s) => s * f.v_a,
        Grip::Stick => mu * f.n_bi - f.t_bi.abs(),
    };
    let outer = match mode.outer {
        _ if !grips => 1.0,
        Grip::Slip(s) => s * f.v_b,
        Grip::Stick if model.outer_holds => 1.0,
        Grip::Stick => mu * f.n_be - f.t_be.abs(),
    };
    // A contact that holds whatever that takes is asked for more without bound as it unloads.
    let share = if model.outer_holds { carried(f.n_bi.min(f.n_be), model.loaded_n) } else { 1.0 };
    Probe {
        events: [lower, upper, inner, outer],
        figures: figures(matches!(mode.place, Place::Arc(_)), f, share),
        rho: p.rho_i + p.rho_e,
        windup: p.windup,
        radial_m_s2: radial_m_s2(mode, p, f),
        outer_rate_rad_s: y[7],
    }
}

/// OC_g' alpha'' while A carries load, else 0, m/s^2.
#[inline(always)]
pub(super) fn radial_m_s2(mode: &Mode, p: &WedgePoint, f: &Forces) -> f64 {
    let carries = mode.place != Place::Open && f.n_bi > 0.0;
    if carries { p.oc_g_slope * f.acceleration[0] } else { 0.0 }
}

/// What is seen at (t, y) in `mode`.
pub(super) fn probe<const N: usize>(model: &Model, mode: &Mode, t: f64, y: &[f64; N], grips: bool) -> Probe {
    let p = model.point(mode.place, y[0]);
    let f = model.forces_at(mode, t, y, &p, &model.rates(mode, &p, y));
    probe_of(model, mode, t, y, &p, &f, grips)
}

/// Event function `i` of [`Probe::events`] alone: the ends of a place need no forces, a slip velocity no friction.
pub(super) fn event<const N: usize>(
    model: &Model,
    mode: &Mode,
    t: f64,
    y: &[f64; N],
    grips: bool,
    i: usize,
) -> f64 {
    let known = if grips || i == LOWER || i == UPPER { without_forces(model, mode, y, i) } else { None };
    known.unwrap_or_else(|| probe(model, mode, t, y, grips).events[i])
}

/// Event function `i` of [`Probe::events`] where that needs no forces.
pub(super) fn without_forces<const N: usize>(
    model: &Model,
    mode: &Mode,
    y: &[f64; N],
    i: usize,
) -> Option<f64> {
    let velocities = || {
        let p = model.point(mode.place, y[0]);
        model.slip_velocities(&p, &model.rates(mode, &p, y))
    };
    match (i, mode.inner, mode.outer) {
        (LOWER, ..) => Some(within(model, mode.place, y[0]).0),
        (UPPER, ..) => Some(within(model, mode.place, y[0]).1),
        (INNER, Grip::Slip(s), _) if !matches!(mode.place, Place::Open | Place::Carried) => {
            Some(s * velocities().0)
        }
        (OUTER, _, Grip::Slip(s)) => Some(s * velocities().1),
        _ => None,
    }
}
