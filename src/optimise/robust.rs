//! Margins of a design as it may be made, and a design that holds its limits at every corner.
//!
//! Monte Carlo draws each quantity evenly over its range. The robust search is the cutting-set method (Mutapcic and Boyd,
//! Optim. Methods Softw. 24 (2009) 381): climb at a few corners, find those that are worse, add them, climb again. Between its
//! rounds what a corner takes from the margins is followed by its slopes, so that a climb costs what it costs without
//! tolerances; all corners are evaluated in the end, and where some margin is not held there, or lower than at the corners of
//! the set, climbs at the corners themselves follow.

use rayon::prelude::*;

use super::corner::{Corner, corners, half_ranges};
use super::desk::Desk;
use super::evaluate::{Evaluation, NoEvaluation};
use super::grid::points_near;
use super::near_corners::{NearCorners, climb_on_slopes};
use super::outcome::{Cause, Status};
use super::problem::{ClutchProblem, Names};
use super::search::{NoSearch, refused};
use super::settings::Settings;
use super::starts::{NEAR as NEAR_END, SearchMethod};
use crate::clutch::Tolerances;
use crate::margin::RESOLUTION;

/// Limits farther away than this need no corner of their own: a choice; each corner is a whole evaluation more.
const NEAR: f64 = 0.2;
/// Rounds of the cutting-set method: a choice; the set settles in two or three.
const ROUNDS: usize = 5;
/// A corner joins the set where a margin is worse than at every corner of the set by this.
const WORSE: f64 = 1e-6;

/// One margin of a design as it may be made.
#[derive(Debug, Clone, PartialEq)]
pub struct Spread {
    /// Its code; slip rows are mu_s/mu_req - 1.
    pub code: String,
    /// Whether it is one of the objectives.
    pub objective: bool,
    /// As drawn.
    pub nominal: f64,
    /// At the worst corner.
    pub worst: f64,
    /// That corner.
    pub worst_at: String,
    /// 1st, 5th, 50th percentile of the draws.
    pub percentiles: [f64; 3],
}

/// Spreads of all margins of a design.
#[derive(Debug, Clone, PartialEq)]
pub struct Robust {
    /// Margin by margin: objectives first, then those limits that are no objectives.
    pub spreads: Vec<Spread>,
    /// Limits that do not hold at some corner, each with the corner where it is worst; the wanted slip margin and all else
    /// that `check` demands among them.
    pub not_held: Vec<(String, String)>,
    /// The objective in its own unit: at the nominal values, at the worst corner, and its 1st, 5th, 50th percentile.
    pub objective: (f64, f64, [f64; 3]),
    /// Corners looked at.
    pub corners: usize,
    /// Draws, and those at which the clutch cannot be put together.
    pub draws: (usize, usize),
    /// Corners at which the clutch cannot be put together.
    pub impossible: Vec<String>,
    /// Seed of the draws.
    pub seed: u64,
    /// Share of the draws at which every limit holds that `check` demands, slip as wanted among them.
    pub yield_share: f64,
    /// Evaluations of the clutch.
    pub evaluations: usize,
}

impl Robust {
    /// Whether every margin holds at every corner.
    pub fn held(&self) -> bool {
        self.impossible.is_empty() && self.not_held.is_empty()
    }
}

/// A design found with every corner as a limit.
#[derive(Debug, Clone)]
pub struct RobustSearch {
    /// Variables.
    pub x: Vec<f64>,
    /// How the last climb ended.
    pub status: Status,
    /// Corners that the climb was held to in the end.
    pub held_at: Vec<String>,
    /// What became of it.
    pub made: Robust,
    /// Climbs.
    pub rounds: usize,
    /// Step of its lengths, in their unit, where a point in such steps was found that holds as much; else they lie where the climb ended.
    pub step: Option<f64>,
    /// Design file.
    pub file: String,
    /// Evaluations of the clutch, each of all corners of a set counted as one per corner.
    pub evaluations: usize,
    /// Derivatives along one variable beside them, of all corners of a set counted likewise.
    pub derivatives: usize,
    /// Where its climbs ended.
    pub passed: Vec<Passed>,
}

/// Where a climb of a robust search ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Passed {
    /// Variables.
    pub x: Vec<f64>,
    /// Evaluations of the robust search until then.
    pub evaluations: usize,
    /// Derivatives along one variable beside them.
    pub derivatives: usize,
}

/// All given corners of `problem` at `x`, side by side.
pub(super) fn at_each(
    problem: &ClutchProblem,
    x: &[f64],
    points: &[Corner],
    desk: &Desk,
) -> Vec<Result<Evaluation, NoEvaluation>> {
    points.par_iter().map(|corner| desk.look(&problem.at_corners(vec![*corner]), x)).collect()
}

/// Margins of `problem` at `x` at every corner of the tolerances, and percentiles of `draws` seeded draws.
///
/// # Errors
/// [`NoSearch::Start`] where the design has no margins at its nominal values.
pub fn spread(
    problem: &ClutchProblem,
    x: &[f64],
    of: &Tolerances,
    (draws, seed): (usize, u64),
    desk: &Desk,
) -> Result<Robust, NoSearch> {
    let problem = &problem.as_checked();
    let nominal_problem = problem.at_corners(vec![Corner::NOMINAL]);
    let assessed = nominal_problem.assess_at(x).map_err(NoSearch::Start)?;
    let names = nominal_problem.names(&assessed);
    let nominal = nominal_problem.evaluation(&assessed);
    desk.begins("corners of the tolerances");
    let ends = corners(of);
    let at_ends = at_each(problem, x, &ends, desk);
    desk.begins("draws within the tolerances");
    let mut random = fastrand::Rng::with_seed(seed);
    let half = half_ranges(of);
    let drawn: Vec<Corner> = (0..draws)
        .map(|_| Corner {
            of: *of,
            shares: half.map(|h| if h > 0.0 { 2.0 * random.f64() - 1.0 } else { 0.0 }),
        })
        .collect();
    let at_draws = at_each(problem, x, &drawn, desk);
    let impossible: Vec<String> =
        ends.iter().zip(&at_ends).filter(|(_, e)| e.is_err()).map(|(c, _)| c.name()).collect();
    let good: Vec<&Evaluation> = at_draws.iter().filter_map(|e| e.as_ref().ok()).collect();
    let count = nominal.objectives.len();
    let rows = nominal_problem.limit_rows(&assessed.rows);
    let kept: Vec<f64> = rows.into_iter().map(|m| problem.kept(m)).collect();
    let row = |e: &Evaluation, j: usize| {
        if j < count { e.objectives[j] } else { e.limits[j - count] + kept[j - count] }
    };
    let code = |names: &Names, j: usize| {
        if j < count { names.objectives[j].clone() } else { names.limits[j - count].clone() }
    };
    // A row may be absent at a corner where an arc dropped out; only rows of the same shape compare.
    let alike = |e: &Evaluation| e.objectives.len() == count && e.limits.len() == nominal.limits.len();
    let holds = |e: &Evaluation| e.violation() <= RESOLUTION;
    let everywhere: Vec<(String, &Evaluation)> = std::iter::once(("nominal".to_owned(), &nominal))
        .chain(ends.iter().zip(&at_ends).filter_map(|(c, e)| Some((c.name(), e.as_ref().ok()?))))
        .collect();
    let mut not_held = Vec::new();
    for (j, code) in names.limits.iter().enumerate() {
        let worst = everywhere
            .iter()
            .filter(|(_, e)| alike(e))
            .min_by(|a, b| a.1.limits[j].total_cmp(&b.1.limits[j]))
            .filter(|(_, e)| e.limits[j] < -RESOLUTION);
        not_held.extend(worst.map(|(corner, _)| (code.clone(), corner.clone())));
    }
    let unlike = everywhere.iter().filter(|(_, e)| !alike(e) && !holds(e));
    not_held.extend(unlike.map(|(corner, _)| ("some limit".to_owned(), corner.clone())));
    let raised_too = |j: usize| j >= count && names.objectives.contains(&names.limits[j - count]);
    let spreads = (0..count + nominal.limits.len())
        .filter(|&j| !raised_too(j))
        .map(|j| {
            let known = ends
                .iter()
                .zip(&at_ends)
                .filter_map(|(c, e)| Some((c, e.as_ref().ok().filter(|e| alike(e))?)));
            let here = (row(&nominal, j), "nominal".to_owned());
            let worst =
                known.map(|(c, e)| (row(e, j), c.name())).fold(here, |a, b| if b.0 < a.0 { b } else { a });
            let mut values: Vec<f64> = good.iter().filter(|e| alike(e)).map(|e| row(e, j)).collect();
            values.sort_by(f64::total_cmp);
            Spread {
                code: code(&names, j),
                objective: j < count,
                nominal: row(&nominal, j),
                worst: worst.0,
                worst_at: worst.1,
                percentiles: percentiles(&values),
            }
        })
        .collect();
    let goal = problem.goals()[0];
    let own = |t: f64| (t * goal.span + goal.from) * goal.objective.sense();
    let ends_least = at_ends.iter().flatten().map(Evaluation::least_margin);
    let worst = ends_least.fold(nominal.least_margin(), f64::min);
    let mut least: Vec<f64> = good.iter().map(|e| e.least_margin()).collect();
    least.sort_by(f64::total_cmp);
    let share = good.iter().filter(|e| holds(e)).count() as f64 / draws.max(1) as f64;
    Ok(Robust {
        spreads,
        not_held,
        objective: (own(nominal.least_margin()), own(worst), percentiles(&least).map(own)),
        corners: ends.len(),
        draws: (draws, draws - good.len()),
        impossible,
        seed,
        yield_share: share,
        evaluations: 1 + ends.len() + draws,
    })
}

/// 1st, 5th and 50th percentile of sorted values, by the nearest rank; zeros where there are none.
fn percentiles(sorted: &[f64]) -> [f64; 3] {
    [0.01, 0.05, 0.5].map(|p| {
        let rank = (p * sorted.len() as f64).ceil() as usize;
        sorted.get(rank.saturating_sub(1)).copied().unwrap_or(0.0)
    })
}

/// The best worst corner from `x0` on: every limit of the climb held at every corner, and what
/// `check` demands looked at in the end; with lengths in steps of `step` (0: none) where such a point near holds every corner.
///
/// # Errors
/// [`NoSearch`] where a climb is refused.
pub fn robust(
    problem: &ClutchProblem,
    x0: &[f64],
    (lo, hi): (&[f64], &[f64]),
    step: f64,
    of: &Tolerances,
    (draws, seed): (usize, u64),
    method: &SearchMethod,
    desk: &Desk,
) -> Result<RobustSearch, NoSearch> {
    let all = corners(of);
    let near = climb_on_slopes(problem, x0, (lo, hi), of, method, desk).map_err(refused)?;
    let NearCorners { mut x, mut set, mut evaluations, mut derivatives, mut status, mut passed } = near;
    let mut rounds = 0;
    while !desk.stopped() {
        desk.begins(&format!("all {} corners", all.len()));
        let at_all = at_each(problem, &x, &all, desk);
        let known = |corner: &Corner| all.iter().position(|end| end == corner).map(|i| at_all[i].clone());
        let at_one = |corner: &Corner| {
            known(corner).unwrap_or_else(|| desk.look(&problem.at_corners(vec![*corner]), &x))
        };
        let at_set: Vec<_> = set.iter().map(at_one).collect();
        evaluations += all.len() + set.iter().filter(|corner| !all.contains(corner)).count();
        let fresh = worse_than_set(&set, &all, &at_all, &at_set);
        let held = at_set.iter().all(|e| e.as_ref().is_ok_and(|e| e.violation() <= RESOLUTION));
        if fresh.is_empty() && held && status == Status::Converged {
            break;
        }
        if rounds == ROUNDS {
            status = Status::Stalled(Cause::IterationLimit);
            break;
        }
        set.extend(fresh);
        rounds += 1;
        desk.begins(&format!("robust search, {} corners", set.len()));
        let there = problem.at_corners(set.clone());
        let climb = Settings { first_radius: NEAR_END, ..method.climb.clone() };
        let outcome = desk.climb(&there, &x, (lo, hi), &climb).map_err(refused)?;
        evaluations += outcome.evaluations * set.len();
        derivatives += outcome.derivatives * set.len();
        status = outcome.status;
        x = outcome.x;
        passed.push(Passed { x: x.clone(), evaluations, derivatives });
        if desk.stopped() {
            break;
        }
    }
    let stepped = problem.with_links_in_steps(step);
    let on_steps =
        points_near(&stepped.at_corners(set.clone()), problem.variables(), &x, (lo, hi), step, desk);
    let (points, looked) = on_steps.filter(|_| !desk.stopped()).unwrap_or_default();
    evaluations += looked * set.len();
    // Of the points that the set's corners like best the first that every corner holds.
    let holds = |x: &Vec<f64>| {
        at_each(&stepped, x, &all, desk).iter().all(|e| e.as_ref().is_ok_and(|e| e.violation() <= RESOLUTION))
    };
    let tried = points.iter().position(holds);
    evaluations += all.len() * tried.map_or(points.len(), |at| at + 1);
    let step = tried.map(|_| step);
    let problem = tried.map_or(problem, |_| &stepped);
    x = tried.map_or(x, |at| points[at].clone());
    let made = spread(problem, &x, of, (draws, seed), desk)?;
    let file =
        problem.finished_file(&x).map_err(|e| NoSearch::Start(NoEvaluation::Refused(e.to_string())))?;
    Ok(RobustSearch {
        x,
        status,
        held_at: set.iter().map(Corner::name).collect(),
        evaluations: evaluations + made.evaluations,
        derivatives,
        passed,
        made,
        rounds,
        step,
        file,
    })
}

/// Corners at which some margin is worse than at all corners of the set, one for each such margin.
pub(super) fn worse_than_set(
    set: &[Corner],
    ends: &[Corner],
    at_ends: &[Result<Evaluation, NoEvaluation>],
    at_set: &[Result<Evaluation, NoEvaluation>],
) -> Vec<Corner> {
    let known: Vec<Vec<f64>> = at_set.iter().flatten().map(Evaluation::outputs).collect();
    let objectives = at_set.iter().flatten().next().map_or(0, |e| e.objectives.len());
    let Some(width) = known.first().map(|row| row.len() - 1) else { return Vec::new() };
    let mut fresh: Vec<Corner> = Vec::new();
    // A corner at which there is no clutch joins by itself: its climb is turned away from.
    fresh.extend(
        ends.iter().zip(at_ends).filter(|(c, e)| e.is_err() && !set.contains(c)).map(|(c, _)| *c).take(1),
    );
    for j in 0..width {
        let floor = known.iter().map(|row| row[j]).fold(f64::INFINITY, f64::min);
        let worst = ends
            .iter()
            .zip(at_ends)
            .filter_map(|(c, e)| Some((c, *e.as_ref().ok()?.outputs().get(j)?)))
            .min_by(|a, b| a.1.total_cmp(&b.1));
        // Margins that are far from deciding need no corner of their own.
        if let Some((c, value)) = worst
            && value < floor - WORSE
            && (j < objectives || value < NEAR)
            && !fresh.contains(c)
            && !set.contains(c)
        {
            fresh.push(*c);
        }
    }
    fresh
}
