//! Symmetric positive definite Toeplitz systems.

/// Solutions x of T x = b for the columns b of `right`, T_jk = `first`[|j - k|], by Levinson's recursion
/// (Golub & Van Loan, *Matrix Computations*, 4.7.3): n^2 multiplications and additions for the matrix and 2 n^2
/// for each column, memory of order n. `None` where T is not positive definite to working accuracy or the
/// lengths differ.
pub fn solve_symmetric<const R: usize>(first: &[f64], right: [&[f64]; R]) -> Option<[Vec<f64>; R]> {
    let n = right.first().map_or(0, |b| b.len());
    let scale = *first.first()?;
    if first.len() < n || n == 0 || right.iter().any(|b| b.len() != n) || !(scale > 0.0 && scale.is_finite())
    {
        return None;
    }
    let r: Vec<f64> = first[1..n].iter().map(|t| t / scale).collect();
    let mut x = right.map(|b| {
        let mut column = Vec::with_capacity(n);
        column.push(b[0] / scale);
        column
    });
    // y solves the Yule-Walker system of the order reached, kept in reverse so that all loops run forward
    let mut y: Vec<f64> = Vec::with_capacity(n);
    let mut y_reversed = Vec::with_capacity(n);
    let (mut beta, mut alpha) = (1.0, 0.0);
    for k in 1..n {
        alpha = if k == 1 { -r[0] } else { alpha };
        if k == 1 {
            y.push(alpha);
        }
        beta *= (1.0 - alpha) * (1.0 + alpha);
        if beta.is_nan() || beta <= 0.0 {
            return None;
        }
        y_reversed.clear();
        y_reversed.extend(y.iter().rev());
        for (column, b) in x.iter_mut().zip(&right) {
            let mu = (b[k] / scale - dot_reversed(&r[..k], column)) / beta;
            column.iter_mut().zip(&y_reversed).for_each(|(x, y)| *x += mu * y);
            column.push(mu);
        }
        if k + 1 < n {
            alpha = -(r[k] + dot(&r[..k], &y_reversed)) / beta;
            y.iter_mut().zip(&y_reversed).for_each(|(y, z)| *y += alpha * z);
            y.push(alpha);
        }
    }
    Some(x)
}

/// T x for T_jk = `first`[|j - k|]; `first` at least as long as `x`.
pub fn times_symmetric(first: &[f64], x: &[f64]) -> Vec<f64> {
    (0..x.len())
        .map(|j| {
            let (before, after) = x.split_at(j);
            let below = if j == 0 { 0.0 } else { dot_reversed(&first[1..=j], before) };
            dot(&first[..after.len()], after) + below
        })
        .collect()
}

/// Eight partial sums: one would forbid the compiler to use vector registers.
const LANES: usize = 8;

fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a8, a_rest) = a.as_chunks::<LANES>();
    let (b8, b_rest) = b.as_chunks::<LANES>();
    let mut lanes = [0.0; LANES];
    for (a, b) in a8.iter().zip(b8) {
        for ((lane, a), b) in lanes.iter_mut().zip(a).zip(b) {
            *lane += a * b;
        }
    }
    lanes.iter().sum::<f64>() + a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum::<f64>()
}

/// Sum of a_i b_(n-1-i).
fn dot_reversed(a: &[f64], b: &[f64]) -> f64 {
    let (a8, a_rest) = a.as_chunks::<LANES>();
    let (b_rest, b8) = b.as_rchunks::<LANES>();
    let mut lanes = [0.0; LANES];
    for (a, b) in a8.iter().zip(b8.iter().rev()) {
        for ((lane, a), b) in lanes.iter_mut().zip(a).zip(b.iter().rev()) {
            *lane += a * b;
        }
    }
    lanes.iter().sum::<f64>() + a_rest.iter().zip(b_rest.iter().rev()).map(|(a, b)| a * b).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn logarithmic(n: usize) -> Vec<f64> {
        (0..n).map(|k| if k == 0 { 3.0 } else { ((1.0 + 5.0 / k as f64) / k as f64).ln_1p() }).collect()
    }

    #[test]
    fn the_solution_times_the_matrix_is_the_right_side() {
        for n in [1, 2, 3, 9, 16, 60, 333] {
            let first = logarithmic(n);
            let planted: [Vec<f64>; 2] = [
                (0..n).map(|j| (j as f64).sin()).collect(),
                (0..n).map(|j| 1.0 / (1.0 + j as f64)).collect(),
            ];
            let right = planted.each_ref().map(|x| {
                (0..n).map(|j| (0..n).map(|k| first[j.abs_diff(k)] * x[k]).sum::<f64>()).collect::<Vec<f64>>()
            });
            let found = solve_symmetric(&first, right.each_ref().map(Vec::as_slice)).unwrap();
            for (x, wanted) in found.iter().zip(&planted) {
                for (x, wanted) in x.iter().zip(wanted) {
                    assert!((x - wanted).abs() < 1e-12, "{n}: {x} {wanted}");
                }
            }
            for (b, x) in right.iter().zip(&planted) {
                for (found, wanted) in times_symmetric(&first, x).iter().zip(b) {
                    assert!((found - wanted).abs() < 1e-12 * (1.0 + wanted.abs()));
                }
            }
        }
    }

    #[test]
    fn what_is_not_positive_definite_is_refused() {
        assert!(solve_symmetric(&[1.0, 2.0], [&[1.0, 1.0]]).is_none());
        assert!(solve_symmetric(&[1.0, 1.0], [&[1.0, 1.0]]).is_none());
        assert!(solve_symmetric(&[-1.0], [&[1.0]]).is_none());
        assert!(solve_symmetric(&[1.0], [&[1.0, 1.0]]).is_none());
        assert!(solve_symmetric(&[1.0, 0.0], [&[1.0, f64::NAN]]).is_none_or(|x| x[0][1].is_nan()));
    }
}
