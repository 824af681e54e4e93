//! Rings: Lame, fits, temperature.

use super::{close, design, row, rows};
use sprag_design::{Design, Outline};
use std::f64::consts::PI;

/// Lame (Timoshenko and Goodier, art. 28): a ring under pressure p on its bore has there p (b^2+a^2)/(b^2-a^2); under p on
/// its outside -2 p b^2/(b^2-a^2) at its bore. p spreads n_s N evenly over the track.
#[test]
fn hoop_is_lames() {
    let d = design(&[]);
    let (state, rows) = rows(&d);
    let p = state.curve.at_torque(110.0).unwrap();
    let mean = |normal_n: f64, radius_m: f64| 12.0 * normal_n / (2.0 * PI * radius_m * 6e-3) * 1e-6;
    let squares = |a: f64, b: f64| (a * a, b * b);
    let (a, b) = squares(19.44, 26.23);
    close(
        row(&rows, "hoop-outer").demand_in_unit().unwrap(),
        mean(p.normal_outer_n, 19.44e-3) * (b + a) / (b - a),
        1e-9,
    );
    let (a, b) = squares(7.21, 11.11);
    close(
        row(&rows, "hoop-inner").demand_in_unit().unwrap(),
        mean(p.normal_inner_n, 11.11e-3) * 2.0 * b / (b - a),
        1e-9,
    );
}

const FITTED: (&str, &str) = (
    "viscous_damping_nm_s_per_rad = 0.1  #",
    "press_fit = { inner_interference_um = 20.0, outer_interference_um = 30.0, housing_outside_radius_mm = 35.0 }\nviscous_damping_nm_s_per_rad = 0.1 #",
);

/// Decker, Maschinenelemente (press fits of one material; Timoshenko, Strength of Materials II, art. 42):
/// p = E delta/(2 R) (c^2-R^2)(R^2-a^2)/(R^2 (c^2-a^2)) with radial interference delta, a bore, R joint, c outside; a solid
/// shaft has a = 0. Under p in its bore R the inner race (R, b) grows outside by 2 p R^2 b/(E (b^2-R^2)).
#[test]
fn fits_move_the_tracks_and_stress_the_races() {
    let d = design(&[FITTED]);
    let run = d.clutch.running.unwrap();
    let e = 206e9;
    // Solid shaft in the inner race: p = E delta (b^2-R^2)/(2 R b^2), and the track grows by delta R/b.
    let (delta, joint, b) = (10e-6, 7.21e-3_f64, 11.11e-3_f64);
    let p_inner = e * delta * (b * b - joint * joint) / (2.0 * joint * b * b);
    close(run.inner.joint_pressure_pa, p_inner, 1e-12);
    close(run.inner.by_fit_m, delta * joint / b, 1e-12);
    close(d.clutch.races.inner_radius_m, b + delta * joint / b, 1e-15);
    // Housing round the outer race.
    let (delta, a, joint, c) = (15e-6, 19.44e-3_f64, 26.23e-3_f64, 35e-3_f64);
    let p_outer = e * delta / (2.0 * joint) * (c * c - joint * joint) * (joint * joint - a * a)
        / (joint * joint * (c * c - a * a));
    close(run.outer.joint_pressure_pa, p_outer, 1e-12);
    let shrinks = 2.0 * p_outer * a * joint * joint / (e * (joint * joint - a * a));
    close(run.outer.by_fit_m, -shrinks, 1e-12);
    println!(
        "{:.1} and {:.1} MPa; tracks move {:.2} and {:.2} um",
        p_inner / 1e6,
        p_outer / 1e6,
        run.inner.by_fit_m * 1e6,
        -shrinks * 1e6
    );

    // Hoop at peak torque: the race and its partner are one piece, so the load's share is Lame's of the whole; at a solid
    // shaft -P everywhere. The fit's share at the joint is p (b^2+R^2)/(b^2-R^2), at the track 2 p R^2/(b^2-R^2).
    let (state, rows) = rows(&d);
    let at = state.curve.at_torque(110.0).unwrap();
    let (joint, b) = (7.21e-3_f64, d.clutch.races.inner_radius_m);
    let load = 12.0 * at.normal_inner_n / (2.0 * PI * b * 6e-3);
    let b0 = 11.11e-3_f64;
    let wall = b0 * b0 - joint * joint;
    let (at_joint, at_track) =
        (p_inner * (b0 * b0 + joint * joint) / wall, 2.0 * p_inner * joint * joint / wall);
    let worst = [at_joint, at_track, load - at_joint, load - at_track].into_iter().fold(0.0, f64::max);
    close(row(&rows, "hoop-inner").demand_in_unit().unwrap(), worst * 1e-6, 1e-9);
    let (a, c) = (d.clutch.races.outer_radius_m, 35e-3_f64);
    let load = 12.0 * at.normal_outer_n / (2.0 * PI * a * 6e-3);
    let joint = 26.23e-3_f64;
    let hoop = |r: f64| load * a * a * (1.0 + c * c / (r * r)) / (c * c - a * a);
    let a0 = 19.44e-3_f64;
    let wall = joint * joint - a0 * a0;
    let (fit_track, fit_joint) =
        (-2.0 * p_outer * joint * joint / wall, -p_outer * (joint * joint + a0 * a0) / wall);
    let worst = [fit_track.abs(), fit_joint.abs(), hoop(a) + fit_track, hoop(joint) + fit_joint];
    close(
        row(&rows, "hoop-outer").demand_in_unit().unwrap(),
        worst.into_iter().fold(0.0, f64::max) * 1e-6,
        1e-9,
    );
    // A stiffer clutch, and less stress in the inner race, than without shaft and housing.
    let (_, loose) = super::rows(&design(&[]));
    assert!(
        row(&rows, "hoop-inner").demand_in_unit().unwrap()
            < row(&loose, "hoop-inner").demand_in_unit().unwrap()
    );
}

fn warm(inner: f64, outer: f64, sprags: f64) -> Vec<(&'static str, String)> {
    vec![
        ("density_kg_m3 = 7850.0 ", "expansion_um_per_m_k = 12.0\ndensity_kg_m3 = 7850.0 ".to_owned()),
        (
            "[friction]",
            format!(
                "[thermal]\ninner_race_c = {inner}\nouter_race_c = {outer}\nsprags_c = {sprags}\n[friction]"
            ),
        ),
    ]
}

fn design_of(changes: &[(&str, String)]) -> sprag_design::design::Design {
    let changes: Vec<(&str, &str)> = changes.iter().map(|(a, b)| (*a, b.as_str())).collect();
    design(&changes)
}

/// delta R = alpha R delta T, of both tracks and the sprag's radii.
#[test]
fn warm_tracks_grow_by_alpha_r_delta_t() {
    let d = design_of(&warm(100.0, 60.0, 80.0));
    close(d.clutch.races.inner_radius_m, 11.11e-3 * (1.0 + 12e-6 * 80.0), 1e-14);
    close(d.clutch.races.outer_radius_m, 19.44e-3 * (1.0 + 12e-6 * 40.0), 1e-14);
    close(d.clutch.sprags.outer_radius_m, 4.68e-3 * (1.0 + 12e-6 * 60.0), 1e-14);
    let run = d.clutch.running.unwrap();
    // Grown sprags in a gap that has changed less: by cosine rule, then the direction of C_1 from C_e.
    let s = 1.0 + 12e-6 * 60.0;
    let triangle = |r_i: f64, r_e: f64, s: f64| {
        let (oc_1, oc_e, e) = (r_i + s * 4.02e-3, r_e - s * 4.68e-3, s * 0.62e-3);
        let beta = ((oc_1 * oc_1 + oc_e * oc_e - e * e) / (2.0 * oc_1 * oc_e)).acos();
        (beta, (oc_1 * beta.sin()).atan2(oc_1 * beta.cos() - oc_e))
    };
    let (beta0, at0) = triangle(11.11e-3, 19.44e-3, 1.0);
    let (beta, at) = triangle(d.clutch.races.inner_radius_m, d.clutch.races.outer_radius_m, s);
    let turn = (at - at0) - (beta - beta0);
    println!("first contact turned by {turn} rad");
    assert!((run.first_turn_rad - turn).abs() < 1e-9 && turn < 0.0);
    // Junctions stay where they are on the sprag: distance of the first from C_e.
    let place = |c: &sprag_design::clutch::Clutch| {
        let p = c.profile().unwrap();
        let arc = p.arcs[0];
        (arc.centre_m + arc.radius_m * p.contact_direction(arc.until_rad)).norm()
    };
    close(place(&d.clutch), s * place(&design(&[]).clutch), 1e-12);
    assert_eq!(d.clutch.sprags.inner_arcs.len(), 3);
}

/// A clutch that is as warm everywhere is the same clutch, enlarged.
#[test]
fn even_warmth_enlarges_and_changes_no_angle() {
    let d = design_of(&warm(120.0, 120.0, 120.0));
    let run = d.clutch.running.unwrap();
    assert!(run.first_turn_rad.abs() < 1e-12, "{run:?}");
    close(run.inner.to_make_m, 11.11e-3, 1e-14);
    close(run.outer.to_make_m, 19.44e-3, 1e-14);
    let (_, cold) = rows(&design(&[]));
    let (_, hot) = rows(&d);
    close(
        row(&hot, "re-engagement").demand_in_unit().unwrap(),
        row(&cold, "re-engagement").demand_in_unit().unwrap(),
        1e-9,
    );
    // Forces grow with 1/length at equal torque: 0.12 % here; the pressure with its square root and that of the radius.
    close(
        row(&hot, "hertz-peak-inner").demand_in_unit().unwrap(),
        row(&cold, "hertz-peak-inner").demand_in_unit().unwrap(),
        4e-3,
    );
}

/// Made at the radii that `check` names, the clutch runs at those that were drawn.
#[test]
fn the_radii_to_make_run_as_drawn() {
    let mut changes = warm(110.0, 70.0, 20.0);
    changes.push((FITTED.0, FITTED.1.to_owned()));
    let drawn = design_of(&changes);
    let run = drawn.clutch.running.unwrap();
    changes.push(("\ninner_radius_mm = 11.11", format!("\ninner_radius_mm = {}", run.inner.to_make_m * 1e3)));
    changes.push(("\nouter_radius_mm = 19.44", format!("\nouter_radius_mm = {}", run.outer.to_make_m * 1e3)));
    let made = design_of(&changes);
    println!("to make {} and {} mm", run.inner.to_make_m * 1e3, run.outer.to_make_m * 1e3);
    close(made.clutch.races.inner_radius_m, 11.11e-3, 1e-12);
    close(made.clutch.races.outer_radius_m, 19.44e-3, 1e-12);
    assert!(run.inner.to_make_m < 11.11e-3);
    // The gap as run and at nominal torque is that of the drawn radii; sprags stay cold here, so angles agree too.
    let (_, right) = rows(&made);
    let (_, as_drawn) = rows(&design(&[]));
    close(
        row(&right, "re-engagement").demand_in_unit().unwrap(),
        row(&as_drawn, "re-engagement").demand_in_unit().unwrap(),
        1e-9,
    );
}

/// Between warm races first contact lies elsewhere on a sprag that is the same body: its outline weighs what it did, but for its growth,
/// whichever race is the warmer and whether flanks are parallel or lean.
#[test]
fn flanks_stay_on_the_body_between_warm_races() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/designs/starter.toml");
    let text = std::fs::read_to_string(path).unwrap();
    let leaning =
        text.replace("front_mm = 2.80 }", "front_mm = 2.80, rear_tilt_rad = 0.05, front_tilt_rad = -0.04 }");
    assert!(leaning != text);
    let volume_m3 = |design: &Design| {
        let (sprags, profile) = (&design.clutch.sprags, design.clutch.profile().unwrap());
        let outline = Outline::closed(&profile, &sprags.flanks.unwrap()).unwrap();
        outline.mass_properties(sprags.length_m, 1.0).mass_kg
    };
    for text in [text, leaning] {
        let cold = Design::parse(&text, path).unwrap();
        for [inner_c, sprags_c, outer_c] in [[120.0, 90.0, 60.0], [60.0, 90.0, 100.0], [20.0, 20.0, 20.0]] {
            let warm = cold
                .with_values(&[
                    ("thermal.inner_race_c", inner_c),
                    ("thermal.sprags_c", sprags_c),
                    ("thermal.outer_race_c", outer_c),
                ])
                .unwrap();
            let scale = warm.clutch.running.unwrap().sprag_scale;
            close(volume_m3(&warm), scale.powi(3) * volume_m3(&cold), 1e-12);
        }
    }
}
