//! The geometry as numbers: every arc and flank, and points on them.

use super::part::{angles_rad, surface_names};
use super::{DrawnClutch, Part};
use crate::profile::Segment;
use nalgebra::Vector2;
use std::f64::consts::TAU;

/// One arc or flank.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceRow {
    /// Which body: `sprag`, `sprag 3`, `inner race`, `outer race`.
    pub body: String,
    /// Which surface of it: `inner arc 1`, `outer arc`, `front flank`, `bore`, `track`, `outside`.
    pub surface: String,
    /// Centre and radius, m; nothing for a flank.
    pub circle_m: Option<([f64; 2], f64)>,
    /// Angles of first and last point about the centre, rad, from +x counterclockwise; nothing for a flank, and of an arc
    /// that no flank bounds.
    pub angles_rad: Option<[f64; 2]>,
    /// First and last point, m; nothing where no flank bounds the arc.
    pub ends_m: Option<[[f64; 2]; 2]>,
}

/// A point on a surface, m.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfacePoint {
    /// As [`SurfaceRow::body`].
    pub body: String,
    /// As [`SurfaceRow::surface`].
    pub surface: String,
    /// Where, m.
    pub at_m: [f64; 2],
}

/// Every surface of a part with its segment; of a sprag without flanks the arcs as far as they work.
fn surfaces(part: Part, subject: &DrawnClutch) -> Vec<(String, String, Segment)> {
    let mut all = Vec::new();
    let ring = |body: &str, surface: &str, radius_m: f64| {
        let whole = Segment::Arc {
            centre_m: Vector2::zeros(),
            radius_m,
            from_azimuth_rad: TAU / 4.0,
            sweep_rad: -TAU,
        };
        (body.to_owned(), surface.to_owned(), whole)
    };
    if matches!(part, Part::Inner | Part::Clutch) {
        let (bore, track) = subject.inner_radii_m();
        all.extend(bore.map(|r| ring("inner race", "bore", r)));
        all.push(ring("inner race", "track", track));
    }
    if matches!(part, Part::Outer | Part::Clutch) {
        let (track, outside) = subject.outer_radii_m();
        all.extend([ring("outer race", "track", track), ring("outer race", "outside", outside)]);
    }
    let names = subject.outline.map(surface_names).unwrap_or_default();
    let named = |body: String, segments: Vec<Segment>| {
        segments.into_iter().zip(names.clone()).map(move |(segment, name)| (body.clone(), name, segment))
    };
    match part {
        Part::Sprag => all.extend(named("sprag".to_owned(), subject.sprag().to_vec())),
        Part::Clutch => {
            for (i, azimuth) in subject.azimuths_rad().into_iter().enumerate() {
                all.extend(named(format!("sprag {}", i + 1), subject.sprag_at(azimuth)));
            }
        }
        Part::Inner | Part::Outer => {}
    }
    all
}

/// Every arc and flank of a part. A sprag without flanks has its working arcs, and an outer arc without ends.
pub fn arcs(part: Part, subject: &DrawnClutch) -> Vec<SurfaceRow> {
    if part == Part::Sprag && subject.outline.is_none() {
        return open_arcs(subject);
    }
    surfaces(part, subject).into_iter().map(|(body, surface, segment)| row(body, surface, &segment)).collect()
}

fn row(body: String, surface: String, segment: &Segment) -> SurfaceRow {
    let point = |v: Vector2<f64>| [v.x, v.y];
    let ends_m = Some([point(segment.start_m()), point(segment.end_m())]);
    match *segment {
        Segment::Line { .. } => SurfaceRow { body, surface, circle_m: None, angles_rad: None, ends_m },
        Segment::Arc { centre_m, radius_m, from_azimuth_rad, sweep_rad } => {
            let (from, turn) = angles_rad(from_azimuth_rad, sweep_rad);
            let circle_m = Some((point(centre_m), radius_m));
            SurfaceRow { body, surface, circle_m, angles_rad: Some([from, from + turn]), ends_m }
        }
    }
}

fn open_arcs(subject: &DrawnClutch) -> Vec<SurfaceRow> {
    let profile = subject.profile;
    let inner = profile.arcs.iter().enumerate().map(|(k, arc)| {
        let segment = Segment::Arc {
            centre_m: arc.centre_m,
            radius_m: arc.radius_m,
            from_azimuth_rad: profile.beta0_rad + TAU / 2.0 - arc.from_rad,
            sweep_rad: arc.from_rad - arc.until_rad,
        };
        row("sprag".to_owned(), format!("inner arc {}", k + 1), &segment)
    });
    let outer = SurfaceRow {
        body: "sprag".to_owned(),
        surface: "outer arc".to_owned(),
        circle_m: Some(([0.0; 2], profile.outer_radius_m)),
        angles_rad: None,
        ends_m: None,
    };
    inner.chain([outer]).collect()
}

/// Points on every surface of a part, counterclockwise; no chord between two of one body is farther from its arc than
/// `deviation_m`, m. The first point of a closed body is not repeated.
pub fn points(part: Part, subject: &DrawnClutch, deviation_m: f64) -> Vec<SurfacePoint> {
    let mut all = Vec::new();
    for (body, surface, segment) in surfaces(part, subject) {
        let of = |at_m| SurfacePoint { body: body.clone(), surface: surface.clone(), at_m };
        all.extend(segment.points_m(deviation_m).into_iter().map(of));
    }
    all
}
