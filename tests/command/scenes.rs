//! `simulate` from outside on scenes that are long: limits, histories, progress, Ctrl-C.

use crate::program::{Folder, MULTI, json, run, stdout};
use sprag_design::design::Design;
use sprag_design::scenario::prepare;

/// Rows of a CSV as text, the head apart.
fn rows(path: &str) -> (Vec<String>, Vec<Vec<String>>) {
    let text = std::fs::read_to_string(path).unwrap();
    let cells = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
    let mut lines = text.lines().filter(|l| !l.starts_with('#'));
    (cells(lines.next().unwrap()), lines.map(cells).collect())
}

fn column(path: &str, key: &str) -> Vec<f64> {
    let (head, rows) = rows(path);
    let at = head.iter().position(|k| k == key).unwrap_or_else(|| panic!("{key} in {head:?}"));
    rows.iter().map(|r| r[at].parse().unwrap()).collect()
}

#[test]
fn a_limit_of_work_is_named_with_what_raises_it() {
    let few = ["simulate", MULTI, "--scenario", "high-10", "--max-steps", "60"];
    let out = run(&few);
    assert_eq!(out.status.code(), Some(3));
    let said = String::from_utf8(out.stderr).unwrap();
    assert!(said.contains("met its limit of 60 steps at 0.0") && said.contains("of 0.3 s"), "{said}");
    assert!(said.contains("--max-steps "), "{said}");
    let answer = json(&run(&[&few[..], &["--json"]].concat()));
    let reason = answer["reason"].as_str().unwrap();
    assert!(reason.contains("limit of 60 steps") && reason.contains("--max-steps "), "{reason}");
    assert!(answer["verdict"].is_null() && answer["stop"] == "step-limit");
    // The history ends early and says so; of the whole scene it says nothing.
    let folder = Folder::new();
    let csv = folder.path("history.csv");
    let head_of = |args: &[&str]| {
        let code = run(&[args, &["--csv", &csv, "--force"]].concat()).status.code();
        (code, rows(&csv).0.last().unwrap().clone())
    };
    assert_eq!(head_of(&few), (Some(3), "partial".to_owned()));
    // Runs that came to the end, and a finer one that did not: a verdict with errors, but not those asked for.
    let finer = ["simulate", MULTI, "--scenario", "high-10", "--max-steps", "600"];
    let answer = json(&run(&[&finer[..], &["--json"]].concat()));
    assert!(answer["verdict"] == "slips-overrunning" && answer["finer_gave_up"] == "step-limit");
    assert!(answer["tolerance_reached"] == false && answer["error_estimate"].is_number());
    let (code, last) = head_of(&finer);
    assert!(code == Some(3) && last != "partial", "{code:?} {last}");
    let few = ["simulate", MULTI, "--scenario", "high-10", "--max-changes", "20", "--json"];
    let answer = json(&run(&few));
    let reason = answer["reason"].as_str().unwrap();
    assert!(reason.contains("limit of 20 changes of mode") && reason.contains("--max-changes "), "{reason}");
    assert!(json(&run(&["simulate", MULTI, "--scenario", "high-10", "--json"]))["reason"].is_null());
}

#[test]
fn a_history_has_the_rows_that_show_the_scene() {
    let folder = Folder::new();
    let long = folder.changed(MULTI, &[("duration_s = 0.3", "duration_s = 1.0")]);
    let csv = folder.path("history.csv");
    let history = |design: &str, more: &[&str]| {
        let args = ["simulate", design, "--scenario", "high-10", "--tolerance", "1e-4", "--csv", &csv];
        let out = run(&[&args[..], more].concat());
        assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stderr));
        column(&csv, "time_s")
    };
    // 24 a period, and the changes of mode.
    let times = history(&long, &[]);
    let even = times.iter().filter(|&&t| (t * 2400.0 - (t * 2400.0).round()).abs() < 1e-6).count();
    assert!(even >= 2401 && times.len() > even + 50, "{even} of {}", times.len());
    assert!(times.is_sorted() && times[times.len() - 1] == 1.0);
    assert_eq!(history(MULTI, &[]).len(), 1200, "a short scene");
    let times = history(&long, &["--samples", "50"]);
    assert_eq!((times.len(), times[0], times[49]), (50, 0.0, 1.0));
    let times = history(&long, &["--window", "0.9:1"]);
    assert_eq!((times.len(), times[0]), (1200, 0.9));
    for (window, said) in [("0.5:1.5", "end of the scene at 1 s"), ("0.2", "0.1:0.2"), ("0.3:0.2", "0.1:0.2")]
    {
        let out = run(&["simulate", &long, "--scenario", "high-10", "--window", window]);
        assert_eq!(out.status.code(), Some(2));
        assert!(String::from_utf8_lossy(&out.stderr).contains(said), "{window}");
    }
    let out = run(&["simulate", MULTI, "--scenario", "high-10", "--method", "published", "--max-steps", "9"]);
    assert_eq!(out.status.code(), Some(2));
}

#[test]
fn the_pressure_of_the_history_is_that_of_the_answer() {
    let folder = Folder::new();
    let csv = folder.path("history.csv");
    let answer = json(&run(&["simulate", MULTI, "--scenario", "low-10", "--csv", &csv, "--json"]));
    let design = Design::read(std::path::Path::new(MULTI)).unwrap();
    let curve = prepare(design.scenario("low-10").unwrap()).unwrap().model.curve;
    let [n_bi, inner, outer] =
        ["normal_inner_n", "hertz_inner_mpa", "hertz_outer_mpa"].map(|key| column(&csv, key));
    let mut beside = 0;
    for (n, mpa) in n_bi.iter().zip(&inner) {
        let point = curve.at_normal(*n).unwrap();
        let off = 1e6 * mpa / point.hertz_inner_pa - 1.0;
        assert!(off.abs() < 1e-7, "{n} N: {mpa} MPa, off by {off:e}");
        beside += usize::from((point.hertz_inner_pointwise_pa / point.hertz_inner_pa - 1.0).abs() > 1e-3);
    }
    assert!(beside > 20, "rows near a junction, where the radius at one point says something else: {beside}");
    let largest = inner.iter().chain(&outer).copied().fold(0.0, f64::max);
    let ratio = largest / answer["hertz_peak_mpa"].as_f64().unwrap();
    assert!((0.999..1.0 + 1e-8).contains(&ratio), "{ratio}");
}

#[cfg(unix)]
#[test]
fn ctrl_c_stops_a_long_scene_and_writes_what_is_known() {
    use std::process::{Command, Stdio};
    let folder = Folder::new();
    // Far longer than the time until the signal.
    let long = folder.changed(MULTI, &[("duration_s = 0.3", "duration_s = 20000.0")]);
    let csv = folder.path("history.csv");
    let child = Command::new(env!("CARGO_BIN_EXE_sprag-design"))
        .args(["simulate", &long, "--scenario", "high-10", "--full", "--json", "--csv", &csv])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(std::time::Duration::from_secs(4));
    Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    let out = child.wait_with_output().unwrap();
    assert_eq!(out.status.code(), Some(130), "{}", String::from_utf8_lossy(&out.stderr));
    let answer: serde_json::Value = serde_json::from_str(&stdout(&out)).unwrap();
    assert_eq!(answer["stop"], "interrupted");
    assert!(answer["reason"].as_str().unwrap().contains("stopped by Ctrl-C at "), "{}", answer["reason"]);
    let reached = answer["t_end_s"].as_f64().unwrap();
    let times = column(&csv, "time_s");
    assert!(times.len() > 10 && times[times.len() - 1] <= reached, "{} rows to {reached}", times.len());
}
