//! Scenes that are long: limits of work, samples beside the equidistant ones, what the equations leave out.

use sprag_design::clutch::{Scenario, ScenarioKind};
use sprag_design::design::Design;
use sprag_design::dynamics::{History, Stop};
use sprag_design::fidelity::{self, Terms};
use sprag_design::scenario::{Settings, prepare, simulate};
use std::path::Path;

fn scene(name: &str) -> Scenario {
    let design = Design::read(Path::new("designs/huang2017-multi-arc.toml")).unwrap();
    design.scenario(name).unwrap().clone()
}

fn lasting(name: &str, seconds: f64, hertz: f64) -> Scenario {
    let mut long = scene(name);
    if let ScenarioKind::TorsionalExcitation { duration_s, frequency_hz, .. } = &mut long.kind {
        (*duration_s, *frequency_hz) = (seconds, hertz);
    }
    long
}

#[test]
fn the_limits_of_work_grow_with_the_scene() {
    let limits = |seconds: f64, hertz: f64, settings: &Settings| {
        settings.limits(&prepare(&lasting("high-6", seconds, hertz)).unwrap())
    };
    let chosen = Settings::default();
    assert_eq!(limits(0.3, 100.0, &chosen), [200_000, 100_000]);
    assert_eq!(limits(4.0, 100.0, &chosen), [200_000, 100_000]);
    assert_eq!(limits(60.0, 100.0, &chosen), [3_000_000, 1_500_000]);
    assert_eq!(limits(2.0, 1000.0, &chosen), [1_000_000, 500_000]);
    // What nobody would wait for is asked for by name.
    assert_eq!(limits(0.3, 1e9, &chosen), [10_000_000, 5_000_000]);
    let asked = Settings { most_steps: Some(7), most_events: Some(8), ..chosen };
    assert_eq!(limits(60.0, 100.0, &asked), [7, 8]);
}

#[test]
fn a_run_that_meets_its_limit_says_which_and_is_not_repeated_on_the_whole_curve() {
    let few = Settings { most_steps: Some(60), ..Settings::default() };
    let planned = fidelity::simulate(&scene("high-10"), &few, Terms::Felt).unwrap();
    let s = &planned.simulation;
    let gave_up = s.gave_up.unwrap();
    assert_eq!((s.stop, gave_up.stop, gave_up.limit), (Stop::StepLimit, Stop::StepLimit, Some(60)));
    assert!(gave_up.t_s == s.t_s && s.t_s < 0.3);
    // Arcs were left out of the run that answers: the limit has nothing to do with the length of the curve.
    assert!(planned.left_out.iter().any(|t| t.term == "arcs that are never touched"));
    // A finer run that gives up names its limit too.
    let finer = Settings { most_steps: Some(2000), tolerance: 1e-10, ..Settings::default() };
    let s = simulate(&scene("high-10"), &finer).unwrap();
    assert_eq!((s.finer_gave_up, s.gave_up.unwrap().limit), (Some(Stop::StepLimit), Some(2000)));
    assert!(simulate(&scene("high-10"), &Settings::default()).unwrap().gave_up.is_none());
}

#[test]
fn marks_are_the_located_changes_of_mode_and_extremes_within_the_window() {
    let run = |history: History| {
        simulate(&scene("high-10"), &Settings { samples: 101, history, ..Settings::default() }).unwrap()
    };
    let plain = run(History::default());
    let marked = run(History { marks: true, ..History::default() });
    assert_eq!(plain.samples.len(), 101);
    assert_eq!(marked.theta_inner_rad, plain.theta_inner_rad);
    assert!(marked.samples.windows(2).all(|two| two[0].t <= two[1].t));
    // Every equidistant sample is still there.
    let at = |t: f64| marked.samples.iter().filter(move |s| s.t == t);
    assert!(plain.samples.iter().all(|s| at(s.t).any(|m| m.state == s.state)));
    let changes = &marked.modes[..marked.modes.len().min(101)];
    assert!(changes.len() > 20 && changes.iter().all(|m| at(m.0).any(|s| s.mode == m.1)));
    let peaks = &marked.peaks;
    assert!(at(peaks.at_s[3]).any(|s| (s.forces.n_bi / peaks.normal_max_n - 1.0).abs() < 1e-9));
    assert!(at(peaks.at_s[4]).any(|s| (s.forces.n_be / peaks.normal_outer_max_n - 1.0).abs() < 1e-9));
    let window = run(History { window_s: Some([0.001, 0.15]), marks: true });
    let (first, last) = (window.samples[0].t, window.samples[window.samples.len() - 1].t);
    assert!(first == 0.001 && last <= 0.15 + 1e-12 && last > 0.149, "{first} to {last}");
    let within = marked.modes.iter().filter(|m| (0.001..0.15).contains(&m.0)).count().min(101);
    assert!(window.samples.len() >= 101 + within, "{} samples, {within} changes", window.samples.len());
    assert_eq!(window.peaks, marked.peaks, "extremes are those of the whole run");
}

/// Two hundred samples a period miss little of a smooth scene; twelve hundred of sixty seconds miss most.
#[test]
fn what_is_left_out_is_seen_by_the_steps_and_not_by_the_samples() {
    let at =
        |samples: usize| simulate(&scene("high-6"), &Settings { samples, ..Settings::default() }).unwrap();
    let (coarse, fine) = (at(3), at(6001));
    assert_eq!(coarse.neglected, fine.neglected);
    let model = prepare(&scene("high-6")).unwrap().model;
    let radial = |s: &sprag_design::dynamics::Sample| {
        let p = model.point(s.mode.place, s.state[0]);
        (p.oc_g_slope * s.forces.acceleration[0]).abs()
    };
    let sampled = fine.samples.iter().map(radial).fold(0.0, f64::max);
    let rate = fine.samples.iter().map(|s| s.state[7].abs()).fold(0.0, f64::max);
    let found = coarse.neglected;
    println!("{found:?}; samples: {sampled} m/s^2, {rate} rad/s");
    assert!((0.999..1.05).contains(&(found.radial_m_s2 / sampled)));
    assert!((0.999..1.05).contains(&(found.outer_rate_rad_s / rate)));
    assert!(found.normal_outer_n > 0.0);
}

/// Sixty seconds with slip in each of six thousand periods: those that repeat are added, to the tolerance of what a run of
/// all of them says.
#[test]
fn periods_that_repeat_are_added_and_not_run() {
    for (name, seconds) in [("low-10-mu082", 4.5), ("high-6", 4.5), ("high-10", 4.503)] {
        let scene = lasting(name, seconds, 100.0);
        let settings = Settings { energy: true, samples: 41, ..Settings::default() };
        let started = std::time::Instant::now();
        let jumped = simulate(&scene, &settings).unwrap();
        let took = started.elapsed();
        let whole = simulate(&scene, &Settings { every_period: true, ..settings }).unwrap();
        let jump = *jumped.jumps.first().expect("it repeats");
        println!(
            "{name}: {jump:?}, {took:?} and {:?}; off {:?}",
            started.elapsed() - took,
            jumped.off(&whole)
        );
        println!("   {:?}", jumped.energy);
        println!("   {:?}", whole.energy);
        assert!(whole.jumps.is_empty() && jumped.verdict == whole.verdict);
        assert!(jumped.tolerance_reached, "{:?}", jumped.error);
        let worst = jumped.scales.worst_figure(&jumped.off(&whole));
        assert!(worst.1 < settings.tolerance, "{name}: {worst:?}");
        assert_eq!(jumped.events, whole.events);
        assert_eq!(jumped.samples.len(), whole.samples.len());
        for (a, b) in jumped.samples.iter().zip(&whole.samples) {
            assert!((a.t - b.t).abs() < 1e-9, "{} {}", a.t, b.t);
            let off = a.state.iter().zip(&b.state).take(4).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off < 1e-6, "{name} at {}: {off}", a.t);
        }
        let [a, b] = [&jumped, &whole].map(|s| s.energy.unwrap());
        assert!(a.relative().abs() < 1e-6 && (a.through_j / b.through_j - 1.0).abs() < 1e-4);
    }
    let started = std::time::Instant::now();
    let long = simulate(&lasting("low-10-mu082", 60.0, 100.0), &Settings::default()).unwrap();
    println!("60 s: {:?}, {:?}, {:?}", started.elapsed(), long.jumps, long.error);
    assert!(long.jumps[0].from_s < 3.0, "most of its periods are added");
    assert!(long.tolerance_reached && long.inner.net_m < -0.06 && long.events > 20_000);
    // A scene that is no longer than all before runs every period.
    assert!(simulate(&lasting("high-6", 4.0, 100.0), &Settings::default()).unwrap().jumps.is_empty());
}

/// The scene `name` with another amplitude, and static and kinetic friction where `mu` says so.
fn opening(name: &str, amplitude_nm: f64, mu: Option<f64>, seconds: f64) -> Scenario {
    let mut long = lasting(name, seconds, 100.0);
    if let ScenarioKind::TorsionalExcitation { amplitude_nm: amplitude, .. } = &mut long.kind {
        *amplitude = amplitude_nm;
    }
    if let Some(mu) = mu {
        (long.clutch.friction.static_, long.clutch.friction.kinetic) = (mu, mu);
    }
    long
}

/// Contacts that open, bounce and slip in each period make the choice of steps erratic; the motion repeats all the same.
#[test]
fn periods_in_which_the_contact_opens_are_added_too() {
    for (name, amplitude_nm, mu, changes, until_s) in [
        ("high-10", 14.0, None, 26, 2.0),
        ("high-10", 20.0, None, 40, 2.0),
        // Slides on and on: the balance of drag and torque is reached slowly.
        ("low-10-mu082", 10.0, Some(0.08), 0, 8.0),
    ] {
        let settings = Settings { energy: true, ..Settings::default() };
        let scene = opening(name, amplitude_nm, mu, 4.503);
        let jumped = simulate(&scene, &settings).unwrap();
        let whole = simulate(&scene, &Settings { every_period: true, ..settings.clone() }).unwrap();
        let worst = jumped.scales.worst_figure(&jumped.off(&whole));
        println!("{name} {amplitude_nm}: {:?}; off {worst:?}", jumped.jumps);
        assert!(worst.1 < settings.tolerance && jumped.verdict == whole.verdict);
        assert_eq!(jumped.events, whole.events);
        assert!(jumped.energy.unwrap().relative().abs() < 1e-6);
        let long = simulate(&opening(name, amplitude_nm, mu, 60.0), &settings).unwrap();
        let jump = long.jumps[0];
        println!("   60 s: {jump:?}, {} steps", long.steps);
        // Every period of the finest run would be 6000; of all runs, 2 million steps.
        assert!(jump.from_s < until_s && long.steps < 300_000, "{jump:?}, {} steps", long.steps);
        assert!(jump.events == changes && jump.error <= 0.1 * settings.tolerance);
        assert!(long.tolerance_reached, "{:?}", long.error);
    }
}
