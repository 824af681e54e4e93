//! `size`: what it writes holds its own limits, what it refuses it refuses in words.

use crate::program::*;

use std::f64::consts::PI;
use std::sync::OnceLock;

use sprag_design::Follow;
use sprag_design::answer::Answer;
use sprag_design::clutch::{Scenario, ScenarioKind};
use sprag_design::design::Design;
use sprag_design::margin::{Capacities, load_margins, load_state, margins};
use sprag_design::material::steel;
use sprag_design::report::Screen;
use sprag_design::scenario::{Settings, Verdict, prepare, simulate};
use sprag_design::size::{
    Decider, NoSize, PURPOSES, Requirements, Sized, Tried, WARMER_K, Wish, WouldDo, purpose, size,
};

fn stderr(output: &std::process::Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn wish(bore_mm: f64, torque_nm: f64) -> Wish {
    Wish { bore_m: Some(bore_mm / 1e3), torque_nm: Some(torque_nm), ..Wish::default() }
}

fn ask(bore_mm: f64, torque_nm: f64, rpm: f64, safety: f64, friction: f64) -> Requirements {
    Wish {
        keep_contact_rad_s: Some(rpm * PI / 30.0),
        peak_over_nominal: Some(safety),
        friction: Some(friction),
        ..wish(bore_mm, torque_nm)
    }
    .requirements()
}

fn sized(ask: &Requirements) -> Result<Sized, NoSize> {
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

/// One of them, sized once for all tests.
fn of_grid(k: usize) -> &'static Sized {
    static SIZED: [OnceLock<Sized>; GRID.len()] = [const { OnceLock::new() }; GRID.len()];
    let (bore, torque, rpm, safety, friction) = GRID[k];
    let ask = ask(bore, torque, rpm, safety, friction);
    SIZED[k].get_or_init(|| sized(&ask).unwrap_or_else(|why| panic!("{ask:?}: {why}")))
}

#[test]
fn every_size_of_the_grid_holds_its_own_file() {
    for (k, (bore, torque, rpm, safety, friction)) in GRID.into_iter().enumerate() {
        let ask = ask(bore, torque, rpm, safety, friction);
        let sized = of_grid(k);
        // Read anew from the text alone.
        let design = Design::parse(&sized.made.design.source, "again.toml").unwrap();
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
/// Overrun warms one race more than the other: the sprags are still between them then, and do not come to the end of their profile below
/// peak torque.
#[test]
fn a_first_design_is_a_clutch_while_one_race_is_warmer() {
    let helicopter = Wish { purpose: purpose("helicopter"), peak_nm: Some(1400.0), ..wish(46.0, 620.0) };
    let helicopter = sized(&helicopter.requirements()).unwrap();
    // A small one for twice its torque, a large one.
    for sized in [&helicopter, of_grid(1), of_grid(7)] {
        let (design, name) = (&sized.made.design, &sized.made.design.name);
        assert!(design.source.contains(&format!("one is {WARMER_K} K warmer than the other (choice)")));
        for (inner_c, outer_c) in [(60.0 + WARMER_K, 60.0), (60.0, 60.0 + WARMER_K), (120.0, 60.0)] {
            let values = [
                ("thermal.inner_race_c", inner_c),
                ("thermal.sprags_c", 0.5 * (inner_c + outer_c)),
                ("thermal.outer_race_c", outer_c),
            ];
            let warm = design.with_values(&values).unwrap_or_else(|why| panic!("{name} {values:?}: {why}"));
            let state = load_state(&warm).unwrap();
            let rows = load_margins(&warm, &warm.limits, Capacities::LeftOut, &state);
            let end = rows.iter().find(|r| r.code() == "end-of-profile").unwrap();
            assert!(end.held(), "{name} {values:?}: {end:?}");
        }
    }
}

#[test]
fn the_width_is_the_shortest_that_the_limits_allow() {
    let ask = ask(40.0, 1000.0, 0.0, 1.3, 0.11);
    let sized = sized(&ask).unwrap();
    // A millimetre shorter keeps less than the 2 % that a first design keeps.
    let s = &sized.made.design.clutch.sprags;
    let (old, new) = (1e3 * s.length_m, 1e3 * s.length_m - 1.0);
    let race = 1e3 * sized.made.design.clutch.races.width_m;
    let text = sized
        .made
        .design
        .source
        .replacen(&format!("length_mm = {old:?}"), &format!("length_mm = {new:?}"), 1)
        .replacen(&format!("width_mm = {race:?}"), &format!("width_mm = {:?}", race - 1.0), 1);
    assert_ne!(text, sized.made.design.source);
    let shorter = Design::parse(&text, "shorter.toml").unwrap();
    let state = load_state(&shorter).unwrap();
    let rows = load_margins(&shorter, &shorter.limits, Capacities::LeftOut, &state);
    let least = rows.iter().filter(|r| r.required).map(|r| r.margin()).fold(f64::INFINITY, f64::min);
    assert!(least < 0.02, "{least}");
    // The smallest ring of those that do it.
    let smallest = sized.tried.iter().filter(|t| t.held).map(|t| t.volume_m3).fold(f64::INFINITY, f64::min);
    assert_eq!(sized.tried[sized.taken].volume_m3, smallest);
}

#[test]
fn what_is_impossible_names_the_limit_and_the_nearest() {
    let ask = ask(40.0, 50_000.0, 0.0, 1.3, 0.11);
    let Err(why @ NoSize::None { .. }) = sized(&ask) else { panic!("50 kNm on 40 mm") };
    let NoSize::None { tried, .. } = &why else { unreachable!() };
    let best = tried.iter().map(|t| t.carries_nm).fold(0.0, f64::max);
    assert!(best > 1000.0 && best < 50_000.0, "{tried:?}");
    let words = why.to_string();
    assert!(words.contains("nearest carries") && words.contains("stopped by"), "{words}");
    // What is said to be possible is possible.
    let nearly = Requirements { torque_nm: 0.9 * best, peak_nm: 0.9 * 1.3 * best, ..ask };
    assert!(sized(&nearly).is_ok(), "{best}");
}

#[test]
fn a_bore_without_room_for_the_family_says_how_many_sprags_it_has_room_for() {
    let Err(NoSize::None { tried, .. }) = sized(&ask(2000.0, 1e5, 0.0, 1.3, 0.11)) else { panic!("2 m") };
    assert!(
        tried.len() == 7 && tried.iter().all(|t| t.decided_by == Decider::Count && t.count > 120),
        "{tried:?}"
    );
    let why = NoSize::None { tried, freed: Vec::new() }.to_string();
    assert!(why.contains("race space 25.00 mm: room for 343 sprags, the family has 8 to 120"), "{why}");
}

/// Makers' sprags are longer than they are high.
#[test]
fn sprags_are_at_least_as_long_as_the_race_space_is_high() {
    for tried in sized(&ask(10.0, 20.0, 0.0, 1.5, 0.11)).unwrap().tried.iter().filter(|t| t.held) {
        assert!(tried.length_m >= tried.space_m - 1e-9, "{tried:?}");
    }
}

#[test]
fn nonsense_is_refused_with_what_is_allowed() {
    for (bad, words) in [
        (ask(0.0, 100.0, 0.0, 1.3, 0.11), ["bore", "1 to 2000 mm"]),
        (ask(40.0, -1.0, 0.0, 1.3, 0.11), ["torque", "0.001 to 10000000 Nm"]),
        (ask(40.0, 100.0, -3.0, 1.3, 0.11), ["keep-contact-rpm", "0 to 60000 rpm"]),
        (ask(40.0, 100.0, 0.0, 0.5, 0.11), ["peak", "100 to 1000 Nm"]),
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
    // An edited design is not lost to a second run.
    std::fs::write(&new, std::fs::read_to_string(&new).unwrap() + "# my own work\n").unwrap();
    let again = with(&["-o", &new]);
    assert_eq!(again.status.code(), Some(2));
    assert!(std::fs::read_to_string(&new).unwrap().ends_with("# my own work\n"));
    assert!(stderr(&again).contains("--force"), "{}", stderr(&again));
    assert_eq!(with(&["-o", &new, "--force"]).status.code(), Some(0));
    std::fs::remove_file(&new).unwrap();
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

/// More room never loses a clutch: sprags too light to lift off are made longer.
#[test]
fn where_a_small_ring_does_it_a_larger_one_does() {
    let starter = Wish { purpose: purpose("starter"), ..wish(20.0, 130.0) };
    let outside_m = |d_mm: Option<f64>| {
        let wish = Wish { outside_m: d_mm.map(|d| d / 1e3), ..starter };
        let found = sized(&wish.requirements()).ok()?;
        Some(2e3 * found.made.design.clutch.races.outer_outside_radius_m)
    };
    for d in [45.0, 48.0, 49.2, 50.0, 56.0, 62.0] {
        assert!(outside_m(Some(d)).is_some_and(|found| found <= d + 1e-6), "{d} mm");
    }
    assert!(outside_m(None).unwrap() < 65.0);
}

#[test]
fn tracks_that_are_there_are_kept() {
    let housing = Wish {
        purpose: purpose("helicopter"),
        inner_track_m: Some(0.028),
        outer_track_m: Some(0.0447),
        ..wish(18.0, 130.0)
    };
    let found = sized(&housing.requirements()).unwrap();
    let r = &found.made.design.clutch.races;
    assert_eq!([r.inner_radius_m, r.outer_radius_m].map(|m| (1e6 * m).round()), [14000.0, 22350.0]);
    assert_eq!(found.tried.len(), 1);
    // One of them: the race space is chosen.
    let shaft = sized(&Wish { outer_track_m: None, ..housing }.requirements()).unwrap();
    assert_eq!((1e6 * shaft.made.design.clutch.races.inner_radius_m).round(), 14000.0);
    assert!(shaft.tried.len() > 1);
    let bore = sized(&Wish { inner_track_m: None, ..housing }.requirements()).unwrap();
    assert_eq!((1e6 * bore.made.design.clutch.races.outer_radius_m).round(), 22350.0);
    assert!(bore.tried.iter().any(|t| t.decided_by == Decider::Bore), "{:?}", bore.tried);
    let why = |wish: Wish| wish.check().unwrap_err().to_string();
    let inside = why(Wish { inner_track_m: Some(0.017), ..housing });
    assert!(inside.contains("inner-track: found 17 mm") && inside.contains("above the bore"), "{inside}");
    let none = why(Wish { outer_track_m: Some(0.0285), ..housing });
    assert!(none.contains("outer-track: found 28.5 mm; allowed: 31 to 108 mm"), "{none}");
}

#[test]
fn what_an_engineer_asks_for_is_kept_or_named_as_what_prevents_it() {
    let most = [0.105, 0.025];
    let asked = Wish { outside_m: Some(most[0]), width_m: Some(most[1]), ..wish(40.0, 600.0) };
    let sized_small = sized(&asked.requirements()).unwrap();
    for made in sized_small.tried.iter().filter_map(|t| t.made.as_ref()) {
        let r = made.design.clutch.races;
        assert!(2.0 * r.outer_outside_radius_m <= most[0] + 1e-9 && r.width_m <= most[1] + 1e-9, "{r:?}");
    }
    let tight = Wish { outside_m: Some(0.06), ..asked };
    let Err(why @ NoSize::None { .. }) = sized(&tight.requirements()) else {
        panic!("60 mm about a bore of 40")
    };
    let NoSize::None { tried, freed } = &why else { unreachable!() };
    // What to give more of is said, and does.
    let [WouldDo { outside_m: Some(outside_m), width_m: None }] = freed.as_slice() else {
        panic!("{freed:?}")
    };
    let told = (outside_m * 1e4 - 1e-6).ceil() / 10.0;
    assert!(why.to_string().ends_with(&format!("what would do: `outside` {told} mm")), "{why}");
    assert!(sized(&Wish { outside_m: Some(told / 1e3), ..asked }.requirements()).is_ok());
    assert!(sized(&Wish { outside_m: Some(0.98 * outside_m), ..asked }.requirements()).is_err());
    assert!(tried.iter().any(|t| t.decided_by == Decider::Outside), "{tried:?}");
    // A peak alone is a nominal torque by the factor.
    let peak = Wish { torque_nm: None, peak_nm: Some(780.0), ..asked }.requirements();
    assert!((peak.torque_nm - 600.0).abs() < 1e-9);
    // A softer steel is held at peak torque as `from_material` says, and asks for more.
    let soft = sized(&Wish { steel: steel("20MnCr5"), ..wish(40.0, 600.0) }.requirements()).unwrap();
    let hard = sized(&wish(40.0, 600.0).requirements()).unwrap();
    assert_eq!(soft.made.design.limits.hoop_inner_pa, Some(600e6));
    assert!(soft.made.mass_kg > hard.made.mass_kg);
    // Drag is the spring's, and its heat at the sliding speed.
    let drag = hard.made.drag.unwrap();
    assert!(drag.torque_nm > 0.0 && drag.heat_w() == drag.torque_nm * drag.sliding_rad_s);
}

#[test]
fn sprags_that_are_to_lift_off_are_off_by_that_speed_and_on_below() {
    let rad_s = |rpm: f64| rpm * PI / 30.0;
    let ask = Wish {
        keep_contact_rad_s: Some(rad_s(250.0)),
        lift_off_rad_s: Some(rad_s(900.0)),
        outer_rad_s: Some(rad_s(900.0)),
        ..wish(40.0, 500.0)
    };
    let made = sized(&ask.requirements()).unwrap().made;
    let state = load_state(&made.design).unwrap();
    let off = sprag_design::margin::lift_off_rad_s(&made.design, &state, rad_s(2000.0)).unwrap();
    assert!(rad_s(250.0) < off && off < rad_s(900.0), "{off}");
    assert_eq!(made.drag.unwrap().torque_nm, 0.0);
}

/// A backstop whose inner race runs fast: a cage on that race, and a centroid ahead of its pivot.
#[test]
fn a_backstop_that_is_to_lift_off_has_a_cage_and_does() {
    let rad_s = |rpm: f64| rpm * PI / 30.0;
    let ask = Wish {
        purpose: purpose("backstop"),
        lift_off_rad_s: Some(rad_s(1500.0)),
        inner_rad_s: Some(rad_s(1800.0)),
        ..wish(40.0, 400.0)
    };
    let made = sized(&ask.check().unwrap()).unwrap().made;
    assert!(made.design.clutch.cage.is_some() && made.design.source.contains("[cage]"));
    let state = load_state(&made.design).unwrap();
    let off = sprag_design::margin::lift_off_rad_s(&made.design, &state, rad_s(2000.0)).unwrap();
    assert!(off < rad_s(1500.0), "{off}");
    assert_eq!(made.drag.unwrap().torque_nm, 0.0);
    let at =
        |rpm: f64| sprag_design::margin::overrun_at(&made.design, &state, 0.0, rad_s(rpm)).unwrap().state;
    assert!(at(100.0).sliding_n > 0.0 && at(1500.0).sliding_n == 0.0);
    // Without the wish there is none.
    assert!(
        sized(&Wish { lift_off_rad_s: None, ..ask }.check().unwrap())
            .unwrap()
            .made
            .design
            .clutch
            .cage
            .is_none()
    );
}

/// A window of the flanks just wide enough for the reserve at either end.
#[test]
fn a_low_lift_off_speed_of_a_backstop_ends_in_an_answer() {
    let ask =
        Wish { purpose: purpose("backstop"), lift_off_rad_s: Some(350.0 * PI / 30.0), ..wish(60.0, 900.0) };
    let made = sized(&ask.check().unwrap()).unwrap().made;
    assert!(made.least().unwrap().held());
}

/// The damper between the races brakes the overrun by a tenth of the spring's drag, not by a multiple of all drag.
#[test]
fn the_damping_of_a_new_clutch_is_a_small_part_of_its_drag() {
    for (name, rpm) in [("two-speed", 1000.0), ("helicopter", 6000.0), ("starter", 900.0)] {
        let ask = Wish { purpose: purpose(name), ..wish(40.0, 400.0) };
        let design = sized(&ask.check().unwrap()).unwrap().made.design;
        let [viscous, spring] =
            [design.clutch.races.viscous_damping_nm_s_per_rad, design.clutch.spring.drag_torque_nm];
        assert!((viscous * rpm * PI / 30.0 / spring - 0.1).abs() < 1e-3, "{name}: {viscous} {spring}");
        // Overrun ends in a grip without a jump that throws the sprags off.
        let engage = simulate(design.scenario("engage").unwrap(), &Settings::default()).unwrap();
        assert_eq!((engage.verdict, engage.contact_lost_s), (Some(Verdict::Sticks), 0.0), "{name}");
    }
}

/// On a terminal of 80 columns each limit is one line, its verdict too.
fn fits_80_columns(design: &Design) {
    let found = design.check(&Follow::nobody()).unwrap();
    let text = found.text(Screen { colour: false, columns: Some(80) });
    assert_eq!(text.matches("Verdict").count(), 1, "{text}");
    let table = text.lines().skip(1).take_while(|line| !line.contains("HELD: "));
    let widest = table.map(|line| line.chars().count()).max();
    assert!((60..=80).contains(&widest.unwrap()), "{widest:?} {text}");
}

#[test]
fn every_purpose_gives_a_file_that_is_held_and_tells_its_guesses() {
    let folder = Folder::new();
    for purpose in &PURPOSES {
        let file = folder.path(&format!("{}.toml", purpose.name));
        let args = ["new", "--for", purpose.name, "--bore", "30", "--torque", "200", "-o", &file];
        let made = run(&args);
        assert_eq!(made.status.code(), Some(0), "{}", stderr(&made));
        assert!(stdout(&made).contains("sprag-design studio"), "{}", stdout(&made));
        let design = Design::read(file.as_ref()).unwrap();
        assert!(
            design.scenario("engage").is_some() && design.source.contains("# guess"),
            "{}",
            design.source
        );
        assert_eq!(design.check_scenarios.contains(&"swing".to_owned()), purpose.excitation.is_some());
        if ["two-speed", "starter"].contains(&purpose.name) {
            fits_80_columns(&design);
        }
    }
}

#[test]
fn new_names_what_it_needs_where_nobody_can_be_asked() {
    for (args, words) in [
        (&["new"][..], "--for PURPOSE, --bore MM, --torque NM or --peak NM, -o NEW.toml"),
        (&["new", "--for", "starter", "--bore", "40", "-o", "x.toml"], "needed: --torque NM or --peak NM"),
        (&["new", "--for", "winch", "--bore", "40"], "backstop"),
        (&["size", "--bore", "40", "-o", "x.toml"], "needed: --torque NM or --peak NM"),
    ] {
        let refused = run(args);
        assert_eq!(refused.status.code(), Some(2), "{args:?}");
        assert!(stderr(&refused).contains(words), "{}", stderr(&refused));
    }
}

#[test]
fn a_torque_that_swings_as_asked_is_a_scene_of_the_file() {
    let helicopter = purpose("helicopter");
    let asked =
        Wish { purpose: helicopter, swing_nm: Some(135.0), swing_hz: Some(400.0), ..wish(55.0, 900.0) };
    let design = sized(&asked.requirements()).unwrap().made.design;
    let swing = design.scenarios.iter().find(|s| s.name == "swing").unwrap();
    let ScenarioKind::TorsionalExcitation { preload_nm, amplitude_nm, frequency_hz, duration_s, .. } =
        swing.kind
    else {
        panic!("{:?}", swing.kind);
    };
    assert_eq!((preload_nm, amplitude_nm, frequency_hz, duration_s), (765.0, 135.0, 400.0, 0.02));
    // None, and more than would leave the torque its sign.
    let still = Wish { swing_nm: Some(0.0), ..asked };
    assert_eq!(still.requirements().swing, None);
    let too_much = Wish { swing_nm: Some(451.0), ..asked }.requirements().check().unwrap_err();
    assert_eq!((too_much.what, too_much.found.as_str()), ("swing", "451 Nm"));
}

#[test]
fn the_race_that_runs_ahead_is_the_one_that_was_asked_for() {
    for (inner, outer) in [(0.0, 900.0), (300.0, 900.0), (900.0, 300.0)] {
        let rad_s = |rpm: f64| Some(rpm * PI / 30.0);
        let asked = Wish {
            inner_rad_s: rad_s(inner),
            outer_rad_s: rad_s(outer),
            purpose: purpose("starter"),
            ..wish(40.0, 600.0)
        };
        let design = sized(&asked.requirements()).unwrap().made.design;
        let overrun = design.scenarios.iter().find(|s| s.name == "overrun").unwrap();
        let ScenarioKind::Overrun { speed_rad_s, overrun_rad_s } = overrun.kind else { panic!() };
        let speeds = [speed_rad_s + overrun_rad_s, speed_rad_s].map(|w| w * 30.0 / PI);
        assert!((speeds[0] - inner).abs() < 1e-9 && (speeds[1] - outer).abs() < 1e-9, "{speeds:?}");
        // The sprags ride with the outer race and feel the speed of sliding alone: either way round the same forces.
        let drag = |ahead: f64| {
            let kind = ScenarioKind::Overrun { speed_rad_s, overrun_rad_s: ahead };
            let prepared = prepare(&Scenario { kind, ..overrun.clone() }).unwrap();
            prepared.overrun.map(|o| (o.drag_torque_nm, o.normal_inner_n))
        };
        assert_eq!(drag(overrun_rad_s), drag(-overrun_rad_s));
    }
}

#[test]
fn an_outer_diameter_that_is_too_small_names_the_one_that_would_do() {
    let asked = Wish { outside_m: Some(0.06), ..wish(40.0, 600.0) };
    let Err(NoSize::None { tried, .. }) = sized(&asked.requirements()) else { panic!("60 mm do") };
    let barred: Vec<&Tried> = tried.iter().filter(|t| t.decided_by == Decider::Outside).collect();
    assert!(!barred.is_empty() && barred.iter().all(|t| t.outside_m > 0.06 + 1e-6));
    let wider = Wish { outside_m: Some(barred[0].outside_m + 1e-6), ..asked };
    let again = match sized(&wider.requirements()) {
        Ok(Sized { tried, .. }) | Err(NoSize::None { tried, .. }) => tried,
        Err(why) => panic!("{why}"),
    };
    let same = again.iter().find(|t| t.space_m == barred[0].space_m).unwrap();
    assert_ne!(same.decided_by, Decider::Outside);
}

/// What cannot be is refused with how to mend it: a bore in inches, sprags that nothing throws off, a speed of contact above that of
/// the purpose's lift-off.
#[test]
fn wishes_that_cannot_be_are_refused_in_words() {
    let why = |wish: Wish| wish.check().unwrap_err().to_string();
    let inches = why(Wish { purpose: purpose("starter"), ..wish(1.378, 420.0) });
    assert!(inches.contains("1.378 mm") && inches.contains("an inch is 25.4"), "{inches}");
    assert!(wish(40.0, 5e4).check().is_ok());
    let rad_s = |rpm: f64| Some(rpm * PI / 30.0);
    let backstop = Wish { purpose: purpose("Backstop"), lift_off_rad_s: rad_s(300.0), ..wish(80.0, 6000.0) };
    let slow = why(Wish { outer_rad_s: rad_s(50.0), ..backstop });
    assert!(slow.contains("lift-off-rpm: found 300 rpm") && slow.contains("turns at 50 rpm"), "{slow}");
    // Its outer race stands: the inner one throws them off, and runs as fast as that.
    let carried = backstop.check().unwrap();
    assert!(
        carried.carried && (carried.overrun_rad_s[0] - rad_s(300.0).unwrap()).abs() < 1e-9,
        "{carried:?}"
    );
    let slow = why(Wish { inner_rad_s: rad_s(200.0), ..backstop });
    assert!(slow.contains("inner race turns at 200 rpm") && slow.contains("inner-rpm"), "{slow}");
    // Without a cage they ride with the outer race, which stands.
    let held = why(Wish { lift_off_rad_s: None, keep_contact_rad_s: rad_s(300.0), ..backstop });
    assert!(held.contains("keep-contact-rpm: found 300 rpm") && held.contains("lift-off-rpm"), "{held}");
    let keep =
        why(Wish { purpose: purpose("starter"), keep_contact_rad_s: rad_s(1500.0), ..wish(35.0, 420.0) });
    assert!(keep.contains("keep-contact-rpm: found 1500 rpm; allowed: up to 900 rpm"), "{keep}");
    // The engine that throws them off at 1000 rpm runs at 1000 rpm.
    let later = Wish { purpose: purpose("starter"), lift_off_rad_s: rad_s(1000.0), ..wish(35.0, 420.0) };
    let wanted = later.check().unwrap();
    assert!((wanted.overrun_rad_s[1] - wanted.lift_off_rad_s.unwrap()).abs() < 1e-9);
}

/// A purpose that keeps contact keeps it at the speed that somebody names for its outer race; one that does not, or that is told a speed, does not.
#[test]
fn contact_is_kept_at_the_outer_speed_that_is_asked_for() {
    let rad_s = |rpm: f64| rpm * PI / 30.0;
    let kept = |name: &str, outer: Option<f64>, keep: Option<f64>| {
        let of = |rpm: Option<f64>| rpm.map(rad_s);
        let wish = Wish {
            purpose: purpose(name),
            outer_rad_s: of(outer),
            keep_contact_rad_s: of(keep),
            ..wish(40.0, 1000.0)
        };
        let kept = wish.requirements();
        (kept.keep_contact_rad_s.map(|w| (w * 30.0 / PI).round()), kept.contact_from[0])
    };
    assert_eq!(kept("two-speed", None, None), (Some(2000.0), "guess: the lower gear"));
    assert_eq!(kept("two-speed", Some(6000.0), None), (Some(6000.0), "the outer race in overrun"));
    assert_eq!(kept("two-speed", Some(1000.0), None).0, Some(2000.0));
    assert_eq!(kept("two-speed", Some(6000.0), Some(2500.0)), (Some(2500.0), "asked for"));
    assert_eq!(kept("starter", Some(1200.0), None).0, Some(250.0));
    assert_eq!(kept("backstop", Some(100.0), None).0, None);
}

/// What nobody said of the inertias is listed, what is shown and broken is told, and what rests on a guess says so.
#[test]
fn guessed_inertias_and_broken_shown_rows_are_told() {
    let folder = Folder::new();
    let path = folder.path("idx.toml");
    let new = run(&["new", "--for", "indexing", "--bore", "15", "--torque", "20", "-o", &path]);
    let said = stdout(&new);
    let taken = said.lines().find(|l| l.contains("turns with inner race")).unwrap();
    assert!(taken.contains("kg m²") && taken.contains("guess") && taken.contains("feed"), "{taken}");
    assert!(said.contains("turns with outer race"), "{said}");
    let broken = said.lines().find(|l| l.starts_with("Shown only, and broken")).unwrap();
    assert!(broken.contains("contact:engage") && broken.contains("--scenario engage"), "{broken}");
    let verdict = |arguments: &[&str]| {
        let output =
            run(&[&["feed", &path, "--stroke", "30", "--frequency", "10", "--json"], arguments].concat());
        serde_json::from_slice::<serde_json::Value>(&output.stdout).unwrap()["verdict"]
            .as_str()
            .unwrap()
            .to_owned()
    };
    let guessed = verdict(&[]);
    assert!(guessed.contains("a guess of the file") && guessed.contains("--inertia"), "{guessed}");
    assert!(!verdict(&["--inertia", "0.0001"]).contains("guess"));
    let slip = stdout(&run(&["reengage", &path, "--outer-free", "--paths", "0.1"]));
    assert!(slip.contains("The outer race turns as a bare ring"), "{slip}");
}
