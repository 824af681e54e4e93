//! Structured hexahedra: two ring sectors and the sprag between them. Lengths in mm, as the deck has them.
//!
//! # Conventions
//! x towards positive azimuth, y radially outward at B, z along the axis from the middle of the length. The
//! azimuth is measured from +y towards +x, so a point at radius rho is (rho sin, rho cos).

use super::spacing::{depths, growing, positions, steps_to_cover};
use crate::profile::Segment;

/// Growth of the spacing from one row to the next, away from the contacts; a choice.
const GROWTH: f64 = 1.3;

/// One block of hexahedra, `i` along the surface towards +x, `j` outward, `k` along the axis.
#[derive(Debug, Clone)]
pub(super) struct Block {
    /// Nodes along i and j.
    pub size: (usize, usize),
    /// Section, point (i, j) at i + size.0 j.
    pub points: Vec<[f64; 2]>,
    /// Axial positions.
    pub zs: Vec<f64>,
    /// Number of the first node.
    pub first_node: usize,
    /// Number of the first element.
    pub first_element: usize,
    /// Columns of elements of the fine stretch on the loaded surface: first, one past the last.
    pub fine: (usize, usize),
}

impl Block {
    /// Node number.
    pub fn node(&self, i: usize, j: usize, k: usize) -> usize {
        self.first_node + i + self.size.0 * (j + self.size.1 * k)
    }

    /// Element number.
    pub fn element(&self, i: usize, j: usize, k: usize) -> usize {
        self.first_element + i + (self.size.0 - 1) * (j + (self.size.1 - 1) * k)
    }

    /// Section point.
    pub fn point(&self, i: usize, j: usize) -> [f64; 2] {
        self.points[i + self.size.0 * j]
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.points.len() * self.zs.len()
    }

    /// Number of elements.
    pub fn elements(&self) -> usize {
        (self.size.0 - 1) * (self.size.1 - 1) * (self.zs.len() - 1)
    }

    /// The eight nodes of an element in CalculiX's order.
    pub fn corners(&self, i: usize, j: usize, k: usize) -> [usize; 8] {
        let n = |di, dj, dk| self.node(i + di, j + dj, k + dk);
        [n(0, 0, 0), n(1, 0, 0), n(1, 1, 0), n(0, 1, 0), n(0, 0, 1), n(1, 0, 1), n(1, 1, 1), n(0, 1, 1)]
    }

    /// Smallest of the corner products (twice an area, mm^2) of the section; negative where it is folded.
    pub fn least_corner_mm2(&self) -> f64 {
        let mut least = f64::INFINITY;
        for j in 0..self.size.1 - 1 {
            for i in 0..self.size.0 - 1 {
                let c =
                    [self.point(i, j), self.point(i + 1, j), self.point(i + 1, j + 1), self.point(i, j + 1)];
                for a in 0..4 {
                    let (p, q, r) = (c[(a + 3) % 4], c[a], c[(a + 1) % 4]);
                    let cross = (r[0] - q[0]) * (p[1] - q[1]) - (r[1] - q[1]) * (p[0] - q[0]);
                    least = least.min(cross);
                }
            }
        }
        least
    }
}

/// How fine and where.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grid {
    /// Spacing at the contacts.
    pub step: f64,
    /// Way that the contacts travel.
    pub travel: f64,
    /// Fine stretch beyond either end of that way, two fifths of it the depth of even rows.
    pub margin: f64,
    /// Number of fine columns.
    pub fine_count: usize,
    /// Offsets between which the inner and the outer surface have room for fine columns.
    room: [(f64, f64); 2],
}

/// Columns left between the fine stretch and a flank or a cut face.
const SPARE: f64 = 1.5;

impl Grid {
    /// `room`: offsets from the first contact to the flanks or the cut faces of the sector, whichever are nearer, on the
    /// inner and on the outer surface.
    pub fn new(step: f64, travel: f64, margin: f64, room: [(f64, f64); 2]) -> Self {
        let fine_count = ((travel + 2.0 * margin) / step).ceil() as usize;
        let step = (travel + 2.0 * margin) / fine_count as f64;
        let room = room.map(|(rear, front)| (rear + SPARE * step, front - SPARE * step));
        Self { step, travel, margin, fine_count, room }
    }

    /// Spacing of the fine columns of a surface, less than `step` where its stretch is cut short.
    pub fn step_on(&self, inner: bool) -> f64 {
        let (low, high) = self.fine(inner);
        (high - low) / self.fine_count as f64
    }

    /// Rows of even height below a surface.
    pub fn even_rows(&self) -> usize {
        (0.4 * self.margin / self.step).ceil() as usize
    }

    /// Fine stretch along a surface, cut short where there is no room: the inner contact travels towards +x, the outer
    /// towards -x.
    pub fn fine(&self, inner: bool) -> (f64, f64) {
        let ((low, high), (rear, front)) = if inner {
            ((-self.margin, self.travel + self.margin), self.room[0])
        } else {
            ((-self.travel - self.margin, self.margin), self.room[1])
        };
        (low.max(rear), high.min(front))
    }
}

/// Radius on which the nodes lie so that the chords between them follow the arc in the mean: a chord lies
/// h^2/(12 r) inside its arc on average.
pub(super) fn chord_radius(radius: f64, step: f64) -> f64 {
    radius + step * step / (12.0 * radius)
}

/// A ring sector about the azimuth `middle` with the contact there.
pub(super) struct Sector {
    pub middle: f64,
    pub half_angle: f64,
    /// Radius of the loaded surface.
    pub track: f64,
    /// Radius of the other surface.
    pub far: f64,
}

impl Sector {
    /// Row 0 is the smaller radius.
    pub fn block(&self, grid: &Grid, zs: Vec<f64>) -> Block {
        let inner = self.far < self.track;
        let half = self.half_angle * self.track;
        let fine = grid.fine(inner);
        let (before, after) = (
            steps_to_cover(fine.0 + half, grid.step, GROWTH),
            steps_to_cover(half - fine.1, grid.step, GROWTH),
        );
        let along = positions(-half, fine, half, grid.fine_count, before, after);
        let track = chord_radius(self.track, grid.step_on(inner));
        let sign = if inner { -1.0 } else { 1.0 };
        let mut radii: Vec<f64> = depths((self.far - self.track).abs(), grid.step, grid.even_rows(), GROWTH)
            .into_iter()
            .map(|d| track + sign * d)
            .collect();
        if let Some(last) = radii.last_mut() {
            *last = self.far;
        }
        if inner {
            radii.reverse();
        }
        let azimuths: Vec<f64> = along.iter().map(|s| self.middle + s / self.track).collect();
        let points =
            radii.iter().flat_map(|r| azimuths.iter().map(move |a| [r * a.sin(), r * a.cos()])).collect();
        Block {
            size: (azimuths.len(), radii.len()),
            points,
            zs,
            first_node: 1,
            first_element: 1,
            fine: (before, before + grid.fine_count),
        }
    }
}

/// Section of the sprag in strut coordinates (offset from the strut towards the front, height above A), mm.
pub(super) struct Section {
    /// Segments of the inner side, then the outer arc, with centre (offset, height) and radius.
    arcs: Vec<(f64, f64, f64, [f64; 2])>,
    outer: (f64, f64, f64),
    /// Offsets of rear and front flank where they meet the inner side, and the outer arc.
    flanks: [(f64, f64); 2],
}

impl Section {
    /// From the outline: `foot` (m) on the strut at A, `up` its unit vector.
    pub fn new(segments: &[Segment], foot: [f64; 2], up: [f64; 2]) -> Option<Self> {
        let local = |x: f64, y: f64| {
            let d = [1e3 * (x - foot[0]), 1e3 * (y - foot[1])];
            [d[0] * up[1] - d[1] * up[0], d[0] * up[0] + d[1] * up[1]]
        };
        let mut arcs = Vec::new();
        for segment in segments {
            let ends = [segment.start_m(), segment.end_m()].map(|p| local(p.x, p.y));
            match segment {
                Segment::Arc { centre_m, radius_m, .. } => {
                    let c = local(centre_m.x, centre_m.y);
                    arcs.push((c[0], c[1], 1e3 * radius_m, [ends[0][0], ends[1][0]]));
                }
                Segment::Line { .. } => {}
            }
        }
        // The outer arc runs from the front to the rear.
        let (x, y, r, [front, rear]) = arcs.pop()?;
        let low = (arcs.first()?.3[0], arcs.last()?.3[1]);
        Some(Self { arcs, outer: (x, y, r), flanks: [low, (rear, front)] })
    }

    /// Offsets of rear and front flank from the strut, at the inner side and at the outer arc.
    pub fn flanks_mm(&self) -> [(f64, f64); 2] {
        self.flanks
    }

    /// Height of the inner side at an offset; nodes lie outside the arc so that chords follow it.
    fn bottom(&self, offset: f64, step: f64) -> f64 {
        let within = |a: &&(f64, f64, f64, [f64; 2])| offset <= a.3[1];
        let Some(&(x, y, r, _)) = self.arcs.iter().find(within).or(self.arcs.last()) else { return 0.0 };
        y - (chord_radius(r, step).powi(2) - (offset - x).powi(2)).max(0.0).sqrt()
    }

    fn top(&self, offset: f64, step: f64) -> f64 {
        let (x, y, r) = self.outer;
        y + (chord_radius(r, step).powi(2) - (offset - x).powi(2)).max(0.0).sqrt()
    }

    /// Block in strut coordinates: columns run from the inner to the outer surface, finest along the line
    /// that both contacts travel.
    pub fn block(&self, grid: &Grid, zs: Vec<f64>) -> Block {
        let [low, high] = self.flanks;
        let beside = |side: fn((f64, f64), (f64, f64)) -> f64| {
            let reach = side(grid.fine(true), low).max(side(grid.fine(false), high));
            steps_to_cover(reach, grid.step, GROWTH)
        };
        let (before, after) =
            (beside(|fine, flanks| fine.0 - flanks.0), beside(|fine, flanks| flanks.1 - fine.1));
        let row = |inner, (rear, front): (f64, f64)| {
            positions(rear, grid.fine(inner), front, grid.fine_count, before, after)
        };
        let (low, high) = (row(true, low), row(false, high));
        let (below, above) = (grid.step_on(true), grid.step_on(false));
        let height = self.top(0.0, above) - self.bottom(0.0, below);
        let half = depths(0.5 * height, grid.step, grid.even_rows(), GROWTH);
        let mut parts: Vec<f64> = half.iter().map(|d| d / height).collect();
        parts.extend(half.iter().rev().skip(1).map(|d| 1.0 - d / height));
        let mut points = Vec::with_capacity(parts.len() * low.len());
        for part in &parts {
            for (a, b) in low.iter().zip(&high) {
                let (bottom, top) = (self.bottom(*a, below), self.top(*b, above));
                points.push([a + part * (b - a), bottom + part * (top - bottom)]);
            }
        }
        Block {
            size: (low.len(), parts.len()),
            points,
            zs,
            first_node: 1,
            first_element: 1,
            fine: (before, before + grid.fine_count),
        }
    }
}

/// Axial positions from the middle to `half`, `layers` of them, finest at the end; with `beyond` > 0 the
/// same row is continued past the end by as much.
pub(super) fn axial(half: f64, layers: usize, beyond: f64) -> Vec<f64> {
    // The last layer of n is a share 2^-(n-1) of about half the length: fine enough to see the end's relief.
    let first = if layers == 1 { half } else { half / (2.0_f64.powi(layers as i32) - 1.0) };
    let mut out = vec![0.0];
    let mut at = 0.0;
    for width in growing(half, first, layers).into_iter().rev() {
        at += width;
        out.push(at);
    }
    if beyond > 0.0 {
        for width in growing(beyond, first.min(beyond), layers) {
            at += width;
            out.push(at);
        }
    }
    out
}
