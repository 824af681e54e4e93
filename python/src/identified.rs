//! Unknown parameters of a design from what was measured.

use crate::design::{Design, parts, stopped};
use crate::errors;
use crate::pool::{interrupted, watched};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use sprag_design::Follow;
use sprag_design::answer::Answer;
use sprag_design::answer::identification::{Identification, StoppedIdentification};
use sprag_design::identify::{FitSettings, NoFit, Unknown, identify as fit, observations};
use std::sync::Arc;
use std::time::Instant;

/// What was found as common keys and figures, each as JSON, its verdict, the new design, and whether Ctrl-C ended it.
type Identified = (String, String, String, Design, bool);

/// Fit `unknowns`, each a name between two bounds, to a table of CSV; `named`: what stands for it in messages; `by`: who asked.
#[pyfunction]
#[allow(clippy::too_many_arguments)] // One question, as the class that asks has it.
pub fn identify(
    py: Python<'_>,
    design: &Bound<'_, Design>,
    table: &str,
    named: &str,
    unknowns: Vec<(String, f64, f64)>,
    starts: usize,
    seed: u64,
    evaluations: usize,
    by: String,
) -> PyResult<Identified> {
    let refused = PyValueError::new_err::<String>;
    let data = observations(table).map_err(|fault| refused(format!("{named}: {fault}")))?;
    let unknowns: Result<Vec<Unknown>, _> =
        unknowns.into_iter().map(|(name, min, max)| Unknown::between(name, min, max)).collect();
    let unknowns = unknowns.map_err(refused)?;
    let (of, stop) = (Arc::clone(&design.get().design), Follow::new());
    let (settings, follow) = (FitSettings { starts, seed, evaluations }, stop.unseen());
    let work = move || {
        let started = Instant::now();
        let seconds = || started.elapsed().as_secs_f64();
        match fit(&of, &data, &unknowns, &settings, &follow) {
            Ok(found) => {
                let answer = Identification { design: &of, found: &found, written: None };
                let (common, body) = parts(&answer.envelope(seconds()))?;
                Ok(Ok((common, body, answer.verdict(), answer.file(&by))))
            }
            Err(NoFit::Stopped(Some(so_far))) => {
                let answer = StoppedIdentification { design: &of, unknowns: &unknowns, so_far: &so_far };
                let (common, body) = parts(&answer.envelope(seconds(), None))?;
                Ok(Ok((common, body, answer.verdict(), answer.file(&by))))
            }
            Err(why) => Ok(Err(why)),
        }
    };
    let (found, why): (PyResult<_>, _) = watched(py, &stop, work, |_| Ok(true))?;
    match (found?, why) {
        (Err(NoFit::Stopped(_)), Some(why)) => Err(why),
        (Err(NoFit::Stopped(_)), None) => Err(stopped()),
        (Err(why @ NoFit::Nowhere { .. }), _) => Err(errors::no_clutch(py, &why)),
        (Err(why), _) => Err(refused(why.to_string())),
        (Ok((common, body, verdict, source)), why) => {
            let interrupted = interrupted(py, why)?;
            Ok((common, body, verdict, design.get().in_place(py, &source)?, interrupted))
        }
    }
}
