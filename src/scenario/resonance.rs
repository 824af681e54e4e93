//! Periodic states over frequency and amplitude of a torsional excitation.
//!
//! Each amplitude is a row that is walked along twice, upwards and downwards in frequency, every state looked for from that of the
//! neighbour: where the walks find different ones, two states coexist. Rows know nothing of one another, so the map does not depend
//! on how many threads share them.

use super::periodic::{MotionKind, Steady, steady_motion};
use super::prepare::{NoScenario, prepare};
use super::simulate::Settings;
use crate::clutch::{Scenario, ScenarioKind};
use crate::follow::News;
use rayon::prelude::*;

/// The states of one frequency and amplitude.
#[derive(Debug, Clone)]
pub struct ResonanceCell {
    /// Hz.
    pub frequency_hz: f64,
    /// N m.
    pub amplitude_nm: f64,
    /// Found upwards.
    pub state: Steady,
    /// Found downwards, where it is another.
    pub other: Option<Steady>,
}

/// The states of `scenario` at every amplitude (N m), the first row first, and every frequency (Hz, rising), with its start and all
/// else. [`Settings::follow`] is told of each cell. Stopped by it [`Settings::follow`]: the rows that were walked both ways until then; `Ok(None)`: not one,
/// or no torsional excitation.
///
/// # Errors
/// [`NoScenario`] where the clutch cannot carry the preload.
pub fn resonance(
    scenario: &Scenario,
    frequencies_hz: &[f64],
    amplitudes_nm: &[f64],
    settings: &Settings,
) -> Result<Option<Vec<Vec<ResonanceCell>>>, NoScenario> {
    let rows: Result<Vec<_>, NoScenario> = amplitudes_nm
        .par_iter()
        .map(|&amplitude_nm| row(scenario, frequencies_hz, amplitude_nm, settings))
        .collect();
    let rows: Vec<_> = rows?.into_iter().flatten().collect();
    Ok(Some(rows).filter(|rows| !rows.is_empty()))
}

/// Where neither walk finds a motion: ways to its frequency, as parts of it, along which it is looked for once more.
const BESIDE: [[f64; 4]; 2] = [[0.97, 0.98, 0.99, 1.0], [1.03, 1.02, 1.01, 1.0]];

fn row(
    scenario: &Scenario,
    frequencies_hz: &[f64],
    amplitude: f64,
    settings: &Settings,
) -> Result<Option<Vec<ResonanceCell>>, NoScenario> {
    let mut scenario = scenario.clone();
    let ScenarioKind::TorsionalExcitation { amplitude_nm, .. } = &mut scenario.kind else { return Ok(None) };
    *amplitude_nm = amplitude;
    let mut prepared = prepare(&scenario)?;
    let mut walk = |order: &mut dyn Iterator<Item = &f64>, from: Option<Steady>, done: &dyn Fn()| {
        let mut found: Vec<Steady> = Vec::new();
        for &frequency_hz in order {
            prepared.period_s = Some(1.0 / frequency_hz);
            prepared.model.loads.omega_rad_s = std::f64::consts::TAU * frequency_hz;
            let near = found.last().or(from.as_ref());
            let state = steady_motion(&prepared, settings, near)?;
            // One that was cut short is none.
            if settings.follow.stopped() {
                return None;
            }
            found.push(state);
            done();
        }
        Some(found)
    };
    let done = || settings.follow.news(News::Done);
    let Some(up) = walk(&mut frequencies_hz.iter(), None, &done) else { return Ok(None) };
    let Some(mut down) = walk(&mut frequencies_hz.iter().rev(), up.last().cloned(), &done) else {
        return Ok(None);
    };
    down.reverse();
    let mut cells = Vec::new();
    for (&frequency_hz, (state, other)) in frequencies_hz.iter().zip(up.into_iter().zip(down)) {
        // A walk that found nothing says nothing against the other.
        let (mut state, mut other) = if state.motion.is_err() { (other, state) } else { (state, other) };
        let mut beside = BESIDE.iter();
        while state.kind == MotionKind::NotFound
            && let Some(parts) = beside.next()
        {
            let way = parts.map(|part| part * frequency_hz);
            let Some(mut states) = walk(&mut way.iter(), None, &|| ()) else { return Ok(None) };
            if let Some(found) = states.pop().filter(|found| found.kind != MotionKind::NotFound) {
                (state, other) = (found.clone(), found);
            }
        }
        let other = Some(other).filter(|other| other.differs(&state));
        cells.push(ResonanceCell { frequency_hz, amplitude_nm: amplitude, state, other });
    }
    Ok(Some(cells))
}
