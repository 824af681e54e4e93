//! The two flanks as lines: where they stand, what they need, where they meet the arcs.

use super::{FlankSide, OutlineError, Profile, ProfileArc};
use nalgebra::Vector2;

/// Steepest lean of a flank against the strut line, rad: a choice; a wedge of twice as much is no sprag any more.
pub const STEEPEST_RAD: f64 = 0.5;

/// Straight flanks that close the outline between the inner and the outer arc.
///
/// # Conventions
/// The strut line runs from the inner contact A to the outer contact B at first contact at rest. Half widths are
/// measured from its middle, normal to it. A tilt of 0 makes a flank parallel to it; a positive one leans the
/// flank's outer end away from the strut line, so the sprag grows wider outwards. Rear lies towards negative x,
/// front towards positive x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flanks {
    /// Distance of the rear flank from the middle of the strut line, m.
    pub rear_m: f64,
    /// Distance of the front flank from the middle of the strut line, m.
    pub front_m: f64,
    /// Lean of the rear flank, rad.
    pub rear_tilt_rad: f64,
    /// Lean of the front flank, rad.
    pub front_tilt_rad: f64,
}

impl Flanks {
    /// Both flanks parallel to the strut line, m from it.
    pub fn parallel(rear_m: f64, front_m: f64) -> Self {
        Self { rear_m, front_m, rear_tilt_rad: 0.0, front_tilt_rad: 0.0 }
    }

    /// Distance of one flank from the middle of the strut line, m, and its lean, rad.
    pub(super) fn side(&self, side: FlankSide) -> (f64, f64) {
        match side {
            FlankSide::Rear => (self.rear_m, self.rear_tilt_rad),
            FlankSide::Front => (self.front_m, self.front_tilt_rad),
        }
    }
}

/// The strut line AB at first contact.
pub(super) struct Strut {
    /// A.
    pub a: Vector2<f64>,
    /// B.
    pub b: Vector2<f64>,
    /// Unit vector from A to B.
    up: Vector2<f64>,
    /// Unit normal towards +x.
    front: Vector2<f64>,
}

impl Strut {
    pub fn new(profile: &Profile, first: &ProfileArc) -> Self {
        let a = first.centre_m + first.radius_m * profile.contact_direction(0.0);
        let b = Vector2::new(0.0, profile.outer_radius_m);
        let up = (b - a).normalize();
        Self { a, b, up, front: Vector2::new(up.y, -up.x) }
    }
}

/// One flank: the line through `point` along `up`.
pub(super) struct Flank {
    pub side: FlankSide,
    /// Half width, m.
    given_m: f64,
    point: Vector2<f64>,
    /// Unit vector along the flank, outwards.
    pub up: Vector2<f64>,
    /// Unit normal away from the sprag.
    out: Vector2<f64>,
    /// Middle of the strut line, m.
    middle: Vector2<f64>,
    /// +1 in front, -1 at the rear.
    pub sign: f64,
    cos_tilt: f64,
}

impl Flank {
    /// # Errors
    /// [`OutlineError::NotPositive`], [`OutlineError::TooSteep`], and [`OutlineError::CutsContact`] where the flank
    /// leaves A or B outside.
    pub fn new(strut: &Strut, side: FlankSide, flanks: &Flanks) -> Result<Self, OutlineError> {
        let (given_m, tilt_rad) = flanks.side(side);
        if !(given_m > 0.0 && given_m.is_finite()) {
            return Err(OutlineError::NotPositive { side, given_m });
        }
        if tilt_rad.is_nan() || tilt_rad.abs() > STEEPEST_RAD {
            return Err(OutlineError::TooSteep { side, tilt_rad });
        }
        let sign = match side {
            FlankSide::Rear => -1.0,
            FlankSide::Front => 1.0,
        };
        let (sin, cos) = tilt_rad.sin_cos();
        let middle = 0.5 * (strut.a + strut.b);
        let flank = Self {
            side,
            given_m,
            point: middle + sign * given_m * strut.front,
            up: cos * strut.up + sign * sin * strut.front,
            out: sign * cos * strut.front - sin * strut.up,
            middle,
            sign,
            cos_tilt: cos,
        };
        let needed_m = flank.need(strut.a).max(flank.need(strut.b));
        if needed_m >= given_m {
            Err(OutlineError::CutsContact { side, given_m, needed_m })
        } else {
            Ok(flank)
        }
    }

    /// Half width at which the flank would pass through a point, m.
    pub fn need(&self, point: Vector2<f64>) -> f64 {
        self.out.dot(&(point - self.middle)) / self.cos_tilt
    }

    /// Half width at which the flank would only touch a circle, m.
    pub fn reach(&self, centre: Vector2<f64>, radius: f64) -> f64 {
        self.need(centre) + radius / self.cos_tilt
    }

    /// Angle from the flank's foot to where it cuts a circle, seen from the centre: from -up (or up) towards `out`,
    /// rad; `None` where it passes the circle.
    pub fn bite(&self, centre: Vector2<f64>, radius: f64) -> Option<f64> {
        let apart = self.out.dot(&(self.point - centre));
        (apart.abs() < radius).then(|| (apart / radius).asin())
    }

    /// Cosine of the lean.
    pub fn cos_tilt(&self) -> f64 {
        self.cos_tilt
    }

    /// The half width that was given, m.
    pub fn given_m(&self) -> f64 {
        self.given_m
    }
}
