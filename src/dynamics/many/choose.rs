//! The modes of all sprags at once where some of them have zero slip velocity.
//!
//! Under given accelerations x = (theta_bi'', theta_be'') of the races each sprag is by itself: its two contacts have one
//! consistent mode (see `dynamics::choose`: the races only add to a matrix that is positive definite by alpha and phi
//! alone), and with it its T(x), piecewise linear and falling with x. What is left is
//!
//!   F(x) = I x - f - sum n R T(x) = 0,   I = diag(I_bi, I_be),   R = diag(OA, -OB):
//!
//! two equations, monotone and piecewise linear, whatever number of sprags changes together. With fixed limits mu N, F is the
//! slope of a strictly convex function: one solution, and Newton's method finds it, its steps halved where F would not become
//! less. None of the sprags comes first, so sprags alike in the same state choose the same.

use super::rhs::Rhs;
use super::state_of;
use crate::dynamics::choose::{Known, choose_by};
use crate::dynamics::model::{Grip, Mode, Place};
use nalgebra::Vector4;

/// Steps of Newton's method, halvings included: two or three are needed.
const MOST: u32 = 60;

/// What is known of both contacts of a group.
pub(super) type BothKnown = [Known; 2];

/// Of a group that has come to no event.
pub(super) fn as_it_is(mode: &Mode) -> BothKnown {
    [mode.inner, mode.outer].map(|grip| match grip {
        Grip::Stick => Known::Still,
        Grip::Slip(s) => Known::Slips(s),
    })
}

impl Rhs<'_> {
    /// Bring all groups into their consistent modes at (t, y), their places as they are. False: one contradicts itself.
    pub(super) fn choose(&mut self, t: f64, y: &[f64], known: &[BothKnown]) -> bool {
        let free = self.motions.iter_mut().zip(known).filter(|(m, _)| m.mode.place != Place::Carried);
        for (motion, known) in free {
            // Where a contact has been released it slips, whatever comes of the others.
            motion.mode.inner = released(known[0], motion.mode.inner);
            motion.mode.outer = released(known[1], motion.mode.outer);
        }
        let inertia = self.inertia();
        let size = |miss: &Vector4<f64>| {
            let part = |i: usize| miss[i] * miss[i] / inertia[i];
            part(0) + part(1) + part(2) + part(3)
        };
        let mut x = self.look::<true>(t, y);
        let mut choice = self.choose_under(t, y, known, &x);
        let mut left = size(&choice.miss);
        for _ in 0..MOST {
            if choice.modes.iter().zip(&self.motions).all(|(mode, motion)| *mode == motion.mode) {
                return choice.consistent;
            }
            self.set(&choice.modes);
            let to = self.look::<true>(t, y);
            let mut part = 1.0;
            loop {
                let there = x + (to - x) * part;
                let found = self.choose_under(t, y, known, &there);
                // The modes that have led there are those of there: nothing is left over but rounding.
                if part == 1.0 && found.modes == choice.modes {
                    return found.consistent;
                }
                let miss = size(&found.miss);
                if miss < left || part < 1e-3 {
                    (x, left, choice) = (there, miss, found);
                    break;
                }
                part *= 0.5;
            }
        }
        self.set(&choice.modes);
        false
    }

    fn set(&mut self, modes: &[Mode]) {
        for (motion, mode) in self.motions.iter_mut().zip(modes) {
            motion.mode = *mode;
        }
    }

    /// Each group's own mode while the races go at `x`, rad/s^2.
    fn choose_under(&self, t: f64, y: &[f64], known: &[BothKnown], x: &Vector4<f64>) -> Chosen {
        let mut miss = self.inertia().component_mul(x) - self.outside(&self.torques_nm(t, y), y);
        self.bend(y);
        let mut consistent = true;
        let mut modes = Vec::with_capacity(self.groups.len());
        for (g, (group, motion)) in self.groups.iter().zip(&self.motions).enumerate() {
            if motion.waits {
                modes.push(motion.mode);
                continue;
            }
            let model = &group.model;
            let sight = self.stands_there(g, motion.mode.place, t, y, &state_of(y, g));
            if motion.mode.place == Place::Carried {
                miss -= self.acts(g, &sight, &self.carried_under(g, t, y, &sight.point, x));
                modes.push(motion.mode);
                continue;
            }
            let [inner, outer] = known[g];
            let found = choose_by(model, &sight.point, motion.mode.place, inner, outer, |mode| {
                self.between(g, mode, t, y, x)
            });
            let forces = found.forces.unwrap_or(crate::dynamics::model::Forces::NONE);
            miss -= self.acts(g, &sight, &forces);
            consistent = consistent && found.consistent;
            // What a contact does means nothing without one.
            modes.push(found.mode);
        }
        Chosen { modes, miss, consistent }
    }
}

fn released(known: Known, grip: Grip) -> Grip {
    match known {
        Known::Slips(s) | Known::Released(s) => Grip::Slip(s),
        Known::Still => grip,
    }
}

/// Modes under accelerations of the races, and what these then miss, N m.
struct Chosen {
    modes: Vec<Mode>,
    miss: Vector4<f64>,
    consistent: bool,
}
