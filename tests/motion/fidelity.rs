//! What the planner leaves out, against everything, on every scenario of `designs/`.

use sprag_design::clutch::{Scenario, ScenarioKind};
use sprag_design::design::Design;
use sprag_design::fidelity::{Planned, Terms, plan, simulate};
use sprag_design::scenario::Settings;
use std::path::Path;

fn designs() -> Vec<Design> {
    let mut paths: Vec<_> = std::fs::read_dir("designs").unwrap().map(|e| e.unwrap().path()).collect();
    paths.retain(|p| p.extension().is_some_and(|e| e == "toml"));
    paths.sort();
    assert!(paths.len() >= 3);
    paths.iter().map(|p| Design::read(p).unwrap_or_else(|e| panic!("{e}"))).collect()
}

fn both(scenario: &Scenario) -> [Planned; 2] {
    [Terms::Felt, Terms::All].map(|terms| simulate(scenario, &Settings::default(), terms).unwrap())
}

/// Full minus reduced stays below the costs that were stated before the run, beside the errors of both.
fn holds(name: &str, [reduced, full]: &[Planned; 2]) {
    let cost: f64 = reduced.left_out.iter().map(|t| t.cost_rad.unwrap()).sum();
    let (a, b) = (&reduced.simulation, &full.simulation);
    let error = |s: &sprag_design::scenario::Simulation| s.error.map_or(0.0, |e| e.theta_inner_rad);
    let difference = (a.theta_inner_rad - b.theta_inner_rad).abs();
    let allowed = cost + error(a) + error(b);
    let terms: Vec<&str> = reduced.left_out.iter().map(|t| t.term).collect();
    println!(
        "{name}: {difference:.1e} of {allowed:.1e} rad; rhs {} of {}; without {terms:?}",
        a.rhs_evaluations, b.rhs_evaluations
    );
    assert!(difference <= allowed, "{name}: {difference:e} > {allowed:e}");
    assert_eq!((a.verdict, a.stop), (b.verdict, b.stop), "{name}");
    assert!(full.left_out.is_empty());
    if cost == 0.0 {
        // Nothing but work is saved: the figures agree to what the tolerance promises of both.
        let (p, q) = (&a.peaks, &b.peaks);
        let near = |x: f64, y: f64, scale: f64| assert!((x - y).abs() <= 2e-6 * scale, "{name}: {x} {y}");
        near(p.normal_min_n, q.normal_min_n, q.normal_max_n.max(1.0));
        near(p.normal_max_n, q.normal_max_n, q.normal_max_n.max(1.0));
        near(a.offset_rad, b.offset_rad, 1.0);
        let margins = |s: &sprag_design::scenario::Simulation| {
            s.demand.map_or([0.0; 2], |d| [d.slip_margin.unwrap_or(-1.0), d.contact_margin])
        };
        for (x, y) in margins(a).into_iter().zip(margins(b)) {
            near(x, y, 1.0);
        }
    }
    // The answer is tightened until two runs agree: either of the two may need a run more than the other.
    assert!(a.rhs_evaluations <= 2 * b.rhs_evaluations, "{name}");
}

#[test]
fn full_minus_reduced_stays_below_the_stated_cost_in_every_scene() {
    let (mut scenes, mut halved, mut shortened) = (0, 0, 0);
    let mut work = [0, 0];
    for design in designs() {
        for scenario in &design.scenarios {
            let pair = both(scenario);
            holds(&format!("{}, {}", design.name, scenario.name), &pair);
            scenes += 1;
            for (sum, planned) in work.iter_mut().zip(&pair) {
                *sum += planned.simulation.rhs_evaluations;
            }
            let has = |word: &str| pair[0].left_out.iter().any(|t| t.term.contains(word));
            halved += usize::from(has("friction"));
            shortened += usize::from(has("arcs"));
            // The friction law is left out exactly where nothing slips.
            let slipped = pair[1].simulation.demand.is_none_or(|d| d.slip_margin <= Some(1e-6));
            assert!(!(has("friction") && slipped), "{}", scenario.name);
        }
    }
    assert!(scenes >= 30 && halved >= 10 && shortened >= 1, "{scenes} {halved} {shortened}");
    println!("right-hand sides: {} reduced, {} full", work[0], work[1]);
    assert!(work[0] < work[1], "{work:?}");
}

/// The planner counts torques, not the inertia behind a change of speed: a curve too short is built again.
#[test]
fn a_curve_that_was_cut_too_short_is_built_again() {
    let design = Design::read(Path::new("designs/huang2017-bench.toml")).unwrap();
    let mut scenario = design.scenario("speed-ramp").unwrap().clone();
    if let ScenarioKind::Transient { overrun_rad_s, duration_s, .. } = &mut scenario.kind {
        (*overrun_rad_s, *duration_s) = (0.0, 0.02);
    }
    scenario.torque_history = Some(vec![[0.0, 3.0], [1.0, 3.0]]);
    // 1.41e-3 kg m^2 at 20 000 rad/s^2: 28 Nm.
    scenario.speed_history = Some(vec![[0.0, 0.0], [0.02, 400.0]]);
    let (plan, cut) = plan(&scenario, None).unwrap();
    let short = cut.model.curve.arc_count();
    assert!(plan.reduction.reach_nm.is_some() && short < 3);
    let pair = both(&scenario);
    holds("inertia", &pair);
    assert!(pair[0].prepared.model.curve.arc_count() > short && pair[0].left_out.is_empty());
}
