//! `size`: what it writes holds its own limits, what it refuses it refuses in words.

#[path = "common/program.rs"]
mod program;

use program::*;

use std::f64::consts::PI;

use sprag_design::design::Design;
use sprag_design::margin::{load_margins, load_state, margins};
use sprag_design::scenario::Settings;
use sprag_design::size::{Ask, NoSize, Sized, size};

fn ask(bore_mm: f64, torque_nm: f64, rpm: f64, safety: f64, friction: f64) -> Ask {
    Ask { bore_m: bore_mm / 1e3, torque_nm, speed_rad_s: rpm * PI / 30.0, safety, friction }
}

fn sized(ask: &Ask) -> Result<Sized, NoSize> {
    size(ask, &Settings::default())
}

/// Bore, torque, speed, safety, friction: small and large, slow and fast, greasy and dry.
const GRID: [(f64, f64, f64, f64, f64); 9] = [
    (40.0, 1000.0, 3000.0, 1.3, 0.11),
    (40.0, 300.0, 0.0, 2.0, 0.11),
    (10.0, 20.0, 0.0, 1.5, 0.12),
    (10.0, 5.0, 6000.0, 1.0, 0.10),
    (25.0, 250.0, 1500.0, 1.3, 0.08),
    (80.0, 4000.0, 1000.0, 1.3, 0.11),
    (150.0, 20_000.0, 500.0, 1.2, 0.11),
    (300.0, 60_000.0, 100.0, 1.5, 0.13),
    (60.0, 1500.0, 0.0, 1.5, 0.06),
];

#[test]
fn every_size_of_the_grid_holds_its_own_file() {
    for (bore, torque, rpm, safety, friction) in GRID {
        let ask = ask(bore, torque, rpm, safety, friction);
        let sized = sized(&ask).unwrap_or_else(|why| panic!("{ask:?}: {why}"));
        // Read anew from the text alone.
        let design = Design::parse(&sized.design.source, "again.toml").unwrap();
        let rows = margins(&design, &design.check_scenarios, &Settings::default()).unwrap();
        for row in rows.iter().filter(|r| r.required) {
            assert!(row.held(), "{ask:?}: {row:?}");
        }
        assert_eq!(design.check_scenarios.len(), 2);
        assert_eq!(design.limits.nominal_torque_nm, Some(torque));
        assert!((design.limits.peak_torque_nm.unwrap() / (safety * torque) - 1.0).abs() < 1e-5);
        assert_eq!(design.limits.keep_contact_to_rad_s.is_some(), rpm > 0.0);
        assert!(design.optimize.is_some());
        let r = design.clutch.races;
        assert!((r.inner_bore_radius_m / (0.5e-3 * bore) - 1.0).abs() < 1e-6);
        println!(
            "{bore} mm, {torque} Nm, {rpm} rpm, {safety}, {friction}: {} x {:.1} mm in {:.2} mm, {}",
            design.clutch.sprags.count,
            1e3 * design.clutch.sprags.length_m,
            1e3 * (r.outer_radius_m - r.inner_radius_m),
            sized.tried[sized.taken].decided_by
        );
    }
}

/// Sprags a millimetre shorter, races with them, keep less than a first design is to keep; and of the race spaces that hold
/// everything the one with the smallest ring is taken.
#[test]
fn the_width_is_the_shortest_that_the_limits_allow() {
    let ask = ask(40.0, 1000.0, 0.0, 1.3, 0.11);
    let sized = sized(&ask).unwrap();
    // A millimetre shorter keeps less than the 2 % that a first design keeps.
    let s = &sized.design.clutch.sprags;
    let (old, new) = (1e3 * s.length_m, 1e3 * s.length_m - 1.0);
    let race = 1e3 * sized.design.clutch.races.width_m;
    let text = sized
        .design
        .source
        .replacen(&format!("length_mm = {old:?}"), &format!("length_mm = {new:?}"), 1)
        .replacen(&format!("width_mm = {race:?}"), &format!("width_mm = {:?}", race - 1.0), 1);
    assert_ne!(text, sized.design.source);
    let shorter = Design::parse(&text, "shorter.toml").unwrap();
    let state = load_state(&shorter).unwrap();
    let rows = load_margins(&shorter, &shorter.limits, false, &state);
    let least = rows.iter().filter(|r| r.required).map(|r| r.margin()).fold(f64::INFINITY, f64::min);
    assert!(least < 0.02, "{least}");
    // The smallest ring of those that do it.
    let smallest = sized.tried.iter().filter(|t| t.held).map(|t| t.volume_m3).fold(f64::INFINITY, f64::min);
    assert_eq!(sized.tried[sized.taken].volume_m3, smallest);
}

#[test]
fn what_is_impossible_names_the_limit_and_the_nearest() {
    let ask = ask(40.0, 50_000.0, 0.0, 1.3, 0.11);
    let Err(NoSize::None { tried }) = sized(&ask) else { panic!("50 kNm on 40 mm") };
    let best = tried.iter().map(|t| t.carries_nm).fold(0.0, f64::max);
    assert!(best > 1000.0 && best < 50_000.0, "{tried:?}");
    let why = NoSize::None { tried }.to_string();
    assert!(why.contains("nearest carries") && why.contains("held up by"), "{why}");
    // What is said to be possible is possible.
    let nearly = Ask { torque_nm: 0.9 * best, ..ask };
    assert!(sized(&nearly).is_ok(), "{best}");
}

#[test]
fn nonsense_is_refused_with_what_is_allowed() {
    for (bad, words) in [
        (ask(0.0, 100.0, 0.0, 1.3, 0.11), ["bore", "1 to 2000 mm"]),
        (ask(40.0, -1.0, 0.0, 1.3, 0.11), ["torque", "0.001 to 10000000 Nm"]),
        (ask(40.0, 100.0, -3.0, 1.3, 0.11), ["speed", "0 to 60000 rpm"]),
        (ask(40.0, 100.0, 0.0, 0.5, 0.11), ["safety", "1 to 10"]),
        (ask(40.0, 100.0, 0.0, 1.3, f64::NAN), ["friction", "0.03 to 0.5"]),
        (ask(f64::INFINITY, 100.0, 0.0, 1.3, 0.1), ["bore", "found inf mm"]),
    ] {
        let why = sized(&bad).unwrap_err().to_string();
        assert!(words.iter().all(|w| why.contains(w)), "{why}");
    }
}

#[test]
fn the_command_writes_a_file_for_check_and_its_exit_codes_say_how_it_went() {
    let folder = Folder::new();
    let (new, page) = (folder.path("new.toml"), folder.path("new.html"));
    let args = [
        "size",
        "--bore",
        "40",
        "--torque",
        "1000",
        "--speed",
        "3000",
        "--safety",
        "1.3",
        "--friction",
        "0.11",
    ];
    let with = |more: &[&str]| run(&[&args[..], more].concat());
    let output = with(&["-o", &new, "--json", "--quiet", "--report", &page]);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let value = json(&output);
    assert_eq!(value["written"], new.as_str());
    assert!(value["tried"].as_array().unwrap().iter().any(|t| t["taken"] == true));
    is_self_contained(&page);
    let check = run(&["check", &new, "--json", "--quiet"]);
    assert_eq!(check.status.code(), Some(0), "{}", stdout(&check));
    let heavy = run(&["size", "--bore", "40", "--torque", "50000", "-o", &new]);
    assert_eq!(heavy.status.code(), Some(1));
    assert!(stdout(&heavy).contains("nearest carries"), "{}", stdout(&heavy));
    for bad in [["--bore", "0"], ["--bore", "x"], ["--torque", "-5"]] {
        let mut args = vec!["size", "--bore", "40", "--torque", "1000", "-o", &new];
        let at = args.iter().position(|a| *a == bad[0]).unwrap();
        args[at + 1] = bad[1];
        assert_eq!(run(&args).status.code(), Some(2), "{bad:?}");
    }
}
