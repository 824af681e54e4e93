//! `accuracy` from outside: keys, CSV, the map, exit codes, what Ctrl-C leaves.

use serde_json::Value;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::Duration;

const DESIGN: &str = "designs/huang2017-multi-arc.toml";

fn tool(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_sprag-design"));
    command.env("NO_COLOR", "1").args(["accuracy", DESIGN]).args(args);
    command
}

fn scratch(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("sprag-accuracy-{name}-{}.csv", std::process::id()))
}

#[test]
fn a_scene_and_a_few_cases_are_compared_and_written() {
    let csv = scratch("csv");
    let args = ["--scenario", "high-6", "--min-step", "3e-5", "--cases", "4", "--json"];
    let out = tool(&args).arg("--csv").arg(&csv).output().unwrap();
    assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stderr));
    let answer: Value = serde_json::from_slice(&out.stdout).unwrap();
    let scene = &answer["scenes"][0];
    assert_eq!(scene["scenario"], "high-6");
    // theta_bi by an independent script, -0.010152.
    assert!((scene["reference"]["theta_inner_end_rad"].as_f64().unwrap() + 0.010152).abs() < 1e-6);
    let points = scene["points"].as_array().unwrap();
    // 17 tolerances three ways; two steps in three bands.
    assert_eq!(points.len(), 3 * 17 + 2 * 3);
    for p in points.iter().filter(|p| p["method"] == "event-full") {
        let (tolerance, error) =
            (p["tolerance"].as_f64().unwrap(), p["theta_inner_error_rad"].as_f64().unwrap());
        assert!(error < tolerance.max(1e-12), "{p}");
    }
    let map = &answer["stability_map"];
    assert_eq!((map["cases"].as_u64(), map["seed"].as_u64()), (Some(4), Some(1)));
    let outcomes: u64 = map["outcomes"].as_object().unwrap().values().map(|v| v.as_u64().unwrap()).sum();
    assert_eq!(outcomes, 4);
    assert_eq!(map["not_finite"], Value::Array(Vec::new()));
    let written = std::fs::read_to_string(&csv).unwrap();
    std::fs::remove_file(&csv).unwrap();
    let rows: Vec<&str> = written.lines().filter(|l| !l.starts_with('#')).collect();
    assert!(rows[0].starts_with("scenario,method,tolerance"), "{}", rows[0]);
    assert_eq!(rows.len(), 1 + points.len());
}

#[test]
fn a_scheme_that_never_finishes_is_said_in_words() {
    // At 1e-4 s the published scheme leaves the equations of this scene.
    let out = tool(&["--scenario", "high-10", "--min-step", "1e-4", "--cases", "0"]).output().unwrap();
    let said = String::from_utf8_lossy(&out.stdout).into_owned();
    assert_eq!(out.status.code(), Some(0), "{said}");
    assert!(said.contains("published never: no step finished") && !said.contains("inf rad"), "{said}");
}

#[test]
fn what_makes_no_sense_is_refused() {
    for (args, word) in [
        (["--min-step", "1"], "--min-step"),
        (["--scenario", "rated-4"], "rated-4"),
        (["--cases", "many"], "cases"),
    ] {
        let out = tool(&args).output().unwrap();
        let said = String::from_utf8_lossy(&out.stderr).into_owned();
        assert_eq!(out.status.code(), Some(2), "{args:?}: {said}");
        assert!(said.contains(word) && out.stdout.is_empty(), "{args:?}: {said}");
    }
}

#[cfg(unix)]
#[test]
fn ctrl_c_writes_what_was_found() {
    // Far more cases than can be run in the time.
    let args = ["--scenario", "high-6", "--min-step", "1e-4", "--cases", "100000", "--json", "--quiet"];
    let child = tool(&args).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    std::thread::sleep(Duration::from_secs(6));
    Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    let out = child.wait_with_output().unwrap();
    assert_eq!(out.status.code(), Some(130), "{}", String::from_utf8_lossy(&out.stderr));
    let answer: Value = serde_json::from_slice(&out.stdout).unwrap();
    // However far it came: what is there is whole.
    for scene in answer["scenes"].as_array().unwrap() {
        assert!(!scene["points"].as_array().unwrap().is_empty());
    }
    let map = &answer["stability_map"];
    assert!(map.is_null() || map["cases"].as_u64().unwrap() < 100_000, "{map}");
    assert!(!String::from_utf8_lossy(&out.stdout).contains("\"interrupted\""));
}
