//! Identities of the slice contact at the ends of its range.

use sprag_design::contact::{
    AxialFit, ContactError, EndDrop, LineContact, RollerLaw, SliceCompliance, SliceContact, SliceSolution,
    SliceStatus,
};

fn contact(length_m: f64, contact_modulus_pa: f64) -> LineContact {
    LineContact::external(11.11e-3, 4.02e-3, length_m, contact_modulus_pa).unwrap()
}

fn both(contact: LineContact, slices: usize) -> [SliceContact; 2] {
    let roller = RollerLaw::new(&contact, 3.944e-5).unwrap();
    [SliceCompliance::Roller(roller), SliceCompliance::HalfSpace]
        .map(|law| SliceContact::with_compliance(contact, law, slices).unwrap())
}

/// Finite, unilateral, in balance.
fn sound(found: &SliceSolution, gap_m: &[f64], normal_n: f64) {
    assert!(!matches!(found.status, SliceStatus::NoConvergence { .. }), "{:?}", found.status);
    assert!(found.approach_m.is_finite() && found.approach_m > 0.0);
    assert!((found.load_n.iter().sum::<f64>() / normal_n - 1.0).abs() < 1e-10);
    let tiny = 3e-11 * found.approach_m;
    for (j, gap) in gap_m.iter().enumerate() {
        let clearance = found.deflection_m[j] - (found.approach_m - gap);
        assert!(found.pressure_pa[j].is_finite() && found.load_n[j] >= 0.0);
        assert!(clearance > -tiny && (found.load_n[j] == 0.0 || clearance < tiny), "{j}: {clearance:e}");
    }
}

#[test]
fn every_corner_of_the_range_has_a_sound_answer() {
    // E* of polymer (1 GPa) and ceramic (300 GPa) pairs
    for modulus in [0.6e9, 113e9, 165e9] {
        for length_m in [0.1e-3, 6e-3, 100e-3] {
            let c = contact(length_m, modulus);
            for slices in [1, 2, 60, 2000] {
                for tilt in [0.0, 1e-3] {
                    let fit = AxialFit::shaped(length_m, EndDrop::Square, tilt).unwrap();
                    let gap = fit.gaps_m(slices);
                    for law in both(c, slices) {
                        let mut last = 0.0;
                        for normal_n in [1e-6, 1.0, 1e3, 1e6] {
                            let found = law.solve_along(normal_n, &fit).unwrap();
                            sound(&found, &gap, normal_n);
                            assert!(found.approach_m > last, "{modulus} {length_m} {slices} {normal_n}");
                            last = found.approach_m;
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn approach_and_every_load_rise_with_the_force() {
    let c = contact(6e-3, 113e9);
    let crown = EndDrop::crown_radius(0.5, 6e-3).unwrap();
    for (profile, tilt) in [(EndDrop::Square, 0.0), (EndDrop::Square, 2e-3), (crown, 1e-3)] {
        let fit = AxialFit::shaped(6e-3, profile, tilt).unwrap();
        for law in both(c, 60) {
            let mut last = law.solve_along(1e-6, &fit).unwrap();
            for step in 1..=120 {
                let normal_n = 1e-6 * 10f64.powf(step as f64 / 10.0);
                let found = law.solve_along(normal_n, &fit).unwrap();
                assert!(found.approach_m > last.approach_m, "{normal_n}");
                let open = |s: &SliceSolution| s.load_n.iter().filter(|q| **q == 0.0).count();
                assert!(open(&found) <= open(&last), "{normal_n}");
                last = found;
            }
        }
    }
}

#[test]
fn a_tilt_that_lifts_half_the_length_leaves_the_other_half() {
    let c = contact(6e-3, 113e9);
    for law in both(c, 200) {
        // the force at which half is open, by bisection: the open count falls with the force
        let fit = AxialFit::shaped(6e-3, EndDrop::Square, 1e-3).unwrap();
        let open = |n: f64| law.solve_along(n, &fit).unwrap().load_n.iter().filter(|q| **q == 0.0).count();
        let (mut low, mut high) = (1e-3f64, 1e5f64);
        for _ in 0..60 {
            let middle = (low * high).sqrt();
            if open(middle) > 100 { low = middle } else { high = middle }
        }
        let found = law.solve_along(high, &fit).unwrap();
        assert_eq!(open(high), 100);
        sound(&found, &fit.gaps_m(200), high);
        // mirrored tilt, mirrored loads
        let mirrored = AxialFit::shaped(6e-3, EndDrop::Square, -1e-3).unwrap();
        let other = law.solve_along(high, &mirrored).unwrap();
        for j in 0..200 {
            let off = found.load_n[j] - other.load_n[199 - j];
            assert!(off.abs() < 1e-9 * high / 200.0, "{j}: {off}");
        }
    }
}

#[test]
fn symmetric_bodies_have_symmetric_loads_at_any_number_of_slices() {
    let c = contact(6e-3, 113e9);
    let lundberg = EndDrop::lundberg(&c, 2441.0).unwrap();
    for profile in [EndDrop::Square, lundberg] {
        let fit = AxialFit::shaped(6e-3, profile, 0.0).unwrap();
        for slices in [2, 61, 500, 2000] {
            for law in both(c, slices) {
                let found = law.solve_along(2441.0, &fit).unwrap();
                for j in 0..slices / 2 {
                    let (a, b) = (found.load_n[j], found.load_n[slices - 1 - j]);
                    assert!((a - b).abs() < 1e-9 * 2441.0 / slices as f64, "{slices} {j}: {a} {b}");
                }
            }
        }
    }
}

#[test]
fn more_slices_tend_to_one_approach() {
    let c = contact(6e-3, 113e9);
    let fit = AxialFit::shaped(6e-3, EndDrop::crown_radius(0.5, 6e-3).unwrap(), 5e-4).unwrap();
    for index in [0, 1] {
        let at = |n: usize| both(c, n)[index].solve_along(1000.0, &fit).unwrap().approach_m;
        let finest = at(2000);
        // first order at least; the edge of the closed part falls now here, now there in a slice
        for n in [10, 20, 40, 80, 160, 320] {
            let off = (at(n) / finest - 1.0).abs();
            println!("{n}: {off:e}");
            assert!(off < 0.05 / n as f64, "{n}: {off}");
        }
    }
}

#[test]
fn bad_questions_are_refused() {
    let c = contact(6e-3, 113e9);
    let roller = RollerLaw::new(&c, 3.944e-5).unwrap();
    for slices in [0, SliceContact::MOST_SLICES + 1, usize::MAX] {
        let refused = Err(ContactError::Slices { slices });
        assert_eq!(SliceContact::new(c, roller, slices), refused);
    }
    let fit = AxialFit::square(6e-3).unwrap();
    for law in both(c, 10) {
        assert!(matches!(law.solve_along(f64::INFINITY, &fit), Err(ContactError::NotPositive { .. })));
        assert_eq!(law.solve_along(f64::NAN, &fit).unwrap().status, SliceStatus::Unloaded);
        assert_eq!(law.solve_along(-1.0, &fit).unwrap().status, SliceStatus::Unloaded);
    }
}
