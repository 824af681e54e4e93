//! Torques on the drivetrain: constant, over time, orders of a speed, gas.

use super::turned::Turned;
use crate::clutch::{DriveTorque, GasTorque};
use crate::numeric::course::Course;
use std::f64::consts::{PI, TAU};

/// A torque with what it needs at every instant.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Torque {
    Constant(f64),
    History(Course),
    Order { order: f64, amplitude_nm: f64, phase_rad: f64 },
    Gas(GasTorque),
}

impl Torque {
    /// `None` where a history is no course.
    pub(super) fn new(of: &DriveTorque) -> Option<Self> {
        Some(match of {
            DriveTorque::Constant(torque_nm) => Self::Constant(*torque_nm),
            DriveTorque::History(points) => Self::History(Course::new(points.clone())?),
            DriveTorque::Order { order, amplitude_nm, phase_rad } => {
                Self::Order { order: *order, amplitude_nm: *amplitude_nm, phase_rad: *phase_rad }
            }
            DriveTorque::Gas(gas) => Self::Gas(*gas),
        })
    }

    /// At `t` (s) where the inertia has turned by `angle_rad`, N m.
    pub(super) fn at(&self, t: f64, angle_rad: f64) -> f64 {
        match self {
            Self::Constant(torque_nm) => *torque_nm,
            Self::History(course) => course.at(t).0,
            Self::Order { order, amplitude_nm, phase_rad } => {
                amplitude_nm * (order * angle_rad + phase_rad).sin()
            }
            Self::Gas(gas) => gas.torque_nm(angle_rad),
        }
    }

    /// Its mean over a turn at the start of the scene, N m.
    pub(super) fn mean_at_start(&self) -> f64 {
        match self {
            Self::Constant(torque_nm) => *torque_nm,
            Self::History(course) => course.at(course.past_knot(0.0)).0,
            Self::Order { .. } => 0.0,
            Self::Gas(gas) => gas.mean_nm(),
        }
    }

    /// Its largest magnitude, N m; of gas the mean.
    pub(super) fn largest_nm(&self) -> f64 {
        match self {
            Self::Constant(torque_nm) => torque_nm.abs(),
            Self::History(course) => course.extremes().iter().fold(0.0, |m, x| m.max(x.abs())),
            Self::Order { amplitude_nm, .. } => amplitude_nm.abs(),
            Self::Gas(gas) => gas.mean_nm(),
        }
    }

    /// Whether it swings about 0.
    pub(super) fn is_order(&self) -> bool {
        matches!(self, Self::Order { .. })
    }

    pub(super) fn course(&self) -> Option<&Course> {
        if let Self::History(course) = self { Some(course) } else { None }
    }

    /// The same with time counted from `t` (s) on.
    pub(super) fn from(&self, t: f64) -> Self {
        match self {
            Self::History(course) => Self::History(course.from(t)),
            other => other.clone(),
        }
    }
}

impl GasTorque {
    /// Mean torque on the crank, N m: the work of all cylinders over two turns.
    pub fn mean_nm(&self) -> f64 {
        self.cylinders as f64 * self.mean_pressure_pa * self.swept_volume_m3 / (2.0 * TAU)
    }

    /// Torque on the crank turned by `angle_rad` since t = 0, N m, in the sense in which its angle grows.
    pub fn torque_nm(&self, angle_rad: f64) -> f64 {
        let apart = 2.0 * TAU / self.cylinders as f64;
        let of = |i: usize| self.of_cylinder_nm(angle_rad + self.phase_rad - i as f64 * apart);
        (0..self.cylinders).map(of).sum()
    }

    /// Torque of one cylinder that fires at its upper dead centre at angle 0, N m: (p - p_0) dV/dangle,
    ///
    ///   V = V_c + V_h/2 [1 - cos x + (1 - sqrt(1 - l^2 sin^2 x))/l],   V_c = V_h/(e - 1),
    ///
    /// with p = p_0 (V_max/V)^n in compression (the last half turn of two) and that times q in expansion (the first), where q makes
    /// the work of the cycle the mean pressure times V_h: q = 1 + p_i V_h (n - 1)/(p_0 V_max (e^(n-1) - 1)). dV = 0 at both
    /// dead centres, so the torque has no jump where the pressure has.
    fn of_cylinder_nm(&self, angle_rad: f64) -> f64 {
        let x = angle_rad.rem_euclid(2.0 * TAU);
        if (PI..3.0 * PI).contains(&x) {
            return 0.0;
        }
        let (l, swept, e, n) = (self.rod_ratio, self.swept_volume_m3, self.compression_ratio, self.exponent);
        let (sin, cos) = x.sin_cos();
        let root = (1.0 - l * l * sin * sin).sqrt();
        let smallest = swept / (e - 1.0);
        let volume = smallest + 0.5 * swept * (1.0 - cos + l * sin * sin / (1.0 + root));
        let slope = 0.5 * swept * sin * (1.0 + l * cos / root);
        let largest = smallest + swept;
        let compressed = self.intake_pa * (largest / volume).powf(n);
        let fired = if x < PI {
            1.0 + self.mean_pressure_pa * swept * (n - 1.0)
                / (self.intake_pa * largest * (e.powf(n - 1.0) - 1.0))
        } else {
            1.0
        };
        (compressed * fired - self.intake_pa) * slope
    }
}

/// A speed through points, or none.
pub(super) fn speed(points: &Option<Vec<[f64; 2]>>) -> Option<Turned> {
    points.clone().and_then(Turned::new)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn engine(cylinders: usize, mean_pressure_pa: f64) -> GasTorque {
        GasTorque {
            cylinders,
            swept_volume_m3: 5e-4,
            compression_ratio: 10.5,
            rod_ratio: 0.3,
            intake_pa: 0.9e5,
            exponent: 1.32,
            mean_pressure_pa,
            phase_rad: 0.4,
        }
    }

    /// By the mean over two turns, without the law that q was found from.
    #[test]
    fn the_work_of_a_cycle_is_the_mean_pressure_times_the_swept_volume() {
        for (cylinders, pressure_pa) in [(1, 0.0), (1, 9e5), (4, 9e5), (3, 2e5)] {
            let gas = engine(cylinders, pressure_pa);
            let points = 200_000;
            let at = |i: usize| gas.torque_nm(2.0 * TAU * (i as f64 + 0.5) / points as f64);
            let mean = (0..points).map(at).sum::<f64>() / points as f64;
            assert!(
                (mean - gas.mean_nm()).abs() < 1e-7 * gas.mean_nm().max(10.0),
                "{mean} {}",
                gas.mean_nm()
            );
        }
    }

    #[test]
    fn the_torque_has_no_jump_and_the_period_of_the_firing() {
        let gas = engine(4, 9e5);
        let largest = (0..2000).map(|i| gas.torque_nm(0.01 * f64::from(i)).abs()).fold(0.0, f64::max);
        for dead_centre in [0.0, PI, TAU, 3.0 * PI] {
            let [a, b] = [-1e-9, 1e-9].map(|d| gas.torque_nm(dead_centre - 0.4 + d));
            assert!((a - b).abs() < 1e-6 * largest, "{dead_centre}: {a} {b}");
        }
        for angle in [0.1, 1.0, 2.0] {
            assert!((gas.torque_nm(angle) - gas.torque_nm(angle + PI)).abs() < 1e-9 * largest);
        }
    }
}
