//! Dormand-Prince of order 8(5,3) with step control and dense output of order 7.
//!
//! Hairer, Norsett, Wanner, *Solving Ordinary Differential Equations I*, II.5 and II.10.

use super::coefficients::{A, B, B_HAT, C, D, E};
use super::rhs::RightHandSide;
use super::step::{Counters, Tolerance};

/// One trial step from (t, y) over h.
#[derive(Debug, Clone)]
pub struct Step<const N: usize> {
    /// Start time.
    pub t: f64,
    /// Step length.
    pub h: f64,
    /// State at the start.
    pub y0: [f64; N],
    /// State at the end.
    pub y1: [f64; N],
    /// Weighted error.
    pub error: f64,
    stages: [[f64; N]; 12],
    slope1: [f64; N],
}

impl<const N: usize> Default for Step<N> {
    fn default() -> Self {
        Self::new()
    }
}

/// Where, as fractions of a step, its start, end and the stages between lie at which it is looked at. From the sixth stage
/// on states are good to order 5, sum_j a_ij c_j^(q-1) = c_i^q/q for q up to 5; the fourth, near the start, to order 3.
pub const PROBES: [f64; 7] = [0.0, C[3], C[6], C[5], C[9], C[10], 1.0];

/// Which of [`PROBES`] a stage is; 0 where it is none.
const LOOK_OF: [usize; 12] = [0, 0, 0, 1, 0, 3, 2, 0, 0, 4, 5, 0];

/// State at stage `STAGE`: y + h sum_j a_j k_j, unrolled, without the a_j that are zero.
#[inline(always)]
fn reached<const STAGE: usize, const N: usize>(
    y: &[f64; N],
    k: &[[f64; N]; 12],
    h: f64,
    used: usize,
) -> [f64; N] {
    let mut z = *y;
    for j in 0..STAGE {
        let a = A[STAGE - 1][j];
        if a != 0.0 {
            let ha = h * a;
            for i in 0..used.min(N) {
                z[i] += ha * k[j][i];
            }
        }
    }
    z
}

/// Weighted error that the next length aims at.
const AIM: f64 = 0.15;

/// Dense output of one step, order 7.
#[derive(Debug, Clone)]
pub struct Dense<const N: usize> {
    t: f64,
    h: f64,
    used: usize,
    coefficients: [[f64; N]; 8],
}

impl<const N: usize> Step<N> {
    /// Room for one.
    pub fn new() -> Self {
        let zero = [0.0; N];
        Self { t: 0.0, h: 0.0, y0: zero, y1: zero, error: f64::NAN, stages: [zero; 12], slope1: zero }
    }

    /// Take one step. `slope0` is f(t, y); the right-hand side may fail (`Err` is passed on). f at its end is known where
    /// its error is at most `most`.
    ///
    /// # Errors
    /// Those of the right-hand side; what is in `self` then is no step.
    pub fn take<R: RightHandSide<N>>(
        &mut self,
        rhs: &mut R,
        t: f64,
        y: &[f64; N],
        slope0: &[f64; N],
        h: f64,
        tolerance: &Tolerance<N>,
        most: f64,
        counters: &mut Counters,
    ) -> Result<(), R::Failure> {
        let used = rhs.used().min(N);
        let k = &mut self.stages;
        k[0] = *slope0;
        for stage in 1..12 {
            let z = match stage {
                1 => reached::<1, N>(y, k, h, used),
                2 => reached::<2, N>(y, k, h, used),
                3 => reached::<3, N>(y, k, h, used),
                4 => reached::<4, N>(y, k, h, used),
                5 => reached::<5, N>(y, k, h, used),
                6 => reached::<6, N>(y, k, h, used),
                7 => reached::<7, N>(y, k, h, used),
                8 => reached::<8, N>(y, k, h, used),
                9 => reached::<9, N>(y, k, h, used),
                10 => reached::<10, N>(y, k, h, used),
                _ => reached::<11, N>(y, k, h, used),
            };
            let at = t + C[stage] * h;
            k[stage] = match LOOK_OF[stage] {
                0 => rhs.slope(at, &z)?,
                probe => rhs.slope_at_probe(probe, at, &z)?,
            };
        }
        let mut y1 = *y;
        let (mut err5, mut err3) = (0.0, 0.0);
        let (mut increments, mut fifths) = ([0.0; N], [0.0; N]);
        for (j, k) in k.iter().enumerate().filter(|(j, _)| B[*j] != 0.0) {
            for i in 0..used {
                increments[i] += B[j] * k[i];
                fifths[i] += E[j] * k[i];
            }
        }
        for i in 0..used {
            let (increment, e5) = (increments[i], fifths[i]);
            y1[i] += h * increment;
            let e3 = increment - B_HAT[0] * k[0][i] - B_HAT[1] * k[8][i] - B_HAT[2] * k[11][i];
            let scale = tolerance.scale(i, y[i], y1[i]);
            err5 += (e5 / scale).powi(2);
            err3 += (e3 / scale).powi(2);
        }
        let blend = err5 + 0.01 * err3;
        let error = if blend > 0.0 { h.abs() * err5 / (blend * N as f64).sqrt() } else { 0.0 };
        counters.rhs_evaluations += 11;
        if error <= most {
            self.slope1 = rhs.slope_at_probe(PROBES.len() - 1, t + h, &y1)?;
            counters.rhs_evaluations += 1;
        }
        (self.t, self.h, self.y0, self.y1, self.error) = (t, h, *y, y1, error);
        Ok(())
    }

    /// f at the end of an accepted step, the first stage of the next.
    pub fn slope1(&self) -> &[f64; N] {
        &self.slope1
    }

    /// Next step length after this one, accepted or not.
    pub fn next_h(&self) -> f64 {
        let factor = if self.error > 0.0 && self.error.is_finite() {
            (AIM / self.error).sqrt().sqrt().sqrt().clamp(0.2, 5.0)
        } else if self.error == 0.0 {
            5.0
        } else {
            0.1
        };
        self.h * factor
    }

    /// Value at t + theta h by [`hermite`]: no extra evaluations, for a first probe only.
    pub fn glance(&self, theta: f64) -> [f64; N] {
        hermite(theta, self.h, [&self.y0, &self.y1], [&self.stages[0], &self.slope1])
    }

    /// Dense output of order 7 over the step (three more evaluations).
    pub fn dense<R: RightHandSide<N>>(
        &self,
        rhs: &mut R,
        counters: &mut Counters,
    ) -> Result<Dense<N>, R::Failure> {
        let used = rhs.used().min(N);
        let mut more = [self.slope1; 4];
        for extra in 1..4 {
            let mut z = self.y0;
            let known = self.stages.iter().chain(&more);
            for (k, &a) in known.zip(A[11 + extra]).filter(|(_, a)| **a != 0.0) {
                let ha = self.h * a;
                for i in 0..used {
                    z[i] += ha * k[i];
                }
            }
            more[extra] = rhs.slope(self.t + C[12 + extra] * self.h, &z)?;
        }
        counters.rhs_evaluations += 3;
        let mut c = [[0.0; N]; 8];
        let [from, difference, bulge, end, ..] = &mut c;
        for i in 0..used {
            from[i] = self.y0[i];
            difference[i] = self.y1[i] - self.y0[i];
            bulge[i] = self.h * self.stages[0][i] - difference[i];
            end[i] = difference[i] - self.h * self.slope1[i] - bulge[i];
        }
        for (c, d) in c[4..].iter_mut().zip(&D) {
            for (weight, k) in d.iter().zip(self.stages.iter().chain(&more)).filter(|(d, _)| **d != 0.0) {
                let weight = self.h * weight;
                for i in 0..used {
                    c[i] += weight * k[i];
                }
            }
        }
        Ok(Dense { t: self.t, h: self.h, used, coefficients: c })
    }
}

/// Cubic of Hermite at the fraction `theta` of a time `h` that goes from the first to the second of `y`, with these slopes there.
pub fn hermite<const N: usize>(theta: f64, h: f64, y: [&[f64; N]; 2], slopes: [&[f64; N]; 2]) -> [f64; N] {
    let (a, b) = (theta, 1.0 - theta);
    std::array::from_fn(|i| {
        let (m0, m1) = (h * slopes[0][i], h * slopes[1][i]);
        (1.0 + 2.0 * a) * b * b * y[0][i] + a * b * b * m0 + a * a * (3.0 - 2.0 * a) * y[1][i]
            - a * a * b * m1
    })
}

impl<const N: usize> Dense<N> {
    /// State at time `t` inside the step.
    pub fn at(&self, t: f64) -> [f64; N] {
        self.after(t - self.t)
    }

    /// State `elapsed` (s) after the start of the step.
    pub fn after(&self, elapsed: f64) -> [f64; N] {
        let s = elapsed / self.h;
        let s1 = 1.0 - s;
        let c = &self.coefficients;
        let mut y = [0.0; N];
        for i in 0..self.used.min(N) {
            let inner = c[4][i] + s * (c[5][i] + s1 * (c[6][i] + s * c[7][i]));
            y[i] = c[0][i] + s * (c[1][i] + s1 * (c[2][i] + s * (c[3][i] + s1 * inner)));
        }
        y
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// y'' = -y as a planted answer, with a time-dependent forcing that the nodes c_i must get right.
    fn rhs(t: f64, y: &[f64; 3]) -> Result<[f64; 3], ()> {
        Ok([y[1], -y[0], (2.0 * t).cos() * y[1]])
    }

    fn end_error(n: usize) -> (f64, f64) {
        let tolerance =
            Tolerance { relative: 1.0, absolute: [1.0; 3], integrated: [0.0; 3], datum: [0.0; 3] };
        let mut counters = Counters::default();
        let (mut t, mut y) = (0.0, [0.0, 1.0, 0.0]);
        let h = 2.0 / n as f64;
        let (mut s, mut dense_error) = (Step::new(), 0.0_f64);
        for _ in 0..n {
            let slope = rhs(t, &y).unwrap();
            s.take(&mut rhs, t, &y, &slope, h, &tolerance, 1.0, &mut counters).unwrap();
            let d = s.dense(&mut rhs, &mut counters).unwrap();
            for theta in [0.0, 0.21, 0.5, 0.83, 1.0] {
                let tt = t + theta * h;
                dense_error = dense_error.max((d.at(tt)[0] - tt.sin()).abs());
                assert!((s.glance(theta)[0] - tt.sin()).abs() < h.powi(4));
            }
            t += h;
            y = s.y1;
        }
        // third component: integral of cos(2t) cos(t).
        let third = |t: f64| 0.5 * t.sin() + (3.0 * t).sin() / 6.0;
        ((y[0] - t.sin()).abs().max((y[2] - third(t)).abs()), dense_error)
    }

    #[test]
    fn the_stages_that_are_looked_at_have_their_order() {
        for (stage, order) in [(3, 3), (6, 5), (5, 5), (9, 5), (10, 5)] {
            for q in 1..=order {
                let sum: f64 = A[stage - 1].iter().zip(C).map(|(a, c)| a * c.powi(q - 1)).sum();
                assert!((sum - C[stage].powi(q) / f64::from(q)).abs() < 2e-14, "stage {stage}, q {q}");
            }
        }
    }

    #[test]
    fn observed_orders_are_eight_and_seven() {
        let (coarse, dense_coarse) = end_error(4);
        let (fine, dense_fine) = end_error(16);
        let order = (coarse / fine).log2() / 2.0;
        let dense_order = (dense_coarse / dense_fine).log2() / 2.0;
        assert!((order - 8.0).abs() < 0.3, "order {order}: {coarse:e} {fine:e}");
        assert!(dense_order > 6.8, "dense order {dense_order}: {dense_coarse:e} {dense_fine:e}");
    }
}
