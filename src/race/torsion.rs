//! Torsion of a ring: how far its track turns against another of its circles.

use std::f64::consts::TAU;

use super::ring::Race;
use crate::material::Material;

/// Turn of a circle of radius `a_m` against one of radius `b_m` in a ring `width_m` wide, rad per N m of torque that
/// passes from one to the other, not negative: |1/a^2 - 1/b^2|/(4 pi G w).
///
/// The shear tau = T/(2 pi r^2 w) of any ring that is turned (Timoshenko & Goodier, *Theory of Elasticity*, art. 42)
/// over G is r d(u_theta/r)/dr. It is the mean round the circle whether the torque comes in evenly or through contacts:
/// their harmonics turn no circle as a whole.
pub fn twist_rad_per_nm(a_m: f64, b_m: f64, width_m: f64, material: &Material) -> f64 {
    (a_m.powi(-2) - b_m.powi(-2)).abs() / (2.0 * TAU * material.shear_modulus_pa() * width_m)
}

impl Race {
    /// Turn of the track against the other rim, rad per N m; `None` for a solid shaft, whose torque leaves along its axis.
    pub fn twist_rad_per_nm(&self) -> Option<f64> {
        let (track, rim) = (self.track_m(), self.other_rim_m());
        (rim > 0.0).then(|| twist_rad_per_nm(track, rim, self.width_m(), self.material()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEEL: Material = Material { youngs_modulus_pa: 206e9, poisson_ratio: 0.3, density_kg_m3: 7850.0 };

    #[test]
    fn it_stores_the_work_of_its_torque() {
        // Energy of the shear, tau^2/(2G) over the ring, by the midpoint rule, against T times half the turn.
        let (a, b, width, torque) = (11.11e-3, 7.21e-3, 6e-3, 100.0);
        let cells = 20_000;
        let energy: f64 = (0..cells)
            .map(|i| {
                let step = (a - b) / f64::from(cells);
                let r = b + step * (f64::from(i) + 0.5);
                let shear = torque / (TAU * r * r * width);
                shear * shear / (2.0 * STEEL.shear_modulus_pa()) * TAU * r * width * step
            })
            .sum();
        let turn = torque * twist_rad_per_nm(a, b, width, &STEEL);
        assert!((0.5 * torque * turn / energy - 1.0).abs() < 1e-7, "{turn} {energy}");
    }

    #[test]
    fn a_thin_ring_shears_like_a_strip_and_a_shaft_has_no_other_rim() {
        // gamma t/R with gamma = T/(2 pi R^2 w G).
        let (radius, wall, width) = (50e-3, 1e-5, 10e-3);
        let strip = wall / (radius * TAU * radius.powi(2) * width * STEEL.shear_modulus_pa());
        let ring = Race::outer(radius - 0.5 * wall, radius + 0.5 * wall, width, STEEL).unwrap();
        assert!((ring.twist_rad_per_nm().unwrap() / strip - 1.0).abs() < 1e-6);
        assert_eq!(Race::inner(0.0, 0.02, width, STEEL).unwrap().twist_rad_per_nm(), None);
    }
}
