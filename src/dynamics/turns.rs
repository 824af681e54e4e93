//! Where nothing that acts changes, the swings of a sprag are the periods of a run: they end where it turns.
//!
//! In overrun friction that falls with speed feeds a swing of the sprag ([`super::swing()`]), and slip within each swing bounds it:
//! minutes of stand-by are a million swings alike. A sprag turns where alpha' rises through zero at a sliding A. Turns are
//! counted where a step ends; once there were [`SEEN`] and as many are to come, each ends a step and what comes back with it
//! is compared ([`Repeat`]).

use super::driver::{Driver, sight};
use super::model::Grip;
use super::probes::{Observed, Probes};
use super::repeat::Repeat;
use super::run::Stop;
use crate::numeric::root;
use crate::ode::adaptive::Size;
use crate::ode::step::{Dense, Step};
use nalgebra::Const;

/// Turns seen before, and to come at least, for the swings between them to be jumped: a choice, as long as a scene whose
/// excitation has so many periods.
const SEEN: u64 = 400;
/// How exactly a turn is located, as a part of a step.
const WIDTH: f64 = 1e-14;
/// alpha' in the state.
const ALPHA_RATE: usize = 4;

/// Turns so far where nothing that acts changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Turns {
    /// When they were begun to be counted, s.
    from_s: f64,
    /// When something that acts changes, s.
    until_s: f64,
    count: u64,
    /// alpha' where the last step has ended, rad/s.
    rate_rad_s: f64,
    /// Whether they are counted: what acts stands still, and nothing of this stretch has been jumped.
    counts: bool,
}

impl Turns {
    /// Before the run.
    pub(super) const NONE: Self =
        Self { from_s: 0.0, until_s: f64::NEG_INFINITY, count: 0, rate_rad_s: 0.0, counts: false };

    /// Look where a step of `driver`'s run has ended.
    pub(super) fn watch<const N: usize>(driver: &mut Driver<'_, N>)
    where
        Const<N>: Size,
    {
        if !driver.settings.jump_swings || driver.settings.rolling {
            return;
        }
        let (t, rate) = (driver.run.t_s, driver.run.state[ALPHA_RATE]);
        if t > driver.turns.until_s {
            if driver.repeat.as_ref().is_some_and(Repeat::awaits_turns) {
                Repeat::leave(driver);
            }
            let still = driver.model.still_until_s(t);
            let until_s = still.unwrap_or_else(|| driver.model.drive.next_break_s(t));
            driver.turns = Self { from_s: t, until_s, count: 0, rate_rad_s: rate, counts: still.is_some() };
        }
        let turns = &mut driver.turns;
        if !turns.counts || driver.repeat.is_some() {
            return;
        }
        let slides = driver.run.mode.inner != Grip::Stick;
        turns.count += u64::from(slides && turns.rate_rad_s < 0.0 && rate >= 0.0);
        turns.rate_rad_s = rate;
        if turns.count < SEEN {
            return;
        }
        let swing_s = (t - turns.from_s) / turns.count as f64;
        let until_s = turns.until_s.min(driver.settings.duration_s);
        turns.counts = false;
        if until_s - t > SEEN as f64 * swing_s {
            driver.repeat = Some(Repeat::of_turns(swing_s, until_s));
        }
    }
}

/// Where alpha' rises through zero within the first `end` of a step of length `h` (s), as a fraction of it.
pub(super) fn turn<const N: usize>(dense: &Dense<N>, h: f64, end: f64) -> Option<f64> {
    let falls = |theta: f64| dense.after(theta * h)[ALPHA_RATE];
    let (before, after) = (falls(0.0), falls(end));
    if !(before < 0.0 && after >= 0.0) {
        return None;
    }
    root::bracketed(0.0, end, before, after, WIDTH, falls).filter(|theta| *theta > 0.0)
}

impl<const N: usize> Driver<'_, N>
where
    Const<N>: Size,
{
    /// Whether turns end periods in the present mode.
    pub(super) fn awaits_turns(&self) -> bool {
        self.run.mode.inner != Grip::Stick && self.repeat.as_ref().is_some_and(Repeat::awaits_turns)
    }

    /// Where within `step`, at whose end it has turned, the sprag turns to end a period, as a fraction of it.
    pub(super) fn turn_in(&mut self, step: &Step<N>, rhs: &mut Observed) -> Option<(f64, Dense<N>)> {
        let turns = self.run.state[ALPHA_RATE] < 0.0 && step.y1()[ALPHA_RATE] >= 0.0;
        if !(turns && self.awaits_turns()) {
            return None;
        }
        let dense = step.dense(rhs, &mut self.run.counters).ok()?;
        turn(&dense, step.h(), 1.0).map(|theta| (theta, dense))
    }

    /// Take the step only up to the turn at `theta`, where a period ends. False: the run has ended.
    pub(super) fn end_period(
        &mut self,
        step: &Step<N>,
        probes: &Probes,
        theta: f64,
        dense: &Dense<N>,
        rhs: &mut Observed,
    ) -> bool {
        let (model, mode, grips) = (self.model, self.run.mode, !self.settings.rolling);
        let sight = |theta: f64| sight(model, &mode, grips, step, dense, theta);
        let probes = probes.until(theta, sight, sight(theta));
        let part = step.until(theta * step.h(), dense);
        self.stepper.h = self.stepper.h.max(step.h());
        if self.remember(&part, &probes, rhs).is_err() {
            self.stop(Stop::NotFinite);
            return false;
        }
        self.accept(&part, probes.end());
        // The next step begins at zero and rises.
        self.run.state[ALPHA_RATE] = self.run.state[ALPHA_RATE].max(0.0);
        (self.slope, self.probed) = (None, None);
        if let Some(repeat) = &mut self.repeat {
            repeat.turn();
        }
        true
    }
}
