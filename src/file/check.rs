//! Rules that join several keys of one clutch, and the change to SI.
//!
//! In: the file's structs, every key in its own range. Out: [`Clutch`] and [`Limits`], SI. Absent: ranges of
//! single keys ([`super::design_file`]), scenarios, the optimiser's task. Equations: none of its own; triangle (9)
//! at first contact is asked of `profile`.

use super::contact_file::{ContactFile, EndKindFile};
use super::design_file::{DesignFile, FrictionModelFile, RacesFile};
use super::findings::Findings;
use super::{axial, cage_file, eccentricity, geometry, lubrication_file, running, steels};
use crate::clutch::{Clutch, ContactLaw, Friction, LawName, Materials, ROLLER_COEFFICIENT, Races, Spring};
use crate::design::{LIMIT_KEYS, LimitsFile};
use crate::design::{Limits, m};
use std::f64::consts::FRAC_PI_2;

/// The clutch of a file, or `None` with the reasons in `out`.
pub(super) fn clutch(file: &DesignFile, out: &mut Findings) -> Option<Clutch> {
    let materials = steels::materials(&file.material, out);
    let mut races = races(&file.races, materials.as_ref(), out);
    if let (Some(races), Some(cage)) = (&mut races, &file.cage) {
        races.inner_inertia_kg_m2 += cage.inertia_kg_m2;
    }
    let friction = friction(file, out);
    let contact = contact(&file.contact, out);
    let lubrication = lubrication_file::lubrication(file, out);
    let hunt_crossley_s_per_m = file.contact.hunt_crossley_s_per_m;
    let spring = Spring {
        stiffness_nm_per_rad: file.spring.stiffness_nm_per_rad,
        drag_torque_nm: file.spring.drag_torque_nm,
    };
    let axial = axial::axial(file, out);
    if file.sprags.length_mm > file.races.width_mm {
        out.refuse(
            &["sprags.length_mm", "races.width_mm"],
            format!("at most the width of the races, {} mm", file.races.width_mm),
            "shorten the sprags or widen the races: beyond a race's edge nothing carries a sprag".to_owned(),
        );
    }
    // The sprag is looked at between races that are in order, first as they are made.
    let made = races?;
    let sprags = geometry::sprags(&file.sprags, &made, materials.as_ref(), out);
    let (races, sprags, running) = running::running(file, made, sprags?, materials.as_ref()?, out)?;
    eccentricity::check(&races, &sprags, out);
    let cage = file.cage.as_ref().map(|cage| cage_file::cage(cage, &races, &sprags, out));
    Some(Clutch {
        sprags,
        races,
        running,
        spring,
        cage: cage.flatten(),
        materials: materials?,
        friction: friction?,
        lubrication: lubrication?,
        contact: contact?,
        axial: axial?,
        hunt_crossley_s_per_m,
    })
}

fn races(file: &RacesFile, materials: Option<&Materials>, out: &mut Findings) -> Option<Races> {
    let radii = [
        ("races.inner_bore_radius_mm", file.inner_bore_radius_mm),
        ("races.inner_radius_mm", file.inner_radius_mm),
        ("races.outer_radius_mm", file.outer_radius_mm),
        ("races.outer_outside_radius_mm", file.outer_outside_radius_mm),
    ];
    let mut in_order = true;
    for pair in radii.windows(2) {
        let [(inner, r), (outer, limit)] = [pair[0], pair[1]];
        if r >= limit {
            in_order = false;
            out.refuse(
                &[inner, outer],
                format!("less than {outer} = {limit} mm"),
                "put the radii in order: bore < inner track < outer track < outside".to_owned(),
            );
        }
    }
    // A plain ring; without materials the file is refused anyway.
    let [inner, outer] =
        materials.map_or([0.0; 2], |m| [m.inner_race.density_kg_m3, m.outer_race.density_kg_m3]);
    let ring = |from_mm: f64, until_mm: f64, density: f64| {
        FRAC_PI_2 * density * m(file.width_mm) * (m(until_mm).powi(4) - m(from_mm).powi(4))
    };
    in_order.then(|| Races {
        inner_bore_radius_m: m(file.inner_bore_radius_mm),
        inner_radius_m: m(file.inner_radius_mm),
        outer_radius_m: m(file.outer_radius_mm),
        outer_outside_radius_m: m(file.outer_outside_radius_mm),
        width_m: m(file.width_mm),
        inner_inertia_kg_m2: file.inner_inertia_kg_m2.unwrap_or_else(|| ring(radii[0].1, radii[1].1, inner)),
        outer_inertia_kg_m2: file.outer_inertia_kg_m2.unwrap_or_else(|| ring(radii[2].1, radii[3].1, outer)),
        viscous_damping_nm_s_per_rad: file.viscous_damping_nm_s_per_rad,
        eccentricity: file.eccentricity.as_ref().map(eccentricity::si),
        inner_rim: file.inner_rim,
        outer_rim: file.outer_rim,
    })
}

fn friction(file: &DesignFile, out: &mut Findings) -> Option<Friction> {
    let f = &file.friction;
    if f.kinetic > f.static_ {
        out.refuse(
            &["friction.kinetic", "friction.static"],
            format!("at most the static coefficient, {}", f.static_),
            "lower kinetic or raise static: (12) falls from static to kinetic as sliding gets faster"
                .to_owned(),
        );
        return None;
    }
    Some(match f.model {
        FrictionModelFile::Stribeck => Friction {
            static_: f.static_,
            kinetic: f.kinetic,
            decay_s_per_m: f.decay_s_per_m,
            outer_holds: false,
        },
        // Coulomb knows one coefficient.
        FrictionModelFile::Vernay => {
            Friction { static_: f.static_, kinetic: f.static_, decay_s_per_m: 0.0, outer_holds: true }
        }
    })
}

/// Whether a law reads a key of [contact]; all read those of the axial arrangement.
pub(super) fn reads(law: LawName, key: &str) -> bool {
    match key {
        "roller_coefficient" => law.facts().reads_coefficient,
        "stress_state" => law.facts().reads_stress_state,
        _ => true,
    }
}

fn contact(file: &ContactFile, out: &mut Findings) -> Option<ContactLaw> {
    let given = [
        ("roller_coefficient", "contact.roller_coefficient", file.roller_coefficient.is_some()),
        ("stress_state", "contact.stress_state", file.stress_state.is_some()),
    ];
    for (name, path, is_given) in given {
        if is_given && !reads(file.law, name) {
            out.refuse(
                &[path, "contact.law"],
                format!("no {name} with this law"),
                format!("remove {name}, or name a law that reads it"),
            );
            return None;
        }
    }
    let state = file.stress_state.unwrap_or_default();
    if file.roller_coefficient.is_none() && reads(file.law, "roller_coefficient") {
        out.refuse(
            &["contact.roller_coefficient", "contact.law"],
            super::shape::meaning_of("contact.roller_coefficient"),
            "add roller_coefficient = ... to [contact]; 3.97e-5 is DIN 26281's".to_owned(),
        );
        return None;
    }
    Some(file.law.with(file.roller_coefficient.unwrap_or(ROLLER_COEFFICIENT), state))
}

/// The body's limit needs a section to hold it against.
pub(super) fn body_yield(file: &DesignFile, out: &mut Findings) {
    if file.limits.body_yield_mpa.is_some() && file.sprags.flanks.is_none() && file.sprags.width_mm <= 0.0 {
        out.refuse(
            &["limits.body_yield_mpa", "sprags.flanks", "sprags.width_mm"],
            "only together with flanks, or a width_mm above 0: without them the body has no narrowest section"
                .to_owned(),
            "add flanks = { rear_mm = ..., front_mm = ... } to [sprags], or remove the limit".to_owned(),
        );
    }
}

/// Where the file gives the limit `name`: in `[limits]`, else in `[optimize]`.
fn limit_key(name: &str, out: &Findings) -> Option<String> {
    ["limits", "optimize.limits"].map(|table| format!("{table}.{name}")).into_iter().find(|key| out.has(key))
}

/// Pressure along a contact is finite where its ends are shaped.
pub(super) fn along(file: &DesignFile, out: &mut Findings) {
    let key = limit_key("along_mpa", out);
    let shaped = file.contact.end_profile.as_ref().is_some_and(|p| p.kind != EndKindFile::Square);
    if let (Some(key), false) = (key, shaped) {
        out.refuse(
            &[&key, "contact.end_profile"],
            "only together with an end_profile: at a square end the pressure has no bound".to_owned(),
            "add end_profile = { kind = \"crown\", radius_mm = 300.0 } to [contact], or another kind, or remove the limit".to_owned(),
        );
    }
}

/// A film needs an oil.
pub(super) fn film(file: &DesignFile, out: &mut Findings) {
    let key = limit_key("film_lambda", out);
    if let (Some(key), None) = (key, &file.lubrication) {
        out.refuse(
            &[&key],
            "only together with [lubrication]: without an oil there is no film".to_owned(),
            "add [lubrication] with oil, temperature_c, race_roughness_um and sprag_roughness_um, or remove the limit"
                .to_owned(),
        );
    }
}

/// A tolerance must leave its quantity above 0.
pub(super) fn tolerances(file: &DesignFile, clutch: Option<&Clutch>, out: &mut Findings) {
    let Some(t) = &file.tolerances else { return };
    let (found, value) = (t.friction, file.friction.static_);
    if found >= value {
        out.refuse(
            &["tolerances.friction", "friction.static"],
            format!("a half range below the value itself, {value}: {found} would leave no friction"),
            "lower tolerances.friction".to_owned(),
        );
    }
    let spiral = clutch
        .and_then(|c| c.sprags.spiral)
        .map(|s| geometry::mm(s.radius_m(s.from_rad).min(s.radius_m(s.until_rad))));
    let radii = file.sprags.inner_arcs.iter().map(|a| a.radius_mm).chain(spiral);
    let least = radii.fold(file.sprags.outer_radius_mm, f64::min);
    let gap = file.races.outer_radius_mm - file.races.inner_radius_mm;
    for (key, found, of) in [
        ("tolerances.inner_race_radius_mm", t.inner_race_radius_mm, gap),
        ("tolerances.outer_race_radius_mm", t.outer_race_radius_mm, gap),
        ("tolerances.sprag_outer_radius_mm", t.sprag_outer_radius_mm, least),
        ("tolerances.sprag_inner_radius_mm", t.sprag_inner_radius_mm, least),
    ] {
        if found >= 0.5 * of {
            out.refuse(
                &[key],
                format!("a half range below half of what it varies, {of} mm (gap between the races, smallest sprag radius)"),
                format!("lower {key}"),
            );
        }
    }
}

/// The limits of a table, the absent ones from `base`.
pub(super) fn limits(file: &LimitsFile, base: Limits, out: &mut Findings) -> Limits {
    let base = if file.from_material == Some(true) { steels::limits(file, base, out) } else { base };
    let mut limits = base;
    for key in LIMIT_KEYS {
        if let Some(value) = key.written(file) {
            limits = key.with(&limits, value);
        }
    }
    if let (Some(keep), Some(lift)) = (limits.keep_contact_to_rad_s, limits.lift_off_by_rad_s)
        && lift <= keep
    {
        out.refuse(
            &["limits.lift_off_by_rpm", "limits.keep_contact_to_rpm"],
            "more than keep_contact_to_rpm".to_owned(),
            "sprags keep contact up to one speed and are off from a higher one on; remove one of the keys"
                .to_owned(),
        );
    }
    for (key, needed, what) in LIMIT_KEYS.iter().flat_map(|key| key.missing(&limits)) {
        out.refuse(
            &[&format!("limits.{key}")],
            format!("only together with limits.{needed}, which is missing"),
            format!("add {needed} = ..., {what}, or remove the limit"),
        );
    }
    if let (Some(nominal), Some(peak)) = (limits.nominal_torque_nm, limits.peak_torque_nm)
        && peak < nominal
    {
        out.refuse(
            &["limits.peak_torque_nm", "limits.nominal_torque_nm"],
            format!("at least the nominal torque, {nominal} N m"),
            "raise peak_torque_nm or lower nominal_torque_nm".to_owned(),
        );
    }
    limits
}

/// An allowed gap is the whole gap under load: one that the races have at rest already is a slip of the pen for an
/// opening.
pub(super) fn gaps(limits: &LimitsFile, races: &RacesFile, out: &mut Findings) {
    let rest = races.outer_radius_mm - races.inner_radius_mm;
    for (key, gap) in
        [("limits.gap_nominal_mm", limits.gap_nominal_mm), ("limits.gap_peak_mm", limits.gap_peak_mm)]
    {
        if gap.is_some_and(|gap| gap <= rest) {
            out.refuse(
                &[key, "races.outer_radius_mm", "races.inner_radius_mm"],
                format!("more than the gap at rest, {} mm", geometry::mm(m(rest))),
                "give the whole gap under load, not its opening; where a race was changed, move it by as much"
                    .to_owned(),
            );
        }
    }
}
