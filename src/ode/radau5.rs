//! Radau IIA of order 5 with simplified Newton iterations: for components far faster than the step.
//!
//! Hairer, Wanner, *Solving Ordinary Differential Equations II*, IV.5 and IV.8. L-stable: what is faster than the
//! step and smaller than the tolerance is damped, not followed.

use super::rhs::RightHandSide;
use super::step::{Counters, Tolerance};
use nalgebra::{Complex, Const, DimMin, LU, SMatrix, SVector};

const S6: f64 = 2.449_489_742_783_178;
/// Nodes.
const C: [f64; 3] = [(4.0 - S6) / 10.0, (4.0 + S6) / 10.0, 1.0];
/// Weights of the error estimate, order 3.
const E: [f64; 3] = [(-13.0 - 7.0 * S6) / 3.0, (-13.0 + 7.0 * S6) / 3.0, -1.0 / 3.0];
/// Eigenvalues of A^-1: 3 + 3^(2/3) - 3^(1/3) and its complex companions.
const MU_REAL: f64 = 3.637_834_252_744_496;
const MU_COMPLEX: Complex<f64> = Complex::new(2.681_082_873_627_752_3, -3.050_430_199_247_411);
/// Eigenvectors, A^-1 = T diag T^-1 in real form.
const T: [[f64; 3]; 3] = [
    [0.094_438_762_488_975_24, -0.141_255_295_020_954_21, 0.030_029_194_105_147_42],
    [0.250_213_122_965_333_32, 0.204_129_352_293_799_94, -0.382_942_112_757_261_92],
    [1.0, 1.0, 0.0],
];
const T_INVERSE: [[f64; 3]; 3] = [
    [4.178_718_591_551_904_28, 0.327_682_820_761_062_37, 0.523_376_445_499_449_51],
    [-4.178_718_591_551_904_28, -0.327_682_820_761_062_37, 0.476_623_554_500_550_44],
    [0.502_872_634_945_786_82, -2.571_926_949_855_605_22, 0.596_039_204_828_224_92],
];
/// Collocation polynomial: y(t + x h) = y + sum_j x^(j+1) sum_i P[i][j] z_i.
const P: [[f64; 3]; 3] = [
    [13.0 / 3.0 + 7.0 * S6 / 3.0, -23.0 / 3.0 - 22.0 * S6 / 3.0, 10.0 / 3.0 + 5.0 * S6],
    [13.0 / 3.0 - 7.0 * S6 / 3.0, -23.0 / 3.0 + 22.0 * S6 / 3.0, 10.0 / 3.0 - 5.0 * S6],
    [1.0 / 3.0, -8.0 / 3.0, 10.0 / 3.0],
];
const ITERATIONS: u32 = 7;
/// Convergence rate below which the Jacobian serves once more.
const GOOD_RATE: f64 = 1e-3;

/// One step with its collocation polynomial.
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
    /// Weighted error; at most 1 for a step to be accepted.
    pub error: f64,
    /// Newton iterations.
    pub iterations: u32,
    powers: [[f64; N]; 3],
}

impl<const N: usize> Step<N> {
    /// Room for one.
    pub fn new() -> Self {
        let zero = [0.0; N];
        Self { t: 0.0, h: 0.0, y0: zero, y1: zero, error: f64::NAN, iterations: 0, powers: [zero; 3] }
    }
}

impl<const N: usize> Default for Step<N> {
    fn default() -> Self {
        Self::new()
    }
}

/// What is kept from step to step of one smooth right-hand side.
#[derive(Debug, Clone)]
pub struct Radau<const N: usize>
where
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
{
    jacobian: SMatrix<f64, N, N>,
    /// Whether the Jacobian belongs to this right-hand side, and to this very point.
    known: bool,
    fresh: bool,
    factors: Option<Factors<N>>,
    last: Option<Step<N>>,
}

type Real<const N: usize> = LU<f64, Const<N>, Const<N>>;
type Imaginary<const N: usize> = LU<Complex<f64>, Const<N>, Const<N>>;

#[derive(Debug, Clone)]
struct Factors<const N: usize>
where
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
{
    h: f64,
    real: Real<N>,
    complex: Imaginary<N>,
}

impl<const N: usize> Radau<N>
where
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
{
    /// Nothing known yet.
    pub fn new() -> Self {
        Self { jacobian: SMatrix::zeros(), known: false, fresh: false, factors: None, last: None }
    }

    /// The right-hand side has changed.
    pub fn forget(&mut self) {
        (self.known, self.fresh, self.factors, self.last) = (false, false, None, None);
    }

    /// df/dy at the last point where it was taken.
    pub fn jacobian(&self) -> &SMatrix<f64, N, N> {
        &self.jacobian
    }

    /// Jacobian by one-sided differences of sqrt(eps) times the size of each component, at least `floor`.
    ///
    /// # Errors
    /// Those of the right-hand side.
    pub fn differentiate<R: RightHandSide<N>>(
        &mut self,
        rhs: &mut R,
        t: f64,
        y: &[f64; N],
        slope: &[f64; N],
        floor: f64,
        counters: &mut Counters,
    ) -> Result<(), R::Failure> {
        let mut z = *y;
        for j in 0..N {
            z[j] = y[j] + f64::EPSILON.sqrt() * y[j].abs().max(floor);
            let step = z[j] - y[j];
            let shifted = rhs.slope(t, &z)?;
            counters.rhs_evaluations += 1;
            for i in 0..N {
                self.jacobian[(i, j)] = (shifted[i] - slope[i]) / step;
            }
            z[j] = y[j];
        }
        counters.jacobians += 1;
        (self.known, self.fresh, self.factors) = (true, true, None);
        Ok(())
    }

    /// Largest magnitude among the eigenvalues of the Jacobian, 1/s; `None` where they were not found.
    pub fn fastest(&self) -> Option<f64> {
        // Balance first: angles and their rates differ by the frequency itself.
        let mut a = self.jacobian;
        for _ in 0..8 {
            for i in 0..N {
                let (mut row, mut column) = (0.0, 0.0);
                for j in (0..N).filter(|&j| j != i) {
                    row += a[(i, j)].abs();
                    column += a[(j, i)].abs();
                }
                if row > 0.0 && column > 0.0 {
                    let f = (row / column).sqrt();
                    for j in 0..N {
                        a[(i, j)] /= f;
                        a[(j, i)] *= f;
                    }
                }
            }
        }
        // The square root of ||A^2|| bounds the spectral radius and is sharp for pairs of one frequency.
        let bound = (a * a).norm().sqrt();
        bound.is_finite().then_some(bound)
    }

    /// |lambda| of the fastest eigenvalue that `slope` excites (1/s) and the part of `slope` in its directions: powers
    /// of J^2, whose eigenvalue is real (-omega^2 of an oscillation), leave that part alone. `None` where nothing moves.
    pub fn fast_part(&self, slope: &[f64; N]) -> Option<(f64, [f64; N])> {
        const POWERS: i32 = 12;
        let bound = self.fastest().filter(|b| *b > 0.0)?;
        let squared = (self.jacobian / bound) * (self.jacobian / bound);
        let mut part = SVector::<f64, N>::from_column_slice(slope);
        for _ in 0..POWERS {
            part = squared * part;
        }
        let ratio = (squared * part).dot(&part) / part.norm_squared();
        let scaled = part / ratio.powi(POWERS);
        let rate = bound * ratio.abs().sqrt();
        let finite = rate > 0.0 && rate.is_finite() && scaled.iter().all(|v| v.is_finite());
        finite.then(|| (rate, std::array::from_fn(|i| scaled[i])))
    }

    /// One trial step; `None` where Newton's iteration does not converge or leaves the domain: shorten the step.
    pub fn step<R: RightHandSide<N>>(
        &mut self,
        rhs: &mut R,
        t: f64,
        y: &[f64; N],
        slope: &[f64; N],
        h: f64,
        tolerance: &Tolerance<N>,
        floor: f64,
        counters: &mut Counters,
    ) -> Option<Step<N>> {
        if !self.known {
            self.differentiate(rhs, t, y, slope, floor, counters).ok()?;
        }
        let scale: [f64; N] =
            std::array::from_fn(|i| tolerance.scale(i, y[i], y[i]) + tolerance.integrated[i] / h);
        loop {
            if self.factors.as_ref().is_none_or(|f| f.h != h) {
                self.factorise(h, counters);
            }
            if let Some((z, iterations, rate)) = self.solve(rhs, t, y, h, tolerance, &scale, counters) {
                let step = self.finish(rhs, t, y, slope, h, tolerance, z, iterations, counters)?;
                if step.error <= 1.0 {
                    self.known = iterations <= 2 || rate < GOOD_RATE;
                    self.fresh = false;
                    self.last = Some(step.clone());
                }
                return Some(step);
            }
            if self.fresh {
                return None;
            }
            self.differentiate(rhs, t, y, slope, floor, counters).ok()?;
        }
    }

    fn factorise(&mut self, h: f64, counters: &mut Counters) {
        let mut real = -self.jacobian;
        let mut complex = self.jacobian.map(|v| Complex::new(-v, 0.0));
        for i in 0..N {
            real[(i, i)] += MU_REAL / h;
            complex[(i, i)] += MU_COMPLEX / h;
        }
        counters.factorisations += 1;
        self.factors = Some(Factors { h, real: real.lu(), complex: complex.lu() });
    }

    /// Stage increments z, iterations, convergence rate.
    fn solve<R: RightHandSide<N>>(
        &self,
        rhs: &mut R,
        t: f64,
        y: &[f64; N],
        h: f64,
        tolerance: &Tolerance<N>,
        scale: &[f64; N],
        counters: &mut Counters,
    ) -> Option<([[f64; N]; 3], u32, f64)> {
        let factors = self.factors.as_ref()?;
        // Start on the last step's polynomial, continued.
        let mut z = [[0.0; N]; 3];
        if let Some(last) = self.last.as_ref().filter(|l| (l.t + l.h - t).abs() <= 1e-9 * h && h < 8.0 * l.h)
        {
            for (z, c) in z.iter_mut().zip(C) {
                let ahead = last.at(t + c * h);
                *z = std::array::from_fn(|i| ahead[i] - last.y1[i]);
            }
        }
        let mut w: [[f64; N]; 3] =
            T_INVERSE.map(|row| std::array::from_fn(|i| (0..3).map(|s| row[s] * z[s][i]).sum()));
        let target = (10.0 * f64::EPSILON / tolerance.relative).max(tolerance.relative.sqrt().min(0.03));
        let (mut before, mut rate) = (f64::INFINITY, 0.0);
        for iteration in 1..=ITERATIONS {
            let mut f = [[0.0; N]; 3];
            for s in 0..3 {
                let at: [f64; N] = std::array::from_fn(|i| y[i] + z[s][i]);
                f[s] = rhs.slope(t + C[s] * h, &at).ok()?;
                counters.rhs_evaluations += 1;
            }
            let mixed = |row: usize, i: usize| (0..3).map(|s| T_INVERSE[row][s] * f[s][i]).sum::<f64>();
            let mut real = SVector::<f64, N>::from_fn(|i, _| mixed(0, i) - MU_REAL / h * w[0][i]);
            let mut complex = SVector::<Complex<f64>, N>::from_fn(|i, _| {
                Complex::new(mixed(1, i), mixed(2, i)) - MU_COMPLEX / h * Complex::new(w[1][i], w[2][i])
            });
            if !factors.real.solve_mut(&mut real) || !factors.complex.solve_mut(&mut complex) {
                return None;
            }
            let mut size = 0.0;
            for i in 0..N {
                for d in [real[i], complex[i].re, complex[i].im] {
                    size += (d / scale[i]).powi(2);
                }
                w[0][i] += real[i];
                w[1][i] += complex[i].re;
                w[2][i] += complex[i].im;
            }
            size = (size / (3 * N) as f64).sqrt();
            if !size.is_finite() {
                return None;
            }
            for s in 0..3 {
                z[s] = std::array::from_fn(|i| (0..3).map(|m| T[s][m] * w[m][i]).sum());
            }
            if iteration > 1 {
                rate = size / before;
                let left = (ITERATIONS - iteration) as i32;
                if rate >= 1.0 && size > target || rate.powi(left) / (1.0 - rate.min(0.999)) * size > target {
                    return None;
                }
            }
            if size == 0.0 || iteration > 1 && rate.min(0.999) / (1.0 - rate.min(0.999)) * size < target {
                return Some((z, iteration, rate));
            }
            before = size;
        }
        None
    }

    fn finish<R: RightHandSide<N>>(
        &self,
        rhs: &mut R,
        t: f64,
        y: &[f64; N],
        slope: &[f64; N],
        h: f64,
        tolerance: &Tolerance<N>,
        z: [[f64; N]; 3],
        iterations: u32,
        counters: &mut Counters,
    ) -> Option<Step<N>> {
        let factors = self.factors.as_ref()?;
        let y1: [f64; N] = std::array::from_fn(|i| y[i] + z[2][i]);
        let ze: [f64; N] = std::array::from_fn(|i| (0..3).map(|s| E[s] * z[s][i]).sum::<f64>() / h);
        let size = |e: &SVector<f64, N>| {
            let sum: f64 = (0..N)
                .map(|i| (e[i] / (tolerance.scale(i, y[i], y1[i]) + tolerance.integrated[i] / h)).powi(2))
                .sum();
            (sum / N as f64).sqrt()
        };
        let mut e = SVector::<f64, N>::from_fn(|i, _| slope[i] + ze[i]);
        factors.real.solve_mut(&mut e);
        let mut error = size(&e);
        if error > 1.0 {
            // Filtered once more: bounded where h lambda is large.
            let at: [f64; N] = std::array::from_fn(|i| y[i] + e[i]);
            let again = rhs.slope(t, &at).ok()?;
            counters.rhs_evaluations += 1;
            e = SVector::<f64, N>::from_fn(|i, _| again[i] + ze[i]);
            factors.real.solve_mut(&mut e);
            error = size(&e);
        }
        let powers =
            std::array::from_fn(|j| std::array::from_fn(|i| (0..3).map(|s| P[s][j] * z[s][i]).sum()));
        error.is_finite().then_some(Step { t, h, y0: *y, y1, error, iterations, powers })
    }
}

impl<const N: usize> Default for Radau<N>
where
    Const<N>: DimMin<Const<N>, Output = Const<N>>,
{
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize> Step<N> {
    /// Next step length after this one, accepted or not; lengths that would hardly change are kept, because a new
    /// one costs a factorisation.
    pub fn next_h(&self) -> f64 {
        let most = f64::from(2 * ITERATIONS + 1);
        let safety = 0.9 * most / (most - 1.0 + f64::from(self.iterations));
        let factor = (safety * self.error.max(1e-12).powf(-0.25)).clamp(0.2, 8.0);
        if self.error <= 1.0 && (1.0..1.2).contains(&factor) { self.h } else { self.h * factor }
    }

    /// The collocation polynomial at time `t`.
    pub fn at(&self, t: f64) -> [f64; N] {
        self.after(t - self.t)
    }

    /// The collocation polynomial `elapsed` (s) after the start.
    pub fn after(&self, elapsed: f64) -> [f64; N] {
        let x = elapsed / self.h;
        let p = &self.powers;
        std::array::from_fn(|i| self.y0[i] + x * (p[0][i] + x * (p[1][i] + x * p[2][i])))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOLERANCE: Tolerance<3> =
        Tolerance { relative: 1e-8, absolute: [1e-8; 3], integrated: [0.0; 3], datum: [0.0; 3] };

    /// y'' = -y, and a third component on a stiff spring to a known motion: y3' = -k (y3 - cos t) - sin t.
    fn rhs(k: f64) -> impl FnMut(f64, &[f64; 3]) -> Result<[f64; 3], ()> {
        move |t, y| Ok([y[1], -y[0] * (1.0 + 0.1 * (y[2] - t.cos())), -k * (y[2] - t.cos()) - t.sin()])
    }

    fn errors(n: usize, k: f64) -> f64 {
        let (mut radau, mut counters, mut f) = (Radau::new(), Counters::default(), rhs(k));
        let (mut t, mut y) = (0.0, [0.0, 1.0, 1.0]);
        let h = 2.0 / n as f64;
        for _ in 0..n {
            let slope = f(t, &y).unwrap();
            let s = radau.step(&mut f, t, &y, &slope, h, &TOLERANCE, 1e-3, &mut counters).expect("converges");
            for theta in [0.0, 0.3, 1.0] {
                let tt = t + theta * h;
                assert!((s.at(tt)[0] - tt.sin()).abs() < h.powi(4));
            }
            t += h;
            y = s.y1;
        }
        assert!(counters.rhs_evaluations > 0 && counters.factorisations > 0);
        (y[0] - t.sin()).abs().max((y[2] - t.cos()).abs())
    }

    #[test]
    fn observed_order_is_five() {
        let order = (errors(8, 3.0) / errors(32, 3.0)).log2() / 2.0;
        assert!((order - 5.0).abs() < 0.4, "{order}");
    }

    #[test]
    fn steps_far_longer_than_the_fastest_time_stay_accurate() {
        assert!(errors(32, 1e8) < 1e-8, "{:e}", errors(32, 1e8));
    }

    #[test]
    fn the_fastest_rate_is_found() {
        let (mut radau, mut counters, mut f) = (Radau::new(), Counters::default(), rhs(1e8));
        let y = [0.0, 1.0, 1.0];
        let slope = f(0.0, &y).unwrap();
        radau.differentiate(&mut f, 0.0, &y, &slope, 1e-3, &mut counters).unwrap();
        let fastest = radau.fastest().unwrap();
        assert!((0.9e8..1.2e8).contains(&fastest), "{fastest:e}");
        // Off its slow manifold by 1e-5, the third component alone moves at that rate.
        let y = [0.0, 1.0, 1.0 + 1e-5];
        let slope = f(0.0, &y).unwrap();
        let (rate, part) = radau.fast_part(&slope).unwrap();
        assert!(
            (rate / 1e8 - 1.0).abs() < 1e-3 && (part[2].abs() / rate / 1e-5 - 1.0).abs() < 1e-2,
            "{part:?}"
        );
    }
}
