//! The friction that a scene needs to stick: one definition, whatever the contact does.

use sprag_design::clutch::{Scenario, ScenarioKind};
use sprag_design::design::Design;
use sprag_design::dynamics::{RunSettings, run};
use sprag_design::scenario::{Settings, Simulation, Verdict, prepare, simulate};
use std::path::Path;

fn scene(file: &str, name: &str) -> Scenario {
    Design::read(Path::new(file)).unwrap().scenario(name).unwrap().clone()
}

fn huang(amplitude: f64) -> Scenario {
    let mut scene = scene("designs/huang2017-multi-arc.toml", "high-8");
    if let ScenarioKind::TorsionalExcitation { amplitude_nm, .. } = &mut scene.kind {
        *amplitude_nm = amplitude;
    }
    scene
}

fn at(scene: &Scenario) -> Simulation {
    simulate(scene, &Settings::default()).unwrap()
}

/// Towards the amplitude at which contact opens the trough of N falls to nothing, where |T|/N has no bound: its peak there
/// asked for a friction of 0.24 at 7.75 Nm and 3.6 at 7.77 Nm, of 0.079 again at 7.775 Nm, and called "sticks" with -97 %.
#[test]
fn the_friction_needed_grows_smoothly_past_the_opening_of_the_contact() {
    let mut last: Option<f64> = None;
    let mut opened = [false; 2];
    for amplitude in [7.5, 7.65, 7.7, 7.74, 7.76, 7.77, 7.773, 7.775, 7.8, 7.82] {
        let s = at(&huang(amplitude));
        let d = s.demand.unwrap();
        let needed = d.required_friction.unwrap();
        println!(
            "{amplitude} Nm: {needed:.7}, contact margin {:.5}, bisected {}",
            d.contact_margin, d.by_bisection
        );
        opened[usize::from(d.contact_margin < 0.0)] = true;
        assert_eq!(s.verdict, Some(Verdict::Sticks));
        assert!(last.is_none_or(|l| (needed - l).abs() < 2e-5), "{amplitude}: {last:?} {needed}");
        last = Some(needed);
    }
    assert!(opened[0] && opened[1]);
}

/// A margin above zero is a clutch that sticks. One below need not slip by 1 um, which is what the verdict says, but here does.
#[test]
fn the_slip_margin_has_the_sign_of_the_verdict() {
    let bench = "designs/huang2017-bench.toml";
    let others =
        ["engagement", "engagement-hard", "engagement-weak-spring", "engagement-vernay", "high-10-vernay"];
    let scenes = [7.0, 7.77, 7.8, 7.84, 7.9, 10.0].map(huang).into_iter();
    for scene in scenes.chain(others.map(|name| scene(bench, name))) {
        let s = at(&scene);
        let d = s.demand.unwrap();
        println!(
            "{}: {:?}, needs {:?}, margin {:.4?}",
            scene.name, s.verdict, d.required_friction, d.slip_margin
        );
        assert!(s.tolerance_reached);
        assert_eq!(s.verdict == Some(Verdict::Sticks), d.slip_margin >= Some(0.0), "{}", scene.name);
    }
}

/// What was bisected is a limit indeed: a little less friction, and a contact under load begins to slip or the slip is seen.
#[test]
fn below_the_friction_that_was_bisected_the_scene_does_not_stick() {
    for mut scene in [huang(7.8), huang(7.84), scene("designs/huang2017-bench.toml", "engagement-hard")] {
        let d = at(&scene).demand.unwrap();
        let needed = d.required_friction.unwrap();
        assert!(d.by_bisection);
        let kinetic = scene.clutch.friction.kinetic;
        let mut sticks = |factor: f64| {
            let mu = factor * needed;
            (scene.clutch.friction.static_, scene.clutch.friction.kinetic) = (mu, kinetic.min(mu));
            let p = prepare(&scene).unwrap();
            let r = run(
                &p.model,
                p.state,
                p.mode,
                &RunSettings {
                    tolerance: 1e-8,
                    duration_s: p.duration_s,
                    longest_step_s: p.period_s.unwrap_or(p.duration_s / 25.0) / 14.0,
                    most_steps: 1_000_000,
                    ..RunSettings::default()
                },
            );
            let slipped = r.inner.net_m - r.engaged.unwrap().inner.net_m;
            println!(
                "{}: {mu:.7}: begins under {} of {} N, {slipped:e} m",
                scene.name, r.slip_begins_n, p.model.loaded_n
            );
            r.slip_begins_n < p.model.loaded_n && slipped.abs() <= 1e-6
        };
        assert!(sticks(1.0 + 1e-4), "{}", scene.name);
        assert!(!sticks(1.0 - 1e-4), "{}", scene.name);
    }
}

/// Where B holds whatever that takes |T|/N outside has no bound as the contact unloads (2e5 at 10 Nm, another number at each
/// tolerance): there it counts as far as it is loaded.
#[test]
fn what_a_contact_that_holds_is_asked_for_converges() {
    let scene = scene("designs/huang2017-bench.toml", "high-10-vernay");
    let run = |tolerance: f64| simulate(&scene, &Settings { tolerance, ..Settings::default() }).unwrap();
    let fine = run(1e-9);
    assert!(
        fine.contact_lost_s > 0.0 && (0.04..0.12).contains(&fine.peaks.tan_outer),
        "{}",
        fine.peaks.tan_outer
    );
    for tolerance in [1e-5, 1e-6, 1e-7] {
        let s = run(tolerance);
        let off = (s.peaks.tan_outer - fine.peaks.tan_outer).abs();
        println!(
            "{tolerance:e}: {:.9}, {off:e} off, {:e} stated",
            s.peaks.tan_outer,
            s.error.unwrap().tan_outer
        );
        assert!(s.tolerance_reached && off < tolerance);
    }
}

/// A run that ends at a limit of work ends somewhere: what it knows is a verdict at most, and no error.
#[test]
fn figures_of_a_run_that_gave_up_have_no_error() {
    let lost = huang(10.0);
    let s = simulate(&lost, &Settings { most_events: Some(20), ..Settings::default() }).unwrap();
    println!("{:?} {:?} at {} s", s.verdict, s.stop, s.t_s);
    assert!(s.stop.gave_up() && s.error.is_none() && !s.tolerance_reached && s.t_s < 0.2);
    // Coarser runs that came to the end are the better answer.
    let whole = at(&lost);
    let most_steps = Some(2000);
    let s = simulate(&lost, &Settings { most_steps, tolerance: 1e-10, ..Settings::default() }).unwrap();
    println!("{:?} {:?} {:?}", s.verdict, s.finer_gave_up, s.error);
    assert!(s.finer_gave_up.is_some() && !s.stop.gave_up() && !s.tolerance_reached);
    let off = (s.theta_inner_rad - whole.theta_inner_rad).abs();
    assert!(s.verdict == whole.verdict && off < s.error.unwrap().theta_inner_rad + 1e-8, "{off:e}");
}
