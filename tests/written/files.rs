//! Files that the program reads and writes: what is somebody else's stays, what has no end is not read, what cannot be
//! written costs no answer, and nothing that a file or an argument says reaches the terminal as more than text.

use crate::program::{Folder, MULTI, json, run, stdout};

fn said(output: &std::process::Output) -> String {
    // Messages are folded to the width of the terminal.
    let text = String::from_utf8(output.stderr.clone()).unwrap();
    text.lines().map(|l| l.trim_start_matches([' ', '│', '×'])).collect::<Vec<_>>().join(" ")
}

const SIZE: [&str; 7] = ["size", "--bore", "40", "--torque", "100", "--quiet", "-o"];

/// The paper's clutch with one more scenario, under the history `name`.
fn with_history(folder: &Folder, name: &str) -> String {
    let scene = format!(
        "\n[[scenarios]]\nname = \"pull\"\nkind = \"transient\"\nabutment_stiffness_nm_per_rad = 1e3\n\
         duration_s = 0.1\ntorque_history_csv = {name:?}\n"
    );
    let path = folder.path("with-history.toml");
    std::fs::write(&path, std::fs::read_to_string(MULTI).unwrap() + &scene).unwrap();
    path
}

#[test]
fn a_file_that_somebody_else_made_is_replaced_only_with_force() {
    let folder = Folder::new();
    let export = ["export", MULTI, "--format", "calculix", "--mesh", "0.2", "--quiet", "-o"];
    for (command, name, theirs) in [
        (&SIZE[..], "mine.toml", "schema = 1\n"),
        (&export, "mine.inp", "*NODE\n1,0,0,0\n"),
        (&["optimize", MULTI, "--starts", "1", "--evaluations", "1", "-o"], "hand.toml", "# by hand\n"),
        (&["stiffness", MULTI, "--report"], "mine.html", "<!DOCTYPE html>\n"),
        (&["stiffness", MULTI, "--csv"], "mine.csv", "Time [s];Torque [Nm]\n"),
        (&["stiffness", MULTI, "--csv"], "history.csv", "time_s,torque_nm\n0,1\n1,2\n"),
    ] {
        let path = folder.path(name);
        std::fs::write(&path, theirs).unwrap();
        let output = run(&[command, &[&path]].concat());
        assert_eq!(output.status.code(), Some(2), "{name}");
        assert!(said(&output).contains("--force") && output.stdout.is_empty(), "{name}: {}", said(&output));
        assert_eq!(std::fs::read_to_string(&path).unwrap(), theirs, "{name}");
    }
    for (command, name) in [(&SIZE[..], "mine.toml"), (&export, "mine.inp")] {
        let path = folder.path(name);
        let output = run(&[command, &[&path, "--force"]].concat());
        assert_eq!(output.status.code(), Some(0), "{}", said(&output));
        // What the tool has made itself gives way without a word, but for a design: somebody may have edited it since.
        let again = run(&[command, &[&path]].concat());
        assert_eq!(again.status.code(), Some(if name == "mine.toml" { 2 } else { 0 }), "{name}");
    }
    let (csv, page) = (folder.path("new.csv"), folder.path("new.html"));
    for _ in 0..2 {
        let output = run(&["stiffness", MULTI, "--csv", &csv, "--report", &page]);
        assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    }
}

#[test]
fn a_name_that_says_another_kind_of_file_is_refused() {
    for (flag, name, ending) in [
        ("--report", "never.pdf", ".html"),
        ("--report", "never", ".html"),
        ("--csv", "never.json", ".csv"),
        ("--csv", "never.html", ".csv"),
    ] {
        let output = run(&["stiffness", MULTI, flag, name]);
        assert_eq!(output.status.code(), Some(2), "{name}");
        assert!(said(&output).contains(ending) && !std::path::Path::new(name).exists(), "{}", said(&output));
    }
    let output = run(&[&SIZE[..], &["never.pdf"]].concat());
    assert!(output.status.code() == Some(2) && said(&output).contains(".toml"), "{}", said(&output));
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_costs_no_answer() {
    for flag in ["--csv", "--report"] {
        let output = run(&["stiffness", MULTI, "--json", flag, "/dev/full"]);
        assert_eq!(output.status.code(), Some(3), "{flag}");
        let answer = json(&output);
        assert!(answer["unwritten"][0].as_str().unwrap().contains("/dev/full"), "{flag}");
        assert!(answer["laws"].is_array() || answer["design_hash"].is_string());
        assert!(said(&output).contains("cannot write /dev/full"), "{}", said(&output));
    }
    let output = run(&[&SIZE[..], &["/dev/full", "--json"]].concat());
    let answer = json(&output);
    assert_eq!(output.status.code(), Some(3));
    assert!(answer["sized"] == true && answer["written"].is_null() && answer["unwritten"][0].is_string());
    // Without --json the text comes all the same.
    let output = run(&["stiffness", MULTI, "--csv", "/dev/full"]);
    assert!(output.status.code() == Some(3) && stdout(&output).contains("Windup"), "{}", stdout(&output));
}

#[test]
fn a_failure_is_one_json_object_too() {
    let output = run(&["check", "no-such.toml", "--json"]);
    let answer = json(&output);
    assert_eq!((&answer["tool"], answer["version"].is_string()), (&"sprag-design".into(), true));
    let error = &answer["error"];
    assert_eq!(error["file"], "no-such.toml");
    assert!(error["message"].is_string() && error["problems"][0]["found"] == "no such file", "{error}");
}

/// The design that `optimize` writes holds the command line as a comment.
#[test]
fn a_line_break_in_an_argument_leaves_the_written_design_readable() {
    let folder = Folder::new();
    let source = folder.path("a\nb.toml");
    std::fs::copy("designs/huang2017-single-arc.toml", &source).unwrap();
    let data = folder.path("data.csv");
    std::fs::write(&data, "torque_nm,windup_deg\n3.34,0.59\n10,1.28\n16.8,1.9\n").unwrap();
    let new = folder.path("new.toml");
    let output = run(&[
        "identify",
        &source,
        "--data",
        &data,
        "--unknown",
        "r_i1_mm:3.9:4.2",
        "--starts",
        "1",
        "--evaluations",
        "30",
        "-o",
        &new,
    ]);
    let text = std::fs::read_to_string(&new).unwrap_or_else(|_| panic!("{}", said(&output)));
    assert!(text.lines().take_while(|l| !l.starts_with("# Why")).all(|l| l.starts_with('#')), "{text}");
    assert!(text.contains(r"a\nb.toml'"), "{text}");
    assert_eq!(run(&["stiffness", &new]).status.code(), Some(0));
}

#[cfg(unix)]
#[test]
fn what_has_no_end_is_not_read() {
    let folder = Folder::new();
    let pipe = folder.path("pipe");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let big = folder.path("big.toml");
    std::fs::write(&big, "#".repeat(1 << 21)).unwrap();
    let identify = |data| vec!["identify", MULTI, "--unknown", "r_i2_mm:3.9:4.4", "--data", data];
    for (args, word) in [
        (vec!["check", &pipe], "a pipe or a device"),
        (vec!["check", "/dev/zero"], "a pipe or a device"),
        (vec!["check", &big], "more than 1 MB"),
        (identify("/dev/zero"), "a pipe or a device"),
        (vec!["stiffness", MULTI, "--fem", &pipe], "a pipe or a device"),
        (vec!["export", MULTI, "--format", "calculix", "--read", "/dev/zero"], "a pipe or a device"),
    ] {
        let output = run(&args);
        assert_eq!(output.status.code(), Some(2), "{args:?}");
        assert!(said(&output).contains(word), "{args:?}: {}", said(&output));
    }
    std::os::unix::fs::symlink("/dev/zero", folder.path("zero.csv")).unwrap();
    let output = run(&["check", &with_history(&folder, "zero.csv")]);
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn a_path_that_is_no_design_is_told_in_clear_words() {
    let folder = Folder::new();
    let (empty, latin) = (folder.path("empty.toml"), folder.path("latin.toml"));
    std::fs::write(&empty, "").unwrap();
    std::fs::write(&latin, b"name = \"K\xfcnzel\"\n").unwrap();
    let here = folder.path("");
    for (file, word) in [(&here, "a directory"), (&empty, "an empty file"), (&latin, "not UTF-8 (byte 10")] {
        for command in [&["check"][..], &["stiffness"], &["optimize"], &["evaluate"], &["accuracy"]] {
            let output = run(&[command, &[file]].concat());
            assert_eq!(output.status.code(), Some(2), "{command:?} {file}");
            assert!(said(&output).contains(word), "{command:?} {file}: {}", said(&output));
        }
    }
    for data in [&here, &latin] {
        let output = run(&["identify", MULTI, "--unknown", "r_i2_mm:3.9:4.4", "--data", data]);
        assert!(output.status.code() == Some(2) && said(&output).contains(data.as_str()));
    }
}

#[cfg(unix)]
#[test]
fn a_history_lies_with_its_design_and_no_other_file_is_shown() {
    let folder = Folder::new();
    let secret = "root:x:0:0:root:/root:/bin/bash\n";
    let outside = Folder::new();
    std::fs::write(outside.path("secret"), secret).unwrap();
    std::fs::write(folder.path("inside"), secret).unwrap();
    std::fs::write(folder.path("below"), format!("time_s,torque_nm\n0,1\n{}", secret.repeat(30))).unwrap();
    std::os::unix::fs::symlink(outside.path("secret"), folder.path("link.csv")).unwrap();
    for (name, word) in [
        (outside.path("secret").as_str(), "leaves the folder"),
        ("../secret", "leaves the folder"),
        ("link.csv", "a link that leaves the folder"),
        ("inside", "another first line"),
        ("below", "below:3:1: found 1 fields"),
    ] {
        let output = run(&["check", &with_history(&folder, name), "--json"]);
        assert_eq!(output.status.code(), Some(2), "{name}");
        assert!(said(&output).contains(word), "{name}: {}", said(&output));
        for text in [said(&output), stdout(&output)] {
            assert!(!text.contains("root:") && !text.contains("/bin/bash"), "{name}: {text}");
        }
    }
}

/// A design written into another folder takes its histories along.
#[test]
fn histories_are_copied_beside_a_new_design_and_never_over_another_file() {
    let (folder, other) = (Folder::new(), Folder::new());
    std::fs::write(folder.path("pull.csv"), "time_s,torque_nm\n0,1\n0.1,5\n").unwrap();
    let design = with_history(&folder, "pull.csv");
    let data = folder.path("data.csv");
    std::fs::write(&data, "torque_nm,windup_deg\n3.34,0.59\n10,1.28\n16.8,1.9\n").unwrap();
    let new = other.path("new.toml");
    let identify = [
        "identify",
        &design,
        "--data",
        &data,
        "--unknown",
        "r_i2_mm:3.9:4.4",
        "--starts",
        "1",
        "--evaluations",
        "30",
        "-o",
        &new,
    ];
    run(&identify);
    assert_eq!(other.names(), ["new.toml", "pull.csv"]);
    assert_eq!(run(&["stiffness", &new]).status.code(), Some(0));
    std::fs::write(other.path("pull.csv"), "mine\n").unwrap();
    for command in [&identify[..], &["optimize", &design, "--starts", "1", "-o", &new]] {
        let output = run(command);
        assert!(output.status.code() == Some(2) && said(&output).contains("pull.csv"), "{}", said(&output));
    }
    assert_eq!(std::fs::read_to_string(other.path("pull.csv")).unwrap(), "mine\n");
}

#[test]
fn control_characters_are_shown_and_not_sent() {
    let folder = Folder::new();
    let escape = "\u{1b}[31m";
    let key = folder.path("key.toml");
    std::fs::write(&key, format!("\"\\u001b[31mkey\" = 1\n{}", std::fs::read_to_string(MULTI).unwrap()))
        .unwrap();
    let comment = folder.path("comment.toml");
    std::fs::write(&comment, format!("# {escape}\n{}", std::fs::read_to_string(MULTI).unwrap())).unwrap();
    let turned = folder.changed(MULTI, &[("name = \"Huang", "name = \"\\u202eHuang")]);
    let path = format!("{escape}.toml");
    let outside = folder.path(&format!("a{escape}b.toml"));
    let flag = format!("--{escape}");
    for args in [
        vec!["check", &key],
        vec!["check", &comment],
        vec!["check", &turned],
        vec!["check", &path],
        vec!["check", MULTI, &flag],
        vec!["simulate", MULTI, "--scenario", escape],
        [&SIZE[..], &[&outside]].concat(),
    ] {
        let output = run(&args);
        for text in [said(&output), stdout(&output)] {
            assert!(!text.contains(['\u{1b}', '\u{202e}']), "{args:?}: {text:?}");
        }
    }
    assert!(said(&run(&["check", &path])).contains(r"\u{1b}[31m.toml"));
    assert!(stdout(&run(&[&SIZE[..], &[&outside, "--force"]].concat())).contains(r"a\u{1b}[31mb.toml"));
}

#[test]
fn a_file_that_is_all_faults_is_told_of_the_first() {
    let folder = Folder::new();
    for (name, text) in [
        ("keys.toml", (0..5000).map(|i| format!("k{i} = 1\n")).collect::<String>()),
        ("one-line.toml", format!("x = [{}]\n", "{ a = 1 }, ".repeat(5000))),
    ] {
        let path = folder.path(name);
        std::fs::write(&path, text).unwrap();
        let output = run(&["check", &path, "--json"]);
        assert_eq!(output.status.code(), Some(2));
        assert!(output.stderr.len() < 20_000, "{name}: {} bytes", output.stderr.len());
        assert!(output.stdout.len() < 100_000, "{name}: {} bytes", output.stdout.len());
        assert_eq!(said(&output).contains("more"), name == "keys.toml", "{}", said(&output));
    }
}

#[test]
fn a_number_with_a_comma_and_a_text_in_utf_16_are_called_so() {
    let folder = Folder::new();
    let comma = folder.path("comma.toml");
    std::fs::write(&comma, "schema = 1\n[races]\nwidth_mm = 12,5\n").unwrap();
    let refused = run(&["check", &comma]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(said(&refused).contains("with a point"), "{}", said(&refused));
    let wide = folder.path("wide.toml");
    let utf16: Vec<u8> = "\u{feff}schema = 1\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    std::fs::write(&wide, utf16).unwrap();
    assert!(said(&run(&["check", &wide])).contains("UTF-16"));
}

#[test]
fn a_key_of_a_scene_without_its_scene_names_those_that_have_it() {
    let design = "designs/huang2017-multi-arc.toml";
    for (key, meant, not) in [
        ("amplitude_nm=3", "scenarios[high-10].amplitude_nm", "scenarios[rated-static].amplitude_nm"),
        (
            "scenarios.high-10.amplitude_nm=3",
            "scenarios[high-10].amplitude_nm",
            "scenarios[high-6].amplitude_nm",
        ),
    ] {
        let refused = run(&["check", design, "--set", key]);
        assert_eq!(refused.status.code(), Some(2));
        let words = said(&refused);
        assert!(words.contains(meant) && !words.contains(not), "{key}: {words}");
    }
}
