//! Flanks for a free centroid, as programs read them.

use super::body::{Named, values};
use crate::margin::Margin;
use crate::optimise::Realised;
use serde::Serialize;

/// A margin in short.
#[derive(Debug, Clone, Serialize)]
pub struct CodeMargin {
    /// Code for scripts.
    pub code: String,
    /// Margin as a number; 0 or more is held.
    pub margin: f64,
}

/// Flanks for a free centroid.
#[derive(Debug, Clone, Serialize)]
pub struct Flanked {
    /// Whether the centroid is where the search wanted it.
    pub reached: bool,
    /// From there, mm.
    pub distance_mm: f64,
    /// Centroid wanted, mm.
    pub wanted_mm: [f64; 2],
    /// Centroid with these flanks, mm.
    pub centroid_mm: [f64; 2],
    /// The flanks.
    pub flanks: FlanksBody,
    /// Mass of a sprag with them, kg.
    pub mass_kg: f64,
    /// Its inertia, kg m^2.
    pub inertia_kg_m2: f64,
    /// The objective with them, all else as the search left it.
    pub objective: f64,
    /// Margins there.
    pub margins: Vec<CodeMargin>,
    /// The search with the flanks as variables in place of the centroid.
    pub searched_on: Option<SearchedOn>,
}

/// Flanks as the file has them.
#[derive(Debug, Clone, Serialize)]
pub struct FlanksBody {
    /// Rear half width, mm.
    pub rear_mm: f64,
    /// Front half width, mm.
    pub front_mm: f64,
    /// Lean of the rear flank.
    pub rear_tilt_rad: f64,
    /// Lean of the front flank.
    pub front_tilt_rad: f64,
}

/// The search with the flanks as variables.
#[derive(Debug, Clone, Serialize)]
pub struct SearchedOn {
    /// Values found.
    pub variables: Named,
    /// The objective, in its own unit.
    pub objective: f64,
    /// Whether every margin is held.
    pub feasible: bool,
    /// How it ended.
    pub status: &'static str,
    /// Evaluations of the clutch.
    pub evaluations: usize,
    /// Margins.
    pub margins: Vec<CodeMargin>,
}

fn codes(list: &[Margin]) -> Vec<CodeMargin> {
    list.iter().map(|m| CodeMargin { code: m.code(), margin: m.margin() }).collect()
}

impl Flanked {
    pub(super) fn of(r: &Realised) -> Self {
        let n = &r.nearest;
        let f = &n.flanks;
        let searched_on = r.searched.then_some(&r.made).map(|s| SearchedOn {
            variables: values(s, |v| v.best),
            objective: s.objective.1,
            feasible: s.feasible(),
            status: s.outcome.status.name(),
            evaluations: s.evaluations,
            margins: codes(&s.best),
        });
        Self {
            reached: n.reached(),
            distance_mm: n.distance_m * 1e3,
            wanted_mm: n.wanted_m.map(|v| v * 1e3),
            centroid_mm: n.mass.centroid_m.map(|v| v * 1e3),
            flanks: FlanksBody {
                rear_mm: f.rear_m * 1e3,
                front_mm: f.front_m * 1e3,
                rear_tilt_rad: f.rear_tilt_rad,
                front_tilt_rad: f.front_tilt_rad,
            },
            mass_kg: n.mass.mass_kg,
            inertia_kg_m2: n.mass.inertia_kg_m2,
            objective: r.objective,
            margins: codes(&r.assessed.rows),
            searched_on,
        }
    }
}
