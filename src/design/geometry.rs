//! Whether the sprags fit between the races.
//!
//! In: the `[sprags]` table, races in order. Out: [`Sprags`], SI. Absent: deformation; flanks and neighbours
//! ([`super::outline`]). Equations: none of its own; triangle (9) at first contact is asked of `profile`.

use super::check::m;
use super::file::SpragsFile;
use super::findings::Findings;
use super::outline;
use crate::clutch::{InnerArc, MassSource, Materials, Races, Sprags};
use crate::profile::{Profile, ProfileError};

/// Mass m_g kg, inertia I_g about the centroid kg m^2, centroid in the body frame m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Mass {
    pub mass_kg: f64,
    pub inertia_kg_m2: f64,
    pub centroid_m: [f64; 2],
}

impl From<crate::profile::MassProperties> for Mass {
    fn from(p: crate::profile::MassProperties) -> Self {
        Self { mass_kg: p.mass_kg, inertia_kg_m2: p.inertia_kg_m2, centroid_m: p.centroid_m }
    }
}

/// The sprags of a file, or `None` with the reasons in `out`.
pub(super) fn sprags(
    file: &SpragsFile,
    races: &Races,
    materials: Option<&Materials>,
    out: &mut Findings,
) -> Option<Sprags> {
    let profile = arcs_in_order(file, out).then(|| profile(file, races, out)).flatten();
    let given = given_mass(file, out);
    let profile = profile?;
    let flanks = outline::flanks(file);
    let outline = match flanks {
        Some(flanks) => Some(outline::outline(file, &profile, flanks, out)?),
        None => None,
    };
    if let Some(outline) = &outline {
        outline::check_neighbours(file, &profile, outline, out);
    }
    let (mass, mass_source) = match given? {
        Some(mass) => (mass, MassSource::Given),
        None => {
            let Some(outline) = &outline else {
                out.refuse(
                    &["sprags.flanks", "sprags.width_mm", "sprags.mass_kg", "sprags.inertia_kg_m2", "sprags"],
                    "flanks, or a width_mm above 0 from which they follow: without mass_kg, inertia_kg_m2 and \
                     centroid the mass comes from the outline, which is open"
                        .to_owned(),
                    "add flanks = { rear_mm = ..., front_mm = ... }, or give mass_kg, inertia_kg_m2 and centroid"
                        .to_owned(),
                );
                return None;
            };
            let weighed = outline.mass_properties(m(file.length_mm), materials?.sprag.density_kg_m3);
            (Mass::from(weighed), MassSource::FromProfile)
        }
    };
    if mass_source == MassSource::Given {
        check_centroid(mass.centroid_m, &profile, races, out);
    }
    Some(Sprags {
        count: file.count,
        length_m: m(file.length_mm),
        outer_radius_m: m(file.outer_radius_mm),
        centre_distance_m: m(file.centre_distance_mm),
        width_m: m(file.width_mm),
        mass_kg: mass.mass_kg,
        inertia_kg_m2: mass.inertia_kg_m2,
        centroid_m: mass.centroid_m,
        mass_source,
        inner_arcs: file
            .inner_arcs
            .iter()
            .map(|a| InnerArc { radius_m: m(a.radius_mm), until_rad: a.until_rad })
            .collect(),
        flanks,
    })
}

/// Arcs of a profile at most: a curve is built arc by arc.
const MOST_ARCS: usize = 200;

fn arcs_in_order(file: &SpragsFile, out: &mut Findings) -> bool {
    let mut in_order = true;
    if file.inner_arcs.len() > MOST_ARCS {
        out.refuse(
            &["sprags.inner_arcs"],
            format!("at most {MOST_ARCS} arcs"),
            "fit the outline by fewer: sprag-design import".to_owned(),
        );
        return false;
    }
    for (k, pair) in file.inner_arcs.windows(2).enumerate() {
        if pair[1].until_rad <= pair[0].until_rad {
            in_order = false;
            let (key, before) = (arc_key(k + 1, "until_rad"), arc_key(k, "until_rad"));
            out.refuse(
                &[&key, &before, "sprags.inner_arcs"],
                format!("more than the end of the arc before, {} rad", pair[0].until_rad),
                "list the arcs in the order in which engagement reaches them".to_owned(),
            );
        }
    }
    in_order
}

pub(super) fn arc_key(k: usize, key: &str) -> String {
    format!("sprags.inner_arcs[{k}].{key}")
}

fn profile(file: &SpragsFile, races: &Races, out: &mut Findings) -> Option<Profile> {
    let arcs: Vec<(f64, f64)> = file.inner_arcs.iter().map(|a| (m(a.radius_mm), a.until_rad)).collect();
    let (r_e, e) = (m(file.outer_radius_mm), m(file.centre_distance_mm));
    if r_e >= races.outer_radius_m {
        out.refuse(
            &["sprags.outer_radius_mm", "races.outer_radius_mm"],
            format!("less than the outer track's radius, {} mm", mm(races.outer_radius_m)),
            "take a smaller arc: it rolls inside the outer track".to_owned(),
        );
        return None;
    }
    let error = match Profile::new(r_e, e, &arcs, races.inner_radius_m, races.outer_radius_m) {
        Ok(profile) => return Some(profile),
        Err(error) => error,
    };
    // Of the scenario or the base, whichever list of arcs holds.
    let first = arc_key(0, "radius_mm");
    match error {
        ProfileError::DoesNotSpan { least_m, reach_m, gap_m } => {
            let (least, reach, gap) = (mm(least_m), mm(reach_m), mm(gap_m));
            let sprag = ["sprags.outer_radius_mm", &first, "sprags.centre_distance_mm", "sprags.inner_arcs"];
            let tracks = ["races.outer_radius_mm", "races.inner_radius_mm"];
            if gap_m > least_m && gap_m < reach_m {
                let [r_e, r_1, e, arcs] = sprag;
                out.refuse(
                    &[e, r_e, r_1, tracks[0], tracks[1], arcs],
                    "a triangle O C_1 C_e with less than a right angle at O".to_owned(),
                    "shorten centre_distance_mm: the circles of the arcs cannot meet both races".to_owned(),
                );
                return None;
            }
            let (allowed, help) = if gap_m <= least_m {
                (
                    format!(
                        "a race gap above {least} mm (r_e + r_i1 - e_1) and below {reach} mm; it is {gap} mm"
                    ),
                    format!(
                        "the race gap is too small for the sprag: raise outer_radius_mm of the races above {} mm, \
                         or take smaller arcs",
                        mm(races.inner_radius_m + least_m)
                    ),
                )
            } else {
                (
                    format!(
                        "a race gap below {reach} mm (r_e + r_i1 + e_1) and above {least} mm; it is {gap} mm"
                    ),
                    format!(
                        "the sprag is too short for the race gap: lower outer_radius_mm of the races below {} mm, \
                         or take larger arcs",
                        mm(races.inner_radius_m + reach_m)
                    ),
                )
            };
            let keys: Vec<&str> = tracks.into_iter().chain(sprag).collect();
            out.refuse(&keys, allowed, help);
        }
        ProfileError::ArcsOutOfOrder { index } => {
            let key = arc_key(index, "until_rad");
            out.refuse(
                &[&key, "sprags.inner_arcs"],
                "arcs that end one after the other".to_owned(),
                "list the arcs in the order in which engagement reaches them".to_owned(),
            );
        }
    }
    None
}

/// `Some(None)`: to come from the profile. `None`: refused.
fn given_mass(file: &SpragsFile, out: &mut Findings) -> Option<Option<Mass>> {
    match (file.mass_kg, file.inertia_kg_m2, &file.centroid) {
        (None, None, None) => Some(None),
        (Some(mass_kg), Some(inertia_kg_m2), Some(c)) => {
            Some(Some(Mass { mass_kg, inertia_kg_m2, centroid_m: [m(c.x_mm), m(c.y_mm)] }))
        }
        (mass, inertia, centroid) => {
            let keys = [
                ("sprags.mass_kg", mass.is_some()),
                ("sprags.inertia_kg_m2", inertia.is_some()),
                ("sprags.centroid", centroid.is_some()),
            ];
            let (given, absent): (Vec<_>, Vec<_>) = keys.into_iter().partition(|(_, is_given)| *is_given);
            let names: Vec<&str> = absent.iter().map(|(key, _)| *key).collect();
            let ordered: Vec<&str> = absent.iter().chain(&given).map(|(key, _)| *key).collect();
            out.refuse(
                &ordered,
                "mass_kg, inertia_kg_m2 and centroid together, or none of them".to_owned(),
                format!("add {}, or remove all three: then they come from the profile", names.join(" and ")),
            );
            None
        }
    }
}

fn check_centroid(centroid_m: [f64; 2], profile: &Profile, races: &Races, out: &mut Findings) {
    let [x, y] = centroid_m;
    let oc_g = x.hypot(profile.outer_centre_distance_m + y);
    if oc_g <= races.inner_radius_m || oc_g >= races.outer_radius_m {
        out.refuse(
            &[
                "sprags.centroid.y_mm",
                "sprags.centroid.x_mm",
                "sprags.outer_radius_mm",
                "races.inner_radius_mm",
                "races.outer_radius_mm",
            ],
            format!(
                "a centroid between the tracks, {} to {} mm from the clutch axis; it is {} mm from it",
                mm(races.inner_radius_m),
                mm(races.outer_radius_m),
                mm(oc_g)
            ),
            "measure the centroid from C_e, y outward, x towards positive azimuth, in mm".to_owned(),
        );
    }
}

/// m to mm for a message, rounded to a nanometre.
pub(super) fn mm(m: f64) -> f64 {
    (m * 1e9).round() / 1e6
}
