//! Influence of a loaded slice on the others: Love's rectangle on a half-space, averaged over a slice.

use crate::numeric::quadrature::integral;

/// w_jk of (2) for |j - k| = 0 .. slices - 1, m/Pa: mean displacement (of both bodies together) over the
/// patch 2a x h of slice j made by unit pressure on the patch of slice k, h = l/n.
///
/// Love's solution (Johnson, *Contact Mechanics*, (3.25)) is the integral of 1/(pi E* r) over the loaded
/// patch. Its mean over an equal patch, displaced by y along the contact, is the second difference in y of
/// a closed form Phi. The mean over the width first: with c = 2a,
///   g(y) = mean of 1/r = (2/c) asinh(c/y) - 2/(sqrt(c^2 + y^2) + y),
/// and then Phi'' = g, Phi(0) = Phi'(0) = 0, with R = sqrt(c^2 + y^2):
///   Phi(y) = (y^2/c) asinh(c/y) + y asinh(y/c) - y^2/(R + y) - y^2/(R + c)
///            + 2/3 [(R^2 + R y + y^2)/(R + y) - c].
/// Exact for near slices, and written so that nothing cancels for narrow patches; but the second difference
/// costs about (j - k)^2 roundings, so from some slices away the same mean, the integral of (1 - |t|) g(y + t),
/// is taken by Gauss-Legendre panels, whose error is below rounding there. 1e-13 relative for any number.
///
/// Expects positive finite arguments. `slices` = 0 gives an empty vector.
pub fn influence_m_per_pa(
    half_width_m: f64,
    slice_length_m: f64,
    slices: usize,
    contact_modulus_pa: f64,
) -> Vec<f64> {
    let h = slice_length_m;
    let c = 2.0 * half_width_m / h;
    // Phi in units of h^2 times 1/h, at multiples of the slice length
    let scale = c * h / (std::f64::consts::PI * contact_modulus_pa);
    let near = |k: usize| {
        let y = k as f64;
        phi(c, y + 1.0) - 2.0 * phi(c, y) + phi(c, (y - 1.0).abs())
    };
    let far = |k: usize| {
        let y = k as f64;
        integral(0.0, 1.0, |t| (1.0 - t) * (mean_inverse(c, y + t) + mean_inverse(c, y - t)))
    };
    (0..slices).map(|k| scale * if k < NEAR { near(k) } else { far(k) }).collect()
}

/// From here on 12 points per panel of one slice are exact: the nearest singularity of g, y = 0, lies 5 half
/// panels beyond the panel, so the error falls as (11 + sqrt(120))^-24.
const NEAR: usize = 6;

/// g(y) for y > 0 and patches of width c.
fn mean_inverse(c: f64, y: f64) -> f64 {
    2.0 / c * (c / y).asinh() - 2.0 / (c.hypot(y) + y)
}

fn phi(c: f64, y: f64) -> f64 {
    if y == 0.0 {
        return 0.0;
    }
    let r = c.hypot(y);
    y * y / c * (c / y).asinh() + y * (y / c).asinh() - y * y / (r + y) - y * y / (r + c)
        + 2.0 / 3.0 * ((r * r + r * y + y * y) / (r + y) - c)
}

/// Eq. (2): `[S_w] = n s/(sum w) [w]`, m/N, the weighted influence matrix by distance |j - k|, from the w_jk of
/// [`influence_m_per_pa`] and the compliance s of a slice, m/N.
///
/// The matrix is symmetric Toeplitz, this its first row. Its mean row sum is s, so a uniform load q per slice gives a mean deflection s q
/// whatever w: the slices share the load, the mean compliance stays that of the law s came from.
#[doc(alias = "Eq. (2)")]
pub fn weighted_influence_m_per_n(influence_m_per_pa: &[f64], slice_compliance_m_per_n: f64) -> Vec<f64> {
    let n = influence_m_per_pa.len();
    let factor = n as f64 * slice_compliance_m_per_n / influence_sum(influence_m_per_pa);
    influence_m_per_pa.iter().map(|w| factor * w).collect()
}

/// sum_jk w_jk of the symmetric Toeplitz matrix.
pub(super) fn influence_sum(influence: &[f64]) -> f64 {
    let n = influence.len();
    influence.iter().enumerate().map(|(d, w)| if d == 0 { n as f64 } else { 2.0 * (n - d) as f64 } * w).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    const E_STAR: f64 = 206e9 / (2.0 * 0.91);

    /// Love: displacement at (x, y) by unit pressure on |x| < a, |y| < b (Johnson (3.25)).
    fn love_m_per_pa(x: f64, y: f64, a: f64, b: f64) -> f64 {
        let term = |p: f64, q: f64, r: f64, s: f64| p * ((q + q.hypot(p)) / (r + r.hypot(s))).ln();
        (term(x + a, y + b, y - b, x + a)
            + term(y + b, x + a, x - a, y + b)
            + term(x - a, y - b, y + b, x - a)
            + term(y - b, x - a, x + a, y - b))
            / (std::f64::consts::PI * E_STAR)
    }

    #[test]
    fn the_closed_form_is_the_mean_of_loves_solution() {
        let (a, h) = (0.0929e-3, 0.1e-3);
        let w = influence_m_per_pa(a, h, 4, E_STAR);
        // midpoint rule in t, position 10t^3 - 15t^4 + 6t^5 - 1/2 across a patch: the weight takes away the
        // x ln x of Love's field at the patch edges, the only places where it is not smooth
        let m = 300;
        let nodes: Vec<(f64, f64)> = (0..m)
            .map(|i| (i as f64 + 0.5) / m as f64)
            .map(|t| {
                (t.powi(3) * (10.0 - 15.0 * t + 6.0 * t * t) - 0.5, 30.0 * (t * (1.0 - t)).powi(2) / m as f64)
            })
            .collect();
        for (k, w) in w.iter().enumerate() {
            let mut mean = 0.0;
            for (x, weight_x) in &nodes {
                for (y, weight_y) in &nodes {
                    let love = love_m_per_pa(2.0 * a * x, h * (k as f64 + y), a, 0.5 * h);
                    mean += love * weight_x * weight_y;
                }
            }
            println!("{k}: off by {:e}", w / mean - 1.0);
            assert!((w / mean - 1.0).abs() < 1e-8, "{k}: {w} {mean}");
        }
    }

    #[test]
    fn far_slices_feel_a_point_force() {
        let (a, h) = (0.1e-3, 0.1e-3);
        let w = influence_m_per_pa(a, h, 200, E_STAR);
        let y = 199.0 * h;
        let point = 2.0 * a * h / (std::f64::consts::PI * E_STAR * y);
        // next term: -(2a)^2/12/y^2 + 2 h^2/12/y^2 relative
        assert!((w[199] / point - 1.0).abs() < 2e-5, "{}", w[199] / point - 1.0);
        for width in [1e-9, 1e-6, 1e-3] {
            let w = influence_m_per_pa(width, h, 2000, E_STAR);
            assert!(w.windows(2).all(|p| p[0] > p[1] && p[1] > 0.0), "{width}");
            // closed form and quadrature meet
            for k in [NEAR, NEAR + 3] {
                let (c, y) = (2.0 * width / h, k as f64);
                let closed = phi(c, y + 1.0) - 2.0 * phi(c, y) + phi(c, y - 1.0);
                let closed = closed * c * h / (std::f64::consts::PI * E_STAR);
                assert!((w[k] / closed - 1.0).abs() < 3e-13, "{width} {k}: {}", w[k] / closed - 1.0);
            }
        }
    }

    #[test]
    fn eq_2_keeps_the_mean_deflection_of_a_uniform_load() {
        let s = 2.7e-7;
        let row = weighted_influence_m_per_n(&influence_m_per_pa(0.0929e-3, 0.1e-3, 60, E_STAR), s);
        let sum: f64 = (0..60).flat_map(|j: usize| (0..60).map(move |k| j.abs_diff(k))).map(|d| row[d]).sum();
        // q = 1 on each slice: mean(Delta) = s
        assert!((sum / 60.0 / s - 1.0).abs() < 1e-12);
    }
}
