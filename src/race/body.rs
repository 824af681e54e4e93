//! Bulk compression of the body between the races.

/// Eq. (6): delta_g / N = (R_e - R_i)/(b l E), m/N, of a block of height R_e - R_i and section b l.
///
/// A width b of 0 (or less) means that the body's compression is left out: returns 0. It should be left
/// out beside a contact law that already holds the bulk compression.
#[doc(alias = "Eq. (6)")]
pub fn body_compliance_m_per_n(
    inner_radius_m: f64,
    outer_radius_m: f64,
    width_m: f64,
    length_m: f64,
    youngs_modulus_pa: f64,
) -> f64 {
    if width_m > 0.0 {
        (outer_radius_m - inner_radius_m) / (width_m * length_m * youngs_modulus_pa)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eq_6_is_hookes_law_of_a_bar() {
        // a bar of 10 mm x 10 mm x 100 mm of E = 200 GPa: 2e8 N/m
        let compliance = body_compliance_m_per_n(0.0, 0.1, 0.01, 0.01, 200e9);
        assert!((compliance * 2e8 - 1.0).abs() < 1e-14);
    }

    #[test]
    fn eq_6_returns_the_6_um_of_the_public_model() {
        // b = 5.05 mm was found from the public model's 6 um at 4500 N
        let delta_m = 4500.0 * body_compliance_m_per_n(11.11e-3, 19.44e-3, 5.05e-3, 6e-3, 206e9);
        assert!((delta_m - 6e-6).abs() < 0.01e-6, "{delta_m}");
    }

    #[test]
    fn no_width_means_no_compression() {
        assert_eq!(body_compliance_m_per_n(11.11e-3, 19.44e-3, 0.0, 6e-3, 206e9), 0.0);
    }
}
