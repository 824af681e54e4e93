//! Rows of sprags one by one: what `check` asks beside what a search holds.

use super::ClutchProblem;
use crate::design::Design;
use crate::follow::Follow;
use crate::margin::{Capacities, LoadState, Margin, load_state, single_sprag_margins};

impl ClutchProblem {
    /// Required rows of sprags off centre and unlike.
    pub(super) fn rows_of_sprags(&self, design: &Design, state: &LoadState) -> Vec<Margin> {
        let (mut rows, _) =
            single_sprag_margins(design, &self.limits, Capacities::LeftOut, state, &Follow::nobody());
        rows.retain(|m| m.required);
        rows
    }

    /// Whether the row is one of [`Self::besides`]: held as `check` has it, without the reserve, which is what it lives on.
    pub(in crate::optimise) fn is_beside(&self, m: &Margin) -> bool {
        !self.as_checked && m.of_single_sprags()
    }

    /// The same at `x` where the design has such sprags and the problem does not hold them: a search is too dear with them.
    pub(in crate::optimise) fn besides(&self, x: &[f64]) -> Vec<Margin> {
        let has = |design: &Design| design.clutch.races.eccentricity.is_some() || design.sharing.is_some();
        let Some(design) = self.design_at(x).ok().filter(|design| !self.as_checked && has(design)) else {
            return Vec::new();
        };
        load_state(&design).map_or_else(|_| Vec::new(), |state| self.rows_of_sprags(&design, &state))
    }
}
