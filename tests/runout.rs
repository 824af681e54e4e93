//! Races off centre: one sprag in its own gap by vectors, energy and virtual work; the ring by balance and limits.

mod common;

use common::{MULTI, SINGLE, clutch};
use sprag_design::design::Design;
use sprag_design::margin::{LoadState, RunOut, load_margins, load_state, run_out_margins};
use sprag_design::profile::Profile;
use sprag_design::wedge::{Closure, WedgeCurve};
use std::f64::consts::TAU;

type Vector = nalgebra::Vector2<f64>;

const OFFSETS: [[f64; 2]; 5] =
    [[0.0, 0.0], [-30e-6, 0.0], [20e-6, 0.0], [0.0, 25e-6], [-15e-6, -40e-6]];

fn curves(arcs: &[(f64, f64)]) -> Vec<WedgeCurve> {
    let (clutch, profile) = clutch(arcs);
    OFFSETS.iter().map(|&o| WedgeCurve::build_off_centre(&clutch, &profile, o).unwrap()).collect()
}

/// (n_A, t_A) in the frame of C_e: x outward, y towards positive azimuth.
fn at_a(c: &Closure) -> (Vector, Vector) {
    let (s, k) = c.beta.v.sin_cos();
    (Vector::new(k, s), Vector::new(-s, k))
}

/// Forces on the sprag at A and at B.
fn forces(c: &Closure) -> [Vector; 2] {
    let (n, t) = at_a(c);
    [c.n_bi * n - c.t_bi.v * t, Vector::new(-c.n_be.v, c.t_be.v)]
}

#[test]
fn forces_and_moments_balance_and_the_body_is_rigid() {
    for arcs in [&SINGLE[..], &MULTI[..]] {
        for curve in curves(arcs) {
            let offset = Vector::from(curve.offset_m());
            for n in [1e-3, 30.0, 900.0, 4000.0] {
                let (k, c) = curve.closure_at_normal(n).unwrap();
                let (normal, _) = at_a(&c);
                let a = offset + c.lengths.oa.v * normal;
                let b = Vector::new(c.lengths.ob.v, 0.0);
                let [fa, fb] = forces(&c);
                assert!((fa + fb).norm() < 1e-11 * n, "{offset:?} {n} {}", (fa + fb).norm());
                let moment = a.perp(&fa) + b.perp(&fb);
                assert!(moment.abs() < 1e-12 * n * c.lengths.ob.v, "{offset:?} {n} {moment}");
                // The centres are as far apart as the body has them.
                let apart = offset + c.lengths.oc_i.v * normal - Vector::new(c.lengths.oc_e.v, 0.0);
                let body = curve.statics().profile.arcs[curve.first_arc() + k].centre_m.norm();
                assert!((apart.norm() / body - 1.0).abs() < 1e-11, "{offset:?} {n}");
            }
        }
    }
}

/// What the races put in is what the contacts, the body and the rings take up; the windup of the table is the
/// difference of the two rotations.
#[test]
fn energy_is_kept_along_a_curve_off_centre() {
    for curve in curves(&MULTI) {
        let [d, t] = curve.offset_m();
        let mut last: Option<(f64, f64)> = None;
        for n in [200.0, 200.5] {
            let (_, c) = curve.closure_at_normal(n).unwrap();
            let l = &c.lengths;
            let (s, k) = c.beta.v.sin_cos();
            // Velocity of the sprag's points at A and B, about C_e, per N.
            let outer = c.rotation.d * (l.ob.v - l.oc_e.v) / l.ob.v;
            let arm = l.oc_e.v * k - d * k - t * s - l.oa.v;
            let inner = (-c.rotation.d * arm - s * l.oc_e.d) / l.oa.v;
            let power = c.t_be.v * l.ob.v * outer - c.t_bi.v * l.oa.v * inner;
            let taken = -c.n_bi * l.oc_i.d + c.n_be.v * l.oc_e.d;
            assert!((power / taken - 1.0).abs() < 1e-10, "{d} {t} {}", power / taken - 1.0);
            assert!(((outer - inner) / c.windup_slope() - 1.0).abs() < 1e-12);
            if let Some((windup, slope)) = last {
                let table = (curve.windup_rad(c.alpha.v) - windup) / 0.5;
                let mean = 0.5 * (slope + c.windup_slope());
                assert!((table / mean - 1.0).abs() < 1e-6, "{}", table / mean - 1.0);
            }
            last = Some((curve.windup_rad(c.alpha.v), c.windup_slope()));
        }
        // The table is inverted to rounding.
        let (_, c) = curve.closure_at_normal(1500.0).unwrap();
        let p = curve.at_windup(curve.windup_rad(c.alpha.v)).unwrap();
        assert!((p.n_bi / 1500.0 - 1.0).abs() < 1e-9, "{}", p.n_bi);
    }
}

/// Elastic energy of one sprag at N, J: the work of N on the approaches along its curve, in N = z^10.
fn energy(curve: &WedgeCurve, n: f64) -> f64 {
    let steps = 4000;
    let top = n.powf(0.1);
    let f = |z: f64| {
        let n = z.powi(10);
        if n < 1e-100 {
            return 0.0;
        }
        let (_, c) = curve.closure_at_normal(n).unwrap();
        (-c.n_bi * c.lengths.oc_i.d + c.n_be.v * c.lengths.oc_e.d) * 10.0 * z.powi(9)
    };
    // Simpson.
    let h = top / steps as f64;
    let sum: f64 = (0..=steps)
        .map(|i| f(h * i as f64) * if i == 0 || i == steps { 1.0 } else if i % 2 == 1 { 4.0 } else { 2.0 })
        .sum();
    sum * h / 3.0
}

/// The force of one sprag on the inner race is minus the gradient of its energy by the place of that race, the races
/// not turning: forces from equilibrium on one side, geometry, rolling and elastic laws on the other.
#[test]
fn a_sprag_pushes_with_the_gradient_of_its_energy() {
    let (clutch, profile) = clutch(&MULTI);
    let at = |offset: [f64; 2]| WedgeCurve::build_off_centre(&clutch, &profile, offset).unwrap();
    for engaged in [[0.0, 0.0], [-20e-6, 10e-6]] {
        let here = at(engaged);
        let touch = |c: &WedgeCurve| c.statics().touch_windup_rad(c.offset_m()).unwrap();
        for n in [300.0, 1600.0] {
            let (_, c) = here.closure_at_normal(n).unwrap();
            let windup = here.windup_rad(c.alpha.v);
            let force = -forces(&c)[0];
            let h = 2e-7;
            let moved = |k: usize, sign: f64| {
                let mut offset = engaged;
                offset[k] += sign * h;
                let there = at(offset);
                let p = there.at_windup(windup + touch(&here) - touch(&there)).unwrap();
                energy(&there, p.n_bi)
            };
            let gradient =
                Vector::new((moved(0, 1.0) - moved(0, -1.0)) / (2.0 * h), (moved(1, 1.0) - moved(1, -1.0)) / (2.0 * h));
            let miss = force + gradient;
            println!("{engaged:?} {n}: {force:?} {gradient:?} {:e}", miss.norm() / n);
        }
    }
}

const DESIGN: &str = include_str!("../designs/huang2017-multi-arc.toml");

fn off_centre(keys: &str) -> (Design, LoadState) {
    let text = DESIGN.replacen(
        "width_mm = 6.0      ",
        &format!("eccentricity = {{ {keys} }}\nwidth_mm = 6.0      "),
        1,
    );
    let design = Design::parse(&text, "off-centre.toml").unwrap_or_else(|e| panic!("{e}"));
    let state = load_state(&design).unwrap();
    (design, state)
}

#[test]
fn look() {
    for keys in [
        "offset_mm = 0.0",
        "offset_mm = 0.01",
        "offset_mm = 0.02",
        "offset_mm = 0.02, bearing_stiffness_n_per_um = 0",
        "offset_mm = 0.02, bearing_stiffness_n_per_um = 100",
        "offset_mm = 0.01, turning = true",
        "offset_mm = 0.01, turning = true, bearing_stiffness_n_per_um = 0",
    ] {
        let (design, state) = off_centre(keys);
        let start = std::time::Instant::now();
        let ring = RunOut::new(&design, &state).unwrap();
        let built = start.elapsed();
        println!("== {keys}: built {built:?}; end {:?}", ring.end());
        for torque in [1.0, 16.8, 90.0] {
            match ring.survey(torque) {
                Ok(s) => {
                    let r = s.worst_round();
                    let (share, who) = r.share();
                    println!(
                        "{torque} Nm: share {share:.5} at {} windup {:.5} deg radial {:.2} N unloaded {} shift {:?} um",
                        ring.words(&who),
                        r.windup_rad.to_degrees(),
                        s.radial_n(),
                        s.unloaded(),
                        r.shift_m.map(|x| x * 1e6)
                    );
                }
                Err(stop) => println!("{torque} {stop:?}"),
            }
        }
        for row in run_out_margins(&design, &design.limits, &ring, true) {
            println!("{:30} {:10.4} {:10.4} {:8.4} {:?} {}", row.code, row.demand, row.allowable, row.margin, row.torque_capacity_nm, row.name);
        }
        println!("all {:?}", start.elapsed());
        let _ = (TAU, load_margins(&design, &design.limits, false, &state).len(), std::any::type_name::<Profile>());
    }
}
