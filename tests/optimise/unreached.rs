//! Problems that no design holds: what is said, and what would free them.

use super::clutch::{HUANG, PEER_A, changed, design, margin, search_with, task};
use sprag_design::Follow;
use sprag_design::design::{Design, LIMIT_KEYS};
use sprag_design::file::{schema, with_keys};
use sprag_design::margin::margins;
use sprag_design::optimise::*;

/// Slip margin 0.45 where 0.4079 is the most: infeasible, the limit that can be held is named, and with it there is a design.
#[test]
fn a_slip_margin_out_of_reach_is_infeasible_and_says_what_can_be_reached() {
    let ask = |wanted: &str| changed(HUANG, &[("slip_margin = 0.10", &format!("slip_margin = {wanted}"))]);
    let design = ask("0.45");
    let found = search_with(&design, &SearchMethod::default());
    let Status::Infeasible { fighting, least_violation } = &found.outcome.status else {
        panic!("{:?}", found.outcome.status)
    };
    assert!(*least_violation > 0.02 && !found.feasible());
    assert!(fighting.iter().any(|i| found.names.limits[*i] == "hoop-inner"));
    assert!(found.not_held().iter().all(|code| code.starts_with("slip:")), "{:?}", found.not_held());
    let numbers = loosened(&design, &found, &Desk::new(&Follow::nobody(), &mut Forgetful));
    println!("{numbers:#?}");
    let slip = numbers.iter().find(|l| l.key == "limits.slip_margin").expect("it bears on slip");
    let reached = slip.needed.expect("a smaller one can be held");
    assert!((reached - found.objective.1).abs() < 1e-4, "{reached} {:?}", found.objective);
    let hoop = numbers.iter().find(|l| l.key == "limits.hoop_inner_mpa").expect("it bears on slip");
    let needed = hoop.needed.expect("a higher one frees");
    // Verified by a search under the limit that is named, and one a little lower.
    let under = |mpa: f64| {
        let text = with_keys(&design.source, &[("limits.hoop_inner_mpa", mpa)]).unwrap();
        search_with(&Design::parse(&text, "x.toml").unwrap(), &SearchMethod::default()).feasible()
    };
    assert!(needed > 900.0 && under(1.001 * needed) && !under(0.995 * needed), "{needed}");
}

/// The multi-arc clutch under the elastic law opens the contact of high-6 whatever its two variable radii; its first radius,
/// which is no variable, frees it. Contact to the wanted speed is no obstacle: the centroid holds it.
#[test]
fn a_dimension_that_is_no_variable_is_named_where_it_frees() {
    let changes = [
        ("law = \"roller\"\nroller_coefficient = 3.944e-5 ", "law = \"elastic\" "),
        ("limits = { keep_contact_to_rpm = 6000 }", "limits = { keep_contact_to_rpm = 6500 }"),
        (r#"scenarios = ["high-6", "low-10", "rated-45", "rated-45-at-speed"]"#, r#"scenarios = ["high-6"]"#),
    ];
    // Five periods of it, of thirty.
    let design = changed(&HUANG.replace("duration_s = 0.3\n", "duration_s = 0.05\n"), &changes);
    let found = search_with(&design, &SearchMethod::default());
    assert!(matches!(found.outcome.status, Status::Infeasible { .. }), "{:?}", found.outcome.status);
    let nobody = &mut Forgetful;
    let desk = Desk::new(&Follow::nobody(), nobody);
    let numbers = loosened(&design, &found, &desk);
    println!("{numbers:#?}");
    let first = numbers.iter().find(|l| l.key == "r_i1_mm").expect("looked at");
    let needed = first.needed.expect("it frees");
    let text =
        with_keys(&found.problem.file_at(&first.x).unwrap(), &[("sprags.inner_arcs[0].radius_mm", needed)]);
    let freed = found.problem.parsed(&text.unwrap()).unwrap();
    // In full, as it was looked for: where the contact of high-6 just closes a search's own evaluation errs by 5e-6.
    let rows = found.problem.as_checked().fully().assess(&freed).unwrap().rows;
    assert!(rows.iter().all(|m| m.held()), "{rows:#?}");
    // Where the centroid lets go of contact that limit does not hold, and by itself it can be held.
    let centroid = found.problem.variables().iter().position(|v| v == "centroid_x_mm").expect("a variable");
    let mut away = found;
    away.outcome.x[centroid] = away.bounds().1[centroid];
    let each = alone(&away, &desk);
    println!("{each:?}");
    let keep = each.iter().find(|a| a.code == "keep-contact").expect("not held there");
    let back = |(name, x): &(String, f64)| name == "centroid_x_mm" && *x < away.outcome.x[centroid];
    assert!(keep.margin >= 0.0 && keep.changes.iter().any(back), "{keep:?}");
}

/// What is wanted of slip counts at the corners too: less friction than it takes is not held, and `check`'s own margins at
/// that corner say so.
#[test]
fn the_wanted_slip_margin_counts_within_the_tolerances() {
    let text = format!("{HUANG}\n[tolerances]\nfriction = 0.01\n");
    let base = changed(
        &text,
        &[
            ("slip_margin = 0.10", "slip_margin = 0.35"),
            (
                r#"scenarios = ["high-6", "low-10", "rated-45", "rated-45-at-speed"]"#,
                r#"scenarios = ["low-10", "rated-45"]"#,
            ),
        ],
    );
    let found = search_with(&base, &SearchMethod::default());
    assert!(found.feasible());
    let of = base.tolerances.unwrap();
    let nobody = &mut Forgetful;
    let desk = Desk::new(&Follow::nobody(), nobody);
    let made = spread(&found.problem, &found.outcome.x, &of, (20, 1), &desk).unwrap();
    println!("{:?} yield {} {:?}", made.objective, made.yield_share, made.not_held);
    assert!(made.objective.1 < 0.35 && !made.held());
    assert!(made.not_held.iter().any(|(code, at)| code == "slip:rated-45" && at == "-friction"));
    let less = with_keys(&found.file, &[("friction.static", 0.11), ("friction.kinetic", 0.0825)]).unwrap();
    let there = Design::parse(&less, "x.toml").unwrap();
    let rows = margins(&there, &there.check_scenarios, &Default::default()).unwrap();
    assert!(margin(&rows, "slip:rated-45") < 0.0);
    // Some draws have enough friction, and some have not.
    assert!(made.yield_share > 0.0 && made.yield_share < 1.0, "{}", made.yield_share);
    let (lo, hi) = found.bounds();
    let best = robust(
        &found.problem,
        &found.outcome.x,
        (&lo, &hi),
        0.0,
        &of,
        (20, 1),
        &SearchMethod::default(),
        &desk,
    )
    .unwrap();
    assert!(!best.made.held(), "the largest slip margin is 0.4079 at mu_s 0.12, and 0.29 at 0.11");
}

/// Scenarios of `[check]` that the search leaves out count at the corners too.
#[test]
fn what_check_demands_counts_within_the_tolerances() {
    let base = changed(
        PEER_A,
        &[("scenarios = [\"low-10\", \"rated-45\"]", "scenarios = [\"low-10\", \"high-10\"]")],
    );
    let x: Vec<f64> = task(&base).variables.iter().map(|v| v.start).collect();
    let problem = super::clutch::problem(&base);
    let of = base.tolerances.unwrap();
    let nobody = &mut Forgetful;
    let made = spread(&problem, &x, &of, (10, 1), &Desk::new(&Follow::nobody(), nobody)).unwrap();
    assert!(made.not_held.iter().any(|(code, _)| code == "contact:high-10"), "{:?}", made.not_held);
    assert_eq!(made.yield_share, 0.0);
}

/// An oil before the friction of the design.
const OIL: &str = "[lubrication]\noil = \"ISO VG 32\"\ntemperature_c = 60.0\nrace_roughness_um = 0.25\n\
                   sprag_roughness_um = 0.25\n\n[friction]\n";

/// Every number of `[limits]` that a search is under is in its new file.
#[test]
fn every_limit_searched_under_is_written() {
    let keys = schema();
    let keys = keys["properties"]["limits"]["properties"].as_object().unwrap();
    let mut looked_at = 0;
    for key in keys.iter().filter(|(_, s)| s["type"] == "number").map(|(key, _)| key.as_str()) {
        // More than the gap at rest, 8.33 mm; more than the speed to which contact is kept.
        let value = match key {
            "gap_nominal_mm" | "gap_peak_mm" => "8.96",
            "case_depth_mm" => "1.13",
            "lift_off_by_rpm" => "23456.7",
            "slip_margin" => "0.23",
            "windup_nominal_deg" => "17.3",
            "nominal_torque_nm" => "87.3",
            _ => "777.7",
        };
        let limits = format!("limits = {{ {key} = {value}, case_depth_mm = 1.13 }}");
        let limits = match key {
            "case_depth_mm" => "limits = { case_depth_mm = 1.13 }",
            // A film needs its speed, and both an oil.
            "film_lambda" => "limits = { film_lambda = 777.7, film_at_rpm = 500 }",
            "film_at_rpm" => "limits = { film_lambda = 1.5, film_at_rpm = 777.7 }",
            _ => &limits,
        };
        let oil = if key.starts_with("film_") { OIL } else { "[friction]\n" };
        // Pressure along a contact has a bound where its ends are shaped.
        let contact = match key {
            "along_mpa" => "\n[contact]\nend_profile = { kind = \"crown\", radius_mm = 300.0 }\n",
            _ => "\n[contact]\n",
        };
        let limits = ("limits = { keep_contact_to_rpm = 6000 }", limits);
        let design = changed(HUANG, &[limits, ("[friction]\n", oil), ("\n[contact]\n", contact)]);
        let x: Vec<f64> = task(&design).variables.iter().map(|v| v.start).collect();
        let file = super::clutch::problem(&design).finished_file(&x).unwrap();
        let written: toml::Table = toml::from_str(&file).unwrap();
        let there = written["limits"].get(key).map(ToString::to_string);
        assert_eq!(there.as_deref(), Some(value), "{key}");
        assert_eq!(self::design(&file).limits, task(&design).limits, "{key}");
        looked_at += 1;
    }
    assert_eq!(looked_at, LIMIT_KEYS.len());
}
