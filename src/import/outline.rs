//! The four sides of an outline: cut at its corners, told apart by how straight they are.

use super::{Drawn, NoImport};
use nalgebra::Vector2;
use std::f64::consts::TAU;

type Point = Vector2<f64>;

/// Rays from the middle on which the outline is averaged; noise of single points goes.
const RAYS: usize = 720;
/// Rays on either side over which a corner is felt.
const REACH: usize = 12;
/// Turn over that reach from which it is a corner, rad: an arc turns by half as much.
const CORNER_RAD: f64 = 0.32;
/// What a gentle corner turns more than the arc on its one side, rad; its other side is a flank, which turns by less than that.
const GENTLE_RAD: f64 = 0.05;
/// Rays left out beside a corner: edges are rounded.
const BESIDE: usize = 4;
/// Two arcs that miss a common tangent by more than this are refused, rad.
const KINK_RAD: f64 = 0.01;
/// Longest step between points that is filled up, over the size of the outline.
const FILL: f64 = 0.0008;

/// A curved side: its points counterclockwise, m.
pub(super) struct Curved {
    pub points: Vec<Point>,
    /// The corners at its ends.
    pub ends: [Point; 2],
}

/// A flank: a point on it and its direction, counterclockwise.
#[derive(Clone, Copy)]
pub(super) struct Straight {
    pub point: Point,
    pub along: Point,
}

/// Sides in counterclockwise order: curved, flank, curved, flank.
pub(super) struct Sides {
    pub curved: [Curved; 2],
    pub flanks: [Straight; 2],
}

pub(super) fn sides(drawn: &Drawn) -> Result<Sides, NoImport> {
    let filled = filled(&drawn.points_m);
    let (low, high) = filled.iter().fold((filled[0], filled[0]), |(l, h), p| (l.inf(p), h.sup(p)));
    let middle = 0.5 * (low + high);
    let angle = |p: &Point| (p.y - middle.y).atan2(p.x - middle.x).rem_euclid(TAU);
    let ray = |p: &Point| ((angle(p) / TAU * RAYS as f64) as usize).min(RAYS - 1);
    let mut sums = vec![(Point::zeros(), 0.0); RAYS];
    for p in &filled {
        let sum = &mut sums[ray(p)];
        *sum = (sum.0 + p, sum.1 + 1.0);
    }
    if let Some(empty) = sums.iter().position(|s| s.1 == 0.0) {
        return Err(NoImport::new(
            None,
            format!(
                "no outline in the direction of {:.0} deg from its middle",
                empty as f64 * 360.0 / RAYS as f64
            ),
            "give the points in order round one closed outline",
        ));
    }
    let mean: Vec<Point> = sums.iter().map(|s| s.0 / s.1).collect();
    let corners = corners(&mean);
    let [a, b, c, d] = corners[..] else {
        return Err(NoImport::new(
            None,
            format!("an outline with {} corners", corners.len()),
            "a sprag has four: two curved sides and two straight flanks between them; leave chamfers and grooves out",
        ));
    };
    let cuts = [(a, b), (b, c), (c, d), (d, a)];
    let rays = |(from, to): (usize, usize)| -> Vec<usize> {
        let count = (to + RAYS - from) % RAYS;
        (BESIDE..count.saturating_sub(BESIDE)).map(|i| (from + i) % RAYS).collect()
    };
    let stretches: Vec<Vec<usize>> = cuts.iter().map(|cut| rays(*cut)).collect();
    if let Some(short) = stretches.iter().position(|s| s.len() < 2 * BESIDE) {
        return Err(NoImport::new(
            None,
            format!("a side (number {} of four) that is too short to be told from its corners", short + 1),
            "draw a sprag whose four sides can be seen; leave chamfers out",
        ));
    }
    let line = |stretch: &[usize]| straight(&stretch.iter().map(|i| mean[*i]).collect::<Vec<_>>());
    let lines: Vec<(Straight, f64)> = stretches.iter().map(|s| line(s)).collect();
    let even = lines[0].1 + lines[2].1 < lines[1].1 + lines[3].1;
    let (first, flanks) = if even { (1, [2, 0]) } else { (0, [1, 3]) };
    let curved = [first, first + 2].map(|side| {
        let mut owner = vec![false; RAYS];
        stretches[side].iter().for_each(|i| owner[*i] = true);
        let start = stretches[side][0] as f64 * TAU / RAYS as f64;
        let mut points: Vec<Point> = drawn.points_m.iter().filter(|p| owner[ray(p)]).copied().collect();
        let order = |p: &Point| (angle(p) - start).rem_euclid(TAU);
        points.sort_by(|p, q| order(p).total_cmp(&order(q)));
        let (from, to) = cuts[side];
        Curved { points, ends: [mean[from], mean[to]] }
    });
    if let Some(few) = curved.iter().find(|c| c.points.len() < 10) {
        return Err(NoImport::new(
            None,
            format!("{} points on a curved side", few.points.len()),
            "measure or draw the working surfaces with at least 10 points each; some thousands for micrometres",
        ));
    }
    for (at, kink, line) in &drawn.kinks {
        let inside = curved.iter().any(|c| {
            let [from, to] = c.ends;
            (at - from).norm() > 0.05 * (to - from).norm() && (at - to).norm() > 0.05 * (to - from).norm()
        });
        let beside = |s: &Straight| s.along.perp(&(at - s.point)).abs() < 1e-5;
        if kink.abs() > KINK_RAD && inside && !flanks.iter().any(|f| beside(&lines[*f].0)) {
            return Err(NoImport::new(
                *line,
                format!(
                    "two arcs that meet at x = {:.4}, y = {:.4} mm with an angle of {:.2} deg between their tangents",
                    1e3 * at.x,
                    1e3 * at.y,
                    kink.to_degrees().abs()
                ),
                "make them tangent: a contact cannot roll over an edge",
            ));
        }
    }
    Ok(Sides { curved, flanks: flanks.map(|f| lines[f].0) })
}

/// The points with long steps filled up.
fn filled(points: &[Point]) -> Vec<Point> {
    let (low, high) = points.iter().fold((points[0], points[0]), |(l, h), p| (l.inf(p), h.sup(p)));
    let step = FILL * (high - low).norm();
    let mut out = Vec::with_capacity(2 * points.len());
    for (i, p) in points.iter().enumerate() {
        let q = points[(i + 1) % points.len()];
        let parts = ((q - p).norm() / step).ceil().max(1.0) as usize;
        out.extend((0..parts).map(|k| p + (q - p) * (k as f64 / parts as f64)));
    }
    out
}

/// Rays on which the outline turns sharply. Where these are fewer than four, the clearest gentle ones too: a flank may run nearly
/// tangent into an arc.
fn corners(mean: &[Point]) -> Vec<usize> {
    let at = |i: usize, by: isize| mean[(i as isize + by).rem_euclid(RAYS as isize) as usize];
    let reach = REACH as isize;
    let turns: Vec<f64> = (0..RAYS)
        .map(|i| {
            let (before, after) = (at(i, 0) - at(i, -reach), at(i, reach) - at(i, 0));
            before.perp(&after).atan2(before.dot(&after))
        })
        .collect();
    let turn = |i: usize, by: isize| turns[(i as isize + by).rem_euclid(RAYS as isize) as usize];
    let peaks = (0..RAYS).filter(|&i| (1..=reach).all(|k| turns[i] > turn(i, -k) && turns[i] >= turn(i, k)));
    let (mut corners, others): (Vec<usize>, Vec<usize>) = peaks.partition(|&i| turns[i] > CORNER_RAD);
    // Mean turn beside a corner, out of its reach.
    let beside = |i: usize, side: isize| {
        (reach + 1..=2 * reach).map(|k| turn(i, side * k)).sum::<f64>() / REACH as f64
    };
    let mut gentle: Vec<(f64, usize)> = others
        .into_iter()
        .filter_map(|i| {
            let (before, after) = (beside(i, -1), beside(i, 1));
            let more = turns[i] - before.max(after);
            (more > GENTLE_RAD && before.min(after).abs() < GENTLE_RAD).then_some((more, i))
        })
        .collect();
    gentle.sort_by(|a, b| b.0.total_cmp(&a.0));
    corners.extend(gentle.iter().map(|g| g.1).take(4_usize.saturating_sub(corners.len())));
    corners.sort_unstable();
    corners
}

/// Line of least squares through points in order, and the farthest of them over its length.
fn straight(points: &[Point]) -> (Straight, f64) {
    let point = points.iter().sum::<Point>() / points.len() as f64;
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for p in points {
        let d = p - point;
        (xx, xy, yy) = (xx + d.x * d.x, xy + d.x * d.y, yy + d.y * d.y);
    }
    let (s, c) = (0.5 * (2.0 * xy).atan2(xx - yy)).sin_cos();
    let way = points[points.len() - 1] - points[0];
    let along = Point::new(c, s);
    let along = if along.dot(&way) < 0.0 { -along } else { along };
    let off = points.iter().map(|p| along.perp(&(p - point)).abs()).fold(0.0, f64::max);
    (Straight { point, along }, off / way.norm())
}
