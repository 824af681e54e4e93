//! Hertz's line contact, and what makes a contact impossible.

use std::f64::consts::PI;

/// Why a contact cannot be set up.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ContactError {
    /// A quantity that must be positive and finite is not.
    #[error("{name} = {value} is not positive and finite")]
    NotPositive {
        /// Name of the quantity with its unit.
        name: &'static str,
        /// Value given, in that unit.
        value: f64,
    },
    /// The convex radius is not smaller than the concave one: no line contact.
    #[error("convex radius {convex_m} m does not fit into concave radius {concave_m} m")]
    Conforming {
        /// Convex radius, m.
        convex_m: f64,
        /// Concave radius, m.
        concave_m: f64,
    },
    /// The number of slices lies outside 1..=[`crate::contact::SliceContact::MOST_SLICES`].
    #[error("{slices} slices: too few or too many")]
    Slices {
        /// Number given.
        slices: usize,
    },
    /// One gap per slice is needed, finite.
    #[error("{finite} finite gaps for {slices} slices")]
    Gap {
        /// Number of slices.
        slices: usize,
        /// Number of finite gaps given.
        finite: usize,
    },
    /// A profile that no body can have.
    #[error("point {at}: {what} ({value})")]
    Profile {
        /// What is wrong.
        what: &'static str,
        /// The number that is, m or pure.
        value: f64,
        /// Index of the point of a table, else 0.
        at: usize,
    },
    /// Tilt not finite or too large for small displacements.
    #[error("tilt {tilt_rad} rad is not a small angle")]
    Tilt {
        /// Tilt given, rad.
        tilt_rad: f64,
    },
    /// The contact is not as long as the overlap of the bodies.
    #[error("contact of {contact_m} m on bodies that overlap by {overlap_m} m")]
    Length {
        /// Length of the contact, m.
        contact_m: f64,
        /// Overlap, m.
        overlap_m: f64,
    },
    /// A half-space grid without cells, with an odd number of cells across, or too large.
    #[error("half-space grid of {across} x {along} cells: odd across, empty or too large")]
    Grid {
        /// Cells across the contact.
        across: usize,
        /// Cells along it.
        along: usize,
    },
}

/// `value` if positive and finite.
pub(super) fn positive(name: &'static str, value: f64) -> Result<f64, ContactError> {
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err(ContactError::NotPositive { name, value }) }
}

/// Two parallel cylinders touching along a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineContact {
    /// Effective radius R, m: 1/R = 1/R_a + 1/R_b (convex on convex), 1/r_a - 1/R_b (convex in concave).
    pub effective_radius_m: f64,
    /// Length l of the contact, m.
    pub length_m: f64,
    /// Contact modulus E*, Pa: 1/E* = (1-nu1^2)/E1 + (1-nu2^2)/E2.
    pub contact_modulus_pa: f64,
}

impl LineContact {
    /// Convex on convex: 1/R = 1/R_a + 1/R_b. Lengths in m, modulus in Pa, all positive.
    pub fn external(
        radius_a_m: f64,
        radius_b_m: f64,
        length_m: f64,
        contact_modulus_pa: f64,
    ) -> Result<Self, ContactError> {
        let a = positive("radius_a_m", radius_a_m)?;
        let b = positive("radius_b_m", radius_b_m)?;
        Self::of_curvature(1.0 / a + 1.0 / b, length_m, contact_modulus_pa)
    }

    /// Convex in concave: 1/R = 1/r - 1/R, convex radius r below concave radius R. Units as above.
    pub fn internal(
        convex_radius_m: f64,
        concave_radius_m: f64,
        length_m: f64,
        contact_modulus_pa: f64,
    ) -> Result<Self, ContactError> {
        let convex_m = positive("convex_radius_m", convex_radius_m)?;
        let concave_m = positive("concave_radius_m", concave_radius_m)?;
        if convex_m >= concave_m {
            return Err(ContactError::Conforming { convex_m, concave_m });
        }
        Self::of_curvature(1.0 / convex_m - 1.0 / concave_m, length_m, contact_modulus_pa)
    }

    fn of_curvature(per_m: f64, length_m: f64, contact_modulus_pa: f64) -> Result<Self, ContactError> {
        Ok(Self {
            effective_radius_m: positive("effective_radius_m", 1.0 / per_m)?,
            length_m: positive("length_m", length_m)?,
            contact_modulus_pa: positive("contact_modulus_pa", contact_modulus_pa)?,
        })
    }

    /// Peak pressure of the infinitely long contact, Pa: p_0 = sqrt(q E*/(pi R)), q = N/l
    /// (Johnson, *Contact Mechanics*, (4.45)). `normal_n` >= 0; below it counts as 0.
    pub fn peak_pressure_pa(&self, normal_n: f64) -> f64 {
        let q = normal_n.max(0.0) / self.length_m;
        (q * self.contact_modulus_pa / (PI * self.effective_radius_m)).sqrt()
    }

    /// Half width of the contact, m: a = sqrt(4 q R/(pi E*)), q = N/l (Johnson (4.43)). `normal_n` as above.
    pub fn half_width_m(&self, normal_n: f64) -> f64 {
        let q = normal_n.max(0.0) / self.length_m;
        (4.0 * q * self.effective_radius_m / (PI * self.contact_modulus_pa)).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    // E = 206 GPa, nu = 0.3 on both sides
    const E_STAR: f64 = 206e9 / (2.0 * 0.91);

    #[test]
    fn the_reference_contacts_have_their_radius_width_and_pressure() {
        // tests/reference/half_space_line_contact.csv, rows at 1558 N and (outer) 8384 N, as printed
        let inner = LineContact::external(11.11e-3, 4.02e-3, 6e-3, E_STAR).unwrap();
        assert!((inner.effective_radius_m - 2.9519e-3).abs() < 5e-8);
        assert!((inner.half_width_m(1558.0) - 0.0929e-3).abs() < 5e-8);
        assert!((inner.peak_pressure_pa(1558.0) - 1780e6).abs() < 5e5);
        let outer = LineContact::internal(4.68e-3, 19.44e-3, 6e-3, E_STAR).unwrap();
        assert!((outer.effective_radius_m - 6.1639e-3).abs() < 5e-8);
        assert!((outer.half_width_m(8384.0) - 0.3113e-3).abs() < 5e-8);
        assert!((outer.peak_pressure_pa(8384.0) - 2858e6).abs() < 5e5);
    }

    #[test]
    fn the_semi_ellipse_carries_the_load() {
        let contact = LineContact::external(11.11e-3, 4.02e-3, 6e-3, E_STAR).unwrap();
        let n = 1234.5;
        let carried = 0.5 * PI * contact.half_width_m(n) * contact.peak_pressure_pa(n) * contact.length_m;
        assert!((carried / n - 1.0).abs() < 1e-14);
        assert_eq!(contact.half_width_m(-1.0), 0.0);
        assert_eq!(contact.peak_pressure_pa(-1.0), 0.0);
    }

    #[test]
    fn impossible_contacts_are_refused() {
        let conforming = LineContact::internal(19.44e-3, 19.44e-3, 6e-3, E_STAR);
        assert!(matches!(conforming, Err(ContactError::Conforming { .. })));
        let without = |e, wanted| matches!(e, Err(ContactError::NotPositive { name, .. }) if name == wanted);
        assert!(without(LineContact::external(0.0, 4e-3, 6e-3, E_STAR), "radius_a_m"));
        assert!(without(LineContact::external(4e-3, f64::NAN, 6e-3, E_STAR), "radius_b_m"));
        assert!(without(LineContact::external(4e-3, 4e-3, -6e-3, E_STAR), "length_m"));
        assert!(without(LineContact::internal(4e-3, 5e-3, 6e-3, f64::INFINITY), "contact_modulus_pa"));
    }
}
