//! Tension that a tangential force leaves in the surface behind a line contact.
//!
//! A traction q_0 sqrt(1 - x^2/c^2) over |x| < c leaves sigma_x = 2 q_0 [|x|/c - sqrt(x^2/c^2 - 1)] beside it, tension
//! behind and compression ahead (Johnson, *Contact Mechanics*, 7.2, from his (2.22)). Sliding is one such traction,
//! q_0 = mu p_0; sticking in part is that less another, q_0 = mu p_0 c/a, over the part that sticks, whose half width is
//! c = a sqrt(1 - T/(mu N)): in the middle of the patch where the force came without rolling (Cattaneo, Mindlin; Johnson
//! 7.2(c)), at its leading edge where the contact rolls (Carter; Johnson 8.3). The normal pressure leaves nothing beside
//! the patch, so this adds to the stress of the body as a whole. It dies out over a half width.

/// Largest tension at the trailing edge of a patch, Pa.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgeTension {
    /// The force came without rolling: 2 p_0 sqrt(mu T/N).
    pub standing_pa: f64,
    /// The contact rolls steadily: 2 mu p_0 (c/a - 1 + 2 sqrt(1 - c/a)), up to sqrt(2) of the other where T is small.
    pub rolling_pa: f64,
}

/// For the traction `tan` = T/N under the peak pressure p_0 (Pa) with friction `mu`; both are 2 mu p_0 from `tan` = mu on, where
/// the whole patch slips.
pub fn edge_tension(peak_pressure_pa: f64, tan: f64, mu: f64) -> EdgeTension {
    let used = (tan.abs() / mu).min(1.0);
    let stuck = (1.0 - used).sqrt();
    let sliding_pa = 2.0 * mu * peak_pressure_pa;
    EdgeTension {
        standing_pa: sliding_pa * used.sqrt(),
        rolling_pa: sliding_pa * (stuck - 1.0 + 2.0 * (1.0 - stuck).sqrt()),
    }
}

/// The same at `half_widths` >= 1 from the middle of the patch, on the side of its trailing edge, Pa. Of a traction
/// q_0 sqrt(1 - x^2/c^2) there is 2 q_0/(z + sqrt(z^2 - 1)) at z half widths from its own middle.
pub fn tension_behind(peak_pressure_pa: f64, tan: f64, mu: f64, half_widths: f64) -> EdgeTension {
    let stuck = (1.0 - (tan.abs() / mu).min(1.0)).sqrt();
    let of = |z: f64| (z + (z * z - 1.0).max(0.0).sqrt()).recip();
    let strip = |ahead: f64| if stuck > 0.0 { stuck * of((half_widths + ahead) / stuck) } else { 0.0 };
    let [standing_pa, rolling_pa] =
        [0.0, 1.0 - stuck].map(|ahead| 2.0 * mu * peak_pressure_pa * (of(half_widths) - strip(ahead)));
    EdgeTension { standing_pa, rolling_pa }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// sigma_x at the trailing edge x = -a by the integral of the tangential line loads, -(2/pi) q/(x - s) each (Flamant),
    /// over a traction given as q(s) with s = a sin t.
    fn integrated(traction: impl Fn(f64) -> f64) -> f64 {
        let cells = 2_000_000;
        (0..cells)
            .map(|i| {
                let t = PI * ((f64::from(i) + 0.5) / f64::from(cells) - 0.5);
                2.0 / PI * traction(t.sin()) * t.cos() / (1.0 + t.sin()) * PI / f64::from(cells)
            })
            .sum()
    }

    #[test]
    fn it_is_what_the_line_loads_of_the_traction_add_up_to() {
        let mu = 0.12;
        for tan in [0.03, 0.08, 0.1199, 0.12] {
            let stuck = (1.0f64 - tan / mu).max(0.0).sqrt();
            let strip = |s: f64, middle: f64| {
                let x = (s - middle) / stuck;
                if stuck > 0.0 && x.abs() < 1.0 { mu * stuck * (1.0 - x * x).sqrt() } else { 0.0 }
            };
            let traction = |middle: f64| move |s: f64| mu * (1.0 - s * s).sqrt() - strip(s, middle);
            let got = edge_tension(1.0, tan, mu);
            let want = [integrated(traction(0.0)), integrated(traction(1.0 - stuck))];
            assert!((got.standing_pa / want[0] - 1.0).abs() < 1e-3, "{tan}: {got:?} against {want:?}");
            assert!((got.rolling_pa / want[1] - 1.0).abs() < 1e-3, "{tan}: {got:?} against {want:?}");
        }
    }

    #[test]
    fn at_the_edge_it_is_the_largest_and_far_away_that_of_a_line_load() {
        let (mu, tan) = (0.12, 0.08);
        let (edge, at) = (edge_tension(1e9, tan, mu), tension_behind(1e9, tan, mu, 1.0));
        assert!((at.standing_pa / edge.standing_pa - 1.0).abs() < 1e-12);
        assert!((at.rolling_pa / edge.rolling_pa - 1.0).abs() < 1e-12);
        // (2/pi) T/x with T = tan p_0 pi a/2.
        let far = tension_behind(1e9, tan, mu, 200.0);
        assert!((far.standing_pa / (tan * 1e9 / 200.0) - 1.0).abs() < 1e-4, "{far:?}");
        assert!((far.rolling_pa / far.standing_pa - 1.0).abs() < 1e-2);
    }

    #[test]
    fn nothing_without_traction_and_twice_the_traction_in_full_slip() {
        assert_eq!(edge_tension(1e9, 0.0, 0.12), EdgeTension { standing_pa: 0.0, rolling_pa: 0.0 });
        let slip = edge_tension(1e9, 0.5, 0.1);
        assert!((slip.standing_pa - 2e8).abs() < 1.0 && (slip.rolling_pa - 2e8).abs() < 1.0);
        let little = edge_tension(1e9, 1e-6, 0.1);
        assert!((little.rolling_pa / little.standing_pa - 2f64.sqrt()).abs() < 1e-2);
    }
}
