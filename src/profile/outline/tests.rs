//! Outlines with planted flanks: contacts, cuts, polylines.

use super::*;
use crate::profile::properties::table_1;

const SINGLE: [(f64, f64); 1] = [(4.02e-3, 0.45)];
const MULTI: [(f64, f64); 3] = [(4.02e-3, 0.06), (4.08e-3, 0.12), (4.15e-3, 0.45)];

#[test]
fn outer_contact_starts_at_b_and_moves_to_the_rear() {
    let profile = table_1(&MULTI);
    assert!(profile.outer_contact_azimuth(0.0).abs() < 1e-15);
    // Body rotation = turn + change of beta, and beta is at most asin(e/OC_e) = 0.042.
    let rotation = -profile.outer_contact_azimuth(0.45);
    assert!((0.44..0.47).contains(&rotation), "{rotation}");
    // Continuous across junctions.
    let (before, after) = (profile.outer_contact_azimuth(0.06), profile.outer_contact_azimuth(0.06 + 1e-12));
    assert!((before - after).abs() < 2e-12);
}

#[test]
fn a_flank_that_cuts_the_working_profile_says_how_much() {
    let profile = table_1(&MULTI);
    let Err(OutlineError::CutsInner { lost_rad, needed_m, .. }) = Outline::new(&profile, 2.525e-3, 1.5e-3)
    else {
        panic!("front flank at 1.5 mm must cut the third arc")
    };
    println!("front need {needed_m}, lost {lost_rad}");
    assert!(lost_rad > 0.01 && lost_rad < 0.2, "{lost_rad}");
    // The amounts are exact: just above it closes, just below almost nothing is lost.
    assert!(Outline::new(&profile, 2.525e-3, needed_m + 1e-9).is_ok());
    let Err(OutlineError::CutsInner { lost_rad, .. }) = Outline::new(&profile, 2.525e-3, needed_m - 1e-9)
    else {
        panic!("just below the need")
    };
    assert!(lost_rad > 0.0 && lost_rad < 1e-6, "{lost_rad}");

    let Err(OutlineError::CutsOuter { needed_m, .. }) = Outline::new(&profile, 1.0e-3, 2.525e-3) else {
        panic!("rear flank at 1 mm must cut the outer contact range")
    };
    println!("rear need {needed_m}");
    assert!((1.9e-3..2.2e-3).contains(&needed_m), "{needed_m}");
    assert!(Outline::new(&profile, needed_m + 1e-9, 2.525e-3).is_ok());
    assert!(Outline::new(&profile, needed_m - 1e-9, 2.525e-3).is_err());
}

#[test]
fn the_turn_lost_counts_on_the_arc_that_is_cut() {
    // At a half width inside arc 2 the flank leaves turns beyond 0.06 and before 0.12.
    let profile = table_1(&MULTI);
    let foot = profile.arcs[0].centre_m + 4.02e-3 * profile.contact_direction(0.0);
    let up = (Vector2::new(0.0, 4.68e-3) - foot).normalize();
    let at = profile.arcs[1].centre_m + 4.08e-3 * profile.contact_direction(0.1) - foot;
    let Err(OutlineError::CutsInner { lost_rad, .. }) =
        Outline::new(&profile, 2.525e-3, at.x * up.y - at.y * up.x)
    else {
        panic!("must cut arc 2")
    };
    assert!((lost_rad - 0.35).abs() < 1e-12, "{lost_rad}");
}

#[test]
fn the_narrowest_outline_is_five_per_cent_beyond_the_need_where_the_arcs_leave_that() {
    let bound = |profile: &Profile, rear, front| match Outline::new(profile, rear, front) {
        Err(OutlineError::CutsInner { needed_m, .. } | OutlineError::CutsOuter { needed_m, .. }) => needed_m,
        Err(OutlineError::MissesInner { reach_m, .. }) => reach_m,
        other => panic!("{other:?}"),
    };
    for arcs in [&SINGLE[..], &MULTI, &[(4.02e-3, 1e-3)], &[(4.02e-3, 0.8)]] {
        let profile = table_1(arcs);
        let (rear, front) = (bound(&profile, 1e-9, 3.5e-3), bound(&profile, 3.5e-3, 1e-9));
        // At 0.8 rad the first arc ends within 5 % of the rear need.
        let reach = bound(&profile, 4.4e-3, 3.5e-3);
        assert_eq!(BEYOND * rear > 0.5 * (rear + reach), arcs == [(4.02e-3, 0.8)]);
        let rear = (BEYOND * rear).min(0.5 * (rear + reach));
        let want = Outline::new(&profile, rear, BEYOND * front);
        assert_eq!(Outline::narrowest(&profile), want, "{arcs:?}");
        assert!(want.is_ok());
    }
    // At 1.4 rad the outer contacts lie beyond all that the inner arc reaches: nothing closes that.
    let mut profile = table_1(&[(4.02e-3, 1.4)]);
    let why = Outline::narrowest(&profile);
    assert!(matches!(why, Err(OutlineError::MissesInner { side: FlankSide::Rear, .. })), "{why:?}");
    profile.arcs.clear();
    assert_eq!(Outline::narrowest(&profile), Err(OutlineError::NoArcs));
}

#[test]
fn errors_say_millimetres() {
    let profile = table_1(&MULTI);
    let said = |rear, front| Outline::new(&profile, rear, front).unwrap_err().to_string();
    assert!(said(2.525e-3, 1.5e-3).starts_with("the front flank, 1.5000 mm from the strut line, cuts 0."));
    assert!(said(1e-3, 2.525e-3).starts_with("the rear flank, 1.0000 mm from the strut line, cuts 0."));
    assert!(said(4.4e-3, 2.5e-3).contains("rear flank, 4.4000 mm from the strut line, passes the inner arc"));
    assert!(said(-1e-3, 2.5e-3).contains("-1 mm from the strut line, not above 0"));
}

#[test]
fn impossible_flanks_are_refused() {
    let profile = table_1(&SINGLE);
    for bad in [0.0, -1e-3, f64::NAN, f64::INFINITY] {
        assert!(matches!(
            Outline::new(&profile, bad, 2.5e-3),
            Err(OutlineError::NotPositive { side: FlankSide::Rear, .. })
        ));
        assert!(matches!(
            Outline::new(&profile, 2.5e-3, bad),
            Err(OutlineError::NotPositive { side: FlankSide::Front, .. })
        ));
    }
    let Err(OutlineError::MissesInner { side: FlankSide::Rear, reach_m, .. }) =
        Outline::new(&profile, 4.4e-3, 2.5e-3)
    else {
        panic!("4.4 mm is wider than the inner arc")
    };
    assert!(!matches!(Outline::new(&profile, reach_m - 1e-9, 2.5e-3), Err(OutlineError::MissesInner { .. })));
    let Err(OutlineError::MissesInner { side: FlankSide::Front, reach_m, .. }) =
        Outline::new(&profile, 2.5e-3, 4.4e-3)
    else {
        panic!("4.4 mm is wider than the inner arc")
    };
    assert!(!matches!(Outline::new(&profile, 2.5e-3, reach_m - 1e-9), Err(OutlineError::MissesInner { .. })));
    let mut bare = profile.clone();
    bare.arcs.clear();
    assert_eq!(Outline::new(&bare, 2.5e-3, 2.5e-3), Err(OutlineError::NoArcs));
    let mut small = profile;
    small.outer_radius_m = 2.4e-3;
    assert!(matches!(Outline::new(&small, 2.5e-3, 2.5e-3), Err(OutlineError::MissesOuter { .. })));
}

#[test]
fn polyline_keeps_its_tolerance_and_its_vertices_lie_on_the_outline() {
    let outline = Outline::new(&table_1(&SINGLE), 2.525e-3, 2.525e-3).unwrap();
    for tolerance in [1e-4, 1e-6, 1e-8] {
        let line = outline.polyline(tolerance);
        let mut farthest = 0.0_f64;
        for (i, p) in line.iter().enumerate() {
            let q = line[(i + 1) % line.len()];
            let middle = Vector2::new(p[0] + q[0], p[1] + q[1]) / 2.0;
            // Only outer chords: both ends on the outer arc.
            if (p[0].hypot(p[1]) - 4.68e-3).abs() < 1e-15 && (q[0].hypot(q[1]) - 4.68e-3).abs() < 1e-15 {
                farthest = farthest.max(4.68e-3 - middle.norm());
            }
        }
        assert!(
            farthest <= tolerance * (1.0 + 1e-9) && farthest > 0.2 * tolerance,
            "{tolerance}: {farthest}"
        );
    }
    for strange in [0.0, -1.0, f64::NAN] {
        assert_eq!(outline.polyline(strange).len(), 2 * 4096 + 2);
    }
    assert_eq!(outline.polyline(f64::INFINITY).len(), 4);
}
