//! What others read: the design sheet, drawings, solids, tables, decks, units for co-simulation.

use crate::design::{Design, stopped};
use crate::errors;
use crate::pool::compute;
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use sprag_design::Follow;
use sprag_design::answer::check::NoCheck;
use sprag_design::answer::exported::{DEVIATION_MM, Exported, LEAST_DEVIATION_MM, PartFormat};
use sprag_design::answer::{Answer, Provenance};
use sprag_design::export::calculix::{NoDeck, Options, Variant};
use sprag_design::export::fmu::{Fmi, NoUnit, inertias_beyond};
use sprag_design::export::{NoPart, Part};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

/// The design sheet as HTML; `by`: who asked.
#[pyfunction]
pub fn sheet(py: Python<'_>, design: &Bound<'_, Design>, by: String) -> PyResult<String> {
    let (design, stop) = (Arc::clone(&design.get().design), Follow::new());
    let follow = stop.clone();
    let found = compute(py, &stop, move || {
        let started = Instant::now();
        let check = design.check(&follow)?;
        let provenance = Provenance { command: by, run_time_s: started.elapsed().as_secs_f64() };
        Ok(check.sheet().page(&provenance).to_html())
    })?;
    found.map_err(|why| match why {
        NoCheck::NoClutch(why) => errors::no_clutch(py, &why),
        NoCheck::Stopped => stopped(),
    })
}

/// One of `all` by its name.
fn named<T: Copy>(what: &str, name: &str, all: &[T], of: impl Fn(T) -> &'static str) -> PyResult<T> {
    let none = || {
        let known = all.iter().map(|one| of(*one)).collect::<Vec<_>>().join(", ");
        PyValueError::new_err(format!("{what} {name:?}: allowed: {known}"))
    };
    all.iter().copied().find(|one| of(*one) == name).ok_or_else(none)
}

/// A part as a drawing (dxf, svg), a solid (step) or a table (arcs, points), and what the one who makes it should know.
#[pyfunction]
pub fn part(
    py: Python<'_>,
    design: &Bound<'_, Design>,
    format: &str,
    part: &str,
    deviation_mm: Option<f64>,
) -> PyResult<(String, Option<String>)> {
    let deviation_mm = deviation_mm.unwrap_or(DEVIATION_MM);
    if !(deviation_mm >= LEAST_DEVIATION_MM && deviation_mm.is_finite()) {
        return Err(PyValueError::new_err(format!(
            "deviation_mm {deviation_mm}: allowed: {LEAST_DEVIATION_MM} or more"
        )));
    }
    let part = named("part", part, &Part::ALL, Part::name)?;
    let formats = [
        ("dxf", PartFormat::Dxf),
        ("step", PartFormat::Step),
        ("svg", PartFormat::Svg),
        ("arcs", PartFormat::Arcs),
        ("points", PartFormat::Points { deviation_mm }),
    ];
    let (_, format) = named("format", format, &formats, |(name, _)| name)?;
    let design = Arc::clone(&design.get().design);
    let written = py.detach(|| {
        let made = format.made(&design, part)?;
        let subject = made.drawn(&design);
        let text = format.text(part, &subject);
        Ok(text.map(|text| {
            let answer = Exported { design: &design, subject: &subject, part, format, bytes: text.len() };
            let note = answer.note();
            (text, note)
        }))
    });
    match written {
        Ok(text) => text.map_err(PyValueError::new_err),
        Err(NoPart::Refused(why)) => Err(errors::refused(py, &why)),
        Err(why) => Err(errors::no_clutch(py, &why)),
    }
}

/// A deck for CalculiX.
#[pyfunction]
pub fn deck(
    py: Python<'_>,
    design: &Bound<'_, Design>,
    variant: Option<&str>,
    mesh_mm: Option<f64>,
    torque_nm: Option<f64>,
    increments: Option<usize>,
    friction: Option<f64>,
) -> PyResult<String> {
    let usual = Options::default();
    let variant = variant.map(|name| named("variant", name, &Variant::ALL, Variant::name)).transpose()?;
    let options = Options {
        variant: variant.unwrap_or(usual.variant),
        mesh_m: mesh_mm.map_or(usual.mesh_m, |mm| 1e-3 * mm),
        friction: friction.unwrap_or(usual.friction),
        increments,
        ..usual
    };
    let of = Arc::clone(&design.get().design);
    let deck = compute(py, &Follow::nobody(), move || of.deck(torque_nm, &options))?;
    deck.map_err(|why| match why {
        NoDeck::Profile(_) | NoDeck::Outline(_) | NoDeck::NoCurve(_) => errors::no_clutch(py, &why),
        why => PyValueError::new_err(format!("no deck: {why}")),
    })
}

/// A unit for co-simulation around a library.
#[pyfunction]
pub fn unit<'py>(
    py: Python<'py>,
    design: &Bound<'py, Design>,
    three: bool,
    library: PathBuf,
    clutch_alone: bool,
) -> PyResult<Bound<'py, PyBytes>> {
    let of = Arc::clone(&design.get().design);
    let train = inertias_beyond(&of);
    if !train.is_empty() && !clutch_alone {
        return Err(PyValueError::new_err(format!(
            "[[drivetrain]] ({}): a unit holds the clutch between its two flanges and no shafts; clutch_alone=True leaves them out",
            train.join(", ")
        )));
    }
    let bytes = std::fs::read(&library)?;
    let unit = compute(py, &Follow::nobody(), move || {
        let fmi = if three { Fmi::Three } else { Fmi::Two };
        of.co_simulation_unit(fmi, &bytes, &|path| std::fs::read(path)).map(|unit| unit.archive.bytes)
    })?;
    let unit = unit.map_err(|why| match why {
        NoUnit::NoStart(_) => errors::no_clutch(py, &why),
        NoUnit::Library => PyValueError::new_err(format!("{}: {why}", library.display())),
        NoUnit::Platform => PyValueError::new_err(why.to_string()),
        NoUnit::History(..) | NoUnit::Archive(_) => PyOSError::new_err(why.to_string()),
    })?;
    Ok(PyBytes::new(py, &unit))
}
