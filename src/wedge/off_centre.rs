//! A sprag between races whose axes do not meet: where windups of sprags in different gaps count from, and the state at
//! a windup.

use super::closure::Statics;
use super::curve::{WedgeCurve, WedgePoint};
use crate::kinematics::{Deformations, Lengths, Radii, beta_off_centre, lengths};
use crate::numeric::dual::Dual;

impl Statics {
    /// Windup, rad, that rolls the sprag without load from first contact between concentric races to first contact
    /// where the axes lie `offset_m` apart (see [`WedgeCurve::build_off_centre`]):
    ///
    ///   g = r_e Omega/R_e + s(turn)/R_i - (beta - beta_0),
    ///
    /// s the length of the inner profile rolled over; from OB dtheta_be = r_e dOmega and R_i dtheta_bi = R_i dbeta - ds, both
    /// against the line OC_e. Rigid bodies at rest. `None` where the sprag does not touch both races on its profile.
    pub fn touch_windup_rad(&self, offset_m: [f64; 2]) -> Option<f64> {
        let p = &self.profile;
        let mut rolled_m = 0.0;
        for arc in &p.arcs {
            let radii = Radii { inner_arc_m: arc.radius_m, ..self.radii };
            let l = lengths(&radii, &UNLOADED);
            let Lengths { oc_i, oc_e, .. } = l;
            let (sin, cos) = beta_off_centre(&l, arc.centre_m.norm(), offset_m)?;
            let beta = sin.v.atan2(cos.v);
            let [along, across] = offset_m;
            let rotation = (oc_i.v * sin.v + across).atan2(oc_i.v * cos.v - oc_e.v + along)
                - arc.centre_m.x.atan2(arc.centre_m.y);
            let turn = rotation - (beta - p.beta0_rad);
            if turn < arc.until_rad {
                rolled_m += arc.radius_m * (turn - arc.from_rad);
                return Some(
                    p.outer_radius_m * rotation / radii.outer_race_m + rolled_m / radii.inner_race_m
                        - (beta - p.beta0_rad),
                );
            }
            rolled_m += arc.radius_m * (arc.until_rad - arc.from_rad);
        }
        None
    }
}

const UNLOADED: Deformations = {
    let none = Dual { v: 0.0, d: 0.0 };
    Deformations {
        race_inner: none,
        race_outer: none,
        contact_inner: none,
        contact_outer: none,
        body: none,
        growth_m: 0.0,
    }
};

impl WedgeCurve {
    /// Axis of the inner race against that of the outer at this sprag: along OC_e outward, and across it, m.
    pub fn offset_m(&self) -> [f64; 2] {
        self.statics.offset_m
    }

    /// Windup at the end of the curve, rad.
    pub fn end_windup_rad(&self) -> f64 {
        self.windup_rad(self.arcs[self.arcs.len() - 1].alpha_until)
    }

    /// State at `windup_rad` since this curve's first contact, from the table; `None` at or below 0 (no load) and beyond
    /// the curve's end.
    pub fn at_windup(&self, windup_rad: f64) -> Option<WedgePoint> {
        let (_, last) = self.end();
        let end = self.end_windup_rad();
        if !(windup_rad > 0.0 && windup_rad <= end * (1.0 + 1e-12)) {
            return None;
        }
        // By Newton: dW = (rho_i + rho_e) d alpha, and the ratios change by a few percent over the whole curve.
        let mut alpha = self.alpha0 + (last - self.alpha0) * (windup_rad / end).min(1.0);
        for _ in 0..40 {
            let p = self.in_arc(self.arc_at(alpha), alpha);
            let step = (windup_rad - self.windup_rad(alpha)) / (p.rho_i + p.rho_e);
            let next = (alpha + step).clamp(self.alpha0, last);
            let done = (next - alpha).abs() <= 4.0 * f64::EPSILON * (last - self.alpha0);
            alpha = next;
            if done {
                break;
            }
        }
        Some(self.in_arc(self.arc_at(alpha), alpha))
    }
}
