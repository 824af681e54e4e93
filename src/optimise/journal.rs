//! One memoising evaluator in front of every method, and the ordered record of what it was asked.

use std::collections::{HashMap, HashSet};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::evaluate::{Evaluate, Evaluation, NoEvaluation};
use crate::follow::Follow;

/// One evaluated point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    /// Variables, in the caller's units.
    pub x: Vec<f64>,
    /// Margins there, or why there are none.
    pub outcome: Result<Evaluation, NoEvaluation>,
}

/// Points in the order in which they were first asked for, found again by the exact bits of x.
///
/// A journal given to a later run answers from memory; the run then takes the same path as one that computes
/// every point, because points answered from memory are counted like computed ones.
#[derive(Debug, Clone, Default)]
pub struct Journal {
    entries: Vec<Entry>,
    index: HashMap<Vec<u64>, usize>,
}

impl Journal {
    /// Journal of points evaluated earlier; of two entries at the same x the first counts.
    pub fn from_entries(entries: impl IntoIterator<Item = Entry>) -> Self {
        let mut journal = Journal::default();
        for entry in entries {
            if !journal.index.contains_key(&bits(&entry.x)) {
                journal.push(entry);
            }
        }
        journal
    }

    /// The record, oldest first.
    pub fn entries(&self) -> &[Entry] {
        &self.entries
    }

    fn push(&mut self, entry: Entry) -> usize {
        self.index.insert(bits(&entry.x), self.entries.len());
        self.entries.push(entry);
        self.entries.len() - 1
    }
}

/// Exact bit pattern of x, with -0 taken for +0.
fn bits(x: &[f64]) -> Vec<u64> {
    x.iter().map(|v| (v + 0.0).to_bits()).collect()
}

/// Why evaluation stopped before the points asked for were all known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Halt {
    Limit,
    Interrupted,
}

/// Observer of a run; both methods may be left out.
pub trait Watch {
    /// A point was evaluated (not one answered from memory); called in the journal's order.
    fn evaluated(&mut self, _entry: &Entry) {}
    /// The problem gave derivatives at `x` itself, along as many variables as `along`.
    fn derived(&mut self, _x: &[f64], _along: usize) {}
    /// A step was tried.
    fn iterated(&mut self, _iteration: &super::Iteration) {}
}

/// What a run may be given beside the problem: an earlier journal, what stops it, an observer.
#[derive(Default)]
pub struct SearchRun<'a> {
    /// Points known beforehand (resumption).
    pub journal: Journal,
    /// Stops it; evaluations under way finish and are kept.
    pub follow: Follow,
    /// Optima known beforehand, each with its least margin: a climb that runs into the basin of one of them ends.
    pub known: Vec<(Vec<f64>, f64)>,
    /// Called as the run goes on.
    pub watch: Option<&'a mut (dyn Watch + Send)>,
}

/// The memoising, counting evaluator.
pub(super) struct Memo<'a> {
    problem: &'a dyn Evaluate,
    pub run: SearchRun<'a>,
    shape: Option<(usize, usize)>,
    asked: HashSet<usize>,
    limit: usize,
    pub failures: usize,
    /// Derivatives along one variable that the problem itself gave.
    pub derivatives: usize,
    /// What is taken from every limit that is handed out.
    pub clearance: f64,
}

impl<'a> Memo<'a> {
    pub fn new(problem: &'a dyn Evaluate, run: SearchRun<'a>, limit: usize) -> Self {
        Memo {
            problem,
            run,
            shape: None,
            asked: HashSet::new(),
            limit,
            failures: 0,
            derivatives: 0,
            clearance: 0.0,
        }
    }

    /// Distinct points asked for so far in this run, computed or remembered.
    pub fn evaluations(&self) -> usize {
        self.asked.len()
    }

    /// Counts of (objectives, limits), known after the first successful point.
    pub fn shape(&self) -> (usize, usize) {
        self.shape.unwrap_or((0, 0))
    }

    /// Whether the caller wants an end.
    pub fn stopped(&self) -> bool {
        self.run.follow.stopped()
    }

    /// Points with margins that this run asked for; those of a batch cut short too.
    pub fn known(&self) -> impl Iterator<Item = (&Vec<f64>, &Evaluation)> {
        let entries = self.run.journal.entries.iter().enumerate();
        entries
            .filter(|(i, _)| self.asked.contains(i))
            .filter_map(|(_, entry)| entry.outcome.as_ref().ok().map(|e| (&entry.x, e)))
    }

    /// Outcome at one point.
    pub fn one(&mut self, x: Vec<f64>) -> Result<Result<Evaluation, NoEvaluation>, Halt> {
        let mut outcomes = self.batch(vec![x])?;
        Ok(outcomes.swap_remove(0))
    }

    /// Outcomes at several points, the unknown ones evaluated in parallel; order and result do not depend on
    /// the number of threads.
    pub fn batch(&mut self, points: Vec<Vec<f64>>) -> Result<Vec<Result<Evaluation, NoEvaluation>>, Halt> {
        let mut fresh: Vec<&Vec<f64>> = Vec::new();
        let mut pending = HashSet::new();
        let mut new_here = HashSet::new();
        for x in &points {
            let key = bits(x);
            let known = self.run.journal.index.get(&key);
            if known.is_none_or(|i| !self.asked.contains(i)) {
                new_here.insert(key.clone());
            }
            if known.is_none() && pending.insert(key) {
                fresh.push(x);
            }
        }
        if self.asked.len() + new_here.len() > self.limit {
            return Err(Halt::Limit);
        }
        let follow = self.run.follow.clone();
        let stopped = || follow.stopped();
        let problem = self.problem;
        let one = |x: &&Vec<f64>| (!stopped()).then(|| problem.evaluate(x));
        let computed: Vec<Option<Result<Evaluation, NoEvaluation>>> = match problem.threads_are_free() {
            true => fresh.par_iter().map(one).collect(),
            false => fresh.iter().map(one).collect(),
        };
        let complete = computed.iter().all(Option::is_some);
        let cut_short = !complete || stopped();
        for (x, outcome) in fresh.into_iter().zip(computed) {
            let Some(outcome) = outcome else { continue };
            let outcome = outcome.and_then(|e| e.checked(self.shape));
            self.learn_shape(&outcome);
            let at = self.run.journal.push(Entry { x: x.clone(), outcome });
            if let Some(watch) = &mut self.run.watch {
                watch.evaluated(&self.run.journal.entries[at]);
            }
            if cut_short {
                self.count(at, self.run.journal.entries[at].outcome.is_err());
            }
        }
        if cut_short {
            return Err(Halt::Interrupted);
        }
        let mut outcomes = Vec::with_capacity(points.len());
        for x in &points {
            let at = self.run.journal.index[&bits(x)];
            let mut outcome = self.run.journal.entries[at].outcome.clone();
            outcome = outcome.and_then(|e| e.checked(self.shape));
            self.learn_shape(&outcome);
            self.count(at, outcome.is_err());
            outcomes.push(outcome.map(|e| e.less(self.clearance)));
        }
        Ok(outcomes)
    }

    /// What the problem itself says of the way from `x` to the points `beside` it ([`Evaluate::changes`]).
    pub fn changes(&mut self, x: &[f64], beside: &[Vec<f64>]) -> Result<Option<Vec<Vec<f64>>>, Halt> {
        if self.stopped() {
            return Err(Halt::Interrupted);
        }
        let found = self.problem.changes(x, beside);
        let along = found.as_ref().map_or(0, Vec::len);
        self.derivatives += along;
        if let Some(watch) = self.run.watch.as_mut().filter(|_| along > 0) {
            watch.derived(x, along);
        }
        Ok(found)
    }

    /// The entry at `at` was asked for, and came to nothing where it `failed`.
    fn count(&mut self, at: usize, failed: bool) {
        if self.asked.insert(at) && failed {
            self.failures += 1;
        }
    }

    fn learn_shape(&mut self, outcome: &Result<Evaluation, NoEvaluation>) {
        if let (None, Ok(e)) = (self.shape, outcome) {
            self.shape = Some((e.objectives.len(), e.limits.len()));
        }
    }
}
