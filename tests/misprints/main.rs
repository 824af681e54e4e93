//! Every misprint of the paper, printed form beside corrected form, each decided by mechanics that neither form
//! was derived from here: vectors in the plane, balance of momentum, angular momentum and power.
//!
//! (7) is decided beside its home in `src/race/ring.rs`, (A.8) in `tests/wedge/statics.rs`.
#[path = "../common/mod.rs"]
mod common;
mod geometry;
mod motion;

use sprag_design::clutch::Clutch;
use sprag_design::wedge::{Closure, WedgeCurve};

const COUNT: f64 = 12.0;
const RPM: f64 = std::f64::consts::PI / 30.0;

fn curve(speed: f64, change: impl Fn(&mut Clutch)) -> WedgeCurve {
    let (mut clutch, profile) = common::clutch(&common::SINGLE);
    change(&mut clutch);
    WedgeCurve::build(&clutch, &profile, speed).unwrap()
}

/// Azimuth 0 is +y, positive towards +x, as in the body frame: (sin, cos).
fn at_azimuth(azimuth: f64) -> [f64; 2] {
    [azimuth.sin(), azimuth.cos()]
}

/// Moment in the sense of growing azimuth.
fn moment(arm: [f64; 2], force: [f64; 2]) -> f64 {
    arm[1] * force[0] - arm[0] * force[1]
}

fn from_to(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [b[0] - a[0], b[1] - a[1]]
}

fn times(k: f64, v: [f64; 2]) -> [f64; 2] {
    [k * v[0], k * v[1]]
}

/// A, B and G of a closure in the plane, C_e on the y axis.
fn points(c: &Closure) -> [[f64; 2]; 3] {
    [
        times(c.lengths.oa.v, at_azimuth(c.beta.v)),
        times(c.lengths.ob.v, at_azimuth(0.0)),
        times(c.oc_g.v, at_azimuth(-c.gamma.v)),
    ]
}
