//! The elastic law against finite elements. Nothing in it was fitted to them.
//!
//! Sources: CalculiX 2.20, one sector with cyclic symmetry, large rotations, frictional contact. Table 1's geometry
//! with one arc is independent of this project (tests/reference/fem_single_arc.csv, windup good to 0.3 %); three arcs
//! and the clutch of 24 sprags are this project's own (`reports/compute_fem_references.sh`).

use std::path::Path;

use sprag_design::clutch::{Clutch, ContactLaw, StressState};
use sprag_design::design::Design;
use sprag_design::wedge::WedgeCurve;

fn curve(law: ContactLaw, change: impl Fn(&mut Clutch)) -> WedgeCurve {
    curve_of("huang2017-single-arc", law, change)
}

fn curve_of(design: &str, law: ContactLaw, change: impl Fn(&mut Clutch)) -> WedgeCurve {
    let mut clutch = Design::read(Path::new(&format!("designs/{design}.toml"))).unwrap().clutch;
    clutch.contact = law;
    change(&mut clutch);
    let profile = clutch.profile().unwrap();
    WedgeCurve::build(&clutch, &profile, 0.0).unwrap()
}

/// (torque, normal force, windup deg) of the rows whose model is in the given state.
fn rows(state: StressState) -> Vec<(f64, f64, f64)> {
    rows_of(include_str!("reference/fem_single_arc.csv"), state)
}

fn rows_of(table: &str, state: StressState) -> Vec<(f64, f64, f64)> {
    table
        .lines()
        .skip(1)
        .filter_map(|line| {
            // The model's name is quoted and holds commas.
            let (model, rest) = line.trim_start_matches('"').split_once("\",")?;
            let of = if model.contains("true plane stress") {
                StressState::PlaneStress
            } else if model.contains("2-D, plane strain") {
                StressState::PlaneStrain
            } else {
                StressState::Layer
            };
            let v: Vec<f64> = rest.split(',').filter_map(|f| f.parse().ok()).collect();
            (of == state).then(|| (v[0], v[1], v[2]))
        })
        .collect()
}

fn within_two_per_cent(curve: &WedgeCurve, rows: &[(f64, f64, f64)], what: &str) {
    for &(torque, normal, windup) in rows {
        let p = curve.at_torque(torque).unwrap();
        let error = p.windup_rad.to_degrees() / windup - 1.0;
        let force = p.normal_inner_n / normal - 1.0;
        println!("{what} {torque} Nm: windup {:+.2} %, N {:+.2} %", 100.0 * error, 100.0 * force);
        assert!(error.abs() < 0.02 && force.abs() < 0.015, "{what} {torque} Nm: {error:+.4} {force:+.4}");
    }
}

#[test]
fn windup_within_two_per_cent_of_finite_elements_in_every_stress_state() {
    for (state, count) in
        [(StressState::Layer, 6), (StressState::PlaneStress, 4), (StressState::PlaneStrain, 4)]
    {
        let rows = rows(state);
        assert_eq!(rows.len(), count);
        within_two_per_cent(&curve(ContactLaw::Elastic { state }, |_| {}), &rows, &format!("{state:?}"));
    }
}

/// Another clutch: twice the sprags, races 2.5 times as large, two arcs; and Table 1's with three arcs.
#[test]
fn windup_within_two_per_cent_on_other_geometries() {
    let table = include_str!("reference/fem_24_sprags.csv");
    for (state, count) in
        [(StressState::Layer, 3), (StressState::PlaneStress, 5), (StressState::PlaneStrain, 5)]
    {
        // The decks have races as long as the sprags.
        let curve = curve_of("fe-check-24", ContactLaw::Elastic { state }, |c| c.races.width_m = 13e-3);
        let rows = rows_of(table, state);
        assert_eq!(rows.len(), count);
        within_two_per_cent(&curve, &rows, &format!("24 sprags, {state:?}"));
    }
    let rows = rows_of(include_str!("reference/fem_multi_arc.csv"), StressState::Layer);
    assert_eq!(rows.len(), 5);
    let law = ContactLaw::Elastic { state: StressState::Layer };
    within_two_per_cent(&curve_of("huang2017-multi-arc", law, |_| {}), &rows, "three arcs");
}

/// Races 12 mm wide on the same 6 mm sprags (same source).
#[test]
fn windup_within_three_per_cent_for_races_twice_as_wide() {
    let curve = curve(ContactLaw::Elastic { state: StressState::Layer }, |c| c.races.width_m = 12e-3);
    for (torque, windup) in [(3.34, 0.302), (10.0, 0.822), (16.8, 1.316)] {
        let error = curve.at_torque(torque).unwrap().windup_rad.to_degrees() / windup - 1.0;
        println!("wide races, {torque} Nm: windup {:+.2} %", 100.0 * error);
        assert!(error.abs() < 0.03, "{torque} Nm: {error:+.4}");
    }
}

/// What the paper's own laws miss, so that a change is noticed: 12-13.5 % too soft at 6 mm.
#[test]
fn the_papers_laws_are_too_soft() {
    for law in [ContactLaw::Roller { coefficient: 3.944e-5 }, ContactLaw::Slice { coefficient: 3.944e-5 }] {
        let curve = curve(law, |_| {});
        for (torque, _, windup) in rows(StressState::Layer) {
            let error = curve.at_torque(torque).unwrap().windup_rad.to_degrees() / windup - 1.0;
            println!("{law:?} {torque} Nm: windup {:+.2} %", 100.0 * error);
            assert!((0.10..0.14).contains(&error), "{law:?} {torque} Nm: {error:+.4}");
        }
    }
}
