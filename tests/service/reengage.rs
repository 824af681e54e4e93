//! Slip and the blow after it: held against the balance of energy, limits, and from outside.

use crate::program::*;
use sprag_design::answer::reengagement::ReengagementSettings;
use sprag_design::answer::{Answer, Finding};
use sprag_design::dynamics::Stop;
use sprag_design::reengage::{Blow, Blows, SlipUnderLoad, blows, by_energy_nm, taken_up_j};
use sprag_design::{Design, Follow, WedgeCurve};

const FILE: &str = "designs/starter.toml";

fn case(friction: f64, inertia_kg_m2: [f64; 2], paths_m: &[f64]) -> SlipUnderLoad {
    SlipUnderLoad {
        torque_nm: 50.0,
        speed_rad_s: 0.0,
        inertia_kg_m2,
        outer_held: false,
        friction,
        paths_m: paths_m.to_vec(),
    }
}

fn found(case: &SlipUnderLoad) -> Blows {
    let design = Design::read(FILE.as_ref()).unwrap();
    blows(&design.clutch, case, &Follow::nobody()).unwrap()
}

fn peak(blow: &Blow) -> f64 {
    blow.peak.unwrap().torque_nm
}

/// Blows over friction and inertia: each is that of its own case; what holds does not slip; the heavier the race the harder the blow, and less
/// friction lets it run faster.
#[test]
fn blows_over_friction_and_inertia() {
    let design = Design::read(FILE.as_ref()).unwrap();
    let frictions = [0.04, 0.06, 0.11];
    let asked = ReengagementSettings {
        torque_nm: Some(50.0),
        inertia_kg_m2: [Some(0.05), Some(0.05)],
        friction: Some(0.06),
        paths_m: vec![1e-4, 1e-3],
        over_friction: frictions.to_vec(),
        over_inner_inertia_kg_m2: vec![0.01, 0.05],
        ..ReengagementSettings::default()
    };
    let answer = design.reengagement(&asked).unwrap();
    assert_eq!(answer.over.len(), 12);
    for at in &answer.over {
        let own = found(&case(at.friction, [at.inner_inertia_kg_m2, 0.05], &[1e-4, 1e-3]));
        assert_eq!(own.holds.is_some(), at.holds);
        assert_eq!(at.blow.as_ref(), own.list.get(usize::from(at.path_m == 1e-3)));
    }
    let blow = |friction: f64, inertia: f64| {
        let at = |b: &&sprag_design::answer::reengagement::BlowAt| {
            b.friction == friction && b.inner_inertia_kg_m2 == inertia && b.path_m == 1e-4
        };
        answer.over.iter().find(at).unwrap().clone()
    };
    assert!(blow(0.11, 0.05).holds && blow(0.11, 0.05).blow.is_none());
    let speed = |at: sprag_design::answer::reengagement::BlowAt| at.blow.unwrap().speed_rad_s;
    assert!(speed(blow(0.04, 0.05)) > speed(blow(0.06, 0.05)));
    assert!(speed(blow(0.06, 0.01)) > speed(blow(0.06, 0.05)));
    let text = answer.text(Default::default());
    assert!(text.contains("μ in slip") && text.contains("no slip"), "{text}");
    let refused = design.reengagement(&ReengagementSettings { over_friction: vec![-0.1], ..asked });
    assert!(refused.is_err());
}

/// The integral by the midpoint rule over the windup, which is another path through the curve than the one of the library.
#[test]
fn the_torque_by_energy_holds_that_energy() {
    let clutch = Design::read(FILE.as_ref()).unwrap().clutch;
    let curve = WedgeCurve::build(&clutch, &clutch.profile().unwrap(), 0.0).unwrap();
    for (torque_nm, energy_j) in [(50.0, 1.0), (50.0, 20.0), (300.0, 5.0), (50.0, 1e-4)] {
        let most = by_energy_nm(&curve, torque_nm, energy_j).unwrap();
        let windup = |nm: f64| curve.at_torque(nm).unwrap().windup_rad;
        let n = 5_000;
        let step = (most - torque_nm) / f64::from(n);
        let windups: Vec<f64> = (0..=n).map(|k| windup(torque_nm + step * f64::from(k))).collect();
        let midway = (0..n).map(|k| step * (f64::from(k) + 0.5));
        let work: f64 = midway.zip(windups.windows(2)).map(|(nm, w)| nm * (w[1] - w[0])).sum();
        assert!((work / energy_j - 1.0).abs() < 1e-3, "{torque_nm} {energy_j}: {work}");
    }
    assert_eq!(by_energy_nm(&curve, 50.0, 1e6), None);
    for until_nm in [60.0, 400.0, 1500.0] {
        let energy_j = taken_up_j(&curve, 50.0, until_nm).unwrap();
        let back_nm = by_energy_nm(&curve, 50.0, energy_j).unwrap();
        assert!((back_nm / until_nm - 1.0).abs() < 1e-9, "{until_nm} {back_nm}");
    }
    let end_j = taken_up_j(&curve, 50.0, f64::INFINITY).unwrap();
    assert!(by_energy_nm(&curve, 50.0, 0.999 * end_j).is_some());
    assert!(by_energy_nm(&curve, 50.0, 1.001 * end_j).is_none());
}

fn settings(friction: f64, paths_m: &[f64]) -> ReengagementSettings {
    ReengagementSettings {
        torque_nm: Some(50.0),
        inertia_kg_m2: [Some(0.05); 2],
        friction: Some(friction),
        paths_m: paths_m.to_vec(),
        ..ReengagementSettings::default()
    }
}

/// Where a blow is not borne, what would be: a little less is borne, a little more is not.
#[test]
fn what_is_borne_is_the_border() {
    let design = Design::read(FILE.as_ref()).unwrap();
    let answer = design.reengagement(&settings(0.06, &[1e-3, 0.1])).unwrap();
    let borne = answer.borne.unwrap();
    let path_m = borne.path_m.unwrap();
    let held =
        |friction: f64, path_m: f64| design.reengagement(&settings(friction, &[path_m])).unwrap().held();
    assert!((1e-3..0.1).contains(&path_m) && borne.friction == Some(0.06), "{borne:?}");
    assert!(held(0.06, path_m) && !held(0.06, 1.01 * path_m), "{path_m}");
    // So little friction that the sprags are thrown out, however short the slip.
    let light = |friction: f64| ReengagementSettings {
        inertia_kg_m2: [Some(5.55e-4), Some(4.31e-3)],
        ..settings(friction, &[1e-3])
    };
    let thrown = design.reengagement(&light(0.03)).unwrap();
    let from = thrown.borne.unwrap().friction.unwrap();
    let holds = |friction: f64| design.reengagement(&light(friction)).unwrap().held();
    assert!(!thrown.held() && from < thrown.found.needs && holds(from) && !holds(0.995 * from), "{from}");
    // Held: nothing more is asked.
    assert!(design.reengagement(&settings(0.06, &[1e-3])).unwrap().borne.is_none());
    // The energy is that of the motion, and its share that of the windup up to the limit.
    let body = serde_json::to_value(answer.envelope(0.0).body).unwrap();
    let blow = &body["blows"][0];
    let speed = blow["speed_rpm"].as_f64().unwrap() * std::f64::consts::PI / 30.0;
    assert!((blow["energy_j"].as_f64().unwrap() / (0.5 * 0.025 * speed * speed) - 1.0).abs() < 1e-12);
    assert!(body["bears_j"].as_f64().unwrap() <= body["end_of_curve_j"].as_f64().unwrap(), "{body}");
}

/// Sprags that centrifugal force holds open beyond the reach of their spring: told as such, by their energy, while those that still come
/// back at that speed do.
#[test]
fn sprags_that_float_open_are_out_of_reach() {
    let design = Design::read("designs/huang2017-multi-arc.toml".as_ref()).unwrap();
    let speed_rad_s = 12_000.0 * std::f64::consts::PI / 30.0;
    let inertia_kg_m2 = [design.clutch.races.inner_inertia_kg_m2, design.clutch.races.outer_inertia_kg_m2];
    let one = |friction: f64, outer_held: bool| {
        let case = SlipUnderLoad { speed_rad_s, outer_held, ..case(friction, inertia_kg_m2, &[1e-3]) };
        blows(&design.clutch, &case, &Follow::nobody()).unwrap()
    };
    let floats = one(0.0841, false);
    assert_eq!((floats.ended, floats.list[0].ended), (None, Some(Stop::FellAway)), "{floats:?}");
    // A little farther out they are not yet held: the outer race, which runs ahead, presses them in.
    let comes_back = one(0.0838, false);
    assert_eq!(comes_back.list[0].ended, Some(Stop::CurveEnd), "{comes_back:?}");
    assert_eq!(one(0.0869, false).list[0].ended, None);
    let asked = ReengagementSettings {
        torque_nm: Some(50.0),
        friction: Some(0.0841),
        paths_m: vec![1e-3],
        ..ReengagementSettings::default()
    };
    let mut answer = design.reengagement(&asked).unwrap();
    assert!(answer.verdict().contains("out of reach"), "{}", answer.verdict());
    assert_eq!(answer.outcome(), Finding::NotHeld);
    // Stopped on the way to what would be borne: said, and no verdict that scripts may take for whole.
    answer.borne_stopped = true;
    assert_eq!(answer.outcome(), Finding::Stopped);
    assert!(answer.text(Default::default()).contains("stopped before what would be borne"));
}

/// The races run as the file lets them where they carry torque; overrun does not count.
#[test]
fn the_speed_is_that_of_the_file() {
    let speed = |file: &str, given: Option<f64>| {
        let design = Design::read(file.as_ref()).unwrap();
        let asked = ReengagementSettings { speed_rad_s: given, ..ReengagementSettings::default() };
        let body = serde_json::to_value(design.reengagement(&asked).unwrap().envelope(0.0).body).unwrap();
        (body["speed_rpm"].as_f64().unwrap().round(), body["speed_of"].is_string())
    };
    assert_eq!(speed(FILE, None), (0.0, false));
    assert_eq!(speed("designs/two-speed-rotor.toml", None), (3000.0, true));
    assert_eq!(speed("designs/two-speed-rotor.toml", Some(0.0)), (0.0, false));
}

/// Nothing comes from nowhere: slip while the load rises takes a little, the sprags' own motion brings a little.
#[test]
fn a_blow_is_what_the_energy_of_the_races_allows() {
    let one = found(&case(0.06, [0.05, 0.05], &[1e-4, 1e-3, 1e-2]));
    assert!(one.ended.is_none() && one.holds.is_none() && one.list.len() == 3);
    for blow in &one.list {
        let lost = 1.0 - peak(blow) / blow.by_energy_nm.unwrap();
        assert!(lost.abs() < 0.005, "{lost} {blow:?}");
        assert!(blow.peak_s.unwrap() > blow.slip_s && blow.path_in_all_m.unwrap() > blow.path_m);
    }
    // A short slip lasts as long as the sprags fly: half the path makes no difference.
    let shorter = found(&case(0.06, [0.05, 0.05], &[5e-5]));
    assert!((peak(&shorter.list[0]) / peak(&one.list[0]) - 1.0).abs() < 0.05);
    // A long one: the torque drives the inertia of both against one another, w^2 = 2 C s/(J R), less what is passed on.
    let long = &one.list[2];
    let radius_m = Design::read(FILE.as_ref()).unwrap().clutch.races.inner_radius_m;
    let free = |path_m: f64| (2.0 * 50.0 * path_m / (0.025 * radius_m)).sqrt();
    let (least, most) = (0.95 * free(long.path_m), free(long.path_in_all_m.unwrap()));
    assert!((least..most).contains(&long.speed_rad_s), "{} {least} {most}", long.speed_rad_s);
}

/// Only the inertia of the races against one another counts.
#[test]
fn inertias_change_places() {
    let [a, b] = [[0.02, 0.3], [0.3, 0.02]].map(|inertia| found(&case(0.06, inertia, &[1e-3])));
    assert!((peak(&a.list[0]) / peak(&b.list[0]) - 1.0).abs() < 0.02, "{a:?} {b:?}");
}

/// What cannot move is what nothing can move: a race held is one of an inertia beyond all others.
#[test]
fn an_outer_race_that_is_held_is_one_of_endless_inertia() {
    let paths = [1e-4, 1e-3, 1e-2];
    let held = found(&SlipUnderLoad { outer_held: true, ..case(0.06, [0.05, 0.05], &paths) });
    let heavy = found(&case(0.06, [0.05, 1e7], &paths));
    for (held, heavy) in held.list.iter().zip(&heavy.list) {
        assert!((peak(held) / peak(heavy) - 1.0).abs() < 1e-5, "{held:?} {heavy:?}");
        let lost = 1.0 - peak(held) / held.by_energy_nm.unwrap();
        assert!(lost.abs() < 0.005, "{lost}");
    }
    assert_eq!(held.list.len(), 3);
}

/// Sprags that do not come back are told of with numbers: where they left, and what the torque does to the races from there on.
#[test]
fn sprags_that_are_thrown_out_leave_the_races_to_the_torque() {
    let paths = [1e-4, 1e-3, 1e-2];
    let at_speed = SlipUnderLoad {
        speed_rad_s: 5000.0 * std::f64::consts::PI / 30.0,
        ..case(0.06, [0.05, 0.05], &paths)
    };
    let thrown = found(&at_speed);
    let end = thrown.ended.unwrap();
    assert_eq!((end.stop, thrown.list.len()), (Stop::FellAway, 3));
    assert!(end.path_m < 1e-3 && end.outer_rad_s > 500.0, "{end:?}");
    let radius_m = Design::read(FILE.as_ref()).unwrap().clutch.races.inner_radius_m;
    for blow in thrown.list.iter().filter(|b| b.path_m > end.path_m) {
        // Work of the torque on the way, as energy of the motion of the races against one another.
        let work_j = 50.0 * (blow.path_m - end.path_m) / radius_m;
        let gained_j = 0.5 * 0.025 * (blow.speed_rad_s.powi(2) - end.speed_rad_s.powi(2));
        assert!((gained_j / work_j - 1.0).abs() < 1e-9, "{gained_j} {work_j}");
        assert!(
            blow.peak.is_none() && blow.by_energy_nm.unwrap() > 50.0 && blow.ended == Some(Stop::FellAway)
        );
    }
}

#[test]
fn what_holds_and_what_is_thrown_out_are_answers() {
    let holds = found(&case(0.09, [0.05, 0.05], &[1e-3]));
    assert!(holds.list.is_empty() && (0.06..0.075).contains(&holds.holds.unwrap()), "{holds:?}");
    let thrown = found(&case(0.03, [5.55e-4, 4.31e-3], &[1e-3, 1e-2]));
    assert_eq!(thrown.ended.unwrap().stop, Stop::FellAway, "{thrown:?}");
}

#[test]
fn the_command_in_every_form() {
    let folder = Folder::new();
    let (csv, page) = (folder.path("blow.csv"), folder.path("blow.html"));
    let args = ["reengage", FILE, "--torque", "50", "--friction", "0.06", "--paths", "1,3"];
    let inertias = ["--inner-inertia", "0.05", "--outer-inertia", "0.05"];
    let output =
        run(&[&args[..], &inertias, &["--json", "--csv", &csv, "--report", &page, "--quiet"]].concat());
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let value = json(&output);
    assert!(value["left_out"].as_array().unwrap().iter().any(|l| l["term"] == "shafts"));
    assert_eq!(value["blows"].as_array().unwrap().len(), 2);
    let torque = value["blows"][0]["peak_torque_nm"].as_f64().unwrap();
    let by_hand = peak(&found(&case(0.06, [0.05, 0.05], &[1e-3])).list[0]);
    assert_eq!(torque.to_bits(), by_hand.to_bits());
    assert_eq!(std::fs::read_to_string(csv).unwrap().lines().count(), 3);
    assert!(is_self_contained(page).contains("blow"));
    let thrown = run(&["reengage", FILE, "--torque", "50", "--friction", "0.03", "--quiet"]);
    assert_eq!(thrown.status.code(), Some(1));
    assert!(stdout(&thrown).contains("thrown farther than their spring reaches"), "{}", stdout(&thrown));
    let held = run(&[
        "reengage",
        FILE,
        "--torque=50",
        "--friction=0.06",
        "--inner-inertia=0.05",
        "--outer-held",
        "--json",
        "--quiet",
    ]);
    assert!(json(&held)["outer_held"] == true && json(&held)["inertia_outer_kg_m2"].is_null(), "{held:?}");
    for (wrong, word) in
        [("--paths=3,1", "each longer"), ("--torque=-1", "above zero"), ("--outer-inertia=1", "--outer-held")]
    {
        let refused = run(&["reengage", FILE, wrong, "--outer-held", "--friction", "0.06"]);
        assert_eq!(refused.status.code(), Some(2));
        assert!(String::from_utf8_lossy(&refused.stderr).contains(word), "{refused:?}");
    }
}

#[test]
fn a_blow_that_is_not_borne_says_a_next_step_in_tables_that_fit_a_terminal() {
    let text = stdout(&run(&["reengage", FILE, "--quiet"]));
    let table =
        text.lines().filter(|l| l.contains("NOT HELD") || l.contains("OVERLOADED") || l.contains("───"));
    assert!(table.clone().count() > 2 && table.clone().all(|l| l.chars().count() <= 80), "{text}");
    assert!(
        text.contains("NOT HELD")
            && text.contains("Next: ")
            && text.contains("optimize --objective slip-margin"),
        "{text}"
    );
    let held = stdout(&run(&[
        "reengage",
        FILE,
        "--torque",
        "50",
        "--friction",
        "0.06",
        "--inner-inertia",
        "0.05",
        "--outer-inertia",
        "0.05",
    ]));
    assert!(held.contains("HELD:") && !held.contains("Next: "), "{held}");
}
