//! Whole-number variables: every combination is a continuous search of its own.
//!
//! Enumeration, not branch and bound: the least margin is no convex function, so no relaxation bounds it, and a clutch
//! has one or two numbers that are counts.

use super::outcome::{Outcome, Refusal, Status};
use super::problem::ClutchProblem;
use crate::design::{OptimizeVariable, with_values};

/// Most combinations that are searched: a choice, some minutes of a usual clutch.
const MOST: usize = 64;

/// One combination of whole numbers, and what the search within it came to.
#[derive(Debug, Clone, PartialEq)]
pub struct Branch {
    /// Whole-number variables and their values.
    pub values: Vec<(String, f64)>,
    /// How the best climb ended, or why none began.
    pub ended: Result<Status, String>,
    /// Least margin.
    pub least_margin: f64,
    /// Largest violation.
    pub violation: f64,
    /// Evaluations spent.
    pub evaluations: usize,
}

impl Branch {
    pub(super) fn tell(&mut self, best: &Outcome, evaluations: usize) {
        self.ended = Ok(best.status.clone());
        self.least_margin = best.evaluation.least_margin();
        self.violation = best.evaluation.violation();
        self.evaluations = evaluations;
    }

    pub(super) fn refused(&mut self, why: &Refusal) {
        self.ended = Err(why.to_string());
    }
}

/// Every combination with its problem, from the given values outwards; one empty combination without whole numbers.
pub(super) fn branches(problem: &ClutchProblem, whole: &[OptimizeVariable]) -> Vec<(Branch, ClutchProblem)> {
    let mut combos: Vec<Vec<(String, f64)>> = vec![Vec::new()];
    for v in whole {
        let mut values: Vec<f64> = (0..=(v.max - v.min) as usize).map(|i| v.min + i as f64).collect();
        // The given value first, then its neighbours: each starts from the best of those before.
        values.sort_by(|a, b| (a - v.start).abs().total_cmp(&(b - v.start).abs()).then(a.total_cmp(b)));
        combos = combos
            .into_iter()
            .flat_map(|c| {
                values
                    .iter()
                    .map(move |x| c.iter().cloned().chain([(v.name.clone(), *x)]).collect())
                    .collect::<Vec<_>>()
            })
            .collect();
    }
    combos.truncate(MOST);
    combos
        .into_iter()
        .map(|values| {
            let named: Vec<(&str, f64)> = values.iter().map(|(n, x)| (n.as_str(), *x)).collect();
            // The names were checked with the file.
            let source =
                with_values(problem.source(), &named).unwrap_or_else(|_| problem.source().to_owned());
            let branch = Branch {
                values,
                ended: Err("not begun".to_owned()),
                least_margin: f64::NEG_INFINITY,
                violation: f64::INFINITY,
                evaluations: 0,
            };
            (branch, problem.on(source))
        })
        .collect()
}
