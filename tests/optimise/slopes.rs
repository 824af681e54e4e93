//! Slopes that a problem gives itself, against differences of whole evaluations.

use sprag_design::optimise::*;
use sprag_design::scenario::Settings as RunSettings;

use super::clutch::{HUANG, PEER_B, PEER_C, changed, design, task};

/// Fourth-order differences of the outputs at `x` along variable `i` over `h`, and what those over 2 h differ by.
fn differences(problem: &ClutchProblem, x: &[f64], i: usize, h: f64) -> Vec<(f64, f64)> {
    let at = |k: f64| {
        let mut x = x.to_vec();
        x[i] += k * h;
        let e = problem.evaluate(&x).expect("near a design");
        [e.objectives, e.limits, vec![e.tie_break]].concat()
    };
    let [b4, b2, b1, f1, f2, f4] = [-4.0, -2.0, -1.0, 1.0, 2.0, 4.0].map(at);
    (0..f1.len())
        .map(|k| {
            let of = |one: f64, two: f64, h: f64| (8.0 * one - two) / (12.0 * h);
            let fine = of(f1[k] - b1[k], f2[k] - b2[k], h);
            (fine, (fine - of(f2[k] - b2[k], f4[k] - b4[k], 2.0 * h)).abs())
        })
        .collect()
}

/// Every slope of every row by every variable. `kinks`: rows of which a difference may straddle a kink, as its own error tells.
#[test]
fn slopes_are_those_of_whole_evaluations() {
    let elastic = ("law = \"roller\"", "law = \"elastic\"");
    let bare = ("roller_coefficient = 3.944e-5", "#");
    let designs = [
        ("Huang, roller", design(HUANG)),
        ("Huang, elastic", changed(HUANG, &[elastic, bare])),
        ("flanks free", design(PEER_B)),
        ("24 sprags, roller", design(PEER_C)),
        ("24 sprags, elastic", changed(PEER_C, &[elastic, bare])),
    ];
    let mut worst_of_all = 0.0_f64;
    for (name, design) in designs {
        let task = task(&design);
        let names: Vec<String> = task.variables.iter().map(|v| v.name.clone()).collect();
        let settings = RunSettings { tolerance: 1e-9, ..RunSettings::default() };
        let fidelity = Fidelity { settings, ..Fidelity::default() };
        let problem = ClutchProblem::new(&design, task, names, fidelity).quickly();
        let x: Vec<f64> = task.variables.iter().map(|v| v.start + 0.013 * (v.max - v.min)).collect();
        let range: Vec<f64> = task.variables.iter().map(|v| v.max - v.min).collect();
        let beside: Vec<Vec<f64>> = (0..x.len())
            .map(|i| {
                x.iter().enumerate().map(|(k, v)| if k == i { v + 1e-6 * range[i] } else { *v }).collect()
            })
            .collect();
        let changes = problem.changes(&x, &beside).expect("slopes");
        let names = problem.names(&problem.assess_at(&x).unwrap());
        let codes: Vec<String> =
            names.objectives.into_iter().chain(names.limits).chain(["tie break".to_owned()]).collect();
        let (mut worst, mut compared) = (0.0_f64, 0);
        for i in 0..x.len() {
            let by_difference = differences(&problem, &x, i, 2e-4 * range[i]);
            assert_eq!(by_difference.len(), changes[i].len(), "{name}");
            for (k, (slope, doubt)) in
                by_difference.iter().map(|(d, e)| (d * range[i], e * range[i])).enumerate()
            {
                let own = changes[i][k] / 1e-6;
                let off = (own - slope).abs() / slope.abs().max(0.1);
                if off > 1e-5 {
                    println!(
                        "{name}: {} by {}: {own} against {slope}, {doubt:.0e}",
                        codes[k], task.variables[i].name
                    );
                }
                compared += 1;
                worst = worst.max((off - 2.0 * doubt / slope.abs().max(0.1)).max(0.0));
            }
        }
        println!("{name}: {compared} slopes, worst {worst:.1e}");
        worst_of_all = worst_of_all.max(worst);
    }
    assert!(worst_of_all < 1e-5, "{worst_of_all}");
}
