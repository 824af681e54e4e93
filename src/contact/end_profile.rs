//! Shapes of a body's flank along its length: how far it stays back from a straight line.

use super::line::{ContactError, LineContact, positive};
use std::f64::consts::PI;

/// Drop of a flank below its straight generatrix.
///
/// # Conventions
/// y is measured from the middle of the body, b is half the body's length; drops are not negative, m, and
/// symmetric about y = 0 except for [`Self::Table`]. Drops of two bodies in contact add up.
#[derive(Debug, Clone, PartialEq)]
pub enum EndDrop {
    /// Straight to a sharp end: the pressure there has no limit where the other body goes on.
    Square,
    /// z = A ln 1/(1 - (y/b)^2).
    ///
    /// Lundberg (1939) as in Johnson, *Contact Mechanics*, section 5.3, A = N/(pi E* l): an elliptical
    /// pressure of Hertz's half width a, uniform over the length l = 2b, makes just this displacement more
    /// than some a from the ends. At the very end the logarithm has no limit; it keeps its value 5e-10 b
    /// before it, where no body touches. Johnson's finite end value A (1.193 + ln(l/2a)) is not used: cut off
    /// there the end is flat over a/7 and sharp again (1.8 p_0 on cells of 6 um against 1.13 p_0).
    Lundberg {
        /// A, m.
        amplitude_m: f64,
    },
    /// Arc of a circle over the whole length: z = R - sqrt(R^2 - y^2).
    CrownRadius {
        /// R, m; at least half the body's length.
        radius_m: f64,
    },
    /// Straight but for an arc of a circle at each end, tangent to the straight part.
    EndRelief {
        /// Length of the relieved part at each end, m.
        length_m: f64,
        /// Radius of the arc, m; at least `length_m`.
        radius_m: f64,
    },
    /// z = A ln 1/[1 - (1 - exp(-z_m/A)) t^2], t = (|y| - b)/(K_2 b) + 1 where positive, A = K_1 N/(pi E* l).
    ///
    /// Fujiwara & Kawase, *Logarithmic profiles of rollers in roller bearings and optimization of the
    /// profiles* (JSME C 72, 2006), their 2 K_1 Q/(pi L E') with E' = 2 E*. K_1 = K_2 = 1 and z_m = infinity is
    /// Lundberg's logarithm.
    FujiwaraKawase {
        /// A, m.
        amplitude_m: f64,
        /// K_2: crowned part of half the length, 0 < K_2 <= 1.
        crowned_ratio: f64,
        /// z_m: drop at the very end, m.
        end_drop_m: f64,
    },
    /// Straight lines between points given.
    Table(ProfileTable),
}

/// Points of a measured profile, checked: y rising, drops not negative, all finite.
#[derive(Debug, Clone, PartialEq)]
pub struct ProfileTable {
    points_m: Vec<[f64; 2]>,
}

impl EndDrop {
    /// Lundberg's profile of a body as long as `contact` for its design load, N.
    pub fn lundberg(contact: &LineContact, design_load_n: f64) -> Result<Self, ContactError> {
        let amplitude_m = logarithmic_amplitude_m(contact, design_load_n)?;
        Ok(Self::Lundberg { amplitude_m })
    }

    /// A crown of radius R, m, for a body of `length_m`.
    pub fn crown_radius(radius_m: f64, length_m: f64) -> Result<Self, ContactError> {
        let length_m = positive("length_m", length_m)?;
        if positive("radius_m", radius_m)? < 0.5 * length_m {
            return Err(ContactError::Profile {
                what: "crown radius below half the length",
                value: radius_m,
                at: 0,
            });
        }
        Ok(Self::CrownRadius { radius_m })
    }

    /// Arcs of `radius_m` over the last `length_m` of each end.
    pub fn end_relief(length_m: f64, radius_m: f64) -> Result<Self, ContactError> {
        positive("length_m", length_m)?;
        if positive("radius_m", radius_m)? < length_m {
            return Err(ContactError::Profile {
                what: "relief radius below the relieved length",
                value: radius_m,
                at: 0,
            });
        }
        Ok(Self::EndRelief { length_m, radius_m })
    }

    /// Fujiwara and Kawase's profile of a body as long as `contact`: K_1 multiplies the design load, N, K_2 is
    /// the crowned part of half the length, z_m the drop at the very end, m.
    pub fn fujiwara_kawase(
        contact: &LineContact,
        design_load_n: f64,
        load_factor: f64,
        crowned_ratio: f64,
        end_drop_m: f64,
    ) -> Result<Self, ContactError> {
        let amplitude_m = positive("K_1", load_factor)? * logarithmic_amplitude_m(contact, design_load_n)?;
        positive("z_m", end_drop_m)?;
        if positive("K_2", crowned_ratio)? > 1.0 {
            return Err(ContactError::Profile { what: "K_2 above 1", value: crowned_ratio, at: 0 });
        }
        Ok(Self::FujiwaraKawase { amplitude_m, crowned_ratio, end_drop_m })
    }

    /// Points (y, drop), m, at least two, y strictly rising. The error names the point.
    pub fn table(points_m: Vec<[f64; 2]>) -> Result<Self, ContactError> {
        let wrong = |what, value, at| Err(ContactError::Profile { what, value, at });
        if points_m.len() < 2 {
            return wrong("profile of fewer than two points", points_m.len() as f64, 0);
        }
        for (at, [y, drop]) in points_m.iter().copied().enumerate() {
            if !y.is_finite() {
                return wrong("profile position not finite", y, at);
            }
            if !drop.is_finite() {
                return wrong("profile drop not finite", drop, at);
            }
            if drop < 0.0 {
                return wrong("profile drop negative", drop, at);
            }
            if at > 0 && y <= points_m[at - 1][0] {
                return wrong("profile positions do not rise", y, at);
            }
        }
        Ok(Self::Table(ProfileTable { points_m }))
    }

    /// Drop at y, m, of a body of `length_m`; beyond a table's points their end values hold.
    pub fn drop_m(&self, y_m: f64, length_m: f64) -> f64 {
        let b = 0.5 * length_m;
        let y = y_m.abs();
        match self {
            Self::Square => 0.0,
            Self::Lundberg { amplitude_m } => -amplitude_m * ((1.0 - y / b) * (1.0 + y / b)).max(1e-9).ln(),
            Self::CrownRadius { radius_m } => arc_drop(y, *radius_m),
            Self::EndRelief { length_m, radius_m } => arc_drop((y - (b - length_m)).max(0.0), *radius_m),
            Self::FujiwaraKawase { amplitude_m, crowned_ratio, end_drop_m } => {
                let t = ((y - b) / (crowned_ratio * b) + 1.0).clamp(0.0, 1.0);
                let lost = -(-end_drop_m / amplitude_m).exp_m1();
                // ln(1 - lost t^2) at t = 1 is -z_m/A, whatever the rounding of lost
                (-amplitude_m * (-lost * t * t).ln_1p()).min(*end_drop_m)
            }
            Self::Table(table) => table.drop_m(y_m),
        }
    }

    /// Whether the profile is known over y from `low_m` to `high_m`, m.
    pub(super) fn covers(&self, low_m: f64, high_m: f64) -> bool {
        match self {
            Self::Table(ProfileTable { points_m }) => {
                let slack = 1e-9 * (high_m - low_m).abs();
                points_m.first().is_some_and(|p| p[0] <= low_m + slack)
                    && points_m.last().is_some_and(|p| p[0] >= high_m - slack)
            }
            // the arc must not turn back
            Self::CrownRadius { radius_m } => low_m.abs().max(high_m.abs()) <= *radius_m * (1.0 + 1e-12),
            _ => true,
        }
    }
}

impl ProfileTable {
    fn drop_m(&self, y_m: f64) -> f64 {
        let after = self.points_m.partition_point(|p| p[0] <= y_m);
        let point = |i: usize| self.points_m.get(i).copied();
        match (after.checked_sub(1).and_then(point), point(after)) {
            (Some([y0, z0]), Some([y1, z1])) => z0 + (z1 - z0) * (y_m - y0) / (y1 - y0),
            (Some([_, z]), None) | (None, Some([_, z])) => z,
            (None, None) => 0.0,
        }
    }
}

/// R - sqrt(R^2 - t^2) without cancellation; R beyond t = R.
fn arc_drop(t: f64, radius: f64) -> f64 {
    let t = t.min(radius);
    t * t / (radius + ((radius - t) * (radius + t)).sqrt())
}

/// N/(pi E* l), m.
fn logarithmic_amplitude_m(contact: &LineContact, design_load_n: f64) -> Result<f64, ContactError> {
    let n = positive("design_load_n", design_load_n)?;
    positive("profile amplitude", n / (PI * contact.contact_modulus_pa * contact.length_m))
}

#[cfg(test)]
mod tests {
    use super::*;

    const LENGTH: f64 = 6e-3;

    fn contact() -> LineContact {
        LineContact::external(11.11e-3, 4.02e-3, LENGTH, 206e9 / 1.82).unwrap()
    }

    #[test]
    fn lundbergs_profile_is_what_a_uniform_elliptical_strip_sinks() {
        // mean of asinh((b-y)/|x|) + asinh((b+y)/|x|) over the semi-ellipse, by x = a sin t
        let c = contact();
        let n = 2441.0;
        let a = c.half_width_m(n);
        let sink = |y: f64| {
            let steps = 4000;
            let sum: f64 = (0..steps)
                .map(|i| {
                    let s = (i as f64 + 0.5) / steps as f64;
                    // t = s^3 pi/2 takes away the logarithm at x = 0
                    let t = s.powi(3) * PI / 2.0;
                    let x = a * t.sin();
                    let weight = t.cos().powi(2) * 1.5 * PI * s * s / steps as f64;
                    weight * (((3e-3 - y) / x).asinh() + ((3e-3 + y) / x).asinh())
                })
                .sum();
            sum / (PI / 4.0) * n / LENGTH / (PI * c.contact_modulus_pa)
        };
        let profile = EndDrop::lundberg(&c, n).unwrap();
        let unit = sink(0.0) - sink(3e-3);
        for (y, bound) in [(0.5e-3, 1e-3), (1.5e-3, 1e-3), (2.4e-3, 1e-3), (2.8e-3, 5e-3)] {
            let (found, wanted) = (profile.drop_m(y, LENGTH), sink(0.0) - sink(y));
            println!("{y}: {found:e} {wanted:e}");
            assert!((found - wanted).abs() < bound * unit, "{y}: {found} {wanted}");
        }
    }

    #[test]
    fn fujiwara_and_kawase_tend_to_lundberg_and_end_at_their_drop() {
        let c = contact();
        let log = EndDrop::lundberg(&c, 1000.0).unwrap();
        let general = EndDrop::fujiwara_kawase(&c, 1000.0, 1.0, 1.0, 1.0).unwrap();
        for y in [0.0, 1e-3, -2e-3, 2.9e-3] {
            let (a, b) = (log.drop_m(y, LENGTH), general.drop_m(y, LENGTH));
            assert!((a - b).abs() < 1e-12 * a + 1e-24, "{y}: {a} {b}");
        }
        let short = EndDrop::fujiwara_kawase(&c, 1000.0, 1.5, 0.4, 9e-6).unwrap();
        assert_eq!(short.drop_m(1.79e-3, LENGTH), 0.0);
        assert!(short.drop_m(1.9e-3, LENGTH) > 0.0);
        assert!((short.drop_m(-3e-3, LENGTH) / 9e-6 - 1.0).abs() < 1e-12);
    }

    #[test]
    fn arcs_and_tables_drop_as_drawn() {
        let crown = EndDrop::crown_radius(2.0, LENGTH).unwrap();
        assert!((crown.drop_m(3e-3, LENGTH) / (9e-6 / 4.0) - 1.0).abs() < 1e-6);
        let relief = EndDrop::end_relief(0.5e-3, 10e-3).unwrap();
        assert_eq!(relief.drop_m(2.5e-3, LENGTH), 0.0);
        let wanted = 10e-3 - (100e-6f64 - 0.25e-6).sqrt();
        assert!((relief.drop_m(-3e-3, LENGTH) / wanted - 1.0).abs() < 1e-10);
        let table = EndDrop::table(vec![[-3e-3, 4e-6], [0.0, 0.0], [3e-3, 1e-6]]).unwrap();
        assert!((table.drop_m(-1.5e-3, LENGTH) - 2e-6).abs() < 1e-18);
        assert_eq!(table.drop_m(9e-3, LENGTH), 1e-6);
    }

    #[test]
    fn impossible_profiles_are_refused_at_their_place() {
        let at = |profile: Result<EndDrop, ContactError>, place: usize| matches!(profile, Err(ContactError::Profile { at, .. }) if at == place);
        assert!(at(EndDrop::table(vec![[0.0, 0.0], [1e-3, -1e-9]]), 1));
        assert!(at(EndDrop::table(vec![[0.0, 0.0], [1e-3, f64::NAN]]), 1));
        assert!(at(EndDrop::table(vec![[f64::INFINITY, 0.0], [1e-3, 0.0]]), 0));
        assert!(at(EndDrop::table(vec![[0.0, 0.0], [2e-3, 0.0], [1e-3, 0.0]]), 2));
        assert!(at(EndDrop::table(vec![[0.0, 0.0], [0.0, 0.0]]), 1));
        assert!(at(EndDrop::table(vec![[0.0, 0.0]]), 0));
        assert!(EndDrop::crown_radius(2e-3, LENGTH).is_err());
        assert!(EndDrop::end_relief(1e-3, 0.5e-3).is_err());
        assert!(EndDrop::end_relief(f64::NAN, 0.5e-3).is_err());
        assert!(EndDrop::fujiwara_kawase(&contact(), 1e3, 1.0, 1.1, 1e-6).is_err());
        for load in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(EndDrop::lundberg(&contact(), load).is_err());
        }
    }
}
