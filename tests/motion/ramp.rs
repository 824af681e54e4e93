//! A drive that runs up through its torsional resonance: against a linear two-mass chain, and later and lower the faster it goes.

use sprag_design::design::Design;
use sprag_design::scenario::{Settings, prepare, simulate};
use std::f64::consts::TAU;

const FILE: &str = "designs/huang2017-multi-arc.toml";
/// What turns rigidly with each race beside its own 1.41e-3, kg m^2.
const MORE: f64 = 0.01;
const RACE: f64 = 1.41e-3;
const ORDER: f64 = 2.0;
const AMPLITUDE_NM: f64 = 0.05;
const CARRIED_NM: f64 = 20.0;

/// The drive from rest with the acceleration of `net_nm` on all of it, the clutch carrying 20 Nm in the mean.
fn run_up(net_nm: f64, duration_s: f64) -> Design {
    let text = std::fs::read_to_string(FILE).unwrap();
    // With next to no spring, which presses as much as 0.017 Nm more would.
    let clutch = text.split("\n[limits]").next().unwrap();
    let clutch = clutch
        .replace("stiffness_nm_per_rad = 0.01 ", "stiffness_nm_per_rad = 1e-5 ")
        .replace("drag_torque_nm = 0.0166", "drag_torque_nm = 1e-5");
    // Half of what accelerates goes through the clutch.
    let [engine_nm, load_nm] = [CARRIED_NM + 0.5 * net_nm, 0.5 * net_nm - CARRIED_NM];
    let train = |name: &str, to: &str, torque_nm: f64, orders: &str| {
        format!(
            "[[drivetrain]]\nname = \"{name}\"\nto = \"{to}\"\ninertia_kg_m2 = {MORE}\ntorque_nm = {torque_nm:?}\n{orders}\n"
        )
    };
    let orders = format!("orders = [ {{ order = {ORDER:?}, amplitude_nm = {AMPLITUDE_NM:?} }} ]");
    let scene = format!("[[scenarios]]\nname = \"up\"\nkind = \"transient\"\nduration_s = {duration_s:?}\n");
    let rest = train("engine", "outer-race", engine_nm, &orders) + &train("load", "inner-race", load_nm, "");
    Design::parse(&format!("{clutch}\n{rest}\n{scene}"), "up.toml").unwrap_or_else(|e| panic!("{e}"))
}

/// Largest torque of the clutch above its mean, N m, and the frequency of the order then, Hz, of a spring and a damper between two
/// masses under the same torque: Runge and Kutta, 4000 steps a second times ten.
fn chain(net_nm: f64, duration_s: f64, stiffness: f64, damping: f64) -> (f64, f64) {
    let mass = RACE + MORE;
    let turning = net_nm / (2.0 * mass);
    let reduced = 0.5 * mass;
    let rate = |t: f64, [w, v]: [f64; 2]| {
        let force = 0.5 * AMPLITUDE_NM * (ORDER * 0.5 * turning * t * t).sin();
        [v, (force - damping * v - stiffness * w) / reduced]
    };
    let steps = (40_000.0 * duration_s) as u32;
    let h = duration_s / f64::from(steps);
    let (mut y, mut most) = ([0.0; 2], (0.0, 0.0));
    for k in 0..steps {
        let t = f64::from(k) * h;
        let on = |k: [f64; 2], h: f64| [y[0] + h * k[0], y[1] + h * k[1]];
        let a = rate(t, y);
        let b = rate(t + 0.5 * h, on(a, 0.5 * h));
        let c = rate(t + 0.5 * h, on(b, 0.5 * h));
        let d = rate(t + h, on(c, h));
        y = [0, 1].map(|i| y[i] + h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]));
        if stiffness * y[0] > most.0 {
            most = (stiffness * y[0], ORDER * turning * (t + h) / TAU);
        }
    }
    most
}

#[test]
fn a_run_up_meets_its_resonance_late_and_low() {
    let mut met = Vec::new();
    // Slow, three times as fast, nine times.
    for net_nm in [2.0, 6.0, 18.0] {
        let turning = net_nm / (2.0 * (RACE + MORE));
        // Well past the resonance, some 60 Hz.
        let duration_s = 90.0 * TAU / ORDER / turning;
        let design = run_up(net_nm, duration_s);
        let scene = design.scenario("up").unwrap();
        let prepared = prepare(scene).unwrap();
        let curve = &prepared.model.curve;
        let stiffness = curve.at_torque(CARRIED_NM).unwrap().k_tangent_nm_per_rad;
        let damping = design.clutch.races.viscous_damping_nm_s_per_rad;
        let found = simulate(scene, &Settings::default()).unwrap();
        let peaks = found.peaks;
        let torque = curve.at_normal(peaks.normal_max_n).unwrap().torque_nm;
        let at_hz = ORDER * turning * peaks.at_s[3] / TAU;
        let (expected, expected_hz) = chain(net_nm, duration_s, stiffness, damping);
        let steady = 0.5 * AMPLITUDE_NM / (damping / (stiffness * 0.5 * (RACE + MORE)).sqrt());
        println!(
            "{net_nm} Nm: {:.4} Nm at {at_hz:.2} Hz; chain {expected:.4} Nm at {expected_hz:.2} Hz; steady {steady:.4} Nm at {:.2} Hz",
            torque - CARRIED_NM,
            (stiffness / (0.5 * (RACE + MORE))).sqrt() / TAU
        );
        met.push([torque - CARRIED_NM, at_hz, expected, expected_hz, steady]);
    }
    for [found, at_hz, expected, expected_hz, steady] in &met {
        assert!((found / expected - 1.0).abs() < 0.01, "{met:?}");
        assert!((at_hz / expected_hz - 1.0).abs() < 2e-3, "{met:?}");
        assert!(found < steady, "{met:?}");
    }
    for pair in met.windows(2) {
        assert!(pair[1][0] < 0.9 * pair[0][0] && pair[1][1] > pair[0][1], "{met:?}");
    }
}
