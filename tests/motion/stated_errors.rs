//! What an error stated by `simulate` is worth: on all scenes of the test set every figure is held against a run whose
//! steps are a thousand times finer.

use sprag_design::clutch::{Scenario, ScenarioKind};
use sprag_design::design::Design;
use sprag_design::scenario::{ErrorEstimate, FIGURES, Settings, Simulation, simulate};
use std::path::Path;

/// The scenes of the paper, the bench's (engagement, torque step, in and out), and a friction that falls within 0.1 mm/s.
fn test_set() -> Vec<Scenario> {
    let all = |file: &str, names: &[&str]| -> Vec<Scenario> {
        let design = Design::read(Path::new(file)).unwrap();
        names.iter().map(|name| design.scenario(name).unwrap().clone()).collect()
    };
    let clutch = "designs/huang2017-multi-arc.toml";
    let mut set = all(
        clutch,
        &["high-6", "high-8", "high-10", "low-6", "low-8", "low-10", "low-8-mu082", "low-10-mu082"],
    );
    set.extend(all(clutch, &["rated-45", "rated-45-at-speed"]));
    let transients =
        ["engagement", "engagement-weak-spring", "engagement-hard", "step-up", "step-down", "in-and-out"];
    set.extend(all("designs/huang2017-bench.toml", &transients));
    let mut steep = all(clutch, &["high-10"]).remove(0);
    (steep.name, steep.clutch.friction.decay_s_per_m) = ("high-10, steep friction".into(), 1e4);
    set.push(steep);
    set
}

fn at(scenario: &Scenario, tolerance: f64) -> Simulation {
    simulate(scenario, &Settings { tolerance, ..Settings::default() }).unwrap()
}

fn figures(e: &ErrorEstimate) -> Vec<(&'static str, f64)> {
    FIGURES.iter().map(|figure| (figure.words, (figure.error)(e))).collect()
}

#[test]
fn the_true_error_stays_below_the_tolerance_and_near_the_one_stated() {
    let (mut count, mut beyond, mut worst) = (0, 0, (0.0, String::new()));
    for scenario in test_set() {
        let exact = at(&scenario, 1e-11);
        let doubt = exact.error.unwrap();
        // Repeated loss of contact in an engagement leaves no ninth digit.
        let swings = matches!(scenario.kind, ScenarioKind::TorsionalExcitation { .. });
        let finest = if swings { 10 } else { 8 };
        for k in 0..=finest {
            let tolerance = 1e-4 * 10_f64.powf(-0.5 * f64::from(k));
            let own = at(&scenario, tolerance);
            let (stated, off) = (own.error.unwrap(), own.off(&exact));
            let name = format!("{}, {tolerance:.1e}", scenario.name);
            assert!(own.tolerance_reached, "{name}: {stated:?}");
            let by_tolerance = own.scales.worst(&off) / tolerance;
            assert!(by_tolerance < 1.0, "{name}: {by_tolerance} of the tolerance off, {off:?}");
            if by_tolerance > worst.0 {
                worst = (by_tolerance, name.clone());
            }
            for ((figure, off), (stated, doubt)) in figures(&off).into_iter().zip(
                figures(&stated)
                    .into_iter()
                    .zip(figures(&doubt))
                    .map(|((_, stated), (_, doubt))| (stated, doubt)),
            ) {
                // A reference knows its figures no better than to its own error, and no sum better than rounding.
                let known = stated + 2.0 * doubt + 1e-13;
                count += 1;
                beyond += u32::from(off > 1.5 * known);
                assert!(off < 20.0 * known, "{name}: {figure} {off:e} off, {stated:e} stated");
            }
        }
    }
    println!(
        "{beyond} of {count} figures are more than 1.5 of their stated errors off; the worst of all is {worst:?} of the tolerance"
    );
    assert!(100 * beyond < count, "{beyond} of {count}");
}
