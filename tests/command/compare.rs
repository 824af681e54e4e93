//! `compare` and `sheet` from outside: their numbers are those of the other commands; what differs is listed; nothing of the
//! file is lost on the sheet.

use crate::program::*;
use serde_json::Value;

const CHANGES: [(&str, &str); 2] = [
    ("{ radius_mm = 4.08, until_rad = 0.12 }", "{ radius_mm = 4.20, until_rad = 0.12 }"),
    ("[check]", "[check]   # another comment is no difference"),
];

/// The answer of a command for one design.
fn asked(command: &[&str]) -> Value {
    json(&run(&[command, &["--json"]].concat()))
}

fn rows<'a>(answer: &'a Value, key: &str) -> &'a Vec<Value> {
    answer[key].as_array().unwrap()
}

#[test]
fn every_figure_is_that_of_the_command_that_has_it() {
    let folder = Folder::new();
    let after = folder.changed(MULTI, &CHANGES);
    let files = [MULTI, after.as_str()];
    let answer = asked(&["compare", MULTI, &after]);
    has_envelope(&answer);
    let figure = |key: &str, i: usize| {
        let row = rows(&answer, "figures").iter().find(|f| f["key"] == key);
        row.unwrap_or_else(|| panic!("{key}"))["values"][i].as_f64().unwrap()
    };
    for (i, file) in files.into_iter().enumerate() {
        let check = asked(&["check", file]);
        assert_eq!(answer["designs"][i]["design_hash"], check["design_hash"]);
        assert_eq!(answer["designs"][i]["pass"], check["pass"]);
        assert_eq!(answer["designs"][i]["deciding"], check["deciding"]["code"]);
        let (theirs, ours) = (rows(&check, "margins"), rows(&answer, "margins"));
        assert_eq!(theirs.len(), ours.len());
        for (a, b) in theirs.iter().zip(ours) {
            assert_eq!(a["code"], b["code"]);
            assert_eq!(a["margin"], b["margins"][i], "{a} {b}");
            assert_eq!((&a["held"], &a["required"]), (&b["held"][i], &b["required"][i]));
            assert_eq!(a["torque_capacity_nm"], b["torque_capacities_nm"][i]);
        }
        for kind in ["nominal", "peak"] {
            let capacity = check[format!("{kind}_torque_capacity")]["torque_capacity_nm"].as_f64().unwrap();
            assert_eq!(capacity, figure(&format!("torque_capacity_{kind}_nm"), i));
        }
        assert_eq!(check["lift_off_rpm"].as_f64().unwrap(), figure("lift_off_rpm", i));
        assert_eq!(check["end"]["torque_nm"].as_f64().unwrap(), figure("curve_end_nm", i));
        let stiffness = asked(&["stiffness", file, "--torques", "90,110"]);
        for (point, kind) in rows(&stiffness, "points").iter().zip(["nominal", "peak"]) {
            for (theirs, ours) in [
                ("windup_deg", format!("windup_{kind}_deg")),
                ("k_tangent_nm_per_rad", format!("k_tangent_{kind}_nm_per_rad")),
                ("k_secant_nm_per_rad", format!("k_secant_{kind}_nm_per_rad")),
                ("tan_omega", format!("tan_omega_{kind}")),
                ("hertz_inner_mpa", format!("hertz_inner_{kind}_mpa")),
                ("hertz_outer_mpa", format!("hertz_outer_{kind}_mpa")),
            ] {
                assert_eq!(point[theirs].as_f64().unwrap(), figure(&ours, i), "{ours}");
            }
        }
        let simulated = asked(&["simulate", file, "--scenario", "rated-45"]);
        let scene = rows(&answer, "scenes").iter().find(|s| s["name"] == "rated-45").unwrap();
        for (theirs, ours) in [
            ("required_static_friction", "required_friction"),
            ("slip_margin", "slip_margin"),
            ("contact_margin", "contact_margin"),
        ] {
            let (a, b) = (simulated[theirs].as_f64().unwrap(), scene[ours][i].as_f64().unwrap());
            // Runs at two tolerances; simulate states 1e-8 for this one.
            assert!((a - b).abs() < 1e-6, "{ours}: {a} {b}");
        }
    }
}

#[test]
fn what_differs_is_listed_and_what_does_not_is_not() {
    let folder = Folder::new();
    let after = folder.changed(MULTI, &CHANGES);
    let answer = asked(&["compare", MULTI, &after]);
    let inputs = rows(&answer, "inputs");
    assert_eq!(inputs.len(), 1, "{inputs:?}");
    assert_eq!(inputs[0]["path"], "sprags.inner_arcs[1].radius_mm");
    assert_eq!((&inputs[0]["unit"], &inputs[0]["values"]), (&"mm".into(), &serde_json::json!([4.08, 4.2])));
    let same = run(&["compare", MULTI, MULTI]);
    assert!(stdout(&same).contains("no input differs") && !stdout(&same).contains("Inputs that differ"));
    // What one file has and another lacks differs too, and a design that holds no limit costs no exit code.
    let other = folder.path("other.toml");
    let text = std::fs::read_to_string(MULTI)
        .unwrap()
        .replace("hoop_inner_mpa = 900.0\n", "hoop_inner_mpa = 9.0\nbody_yield_mpa = 900.0\n");
    std::fs::write(&other, text).unwrap();
    let three = run(&["compare", MULTI, &after, &other, "--json"]);
    assert_eq!(three.status.code(), Some(0));
    let three = json(&three);
    let of =
        |path: &str| rows(&three, "inputs").iter().find(|r| r["path"] == path).unwrap()["values"].clone();
    assert_eq!(of("limits.body_yield_mpa"), serde_json::json!([null, null, 900.0]));
    assert_eq!(three["designs"][2]["pass"], false);
    let row = rows(&three, "margins").iter().find(|r| r["code"] == "body-yield").unwrap();
    assert!(row["margins"][0].is_null() && row["margins"][2].is_f64(), "{row}");
}

/// What is wrong with one file does not hide what is wrong with another.
#[test]
fn every_file_that_cannot_be_read_is_named() {
    for command in ["compare", "check"] {
        let out = run(&[command, "no-such-a.toml", MULTI, "no-such-b.toml", "--json"]);
        assert_eq!(out.status.code(), Some(2));
        let said = String::from_utf8(out.stderr.clone()).unwrap();
        let last = stdout(&out).lines().last().unwrap().to_owned();
        let error = &serde_json::from_str::<Value>(&last).unwrap()["error"];
        assert_eq!(error["errors"].as_array().map(Vec::len), Some(2), "{error}");
        for name in ["no-such-a.toml", "no-such-b.toml"] {
            assert!(
                said.contains(name) && error["message"].as_str().unwrap().contains(name),
                "{name}: {said}"
            );
        }
    }
}

#[test]
fn one_design_or_seven_are_no_comparison() {
    for count in [1, 7] {
        let output = run(&[&["compare"][..], &vec![MULTI; count]].concat());
        assert_eq!(output.status.code(), Some(2), "{count}");
    }
}

#[test]
fn the_page_of_a_comparison_has_one_colour_for_before_and_one_for_after() {
    let folder = Folder::new();
    let (after, page) = (folder.changed(MULTI, &CHANGES), folder.path("compare.html"));
    run(&["compare", MULTI, &after, "--report", &page]);
    let html = is_self_contained(&page);
    let plots: Vec<&str> = html
        .split("<svg ")
        .filter(|svg| svg.contains("against torque<") || svg.contains("Torque against windup<"))
        .collect();
    // Each for a window and for a phone.
    assert_eq!(plots.len(), 8);
    assert_eq!(plots.iter().filter(|svg| svg.starts_with("class=\"phone\"")).count(), 4);
    for svg in plots {
        let lines: Vec<&str> =
            svg.lines().filter(|l| l.contains("stroke-linejoin") && l.contains("1.8")).collect();
        assert_eq!(lines.len(), 2);
        assert!(
            lines[0].contains("--c1") && lines[0].contains("\"8 4\""),
            "{}",
            &lines[0][lines[0].len() - 120..]
        );
        assert!(lines[1].contains("--c0") && lines[1].contains("\"none\""));
    }
    let html = html.replace("<wbr>", "");
    assert!(html.contains("sprags.inner_arcs[1].radius_mm, mm") && html.contains("Outside the profile of A"));
}

/// Texts of the page's body: tags taken out, entities read.
fn visible(html: &str) -> String {
    let html = html.replace("<wbr>", "");
    let body = &html[html.find("<body>").unwrap()..];
    let body = &body[..body.find("<script").unwrap()];
    let text: String = body
        .split('<')
        .map(|part| part.split_once('>').map_or("", |(_, text)| text))
        .collect::<Vec<_>>()
        .join("\n");
    [("&quot;", "\""), ("&#39;", "'"), ("&lt;", "<"), ("&gt;", ">"), ("&amp;", "&")]
        .iter()
        .fold(text, |text, (entity, c)| text.replace(entity, c))
}

#[test]
fn every_input_stands_on_the_sheet_and_what_made_it() {
    let folder = Folder::new();
    let page = folder.path("sheet.html");
    for file in [MULTI, "designs/indexing.toml", "designs/huang2017-bench.toml"] {
        let output = run(&["sheet", file, "--report", &page]);
        let said = stdout(&output);
        let verdict = said.lines().next().unwrap();
        // One of them once more: the others take long.
        if file == MULTI {
            let check = run(&["check", file]);
            assert_eq!(output.status.code(), check.status.code());
            assert!(stdout(&check).contains(verdict), "{verdict}");
        }
        let html = is_self_contained(&page);
        let text = visible(&html);
        assert!(text.contains(verdict) && text.contains(&format!("sheet {file} --report")), "{file}");
        assert!(text.contains(&sprag_design::Design::read(file.as_ref()).unwrap().hash));
        let source = std::fs::read_to_string(file).unwrap();
        let inputs = sprag_design::file::inputs(&source);
        assert!(inputs.len() > 30);
        let section = &text[text.rfind("Inputs").unwrap()..];
        for input in inputs {
            let key = input.path.rsplit(['.', ']']).next().unwrap();
            // In the head of a table, the unit behind a comma.
            let words = key.replace('_', " ");
            let bare = ["_nm_per_rad", "_kg_m2", "_nm", "_rpm", "_hz", "_s"]
                .iter()
                .find_map(|end| key.strip_suffix(end));
            let heads = [Some(key.to_owned()), Some(words), bare.map(|name| name.replace('_', " ") + ", ")];
            let key = heads.into_iter().flatten().find(|head| section.contains(head)).unwrap_or_default();
            assert!(!key.is_empty(), "{file}: key of {}", input.path);
            assert!(section.contains(&key), "{file}: key of {}", input.path);
            assert!(section.contains(&input.text), "{file}: {} = {}", input.path, input.text);
        }
        // Whatever is folded is printed, but for long evidence, whose summary says that it is not, and for the file, whose
        // inputs stand in tables.
        for fold in html.split("<details").skip(1) {
            assert!(
                ["printed", "apart", "source"]
                    .iter()
                    .any(|kind| fold.starts_with(&format!(" class=\"{kind}\""))),
                "{}",
                &fold[..60]
            );
        }
        for word in ["Clutch, scale ", "Sprag at first contact", "race gap ", "strut AB ", "⌀ ", "mass "] {
            assert!(text.contains(word), "{file}: {word}");
        }
    }
}

#[test]
fn a_scene_that_sticks_by_less_than_wanted_is_not_held_on_the_sheet() {
    let folder = Folder::new();
    // low-10 has a slip margin of 45.8 %.
    let design = folder.changed(MULTI, &[("slip_margin = 0.10", "slip_margin = 0.60")]);
    let page = folder.path("sheet.html");
    assert_eq!(run(&["sheet", &design, "--report", &page]).status.code(), Some(1));
    let html = std::fs::read_to_string(&page).unwrap();
    let row = html.split("<tr><td>low-10</td>").nth(1).unwrap().split("</tr>").next().unwrap();
    assert!(row.contains("NOT HELD"), "{row}");
}

#[test]
fn the_sheet_lies_beside_its_design_and_replaces_nobody_elses_file() {
    let folder = Folder::new();
    let design = folder.changed(MULTI, &[("hertz_nominal_mpa = 4200.0", "hertz_nominal_mpa = 3000.0")]);
    let output = run(&["sheet", &design]);
    assert_eq!(output.status.code(), Some(1), "not held");
    assert!(folder.names().contains(&"changed-sheet.html".to_owned()), "{:?}", folder.names());
    std::fs::write(folder.path("changed-sheet.html"), "mine").unwrap();
    let output = run(&["sheet", &design]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(std::fs::read_to_string(folder.path("changed-sheet.html")).unwrap(), "mine");
}

#[test]
fn a_table_goes_to_standard_output_in_place_of_the_text() {
    let folder = Folder::new();
    let path = folder.path("a.csv");
    for command in [
        &["check", MULTI][..],
        &["stiffness", MULTI, "--torques", "3,50"],
        &["compare", MULTI, SINGLE],
        &["materials"],
    ] {
        run(&[command, &["--csv", &path]].concat());
        let output = run(&[command, &["--csv", "-"]].concat());
        assert_eq!(stdout(&output), std::fs::read_to_string(&path).unwrap(), "{command:?}");
        assert!(!std::path::Path::new("-").exists());
        let refused = run(&[command, &["--csv", "-", "--json"]].concat());
        assert_eq!(refused.status.code(), Some(2));
        assert!(
            json(&refused)["error"]["message"].as_str().unwrap().contains("both write to standard output")
        );
    }
}

#[test]
fn a_misspelt_command_is_told_the_right_one() {
    for (typed, meant) in
        [("chek", "check"), ("comapre", "compare"), ("shet", "sheet"), ("stifness", "stiffness")]
    {
        let output = run(&[typed]);
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(2) && said.contains(&format!("'{meant}'")), "{said}");
    }
}

#[test]
fn the_page_of_stiffness_says_what_the_stiffness_is() {
    let folder = Folder::new();
    let page = folder.path("stiffness.html");
    run(&["stiffness", MULTI, "--report", &page]);
    let html = is_self_contained(&page);
    let banner = html.split("<p class=\"verdict said\">").nth(1).unwrap().split("</p>").next().unwrap();
    // 796.0 and 841.3 Nm/rad: what `stiffness --torques 90,110` has.
    assert!(
        banner.contains("at 90 Nm (nominal): 796.0 Nm/rad")
            && banner.contains("at 110 Nm (peak): 841.3 Nm/rad"),
        "{banner}"
    );
}

/// Of designs of other sizes each has its drawing, and the profiles are laid over one another where they touch the inner race.
#[test]
fn designs_of_other_sizes_are_drawn_each_and_laid_at_first_contact() {
    let folder = Folder::new();
    let page = folder.path("sizes.html");
    run(&["compare", MULTI, "designs/series-833-small.toml", "--report", &page]);
    let html = is_self_contained(&page);
    for words in ["Drawing of A, ", "Drawing of B, ", "touch the inner race of B at the same point"] {
        assert!(html.contains(words), "{words}");
    }
    let after = folder.changed(MULTI, &[("peak_torque_nm = 110.0", "peak_torque_nm = 100.0")]);
    run(&["compare", MULTI, &after, "--report", &page, "--force"]);
    let html = is_self_contained(&page);
    assert!(!html.contains("Drawing of A, ") && html.contains("Drawing of B, "));
}
