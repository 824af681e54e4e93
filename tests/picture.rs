//! The README's picture is what the tool draws of the README's design, today.
//!
//! Remake it with `REMAKE=1 cargo test -r the_picture` (no long flags: an XML comment holds no double hyphen).

use sprag_design::answer::page::{drawing, pose_at_rest, pose_at_torque};
use sprag_design::file::{allowed, schema};
use sprag_design::{Design, WedgeCurve};
use std::path::Path;

const DESIGN: &str = "designs/huang2017-multi-arc.toml";
const PICTURE: &str = "reports/sprag.svg";

fn draw() -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let design = Design::read(&root.join(DESIGN)).unwrap();
    let profile = design.clutch.profile().unwrap();
    let curve = WedgeCurve::build(&design.clutch, &profile, 0.0).unwrap();
    let rest = pose_at_rest("first contact", &design, &profile);
    let loaded = pose_at_torque(&rest, &curve, 110.0).unwrap();
    // White behind: a reader's page may be dark.
    let svg = drawing(&design, vec![rest, loaded]).detail_svg().replacen(
        "<svg ",
        "<svg style=\"background:#fff\" ",
        1,
    );
    format!(
        "<!-- sprag-design {}, {DESIGN} (sha256 {}), made by: REMAKE=1 cargo test -r the_picture -->\n{svg}\n",
        env!("CARGO_PKG_VERSION"),
        design.hash
    )
}

#[test]
fn the_picture_is_what_the_tool_draws() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(PICTURE);
    let now = draw();
    if std::env::var_os("REMAKE").is_some() {
        std::fs::write(&path, &now).unwrap();
    }
    let kept = std::fs::read_to_string(&path).unwrap();
    assert!(kept == now, "{PICTURE} is out of date: REMAKE=1 cargo test -r the_picture");
}

const KEYS: &str = "docs/src/keys.md";

/// Ends of the values that a dotted key (`[]` for every entry of an array) has in the designs of the repository.
fn values(designs: &[toml::Value], path: &str) -> Option<[f64; 2]> {
    let mut at: Vec<&toml::Value> = designs.iter().collect();
    for key in path.split('.') {
        let (name, each) = key.strip_suffix("[]").map_or((key, false), |name| (name, true));
        let found = at.iter().filter_map(|v| v.get(name));
        at = if each { found.filter_map(|v| v.as_array()).flatten().collect() } else { found.collect() };
    }
    let numbers = at.iter().filter_map(|v| v.as_float().or(v.as_integer().map(|i| i as f64)));
    numbers.fold(None, |ends, x| {
        let [low, high] = ends.unwrap_or([x, x]);
        Some([low.min(x), high.max(x)])
    })
}

/// What is typical of numbers that no design of the repository names: the end of their dotted keys, and values met in practice.
const TYPICAL: &[(&str, &str)] = &[
    ("cage.clearance_um", "0 … 20"),
    ("contact.axial_offset_mm", "0 … 0.5"),
    ("contact.hunt_crossley_s_per_m", "0.1 … 0.5, hardened steel"),
    ("contact.slices", "60"),
    ("contact.tilt_mrad", "0 … 1"),
    ("end_profile.crowned_ratio", "0.5 … 1"),
    ("end_profile.design_load_n", "the normal force at nominal torque"),
    ("end_profile.end_drop_um", "5 … 20"),
    ("end_profile.length_mm", "0.5 … 2"),
    ("end_profile.load_factor", "1 … 2"),
    ("end_profile.radius_mm", "500 … 5000"),
    ("points[].drop_um", "0 … 20"),
    ("points[].y_mm", "up to half the length"),
    ("gas.intake_pressure_mpa", "0.1; boosted 0.15 … 0.3"),
    ("gas.polytropic_exponent", "1.25 … 1.35"),
    ("gas.rod_ratio", "0.2 … 0.35"),
    ("orders[].phase_rad", "0 … 6.28"),
    ("pitting.exponent", "6.67"),
    ("life.core.cycles", "1e6 … 1e7"),
    ("life.core.exponent", "6.67"),
    ("life.core.shear_mpa", "350 … 600"),
    ("limits.along_mpa", "4200 … 5000"),
    ("limits.at_speed_rpm", "the clutch's own speed"),
    ("limits.axial_load_n", "0 … some 100"),
    ("limits.case_depth_mm", "0.3 … 1.2"),
    ("limits.case_shear_mpa", "900 … 1300, 60 HRC"),
    ("limits.core_shear_mpa", "350 … 600"),
    ("limits.equivalent_inner_mpa", "500 … 900"),
    ("limits.equivalent_outer_mpa", "500 … 900"),
    ("limits.film_at_rpm", "the slowest long overrun"),
    ("limits.film_lambda", "1 … 3"),
    ("limits.gap_nominal_mm", "1.015 of the gap at rest"),
    ("limits.gap_peak_mm", "1.03 of the gap at rest"),
    ("limits.hoop_inner_bending_mpa", "400 … 800"),
    ("limits.hoop_outer_bending_mpa", "400 … 800"),
    ("limits.windup_nominal_deg", "2 … 8"),
    ("race_to_oil_w_per_k", "1 … 10"),
    ("lubrication.nu100_mm2_s", "4 … 20"),
    ("lubrication.nu40_mm2_s", "15 … 460"),
    ("lubrication.slip_heat_w", "0 … 50"),
    ("lubrication.sprags_to_oil_w_per_k", "0.5 … 5"),
    ("expansion_um_per_m_k", "11 … 12.5, steel"),
    ("density_kg_m3", "7700 … 7850, steel; 3200, silicon nitride"),
    ("poisson_ratio", "0.26 … 0.3"),
    ("youngs_modulus_gpa", "200 … 212, steel; 310, silicon nitride"),
    ("optimize.reserve", "0 … 0.1"),
    ("optimize.step_mm", "0.005"),
    ("torque_random.seed", "1"),
    ("press_fit.inner_interference_um", "10 … 60"),
    ("press_fit.shaft_bore_radius_mm", "0, solid"),
    ("scenarios[].torque_nm", "the nominal torque"),
    ("sharing.azimuth_within_deg", "0 … 2"),
    ("sharing.bearing_mass_kg", "0.2 … 20"),
    ("sharing.bearing_stiffness_n_per_um", "100 … 1000; 0, none"),
    ("sharing.gap_up_to_um", "0 … 10"),
    ("sharing.sprags[].ahead_deg", "-2 … 2"),
    ("sharing.sprags[].friction", "0.05 … 0.12"),
    ("sharing.sprags[].spring_factor", "0 … 1"),
    ("sharing.tracks[].amplitude_um", "1 … 10"),
    ("sharing.tracks[].azimuth_deg", "0 … 90"),
    ("sharing.tracks[].lobes", "2 … 5"),
    ("inner_spiral.rise", "0.08 … 0.8"),
    ("inner_spiral.start_radius_mm", "3.6 … 4.2"),
    ("inner_spiral.steps", "12"),
    ("flanks.front_tilt_rad", "-0.1 … 0.1"),
    ("flanks.rear_tilt_rad", "-0.1 … 0.1"),
    ("swings[].hours", "100 … 10000"),
    ("overruns[].hours", "100 … 20000"),
    ("thermal.reference_c", "20"),
    ("tolerances.expansion_per_k", "1.15e-5"),
    ("tolerances.friction", "0.005 … 0.02"),
    ("tolerances.inner_race_radius_mm", "0.002 … 0.01"),
    ("tolerances.outer_race_radius_mm", "0.002 … 0.01"),
    ("tolerances.run_out_mm", "0.005 … 0.05"),
    ("tolerances.sprag_inner_radius_mm", "0.002 … 0.005"),
    ("tolerances.sprag_outer_radius_mm", "0.002 … 0.005"),
    ("tolerances.temperature_k", "10 … 60"),
];

/// Values of a key: those of the designs of the repository, or what is typical. Every number has some.
fn seen(designs: &[toml::Value], full: &str, key: &serde_json::Value) -> String {
    if let Some([low, high]) = values(designs, full) {
        return if low == high { format!("{low}") } else { format!("{low} … {high}") };
    }
    let typical = TYPICAL.iter().find(|(end, _)| full.ends_with(end));
    let is_number = matches!(key["type"].as_str(), Some("number" | "integer"));
    assert!(typical.is_some() || !is_number, "{full}: what is typical of it?");
    typical.map_or(String::new(), |(_, words)| format!("*{words}*"))
}

/// One table of the file and those within it, as sections of the page.
fn section(path: &str, table: &serde_json::Value, designs: &[toml::Value], page: &mut String) {
    let text = |v: &serde_json::Value| {
        v["description"].as_str().unwrap_or_default().replace('|', "\\|").replace('\n', " ")
    };
    let heading = match path.strip_suffix("[]") {
        Some(array) => format!("`[[{array}]]`"),
        None if path.is_empty() => "At the top".to_owned(),
        // Within a row of an array.
        None => format!("`[{}]`", path.replace("[]", "")),
    };
    *page += &format!("\n## {heading}\n\n{}\n", text(table));
    let needed = |name: &str| table["required"].as_array().is_some_and(|r| r.iter().any(|k| k == name));
    let (mut rows, mut within) = (String::new(), Vec::new());
    let whole = schema();
    let top = &whole["properties"];
    for (name, key) in table["properties"].as_object().unwrap() {
        let full = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
        // What a scenario says otherwise has its section at the top.
        let repeats = path == "scenarios[]" && top.get(name).is_some() || full == "optimize.limits";
        if key["type"] == "object" && repeats {
            rows += &format!("| `{name}` | {} | keys of `[{name}]` | | |\n", text(key));
        } else if key["type"] == "object" {
            within.push((full, key.clone()));
        } else if key["items"]["type"] == "object" {
            let mut entry = key["items"].clone();
            entry["description"] = key["description"].clone();
            within.push((full + "[]", entry));
        } else {
            let seen = seen(designs, &full, key);
            let must = if needed(name) { "yes" } else { "" };
            let allowed = allowed(key).replace('|', "\\|");
            rows += &format!("| `{name}` | {} | {allowed} | {must} | {seen} |\n", text(key));
        }
    }
    if !rows.is_empty() {
        *page += &format!(
            "\n| key | what it is, unit | allowed | needed | values |\n|---|---|---|---|---|\n{rows}"
        );
    }
    for (path, table) in within {
        section(&path, &table, designs, page);
    }
}

#[test]
fn the_page_of_keys_is_the_schema_of_the_file() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files: Vec<_> =
        std::fs::read_dir(root.join("designs")).unwrap().map(|f| f.unwrap().path()).collect();
    files.retain(|f| f.extension().is_some_and(|e| e == "toml"));
    let read = |f: &std::path::PathBuf| std::fs::read_to_string(f).unwrap().parse::<toml::Table>().unwrap();
    let designs: Vec<_> = files.iter().map(|f| toml::Value::Table(read(f))).collect();
    let mut now = String::from(
        "# Every key of the design file\n\nMade from the types that read the file (`sprag-design schema` prints them as JSON Schema); the last column has the \
         values of the designs in `designs/`, or in italics what is typical. `sprag-design explain KEY` prints a row.\n",
    );
    section("", &schema(), &designs, &mut now);
    if std::env::var_os("REMAKE").is_some() {
        std::fs::write(root.join(KEYS), &now).unwrap();
    }
    let kept = std::fs::read_to_string(root.join(KEYS)).unwrap();
    assert!(kept == now, "{KEYS} is out of date: REMAKE=1 cargo test -r the_page_of_keys");
}

const EQUATIONS: &str = "docs/src/equations.md";

#[test]
fn the_guide_has_the_register_of_equations() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let register = std::fs::read_to_string(root.join("src/equations.md")).unwrap();
    // Links lead into the documents of the code; a page of the guide keeps their words.
    let mut plain = String::new();
    let mut rest = register.as_str();
    while let Some(at) = rest.find("](crate::") {
        let open = rest[..at].rfind('[').unwrap();
        plain += &format!("{}{}", &rest[..open], &rest[open + 1..at]);
        rest = &rest[at + rest[at..].find(')').unwrap() + 1..];
    }
    let now =
        format!("# Every equation of the paper, and its misprints\n\n{plain}{rest}").replace("\n# ", "\n## ");
    if std::env::var_os("REMAKE").is_some() {
        std::fs::write(root.join(EQUATIONS), &now).unwrap();
    }
    let kept = std::fs::read_to_string(root.join(EQUATIONS)).unwrap();
    assert!(kept == now, "{EQUATIONS} is out of date: REMAKE=1 cargo test -r the_guide_has");
}
