//! The slice method (1)-(4): load along the contact, unilateral.

use std::f64::consts::PI;

use faer::Mat;
use faer::Side;
use faer::linalg::solvers::Solve;

use super::approach::RollerLaw;
use super::influence::{influence_m_per_pa, weighted_influence_m_per_n};
use super::line::{ContactError, LineContact};

/// A line contact cut into slices of equal length that press on two half-spaces.
///
/// Simplifications: every slice has the half width a of Hertz at the mean line load, and a square end sees
/// the half-space go on beyond it, so its load grows without bound with the number of slices. Quote an
/// end load only together with the number of slices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SliceContact {
    contact: LineContact,
    roller: RollerLaw,
    slices: usize,
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
    /// Half width a common to all slices, m (Hertz at the mean line load).
    pub half_width_m: f64,
    /// Eq. (3): {q}, force on each slice, N; the sum is the normal force.
    #[doc(alias = "Eq. (3)")]
    pub load_n: Vec<f64>,
    /// Eq. (4): {Delta}, deflection of each slice, m, [S_w]{q}.
    #[doc(alias = "Eq. (4)")]
    pub deflection_m: Vec<f64>,
    /// Peak pressure of each slice, Pa: 2 q_j n/(pi a l), a semi-ellipse over the common half width.
    pub pressure_pa: Vec<f64>,
    /// Index of the slice with the largest load.
    pub peak_slice: usize,
    /// How the solution was found.
    pub status: SliceStatus,
}

impl SliceContact {
    /// Largest number of slices accepted (a choice: the dense matrix then takes 8 MB).
    pub const MOST_SLICES: usize = 1000;

    /// `slices` (1..=[`Self::MOST_SLICES`]) on `contact`, with the mean compliance of `roller`.
    pub fn new(contact: LineContact, roller: RollerLaw, slices: usize) -> Result<Self, ContactError> {
        if !(1..=Self::MOST_SLICES).contains(&slices) {
            return Err(ContactError::Slices { slices });
        }
        Ok(Self { contact, roller, slices })
    }

    /// Square ends, no tilt: all gaps 0.
    pub fn solve(&self, normal_n: f64) -> Result<SliceSolution, ContactError> {
        self.solve_with_gap(normal_n, &vec![0.0; self.slices])
    }

    /// Eq. (1): [S_w]{q} = {Delta}, unilateral: q_j >= 0, Delta_j = delta - gap_j where q_j > 0,
    /// Delta_j >= delta - gap_j where q_j = 0, sum q = N. `normal_n` <= 0 gives an unloaded solution.
    ///
    /// s = n delta_H(N)/N, one value per contact. The closed set is found as in Kalker's NORM: open
    /// every slice in tension at once, close the worst interpenetration one at a time.
    #[doc(alias = "Eq. (1)")]
    pub fn solve_with_gap(&self, normal_n: f64, gap_m: &[f64]) -> Result<SliceSolution, ContactError> {
        let n = self.slices;
        let finite = gap_m.iter().filter(|g| g.is_finite()).count();
        if gap_m.len() != n || finite != n {
            return Err(ContactError::Gap { slices: n, finite });
        }
        if normal_n.is_nan() || normal_n <= 0.0 {
            return Ok(self.unloaded());
        }
        let normal_n = super::line::positive("normal_n", normal_n)?;
        let half_width_m = self.contact.half_width_m(normal_n);
        let s = n as f64 * self.roller.approach_m(normal_n) / normal_n;
        let h = self.contact.length_m / n as f64;
        let w = influence_m_per_pa(half_width_m, h, n, self.contact.contact_modulus_pa);
        let matrix = weighted_influence_m_per_n(&w, s);

        let mut closed = vec![true; n];
        let mut status = None;
        let (mut approach_m, mut load_n, mut deflection_m) = (0.0, vec![0.0; n], vec![0.0; n]);
        // each round opens or closes at least one slice; far fewer are needed
        for _ in 0..4 * n + 4 {
            (approach_m, load_n) = press(&matrix, &closed, gap_m, normal_n);
            if load_n.iter().any(|q| *q < 0.0) {
                closed.iter_mut().zip(&load_n).for_each(|(c, q)| *c &= *q > 0.0);
                continue;
            }
            deflection_m = (0..n).map(|j| (0..n).map(|k| matrix[(j, k)] * load_n[k]).sum::<f64>()).collect();
            let worst = (0..n)
                .filter(|j| !closed[*j])
                .map(|j| (j, approach_m - gap_m[j] - deflection_m[j]))
                .max_by(|a, b| a.1.total_cmp(&b.1));
            let open = closed.iter().filter(|c| !**c).count();
            match worst {
                None => status = Some(SliceStatus::Closed),
                // roundings of the solve are below this
                Some((_, depth)) if depth <= 1e-12 * approach_m.abs() => {
                    status = Some(SliceStatus::PartlyOpen { open });
                }
                Some((j, depth)) => {
                    closed[j] = true;
                    status = Some(SliceStatus::NoConvergence { residual_m: depth });
                    continue;
                }
            }
            break;
        }
        let peak_slice = (0..n).max_by(|a, b| load_n[*a].total_cmp(&load_n[*b])).unwrap_or(0);
        let pressure_pa = load_n.iter().map(|q| 2.0 * q / (PI * half_width_m * h)).collect();
        let status = status.unwrap_or(SliceStatus::NoConvergence { residual_m: f64::INFINITY });
        Ok(SliceSolution { approach_m, half_width_m, load_n, deflection_m, pressure_pa, peak_slice, status })
    }

    fn unloaded(&self) -> SliceSolution {
        let zeros = vec![0.0; self.slices];
        SliceSolution {
            approach_m: 0.0,
            half_width_m: 0.0,
            load_n: zeros.clone(),
            deflection_m: zeros.clone(),
            pressure_pa: zeros,
            peak_slice: 0,
            status: SliceStatus::Unloaded,
        }
    }
}

/// Approach and loads that press the closed slices together with the force `normal_n`:
/// q = delta u - v, u = S^-1 1, v = S^-1 gap, delta = (N + sum v)/(sum u).
fn press(matrix: &Mat<f64>, closed: &[bool], gap_m: &[f64], normal_n: f64) -> (f64, Vec<f64>) {
    let index: Vec<usize> = (0..closed.len()).filter(|j| closed[*j]).collect();
    let sub = Mat::from_fn(index.len(), index.len(), |j, k| matrix[(index[j], index[k])]);
    let rhs = Mat::from_fn(index.len(), 2, |j, k| if k == 0 { 1.0 } else { gap_m[index[j]] });
    let solved = sub.lblt(Side::Lower).solve(rhs);
    let sum = |column: usize| (0..index.len()).map(|j| solved[(j, column)]).sum::<f64>();
    let approach_m = (normal_n + sum(1)) / sum(0);
    let mut load_n = vec![0.0; closed.len()];
    for (j, at) in index.iter().enumerate() {
        load_n[*at] = approach_m * solved[(j, 0)] - solved[(j, 1)];
    }
    (approach_m, load_n)
}
