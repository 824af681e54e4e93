//! Hoop stress along a track between two contacts, the forces along the track with those across it.
//!
//! A contact presses with N and pulls the track along with P. Of each harmonic m = k n of p(theta) = p_mean [1 + 2 sum cos(m theta)]
//! the ring's hoop stress is h_k cos(m theta), of the same shear it is s_k sin(m theta) (Michell, `harmonic`). The half-plane has
//! h = -1 and s = -2 at every m, a disc too; summed they are + p_mean beside a normal force and Flamant's -(2/pi) P/(w x) at the
//! distance x beside a force along the surface (Johnson, *Contact Mechanics*, 2.3). The latter, of the contacts at both ends,
//! is left out here: it is the contact's, whose width it feels. What is left is smooth.

use std::f64::consts::TAU;

use super::harmonic::track_hoops;
use super::ring::Race;

/// Hoop stress along one track per force of a contact, but for what the tractions of the two contacts beside it do there.
#[derive(Debug, Clone)]
pub struct TrackHoop {
    contacts: usize,
    /// Lame's mean with the pressure that is absent beside the contacts, and the mean pressure itself, per normal force, Pa/N.
    mean_pa_per_n: f64,
    pressure_pa_per_n: f64,
    /// h_k + 1 and s_k + 2.
    beyond: Vec<[f64; 2]>,
}

impl Race {
    /// Hoop stress along its track under that many equal contacts.
    pub fn track_hoop(&self, contacts: usize) -> TrackHoop {
        let pressure_pa_per_n = self.track_pressure_pa(contacts, 1.0);
        TrackHoop {
            contacts,
            mean_pa_per_n: self.hoop_at_track_pa(contacts, 1.0) + pressure_pa_per_n,
            pressure_pa_per_n,
            beyond: track_hoops(self, contacts).map(|[h, s]| [h + 1.0, s + 2.0]).collect(),
        }
    }
}

impl TrackHoop {
    /// At `angle_rad` from a contact, 0 to one pitch, in the sense in which the force `along_n` pulls the track; Pa, tension
    /// positive.
    pub fn at(&self, angle_rad: f64, normal_n: f64, along_n: f64) -> f64 {
        let n = self.contacts as f64;
        let phase = n * angle_rad;
        let [across, along] =
            self.beyond.iter().enumerate().fold([0.0; 2], |[across, along], (k, [h, s])| {
                let (sin, cos) = ((k + 1) as f64 * phase).sin_cos();
                [across + 2.0 * h * cos, along + 2.0 * s * sin]
            });
        normal_n * (self.mean_pa_per_n + self.pressure_pa_per_n * across)
            + along_n * self.pressure_pa_per_n * (along - 2.0 * far_forces(phase))
    }
}

/// cot(phase/2) less the 2/phase of the force at 0 and the 2/(phase - 2 pi) of that at the end of the pitch.
fn far_forces(phase: f64) -> f64 {
    // x cot x = 1 - x^2/3 - ... near 0; the end is its mirror image.
    let near = |x: f64| {
        let half = 0.5 * x;
        if half.abs() < 1e-3 { -half / 3.0 } else { half.tan().recip() - half.recip() }
    };
    if phase < 0.5 * TAU { near(phase) - 2.0 / (phase - TAU) } else { near(phase - TAU) - 2.0 / phase }
}

#[cfg(test)]
mod tests {
    use super::super::Rim;
    use super::*;
    use crate::material::Material;

    const STEEL: Material = Material { youngs_modulus_pa: 206e9, poisson_ratio: 0.3, density_kg_m3: 7850.0 };

    #[test]
    fn midway_it_is_the_hoop_stress_between_the_contacts_whatever_pulls_along() {
        for rim in [Rim::Free, Rim::Held] {
            let race = Race::outer(19.44e-3, 22.0e-3, 6e-3, STEEL).unwrap().with_rim(rim);
            let hoop = race.track_hoop(12);
            let midway = hoop.at(TAU / 24.0, 2e3, 160.0);
            assert!((midway / race.hoop_between_pa(12, 2e3) - 1.0).abs() < 1e-9);
            // The force along is odd about the middle, as a whole.
            let odd = |share: f64| hoop.at(share * TAU / 12.0, 0.0, 160.0);
            assert!((odd(0.2) + odd(0.8)).abs() < 1e-6 * odd(0.2).abs());
            // Short waves are those of a half-plane.
            assert!(hoop.beyond.last().is_some_and(|[h, s]| h.abs() < 1e-9 && s.abs() < 1e-9));
        }
    }

    /// Rows of `reports/hoop_beside_fem.py`: Table 1's races, one of them thin, one held. Each element's middle lies half a
    /// spacing deep, where the line loads press by -(2/pi) N z/(w x^2) more (Flamant) than at the surface.
    #[test]
    fn along_both_tracks_it_is_the_hoop_stress_of_finite_elements() {
        let table = include_str!("../../tests/reference/fem_hoop.csv");
        let (mut rows, mut worst) = (0, 0.0f64);
        for line in table.lines().skip(1) {
            let cells: Vec<&str> = line.split(',').collect();
            let number = |i: usize| cells[i].parse::<f64>().unwrap();
            let held = cells[4] == "held";
            let rim = if held { Rim::Held } else { Rim::Free };
            let [bore_m, outside_m] = [2, 3].map(|i| 1e-3 * number(i));
            let make = if cells[1] == "inner" { Race::inner } else { Race::outer };
            let race = make(bore_m, outside_m, 6e-3, STEEL).unwrap().with_rim(rim);
            let mut hoop = race.track_hoop(12);
            if !held {
                hoop.beyond = super::super::harmonic::driven_hoops(&race, 12)
                    .map(|[h, s]| [h + 1.0, s + 2.0])
                    .collect();
            }
            let (normal_n, tan, behind_m, deep_m) =
                (number(5), number(6), 1e-3 * number(7), 1e-3 * number(8));
            let pitch_m = TAU / 12.0 * race.track_m();
            let ahead_m = (-behind_m).rem_euclid(pitch_m);
            let line = |force_n: f64| 2.0 / std::f64::consts::PI * force_n / 6e-3;
            let near = line(tan * normal_n) * (1.0 / (pitch_m - ahead_m) - 1.0 / ahead_m);
            let pressed = line(normal_n) * deep_m / behind_m.powi(2);
            let stress = hoop.at(ahead_m / race.track_m(), normal_n, tan * normal_n) + near - pressed;
            let off = 1e-6 * stress - number(9);
            println!("{line:?} {:.1} off {off:.1}", 1e-6 * stress, line = &cells[..2]);
            rows += 1;
            worst = worst.max(off.abs());
        }
        println!("{rows} rows, {worst:.1} MPa off at most");
        assert!(rows > 100 && worst < 5.0, "{rows} {worst}");
    }

    #[test]
    fn a_disc_has_the_half_planes_stress_beside_every_force() {
        let shaft = Race::inner(0.0, 11.11e-3, 6e-3, STEEL).unwrap();
        let hoop = shaft.track_hoop(12);
        // Lame's -p and + p of what is absent: nothing beside the normal forces.
        assert!(hoop.at(0.1, 2e3, 0.0).abs() < 1e-3);
        // -2 q cot(phase/2), with the two nearest forces put back.
        let (phase, q) = (12.0 * 0.1, shaft.track_pressure_pa(12, 160.0));
        let whole = hoop.at(0.1, 0.0, 160.0) - 2.0 * q * (2.0 / phase + 2.0 / (phase - TAU));
        assert!((whole / (-2.0 * q / (0.5 * phase).tan()) - 1.0).abs() < 1e-9);
    }
}
