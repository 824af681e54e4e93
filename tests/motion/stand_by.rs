//! A clutch that overruns for long before it is wanted: swings of its sprags that repeat are added and not run.

use sprag_design::clutch::{Scenario, ScenarioKind};
use sprag_design::design::Design;
use sprag_design::fidelity::{self, Terms};
use sprag_design::scenario::{Settings, Simulation, Verdict, simulate};
use std::path::Path;
use std::sync::LazyLock;

/// The paper's clutch, its inner race 100 rpm ahead, dragged by 0.5 Nm for `seconds`, then driven by 10 Nm within 20 ms; what
/// acts afterwards is `more`.
fn standing_by(seconds: f64, friction: f64, more: &[[f64; 2]]) -> Scenario {
    let design = Design::read(Path::new("designs/huang2017-multi-arc.toml")).unwrap();
    let mut scene = design.scenario("high-10").unwrap().clone();
    scene.kind = ScenarioKind::Transient {
        preload_nm: 0.0,
        torque_step_nm: 0.0,
        step_time_s: 0.0,
        abutment_stiffness_nm_per_rad: 50_000.0,
        duration_s: more.last().map_or(seconds, |row| row[0]) + 0.05,
        speed_rad_s: 0.0,
        overrun_rad_s: 100.0_f64.to_radians() * 6.0,
    };
    let begins = [[0.0, -0.5], [seconds, -0.5], [seconds + 0.02, 10.0]];
    scene.torque_history = Some(begins.iter().chain(more).copied().collect());
    let law = &mut scene.clutch.friction;
    (law.static_, law.kinetic) = (friction, law.kinetic.min(friction));
    scene
}

fn settings(friction: f64) -> Settings {
    Settings { samples: 300, energy: friction > 0.11, ..Settings::default() }
}

/// A second of stand-by with the friction of the paper.
static ONE_SECOND: LazyLock<Simulation> =
    LazyLock::new(|| simulate(&standing_by(1.0, 0.12, &[]), &settings(0.12)).unwrap());

fn tells(s: &Simulation) -> String {
    format!(
        "{:?} at {:?}, {:?}, {} steps, {:?}",
        s.verdict,
        s.engaged.map(|e| e.t_s),
        s.jumps,
        s.steps,
        s.error
    )
}

/// With the friction of the paper each swing slips at B, and the motion is periodic: it says what the run of all swings says.
/// Friction that does not fall with speed lets them swing on as they began; that is run.
#[test]
fn swings_that_repeat_are_added_and_not_run() {
    for (seconds, friction, repeats) in [(1.0, 0.12, true), (0.7, 0.11, true), (0.7, 0.09, false)] {
        let scene = standing_by(seconds, friction, &[]);
        let settings = settings(friction);
        let jumped = match friction == 0.12 {
            true => ONE_SECOND.clone(),
            false => simulate(&scene, &settings).unwrap(),
        };
        let whole = simulate(&scene, &Settings { every_period: true, ..settings.clone() }).unwrap();
        println!("{friction}: {}\n   {}", tells(&jumped), tells(&whole));
        assert_eq!(jumped.jumps.is_empty(), !repeats, "{friction}");
        assert!(whole.jumps.is_empty() && whole.tolerance_reached && jumped.tolerance_reached);
        assert_eq!((jumped.verdict, whole.verdict), (Some(Verdict::Sticks), Some(Verdict::Sticks)));
        // Trials of friction stand by shorter: what that costs is among what is left out, not in the errors.
        let mut off = jumped.off(&whole);
        println!("   off {off:?}");
        assert!(off.required_friction < 4e-7 && off.slip_margin < 4e-6, "{friction}: {off:?}");
        (off.required_friction, off.slip_margin) = (0.0, 0.0);
        let worst = jumped.scales.worst_figure(&off);
        assert!(worst.1 < settings.tolerance, "{friction}: {worst:?}");
        if repeats {
            assert!(jumped.jumps[0].periods > 200 && jumped.jumps[0].error <= settings.tolerance);
        }
        // Angles of the history are those of the motion, added swings or not.
        assert_eq!(jumped.samples.len(), whole.samples.len());
        for (a, b) in jumped.samples.iter().zip(&whole.samples) {
            let off = a.state.iter().zip(&b.state).take(4).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!((a.t - b.t).abs() < 1e-12 && off < 1e-6, "{friction} at {}: {off}", a.t);
        }
        for e in [&jumped, &whole].into_iter().filter_map(|s| s.energy) {
            assert!(e.relative().abs() < 1e-6, "{e:?}");
        }
    }
}

/// The more swings are added, the better one of them has to be known: ten minutes cost some five times what a second costs. The
/// figures of the engagement are those after any other stand-by.
#[test]
fn minutes_of_stand_by_cost_what_seconds_cost() {
    let short = &*ONE_SECOND;
    let seconds = 600.0;
    let planned = fidelity::simulate(&standing_by(seconds, 0.12, &[]), &Settings::default(), Terms::Felt);
    let long = planned.as_ref().unwrap();
    let s = &long.simulation;
    println!("{seconds}: {}\n   {}", tells(s), tells(short));
    assert!(s.steps < 6 * short.steps, "{} and {}", s.steps, short.steps);
    assert!(s.engaged.unwrap().t_s > seconds && s.verdict == Some(Verdict::Sticks));
    assert!(long.left_out.iter().any(|t| t.term == "whole periods that repeat"));
    assert!((s.peaks.normal_max_n / short.peaks.normal_max_n - 1.0).abs() < 1e-3);
    assert!((s.theta_inner_rad - s.engaged.unwrap().state[2]).abs() < 0.1);
}

/// Wanted twice: swings are added in either stand-by.
#[test]
fn each_stand_by_is_added() {
    let begins_again = 0.55;
    let more = [[0.5, 10.0], [begins_again, -0.5], [1.1, -0.5], [1.12, 10.0]];
    let scene = standing_by(0.4, 0.12, &more);
    let settings = Settings::default();
    let jumped = simulate(&scene, &settings).unwrap();
    let whole = simulate(&scene, &Settings { every_period: true, ..settings.clone() }).unwrap();
    println!("{}\n   {}", tells(&jumped), tells(&whole));
    assert!(jumped.jumps.iter().any(|j| j.from_s > begins_again), "{:?}", jumped.jumps);
    let worst = jumped.scales.worst_figure(&jumped.off(&whole));
    assert!(worst.1 < settings.tolerance && jumped.verdict == whole.verdict, "{worst:?}");
}
