//! The sprag's profile: tangent inner arcs, the outer arc, flanks, and what follows from the outline.
//!
//! In: radii, centre distance, junction turns, race radii at rest. Out: [`Profile`] (arc centres in the
//! body frame), [`Outline`], [`MassProperties`], neighbour clearance. Absent: deformation and load.
//! Equations: the tangency rule C_{k+1} = C_k + (r_k - r_{k+1}) d_k; beta of (9) at first contact; Green's theorem.
//!
//! # Conventions
//! Body frame: origin C_e, y radially outward along OC_e at first contact at rest, x towards positive
//! azimuth. Azimuths are measured from +y towards +x. Turn is the angle through which the contact
//! direction has turned in the body since first contact at rest, positive in engagement. In engagement
//! the body rotates towards positive azimuth (it is the only sense in which A, ahead of B, falls back
//! and the strut steepens), so the contact direction turns the other way in the body: from -y towards +x.

mod crowding;
mod curvature;
mod flank;
mod mass;
mod outline;
#[cfg(test)]
mod properties;
mod reseat;
mod spiral;
mod unclosed;

pub use crowding::{clearance_m, clearances_m, least_pitch_rad, touch_rotation_rad};
pub use curvature::PatchCurvature;
pub use flank::{Flanks, STEEPEST_RAD};
pub use mass::MassProperties;
pub use outline::{Brink, Outline, Segment};
pub use reseat::Reseated;
pub use spiral::{Spiral, SpiralDeviation, Support};
pub use unclosed::{FlankSide, OutlineError};

use nalgebra::Vector2;

/// One inner arc, placed in the body frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProfileArc {
    /// Radius r_ik, m.
    pub radius_m: f64,
    /// Centre C_k, m.
    pub centre_m: Vector2<f64>,
    /// Turn at which the arc begins, rad (minus infinity is not used: arc 1 begins at 0).
    pub from_rad: f64,
    /// Turn at which the arc ends, rad.
    pub until_rad: f64,
}

/// Sprag profile placed in the body frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// Outer arc radius r_e about the origin, m.
    pub outer_radius_m: f64,
    /// Azimuth beta_0 of C_1 ahead of C_e seen from O at first contact at rest, rad.
    pub beta0_rad: f64,
    /// Distance OC_e at first contact at rest, R_e - r_e, m.
    pub outer_centre_distance_m: f64,
    /// Inner arcs in order of engagement.
    pub arcs: Vec<ProfileArc>,
}

/// Why a set of radii is no profile.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ProfileError {
    /// The sprag does not span the gap: no position touches both races.
    /// `reach_m` = r_e + r_i1 + e_1 must exceed the race gap `gap_m`, and r_e + r_i1 - e_1 must be below it.
    #[error("the sprag is {:.4} to {:.4} mm high, the race gap {:.4} mm: no position touches both races",
        .least_m * 1e3, .reach_m * 1e3, .gap_m * 1e3)]
    DoesNotSpan {
        /// Smallest height of the sprag over the arcs, m.
        least_m: f64,
        /// Largest height, m.
        reach_m: f64,
        /// Race gap R_e - R_i, m.
        gap_m: f64,
    },
    /// Arc `index` (from 0) does not end after it begins.
    #[error("inner arc {} does not end after it begins", .index + 1)]
    ArcsOutOfOrder {
        /// Index of the arc.
        index: usize,
    },
}

impl Profile {
    /// Place the arcs. `arcs` holds (radius m, end turn rad) in order of engagement; race radii are those
    /// at rest, m.
    ///
    /// # Errors
    /// [`ProfileError`] where triangle (9) has no solution at first contact or arcs are out of order.
    pub fn new(
        outer_radius_m: f64,
        centre_distance_m: f64,
        arcs: &[(f64, f64)],
        inner_race_m: f64,
        outer_race_m: f64,
    ) -> Result<Self, ProfileError> {
        let oc_i = inner_race_m + arcs[0].0;
        let oc_e = outer_race_m - outer_radius_m;
        let e = centre_distance_m;
        let Some(beta0) = azimuth_between(oc_i, oc_e, e) else {
            let height = outer_radius_m + arcs[0].0;
            return Err(ProfileError::DoesNotSpan {
                least_m: height - e,
                reach_m: height + e,
                gap_m: outer_race_m - inner_race_m,
            });
        };
        let mut placed: Vec<ProfileArc> = Vec::with_capacity(arcs.len());
        let mut centre = Vector2::new(oc_i * beta0.sin(), oc_i * beta0.cos() - oc_e);
        let mut from = 0.0;
        for (k, &(radius, until)) in arcs.iter().enumerate() {
            if until.partial_cmp(&from) != Some(std::cmp::Ordering::Greater) {
                return Err(ProfileError::ArcsOutOfOrder { index: k });
            }
            if let Some(last) = placed.last() {
                // Tangency at the junction: C_{k+1} = C_k + (r_k - r_{k+1}) d_k.
                centre += (last.radius_m - radius) * direction(beta0, from);
            }
            placed.push(ProfileArc { radius_m: radius, centre_m: centre, from_rad: from, until_rad: until });
            from = until;
        }
        Ok(Self { outer_radius_m, beta0_rad: beta0, outer_centre_distance_m: oc_e, arcs: placed })
    }

    /// Unit vector in the body frame from an arc's centre to the contact when the contact direction has
    /// turned by `turn_rad`.
    pub fn contact_direction(&self, turn_rad: f64) -> Vector2<f64> {
        direction(self.beta0_rad, turn_rad)
    }

    /// Unit vector in the body frame along which the contact travels at that turn: the derivative of the direction.
    pub fn way(&self, turn_rad: f64) -> Vector2<f64> {
        let n = self.contact_direction(turn_rad);
        Vector2::new(-n.y, n.x)
    }

    /// Turn at which the last arc ends, rad.
    pub fn end_turn_rad(&self) -> f64 {
        self.arcs.last().map_or(0.0, |a| a.until_rad)
    }
}

/// Angle beta at O, rad, of the triangle O C_i C_e with the sides OC_i, OC_e and C_iC_e, m; `None` unless it is one with less
/// than a right angle there. (9) with its first line taken by half angles, cos beta = 1 - 2 sin^2(beta/2), for digits.
pub(crate) fn azimuth_between(oc_i: f64, oc_e: f64, centre_distance: f64) -> Option<f64> {
    let versed = (centre_distance * centre_distance - (oc_i - oc_e).powi(2)) / (2.0 * oc_i * oc_e);
    (versed > 0.0 && versed < 1.0 && oc_e > 0.0).then(|| 2.0 * (0.5 * versed).sqrt().asin())
}

fn direction(beta0: f64, turn: f64) -> Vector2<f64> {
    let azimuth = beta0 - turn;
    -Vector2::new(azimuth.sin(), azimuth.cos())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arcs_meet_with_one_tangent_at_every_junction() {
        let p = Profile::new(
            4.68e-3,
            0.62e-3,
            &[(4.02e-3, 0.06), (4.08e-3, 0.12), (4.15e-3, 0.45)],
            11.11e-3,
            19.44e-3,
        )
        .unwrap();
        for pair in p.arcs.windows(2) {
            let d = p.contact_direction(pair[0].until_rad);
            let end = pair[0].centre_m + pair[0].radius_m * d;
            let start = pair[1].centre_m + pair[1].radius_m * d;
            assert!((end - start).norm() < 1e-17);
        }
        assert!((p.arcs[0].centre_m.norm() - 0.62e-3).abs() < 1e-15);
    }
}
