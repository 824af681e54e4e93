//! How far the contact law itself may be off, and what that makes of unknowns fitted with it.
//!
//! A law errs smoothly: what it gets wrong at a torque it gets wrong alike at torques near by. Its error is taken as a random course
//! over ln C with the standard deviation that finite elements found, correlated by exp(-|ln C_1 - ln C_2|/ln 3): torques a factor
//! of 3 apart share a third of it. That factor is a choice.

use super::observation::{Observation, ObservedQuantity};
use nalgebra::DMatrix;

/// Factor of torque over which an error of the law changes.
const FACTOR: f64 = 3.0;

/// What a further measurement would do for two unknowns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Apart {
    /// What to measure, at the torques of the fit.
    pub quantity: ObservedQuantity,
    /// The two.
    pub pair: (usize, usize),
    /// Their correlation with it, seen as well as the rest.
    pub correlation: f64,
}

/// Windup and what follows from it, or forces and angles; `None`: no contact law enters.
fn class(kind: ObservedQuantity) -> Option<usize> {
    match kind {
        ObservedQuantity::Windup
        | ObservedQuantity::Secant
        | ObservedQuantity::Tangent
        | ObservedQuantity::EndTorque => Some(0),
        ObservedQuantity::NormalInner
        | ObservedQuantity::NormalOuter
        | ObservedQuantity::TanOmega
        | ObservedQuantity::HertzInner
        | ObservedQuantity::HertzOuter
        | ObservedQuantity::NominalTorque => Some(1),
        ObservedQuantity::LiftOff => None,
    }
}

/// Covariance of the scaled residuals of `seen` by the law's `errors`, of windup and of forces, relative.
pub(super) fn covariance(errors: [f64; 2], seen: &[&Observation]) -> DMatrix<f64> {
    // A quantity without a torque of its own lies at its own value, or anywhere.
    let at = |o: &Observation| o.torque_nm.unwrap_or(o.value).max(f64::MIN_POSITIVE).ln();
    let size = |o: &Observation| class(o.kind).map(|c| (c, errors[c] * o.value.abs() / o.scale()));
    DMatrix::from_fn(seen.len(), seen.len(), |i, j| match (size(seen[i]), size(seen[j])) {
        (Some((a, of_a)), Some((b, of_b))) if a == b => {
            of_a * of_b * (-(at(seen[i]) - at(seen[j])).abs() / FACTOR.ln()).exp()
        }
        _ => 0.0,
    })
}
