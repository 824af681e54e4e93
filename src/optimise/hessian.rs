//! Quasi-Newton approximation of the Hessian of the Lagrangian, kept positive definite.

use nalgebra::{DMatrix, DVector};

/// BFGS update of B for step s and change of the Lagrangian's gradient y, damped where the curvature s'y falls
/// below a fifth of s'Bs (Powell 1978; Nocedal and Wright, *Numerical Optimization*, procedure 18.2).
pub(super) fn update(b: &mut DMatrix<f64>, s: &[f64], y: &[f64]) {
    let s = DVector::from_column_slice(s);
    let y = DVector::from_column_slice(y);
    let bs = &*b * &s;
    let sbs = s.dot(&bs);
    if !(sbs > 0.0 && sbs.is_finite()) {
        return;
    }
    let sy = s.dot(&y);
    let theta = if sy >= 0.2 * sbs { 1.0 } else { 0.8 * sbs / (sbs - sy) };
    let r = theta * y + (1.0 - theta) * &bs;
    let sr = s.dot(&r);
    let mut next = &*b - &bs * bs.transpose() / sbs + &r * r.transpose() / sr;
    next = 0.5 * (&next + next.transpose());
    if next.iter().all(|v| v.is_finite()) {
        *b = next;
    }
}

/// Scales rows and columns of B so that its diagonal meets the measured second derivatives, where these are positive.
pub(super) fn rescale(b: &mut DMatrix<f64>, bend: &[f64]) {
    let s: Vec<f64> = (0..bend.len())
        .map(|i| {
            if bend[i] > 0.0 && b[(i, i)] > 0.0 { (bend[i] / b[(i, i)]).sqrt().clamp(0.1, 10.0) } else { 1.0 }
        })
        .collect();
    *b = DMatrix::from_fn(bend.len(), bend.len(), |i, k| s[i] * b[(i, k)] * s[k]);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_convex_step_meets_the_secant_equation_and_a_concave_one_stays_positive() {
        let mut b = DMatrix::identity(2, 2);
        update(&mut b, &[1.0, 0.0], &[3.0, 1.0]);
        assert!((b[(0, 0)] - 3.0).abs() < 1e-14 && (b[(1, 0)] - 1.0).abs() < 1e-14);
        update(&mut b, &[0.3, 1.0], &[-5.0, -2.0]);
        assert!(b.clone().cholesky().is_some(), "{b}");
    }
}
