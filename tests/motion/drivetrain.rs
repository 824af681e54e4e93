//! Drivetrains on either side of the clutch: against an independent script, the stepping API, hand formulas and balances.

use sprag_design::answer::simulation::{SimulationAnswer, SimulationSettings};
use sprag_design::design::Design;
use sprag_design::dynamics::Grip;
use sprag_design::element::{Beginning, Element, Settings as Stepping, Torque};
use sprag_design::scenario::{Settings, prepare, simulate};
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::path::Path;

const REFERENCE: &str = "tests/reference/drivetrain.toml";

fn read(path: &str) -> Design {
    Design::read(Path::new(path)).unwrap_or_else(|e| panic!("{e}"))
}

/// The clutch of `path` with other drivetrains and scenarios.
fn with(path: &str, rest: &str) -> String {
    let text = std::fs::read_to_string(path).unwrap();
    let clutch = text.split("[limits]").next().unwrap().split("[[drivetrain]]").next().unwrap();
    format!("{clutch}\n{rest}")
}

fn parse(text: &str) -> Design {
    Design::parse_in(Path::new("tests/reference"), text, "x.toml").unwrap_or_else(|e| panic!("{e}"))
}

fn ran(design: &Design, scene: &str, rows: usize, tolerance: f64) -> SimulationAnswer {
    let ask =
        SimulationSettings { tolerance: Some(tolerance), rows: Some(rows), ..SimulationSettings::default() };
    design.simulate(scene, &ask).unwrap_or_else(|e| panic!("{e}"))
}

fn columns(answer: &SimulationAnswer) -> impl Fn(&str) -> Vec<f64> + use<> {
    let history = answer.history();
    move |name| history.numbers(name).unwrap_or_else(|| panic!("no column {name}")).to_vec()
}

/// Columns of a reference by name.
fn table(path: &str) -> BTreeMap<String, Vec<f64>> {
    let text = std::fs::read_to_string(path).unwrap();
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let rows: Vec<Vec<f64>> = lines.map(|l| l.split(',').map(|x| x.parse().unwrap()).collect()).collect();
    names.iter().enumerate().map(|(i, n)| ((*n).to_owned(), rows.iter().map(|r| r[i]).collect())).collect()
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m: f64, v| m.max(v.abs()))
}

#[track_caller]
fn near(what: &str, found: &[f64], expected: &[f64], relative: f64) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let scale = largest(expected);
    let off = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    println!("{what}: {:.1e} of {scale:.4}", off / scale);
    assert!(off <= relative * scale, "{what}: {off:e} of {scale}");
}

/// Gears, one of them turning back, a branch, a rigid inertia, constant torques, a history with a jump, orders, gas: every
/// figure to 1e-7 of its largest. The script's own error is some 1e-9, that of the trajectory here 1e-9 of its angles.
#[test]
fn the_motion_is_that_of_an_independent_script() {
    let (design, expected) = (read(REFERENCE), table("tests/reference/drivetrain.csv"));
    let answer = ran(&design, "all", 11, 1e-9);
    let column = columns(&answer);
    let moved = |name: &str| {
        let values = column(name);
        values.iter().map(|v| v - values[0]).collect::<Vec<_>>()
    };
    near("time", &column("time_s"), &expected["time_s"], 1e-12);
    near("inner race", &moved("theta_inner_rad"), &expected["inner_moved_rad"], 1e-7);
    near("outer race", &moved("theta_outer_rad"), &expected["outer_moved_rad"], 1e-7);
    near("clutch", &column("torque_nm"), &expected["clutch_nm"], 1e-7);
    for name in ["motor", "pump", "gearbox", "engine"] {
        let rad_s: Vec<f64> = column(&format!("{name}_speed_rpm")).iter().map(|v| v * TAU / 60.0).collect();
        near(name, &moved(&format!("{name}_angle_rad")), &expected[&format!("{name}_moved_rad")], 1e-7);
        near(name, &rad_s, &expected[&format!("{name}_speed_rad_s")], 1e-7);
        near(name, &column(&format!("{name}_shaft_nm")), &expected[&format!("{name}_shaft_nm")], 1e-7);
    }
}

#[test]
fn eigenfrequencies_and_damping_are_those_of_the_script() {
    let (design, expected) = (read(REFERENCE), table("tests/reference/drivetrain_modes.csv"));
    let modes = prepare(design.scenario("all").unwrap()).unwrap().train_modes().unwrap();
    let frequencies: Vec<f64> = modes.iter().map(|m| m.frequency_hz).collect();
    let ratios: Vec<f64> = modes.iter().map(|m| m.damping_ratio).collect();
    for (i, mode) in modes.iter().enumerate() {
        let [hz, ratio] = [expected["frequency_hz"][i], expected["damping_ratio"][i]];
        near(&mode.moves, &[mode.frequency_hz], &[hz], 1e-7);
        near(&mode.moves, &[mode.damping_ratio], &[ratio], 1e-6);
    }
    assert_eq!((frequencies.len(), ratios.len()), (5, 5));
    let names: Vec<&str> = modes.iter().map(|m| m.moves.as_str()).collect();
    assert_eq!(names, ["motor", "engine", "outer race", "inner race", "pump"]);
}

/// A motor and a load, each on a shaft; the motor's torque rises by 6 Nm over 1 ms.
const TWO: &str = r#"
[[drivetrain]]
name = "motor"
to = "outer-race"
inertia_kg_m2 = 2.0e-3
stiffness_nm_per_rad = 900.0
damping_nm_s_per_rad = 0.05
torque_nm = 12.0
torque_history_csv = "drivetrain_rise.csv"

[[drivetrain]]
name = "load"
to = "inner-race"
inertia_kg_m2 = 3.0e-3
stiffness_nm_per_rad = 700.0
damping_nm_s_per_rad = 0.08
torque_nm = -14.0

[[scenarios]]
name = "rise"
kind = "transient"
duration_s = 0.004
"#;

/// The stepping API between shafts that this test moves itself: torques straight over a step, the step repeated until
/// both ends agree (trapezoidal rule), extrapolated from two lengths of step.
fn coupled(dt_s: f64) -> [f64; 4] {
    const J: [f64; 2] = [3.0e-3, 2.0e-3];
    const K: [f64; 2] = [700.0, 900.0];
    const D: [f64; 2] = [0.08, 0.05];
    let design = parse(&with("designs/huang2017-multi-arc.toml", TWO));
    let clutch = &design.clutch;
    // All speed up alike: what the clutch passes on brings the inner side along.
    let races = [clutch.races.inner_inertia_kg_m2, clutch.races.outer_inertia_kg_m2];
    let total: f64 = J.iter().chain(&races).sum();
    let carried = 14.0 + (J[0] + races[0]) * (12.0 - 14.0) / total;
    let acceleration = (12.0 - 14.0) / total;
    let twist = [(-14.0 - J[0] * acceleration) / K[0], (12.0 - J[1] * acceleration) / K[1]];
    let settings = Stepping { tolerance: 1e-10, ..Stepping::default() };
    let beginning = Beginning { torque_nm: carried, ..Beginning::default() };
    let mut element = Element::new(clutch, &beginning, &settings).unwrap_or_else(|e| panic!("{e}"));
    let race = |e: &Element| {
        let y = e.memory().state();
        [[y[2], y[6]], [y[3], y[7]]]
    };
    let begin = race(&element);
    let mut ends: [[f64; 2]; 2] = [0, 1].map(|i| [begin[i][0] + twist[i], 0.0]);
    let outside = |t: f64| [-14.0, 12.0 + 6.0 * (t / 1e-3).min(1.0)];
    let shaft = |races: [[f64; 2]; 2], ends: [[f64; 2]; 2]| -> [f64; 2] {
        [0, 1].map(|i| K[i] * (ends[i][0] - races[i][0]) + D[i] * (ends[i][1] - races[i][1]))
    };
    for step in 0..(0.004 / dt_s).round() as usize {
        let t = step as f64 * dt_s;
        let (saved, before) = (element.save(), shaft(race(&element), ends));
        let (mut after, mut next) = (before, ends);
        for _ in 0..6 {
            element.restore(&saved).unwrap();
            let torques = [0, 1].map(|i| Torque { start_nm: before[i], end_nm: after[i] });
            element.advance(dt_s, torques).unwrap();
            let (from, until) = (outside(t), outside(t + dt_s));
            next = [0, 1].map(|i| {
                let [a, b] = [(from[i] - before[i]) / J[i], (until[i] - after[i]) / J[i]];
                // Straight acceleration over the step, exactly.
                let [angle, rate] = ends[i];
                [angle + dt_s * rate + dt_s * dt_s * (a / 3.0 + b / 6.0), rate + 0.5 * dt_s * (a + b)]
            });
            after = shaft(race(&element), next);
        }
        ends = next;
    }
    let end = race(&element);
    [end[0][0] - begin[0][0], end[1][0] - begin[1][0], ends[0][0] - begin[0][0], ends[1][0] - begin[1][0]]
}

#[test]
fn shafts_around_the_stepping_api_move_as_those_inside() {
    let design = parse(&with("designs/huang2017-multi-arc.toml", TWO));
    let answer = ran(&design, "rise", 2, 1e-9);
    let column = columns(&answer);
    let moved = |name: &str| column(name)[1] - column(name)[0];
    let inside = [moved("theta_inner_rad"), moved("theta_outer_rad")];
    let start = column("theta_inner_rad")[0];
    let ends = [column("load_angle_rad")[1] - start, column("motor_angle_rad")[1]];
    let [coarse, fine] = [4e-5, 2e-5].map(coupled);
    let outside: [f64; 4] = std::array::from_fn(|i| (4.0 * fine[i] - coarse[i]) / 3.0);
    println!("{inside:?} {ends:?} {outside:?} {coarse:?}");
    near("races", &inside, &outside[..2], 1e-6);
    near("ends", &ends, &outside[2..], 1e-6);
}

/// An inertia without a shaft is one of the race, to rounding; on a stiff shaft it is, but for the shaft's own swing.
#[test]
fn a_rigid_inertia_is_that_of_the_race_and_a_stiff_shaft_comes_near_it() {
    let scene = r#"
[[scenarios]]
name = "s"
kind = "torsional-excitation"
preload_nm = 16.8
amplitude_nm = 6.0
frequency_hz = 100.0
abutment_stiffness_nm_per_rad = 5000.0
duration_s = 0.02
"#;
    let base = with("designs/huang2017-multi-arc.toml", scene);
    let end = |text: &str| {
        let design = parse(text);
        let s = simulate(&design.scenarios[0], &Settings { tolerance: 1e-9, ..Settings::default() }).unwrap();
        (s.theta_inner_rad, s.demand.unwrap().slip_margin.unwrap())
    };
    let lumped = end(&base.replace("inner_inertia_kg_m2 = 1.41e-3", "inner_inertia_kg_m2 = 3.66e-3"));
    let joined = |stiffness: &str| {
        let one = "[[drivetrain]]\nname = \"x\"\nto = \"inner-race\"\nratio = -1.5\ninertia_kg_m2 = 1.0e-3\n";
        end(&format!("{base}{one}{stiffness}"))
    };
    let rigid = joined("");
    assert!((rigid.0 - lumped.0).abs() < 1e-12 && (rigid.1 - lumped.1).abs() < 1e-10, "{rigid:?} {lumped:?}");
    let by_stiffness = [1e5, 1e6, 1e7].map(|k: f64| {
        let damped = format!("stiffness_nm_per_rad = {k:e}\ndamping_nm_s_per_rad = {:e}\n", 0.02 * k.sqrt());
        (joined(&damped).0 - lumped.0).abs()
    });
    println!("{by_stiffness:?}");
    // The error falls as 1/k.
    assert!(
        by_stiffness[0] < 1e-3 * lumped.0.abs() && by_stiffness[2] < 2e-2 * by_stiffness[0],
        "{by_stiffness:?}"
    );
}

/// Races and two inertias by hand: with the clutch as a spring k of two masses, f = sqrt(k (1/J_1 + 1/J_2))/2 pi.
#[test]
fn two_inertias_on_the_clutch_swing_as_by_hand_and_gears_reflect() {
    let scene = "\n[[scenarios]]\nname = \"s\"\nkind = \"transient\"\nduration_s = 0.01\npreload_nm = 12.0\n";
    let one = |ratio: f64, inertia: f64, stiffness: f64| {
        format!(
            "[[drivetrain]]\nname = \"x\"\nto = \"outer-race\"\nratio = {ratio:e}\ninertia_kg_m2 = {inertia:e}\n\
             stiffness_nm_per_rad = {stiffness:e}\ntorque_nm = {:e}\n",
            12.0 / ratio
        )
    };
    let modes = |train: &str| {
        let design = parse(&with(REFERENCE, &format!("{train}{scene}")));
        let p = prepare(&design.scenarios[0]).unwrap();
        let alpha = p.state[0];
        let k = p.model.curve.at_normal(p.static_normal_n).unwrap().k_tangent_nm_per_rad;
        (p.train_modes().unwrap(), k, alpha)
    };
    // Rigid and all but massless: the races alone.
    let (found, k, _) = modes("[[drivetrain]]\nname = \"x\"\nto = \"outer-race\"\ntorque_nm = 12.0\n");
    let by_hand = (k * (2.0 / 1.41e-3)).sqrt() / TAU;
    assert_eq!(found.len(), 1);
    assert!((found[0].frequency_hz / by_hand - 1.0).abs() < 1e-6, "{} {by_hand}", found[0].frequency_hz);
    // Damping between the races: c/2 sqrt((1/J_1 + 1/J_2)/k).
    let ratio = 0.05 * (2.0 / 1.41e-3 / k).sqrt();
    assert!((found[0].damping_ratio / ratio - 1.0).abs() < 1e-6, "{}", found[0].damping_ratio);
    // A gear of 3: inertia and stiffness by 9, the other sense of rotation too.
    let (plain, ..) = modes(&one(1.0, 9.0e-4, 450.0));
    for ratio in [3.0, -3.0, 0.25] {
        let (geared, ..) = modes(&one(ratio, 9.0e-4 / (ratio * ratio), 450.0 / (ratio * ratio)));
        for (a, b) in plain.iter().zip(&geared) {
            assert!((a.frequency_hz / b.frequency_hz - 1.0).abs() < 1e-9, "{a:?} {b:?}");
            let of = |m: &sprag_design::dynamics::TrainMode| m.shape[2].1 / m.shape[0].1;
            assert!((of(b) / (ratio * of(a)) - 1.0).abs() < 1e-6, "{a:?} {b:?}");
        }
    }
    // An inertia far heavier than the rest stands still: the outer race swings on its shaft against it.
    let (heavy, ..) = modes(&one(1.0, 1e9, 1e9));
    assert_eq!(heavy.len(), 2);
    assert!((heavy[0].frequency_hz / ((k / 1.41e-3).sqrt() / TAU) - 1.0).abs() < 1e-5, "{heavy:?} {k}");
}

/// A free train keeps its momentum, and every balance of the designs closes; their scenes do what they are there for.
#[test]
fn a_free_train_keeps_its_momentum_and_energies_balance() {
    let free = r#"
[[drivetrain]]
name = "a"
to = "outer-race"
ratio = 2.0
inertia_kg_m2 = 4.0e-4
stiffness_nm_per_rad = 300.0
damping_nm_s_per_rad = 0.02
[[drivetrain]]
name = "kick"
to = "a"
torque_history_csv = "drivetrain_kick.csv"
[[drivetrain]]
name = "b"
to = "inner-race"
ratio = -0.5
inertia_kg_m2 = 8.0e-3
stiffness_nm_per_rad = 6000.0
[[scenarios]]
name = "s"
kind = "transient"
duration_s = 0.03
"#;
    let design = parse(&with("designs/huang2017-multi-arc.toml", free));
    let answer = ran(&design, "s", 31, 1e-8);
    let column = columns(&answer);
    let rpm = TAU / 60.0;
    let (a, b) = (column("a_speed_rpm"), column("b_speed_rpm"));
    let (i, e) = (column("theta_inner_rate_rad_per_s"), column("theta_outer_rate_rad_per_s"));
    // On the shaft of the races, sprags left out: 12 of 1.8 g at 15 mm are 2e-3 of it.
    let of = |k: usize| 1.41e-3 * (i[k] + e[k]) + 2.0 * 4.0e-4 * a[k] * rpm - 0.5 * 8.0e-3 * b[k] * rpm;
    // 4 Nm over 5 ms on a, twice that on the races.
    let kicked = 2.0 * 4.0 * 0.005;
    let momenta: Vec<f64> = (6..31).map(of).collect();
    for momentum in &momenta {
        assert!((momentum / kicked - 1.0).abs() < 5e-3, "{momentum} {kicked}");
    }
    let balance = answer.body.energy_balance.as_ref().unwrap();
    println!("{balance:?}");
    assert!(balance.relative.abs() < 1e-7 && balance.torque_outer_j > 0.1, "{balance:?}");
}

#[test]
fn the_three_drives_do_what_they_are_there_for() {
    let answer = |file: &str, scene: &str| ran(&read(&format!("designs/{file}.toml")), scene, 200, 1e-6);
    let cranking = answer("starter-engine", "cranking");
    assert_eq!(cranking.verdict(), Some("sticks"));
    // Compression brakes and expansion drives: the shaft of the crank swings far beyond its mean, always loaded.
    let shaft = columns(&cranking)("crank_shaft_nm");
    let [low, high] = [f64::min, f64::max].map(|f| shaft.iter().copied().reduce(f).unwrap());
    assert!(low < -100.0 && high < 0.0 && high > 0.7 * low, "{low} {high}");
    assert!(cranking.body.slip_margin.unwrap() > 0.3 && cranking.body.eigenfrequencies.len() == 3);
    // It fires: the pinion runs ahead.
    let fires = answer("starter-engine", "fires");
    let column = columns(&fires);
    let ahead = column("theta_inner_rate_rad_per_s").into_iter().zip(column("theta_outer_rate_rad_per_s"));
    let ahead = ahead.map(|(i, e)| i - e).fold(0.0, f64::max);
    assert!(ahead > 3.0 && fires.body.contact_lost_s.unwrap() > 1e-3, "{ahead}");
    // Two speeds: in low gear it carries, then overruns, then carries more than before.
    let shift = answer("two-speed-rotor", "shift-up");
    let column = columns(&shift);
    let (time, torque) = (column("time_s"), column("torque_nm"));
    let at = |t: f64| torque[time.iter().position(|&x| x >= t).unwrap()];
    assert!((at(0.0) - 1800.0).abs() < 1.0 && at(0.045).abs() < 20.0 && at(0.088) > 1800.0, "{}", at(0.088));
    // Indexing: the lever comes back, the rolls stay ahead.
    let strokes = answer("indexing-drive", "strokes");
    let column = columns(&strokes);
    let (lever, rolls) = (column("lever_angle_rad"), column("rolls_angle_rad"));
    let moved = |x: &[f64]| x[160] - x[0];
    println!("{} {}", moved(&lever), moved(&rolls));
    assert!(moved(&lever).abs() < 1e-3 && moved(&rolls) > 0.05, "{} {}", moved(&lever), moved(&rolls));
    for answer in [&cranking, &fires, &shift, &strokes] {
        assert!(answer.body.energy_balance.as_ref().unwrap().relative.abs() < 1e-6);
    }
}

/// A given speed over a stiff shaft is that of the race; where the clutch has overrun, the demand of rolling goes on with the
/// shafts as they are then.
#[test]
fn a_driven_race_turns_as_it_is_told_and_rolling_goes_on_after_an_overrun() {
    let driven = r#"
[[drivetrain]]
name = "flange"
to = "inner-race"
ratio = 2.0
stiffness_nm_per_rad = 2.0e6
damping_nm_s_per_rad = 2.0e2
speed_history_csv = "drivetrain_turn.csv"
[[drivetrain]]
name = "mass"
to = "outer-race"
inertia_kg_m2 = 1.0e-3
stiffness_nm_per_rad = 800.0
damping_nm_s_per_rad = 0.1
[[scenarios]]
name = "catch"
kind = "transient"
duration_s = 0.02
overrun_rpm = 60.0
abutment_stiffness_nm_per_rad = 5000.0
"#;
    let design = parse(&with("designs/huang2017-multi-arc.toml", driven));
    let answer = ran(&design, "catch", 41, 1e-7);
    let column = columns(&answer);
    let (time, rate) = (column("time_s"), column("theta_inner_rate_rad_per_s"));
    for (t, rate) in time.iter().zip(&rate) {
        // 120 rev/min of the flange at the start, -12 after 10 ms, then 0 until 15 ms.
        let rpm = if *t < 0.01 { 120.0 - 13_200.0 * t } else { (-12.0 + 2400.0 * (t - 0.01)).min(0.0) };
        assert!((rate - 0.5 * rpm * TAU / 60.0).abs() < 0.05, "{t}: {rate} {rpm}");
    }
    let s = answer.simulation().unwrap();
    let engaged = s.engaged.unwrap();
    assert!(engaged.t_s > 0.008 && engaged.t_s < 0.0101, "{engaged:?}");
    let demand = s.demand.unwrap();
    assert!(demand.finished && demand.normal_max_n[0] > 50.0, "{demand:?}");
    // Rolling from the moment of engagement carries what the run itself does while that sticks.
    assert!((demand.normal_max_n[0] / s.peaks.normal_max_n - 1.0).abs() < 0.05, "{demand:?} {:?}", s.peaks);
    assert!(s.modes.iter().any(|(_, m)| m.inner == Grip::Stick));
}

#[test]
fn what_is_wrong_is_told_with_line_and_key() {
    let scene = "[[scenarios]]\nname = \"s\"\nkind = \"transient\"\nduration_s = 0.01\n";
    let a = "[[drivetrain]]\nname = \"a\"\nto = \"inner-race\"\ninertia_kg_m2 = 1e-3\nstiffness_nm_per_rad = 100.0\n";
    let long = |n: usize| -> String {
        (0..n).map(|i| a.replace("\"a\"", &format!("\"n{i}\""))).collect::<Vec<_>>().concat()
    };
    let driven = "[[drivetrain]]\nname = \"d\"\nto = \"outer-race\"\nstiffness_nm_per_rad = 100.0\nspeed_history_csv = \"drivetrain_turn.csv\"\n";
    let cases: Vec<(String, &str, &str)> = vec![
        (a.replace("1e-3", "-1e-3"), "drivetrain[0].inertia_kg_m2", "of at least 0"),
        (a.replace("1e-3", "0.0"), "drivetrain[0].inertia_kg_m2", "above 0 on a shaft"),
        (format!("{a}ratio = 0.0\n"), "drivetrain[0].ratio", "other than 0"),
        (
            format!(
                "{a}ratio = 1e4\n{}ratio = 1e4\n",
                a.replace("\"a\"", "\"b\"").replace("inner-race", "a")
            ),
            "drivetrain[1].ratio",
            "1e-6 to 1e6 turns for one of the race in all, found 1e8",
        ),
        (a.replace("inner-race", "inner-rase"), "drivetrain[0].to", "did you mean inner-race"),
        (a.replace("inner-race", "a"), "drivetrain[0].to", "goes round in a ring"),
        (a.replace("\"a\"", "\"outer-race\""), "drivetrain[0].name", "none of a race"),
        (format!("{a}{a}"), "drivetrain[1].name", "no other inertia has"),
        (
            format!(
                "{}{}",
                a.replace("inner-race", "b"),
                a.replace("\"a\"", "\"b\"").replace("inner-race", "a")
            ),
            "drivetrain[0].to",
            "leads to a race",
        ),
        (long(9), "drivetrain", "at most 8 inertias on shafts, found 9"),
        (
            a.replace("stiffness_nm", "damping_nm_s"),
            "drivetrain[0].damping_nm_s_per_rad",
            "only together with",
        ),
        (a.replace("= 100.0", "= 0.0"), "drivetrain[0].stiffness_nm_per_rad", "above 0"),
        (format!("{a}torque_history_csv = \"none.csv\"\n"), "drivetrain[0].torque_history_csv", "CSV file"),
        (
            format!("{driven}torque_nm = 3.0\n"),
            "drivetrain[0].torque_nm",
            "no torque_nm where the speed is given",
        ),
        (
            driven.replace("stiffness_nm_per_rad = 100.0\n", ""),
            "drivetrain[0].speed_history_csv",
            "only together with stiffness_nm_per_rad",
        ),
        (
            format!("{driven}{}", driven.replace("\"d\"", "\"e\"")),
            "drivetrain",
            "one given speed on the side",
        ),
        (format!("{driven}{}", a.replace("inner-race", "d")), "drivetrain[1].to", "beyond a given speed"),
        (
            format!("{a}orders = [{{ order = 0.0, amplitude_nm = 1.0 }}]\n"),
            "drivetrain[0].orders[0].order",
            "above 0",
        ),
        (
            format!(
                "{a}gas = {{ cylinders = 0, bore_mm = 80.0, stroke_mm = 80.0, compression_ratio = 10.0 }}\n"
            ),
            "drivetrain[0].gas.cylinders",
            "of at least 1",
        ),
    ];
    for (train, key, words) in &cases {
        refused(&format!("{train}{scene}"), key, words);
    }
    refused(
        &format!("{a}{scene}drivetrain = [\"b\"]\n"),
        "scenarios[0].drivetrain",
        "names of [[drivetrain]]: a",
    );
    let b = a.replace("\"a\"", "\"b\"").replace("inner-race", "a");
    refused(
        &format!("{a}{b}{scene}drivetrain = [\"b\"]\n"),
        "scenarios[0].drivetrain",
        "a too, which b is joined to",
    );
    refused(
        &format!(
            "{a}[[scenarios]]\nname = \"s\"\nkind = \"static\"\ntorque_nm = 3.0\ndrivetrain = [\"a\"]\n"
        ),
        "scenarios[0].drivetrain",
        "for kind static",
    );
    // Without a drivetrain the outer race is tied and something changes, as before.
    refused(&format!("{a}{scene}drivetrain = []\n"), "scenarios[0].abutment_stiffness_nm_per_rad", "add");
    assert!(parse(&with(REFERENCE, &format!("{}{scene}", long(8)))).scenarios[0].drivetrain.len() == 8);
}

#[track_caller]
fn refused(rest: &str, key: &str, words: &str) {
    let text = with(REFERENCE, rest);
    let error = Design::parse_in(Path::new("tests/reference"), &text, "x.toml").expect_err(rest);
    let told = error.to_string();
    let problem = error.problems().iter().find(|p| p.key == key).unwrap_or_else(|| panic!("{key}: {told}"));
    assert!(problem.place.is_some() && told.contains(words), "{key}, {words}: {told}");
}
