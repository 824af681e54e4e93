//! Whether the sprags fit between the races.
//!
//! In: the `[sprags]` table, races in order. Out: [`Sprags`], SI. Absent: deformation; flanks and neighbours
//! ([`super::outline`]); what a spiral is (`profile`). Equations: none of its own; triangle (9) at first contact is asked of `profile`.

use super::design_file::{InnerSpiralFile, SpiralCurveFile, SpragsFile};
use super::findings::Findings;
use super::outline;
use crate::clutch::{InnerArc, MassSource, Materials, Races, Sprags};
use crate::design::m;
use crate::profile::{Profile, ProfileError, Spiral, Support};

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
    let (profile, spiral) = profile.map_or((None, None), |(profile, spiral)| (Some(profile), spiral));
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
        centre_distance_m: centre_distance_m(file, &profile),
        width_m: m(file.width_mm),
        mass_kg: mass.mass_kg,
        inertia_kg_m2: mass.inertia_kg_m2,
        centroid_m: mass.centroid_m,
        mass_source,
        inner_arcs: profile
            .arcs
            .iter()
            .map(|a| InnerArc { radius_m: a.radius_m, until_rad: a.until_rad })
            .collect(),
        spiral,
        flanks,
    })
}

/// e_1 as the file has it; that of a spiral's first arc where the file has none.
fn centre_distance_m(file: &SpragsFile, profile: &Profile) -> f64 {
    file.centre_distance_mm.map_or_else(|| profile.arcs.first().map_or(0.0, |a| a.centre_m.norm()), m)
}

/// Arcs of a profile at most: a curve is built arc by arc.
const MOST_ARCS: usize = 200;
/// Steps of a spiral where the file names none: tan omega is then that of the curve to some parts of 1e5 (a test has it), and
/// a curve costs as much as one of 24 arcs.
const SPIRAL_STEPS: usize = 12;

fn arcs_in_order(file: &SpragsFile, out: &mut Findings) -> bool {
    let mut in_order = true;
    if let Some(spiral) = &file.inner_spiral {
        in_order = spiral_in_order(file, spiral, out);
    } else if file.inner_arcs.is_empty() {
        out.refuse(
            &["sprags.inner_arcs", "sprags"],
            "inner arcs, or an inner_spiral in place of them".to_owned(),
            "add inner_arcs = [{ radius_mm = ..., until_rad = ... }], or inner_spiral = { strut_angle_deg = ..., \
             until_rad = ... }"
                .to_owned(),
        );
        return false;
    } else if file.centre_distance_mm.is_none() {
        refuse_without_distance(out);
        return false;
    }
    let steps = file.inner_spiral.as_ref().map_or(0, |s| s.steps.unwrap_or(SPIRAL_STEPS));
    if file.inner_arcs.len() + 2 * steps > MOST_ARCS && steps > 0 {
        out.refuse(
            &["sprags.inner_spiral.steps", "sprags.inner_arcs", "sprags.inner_spiral"],
            format!("at most {MOST_ARCS} arcs, two of them for each step of the spiral"),
            "take fewer steps: 12 are enough".to_owned(),
        );
        return false;
    }
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

fn refuse_without_distance(out: &mut Findings) {
    out.refuse(
        &["sprags.centre_distance_mm", "sprags"],
        super::shape::meaning_of("sprags.centre_distance_mm"),
        "add centre_distance_mm = ... to [sprags]: with inner_arcs it says how the sprag lies between the races".to_owned(),
    );
}

/// Whether the keys beside a spiral say once, and not twice, how it begins.
fn spiral_in_order(file: &SpragsFile, spiral: &InnerSpiralFile, out: &mut Findings) -> bool {
    let before = out.problems.len();
    let key = |name: &str| format!("sprags.inner_spiral.{name}");
    let (angle, table) = (key("strut_angle_deg"), "sprags.inner_spiral");
    match (file.inner_arcs.last(), spiral.strut_angle_deg, file.centre_distance_mm) {
        (None, None, _) => out.refuse(
            &[&angle, table],
            "the strut angle at first contact, where the spiral begins: there are no inner_arcs before it"
                .to_owned(),
            format!("add strut_angle_deg = ... to [{table}]; tan omega has to stay below the friction"),
        ),
        (None, _, Some(_)) => out.refuse(
            &["sprags.centre_distance_mm", &angle],
            "no centre_distance_mm with a spiral from first contact on: its strut_angle_deg says it"
                .to_owned(),
            "remove centre_distance_mm, or give inner_arcs before the spiral".to_owned(),
        ),
        (Some(_), Some(_), _) => out.refuse(
            &[&angle, "sprags.inner_arcs"],
            "no strut_angle_deg behind inner_arcs: radius and centre distance of the first of them say it"
                .to_owned(),
            "remove strut_angle_deg, or inner_arcs and centre_distance_mm".to_owned(),
        ),
        (Some(_), None, None) => refuse_without_distance(out),
        (Some(last), None, Some(_)) if spiral.until_rad <= last.until_rad => {
            let end = arc_key(file.inner_arcs.len() - 1, "until_rad");
            out.refuse(
                &[&key("until_rad"), &end, "sprags.inner_arcs"],
                format!("more than the end of the arc before, {} rad", last.until_rad),
                "let the spiral end behind the arcs, or take it away".to_owned(),
            );
        }
        _ => {}
    }
    match spiral.curve {
        SpiralCurveFile::Logarithmic if spiral.start_radius_mm.is_none() => out.refuse(
            &[&key("start_radius_mm"), &key("curve")],
            super::shape::meaning_of(&key("start_radius_mm")),
            format!("add start_radius_mm = ... to [{table}]"),
        ),
        SpiralCurveFile::ConstantStrutAngle => {
            for (name, given) in
                [("start_radius_mm", spiral.start_radius_mm.is_some()), ("rise", spiral.rise.is_some())]
            {
                if given {
                    out.refuse(
                        &[&key(name), &key("curve"), table],
                        format!(
                            "no {name} with curve = \"constant-strut-angle\": races and strut angle say it"
                        ),
                        format!("remove {name}, or give curve = \"logarithmic\""),
                    );
                }
            }
        }
        SpiralCurveFile::Logarithmic => {}
    }
    out.problems.len() == before
}

pub(super) fn arc_key(k: usize, key: &str) -> String {
    format!("sprags.inner_arcs[{k}].{key}")
}

/// The key at which the profile ends.
pub(super) fn end_key(file: &SpragsFile) -> String {
    match file.inner_spiral {
        Some(_) => "sprags.inner_spiral.until_rad".to_owned(),
        None => arc_key(file.inner_arcs.len().saturating_sub(1), "until_rad"),
    }
}

/// The spiral of a file whose first contact, or whose junction with the arcs before, is `from`.
fn spiral(
    file: &InnerSpiralFile,
    from: Support,
    from_rad: f64,
    inset_m: f64,
    out: &mut Findings,
) -> Option<Spiral> {
    let (until_rad, steps) = (file.until_rad, file.steps.unwrap_or(SPIRAL_STEPS));
    let found = match (file.curve, file.start_radius_mm) {
        (SpiralCurveFile::Logarithmic, Some(radius)) => {
            let rise = file.rise.unwrap_or_else(|| from.tan_omega(inset_m));
            Spiral { start_radius_m: m(radius), rise, inset_m: 0.0, from_rad, until_rad, steps }
        }
        _ => Spiral::of_constant_angle(from, inset_m, [from_rad, until_rad], steps),
    };
    let least = found.arcs().iter().map(|a| a.0).fold(found.start_radius_m, f64::min);
    if least > 0.0 && found.rise.is_finite() {
        return Some(found);
    }
    out.refuse(
        &[
            "sprags.inner_spiral.until_rad",
            "sprags.inner_spiral.rise",
            "sprags.inner_spiral.strut_angle_deg",
            "sprags.inner_spiral",
        ],
        format!("arcs whose radii are above 0 throughout; the smallest is {} mm", mm(least)),
        "take a shorter spiral, a smaller rise or strut angle, or more steps".to_owned(),
    );
    None
}

/// The profile of the file's arcs and of those that stand for its spiral, with the spiral.
fn profile(file: &SpragsFile, races: &Races, out: &mut Findings) -> Option<(Profile, Option<Spiral>)> {
    let mut arcs: Vec<(f64, f64)> = file.inner_arcs.iter().map(|a| (m(a.radius_mm), a.until_rad)).collect();
    let (r_e, tracks) = (m(file.outer_radius_mm), [races.inner_radius_m, races.outer_radius_m]);
    if r_e >= races.outer_radius_m {
        out.refuse(
            &["sprags.outer_radius_mm", "races.outer_radius_mm"],
            format!("less than the outer track's radius, {} mm", mm(races.outer_radius_m)),
            "take a smaller arc: it rolls inside the outer track".to_owned(),
        );
        return None;
    }
    let inset_m = r_e * tracks[0] / tracks[1];
    let (placed, spiral) = match (&file.inner_spiral, arcs.last().copied()) {
        (None, _) => (placed(r_e, file, &arcs, tracks), None),
        (Some(of), Some(last)) => match placed(r_e, file, &arcs, tracks) {
            Ok(before) => {
                let spiral = spiral(of, Support::of(&before, last.1)?, last.1, inset_m, out)?;
                arcs.extend(spiral.arcs());
                (placed(r_e, file, &arcs, tracks), Some(spiral))
            }
            refused => (refused, None),
        },
        (Some(of), None) => {
            let angle = of.strut_angle_deg.unwrap_or_default();
            let Some(from) = Support::under(angle.to_radians(), r_e, tracks) else {
                out.refuse(
                    &["sprags.outer_radius_mm", "races.outer_radius_mm", "races.inner_radius_mm"],
                    format!(
                        "less than the race gap, {} mm: C_e lies outside the inner track",
                        mm(tracks[1] - tracks[0])
                    ),
                    "take a smaller outer_radius_mm of the sprags".to_owned(),
                );
                return None;
            };
            let spiral = spiral(of, from, 0.0, inset_m, out)?;
            let arcs = spiral.arcs();
            let first = arcs.first().map_or(0.0, |a| a.0);
            (Profile::new(r_e, from.centre_distance_m(first), &arcs, tracks[0], tracks[1]), Some(spiral))
        }
    };
    let error = match placed {
        Ok(profile) => return Some((profile, spiral)),
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

fn placed(
    outer_radius_m: f64,
    file: &SpragsFile,
    arcs: &[(f64, f64)],
    tracks_m: [f64; 2],
) -> Result<Profile, ProfileError> {
    Profile::new(
        outer_radius_m,
        m(file.centre_distance_mm.unwrap_or_default()),
        arcs,
        tracks_m[0],
        tracks_m[1],
    )
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
