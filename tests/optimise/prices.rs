//! What limits and bounds cost at an optimum, and how many optima there are.

use super::clutch::{HUANG, changed, search_with};
use sprag_design::Design;
use sprag_design::optimise::*;

/// Radii and junctions of the multi-arc clutch under another objective, centroid and keep-contact speed as they are.
fn shaped(aim: &str, more: &[(&str, &str)]) -> Design {
    let variables = "  { name = \"r_i1_mm\", min = 3.90, max = 4.12 },\n  { name = \"junction_1_rad\", min = 0.03, max = 0.11 },\n  \
                     { name = \"junction_2_rad\", min = 0.115, max = 0.25 },\n";
    let mut changes = vec![
        ("objective = \"slip-margin\"", aim),
        (r#"scenarios = ["high-6", "low-10", "rated-45", "rated-45-at-speed"]"#, r#"scenarios = ["low-10"]"#),
        ("  { name = \"centroid_x_mm\", min = -0.3, max = 0.5 },\n", variables),
        ("  { name = \"centroid_y_mm\", min = 0.2, max = 0.8 },\n", ""),
        ("limits = { keep_contact_to_rpm = 6000 }", ""),
    ];
    changes.extend(more);
    changed(HUANG, &changes)
}

/// The capacity's price is found again by a search with the limit raised. What does not hold it has none.
#[test]
fn a_torque_capacity_is_priced_by_what_decides_it() {
    let method = SearchMethod::default();
    let aim = "objective = \"torque-capacity\"";
    let found = search_with(&shaped(aim, &[]), &method);
    println!("{:?} {:#?}", found.objective, found.prices);
    let price = found.prices.iter().find(|p| p.of == "hoop-inner").expect("it decides the capacity");
    let raised = shaped(aim, &[("hoop_inner_mpa = 900.0", "hoop_inner_mpa = 910.0")]);
    let after = search_with(&raised, &method);
    let (promised, bought) = (10.0 * price.gain_per_unit, after.objective.1 - found.objective.1);
    println!("promised {promised:.4} Nm, bought {bought:.4} Nm");
    assert!(bought > 1.0 && (promised / bought - 1.0).abs() < 0.1, "{promised} {bought}");
    let more_friction = shaped(aim, &[("static = 0.12 ", "static = 0.1205 ")]);
    if let Some(grip) = found.prices.iter().find(|p| p.of == "grip-inner") {
        let after = search_with(&more_friction, &method);
        let (promised, bought) = (5e-4 * grip.gain_per_unit, after.objective.1 - found.objective.1);
        println!("promised {promised:.4} Nm, bought {bought:.4} Nm");
        assert!((promised - bought).abs() < 0.1 * bought.abs().max(0.05), "{promised} {bought}");
    }
    // A hundredth of a limit's value buys something that is seen: no rounding among the prices.
    for p in &found.prices {
        assert!(p.gain_per_unit * p.value * 0.01 > 1e-6, "{p:?}");
    }
}

/// A target that is met: the departure is 0 at every end of a climb, which is one optimum, and nothing holds it.
#[test]
fn a_target_met_is_one_optimum_and_costs_nothing() {
    let aim =
        "objective = \"stiffness-curve\"\ntarget = [[20.0, 2.15], [50.0, 5.30], [80.0, 7.60], [100.0, 8.70]]";
    let method = SearchMethod { starts: 8, most_starts: 32, ..SearchMethod::default() };
    let found = search_with(&shaped(aim, &[]), &method);
    println!("{:?} {:?} {} {:?}", found.objective, found.optima, found.evaluations, found.prices);
    assert!(found.objective.1 < 1e-7, "{:?}", found.objective);
    assert_eq!(found.optima.seen, 1, "{:?}", found.starts);
    assert_eq!(found.starts.len(), 8, "no more climbs than are asked for at first");
    assert!(found.prices.is_empty(), "{:?}", found.prices);
}

/// A variable that moves nothing at the start, but does elsewhere in the box, is searched.
#[test]
fn a_variable_level_at_the_start_is_searched() {
    let design = changed(
        HUANG,
        &[
            ("{ radius_mm = 4.08, until_rad = 0.12 }", "{ radius_mm = 4.08, until_rad = 0.30 }"),
            ("nominal_torque_nm = 90.0\npeak_torque_nm = 110.0\n", ""),
            ("hertz_nominal_mpa = 4200.0 ", "# "),
            ("hertz_peak_mpa = 4600.0 ", "# "),
            ("hoop_inner_mpa = 900.0\nhoop_outer_mpa = 750.0\n", ""),
            (
                r#"scenarios = ["high-6", "low-10", "rated-45", "rated-45-at-speed"]"#,
                r#"scenarios = ["low-10"]"#,
            ),
            ("{ name = \"r_i2_mm\", min = 3.6, max = 4.8 }", "{ name = \"r_i2_mm\", min = 4.0, max = 4.8 }"),
            ("{ name = \"r_i3_mm\", min = 3.6, max = 5.2 }", "{ name = \"r_i3_mm\", min = 3.4, max = 5.2 }"),
            (
                "{ name = \"centroid_x_mm\", min = -0.3, max = 0.5 }",
                "{ name = \"junction_2_rad\", min = 0.062, max = 0.40 }",
            ),
            ("  { name = \"centroid_y_mm\", min = 0.2, max = 0.8 },\n", ""),
            ("limits = { keep_contact_to_rpm = 6000 }", ""),
        ],
    );
    let found = search_with(&design, &SearchMethod { starts: 8, most_starts: 8, ..SearchMethod::default() });
    println!("{:?} {:?} after {}", found.objective, found.outcome.x, found.evaluations);
    assert!(found.variables.iter().all(|v| !v.dropped), "{:?}", found.variables);
    // What the point (4.0, 0.062, 3.4) of the box has.
    assert!(found.feasible() && found.objective.1 > 0.4811, "{:?}", found.objective);
}
