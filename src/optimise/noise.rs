//! Noise of the evaluator, measured from a difference table along a short line.

use super::journal::{Halt, Memo};
use super::settings::{Noise, Settings};
use super::space::Space;

/// Points beyond the first on the line.
const POINTS: usize = 6;
/// Spacing of the points, a fraction of every range: far below the length on which margins bend.
const SPACING: f64 = 1e-7;
/// Noise assumed where it cannot be measured, and the least that is believed: rounding of a short computation.
const LEAST: f64 = 1e-14;

/// Noise level of every output at u, in the output's own unit.
///
/// Moré and Wild 2011: sigma_k^2 = (k!)^2/(2k)! mean (D^k f)^2; the first k whose differences change sign and whose
/// level agrees with the next two within a factor of four gives the noise.
pub(super) fn levels(
    memo: &mut Memo,
    space: &Space,
    u: &[f64],
    outputs: &[f64],
    settings: &Settings,
) -> Result<Vec<f64>, Halt> {
    let scale = |f: f64| f.abs().max(1.0);
    if let Noise::Relative(level) = settings.noise {
        return Ok(outputs.iter().map(|&f| level * scale(f)).collect());
    }
    let free = space.free();
    let line: Vec<Vec<f64>> = (1..=POINTS)
        .map(|k| {
            let mut v = u.to_vec();
            for &i in &free {
                v[i] += if u[i] > 0.5 { -1.0 } else { 1.0 } * k as f64 * SPACING;
            }
            space.unscaled(&v)
        })
        .collect();
    let rows: Result<Vec<_>, _> = memo.batch(line)?.into_iter().map(|r| r.map(|e| e.outputs())).collect();
    Ok((0..outputs.len())
        .map(|j| {
            let level = rows.as_ref().ok().and_then(|rows| {
                let values = std::iter::once(outputs[j]).chain(rows.iter().map(|r| r[j])).collect();
                from_differences(values)
            });
            level.unwrap_or(0.0).max(LEAST * scale(outputs[j]))
        })
        .collect())
}

/// Noise of equidistant values, `None` where the differences do not settle (the values are smooth).
fn from_differences(values: Vec<f64>) -> Option<f64> {
    let mut row = values;
    let mut gamma = 1.0;
    let mut found: Vec<(f64, bool)> = Vec::new();
    for k in 1..POINTS {
        row = row.windows(2).map(|w| w[1] - w[0]).collect();
        gamma *= 0.5 * k as f64 / (2.0 * k as f64 - 1.0);
        let mean_square = row.iter().map(|d| d * d).sum::<f64>() / row.len() as f64;
        let changes_sign = row.iter().any(|d| *d > 0.0) && row.iter().any(|d| *d < 0.0);
        found.push(((gamma * mean_square).sqrt(), changes_sign));
    }
    found.windows(3).find_map(|w| {
        let least = w.iter().map(|l| l.0).fold(f64::INFINITY, f64::min);
        let most = w.iter().map(|l| l.0).fold(0.0, f64::max);
        (w[0].1 && most <= 4.0 * least).then_some(w[0].0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_noise_is_found_and_a_smooth_function_has_none() {
        let smooth: Vec<f64> = (0..=POINTS).map(|k| (1.0 + k as f64 * SPACING).powi(2)).collect();
        assert!(from_differences(smooth.clone()).unwrap_or(0.0) < 1e-15);
        let shaken = [0.9, -0.7, 0.2, -1.0, 0.6, 0.8, -0.5];
        let noisy = smooth.iter().zip(shaken).map(|(f, s)| f + 1e-6 * s).collect();
        let level = from_differences(noisy).unwrap();
        assert!(level > 2e-7 && level < 2e-6, "{level}");
    }
}
