//! Tangent arcs of least squares through points.
//!
//! # Conventions
//! Arcs run counterclockwise. Angles are those of the direction from a centre, from +x counterclockwise.

use nalgebra::{DMatrix, DVector, Vector2};
use std::f64::consts::TAU;

type Point = Vector2<f64>;

/// Standard error of the radius of an arc that spans the angle phi, seen by N points with noise sigma, over
/// sigma/(sqrt(N) phi^2): 2 sqrt(180). A parabola y = x^2/(2 r) through even points of a length L knows 1/r to
/// 2 sqrt(180) sigma/(sqrt(N) L^2), and L = r phi. For small angles; at 1.4 rad some 10 % too much.
pub const STANDARD_ERROR: f64 = 26.832_815_729_997_478;
/// Steps of the search at most.
const STEPS: usize = 200;
/// Below this rms no arc is added, m: drawings are no better.
const FLOOR_M: f64 = 1e-10;
/// Points with which places for a further arc are tried; the best is settled with all.
const TRIED_POINTS: usize = 1500;
/// Inner arcs at most.
pub(super) const MOST_ARCS: usize = 6;

/// One arc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arc {
    /// Centre, m, as drawn.
    pub centre_m: Point,
    /// Radius, m.
    pub radius_m: f64,
    /// Standard error of the radius, m, from the scatter of the points about the arcs.
    pub radius_error_m: f64,
    /// Points on it.
    pub points: usize,
    /// Angle that they span, rad.
    pub span_rad: f64,
}

/// Tangent arcs.
#[derive(Debug, Clone, PartialEq)]
pub struct Arcs {
    /// In order.
    pub arcs: Vec<Arc>,
    /// Angles of the junctions, rad, rising; one less than arcs.
    pub junctions_rad: Vec<f64>,
    /// Root of the mean square of the distances, m.
    pub rms_m: f64,
    /// Largest distance, m.
    pub max_m: f64,
}

/// Parameters in mm and rad: centre and radius of the first arc, then junction and radius of each further one.
#[derive(Clone)]
struct Chain(Vec<f64>);

impl Chain {
    fn count(&self) -> usize {
        (self.0.len() - 1) / 2
    }

    fn junction(&self, k: usize) -> f64 {
        self.0[3 + 2 * k]
    }

    /// (centre, radius) of every arc: C_{k+1} = C_k + (r_k - r_{k+1}) d_k.
    fn circles(&self) -> Vec<(Point, f64)> {
        let mut all = vec![(Point::new(self.0[0], self.0[1]), self.0[2])];
        for k in 0..self.count() - 1 {
            let (centre, radius) = all[k];
            let next = self.0[4 + 2 * k];
            let (s, c) = self.junction(k).sin_cos();
            all.push((centre + (radius - next) * Point::new(c, s), next));
        }
        all
    }

    /// Which arc a point lies on: past the normal of each junction before.
    fn arc_of(&self, circles: &[(Point, f64)], p: &Point) -> usize {
        (0..self.count() - 1)
            .find(|&k| {
                let (s, c) = self.junction(k).sin_cos();
                Point::new(c, s).perp(&(p - circles[k].0)) < 0.0
            })
            .unwrap_or(self.count() - 1)
    }

    fn residuals(&self, points: &[Point]) -> DVector<f64> {
        let circles = self.circles();
        DVector::from_iterator(
            points.len(),
            points.iter().map(|p| {
                let (centre, radius) = circles[self.arc_of(&circles, p)];
                (p - centre).norm() - radius
            }),
        )
    }

    /// Whether radii are positive and junctions rise between the first and the last point.
    fn is_sound(&self, points: &[Point]) -> bool {
        let circles = self.circles();
        let angle = |p: &Point, c: Point| (p.y - c.y).atan2(p.x - c.x);
        let from = angle(&points[0], circles[0].0);
        let last = circles[self.count() - 1];
        let span = (angle(&points[points.len() - 1], last.0) - from).rem_euclid(TAU);
        let places: Vec<f64> =
            (0..self.count() - 1).map(|k| (self.junction(k) - from).rem_euclid(TAU)).collect();
        circles.iter().all(|c| c.1 > 0.0 && c.1 < 1e5)
            && places.windows(2).all(|w| w[0] < w[1])
            && places.iter().all(|p| *p > 1e-4 * span && *p < span)
    }

    /// Derivatives of the residuals, by differences.
    fn slopes(&self, points: &[Point], at: &DVector<f64>) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(points.len(), self.0.len());
        for j in 0..self.0.len() {
            let mut moved = self.clone();
            let step = 1e-6;
            moved.0[j] += step;
            matrix.set_column(j, &((moved.residuals(points) - at) / step));
        }
        matrix
    }

    /// Least squares by Levenberg and Marquardt.
    fn settled(mut self, points: &[Point]) -> (Self, f64) {
        let mut at = self.residuals(points);
        let (mut sum, mut damp) = (at.norm_squared(), 1e-3);
        for _ in 0..STEPS {
            let slopes = self.slopes(points, &at);
            let (square, right) = (slopes.tr_mul(&slopes), slopes.tr_mul(&at));
            let mut gained = 0.0;
            while damp < 1e12 {
                let mut damped = square.clone();
                for j in 0..self.0.len() {
                    damped[(j, j)] *= 1.0 + damp;
                }
                let Some(step) = damped.lu().solve(&right) else { break };
                let next = Self(self.0.iter().zip(step.iter()).map(|(v, s)| v - s).collect());
                let there = next.residuals(points);
                let less = there.norm_squared();
                if less < sum && next.is_sound(points) {
                    gained = (sum - less) / sum;
                    (self, at, sum, damp) = (next, there, less, 0.1 * damp);
                    break;
                }
                damp *= 10.0;
            }
            if gained < 1e-9 {
                break;
            }
        }
        (self, sum)
    }

    /// The same with one arc more: arc `k` cut at `part` of its angle, the radii on either side apart by `by`.
    fn split(&self, points: &[Point], k: usize, part: f64, by: f64) -> Self {
        let circles = self.circles();
        let angle = |p: &Point, c: Point| (p.y - c.y).atan2(p.x - c.x);
        let from = if k == 0 { angle(&points[0], circles[0].0) } else { self.junction(k - 1) };
        let to = if k + 1 == self.count() {
            angle(&points[points.len() - 1], circles[k].0)
        } else {
            self.junction(k)
        };
        let cut = from + part * (to - from).rem_euclid(TAU);
        let mut all = self.0.clone();
        let at = 3 + 2 * k;
        all.splice(at..at, [cut, circles[k].1 * (1.0 + by)]);
        Self(all)
    }

    fn done(&self, points: &[Point]) -> Arcs {
        let at = self.residuals(points);
        let free = points.len().saturating_sub(self.0.len()).max(1) as f64;
        let slopes = self.slopes(points, &at);
        let spread = slopes.tr_mul(&slopes).try_inverse();
        let variance = at.norm_squared() / free;
        let circles = self.circles();
        let arcs = circles.iter().enumerate().map(|(k, (centre, radius))| {
            let own: Vec<&Point> = points.iter().filter(|p| self.arc_of(&circles, p) == k).collect();
            let angle = |p: &Point| (p.y - centre.y).atan2(p.x - centre.x);
            let span_rad = match own[..] {
                [first, .., last] => (angle(last) - angle(first)).rem_euclid(TAU),
                _ => 0.0,
            };
            let j = 2 + 2 * k;
            let error = spread.as_ref().map_or(f64::INFINITY, |s| (variance * s[(j, j)].max(0.0)).sqrt());
            Arc {
                centre_m: 1e-3 * centre,
                radius_m: 1e-3 * radius,
                radius_error_m: 1e-3 * error,
                points: own.len(),
                span_rad,
            }
        });
        Arcs {
            arcs: arcs.collect(),
            junctions_rad: (0..self.count() - 1).map(|k| self.junction(k)).collect(),
            rms_m: 1e-3 * (at.norm_squared() / points.len() as f64).sqrt(),
            max_m: 1e-3 * at.amax(),
        }
    }
}

/// A circle through three points.
fn circumcircle(a: Point, b: Point, c: Point) -> Option<(Point, f64)> {
    let (u, v) = (b - a, c - a);
    let area = 2.0 * u.perp(&v);
    let to = Point::new(
        v.y * u.norm_squared() - u.y * v.norm_squared(),
        u.x * v.norm_squared() - v.x * u.norm_squared(),
    ) / area;
    (area.abs() > 1e-12).then(|| (a + to, to.norm()))
}

/// Arcs through `points` (m, counterclockwise): `count` of them, or as many as `deviation_m` asks for, or as the points
/// do: one is added while Schwarz's criterion falls, N ln(sum of squares) + parameters ln N.
pub(super) fn arcs(points_m: &[Point], count: Option<usize>, deviation_m: Option<f64>) -> Option<Arcs> {
    let points: Vec<Point> = points_m.iter().map(|p| 1e3 * p).collect();
    let n = points.len();
    // Means of a tenth of the points each, so that noise does not bend the start.
    let part = (n / 10).max(1);
    let mean = |from: usize| points[from..from + part].iter().sum::<Point>() / part as f64;
    let (centre, radius) = circumcircle(mean(0), mean((n - part) / 2), mean(n - part))?;
    let (mut best, mut sum) = Chain(vec![centre.x, centre.y, radius]).settled(&points);
    let criterion = |sum: f64, parameters: usize| {
        let floor = n as f64 * (1e3 * FLOOR_M).powi(2);
        n as f64 * (sum.max(floor)).ln() + parameters as f64 * (n as f64).ln()
    };
    let few: Vec<Point> = points.iter().step_by((n / TRIED_POINTS).max(1)).copied().collect();
    while best.count() < count.unwrap_or(MOST_ARCS) {
        if count.is_none() && sum <= n as f64 * (1e3 * FLOOR_M).powi(2) {
            break;
        }
        if count.is_none() && deviation_m.is_some_and(|most| best.done(&points).max_m <= most) {
            break;
        }
        let mut next: Option<(Chain, f64)> = None;
        for k in 0..best.count() {
            for part in [0.25, 0.5, 0.75] {
                for by in [-0.01, 0.01] {
                    let start = best.split(&few, k, part, by);
                    if !start.is_sound(&few) {
                        continue;
                    }
                    let tried = start.settled(&few);
                    if next.as_ref().is_none_or(|n| tried.1 < n.1) {
                        next = Some(tried);
                    }
                }
            }
        }
        let Some((chain, less)) = next.map(|(chain, _)| chain.settled(&points)) else { break };
        let worth = criterion(less, chain.0.len()) < criterion(sum, best.0.len());
        if count.is_none() && deviation_m.is_none() && !worth {
            break;
        }
        (best, sum) = (chain, less);
    }
    Some(best.done(&points))
}
