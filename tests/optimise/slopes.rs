//! Slopes that a problem gives itself, against differences of whole evaluations.

use sprag_design::optimise::*;
use sprag_design::scenario::Settings as RunSettings;

use super::clutch::{HUANG, PEER_B, PEER_C, PEER_D, changed, design, task};

/// Fourth-order differences of the outputs at `x` along variable `i` over `h`.
fn differences(problem: &ClutchProblem, x: &[f64], i: usize, h: f64) -> Vec<f64> {
    let at = |k: f64| {
        let mut x = x.to_vec();
        x[i] += k * h;
        let e = problem.evaluate(&x).expect("near a design");
        [e.objectives, e.limits, vec![e.tie_break]].concat()
    };
    let [b2, b1, f1, f2] = [-2.0, -1.0, 1.0, 2.0].map(at);
    (0..f1.len()).map(|k| (8.0 * (f1[k] - b1[k]) - (f2[k] - b2[k])) / (12.0 * h)).collect()
}

/// Steps of the differences, fractions of the range: the shorter one for rows whose peak gives way to another nearby, which is a
/// kink that the longer one straddles.
const STEPS: [f64; 2] = [2e-4, 1e-5];

/// Every slope of every row by every variable: within 1e-5 of it, or of 1 per range, which is what equilibria to 1e-12 leave over
/// a millionth of the range. Without one: the rows of scenes that unload the contact where some friction suffices, and of no others.
#[test]
fn slopes_are_those_of_whole_evaluations() {
    let elastic = ("law = \"roller\"", "law = \"elastic\"");
    let bare = ("roller_coefficient = 3.944e-5", "#");
    let larger = ("{ radius_mm = 4.02,", "{ radius_mm = 4.0304,");
    let designs = [
        ("Huang, roller", design(HUANG), None),
        ("Huang, elastic, high-6 pulls and no friction suffices", changed(HUANG, &[elastic, bare]), None),
        (
            "Huang, elastic, high-6 pulls and some does",
            changed(HUANG, &[elastic, bare, larger]),
            Some(":high-6"),
        ),
        ("flanks free", design(PEER_B), None),
        ("24 sprags, roller", design(PEER_C), None),
        ("24 sprags, elastic", changed(PEER_C, &[elastic, bare]), None),
        ("a step of torque, at speed", design(PEER_D), None),
    ];
    for (name, design, without) in designs {
        let task = task(&design);
        let names: Vec<String> = task.variables.iter().map(|v| v.name.clone()).collect();
        let settings = RunSettings { tolerance: 1e-9, ..RunSettings::default() };
        let fidelity = Fidelity { settings, ..Fidelity::default() };
        let problem = ClutchProblem::new(&design, task, names, fidelity).quickly();
        let range: Vec<f64> = task.variables.iter().map(|v| v.max - v.min).collect();
        let x: Vec<f64> = task.variables.iter().zip(&range).map(|(v, r)| v.start + 0.013 * r).collect();
        let moved =
            |i: usize| (0..x.len()).map(|k| x[k] + f64::from(u8::from(k == i)) * 1e-6 * range[k]).collect();
        let beside: Vec<Vec<f64>> = (0..x.len()).map(moved).collect();
        let changes = problem.changes(&x, &beside).expect("slopes");
        let names = problem.names(&problem.assess_at(&x).unwrap());
        let codes: Vec<String> =
            names.objectives.into_iter().chain(names.limits).chain(["tie break".to_owned()]).collect();
        let (mut worst, mut compared) = (0.0_f64, 0);
        for i in 0..x.len() {
            let by_difference = STEPS.map(|step| differences(&problem, &x, i, step * range[i]));
            assert_eq!(codes.len(), changes[i].len(), "{name}");
            for (k, code) in codes.iter().enumerate() {
                let own = changes[i][k] / 1e-6;
                let by = &task.variables[i].name;
                if without.is_some_and(|scene| code.ends_with(scene)) {
                    assert!(own.is_nan(), "{name}: {code} by {by}");
                    continue;
                }
                let off = by_difference.iter().map(|d| (own - d[k] * range[i]).abs() / own.abs().max(1.0));
                let off = off.fold(f64::INFINITY, f64::min);
                assert!(off < 1e-5, "{name}: {code} by {by}: {own}, off by {off}");
                compared += 1;
                worst = worst.max(off);
            }
        }
        println!("{name}: {compared} slopes, worst {worst:.1e}");
    }
}

/// What else has none: an evaluation in full, which is no quick one, and lengths that go with a variable in steps.
#[test]
fn where_there_are_no_slopes_the_problem_says_so() {
    let huang = design(HUANG);
    let problem = super::clutch::problem(&huang);
    let x: Vec<f64> = task(&huang).variables.iter().map(|v| v.start).collect();
    assert!(problem.changes(&x, std::slice::from_ref(&x)).is_none());
    let same = problem.quickly().changes(&x, std::slice::from_ref(&x)).expect("slopes");
    assert!(same[0].iter().all(|change| *change == 0.0), "the same way again changes nothing: {same:?}");
    let refused = problem.quickly().changes(&x, &[x.iter().map(|v| 1e3 * v).collect()]).expect("slopes");
    assert!(refused[0].is_empty());
}
