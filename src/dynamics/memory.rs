//! Going on where a run has ended: what the driver knows, as plain numbers.
//!
//! Time is counted from the start of each run: the end of one is t = 0 of the next. Nothing of the right-hand side is
//! kept, for other torques may act from there on.

use serde::{Deserialize, Serialize};

use super::driver::{Driver, KINDS};
use super::events::EVENTS;
use super::model::{Mode, Model, N_STATE, Place, State};
use super::run::{Run, RunSettings};
use super::zeno::KEPT;
use crate::ode::adaptive::Pace;

/// Larger than any angle (rad), rate (rad/s) or distance (m) of a clutch, and small enough that nothing overflows.
const LARGEST: f64 = 1e15;

/// Where a run stands, and what it needs to go on as if it had not been interrupted. Numbers only, all finite: written
/// and read back it is the same to the bit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Memory {
    state: State,
    mode: Mode,
    /// theta_bi - theta_be + W that stick keeps, rad.
    phase_rad: Option<f64>,
    pace: Option<Pace>,
    lengths_s: [Option<f64>; KINDS],
    /// Last change of mode: when, s, not above 0, and which event.
    landed: Option<(f64, usize)>,
    /// The last changes of mode, as far as they may accumulate.
    changes: [Option<(f64, [bool; EVENTS])>; KEPT],
}

impl Memory {
    /// At the beginning.
    pub fn new(state: State, mode: Mode) -> Self {
        let (lengths_s, changes) = ([None; KINDS], [None; KEPT]);
        Self { state, mode, phase_rad: None, pace: None, lengths_s, landed: None, changes }
    }

    /// State.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Mode.
    pub fn mode(&self) -> Mode {
        self.mode
    }

    /// The same with the angles of inner and outer race counted from `inner_rad` and `outer_rad` on. Nothing else changes
    /// where no abutment holds the outer race.
    pub fn turned_back(&self, inner_rad: f64, outer_rad: f64) -> Self {
        let mut back = *self;
        back.state[1] -= outer_rad;
        back.state[2] -= inner_rad;
        back.state[3] -= outer_rad;
        back.phase_rad = self.phase_rad.map(|phase| phase - (inner_rad - outer_rad));
        back
    }

    /// The same motion in another model, whose contacts may end elsewhere and hold the races at another windup.
    pub fn moved_to(&self, model: &Model) -> Self {
        let place = match self.mode.place {
            Place::Arc(_) => Place::Arc(model.curve.arc_at(self.state[0])),
            Place::Carried if model.carried.is_none() => Place::Open,
            other => other,
        };
        Self { mode: Mode { place, ..self.mode }, phase_rad: None, ..*self }
    }

    /// Whether it may be of a run of `model`: numbers are those of a machine, and its places exist.
    pub fn fits(&self, model: &Model) -> bool {
        let finite = |x: &f64| x.abs() < LARGEST;
        let place = match self.mode.place {
            Place::Open => true,
            Place::Arc(k) => k < model.curve.arc_count(),
            Place::Tension => false,
            Place::Carried => model.carried.is_some(),
        };
        let positive = |h: &f64| h.is_finite() && *h > 0.0;
        place
            && self.state.iter().chain(&self.phase_rad).all(finite)
            && self.pace.iter().map(|p| &p.h).chain(self.lengths_s.iter().flatten()).all(positive)
            && self.landed.is_none_or(|(t, which)| t.is_finite() && which < EVENTS)
            && self.changes.iter().flatten().all(|(t, _)| t.is_finite())
    }
}

impl Memory {
    fn recalled_by(&self, driver: &mut Driver<'_, N_STATE>) {
        driver.phase = self.phase_rad.or(driver.phase);
        if let Some(pace) = self.pace {
            driver.stepper.go_on_at(pace);
        }
        driver.lengths = self.lengths_s.map(|h| h.unwrap_or(f64::INFINITY));
        driver.landed = self.landed.unwrap_or(driver.landed);
        for (last, kept) in driver.zeno.last.iter_mut().zip(&self.changes) {
            *last = kept.unwrap_or(*last);
        }
    }

    fn of(driver: &Driver<'_, N_STATE>) -> Self {
        let before = |t: f64| t - driver.run.t_s;
        let landed = Some((before(driver.landed.0), driver.landed.1));
        Self {
            state: driver.run.state,
            mode: driver.run.mode,
            phase_rad: driver.phase,
            pace: Some(driver.stepper.pace()),
            lengths_s: driver.lengths.map(|h| h.is_finite().then_some(h)),
            landed: landed.filter(|(t, _)| t.is_finite()),
            changes: driver.zeno.last.map(|(t, fell)| t.is_finite().then_some((before(t), fell))),
        }
    }
}

/// Integrate on from `memory`, [`RunSettings::duration_s`] at most, under the torques of `model` with their time counted
/// from there. From [`Memory::new`] on it is [`super::run()`], to the bit. What the run says is of this stretch alone.
pub fn go_on(model: &Model, memory: &Memory, settings: &RunSettings) -> (Run, Memory) {
    let mut driver = Driver::new(model, memory.state, memory.mode, settings);
    memory.recalled_by(&mut driver);
    settings.follow.begin_run();
    driver.begin();
    driver.integrate();
    let memory = Memory::of(&driver);
    (driver.finish(), memory)
}
