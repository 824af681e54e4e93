//! What a search computes with less work is what `check` and `simulate` compute: curves, demands, whole evaluations.

use sprag_design::clutch::StressState;
use sprag_design::dynamics::{RunSettings, rolling, rolling_quickly};
use sprag_design::optimise::{ClutchProblem, Evaluate, Fidelity};
use sprag_design::scenario::{demand, demand_quickly, prepare};
use sprag_design::wedge::Effort;
use sprag_design::{ContactLaw, Design, Settings, WedgeCurve};
use std::path::Path;

const MULTI: &str = "designs/huang2017-multi-arc.toml";

fn designs() -> Vec<Design> {
    let mut files: Vec<_> = std::fs::read_dir("designs").unwrap().map(|f| f.unwrap().path()).collect();
    files.retain(|f| f.extension().is_some_and(|e| e == "toml"));
    files.sort();
    files.iter().map(|f| Design::read(f).unwrap()).collect()
}

#[test]
fn a_quick_curve_is_the_curve() {
    let elastic = |state| ContactLaw::Elastic { state };
    let laws = [
        ContactLaw::Hertz,
        elastic(StressState::Layer),
        elastic(StressState::PlaneStrain),
        ContactLaw::Slice { coefficient: 3.944e-5 },
    ];
    let mut cases: Vec<(String, sprag_design::Clutch)> =
        designs().into_iter().map(|d| (d.name.clone(), d.clutch)).collect();
    for law in laws {
        let clutch = Design::read(Path::new(MULTI)).unwrap().clutch;
        cases.push((format!("multi-arc, {law:?}"), sprag_design::Clutch { contact: law, ..clutch }));
    }
    // Panels are halved here, as those of the series of 160 mm at speed are: radii far apart under one patch, as an optimum has them.
    let mut clutch = Design::read(Path::new("designs/huang2017-elastic.toml")).unwrap().clutch;
    for (arc, radius_m) in clutch.sprags.inner_arcs.iter_mut().zip([4.255e-3, 3.6e-3, 5.17e-3]) {
        arc.radius_m = radius_m;
    }
    cases.push(("elastic, radii far apart".to_owned(), clutch));
    for (name, clutch) in cases {
        let profile = clutch.profile().unwrap();
        for speed in [0.0, 1000.0] {
            let full = WedgeCurve::build(&clutch, &profile, speed);
            let quick = WedgeCurve::build_reaching_at(&clutch, &profile, speed, None, Effort::Search);
            let (Ok(full), Ok(quick)) = (&full, &quick) else {
                assert_eq!(full.is_ok(), quick.is_ok(), "{name}");
                continue;
            };
            assert_eq!((full.end().0, full.arc_count()), (quick.end().0, quick.arc_count()), "{name}");
            let near = |a: f64, b: f64, size: f64| (a - b).abs() < 1e-7 * size;
            let end = full.end_torque_nm();
            assert!(near(end, quick.end_torque_nm(), end), "{name}");
            assert!(near(full.roll_over_torque_nm(), quick.roll_over_torque_nm(), end), "{name}");
            let mut worst = 0.0_f64;
            for i in 1..400 {
                // As dense at small loads as at large ones.
                let alpha = full.first_contact_rad()
                    + (full.end().1 - full.first_contact_rad()) * (f64::from(i) / 400.0).powi(2);
                let k = full.arc_at(alpha);
                let (a, b) = (full.in_arc(k, alpha), quick.in_arc(k, alpha));
                for (a, b, size) in [
                    (a.n_bi, b.n_bi, a.n_bi),
                    (a.windup, b.windup, a.windup),
                    (a.t_static, b.t_static, a.t_static.abs().max(a.n_bi * 0.05)),
                    (a.rho_i + a.rho_e, b.rho_i + b.rho_e, a.rho_i + a.rho_e),
                    (a.oa, b.oa, a.oa),
                    (a.ob, b.ob, a.ob),
                    (a.oc_g, b.oc_g, a.oc_g),
                ] {
                    worst = worst.max((a - b).abs() / size);
                }
            }
            println!("{name} at {speed}: {worst:.1e}, truncation {:.1e}", quick.truncation());
            assert!(worst < 1e-7, "{name} at {speed}: {worst:e}");
            assert!(worst > 0.0, "{name} at {speed}: the full one in its place");
            for share in [0.01, 0.3, 0.7, 0.99] {
                let (a, b) = (full.at_torque(share * end), quick.at_torque(share * end));
                let (Some(a), Some(b)) = (a, b) else { panic!("{name}: {share}") };
                for (a, b) in [
                    (a.normal_inner_n, b.normal_inner_n),
                    (a.tan_omega, b.tan_omega),
                    (a.windup_rad, b.windup_rad),
                    (a.hertz_inner_pa, b.hertz_inner_pa),
                ] {
                    assert!(near(a, b, a), "{name} at {share}: {a} {b}");
                }
            }
        }
    }
}

#[test]
fn two_equations_roll_as_four_do() {
    // Down to where steps reach rounding: the same motion, derived twice.
    for name in ["high-6", "low-10", "rated-45", "rated-45-at-speed"] {
        let design = Design::read(Path::new(MULTI)).unwrap();
        let p = prepare(design.scenario(name).unwrap()).unwrap();
        let settings = RunSettings {
            tolerance: 1e-11,
            duration_s: 0.1,
            longest_step_s: p.period_s.unwrap() / 14.0,
            most_steps: 100_000,
            rolling: true,
            ..RunSettings::default()
        };
        let four = rolling(&p.model, p.state, p.mode.place, &settings);
        let two = rolling_quickly(&p.model, p.state, p.mode.place, &settings, 1e-11);
        assert!(two.run.counters != four.run.counters, "{name}: the same run");
        let (a, b) = (four.run.peaks, two.run.peaks);
        for (a, b) in [
            (a.tan_inner, b.tan_inner),
            (a.tan_outer, b.tan_outer),
            (a.normal_min_n, b.normal_min_n),
            (a.normal_max_n, b.normal_max_n),
            (a.normal_outer_max_n, b.normal_outer_max_n),
        ] {
            assert!((a / b - 1.0).abs() < 2e-10, "{name}: {a} {b}");
        }
    }
}

/// A swing with something turning behind the inner race: the two equations do not hold that, so the run has to be the whole one.
#[test]
fn a_drivetrain_counts_in_a_quick_demand() {
    let text = std::fs::read_to_string(MULTI).unwrap();
    let train = "[[drivetrain]]\nname = \"rolls\"\nto = \"inner-race\"\ninertia_kg_m2 = 0.002\n\
                 stiffness_nm_per_rad = 5.0e3\ndamping_nm_s_per_rad = 0.8\n\n[optimize]";
    let joined = Design::parse(&text.replacen("[optimize]", train, 1), "x.toml").unwrap();
    let alone = Design::parse(&text, "x.toml").unwrap();
    let of = |design: &Design| {
        let p = prepare(design.scenario("low-10").unwrap()).unwrap();
        let friction = |demand: sprag_design::scenario::RollingDemand| demand.required_friction.unwrap();
        (friction(demand(&p, &Settings::default())), friction(demand_quickly(&p, &Settings::default())))
    };
    let ((exact, quick), (without, _)) = (of(&joined), of(&alone));
    assert!((quick / exact - 1.0).abs() < 1e-6, "{quick} {exact}");
    assert!((without / exact - 1.0).abs() > 1e-2, "{without} {exact}");
}

#[test]
fn the_quick_demand_is_the_demand() {
    let (mut worst, mut scenes) = ([0.0_f64; 2], [0, 0]);
    for design in designs() {
        for scene in &design.scenarios {
            let Ok(p) = prepare(scene) else { continue };
            let exact = demand(&p, &Settings { tolerance: 1e-9, ..Settings::default() });
            let quick = demand_quickly(&p, &Settings::default());
            let name = format!("{}, {}", design.name, scene.name);
            assert_eq!(
                (exact.finished, exact.never_engages, exact.by_bisection, exact.required_friction.is_some()),
                (quick.finished, quick.never_engages, quick.by_bisection, quick.required_friction.is_some()),
                "{name}"
            );
            // What is bisected is as good as its bracket is narrow; the rolling motion, with its tension, is held beside it.
            let required =
                exact.required_friction.zip(quick.required_friction).filter(|_| !exact.by_bisection);
            let off = [
                required.map_or(0.0, |(a, b)| b / a - 1.0),
                quick.contact_margin - exact.contact_margin,
                quick.normal_max_n[0] / exact.normal_max_n[0].max(1e-30) - 1.0,
                quick.normal_max_n[1] / exact.normal_max_n[1].max(1e-30) - 1.0,
            ];
            let off = off.into_iter().map(f64::abs).fold(0.0, f64::max);
            println!("{name}: {off:.1e}, {} right-hand sides", quick.rhs_evaluations);
            if !exact.never_engages {
                let bisected = usize::from(exact.by_bisection);
                assert!(off < [1e-6, 5e-6][bisected], "{name}: {off:e}");
                worst[bisected] = worst[bisected].max(off);
                scenes[bisected] += 1;
            }
        }
    }
    println!("{scenes:?} scenes by peaks and bisected, {worst:?} off at most");
    assert!(scenes[0] > 15 && scenes[1] > 5, "{scenes:?}");
}

/// The sooner a motion dies away, the sooner its run ends; where it beats or grows for long it is run on. Errors of steps that damping
/// does not take away add up to some tolerances.
#[test]
fn a_quick_run_ends_early_only_where_it_has_settled() {
    let text = std::fs::read_to_string(MULTI).unwrap();
    let (mut worst, mut early) = ([0.0_f64; 2], 0);
    for damping in ["0.0", "0.0003", "0.003", "0.03", "0.3"] {
        for frequency in ["41.0", "100.0", "130.0", "170.0", "260.0"] {
            let text = text
                .replacen(
                    "viscous_damping_nm_s_per_rad = 0.1",
                    &format!("viscous_damping_nm_s_per_rad = {damping}"),
                    1,
                )
                .replace("frequency_hz = 100.0", &format!("frequency_hz = {frequency}"));
            let design = Design::parse(&text, "x.toml").unwrap();
            for name in ["high-6", "low-10", "rated-45-at-speed"] {
                let p = prepare(design.scenario(name).unwrap()).unwrap();
                let exact = demand(&p, &Settings { tolerance: 1e-8, ..Settings::default() });
                let quick = demand_quickly(&p, &Settings::default());
                let case = format!("{name}, damping {damping}, {frequency} Hz");
                assert_eq!(exact.by_bisection, quick.by_bisection, "{case}");
                if exact.by_bisection {
                    continue;
                }
                let off = [
                    quick.required_friction.unwrap() / exact.required_friction.unwrap() - 1.0,
                    quick.contact_margin - exact.contact_margin,
                    quick.normal_max_n[0] / exact.normal_max_n[0] - 1.0,
                    quick.normal_max_n[1] / exact.normal_max_n[1] - 1.0,
                ];
                let off = off.into_iter().map(f64::abs).fold(0.0, f64::max);
                // Of a run to the end at its longest steps, with twelve right-hand sides each.
                let whole = 14.0 * 12.0 * p.duration_s / p.period_s.unwrap();
                let share = quick.rhs_evaluations as f64 / whole;
                println!("{case}: {off:.1e}, {share:.2} of the whole");
                assert!(damping != "0.0" || share > 0.99, "{case}: nothing dies away, {share}");
                early += u32::from(share < 0.6);
                let worst = &mut worst[usize::from(damping.parse::<f64>().unwrap() < 0.03)];
                *worst = worst.max(off);
            }
        }
    }
    println!("{early} ended early; off at most, damped and hardly damped: {worst:?}");
    assert!(worst[0] < 1e-6 && worst[1] < 4e-6, "{worst:?}");
    assert!(early >= 10, "{early}");
}

/// The multi-arc clutch with law `law`.
fn multi(law: &str) -> String {
    let text = std::fs::read_to_string(MULTI).unwrap();
    text.replace("law = \"roller\"", &format!("law = \"{law}\"")).replace("roller_coefficient", "# ")
}

/// A scene for a design that has none.
const CRANKING: &str = "
[[scenarios]]
name = \"cranking\"
kind = \"transient\"
preload_nm = 50.0
torque_step_nm = 20.0
step_time_s = 0.003
abutment_stiffness_nm_per_rad = 20000.0
duration_s = 0.03
speed_rpm = 0.0
";

/// Design `file` with `more` and two radii to be found.
fn with_radii(file: &str, more: &str) -> String {
    let text = std::fs::read_to_string(file).unwrap();
    format!(
        "{text}{more}\n[optimize]\nobjective = \"slip-margin\"\nscenarios = [\"cranking\"]\nvariables = [\n\
         {{ name = \"r_i1_mm\", min = 4.0, max = 4.3 }},\n{{ name = \"r_i2_mm\", min = 4.1, max = 4.4 }},\n]\nseed = 1\n"
    )
}

#[test]
fn an_evaluation_of_a_search_is_one_of_check() {
    let roller = std::fs::read_to_string(MULTI).unwrap();
    // Steps of a run do not see where an edge of the patch passes a junction, which law `elastic` feels.
    let cases = [
        ("roller", roller, 40, 1e-6),
        ("elastic", multi("elastic"), 80, 2e-6),
        ("hertz", multi("hertz"), 10, 1e-6),
        ("starter", with_radii("designs/starter.toml", ""), 10, 1e-6),
        ("FE check", with_radii("designs/fe-check-24.toml", CRANKING), 10, 1e-6),
    ];
    for (name, text, count, stated) in cases {
        let design = Design::parse(&text, name).unwrap_or_else(|e| panic!("{name}: {e}"));
        let task = design.optimize.clone().unwrap();
        let names: Vec<String> = task.variables.iter().map(|v| v.name.clone()).collect();
        let problem = ClutchProblem::new(&design, &task, names, Fidelity::default()).quickly();
        let sharp = problem.at_fidelity(Fidelity::default().sharper());
        let mut random = fastrand::Rng::with_seed(22);
        let (mut worst, mut compared) = (0.0_f64, 0);
        for _ in 0..count {
            let x: Vec<f64> = task.variables.iter().map(|v| v.min + random.f64() * (v.max - v.min)).collect();
            let (quick, sharp) = (problem.evaluate(&x), sharp.evaluate(&x));
            assert_eq!(quick.is_ok(), sharp.is_ok(), "{name} at {x:?}");
            let (Ok(quick), Ok(sharp)) = (quick, sharp) else { continue };
            let pairs = quick
                .objectives
                .iter()
                .chain(&quick.limits)
                .zip(sharp.objectives.iter().chain(&sharp.limits));
            for (i, (a, b)) in pairs.enumerate() {
                let off = (a - b).abs() / b.abs().max(1.0);
                assert!(off < stated, "{name}: margin {i} at {x:?}: {a} {b}");
                worst = worst.max(off);
            }
            compared += 1;
        }
        println!("{name}: {worst:.1e} off at most at {compared} of {count} points");
        assert!(2 * compared >= count, "{name}: {compared}");
    }
}
