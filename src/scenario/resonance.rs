//! Periodic states over frequency and amplitude of a torsional excitation.
//!
//! Each amplitude is a row that is walked along twice, upwards and downwards in frequency, every state looked for from that of the
//! neighbour: where the walks find different ones, two states coexist. Rows know nothing of one another, so the map does not depend
//! on how many threads share them.

use super::periodic::{Steady, steady_motion};
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
    let mut walk = |order: &mut dyn Iterator<Item = &f64>, from: Option<Steady>| {
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
            settings.follow.news(News::Done);
        }
        Some(found)
    };
    let Some(up) = walk(&mut frequencies_hz.iter(), None) else { return Ok(None) };
    let Some(mut down) = walk(&mut frequencies_hz.iter().rev(), up.last().cloned()) else { return Ok(None) };
    down.reverse();
    let cells = frequencies_hz.iter().zip(up.into_iter().zip(down)).map(|(&frequency_hz, (state, other))| {
        // A walk that found nothing says nothing against the other.
        let (state, other) = if state.motion.is_err() { (other, state) } else { (state, other) };
        let other = Some(other).filter(|other| other.differs(&state));
        ResonanceCell { frequency_hz, amplitude_nm: amplitude, state, other }
    });
    Ok(Some(cells.collect()))
}
