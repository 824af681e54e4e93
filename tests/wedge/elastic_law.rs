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
    // Of plane strain and plane stress this is the curve of the clutch.
    WedgeCurve::build_as_deck(&clutch, &profile).unwrap()
}

/// Torque, normal force, windup (deg) and tan omega of the rows whose model is in the given state.
fn rows(state: StressState) -> Vec<[f64; 4]> {
    rows_of(include_str!("../reference/fem_single_arc.csv"), state)
}

fn rows_of(table: &str, state: StressState) -> Vec<[f64; 4]> {
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
            // Some rows have no pressure.
            (of == state).then(|| [v[0], v[1], v[2], v[v.len() - 1]])
        })
        .collect()
}

/// Windup rim against rim, as finite elements have it: with the torsion of the races.
fn with_torsion_deg(curve: &WedgeCurve, torque_nm: f64) -> f64 {
    let elastic = &curve.statics().elastic;
    let races = [&elastic.inner_race, &elastic.outer_race];
    let twist: f64 = races.iter().filter_map(|race| race.twist_rad_per_nm()).sum();
    (curve.at_torque(torque_nm).unwrap().windup_rad + torque_nm * twist).to_degrees()
}

/// The tables are good to 0.3 % of windup.
fn within(curve: &WedgeCurve, rows: &[[f64; 4]], largest: f64, what: &str) {
    for &[torque, normal, windup, tan] in rows {
        let p = curve.at_torque(torque).unwrap();
        let error = with_torsion_deg(curve, torque) / windup - 1.0;
        let (force, angle) = (p.normal_inner_n / normal - 1.0, p.tan_omega / tan - 1.0);
        let percent = [error, force, angle].map(|e| 100.0 * e);
        println!(
            "{what} {torque} Nm: windup {:+.2} %, N {:+.2} %, tan {:+.2} %",
            percent[0], percent[1], percent[2]
        );
        assert!(error.abs() < largest, "{what} {torque} Nm: windup {error:+.4}");
        assert!(force.abs() < 0.0015 && angle.abs() < 0.002, "{what} {torque} Nm: {force:+.4} {angle:+.4}");
    }
}

#[test]
fn windup_and_forces_are_those_of_finite_elements_in_every_stress_state() {
    for (state, count) in
        [(StressState::Layer, 6), (StressState::PlaneStress, 4), (StressState::PlaneStrain, 4)]
    {
        let rows = rows(state);
        assert_eq!(rows.len(), count);
        within(&curve(ContactLaw::Elastic { state }, |_| {}), &rows, 0.0015, &format!("{state:?}"));
    }
}

/// Another clutch: twice the sprags, races 2.5 times as large, two arcs; and Table 1's with three arcs.
#[test]
fn windup_and_forces_are_those_of_finite_elements_on_other_geometries() {
    let table = include_str!("../reference/fem_24_sprags.csv");
    for (state, count) in
        [(StressState::Layer, 3), (StressState::PlaneStress, 5), (StressState::PlaneStrain, 5)]
    {
        // The decks have races as long as the sprags.
        let curve = curve_of("fe-check-24", ContactLaw::Elastic { state }, |c| c.races.width_m = 13e-3);
        let rows = rows_of(table, state);
        assert_eq!(rows.len(), count);
        within(&curve, &rows, 0.0025, &format!("24 sprags, {state:?}"));
    }
    let rows = rows_of(include_str!("../reference/fem_multi_arc.csv"), StressState::Layer);
    assert_eq!(rows.len(), 5);
    let law = ContactLaw::Elastic { state: StressState::Layer };
    within(&curve_of("huang2017-multi-arc", law, |_| {}), &rows, 0.0015, "three arcs");
}

/// Sprags 0.4 as wide as high that carry near a flank: as a disc the law was off by 2.1 % of windup and 0.8 % of tan omega.
#[test]
fn a_flank_beside_the_contacts_is_felt() {
    let clutch = Design::read(Path::new("tests/reference/narrow_sprags.toml")).unwrap().clutch;
    let curve = WedgeCurve::build_as_deck(&clutch, &clutch.profile().unwrap()).unwrap();
    let table = include_str!("../../reports/calculix-ten-decks.csv");
    let rows: Vec<[f64; 4]> = table
        .lines()
        .filter_map(|line| line.strip_prefix("\"bore of 100 mm, 9000 Nm\","))
        .map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            [1, 6, 4, 8].map(|i| cells[i].parse().unwrap())
        })
        .collect();
    assert_eq!(rows.len(), 3);
    within(&curve, &rows, 0.004, "narrow sprags");
}

/// The outline's compliance is an energy: what torque does on windup is what contacts and rings take, per force and way, and
/// d(n^2 C/2). That holds because the force stands where the slope of C puts it.
#[test]
fn the_outline_stores_what_it_takes() {
    let curve = {
        let clutch = Design::read(Path::new("tests/reference/narrow_sprags.toml")).unwrap().clutch;
        WedgeCurve::build(&clutch, &clutch.profile().unwrap(), 0.0).unwrap()
    };
    let count = curve.statics().count;
    let mut moment: f64 = 0.0;
    for share in [0.01, 0.1, 0.3, 0.5, 0.7] {
        let (_, c) = curve.closure_at_normal(share * curve.arc_end_n(0)).unwrap();
        let d = &c.deformations;
        let taken =
            c.n_bi * (d.race_inner.d + d.contact_inner.d) + c.n_be.v * (d.race_outer.d + d.contact_outer.d);
        let along = c.t_bi.v * c.give_m_per_n[0] + c.t_be.v * c.give_m_per_n[1];
        let stored = 0.5 * (c.n_bi * d.bulk.d + d.bulk.v);
        let work = c.torque_nm(count).v / count as f64 * c.windup_slope();
        let off = (taken + along + stored) / work - 1.0;
        let without = (taken + along + c.n_bi * d.bulk.d) / work - 1.0;
        println!("{share}: off by {off:.1e}, by {without:.1e} with the force at the contact point");
        assert!(off.abs() < 2e-5, "{share}: {off:e}");
        moment = moment.max(without);
    }
    assert!(moment > 3e-3, "{moment:e}");
}

/// Races 12 mm wide on the same 6 mm sprags (same source).
#[test]
fn windup_within_half_a_per_cent_for_races_twice_as_wide() {
    let curve = curve(ContactLaw::Elastic { state: StressState::Layer }, |c| c.races.width_m = 12e-3);
    for (torque, windup) in [(3.34, 0.302), (10.0, 0.822), (16.8, 1.316)] {
        let error = with_torsion_deg(&curve, torque) / windup - 1.0;
        println!("wide races, {torque} Nm: windup {:+.2} %", 100.0 * error);
        assert!(error.abs() < 0.005, "{torque} Nm: {error:+.4}");
    }
}

/// What the paper's own laws miss, so that a change is noticed: 12-13.5 % too soft at 6 mm.
#[test]
fn the_papers_laws_are_too_soft() {
    for law in [ContactLaw::Roller { coefficient: 3.944e-5 }, ContactLaw::Slice { coefficient: 3.944e-5 }] {
        let curve = curve(law, |_| {});
        for [torque, _, windup, _] in rows(StressState::Layer) {
            let error = curve.at_torque(torque).unwrap().windup_rad.to_degrees() / windup - 1.0;
            println!("{law:?} {torque} Nm: windup {:+.2} %", 100.0 * error);
            assert!((0.10..0.14).contains(&error), "{law:?} {torque} Nm: {error:+.4}");
        }
    }
}
