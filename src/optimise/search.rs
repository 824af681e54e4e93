//! The whole search on a design: influence, dropped variables, whole numbers one by one, climbs, the optimum looked at
//! again with everything that was left out on the way.

use super::branch::{Branch, branches, lead};
use super::desk::Desk;
use super::evaluate::NoEvaluation;
use super::influence::{Influence, influence, own_influence};
use super::outcome::{Outcome, Refusal, Status};
use super::price::{Price, prices};
use super::problem::{Assessment, ClutchProblem, Fidelity, Names};
use super::realise::is_centroid;
use super::starts::{ClimbRecord, Climbed, Optima, SearchMethod, idle_everywhere};
use crate::design::{Design, Objective, Optimize};
use crate::margin::Margin;

/// One design variable before and after.
#[derive(Debug, Clone, PartialEq)]
pub struct Variable {
    /// Name with its unit.
    pub name: String,
    /// Lower bound.
    pub min: f64,
    /// Upper bound.
    pub max: f64,
    /// Value in the given design.
    pub given: f64,
    /// Where the search started: that value, or the bound nearest to it where it lies outside.
    pub start: f64,
    /// Value found.
    pub best: f64,
    /// Dropped from the search because it moves no margin, at the start or at points spread over the box.
    pub dropped: bool,
}

impl Variable {
    /// Where it starts, nothing found yet.
    pub(super) fn at_start(v: &crate::design::OptimizeVariable) -> Self {
        Self {
            name: v.name.clone(),
            min: v.min,
            max: v.max,
            given: v.given,
            start: v.start,
            best: v.start,
            dropped: false,
        }
    }

    /// Where its value in the file lies outside its bounds: that, in words.
    pub fn outside(&self) -> Option<String> {
        (self.start != self.given).then(|| {
            format!(
                "{} is {} in the file, outside its bounds {} to {} in [optimize]",
                self.name, self.given, self.min, self.max
            )
        })
    }
}

/// Result of a search.
#[derive(Debug, Clone)]
pub struct Search {
    /// What was made better.
    pub aim: Objective,
    /// Variables in the order of the file.
    pub variables: Vec<Variable>,
    /// Names of objectives and limits.
    pub names: Names,
    /// Margins of the given design.
    pub start: Vec<Margin>,
    /// Margins of the design found, in full and at a tenth of the search's tolerance; behind those that the search had, what `check` asks
    /// of sprags off centre and unlike.
    pub best: Vec<Margin>,
    /// The same margins as the search had them.
    pub as_searched: Vec<Margin>,
    /// The objective before and after, in its own unit.
    pub objective: (f64, f64),
    /// Change of the objective when the optimum is evaluated in full at a tenth of the tolerance.
    pub objective_error: f64,
    /// Influence of every continuous variable at the start, margins per range.
    pub influence: Influence,
    /// Names of the variables of `influence`.
    pub continuous: Vec<String>,
    /// The same at the optimum; `None` where that was not reached.
    pub sensitivity: Option<Influence>,
    /// What a limit or bound costs at the optimum.
    pub prices: Vec<Price>,
    /// The best climb's own account; its vectors hold the variables that were not dropped and are no whole numbers.
    pub outcome: Outcome,
    /// Names of the variables of `outcome`.
    pub searched: Vec<String>,
    /// All climbs of the best branch.
    pub starts: Vec<ClimbRecord>,
    /// The optima that they met.
    pub optima: Optima,
    /// Whole numbers tried, if any.
    pub branches: Vec<Branch>,
    /// Design file of the optimum.
    pub file: String,
    /// The problem of the best branch, for what comes after.
    pub problem: ClutchProblem,
    /// Evaluations of the clutch in all.
    pub evaluations: usize,
    /// Derivatives of all margins along one variable beside them, each at 0.3 to 1.1 times the cost.
    pub derivatives: usize,
}

impl Search {
    /// Whether every margin of the design found is held.
    pub fn feasible(&self) -> bool {
        self.best.iter().all(|m| self.problem.held(m))
    }

    /// Codes of the margins that the design found does not hold.
    pub fn not_held(&self) -> Vec<String> {
        self.best.iter().filter(|m| !self.problem.held(m)).map(Margin::code).collect()
    }

    /// Whether every margin of the given design was held.
    pub fn start_feasible(&self) -> bool {
        self.start.iter().all(|m| self.problem.held(m))
    }

    /// Whether the objective is better than that of the given design.
    pub fn improved(&self) -> bool {
        (self.objective.1 - self.objective.0) * self.aim.sense() > 0.0
    }

    /// Whether the centroid was a free variable, so that no flanks are known that give it.
    pub fn wants_centroid(&self) -> bool {
        self.variables.iter().any(|v| is_centroid(&v.name))
    }

    /// Bounds of the variables of `outcome`.
    pub fn bounds(&self) -> (Vec<f64>, Vec<f64>) {
        bounds(&self.variables, &self.searched)
    }
}

/// Why a search did not begin.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoSearch {
    /// The design has no `[optimize]` table.
    #[error("the design has no [optimize] table")]
    NoTask,
    /// The given design cannot be evaluated.
    #[error("the given design cannot be evaluated: {0}")]
    Start(NoEvaluation),
    /// With variables that lie outside their bounds in the file, and not at those where the search is to start.
    #[error(
        "{}: the search starts at the nearest bound, where there is no clutch: {why}; to mend: move the bounds about the value in the \
         file, as far as the design may go", .outside.join("; ")
    )]
    Outside {
        /// Which variables, a sentence each.
        outside: Vec<String>,
        /// Why there is none.
        why: NoEvaluation,
    },
    /// The question was refused.
    #[error("{0}")]
    Refused(Refusal),
    /// What is asked beside the search is out of range, with what is allowed.
    #[error("{0}")]
    Asked(String),
    /// No variable is left that moves a margin.
    #[error("no variable moves any margin, so there is nothing to search: {}", .0.join(", "))]
    NothingMoves(Vec<String>),
    /// Stopped before anything was found.
    #[error("stopped before anything was found")]
    Stopped,
}

pub(super) fn refused(e: Refusal) -> NoSearch {
    match e {
        Refusal::StoppedAtStart => NoSearch::Stopped,
        other => NoSearch::Refused(other),
    }
}

/// Search from `design` as its `[optimize]` table says.
///
/// # Errors
/// [`NoSearch`]; not finding a feasible design is a status of the outcome.
pub fn search(
    design: &Design,
    method: &SearchMethod,
    fidelity: Fidelity,
    desk: &Desk,
) -> Result<Search, NoSearch> {
    let task = design.optimize.as_ref().ok_or(NoSearch::NoTask)?;
    let all: Vec<String> = task.variables.iter().map(|v| v.name.clone()).collect();
    let problem = ClutchProblem::new(design, task, all, fidelity);
    // What the search leaves as it is lies inside the bounds too.
    let inside: Vec<f64> = task.variables.iter().map(|v| v.start).collect();
    let outside = task.variables.iter().any(|v| v.start != v.given);
    let moved = outside.then(|| problem.file_at(&inside)).transpose();
    let moved = moved.map_err(|e| no_start(task, NoEvaluation::Refused(e.to_string())))?;
    let problem = moved.map_or(problem.clone(), |text| problem.on(text));
    search_problem(&problem, task, method, desk)
}

/// No clutch where the search is to start.
fn no_start(task: &Optimize, why: NoEvaluation) -> NoSearch {
    let outside: Vec<String> =
        task.variables.iter().filter_map(|v| Variable::at_start(v).outside()).collect();
    if outside.is_empty() { NoSearch::Start(why) } else { NoSearch::Outside { outside, why } }
}

/// Search over `task`'s variables on a problem that stands already: other goals, corners, or a changed file.
///
/// # Errors
/// As [`search`].
pub fn search_problem(
    whole: &ClutchProblem,
    task: &Optimize,
    method: &SearchMethod,
    desk: &Desk,
) -> Result<Search, NoSearch> {
    let mut variables: Vec<Variable> = task.variables.iter().map(Variable::at_start).collect();
    let x0: Vec<f64> = variables.iter().map(|v| v.start).collect();
    let start = whole.assess_at(&x0).map_err(|why| no_start(task, why))?;
    let mut evaluations = 1;
    let continuous: Vec<String> =
        task.variables.iter().filter(|v| !v.whole).map(|v| v.name.clone()).collect();
    let inner = whole.over(continuous.clone());
    // Nearly every variable of the profile moves what the flanks have left, and where that is enough it is no reason to climb.
    let rooms = whole.room_places(&start.rows);
    desk.begins("influence of the variables");
    let quick = inner.quickly();
    let table = if continuous.is_empty() {
        Influence::default()
    } else {
        let (lo, hi) = bounds(&variables, &continuous);
        let x = starts(&variables, &continuous);
        let own = desk
            .run(&quick, |quick, run| own_influence(quick, &x, &lo, &hi, &rooms, run))
            .map_err(refused)?;
        let by_differences =
            || desk.run(&inner, |inner, run| influence(inner, &x, &lo, &hi, &method.climb, run));
        own.map_or_else(by_differences, Ok).map_err(refused)?
    };
    evaluations += table.evaluations;
    let mut derivatives = table.derivatives;
    let (idle, felt_at, looked_at) = {
        let (lo, hi) = bounds(&variables, &continuous);
        let x = starts(&variables, &continuous);
        idle_everywhere(desk, &inner, table.without(&rooms), &x, (&lo, &hi), &rooms, method)
    };
    evaluations += looked_at;
    let idle: Vec<String> = idle.into_iter().map(|i| continuous[i].clone()).collect();
    variables.iter_mut().for_each(|v| v.dropped = idle.contains(&v.name));
    let kept =
        |x: Vec<f64>| x.into_iter().zip(&continuous).filter(|(_, n)| !idle.contains(n)).map(|(v, _)| v);
    let felt_at: Vec<Vec<f64>> = felt_at.into_iter().map(|x| kept(x).collect()).collect();
    let searched: Vec<String> = continuous.iter().filter(|n| !idle.contains(n)).cloned().collect();
    let whole_numbers: Vec<_> = task.variables.iter().filter(|v| v.whole).cloned().collect();
    if searched.is_empty() && whole_numbers.is_empty() {
        return Err(NoSearch::NothingMoves(continuous));
    }

    let x = starts(&variables, &searched);
    let (lo, hi) = bounds(&variables, &searched);
    // What was looked at for the influence is known to the climbs that are over the same variables.
    let mut looked_at = Some(quick).filter(|_| searched == continuous && whole_numbers.is_empty());
    let over = |(branch, problem): (Branch, ClutchProblem)| {
        (branch, looked_at.take().unwrap_or_else(|| problem.over(searched.clone()).quickly()))
    };
    let mut branches: Vec<_> = branches(whole, &whole_numbers).into_iter().map(over).collect();
    let led = lead(desk, &mut branches, &x, &felt_at, (&lo, &hi), method).map_err(refused)?;
    evaluations += led.evaluations;
    derivatives += led.derivatives;
    let Climbed { best: mut outcome, starts: climbs, optima, .. } = led.climbed;
    let problem = branches[led.at].1.clone();
    let (told, climbed): (Vec<Branch>, Vec<ClutchProblem>) = branches.into_iter().unzip();
    for v in &mut variables {
        if let Some(i) = searched.iter().position(|n| *n == v.name) {
            v.best = outcome.x[i];
        }
        if let Some((_, value)) = told[led.at].values.iter().find(|(n, _)| *n == v.name) {
            v.best = *value;
        }
    }
    let settled = matches!(outcome.status, Status::Converged | Status::Stalled(_)) && !searched.is_empty();
    let sensitivities = || {
        let own = desk.run(&problem, |problem, run| own_influence(problem, &outcome.x, &lo, &hi, &[], run));
        let by_differences = || {
            let whole = problem.fully();
            desk.run(&whole, |whole, run| influence(whole, &outcome.x, &lo, &hi, &method.climb, run)).ok()
        };
        own.ok().flatten().or_else(by_differences)
    };
    let again = |problem: &ClutchProblem| problem.assess_at(&outcome.x).map_err(NoSearch::Start);
    desk.begins(if settled { "sensitivities" } else { "optimum in full" });
    let (sensitivity, (best, as_searched)) = rayon::join(
        || {
            // What they remember takes milliseconds to give back.
            drop(climbed);
            settled.then(sensitivities).flatten()
        },
        || rayon::join(|| again(&problem.at_fidelity(problem.fidelity().sharper())), || again(&problem)),
    );
    let (mut best, as_searched) = (best?, as_searched?);
    evaluations += 2;
    evaluations += sensitivity.as_ref().map_or(0, |s| s.evaluations);
    derivatives += sensitivity.as_ref().map_or(0, |s| s.derivatives);
    let prices = match &sensitivity {
        Some(table) => prices(&problem, &best, &outcome, table, (&lo, &hi), &method.climb),
        None => Vec::new(),
    };
    // A slip margin that is raised is no limit of the climb: where the best of it is less than is wanted, no design is one.
    let short =
        best.rows.iter().filter(|m| problem.is_raised(m) && !problem.held(m)).map(|m| -problem.left(m));
    let short = short.fold(0.0, f64::max);
    if outcome.status == Status::Converged && short > 0.0 {
        let fighting = outcome.active.limits.clone();
        outcome.status = Status::Infeasible { least_violation: short, fighting };
    }
    best.rows.extend(problem.besides(&outcome.x));
    let file = problem
        .finished_file(&outcome.x)
        .map_err(|e| NoSearch::Start(NoEvaluation::Refused(e.to_string())))?;
    let value = |assessed: &Assessment| problem.value(assessed, 0);
    Ok(Search {
        aim: problem.goals()[0].objective,
        names: problem.names(&as_searched),
        objective: (value(&start), value(&best)),
        objective_error: (value(&best) - value(&as_searched)).abs(),
        start: as_checked(start.rows),
        best: as_checked(best.rows),
        as_searched: as_checked(as_searched.rows),
        influence: table,
        continuous,
        sensitivity,
        prices,
        outcome,
        searched,
        starts: climbs,
        optima,
        branches: told,
        file,
        problem,
        evaluations,
        derivatives,
        variables,
    })
}

fn starts(variables: &[Variable], names: &[String]) -> Vec<f64> {
    names.iter().filter_map(|n| variables.iter().find(|v| v.name == *n)).map(|v| v.start).collect()
}

fn bounds(variables: &[Variable], names: &[String]) -> (Vec<f64>, Vec<f64>) {
    let of = names.iter().filter_map(|n| variables.iter().find(|v| v.name == *n));
    of.map(|v| (v.min, v.max)).unzip()
}

/// Margins as `check` has them, for whoever reads them.
pub(super) fn as_checked(rows: Vec<Margin>) -> Vec<Margin> {
    rows.into_iter().map(Margin::as_checked).collect()
}
