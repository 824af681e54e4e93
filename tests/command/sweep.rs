//! Sweeps from outside: points, margins, parts, what was cut or belongs to another sweep, and the map.

use crate::program::{Folder, MULTI, json, run, stdout};
use std::process::Output;

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).replace('│', " ").split_whitespace().collect::<Vec<_>>().join(" ")
}

fn read(path: &str) -> String {
    std::fs::read_to_string(path).unwrap()
}

/// Parts joined without the first two lines of all but the first.
fn joined(parts: &[String]) -> String {
    let rest = |(k, part): (usize, &String)| {
        part.split_inclusive('\n').skip(if k > 0 { 2 } else { 0 }).collect::<String>()
    };
    parts.iter().enumerate().map(rest).collect()
}

/// Three parts made by `args`, joined.
fn in_parts(folder: &Folder, args: &[&str]) -> String {
    let part = |k: usize| {
        let (path, number) = (folder.path(&format!("part-{k}.csv")), format!("{k}/3"));
        let output = run(&[args, &["--part", &number, "--csv", &path, "--force"]].concat());
        assert_eq!(output.status.code(), Some(0), "{}", said(&output));
        read(&path)
    };
    joined(&[part(1), part(2), part(3)])
}

#[test]
fn parts_joined_are_the_whole_for_any_number_of_threads_and_either_source() {
    let folder = Folder::new();
    let (vectors, margins) = (folder.path("vectors.csv"), folder.path("margins.csv"));
    let draw = ["sample", MULTI, "--sobol", "11", "--seed", "5"];
    assert_eq!(run(&[&draw[..], &["--csv", &vectors]].concat()).status.code(), Some(0));
    assert_eq!(in_parts(&folder, &draw), read(&vectors));
    let drawn = ["evaluate", MULTI, "--static", "--sobol", "11", "--seed", "5"];
    let whole = stdout(&run(&[&drawn[..], &["--threads", "1"]].concat()));
    assert_eq!(whole.lines().count(), 13);
    assert_eq!(in_parts(&folder, &[&drawn[..], &["--threads", "2"]].concat()), whole);
    let table = ["evaluate", MULTI, "--static", "--vectors", &vectors];
    assert_eq!(in_parts(&folder, &table), whole);
    // Vectors cut by somebody else, and joined without care.
    let cut = folder.path("cut.csv");
    let text = read(&vectors);
    let (head, rows) = text.split_at(text.match_indices('\n').nth(1).unwrap().0 + 1);
    std::fs::write(&cut, format!("{head}{rows}{head}")).unwrap();
    let output = run(&["evaluate", MULTI, "--static", "--vectors", &cut, "--csv", &margins]);
    assert!(output.status.success() && read(&margins) == whole, "{}", said(&output));
    let some = run(&[&drawn[..], &["--first", "3", "--count", "2"]].concat());
    assert_eq!(
        stdout(&some).lines().skip(2).collect::<Vec<_>>(),
        whole.lines().skip(5).take(2).collect::<Vec<_>>()
    );
}

#[test]
fn a_sweep_has_the_numbers_of_the_lines_and_the_columns_chosen() {
    use std::io::Write;
    let folder = Folder::new();
    let vectors = folder.path("own.csv");
    // Anybody's CSV: another order, quotes, a remark, a point beyond its bounds.
    let rows = "# by hand\n\"centroid_x_mm\",centroid_y_mm,r_i3_mm,r_i2_mm\n0.1935,0.5288,4.15,4.08\n0.1935,50,4.15,4.08\n";
    std::fs::write(&vectors, rows).unwrap();
    let output = run(&["evaluate", MULTI, "--vectors", &vectors]);
    let text = stdout(&output);
    assert!(output.status.success() && text.contains("; points file "), "{text}");
    let mut reader = csv::Reader::from_reader(text.split_once('\n').unwrap().1.as_bytes());
    let names = reader.headers().unwrap().clone();
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_sprag-design"))
        .args(["evaluate", MULTI])
        .stdin(std::process::Stdio::piped())
        .stdout(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    child
        .stdin
        .take()
        .unwrap()
        .write_all(b"[4.08, 4.15, 0.1935, 0.5288]\n[4.08, 4.15, 0.1935, 50.0]")
        .unwrap();
    let lines = String::from_utf8(child.wait_with_output().unwrap().stdout).unwrap();
    let lines: Vec<serde_json::Value> = lines.lines().map(|l| serde_json::from_str(l).unwrap()).collect();
    let cell = |row: usize, name: &str| &rows[row][names.iter().position(|n| n == name).unwrap()];
    let number = |row: usize, name: &str| cell(row, name).parse::<f64>().unwrap();
    let limits: Vec<f64> =
        names.iter().filter(|n| n.starts_with("limit.")).map(|name| number(0, name)).collect();
    assert_eq!(serde_json::json!(limits), lines[0]["limits"]);
    assert_eq!(serde_json::json!(number(0, "least")), lines[0]["least"]);
    assert_eq!((cell(0, "deciding"), cell(0, "feasible")), ("keep-contact", "0"));
    assert_eq!(-number(0, "margin"), lines[0]["violation"].as_f64().unwrap());
    assert!(lines[1]["refused"] == cell(1, "refused") && cell(1, "margin").is_empty());
    let chosen = run(&["evaluate", MULTI, "--static", "--sobol", "1", "--columns", "margin,variables"]);
    let second = stdout(&chosen).lines().nth(1).unwrap().to_owned();
    assert_eq!(second, "index,margin,r_i2_mm,r_i3_mm,centroid_x_mm,centroid_y_mm");
}

#[test]
fn what_is_there_is_left_what_was_cut_is_made_anew_and_another_sweep_is_refused() {
    let folder = Folder::new();
    let path = folder.path("margins.csv");
    let ask = |more: &[&str]| run(&[&["evaluate", MULTI, "--static", "--csv", &path], more].concat());
    assert!(ask(&["--sobol", "7", "--part", "2/2"]).status.success());
    let (whole, written) = (read(&path), std::fs::metadata(&path).unwrap().modified().unwrap());
    let again = ask(&["--sobol", "7", "--part", "2/2"]);
    assert!(again.status.success() && said(&again).contains("there already"), "{}", said(&again));
    assert_eq!(std::fs::metadata(&path).unwrap().modified().unwrap(), written);
    assert!(said(&ask(&["--sobol", "7", "--part", "2/2", "--force"])).contains("4 points"));
    for cut in [0, 100, 300, whole.len() - 1, whole.len() - 40, whole.rfind("\n6,").unwrap() + 1] {
        std::fs::write(&path, &whole[..cut]).unwrap();
        let anew = ask(&["--sobol", "7", "--part", "2/2"]);
        assert!(anew.status.success() && read(&path) == whole, "cut at {cut}: {}", said(&anew));
    }
    for (more, word) in [
        (
            &["--sobol", "7", "--seed", "2", "--part", "2/2"][..],
            "points: sobol 7 seed 1; wanted: sobol 7 seed 2",
        ),
        (&["--sobol", "7", "--part", "2/2", "--full"], "work: quick; wanted: full"),
        (&["--sobol", "7", "--part", "2/2", "--columns", "margin"], "other columns"),
        (&["--sobol", "7", "--part", "2/2", "--set", "r_i1_mm=4.03"], "design: "),
    ] {
        let refused = ask(more);
        assert_eq!(refused.status.code(), Some(2), "{more:?}");
        assert!(said(&refused).contains(word) && read(&path) == whole, "{more:?}: {}", said(&refused));
    }
    std::fs::write(&path, "mine\n").unwrap();
    assert_eq!(ask(&["--sobol", "7"]).status.code(), Some(2));
    assert_eq!(folder.names(), ["margins.csv"], "no temporary file is left");
}

#[test]
fn vectors_that_do_not_fit_are_refused_with_line_and_reason() {
    let folder = Folder::new();
    let path = folder.path("vectors.csv");
    run(&["sample", MULTI, "--sobol", "4", "--csv", &path]);
    let text = read(&path);
    let third = text.lines().nth(4).unwrap();
    let moved = third.replacen(",3.", ",4.", 1);
    assert_ne!(moved, third);
    for (changed, word) in [
        (text.replace("; design 0", "; design 1"), "vectors of another design"),
        (text.replace("; vectors; ", "; "), "line 1: the first line of a sweep, but cut or changed"),
        (text.replace(third, &moved), "line 5: not point 2 of sobol 4 seed 1"),
        (text.replace("r_i3_mm", "r_i3_m"), "did you mean r_i3_mm?"),
        (text.replace(",r_i3_mm", ""), "no column r_i3_mm"),
        (text.replace("index", "r_i3_mm"), "column r_i3_mm stands there twice"),
        (text.replace(third, "2,nan,4,0,0.5"), "line 5: r_i2_mm = \"nan\": a finite number is needed"),
        (text.replace(third, "2,4,4,0"), "line 5: 4 values for 5 columns"),
        (text.replace(third, "-2,4,4,0,0.5"), "line 5: index = \"-2\": a whole number is needed"),
        (String::new(), "no line with the names of columns"),
    ] {
        std::fs::write(&path, &changed).unwrap();
        let output = run(&["evaluate", MULTI, "--static", "--vectors", &path]);
        assert!(output.status.code() == Some(2) && output.stdout.is_empty(), "{word}");
        assert!(said(&output).contains(word), "{word}: {}", said(&output));
    }
    let here = folder.path("");
    for (args, word) in [
        (&["sample", MULTI][..], "no points asked for"),
        (&["sample", MULTI, "--sobol", "0"], "2^63 points"),
        (&["sample", MULTI, "--grid", "r_i2_mm=1"], "2 values or more"),
        (&["sample", MULTI, "--sobol", "5", "--first", "5"], "there are 5 points, 0 to 4"),
        (&["evaluate", MULTI, "--sobol", "5", "--columns", "margins"], "did you mean margin?"),
        (&["evaluate", MULTI, "--vectors", &here], "is no file"),
        (&["evaluate", MULTI, "--vectors", "/absent.csv"], "cannot be read"),
        (&["evaluate", MULTI, "--vectors", &path, "--csv", &path], "is read by this command"),
        (&["evaluate", MULTI, "--columns", "margin"], "are of a table of points"),
        (&["evaluate", MULTI, "--sobol", "5", "--describe"], "goes with lines of JSON"),
    ] {
        let output = run(args);
        assert!(output.status.code() == Some(2) && output.stdout.is_empty(), "{args:?}");
        assert!(said(&output).contains(word), "{args:?}: {}", said(&output));
    }
}

#[test]
fn a_full_disk_is_told_and_leaves_nothing() {
    if !std::path::Path::new("/dev/full").exists() {
        return;
    }
    let output = run(&["evaluate", MULTI, "--static", "--sobol", "2", "--csv", "/dev/full"]);
    assert!(
        output.status.code() == Some(3) && said(&output).contains("cannot write /dev/full"),
        "{}",
        said(&output)
    );
}

#[test]
fn a_map_of_parts_is_that_of_the_whole_and_its_page_fetches_nothing() {
    let folder = Folder::new();
    let [first, second, whole, page] =
        ["a.csv", "b.csv", "whole.csv", "map.html"].map(|name| folder.path(name));
    let grid = ["evaluate", MULTI, "--static", "--grid", "r_i2_mm=5,centroid_x_mm=4"];
    for (path, part) in [(&first, "1/2"), (&second, "2/2"), (&whole, "1/1")] {
        assert!(run(&[&grid[..], &["--part", part, "--csv", path]].concat()).status.success());
    }
    let of_parts = run(&["map", &first, &second, "--json", "--report", &page]);
    let of_parts = json(&of_parts);
    assert_eq!(of_parts, json(&run(&["map", &whole, "--json"])));
    assert!(
        of_parts["points"] == 20 && of_parts["held"].as_u64().is_some_and(|n| n > 0 && n < 20),
        "{of_parts}"
    );
    assert_eq!(of_parts["design"], "Huang 2017, multi-arc");
    assert_eq!(of_parts["sampling"], "grid r_i2_mm=5,centroid_x_mm=4");
    // The count of the table itself.
    let feasible = |text: String| {
        let at = text.lines().nth(1).unwrap().split(',').position(|name| name == "feasible").unwrap();
        text.lines().skip(2).filter(|line| line.split(',').nth(at) == Some("1")).count()
    };
    assert_eq!(of_parts["held"], feasible(read(&whole)));
    let html = read(&page).replace("http://www.w3.org/2000/svg", "");
    for word in ["Map of a sweep", "What decides", "stroke-linecap=\"square\"", "r_i2, mm", "keep-contact"] {
        assert!(html.contains(word), "{word}");
    }
    for bad in ["http:", "https:", "src=", "url(", "NaN", "inf,"] {
        assert!(!html.contains(bad), "{bad}");
    }
    let other = folder.path("other.csv");
    assert!(run(&[&grid[..], &["--set", "r_i1_mm=4.03", "--csv", &other]].concat()).status.success());
    for (args, word) in [
        (&["map", &first, &other][..], "another sweep than the first table: its design"),
        (&["map", &first, "--over", "r_i2_mm,r_i3"], "did you mean r_i3_mm?"),
        (&["map", &first, "--by", "leas"], "did you mean least?"),
        (&["map", &first, "--over", "r_i2_mm"], "two different variables"),
        (&["map", MULTI], "no column margin"),
        (&["map", "/absent.csv"], "cannot be read"),
    ] {
        let output = run(args);
        assert!(
            output.status.code() == Some(2) && said(&output).contains(word),
            "{args:?}: {}",
            said(&output)
        );
    }
    let vectors = folder.path("vectors.csv");
    run(&["sample", MULTI, "--sobol", "3", "--csv", &vectors]);
    assert!(said(&run(&["map", &vectors])).contains("vectors without margins"));
}
