//! Sprags one by one between races whose axes do not meet or give way: beside the one-sprag model, statics, hand and an independent script.

use crate::scenes::{lasting, of_scripts, scene};
use sprag_design::clutch::{Carrier, Eccentricity, GivenSprag, ScenarioKind, Sharing, Standing};
use sprag_design::dynamics::{SpragCourse, Stop};
use sprag_design::scenario::Settings;
use sprag_design::sharing::{Asked, Unlike};
use sprag_design::sprags::{Many, each_sprag};
use sprag_design::wedge::AxisTurns;
use sprag_design::{Design, WedgeCurve};

fn off(offset_m: f64, turning: bool, carrier: Carrier) -> Option<Eccentricity> {
    Some(Eccentricity { offset_m, turning, carrier, stiffness_n_per_m: f64::INFINITY })
}

/// Sprags alike, the axes apart by next to nothing, held or on bearings: the sums over twelve sprags in their own gaps are those of one.
#[test]
fn axes_that_all_but_meet_leave_the_paper_s_model() {
    for (file, name) in [("huang2017-multi-arc", "high-10"), ("huang2017-multi-arc", "low-8")] {
        let mut scene = scene(file, name);
        lasting(&mut scene, 0.03);
        let together = Many::new(&scene, &Sharing::default(), false).unwrap();
        assert!(together.axes.is_none());
        let one = together.run(&Settings::default(), 1e-12, 2);
        for (carrier, turning, stiffness) in [
            (Carrier::OuterRace, false, None),
            (Carrier::InnerRace, false, Some(2e8)),
            (Carrier::OuterRace, true, Some(2e8)),
        ] {
            scene.clutch.races.eccentricity = off(1e-15, turning, carrier);
            let sharing = Sharing { stiffness_n_per_m: stiffness, mass_kg: Some(0.2), ..Sharing::default() };
            let many = Many::new(&scene, &sharing, false).unwrap();
            assert!(many.axes.is_some() && many.groups.len() == 12);
            let all = many.run(&Settings::default(), 1e-12, 2);
            let theta = (all.races[0] - one.races[0]).abs();
            let normal = (all.courses[5].normal_max_n / one.courses[0].normal_max_n - 1.0).abs();
            println!(
                "{name} {carrier:?} {stiffness:?}: {theta:.1e} rad, N {normal:.1e}, {} {}",
                all.events, one.events
            );
            assert_eq!((all.stop, all.inconsistent_choices), (Stop::Finished, 0));
            assert!(theta < 1e-10 && normal < 1e-10, "{theta:e} {normal:e}");
        }
        scene.clutch.races.eccentricity = None;
    }
}

/// The clutch turns against the offset once in two seconds under a torque that stands still: at each place what `sharing` has, for what the table of the gaps leaves out.
#[test]
fn a_slow_turn_is_shared_as_statics_shares_it() {
    for (stiffness, offset_m, allowed) in [(None, 3e-6, 3e-4), (None, 1e-5, 1e-3), (Some(2e8), 1e-5, 1e-3)] {
        let mut scene = scene("huang2017-single-arc", "low-6");
        scene.clutch.spring.stiffness_nm_per_rad = 0.0;
        let turns_rad_s = std::f64::consts::PI;
        let ScenarioKind::TorsionalExcitation { duration_s, preload_nm, amplitude_nm, speed_rad_s, .. } =
            &mut scene.kind
        else {
            panic!()
        };
        (*duration_s, *preload_nm, *amplitude_nm, *speed_rad_s) = (2.0, 16.8, 0.0, turns_rad_s);
        scene.clutch.races.eccentricity = off(offset_m, true, Carrier::OuterRace);
        let larger = GivenSprag { index: 7, size_m: Some(1e-6), ..GivenSprag::default() };
        let sharing = Sharing {
            stiffness_n_per_m: stiffness,
            mass_kg: Some(1.0),
            given: vec![larger],
            ..Sharing::default()
        };
        let many = Many::new(&scene, &sharing, false).unwrap();
        let all = many.run(&Settings { longest_step_s: Some(0.01), ..Settings::default() }, 1e-9, 9);
        assert_eq!((all.stop, all.inconsistent_choices), (Stop::Finished, 0));
        let curve = WedgeCurve::build(&scene.clutch, &scene.clutch.profile().unwrap(), 0.0).unwrap();
        let rest = Unlike::new(&scene.clutch, &sharing, &curve, 0.0).unbent();
        let (mut worst, mut spread, mut push) = (0.0_f64, 0.0_f64, 0.0_f64);
        for sample in &all.samples {
            // The offset of statics turns against the outer race.
            let turned_rad = -turns_rad_s * sample.t_s - sample.races[1];
            let shared = rest.carrying(Asked::Torque(16.8), turned_rad).unwrap();
            let mean = sample.normal_n.iter().sum::<f64>() / 12.0;
            for (i, share) in shared.shares().iter().enumerate() {
                let here = sample.normal_n[many.group[i].unwrap()] / mean;
                worst = worst.max((here - share).abs());
                spread = spread.max((share - 1.0).abs());
            }
            let [x, y] = shared.radial_n;
            push = push.max((sample.bearing_n - x.hypot(y)).abs() / (12.0 * mean));
        }
        println!(
            "{stiffness:?} {offset_m:e}: {worst:.1e} of shares that differ by {spread:.2}, bearings {push:.1e}"
        );
        assert!(worst < allowed && spread > 0.02, "{worst:e} {spread}");
        assert!(push < allowed, "{push:e}");
    }
}

/// Two sprags opposite each other in a cage, the axis off towards one: their windups differ by twice the offset over OA sin omega, seen along the strut.
#[test]
fn two_sprags_by_hand() {
    let mut scene = scene("huang2017-single-arc", "low-6");
    scene.clutch.spring.stiffness_nm_per_rad = 0.0;
    let ScenarioKind::TorsionalExcitation { amplitude_nm, .. } = &mut scene.kind else { panic!() };
    *amplitude_nm = 0.0;
    let offset_m = 1e-6;
    scene.clutch.races.eccentricity = off(offset_m, false, Carrier::OuterRace);
    let gone = |index: usize| GivenSprag { index, missing: true, ..GivenSprag::default() };
    let given = (0..12).filter(|i| i % 6 != 0).map(gone).collect();
    let many =
        Many::new(&scene, &Sharing { start: Standing::Caged, given, ..Sharing::default() }, false).unwrap();
    assert_eq!(many.groups.len(), 2);
    let curve = &many.groups[0].model.curve;
    let at = |g: usize| many.start.sprags[g][0];
    let [wide, narrow] = [0, 1].map(|g| {
        let p = curve.in_arc(curve.arc_at(at(g)), at(g));
        (curve.windup_rad(at(g)), p, curve.closure_at_normal(p.n_bi).unwrap().1)
    });
    let ways = |c: &sprag_design::wedge::Closure| {
        let omega = (c.t_bi.v / c.n_bi).atan();
        offset_m * (c.beta.v - omega).cos() / (c.lengths.oa.v * omega.sin())
    };
    // The axis lies off by -offset at the wide gap, by +offset at the other.
    let by_hand = ways(&wide.2) + ways(&narrow.2);
    let found = narrow.0 - wide.0;
    println!("{found:.6e} {by_hand:.6e}, N {} {}", narrow.1.n_bi, wide.1.n_bi);
    assert!((found / by_hand - 1.0).abs() < 0.01, "{found} {by_hand}");
    let torque: f64 = [&wide, &narrow].iter().map(|(_, p, _)| p.t_static * p.oa).sum();
    assert!((torque / 16.8 - 1.0).abs() < 1e-4, "{torque}");
    // And there they stay.
    let all = many.run(&Settings::default(), 1e-10, 3);
    for (g, started) in [at(0), at(1)].into_iter().enumerate() {
        assert!((all.sprags[g][0] / started - 1.0).abs() < 1e-7, "{} {started}", all.sprags[g][0]);
    }
}

#[test]
fn sprags_off_centre_that_slip_and_lift_balance_their_energy() {
    for (file, name, speed_rad_s) in [
        ("huang2017-multi-arc", "high-10", 0.0),
        ("huang2017-multi-arc", "low-10", 100.0),
        ("huang2017-bench", "engagement-weak-spring", 0.0),
        ("huang2017-bench", "step-down", 0.0),
    ] {
        let mut scene = scene(file, name);
        if let ScenarioKind::TorsionalExcitation { speed_rad_s: turns, .. } = &mut scene.kind {
            *turns = speed_rad_s;
        }
        if matches!(scene.kind, ScenarioKind::TorsionalExcitation { .. }) {
            lasting(&mut scene, 0.05);
        }
        for (stiffness, carrier, turning) in [
            (None, Carrier::OuterRace, true),
            (None, Carrier::InnerRace, false),
            (Some(1e8), Carrier::OuterRace, true),
            (Some(1e8), Carrier::InnerRace, false),
        ] {
            scene.clutch.races.eccentricity = off(5e-6, turning, carrier);
            let sharing = Sharing {
                stiffness_n_per_m: stiffness,
                mass_kg: Some(0.3),
                seed: 1,
                size_within_m: 1e-6,
                friction_within: 0.005,
                ..Sharing::default()
            };
            let many = Many::new(&scene, &sharing, false).unwrap();
            let [coarse, all] = [1e-8, 1e-9].map(|tolerance| many.run(&Settings::default(), tolerance, 0));
            let left = all.residual_j / all.through_j;
            let theta = (all.races[0] - coarse.races[0]).abs();
            println!(
                "{name} {stiffness:?} {carrier:?}: {left:.1e} of {:.3} J, changes {}, {theta:.1e} rad, bearings {:.0} N, axes {:.2e} m, {:?}",
                all.through_j, all.events, all.bearing_max_n, all.axis_max_m, all.stop
            );
            assert_eq!((all.stop, all.inconsistent_choices), (Stop::Finished, 0));
            assert!(left.abs() < 1e-7, "{name}: {left:e}");
            assert!(theta < 1e-6, "{name}: {theta:e}");
        }
    }
}

/// A torque beyond what the clutch carries: the way over is followed only where the axes meet, so the scene ends with its numbers, by name,
/// where the first curve does.
#[test]
fn a_sprag_that_rolls_over_off_centre_ends_the_scene_by_name() {
    let mut scene = scene("huang2017-bench", "step-up");
    scene.clutch.friction.static_ = 0.4;
    let ScenarioKind::Transient { torque_step_nm, .. } = &mut scene.kind else { panic!() };
    *torque_step_nm = 500.0;
    lasting(&mut scene, 0.1);
    for (stiffness, turning) in [(None, false), (None, true), (Some(1e8), false)] {
        scene.clutch.races.eccentricity = off(5e-6, turning, Carrier::OuterRace);
        let sharing =
            Sharing { stiffness_n_per_m: stiffness, size_within_m: 1e-6, seed: 1, ..Sharing::default() };
        let found = each_sprag(&scene, &sharing, &Settings::default()).unwrap();
        let run = &found.run;
        let most = |of: fn(&SpragCourse) -> f64| run.courses.iter().map(of).fold(0.0, f64::max);
        let (normal_n, tan) = (most(|c| c.normal_max_n), most(|c| c.tan[0].max(c.tan[1])));
        println!(
            "{:?} at {:?}, {} s, {normal_n} N, {tan}, left {:e}",
            run.stop, run.at_group, run.t_s, run.residual_j
        );
        assert_eq!((run.stop, run.at_group.is_some(), found.error.is_some()), (Stop::CurveEnd, true, true));
        let at = WedgeCurve::build(&scene.clutch, &scene.clutch.profile().unwrap(), 0.0).unwrap();
        let end_n = at.arc_end_n(at.arc_count() - 1);
        assert!(
            run.t_s > 0.0 && run.t_s < 0.1 && (normal_n / end_n - 1.0).abs() < 0.05,
            "{normal_n} {end_n}"
        );
        assert!(run.residual_j.abs() < 1e-7 * run.through_j, "{:e}", run.residual_j / run.through_j);
    }
}

/// By `tests/reference/off_centre.py`.
#[test]
fn a_race_that_runs_out_on_bearings_moves_as_an_independent_script_has_it() {
    let mut scene = of_scripts(0.001, 10.0);
    scene.clutch.races.eccentricity = off(5e-6, false, Carrier::InnerRace);
    let larger = GivenSprag { index: 3, size_m: Some(1e-6), ..GivenSprag::default() };
    let sharing = Sharing {
        stiffness_n_per_m: Some(5e7),
        mass_kg: Some(0.5),
        given: vec![larger],
        ..Sharing::default()
    };
    let many = Many::new(&scene, &sharing, false).unwrap();
    let all = many.run(&Settings::default(), 1e-11, 2);
    assert_eq!((all.stop, all.events), (Stop::Finished, 0));
    let last = all.samples.last().unwrap();
    let normal = |i: usize| last.normal_n[many.group[i].unwrap()];
    let found = [
        many.start.races[0],
        many.start.shift_m[0],
        many.start.shift_m[1],
        all.races[0],
        all.races[1],
        last.axis_m[0],
        last.axis_m[1],
        normal(0),
        normal(3),
        normal(6),
    ];
    let script: [f64; 10] = [
        -2.346963619e-2,
        -1.085048429e-7,
        -3.964021015e-8,
        -2.345606399e-2,
        -1.647242474e-3,
        -5.108789707e-6,
        7.696806808e-8,
        9.573465728e2,
        9.561323985e2,
        9.558507763e2,
    ];
    // Angles and forces to 1e-6. What pushes the axis is what twelve forces leave of each other, so 1e-6 of one of them is 2e-4 of the little that
    // the axis gives.
    let allowed = [1e-6, 2e-4, 2e-4, 1e-6, 1e-6, 1e-6, 1e-4, 1e-6, 1e-6, 1e-6];
    for (found, script) in found.iter().zip(script) {
        println!("{:.1e}", found / script - 1.0);
    }
    for ((found, script), allowed) in found.iter().zip(script).zip(allowed) {
        assert!((found / script - 1.0).abs() < allowed, "{found:e} {script:e}");
    }
}

/// The table against rigid rolling, its slopes against differences, and its first order against the strut that keeps its length.
fn holds(curve: &WedgeCurve, reach_m: f64, left_out_rad: f64, places: &[(usize, f64)]) {
    let table = AxisTurns::new(curve, reach_m).unwrap();
    println!("reach {reach_m:e}: {:e} rad left out", table.error_rad);
    assert!(table.error_rad < left_out_rad, "{:e}", table.error_rad);
    for &(k, part) in places {
        let from = if k == 0 { 0.0 } else { curve.arc_end_rad(k - 1) };
        let alpha = from + part * (curve.arc_end_rad(k) - from);
        let p = curve.in_arc(k, alpha);
        // AB over its length against OA sin omega.
        let c = curve.closure_at_normal(p.n_bi).unwrap().1;
        let omega = (c.t_bi.v / c.n_bi).atan();
        let (lean, gamma) = (c.beta.v - omega, p.gamma - curve.statics().gamma0_rad());
        let lever = c.lengths.oa.v * omega.sin();
        let strut = rotated([lean.cos(), lean.sin()], gamma);
        let flat = table.at(k, alpha, [0.0; 2]);
        for (axis, strut) in strut.iter().enumerate() {
            let slope = flat[0].first[1 + axis] + flat[1].first[1 + axis];
            let off = (slope + strut / lever).abs() * lever;
            assert!(off < 0.01, "{k} {axis}: {slope} {}", -strut / lever);
        }
        let axis_m = [0.6 * reach_m, -0.5 * reach_m];
        let [a, b] = table.at(k, alpha, axis_m);
        let steps = [1e-6, 1e-3 * reach_m, 1e-3 * reach_m];
        for (of, by) in [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2)] {
            let side = |sign: f64| {
                let mut to = [alpha, axis_m[0], axis_m[1]];
                to[by] += sign * steps[by];
                table.at(k, to[0], [to[1], to[2]])
            };
            let ([a1, b1], [a0, b0]) = (side(1.0), side(-1.0));
            for (here, to, from) in [(a, a1, a0), (b, b1, b0)] {
                let slope = (to.value - from.value) / (2.0 * steps[by]);
                let twice = (to.first[of] - from.first[of]) / (2.0 * steps[by]);
                let first = here.first[by];
                assert!((slope / first - 1.0).abs() < 1e-4, "{k} {by}: {slope} {first}");
                let size = here.second[of][by].abs() + 1e-3 * here.first[of].abs() / steps[by];
                assert!((twice - here.second[of][by]).abs() < 1e-3 * size, "{k} {of} {by}");
            }
        }
    }
}

fn curve_of(file: &str) -> WedgeCurve {
    let path = format!("{}/designs/{file}.toml", env!("CARGO_MANIFEST_DIR"));
    let design = Design::read(path.as_ref()).unwrap();
    WedgeCurve::build(&design.clutch, &design.clutch.profile().unwrap(), 0.0).unwrap()
}

fn rotated([x, y]: [f64; 2], angle_rad: f64) -> [f64; 2] {
    let (s, c) = angle_rad.sin_cos();
    [x * c - y * s, x * s + y * c]
}

/// 10 um are 0.011 rad. The fourth power of d alone is left out.
#[test]
fn an_axis_that_lies_off_turns_the_races_as_the_strut_that_keeps_its_length() {
    let curve = curve_of("huang2017-single-arc");
    holds(&curve, 1e-6, 1e-11, &[(0, 0.1), (0, 0.4), (0, 0.9)]);
    holds(&curve, 1e-5, 1e-7, &[(0, 0.1), (0, 0.4), (0, 0.9)]);
}

/// A contact that d brings over a junction goes on with the arc before: Delta r tau^2/2 over the lever, 0.07 mm, 2e-3 rad for a um and
/// 0.9 mm: 1.6e-7 rad.
#[test]
fn a_contact_that_the_axis_brings_over_a_junction_goes_on_with_its_arc() {
    let curve = curve_of("huang2017-multi-arc");
    holds(&curve, 1e-6, 4e-7, &[(0, 0.4), (0, 0.95), (1, 0.3), (2, 0.5)]);
    holds(&curve, 1e-5, 4e-5, &[(0, 0.4), (0, 0.95), (1, 0.3), (2, 0.5)]);
}
