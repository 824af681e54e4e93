//! The spirals of least squares through the inner side: the curve that keeps the strut angle, and the logarithmic spiral.
//!
//! # What is fitted
//! The distance from the pole to the tangent whose normal points in the direction phi, with d the inset of [`Spiral`]:
//!
//!   p(phi) = P e^(k (phi - phi_0)) - d.
//!
//! The curve of constant strut angle has its pole in C_e and d = r_e R_i/R_e: P and k are sought. The logarithmic spiral has d = 0,
//! its pole is sought too. A point x off the pole lies r.n - p beside the curve where r.t = p', r = x - pole; at that foot
//! the slopes of the distance are those of p alone.

use super::outline::Curved;
use super::place::Body;
use crate::profile::{Flanks, Outline, Profile, Spiral, Support};
use nalgebra::{DMatrix, DVector, Vector2};
use std::f64::consts::PI;

type Point = Vector2<f64>;

/// Groups of points, in order, whose mean distance says how far the curve goes.
const GROUPS: usize = 10;
/// A group is on the curve where its mean is off by less than so many of its standard errors, or by [`FELT_M`].
const SIGMAS: f64 = 4.0;
/// What arcs that stand for a spiral leave, and more, m.
const FELT_M: f64 = 1e-9;
/// Ends that are tried, evenly from first contact to the end of the side.
const ENDS: usize = 40;
/// Points with which ends are tried; what is found is settled with all.
const TRIED_POINTS: usize = 2000;
/// Step of the parameters below which they are settled, m.
const SETTLED_M: f64 = 1e-12;
/// Fewest points of a fit.
const LEAST: usize = 20;
/// Steps of the search for the parameters, and for a foot, at most.
const STEPS: usize = 40;

/// Which spiral.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpiralKind {
    /// The curve that keeps the strut angle between these races.
    ConstantStrutAngle,
    /// A logarithmic spiral.
    Logarithmic,
}

impl SpiralKind {
    /// As `curve` of the file has it.
    pub fn name(self) -> &'static str {
        match self {
            Self::ConstantStrutAngle => "constant-strut-angle",
            Self::Logarithmic => "logarithmic",
        }
    }
}

/// A spiral through the inner side from first contact on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FittedSpiral {
    /// Which.
    pub kind: SpiralKind,
    /// Strut angle at first contact, rad.
    pub strut_rad: f64,
    /// Radius of curvature at first contact, m.
    pub start_radius_m: f64,
    /// Growth k of the radius per rad of turn.
    pub rise: f64,
    /// Turn up to which the points lie on it, less what the flanks leave, rad.
    pub until_rad: f64,
    /// Root of the mean square of the distances of these points, m.
    pub rms_m: f64,
    /// Largest of them, m.
    pub max_m: f64,
    /// How many they are.
    pub points: usize,
    /// Flanks beside its first contact.
    pub flanks: Flanks,
}

/// A curve that is being sought.
#[derive(Clone, Copy)]
struct Sought {
    pole: Point,
    height: f64,
    rise: f64,
    inset: f64,
    at: f64,
}

impl Sought {
    fn grown(&self, phi: f64) -> f64 {
        (self.rise * (phi - self.at)).exp()
    }

    /// Direction at whose tangent the point has its foot.
    fn foot(&self, point: &Point) -> f64 {
        let r = point - self.pole;
        let around = (r.y.atan2(r.x) - self.at + PI).rem_euclid(2.0 * PI) - PI;
        let mut phi = self.at + around;
        for _ in 0..STEPS {
            let (s, c) = phi.sin_cos();
            let p = self.height * self.grown(phi);
            let miss = r.dot(&Point::new(-s, c)) - self.rise * p;
            let step = miss / (r.dot(&Point::new(c, s)) + self.rise * self.rise * p);
            phi += step.clamp(-0.2, 0.2);
            if step.abs() < 1e-13 || !step.is_finite() {
                break;
            }
        }
        phi
    }

    /// Distance of a point, outwards positive, m.
    fn off(&self, point: &Point, phi: f64) -> f64 {
        (point - self.pole).dot(&Point::new(phi.cos(), phi.sin())) - self.height * self.grown(phi)
            + self.inset
    }

    /// Least squares by Gauss and Newton; `free_pole`: the pole is sought too.
    fn settled(mut self, points: &[Point], free_pole: bool) -> Option<Self> {
        let count = if free_pole { 4 } else { 2 };
        for _ in 0..STEPS {
            let mut slopes = DMatrix::zeros(points.len(), count);
            let mut misses = DVector::zeros(points.len());
            for (i, point) in points.iter().enumerate() {
                let phi = self.foot(point);
                misses[i] = self.off(point, phi);
                let grown = self.grown(phi);
                slopes[(i, 0)] = -grown;
                // In the unit of a length, as the others.
                slopes[(i, 1)] = -(phi - self.at) * grown;
                if free_pole {
                    (slopes[(i, 2)], slopes[(i, 3)]) = (-phi.cos(), -phi.sin());
                }
            }
            let step = slopes.tr_mul(&slopes).lu().solve(&slopes.tr_mul(&misses))?;
            self.height -= step[0];
            self.rise -= step[1] / self.height;
            if free_pole {
                self.pole -= Point::new(step[2], step[3]);
            }
            let is_sound = self.height > 0.0 && self.height < 1e3 && self.rise.abs() < 1.0;
            if !is_sound {
                return None;
            }
            if step.norm() < SETTLED_M {
                return Some(self);
            }
        }
        Some(self)
    }
}

/// The inner side between the races, the sprag that way up in which it engages.
pub(super) struct Side<'a> {
    pub(super) body: &'a Body,
    pub(super) points: Vec<Point>,
    /// Direction of the first contact of the arcs, rad.
    pub(super) contact_rad: f64,
    pub(super) tracks_m: [f64; 2],
}

impl<'a> Side<'a> {
    pub(super) fn new(
        body: &'a Body,
        side: &Curved,
        mirrored: bool,
        contact_rad: f64,
        tracks_m: [f64; 2],
    ) -> Self {
        let place = |p: &Point| if mirrored { Point::new(-p.x, p.y) } else { *p };
        Self { body, points: side.points.iter().map(place).collect(), contact_rad, tracks_m }
    }

    /// The spiral of a kind; `None` where the side begins as none.
    pub(super) fn spiral(&self, kind: SpiralKind) -> Option<FittedSpiral> {
        let (c_e, r_e) = self.body.outer;
        let inset = r_e * self.tracks_m[0] / self.tracks_m[1];
        let free_pole = kind == SpiralKind::Logarithmic;
        let start = self.start(if free_pole { 0.0 } else { inset })?;
        // Once from the arcs' first contact on, then from the spiral's own.
        let (mut from, mut found) = (self.contact_rad, None);
        for _ in 0..2 {
            let ahead = self.ahead(&start, from);
            let (fit, points) = self.longest(&start, free_pole, &ahead)?;
            from = self.first_contact(&fit, c_e, r_e)?;
            found = Some((fit, points));
        }
        let (fit, points) = found?;
        self.placed(kind, &fit, from, &points)
    }

    /// A curve to begin with: through the first contact of the arcs, with the rise that these have there.
    fn start(&self, inset: f64) -> Option<Sought> {
        let (c_e, _) = self.body.outer;
        let k = self.body.angles.windows(2).position(|w| self.contact_rad < w[1])?;
        let (centre, radius) = self.body.inner[k];
        let (s, c) = self.contact_rad.sin_cos();
        let (n, t) = (Point::new(c, s), Point::new(-s, c));
        let a = centre + radius * n - c_e;
        let height = a.dot(&n) + inset;
        Some(Sought { pole: c_e, height, rise: a.dot(&t) / height, inset, at: self.contact_rad })
    }

    /// The points from a direction on, in order, with it.
    fn ahead(&self, curve: &Sought, from: f64) -> Vec<(f64, Point)> {
        let mut all: Vec<(f64, Point)> = self.points.iter().map(|p| (curve.foot(p), *p)).collect();
        all.retain(|(phi, _)| *phi >= from);
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        all
    }

    /// The fit of the longest stretch from the first point on that lies on its curve; of all points where none does.
    fn longest(
        &self,
        start: &Sought,
        free_pole: bool,
        ahead: &[(f64, Point)],
    ) -> Option<(Sought, Vec<Point>)> {
        let (first, last) = (ahead.first()?.0, ahead.last()?.0);
        let few: Vec<_> = ahead.iter().step_by(ahead.len().div_ceil(TRIED_POINTS)).copied().collect();
        let up_to = |list: &[(f64, Point)], end: usize| -> Vec<Point> {
            let until = first + (last - first) * end as f64 / ENDS as f64;
            list.iter().filter(|a| a.0 <= until).map(|a| a.1).collect()
        };
        let on = |end: &usize| {
            let points = up_to(&few, *end);
            points.len() >= LEAST && start.settled(&points, free_pole).is_some_and(|fit| is_on(&fit, &points))
        };
        let end = (ENDS / 4..=ENDS).rev().find(on).unwrap_or(ENDS);
        let points = up_to(ahead, end);
        let fit = start.settled(&points, free_pole).filter(|_| points.len() >= LEAST)?;
        Some((fit, points))
    }

    /// Direction of the contact at which the sprag touches both races: (h + R_i)^2 + a^2 = (R_e - r_e)^2, h and a seen from C_e.
    fn first_contact(&self, curve: &Sought, c_e: Point, r_e: f64) -> Option<f64> {
        let [inner, outer] = self.tracks_m;
        let mut phi = self.contact_rad;
        for _ in 0..STEPS {
            let (at, rho) = seen_from(curve, c_e, phi);
            let miss = (at.height_m + inner).powi(2) + at.aside_m.powi(2) - (outer - r_e).powi(2);
            let step = miss / (2.0 * at.aside_m * (inner + rho));
            phi -= step.clamp(-0.2, 0.2);
            if step.abs() < 1e-13 {
                return Some(phi);
            }
        }
        None
    }

    /// The spiral as the file has it, with flanks beside its first contact and the end that these leave.
    fn placed(&self, kind: SpiralKind, curve: &Sought, from: f64, points: &[Point]) -> Option<FittedSpiral> {
        let (c_e, r_e) = self.body.outer;
        let [inner, outer] = self.tracks_m;
        let inset = r_e * inner / outer;
        let (at, start_radius_m) = seen_from(curve, c_e, from);
        let (s, c) = from.sin_cos();
        let n = Point::new(c, s);
        let a = c_e + at.height_m * n + at.aside_m * Point::new(-s, c);
        let axis = a + inner * n;
        let flanks = self.body.flanks_from(a, c_e + r_e * (c_e - axis).normalize());
        let strut_rad = at.tan_omega(inset).atan();
        let of = |until_rad: f64| match kind {
            SpiralKind::ConstantStrutAngle => {
                let from = Support::under(strut_rad, r_e, self.tracks_m)?;
                Some(Spiral::of_constant_angle(from, inset, [0.0, until_rad], STAND_FOR))
            }
            SpiralKind::Logarithmic => Some(Spiral {
                start_radius_m,
                rise: curve.rise,
                inset_m: 0.0,
                from_rad: 0.0,
                until_rad,
                steps: STAND_FOR,
            }),
        };
        let closes = |until_rad: f64| {
            let arcs = of(until_rad)?.arcs();
            let e_1 = at.centre_distance_m(arcs.first()?.0);
            let profile = Profile::new(r_e, e_1, &arcs, inner, outer).ok()?;
            Outline::closed(&profile, &flanks).ok().map(|_| ())
        };
        let feet: Vec<f64> = points.iter().map(|p| curve.foot(p)).collect();
        let seen = feet.iter().fold(0.0, |most: f64, phi| most.max(phi - from));
        let [mut low, mut high] = [0.0, seen.min(1.5)];
        if closes(high).is_none() {
            for _ in 0..50 {
                let middle = 0.5 * (low + high);
                if closes(middle).is_some() { low = middle } else { high = middle }
            }
            high = super::place::SHARE * low;
        }
        closes(high)?;
        let offs: Vec<f64> = points.iter().zip(&feet).map(|(p, phi)| curve.off(p, *phi)).collect();
        Some(FittedSpiral {
            kind,
            strut_rad,
            start_radius_m,
            rise: curve.rise,
            until_rad: high,
            rms_m: (offs.iter().map(|o| o * o).sum::<f64>() / offs.len() as f64).sqrt(),
            max_m: offs.iter().fold(0.0, |most, o| most.max(o.abs())),
            points: points.len(),
            flanks,
        })
    }
}

/// Steps of the arcs that stand for a spiral in a file that names none.
const STAND_FOR: usize = 12;

/// The contact in a direction as seen from C_e, and the radius of curvature there, m.
fn seen_from(curve: &Sought, c_e: Point, phi: f64) -> (Support, f64) {
    let (s, c) = phi.sin_cos();
    let p = curve.height * curve.grown(phi);
    let way = curve.pole - c_e;
    let at = Support {
        height_m: p - curve.inset + way.dot(&Point::new(c, s)),
        aside_m: curve.rise * p + way.dot(&Point::new(-s, c)),
    };
    (at, p * (1.0 + curve.rise * curve.rise) - curve.inset)
}

/// Whether the means of groups of points in order lie on the curve, by what the scatter of neighbours lets them.
fn is_on(curve: &Sought, points: &[Point]) -> bool {
    let offs: Vec<f64> = points.iter().map(|p| curve.off(p, curve.foot(p))).collect();
    let steps = offs.windows(2).map(|w| (w[1] - w[0]).powi(2)).sum::<f64>() / (2.0 * (offs.len() - 1) as f64);
    offs.chunks(offs.len().div_ceil(GROUPS)).all(|group| {
        let mean = group.iter().sum::<f64>() / group.len() as f64;
        mean.abs() <= FELT_M.max(SIGMAS * (steps / group.len() as f64).sqrt())
    })
}
