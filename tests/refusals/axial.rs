//! Refusals of what lies along the axis: end profile, tilt, offset, slices.

use super::{Case, hold};

#[test]
#[rustfmt::skip] // one way per line
fn axial_arrangement() {
    // A key more in [contact], the key at fault, what the line shows, what the help says.
    let cases: &[(&str, &str, &str, &[&str])] = &[
        ("axial_offset_mm = -6.0", "axial_offset_mm", "axial_offset_mm = -6.0", &["less than 6 mm either way", "races.width_mm = 6.0"]),
        ("tilt_mrad = 101.0", "tilt_mrad", "101.0", &["at most 100"]),
        ("tilt_mrad = nan", "tilt_mrad", "nan", &["finite"]),
        ("tilt_mrad = 1.0\nslices = 9", "slices", "slices = 9", &["at least 10", "60 is the default"]),
        ("end_profile = { kind = \"cone\" }", "end_profile.kind", "cone", &["lundberg"]),
        ("end_profile = { kind = \"lundberg\" }", "end_profile.kind", "lundberg", &["add design_load_n"]),
        ("end_profile = { kind = \"lundberg\", design_load_n = 0.0 }", "end_profile.design_load_n", "design_load_n = 0.0", &["above 0"]),
        ("end_profile = { kind = \"square\", radius_mm = 1.0 }", "end_profile.radius_mm", "radius_mm = 1.0", &["no radius_mm with this kind"]),
        ("end_profile = { kind = \"crown\", radius_mm = 2.0 }", "end_profile.radius_mm", "radius_mm = 2.0", &["at least half the sprag's length, 3 mm"]),
        ("end_profile = { kind = \"end-relief\", length_mm = 4.0, radius_mm = 50.0 }", "end_profile.length_mm", "length_mm = 4.0", &["at most half the sprag's length, 3 mm"]),
        ("end_profile = { kind = \"fujiwara-kawase\", design_load_n = 1e3, load_factor = 1.0, crowned_ratio = 1.1, end_drop_um = 5.0 }", "end_profile.crowned_ratio", "crowned_ratio = 1.1", &["at most 1"]),
        ("end_profile = { kind = \"table\", points = [ { y_mm = -3.0, drop_um = -1.0 }, { y_mm = 3.0, drop_um = 0.0 } ] }", "end_profile.points[0].drop_um", "drop_um = -1.0", &["at least 0"]),
        ("end_profile = { kind = \"table\", points = [ { y_mm = -3.0, drop_um = inf }, { y_mm = 3.0, drop_um = 0.0 } ] }", "end_profile.points[0].drop_um", "drop_um = inf", &["finite"]),
        ("end_profile = { kind = \"table\", points = [ { y_mm = 3.0, drop_um = 1.0 }, { y_mm = -3.0, drop_um = 0.0 } ] }", "end_profile.points[1].y_mm", "y_mm = -3.0", &["more than that of the point before, 3 mm"]),
        ("end_profile = { kind = \"table\", points = [ { y_mm = -2.0, drop_um = 1.0 }, { y_mm = 3.0, drop_um = 0.0 } ] }", "end_profile.points", "points = [", &["-3 to 3 mm"]),
        ("end_profile = { kind = \"table\", points = [ { y_mm = -2.0, drop_um = 1.0 } ] }", "end_profile.points", "points = [", &["at least"]),
    ];
    hold(&[Case(&[("[limits]", "[limits]\nalong_mpa = 5000.0")], "limits.along_mpa", "along_mpa = 5000.0", &["end_profile", "square end"])]);
    for (line, key, shown, help) in cases {
        let with = format!("law = \"roller\"\n{line}");
        let key = format!("contact.{key}");
        hold(&[Case(&[("law = \"roller\"", &with)], &key, shown, help)]);
    }
}
