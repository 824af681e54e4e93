//! The same sprag between other races: what first contact at rest, from which turns and the body frame count, becomes.

use super::flank::{Flank, Flanks, Strut};
use super::outline::along;
use super::{FlankSide, Profile, ProfileError};
use nalgebra::Vector2;
use std::f64::consts::{PI, TAU};

/// A sprag as its profile reads between other races.
#[derive(Debug, Clone, PartialEq)]
pub struct Reseated {
    /// Outer arc radius, m.
    pub outer_radius_m: f64,
    /// Distance of the centres of the outer arc and of the arc that now touches first, m.
    pub centre_distance_m: f64,
    /// (radius m, turn at which it ends, rad) of the arcs that are left, in order of engagement.
    pub arcs: Vec<(f64, f64)>,
    /// Turn of the new first contact, counted from the old one, rad; positive in a wider gap.
    pub turn_rad: f64,
    /// By how much azimuths in the old body frame exceed those in the new one, rad.
    frame_rad: f64,
    /// A, B in the old frame.
    strut: [Vector2<f64>; 2],
}

impl Profile {
    /// This sprag, its arcs made `outer_m` and `inner_m` larger about the same centres, between races of other radii,
    /// m. Arcs that first contact now lies beyond drop out.
    ///
    /// # Errors
    /// [`ProfileError::DoesNotSpan`] where no arc touches both races.
    pub fn reseated(
        &self,
        outer_m: f64,
        inner_m: f64,
        inner_race_m: f64,
        outer_race_m: f64,
    ) -> Result<Reseated, ProfileError> {
        let r_e = self.outer_radius_m + outer_m;
        let oc_e = outer_race_m - r_e;
        for (k, arc) in self.arcs.iter().enumerate() {
            let (c, r) = (arc.centre_m, arc.radius_m + inner_m);
            // O lies oc_e from C_e and inner_race + r from C_k, on the side on which C_k is ahead of C_e.
            let (e, oc_k) = (c.norm(), inner_race_m + r);
            let towards = (e * e + oc_e * oc_e - oc_k * oc_k) / (2.0 * e);
            let across = oc_e * oc_e - towards * towards;
            if !(across > 0.0 && oc_e > 0.0) {
                continue;
            }
            let unit = c / e;
            let axis = towards * unit + across.sqrt() * Vector2::new(unit.y, -unit.x);
            let axis = if ahead(axis, c) {
                axis
            } else {
                towards * unit - across.sqrt() * Vector2::new(unit.y, -unit.x)
            };
            let seen = axis - c;
            // Contact direction: azimuth beta_0 + pi - turn.
            let turn = wrapped(self.beta0_rad + PI - seen.x.atan2(seen.y));
            let begins = if k == 0 { f64::NEG_INFINITY } else { arc.from_rad };
            if turn <= begins || turn >= arc.until_rad {
                continue;
            }
            let arcs = self.arcs[k..].iter().map(|a| (a.radius_m + inner_m, a.until_rad - turn)).collect();
            let frame_rad = (-axis.x).atan2(-axis.y);
            let contact = c + r * seen.normalize();
            let strut = [contact, r_e * along(frame_rad)];
            return Ok(Reseated {
                outer_radius_m: r_e,
                centre_distance_m: e,
                arcs,
                turn_rad: turn,
                frame_rad,
                strut,
            });
        }
        let first = self.arcs.first().map_or(0.0, |a| a.radius_m + inner_m);
        let e = self.arcs.first().map_or(0.0, |a| a.centre_m.norm());
        Err(ProfileError::DoesNotSpan {
            least_m: r_e + first - e,
            reach_m: r_e + first + e,
            gap_m: outer_race_m - inner_race_m,
        })
    }
}

impl Reseated {
    /// A point of the body in the new frame, m.
    pub fn point_m(&self, old_m: [f64; 2]) -> [f64; 2] {
        let p = self.moved(old_m.into());
        [p.x, p.y]
    }

    /// The flanks of the same body, measured from the new strut line; `None` where they no longer stand beside it.
    pub fn flanks(&self, profile: &Profile, flanks: &Flanks) -> Option<Flanks> {
        let strut = Strut::new(profile, profile.arcs.first()?);
        let [a, b] = self.strut;
        let (middle, up) = (0.5 * (a + b), (b - a).normalize());
        let front = Vector2::new(up.y, -up.x);
        let side = |side: FlankSide| {
            let flank = Flank::new(&strut, side, flanks).ok()?;
            let tilt = (flank.sign * flank.up.dot(&front)).atan2(flank.up.dot(&up));
            Some((-flank.need(middle) + flank.given_m(), tilt, flank))
        };
        // The flank meets the new normal through the new middle: its half width there.
        let width = |(apart, tilt, flank): (f64, f64, Flank)| (apart * flank.cos_tilt() / tilt.cos(), tilt);
        let (rear_m, rear_tilt_rad) = width(side(FlankSide::Rear)?);
        let (front_m, front_tilt_rad) = width(side(FlankSide::Front)?);
        Some(Flanks { rear_m, front_m, rear_tilt_rad, front_tilt_rad })
    }

    fn moved(&self, p: Vector2<f64>) -> Vector2<f64> {
        let (sin, cos) = self.frame_rad.sin_cos();
        Vector2::new(p.x * cos - p.y * sin, p.y * cos + p.x * sin)
    }
}

/// Whether a centre lies ahead of C_e (the origin) seen from the axis.
fn ahead(axis: Vector2<f64>, centre: Vector2<f64>) -> bool {
    // Azimuths grow clockwise: from the ray to C_e on to the ray to the centre.
    (centre - axis).perp(&(-axis)) > 0.0
}

fn wrapped(angle: f64) -> f64 {
    let turned = angle.rem_euclid(TAU);
    if turned > PI { turned - TAU } else { turned }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::profile::Outline;
    use crate::profile::properties::table_1;

    const ARCS: [(f64, f64); 3] = [(4.02e-3, 0.06), (4.08e-3, 0.12), (4.15e-3, 0.45)];

    fn new_profile(r: &Reseated, inner: f64, outer: f64) -> Profile {
        Profile::new(r.outer_radius_m, r.centre_distance_m, &r.arcs, inner, outer).unwrap()
    }

    #[test]
    fn the_same_races_change_nothing() {
        let p = table_1(&ARCS);
        let r = p.reseated(0.0, 0.0, 11.11e-3, 19.44e-3).unwrap();
        assert!(r.turn_rad.abs() < 1e-13 && (r.centre_distance_m - 0.62e-3).abs() < 1e-17);
        let flanks = Flanks { rear_tilt_rad: 0.1, front_tilt_rad: -0.05, ..Flanks::parallel(2.5e-3, 2.6e-3) };
        let same = r.flanks(&p, &flanks).unwrap();
        assert!((same.rear_m - flanks.rear_m).abs() < 1e-16 && (same.front_tilt_rad + 0.05).abs() < 1e-13);
        assert!((r.point_m([0.2e-3, 0.5e-3])[0] - 0.2e-3).abs() < 1e-17);
    }

    /// Radii, and distances between any two centres and the centroid, belong to the body: no gap changes them. The
    /// outline of the sprag in the new frame weighs the same about the moved centroid.
    #[test]
    fn another_gap_sees_the_same_body() {
        let p = table_1(&ARCS);
        let flanks =
            Flanks { rear_tilt_rad: 0.08, front_tilt_rad: -0.05, ..Flanks::parallel(2.5e-3, 2.7e-3) };
        let before = Outline::closed(&p, &flanks).unwrap().mass_properties(6e-3, 7850.0);
        for wider in [-20e-6, -5e-6, 5e-6, 15e-6, 60e-6] {
            let (inner, outer) = (11.11e-3 - 0.3 * wider, 19.44e-3 + 0.7 * wider);
            let r = p.reseated(0.0, 0.0, inner, outer).unwrap();
            let q = new_profile(&r, inner, outer);
            assert_eq!(r.turn_rad > 0.0, wider > 0.0);
            let dropped = p.arcs.len() - q.arcs.len();
            assert_eq!(dropped, usize::from(r.turn_rad > 0.06) + usize::from(r.turn_rad > 0.12));
            for (i, arc) in q.arcs.iter().enumerate() {
                let old = &p.arcs[i + dropped];
                assert!((arc.centre_m.norm() - old.centre_m.norm()).abs() < 1e-16);
                let moved = r.point_m([old.centre_m.x, old.centre_m.y]);
                assert!((arc.centre_m - Vector2::from(moved)).norm() < 1e-15, "{wider} {i}");
            }
            let after =
                Outline::closed(&q, &r.flanks(&p, &flanks).unwrap()).unwrap().mass_properties(6e-3, 7850.0);
            let g = r.point_m(before.centroid_m);
            if dropped == 0 {
                assert!((after.mass_kg / before.mass_kg - 1.0).abs() < 1e-12, "{wider}");
                assert!((after.inertia_kg_m2 / before.inertia_kg_m2 - 1.0).abs() < 1e-12);
                assert!((Vector2::from(g) - Vector2::from(after.centroid_m)).norm() < 1e-15);
            } else {
                // The arc that dropped out is no longer known to end where it did: 1 % of mass at most.
                assert!((after.mass_kg / before.mass_kg - 1.0).abs() < 1e-2, "{wider}");
            }
        }
    }

    /// Rolling the rigid sprag to a turn, and asking for the gap that it then spans: the inverse of `reseated`.
    #[test]
    fn a_turn_spans_the_gap_that_gives_it_back() {
        let p = table_1(&ARCS);
        for turn in [-0.03, 0.02, 0.09, 0.3] {
            let arc = p.arcs.iter().find(|a| turn <= a.until_rad).unwrap();
            // O on the contact normal, R_i + r_k from C_k; the outer race must reach C_e from there.
            let axis = arc.centre_m + (11.11e-3 + arc.radius_m) * p.contact_direction(turn);
            let outer = axis.norm() + p.outer_radius_m;
            let r = p.reseated(0.0, 0.0, 11.11e-3, outer).unwrap();
            assert!((r.turn_rad - turn).abs() < 1e-12, "{turn} {}", r.turn_rad);
        }
    }

    #[test]
    fn larger_arcs_are_a_narrower_gap() {
        let p = table_1(&ARCS);
        let larger = p.reseated(0.0, 3e-6, 11.11e-3, 19.44e-3).unwrap();
        let narrower = p.reseated(0.0, 0.0, 11.113e-3, 19.44e-3).unwrap();
        assert!(larger.turn_rad < 0.0 && (larger.turn_rad - narrower.turn_rad).abs() < 1e-12);
        assert!(p.reseated(0.0, 0.0, 11.11e-3, 22e-3).is_err());
    }
}
