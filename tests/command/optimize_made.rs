//! `optimize` as a user runs it: lengths in steps that can be made, a reserve on limits.

use sprag_design::optimise::{ClutchProblem, Evaluate};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

const DESIGN: &str = "designs/huang2017-multi-arc.toml";

fn tool(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_sprag-design")).args(args).output().unwrap()
}

fn folder(name: &str) -> PathBuf {
    let path = std::env::temp_dir().join(format!("sprag-optimize-made-{name}-{}", std::process::id()));
    std::fs::create_dir_all(&path).unwrap();
    path
}

fn json(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Two lengths and no centroid: short searches of one scenario.
fn two_radii(folder: &Path) -> PathBuf {
    let source = std::fs::read_to_string(DESIGN).unwrap();
    let design = folder.join("two.toml");
    let text: String = source
        .replace("\"high-6\", \"low-10\", \"rated-45\", \"rated-45-at-speed\"]", "\"rated-45\"]")
        .replace("keep_contact_to_rpm = 6000 }", "keep_contact_to_rpm = 4500 }")
        .lines()
        .filter(|l| !l.contains("name = \"centroid_"))
        .map(|l| format!("{l}\n"))
        .collect();
    assert!(text.len() < source.len());
    std::fs::write(&design, text).unwrap();
    design
}

/// Lengths of the answer are multiples of the step, every limit holds there, no neighbour on the grid is better, and what the
/// search came to between them stands beside it.
#[test]
fn lengths_end_on_steps_that_can_be_made() {
    let folder = folder("steps");
    let design = two_radii(&folder);
    let new = folder.join("new.toml");
    let search = |flags: &[&str]| {
        let args =
            ["optimize", design.to_str().unwrap(), "-o", new.to_str().unwrap(), "--starts", "1", "--json"];
        json(&tool(&[&args[..], flags].concat()))
    };
    let free = search(&["--step-mm", "0"]);
    assert!(free["steps"].is_null() && free["unrounded"].is_null(), "{}", free["steps"]);
    let made = search(&["--step-mm", "0.02"]);
    assert_eq!(made["unrounded"]["objective"], free["best"]["objective"]);
    assert_eq!(made["unrounded"]["variables"], free["best"]["variables"]);
    assert_eq!((&made["feasible"], &made["steps"]["found"]), (&true.into(), &true.into()));
    let value = |of: &Value, name: &str| of["best"]["variables"][name].as_f64().unwrap();
    let objective = |of: &Value| of["best"]["objective"].as_f64().unwrap();
    assert!(objective(&made) <= objective(&free) + 1e-9);
    for name in ["r_i2_mm", "r_i3_mm"] {
        let steps = value(&made, name) / 0.02;
        assert!((steps - steps.round()).abs() < 1e-9, "{name} {}", value(&made, name));
        assert!((value(&made, name) - value(&free, name)).abs() < 0.1);
    }
    // What is written says just that, and `check` holds it.
    let text = std::fs::read_to_string(&new).unwrap();
    let written = sprag_design::Design::parse(&text, "new").unwrap();
    let radius = written.clutch.sprags.inner_arcs[2].radius_m * 1e3;
    assert!((radius - value(&made, "r_i3_mm")).abs() < 1e-12);
    assert_eq!(tool(&["check", new.to_str().unwrap(), "-q"]).status.code(), Some(0));
    // No neighbour on the grid holds every limit and is better.
    let task = written.optimize.clone().unwrap();
    let names = ["r_i2_mm".to_owned(), "r_i3_mm".to_owned()];
    let problem = ClutchProblem::new(&written, &task, names.to_vec(), Default::default());
    let at = [value(&made, "r_i2_mm"), value(&made, "r_i3_mm")];
    let here = problem.evaluate(&at).unwrap().least_margin();
    for by in [[0.02, 0.0], [-0.02, 0.0], [0.0, 0.02], [0.0, -0.02]] {
        let x = [at[0] + by[0], at[1] + by[1]];
        if (0..2).any(|i| x[i] < task.variables[i].min - 1e-9 || x[i] > task.variables[i].max + 1e-9) {
            continue;
        }
        let there = problem.evaluate(&x).unwrap();
        assert!(there.violation() > 1e-8 || there.least_margin() <= here, "{x:?}");
    }
    std::fs::remove_dir_all(&folder).unwrap();
}

/// A reserve holds every limit with a margin to spare, at a price.
#[test]
fn a_reserve_is_kept_of_every_limit() {
    let folder = folder("reserve");
    let design = two_radii(&folder);
    let new = folder.join("new.toml");
    let search = |flags: &[&str]| {
        let args = [
            "optimize",
            design.to_str().unwrap(),
            "-o",
            new.to_str().unwrap(),
            "--starts",
            "1",
            "--step-mm",
            "0",
        ];
        let out = tool(&[&args[..], flags, &["--json"]].concat());
        assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stderr));
        json(&out)
    };
    let (free, kept) = (search(&[]), search(&["--reserve", "0.02"]));
    let least = |of: &Value| {
        let rows = of["best"]["margins"].as_array().unwrap();
        rows.iter().map(|m| m["margin"].as_f64().unwrap()).fold(f64::INFINITY, f64::min)
    };
    assert!(least(&free).abs() < 1e-6, "a limit is active: {}", least(&free));
    assert!((least(&kept) - 0.02).abs() < 1e-6, "{}", least(&kept));
    assert!(kept["best"]["objective"].as_f64() < free["best"]["objective"].as_f64());
    assert_eq!(kept["reserve"], 0.02);
    let refused = tool(&["optimize", DESIGN, "-o", new.to_str().unwrap(), "--reserve", "2"]);
    assert_eq!(refused.status.code(), Some(2));
    std::fs::remove_dir_all(&folder).unwrap();
}

/// What other optimisers are told is what `check` holds: the reserve is the own search's.
#[test]
fn a_reserve_is_none_of_evaluate() {
    let told = |reserve: &str| {
        let folder = folder(&format!("evaluate-{reserve}"));
        let points = folder.join("points.csv");
        std::fs::write(&points, "r_i2_mm,r_i3_mm,centroid_x_mm,centroid_y_mm\n4.2,4.4,0.15,0.5\n").unwrap();
        let set = format!("optimize.reserve={reserve}");
        let out =
            tool(&["evaluate", DESIGN, "--vectors", points.to_str().unwrap(), "--quiet", "--set", &set]);
        std::fs::remove_dir_all(&folder).unwrap();
        assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stderr));
        let text = String::from_utf8(out.stdout).unwrap();
        text.lines().last().unwrap().to_owned()
    };
    assert_eq!(told("0.0"), told("0.1"));
}

#[test]
fn an_objective_of_the_clutch_alone_needs_no_scenario() {
    let folder = folder("no-scenario");
    let new = folder.join("new.toml");
    let none =
        ["--set", "optimize.scenarios=[]", "-o", new.to_str().unwrap(), "--json", "--quiet", "--starts", "1"];
    let out = tool(&[&["optimize", DESIGN, "--set", "optimize.objective=peak-pressure"], &none[..]].concat());
    assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stderr));
    assert_eq!(json(&out)["feasible"], true);
    let out = tool(&[&["optimize", DESIGN], &none[..]].concat());
    assert_eq!(out.status.code(), Some(2));
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn a_natural_frequency_between_those_looked_at_is_warned_of() {
    let said = |points: &str| {
        let asked = ["--frequency", "50:150", "--amplitude", "2", "--points", points, "--quiet"];
        let out = tool(&[&["resonance", DESIGN, "--scenario", "high-6"], &asked[..]].concat());
        String::from_utf8(out.stdout).unwrap()
    };
    assert!(
        said("2")
            .contains("Warning: the clutch swings freely at 86.69 Hz, between the frequencies looked at")
    );
    assert!(!said("12").contains("between the frequencies"));
}
