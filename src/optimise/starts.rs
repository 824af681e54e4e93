//! Several climbs side by side from a low-discrepancy set of starts, and the best of them.

use std::cmp::Ordering;

use super::desk::Desk;
use super::evaluate::Evaluation;
use super::influence::influence;
use super::outcome::{Outcome, Refusal, Status};
use super::problem::ClutchProblem;
use super::settings::Settings;
use super::swarm::swarm;
use crate::numeric::sobol::sobol;

/// First trust radius of a climb that begins near its optimum.
pub(super) const NEAR: f64 = 0.02;

/// Points tried for each start that is to have margins: a choice; most of a box is geometry that does not close.
const TRIES: usize = 24;

/// How the box is searched.
#[derive(Debug, Clone, PartialEq)]
pub struct SearchMethod {
    /// Of each climb.
    pub climb: Settings,
    /// Climbs: the first from the design as it is, the others from scrambled Sobol points. At least 1.
    pub starts: usize,
    /// As many climbs again, up to this many in all, as long as [`Optima`] lets expect optima that none has met.
    pub most_starts: usize,
    /// Evaluations of a particle swarm before one more climb from its best point; none: no swarm.
    pub swarm: Option<usize>,
    /// Seed of scrambling and swarm.
    pub seed: u64,
}

impl Default for SearchMethod {
    fn default() -> Self {
        Self { climb: Settings::default(), starts: 1, most_starts: 1, swarm: None, seed: 1 }
    }
}

impl SearchMethod {
    /// For a search that begins at the optimum of another: one climb, where the number of climbs was left open.
    pub(super) fn carried_on(&self) -> Self {
        let starts = if self.most_starts > self.starts { 1 } else { self.starts };
        Self { starts, most_starts: starts, ..self.clone() }
    }
}

/// Optima that climbs from random starts have met, and how many there may be.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Optima {
    /// Climbs that converged within the limits.
    pub climbs: usize,
    /// Different ones among their ends, by the least margin.
    pub seen: usize,
}

impl Optima {
    /// Least margins that lie nearer together are one optimum: a part of the larger.
    const APART: f64 = 1e-3;
    /// The same where they are near 0; they are scaled to be of order one, and climbs of several end some 2e-5 below their optimum.
    const NEAR_ZERO: f64 = 1e-4;

    fn of(starts: &[ClimbRecord], tolerance: f64) -> Self {
        let within = starts.iter().filter(|s| s.ended == Ok(Status::Converged) && s.violation <= tolerance);
        let mut found: Vec<f64> = within.map(|s| s.least_margin).collect();
        found.sort_by(f64::total_cmp);
        let seen =
            found.windows(2).filter(|w| Self::are_apart(w[0], w[1])).count() + usize::from(!found.is_empty());
        Self { climbs: found.len(), seen }
    }

    /// Whether two optima of these least margins are two.
    pub(super) fn are_apart(a: f64, b: f64) -> bool {
        (a - b).abs() > (Self::APART * a.abs().max(b.abs())).max(Self::NEAR_ZERO)
    }

    /// How many optima there are, as w met by n climbs let expect: w (n - 1)/(n - w - 2); `None` where they are too few.
    /// Boender and Rinnooy Kan, Bayesian stopping rules for multistart global optimization methods, Math. Prog. 37 (1987).
    pub fn expected(&self) -> Option<f64> {
        let (n, w) = (self.climbs as f64, self.seen as f64);
        (n > w + 2.0).then(|| w * (n - 1.0) / (n - w - 2.0))
    }

    /// Whether no other is to be expected. Without any design within the limits nothing is known, and nothing more asked.
    pub fn enough(&self) -> bool {
        self.climbs == 0 || self.expected().is_some_and(|e| e <= self.seen as f64 + 0.5)
    }
}

/// One climb of several.
#[derive(Debug, Clone, PartialEq)]
pub struct ClimbRecord {
    /// Where it came from: `design`, `point 3`, `swarm`, `level variable` (where one is felt that is not at the design).
    pub from: String,
    /// How it ended, or why it did not begin.
    pub ended: Result<Status, String>,
    /// Least margin there, as the climb has it; of the optimum met earlier into whose basin it ran, where it was ended for that.
    pub least_margin: f64,
    /// Largest violation there.
    pub violation: f64,
    /// Evaluations spent, those of a swarm included.
    pub evaluations: usize,
    /// Derivatives along one variable beside them.
    pub derivatives: usize,
}

impl ClimbRecord {
    fn of(end: &Outcome) -> Self {
        Self {
            from: String::new(),
            ended: Ok(end.status.clone()),
            least_margin: end.joined.unwrap_or(end.evaluation.least_margin()),
            violation: end.evaluation.violation(),
            evaluations: end.evaluations,
            derivatives: end.derivatives,
        }
    }
}

/// What became of a box.
#[derive(Debug, Clone)]
pub(super) struct Climbed {
    pub best: Outcome,
    pub starts: Vec<ClimbRecord>,
    pub optima: Optima,
    pub evaluations: usize,
}

impl Climbed {
    /// Of a search that was stopped before it went on from `best`, whose evaluations count elsewhere.
    pub fn stopped_at(best: Outcome) -> Self {
        let mut start = ClimbRecord { from: "design".to_owned(), ..ClimbRecord::of(&best) };
        (start.evaluations, start.derivatives) = (0, 0);
        let best = Outcome { status: Status::Interrupted, ..best };
        Self { best, starts: vec![start], optima: Optima::default(), evaluations: 0 }
    }
}

/// Rank of a point: less is better. Feasible by the least margin, else by the violation.
pub(super) fn rank(e: &Evaluation, tolerance: f64) -> (f64, f64) {
    let violation = e.violation();
    if violation <= tolerance { (0.0, -e.least_margin()) } else { (violation, 0.0) }
}

/// Best of all climbs in the box, from `x0`, from the points `felt_at` and from drawn ones; each climb's path depends on its own start alone, so
/// neither the number of threads nor the order in which they end matters.
///
/// # Errors
/// [`Refusal`] of the climb from the design where none of the others began either.
pub(super) fn climb_all(
    desk: &Desk,
    problem: &ClutchProblem,
    x0: &[f64],
    felt_at: &[Vec<f64>],
    (lo, hi): (&[f64], &[f64]),
    method: &SearchMethod,
) -> Result<Climbed, Refusal> {
    let tolerance = method.climb.violation_tolerance;
    let several = method.most_starts.max(method.starts) > 1 || !felt_at.is_empty() || method.swarm.is_some();
    let settings = if several { method.climb.loosely() } else { method.climb.clone() };
    let mut from_box = Points { next: 0, spent: 0 };
    let mut spent_on_swarm = 0;
    // Margins go along where they are known: a climb that is stopped before it begins still has its start.
    let mut named = vec![("design".to_owned(), x0.to_vec(), None)];
    named.extend(felt_at.iter().map(|x| ("level variable".to_owned(), x.clone(), None)));
    if let Some(evaluations) = method.swarm {
        desk.begins("particle swarm");
        let settings = &method.climb;
        let found = desk.run(problem, |problem, run| {
            swarm(problem, (x0, lo, hi), settings, (evaluations, method.seed), run)
        });
        if let Some(found) = found {
            spent_on_swarm = found.evaluations;
            named.push(("swarm".to_owned(), found.x, Some(found.evaluation)));
        }
    }
    let mut found = Found { tolerance, starts: Vec::new(), best: None, refusal: None, ends: Vec::new() };
    let climb = |named: &mut Vec<(String, Vec<f64>, Option<Evaluation>)>, found: &mut Found| {
        desk.begins("search");
        // Those that were known before any of them began, so that none depends on which ends first.
        let met = found.ends.clone();
        let climb = |(from, x, known): (String, Vec<f64>, Option<Evaluation>)| {
            let outcome = desk.climb_beside(problem, &x, (lo, hi), &settings, &met);
            let outcome = match (outcome, known) {
                (Err(Refusal::StoppedAtStart), Some(known)) => Ok(Outcome::stopped_at(x, known)),
                (outcome, _) => outcome,
            };
            (from, outcome)
        };
        let outcomes = problem.climbs.climbs(std::mem::take(named), climb);
        outcomes.into_iter().for_each(|(from, outcome)| found.add(from, outcome));
    };
    let wanted_of = |drawn: usize| {
        (method.starts.max(1) - usize::from(drawn == 0))
            .min(method.most_starts.max(method.starts) - 1 - drawn)
    };
    // What the others are for is to find further optima: the design comes first, while points for them are looked for.
    let mut drawn = 0;
    let ((), mut points) = rayon::join(
        || climb(&mut named, &mut found),
        || from_box.draw(desk, problem, (lo, hi), wanted_of(0), method),
    );
    loop {
        let wanted = wanted_of(drawn);
        if desk.stopped() || wanted == 0 {
            break;
        }
        let none_left = points.is_empty();
        let name = |i: usize| format!("point {}", drawn + i + 1);
        named.extend(points.into_iter().enumerate().map(|(i, (x, e))| (name(i), x, Some(e))));
        drawn += wanted;
        climb(&mut named, &mut found);
        let optima = Optima::of(&found.starts, tolerance);
        if optima.enough() || drawn + 1 >= method.most_starts || none_left || desk.stopped() {
            break;
        }
        points = from_box.draw(desk, problem, (lo, hi), wanted_of(drawn), method);
    }
    // Before the best of them is finished: all have ended alike.
    let optima = Optima::of(&found.starts, tolerance);
    if several && !desk.stopped() {
        desk.begins("finish");
        found.finish(|x| {
            desk.climb(problem, x, (lo, hi), &Settings { first_radius: NEAR, ..method.climb.clone() })
        });
    }
    let Found { starts, best, refusal, .. } = found;
    let spent_on_points = from_box.spent + spent_on_swarm;
    let evaluations = spent_on_points + starts.iter().map(|s| s.evaluations).sum::<usize>();
    match (best, refusal) {
        (Some((_, best)), _) => {
            // The best climb may have come to its end; the search of the box has not.
            let status = if desk.stopped() { Status::Interrupted } else { best.status.clone() };
            Ok(Climbed { best: Outcome { status, ..best }, starts, optima, evaluations })
        }
        (None, Some(why)) => Err(why),
        (None, None) => Err(Refusal::StoppedAtStart),
    }
}

/// What the climbs so far have found.
struct Found {
    tolerance: f64,
    starts: Vec<ClimbRecord>,
    /// With its place among `starts`.
    best: Option<(usize, Outcome)>,
    refusal: Option<Refusal>,
    /// Ends of climbs that converged within the limits, each with its least margin.
    ends: Vec<(Vec<f64>, f64)>,
}

impl Found {
    fn is_better(&self, a: &Outcome, b: &Outcome) -> bool {
        rank(&a.evaluation, self.tolerance) < rank(&b.evaluation, self.tolerance)
    }

    /// The best climb, carried on to its end by `climb`.
    fn finish(&mut self, climb: impl Fn(&[f64]) -> Result<Outcome, Refusal>) {
        let Some((at, before)) = self.best.take() else { return };
        let Ok(mut end) = climb(&before.x) else {
            self.best = Some((at, before));
            return;
        };
        for iteration in &mut end.history {
            iteration.evaluations += before.evaluations;
            iteration.failures += before.failures;
        }
        end.history.splice(0..0, before.history);
        end.evaluations += before.evaluations;
        end.derivatives += before.derivatives;
        end.failures += before.failures;
        self.starts[at] = ClimbRecord { from: self.starts[at].from.clone(), ..ClimbRecord::of(&end) };
        self.best = Some((at, end));
    }

    fn add(&mut self, from: String, outcome: Result<Outcome, Refusal>) {
        match outcome {
            Ok(o) => {
                let within = o.evaluation.violation() <= self.tolerance;
                if o.status == Status::Converged && within && o.joined.is_none() {
                    self.ends.push((o.x.clone(), o.evaluation.least_margin()));
                }
                self.starts.push(ClimbRecord { from, ..ClimbRecord::of(&o) });
                let better = self.best.as_ref().is_none_or(|(_, b)| self.is_better(&o, b));
                if better {
                    self.best = Some((self.starts.len() - 1, o));
                }
            }
            Err(why) => {
                self.starts.push(ClimbRecord {
                    from,
                    ended: Err(why.to_string()),
                    least_margin: f64::NEG_INFINITY,
                    violation: f64::INFINITY,
                    evaluations: 1,
                    derivatives: 0,
                });
                self.refusal.get_or_insert(why);
            }
        }
    }
}

/// The sequence of points that starts are drawn from.
struct Points {
    /// Index of the next in the Sobol sequence.
    next: u32,
    /// Evaluations spent on looking.
    spent: usize,
}

impl Points {
    /// The next `wanted` points of the box at which there are margins.
    fn draw(
        &mut self,
        desk: &Desk,
        problem: &ClutchProblem,
        (lo, hi): (&[f64], &[f64]),
        wanted: usize,
        method: &SearchMethod,
    ) -> Vec<(Vec<f64>, Evaluation)> {
        let mut found = Vec::new();
        if wanted == 0 {
            return found;
        }
        desk.begins("starting points");
        let last = self.next + (wanted * TRIES) as u32;
        desk.run(problem, |problem, run| {
            let mut memo = super::journal::Memo::new(problem, run, usize::MAX);
            while found.len() < wanted && self.next < last {
                let some: Vec<Vec<f64>> = (self.next..self.next + wanted as u32)
                    .map(|i| {
                        let share = |d: usize| sobol(u64::from(i), d, method.seed);
                        (0..lo.len()).map(|d| lo[d] + share(d) * (hi[d] - lo[d])).collect()
                    })
                    .collect();
                self.next += wanted as u32;
                let Ok(outcomes) = memo.batch(some.clone()) else {
                    // Stopped: what is known of the batch is given all the same.
                    found = memo.known().map(|(x, e)| (x.clone(), e.clone())).collect();
                    found.sort_by(|a, b| {
                        rank(&a.1, 0.0).partial_cmp(&rank(&b.1, 0.0)).unwrap_or(Ordering::Equal)
                    });
                    break;
                };
                found.extend(some.into_iter().zip(outcomes).filter_map(|(x, o)| Some((x, o.ok()?))));
            }
            self.spent += memo.evaluations();
        });
        found.truncate(wanted);
        found
    }
}

/// Points at which a variable that moves nothing at the start is looked at again: as many as there are usually starts beside
/// the design.
const LOOKED_AT: usize = 7;
/// Such variables that are put to their ends together: a choice, eight corners.
const TOGETHER: usize = 3;

/// Those of the variables `idle`, without influence at the start `x0`, that have none elsewhere either: with them at
/// their ends, and at points spread over the box; the points at which one of the others is felt, from which to climb as well,
/// because nothing draws a climb from the start there; and the evaluations that this took. Limits at the places `but` do not count.
pub(super) fn idle_everywhere(
    desk: &Desk,
    problem: &ClutchProblem,
    mut idle: Vec<usize>,
    x0: &[f64],
    (lo, hi): (&[f64], &[f64]),
    but: &[usize],
    method: &SearchMethod,
) -> (Vec<usize>, Vec<Vec<f64>>, usize) {
    let mut felt_at = Vec::new();
    if idle.is_empty() {
        return (idle, felt_at, 0);
    }
    let mut points = Points { next: 0, spent: 0 };
    // The same points whatever the seed: this is no draw.
    let unseeded = SearchMethod { seed: 0, ..method.clone() };
    let mut spent = 0;
    let level = idle.clone();
    // A junction or an arc may be felt near one end of its range only, and only together with another.
    let ends = (0..1_usize << level.len().min(TOGETHER)).map(|corner| {
        let mut x = x0.to_vec();
        for (bit, &i) in level.iter().take(TOGETHER).enumerate() {
            x[i] = if corner >> bit & 1 == 0 { lo[i] } else { hi[i] };
        }
        (x, true)
    });
    let drawn = points.draw(desk, problem, (lo, hi), LOOKED_AT, &unseeded);
    for (x, is_end) in ends.chain(drawn.into_iter().map(|(x, _)| (x, false))) {
        if desk.stopped() || (!is_end && idle.is_empty()) {
            break;
        }
        // The others have no range, so that no difference is taken along them.
        let only_level = |bounds: &[f64]| -> Vec<f64> {
            (0..x.len()).map(|i| if level.contains(&i) { bounds[i] } else { x[i] }).collect()
        };
        let (lo, hi) = (only_level(lo), only_level(hi));
        let found = desk.run(problem, |problem, run| influence(problem, &x, &lo, &hi, &method.climb, run));
        let Ok(table) = found else {
            // No margins here.
            spent += 1;
            continue;
        };
        spent += table.evaluations;
        let without = table.without(but);
        if level.iter().any(|i| !without.contains(i)) {
            felt_at.push(x.clone());
        }
        idle.retain(|i| without.contains(i));
    }
    (idle, felt_at, spent + points.spent)
}

/// A start with margins near `x0`: `x0` itself, or the best of some points of the box.
pub(super) fn rescued(
    desk: &Desk,
    problem: &ClutchProblem,
    x0: &[f64],
    bounds: (&[f64], &[f64]),
    method: &SearchMethod,
) -> Option<Vec<f64>> {
    use super::evaluate::Evaluate;
    if problem.evaluate(x0).is_ok() {
        return Some(x0.to_vec());
    }
    Points { next: 0, spent: 0 }.draw(desk, problem, bounds, 4, method).into_iter().next().map(|(x, _)| x)
}
