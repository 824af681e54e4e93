//! A design within its tolerances, as programs read it.

use super::Story;
use super::body::Named;
use crate::optimise::{Robust, RobustSearch, Spread};
use serde::Serialize;

/// A figure over the tolerances.
#[derive(Debug, Clone, Serialize)]
pub struct CourseBody {
    /// As drawn.
    pub nominal: f64,
    /// At the worst corner.
    pub worst: f64,
    /// 1st percentile of the draws.
    pub p01: f64,
    /// 5th percentile.
    pub p05: f64,
    /// 50th percentile.
    pub p50: f64,
}

/// A margin over the tolerances.
#[derive(Debug, Clone, Serialize)]
pub struct MadeRow {
    /// Its code.
    pub code: String,
    /// Its figures.
    #[serde(flatten)]
    pub course: CourseBody,
    /// Corner at which it is worst.
    pub worst_at: String,
}

/// A limit that does not hold at some corner.
#[derive(Debug, Clone, Serialize)]
pub struct NotHeldAt {
    /// Its code.
    pub code: String,
    /// The corner where it is worst.
    pub worst_at: String,
}

/// A design as it may be made.
#[derive(Debug, Clone, Serialize)]
pub struct MadeBody {
    /// The objective, in its own unit.
    pub objective: CourseBody,
    /// Margins.
    pub margins: Vec<MadeRow>,
    /// Corners looked at.
    pub corners: usize,
    /// Draws.
    pub draws: usize,
    /// Draws at which the clutch cannot be put together.
    pub impossible_draws: usize,
    /// Limits that do not hold everywhere.
    pub not_held: Vec<NotHeldAt>,
    /// Corners at which the clutch cannot be put together.
    pub impossible_corners: Vec<String>,
    /// Seed of the draws.
    pub seed: u64,
    /// Share of the draws at which every limit holds.
    #[serde(rename = "yield")]
    pub yield_share: f64,
    /// Whether every limit holds at every corner.
    pub held: bool,
}

/// The design that holds at every corner, or comes as near as it can.
#[derive(Debug, Clone, Serialize)]
pub struct RobustFound {
    /// Values of the variables.
    pub variables: Named,
    /// How the search ended.
    pub ended: &'static str,
    /// Corners that were limits.
    pub held_at: Vec<String>,
    /// Rounds of the search.
    pub rounds: usize,
    /// Step of its lengths, mm; null where they are in none.
    pub step_mm: Option<f64>,
    /// Evaluations of the clutch.
    pub evaluations: usize,
    /// Derivatives along one variable beside them.
    pub derivatives: usize,
    /// As it may be made.
    pub made: MadeBody,
}

impl MadeBody {
    pub(super) fn of(r: &Robust) -> Self {
        let course = |nominal, worst, [p01, p05, p50]: [f64; 3]| CourseBody { nominal, worst, p01, p05, p50 };
        let row = |s: &Spread| MadeRow {
            code: s.code.clone(),
            course: course(s.nominal, s.worst, s.percentiles),
            worst_at: s.worst_at.clone(),
        };
        let (nominal, worst, percentiles) = r.objective;
        let not_held =
            r.not_held.iter().map(|(code, at)| NotHeldAt { code: code.clone(), worst_at: at.clone() });
        Self {
            objective: course(nominal, worst, percentiles),
            margins: r.spreads.iter().map(row).collect(),
            corners: r.corners,
            draws: r.draws.0,
            impossible_draws: r.draws.1,
            not_held: not_held.collect(),
            impossible_corners: r.impossible.clone(),
            seed: r.seed,
            yield_share: r.yield_share,
            held: r.held(),
        }
    }
}

impl RobustFound {
    pub(super) fn of(story: &Story, r: &RobustSearch) -> Self {
        Self {
            variables: story.made().searched.iter().cloned().zip(r.x.iter().copied()).collect(),
            ended: story.robust_status(r).name(),
            held_at: r.held_at.clone(),
            rounds: r.rounds,
            step_mm: r.step,
            evaluations: r.evaluations,
            derivatives: r.derivatives,
            made: MadeBody::of(&r.made),
        }
    }
}
