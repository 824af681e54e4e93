//! Strokes of an indexing drive: held against statics, a clutch without inertia of its own, and from outside.

use crate::program::*;
use sprag_design::answer::feed::{FeedSettings, NoFeed};
use sprag_design::answer::{Answer, Provenance};
use sprag_design::dynamics::Stop;
use sprag_design::feed::{Fed, Strokes, fed};
use sprag_design::report::Screen;
use sprag_design::{Design, Follow, WedgeCurve};
use std::f64::consts::TAU;

const FILE: &str = "designs/indexing.toml";

fn case(frequency_hz: f64) -> Strokes {
    let stroke_rad = 30.0_f64.to_radians();
    Strokes { stroke_rad, frequency_hz, brake_nm: 100.0, inertia_kg_m2: 0.02, inner_drives: false }
}

fn clutch() -> sprag_design::Clutch {
    Design::read(FILE.as_ref()).unwrap().clutch
}

fn found(case: &Strokes) -> Fed {
    let found = fed(&clutch(), case, &Follow::nobody()).unwrap();
    assert_eq!(found.ended, None);
    found
}

fn curve() -> WedgeCurve {
    let clutch = clutch();
    WedgeCurve::build(&clutch, &clutch.profile().unwrap(), 0.0).unwrap()
}

/// The fed race stands until the clutch carries the torque of the brake, and goes with the driving one from then on.
#[test]
fn a_slow_stroke_feeds_the_stroke_less_the_windup() {
    let windup_rad = curve().at_torque(100.0).unwrap().windup_rad;
    let off: Vec<f64> =
        [0.5, 0.1].map(|hz| (found(&case(hz)).error_rad + windup_rad).abs() / windup_rad).to_vec();
    assert!(off[0] < 5e-3 && off[1] < 3e-4, "{off:?}");
}

/// The file's own spring, asked for as one of several, ends where the file does. Where little is moved, sprags that come back too late
/// end it: in a time that goes with the root of their inertia over the moment of the spring. What makes no sense is refused.
#[test]
fn a_stronger_spring_feeds_as_it_should_at_faster_strokes() {
    let design = Design::read(FILE.as_ref()).unwrap();
    let asked = FeedSettings {
        stroke_rad: 12.0_f64.to_radians(),
        frequencies_hz: vec![10.0, 20.0, 40.0, 80.0, 160.0],
        brake_nm: Some(50.0),
        inertia_kg_m2: Some(5e-4),
        // The sprags come too late by more than a fed race that little is moved with runs on.
        allowed_rad: 0.5_f64.to_radians(),
        springs: vec![0.25, 1.0, 4.0],
        ..FeedSettings::default()
    };
    let found = design.feed(&asked).unwrap();
    let [weak, own, strong] = found.springs.as_slice() else { panic!("{:?}", found.springs) };
    assert!(own.limit_hz.is_some() && own.limit_hz == found.climb.limit_hz, "{own:?}");
    assert_eq!((own.lost.as_ref(), found.climb.lost_between), (found.climb.lost.as_ref(), true));
    let limits = [weak, own, strong].map(|spring| spring.limit_hz.unwrap_or(0.0));
    let grows = [limits[1] / limits[0], limits[2] / limits[1]];
    assert!(grows.iter().all(|times| (1.6..2.2).contains(times)), "{limits:?}");
    assert_eq!(strong.drag_torque_nm, 4.0 * design.clutch.spring.drag_torque_nm);
    let refused = design.feed(&FeedSettings { springs: vec![-1.0], ..asked });
    assert!(matches!(refused, Err(NoFeed::Refused { .. })), "{refused:?}");
}

/// Two races and the static curve between them, its sprags without inertia: where the races part it gives nothing, and takes hold
/// again wherever they turn back.
fn without_inertia(case: &Strokes) -> f64 {
    let clutch = clutch();
    let curve = curve();
    let most = curve.end_torque_nm();
    let table: Vec<[f64; 2]> = (0..=4000)
        .map(|k| most * (f64::from(k) / 4000.0).powi(2) * (1.0 - 1e-9))
        .filter_map(|nm| Some([curve.at_torque(nm)?.windup_rad, nm]))
        .collect();
    let torque = |windup: f64| {
        let k = table.partition_point(|row| row[0] < windup).clamp(1, table.len() - 1);
        let [a, b] = [table[k - 1], table[k]];
        (a[1] + (b[1] - a[1]) * (windup - a[0]) / (b[0] - a[0])).max(0.0)
    };
    let damping = clutch.races.viscous_damping_nm_s_per_rad;
    let omega = TAU * case.frequency_hz;
    let n = 400_000;
    let dt = 1.0 / (case.frequency_hz * f64::from(n));
    // `holds`: how far the races may stand apart until the sprags touch.
    let (mut angle, mut speed, mut holds, mut before) = (0.0, 0.0_f64, 0.0_f64, 0.0);
    for _ in 0..4 {
        before = angle;
        for k in 0..n {
            let t = (f64::from(k) + 0.5) * dt;
            let apart = 0.5 * case.stroke_rad * (1.0 - (omega * t).cos()) - angle;
            holds = holds.min(apart);
            let faster = 0.5 * case.stroke_rad * omega * (omega * t).sin() - speed;
            let asked = torque(apart - holds) + damping * faster;
            if speed == 0.0 && asked.abs() <= case.brake_nm {
                continue;
            }
            let way = if speed == 0.0 { asked.signum() } else { speed.signum() };
            let next = speed + dt * (asked - way * case.brake_nm) / case.inertia_kg_m2;
            speed = if next * way < 0.0 { 0.0 } else { next };
            angle += dt * speed;
        }
    }
    angle - before
}

#[test]
fn fast_strokes_feed_what_sprags_without_inertia_feed() {
    for hz in [5.0, 10.0, 20.0] {
        let case = case(hz);
        let [ours, theirs] = [found(&case).feed_rad, without_inertia(&case)].map(f64::to_degrees);
        assert!((ours - theirs).abs() < 2e-3, "{hz} Hz: {ours} {theirs} deg");
    }
}

/// A race that stands when the driving one turns back has not moved: no rounding is shown.
#[test]
fn a_race_that_stands_does_not_run_on() {
    for hz in [1.0, 3.0, 4.0, 5.0] {
        let runs_on = found(&case(hz)).runs_on_rad;
        assert!(runs_on == 0.0 || runs_on.abs() > 1e-10 * case(hz).stroke_rad, "{hz}: {runs_on:e}");
    }
}

#[test]
fn nothing_is_fed_without_a_brake_that_lets_go() {
    // More than the stroke winds the clutch up to: the fed race never moves.
    let stiff = Strokes { stroke_rad: 1e-3, ..case(5.0) };
    assert!(found(&stiff).feed_rad.abs() < 1e-9);
}

#[test]
fn either_race_can_drive_and_a_stop_is_followed() {
    let inner = Strokes { inner_drives: true, ..case(2.0) };
    let fed_by_inner = found(&inner);
    assert!(fed_by_inner.feed_rad > 0.9 * inner.stroke_rad, "{fed_by_inner:?}");
    let follow = Follow::new();
    follow.stop();
    assert_eq!(fed(&clutch(), &case(2.0), &follow).unwrap().ended, Some(Stop::Interrupted));
}

#[test]
fn the_library_refuses_what_no_drive_does() {
    let design = Design::read(FILE.as_ref()).unwrap();
    let refused = |settings: FeedSettings| design.feed(&settings).unwrap_err();
    let usual = FeedSettings::default;
    for settings in [
        FeedSettings { stroke_rad: 0.0, ..usual() },
        FeedSettings { stroke_rad: f64::NAN, ..usual() },
        FeedSettings { frequencies_hz: vec![], ..usual() },
        FeedSettings { frequencies_hz: vec![5.0, 2.0], ..usual() },
        FeedSettings { inertia_kg_m2: Some(-1.0), ..usual() },
        FeedSettings { allowed_rad: f64::INFINITY, ..usual() },
        FeedSettings { brake_nm: Some(-1.0), ..usual() },
        FeedSettings { brake_nm: Some(0.0), ..usual() },
    ] {
        assert!(matches!(refused(settings.clone()), NoFeed::Refused { .. }), "{settings:?}");
    }
    assert!(matches!(refused(FeedSettings { brake_nm: Some(1e5), ..usual() }), NoFeed::Beyond(_)));
}

#[test]
fn the_command_answers_and_refuses() {
    let feed = |args: &[&str]| run(&[&["feed", FILE], args].concat());
    let found =
        feed(&["--stroke", "30", "--brake", "100", "--inertia", "0.02", "--frequency", "4,10", "--json"]);
    assert_eq!(found.status.code(), Some(1));
    let answer = json(&found);
    assert!(answer["design_hash"].is_string() && answer["left_out"].is_array());
    assert_eq!(answer["frequencies"][0]["held"], true);
    assert_eq!(answer["frequencies"][1]["held"], false);
    let limit_hz = answer["limit_hz"].as_f64().unwrap();
    assert!(limit_hz > 4.0 && limit_hz < 10.0, "{limit_hz}");
    let said = answer["verdict"].as_str().unwrap();
    assert!(said.contains("first fails beyond") && !said.contains("as it should"), "{said}");
    // What was found, and what is allowed.
    for (bad, found, allowed) in [
        (&["--stroke", "0"][..], "0", "above zero"),
        (&["--stroke", "400"], "400 deg", "360 deg"),
        (&["--stroke", "30", "--frequency", "5,2"], "5, 2 Hz", "each above"),
        (&["--stroke", "30", "--brake", "0"], "0 Nm", "above 0"),
        (&["--stroke", "30", "--brake", "1e5"], "100000 Nm", "up to"),
    ] {
        let refused = feed(bad);
        let words = String::from_utf8_lossy(&refused.stderr).replace("\n  │ ", " ");
        assert_eq!(refused.status.code(), Some(2), "{bad:?}");
        assert!(words.contains(found) && words.contains(allowed), "{bad:?}: {words}");
    }
    // The inertia of the file is named as such.
    let by_file = stdout(&feed(&["--stroke", "30", "--brake", "100", "--frequency", "1"]));
    assert!(by_file.contains("races.inner_inertia_kg_m2"), "{by_file}");
}

/// Between the frequencies asked for it is looked too: a loss there is told, beside those that are held.
#[test]
fn a_loss_between_frequencies_that_are_held_is_found() {
    let design = Design::read(FILE.as_ref()).unwrap();
    let ask = |frequencies_hz: &[f64], allowed_deg: f64| {
        let settings = FeedSettings {
            stroke_rad: 30_f64.to_radians(),
            frequencies_hz: frequencies_hz.to_vec(),
            brake_nm: Some(100.0),
            inertia_kg_m2: Some(0.02),
            allowed_rad: allowed_deg.to_radians(),
            ..FeedSettings::default()
        };
        design.feed(&settings).unwrap()
    };
    let both = [4.0, 7.0];
    let answer = ask(&both, 0.1);
    assert!(answer.held() && answer.list.iter().all(|fed| fed.ended.is_none()));
    let lost = answer.climb.lost.clone().unwrap();
    assert!(answer.climb.lost_between && lost.frequency_hz > both[0] && lost.frequency_hz < both[1]);
    let off = |hz: f64| (found(&case(hz)).error_rad + answer.windup_rad).to_degrees().abs();
    let limit_hz = answer.climb.limit_hz.unwrap();
    assert!(
        off(lost.frequency_hz) > 0.1 && off(limit_hz) <= 0.1 && limit_hz < lost.frequency_hz,
        "{limit_hz}"
    );
    let words = Answer::verdict(&answer);
    assert!(
        words.starts_with("HELD at all 2 frequencies up to") && words.contains("NOT BETWEEN THEM: at"),
        "{words}"
    );
    assert!(answer.page(&Provenance::default()).to_html().contains("class=\"verdict mixed\""));
    // Where nothing is lost that is said too, and of a single frequency that it is alone.
    let wide = ask(&[2.0, 4.0], 0.1);
    let words = Answer::verdict(&wide);
    // ln 2/ln 1.06 is 11.9: eleven between.
    assert!(
        wide.climb.looks == 11 && words.contains("and between them, in steps of 6.0 % or less"),
        "{words}"
    );
    let one = ask(&[1.0], 0.1);
    assert!(one.climb.looks == 0 && one.text(Screen::default()).contains("this frequency alone"));
    assert!(one.text(Screen::default()).contains("an estimate"));
}

#[test]
fn strokes_that_do_not_feed_say_a_next_step() {
    let ask = |more: &[&str]| {
        stdout(&run(&[&["feed", "designs/indexing.toml", "--stroke", "30", "--quiet"][..], more].concat()))
    };
    let fast = ask(&["--brake", "100", "--inertia", "0.02", "--frequency", "4,5,50"]);
    assert!(fast.contains("NOT HELD") && fast.contains("Next: strokes up to"), "{fast}");
    // Beyond the frequency at which the fed race runs on: brake or inertia that would stop it, by the square of the frequency.
    let runs_on = ask(&["--brake", "100", "--inertia", "0.02", "--frequency", "50"]);
    let at = (2.0 * 100.0 / (0.02 * 30_f64.to_radians())).sqrt() / std::f64::consts::TAU;
    let brake = sprag_design::report::Unit::NewtonMetre.show(100.0 * (50.0 / at).powi(2), 3);
    assert!(runs_on.contains(&format!("a brake of {brake} or more")), "{runs_on}");
    assert!(!ask(&["--brake", "100", "--inertia", "0.02", "--frequency", "1"]).contains("Next: "));
}
