//! Linear elastic, isotropic material.
//!
//! In: nothing. Out: [`Material`], SI. Absent: strength and case depth (limits belong to `margin`).
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
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_bodies_have_half_the_modulus_of_one() {
        let steel = Material { youngs_modulus_pa: 206e9, poisson_ratio: 0.3, density_kg_m3: 7850.0 };
        let e_star = |state: PlaneState| state.contact_modulus_pa(&steel, &steel);
        assert!((e_star(PlaneState::Strain) - 206e9 / (2.0 * 0.91)).abs() < 1.0);
        assert!((e_star(PlaneState::Stress) - 103e9).abs() < 1.0);
    }
}
