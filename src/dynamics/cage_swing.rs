//! Whether a steady overrun in a driven cage stays: the sprag's small motions about it.
//!
//! In the frame of the cage P keeps its azimuth; the sprag moves with it by r along its radius and turns open about it by theta, not by r
//! while P is on its stop. With u_r, u_theta what G moves by either, s = u_theta x u_r and the forces of `cage`
//!
//!   m u_r (u_r r'' + u_theta theta'')                      = Q_r + 2 m Omega s theta',
//!   m u_theta (u_r r'' + u_theta theta'') + I_g theta''    = Q_theta - 2 m Omega s r',
//!
//! B's film yields like a spring and is squeezed, N = N_0 - k (dh - h_v dv) - c dh' ([`FilmFriction::compliance`]), and friction follows load
//! and speed at once; dry bodies press by their own compliance, and so does A where it bears. Linear about the equilibrium, by central
//! differences of the forces at places of the sprag as they are.

use super::cage::{Held, Point};
use super::start::{Overrun, SlidingContact};
use super::swing::Swing;
use crate::clutch::Clutch;
use crate::friction::{FilmFriction, Stribeck};
use crate::numeric::eigen::eigenvalues;
use crate::wedge::WedgeCurve;
use nalgebra::{DMatrix, Matrix2};

/// By which part of itself the force at B, or the sliding speed, changes in the differences: a choice.
const BESIDE: f64 = 1e-4;

/// r, theta, r', theta'.
type Motion = [f64; 4];

/// The equilibrium, and how its contacts yield.
struct About<'a> {
    clutch: &'a Clutch,
    alpha_max: f64,
    held: Held,
    steady: &'a Overrun,
    /// Sliding speed of B, m/s.
    speed_m_s: f64,
    film: Option<&'a FilmFriction>,
    dry: Stribeck,
    /// k, h_v, c of B.
    outer: [f64; 3],
    /// N/m of A.
    inner_n_per_m: f64,
}

impl About<'_> {
    /// Friction coefficient of B and where it presses.
    fn sliding(&self, speed_m_s: f64, n: f64) -> SlidingContact {
        let speed = speed_m_s.abs();
        match self.film {
            Some(law) => SlidingContact::on(law, speed, n),
            None => SlidingContact::dry(self.dry.coefficient(speed)),
        }
    }

    /// The sprag moved by r and theta.
    fn moved(&self, [r, theta, ..]: Motion) -> Held {
        let Held { p, oc_e, .. } = self.held;
        let (from, to) = (p.cartesian(), Point { radius: p.radius + r, ..p }.cartesian());
        let (sin, cos) = theta.sin_cos();
        let moved = |point: Point| {
            let [x, y] = point.cartesian();
            let [x, y] = [x - from[0], y - from[1]];
            Point::at([to[0] + x * cos - y * sin, to[1] + x * sin + y * cos])
        };
        let c_e = moved(Point { radius: oc_e, ahead: 0.0 });
        let seen = |point: Point| Point { ahead: point.ahead - c_e.ahead, ..point };
        Held {
            oc_e: c_e.radius,
            p: seen(Point { radius: p.radius + r, ..p }),
            g: seen(moved(self.held.g)),
            c_1: seen(moved(self.held.c_1)),
            // Open against the line OC_e, which has turned itself.
            alpha: self.held.alpha - theta - c_e.ahead,
            ..self.held
        }
    }

    /// Q_r, N, and Q_theta, N m, less what the stop bears.
    fn forces(&self, motion: Motion) -> [f64; 2] {
        let [_, _, r_rate, theta_rate] = motion;
        let (held, at) = (self.moved(motion), &self.held);
        let (sin, cos) = at.p.ahead.sin_cos();
        let thicker = at.oc_e - held.oc_e;
        let thickens = at.p.radius * sin * theta_rate - cos * r_rate;
        let faster = sin * r_rate - (at.ob - at.p.radius * cos) * theta_rate;
        let [k, by_speed, c] = self.outer;
        let n = self.steady.normal_outer_n - k * (thicker - by_speed * faster) - c * thickens;
        let b = self.sliding(self.speed_m_s + faster, n);
        let opens = held.c_1.radius - at.c_1.radius;
        let normal_inner_n = self.steady.normal_inner_n - self.inner_n_per_m * opens;
        let outward = held.outward_n(n, &b) + normal_inner_n * held.a_ahead_of_p().cos();
        let opening: f64 = held.opening_nm(n, &b, normal_inner_n).iter().sum();
        [outward, opening - held.closing_nm(self.clutch, self.alpha_max)]
    }

    /// Steps of the differences: so far and so fast that N at B and what slides change by [`BESIDE`].
    fn steps(&self) -> Motion {
        let [k, _, c] = self.outer;
        let lever_m = self.held.ob - self.held.p.radius * self.held.p.ahead.cos();
        let n = self.steady.normal_outer_n;
        let r = BESIDE * n / k;
        let r_rate = if c > 0.0 { self.speed_m_s.min(n / c) } else { self.speed_m_s } * BESIDE;
        [r, r / lever_m, r_rate, r_rate / lever_m]
    }

    /// The matrix of d/dt (r, theta, r', theta'), or of (theta, theta') on the stop; `None` where the inertia is none.
    fn matrix(&self) -> Option<DMatrix<f64>> {
        let Held { p, g, mass_kg: m, cage_rad_s, .. } = self.held;
        let (sin, cos) = p.ahead.sin_cos();
        let ([p_x, p_y], [g_x, g_y]) = (p.cartesian(), g.cartesian());
        let from_p = [g_x - p_x, g_y - p_y];
        let (u_r, u_theta) = ([sin, cos], [-from_p[1], from_p[0]]);
        let dot = u_r[0] * u_theta[0] + u_r[1] * u_theta[1];
        let cross = u_theta[0] * u_r[1] - u_theta[1] * u_r[0];
        let about_p = self.clutch.sprags.inertia_kg_m2 + m * (from_p[0] * from_p[0] + from_p[1] * from_p[1]);
        let turning = 2.0 * m * cage_rad_s * cross;
        let mut by = [[0.0; 4]; 2];
        for (j, step) in self.steps().into_iter().enumerate() {
            let at = |d: f64| {
                let mut motion = [0.0; 4];
                motion[j] = d;
                self.forces(motion)
            };
            let (more, less) = (at(step), at(-step));
            (0..2).for_each(|i| by[i][j] = (more[i] - less[i]) / (2.0 * step));
        }
        by[0][3] += turning;
        by[1][2] -= turning;
        if self.steady.cage_n[0] > 0.0 {
            let row = [0.0, 1.0, by[1][1] / about_p, by[1][3] / about_p];
            return Some(DMatrix::from_row_slice(2, 2, &row));
        }
        let inverse = Matrix2::new(m, m * dot, m * dot, about_p).try_inverse()?;
        let accelerates = |i: usize, j: usize| inverse[(i, 0)] * by[0][j] + inverse[(i, 1)] * by[1][j];
        Some(DMatrix::from_fn(4, 4, |i, j| match i {
            0 | 1 => f64::from(u8::from(j == i + 2)),
            _ => accelerates(i - 2, j),
        }))
    }
}

/// The swing about `steady`, found by [`super::overrun_in_cage`] with the same `touch` at `cage_rad_s`, B sliding at `speed_m_s`, on `film`
/// or dry by (12); `None` where B is open or does not slide, without a cage, and where the eigenvalues are not found.
pub fn swing_in_cage(
    clutch: &Clutch,
    touch: &WedgeCurve,
    alpha_max: f64,
    steady: &Overrun,
    [cage_rad_s, speed_m_s]: [f64; 2],
    film: Option<&FilmFriction>,
) -> Option<Swing> {
    let outer = film.map(|film| film.compliance(speed_m_s, steady.normal_outer_n));
    about(clutch, touch, alpha_max, steady, [cage_rad_s, speed_m_s], film, outer)
}

/// The same with the friction of `film` at B, which follows load and speed at once, and nothing else of it.
pub fn swing_in_cage_with_friction(
    clutch: &Clutch,
    touch: &WedgeCurve,
    alpha_max: f64,
    steady: &Overrun,
    [cage_rad_s, speed_m_s]: [f64; 2],
    film: &FilmFriction,
) -> Option<Swing> {
    about(clutch, touch, alpha_max, steady, [cage_rad_s, speed_m_s], Some(film), None)
}

/// B yields by `outer`, k, h_v and c, or as dry bodies do.
fn about(
    clutch: &Clutch,
    touch: &WedgeCurve,
    alpha_max: f64,
    steady: &Overrun,
    [cage_rad_s, speed_m_s]: [f64; 2],
    film: Option<&FilmFriction>,
    outer: Option<[f64; 3]>,
) -> Option<Swing> {
    let cage = clutch.cage.as_ref()?;
    let n = steady.normal_outer_n;
    if n <= 0.0 || speed_m_s <= 0.0 {
        return None;
    }
    let touching = Held::new(clutch, cage, touch, cage_rad_s);
    let gap = film.map_or(0.0, |film| SlidingContact::on(film, speed_m_s, n).gap_m);
    let yields = |n: f64| Some(touch.closure_at_normal(n)?.1.deformations);
    let outer = match outer {
        Some(outer) => outer,
        None => [1.0 / yields(n).map(|d| d.contact_outer.d + d.race_outer.d)?, 0.0, 0.0],
    };
    let inner_n_per_m = match steady.normal_inner_n {
        a if a > 0.0 => 1.0 / yields(a).map(|d| d.contact_inner.d + d.race_inner.d)?,
        _ => 0.0,
    };
    let about = About {
        clutch,
        alpha_max,
        held: touching.tilted(touching.alpha - steady.alpha_rad, gap),
        steady,
        speed_m_s,
        film,
        dry: Stribeck::of(&clutch.friction),
        outer,
        inner_n_per_m,
    };
    let found = eigenvalues(about.matrix()?)?;
    let fastest = found.iter().max_by(|a, b| a.re.total_cmp(&b.re))?;
    Some(Swing::of(fastest.re, fastest.im.abs(), n))
}
