//! Pressure and grip.

use super::{close, design, row, rows};
use std::f64::consts::PI;

/// tan omega from three lengths: the strut AB of the triangle O A B with angle beta at O, OA = R_i, OB = R_e, makes with OA
/// the angle omega, with OB nu, and omega = beta + nu. First contact at rest; no elasticity.
#[test]
fn the_strut_is_a_triangle() {
    let (_, rows) = rows(&design(&[]));
    let (oc_i, oc_e) = (11.11e-3 + 4.02e-3, 19.44e-3 - 4.68e-3);
    let beta: f64 = ((oc_i * oc_i + oc_e * oc_e - 0.62e-3_f64.powi(2)) / (2.0_f64 * oc_i * oc_e)).acos();
    // Sine rule in O A B: AB/sin beta = OB/sin(pi - omega).
    let ab = (11.11e-3_f64.powi(2) + 19.44e-3_f64.powi(2) - 2.0 * 11.11e-3 * 19.44e-3 * beta.cos()).sqrt();
    let omega = (19.44e-3 * beta.sin() / ab).asin();
    let first = row(&rows, "re-engagement");
    close(first.demand_in_unit().unwrap(), omega.tan(), 1e-6);
    close(first.margin(), 0.09 / omega.tan() - 1.0, 1e-5);
}

/// Torque of one sprag by hand gives T at each contact; with the normal force of the state the quotient is the demand.
/// The largest up to the peak is that at the peak here: the profile steepens.
#[test]
fn grip_is_torque_over_radius_and_normal_force() {
    let d = design(&[]);
    let (state, rows) = rows(&d);
    let p = state.curve.at_torque(110.0).unwrap();
    // Radii under load: Lame's growth, some 0.1 %.
    close(
        row(&rows, "grip-inner").demand_in_unit().unwrap(),
        110.0 / 12.0 / 11.11e-3 / p.normal_inner_n,
        5e-3,
    );
    close(
        row(&rows, "grip-outer").demand_in_unit().unwrap(),
        110.0 / 12.0 / 19.44e-3 / p.normal_outer_n,
        5e-3,
    );
    for i in 1..200 {
        let p = state.curve.at_torque(110.0 * f64::from(i) / 200.0).unwrap();
        assert!(p.tan_omega <= row(&rows, "grip-inner").demand_in_unit().unwrap() + 1e-12);
    }
}

/// A profile whose strut lies flatter at the end than on the way: the demand on the way counts.
#[test]
fn grip_is_held_on_the_way_to_the_peak() {
    let d = design(&[
        ("radius_mm = 4.15, until_rad", "radius_mm = 3.6, until_rad"),
        ("name = \"r_i3_mm\", min = 3.6", "name = \"r_i3_mm\", min = 2.0"),
    ]);
    let (state, rows) = rows(&d);
    let at_peak = state.curve.at_torque(110.0).unwrap().tan_omega;
    let on_the_way = (1..2000)
        .filter_map(|i| state.curve.at_torque(0.055 * f64::from(i)))
        .map(|p| p.tan_omega)
        .fold(0.0, f64::max);
    println!("tan omega {at_peak} at the peak, {on_the_way} on the way");
    assert!(on_the_way > 1.001 * at_peak);
    // The largest lies in the kink at a junction; the row looks at 24 states on the way and may pass it by so far.
    close(row(&rows, "grip-inner").demand_in_unit().unwrap(), on_the_way, 5e-3);
}

/// Hertz (Johnson, Contact Mechanics, 4.2(c)): p_0 = sqrt(N E*/(pi l R)), E* = E/(2(1-nu^2)), 1/R = 1/R_i + 1/r_3 at A (convex
/// on convex), 1/r_e - 1/R_e at B (convex in concave).
#[test]
fn pressure_is_hertz() {
    let d = design(&[]);
    let (state, rows) = rows(&d);
    let modulus = 206e9 / (2.0 * (1.0 - 0.09));
    for (torque, kind) in [(90.0, "nominal"), (110.0, "peak")] {
        let p = state.curve.at_torque(torque).unwrap();
        assert_eq!(p.arc, 2, "on the third arc");
        let pressure =
            |normal_n: f64, curvature: f64| (normal_n / 6e-3 * modulus * curvature / PI).sqrt() * 1e-6;
        let inner = pressure(p.normal_inner_n, 1.0 / 11.11e-3 + 1.0 / 4.15e-3);
        let outer = pressure(p.normal_outer_n, 1.0 / 4.68e-3 - 1.0 / 19.44e-3);
        close(row(&rows, &format!("hertz-{kind}-inner")).demand_in_unit().unwrap(), inner, 1e-9);
        close(row(&rows, &format!("hertz-{kind}-outer")).demand_in_unit().unwrap(), outer, 1e-9);
    }
}
