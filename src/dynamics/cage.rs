//! Steady overrun of sprags that a cage carries round with the inner race.
//!
//! The cage takes a sprag along at its point P, by a force H along the track, and keeps P from going outward, by a force
//! R >= 0 inward; inward it leaves it play, so that the sprag may rest on the inner race instead. B slides on the outer
//! race, which lags behind: T_be = -mu N_be. F_c is that of the cage's speed, on a couple M_s = K_r (alpha_max - alpha)
//! about P the spring and the cage press the sprag closed. With chi = azimuth of P ahead of C_e and pi = gamma + chi ahead
//! of G, the force of B at the azimuth x/OB ahead of C_e where a film presses so (chi_B = chi - x/OB), and no force along
//! the track at A, which the cage drives as fast as the race:
//!
//!   radially at P    R = F_c cos pi - N_be (cos chi_B + mu sin chi) + N_bi cos(beta - chi),
//!   about P          M_s + F_c OP sin pi = N_be [OP sin chi_B + mu (OB - OP cos chi)] + N_bi OP sin(beta - chi),
//!   along at P       H = F_c sin pi - N_be (sin chi_B - mu cos chi) - N_bi sin(beta - chi).
//!
//! Where it stands: a film at B keeps C_e by its gap h nearer to the axis, and the sprag is open by a tilt psi about C_e between that at
//! which it rests on the inner race and that at which P, farther out by the clearance c than at first contact, is on its stop:
//!
//!   psi_A <= psi <= psi_P,  psi_A = h cot beta/OC_e,  psi_P = (c + h cos chi)/(OC_e sin chi)  to first order,
//!   N_bi > 0 at psi_A alone, R > 0 at psi_P alone; in between both are 0.
//!
//! Without film and clearance both are 0. While the sprag rests on the inner race F_c turns it about A, open where G lies ahead of A; then it
//! tilts up to its stop and the cage bears it. Dry, N_be falls to 0 where m_g OC_g OP sin(-pi) Omega^2 = M_s at psi_P: lift-off, for P
//! behind G (pi < 0) only. A film goes on pressing, thicker and less, and the tilt that it takes strains the spring, until the sprag has no
//! more room: tilted so far that its first arc, taken to go on behind first contact, touches the inner race behind P, which is on its stop.
//! There it stays, R > 0 and N_bi > 0, over a film of that gap, which presses as its speed makes it: on oil nothing is ever off.
//! Bodies are rigid: a few newtons turn the sprag by little against alpha_max.

use super::start::{DRAG_FRICTION, Overrun, SlidingContact, settle};
use crate::clutch::{Cage, Clutch};
use crate::kinematics::centroid;
use crate::numeric::root;
use crate::wedge::WedgeCurve;

/// A point of a sprag: how far from the axis of the clutch, m, and by which azimuth ahead of C_e, rad.
#[derive(Debug, Clone, Copy)]
pub(super) struct Point {
    pub radius: f64,
    pub ahead: f64,
}

impl Point {
    /// Forward and outward from the axis, outward through C_e, m.
    pub fn cartesian(&self) -> [f64; 2] {
        let (sin, cos) = self.ahead.sin_cos();
        [self.radius * sin, self.radius * cos]
    }

    /// The point there.
    pub fn at([x, y]: [f64; 2]) -> Self {
        Self { radius: x.hypot(y), ahead: x.atan2(y) }
    }

    /// The same from C_e.
    fn beside_c_e(&self, oc_e: f64) -> [f64; 2] {
        let [x, y] = self.cartesian();
        [x, y - oc_e]
    }

    /// The point where the sprag is tilted open by `tilt` about C_e, whose radius then is `to` instead of `oc_e`.
    fn turned(&self, oc_e: f64, tilt: f64, to: f64) -> Self {
        let ([x, y], (sin, cos)) = (self.beside_c_e(oc_e), tilt.sin_cos());
        Self::at([x * cos - y * sin, x * sin + y * cos + to])
    }

    /// The tilts at which its radius is `radius`, while it still rises and where it comes down again; the one that brings it farthest out
    /// where none does.
    fn tilts_to(&self, radius: f64, oc_e: f64, to: f64) -> [f64; 2] {
        let [x, y] = self.beside_c_e(oc_e);
        let from_c_e = x.hypot(y);
        let cosine = (radius * radius - to * to - from_c_e * from_c_e) / (2.0 * to * from_c_e);
        let (top, beside) = (x.atan2(y), cosine.clamp(-1.0, 1.0).acos());
        [top - beside, top + beside]
    }
}

/// A sprag in a cage at a speed: at first contact, or tilted open from it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Held {
    pub oa: f64,
    pub ob: f64,
    pub oc_e: f64,
    pub p: Point,
    pub g: Point,
    pub c_1: Point,
    pub alpha: f64,
    pub mass_kg: f64,
    pub cage_rad_s: f64,
}

/// Forces on one sprag whose B presses with a given force.
struct Balance {
    normal_inner_n: f64,
    /// R inward and H forward, N; below 0 the first would have to pull.
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
    /// At first contact. `touch` is a curve whose first contact has the growth of the outer race.
    pub fn new(clutch: &Clutch, cage: &Cage, touch: &WedgeCurve, cage_rad_s: f64) -> Self {
        let c = touch.touch();
        let p = centroid(cage.pivot_m, c.lengths.oc_e, c.rotation);
        let oa = c.lengths.oa.v;
        let first_radius_m = clutch.sprags.inner_arcs.first().map_or(0.0, |arc| arc.radius_m);
        Self {
            oa,
            ob: c.lengths.ob.v,
            oc_e: c.lengths.oc_e.v,
            p: Point { radius: p.oc_g.v, ahead: -p.gamma.v },
            g: Point { radius: c.oc_g.v, ahead: -c.gamma.v },
            c_1: Point { radius: oa + first_radius_m, ahead: c.beta.v },
            alpha: c.alpha.v,
            mass_kg: clutch.sprags.mass_kg,
            cage_rad_s,
        }
    }

    /// Tilted open by `tilt` from first contact, a gap at B; none of either leaves it as it is.
    pub fn tilted(&self, tilt: f64, gap: f64) -> Self {
        if tilt == 0.0 && gap == 0.0 {
            return *self;
        }
        let to = self.oc_e - gap;
        let [p, g, c_1] = [self.p, self.g, self.c_1].map(|point| point.turned(self.oc_e, tilt, to));
        Self { oc_e: to, p, g, c_1, alpha: self.alpha - tilt, ..*self }
    }

    /// From first contact, over a gap at B: resting on the inner race.
    fn inside(&self, gap: f64) -> Self {
        let to = self.oc_e - gap;
        let tilt = if gap == 0.0 { 0.0 } else { self.c_1.tilts_to(self.c_1.radius, self.oc_e, to)[0] };
        self.tilted(tilt, gap)
    }

    /// The same tilted as far as it can: on the stop, or down again on the inner race before.
    fn open(&self, clearance: f64, gap: f64) -> Self {
        let on_stop = self.on_stop(clearance, gap);
        if gap == 0.0 || on_stop.c_1.ahead >= 0.0 || on_stop.c_1.radius >= self.c_1.radius {
            return on_stop;
        }
        let [_, down] = self.c_1.tilts_to(self.c_1.radius, self.oc_e, self.oc_e - gap);
        self.tilted(down, gap)
    }

    /// The same on the stop at P, `clearance` farther out than at first contact.
    pub fn on_stop(&self, clearance: f64, gap: f64) -> Self {
        let still = clearance == 0.0 && gap == 0.0;
        let to = self.oc_e - gap;
        let tilt = if still { 0.0 } else { self.p.tilts_to(self.p.radius + clearance, self.oc_e, to)[0] };
        self.tilted(tilt, gap)
    }

    /// The thickest films that leave the sprag room, m: on its stop, and at all, with C_1 straight above C_e, which is more where C_1 is past
    /// that place on the stop.
    fn thickest_m(&self, clearance: f64) -> [f64; 2] {
        let clear = |gap: f64| self.on_stop(clearance, gap).c_1.radius - self.c_1.radius;
        let [x, y] = self.c_1.beside_c_e(self.oc_e);
        let most = self.oc_e + x.hypot(y) - self.c_1.radius;
        let at_most = clear(most);
        if at_most >= 0.0 {
            return [most; 2];
        }
        let some = (1..50).map(|i| most * 0.5f64.powi(i)).find(|&gap| clear(gap) > 0.0);
        let on_stop =
            some.and_then(|some| root::bracketed(some, most, clear(some), at_most, 1e-12 * most, clear));
        let on_stop = on_stop.unwrap_or(0.0);
        [on_stop, if self.on_stop(clearance, on_stop).c_1.ahead < 0.0 { most } else { on_stop }]
    }

    /// pi, rad.
    fn pi(&self) -> f64 {
        self.p.ahead - self.g.ahead
    }

    /// Azimuth of A ahead of P, rad.
    pub fn a_ahead_of_p(&self) -> f64 {
        self.c_1.ahead - self.p.ahead
    }

    /// F_c, N.
    fn centrifugal_n(&self) -> f64 {
        self.mass_kg * self.g.radius * self.cage_rad_s * self.cage_rad_s
    }

    /// What the centrifugal force turns open about P, N m.
    pub fn lifting_nm(&self) -> f64 {
        -self.centrifugal_n() * self.p.radius * self.pi().sin()
    }

    /// What opens the sprag about P for each rad/s^2 by which the cage is accelerated, N m: the inertia force at G and the couple of
    /// `inertia_kg_m2`, I_g.
    pub fn slewing_kg_m2(&self, inertia_kg_m2: f64) -> f64 {
        let (oc_g, op) = (self.g.radius, self.p.radius);
        self.mass_kg * oc_g * (oc_g - op * self.pi().cos()) + inertia_kg_m2
    }

    /// The same outward at P, N.
    pub fn outward_of_slewing_kg_m(&self) -> f64 {
        -self.mass_kg * self.g.radius * self.pi().sin()
    }

    /// What the spring turns closed about P, N m.
    pub fn closing_nm(&self, clutch: &Clutch, alpha_max_rad: f64) -> f64 {
        clutch.spring.stiffness_nm_per_rad * (alpha_max_rad - self.alpha)
    }

    /// What neither B, pressed by `n` (N), nor the inner race bears of the force outward at P, N.
    pub fn outward_n(&self, n: f64, b: &SlidingContact) -> f64 {
        let (sin, _) = self.p.ahead.sin_cos();
        self.centrifugal_n() * self.pi().cos()
            - n * ((self.p.ahead - b.ahead_m / self.ob).cos() + b.friction * sin)
    }

    /// N_be = `n` (N), B sliding.
    fn at(&self, n: f64, b: &SlidingContact) -> Balance {
        let outward = self.outward_n(n, b);
        let normal_inner_n = (-outward).max(0.0) / self.a_ahead_of_p().cos();
        self.held_by(n, b, normal_inner_n, outward.max(0.0))
    }

    /// The same held by both at once, A behind P: the inner race bears what `closing_nm` leaves over of the moment about P, N m.
    fn stuck(&self, n: f64, b: &SlidingContact, closing_nm: f64) -> Balance {
        let (sin_a, cos_a) = self.a_ahead_of_p().sin_cos();
        let opening: f64 = self.opening_nm(n, b, 0.0).iter().sum();
        let normal_inner_n = (closing_nm - opening) / (self.p.radius * sin_a);
        self.held_by(n, b, normal_inner_n, self.outward_n(n, b) + normal_inner_n * cos_a)
    }

    /// The same, the inner race and the stop pressing with so much, N.
    fn held_by(&self, n: f64, b: &SlidingContact, normal_inner_n: f64, stop_n: f64) -> Balance {
        let sin_a = self.a_ahead_of_p().sin();
        let sin_b = (self.p.ahead - b.ahead_m / self.ob).sin();
        let at_b = n * (sin_b - b.friction * self.p.ahead.cos());
        let along = self.centrifugal_n() * self.pi().sin() - at_b - normal_inner_n * sin_a;
        Balance { normal_inner_n, cage_n: [stop_n, along], opening_nm: self.opening_nm(n, b, normal_inner_n) }
    }

    /// What turns the sprag open about P, N m: B pressed by `n`, A by `normal_inner_n` (N), the centrifugal force.
    pub fn opening_nm(&self, n: f64, b: &SlidingContact, normal_inner_n: f64) -> [f64; 3] {
        let (op, ob) = (self.p.radius, self.ob);
        let sin_b = (self.p.ahead - b.ahead_m / ob).sin();
        [
            n * (op * sin_b + b.friction * (ob - op * self.p.ahead.cos())),
            normal_inner_n * op * self.a_ahead_of_p().sin(),
            self.lifting_nm(),
        ]
    }
}

/// alpha_max of a spring with the drag torque that the file gives, rad: a slow overrun at the friction at which it was measured.
pub(super) fn alpha_max_rad(clutch: &Clutch, cage: &Cage, at_rest: &WedgeCurve) -> f64 {
    let t = clutch.spring.drag_torque_nm / (clutch.sprags.count as f64 * clutch.races.outer_radius_m);
    let held = Held::new(clutch, cage, at_rest, 0.0);
    let dry = SlidingContact::dry(DRAG_FRICTION);
    held.at(t / DRAG_FRICTION, &dry).opens_nm() / clutch.spring.stiffness_nm_per_rad
}

/// (Opening moment of the centrifugal force, closing moment of the spring) about P on one sprag on its stop at `cage_rad_s`, N m; B is
/// pressed on, without oil, while the first is smaller. `touch` as of [`overrun_in_cage`].
pub fn pivot_moments(
    clutch: &Clutch,
    cage: &Cage,
    touch: &WedgeCurve,
    alpha_max: f64,
    cage_rad_s: f64,
) -> (f64, f64) {
    let held = Held::new(clutch, cage, touch, cage_rad_s).on_stop(cage.clearance_m, 0.0);
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
    /// By which part the speed of lift-off is higher for each further metre c by which P may go outward before the cage stops it: the
    /// sprag tilts open about C_e by c/(OC_e sin chi), by which the spring gains and the lever of F_c changes. First order, of small
    /// c; 0 where the sprags do not lift off.
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
        let touching = Held::new(clutch, cage, at_rest, 0.0);
        let held = touching.on_stop(cage.clearance_m, 0.0);
        let b = touching.at(1.0, &SlidingContact::dry(DRAG_FRICTION));
        // A force forward at A, below P, turns the sprag open.
        let more = DRAG_FRICTION
            * b.normal_inner_n
            * (touching.p.radius * touching.a_ahead_of_p().cos() - touching.oa);
        let (op, oc_g, oc_e, pi) = (held.p.radius, held.g.radius, held.oc_e, held.pi());
        let closing = alpha_max_rad - held.alpha;
        let measured = alpha_max_rad - touching.alpha;
        let of_measured = if closing > 0.0 { measured / closing } else { 1.0 };
        // P x G = OP d sin kappa; tilting open by psi makes kappa less by psi, the moment of the spring K_r (alpha_max + psi). Of OP lever,
        // m^2, by a tilt about C_e:
        let [[_, p_out], [_, g_out]] = [held.p, held.g].map(|point| point.beside_c_e(oc_e));
        let turning = oc_e * (p_out - g_out);
        let (lever, outward) = (-oc_g * pi.sin(), oc_g * pi.cos() - op);
        Some(Self {
            pivot_radius_m: touching.p.radius,
            lift_off_higher_per_m: if closing > 0.0 && lever > 0.0 {
                0.5 * (1.0 / closing - turning / (op * lever)) / (oc_e * held.p.ahead.sin())
            } else {
                0.0
            },
            ahead_of_centroid_rad: touching.pi(),
            lift_off_higher: (1.0 + of_measured * more / b.opens_nm()).sqrt() - 1.0,
            opens_softly: -outward * closing < lever,
        })
    }
}

/// Where the sprags of a driven cage may stand between inner race and stop, the looser the less they press.
struct Standing<'a, F> {
    touching: Held,
    clearance_m: f64,
    /// The thickest film that it has room for, m, and the least that B presses with, N: 0 without a film.
    lowest_m: f64,
    lowest_n: f64,
    sliding: &'a F,
}

impl<F: Fn(f64) -> SlidingContact> Standing<'_, F> {
    /// The force under which a film at B is so thick, m, N; 0 without one.
    fn under_n(sliding: &F, gap_m: f64) -> f64 {
        // Without load a film has no end.
        let pressed = |n: f64| gap_m / sliding(n).gap_m - 1.0;
        let high = (sliding(0.0).gap_m > 0.0).then(|| (0..200).map(|i| 1e-3 * 2f64.powi(i)));
        let high = high.and_then(|mut forces| forces.find(|&n| pressed(n) >= 0.0));
        high.and_then(|high| root::bracketed(0.0, high, -1.0, pressed(high), 1e-15 * high, pressed))
            .unwrap_or(0.0)
    }

    /// B pressed with `n` (N), tilted by a `part` of the way from first contact with the inner race to where it is open.
    fn at(&self, n: f64, part: f64) -> (Held, SlidingContact) {
        let mut b = (self.sliding)(n);
        b.gap_m = b.gap_m.min(self.lowest_m);
        let (inside, open) = (self.touching.inside(b.gap_m), self.touching.open(self.clearance_m, b.gap_m));
        let held = match part {
            0.0 => inside,
            1.0 => open,
            _ => {
                let tilt = self.touching.alpha - (inside.alpha + part * (open.alpha - inside.alpha));
                self.touching.tilted(tilt, b.gap_m)
            }
        };
        (held, b)
    }

    /// The force at B, N, that neither the inner race nor the stop has to help to bear the centrifugal force, or the least there is.
    fn poised_n(&self, part: f64) -> f64 {
        let left = |n: f64| {
            let (held, b) = self.at(n, part);
            held.outward_n(n, &b)
        };
        let at_none = left(0.0);
        if at_none <= 0.0 {
            return self.lowest_n;
        }
        let high = (0..60).map(|i| at_none * 2f64.powi(i)).find(|&n| left(n) <= 0.0);
        high.and_then(|high| root::bracketed(0.0, high, at_none, left(high), 1e-15 * high, left))
            .unwrap_or(0.0)
            .max(self.lowest_n)
    }
}

/// Steady overrun of the sprags in `cage` at `cage_rad_s`; how B slides by `sliding` of N_be, N. `touch` is a curve of weightless sprags
/// at the speed of the outer race: its first contact has the growth of the track and no centrifugal force.
pub fn overrun_in_cage(
    clutch: &Clutch,
    cage: &Cage,
    touch: &WedgeCurve,
    alpha_max: f64,
    cage_rad_s: f64,
    sliding: impl Fn(f64) -> SlidingContact,
) -> Overrun {
    let touching = Held::new(clutch, cage, touch, cage_rad_s);
    let clearance_m = cage.clearance_m;
    let on_film = sliding(0.0).gap_m > 0.0;
    let [thickest_m, lowest_m] = touching.thickest_m(clearance_m);
    let [thickest_n, lowest_n] = [thickest_m, lowest_m].map(|gap_m| Standing::under_n(&sliding, gap_m));
    let standing = Standing { touching, clearance_m, lowest_m, lowest_n, sliding: &sliding };
    // The force at B along the way from where it is held by both: open, tilting at the force at which neither helps, inside.
    let plays = clearance_m > 0.0 || on_film;
    let [open_n, inside_n] = if plays { [1.0, 0.0].map(|part| standing.poised_n(part)) } else { [0.0; 2] };
    let along = |way: f64| match way {
        _ if way < open_n => (way + thickest_n * (1.0 - way / open_n), 1.0),
        _ if way < 2.0 * open_n => {
            let part = 2.0 - way / open_n;
            (standing.poised_n(part), part)
        }
        _ => (inside_n + way - 2.0 * open_n, 0.0),
    };
    let overrun = |held: &Held, n: f64, contact: &SlidingContact, b: &Balance| Overrun {
        alpha_rad: held.alpha,
        normal_inner_n: b.normal_inner_n,
        normal_outer_n: n,
        sliding_n: n,
        cage_n: b.cage_n,
        drag_torque_nm: contact.friction * n * held.ob * clutch.sprags.count as f64,
        tan_inner: 0.0,
        tan_outer: contact.friction,
        relative_error: 0.0,
    };
    let balance = |way: f64| {
        let (n, part) = along(way);
        let (held, contact) = standing.at(n, part);
        let b = held.at(n, &contact);
        let spring = held.closing_nm(clutch, alpha_max);
        let left = spring - b.opens_nm();
        let size = spring.abs() + b.opening_nm.iter().map(|m| m.abs()).sum::<f64>();
        Some((left, size, overrun(&held, n, &contact, &b)))
    };
    let most_open = if on_film {
        let (held, contact) = standing.at(thickest_n, 1.0);
        let b = held.stuck(thickest_n, &contact, held.closing_nm(clutch, alpha_max));
        Overrun { relative_error: f64::EPSILON, ..overrun(&held, thickest_n, &contact, &b) }
    } else {
        let off = touching.on_stop(clearance_m, 0.0);
        let dry = SlidingContact::dry(0.0);
        overrun(&off, 0.0, &dry, &off.at(0.0, &dry))
    };
    settle(balance, most_open)
}
