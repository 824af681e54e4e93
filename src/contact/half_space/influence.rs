//! Love's influence between the cells of a patch that is symmetric about x = 0, applied through FFT.

use std::f64::consts::PI;

use rustfft::algorithm::Radix4;
use rustfft::num_complex::Complex;
use rustfft::{Fft, FftDirection, Length};

use super::conjugate::{self, ConjugateSettings, HalfSpaceStatus};
use crate::contact::line::{ContactError, positive};

/// A patch of `across` x `along` cells, each under uniform pressure, displacements taken at cell middles.
///
/// # Conventions
/// x across, y along the contact, both from the middle of the patch. Load and gap are symmetric about x = 0, so
/// only cells with x > 0 are unknown: cell (i, j), i outward from the axis, j along, stands at i * along + j.
///
/// Along y the influence is a convolution, done by FFT with zero padding; across x it is the folded matrix
/// K(i - k) + K(i + k + 1), dense per frequency: for a contact long and narrow cheaper than a second FFT.
pub struct HalfSpaceGrid {
    half: usize,
    along: usize,
    cell_m: [f64; 2],
    contact_modulus_pa: f64,
    /// Factor of the mirrored load at y = -l/2 and +l/2.
    mirrors: [f64; 2],
    /// Spectrum along y of K at each distance across, one row per distance 0 .. across, m/Pa over FFT length.
    spectrum: Vec<f64>,
    forward: Radix4<f64>,
    inverse: Radix4<f64>,
}

/// Pressures on the half patch x > 0.
#[derive(Debug, Clone, PartialEq)]
pub struct PatchSolution {
    /// Approach, m.
    pub approach_m: f64,
    /// Pressure of cell (i, j) at i * along + j, Pa.
    pub pressure_pa: Vec<f64>,
    /// How the iteration ended.
    pub status: HalfSpaceStatus,
}

impl HalfSpaceGrid {
    /// Most cells of a patch, a choice: 200 MB of work.
    pub const MOST_CELLS: usize = 1 << 21;

    /// A patch `width_m` x `length_m` of `across` (even) x `along` cells. `mirrors`: see
    /// [`super::free_end_factor`]; 0 where the half-spaces go on.
    pub fn new(
        [width_m, length_m]: [f64; 2],
        [across, along]: [usize; 2],
        contact_modulus_pa: f64,
        mirrors: [f64; 2],
    ) -> Result<Self, ContactError> {
        let cells = across.saturating_mul(along);
        if cells == 0 || cells > Self::MOST_CELLS || !across.is_multiple_of(2) || across > 1024 {
            return Err(ContactError::Grid { across, along });
        }
        for factor in mirrors {
            if !(0.0..=2.0).contains(&factor) {
                return Err(ContactError::NotPositive { name: "mirror factor (0..2)", value: factor });
            }
        }
        let dx = positive("width_m", width_m)? / across as f64;
        let dy = positive("length_m", length_m)? / along as f64;
        positive("contact_modulus_pa", contact_modulus_pa)?;
        // zero padding keeps the ends apart; mirrored loads need as much room again on either side
        let period = (if mirrors == [0.0; 2] { 2 * along } else { 4 * along }).next_power_of_two();
        let frequencies = period / 2 + 1;
        let mut grid = Self {
            half: across / 2,
            along,
            cell_m: [dx, dy],
            contact_modulus_pa,
            mirrors,
            spectrum: Vec::with_capacity(across * frequencies),
            forward: Radix4::new(period, FftDirection::Forward),
            inverse: Radix4::new(period, FftDirection::Inverse),
        };
        let mut row = vec![Complex::default(); period];
        for distance in 0..across {
            for (d, value) in row.iter_mut().enumerate() {
                let steps = d.min(period - d) as f64;
                let love = love_m_per_pa(distance as f64 * dx, steps * dy, 0.5 * dx, 0.5 * dy);
                *value = Complex::from(love / (PI * contact_modulus_pa * period as f64));
            }
            grid.forward.process(&mut row);
            // even along y: the imaginary parts are roundings
            grid.spectrum.extend(row[..frequencies].iter().map(|c| c.re));
        }
        Ok(grid)
    }

    /// Cells across (both sides of the axis) and along.
    pub fn cells(&self) -> [usize; 2] {
        [2 * self.half, self.along]
    }

    /// Size of a cell, m.
    pub fn cell_m(&self) -> [f64; 2] {
        self.cell_m
    }

    /// Middle of cell (i, j), m.
    pub fn middle_m(&self, i: usize, j: usize) -> [f64; 2] {
        let [dx, dy] = self.cell_m;
        [(i as f64 + 0.5) * dx, (2.0 * j as f64 + 1.0 - self.along as f64) / 2.0 * dy]
    }

    /// Pressures under the force `normal_n` > 0 between bodies with this gap (x, y -> m) when they touch, sought
    /// from pressures in proportion to `guess` (x, y), not negative; where it is all zero, from a uniform one.
    pub fn solve(
        &self,
        normal_n: f64,
        gap_m: impl Fn(f64, f64) -> f64,
        guess: impl Fn(f64, f64) -> f64,
        settings: &ConjugateSettings,
    ) -> Result<PatchSolution, ContactError> {
        positive("normal_n", normal_n)?;
        let cells = self.half * self.along;
        let at = |f: &dyn Fn(f64, f64) -> f64| -> Vec<f64> {
            (0..cells).map(|k| self.middle_m(k / self.along, k % self.along)).map(|[x, y]| f(x, y)).collect()
        };
        let (gap, guess) = (at(&gap_m), at(&guess));
        let finite = gap.iter().filter(|g| g.is_finite()).count();
        if finite != cells {
            return Err(ContactError::Gap { slices: cells, finite });
        }
        // in units of the mean pressure and of what it sinks: no force is too small or too large
        let area_m2 = 2.0 * cells as f64 * self.cell_m[0] * self.cell_m[1];
        let mean_pa = normal_n / area_m2;
        let unit_m = mean_pa / self.contact_modulus_pa * area_m2.sqrt();
        let gap: Vec<f64> = gap.iter().map(|g| g / unit_m).collect();
        let mut work = self.work();
        let per_unit = mean_pa / unit_m;
        let found = conjugate::solve(
            |pressure, sunk| {
                self.displace(pressure, sunk, &mut work);
                sunk.iter_mut().for_each(|u| *u *= per_unit);
            },
            &gap,
            guess,
            settings,
        );
        Ok(PatchSolution {
            approach_m: found.approach * unit_m,
            pressure_pa: found.pressure.iter().map(|p| p * mean_pa).collect(),
            status: found.status,
        })
    }

    fn work(&self) -> Work {
        let period = self.forward.len();
        let scratch = self.forward.get_inplace_scratch_len().max(self.inverse.get_inplace_scratch_len());
        Work {
            line: vec![Complex::default(); period],
            load: vec![Complex::default(); self.half * (period / 2 + 1)],
            scratch: vec![Complex::default(); scratch],
        }
    }

    /// Displacement, m, of both bodies together under `pressure`, Pa, on x > 0 and its image on x < 0.
    fn displace(&self, pressure: &[f64], sunk_m: &mut [f64], work: &mut Work) {
        let Work { line, load, scratch } = work;
        let (n, period) = (self.along, line.len());
        let frequencies = period / 2 + 1;
        let mirrored = self.mirrors != [0.0; 2];
        for (p, load) in pressure.chunks_exact(n).zip(load.chunks_exact_mut(frequencies)) {
            line.fill(Complex::default());
            for (k, p) in p.iter().enumerate() {
                line[k].re = *p;
                if mirrored {
                    // about +l/2, and about -l/2 round the period
                    line[2 * n - 1 - k].re = self.mirrors[1] * p;
                    line[period - 1 - k].re = self.mirrors[0] * p;
                }
            }
            self.forward.process_with_scratch(line, scratch);
            load.copy_from_slice(&line[..frequencies]);
        }
        let kernel = |distance: usize| &self.spectrum[distance * frequencies..][..frequencies];
        for (i, sunk_m) in sunk_m.chunks_exact_mut(n).enumerate() {
            line.fill(Complex::default());
            for (k, load) in load.chunks_exact(frequencies).enumerate() {
                let (own, image) = (kernel(i.abs_diff(k)), kernel(i + k + 1));
                for (((u, p), a), b) in line.iter_mut().zip(load).zip(own).zip(image) {
                    *u += p * (a + b);
                }
            }
            // what is real has the conjugate of each frequency at its negative
            for f in 1..period - period / 2 {
                line[period - f] = line[f].conj();
            }
            self.inverse.process_with_scratch(line, scratch);
            sunk_m.iter_mut().zip(line.iter()).for_each(|(u, value)| *u = value.re);
        }
    }
}

/// Scratch of one application: a line of loads or of what they sink, the spectra of all loads, and the transform's own.
struct Work {
    line: Vec<Complex<f64>>,
    load: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
}

/// Love's solution times pi E* per unit pressure on |x| < a, |y| < b (Johnson, *Contact Mechanics*, (3.25)):
/// sum over the sides of p [asinh(q/|p|) - asinh(r/|p|)], the form that loses nothing for slender cells.
fn love_m_per_pa(x: f64, y: f64, a: f64, b: f64) -> f64 {
    let side = |p: f64, q: f64, r: f64| {
        let s = p.abs();
        if s == 0.0 { 0.0 } else { p * ((q / s).asinh() - (r / s).asinh()) }
    };
    side(x + a, y + b, y - b) - side(x - a, y + b, y - b) + side(y + b, x + a, x - a)
        - side(y - b, x + a, x - a)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_transform_is_the_sum_over_cells() {
        let (across, along) = (6, 5);
        let mirrors = [0.7, 1.3];
        for mirrors in [[0.0; 2], mirrors] {
            let grid = HalfSpaceGrid::new([3e-3, 4e-3], [across, along], 1e11, mirrors).unwrap();
            let [dx, dy] = grid.cell_m();
            let pressure: Vec<f64> = (0..3 * along).map(|k| 1e8 * (1.0 + (k as f64).sin())).collect();
            let mut found = vec![0.0; 3 * along];
            grid.displace(&pressure, &mut found, &mut grid.work());
            for (k, found) in found.iter().enumerate() {
                let [x, y] = grid.middle_m(k / along, k % along);
                let mut wanted = 0.0;
                for (c, p) in pressure.iter().enumerate() {
                    let [u, v] = grid.middle_m(c / along, c % along);
                    for side in [1.0, -1.0] {
                        for (at, factor) in [(v, 1.0), (-4e-3 - v, mirrors[0]), (4e-3 - v, mirrors[1])] {
                            let love = love_m_per_pa(x - side * u, y - at, 0.5 * dx, 0.5 * dy);
                            wanted += factor * p * love / (PI * 1e11);
                        }
                    }
                }
                assert!((found / wanted - 1.0).abs() < 1e-12, "{k}: {found} {wanted}");
            }
        }
    }

    #[test]
    fn the_middle_of_a_loaded_square_sinks_as_johnson_says() {
        // (3.26): corner 2 a p ln(1 + sqrt 2) 2/(pi E*), middle twice that
        let (a, wanted) = (0.5, 8.0 * 0.5 * (1.0 + 2f64.sqrt()).ln());
        assert!((love_m_per_pa(0.0, 0.0, a, a) / wanted - 1.0).abs() < 1e-15);
        assert!((love_m_per_pa(a, a, a, a) / (0.5 * wanted) - 1.0).abs() < 1e-15);
    }

    #[test]
    fn impossible_grids_are_refused() {
        let grid = |cells, mirrors| HalfSpaceGrid::new([1e-3, 6e-3], cells, 1e11, mirrors).err();
        for cells in [[0, 5], [6, 0], [7, 5], [2, usize::MAX], [1 << 11, 1 << 11]] {
            assert!(matches!(grid(cells, [0.0; 2]), Some(ContactError::Grid { .. })), "{cells:?}");
        }
        assert!(grid([6, 5], [f64::NAN, 0.0]).is_some() && grid([6, 5], [0.0, -1.0]).is_some());
        assert!(HalfSpaceGrid::new([f64::NAN, 1.0], [6, 5], 1e11, [0.0; 2]).is_err());
    }
}
