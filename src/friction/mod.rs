//! Friction coefficient of a dry or boundary-lubricated contact, and of one on a film of oil.
//!
//! In: sliding speed, coefficients of a design. Out: coefficient and its slope. Absent: forces, directions, memory, any notion of
//! sticking (the room that holds the state decides that). Equations: (12), the film's of `lubrication`.

mod film;

pub use film::{FilmFriction, FilmState};

use crate::clutch::Friction;

/// Exponentially decaying friction law.
///
/// # Conventions
/// The sign of the speed does not matter, only |v| enters; the coefficient is never negative for
/// coefficients that are not. The direction of the force belongs to the caller.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stribeck {
    /// mu_s, coefficient at v -> 0, pure number.
    pub static_: f64,
    /// mu_c, coefficient at large speed, pure number, at most mu_s.
    pub kinetic: f64,
    /// gamma_b, decay per speed, s/m, not negative.
    pub decay_s_per_m: f64,
}

impl Stribeck {
    /// The law of a design's coefficients.
    pub fn of(f: &Friction) -> Self {
        Self { static_: f.static_, kinetic: f.kinetic, decay_s_per_m: f.decay_s_per_m }
    }

    /// Eq. (12): mu(v) = mu_c + (mu_s - mu_c) e^(-gamma_b |v|), pure number.
    ///
    /// Valid down to v = 0 included, where it is mu_s: the largest coefficient a stick can demand.
    #[doc(alias = "Eq. (12)")]
    pub fn coefficient(&self, speed_abs_m_s: f64) -> f64 {
        self.kinetic + (self.static_ - self.kinetic) * (-self.decay_s_per_m * speed_abs_m_s.abs()).exp()
    }

    /// d mu / d|v| of (12), s/m; not positive for mu_c <= mu_s. At v = 0 the one-sided slope.
    pub fn slope_s_per_m(&self, speed_abs_m_s: f64) -> f64 {
        -self.decay_s_per_m
            * (self.static_ - self.kinetic)
            * (-self.decay_s_per_m * speed_abs_m_s.abs()).exp()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    // mu_s inside the paper's range 0.04-0.12, the others assumed.
    const LAW: Stribeck = Stribeck { static_: 0.12, kinetic: 0.09, decay_s_per_m: 5.0 };

    #[test]
    fn eq_12_has_its_two_limits_and_its_decay_length() {
        assert_eq!(LAW.coefficient(0.0), 0.12);
        assert_eq!(LAW.coefficient(1e6), 0.09);
        // after one decay speed 1/gamma_b, 1/e of the excess is left
        assert!((LAW.coefficient(0.2) - (0.09 + 0.03 / std::f64::consts::E)).abs() < 1e-16);
        assert_eq!(LAW.coefficient(-0.2), LAW.coefficient(0.2));
    }

    #[test]
    fn eq_12_solves_its_differential_equation() {
        // dmu/d|v| = -gamma_b (mu - mu_c), and the slope is the derivative of the coefficient
        for v in [0.0, 0.01, 0.2, 1.0, 3.0] {
            let slope = LAW.slope_s_per_m(v);
            assert!((slope + 5.0 * (LAW.coefficient(v) - 0.09)).abs() < 1e-15);
            let h = 1e-5;
            let numeric = (LAW.coefficient(v + h) - LAW.coefficient((v - h).max(0.0))) / (h + v.min(h));
            assert!((slope - numeric).abs() < 5e-6, "{v}: {slope} {numeric}");
        }
    }

    #[test]
    fn equal_coefficients_or_no_decay_are_coulomb() {
        let coulomb = Stribeck { kinetic: 0.12, ..LAW };
        let frozen = Stribeck { decay_s_per_m: 0.0, ..LAW };
        for v in [0.0, 0.3, 1e3] {
            assert_eq!((coulomb.coefficient(v), coulomb.slope_s_per_m(v)), (0.12, 0.0));
            assert_eq!((frozen.coefficient(v), frozen.slope_s_per_m(v)), (0.12, 0.0));
        }
    }
}
