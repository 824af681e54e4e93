//! Several climbs side by side from a low-discrepancy set of starts, and the best of them.

use rayon::prelude::*;

use super::desk::Desk;
use super::evaluate::Evaluation;
use super::outcome::{Outcome, Refusal, Status};
use super::problem::ClutchProblem;
use super::settings::Settings;
use super::swarm::swarm;

/// Points tried for each start that is to have margins: a choice; most of a box is geometry that does not close.
const TRIES: usize = 24;

/// How the box is searched.
#[derive(Debug, Clone, PartialEq)]
pub struct Method {
    /// Of each climb.
    pub climb: Settings,
    /// Climbs: the first from the design as it is, the others from scrambled Sobol points. At least 1.
    pub starts: usize,
    /// Evaluations of a particle swarm before one more climb from its best point; none: no swarm.
    pub swarm: Option<usize>,
    /// Seed of scrambling and swarm.
    pub seed: u64,
}

impl Default for Method {
    fn default() -> Self {
        Self { climb: Settings::default(), starts: 1, swarm: None, seed: 1 }
    }
}

/// One climb of several.
#[derive(Debug, Clone, PartialEq)]
pub struct Start {
    /// Where it came from: `design`, `point 3`, `swarm`.
    pub from: String,
    /// How it ended, or why it did not begin.
    pub ended: Result<Status, String>,
    /// Least margin there, as the climb has it.
    pub least_margin: f64,
    /// Largest violation there.
    pub violation: f64,
    /// Evaluations spent, those of a swarm included.
    pub evaluations: usize,
}

/// What became of a box.
#[derive(Debug, Clone)]
pub(super) struct Climbed {
    pub best: Outcome,
    pub starts: Vec<Start>,
    pub evaluations: usize,
}

/// Rank of a point: less is better. Feasible by the least margin, else by the violation.
pub(super) fn rank(e: &Evaluation, tolerance: f64) -> (f64, f64) {
    let violation = e.violation();
    if violation <= tolerance { (0.0, -e.least_margin()) } else { (violation, 0.0) }
}

/// Best of all climbs in the box; each climb's path depends on its own start alone, so neither the number of threads nor
/// the order in which they end matters.
///
/// # Errors
/// [`Refusal`] of the climb from the design where none of the others began either.
pub(super) fn climb_all(
    desk: &Desk,
    problem: &ClutchProblem,
    x0: &[f64],
    (lo, hi): (&[f64], &[f64]),
    method: &Method,
) -> Result<Climbed, Refusal> {
    let others = method.starts.saturating_sub(1);
    let points = starting_points(desk, problem, (lo, hi), others, method);
    let mut spent_on_points = points.1;
    let mut named: Vec<(String, Vec<f64>)> = vec![("design".to_owned(), x0.to_vec())];
    named.extend(points.0.into_iter().enumerate().map(|(i, x)| (format!("point {}", i + 1), x)));
    if let Some(evaluations) = method.swarm {
        desk.begins("particle swarm");
        let settings = &method.climb;
        let found = desk.run(problem, |problem, run| {
            swarm(problem, (x0, lo, hi), settings, (evaluations, method.seed), run)
        });
        if let Some(found) = found {
            spent_on_points += found.evaluations;
            named.push(("swarm".to_owned(), found.x));
        }
    }
    desk.begins("search");
    let outcomes: Vec<(String, Result<Outcome, Refusal>)> = named
        .into_par_iter()
        .map(|(from, x)| (from, desk.climb(problem, &x, (lo, hi), &method.climb)))
        .collect();
    let mut starts = Vec::with_capacity(outcomes.len());
    let mut best: Option<Outcome> = None;
    let mut refusal = None;
    let tolerance = method.climb.violation_tolerance;
    for (from, outcome) in outcomes {
        match outcome {
            Ok(o) => {
                starts.push(Start {
                    from,
                    ended: Ok(o.status.clone()),
                    least_margin: o.evaluation.least_margin(),
                    violation: o.evaluation.violation(),
                    evaluations: o.evaluations,
                });
                let better = best
                    .as_ref()
                    .is_none_or(|b| rank(&o.evaluation, tolerance) < rank(&b.evaluation, tolerance));
                if better {
                    best = Some(o);
                }
            }
            Err(why) => {
                let ended = Err(why.to_string());
                starts.push(Start {
                    from,
                    ended,
                    least_margin: f64::NEG_INFINITY,
                    violation: f64::INFINITY,
                    evaluations: 1,
                });
                refusal.get_or_insert(why);
            }
        }
    }
    let evaluations = spent_on_points + starts.iter().map(|s| s.evaluations).sum::<usize>();
    match (best, refusal) {
        (Some(best), _) => Ok(Climbed { best, starts, evaluations }),
        (None, Some(why)) => Err(why),
        (None, None) => Err(Refusal::StoppedAtStart),
    }
}

/// `wanted` points of the box at which there are margins, and evaluations spent on looking.
fn starting_points(
    desk: &Desk,
    problem: &ClutchProblem,
    (lo, hi): (&[f64], &[f64]),
    wanted: usize,
    method: &Method,
) -> (Vec<Vec<f64>>, usize) {
    let mut found = Vec::new();
    let mut spent = 0;
    if wanted == 0 {
        return (found, spent);
    }
    desk.begins("starting points");
    desk.run(problem, |problem, run| {
        let mut memo = super::journal::Memo::new(problem, run, usize::MAX);
        let scramble = method.seed as u32 ^ (method.seed >> 32) as u32;
        let mut index = 0;
        while found.len() < wanted && index < (wanted * TRIES) as u32 {
            let some: Vec<Vec<f64>> = (index..index + wanted as u32)
                .map(|i| {
                    let share = |d: usize| f64::from(sobol_burley::sample(i, d as u32, scramble));
                    (0..lo.len()).map(|d| lo[d] + share(d) * (hi[d] - lo[d])).collect()
                })
                .collect();
            index += wanted as u32;
            let Ok(outcomes) = memo.batch(some.clone()) else { break };
            found.extend(some.into_iter().zip(outcomes).filter(|(_, o)| o.is_ok()).map(|(x, _)| x));
        }
        spent = memo.evaluations();
    });
    found.truncate(wanted);
    (found, spent)
}

/// A start with margins near `x0`: `x0` itself, or the best of some points of the box.
pub(super) fn rescued(
    desk: &Desk,
    problem: &ClutchProblem,
    x0: &[f64],
    bounds: (&[f64], &[f64]),
    method: &Method,
) -> Option<Vec<f64>> {
    use super::evaluate::Evaluate;
    if problem.evaluate(x0).is_ok() {
        return Some(x0.to_vec());
    }
    starting_points(desk, problem, bounds, 4, method).0.into_iter().next()
}
