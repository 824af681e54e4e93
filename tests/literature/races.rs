//! Rings: Lame, fits, temperature.

use super::{close, design, row, rows};
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
    close(row(&rows, "hoop-outer").demand, mean(p.normal_outer_n, 19.44e-3) * (b + a) / (b - a), 1e-9);
    let (a, b) = squares(7.21, 11.11);
    close(row(&rows, "hoop-inner").demand, mean(p.normal_inner_n, 11.11e-3) * 2.0 * b / (b - a), 1e-9);
}
