//! The box of the variables, scaled to [0, 1].

use super::Refusal;

/// Box lo <= x <= hi and its scaling u = (x - lo)/(hi - lo), anchored so that the start is met to the bit.
#[derive(Debug, Clone)]
pub(super) struct Space {
    lo: Vec<f64>,
    hi: Vec<f64>,
    x0: Vec<f64>,
    u0: Vec<f64>,
}

impl Space {
    /// # Errors
    /// [`Refusal`] for lengths that differ, bounds that are not finite or cross, a start outside the box.
    pub fn new(x0: &[f64], lo: &[f64], hi: &[f64]) -> Result<Self, Refusal> {
        if lo.len() != x0.len() || hi.len() != x0.len() || x0.is_empty() {
            return Err(Refusal::Lengths { x0: x0.len(), lo: lo.len(), hi: hi.len() });
        }
        for (variable, ((&x, &l), &h)) in x0.iter().zip(lo).zip(hi).enumerate() {
            if !(l.is_finite() && h.is_finite() && l <= h) {
                return Err(Refusal::Bounds { variable, lo: l, hi: h });
            }
            if !(l..=h).contains(&x) {
                return Err(Refusal::StartOutside { variable, x, lo: l, hi: h });
            }
        }
        let u0 = (0..x0.len())
            .map(|i| if hi[i] > lo[i] { (x0[i] - lo[i]) / (hi[i] - lo[i]) } else { 0.0 })
            .collect();
        Ok(Space { lo: lo.to_vec(), hi: hi.to_vec(), x0: x0.to_vec(), u0 })
    }

    pub fn start(&self) -> Vec<f64> {
        self.u0.clone()
    }

    /// Number of variables.
    pub fn len(&self) -> usize {
        self.lo.len()
    }

    /// Variables whose bounds differ.
    pub fn free(&self) -> Vec<usize> {
        (0..self.len()).filter(|&i| self.hi[i] > self.lo[i]).collect()
    }

    /// Unscaled point: exact at the start and at both bounds, inside the box everywhere.
    pub fn unscaled(&self, u: &[f64]) -> Vec<f64> {
        (0..self.len())
            .map(|i| {
                let (lo, hi) = (self.lo[i], self.hi[i]);
                if u[i] <= 0.0 {
                    lo
                } else if u[i] >= 1.0 {
                    hi
                } else {
                    (self.x0[i] + (u[i] - self.u0[i]) * (hi - lo)).clamp(lo, hi)
                }
            })
            .collect()
    }

    /// Scaled point of an unscaled one.
    pub fn scaled(&self, x: &[f64]) -> Vec<f64> {
        (0..self.len())
            .map(|i| {
                if self.hi[i] > self.lo[i] {
                    (self.u0[i] + (x[i] - self.x0[i]) / (self.hi[i] - self.lo[i])).clamp(0.0, 1.0)
                } else {
                    0.0
                }
            })
            .collect()
    }
}
