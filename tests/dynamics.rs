//! Dynamics of the paper's scenes.
mod common;

use sprag_design::design::Clutch;
use sprag_design::dynamics::*;
use sprag_design::wedge::WedgeCurve;

fn model(
    arcs: &[(f64, f64)],
    preload: f64,
    amplitude: f64,
    rpm: f64,
    change: impl Fn(&mut Clutch),
) -> (Model, State, Place) {
    let (mut clutch, profile) = common::clutch(arcs);
    change(&mut clutch);
    let speed = rpm * std::f64::consts::PI / 30.0;
    let rest = WedgeCurve::build(&clutch, &profile, 0.0).unwrap();
    let alpha_max = alpha_max_rad(&clutch, &rest);
    let curve = WedgeCurve::build(&clutch, &profile, speed).unwrap();
    let loads = Loads {
        inner_nm: -preload,
        amplitude_nm: amplitude,
        omega_rad_s: 200.0 * std::f64::consts::PI,
        abutment_nm_per_rad: 5000.0,
    };
    let model = Model::new(&clutch, curve, loads, alpha_max, 0.0);
    let (state, place) = preloaded(&model, preload).unwrap();
    (model, state, place)
}

fn settings(tolerance: f64) -> RunSettings {
    RunSettings {
        tolerance,
        duration_s: 0.3,
        longest_step_s: 5e-4,
        most_events: 100_000,
        most_steps: 10_000_000,
        samples: 0,
        rolling: false,
    }
}

const STUCK: (Grip, Grip) = (Grip::Stick, Grip::Stick);

#[test]
fn three_scenes() {
    for (preload, amp, mu) in [
        (3.34, 6.0, 0.12),
        (3.34, 8.0, 0.12),
        (3.34, 10.0, 0.12),
        (16.8, 6.0, 0.12),
        (16.8, 8.0, 0.12),
        (16.8, 10.0, 0.12),
        (16.8, 6.0, 0.082),
        (16.8, 8.0, 0.082),
        (16.8, 10.0, 0.082),
    ] {
        let (model, state, place) = model(&common::MULTI, preload, amp, 0.0, |c| {
            if mu < 0.1 {
                c.friction.static_ = mu;
                c.friction.kinetic = mu;
            }
        });
        let r = rolling(&model, state, place, &settings(1e-9));
        println!(
            "rolling {preload} {amp}: mu_req {:?} outer {:.5} Nmin {:.3} {:?} rhs {}",
            r.required_friction, r.required_outer, r.normal_min_n, r.stop, r.run.counters.rhs_evaluations
        );
        for tol in [1e-7, 1e-8, 1e-9, 1e-10, 1e-11] {
            let t0 = std::time::Instant::now();
            let run = run(&model, state, Mode { place, inner: STUCK.0, outer: STUCK.1 }, &settings(tol));
            println!(
                "{preload} {amp} {mu} tol {tol:e}: {:?} t {:.6} theta_bi {:.9} slipA {:.4e} s {:.3e}/{:.3e} m slipB {:.3e} open {:.2e} Nmin {:.4} tan {:.6} events {} steps {} rej {} rhs {} {:?}",
                run.stop,
                run.t_s,
                run.state[2],
                run.inner.time_s,
                run.inner.distance_m,
                run.inner.net_m,
                run.outer.time_s,
                run.open_s,
                run.peaks.normal_min_n,
                run.peaks.tan_inner,
                run.events,
                run.counters.steps,
                run.counters.rejections,
                run.counters.rhs_evaluations,
                t0.elapsed()
            );
        }
    }
}

#[test]
fn published_scheme() {
    for (preload, amp) in [(3.34, 6.0), (3.34, 10.0)] {
        let (model, state, _) = model(&common::MULTI, preload, amp, 0.0, |_| {});
        for band in [1e-3, 1e-4, 1e-5] {
            for h in [1e-5, 2e-6, 5e-7] {
                let p = published(&model, state, 0.3, h, band);
                println!(
                    "published {amp} Nm D_V {band:e} dt {h:e}: {:.5} finished {} slip {:.2e}",
                    p.state[2], p.finished, p.slip_inner_s
                );
            }
        }
    }
}
