//! COBYLA and SLSQP of others on the evaluator of `sprag-design optimize`.
//!
//! `sprag-design-optimiser-peers TOOL DESIGN...` prints CSV: problem, method, evaluations, time_s, objective; the
//! courses of the best value go to standard error as JSON lines. Each method gets the epigraph form (maximise t under
//! objective_i >= t, limit_j >= 0, 0 <= u <= 1) from the file's start and four points of a lattice (with a whole number
//! from the file's start at each of its values), a budget of
//! evaluations for all of them together, and remembered points for nothing.

mod evaluator;

use std::cell::RefCell;
use std::convert::Infallible;
use std::path::Path;
use std::time::Instant;

use basin::{
    Cobyla, ConstraintDescription, ConstraintSet, ConstraintSolveError, Constraints, CostFunction, Executor,
    FiniteDiff, NoBounds, NoLinearConstraints, NoNonlinearBlock, NonlinearBlock, NonlinearBlocks,
    NonlinearInequalityValues, SelectedFirstOrderState, SelectedState, Slsqp,
};
use evaluator::Evaluator;

/// Evaluations for all starts of one method.
const MOST: usize = 3000;
/// Initial and final size of COBYLA's simplex in the unit box.
const RADII: [f64; 2] = [0.1, 1e-6];
/// Step of SLSQP's differences in the unit box.
const STEP: f64 = 1e-5;
/// What a row is where there is no clutch.
const REFUSED: f64 = -10.0;

/// Epigraph form of one problem.
struct Epigraph<'a> {
    evaluator: &'a RefCell<Evaluator>,
    rows: usize,
    /// Evaluations at which it says no more.
    most: usize,
}

impl Epigraph<'_> {
    /// Rows that must be 0 or more, at (u, t).
    fn rows(&self, z: &[f64]) -> Vec<f64> {
        let (u, t) = z.split_at(z.len() - 1);
        let mut evaluator = self.evaluator.borrow_mut();
        let mut rows = vec![REFUSED; self.rows];
        if evaluator.count < self.most
            && let Some(found) = evaluator.at(u)
        {
            rows.clear();
            rows.extend(found.objectives.iter().map(|o| o - t[0]));
            rows.extend(&found.limits);
        }
        rows.extend(u);
        rows.extend(u.iter().map(|u| 1.0 - u));
        rows
    }
}

impl Constraints for Epigraph<'_> {
    type Set =
        ConstraintSet<NoBounds, NoLinearConstraints, NonlinearBlocks<NoNonlinearBlock, NonlinearBlock>>;
    fn constraints(&self) -> <Self::Set as ConstraintDescription>::Borrowed<'_> {
        let variables = self.evaluator.borrow().start.len();
        ConstraintSet::new().with_nonlinear_inequalities(self.rows + 2 * variables)
    }
}

impl CostFunction for Epigraph<'_> {
    type Param = Vec<f64>;
    type Output = f64;
    type Error = Infallible;
    fn cost(&self, z: &Vec<f64>) -> Result<f64, Infallible> {
        Ok(-z[z.len() - 1])
    }
}

impl NonlinearInequalityValues for Epigraph<'_> {
    type Param = Vec<f64>;
    type Values = Vec<f64>;
    type Error = Infallible;
    fn nonlinear_inequalities(&self, z: &Vec<f64>) -> Result<Vec<f64>, ConstraintSolveError<Infallible>> {
        Ok(self.rows(z).iter().map(|g| -g).collect())
    }
}

/// The file's start and four points of a rank-1 lattice (generator: fractional parts of square roots of primes).
fn starts(first: &[f64]) -> Vec<Vec<f64>> {
    const PRIMES: [f64; 10] = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0, 23.0, 29.0];
    let point = |k: usize| (0..first.len()).map(|i| (k as f64 * PRIMES[i % 10].sqrt()).fract()).collect();
    std::iter::once(first.to_vec()).chain((1..5).map(point)).collect()
}

fn basin_cobyla(problem: Epigraph, z: &[f64]) {
    let solver = Cobyla::new().with_initial_radius(RADII[0]).with_final_radius(RADII[1]);
    let state = SelectedState::new(z.to_vec());
    if let Err(e) = Executor::new(problem, solver, state).max_cost_evals(MOST as u64).run() {
        eprintln!("basin COBYLA: {e}");
    }
}

fn basin_slsqp(problem: Epigraph, z: &[f64]) {
    let solver = Slsqp::new().with_absolute_accuracy_tolerance(1e-9);
    let problem = FiniteDiff::new(problem).with_step(STEP);
    if let Err(e) =
        Executor::new(problem, solver, SelectedFirstOrderState::new(z.to_vec())).max_iter(200).run()
    {
        eprintln!("basin SLSQP: {e}");
    }
}

fn nlopt_cobyla(problem: Epigraph, z: &[f64]) {
    let rows = problem.rows(z).len();
    let g: Vec<_> = (0..rows)
        .map(|i| {
            let p = &problem;
            move |z: &[f64], _: &mut ()| p.rows(z)[i]
        })
        .collect();
    let refs: Vec<&dyn cobyla::Func<()>> = g.iter().map(|g| g as &dyn cobyla::Func<()>).collect();
    let mut bounds = vec![(0.0, 1.0); z.len() - 1];
    bounds.push((-5.0, 5.0));
    let stop = cobyla::StopTols { xtol_rel: RADII[1], ..Default::default() };
    let cost = |z: &[f64], _: &mut ()| -z[z.len() - 1];
    if let Err((status, ..)) =
        cobyla::minimize(cost, z, &bounds, &refs, (), MOST, cobyla::RhoBeg::All(RADII[0]), Some(stop))
    {
        eprintln!("cobyla: {status:?}");
    }
}

fn main() -> Result<(), String> {
    let mut arguments = std::env::args().skip(1);
    let tool = arguments.next().ok_or("usage: sprag-design-optimiser-peers TOOL DESIGN...")?;
    type Method = fn(Epigraph, &[f64]);
    let methods: [(&str, Method); 3] = [
        ("basin COBYLA, 5 starts", basin_cobyla),
        ("basin SLSQP, 5 starts", basin_slsqp),
        ("cobyla, 5 starts", nlopt_cobyla),
    ];
    for design in arguments {
        let name =
            Path::new(&design).file_stem().map_or(design.clone(), |s| s.to_string_lossy().into_owned());
        let evaluator = RefCell::new(Evaluator::open(&tool, &design)?);
        let (first, each) = (evaluator.borrow().start.clone(), evaluator.borrow().each);
        let by_value = evaluator.borrow().by_value.clone();
        let starts = if by_value.is_empty() { starts(&first) } else { by_value };
        for (method, go) in methods {
            evaluator.borrow_mut().forget();
            let begun = Instant::now();
            for start in starts.clone() {
                let Some(found) = evaluator.borrow_mut().at(&start) else { continue };
                let least = found.objectives.iter().copied().fold(f64::INFINITY, f64::min);
                let z: Vec<f64> = start.iter().copied().chain([least]).collect();
                let rows = found.objectives.len() + found.limits.len();
                go(Epigraph { evaluator: &evaluator, rows, most: MOST * each }, &z);
            }
            let e = evaluator.borrow();
            let best = e.best.map_or(String::new(), |b| b.to_string());
            println!("{name},\"{method}\",{},{:.2},{best}", e.count, begun.elapsed().as_secs_f64());
            eprintln!("{}", serde_json::json!([name, method, e.course]));
        }
    }
    Ok(())
}
