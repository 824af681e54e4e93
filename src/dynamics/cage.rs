//! Steady overrun of sprags that a cage carries round with the inner race.
//!
//! The cage takes a sprag along at its point P, by a force H along the track, and keeps P from going outward, by a force
//! R >= 0 inward; inward it leaves it play, so that the sprag may rest on the inner race instead. B slides on the outer
//! race, which lags behind: T_be = -mu N_be. F_c is that of the cage's speed, on a couple M_s = K_r (alpha_max - alpha)
//! about P the spring and the cage press the sprag closed. With chi = azimuth of P ahead of C_e and pi = gamma + chi ahead
//! of G, the force of B at the azimuth x/OB ahead of C_e where a film presses so (chi_B = chi - x/OB), and no force along
//! the track at A, which the cage drives as fast as the race:
//!
//!   radially at P    R = F_c cos pi - N_be (cos chi_B + mu sin chi) + N_bi cos(beta - chi),  R N_bi = 0,
//!   about P          M_s + F_c OP sin pi = N_be [OP sin chi_B + mu (OB - OP cos chi)] + N_bi OP sin(beta - chi),
//!   along at P       H = F_c sin pi - N_be (sin chi_B - mu cos chi) - N_bi sin(beta - chi).
//!
//! While the sprag rests on the inner race F_c turns it about A, open where G lies ahead of A; from N_bi = 0 on the cage
//! bears it, and N_be falls to 0 where m_g OC_g OP sin(-pi) Omega^2 = M_s: lift-off, for P behind G (pi < 0) only. All
//! of it with P on its stop where the sprag touches both races, at the geometry of first contact: a few newtons turn the sprag by little against alpha_max.

use super::start::{DRAG_FRICTION, Overrun, settle};
use crate::clutch::{Cage, Clutch};
use crate::kinematics::centroid;
use crate::wedge::WedgeCurve;

/// A sprag at first contact in a cage at a speed.
struct Held {
    oa: f64,
    ob: f64,
    /// OP, m.
    op: f64,
    /// Azimuths of P ahead of C_e and ahead of G, of A ahead of P, rad.
    chi: f64,
    pi: f64,
    to_a: f64,
    alpha: f64,
    /// F_c, N.
    centrifugal_n: f64,
}

/// Forces on one sprag whose B presses with a given force.
struct Balance {
    normal_inner_n: f64,
    /// R inward and H forward, N.
    cage_n: [f64; 2],
    /// What turns the sprag open about P, N m, its parts.
    opening_nm: [f64; 3],
}

impl Balance {
    /// What turns the sprag open about P, N m.
    fn opens_nm(&self) -> f64 {
        self.opening_nm.iter().sum()
    }
}

impl Held {
    /// `touch` is a curve whose first contact has the growth of the outer race.
    fn new(clutch: &Clutch, cage: &Cage, touch: &WedgeCurve, cage_rad_s: f64) -> Self {
        let c = touch.touch();
        let p = centroid(cage.pivot_m, c.lengths.oc_e, c.rotation);
        let chi = -p.gamma.v;
        Self {
            oa: c.lengths.oa.v,
            ob: c.lengths.ob.v,
            op: p.oc_g.v,
            chi,
            pi: c.gamma.v + chi,
            to_a: c.beta.v - chi,
            alpha: c.alpha.v,
            centrifugal_n: clutch.sprags.mass_kg * c.oc_g.v * cage_rad_s * cage_rad_s,
        }
    }

    /// What the centrifugal force turns open about P, N m.
    fn lifting_nm(&self) -> f64 {
        -self.centrifugal_n * self.op * self.pi.sin()
    }

    /// What the spring turns closed about P, N m.
    fn closing_nm(&self, clutch: &Clutch, alpha_max_rad: f64) -> f64 {
        clutch.spring.stiffness_nm_per_rad * (alpha_max_rad - self.alpha)
    }

    /// N_be = `n` (N), B sliding with [mu, x].
    fn at(&self, n: f64, [mu, ahead]: [f64; 2]) -> Balance {
        let Self { ob, op, chi, pi, to_a, centrifugal_n: f_c, .. } = *self;
        let (sin_b, cos_b) = (chi - ahead / ob).sin_cos();
        let (sin, cos) = chi.sin_cos();
        let inward = f_c * pi.cos() - n * (cos_b + mu * sin);
        let normal_inner_n = (-inward).max(0.0) / to_a.cos();
        let along = f_c * pi.sin() - n * (sin_b - mu * cos) - normal_inner_n * to_a.sin();
        Balance {
            normal_inner_n,
            cage_n: [inward.max(0.0), along],
            opening_nm: [
                n * (op * sin_b + mu * (ob - op * cos)),
                normal_inner_n * op * to_a.sin(),
                self.lifting_nm(),
            ],
        }
    }
}

/// alpha_max of a spring with the drag torque that the file gives, rad: a slow overrun at the friction at which it was measured.
pub(super) fn alpha_max_rad(clutch: &Clutch, cage: &Cage, at_rest: &WedgeCurve) -> f64 {
    let t = clutch.spring.drag_torque_nm / (clutch.sprags.count as f64 * clutch.races.outer_radius_m);
    let held = Held::new(clutch, cage, at_rest, 0.0);
    held.at(t / DRAG_FRICTION, [DRAG_FRICTION, 0.0]).opens_nm() / clutch.spring.stiffness_nm_per_rad
}

/// (Opening moment of the centrifugal force, closing moment of the spring) about P on one sprag at `cage_rad_s`, N m; B is
/// pressed on while the first is smaller. `touch` as of [`overrun_in_cage`].
pub fn pivot_moments(
    clutch: &Clutch,
    cage: &Cage,
    touch: &WedgeCurve,
    alpha_max: f64,
    cage_rad_s: f64,
) -> (f64, f64) {
    let held = Held::new(clutch, cage, touch, cage_rad_s);
    (held.lifting_nm(), held.closing_nm(clutch, alpha_max))
}

/// What a driven cage makes of the sprags at first contact at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CageFacts {
    /// OP, m.
    pub pivot_radius_m: f64,
    /// pi, azimuth of P ahead of G, rad; below 0 the centrifugal force lifts the sprags off the outer race.
    pub ahead_of_centroid_rad: f64,
    /// By which part the speed of lift-off would be higher, had the inner race borne all the friction along the track that it can
    /// (mu of the drag) under the sprags while the drag was measured, in place of the cage.
    pub lift_off_higher: f64,
    /// By which part the speed of lift-off is higher for each metre c by which P may go outward before the cage stops it: the sprag
    /// tilts open about C_e by c/(OC_e sin chi), by which the spring gains and the lever of F_c changes. First order, of small c; 0 where
    /// the sprags do not lift off.
    pub lift_off_higher_per_m: f64,
    /// Whether the sprags open the wider the faster the race turns beyond lift-off, and come back at its speed. Otherwise the lever of
    /// the centrifugal force grows faster than the spring's moment while they tilt: they open at once as far as the cage lets them, and
    /// come back at a lower speed.
    pub opens_softly: bool,
}

impl CageFacts {
    /// Of `clutch`, whose curve at rest is `at_rest`; `None` without a driven cage.
    pub fn of(clutch: &Clutch, at_rest: &WedgeCurve, alpha_max_rad: f64) -> Option<Self> {
        let cage = clutch.cage.as_ref()?;
        let held = Held::new(clutch, cage, at_rest, 0.0);
        let b = held.at(1.0, [DRAG_FRICTION, 0.0]);
        // A force forward at A, below P, turns the sprag open.
        let more = DRAG_FRICTION * b.normal_inner_n * (held.op * held.to_a.cos() - held.oa);
        // P x G = OP d sin kappa; tilting open by psi makes kappa less by psi, the moment of the spring K_r (alpha_max + psi).
        let touch = at_rest.touch();
        let (oc_g, oc_e) = (touch.oc_g.v, touch.lengths.oc_e.v);
        let closing = alpha_max_rad - held.alpha;
        // Of OP lever, m^2, by a tilt about C_e.
        let turning = oc_e * (cage.pivot_m[1] - clutch.sprags.centroid_m[1]);
        let (lever, outward) = (-oc_g * held.pi.sin(), oc_g * held.pi.cos() - held.op);
        Some(Self {
            pivot_radius_m: held.op,
            lift_off_higher_per_m: if closing > 0.0 && lever > 0.0 {
                0.5 * (1.0 / closing - turning / (held.op * lever)) / (oc_e * held.chi.sin())
            } else {
                0.0
            },
            ahead_of_centroid_rad: held.pi,
            lift_off_higher: (1.0 + more / b.opens_nm()).sqrt() - 1.0,
            opens_softly: -outward * closing < lever,
        })
    }
}

/// Steady overrun of the sprags in `cage` at `cage_rad_s`, B's friction coefficient and the distance ahead at which its film presses,
/// m, by `sliding` of N_be, N. `touch` is a curve of weightless sprags at the speed of the outer race: its first contact has the
/// growth of the track and no centrifugal force.
pub fn overrun_in_cage(
    clutch: &Clutch,
    cage: &Cage,
    touch: &WedgeCurve,
    alpha_max: f64,
    cage_rad_s: f64,
    sliding: impl Fn(f64) -> [f64; 2],
) -> Overrun {
    let held = Held::new(clutch, cage, touch, cage_rad_s);
    let spring = held.closing_nm(clutch, alpha_max);
    let balance = |n: f64| {
        let [mu, ahead] = sliding(n);
        let b = held.at(n, [mu, ahead]);
        let left = spring - b.opens_nm();
        let size = spring.abs() + b.opening_nm.iter().map(|m| m.abs()).sum::<f64>();
        let overrun = Overrun {
            alpha_rad: held.alpha,
            normal_inner_n: b.normal_inner_n,
            normal_outer_n: n,
            sliding_n: n,
            cage_n: b.cage_n,
            drag_torque_nm: mu * n * held.ob * clutch.sprags.count as f64,
            tan_inner: 0.0,
            tan_outer: mu,
            relative_error: 0.0,
        };
        Some((left, size, overrun))
    };
    let lifted = Overrun {
        alpha_rad: held.alpha,
        normal_inner_n: 0.0,
        normal_outer_n: 0.0,
        sliding_n: 0.0,
        cage_n: held.at(0.0, [0.0; 2]).cage_n,
        drag_torque_nm: 0.0,
        tan_inner: 0.0,
        tan_outer: 0.0,
        relative_error: 0.0,
    };
    settle(balance, lifted)
}
