//! What every outline must satisfy, over random profiles; and the samples the room's tests share.

use super::{Flanks, Outline, Profile, Segment};
use nalgebra::Vector2;
use std::f64::consts::TAU;

/// Table 1 with r_e = 4.68 mm, e_1 = 0.62 mm of the public model of the same clutch.
pub(super) fn table_1(arcs: &[(f64, f64)]) -> Profile {
    Profile::new(4.68e-3, 0.62e-3, arcs, 11.11e-3, 19.44e-3).unwrap()
}

/// SplitMix64 (Steele, Lea, Flood 2014): the same numbers on every machine.
pub(super) struct Random(pub u64);

impl Random {
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        low + (high - low) * (z >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// A sprag of one to five arcs, if the drawn flanks leave its working profile whole.
pub(super) fn random_outline(random: &mut Random) -> Option<(Profile, Outline)> {
    let outer_radius = random.between(3e-3, 7e-3);
    let mut radius = outer_radius * random.between(0.7, 1.3);
    let first = radius;
    let centre_distance = outer_radius * random.between(0.05, 0.25);
    let inner_race = outer_radius * random.between(1.5, 10.0);
    // OC_i - OC_e must lie between -e and e.
    let outer_race = inner_race + first + outer_radius - centre_distance * random.between(-0.3, 0.95);
    let (mut arcs, mut until) = (Vec::new(), 0.0);
    for _ in 0..random.between(1.0, 5.999) as usize {
        until += random.between(0.02, 0.15);
        arcs.push((radius, until));
        radius *= random.between(0.93, 1.08);
    }
    let profile = Profile::new(outer_radius, centre_distance, &arcs, inner_race, outer_race).ok()?;
    let rear_m = outer_radius * random.between(0.3, 0.75);
    let front_m = outer_radius * random.between(0.3, 0.75);
    // One in three stands parallel to the strut.
    let lean = if random.between(0.0, 1.0) < 1.0 / 3.0 { 0.0 } else { 0.5 };
    let (rear_tilt_rad, front_tilt_rad) =
        (lean * random.between(-1.0, 1.0), lean * random.between(-1.0, 1.0));
    let outline =
        Outline::closed(&profile, &Flanks { rear_m, front_m, rear_tilt_rad, front_tilt_rad }).ok()?;
    Some((profile, outline))
}

/// The outline turned about the origin towards larger azimuths, then shifted.
pub(super) fn moved(outline: &Outline, turn: f64, shift: Vector2<f64>) -> Outline {
    Outline::planted(outline.segments().iter().map(|s| s.moved(turn, shift)).collect())
}

/// Exterior angle from one segment to the next, rad, positive to the left, between -pi and pi.
fn corner(segment: &Segment, next: &Segment) -> f64 {
    let angle = (segment.normal_azimuths().1 - next.normal_azimuths().0).rem_euclid(TAU);
    if angle > TAU / 2.0 { angle - TAU } else { angle }
}

#[test]
fn every_outline_is_closed_convex_and_weighs_something() {
    let mut random = Random(2017);
    let mut built = 0;
    for trial in 0..1000 {
        let Some((profile, outline)) = random_outline(&mut random) else { continue };
        built += 1;
        let segments = outline.segments();
        assert_eq!(segments.len(), profile.arcs.len() + 3);
        let mut turning = 0.0;
        for (i, segment) in segments.iter().enumerate() {
            let next = &segments[(i + 1) % segments.len()];
            assert!((segment.end_m() - next.start_m()).norm() < 1e-16, "{trial}: gap after {i}");
            let exterior = corner(segment, next);
            if i + 1 < profile.arcs.len() {
                assert!(exterior.abs() < 1e-14, "{trial}: kink of {exterior} at junction {i}");
            } else {
                assert!(exterior > 0.0 && exterior < TAU / 2.0, "{trial}: corner {i} of {exterior}");
            }
            if let Segment::Arc { sweep_rad, .. } = segment {
                assert!(*sweep_rad < 0.0, "{trial}: arc {i} runs clockwise");
                turning -= sweep_rad;
            }
            turning += exterior;
        }
        // All turns to the left and once round in all: convex, so it cannot cross itself.
        assert!((turning - TAU).abs() < 1e-12, "{trial}: turns by {turning}");

        let line = outline.polyline(1e-5);
        let (one, three) = (outline.mass_properties(2e-3, 7850.0), outline.mass_properties(6e-3, 7850.0));
        assert!(one.area_m2 > 0.0 && one.inertia_kg_m2 > 0.0);
        assert!((three.mass_kg / one.mass_kg - 3.0).abs() < 1e-14);
        assert!((three.inertia_kg_m2 / one.inertia_kg_m2 - 3.0).abs() < 1e-14);
        for axis in 0..2 {
            let low = line.iter().map(|p| p[axis]).fold(f64::INFINITY, f64::min);
            let high = line.iter().map(|p| p[axis]).fold(f64::NEG_INFINITY, f64::max);
            assert!(low < one.centroid_m[axis] && one.centroid_m[axis] < high, "{trial}: centroid outside");
        }
        // The disc of the same area has the least polar moment: J >= A^2/(2 pi).
        let polar = one.inertia_kg_m2 / (2e-3 * 7850.0);
        assert!(polar > one.area_m2.powi(2) / TAU, "{trial}: below the disc's moment");
        for arc in &profile.arcs {
            for turn in [arc.from_rad, 0.5 * (arc.from_rad + arc.until_rad), arc.until_rad] {
                let contact = arc.centre_m + arc.radius_m * profile.contact_direction(turn);
                assert!(
                    distance(segments, contact) < 1e-16,
                    "{trial}: contact at turn {turn} is off the outline"
                );
            }
        }
    }
    println!("{built} outlines of 1000 draws");
    assert!(built > 300, "only {built}");
}

/// Distance of a point from the nearest arc of the outline, m.
fn distance(segments: &[Segment], point: Vector2<f64>) -> f64 {
    let of = |segment: &Segment| match *segment {
        Segment::Line { .. } => f64::INFINITY,
        Segment::Arc { centre_m, radius_m, from_azimuth_rad, sweep_rad } => {
            let seen = point - centre_m;
            let past = (from_azimuth_rad - seen.x.atan2(seen.y) + 1e-9).rem_euclid(TAU);
            if past <= 2e-9 - sweep_rad { (seen.norm() - radius_m).abs() } else { f64::INFINITY }
        }
    };
    segments.iter().map(of).fold(f64::INFINITY, f64::min)
}
