//! The rim of a race away from its contacts: free, or held by a housing or a shaft that does not yield.

use super::ring::Race;
use schemars::JsonSchema;
use serde::Deserialize;

/// What the rim away from the contacts is held by: the outside of an outer race, the bore of an inner one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Rim {
    /// Nothing: no stress across it, none along it but the even shear by which the torque leaves.
    #[default]
    Free,
    /// A stiff housing or shaft: it keeps its radius and does not slide there, it turns with what holds it.
    Held,
}

/// Lame's plane field of a ring without rotation: sigma_r = even - odd/r^2, sigma_hoop = even + odd/r^2, Pa, Pa m^2.
#[derive(Debug, Clone, Copy)]
struct WallField {
    even_pa: f64,
    odd_n: f64,
}

impl Race {
    /// (1 - nu)/(1 + nu), by which the rim's growth r/E [(1-nu) even + (1+nu) odd/r^2] ties the two parts of Lame's field.
    fn tie(&self) -> f64 {
        let nu = self.material().poisson_ratio;
        (1.0 - nu) / (1.0 + nu)
    }

    /// Hoop stress at the track over the pressure on it, held rim: -+ (1 - k q)/(1 + k q) with k = (1-nu)/(1+nu), q the square
    /// of the rim's over the track's radius; the sign as [`Race::lame_factor`] has it, so that (5) holds with it.
    pub(super) fn held_factor(&self) -> f64 {
        let kq = self.tie() * (self.other_rim_m() / self.track_m()).powi(2);
        let inward = (1.0 - kq) / (1.0 + kq);
        if self.is_inner() { inward } else { -inward }
    }

    /// The field under the pressure `pressure_pa` on the track of a race whose rim is held.
    fn held_field(&self, pressure_pa: f64) -> WallField {
        let (track, rim) = (self.track_m().powi(2), self.other_rim_m().powi(2));
        let even_pa = -pressure_pa / (1.0 + self.tie() * rim / track);
        WallField { even_pa, odd_n: -self.tie() * rim * even_pa }
    }

    /// Mean hoop stress at the radius `at_m` under the pressure `pressure_pa` on the track, rim held, Pa, tension positive.
    pub(super) fn held_hoop_pa(&self, pressure_pa: f64, at_m: f64) -> f64 {
        let WallField { even_pa, odd_n } = self.held_field(pressure_pa);
        even_pa + odd_n / at_m.powi(2)
    }

    /// Largest von Mises stress under the pressure `pressure_pa`, rim held, plane stress, Pa: sqrt(even^2 + 3 odd^2/r^4), largest
    /// at the smaller radius.
    pub(super) fn held_equivalent_pa(&self, pressure_pa: f64) -> f64 {
        let WallField { even_pa, odd_n } = self.held_field(pressure_pa);
        even_pa.hypot(3.0f64.sqrt() * odd_n / self.track_m().min(self.other_rim_m()).powi(2))
    }

    /// Hoop stress at the free track of a ring that rotates at `speed_rad_s` with its rim held, Pa, tension positive. With
    /// sigma_r = even - odd/r^2 - S r^2 and sigma_hoop = even + odd/r^2 - H r^2, S = (3+nu)/8 rho omega^2, H = (1+3nu)/8 rho
    /// omega^2 (Timoshenko & Goodier, *Theory of Elasticity*, art. 32): no stress across the track, no growth of the rim.
    pub(super) fn held_rotating_hoop_pa(&self, speed_rad_s: f64) -> f64 {
        let nu = self.material().poisson_ratio;
        let inertia = 0.125 * self.material().density_kg_m3 * speed_rad_s.powi(2);
        let (track, rim) = (self.track_m().powi(2), self.other_rim_m().powi(2));
        let (across, along) = ((3.0 + nu) * inertia * track, (1.0 + 3.0 * nu) * inertia * track);
        let grow = (1.0 - nu * nu) * inertia * rim;
        let even = (grow + (1.0 + nu) * across * track / rim) / (1.0 - nu + (1.0 + nu) * track / rim);
        even + (even - across) - along
    }
}

#[cfg(test)]
mod tests {
    use super::super::shooting::{Disc, Rim as Solved};
    use super::*;
    use crate::material::Material;

    const STEEL: Material = Material { youngs_modulus_pa: 206e9, poisson_ratio: 0.3, density_kg_m3: 7850.0 };
    const CONTACTS: usize = 12;

    fn races() -> [Race; 2] {
        let inner = Race::inner(7.21e-3, 11.11e-3, 6e-3, STEEL).unwrap();
        let outer = Race::outer(19.44e-3, 26.23e-3, 6e-3, STEEL).unwrap();
        [inner, outer].map(|race| race.with_rim(Rim::Held))
    }

    /// Track and rim of the ring integrated radially, with the stress across the rim that leaves it where it is.
    fn solved(race: &Race, pressure_pa: f64, speed_rad_s: f64) -> [Solved; 2] {
        let (track, rim) = (race.track_m(), race.other_rim_m());
        let disc = Disc::new(track.min(rim), track.max(rim), STEEL, speed_rad_s);
        let at = |across_pa: f64| {
            if rim < track {
                let (inside, outside) = disc.rims(across_pa, -pressure_pa);
                [outside, inside]
            } else {
                let (inside, outside) = disc.rims(-pressure_pa, across_pa);
                [inside, outside]
            }
        };
        let (zero, one) = (at(0.0)[1].growth_m, at(1e8)[1].growth_m);
        at(-1e8 * zero / (one - zero))
    }

    fn close(a: f64, b: f64) {
        assert!((a - b).abs() <= 1e-8 * b.abs(), "{a} against {b}");
    }

    #[test]
    fn a_held_ring_satisfies_radial_equilibrium_and_keeps_its_rim() {
        for race in races() {
            let n = 4500.0;
            let p = race.track_pressure_pa(CONTACTS, n);
            let [track, rim] = solved(&race, p, 0.0);
            assert!(rim.growth_m.abs() < 1e-9 * track.growth_m.abs());
            close(race.compliance_m_per_n(CONTACTS) * n, track.growth_m.abs());
            close(race.hoop_at_track_pa(CONTACTS, n), track.hoop_pa);
            close(race.hoop_at_radius_pa(CONTACTS, n, race.other_rim_m()), rim.hoop_pa);
            let free = race.with_rim(Rim::Free);
            assert!(race.compliance_m_per_n(CONTACTS) < 0.5 * free.compliance_m_per_n(CONTACTS));
        }
    }

    #[test]
    fn the_largest_equivalent_stress_is_that_of_one_of_the_rims() {
        for race in races() {
            let p = race.track_pressure_pa(CONTACTS, 4500.0);
            let [track, rim] = solved(&race, p, 0.0);
            let mises = |across: f64, along: f64| (across * across - across * along + along * along).sqrt();
            // sigma_hoop = nu sigma_r where a rim does not grow.
            let most = mises(-p, track.hoop_pa).max(mises(rim.hoop_pa / 0.3, rim.hoop_pa));
            assert!((race.equivalent_pa(CONTACTS, 4500.0) / most - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn a_held_outer_race_that_rotates_satisfies_equilibrium() {
        let [_, outer] = races();
        let speed = 2000.0;
        let [track, _] = solved(&outer, 0.0, speed);
        close(outer.rotating_bore_hoop_pa(speed), track.hoop_pa);
        close(outer.centrifugal_bore_growth_m(speed), track.growth_m);
        assert!(track.growth_m < 0.5 * outer.with_rim(Rim::Free).centrifugal_bore_growth_m(speed));
    }
}
