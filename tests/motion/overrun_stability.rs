//! The growth and the frequency of the swing about a steady overrun against runs of the dynamics themselves.

use crate::program::*;

use std::f64::consts::PI;
use std::path::Path;

use sprag_design::clutch::Clutch;
use sprag_design::design::Design;
use sprag_design::dynamics::{
    Forces, Grip, Loads, Mode, Model, N_STATE, Overrun, Place, RunSettings, Stop, Swing, alpha_max_rad,
    overrun, run as integrate, swing,
};
use sprag_design::scenario::sliding_friction;
use sprag_design::wedge::WedgeCurve;

/// The clutch of Table 1 between races that keep their speeds: nothing brakes them and they are heavy.
fn between_heavy_races() -> Clutch {
    let mut clutch = Design::read(Path::new("designs/huang2017-multi-arc.toml")).unwrap().clutch;
    clutch.races.inner_inertia_kg_m2 = 1e6;
    clutch.races.outer_inertia_kg_m2 = 1e6;
    clutch.races.viscous_damping_nm_s_per_rad = 0.0;
    clutch
}

/// Steady overrun at `speed_rpm` of the outer race, the inner one ahead by `overrun_rpm`.
fn steady(clutch: &Clutch, speed_rpm: f64, overrun_rpm: f64) -> (Model, Overrun, f64) {
    let profile = clutch.profile().unwrap();
    let build = |speed| WedgeCurve::build_reaching(clutch, &profile, speed, Some(0.0)).unwrap();
    let curve = build(speed_rpm * PI / 30.0);
    let alpha_max = alpha_max_rad(clutch, &build(0.0));
    let ahead = overrun_rpm * PI / 30.0;
    let steady = overrun(clutch, &curve, alpha_max, sliding_friction(clutch, ahead));
    let still = Loads { inner_nm: 0.0, amplitude_nm: 0.0, omega_rad_s: 0.0, abutment_nm_per_rad: 0.0 };
    (Model::new(clutch, curve, still, alpha_max, 0.0), steady, ahead)
}

/// Growth (1/s) and frequency (Hz) of a run that begins with a small push, by the heights from peak to trough.
fn measured(model: &Model, steady: &Overrun, ahead_rad_s: f64, expected: &Swing) -> (f64, f64) {
    // As long as the swing grows or falls by a factor of some ten at most.
    let periods = (2.0 * expected.frequency_hz / expected.growth_rate_per_s.abs()).clamp(6.0, 40.0).floor();
    let mut y = [0.0; N_STATE];
    let touch = model.curve.first_contact_rad();
    // A thousandth of what the contact is pressed in.
    (y[0], y[6]) = (touch + (steady.alpha_rad - touch) * (1.0 + 1e-3), ahead_rad_s);
    let settings = RunSettings {
        tolerance: 1e-12,
        duration_s: periods / expected.frequency_hz,
        most_events: 10,
        most_steps: 1_000_000,
        samples: periods as usize * 200 + 1,
        ..RunSettings::default()
    };
    let run = integrate(model, y, OVERRUNNING, &settings);
    assert_eq!((run.stop, run.events), (Stop::Finished, 0));
    // One peak and one trough in every period: height and time of the peak.
    let alpha: Vec<f64> = run.samples.iter().map(|s| s.state[0] - touch).collect();
    let dt = run.samples[1].t;
    let turns: Vec<(f64, f64)> = (1..alpha.len() - 1)
        .filter(|&i| (alpha[i] - alpha[i - 1]) * (alpha[i + 1] - alpha[i]) < 0.0)
        .map(|i| {
            // The parabola through three samples.
            let (rise, bend) =
                (0.5 * (alpha[i + 1] - alpha[i - 1]), alpha[i + 1] - 2.0 * alpha[i] + alpha[i - 1]);
            (dt * (i as f64 - rise / bend), alpha[i] - 0.5 * rise * rise / bend)
        })
        .collect();
    let heights: Vec<(f64, f64)> =
        turns.windows(2).map(|w| (0.5 * (w[0].0 + w[1].0), (w[1].1 - w[0].1).abs())).collect();
    let (first, last) = (heights[0], heights[heights.len() - 1]);
    let time = last.0 - first.0;
    ((last.1 / first.1).ln() / time, 0.5 * (heights.len() - 1) as f64 / time)
}

#[test]
fn growth_and_frequency_are_those_of_runs_that_begin_with_a_small_push() {
    // Speeds of the outer race and of the inner one ahead of it, rpm; friction at rest and at speed; Hunt and Crossley's
    // damping, s/m.
    for (speed, ahead, friction, damping, grows) in [
        // Friction falls with speed: the swing grows, slowly or fast.
        (3000.0, 100.0, [0.12, 0.09], 0.0, true),
        (0.0, 20.0, [0.12, 0.09], 0.0, true),
        // It rises with speed: the swing dies away.
        (3000.0, 100.0, [0.09, 0.12], 0.0, false),
        // It falls, but the contacts take more than it feeds.
        (3000.0, 100.0, [0.12, 0.09], 40.0, false),
    ] {
        let mut clutch = between_heavy_races();
        clutch.friction.static_ = friction[0];
        clutch.friction.kinetic = friction[1];
        clutch.hunt_crossley_s_per_m = damping;
        let (model, steady, ahead_rad_s) = steady(&clutch, speed, ahead);
        let found = swing(&clutch, &model.curve, model.alpha_max_rad, &steady, ahead_rad_s).unwrap();
        let (growth, frequency) = measured(&model, &steady, ahead_rad_s, &found);
        println!(
            "{speed} rpm, {ahead} rpm ahead, {friction:?}, {damping}: {found:?}, N {} ({:+.3e}); run {growth} 1/s, {frequency} Hz",
            steady.normal_inner_n,
            found.normal_inner_n / steady.normal_inner_n - 1.0
        );
        assert!((growth / found.growth_rate_per_s - 1.0).abs() < 0.01, "{growth} {found:?}");
        assert!((frequency / found.frequency_hz - 1.0).abs() < 1e-3, "{frequency} {found:?}");
        assert_eq!((growth > 0.0, found.grows()), (grows, grows));
    }
}

/// A slides ahead and B sticks.
const OVERRUNNING: Mode = Mode { place: Place::Arc(0), inner: Grip::Slip(1.0), outer: Grip::Stick };

/// At the equilibrium of the statics the equations of motion leave over (N_be - N_be,static) delta_e', and nothing else: that
/// is the 0.2 % of N_bi between the two, more near lift-off.
#[test]
fn the_equilibria_of_statics_and_of_the_dynamics_differ_by_one_known_term() {
    for (speed, ahead) in [(0.0, 100.0), (3000.0, 100.0), (4500.0, 300.0)] {
        let clutch = between_heavy_races();
        let (model, steady, ahead_rad_s) = steady(&clutch, speed, ahead);
        let mut y = [0.0; N_STATE];
        (y[0], y[6]) = (steady.alpha_rad, ahead_rad_s);
        let forces: Forces = model.forces(&OVERRUNNING, 0.0, &y);
        let p = model.point(OVERRUNNING.place, y[0]);
        let (_, c) = model.curve.closure_at_normal(steady.normal_inner_n).unwrap();
        let approach_slope = p.oc_g_slope * p.gamma.cos() - p.oc_g * p.gamma.sin();
        let term = (steady.normal_outer_n - c.n_be.v) * approach_slope;
        let s = &clutch.sprags;
        let inertia = s.inertia_kg_m2 * (1.0 - p.rho_e).powi(2) + s.mass_kg * (p.oc_g * p.rho_e).powi(2);
        let left = inertia * forces.acceleration[0];
        let found = swing(&clutch, &model.curve, model.alpha_max_rad, &steady, ahead_rad_s).unwrap();
        let off = found.normal_inner_n / steady.normal_inner_n - 1.0;
        println!("{speed} rpm: left over {left:e} Nm, term {term:e} Nm, N_bi {off:+.3e}");
        assert!((left / term - 1.0).abs() < 1e-4, "{speed}: {left:e} {term:e}");
        assert!((-1e-2..-1e-3).contains(&off), "{speed}: {off:e}");
    }
}

const BENCH: &str = "designs/huang2017-bench.toml";

#[test]
fn simulate_says_whether_a_steady_overrun_stays() {
    let folder = Folder::new();
    let simulate =
        |path: &str, more: &[&str]| run(&[&["simulate", path, "--scenario", "overrun"], more].concat());
    let value = json(&simulate(BENCH, &["--json", "--quiet"]));
    // Growth and frequency: a run of the dynamics has them as well, in the first test.
    let (growth, frequency) = (value["growth_rate_per_s"].as_f64().unwrap(), &value["swing_frequency_hz"]);
    assert!((growth - 52.0).abs() < 1.0 && frequency.as_f64().unwrap() > 100.0, "{growth} {frequency}");
    let warned = |value: &serde_json::Value| {
        value["notes"].as_array().unwrap().iter().any(|n| n.as_str().unwrap().contains("does not stay"))
    };
    assert!(warned(&value), "{}", value["notes"]);
    // How far runs settle beside it.
    let statics = value["equilibrium"]["normal_inner_n"].as_f64().unwrap();
    let off = value["swing_normal_inner_n"].as_f64().unwrap() / statics - 1.0;
    let left_out = value["left_out"].as_array().unwrap();
    let said = left_out.iter().find(|e| e["term"].as_str().unwrap().contains("N_be")).unwrap();
    assert!((-2e-3..-2e-4).contains(&off) && said["cost"].as_str().unwrap().contains('%'), "{off} {said}");
    let text = stdout(&simulate(BENCH, &["--quiet"]));
    assert!(text.contains("does not stay") && text.contains("growth rate of the sprags' swing"), "{text}");
    let page = folder.path("page.html");
    simulate(BENCH, &["--quiet", "--report", &page]);
    assert!(is_self_contained(&page).contains("does not stay"));
    // With one coefficient of friction it neither grows nor dies away.
    let steady = folder.changed(BENCH, &[("kinetic = 0.09 ", "kinetic = 0.12 ")]);
    for file in ["engaging-in-and-out.csv", "speed-ramp.csv", "overrunning-torque.csv"] {
        std::fs::copy(format!("designs/{file}"), folder.path(file)).unwrap();
    }
    let value = json(&simulate(&steady, &["--json", "--quiet"]));
    assert!(value["growth_rate_per_s"].as_f64().unwrap().abs() < 1e-3 && !warned(&value), "{value}");
}

/// What `check` says of a clutch of Table 1 with that kinetic friction: JSON, terminal, and the table of overrun.
fn checked(folder: &Folder, friction: &str, scene: &str) -> (serde_json::Value, String, String) {
    let text = std::fs::read_to_string(MULTI).unwrap();
    let head = text.split_once("[check]").unwrap().0.replace("kinetic = 0.09", friction);
    let path = folder.path("check.toml");
    std::fs::write(&path, head + scene).unwrap();
    let csv = folder.path("overrun.csv");
    let output = run(&["check", &path, "--json", "--quiet", "--overrun-csv", &csv]);
    let csv = std::fs::read_to_string(csv).unwrap();
    (json(&output), stdout(&run(&["check", &path, "--quiet"])), csv)
}

/// At its own speeds a swing grows: a warning. On the way there only: a note, which says how fast to pass.
#[test]
fn check_warns_of_the_speeds_that_the_design_names() {
    let folder = Folder::new();
    let slow =
        "\n[[scenarios]]\nname = \"creeps\"\nkind = \"overrun\"\nspeed_rpm = 0.0\noverrun_rpm = 20.0\n";
    let (value, text, _) = checked(&folder, "kinetic = 0.09", slow);
    let row = value["margins"].as_array().unwrap().iter().find(|r| r["code"] == "keep-contact").unwrap();
    let warning = value["overrun"]["warning"].as_str().unwrap();
    assert!(row["held"] == true && warning.contains("keep-contact"), "{row} {warning}");
    assert!(
        warning.contains("at 20 rpm of the inner race (creeps)") && text.contains(warning),
        "{warning} {text}"
    );
    assert!(value["overrun"]["passing"].is_null());
    let named = value["overrun"]["named"].as_array().unwrap();
    let creeps = named.iter().find(|n| n["by"] == "creeps").unwrap();
    assert!(creeps["growth_rate_per_s"].as_f64().is_some_and(|g| g > 1.0), "{creeps}");
    // keep_contact_to_rpm alone, far above where friction falls with speed.
    let (value, text, _) = checked(&folder, "kinetic = 0.09", "");
    let (warning, passing) = (&value["overrun"]["warning"], &value["overrun"]["passing"]);
    assert!(warning.is_null() && !text.contains("does not stay"), "{warning}");
    let passing = passing.as_str().unwrap();
    assert!(
        passing.starts_with("Note: up to ") && passing.contains("tenfold in") && text.contains(passing),
        "{text}"
    );
    // The criterion: tenfold within a second where it grows fastest among the speeds looked at.
    let points = value["overrun"]["points"].as_array().unwrap();
    let growth = |p: &serde_json::Value| p["growth_rate_per_s"].as_f64().unwrap_or(0.0);
    let most = points.iter().filter(|p| p["race"] == "inner" || p["speed_rpm"].as_f64() <= Some(4500.0));
    let most = most.map(growth).fold(0.0, f64::max);
    assert!(most > std::f64::consts::LN_10, "{most}");
    let tenfold = format!("tenfold in {:.0} ms", 1e3 * std::f64::consts::LN_10 / most);
    assert!(passing.contains(&tenfold), "{passing} {tenfold}");
    let (value, text, _) = checked(&folder, "kinetic = 0.12", "");
    assert!(value["overrun"]["warning"].is_null() && value["overrun"]["passing"].is_null());
    assert!(!text.contains("does not stay") && !text.contains("tenfold"), "{text}");
}

/// What differences cannot tell from nothing is nothing, and speeds that show the same are one row to people.
#[test]
fn rounding_is_no_growth() {
    let folder = Folder::new();
    let (value, _, csv) = checked(&folder, "kinetic = 0.12", "");
    let points = value["overrun"]["points"].as_array().unwrap();
    let growths: Vec<f64> = points.iter().filter_map(|p| p["growth_rate_per_s"].as_f64()).collect();
    assert!(growths.len() > 20 && growths.iter().all(|g| *g == 0.0), "{growths:?}");
    let page = folder.path("page.html");
    run(&["check", &folder.path("check.toml"), "--quiet", "--report", &page]);
    let page = std::fs::read_to_string(page).unwrap();
    let shown = page.matches("<td>inner</td>").count();
    let all = csv.lines().filter(|line| line.starts_with("inner,")).count();
    assert!(all > 25 && (2..10).contains(&shown), "{shown} of {all}");
}
