//! One sprag unlike the others: its own size, a track that recedes at its place alone, an axis that lies off; the state at a
//! normal force, and how far the races have turned against each other when it has come there.
//!
//! The windup of a sprag that rolls between tracks that move under load is an integral along its own course. Nearly all of it
//! is what rigid bodies that end in the same places would have rolled, which is no integral: g = r_e Omega/R_e + s/R_i -
//! (beta - beta_0), as in `off_centre`. The rest, elastic approach over radius of it, is that of the clutch's own curve at
//! the same force, so at N the windup is W_curve(N) + g(N, apart) - g(N, alike): exact for a sprag like all others, and off by the
//! deviation over the radius of the windup, some 1e-4, for one unlike them.

use super::closure::{Closure, FIRST_CONTACT_N, Statics};
use crate::clutch::Carrier;
use crate::numeric::dual::Dual;

/// How far from the ends of its arc a contact is well within it, rad: far beyond rounding.
const WITHIN_RAD: f64 = 1e-9;

/// What sets one sprag apart; all 0: nothing.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SpragDeviation {
    /// How much more the sprag measures across its contacts, m: half of it at each.
    pub size_m: f64,
    /// How much the inner track recedes from the gap at its place, beside what the law of even sprags has, m.
    pub inner_m: f64,
    /// The same of the outer track, m.
    pub outer_m: f64,
    /// Axis of the inner race against that of the outer: along OC_e outward, and across it, at first contact between
    /// concentric races, m.
    pub offset_m: [f64; 2],
    /// The race that this stays with.
    pub carrier: Carrier,
}

/// A sprag at one normal force.
#[derive(Debug, Clone, Copy)]
pub struct Borne {
    /// Equilibrium.
    pub closure: Closure,
    /// Arc of the profile, from 0.
    pub arc: usize,
    /// Turn of the contact in the body, rad.
    pub turn_rad: f64,
    /// g, rad, with its derivative by N_bi.
    pub rolled: Dual,
    /// p_0 at A, Pa.
    pub hertz_inner_pa: f64,
    /// p_0 at B, Pa.
    pub hertz_outer_pa: f64,
}

impl Statics {
    /// Set what sets the sprag apart.
    pub fn set_apart(&mut self, apart: SpragDeviation) {
        (self.offset_m, self.carrier) = (apart.offset_m, apart.carrier);
        self.opened_m = [apart.inner_m, apart.outer_m, -apart.size_m];
    }

    /// The sprag at inner normal force `n_bi`, N, at rest, on the arc to which its contact has turned; `None` where there
    /// is no equilibrium: it has rolled over, or never stood between the tracks.
    pub fn borne(&self, n_bi: f64) -> Option<Borne> {
        self.borne_near(n_bi, 0)
    }

    /// The same, looked for first on arc `near`, and from the first one on where the contact is not well within it.
    pub(crate) fn borne_near(&self, n_bi: f64, near: usize) -> Option<Borne> {
        let n_bi = n_bi.max(FIRST_CONTACT_N);
        let arcs = &self.profile.arcs;
        let on = |arc: usize| {
            let closure = self.closure(arc, n_bi, 0.0, 0.0).ok()?;
            Some((arc, closure, closure.turn_rad(self.profile.beta0_rad)))
        };
        let within = |(arc, _, turn_rad): &(usize, Closure, f64)| {
            let ends = arc + 1 < arcs.len() && *turn_rad > arcs[*arc].until_rad - WITHIN_RAD;
            *turn_rad > arcs[*arc].from_rad + WITHIN_RAD && !ends
        };
        let mut found = Some(near).filter(|arc| (1..arcs.len()).contains(arc)).and_then(on).filter(within);
        if found.is_none() {
            // Laws are continuous over a junction to rounding: a turn on the edge of two arcs is taken as it comes.
            for (arc, ends) in arcs.iter().enumerate() {
                let here = on(arc)?;
                let beyond = here.2 >= ends.until_rad;
                found = Some(here);
                if !beyond {
                    break;
                }
            }
        }
        let (arc, closure, turn_rad) = found?;
        let turn = closure.rotation - (closure.beta - self.profile.beta0_rad);
        let rolled = self.outer_turn(closure.rotation) - self.inner_turn(arc, closure.rotation, turn);
        let (patch, _) = self.patch(arc, &closure);
        Some(Borne {
            closure,
            arc,
            turn_rad,
            rolled,
            hertz_inner_pa: patch.peak_pressure_pa(n_bi),
            hertz_outer_pa: self.elastic.outer_contact.peak_pressure_pa(closure.n_be.v),
        })
    }

    /// Whether a contact at `turn_rad` is still on the profile.
    pub fn on_profile(&self, turn_rad: f64) -> bool {
        self.profile.arcs.last().is_none_or(|last| turn_rad <= last.until_rad * (1.0 + 1e-12))
    }
}
