//! A race as a thick ring (Lame) and as a rotating disc with a hole.

use std::f64::consts::TAU;

use super::rim::Rim;
use crate::material::Material;

/// Which side of the ring the contacts press on.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Side {
    /// Inner race: loaded on its outside.
    Inner,
    /// Outer race: loaded on its bore.
    Outer,
}

/// Why three lengths are no race.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum RaceError {
    /// The radii must satisfy 0 <= bore < outside (0 < bore for an outer race).
    #[error("race radii out of order: bore {bore_m} m, outside {outside_m} m")]
    RadiiOutOfOrder {
        /// Bore radius given, m.
        bore_m: f64,
        /// Outside radius given, m.
        outside_m: f64,
    },
    /// The axial width must be positive.
    #[error("race width {width_m} m is not positive")]
    WidthNotPositive {
        /// Width given, m.
        width_m: f64,
    },
}

/// Inner or outer race under the mean pressure of equally spaced contacts, plane stress.
///
/// # Conventions
/// The deflection of (5) is positive where the gap opens: the outer race's track grows, the inner
/// race's track shrinks. Hoop stress is positive in tension: positive for a loaded outer race, negative
/// for a loaded inner one. The width is the race's own: it may exceed the length of the bodies on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Race {
    side: Side,
    bore_m: f64,
    outside_m: f64,
    width_m: f64,
    material: Material,
    rim: Rim,
}

impl Race {
    /// Inner race: bore R_id (0: solid shaft), track R_i on its outside, axial width, m.
    pub fn inner(bore_m: f64, track_m: f64, width_m: f64, material: Material) -> Result<Self, RaceError> {
        Self::checked(Side::Inner, bore_m, track_m, width_m, material)
    }

    /// Outer race: track R_e in its bore, outside R_ed, axial width, m.
    pub fn outer(track_m: f64, outside_m: f64, width_m: f64, material: Material) -> Result<Self, RaceError> {
        Self::checked(Side::Outer, track_m, outside_m, width_m, material)
    }

    fn checked(
        side: Side,
        bore_m: f64,
        outside_m: f64,
        width_m: f64,
        material: Material,
    ) -> Result<Self, RaceError> {
        let bore_fits = bore_m > 0.0 || (bore_m == 0.0 && side == Side::Inner);
        if !(bore_fits && bore_m < outside_m && outside_m.is_finite()) {
            return Err(RaceError::RadiiOutOfOrder { bore_m, outside_m });
        }
        if !(width_m > 0.0 && width_m.is_finite()) {
            return Err(RaceError::WidthNotPositive { width_m });
        }
        Ok(Self { side, bore_m, outside_m, width_m, material, rim: Rim::Free })
    }

    /// The same race with its other rim as `rim` says; a solid shaft has none to be held.
    pub fn with_rim(self, rim: Rim) -> Self {
        let rim = if self.other_rim_m() > 0.0 { rim } else { Rim::Free };
        Self { rim, ..self }
    }

    /// How the rim away from the contacts is held.
    pub fn rim(&self) -> Rim {
        self.rim
    }

    /// Whether the contacts press on its outside.
    pub(super) fn is_inner(&self) -> bool {
        self.side == Side::Inner
    }

    /// Track radius at rest, m: R_i or R_e.
    pub fn track_m(&self) -> f64 {
        match self.side {
            Side::Inner => self.outside_m,
            Side::Outer => self.bore_m,
        }
    }

    /// Radius of the rim away from the contacts, m: R_id or R_ed.
    pub fn other_rim_m(&self) -> f64 {
        match self.side {
            Side::Inner => self.bore_m,
            Side::Outer => self.outside_m,
        }
    }

    /// From the track to the other rim, m.
    pub fn wall_m(&self) -> f64 {
        self.outside_m - self.bore_m
    }

    /// Axial width, m.
    pub fn width_m(&self) -> f64 {
        self.width_m
    }

    /// Material.
    pub fn material(&self) -> &Material {
        &self.material
    }

    /// (R_o^2 + R_b^2)/(R_o^2 - R_b^2) of Lame's ring with bore R_b and outside R_o; 1 for a solid shaft; of a ring whose rim is
    /// held what takes its place.
    pub(super) fn lame_factor(&self) -> f64 {
        if self.rim == Rim::Held {
            return self.held_factor();
        }
        let (o, b) = (self.outside_m.powi(2), self.bore_m.powi(2));
        (o + b) / (o - b)
    }

    /// Eq. (5): delta_B / N = n_s/(2 pi w E) [(R_o^2 + R_b^2)/(R_o^2 - R_b^2) +- nu], m/N of normal force
    /// per contact; + nu for the outer race, - nu for the inner.
    ///
    /// Differs from the printed form in the length: w is the race's width, not the bodies' length, and
    /// n_s is the number of contacts (the paper's n). Linear, so this is also the tangent.
    #[doc(alias = "Eq. (5)")]
    pub fn compliance_m_per_n(&self, contacts: usize) -> f64 {
        let nu = match self.side {
            Side::Inner => -self.material.poisson_ratio,
            Side::Outer => self.material.poisson_ratio,
        };
        contacts as f64 / (TAU * self.width_m * self.material.youngs_modulus_pa) * (self.lame_factor() + nu)
    }

    /// Mean track pressure p = n_s N/(2 pi R w), Pa, not negative for N >= 0.
    pub fn track_pressure_pa(&self, contacts: usize, normal_n: f64) -> f64 {
        contacts as f64 * normal_n / (TAU * self.track_m() * self.width_m)
    }

    /// Mean hoop stress at the track, Pa, tension positive (Lame):
    /// outer +p (R_ed^2 + R_e^2)/(R_ed^2 - R_e^2), inner -p (R_i^2 + R_id^2)/(R_i^2 - R_id^2).
    pub fn hoop_at_track_pa(&self, contacts: usize, normal_n: f64) -> f64 {
        let hoop = self.track_pressure_pa(contacts, normal_n) * self.lame_factor();
        match self.side {
            Side::Inner => -hoop,
            Side::Outer => hoop,
        }
    }

    /// Mean hoop stress where it is largest in magnitude, at the bore, Pa, tension positive (Lame).
    ///
    /// Outer race: its bore is its track. Inner race: -2 p R_i^2/(R_i^2 - R_id^2) at the bore; a solid
    /// shaft has -p everywhere, not the limit -2 p of a pin hole.
    pub fn hoop_at_bore_pa(&self, contacts: usize, normal_n: f64) -> f64 {
        match self.side {
            Side::Outer => self.hoop_at_track_pa(contacts, normal_n),
            Side::Inner => {
                let p = self.track_pressure_pa(contacts, normal_n);
                if self.rim == Rim::Held {
                    return self.held_hoop_pa(p, self.bore_m);
                }
                if self.bore_m == 0.0 {
                    return -p;
                }
                let (o, b) = (self.outside_m.powi(2), self.bore_m.powi(2));
                -2.0 * p * o / (o - b)
            }
        }
    }

    /// Largest von Mises stress under the mean track pressure p, plane stress, Pa >= 0 (Lame; Timoshenko, *Strength of
    /// Materials* II, art. 41): sqrt(p^2 + p h + h^2) at the outer race's track with its hoop stress h; for an inner race
    /// 2 p R_i^2/(R_i^2 - R_id^2) at the free bore, above that at its track; p throughout a solid shaft.
    pub fn equivalent_pa(&self, contacts: usize, normal_n: f64) -> f64 {
        if self.rim == Rim::Held {
            return self.held_equivalent_pa(self.track_pressure_pa(contacts, normal_n));
        }
        match self.side {
            Side::Inner => self.hoop_at_bore_pa(contacts, normal_n).abs(),
            Side::Outer => {
                let (p, h) =
                    (self.track_pressure_pa(contacts, normal_n), self.hoop_at_track_pa(contacts, normal_n));
                (p * p + p * h + h * h).sqrt()
            }
        }
    }

    /// The same while it rotates at `speed_rad_s`, which stretches the track of an outer race, most of all there; an inner race, pressed
    /// together by its load, as at rest, where its stress is not less.
    pub fn turning_equivalent_pa(&self, contacts: usize, normal_n: f64, speed_rad_s: f64) -> f64 {
        let still = self.equivalent_pa(contacts, normal_n);
        if speed_rad_s == 0.0 || self.side == Side::Inner {
            return still;
        }
        let p = self.track_pressure_pa(contacts, normal_n);
        let h = self.hoop_at_track_pa(contacts, normal_n) + self.rotating_bore_hoop_pa(speed_rad_s);
        still.max((p * p + p * h + h * h).sqrt())
    }

    /// Hoop stress at the bore of the ring rotating at `speed_rad_s`, unloaded, Pa, tension positive:
    /// rho omega^2/4 [(3+nu) R_o^2 + (1-nu) R_b^2] (Timoshenko, *Theory of Elasticity*, art. 32);
    /// a solid shaft has (3+nu)/8 rho omega^2 R_o^2 at its centre. At the track of an outer race whose outside is held, less.
    pub fn rotating_bore_hoop_pa(&self, speed_rad_s: f64) -> f64 {
        if self.rim == Rim::Held && self.side == Side::Outer {
            return self.held_rotating_hoop_pa(speed_rad_s);
        }
        let nu = self.material.poisson_ratio;
        let inertia = self.material.density_kg_m3 * speed_rad_s.powi(2);
        if self.bore_m == 0.0 {
            return inertia * (3.0 + nu) / 8.0 * self.outside_m.powi(2);
        }
        inertia / 4.0 * ((3.0 + nu) * self.outside_m.powi(2) + (1.0 - nu) * self.bore_m.powi(2))
    }

    /// Eq. (7), corrected: growth of the bore of a disc rotating at `speed_rad_s`, m:
    /// delta_ce = rho omega^2 R_e/(4E) [(3+nu) R_ed^2 + (1-nu) R_e^2].
    ///
    /// The print lacks the 1/4. At the stress-free rim u = R sigma_hoop/E, so this is the hoop stress
    /// above times R_e/E; the test integrates the radial equilibrium and finds the print four times off.
    #[doc(alias = "Eq. (7)")]
    pub fn centrifugal_bore_growth_m(&self, speed_rad_s: f64) -> f64 {
        self.bore_m / self.material.youngs_modulus_pa * self.rotating_bore_hoop_pa(speed_rad_s)
    }

    /// Growth of its outside, bore and outside free, at `speed_rad_s`, m: rho omega^2 R_o/(4E) [(3+nu) R_b^2 + (1-nu) R_o^2] (Timoshenko,
    /// as above), of which a solid shaft has the second term alone.
    pub fn centrifugal_outside_growth_m(&self, speed_rad_s: f64) -> f64 {
        let (nu, e) = (self.material.poisson_ratio, self.material.youngs_modulus_pa);
        let inertia = self.material.density_kg_m3 * speed_rad_s.powi(2);
        let squares = (3.0 + nu) * self.bore_m.powi(2) + (1.0 - nu) * self.outside_m.powi(2);
        inertia * self.outside_m / (4.0 * e) * squares
    }
}

#[cfg(test)]
mod tests {
    use super::super::shooting::{Disc, Rim};
    use super::*;

    const STEEL: Material = Material { youngs_modulus_pa: 206e9, poisson_ratio: 0.3, density_kg_m3: 7850.0 };
    const CONTACTS: usize = 12;

    fn inner() -> Race {
        Race::inner(7.21e-3, 11.11e-3, 6e-3, STEEL).unwrap()
    }

    fn outer() -> Race {
        Race::outer(19.44e-3, 26.23e-3, 6e-3, STEEL).unwrap()
    }

    fn close(a: f64, b: f64, relative: f64) {
        assert!((a - b).abs() <= relative * b.abs(), "{a} against {b}");
    }

    #[test]
    fn eq_5_returns_the_26_and_15_um_of_the_public_model() {
        let outer_um = 4500e6 * outer().compliance_m_per_n(CONTACTS);
        let inner_um = 4500e6 * inner().compliance_m_per_n(CONTACTS);
        println!("outer {outer_um} um, inner {inner_um} um");
        assert_eq!((outer_um.round(), inner_um.round()), (26.0, 15.0));
    }

    #[test]
    fn eq_5_and_the_hoop_stresses_satisfy_radial_equilibrium() {
        let n = 4500.0;
        for (race, solved) in [
            (inner(), Disc::new(7.21e-3, 11.11e-3, STEEL, 0.0)),
            (outer(), Disc::new(19.44e-3, 26.23e-3, STEEL, 0.0)),
        ] {
            let p = race.track_pressure_pa(CONTACTS, n);
            let (inside, outside) =
                if race.side == Side::Inner { solved.rims(0.0, -p) } else { solved.rims(-p, 0.0) };
            let track: &Rim = if race.side == Side::Inner { &outside } else { &inside };
            close(race.compliance_m_per_n(CONTACTS) * n, track.growth_m.abs(), 1e-9);
            close(race.hoop_at_track_pa(CONTACTS, n), track.hoop_pa, 1e-9);
            close(race.hoop_at_bore_pa(CONTACTS, n), inside.hoop_pa, 1e-9);
            // the gap opens on both sides: the inner track shrinks, the outer grows
            assert_eq!(track.growth_m > 0.0, race.side == Side::Outer);
        }
    }

    #[test]
    fn eq_5_tends_to_the_thin_ring() {
        // p R^2/(E t): error of the order t/R
        let (r, t) = (50e-3, 5e-6);
        let race = Race::outer(r, r + t, 6e-3, STEEL).unwrap();
        let p = race.track_pressure_pa(CONTACTS, 1.0);
        close(race.compliance_m_per_n(CONTACTS), p * r * r / (206e9 * t), 2e-4);
        close(race.hoop_at_bore_pa(CONTACTS, 1.0), p * r / t, 2e-4);
    }

    #[test]
    fn a_solid_shaft_is_under_uniform_pressure() {
        let shaft = Race::inner(0.0, 11.11e-3, 6e-3, STEEL).unwrap();
        let p = shaft.track_pressure_pa(CONTACTS, 4500.0);
        // u = -p R (1 - nu)/E
        close(shaft.compliance_m_per_n(CONTACTS) * 4500.0, p * 11.11e-3 * 0.7 / 206e9, 1e-14);
        assert_eq!(shaft.hoop_at_bore_pa(CONTACTS, 4500.0), -p);
        assert_eq!(shaft.hoop_at_track_pa(CONTACTS, 4500.0), -p);
    }

    #[test]
    fn a_wider_race_is_stiffer_by_its_own_width() {
        let wide = Race::outer(19.44e-3, 26.23e-3, 12e-3, STEEL).unwrap();
        close(wide.compliance_m_per_n(CONTACTS), 0.5 * outer().compliance_m_per_n(CONTACTS), 1e-15);
    }

    /// (7) as printed, without the 1/4: kept to show that it is wrong.
    fn eq_7_as_printed(r_e: f64, r_ed: f64, speed_rad_s: f64) -> f64 {
        let nu = STEEL.poisson_ratio;
        r_e * (3.0 + nu) * STEEL.density_kg_m3 / STEEL.youngs_modulus_pa
            * speed_rad_s.powi(2)
            * (r_ed.powi(2) + r_e.powi(2) * (1.0 - nu) / (3.0 + nu))
    }

    #[test]
    fn eq_7_corrected_satisfies_rotating_equilibrium_and_the_print_does_not() {
        let speed = 20_000.0 * TAU / 60.0;
        let solved = Disc::new(19.44e-3, 26.23e-3, STEEL, speed);
        let (bore, _) = solved.rims(0.0, 0.0);
        close(outer().centrifugal_bore_growth_m(speed), bore.growth_m, 1e-9);
        close(outer().rotating_bore_hoop_pa(speed), bore.hoop_pa, 1e-9);
        close(eq_7_as_printed(19.44e-3, 26.23e-3, speed), 4.0 * bore.growth_m, 1e-9);
        let (_, outside) = Disc::new(7.21e-3, 11.11e-3, STEEL, speed).rims(0.0, 0.0);
        close(inner().centrifugal_outside_growth_m(speed), outside.growth_m, 1e-9);
        // 2.06 um for Table 1 at 20 000 rpm
        close(outer().centrifugal_bore_growth_m(speed), 2.06e-6, 3e-3);
    }

    #[test]
    fn eq_7_tends_to_the_thin_hoop() {
        // sigma = rho v^2
        let race = Race::outer(50e-3, 50e-3 + 1e-6, 6e-3, STEEL).unwrap();
        close(race.rotating_bore_hoop_pa(100.0), 7850.0 * 25.0, 1e-4);
    }

    #[test]
    fn a_rotating_shaft_has_no_bore_to_grow() {
        let shaft = Race::inner(0.0, 11.11e-3, 6e-3, STEEL).unwrap();
        assert_eq!(shaft.centrifugal_bore_growth_m(1000.0), 0.0);
        // half of what a pin hole would raise it to
        let pin = Race::inner(1e-9, 11.11e-3, 6e-3, STEEL).unwrap();
        close(2.0 * shaft.rotating_bore_hoop_pa(1000.0), pin.rotating_bore_hoop_pa(1000.0), 1e-12);
    }

    #[test]
    fn impossible_races_are_refused() {
        let radii = |e| matches!(e, Err(RaceError::RadiiOutOfOrder { .. }));
        assert!(radii(Race::inner(12e-3, 11e-3, 6e-3, STEEL)));
        assert!(radii(Race::inner(-1e-3, 11e-3, 6e-3, STEEL)));
        assert!(radii(Race::outer(0.0, 11e-3, 6e-3, STEEL)));
        assert!(radii(Race::outer(10e-3, f64::NAN, 6e-3, STEEL)));
        assert!(matches!(Race::outer(10e-3, 11e-3, 0.0, STEEL), Err(RaceError::WidthNotPositive { .. })));
    }
}
