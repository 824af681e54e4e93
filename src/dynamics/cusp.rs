//! First contact, the cusp of every curve: N ~ x^(10/9) and rho - rho_0 ~ x^(1/9), x its distance in alpha.

use super::events::{LOWER, UPPER};
use super::model::{Grip, Mode, Place};
use crate::ode::adaptive::Size;
use crate::ode::step::{Dense, Step};
use crate::wedge::RHO_STEEPEST_RAD;
use nalgebra::Const;

/// How much of the way to the cusp one step may go.
const PART: f64 = 0.8;
/// From here on, rad, the rest is one step: rho' grows no more.
const NEAR_RAD: f64 = 2.0 * RHO_STEEPEST_RAD;

/// The event at which `place` ends at first contact, where rho and the slope of N have infinite slopes.
pub(super) fn cusp(place: Place) -> Option<usize> {
    match place {
        Place::Arc(0) => Some(LOWER),
        Place::Tension => Some(UPPER),
        Place::Arc(_) | Place::Open | Place::Carried => None,
    }
}

/// How long a step `x` (rad) away from first contact that goes at `rate` (rad/s) may be that does not spoil the loss of contact, s. Where one contact holds
/// and the other slips, alpha'' holds rho' alpha'^2 ~ x^(-8/9): of a step that begins at x and ends at the cusp the estimate sees
/// nothing, however short, and three runs that do the same agree and are wrong together.
pub(super) fn towards_the_cusp_s(mode: &Mode, x: f64, rate: f64) -> f64 {
    let one_holds = (mode.inner == Grip::Stick) != (mode.outer == Grip::Stick);
    if mode.place == Place::Arc(0) && one_holds && rate < 0.0 && x > NEAR_RAD {
        return PART * x / -rate;
    }
    f64::INFINITY
}

/// The fraction of a step from which on what shows only near first contact shows, where the cusp lies at the fraction `theta` of it: what
/// rolling demands grows there with the slope of rho, as far as [`RHO_STEEPEST_RAD`] from it.
pub(super) fn near_the_cusp<const N: usize>(step: &Step<N>, theta: f64, dense: &Dense<N>) -> f64
where
    Const<N>: Size,
{
    theta - RHO_STEEPEST_RAD / (dense.after(theta * step.h())[4] * step.h()).abs()
}
