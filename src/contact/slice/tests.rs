//! What (1)-(4) promise, on the inner contact of the Huang clutch.

use super::*;
use crate::contact::{EndDrop, Flank, SliceRatio};

const E_STAR: f64 = 206e9 / (2.0 * 0.91);

fn contact() -> LineContact {
    LineContact::external(11.11e-3, 4.02e-3, 6e-3, E_STAR).unwrap()
}

fn slices(n: usize) -> SliceContact {
    SliceContact::new(contact(), RollerLaw::new(&contact(), 3.944e-5).unwrap(), n).unwrap()
}

impl SliceContact {
    fn on_half_spaces(self) -> Self {
        Self { compliance: SliceCompliance::HalfSpace, ..self }
    }
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
fn a_sharp_end_has_no_value_of_its_own() {
    let square = AxialFit::square(6e-3).unwrap();
    let found = slices(60).solve_along(2441.0, &square).unwrap();
    let wanted = Edge::Singular { value_at_slice_width_pa: found.pressure_pa[0], slice_width_m: 1e-4 };
    assert_eq!(found.edges[0], wanted);
    assert!(matches!(found.peak, Peak::AtEnd { edge: Edge::Singular { .. }, .. }));
    assert!(matches!(slices(1).solve(1.0).unwrap().edges, [Edge::Singular { .. }, Edge::Singular { .. }]));
    // a crown that opens has a peak; overloaded, its ends bear and rise again
    let crown = AxialFit::shaped(6e-3, EndDrop::crown_radius(0.5, 6e-3).unwrap(), 0.0).unwrap();
    let light = slices(61).solve_along(100.0, &crown).unwrap();
    assert_eq!(light.edges, [Edge::Open; 2]);
    let Peak::Bounded { y_m, pressure_pa } = light.peak else { panic!("{:?}", light.peak) };
    assert!(y_m.abs() < 1e-18 && pressure_pa == light.pressure_pa[30]);
    // with the force each end bears, then turns sharp
    let rank = |normal_n: f64| match slices(61).solve_along(normal_n, &crown).unwrap().edges[0] {
        Edge::Open => 0,
        Edge::Bounded { .. } => 1,
        Edge::Singular { .. } => 2,
        Edge::Flush { .. } => 3,
    };
    let ranks: Vec<usize> = (0..60).map(|i| rank(100.0 * 1.1f64.powi(i))).collect();
    assert!(ranks.is_sorted() && [0, 1, 2].iter().all(|r| ranks.contains(r)), "{ranks:?}");
    // flush with the race: quarter-spaces
    let flush = AxialFit::new([Flank::straight(6e-3), Flank::straight(6e-3)], 0.0).unwrap();
    assert!(matches!(slices(9).solve_along(1.0, &flush).unwrap().edges[1], Edge::Flush { .. }));
    let short = AxialFit::square(5e-3).unwrap();
    assert!(matches!(slices(9).solve_along(1.0, &short), Err(ContactError::Length { .. })));
}

#[test]
fn scattered_closed_slices_are_found_too() {
    // a wavy flank bears on its crests: not a Toeplitz system
    let gap: Vec<f64> = (0..90).map(|j| 2e-6 * (1.0 - (j as f64 * 0.6).cos())).collect();
    for contact in [slices(90), slices(90).on_half_spaces()] {
        let found = contact.solve_with_gap(150.0, &gap).unwrap();
        assert!(matches!(found.status, SliceStatus::PartlyOpen { .. }), "{:?}", found.status);
        let groups = found.load_n.windows(2).filter(|q| (q[0] == 0.0) != (q[1] == 0.0)).count();
        assert!(groups > 6, "{groups}");
        for (j, gap) in gap.iter().enumerate() {
            let clearance = found.deflection_m[j] - (found.approach_m - gap);
            let tiny = 2e-12 * found.approach_m;
            assert!(found.load_n[j] >= 0.0 && clearance > -tiny);
            assert!(found.load_n[j] == 0.0 || clearance.abs() < tiny);
        }
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
