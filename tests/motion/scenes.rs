//! The scenes beside torsional excitation: engagement, transients from files, Vernay's friction, contact damping.

use sprag_design::clutch::{Scenario, ScenarioKind};
use sprag_design::design::Design;
use sprag_design::dynamics::{Grip, Mode, Place, Run, RunSettings, Stop, preloaded, run};
use sprag_design::margin::{lift_off_rad_s, load_state};
use sprag_design::scenario::{Prepared, Settings, Verdict, prepare, simulate};
use sprag_design::wedge::WedgeCurve;
use std::path::Path;

fn design() -> Design {
    Design::read(Path::new("designs/huang2017-bench.toml")).unwrap()
}

fn scene(name: &str) -> Scenario {
    design().scenario(name).unwrap().clone()
}

fn run_at(p: &Prepared, tolerance: f64, samples: usize) -> Run {
    let settings = RunSettings {
        tolerance,
        duration_s: p.duration_s,
        longest_step_s: p.duration_s / 200.0,
        samples,
        ..RunSettings::default()
    };
    run(&p.model, p.state, p.mode, &settings)
}

#[test]
fn a_step_at_the_start_is_the_other_torque_from_the_start() {
    let mut step = scene("step-up");
    if let ScenarioKind::Transient { step_time_s, .. } = &mut step.kind {
        *step_time_s = 0.0;
    }
    let p = prepare(&step).unwrap();
    let stepped = run_at(&p, 1e-10, 0);
    let mut held = p.clone();
    held.model.drive = Default::default();
    held.model.loads.inner_nm = -16.8;
    let plain = run_at(&held, 1e-10, 0);
    assert_eq!((stepped.stop, stepped.events), (Stop::Finished, plain.events));
    for i in 0..8 {
        let scale = plain.state[i].abs().max(1e-3);
        assert!((stepped.state[i] - plain.state[i]).abs() < 1e-8 * scale, "{i}: {:?}", stepped.state);
    }
}

#[test]
fn a_history_may_end_where_the_scene_does() {
    // Beyond its last knot a history goes on, a few roundings later, which may be beyond the end.
    let mut scene = scene("step-up");
    for k in 1..=200 {
        let end_s = 5e-4 * f64::from(k) / 3.0;
        let ScenarioKind::Transient { duration_s, .. } = &mut scene.kind else { unreachable!() };
        *duration_s = end_s;
        scene.torque_history = Some(vec![[0.0, 3.34], [0.3 * end_s, 5.0], [end_s, 10.0], [end_s, 0.0]]);
        let r = run_at(&prepare(&scene).unwrap(), 1e-6, 0);
        assert_eq!((r.stop, r.t_s), (Stop::Finished, end_s));
    }
}

#[test]
fn knots_cost_no_accuracy() {
    // Jump, ramps and plateaus: the tolerance alone decides.
    for name in ["step-up", "step-down", "in-and-out"] {
        let p = prepare(&scene(name)).unwrap();
        let best = run_at(&p, 1e-12, 0);
        let plain = run_at(&p, 1e-8, 0);
        assert_eq!(best.stop, Stop::Finished);
        let moved = (best.state[2] - plain.state[2]).abs();
        assert!(moved < 1e-8, "{name}: {moved:e} rad");
        // Where nothing slips, all that a step could stumble over is the jump.
        let free = name != "step-up" || plain.counters.rejections < plain.counters.steps / 4;
        assert!(free, "{name}: {:?}", plain.counters);
    }
    let p = prepare(&scene("step-up")).unwrap();
    let before = run_at(&Prepared { duration_s: 0.0099, ..p.clone() }, 1e-10, 0);
    // The start is the equilibrium with the spring: nothing moves before the step.
    assert!((before.state[2] - p.state[2]).abs() < 1e-12 && before.events == 0, "{:?}", before.state);
}

#[test]
fn engaging_into_preload_and_engaging_out_follow_one_another() {
    let s = simulate(&scene("in-and-out"), &Settings { samples: 1001, ..Settings::default() }).unwrap();
    let model = prepare(&scene("in-and-out")).unwrap().model;
    let turn = |from_s: f64, until_s: f64| {
        let inside = s.samples.iter().filter(|x| x.t >= from_s && x.t <= until_s);
        let alphas: Vec<f64> = inside.map(|x| x.state[0]).collect();
        (alphas[0], alphas[alphas.len() - 1])
    };
    let held = model.curve.at_torque(16.8).unwrap().alpha_rad;
    let (into, preload, out) = (turn(0.0, 0.02), turn(0.055, 0.06), turn(0.06, 0.08));
    assert!(into.0 < 1e-3 && into.1 > 0.9 * held, "{into:?}");
    assert!((preload.0 / held - 1.0).abs() < 0.03 && (preload.1 / held - 1.0).abs() < 0.03, "{preload:?}");
    assert!(out.0 > 0.9 * held && out.1 < 0.02 * held, "{out:?}");
    let overruns = |m: &&(f64, Mode)| m.1.inner == Grip::Slip(1.0) || m.1.place == Place::Open;
    assert!(s.modes.iter().find(overruns).unwrap().0 > 0.075);
    assert_eq!(s.verdict, Some(Verdict::SlipsOverrunning));
}

#[test]
fn a_change_of_speed_asks_the_clutch_for_the_inertia_behind_it() {
    // The outer race drags the rest along: C = (I_bi + sprags) dOmega/dt on the inner race.
    let mut scene = scene("speed-ramp");
    if let ScenarioKind::Transient { overrun_rad_s, duration_s, .. } = &mut scene.kind {
        (*overrun_rad_s, *duration_s) = (0.0, 0.5);
    }
    scene.torque_history = Some(vec![[0.0, 10.0], [1.0, 10.0]]);
    scene.speed_history = Some(vec![[0.0, 0.0], [0.1, 0.0], [0.5, 400.0]]);
    let p = prepare(&scene).unwrap();
    let r = run_at(&p, 1e-9, 4001);
    // Nothing slips: every change of mode is one of arc.
    let arcs = r.modes.windows(2).filter(|two| two[0].1.place != two[1].1.place).count() as u64;
    assert_eq!((r.stop, r.events, r.inner.time_s, r.outer.time_s), (Stop::Finished, arcs, 0.0, 0.0));
    let torques = r.samples.iter().filter(|s| s.t > 0.3).map(|s| {
        let point = p.model.point(s.mode.place, s.state[0]);
        12.0 * s.forces.t_bi * point.oa
    });
    let torques: Vec<f64> = torques.collect();
    let mean = torques.iter().sum::<f64>() / torques.len() as f64;
    // 1.41e-3 kg m^2 at 1000 rad/s^2, and the preload of 10 Nm.
    assert!((mean - 11.41).abs() < 0.05, "{mean}");
}

#[test]
fn a_ramp_of_speed_lifts_the_sprags_where_the_steady_state_says() {
    let design = design();
    let scene = scene("speed-ramp");
    let mut mild = design.clone();
    mild.clutch = scene.clutch.clone();
    let state = load_state(&mild).unwrap();
    let steady = lift_off_rad_s(&mild, &state, 2000.0).unwrap();
    let r = run_at(&prepare(&scene).unwrap(), 1e-8, 2);
    let opened = r.modes.iter().find(|m| m.1.place == Place::Open).unwrap().0;
    let rpm = 3000.0 + (opened - 0.1) / 0.8 * 3000.0;
    let expected = steady * 30.0 / std::f64::consts::PI;
    println!("lift-off at {rpm:.0} rpm in the ramp, {expected:.0} rpm steady");
    assert!((rpm / expected - 1.0).abs() < 0.01, "{rpm} against {expected}");
}

#[test]
fn with_vernays_friction_only_the_inner_contact_slips() {
    for name in ["high-10-vernay", "engagement-vernay"] {
        let scene = scene(name);
        assert!(scene.clutch.friction.outer_holds && scene.clutch.friction.kinetic == 0.12);
        let r = run_at(&prepare(&scene).unwrap(), 1e-9, 2);
        assert_eq!((r.outer.time_s, r.outer.distance_m), (0.0, 0.0), "{name}");
        assert!(r.inner.distance_m > 1e-6, "{name}");
        assert!(r.modes.iter().all(|m| m.1.outer == Grip::Stick));
    }
    let two = [scene("high-10-vernay"), scene("high-10-damped")];
    let [vernay, paper] = two.map(|s| simulate(&s, &Settings::default()).unwrap().offset_rad);
    assert!((vernay - paper).abs() > 1e-5, "it is another law: {vernay} {paper}");
}

/// "the spring force exerted by the spring blade plays a key role to end the slip" (4.1.1).
#[test]
fn without_the_spring_the_sprags_do_not_come_back() {
    let without = simulate(&scene("high-10-without-spring"), &Settings::default()).unwrap();
    assert_eq!(without.verdict, Some(Verdict::Disengages));
    assert!(without.contact_lost_s > 0.2, "{}", without.contact_lost_s);
    let engagement = simulate(&scene("engagement-without-spring"), &Settings::default()).unwrap();
    assert!(engagement.theta_inner_rad < -1.0 && engagement.peaks.normal_max_n == 0.0);
    // It touches, but without a force.
    assert_eq!(engagement.verdict, Some(Verdict::Disengages));
    let with = simulate(&scene("engagement"), &Settings::default()).unwrap();
    assert_eq!(with.verdict, Some(Verdict::Sticks));
}

/// Energy that the damping takes, from slopes of the closures that the dynamics does not use.
#[test]
fn contact_damping_takes_the_energy_that_it_should() {
    let mut clutch = design().clutch;
    clutch.races.viscous_damping_nm_s_per_rad = 0.0;
    clutch.hunt_crossley_s_per_m = 2.0;
    let curve = WedgeCurve::build(&clutch, &clutch.profile().unwrap(), 0.0).unwrap();
    let loads = sprag_design::dynamics::Loads {
        inner_nm: -16.8,
        amplitude_nm: 0.0,
        omega_rad_s: 0.0,
        abutment_nm_per_rad: 5000.0,
    };
    let mut model = sprag_design::dynamics::Model::new(&clutch, curve, loads, 0.1449, 0.0);
    let (state, place) = preloaded(&model, 16.8).unwrap();
    model.loads.inner_nm = -14.0;
    let mode = Mode { place, inner: Grip::Stick, outer: Grip::Stick };
    let prepared = Prepared {
        model,
        state,
        mode,
        duration_s: 0.02,
        period_s: None,
        static_normal_n: 1.0,
        overrun: None,
        free_run: None,
        start: Default::default(),
    };
    let r = run_at(&prepared, 1e-11, 20_001);
    let model = &prepared.model;
    assert_eq!((r.stop, r.inner.time_s), (Stop::Finished, 0.0));
    let curve = &model.curve;
    // delta_i shortens OC_i, delta_e lengthens OC_e; slopes by N over the slope of alpha by N.
    let power = |s: &sprag_design::dynamics::Sample| {
        let p = model.point(s.mode.place, s.state[0]);
        let (_, c) = curve.closure_at_normal(p.n_bi).unwrap();
        let slope_i = -c.lengths.oc_i.d / c.alpha.d;
        let slope_e = c.lengths.oc_e.d / c.alpha.d;
        let rate = model.rates(&s.mode, &p, &s.state)[0];
        12.0 * 2.0 * rate * rate * (p.n_bi * slope_i * slope_i + c.n_be.v * slope_e * slope_e)
    };
    let energy = |s: &sprag_design::dynamics::Sample| {
        let p = model.point(s.mode.place, s.state[0]);
        let rates = model.rates(&s.mode, &p, &s.state);
        let stored = sprag_design::numeric::quadrature::integral(state[0], s.state[0], |alpha| {
            let q = curve.in_arc(curve.arc_at(alpha), alpha);
            q.t_static * q.oa * (q.rho_i + q.rho_e)
        });
        model.energy_without_wedge(&p, &rates, &s.state) + 12.0 * stored - model.loads.inner_nm * s.state[2]
    };
    let h = 0.02 / 20_000.0;
    let powers: Vec<f64> = r.samples.iter().map(power).collect();
    assert!(powers.iter().all(|p| *p >= 0.0));
    // Simpson.
    let taken: f64 = powers
        .chunks(2)
        .zip(powers[1..].chunks(2))
        .zip(powers[2..].chunks(2))
        .map(|((a, b), c)| h / 3.0 * (a[0] + 4.0 * b[0] + c[0]))
        .sum();
    let lost = energy(&r.samples[0]) - energy(&r.samples[20_000]);
    println!("damping took {taken:.6e} J, the clutch lost {lost:.6e} J");
    assert!(taken > 1e-6 && (taken / lost - 1.0).abs() < 1e-4, "{taken} {lost}");
}

/// Rolling from the reversal would need a little tension, and yet the clutch holds: no peak of |T|/N says what
/// friction that takes, a bisection does.
#[test]
fn where_the_contact_opens_the_friction_is_bisected() {
    let mut scene = scene("engagement");
    if let ScenarioKind::Engagement { free_run_rad_s, reversing_torque_nm, .. } = &mut scene.kind {
        (*free_run_rad_s, *reversing_torque_nm) = (1000.0 * std::f64::consts::PI / 30.0, 50.0);
    }
    let demand = simulate(&scene, &Settings::default()).unwrap().demand.unwrap();
    let needed = demand.required_friction.unwrap();
    assert!(demand.by_bisection && demand.contact_margin < 0.0);
    assert!((0.10..0.11).contains(&needed), "{needed}");
    for (factor, sticks) in [(1.001, true), (0.999, false)] {
        let friction = &mut scene.clutch.friction;
        (friction.static_, friction.kinetic) = (factor * needed, friction.kinetic.min(factor * needed));
        let verdict = simulate(&scene, &Settings::default()).unwrap().verdict;
        assert_eq!(verdict == Some(Verdict::Sticks), sticks, "{factor}: {verdict:?}");
    }
    // Where the excitation itself pulls the contact open, none does.
    let open = simulate(&self::scene("high-10-damped"), &Settings::default()).unwrap().demand.unwrap();
    assert!(open.by_bisection && open.required_friction.is_none() && open.slip_margin.is_none());
}

/// "slip in initial engagement lasts only half thousandth of a second ... and has little effect on the torque" (3).
#[test]
fn the_initial_slip_lasts_half_a_millisecond_where_the_spring_is_weak() {
    let run = |name: &str| simulate(&scene(name), &Settings { samples: 2, ..Settings::default() }).unwrap();
    let [table_1, weak, hard] = ["engagement", "engagement-weak-spring", "engagement-hard"].map(run);
    let slip = |s: &sprag_design::scenario::Simulation| s.initial_slip_s().unwrap() * 1e3;
    println!("initial slip {} / {} / {} ms", slip(&table_1), slip(&weak), slip(&hard));
    assert_eq!(slip(&table_1), 0.0, "Table 1's spring holds at once");
    assert!((0.4..0.6).contains(&slip(&weak)), "{}", slip(&weak));
    assert!((0.05..0.2).contains(&slip(&hard)), "{}", slip(&hard));
    // A part of all slip, and of the time to the stick: contact is lost for 0.03 ms on the way.
    for s in [&table_1, &weak, &hard] {
        let waited = s.first_hold.unwrap().t_s - s.engaged.unwrap().t_s;
        assert!(slip(s) <= 1e3 * s.inner.time_s + 1e-9 && slip(s) <= 1e3 * waited + 1e-9);
    }
    let change = weak.peaks.normal_max_n / table_1.peaks.normal_max_n - 1.0;
    println!("largest force {:.3} % higher", 100.0 * change);
    assert!(change.abs() < 0.005, "little effect: {change}");
}

/// A stick from which the contact slips on while the load builds up has not ended the initial slip; what slips after a bounce
/// off the stop does not belong to it.
#[test]
fn the_initial_slip_ends_with_the_stick_that_carries_the_load_to_its_peak() {
    let with = |reversing: f64, drag: f64| {
        let mut scene = scene("engagement");
        scene.clutch.spring.drag_torque_nm = drag;
        if let ScenarioKind::Engagement { reversing_torque_nm, .. } = &mut scene.kind {
            *reversing_torque_nm = reversing;
        }
        simulate(&scene, &Settings::default()).unwrap()
    };
    // Sticks at once for 0.03 ms, then slips.
    let moment = with(20.0, 0.00508);
    assert!(moment.first_hold.unwrap().t_s - moment.engaged.unwrap().t_s > 1e-4);
    assert_eq!(moment.initial_slip_s(), Some(moment.inner.time_s));
    // Holds for 10 ms, bounces, holds a larger load later.
    let bounced = with(20.0, 0.001);
    let [initial, all] = [bounced.initial_slip_s().unwrap(), bounced.inner.time_s];
    assert!((3.5e-3..3.6e-3).contains(&initial) && all > 4e-3, "{initial} of {all}");
    assert!(bounced.peaks.at_s[3] > bounced.first_hold.unwrap().t_s + 10e-3);
}

/// "T_bi is always larger than T_be during engagement" (2.2): true of the forces and of the friction asked for as
/// long as both contacts stick; where the inner contact slips, near N = 0, B is at times asked for more than A.
#[test]
fn the_inner_contact_asks_for_more_friction_while_both_stick() {
    let multi = Design::read(Path::new("designs/huang2017-multi-arc.toml")).unwrap();
    let settings = Settings { samples: 3001, ..Settings::default() };
    let mut more_outside = 0;
    for name in ["high-6", "high-10", "low-6", "low-10", "low-10-mu082", "rated-45"] {
        let s = simulate(multi.scenario(name).unwrap(), &settings).unwrap();
        let mut stuck = 0;
        for x in s.samples.iter().filter(|x| matches!(x.mode.place, Place::Arc(_)) && x.forces.n_bi > 1.0) {
            let f = &x.forces;
            let (inner, outer) = (f.t_bi.abs() / f.n_bi, f.t_be.abs() / f.n_be);
            if x.mode.inner == Grip::Stick && x.mode.outer == Grip::Stick && f.n_bi > 0.1 * s.static_normal_n
            {
                assert!(inner > outer && f.t_bi > f.t_be, "{name} at {} s: {inner} {outer}", x.t);
                stuck += 1;
            }
            more_outside += usize::from(outer > inner);
        }
        assert!(stuck > 2000, "{name}: {stuck}");
    }
    println!("samples with more friction outside: {more_outside}");
}

/// The rolling run of a scene that first overruns begins where it engages, and so does the torque in it.
#[test]
fn a_demand_after_an_overrun_keeps_the_time_of_the_history() {
    let mut late = scene("speed-ramp");
    late.speed_history = None;
    late.clutch.friction = scene("in-and-out").clutch.friction;
    if let ScenarioKind::Transient { duration_s, overrun_rad_s, .. } = &mut late.kind {
        (*duration_s, *overrun_rad_s) = (0.3, 5.0);
    }
    // The overrun ends under 1 Nm long before the rise to 20 Nm, so the largest forces of both runs are its.
    late.torque_history = Some(vec![[0.0, 1.0], [0.2, 1.0], [0.25, 20.0], [0.3, 20.0]]);
    let s = simulate(&late, &Settings { samples: 2, ..Settings::default() }).unwrap();
    let engaged = s.engaged.unwrap().t_s;
    assert!(engaged > 1e-3 && engaged < 0.1, "{engaged}");
    let rolled = s.demand.unwrap().normal_max_n[0];
    assert!((rolled / s.peaks.normal_max_n - 1.0).abs() < 1e-3, "{rolled} {}", s.peaks.normal_max_n);
    assert!(s.peaks.at_s[3] > 0.2);
}
