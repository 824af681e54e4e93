//! The class `_core.Problem`: the optimiser's evaluator.

use crate::errors::json;
use crate::pool;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::prelude::*;
use serde_json::json as object;
use sprag_design::design::Optimize;
use sprag_design::optimise::{ClutchProblem, Evaluate};
use sprag_design::sweep::{BoxSample, Sampling};
use sprag_design::{Design, Follow};
use std::sync::Arc;

/// A design's variables and the margins at their values.
#[pyclass(frozen, module = "sprag_design._core")]
pub struct Problem {
    problem: Arc<ClutchProblem>,
    task: Optimize,
    about: String,
}

impl Problem {
    pub fn new(design: &Design, file: &str, full: bool) -> PyResult<Self> {
        let Some(task) = design.optimize.as_ref() else {
            return Err(PyValueError::new_err(format!(
                "{file}: the design has no [optimize] table; add one with objective, scenarios and variables"
            )));
        };
        let problem = Arc::new(ClutchProblem::of_task(design, task, full));
        let about = |v: &sprag_design::design::OptimizeVariable| object!({ "name": v.name, "min": v.min, "max": v.max, "start": v.start, "whole": v.whole });
        let variables: Vec<_> = task.variables.iter().map(about).collect();
        let about = json(&object!({ "aim": task.objective.name(), "variables": variables }))?;
        Ok(Self { problem, task: task.clone(), about })
    }

    /// Refuse what is no vector of this problem.
    fn checked(&self, x: &[f64]) -> PyResult<()> {
        let count = self.task.variables.len();
        if x.len() != count {
            let names: Vec<&str> = self.task.variables.iter().map(|v| v.name.as_str()).collect();
            let found = x.len();
            return Err(PyValueError::new_err(format!(
                "{found} values for {count} variables: {}",
                names.join(", ")
            )));
        }
        self.task.outside(x).map_or(Ok(()), |why| Err(PyValueError::new_err(why)))
    }
}

/// Objectives and limits, or the reason why there are none.
type Evaluated = (Vec<f64>, Vec<f64>, f64, f64, bool, Option<String>);

fn evaluated(problem: &ClutchProblem, x: &[f64]) -> Evaluated {
    match problem.evaluate(x) {
        Ok(e) => {
            let (least, violation) = (e.least_margin(), problem.missed(&e));
            let feasible = violation <= sprag_design::margin::RESOLUTION;
            (e.objectives, e.limits, least, violation, feasible, None)
        }
        Err(why) => (Vec::new(), Vec::new(), f64::NAN, f64::NAN, false, Some(why.to_string())),
    }
}

#[pymethods]
impl Problem {
    /// Aim and variables as JSON.
    #[getter]
    fn about(&self) -> &str {
        &self.about
    }

    /// Names of objectives and limits, those of the start.
    fn names(&self, py: Python<'_>, x: Vec<f64>) -> PyResult<(Vec<String>, Vec<String>)> {
        self.checked(&x)?;
        let assessed = py.detach(|| self.problem.assess_at(&x));
        let assessed = assessed.map_err(|why| crate::errors::no_clutch(py, &why))?;
        let names = self.problem.names(&assessed);
        Ok((names.objectives, names.limits))
    }

    /// Objectives, limits, least objective, violation, feasible, and why there is no clutch at x.
    fn evaluate(&self, py: Python<'_>, x: Vec<f64>) -> PyResult<Evaluated> {
        self.checked(&x)?;
        // One evaluation uses one thread, so that a process that was forked needs no pool for it.
        Ok(py.detach(|| evaluated(&self.problem, &x)))
    }

    /// The same of many points side by side, in their order.
    fn evaluate_all(&self, py: Python<'_>, points: Vec<Vec<f64>>) -> PyResult<Vec<Evaluated>> {
        points.iter().try_for_each(|x| self.checked(x))?;
        let (problem, follow) = (self.problem.clone(), Follow::new());
        let stop = follow.clone();
        let one = move |x: Vec<f64>| (!stop.stopped()).then(|| evaluated(&problem, &x));
        let all =
            pool::compute(py, &follow, move || points.into_par_iter().map(one).collect::<Option<Vec<_>>>())?;
        // What was stopped has raised already.
        Ok(all.unwrap_or_default())
    }

    /// Scrambled Sobol points of the box, from number `first` on: those of the command `sample`.
    fn sample(&self, count: u64, seed: u64, first: u64) -> PyResult<Vec<Vec<f64>>> {
        let until = first.saturating_add(count);
        let sample = BoxSample::of(&self.task, &Sampling::Sobol { count: until, seed });
        let sample = sample.map_err(|why| PyValueError::new_err(why.to_string()))?;
        Ok((first..until).map(|i| sample.point(i)).collect())
    }

    /// The design file at x.
    fn file_at(&self, py: Python<'_>, x: Vec<f64>) -> PyResult<String> {
        self.checked(&x)?;
        py.detach(|| self.problem.finished_file(&x)).map_err(|why| PyValueError::new_err(why.to_string()))
    }
}
