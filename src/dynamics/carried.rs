//! Sprags that a driven cage carries through a scene, from overrun until the outer race catches up with them.
//!
//! A carried sprag turns with the inner race, phi' = theta_bi', alpha' = 0; B slides on the outer race, which lags behind,
//! T_be = -mu N_be. To the balance of [`super::cage`] come the forces of inertia of an accelerated cage, w = Omega' + theta_bi'':
//! -m_g OC_g w along the track at G and a couple -I_g w, so that
//!
//!   radially at P    R is less by m_g OC_g w sin pi,
//!   about P          what opens the sprag is more by w [m_g OC_g (OC_g - OP cos pi) + I_g].
//!
//! A cage that slows down presses its sprags on the outer race. They are inertia of the inner race, J = n_s (I_g + m_g OC_g^2):
//!
//!   (I_bi + J) theta_bi'' = C_bi - C_rl (theta_bi' - theta_be') - (I_bi + J) Omega' + n_s T_be OB,
//!
//! and as N_be is linear in w and w in N_be, both follow in closed form. The pocket has no play along the track: the cage also keeps a
//! sprag from running ahead. A sprag that tilts ([`super::cage`]) follows without inertia; its alpha counts at first contact.
//!
//! Once v_B = 0 the sprag is free, pressed as its spring does between races that stand still against one another: the outer race takes it
//! forward, away from the cage, and it wedges. Off the outer race it goes on with the cage, whichever race runs ahead, until the spring
//! brings it back. A sprag that comes down to first contact, or up to it, slower than the inner race, is taken along again: it and the
//! inner race then have the speed that keeps their momentum.

use super::cage::Held;
use super::model::{Forces, Mode, Model};
use super::start::{SlidingContact, spring_moment_nm};
use crate::clutch::{Cage, Clutch};
use crate::numeric::root;
use crate::wedge::{WedgeCurve, WedgePoint};

/// A sprag in its cage at first contact and on its stop, the cage standing still.
#[derive(Debug, Clone, Copy)]
pub struct Carried {
    touching: Held,
    on_stop: Held,
}

/// What a sprag does in the cage at one instant.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ride {
    /// N_be, N; 0: off the outer race.
    pub n_be: f64,
    /// N_bi, N.
    pub n_bi: f64,
    /// How far it is tilted open from first contact, rad.
    pub tilt_rad: f64,
    /// What opens it on its stop more than the spring closes it where B presses nothing, N m: above 0 it is off.
    pub off_nm: f64,
    /// By how much N_be changes with the cage's acceleration, N s^2: of a sprag that tilts nearly so.
    pub per_w: f64,
    /// Size of what N_be is left over from, N.
    pub size_n: f64,
}

/// N_be and N_bi of a sprag at one tilt, N, and what neither bears of the force outward at P, N; the others as of [`Ride`].
struct Balanced {
    n_be: f64,
    n_bi: f64,
    outward_n: f64,
    per_w: f64,
    /// The same where the force outward at P is to stay what it is.
    poised_per_w: f64,
    size_n: f64,
}

/// The cage's acceleration w without B, rad/s^2, and by how much a newton of N_be changes it.
type Spin = [f64; 2];

impl Carried {
    /// A sprag of `model` in `cage`; `touch` as of [`super::overrun_in_cage`].
    pub fn new(clutch: &Clutch, cage: &Cage, touch: &WedgeCurve) -> Self {
        let touching = Held::new(clutch, cage, touch, 0.0);
        Self { touching, on_stop: touching.on_stop(cage.clearance_m, 0.0) }
    }

    /// How it rides at `cage_rad_s`, B sliding with `mu`.
    pub(super) fn ride(&self, model: &Model, cage_rad_s: f64, mu: f64, spin: Spin) -> Ride {
        let [touching, on_stop] = [self.touching, self.on_stop].map(|held| Held { cage_rad_s, ..held });
        let most_rad = touching.alpha - on_stop.alpha;
        let stop = balanced(model, &on_stop, mu, spin, false);
        let opens_nm = on_stop.lifting_nm() + spin[0] * on_stop.slewing_kg_m2(model.inertia_kg_m2);
        let off_nm = opens_nm - spring_moment_nm(model, on_stop.alpha);
        let of = |b: Balanced, tilt_rad: f64| {
            let Balanced { n_be, n_bi, per_w, size_n, .. } = b;
            Ride { n_be, n_bi, tilt_rad, off_nm, per_w, size_n }
        };
        if stop.n_be <= 0.0 {
            return of(Balanced { n_be: 0.0, per_w: 0.0, ..stop }, most_rad);
        }
        let inside = balanced(model, &touching, mu, spin, true);
        if inside.n_bi >= 0.0 {
            return of(inside, 0.0);
        }
        if most_rad <= 0.0 || stop.outward_n >= 0.0 {
            return of(stop, most_rad);
        }
        let between = |tilt: f64| balanced(model, &touching.tilted(tilt, 0.0), mu, spin, false);
        let left = |tilt: f64| between(tilt).outward_n;
        let tilt = root::bracketed(0.0, most_rad, left(0.0), stop.outward_n, 1e-15 * most_rad, left);
        let tilt = tilt.unwrap_or(most_rad);
        let poised = between(tilt);
        of(Balanced { per_w: poised.poised_per_w, ..poised }, tilt)
    }
}

/// `held` in balance; `rests`: A bears what B does not bear of the force outward at P, otherwise the stop.
fn balanced(model: &Model, held: &Held, mu: f64, [w, w_per_n]: Spin, rests: bool) -> Balanced {
    let b = SlidingContact::dry(mu);
    let none = SlidingContact::dry(0.0);
    let of_b = held.opening_nm(1.0, &b, 0.0)[0];
    let of_a = if rests { held.opening_nm(0.0, &none, 1.0)[1] / held.a_ahead_of_p().cos() } else { 0.0 };
    // Outward at P: without B, for a newton of N_be, for a rad/s^2 of the cage.
    let outward = held.outward_n(0.0, &none);
    let outward_b = held.outward_n(1.0, &b) - outward;
    let outward_w = held.outward_of_slewing_kg_m();
    let slewing = held.slewing_kg_m2(model.inertia_kg_m2) - of_a * outward_w;
    let (spring, lifting) = (spring_moment_nm(model, held.alpha), held.lifting_nm());
    let closes = spring - lifting + of_a * outward - slewing * w;
    let lever = of_b - of_a * outward_b + slewing * w_per_n;
    let n_be = closes / lever;
    let size_n = (spring.abs() + lifting.abs() + (of_a * outward).abs() + (slewing * w).abs()) / lever.abs();
    let outward_n = outward + outward_b * n_be + outward_w * (w + w_per_n * n_be);
    let n_bi = if rests { -outward_n / held.a_ahead_of_p().cos() } else { 0.0 };
    let (per_w, poised_per_w) = (-slewing / lever, -outward_w / outward_b);
    Balanced { n_be, n_bi, outward_n, per_w, poised_per_w, size_n }
}

impl Model {
    /// Friction at B of a carried sprag that slides by `v_b`.
    pub(super) fn mu_outer(&self, v_b: f64) -> f64 {
        self.friction.coefficient(v_b.abs())
    }

    /// (How the sprags ride where the curve is `p`, theta_bi''), rad/s^2; `load_nm`: what acts on the inner race beside them; `off`: they are
    /// off the outer race.
    pub(super) fn ride(
        &self,
        carried: &Carried,
        t: f64,
        p: &WedgePoint,
        rates: &[f64; 4],
        load_nm: f64,
        off: bool,
    ) -> (Ride, f64) {
        let (speed, spin) = self.mean_speed(t);
        let sprags = self.count * self.orbit_kg_m2(p);
        let inertia = self.inner_inertia_kg_m2 + sprags;
        let v_b = self.slip_velocities(p, rates).1;
        let mu = self.mu_outer(v_b);
        let (free, per_n) = match self.held_rad_s2()[0] {
            Some(given) => (given, 0.0),
            None => ((load_nm - sprags * spin) / inertia, -mu * self.count * p.ob / inertia),
        };
        let ride = carried.ride(self, speed + rates[2], mu, [free + spin, per_n]);
        (ride, free + if off { 0.0 } else { per_n * ride.n_be })
    }

    /// Accelerations and forces of carried sprags; `load_nm`: what acts on the races beside them. T_bi is what inner race and cage
    /// together take a sprag along with, at OA.
    pub(super) fn carried_forces(
        &self,
        mode: &Mode,
        t: f64,
        p: &WedgePoint,
        rates: &[f64; 4],
        load_nm: [f64; 2],
    ) -> Forces {
        let Some(carried) = &self.carried else { return Forces::NONE };
        let (ride, inner) = self.ride(carried, t, p, rates, load_nm[0], mode.is_off());
        let forces = self.riding(mode, t, p, rates, &ride, [inner, 0.0]);
        let of_b = -self.count * p.ob * forces.t_be;
        let outer = self.held_rad_s2()[1].unwrap_or((load_nm[1] + of_b) / self.outer_inertia_kg_m2);
        Forces { acceleration: [0.0, inner, inner, outer], ..forces }
    }

    /// The forces of one that rides so while the races go at `races`, rad/s^2.
    pub(super) fn riding(
        &self,
        mode: &Mode,
        t: f64,
        p: &WedgePoint,
        rates: &[f64; 4],
        ride: &Ride,
        [inner, outer]: [f64; 2],
    ) -> Forces {
        let (v_a, v_b) = self.slip_velocities(p, rates);
        let n_be = if mode.is_off() { 0.0 } else { ride.n_be };
        let t_be = -self.mu_outer(v_b) * n_be;
        let spin = self.mean_speed(t).1;
        let t_bi = (t_be * p.ob - self.orbit_kg_m2(p) * (inner + spin)) / p.oa;
        Forces { acceleration: [0.0, inner, inner, outer], t_bi, t_be, n_bi: ride.n_bi, n_be, v_a, v_b }
    }

    /// Positive as long as carried sprags are off the outer race, or press on it, as `mode` says, N m.
    pub(super) fn stays_nm<const N: usize>(&self, mode: &Mode, t: f64, y: &[f64; N], p: &WedgePoint) -> f64 {
        let Some(carried) = &self.carried else { return 1.0 };
        let rates = self.rates(mode, p, y);
        let off_nm = self.ride(carried, t, p, &rates, self.race_loads_nm(t, y, &rates)[0], true).0.off_nm;
        if mode.is_off() { off_nm } else { -off_nm }
    }

    /// Torque of steadily carried sprags on the inner race, N m.
    pub(super) fn carried_drag_nm(&self, t: f64, p: &WedgePoint, rates: &[f64; 4]) -> f64 {
        let v_b = self.slip_velocities(p, rates).1;
        let (cage_rad_s, mu) = (self.mean_speed(t).0 + rates[2], self.mu_outer(v_b));
        let ride = self.carried.filter(|_| v_b < 0.0).map(|c| c.ride(self, cage_rad_s, mu, [0.0; 2]));
        -ride.map_or(0.0, |ride| mu * ride.n_be * p.ob * self.count)
    }

    /// The speed, rad/s, that sprags and inner race have once the cage has taken them along, from `rates` before; it keeps their momentum.
    pub(super) fn taken_along_rad_s(&self, p: &WedgePoint, [da, dp, di, _]: [f64; 4]) -> f64 {
        if self.held_rad_s2()[0].is_some() {
            return di;
        }
        let sprags = self.count * (self.orbit_kg_m2(p) * dp + self.inertia_kg_m2 * da);
        let inertia = self.inner_inertia_kg_m2 + self.count * self.orbit_kg_m2(p);
        (self.inner_inertia_kg_m2 * di + sprags) / inertia
    }
}
