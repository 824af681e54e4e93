//! The units in which a design is written, changed to SI.
//!
//! In: mm, rev/min, MPa. Out: m, rad/s, Pa, and back where a page says so. Absent: how a page rounds (`report`). Equations: none.

/// mm to m. Division, because 1e-3 is no binary fraction: 4.68 mm becomes the double nearest to 4.68e-3 m
/// oftener than by a product.
pub(crate) fn m(mm: f64) -> f64 {
    mm / 1e3
}

/// rev/min to rad/s.
pub fn rad_s(rpm: f64) -> f64 {
    rpm * std::f64::consts::PI / 30.0
}

/// rad/s to rev/min.
pub fn rpm(rad_s: f64) -> f64 {
    rad_s * 30.0 / std::f64::consts::PI
}

/// MPa to Pa.
pub(crate) fn pa(mpa: f64) -> f64 {
    mpa * 1e6
}
