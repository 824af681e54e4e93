//! Statics against independent tables and exact identities.
use sprag_design::clutch::{Clutch, ContactLaw, StressState};
use sprag_design::profile::Profile;
use sprag_design::wedge::WedgeCurve;

fn curve(arcs: &[(f64, f64)], speed: f64, change: impl Fn(&mut Clutch)) -> WedgeCurve {
    let (mut clutch, profile) = crate::common::clutch(arcs);
    change(&mut clutch);
    WedgeCurve::build(&clutch, &profile, speed).unwrap()
}

/// Literature: two independent scripts, tables good to about 1e-5 (sources in tests/reference/README.md).
fn against(table: &str, arcs: &[(f64, f64)]) {
    let curve = curve(arcs, 0.0, |_| {});
    let mut worst: f64 = 0.0;
    for line in table.lines().skip(1) {
        let want: Vec<f64> = line.split(',').map(|f| f.trim().parse().unwrap()).collect();
        let p = curve.at_torque(want[0]).unwrap();
        let got = [
            p.torque_nm,
            p.normal_inner_n,
            p.normal_outer_n,
            p.tan_omega,
            p.tan_nu,
            p.alpha_rad,
            p.windup_rad.to_degrees(),
            p.k_secant_nm_per_rad,
            p.k_tangent_nm_per_rad,
            p.contact_turn_rad,
            p.arc as f64 + 1.0,
            p.approach_inner_m * 1e6,
        ];
        for (column, (g, w)) in got.iter().zip(&want).enumerate() {
            let error = (g / w - 1.0).abs();
            worst = worst.max(error);
            assert!(error < 1e-4, "{} Nm, column {column}: {g} against {w} ({error:.1e})", want[0]);
        }
    }
    println!("largest relative difference {worst:.2e}");
}

#[test]
fn single_arc_table() {
    against(include_str!("../reference/static_single_arc.csv"), &crate::common::SINGLE);
}

#[test]
fn multi_arc_table() {
    against(include_str!("../reference/static_multi_arc.csv"), &crate::common::MULTI);
}

#[test]
fn torque_and_windup_do_not_know_the_centroid() {
    let base = curve(&crate::common::MULTI, 0.0, |_| {});
    for centroid in [[0.0, 0.0], [-2e-3, 1e-3], [1.5e-3, -3e-3]] {
        let other = curve(&crate::common::MULTI, 0.0, |c| c.sprags.centroid_m = centroid);
        for torque in [0.1, 3.34, 16.8, 26.8, 50.0, 100.0] {
            let (a, b) = (base.at_torque(torque).unwrap(), other.at_torque(torque).unwrap());
            assert!((a.normal_inner_n / b.normal_inner_n - 1.0).abs() < 1e-10);
            assert!((a.windup_rad / b.windup_rad - 1.0).abs() < 1e-10, "{torque} Nm {centroid:?}");
        }
    }
}

/// C dtheta = n_s (N_bi d delta_i + N_be d delta_e) at rest; with a mean speed
/// C_Omega (rho_i + rho_e)/n_s = N_bi delta_i' + N_be delta_e' - F_c OC_g' (per d alpha). Contacts that give along the
/// tracks add T_bi s_i' + T_be s_e', a force that stands ahead of its contact point the work of its moment on the turn.
#[test]
fn energy_identity_at_rest_and_at_speed() {
    let laws = [
        ContactLaw::Roller { coefficient: 3.944e-5 },
        ContactLaw::Din26281,
        ContactLaw::Hertz,
        ContactLaw::Elastic { state: StressState::Layer },
        ContactLaw::Slice { coefficient: 3.944e-5 },
    ];
    for law in laws {
        for rpm in [0.0, 5000.0, 20_000.0] {
            let speed = rpm * std::f64::consts::PI / 30.0;
            let curve = curve(&crate::common::MULTI, speed, |c| c.contact = law);
            for n in [1e-3, 1.0, 30.0, 100.0, 900.0, 1500.0, 2000.0, 2700.0, 6000.0] {
                let (_, c) = curve.closure_at_normal(n).unwrap();
                let (rho_i, rho_e) = c.rolling_ratios();
                let d = &c.deformations;
                let inner = d.race_inner.d + 0.5 * d.body.d + d.contact_inner.d + d.bulk.d;
                let outer = d.race_outer.d + 0.5 * d.body.d + d.contact_outer.d;
                let f_c = 1.8e-3 * c.oc_g.v * speed * speed;
                let along = c.t_bi.v * c.give_m_per_n[0] + c.t_be.v * c.give_m_per_n[1];
                // A force that stands ahead of its contact point, against the line to the centre of the arc.
                let (sin, cos) = (c.force_ahead_m / c.lengths.oa.v).sin_cos();
                let across = c.n_bi * cos + c.t_bi.v * sin;
                let turns = c.n_bi * sin - c.t_bi.v * cos + c.t_bi.v;
                let turning = turns * c.lengths.oc_i.v * (c.rotation.d - c.beta.d);
                let work = across * inner + c.n_be.v * outer + turning + along - f_c * c.oc_g.d;
                let torque = c.torque_nm(12).v * (rho_i + rho_e) / 12.0 * c.alpha.d;
                let scale = work.abs().max(c.n_bi * inner);
                assert!((work - torque).abs() < 1e-8 * scale, "{law:?} {rpm} rpm {n} N: {work:e} {torque:e}");
                // Rolling about C_e, without the centroid, gives the same windup.
                let rolled = (rho_i + rho_e) * c.alpha.d;
                assert!((rolled / c.windup_slope() - 1.0).abs() < 1e-8, "{law:?} {rpm} rpm {n} N");
            }
        }
    }
}

/// (A.8) as printed keeps only h_i N_bi; with - h_e N_be it is (13a) at rest and equals n_s T_bi OA.
#[test]
fn printed_and_corrected_a8() {
    let mut printed = Vec::new();
    for centroid in [[0.1935e-3, 0.5288e-3], [-1e-3, 0.3e-3]] {
        let curve = curve(&crate::common::SINGLE, 0.0, |c| c.sprags.centroid_m = centroid);
        let (_, c) = curve.closure_at_torque(16.8).unwrap();
        let l = sprag_design::kinematics::levers(
            c.lengths.oa.v,
            c.lengths.ob.v,
            c.oc_g.v,
            c.beta.v + c.gamma.v,
            c.gamma.v,
        );
        let arms = l.b_e / c.lengths.ob.v + l.b_i / c.lengths.oa.v;
        let corrected = 12.0 * (l.h_i * c.n_bi - l.h_e * c.n_be.v) / arms;
        assert!((corrected / 16.8 - 1.0).abs() < 1e-12, "{corrected}");
        printed.push(12.0 * l.h_i * c.n_bi / arms);
    }
    assert!(
        (printed[0] / printed[1] - 1.0).abs() > 0.5,
        "the printed torque depends on the centroid: {printed:?}"
    );
}

/// MODEL: demanded tan omega at N = 100 N at 0, 5000, 20 000 rpm, and first contact at 20 000 rpm.
#[test]
fn speed_changes_the_demand() {
    for (rpm, want) in [(0.0, 0.0780), (5000.0, 0.0803), (20_000.0, 0.1152)] {
        let curve = curve(&crate::common::SINGLE, rpm * std::f64::consts::PI / 30.0, |_| {});
        let (_, c) = curve.closure_at_normal(100.0).unwrap();
        assert!((c.t_bi.v / c.n_bi - want).abs() < 6e-5, "{rpm}: {}", c.t_bi.v / c.n_bi);
        if rpm == 20_000.0 {
            let touch = curve.touch();
            assert!((curve.first_contact_rad() - 0.00678).abs() < 5e-6, "{}", curve.first_contact_rad());
            assert!((touch.deformations.growth_m - 2.06e-6).abs() < 5e-9);
            assert!((touch.n_be.v - 121.0).abs() < 0.5, "{}", touch.n_be.v);
        }
    }
}

/// The tabulated curve equals the exact equilibrium, values and slopes, down to N -> 0.
#[test]
fn the_tabulated_curve_is_the_exact_one() {
    for (law, tolerance) in [
        (ContactLaw::Roller { coefficient: 3.944e-5 }, 1e-10),
        (ContactLaw::Slice { coefficient: 3.944e-5 }, 1e-9),
        (ContactLaw::Hertz, 1e-7),
        (ContactLaw::Elastic { state: StressState::Layer }, 1e-7),
    ] {
        for rpm in [0.0, 12_000.0] {
            let speed = rpm * std::f64::consts::PI / 30.0;
            let curve = curve(&crate::common::MULTI, speed, |c| c.contact = law);
            println!("{law:?} {rpm} rpm truncation {:.1e}", curve.truncation());
            for i in 0..200 {
                let n = 1e-3 * (6e6f64).powf(i as f64 / 199.0);
                let (k, c) = curve.closure_at_normal(n).unwrap();
                let p = curve.in_arc(k, c.alpha.v);
                // alpha carries some 5e-15 of rounding (OC_i - OC_e is 25 times smaller than either); what that
                // means for N is granted.
                let granted = tolerance * n + 1e-14 / c.alpha.d;
                assert!((p.n_bi - n).abs() < granted, "{law:?} {rpm} {n}: {:e}", (p.n_bi - n) / n);
                let (rho_i, rho_e) = c.rolling_ratios();
                assert!(
                    (p.rho_i - rho_i).abs() < tolerance && (p.rho_e - rho_e).abs() < tolerance,
                    "{law:?} {n}"
                );
                assert!((p.t_static - c.t_bi.v).abs() < granted + 1e-12 * c.t_bi.v.abs());
                // slopes of rho against a difference of exact closures
                let h = 1e-4 * n;
                let side = |m: f64| curve.statics().closure(k, m, speed, 0.0).unwrap();
                let (a, b) = (side(n - h), side(n + h));
                let slope = (b.rolling_ratios().0 - a.rolling_ratios().0) / (2.0 * h) / c.alpha.d;
                assert!(
                    (p.rho_i_slope / slope - 1.0).abs() < 1e-4,
                    "{law:?} {rpm} {n}: rho_i' {} against {slope}",
                    p.rho_i_slope
                );
            }
        }
    }
}

/// Junctions: the paper's Figure 5 taken step by step gives the curve, whatever the step.
/// The open sprag is a rigid body: its centroid turns about C_e, at OC_e from O, and gamma, OC_g and their slopes follow.
#[test]
fn the_open_sprag_turns_about_the_centre_of_its_outer_arc() {
    let curve = curve(&crate::common::MULTI, 0.0, |_| {});
    let statics = curve.statics();
    let ([gx, gy], touch) = (statics.centroid_m(), curve.touch());
    assert!(gx.hypot(gy) > 1e-5, "a centroid off the centre: {}", gx.hypot(gy));
    for alpha in [0.0, -1e-3, -0.1, -0.4] {
        let p = curve.open(alpha);
        let turned = alpha + statics.gamma0_rad() - p.gamma;
        let (s, c) = turned.sin_cos();
        let (x, y) = (gx * c + gy * s, touch.lengths.oc_e.v + gy * c - gx * s);
        assert!((p.oc_g - x.hypot(y)).abs() < 1e-16, "{alpha}: {} {}", p.oc_g, x.hypot(y));
        assert!((p.gamma + x.atan2(y)).abs() < 1e-15, "{alpha}: {} {}", p.gamma, x.atan2(y));
        let (a, b, h) = (curve.open(alpha - 1e-5), curve.open(alpha + 1e-5), 2e-5);
        assert!(((b.oc_g - a.oc_g) / h - p.oc_g_slope).abs() < 1e-11);
        assert!(((b.rho_e - a.rho_e) / h - p.rho_e_slope).abs() < 1e-9 * p.rho_e_slope.abs().max(1.0));
        assert_eq!((p.n_bi, p.windup), (0.0, 0.0));
    }
}

#[test]
fn figure_five_step_by_step_is_the_closed_march() {
    for law in [ContactLaw::Roller { coefficient: 3.944e-5 }, ContactLaw::Hertz] {
        let curve = curve(&crate::common::MULTI, 0.0, |c| c.contact = law);
        let statics = curve.statics();
        let beta0 = statics.profile.beta0_rad;
        let at_alpha = |k: usize, shift: f64, alpha: f64| {
            let mut n = 1000.0;
            for _ in 0..100 {
                let c = statics.closure(k, n, 0.0, shift).unwrap();
                n = (n + (alpha - c.alpha.v) / c.alpha.d).max(1e-3);
            }
            statics.closure(k, n, 0.0, shift).unwrap()
        };
        for steps in [7, 40] {
            let (mut k, mut shift) = (0, 0.0);
            for i in 1..=steps {
                let alpha = 0.25 * i as f64 / steps as f64;
                let mut c = at_alpha(k, shift, alpha);
                while k < 2 && c.turn_rad(beta0) > statics.profile.arcs[k].until_rad {
                    // force at the junction with the old radius ...
                    let (mut lo, mut hi) = (1e-3, c.n_bi);
                    for _ in 0..200 {
                        let mid = 0.5 * (lo + hi);
                        let turn = statics.closure(k, mid, 0.0, shift).unwrap().turn_rad(beta0);
                        if turn < statics.profile.arcs[k].until_rad { lo = mid } else { hi = mid }
                    }
                    let old = statics.closure(k, lo, 0.0, shift).unwrap();
                    // ... alpha_new at which the new radius carries it, and the rest from there.
                    let new = statics.closure(k + 1, lo, 0.0, 0.0).unwrap();
                    shift = old.alpha.v - new.alpha.v;
                    k += 1;
                    c = at_alpha(k, shift, alpha);
                }
                let n = curve.in_arc(curve.arc_at(alpha), alpha).n_bi;
                assert!((c.n_bi / n - 1.0).abs() < 1e-9, "{law:?} {alpha}: {} against {n}", c.n_bi);
            }
        }
    }
}

/// Single arc: cutting it into three equal arcs changes nothing.
#[test]
fn equal_arcs_are_one_arc() {
    let one = curve(&crate::common::SINGLE, 0.0, |_| {});
    let three = curve(&[(4.02e-3, 0.06), (4.02e-3, 0.12), (4.02e-3, 0.45)], 0.0, |_| {});
    for i in 1..=50 {
        let torque = 2.0 * i as f64;
        let (a, b) = (one.at_torque(torque).unwrap(), three.at_torque(torque).unwrap());
        // 5e-15 of rounding in alpha, see above.
        assert!((a.windup_rad - b.windup_rad).abs() < 1e-11 * a.windup_rad);
        assert!((a.alpha_rad / b.alpha_rad - 1.0).abs() < 1e-11);
    }
}

/// A profile without height left rolls over; the curve ends there with a name.
#[test]
fn roll_over_is_an_end_not_a_panic() {
    let arcs = [(4.02e-3, 3.0)];
    let (clutch, _) = crate::common::clutch(&arcs);
    let mut soft = clutch.clone();
    soft.materials.sprag.youngs_modulus_pa = 20e9;
    soft.materials.outer_race.youngs_modulus_pa = 20e9;
    soft.races.outer_outside_radius_m = 20.5e-3;
    let profile = Profile::new(4.68e-3, 0.62e-3, &arcs, 11.11e-3, 19.44e-3).unwrap();
    let curve = WedgeCurve::build(&soft, &profile, 0.0).unwrap();
    let (reason, alpha) = curve.end();
    assert_eq!(reason.name(), "rolls-over");
    let top = curve.end_torque_nm();
    assert!(alpha > 0.2 && top > 1.0);
    assert!(curve.at_torque(top * 0.999).is_some() && curve.at_torque(top * 1.001).is_none());
}

/// The patch is as wide as an arc is long: averaged, p_0 passes a junction without a jump; pointwise it jumps.
#[test]
fn pressure_passes_a_junction_without_a_jump() {
    let curve = curve(&crate::common::MULTI, 0.0, |_| {});
    for k in 0..2 {
        let n = curve.arc_end_n(k);
        let (before, after) =
            (curve.at_normal(n * (1.0 - 1e-9)).unwrap(), curve.at_normal(n * (1.0 + 1e-9)).unwrap());
        assert_ne!(before.arc, after.arc);
        assert!((before.hertz_inner_pa / after.hertz_inner_pa - 1.0).abs() < 1e-8);
        assert!((before.hertz_inner_pointwise_pa / after.hertz_inner_pointwise_pa - 1.0).abs() > 4e-3);
        assert!(before.straddles_junction && after.straddles_junction);
    }
    // Far from the junctions both are the same.
    let far = curve.at_torque(100.0).unwrap();
    assert!(!far.straddles_junction && far.hertz_inner_pa == far.hertz_inner_pointwise_pa);
}
