//! Sprags one by one: scenes drawn by chance hold what every scene holds, and what an evaluation of N sprags costs.

#[path = "common/scenes.rs"]
mod scenes;

use rayon::prelude::*;
use scenes::{lasting, scene};
use sprag_design::clutch::{Carrier, Eccentricity, Scenario, ScenarioKind, Sharing, Standing};
use sprag_design::dynamics::ManyRun;
use sprag_design::scenario::Settings;
use sprag_design::sprags::{Many, NoEachSprag};

/// What is drawn follows from it; another by `SPRAGS_SEED`.
const SEED: u64 = 23;
/// Scenes; more by `SPRAGS_SCENES`, for instance `SPRAGS_SCENES=5000 cargo test --release --test sprags_sweep`.
const SCENES: u64 = 200;
/// What an energy balance may leave of what went through at a tolerance of 1e-9, at steps of which the largest seen is 8e-6.
const LEFT: f64 = 1e-5;

/// Where less than this goes through, J, nothing has happened: sprags and races hold some 0.1 J.
const NOTHING_J: f64 = 1e-6;

/// Splitmix64.
struct Chance(u64);

impl Chance {
    /// In [0, 1).
    fn part(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, from: f64, until: f64) -> f64 {
        from + (until - from) * self.part()
    }

    fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[(self.part() * all.len() as f64) as usize]
    }

    /// `value` in half of all cases, else nothing.
    fn perhaps(&mut self, value: f64) -> f64 {
        if self.part() < 0.5 { self.part() * value } else { 0.0 }
    }
}

/// A scene, its sprags, and whether its races bend.
fn drawn(seed: u64) -> (Scenario, Sharing, bool) {
    let mut by = Chance(seed);
    let (file, name) = by.one_of(&[
        ("huang2017-multi-arc", "high-10"),
        ("huang2017-multi-arc", "low-10-mu082"),
        ("huang2017-bench", "high-10-damped"),
        ("huang2017-bench", "step-up"),
        ("huang2017-bench", "step-down"),
        ("huang2017-bench", "in-and-out"),
        ("huang2017-bench", "engagement"),
        ("huang2017-bench", "engagement-weak-spring"),
    ]);
    let mut scene = scene(file, name);
    let duration_s = by.between(2e-3, 8e-3);
    match &mut scene.kind {
        ScenarioKind::Engagement { duration_s: lasts, .. } => *lasts = duration_s,
        ScenarioKind::TorsionalExcitation { amplitude_nm, preload_nm, frequency_hz, .. } => {
            *amplitude_nm *= by.between(0.5, 1.3);
            *preload_nm *= by.between(0.5, 1.3);
            *frequency_hz *= by.between(0.5, 3.0);
            lasting(&mut scene, duration_s);
        }
        ScenarioKind::Transient { step_time_s, .. } => {
            *step_time_s = by.between(0.0, 0.5) * duration_s;
            lasting(&mut scene, 2.0 * duration_s);
        }
        _ => panic!(),
    }
    let clutch = &mut scene.clutch;
    clutch.sprags.count = by.one_of(&[3, 5, 8, 12]);
    clutch.spring.stiffness_nm_per_rad *= by.one_of(&[0.0, 0.3, 1.0, 3.0]);
    clutch.friction.static_ *= by.between(0.7, 1.1);
    clutch.friction.kinetic = clutch.friction.kinetic.min(clutch.friction.static_);
    clutch.races.eccentricity = (by.part() < 0.4).then(|| Eccentricity {
        offset_m: by.between(0.0, 1e-5),
        turning: by.part() < 0.5,
        carrier: by.one_of(&[Carrier::InnerRace, Carrier::OuterRace]),
        stiffness_n_per_m: by.one_of(&[1e8, 3e8, f64::INFINITY]),
    });
    let sharing = Sharing {
        start: by.one_of(&[Standing::Sprung, Standing::Caged]),
        seed,
        size_within_m: by.perhaps(4e-6),
        azimuth_within_rad: by.perhaps(0.03),
        friction_within: by.perhaps(0.02),
        gap_up_to_m: by.perhaps(1e-5),
        mass_kg: Some(by.between(0.1, 1.0)),
        ..Sharing::default()
    };
    (scene, sharing, by.part() < 0.6)
}

fn run(seed: u64) -> Result<ManyRun, NoEachSprag> {
    let (scene, sharing, bends) = drawn(seed);
    let many = match bends {
        true => Many::bending(&scene, &sharing)?,
        false => Many::new(&scene, &sharing, false)?,
    };
    Ok(many.run(&Settings { most_steps: Some(20_000), ..Settings::default() }, 1e-9, 3))
}

/// All figures of a run.
fn figures(run: &ManyRun) -> Vec<f64> {
    let mut all = vec![run.t_s, run.residual_j, run.through_j, run.bearing_max_n, run.axis_max_m];
    all.extend(run.races);
    all.extend(run.sprags.iter().flatten());
    for c in &run.courses {
        all.extend([c.normal_max_n, c.share, c.open_s, c.catches_s.unwrap_or(-1.0)]);
        all.extend(c.net_m.iter().chain(&c.path_m).chain(&c.tan));
    }
    all.extend(run.samples.iter().flat_map(|s| &s.normal_n));
    all
}

fn given(name: &str, otherwise: u64) -> u64 {
    std::env::var(name).ok().and_then(|n| n.parse().ok()).unwrap_or(otherwise)
}

#[test]
fn scenes_drawn_by_chance_keep_their_energy_and_do_not_depend_on_threads() {
    let first = given("SPRAGS_SEED", SEED) << 32;
    let pools = [1, 2].map(|n| rayon::ThreadPoolBuilder::new().num_threads(n).build().unwrap());
    let seen: Vec<_> = (0..given("SPRAGS_SCENES", SCENES))
        .into_par_iter()
        .map(|i| {
            let seed = first + i;
            // Every fourth one on both: the tables are built side by side, the scene is not.
            let found = pools[0].install(|| run(seed));
            if i % 4 == 0 {
                let again = pools[1].install(|| run(seed));
                let bits = |found: &Result<ManyRun, NoEachSprag>| {
                    found.as_ref().map_or(vec![], |run| figures(run).into_iter().map(f64::to_bits).collect())
                };
                assert_eq!(bits(&found), bits(&again), "seed {seed}");
            }
            let run = match found {
                Ok(run) => run,
                Err(why) => return (seed, f64::NAN, format!("{why}"), 0),
            };
            let all = figures(&run);
            assert!(all.iter().all(|f| f.is_finite()), "seed {seed}, {:?}: {all:?}", run.stop);
            let left = run.residual_j / run.through_j.max(NOTHING_J);
            (seed, left.abs(), run.stop.name().to_string(), run.events)
        })
        .collect();
    let (mut ran, mut finished, mut changes) = (0, 0, 0);
    for (seed, left, how, events) in &seen {
        println!("seed {seed}: {how}, {events} changes, energy {left:.1e}");
        assert!(!(*left >= LEFT), "seed {seed}: {left:e}, {how}");
        ran += u64::from(!left.is_nan());
        finished += u64::from(how == "finished");
        changes += events;
    }
    println!("{ran} of {} scenes run, {finished} to their end, {changes} changes", seen.len());
    // Some cannot be: sprags that do not touch or carry.
    assert!(10 * ran > 7 * seen.len() as u64 && 10 * finished > 5 * seen.len() as u64);
    assert!(changes > 10 * seen.len() as u64);
}

/// Instructions of one evaluation of one sprag by itself, and of parts of that of N, for each sprag: as callgrind counts them
/// (`examples/sprags_cost.rs`), to a tenth.
const ONE: f64 = 4350.0;
const LOOK: f64 = 4000.0;
const PASS: f64 = 230.0;
/// Of a product with a matrix and of an inversion, by N and N^2.
const PRODUCT: f64 = 1.9;
const INVERSION: f64 = 2.5;

#[test]
fn an_evaluation_of_many_sprags_costs_at_most_one_and_a_half_times_as_many_of_one() {
    for count in [12, 24, 60] {
        let mut scene = scene("huang2017-multi-arc", "low-6");
        scene.clutch.races.eccentricity = None;
        scene.clutch.sprags.count = count;
        lasting(&mut scene, 0.01);
        let unlike = Sharing { seed: 1, size_within_m: 1e-6, ..Sharing::default() };
        let run = Many::bending(&scene, &unlike).unwrap().run(&Settings::default(), 1e-9, 0);
        let (n, evaluations, work) = (count as f64, run.counters.rhs_evaluations as f64, run.bending);
        let each = |number: u64| number as f64 / evaluations;
        let cost = LOOK * each(run.looks)
            + (PASS + PRODUCT * n) * each(work.passes)
            + PRODUCT * n * each(work.products)
            + INVERSION * n * n * each(work.inversions);
        println!("{count}: {:.3} of one, looks {}, {work:?}, {:?}", cost / ONE, run.looks, run.counters);
        assert!(cost < 1.5 * ONE, "{count}: {cost}");
    }
}

#[test]
fn zz_debug() {
    for seed in std::env::var("ZZ").unwrap_or_default().split(',').filter_map(|s| s.parse::<u64>().ok()) {
        let (scene, sharing, bends) = drawn(seed);
        println!("{} {bends} {:?} count {} spring {:?} fr {:?} ecc {:?} {sharing:?}", scene.name, scene.kind, scene.clutch.sprags.count, scene.clutch.spring, scene.clutch.friction, scene.clutch.races.eccentricity);
        let many = if bends { Many::bending(&scene, &sharing) } else { Many::new(&scene, &sharing, false) }.unwrap();
        println!("groups {} rings {} axes {:?} start {:?}", many.groups.len(), many.rings.is_some(), many.axes, many.start);
        for tolerance in [1e-8, 1e-9, 1e-10, 1e-11, 1e-12] {
            let r = many.run(&Settings::default(), tolerance, 3);
            println!("{tolerance:e} {:?} left {:e} through {:e} events {} incons {} steps {} races {:?} open {:?}", r.stop, r.residual_j / r.through_j, r.through_j, r.events, r.inconsistent_choices, r.counters.steps, r.races, r.courses.iter().map(|c| c.open_s).collect::<Vec<_>>());
        }
    }
}
