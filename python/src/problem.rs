//! The class `_core.Problem`: the optimiser's evaluator.

use crate::errors::json;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use serde_json::json as object;
use sprag_design::Design;
use sprag_design::optimise::{ClutchProblem, Evaluate, Fidelity};

/// A design's variables and the margins at their values.
#[pyclass(frozen, module = "sprag_design._core")]
pub struct Problem {
    problem: ClutchProblem,
    /// Name, least and greatest value of each variable.
    bounds: Vec<(String, f64, f64)>,
    about: String,
}

impl Problem {
    pub fn new(design: &Design, file: &str, full: bool) -> PyResult<Self> {
        let Some(task) = design.optimize.as_ref() else {
            return Err(PyValueError::new_err(format!(
                "{file}: the design has no [optimize] table; add one with objective, scenarios and variables"
            )));
        };
        let variables: Vec<String> = task.variables.iter().map(|v| v.name.clone()).collect();
        let fidelity = Fidelity { reduced: !full, ..Fidelity::default() };
        let problem = ClutchProblem::new(design, task, variables, fidelity).quickly();
        let about = |v: &sprag_design::design::OptimizeVariable| object!({ "name": v.name, "min": v.min, "max": v.max, "start": v.start, "whole": v.whole });
        let variables: Vec<_> = task.variables.iter().map(about).collect();
        let about = json(&object!({ "aim": task.objective.name(), "variables": variables }))?;
        let bounds = task.variables.iter().map(|v| (v.name.clone(), v.min, v.max)).collect();
        Ok(Self { problem, bounds, about })
    }

    /// Refuse what is no vector of this problem.
    fn checked(&self, x: &[f64]) -> PyResult<()> {
        let count = self.bounds.len();
        if x.len() != count {
            let names: Vec<&str> = self.bounds.iter().map(|b| b.0.as_str()).collect();
            let found = x.len();
            return Err(PyValueError::new_err(format!(
                "{found} values for {count} variables: {}",
                names.join(", ")
            )));
        }
        let outside =
            x.iter().zip(&self.bounds).enumerate().find(|(_, (x, (_, lo, hi)))| !(lo..=hi).contains(x));
        match outside {
            Some((i, (x, (name, lo, hi)))) => Err(PyValueError::new_err(format!(
                "x[{i}], {name} = {x}, lies outside its bounds {lo} to {hi}"
            ))),
            None => Ok(()),
        }
    }
}

/// Objectives and limits, or the reason why there are none.
type Evaluated = (Vec<f64>, Vec<f64>, f64, f64, bool, Option<String>);

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
        let looked = py.detach(|| self.problem.look_at(&x));
        let looked = looked.map_err(|why| crate::errors::no_clutch(py, &why))?;
        let names = self.problem.names(&looked);
        Ok((names.objectives, names.limits))
    }

    /// Objectives, limits, least objective, violation, feasible, and why there is no clutch at x.
    fn evaluate(&self, py: Python<'_>, x: Vec<f64>) -> PyResult<Evaluated> {
        self.checked(&x)?;
        // One evaluation uses one thread, so that a process that was forked needs no pool for it.
        match py.detach(|| self.problem.evaluate(&x)) {
            Ok(e) => {
                let (least, violation) = (e.least_margin(), e.violation());
                let feasible = violation <= sprag_design::margin::RESOLUTION;
                Ok((e.objectives, e.limits, least, violation, feasible, None))
            }
            Err(why) => Ok((Vec::new(), Vec::new(), f64::NAN, f64::NAN, false, Some(why.to_string()))),
        }
    }

    /// The design file at x.
    fn file_at(&self, py: Python<'_>, x: Vec<f64>) -> PyResult<String> {
        self.checked(&x)?;
        py.detach(|| self.problem.finished_file(&x)).map_err(|why| PyValueError::new_err(why.to_string()))
    }
}
