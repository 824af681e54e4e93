//! Sprags one by one that a driven cage carries: alike they are the one-sprag model, unlike they come off one by one; momentum and energy.

use sprag_design::Design;
use sprag_design::clutch::{GivenSprag, Scenario, Sharing, Standing};
use sprag_design::dynamics::{
    ManyRun, ManySample, ManyStart, Place, RunSettings, Sample, Stop, pivot_moments, run, run_many,
};
use sprag_design::scenario::{NoScenario, prepare, touch};
use sprag_design::sprags::{Many, NoEachSprag};

const FILE: &str = "designs/lift-off-inner.toml";

/// The file with the scene `scene`, the pivot outward by `clearance_um`, an outer race of 0.05 kg m^2.
fn scene(clearance_um: &str, scene: &str) -> Scenario {
    let text = std::fs::read_to_string(FILE).unwrap();
    let text = text
        .replace("[cage]\n", &format!("[cage]\nclearance_um = {clearance_um}\n"))
        .replace("width_mm = 20.0\n", "width_mm = 20.0\nouter_inertia_kg_m2 = 0.05\n");
    let text = format!("{text}\n[[scenarios]]\nname = \"scene\"\n{scene}");
    let design = Design::parse(&text, FILE).unwrap_or_else(|error| panic!("{error}"));
    design.scenario("scene").unwrap().clone()
}

/// 40 Nm, then 60 Nm less: the sprags let go, and the cage takes them along.
const LET_GO: &str = "kind = \"transient\"\npreload_nm = 40.0\ntorque_step_nm = -60.0\nstep_time_s = 0.005\n\
                      abutment_stiffness_nm_per_rad = 5000.0\nduration_s = 0.04\n";
/// From overrun to a load and back.
const IN_AND_OUT: &str = "kind = \"transient\"\noverrun_rpm = 100.0\npreload_nm = 20.0\ntorque_step_nm = -35.0\nstep_time_s = 0.03\n\
                          abutment_stiffness_nm_per_rad = 5000.0\nduration_s = 0.06\n";
/// The inner race beyond lift-off, slowed down, the outer one driven past it.
const OFF: &str = "kind = \"transient\"\nspeed_rpm = 1000.0\noverrun_rpm = 200.0\npreload_nm = 5.0\ntorque_step_nm = 0.0\n\
                   step_time_s = 0.0\nabutment_stiffness_nm_per_rad = 20000.0\nduration_s = 0.6\n";
const ENGAGES: &str = "kind = \"engagement\"\nfree_run_rpm = 300.0\nreversing_torque_nm = 20.0\n\
                       stop_stiffness_nm_per_rad = 1000.0\nbench_inertia_kg_m2 = 0.0\nduration_s = 0.12\n";

fn settings(many: &Many, tolerance: f64, samples: usize) -> RunSettings {
    let p = &many.alike;
    RunSettings {
        tolerance,
        duration_s: p.duration_s,
        longest_step_s: p.period_s.map_or(p.duration_s / 200.0, |s| 0.25 * s),
        samples,
        ..RunSettings::default()
    }
}

/// The sprags of `scene`, all alike, as kinds of so many.
fn kinds(scene: &Scenario, counts: &[usize]) -> Many {
    let mut many = Many::new(scene, &Sharing::default(), false).unwrap();
    let one = many.groups[0].clone();
    let kind = |n: &usize| {
        let mut group = one.clone();
        group.model = one.model.of_sprags(*n, one.model.curve.clone(), one.model.friction);
        group
    };
    many.groups = counts.iter().map(kind).collect();
    many.start = ManyStart::of(&vec![Some((many.alike.state, many.alike.mode)); counts.len()]).unwrap();
    many
}

/// Sprags that a cage holds at one angle when torque begins: larger ones take load first and let go last.
fn unlike() -> Sharing {
    let start = Standing::Caged;
    Sharing { seed: 1, start, size_within_m: 3e-6, friction_within: 0.01, ..Sharing::default() }
}

fn carried(sample: &ManySample) -> usize {
    sample.motions.iter().filter(|m| m.mode.place == Place::Carried).count()
}

fn go(many: &Many, settings: &RunSettings) -> ManyRun {
    run_many(&many.groups, many.axes.as_ref(), many.rings.as_ref(), &many.start, settings)
}

/// To what the two integrators keep at a tolerance of 1e-13, angles and rates; where sprags flutter at first contact, 64 changes, less.
#[test]
fn sprags_alike_that_a_cage_carries_are_the_one_sprag_model() {
    let mut seen = 0;
    for (clearance_um, words, allowed) in [
        ("0", LET_GO, 1e-10),
        ("5", LET_GO, 1e-10),
        ("0", IN_AND_OUT, 1e-10),
        ("5", ENGAGES, 1e-9),
        ("0", OFF, 1e-6),
        ("5", OFF, 1e-6),
    ] {
        let scene = scene(clearance_um, words);
        let p = prepare(&scene).unwrap();
        let [whole, apart] =
            [false, true].map(|apart| Many::new(&scene, &Sharing::default(), apart).unwrap());
        let settings = settings(&whole, 1e-13, 101);
        let one = run(&p.model, p.state, p.mode, &settings);
        for many in [whole, kinds(&scene, &[7, 11]), apart] {
            // Few scenes are worth a run of eighteen.
            if many.groups.len() > 2 && p.duration_s > 0.1 {
                continue;
            }
            let all = go(&many, &settings);
            let both = || one.samples.iter().zip(&all.samples);
            let off = |(a, b): (&Sample, &ManySample)| {
                let [angles, rates] = [2, 6].map(|from| &a.state[from..from + 2]);
                angles.iter().chain(rates).zip(b.races).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
            };
            let worst = both().map(off).fold(0.0, f64::max);
            let left = all.residual_j / all.through_j;
            println!(
                "{clearance_um} {words:.25} {}: {worst:.1e} beside {} rad, changes {} {}, {left:.1e}",
                many.groups.len(),
                one.state[2],
                one.events,
                all.events
            );
            assert_eq!((one.samples.len(), one.stop), (all.samples.len(), all.stop));
            assert_eq!(all.inconsistent_choices, 0);
            let events = one.events * many.groups.len() as u64;
            assert!(all.events.abs_diff(events) <= if words == OFF { events / 20 } else { 0 });
            assert!(worst < allowed && left.abs() < 1e-10, "{worst:e} {left:e}");
            assert!(both().all(|(a, b)| b.motions.iter().all(|m| m.mode.place == a.mode.place)));
            seen += all.samples.iter().filter(|s| carried(s) > 0).count();
        }
    }
    assert!(seen > 500, "{seen}");
}

/// Three kinds with springs of their own while the inner race slowly runs up: each lifts off at the speed of its own spring, the weakest
/// first, and comes back there when the race slows down.
#[test]
fn the_weakest_spring_comes_off_first() {
    let words = "kind = \"transient\"\noverrun_rpm = 600.0\npreload_nm = 0.0\ntorque_step_nm = -1.5\nstep_time_s = 0.0\n\
                 abutment_stiffness_nm_per_rad = 5000.0\nduration_s = 1.0\n";
    let mut scene = scene("0", words);
    scene.clutch.races.viscous_damping_nm_s_per_rad = 0.0;
    scene.torque_history = Some(vec![[0.0, -1.5], [0.5, -1.5], [0.5, 1.5], [1.0, 1.5]]);
    let mut many = kinds(&scene, &[6, 6, 6]);
    let parts = [1.1, 0.9, 1.0];
    for (group, part) in many.groups.iter_mut().zip(parts) {
        group.model.alpha_max_rad *= part;
    }
    let all = go(&many, &settings(&many, 1e-9, 2001));
    assert_eq!((all.stop, all.inconsistent_choices), (Stop::Finished, 0));
    let (clutch, alpha_max) = (&scene.clutch, many.alike.model.alpha_max_rad);
    let at_rest = touch(clutch, &clutch.profile().unwrap(), 0.0).unwrap();
    let mut times = Vec::new();
    for (g, part) in parts.into_iter().enumerate() {
        // The moments are as the square of the speed.
        let (lifts, closes) = pivot_moments(clutch, &clutch.cage.unwrap(), &at_rest, part * alpha_max, 80.0);
        let expected = 80.0 * (closes / lifts).sqrt();
        let is_off = |s: &&ManySample| s.motions[g].mode.is_off();
        let first = all.samples.iter().find(is_off).unwrap();
        let last = all.samples.iter().rev().find(is_off).unwrap();
        println!(
            "{part}: off at {} s, {} rad/s, back at {} s, {}: {expected}",
            first.t_s, first.races[2], last.t_s, last.races[2]
        );
        // Running up opens a sprag a little earlier, slowing down brings it back a little earlier.
        assert!((first.races[2] / expected - 1.0).abs() < 0.01, "{part}: {} {expected}", first.races[2]);
        assert!((last.races[2] / expected - 1.0).abs() < 0.01, "{part}: {} {expected}", last.races[2]);
        times.push((first.t_s, last.t_s));
    }
    assert!(times[1].0 < times[2].0 && times[2].0 < times[0].0, "{times:?}");
    assert!(times[1].1 > times[2].1 && times[2].1 > times[0].1, "{times:?}");
    // Those that have come off press nothing.
    let most = all.samples.iter().map(|s| s.motions.iter().filter(|m| m.mode.is_off()).count()).max();
    assert_eq!(most, Some(3));
    assert!(all.residual_j.abs() < 1e-8 * all.through_j, "{:e}", all.residual_j / all.through_j);
}

/// Sizes and friction drawn by chance: sprags let go and catch one by one, some with the cage while others hold; races round and bending.
#[test]
fn unlike_sprags_are_taken_along_one_by_one_and_the_balance_of_energy_closes() {
    for (words, alike) in [(LET_GO, 0.661_562_02), (IN_AND_OUT, 0.476_710_02)] {
        let scene = scene("0", words);
        for bends in [false, true] {
            let many = match bends {
                true => Many::bending(&scene, &unlike()),
                false => Many::new(&scene, &unlike(), false),
            };
            let many = many.unwrap();
            assert_eq!((many.groups.len(), many.rings.is_some()), (18, bends));
            let [coarse, all] = [1e-7, 1e-9].map(|tolerance| go(&many, &settings(&many, tolerance, 4001)));
            let mixed = all.samples.iter().filter(|s| (1..18).contains(&carried(s))).count();
            let left = all.residual_j / all.through_j;
            println!("{bends}: {} rad, {mixed} samples of some, {left:.1e}", all.races[0]);
            assert_eq!((all.stop, all.inconsistent_choices), (Stop::Finished, 0));
            assert_eq!(carried(all.samples.last().unwrap()), 18);
            // Between races that bend a sprag is pressed below its own first contact too.
            let allowed = if bends { 1e-7 } else { 1e-9 };
            assert!(mixed > 50 && left.abs() < allowed, "{mixed} {left:e}");
            let off = (all.races[0] - coarse.races[0]).abs();
            assert!(off < if bends { 1e-6 } else { 1e-8 }, "{off:e}");
            assert!((all.races[0] / alike - 1.0).abs() < 0.05, "{}", all.races[0]);
        }
    }
}

/// Free races: what the torque from outside brings is the angular momentum of races and sprags, however often these are taken along.
#[test]
fn the_blows_of_sprags_that_are_taken_along_keep_the_angular_momentum() {
    for words in [LET_GO, IN_AND_OUT] {
        let scene = scene("0", words);
        // One that waits to touch has no inertia.
        let sprung = Sharing { start: Standing::Sprung, ..unlike() };
        let mut many = Many::new(&scene, &sprung, false).unwrap();
        for group in &mut many.groups {
            group.model.loads.abutment_nm_per_rad = 0.0;
        }
        let settings = settings(&many, 1e-10, 2);
        let all = go(&many, &settings);
        assert_eq!(carried(all.samples.last().unwrap()), 18);
        let (races, sprags) = (&scene.clutch.races, &scene.clutch.sprags);
        let of_sprags: f64 = many
            .groups
            .iter()
            .map(|group| {
                let curve = &group.model.curve;
                let oc_g = curve.open(curve.first_contact_rad()).oc_g;
                sprags.inertia_kg_m2 + sprags.mass_kg * oc_g * oc_g
            })
            .sum();
        let momentum = |[_, _, inner, outer]: [f64; 4]| {
            (races.inner_inertia_kg_m2 + of_sprags) * inner + races.outer_inertia_kg_m2 * outer
        };
        let torque = &many.alike.model.drive;
        let brought: f64 = (0..6000)
            .map(|i| -torque.torque_at((f64::from(i) + 0.5) * settings.duration_s / 6000.0))
            .sum::<f64>()
            * settings.duration_s
            / 6000.0;
        let start = if many.start.races[2] > 0.0 { momentum(many.start.races) } else { 0.0 };
        let off = momentum(all.races) - start - brought;
        println!("{words:.25}: {off:e} of {brought} N m s");
        // One that is pressed in at once lies a little nearer to the axis.
        assert!(off.abs() < 1e-6 * of_sprags * all.races[2].abs().max(1.0), "{off:e}");
    }
}

/// One that lacks something to touch is no exception: beyond lift-off it stays off with the cage, however far the outer race has run on.
#[test]
fn a_sprag_with_a_gap_stays_off_beyond_lift_off() {
    let late = GivenSprag { index: 3, gap_m: Some(5e-6), ..GivenSprag::default() };
    let many =
        Many::new(&scene("0", OFF), &Sharing { given: vec![late], ..Sharing::default() }, false).unwrap();
    let all = go(&many, &settings(&many, 1e-9, 2001));
    let late = many.group[3].unwrap();
    let catches_s = all.courses[late].catches_s.unwrap();
    let (mut ahead, rpm) = (0, std::f64::consts::PI / 30.0);
    for sample in all.samples.iter().filter(|sample| sample.t_s < catches_s) {
        let motion = &sample.motions[late];
        // Lift-off is at 827 rpm.
        if 1000.0 * rpm + sample.races[2] > 1.02 * 827.0 * rpm {
            assert!(motion.waits || motion.mode.is_off(), "{sample:?}");
            ahead += u64::from(!motion.waits && sample.races[3] > sample.races[2]);
        }
    }
    assert!(ahead > 50, "{ahead}");
    assert!(all.residual_j.abs() < 1e-7 * all.through_j, "{:e}", all.residual_j / all.through_j);
}

/// Races that bend let a sprag go, and touch it, far from its own first contact: at speed the centrifugal force must not know which side it is on
/// (it left 5e-6).
#[test]
fn at_speed_a_contact_that_is_lost_between_bent_races_keeps_its_energy() {
    let words = "kind = \"transient\"\nspeed_rpm = 1000.0\noverrun_rpm = 200.0\npreload_nm = 30.0\ntorque_step_nm = 0.0\n\
                 step_time_s = 0.0\nabutment_stiffness_nm_per_rad = 200000.0\nduration_s = 0.06\n";
    let late = GivenSprag { index: 3, gap_m: Some(12.9e-6), ..GivenSprag::default() };
    let sharing = Sharing {
        seed: 63,
        start: Standing::Caged,
        gap_up_to_m: 5e-6,
        given: vec![late],
        ..Sharing::default()
    };
    let many = Many::bending(&scene("20", words), &sharing).unwrap();
    let all = go(&many, &settings(&many, 1e-9, 2));
    let (left, open) =
        (all.residual_j / all.through_j, all.courses.iter().filter(|c| c.open_s > 0.0).count());
    println!("{:?}, {left:.1e}, {open} open, {} changes", all.stop, all.events);
    assert_eq!((all.stop, all.inconsistent_choices), (Stop::Finished, 0));
    assert!(open > 3 && left.abs() < 1e-7, "{open} {left:e}");
}

#[test]
fn a_scene_that_begins_in_overrun_between_axes_that_give_way_is_refused() {
    let held = Sharing { stiffness_n_per_m: Some(1e8), ..unlike() };
    let refused = Many::new(&scene("0", IN_AND_OUT), &held, false).unwrap_err();
    assert!(matches!(refused, NoEachSprag::NoScenario(NoScenario::DrivenCage(_))), "{refused}");
    assert!(Many::new(&scene("0", LET_GO), &held, false).unwrap().groups[0].model.carried.is_none());
}
