//! `sharing --scenario` from outside: text, files, exit codes, refusals.

use crate::program::*;

const UNLIKE: &str = "designs/unlike-sprags.toml";

#[test]
fn a_scene_is_told_in_text_and_files() {
    let folder = Folder::new();
    let (csv, page) = (folder.path("s.csv"), folder.path("s.html"));
    let ran = run(&["sharing", UNLIKE, "--scenario", "engagement", "--csv", &csv, "--report", &page]);
    let text = stdout(&ran);
    assert!(text.contains("from seed 1") && text.contains("12 of 12 sprags catch"), "{text}");
    let held = text.contains("\nHELD: ");
    assert_eq!(ran.status.code(), Some(i32::from(!held)), "{text}");
    let rows = std::fs::read_to_string(&csv).unwrap();
    assert_eq!(rows.lines().count(), 13);
    assert!(rows.starts_with("number,size_um,gap_um,friction,catches_s,order,"));
    assert!(is_self_contained(&page).contains("Share of the mean"));
    let json = run(&["sharing", UNLIKE, "--scenario", "engagement", "--json"]);
    let found = crate::program::json(&json);
    assert_eq!(found["tool"], "sprag-design");
    let terms = found["left_out"].as_array().unwrap();
    assert!(terms.iter().any(|t| t["term"].as_str().unwrap().starts_with("inertia of the races that bend")));
    assert_eq!((&found["seed"], &found["kinds"], &found["held"]), (&1.into(), &12.into(), &held.into()));
    // The one with the weak spring is the last.
    assert_eq!(found["catching"].as_array().unwrap().last().unwrap(), 4);
    let history = found["history"].as_array().unwrap();
    assert_eq!(history.len(), 401);
    // Shares of all places are 1 in the mean.
    let last = history[400]["shares"].as_array().unwrap();
    let sum: f64 = last.iter().map(|share| share.as_f64().unwrap()).sum();
    assert!((sum - 12.0).abs() < 1e-9, "{sum}");
}

#[test]
fn one_that_lacks_too_much_is_named() {
    let said = stdout(&run(&["sharing", UNLIKE, "--scenario", "high-8"]));
    assert!(said.contains("; sprag 4 never catches;"), "{said}");
}

#[test]
fn sprags_alike_are_one_run() {
    let alike = "sharing={seed=1}";
    let ran = run(&["sharing", MULTI, "--scenario", "high-6", "--set", alike]);
    let said = stdout(&ran);
    assert!(said.contains("are alike: one is computed for all") && said.contains("HELD: "), "{said}");
    assert_eq!(ran.status.code(), Some(0));
}

#[test]
fn a_limit_of_work_is_told_and_exits_with_3() {
    let folder = Folder::new();
    let csv = folder.path("sprags.csv");
    let ran = run(&["sharing", UNLIKE, "--scenario", "engagement", "--max-steps", "100", "--csv", &csv]);
    assert!(stdout(&ran).contains("met its limit of 100 steps at"), "{}", stdout(&ran));
    assert_eq!(ran.status.code(), Some(3));
    // Each row says that it is of a part of the scene.
    let table = std::fs::read_to_string(csv).unwrap();
    let (head, rows) = table.split_once('\n').unwrap();
    assert!(head.ends_with(",state,partial"), "{head}");
    assert!(
        rows.lines().count() > 5 && rows.lines().all(|row| row.contains("met its limit of 100 steps")),
        "{rows}"
    );
}

#[test]
fn what_cannot_be_run_is_refused_with_what_to_do() {
    let refused = |args: &[&str], words: &str| {
        let ran = run(&[&["sharing"], args].concat());
        let said = String::from_utf8_lossy(&ran.stderr);
        let said = said.split_whitespace().filter(|w| *w != "│").collect::<Vec<_>>().join(" ");
        assert!(said.contains(words), "{said}");
        assert!(matches!(ran.status.code(), Some(2 | 3)), "{:?}", ran.status);
    };
    refused(&[UNLIKE, "--scenario", "nothing"], "allowed: engagement, high-8");
    refused(&[MULTI, "--scenario", "high-6"], "no [sharing] table; add one");
    refused(&[UNLIKE, "--scenario", "engagement", "--torque", "3"], "cannot be used with");
    refused(&[UNLIKE, "--max-steps", "3"], "--scenario");
    let bench = "designs/huang2017-bench.toml";
    let seed = "sharing={seed=1}";
    refused(&[bench, "--scenario", "speed-ramp", "--set", seed], "leave its history out");
    refused(&["designs/starter-engine.toml", "--scenario", "cranking", "--set", seed], "drivetrain = []");
}

#[test]
fn a_driven_cage_takes_along_what_lets_go_or_is_said_to_be_left_out() {
    let folder = Folder::new();
    let file = folder.path("cage.toml");
    let scene = |sharing: &str, step_nm: f64| {
        let scene = format!(
            "\n[sharing]\nseed = 1\n{sharing}\n\n[[scenarios]]\nname = \"step\"\nkind = \"transient\"\npreload_nm = 40.0\n\
             torque_step_nm = {step_nm:?}\nstep_time_s = 0.005\nabutment_stiffness_nm_per_rad = 5000.0\n\
             duration_s = 0.03\nspeed_rpm = 0.0\n"
        );
        let design = std::fs::read_to_string("designs/lift-off-inner.toml").unwrap();
        std::fs::write(&file, design + &scene).unwrap();
        let ran = |command: &str| json(&run(&[command, &file, "--scenario", "step", "--json"]));
        [ran("sharing"), ran("simulate")]
    };
    let term = |found: &serde_json::Value, begins: &str| {
        let terms = found["left_out"].as_array().unwrap();
        terms.iter().find(|t| t["term"].as_str().unwrap().starts_with(begins)).cloned()
    };
    let [all, one] = scene("", -60.0);
    let [all_rad, one_rad] =
        [&all["theta_inner_rad"], &one["theta_inner_end_rad"]].map(|x| x.as_f64().unwrap());
    assert!((all_rad - one_rad).abs() < 1e-9 && (one_rad - 0.3721).abs() < 1e-4, "{all_rad} {one_rad}");
    assert_eq!(all["sprags"][0]["state"], "with the cage");
    let what = "what the driven cage does";
    assert_eq!(term(&all, what).unwrap()["cost"], term(&one, what).unwrap()["cost"]);
    assert!(term(&all, "the cage").is_none());
    // Between axes that give way.
    let give_way = "size_within_um = 1.0\nbearing_stiffness_n_per_um = 100.0";
    let cost = |step_nm: f64| term(&scene(give_way, step_nm)[0], "the cage").unwrap()["cost"].clone();
    assert!(cost(5.0).as_str().unwrap().starts_with("nothing here"), "{}", cost(5.0));
    assert!(cost(-60.0).as_str().unwrap().contains("`simulate` has the cage"), "{}", cost(-60.0));
}
