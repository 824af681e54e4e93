//! Beyond the end of the curve: the falling branch against a script of its own (`tests/reference/roll_over.py`), what was stored comes back,
//! and scenes that go there.
use sprag_design::answer::simulation::SimulationSettings;
use sprag_design::answer::stiffness::StiffnessSettings;
use sprag_design::clutch::{Clutch, ContactLaw};
use sprag_design::design::Design;
use sprag_design::wedge::{OverEnd, RollOver, WedgeCurve};

const SINGLE: &str = include_str!("../../designs/huang2017-single-arc.toml");
const MULTI: &str = include_str!("../../designs/huang2017-multi-arc.toml");

fn single() -> Clutch {
    Design::parse(SINGLE, "single.toml").unwrap().clutch
}

/// The way over of `clutch`, with its flanks or without.
fn over(clutch: &Clutch, flanks: bool) -> RollOver {
    let profile = clutch.profile().unwrap();
    let curve = WedgeCurve::build(clutch, &profile, 0.0).unwrap();
    let brink = clutch.brink(&profile).filter(|_| flanks);
    assert_eq!(brink.is_some(), flanks);
    curve.beyond(brink.as_ref()).unwrap()
}

#[test]
fn the_falling_branch_is_that_of_a_script_of_its_own() {
    let way = over(&single(), false);
    assert_eq!(way.end, OverEnd::ContactLost);
    let mut reader = csv::Reader::from_reader(include_str!("../reference/roll_over.csv").as_bytes());
    let mut compared = 0;
    for row in reader.records() {
        let row = row.unwrap();
        let [normal_n, torque_nm, windup_rad] = [2, 3, 4].map(|i| row[i].parse::<f64>().unwrap());
        let p = match &row[0] {
            "edge" => way.branch[0],
            "upright" => way.upright.unwrap(),
            "least" => way.least,
            _ => {
                // Between two points of the branch.
                let i = way.branch.partition_point(|p| p.windup_rad < windup_rad);
                let [a, b] = [way.branch[i - 1], way.branch[i]];
                let part = (windup_rad - a.windup_rad) / (b.windup_rad - a.windup_rad);
                let torque = a.torque_nm + (b.torque_nm - a.torque_nm) * part;
                assert!((torque - torque_nm).abs() < 0.3, "{}: {torque} against {torque_nm}", &row[0]);
                continue;
            }
        };
        compared += 1;
        println!("{}: {p:?}", &row[0]);
        assert!(
            (p.windup_rad - windup_rad).abs() < 3e-7,
            "{}: {} against {windup_rad}",
            &row[0],
            p.windup_rad
        );
        // Upright lies a part of 1e-13 below the largest force, where the torque is not yet 0.
        assert!((p.torque_nm - torque_nm).abs() < 5e-4, "{}: {} against {torque_nm}", &row[0], p.torque_nm);
        // The least torque is flat in alpha, the force is not.
        let near = if &row[0] == "least" { 1e-4 } else { 1e-8 };
        assert!((p.normal_inner_n / normal_n - 1.0).abs() < near, "{}: {}", &row[0], p.normal_inner_n);
    }
    assert_eq!(compared, 3);
}

/// What contacts and races hold at the loss of contact is nothing: int C dW over the whole way is 0, over arcs, both edges and upright. (6) is
/// left out: it takes N_bi for both halves of the body, and what N_be does to one of them depends on the way.
#[test]
fn what_was_stored_comes_back() {
    for law in [ContactLaw::Roller { coefficient: 3.944e-5 }, ContactLaw::Hertz] {
        for flanks in [false, true] {
            let mut clutch = Clutch { contact: law, ..single() };
            clutch.sprags.width_m = 0.0;
            let way = over(&clutch, flanks);
            let most = way.upright.unwrap().stored_j;
            println!("{law:?}: {} J of {most} J left, {:?}", way.last.stored_j, way.end);
            assert_eq!(way.end, OverEnd::ContactLost);
            assert!(way.last.stored_j.abs() < 1e-7 * most, "{law:?}: {} J of {most} J", way.last.stored_j);
            assert!(way.peak.stored_j < most && way.peak.torque_nm > 100.0);
        }
    }
}

/// Upright the centres lie on one line with the axis: what all bodies give together is what the sprag is higher than the gap.
#[test]
fn upright_all_gives_what_the_sprag_is_too_high() {
    let clutch = single();
    let way = over(&clutch, false);
    let n = way.upright.unwrap().normal_inner_n;
    let profile = clutch.profile().unwrap();
    let arc = profile.arcs[0];
    let edge = arc.centre_m + arc.radius_m * profile.contact_direction(arc.until_rad);
    let high_m = edge.norm() + clutch.sprags.outer_radius_m
        - (clutch.races.outer_radius_m - clutch.races.inner_radius_m);
    let ring = |inside: f64, outside: f64, nu: f64| {
        let [a, b] = [inside * inside, outside * outside];
        12.0 / (std::f64::consts::TAU * 6e-3 * 206e9) * ((a + b) / (b - a) + nu)
    };
    let roller = 2.0 * 3.944e-5 * n.powf(0.9) / 6.0f64.powf(0.8) * 1e-3;
    let rings = n * (ring(7.21e-3, 11.11e-3, -0.3) + ring(19.44e-3, 26.23e-3, 0.3));
    let body = n * 8.33e-3 / (5.05e-3 * 6e-3 * 206e9);
    let gives = roller + rings + body;
    assert!((gives / high_m - 1.0).abs() < 1e-7, "{gives} m of {high_m} m");
}

/// Each design of the project has a way over, with its flanks; a contact that leaves the arcs keeps N and torque.
#[test]
fn the_way_begins_where_the_curve_ends() {
    for file in ["huang2017-single-arc", "huang2017-multi-arc", "huang2017-elastic", "starter", "fe-check-24"]
    {
        let design = Design::read(format!("designs/{file}.toml").as_ref()).unwrap();
        let profile = design.clutch.profile().unwrap();
        let curve = WedgeCurve::build(&design.clutch, &profile, 0.0).unwrap();
        let way = curve.beyond(design.clutch.brink(&profile).as_ref()).unwrap();
        let end = curve.at_torque(curve.end_torque_nm() * (1.0 - 1e-13)).unwrap();
        let first = way.branch[0];
        println!("{file}: {:?}\n{:?}\n{:?}\n{:?} {:?}", way.peak, way.upright, way.least, way.last, way.end);
        // What an outline gives is continued straight where a flank is near: a kink in the table.
        assert!((first.torque_nm / end.torque_nm - 1.0).abs() < 5e-6, "{file}: {first:?}, {end:?}");
        assert!((first.windup_rad - end.windup_rad).abs() < 1e-9, "{file}: {first:?}, {end:?}");
        assert!(way.peak.torque_nm >= end.torque_nm * (1.0 - 1e-9), "{file}");
        assert_ne!(way.end, OverEnd::NoConvergence, "{file}");
    }
}

/// The multi-arc clutch under a step of its torque, `step_nm`.
fn overloaded(step_nm: f64) -> Design {
    let scene = format!(
        "\n[[scenarios]]\nname = \"too-much\"\nkind = \"transient\"\npreload_nm = 16.8\ntorque_step_nm = {step_nm:?}\nstep_time_s = 0.001\n\
         abutment_stiffness_nm_per_rad = 50000.0\nduration_s = 0.05\n"
    );
    Design::parse(&(MULTI.to_owned() + &scene), "over.toml").unwrap()
}

#[test]
fn a_scene_beyond_the_end_is_followed_until_contact_is_lost() {
    let answer = overloaded(260.0).simulate("too-much", &SimulationSettings::default()).unwrap();
    assert_eq!(answer.verdict(), Some("overloaded"));
    let b = answer.beyond.as_ref().unwrap();
    println!(
        "{}\n{} s, {} rad/s, {} N m, {:?}",
        answer.verdict_line(),
        b.t_s,
        b.speed_rad_s,
        b.torque_nm,
        b.error
    );
    assert_eq!(b.fate.name(), "rolled-over");
    let end = answer.simulation().unwrap();
    assert!(b.t_s > end.t_s && b.speed_rad_s > 0.0, "{b:?}");
    let error = b.error.unwrap();
    assert!(error[0] < 1e-6 && error[1] < 1e-4 * b.speed_rad_s, "{error:?}");
    assert!(answer.verdict_line().contains("roll over"));
    let energy = b.energy.unwrap();
    println!("balance {} J of {} J", energy.residual_j(), energy.through_j);
    assert!(energy.relative().abs() < 1e-6, "{energy:?}");
    // Energy of the inner race, which the torque drives: its work on the windup less what is left stored, nothing, and what the damping
    // between the races takes. The outer race all but stands on its abutment.
    let work_j = 276.8 * b.way.last.windup_rad;
    let kinetic_j = 0.5 * 1.41e-3 * b.speed_rad_s * b.speed_rad_s;
    println!("work {work_j} J, motion {kinetic_j} J");
    assert!(kinetic_j < work_j && kinetic_j > 0.5 * work_j, "{kinetic_j} J of {work_j} J");
}

/// Beyond the profile of the file the torque still rises: a swing that goes there comes back.
#[test]
fn a_swing_beyond_the_profile_comes_back() {
    let answer = overloaded(98.0).simulate("too-much", &SimulationSettings::default()).unwrap();
    println!("{}", answer.verdict_line());
    assert_eq!(answer.verdict(), Some("overloaded"));
    let b = answer.beyond.as_ref().unwrap();
    assert_eq!(b.fate.name(), "came-back");
    assert!((b.t_s - 0.05).abs() < 1e-12 && b.way.peak.torque_nm > 210.0);
    // The equilibrium under the whole torque.
    assert!((b.torque_nm / 114.8 - 1.0).abs() < 0.5, "{} N m", b.torque_nm);
}

#[test]
fn stiffness_tells_what_comes_after_the_end() {
    let design = Design::parse(SINGLE, "single.toml").unwrap();
    let asked =
        |torques: &[f64]| StiffnessSettings { torques_nm: torques.to_vec(), ..StiffnessSettings::default() };
    let answer = design.stiffness(&asked(&[50.0, 500.0])).unwrap();
    let end = answer.body.laws[0].curve.end.clone();
    let way = end.beyond.unwrap();
    assert!(way.peak.torque_nm >= end.torque_nm);
    let rows = |answer: &sprag_design::answer::stiffness::StiffnessAnswer| answer.table().rows.len();
    assert_eq!(rows(&answer), 2 + way.branch.len());
    assert_eq!(rows(&design.stiffness(&asked(&[50.0])).unwrap()), 1);
}

/// Between round races sprags alike go over as one: the clutch's own falling branch. One that stands apart parts the branch in two, and what was stored
/// comes back all the same.
#[test]
fn unlike_sprags_go_over_one_after_another() {
    use sprag_design::clutch::{GivenSprag, Sharing};
    use sprag_design::sharing::{NotShared, Turn};
    let mut clutch = single();
    clutch.sprags.width_m = 0.0;
    let curve = clutch.curve().unwrap();
    let way = over(&clutch, true);
    let alike = Turn::new(&clutch, &Sharing::default(), &curve);
    let (end_nm, NotShared::End(first, why)) = alike.end(1e4).unwrap() else { panic!() };
    let pops = alike.first().pops((first, why), end_nm, 0.0, &way).unwrap();
    println!("{end_nm} {why:?}, peak {:?} against {:?}, left {:?}", pops.peak, way.peak, pops.left_nm);
    assert!((pops.peak.torque_nm / way.peak.torque_nm - 1.0).abs() < 1e-6);
    assert!((pops.peak.windup_rad / way.peak.windup_rad - 1.0).abs() < 1e-3);
    // They share alike, so all follow the first.
    assert_eq!(pops.left_nm, None);
    assert_eq!(pops.course.last().unwrap().gone, clutch.sprags.count);
    let late = GivenSprag { index: 3, gap_m: Some(60e-6), ..GivenSprag::default() };
    let turn = Turn::new(&clutch, &Sharing { given: vec![late], ..Sharing::default() }, &curve);
    let (end_nm, NotShared::End(first, why)) = turn.end(1e4).unwrap() else { panic!() };
    let unlike = turn.first();
    let pops = unlike.pops((first, why), end_nm, 0.0, &way).unwrap();
    let lag = unlike.lag_rad[3].unwrap() - unlike.lag_rad[0].unwrap();
    println!(
        "{end_nm} sprag {first}: lag {lag}, peak {:?}, left {:?} of {}",
        pops.peak,
        pops.left_nm,
        pops.left.len()
    );
    // By hand: eleven on the branch, the late one where it is lag behind.
    let at = |w: f64| {
        let one = |y: f64| match y {
            _ if y <= 0.0 || y >= way.last.windup_rad => 0.0,
            _ if y <= curve.end_windup_rad() => curve.at_windup(y).map_or(0.0, |(p, _)| p.t_static * p.oa),
            _ => way.at_windup(y).unwrap().torque_nm / 12.0,
        };
        11.0 * one(w) + one(w - lag)
    };
    for p in &pops.course {
        assert!((p.torque_nm - at(p.windup_rad)).abs() < 1e-9, "{p:?}");
    }
    assert!(
        pops.peak.torque_nm < way.peak.torque_nm && pops.peak.torque_nm > 11.0 / 12.0 * way.peak.torque_nm
    );
    let work: f64 = pops
        .course
        .windows(2)
        .map(|w| 0.5 * (w[0].torque_nm + w[1].torque_nm) * (w[1].windup_rad - w[0].windup_rad))
        .sum();
    let most: f64 = pops
        .course
        .windows(2)
        .map(|w| 0.5 * (w[0].torque_nm + w[1].torque_nm).max(0.0) * (w[1].windup_rad - w[0].windup_rad))
        .sum();
    println!("{work} J of {most} J");
    assert!(work.abs() < 3e-3 * most, "{work} {most}");
}

/// A scene that overloads one that is smaller: that one comes to its end first and is followed beyond it, the others carry on.
#[test]
fn a_sprag_that_goes_over_in_a_scene_is_followed_and_the_others_carry_on() {
    use sprag_design::clutch::{GivenSprag, ScenarioKind, Sharing};
    use sprag_design::dynamics::Stop;
    use sprag_design::scenario::Settings;
    use sprag_design::sprags::each_sprag;
    let mut design = Design::parse(SINGLE, "single.toml").unwrap();
    let scene = design.scenarios.iter_mut().find(|s| s.name == "low-6").unwrap();
    scene.clutch.friction.static_ = 1.5;
    scene.clutch.friction.kinetic = 1.4;
    let forward = GivenSprag { index: 3, size_m: Some(-180e-6), ..GivenSprag::default() };
    let sharing = Sharing { given: vec![forward], ..Sharing::default() };
    let ScenarioKind::TorsionalExcitation { duration_s, preload_nm, amplitude_nm, .. } = &mut scene.kind
    else {
        panic!()
    };
    (*duration_s, *preload_nm, *amplitude_nm) = (0.006, 30.0, 400.0);
    let found = each_sprag(scene, &sharing, &Settings::default()).unwrap();
    let course = |i: usize| &found.run.courses[found.group[i].unwrap()];
    println!(
        "{:?} at {} s {:?}; {:?} {:?}",
        found.run.stop,
        found.run.t_s,
        found.run.at_group,
        course(3).over_s,
        course(3).gone_s
    );
    println!("energy {:e} of {:e}, error {:?}", found.run.residual_j, found.run.through_j, found.error);
    let left = found.run.residual_j / found.run.through_j;
    assert!(left.abs() < 1e-6, "{left:e}");
    assert_eq!(found.run.stop, Stop::Finished);
    assert!(course(3).over_s.is_some() && (0..12).filter(|i| *i != 3).all(|i| course(i).over_s.is_none()));
}

/// The single arc's clutch under a step of `part` of what it carries on its curve, `size_m` less than drawn by one sprag, and some more by others.
fn too_much(part: f64, sizes_m: &[f64]) -> (sprag_design::clutch::Scenario, sprag_design::clutch::Sharing) {
    use sprag_design::clutch::{GivenSprag, ScenarioKind, Sharing};
    let design = Design::parse(SINGLE, "single.toml").unwrap();
    let mut scene = design.scenario("low-6").unwrap().clone();
    (scene.clutch.friction.static_, scene.clutch.friction.kinetic) = (1.5, 1.4);
    let end_nm = scene.clutch.curve().unwrap().end_torque_nm();
    scene.kind = ScenarioKind::Transient {
        preload_nm: 0.1 * end_nm,
        torque_step_nm: part * end_nm,
        step_time_s: 0.001,
        abutment_stiffness_nm_per_rad: 5e4,
        duration_s: 0.02,
        speed_rad_s: 0.0,
        overrun_rad_s: 0.0,
    };
    let given = |(i, size_m): (usize, &f64)| GivenSprag {
        index: 2 + 3 * i,
        size_m: Some(*size_m),
        ..GivenSprag::default()
    };
    let given = sizes_m.iter().enumerate().map(given).collect();
    (scene, Sharing { given, ..Sharing::default() })
}

/// Two of twelve go over for good while an overrun comes to its end and the rest takes hold: these bear the torque to the end of the scene.
#[test]
fn those_that_remain_carry_on_to_the_end_of_the_scene() {
    use sprag_design::clutch::ScenarioKind;
    use sprag_design::dynamics::Stop;
    use sprag_design::scenario::Settings;
    use sprag_design::sprags::Many;
    let (mut scene, sharing) = too_much(0.9, &[-180e-6, -162e-6]);
    let ScenarioKind::Transient { preload_nm, overrun_rad_s, .. } = &mut scene.kind else { panic!() };
    (*preload_nm, *overrun_rad_s) = (0.0, 10.0);
    let many = Many::bending(&scene, &sharing).unwrap();
    let settings = Settings::default();
    assert_eq!(many.run(&settings, 1e-8, 0).stop, Stop::CurveEnd);
    let over = many.going_over(&scene.clutch).unwrap();
    let run = over.run(&settings, 1e-9, 0);
    let gone = run.courses.iter().filter(|c| c.gone_s.is_some()).count();
    let left = run.residual_j / run.through_j;
    println!("{:?}, {gone} gone, {left:.1e}", run.stop);
    assert_eq!((run.stop, run.inconsistent_choices), (Stop::Finished, 0));
    assert!(gone > 0 && gone < 12 && left.abs() < 1e-7, "{gone} {left:e}");
}

/// The way over is one of races on one axis. Where theirs may move the scene ends where the first sprag's curve does, by name, and with all figures.
#[test]
fn between_axes_that_may_move_a_scene_ends_where_the_curve_does() {
    use sprag_design::dynamics::Stop;
    use sprag_design::scenario::Settings;
    use sprag_design::sprags::each_sprag;
    let (scene, mut sharing) = too_much(0.9, &[-60e-6]);
    sharing.stiffness_n_per_m = Some(2e8);
    sharing.mass_kg = Some(0.5);
    let found = each_sprag(&scene, &sharing, &Settings::default()).unwrap();
    let run = &found.run;
    let left = run.residual_j / run.through_j;
    println!("{:?} of {:?} at {} s, {left:.1e}", run.stop, run.at_group, run.t_s);
    assert!(found.axes.is_some());
    assert_eq!((run.stop, run.at_group), (Stop::CurveEnd, found.group[2]));
    assert!(
        run.courses.iter().all(|c| c.over_s.is_none() && c.gone_s.is_none() && c.normal_max_n.is_finite())
    );
    assert!(run.t_s > 0.001 && run.t_s < 0.02 && left.abs() < 1e-6, "{left:e}");
}
