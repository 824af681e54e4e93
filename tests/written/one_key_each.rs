//! Every command that has both --csv and --json: the keys of the table are those of JSON.

use crate::program::*;
use serde_json::Value;
use std::collections::BTreeSet;

const FE: &str = "designs/huang2017-single-arc.toml";
const TWO: [&str; 2] = [SINGLE, MULTI];

/// Keys of a table that its rows in JSON do not have, and why.
const APART: [(&str, &[&str], &str); 4] = [
    (
        "compare",
        &["section", "value_1", "value_2"],
        "JSON has a list for each section, and the values of a row in one list",
    ),
    (
        "stiffness",
        &["contact", "state"],
        "JSON has the rows of a law together, and torques not carried apart",
    ),
    (
        "optimize",
        &["demand_before", "demand_after", "margin_before", "margin_after", "held"],
        "JSON has the design before and the best one each with its margins",
    ),
    ("simulate", &[], "the table is the history, which JSON does not have"),
];

/// What each command is asked, without --json and --csv; `{}` is a folder.
const ASKED: [&[&str]; 20] = [
    &["check", MULTI],
    &["sheet", MULTI, "--report", "{}/sheet.html"],
    &["compare", TWO[0], TWO[1]],
    &["stiffness", MULTI, "--torques", "3,16.8"],
    &["simulate", MULTI, "--scenario", "high-6"],
    &["life", "designs/indexing-life.toml"],
    &["sharing", "designs/unlike-sprags.toml"],
    &[
        "reengage",
        "designs/starter.toml",
        "--torque",
        "50",
        "--inner-inertia",
        "0.05",
        "--friction",
        "0.06",
        "--paths",
        "0.1,1",
    ],
    &[
        "feed",
        "designs/indexing.toml",
        "--stroke",
        "30",
        "--brake",
        "100",
        "--inertia",
        "0.02",
        "--frequency",
        "2",
    ],
    &["resonance", MULTI, "--scenario", "high-6"],
    &["overrun", "designs/lubricated.toml", "--speeds", "300,1000"],
    &["optimize", MULTI, "-o", "{}/best.toml", "--starts", "1", "--evaluations", "4"],
    &["map", "{}/sweep.csv"],
    &["accuracy", MULTI, "--cases", "0", "--min-step", "1e-4", "--scenario", "high-6"],
    &["size", "--bore", "20", "--torque", "150", "-o", "{}/sized.toml"],
    &["new", "--for", "indexing", "--bore", "20", "--torque", "150", "-o", "{}/new.toml"],
    &["identify", MULTI, "--data", "{}/data.csv", "--unknown", "r_i3_mm:3.6:4.8", "--starts", "1"],
    &["export", FE, "--format", "calculix", "--read", "{}/s.dat", "--torques", "16.8"],
    &["import", "{}/sprag.dxf"],
    &["materials"],
];

/// Rows of JSON, wherever they stand: the keys of the first object of each list.
fn rows(value: &Value, found: &mut Vec<BTreeSet<String>>) {
    match value {
        Value::Array(list) => {
            found.extend(list.first().and_then(Value::as_object).map(|row| row.keys().cloned().collect()));
            list.iter().for_each(|v| rows(v, found));
        }
        Value::Object(keys) => keys.values().for_each(|v| rows(v, found)),
        _ => {}
    }
}

fn quietly(args: &[&str]) {
    let output = run(args);
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
}

fn prepare(folder: &Folder) {
    let data = "label,use,torque_nm,windup_deg\na,,10,1.2345\nb,fit,16.8,1.94\nc,,50,5.1\n";
    std::fs::write(folder.path("data.csv"), data).unwrap();
    quietly(&["export", MULTI, "--format", "dxf", "-o", &folder.path("sprag.dxf"), "--quiet"]);
    let deck = folder.path("s.inp");
    let made = ["export", FE, "--format", "calculix", "--variant", "plane-strain", "--torque", "26.8", "-o"];
    quietly(&[&made[..], &[&deck, "--quiet"]].concat());
    std::fs::copy("tests/reference/calculix_excerpt.dat", folder.path("s.dat")).unwrap();
    let sweep = "index,x_mm,y_mm,margin,deciding,feasible\n0,0,-1,-0.5,hoop,0\n1,0,1,0.1,hertz,1\n2,1,-1,-0.2,hoop,0\n";
    std::fs::write(folder.path("sweep.csv"), sweep).unwrap();
}

#[test]
fn a_figure_has_one_key() {
    let folder = Folder::new();
    prepare(&folder);
    let oils: &[&str] = &["oils"];
    for asked in ASKED.into_iter().chain([oils]) {
        let csv = folder.path("out.csv");
        let args: Vec<String> = asked.iter().map(|a| a.replace("{}", &folder.path(""))).collect();
        let mut args: Vec<&str> = args.iter().map(String::as_str).collect();
        args.extend(["--json", "--force", "--csv", &csv]);
        let output = run(&args);
        assert!(output.status.code().is_some_and(|c| c < 2), "{args:?}: {output:?}");
        let value: Value = serde_json::from_slice(&output.stdout).unwrap();
        let table = std::fs::read_to_string(&csv).unwrap();
        let header: Vec<&str> = table.lines().next().unwrap().split(',').collect();
        assert!(header.len() > 1 && table.lines().count() > 1, "{args:?}: {table}");
        let apart = APART.iter().find(|(command, ..)| *command == asked[0]);
        if apart.is_some_and(|(_, keys, _)| keys.is_empty()) {
            continue;
        }
        let apart = apart.map_or(&[][..], |(_, keys, _)| keys);
        assert!(apart.iter().all(|key| header.contains(key)), "no longer apart in {args:?}: {header:?}");
        let wanted = || header.iter().filter(|key| !apart.contains(key));
        let mut found = Vec::new();
        rows(&value, &mut found);
        let lacks = |row: &BTreeSet<String>| wanted().filter(|key| !row.contains(**key)).count();
        let nearest = found.iter().min_by_key(|row| lacks(row)).unwrap();
        let lacking: Vec<&&str> = wanted().filter(|key| !nearest.contains(**key)).collect();
        assert!(lacking.is_empty(), "{args:?}: JSON has no {lacking:?}, but {nearest:?}");
    }
}

/// A command that is new is asked too.
#[test]
fn every_command_with_table_and_json_is_asked() {
    let help = stdout(&run(&["--help"]));
    let names = help.lines().filter_map(|line| line.strip_prefix("  ")?.split_whitespace().next());
    let mut count = 0;
    for name in names.filter(|name| name.starts_with(|c: char| c.is_ascii_lowercase())) {
        let help = stdout(&run(&[name, "--help"]));
        if help.contains("--csv") && help.contains("--json") {
            let asked = name == "oils" || ASKED.iter().any(|asked| asked[0] == name);
            assert!(asked, "{name} has a table and JSON: add a line to ASKED");
            count += 1;
        }
    }
    assert!(count > 15, "{help}");
}
