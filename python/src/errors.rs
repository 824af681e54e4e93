//! Exceptions of the package, which are Python's own classes in `sprag_design._errors`.

use pyo3::exceptions::{PyOSError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use sprag_design::DesignError;
use sprag_design::cli::exit::Failure;
use std::any::Any;

fn of_class(
    py: Python<'_>,
    class: &str,
    args: impl FnOnce(&Bound<'_, PyAny>) -> PyResult<Py<PyAny>>,
) -> PyErr {
    let made = py.import("sprag_design._errors").and_then(|module| args(&module.getattr(class)?));
    match made {
        Ok(error) => PyErr::from_value(error.into_bound(py)),
        Err(why) => why,
    }
}

/// A refused design: every problem with file, line, key.
pub fn refused(py: Python<'_>, why: &DesignError) -> PyErr {
    let (message, problems) = (why.to_string(), why.to_json().to_string());
    of_class(py, "DesignError", |class| Ok(class.call1((message, problems))?.unbind()))
}

/// A design of which no clutch comes about.
pub fn no_clutch(py: Python<'_>, why: &impl ToString) -> PyErr {
    let message = why.to_string();
    of_class(py, "NoClutch", |class| Ok(class.call1((message,))?.unbind()))
}

/// No clutch of the family does what is asked; `tried`: every race space, as JSON.
pub fn not_sized(py: Python<'_>, why: String, tried: String) -> PyErr {
    of_class(py, "NotSized", |class| Ok(class.call1((why, tried))?.unbind()))
}

/// A journal that cannot be used. An option of the command is an argument here.
pub fn failed(why: &Failure) -> PyErr {
    let message =
        why.to_json()["message"].as_str().unwrap_or_default().replace("with --journal", "as journal");
    match why {
        Failure::Failed(_) => PyOSError::new_err(message),
        _ => PyValueError::new_err(message),
    }
}

/// A panic of the library, which is a fault of it.
pub fn panicked(panic: &(dyn Any + Send)) -> PyErr {
    let text = panic.downcast_ref::<&str>().map(|s| (*s).to_owned());
    let text = text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_default();
    PyRuntimeError::new_err(format!("a fault of sprag-design, please report it: {text}"))
}

/// An answer as JSON.
pub fn json(answer: &impl serde::Serialize) -> PyResult<String> {
    serde_json::to_string(answer).map_err(|why| PyRuntimeError::new_err(format!("JSON: {why}")))
}
