//! The slice method (1)-(4): load along the contact, unilateral.

use std::f64::consts::{LN_2, PI};

use super::approach::RollerLaw;
use super::axial::{AxialFit, slice_middles_m};
use super::dense::solve_dense;
use super::edge::{Edge, End, Peak, edges_and_peak};
use super::influence::{influence_m_per_pa, weighted_influence_m_per_n};
use super::line::{ContactError, LineContact, positive};
use super::slice_ratio::HALF_WIDTH_PER_LENGTH;
use crate::numeric::toeplitz::{solve_symmetric, times_symmetric};

/// A line contact cut into slices of equal length that press on two half-spaces.
///
/// Simplifications: every slice has the same half width a, and a square end sees the half-space go on beyond
/// it, so its load grows without bound with the number of slices: see [`Edge::Singular`].
///
/// Cost: closed slices that lie side by side are a Toeplitz system, solved in some 6 n^2 operations and memory of
/// order n; only scattered ones (a wavy table) need the dense factor, n^3/3 and 8 n^2 bytes. Measured by
/// `cargo test --release --test wedge slice_cost -- --ignored --nocapture`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SliceContact {
    contact: LineContact,
    compliance: SliceCompliance,
    slices: usize,
}

/// Where the compliance of the slices comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SliceCompliance {
    /// Eq. (2): the influence is scaled to the mean compliance s = n delta_H(N)/N of the roller law, and a is
    /// Hertz's at the mean line load N/l.
    Roller(RollerLaw),
    /// The influence of two half-spaces as it is, plus what the slice's own shape adds.
    ///
    /// w is a mean over a patch under uniform pressure; on the centre line under the semi-ellipse the same
    /// force, closer together, sinks 2q/(pi E*) (2 ln 2 - 4/3) deeper, and the mean of x^2/2R is
    /// a^2/6R = 2q/(pi E*)/3: together 2q/(pi E*) (2 ln 2 - 1) on the diagonal. a is Hertz's at the mean line
    /// load weighted with itself, sum q^2/(N h), so a contact that is partly open is as wide as where it bears.
    HalfSpace,
}

/// How the search for the closed slices ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SliceStatus {
    /// Every slice carries load.
    Closed,
    /// Some slices carry none; loads are not negative and nothing interpenetrates.
    PartlyOpen {
        /// Number of slices without load.
        open: usize,
    },
    /// No normal force.
    Unloaded,
    /// The closed set kept changing; the loads are those of the last trial.
    NoConvergence {
        /// Largest interpenetration left, m.
        residual_m: f64,
    },
}

/// Loads and deflections of the slices.
///
/// # Conventions
/// Slices are numbered along the contact. Loads push the bodies apart and are not negative; deflections
/// are interpenetrations of the rigid shapes, positive; a gap is the distance between the two shapes at a
/// slice when they first touch, not negative.
#[derive(Debug, Clone, PartialEq)]
pub struct SliceSolution {
    /// Approach delta of the bodies, m: Delta_j = delta - gap_j on every closed slice.
    pub approach_m: f64,
    /// Half width a common to all slices, m.
    pub half_width_m: f64,
    /// Middles of the slices from the middle of the contact, m.
    pub y_m: Vec<f64>,
    /// Eq. (3): {q}, force on each slice, N; the sum is the normal force.
    #[doc(alias = "Eq. (3)")]
    pub load_n: Vec<f64>,
    /// Eq. (4): {Delta}, deflection of each slice, m: `[S_w]{q}`.
    #[doc(alias = "Eq. (4)")]
    pub deflection_m: Vec<f64>,
    /// p(y): peak pressure of each slice, Pa, by Hertz at its own line load: sqrt(q_j n E*/(pi R l)).
    ///
    /// Against half-spaces (tests/wedge/slice_half_space.rs) good to 0.4 % in the middle; at a square end 6-29 %
    /// low, since the end is narrower than Hertz's width at its load. p_0 q_j n/N is an upper bound there.
    pub pressure_pa: Vec<f64>,
    /// Index of the slice with the largest load.
    pub peak_slice: usize,
    /// Largest pressure and where.
    pub peak: Peak,
    /// The two ends, at -l/2 and +l/2.
    pub edges: [Edge; 2],
    /// How the solution was found.
    pub status: SliceStatus,
}

/// A trial of the closed set.
struct Pressed {
    approach_m: f64,
    load_n: Vec<f64>,
    deflection_m: Vec<f64>,
    status: SliceStatus,
}

impl SliceContact {
    /// Largest number of slices accepted (a choice: the dense matrix of scattered slices then takes 32 MB).
    pub const MOST_SLICES: usize = 2000;

    /// `slices` (1..=[`Self::MOST_SLICES`]) on `contact`, with the mean compliance of `roller`: the paper's (1)-(4).
    pub fn new(contact: LineContact, roller: RollerLaw, slices: usize) -> Result<Self, ContactError> {
        Self::with_compliance(contact, SliceCompliance::Roller(roller), slices)
    }

    /// `slices` (1..=[`Self::MOST_SLICES`]) on `contact`.
    pub fn with_compliance(
        contact: LineContact,
        compliance: SliceCompliance,
        slices: usize,
    ) -> Result<Self, ContactError> {
        if !(1..=Self::MOST_SLICES).contains(&slices) {
            return Err(ContactError::Slices { slices });
        }
        Ok(Self { contact, compliance, slices })
    }

    /// Square ends within a longer body, no tilt: all gaps 0.
    pub fn solve(&self, normal_n: f64) -> Result<SliceSolution, ContactError> {
        self.solve_between(normal_n, &vec![0.0; self.slices], [End::Sharp; 2])
    }

    /// The contact of two bodies that lie as `fit` says; the contact's length must be the overlap.
    pub fn solve_along(&self, normal_n: f64, fit: &AxialFit) -> Result<SliceSolution, ContactError> {
        let (contact_m, overlap_m) = (self.contact.length_m, fit.length_m());
        if (contact_m - overlap_m).abs() > 1e-9 * overlap_m {
            return Err(ContactError::Length { contact_m, overlap_m });
        }
        self.solve_between(normal_n, &fit.gaps_m(self.slices), End::of(fit))
    }

    /// Any gaps, one per slice, finite. The ends count as sharp where the load rises towards them.
    pub fn solve_with_gap(&self, normal_n: f64, gap_m: &[f64]) -> Result<SliceSolution, ContactError> {
        self.solve_between(normal_n, gap_m, [End::Shaped; 2])
    }

    /// Eq. (1): `[S_w]{q} = {Delta}`, unilateral: q_j >= 0, Delta_j = delta - gap_j where q_j > 0,
    /// Delta_j >= delta - gap_j where q_j = 0, sum q = N. `normal_n` <= 0 gives an unloaded solution.
    ///
    /// The a in w is kept within 1e-7..1 lengths, as in [`super::SliceRatio`].
    #[doc(alias = "Eq. (1)")]
    fn solve_between(
        &self,
        normal_n: f64,
        gap_m: &[f64],
        ends: [End; 2],
    ) -> Result<SliceSolution, ContactError> {
        let n = self.slices;
        let finite = gap_m.iter().filter(|g| g.is_finite()).count();
        if gap_m.len() != n || finite != n {
            return Err(ContactError::Gap { slices: n, finite });
        }
        if normal_n.is_nan() || normal_n <= 0.0 {
            return Ok(self.unloaded());
        }
        let normal_n = positive("normal_n", normal_n)?;
        let mut closed = vec![true; n];
        let mut half_width_m = self.contact.half_width_m(normal_n);
        let mut pressed = press(&self.first_row(half_width_m, normal_n), &mut closed, gap_m, normal_n);
        if self.compliance == SliceCompliance::HalfSpace {
            // a enters as its logarithm: the error falls to some tenth in each round
            for _ in 0..40 {
                let square: f64 = pressed.load_n.iter().map(|q| (q / normal_n).powi(2)).sum();
                let bearing = self.contact.half_width_m(normal_n * square * n as f64);
                let moved = (bearing / half_width_m - 1.0).abs();
                half_width_m = bearing;
                pressed = press(&self.first_row(half_width_m, normal_n), &mut closed, gap_m, normal_n);
                if moved < 1e-10 {
                    break;
                }
            }
        }
        let Pressed { approach_m, load_n, deflection_m, status } = pressed;
        let peak_slice = (0..n).max_by(|a, b| load_n[*a].total_cmp(&load_n[*b])).unwrap_or(0);
        let pressure_pa: Vec<f64> =
            load_n.iter().map(|q| self.contact.peak_pressure_pa(q * n as f64)).collect();
        let y_m = slice_middles_m(self.contact.length_m, n);
        let slice_width_m = self.contact.length_m / n as f64;
        let (edges, peak) = edges_and_peak(&load_n, &pressure_pa, &y_m, slice_width_m, ends);
        Ok(SliceSolution {
            approach_m,
            half_width_m,
            y_m,
            load_n,
            deflection_m,
            pressure_pa,
            peak_slice,
            peak,
            edges,
            status,
        })
    }

    /// First row of `[S_w]`, m/N.
    fn first_row(&self, half_width_m: f64, normal_n: f64) -> Vec<f64> {
        let n = self.slices;
        let LineContact { length_m, contact_modulus_pa, .. } = self.contact;
        let h = length_m / n as f64;
        let [low_m, high_m] = HALF_WIDTH_PER_LENGTH.map(|ratio| ratio * length_m);
        let a = half_width_m.clamp(low_m, high_m);
        let mut row = influence_m_per_pa(a, h, n, contact_modulus_pa);
        match self.compliance {
            SliceCompliance::Roller(roller) => {
                let s = n as f64 * roller.approach_m(normal_n) / normal_n;
                weighted_influence_m_per_n(&row, s)
            }
            SliceCompliance::HalfSpace => {
                let factor = 1.0 / (2.0 * a * h);
                row.iter_mut().for_each(|w| *w *= factor);
                row[0] += 2.0 / (PI * contact_modulus_pa * h) * (2.0 * LN_2 - 1.0);
                row
            }
        }
    }

    fn unloaded(&self) -> SliceSolution {
        let zeros = vec![0.0; self.slices];
        SliceSolution {
            approach_m: 0.0,
            half_width_m: 0.0,
            y_m: slice_middles_m(self.contact.length_m, self.slices),
            load_n: zeros.clone(),
            deflection_m: zeros.clone(),
            pressure_pa: zeros,
            peak_slice: 0,
            peak: Peak::None,
            edges: [Edge::Open; 2],
            status: SliceStatus::Unloaded,
        }
    }
}

/// Rounds in which all interpenetrating slices are closed at once; after them one at a time, which cannot cycle
/// in practice (Kalker's NORM). A handful is used.
const BOLD_ROUNDS: usize = 30;

/// Loads and closed set for the matrix with this first row. As in Kalker's NORM: open every slice in tension at
/// once, then close what interpenetrates. `closed` is where the search starts and ends.
fn press(row: &[f64], closed: &mut [bool], gap_m: &[f64], normal_n: f64) -> Pressed {
    let n = closed.len();
    let mut trial = Pressed {
        approach_m: 0.0,
        load_n: vec![0.0; n],
        deflection_m: vec![0.0; n],
        status: SliceStatus::NoConvergence { residual_m: f64::INFINITY },
    };
    for round in 0..4 * n + 4 {
        (trial.approach_m, trial.load_n) = press_closed(row, closed, gap_m, normal_n);
        if trial.load_n.iter().any(|q| *q < 0.0) {
            closed.iter_mut().zip(&trial.load_n).for_each(|(c, q)| *c &= *q > 0.0);
            continue;
        }
        trial.deflection_m = times_symmetric(row, &trial.load_n);
        let depth = |j: usize| trial.approach_m - gap_m[j] - trial.deflection_m[j];
        let worst = (0..n).filter(|j| !closed[*j]).max_by(|a, b| depth(*a).total_cmp(&depth(*b)));
        let open = closed.iter().filter(|c| !**c).count();
        // roundings of the solve are below this
        let slack_m = 1e-12 * trial.approach_m.abs();
        match worst {
            None => trial.status = SliceStatus::Closed,
            Some(j) if depth(j) <= slack_m => trial.status = SliceStatus::PartlyOpen { open },
            Some(worst) => {
                trial.status = SliceStatus::NoConvergence { residual_m: depth(worst) };
                let found: Vec<usize> = (0..n)
                    .filter(|j| !closed[*j] && (*j == worst || (round < BOLD_ROUNDS && depth(*j) > slack_m)))
                    .collect();
                found.iter().for_each(|j| closed[*j] = true);
                continue;
            }
        }
        break;
    }
    trial
}

/// Approach and loads that press the closed slices together with the force `normal_n`:
/// q = delta u - v, u = S^-1 1, v = S^-1 gap, delta = (N + sum v)/(sum u).
fn press_closed(row: &[f64], closed: &[bool], gap_m: &[f64], normal_n: f64) -> (f64, Vec<f64>) {
    let index: Vec<usize> = (0..closed.len()).filter(|j| closed[*j]).collect();
    // gaps from the least of them: a light load closes far less than a tilt has opened
    let least_m = index.iter().map(|j| gap_m[*j]).fold(f64::INFINITY, f64::min);
    let (ones, gaps) =
        (vec![1.0; index.len()], index.iter().map(|j| gap_m[*j] - least_m).collect::<Vec<_>>());
    let side_by_side = index.first().zip(index.last()).is_some_and(|(a, b)| b - a + 1 == index.len());
    let toeplitz = if side_by_side { solve_symmetric(row, [&ones, &gaps]) } else { None };
    let [u, v] = toeplitz
        .unwrap_or_else(|| solve_dense(index.len(), |j, k| row[index[j].abs_diff(index[k])], [&ones, &gaps]));
    let beyond_m = (normal_n + v.iter().sum::<f64>()) / u.iter().sum::<f64>();
    let mut load_n = vec![0.0; closed.len()];
    for ((at, u), v) in index.iter().zip(&u).zip(&v) {
        load_n[*at] = beyond_m * u - v;
    }
    (least_m + beyond_m, load_n)
}
#[cfg(test)]
mod tests;
