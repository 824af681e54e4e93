//! The design variables that `[optimize]` may name.
//!
//! In: a variable's name and the number of inner arcs. Out: the dotted path of the key that it stands for.
//! Absent: bounds and values. Equations: none. Beside the short names any number of the clutch's own tables may be
//! named by its dotted path, such as `races.outer_outside_radius_mm`.

use super::shape;

/// Tables whose numbers may be variables: what the clutch is, not what is asked of it.
const OWN_TABLES: &[&str] = &["sprags", "races", "spring", "material", "friction", "contact", "cage"];

/// Every variable: pattern of the name, pattern of the path of the key it sets, meaning. `{k}` counts inner
/// arcs from 1 in a name and from 0 in a path; `{last}` is the last arc.
pub const VARIABLES: &[(&str, &str, &str)] = &[
    ("r_i{k}_mm", "sprags.inner_arcs[{k}].radius_mm", "radius of inner arc k"),
    ("junction_{k}_rad", "sprags.inner_arcs[{k}].until_rad", "turn at which arc k gives way to arc k+1"),
    ("profile_end_rad", "sprags.inner_arcs[{last}].until_rad", "turn at which the last arc ends"),
    ("strut_angle_deg", "sprags.inner_spiral.strut_angle_deg", "strut angle at first contact of a spiral"),
    (
        "spiral_radius_mm",
        "sprags.inner_spiral.start_radius_mm",
        "radius of curvature where a logarithmic spiral begins",
    ),
    (
        "spiral_rise",
        "sprags.inner_spiral.rise",
        "growth of a logarithmic spiral's radius per rad over the radius",
    ),
    ("spiral_end_rad", "sprags.inner_spiral.until_rad", "turn at which a spiral ends"),
    ("outer_radius_mm", "sprags.outer_radius_mm", "radius r_e of the sprag's outer arc"),
    ("centre_distance_mm", "sprags.centre_distance_mm", "centre distance e_1"),
    ("length_mm", "sprags.length_mm", "length of the sprags"),
    ("width_mm", "sprags.width_mm", "body width b of (6)"),
    ("flank_rear_mm", "sprags.flanks.rear_mm", "flank on the side of negative x"),
    ("flank_front_mm", "sprags.flanks.front_mm", "flank on the side of positive x"),
    ("flank_rear_tilt_rad", "sprags.flanks.rear_tilt_rad", "lean of the flank on the side of negative x"),
    ("flank_front_tilt_rad", "sprags.flanks.front_tilt_rad", "lean of the flank on the side of positive x"),
    ("count", "sprags.count", "number of sprags, a whole number"),
    ("crown_radius_mm", "contact.end_profile.radius_mm", "radius of the crown or of the end relief"),
    ("centroid_x_mm", "sprags.centroid.x_mm", "centroid, towards positive azimuth"),
    ("centroid_y_mm", "sprags.centroid.y_mm", "centroid, radially outward from C_e"),
];

/// Tables besides whose numbers have their unit here; those of `[limits]` have it in [`LIMIT_KEYS`](crate::design::LIMIT_KEYS).
#[cfg(test)]
const OTHER_TABLES: &[&str] = &["drivetrain", "scenarios", "thermal", "lubrication", "sharing", "tolerances"];

/// Unit of every number in these tables by the last step of its path, as printed; a pure number has none.
const UNITS: &[(&str, &str)] = &[
    ("abutment_stiffness_nm_per_rad", "Nm/rad"),
    ("ahead_deg", "deg"),
    ("amplitude_nm", "Nm"),
    ("amplitude_um", "µm"),
    ("axial_offset_mm", "mm"),
    ("azimuth_deg", "deg"),
    ("azimuth_within_deg", "deg"),
    ("bearing_mass_kg", "kg"),
    ("bearing_stiffness_n_per_um", "N/µm"),
    ("bench_inertia_kg_m2", "kg m^2"),
    ("bore_mm", "mm"),
    ("boundary_friction", ""),
    ("centre_distance_mm", "mm"),
    ("clearance_um", "µm"),
    ("compression_ratio", ""),
    ("count", ""),
    ("crowned_ratio", ""),
    ("cylinders", ""),
    ("damping_nm_s_per_rad", "Nm s/rad"),
    ("decay_s_per_m", "s/m"),
    ("density_kg_m3", "kg/m^3"),
    ("design_load_n", "N"),
    ("drag_nm_s_per_rad", "Nm s/rad"),
    ("drag_torque_nm", "Nm"),
    ("drop_um", "µm"),
    ("duration_s", "s"),
    ("end_drop_um", "µm"),
    ("expansion_per_k", "1/K"),
    ("expansion_um_per_m_k", "µm/(m K)"),
    ("free_run_rpm", "rpm"),
    ("frequency_hz", "Hz"),
    ("friction", ""),
    ("friction_within", ""),
    ("front_mm", "mm"),
    ("front_tilt_rad", "rad"),
    ("gap_um", "µm"),
    ("gap_up_to_um", "µm"),
    ("housing_outside_radius_mm", "mm"),
    ("hunt_crossley_s_per_m", "s/m"),
    ("inertia_kg_m2", "kg m^2"),
    ("inner_bore_radius_mm", "mm"),
    ("inner_inertia_kg_m2", "kg m^2"),
    ("inner_interference_um", "µm"),
    ("inner_race_c", "°C"),
    ("inner_race_radius_mm", "mm"),
    ("inner_race_to_oil_w_per_k", "W/K"),
    ("inner_radius_mm", "mm"),
    ("intake_pressure_mpa", "MPa"),
    ("kinetic", ""),
    ("length_mm", "mm"),
    ("load_factor", ""),
    ("lobes", ""),
    ("mass_kg", "kg"),
    ("mean_pressure_mpa", "MPa"),
    ("nu100_mm2_s", "mm^2/s"),
    ("nu40_mm2_s", "mm^2/s"),
    ("number", ""),
    ("offset_mm", "mm"),
    ("order", ""),
    ("outer_inertia_kg_m2", "kg m^2"),
    ("outer_interference_um", "µm"),
    ("outer_outside_radius_mm", "mm"),
    ("outer_race_c", "°C"),
    ("outer_race_radius_mm", "mm"),
    ("outer_race_to_oil_w_per_k", "W/K"),
    ("outer_radius_mm", "mm"),
    ("overrun_rpm", "rpm"),
    ("path_mm", "mm"),
    ("phase_rad", "rad"),
    ("poisson_ratio", ""),
    ("polytropic_exponent", ""),
    ("preload_nm", "Nm"),
    ("race_roughness_um", "µm"),
    ("race_wear_mm3_per_nm", "mm^3/(Nm)"),
    ("radius_mm", "mm"),
    ("ratio", ""),
    ("rear_mm", "mm"),
    ("rear_tilt_rad", "rad"),
    ("reference_c", "°C"),
    ("reversing_torque_nm", "Nm"),
    ("rise", ""),
    ("rod_ratio", ""),
    ("roller_coefficient", ""),
    ("run_out_mm", "mm"),
    ("seed", ""),
    ("spectrum", ""),
    ("shaft_bore_radius_mm", "mm"),
    ("size_um", "µm"),
    ("size_within_um", "µm"),
    ("slices", ""),
    ("slip_heat_w", "W"),
    ("speed_m_s", "m/s"),
    ("speed_rpm", "rpm"),
    ("sprag_inner_radius_mm", "mm"),
    ("sprag_outer_radius_mm", "mm"),
    ("sprag_roughness_um", "µm"),
    ("sprag_wear_mm3_per_nm", "mm^3/(Nm)"),
    ("sprags_c", "°C"),
    ("sprags_to_oil_w_per_k", "W/K"),
    ("spring_factor", ""),
    ("start_radius_mm", "mm"),
    ("static", ""),
    ("step_time_s", "s"),
    ("steps", ""),
    ("stiffness_nm_per_rad", "Nm/rad"),
    ("stop_stiffness_nm_per_rad", "Nm/rad"),
    ("stroke_mm", "mm"),
    ("strut_angle_deg", "deg"),
    ("temperature_c", "°C"),
    ("temperature_k", "K"),
    ("tilt_mrad", "mrad"),
    ("torque_nm", "Nm"),
    ("torque_step_nm", "Nm"),
    ("until_rad", "rad"),
    ("viscous_damping_nm_s_per_rad", "Nm s/rad"),
    ("width_mm", "mm"),
    ("x_mm", "mm"),
    ("y_mm", "mm"),
    ("youngs_modulus_gpa", "GPa"),
];

/// Unit of variable `name` as printed, empty for a pure number; `None` where no design has such a variable.
pub fn variable_unit(name: &str) -> Option<&'static str> {
    let path = variable_path(name, usize::MAX)?;
    unit_of_key(path.rsplit('.').next()?)
}

/// Unit of the number under a key of the clutch's own tables, of a scenario, of `[[drivetrain]]` or of `[thermal]`; `None` where there is no such.
pub fn unit_of_key(key: &str) -> Option<&'static str> {
    UNITS.iter().find(|(known, _)| *known == key).map(|(_, unit)| *unit)
}

/// Dotted path of the key that variable `name` sets in a design of `arcs` inner arcs, or `None` where no
/// such variable exists: `r_i2_mm` gives `sprags.inner_arcs[1].radius_mm`, a dotted path itself.
pub fn variable_path(name: &str, arcs: usize) -> Option<String> {
    if let Some((table, _)) = name.split_once('.') {
        let known = OWN_TABLES.contains(&table) && shape::kind_of(name).is_some();
        return known.then(|| name.to_owned());
    }
    VARIABLES.iter().find_map(|(pattern, path, _)| match pattern.split_once("{k}") {
        None if *pattern != name || arcs == 0 && path.contains("{last}") => None,
        None => Some(path.replace("{last}", &arcs.saturating_sub(1).to_string())),
        Some((before, after)) => {
            let digits = name.strip_prefix(before)?.strip_suffix(after)?;
            let k: usize = digits.parse().ok()?;
            // The end of the last arc is no junction; and one spelling per variable, so not r_i02_mm.
            let last = if path.ends_with("until_rad") { arcs.saturating_sub(1) } else { arcs };
            (k >= 1 && k <= last && digits == k.to_string())
                .then(|| path.replace("{k}", &(k - 1).to_string()))
        }
    })
}

/// Whether variable `name`, or the key at this path, takes whole numbers only.
pub fn is_whole(name: &str, arcs: usize) -> bool {
    let path = variable_path(name, arcs).unwrap_or_else(|| name.to_owned());
    shape::kind_of(&path) == Some("integer")
}

/// The short names that a design of `arcs` inner arcs has.
pub fn variable_names(arcs: usize) -> Vec<String> {
    let all = VARIABLES.iter().flat_map(|(pattern, ..)| {
        let count = if pattern.contains("{k}") { arcs } else { 1 };
        (1..=count).map(move |k| pattern.replace("{k}", &k.to_string()))
    });
    all.filter(|name| variable_path(name, arcs).is_some()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arcs_count_from_one_and_the_last_end_is_no_junction() {
        let path = |name| variable_path(name, 3);
        assert_eq!(path("r_i1_mm").as_deref(), Some("sprags.inner_arcs[0].radius_mm"));
        assert_eq!(path("r_i3_mm").as_deref(), Some("sprags.inner_arcs[2].radius_mm"));
        assert_eq!(path("junction_2_rad").as_deref(), Some("sprags.inner_arcs[1].until_rad"));
        assert_eq!(path("profile_end_rad").as_deref(), Some("sprags.inner_arcs[2].until_rad"));
        for none in
            ["r_i0_mm", "r_i4_mm", "r_i01_mm", "r_i+1_mm", "junction_3_rad", "r_i{k}_mm", "mass_kg", ""]
        {
            assert_eq!(path(none), None, "{none}");
        }
        assert_eq!(variable_names(1).len(), 18);
        assert!(
            is_whole("count", 3)
                && is_whole("sprags.count", 3)
                && is_whole("contact.slices", 3)
                && !is_whole("r_i1_mm", 3)
        );
    }

    /// Every number that may be a variable, by its dotted path in the schema, and every short name.
    #[test]
    fn every_variable_has_a_unit() {
        fn numbers(schema: &serde_json::Value, path: &str, found: &mut Vec<String>) {
            match schema["type"].as_str() {
                Some("object") => {
                    for (key, inner) in schema["properties"].as_object().into_iter().flatten() {
                        numbers(inner, &format!("{path}.{key}"), found);
                    }
                }
                Some("array") => numbers(&schema["items"], &format!("{path}[0]"), found),
                Some("number" | "integer") => found.push(path.to_owned()),
                _ => {}
            }
        }
        let schema = shape::schema();
        let mut all = variable_names(3);
        let short = all.len();
        for table in OWN_TABLES {
            numbers(&schema["properties"][table], table, &mut all);
        }
        assert!(all.len() > short + 50, "{}", all.len());
        let without: Vec<&String> = all.iter().filter(|name| variable_unit(name).is_none()).collect();
        assert!(without.is_empty(), "{without:?}");
        let own = all.len();
        for table in OTHER_TABLES {
            numbers(&schema["properties"][table], table, &mut all);
        }
        // A key, without the places in its array.
        let key =
            |path: &str| path.rsplit('.').next().and_then(|key| key.split('[').next()).unwrap().to_owned();
        let without = |name: &&String| unit_of_key(&key(name)).is_none();
        assert_eq!(all[own..].iter().find(without), None);
        for (known, _) in UNITS {
            assert!(all.iter().any(|path| key(path) == *known), "no key {known}");
        }
        let unit = |name| variable_unit(name).unwrap();
        assert_eq!(unit("races.viscous_damping_nm_s_per_rad"), "Nm s/rad");
        assert_eq!(unit("contact.tilt_mrad"), "mrad");
        assert_eq!((unit("r_i2_mm"), unit("junction_1_rad"), unit("count")), ("mm", "rad", ""));
        assert_eq!(variable_unit("r_i0_mm"), None);
    }

    #[test]
    fn any_number_of_the_clutch_has_a_dotted_name() {
        for name in
            ["races.outer_outside_radius_mm", "spring.stiffness_nm_per_rad", "sprags.inner_arcs[1].until_rad"]
        {
            assert_eq!(variable_path(name, 3).as_deref(), Some(name));
        }
        for none in [
            "races.nothing",
            "races",
            "limits.hoop_inner_mpa",
            "scenarios[0].preload_nm",
            "sprags.flanks",
            "schema",
        ] {
            assert_eq!(variable_path(none, 3), None, "{none}");
        }
    }
}
