//! Every objective, fronts between them, and the swarm.

use super::clutch::{HUANG, changed, design, problem, search_with, task};
use super::problems::all;
use sprag_design::Follow;
use sprag_design::design::{Design, Objective};
use sprag_design::margin::{self, Capacities, When, load_margins, load_state};
use sprag_design::optimise::*;
use std::f64::consts::PI;

const SCENES: &str = r#"scenarios = ["high-6", "low-10", "rated-45", "rated-45-at-speed"]"#;

/// The multi-arc clutch with another objective, over its radii alone.
fn aimed(objective: &str, more: &str) -> Design {
    changed(
        HUANG,
        &[
            ("objective = \"slip-margin\"", &format!("objective = \"{objective}\"\n{more}")),
            (SCENES, r#"scenarios = ["low-10"]"#),
            ("  { name = \"centroid_x_mm\", min = -0.3, max = 0.5 },\n", ""),
            ("  { name = \"centroid_y_mm\", min = 0.2, max = 0.8 },\n", ""),
            ("limits = { keep_contact_to_rpm = 6000 }", ""),
        ],
    )
}

#[test]
fn each_objective_gets_better_and_holds_every_limit() {
    for (objective, sense) in [("torque-capacity", 1.0), ("peak-pressure", -1.0), ("windup", -1.0)] {
        let found = search_with(&aimed(objective, ""), &SearchMethod::default());
        println!(
            "{objective}: {:?}, {:?} after {}",
            found.objective, found.outcome.status, found.evaluations
        );
        assert!(found.feasible(), "{objective}");
        assert!(found.improved() && (found.objective.1 - found.objective.0) * sense > 0.0, "{objective}");
        let new = Design::parse(&found.file, "new.toml").unwrap();
        let state = load_state(&new).unwrap();
        let expected = match objective {
            "torque-capacity" => {
                // As `check` has it: the least of the required capacities at peak torque, and of those at nominal scaled.
                let rows = load_margins(&new, &new.limits, Capacities::Wanted, &state);
                let scaled = rows.iter().filter(|m| m.required).filter_map(|m| {
                    let share = if m.limit.when == When::Nominal { 110.0 / 90.0 } else { 1.0 };
                    Some(m.torque_capacity_nm? * share)
                });
                scaled.fold(f64::INFINITY, f64::min)
            }
            "peak-pressure" => {
                state.curve.at_torque(110.0).map(|p| p.hertz_inner_pa.max(p.hertz_outer_pa)).unwrap() * 1e-6
            }
            _ => state.curve.at_torque(90.0).unwrap().windup_rad.to_degrees(),
        };
        assert!(
            (found.objective.1 / expected - 1.0).abs() < 1e-9,
            "{objective}: {} {expected}",
            found.objective.1
        );
    }
}

/// Longer sprags take their races along by the same millimetres; the pitch of the crowd and the rest stay.
const LINKED: &str = r#"  { name = "length_mm", min = 5.0, max = 12.0, moves = ["races.width_mm"] },
  { name = "races.outer_outside_radius_mm", min = 24.0, max = 28.0 },
  { name = "spring.drag_torque_nm", min = 0.01, max = 0.03 },
  { name = "r_i2_mm""#;

/// Mass, width, diameter, drag and the speed of lift-off are those that the rest of the library tells, and a search makes them
/// better.
#[test]
fn what_a_clutch_weighs_takes_and_drags_can_be_made_less() {
    for (objective, better) in [
        ("mass", -1.0),
        ("width", -1.0),
        ("outside-diameter", -1.0),
        ("drag", -1.0),
        ("contact-margin", 1.0),
        ("keep-contact", 1.0),
        ("lift-off", -1.0),
    ] {
        let design = aimed(objective, "");
        let design = changed(&design.source, &[("  { name = \"r_i2_mm\"", LINKED)]);
        let problem = problem(&design);
        let x: Vec<f64> = task(&design).variables.iter().map(|v| v.start + 0.3 * (v.max - v.start)).collect();
        let (assessed, there) = (problem.assess_at(&x).unwrap(), problem.design_at(&x).unwrap());
        let (clutch, state) = (&there.clutch, load_state(&there).unwrap());
        assert!((clutch.races.width_m - clutch.sprags.length_m).abs() < 1e-12 && clutch.races.width_m > 7e-3);
        let overrun =
            |speed: f64| margin::overrun_at(&there, &state, speed, speed).unwrap().state.drag_torque_nm;
        let expected = match objective {
            "mass" => 1e3 * clutch.masses_kg().iter().sum::<f64>(),
            "width" => x[0],
            "outside-diameter" => 2.0 * x[1],
            "drag" => overrun(0.0).max(overrun(4500.0 * PI / 30.0)),
            "contact-margin" => assessed.rows.iter().find(|m| m.code() == "contact:low-10").unwrap().margin(),
            _ => margin::lift_off_rad_s(&there, &state, 1e4).unwrap() * 30.0 / PI,
        };
        let value = problem.value(&assessed, 0);
        assert!((value / expected - 1.0).abs() < 1e-9, "{objective}: {value} {expected}");
        let found = search_with(&design, &SearchMethod { starts: 1, ..SearchMethod::default() });
        let (before, after) = found.objective;
        println!("{objective}: {before} -> {after}, {:?} after {}", found.outcome.status, found.evaluations);
        assert!(found.feasible() && (after - before) * better > 0.0, "{objective}: {before} -> {after}");
        let new = Design::parse(&found.file, "new.toml").unwrap().clutch;
        assert!((new.races.width_m - new.sprags.length_m).abs() < 1e-12, "{objective}");
    }
}

/// What is in proportion stays so, and is another problem than one whose links differ.
#[test]
fn links_in_proportion_keep_their_ratio() {
    let scaled = |scales: &str| {
        let line = format!(
            "  {{ name = \"length_mm\", min = 5.0, max = 12.0, scales = [{scales}] }},\n  {{ name = \"r_i2_mm\""
        );
        problem(&changed(HUANG, &[("  { name = \"r_i2_mm\"", &line)]))
    };
    let both = scaled(r#""races.width_mm", "spring.drag_torque_nm""#);
    let mut x: Vec<f64> = task(&design(HUANG)).variables.iter().map(|v| v.start).collect();
    x.insert(0, 9.0);
    let clutch = both.design_at(&x).unwrap().clutch;
    assert!((clutch.races.width_m - 9e-3).abs() < 1e-15, "{}", clutch.races.width_m);
    assert!(
        (clutch.spring.drag_torque_nm / (1.5 * 0.0166) - 1.0).abs() < 1e-12,
        "{}",
        clutch.spring.drag_torque_nm
    );
    assert_ne!(both.identity(), scaled(r#""races.width_mm""#).identity());

    // In steps of 0.04 mm: 8.99 mm of width becomes 9.00; a torque is no length and keeps its ratio.
    x[0] = 8.99;
    let stepped = both.with_links_in_steps(0.04);
    let clutch = stepped.design_at(&x).unwrap().clutch;
    assert_eq!(clutch.races.width_m, 9e-3);
    assert!((clutch.spring.drag_torque_nm / (8.99 / 6.0 * 0.0166) - 1.0).abs() < 1e-12);
    assert_ne!(both.identity(), stepped.identity());
    let file = stepped.finished_file(&x).unwrap();
    assert!(file.contains("width_mm = 9.0"), "{file}");
}

/// A capacity is the largest peak torque, with the nominal torque in proportion, that every static limit holds: also where one
/// decides that is held at nominal torque without saying so in its code.
#[test]
fn a_capacity_is_where_every_limit_just_holds() {
    let base = aimed("torque-capacity", "");
    let text = base.source.replacen(
        "hoop_inner_mpa = 900.0",
        "hoop_inner_mpa = 900.0\nequivalent_inner_mpa = 500.0",
        1,
    );
    let design = changed(&text, &[]);
    let problem = problem(&design);
    let x: Vec<f64> = task(&design).variables.iter().map(|v| v.start).collect();
    let assessed = problem.assess_at(&x).unwrap();
    let capacity = problem.value(&assessed, 0);
    let state = load_state(&design).unwrap();
    let held = |peak: f64| {
        let limits = sprag_design::Limits {
            peak_torque_nm: Some(peak),
            nominal_torque_nm: Some(peak * 90.0 / 110.0),
            ..design.limits
        };
        load_margins(&design, &limits, Capacities::LeftOut, &state).iter().filter(|m| m.required).all(|m| {
            // Contact at speed and re-engagement do not depend on torque.
            m.held() || ["keep-contact", "re-engagement"].contains(&m.limit.code)
        })
    };
    let least = assessed.measures.iter().min_by(|a, b| a.value.total_cmp(&b.value)).unwrap();
    println!("{capacity} by {}", least.code);
    assert_eq!(least.code, "capacity:equivalent-inner");
    assert!(held(0.9999 * capacity) && !held(1.0001 * capacity), "{capacity}");
    for m in load_margins(&design, &design.limits, Capacities::Wanted, &state) {
        let scaled = design.limits.nominal_torque_nm.unwrap() * 1.01;
        let more = sprag_design::Limits { nominal_torque_nm: Some(scaled), ..design.limits };
        let after = load_margins(&design, &more, Capacities::LeftOut, &state);
        let moved = after.iter().find(|r| r.is_of(&m)).unwrap().margin() != m.margin();
        assert_eq!(moved, (m.limit.when == When::Nominal), "{}", m.code());
    }
}

/// Windups of a clutch whose radii are known are the target: the search finds these radii.
#[test]
fn a_target_curve_gives_the_radii_back_that_made_it() {
    let planted =
        changed(HUANG, &[("radius_mm = 4.08", "radius_mm = 3.80"), ("radius_mm = 4.15", "radius_mm = 4.40")]);
    let state = load_state(&planted).unwrap();
    let row = |t: f64| format!("[{t}, {:?}]", state.curve.at_torque(t).unwrap().windup_rad.to_degrees());
    let target = format!("target = [{}]", [10.0, 20.0, 40.0, 60.0, 90.0].map(row).join(", "));
    let found = search_with(&aimed("stiffness-curve", &target), &SearchMethod::default());
    println!("{:?} {:?} after {}", found.objective, found.outcome.x, found.evaluations);
    assert!(found.objective.0 > 0.005 && found.objective.1 < 1e-6, "{:?}", found.objective);
    assert!((found.outcome.x[0] - 3.80).abs() < 1e-3 && (found.outcome.x[1] - 4.40).abs() < 1e-3);
}

#[test]
fn the_front_between_two_objectives_is_one() {
    let design = aimed("slip-margin", "");
    let method = SearchMethod::default();
    let found = search_with(&design, &method);
    let aims = [Objective::SlipMargin, Objective::PeakPressure];
    let front =
        front(&found, task(&design), &aims, 4, &method, &Desk::new(&Follow::nobody(), &mut Forgetful))
            .unwrap();
    println!("{front:#?}");
    assert!(front.points.len() >= 4, "{}", front.points.len());
    for pair in front.points.windows(2) {
        // Less slip margin is paid for by less pressure.
        assert!(pair[1].values[0] < pair[0].values[0] && pair[1].values[1] < pair[0].values[1]);
    }
    assert_eq!(front.points[0].anchor, Some(Objective::SlipMargin));
    assert!((front.points[0].values[0] - found.objective.1).abs() < 1e-6);
    // An inner point again, as the best slip margin with its pressure as a limit.
    let inner = &front.points[front.points.len() / 2];
    let limit = format!("hertz_peak_mpa = {:?}", inner.values[1]);
    let text = design.source.replacen("hertz_peak_mpa = 4600.0", &limit, 1);
    let again = search_with(&changed(&text, &[]), &method);
    assert!((again.objective.1 - inner.values[0]).abs() < 1e-4, "{} {:?}", again.objective.1, inner.values);
}

/// Known optima, Rosenbrock's valley and a problem with kinks among them: a swarm of 8000 points comes near, the same
/// seed to the bit, and its best is never better than the known optimum.
#[test]
fn the_swarm_comes_near_known_optima() {
    for name in ["HS35 (Beale)", "Rosenbrock in a disc", "CB2", "Madsen"] {
        let model = all().into_iter().find(|m| m.name == name).unwrap();
        let ask = |seed| {
            let bounds = (model.start.as_slice(), model.lo.as_slice(), model.hi.as_slice());
            swarm(&model, bounds, &Settings::default(), (8000, seed), SearchRun::default()).unwrap()
        };
        let (one, two) = (ask(1), ask(1));
        assert_eq!((&one.x, one.evaluations), (&two.x, two.evaluations));
        let short = model.optimum - one.evaluation.least_margin();
        println!("{name}: {short:.2e} short after {}", one.evaluations);
        assert!(one.evaluation.violation() <= 1e-8 && short > -1e-7, "{name}");
        assert!(short < 1e-2 * model.optimum.abs().max(1.0), "{name}: {short}");
        assert!(ask(2).x != one.x);
    }
}

/// A scene that leaves out what it cannot feel answers as one in full; a looser tolerance moves margins by less than it.
#[test]
fn what_the_search_leaves_out_costs_nothing() {
    let design = design(HUANG);
    let x: Vec<f64> = task(&design).variables.iter().map(|v| v.start).collect();
    let reduced = problem(&design);
    let full = reduced.at_fidelity(Fidelity { reduced: false, ..Fidelity::default() });
    let (a, b) = (reduced.assess_at(&x).unwrap(), full.assess_at(&x).unwrap());
    for (a, b) in a.rows.iter().zip(&b.rows) {
        assert!((a.margin() - b.margin()).abs() < 1e-9, "{}: {} {}", a.code(), a.margin(), b.margin());
    }
    let settings = sprag_design::Settings { tolerance: 1e-4, ..Default::default() };
    let loose = reduced.at_fidelity(Fidelity { settings, reduced: true }).assess_at(&x).unwrap();
    for (a, b) in a.rows.iter().zip(&loose.rows) {
        assert!((a.margin() - b.margin()).abs() < 1e-4, "{}: {} {}", a.code(), a.margin(), b.margin());
    }
}
