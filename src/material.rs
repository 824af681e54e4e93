//! Linear elastic, isotropic material.
//!
//! In: nothing, or a name. Out: [`Material`], SI, and [`STEELS`] with what their makers allow. Absent: what a stress is
//! compared with (limits belong to `margin`; a design says whether it takes them from here).
//! Equations: the contact modulus E* used by (1)-(4) and by Hertz.

/// Elastic constants and density, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// Young's modulus E, Pa.
    pub youngs_modulus_pa: f64,
    /// Poisson's ratio nu, pure number in (0, 0.5).
    pub poisson_ratio: f64,
    /// Density rho, kg/m^3.
    pub density_kg_m3: f64,
}

impl Material {
    /// Plane-strain compliance (1 - nu^2)/E of one body, 1/Pa (Johnson, *Contact Mechanics*, (4.4)).
    pub fn plane_strain_compliance(&self) -> f64 {
        (1.0 - self.poisson_ratio * self.poisson_ratio) / self.youngs_modulus_pa
    }

    /// Shear modulus G = E/(2(1 + nu)), Pa.
    pub fn shear_modulus_pa(&self) -> f64 {
        0.5 * self.youngs_modulus_pa / (1.0 + self.poisson_ratio)
    }
}

/// A named steel: elastic constants, thermal expansion and the stresses that a maker of clutches allows it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Steel {
    /// Name, as in the standard.
    pub name: &'static str,
    /// Further names under which it is found.
    pub also: &'static [&'static str],
    /// Elastic constants, density.
    pub material: Material,
    /// Linear thermal expansion between 20 and 100 C, 1/K.
    pub expansion_per_k: f64,
    /// Allowed equivalent stress of a race, Pa.
    pub race_stress_pa: f64,
    /// Allowed Hertz pressure at nominal torque, hardened, Pa.
    pub hertz_nominal_pa: f64,
    /// The same at the maximum torque.
    pub hertz_peak_pa: f64,
    /// Where the figures come from.
    pub source: &'static str,
}

/// Ordinary steel: E, nu and expansion by EN 1993-1-1, 3.2.6; density by EN 1991-1-1, table A.4 (77 to 78.5 kN/m^3).
const STEEL: Material = Material { youngs_modulus_pa: 210e9, poisson_ratio: 0.3, density_kg_m3: 7850.0 };

/// The library. Hertz pressures and race stresses are those of GMN 9050 (sprag clutches), which allows all hardened
/// steels the same pressure.
pub const STEELS: [Steel; 4] = [
    Steel {
        name: "100Cr6",
        also: &["1.3505", "AISI 52100", "52100", "SUJ2"],
        material: STEEL,
        expansion_per_k: 11.4e-6,
        race_stress_pa: 750e6,
        hertz_nominal_pa: 4200e6,
        hertz_peak_pa: 4600e6,
        source: "grade EN ISO 683-17; E, nu, expansion 20-100 C: Lucefin technical card 100Cr6; density EN 1991-1-1; stresses GMN 9050",
    },
    Steel {
        name: "16MnCr5",
        also: &["1.7131", "AISI 5115"],
        material: STEEL,
        expansion_per_k: 12e-6,
        race_stress_pa: 400e6,
        hertz_nominal_pa: 4200e6,
        hertz_peak_pa: 4600e6,
        source: "grade EN ISO 683-3; E, nu, expansion of steel EN 1993-1-1; \
                 density EN 1991-1-1; stresses GMN 9050",
    },
    Steel {
        name: "20MnCr5",
        also: &["1.7147", "AISI 5120"],
        material: STEEL,
        expansion_per_k: 12e-6,
        race_stress_pa: 600e6,
        hertz_nominal_pa: 4200e6,
        hertz_peak_pa: 4600e6,
        source: "grade EN ISO 683-3; E, nu, expansion of steel EN 1993-1-1; \
                 density EN 1991-1-1; stresses GMN 9050",
    },
    Steel {
        name: "34CrMo4V",
        also: &["34CrMo4", "34CrMo4+QT", "1.7220", "AISI 4135"],
        material: STEEL,
        expansion_per_k: 12e-6,
        race_stress_pa: 400e6,
        hertz_nominal_pa: 4200e6,
        hertz_peak_pa: 4600e6,
        source: "grade EN ISO 683-2 (DIN EN 10083-3), quenched and tempered; E, nu, expansion of steel EN 1993-1-1; \
                 density EN 1991-1-1; stresses GMN 9050, tracks hardened",
    },
];

/// The steel of that name or number; letter case, blanks and hyphens do not matter.
pub fn steel(name: &str) -> Option<&'static Steel> {
    let plain = |text: &str| {
        text.chars().filter(|c| !c.is_whitespace() && *c != '-').collect::<String>().to_lowercase()
    };
    let wanted = plain(name);
    STEELS.iter().find(|s| std::iter::once(&s.name).chain(s.also).any(|n| plain(n) == wanted))
}

/// Plane strain (no extension along the axis) or plane stress (no axial stress).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlaneState {
    /// epsilon_z = 0.
    Strain,
    /// sigma_z = 0.
    Stress,
}

impl PlaneState {
    /// Kolosov's constant: 3 - 4 nu, or (3 - nu)/(1 + nu) (Barber, *Elasticity*, (3.18)).
    pub fn kolosov(self, poisson: f64) -> f64 {
        match self {
            Self::Strain => 3.0 - 4.0 * poisson,
            Self::Stress => (3.0 - poisson) / (1.0 + poisson),
        }
    }

    /// 2 mu times the half-plane's displacement under unit pressure of unit wave number, (kappa + 1)/2: this is
    /// 2 mu . 2(1-nu^2)/E in plane strain, 2 mu . 2/E in plane stress.
    pub fn half_plane_ratio(self, poisson: f64) -> f64 {
        0.5 * (self.kolosov(poisson) + 1.0)
    }

    /// Strain across over strain along under axial load: nu/(1-nu), or nu.
    pub fn transverse_ratio(self, poisson: f64) -> f64 {
        match self {
            Self::Strain => poisson / (1.0 - poisson),
            Self::Stress => poisson,
        }
    }

    /// Compliance of one body in this state, 1/Pa: (1-nu^2)/E, or 1/E.
    pub fn compliance(self, material: &Material) -> f64 {
        match self {
            Self::Strain => material.plane_strain_compliance(),
            Self::Stress => 1.0 / material.youngs_modulus_pa,
        }
    }

    /// Contact modulus E* of two bodies in this state, Pa: 1/E* is the sum of their compliances; in plane strain
    /// (1-nu1^2)/E1 + (1-nu2^2)/E2 (Johnson (4.4)).
    pub fn contact_modulus_pa(self, a: &Material, b: &Material) -> f64 {
        1.0 / (self.compliance(a) + self.compliance(b))
    }

    /// Dundurs' beta of two bodies in this state, positive where `a` is the softer: what of pressure pulls along the surface
    /// (Johnson (5.3), with (1-2nu)(1+nu)/E the body's compliance times 1 - nu/(1-nu)). 0 for like bodies.
    pub fn dundurs_beta(self, a: &Material, b: &Material) -> f64 {
        let along = |m: &Material| self.compliance(m) * (1.0 - self.transverse_ratio(m.poisson_ratio));
        0.5 * self.contact_modulus_pa(a, b) * (along(a) - along(b))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against a rigid body beta is (1 - 2 nu)/(2 (1 - nu)) (Johnson, 5.1).
    #[test]
    fn beta_is_that_of_a_body_on_a_rigid_one() {
        let of = |e: f64, nu: f64| Material { youngs_modulus_pa: e, poisson_ratio: nu, density_kg_m3: 1.0 };
        let (soft, rigid) = (of(1e9, 0.3), of(1e21, 0.3));
        assert!((PlaneState::Strain.dundurs_beta(&soft, &rigid) - 0.4 / 1.4).abs() < 1e-10);
        let [ab, ba] = [(soft, rigid), (rigid, soft)].map(|(a, b)| PlaneState::Stress.dundurs_beta(&a, &b));
        assert!(ab == -ba && (ab - 0.35).abs() < 1e-10, "{ab}");
        assert_eq!(PlaneState::Strain.dundurs_beta(&soft, &soft), 0.0);
    }

    #[test]
    fn a_steel_answers_to_all_its_names_and_no_two_share_one() {
        for found in ["100Cr6", "100 CR-6", "aisi 52100", "1.3505"].map(steel) {
            assert_eq!(found.map(|s| s.name), Some("100Cr6"));
        }
        assert_eq!(steel("100Cr7"), None);
        for (i, s) in STEELS.iter().enumerate() {
            for name in std::iter::once(&s.name).chain(s.also) {
                assert_eq!(steel(name), Some(&STEELS[i]), "{name}");
            }
            assert!(s.hertz_nominal_pa < s.hertz_peak_pa && s.source.contains("EN "), "{s:?}");
        }
    }

    #[test]
    fn equal_bodies_have_half_the_modulus_of_one() {
        let steel = Material { youngs_modulus_pa: 206e9, poisson_ratio: 0.3, density_kg_m3: 7850.0 };
        let e_star = |state: PlaneState| state.contact_modulus_pa(&steel, &steel);
        assert!((e_star(PlaneState::Strain) - 206e9 / (2.0 * 0.91)).abs() < 1.0);
        assert!((e_star(PlaneState::Stress) - 103e9).abs() < 1.0);
    }
}
