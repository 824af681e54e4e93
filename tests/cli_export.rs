//! `export` from outside: what it writes, what it refuses, what it reads back.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const SINGLE: &str = "designs/huang2017-single-arc.toml";

fn run(args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_sprag-design")).env("NO_COLOR", "1").args(args).output().unwrap()
}

fn code(args: &[&str]) -> (Option<i32>, String) {
    let output = run(args);
    // Messages are wrapped to the terminal.
    let text = String::from_utf8(output.stderr).unwrap().replace('│', " ");
    (output.status.code(), text.split_whitespace().collect::<Vec<_>>().join(" "))
}

fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(&path).unwrap();
    path
}

#[test]
fn other_formats_and_senseless_flags_are_refused_with_code_2() {
    for format in ["dxf", "svg", "step", "csv", "fmu"] {
        let (code, text) = code(&["export", SINGLE, "--format", format]);
        assert_eq!(code, Some(2));
        assert!(text.contains(format) && text.contains("calculix"), "{text}");
    }
    for (flags, word) in [
        (&["--torque", "1e6"][..], "wedge curve"),
        (&["--mesh", "1e-6"], "nodes"),
        (&["--mesh", "5"], "too near"),
        (&["--increments", "0"], "increments"),
        (&["--json"], "--read"),
        (&["--torques", "3"], "--read"),
        (&["--read", "no-such.dat"], "no-such.dat: the result"),
        (&["-o", SINGLE], "never overwritten"),
    ] {
        let (code, text) = code(&[&["export", SINGLE, "--format", "calculix"], flags].concat());
        assert_eq!(code, Some(2), "{flags:?}");
        assert!(text.contains(word), "{flags:?}: {text}");
    }
}

#[test]
fn a_result_is_read_beside_its_deck_and_no_other() {
    let folder = folder("export-read");
    let (deck, dat) = (folder.join("s.inp"), folder.join("s.dat"));
    let (deck_arg, dat_arg) = (deck.to_str().unwrap(), dat.to_str().unwrap());
    let made = run(&[
        "export",
        SINGLE,
        "--format",
        "calculix",
        "--variant",
        "plane-strain",
        "--torque",
        "26.8",
        "-o",
        deck_arg,
    ]);
    assert_eq!(made.status.code(), Some(0));
    // Three increments of that very deck's result.
    std::fs::copy("tests/reference/calculix_excerpt.dat", &dat).unwrap();
    let read =
        run(&["export", SINGLE, "--format", "calculix", "--read", dat_arg, "--torques", "16.8,50", "--json"]);
    assert_eq!(read.status.code(), Some(0));
    assert!(String::from_utf8(read.stderr).unwrap().contains("50 Nm lies outside"));
    let json: serde_json::Value = serde_json::from_slice(&read.stdout).unwrap();
    let points = json["points"].as_array().unwrap();
    assert_eq!(points.len(), 1);
    assert!((points[0]["windup_deg"].as_f64().unwrap() / 1.6407 - 1.0).abs() < 3e-3, "{json}");
    assert_eq!(json["variant"], "plane-strain");

    let (code, text) =
        code(&["export", "designs/huang2017-multi-arc.toml", "--format", "calculix", "--read", dat_arg]);
    assert_eq!(code, Some(2));
    assert!(text.contains("another design"), "{text}");
}
