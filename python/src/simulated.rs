//! The class `_core.Simulated`: a scene that has run.

use crate::errors::json;
use crate::pool::compute;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList};
use sprag_design::Follow;
use sprag_design::answer::simulation::{SimulationAnswer, Values};
use std::sync::Arc;

/// What became of a scene.
#[pyclass(frozen, module = "sprag_design._core")]
pub struct Simulated {
    answer: Arc<SimulationAnswer>,
    common: String,
}

impl Simulated {
    pub fn new(answer: SimulationAnswer, common: String) -> Self {
        Self { answer: Arc::new(answer), common }
    }
}

#[pymethods]
impl Simulated {
    /// Common keys as JSON.
    #[getter]
    fn common(&self) -> &str {
        &self.common
    }

    /// Figures as JSON.
    fn json(&self) -> PyResult<String> {
        json(&self.answer.body)
    }

    /// The verdict in one line.
    fn verdict_line(&self) -> String {
        self.answer.verdict_line()
    }

    /// Columns by name: numbers as the bytes of doubles, words and counts as lists.
    fn history<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let answer = Arc::clone(&self.answer);
        let history = compute(py, &Follow::nobody(), move || answer.history())?;
        let columns = PyDict::new(py);
        for (name, values) in history.columns {
            match values {
                Values::Numbers(numbers) => {
                    let bytes: Vec<u8> = numbers.iter().flat_map(|v| v.to_ne_bytes()).collect();
                    columns.set_item(&*name, PyBytes::new(py, &bytes))?;
                }
                Values::Words(words) => columns.set_item(&*name, PyList::new(py, words)?)?,
                Values::Counts(counts) => columns.set_item(&*name, PyList::new(py, counts)?)?,
            }
        }
        Ok(columns)
    }
}
