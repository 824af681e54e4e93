//! Whole-number variables: every combination has a climb of its own, the one that leads all starts.
//!
//! Enumeration, not branch and bound: the least margin is no convex function, so no relaxation bounds it, and a clutch
//! has one or two numbers that are counts. Two climbs at a time begin at the best optimum so far, in the combinations where that point is
//! worth most. So an optimum of another combination that none of these climbs runs into is not found.

use super::desk::Desk;
use super::outcome::{Outcome, Refusal, Status};
use super::problem::ClutchProblem;
use super::starts::{Climbed, Optima, SearchMethod, climb_all, rank, rescued};
use crate::design::OptimizeVariable;
use crate::file::with_values;
use rayon::prelude::*;

/// Most combinations that are searched: a choice, some minutes of a usual clutch.
const MOST: usize = 64;

/// Combinations that are climbed in side by side, from the same point, on however many threads: more would know less of one another.
const SIDE_BY_SIDE: usize = 2;

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
    fn rank(&self, tolerance: f64) -> (f64, f64) {
        if self.violation <= tolerance { (0.0, -self.least_margin) } else { (self.violation, 0.0) }
    }

    fn tell(&mut self, best: &Outcome) {
        self.ended = Ok(best.status.clone());
        self.least_margin = best.evaluation.least_margin();
        self.violation = best.evaluation.violation();
    }
}

/// What became of all combinations.
pub(super) struct Led {
    /// Of the one that leads.
    pub climbed: Climbed,
    /// Its place.
    pub at: usize,
    /// Of all.
    pub evaluations: usize,
    pub derivatives: usize,
}

/// Best optimum of all combinations, from `x0` and, in the one that leads, from the points `felt_at` and from drawn ones.
///
/// # Errors
/// [`Refusal`] of the first climb where none began.
pub(super) fn lead<'a>(
    desk: &'a Desk,
    branches: &mut [(Branch, ClutchProblem)],
    x0: &[f64],
    felt_at: &[Vec<f64>],
    bounds: (&'a [f64], &'a [f64]),
    method: &'a SearchMethod,
) -> Result<Led, Refusal> {
    let all: Vec<usize> = (0..branches.len()).collect();
    let (x, refusal) = (x0.to_vec(), None);
    let mut survey = Survey { desk, bounds, method, x, best: None, refusal, evaluations: 0, derivatives: 0 };
    if all.len() == 1 {
        survey.x = rescued(desk, &branches[0].1, x0, bounds, method).unwrap_or_else(|| x0.to_vec());
        let climbed = climb_all(desk, &branches[0].1, &survey.x, felt_at, bounds, method)?;
        return Ok(survey.led(branches, 0, climbed));
    }
    survey.climb_each(branches, all.clone());
    let Some((at, outcome)) = survey.best.take() else {
        return Err(survey.refusal.unwrap_or(Refusal::StoppedAtStart));
    };
    if desk.stopped() {
        return Ok(survey.led(branches, at, Climbed::stopped_at(outcome)));
    }
    let surveyed = outcome.evaluation.least_margin();
    let climbed = climb_all(desk, &branches[at].1, &outcome.x, felt_at, bounds, method)?;
    // Another optimum in the one that leads may be worth more in the others, too.
    let another = Optima::are_apart(surveyed, climbed.best.evaluation.least_margin());
    if another && !desk.stopped() {
        survey.x.clone_from(&climbed.best.x);
        survey.best = Some((at, climbed.best.clone()));
        survey.climb_each(branches, all.into_iter().filter(|k| *k != at).collect());
        let overtaken = survey.best.take().filter(|(leader, _)| *leader != at);
        if let Some((leader, outcome)) = overtaken {
            survey.count(&mut branches[at].0, &climbed);
            if desk.stopped() {
                return Ok(survey.led(branches, leader, Climbed::stopped_at(outcome)));
            }
            let once = SearchMethod { starts: 1, most_starts: 1, swarm: None, ..method.clone() };
            let climbed = climb_all(desk, &branches[leader].1, &outcome.x, &[], bounds, &once)?;
            return Ok(survey.led(branches, leader, climbed));
        }
    }
    Ok(survey.led(branches, at, climbed))
}

/// Climbs, each in a combination of its own.
struct Survey<'a, 'd> {
    desk: &'a Desk<'d>,
    bounds: (&'a [f64], &'a [f64]),
    method: &'a SearchMethod,
    /// Where the next climb begins: the best optimum so far.
    x: Vec<f64>,
    /// That, and whose it is.
    best: Option<(usize, Outcome)>,
    refusal: Option<Refusal>,
    evaluations: usize,
    derivatives: usize,
}

impl Survey<'_, '_> {
    /// Climbs in each of `left`, as loosely as one of several.
    fn climb_each(&mut self, branches: &mut [(Branch, ClutchProblem)], mut left: Vec<usize>) {
        let settings = self.method.climb.loosely();
        while !left.is_empty() && !self.desk.stopped() {
            let next = self.most_promising(branches, &left);
            left.retain(|k| !next.contains(k));
            self.desk.begins("search of a whole number");
            let climb = |k: usize| {
                let problem = &branches[k].1;
                let begun = rescued(self.desk, problem, &self.x, self.bounds, self.method);
                let from = begun.unwrap_or_else(|| self.x.clone());
                self.desk.climb(problem, &from, self.bounds, &settings)
            };
            let ends = branches[next[0]].1.climbs.climbs(next.clone(), climb);
            for (k, end) in next.into_iter().zip(ends) {
                self.end(k, &mut branches[k].0, end, settings.violation_tolerance);
            }
        }
    }

    /// The climb in combination `k` has ended.
    fn end(&mut self, k: usize, branch: &mut Branch, end: Result<Outcome, Refusal>, tolerance: f64) {
        let outcome = match end {
            Ok(outcome) => outcome,
            Err(why) => {
                if branch.ended.is_err() {
                    branch.ended = Err(why.to_string());
                }
                self.refusal.get_or_insert(why);
                return;
            }
        };
        branch.evaluations += outcome.evaluations;
        self.evaluations += outcome.evaluations;
        self.derivatives += outcome.derivatives;
        let mine = rank(&outcome.evaluation, tolerance);
        if mine < branch.rank(tolerance) {
            branch.tell(&outcome);
        }
        if self.best.as_ref().is_none_or(|(_, b)| mine < rank(&b.evaluation, tolerance)) {
            self.x.clone_from(&outcome.x);
            self.best = Some((k, outcome));
        }
    }

    /// Those of `left` in which the best optimum so far is worth most, [`SIDE_BY_SIDE`] of them; the first before there is any.
    fn most_promising(&mut self, branches: &[(Branch, ClutchProblem)], left: &[usize]) -> Vec<usize> {
        if self.best.is_none() || left.len() <= SIDE_BY_SIDE {
            let at_once = if self.best.is_none() { 1 } else { SIDE_BY_SIDE };
            return left.iter().copied().take(at_once).collect();
        }
        self.evaluations += left.len();
        let tolerance = self.method.climb.violation_tolerance;
        let worth = |k: &usize| Some(rank(&self.desk.look(&branches[*k].1, &self.x).ok()?, tolerance));
        let ranks: Vec<_> = left.par_iter().map(worth).collect();
        let mut known: Vec<_> = left.iter().zip(ranks).collect();
        // Stable: of equal ones the earlier; those without margins last.
        known.sort_by(|a, b| match (a.1, b.1) {
            (Some(a), Some(b)) => a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)),
            (a, b) => b.is_some().cmp(&a.is_some()),
        });
        known.into_iter().take(SIDE_BY_SIDE).map(|(k, _)| *k).collect()
    }

    /// The end of it: `climbed` is of the one that leads.
    fn led(mut self, branches: &mut [(Branch, ClutchProblem)], at: usize, climbed: Climbed) -> Led {
        self.count(&mut branches[at].0, &climbed);
        Led { climbed, at, evaluations: self.evaluations, derivatives: self.derivatives }
    }

    /// The whole search of one that leads.
    fn count(&mut self, branch: &mut Branch, climbed: &Climbed) {
        branch.tell(&climbed.best);
        branch.evaluations += climbed.evaluations;
        self.evaluations += climbed.evaluations;
        self.derivatives += climbed.starts.iter().map(|s| s.derivatives).sum::<usize>();
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
