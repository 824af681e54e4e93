//! The program from outside: exit codes, what goes to which stream, broken pipes.

use std::io::Read;
use std::process::{Command, Output, Stdio};

fn program() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_sprag-design"));
    command.env("NO_COLOR", "1");
    command
}

fn run(args: &[&str]) -> Output {
    program().args(args).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

#[test]
fn help_and_version_answer_on_standard_output() {
    for args in [&["--help"][..], &["--version"], &["check", "--help"], &["completions", "bash"]] {
        let output = run(args);
        assert_eq!(output.status.code(), Some(0), "{args:?}");
        assert!(output.stdout.len() > 5 && output.stderr.is_empty(), "{args:?}");
    }
    assert!(text(&run(&["--version"]).stdout).contains(env!("CARGO_PKG_VERSION")));
}

#[test]
fn misuse_is_code_2_with_nothing_on_standard_output() {
    for args in [
        &[][..],
        &["frob"],
        &["check"],
        &["check", "Cargo.toml", "--frob"],
        &["check", "Cargo.toml", "--threads", "many"],
        &["check", "Cargo.toml", "--csv", "no-such-folder/a.csv"],
    ] {
        let output = run(args);
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        assert!(output.stdout.is_empty() && !output.stderr.is_empty(), "{args:?}");
        assert!(!text(&output.stderr).contains('\u{1b}'), "NO_COLOR, {args:?}");
    }
}

/// What is refused once the arguments are read is one JSON object for whoever asked for one.
#[test]
fn with_json_a_refused_argument_is_the_same_error_object_as_a_refused_design() {
    const MULTI: &str = "designs/huang2017-multi-arc.toml";
    const BARE: &str = "designs/huang2017-bench.toml";
    let scene = ["simulate", MULTI, "--scenario", "high-6"];
    for (args, word) in [
        (&["check", "Cargo.toml", "--csv", "no-such-folder/a.csv"][..], "no-such-folder"),
        (&["check", "no-such.toml"], "no such file"),
        (&["simulate", MULTI], "--scenario"),
        (&["check", MULTI, "--frob"], "--frob"),
        (&["check", MULTI, "--threads", "many"], "--threads"),
        (&["new"], "--for PURPOSE"),
        (&["optimize", BARE, "-o", "never.toml"], "no [optimize] table"),
        (&["optimize", MULTI, "-o", MULTI], "never overwritten"),
        (&["optimize", MULTI, "-o", "never.toml", "--journal", "Cargo.toml"], "Cargo.toml"),
        (&["optimize", MULTI, "-o", "never.toml", "--pareto", "windup"], "two or three"),
        (&["simulate", MULTI, "--scenario", "none"], "no scenario none"),
        (&[&scene[..], &["--window", "5:6"]].concat(), "--window"),
        (&["identify", MULTI, "--data", "no-such.csv", "--unknown", "r_i1_mm:3:4"], "no-such.csv"),
        (&["export", MULTI, "--format", "calculix", "-o", MULTI], "never overwritten"),
    ] {
        let output = run(&[args, &["--json"]].concat());
        assert_eq!(output.status.code(), Some(2), "{args:?}: {}", text(&output.stderr));
        let out = text(&output.stdout);
        let answer: serde_json::Value =
            serde_json::from_str(&out).unwrap_or_else(|e| panic!("{args:?}: {e}: {out}"));
        assert!(answer["tool"] == "sprag-design" && answer["version"].is_string(), "{args:?}: {out}");
        let message = answer["error"]["message"].as_str().unwrap_or_default();
        assert!(message.contains(word), "{args:?}: {out}");
        assert!(!output.stderr.is_empty(), "{args:?}: standard error says it in words");
    }
}

#[test]
fn the_design_file_is_never_an_output() {
    let before = std::fs::read("Cargo.toml").unwrap();
    for flag in [
        &["check", "Cargo.toml", "--report", "./Cargo.toml"][..],
        &["optimize", "Cargo.toml", "-o", "Cargo.toml"],
    ] {
        let output = run(flag);
        assert_eq!(output.status.code(), Some(2));
        assert!(text(&output.stderr).contains("never overwritten"));
    }
    assert_eq!(std::fs::read("Cargo.toml").unwrap(), before);
}

/// Nor is any other design, or a history that the design names, the place of a table or page.
#[test]
fn what_a_slip_of_the_hand_would_destroy_is_refused() {
    const BENCH: &str = "designs/huang2017-bench.toml";
    let simulate = ["simulate", BENCH, "--scenario", "in-and-out"];
    for (flags, target, word) in [
        (&["--csv"][..], "designs/huang2017-multi-arc.toml", "is a design file already"),
        (&["--report"], "designs/huang2017-multi-arc.toml", "is a design file already"),
        (&["--csv"], "designs/engaging-in-and-out.csv", "is read by this command"),
        (&["--report"], "designs/speed-ramp.csv", "is a table already"),
    ] {
        let before = std::fs::read(target).unwrap();
        let output = run(&[&simulate, flags, &[target]].concat());
        assert_eq!(output.status.code(), Some(2), "{target}");
        let said = text(&output.stderr);
        assert!(said.contains(word) && output.stdout.is_empty(), "{target}: {said}");
        assert_eq!(std::fs::read(target).unwrap(), before);
    }
}

#[test]
fn a_negative_number_is_a_value_and_refused_as_one() {
    const DESIGN: &str = "designs/huang2017-multi-arc.toml";
    for (args, word) in [
        (&["stiffness", DESIGN, "--torques", "-5"][..], "above zero"),
        (&["stiffness", DESIGN, "--torques", "3,-5"], "above zero"),
        (&["stiffness", DESIGN, "--torques", "-5,3"], "above zero"),
        (&["stiffness", DESIGN, "--max-torque", "-4"], "above zero"),
        (&["simulate", DESIGN, "--scenario", "high-6", "--step", "-1"], "above zero"),
        (&["simulate", DESIGN, "--scenario", "high-6", "--tolerance", "-1e-6"], "above zero"),
        (&["optimize", DESIGN, "--evaluations", "-3"], "1..=1000000"),
        (&["accuracy", DESIGN, "--cases", "-1"], "0..=100000"),
        (&["size", "--bore", "-40", "--torque", "10", "-o", "never.toml"], "1 to 2000 mm"),
        (&["check", DESIGN, "--threads", "-1"], "1..=1024"),
    ] {
        let output = run(args);
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        assert!(said.contains(word) && !said.contains("unexpected argument"), "{args:?}: {said}");
    }
}

#[test]
fn an_option_is_no_value_of_the_option_before_it() {
    const DESIGN: &str = "designs/huang2017-multi-arc.toml";
    for (args, flag) in [
        (&["simulate", DESIGN, "--scenario", "high-6", "--step", "--json"][..], "--step"),
        (&["simulate", DESIGN, "--scenario", "high-6", "--tolerance", "-q"], "--tolerance"),
        (&["stiffness", DESIGN, "--torques", "--json"], "--torques"),
        (&["size", "--bore", "--torque", "10", "-o", "never.toml"], "--bore"),
        (&["optimize", DESIGN, "--tolerance", "--resume"], "--tolerance"),
        (&["--quiet", "simulate", DESIGN, "--step", "--report=a.html", "--scenario", "high-6"], "--step"),
    ] {
        let output = run(args);
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        // As JSON too for whoever asked for it.
        assert_eq!(output.stdout.is_empty(), !args.contains(&"--json"), "{args:?}");
        assert!(said.contains(&format!("a value is required for '{flag} <")), "{args:?}: {said}");
    }
}

#[test]
fn options_without_meaning_are_refused_in_a_sentence() {
    const DESIGN: &str = "designs/huang2017-multi-arc.toml";
    for args in [
        &["schema", "--csv", "a.csv"][..],
        &["schema", "--report", "a.html"],
        &["materials", "--report", "a.html"],
        &["completions", "bash", "--json"],
        &["evaluate", DESIGN, "--json"],
        &["evaluate", DESIGN, "--report", "a.html"],
    ] {
        let output = run(args);
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        assert!(text(&output.stderr).contains("has no meaning with"), "{args:?}");
        // Who asks for JSON reads of the refusal there, as of any other.
        let said = text(&output.stdout);
        assert_eq!(said.contains("has no meaning with"), args.contains(&"--json"), "{args:?}: {said}");
    }
    assert_eq!(run(&["schema", "--json"]).status.code(), Some(0));
    assert_eq!(run(&["materials", "--json"]).status.code(), Some(0));
}

#[test]
fn a_reader_that_leaves_is_no_failure() {
    let mut child = program()
        .args(["completions", "bash"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let mut stderr = String::new();
    child.stderr.take().unwrap().read_to_string(&mut stderr).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(0), "{stderr}");
    assert!(stderr.is_empty(), "{stderr}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_a_failure_in_words() {
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let output = program().args(["completions", "bash"]).stdout(full).output().unwrap();
    assert_eq!(output.status.code(), Some(3));
    let stderr = text(&output.stderr);
    assert!(stderr.contains("standard output") && !stderr.contains("panicked"), "{stderr}");
}

#[test]
#[cfg(target_os = "linux")]
fn a_folder_that_takes_no_file_is_refused_before_the_work() {
    let design = "designs/starter.toml";
    for args in [
        &["check", design, "--csv", "/proc/a.csv"][..],
        &["check", design, "--report", "/proc/a.html"],
        &["export", design, "--format", "dxf", "-o", "/proc/a.dxf"],
        &["optimize", "designs/huang2017-multi-arc.toml", "-o", "/proc/a.toml"],
        &["life", "designs/indexing-life.toml", "--csv", "/proc/a.csv"],
    ] {
        let output = run(args);
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        assert!(
            output.stdout.is_empty() && text(&output.stderr).contains("cannot be written: /proc"),
            "{args:?}"
        );
    }
    assert!(
        !std::path::Path::new("designs").read_dir().unwrap().any(|e| e.unwrap().path().ends_with(".tmp"))
    );
}
