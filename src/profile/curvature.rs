//! Curvature of the inner profile as a contact of finite width feels it.

use super::Profile;

/// Curvature under a contact patch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PatchCurvature {
    /// Mean curvature, 1/m.
    pub curvature_per_m: f64,
    /// Whether the patch lies on more than one arc.
    pub straddles: bool,
}

impl Profile {
    /// Mean of the profile's curvature over the patch of half width `half_width_m` around the contact at turn
    /// `turn_rad` on arc `arc`, weighted by sqrt(1 - (x/a)^2).
    ///
    /// The weight is not a choice: for a smooth profile h(x) pressed into a half-plane over |x| < a the load is
    /// q = (E*/2) int x h'(x)/sqrt(a^2 - x^2) dx (Johnson, *Contact Mechanics*, 5.2), by parts
    /// (E*/2) int sqrt(a^2 - x^2) h''(x) dx, so the half width is that of a cylinder with the curvature
    /// (2/(pi a^2)) int sqrt(a^2 - x^2) h'' dx. The first and the last arc are continued beyond the profile.
    pub fn patch_curvature(&self, arc: usize, turn_rad: f64, half_width_m: f64) -> PatchCurvature {
        let here = &self.arcs[arc];
        let a = half_width_m.max(f64::MIN_POSITIVE);
        // Share of the weight to the left of x = u a.
        let share = |u: f64| {
            let u = u.clamp(-1.0, 1.0);
            0.5 + (u * (1.0 - u * u).sqrt() + u.asin()) / std::f64::consts::PI
        };
        let mut curvature = 0.0;
        let mut straddles = false;
        // Ends of the arc in contact, as distances along the profile from the contact.
        let (ahead, behind) =
            (here.radius_m * (here.until_rad - turn_rad), here.radius_m * (here.from_rad - turn_rad));
        let last = self.arcs.len() - 1;
        let upper = if arc == last { f64::INFINITY } else { ahead };
        let lower = if arc == 0 { f64::NEG_INFINITY } else { behind };
        curvature += (share(upper / a) - share(lower / a)) / here.radius_m;
        let mut x = ahead;
        for (k, next) in self.arcs.iter().enumerate().skip(arc + 1) {
            let end = x + next.radius_m * (next.until_rad - next.from_rad);
            let part = share(if k == last { f64::INFINITY } else { end / a }) - share(x / a);
            straddles |= part > 0.0;
            curvature += part / next.radius_m;
            x = end;
        }
        let mut x = behind;
        for (k, before) in self.arcs.iter().enumerate().take(arc).rev() {
            let start = x - before.radius_m * (before.until_rad - before.from_rad);
            let part = share(x / a) - share(if k == 0 { f64::NEG_INFINITY } else { start / a });
            straddles |= part > 0.0;
            curvature += part / before.radius_m;
            x = start;
        }
        PatchCurvature { curvature_per_m: curvature, straddles }
    }
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
