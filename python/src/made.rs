//! First designs, and designs side by side.

use crate::design::{Design, parts, stopped};
use crate::errors::{self, json};
use crate::pool::compute;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use sprag_design::Follow;
use sprag_design::answer::comparison::{Comparison, MOST_COMPARED, NoComparison, subjects};
use sprag_design::answer::sizing::{Sizing, taken, tried};
use sprag_design::answer::{Answer, Provenance};
use sprag_design::compare::Subject;
use sprag_design::file::a_steel;
use sprag_design::scenario::Settings;
use sprag_design::size::{ASKED, NoSize, PURPOSES, Wish, asked, purpose as named_purpose, size};
use std::sync::Arc;
use std::time::Instant;

/// What a clutch may be for: name, and what that means.
#[pyfunction]
pub fn purposes() -> Vec<(&'static str, &'static str)> {
    PURPOSES.iter().map(|p| (p.name, p.words)).collect()
}

/// Names of the numbers as arguments.
fn as_arguments(text: &str) -> String {
    let hyphens = ASKED.iter().filter(|row| row.key.contains('-'));
    hyphens.fold(text.to_owned(), |text, row| text.replace(row.key, &row.key.replace('-', "_")))
}

/// Common keys, figures and what was taken, each as JSON, the verdict, the design. `numbers`: argument, key of the library, value.
#[pyfunction]
pub fn first_design(
    py: Python<'_>,
    purpose: Option<String>,
    numbers: Vec<(String, String, f64)>,
    material: Option<String>,
) -> PyResult<(String, String, String, String, Design)> {
    let mut wish = Wish::default();
    if let Some(name) = purpose {
        let known = || PURPOSES.map(|p| p.name).join(", ");
        let found = named_purpose(&name);
        let none = || PyValueError::new_err(format!("purpose {name:?}: allowed: {}", known()));
        wish.purpose = Some(found.ok_or_else(none)?);
    }
    if let Some(name) = material {
        let none = |why| PyValueError::new_err(format!("material {name:?}: {why}"));
        wish.steel = Some(a_steel(&name).map_err(none)?);
    }
    for (argument, key, typed) in &numbers {
        let row = asked(key).ok_or_else(|| PyValueError::new_err(format!("no number {argument}")))?;
        *(row.at)(&mut wish) = Some(row.unit.si(*typed));
    }
    let wanted = wish.check().map_err(|why| {
        let argument = numbers.iter().find(|(_, key, _)| key == why.what);
        let name = argument.map_or(why.what, |(name, ..)| name);
        let rest = as_arguments(&format!("found {}; allowed: {}", why.found, why.allowed));
        PyValueError::new_err(format!("{name}: {rest}"))
    })?;
    let stop = Follow::new();
    let settings = Settings { follow: stop.unseen(), ..Settings::default() };
    let sized = compute(py, &stop, move || {
        let started = Instant::now();
        let sized = size(&wanted, &settings);
        sized.map(|sized| (sized, started.elapsed().as_secs_f64()))
    })?;
    let (sized, seconds) = sized.map_err(|why| match &why {
        NoSize::Requirements(why) => PyValueError::new_err(why.to_string()),
        NoSize::None { tried: list, .. } => {
            let words = why.to_string().replace("`width`", "width_mm").replace("`outside`", "outside_mm");
            match json(&tried(list, None).objects()) {
                Ok(tried) => errors::not_sized(py, words, tried),
                Err(why) => why,
            }
        }
    })?;
    let answer = Sizing::of(&sized, "First design", None);
    let (common, body) = parts(&answer.envelope(seconds))?;
    let verdict = Answer::verdict(&answer);
    let taken = json(&taken(&wanted, Some(&sized)))?;
    let design = Arc::new(sized.made.design);
    Ok((common, body, taken, verdict, Design { design, file: "design.toml".to_owned() }))
}

/// Designs side by side.
#[pyclass(frozen, module = "sprag_design._core")]
pub struct Compared {
    subjects: Vec<Subject>,
    files: Vec<String>,
    seconds: f64,
}

impl Compared {
    fn of(&self) -> PyResult<Comparison<'_>> {
        Comparison::of(&self.subjects, &self.files).ok_or_else(stopped)
    }
}

#[pymethods]
impl Compared {
    /// Common keys and figures, each as JSON, and the verdict.
    fn parts(&self, py: Python<'_>) -> PyResult<(String, String, String)> {
        py.detach(|| {
            let compared = self.of()?;
            let (common, body) = parts(&compared.envelope(self.seconds))?;
            Ok((common, body, compared.verdict()))
        })
    }

    /// The page, HTML; `by`: who asked.
    fn page(&self, py: Python<'_>, by: String) -> PyResult<String> {
        py.detach(|| {
            let provenance = Provenance { command: by, run_time_s: self.seconds };
            Ok(self.of()?.page(&provenance).to_html())
        })
    }
}

/// Compare designs, the one before first.
#[pyfunction]
pub fn compare(py: Python<'_>, designs: Vec<Bound<'_, Design>>) -> PyResult<Compared> {
    let count = designs.len();
    if !(2..=MOST_COMPARED).contains(&count) {
        return Err(PyValueError::new_err(format!("{count} designs: allowed: 2 to {MOST_COMPARED}")));
    }
    let files: Vec<String> = designs.iter().map(|d| d.get().file.clone()).collect();
    let all: Vec<_> = designs.iter().map(|d| (*d.get().design).clone()).collect();
    let (stop, started) = (Follow::new(), Instant::now());
    let follow = stop.clone();
    let found = compute(py, &stop, move || subjects(all, &follow))?;
    let seconds = started.elapsed().as_secs_f64();
    match found {
        Ok(subjects) => Ok(Compared { subjects, files, seconds }),
        Err(NoComparison::NoClutch(i, why)) => {
            Err(errors::no_clutch(py, &format!("design {} ({}): {why}", i + 1, files[i])))
        }
        Err(NoComparison::Stopped) => Err(stopped()),
    }
}
