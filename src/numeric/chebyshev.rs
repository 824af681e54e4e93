//! Chebyshev interpolation of a smooth function on an interval.

use std::f64::consts::PI;

/// Interpolant sum_k c_k T_k(t), t = (2x - a - b)/(b - a), with its exact derivative.
///
/// For a function analytic in the ellipse of parameter rho about `[a, b]` the error falls as
/// rho^-degree (Trefethen, *Approximation Theory and Approximation Practice*, theorem 8.2).
/// Outside `[a, b]` the polynomial runs away: the caller clamps.
#[derive(Debug, Clone, PartialEq)]
pub struct Chebyshev {
    a: f64,
    b: f64,
    value: Vec<f64>,
    slope: Vec<f64>,
}

impl Chebyshev {
    /// Interpolates `f` in the `degree + 1` Chebyshev points of the first kind of `[a, b]`, a < b.
    pub fn fit(a: f64, b: f64, degree: usize, f: impl Fn(f64) -> f64) -> Self {
        let count = degree + 1;
        let angle = |j: usize| PI * (j as f64 + 0.5) / count as f64;
        let samples: Vec<f64> =
            (0..count).map(|j| f(0.5 * (a + b) + 0.5 * (b - a) * angle(j).cos())).collect();
        let mut value: Vec<f64> = (0..count)
            .map(|k| {
                let sum: f64 = samples.iter().enumerate().map(|(j, s)| s * (k as f64 * angle(j)).cos()).sum();
                2.0 * sum / count as f64
            })
            .collect();
        value[0] *= 0.5;
        // d_{k-1} = d_{k+1} + 2 k c_k downwards, d_0 halved; dt/dx = 2/(b - a).
        let mut slope = vec![0.0; count + 1];
        for k in (1..count).rev() {
            slope[k - 1] = slope[k + 1] + 2.0 * k as f64 * value[k];
        }
        slope[0] *= 0.5;
        slope.truncate(degree.max(1));
        slope.iter_mut().for_each(|d| *d *= 2.0 / (b - a));
        Self { a, b, value, slope }
    }

    /// Ends `(a, b)` of the interval.
    pub fn interval(&self) -> (f64, f64) {
        (self.a, self.b)
    }

    /// Value of the interpolant at `x` in `[a, b]`.
    pub fn eval(&self, x: f64) -> f64 {
        clenshaw(&self.value, self.local(x))
    }

    /// Derivative of the interpolant (not of the function) at `x` in `[a, b]`.
    pub fn derivative(&self, x: f64) -> f64 {
        clenshaw(&self.slope, self.local(x))
    }

    fn local(&self, x: f64) -> f64 {
        (2.0 * x - self.a - self.b) / (self.b - self.a)
    }
}

/// sum_k c_k T_k(t) by Clenshaw's recurrence.
fn clenshaw(coefficients: &[f64], t: f64) -> f64 {
    let (mut b1, mut b2) = (0.0, 0.0);
    for c in coefficients.iter().skip(1).rev() {
        (b1, b2) = (2.0 * t * b1 - b2 + c, b1);
    }
    coefficients.first().copied().unwrap_or(0.0) + t * b1 - b2
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_is_exact_with_its_derivative() {
        let p = Chebyshev::fit(-1.0, 4.0, 3, |x| 2.0 * x * x * x - x + 5.0);
        for x in [-1.0, 0.3, 2.7, 4.0] {
            assert!((p.eval(x) - (2.0 * x * x * x - x + 5.0)).abs() < 1e-12);
            assert!((p.derivative(x) - (6.0 * x * x - 1.0)).abs() < 1e-11);
        }
    }

    #[test]
    fn a_constant_has_no_slope() {
        let p = Chebyshev::fit(0.0, 1.0, 0, |_| 3.5);
        assert_eq!((p.eval(0.2), p.derivative(0.2)), (3.5, 0.0));
    }

    #[test]
    fn error_falls_at_the_rate_of_the_nearest_singularity() {
        // 1/(1 + x^2) on [-1, 1]: poles at +-i, rho = 1 + sqrt 2.
        let error = |degree| {
            let p = Chebyshev::fit(-1.0, 1.0, degree, |x| 1.0 / (1.0 + x * x));
            (0..=200).fold(0.0f64, |worst, i| {
                let x = -1.0 + 0.01 * i as f64;
                worst.max((p.eval(x) - 1.0 / (1.0 + x * x)).abs())
            })
        };
        let rate = (error(20) / error(32)).powf(1.0 / 12.0);
        assert!((rate - (1.0 + 2.0f64.sqrt())).abs() < 0.05, "{rate}");
    }
}
