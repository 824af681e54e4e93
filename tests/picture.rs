//! The README's picture is what the tool draws of the README's design, today.
//!
//! Remake it with `REMAKE=1 cargo test -r the_picture` (no long flags: an XML comment holds no double hyphen).

use sprag_design::answer::page::{drawing, pose_at_rest, pose_at_torque};
use sprag_design::design::{allowed, schema};
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

/// One table of the file and those within it, as sections of the page.
fn section(path: &str, table: &serde_json::Value, designs: &[toml::Value], page: &mut String) {
    let text = |v: &serde_json::Value| {
        v["description"].as_str().unwrap_or_default().replace('|', "\\|").replace('\n', " ")
    };
    let heading = match path.strip_suffix("[]") {
        Some(array) => format!("`[[{array}]]`"),
        None if path.is_empty() => "At the top".to_owned(),
        None => format!("`[{path}]`"),
    };
    *page += &format!("\n## {heading}\n\n{}\n", text(table));
    let needed = |name: &str| table["required"].as_array().is_some_and(|r| r.iter().any(|k| k == name));
    let (mut rows, mut within) = (String::new(), Vec::new());
    for (name, key) in table["properties"].as_object().unwrap() {
        let full = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
        let repeats = path == "scenarios[]" || full == "optimize.limits";
        if key["type"] == "object" && repeats {
            rows += &format!("| `{name}` | {} | keys of `[{name}]` | | |\n", text(key));
        } else if key["type"] == "object" {
            within.push((full, key.clone()));
        } else if key["items"]["type"] == "object" {
            let mut entry = key["items"].clone();
            entry["description"] = key["description"].clone();
            within.push((full + "[]", entry));
        } else {
            let seen = values(designs, &full).map_or(String::new(), |[low, high]| match low == high {
                true => format!("{low}"),
                false => format!("{low} … {high}"),
            });
            let must = if needed(name) { "yes" } else { "" };
            let allowed = allowed(key).replace('|', "\\|");
            rows += &format!("| `{name}` | {} | {allowed} | {must} | {seen} |\n", text(key));
        }
    }
    if !rows.is_empty() {
        *page += &format!(
            "\n| key | what it is, unit | allowed | needed | in `designs/` |\n|---|---|---|---|---|\n{rows}"
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
         values of the designs in `designs/`. `sprag-design explain KEY` prints a row.\n",
    );
    section("", &schema(), &designs, &mut now);
    if std::env::var_os("REMAKE").is_some() {
        std::fs::write(root.join(KEYS), &now).unwrap();
    }
    let kept = std::fs::read_to_string(root.join(KEYS)).unwrap();
    assert!(kept == now, "{KEYS} is out of date: REMAKE=1 cargo test -r the_page_of_keys");
}
