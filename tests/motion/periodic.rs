//! Periodic states by shooting: against scipy, a long transient, the linear forced response, their own works.

use crate::program::*;
use sprag_design::clutch::{Scenario, ScenarioKind};
use sprag_design::design::Design;
use sprag_design::dynamics::{self, NoOrbit, RunSettings};
use sprag_design::scenario::{
    MotionKind, Prepared, ResonanceCell, Settings, Steady, closely, prepare, resonance, steady_motion,
};
use std::f64::consts::TAU;
use std::path::Path;

fn scene(file: &str, name: &str, amplitude: f64, hertz: f64, abutment: f64) -> Scenario {
    let design = Design::read(Path::new(file)).unwrap();
    let mut scene = design.scenario(name).unwrap().clone();
    if let ScenarioKind::TorsionalExcitation {
        amplitude_nm,
        frequency_hz,
        abutment_stiffness_nm_per_rad,
        ..
    } = &mut scene.kind
    {
        (*amplitude_nm, *frequency_hz, *abutment_stiffness_nm_per_rad) = (amplitude, hertz, abutment);
    }
    scene
}

const MULTI: &str = "designs/huang2017-multi-arc.toml";
const SINGLE: &str = "designs/huang2017-single-arc.toml";

fn steady(scene: &Scenario) -> (Prepared, Steady) {
    let prepared = prepare(scene).unwrap();
    let found = steady_motion(&prepared, &closely(&Settings::default()), None).unwrap();
    (prepared, found)
}

fn close(a: f64, b: f64, by: f64, what: &str) {
    assert!((a / b - 1.0).abs() < by, "{what}: {a} against {b}, off by {:.1e}", a / b - 1.0);
}

/// tests/reference/periodic.py: other variables, other integrator, multipliers by the variational equations.
#[test]
fn a_rolling_state_is_that_of_scipy() {
    let rows = std::fs::read_to_string("tests/reference/periodic.csv").unwrap();
    for row in rows.lines().skip(1) {
        let v: Vec<f64> = row.split(',').map(|x| x.parse().unwrap()).collect();
        let mut scene = scene(SINGLE, "low-6", v[1], v[2], v[3]);
        // As the reference: sprags and springs that weigh and press next to nothing.
        (scene.clutch.sprags.mass_kg, scene.clutch.sprags.inertia_kg_m2) = (1e-9, 1e-15);
        (scene.clutch.spring.stiffness_nm_per_rad, scene.clutch.spring.drag_torque_nm) = (1e-10, 1e-10);
        let (_, found) = steady(&scene);
        let orbit = found.rolling.as_ref().unwrap();
        println!("{row}\n  {:?} {:?} {:?}", orbit.run.peaks, orbit.multipliers, found.periods);
        // |T|/N of the reference is that of the statics, its windup from energy: what is read between its samples, 1e-8.
        close(orbit.run.peaks.normal_min_n, v[4], 1e-6, "N_min");
        close(orbit.run.peaks.normal_max_n, v[5], 1e-6, "N_max");
        close(found.required_friction.unwrap(), v[6], 1e-6, "mu_req");
        let size = |k: usize| orbit.multipliers[k][0].hypot(orbit.multipliers[k][1]);
        close(size(0), v[8], 1e-4, "largest multiplier");
        close(size(3), v[9], 1e-4, "smallest multiplier");
        assert_eq!((orbit.is_stable(), orbit.neutral_multiplier()), (Some(true), None));
    }
}

/// A run from rest, long enough for its start to be forgotten, comes to the same state.
#[test]
fn a_long_transient_comes_to_it() {
    for (name, amplitude, kind) in [
        ("low-6", 6.0, MotionKind::Rolls),
        ("high-6", 6.0, MotionKind::Rolls),
        ("low-10-mu082", 10.0, MotionKind::Slips),
    ] {
        let (prepared, found) = steady(&scene(MULTI, name, amplitude, 100.0, 5000.0));
        assert_eq!(found.kind, kind, "{name}: {:?}", found.motion.as_ref().err());
        let orbit = found.motion.as_ref().unwrap();
        let settings = RunSettings {
            tolerance: 1e-9,
            duration_s: 3.0,
            longest_step_s: 0.01 / 14.0,
            most_events: 1_000_000,
            ..RunSettings::default()
        };
        let long = dynamics::run(&prepared.model, prepared.state, prepared.mode, &settings);
        let next = RunSettings { duration_s: 3.01, ..settings };
        let longer = dynamics::run(&prepared.model, prepared.state, prepared.mode, &next);
        println!("{name}: {:?} {:?} {} periods", orbit.multipliers, found.required_friction, found.periods);
        println!("   {:?}\n   {:?}", orbit.state, long.state);
        for (i, size) in [(0, 0.05), (3, 1e-3), (6, 5.0), (7, 5.0)] {
            let off = (orbit.state[i] - long.state[i]).abs() / size;
            assert!(off < 2e-6, "{name}, number {i}: {off:.1e}");
        }
        let slip = longer.inner.net_m - long.inner.net_m;
        assert!(
            (orbit.run.inner.net_m - slip).abs() < 1e-5 * slip.abs() + 1e-14,
            "{} {slip}",
            orbit.run.inner.net_m
        );
        let drift = longer.state[2] - long.state[2];
        assert!((orbit.drift_rad()[0] - drift).abs() < 1e-5 * drift.abs() + 1e-11);
    }
}

/// What comes in by torques goes out by friction and damping; nothing is stored over a period.
#[test]
fn works_of_a_period_balance() {
    for (name, amplitude) in [("low-6", 6.0), ("low-10-mu082", 10.0)] {
        let (_, found) = steady(&scene(MULTI, name, amplitude, 100.0, 5000.0));
        let e = found.motion.unwrap().run.energy.unwrap();
        let within = 1e-6 * e.through_j;
        println!("{name}: {e:?}");
        assert!(e.kinetic_j.abs() < within && e.stored_j.abs() < within && e.residual_j().abs() < within);
        let lost = e.friction_inner_j + e.friction_outer_j + e.race_damping_j;
        assert!((e.torque_inner_j + e.torque_outer_j + lost).abs() < within && lost < 0.0);
    }
}

/// A small amplitude: the two linear equations of the rolling clutch about its equilibrium, solved by complex numbers.
///
///   m_ww w'' + m_we e'' + c w' + k w = 0,   m_we w'' + m_ee e'' + k_ab e = amplitude sin,
///
/// masses as in `dynamics::stick`, k the tangent stiffness.
#[test]
fn a_small_amplitude_is_the_linear_forced_response() {
    for hertz in [40.0, 100.0, 170.0, 420.0] {
        let amplitude = 3e-3;
        let scene = scene(SINGLE, "low-6", amplitude, hertz, 5000.0);
        let (prepared, found) = steady(&scene);
        let orbit = found.motion.unwrap();
        let (model, clutch) = (&prepared.model, &scene.clutch);
        // Where it stands without excitation: between the extremes.
        let alpha = orbit
            .run
            .samples
            .iter()
            .map(|s| s.state[0])
            .fold([f64::MAX, f64::MIN], |[l, h], a| [l.min(a), h.max(a)]);
        let alpha = 0.5 * (alpha[0] + alpha[1]);
        let p = model.point(orbit.mode.place, alpha);
        let (kappa, sigma) = (1.0 / (p.rho_i + p.rho_e), p.rho_e / (p.rho_i + p.rho_e));
        let (n, i_g) = (clutch.sprags.count as f64, clutch.sprags.inertia_kg_m2);
        let orbits = clutch.sprags.mass_kg * p.oc_g * p.oc_g;
        let (i_bi, i_be) = (clutch.races.inner_inertia_kg_m2, clutch.races.outer_inertia_kg_m2);
        let m_ww = i_bi + n * (i_g * (kappa - sigma).powi(2) + orbits * sigma * sigma);
        let m_we = n * (i_g * (kappa - sigma) - orbits * sigma) - i_bi;
        let m_ee = i_bi + i_be + n * (i_g + orbits);
        // F(w) of the clutch with its spring, by a difference.
        let force = |alpha: f64| {
            let p = model.point(orbit.mode.place, alpha);
            let spring = clutch.spring.stiffness_nm_per_rad * (model.alpha_max_rad - alpha);
            n * (p.t_static * p.oa - spring / (p.rho_i + p.rho_e))
        };
        let step = 1e-5 * alpha;
        let k = (force(alpha + step) - force(alpha - step))
            / (model.curve.windup_rad(alpha + step) - model.curve.windup_rad(alpha - step));
        let (rate, c) = (TAU * hertz, clutch.races.viscous_damping_nm_s_per_rad);
        // (a + i b) w + m e = 0, m w + d e = amplitude; sine as imaginary part.
        let (a, b) = (k - m_ww * rate * rate, c * rate);
        let (m, d) = (-m_we * rate * rate, 5000.0 - m_ee * rate * rate);
        let det = [a * d - m * m, b * d];
        let size = det[0] * det[0] + det[1] * det[1];
        let w = [-m * amplitude * det[0] / size, m * amplitude * det[1] / size];
        let windup = |s: &sprag_design::dynamics::Sample| model.curve.windup_rad(s.state[0]);
        let mean = {
            let all = &orbit.run.samples[..orbit.run.samples.len() - 1];
            all.iter().map(windup).sum::<f64>() / all.len() as f64
        };
        let worst = orbit.run.samples.iter().map(|s| {
            let (sin, cos) = (rate * s.t).sin_cos();
            (windup(s) - mean - (w[0] * sin + w[1] * cos)).abs()
        });
        let off = worst.fold(0.0, f64::max) / w[0].hypot(w[1]);
        println!("{hertz} Hz: {:.3e} rad, phase {:.3}, off {off:.1e}", w[0].hypot(w[1]), w[1].atan2(w[0]));
        assert!(off < 2e-4, "{hertz}: {off}");
    }
}

/// The natural frequencies told are those of small disturbances of the equations of motion: Floquet multipliers exp(lambda T) of a motion
/// that hardly swings.
#[test]
fn natural_frequencies_are_those_of_small_disturbances() {
    for (file, name, abutment) in
        [(SINGLE, "low-6", 5000.0), (MULTI, "rated-45", 5000.0), (MULTI, "low-6", 200.0)]
    {
        let at = |hertz| scene(file, name, 1e-3, hertz, abutment);
        let modes = prepare(&at(100.0)).unwrap().train_modes().unwrap();
        assert_eq!(modes.len(), 2);
        // So fast that no angle of a multiplier goes beyond half a turn.
        let hertz = 5.0 * modes[1].frequency_hz;
        let orbit = steady(&at(hertz)).1.rolling.unwrap();
        let rate = |[re, im]: &[f64; 2]| [re.hypot(*im).ln(), im.atan2(*re)].map(|x| x * hertz);
        let mut found: Vec<[f64; 2]> = orbit.multipliers.iter().map(rate).filter(|l| l[1] > 0.0).collect();
        found.sort_by(|a, b| a[1].total_cmp(&b[1]));
        assert_eq!(found.len(), 2, "{:?}", orbit.multipliers);
        for (mode, [growth, turns]) in modes.iter().zip(found) {
            let size = growth.hypot(turns);
            println!("{name} {abutment}: {mode:?} against {} Hz, {}", size / TAU, -growth / size);
            // Undamped beside damped: products of damping ratios, up to 0.05 x 0.02 here, lie between them.
            close(mode.frequency_hz, size / TAU, 1e-3, name);
            assert!((mode.damping_ratio + growth / size).abs() < 1e-3, "{name}: {growth} {turns}");
        }
    }
}

/// Both races together on a soft abutment: a swing that nothing damps is no instability; what decides is the clutch's own.
///
/// The damper sits between the races. Of the swing of both on the abutment they take r = k_ab J_i/(k J) of it against one
/// another, J = J_i + J_e, so its multipliers have the magnitude exp(-c r^2 T/(2 J)).
#[test]
fn races_that_swing_together_are_no_instability() {
    let hertz = 100.0;
    let found = |abutment: f64| {
        let scene = scene(SINGLE, "low-6", 1.0, hertz, abutment);
        let (prepared, found) = steady(&scene);
        let races = &scene.clutch.races;
        let ScenarioKind::TorsionalExcitation { preload_nm, .. } = scene.kind else { panic!() };
        let share = abutment / prepared.model.curve.at_torque(preload_nm).unwrap().k_tangent_nm_per_rad;
        let inertia = races.inner_inertia_kg_m2 + races.outer_inertia_kg_m2;
        let share = share * races.inner_inertia_kg_m2 / inertia;
        let lost = races.viscous_damping_nm_s_per_rad * share * share / (2.0 * inertia * hertz);
        let orbit = found.motion.unwrap();
        println!("{abutment}: {:?} ± {:.1e}, lost {lost:.1e}", orbit.multipliers, orbit.multiplier_error);
        (orbit, lost)
    };
    // So much is lost that it can be told: no neutral pair, and that swing decides.
    let (stiffer, lost) = found(20.0);
    assert!(lost > 3.0 * stiffer.multiplier_error && stiffer.neutral_multiplier().is_none(), "{lost}");
    let off = (1.0 - stiffer.deciding_multiplier()) / lost - 1.0;
    assert!(off.abs() < 0.05 && stiffer.is_stable() == Some(true), "{off}");
    let (orbit, lost) = found(5.0);
    let neutral = orbit.neutral_multiplier().unwrap();
    assert!((1.0 - neutral - lost).abs() < 0.2 * lost && lost < orbit.multiplier_error, "{neutral} {lost}");
    assert!((1e-7..1e-3).contains(&orbit.multiplier_error), "{}", orbit.multiplier_error);
    assert!(orbit.is_stable() == Some(true) && orbit.deciding_multiplier() < 0.99, "{:?}", orbit.multipliers);
    // Farther from where the start leads to than a Newton step may be long at first.
    assert!(found(1.0).0.neutral_multiplier().is_some());
    // A pair beyond its error grows; one number at 1 is a border of which nothing can be told.
    let with = |first: [[f64; 2]; 2]| {
        let rest = orbit.multipliers[2..].iter().copied();
        let multipliers = first.into_iter().chain(rest).collect();
        dynamics::Orbit { multipliers, ..orbit.clone() }
    };
    let grows = 1.0 + 10.0 * orbit.multiplier_error;
    let (re, im) = (grows * 0.3_f64.cos(), grows * 0.3_f64.sin());
    let unstable = with([[re, im], [re, -im]]);
    assert_eq!((unstable.is_stable(), unstable.neutral_multiplier()), (Some(false), None));
    assert!((unstable.deciding_multiplier() - grows).abs() < 1e-12);
    assert_eq!(with([[1.0, 0.0], [0.5, 0.0]]).is_stable(), None);
}

#[test]
fn what_has_no_periodic_state_says_so() {
    let loose = scene(MULTI, "high-6", 6.0, 100.0, 5000.0);
    let mut prepared = prepare(&loose).unwrap();
    prepared.model.loads.abutment_nm_per_rad = 0.0;
    let found = steady_motion(&prepared, &Settings::default(), None).unwrap();
    assert_eq!((found.rolling.unwrap_err(), found.kind), (NoOrbit::NothingHolds, MotionKind::NotFound));
    // Rolling would need tension; the clutch lifts off in each period.
    let (_, found) = steady(&scene(MULTI, "low-6", 400.0, 100.0, 5000.0));
    println!(
        "{:?} {:?}",
        found.kind,
        found.motion.as_ref().map(|o| (o.run.open_s, o.run.inner, o.multipliers.clone()))
    );
    assert_eq!((found.kind, found.required_friction, found.slip_margin), (MotionKind::LiftsOff, None, None));
    assert!(found.rolling.is_err() && found.motion.unwrap().run.open_s > 0.0);
    let still = Design::read(Path::new(MULTI)).unwrap();
    let held = still.scenario("rated-45").unwrap();
    let none = steady_motion(&prepare(held).unwrap(), &Settings::default(), None);
    assert_eq!(none.is_none(), held.kind.frequency_hz().is_none());
}

/// One row that slips and lifts off, one that rolls; nothing of it depends on the threads.
#[test]
fn a_map_is_the_same_on_one_thread_and_on_two() {
    let low = scene(MULTI, "low-10-mu082", 10.0, 100.0, 5000.0);
    let frequencies: Vec<f64> = (0..9).map(|i| 60.0 + 15.0 * f64::from(i)).collect();
    let map = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let settings = Settings::default();
        pool.install(|| resonance(&low, &frequencies, &[2.0, 12.0, 20.0], &settings)).unwrap().unwrap()
    };
    let (one, two) = (map(1), map(2));
    let figures = |map: &[Vec<ResonanceCell>]| -> Vec<String> {
        let cells = map.iter().flatten();
        cells.map(|c| format!("{:?} {:?}", c.state, c.other.as_ref().map(|o| o.kind))).collect()
    };
    for c in one.iter().flatten() {
        let s = &c.state;
        println!(
            "{} Hz {} Nm: {:?} {:?} {:?} {:?} {} other {:?}",
            c.frequency_hz,
            c.amplitude_nm,
            s.kind,
            s.required_friction,
            s.is_stable(),
            s.motion.as_ref().map(|o| (o.run.inner.distance_m, o.deciding_multiplier())),
            s.periods,
            c.other.as_ref().map(|o| o.kind)
        );
    }
    assert_eq!(figures(&one), figures(&two));
    assert!(one[0].iter().all(|c| c.state.kind == MotionKind::Rolls), "2 Nm rolls");
    assert!(one[1].iter().any(|c| c.state.kind == MotionKind::Slips), "12 Nm slips near the resonance");
    // Nothing is computed after a stop, and nothing is made up.
    let follow = sprag_design::Follow::new();
    follow.stop();
    let stopped = resonance(&low, &frequencies, &[2.0], &Settings { follow, ..Settings::default() });
    assert!(stopped.unwrap().is_none());
    // Amplitudes that were walked both ways until then are an answer, the same as without the stop.
    let follow = sprag_design::Follow::new();
    let (done, last, stop) = (std::sync::atomic::AtomicUsize::new(0), 2 * frequencies.len(), follow.clone());
    let follow = follow.telling(move |_| {
        if done.fetch_add(1, std::sync::atomic::Ordering::SeqCst) + 1 == last {
            stop.stop();
        }
    });
    let settings = Settings { follow, ..Settings::default() };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let part = pool.install(|| resonance(&low, &frequencies, &[2.0, 12.0, 20.0], &settings));
    assert_eq!(figures(&part.unwrap().unwrap()), figures(&one[..1]));
}

/// The only torsional excitation is meant where none is named; a design without one is told what to add, and that can be added.
#[test]
fn the_command_finds_its_scene_or_says_what_to_add() {
    let folder = Folder::new();
    let text = std::fs::read_to_string("designs/unlike-sprags.toml").unwrap();
    let bare = folder.path("bare.toml");
    let none: String = text.split("[[scenarios]]").next().unwrap().to_owned();
    let none = none
        .lines()
        .filter(|l| !l.starts_with("scenarios = ") && *l != "[check]")
        .collect::<Vec<_>>()
        .join("\n");
    std::fs::write(&bare, &none).unwrap();
    let refused = run(&["resonance", &bare]);
    let said = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert!(refused.status.code() == Some(2) && said.contains("[[scenarios]]"), "{said}");
    let static_scene = "\n[[scenarios]]\nname = \"held\"\nkind = \"static\"\ntorque_nm = 10.0\n";
    let example = sprag_design::answer::resonance::example(100.0)
        .replace("100.0 ", "10.0 ")
        .replace("= 50.0     #", "= 1.0     #");
    std::fs::write(&bare, format!("{none}{static_scene}\n{example}\n")).unwrap();
    let found = run(&["resonance", &bare, "--json", "--quiet"]);
    assert_eq!(json(&found)["scenario"], "swing", "{found:?}");
}

#[test]
fn the_command_in_every_form() {
    let folder = Folder::new();
    let (csv, page) = (folder.path("map.csv"), folder.path("map.html"));
    let args = ["resonance", MULTI, "--scenario", "high-6"];
    let one = json(&run(&[&args[..], &["--json", "--quiet"]].concat()));
    let state = &one["states"][0];
    assert_eq!((state["state"].as_str(), one["rolls"].as_bool()), (Some("rolls"), Some(true)));
    let (_, found) = steady(&scene(MULTI, "high-6", 6.0, 100.0, 5000.0));
    let needs = state["required_static_friction"].as_f64().unwrap();
    assert_eq!(needs.to_bits(), found.required_friction.unwrap().to_bits());
    assert!(one["error_estimate"]["required_static_friction"].as_f64().unwrap() < 1e-6);
    let natural = prepare(&scene(MULTI, "high-6", 6.0, 100.0, 5000.0)).unwrap().train_modes().unwrap();
    assert_eq!(one["eigenfrequencies"][1]["frequency_hz"].as_f64(), Some(natural[1].frequency_hz));
    assert!(stdout(&run(&args)).contains("Natural frequencies, clutch engaged under the mean torque of "));
    assert!((state["work_in_j"].as_f64().unwrap() / state["lost_j"].as_f64().unwrap() - 1.0).abs() < 1e-5);
    let ranges = ["--frequency", "60:120", "--amplitude", "2:9", "--points", "3x2"];
    let map = run(&[&args[..], &ranges, &["--csv", &csv, "--report", &page, "--quiet"]].concat());
    assert_eq!(map.status.code(), Some(0), "{map:?}");
    assert!(stdout(&map).contains("of 6 states roll"), "{}", stdout(&map));
    assert_eq!(std::fs::read_to_string(csv).unwrap().lines().count(), 7);
    assert!(is_self_contained(page).contains("What the clutch does"));
    // States that the digits of the legend cannot tell apart have one shade, named once on each of two pictures.
    let like = folder.path("like.html");
    let near = ["--scenario", "low-10", "--frequency", "10:11", "--amplitude", "5:5.0001", "--points", "2x2"];
    run(&[&["resonance", MULTI], &near[..], &["--report", &like, "--quiet"]].concat());
    assert_eq!(std::fs::read_to_string(like).unwrap().matches(">needs 0.").count(), 2);
    // One row; and a state is told line by line, by the words of simulate.
    let row =
        [&args[..], &["--frequency", "60:120", "--amplitude", "2", "--points", "3x1", "--json"]].concat();
    assert_eq!(json(&run(&row))["states"].as_array().unwrap().len(), 3);
    let beyond = run(&[&args[..], &["--amplitude", "4000", "--quiet"]].concat());
    let last = stdout(&beyond).lines().last().unwrap().to_owned();
    assert!(beyond.status.code() == Some(0) && !stdout(&beyond).contains("State      ends"), "{beyond:?}");
    assert!(
        ["overloaded: ", "disengages: ", "lifts off"].iter().any(|word| last.starts_with(word)),
        "{last}"
    );
    // A drivetrain has motions of its own.
    let train = folder.changed(
        MULTI,
        &[("[check]", "[[drivetrain]]\nname = \"rotor\"\nto = \"outer-race\"\ninertia_kg_m2 = 1.0\nstiffness_nm_per_rad = 1e5\n\n[check]")],
    );
    let refused = run(&["resonance", &train, "--scenario", "high-6"]);
    let said = String::from_utf8_lossy(&refused.stderr).replace("\n  │ ", " ");
    assert!(refused.status.code() == Some(2) && said.contains("motions of their own"), "{said}");
    for (wrong, word) in [
        (["--frequency", "9:3"], "rises"),
        (["--amplitude", "0"], "above zero"),
        (["--points", "0x3"], "NxM"),
        (["--frequency=60:120", "--points=1x1"], "--frequency asks for 60:120"),
        (["--tolerance", "1"], "1e-9"),
        (["--scenario", "rated"], "did you mean"),
    ] {
        let asked = if wrong[0] == "--scenario" { &args[..2] } else { &args[..] };
        let refused = run(&[asked, &wrong].concat());
        assert_eq!(refused.status.code(), Some(2));
        assert!(String::from_utf8_lossy(&refused.stderr).contains(word), "{refused:?}");
    }
}

/// Both races swing on a soft abutment by themselves, multipliers near 1: they show the error of a period many times over, and Newton
/// stops short of what is asked unless the steps are finer.
#[test]
fn a_swing_on_a_soft_abutment_is_found() {
    let (_, found) =
        steady(&scene("tests/motion/designs/soft-abutment.toml", "second-order", 20.0, 5.0, 40.0));
    assert_eq!(found.kind, MotionKind::Rolls);
    let beside =
        steady(&scene("tests/motion/designs/soft-abutment.toml", "second-order", 20.0, 5.001, 40.0)).1;
    close(found.required_friction.unwrap(), beside.required_friction.unwrap(), 1e-5, "mu_req");
}
