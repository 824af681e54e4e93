//! The clutch between flanges of which one or both are given their speed, held against flanges that are given torques, against
//! large inertias and against the energy.

use sprag_design::clutch::Clutch;
use sprag_design::dynamics::Place;
use sprag_design::element::{Beginning, Element, Flange, Port, Saved, Settings, Torque};
use sprag_design::{Design, Stop};

fn design(name: &str) -> Design {
    let path = format!("{}/designs/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    Design::read(path.as_ref()).unwrap()
}

/// What `element` says of a flange.
fn flange_nm(element: &Element, race: usize) -> f64 {
    element.motion().flanges[race].torque_nm
}

/// Speeds that a run under torques came to, given back at one flange or at both: the contact carries the same, and the flange
/// asks for the torque that was there. Between the ends of a step the speed is straight, which the run's was not: the error
/// falls with the square of the step.
#[test]
fn given_speeds_ask_for_the_torques_that_made_them() {
    let clutch = design("huang2017-multi-arc").clutch;
    let beginning = Beginning { speed_rad_s: 100.0, torque_nm: 15.0, ..Beginning::default() };
    let settings = Settings { tolerance: 1e-11, ..Settings::default() };
    let until_s = 4e-3;
    // A swing through a junction, both contacts rolling.
    let torque = |t: f64| -15.0 - 12.0 * (600.0 * t).sin();
    let torques = |from_s: f64, dt_s: f64| {
        [Torque { start_nm: torque(from_s), end_nm: torque(from_s + dt_s) }, Torque::constant(15.0)]
    };
    for held in [[true, false], [false, true], [true, true]] {
        let mut errors = Vec::new();
        for steps in [100, 200, 400] {
            let dt_s = until_s / f64::from(steps);
            let mut free = Element::new(&clutch, &beginning, &settings).unwrap();
            let mut moved = free.clone();
            let (mut worst, mut places) = (0.0_f64, Vec::new());
            for i in 0..steps {
                let given = torques(f64::from(i) * dt_s, dt_s);
                free.advance(dt_s, given).unwrap();
                let speed = |race: usize| free.motion().flanges[race].speed_rad_s;
                let port = |race: usize| match held[race] {
                    true => Port::Speed(speed(race)),
                    false => Port::Torque(given[race]),
                };
                let run = moved.advance(dt_s, [port(0), port(1)]).unwrap();
                assert_eq!(run.stop, Stop::Finished);
                let (a, b) = (free.motion(), moved.motion());
                places.push(moved.memory().mode().place);
                for race in [0, 1] {
                    // The flange's torque less what its race's own inertia takes: at the end of a step the acceleration is that
                    // of the whole step, half a step late.
                    let inertia = [clutch.races.inner_inertia_kg_m2, clutch.races.outer_inertia_kg_m2][race];
                    let carried = |f: &Flange| f.torque_nm - inertia * f.acceleration_rad_s2;
                    worst = worst.max((carried(&a.flanges[race]) - carried(&b.flanges[race])).abs());
                    assert!((a.flanges[race].speed_rad_s - b.flanges[race].speed_rad_s).abs() < 1e-2);
                }
            }
            assert!(places.contains(&Place::Arc(0)) && places.contains(&Place::Arc(1)), "{places:?}");
            errors.push(worst);
        }
        println!("{held:?}: {errors:?} Nm");
        assert!(errors[2] < 2e-3 && errors[0] / errors[2] > 9.0, "{held:?} {errors:?}");
    }
}

/// Given accelerations first: the torques that they take, given back in straight pieces, make the same motion again.
#[test]
fn the_torques_that_given_speeds_take_make_them() {
    let clutch = design("huang2017-multi-arc").clutch;
    let beginning = Beginning { torque_nm: 5.0, ..Beginning::default() };
    let settings = Settings { tolerance: 1e-11, ..Settings::default() };
    // The inner race is turned back against an outer one that a constant torque holds.
    let mut off = Vec::new();
    for steps in [500, 1000] {
        let mut moved = Element::new(&clutch, &beginning, &settings).unwrap();
        let mut free = moved.clone();
        moved.advance(1e-12, [Port::Acceleration(-40.0), Port::Torque(Torque::constant(5.0))]).unwrap();
        let mut before = flange_nm(&moved, 0);
        let mut worst = 0.0_f64;
        for _ in 0..steps {
            let dt_s = 5e-3 / f64::from(steps);
            moved.advance(dt_s, [Port::Acceleration(-40.0), Port::Torque(Torque::constant(5.0))]).unwrap();
            let now = flange_nm(&moved, 0);
            free.advance(dt_s, [Torque { start_nm: before, end_nm: now }, Torque::constant(5.0)]).unwrap();
            before = now;
            let (a, b) = (free.motion().flanges, moved.motion().flanges);
            worst = worst.max((a[0].speed_rad_s - b[0].speed_rad_s).abs());
        }
        let race = moved.motion().flanges[0];
        assert!(
            (race.speed_rad_s + 40.0 * 5e-3).abs() < 1e-10
                && (race.angle_rad + moved_windup(&beginning, &clutch) + 20.0 * 2.5e-5).abs() < 1e-9
        );
        off.push(worst);
    }
    println!("{off:?} rad/s of 0.2");
    assert!(off[1] < 1e-7 && off[0] / off[1] > 3.0, "{off:?}");
}

/// Windup of the balance at the start, rad.
fn moved_windup(beginning: &Beginning, clutch: &Clutch) -> f64 {
    let element = Element::new(clutch, beginning, &Settings::default()).unwrap();
    let [inner, outer] = element.motion().flanges;
    outer.angle_rad - inner.angle_rad
}

/// A race that is moved evenly is one of a very large inertia: slip, touch and grip come out alike.
#[test]
fn a_race_moved_evenly_is_one_of_a_large_inertia() {
    let clutch = design("huang2017-multi-arc").clutch;
    let mut heavy = clutch.clone();
    heavy.races.inner_inertia_kg_m2 = 1e5;
    let beginning = Beginning { speed_rad_s: 50.0, overrun_rad_s: 2.0, ..Beginning::default() };
    let settings = Settings { tolerance: 1e-10, ..Settings::default() };
    let mut moved = Element::new(&clutch, &beginning, &settings).unwrap();
    let mut large = Element::new(&heavy, &beginning, &settings).unwrap();
    let mut modes = Vec::new();
    for i in 0..60 {
        // The outer race is driven until it meets the inner one and carries, then let go.
        let outer = Torque::constant(if i < 45 { 20.0 } else { -30.0 });
        moved.advance(2e-4, [Port::Speed(52.0), Port::Torque(outer)]).unwrap();
        large.advance(2e-4, [Torque::constant(0.0), outer]).unwrap();
        let (a, b) = (moved.motion(), large.motion());
        for contact in [0, 1] {
            let most = 1e-3 + 2e-4 * b.contacts[contact].normal_n;
            let off = (a.contacts[contact].normal_n - b.contacts[contact].normal_n).abs();
            assert!(off < most, "{i}: {off} N of {}", b.contacts[contact].normal_n);
        }
        let off = (a.flanges[1].speed_rad_s - b.flanges[1].speed_rad_s).abs();
        assert!(off < 1e-4, "{i}: {off} rad/s");
        modes.push((moved.memory().mode().place, moved.memory().mode().inner));
    }
    modes.dedup();
    println!("{modes:?}");
    assert!(modes.len() >= 3);
}

/// Both races moved, one moved, through overrun, slip, grip and junctions: work of the flanges against what is in motion, stored
/// and lost.
#[test]
fn energy_of_moved_races_is_accounted_for() {
    let clutch = design("huang2017-multi-arc").clutch;
    let settings = Settings { energy: true, tolerance: 1e-10, ..Settings::default() };
    let at_speed = Beginning { speed_rad_s: 150.0, ..Beginning::default() };
    let overruns = Beginning { overrun_rad_s: 2.0, ..at_speed };
    let carries = Beginning { torque_nm: 15.0, ..at_speed };
    // The junction lies at 17.1 Nm.
    let cases = [
        (overruns, [-3.0, 2.0, -2.0, 4.0, 1.0], 1.0, Place::Open),
        (carries, [-3.0, 3.0, -3.0, 3.0, -3.0], 15.0, Place::Arc(1)),
    ];
    for (case, both) in [(0, false), (0, true), (1, false), (1, true)] {
        let (beginning, speeds, outer_nm, wanted) = cases[case];
        let mut element = Element::new(&clutch, &beginning, &settings).unwrap();
        let (mut residual, mut through, mut work) = (0.0, 0.0, 0.0_f64);
        let (mut places, mut most_nm) = (Vec::new(), 0.0_f64);
        for i in 0..200 {
            let inner = Port::Speed(150.0 + speeds[i / 40]);
            let outer = match both {
                true => Port::Speed(150.0 - 0.1 * speeds[i / 40]),
                false => Port::Torque(Torque::constant(outer_nm)),
            };
            let run = element.advance(1e-4, [inner, outer]).unwrap();
            assert_eq!(run.stop, Stop::Finished, "{i}");
            let balance = run.energy.unwrap();
            residual += balance.residual_j();
            through += balance.through_j;
            work += balance.torque_inner_j.abs();
            places.push(element.memory().mode().place);
            most_nm = most_nm.max(flange_nm(&element, 0).abs());
        }
        places.dedup();
        println!(
            "{case} {both}: residual {residual:e} J of {through} J, work {work} J, most {most_nm} Nm, {places:?}"
        );
        assert!(residual.abs() < 1e-9 * through && work > 1e-2 && most_nm > 3.0);
        assert!(
            places.contains(&Place::Arc(0)) && places.contains(&wanted) && places.len() > 3,
            "{places:?}"
        );
    }
}

/// Saved and restored between moved steps, and refused where it makes no sense.
#[test]
fn a_moved_race_is_saved_and_malformed_speeds_are_refused() {
    let clutch = design("huang2017-multi-arc").clutch;
    let mut one =
        Element::new(&clutch, &Beginning { torque_nm: 5.0, ..Beginning::default() }, &Settings::default())
            .unwrap();
    assert!(!serde_json::to_string(&one.save()).unwrap().contains("held"));
    let ports = [Port::Speed(-0.05), Port::Torque(Torque::constant(5.0))];
    one.advance(1e-3, ports).unwrap();
    let text = serde_json::to_string(&one.save()).unwrap();
    let mut other = Element::new(&clutch, &Beginning::default(), &Settings::default()).unwrap();
    other.restore(&serde_json::from_str::<Saved>(&text).unwrap()).unwrap();
    assert_eq!(one.motion(), other.motion());
    one.advance(1e-3, ports).unwrap();
    other.advance(1e-3, ports).unwrap();
    assert_eq!(one.save(), other.save());
    for port in [Port::Speed(f64::NAN), Port::Speed(1e7), Port::Acceleration(f64::INFINITY)] {
        let why = one.advance(1e-3, [port, Port::Torque(Torque::constant(0.0))]).unwrap_err();
        assert!(why.what.contains("inner flange"), "{why}");
    }
    assert!(
        one.advance(1e-14, [Port::Speed(10.0), Port::Speed(0.0)]).unwrap_err().what.contains("acceleration")
    );
    assert_eq!(one.save(), other.save());
}
