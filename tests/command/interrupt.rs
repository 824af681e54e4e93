//! Ctrl-C from outside: what was found is told and written, nothing claims an end that was not reached; and `evaluate`
//! as other programs drive it.
#![cfg(unix)]

use crate::program::*;
use std::io::{BufRead, BufReader, Write};
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

fn started(args: &[&str]) -> Child {
    let mut tool = Command::new(env!("CARGO_BIN_EXE_sprag-design"));
    tool.args(args).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

fn ctrl_c(child: &Child) {
    Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
}

/// Waits until `ready`, for as long as a slow machine may need.
fn wait_until(what: &str, mut ready: impl FnMut() -> bool) {
    for _ in 0..12_000 {
        if ready() {
            return;
        }
        std::thread::sleep(Duration::from_millis(50));
    }
    panic!("{what}");
}

fn ended(mut child: Child) -> Output {
    let mut over = false;
    for _ in 0..2_400 {
        over = child.try_wait().unwrap().is_some();
        if over {
            break;
        }
        std::thread::sleep(Duration::from_millis(50));
    }
    if !over {
        child.kill().unwrap();
        panic!("it goes on: {:?}", child.wait_with_output());
    }
    child.wait_with_output().unwrap()
}

/// Least objective and x of the best whole row of a journal that holds every limit.
fn best_row(journal: &str) -> Option<(f64, Vec<f64>)> {
    let numbers = |cell: &str| cell.split(';').map(|v| v.parse().unwrap()).collect::<Vec<f64>>();
    let rows = std::fs::read_to_string(journal).unwrap_or_default();
    let held = rows.lines().filter_map(|line| {
        let cells: Vec<&str> = line.split(',').collect();
        let good = cells.len() == 13 && cells[6] == "ok" && numbers(cells[8]).iter().all(|v| *v >= 0.0);
        good.then(|| (numbers(cells[7]).into_iter().fold(f64::INFINITY, f64::min), numbers(cells[5])))
    });
    held.max_by(|a, b| a.0.total_cmp(&b.0))
}

#[test]
fn a_swarm_that_is_stopped_writes_its_best_design() {
    let folder = Folder::new();
    let (new, journal) = (folder.path("new.toml"), folder.path("record.csv"));
    let child = started(&[
        "optimize",
        MULTI,
        "-o",
        &new,
        "--journal",
        &journal,
        "--global",
        "1000000",
        "--starts",
        "1",
        "--json",
    ]);
    wait_until("a design that holds every limit", || best_row(&journal).is_some());
    ctrl_c(&child);
    let out = ended(child);
    assert_eq!(out.status.code(), Some(130), "{}", String::from_utf8_lossy(&out.stderr));
    let told = json(&out);
    assert_eq!((&told["status"], &told["feasible"]), (&"interrupted".into(), &true.into()));
    assert!(!stdout(&out).contains("\"converged\""), "{told}");
    let (_, x) = best_row(&journal).unwrap();
    let values: Vec<f64> = ["r_i2_mm", "r_i3_mm", "centroid_x_mm", "centroid_y_mm"]
        .map(|name| told["best"]["variables"][name].as_f64().unwrap())
        .into();
    assert_eq!(values, x, "the best of all that was evaluated");
    assert_eq!(run(&["check", &new, "--quiet"]).status.code(), Some(0));
}

#[test]
fn a_fit_that_is_stopped_tells_and_writes_the_best_so_far() {
    let folder = Folder::new();
    let (data, new) = (folder.path("data.csv"), folder.path("new.toml"));
    std::fs::write(&data, "torque_nm,windup_deg\n10,1.2345\n16.8,1.94\n50,5.1\n").unwrap();
    let endless = ["--starts", "1000", "--evaluations", "1000000"];
    let asked =
        ["identify", MULTI, "--data", &data, "--unknown", "r_i2_mm:3.6:4.6,r_i3_mm:3.6:4.8", "-o", &new];
    // Nothing from outside tells how far a fit has come.
    let mut found = None;
    for patience_s in [2, 5, 20, 60, 180] {
        let child = started(&[&asked[..], &endless].concat());
        std::thread::sleep(Duration::from_secs(patience_s));
        ctrl_c(&child);
        let out = ended(child);
        assert_eq!(out.status.code(), Some(130), "{}", String::from_utf8_lossy(&out.stderr));
        if !out.stdout.is_empty() {
            found = Some(stdout(&out));
            break;
        }
    }
    let said = found.expect("a design met");
    for words in ["stopped by Ctrl-C: the best of", "r_i2_mm = ", "r_i3_mm = ", "the search has not ended"] {
        assert!(said.contains(words), "{words}: {said}");
    }
    assert!(!said.contains("converged"), "{said}");
    let text = std::fs::read_to_string(&new).unwrap();
    assert!(text.contains("# stopped by Ctrl-C"), "{text}");
    assert_ne!(run(&["check", &new, "--quiet"]).status.code(), Some(2));
}

const X: &str = "[4.08, 4.15, 0.1935, 0.5288]\n";

#[test]
fn evaluate_hears_ctrl_c_while_it_waits_for_a_line() {
    let mut child = started(&["evaluate", MULTI, "--describe"]);
    let _open = child.stdin.take().unwrap();
    BufReader::new(child.stdout.as_mut().unwrap()).read_line(&mut String::new()).unwrap();
    ctrl_c(&child);
    assert_eq!(ended(child).status.code(), Some(130));
}

#[test]
fn evaluate_ends_when_its_reader_has_gone() {
    let mut child = started(&["evaluate", MULTI]);
    let mut lines = child.stdin.take().unwrap();
    // Far more than a pipe holds: what is never read cannot be written.
    let writer = std::thread::spawn(move || lines.write_all(X.repeat(100_000).as_bytes()));
    let mut answers = BufReader::new(child.stdout.take().unwrap());
    answers.read_line(&mut String::new()).unwrap();
    drop(answers);
    let out = ended(child);
    assert_eq!(out.status.code(), Some(141), "{}", String::from_utf8_lossy(&out.stderr));
    assert!(out.stderr.is_empty(), "{}", String::from_utf8_lossy(&out.stderr));
    assert!(writer.join().unwrap().is_err());
}

#[test]
fn evaluate_answers_each_line_at_once_and_the_same_for_any_number_of_threads() {
    let points: String = (0..6).map(|i| format!("[4.08, 4.15, 0.1935, 0.{}]\n{}", 52 + i, "[1]\n")).collect();
    let answers = |threads: &str| {
        let mut child = started(&["evaluate", MULTI, "--threads", threads]);
        let mut lines = child.stdin.take().unwrap();
        lines.write_all(X.as_bytes()).unwrap();
        // The input stays open: the answer does not wait for more lines.
        let mut out = BufReader::new(child.stdout.take().unwrap());
        let mut told = String::new();
        out.read_line(&mut told).unwrap();
        assert!(told.contains("\"least\""), "{told}");
        lines.write_all(points.as_bytes()).unwrap();
        drop(lines);
        std::io::Read::read_to_string(&mut out, &mut told).unwrap();
        assert_eq!(child.wait().unwrap().code(), Some(2));
        told
    };
    let one = answers("1");
    assert_eq!(one.lines().count(), 13);
    assert!(
        one.lines().skip(1).step_by(2).enumerate().all(|(i, l)| l.contains(&format!("0.{}", 52 + i))),
        "{one}"
    );
    assert_eq!(one, answers("3"));
}

/// Sprags that may be as much as 0.6 mm too small in their inner arcs leave corners at which nothing holds.
#[test]
fn no_robust_design_is_exit_code_1() {
    let folder = Folder::new();
    let design = folder.changed(
        MULTI,
        &[
            (r#"["high-6", "low-10", "rated-45", "rated-45-at-speed"]"#, r#"["rated-45"]"#),
            ("[optimize]", "[tolerances]\nsprag_inner_radius_mm = 0.6\n\n[optimize]"),
        ],
    );
    let new = folder.path("new.toml");
    let args = [
        "optimize",
        &design,
        "-o",
        &new,
        "--starts",
        "1",
        "--evaluations",
        "60",
        "--robust",
        "--draws",
        "10",
    ];
    let out = run(&args);
    let said = stdout(&out);
    assert!(said.contains("every limit held"), "the optimum itself is one: {said}");
    assert!(said.lines().next().unwrap().contains("no "), "{said}");
    assert_eq!(out.status.code(), Some(1), "{said}{}", String::from_utf8_lossy(&out.stderr));
}

#[test]
fn the_table_of_what_was_stopped_says_so() {
    let folder = Folder::new();
    let csv = folder.path("sprags.csv");
    let long = ["--scenario", "high-8", "--set", "scenarios[1].duration_s=300", "--csv", &csv];
    let child = started(&[&["sharing", "designs/unlike-sprags.toml"], &long[..]].concat());
    std::thread::sleep(Duration::from_secs(2));
    ctrl_c(&child);
    assert_eq!(ended(child).status.code(), Some(130));
    let table = std::fs::read_to_string(csv).unwrap();
    assert!(table.lines().next().unwrap().ends_with(",partial"), "{table}");
    assert!(table.lines().skip(1).all(|row| row.contains("stopped by Ctrl-C at ")), "{table}");
}

#[test]
fn a_check_of_a_long_scene_is_stopped_within_the_scene() {
    let folder = Folder::new();
    // Five minutes of a starter in which nothing repeats, which nobody waits for here.
    let drive = concat!(env!("CARGO_MANIFEST_DIR"), "/designs/starter-engine.toml");
    let long = folder.changed(drive, &[("duration_s = 0.12\n", "duration_s = 300.0\n")]);
    let child = started(&["check", &long]);
    std::thread::sleep(Duration::from_secs(2));
    ctrl_c(&child);
    // Where the runs themselves do not hear it, it goes on for longer than `ended` waits.
    assert_eq!(ended(child).status.code(), Some(130));
}
