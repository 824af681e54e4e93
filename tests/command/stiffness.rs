//! `stiffness` and `schema` from outside: JSON, CSV, page, torques beyond the curve.

use crate::program::*;
use serde_json::Value;

const KEYS: [&str; 13] = [
    "torque_nm",
    "normal_inner_n",
    "normal_outer_n",
    "tan_omega",
    "tan_nu",
    "alpha_rad",
    "windup_deg",
    "k_secant_nm_per_rad",
    "k_tangent_nm_per_rad",
    "arc",
    "hertz_inner_mpa",
    "hertz_inner_error_mpa",
    "hertz_outer_mpa",
];

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or_else(|| panic!("{key} in {value}"))
}

/// The whole way from file to JSON against the tables of two independent scripts, as `statics.rs` has it for the
/// library: good to 1e-4 and better.
#[test]
fn designs_give_the_independent_tables() {
    for (design, table) in [
        (SINGLE, include_str!("../reference/static_single_arc.csv")),
        (MULTI, include_str!("../reference/static_multi_arc.csv")),
    ] {
        let mut lines = table.lines().map(|l| l.split(',').collect::<Vec<_>>());
        let header = lines.next().unwrap();
        let rows: Vec<Vec<&str>> = lines.collect();
        let torques: Vec<&str> = rows.iter().map(|r| r[0]).collect();
        let value = json(&run(&["stiffness", design, "--torques", &torques.join(","), "--json"]));
        has_envelope(&value);
        let points = value["points"].as_array().unwrap();
        assert_eq!(points.len(), rows.len());
        for (point, row) in points.iter().zip(&rows) {
            for (key, want) in header.iter().zip(row).filter(|(key, _)| KEYS.contains(key)) {
                let want: f64 = want.parse().unwrap();
                assert!((number(point, key) / want - 1.0).abs() < 1e-4, "{key} {want} in {point}");
            }
        }
    }
}

#[test]
fn every_key_of_every_point_is_a_number_and_arcs_count_from_1() {
    let value = json(&run(&["stiffness", MULTI, "--json"]));
    has_envelope(&value);
    assert!(value["error_estimate"].as_f64().unwrap() < 1e-8);
    let points = value["points"].as_array().unwrap();
    assert_eq!(points.len(), 20);
    assert_eq!(number(points.last().unwrap(), "torque_nm"), 110.0, "up to the design's peak torque");
    for point in points {
        assert_eq!(point.as_object().unwrap().len(), KEYS.len() + 2);
        KEYS.iter().for_each(|key| assert!(number(point, key) > 0.0, "{key}"));
        // The pressure is not that of one arc while a junction lies under the contact: tests/wedge/patch_contact.rs.
        let error = number(point, "hertz_inner_error_mpa") / number(point, "hertz_inner_mpa");
        let known = if point["straddles_junction"] == true { 9e-4..1.3e-3 } else { 0.0..1e-8 };
        assert!(known.contains(&error), "{point}");
    }
    let arcs: Vec<u64> = points.iter().map(|p| p["arc"].as_u64().unwrap()).collect();
    assert!(arcs.is_sorted() && arcs.first() == Some(&1) && arcs.last() == Some(&3), "{arcs:?}");
    let junctions = value["junctions"].as_array().unwrap();
    assert_eq!(junctions.iter().map(|j| j["arc"].as_u64().unwrap()).collect::<Vec<_>>(), [1, 2]);
    for junction in junctions {
        let (torque, arc) = (number(junction, "torque_nm"), junction["arc"].as_u64().unwrap());
        assert!(
            points.iter().all(|p| (p["arc"].as_u64().unwrap() <= arc) == (number(p, "torque_nm") <= torque))
        );
    }
    assert_eq!(value["end"]["reason"], "off-profile");
    assert_eq!(value["points"], value["laws"][0]["points"], "one law stands at the top as well");
}

#[test]
fn the_tangent_is_the_slope_of_the_points() {
    let value = json(&run(&["stiffness", SINGLE, "--torques", "49.99,50,50.01", "--json"]));
    let p = value["points"].as_array().unwrap();
    let rise = number(&p[2], "torque_nm") - number(&p[0], "torque_nm");
    let run = (number(&p[2], "windup_deg") - number(&p[0], "windup_deg")).to_radians();
    let (slope, tangent) = (rise / run, number(&p[1], "k_tangent_nm_per_rad"));
    assert!((slope / tangent - 1.0).abs() < 1e-6, "{slope} {tangent}");
}

#[test]
fn torques_beyond_the_end_are_named_not_refused() {
    let folder = Folder::new();
    let csv = folder.path("curve.csv");
    let output = run(&["stiffness", MULTI, "--torques", "50,300", "--json", "--csv", &csv]);
    assert_eq!(output.status.code(), Some(0));
    let value = json(&output);
    assert_eq!(value["points"].as_array().unwrap().len(), 1);
    assert_eq!(value["beyond_end"], serde_json::json!([300.0]));
    assert!(number(&value["end"], "torque_nm") < 300.0);
    let table = std::fs::read_to_string(csv).unwrap();
    let lines: Vec<&str> = table.lines().collect();
    // The error stands in JSON alone.
    let keys: Vec<&str> = KEYS.into_iter().filter(|key| *key != "hertz_inner_error_mpa").collect();
    assert_eq!(lines[0], format!("contact,{},state", keys.join(",")));
    assert!(lines[1].starts_with("roller,50,") && lines[1].ends_with(",carried"), "{}", lines[1]);
    assert_eq!(lines[2], format!("roller,300{},beyond the end", ",".repeat(11)));
    assert!(stdout(&run(&["stiffness", MULTI, "--torques", "300"])).contains("beyond the end"));
}

#[test]
fn laws_stand_side_by_side() {
    let folder = Folder::new();
    let html = folder.path("laws.html");
    let laws = "hertz,roller,slice,din26281";
    let value = json(&run(&[
        "stiffness",
        MULTI,
        "--contact",
        laws,
        "--max-torque",
        "50",
        "--json",
        "--report",
        &html,
    ]));
    assert!(value.get("points").is_none(), "no law is the only one");
    let list = value["laws"].as_array().unwrap();
    assert_eq!(
        list.iter().map(|l| l["contact"].as_str().unwrap()).collect::<Vec<_>>(),
        laws.split(',').collect::<Vec<_>>()
    );
    assert_eq!(list[1]["roller_coefficient"], 3.944e-5);
    assert_eq!(list[2]["slices"], 60);
    assert!(list[0].get("roller_coefficient").is_none());
    let windup = |i: usize| number(list[i]["points"].as_array().unwrap().last().unwrap(), "windup_deg");
    // The larger coefficient yields more, rigid slices less than the roller law.
    assert!(windup(3) > windup(1) && windup(1) > windup(2), "{} {} {}", windup(3), windup(1), windup(2));
    let page = is_self_contained(html);
    for part in ["More windup than hertz", "K = 3.944e-5", "60 slices", "at 110 Nm"] {
        assert!(page.contains(part), "{part}");
    }
}

#[test]
fn the_design_names_the_default_law() {
    let folder = Folder::new();
    let din = folder.changed(
        MULTI,
        &[("law = \"roller\"", "law = \"din26281\""), ("roller_coefficient = 3.944e-5", "# ")],
    );
    let value = json(&run(&["stiffness", &din, "--torques", "20", "--json"]));
    assert_eq!(value["laws"][0]["contact"], "din26281");
    let roller = json(&run(&["stiffness", &din, "--torques", "20", "--contact", "roller", "--json"]));
    assert_eq!(roller["laws"][0]["roller_coefficient"], 3.944e-5, "stated where the design has none");
}

#[test]
fn malformed_questions_are_code_2_and_write_nothing() {
    let folder = Folder::new();
    let csv = folder.path("a.csv");
    let bad = folder.changed(MULTI, &[("length_mm = 6.0 ", "length_m = 6.0 ")]);
    let missing = folder.path("no-such-file.toml");
    for args in [
        &["stiffness", &bad, "--csv", &csv, "--json"][..],
        &["stiffness", &missing, "--csv", &csv, "--json"],
        &["stiffness", MULTI, "--csv", &csv, "--torques", "1e-9"],
        &["stiffness", MULTI, "--csv", &csv, "--fem", &missing],
        &["stiffness", MULTI, "--csv", MULTI],
    ] {
        let output = run(args);
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        assert!(!output.stderr.is_empty(), "{args:?}");
        if args.contains(&"--json") {
            assert!(json(&output)["error"]["problems"][0]["help"].is_string());
        }
    }
    assert_eq!(folder.names(), ["changed.toml"]);
}

#[test]
fn the_schema_is_json_that_names_the_keys() {
    let output = run(&["schema"]);
    assert_eq!(output.status.code(), Some(0));
    let schema: Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert!(schema["$schema"].is_string() && schema["properties"]["sprags"].is_object());
}

const FEM: &str = "tests/reference/fem_single_arc.csv";

#[test]
fn laws_stand_beside_finite_elements() {
    let folder = Folder::new();
    let html = folder.path("fem.html");
    let args =
        ["stiffness", SINGLE, "--contact", "roller,slice,elastic", "--fem", FEM, "--fem-model", "6 mm layer"];
    let value = json(&run(&[&args[..], &["--json", "--report", &html]].concat()));
    let rows = value["fem"].as_array().unwrap();
    assert_eq!(rows.len(), 4);
    for row in rows {
        let off = |law: usize, key: &str| number(&row["laws"][law], key);
        // Figures of tests/wedge/elastic_law.rs; local deformation alone is far too stiff.
        assert!((0.12..0.14).contains(&off(0, "windup")) && off(1, "windup") < off(0, "windup"));
        assert!(off(2, "windup").abs() < 0.01 && off(2, "normal").abs() < 0.005);
        assert!((0..3).all(|law| off(law, "windup_local_only") < -0.3));
    }
    let text = stdout(&run(&args));
    for part in ["Against finite elements", "the paper's order holds", "local plus structural is nearer"] {
        assert!(text.contains(part), "{part} in\n{text}");
    }
    let page = is_self_contained(&html);
    assert!(page.contains("finite elements, %") && page.contains("Figure 11"));
}

#[test]
fn pressure_along_the_length_is_asked_for_or_comes_with_a_shape() {
    let plain = json(&run(&["stiffness", MULTI, "--torques", "20,50", "--json"]));
    assert!(plain.get("pressure").is_none());
    let asked = json(&run(&["stiffness", MULTI, "--torques", "20,50", "--pressure", "--json"]));
    assert_eq!(asked["pressure"]["inner"]["peak"][1]["kind"], "flush-ends");
    assert_eq!(asked["pressure"]["outer"]["pressure_mpa"][0].as_array().unwrap().len(), 60);
    let folder = Folder::new();
    let shaped = folder.changed(
        MULTI,
        &[(
            "law = \"roller\"",
            "end_profile = { kind = \"lundberg\", design_load_n = 4500.0 }\nlaw = \"slice\"",
        )],
    );
    let found = json(&run(&["stiffness", &shaped, "--torques", "20,50", "--json"]));
    assert_eq!(found["pressure"]["inner"]["peak"][1]["kind"], "bounded");
    let largest = number(&found["pressure"]["inner"]["peak"][1], "mpa");
    let hertz = number(&found["points"][1], "hertz_inner_mpa");
    assert!(largest > 0.95 * hertz && largest < 1.25 * hertz, "{largest} {hertz}");
}

#[test]
fn several_designs_make_one_page() {
    let folder = Folder::new();
    let html = folder.path("both.html");
    let output = run(&["stiffness", SINGLE, MULTI, "--torques", "20", "--report", &html]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let page = is_self_contained(&html);
    assert!(page.contains("single-arc") && page.contains("Huang 2017, multi-arc"));
    let lines = run(&["stiffness", SINGLE, MULTI, "--torques", "20", "--json"]);
    assert_eq!(stdout(&lines).lines().count(), 2);
    let twice = [FEM, "no-such-file.csv", "Cargo.toml"];
    for args in [
        &["stiffness", SINGLE, MULTI, "--csv", "x.csv"][..],
        &["stiffness", SINGLE, "--fem", twice[0], "--fem", twice[0]],
        &["stiffness", SINGLE, "--fem", twice[1]],
        &["stiffness", SINGLE, "--fem", twice[2]],
        &["stiffness", SINGLE, "--fem", FEM, "--fem-model", "no such model"],
    ] {
        let output = run(args);
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        assert!(output.stdout.is_empty() && !output.stderr.is_empty(), "{args:?}");
    }
}
