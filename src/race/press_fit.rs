//! Two rings pressed into one another: pressure at the joint, what the track moves, hoop stress of the race.

use super::rim::Rim;
use super::ring::Race;

/// What a fit does to a race; stresses and growth by the fit alone, all proportional to the interference.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PressFit {
    /// Pressure at the joint, Pa, not negative.
    pub pressure_pa: f64,
    /// Growth of the track, m, outward positive: a shaft widens the inner race, a housing narrows the outer one.
    pub track_growth_m: f64,
    /// Hoop stress at the track, Pa, tension positive.
    pub hoop_at_track_pa: f64,
    /// Hoop stress of the race at the joint, Pa, tension positive.
    pub hoop_at_joint_pa: f64,
}

impl Race {
    /// The fit of this race with the ring on its other side, a shaft in an inner race or a housing round an outer one,
    /// interference `radial_m` (half of that on diameter), m >= 0; both of one width.
    ///
    /// Lame (Timoshenko, *Strength of Materials* II, art. 42): with joint radius R, ring bore R_1 < R < R_2 outside
    ///   p = delta / {R/E_o [(R_2^2+R^2)/(R_2^2-R^2) + nu_o] + R/E_i [(R^2+R_1^2)/(R^2-R_1^2) - nu_i]}.
    /// A ring (a, b) under p in its bore grows at its outside by 2 p a^2 b/(E (b^2-a^2)), hoop 2 p a^2/(b^2-a^2) there and
    /// p (b^2+a^2)/(b^2-a^2) at the bore; under p outside its bore shrinks by 2 p a b^2/(E (b^2-a^2)), hoop
    /// -2 p b^2/(b^2-a^2) there and -p (b^2+a^2)/(b^2-a^2) outside.
    pub fn press_fit(&self, partner: &Race, radial_m: f64) -> PressFit {
        let joint_m = self.other_rim_m();
        // The bore widens with + nu, the outside narrows with - nu, whichever piece it belongs to.
        let sign = if self.track_m() > joint_m { 1.0 } else { -1.0 };
        let give = |race: &Race, sign: f64| {
            let m = race.material();
            joint_m / m.youngs_modulus_pa * (race.lame_factor() + sign * m.poisson_ratio)
        };
        let p = radial_m / (give(self, sign) + give(partner, -sign));
        let (track, joint) = (self.track_m().powi(2), joint_m.powi(2));
        // > 0 for an inner race, whose joint is its bore; < 0 for an outer one.
        let wall = track - joint;
        PressFit {
            pressure_pa: p,
            track_growth_m: 2.0 * p * joint * self.track_m() / (self.material().youngs_modulus_pa * wall),
            hoop_at_track_pa: 2.0 * p * joint / wall,
            hoop_at_joint_pa: p * (track + joint) / wall,
        }
    }

    /// Mean hoop stress under track load at the radius `at_m` of a race that is one piece from its far rim to its track,
    /// Pa, tension positive (Lame): -+ P T^2 (1 + o^2/r^2)/|T^2 - o^2| with the pressure P on the track T, o the other rim;
    /// - for an inner race, + for an outer one. Of a race whose rim is held, Lame's with that rim unmoved.
    pub fn hoop_at_radius_pa(&self, contacts: usize, normal_n: f64, at_m: f64) -> f64 {
        if self.rim() == Rim::Held {
            return self.held_hoop_pa(self.track_pressure_pa(contacts, normal_n), at_m);
        }
        let (track, other) = (self.track_m().powi(2), self.other_rim_m().powi(2));
        -self.track_pressure_pa(contacts, normal_n) * track * (1.0 + other / at_m.powi(2)) / (track - other)
    }
}

#[cfg(test)]
mod tests {
    use super::super::shooting::Disc;
    use super::*;
    use crate::material::Material;

    const STEEL: Material = Material { youngs_modulus_pa: 206e9, poisson_ratio: 0.3, density_kg_m3: 7850.0 };
    const BRONZE: Material =
        Material { youngs_modulus_pa: 110e9, poisson_ratio: 0.34, density_kg_m3: 8800.0 };

    fn close(a: f64, b: f64) {
        assert!((a - b).abs() <= 1e-8 * b.abs(), "{a} against {b}");
    }

    /// Both pieces by integrating the radial equilibrium: the joint's two sides move apart by the interference, the
    /// stresses at the rims are what the integration has.
    #[test]
    fn a_fit_closes_its_interference() {
        let radial = 8e-6;
        let race = Race::inner(7.21e-3, 11.11e-3, 6e-3, STEEL).unwrap();
        let shaft = Race::inner(3e-3, 7.21e-3, 6e-3, BRONZE).unwrap();
        let fit = race.press_fit(&shaft, radial);
        let (bore, track) = Disc::new(7.21e-3, 11.11e-3, STEEL, 0.0).rims(-fit.pressure_pa, 0.0);
        let (_, outside) = Disc::new(3e-3, 7.21e-3, BRONZE, 0.0).rims(0.0, -fit.pressure_pa);
        close(bore.growth_m - outside.growth_m, radial);
        close(fit.track_growth_m, track.growth_m);
        close(fit.hoop_at_track_pa, track.hoop_pa);
        close(fit.hoop_at_joint_pa, bore.hoop_pa);

        let race = Race::outer(19.44e-3, 26.23e-3, 6e-3, STEEL).unwrap();
        let housing = Race::outer(26.23e-3, 40e-3, 6e-3, BRONZE).unwrap();
        let fit = race.press_fit(&housing, radial);
        let (track, joint) = Disc::new(19.44e-3, 26.23e-3, STEEL, 0.0).rims(0.0, -fit.pressure_pa);
        let (inside, _) = Disc::new(26.23e-3, 40e-3, BRONZE, 0.0).rims(-fit.pressure_pa, 0.0);
        close(inside.growth_m - joint.growth_m, radial);
        close(fit.track_growth_m, track.growth_m);
        assert!(fit.track_growth_m < 0.0);
        close(fit.hoop_at_track_pa, track.hoop_pa);
        close(fit.hoop_at_joint_pa, joint.hoop_pa);
    }

    #[test]
    fn the_stress_at_a_radius_ends_in_those_at_the_rims() {
        let race = Race::inner(7.21e-3, 11.11e-3, 6e-3, STEEL).unwrap();
        close(race.hoop_at_radius_pa(12, 1e3, 7.21e-3), race.hoop_at_bore_pa(12, 1e3));
        close(race.hoop_at_radius_pa(12, 1e3, 11.11e-3), race.hoop_at_track_pa(12, 1e3));
        let race = Race::outer(19.44e-3, 26.23e-3, 6e-3, STEEL).unwrap();
        close(race.hoop_at_radius_pa(12, 1e3, 19.44e-3), race.hoop_at_track_pa(12, 1e3));
    }
}
