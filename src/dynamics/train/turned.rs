//! The angle that a speed over time has turned by.

use crate::numeric::course::Course;

/// Speed over time, straight between points, and its integral from the start of the scene.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::dynamics) struct Turned {
    course: Course,
    points: Vec<[f64; 2]>,
    /// Turned at each point since the first, rad.
    sums: Vec<f64>,
    /// The same at the start of the scene.
    at_start: f64,
}

impl Turned {
    /// Of a speed through `points` (s, rad/s), constant before and after; `None` where they are no course.
    pub(in crate::dynamics) fn new(points: Vec<[f64; 2]>) -> Option<Self> {
        let course = Course::new(points.clone())?;
        let mut sums = vec![0.0; points.len()];
        for i in 1..points.len() {
            let [[t0, v0], [t1, v1]] = [points[i - 1], points[i]];
            sums[i] = sums[i - 1] + 0.5 * (v0 + v1) * (t1 - t0);
        }
        let mut turned = Self { course, points, sums, at_start: 0.0 };
        turned.at_start = turned.angle_rad(0.0);
        Some(turned)
    }

    /// Turned since the start of the scene, rad.
    pub(in crate::dynamics) fn angle_rad(&self, t: f64) -> f64 {
        let next = self.points.partition_point(|p| p[0] < t);
        let sum = match next.checked_sub(1) {
            None => self.points[0][1] * (t - self.points[0][0]),
            Some(i) => {
                let ([t0, v0], dt) = (self.points[i], t - self.points[i][0]);
                let slope = self.points.get(next).map_or(0.0, |[t1, v1]| (v1 - v0) / (t1 - t0));
                self.sums[i] + dt * (v0 + 0.5 * slope * dt)
            }
        };
        sum - self.at_start
    }

    /// Speed (rad/s) and its rate (rad/s^2).
    pub(in crate::dynamics) fn speed(&self, t: f64) -> (f64, f64) {
        self.course.at(t)
    }

    /// The speed alone.
    pub(in crate::dynamics) fn course(&self) -> &Course {
        &self.course
    }

    /// The same with time counted from `t` (s) on, angles still from the start of the scene.
    pub(in crate::dynamics) fn from(&self, t: f64) -> Self {
        let points = self.points.iter().map(|p| [p[0] - t, p[1]]).collect();
        Self { course: self.course.from(t), points, ..self.clone() }
    }
}

#[cfg(test)]
mod tests {
    use super::Turned;

    #[test]
    fn the_angle_is_the_integral_of_the_speed_inside_and_outside_of_its_points() {
        let turned = Turned::new(vec![[0.5, 1.0], [1.5, 5.0], [2.0, -1.0]]).unwrap();
        for (t, angle) in [(0.0, 0.0), (0.5, 0.5), (1.0, 0.5 + 1.0), (1.5, 3.5), (2.0, 4.5), (3.0, 3.5)] {
            assert!((turned.angle_rad(t) - angle).abs() < 1e-14, "{t}: {}", turned.angle_rad(t));
            let later = turned.from(0.7);
            assert!((later.angle_rad(t - 0.7) - angle).abs() < 1e-14);
        }
        assert_eq!(Turned::new(vec![[0.0, 3.0]]).map(|t| t.angle_rad(2.0)), Some(6.0));
    }
}
