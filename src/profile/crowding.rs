//! Clearance between neighbouring sprags, exact for convex outlines.
//!
//! Two convex bodies are apart by the largest gap over all directions n between their supporting lines,
//! c = max_n [min_B n.p - max_A n.p]; where they overlap the same maximum is minus the shortest translation
//! that parts them. With arcs and corners a gap is v.n - rho piece by piece, so its maximum is known exactly:
//! |v| - rho with n along v, or a value where pieces meet.

use super::outline::{Outline, along};
use nalgebra::Vector2;
use std::f64::consts::{PI, TAU};

/// Slack of a range of normals, rad. A supporting line taken from an arc so far beyond its end is off by
/// the square of it, below rounding.
const SLACK_RAD: f64 = 1e-9;

/// What a range of normals is taken to be wider at either end where it is looked at roughly, rad: above all rounding.
const WIDER_RAD: f64 = 1e-4;

/// A touch less deep than this may be passed over by [`touch_rotation_rad`], m: a choice.
const PASSED_OVER_M: f64 = 1e-8;

/// An arc of the outline, or a corner as an arc of radius 0, with the outward normals it carries.
struct Feature {
    centre: Vector2<f64>,
    radius: f64,
    from_azimuth: f64,
    /// Not negative, clockwise azimuth falling: normals reach from `from_azimuth - span`.
    span: f64,
    /// The direction amid its normals, and the cosine of half of what they span, a little more.
    amid: Vector2<f64>,
    reach: f64,
}

impl Feature {
    fn new(centre: Vector2<f64>, radius: f64, from_azimuth: f64, span: f64) -> Self {
        let half = (0.5 * span + WIDER_RAD).min(PI);
        Self { centre, radius, from_azimuth, span, amid: along(from_azimuth - 0.5 * span), reach: half.cos() }
    }

    /// Whether it may carry a normal along `v`: false where it does not, at a tenth of the cost of an azimuth.
    fn may_carry(&self, v: &Vector2<f64>) -> bool {
        v.dot(&self.amid) >= self.reach * v.norm()
    }

    fn carries(&self, azimuth: f64) -> bool {
        let past = self.from_azimuth - azimuth;
        // The remainder of what is less than a turn is itself: no division.
        let past = match past {
            within if (0.0..TAU).contains(&within) => within,
            below if (-TAU..0.0).contains(&below) => below + TAU,
            far => far.rem_euclid(TAU),
        };
        past <= self.span + SLACK_RAD || past >= TAU - SLACK_RAD
    }
}

/// A direction in which a range of normals of either begins or ends.
struct RangeEnd {
    along: Vector2<f64>,
    /// How far the one reaches along it, and the other against it, m.
    reach_m: [f64; 2],
}

/// One sprag and its neighbour, `pitch` further round O.
struct Neighbours {
    features: Vec<Feature>,
    pitch: f64,
    /// Centres of the neighbour's features, seen in the sprag's own frame.
    there: Vec<Vector2<f64>>,
    ends: Vec<RangeEnd>,
}

impl Neighbours {
    /// None below two sprags.
    fn new(outline: &Outline, count: usize) -> Option<Self> {
        (count >= 2).then(|| Self::apart(outline, TAU / count as f64))
    }

    /// Two that stand `pitch` apart.
    fn apart(outline: &Outline, pitch: f64) -> Self {
        let segments = outline.segments();
        let mut features = Vec::with_capacity(2 * segments.len());
        for (segment, next) in segments.iter().zip(segments.iter().cycle().skip(1)) {
            if let super::Segment::Arc { centre_m, radius_m, from_azimuth_rad, sweep_rad } = *segment {
                features.push(Feature::new(centre_m, radius_m, from_azimuth_rad, -sweep_rad));
            }
            let from_azimuth = segment.normal_azimuths().1;
            // Exterior angle, below a half turn in a convex outline; rounding may leave it just below zero.
            let mut span = (from_azimuth - next.normal_azimuths().0).rem_euclid(TAU);
            if span > PI {
                span = 0.0;
            }
            features.push(Feature::new(segment.end_m(), 0.0, from_azimuth, span));
        }
        let facing = PI - pitch;
        // far.centre seen by n(phi): c.dir(phi + facing) = (c turned by -facing).n(phi).
        let there = features.iter().map(|far| turned(far.centre, -facing)).collect();
        let mut neighbours = Self { features, pitch, there, ends: Vec::new() };
        let ends = neighbours.features.iter().flat_map(|f| [f.from_azimuth, f.from_azimuth - f.span]);
        let ends = ends.flat_map(|end| [end, end - facing]).map(|azimuth| {
            let reach_m = [neighbours.support(azimuth), neighbours.support(azimuth + facing)];
            RangeEnd { along: along(azimuth), reach_m }
        });
        neighbours.ends = ends.collect();
        neighbours
    }

    /// Largest n.p over the outline for the direction n at `azimuth`, m.
    fn support(&self, azimuth: f64) -> f64 {
        let n = along(azimuth);
        let reach = |f: &Feature| {
            if f.radius == 0.0 || f.carries(azimuth) {
                f.centre.dot(&n) + f.radius
            } else {
                f64::NEG_INFINITY
            }
        };
        self.features.iter().map(reach).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Distance C_e C_e' of the neighbours' outer centres, m.
    fn chord(&self, oc_e: f64) -> f64 {
        2.0 * oc_e * (self.pitch / 2.0).sin()
    }

    /// Signed clearance, m. In the body frame the neighbour is the body turned by the pitch p and moved by
    /// s = OC_e [dir(p - Omega) - dir(-Omega)], so the gap along n(phi) is s.n - h(phi) - h(phi + pi - p).
    fn clearance(&self, oc_e: f64, rotation: f64) -> f64 {
        let facing = PI - self.pitch;
        let s = self.chord(oc_e) * along((PI + self.pitch) / 2.0 - rotation);
        let gap =
            |azimuth: f64| s.dot(&along(azimuth)) - self.support(azimuth) - self.support(azimuth + facing);
        let at_end = |end: &RangeEnd| s.dot(&end.along) - end.reach_m[0] - end.reach_m[1];
        let mut widest = self.ends.iter().map(at_end).fold(f64::NEG_INFINITY, f64::max);
        for near in &self.features {
            for (far, there) in self.features.iter().zip(&self.there) {
                let v = s - near.centre - there;
                if !near.may_carry(&v) {
                    continue;
                }
                let azimuth = v.x.atan2(v.y);
                if near.carries(azimuth) && far.carries(azimuth + facing) {
                    widest = widest.max(gap(azimuth));
                }
            }
        }
        widest
    }
}

/// `v` turned by an angle towards larger azimuths.
fn turned(v: Vector2<f64>, angle: f64) -> Vector2<f64> {
    let (sin, cos) = angle.sin_cos();
    Vector2::new(v.x * cos + v.y * sin, v.y * cos - v.x * sin)
}

/// Clearance between one of `count` sprags and its neighbour, m, exact to rounding.
///
/// `outer_centre_distance_m` is OC_e, m; `rotation_rad` the body's rotation Omega about C_e relative to the
/// line OC_e from first contact at rest, rad, positive in engagement. Negative where the two overlap: minus
/// the shortest translation that parts them, m. Infinite where there is no neighbour (`count` below 2); minus
/// infinity, never NaN, where an argument is not finite.
pub fn clearance_m(outline: &Outline, outer_centre_distance_m: f64, rotation_rad: f64, count: usize) -> f64 {
    clearances_m(outline, count)(outer_centre_distance_m, rotation_rad)
}

/// [`clearance_m`] by distance OC_e, m, and rotation, rad: what depends on neither is computed once.
pub fn clearances_m(outline: &Outline, count: usize) -> impl Fn(f64, f64) -> f64 + use<> {
    let neighbours = Neighbours::new(outline, count);
    move |oc_e, rotation| neighbours.as_ref().map_or(f64::INFINITY, |n| n.clearance(oc_e, rotation))
}

/// Least pitch from 0 to `even_rad`, rad, at which neighbours turned alike do not overlap; `even_rad` itself where they do at that. As
/// in [`clearance_m`] else. Convex sprags that overlap at one pitch overlap at every smaller one, so bisection finds it.
pub fn least_pitch_rad(outline: &Outline, outer_centre_distance_m: f64, even_rad: f64) -> f64 {
    let clear = |pitch: f64| Neighbours::apart(outline, pitch).clearance(outer_centre_distance_m, 0.0) > 0.0;
    let (mut touches, mut clears) = (0.0, even_rad);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (touches + clears);
        if clear(middle) { clears = middle } else { touches = middle }
    }
    clears
}

/// Halvings of a pitch: to 1e-12 of it.
const HALVINGS: usize = 40;

/// Smallest rotation Omega from 0 to `max_rotation_rad`, rad, at which neighbouring sprags touch, from its
/// free side; 0 where they overlap from the start, none where they stay apart.
///
/// The clearance changes with the rotation no faster than twice the outline's largest distance from C_e, nor
/// faster than the chord between the sprags; steps of clearance over rate therefore pass no touch by, save
/// one less than 1e-8 m deep. The touch is then bisected to rounding.
pub fn touch_rotation_rad(
    outline: &Outline,
    outer_centre_distance_m: f64,
    count: usize,
    max_rotation_rad: f64,
) -> Option<f64> {
    let neighbours = Neighbours::new(outline, count)?;
    let clearance = |rotation: f64| neighbours.clearance(outer_centre_distance_m, rotation);
    let radius = neighbours.features.iter().map(|f| f.centre.norm() + f.radius).fold(0.0, f64::max);
    let rate = neighbours.chord(outer_centre_distance_m).abs().min(2.0 * radius);
    let end = max_rotation_rad.min(TAU); // the outline repeats; also NaN: a whole turn
    let mut free = 0.0;
    let mut room = clearance(free);
    if room <= 0.0 {
        return Some(free);
    }
    while free < end {
        let mut touching = (free + (room + PASSED_OVER_M) / rate).min(end);
        room = clearance(touching);
        if room > 0.0 {
            free = touching;
            continue;
        }
        loop {
            let middle = 0.5 * (free + touching);
            if !(free < middle && middle < touching) {
                return Some(free);
            }
            if clearance(middle) > 0.0 { free = middle } else { touching = middle }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::profile::Segment;
    use crate::profile::properties::{Random, random_outline, table_1};

    fn disc(centre: [f64; 2], radius_m: f64) -> Outline {
        Outline::planted(vec![Segment::Arc {
            centre_m: centre.into(),
            radius_m,
            from_azimuth_rad: 0.4,
            sweep_rad: -TAU,
        }])
    }

    fn slab(a: f64, b: f64) -> Outline {
        let corners = [[-a, -b], [a, -b], [a, b], [-a, b]];
        let side = |i: usize| Segment::Line { from_m: corners[i].into(), to_m: corners[(i + 1) % 4].into() };
        Outline::planted((0..4).map(side).collect())
    }

    #[test]
    fn two_discs_are_a_chord_less_two_radii_apart() {
        for count in [2, 3, 12, 40] {
            for rotation in [0.0, 0.3, -1.1, 3.0] {
                // Centred on C_e: the rotation does not matter. 40 of them overlap.
                let chord = 2.0 * 14.76e-3 * (PI / count as f64).sin();
                let got = clearance_m(&disc([0.0, 0.0], 2.5e-3), 14.76e-3, rotation, count);
                assert!((got - (chord - 5e-3)).abs() < 1e-16, "{count} {rotation} {got}");
                // Off centre: the disc's own centre goes round O at the distance |OC_e + R c|.
                let c = Vector2::new(0.6e-3, -0.4e-3);
                let round = (Vector2::new(0.0, 14.76e-3) + turned(c, rotation)).norm();
                let got = clearance_m(&disc([c.x, c.y], 2.5e-3), 14.76e-3, rotation, count);
                let want = 2.0 * round * (PI / count as f64).sin() - 5e-3;
                assert!((got - want).abs() < 1e-16, "{count} {rotation} {got} {want}");
            }
        }
    }

    #[test]
    fn two_upright_slabs_are_closest_at_their_feet() {
        // Mirror images in the ray at half the pitch: twice the distance of the corner (a, OC_e - b) from it.
        // Where the feet overlap, the shortest way out is along either face's normal, half the pitch off.
        let (a, b, oc_e) = (2.5e-3, 4.0e-3, 15.0e-3);
        for count in [8, 12, 14, 15, 16] {
            let (sin, cos) = (PI / count as f64).sin_cos();
            let apart = 2.0 * ((oc_e - b) * sin - a * cos);
            assert_eq!(apart < 0.0, count > 14, "{count} must be a planted overlap or gap");
            let want = if apart < 0.0 { apart * cos } else { apart };
            let got = clearance_m(&slab(a, b), oc_e, 0.0, count);
            assert!((got - want).abs() < 1e-16, "{count} {got} {want}");
        }
    }

    #[test]
    fn turned_slabs_touch_where_a_corner_meets_the_face() {
        // In the body frame the neighbour's nearest corner is s_x - a cos p - b sin p from the middle plane.
        let (a, b, oc_e, count) = (2.5e-3, 4.0e-3, 15.0e-3, 12);
        let p = TAU / count as f64;
        let chord = 2.0 * oc_e * (p / 2.0).sin();
        let want = p / 2.0 + ((a + a * p.cos() + b * p.sin()) / chord).acos();
        let corner_y = chord * (want - p / 2.0).sin() + a * p.sin() - b * p.cos();
        assert!(corner_y.abs() < b, "the planted corner must meet the face itself");
        let got = touch_rotation_rad(&slab(a, b), oc_e, count, 1.0);
        println!("touch {got:?} wanted {want}");
        assert!((got.unwrap() - want).abs() < 1e-14);
        assert_eq!(touch_rotation_rad(&slab(a, b), oc_e, count, want - 1e-9), None);
        assert_eq!(touch_rotation_rad(&slab(a, b), oc_e, 16, 1.0), Some(0.0));
    }

    #[test]
    fn a_shallow_touch_is_found() {
        // A disc off C_e by d dips to 2 (OC_e - d) sin(p/2) - 2r at half a turn: here 0.1 um deep.
        let (oc_e, d, count) = (15.0e-3, 0.5e-3, 12);
        let sin = (PI / count as f64).sin();
        let radius = (oc_e - d) * sin + 0.5e-7;
        let round = radius / sin;
        let want = ((round * round - oc_e * oc_e - d * d) / (2.0 * oc_e * d)).acos();
        let got = touch_rotation_rad(&disc([0.0, d], radius), oc_e, count, TAU).unwrap();
        // The root is nearly double: rounding of the clearance, some 1e-18 m, over a slope of 5e-6 m/rad.
        assert!((got - want).abs() < 1e-11, "{got} {want}");
        assert_eq!(touch_rotation_rad(&disc([0.0, d], radius - 1e-7), oc_e, count, TAU), None);
    }

    #[test]
    fn no_neighbour_and_no_number_have_answers() {
        let body = slab(1e-3, 2e-3);
        assert_eq!(clearance_m(&body, 0.015, 0.0, 1), f64::INFINITY);
        assert_eq!(touch_rotation_rad(&body, 0.015, 1, 1.0), None);
        for (oc_e, rotation) in [(f64::NAN, 0.0), (0.015, f64::NAN), (0.015, f64::INFINITY), (0.0, 0.0)] {
            assert!(clearance_m(&body, oc_e, rotation, 12) < 0.0);
        }
        assert_eq!(touch_rotation_rad(&body, 0.015, 12, f64::NAN), touch_rotation_rad(&body, 0.015, 12, TAU));
        assert_eq!(touch_rotation_rad(&body, 0.015, 12, -1.0), None);
    }

    /// Smallest distance between the sampled outline and the sampled neighbour, corner to edge both ways.
    fn sampled(outline: &Outline, oc_e: f64, rotation: f64, count: usize, tolerance: f64) -> f64 {
        let placed = |share: f64| -> Vec<Vector2<f64>> {
            let pitch = share * TAU / count as f64;
            let place = |p: [f64; 2]| turned(turned(p.into(), rotation) + Vector2::new(0.0, oc_e), pitch);
            outline.polyline(tolerance).into_iter().map(place).collect()
        };
        let (one, two) = (placed(0.0), placed(1.0));
        let mut least = f64::INFINITY;
        for (points, edges) in [(&one, &two), (&two, &one)] {
            for p in points {
                for (i, from) in edges.iter().enumerate() {
                    let way = edges[(i + 1) % edges.len()] - from;
                    let part = ((p - from).dot(&way) / way.norm_squared()).clamp(0.0, 1.0);
                    least = least.min((p - from - part * way).norm());
                }
            }
        }
        least
    }

    #[test]
    fn agrees_with_sampled_outlines_of_random_sprags() {
        let mut random = Random(7);
        let (mut tried, mut worst) = (0, 0.0_f64);
        for _ in 0..300 {
            let Some((profile, outline)) = random_outline(&mut random) else { continue };
            let oc_e = profile.outer_centre_distance_m;
            let (count, rotation) = (random.between(3.0, 16.0) as usize, random.between(-0.5, 1.5));
            let exact = clearance_m(&outline, oc_e, rotation, count);
            if exact > 0.0 {
                let tolerance = 2e-7;
                let error = sampled(&outline, oc_e, rotation, count, tolerance) - exact;
                // Chords lie inside: the sampled pair is farther apart, by two sagittas at most.
                assert!(error > -1e-15 && error < 2.0 * tolerance, "{tried}: {error}");
                worst = worst.max(error);
                tried += 1;
            }
        }
        println!("largest of {tried} differences {worst:e} m");
        assert!(tried > 60, "only {tried} pairs stood apart");
    }

    #[test]
    fn clearance_is_continuous_through_contact_and_overlap() {
        let outline =
            Outline::new(&table_1(&[(4.02e-3, 0.06), (4.08e-3, 0.12), (4.15e-3, 0.45)]), 2.525e-3, 2.525e-3)
                .unwrap();
        for count in [12, 16, 18, 24, 60] {
            let step = 1e-3;
            let rate = 2.0 * 4.68e-3;
            let mut before = clearance_m(&outline, 14.76e-3, -0.5, count);
            for i in 1..2500 {
                let now = clearance_m(&outline, 14.76e-3, -0.5 + f64::from(i) * step, count);
                assert!((now - before).abs() <= rate * step * 1.001, "{count} {i}: {before} {now}");
                before = now;
            }
        }
    }

    #[test]
    fn the_first_touch_is_not_passed_over() {
        let outline = Outline::new(&table_1(&[(4.02e-3, 0.45)]), 2.525e-3, 2.525e-3).unwrap();
        for count in 12..=18 {
            let touch = touch_rotation_rad(&outline, 14.76e-3, count, 3.0);
            println!(
                "{count}: clearance {:.4} mm, touch {touch:?}",
                1e3 * clearance_m(&outline, 14.76e-3, 0.0, count)
            );
            let until = touch.unwrap_or(3.0);
            for i in 0..1000 {
                let rotation = until * f64::from(i) / 1000.0;
                assert!(touch == Some(0.0) || clearance_m(&outline, 14.76e-3, rotation, count) > 0.0);
            }
            if let Some(touch) = touch.filter(|&t| t > 0.0) {
                assert!(clearance_m(&outline, 14.76e-3, touch, count).abs() < 1e-16);
            }
        }
    }
}
