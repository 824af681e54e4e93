//! Sprags one by one in a scene: alike they are the one-sprag model, unlike they are what statics and an independent script say.

use sprag_design::clutch::{GivenSprag, Scenario, ScenarioKind, Sharing, Standing};
use sprag_design::dynamics::{RunSettings, Stop, run};
use sprag_design::scenario::{Settings, prepare};
use sprag_design::sharing::{Asked, Unlike};
use sprag_design::sprags::Many;
use sprag_design::{Design, WedgeCurve};

fn scene(file: &str, name: &str) -> Scenario {
    let path = format!("{}/designs/{file}.toml", env!("CARGO_MANIFEST_DIR"));
    Design::read(path.as_ref()).unwrap().scenario(name).unwrap().clone()
}

fn alike() -> Sharing {
    Sharing {
        start: Standing::Sprung,
        seed: 1,
        size_within_m: 0.0,
        azimuth_within_rad: 0.0,
        friction_within: 0.0,
        gap_up_to_m: 0.0,
        stiffness_n_per_m: None,
        given: Vec::new(),
    }
}

#[test]
fn sprags_alike_are_the_one_sprag_model_over_the_scenes_history() {
    for (file, name, apart) in [
        ("huang2017-multi-arc", "high-6", true),
        ("huang2017-multi-arc", "high-6", false),
        ("huang2017-multi-arc", "high-8", false),
        ("huang2017-multi-arc", "high-10", false),
        ("huang2017-multi-arc", "low-10-mu082", false),
        ("huang2017-bench", "engagement", false),
        ("huang2017-bench", "step-up", false),
        ("huang2017-multi-arc", "high-10", true),
    ] {
        let scene = scene(file, name);
        let many = Many::new(&scene, &alike(), apart).unwrap();
        let p = prepare(&scene).unwrap();
        let period = p.period_s.map_or(p.duration_s / 200.0, |s| 0.25 * s);
        let settings = RunSettings {
            tolerance: 1e-13,
            duration_s: p.duration_s,
            longest_step_s: 0.25 * period,
            samples: 101,
            ..RunSettings::default()
        };
        let one = run(&p.model, p.state, p.mode, &settings);
        let with = Settings { longest_step_s: Some(0.25 * period), ..Settings::default() };
        let all = many.run(&with, 1e-13, 101);
        let (mut worst, mut size) = (0.0_f64, 0.0_f64);
        for (a, b) in one.samples.iter().zip(&all.samples) {
            for i in 0..2 {
                worst = worst.max((a.state[2 + i] - b.races[i]).abs());
                size = size.max(a.state[2 + i].abs());
            }
        }
        let normal = (one.peaks.normal_max_n / all.courses[0].normal_max_n - 1.0).abs();
        println!(
            "{file} {name} {apart}: {worst:.2e} of {size:.2e} rad, largest N {normal:.1e}, events {} {}, steps {} {}, evaluations {} {}, {:?} {}, energy {:.1e}",
            one.events,
            all.events,
            one.counters.steps,
            all.counters.steps,
            one.counters.rhs_evaluations,
            all.counters.rhs_evaluations,
            all.stop,
            all.inconsistent_choices,
            all.residual_j / all.through_j
        );
        assert_eq!((one.stop, all.stop), (Stop::Finished, Stop::Finished));
    }
}
