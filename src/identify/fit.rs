//! The fit: Nelder-Mead of argmin from several starts, finished by Levenberg and Marquardt.

use std::str::FromStr;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use argmin::core::{CostFunction, Executor, State};
use argmin::solver::neldermead::NelderMead;
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::law_error::{Apart, covariance};
use super::no_fit::{NoFit, SoFar};
use super::observation::{Observation, ObservedQuantity, Use};
use super::predict::{NoPrediction, Prediction, design_with, predict};
use super::statistics::{Doubt, INSEPARABLE, Knowledge, correlation, knowledge, moved_by};
use crate::design::{Design, did_you_mean};
use crate::file::{inputs, is_whole, value_at, variable_names, variable_path};
use crate::follow::Follow;
use crate::numeric::setting::{BadSetting, in_range};

/// A parameter to be found, between bounds in the unit of its name.
#[derive(Debug, Clone, PartialEq)]
pub struct Unknown {
    /// A variable of `[optimize]`, such as `r_i2_mm`, or the dotted path of a number in the file.
    pub name: String,
    /// Lower bound.
    pub min: f64,
    /// Upper bound.
    pub max: f64,
}

impl FromStr for Unknown {
    type Err = String;

    /// `NAME:MIN:MAX`.
    fn from_str(text: &str) -> Result<Self, String> {
        let parts: Vec<&str> = text.split(':').map(str::trim).collect();
        let [name, min, max] = parts.as_slice() else {
            return Err("NAME:MIN:MAX is needed, such as friction.static:0.05:0.2".to_owned());
        };
        let bound = |text: &str| match text.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(format!("{text:?} is no finite number")),
        };
        Self::between((*name).to_owned(), bound(min)?, bound(max)?)
    }
}

impl Unknown {
    /// An unknown between two bounds.
    ///
    /// # Errors
    /// What is wrong with the bounds: one is no finite number, or they do not rise.
    pub fn between(name: String, min: f64, max: f64) -> Result<Self, String> {
        if let Some(bad) = [min, max].into_iter().find(|bound| !bound.is_finite()) {
            return Err(format!("{bad} is no finite number"));
        }
        if min >= max {
            return Err(format!("the lower bound {min} is not below the upper bound {max}"));
        }
        Ok(Self { name, min, max })
    }
}

/// How the fit is made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FitSettings {
    /// Starts: the design's own values first, the others at random between the bounds.
    pub starts: usize,
    /// Seed of the random starts.
    pub seed: u64,
    /// Most evaluations of all observations by the simplex of one start.
    pub evaluations: usize,
}

impl Default for FitSettings {
    fn default() -> Self {
        Self { starts: 4, seed: 1, evaluations: 200 }
    }
}

impl FitSettings {
    /// Refuse a search without a start or an evaluation.
    ///
    /// # Errors
    /// [`BadSetting`].
    pub fn validate(&self) -> Result<(), BadSetting> {
        in_range("starts", self.starts as f64, [1.0, 1e4])?;
        in_range("evaluations", self.evaluations as f64, [1.0, 1e9])
    }
}

/// An observation and what the fitted design says.
#[derive(Debug, Clone, PartialEq)]
pub struct FittedPoint {
    /// What was seen.
    pub observation: Observation,
    /// What the model says.
    pub predicted: Result<Prediction, NoPrediction>,
}

impl FittedPoint {
    /// predicted/observed - 1.
    pub fn relative(&self) -> Option<f64> {
        self.predicted.as_ref().ok().map(|p| p.value / self.observation.value - 1.0)
    }
}

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Identified {
    /// The unknowns.
    pub unknowns: Vec<Unknown>,
    /// Their values in the design at hand.
    pub before: Vec<f64>,
    /// What the data know of them.
    pub knowledge: Knowledge,
    /// For two unknowns that these data determine only together: what would tell them apart best.
    pub apart: Option<Apart>,
    /// Every observation, fitted or held back.
    pub points: Vec<FittedPoint>,
    /// Sum of the squared scaled residuals of the fit, one per start, and that of the solution.
    pub sums: (Vec<f64>, f64),
    /// Evaluations of all fitted observations.
    pub evaluations: usize,
    /// Whether the last step no longer mattered.
    pub converged: bool,
    /// Text of the design file with the values found.
    pub source: String,
}

/// Sum that stands for a design that cannot be compared with the data.
const NO_DESIGN: f64 = 1e30;

struct FitProblem<'a> {
    design: &'a Design,
    /// Observations of the fit, those with the same keys side by side.
    groups: Vec<Vec<&'a Observation>>,
    paths: Vec<String>,
    low: Vec<f64>,
    range: Vec<f64>,
    count: AtomicUsize,
    /// Shares and sum of the best design so far.
    best: Mutex<Option<(Vec<f64>, f64)>>,
    follow: &'a Follow,
}

/// Observations with the same keys, in the order in which they come.
fn grouped<'a>(all: impl Iterator<Item = &'a Observation>) -> Vec<Vec<&'a Observation>> {
    let mut groups: Vec<Vec<&Observation>> = Vec::new();
    for o in all {
        match groups.iter_mut().find(|g| g[0].keys == o.keys) {
            Some(group) => group.push(o),
            None => groups.push(vec![o]),
        }
    }
    groups
}

impl FitProblem<'_> {
    /// Values in the units of the names at shares `t` of the ranges.
    fn values(&self, t: &[f64]) -> Vec<f64> {
        t.iter().zip(&self.low).zip(&self.range).map(|((t, low), range)| low + t * range).collect()
    }

    fn named(&self, t: &[f64]) -> Vec<(String, f64)> {
        self.paths.iter().cloned().zip(self.values(t)).collect()
    }

    /// Scaled residuals at `t`.
    fn residuals(&self, t: &[f64]) -> Result<DVector<f64>, String> {
        if self.follow.stopped() {
            return Err("stopped".to_owned());
        }
        self.count.fetch_add(1, Ordering::Relaxed);
        let values = self.named(t);
        // All of them, then the first that fails: which one is told does not depend on threads.
        let rows: Vec<Result<Vec<f64>, String>> = self
            .groups
            .par_iter()
            .map(|group| {
                let at = |why: &NoPrediction, o: &Observation| format!("{}: {why}", o.label);
                let said = predict(self.design, &values, group).map_err(|why| at(&why, group[0]))?;
                said.iter()
                    .zip(group)
                    .map(|(p, o)| match p {
                        Ok(p) => scaled(p.value, o),
                        Err(why) => Err(at(why, o)),
                    })
                    .collect()
            })
            .collect();
        let rows: Result<Vec<Vec<f64>>, String> = rows.into_iter().collect();
        let residuals = DVector::from_vec(rows?.concat());
        let sum = residuals.norm_squared();
        let mut best = self.best.lock().unwrap_or_else(|e| e.into_inner());
        if best.as_ref().is_none_or(|(_, least)| sum < *least) {
            *best = Some((t.to_vec(), sum));
        }
        Ok(residuals)
    }

    /// Moves the share of unknown `j` in `t`, which residuals near `t` do not feel, as near to that of `value` as they stay what they are,
    /// `as_found`; the value there. Friction is such a one: more than a clutch needs to grip changes nothing, less lets it slip.
    fn nearest(&self, t: &mut [f64], j: usize, value: f64, as_found: &DVector<f64>) -> f64 {
        const ALIKE: f64 = 1e-9;
        const HALVINGS: usize = 24;
        let stays = |t: &[f64], share: f64| {
            let mut moved = t.to_vec();
            moved[j] = share;
            let alike = |r: DVector<f64>| (r - as_found).norm() <= ALIKE * (1.0 + as_found.norm());
            self.residuals(&moved).is_ok_and(alike)
        };
        let mut beyond = (value - self.low[j]) / self.range[j];
        if stays(t, beyond) {
            t[j] = beyond;
            return value;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (t[j] + beyond);
            if stays(t, middle) { t[j] = middle } else { beyond = middle }
        }
        self.values(t)[j]
    }

    /// The end of a search that was stopped.
    fn stopped(&self) -> NoFit {
        let best = self.best.lock().unwrap_or_else(|e| e.into_inner()).take();
        NoFit::Stopped(best.and_then(|(t, sum)| {
            let source = design_with(self.design, &[], &self.named(&t)).ok()?.source;
            Some(SoFar {
                values: self.values(&t),
                sum,
                evaluations: self.count.load(Ordering::Relaxed),
                source,
            })
        }))
    }

    fn sum(&self, t: &[f64]) -> f64 {
        self.residuals(t).map_or(NO_DESIGN, |r| r.norm_squared())
    }

    /// Derivatives by the shares, by central differences inside the bounds.
    fn jacobian(&self, t: &[f64]) -> Result<DMatrix<f64>, String> {
        // Curves are interpolated to some 1e-9: noise of 1e-6, and as much of truncation.
        const STEP: f64 = 1e-3;
        let mut columns = Vec::with_capacity(t.len());
        for j in 0..t.len() {
            let side = |to: f64| {
                let mut moved = t.to_vec();
                moved[j] = to;
                self.residuals(&moved)
            };
            let (a, b) = ((t[j] - STEP).max(0.0), (t[j] + STEP).min(1.0));
            // Where one side cannot be evaluated, the other has to do.
            let (a, b, fa, fb) = match (side(a), side(b)) {
                (Ok(fa), Ok(fb)) => (a, b, fa, fb),
                (Ok(fa), Err(_)) => (a, t[j], fa, side(t[j])?),
                (Err(_), Ok(fb)) => (t[j], b, side(t[j])?, fb),
                (Err(why), Err(_)) => return Err(why),
            };
            columns.push((fb - fa) / (b - a));
        }
        Ok(DMatrix::from_columns(&columns))
    }
}

/// Largest residual that can be squared, summed and divided by steps without an overflow.
const LARGEST_RESIDUAL: f64 = 1e100;

/// (predicted - observed) over what the observation is good to.
fn scaled(predicted: f64, o: &Observation) -> Result<f64, String> {
    let residual = (predicted - o.value) / o.scale();
    if residual.abs() < LARGEST_RESIDUAL {
        return Ok(residual);
    }
    Err(format!(
        "{}: the model says {predicted:e}, the table {:e}, and they differ by too many times its error to be fitted; is the number in the unit of its column?",
        o.label, o.value
    ))
}

/// t = (1 + sin u)/2: every u lies between the bounds.
fn share(u: &[f64]) -> Vec<f64> {
    u.iter().map(|u| 0.5 * (1.0 + u.sin())).collect()
}

struct Transformed<'p, 'a>(&'p FitProblem<'a>);

impl CostFunction for Transformed<'_, '_> {
    type Param = Vec<f64>;
    type Output = f64;
    fn cost(&self, u: &Self::Param) -> Result<f64, argmin::core::Error> {
        Ok(self.0.sum(&share(u)))
    }
}

/// Find the unknowns of `design` from `observations`. `follow` ends the search before its next evaluation.
///
/// Residuals are (predicted - observed) over the row's standard error, or over the observed number where none is given.
///
/// # Errors
/// [`NoFit`].
pub fn identify(
    design: &Design,
    observations: &[Observation],
    unknowns: &[Unknown],
    settings: &FitSettings,
    follow: &Follow,
) -> Result<Identified, NoFit> {
    settings.validate().map_err(NoFit::Setting)?;
    let stopped = || follow.stopped();
    let (paths, before) = paths(design, unknowns)?;
    let fitted = observations.iter().filter(|o| o.purpose == Use::Fit);
    let problem = FitProblem {
        design,
        groups: grouped(fitted),
        paths,
        low: unknowns.iter().map(|u| u.min).collect(),
        range: unknowns.iter().map(|u| u.max - u.min).collect(),
        count: AtomicUsize::new(0),
        best: Mutex::new(None),
        follow,
    };
    if problem.groups.is_empty() {
        return Err(NoFit::NothingToFit);
    }
    let starts = starts(&problem, unknowns, &before, settings)
        .map_err(|e| if stopped() { problem.stopped() } else { e })?;
    let mut sums = Vec::new();
    let mut best: Option<(Vec<f64>, f64, bool)> = None;
    for start in starts {
        let simplex = simplex_search(&problem, &start, settings.evaluations);
        let (t, sum, converged) = finish(&problem, simplex);
        if stopped() {
            return Err(problem.stopped());
        }
        sums.push(sum);
        if best.as_ref().is_none_or(|b| sum < b.1) {
            best = Some((t, sum, converged));
        }
    }
    let nowhere = |why: String| NoFit::Nowhere { tried: problem.count.load(Ordering::Relaxed), why };
    let (t, sum, converged) = best.ok_or_else(|| nowhere("no start".to_owned()))?;
    let last = problem.residuals(&t).and_then(|r| Ok((r, problem.jacobian(&t)?)));
    let (residuals, jacobian) =
        last.map_err(|why| if stopped() { problem.stopped() } else { nowhere(why) })?;
    let bounds: Vec<(f64, f64)> = unknowns.iter().map(|u| (u.min, u.max)).collect();
    let given = problem.groups.iter().flatten().all(|o| o.sigma.is_some());
    let mut knowledge = knowledge(&jacobian, &residuals, &problem.values(&t), &bounds, given);
    let law = covariance(design.clutch.law_error(), &problem.groups.concat());
    let silent = knowledge.without_influence();
    let felt: Vec<usize> = (0..unknowns.len()).filter(|j| !silent.contains(j)).collect();
    let by_law = moved_by(&jacobian.select_columns(&felt), &law);
    for (&j, width) in felt.iter().zip(by_law.iter().flatten()) {
        let e = &mut knowledge.estimates[j];
        e.by_law = e.half_width.map(|_| width * problem.range[j]);
    }
    let apart = apart(&problem, &t, &jacobian, &knowledge);
    let mut named = problem.named(&t);
    // What the data say nothing of stays as it was, or as near to that as they are met as well.
    let mut kept = t.clone();
    for j in knowledge.without_influence() {
        if (unknowns[j].min..=unknowns[j].max).contains(&before[j]) {
            let value = problem.nearest(&mut kept, j, before[j], &residuals);
            (knowledge.estimates[j].value, named[j].1) = (value, value);
        }
    }
    if stopped() {
        return Err(problem.stopped());
    }
    let source = design_with(design, &[], &named).map_err(|e| nowhere(e.to_string()))?.source;
    Ok(Identified {
        unknowns: unknowns.to_vec(),
        before,
        knowledge,
        apart,
        points: points(design, &named, observations),
        sums: (sums, sum),
        evaluations: problem.count.load(Ordering::Relaxed),
        converged,
        source,
    })
}

/// Which further quantity, seen at the torques of the fit and as well, would tell the two unknowns best apart that are known
/// together only.
fn apart(problem: &FitProblem, t: &[f64], jacobian: &DMatrix<f64>, knowledge: &Knowledge) -> Option<Apart> {
    let (first, second) = knowledge.undetermined().find_map(|(j, doubt)| match doubt {
        Doubt::Inseparable(other) => Some((j.min(other), j.max(other))),
        _ => None,
    })?;
    let seen: Vec<&Observation> = problem.groups.concat();
    let of_kind = |kind: ObservedQuantity| -> Option<Apart> {
        let mut at: Vec<Observation> =
            seen.iter().filter(|o| o.torque_nm.is_some()).map(|o| (*o).clone()).collect();
        at.dedup_by_key(|o| o.torque_nm.map(f64::to_bits));
        at.iter_mut().for_each(|o| (o.kind, o.value, o.sigma) = (kind, 1.0, Some(1.0)));
        let more = FitProblem {
            groups: grouped(at.iter()),
            paths: problem.paths.clone(),
            low: problem.low.clone(),
            range: problem.range.clone(),
            count: AtomicUsize::new(0),
            best: Mutex::new(None),
            ..*problem
        };
        // In parts of what the model says there, as the other rows are in parts of what was seen.
        let said = more.residuals(t).ok()?.map(|r| r + 1.0);
        let mut rows = more.jacobian(t).ok()?;
        for (mut row, said) in rows.row_iter_mut().zip(said.iter()) {
            row /= *said;
        }
        rows /= seen.iter().map(|o| o.scale() / o.value.abs()).fold(f64::INFINITY, f64::min);
        let mut both = jacobian.clone().insert_rows(jacobian.nrows(), rows.nrows(), 0.0);
        both.rows_mut(jacobian.nrows(), rows.nrows()).copy_from(&rows);
        Some(Apart { quantity: kind, pair: (first, second), correlation: correlation(&both, first, second)? })
    };
    let known = |kind: &ObservedQuantity| seen.iter().any(|o| o.kind == *kind);
    let kinds = ObservedQuantity::ALL.into_iter().filter(|kind| kind.seen_on_a_bench() && !known(kind));
    let least =
        kinds.filter_map(of_kind).min_by(|a, b| a.correlation.abs().total_cmp(&b.correlation.abs()))?;
    (least.correlation.abs() < INSEPARABLE).then_some(least)
}

fn paths(design: &Design, unknowns: &[Unknown]) -> Result<(Vec<String>, Vec<f64>), NoFit> {
    if unknowns.is_empty() {
        return Err(NoFit::Unknowns("name at least one unknown".to_owned()));
    }
    let arcs = design.clutch.sprags.listed_arcs();
    let (mut paths, mut before) = (Vec::<String>::new(), Vec::new());
    for u in unknowns {
        let refuse = |why: String| NoFit::Unknown { name: u.name.clone(), why };
        if !(u.min.is_finite() && u.max.is_finite() && u.min < u.max) {
            return Err(refuse(format!(
                "bounds {}:{}; allowed: two finite numbers, the smaller first",
                u.min, u.max
            )));
        }
        let path = variable_path(&u.name, arcs).or_else(|| u.name.contains('.').then(|| u.name.clone()));
        let known = variable_names(arcs);
        let path = path.ok_or_else(|| {
            let near = did_you_mean(&u.name, &known);
            let known = known.join(", ");
            refuse(format!(
                "no such variable{near}; there are {known}, and the dotted path of any number in the file"
            ))
        })?;
        let value = value_at(&design.source, &path).ok_or_else(|| {
            let there = inputs(&design.source);
            let near = did_you_mean(&u.name, &there.iter().map(|input| input.path.as_str()).collect::<Vec<_>>());
            refuse(format!("the design file holds no number {path}{near}; a key that it lacks is to be written there first"))
        })?;
        if is_whole(&path, arcs) {
            return Err(refuse(format!(
                "a whole number, and identify searches only what varies smoothly; try each value by itself: write it into the \
                 file, find the other unknowns, and compare the sums of squares; a test with another value has it in a column {path} \
                 of the data"
            )));
        }
        if paths.contains(&path) {
            return Err(NoFit::Unknowns(format!("{path} is named twice")));
        }
        paths.push(path);
        before.push(value);
    }
    Ok((paths, before))
}

/// Shares at which a search begins: the design's own values if they lie between the bounds, then random ones; each can
/// be compared with the data and says something of them.
fn starts(
    problem: &FitProblem,
    unknowns: &[Unknown],
    before: &[f64],
    settings: &FitSettings,
) -> Result<Vec<Vec<f64>>, NoFit> {
    const TRIES: usize = 400;
    let mut random = fastrand::Rng::with_seed(settings.seed);
    let inside = unknowns.iter().zip(before).all(|(u, v)| (u.min..=u.max).contains(v));
    let own = inside.then(|| {
        let each = before.iter().zip(&problem.low).zip(&problem.range);
        each.map(|((v, low), range)| (v - low) / range).collect::<Vec<f64>>()
    });
    let mut found = Vec::new();
    let mut why = String::new();
    // Where the clutch carries nothing in any row, no step of the search leads away.
    let silent = |r: &DVector<f64>| {
        r.iter().zip(problem.groups.iter().flatten()).all(|(r, o)| scaled(0.0, o) == Ok(*r))
    };
    let mut try_one = |t: Vec<f64>, found: &mut Vec<Vec<f64>>| match problem.residuals(&t) {
        Ok(r) if silent(&r) => "the clutch carries nothing in any row of the fit".clone_into(&mut why),
        Ok(_) => found.push(t),
        Err(reason) => why = reason,
    };
    if let Some(own) = own {
        try_one(own, &mut found);
    }
    let mut tried = 0;
    while found.len() < settings.starts.max(1) && tried < TRIES {
        let t: Vec<f64> = unknowns.iter().map(|_| random.f64()).collect();
        try_one(t, &mut found);
        tried += 1;
    }
    if found.is_empty() { Err(NoFit::Nowhere { tried: tried + 1, why }) } else { Ok(found) }
}

/// Nelder and Mead's simplex from the shares `start`.
fn simplex_search(problem: &FitProblem, start: &[f64], evaluations: usize) -> Vec<f64> {
    // Away from the bounds, where the transformation has no slope.
    let u: Vec<f64> = start.iter().map(|t| (2.0 * t.clamp(0.02, 0.98) - 1.0).asin()).collect();
    let mut simplex = vec![u.clone()];
    for j in 0..u.len() {
        let mut corner = u.clone();
        corner[j] += if corner[j] > 0.0 { -0.3 } else { 0.3 };
        simplex.push(corner);
    }
    // Each iteration takes one or two evaluations.
    let iterations = (evaluations as f64 / 1.6).ceil() as u64;
    let Ok(solver) = NelderMead::new(simplex).with_sd_tolerance(1e-10) else { return start.to_vec() };
    let run = Executor::new(Transformed(problem), solver).configure(|s| s.max_iters(iterations)).run();
    match run.ok().and_then(|r| r.state().get_best_param().cloned()) {
        Some(best) if problem.sum(&share(&best)) <= problem.sum(start) => share(&best),
        _ => start.to_vec(),
    }
}

/// Levenberg and Marquardt from the shares `t`, kept between the bounds: shares, sum, converged.
fn finish(problem: &FitProblem, mut t: Vec<f64>) -> (Vec<f64>, f64, bool) {
    let mut sum = problem.sum(&t);
    let mut damping = 1e-3;
    for _ in 0..30 {
        let (Ok(r), Ok(j)) = (problem.residuals(&t), problem.jacobian(&t)) else { return (t, sum, false) };
        let (normal, slope) = (j.transpose() * &j, j.transpose() * &r);
        let mut moved = None;
        for _ in 0..12 {
            let mut damped = normal.clone();
            for k in 0..t.len() {
                damped[(k, k)] += damping * normal[(k, k)].max(1e-12 * normal.trace());
            }
            let Some(step) = damped.lu().solve(&slope) else { break };
            let next: Vec<f64> = t.iter().zip(step.iter()).map(|(t, s)| (t - s).clamp(0.0, 1.0)).collect();
            let after = problem.sum(&next);
            if after < sum {
                damping = (0.1 * damping).max(1e-12);
                moved = Some((next, after));
                break;
            }
            damping *= 10.0;
        }
        let Some((next, after)) = moved else { return (t, sum, true) };
        let gain = (sum - after) / sum.max(f64::MIN_POSITIVE);
        (t, sum) = (next, after);
        if gain < 1e-10 || sum < 1e-24 {
            return (t, sum, true);
        }
    }
    (t, sum, false)
}

/// Every observation beside what the design with `values` says.
fn points(design: &Design, values: &[(String, f64)], observations: &[Observation]) -> Vec<FittedPoint> {
    let groups = grouped(observations.iter());
    let mut points: Vec<FittedPoint> = groups
        .par_iter()
        .flat_map_iter(|group| {
            let said = predict(design, values, group);
            let each = match said {
                Ok(said) => said,
                Err(why) => group.iter().map(|_| Err(why.clone())).collect(),
            };
            group
                .iter()
                .zip(each)
                .map(|(o, predicted)| FittedPoint { observation: (*o).clone(), predicted })
                .collect::<Vec<_>>()
        })
        .collect();
    points.sort_by_key(|p| p.observation.line);
    points
}
