//! Load round the circumference where the axes of the two tracks do not meet: every sprag in its own gap.
//!
//! The axis of the inner race lies e from that of the outer, away from the widest gap. At the azimuth psi from there
//! the offset is (-e cos psi, e sin psi) along and across the radius: the gap is J + e cos psi (to e^2/2R), and the tracks are
//! tilted against each other by (e/R_i) sin psi, which changes tan omega as much as the gap does. Sprags at psi and -psi
//! therefore do not carry the same; the sum and the difference of the two carry the two effects.
//!
//! The offset stays with one race. The sprags roll on along both while the clutch winds up, by a third of the windup
//! against the outer race and two thirds against the inner, and so into a narrower or wider gap, which is of first order
//! in e too: a strut shortens by OA sin omega dW where the outer race carries the offset, by OB sin nu dW where the
//! inner does.
//!
//! All sprags touch both races before the clutch engages (the spring sees to that), each at its own first contact and
//! evenly spaced, and the races turn as one: every sprag has the same windup W from its own first contact. A sprag that
//! engaged at psi_0 and is brought to psi by a clutch that turns against the offset has the windup W + g(psi_0) - g(psi) of
//! the curve of its present gap, g as in [`crate::wedge::Statics::touch_windup_rad`]; a race that gives way adds what
//! its shift shortens the strut by. At and below 0 a sprag carries nothing.
//!
//! Left out: the ring law is that of sprags loaded alike, so a sprag's share of the growth comes from its own force
//! alone. Rings that stay round under uneven load would oppose a sprag's excess by the contacts alone: the excess over
//! the mean is too small by up to 1/(1 - p), p the part of the rings in what yields; rings as stiff as they are have rows of
//! their own ([`super::unlike_margins`]). Also left out: of a shift the square, and what it does to tan omega.

mod balance;
mod rows;

pub use balance::{OffCentreEnd, Round, SpragLoad, Survey};
pub use rows::run_out_margins;
pub(super) use rows::run_out_margins_until;

use super::LoadState;
use crate::clutch::Carrier;
use crate::design::Design;
use crate::wedge::{EndReason, NoCurve, WedgeCurve};
use std::f64::consts::TAU;

/// One place round the circumference.
#[derive(Debug, Clone)]
pub struct Seat {
    /// Azimuth from the widest gap at which a sprag touches both races before it engages, rad, 0 to 2 pi.
    pub azimuth_rad: f64,
    /// Axis of the inner race against that of the outer there: along the radius and across it, m.
    pub offset_m: [f64; 2],
    /// By how much the race that carries the offset has turned against a sprag that has come here from first contact
    /// between concentric races, rad.
    pub turned_rad: f64,
    /// Curve of a sprag that engages here; why there is none: it does not touch both races on its profile.
    pub curve: Result<WedgeCurve, NoCurve>,
    /// g, rad.
    touch_windup_rad: f64,
}

/// A vector turned by `angle_rad`.
fn rotated([x, y]: [f64; 2], angle_rad: f64) -> [f64; 2] {
    let (s, c) = angle_rad.sin_cos();
    [x * c - y * s, x * s + y * c]
}

/// A clutch off centre.
#[derive(Debug, Clone)]
pub struct RunOut {
    /// Places of the sprags, the first in the widest gap.
    pub seats: Vec<Seat>,
    /// Distance of the axes, m.
    pub offset_m: f64,
    /// By how many places the engaged sprags are moved on in each round; 0 alone where the offset stays with them.
    pub turns: Vec<usize>,
    /// The race that the offset stays with while the clutch winds up.
    pub carrier: Carrier,
    /// Radial stiffness of the bearings, N/m; infinite: stiff.
    pub stiffness_n_per_m: f64,
    /// Where the clutch comes to its end: in the round in which that is first with the axes held; where the bearings give
    /// way, at most there, and at the last torque that was balanced.
    pub end: OffCentreEnd,
}

/// Rounds looked at in one turn of the clutch against the offset: every 30 deg, or every place where there are fewer.
const TURNS: usize = 12;

impl RunOut {
    /// The clutch of `design` off centre; `None` where it names no eccentricity.
    pub fn new(design: &Design, state: &LoadState) -> Option<Self> {
        let e = design.clutch.races.eccentricity?;
        let count = design.clutch.sprags.count;
        let statics = state.curve.statics();
        let seat = |i: usize| {
            let azimuth_rad = TAU * i as f64 / count as f64;
            let offset_m = rotated([-e.offset_m, 0.0], -azimuth_rad);
            let touch = statics.touch_turn_rad(offset_m, e.carrier).ok_or(NoCurve::NoFirstContact);
            let turned_rad = *touch.as_ref().unwrap_or(&0.0);
            let curve = touch.and_then(|back| {
                let base = rotated(offset_m, -back);
                WedgeCurve::build_off_centre(&design.clutch, &state.profile, base, e.carrier)
            });
            // A curve that breaks off for want of convergence is none to answer with.
            let curve = curve.and_then(|c| match c.end().0 {
                EndReason::NoConvergence => Err(NoCurve::NoConvergence),
                _ => Ok(c),
            });
            let g = curve.as_ref().ok().and_then(|c| c.statics().touch_windup_rad(c.offset_m()));
            Seat { azimuth_rad, offset_m, turned_rad, curve, touch_windup_rad: g.unwrap_or(0.0) }
        };
        let rounds = if e.turning { count.min(TURNS) } else { 1 };
        let mut ring = Self {
            seats: (0..count).map(seat).collect(),
            offset_m: e.offset_m,
            turns: (0..rounds).map(|k| k * count / rounds).collect(),
            carrier: e.carrier,
            stiffness_n_per_m: e.stiffness_n_per_m,
            end: OffCentreEnd::EMPTY,
        };
        ring.end = ring.find_end();
        Some(ring)
    }

    /// Azimuths, rad, at which a sprag does not touch both races.
    pub fn empty_rad(&self) -> Vec<f64> {
        self.seats.iter().filter(|s| s.curve.is_err()).map(|s| s.azimuth_rad).collect()
    }
}
