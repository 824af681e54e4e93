//! What would free an infeasible problem where the variables may move along: the least change of one number, be it a limit
//! or a dimension that is no variable, with which some design of the box holds every limit; and which limits the variables
//! hold by themselves.

use rayon::prelude::*;

use super::desk::Desk;
use super::driver::maximise_least_margin;
use super::evaluate::{Evaluate, Evaluation, NoEvaluation};
use super::journal::SearchRun;
use super::outcome::Outcome;
use super::problem::ClutchProblem;
use super::search::Search;
use super::settings::Settings;
use crate::design::{Design, LIMIT_KEYS, LimitKey};
use crate::file::{is_whole, value_at, variable_names, variable_path, variable_unit};
use crate::margin::{CONTACT, Demand, Margin};

/// Farthest a dimension goes from its value, as a share of it: a choice, beyond it is another clutch.
const REACH: f64 = 0.2;
/// Dimensions of the races that are asked for beside those of the sprag.
const RINGS: [&str; 3] = ["races.width_mm", "races.outer_outside_radius_mm", "races.inner_bore_radius_mm"];
/// Farthest a limit goes, as a factor.
const FACTOR: f64 = 4.0;
/// Share of a limit's value by which it is moved to see whether it bears on what does not hold.
const FELT: f64 = 0.01;
/// Margin below which a limit may be what keeps another from being held.
const TIGHT: f64 = 1e-3;
/// First step of the climb on full evaluations from where one on quick ones has ended, as a share of each range.
const POLISHING: f64 = 1e-3;
/// Evaluations of one climb.
const EVALUATIONS: usize = 150;

/// One number that was let go, all variables with it.
#[derive(Debug, Clone, PartialEq)]
pub struct Loosened {
    /// Dotted path of the key, or the name of a design variable.
    pub key: String,
    /// Its unit; empty for a pure number.
    pub unit: &'static str,
    /// Value in the file.
    pub given: f64,
    /// Value nearest to it that was found to free the problem.
    pub needed: Option<f64>,
    /// Values looked at.
    pub between: (f64, f64),
    /// The variables there.
    pub x: Vec<f64>,
    /// Evaluations.
    pub evaluations: usize,
}

/// A limit looked at alone.
#[derive(Debug, Clone, PartialEq)]
pub struct Alone {
    /// Its code.
    pub code: String,
    /// The largest margin found in the box, all other limits left aside.
    pub margin: f64,
    /// Variables that move for it, and their values there.
    pub changes: Vec<(String, f64)>,
}

/// What is let go.
#[derive(Clone, Copy)]
enum Number {
    Limit(&'static LimitKey),
    /// A variable behind the others.
    Dimension,
}

/// The problem with one more variable, the last, which is to change as little as possible.
struct LetGo<'p> {
    problem: &'p ClutchProblem,
    number: Number,
    given: f64,
    range: f64,
}

impl Evaluate for LetGo<'_> {
    fn evaluate(&self, x: &[f64]) -> Result<Evaluation, NoEvaluation> {
        let Some((&value, rest)) = x.split_last() else {
            return Err(NoEvaluation::Refused("no variable".to_owned()));
        };
        let assessed = match self.number {
            Number::Limit(key) => {
                self.problem.under(key.with(self.problem.limits(), value)).assess_at(rest)?
            }
            Number::Dimension => self.problem.assess_at(x)?,
        };
        let off = (value - self.given) / self.range;
        Ok(Evaluation {
            objectives: vec![-off, off],
            limits: with_slopes(self.problem, &assessed.rows),
            tie_break: 0.0,
        })
    }
}

/// Margins, where a contact opens that of the contact for the slip margin too: that friction cannot suffice has no slope.
fn with_slopes(problem: &ClutchProblem, rows: &[Margin]) -> Vec<f64> {
    let contact = |row: &Margin| {
        let lost = row.is_slip() && !matches!(row.demand, Demand::Value(_));
        let of = |r: &&Margin| r.limit == &CONTACT && (&r.scene, &r.corner) == (&row.scene, &row.corner);
        rows.iter().filter(|_| lost).find(of).filter(|r| r.margin() < 0.0)
    };
    rows.iter().map(|row| problem.left(contact(row).unwrap_or(row))).collect()
}

/// One limit alone, as large as it gets.
struct OneLimit<'p> {
    problem: &'p ClutchProblem,
    row: &'p Margin,
}

impl Evaluate for OneLimit<'_> {
    fn evaluate(&self, x: &[f64]) -> Result<Evaluation, NoEvaluation> {
        let assessed = self.problem.assess_at(x)?;
        let row = assessed.rows.iter().find(|r| r.is_of(self.row));
        let row = row.ok_or_else(|| NoEvaluation::Refused(format!("no {}", self.row.code())))?;
        let margin = self.problem.left(row);
        Ok(Evaluation { objectives: vec![margin], limits: Vec::new(), tie_break: 0.0 })
    }
}

/// A number to be let go: which, its key, its unit, its value, and the range it is given.
type Asked = (Number, String, &'static str, f64, (f64, f64));

/// Every limit that bears on what does not hold or holds by a hair, and every dimension of the sprag that is no variable, let go one by one
/// from the best design of `found`, which is infeasible.
pub fn loosened(design: &Design, found: &Search, desk: &Desk) -> Vec<Loosened> {
    let problem = found.problem.as_checked().fully();
    let x = &found.outcome.x;
    let (Ok(text), Ok(here)) = (problem.file_at(x), problem.assess_at(x)) else { return Vec::new() };
    desk.begins("what would free it");
    let tight: Vec<&Margin> = here.rows.iter().filter(|m| problem.left(m) < TIGHT).collect();
    let eased = |rows: &[Margin]| {
        tight.iter().any(|m| rows.iter().any(|r| r.is_of(m) && r.margin() > m.margin() + 1e-9))
    };
    let mut asked: Vec<Asked> = Vec::new();
    for key in LIMIT_KEYS {
        let Some(value) = key.value(problem.limits()).filter(|v| *v > 0.0) else { continue };
        let felt = |share: f64| {
            let moved = problem.under(key.with(problem.limits(), value * (1.0 + share)));
            moved.assess_at(x).is_ok_and(|assessed| eased(&assessed.rows))
        };
        let between = if felt(FELT) {
            (value, value * FACTOR)
        } else if felt(-FELT) {
            (if key.unit.is_empty() { 0.0 } else { value / FACTOR }, value)
        } else {
            continue;
        };
        asked.push((Number::Limit(key), format!("limits.{}", key.name), key.unit, value, between));
    }
    let arcs = design.clutch.sprags.listed_arcs();
    let known: Vec<Option<String>> = found.variables.iter().map(|v| variable_path(&v.name, arcs)).collect();
    let dimensions = variable_names(arcs).into_iter().chain(RINGS.map(str::to_owned));
    for name in dimensions {
        let path = variable_path(&name, arcs);
        let value = path.as_ref().and_then(|path| value_at(&text, path)).filter(|v| *v != 0.0);
        let Some(value) = value.filter(|_| !known.contains(&path) && !is_whole(&name, arcs)) else {
            continue;
        };
        let ends = [value * (1.0 - REACH), value * (1.0 + REACH)];
        let between = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        let unit = variable_unit(&name).unwrap_or_default();
        asked.push((Number::Dimension, name, unit, value, between));
    }
    let (lo, hi) = found.bounds();
    let begins = |name: &String| found.variables.iter().find(|v| v.name == *name).map(|v| v.start);
    let begun: Vec<f64> = found.searched.iter().filter_map(begins).collect();
    let polishing = Settings {
        max_evaluations: EVALUATIONS,
        poll: false,
        first_radius: POLISHING,
        ..Settings::default()
    };
    let settings = Settings { first_radius: 0.1, finish: false, ..polishing.clone() };
    let let_go = |(number, key, unit, given, between): Asked| {
        let problem = match number {
            Number::Limit(_) => problem.clone(),
            Number::Dimension => {
                let names = problem.variables().iter().cloned().chain([key.clone()]);
                problem.over(names.collect())
            }
        };
        let quick = problem.quickly();
        let with = |list: &[f64], last: f64| -> Vec<f64> { list.iter().copied().chain([last]).collect() };
        let bounds = (with(&lo, between.0), with(&hi, between.1));
        let climb_on = |problem: &ClutchProblem, from: &[f64], settings: &Settings| {
            let one = LetGo { problem, number, given, range: between.1 - between.0 };
            let run = SearchRun { follow: desk.follow(), ..SearchRun::default() };
            maximise_least_margin(&one, from, &bounds.0, &bounds.1, settings, run).ok()
        };
        let free = |outcome: &Outcome| outcome.evaluation.violation() <= settings.violation_tolerance;
        // On quick evaluations, and from where that ends on full ones, if they can matter there.
        let climb = |from: &[f64]| {
            let near = climb_on(&quick, from, &settings)?;
            if near.evaluation.violation() > TIGHT {
                return Some(near);
            }
            let mut outcome = climb_on(&problem, &near.x, &polishing)?;
            outcome.evaluations += near.evaluations;
            Some(outcome)
        };
        let mut outcome = climb(&with(x, given))?;
        let mut evaluations = outcome.evaluations;
        // Where the way from there does not lead to it: from the given design, and from the limit wide open back towards it.
        let open = if between.0 < given { between.0 } else { between.1 };
        let mut others = vec![with(&begun, given)];
        if let Number::Limit(_) = number {
            others.push(with(x, open));
        }
        for from in others {
            if free(&outcome) || desk.follow().stopped() {
                break;
            }
            if let Some(other) = climb(&from) {
                evaluations += other.evaluations;
                outcome = if free(&other) { other } else { outcome };
            }
        }
        let needed = outcome.x.last().copied().filter(|_| free(&outcome));
        let x = outcome.x[..outcome.x.len() - 1].to_vec();
        Some(Loosened { key, unit, given, needed, between, x, evaluations })
    };
    asked.into_par_iter().filter_map(let_go).collect()
}

/// The limits at rest that do not hold at the best design of `found`, each for itself.
pub fn alone(found: &Search, desk: &Desk) -> Vec<Alone> {
    let problem = found.problem.at_rest().fully();
    let (lo, hi) = found.bounds();
    let x = &found.outcome.x;
    let Ok(here) = problem.assess_at(x) else { return Vec::new() };
    let one = |row: &Margin| {
        let only = OneLimit { problem: &problem, row };
        let settings = Settings { max_evaluations: EVALUATIONS, poll: false, ..Settings::default() };
        let run = SearchRun { follow: desk.follow(), ..SearchRun::default() };
        let outcome = maximise_least_margin(&only, x, &lo, &hi, &settings, run).ok()?;
        let moved = |i: usize| (outcome.x[i] - x[i]).abs() > 1e-3 * (hi[i] - lo[i]);
        let changes = (0..x.len()).filter(|&i| moved(i));
        let changes = changes.map(|i| (problem.variables()[i].clone(), outcome.x[i])).collect();
        Some(Alone { code: row.code(), margin: outcome.evaluation.least_margin(), changes })
    };
    here.rows.iter().filter(|m| !problem.held(m)).filter_map(one).collect()
}
