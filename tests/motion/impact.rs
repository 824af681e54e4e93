//! The touch of sprags between races that run towards one another, against a one-dimensional impact.
//!
//! Races that do not slip past the sprags have one degree of freedom, the windup W: J W'' = -C(W) - (damping). Without damping the blow ends where
//! int C dW = J w^2/2. With Hunt and Crossley's, a force f(x)(1 + c x') on a mass, v dv/dx = -f(x)(1 + c v)/m is separable: on the
//! way in and out
//!
//!   c v_1 - ln(1 + c v_1) = -c v_2 - ln(1 - c v_2),
//!
//! whatever f is (v_1 in, v_2 out; to first order v_2/v_1 = 1 - (2/3) c v_1).
use sprag_design::clutch::Clutch;
use sprag_design::design::Design;
use sprag_design::dynamics::{Grip, Loads, Mode, Model, Place, Run, RunSettings, Stop, run};
use sprag_design::wedge::WedgeCurve;

fn clutch(damping_s_per_m: f64) -> Clutch {
    let text = include_str!("../../designs/huang2017-single-arc.toml");
    let mut clutch = Design::parse(text, "single.toml").unwrap().clutch;
    clutch.races.viscous_damping_nm_s_per_rad = 0.0;
    clutch.races.outer_inertia_kg_m2 = 1e9;
    // The drive: so heavy that sprags weigh nothing beside it; and friction that holds at touch.
    clutch.races.inner_inertia_kg_m2 = 1.0;
    clutch.friction.static_ = 1.0;
    clutch.friction.kinetic = 1.0;
    clutch.spring.stiffness_nm_per_rad = 0.0;
    clutch.hunt_crossley_s_per_m = damping_s_per_m;
    clutch
}

/// The inner race comes at `speed_rad_s` from first contact on; the run, in which nothing slips, the speed at which the sprags are back at
/// first contact, and the model.
fn blow(clutch: &Clutch, speed_rad_s: f64) -> (Run, f64, Model) {
    let curve = WedgeCurve::build(clutch, &clutch.profile().unwrap(), 0.0).unwrap();
    let loads = Loads { inner_nm: 0.0, amplitude_nm: 0.0, omega_rad_s: 0.0, abutment_nm_per_rad: 0.0 };
    let model = Model::new(clutch, curve, loads, 0.1449, 0.0);
    let mut state = [0.0; 10];
    state[0] = 1e-9;
    state[6] = -speed_rad_s;
    let mode = Mode { place: Place::Arc(0), inner: Grip::Stick, outer: Grip::Stick };
    let settings = RunSettings {
        tolerance: 1e-10,
        duration_s: 0.2,
        longest_step_s: 1e-4,
        samples: 200_001,
        // Held by tension below first contact, where there is no damping: speed is largest when it passes.
        rolling: true,
        ..RunSettings::default()
    };
    let run = run(&model, state, mode, &settings);
    let back = run.samples.windows(2).find(|s| s[0].state[0] > 0.0 && s[1].state[0] <= 0.0).unwrap();
    let speed = back[0].state[6].max(back[1].state[6]);
    (run, speed, model)
}

/// The largest torque of an impact without loss is that which its energy winds up.
#[test]
fn the_peak_of_an_elastic_blow_is_its_energys() {
    for speed in [0.2, 2.0, 5.0] {
        let clutch = clutch(0.0);
        let (run, back, model) = blow(&clutch, speed);
        let most = model.curve.at_normal(run.peaks.normal_max_n).unwrap();
        // int C dW by Simpson's rule over the windup, from points of the static curve alone: torque = u^2 makes it smooth enough.
        let parts = 4000;
        let mut work_j = 0.0;
        let point = |i: usize| {
            let nm = most.torque_nm * (i as f64 / f64::from(parts)).powi(2);
            if i == 0 {
                [0.0, 0.0]
            } else {
                model.curve.at_torque(nm).map(|p| [p.torque_nm, p.windup_rad]).unwrap()
            }
        };
        for i in 0..parts as usize {
            let ([c0, w0], [c1, w1]) = (point(i), point(i + 1));
            work_j += 0.5 * (c0 + c1) * (w1 - w0);
        }
        let energy_j = 0.5 * speed * speed;
        println!("{speed} rad/s: {} N m, {work_j} J of {energy_j} J, back at {} rad/s", most.torque_nm, back);
        assert_eq!(run.stop, Stop::Finished);
        // Sprags take part with some 1e-5 of the inertia.
        assert!((work_j / energy_j - 1.0).abs() < 1e-4, "{work_j} J of {energy_j} J");
        assert!((back / speed - 1.0).abs() < 1e-4, "back at {back} rad/s");
    }
}

/// v_2 of the formula above, pure number: in units of 1/c.
fn rebound(v: f64) -> f64 {
    let left = v - (1.0 + v).ln();
    let (mut low, mut high) = (0.0, v.min(1.0 - 1e-12));
    for _ in 0..200 {
        let out: f64 = 0.5 * (low + high);
        if -out - (1.0 - out).ln() < left { low = out } else { high = out }
    }
    0.5 * (low + high)
}

#[test]
fn a_damped_blow_rebounds_as_a_mass_on_one_damped_contact() {
    assert!((rebound(0.01) / 0.01 - (1.0 - 2.0 / 3.0 * 0.01)).abs() < 1e-4);
    let damping = 10.0;
    let clutch = clutch(damping);
    for speed in [0.05, 0.5, 2.0] {
        let (run, back, model) = blow(&clutch, speed);
        // C(1 + c g W') with g = (N_i d_i'^2 + N_e d_e'^2)/(N_i d_i' + N_e d_e'), slopes of the approaches by the windup, from closures.
        let g = |n: f64| {
            let (_, c) = model.curve.closure_at_normal(n).unwrap();
            let w = c.windup_slope();
            let [inner, outer] = [-c.lengths.oc_i.d / w, c.lengths.oc_e.d / w];
            (n * inner * inner + c.n_be.v * outer * outer) / (n * inner + c.n_be.v * outer)
        };
        let most = run.peaks.normal_max_n;
        // g varies along the windup: the blow lies between those of its extremes.
        let list: Vec<f64> = (1..=200).map(|i| g(most * f64::from(i) / 200.0)).chain([g(1e-3)]).collect();
        let [low, high] =
            [list.iter().copied().fold(f64::INFINITY, f64::min), list.iter().copied().fold(0.0, f64::max)];
        let ratio = |g: f64| rebound(damping * g * speed) / (damping * g * speed);
        let found = back / speed;
        println!("{speed} rad/s: rebound {found}, between {} and {}", ratio(high), ratio(low));
        assert_eq!(run.stop, Stop::Finished);
        assert!(
            found < ratio(low) + 1e-4 && found > ratio(high) - 1e-4,
            "{found} of {} to {}",
            ratio(high),
            ratio(low)
        );
        assert!(high < 1.2 * low, "the formula says nothing");
        assert!(found < 1.0 - 1e-4, "no loss");
    }
}
