//! Probability that an engagement slips, where friction and torque scatter.
//!
//! mu_s and the torque are lognormal about their means, independent of one another: both are products of many causes, and
//! neither falls below 0. An engagement at torque C slips where mu_s < mu_req(C), the larger of tan omega and tan nu:
//!
//!   P = integral phi(z) Phi((ln mu_req(C(z)) - ln m)/s) dz,   C(z) = c exp(q z),
//!
//! with medians m, c = mean/sqrt(1 + v^2) and s, q = sqrt(ln(1 + v^2)) of the coefficients of variation v. The idea is
//! Nagler's and Lohrengel's (2021): slip of a freewheel is a matter of the friction's distribution.

use crate::numeric::quadrature::integral;
use std::f64::consts::{PI, SQRT_2};

/// Median over mean, and the standard deviation of the logarithm, of a lognormal number with coefficient of variation `v`.
fn lognormal(v: f64) -> (f64, f64) {
    let square = 1.0 + v * v;
    (1.0 / square.sqrt(), square.ln().sqrt())
}

/// Standard normal distribution function.
fn below(x: f64) -> f64 {
    0.5 * libm::erfc(-x / SQRT_2)
}

/// Standard deviations beyond which nothing is integrated: 1e-15 lies there.
const FAR: f64 = 8.0;
/// Pieces of that range.
const PIECES: usize = 128;

/// Probability of slip, `friction` and `torque_nm` being means, (friction, torque) `scatter` coefficients of variation, that of
/// friction above 0. `required`: mu_req at a torque, infinite where the torque is not carried.
pub fn probability(friction: f64, torque_nm: f64, scatter: [f64; 2], required: impl Fn(f64) -> f64) -> f64 {
    let ([of_friction, s], [of_torque, q]) =
        (<[f64; 2]>::from(lognormal(scatter[0])), <[f64; 2]>::from(lognormal(scatter[1])));
    let median = friction * of_friction;
    let slips = |torque: f64| below((required(torque) / median).ln() / s);
    if q == 0.0 {
        return slips(torque_nm);
    }
    let density = |z: f64| (-0.5 * z * z).exp() / (2.0 * PI).sqrt();
    let at = |z: f64| density(z) * slips(torque_nm * of_torque * (q * z).exp());
    let width = 2.0 * FAR / PIECES as f64;
    let piece = |i: usize| {
        let from = -FAR + i as f64 * width;
        integral(from, from + width, at)
    };
    (0..PIECES).map(piece).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_has_a_closed_form() {
        // mu_req = a C^n: ln mu_req - ln mu is normal, so P = Phi(mean/deviation).
        let (a, n, friction, torque) = (0.02, 0.3, 0.12, 200.0);
        for scatter in [[0.1, 0.2], [0.02, 0.3], [0.3, 0.0]] {
            let found = probability(friction, torque, scatter, |c| a * c.powf(n));
            let ([of_mu, s], [of_c, q]) =
                (<[f64; 2]>::from(lognormal(scatter[0])), <[f64; 2]>::from(lognormal(scatter[1])));
            let mean = (a * (torque * of_c).powf(n) / (friction * of_mu)).ln();
            let want = below(mean / s.hypot(n * q));
            assert!((found - want).abs() < 1e-12 + 1e-9 * want, "{scatter:?}: {found} {want}");
        }
        assert!((below(1.96) - 0.975_002_104_851_779_5).abs() < 1e-15);
        assert_eq!(probability(0.1, 10.0, [0.1, 0.0], |_| f64::INFINITY), 1.0);
    }

    #[test]
    fn the_distribution_has_the_mean_and_deviation_asked_for() {
        let v = 0.2;
        let (median, s) = lognormal(v);
        let mean = median * (0.5 * s * s).exp();
        let deviation = mean * ((s * s).exp() - 1.0).sqrt();
        assert!((mean - 1.0).abs() < 1e-15 && (deviation - v).abs() < 1e-15);
    }
}
