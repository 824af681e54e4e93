//! Points around a solution along which no active margin changes to first order.

use std::f64::consts::FRAC_1_SQRT_2;

use nalgebra::{DMatrix, DVector, SymmetricEigen};

use super::driver::Stand;
use super::space::Space;
use super::view::View;

/// Most directions polled, each both ways: twenty evaluations.
const DIRECTIONS: usize = 10;

/// Points `length` away from the stand both ways along an orthonormal basis of the tangent space of the active
/// margins and bounds, cut off at the box. Along the coordinates the central differences have polled already.
pub(super) fn along_active(
    stand: &Stand,
    view: &View,
    space: &Space,
    length: f64,
    inactive: f64,
) -> Vec<Vec<f64>> {
    let table = &stand.table;
    let free: Vec<usize> = space.free().into_iter().filter(|i| !table.held.contains(i)).collect();
    if free.is_empty() {
        return Vec::new();
    }
    let u = &stand.point.u;
    let linear = view.linear(&stand.point.evaluation.outputs(), table, &free);
    let (rise, limit) = &stand.multipliers;
    let active = |multipliers: &[f64], k: usize| {
        multipliers.get(k).is_some_and(|m| *m > inactive * multipliers.iter().sum::<f64>())
    };
    let mut rows: Vec<Vec<f64>> = Vec::new();
    let raised: Vec<&Vec<f64>> =
        (0..linear.rises.len()).filter(|&k| active(rise, k)).map(|k| &linear.rises[k].1).collect();
    // The least margin may change along a tangent only if all active ones change alike.
    for slopes in raised.iter().skip(1) {
        rows.push(slopes.iter().zip(raised[0]).map(|(a, b)| a - b).collect());
    }
    rows.extend((0..linear.limits.len()).filter(|&k| active(limit, k)).map(|k| linear.limits[k].1.clone()));
    for (k, &i) in free.iter().enumerate() {
        if u[i] <= 0.0 || u[i] >= 1.0 {
            rows.push((0..free.len()).map(|l| f64::from(u8::from(l == k))).collect());
        }
    }
    let mut normal = DMatrix::zeros(free.len(), free.len());
    for row in &rows {
        let size = row.iter().map(|v| v * v).sum::<f64>();
        if size > 0.0 {
            normal += DMatrix::from_fn(free.len(), free.len(), |i, k| row[i] * row[k] / size);
        }
    }
    let eigen = SymmetricEigen::new(normal);
    let mut tangents: Vec<DVector<f64>> = (0..free.len())
        .filter(|&k| eigen.eigenvalues[k] < 1e-8)
        .map(|k| eigen.eigenvectors.column(k).into_owned())
        .collect();
    // Where nothing is active the basis is the axes, which are polled already: turned by 45 degrees in pairs.
    for pair in tangents.chunks_exact_mut(2) {
        let (a, b) = (pair[0].clone(), pair[1].clone());
        pair[0] = (&a + &b) * FRAC_1_SQRT_2;
        pair[1] = (a - b) * FRAC_1_SQRT_2;
    }
    tangents.truncate(DIRECTIONS);
    let moved = |tangent: &DVector<f64>, sign: f64| {
        let mut point = u.clone();
        for (v, &i) in tangent.iter().zip(&free) {
            point[i] = (u[i] + sign * length * v).clamp(0.0, 1.0);
        }
        point
    };
    tangents.iter().flat_map(|t| [moved(t, 1.0), moved(t, -1.0)]).collect()
}
