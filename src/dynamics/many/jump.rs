//! What the rates of all do where some sprags cross a junction.

use super::run::Going;
use super::{EACH, HEAD, state_of};
use crate::dynamics::crossing::cross_between;
use crate::dynamics::model::{Grip, Mode, Place};
use nalgebra::Matrix2;

impl<const N: usize> Going<'_, N> {
    /// Inertia that an impulse on the races meets, with all groups but `those`, kg m^2: a sprag that rolls on both races turns along,
    /// one that rolls on one alone keeps the momentum of alpha.
    fn races_with_all_but(&self, those: &[usize]) -> Matrix2<f64> {
        let races = &self.groups[0].model;
        let mut sum = Matrix2::new(races.inner_inertia_kg_m2, 0.0, 0.0, races.outer_inertia_kg_m2);
        for other in (0..self.groups.len()).filter(|other| !those.contains(other)) {
            let Some(turns) = self.turns_along(other) else { continue };
            sum += turns.0;
        }
        sum
    }

    /// Inertia that group `g` adds to the races, kg m^2, and what alpha' takes from a jump of their rates.
    fn turns_along(&self, g: usize) -> Option<(Matrix2<f64>, [f64; 2])> {
        let (model, motion) = (&self.groups[g].model, &self.rhs.motions[g]);
        if motion.waits {
            return None;
        }
        let p = self.rhs.stands(g, motion.mode.place, self.t_s, &self.y, &state_of(&self.y, g)).point;
        let (n, i) = (model.count, model.inertia_kg_m2);
        let orbit = model.mass_kg * p.oc_g * p.oc_g;
        let inner = motion.mode.inner == Grip::Stick && motion.mode.place != Place::Open;
        let outer = motion.mode.outer == Grip::Stick;
        // One race alone: phi' = theta' + s alpha', s its rolling ratio with its sign.
        let one = |s: f64| {
            let along = i * (1.0 + s) + orbit * s;
            let own = i * (1.0 + s).powi(2) + orbit * s * s;
            (n * i * orbit / own, -along / own)
        };
        Some(match (inner, outer) {
            (true, true) => {
                let r = p.rho_i + p.rho_e;
                // (alpha', phi') by the rates of the races.
                let (a, f) = ([-1.0 / r, 1.0 / r], [p.rho_e / r, p.rho_i / r]);
                let entry =
                    |u: usize, v: usize| n * (i * (a[u] + f[u]) * (a[v] + f[v]) + orbit * f[u] * f[v]);
                (Matrix2::new(entry(0, 0), entry(0, 1), entry(1, 0), entry(1, 1)), [0.0; 2])
            }
            (true, false) => {
                let (mass, takes) = one(p.rho_i);
                (Matrix2::new(mass, 0.0, 0.0, 0.0), [takes, 0.0])
            }
            (false, true) => {
                let (mass, takes) = one(-p.rho_e);
                (Matrix2::new(0.0, 0.0, 0.0, mass), [0.0, takes])
            }
            (false, false) => return None,
        })
    }

    /// The rates of the races jump by `more` (rad/s) as groups `those` cross a junction: the others follow. Whether they do.
    fn push(&mut self, more: [f64; 2], those: &[usize]) -> bool {
        if more == [0.0; 2] {
            return false;
        }
        for other in (0..self.groups.len()).filter(|other| !those.contains(other)) {
            if let Some((_, takes)) = self.turns_along(other) {
                self.y[HEAD + EACH * other + 2] += takes[0] * more[0] + takes[1] * more[1];
            }
        }
        self.y[2] += more[0];
        self.y[3] += more[1];
        true
    }

    /// Groups `those`, alike and in one state, pass from their place into `place` with the rates that keep energy and momenta.
    /// Whether the races jump.
    pub(super) fn cross(&mut self, those: &[usize], place: Place) -> bool {
        let Some(&g) = those.first() else { return false };
        let model = &self.groups[g].model;
        let mode = self.rhs.motions[g].mode;
        let own = state_of(&self.y, g);
        let [p, q] = [mode.place, place].map(|at| self.rhs.stands(g, at, self.t_s, &self.y, &own));
        let rates = self.rhs.goes(g, &mode, &p, &self.y, &own);
        let touching = mode.place == Place::Open;
        let held = Mode { place, inner: if touching { Grip::Slip(1.0) } else { mode.inner }, ..mode };
        let races = self.races_with_all_but(those);
        let times = those.len() as f64;
        let after = cross_between(model, times, &held, &p.point, &q.point, rates, &races);
        let pushed = self.push([after[2] - rates[2], after[3] - rates[3]], those);
        for &g in those {
            let at = HEAD + EACH * g;
            (self.y[at + 2], self.y[at + 3]) = (after[0], after[1]);
            self.rhs.motions[g].mode = held;
        }
        // A group that rolls follows its races.
        self.hold();
        pushed
    }
}
