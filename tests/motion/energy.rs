//! Where the energy of every scene goes: works of friction, damping and torques against what moves and is stored.

use sprag_design::clutch::ScenarioKind;
use sprag_design::design::Design;
use sprag_design::dynamics::{EnergyBalance, RunSettings, run};
use sprag_design::scenario::{Settings, prepare, simulate};
use std::path::Path;

fn designs() -> Vec<Design> {
    let files = std::fs::read_dir("designs").unwrap().map(|entry| entry.unwrap().path());
    files.filter(|p| p.extension().is_some_and(|e| e == "toml")).map(|p| Design::read(&p).unwrap()).collect()
}

#[test]
fn every_scene_of_the_designs_balances_to_the_tolerance() {
    let mut seen = 0;
    for design in designs() {
        for scenario in &design.scenarios {
            let settings = Settings { energy: true, ..Settings::default() };
            let Some(e) = simulate(scenario, &settings).ok().and_then(|s| s.energy) else { continue };
            seen += 1;
            println!("{}: {:.1e} of {:.3} J", scenario.name, e.relative(), e.through_j);
            assert!(e.through_j > 0.0 && e.relative().abs() < settings.tolerance, "{}: {e:?}", scenario.name);
        }
    }
    assert!(seen > 20, "{seen}");
}

/// Balance of the multi-arc clutch in high-10, changed.
fn changed(
    tolerance: f64,
    change: impl Fn(&mut sprag_design::clutch::Scenario),
) -> (EnergyBalance, f64, f64) {
    let design = Design::read(Path::new("designs/huang2017-multi-arc.toml")).unwrap();
    let mut scene = design.scenario("high-10").unwrap().clone();
    change(&mut scene);
    let p = prepare(&scene).unwrap();
    let settings = RunSettings {
        tolerance,
        duration_s: p.duration_s,
        longest_step_s: 5e-4,
        most_steps: 1_000_000,
        energy: true,
        ..RunSettings::default()
    };
    let r = run(&p.model, p.state, p.mode, &settings);
    (r.energy.unwrap(), r.open_s, r.outer.distance_m)
}

#[test]
fn slip_loss_of_contact_and_mean_speed_balance_far_below_the_tolerance() {
    let at_speed = |speed: f64, mu: f64| {
        changed(1e-11, |s| {
            s.clutch.friction.static_ = mu;
            s.clutch.friction.kinetic = 0.7 * mu;
            if let ScenarioKind::TorsionalExcitation { speed_rad_s, .. } = &mut s.kind {
                *speed_rad_s = speed;
            }
        })
    };
    for (speed, mu) in [(0.0, 0.12), (0.0, 0.09), (400.0, 0.12), (400.0, 0.09), (900.0, 0.12)] {
        let (e, open_s, slipped_m) = at_speed(speed, mu);
        println!(
            "{speed} rad/s, mu {mu}: open {open_s:.2e} s, {slipped_m:.2e} m, {:.1e}, {e:?}",
            e.relative()
        );
        assert!(e.friction_inner_j < 0.0 && e.friction_outer_j <= 0.0 && e.race_damping_j < 0.0);
        // What friction took is known to a thousandth of itself, the smallest of all works.
        assert!(e.residual_j().abs() < 1e-3 * e.friction_inner_j.abs(), "{speed}, {mu}: {e:?}");
        assert!(e.relative().abs() < 1e-9, "{speed}, {mu}: {:e}", e.relative());
    }
}
