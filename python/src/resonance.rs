//! Periodic states of a torsional excitation.

use crate::design::{Design, parts, stopped};
use crate::errors;
use crate::pool::{interrupted, watched};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;
use sprag_design::Follow;
use sprag_design::answer::Answer;
use sprag_design::answer::resonance::{NoResonance, ResonanceQuestion, no_excitation};
use sprag_design::design::WhichScenario;
use sprag_design::scenario::Settings;
use std::sync::Arc;
use std::time::Instant;

/// Common keys and figures, each as JSON, and whether Ctrl-C ended it.
#[pyfunction]
pub fn resonance(
    py: Python<'_>,
    design: &Bound<'_, Design>,
    scenario: Option<String>,
    frequency_hz: Option<[f64; 2]>,
    amplitude_nm: Option<[f64; 2]>,
    points: Option<[usize; 2]>,
    tolerance: f64,
) -> PyResult<(String, String, bool)> {
    let asked = design.get();
    let refused = |why: String| PyValueError::new_err(format!("{}: {why}", asked.file));
    let question = ResonanceQuestion::over(frequency_hz, amplitude_nm, points);
    let question = question.map_err(|why| PyValueError::new_err(why.to_string()))?;
    let scene = asked.design.which_scenario(scenario.as_deref(), |s| s.kind.frequency_hz().is_some());
    let scene = scene.map_err(|why| match why {
        WhichScenario::None => refused(no_excitation(&asked.design).trim_end().to_owned()),
        why @ WhichScenario::Unknown { .. } => PyKeyError::new_err(why.to_string()),
        why @ WhichScenario::Several { .. } => refused(why.to_string()),
    })?;
    let (of, name, stop) = (Arc::clone(&asked.design), scene.name.clone(), Follow::new());
    let settings = Settings { tolerance, follow: stop.unseen(), ..Settings::default() };
    let work = move || {
        let started = Instant::now();
        let scene = of.scenario(&name).ok_or(NoResonance::NoExcitation)?;
        let found = of.resonance(scene, &question, &settings)?;
        Ok(parts(&found.envelope(started.elapsed().as_secs_f64())))
    };
    let (found, why) = watched(py, &stop, work, |_| Ok(true))?;
    match (found, why) {
        (Err(NoResonance::Stopped), Some(why)) => Err(why),
        (Err(NoResonance::Stopped), None) => Err(stopped()),
        (Err(why @ NoResonance::NoStart(_)), _) => Err(errors::no_clutch(py, &why)),
        (Err(why), _) => Err(refused(format!("{}: {why}", scene.name))),
        (Ok(found), why) => {
            let interrupted = interrupted(py, why)?;
            found.map(|(common, body)| (common, body, interrupted))
        }
    }
}
