//! Tracks off centre: whether the sprags still stand in the narrowest gap.
//!
//! In: `[races.eccentricity]`, races and sprags as run. Out: [`Eccentricity`], SI. Absent: what the sprags carry then
//! (`margin`); a gap too wide for a sprag, which is an answer of `check`. Equations: triangle (9), whose least gap is
//! r_e + r_i1 - e_1.

use super::design_file::EccentricityFile;
use super::findings::Findings;
use super::geometry::mm;
use crate::clutch::{Eccentricity, Races, Sprags};
use crate::design::m;

pub(super) fn si(file: &EccentricityFile) -> Eccentricity {
    Eccentricity {
        offset_m: m(file.offset_mm),
        turning: file.turning,
        carrier: file.stays_with,
        // N/um to N/m.
        stiffness_n_per_m: file.bearing_stiffness_n_per_um.map_or(f64::INFINITY, |k| 1e6 * k),
    }
}

/// Refuse a race that floats and is turned against its own offset, and an offset at which the narrowest gap is no longer wider than the sprag is at least.
pub(super) fn check(races: &Races, sprags: &Sprags, out: &mut Findings) {
    let (Some(e), Some(first)) = (races.eccentricity, sprags.inner_arcs.first()) else { return };
    if e.turning && e.stiffness_n_per_m == 0.0 {
        out.refuse(
            &["races.eccentricity.turning", "races.eccentricity.bearing_stiffness_n_per_um", "races"],
            "false with bearing_stiffness_n_per_um = 0".to_owned(),
            "remove turning, or give the stiffness of the bearings: nothing turns a race that floats against the sprags"
                .to_owned(),
        );
    }
    let least = sprags.outer_radius_m + first.radius_m - sprags.centre_distance_m;
    let room = races.outer_radius_m - races.inner_radius_m - least;
    if e.offset_m >= room {
        out.refuse(
            &["races.eccentricity.offset_mm", "races.outer_radius_mm", "races.inner_radius_mm", "races"],
            format!(
                "less than {} mm: the narrowest gap has to be wider than the sprag's least height, {} mm",
                mm(room),
                mm(least)
            ),
            "give the distance of the axes, half of what a dial indicator reads, in mm".to_owned(),
        );
    }
}
