//! Flanks of a file, the outline that they close, and whether neighbours keep clear of each other.
//!
//! In: the `[sprags]` table, the placed profile. Out: [`Flanks`], [`Outline`]. Absent: the geometry itself
//! (`profile`), neighbours under load (`margin`). Equations: none.

use super::design_file::SpragsFile;
use super::findings::Findings;
use super::geometry::{end_key, mm};
use crate::design::m;
use crate::profile::{FlankSide, Flanks, Outline, OutlineError, Profile, STEEPEST_RAD, clearance_m};

/// The flanks that a file names, or both at half of its width; none where it has neither.
pub(super) fn flanks(file: &SpragsFile) -> Option<Flanks> {
    match &file.flanks {
        Some(f) => Some(Flanks {
            rear_tilt_rad: f.rear_tilt_rad,
            front_tilt_rad: f.front_tilt_rad,
            ..Flanks::parallel(m(f.rear_mm), m(f.front_mm))
        }),
        None if file.width_mm > 0.0 => Some(Flanks::parallel(m(file.width_mm / 2.0), m(file.width_mm / 2.0))),
        None => None,
    }
}

/// The closed outline, or `None` with the reason in `out`.
pub(super) fn outline(
    file: &SpragsFile,
    profile: &Profile,
    flanks: Flanks,
    out: &mut Findings,
) -> Option<Outline> {
    let why = match Outline::closed(profile, &flanks) {
        Ok(outline) => return Some(outline),
        Err(why) => why,
    };
    let (side, needed) = match why {
        // The shape of the file rules both out.
        OutlineError::NoArcs => (FlankSide::Front, "at least one inner arc".to_owned()),
        OutlineError::NotPositive { side, .. } => (side, "more than 0 mm".to_owned()),
        OutlineError::TooSteep { side, .. } => (side, format!("a lean of at most {STEEPEST_RAD} rad")),
        OutlineError::CutsContact { side, needed_m, .. } => {
            (side, format!("more than {} mm", of_key(file, needed_m, f64::ceil)))
        }
        OutlineError::MissesInner { side, reach_m, .. } | OutlineError::MissesOuter { side, reach_m, .. } => {
            (side, format!("less than {} mm", of_key(file, reach_m, f64::floor)))
        }
        OutlineError::CutsInner { needed_m, .. } => {
            (FlankSide::Front, format!("at least {} mm", of_key(file, needed_m, f64::ceil)))
        }
        OutlineError::CutsOuter { needed_m, .. } => {
            (FlankSide::Rear, format!("at least {} mm", of_key(file, needed_m, f64::ceil)))
        }
        OutlineError::NoFlank { side, .. } => {
            (side, "a flank between the arcs, so a narrower one".to_owned())
        }
    };
    let flank = match (&file.flanks, side) {
        (None, _) => "sprags.width_mm",
        (Some(_), FlankSide::Rear) => "sprags.flanks.rear_mm",
        (Some(_), FlankSide::Front) => "sprags.flanks.front_mm",
    };
    let end = end_key(file);
    let help = match file.flanks {
        Some(_) => format!("move the {side} flank, or end the profile elsewhere"),
        None => format!(
            "change width_mm, half of which places the {side} flank, give flanks = {{ rear_mm = ..., front_mm = \
             ... }}, or end the profile elsewhere"
        ),
    };
    out.refuse(
        &[
            flank,
            &end,
            "sprags.inner_arcs",
            "sprags.outer_radius_mm",
            "sprags.centre_distance_mm",
            "races.outer_radius_mm",
            "races.inner_radius_mm",
        ],
        format!("{needed}: {why}"),
        help,
    );
    None
}

/// A half width as the value of the key that sets it, mm: of width_mm twice. Rounded to 0.1 um towards the
/// side on which it is allowed, so that the printed value can be typed in.
fn of_key(file: &SpragsFile, half_width_m: f64, round: fn(f64) -> f64) -> f64 {
    let key_m = if file.flanks.is_some() { half_width_m } else { 2.0 * half_width_m };
    round(key_m * 1e7) / 1e4
}

/// Refuse sprags that touch or overlap their neighbours at first contact at rest.
pub(super) fn check_neighbours(file: &SpragsFile, profile: &Profile, outline: &Outline, out: &mut Findings) {
    let clearance = |count: usize| clearance_m(outline, profile.outer_centre_distance_m, 0.0, count);
    let found = clearance(file.count);
    if found > 0.0 {
        return;
    }
    // Convex sprags that overlap at one pitch overlap at every smaller one: the chord between two points of
    // one sprag at equal radii a pitch apart holds such points for every smaller pitch. So bisection is exact.
    let (mut fits, mut too_many) = (1, file.count);
    while too_many - fits > 1 {
        let middle = fits + (too_many - fits) / 2;
        if clearance(middle) > 0.0 { fits = middle } else { too_many = middle }
    }
    let mut keys = vec!["sprags.count"];
    keys.extend(match file.flanks {
        Some(_) => &["sprags.flanks.rear_mm", "sprags.flanks.front_mm"][..],
        None => &["sprags.width_mm"],
    });
    keys.extend([
        "sprags.outer_radius_mm",
        "sprags.centre_distance_mm",
        "sprags.inner_arcs",
        "races.outer_radius_mm",
        "races.inner_radius_mm",
    ]);
    out.refuse(
        &keys,
        format!(
            "at most {fits} sprags of this outline, with clearance between neighbours at first contact; it is \
             {} mm",
            mm(found)
        ),
        "take fewer or narrower sprags: these overlap their neighbours".to_owned(),
    );
}
