//! The fitted sides between races: which arc touches first, which way is engagement, where the flanks stand.

use super::fit::{Arcs, arcs};
use super::outline::{Sides, Straight};
use super::spiral::{FittedSpiral, Side, SpiralKind};
use super::{NoImport, Wanted};
use crate::profile::{Flanks, Outline, Profile};
use nalgebra::Vector2;
use std::f64::consts::{PI, TAU};

type Point = Vector2<f64>;

/// The end of the profile over what the flanks leave of it: the contact has a width.
pub(super) const SHARE: f64 = 0.98;
/// One side is fitted so much better by one circle than the other that it must be the outer arc.
const BETTER: f64 = 1.5;

/// A sprag in the terms of this tool.
#[derive(Debug, Clone, PartialEq)]
pub struct FittedSprag {
    /// r_e, m.
    pub outer_radius_m: f64,
    /// e_1, m.
    pub centre_distance_m: f64,
    /// (radius m, turn at which it ends rad) of the inner arcs in order of engagement.
    pub inner_arcs: Vec<(f64, f64)>,
    /// Flanks.
    pub flanks: Flanks,
    /// The fit of the inner side, arcs that lie behind first contact included.
    pub inner: Arcs,
    /// The fit of the outer side.
    pub outer: Arcs,
    /// Inner arcs that lie behind first contact, and are left out.
    pub behind: usize,
    /// Whether the drawing had to be turned over: it shows a clutch that locks the other way.
    pub mirrored: bool,
    /// Spirals through the inner side from first contact on, of constant strut angle and logarithmic, where it has such a beginning.
    pub spirals: Vec<FittedSpiral>,
}

/// Circles and lines of the sprag, drawn or mirrored; inner arcs counterclockwise, that is from rear to front.
pub(super) struct Body {
    pub(super) outer: (Point, f64),
    pub(super) inner: Vec<(Point, f64)>,
    /// Angles at which inner arcs begin and end, one more than arcs, rising.
    pub(super) angles: Vec<f64>,
    /// Rear and front flank.
    flanks: [Straight; 2],
}

pub(super) fn place(sides: &Sides, wanted: &Wanted) -> Result<FittedSprag, NoImport> {
    const ROUND: &str = "draw or measure two curved sides that bulge outwards";
    let single = |i: usize| {
        arcs(&sides.curved[i].points, Some(1), None)
            .ok_or_else(|| NoImport::new(None, "a curved side that is straight", ROUND))
    };
    let singles = [single(0)?, single(1)?];
    let (a, b) = (&singles[0], &singles[1]);
    let rms = [a.rms_m.max(1e-9), b.rms_m.max(1e-9)];
    let first_is_outer = if rms[0] > BETTER * rms[1] {
        false
    } else if rms[1] > BETTER * rms[0] {
        true
    } else {
        a.arcs[0].radius_m > b.arcs[0].radius_m
    };
    let outer_at = usize::from(first_is_outer == wanted.swap);
    let inner_at = 1 - outer_at;
    let outer = singles[outer_at].clone();
    let inner = arcs(&sides.curved[inner_at].points, wanted.arcs, wanted.deviation_m)
        .ok_or_else(|| NoImport::new(None, "an inner side that is straight", ROUND))?;

    let angle = |p: Point, c: Point| (p.y - c.y).atan2(p.x - c.x);
    let ends = sides.curved[inner_at].ends;
    let from = angle(ends[0], inner.arcs[0].centre_m);
    let last = inner.arcs[inner.arcs.len() - 1];
    let rising = |v: f64| from + (v - from).rem_euclid(TAU);
    let mut angles = vec![from];
    angles.extend(inner.junctions_rad.iter().map(|j| rising(*j)));
    angles.push(rising(angle(ends[1], last.centre_m)));
    // Counterclockwise: the flank behind the inner side is the front one, that before it the rear one.
    let (front, rear) = (sides.flanks[inner_at], sides.flanks[1 - inner_at]);
    let body = Body {
        outer: (outer.arcs[0].centre_m, outer.arcs[0].radius_m),
        inner: inner.arcs.iter().map(|a| (a.centre_m, a.radius_m)).collect(),
        angles,
        flanks: [rear, front],
    };
    let mut found = None;
    for (mirrored, body) in [(false, body.mirrored(false)), (true, body.mirrored(true))] {
        if let Some((k, axis, contact)) = body.first_contact(wanted.tracks_m) {
            let left = body.angles[body.inner.len()] - contact;
            if found.as_ref().is_none_or(|(_, _, _, _, _, other)| left > *other) {
                found = Some((mirrored, body, k, axis, contact, left));
            }
        }
    }
    let Some((mirrored, body, k, axis, contact, _)) = found else {
        return Err(body.does_not_span(wanted.tracks_m));
    };
    let (c_e, r_e) = body.outer;
    let (c_k, r_k) = body.inner[k];
    let e_1 = (c_k - c_e).norm();
    let a = c_k + r_k * Point::new(contact.cos(), contact.sin());
    let b = c_e + r_e * (c_e - axis).normalize();
    let flanks = body.flanks_from(a, b);
    let n = body.inner.len();
    let until = |end: f64| -> Vec<(f64, f64)> {
        (k..n)
            .map(|j| (body.inner[j].1, if j + 1 == n { end } else { body.angles[j + 1] - contact }))
            .collect()
    };
    let closes = |end: f64| {
        let [inner_m, outer_m] = wanted.tracks_m;
        Profile::new(r_e, e_1, &until(end), inner_m, outer_m)
            .ok()
            .is_some_and(|p| Outline::closed(&p, &flanks).is_ok())
    };
    let begin = if k + 1 == n { 0.0 } else { body.angles[n - 1] - contact };
    let (mut low, mut high) = (begin, body.angles[n] - contact);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if closes(middle) { low = middle } else { high = middle }
    }
    let end = begin + SHARE * (low - begin);
    if !closes(end) || end <= begin {
        return Err(NoImport::new(
            None,
            format!(
                "a sprag that touches both races next to a flank: first contact lies {:.1} deg before the end of its inner side",
                (body.angles[n] - contact).to_degrees()
            ),
            "check the radii of the races (`tracks_m`), or take the other side for the outer arc \
             (`swap`)",
        ));
    }
    let side = Side::new(&body, &sides.curved[inner_at], mirrored, contact, wanted.tracks_m);
    let spirals = [SpiralKind::ConstantStrutAngle, SpiralKind::Logarithmic].map(|kind| side.spiral(kind));
    Ok(FittedSprag {
        outer_radius_m: r_e,
        centre_distance_m: e_1,
        inner_arcs: until(end),
        flanks,
        inner,
        outer,
        behind: k,
        mirrored,
        spirals: spirals.into_iter().flatten().collect(),
    })
}

impl Body {
    /// A copy, turned over about the y axis if asked.
    fn mirrored(&self, over: bool) -> Self {
        let point = |p: Point| if over { Point::new(-p.x, p.y) } else { p };
        let circle = |c: &(Point, f64)| (point(c.0), c.1);
        let line = |s: &Straight| Straight { point: point(s.point), along: point(s.along) };
        let mut inner: Vec<(Point, f64)> = self.inner.iter().map(circle).collect();
        let mut angles = self.angles.clone();
        let mut flanks = [line(&self.flanks[0]), line(&self.flanks[1])];
        if over {
            inner.reverse();
            flanks.reverse();
            angles = angles.iter().rev().map(|a| PI - a).collect();
        }
        Self { outer: circle(&self.outer), inner, angles, flanks }
    }

    /// The arc that touches first, the axis of the races, the angle of the contact. C_k must lie ahead of C_e: clockwise.
    fn first_contact(&self, [inner_m, outer_m]: [f64; 2]) -> Option<(usize, Point, f64)> {
        let (c_e, r_e) = self.outer;
        let oc_e = outer_m - r_e;
        self.inner.iter().enumerate().find_map(|(k, &(c_k, r_k))| {
            let (e, oc_k) = ((c_k - c_e).norm(), inner_m + r_k);
            let along = (e * e + oc_e * oc_e - oc_k * oc_k) / (2.0 * e);
            let across = (oc_e * oc_e - along * along).sqrt();
            let unit = (c_k - c_e) / e;
            [1.0, -1.0].into_iter().find_map(|side| {
                let axis = c_e + along * unit + side * across * Point::new(-unit.y, unit.x);
                let way = axis - c_k;
                let from = self.angles[0];
                let contact = from + (way.y.atan2(way.x) - from).rem_euclid(TAU);
                let on = contact >= self.angles[k] && contact < self.angles[k + 1];
                let ahead = (c_e - axis).perp(&(c_k - axis)) < 0.0;
                (across.is_finite() && oc_e > 0.0 && on && ahead).then_some((k, axis, contact))
            })
        })
    }

    pub(super) fn flanks_from(&self, a: Point, b: Point) -> Flanks {
        let (middle, up) = (0.5 * (a + b), (b - a).normalize());
        let front = Point::new(up.y, -up.x);
        let one = |flank: &Straight, sign: f64| {
            let along = if flank.along.dot(&up) < 0.0 { -flank.along } else { flank.along };
            let to = flank.point - middle;
            let crossing = to - along * (to.dot(&up) / along.dot(&up));
            (sign * crossing.dot(&front), (sign * along.dot(&front)).atan2(along.dot(&up)))
        };
        let (rear_m, rear_tilt_rad) = one(&self.flanks[0], -1.0);
        let (front_m, front_tilt_rad) = one(&self.flanks[1], 1.0);
        Flanks { rear_m, front_m, rear_tilt_rad, front_tilt_rad }
    }

    fn does_not_span(&self, [inner_m, outer_m]: [f64; 2]) -> NoImport {
        let (c_e, r_e) = self.outer;
        let reach = |sign: f64| self.inner.iter().map(move |(c, r)| r_e + r + sign * (c - c_e).norm());
        let (least, most) = (reach(-1.0).fold(f64::INFINITY, f64::min), reach(1.0).fold(0.0, f64::max));
        let gap_m = outer_m - inner_m;
        let in_unit = |unit: f64| {
            (least * unit..=most * unit).contains(&gap_m) || (0.9..1.1).contains(&(gap_m / (most * unit)))
        };
        let help = if in_unit(25.4) {
            "it fits as a drawing in inches: `unit` inch"
        } else if in_unit(1.0 / 25.4) {
            "it fits as a drawing in millimetres that says inches: `unit` mm"
        } else {
            "give the radii of its races: `tracks_m`; or take the other side for the outer \
             arc (`swap`)"
        };
        NoImport::new(
            None,
            format!(
                "a sprag that is {:.4} to {:.4} mm high over its arcs, and a race gap of {:.4} mm ({:.4} to {:.4} mm radius): \
                 nowhere on its inner side does it touch both races",
                1e3 * least,
                1e3 * most,
                1e3 * gap_m,
                1e3 * inner_m,
                1e3 * outer_m
            ),
            help,
        )
    }
}
