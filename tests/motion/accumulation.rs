//! Sequences of mode changes that accumulate in a finite time, and what a run that gives up says.

use sprag_design::clutch::ScenarioKind;
use sprag_design::design::Design;
use sprag_design::dynamics::{Grip, RunSettings, Stop, run};
use sprag_design::numeric::course::Course;
use sprag_design::scenario::{Settings, prepare, simulate};
use std::path::Path;

/// B holds, A is stuck under a light inner race whose torque jumps between 1.6 and 0.4 times the preload at times whose
/// gaps shrink by 0.7: A slips and sticks without end before one microsecond, and sticks under the preload afterwards.
#[test]
fn a_sequence_without_end_is_closed_at_its_limit() {
    let design = Design::read(Path::new("designs/huang2017-multi-arc.toml")).unwrap();
    let mut scene = design.scenario("high-6").unwrap().clone();
    scene.clutch.races.inner_inertia_kg_m2 = 1e-7;
    scene.clutch.friction.outer_holds = true;
    let mut p = prepare(&scene).unwrap();
    p.model.loads.amplitude_nm = 0.0;
    let jolt = 0.6 * p.model.loads.inner_nm.abs();
    let (end, ratio) = (1e-6, 0.7_f64);
    let (mut points, mut left) = (vec![[0.0, jolt]], end);
    for k in 0..60 {
        left *= ratio;
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        points.push([end - left, sign * jolt]);
        points.push([end - left, -sign * jolt]);
    }
    points.extend([[end, 0.0], [end, 0.0]]);
    p.model.drive.torque_nm = Course::new(points);
    let settings = RunSettings {
        tolerance: 1e-8,
        duration_s: 1e-5,
        longest_step_s: 1e-7,
        most_events: 1000,
        most_steps: 100_000,
        samples: 2,
        ..RunSettings::default()
    };
    let r = run(&p.model, p.state, p.mode, &settings);
    let times: Vec<f64> = r.modes.iter().map(|m| m.0).collect();
    println!("{:?}, {} events, {} closures, {times:?}", r.stop, r.events, r.zeno_closures);
    assert_eq!((r.stop, r.zeno_closures, r.mode.inner), (Stop::Finished, 1, Grip::Stick));
    assert!((15..60).contains(&r.events), "{}", r.events);
}

#[test]
fn the_scenes_of_the_paper_have_no_such_sequence_and_no_inconsistent_choice() {
    for file in ["designs/huang2017-multi-arc.toml", "designs/huang2017-bench.toml"] {
        for scenario in &Design::read(Path::new(file)).unwrap().scenarios {
            let Ok(s) = simulate(scenario, &Settings::default()) else { continue };
            assert_eq!((s.zeno_closures, s.inconsistent_choices), (0, 0), "{}", scenario.name);
        }
    }
}

/// A stiff abutment under a light race, kept from its end by few steps.
#[test]
fn a_run_that_gives_up_names_the_fast_motion() {
    let design = Design::read(Path::new("designs/huang2017-multi-arc.toml")).unwrap();
    let mut scene = design.scenario("low-6").unwrap().clone();
    scene.clutch.races.outer_inertia_kg_m2 = 1e-6;
    if let ScenarioKind::TorsionalExcitation { abutment_stiffness_nm_per_rad, .. } = &mut scene.kind {
        *abutment_stiffness_nm_per_rad = 1e9;
    }
    let s = simulate(&scene, &Settings { most_steps: Some(40), ..Settings::default() }).unwrap();
    let fast = s.fast_motion.unwrap();
    println!("{fast:?} at {:e} s", s.t_s);
    assert_eq!((s.stop, s.verdict), (Stop::StepLimit, None));
    // Below sqrt(k_ab/I_be) = 3.16e7 by the inertia of the sprags, whose alpha moves further than the race that drives them.
    assert!(fast.of == "sprag" && (1e7..3.16e7).contains(&fast.rate_rad_s), "{fast:?}");
    assert!(fast.amplitude_rad < 1e-6 && s.t_s < 0.3);
}
