//! First-order forward differentiation: a value and its derivative along one direction.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// `v + d eps` with eps^2 = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dual {
    /// Value.
    pub v: f64,
    /// Derivative.
    pub d: f64,
}

impl Dual {
    /// The independent variable: derivative 1.
    pub fn variable(v: f64) -> Self {
        Self { v, d: 1.0 }
    }
    /// A constant: derivative 0.
    pub fn constant(v: f64) -> Self {
        Self { v, d: 0.0 }
    }
    /// f(self) from f's value and slope at `self.v`.
    pub fn chain(self, value: f64, slope: f64) -> Self {
        Self { v: value, d: slope * self.d }
    }
    /// Square root.
    pub fn sqrt(self) -> Self {
        let r = self.v.sqrt();
        self.chain(r, 0.5 / r)
    }
    /// Sine and cosine.
    pub fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.v.sin_cos();
        (self.chain(s, c), self.chain(c, -s))
    }
    /// Four-quadrant arc tangent of `self / x`.
    pub fn atan2(self, x: Self) -> Self {
        let r2 = self.v * self.v + x.v * x.v;
        Self { v: self.v.atan2(x.v), d: (self.d * x.v - self.v * x.d) / r2 }
    }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self { v: self.v + o.v, d: self.d + o.d }
    }
}
impl Sub for Dual {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self { v: self.v - o.v, d: self.d - o.d }
    }
}
impl Mul for Dual {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Self { v: self.v * o.v, d: self.d * o.v + self.v * o.d }
    }
}
impl Div for Dual {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        let v = self.v / o.v;
        Self { v, d: (self.d - v * o.d) / o.v }
    }
}
impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        Self { v: -self.v, d: -self.d }
    }
}
impl Add<f64> for Dual {
    type Output = Self;
    fn add(self, o: f64) -> Self {
        Self { v: self.v + o, d: self.d }
    }
}
impl Sub<f64> for Dual {
    type Output = Self;
    fn sub(self, o: f64) -> Self {
        Self { v: self.v - o, d: self.d }
    }
}
impl Mul<f64> for Dual {
    type Output = Self;
    fn mul(self, o: f64) -> Self {
        Self { v: self.v * o, d: self.d * o }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivative_of_a_composed_formula_is_the_analytic_one() {
        // f = sqrt(x) atan2(sin x, x^2 + 2) / (cos x - 3)
        let f = |x: Dual| {
            let (s, c) = x.sin_cos();
            x.sqrt() * s.atan2(x * x + 2.0) / (c - 3.0)
        };
        let x = 0.7;
        let h = 1e-5;
        let slope = (f(Dual::constant(x + h)).v - f(Dual::constant(x - h)).v) / (2.0 * h);
        assert!((f(Dual::variable(x)).d - slope).abs() < 1e-9);
    }
}
