//! A sprag between races whose axes do not meet: how the offset turns while the sprag rolls on, where windups of sprags in
//! different gaps count from, and the state at a windup.

use super::closure::Statics;
use super::curve::{WedgeCurve, WedgePoint};
use crate::clutch::Carrier;
use crate::kinematics::{Deformations, Radii, beta_off_centre, lengths};
use crate::numeric::dual::Dual;

/// A vector turned by `angle`.
pub(super) fn turned([x, y]: [f64; 2], angle: Dual) -> [Dual; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

impl Statics {
    /// Whether the axes meet.
    pub(super) fn is_concentric(&self) -> bool {
        self.offset_m == [0.0; 2]
    }

    /// Length of the inner profile rolled over on arc `arc` at `turn`, m.
    pub(super) fn rolled_m(&self, arc: usize, turn: Dual) -> Dual {
        let arcs = &self.profile.arcs;
        let before: f64 = arcs[..arc].iter().map(|a| a.radius_m * (a.until_rad - a.from_rad)).sum();
        (turn - arcs[arc].from_rad) * arcs[arc].radius_m + before
    }

    /// Turn of the outer race against the line OC_e since first contact at rest, rigid bodies rolling: R_e dtheta_be = r_e dOmega.
    pub(super) fn outer_turn(&self, rotation: Dual) -> Dual {
        rotation * (self.profile.outer_radius_m / self.radii.outer_race_m)
    }

    /// The same of the inner race: R_i dtheta_bi = R_i dbeta - ds.
    pub(super) fn inner_turn(&self, arc: usize, rotation: Dual, turn: Dual) -> Dual {
        rotation - turn + self.rolled_m(arc, turn) * (-1.0 / self.radii.inner_race_m)
    }

    /// Turn of the race that carries the offset.
    pub(super) fn carried(&self, arc: usize, rotation: Dual, turn: Dual) -> Dual {
        self.carried_by(self.carrier, arc, rotation, turn)
    }

    fn carried_by(&self, carrier: Carrier, arc: usize, rotation: Dual, turn: Dual) -> Dual {
        match carrier {
            Carrier::OuterRace => self.outer_turn(rotation),
            Carrier::InnerRace => self.inner_turn(arc, rotation, turn),
        }
    }

    /// Windup, rad, that rolls the sprag without load from first contact between concentric races to first contact
    /// where the axes lie `offset_m` apart (see [`WedgeCurve::build_off_centre`]):
    ///
    ///   g = r_e Omega/R_e + s(turn)/R_i - (beta - beta_0),
    ///
    /// s the length of the inner profile rolled over. Rigid bodies at rest. A step dd of the offset, as the carrying race
    /// sees it, costs dg = -dd AB/(|AB| OA sin omega): the strut keeps its length. `None` where the sprag does not touch both
    /// races on its profile.
    pub fn touch_windup_rad(&self, offset_m: [f64; 2]) -> Option<f64> {
        (0..self.profile.arcs.len()).find_map(|k| {
            let mut carried = Dual::constant(0.0);
            for _ in 0..60 {
                let (rotation, turn) = self.touch(k, turned(offset_m, carried))?;
                let on = self.carried(k, rotation, turn);
                let settled = (on.v - carried.v).abs() <= 1e-15;
                carried = on;
                if settled {
                    let g = self.outer_turn(rotation).v - self.inner_turn(k, rotation, turn).v;
                    return (turn.v < self.profile.arcs[k].until_rad).then_some(g);
                }
            }
            None
        })
    }

    /// By how much the race `carrier` has turned against the line OC_e when the sprag, without load, has come from first
    /// contact between concentric races to first contact where the offset is `there_m`, rad; that as
    /// [`WedgeCurve::build_off_centre`] wants it is `there_m` turned back by this. `None` as above.
    pub fn touch_turn_rad(&self, there_m: [f64; 2], carrier: Carrier) -> Option<f64> {
        (0..self.profile.arcs.len()).find_map(|k| {
            let (rotation, turn) = self.touch(k, there_m.map(Dual::constant))?;
            let on = self.carried_by(carrier, k, rotation, turn);
            (turn.v < self.profile.arcs[k].until_rad).then_some(on.v)
        })
    }

    /// Rotation and turn of the rigid sprag that touches both races with arc `k`, as if that went on for ever.
    fn touch(&self, k: usize, [along, across]: [Dual; 2]) -> Option<(Dual, Dual)> {
        let arc = &self.profile.arcs[k];
        let radii = Radii { inner_arc_m: arc.radius_m, ..self.radii };
        let l = lengths(&radii, &UNLOADED);
        let (sin, cos) = beta_off_centre(&l, arc.centre_m.norm(), [along, across])?;
        let beta = sin.atan2(cos);
        let rotation = (l.oc_i * sin + across).atan2(l.oc_i * cos - l.oc_e + along)
            - arc.centre_m.x.atan2(arc.centre_m.y);
        Some((rotation, rotation - (beta - self.profile.beta0_rad)))
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
        bulk: none,
        growth_m: 0.0,
    }
};

impl WedgeCurve {
    /// Axis of the inner race against that of the outer at this sprag, as [`Self::build_off_centre`] was given it, m.
    pub fn offset_m(&self) -> [f64; 2] {
        self.statics.offset_m
    }

    /// Windup at the end of the curve, rad.
    pub fn end_windup_rad(&self) -> f64 {
        self.windup_rad(self.arcs[self.arcs.len() - 1].alpha_until)
    }

    /// State at `windup_rad` since this curve's first contact, from the table, with the turn of the race that carries
    /// the offset against the line OC_e, rad; `None` at or below 0 (no load) and beyond the curve's end.
    pub fn at_windup(&self, windup_rad: f64) -> Option<(WedgePoint, f64)> {
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
        let k = self.arc_at(alpha);
        let p = self.in_arc(k, alpha);
        let rotation = alpha - p.gamma + self.statics.gamma0_rad();
        let turn = rotation - (p.beta_gamma - p.gamma - self.statics.profile.beta0_rad);
        let of = Dual::constant;
        Some((p, self.statics.carried(self.first + k, of(rotation), of(turn)).v))
    }
}
