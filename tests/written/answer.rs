//! Answers as a library user gets them: what the command prints, without the command.

use serde_json::Value;
use sprag_design::answer::check::NoCheck;
use sprag_design::answer::simulation::{Integration, NoAnswer, Setting, SimulationSettings, Values};
use sprag_design::answer::{Answer, Provenance, search, stiffness};
use sprag_design::{Design, Follow, NoSearch, cli};
use std::path::Path;
use std::process::Command;

const BENCH: &str = "designs/huang2017-bench.toml";

fn bench() -> Design {
    Design::read(Path::new(BENCH)).unwrap_or_else(|e| panic!("{e}"))
}

/// An equilibrium, a motion with its history: JSON and CSV of the command are those of the library's answer.
#[test]
fn the_command_says_what_the_library_answers() {
    for (scene, rows) in [("overrun", 1), ("step-up", 40)] {
        let ask = SimulationSettings { rows: Some(40), ..SimulationSettings::default() };
        let answer = bench().simulate(scene, &ask).unwrap_or_else(|e| panic!("{e}"));
        let csv = std::env::temp_dir().join(format!("sprag-answer-{scene}-{}.csv", std::process::id()));
        let output = Command::new(env!("CARGO_BIN_EXE_sprag-design"))
            .args(["simulate", BENCH, "--scenario", scene, "--samples", "40", "--json", "--csv"])
            .arg(&csv)
            .output()
            .expect("command");
        let mut printed: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        let common = ["tool", "version", "design", "design_hash", "run_time_s", "left_out", "error_estimate"];
        let left_out = serde_json::to_value(&answer.left_out).expect("JSON");
        assert_eq!(printed["left_out"], left_out, "{scene}");
        let object = printed.as_object_mut().expect("object");
        common.iter().for_each(|key| drop(object.remove(*key)));
        assert_eq!(printed, serde_json::to_value(&answer).expect("JSON"), "{scene}");

        let history = answer.history();
        let text = std::fs::read_to_string(&csv).expect("CSV");
        std::fs::remove_file(&csv).expect("CSV");
        let names: Vec<&str> = history.columns.iter().map(|(name, _)| name.as_ref()).collect();
        assert_eq!(text.lines().next(), Some(names.join(",").as_str()), "{scene}");
        assert_eq!(text.lines().count(), rows + 1, "{scene}");
        let last: Vec<&str> = text.lines().last().expect("row").split(',').collect();
        for ((name, values), cell) in history.columns.iter().zip(last) {
            assert_eq!(values.len(), rows, "{name}");
            match values {
                Values::Numbers(v) if v[rows - 1].is_nan() => assert_eq!(cell, "", "{name}"),
                Values::Numbers(v) => assert_eq!(cell.parse(), Ok(v[rows - 1]), "{name}"),
                Values::Words(v) => assert_eq!(cell, v[rows - 1], "{name}"),
                Values::Counts(v) => {
                    assert_eq!(cell, v[rows - 1].map_or(String::new(), |n| n.to_string()), "{name}")
                }
            }
        }
    }
}

/// Text without what a run does not repeat.
fn without_run_time(page: &str) -> String {
    let parts = page.split("run_time_s").enumerate();
    parts
        .map(|(i, part)| if i == 0 { part } else { part.split_once(',').map_or(part, |(_, rest)| rest) })
        .collect()
}

/// The page of a check, byte for byte but for the time that it took.
#[test]
fn the_page_of_the_library_is_that_of_the_command() {
    let file = std::env::temp_dir().join(format!("sprag-answer-{}.html", std::process::id()));
    let output = Command::new(env!("CARGO_BIN_EXE_sprag-design"))
        .args(["check", BENCH, "--quiet", "--report"])
        .arg(&file)
        .output()
        .expect("command");
    assert!(output.status.code().is_some_and(|code| code < 2), "{output:?}");
    let printed = std::fs::read_to_string(&file).expect("page");
    std::fs::remove_file(&file).expect("page");
    let command = format!("sprag-design check {BENCH} --report {}", file.display());
    let answer = bench().check(&Follow::nobody()).unwrap_or_else(|e| panic!("{e}"));
    let page = answer.page(&Provenance { command, run_time_s: 0.25 }).to_html();
    assert!(page.contains(&answer.body.verdict()) && page.contains("0.25"));
    assert!(without_run_time(&page) == without_run_time(&printed), "the pages differ");
}

#[test]
fn what_makes_no_sense_is_refused_before_anything_runs() {
    let refused = |ask: &SimulationSettings| match bench().simulate("step-up", ask) {
        Err(NoAnswer::Refused(refused)) => refused.setting,
        other => panic!("{:?}", other.map(|_| ())),
    };
    let published = Integration::Published { band_m_s: None };
    for (ask, setting) in [
        (SimulationSettings { tolerance: Some(0.1), ..SimulationSettings::default() }, Setting::Tolerance),
        (SimulationSettings { step_s: Some(f64::NAN), ..SimulationSettings::default() }, Setting::Step),
        (
            SimulationSettings { step_s: Some(1e3), method: published, ..SimulationSettings::default() },
            Setting::Step,
        ),
        (SimulationSettings { window_s: Some([0.0, 1e3]), ..SimulationSettings::default() }, Setting::Window),
        (SimulationSettings { window_s: Some([0.2, 0.1]), ..SimulationSettings::default() }, Setting::Window),
    ] {
        assert_eq!(refused(&ask), setting, "{ask:?}");
    }
    let error =
        bench().simulate("step-out", &SimulationSettings::default()).map(|_| ()).expect_err("accepted");
    assert!(error.to_string().contains("no scenario step-out; the design has: engagement"), "{error}");
}

/// What the command prints, without the keys that all commands share; of these `left_out` and `error_estimate` apart.
fn printed(args: &[&str]) -> (Value, Value, Value) {
    let output =
        Command::new(env!("CARGO_BIN_EXE_sprag-design")).args(args).arg("--json").output().expect("command");
    let mut printed: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let object = printed.as_object_mut().expect("object");
    let [left_out, error] = ["left_out", "error_estimate"].map(|key| object.remove(key).expect("key"));
    ["tool", "version", "design", "design_hash", "run_time_s"]
        .iter()
        .for_each(|key| drop(object.remove(*key)));
    (printed, left_out, error)
}

#[test]
fn check_and_stiffness_say_what_the_library_answers() {
    let json = |value: &dyn Fn() -> serde_json::Result<Value>| value().expect("JSON");
    let check = bench().check(&Follow::nobody()).unwrap_or_else(|e| panic!("{e}"));
    let (body, left_out, error) = printed(&["check", BENCH]);
    assert_eq!(body, json(&|| serde_json::to_value(&check)));
    assert_eq!(left_out, json(&|| serde_json::to_value(&check.left_out)));
    assert_eq!(error, json(&|| serde_json::to_value(check.errors)));

    let ask = stiffness::StiffnessSettings {
        torques_nm: vec![3.0, 1e6],
        ..stiffness::StiffnessSettings::default()
    };
    let curves = bench().stiffness(&ask).unwrap_or_else(|e| panic!("{e}"));
    let (body, left_out, error) = printed(&["stiffness", BENCH, "--torques", "3,1e6"]);
    assert_eq!(body, json(&|| serde_json::to_value(&curves)));
    assert_eq!(body["beyond_end"][0], 1e6);
    assert_eq!(left_out, json(&|| serde_json::to_value(&curves.left_out)));
    assert_eq!(error, curves.error_relative);
}

#[test]
fn what_is_stopped_before_it_begins_has_no_answer() {
    let follow = Follow::new();
    follow.stop();
    assert_eq!(bench().check(&follow).err(), Some(NoCheck::Stopped));
    let ask =
        stiffness::StiffnessSettings { follow: follow.clone(), ..stiffness::StiffnessSettings::default() };
    assert_eq!(bench().stiffness(&ask).err(), Some(stiffness::NoStiffness::Stopped));
    let multi_arc =
        Design::read(Path::new("designs/huang2017-multi-arc.toml")).unwrap_or_else(|e| panic!("{e}"));
    let ask = search::SearchSettings { follow, ..search::SearchSettings::default() };
    assert_eq!(multi_arc.optimise(&ask).err(), Some(NoSearch::Stopped));
    assert_eq!(bench().optimise(&search::SearchSettings::default()).err(), Some(NoSearch::NoTask));
}

/// A program that carries this one runs it as often as it likes, and stays.
#[test]
fn the_command_runs_from_given_arguments() {
    assert_eq!(
        [cli::run_from(["sprag-design", "schema"]), cli::run_from(["x", "check", "nowhere.toml", "-q"])],
        [0, 2]
    );
    assert_eq!(cli::run_from(["sprag-design", "--nonsense"]), 2);
}

#[test]
fn a_design_is_set_from_values_wherever_it_lies() {
    let set = |key: &str, value: &str| bench().with(&[(key.to_owned(), value.to_owned())], "here.toml");
    let other = set("friction.static", "0.11").unwrap_or_else(|e| panic!("{e}"));
    assert_eq!((other.clutch.friction.static_, other.histories), (0.11, bench().histories));
    let why = set("friction.statik", "0.11").expect_err("no such key");
    assert_eq!((why.file(), why.problems()[0].key.as_str()), ("here.toml", "friction.statik"));
    // The file does not hold what is quoted.
    let why = set("sprags.count", "-3").expect_err("no count");
    assert_eq!(why.file(), "here.toml");
    assert!(why.to_string().starts_with("here.toml with sprags.count=-3:"), "{why}");
}
