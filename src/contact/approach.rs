//! Approach laws: how far two bodies come together at a line contact under a normal force.

use std::f64::consts::PI;
use std::sync::Arc;

use super::line::{ContactError, LineContact, positive};
use super::slice_ratio::SliceRatio;
use crate::material::Material;

/// K of the roller law in DIN 26281, mm and N.
pub const DIN26281_COEFFICIENT: f64 = 3.97e-5;

/// A local contact law, built once for a contact and evaluated without allocation.
///
/// # Conventions
/// The normal force is compression, positive, N. The approach is the whole approach of the two bodies,
/// positive, m. Zero, negative or NaN force: approach 0, compliance +infinity (all laws here start
/// with a vertical tangent in force: delta'(N -> 0) -> infinity).
#[derive(Debug, Clone, PartialEq)]
pub enum Approach {
    /// delta = K N^0.9/l^0.8; does not know the radii.
    Roller(RollerLaw),
    /// Hertz's logarithmic law between two depths; knows the radii.
    Hertz(HertzLaw),
    /// The slice method for square ends without tilt, on the mean compliance of the roller law.
    Slice(SliceLaw),
}

impl Approach {
    /// The roller law with coefficient K in mm and N.
    pub fn roller(contact: &LineContact, coefficient: f64) -> Result<Self, ContactError> {
        RollerLaw::new(contact, coefficient).map(Self::Roller)
    }

    /// The roller law with the coefficient of DIN 26281.
    pub fn din26281(contact: &LineContact) -> Result<Self, ContactError> {
        Self::roller(contact, DIN26281_COEFFICIENT)
    }

    /// Hertz's logarithmic law for the two bodies of the contact.
    pub fn hertz(contact: &LineContact, bodies: [HertzBody; 2]) -> Result<Self, ContactError> {
        HertzLaw::new(contact, bodies).map(Self::Hertz)
    }

    /// The slice method; `coefficient` is the roller law's K in mm and N. One `ratio` serves many contacts.
    pub fn slice(
        contact: &LineContact,
        coefficient: f64,
        ratio: Arc<SliceRatio>,
    ) -> Result<Self, ContactError> {
        let roller = RollerLaw::new(contact, coefficient)?;
        Ok(Self::Slice(SliceLaw { contact: *contact, roller, ratio }))
    }

    /// Approach delta_H, m, at the normal force, N; see the conventions for forces that are not positive.
    pub fn approach_m(&self, normal_n: f64) -> f64 {
        if normal_n.is_nan() || normal_n <= 0.0 {
            return 0.0;
        }
        match self {
            Self::Roller(law) => law.approach_m(normal_n),
            Self::Hertz(law) => law.approach_m(normal_n),
            Self::Slice(law) => law.approach_m(normal_n),
        }
    }

    /// Compliance d delta_H/dN, m/N: the exact derivative of [`Self::approach_m`] (of the fitted one for the
    /// slice law). +infinity at forces that are not positive.
    pub fn compliance_m_per_n(&self, normal_n: f64) -> f64 {
        if normal_n.is_nan() || normal_n <= 0.0 {
            return f64::INFINITY;
        }
        match self {
            Self::Roller(law) => law.compliance_m_per_n(normal_n),
            Self::Hertz(law) => law.compliance_m_per_n(normal_n),
            Self::Slice(law) => law.compliance_m_per_n(normal_n),
        }
    }
}

/// delta = K N^0.9/l^0.8 in mm and N (Palmgren), held in SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollerLaw {
    /// delta/N^0.9, m/N^0.9.
    factor: f64,
}

impl RollerLaw {
    /// `coefficient` K in mm and N, positive. With l in m: delta_m = 1e-3 K N^0.9/(1e3 l)^0.8.
    pub fn new(contact: &LineContact, coefficient: f64) -> Result<Self, ContactError> {
        let k = positive("roller coefficient", coefficient)?;
        Ok(Self { factor: 1e-3 * k / (1e3 * contact.length_m).powf(0.8) })
    }

    /// Approach, m, for `normal_n` >= 0.
    pub fn approach_m(&self, normal_n: f64) -> f64 {
        self.factor * normal_n.powf(0.9)
    }

    /// d delta/dN, m/N, for `normal_n` > 0.
    pub fn compliance_m_per_n(&self, normal_n: f64) -> f64 {
        0.9 * self.factor * normal_n.powf(-0.1)
    }
}

/// One body of a Hertzian approach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HertzBody {
    /// Material.
    pub material: Material,
    /// Depth d of the reference point below the surface, m. The approach of a line contact on a half-space
    /// has no limit for great depths (it grows as ln d), so the choice of d is the caller's and part of
    /// the result: half the body's height, a wall thickness.
    pub depth_m: f64,
}

/// Hertz's line contact in plane strain: compression between the surface and a depth, summed over both
/// bodies.
///
/// With the stresses on the axis below a semi-elliptical pressure (Johnson, *Contact Mechanics*, (4.46))
/// integrated to the depth d,
///   delta_k = 2q(1-nu^2)/(pi E) [asinh(d/a) - nu/(1-nu) d/(d + sqrt(a^2 + d^2))],
/// which for a << d is Johnson's (5.56), q(1-nu^2)/(pi E) [2 ln(2d/a) - nu/(1-nu)]; the difference is of
/// relative order (a/d)^2 (1e-4 at a/d = 0.04). The full form is kept because it rises with N for every N; the
/// logarithm turns back where a nears d.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HertzLaw {
    contact: LineContact,
    /// (1-nu^2)/E, nu/(1-nu), d of each body.
    bodies: [(f64, f64, f64); 2],
}

impl HertzLaw {
    /// The law for `contact`, whose contact modulus is that of the two materials. Depths positive.
    pub fn new(contact: &LineContact, bodies: [HertzBody; 2]) -> Result<Self, ContactError> {
        for body in &bodies {
            positive("depth_m", body.depth_m)?;
        }
        let reduced = bodies.map(|body| {
            let nu = body.material.poisson_ratio;
            (body.material.plane_strain_compliance(), nu / (1.0 - nu), body.depth_m)
        });
        Ok(Self { contact: *contact, bodies: reduced })
    }

    /// Approach, m, for `normal_n` > 0.
    pub fn approach_m(&self, normal_n: f64) -> f64 {
        let a = self.contact.half_width_m(normal_n);
        let q = normal_n / self.contact.length_m;
        let sum = |(c, t, d): &(f64, f64, f64)| c * ((d / a).asinh() - t * d / (d + a.hypot(*d)));
        2.0 * q / PI * self.bodies.iter().map(sum).sum::<f64>()
    }

    /// d delta/dN, m/N, for `normal_n` > 0. With a ~ sqrt(N) the derivative of the bracket collects to
    /// asinh(d/a) - (1 + nu/(1-nu)) d/(2 sqrt(a^2 + d^2)).
    pub fn compliance_m_per_n(&self, normal_n: f64) -> f64 {
        let a = self.contact.half_width_m(normal_n);
        let sum = |(c, t, d): &(f64, f64, f64)| c * ((d / a).asinh() - (1.0 + t) * d / (2.0 * a.hypot(*d)));
        2.0 / (PI * self.contact.length_m) * self.bodies.iter().map(sum).sum::<f64>()
    }
}

/// delta_slice = kappa(a(N)/l) delta_H(N), kappa from [`SliceRatio`].
#[derive(Debug, Clone, PartialEq)]
pub struct SliceLaw {
    contact: LineContact,
    roller: RollerLaw,
    ratio: Arc<SliceRatio>,
}

impl SliceLaw {
    /// Approach, m, for `normal_n` > 0.
    pub fn approach_m(&self, normal_n: f64) -> f64 {
        let (kappa, _) = self.kappa(normal_n);
        kappa * self.roller.approach_m(normal_n)
    }

    /// d delta/dN, m/N, for `normal_n` > 0: a ~ sqrt(N), so delta' = kappa delta_H' + kappa_a delta_H/(2N),
    /// kappa_a = d kappa/d ln a.
    pub fn compliance_m_per_n(&self, normal_n: f64) -> f64 {
        let (kappa, slope) = self.kappa(normal_n);
        kappa * self.roller.compliance_m_per_n(normal_n)
            + 0.5 * slope * self.roller.approach_m(normal_n) / normal_n
    }

    fn kappa(&self, normal_n: f64) -> (f64, f64) {
        self.ratio.at(self.contact.half_width_m(normal_n) / self.contact.length_m)
    }
}
