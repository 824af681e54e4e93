//! The approach of a contact whose length is not evenly loaded: end profiles, tilt, both.

use super::approach::{Approach, CurvedApproach};
use super::axial::AxialFit;
use super::line::{ContactError, LineContact};
use super::slice::{SliceCompliance, SliceContact, SliceStatus};
use crate::numeric::chebyshev::Chebyshev;

/// A law for a straight contact times what the shape along it adds.
///
/// The factor is 1 + [delta_fit(N) - delta_square(N)]/delta_base(N): slices know how much deeper a shaped or tilted
/// contact sinks than a straight one under the same force, and that difference does not depend on how deep in the
/// bodies the approach is measured. ln(factor) is a Chebyshev series in ln N over `FORCES` times
/// E* l R. Where ten slices or more bear it agrees with them to 1.5 % (`tests/wedge/slice_shaped.rs`); under forces at
/// which fewer than four bear, where each is a step, the factor levels out: there, far below any load of interest, a
/// tilted contact is softer than this law. Beyond the range the factor is held.
#[derive(Debug, Clone, PartialEq)]
pub struct ShapedLaw {
    base: Box<Approach>,
    ln_factor: Chebyshev,
}

/// Range of N/(E* l R): 1e-3 N to 60 kN for 6 mm of steel with R = 3 mm.
const FORCES: [f64; 2] = [5e-10, 3e-2];
/// Two solutions a point: 48 a contact, and some ten to find where the series begins.
const DEGREE: usize = 23;
/// Slices that must bear where the series begins: of fewer, each is a step.
const BEARING: usize = 4;
/// Over which the slope there is taken, of ln N.
const STRIDE: f64 = 1.0;
/// Over which it levels out below, of ln N.
const FADE: f64 = 2.0;
/// Fewest slices that know a shape, a choice.
const FEWEST: usize = 10;

impl ShapedLaw {
    /// `base` on `contact`, shaped as `fit` says, by `count` slices (10 or more) of `compliance`.
    pub fn new(
        base: Approach,
        contact: &LineContact,
        compliance: SliceCompliance,
        count: usize,
        fit: &AxialFit,
    ) -> Result<Self, ContactError> {
        if count < FEWEST {
            return Err(ContactError::Slices { slices: count });
        }
        let slices = SliceContact::with_compliance(*contact, compliance, count)?;
        let unit = contact.contact_modulus_pa * contact.length_m * contact.effective_radius_m;
        let [low, high] = FORCES.map(|f| (f * unit).ln());
        let deeper = |x: f64| {
            let n = x.exp();
            let sunk = slices.solve_along(n, fit).map_or(f64::NAN, |s| s.approach_m);
            let straight = slices.solve(n).map_or(f64::NAN, |s| s.approach_m);
            ((sunk - straight) / base.approach_m(n)).max(0.0).ln_1p()
        };
        let bearing = |x: f64| match slices.solve_along(x.exp(), fit).map(|s| s.status) {
            Ok(SliceStatus::PartlyOpen { open }) => count - open >= BEARING,
            _ => true,
        };
        // A fit that cannot be solved is refused here, once for all forces.
        slices.solve_along(high.exp(), fit)?;
        let (mut few, mut start) = (low, if bearing(low) { low } else { high });
        while start - few > 0.1 {
            let middle = 0.5 * (few + start);
            *(if bearing(middle) { &mut start } else { &mut few }) = middle;
        }
        // Below, the power law that holds where the series begins, between N^0 (straight) and N^-1/2 (tilted), levels
        // out within FADE, so that the factor has a limit for N -> 0.
        let at_start = deeper(start);
        let slope = ((deeper(start + STRIDE) - at_start) / STRIDE).clamp(-0.5, 0.0);
        let ln_factor = Chebyshev::fit(low, high, DEGREE, |x| {
            if x < start { at_start + slope * FADE * ((x - start) / FADE).exp_m1() } else { deeper(x) }
        });
        Ok(Self { base: Box::new(base), ln_factor })
    }

    /// The same shape on another straight law.
    pub fn on(&self, base: Approach) -> Self {
        Self { base: Box::new(base), ln_factor: self.ln_factor.clone() }
    }

    fn factor(&self, normal_n: f64) -> (f64, f64) {
        let (low, high) = self.ln_factor.interval();
        let x = normal_n.ln();
        let inside = x.clamp(low, high);
        let slope = if inside == x { self.ln_factor.derivative(x) } else { 0.0 };
        (self.ln_factor.eval(inside).exp(), slope)
    }

    /// Approach, m, and compliance, m/N, for `normal_n` > 0: f delta_b' + f' delta_b with f' = f (ln f)'/N.
    pub fn at(&self, normal_n: f64) -> (f64, f64) {
        let (factor, slope) = self.factor(normal_n);
        let (approach, compliance) = self.base.at(normal_n);
        (factor * approach, factor * (compliance + slope * approach / normal_n))
    }

    /// As [`Approach::curved`]: the factor does not know the radius.
    pub fn curved(&self, normal_n: f64, curvature_per_m: f64) -> Option<CurvedApproach> {
        let (factor, slope) = self.factor(normal_n);
        let base = self.base.curved(normal_n, curvature_per_m)?;
        Some(CurvedApproach {
            approach_m: factor * base.approach_m,
            by_force_m_per_n: factor * (base.by_force_m_per_n + slope * base.approach_m / normal_n),
            by_curvature_m2: factor * base.by_curvature_m2,
        })
    }
}
