//! A random torque from its spectrum: one course of it, drawn from a seed.
//!
//! In: `torque_random` of a scenario, the mean torque, the duration. Out: rows over time, SI. Absent: what the torque does.
//! Equations: none of the paper's. With S the one-sided power spectral density and the band in K bins of width D,
//! C(t) = mean + sum_k sqrt(2 S(f_k) D) cos(2 pi f_k t + p_k): f_k evenly at random in bin k, so that nothing repeats, p_k in 0 to
//! 2 pi (Shinozuka and Deodatis 1991). Its variance is the integral of S.

use super::findings::Findings;
use schemars::JsonSchema;
use serde::Deserialize;
use std::f64::consts::TAU;

/// Random torque on the inner race, drawn from a seed.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct RandomTorqueFile {
    /// Rows of frequency, Hz, and one-sided power spectral density of the torque there, (N m)^2/Hz: frequencies ascending, straight between
    /// rows, none outside. The torque's variance is the area below.
    #[schemars(length(min = 2))]
    pub spectrum: Vec<[f64; 2]>,
    /// Seed of frequencies and phases; absent: 1.
    #[serde(default = "first_seed")]
    pub seed: u64,
}

fn first_seed() -> u64 {
    1
}

/// Rows in a period of the highest frequency: straight lines between them lie (pi/40)^2/2 = 0.3 % of its amplitude beside the cosine.
const ROWS_PER_PERIOD: f64 = 40.0;
/// Bins at least, so that many cosines make up the torque.
const FEWEST_BINS: f64 = 200.0;
/// Bins at most, for the time that reading takes.
const MOST_BINS: f64 = 2000.0;
/// Most periods of the highest frequency in a scene.
const MOST_PERIODS: f64 = 2500.0;

impl RandomTorqueFile {
    /// Whether the table is one, for a scene of that duration; `key`: its path.
    pub(super) fn accepted(&self, duration_s: f64, key: &str, out: &mut Findings) -> bool {
        let spectrum = format!("{key}.spectrum");
        let rows = &self.spectrum;
        let fine = |row: &[f64; 2]| row.iter().all(|x| x.is_finite() && *x >= 0.0);
        let ascend = rows.windows(2).all(|two| two[0][0] < two[1][0]);
        if rows.len() < 2 || !ascend || !rows.iter().all(fine) || rows.iter().all(|row| row[1] == 0.0) {
            out.refuse(
                &[&spectrum],
                "two rows or more [Hz, (N m)^2/Hz] of numbers from 0 up, frequencies ascending, one density above 0".to_owned(),
                "write such as spectrum = [[5.0, 40.0], [200.0, 10.0]]".to_owned(),
            );
            return false;
        }
        let periods = rows.last().map_or(0.0, |row| row[0]) * duration_s;
        if periods > MOST_PERIODS {
            out.refuse(
                &[&spectrum],
                format!("at most {MOST_PERIODS} periods of the highest frequency within duration_s; these are {periods:.0}"),
                "lower the highest frequency, or shorten the scene".to_owned(),
            );
            return false;
        }
        true
    }

    /// Rows (s, N m) over the duration.
    pub(super) fn rows(&self, mean_nm: f64, duration_s: f64) -> Vec<[f64; 2]> {
        let (Some(first), Some(last)) = (self.spectrum.first(), self.spectrum.last()) else {
            return Vec::new();
        };
        let band_hz = last[0] - first[0];
        let bins = (band_hz * duration_s).clamp(FEWEST_BINS, MOST_BINS).round();
        let bin_hz = band_hz / bins;
        let mut random = fastrand::Rng::with_seed(self.seed);
        let waves: Vec<[f64; 3]> = (0..bins as usize)
            .map(|k| {
                let hz = first[0] + bin_hz * (k as f64 + random.f64());
                [(2.0 * self.density(hz) * bin_hz).sqrt(), TAU * hz, TAU * random.f64()]
            })
            .collect();
        let steps = (ROWS_PER_PERIOD * last[0] * duration_s).ceil().max(1.0);
        let at =
            |t: f64| waves.iter().map(|[size, speed, phase]| size * (speed * t + phase).cos()).sum::<f64>();
        let time = |k: usize| duration_s * k as f64 / steps;
        (0..=steps as usize).map(|k| [time(k), mean_nm + at(time(k))]).collect()
    }

    /// S at `hz`, (N m)^2/Hz.
    fn density(&self, hz: f64) -> f64 {
        let above = self.spectrum.partition_point(|row| row[0] < hz);
        match (above.checked_sub(1).and_then(|i| self.spectrum.get(i)), self.spectrum.get(above)) {
            (Some(a), Some(b)) => a[1] + (b[1] - a[1]) * (hz - a[0]) / (b[0] - a[0]),
            _ => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(seed: u64) -> RandomTorqueFile {
        RandomTorqueFile { spectrum: vec![[5.0, 40.0], [50.0, 40.0], [50.001, 10.0], [100.0, 10.0]], seed }
    }

    #[test]
    fn the_variance_in_each_band_is_the_area_below_the_spectrum() {
        let (mean, duration) = (300.0, 20.0);
        let rows = table(7).rows(mean, duration);
        let values: Vec<f64> = rows.iter().map(|row| row[1] - mean).collect();
        let n = values.len() as f64;
        let variance = values.iter().map(|v| v * v).sum::<f64>() / n;
        assert!((values.iter().sum::<f64>() / n).abs() < 0.05 * variance.sqrt());
        // 45 Hz at 40, 50 Hz at 10. Of 45 x 20 bins the variance scatters by 1/sqrt(900).
        assert!((variance / 2300.0 - 1.0).abs() < 0.1, "{variance}");
        // Power between two frequencies, by the discrete Fourier transform of the course.
        let power = |from: f64, to: f64| -> f64 {
            let lines = ((from * duration).ceil() as usize)..((to * duration) as usize);
            let line = |k: usize| {
                let [mut re, mut im] = [0.0; 2];
                for (i, v) in values.iter().enumerate() {
                    let angle = TAU * k as f64 * i as f64 / n;
                    re += v * angle.cos();
                    im += v * angle.sin();
                }
                2.0 * (re * re + im * im) / (n * n)
            };
            lines.map(line).sum()
        };
        for (from, to, area) in [(20.0, 30.0, 400.0), (60.0, 80.0, 200.0), (120.0, 130.0, 0.0)] {
            let got = power(from, to);
            assert!((got - area).abs() < 0.2 * area + 1.0, "{from} to {to} Hz: {got} for {area}");
        }
    }

    #[test]
    fn a_seed_gives_one_course_and_another_seed_another() {
        let rows = |seed| table(seed).rows(0.0, 1.0);
        assert_eq!(rows(1), rows(1));
        assert_ne!(rows(1), rows(2));
        assert_eq!(rows(1).first().map(|row| row[0]), Some(0.0));
        assert_eq!(rows(1).last().map(|row| row[0]), Some(1.0));
    }
}
