//! Yield and fatigue of the sprag's body under the strut force.

use super::load::LoadState;
use crate::design::Design;
use crate::wedge::StaticPoint;

/// Largest compressive stress in the sprag's narrowest section, Pa, positive; 0 where no flanks bound it.
pub(super) fn body_stress_pa(design: &Design, state: &LoadState, p: &StaticPoint) -> f64 {
    body_flanks_pa(design, state, p).map_or(0.0, |[front, rear]| -front.min(rear))
}

/// Stress along the strut at the front and the rear flank of the sprag's narrowest section, Pa, tension positive; `None` where no
/// flanks bound it.
///
/// The section is b wide (flank to flank, they are parallel) and l long, half way between A and B. The strut force
/// F = N_bi/cos omega acts along AB; the line AB has moved off the middle of the section by e towards the front, so
/// sigma = -F/(b l) (1 +- 6 e/b), a short prism under an eccentric load (Young and Budynas, *Roark's Formulas for Stress
/// and Strain*, 7th ed., 12.4). Notches, residual stress and the pressure at the contacts are not in it.
pub fn body_flanks_pa(design: &Design, state: &LoadState, p: &StaticPoint) -> Option<[f64; 2]> {
    let sprags = &design.clutch.sprags;
    let flanks = sprags.flanks?;
    let width_m = flanks.rear_m + flanks.front_m;
    let force_n = p.normal_inner_n * p.tan_omega.hypot(1.0);
    let middle = |turn_rad: f64, rotation_rad: f64, arc: usize| {
        let profile = &state.profile;
        let arc = profile.arcs.get(arc)?;
        let a = arc.centre_m + arc.radius_m * profile.contact_direction(turn_rad);
        // B lies straight outward of C_e, at azimuth -rotation in the body.
        let (s, c) = rotation_rad.sin_cos();
        let b = profile.outer_radius_m * nalgebra::Vector2::new(-s, c);
        Some((a, b))
    };
    let rotation = state.curve.closure_at_normal(p.normal_inner_n).map_or(0.0, |(_, c)| c.rotation.v);
    let ((a0, b0), (a, b)) = middle(0.0, 0.0, 0).zip(middle(p.contact_turn_rad, rotation, p.arc))?;
    // Across the strut line at first contact, from rear to front.
    let along = (b0 - a0).normalize();
    let across = nalgebra::Vector2::new(along.y, -along.x);
    let middle_m = 0.5 * (flanks.front_m - flanks.rear_m);
    let off_m = (0.5 * (a + b) - a0).dot(&across) - middle_m;
    let even_pa = force_n / (width_m * sprags.length_m);
    Some([1.0, -1.0].map(|side| -even_pa * (1.0 + side * 6.0 * off_m / width_m)))
}
