//! Junctions of the inner profile under a contact patch that is as wide as an arc is long.
use sprag_design::clutch::{Clutch, ContactLaw, InnerArc, StressState};
use sprag_design::profile::Profile;
use sprag_design::wedge::{InnerCurvature, StaticPoint, WedgeCurve};

const KNOW_THE_RADIUS: [ContactLaw; 3] = [
    ContactLaw::Hertz,
    ContactLaw::Elastic { state: StressState::Layer },
    ContactLaw::Slice { coefficient: 3.944e-5 },
];

/// Steps of radius that no clutch has, up and down.
const STEEP: [(f64, f64); 4] = [(4.02e-3, 0.06), (4.6e-3, 0.1), (4.3e-3, 0.15), (4.4e-3, 0.45)];

fn built(arcs: &[(f64, f64)], law: ContactLaw, rpm: f64, rule: InnerCurvature) -> WedgeCurve {
    let (clutch, profile) = crate::common::clutch(arcs);
    let speed = rpm * std::f64::consts::PI / 30.0;
    WedgeCurve::build_with(&Clutch { contact: law, ..clutch }, &profile, speed, rule).unwrap()
}

fn curve(law: ContactLaw, rule: InnerCurvature) -> WedgeCurve {
    built(&crate::common::MULTI, law, 0.0, rule)
}

/// The states just before and just after the junction at the end of arc `k`.
fn sides(curve: &WedgeCurve, k: usize) -> (StaticPoint, StaticPoint) {
    let n = curve.arc_end_n(k);
    let (a, b) = (curve.at_normal(n * (1.0 - 1e-9)).unwrap(), curve.at_normal(n * (1.0 + 1e-9)).unwrap());
    assert!(a.arc + 1 == b.arc && a.straddles_junction && b.straddles_junction);
    (a, b)
}

#[test]
fn nothing_jumps_at_a_junction_and_alpha_needs_no_shift() {
    for (arcs, step) in [(&crate::common::MULTI[..], 1e-5), (&STEEP[..], 1e-5)] {
        for law in KNOW_THE_RADIUS {
            for rpm in [0.0, 12_000.0] {
                let averaged = built(arcs, law, rpm, InnerCurvature::Patch);
                let pointwise = built(arcs, law, rpm, InnerCurvature::Pointwise);
                assert_eq!(averaged.arc_count(), arcs.len());
                for k in 0..arcs.len() - 1 {
                    let ((a, b), (c, d)) = (sides(&averaged, k), sides(&pointwise, k));
                    let jump = |before: f64, after: f64| (after / before - 1.0).abs();
                    let pointwise_jump = jump(c.approach_inner_m, d.approach_inner_m);
                    println!(
                        "{law:?} {rpm} rpm, junction {k}: shift {:.1e}, pointwise {:.1e} rad and delta_H jumps by {:.1e}",
                        averaged.shift_rad(k + 1),
                        pointwise.shift_rad(k + 1),
                        pointwise_jump,
                    );
                    assert!(averaged.shift_rad(k + 1).abs() < 1e-12, "{law:?} {rpm}");
                    // What 2e-9 of force moves, and no more.
                    for (before, after) in [
                        (a.approach_inner_m, b.approach_inner_m),
                        (a.hertz_inner_pa, b.hertz_inner_pa),
                        (a.half_width_inner_m, b.half_width_inner_m),
                        (a.alpha_rad, b.alpha_rad),
                        (a.windup_rad, b.windup_rad),
                        (a.torque_nm, b.torque_nm),
                    ] {
                        assert!(jump(before, after) < 4e-9, "{law:?} {rpm}: {before} {after}");
                    }
                    assert!(
                        pointwise_jump > step && pointwise.shift_rad(k + 1).abs() > 1e-7,
                        "{law:?} {rpm}"
                    );
                }
            }
        }
    }
}

/// The tangent stiffness jumps where the contact point passes from one radius to the next; where an edge of the patch
/// passes the junction even its slope goes on.
#[test]
fn the_tangent_stiffness_jumps_at_the_junctions_and_nowhere_else() {
    for law in KNOW_THE_RADIUS {
        let curve = curve(law, InnerCurvature::Patch);
        let tangent = |n: f64| curve.at_normal(n).unwrap().k_tangent_nm_per_rad;
        // Jumps of K and of N K'/K from three points on either side of `n`, a part `h` of it apart.
        let jumps = |n: f64, h: f64| {
            let side = |s: f64| {
                let k = [1.0, 2.0, 3.0].map(|i| tangent(n * (1.0 + s * i * h)));
                let value = 3.0 * k[0] - 3.0 * k[1] + k[2];
                (value, s * (-2.5 * k[0] + 4.0 * k[1] - 1.5 * k[2]) / h / value)
            };
            let ((a, below), (b, above)) = (side(-1.0), side(1.0));
            ((b / a - 1.0).abs(), (above - below).abs())
        };
        let junctions = [curve.arc_end_n(0), curve.arc_end_n(1)];
        for n in junctions {
            let (value, slope) = jumps(n, 1e-4);
            println!("{law:?}: K jumps by {value:.1e} at {n:.0} N, N K'/K by {slope:.1e}");
            // A force that moves within the patch as the junction does takes the jump away, to first order in the step.
            match law {
                ContactLaw::Elastic { .. } => assert!(value < 1e-3, "{law:?}: {value}"),
                _ => assert!(value > 5e-3 && slope > 1e-2, "{law:?}: {value} {slope}"),
            }
        }
        // At the edges what is seen of a jump of slope falls with the root of the distance: there is none. A force that moves
        // within the patch has more of that root than its approach.
        for s in curve.straddles() {
            for n in [Some(s.from_n), s.until_n].into_iter().flatten() {
                let farther = jumps(n, 4e-4).1;
                let (value, slope) = jumps(n, 2e-6);
                println!("{law:?}: edge at {n:.0} N: {value:.1e}, {slope:.1e}, farther off {farther:.1e}");
                assert!(value < 1e-8 && slope < 1e-4 && slope < 0.2 * farther, "{law:?} {n}");
            }
        }
        // The whole curve, without a gap between the stencils.
        let (first, last) = (50.0f64, 0.98 * curve.arc_end_n(2));
        let h = 1e-4;
        let count = ((last / first).ln() / (5.0 * h)) as usize;
        for i in 0..count {
            let n = first * (last / first).powf(i as f64 / count as f64);
            if junctions.iter().any(|j| (n / j - 1.0).abs() < 3.5 * h) {
                continue;
            }
            let (value, slope) = jumps(n, h);
            assert!(value < 1e-5 && slope < 1e-3, "{law:?} {n}: {value} {slope}");
        }
    }
}

#[test]
fn it_is_said_where_a_patch_straddles_a_junction() {
    for law in
        [ContactLaw::Roller { coefficient: 3.944e-5 }, ContactLaw::Elastic { state: StressState::Layer }]
    {
        let curve = curve(law, InnerCurvature::Patch);
        let list = curve.straddles();
        assert_eq!(list.iter().map(|s| s.junction).collect::<Vec<_>>(), [0, 1]);
        for s in &list {
            let (until, junction) = (s.until_n.unwrap(), curve.arc_end_n(s.junction));
            println!("{law:?}: {s:?}, passed at {junction:.0} N");
            assert!(s.from_n < junction && junction < until);
            let straddles = |n: f64| curve.at_normal(n).unwrap().straddles_junction;
            assert!(straddles(1.001 * s.from_n) && straddles(0.999 * until));
        }
        let free = |n: f64| !curve.at_normal(n).unwrap().straddles_junction;
        assert!(free(0.999 * list[0].from_n) && free(1.001 * list[1].until_n.unwrap()));
    }
    // A last arc that ends with the junction still under the patch.
    let short = built(&[(4.02e-3, 0.06), (4.08e-3, 0.08)], KNOW_THE_RADIUS[0], 0.0, InnerCurvature::Patch);
    assert_eq!(short.straddles().len(), 1);
    assert_eq!(short.straddles()[0].until_n, None);
}

/// The table keeps its accuracy where an edge of the patch passes a junction, slopes of the rolling ratio included.
#[test]
fn the_table_is_as_exact_as_without_junctions() {
    for (arcs, law) in KNOW_THE_RADIUS
        .map(|l| (&crate::common::MULTI[..], l))
        .into_iter()
        .chain([(&STEEP[..], KNOW_THE_RADIUS[0])])
    {
        let curve = built(arcs, law, 0.0, InnerCurvature::Patch);
        let mut worst = [0.0f64; 3];
        for i in 0..3000 {
            let n = 200.0 + 2.0 * f64::from(i);
            let Some((k, c)) = curve.closure_at_normal(n) else { continue };
            // rho' has a step at a junction: no difference across one.
            if (0..curve.arc_count()).any(|j| (n / curve.arc_end_n(j) - 1.0).abs() < 2e-5) {
                continue;
            }
            let p = curve.in_arc(k, c.alpha.v);
            let side = |m: f64| curve.statics().closure(k, m, 0.0, curve.shift_rad(k)).unwrap();
            let (a, b) = (side(n * (1.0 - 1e-5)), side(n * (1.0 + 1e-5)));
            let (rho, below, above) = (c.rolling_ratios().0, a.rolling_ratios().0, b.rolling_ratios().0);
            let slope = (above - below) / (b.alpha.v - a.alpha.v);
            for (w, e) in worst.iter_mut().zip([p.n_bi / n - 1.0, p.rho_i - rho, p.rho_i_slope / slope - 1.0])
            {
                *w = w.max(e.abs());
            }
        }
        println!(
            "{law:?}: truncation {:.1e}; N {:.1e}, rho {:.1e}, rho' {:.1e}",
            curve.truncation(),
            worst[0],
            worst[1],
            worst[2]
        );
        assert!(worst[0] < 1e-9 && worst[1] < 1e-11 && worst[2] < 2e-5, "{law:?}");
        assert!(curve.truncation() < 1e-8, "{law:?}");
    }
}

/// What the paper's pointwise radius costs in statics: little. (In dynamics its energy drifts, tests/motion/dynamics.rs.)
#[test]
fn the_pointwise_radius_compared() {
    for (law, windup_within, torque_within) in
        [(KNOW_THE_RADIUS[0], 5e-4, 2e-5), (KNOW_THE_RADIUS[1], 5e-4, 2e-5), (KNOW_THE_RADIUS[2], 2e-5, 1e-6)]
    {
        let averaged = curve(law, InnerCurvature::Patch);
        let pointwise = curve(law, InnerCurvature::Pointwise);
        let mut worst = [0.0f64; 3];
        for i in 1..=100 {
            let torque = f64::from(i);
            let (a, p) = (averaged.at_torque(torque).unwrap(), pointwise.at_torque(torque).unwrap());
            let same_n = averaged.at_normal(p.normal_inner_n).unwrap();
            let differences = [
                p.windup_rad / a.windup_rad - 1.0,
                p.torque_nm / same_n.torque_nm - 1.0,
                p.approach_inner_m / a.approach_inner_m - 1.0,
            ];
            if i % 10 == 0 {
                println!(
                    "{law:?} {torque} Nm: windup, torque at equal N, delta_H off by {}",
                    differences.map(|d| format!("{d:+.1e}")).join(", ")
                );
            }
            worst.iter_mut().zip(differences).for_each(|(w, d)| *w = w.max(d.abs()));
            // Before the first patch reaches a junction both are the same.
            assert!(torque > 8.0 || differences.iter().all(|d| d.abs() < 1e-13));
        }
        println!("{law:?}: at most {worst:?} (windup, torque at equal N, delta_H)");
        assert!(worst[0] < windup_within && worst[1] < torque_within, "{law:?} {worst:?}");
        assert!(worst[0] > 1e-6, "{law:?}: the variants do not differ");
    }
}

/// Profiles that a search may try: short arcs, large steps either way, junctions next to first contact.
#[test]
fn the_curvature_settles_wherever_the_pointwise_one_does() {
    let mut state = 0x2545_f491_4f6c_dd1d_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let (mut built, mut junctions, mut worst_shift) = (0, 0, 0.0f64);
    let (mut worst_truncation, mut pointwise_truncation) = (0.0f64, 0.0f64);
    for round in 0..200 {
        let count = 2 + (5.0 * random()) as usize;
        let mut turn = 0.0;
        let arcs: Vec<(f64, f64)> = (0..count)
            .map(|_| {
                turn += 10f64.powf(-3.5 + 2.7 * random());
                (3.4e-3 + 1.4e-3 * random(), turn)
            })
            .collect();
        let mut clutch = crate::common::clutch(&crate::common::SINGLE).0;
        clutch.contact = KNOW_THE_RADIUS[round % 2];
        clutch.sprags.centre_distance_m = 0.62e-3 + 0.6e-3 * random();
        clutch.sprags.inner_arcs =
            arcs.iter().map(|&(radius_m, until_rad)| InnerArc { radius_m, until_rad }).collect();
        let placed = Profile::new(4.68e-3, clutch.sprags.centre_distance_m, &arcs, 11.11e-3, 19.44e-3);
        let Ok(profile) = placed else { continue };
        let speed = if round % 3 == 0 { 0.0 } else { 3000.0 * random() };
        let of = |rule| WedgeCurve::build_with(&clutch, &profile, speed, rule);
        match (of(InnerCurvature::Patch), of(InnerCurvature::Pointwise)) {
            (Ok(averaged), pointwise) => {
                built += 1;
                for k in 1..averaged.arc_count() {
                    junctions += 1;
                    worst_shift = worst_shift.max(averaged.shift_rad(k).abs());
                }
                worst_truncation = worst_truncation.max(averaged.truncation());
                let Ok(pointwise) = pointwise else { continue };
                pointwise_truncation = pointwise_truncation.max(pointwise.truncation());
                let ((why, end), (other, there)) = (averaged.end(), pointwise.end());
                assert!(
                    (end / there - 1.0).abs() < 0.02,
                    "{arcs:?} {speed}: {why:?} {end}, {other:?} {there}"
                );
            }
            (Err(why), pointwise) => assert!(pointwise.is_err(), "{arcs:?} {speed}: {why}"),
        }
    }
    println!(
        "{built} curves, {junctions} junctions, shift {worst_shift:.1e}, truncation {worst_truncation:.1e}, \
         pointwise {pointwise_truncation:.1e}"
    );
    assert!(built > 100 && junctions > 100 && worst_shift < 1e-11);
}
