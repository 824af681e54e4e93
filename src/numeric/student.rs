//! Quantiles of Student's t distribution.

use std::f64::consts::FRAC_PI_2;

use super::quadrature::integral;
use super::root;

/// t for which |T| <= t with probability `confidence` in (0, 1), T with `freedom` >= 1 degrees of freedom; `None`
/// outside these ranges.
///
/// With t = sqrt(nu) tan(theta) the density is proportional to cos^(nu - 1)(theta).
pub fn two_sided(confidence: f64, freedom: usize) -> Option<f64> {
    if !(confidence > 0.0 && confidence < 1.0) || freedom == 0 {
        return None;
    }
    let nu = freedom as f64;
    // The mass lies within some 1/sqrt(nu); pieces shrink with it.
    let step = (0.5 / nu.sqrt()).min(0.2);
    let mass = |to: f64| {
        let pieces = (to / step).ceil().max(1.0) as usize;
        let width = to / pieces as f64;
        let piece = |i: usize| integral(i as f64 * width, (i + 1) as f64 * width, |t| t.cos().powf(nu - 1.0));
        (0..pieces).map(piece).sum::<f64>()
    };
    let whole = mass(FRAC_PI_2);
    let miss = |theta: f64| mass(theta) / whole - confidence;
    let theta = root::bracketed(0.0, FRAC_PI_2, -confidence, 1.0 - confidence, 1e-14, miss)?;
    Some(nu.sqrt() * theta.tan())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_the_tables() {
        // Abramowitz & Stegun, table 26.10; the last is the normal distribution's to 1e-4.
        for (freedom, want) in
            [(1, 12.706), (2, 4.303), (5, 2.571), (10, 2.228), (30, 2.042), (100_000, 1.960)]
        {
            let t = two_sided(0.95, freedom).unwrap();
            assert!((t - want).abs() < 6e-4, "{freedom}: {t}");
        }
        assert!((two_sided(0.99, 9).unwrap() - 3.250).abs() < 6e-4);
        for none in [two_sided(0.95, 0), two_sided(1.0, 3), two_sided(f64::NAN, 3)] {
            assert_eq!(none, None);
        }
    }
}
