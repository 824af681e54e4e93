//! Pressure of a line contact over a step of curvature: what the parabola of the mean curvature gets wrong.

use std::f64::consts::PI;

/// Places of the step under the patch that are looked at, and points of the pressure for each: choices; the largest errors
/// lie flat between them.
const PLACES: usize = 64;
const POINTS: usize = 400;

/// By what part the peak pressure sqrt(q E* k/pi) of a parabola is off at most, wherever the patch lies over a step of the
/// gap's curvature from `here_per_m` (1/m, at the contact point) to `beyond_per_m`; k is the mean curvature, that of the first
/// Chebyshev coefficient of the gap's slope, with the patch about the contact point. The load does not matter.
///
/// The plane contact of h' = k x + D <x - c> on e - a .. e + a, x = e + a cos theta, c = e + a cos theta_0, d = D/k. With
/// cos n theta for the slope there is sin n theta of pressure (Glauert), so
///
///   a^2 (1 + d A_1) = a_0^2,   e = -d a A_0,   p = (E*/2) k a [sin theta + d g(theta)]
///   A_0 = (sin theta_0 - theta_0 cos theta_0)/pi,   A_1 = (theta_0 - sin theta_0 cos theta_0)/pi
///   g = (1/pi) [theta_0 sin theta + (cos theta - cos theta_0) ln|sin((theta + theta_0)/2)/sin((theta - theta_0)/2)|]
///
/// a_0 is the half width without a step. tests/wedge/patch_contact.rs holds it against a half-plane solution.
pub fn step_peak_error(here_per_m: f64, beyond_per_m: f64) -> f64 {
    let d = beyond_per_m / here_per_m - 1.0;
    let share = |cos: f64| {
        let angle = cos.acos();
        (angle, (angle.sin() - angle * cos) / PI, (angle - angle.sin() * cos) / PI)
    };
    // Lengths in a_0, pressures in (E*/2) k a_0.
    let error = |cos_0: f64| {
        let (theta_0, a_0, a_1) = share(cos_0);
        let a = (1.0 + d * a_1).sqrt().recip();
        let step_at = a * cos_0 - d * a * a_0;
        let pressure = |theta: f64| {
            let log = (0.5 * (theta + theta_0)).sin() / (0.5 * (theta - theta_0)).sin();
            let bend = if theta == theta_0 { 0.0 } else { (theta.cos() - cos_0) * log.abs().ln() };
            a * (theta.sin() + d * (theta_0 * theta.sin() + bend) / PI)
        };
        // The peak lies away from the edges.
        let theta = |i: usize| PI * (0.125 + 0.75 * i as f64 / POINTS as f64);
        let peak = (0..=POINTS).map(|i| pressure(theta(i))).fold(0.0, f64::max);
        // Width and mean curvature of the patch about the contact point, found together.
        let mean = (0..60).fold(1.0_f64, |k, _| 1.0 + d * share((step_at * k.sqrt()).min(1.0)).2);
        // A step behind the contact point is one ahead of it, seen from the other arc.
        if step_at < 0.0 { 0.0 } else { (mean.sqrt() / peak - 1.0).abs() }
    };
    let places = (1..PLACES).map(|i| error(2.0 * i as f64 / PLACES as f64 - 1.0));
    places.fold(0.0, f64::max)
}
