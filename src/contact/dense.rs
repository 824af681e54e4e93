//! A dense symmetric system with two right sides: scattered slices have no Toeplitz matrix.

/// Solutions of `S x = b` for each of the two `right` sides, S symmetric, `n` by `n`, with the given entries: Cholesky,
/// and a factor that takes indefinite matrices where roundings have made S one.
#[cfg(feature = "faer")]
pub(super) fn solve_dense(
    n: usize,
    entry: impl Fn(usize, usize) -> f64,
    right: [&[f64]; 2],
) -> [Vec<f64>; 2] {
    use faer::linalg::solvers::Solve;
    use faer::{Mat, Side};
    let matrix = Mat::from_fn(n, n, entry);
    let right = Mat::from_fn(n, 2, |j, k| right[k][j]);
    let solved = match matrix.llt(Side::Lower) {
        Ok(factor) => factor.solve(&right),
        Err(_) => matrix.lblt(Side::Lower).solve(&right),
    };
    [0, 1].map(|column| (0..n).map(|j| solved[(j, column)]).collect())
}

/// The same without faer. A matrix that no factor takes gives NaN.
#[cfg(not(feature = "faer"))]
pub(super) fn solve_dense(
    n: usize,
    entry: impl Fn(usize, usize) -> f64,
    right: [&[f64]; 2],
) -> [Vec<f64>; 2] {
    let matrix = nalgebra::DMatrix::from_fn(n, n, entry);
    let right = nalgebra::DMatrix::from_fn(n, 2, |j, k| right[k][j]);
    let solved = match matrix.clone().cholesky() {
        Some(factor) => Some(factor.solve(&right)),
        None => matrix.lu().solve(&right),
    };
    let solved = solved.unwrap_or_else(|| nalgebra::DMatrix::from_element(n, 2, f64::NAN));
    [0, 1].map(|column| (0..n).map(|j| solved[(j, column)]).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn definite_and_indefinite_matrices_are_solved() {
        let falling = |j: usize, k: usize| 1.0 / (1.0 + j.abs_diff(k) as f64);
        let indefinite = |j: usize, k: usize| if j == k { 0.0 } else { falling(j, k) };
        for entry in [&falling as &dyn Fn(usize, usize) -> f64, &indefinite] {
            let n = 40;
            let right: [Vec<f64>; 2] = [vec![1.0; n], (0..n).map(|j| (j as f64).sin()).collect()];
            let solved = solve_dense(n, entry, [&right[0], &right[1]]);
            for (x, b) in solved.iter().zip(&right) {
                for (j, b) in b.iter().enumerate() {
                    let sum: f64 = x.iter().enumerate().map(|(k, x)| entry(j, k) * x).sum();
                    assert!((sum - b).abs() < 1e-11, "{j}: {sum} {b}");
                }
            }
        }
    }
}
