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
    let ran = run(&["sharing", UNLIKE, "--scenario", "engagement", "--max-steps", "100"]);
    assert!(stdout(&ran).contains("met its limit of 100 steps at"), "{}", stdout(&ran));
    assert_eq!(ran.status.code(), Some(3));
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
fn a_driven_cage_that_a_scene_would_need_is_told() {
    let folder = Folder::new();
    let file = folder.path("cage.toml");
    let cost = |step_nm: f64| {
        let scene = format!(
            "\n[sharing]\nseed = 1\n\n[[scenarios]]\nname = \"step\"\nkind = \"transient\"\npreload_nm = 40.0\n\
             torque_step_nm = {step_nm:?}\nstep_time_s = 0.005\nabutment_stiffness_nm_per_rad = 5000.0\n\
             duration_s = 0.02\nspeed_rpm = 0.0\n"
        );
        let design = std::fs::read_to_string("designs/lift-off-inner.toml").unwrap();
        std::fs::write(&file, design + &scene).unwrap();
        let found = json(&run(&["sharing", &file, "--scenario", "step", "--json"]));
        let terms = found["left_out"].as_array().unwrap();
        let cage = terms.iter().find(|t| t["term"].as_str().unwrap().starts_with("the cage"));
        cage.unwrap()["cost"].as_str().unwrap().to_owned()
    };
    assert!(cost(5.0).starts_with("nothing here"), "{}", cost(5.0));
    assert!(cost(-60.0).contains("`simulate` has the cage"), "{}", cost(-60.0));
}
