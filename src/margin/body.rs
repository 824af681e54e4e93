//! Yield of the sprag's body under the strut force.

use super::load::LoadState;
use crate::design::Design;
use crate::wedge::StaticPoint;

/// Largest compressive stress in the sprag's narrowest section, Pa, positive; 0 where no flanks bound it.
///
/// The section is b wide (flank to flank, they are parallel) and l long, half way between A and B. The strut force
/// F = N_bi/cos omega acts along AB; the line AB has moved off the middle of the section by e, so
/// sigma = F/(b l) (1 + 6 e/b), a short prism under an eccentric load (Young and Budynas, *Roark's Formulas for Stress
/// and Strain*, 7th ed., 12.4). Notches, residual stress and the pressure at the contacts are not in it.
pub(super) fn body_stress_pa(design: &Design, state: &LoadState, p: &StaticPoint) -> f64 {
    let sprags = &design.clutch.sprags;
    let Some(flanks) = sprags.flanks else { return 0.0 };
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
    let Some(((a0, b0), (a, b))) = middle(0.0, 0.0, 0).zip(middle(p.contact_turn_rad, rotation, p.arc))
    else {
        return 0.0;
    };
    // Across the strut line at first contact, from rear to front.
    let along = (b0 - a0).normalize();
    let across = nalgebra::Vector2::new(along.y, -along.x);
    let middle_m = 0.5 * (flanks.front_m - flanks.rear_m);
    let off_m = (0.5 * (a + b) - a0).dot(&across) - middle_m;
    force_n / (width_m * sprags.length_m) * (1.0 + 6.0 * off_m.abs() / width_m)
}
