//! `identify`: planted answers found again, blind directions named, nonsense refused.

use std::fmt::Write;

use sprag_design::design::Design;
use sprag_design::file::with_values;
use sprag_design::identify::{FitSettings, Identified, NoFit, Tied, Unknown, Use, identify, observations};
use sprag_design::margin::{load_state, nominal_capacity};
use sprag_design::{Follow, WedgeCurve};

const MULTI: &str = include_str!("../../designs/huang2017-multi-arc.toml");
const TORQUES: [f64; 14] =
    [5.0, 10.0, 15.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 90.0, 100.0, 105.0, 110.0];

fn design(values: &[(&str, f64)]) -> Design {
    Design::parse(&with_values(MULTI, values).unwrap(), "multi.toml").unwrap()
}

/// Windups of the clutch with the values planted, each off by `noise` (relative) of a fixed normal sample.
fn bench(planted: &[(&str, f64)], noise: f64) -> String {
    // Standard normal deviates: Abramowitz & Stegun style sample, mean -0.03, variance 1.05.
    const SAMPLE: [f64; 14] = [
        0.464, 0.137, 2.455, -0.323, -0.068, 0.296, -0.288, 1.298, 0.241, -0.957, 0.525, -1.865, -0.354,
        -0.634,
    ];
    let clutch = design(planted).clutch;
    let curve = WedgeCurve::build(&clutch, &clutch.profile().unwrap(), 0.0).unwrap();
    let mut csv = "torque_nm,windup_deg\n".to_owned();
    for (torque, z) in TORQUES.iter().zip(SAMPLE) {
        let windup = curve.at_torque(*torque).unwrap().windup_rad.to_degrees();
        writeln!(csv, "{torque},{}", windup * (1.0 + noise * z)).unwrap();
    }
    csv
}

fn unknown(name: &str, min: f64, max: f64) -> Unknown {
    Unknown { name: name.to_owned(), min, max }
}

fn found(csv: &str, unknowns: &[Unknown], starts: usize) -> Result<Identified, NoFit> {
    let settings = FitSettings { starts, seed: 7, evaluations: 120 };
    identify(&design(&[]), &observations(csv).unwrap(), unknowns, &settings, &Follow::nobody())
}

fn radii() -> [Unknown; 2] {
    [unknown("r_i2_mm", 3.7, 4.4), unknown("r_i3_mm", 3.7, 4.6)]
}

const PLANTED: [(&str, f64); 2] = [("r_i2_mm", 3.95), ("r_i3_mm", 4.31)];

#[test]
fn a_planted_answer_is_found_to_the_last_digits_without_noise() {
    let found = found(&bench(&PLANTED, 0.0), &radii(), 2).unwrap();
    for (e, (name, want)) in found.knowledge.estimates.iter().zip(PLANTED) {
        assert!((e.value - want).abs() < 1e-6, "{name}: {e:?}");
    }
    assert!(found.converged && found.knowledge.tied.is_empty(), "{:?}", found.knowledge);
}

#[test]
fn bounds_of_the_optimiser_bind_the_optimiser_alone() {
    // The design's own 4.08 and the planted 3.95 lie on either side of these bounds.
    let text = MULTI.replacen("min = 3.6, max = 4.8", "min = 4.0, max = 4.05", 1);
    assert_ne!(text, MULTI);
    let design = Design::parse(&text, "x.toml").unwrap();
    let csv = bench(&PLANTED[..1], 0.0);
    let settings = FitSettings { starts: 1, seed: 7, evaluations: 120 };
    let unknowns = [unknown("r_i2_mm", 3.7, 4.4)];
    let found =
        identify(&design, &observations(&csv).unwrap(), &unknowns, &settings, &Follow::nobody()).unwrap();
    assert!((found.knowledge.estimates[0].value - 3.95).abs() < 1e-6, "{:?}", found.knowledge);
}

/// Capacities feel friction only by whether the clutch grips on the way: of all that serve, the value nearest to the file's is told, the
/// largest friction that it needs. Where the file's own serves, it stays.
#[test]
fn what_is_not_felt_stays_as_near_to_the_file_as_the_data_are_met() {
    let (drawn, state) = (design(&[]), load_state(&design(&[])).unwrap());
    let capacity = nominal_capacity(&drawn, &drawn.limits, &state).unwrap().0;
    let on_the_way = (1..=20_000).map(|k| state.curve.at_torque(capacity * f64::from(k) / 2e4).unwrap());
    let needed = on_the_way.map(|p| p.tan_omega.max(p.tan_nu)).fold(state.first_tan_omega, f64::max);
    let csv = format!("nominal_torque_nm\n{capacity}\n");
    let settings = FitSettings { starts: 2, seed: 7, evaluations: 40 };
    for (file, expected) in [(0.7 * needed, needed), (1.5 * needed, 1.5 * needed)] {
        let design = design(&[("friction.static", file), ("friction.kinetic", 0.4 * needed)]);
        let unknowns = [unknown("friction.static", 0.6 * needed, 3.0 * needed)];
        let found =
            identify(&design, &observations(&csv).unwrap(), &unknowns, &settings, &Follow::nobody()).unwrap();
        let e = &found.knowledge.estimates[0];
        assert!((e.value / expected - 1.0).abs() < 1e-5, "{file}: {e:?}, not {expected}");
        assert!(found.points[0].relative().unwrap().abs() < 1e-9, "{:?}", found.points);
        assert!(Design::parse(&found.source, "x.toml").unwrap().clutch.friction.static_ == e.value);
    }
}

#[test]
fn with_noise_the_planted_answer_lies_in_the_interval_which_is_as_wide_as_the_noise_makes_it() {
    let noisy = |noise| found(&bench(&PLANTED, noise), &radii(), 1).unwrap().knowledge;
    let (small, large) = (noisy(1e-4), noisy(1e-3));
    for (i, (name, want)) in PLANTED.iter().enumerate() {
        for k in [&small, &large] {
            let e = &k.estimates[i];
            assert!((e.value - want).abs() < e.half_width.unwrap(), "{name}: {e:?}");
        }
        let ratio = large.estimates[i].half_width.unwrap() / small.estimates[i].half_width.unwrap();
        assert!((ratio / 10.0 - 1.0).abs() < 0.1, "{name}: {ratio}");
    }
    // The sample's own scatter comes back as that of the residuals.
    assert!((large.residual_sigma.unwrap() / 1e-3 - 1.0).abs() < 0.25, "{large:?}");
    assert_eq!(large.freedom, TORQUES.len() - 2);
}

#[test]
fn what_a_windup_cannot_know_is_said_to_be_unknown() {
    // The centroid drops out of all statics.
    let unknowns = [unknown("r_i3_mm", 3.7, 4.6), unknown("centroid_y_mm", 0.3, 0.8)];
    let k = found(&bench(&PLANTED[1..], 1e-4), &unknowns, 1).unwrap().knowledge;
    assert!(k.estimates[1].sigma.is_none(), "{k:?}");
    let Some(Tied::Blind { direction }) = k.tied.first() else { panic!("{k:?}") };
    assert!(direction[1].abs() == 1.0 && direction[0].abs() < 1e-3, "{direction:?}");
    // It stays as the file has it.
    assert_eq!(k.estimates[1].value, 0.5288);
    // The other is judged as it is alone.
    let alone = found(&bench(&PLANTED[1..], 1e-4), &unknowns[..1], 1).unwrap().knowledge;
    let [e, lone] = [&k.estimates[0], &alone.estimates[0]];
    assert!(
        e.doubt.is_none() && (e.value - lone.value).abs() < 0.1 * lone.half_width.unwrap(),
        "{e:?} {lone:?}"
    );
    assert!((e.half_width.unwrap() / lone.half_width.unwrap() - 1.0).abs() < 0.01, "{e:?} {lone:?}");
}

#[test]
fn width_and_modulus_are_one_number_to_a_windup() {
    // Every compliance of the roller law but (6) and (5) is fixed: (5) knows the races' width and the modulus as their
    // product, so the two cannot be told apart once (6) is left out and the roller law does not know the modulus.
    let text = MULTI.replacen("width_mm = 5.05 ", "width_mm = 0.0 ", 1).replacen(
        "width_mm = 6.0 ",
        "width_mm = 7.0 ",
        1,
    );
    let design = Design::parse(&text, "x.toml").unwrap();
    let curve = WedgeCurve::build(&design.clutch, &design.clutch.profile().unwrap(), 0.0).unwrap();
    let mut csv = "torque_nm,windup_deg\n".to_owned();
    for torque in TORQUES {
        writeln!(csv, "{torque},{}", curve.at_torque(torque).unwrap().windup_rad.to_degrees()).unwrap();
    }
    let unknowns =
        [unknown("races.width_mm", 6.0, 9.0), unknown("material.youngs_modulus_gpa", 150.0, 250.0)];
    let settings = FitSettings { starts: 1, seed: 1, evaluations: 60 };
    let k = identify(&design, &observations(&csv).unwrap(), &unknowns, &settings, &Follow::nobody())
        .unwrap()
        .knowledge;
    let Some(Tied::Blind { direction }) = k.tied.first() else { panic!("{k:?}") };
    // d ln width = -d ln modulus.
    let by_log = direction[0] * 3.0 / k.estimates[0].value + direction[1] * 100.0 / k.estimates[1].value;
    assert!(by_log.abs() < 1e-3 * direction[0].abs(), "{direction:?}");
}

#[test]
fn rows_may_change_the_clutch_and_rows_held_back_take_no_part() {
    let mut csv = "label,use,sprags.count,torque_nm,normal_inner_n\n".to_owned();
    for (count, purpose, planted) in [(10, "fit", 0.6), (12, "fit", 0.6), (9, "check", 0.5)] {
        let text = with_values(MULTI, &[("centre_distance_mm", planted)]).unwrap();
        let text = text.replacen("count = 12 ", &format!("count = {count} "), 1);
        let clutch = Design::parse(&text, "x.toml").unwrap().clutch;
        let curve = WedgeCurve::build(&clutch, &clutch.profile().unwrap(), 0.0).unwrap();
        writeln!(
            csv,
            "{count} sprags,{purpose},{count},20,{}",
            curve.at_torque(20.0).unwrap().normal_inner_n
        )
        .unwrap();
    }
    let found = found(&csv, &[unknown("centre_distance_mm", 0.5, 0.75)], 2).unwrap();
    assert!((found.knowledge.estimates[0].value - 0.6).abs() < 1e-6, "{:?}", found.knowledge);
    let off: Vec<f64> = found.points.iter().map(|p| p.relative().unwrap()).collect();
    assert!(off[0].abs() < 1e-6 && off[1].abs() < 1e-6 && off[2].abs() > 0.05, "{off:?}");
    assert_eq!(found.points[2].observation.purpose, Use::Check);
    let new = Design::parse(&found.source, "new.toml").unwrap();
    assert!((new.clutch.sprags.centre_distance_m - 0.6e-3).abs() < 1e-9);
    assert_eq!(new.clutch.sprags.count, 12, "rows do not change the design that is written");
}

#[test]
fn the_same_on_one_thread_as_on_two() {
    let csv = bench(&PLANTED, 1e-3);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| found(&csv, &radii(), 1)).unwrap()
    };
    assert_eq!(with(1), with(2));
}

/// A table by 1e30 beside the model has no least squares in numbers that a computer has.
#[test]
fn numbers_that_no_model_comes_near_are_refused_with_their_line() {
    for odd in ["3.34,1e-200,", "3.34,,5e-324"] {
        let csv = format!("torque_nm,normal_inner_n,k_secant_nm_per_rad\n10,940,466\n20,1800,500\n{odd}\n");
        let why = found(&csv, &radii(), 1).unwrap_err().to_string();
        assert!(why.contains("line 4"), "{odd}: {why}");
    }
}

#[test]
fn questions_that_make_no_sense_are_refused() {
    let csv = "torque_nm,windup_deg\n10,1.2\n";
    let with = |u: &[Unknown]| found(csv, u, 1).unwrap_err().to_string();
    assert!(with(&[]).contains("at least one unknown"));
    assert!(
        with(&[unknown("r_i9_mm", 1.0, 2.0)]).contains("there are r_i1_mm"),
        "{}",
        with(&[unknown("r_i9_mm", 1.0, 2.0)])
    );
    let whole = with(&[unknown("sprags.count", 8.0, 20.0)]);
    assert!(
        whole.contains("unknown \"sprags.count\": a whole number") && whole.contains("each value by itself"),
        "{whole}"
    );
    assert_eq!(with(&[unknown("count", 8.0, 20.0)]).replace("\"count\"", "\"sprags.count\""), whole);
    assert!(with(&[unknown("races.colour", 1.0, 2.0)]).contains("holds no number races.colour"));
    assert!(with(&[unknown("r_i1_mm", 2.0, 1.0)]).contains("the smaller first"));
    assert!(with(&[unknown("r_i1_mm", 3.0, 5.0), unknown("r_i1_mm", 3.0, 5.0)]).contains("twice"));
    // Arcs that never span the gap.
    let none = with(&[unknown("r_i1_mm", 0.1, 0.2)]);
    assert!(none.starts_with("none of") && none.contains("race gap"), "{none}");
    let skipped = "use,torque_nm,windup_deg\ncheck,10,1.2\n";
    assert!(matches!(found(skipped, &radii(), 1), Err(NoFit::NothingToFit)));
}

/// A soft shaft's modulus (110 GPa) beside the centre distance from windups by finite elements: the law's error of half a per
/// cent moves the pair along a valley, and forces tell the two apart as well as the proposal says.
#[test]
fn the_laws_own_error_is_in_the_interval_and_the_proposed_measurement_tells_the_two_apart() {
    let text = include_str!("../reference/soft_shaft.toml");
    let windups = include_str!("../reference/soft_shaft_windup.csv");
    let design = Design::parse(text, "soft_shaft.toml").unwrap();
    let unknowns = [
        unknown("material.inner_race.youngs_modulus_gpa", 50.0, 220.0),
        unknown("sprags.centre_distance_mm", 0.6, 0.8),
    ];
    let settings = FitSettings { starts: 1, seed: 1, evaluations: 200 };
    let fitted = |csv: &str| {
        identify(&design, &observations(csv).unwrap(), &unknowns, &settings, &Follow::nobody()).unwrap()
    };
    let off = |found: &Identified| found.knowledge.estimates[0].value - 110.0;
    let alone = fitted(windups);
    let modulus = &alone.knowledge.estimates[0];
    assert!(off(&alone).abs() > modulus.half_width.unwrap(), "scatter alone misses it: {modulus:?}");
    assert!(off(&alone).abs() < modulus.by_law.unwrap() && modulus.doubt.is_some(), "{modulus:?}");
    let apart = alone.apart.unwrap();
    assert!(matches!(apart.quantity.name(), "normal_inner_n" | "normal_outer_n"), "{apart:?}");

    let curve = WedgeCurve::build(&design.clutch, &design.clutch.profile().unwrap(), 0.0).unwrap();
    let mut csv = windups.replacen("windup_deg", &format!("windup_deg,{}", apart.quantity.name()), 1);
    for line in windups.lines().skip(1) {
        let torque: f64 = line.split(',').next().unwrap().parse().unwrap();
        let point = curve.at_torque(torque).unwrap();
        let inner = apart.quantity.name() == "normal_inner_n";
        let normal = if inner { point.normal_inner_n } else { point.normal_outer_n };
        csv = csv.replacen(line, &format!("{line},{normal}"), 1);
    }
    let both = fitted(&csv);
    let correlation = both.knowledge.correlation.as_ref().unwrap()[0][1];
    assert!((correlation - apart.correlation).abs() < 0.1, "{correlation} {apart:?}");
    assert!(both.apart.is_none() && off(&both).abs() < 0.25 * off(&alone).abs(), "{:?}", both.knowledge);
}

/// Standard errors that come with the data bound what is known, however well a line happens to run through them; a value at a
/// bound is not determined.
#[test]
fn given_errors_and_bounds_count() {
    let exact = bench(&PLANTED, 0.0);
    let with_sigma = |relative: f64| {
        let mut lines = exact.lines();
        let mut csv = format!("{},windup_deg_sigma\n", lines.next().unwrap());
        for line in lines {
            let windup: f64 = line.split(',').nth(1).unwrap().parse().unwrap();
            writeln!(csv, "{line},{}", relative * windup).unwrap();
        }
        found(&csv, &radii(), 1).unwrap().knowledge.estimates[0].half_width.unwrap()
    };
    let (one, five) = (with_sigma(0.001), with_sigma(0.005));
    assert!(one > 1e-4 && (five / one - 5.0).abs() < 0.05, "{one} {five}");
    let low = [unknown("r_i2_mm", 3.7, 3.9), unknown("r_i3_mm", 3.7, 4.6)];
    let beyond = found(&exact, &low, 2).unwrap().knowledge;
    assert!(beyond.estimates[0].doubt.is_some(), "{:?}", beyond.estimates[0]);
}
