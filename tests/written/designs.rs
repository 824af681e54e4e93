//! The designs in `designs/` as they are read, the scenario overrides, the schema and the edits.

use sha2::{Digest, Sha256};
use std::path::Path;

use sprag_design::clutch::{ContactLaw, MassSource, Scenario, ScenarioKind};
use sprag_design::design::Design;
use sprag_design::file::{EditError, schema, variable_names, variable_path, with_limits, with_values};
use sprag_design::margin::{load_state, margins};
use sprag_design::profile::Flanks;
use sprag_design::profile::Outline;
use sprag_design::scenario::Settings;

const MULTI: &str = include_str!("../../designs/huang2017-multi-arc.toml");
const SINGLE: &str = include_str!("../../designs/huang2017-single-arc.toml");

fn parse(text: &str) -> Design {
    Design::parse(text, "x.toml").unwrap_or_else(|error| panic!("{error}"))
}

/// Equal to one unit in the last place: mm/1e3 and a literal in m may round apart.
#[track_caller]
fn same(a: f64, b: f64) {
    assert!((a - b).abs() <= b.abs() * f64::EPSILON, "{a} is not {b}");
}

/// The paper's Table 1 and the values chosen for what it leaves out, in SI.
fn holds_table_1(design: &Design) {
    let c = &design.clutch;
    assert_eq!(c.sprags.count, 12);
    for (value, expected) in [
        (c.races.inner_bore_radius_m, 7.21e-3),
        (c.races.inner_radius_m, 11.11e-3),
        (c.races.outer_radius_m, 19.44e-3),
        (c.races.outer_outside_radius_m, 26.23e-3),
        (c.races.width_m, 6e-3),
        (c.races.inner_inertia_kg_m2, 1.41e-3),
        (c.races.outer_inertia_kg_m2, 1.41e-3),
        (c.races.viscous_damping_nm_s_per_rad, 0.1),
        (c.spring.stiffness_nm_per_rad, 0.01),
        (c.spring.drag_torque_nm, 1.66e-2),
        (c.sprags.mass_kg, 1.8e-3),
        (c.sprags.inertia_kg_m2, 1.18e-8),
        (c.sprags.inner_arcs[0].radius_m, 4.02e-3),
        (c.sprags.length_m, 6e-3),
        (c.sprags.outer_radius_m, 4.68e-3),
        (c.sprags.centre_distance_m, 0.62e-3),
        (c.sprags.width_m, 5.05e-3),
        (c.sprags.centroid_m[0], 0.1935e-3),
        (c.sprags.centroid_m[1], 0.5288e-3),
        (c.materials.sprag.youngs_modulus_pa, 206e9),
        (c.materials.outer_race.poisson_ratio, 0.3),
        (c.materials.inner_race.density_kg_m3, 7850.0),
        (c.friction.static_, 0.12),
        (c.friction.kinetic, 0.09),
        (c.friction.decay_s_per_m, 5.0),
    ] {
        same(value, expected);
    }
    assert_eq!(c.sprags.mass_source, MassSource::Given);
    assert_eq!(c.sprags.flanks, Some(Flanks::parallel(2.525e-3, 2.525e-3)));
    assert_eq!(c.contact, ContactLaw::Roller { coefficient: 3.944e-5 });
    let l = &design.limits;
    assert_eq!((l.nominal_torque_nm, l.peak_torque_nm), (Some(90.0), Some(110.0)));
    assert_eq!((l.hertz_nominal_pa, l.hertz_peak_pa), (Some(4.2e9), Some(4.6e9)));
    assert_eq!((l.hoop_inner_pa, l.hoop_outer_pa, l.slip_margin), (Some(9e8), Some(7.5e8), Some(0.1)));
    same(l.keep_contact_to_rad_s.unwrap_or(0.0), 4500.0 / 60.0 * std::f64::consts::TAU);
    assert_eq!(design.check_scenarios, ["low-10", "rated-45"]);
    let names: Vec<&str> = design.scenarios.iter().map(|s| s.name.as_str()).collect();
    let expected = "high-6 high-8 high-10 low-6 low-8 low-10 low-6-mu082 low-8-mu082 low-10-mu082 rated-45 rated-45-at-speed";
    assert_eq!(names.join(" "), expected);
}

#[test]
fn both_designs_are_table_1() {
    let multi = Design::read(Path::new("designs/huang2017-multi-arc.toml")).unwrap_or_else(|e| panic!("{e}"));
    let single =
        Design::read(Path::new("designs/huang2017-single-arc.toml")).unwrap_or_else(|e| panic!("{e}"));
    holds_table_1(&multi);
    holds_table_1(&single);
    let arcs = |d: &Design| -> Vec<(f64, f64)> {
        d.clutch.sprags.inner_arcs.iter().map(|a| (a.radius_m * 1e3, a.until_rad)).collect()
    };
    for ((r, until), (radius, end)) in
        arcs(&multi).into_iter().zip([(4.02, 0.06), (4.08, 0.12), (4.15, 0.45)])
    {
        same(r, radius);
        assert_eq!(until, end);
    }
    assert_eq!((arcs(&multi).len(), arcs(&single).len()), (3, 1));
    assert_eq!(arcs(&single)[0].1, 0.45);
    assert_eq!(multi.source, MULTI);
    assert_ne!(multi.hash, single.hash);
    assert_eq!(multi.hash.len(), 64);
}

#[test]
fn a_file_that_an_editor_saved_with_other_line_ends_is_the_same_design() {
    let windows = format!("\u{feff}{}", MULTI.replace('\n', "\r\n"));
    let [plain, other] = [MULTI, &windows].map(|text| Design::parse(text, "a.toml").unwrap());
    assert_eq!(plain.hash, other.hash);
    assert_eq!(plain.content_hash(), other.content_hash());
    let sum: String = Sha256::digest(MULTI.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect();
    assert_eq!(plain.hash, sum);
}

/// One blank more is another design: the hash names a text, not its meaning.
#[test]
fn the_hash_is_of_the_text() {
    let other = MULTI.replacen("count = 12 ", "count = 12  ", 1);
    assert_eq!(parse(MULTI).content_hash(), parse(&other).content_hash());
    assert_ne!(parse(MULTI).hash, parse(&other).hash);
}

#[test]
fn scenarios_carry_the_papers_torques() {
    let design = parse(MULTI);
    let find = |name: &str| -> &Scenario { design.scenario(name).unwrap_or_else(|| panic!("{name}")) };
    for (name, preload, amplitude, rpm) in [
        ("high-6", 3.34, 6.0, 0.0),
        ("high-10", 3.34, 10.0, 0.0),
        ("low-8", 16.8, 8.0, 0.0),
        ("rated-45", 45.0, 15.0, 0.0),
        ("rated-45-at-speed", 45.0, 15.0, 12000.0),
    ] {
        let expected = ScenarioKind::TorsionalExcitation {
            preload_nm: preload,
            amplitude_nm: amplitude,
            frequency_hz: 100.0,
            abutment_stiffness_nm_per_rad: 5000.0,
            duration_s: 0.3,
            speed_rad_s: rpm * std::f64::consts::PI / 30.0,
        };
        assert_eq!(find(name).kind, expected, "{name}");
        assert_eq!(find(name).clutch, design.clutch);
    }
    let slippery = find("low-8-mu082");
    assert_eq!(slippery.overrides, ["friction"]);
    let f = slippery.clutch.friction;
    assert_eq!((f.static_, f.kinetic, f.decay_s_per_m), (0.082, 0.082, 5.0));
    assert_eq!(slippery.clutch.sprags, design.clutch.sprags);
    let Some(task) = &design.optimize else { panic!("no [optimize]") };
    assert_eq!(task.variables.len(), 4);
    assert_eq!(task.seed, 1);
    same(task.limits.keep_contact_to_rad_s.unwrap_or(0.0), 6000.0 / 60.0 * std::f64::consts::TAU);
    assert_eq!(task.limits.hertz_peak_pa, design.limits.hertz_peak_pa);
}

#[test]
fn the_other_kinds_and_overrides_of_every_table() {
    let more = r#"
[[scenarios]]
name = "hold"
kind = "static"
torque_nm = 100
contact = { law = "hertz" }
material = { sprag = { youngs_modulus_gpa = 310.0 } }
[[scenarios]]
name = "engage"
kind = "engagement"
free_run_rpm = 300.0
reversing_torque_nm = 20.0
stop_stiffness_nm_per_rad = 4000.0
bench_inertia_kg_m2 = 1.97e-4
duration_s = 0.05
material = { poisson_ratio = 0.29 }
spring = { stiffness_nm_per_rad = 0.02 }
contact = { law = "slice" }
[[scenarios]]
name = "free"
kind = "overrun"
speed_rpm = 3000.0
overrun_rpm = 60.0
sprags = { centroid = { x_mm = -0.1 }, inner_arcs = [ { radius_mm = 4.02, until_rad = 0.3 } ] }
races = { width_mm = 12.0, inner_bore_radius_mm = 0 }
contact = { slices = 20, law = "slice", roller_coefficient = 3.84e-5 }
"#;
    let design = parse(&[MULTI, more].concat());
    let find = |name: &str| -> &Scenario { design.scenario(name).unwrap_or_else(|| panic!("{name}")) };
    let (hold, engage, free) = (find("hold"), find("engage"), find("free"));
    assert_eq!(hold.kind, ScenarioKind::Static { torque_nm: 100.0 });
    assert_eq!(hold.clutch.contact, ContactLaw::Hertz);
    assert_eq!(hold.clutch.materials.sprag.youngs_modulus_pa, 310e9);
    assert_eq!(hold.clutch.materials.sprag.poisson_ratio, 0.3);
    assert_eq!(hold.clutch.materials.inner_race, design.clutch.materials.inner_race);
    assert_eq!(hold.overrides, ["material", "contact"]);
    assert!(matches!(engage.kind, ScenarioKind::Engagement { bench_inertia_kg_m2: 1.97e-4, .. }));
    assert_eq!(engage.clutch.materials.outer_race.poisson_ratio, 0.29);
    assert_eq!(engage.clutch.spring.stiffness_nm_per_rad, 0.02);
    assert_eq!(engage.clutch.contact, ContactLaw::Slice { coefficient: 3.944e-5 });
    let ScenarioKind::Overrun { speed_rad_s, overrun_rad_s } = free.kind else { panic!("{:?}", free.kind) };
    same(speed_rad_s, 50.0 * std::f64::consts::TAU);
    same(overrun_rad_s, std::f64::consts::TAU);
    same(free.clutch.sprags.centroid_m[0], -0.1e-3);
    same(free.clutch.sprags.centroid_m[1], 0.5288e-3);
    assert_eq!(free.clutch.sprags.inner_arcs.len(), 1);
    same(free.clutch.races.width_m, 12e-3);
    assert_eq!(free.clutch.races.inner_bore_radius_m, 0.0);
    assert_eq!(free.clutch.contact, ContactLaw::Slice { coefficient: 3.84e-5 });
    assert_eq!(design.clutch, parse(MULTI).clutch, "the base is untouched");
}

#[test]
fn materials_by_body_and_flanks_apart_from_the_width() {
    let bodies = ["sprag", "inner_race", "outer_race"].map(|b| {
        format!("[material.{b}]\nyoungs_modulus_gpa = 200\npoisson_ratio = 0.28\ndensity_kg_m3 = 7800\n")
    });
    let start = MULTI.find("[material]").expect("material");
    let end = MULTI.find("[friction]").expect("friction");
    let text = [&MULTI[..start], &bodies.concat(), &MULTI[end..]].concat();
    let text = text.replacen("width_mm = 5.05", "flanks = { rear_mm = 2.2, front_mm = 3.0 }", 1);
    let design = parse(&text);
    assert_eq!(design.clutch.materials.inner_race.youngs_modulus_pa, 200e9);
    assert_eq!(design.clutch.sprags.width_m, 0.0, "omitted: no body compression");
    let expected = Flanks::parallel(2.2e-3, 3e-3);
    assert_eq!(design.clutch.sprags.flanks, Some(expected));
}

/// The multi-arc design without the keys that begin a line.
fn without(keys: &[&str]) -> String {
    let kept = MULTI.split_inclusive('\n').filter(|l| !keys.iter().any(|k| l.starts_with(k)));
    // The search cannot move a centroid that the file does not hold.
    let kept = kept.filter(|l| keys.len() < 3 || !l.contains("name = \"centroid_"));
    kept.collect()
}

#[test]
fn mass_inertia_and_centroid_left_out_come_from_the_outline() {
    let text = without(&["mass_kg", "inertia_kg_m2", "centroid"]).replacen(
        "friction = { static = 0.082, kinetic = 0.082 }",
        "contact = { law = \"hertz\" }\nsprags = { flanks = { rear_mm = 2.6, front_mm = 2.6 } }",
        1,
    );
    let design = parse(&text);
    let s = &design.clutch.sprags;
    assert_eq!(s.mass_source, MassSource::FromProfile);

    const SAGITTA_M: f64 = 1e-10;
    // Polygon of the outline, by the shoelace: a second way to the same integrals.
    let profile = design.clutch.profile().unwrap_or_else(|e| panic!("{e}"));
    let outline = Outline::new(&profile, 2.525e-3, 2.525e-3).unwrap_or_else(|e| panic!("{e}"));
    let points = outline.polyline(SAGITTA_M);
    let (mut area, mut first, mut polar) = (0.0, [0.0; 2], 0.0);
    for (i, p) in points.iter().enumerate() {
        let q = points[(i + 1) % points.len()];
        let cross = p[0] * q[1] - p[1] * q[0];
        area += cross / 2.0;
        for axis in 0..2 {
            first[axis] += cross * (p[axis] + q[axis]) / 6.0;
            polar += cross * (p[axis] * p[axis] + p[axis] * q[axis] + q[axis] * q[axis]) / 12.0;
        }
    }
    let centroid = first.map(|f| f / area);
    let about_centroid = polar - area * (centroid[0].powi(2) + centroid[1].powi(2));
    let surface = 7850.0 * 6e-3;
    // The polygon lacks at most a strip of that sagitta along the outline, nowhere farther than 5 mm from G.
    let (strip, far) = (SAGITTA_M * 30e-3, 5e-3);
    for (got, want, bound) in [
        (s.mass_kg, surface * area, surface * strip),
        (s.inertia_kg_m2, surface * about_centroid, surface * strip * far * far),
        (s.centroid_m[0], centroid[0], strip * far / area),
        (s.centroid_m[1], centroid[1], strip * far / area),
    ] {
        assert!((got - want).abs() < bound, "{got} is not {want} within {bound}");
    }
    let exact = outline.mass_properties(6e-3, 7850.0);
    assert_eq!(
        (s.mass_kg, s.inertia_kg_m2, s.centroid_m),
        (exact.mass_kg, exact.inertia_kg_m2, exact.centroid_m)
    );
    // Measured mass of Table 1; its outline is assumed.
    assert!((s.mass_kg / 1.8e-3 - 1.0).abs() < 0.05, "{}", s.mass_kg);

    let Some(wider) = design.scenario("low-6-mu082") else { panic!("no low-6-mu082") };
    assert_eq!(wider.clutch.contact, ContactLaw::Hertz);
    assert_eq!(wider.overrides, ["sprags", "contact"]);
    assert_eq!(wider.clutch.sprags.flanks, Some(Flanks::parallel(2.6e-3, 2.6e-3)));
    assert!(wider.clutch.sprags.mass_kg > 1.01 * s.mass_kg, "an override is weighed anew");
    let Some(other) = design.scenario("low-8-mu082") else { panic!("no low-8-mu082") };
    assert_eq!(other.clutch.sprags, *s);
}

#[test]
fn a_design_with_neither_width_nor_flanks_is_a_design() {
    let settings = Settings::default();
    let codes = |design: &Design| -> Vec<String> {
        let rows = margins(design, &[], &settings);
        rows.unwrap_or_else(|e| panic!("{e}")).into_iter().map(|row| row.code()).collect()
    };
    for text in [without(&["width_mm = 5.05"]), MULTI.replacen("width_mm = 5.05", "width_mm = 0.0 ", 1)] {
        let open = parse(&text);
        assert_eq!((open.clutch.sprags.flanks, open.clutch.sprags.width_m), (None, 0.0));
        assert!(load_state(&open).unwrap_or_else(|e| panic!("{e}")).outline.is_none());
        let (mut all, some) = (codes(&parse(MULTI)), codes(&open));
        assert!(all.contains(&"neighbours".to_owned()));
        all.retain(|code| code != "neighbours");
        assert_eq!(some, all, "every other row stays");
        let profile = open.clutch.profile().unwrap_or_else(|e| panic!("{e}"));
        assert!(Outline::narrowest(&profile).is_ok(), "and it can be drawn");
    }
}

/// `[check]` names scenarios that must hold; the example designs hold theirs.
#[test]
fn the_scenarios_that_the_examples_check_hold() {
    let settings = Settings::default();
    for design in [parse(MULTI), parse(SINGLE)] {
        let rows = margins(&design, &design.check_scenarios, &settings);
        let rows = rows.unwrap_or_else(|e| panic!("{e}"));
        for name in &design.check_scenarios {
            for code in [format!("slip:{name}"), format!("contact:{name}")] {
                let row = rows.iter().find(|row| row.code() == code).unwrap_or_else(|| panic!("no {code}"));
                assert!(row.required && row.margin() > 0.0, "{}: {row:?}", design.name);
            }
        }
    }
}

/// Numbers that no decimal of a few digits hits: what is written must read back as the same double.
#[test]
fn edited_values_read_back_exactly_and_comments_stay() {
    let flanks = "flanks = { rear_mm = 2.5, front_mm = 2.5, rear_tilt_rad = 0.0, front_tilt_rad = 0.0 }";
    let crown = "[contact]\nend_profile = { kind = \"crown\", radius_mm = 1000.0 }";
    let spiral =
        "inner_spiral = { strut_angle_deg = 4.5, start_radius_mm = 4.0, rise = 0.1, until_rad = 0.5 }";
    let text = MULTI.replacen("width_mm = 5.05", &format!("{flanks}\n{spiral}\nwidth_mm = 5.05"), 1);
    let text = text.replacen("[contact]", crown, 1);
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    for _ in 0..50 {
        let values: Vec<(String, f64)> = variable_names(3)
            .into_iter()
            .map(|name| {
                state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
                (name, (state >> 11) as f64 * 2f64.powi(-53) * 1e-3 + 1e-9)
            })
            .collect();
        let values: Vec<(&str, f64)> = values.iter().map(|(n, v)| (n.as_str(), *v)).collect();
        let edited = with_values(&text, &values).unwrap_or_else(|e| panic!("{e}"));
        let table: toml::Table = toml::from_str(&edited).expect("TOML");
        for (name, value) in values {
            let path = variable_path(name, 3).expect(name);
            let mut at = &toml::Value::Table(table.clone());
            for step in path.split(['.', '[']) {
                at = match step.strip_suffix(']') {
                    Some(row) => &at[row.parse::<usize>().expect("row")],
                    None => &at[step],
                };
            }
            assert_eq!(at.as_float(), Some(value), "{name}");
        }
        let comments = |t: &str| -> Vec<String> {
            t.lines().filter_map(|l| l.split_once('#').map(|(_, c)| c.to_owned())).collect()
        };
        assert_eq!(comments(&edited), comments(&text));
        assert_eq!(edited.lines().count(), text.lines().count());
    }
}

#[test]
fn an_edited_design_is_a_design() {
    let text = with_values(MULTI, &[("r_i2_mm", 4.1), ("centroid_x_mm", -0.05), ("junction_1_rad", 0.07)]);
    let text = text.and_then(|t| with_limits(&t, &[("keep_contact_to_rpm", 6000.0), ("slip_margin", 0.2)]));
    let text = text.unwrap_or_else(|e| panic!("{e}"));
    assert!(text.contains("{ radius_mm = 4.1, until_rad = 0.12 },   # r_i2 paper"), "{text}");
    assert!(text.contains("keep_contact_to_rpm = 6000.0\n"), "{text}");
    let design = parse(&text);
    same(design.clutch.sprags.inner_arcs[1].radius_m, 4.1e-3);
    same(design.clutch.sprags.centroid_m[0], -0.05e-3);
    assert_eq!(design.clutch.sprags.inner_arcs[0].until_rad, 0.07);
    assert_eq!(design.limits.slip_margin, Some(0.2));
    assert_eq!(with_values(MULTI, &[]).as_deref(), Ok(MULTI), "no edit, no change");

    let without = MULTI.replacen("slip_margin = 0.10\n", "", 1);
    let text = with_limits(&without, &[("slip_margin", 0.3)]).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(parse(&text).limits.slip_margin, Some(0.3), "a new key");
    let start = MULTI.find("[limits]").expect("limits");
    let end = MULTI.find("[check]").expect("check");
    let none = [&MULTI[..start], &MULTI[end..]].concat();
    let text = with_limits(&none, &[("slip_margin", 0.3)]).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(parse(&text).limits.slip_margin, Some(0.3), "a new table");

    let rows = "[[sprags.inner_arcs]]\nradius_mm = 4.02\nuntil_rad = 0.4 # end\n";
    let text = with_values(rows, &[("profile_end_rad", 0.5)]).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(text, "[[sprags.inner_arcs]]\nradius_mm = 4.02\nuntil_rad = 0.5 # end\n");
}

#[test]
fn edits_that_cannot_be_made() {
    let message = |result: Result<String, EditError>| match result {
        Ok(_) => panic!("accepted"),
        Err(error) => error.to_string(),
    };
    assert!(message(with_values(MULTI, &[("r_i9_mm", 4.0)])).contains("r_i3_mm, junction_1_rad"));
    assert!(message(with_values(MULTI, &[("r_i1_mm", f64::NAN)])).contains("not a finite"));
    assert!(
        message(with_values(MULTI, &[("flank_rear_mm", 2.0)])).contains("holds no sprags.flanks.rear_mm")
    );
    assert!(message(with_values("sprags = 3", &[("width_mm", 2.0)])).contains("holds no sprags.width_mm"));
    assert!(message(with_values("[", &[("width_mm", 2.0)])).contains("no TOML"));
    assert!(message(with_limits(MULTI, &[("speed", 2.0)])).contains("slip_margin"));
    assert!(message(with_limits(MULTI, &[("slip_margin", f64::INFINITY)])).contains("not a finite"));
    assert!(message(with_limits("limits = 3", &[("slip_margin", 0.1)])).contains("holds no limits"));
}

/// Every key in the schema has a description, every key that ends in a unit names it there; nothing is null.
#[test]
fn the_schema_describes_every_key() {
    fn walk(schema: &serde_json::Value, path: &str, keys: &mut usize) {
        let Some(properties) = schema.get("properties").and_then(|p| p.as_object()) else { return };
        assert_eq!(schema["additionalProperties"], false, "{path}");
        for (key, property) in properties {
            let path = format!("{path}.{key}");
            *keys += 1;
            let text =
                property["description"].as_str().unwrap_or_else(|| panic!("{path} has no description"));
            for (suffix, unit) in [
                ("_mm", "mm"),
                ("_kg", "kg"),
                ("_nm", "N m"),
                ("_rad", "rad"),
                ("_rpm", "rev/min"),
                ("_mpa", "MPa"),
                ("_gpa", "GPa"),
                ("_hz", "Hz"),
                ("_s", ", s"),
                ("_m_s", "m/s"),
                ("_mm2_s", "mm^2/s"),
                ("_kg_m2", "kg m^2"),
                ("_kg_m3", "kg/m^3"),
            ] {
                let other = ["_nm_s", "_m_s", "_mm2_s"].iter().any(|end| key.ends_with(end));
                if key.ends_with(suffix) && !(suffix == "_s" && other) {
                    assert!(text.contains(unit), "{path}: {text:?} lacks {unit}");
                }
            }
            assert!(property["type"].is_string(), "{path}: {property}");
            walk(property, &path, keys);
            walk(&property["items"], &path, keys);
        }
    }
    let mut keys = 0;
    let schema = schema();
    walk(&schema, "", &mut keys);
    assert!(keys > 100, "{keys}");
    assert!(!schema.to_string().contains("null"), "TOML has no null");
    assert_eq!(schema["properties"]["friction"]["required"].as_array().map(Vec::len), Some(3));
    assert!(schema["properties"]["scenarios"]["items"]["properties"]["friction"].get("required").is_none());
    assert!(parse(SINGLE).optimize.is_some());
}
