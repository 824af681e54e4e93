//! A global search before the climb: argmin's particle swarm, every point through the memo.
//!
//! Points are ranked by Deb's rule (Comput. Methods Appl. Mech. Eng. 186 (2000) 311): a point that holds every limit
//! beats one that does not, two such by their least margin, two others by their violation; one without margins loses.

use std::borrow::Borrow;
use std::cell::{Cell, RefCell};

use argmin::core::{CostFunction, Error, Executor, SyncAlias};
use argmin::solver::particleswarm::ParticleSwarm;
use rand_xoshiro::Xoshiro256PlusPlus;
use rand_xoshiro::rand_core::SeedableRng;

use super::evaluate::{Evaluate, Evaluation, NoEvaluation};
use super::journal::{Halt, Memo, SearchRun};
use super::settings::Settings;
use super::space::Space;
use super::starts::rank;

/// Particles: argmin's own example and the usual choice.
const PARTICLES: usize = 40;
/// Cost at which violations begin; margins of a clutch end far below.
const VIOLATED: f64 = 1e9;
/// Cost of a point without margins.
const NOTHING: f64 = 1e18;

/// The best point of a swarm.
#[derive(Debug, Clone)]
pub struct Swarmed {
    /// Where.
    pub x: Vec<f64>,
    /// Margins there.
    pub evaluation: Evaluation,
    /// Evaluations spent.
    pub evaluations: usize,
}

struct Flock<'m, 'r> {
    memo: RefCell<&'m mut Memo<'r>>,
    space: &'m Space,
    tolerance: f64,
    halted: Cell<Option<Halt>>,
}

impl Flock<'_, '_> {
    fn rank(&self, outcome: &Result<Evaluation, NoEvaluation>) -> f64 {
        match outcome {
            Ok(e) if e.violation() <= self.tolerance => -e.least_margin(),
            Ok(e) => VIOLATED * (1.0 + e.violation()),
            Err(_) => NOTHING,
        }
    }
}

impl CostFunction for Flock<'_, '_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, u: &Vec<f64>) -> Result<f64, Error> {
        Ok(self.bulk_cost(&[u])?[0])
    }

    fn bulk_cost<P: Borrow<Vec<f64>> + SyncAlias>(&self, points: &[P]) -> Result<Vec<f64>, Error> {
        let x = points.iter().map(|u| self.space.unscaled(u.borrow())).collect();
        match self.memo.borrow_mut().batch(x) {
            Ok(outcomes) => Ok(outcomes.iter().map(|o| self.rank(o)).collect()),
            Err(halt) => {
                self.halted.set(Some(halt));
                Err(Error::msg("stopped"))
            }
        }
    }
}

/// Best of some `evaluations` points of a swarm in the box, its draws fixed by `seed`; `None` where no point has margins
/// or the run was stopped before one; a run that was stopped gives the best so far.
pub fn swarm<'a>(
    problem: &'a dyn Evaluate,
    (x0, lo, hi): (&[f64], &[f64], &[f64]),
    settings: &Settings,
    (evaluations, seed): (usize, u64),
    run: SearchRun<'a>,
) -> Option<Swarmed> {
    let space = Space::new(x0, lo, hi).ok()?;
    let mut memo = Memo::new(problem, run, usize::MAX);
    let n = space.len();
    let flock = Flock {
        memo: RefCell::new(&mut memo),
        space: &space,
        tolerance: settings.violation_tolerance,
        halted: Cell::new(None),
    };
    let generator = Xoshiro256PlusPlus::seed_from_u64(seed);
    let solver = ParticleSwarm::new((vec![0.0; n], vec![1.0; n]), PARTICLES).with_rng_generator(generator);
    let rounds = (evaluations / PARTICLES).max(2) as u64 - 1;
    // What was found is in the memo, whether the swarm ended or was stopped.
    drop(Executor::new(flock, solver).configure(|s| s.max_iters(rounds)).timer(false).run());
    let rank = |e: &Evaluation| rank(e, settings.violation_tolerance);
    let evaluations = memo.evaluations();
    let best = memo.known().min_by(|a, b| {
        let (a, b) = (rank(a.1), rank(b.1));
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    best.map(|(x, e)| Swarmed { x: x.clone(), evaluation: e.clone(), evaluations })
}
