//! Literature test: the unilateral slice contact as the quadratic program that it is, solved by clarabel's
//! interior-point method.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettingsBuilder, DefaultSolver, IPSolver, SupportedConeT};
use sprag_design::contact::{
    AxialFit, EndDrop, LineContact, RollerLaw, SliceContact, SliceStatus, influence_m_per_pa,
    weighted_influence_m_per_n,
};

const LENGTH_M: f64 = 6e-3;

fn contact() -> LineContact {
    LineContact::external(11.11e-3, 4.02e-3, LENGTH_M, 206e9 / 1.82).unwrap()
}

/// min q S q/2 + gap q with q >= 0 and sum q = N, in units of N/n and of `unit_m`: loads and approach.
fn by_clarabel(normal_n: f64, half_width_m: f64, gap_m: &[f64], unit_m: f64) -> (Vec<f64>, f64) {
    let n = gap_m.len();
    let c = contact();
    let unit_n = normal_n / n as f64;
    let s = n as f64 * RollerLaw::new(&c, 3.944e-5).unwrap().approach_m(normal_n) / normal_n;
    let w = influence_m_per_pa(half_width_m, LENGTH_M / n as f64, n, c.contact_modulus_pa);
    let row = weighted_influence_m_per_n(&w, s);
    let upper: Vec<Vec<f64>> = (0..n)
        .map(|j| (0..n).map(|k| if k >= j { row[k - j] * unit_n / unit_m } else { 0.0 }).collect())
        .collect();
    let linear: Vec<f64> = gap_m.iter().map(|g| g / unit_m).collect();
    let mut rows = vec![vec![1.0; n]];
    rows.extend((0..n).map(|j| (0..n).map(|k| if j == k { -1.0 } else { 0.0 }).collect()));
    let mut right = vec![n as f64];
    right.resize(n + 1, 0.0);
    let cones = [SupportedConeT::ZeroConeT(1), SupportedConeT::NonnegativeConeT(n)];
    let settings = DefaultSettingsBuilder::default()
        .verbose(false)
        .tol_gap_abs(1e-15)
        .tol_gap_rel(1e-15)
        .tol_feas(1e-15)
        .max_iter(100)
        .build()
        .unwrap();
    let program = DefaultSolver::new(
        &CscMatrix::from(&upper),
        &linear,
        &CscMatrix::from(&rows),
        &right,
        &cones,
        settings,
    );
    let mut program = program.unwrap();
    program.solve();
    // the multiplier of the sum is minus the approach
    (program.solution.x.iter().map(|q| q * unit_n).collect(), -program.solution.z[0] * unit_m)
}

#[test]
fn clarabel_finds_the_same_loads_and_approach() {
    let c = contact();
    let crown = EndDrop::crown_radius(0.225, LENGTH_M).unwrap();
    let lundberg = EndDrop::lundberg(&c, 2441.0).unwrap();
    let wave = EndDrop::table(
        (0..=30).map(|i| [(i as f64 / 15.0 - 1.0) * 3e-3, if i % 3 == 0 { 0.0 } else { 2e-6 }]).collect(),
    );
    let cases = [
        ("square", EndDrop::Square, 0.0, 2441.0),
        ("crown", crown, 0.0, 300.0),
        ("tilted", EndDrop::Square, 1.5e-3, 200.0),
        ("Lundberg, tilted", lundberg, -5e-4, 1000.0),
        ("wavy", wave.unwrap(), 0.0, 150.0),
    ];
    for (name, profile, tilt, normal_n) in cases {
        let fit = AxialFit::shaped(LENGTH_M, profile, tilt).unwrap();
        for n in [13, 40, 60] {
            let roller = RollerLaw::new(&c, 3.944e-5).unwrap();
            let found = SliceContact::new(c, roller, n).unwrap().solve_along(normal_n, &fit).unwrap();
            let open = found.load_n.iter().filter(|q| **q == 0.0).count();
            assert_eq!(open == 0, found.status == SliceStatus::Closed);
            let gap = fit.gaps_m(n);
            let (load_n, approach_m) = by_clarabel(normal_n, found.half_width_m, &gap, found.approach_m);
            let worst = found.load_n.iter().zip(&load_n).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            let (worst, off) = (worst * n as f64 / normal_n, approach_m / found.approach_m - 1.0);
            println!("{name}, {n} slices, {open} open: loads differ by {worst:.1e}, approach {off:.1e}");
            assert!(worst < 1e-8 && off.abs() < 1e-8, "{name} {n}");
        }
    }
}
