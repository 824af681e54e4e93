//! A scene by the paper's own scheme: its settings, and its run.

use super::settings::{Integration, RefusedSetting, Setting, SimulationSettings, refused};
use crate::clutch::Scenario;
use crate::scenario::{NoScenario, Prepared, Simulation, prepare, published_steps, simulate_published};

/// The paper's step, s.
const STEP_S: f64 = 1e-5;
/// Half width of the band of zero velocity, m/s; the paper gives none, a choice.
const BAND_M_S: f64 = 1e-4;
/// Steps that one simulation takes on: some hours.
const MOST_STEPS: u64 = 1_000_000_000;

impl SimulationSettings {
    /// Refuse a step longer than the scene of `duration` seconds, and a run that would not end in a day.
    pub(super) fn validate_published(&self, duration: f64) -> Result<(), RefusedSetting> {
        if !self.is_published() {
            return Ok(());
        }
        let step = self.published_step_s();
        if step > duration && self.step_s.is_some() {
            let allowed = format!("at most the duration of the scenario, {duration} s");
            return Err(refused(Setting::Step, step, allowed));
        }
        let steps = published_steps(duration, step);
        if steps > MOST_STEPS {
            let least = step * (steps as f64 / MOST_STEPS as f64);
            let allowed = format!(
                "{least:.1e} s or more: at most {:e} steps in twice the scenario's {duration} s, the second time halved",
                MOST_STEPS as f64
            );
            return Err(refused(Setting::Step, step, allowed));
        }
        Ok(())
    }

    fn published_step_s(&self) -> f64 {
        self.step_s.unwrap_or(STEP_S)
    }

    pub(super) fn run_published(&self, scenario: &Scenario) -> Result<(Prepared, Simulation), NoScenario> {
        let band_m_s = match self.method {
            Integration::Published { band_m_s: Some(band) } => band,
            _ => BAND_M_S,
        };
        let prepared = prepare(scenario)?;
        let settings = self.of_run(scenario);
        let simulation = simulate_published(scenario, &settings, self.published_step_s(), band_m_s)?;
        Ok((prepared, simulation))
    }
}
