//! One sprag between races whose axes do not meet.

use super::common::{MULTI, SINGLE, clutch};
use super::{CARRIERS, Vector};
use sprag_design::clutch::Carrier;
use sprag_design::wedge::{Closure, WedgeCurve};

const OFFSETS: [[f64; 2]; 5] = [[0.0, 0.0], [-30e-6, 0.0], [20e-6, 0.0], [0.0, 25e-6], [-15e-6, -40e-6]];

fn curves(arcs: &[(f64, f64)]) -> Vec<(WedgeCurve, Carrier)> {
    let (clutch, profile) = clutch(arcs);
    let all = OFFSETS.iter().flat_map(|&o| CARRIERS.map(|c| (o, c)));
    all.map(|(o, c)| (WedgeCurve::build_off_centre(&clutch, &profile, o, c).unwrap(), c)).collect()
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

/// The offset as the sprag sees it.
fn offset(c: &Closure) -> Vector {
    Vector::new(c.offset_m[0].v, c.offset_m[1].v)
}

#[test]
fn forces_and_moments_balance_and_the_body_is_rigid() {
    for arcs in [&SINGLE[..], &MULTI[..]] {
        for (curve, _) in curves(arcs) {
            for n in [1e-3, 30.0, 900.0, 4000.0] {
                let (k, c) = curve.closure_at_normal(n).unwrap();
                let offset = offset(&c);
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
                // The offset has turned with its race, not grown.
                let [x, y] = curve.offset_m();
                let (s, k) = c.carried_rad.sin_cos();
                assert!((offset - Vector::new(x * k - y * s, x * s + y * k)).norm() < 1e-17);
            }
        }
    }
}

/// What the races put in is what the contacts, the body and the rings take up. Where the offset stays with the outer
/// race it is the inner race's torque about its own axis that works over the windup, and the other way round: the
/// two torques differ by the couple of the offset. Moved as well, the axis takes its part to the rigid rolling by which
/// it turns.
#[test]
fn energy_is_kept_along_a_curve_off_centre() {
    for (curve, carrier) in curves(&MULTI) {
        for n in [2.0, 200.0, 1500.0, 4000.0] {
            let (_, c) = curve.closure_at_normal(n).unwrap();
            let l = &c.lengths;
            let torque = match carrier {
                Carrier::OuterRace => c.t_bi.v * l.oa.v,
                Carrier::InnerRace => c.t_be.v * l.ob.v,
            };
            let taken = -c.n_bi * l.oc_i.d + c.n_be.v * l.oc_e.d;
            let miss = torque * c.windup_slope() / taken - 1.0;
            // The turn of the carrying race is that of rigid bodies: delta/R of offset/(R tan omega).
            let d = &c.deformations;
            let yields = d.race_inner.v + d.race_outer.v + d.contact_inner.v + d.contact_outer.v + d.body.v;
            let small = offset(&c).norm() / (11.11e-3 * 0.078) * yields / 11.11e-3;
            assert!(miss.abs() < 1e-10 + 2.0 * small, "{carrier:?} {} {n}: {miss:e} {small:e}", offset(&c));
            // The table's windup has that slope.
            let h = 1e-3 * n;
            let at = |n: f64| curve.windup_rad(curve.closure_at_normal(n).unwrap().1.alpha.v);
            let table = (at(n + h) - at(n - h)) / (2.0 * h);
            assert!((table / c.windup_slope() - 1.0).abs() < 2e-6, "{n} {}", table / c.windup_slope() - 1.0);
            // And is inverted to rounding.
            let (p, carried) = curve.at_windup(at(n)).unwrap();
            assert!((p.n_bi / n - 1.0).abs() < 1e-6 && (carried - c.carried_rad).abs() < 1e-9, "{}", p.n_bi);
        }
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
        .map(|i| {
            f(h * i as f64)
                * if i == 0 || i == steps {
                    1.0
                } else if i % 2 == 1 {
                    4.0
                } else {
                    2.0
                }
        })
        .sum();
    sum * h / 3.0
}

/// What yields under the load of a closure, m.
fn yields(c: &Closure) -> f64 {
    let d = &c.deformations;
    d.race_inner.v + d.race_outer.v + d.contact_inner.v + d.contact_outer.v + d.body.v
}

/// The force of one sprag on the inner race is minus the gradient of its energy by the place of that race, as the race
/// that carries the offset sees it, at one windup: forces from equilibrium on one side, geometry, rolling and elastic laws
/// on the other.
#[test]
fn a_sprag_pushes_with_the_gradient_of_its_energy() {
    let (clutch, profile) = clutch(&MULTI);
    for carrier in CARRIERS {
        let at = |o: [f64; 2]| WedgeCurve::build_off_centre(&clutch, &profile, o, carrier).unwrap();
        for engaged in [[0.0, 0.0], [-20e-6, 10e-6], [10e-6, -40e-6]] {
            let here = at(engaged);
            let touch = |c: &WedgeCurve| c.statics().touch_windup_rad(c.offset_m()).unwrap();
            let mut share = Vec::new();
            for n in [300.0, 1600.0] {
                let (_, c) = here.closure_at_normal(n).unwrap();
                let windup = here.windup_rad(c.alpha.v);
                let carried = match carrier {
                    Carrier::OuterRace => 4.68 / 19.44 * c.rotation.v,
                    Carrier::InnerRace => c.carried_rad,
                };
                let force = nalgebra::Rotation2::new(-carried) * -forces(&c)[0];
                let h = 2e-7;
                let moved = |k: usize, sign: f64| {
                    let mut offset = engaged;
                    offset[k] += sign * h;
                    let there = at(offset);
                    let (p, _) = there.at_windup(windup + touch(&here) - touch(&there)).unwrap();
                    energy(&there, p.n_bi)
                };
                let slope = |k| (moved(k, 1.0) - moved(k, -1.0)) / (2.0 * h);
                let miss = (force + Vector::new(slope(0), slope(1))).norm() / n;
                println!(
                    "{carrier:?} {engaged:?} {n} N: {miss:.2e} of the force, yields/R {:.2e}",
                    yields(&c) / 11.11e-3
                );
                share.push(miss / (yields(&c) / 11.11e-3));
            }
            // Rolling on deformed radii is no exact differential: what is left is a part of delta/R, at every load.
            assert!(share.iter().all(|s| *s < 0.5), "{carrier:?} {engaged:?} {share:?}");
        }
    }
}

/// g by the strut: the race moved by dd, as the carrying race sees it, shortens it by dd along AB, the windup dW by
/// OA sin omega dW (OB sin nu dW where the inner race carries); a touching sprag stays as long. On all arcs.
#[test]
fn windup_to_touch_follows_the_strut() {
    let (clutch, profile) = clutch(&MULTI);
    for carrier in CARRIERS {
        for [d, t] in [[0.0, 0.0], [20e-6, -30e-6], [-40e-6, 0.0], [-90e-6, 20e-6]] {
            let curve = WedgeCurve::build_off_centre(&clutch, &profile, [d, t], carrier).unwrap();
            let c = curve.touch();
            let omega = c.t_ratio.atan();
            let nu = omega - c.beta.v;
            let g = |d: f64, t: f64| curve.statics().touch_windup_rad([d, t]).unwrap();
            let h = 1e-7;
            let found =
                Vector::new((g(d + h, t) - g(d - h, t)) / (2.0 * h), (g(d, t + h) - g(d, t - h)) / (2.0 * h));
            // At B: OB sin nu.
            let lever = match carrier {
                Carrier::OuterRace => 11.11e-3 * omega.sin(),
                Carrier::InnerRace => 19.44e-3 * nu.sin(),
            };
            let strut = nalgebra::Rotation2::new(-c.carried_rad) * Vector::new(nu.cos(), -nu.sin());
            let miss = (found + strut / lever).norm() * lever;
            assert!(miss < 1e-5, "{carrier:?} {d} {t}: {found} {} {miss:e}", -strut / lever);
        }
        let far = WedgeCurve::build_off_centre(&clutch, &profile, [-90e-6, 0.0], carrier).unwrap();
        assert_eq!(far.first_arc(), 2);
    }
}
