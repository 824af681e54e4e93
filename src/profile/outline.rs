//! The closed outline of a sprag: inner arcs, front flank, outer arc, rear flank.

use super::{OutlineError, Profile, ProfileArc, Side};
use nalgebra::Vector2;
use std::f64::consts::PI;

/// Chords per arc at most in [`Outline::polyline`]: a choice, beyond any drawing's need.
const CHORDS_AT_MOST: f64 = 4096.0;

/// Half width over need in [`Outline::narrowest`].
const BEYOND: f64 = 1.05;

/// One piece of the outline, in the body frame.
///
/// # Conventions
/// The outline runs counterclockwise with x to the right and y up. Azimuths go from +y towards +x, that is
/// clockwise, so the arcs of the outline have a negative sweep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Segment {
    /// Circular arc.
    Arc {
        /// Centre, m.
        centre_m: Vector2<f64>,
        /// Radius, m.
        radius_m: f64,
        /// Azimuth of the first point seen from the centre, rad.
        from_azimuth_rad: f64,
        /// Azimuth of the last point less that of the first, rad.
        sweep_rad: f64,
    },
    /// Straight line.
    Line {
        /// First point, m.
        from_m: Vector2<f64>,
        /// Last point, m.
        to_m: Vector2<f64>,
    },
}

impl Segment {
    /// First point, m.
    pub fn start_m(&self) -> Vector2<f64> {
        self.at(0.0)
    }

    /// Last point, m.
    pub fn end_m(&self) -> Vector2<f64> {
        self.at(1.0)
    }

    /// Azimuths of the outward normal at the first and the last point, rad.
    pub(super) fn normal_azimuths(&self) -> (f64, f64) {
        match *self {
            Self::Arc { from_azimuth_rad, sweep_rad, .. } => (from_azimuth_rad, from_azimuth_rad + sweep_rad),
            Self::Line { from_m, to_m } => {
                // Counterclockwise: outward is to the right of the way, (dy, -dx).
                let way = to_m - from_m;
                let azimuth = way.y.atan2(-way.x);
                (azimuth, azimuth)
            }
        }
    }

    /// Point at the fraction `part` of the segment.
    fn at(&self, part: f64) -> Vector2<f64> {
        match *self {
            Self::Arc { centre_m, radius_m, from_azimuth_rad, sweep_rad } => {
                centre_m + radius_m * along(from_azimuth_rad + part * sweep_rad)
            }
            Self::Line { from_m, to_m } => from_m * (1.0 - part) + to_m * part,
        }
    }
}

/// Unit vector at an azimuth.
pub(super) fn along(azimuth_rad: f64) -> Vector2<f64> {
    Vector2::new(azimuth_rad.sin(), azimuth_rad.cos())
}

/// Closed outline of a sprag in the body frame, counterclockwise from the rear corner of the first inner arc.
///
/// The flanks are parallel to the strut line AB at first contact, on either side of it. Every arc bulges
/// outwards and meets a flank before its widest point, so the outline is convex; clearances rely on that.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    segments: Vec<Segment>,
}

/// The strut line AB at first contact.
struct Strut {
    /// A.
    foot: Vector2<f64>,
    /// Unit vector from A to B.
    up: Vector2<f64>,
    /// Unit normal towards +x.
    front: Vector2<f64>,
}

impl Strut {
    fn new(profile: &Profile, first: &ProfileArc) -> Self {
        let foot = first.centre_m + first.radius_m * profile.contact_direction(0.0);
        let up = (Vector2::new(0.0, profile.outer_radius_m) - foot).normalize();
        Self { foot, up, front: Vector2::new(up.y, -up.x) }
    }

    /// Signed distance of a point from the strut line, m, positive in front.
    fn offset(&self, point: Vector2<f64>) -> f64 {
        self.front.dot(&(point - self.foot))
    }

    /// Half width at which a flank would only touch a circle, m.
    fn reach(&self, side: Side, centre: Vector2<f64>, radius: f64) -> f64 {
        radius + signed(side, self.offset(centre))
    }

    /// Front half width up to which the working profile reaches, m: offset of the last arc's end, because the
    /// offset grows with the turn.
    fn inner_need(&self, profile: &Profile, last: &ProfileArc) -> f64 {
        let end = profile.contact_direction(profile.end_turn_rad());
        self.offset(last.centre_m + last.radius_m * end)
    }

    /// Rear half width up to which the contacts on the outer arc reach, m.
    fn outer_need(&self, profile: &Profile, end_azimuth: f64) -> f64 {
        -self.offset(profile.outer_radius_m * along(end_azimuth))
    }
}

impl Outline {
    /// Close `profile` by two flanks parallel to the strut at first contact: `rear_m` from it towards
    /// negative x, `front_m` towards positive x. The first inner arc is continued to the rear flank and
    /// the last to the front flank.
    ///
    /// # Errors
    /// [`OutlineError`] where a flank misses an arc or cuts away part of the working profile: turns from
    /// 0 to the end of the last arc inside, and outside the contacts that go with them between rigid races.
    /// (Races under load move that end by some 1e-5 rad, and the contact has a width: leave room.)
    pub fn new(profile: &Profile, rear_m: f64, front_m: f64) -> Result<Self, OutlineError> {
        for (side, given_m) in [(Side::Rear, rear_m), (Side::Front, front_m)] {
            if !(given_m > 0.0 && given_m.is_finite()) {
                return Err(OutlineError::NotPositive { side, given_m });
            }
        }
        let (Some(first), Some(last)) = (profile.arcs.first(), profile.arcs.last()) else {
            return Err(OutlineError::NoArcs);
        };
        let r_e = profile.outer_radius_m;
        let strut = Strut::new(profile, first);
        let up = strut.up;
        // Turn at which the contact direction runs down the strut: omega of first contact.
        let d_0 = profile.contact_direction(0.0);
        let down_turn = d_0.perp(&-up).atan2(d_0.dot(&-up));

        let inner_turn = |centre: Vector2<f64>, radius: f64, side: Side, given_m: f64| {
            let x = signed(side, given_m) - strut.offset(centre);
            let reach_m = strut.reach(side, centre, radius);
            let miss = OutlineError::MissesInner { side, given_m, reach_m };
            if x.abs() < radius { Ok(down_turn + (x / radius).asin()) } else { Err(miss) }
        };
        let outer_azimuth = |side: Side, given_m: f64| {
            let x = signed(side, given_m) - strut.offset(Vector2::zeros());
            let reach_m = strut.reach(side, Vector2::zeros(), r_e);
            let miss = OutlineError::MissesOuter { side, given_m, reach_m };
            if x.abs() < r_e { Ok(up.x.atan2(up.y) + (x / r_e).asin()) } else { Err(miss) }
        };

        let from_turn = inner_turn(first.centre_m, first.radius_m, Side::Rear, rear_m)?;
        // Distance from the strut grows with the turn, so the first arc that meets the flank before its end is cut.
        for arc in &profile.arcs {
            if let Ok(turn) = inner_turn(arc.centre_m, arc.radius_m, Side::Front, front_m)
                && turn < arc.until_rad
            {
                let end = profile.end_turn_rad();
                let needed_m = strut.inner_need(profile, last);
                return Err(OutlineError::CutsInner { lost_rad: end - turn, given_m: front_m, needed_m });
            }
        }
        let until_turn = inner_turn(last.centre_m, last.radius_m, Side::Front, front_m)?;

        let front_azimuth = outer_azimuth(Side::Front, front_m)?;
        let rear_azimuth = outer_azimuth(Side::Rear, rear_m)?;
        let end_azimuth = outer_contact_azimuth(profile, profile.end_turn_rad());
        if end_azimuth < rear_azimuth {
            let needed_m = strut.outer_need(profile, end_azimuth);
            let lost_rad = rear_azimuth - end_azimuth;
            return Err(OutlineError::CutsOuter { lost_rad, given_m: rear_m, needed_m });
        }

        let mut segments = Vec::with_capacity(profile.arcs.len() + 3);
        for (k, arc) in profile.arcs.iter().enumerate() {
            let from = if k == 0 { from_turn } else { arc.from_rad };
            let until = if k + 1 == profile.arcs.len() { until_turn } else { arc.until_rad };
            segments.push(Segment::Arc {
                centre_m: arc.centre_m,
                radius_m: arc.radius_m,
                from_azimuth_rad: profile.beta0_rad + PI - from,
                sweep_rad: from - until,
            });
        }
        let outer = Segment::Arc {
            centre_m: Vector2::zeros(),
            radius_m: r_e,
            from_azimuth_rad: front_azimuth,
            sweep_rad: rear_azimuth - front_azimuth,
        };
        let rear_foot = first.centre_m + first.radius_m * profile.contact_direction(from_turn);
        let front_foot = last.centre_m + last.radius_m * profile.contact_direction(until_turn);
        for (side, low, high) in
            [(Side::Front, front_foot, outer.start_m()), (Side::Rear, rear_foot, outer.end_m())]
        {
            let height_m = up.dot(&(high - low));
            if height_m <= 0.0 {
                return Err(OutlineError::NoFlank { side, height_m });
            }
        }
        segments.push(Segment::Line { from_m: front_foot, to_m: outer.start_m() });
        segments.push(outer);
        segments.push(Segment::Line { from_m: outer.end_m(), to_m: rear_foot });
        Ok(Self { segments })
    }

    /// The narrowest sprag: flanks that keep the working profile and 5 % of half width (a choice) beyond it, or
    /// half of what the arcs leave where that is less. For drawings of a design that names no flanks.
    ///
    /// # Errors
    /// [`OutlineError`] where no flanks close the profile.
    pub fn narrowest(profile: &Profile) -> Result<Self, OutlineError> {
        let (rear_m, front_m) = Self::narrowest_flanks(profile)?;
        Self::new(profile, rear_m, front_m)
    }

    /// Distances of the flanks of [`Outline::narrowest`] from the strut, rear and front, m.
    ///
    /// # Errors
    /// [`OutlineError::NoArcs`]; whether the flanks close the profile is seen when they do.
    pub fn narrowest_flanks(profile: &Profile) -> Result<(f64, f64), OutlineError> {
        let (Some(first), Some(last)) = (profile.arcs.first(), profile.arcs.last()) else {
            return Err(OutlineError::NoArcs);
        };
        let strut = Strut::new(profile, first);
        let half_width = |side: Side, need: f64, arc: &ProfileArc| {
            let inner = strut.reach(side, arc.centre_m, arc.radius_m);
            let reach = inner.min(strut.reach(side, Vector2::zeros(), profile.outer_radius_m));
            (BEYOND * need).min(0.5 * (need + reach))
        };
        let end_azimuth = outer_contact_azimuth(profile, profile.end_turn_rad());
        let rear_m = half_width(Side::Rear, strut.outer_need(profile, end_azimuth), first);
        let front_m = half_width(Side::Front, strut.inner_need(profile, last), last);
        Ok((rear_m, front_m))
    }

    /// Segments in order, each beginning where the one before ends.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// Vertices on the outline, m, counterclockwise, the first not repeated. No chord is farther from its
    /// arc than `tolerance_m`, m, unless that asks for more than 4096 chords on one arc.
    pub fn polyline(&self, tolerance_m: f64) -> Vec<[f64; 2]> {
        let mut vertices = Vec::new();
        for segment in &self.segments {
            let chords = match *segment {
                Segment::Line { .. } => 1.0,
                Segment::Arc { radius_m, sweep_rad, .. } => {
                    // Sagitta r (1 - cos(step/2)) = 2 r sin^2(step/4).
                    let step = 4.0 * (tolerance_m.max(0.0) / (2.0 * radius_m)).min(0.5).sqrt().asin();
                    (sweep_rad.abs() / step).ceil().clamp(1.0, CHORDS_AT_MOST)
                }
            };
            for i in 0..chords as usize {
                let point = segment.at(i as f64 / chords);
                vertices.push([point.x, point.y]);
            }
        }
        vertices
    }

    /// A convex counterclockwise outline from its segments, for planted answers.
    #[cfg(test)]
    pub(super) fn planted(segments: Vec<Segment>) -> Self {
        Self { segments }
    }
}

/// Offset from the strut line of a flank `half_width` from it.
fn signed(side: Side, half_width: f64) -> f64 {
    match side {
        Side::Rear => -half_width,
        Side::Front => half_width,
    }
}

/// Azimuth of the outer contact in the body when the inner contact has turned by `turn` between rigid
/// races: O lies R_i + r_k from C_k along the contact direction, B on the far side of C_e from O.
fn outer_contact_azimuth(profile: &Profile, turn: f64) -> f64 {
    let (Some(first), Some(arc)) =
        (profile.arcs.first(), profile.arcs.iter().find(|a| turn <= a.until_rad).or(profile.arcs.last()))
    else {
        return 0.0;
    };
    let inner_race =
        (first.centre_m + Vector2::new(0.0, profile.outer_centre_distance_m)).norm() - first.radius_m;
    let axis = arc.centre_m + (inner_race + arc.radius_m) * profile.contact_direction(turn);
    (-axis.x).atan2(-axis.y)
}

#[cfg(test)]
mod tests;
