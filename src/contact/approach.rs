//! Approach laws: how far two bodies come together at a line contact under a normal force.

use std::f64::consts::PI;
use std::sync::Arc;

use super::line::{ContactError, LineContact, positive};
use super::shaped::ShapedLaw;
use super::slice_ratio::SliceRatio;
use crate::material::{Material, PlaneState};

/// K of the roller law in DIN 26281, mm and N.
pub const DIN26281_COEFFICIENT: f64 = 3.97e-5;

/// A local contact law, built once for a contact and evaluated without allocation.
///
/// # Conventions
/// The normal force is compression, positive, N. The approach is the whole approach of the two bodies,
/// positive, m. Zero, negative or NaN force: approach 0, compliance +infinity (all laws here start
/// with delta'(N -> 0) -> infinity). Infinite force: approach +infinity, compliance 0.
#[derive(Debug, Clone, PartialEq)]
pub enum Approach {
    /// delta = K N^0.9/l^0.8; does not know the radii.
    Roller(RollerLaw),
    /// Hertz's logarithmic law between two depths; knows the radii.
    Hertz(HertzLaw),
    /// The slice method for square ends without tilt, on the mean compliance of the roller law.
    Slice(SliceLaw),
    /// One of the others, for a contact that is shaped along its length or tilted.
    Shaped(ShapedLaw),
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

    /// The logarithmic law of two layers.
    pub fn layered(contact: &LineContact, bodies: [LayerBody; 2]) -> Result<Self, ContactError> {
        HertzLaw::layered(contact, bodies).map(Self::Hertz)
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
        self.at(normal_n).0
    }

    /// Compliance d delta_H/dN, m/N: the exact derivative of [`Self::approach_m`] (of the fitted one for the
    /// slice law). +infinity at forces that are not positive.
    pub fn compliance_m_per_n(&self, normal_n: f64) -> f64 {
        self.at(normal_n).1
    }

    /// Approach, m, and compliance, m/N, together: they share what is dear.
    pub fn at(&self, normal_n: f64) -> (f64, f64) {
        if normal_n.is_nan() || normal_n <= 0.0 {
            return (0.0, f64::INFINITY);
        }
        if normal_n == f64::INFINITY {
            return (f64::INFINITY, 0.0);
        }
        match self {
            Self::Roller(law) => law.at(normal_n),
            Self::Hertz(law) => law.at(normal_n),
            Self::Slice(law) => law.at(normal_n),
            Self::Shaped(law) => law.at(normal_n),
        }
    }

    /// The same law with some last places of a double off, for less work.
    pub fn quickly(self) -> Self {
        match self {
            Self::Roller(law) => Self::Roller(RollerLaw { quick: true, ..law }),
            Self::Hertz(law) => Self::Hertz(HertzLaw { quick: true, ..law }),
            other => other,
        }
    }

    /// The law with the effective curvature 1/R = `curvature_per_m` > 0 in place of the contact's own, at
    /// `normal_n` > 0; `None` for a law that does not know the radii.
    pub fn curved(&self, normal_n: f64, curvature_per_m: f64) -> Option<CurvedApproach> {
        match self {
            Self::Roller(_) => None,
            Self::Hertz(law) => Some(law.curved(normal_n, curvature_per_m)),
            Self::Slice(law) => Some(law.curved(normal_n, curvature_per_m)),
            Self::Shaped(law) => law.curved(normal_n, curvature_per_m),
        }
    }
}

/// An approach with its derivatives by force and by curvature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvedApproach {
    /// delta, m.
    pub approach_m: f64,
    /// d delta/dN at fixed curvature, m/N.
    pub by_force_m_per_n: f64,
    /// d delta/d(1/R) at fixed force, m^2.
    pub by_curvature_m2: f64,
}

/// delta = K N^0.9/l^0.8 in mm and N (Palmgren), stored in SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollerLaw {
    /// delta/N^0.9, m/N^0.9.
    factor: f64,
    /// Whether the slope is taken from the value: one power instead of two.
    quick: bool,
}

impl RollerLaw {
    /// `coefficient` K in mm and N, positive. With l in m: delta_m = 1e-3 K N^0.9/(1e3 l)^0.8.
    pub fn new(contact: &LineContact, coefficient: f64) -> Result<Self, ContactError> {
        let k = positive("roller coefficient", coefficient)?;
        Ok(Self { factor: 1e-3 * k / (1e3 * contact.length_m).powf(0.8), quick: false })
    }

    fn at(&self, normal_n: f64) -> (f64, f64) {
        let approach_m = self.approach_m(normal_n);
        let slope = if self.quick { 0.9 * approach_m / normal_n } else { self.compliance_m_per_n(normal_n) };
        (approach_m, slope)
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

/// One body of a layered approach: plane strain down to a depth of the order of its thickness, plane stress below.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LayerBody {
    /// Material.
    pub material: Material,
    /// Depth of the reference point in the state that holds there, m.
    pub depth_m: f64,
    /// Depth at which plane strain gives way to plane stress, m: infinite for plane strain throughout (whose state `depth_m` is
    /// then in), 0 for plane stress throughout; see [`crate::race::Race::transition_m`].
    pub transition_m: f64,
}

/// Hertz's line contact: compression between the surface and a depth, summed over both bodies.
///
/// With the stresses on the axis below a semi-elliptical pressure (Johnson, *Contact Mechanics*, (4.46))
/// integrated to the depth d,
///   delta_k = 2q(1-nu^2)/(pi E) [asinh(d/a) - nu/(1-nu) d/(d + sqrt(a^2 + d^2))],
/// which for a << d is Johnson's (5.56), q(1-nu^2)/(pi E) [2 ln(2d/a) - nu/(1-nu)]; the difference is of
/// relative order (a/d)^2 (1e-4 at a/d = 0.04). The full form is kept because it rises with N for every N; the
/// logarithm turns back where a nears d. In plane stress 1/E and nu take the place of (1-nu^2)/E and nu/(1-nu).
#[derive(Debug, Clone, PartialEq)]
pub struct HertzLaw {
    contact: LineContact,
    /// (compliance, transverse ratio, depth) of each piece; a piece that ends where another begins has a negative
    /// compliance.
    pieces: Vec<(f64, f64, f64)>,
    /// Whether asinh is taken as a logarithm: some last places off, a third of the work.
    quick: bool,
}

impl HertzLaw {
    /// Plane strain throughout, for `contact`, whose contact modulus is that of the two materials. Depths positive.
    pub fn new(contact: &LineContact, bodies: [HertzBody; 2]) -> Result<Self, ContactError> {
        Self::layered(
            contact,
            bodies.map(|b| LayerBody {
                material: b.material,
                depth_m: b.depth_m,
                transition_m: f64::INFINITY,
            }),
        )
    }

    /// Plane strain down to each body's transition, plane stress from there to its depth.
    pub fn layered(contact: &LineContact, bodies: [LayerBody; 2]) -> Result<Self, ContactError> {
        let mut pieces = Vec::with_capacity(6);
        for body in &bodies {
            let depth = positive("depth_m", body.depth_m)?;
            let of = |state: PlaneState| {
                (state.compliance(&body.material), state.transverse_ratio(body.material.poisson_ratio))
            };
            let (strain, stress) = (of(PlaneState::Strain), of(PlaneState::Stress));
            if body.transition_m == f64::INFINITY {
                pieces.push((strain.0, strain.1, depth));
            } else {
                pieces.push((stress.0, stress.1, depth));
                if body.transition_m > 0.0 {
                    pieces.push((strain.0, strain.1, body.transition_m));
                    pieces.push((-stress.0, stress.1, body.transition_m));
                }
            }
        }
        Ok(Self { contact: *contact, pieces, quick: false })
    }

    /// Approach, m, and d delta/dN, m/N, for `normal_n` > 0. With a ~ sqrt(N) the derivative of the bracket collects
    /// to asinh(d/a) - (1 + nu/(1-nu)) d/(2 sqrt(a^2 + d^2)).
    pub fn at(&self, normal_n: f64) -> (f64, f64) {
        let (whole, rate) = self.sums(self.contact.half_width_m(normal_n));
        let q = normal_n / self.contact.length_m;
        (2.0 * q / PI * whole, 2.0 / (PI * self.contact.length_m) * rate)
    }

    /// See [`Approach::curved`]. delta/N depends on N R alone, so d delta/d(1/R) = R (delta - N delta').
    fn curved(&self, normal_n: f64, curvature_per_m: f64) -> CurvedApproach {
        let contact = LineContact { effective_radius_m: 1.0 / curvature_per_m, ..self.contact };
        let (whole, rate) = self.sums(contact.half_width_m(normal_n));
        let q = normal_n / self.contact.length_m;
        CurvedApproach {
            approach_m: 2.0 * q / PI * whole,
            by_force_m_per_n: 2.0 / (PI * self.contact.length_m) * rate,
            by_curvature_m2: 2.0 * q / PI * (whole - rate) / curvature_per_m,
        }
    }

    /// The bracket of delta and that of N delta', summed over the pieces, at half width `a`.
    fn sums(&self, a: f64) -> (f64, f64) {
        let (mut whole, mut rate) = (0.0, 0.0);
        let (mut at, mut log, mut h) = (f64::NAN, f64::NAN, f64::NAN);
        for (c, t, d) in &self.pieces {
            // Pieces that meet at one depth follow one another.
            if *d != at {
                at = *d;
                (log, h) = if self.quick && *d > a {
                    let h = (a * a + d * d).sqrt();
                    (((d + h) / a).ln(), h)
                } else {
                    ((d / a).asinh(), a.hypot(*d))
                };
            }
            whole += c * (log - t * d / (d + h));
            rate += c * (log - (1.0 + t) * d / (2.0 * h));
        }
        (whole, rate)
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
    /// Approach, m, and d delta/dN, m/N, for `normal_n` > 0: a ~ sqrt(N), so
    /// delta' = kappa delta_H' + kappa_a delta_H/(2N), kappa_a = d kappa/d ln a.
    pub fn at(&self, normal_n: f64) -> (f64, f64) {
        let (kappa, slope) = self.ratio.at(self.contact.half_width_m(normal_n) / self.contact.length_m);
        self.of(normal_n, kappa, slope)
    }

    /// See [`Approach::curved`]. a ~ (1/R)^(-1/2).
    fn curved(&self, normal_n: f64, curvature_per_m: f64) -> CurvedApproach {
        let contact = LineContact { effective_radius_m: 1.0 / curvature_per_m, ..self.contact };
        let (kappa, slope) = self.ratio.at(contact.half_width_m(normal_n) / contact.length_m);
        let (approach_m, by_force_m_per_n) = self.of(normal_n, kappa, slope);
        let by_curvature_m2 = -0.5 * slope * self.roller.approach_m(normal_n) / curvature_per_m;
        CurvedApproach { approach_m, by_force_m_per_n, by_curvature_m2 }
    }

    fn of(&self, normal_n: f64, kappa: f64, slope: f64) -> (f64, f64) {
        let roller = self.roller.approach_m(normal_n);
        (kappa * roller, kappa * self.roller.compliance_m_per_n(normal_n) + 0.5 * slope * roller / normal_n)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEEL: Material = Material { youngs_modulus_pa: 206e9, poisson_ratio: 0.3, density_kg_m3: 7850.0 };
    const E_STAR: f64 = 206e9 / (2.0 * 0.91);
    /// K of the public model of the same clutch, mm and N.
    const K: f64 = 3.944e-5;

    fn contact() -> LineContact {
        LineContact::external(11.11e-3, 4.02e-3, 6e-3, E_STAR).unwrap()
    }

    fn bodies() -> [HertzBody; 2] {
        [HertzBody { material: STEEL, depth_m: 3.9e-3 }, HertzBody { material: STEEL, depth_m: 4.165e-3 }]
    }

    fn laws() -> Vec<Approach> {
        let c = contact();
        vec![
            Approach::roller(&c, K).unwrap(),
            Approach::din26281(&c).unwrap(),
            Approach::hertz(&c, bodies()).unwrap(),
            Approach::slice(&c, K, Arc::new(SliceRatio::new(60).unwrap())).unwrap(),
        ]
    }

    #[test]
    fn the_roller_law_is_the_printed_one_in_millimetres() {
        let law = Approach::roller(&contact(), K).unwrap();
        let printed_mm = K * 1558.116f64.powf(0.9) / 6f64.powf(0.8);
        assert!((1e3 * law.approach_m(1558.116) / printed_mm - 1.0).abs() < 1e-14);
        // delta_h_um of the static table at 16.8 N m; and the public model's 1.57e-10 in SI
        assert!((law.approach_m(1558.116) - 7.02677e-6).abs() < 1e-11);
        let one_metre = LineContact { length_m: 1.0, ..contact() };
        let si = RollerLaw::new(&one_metre, K).unwrap().approach_m(1.0);
        assert!((si - 1.57e-10).abs() < 5e-13, "{si}");
        let din = Approach::din26281(&contact()).unwrap();
        assert!((din.approach_m(700.0) / law.approach_m(700.0) * K / 3.97e-5 - 1.0).abs() < 1e-14);
    }

    #[test]
    fn compliance_is_the_derivative_of_the_approach() {
        for law in laws() {
            for n in [1e-3, 1.0, 83.0, 1558.0, 9000.0, 2e5] {
                let h = 1e-4 * n;
                let d = |k: f64| law.approach_m(n + k * h) - law.approach_m(n - k * h);
                let numeric = (8.0 * d(1.0) - d(2.0)) / (12.0 * h);
                let exact = law.compliance_m_per_n(n);
                assert!((numeric / exact - 1.0).abs() < 2e-10, "{law:?} at {n}: {numeric} {exact}");
            }
        }
    }

    #[test]
    fn a_law_that_knows_the_radius_takes_another_curvature_with_exact_derivatives() {
        let of = |law: usize, n: f64, per_m: f64| laws()[law].curved(n, per_m);
        assert_eq!((of(0, 100.0, 300.0), of(1, 100.0, 300.0)), (None, None));
        let own = 1.0 / contact().effective_radius_m;
        for law in [2, 3] {
            for n in [1e-3, 83.0, 1558.0, 9000.0] {
                let at = of(law, n, own).unwrap();
                assert!((at.approach_m / laws()[law].approach_m(n) - 1.0).abs() < 1e-14);
                assert!((at.by_force_m_per_n / laws()[law].compliance_m_per_n(n) - 1.0).abs() < 1e-14);
                let d = |k: f64| of(law, n, own * (1.0 + k)).unwrap().approach_m;
                let numeric = (d(1e-3) - d(-1e-3)) / (2e-3 * own);
                assert!((numeric / at.by_curvature_m2 - 1.0).abs() < 1e-5, "{law} {n}: {numeric} {at:?}");
            }
        }
    }

    #[test]
    fn laws_rise_from_nothing_without_end() {
        for law in laws() {
            let mut last = law.approach_m(0.0);
            assert_eq!(last, 0.0);
            for i in -40..=40 {
                let n = 10f64.powf(0.25 * f64::from(i));
                let now = law.approach_m(n);
                assert!(now > last && law.compliance_m_per_n(n) > 0.0, "{law:?} at {n}");
                last = now;
            }
            for n in [0.0, -3.0, f64::NAN] {
                assert_eq!((law.approach_m(n), law.compliance_m_per_n(n)), (0.0, f64::INFINITY));
            }
            assert_eq!(
                (law.approach_m(f64::INFINITY), law.compliance_m_per_n(f64::INFINITY)),
                (f64::INFINITY, 0.0)
            );
            for n in [1e-300, 1e300] {
                assert!(law.approach_m(n) > 0.0 && law.compliance_m_per_n(n) > 0.0, "{law:?} at {n}");
            }
        }
    }

    #[test]
    fn the_hertz_law_tends_to_johnsons_logarithm() {
        // (5.56) of Contact Mechanics, both bodies; E and nu as above
        let c = contact();
        let law = Approach::hertz(&c, bodies()).unwrap();
        let johnson = |n: f64| {
            let a = c.half_width_m(n);
            let body = |d: f64| 2.0 * (2.0 * d / a).ln() - 0.3 / 0.7;
            n / c.length_m * 0.91 / (std::f64::consts::PI * 206e9) * (body(3.9e-3) + body(4.165e-3))
        };
        for (n, bound) in [(1.0, 1e-7), (100.0, 1e-5), (1558.0, 1e-4), (4500.0, 2.5e-4)] {
            let off = law.approach_m(n) / johnson(n) - 1.0;
            println!("{n} N: {} um, off Johnson by {off:e}", 1e6 * law.approach_m(n));
            assert!(off.abs() < bound, "{n}: {off}");
        }
    }

    #[test]
    fn the_hertz_law_is_the_integral_of_the_strain_below_the_contact() {
        // plane strain: eps = [(1-nu^2) s_z - nu(1+nu) s_x]/E with Johnson's (4.46), midpoint rule
        let c = contact();
        let (n, d, nu) = (4500.0, 4e-3, 0.3);
        let (a, p0) = (c.half_width_m(n), c.peak_pressure_pa(n));
        let steps = 200_000;
        let mut sum = 0.0;
        for i in 0..steps {
            let z = d * (i as f64 + 0.5) / steps as f64;
            let root = a.hypot(z);
            let s_x = -p0 / a * ((a * a + 2.0 * z * z) / root - 2.0 * z);
            let s_z = -p0 * a / root;
            sum -= ((1.0 - nu * nu) * s_z - nu * (1.0 + nu) * s_x) / 206e9;
        }
        let integral = 2.0 * sum * d / steps as f64;
        let body = HertzBody { material: STEEL, depth_m: d };
        let law = Approach::hertz(&c, [body, body]).unwrap().approach_m(n);
        assert!((law / integral - 1.0).abs() < 1e-8, "{law} {integral}");
    }

    #[test]
    fn the_slice_law_lies_1_5_to_2_2_percent_below_the_roller_law() {
        let all = laws();
        for n in [1558.0, 2441.0, 4500.0, 8384.0] {
            let below = 1.0 - all[3].approach_m(n) / all[0].approach_m(n);
            println!("{n} N: slice {below:.5} below roller");
            assert!((0.015..0.022).contains(&below), "{n}: {below}");
        }
    }

    #[test]
    fn impossible_laws_are_refused() {
        assert!(Approach::roller(&contact(), 0.0).is_err());
        assert!(Approach::roller(&contact(), f64::NAN).is_err());
        let mut flat = bodies();
        flat[1].depth_m = 0.0;
        assert!(Approach::hertz(&contact(), flat).is_err());
    }
}
