//! Junctions of the inner profile under a contact patch that is as wide as an arc is long.
mod common;

use sprag_design::design::{Clutch, ContactLaw, StressState};
use sprag_design::wedge::{InnerCurvature, StaticPoint, WedgeCurve};

const KNOW_THE_RADIUS: [ContactLaw; 3] = [
    ContactLaw::Hertz,
    ContactLaw::Elastic { state: StressState::Layer },
    ContactLaw::Slice { coefficient: 3.944e-5, slices: 30 },
];

fn clutch(law: ContactLaw) -> Clutch {
    Clutch { contact: law, ..common::clutch(&common::MULTI).0 }
}

fn curve(law: ContactLaw, rpm: f64, rule: InnerCurvature) -> WedgeCurve {
    let profile = common::clutch(&common::MULTI).1;
    let speed = rpm * std::f64::consts::PI / 30.0;
    WedgeCurve::build_with(&clutch(law), &profile, speed, rule).unwrap()
}

/// The same states just before and just after the junction at the end of arc `k`.
fn sides(curve: &WedgeCurve, k: usize) -> (StaticPoint, StaticPoint) {
    let n = curve.arc_end_n(k);
    let (a, b) = (curve.at_normal(n * (1.0 - 1e-9)).unwrap(), curve.at_normal(n * (1.0 + 1e-9)).unwrap());
    assert!(a.arc + 1 == b.arc);
    (a, b)
}

#[test]
fn no_law_shifts_alpha_at_a_junction() {
    for law in KNOW_THE_RADIUS {
        for rpm in [0.0, 12_000.0] {
            let averaged = curve(law, rpm, InnerCurvature::Patch);
            let pointwise = curve(law, rpm, InnerCurvature::Pointwise);
            for k in 0..2 {
                let (a, b) = sides(&averaged, k);
                let (c, d) = sides(&pointwise, k);
                println!(
                    "{law:?} {rpm} rpm {k}: shift {:.1e}, pointwise {:.1e} rad; delta_H jumps by {:.1e}, pointwise {:.1e}",
                    averaged.shift_rad(k + 1),
                    pointwise.shift_rad(k + 1),
                    b.approach_inner_m / a.approach_inner_m - 1.0,
                    d.approach_inner_m / c.approach_inner_m - 1.0,
                );
                assert!(averaged.shift_rad(k + 1).abs() < 1e-12, "{law:?} {rpm}");
                // What 2e-9 of force moves, and no more.
                for (before, after) in [
                    (a.approach_inner_m, b.approach_inner_m),
                    (a.hertz_inner_pa, b.hertz_inner_pa),
                    (a.alpha_rad, b.alpha_rad),
                    (a.windup_rad, b.windup_rad),
                    (a.torque_nm, b.torque_nm),
                ] {
                    assert!((after / before - 1.0).abs() < 4e-9, "{law:?} {rpm}: {before} {after}");
                }
                assert!((d.approach_inner_m / c.approach_inner_m - 1.0).abs() > 1e-5, "{law:?} {rpm}");
            }
        }
    }
}

/// The tangent stiffness jumps where the contact point passes from one radius to the next; where an edge of the patch
/// passes the junction its slope goes on.
#[test]
fn the_tangent_stiffness_has_kinks_at_the_junctions_and_nowhere_else() {
    for law in KNOW_THE_RADIUS {
        let curve = curve(law, 0.0, InnerCurvature::Patch);
        let tangent = |n: f64| curve.at_normal(n).unwrap().k_tangent_nm_per_rad;
        // Jump of the value and of the relative slope n K'/K between the two sides of `n`, extrapolated to it.
        let jumps = |n: f64, h: f64| {
            let side = |s: f64| {
                let k = [1.0, 2.0, 3.0].map(|i| tangent(n * (1.0 + s * i * h)));
                let value = 3.0 * k[0] - 3.0 * k[1] + k[2];
                let slope = s * (-2.5 * k[0] + 4.0 * k[1] - 1.5 * k[2]) / h;
                (value, slope / value)
            };
            let ((a, sa), (b, sb)) = (side(-1.0), side(1.0));
            (b / a - 1.0, sb - sa)
        };
        for s in curve.straddles() {
            let junction = curve.arc_end_n(s.junction);
            let at = [Some(s.from_n), Some(junction), s.until_n].map(|n| n.map(|n| jumps(n, 1e-4)));
            println!("{law:?}: {s:?} {junction} (value, slope) jumps {at:?}");
        }
    }
}

/// What the paper's pointwise radius costs.
#[test]
fn the_pointwise_radius_compared() {
    for law in KNOW_THE_RADIUS {
        let averaged = curve(law, 0.0, InnerCurvature::Patch);
        let pointwise = curve(law, 0.0, InnerCurvature::Pointwise);
        for torque in [3.34, 10.0, 14.0, 14.3, 16.8, 25.0, 33.0, 34.0, 50.0, 100.0] {
            let (a, p) = (averaged.at_torque(torque).unwrap(), pointwise.at_torque(torque).unwrap());
            let at_windup = averaged.at_normal(p.normal_inner_n).unwrap();
            println!(
                "{law:?} {torque} Nm: straddles {}, windup {:+.2e} relative, N {:+.2e}, delta_H {:+.2e}, torque at equal N {:+.2e}",
                a.straddles_junction,
                p.windup_rad / a.windup_rad - 1.0,
                p.normal_inner_n / a.normal_inner_n - 1.0,
                p.approach_inner_m / a.approach_inner_m - 1.0,
                p.torque_nm / at_windup.torque_nm - 1.0,
            );
        }
    }
}

#[test]
fn tables_probe() {
    for law in KNOW_THE_RADIUS {
        for rule in [InnerCurvature::Patch, InnerCurvature::Pointwise] {
            let curve = curve(law, 0.0, rule);
            let mut worst = [0.0f64; 4];
            for i in 0..4000 {
                let n = 200.0 + 1.5 * f64::from(i);
                let Some((k, c)) = curve.closure_at_normal(n) else { continue };
                let p = curve.in_arc(k, c.alpha.v);
                let (rho_i, _) = c.rolling_ratios();
                let h = 1e-5 * n;
                let side = |m: f64| curve.statics().closure(k, m, 0.0, curve.shift_rad(k)).unwrap();
                let (a, b) = (side(n - h), side(n + h));
                let slope = (b.rolling_ratios().0 - a.rolling_ratios().0) / (b.alpha.v - a.alpha.v);
                let e = [
                    p.n_bi / n - 1.0,
                    p.rho_i - rho_i,
                    p.rho_i_slope / slope - 1.0,
                    p.t_static / c.t_bi.v - 1.0,
                ];
                for (w, e) in worst.iter_mut().zip(e) {
                    *w = w.max(e.abs());
                }
            }
            println!(
                "{law:?} {rule:?}: truncation {:.1e}; N, rho, rho', T {:?}",
                curve.truncation(),
                worst.map(|w| format!("{w:.1e}"))
            );
        }
    }
}
