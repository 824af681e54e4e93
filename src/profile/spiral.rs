//! Profiles that keep the strut angle, and logarithmic spirals: as curves, and as the tangent arcs that stand for them.
//!
//! # Which curve keeps omega
//! The contact direction n and the way t = n' in which the contact travels turn with the turn psi. Of a profile whose distance
//! from C_e to its tangent is p(psi), the contact is A = p n + p' t, its radius of curvature rho = p + p''. The normal at A passes
//! through O, at OA from A, and OC_e = OB - r_e:
//!
//!   sin beta = p'/(OB - r_e),   cos beta = (p + OA)/(OB - r_e).
//!
//! Put into tan omega = OB sin beta/(OB cos beta - OA), (9) and (A.9), the race radii leave but for their ratio:
//!
//!   tan omega = p'/(p + q r_e),   q = OA/OB.
//!
//! So tan omega = k throughout asks for p' = k (p + q r_e), and p = c e^(k psi) - q r_e: a logarithmic spiral with its pole in C_e,
//! taken q r_e inwards along its normals, rho = (rho_0 + q r_e) e^(k psi) - q r_e. It holds for every cylindrical pair of races, flat
//! ones included (q = 1), because a race gives way by parts of a thousand and q with it: under load
//! tan omega = p'/(p - s_i + (OA/OB) (r_e - s_e)), s = (delta_H + delta_g)/2 of either contact, (8).
//!
//! A logarithmic spiral rho = rho_0 e^(k psi) itself (its radius of curvature is the distance from its pole times (1 + k^2)^(1/2),
//! and its tangent turns as the radius does) keeps omega only where r_e is nothing. Its pole lies on the strut of first contact where
//! k = tan omega there: the radius from the pole to A makes the angle arctan k with the normal. With the foot of C_e's
//! perpendicular on the strut for a pole tan omega falls by q r_e (1 - cos psi)/(p + q r_e) of itself; with C_e for a pole it
//! grows by k psi q r_e/(p + q r_e). A pole farther from A makes larger radii and a strut angle that rises, towards a circle's.

use super::Profile;
use crate::numeric::quadrature::{integral, integrals};
use nalgebra::Vector2;

/// Points of half a step at which the distance of the arcs from their curve is looked at: threes, because it is largest at a third.
const LOOKS: usize = 24;

/// A contact on the profile: distance of its tangent from C_e and how it grows with the turn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Support {
    /// p, m.
    pub height_m: f64,
    /// dp/dpsi, m: how far A lies beside C_e, along the tangent.
    pub aside_m: f64,
}

impl Support {
    /// First contact under the strut angle omega, rad, between tracks, m, of a sprag of outer radius r_e, m; `None` where no
    /// sprag is so high. In the triangle O A B sin nu = (R_i/R_e) sin omega, and beta = omega - nu.
    pub fn under(strut_rad: f64, outer_radius_m: f64, tracks_m: [f64; 2]) -> Option<Self> {
        let [inner, outer] = tracks_m;
        let beta = strut_rad - (inner / outer * strut_rad.sin()).asin();
        let oc_e = outer - outer_radius_m;
        let found = Self { height_m: oc_e * beta.cos() - inner, aside_m: oc_e * beta.sin() };
        (found.height_m > 0.0 && found.aside_m > 0.0).then_some(found)
    }

    /// Of `profile` at a turn, rad, that it has.
    pub fn of(profile: &Profile, turn_rad: f64) -> Option<Self> {
        let arc = profile.arcs.iter().find(|a| turn_rad <= a.until_rad)?;
        let (n, t) = (profile.contact_direction(turn_rad), profile.way(turn_rad));
        let a = arc.centre_m + arc.radius_m * n;
        Some(Self { height_m: a.dot(&n), aside_m: a.dot(&t) })
    }

    /// tan omega of this contact between races that do not give; `inset_m` is r_e R_i/R_e, m.
    pub fn tan_omega(&self, inset_m: f64) -> f64 {
        self.aside_m / (self.height_m + inset_m)
    }

    /// Distance from C_e to the centre of an arc of this radius, m, that touches here, m.
    pub fn centre_distance_m(&self, radius_m: f64) -> f64 {
        (radius_m - self.height_m).hypot(self.aside_m)
    }
}

/// A piece of the profile along which the radius of curvature is (rho_0 + d) e^(k (psi - psi_0)) - d.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spiral {
    /// Radius of curvature rho_0 where it begins, m.
    pub start_radius_m: f64,
    /// Growth k per rad of turn.
    pub rise: f64,
    /// By how much the curve lies inside a logarithmic spiral, d, m: 0 for one, r_e R_i/R_e for the curve of constant omega.
    pub inset_m: f64,
    /// Turn psi_0 at which it begins, rad.
    pub from_rad: f64,
    /// Turn at which it ends, rad.
    pub until_rad: f64,
    /// Steps of equal turn, each of which two tangent arcs stand for.
    pub steps: usize,
}

/// How far the arcs of a [`Spiral`] lie beside it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpiralDeviation {
    /// Largest distance, m.
    pub position_m: f64,
    /// Largest distance along the tangent between the contacts at one turn, m: over p + q r_e it is that of tan omega.
    pub along_m: f64,
    /// Largest part by which a radius is off.
    pub radius: f64,
}

impl Spiral {
    /// The curve of constant omega from a contact on, with r_e R_i/R_e, m: p' = k (p + d) there and behind it.
    pub fn of_constant_angle(
        from: Support,
        inset_m: f64,
        [from_rad, until_rad]: [f64; 2],
        steps: usize,
    ) -> Self {
        let rise = from.tan_omega(inset_m);
        let start_radius_m = (from.height_m + inset_m) * (1.0 + rise * rise) - inset_m;
        Self { start_radius_m, rise, inset_m, from_rad, until_rad, steps }
    }

    /// Radius of curvature at a turn, m.
    pub fn radius_m(&self, turn_rad: f64) -> f64 {
        // In this form exact where the rise is 0.
        self.start_radius_m
            + (self.start_radius_m + self.inset_m) * (self.rise * (turn_rad - self.from_rad)).exp_m1()
    }

    /// (radius m, end turn rad) of the tangent arcs that stand for it: two for each step, which begin and end on the curve with
    /// its tangent, so that nothing adds up along it.
    ///
    /// About the middle of a step, u from -h to h, what the arcs leave is to close in both directions. With
    /// x, y of the radii beyond that of the middle: (x + y) sin h = int (rho - rho_m) cos u du and
    /// (y - x) (1 - cos h) = int (rho - rho_m) sin u du.
    pub fn arcs(&self) -> Vec<(f64, f64)> {
        let half = self.half_rad();
        let mut arcs = Vec::with_capacity(2 * self.steps);
        for step in 0..self.steps {
            let middle = self.middle_rad(step);
            let [x, y] = self.beyond_m(middle, half);
            let radius = self.radius_m(middle);
            let end = if step + 1 == self.steps { self.until_rad } else { self.middle_rad(step + 1) - half };
            arcs.extend([(radius + x, middle), (radius + y, end)]);
        }
        arcs
    }

    fn half_rad(&self) -> f64 {
        0.5 * (self.until_rad - self.from_rad) / self.steps as f64
    }

    fn middle_rad(&self, step: usize) -> f64 {
        self.from_rad + (2 * step + 1) as f64 * self.half_rad()
    }

    /// Radii of a step's two arcs beyond the curve's in its middle, m.
    fn beyond_m(&self, middle_rad: f64, half_rad: f64) -> [f64; 2] {
        let scale = self.radius_m(middle_rad) + self.inset_m;
        let [even, odd] = integrals(0.0, half_rad, |u| {
            let (s, c) = u.sin_cos();
            // cosh - 1 without its cancellation.
            [4.0 * (0.5 * self.rise * u).sinh().powi(2) * c, 2.0 * (self.rise * u).sinh() * s]
        });
        let sum = scale * even / half_rad.sin();
        let apart = scale * odd / (2.0 * (0.5 * half_rad).sin().powi(2));
        [0.5 * (sum - apart), 0.5 * (sum + apart)]
    }

    /// How far [`Spiral::arcs`] lie beside the curve. Their tangents lie e(psi) apart at one turn, e'' + e = r - rho, 0 at both
    /// ends of a step, and the contacts e' along them. To leading order 2 rho' h^3/81, rho' h^2/6 and 2 rho' h/(3 rho) of half a
    /// step h, rho' = k (rho + d).
    pub fn deviation(&self) -> SpiralDeviation {
        let half = self.half_rad();
        let mut most = SpiralDeviation { position_m: 0.0, along_m: 0.0, radius: 0.0 };
        for step in 0..self.steps {
            let middle = self.middle_rad(step);
            let arcs = self.beyond_m(middle, half);
            for (beyond, sign) in [(arcs[0], -1.0), (arcs[1], 1.0)] {
                let radius = self.radius_m(middle) + beyond;
                let off = |u: f64| radius - self.radius_m(middle + sign * u);
                for look in 0..=LOOKS {
                    let u = half * look as f64 / LOOKS as f64;
                    // From the end of the step, where both are 0, inwards.
                    let apart = integral(u, half, |s| off(s) * (s - u).sin()).abs();
                    let along = integral(u, half, |s| off(s) * (s - u).cos()).abs();
                    most.position_m = most.position_m.max(apart);
                    most.along_m = most.along_m.max(along);
                    most.radius = most.radius.max((off(u) / self.radius_m(middle + sign * u)).abs());
                }
            }
        }
        most
    }

    /// Its pole in the body frame of `profile`, to which it belongs, m: seen from the contact of the spiral outside by d, against n + k t
    /// by (rho + d)/(1 + k^2) of it. C_e for the curve of constant omega. `None` where the profile does not hold its beginning.
    pub fn pole_m(&self, profile: &Profile) -> Option<Vector2<f64>> {
        let within = |a: &&super::ProfileArc| a.until_rad > self.from_rad;
        let arc = profile.arcs.iter().find(within)?;
        let (n, t) = (profile.contact_direction(self.from_rad), profile.way(self.from_rad));
        let reach = (self.start_radius_m + self.inset_m) / (1.0 + self.rise * self.rise);
        Some(arc.centre_m + (arc.radius_m + self.inset_m) * n - reach * (n + self.rise * t))
    }

    /// By what part of itself tan omega is off that of the curve on a profile that holds its arcs: their contacts lie along the
    /// tangent beside it, and p' is least where the spiral begins.
    pub fn tan_omega_off(&self, profile: &Profile) -> Option<f64> {
        Some(self.deviation().along_m / Support::of(profile, self.from_rad.max(0.0))?.aside_m)
    }

    /// Number of arcs.
    pub fn arc_count(&self) -> usize {
        2 * self.steps
    }

    /// The curve `outwards_m` beside it along its normals, one of the same family: rho + a = (rho_0 + a + (d - a)) e^(k (psi - psi_0)) - (d - a). Its
    /// arcs are those of this one with radii larger by as much, so that is what a tolerance of all radii together is.
    pub fn parallel(&self, outwards_m: f64) -> Self {
        Self { start_radius_m: self.start_radius_m + outwards_m, inset_m: self.inset_m - outwards_m, ..*self }
    }

    /// The same of a sprag enlarged by `scale` whose turns are counted from `turn_rad` on.
    pub fn moved(&self, scale: f64, turn_rad: f64) -> Self {
        Self {
            start_radius_m: scale * self.start_radius_m,
            inset_m: scale * self.inset_m,
            from_rad: self.from_rad - turn_rad,
            until_rad: self.until_rad - turn_rad,
            ..*self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::azimuth_between;
    use super::*;

    const TRACKS: [f64; 2] = [11.11e-3, 19.44e-3];
    const OUTER: f64 = 4.68e-3;

    fn inset() -> f64 {
        OUTER * TRACKS[0] / TRACKS[1]
    }

    fn start() -> Support {
        Support::under(0.0778f64.atan(), OUTER, TRACKS).unwrap()
    }

    fn placed(spiral: &Spiral) -> Profile {
        let arcs = spiral.arcs();
        let e = start().centre_distance_m(arcs[0].0);
        Profile::new(OUTER, e, &arcs, TRACKS[0], TRACKS[1]).unwrap()
    }

    #[test]
    fn first_contact_is_under_the_angle_asked_for() {
        let at = start();
        assert!((at.tan_omega(inset()) - 0.0778).abs() < 1e-15);
        // The same of triangle (9).
        let beta =
            azimuth_between(TRACKS[0] + 4.02e-3, TRACKS[1] - OUTER, at.centre_distance_m(4.02e-3)).unwrap();
        let tan = TRACKS[1] * beta.sin() / (TRACKS[1] * beta.cos() - TRACKS[0]);
        assert!((tan - 0.0778).abs() < 1e-14, "{tan}");
    }

    #[test]
    fn without_a_rise_every_arc_is_the_circle() {
        for steps in [1, 7, 90] {
            let circle = Spiral {
                start_radius_m: 4.02e-3,
                rise: 0.0,
                inset_m: 0.0,
                from_rad: 0.06,
                until_rad: 0.5,
                steps,
            };
            assert!(circle.arcs().iter().all(|(r, _)| *r == 4.02e-3));
            assert_eq!(circle.arcs().last().unwrap().1, 0.5);
            assert!(circle.deviation().position_m < 1e-18);
            // And with next to none it is next to the circle.
            let next = Spiral { rise: 1e-11, ..circle };
            assert!(next.arcs().iter().all(|(r, _)| (r / 4.02e-3 - 1.0).abs() < 1e-11));
        }
    }

    #[test]
    fn the_arcs_lie_beside_the_curve_by_what_is_said_and_by_the_third_power_of_a_step() {
        let (at, d) = (start(), inset());
        let mut before: Option<SpiralDeviation> = None;
        for steps in [2, 4, 8, 16] {
            let spiral = Spiral::of_constant_angle(at, d, [0.0, 0.4], steps);
            let profile = placed(&spiral);
            let k = spiral.rise;
            let said = spiral.deviation();
            let (mut apart, mut along, mut tan) = (0.0f64, 0.0f64, 0.0f64);
            for i in 0..=4000 {
                let turn = 0.4 * i as f64 / 4000.0;
                let Support { height_m: p, aside_m: slope } = Support::of(&profile, turn).unwrap();
                let true_p = (at.height_m + d) * (k * turn).exp() - d;
                apart = apart.max((p - true_p).abs());
                along = along.max((slope - k * (true_p + d)).abs());
                tan = tan.max((slope / (p + d) / k - 1.0).abs());
            }
            println!(
                "{steps} steps: {said:?}; seen {apart:e}, {along:e}; tan omega off by {tan:e} of itself"
            );
            assert!(apart <= said.position_m * 1.001 + 1e-17 && apart > 0.97 * said.position_m);
            assert!(along <= said.along_m * 1.001 + 1e-17 && along > 0.97 * said.along_m);
            assert!(tan < 1.01 * said.along_m / (at.aside_m));
            let [h, slope] = [0.2 / steps as f64, k * (spiral.radius_m(0.4) + d)];
            assert!((said.position_m / (2.0 / 81.0 * slope * h.powi(3)) - 1.0).abs() < 0.03);
            assert!((said.along_m / (slope * h * h / 6.0) - 1.0).abs() < 0.03);
            assert!((said.radius / (2.0 / 3.0 * slope * h / spiral.radius_m(0.4)) - 1.0).abs() < 0.03);
            if let Some(b) = before {
                assert!(b.position_m / said.position_m > 7.5 && b.along_m / said.along_m > 3.8);
            }
            before = Some(said);
        }
    }

    /// The pole of a placed spiral is the same seen from its end, and on the strut where k = tan omega; that of the curve
    /// of constant omega is C_e.
    #[test]
    fn a_spiral_has_one_pole() {
        let at = start();
        let constant = Spiral::of_constant_angle(at, inset(), [0.0, 0.4], 8);
        assert!(constant.pole_m(&placed(&constant)).unwrap().norm() < 1e-16);
        let log = Spiral {
            start_radius_m: 4.02e-3,
            rise: 0.0778,
            inset_m: 0.0,
            from_rad: 0.0,
            until_rad: 0.4,
            steps: 8,
        };
        let profile = placed(&log);
        let pole = log.pole_m(&profile).unwrap();
        let (n, t) = (profile.contact_direction(0.0), profile.way(0.0));
        let a = profile.arcs[0].centre_m + profile.arcs[0].radius_m * n;
        let strut = Vector2::new(0.0, OUTER) - a;
        assert!((a - pole).perp(&strut).abs() < 1e-15 * strut.norm());
        assert!(((a - pole).norm() * (1.0f64 + 0.0778 * 0.0778).sqrt() / 4.02e-3 - 1.0).abs() < 1e-14);
        // From the end: there the arcs have come back to the curve.
        let end = profile.arcs.last().unwrap();
        let (n, t_end) = (profile.contact_direction(0.4), profile.way(0.4));
        let b = end.centre_m + end.radius_m * n;
        let reach = log.radius_m(0.4) / (1.0 + log.rise * log.rise);
        assert!((b - reach * (n + log.rise * t_end) - pole).norm() < 1e-16, "{t}");
    }
}
