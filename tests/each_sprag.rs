//! Sprags one by one in a scene: alike they are the one-sprag model, unlike they are what statics and an independent script say.

use sprag_design::clutch::{GivenSprag, Scenario, ScenarioKind, Sharing, Standing};
use sprag_design::dynamics::{RunSettings, Stop, run};
use sprag_design::scenario::{Settings, prepare};
use sprag_design::sharing::{Asked, Unlike};
use sprag_design::sprags::Many;
use sprag_design::{Design, WedgeCurve};
use std::time::Instant;

fn scene(file: &str, name: &str) -> Scenario {
    let path = format!("{}/designs/{file}.toml", env!("CARGO_MANIFEST_DIR"));
    Design::read(path.as_ref()).unwrap().scenario(name).unwrap().clone()
}

fn alike() -> Sharing {
    Sharing {
        start: Standing::Sprung,
        seed: 1,
        size_within_m: 0.0,
        azimuth_within_rad: 0.0,
        friction_within: 0.0,
        gap_up_to_m: 0.0,
        stiffness_n_per_m: None,
        given: Vec::new(),
    }
}

#[test]
fn sprags_alike_are_the_one_sprag_model_over_the_scenes_history() {
    for (file, name, apart) in [
        ("huang2017-multi-arc", "high-6", true),
        ("huang2017-multi-arc", "high-6", false),
        ("huang2017-multi-arc", "high-8", false),
        ("huang2017-multi-arc", "high-10", false),
        ("huang2017-multi-arc", "low-10-mu082", false),
        ("huang2017-bench", "engagement", false),
        ("huang2017-bench", "step-up", false),
    ] {
        let scene = scene(file, name);
        let many = Many::new(&scene, &alike(), apart).unwrap();
        let p = prepare(&scene).unwrap();
        let period = p.period_s.map_or(p.duration_s / 200.0, |s| 0.25 * s);
        let settings = RunSettings {
            tolerance: 1e-13,
            duration_s: p.duration_s,
            longest_step_s: 0.25 * period,
            samples: 101,
            ..RunSettings::default()
        };
        let one = run(&p.model, p.state, p.mode, &settings);
        let with = Settings { longest_step_s: Some(0.25 * period), ..Settings::default() };
        let all = many.run(&with, 1e-13, 101);
        let (mut worst, mut size) = (0.0_f64, 0.0_f64);
        for (a, b) in one.samples.iter().zip(&all.samples) {
            for i in 0..2 {
                worst = worst.max((a.state[2 + i] - b.races[i]).abs());
                size = size.max(a.state[2 + i].abs());
            }
        }
        let normal = (one.peaks.normal_max_n / all.courses[0].normal_max_n - 1.0).abs();
        println!(
            "{file} {name} {apart}: {worst:.2e} of {size:.2e} rad, largest N {normal:.1e}, events {} {}, steps {} {}, evaluations {} {}, {:?} {}, energy {:.1e}",
            one.events,
            all.events,
            one.counters.steps,
            all.counters.steps,
            one.counters.rhs_evaluations,
            all.counters.rhs_evaluations,
            all.stop,
            all.inconsistent_choices,
            all.residual_j / all.through_j
        );
        assert_eq!((one.stop, all.stop, all.inconsistent_choices), (Stop::Finished, Stop::Finished, 0));
        assert!(worst < 1e-10 * size && normal < 1e-7, "{name}: {worst:e} of {size:e}, {normal:e}");
        assert!(all.residual_j.abs() < 1e-9 * all.through_j, "{name}: {:e}", all.residual_j / all.through_j);
    }
}

fn unlike() -> Sharing {
    let late = GivenSprag { index: 3, gap_m: Some(4e-6), ..GivenSprag::default() };
    Sharing { given: vec![late], ..alike() }
}

/// Two kinds of sprags without inertia, both rolling: theta_bi'' and theta_be'' under the sum of what each curve carries at its own
/// alpha, alpha' = (theta_be' - theta_bi')/(rho_i + rho_e), by Runge-Kutta steps of fixed length.
#[test]
fn two_kinds_of_sprags_that_roll_are_two_springs_between_the_races() {
    let mut scene = scene("huang2017-multi-arc", "low-6");
    let spring = scene.clutch.spring.stiffness_nm_per_rad;
    scene.clutch.sprags.mass_kg *= 1e-4;
    scene.clutch.sprags.inertia_kg_m2 *= 1e-4;
    let ScenarioKind::TorsionalExcitation { duration_s, .. } = &mut scene.kind else { panic!() };
    *duration_s = 0.05;
    let many = Many::new(&scene, &unlike(), false).unwrap();
    assert_eq!(many.groups.len(), 2);
    let all = many.run(&Settings::default(), 1e-11, 2);
    assert_eq!((all.stop, all.events), (Stop::Finished, 0));
    let races = &scene.clutch.races;
    let loads = many.groups[0].model.loads;
    let slope = |t: f64, y: &[f64; 6]| {
        let mut torque = 0.0;
        let mut out = [y[2], y[3], 0.0, 0.0, 0.0, 0.0];
        for (g, group) in many.groups.iter().enumerate() {
            let curve = &group.model.curve;
            let p = curve.in_arc(curve.arc_at(y[4 + g]), y[4 + g]);
            let rho = p.rho_i + p.rho_e;
            let count = many.group.iter().filter(|of| **of == Some(g)).count() as f64;
            torque += count * (p.t_static * p.oa - spring * (group.model.alpha_max_rad - y[4 + g]) / rho);
            out[4 + g] = (y[3] - y[2]) / rho;
        }
        let drag = races.viscous_damping_nm_s_per_rad * (y[2] - y[3]);
        out[2] = (torque + loads.inner_nm - drag) / races.inner_inertia_kg_m2;
        out[3] = (-torque + loads.amplitude_nm * (loads.omega_rad_s * t).sin() + drag
            - loads.abutment_nm_per_rad * y[1])
            / races.outer_inertia_kg_m2;
        out
    };
    let s = &many.start;
    let mut y = [s.races[0], s.races[1], 0.0, 0.0, s.sprags[0][0], s.sprags[1][0]];
    let h = 1e-5;
    let along = |y: &[f64; 6], k: &[f64; 6], h: f64| -> [f64; 6] { std::array::from_fn(|i| y[i] + h * k[i]) };
    for step in 0..5000 {
        let t = f64::from(step) * h;
        let a = slope(t, &y);
        let b = slope(t + 0.5 * h, &along(&y, &a, 0.5 * h));
        let c = slope(t + 0.5 * h, &along(&y, &b, 0.5 * h));
        let d = slope(t + h, &along(&y, &c, h));
        y = std::array::from_fn(|i| y[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
    }
    for i in 0..2 {
        println!("race {i}: {} {}", all.races[i], y[i]);
        assert!((all.races[i] / y[i] - 1.0).abs() < 1e-6, "{} {}", all.races[i], y[i]);
        assert!((all.sprags[i][0] / y[4 + i] - 1.0).abs() < 1e-6, "{} {}", all.sprags[i][0], y[4 + i]);
    }
}

#[test]
fn a_torque_that_rises_slowly_is_shared_as_statics_shares_it() {
    let mut scene = scene("huang2017-bench", "step-up");
    scene.torque_history = Some(vec![[0.0, 1.0], [0.5, 40.0], [1.2, 40.0]]);
    scene.clutch.spring.stiffness_nm_per_rad = 0.0;
    let ScenarioKind::Transient { duration_s, .. } = &mut scene.kind else { panic!() };
    *duration_s = 1.2;
    let given = |size| GivenSprag { index: 7, size_m: Some(size), ..GivenSprag::default() };
    for (size, within) in [(0.0, 1e-8), (3e-6, 1e-4)] {
        let mut sharing = unlike();
        sharing.given.push(given(size));
        let many = Many::new(&scene, &sharing, false).unwrap();
        let all = many.run(&Settings::default(), 1e-9, 13);
        assert_eq!((all.stop, all.inconsistent_choices), (Stop::Finished, 0));
        let curve = WedgeCurve::build(&scene.clutch, &scene.clutch.profile().unwrap(), 0.0).unwrap();
        let mut clutch = scene.clutch.clone();
        clutch.races.eccentricity = None;
        let still = Unlike::new(&clutch, &sharing, &curve, 0.0).unbent();
        let shared = still.carrying(Asked::Torque(40.0), 0.0).unwrap();
        let last = all.samples.last().unwrap();
        for (i, load) in shared.loads.iter().enumerate() {
            let normal = last.normal_n[many.group[i].unwrap()];
            let off = (normal / load.normal_inner_n - 1.0).abs();
            println!("size {size:e} sprag {i}: {normal} {} {off:.1e}", load.normal_inner_n);
            assert!(off < within, "{i}: {normal} {}", load.normal_inner_n);
        }
        // The one with a gap catches last, near the torque of statics.
        let late = all.courses[many.group[3].unwrap()].catches_s.unwrap();
        let torque = 1.0 + 78.0 * late;
        let expected = still.catches_nm(0.0)[3].unwrap();
        println!("catches at {torque} {expected} Nm");
        // The ramp sets in at once: the torque swings by its rate over the clutch's own frequency, some 500 rad/s.
        assert!((torque - expected).abs() < 78.0 / 500.0, "{torque} {expected}");
        assert!(all.residual_j.abs() < 1e-6 * all.through_j, "{:e}", all.residual_j / all.through_j);
    }
}

#[test]
fn twelve_sprags_cost_at_most_one_and_a_half_times_twelve_times_one() {
    let scene = scene("huang2017-multi-arc", "high-6");
    let mut found = Vec::new();
    for apart in [false, true] {
        let many = Many::new(&scene, &alike(), apart).unwrap();
        let started = Instant::now();
        let all = many.run(&Settings::default(), 1e-7, 0);
        found.push((all.counters.rhs_evaluations as f64, started.elapsed().as_secs_f64(), all.events));
        assert_eq!(all.stop, Stop::Finished);
    }
    println!("{found:?}");
    // Twelve are looked at in one evaluation: so many times more of them at most.
    assert!(found[1].0 < 1.5 * found[0].0, "{found:?}");
}
