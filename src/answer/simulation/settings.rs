//! How a scene is to be simulated.

use crate::clutch::Scenario;
use crate::dynamics::History;
use crate::follow::Follow;
use crate::report::plain;
use crate::scenario::{Settings, TOLERANCES};

/// Shortest step that makes sense, s: below, rounding of the time rules.
const SHORTEST_STEP_S: f64 = 1e-9;

/// Rows of the history of a short scene: one that these show well.
const ROWS: usize = 1200;
/// Rows that show a period of the excitation well.
const ROWS_A_PERIOD: f64 = 24.0;
/// Rows that show a second well: a clutch swings at some 100 Hz.
const ROWS_A_SECOND: f64 = 1000.0;
/// Rows that are not exceeded unless they are asked for.
pub(super) const MOST_ROWS: usize = 400_000;

/// How the equations of motion are integrated.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub enum Integration {
    /// Stick as a constraint, every change of mode located.
    #[default]
    Event,
    /// The paper's scheme (feature `validation`): Runge-Kutta with a narrow band around zero velocity; does not converge.
    #[cfg(feature = "validation")]
    Published {
        /// Half width of the band of zero velocity, m/s; `None`: 1e-4.
        band_m_s: Option<f64>,
    },
}

/// How a scene is to be simulated. The default is what the command does without flags.
#[derive(Debug, Clone, Default)]
pub struct SimulationSettings {
    /// Method of integration.
    pub method: Integration,
    /// True error allowed of every figure of the event method relative to its natural size, 1e-13 to 1e-3; `None`: 1e-6.
    pub tolerance: Option<f64>,
    /// Fixed step of the published scheme, longest step of the event method, s, 1e-9 or more; `None`: 1e-5, and chosen.
    pub step_s: Option<f64>,
    /// Most steps of one run of the event method; `None`: [`Settings::limits`].
    pub most_steps: Option<u64>,
    /// Most changes of mode of one run of the event method; `None`: half as many.
    pub most_events: Option<u64>,
    /// Rows of the history, 2 or more; `None`: 1200, more where that shows the scene badly.
    pub rows: Option<usize>,
    /// Part of the scene that the history of the event method shows, s; `None`: all of it.
    pub window_s: Option<[f64; 2]>,
    /// Whether everything runs, also what the scene cannot feel.
    pub full: bool,
    /// Follows the simulation and ends it.
    pub follow: Follow,
}

/// A setting that makes no sense.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{} {}: allowed: {allowed}", .setting.name(), plain(*.found, 15))]
pub struct RefusedSetting {
    /// Which one, a field of [`SimulationSettings`].
    pub setting: Setting,
    /// What was found.
    pub found: f64,
    /// What is allowed.
    pub allowed: String,
}

named! {
    /// A field of [`SimulationSettings`] that may be refused.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Setting {
        /// [`SimulationSettings::tolerance`].
        Tolerance = "tolerance",
        /// [`SimulationSettings::step_s`].
        Step = "step_s",
        /// [`SimulationSettings::window_s`].
        Window = "window_s",
    }
    /// Its field.
    pub fn name;
}

impl SimulationSettings {
    /// Refuse a tolerance, a step, a window that makes no sense in any scene.
    ///
    /// # Errors
    /// [`RefusedSetting`].
    pub fn validate(&self) -> Result<(), RefusedSetting> {
        if let Some(step) = self.step_s.filter(|step| !(*step >= SHORTEST_STEP_S && step.is_finite())) {
            return Err(refused(Setting::Step, step, format!("{SHORTEST_STEP_S:e} s or more")));
        }
        let [low, high] = TOLERANCES;
        if let Some(x) = self.tolerance.filter(|x| !(low..=high).contains(x)) {
            return Err(refused(Setting::Tolerance, x, format!("{low:e} to {high:e}; 1e-6 serves well")));
        }
        match self.window_s {
            Some([from, until]) if !(from >= 0.0 && from < until) => {
                Err(refused(Setting::Window, from, format!("0 or more, and before its end at {until} s")))
            }
            _ => Ok(()),
        }
    }

    /// Refuse what makes no sense in `scenario`: a step longer than it, a run of the published scheme that would not end in a
    /// day, a window beyond its end.
    ///
    /// # Errors
    /// [`RefusedSetting`].
    pub fn validate_for(&self, scenario: &Scenario) -> Result<(), RefusedSetting> {
        self.validate()?;
        let Some(duration) = scenario.kind.duration_s() else { return Ok(()) };
        #[cfg(feature = "validation")]
        self.validate_published(duration)?;
        match self.window_s {
            // The published scheme knows no window.
            Some([_, until]) if until > duration && !self.is_published() => {
                Err(refused(Setting::Window, until, format!("up to the end of the scene at {duration} s")))
            }
            _ => Ok(()),
        }
    }

    pub(super) fn is_published(&self) -> bool {
        self.method != Integration::Event
    }

    /// How many samples, and of what. Where 1200 do not show a scene well there are more, and changes of mode and extremes
    /// beside them.
    pub(super) fn history(&self, scenario: &Scenario) -> (usize, History) {
        let [from, until] = self.window_s.unwrap_or([0.0, scenario.kind.duration_s().unwrap_or(0.0)]);
        let frequency_hz = scenario.kind.frequency_hz().unwrap_or(0.0);
        let well = 1 + ((ROWS_A_PERIOD * frequency_hz).max(ROWS_A_SECOND) * (until - from)).round() as usize;
        let history = History { window_s: self.window_s, marks: self.rows.is_none() && well > ROWS };
        (self.rows.unwrap_or(well.clamp(ROWS, MOST_ROWS)), history)
    }

    pub(super) fn of_run(&self, scenario: &Scenario) -> Settings {
        let (samples, history) = self.history(scenario);
        let chosen = Settings::default();
        Settings {
            tolerance: self.tolerance.unwrap_or(chosen.tolerance),
            // The published scheme has a step of its own.
            longest_step_s: self.step_s.filter(|_| !self.is_published()),
            samples,
            history,
            most_steps: self.most_steps,
            most_events: self.most_events,
            every_period: self.full,
            energy: true,
            slip_heat: true,
            follow: self.follow.clone(),
        }
    }
}

pub(super) fn refused(setting: Setting, found: f64, allowed: String) -> RefusedSetting {
    RefusedSetting { setting, found, allowed }
}
