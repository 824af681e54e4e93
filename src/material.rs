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

/// Contact modulus E* of two bodies, Pa: 1/E* = (1-nu1^2)/E1 + (1-nu2^2)/E2 (Johnson (4.4)).
pub fn contact_modulus_pa(a: &Material, b: &Material) -> f64 {
    1.0 / (a.plane_strain_compliance() + b.plane_strain_compliance())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_bodies_have_half_the_plane_strain_modulus() {
        let steel = Material { youngs_modulus_pa: 206e9, poisson_ratio: 0.3, density_kg_m3: 7850.0 };
        let e_star = contact_modulus_pa(&steel, &steel);
        assert!((e_star - 206e9 / (2.0 * 0.91)).abs() < 1.0);
    }
}
