//! Largest pressure along the contacts, end profile and tilt included.

use super::load::LoadCase;
use crate::wedge::{Side, StaticPoint, along_drawn};
use std::f64::consts::PI;

/// Part of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reach {
    /// Its middle half.
    Middle,
    /// The quarters beside that.
    Ends,
}

/// Share of the length that is the middle: fixed, so that neither part's pressure jumps from place to place as a profile changes.
const MIDDLE: f64 = 0.5;

/// Largest pressure in `reach` of the contact at `side`, Pa, by slices. The effective radius is the one that p_0 of the state belongs to, which
/// is the mean over the patch: R = N E*/(pi l p_0^2). An end that still bears is sharp, and has the pressure of its last slice. NaN where
/// slices cannot hold the profile.
pub(super) fn largest_pa(case: &LoadCase, p: &StaticPoint, side: Side, reach: Reach) -> f64 {
    let elastic = case.elastic();
    let (drawn, normal_n, even_pa) = match side {
        Side::Inner => (&elastic.inner_contact[0], p.normal_inner_n, p.hertz_inner_pa),
        Side::Outer => (&elastic.outer_contact, p.normal_outer_n, p.hertz_outer_pa),
    };
    if even_pa <= 0.0 {
        return 0.0;
    }
    let mut contact = *drawn;
    contact.effective_radius_m =
        normal_n * drawn.contact_modulus_pa / (PI * drawn.length_m * even_pa * even_pa);
    let Ok(found) = along_drawn(&case.design.clutch, drawn, &contact, side, normal_n) else {
        return f64::NAN;
    };
    let half_m = found.y_m.last().map_or(0.0, |y| y.abs());
    let there = found.y_m.iter().zip(&found.pressure_pa);
    let there = there.filter(|(y, _)| (y.abs() <= MIDDLE * half_m) == (reach == Reach::Middle));
    there.map(|(_, pa)| *pa).fold(0.0, f64::max)
}
