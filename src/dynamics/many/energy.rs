//! Energy of all sprags, races, axis and rings.

use super::bending::Bent;
use super::rhs::Rhs;
use super::state_of;
use crate::dynamics::model::Place;

impl Rhs<'_> {
    /// Rolling rates put in exactly, and the energy in motion and stored but for the contacts, J.
    pub(super) fn energy_j(&self, t: f64, y: &[f64]) -> f64 {
        let races = &self.groups[0].model;
        let own = |g: usize| self.energy_of_j(g, t, y);
        let axis = self.axes.map_or(0.0, |axes| axes.energy_j(axes.shift(y, self.groups.len())).0);
        let rings = self.bent(y, Bent::rings_j).unwrap_or(0.0);
        (0..self.groups.len()).map(own).sum::<f64>()
            + 0.5 * races.inner_inertia_kg_m2 * y[2] * y[2]
            + 0.5 * races.outer_inertia_kg_m2 * y[3] * y[3]
            + 0.5 * races.loads.abutment_nm_per_rad * y[1] * y[1]
            + axis
            + rings
    }

    /// Energy of group `g` from first contact on, J; none while it waits.
    pub(super) fn energy_of_j(&self, g: usize, t: f64, y: &[f64]) -> f64 {
        let (model, motion) = (&self.groups[g].model, &self.motions[g]);
        if motion.waits {
            return 0.0;
        }
        let own = state_of(y, g);
        let sight = self.stands(g, motion.mode.place, t, y, &own);
        let [da, dp, ..] = self.goes(g, &motion.mode, &sight, y, &own);
        let mut alone = own;
        alone[3] = 0.0;
        let moves = model.energy_without_wedge(&sight.point, &[da, dp, 0.0, 0.0], &alone);
        let touch = model.curve.first_contact_rad();
        let Some(beside) = self.bent(y, |bent| bent.beside_j(g)) else {
            return moves + model.wedge_energy_j(touch, own[0]);
        };
        // A sprag may be open beyond first contact, and pressed before it.
        moves
            + match motion.mode.place {
                Place::Carried => model.open_energy_j(touch, own[0]),
                _ if own[0] < touch => model.open_energy_j(touch, own[0]) + model.count * beside,
                Place::Open if model.curve.speed_rad_s() == 0.0 => 0.0,
                _ => model.wedge_energy_j(touch, own[0]) + model.count * beside,
            }
    }
}
