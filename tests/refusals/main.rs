//! Refusals: every way in which a design file is turned away, with the key, the line and the words.

mod axial;
mod margins;
mod optimize;

use sprag_design::design::Design;
use sprag_design::file::DesignError;

const DESIGN: &str = include_str!("../../designs/huang2017-multi-arc.toml");

/// The design with each `from` replaced once.
fn changed(changes: &[(&str, &str)]) -> String {
    let mut text = DESIGN.to_owned();
    for (from, to) in changes {
        assert!(text.contains(from), "the design no longer holds {from:?}");
        text = text.replacen(from, to, 1);
    }
    text
}

fn refusal(text: &str) -> DesignError {
    match Design::parse(text, "x.toml") {
        Ok(_) => panic!("accepted"),
        Err(error) => error,
    }
}

/// One way to be refused: what is changed, the key at fault, a text on the line that the error must point
/// at, words of the message.
struct Case<'a>(&'a [(&'a str, &'a str)], &'a str, &'a str, &'a [&'a str]);

fn hold(cases: &[Case]) {
    for Case(changes, key, on_line, words) in cases {
        let text = changed(changes);
        let error = refusal(&text);
        let problem = error.problems().iter().find(|p| p.key == *key);
        let problem = problem.unwrap_or_else(|| panic!("{changes:?}: no problem with {key}:\n{error}"));
        let line = text.lines().position(|l| l.contains(on_line)).expect("line") + 1;
        assert_eq!(problem.place.as_ref().map(|p| p.line), Some(line), "{changes:?}:\n{error}");
        for word in *words {
            assert!(problem.to_string().contains(word), "{changes:?}: no {word:?} in\n{problem}");
        }
        assert!(!problem.help.is_empty() && !problem.allowed.is_empty() && !problem.found.is_empty());
    }
}

#[test]
#[rustfmt::skip] // one way per line
fn syntax() {
    hold(&[
        Case(&[("count = 12 ", "count = twelve ")], "sprags.count", "twelve", &["twelve", "a number, a text in quotes"]),
        Case(&[("count = 12 ", "count = ")], "sprags.count", "count = ", &[]),
    ]);
    let error = refusal(&changed(&[("length_mm = 6.0", "count = 13\nlength_mm = 6.0")]));
    assert!(error.to_string().contains("x.toml:11:1: sprags.count: found duplicate key"), "{error}");
    // Keys that a scene lacks: a line each, with what it is.
    let bare = changed(&[("[[scenarios]]", "[[scenarios]]\nname = \"bare\"\nkind = \"torsional-excitation\"\n\n[[scenarios]]")]);
    let text = refusal(&bare).to_string();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 5, "{text}");
    assert!(
        lines[0].ends_with(
            "scenarios[0].preload_nm: no such key; add preload_nm = ... to scenario \"bare\", kind torsional-excitation: \
             a finite number of at least 0: preload on the inner race, N m"
        ),
        "{text}"
    );
    // A stiffness that nobody knows by heart comes with its size: G pi d^4/(32 L) of a steel shaft, 40 mm thick and 200 mm long.
    assert!(text.contains("N m/rad (some 1e5)"), "{text}");
    assert!((79.3e9 * std::f64::consts::PI * 0.04_f64.powi(4) / (32.0 * 0.2) / 1e5 - 1.0).abs() < 0.01);
    assert!(lines.iter().all(|line| line.len() < 240), "{text}");
    let error = refusal(&changed(&[("[races]", "[sprags]")]));
    assert!(error.to_string().contains("duplicate"), "{error}");
    let error = refusal(&changed(&[("\"Huang 2017, multi-arc\"", "\"Huang")]));
    assert_eq!(error.problems()[0].place.as_ref().map(|p| p.line), Some(7), "{error}");
}

#[test]
#[rustfmt::skip] // one way per line
fn unknown_missing_and_mistyped_keys() {
    hold(&[
        Case(&[("count = 12", "cuont = 12")], "sprags.cuont", "cuont", &["unknown key", "did you mean count?"]),
        Case(&[("count = 12", "cuont = 12")], "sprags.count", "[sprags]", &["no such key", "add count"]),
        Case(&[("[spring]", "[sprig]")], "sprig", "[sprig]", &["did you mean spring?"]),
        Case(&[("[spring]", "[sprig]")], "spring", "# Why", &["add the table [spring]"]),
        Case(&[("y_mm = 0.5288 ", "z_mm = 0.5288 ")], "sprags.centroid.z_mm", "centroid =", &["x_mm, y_mm"]),
        Case(&[("y_mm = 0.5288 ", "z_mm = 0.5288 ")], "sprags.centroid.y_mm", "centroid =", &["add y_mm"]),
        Case(&[("until_rad = 0.12 ", "till_rad = 0.12 ")], "sprags.inner_arcs[1].until_rad", "till", &["add"]),
        Case(&[("schema = 1", "schema = 2")], "schema", "schema = 2", &["found 2", "allowed: 1;"]),
        Case(&[("schema = 1\n", "")], "schema", "# Why", &["add schema"]),
        Case(&[("name = \"Huang 2017, multi-arc\"", "name = \" \"")], "name", "name = \" \"", &["not empty"]),
        Case(&[("count = 12 ", "count = 12.0 ")], "sprags.count", "count =", &["12.0", "whole number of at least 3"]),
        Case(&[("length_mm = 6.0 ", "length_mm = 1e308 ")], "sprags.length_mm", "1e308", &["found 1e308", "a magnitude from 1e-30 to 1e15"]),
        Case(&[("length_mm = 6.0 ", "length_mm = 1e6 ")], "sprags.length_mm", "1e6", &["found 1e6 with races.width_mm = 6.0", "at most the width of the races, 6 mm"]),
        Case(&[("length_mm = 6.0 ", "length_mm = 1e-308 ")], "sprags.length_mm", "1e-308", &["a magnitude from 1e-30 to 1e15"]),
        Case(&[("name = \"Huang 2017, multi-arc\"", "name = \"Huang\\n2017\"")], "name", "n2017", &["without line breaks"]),
        Case(&[("name = \"high-6\"", "name = \"high\\t6\"")], "scenarios[0].name", "high\\t6", &["without line breaks"]),
        Case(&[("count = 12 ", "count = 2 ")], "sprags.count", "count =", &["found 2", "at least 3"]),
        Case(&[("count = 12 ", "count = -12 ")], "sprags.count", "count =", &["found -12"]),
        Case(&[("count = 12 ", "count = 99999999999999999999 ")], "sprags.count", "count =", &["9999"]),
        Case(&[("count = 12 ", "count = true ")], "sprags.count", "count =", &["found true"]),
        Case(&[("count = 12 ", "count = 1979-05-27 ")], "sprags.count", "count =", &["1979"]),
        Case(&[("length_mm = 6.0 ", "length_mm = \"6\" ")], "sprags.length_mm", "\"6\"", &["the string \"6\"", "finite number above 0"]),
        Case(&[("length_mm = 6.0 ", "length_mm = [6.0] ")], "sprags.length_mm", "[6.0]", &["an array"]),
        Case(&[("length_mm = 6.0 ", "length_mm = { mm = 6.0 } ")], "sprags.length_mm", "mm = 6.0 }", &["a table"]),
        Case(&[("[spring]", "[spring.x]")], "spring.x", "[spring.x]", &["unknown key"]),
        Case(&[("law = \"roller\"", "law = \"rollers\"")], "contact.law", "rollers", &["\"roller\" or \"din26281\""]),
        Case(&[("kind = \"torsional-excitation\"", "kind = \"twist\"")], "scenarios[0].kind", "twist", &["engagement"]),
        Case(&[("objective = \"slip-margin\"", "objective = \"life\"")], "optimize.objective", "life\"", &["slip-margin"]),
        Case(&[("seed = 1", "seed = -1")], "optimize.seed", "seed", &["at least 0"]),
        Case(&[("seed = 1", "")], "optimize.seed", "[optimize]", &["add seed"]),
        Case(&[("[check]\nscenarios = [", "[check]\nscenarios = [1, ")], "check.scenarios[0]", "[1, ", &["text"]),
    ]);
    let whole = ["sprags", "races", "spring", "material", "friction"];
    for table in whole {
        let start = DESIGN.find(&format!("[{table}]")).expect(table);
        let end = start + 1 + DESIGN[start + 1..].find("\n[").expect("next table");
        let error = refusal(&[&DESIGN[..start], &DESIGN[end..]].concat());
        assert!(
            error.problems().iter().any(|p| p.key == table && p.help.contains("add the table")),
            "{error}"
        );
    }
}

/// Every number of the file in turn: not a number, infinite, too large for a double, a text.
#[test]
fn every_number_must_be_finite_and_a_number() {
    let mut tried = 0;
    for (start, token) in numbers() {
        for bad in ["nan", "-nan", "inf", "-inf", "1e999", "1e300", "1e-300", "\"6.0\"", "false", "{}", "[]"]
        {
            let text = [&DESIGN[..start], bad, &DESIGN[start + token.len()..]].concat();
            let error = refusal(&text);
            let line = DESIGN[..start].matches('\n').count() + 1;
            let at = error.problems().iter().find(|p| p.place.as_ref().is_some_and(|p| p.line == line));
            let problem = at.unwrap_or_else(|| panic!("{token} -> {bad} at line {line}:\n{error}"));
            assert!(!problem.key.is_empty(), "{problem}");
            tried += 1;
        }
    }
    assert!(tried > 1000, "{tried}");
}

/// Byte offset and text of every number that is a value in the design.
fn numbers() -> Vec<(usize, &'static str)> {
    let mut found = Vec::new();
    let mut line_start = 0;
    for line in DESIGN.split_inclusive('\n') {
        let code = line.split('#').next().unwrap_or("");
        for (i, _) in code.match_indices("= ") {
            let rest = &code[i + 2..];
            let end = rest.find([' ', ',', '\n', '}']).unwrap_or(rest.len());
            if rest[..end].parse::<f64>().is_ok() {
                found.push((line_start + i + 2, &DESIGN[line_start + i + 2..line_start + i + 2 + end]));
            }
        }
        line_start += line.len();
    }
    found
}

/// Keys that must be above zero: zero and a negative value are refused, at the key, by the rule.
#[test]
fn positive_quantities() {
    let positive = [
        ("sprags.length_mm", "length_mm = 6.0"),
        ("sprags.outer_radius_mm", "outer_radius_mm = 4.68"),
        ("sprags.centre_distance_mm", "centre_distance_mm = 0.62"),
        ("sprags.mass_kg", "mass_kg = 1.8e-3"),
        ("sprags.inertia_kg_m2", "inertia_kg_m2 = 1.18e-8"),
        ("sprags.inner_arcs[0].radius_mm", "radius_mm = 4.02"),
        ("sprags.inner_arcs[0].until_rad", "until_rad = 0.06"),
        ("races.inner_radius_mm", "inner_radius_mm = 11.11"),
        ("races.outer_radius_mm", "outer_radius_mm = 19.44"),
        ("races.outer_outside_radius_mm", "outer_outside_radius_mm = 26.23"),
        ("races.width_mm", "width_mm = 6.0      "),
        ("races.inner_inertia_kg_m2", "inner_inertia_kg_m2 = 1.41e-3"),
        ("races.outer_inertia_kg_m2", "outer_inertia_kg_m2 = 1.41e-3"),
        ("spring.drag_torque_nm", "drag_torque_nm = 0.0166"),
        ("material.youngs_modulus_gpa", "youngs_modulus_gpa = 206.0"),
        ("material.poisson_ratio", "poisson_ratio = 0.3"),
        ("material.density_kg_m3", "density_kg_m3 = 7850.0"),
        ("friction.static", "static = 0.12"),
        ("friction.kinetic", "kinetic = 0.09"),
        ("contact.roller_coefficient", "roller_coefficient = 3.944e-5"),
        ("limits.nominal_torque_nm", "nominal_torque_nm = 90.0"),
        ("limits.peak_torque_nm", "peak_torque_nm = 110.0"),
        ("limits.hertz_nominal_mpa", "hertz_nominal_mpa = 4200.0"),
        ("limits.hertz_peak_mpa", "hertz_peak_mpa = 4600.0"),
        ("limits.hoop_inner_mpa", "hoop_inner_mpa = 900.0"),
        ("limits.hoop_outer_mpa", "hoop_outer_mpa = 750.0"),
        ("limits.keep_contact_to_rpm", "keep_contact_to_rpm = 4500"),
        ("scenarios[0].frequency_hz", "frequency_hz = 100.0"),
        ("scenarios[0].abutment_stiffness_nm_per_rad", "abutment_stiffness_nm_per_rad = 5000.0"),
        ("scenarios[0].duration_s", "duration_s = 0.3"),
    ];
    let not_negative = [
        ("sprags.width_mm", "width_mm = 5.05"),
        ("races.inner_bore_radius_mm", "inner_bore_radius_mm = 7.21"),
        ("races.viscous_damping_nm_s_per_rad", "viscous_damping_nm_s_per_rad = 0.1"),
        ("friction.decay_s_per_m", "decay_s_per_m = 5.0"),
        ("spring.stiffness_nm_per_rad", "\nstiffness_nm_per_rad = 0.01"),
        ("limits.slip_margin", "slip_margin = 0.10"),
        ("scenarios[0].preload_nm", "preload_nm = 3.34"),
        ("scenarios[0].amplitude_nm", "amplitude_nm = 6.0"),
        ("scenarios[0].speed_rpm", "speed_rpm = 0.0"),
    ];
    let zero = positive.iter().map(|p| (p, "0.0", "above 0"));
    let negative = positive.iter().map(|p| (p, "-1.5", "above 0"));
    let below = not_negative.iter().map(|p| (p, "-1.5", "of at least 0"));
    for ((key, setting), value, rule) in zero.chain(negative).chain(below) {
        let start = DESIGN.find(setting).unwrap_or_else(|| panic!("{setting}"));
        let line = DESIGN[..start].matches('\n').count() + 1 + usize::from(setting.starts_with('\n'));
        let (name, _) = setting.split_once('=').expect("setting");
        let error = refusal(&changed(&[(setting, &format!("{name}= {value}"))]));
        let [problem] = error.problems() else { panic!("{key}: more than one problem:\n{error}") };
        assert_eq!((problem.key.as_str(), problem.found.as_str()), (*key, value));
        assert!(problem.allowed.contains(rule), "{problem}");
        assert_eq!(problem.place.as_ref().map(|p| p.line), Some(line), "{error}");
    }
    for (key, setting) in &not_negative {
        let (name, _) = setting.split_once('=').expect("setting");
        let text = changed(&[(setting, &format!("{name}= 0"))]);
        assert!(Design::parse(&text, "x.toml").is_ok(), "{key} may be 0");
    }
}

#[test]
#[rustfmt::skip] // one way per line
fn races_and_material() {
    hold(&[
        Case(&[("bore_radius_mm = 7.21", "bore_radius_mm = 12.0")], "races.inner_bore_radius_mm", "12.0", &["less than races.inner_radius_mm = 11.11"]),
        Case(&[("\ninner_radius_mm = 11.11", "\ninner_radius_mm = 20.0")], "races.inner_radius_mm", "20.0", &["19.44"]),
        Case(&[("outside_radius_mm = 26.23", "outside_radius_mm = 19.44")], "races.outer_radius_mm", "outer_radius_mm = 19.44", &["with races.outer_outside_radius_mm = 19.44"]),
        Case(&[("poisson_ratio = 0.3", "poisson_ratio = 0.5")], "material.poisson_ratio", "0.5 ", &["above 0 and below 0.5"]),
        Case(&[("density_kg_m3 = 7850.0", "")], "material.density_kg_m3", "[material]", &["add density_kg_m3"]),
        Case(&[("[friction]", "[material.sprag]\nyoungs_modulus_gpa = 206.0\npoisson_ratio = 0.3\ndensity_kg_m3 = 7850.0\n[friction]")], "material.youngs_modulus_gpa", "with it (5)", &["either"]),
        Case(&[("[material]", "[material.sprag]")], "material.inner_race", "[material.sprag]", &["add the table [material.inner_race]"]),
        Case(&[("kinetic = 0.09", "kinetic = 0.13")], "friction.kinetic", "0.13", &["at most the static coefficient, 0.12", "with friction.static = 0.12"]),
        Case(&[("law = \"roller\"", "law = \"hertz\"")], "contact.roller_coefficient", "roller_coefficient", &["no roller_coefficient with this law"]),
        Case(&[("law = \"roller\"", "law = \"roller\"\nslices = 3000")], "contact.slices", "slices = 3000", &["at most 2000"]),
        Case(&[("law = \"roller\"", "law = \"slice\"\nslices = 1")], "contact.slices", "slices = 1", &["at least 2"]),
        Case(&[("roller_coefficient = 3.944e-5", "")], "contact.roller_coefficient", "[contact]", &["no such key", "add roller_coefficient"]),
    ]);
}

#[test]
#[rustfmt::skip] // one way per line
fn sprag_geometry() {
    hold(&[
        Case(&[("until_rad = 0.06 ", "until_rad = 0.13 ")], "sprags.inner_arcs[1].until_rad", "0.12 }", &["more than the end of the arc before, 0.13 rad", "order"]),
        Case(&[("until_rad = 0.45 ", "until_rad = 0.12 ")], "sprags.inner_arcs[2].until_rad", "4.15", &["order"]),
        Case(&[("until_rad = 0.45 ", "until_rad = 25.0 ")], "sprags.inner_arcs[2].until_rad", "4.15", &["at most 1.57"]),
        Case(&[("inner_arcs = [\n", "inner_arcs = []\nother = [\n")], "sprags.inner_arcs", "inner_arcs = []", &["an empty array", "at least one entry"]),
        Case(&[("\nouter_radius_mm = 19.44", "\nouter_radius_mm = 19.0")], "races.outer_radius_mm", "outer_radius_mm = 19.0", &["too small for the sprag", "above 8.08 mm", "it is 7.89 mm", "above 19.19 mm"]),
        Case(&[("\nouter_radius_mm = 19.44", "\nouter_radius_mm = 21.0")], "races.outer_radius_mm", "outer_radius_mm = 21.0", &["too short for the race gap", "below 20.43 mm"]),
        Case(&[("radius_mm = 4.02", "radius_mm = 5.02")], "races.outer_radius_mm", "outer_radius_mm = 19.44", &["too small for the sprag", "sprags.inner_arcs[0].radius_mm = 5.02"]),
        Case(&[("outer_radius_mm = 4.68", "outer_radius_mm = 19.44")], "sprags.outer_radius_mm", "outer_radius_mm = 19.44", &["less than the outer track's radius, 19.44 mm"]),
        Case(&[("centre_distance_mm = 0.62", "centre_distance_mm = 30.0")], "sprags.centre_distance_mm", "30.0", &["circles", "cannot meet"]),
        Case(&[("count = 12 ", "count = 19 ")], "sprags.count", "count = 19", &["with sprags.width_mm = 5.05", "at most 15 sprags", "it is -0.98683 mm", "overlap their neighbours"]),
        Case(&[("count = 12 ", "count = 999999999 ")], "sprags.count", "count = 999999999", &["at most 15 sprags"]),
        Case(&[("count = 12 ", "count = 16 "), ("width_mm = 5.05", "flanks = { rear_mm = 2.6, front_mm = 2.7 }")], "sprags.count", "count = 16", &["with sprags.flanks.rear_mm = 2.6, sprags.flanks.front_mm = 2.7"]),
        Case(&[("width_mm = 5.05", "width_mm = 9.0")], "sprags.width_mm", "width_mm = 9.0", &["less than 7.4165 mm", "rear flank, 4.5000 mm", "passes the inner arc"]),
        Case(&[("width_mm = 5.05", "width_mm = 3.0")], "sprags.width_mm", "width_mm = 3.0", &["at least 3.6395 mm", "cuts 0.0815 rad off the inner arcs", "give flanks"]),
        Case(&[("width_mm = 5.05", "width_mm = 4.0")], "sprags.width_mm", "width_mm = 4.0", &["at least 4.1956 mm", "outer arc's contact range"]),
        Case(&[("width_mm = 5.05", "flanks = { rear_mm = 2.525, front_mm = 1.5 }")], "sprags.flanks.front_mm", "flanks = {", &["found 1.5 with sprags.inner_arcs[2].until_rad = 0.45", "at least 1.8198 mm"]),
        Case(&[("width_mm = 5.05", "flanks = { rear_mm = 1.525, front_mm = 2.5 }")], "sprags.flanks.rear_mm", "flanks = {", &["found 1.525", "at least 2.0978 mm"]),
        Case(&[("width_mm = 5.05", ""), ("mass_kg = 1.8e-3", ""), ("inertia_kg_m2 = 1.18e-8", ""), ("centroid = {", "# {")], "sprags.flanks", "[sprags]", &["no such key", "the outline, which is open", "add flanks = {"]),
        Case(&[("width_mm = 5.05", "flanks = { rear_mm = 2.0, front_mm = -2.0 }")], "sprags.flanks.front_mm", "flanks = {", &["found -2.0"]),
        Case(&[("mass_kg = 1.8e-3", "")], "sprags.mass_kg", "[sprags]", &["together, or none", "add sprags.mass_kg"]),
        Case(&[("inertia_kg_m2 = 1.18e-8", "")], "sprags.inertia_kg_m2", "[sprags]", &["no such key", "with sprags.mass_kg = 1.8e-3"]),
        Case(&[("centroid = {", "# {")], "sprags.centroid", "[sprags]", &["add sprags.centroid"]),
        Case(&[("y_mm = 0.5288", "y_mm = 15.28")], "sprags.centroid.y_mm", "15.28", &["between the tracks, 11.11 to 19.44 mm", "30.04"]),
    ]);
}

/// A bound that a refusal prints can be typed in, and one step beyond it is refused.
#[test]
fn the_bounds_named_are_the_bounds() {
    for (from, held, refused) in [
        ("count = 12 ", "count = 15 ", "count = 16 "),
        ("width_mm = 5.05", "width_mm = 4.1956", "width_mm = 4.1954"),
        (
            "width_mm = 5.05",
            "flanks = { rear_mm = 2.525, front_mm = 1.8198 }",
            "flanks = { rear_mm = 2.525, front_mm = 1.8196 }",
        ),
        (
            "width_mm = 5.05",
            "flanks = { rear_mm = 2.0978, front_mm = 2.525 }",
            "flanks = { rear_mm = 2.0976, front_mm = 2.525 }",
        ),
    ] {
        assert!(Design::parse(&changed(&[(from, held)]), "x.toml").is_ok(), "{held}");
        assert!(Design::parse(&changed(&[(from, refused)]), "x.toml").is_err(), "{refused}");
    }
}

#[test]
#[rustfmt::skip] // one way per line
fn limits() {
    hold(&[
        Case(&[("\nnominal_torque_nm = 90.0", "")], "limits.hertz_nominal_mpa", "hertz_nominal_mpa", &["limits.nominal_torque_nm, which is missing"]),
        Case(&[("\npeak_torque_nm = 110.0", "")], "limits.hertz_peak_mpa", "hertz_peak_mpa", &["limits.peak_torque_nm, which is missing"]),
        Case(&[("\npeak_torque_nm = 110.0", "")], "limits.hoop_inner_mpa", "hoop_inner_mpa", &["peak_torque_nm"]),
        Case(&[("\npeak_torque_nm = 110.0", "")], "limits.hoop_outer_mpa", "hoop_outer_mpa", &["peak_torque_nm"]),
        Case(&[("peak_torque_nm = 110.0", "peak_torque_nm = 80.0")], "limits.peak_torque_nm", "80.0", &["at least the nominal torque, 90 N m"]),
        Case(&[("limits = { keep_contact_to_rpm = 6000 }", "limits = { peak_torque_nm = 80.0 }")], "optimize.limits.peak_torque_nm", "= 80.0 }", &["with limits.nominal_torque_nm = 90.0"]),
        Case(&[("limits = { keep_contact_to_rpm = 6000 }", "limits = { speed = 1 }")], "optimize.limits.speed", "speed = 1", &["unknown key"]),
    ]);
}

#[test]
#[rustfmt::skip] // one way per line
fn scenarios() {
    hold(&[
        Case(&[("name = \"high-8\"", "name = \"high-6\"  # 2nd")], "scenarios[1].name", "# 2nd", &["no other scenario", "scenarios[0].name"]),
        Case(&[("preload_nm = 3.34\n", "")], "scenarios[0].preload_nm", "[[scenarios]]", &["add preload_nm", "\"high-6\"", "preload on the inner race, N m"]),
        Case(&[("preload_nm = 3.34\n", "torque_nm = 3.34\npreload_nm = 3.34\n")], "scenarios[0].torque_nm", "torque_nm = 3.34", &["for kind torsional-excitation: preload_nm, amplitude_nm", "remove torque_nm"]),
        Case(&[("kind = \"torsional-excitation\"", "kind = \"overrun\"")], "scenarios[0].overrun_rpm", "[[scenarios]]", &["kind overrun"]),
        Case(&[("kind = \"torsional-excitation\"", "kind = \"static\"")], "scenarios[0].torque_nm", "[[scenarios]]", &["steady torque"]),
        Case(&[("kind = \"torsional-excitation\"", "kind = \"engagement\"")], "scenarios[0].bench_inertia_kg_m2", "[[scenarios]]", &["add bench_inertia_kg_m2"]),
        Case(&[("speed_rpm = 0.0", "tourque = 1")], "scenarios[0].tourque", "tourque", &["did you mean torque_nm?"]),
        Case(&[("friction = { static = 0.082, kinetic = 0.082 }", "friction = { static = 0.082 }")], "scenarios[6].friction.static", "{ static = 0.082 }", &["with friction.kinetic = 0.09"]),
        Case(&[("friction = { static = 0.082, kinetic = 0.082 }", "friction = { static = 0 }")], "scenarios[6].friction.static", "{ static = 0 }", &["above 0"]),
        Case(&[("friction = { static = 0.082, kinetic = 0.082 }", "frictoin = { static = 0.082 }")], "scenarios[6].frictoin", "frictoin", &["did you mean friction?"]),
        Case(&[("friction = { static = 0.082, kinetic = 0.082 }", "sprags = { count = 40 }")], "scenarios[6].sprags.count", "count = 40", &["overlap"]),
        Case(&[("friction = { static = 0.082, kinetic = 0.082 }", "sprags = { inner_arcs = [ { radius_mm = 4.02, until_rad = 0.8 } ] }")], "scenarios[6].sprags.inner_arcs[0].until_rad", "0.8 } ]", &["with sprags.width_mm = 5.05", "they need 2.9696 mm"]),
        Case(&[("friction = { static = 0.082, kinetic = 0.082 }", "races = { inner_bore_radius_mm = 0, inner_radius_mm = 5.0, outer_radius_mm = 13.33 }")], "scenarios[6].races.outer_radius_mm", "13.33", &["overlap", "at most 7 sprags", "it is -1.679169 mm"]),
        Case(&[("friction = { static = 0.082, kinetic = 0.082 }", "contact = { axial_offset_mm = 6.0 }")], "scenarios[6].contact.axial_offset_mm", "axial_offset_mm = 6.0", &["with sprags.length_mm = 6.0", "beside the races"]),
        Case(&[("friction = { static = 0.082, kinetic = 0.082 }", "races = { outer_radius_mm = 19.0 }")], "scenarios[6].races.outer_radius_mm", "19.0 }", &["too small for the sprag"]),
        Case(&[("friction = { static = 0.082, kinetic = 0.082 }", "sprags = { inner_arcs = [ { radius_mm = 5.02, until_rad = 0.4 } ] }")], "scenarios[6].sprags.inner_arcs[0].radius_mm", "5.02", &["too small for the sprag"]),
        Case(&[("friction = { static = 0.082, kinetic = 0.082 }", "contact = { law = \"hertz\", stress_state = \"layer\" }")], "scenarios[6].contact.stress_state", "stress_state", &["no stress_state with this law"]),
        Case(&[("friction = { static = 0.082, kinetic = 0.082 }", "material = { poisson_ratio = 0.3, sprag = { poisson_ratio = 0.2 } }")], "scenarios[6].material.poisson_ratio", "{ poisson_ratio = 0.3, sprag", &["either"]),
    ]);
}

#[test]
#[rustfmt::skip] // one way per line
fn check_and_optimize() {
    hold(&[
        Case(&[("[\"low-10\", \"rated-45\"]", "[\"low-10\", \"rated-46\"]")], "check.scenarios[1]", "rated-46", &["high-6, high-8", "name a scenario"]),
        Case(&[("[\"low-10\", \"rated-45\"]", "[\"low-10\", \"low-10\"]")], "check.scenarios[1]", "[\"low-10\", \"low-10\"]", &["each scenario once"]),
        Case(&[("[\"high-6\", \"low-10\",", "[\"high-7\", \"low-10\",")], "optimize.scenarios[0]", "high-7", &["the string \"high-7\""]),
        Case(&[("scenarios = [\"high-6\", \"low-10\", \"rated-45\", \"rated-45-at-speed\"]", "scenarios = [] # none")], "optimize.scenarios", "# none", &["at least one scenario, over which slip-margin is taken"]),
        Case(&[("name = \"r_i2_mm\"", "name = \"r_i4_mm\"")], "optimize.variables[0].name", "r_i4_mm", &["r_i1_mm, r_i2_mm, r_i3_mm, junction_1_rad, junction_2_rad, profile_end_rad"]),
        Case(&[("name = \"r_i2_mm\"", "name = \"r_i3_mm\"")], "optimize.variables[1].name", "max = 5.2", &["each variable once"]),
        Case(&[("name = \"r_i2_mm\"", "name = \"flank_rear_mm\"")], "optimize.variables[0].name", "flank_rear_mm", &["sprags.flanks.rear_mm is not"]),
        Case(&[("min = 3.6, max = 4.8", "min = 3.6, max = 4.8, moves = [\"races.widht_mm\"]")], "optimize.variables[0].moves[0]", "widht", &["races.widht_mm", "a number of the clutch"]),
        Case(&[("min = 3.6, max = 4.8", "min = 3.6, max = 4.8, scales = [\"sprags.count\"]")], "optimize.variables[0].scales[0]", "scales", &["not a whole one"]),
        Case(&[("min = 3.6, max = 4.8", "min = 3.6, max = 4.8, moves = [\"r_i3_mm\"]")], "optimize.variables[0].moves[0]", "moves", &["a number that one thing moves", "sprags.inner_arcs[2].radius_mm is a variable itself"]),
        Case(&[("min = 3.6, max = 4.8", "min = 3.6, max = 4.8, moves = [\"races.width_mm\"], scales = [\"races.width_mm\"]")], "optimize.variables[0].moves[0]", "moves", &["name it once"]),
        Case(&[("min = 3.6, max = 4.8", "min = 3.6, max = 4.8, moves = [\"races.press_fit.inner_interference_um\"]")], "optimize.variables[0].moves[0]", "moves", &[]),
        Case(&[("min = 3.6, max = 4.8", "min = 4.8, max = 3.6")], "optimize.variables[0].min", "min = 4.8", &["less than max"]),
        Case(&[("min = 3.6, max = 4.8", "min = -3.6, max = 4.8")], "optimize.variables[0].min", "-3.6", &["above 0"]),
        Case(&[("kind = \"torsional-excitation\"\nstart = \"without-spring\"            # as the paper: the equilibrium of the torque alone\npreload_nm = 3.34\namplitude_nm = 6.0\nfrequency_hz = 100.0\nabutment_stiffness_nm_per_rad = 5000.0\nduration_s = 0.3", "kind = \"overrun\"\noverrun_rpm = 100.0")], "optimize.scenarios[0]", "\"rated-45-at-speed\"]", &["overrunning"]),
    ]);
}

#[test]
fn all_faults_of_a_stage_are_told_at_once_in_the_order_of_the_file() {
    let error = refusal(&changed(&[
        ("static = 0.12", "static = -0.12"),
        ("count = 12", "count = 2"),
        ("[spring]", "[spring]\nweight = 3"),
    ]));
    let keys: Vec<&str> = error.problems().iter().map(|p| p.key.as_str()).collect();
    assert_eq!(keys, ["sprags.count", "spring.weight", "friction.static"]);
    let error = refusal(&changed(&[
        ("kinetic = 0.09", "kinetic = 0.5"),
        ("outer_outside_radius_mm = 26.23", "outer_outside_radius_mm = 16.23"),
        ("\"low-10\", \"rated-45\"]", "\"low-11\", \"rated-45\"]"),
        ("duration_s = 0.3\n", ""),
    ]));
    let keys: Vec<&str> = error.problems().iter().map(|p| p.key.as_str()).collect();
    assert_eq!(
        keys,
        ["races.outer_radius_mm", "friction.kinetic", "check.scenarios[0]", "scenarios[0].duration_s"]
    );
}

#[test]
fn errors_read_as_text_as_json_and_as_a_diagnostic() {
    let error = refusal(&changed(&[("count = 12 ", "count = 2 ")]));
    let line =
        "x.toml:10:9: sprags.count: found 2; allowed: a whole number of at least 3; to mend: give count ";
    assert!(error.to_string().starts_with(line), "{error}");
    let json = error.to_json();
    assert_eq!(json["file"], "x.toml");
    assert_eq!(json["problems"][0]["line"], 10);
    assert_eq!(json["problems"][0]["column"], 9);
    assert_eq!(json["problems"][0]["found"], "2");
    let mut shown = String::new();
    let theme = miette::GraphicalTheme::unicode_nocolor();
    miette::GraphicalReportHandler::new_themed(theme).render_report(&mut shown, &error).expect("render");
    assert!(shown.contains("x.toml:10:9") && shown.contains("count = 2 "), "{shown}");
    assert!(!shown.contains('\u{1b}'), "no colour:\n{shown}");
}

#[test]
fn files_that_cannot_be_read() {
    let dir = std::env::temp_dir().join(format!("sprag-design-refusals-{}", std::process::id()));
    std::fs::create_dir_all(&dir).expect("temporary directory");
    let read = |name: &str, bytes: &[u8]| {
        let path = dir.join(name);
        std::fs::write(&path, bytes).expect("write");
        Design::read(&path).expect_err(name)
    };
    let latin1 = read("latin1.toml", b"schema = 1\nname = \"K\xe4fig\"\n");
    let empty = read("empty.toml", b"");
    let blank = read("blank.toml", "\u{feff} \n\n".as_bytes());
    let comment = read("comment.toml", b"# nothing but this\n");
    let binary = read("binary.toml", &[0, 1, 2, 3]);
    let missing = Design::read(&dir.join("no-such.toml")).expect_err("missing");
    let directory = Design::read(&dir).expect_err("directory");
    std::fs::remove_dir_all(&dir).expect("remove");
    assert!(latin1.to_string().contains("latin1.toml:2:10: found a byte that is not UTF-8"), "{latin1}");
    assert!(empty.to_string().contains("an empty file"), "{empty}");
    assert!(blank.to_string().contains("an empty file"), "{blank}");
    assert!(comment.to_string().contains("add the table [sprags]"), "{comment}");
    assert!(!binary.problems().is_empty());
    assert!(missing.to_string().contains("no-such.toml: found no such file"), "{missing}");
    assert!(directory.to_string().contains("found a directory"), "{directory}");
    assert!(missing.to_json()["problems"][0]["line"].is_null());
}

/// Cut lines, cut ends and single wild bytes: an answer every time, never a panic.
#[test]
fn mutilated_designs_are_answered() {
    let lines: Vec<&str> = DESIGN.lines().collect();
    let mut refused = 0;
    for skip in 0..lines.len() {
        let kept: Vec<&str> = lines.iter().enumerate().filter(|(i, _)| *i != skip).map(|(_, l)| *l).collect();
        match Design::parse(&kept.join("\n"), "x.toml") {
            Ok(design) => assert_eq!(design.hash.len(), 64),
            Err(error) => {
                refused += 1;
                assert!(
                    !error.problems().is_empty() && !error.to_string().contains("report this"),
                    "{error}"
                );
                assert!(error.problems().iter().all(|p| p.place.is_some()), "{error}");
            }
        }
    }
    assert!(refused > 80, "{refused} of {} lines matter", lines.len());
    for end in (0..DESIGN.len()).filter(|&i| DESIGN.is_char_boundary(i)) {
        let _ = Design::parse(&DESIGN[..end], "x.toml").map_err(|e| (e.to_string(), e.to_json()));
    }
    for at in (0..DESIGN.len()).step_by(7) {
        for wild in ["=", "[", "\"", "{", "\u{0}", "é", "-", "."] {
            if DESIGN.is_char_boundary(at + 1) && DESIGN.is_char_boundary(at) {
                let text = [&DESIGN[..at], wild, &DESIGN[at + 1..]].concat();
                let _ = Design::parse(&text, "x.toml").map_err(|e| (e.to_string(), e.to_json()));
            }
        }
    }
}

/// The symbol that stands behind a key in the files of `new`.
#[test]
fn a_symbol_of_the_paper_is_told_its_key() {
    let design = Design::parse(DESIGN, "x.toml").unwrap();
    let set = |key: &str| {
        design
            .with(&[(key.to_owned(), "8.0".to_owned())], "x.toml")
            .unwrap_err()
            .to_string()
            .replace('\n', " ")
    };
    assert!(set("r_e_mm").contains("did you mean outer_radius_mm?"), "{}", set("r_e_mm"));
    assert!(set("e_1").contains("did you mean centre_distance_mm?"), "{}", set("e_1"));
}

#[test]
fn deep_nesting_is_refused_not_followed() {
    for (open, close) in [("[", "]"), ("{a=", "}")] {
        let text = format!("schema = {}1{}", open.repeat(100_000), close.repeat(100_000));
        assert!(!refusal(&text).problems().is_empty());
    }
}
