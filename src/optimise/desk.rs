//! What all runs of a search share: the flag that stops them and the record of their evaluations.

use std::sync::Mutex;

use sha2::{Digest, Sha256};

use super::driver::maximise_least_margin;
use super::evaluate::{Evaluation, NoEvaluation};
use super::journal::{Entry, Journal, Memo, SearchRun, Watch};
use super::outcome::{Iteration, Outcome, Refusal};
use super::problem::ClutchProblem;
use super::settings::Settings;
use crate::follow::{Follow, News};

/// What the entries of a record belong to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ProblemId {
    /// SHA-256 of [`ClutchProblem::identity`], hex.
    pub hash: String,
    /// Variables, in the order of each entry's x.
    pub variables: Vec<String>,
    /// Tolerance that bounds the error of an entry's margins, as printed.
    pub error: String,
}

impl ProblemId {
    /// Of a problem.
    pub fn of(problem: &ClutchProblem) -> Self {
        let digest = Sha256::digest(problem.identity().as_bytes());
        Self {
            hash: digest.iter().map(|byte| format!("{byte:02x}")).collect(),
            variables: problem.variables().to_vec(),
            error: format!("{:e}", problem.fidelity().settings.tolerance),
        }
    }
}

/// Keeper of every evaluation, which gives back what it has kept: a store, where a [`Follow`] only hears. Only `cli` knows where it keeps
/// them.
pub trait Record: Send {
    /// What is known of a problem from earlier.
    fn known(&mut self, _problem: &ProblemId) -> Journal {
        Journal::default()
    }
    /// A point was evaluated.
    fn evaluated(&mut self, _problem: &ProblemId, _entry: &Entry) {}
    /// A problem gave derivatives at `x` itself, along as many variables as `along`.
    fn derived(&mut self, _problem: &ProblemId, _x: &[f64], _along: usize) {}
    /// A step was tried, in some run.
    fn iterated(&mut self, _iteration: &Iteration) {}
}

/// Keeps nothing.
#[derive(Debug, Clone, Copy, Default)]
pub struct Forgetful;

impl Record for Forgetful {}

/// Shared by all runs of a search.
pub struct Desk<'a> {
    follow: Follow,
    record: Mutex<&'a mut dyn Record>,
}

/// One run's observer: entries go to the desk with the problem they belong to.
struct Scribe<'d, 'a> {
    desk: &'d Desk<'a>,
    problem: ProblemId,
}

impl<'a> Desk<'a> {
    /// Around a record; `follow` ends its runs, and is told of parts and evaluations.
    pub fn new(follow: &Follow, record: &'a mut dyn Record) -> Self {
        Self { follow: follow.clone(), record: Mutex::new(record) }
    }

    /// Whether the caller wants an end.
    pub fn stopped(&self) -> bool {
        self.follow.stopped()
    }

    /// What ends its runs, for those that are not recorded.
    pub(super) fn follow(&self) -> Follow {
        self.follow.clone()
    }

    /// Announce a part of the search.
    pub fn begins(&self, part: &str) {
        self.follow.news(News::Begins(part));
    }

    /// A thread that died while it held the record has written whole entries or none.
    fn with<T>(&self, what: impl FnOnce(&mut dyn Record) -> T) -> T {
        let mut record = self.record.lock().unwrap_or_else(|e| e.into_inner());
        what(&mut **record)
    }

    /// Does `what` with a run that remembers and records `problem`.
    pub fn run<T>(
        &self,
        problem: &ClutchProblem,
        what: impl for<'x> FnOnce(&'x ClutchProblem, SearchRun<'x>) -> T,
    ) -> T {
        let id = ProblemId::of(problem);
        let journal = self.with(|record| record.known(&id));
        let mut scribe = Scribe { desk: self, problem: id };
        what(
            problem,
            SearchRun { journal, follow: self.follow(), known: Vec::new(), watch: Some(&mut scribe) },
        )
    }

    /// One evaluation.
    ///
    /// # Errors
    /// [`NoEvaluation`]; where the caller wants an end, too.
    pub(super) fn look(&self, problem: &ClutchProblem, x: &[f64]) -> Result<Evaluation, NoEvaluation> {
        self.run(problem, |problem, run| {
            let mut memo = Memo::new(problem, run, usize::MAX);
            memo.one(x.to_vec()).unwrap_or(Err(NoEvaluation::Refused("stopped".to_owned())))
        })
    }

    /// One climb.
    ///
    /// # Errors
    /// As [`maximise_least_margin`].
    pub fn climb(
        &self,
        problem: &ClutchProblem,
        x0: &[f64],
        (lo, hi): (&[f64], &[f64]),
        settings: &Settings,
    ) -> Result<Outcome, Refusal> {
        self.climb_beside(problem, x0, (lo, hi), settings, &[])
    }

    /// The same beside optima that are `known`, each with its least margin.
    ///
    /// # Errors
    /// As [`maximise_least_margin`].
    pub(super) fn climb_beside(
        &self,
        problem: &ClutchProblem,
        x0: &[f64],
        (lo, hi): (&[f64], &[f64]),
        settings: &Settings,
        known: &[(Vec<f64>, f64)],
    ) -> Result<Outcome, Refusal> {
        self.run(problem, |problem, run| {
            let run = SearchRun { known: known.to_vec(), ..run };
            maximise_least_margin(problem, x0, lo, hi, settings, run)
        })
    }
}

impl Watch for Scribe<'_, '_> {
    fn evaluated(&mut self, entry: &Entry) {
        self.desk.with(|record| record.evaluated(&self.problem, entry));
        self.desk.follow.news(News::Done);
    }

    fn derived(&mut self, x: &[f64], along: usize) {
        self.desk.with(|record| record.derived(&self.problem, x, along));
    }

    fn iterated(&mut self, iteration: &Iteration) {
        self.desk.with(|record| record.iterated(iteration));
    }
}
