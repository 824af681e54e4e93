//! Beyond the end of the curve: the falling branch against a script of its own (`tests/reference/roll_over.py`), what was stored comes back,
//! and scenes that go there.
use sprag_design::answer::simulation::SimulationSettings;
use sprag_design::answer::stiffness::StiffnessSettings;
use sprag_design::clutch::{Clutch, ContactLaw};
use sprag_design::design::Design;
use sprag_design::wedge::{OverEnd, RollOver, WedgeCurve};

const SINGLE: &str = include_str!("../designs/huang2017-single-arc.toml");
const MULTI: &str = include_str!("../designs/huang2017-multi-arc.toml");

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
    let mut reader = csv::Reader::from_reader(include_str!("reference/roll_over.csv").as_bytes());
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
