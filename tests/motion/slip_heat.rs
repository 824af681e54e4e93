//! Work, heat and wear of slip: what friction took in the energy balance, sums by hand over a fine history, nothing where nothing slips,
//! and a motion that feels nothing of it.

use sprag_design::clutch::{Scenario, ScenarioKind};
use sprag_design::design::Design;
use sprag_design::dynamics::{Forces, Grip, History, Run, RunSettings, run};
use sprag_design::lubrication::STEEL_EFFUSIVITY;
use sprag_design::scenario::{Settings, prepare, simulate};
use std::f64::consts::PI;
use std::path::Path;

fn scene(file: &str, name: &str) -> Scenario {
    Design::read(Path::new(file)).unwrap().scenario(name).unwrap().clone()
}

/// high-10 with less friction at both contacts, so that the outer one slips too.
fn slippery() -> Scenario {
    let mut scene = scene("designs/huang2017-multi-arc.toml", "high-10");
    (scene.clutch.friction.static_, scene.clutch.friction.kinetic) = (0.09, 0.063);
    scene
}

fn settings() -> RunSettings {
    RunSettings {
        tolerance: 1e-9,
        longest_step_s: 5e-4,
        energy: true,
        slip_heat: true,
        ..RunSettings::default()
    }
}

fn ran(scene: &Scenario, settings: RunSettings) -> Run {
    let p = prepare(scene).unwrap();
    run(&p.model, p.state, p.mode, &RunSettings { duration_s: p.duration_s, ..settings })
}

fn near(a: f64, b: f64, part: f64) {
    assert!((a - b).abs() <= part * b.abs(), "{a} for {b}");
}

#[test]
fn work_is_what_friction_took_and_path_and_time_are_those_of_the_slip() {
    let file = "designs/huang2017-multi-arc.toml";
    for (scene, slips) in [(slippery(), 2), (scene(file, "high-10"), 2), (scene(file, "low-10-mu082"), 1)] {
        let r = ran(&scene, settings());
        assert_eq!(r.slip_heat.iter().flatten().count(), slips);
        let (energy, count) = (r.energy.unwrap(), scene.clutch.sprags.count as f64);
        // What little B rubs while A is open is no slip under load.
        let each = [(energy.friction_inner_j, 1e-12, r.inner), (energy.friction_outer_j, 1e-5, r.outer)];
        for (heat, (work_j, part, record)) in r.slip_heat.iter().zip(each) {
            let Some(heat) = heat else {
                assert_eq!((work_j, record.time_s), (0.0, 0.0));
                continue;
            };
            near(heat.whole.work_j, -work_j / count, part);
            near(heat.whole.path_m, record.distance_m, 1e-8);
            near(heat.whole.time_s, record.time_s, 1e-9);
            assert!(heat.worst.work_j > 0.0 && heat.worst.work_j < heat.whole.work_j);
            assert!(heat.worst.flash_k <= heat.whole.flash_k && heat.worst.power_w <= heat.whole.power_w);
        }
    }
}

#[test]
fn the_motion_feels_nothing_of_it() {
    let [with, without] = [true, false]
        .map(|slip_heat| ran(&slippery(), RunSettings { slip_heat, samples: 101, ..settings() }));
    assert_eq!((with.state, with.events, with.peaks), (without.state, without.events, without.peaks));
    assert_eq!(
        (with.counters.steps, with.counters.rhs_evaluations),
        (without.counters.steps, without.counters.rhs_evaluations)
    );
    assert_eq!(with.energy, without.energy);
    assert_eq!(without.slip_heat, [None; 2]);
}

/// Its worst slip in a fine history, summed step by step: the flat by Johnson's formula, the flash by Duhamel's integral over all that came
/// before in that slip.
#[test]
fn work_wear_and_flash_by_hand() {
    let scene = scene("designs/huang2017-multi-arc.toml", "low-10-mu082");
    let window_s = [0.0404, 0.0413];
    let history = History { window_s: Some(window_s), marks: false };
    let r = ran(&scene, RunSettings { samples: 9001, history, ..settings() });
    let worst = r.slip_heat[0].unwrap().worst;
    assert!(worst.from_s > window_s[0] && worst.from_s + worst.time_s < window_s[1], "{worst:?}");
    let modulus_pa = 206e9 / (2.0 * (1.0 - 0.3 * 0.3));
    // On the second arc.
    let (radius, length) = (1.0 / (1.0 / 4.08e-3 + 1.0 / 11.11e-3), 6e-3);
    let half_m = |n: f64| (4.0 * n / length * radius / (PI * modulus_pa)).sqrt();
    let within: Vec<Forces> =
        r.samples.iter().filter(|s| s.mode.inner != Grip::Stick).map(|s| s.forces).collect();
    let dt = (window_s[1] - window_s[0]) / 9000.0;
    near(dt * within.len() as f64, worst.time_s, 1e-3);
    let power = |f: &Forces| (f.t_bi * f.v_a).abs();
    let area = |f: &Forces| 2.0 * half_m(f.n_bi) * length;
    let sum = |rate: &dyn Fn(&Forces) -> f64| dt * within.iter().map(rate).sum::<f64>();
    near(worst.work_j, sum(&power), 1e-4);
    near(worst.path_m, sum(&|f| f.v_a.abs()), 1e-4);
    // Shorter than the flat is wide: race and sprag are rubbed alike.
    assert!(worst.path_m < 2.0 * half_m(within[0].n_bi));
    let rubbed = sum(&|f| f.n_bi / area(f) * f.v_a.abs());
    near(worst.rubbed_sprag_n_per_m, rubbed, 1e-4);
    near(worst.rubbed_race_n_per_m, rubbed, 1e-4);
    for (depth, k) in worst.wear_m([1e-18, 3e-18]).into_iter().zip([1e-18, 3e-18]) {
        near(depth, k * rubbed, 1e-4);
    }
    let largest = |value: &dyn Fn(&Forces) -> f64| within.iter().map(value).fold(0.0, f64::max);
    near(worst.power_w, largest(&power), 1e-2);
    near(worst.flux_w_m2, largest(&|f| power(f) / area(f)), 1e-2);
    let lag: Vec<f64> =
        (0..within.len()).map(|n| 2.0 * dt.sqrt() * (((n + 1) as f64).sqrt() - (n as f64).sqrt())).collect();
    let flux: Vec<f64> = within.iter().map(|f| power(f) / area(f)).collect();
    let flash = |i: usize| {
        let standing = (0..=i).map(|j| flux[j] * lag[i - j]).sum::<f64>() / (PI.sqrt() * STEEL_EFFUSIVITY);
        let f = &within[i];
        let passed = 1.11 * flux[i] * (2.0 * half_m(f.n_bi) / f.v_a.abs()).sqrt() / STEEL_EFFUSIVITY;
        let sprag = 4.0 / PI * standing;
        let race = sprag.min(passed);
        sprag * race / (sprag + race)
    };
    let hottest = (1..within.len()).step_by(20).map(flash).fold(0.0, f64::max);
    println!("{worst:?}, by hand {hottest} K");
    near(worst.flash_k, hottest, 0.01);
}

#[test]
fn nothing_is_said_where_nothing_slips_under_load() {
    let settings = Settings { slip_heat: true, ..Settings::default() };
    for (file, name) in [
        ("designs/huang2017-multi-arc.toml", "low-6"),
        ("designs/huang2017-multi-arc.toml", "rated-45"),
        ("designs/huang2017-bench.toml", "overrun"),
    ] {
        let s = simulate(&scene(file, name), &settings).unwrap();
        assert_eq!((s.slip_heat, s.wear_m(0)), ([None; 2], None), "{name}");
    }
    // The free run before an engagement is none; without a spring A slips on when it is over.
    let scene = scene("designs/huang2017-bench.toml", "engagement-without-spring");
    let s = simulate(&scene, &Settings { energy: true, ..settings }).unwrap();
    let took = -s.energy.unwrap().friction_inner_j / scene.clutch.sprags.count as f64;
    if let Some(work) = s.slipped(0) {
        assert!(work.work_j < took && work.from_s >= s.engaged.unwrap().t_s);
        near(work.path_m, s.inner.distance_m, 1e-6);
    }
}

#[test]
fn errors_are_stated_and_periods_that_are_jumped_count() {
    let settings = Settings { slip_heat: true, ..Settings::default() };
    let s = simulate(&slippery(), &settings).unwrap();
    let (work, e) = (s.slipped(0).unwrap(), s.error.unwrap());
    let finer = simulate(&slippery(), &Settings { tolerance: 1e-9, ..settings.clone() }).unwrap();
    let exact = finer.slipped(0).unwrap();
    assert!(
        (work.work_j - exact.work_j).abs() <= e.slip_work_inner_j && e.slip_work_inner_j < 1e-3 * work.work_j
    );
    assert!((work.flash_k - exact.flash_k).abs() <= e.flash_inner_k && e.flash_inner_k < 0.02 * work.flash_k);
    let mut long = slippery();
    if let ScenarioKind::TorsionalExcitation { duration_s, .. } = &mut long.kind {
        *duration_s = 8.0;
    }
    let [jumped, whole] = [false, true]
        .map(|every_period| simulate(&long, &Settings { every_period, ..settings.clone() }).unwrap());
    assert!(!jumped.jumps.is_empty());
    for contact in [0, 1] {
        let [a, b] = [&jumped, &whole].map(|s| s.slip_heat[contact].unwrap());
        near(a.whole.work_j, b.whole.work_j, 1e-3);
        near(a.whole.rubbed_race_n_per_m, b.whole.rubbed_race_n_per_m, 1e-2);
        near(a.whole.flash_k, b.whole.flash_k, 1e-2);
    }
}
