//! The design variables that `[optimize]` may name.
//!
//! In: a variable's name and the number of inner arcs. Out: the dotted path of the key that it stands for.
//! Absent: bounds and values. Equations: none.

/// Every variable: pattern of the name, pattern of the path of the key it sets, meaning. `{k}` counts inner
/// arcs from 1 in a name and from 0 in a path; `{last}` is the last arc.
pub const VARIABLES: &[(&str, &str, &str)] = &[
    ("r_i{k}_mm", "sprags.inner_arcs[{k}].radius_mm", "radius of inner arc k"),
    ("junction_{k}_rad", "sprags.inner_arcs[{k}].until_rad", "turn at which arc k gives way to arc k+1"),
    ("profile_end_rad", "sprags.inner_arcs[{last}].until_rad", "turn at which the last arc ends"),
    ("outer_radius_mm", "sprags.outer_radius_mm", "radius r_e of the sprag's outer arc"),
    ("centre_distance_mm", "sprags.centre_distance_mm", "centre distance e_1"),
    ("length_mm", "sprags.length_mm", "length of the sprags"),
    ("width_mm", "sprags.width_mm", "body width b of (6)"),
    ("flank_rear_mm", "sprags.flanks.rear_mm", "flank on the side of negative x"),
    ("flank_front_mm", "sprags.flanks.front_mm", "flank on the side of positive x"),
    ("centroid_x_mm", "sprags.centroid.x_mm", "centroid, towards positive azimuth"),
    ("centroid_y_mm", "sprags.centroid.y_mm", "centroid, radially outward from C_e"),
];

/// Dotted path of the key that variable `name` sets in a design of `arcs` inner arcs, or `None` where no
/// such variable exists: `r_i2_mm` gives `sprags.inner_arcs[1].radius_mm`.
pub fn variable_path(name: &str, arcs: usize) -> Option<String> {
    VARIABLES.iter().find_map(|(pattern, path, _)| match pattern.split_once("{k}") {
        None if *pattern == name => Some(path.replace("{last}", &arcs.saturating_sub(1).to_string())),
        None => None,
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

/// The names that a design of `arcs` inner arcs has.
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
        assert_eq!(variable_names(1).len(), 10);
    }
}
