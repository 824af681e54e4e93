use super::*;
use crate::profile::Profile;

/// Table 1 of Huang 2017 with the assumed junctions, outline closed by plain chords.
pub fn table_1(rotation_rad: f64) -> Drawing {
    let profile = Profile::new(
        4.68e-3,
        0.62e-3,
        &[(4.02e-3, 0.06), (4.08e-3, 0.12), (4.15e-3, 0.45)],
        11.11e-3,
        19.44e-3,
    )
    .unwrap();
    let mut pose = SpragPose::at_first_contact("Table 1", &profile, Vec::new(), Some([0.1935e-3, 0.5288e-3]));
    let rest_m = pose.outer_centre_distance_m;
    pose = pose.moved("Table 1", rotation_rad, rest_m);
    let last = pose.arcs.len() - 1;
    for (k, arc) in pose.arcs.iter().enumerate() {
        let (from, until) =
            (if k == 0 { -0.5 } else { arc.from_rad }, if k == last { 0.45 } else { arc.until_rad });
        for i in 0..=20 {
            pose.outline_m.push(pose.profile_point_m(arc, from + (until - from) * f64::from(i) / 20.0));
        }
    }
    // Turn runs from -x to +x, so the outer arc runs back.
    for i in 0..=60 {
        let azimuth = 0.62 - 1.24 * f64::from(i) / 60.0;
        pose.outline_m.push([4.68e-3 * azimuth.sin(), 4.68e-3 * azimuth.cos()]);
    }
    Drawing { race_radii_m: [7.21e-3, 11.11e-3, 19.44e-3, 26.23e-3], count: 12, poses: vec![pose] }
}

#[test]
fn contacts_lie_on_both_races_at_first_contact() {
    let drawing = table_1(0.0);
    let pose = &drawing.poses[0];
    let a = pose.inner_contact_m().unwrap();
    let b = pose.outer_contact_m();
    assert!((a[0].hypot(a[1]) - 11.11e-3).abs() < 1e-9, "{a:?}");
    assert!((b[0].hypot(b[1]) - 19.44e-3).abs() < 1e-15, "{b:?}");
    // A lies ahead of B: to the right on the page.
    assert!(a[0] > 0.0);
    let (arc, turn) = pose.active_arc().unwrap();
    assert!(arc.radius_m == 4.02e-3 && turn.abs() < 1e-12, "{turn}");
}

#[test]
fn engagement_moves_the_contact_along_the_arcs_in_order() {
    let mut last = -1.0;
    for (rotation, radius) in [(0.0, 4.02e-3), (0.08, 4.08e-3), (0.2, 4.15e-3)] {
        let drawing = table_1(rotation);
        let (arc, turn) = drawing.poses[0].active_arc().unwrap();
        assert!(turn > last);
        last = turn;
        assert_eq!(arc.radius_m, radius, "turn {turn} at rotation {rotation}");
        assert!(turn >= arc.from_rad && turn <= arc.until_rad);
    }
}

#[test]
fn the_active_contact_is_the_lowest_point_of_the_profile() {
    let drawing = table_1(0.1);
    let pose = &drawing.poses[0];
    let a = pose.inner_contact_m().unwrap();
    let lowest =
        pose.outline_m.iter().map(|&p| pose.place(p)).map(|p| p[0].hypot(p[1])).fold(f64::INFINITY, f64::min);
    assert!((a[0].hypot(a[1]) - lowest).abs() < 1e-6, "polyline within its chord error");
    assert!(a[0].hypot(a[1]) <= lowest + 1e-12);
}

#[test]
fn drawings_hold_no_nan_and_name_no_other_place() {
    let mut drawing = table_1(0.05);
    let mut broken = drawing.poses[0].clone();
    broken.arcs[0].radius_m = f64::NAN;
    let mut other = drawing.poses[0].clone();
    (other.label, other.rotation_rad) = ("<after>".into(), 0.3);
    drawing.poses.push(other);
    drawing.poses.push(broken);
    for svg in [drawing.small_svg(0.03), drawing.detail_figure(), drawing.centres_figure()] {
        assert!(!svg.contains("NaN") && !svg.contains("inf"));
        assert!(
            !svg.contains("<after>")
                && svg.matches("http").count() == svg.matches("xmlns").count()
                && !svg.contains(" id=")
        );
    }
    assert!(drawing.detail_figure().contains("&lt;after&gt;"));
    assert_eq!(drawing.small_svg(0.03).matches("<path").count(), 2 + 2 * 12 + 2);
}

#[test]
fn the_sheet_has_every_dimension_at_a_scale_that_it_states() {
    let svg = table_1(0.0).sheet_figure([6e-3, 6e-3], &["12 sprags".into()]);
    for word in [
        "⌀ 14.42 bore",
        "⌀ 22.22 inner track",
        "⌀ 38.88 outer track",
        "⌀ 52.46 outside",
        "Clutch, scale 1:1",
        "no load, scale 5:1",
        "rₑ 4.68<",
        "rᵢ₁ 4.02<",
        "rᵢ₃ 4.15<",
        "race gap 8.33 mm",
        "e₁ = C₁Cₑ 0.62 mm",
        "ω 4.",
        "ν 2.",
        ">2|3, 0.12 rad",
        "12 sprags",
    ] {
        assert!(svg.contains(word), "{word} in {svg}");
    }
    // A sprag 5.8 mm wide fills the place, which labels at 5:1 leave it.
    let mut wide = table_1(0.0);
    wide.poses[0].outline_m.extend([[2.9e-3, 0.0], [-2.9e-3, 0.0]]);
    assert!(wide.sheet_figure([6e-3, 6e-3], &[]).contains("no load, scale 5:1"));
    // An outside of 1049 mm.
    let large = Drawing { race_radii_m: table_1(0.0).race_radii_m.map(|r| 20.0 * r), ..table_1(0.0) };
    assert!(large.sheet_figure([0.1, 0.1], &[]).contains("Clutch, scale 1:20"));
    let nothing = Drawing { race_radii_m: [0.0; 4], count: 0, poses: vec![] };
    assert!(nothing.sheet_figure([0.0; 2], &[]).ends_with("</svg>"));
}

#[test]
fn a_drawing_without_sprags_or_sense_is_empty_not_a_panic() {
    let nothing = Drawing { race_radii_m: [0.0; 4], count: 0, poses: vec![] };
    for svg in [nothing.small_svg(0.0), nothing.detail_figure(), nothing.centres_figure()] {
        assert!(svg.starts_with("<svg") && !svg.contains("NaN"));
    }
}

#[test]
fn spread_labels_keep_their_order_and_distance() {
    let placed = spread(&[10.0, 11.0, 200.0, 9.0], 20.0, 0.0, 205.0);
    assert_eq!(placed, [29.0, 49.0, 200.0, 9.0]);
    let crowded = spread(&[100.0, 100.0, 100.0], 20.0, 0.0, 110.0);
    assert_eq!(crowded, [70.0, 90.0, 110.0]);
}

#[test]
fn subscripts() {
    assert_eq!((subscript("C", 1), subscript("r", 12)), ("C₁".into(), "r₁₂".into()));
}
