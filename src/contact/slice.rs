//! The slice method (1)-(4): load along the contact, unilateral.

use faer::Mat;
use faer::Side;
use faer::linalg::solvers::Solve;

use super::approach::RollerLaw;
use super::influence::{influence_m_per_pa, weighted_influence_m_per_n};
use super::line::{ContactError, LineContact, positive};
use super::slice_ratio::HALF_WIDTH_PER_LENGTH;

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
    /// Eq. (4): {Delta}, deflection of each slice, m: `[S_w]{q}`.
    #[doc(alias = "Eq. (4)")]
    pub deflection_m: Vec<f64>,
    /// Peak pressure of each slice, Pa, by Hertz at its own line load: sqrt(q_j n E*/(pi R l)).
    ///
    /// Against half-spaces (tests/slice_half_space.rs) good to 0.4 % in the middle; at a square end 6-29 %
    /// low, since the end is narrower than Hertz's width at its load. p_0 q_j n/N is an upper bound there.
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

    /// Eq. (1): `[S_w]{q} = {Delta}`, unilateral: q_j >= 0, Delta_j = delta - gap_j where q_j > 0,
    /// Delta_j >= delta - gap_j where q_j = 0, sum q = N. `normal_n` <= 0 gives an unloaded solution.
    ///
    /// s = n delta_H(N)/N, one value per contact; the a in w is held to 1e-7..1 lengths, as in
    /// [`super::SliceRatio`]. The closed set is found as in Kalker's NORM: open
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
        let normal_n = positive("normal_n", normal_n)?;
        let half_width_m = self.contact.half_width_m(normal_n);
        let s = n as f64 * self.roller.approach_m(normal_n) / normal_n;
        let h = self.contact.length_m / n as f64;
        let [low_m, high_m] = HALF_WIDTH_PER_LENGTH.map(|ratio| ratio * self.contact.length_m);
        let w = influence_m_per_pa(half_width_m.clamp(low_m, high_m), h, n, self.contact.contact_modulus_pa);
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
        let pressure_pa = load_n.iter().map(|q| self.contact.peak_pressure_pa(q * n as f64)).collect();
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::SliceRatio;

    const E_STAR: f64 = 206e9 / (2.0 * 0.91);

    fn contact() -> LineContact {
        LineContact::external(11.11e-3, 4.02e-3, 6e-3, E_STAR).unwrap()
    }

    fn slices(n: usize) -> SliceContact {
        SliceContact::new(contact(), RollerLaw::new(&contact(), 3.944e-5).unwrap(), n).unwrap()
    }

    /// Parabolic crown of end drop `drop_m`.
    fn crown(n: usize, drop_m: f64) -> Vec<f64> {
        (0..n).map(|j| drop_m * (2.0 * (j as f64 + 0.5) / n as f64 - 1.0).powi(2)).collect()
    }

    #[test]
    fn eq_1_a_rigid_approach_deflects_every_slice_alike() {
        for n in [1, 2, 31, 60] {
            let found = slices(n).solve(1558.0).unwrap();
            assert_eq!(found.status, SliceStatus::Closed);
            assert!((found.load_n.iter().sum::<f64>() / 1558.0 - 1.0).abs() < 1e-13);
            for d in &found.deflection_m {
                assert!((d / found.approach_m - 1.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn eq_3_loads_are_symmetric_and_largest_at_the_ends() {
        let found = slices(60).solve(1558.0).unwrap();
        for j in 0..30 {
            assert!((found.load_n[j] / found.load_n[59 - j] - 1.0).abs() < 1e-11);
            assert!(j == 0 || found.load_n[j] < found.load_n[j - 1]);
        }
        assert!(found.peak_slice == 0 || found.peak_slice == 59);
        // p_j^2 is proportional to q_j: the mean square is Hertz's p_0 at the mean load
        let square = found.pressure_pa.iter().map(|p| p * p).sum::<f64>() / 60.0;
        assert!((square.sqrt() / contact().peak_pressure_pa(1558.0) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn eq_4_a_uniform_load_has_the_mean_deflection_of_the_roller_law() {
        // one slice is a uniform load; n slices mean delta_H = s q for it, so a rigid approach is below
        let roller = RollerLaw::new(&contact(), 3.944e-5).unwrap();
        let one = slices(1).solve(1558.0).unwrap();
        assert!((one.deflection_m[0] / roller.approach_m(1558.0) - 1.0).abs() < 1e-13);
        assert!(slices(60).solve(1558.0).unwrap().approach_m < one.approach_m);
    }

    #[test]
    fn the_ratio_table_returns_the_solved_approach() {
        let ratio = SliceRatio::new(60).unwrap();
        let roller = RollerLaw::new(&contact(), 3.944e-5).unwrap();
        // both ends beyond the table, where both hold a/l
        for n in [1e-12, 1e-4, 3.0, 1558.0, 8384.0, 3e5, 1e9] {
            let found = slices(60).solve(n).unwrap();
            let kappa = ratio.at(found.half_width_m / 6e-3).0;
            let off = found.approach_m / (kappa * roller.approach_m(n)) - 1.0;
            assert!(off.abs() < 1e-9, "{n}: {off}");
        }
    }

    #[test]
    fn end_loads_grow_about_as_n_to_the_0_35() {
        let ratio = |n: usize| {
            let found = slices(n).solve(2441.0).unwrap();
            found.load_n[0] / (2441.0 / n as f64)
        };
        let exponent = (ratio(60) / ratio(30)).log2();
        let later = (ratio(480) / ratio(240)).log2();
        println!(
            "end load/mean {} {} {}: n^{exponent:.3}, at 240-480 n^{later:.3}",
            ratio(30),
            ratio(60),
            ratio(120)
        );
        assert!((0.3..0.4).contains(&exponent), "{exponent}");
        assert!(exponent < later && later < 0.5, "{later}");
    }

    #[test]
    fn an_open_contact_satisfies_the_unilateral_conditions() {
        // a deep crown at small load opens the ends; so does a tilt, at one end
        let tilt: Vec<f64> = (0..60).map(|j| 8e-6 * (j as f64 + 0.5) / 60.0).collect();
        for (n, gap) in [(300.0, crown(60, 20e-6)), (200.0, tilt)] {
            let found = slices(60).solve_with_gap(n, &gap).unwrap();
            let SliceStatus::PartlyOpen { open } = found.status else { panic!("{:?}", found.status) };
            assert!(open > 0 && open < 60);
            assert_eq!(found.load_n.iter().filter(|q| **q == 0.0).count(), open);
            assert!((found.load_n.iter().sum::<f64>() / n - 1.0).abs() < 1e-12);
            for (j, gap) in gap.iter().enumerate() {
                let clearance = found.deflection_m[j] - (found.approach_m - gap);
                let tiny = 1e-12 * found.approach_m;
                assert!(found.load_n[j] >= 0.0 && clearance > -tiny);
                assert!(found.load_n[j] == 0.0 || clearance.abs() < tiny);
            }
        }
    }

    #[test]
    fn clarabel_finds_the_same_open_contact() {
        // min q S q/2 + gap q, q >= 0, sum q = N; in units of N/n and of the approach
        use clarabel::algebra::CscMatrix;
        use clarabel::solver::{DefaultSettingsBuilder, DefaultSolver, IPSolver, SupportedConeT};
        let (n, normal_n) = (40, 300.0);
        let gap = crown(n, 20e-6);
        let found = slices(n).solve_with_gap(normal_n, &gap).unwrap();
        let (unit_n, unit_m) = (normal_n / n as f64, found.approach_m);
        let w = influence_m_per_pa(found.half_width_m, 6e-3 / n as f64, n, E_STAR);
        let s = n as f64 * slices(n).roller.approach_m(normal_n) / normal_n;
        let matrix = weighted_influence_m_per_n(&w, s);
        let upper: Vec<Vec<f64>> = (0..n)
            .map(|j| (0..n).map(|k| if k >= j { matrix[(j, k)] * unit_n / unit_m } else { 0.0 }).collect())
            .collect();
        let linear: Vec<f64> = gap.iter().map(|g| g / unit_m).collect();
        let mut rows = vec![vec![1.0; n]];
        rows.extend((0..n).map(|j| (0..n).map(|k| if j == k { -1.0 } else { 0.0 }).collect()));
        let mut right = vec![n as f64];
        right.resize(n + 1, 0.0);
        let cones = [SupportedConeT::ZeroConeT(1), SupportedConeT::NonnegativeConeT(n)];
        let settings = DefaultSettingsBuilder::default()
            .verbose(false)
            .tol_gap_abs(1e-12)
            .tol_gap_rel(1e-12)
            .tol_feas(1e-12)
            .build()
            .unwrap();
        let mut solver = DefaultSolver::new(
            &CscMatrix::from(&upper),
            &linear,
            &CscMatrix::from(&rows),
            &right,
            &cones,
            settings,
        )
        .unwrap();
        solver.solve();
        for (mine, theirs) in found.load_n.iter().zip(&solver.solution.x) {
            assert!((mine / unit_n - theirs).abs() < 1e-6, "{} {theirs}", mine / unit_n);
        }
    }

    #[test]
    fn no_force_and_bad_questions_have_answers() {
        for n in [0.0, -1.0, f64::NAN] {
            let found = slices(5).solve(n).unwrap();
            assert_eq!(found.status, SliceStatus::Unloaded);
            assert!(found.load_n.iter().all(|q| *q == 0.0) && found.approach_m == 0.0);
        }
        let refused = |gap: &[f64]| slices(3).solve_with_gap(1.0, gap).unwrap_err();
        assert_eq!(refused(&[0.0; 2]), ContactError::Gap { slices: 3, finite: 2 });
        assert_eq!(refused(&[0.0, f64::NAN, 0.0]), ContactError::Gap { slices: 3, finite: 2 });
        assert!(matches!(slices(3).solve(f64::INFINITY), Err(ContactError::NotPositive { .. })));
        let roller = RollerLaw::new(&contact(), 3.944e-5).unwrap();
        for n in [0, SliceContact::MOST_SLICES + 1] {
            assert!(matches!(SliceContact::new(contact(), roller, n), Err(ContactError::Slices { .. })));
        }
    }
}
