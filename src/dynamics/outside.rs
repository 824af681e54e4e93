//! The modes for integrators of others: event functions, and the rule for what comes after each.
//!
//! Between events the right-hand side is [`Model::slope`]. No second copy of a rule: both functions are those of
//! [`super::run()`].

use super::driver::Driver;
use super::events::{EVENTS, probe};
use super::model::{Mode, Model, State};
use super::run::{RunSettings, Stop};

/// Functions whose falling through zero ends `mode`: alpha at the lower and upper end of its place (rad), grip at A, at B
/// (m/s in slip, N in stick). Positive inside the mode; right after a change one may be zero, or below it by rounding,
/// and rise.
pub fn events(model: &Model, mode: &Mode, t: f64, y: &State) -> [f64; EVENTS] {
    probe(model, mode, t, y, true).events
}

/// The mode after the event function `which` (0 to 3, in the order of [`events`]) of `mode` has fallen to zero at `t` (s)
/// in the state `y`, with the state there: rates jump where rolling ratios do, and keep the rolling constraints.
///
/// # Errors
/// [`Stop`] where the event ends the run.
pub fn next_mode(model: &Model, mode: &Mode, which: usize, t: f64, y: &State) -> Result<(Mode, State), Stop> {
    // Nothing is integrated: of these only `rolling` matters.
    let settings = RunSettings {
        tolerance: 1e-6,
        duration_s: t,
        longest_step_s: 1.0,
        most_events: 1,
        most_steps: 1,
        ..RunSettings::default()
    };
    let mut driver = Driver::new(model, *y, *mode, &settings);
    driver.run.t_s = t;
    if driver.change(which, t, *y) { Ok((driver.run.mode, driver.run.state)) } else { Err(driver.run.stop) }
}
