//! Curvature of the inner profile as a contact of finite width feels it.
//!
//! Three means, because width, approach and place of the force weigh the profile differently. For a profile h(x) = h''(0) x^2/2 + dh(x)
//! pressed into a half-plane over |x| < a, to first order in dh:
//!
//! * The load is q = (E*/2) int x h'(x)/sqrt(a^2 - x^2) dx (Johnson, *Contact Mechanics*, 5.2), by parts
//!   (E*/2) int sqrt(a^2 - x^2) h''(x) dx: the half width is that of a cylinder whose curvature is the mean of h''
//!   with the weight sqrt(1 - u^2), u = x/a.
//! * At a given load the approach changes by int dh(x) p(x) dx with the flat punch's pressure
//!   p = 1/(pi sqrt(a^2 - x^2)) (reciprocity of the change of pressure with the punch: the one leaves the load, the
//!   other is flat under the patch). By parts twice, with dh(0) = dh'(0) = 0 at the contact point,
//!   (1/pi) int [sqrt(a^2 - x^2) - |x| acos|u|] dh''(x) dx; a change dk of a cylinder's curvature gives (a^2/4) dk.
//!   So the approach is that of a cylinder whose curvature is the mean of h'' with the weight
//!   sqrt(1 - u^2) - |u| acos|u|.
//! * The force lies where its moment works on the turn of the profile: dh under Hertz's pressure. Curvature that differs
//!   ahead and behind takes it away from the contact point by (a/k) int m'(u) h''(u a) du,
//!   m = [sqrt(1 - u^2) - |u| acos|u| - (1 - u^2)^(3/2)/3]/pi, k the curvature of the gap: towards what is curved less.
//!   The plane contact of a step d of curvature has it at -d a m(c/a) (tests/wedge/patch_contact.rs).
//!
//! What a patch's edge meets it feels as (1 - u)^(3/2) in its width but as (1 - u)^(5/2) in its approach, so a
//! junction that comes under the edge leaves no kink in the tangent stiffness.

use std::f64::consts::PI;

use super::Profile;

/// Curvature under a contact patch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PatchCurvature {
    /// Mean curvature, 1/m.
    pub curvature_per_m: f64,
    /// Its derivative by the turn of the contact at fixed half width, 1/(m rad).
    pub by_turn_per_m_rad: f64,
    /// Its derivative by the half width at fixed turn, 1/m^2.
    pub by_half_width_per_m2: f64,
    /// Whether the patch lies on more than one arc.
    pub straddles: bool,
}

impl Profile {
    /// Curvature that decides the width of a patch of half width `half_width_m` around the contact at turn `turn_rad`
    /// on arc `arc`: weight sqrt(1 - u^2). The first and the last arc are continued beyond the profile.
    pub fn patch_curvature(&self, arc: usize, turn_rad: f64, half_width_m: f64) -> PatchCurvature {
        let [mean] = self.mean_curvatures(arc, turn_rad, half_width_m, [1.0], |u, _| {
            let root = (1.0 - u * u).sqrt();
            [(0.5 + (u * root + u.asin()) / PI, 2.0 / PI * root)]
        });
        mean
    }

    /// Curvature that decides the approach, for the same patch: weight sqrt(1 - u^2) - |u| acos|u|.
    pub fn approach_curvature(&self, arc: usize, turn_rad: f64, half_width_m: f64) -> PatchCurvature {
        let [mean] = self.mean_curvatures(arc, turn_rad, half_width_m, [1.0], |u, _| {
            let (v, root) = (u.abs(), (1.0 - u * u).sqrt());
            [approach_share(u, v, root, v.acos())]
        });
        mean
    }

    /// The same, and the difference of curvature ahead and behind that carries the force off the contact point: times a/k,
    /// k the curvature of the gap, by how much it lies ahead, m.
    pub fn approach_curvature_and_lead(
        &self,
        arc: usize,
        turn_rad: f64,
        half_width_m: f64,
    ) -> [PatchCurvature; 2] {
        self.mean_curvatures(arc, turn_rad, half_width_m, [1.0, 0.0], |u, side| {
            let (v, root) = (u.abs(), (1.0 - u * u).sqrt());
            let acos = v.acos();
            // As on the side where the junction belongs, smoothly past the contact point: an arc goes on beyond its ends.
            let w = side * u;
            let angle = if w < 0.0 { PI - acos } else { acos };
            let lead = (root - w * angle - root * root * root / 3.0) / PI;
            [approach_share(u, v, root, acos), (lead, -side * (angle - w * root) / PI)]
        })
    }

    /// Distance along the profile from the contact at turn `turn_rad` on arc `arc` to the junction at which arc
    /// `junction` (from 0) ends, m, positive in the sense of engagement.
    pub fn junction_distance_m(&self, arc: usize, turn_rad: f64, junction: usize) -> f64 {
        let here = &self.arcs[arc];
        if junction >= arc {
            let ahead = here.radius_m * (here.until_rad - turn_rad);
            (arc + 1..=junction).fold(ahead, |x, k| x + self.length_m(k))
        } else {
            let behind = here.radius_m * (here.from_rad - turn_rad);
            (junction + 1..arc).rev().fold(behind, |x, k| x - self.length_m(k))
        }
    }

    /// Length of arc `k`, m.
    fn length_m(&self, k: usize) -> f64 {
        let arc = &self.arcs[k];
        arc.radius_m * (arc.until_rad - arc.from_rad)
    }

    /// Means with weights whose shares to the left of x = u a, and their slopes by u, `shares` gives for |u| <= 1 and the side
    /// of the contact, 1 ahead and -1 behind, where the junction at x belongs; `all` has those of the whole patch.
    fn mean_curvatures<const K: usize>(
        &self,
        arc: usize,
        turn_rad: f64,
        half_width_m: f64,
        all: [f64; K],
        shares: impl Fn(f64, f64) -> [(f64, f64); K],
    ) -> [PatchCurvature; K] {
        let a = half_width_m.max(f64::MIN_POSITIVE);
        let here_m = self.arcs[arc].radius_m;
        let last = self.arcs.len() - 1;
        let mut means = [PatchCurvature {
            curvature_per_m: 0.0,
            by_turn_per_m_rad: 0.0,
            by_half_width_per_m2: 0.0,
            straddles: false,
        }; K];
        // Shares up to the junction at x, with their derivatives: x falls by the radius in contact per turn.
        let up_to = |x: f64, side: f64| {
            let u = (x / a).clamp(-1.0, 1.0);
            shares(u, side).map(|(part, slope)| (part, -slope * here_m / a, -slope * u / a))
        };
        let mut add = |k: usize, starts: [(f64, f64, f64); K], ends: [(f64, f64, f64); K]| {
            let radius_m = self.arcs[k].radius_m;
            for ((mean, start), end) in means.iter_mut().zip(starts).zip(ends) {
                let part = end.0 - start.0;
                mean.curvature_per_m += part / radius_m;
                mean.by_turn_per_m_rad += (end.1 - start.1) / radius_m;
                mean.by_half_width_per_m2 += (end.2 - start.2) / radius_m;
                mean.straddles |= k != arc && part > 0.0;
            }
        };
        // From the arc in contact outwards, no further than the patch.
        let (nothing, all) = ([(0.0, 0.0, 0.0); K], all.map(|whole| (whole, 0.0, 0.0)));
        let mut ahead_m = self.junction_distance_m(arc, turn_rad, arc);
        let mut behind_m = self.arcs[arc].radius_m * (self.arcs[arc].from_rad - turn_rad);
        let mut until = if arc == last { all } else { up_to(ahead_m, 1.0) };
        let mut from = if arc == 0 { nothing } else { up_to(behind_m, -1.0) };
        add(arc, from, until);
        for k in arc + 1..=last {
            if ahead_m >= a {
                break;
            }
            ahead_m += self.length_m(k);
            let end = if k == last { all } else { up_to(ahead_m, 1.0) };
            add(k, until, end);
            until = end;
        }
        for k in (0..arc).rev() {
            if behind_m <= -a {
                break;
            }
            behind_m -= self.length_m(k);
            let start = if k == 0 { nothing } else { up_to(behind_m, -1.0) };
            add(k, start, from);
            from = start;
        }
        means
    }
}

/// Share of the approach's weight to the left of u, and its slope; v = |u|, root = sqrt(1 - u^2), acos = acos v.
fn approach_share(u: f64, v: f64, root: f64, acos: f64) -> (f64, f64) {
    let half = (3.0 * v * root + v.asin() - 2.0 * v * v * acos) / PI;
    (0.5 + half.copysign(u), 4.0 / PI * (root - v * acos))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn multi() -> Profile {
        let arcs = [(4.02e-3, 0.06), (4.08e-3, 0.12), (4.15e-3, 0.45)];
        Profile::new(4.68e-3, 0.62e-3, &arcs, 11.11e-3, 19.44e-3).unwrap()
    }

    #[test]
    fn a_narrow_patch_sees_its_arc_and_a_junction_the_mean_of_two() {
        let p = multi();
        let inside = p.patch_curvature(1, 0.09, 1e-6);
        assert!(!inside.straddles && (inside.curvature_per_m * 4.08e-3 - 1.0).abs() < 1e-14);
        let at = p.patch_curvature(0, 0.06, 1e-6);
        let mean = 0.5 * (1.0 / 4.02e-3 + 1.0 / 4.08e-3);
        assert!(at.straddles && (at.curvature_per_m / mean - 1.0).abs() < 1e-12);
    }

    #[test]
    fn only_junctions_under_the_patch_are_work() {
        let asked = |arcs: usize, arc: usize| {
            let each: Vec<(f64, f64)> =
                (1..=arcs).map(|k| (4e-3 + 1e-6 * k as f64, 0.01 * k as f64)).collect();
            let p = Profile::new(4.68e-3, 0.62e-3, &each, 11.11e-3, 19.44e-3).unwrap();
            let count = std::cell::Cell::new(0);
            let share = |u: f64, _: f64| {
                count.set(count.get() + 1);
                [(0.5 + 0.5 * u, 0.5)]
            };
            // A half width of 2.5 arcs of 0.04 mm: junctions at 0.02, 0.06 and 0.10 mm either way.
            p.mean_curvatures(arc, p.arcs[arc].from_rad + 0.005, 1e-4, [1.0], share);
            count.get()
        };
        assert_eq!((asked(11, 5), asked(81, 40)), (6, 6));
    }

    #[test]
    fn it_is_the_same_from_both_sides_of_a_junction_and_adds_up() {
        let p = multi();
        for a in [1e-5, 1e-4, 5e-4, 3e-3] {
            let (left, right) = (p.patch_curvature(0, 0.06, a), p.patch_curvature(1, 0.06, a));
            assert!((left.curvature_per_m / right.curvature_per_m - 1.0).abs() < 1e-12);
        }
        let one =
            Profile::new(4.68e-3, 0.62e-3, &[(4.02e-3, 0.1), (4.02e-3, 0.4)], 11.11e-3, 19.44e-3).unwrap();
        assert!((one.patch_curvature(0, 0.099, 1e-4).curvature_per_m * 4.02e-3 - 1.0).abs() < 1e-13);
    }

    #[test]
    fn derivatives_are_those_of_the_means() {
        let p = multi();
        for (arc, turn, a) in [(0, 0.05, 2e-4), (1, 0.07, 1e-4), (1, 0.11, 3e-4), (2, 0.13, 4e-4)] {
            let lead =
                |p: &Profile, arc: usize, turn: f64, a: f64| p.approach_curvature_and_lead(arc, turn, a)[1];
            for of in [Profile::patch_curvature, Profile::approach_curvature, lead] {
                let at = |turn: f64, a: f64| of(&p, arc, turn, a).curvature_per_m;
                let got = of(&p, arc, turn, a);
                let (h, w) = (1e-5, 1e-8);
                let by_turn = (at(turn + h, a) - at(turn - h, a)) / (2.0 * h);
                let by_half_width = (at(turn, a + w) - at(turn, a - w)) / (2.0 * w);
                assert!((got.by_turn_per_m_rad - by_turn).abs() < 1e-5 * by_turn.abs(), "{got:?} {by_turn}");
                assert!(
                    (got.by_half_width_per_m2 - by_half_width).abs() < 1e-5 * by_half_width.abs().max(1e3)
                );
            }
        }
    }

    /// The approach's mean against the flat punch's mean of the true gap, by the substitution x = a sin t.
    #[test]
    fn the_approach_mean_is_the_flat_punchs_mean_of_the_gap() {
        let p = multi();
        for (arc, turn, a) in [(0, 0.05, 2e-4), (0, 0.06, 1e-4), (1, 0.1, 2.5e-4), (2, 0.13, 3e-4)] {
            let ends: Vec<f64> = (0..2).map(|j| p.junction_distance_m(arc, turn, j)).collect();
            // h(x) - h(0) - h'(0) x from the curvature outwards: each junction adds its step of curvature.
            let radii: Vec<f64> = p.arcs.iter().map(|r| r.radius_m).collect();
            let gap = |x: f64| {
                let mut h = 0.5 * x * x / radii[arc];
                for (j, &end) in ends.iter().enumerate() {
                    let step = 1.0 / radii[j + 1] - 1.0 / radii[j];
                    if j >= arc && x > end {
                        h += 0.5 * step * (x - end).powi(2);
                    } else if j < arc && x < end {
                        h -= 0.5 * step * (x - end).powi(2);
                    }
                }
                h
            };
            let n = 100_000;
            let mean = (0..n)
                .map(|i| gap(a * (PI * ((f64::from(i) + 0.5) / f64::from(n) - 0.5)).sin()))
                .sum::<f64>()
                / f64::from(n);
            let got = p.approach_curvature(arc, turn, a);
            assert!(
                got.straddles && (0.25 * a * a * got.curvature_per_m / mean - 1.0).abs() < 1e-9,
                "{got:?}"
            );
        }
    }

    /// Against the integral it stands for, by the substitution x = a sin t.
    #[test]
    fn it_is_the_weighted_integral() {
        let p = multi();
        let (turn, a) = (0.1, 2.5e-4);
        let curvature = |x: f64| {
            // Along the profile from the contact on arc 2 at turn 0.1.
            let (start, end) = (4.08e-3 * (0.06 - turn), 4.08e-3 * (0.12 - turn));
            if x < start {
                1.0 / 4.02e-3
            } else if x < end {
                1.0 / 4.08e-3
            } else {
                1.0 / 4.15e-3
            }
        };
        let n = 200_000;
        let sum: f64 = (0..n)
            .map(|i| {
                let t = std::f64::consts::PI * ((i as f64 + 0.5) / n as f64 - 0.5);
                t.cos().powi(2) * curvature(a * t.sin())
            })
            .sum::<f64>()
            * 2.0
            / n as f64;
        let got = p.patch_curvature(1, turn, a);
        assert!(got.straddles && (got.curvature_per_m / sum - 1.0).abs() < 1e-7, "{got:?} {sum}");
    }
}
