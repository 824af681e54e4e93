//! The modes as an integrator of others sees them: a classical Runge-Kutta scheme with bisected events, driven through
//! [`events`] and [`next_mode`] alone, comes to the angle of the tool's own run.

use sprag_design::design::Design;
use sprag_design::dynamics::{Mode, RunSettings, State, Stop, events, next_mode, run};
use sprag_design::ode::rk4;
use sprag_design::scenario::{Prepared, prepare};
use std::path::Path;

const STEP_S: f64 = 1e-6;
/// An event function that is not positive right after a change counts from here on, s.
const AFTER_S: f64 = 1e-9;

/// theta_bi at the end (rad) and the changes of mode.
fn by_hand(p: &Prepared) -> (f64, u64) {
    let (mut mode, mut y, mut t, mut begun, mut changes) = (p.mode, p.state, 0.0, 0.0, 0);
    let mut waits = events(&p.model, &mode, t, &y).map(|e| e <= 0.0);
    while t < p.duration_s {
        let h = STEP_S.min(p.duration_s - t);
        let to = |h: f64| -> State {
            let mut rhs = |t: f64, y: &State| p.model.slope(&mode, t, y).ok_or(());
            let k1 = rhs(t, &y).unwrap();
            rk4::step(&mut rhs, t, &y, &k1, h).unwrap()
        };
        let fallen = |h: f64, mode: &Mode| {
            let now = events(&p.model, mode, t + h, &to(h));
            (0..now.len()).find(|&i| now[i] < 0.0 && !(waits[i] && t + h < begun + AFTER_S))
        };
        if fallen(h, &mode).is_none() {
            (t, y) = (t + h, to(h));
            continue;
        }
        let (mut low, mut high) = (0.0, h);
        while high - low > 1e-15 {
            let middle = 0.5 * (low + high);
            if fallen(middle, &mode).is_some() { high = middle } else { low = middle }
        }
        let which = fallen(high, &mode).unwrap();
        (t, y) = (t + high, to(high));
        (mode, y) = next_mode(&p.model, &mode, which, t, &y).unwrap();
        (begun, waits) = (t, events(&p.model, &mode, t, &y).map(|e| e <= 0.0));
        changes += 1;
    }
    (y[2], changes)
}

#[test]
fn another_integrator_comes_to_the_same_angle_through_the_public_modes() {
    let design = Design::read(Path::new("designs/huang2017-multi-arc.toml")).unwrap();
    for (scene, some) in [("high-6", 0), ("low-10", 0), ("high-10", 10)] {
        let p = prepare(design.scenario(scene).unwrap()).unwrap();
        let settings = RunSettings {
            tolerance: 1e-12,
            duration_s: p.duration_s,
            longest_step_s: 5e-4,
            ..RunSettings::default()
        };
        let ours = run(&p.model, p.state, p.mode, &settings);
        let (theta, changes) = by_hand(&p);
        println!("{scene}: {theta} against {}, {changes} changes against {}", ours.state[2], ours.events);
        assert!((theta - ours.state[2]).abs() < 1e-8, "{scene}");
        assert!(changes >= some && changes == ours.events, "{scene}: {changes} {}", ours.events);
    }
}

#[test]
fn an_event_beyond_the_curve_ends_the_run_with_its_name() {
    let design = Design::read(Path::new("designs/huang2017-multi-arc.toml")).unwrap();
    let p = prepare(design.scenario("high-6").unwrap()).unwrap();
    let last = Mode { place: sprag_design::dynamics::Place::Arc(p.model.curve.arc_count() - 1), ..p.mode };
    let mut y = p.state;
    y[0] = p.model.curve.end().1;
    assert!(matches!(next_mode(&p.model, &last, 1, 0.0, &y), Err(Stop::CurveEnd)));
    assert!(events(&p.model, &p.mode, 0.0, &p.state).iter().all(|e| *e > 0.0));
}
