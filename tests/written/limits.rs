//! Every limit, by its row: accepted from a file, merged from [optimize] limits, demanded, written back, worded. What a new
//! row forgets fails here.

use sprag_design::design::{LIMIT_KEYS, LimitKey};
use sprag_design::file::with_limits;
use sprag_design::margin::{
    Capacities, LIMITS, Margin, RunOut, When, limit_of, load_state, margins, run_out_margins, unlike_margins,
};
use sprag_design::optimise::{ClutchProblem, Fidelity};
use sprag_design::{Design, Settings};
use toml::{Table, Value};

/// A design with everything that limits speak of: flanks, an end profile, an eccentricity, oil, sprags that differ, a scene; without limits.
fn bare() -> Table {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/designs/huang2017-multi-arc.toml");
    let mut file: Table = std::fs::read_to_string(path).unwrap().parse().unwrap();
    let table = |file: &mut Table, name: &str| file.get_mut(name).unwrap().as_table_mut().unwrap().clone();
    file.insert("limits".into(), Table::new().into());
    file.insert("check".into(), toml::toml! { scenarios = ["low-6"] }.into());
    let mut scene = table(&mut file, "optimize");
    scene.insert("scenarios".into(), Value::Array(vec!["low-6".into()]));
    scene.remove("limits");
    file.insert("optimize".into(), scene.into());
    let scenes = file.get_mut("scenarios").unwrap().as_array_mut().unwrap();
    scenes.retain(|s| s["name"].as_str() == Some("low-6"));
    scenes[0].as_table_mut().unwrap().insert("duration_s".into(), 0.02.into());
    let mut races = table(&mut file, "races");
    races.insert("eccentricity".into(), toml::toml! { offset_mm = 0.005 }.into());
    file.insert("races".into(), races.into());
    let mut contact = table(&mut file, "contact");
    contact.insert("end_profile".into(), toml::toml! { kind = "crown" radius_mm = 300.0 }.into());
    file.insert("contact".into(), contact.into());
    let oil = toml::toml! { oil = "ISO VG 32" temperature_c = 60.0 race_roughness_um = 0.2 sprag_roughness_um = 0.2 };
    file.insert("lubrication".into(), oil.into());
    file.insert("sharing".into(), toml::toml! { seed = 1 size_within_um = 1.0 }.into());
    file
}

/// A value that the design can be asked for, in the unit of the key.
fn value(key: &LimitKey) -> f64 {
    match (key.name, key.unit) {
        ("nominal_torque_nm", _) => 80.0,
        ("peak_torque_nm", _) => 100.0,
        ("case_depth_mm", _) => 0.4,
        ("lift_off_by_rpm", _) => 9000.0,
        (_, "MPa") => 3000.0,
        (_, "mm") => 8.5,
        (_, "deg") => 5.0,
        (_, "N") => 300.0,
        (_, "rpm") => 4500.0,
        (_, "") => 0.1,
        (name, unit) => panic!("{name}: no value in {unit} yet"),
    }
}

fn all() -> Table {
    LIMIT_KEYS.iter().map(|key| (key.name.to_owned(), value(key).into())).collect()
}

/// The design with these limits, and with those of the optimiser's task.
fn with(limits: Table, sharper: Table) -> Design {
    let mut file = bare();
    file.insert("limits".into(), limits.into());
    file.get_mut("optimize").unwrap().as_table_mut().unwrap().insert("limits".into(), sharper.into());
    Design::parse(&toml::to_string(&file).unwrap(), "limits.toml").unwrap_or_else(|e| panic!("{e:?}"))
}

/// All rows, those off centre and those of the worst sprag included.
fn rows(design: &Design) -> Vec<Margin> {
    let scenes = &design.check_scenarios;
    let mut rows = margins(design, scenes, &Settings::default()).unwrap();
    let state = load_state(design).unwrap();
    let ring = RunOut::new(design, &state).unwrap();
    rows.extend(run_out_margins(design, &design.limits, &ring, Capacities::LeftOut));
    rows.extend(unlike_margins(design, &design.limits, &state, Capacities::LeftOut));
    rows
}

#[test]
fn each_key_is_accepted_merged_and_written_back() {
    let whole = with(all(), Table::new());
    for key in LIMIT_KEYS {
        assert_eq!(key.value(&whole.limits), Some(value(key)), "{}", key.name);
        // Torques, the depth of the case and both speeds bound one another: to 1 % more there is room.
        let sharper = 1.01 * value(key);
        let merged = with(all(), [(key.name.to_owned(), sharper.into())].into_iter().collect());
        let task = merged.optimize.as_ref().unwrap();
        for other in LIMIT_KEYS {
            let wanted = if other.name == key.name { sharper } else { value(other) };
            assert_eq!(other.value(&task.limits), Some(wanted), "{} under {}", other.name, key.name);
        }
        assert_eq!(key.value(&merged.limits), Some(value(key)), "{}: [limits] itself stays", key.name);
        let problem = ClutchProblem::new(&merged, task, Vec::new(), Fidelity::default());
        let written = Design::parse(&problem.finished_file(&[]).unwrap(), "written.toml").unwrap();
        assert_eq!(written.limits, task.limits, "{}", key.name);
        let by_name = with_limits(&whole.source, &[(key.name, sharper)]).unwrap();
        let by_name = Design::parse(&by_name, "by-name.toml").unwrap();
        assert_eq!(key.value(&by_name.limits), Some(sharper), "{}", key.name);
    }
}

/// What is held at a torque needs that torque in the file.
#[test]
fn the_file_and_the_margins_agree_at_which_torque_a_limit_is_held() {
    let mut seen = 0;
    for limit in LIMITS {
        let key = LIMIT_KEYS.iter().find(|key| Some(key.name) == limit.key);
        if let (Some(key), Some(torque)) = (key, limit.when.key()) {
            assert!(key.needs().any(|needed| needed == torque), "{} needs {torque}", key.name);
            seen += 1;
        }
    }
    assert!(seen >= 12, "{seen}");
}

#[test]
fn a_value_out_of_range_and_a_slip_of_the_pen_are_refused_at_the_key() {
    for key in LIMIT_KEYS {
        let refused = |name: &str, value: f64| {
            let mut file = bare();
            let mut limits = all();
            limits.insert(name.to_owned(), value.into());
            file.insert("limits".into(), limits.into());
            let error = Design::parse(&toml::to_string(&file).unwrap(), "x.toml").unwrap_err();
            error.problems().iter().map(|p| format!("{} {} {}", p.key, p.allowed, p.help)).collect::<Vec<_>>()
        };
        let below = refused(key.name, -1.0);
        assert!(below.iter().any(|p| p.contains(&format!("limits.{}", key.name))), "{below:?}");
        assert!(below.iter().any(|p| p.contains(key.words.trim_end_matches('.'))), "{below:?}");
        let odd = refused(&format!("{}x", key.name), 1.0);
        assert!(odd.iter().any(|p| p.contains(&format!("did you mean {}", key.name))), "{odd:?}");
    }
}

#[test]
fn each_limit_is_demanded_and_worded() {
    let rows = rows(&with(all(), Table::new()));
    for limit in LIMITS {
        assert!(limit.name().len() > 5 && limit.explanation.len() > 60, "{}", limit.code);
        assert!(limit.formula.len() > 15 && limit.source.len() > 15, "{}", limit.code);
        // What is explained in other words is computed in another way.
        for other in LIMITS.iter().filter(|other| other.formula == limit.formula) {
            assert_eq!(other.explanation, limit.explanation, "{} and {}", limit.code, other.code);
        }
        assert_eq!(limit_of(limit.code), Some(*limit), "{} stands twice", limit.code);
        let demanded = rows.iter().any(|row| row.limit == *limit && row.code().starts_with(limit.code));
        // Flanks are asked of the optimiser alone.
        assert_eq!(demanded, limit.when != When::Outline, "{}", limit.code);
        let Some(name) = limit.key else { continue };
        let key = LIMIT_KEYS.iter().find(|key| key.name == name);
        assert!(key.is_some(), "{}: no key {name}", limit.code);
    }
    for row in &rows {
        assert_eq!(limit_of(&row.code()), Some(row.limit), "{}", row.code());
        assert!(!row.name.contains('{'), "{}", row.name);
    }
}

/// Each key changes a row that it is said to change, or else is one that several rows are read at.
#[test]
fn each_key_is_felt() {
    let said = |design: &Design| -> Vec<_> {
        rows(design).into_iter().map(|r| (r.limit, r.demand, r.allowable, r.reference)).collect()
    };
    let whole = said(&with(all(), Table::new()));
    for key in LIMIT_KEYS {
        let mut limits = all();
        limits.insert(key.name.to_owned(), (1.01 * value(key)).into());
        let moved = said(&with(limits, Table::new()));
        assert_eq!(whole.len(), moved.len(), "{}", key.name);
        let changed = whole.iter().zip(&moved).filter(|(a, b)| a != b);
        let changed: Vec<&str> = changed.map(|(a, _)| a.0.code).collect();
        for limit in LIMITS.iter().filter(|limit| limit.key == Some(key.name)) {
            assert!(changed.contains(&limit.code), "{}: {} stays; {changed:?}", key.name, limit.code);
        }
        assert!(!changed.is_empty(), "{} changes no row", key.name);
    }
}
