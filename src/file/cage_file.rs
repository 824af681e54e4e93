//! `[cage]` as written, and the same in SI.
//!
//! In: TOML text, races and sprags as run. Out: [`Cage`], or why there is none. Absent: what the cage does (`dynamics`).
//! Equations: none of its own; azimuths at first contact are those of `profile`. The doc comments are the schema's
//! descriptions.

use super::findings::Findings;
use super::geometry::mm;
use crate::clutch::{Cage, Races, Sprags};
use crate::design::m;
use schemars::JsonSchema;
use serde::Deserialize;

/// A cage that turns with the inner race and carries the sprags round, as in clutches whose sprags lift off the outer race once the
/// inner one runs fast. Its pockets leave them the play that they need under load.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct CageFile {
    /// The race that the cage is fixed to.
    #[serde(rename = "driven_by")]
    pub _driven_by: DriverFile,
    /// The point of a sprag at which the cage takes it along and keeps it from going outward, and about which it tilts.
    pub pivot: PivotFile,
    /// How far the cage lets the pivot go outward from where it is when the sprag touches both races, um; absent: 0. Lift-off comes
    /// later by some percent for each.
    #[serde(default)]
    #[schemars(extend("minimum" = 0))]
    pub clearance_um: f64,
    /// Inertia of the cage, kg m^2, beside races.inner_inertia_kg_m2; absent: 0.
    #[serde(default)]
    #[schemars(extend("minimum" = 0))]
    pub inertia_kg_m2: f64,
}

/// What drives a cage.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(super) enum DriverFile {
    InnerRace,
}

/// A point of a sprag in its body frame, mm.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct PivotFile {
    /// x, towards positive azimuth, mm.
    pub x_mm: f64,
    /// y, radially outward from C_e, mm.
    pub y_mm: f64,
}

/// The cage in SI. Refused where turning the sprag closed about its pivot would not press it on both races: N_B acts along OC_e
/// and N_A along OC_1, so P lies between these lines, and between the tracks.
pub(super) fn cage(file: &CageFile, races: &Races, sprags: &Sprags, out: &mut Findings) -> Option<Cage> {
    let profile = sprags.profile(races).ok()?;
    let [x, y] = [m(file.pivot.x_mm), profile.outer_centre_distance_m + m(file.pivot.y_mm)];
    let (radius, azimuth) = (x.hypot(y), x.atan2(y));
    if !(azimuth > 0.0 && azimuth < profile.beta0_rad) {
        let most = radius * profile.beta0_rad.sin();
        out.refuse(
            &["cage.pivot.x_mm", "cage.pivot.y_mm", "cage"],
            format!(
                "above 0 and, at that height, below {} mm: between the lines from the axis to the centres of the outer and of the first inner arc",
                mm(most)
            ),
            "move the pivot: a sprag that turns closed about it has to press on both races".to_owned(),
        );
        return None;
    }
    if !(radius > races.inner_radius_m && radius < races.outer_radius_m) {
        let [low, high] =
            [races.inner_radius_m, races.outer_radius_m].map(|r| mm(r - profile.outer_centre_distance_m));
        out.refuse(
            &["cage.pivot.y_mm", "cage.pivot.x_mm", "cage"],
            format!("between about {low} and {high} mm: a pivot between the tracks"),
            "give the pivot from C_e, positive outward".to_owned(),
        );
        return None;
    }
    let pivot_m = [m(file.pivot.x_mm), m(file.pivot.y_mm)];
    // Turned open about C_e until C_1 is farthest out: then the sprag is lowest over its first arc.
    let centre = profile.arcs.first()?.centre_m;
    let (sin, cos) = centre.x.atan2(centre.y).sin_cos();
    let [px, py] = pivot_m;
    let outside = (px * cos - py * sin).hypot(profile.outer_centre_distance_m + px * sin + py * cos);
    let most_um = 1e6 * (outside - radius);
    if most_um <= 0.0 {
        out.refuse(
            &["cage.pivot.y_mm", "cage.pivot.x_mm", "cage"],
            "a pivot that goes outward when the sprag tilts open about C_e: any y_mm of 0 or less does, a higher one where x_mm is large"
                .to_owned(),
            "move the pivot inward: the cage holds it from going outward, and a tilting sprag would draw this one inward".to_owned(),
        );
        return None;
    }
    if file.clearance_um > most_um {
        out.refuse(
            &["cage.clearance_um", "cage"],
            format!(
                "at most {} um: with more the sprags tilt beyond where they are lowest before the cage stops them",
                (10.0 * most_um).floor() / 10.0
            ),
            "give what the pocket lets the pivot go outward, commonly some um to some tens of um".to_owned(),
        );
        return None;
    }
    Some(Cage { pivot_m, clearance_m: 1e-6 * file.clearance_um })
}
