//! Wear of sprags that a cage carries with the inner race: the flat on the outer arc, and what becomes of the clutch.

use crate::worn::worn_off_m3;
use sprag_design::Design;
use sprag_design::answer::Answer;
use sprag_design::clutch::{ContactLaw, Service};
use sprag_design::life::{Broken, Life, Wear, life, worn, worn_life, worn_state};
use sprag_design::lubrication::flat_depth_m;
use sprag_design::margin::{LIFT_OFF_TO_RAD_S, LoadState, lift_off_rad_s, load_state, overrun_at};
use sprag_design::wedge::WedgeCurve;
use std::f64::consts::{PI, TAU};

const FILE: &str = "designs/lift-off-inner.toml";

/// The clutch of the file with room outside its pivots, and a life of `hours` of overrun at `rpm` of the inner race.
fn design(clearance_um: f64, rpm: f64, hours: f64) -> Design {
    let text = std::fs::read_to_string(FILE).unwrap();
    let text = text.replace(
        "inertia_kg_m2 = 4.0e-4",
        &format!("inertia_kg_m2 = 4.0e-4\nclearance_um = {clearance_um:?}"),
    ) + &format!(
        "\n[[scenarios]]\nname = \"free\"\nkind = \"overrun\"\nspeed_rpm = 0.0\noverrun_rpm = {rpm:?}\n\
             [life]\nloads = [ {{ torque_nm = 700.0, engagements = 1e4 }} ]\n\
             overruns = [ {{ scenario = \"free\", hours = {hours:?} }} ]\n"
    );
    Design::parse(&text, FILE).unwrap_or_else(|error| panic!("{error}"))
}

fn of(design: &Design) -> (Service, Life, LoadState) {
    let service = design.service.clone().unwrap();
    (service.clone(), life(design, &service).unwrap(), load_state(design).unwrap())
}

/// The worn sprags as they overrun.
fn idle(design: &Design, state: &LoadState, wear: &Wear) -> (Design, LoadState) {
    let found = worn(design, state, wear).unwrap();
    let seated = found.outside.unwrap().seated;
    let profile = seated.profile().unwrap();
    let curve = WedgeCurve::build(&seated, &profile, 0.0).unwrap();
    let alpha_max_rad = state.alpha_max_rad - found.turned_rad;
    (
        Design { clutch: seated, ..design.clone() },
        LoadState { profile, curve, alpha_max_rad, ..state.clone() },
    )
}

/// Of `tests/reference/worn_outside.py`: geometry of the flat, forces on it and lift-off, dry.
#[test]
fn flat_and_forces_are_those_of_the_script() {
    let mut design = design(20.0, 200.0, 1.0);
    design.clutch.lubrication = None;
    design.clutch.friction.static_ = 0.1;
    design.clutch.friction.kinetic = 0.1;
    design.clutch.friction.decay_s_per_m = 0.0;
    // Its edge is as sharp as 0.5 % of the arc.
    design.clutch.contact = ContactLaw::Din26281;
    let state = load_state(&design).unwrap();
    let table = std::fs::read_to_string("tests/reference/worn_outside.csv").unwrap();
    for line in table.lines().skip(1) {
        let row: Vec<f64> = line.split(',').map(|x| x.parse().unwrap()).collect();
        let [flat_m, volume_m3, turned, out_um, tan, edge_turn, n_a, n_b, off_rpm] = row[..] else {
            panic!("{line}")
        };
        let flat_m = 1e-6 * flat_m;
        // The volume of the parabola through the edges differs from that of the lens by parts in a thousand.
        let relative_m = 1.0 / (1.0 / 8.6e-3 - 1.0 / 50e-3);
        let said_m = flat_depth_m(1e-9 * volume_m3, relative_m, 18e-3, 0.0);
        assert!((said_m / flat_m - 1.0).abs() < 4e-3, "{line}: {said_m}");
        let volume = (flat_m / flat_depth_m(1.0, relative_m, 18e-3, 0.0)).powf(1.5);
        let wear = Wear { sprag_m3: volume, ..Wear::default() };
        let found = worn(&design, &state, &wear).unwrap();
        assert!((found.flat_m[0] / flat_m - 1.0).abs() < 1e-12);
        let outside = found.outside.unwrap();
        let (edge, turn) = outside.edge.unwrap();
        let curve = WedgeCurve::build(&edge, &edge.profile().unwrap(), 0.0).unwrap();
        let first = curve.touch().t_ratio;
        let left_um = 1e6 * outside.clearance_m;
        println!(
            "{flat_m:e}: turned {} {turned}, left {left_um}, tan {first} {tan}, turn {turn} {edge_turn}",
            found.turned_rad
        );
        assert!((found.turned_rad / turned - 1.0).abs() < 1e-6, "{line}: {}", found.turned_rad);
        assert!((20.0 - left_um - out_um).abs() < 1e-6, "{line}: {left_um}");
        // The edge is blunt by 0.5 % of the arc, which the strut sees.
        assert!(
            (first / tan - 1.0).abs() < 6e-3 && (turn / edge_turn - 1.0).abs() < 6e-3,
            "{line}: {first} {turn}"
        );
        let (worn_design, idle) = idle(&design, &state, &wear);
        let found = overrun_at(&worn_design, &idle, 0.0, 200.0 * PI / 30.0).unwrap().state;
        let off = lift_off_rad_s(&worn_design, &idle, 1e4).unwrap() * 30.0 / PI;
        println!("  {} {n_a} N, {} {n_b} N, {off} {off_rpm} rpm", found.normal_inner_n, found.normal_outer_n);
        assert!(
            (found.normal_inner_n - n_a).abs() < 1e-5 * n_b
                && (found.normal_outer_n / n_b - 1.0).abs() < 1e-5
        );
        assert!((off / off_rpm - 1.0).abs() < 1e-5, "{line}: {off}");
    }
    assert_eq!(table.lines().count(), 6);
}

/// V = k int N ds by hand, of the outer track, in a life so short that nothing changes.
#[test]
fn the_volume_is_archards_on_the_outer_track() {
    let design = design(20.0, 200.0, 1e-3);
    let (service, life, state) = of(&design);
    let found = worn_life(&design, &service, &life).unwrap().unwrap();
    let at = found.states.iter().find(|s| s.share == 1.0).unwrap();
    let sliding = 200.0 * PI / 30.0;
    let point = overrun_at(&design, &state, 0.0, sliding).unwrap();
    let rubbed =
        point.lubricated.unwrap().film.asperities * point.state.normal_outer_n * sliding * 50e-3 * 3.6;
    println!("{} N, {rubbed} N m: {} m^3", point.state.normal_outer_n, at.wear.sprag_m3);
    assert!((at.wear.sprag_m3 / (1e-18 * rubbed) - 1.0).abs() < 5e-3, "{} m^3", at.wear.sprag_m3);
    let mut shorter = design.clone();
    shorter.service.as_mut().unwrap().overruns[0].duration_s = 1e-9;
    let creep = worn_life(&shorter, &shorter.service.clone().unwrap(), &life).unwrap().unwrap();
    let creep = creep.states.iter().find(|s| s.share == 1.0).unwrap().wear;
    let track = (at.wear.outer_track_m - creep.outer_track_m) * TAU * 50e-3 * 18e-3;
    assert!((track / (18.0 * at.wear.sprag_m3) - 1.0).abs() < 1e-6, "{track} m^3");
    // The inner track wears by engagements alone.
    assert!((at.wear.inner_track_m / creep.inner_track_m - 1.0).abs() < 1e-12);
}

/// int k phi N v dt over a long life, by Simpson over the states of the march: the spring relaxes, and the force with it.
#[test]
fn over_a_life_the_volume_is_the_integral_of_the_force() {
    let design = design(20.0, 200.0, 2000.0);
    let (service, life, state) = of(&design);
    let found = worn_life(&design, &service, &life).unwrap().unwrap();
    let sliding = 200.0 * PI / 30.0;
    let rate = |wear: &Wear| {
        let (worn_design, idle) = idle(&design, &state, wear);
        let p = overrun_at(&worn_design, &idle, 0.0, sliding).unwrap();
        1e-18 * p.lubricated.unwrap().film.asperities * p.state.sliding_n * sliding * 50e-3 * 2000.0 * 3600.0
    };
    let states: Vec<_> = found.states.iter().filter(|s| s.share <= 1.0).collect();
    let volume = worn_off_m3(&states, rate);
    let last = states[states.len() - 1];
    println!("{:#?}", found.states);
    println!("{volume} m^3 by hand, {} m^3; flat {} m, {} N", last.wear.sprag_m3, last.flat_m, last.normal_n);
    assert!(states.len() > 4 && (volume / last.wear.sprag_m3 - 1.0).abs() < 2e-3);
    assert!(last.normal_n < 0.99 * states[0].normal_n, "the force does not fall");
    assert!(last.first_tan_omega > states[0].first_tan_omega);
    assert!(last.lift_off_rad_s < states[0].lift_off_rad_s && last.clearance_m < states[0].clearance_m);
}

/// Where B leaves the edge of the flat the drawn arc carries on with the same force: either curve has the same torque there, and on the edge
/// the strut stands steeper.
#[test]
fn edge_and_arc_meet_where_the_edge_ends() {
    for contact in [ContactLaw::Din26281, design(40.0, 200.0, 1.0).clutch.contact] {
        let mut design = design(40.0, 200.0, 1.0);
        design.clutch.contact = contact;
        let (.., state) = of(&design);
        for volume in [1e-12, 1e-11, 5e-11] {
            let found = worn(&design, &state, &Wear { sprag_m3: volume, ..Wear::default() }).unwrap();
            let build = |clutch| WedgeCurve::build(clutch, &clutch.profile().unwrap(), 0.0).unwrap();
            let (edge, turn) = found.outside.unwrap().edge.unwrap();
            let (edge, arc) = (build(&edge), build(&found.clutch));
            let turned = |n: f64| edge.closure_at_normal(n).map_or(f64::INFINITY, |(_, c)| c.rotation.v);
            let (mut low, mut high) = (1e-9_f64, 1e5_f64);
            for _ in 0..200 {
                let middle = (low * high).sqrt();
                if turned(middle) < turn { low = middle } else { high = middle }
            }
            let [on, off] = [&edge, &arc].map(|curve| curve.at_normal(low).unwrap());
            println!("edge ends at {:?} {} Nm, arc {:?}", edge.end(), edge.end_torque_nm(), arc.end());
            let first = [edge.touch().t_ratio, arc.touch().t_ratio];
            println!(
                "flat {:e}: {low} N, {} and {} Nm; first {first:?}",
                found.flat_m[0], on.torque_nm, off.torque_nm
            );
            // A law that knows the radius gives more on the edge, whose radius is a twentieth of that of the arc.
            let within = if contact == ContactLaw::Din26281 { 1e-9 } else { 0.02 };
            assert!(
                (on.torque_nm / off.torque_nm - 1.0).abs() < within,
                "{} {}",
                on.torque_nm,
                off.torque_nm
            );
            // Far apart where it begins, and falling on the edge.
            assert!(first[0] > 1.05 * first[1] && first[0] > on.tan_omega);
        }
    }
}

/// Nothing worn is the clutch of today; a sprag that is smaller all over outside, without a flat, is one of that outer arc.
#[test]
fn without_wear_and_without_a_flat_it_is_the_drawn_clutch() {
    let design = design(20.0, 200.0, 1.0);
    let (service, life, state) = of(&design);
    let now = worn_state(&design, &service, &life, 0.0, &Wear::default()).unwrap();
    let drawn = overrun_at(&design, &state, 0.0, 200.0 * PI / 30.0).unwrap().state;
    assert_eq!(now.first_tan_omega, Some(state.first_tan_omega));
    assert_eq!(now.lift_off_rad_s, lift_off_rad_s(&design, &state, LIFT_OFF_TO_RAD_S));
    assert_eq!(now.normal_n, drawn.sliding_n);
    assert!((now.clearance_m.unwrap() / 20e-6 - 1.0).abs() < 1e-12);
    let off = Wear { outer_arc_m: 2e-6, ..Wear::default() };
    let outside = worn(&design, &state, &off).unwrap();
    let smaller = state
        .curve
        .of_sprag(sprag_design::wedge::SpragDeviation { size_m: -2e-6, ..Default::default() })
        .unwrap();
    let curve = WedgeCurve::build(&outside.clutch, &outside.clutch.profile().unwrap(), 0.0).unwrap();
    let [a, b] = [curve.touch().t_ratio, smaller.touch().t_ratio];
    assert!((a / b - 1.0).abs() < 1e-3 && outside.outside.unwrap().edge.is_none(), "{a} {b}");
}

/// What ends such a life: the clearance of the cage, or, where that has room, roll-over on the edge of the flat.
#[test]
fn the_cage_ends_a_life_whose_clearance_is_worn_up() {
    let ends = |clearance_um: f64| {
        let design = design(clearance_um, 200.0, 2000.0);
        let answer = design.life().unwrap();
        println!("{clearance_um}: {}", answer.verdict());
        let found = answer.worn.clone().unwrap();
        let last = found.states.last().unwrap().clone();
        (found.broken().unwrap(), last)
    };
    let (tight, last) = ends(3.0);
    assert_eq!(tight.1, Broken::Cage);
    // By the script a flat takes the pivot out by 2.90187 um at a depth of 5 and by 5.99035 at 10.
    let deep_um = 5.0 + 5.0 * (3.0 - 2.90187) / (5.99035 - 2.90187);
    assert!((last.opened_m / (1e-6 * deep_um) - 1.0).abs() < 5e-3, "{last:?}");
    let (wide, last) = ends(40.0);
    assert!(wide.0 > tight.0 && wide.1 == Broken::Edge, "{wide:?}");
    assert!(last.required_friction.is_none() && last.first_tan_omega.unwrap() < 0.11, "{last:?}");
}
