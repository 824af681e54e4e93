//! `sprag_design._core`: the library's answers for the Python package `sprag_design`, which puts them into classes.
//!
//! In: a design's text or path, questions as numbers and names. Out: JSON of the library's serde types, histories as bytes,
//! drawings, exceptions with their problems. Absent: figures of its own. No thread holds Python's lock while it computes.

mod design;
mod errors;
mod export;
mod identified;
mod made;
mod pool;
mod problem;
mod resonance;
mod search;
mod simulated;
mod sweep;

use pyo3::prelude::*;
use std::ffi::OsString;

/// Run the command `sprag-design` with these arguments, the first the program's name; the exit code.
#[pyfunction]
fn run_command(py: Python<'_>, args: Vec<OsString>) -> u8 {
    py.detach(|| sprag_design::cli::run_from(args))
}

/// Names of the contact laws.
#[pyfunction]
fn contact_laws() -> Vec<&'static str> {
    sprag_design::clutch::LAWS.iter().map(|law| law.key).collect()
}

/// Compiled part of sprag_design.
#[pymodule]
fn _core(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", sprag_design::cli::output::VERSION)?;
    module.add_class::<design::Design>()?;
    module.add_class::<problem::Problem>()?;
    module.add_class::<simulated::Simulated>()?;
    module.add_function(wrap_pyfunction!(run_command, module)?)?;
    module.add_function(wrap_pyfunction!(contact_laws, module)?)?;
    module.add_function(wrap_pyfunction!(pool::forked, module)?)?;
    module.add_function(wrap_pyfunction!(sweep::map_tables, module)?)?;
    module.add_function(wrap_pyfunction!(search::optimize, module)?)?;
    module.add_function(wrap_pyfunction!(resonance::resonance, module)?)?;
    module.add_function(wrap_pyfunction!(identified::identify, module)?)?;
    module.add_class::<made::Compared>()?;
    module.add_function(wrap_pyfunction!(made::purposes, module)?)?;
    module.add_function(wrap_pyfunction!(made::first_design, module)?)?;
    module.add_function(wrap_pyfunction!(made::compare, module)?)?;
    module.add_function(wrap_pyfunction!(export::sheet, module)?)?;
    module.add_function(wrap_pyfunction!(export::part, module)?)?;
    module.add_function(wrap_pyfunction!(export::deck, module)?)?;
    module.add_function(wrap_pyfunction!(export::unit, module)?)?;
    Ok(())
}
