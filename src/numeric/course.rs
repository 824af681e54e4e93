//! A quantity over time, given by points: straight between them, held before the first and after the last.

/// A knot counts as passed when t exceeds it by this much of itself, so that a step that ends at a knot, however
/// its sum was rounded, still sees the side that it came from.
const SLACK: f64 = 4e-15;
/// The same at t = 0, s.
const SLACK_AT_ZERO: f64 = 1e-18;

/// Piecewise linear function of time; two points at one time are a jump.
///
/// Straight lines, because they are what the points say: a smoother curve through them would act where nobody
/// asked for it. The integrator ends a step at every knot instead (see [`Course::next_knot`]).
#[derive(Debug, Clone, PartialEq)]
pub struct Course {
    points: Vec<[f64; 2]>,
}

fn after(knot: f64) -> f64 {
    knot + SLACK * knot.abs() + SLACK_AT_ZERO
}

impl Course {
    /// Through `points` (time, value), times not falling. `None` where there is no point, a time falls or a
    /// number is not finite.
    pub fn new(points: Vec<[f64; 2]>) -> Option<Self> {
        let ordered = points.windows(2).all(|w| w[0][0] <= w[1][0]);
        let finite = points.iter().flatten().all(|x| x.is_finite());
        (ordered && finite && !points.is_empty()).then_some(Self { points })
    }

    /// Value and slope at `t`; at a knot those of the side before it.
    pub fn at(&self, t: f64) -> (f64, f64) {
        let next = self.points.partition_point(|p| after(p[0]) < t);
        let Some(&[t1, v1]) = self.points.get(next) else {
            return (self.points[self.points.len() - 1][1], 0.0);
        };
        let Some(&[t0, v0]) = next.checked_sub(1).and_then(|i| self.points.get(i)) else { return (v1, 0.0) };
        let slope = (v1 - v0) / (t1 - t0);
        (v0 + slope * (t - t0).min(t1 - t0), slope)
    }

    /// First knot that is not yet passed at `t`.
    pub fn next_knot(&self, t: f64) -> Option<f64> {
        self.points.get(self.points.partition_point(|p| after(p[0]) < t)).map(|p| p[0])
    }

    /// `t`, or the first time beyond a knot that `t` has reached.
    pub fn past_knot(&self, t: f64) -> f64 {
        match self.next_knot(t) {
            Some(knot) if t >= knot - SLACK * knot.abs() => knot + 2.0 * (SLACK * knot.abs() + SLACK_AT_ZERO),
            _ => t,
        }
    }

    /// The same course with its time counted from `t`.
    pub fn from(&self, t: f64) -> Self {
        Self { points: self.points.iter().map(|p| [p[0] - t, p[1]]).collect() }
    }

    /// Smallest and largest value.
    pub fn extremes(&self) -> [f64; 2] {
        self.points
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| [low.min(p[1]), high.max(p[1])])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn course() -> Course {
        Course::new(vec![[0.1, 1.0], [0.3, 5.0], [0.3, -2.0], [0.7, -2.0], [0.9, 0.0]]).unwrap()
    }

    #[test]
    fn it_is_straight_between_points_and_held_outside() {
        let c = course();
        for (t, value, slope) in
            [(-1.0, 1.0, 0.0), (0.2, 3.0, 20.0), (0.5, -2.0, 0.0), (0.8, -1.0, 10.0), (5.0, 0.0, 0.0)]
        {
            let (v, s) = c.at(t);
            assert!((v - value).abs() < 1e-14 && (s - slope).abs() < 1e-12, "{t}: {v} {s}");
        }
        assert_eq!(c.extremes(), [-2.0, 5.0]);
        for bad in [vec![], vec![[1.0, 0.0], [0.5, 0.0]], vec![[0.0, f64::NAN]]] {
            assert!(Course::new(bad).is_none());
        }
    }

    #[test]
    fn a_jump_has_two_sides_and_no_rounding_mixes_them() {
        let c = course();
        for ulps in -3..=3 {
            let t = f64::from_bits((0.3_f64.to_bits() as i64 + ulps) as u64);
            assert!((c.at(t).0 - 5.0).abs() < 1e-13, "{ulps}: before");
            let t = c.past_knot(t);
            assert!((c.at(t).0 + 2.0).abs() < 1e-13, "{ulps}: after");
            assert_eq!(c.next_knot(t), Some(0.7));
        }
        let at_zero = Course::new(vec![[0.0, 1.0], [0.0, 2.0]]).unwrap();
        assert_eq!((at_zero.at(0.0).0, at_zero.at(at_zero.past_knot(0.0)).0), (1.0, 2.0));
        assert_eq!(c.past_knot(0.5), 0.5);
        assert!((c.from(0.2).at(0.0).0 - c.at(0.2).0).abs() < 1e-14);
    }
}
