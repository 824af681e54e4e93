//! Conjugate gradients for a contact under a given force.

/// When the iteration stops.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConjugateSettings {
    /// Converged when the pressures change by less than this in the mean and the gap left on loaded cells is
    /// below it, both relative.
    pub tolerance: f64,
    /// Iterations at most.
    pub most_iterations: usize,
}

impl Default for ConjugateSettings {
    fn default() -> Self {
        Self { tolerance: 1e-8, most_iterations: 3000 }
    }
}

/// How the iteration ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum HalfSpaceStatus {
    /// Loaded cells touch, the others are apart.
    Converged {
        /// Iterations used.
        iterations: usize,
    },
    /// No normal force.
    Unloaded,
    /// The pressures are those of the last iteration.
    NoConvergence {
        /// Change of the pressures or gap on loaded cells, whichever is larger, relative.
        residual: f64,
    },
}

/// Pressures of mean 1.
pub(super) struct Found {
    pub pressure: Vec<f64>,
    pub approach: f64,
    pub status: HalfSpaceStatus,
}

/// min p K p/2 + gap p with p >= 0 and mean 1, by Polonsky & Keer, *Wear* 231 (1999) 206: one step along the
/// conjugate direction on the loaded cells, negative pressures cut off, cells that overlap loaded again, the
/// whole scaled to the force.
pub(super) fn solve(
    mut displace: impl FnMut(&[f64], &mut [f64]),
    gap: &[f64],
    guess: Vec<f64>,
    settings: &ConjugateSettings,
) -> Found {
    let n = gap.len();
    let mut pressure = guess;
    if !normalise(&mut pressure) {
        pressure = vec![1.0; n];
    }
    let (mut residual, mut direction, mut sunk) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    let (mut last_square, mut conjugate) = (1.0, false);
    let mut change = f64::INFINITY;
    let mut status = HalfSpaceStatus::NoConvergence { residual: f64::INFINITY };
    let mut approach = 0.0;
    for iteration in 0..=settings.most_iterations {
        displace(&pressure, &mut sunk);
        let loaded = pressure.iter().filter(|p| **p > 0.0).count() as f64;
        let over = |pressure: &[f64], of: &dyn Fn(usize) -> f64| -> f64 {
            (0..n).filter(|k| pressure[*k] > 0.0).map(of).sum()
        };
        // u + gap is the approach wherever the bodies touch
        approach = over(&pressure, &|k| sunk[k] + gap[k]) / loaded;
        for k in 0..n {
            residual[k] = sunk[k] + gap[k] - approach;
        }
        let square = over(&pressure, &|k| residual[k] * residual[k]);
        let depth = over(&pressure, &|k| sunk[k]) / loaded;
        let off = (square / loaded).sqrt() / depth.abs();
        let overlap = residual.iter().fold(0.0f64, |worst, r| worst.max(-r)) / depth.abs();
        let worst = off.max(overlap).max(change);
        if !worst.is_nan() && worst < settings.tolerance {
            status = HalfSpaceStatus::Converged { iterations: iteration };
            break;
        }
        status = HalfSpaceStatus::NoConvergence { residual: worst };
        let beta = if conjugate { square / last_square } else { 0.0 };
        for k in 0..n {
            direction[k] = if pressure[k] > 0.0 { residual[k] + beta * direction[k] } else { 0.0 };
        }
        last_square = square;
        displace(&direction, &mut sunk);
        let mean = over(&pressure, &|k| sunk[k]) / loaded;
        let slope = over(&pressure, &|k| residual[k] * direction[k]);
        let curvature = over(&pressure, &|k| (sunk[k] - mean) * direction[k]);
        // one loaded cell has no direction left, and a mirrored load may in principle bend the energy down: then
        // the cell's own stiffness
        let step = if curvature > 0.0 { slope / curvature } else { n as f64 / (loaded * depth.abs()) };
        let before = pressure.clone();
        conjugate = true;
        for k in 0..n {
            if pressure[k] > 0.0 {
                pressure[k] = (pressure[k] - step * direction[k]).max(0.0);
            }
        }
        for k in 0..n {
            if pressure[k] == 0.0 && residual[k] < 0.0 {
                pressure[k] = -step * residual[k];
                conjugate = false;
            }
        }
        if !normalise(&mut pressure) {
            break;
        }
        change = pressure.iter().zip(&before).map(|(p, q)| (p - q).abs()).sum::<f64>() / n as f64;
    }
    Found { pressure, approach, status }
}

/// Scales to mean 1; false where there is nothing to scale.
fn normalise(pressure: &mut [f64]) -> bool {
    let mean = pressure.iter().sum::<f64>() / pressure.len() as f64;
    let good = mean > 0.0 && mean.is_finite() && pressure.iter().all(|p| *p >= 0.0);
    if good {
        pressure.iter_mut().for_each(|p| *p /= mean);
    }
    good
}
