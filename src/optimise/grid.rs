//! Lengths of an optimum in steps that can be made: the best point of the grid near it that holds every limit.
//!
//! The corners of the grid's cell around the optimum first, then single steps and pairs of steps from the best of them, as long
//! as that helps; what has no step (angles) is fitted to the lengths by a climb of its own.

use super::desk::Desk;
use super::evaluate::Evaluation;
use super::journal::Memo;
use super::problem::ClutchProblem;
use super::realise::is_centroid;
use super::search::Search;
use super::settings::Settings;
use super::starts::rank;
use crate::design::{Link, multiple};
use crate::file::variable_unit;
use crate::margin::Margin;
use std::cmp::Ordering;

/// Lengths whose cell is looked at corner by corner; with more of them the nearest point alone.
const CORNERS: usize = 6;
/// Lengths of which pairs are moved together.
const PAIRS: usize = 8;
/// Rounds of steps at most: a choice, the best point lies a few steps away.
const ROUNDS: usize = 40;
/// Points that are looked at in full at most, the best first.
const FULL: usize = 12;
/// Evaluations of the climb of what has no step.
const REST: usize = 150;

/// A design of the grid.
#[derive(Debug, Clone)]
pub struct OnGrid {
    /// Variables of the search's outcome.
    pub x: Vec<f64>,
    /// Margins in full, at a tenth of the search's tolerance, as those of the search itself.
    pub rows: Vec<Margin>,
    /// The same as the search has them.
    pub as_searched: Vec<Margin>,
    /// The objective, in its own unit.
    pub objective: f64,
    /// Its change when it is looked at in full.
    pub objective_error: f64,
    /// Design file.
    pub file: String,
    /// What goes with a variable of this name, in steps too.
    pub links: Vec<(String, Link)>,
}

/// No point near holds every limit: the nearest one.
#[derive(Debug, Clone, PartialEq)]
pub struct OffGrid {
    /// Variables of the search's outcome; empty where no point has margins at all.
    pub x: Vec<f64>,
    /// Limits that it does not hold, each with what is left of its margin beyond the reserve.
    pub not_held: Vec<(String, f64)>,
}

/// An optimum in steps.
#[derive(Debug, Clone)]
pub struct Stepped {
    /// The step, mm.
    pub step_mm: f64,
    /// Variables that have it.
    pub variables: Vec<String>,
    /// Evaluations of the clutch.
    pub evaluations: usize,
    /// Derivatives along one variable beside them.
    pub derivatives: usize,
    /// The design, or why there is none.
    pub found: Result<OnGrid, OffGrid>,
}

/// Multiples of the step within the bounds of one variable.
struct Ladder {
    /// Where the variable stands.
    at: usize,
    step: f64,
    /// First and last multiple within the bounds.
    ends: (i64, i64),
}

impl Ladder {
    fn value(&self, k: i64) -> f64 {
        multiple(k as f64, self.step)
    }

    fn within(&self, k: i64) -> i64 {
        k.clamp(self.ends.0, self.ends.1)
    }

    /// The multiples beside `x`: one where it is one.
    fn beside(&self, x: f64) -> Vec<i64> {
        let share = x / self.step;
        let near = share.round();
        let both = match (share - near).abs() < 1e-6 {
            true => [near, near],
            false => [share.floor(), share.ceil()],
        };
        let mut list = both.map(|k| self.within(k as i64)).to_vec();
        list.dedup();
        list
    }
}

/// Whether a number is a length that a shop makes.
pub(super) fn made(name: &str) -> bool {
    variable_unit(name) == Some("mm") && !is_centroid(name)
}

/// The optimum of `search` with its lengths in steps of `step_mm`; `None` where no variable is a length that is made.
pub fn stepped(search: &Search, step_mm: f64, desk: &Desk) -> Option<Stepped> {
    let (lo, hi) = search.bounds();
    let problem = search.problem.with_links_in_steps(step_mm);
    let mut grid = Grid::about(&problem, &search.searched, &search.outcome.x, (&lo, &hi), step_mm)?;
    desk.begins("steps that can be made");
    grid.look_around(desk);
    grid.fit_the_rest((&lo, &hi), &search.searched, desk);
    let variables = grid.ladders.iter().map(|l| search.searched[l.at].clone()).collect();
    let found = grid.best();
    let (evaluations, derivatives) = (grid.evaluations, grid.derivatives);
    Some(Stepped { step_mm, variables, evaluations, derivatives, found })
}

/// Points about `x` at which the lengths among the variables `names` are multiples of `step_mm`, the best for `problem` first,
/// and the evaluations that it took to find them; `None` where no variable is a length that is made.
pub(super) fn points_near(
    problem: &ClutchProblem,
    names: &[String],
    x: &[f64],
    bounds: (&[f64], &[f64]),
    step_mm: f64,
    desk: &Desk,
) -> Option<(Vec<Vec<f64>>, usize)> {
    let mut grid = Grid::about(problem, names, x, bounds, step_mm)?;
    grid.look_around(desk);
    Some((grid.seen.into_iter().take(FULL).map(|(x, _)| x).collect(), grid.evaluations))
}

struct Grid<'s> {
    problem: &'s ClutchProblem,
    /// The optimum.
    base: Vec<f64>,
    ladders: Vec<Ladder>,
    /// Points with margins, the best first once sorted.
    seen: Vec<(Vec<f64>, Evaluation)>,
    evaluations: usize,
    derivatives: usize,
}

impl<'s> Grid<'s> {
    fn about(
        problem: &'s ClutchProblem,
        names: &[String],
        x: &[f64],
        (lo, hi): (&[f64], &[f64]),
        step_mm: f64,
    ) -> Option<Self> {
        let ladders: Vec<Ladder> = (0..names.len())
            .filter(|&i| step_mm > 0.0 && made(&names[i]))
            .map(|at| {
                let share = |v: f64| v / step_mm;
                let ends = ((share(lo[at]) - 1e-9).ceil() as i64, (share(hi[at]) + 1e-9).floor() as i64);
                Ladder { at, step: step_mm, ends }
            })
            .filter(|ladder| ladder.ends.0 <= ladder.ends.1)
            .collect();
        let grid =
            Self { problem, base: x.to_vec(), ladders, seen: Vec::new(), evaluations: 0, derivatives: 0 };
        (!grid.ladders.is_empty()).then_some(grid)
    }

    fn tolerance() -> f64 {
        Settings::default().violation_tolerance
    }

    fn point(&self, steps: &[i64]) -> Vec<f64> {
        let mut x = self.base.clone();
        self.ladders.iter().zip(steps).for_each(|(ladder, &k)| x[ladder.at] = ladder.value(k));
        x
    }

    fn look_around(&mut self, desk: &Desk) {
        let problem = self.problem;
        let (seen, evaluations) = desk.run(problem, |problem, run| {
            let mut memo = Memo::new(problem, run, usize::MAX);
            let mut best: Option<(Vec<i64>, Evaluation)> = None;
            let beside: Vec<Vec<i64>> = self.ladders.iter().map(|l| l.beside(self.base[l.at])).collect();
            let mut next = match beside.len() <= CORNERS {
                true => combinations(&beside),
                false => vec![
                    self.ladders
                        .iter()
                        .map(|l| l.within((self.base[l.at] / l.step).round() as i64))
                        .collect(),
                ],
            };
            let mut pairs = false;
            for _ in 0..ROUNDS {
                let Ok(outcomes) = memo.batch(next.iter().map(|steps| self.point(steps)).collect()) else {
                    break;
                };
                let before = best.as_ref().map(|(_, e)| rank(e, Self::tolerance()));
                for (steps, outcome) in next.into_iter().zip(outcomes) {
                    let Ok(e) = outcome else { continue };
                    if best
                        .as_ref()
                        .is_none_or(|(_, b)| rank(&e, Self::tolerance()) < rank(b, Self::tolerance()))
                    {
                        best = Some((steps, e));
                    }
                }
                let Some((steps, e)) = &best else { break };
                let better = before.is_none_or(|before| rank(e, Self::tolerance()) < before);
                if !better && (pairs || self.ladders.len() > PAIRS) {
                    break;
                }
                pairs = !better;
                next = self.moves(steps, pairs);
            }
            let seen: Vec<_> = memo.known().map(|(x, e)| (x.clone(), e.clone())).collect();
            (seen, memo.evaluations())
        });
        self.seen = seen;
        self.evaluations += evaluations;
        self.sort();
    }

    /// Single steps from a point, or pairs of steps.
    fn moves(&self, from: &[i64], pairs: bool) -> Vec<Vec<i64>> {
        let singles: Vec<(usize, i64)> = (0..from.len()).flat_map(|i| [(i, -1), (i, 1)]).collect();
        let to = |moves: &[(usize, i64)]| {
            let mut steps = from.to_vec();
            for &(i, by) in moves {
                steps[i] = self.ladders[i].within(steps[i] + by);
            }
            steps
        };
        let mut list: Vec<Vec<i64>> = match pairs {
            false => singles.iter().map(|&a| to(&[a])).collect(),
            true => singles
                .iter()
                .flat_map(|&a| singles.iter().filter(move |b| b.0 > a.0).map(move |&b| [a, b]))
                .map(|both| to(&both))
                .collect(),
        };
        list.retain(|steps| steps != from);
        list
    }

    /// With the lengths of the best point held, what has no step is chosen anew.
    fn fit_the_rest(&mut self, (lo, hi): (&[f64], &[f64]), searched: &[String], desk: &Desk) {
        let rest: Vec<usize> =
            (0..self.base.len()).filter(|i| self.ladders.iter().all(|l| l.at != *i)).collect();
        let Some((x, _)) = self.seen.first().filter(|_| !rest.is_empty() && !desk.stopped()) else { return };
        let mut x = x.clone();
        let Ok(text) = self.problem.file_at(&x) else { return };
        let pick = |list: &[f64]| -> Vec<f64> { rest.iter().map(|&i| list[i]).collect() };
        let names = rest.iter().map(|&i| searched[i].clone()).collect();
        let problem = self.problem.on(text).over(names);
        let settings = Settings { max_evaluations: REST, first_radius: 0.1, ..Settings::default() };
        let Ok(outcome) = desk.climb(&problem, &pick(&x), (&pick(lo), &pick(hi)), &settings) else { return };
        self.evaluations += outcome.evaluations;
        self.derivatives += outcome.derivatives;
        rest.iter().zip(&outcome.x).for_each(|(&i, v)| x[i] = *v);
        self.seen.push((x, outcome.evaluation));
        self.sort();
    }

    fn sort(&mut self) {
        let key = |e: &Evaluation| rank(e, Self::tolerance());
        // Of equals the first by its values, whatever a journal had first.
        self.seen.sort_by(|(x, a), (y, b)| {
            let (a, b) = (key(a), key(b));
            let by_values = || x.iter().zip(y).map(|(x, y)| x.total_cmp(y)).find(|o| o.is_ne());
            a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)).then_with(|| by_values().unwrap_or(Ordering::Equal))
        });
    }

    /// The best point that holds every limit when it is looked at in full.
    fn best(&mut self) -> Result<OnGrid, OffGrid> {
        let full = self.problem.at_fidelity(self.problem.fidelity().sharper());
        let mut off = OffGrid { x: Vec::new(), not_held: Vec::new() };
        for (x, _) in self.seen.iter().take(FULL) {
            let (Ok(assessed), Ok(searched)) = (full.assess_at(x), self.problem.assess_at(x)) else {
                continue;
            };
            self.evaluations += 1;
            let broken = assessed.rows.iter().filter(|m| !full.held(m));
            let broken: Vec<(String, f64)> = broken.map(|m| (m.code(), full.left(m))).collect();
            match self.problem.finished_file(x) {
                Ok(file) if broken.is_empty() => {
                    let (objective, before) = (full.value(&assessed, 0), self.problem.value(&searched, 0));
                    let mut rows = assessed.rows;
                    rows.extend(self.problem.besides(x));
                    return Ok(OnGrid {
                        x: x.clone(),
                        rows,
                        as_searched: searched.rows,
                        objective,
                        objective_error: (objective - before).abs(),
                        file,
                        links: self.problem.links().to_vec(),
                    });
                }
                _ if off.x.is_empty() => off = OffGrid { x: x.clone(), not_held: broken },
                _ => {}
            }
        }
        Err(off)
    }
}

/// Every choice of one from each list.
fn combinations(lists: &[Vec<i64>]) -> Vec<Vec<i64>> {
    lists.iter().fold(vec![Vec::new()], |all, list| {
        all.iter()
            .flat_map(|begun| list.iter().map(|&k| begun.iter().copied().chain([k]).collect()))
            .collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ladder_stays_within_its_bounds_and_its_values_are_decimal() {
        let ladder = Ladder { at: 0, step: 0.005, ends: (720, 960) };
        assert_eq!(ladder.value(835), 4.175);
        assert_eq!(ladder.beside(4.17554), [835, 836]);
        assert_eq!(ladder.beside(4.175), [835]);
        assert_eq!(ladder.beside(4.8001), [960], "beyond the last multiple there is none");
    }

    #[test]
    fn every_corner_of_a_cell_is_looked_at_once() {
        let all = combinations(&[vec![1, 2], vec![5], vec![7, 8]]);
        assert_eq!(all, [[1, 5, 7], [1, 5, 8], [2, 5, 7], [2, 5, 8]]);
        assert_eq!(combinations(&[]), [[0_i64; 0]]);
    }
}
