//! `identify` from outside: JSON, CSV, page, the design file written, exit codes.

use crate::program::*;

const DATA: &str =
    "label,use,torque_nm,windup_deg\na,,10,1.2215\nb,fit,16.8,1.975\nc,,80,7.56\nd,check,90,8.5\n";

fn data(folder: &Folder, text: &str) -> String {
    let path = folder.path("data.csv");
    std::fs::write(&path, text).unwrap();
    path
}

#[test]
fn an_answer_in_every_form() {
    let folder = Folder::new();
    let (data, new, csv, page) =
        (data(&folder, DATA), folder.path("new.toml"), folder.path("out.csv"), folder.path("out.html"));
    let args = [
        "identify",
        MULTI,
        "--data",
        &data,
        "--unknown",
        "r_i3_mm:3.6:4.8",
        "-o",
        &new,
        "--json",
        "--quiet",
        "--starts",
        "2",
        "--csv",
        &csv,
        "--report",
        &page,
    ];
    let output = run(&args);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let value = json(&output);
    has_envelope(&value);
    let unknown = &value["unknowns"][0];
    assert_eq!(unknown["name"], "r_i3_mm");
    assert_eq!(unknown["before"], 4.15);
    let found = unknown["value"].as_f64().unwrap();
    assert!(unknown["half_width_95"].as_f64().unwrap() > 0.0 && (3.6..4.8).contains(&found), "{value}");
    assert_eq!(value["observations"].as_array().unwrap().len(), 4);
    assert_eq!(value["observations"][3]["use"], "check");
    assert_eq!(value["degrees_of_freedom"], 2);
    assert!(value["remarks"].as_array().unwrap().iter().any(|r| r.as_str().unwrap().contains("held back")));
    let text = std::fs::read_to_string(&new).unwrap();
    assert!(
        text.starts_with("# Written by sprag-design identify") && text.contains(&format!("{found}")),
        "{text}"
    );
    assert_eq!(run(&["check", &new, "--json", "--quiet"]).stderr.len(), 0);
    assert_eq!(std::fs::read_to_string(csv).unwrap().lines().count(), 5);
    assert!(is_self_contained(page).contains("Correlation"));
}

#[test]
fn what_is_not_determined_is_exit_code_1_and_a_plain_word() {
    let folder = Folder::new();
    let data = data(&folder, DATA);
    let output = run(&[
        "identify",
        MULTI,
        "--data",
        &data,
        "--unknown",
        "r_i3_mm:3.6:4.8,centroid_y_mm:0.3:0.8",
        "--starts",
        "1",
    ]);
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    assert!(stdout(&output).contains("the data say nothing of centroid_y_mm"), "{}", stdout(&output));
}

#[test]
fn an_interval_wider_than_the_bounds_determines_nothing() {
    let folder = Folder::new();
    let data = data(&folder, "torque_nm,windup_deg\n10,1.2345\n20,2.24\n30,3.17\n50,5.1\n70,6.75\n");
    // A radius and where it begins, and two radii in series, act as one.
    for (unknown, named) in [
        ("r_i2_mm:3.9:4.3,junction_1_rad:0.05:0.08", "the data do not determine r_i2_mm, junction_1_rad\n"),
        (
            "r_i1_mm:3.9:4.1,races.inner_radius_mm:11.0:11.2",
            "the data do not determine r_i1_mm, races.inner_radius_mm\n",
        ),
    ] {
        let new = folder.path("new.toml");
        let output =
            run(&["identify", MULTI, "--data", &data, "--unknown", unknown, "--starts", "1", "-o", &new]);
        let text = stdout(&output);
        assert_eq!(output.status.code(), Some(1), "{text}");
        assert!(text.contains(named) && text.contains("says no more than its bounds"), "{text}");
        assert!(std::fs::read_to_string(&new).unwrap().contains("(95 %), not determined\n"));
    }
}

#[test]
fn nonsense_is_exit_code_2_with_file_line_and_column() {
    let folder = Folder::new();
    let bad = data(&folder, "torque_nm,windup_deg\n10,1\n20,x\n");
    let output = run(&["identify", MULTI, "--data", &bad, "--unknown", "r_i3_mm:3.6:4.8"]);
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8(output.stderr).unwrap().replace("\n  │ ", " ");
    for word in ["line 3", "windup_deg", "no finite number"] {
        assert!(said.contains(word), "{word} in {said}");
    }
    for (unknown, data) in [
        ("r_i3_mm", bad.as_str()),
        ("r_i3_mm:4:3", &bad),
        ("r_i3_mm:a:3", &bad),
        ("r_i3_mm:3:4", "/nowhere.csv"),
    ] {
        assert_eq!(
            run(&["identify", MULTI, "--data", data, "--unknown", unknown]).status.code(),
            Some(2),
            "{unknown}"
        );
    }
}
