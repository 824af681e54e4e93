//! Counting of a torque over time: engagements by their peaks, cycles of the bodies by rainflow. Own code: the registry of
//! crates has none that counts rainflow.

/// A counted cycle between two torques.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cycle {
    /// Its least and largest value, N m.
    pub from_nm: f64,
    /// N m.
    pub to_nm: f64,
    /// 1, or 1/2 for a half cycle that is never closed.
    pub count: f64,
}

/// Ups and downs smaller than this share of the largest value are no turning points: noise.
pub const NOISE: f64 = 0.01;

/// Values of `rows` (time, torque) at which the torque turns; it begins and ends at 0, torques below 0, in overrun, count
/// as 0, and what comes back by less than [`NOISE`] of the largest does not turn.
pub fn turning_points(rows: &[[f64; 2]]) -> Vec<f64> {
    let largest = rows.iter().map(|r| r[1]).fold(0.0, f64::max);
    let band = NOISE * largest;
    let mut points: Vec<f64> = Vec::new();
    // The extreme since the last turning point, and the way it lies: up, down or not yet known.
    let (mut extreme, mut up) = (None::<f64>, None::<bool>);
    let rest = rows.first().map(|_| 0.0);
    for value in rest.into_iter().chain(rows.iter().map(|r| r[1].max(0.0))).chain(rest) {
        let Some(last) = extreme else {
            points.push(value);
            extreme = Some(value);
            continue;
        };
        match up {
            None if (value - last).abs() > band => (up, extreme) = (Some(value > last), Some(value)),
            None => {}
            Some(rising) if (value > last) == rising => extreme = Some(value),
            Some(rising) if (value - last).abs() > band => {
                points.push(last);
                (up, extreme) = (Some(!rising), Some(value));
            }
            Some(_) => {}
        }
    }
    if let (Some(last), Some(_)) = (extreme, up) {
        points.push(last);
    }
    points
}

/// Engagements (peak, N m; number) of turning points and their rainflow cycles: each peak above half of the largest
/// (Tsubakimoto, technical data of cam clutches, engagement fatigue life), and of the smaller ones each that the torque
/// comes to from less than half of it.
pub fn engagements(points: &[f64], swings: &[Cycle]) -> Vec<(f64, f64)> {
    let half_nm = 0.5 * points.iter().copied().fold(0.0, f64::max);
    let left = |i: usize| i == 0 || points[i - 1] < points[i];
    let right = |i: usize| points.get(i + 1).is_none_or(|next| *next < points[i]);
    let peaks = (0..points.len()).filter(|&i| left(i) && right(i)).map(|i| (points[i], 1.0));
    let smaller = swings.iter().filter(|c| c.to_nm <= half_nm && c.from_nm <= 0.5 * c.to_nm);
    peaks.filter(|p| p.0 > half_nm).chain(smaller.map(|c| (c.to_nm, c.count))).filter(|p| p.0 > 0.0).collect()
}

/// Rainflow cycles of turning points: ASTM E1049-85, 5.4.4.
pub fn rainflow(points: &[f64]) -> Vec<Cycle> {
    let mut found = Vec::new();
    let mut open: Vec<f64> = Vec::new();
    let cycle = |a: f64, b: f64, count: f64| Cycle { from_nm: a.min(b), to_nm: a.max(b), count };
    for &point in points {
        open.push(point);
        while let [.., a, b, c] = *open.as_slice() {
            if (c - b).abs() < (b - a).abs() {
                break;
            }
            let start = open.len() == 3;
            found.push(cycle(a, b, if start { 0.5 } else { 1.0 }));
            if start {
                open.remove(0);
            } else {
                open.truncate(open.len() - 3);
                open.push(c);
            }
        }
    }
    found.extend(open.windows(2).map(|w| cycle(w[0], w[1], 0.5)));
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ASTM E1049-85, figure 6: -2, 1, -3, 5, -1, 3, -4, 4, -2.
    #[test]
    fn rainflow_is_the_standards_example() {
        let counted = rainflow(&[-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0, -2.0]);
        let of = |range: f64| -> f64 {
            counted.iter().filter(|c| c.to_nm - c.from_nm == range).map(|c| c.count).sum()
        };
        assert_eq!([3.0, 4.0, 6.0, 8.0, 9.0].map(of), [0.5, 1.5, 0.5, 1.0, 0.5]);
        assert_eq!(counted.iter().map(|c| c.count).sum::<f64>(), 4.0);
    }

    #[test]
    fn noise_and_overrun_do_not_turn() {
        let torque = [0.0, 50.0, 49.8, 100.0, 99.5, 99.9, 20.0, -30.0, -10.0, 60.0, 40.0, 80.0, 10.0];
        let rows: Vec<[f64; 2]> = torque.iter().enumerate().map(|(i, v)| [i as f64, *v]).collect();
        let points = turning_points(&rows);
        assert_eq!(points, [0.0, 100.0, 0.0, 60.0, 40.0, 80.0, 0.0]);
        let engagements = |points: &[f64]| engagements(points, &rainflow(points));
        assert_eq!(engagements(&points), [(100.0, 1.0), (60.0, 1.0), (80.0, 1.0)]);
        // Small strokes beside a large one are engagements too; a ripple on one is none.
        let strokes = engagements(&[0.0, 290.0, 0.0, 144.0, 0.0, 144.0, 100.0, 140.0, 0.0]);
        let of = |peak: f64| -> f64 { strokes.iter().filter(|e| e.0 == peak).map(|e| e.1).sum() };
        assert_eq!([290.0, 144.0, 140.0].map(of), [1.0, 2.0, 0.0], "{strokes:?}");
        assert!(turning_points(&[]).is_empty() && engagements(&[0.0, 0.0]).is_empty());
        assert_eq!(turning_points(&[[0.0, 5.0], [1.0, 5.0]]), [0.0, 5.0, 0.0]);
    }

    #[test]
    fn every_turn_is_in_one_cycle_or_two_halves() {
        // Of n turning points come n - 1 ranges, each half a cycle.
        let mut random = fastrand::Rng::with_seed(4);
        for _ in 0..200 {
            let n = random.usize(2..40);
            let points: Vec<f64> =
                (0..n).map(|i| if i % 2 == 0 { random.f64() } else { 1.0 + random.f64() }).collect();
            let total: f64 = rainflow(&points).iter().map(|c| c.count).sum();
            assert_eq!(total, 0.5 * (n as f64 - 1.0));
        }
    }
}
