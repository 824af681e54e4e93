//! Scenarios with histories from CSV files: how they are read, named in the hash, refused.

use std::path::Path;

use sprag_design::answer::simulation::SimulationSettings;
use sprag_design::clutch::{Scenario, ScenarioKind};
use sprag_design::design::Design;
use sprag_design::file::DesignError;
use sprag_design::optimise::{ClutchProblem, Fidelity};
use sprag_design::{Follow, Settings, WedgeCurve};

const DESIGN: &str = include_str!("../../designs/huang2017-multi-arc.toml");

fn parse(text: &str) -> Design {
    Design::parse(text, "x.toml").unwrap_or_else(|error| panic!("{error}"))
}

fn refusal(text: &str) -> DesignError {
    match Design::parse(text, "x.toml") {
        Ok(_) => panic!("accepted"),
        Err(error) => error,
    }
}

#[test]
fn the_bench_is_the_same_clutch_with_its_histories() {
    let bench = Design::read(Path::new("designs/huang2017-bench.toml")).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(bench.clutch, parse(DESIGN).clutch);
    let find = |name: &str| -> &Scenario { bench.scenario(name).unwrap_or_else(|| panic!("{name}")) };
    let rows = find("in-and-out").torque_history.as_ref().expect("history");
    assert_eq!((rows[1], rows.len()), ([0.02, 16.8], 5));
    let ramp = find("speed-ramp");
    let first = ramp.speed_history.as_ref().expect("history")[0][1];
    assert!((first / (100.0 * std::f64::consts::PI) - 1.0).abs() < 1e-15);
    assert!(matches!(ramp.kind, ScenarioKind::Transient { overrun_rad_s, .. } if overrun_rad_s > 10.0));
    assert!(find("engagement-vernay").clutch.friction.outer_holds);
    assert_eq!(find("high-10-damped").clutch.hunt_crossley_s_per_m, 0.2);
    assert_eq!(find("high-10-damped").clutch.contact, bench.clutch.contact);
    // The hash names what is computed: a history belongs to it.
    let folder = std::env::temp_dir().join(format!("sprag-histories-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("folder");
    for file in ["engaging-in-and-out.csv", "speed-ramp.csv", "overrunning-torque.csv"] {
        std::fs::copy(Path::new("designs").join(file), folder.join(file)).expect("copy");
    }
    let again = || Design::parse_in(&folder, &bench.source, "x.toml").unwrap_or_else(|e| panic!("{e}"));
    let read = || again().hash;
    assert_eq!(read(), bench.hash);
    std::fs::write(folder.join("speed-ramp.csv"), "time_s,speed_rpm\n0,3000\n1,3001\n").expect("write");
    assert_ne!(read(), bench.hash);
    // What is said: a history's values belong to it, comments and layout do not; so do the entries of a search's journal.
    let remarked = bench.source.replace("\n[races]\n", "\n[races]   # a remark\n\n");
    let remarked = Design::parse(&remarked, "designs/x.toml").unwrap_or_else(|e| panic!("{e}"));
    assert!(remarked.hash != bench.hash && remarked.content_hash() == bench.content_hash());
    assert_ne!(again().content_hash(), bench.content_hash());
    let problem = |design: &Design| {
        let task = parse(DESIGN).optimize.expect("task");
        let free = vec!["r_i2_mm".to_owned()];
        ClutchProblem::new(design, &task, free, Fidelity::default()).identity()
    };
    // Who follows a search or can stop it is no part of what its entries belong to.
    let followed = |follow: Follow| {
        let settings = Settings { follow, ..Settings::default() };
        let task = parse(DESIGN).optimize.expect("task");
        ClutchProblem::new(&bench, &task, vec!["r_i2_mm".to_owned()], Fidelity { settings, reduced: true })
            .identity()
    };
    assert_eq!(followed(Follow::new()), problem(&bench));
    let as_ever = "tolerance: 1e-6, longest_step_s: None, samples: 0, most_events: None, most_steps: None, energy: false, \
                   interrupt: None, history: History { window_s: None, marks: false }, clock: None }, reduced: true }";
    assert!(problem(&bench).ends_with(as_ever), "journals of earlier searches: {}", problem(&bench));
    assert_eq!(problem(&remarked), problem(&bench));
    assert_ne!(problem(&again()), problem(&bench));
    let moved = parse(&DESIGN.replace("duration_s = 0.3\n", "duration_s = 0.31\n"));
    assert_ne!(problem(&moved), problem(&parse(DESIGN)));
    std::fs::write(folder.join("speed-ramp.csv"), "time_s,speed_rpm\n0,3000\n1,fast\n").expect("write");
    let error = Design::parse_in(&folder, &bench.source, "x.toml").map(|_| ()).expect_err("accepted");
    let said = error.to_string();
    assert!(said.contains("speed-ramp.csv:3:3: speed_rpm: found text that is no number"), "{said}");
    std::fs::remove_dir_all(&folder).expect("remove");
}

/// A transient says what changes, and says it once; its files must be there.
#[test]
fn transients() {
    let of = |keys: &str| {
        let table = format!(
            "\n[[scenarios]]\nname = \"t\"\nkind = \"transient\"\nabutment_stiffness_nm_per_rad = 1e3\nduration_s = 0.1\n{keys}"
        );
        refusal(&[DESIGN, &table].concat()).to_string()
    };
    for (keys, words) in [
        ("preload_nm = 3\n", ["kind", "one of torque_step_nm, torque_history_csv"]),
        (
            "torque_history_csv = \"a.csv\"\npreload_nm = 3\n",
            ["preload_nm", "no preload_nm beside torque_history_csv"],
        ),
        (
            "speed_history_csv = \"a.csv\"\nspeed_rpm = 3\n",
            ["speed_rpm", "no speed_rpm beside speed_history_csv"],
        ),
        ("overrun_rpm = 5\nstep_time_s = 0.1\n", ["step_time_s", "only with torque_step_nm"]),
        ("torque_history_csv = \"not-there.csv\"\n", ["torque_history_csv", "not-there.csv: no such file"]),
        (
            "torque_random = { spectrum = [[5, 1], [9, 1]] }\ntorque_step_nm = 3\n",
            ["torque_step_nm", "no torque_step_nm beside torque_random"],
        ),
        (
            "torque_random = { spectrum = [[5, 1], [5, 1]] }\n",
            ["torque_random.spectrum", "frequencies ascending"],
        ),
        (
            "torque_random = { spectrum = [[5, 0], [9, 0]] }\n",
            ["torque_random.spectrum", "one density above 0"],
        ),
        (
            "torque_random = { spectrum = [[5, 1], [9e9, 1]] }\n",
            ["torque_random.spectrum", "at most 2500 periods"],
        ),
        ("torque_random = { seed = 3 }\n", ["torque_random", "spectrum"]),
        ("torque_step_nm = 1\nfrequency_hz = 3\n", ["frequency_hz", "for kind transient"]),
    ] {
        let said = of(keys);
        assert!(words.iter().all(|w| said.contains(w)), "{keys:?}: {said}");
    }
}

/// Far below resonance the clutch carries a random torque as the static curve does.
#[test]
fn a_slow_random_torque_winds_up_as_the_static_curve_does() {
    let scene = "\n[[scenarios]]\nname = \"rough\"\nkind = \"transient\"\npreload_nm = 16.8\nabutment_stiffness_nm_per_rad = 1e6\nduration_s = 2.0\n\
                 torque_random = { spectrum = [[1.0, 0.3], [8.0, 0.3]], seed = 5 }\n";
    let design = parse(&[DESIGN, scene].concat());
    let rows = design.scenario("rough").and_then(|s| s.torque_history.clone()).expect("rows");
    let mean = rows.iter().map(|row| row[1]).sum::<f64>() / rows.len() as f64;
    let variance = rows.iter().map(|row| (row[1] - mean).powi(2)).sum::<f64>() / rows.len() as f64;
    // 7 Hz at 0.3, in 2 s: 14 bins of the band are resolved.
    assert!((mean - 16.8).abs() < 1.0 && (0.5..2.0).contains(&(variance / 2.1)), "{mean} {variance}");
    let ask = SimulationSettings { rows: Some(400), ..SimulationSettings::default() };
    let answer = design.simulate("rough", &ask).unwrap_or_else(|e| panic!("{e}"));
    let curve =
        WedgeCurve::build(&design.clutch, &design.clutch.profile().expect("profile"), 0.0).expect("curve");
    let torque_at = |t: f64| {
        let k = rows.partition_point(|row| row[0] <= t).clamp(1, rows.len() - 1);
        let [a, b] = [rows[k - 1], rows[k]];
        a[1] + (b[1] - a[1]) * (t - a[0]) / (b[0] - a[0])
    };
    let history = answer.history();
    let [times, forces] =
        ["time_s", "normal_inner_n"].map(|name| history.numbers(name).expect("column").to_vec());
    let off = times.iter().zip(&forces).map(|(&t, n)| {
        let held = curve.at_torque(torque_at(t)).expect("carried");
        (n / held.normal_inner_n - 1.0).abs()
    });
    let worst = off.fold(0.0, f64::max);
    assert!(worst < 0.01, "{worst}");
}
