//! A ring under forces that are neither even nor evenly spaced: how one of them moves the track at another's place.
//!
//! A force N into the track at theta_0 is the pressure N/(2 pi R w) [1 + 2 sum_m cos m(theta - theta_0)], a force P along it
//! the same of shear. The mean growth is Lame's, (5), each m >= 2 is Michell's ring of `harmonic`. m = 0 of P turns the ring
//! and m = 1 of both moves it as a whole: both are left to what holds the ring, so the axis of a bent race is that from which
//! its track has no first harmonic.
//!
//! The sums converge like sum cos(m theta)/m; what the half-plane has of them is summed in closed form,
//!
//!   sum_{m>=1} cos(m theta)/m = -ln(2 sin(theta/2)),   sum_{m>=1} sin(m theta)/m = (pi - theta)/2,   0 < theta < 2 pi.

use std::f64::consts::{PI, TAU};

use super::harmonic::response;
use super::ring::Race;

/// Harmonics summed beyond the half-plane: of a wall of 2 % of the radius the last one feels nothing of the other rim.
const HARMONICS: usize = 600;

/// What forces on the track of one race do to it elsewhere; plane stress in the constants of its material.
#[derive(Debug, Clone)]
pub struct RingInfluence {
    /// Growth of the mean radius, away from the contacts, m/N.
    mean_m_per_n: f64,
    /// 1/(pi w E), m/N.
    per_n: f64,
    poisson: f64,
    /// Responses of the harmonics from 2 on, at unit radius and modulus.
    modes: Vec<[[f64; 2]; 2]>,
}

impl Race {
    /// Its influence.
    pub fn influence(&self) -> RingInfluence {
        let (other, nu) = (self.other_rim_m() / self.track_m(), self.material().poisson_ratio);
        RingInfluence {
            mean_m_per_n: self.compliance_m_per_n(1),
            per_n: 1.0 / (PI * self.width_m() * self.material().youngs_modulus_pa),
            poisson: nu,
            modes: (2..=HARMONICS).map_while(|m| response(m as f64, other, nu, self.rim())).collect(),
        }
    }
}

impl Race {
    /// Frequency of its lowest bending mode, two waves around, Hz; 0 for a ring without a response to it. By Rayleigh's
    /// quotient with the shape under the load cos 2 theta on the track: stiffness of that load, mass
    /// rho A pi R (1 + 1/m^2) of an inextensible ring of mean radius R, so that of a thin ring is Love's, *Mathematical Theory of
    /// Elasticity*, art. 293: f^2 = E I m^2 (m^2 - 1)^2/(rho A R^4 (m^2 + 1))/(2 pi)^2.
    pub fn lowest_mode_hz(&self) -> f64 {
        const M: f64 = 2.0;
        let influence = self.influence();
        let Some([[up, _], _]) = influence.modes.first() else { return 0.0 };
        let area_m2 = self.wall_m() * self.width_m();
        let mean_m = 0.5 * (self.track_m() + self.other_rim_m());
        let mass_kg = self.material().density_kg_m3 * area_m2 * PI * mean_m * (1.0 + 1.0 / (M * M));
        (1.0 / (influence.per_n * up * mass_kg)).sqrt() / TAU
    }
}

impl RingInfluence {
    /// Displacement of the track ahead by `angle_rad` (no multiple of 2 pi) of a force on it, m/N. Rows: radially away from the
    /// contacts, along the track in the positive sense; columns: of a normal force, of a force along the track.
    pub fn at(&self, angle_rad: f64) -> [[f64; 2]; 2] {
        let angle = angle_rad.rem_euclid(TAU);
        let (sin, cos) = angle.sin_cos();
        // The half-plane: 2/m, and -(1 - nu)/m across.
        let (direct, across) = (2.0, self.poisson - 1.0);
        let even = direct * (-(2.0 * (0.5 * angle).sin()).ln() - cos);
        let odd = across * (0.5 * (PI - angle) - sin);
        let mut sums = [[even, -odd], [odd, even]];
        let (mut c, mut s) = (cos, sin);
        for (k, [[up, ut], [vp, vt]]) in self.modes.iter().enumerate() {
            (c, s) = (c * cos - s * sin, s * cos + c * sin);
            let m = (k + 2) as f64;
            sums[0][0] += (up - direct / m) * c;
            sums[0][1] -= (ut - across / m) * s;
            sums[1][0] += (vp - across / m) * s;
            sums[1][1] += (vt - direct / m) * c;
        }
        let mut found = sums.map(|row| row.map(|sum| self.per_n * sum));
        found[0][0] += self.mean_m_per_n;
        found
    }

    /// Growth of the mean radius, away from the contacts, under normal forces (N) in all, m.
    pub fn mean_growth_m(&self, normal_n: f64) -> f64 {
        self.mean_m_per_n * normal_n
    }

    /// Amplitude of the radius in harmonic `m` >= 2 under (azimuth, normal force, force along the track), m.
    pub fn amplitude_m(&self, m: usize, forces: &[(f64, f64, f64)]) -> f64 {
        let Some([[up, ut], _]) = m.checked_sub(2).and_then(|k| self.modes.get(k)) else { return 0.0 };
        // N cos m(theta - theta_0), -P sin m(theta - theta_0).
        let (re, im) = forces.iter().fold((0.0, 0.0), |(re, im), (at, n, p)| {
            let (s, c) = (m as f64 * at).sin_cos();
            (re + up * n * c + ut * p * s, im + up * n * s - ut * p * c)
        });
        self.per_n * re.hypot(im)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Material;

    const STEEL: Material = Material { youngs_modulus_pa: 206e9, poisson_ratio: 0.3, density_kg_m3: 7850.0 };

    /// Two opposite forces on a thin ring of radius R, width w, thickness h (Timoshenko, *Strength of Materials* II, art. 13):
    /// the diameter between them grows by F R^3/(E I) (pi/4 - 2/pi), that across shrinks by F R^3/(E I) (2/pi - 1/2).
    #[test]
    fn a_thin_ring_under_two_opposite_forces() {
        let (r, h, w) = (50e-3, 0.5e-3, 6e-3);
        let race = Race::outer(r - 0.5 * h, r + 0.5 * h, w, STEEL).unwrap();
        let influence = race.influence();
        let unit = r.powi(3) / (206e9 * w * h.powi(3) / 12.0);
        // Of one force behind itself lies the local contact; take it from the other and the place beside it.
        let across = influence.at(0.5 * PI)[0][0] + influence.at(1.5 * PI)[0][0];
        assert!((-2.0 * across / unit / (2.0 / PI - 0.5) - 1.0).abs() < 0.03, "{}", across / unit);
        let near = influence.at(0.02)[0][0] + influence.at(PI - 0.02)[0][0];
        assert!((2.0 * near / unit / (0.25 * PI - 2.0 / PI) - 1.0).abs() < 0.03, "{}", near / unit);
    }

    /// Love's thin ring, free; its wall gives 3 h^2/(10 R^2)-like parts of shear.
    #[test]
    fn the_lowest_mode_of_a_thin_ring_is_love_s() {
        let (r, h, w) = (50e-3, 1e-3, 6e-3);
        let race = Race::outer(r - 0.5 * h, r + 0.5 * h, w, STEEL).unwrap();
        let (e_i, mass) = (206e9 * w * h.powi(3) / 12.0, 7850.0 * w * h);
        let love = (e_i * 36.0 / (5.0 * mass * r.powi(4))).sqrt() / TAU;
        assert!((race.lowest_mode_hz() / love - 1.0).abs() < 0.03, "{} {love}", race.lowest_mode_hz());
    }

    #[test]
    fn the_displacements_are_reciprocal_and_even_forces_are_the_law_of_even_sprags() {
        for race in [
            Race::outer(19.44e-3, 26.23e-3, 6e-3, STEEL).unwrap(),
            Race::inner(7.21e-3, 11.11e-3, 6e-3, STEEL).unwrap(),
            Race::inner(0.0, 11.11e-3, 6e-3, STEEL).unwrap(),
        ] {
            let influence = race.influence();
            for angle in [0.3, 1.0, 2.0, 3.0, 4.5] {
                let (ahead, behind) = (influence.at(angle), influence.at(-angle));
                assert!((ahead[1][0] - behind[0][1]).abs() < 1e-14 * ahead[0][0].abs().max(1e-9));
                assert!((ahead[0][0] - behind[0][0]).abs() < 1e-12 * ahead[0][0].abs());
            }
            // Harmonics below the number of even forces are silent, the mean is Lame's.
            let forces: Vec<_> = (0..12).map(|k| (TAU * f64::from(k) / 12.0, 1.0, 0.08)).collect();
            assert!(influence.amplitude_m(2, &forces) < 1e-20 && influence.amplitude_m(12, &forces) > 1e-14);
            assert!((influence.mean_growth_m(12.0) / race.compliance_m_per_n(12) - 1.0).abs() < 1e-14);
        }
    }
}
