//! The closed outline of a sprag: inner arcs, front flank, outer arc, rear flank.

use super::flank::{Flank, Flanks, Strut};
use super::{FlankSide, OutlineError, Profile, ProfileArc};
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

    /// The segment turned about the origin by `turn_rad` towards larger azimuths, then shifted, m.
    pub fn moved(&self, turn_rad: f64, shift_m: Vector2<f64>) -> Self {
        let (sin, cos) = turn_rad.sin_cos();
        let place = |v: Vector2<f64>| Vector2::new(v.x * cos + v.y * sin, v.y * cos - v.x * sin) + shift_m;
        match *self {
            Self::Line { from_m, to_m } => Self::Line { from_m: place(from_m), to_m: place(to_m) },
            Self::Arc { centre_m, radius_m, from_azimuth_rad, sweep_rad } => Self::Arc {
                centre_m: place(centre_m),
                radius_m,
                from_azimuth_rad: from_azimuth_rad + turn_rad,
                sweep_rad,
            },
        }
    }

    /// Points on the segment, m, its first but not its last. No chord between them is farther from the arc than
    /// `tolerance_m`, m, unless that asks for more than 4096 chords.
    pub fn points_m(&self, tolerance_m: f64) -> Vec<[f64; 2]> {
        let chords = match *self {
            Self::Line { .. } => 1.0,
            Self::Arc { radius_m, sweep_rad, .. } => {
                // Sagitta r (1 - cos(step/2)) = 2 r sin^2(step/4).
                let step = 4.0 * (tolerance_m.max(0.0) / (2.0 * radius_m)).min(0.5).sqrt().asin();
                (sweep_rad.abs() / step).ceil().clamp(1.0, CHORDS_AT_MOST)
            }
        };
        let points = (0..chords as usize).map(|i| self.at(i as f64 / chords));
        points.map(|point| [point.x, point.y]).collect()
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
/// The flanks stand on either side of the strut line AB at first contact, parallel to it or leaning. Every arc bulges
/// outwards and crosses a flank, never touches it, and both contacts lie inside, so the outline is convex; clearances
/// rely on that.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    segments: Vec<Segment>,
}

impl Outline {
    /// Close `profile` by two flanks parallel to the strut at first contact: `rear_m` from it towards
    /// negative x, `front_m` towards positive x.
    ///
    /// # Errors
    /// As [`Outline::closed`].
    pub fn new(profile: &Profile, rear_m: f64, front_m: f64) -> Result<Self, OutlineError> {
        Self::closed(profile, &Flanks::parallel(rear_m, front_m))
    }

    /// Close `profile` by `flanks`. The first inner arc is continued to the rear flank and the last to the front
    /// flank.
    ///
    /// # Errors
    /// [`OutlineError`] where a flank misses an arc or cuts away part of the working profile: turns from
    /// 0 to the end of the last arc inside, and outside the contacts that go with them between rigid races.
    /// (Races under load move that end by some 1e-5 rad, and the contact has a width: leave room.)
    pub fn closed(profile: &Profile, flanks: &Flanks) -> Result<Self, OutlineError> {
        let (Some(first), Some(last)) = (profile.arcs.first(), profile.arcs.last()) else {
            return Err(OutlineError::NoArcs);
        };
        let r_e = profile.outer_radius_m;
        let strut = Strut::new(profile, first);
        let rear = Flank::new(&strut, FlankSide::Rear, flanks)?;
        let front = Flank::new(&strut, FlankSide::Front, flanks)?;

        // Turn at which the contact direction runs down the flank, and from there to where the flank cuts the arc.
        let inner_turn = |flank: &Flank, arc: &ProfileArc| {
            let d_0 = profile.contact_direction(0.0);
            let down_turn = d_0.perp(&-flank.up).atan2(d_0.dot(&-flank.up));
            let (side, given_m) = (flank.side, flank.given_m());
            let reach_m = flank.reach(arc.centre_m, arc.radius_m);
            let bite = flank.bite(arc.centre_m, arc.radius_m);
            bite.map(|b| down_turn + flank.sign * b).ok_or(OutlineError::MissesInner {
                side,
                given_m,
                reach_m,
            })
        };
        let outer_azimuth = |flank: &Flank| {
            let (side, given_m) = (flank.side, flank.given_m());
            let reach_m = flank.reach(Vector2::zeros(), r_e);
            let bite = flank.bite(Vector2::zeros(), r_e);
            bite.map(|b| flank.up.x.atan2(flank.up.y) + flank.sign * b).ok_or(OutlineError::MissesOuter {
                side,
                given_m,
                reach_m,
            })
        };

        let from_turn = inner_turn(&rear, first)?;
        // Distance from the strut grows with the turn, so the first arc that meets the flank before its end is cut.
        for arc in &profile.arcs {
            if let Ok(turn) = inner_turn(&front, arc)
                && turn < arc.until_rad
            {
                let lost_rad = profile.end_turn_rad() - turn;
                let needed_m = front.need(inner_end(profile, last));
                return Err(OutlineError::CutsInner { lost_rad, given_m: front.given_m(), needed_m });
            }
        }
        let until_turn = inner_turn(&front, last)?;

        let front_azimuth = outer_azimuth(&front)?;
        let rear_azimuth = outer_azimuth(&rear)?;
        let end_azimuth = profile.outer_contact_azimuth(profile.end_turn_rad());
        if end_azimuth < rear_azimuth {
            let needed_m = rear.need(r_e * along(end_azimuth));
            let lost_rad = rear_azimuth - end_azimuth;
            return Err(OutlineError::CutsOuter { lost_rad, given_m: rear.given_m(), needed_m });
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
        for (flank, low, high) in [(&front, front_foot, outer.start_m()), (&rear, rear_foot, outer.end_m())] {
            let height_m = flank.up.dot(&(high - low));
            if height_m <= 0.0 {
                return Err(OutlineError::NoFlank { side: flank.side, height_m });
            }
        }
        segments.push(Segment::Line { from_m: front_foot, to_m: outer.start_m() });
        segments.push(outer);
        segments.push(Segment::Line { from_m: outer.end_m(), to_m: rear_foot });
        Ok(Self { segments })
    }

    /// What is left until flanks no longer close the profile, each over the half width given, positive where they do:
    /// at the rear and in front, [inside, outside] - inside until one cuts a contact or the working profile, outside
    /// until it misses an arc.
    ///
    /// # Errors
    /// [`OutlineError`] where a half width or a lean is out of range or leaves a contact outside.
    pub fn room(profile: &Profile, flanks: &Flanks) -> Result<[[f64; 2]; 2], OutlineError> {
        let (Some(first), Some(last)) = (profile.arcs.first(), profile.arcs.last()) else {
            return Err(OutlineError::NoArcs);
        };
        let strut = Strut::new(profile, first);
        let outer_end = profile.outer_radius_m * along(profile.outer_contact_azimuth(profile.end_turn_rad()));
        let side = |side: FlankSide, end: Vector2<f64>, arc: &ProfileArc| -> Result<[f64; 2], OutlineError> {
            let flank = Flank::new(&strut, side, flanks)?;
            let given = flank.given_m();
            let need = flank.need(end).max(flank.need(strut.a)).max(flank.need(strut.b));
            let reach = flank.reach(arc.centre_m, arc.radius_m);
            let reach = reach.min(flank.reach(Vector2::zeros(), profile.outer_radius_m));
            Ok([(given - need) / given, (reach - given) / given])
        };
        Ok([
            side(FlankSide::Rear, outer_end, first)?,
            side(FlankSide::Front, inner_end(profile, last), last)?,
        ])
    }

    /// The narrowest sprag: parallel flanks that keep the working profile and 5 % of half width (a choice) beyond it,
    /// or half of what the arcs leave where that is less. For drawings of a design that names no flanks.
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
        let half_width = |[need, reach]: [f64; 2]| (BEYOND * need).min(0.5 * (need + reach));
        let [rear, front] = Self::flank_window(profile)?;
        Ok((half_width(rear), half_width(front)))
    }

    /// Distances from the strut between which parallel flanks close the profile, rear and front, m: what its contacts need, and how
    /// far the arcs reach.
    ///
    /// # Errors
    /// [`OutlineError::NoArcs`].
    pub fn flank_window(profile: &Profile) -> Result<[[f64; 2]; 2], OutlineError> {
        let (Some(first), Some(last)) = (profile.arcs.first(), profile.arcs.last()) else {
            return Err(OutlineError::NoArcs);
        };
        let strut = Strut::new(profile, first);
        // Any half width shows the needs of a parallel flank.
        let any = Flanks::parallel(profile.outer_radius_m, profile.outer_radius_m);
        let (rear, front) =
            (Flank::new(&strut, FlankSide::Rear, &any)?, Flank::new(&strut, FlankSide::Front, &any)?);
        let window = |flank: &Flank, end: Vector2<f64>, arc: &ProfileArc| {
            let inner = flank.reach(arc.centre_m, arc.radius_m);
            [flank.need(end), inner.min(flank.reach(Vector2::zeros(), profile.outer_radius_m))]
        };
        let outer_end = profile.outer_radius_m * along(profile.outer_contact_azimuth(profile.end_turn_rad()));
        Ok([window(&rear, outer_end, first), window(&front, inner_end(profile, last), last)])
    }

    /// Where the surfaces that this outline gives `profile` to roll on end; `None` where it is not the outline of such a profile.
    pub fn brink(&self, profile: &Profile) -> Option<Brink> {
        let last = profile.arcs.len().checked_sub(1)?;
        let [inner, flank, outer, rear] = [0, 1, 2, 3].map(|k| self.segments.get(last + k));
        // The outward normal at a turn has the azimuth beta_0 + pi - turn.
        let turn = |azimuth: f64| profile.beta0_rad + PI - azimuth;
        let edge_turn_rad = turn(inner?.normal_azimuths().1);
        let flat = turn(flank?.normal_azimuths().0);
        Some(Brink {
            edge_turn_rad,
            flank_turn_rad: edge_turn_rad + (flat - edge_turn_rad).rem_euclid(2.0 * PI),
            outer_edge_m: outer?.end_m(),
            rear_azimuth_rad: outer?.normal_azimuths().1,
            rear_flank_azimuth_rad: rear?.normal_azimuths().0,
        })
    }

    /// Segments in order, each beginning where the one before ends.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// Vertices on the outline, m, counterclockwise, the first not repeated. No chord is farther from its
    /// arc than `tolerance_m`, m, unless that asks for more than 4096 chords on one arc.
    pub fn polyline(&self, tolerance_m: f64) -> Vec<[f64; 2]> {
        self.segments.iter().flat_map(|segment| segment.points_m(tolerance_m)).collect()
    }

    /// A convex counterclockwise outline from its segments, for planted answers.
    #[cfg(test)]
    pub(super) fn planted(segments: Vec<Segment>) -> Self {
        Self { segments }
    }
}

/// Where the surfaces that a sprag rolls on end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Brink {
    /// Turn at which the last inner arc ends at the front flank, rad.
    pub edge_turn_rad: f64,
    /// Turn at which the sprag has pivoted over that edge until its flank lies on the race, rad.
    pub flank_turn_rad: f64,
    /// The edge between the outer arc and the rear flank, m.
    pub outer_edge_m: Vector2<f64>,
    /// Azimuth in the body at which the outer arc ends there, rad.
    pub rear_azimuth_rad: f64,
    /// Azimuth of the rear flank's outward normal, rad.
    pub rear_flank_azimuth_rad: f64,
}

/// Where the working profile ends on the last inner arc, m.
fn inner_end(profile: &Profile, last: &ProfileArc) -> Vector2<f64> {
    last.centre_m + last.radius_m * profile.contact_direction(profile.end_turn_rad())
}

impl Profile {
    /// Azimuth of the outer contact in the body, rad, when the inner contact has turned by `turn` between rigid
    /// races: O lies R_i + r_k from C_k along the contact direction, B on the far side of C_e from O.
    pub(crate) fn outer_contact_azimuth(&self, turn: f64) -> f64 {
        let (Some(first), Some(arc)) =
            (self.arcs.first(), self.arcs.iter().find(|a| turn <= a.until_rad).or(self.arcs.last()))
        else {
            return 0.0;
        };
        let inner_race =
            (first.centre_m + Vector2::new(0.0, self.outer_centre_distance_m)).norm() - first.radius_m;
        let axis = arc.centre_m + (inner_race + arc.radius_m) * self.contact_direction(turn);
        (-axis.x).atan2(-axis.y)
    }
}

#[cfg(test)]
mod tests;
