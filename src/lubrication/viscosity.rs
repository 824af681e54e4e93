//! Viscosity over temperature.

/// Thermal conductivity of oils, W/(m K): 0.12 to 0.15.
pub const OIL_CONDUCTIVITY: f64 = 0.14;

/// 0 C, K.
const KELVIN: f64 = 273.15;

/// Walther's line, ASTM D341: log log Z = A - B log T, T in K, Z = nu + 0.7 + exp(-1.47 - 1.84 nu - 0.51 nu^2), nu in mm^2/s.
///
/// D341 gives it from 0.21 mm^2/s on; it interpolates well between 0 and 150 C and says nothing of an oil below its pour
/// point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Walther {
    a: f64,
    b: f64,
}

/// Z of D341 and dZ/dnu; nu in mm^2/s.
fn z(nu: f64) -> (f64, f64) {
    let small = (-1.47 - 1.84 * nu - 0.51 * nu * nu).exp();
    (nu + 0.7 + small, 1.0 - (1.84 + 1.02 * nu) * small)
}

impl Walther {
    /// Up to which it is known to hold, C.
    pub const KNOWN_TO_C: f64 = 150.0;

    /// The line through the viscosities at 40 and 100 C, m^2/s.
    pub fn through(nu40_m2_s: f64, nu100_m2_s: f64) -> Self {
        let y = |nu: f64| z(1e6 * nu).0.log10().log10();
        let (x40, x100) = ((KELVIN + 40.0).log10(), (KELVIN + 100.0).log10());
        let b = (y(nu40_m2_s) - y(nu100_m2_s)) / (x100 - x40);
        Self { a: y(nu40_m2_s) + b * x40, b }
    }

    /// Kinematic viscosity at `celsius`, m^2/s.
    pub fn nu_m2_s(&self, celsius: f64) -> f64 {
        let want = 10f64.powf(10f64.powf(self.a - self.b * (KELVIN + celsius).log10())).min(MOST);
        // Newton from the term that is all but everything; Z rises with nu.
        let mut nu = (want - 0.7).max(LEAST);
        for _ in 0..40 {
            let (value, slope) = z(nu);
            let next = (nu - (value - want) / slope).max(LEAST);
            if (next - nu).abs() <= 1e-15 * next {
                break;
            }
            nu = next;
        }
        1e-6 * nu
    }
}

/// Where D341 ends, mm^2/s.
const LEAST: f64 = 0.21;
/// Where D341 ends above, mm^2/s: no oil flows any more.
const MOST: f64 = 2e7;
