//! Archard's wear: volume = k N s, k in m^3/(N m).

use std::f64::consts::PI;

/// Depth of the flat that `volume_m3` leaves on a cylinder of the relative radius `radius_m` along `length_m`, m: it wears to the race's
/// shape, V = (4/3) l sqrt(2 R) d^(3/2), and no less wide than `half_m` either side, where the depth is V/(2 a l).
pub fn flat_depth_m(volume_m3: f64, radius_m: f64, length_m: f64, half_m: f64) -> f64 {
    let area = volume_m3 / length_m;
    let flat = (0.75 * area / (2.0 * radius_m).sqrt()).powf(2.0 / 3.0);
    if half_m > 0.0 { flat.min(area / (2.0 * half_m)) } else { flat }
}

/// Depth that `volume_m3` leaves all round a track, m.
pub fn track_depth_m(volume_m3: f64, track_radius_m: f64, length_m: f64) -> f64 {
    volume_m3 / (2.0 * PI * track_radius_m * length_m)
}
