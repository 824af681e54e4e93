//! Eigenvalues of a small general matrix, in a number of sweeps that ends.

use nalgebra::linalg::balancing::balance_parlett_reinsch;
use nalgebra::{Complex, DMatrix, Schur};

/// Sweeps before a matrix is given up: some ten an eigenvalue are usual.
const MOST_SWEEPS: usize = 1000;

/// Eigenvalues of a square matrix. One whose entries differ by many orders of magnitude may not come to an end as it is; it is
/// then balanced first. `None` where the matrix is not finite, or both fail.
pub fn eigenvalues(matrix: DMatrix<f64>) -> Option<Vec<Complex<f64>>> {
    if matrix.iter().any(|x| !x.is_finite()) {
        return None;
    }
    let schur = Schur::try_new(matrix.clone(), f64::EPSILON, MOST_SWEEPS).or_else(|| {
        let mut balanced = matrix;
        balance_parlett_reinsch(&mut balanced);
        Schur::try_new(balanced, f64::EPSILON, MOST_SWEEPS)
    })?;
    Some(schur.complex_eigenvalues().iter().copied().collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_of_all_sizes_come_to_an_end() {
        // A companion matrix of (x + 1)(x + 1e6)(x + 1e12), and a swing of 1e9 beside a decay of 1e14.
        let companion = DMatrix::from_row_slice(
            3,
            3,
            &[0.0, 1.0, 0.0, 0.0, 0.0, 1.0, -1e18, -1.000001000001e18, -1.000001000001e12],
        );
        let swing = DMatrix::from_row_slice(3, 3, &[0.0, 1.0, 0.0, -1e18, -1e3, -1e18, -1e14, 1e2, -1e14]);
        for matrix in [companion, swing] {
            let trace = matrix.trace();
            let sum: Complex<f64> = eigenvalues(matrix).unwrap().iter().sum();
            assert!(
                (sum.re / trace - 1.0).abs() < 1e-9 && sum.im.abs() < 1e-9 * trace.abs(),
                "{sum} {trace}"
            );
        }
        assert_eq!(eigenvalues(DMatrix::from_element(2, 2, f64::NAN)), None);
    }
}
