//! The clutch as an element between two flanges, held against scenes, against balances that know nothing of the integrator,
//! and against itself.

use sprag_design::clutch::{Clutch, Start};
use sprag_design::dynamics::{Place, RunSettings, run};
use sprag_design::element::{Beginning, Element, Saved, Settings, Torque};
use sprag_design::scenario::{Prepared, prepare};
use sprag_design::{Design, Stop, WedgeCurve, simulate};

fn design(name: &str) -> Design {
    let path = format!("{}/designs/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    Design::read(path.as_ref()).unwrap()
}

fn still(inner_nm: f64, outer_nm: f64) -> [Torque; 2] {
    [Torque::constant(inner_nm), Torque::constant(outer_nm)]
}

fn line(inner_nm: f64, outer_nm: impl Fn(f64) -> f64, from_s: f64, until_s: f64) -> [Torque; 2] {
    [Torque::constant(inner_nm), Torque { start_nm: outer_nm(from_s), end_nm: outer_nm(until_s) }]
}

fn settings_of(prepared: &Prepared, tolerance: f64, longest_step_s: f64) -> RunSettings {
    RunSettings {
        tolerance,
        duration_s: prepared.duration_s,
        longest_step_s,
        most_steps: 200_000,
        ..RunSettings::default()
    }
}

/// The bench of the paper's Figure 8: overrun, reversed by a constant torque against a stop.
fn bench() -> (Clutch, Beginning, f64) {
    use sprag_design::ScenarioKind::Engagement;
    let design = design("huang2017-bench");
    let scene = design.scenarios.iter().find(|s| matches!(s.kind, Engagement { .. })).unwrap();
    let Engagement {
        free_run_rad_s,
        reversing_torque_nm,
        stop_stiffness_nm_per_rad,
        bench_inertia_kg_m2,
        ..
    } = scene.kind
    else {
        unreachable!()
    };
    let mut clutch = scene.clutch.clone();
    clutch.races.inner_inertia_kg_m2 += bench_inertia_kg_m2;
    let beginning = Beginning {
        overrun_rad_s: free_run_rad_s,
        abutment_nm_per_rad: stop_stiffness_nm_per_rad,
        ..Beginning::default()
    };
    (clutch, beginning, -reversing_torque_nm)
}

/// One advance over a whole scene whose torques are constant is that scene: free run, reversal, slip, stick.
#[test]
fn one_advance_over_an_engagement_is_the_scene_to_the_bit() {
    use sprag_design::ScenarioKind::Engagement;
    let design = design("huang2017-bench");
    let scene = design.scenarios.iter().find(|s| matches!(s.kind, Engagement { .. })).unwrap();
    let prepared = prepare(scene).unwrap();
    let (clutch, beginning, torque_nm) = bench();
    // The tolerances and longest steps of the runs of `simulate`, of which the last is its answer.
    let answer = simulate(scene, &Default::default()).unwrap();
    let (coarsest, mut matched): (f64, u32) = (100.0 * 1e-6, 0);
    let mut tolerance = coarsest;
    for pass in 1..8 {
        tolerance *= 0.1;
        let longest_step_s = (tolerance / coarsest).powf(1.0 / 8.0) * (prepared.duration_s / 200.0);
        let settings = Settings { tolerance, longest_step_s: Some(longest_step_s), ..Settings::default() };
        let mut element = Element::new(&clutch, &beginning, &settings).unwrap();
        let got = element.advance(prepared.duration_s, still(torque_nm, 0.0)).unwrap();
        let scene = run(
            &prepared.model,
            prepared.state,
            prepared.mode,
            &settings_of(&prepared, tolerance, longest_step_s),
        );
        assert_eq!((got.stop, got.events), (Stop::Finished, scene.events));
        assert_eq!(got.state.map(f64::to_bits), scene.state.map(f64::to_bits), "pass {pass}");
        assert_eq!(got.peaks, scene.peaks);
        assert_eq!(got.counters, scene.counters);
        assert!(got.events > 3, "{}", got.events);
        matched += u32::from(got.state[2].to_bits() == answer.theta_inner_rad.to_bits());
        let motion = element.motion();
        assert!((motion.flanges[0].angle_rad - got.state[2]).abs() < 1e-12);
        if matched > 0 {
            break;
        }
    }
    assert_eq!(matched, 1, "one of the passes is the answer of simulate");
}

/// Table 1 under 16.8 Nm and 6 Nm at 100 Hz, the torque handed over in straight pieces.
#[test]
fn a_torque_in_pieces_tends_to_the_scene() {
    let design = design("huang2017-multi-arc");
    for (name, torque_nm, amplitude_nm, most) in [("low-6", 16.8, 6.0, 6000), ("high-10", 3.34, 10.0, 15_000)]
    {
        let scene = design.scenario(name).unwrap();
        let expected = simulate(scene, &Default::default()).unwrap();
        let beginning = Beginning {
            torque_nm,
            start: Start::WithoutSpring,
            abutment_nm_per_rad: 5000.0,
            t_s: 7.5,
            angle_rad: 3.0,
            ..Beginning::default()
        };
        let omega = std::f64::consts::TAU * 100.0;
        let outer = |t: f64| amplitude_nm * (omega * t).sin();
        let off = |steps: u32| {
            let mut element = Element::new(&scene.clutch, &beginning, &Settings::default()).unwrap();
            let dt_s = 0.3 / f64::from(steps);
            let mut held_s = 0.0;
            for i in 0..steps {
                let from_s = dt_s * f64::from(i);
                let run = element.advance(dt_s, line(-torque_nm, outer, from_s, from_s + dt_s)).unwrap();
                assert_eq!(run.stop, Stop::Finished);
                held_s += dt_s - run.inner.time_s;
            }
            assert!((element.t_s() - 7.8).abs() < 1e-11);
            let slipped_s = element.slips()[0].time_s;
            assert!((held_s - (0.3 - slipped_s)).abs() < 1e-9);
            let [inner, outer] = element.motion().flanges;
            let error = (inner.angle_rad - 3.0 - expected.theta_inner_rad).abs();
            error.max((outer.angle_rad - 3.0 - expected.theta_outer_rad).abs())
        };
        let [coarse, middle, fine] = [off(600), off(1200), off(most)];
        println!("{name}: {coarse:.2e} {middle:.2e} {fine:.2e} rad");
        assert!(fine < 1e-6, "{name}: {fine:e}");
        // Straight pieces: error falls with the square of their length, where no event is displaced by it.
        if name == "low-6" {
            assert!(middle < 0.3 * coarse && fine < 0.1 * middle, "{coarse:e} {middle:e} {fine:e}");
        }
    }
}

/// Both races free, driven and braked: what comes in by the flanges, torque times angle, is in motion, stored, or lost in
/// friction and damping.
#[test]
fn energy_of_free_races_is_accounted_for() {
    let clutch = design("huang2017-multi-arc").clutch;
    let beginning = Beginning { speed_rad_s: 150.0, overrun_rad_s: 5.0, ..Beginning::default() };
    let settings = Settings { energy: true, tolerance: 1e-9, ..Settings::default() };
    let mut element = Element::new(&clutch, &beginning, &settings).unwrap();
    let (mut work, mut lost, mut kept, mut through) = (0.0, 0.0, 0.0, 0.0);
    let (mut slipped_s, mut stuck_s) = (0.0, 0.0);
    for i in 0..150 {
        // Brakes the inner race until the clutch engages, drives through it, lets go, drives again.
        let torque_nm = [1.0, 12.0, 0.0, 9.0, 2.0][i / 30];
        let before = *element.memory().state();
        let run = element.advance(2e-4, still(-torque_nm, 0.4 * torque_nm)).unwrap();
        assert_eq!(run.stop, Stop::Finished);
        let balance = run.energy.unwrap();
        // In the frame of the mean speed, as the balance is.
        work += torque_nm * (-(run.state[2] - before[2]) + 0.4 * (run.state[3] - before[3]));
        lost -= balance.friction_inner_j
            + balance.friction_outer_j
            + balance.race_damping_j
            + balance.contact_damping_j;
        kept += balance.kinetic_j + balance.stored_j;
        through += balance.through_j;
        slipped_s += run.inner.time_s;
        stuck_s += 2e-4 - run.inner.time_s - run.open_s;
    }
    println!("work {work:.6} J, lost {lost:.6} J, kept {kept:.6} J, through {through:.3} J");
    assert!(slipped_s > 1e-3 && stuck_s > 1e-3, "{slipped_s} {stuck_s}");
    assert!(lost > 1e-3 && work.abs() > 0.1, "{lost} {work}");
    assert!((work - lost - kept).abs() < 1e-6 * through, "{:e} of {through}", work - lost - kept);
}

/// Angular momentum about O of races and sprags, kg m^2/s, in the frame that turns with the mean speed.
fn angular_momentum(element: &Element, clutch: &Clutch) -> f64 {
    let (model, y, mode) = (element.model(), element.memory().state(), element.memory().mode());
    let p = model.point(mode.place, y[0]);
    let [alpha, phi, inner, outer] = model.rates(&mode, &p, y);
    let (s, r) = (&clutch.sprags, &clutch.races);
    let speed = model.curve.speed_rad_s();
    let orbit = s.mass_kg * p.oc_g * p.oc_g;
    r.inner_inertia_kg_m2 * inner
        + r.outer_inertia_kg_m2 * outer
        + s.count as f64 * (s.inertia_kg_m2 * (alpha + phi) + orbit * (phi + speed))
}

/// Equal and opposite torques change no angular momentum; others by torque times time.
#[test]
fn angular_momentum_of_free_races_is_kept() {
    let clutch = design("huang2017-multi-arc").clutch;
    let beginning = Beginning { speed_rad_s: 100.0, overrun_rad_s: 4.0, ..Beginning::default() };
    let mut element =
        Element::new(&clutch, &beginning, &Settings { tolerance: 1e-9, ..Settings::default() }).unwrap();
    let start = angular_momentum(&element, &clutch);
    let (mut places, mut given) = (Vec::new(), 0.0);
    for i in 0..80 {
        let (inner_nm, outer_nm) = if i < 60 { (-25.0, 25.0) } else { (-25.0, 28.0) };
        element.advance(2e-4, still(inner_nm, outer_nm)).unwrap();
        given += 2e-4 * (inner_nm + outer_nm);
        let off = angular_momentum(&element, &clutch) - start - given;
        assert!(off.abs() < 1e-7 * 1.41e-3 * 4.0, "{i}: {off:e}");
        places.push(element.memory().mode().place);
    }
    let arc = |k: usize| places.contains(&Place::Arc(k));
    assert!(arc(0) && arc(1), "{places:?}");
}

/// Two wheels on the spring that the engaged clutch is, sprags as they roll along: the frequency by hand.
#[test]
fn engaged_races_swing_at_the_frequency_of_two_inertias_on_the_curve() {
    let clutch = design("huang2017-single-arc").clutch;
    let torque_nm = 16.8;
    // Without spring and damping between the races, which would shift it.
    let mut clutch = clutch;
    clutch.spring.stiffness_nm_per_rad = 0.0;
    clutch.races.viscous_damping_nm_s_per_rad = 0.0;
    let beginning = Beginning { torque_nm, ..Beginning::default() };
    let mut element =
        Element::new(&clutch, &beginning, &Settings { tolerance: 1e-10, ..Settings::default() }).unwrap();
    // T = 1/2 x' M x', V = 1/2 k (theta_i - theta_e)^2; alpha' = (theta_e' - theta_i')/rho, phi' = theta_i' + rho_i alpha'.
    let curve = WedgeCurve::build(&clutch, &clutch.profile().unwrap(), 0.0).unwrap();
    let k = curve.at_torque(torque_nm).unwrap().k_tangent_nm_per_rad;
    let p = curve.in_arc(0, element.memory().state()[0]);
    let rho = p.rho_i + p.rho_e;
    let (s, r) = (&clutch.sprags, &clutch.races);
    let (alpha, phi) = ([-1.0 / rho, 1.0 / rho], [1.0 - p.rho_i / rho, p.rho_i / rho]);
    let mass = |i: usize, j: usize| {
        let own = s.inertia_kg_m2 * (alpha[i] + phi[i]) * (alpha[j] + phi[j]);
        let race = [r.inner_inertia_kg_m2, r.outer_inertia_kg_m2][i];
        s.count as f64 * (own + s.mass_kg * p.oc_g * p.oc_g * phi[i] * phi[j])
            + if i == j { race } else { 0.0 }
    };
    let (a, b, c) = (mass(0, 0), mass(1, 1), mass(0, 1));
    let omega = (k * (a + b + 2.0 * c) / (a * b - c * c)).sqrt();
    // A small push, then 20 half swings by the zeros of the relative speed.
    let period_s = std::f64::consts::TAU / omega;
    element.advance(0.1 * period_s, still(-torque_nm - 0.01, torque_nm + 0.01)).unwrap();
    let (dt_s, mut zeros, mut before) = (period_s / 100.0, Vec::new(), f64::NAN);
    while zeros.len() < 21 {
        element.advance(dt_s, still(-torque_nm, torque_nm)).unwrap();
        let motion = element.motion();
        let now = motion.flanges[0].speed_rad_s - motion.flanges[1].speed_rad_s;
        if before * now < 0.0 {
            zeros.push(element.t_s() - dt_s * now / (now - before));
        }
        before = now;
    }
    assert!(element.slips().iter().all(|slip| slip.time_s == 0.0));
    let measured = std::f64::consts::PI * 20.0 / (zeros[20] - zeros[0]);
    println!("by hand {omega:.4} rad/s, measured {measured:.4} rad/s");
    assert!((measured / omega - 1.0).abs() < 1e-5, "{measured} {omega}");
}

/// Through engagement and slip, saved as JSON at every step.
#[test]
fn a_restored_state_goes_on_to_the_bit() {
    let (clutch, beginning, torque_nm) = bench();
    let new = || Element::new(&clutch, &beginning, &Settings::default()).unwrap();
    let (mut one, mut other) = (new(), new());
    let mut modes = Vec::new();
    for i in 0..60 {
        let text = serde_json::to_string(&one.save()).unwrap();
        let torque_nm = torque_nm * [1.0, 1.5, -0.5, 2.0][i as usize / 15];
        let torques = [Torque { start_nm: torque_nm, end_nm: 0.9 * torque_nm }, Torque::constant(0.0)];
        one.advance(5e-4, torques).unwrap();
        let after = one.save();
        // Astray, and back.
        one.advance(1e-3, still(3.0, -7.0)).unwrap();
        one.restore(&serde_json::from_str::<Saved>(&text).unwrap()).unwrap();
        one.advance(5e-4, torques).unwrap();
        assert_eq!(
            serde_json::to_string(&one.save()).unwrap(),
            serde_json::to_string(&after).unwrap(),
            "{i}"
        );
        other.restore(&serde_json::from_str::<Saved>(&text).unwrap()).unwrap();
        other.advance(5e-4, torques).unwrap();
        assert_eq!(other.save(), after);
        assert_eq!(format!("{:?}", other.motion()), format!("{:?}", one.motion()));
        modes.push(format!("{:?}", one.memory().mode()));
    }
    modes.dedup();
    assert!(modes.len() > 2, "{modes:?}");
}

/// Friction and inertia change on the way: angles and speeds stay, accelerations follow; the same clutch is no change.
#[test]
fn another_clutch_goes_on_from_the_same_motion() {
    let clutch = design("huang2017-multi-arc").clutch;
    let beginning = Beginning { torque_nm: 16.8, speed_rad_s: 50.0, ..Beginning::default() };
    let mut element = Element::new(&clutch, &beginning, &Settings::default()).unwrap();
    let torques = still(-20.0, 18.0);
    element.advance(1e-3, torques).unwrap();
    let mut heavy = clutch.clone();
    heavy.races.outer_inertia_kg_m2 *= 2.0;
    heavy.friction.static_ = 0.2;
    let mut other = element.exchanged(&heavy).unwrap();
    let mut same = element.exchanged(&clutch).unwrap();
    let (before, after) = (element.motion(), other.motion());
    for i in 0..2 {
        assert_eq!(before.flanges[i].angle_rad, after.flanges[i].angle_rad);
        assert_eq!(before.flanges[i].speed_rad_s, after.flanges[i].speed_rad_s);
    }
    let ratio = before.flanges[1].acceleration_rad_s2 / after.flanges[1].acceleration_rad_s2;
    assert!((ratio - 2.0).abs() < 0.05, "{ratio}");
    for each in [&mut element, &mut other, &mut same] {
        assert_eq!(each.advance(1e-3, torques).unwrap().stop, Stop::Finished);
    }
    let angle = |e: &Element| e.motion().flanges[0].angle_rad;
    assert!((angle(&element) - angle(&same)).abs() < 1e-12);
    assert!((angle(&element) - angle(&other)).abs() > 1e-7);
    let far = Beginning { torque_nm: 60.0, ..Beginning::default() };
    let far = Element::new(&clutch, &far, &Settings::default()).unwrap();
    let mut short = clutch.clone();
    short.sprags.inner_arcs.truncate(1);
    let mut short = far.exchanged(&short).unwrap();
    assert_eq!(short.advance(1e-4, still(-60.0, 60.0)).unwrap().stop, Stop::CurveEnd);
}

/// Hours of overrun turn the races thousands of times; what follows is the same.
#[test]
fn time_and_turns_behind_it_do_not_matter() {
    let (clutch, mut beginning, torque_nm) = bench();
    beginning.abutment_nm_per_rad = 0.0;
    let end = |t_s: f64, angle_rad: f64| {
        let b = Beginning { t_s, angle_rad, ..beginning };
        let mut element = Element::new(&clutch, &b, &Settings::default()).unwrap();
        for _ in 0..40 {
            element.advance(1e-3, still(torque_nm, -torque_nm)).unwrap();
        }
        *element.memory().state()
    };
    assert_eq!(end(0.0, 0.0), end(1e6, -4e5));
}

#[test]
fn malformed_questions_are_refused_in_words() {
    let clutch = design("huang2017-multi-arc").clutch;
    let new = |b: Beginning, s: Settings| Element::new(&clutch, &b, &s).map(drop).unwrap_err().to_string();
    let b = Beginning::default();
    for (b, said) in [
        (Beginning { torque_nm: f64::NAN, ..b }, "torque at the start (Nm): found NaN"),
        (Beginning { torque_nm: -1.0, ..b }, "torque at the start (Nm): found -1, 0 to 1e9 is allowed"),
        (Beginning { overrun_rad_s: f64::INFINITY, ..b }, "overrun (rad/s): found inf"),
        (Beginning { speed_rad_s: f64::NAN, ..b }, "speed"),
        (Beginning { abutment_nm_per_rad: -5.0, ..b }, "abutment"),
        (Beginning { torque_nm: 1e6, ..b }, "is not carried: the curve ends at"),
        (Beginning { speed_rad_s: 1e6, ..b }, "no wedge curve"),
        (Beginning { speed_rad_s: 1e200, ..b }, "at most 1e6 either way is allowed"),
    ] {
        let got = new(b, Settings::default());
        assert!(got.contains(said), "{got}");
    }
    for tolerance in [0.0, -1.0, f64::NAN, 1.0] {
        assert!(new(b, Settings { tolerance, ..Settings::default() }).contains("tolerance"));
    }
    let mut element = Element::new(&clutch, &b, &Settings::default()).unwrap();
    let saved = element.save();
    for dt_s in [0.0, -1e-3, 1e-300, f64::NAN, f64::INFINITY] {
        assert!(element.advance(dt_s, still(0.0, 0.0)).unwrap_err().to_string().contains("step (s)"));
    }
    for torques in [still(f64::NAN, 0.0), still(0.0, f64::NEG_INFINITY), still(1e300, 0.0)] {
        let now = torques.map(|t| t.start_nm);
        assert!(element.apply(now).unwrap_err().to_string().contains("flange (Nm)"));
        assert!(element.advance(1e-3, torques).unwrap_err().to_string().contains("flange (Nm)"));
    }
    assert_eq!(element.save(), saved);
    // A state that no clutch with three arcs has.
    let text = serde_json::to_string(&saved).unwrap().replace("{\"Arc\":0}", "{\"Arc\":7}");
    assert!(text.contains("{\"Arc\":7}"), "{text}");
    assert!(element.restore(&serde_json::from_str(&text).unwrap()).is_err());
    // One that no machine reaches.
    let text = serde_json::to_string(&saved).unwrap();
    let alpha = format!("{:?}", saved_state(&text)[0]);
    let text = text.replacen(&alpha, "1e16", 1);
    assert!(element.restore(&serde_json::from_str(&text).unwrap()).is_err());
    assert_eq!(element.save(), saved);
}

fn saved_state(text: &str) -> Vec<f64> {
    let value: serde_json::Value = serde_json::from_str(text).unwrap();
    serde_json::from_value(value["memory"]["state"].clone()).unwrap()
}

/// Beyond its curve the clutch has come to its end: a result, with a name, and no advance leads on.
#[test]
fn overload_is_an_end_with_a_name() {
    let clutch = design("huang2017-multi-arc").clutch;
    let mut element = Element::new(&clutch, &Beginning::default(), &Settings::default()).unwrap();
    let mut stop = Stop::Finished;
    for _ in 0..200 {
        stop = element.advance(1e-3, still(-2000.0, 2000.0)).unwrap().stop;
        if stop != Stop::Finished {
            break;
        }
    }
    assert_eq!((stop, element.ended()), (Stop::CurveEnd, Some(Stop::CurveEnd)));
    assert!(element.advance(1e-3, still(0.0, 0.0)).unwrap_err().to_string().contains("curve-end"));
}
