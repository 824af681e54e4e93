//! Sprags one by one beside the junctions of their arcs: they come to their end.

use crate::by_chance::{Chance, given};
use sprag_design::clutch::{Carrier, Eccentricity, Scenario, ScenarioKind, Sharing, Standing};
use sprag_design::dynamics::Place;
use sprag_design::scenario::Settings;
use sprag_design::sprags::Many;
use sprag_design::{Design, WedgeCurve};

/// What is drawn follows from it; another by `SPRAGS_SEED`.
const SEED: u64 = 77;
/// Scenes; more by `SPRAGS_SCENES`.
const SCENES: u64 = 60;
/// Steps and changes that no scene needs: a sequence without end needs more.
const MOST: u64 = 100_000;

/// A scene about the torque under which sprags lie on a junction, with friction about what that asks for, its sprags, whether its races bend,
/// and a tolerance.
fn drawn(seed: u64) -> (Scenario, Sharing, bool, f64) {
    let mut by = Chance::new(seed);
    // The paper's junctions, and ones at which the radius jumps by more, either way.
    let radius_mm = 4.02 + 0.06 * by.one_of(&[1.0, 1.0, 3.0, 10.0, -3.0, -8.0]);
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/designs/huang2017-multi-arc.toml");
    let text = std::fs::read_to_string(path).unwrap();
    let changed = text.replace("radius_mm = 4.08,", &format!("radius_mm = {radius_mm},"));
    let design = Design::parse(&changed, "junctions.toml").unwrap();
    let mut scene = design.scenario(by.one_of(&["high-6", "low-10-mu082", "low-8"])).unwrap().clone();
    let curve = WedgeCurve::build(&scene.clutch, &scene.clutch.profile().unwrap(), 0.0).unwrap();
    let junction = curve.arc_end_rad(by.one_of(&[0, 1]));
    let (mut low, mut high) = (0.0, curve.end_torque_nm());
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let below = curve.at_torque(middle).is_some_and(|point| point.alpha_rad < junction);
        *(if below { &mut low } else { &mut high }) = middle;
    }
    let asked = curve.at_torque(low).unwrap().tan_omega;
    let count = by.one_of(&[3, 5, 8, 12]);
    let torque = low * count as f64 / scene.clutch.sprags.count as f64;
    let ScenarioKind::TorsionalExcitation {
        preload_nm,
        amplitude_nm,
        frequency_hz,
        duration_s,
        speed_rad_s,
        ..
    } = &mut scene.kind
    else {
        panic!()
    };
    *preload_nm = torque * by.between(0.97, 1.03);
    *amplitude_nm = torque * by.one_of(&[0.01, 0.1, 0.5, 1.2]) * by.between(0.5, 1.0);
    *frequency_hz = by.between(50.0, 1500.0);
    *duration_s = by.between(3e-3, 1e-2);
    if by.0.f64() < 0.2 {
        *speed_rad_s = by.between(50.0, 400.0);
    }
    let clutch = &mut scene.clutch;
    clutch.sprags.count = count;
    clutch.spring.stiffness_nm_per_rad *= by.one_of(&[0.0, 0.3, 1.0, 3.0]);
    clutch.friction.static_ = asked * by.between(0.97, 1.06);
    clutch.friction.kinetic = clutch.friction.static_ * by.one_of(&[1.0, 1.0, 0.97, 0.85]);
    clutch.races.viscous_damping_nm_s_per_rad *= by.one_of(&[0.0, 1.0, 10.0]);
    clutch.races.inner_inertia_kg_m2 *= by.one_of(&[0.01, 0.1, 1.0]);
    clutch.races.outer_inertia_kg_m2 *= by.one_of(&[0.01, 0.1, 1.0]);
    clutch.races.eccentricity = (by.0.f64() < 0.3).then(|| Eccentricity {
        offset_m: by.between(0.0, 1e-5),
        turning: by.0.bool(),
        carrier: by.one_of(&[Carrier::InnerRace, Carrier::OuterRace]),
        stiffness_n_per_m: by.one_of(&[1e8, 3e8, f64::INFINITY]),
    });
    let sharing = Sharing {
        start: by.one_of(&[Standing::Sprung, Standing::Caged]),
        seed: seed & u64::from(u32::MAX),
        size_within_m: by.perhaps(4e-6),
        azimuth_within_rad: by.perhaps(0.03),
        friction_within: by.perhaps(0.005),
        gap_up_to_m: by.perhaps(1e-5),
        mass_kg: Some(by.between(0.1, 1.0)),
        ..Sharing::default()
    };
    let bends = by.0.f64() < 0.6;
    (scene, sharing, bends, by.one_of(&[1e-6, 1e-9]))
}

/// A sprag that a junction holds between forces either way passes it without end: the limit at which such changes of one sprag are closed
/// (`dynamics::zeno`) sprags one by one have not. Of the first 755 scenes one needs it, 460: A slips on the one arc and holds on the other.
#[test]
fn scenes_beside_a_junction_come_to_their_end() {
    let (first, scenes) = (given("SPRAGS_SEED", SEED) << 32, given("SPRAGS_SCENES", SCENES));
    let (mut ran, mut passed, mut most) = (0, 0, 0);
    for seed in first..first + scenes {
        let (scene, sharing, bends, tolerance) = drawn(seed);
        let many = match bends {
            true => Many::bending(&scene, &sharing),
            false => Many::new(&scene, &sharing, false),
        };
        let Ok(many) = many else { continue };
        let settings = Settings { most_steps: Some(MOST), most_events: Some(MOST), ..Settings::default() };
        let run = many.run(&settings, tolerance, 200);
        assert!(!run.stop.gave_up() && run.inconsistent_choices == 0, "seed {seed}: {:?}", run.stop);
        let arc = |place: Place| if let Place::Arc(k) = place { Some(k) } else { None };
        let passes = |g: usize| {
            let arcs = run.samples.iter().filter_map(|sample| arc(sample.motions[g].mode.place));
            let (least, most) = arcs.fold((usize::MAX, 0), |(a, b), k| (a.min(k), b.max(k)));
            least < most
        };
        let those = (0..many.groups.len()).filter(|g| passes(*g)).count();
        println!("seed {seed}: {}, {} changes, {those} pass a junction", run.stop.name(), run.events);
        ran += 1;
        passed += u64::from(those > 0);
        most = most.max(run.events);
    }
    println!("{ran} of {scenes} scenes run, {passed} with a junction that is passed, at most {most} changes");
    assert!(10 * ran > 9 * scenes && 3 * passed > ran);
}
