//! A scene by the paper's own scheme, kept as a reference.

use super::answer::Simulation;
use super::demand::{Fineness, demand_at};
use super::equilibrium::steady;
use super::prepare::{NoScenario, prepare};
use super::simulate::{Settings, Try, conclude};
use crate::clutch::Scenario;
use crate::dynamics::{PublishedSettings, published};

/// Simulate `scenario` with the paper's own scheme, kept as a reference: at `step_s` and at half of it; the
/// first is the answer, the difference its error estimate, which is large because the scheme does not converge.
///
/// # Errors
/// As [`super::simulate()`].
pub fn simulate_published(
    scenario: &Scenario,
    settings: &Settings,
    step_s: f64,
    band_m_s: f64,
) -> Result<Simulation, NoScenario> {
    let prepared = prepare(scenario)?;
    if prepared.duration_s == 0.0 {
        return Ok(steady(&prepared, settings));
    }
    if prepared.model.carried.is_some() && prepared.free_run.is_some() {
        return Err(NoScenario::DrivenCage("the published scheme"));
    }
    if prepared.model.drive.train.is_some() {
        return Err(NoScenario::PublishedTrain);
    }
    let duration_s = prepared.duration_s;
    let follow = &settings.follow;
    follow.begin_pass(true, 0.0);
    let go = |step_s: f64, samples: usize, tolerance: f64| -> Try {
        let s = PublishedSettings { duration_s, step_s, band_m_s, samples };
        follow.begin_run();
        let run = published(&prepared.model, prepared.state, &s, &mut |steps| {
            follow.tell(steps as f64 * step_s);
            !follow.stopped()
        });
        Try::new(&prepared, run, false, || demand_at(&prepared, settings, Fineness::single(tolerance), None))
    };
    let answer = go(step_s, settings.samples, 1e-3 * settings.tolerance);
    let other =
        if answer.interrupted() { answer.clone() } else { go(0.5 * step_s, 0, 1e-2 * settings.tolerance) };
    let s = conclude(&prepared, settings, &answer, &other, None, [0.0; 2]);
    let (a, b) = (answer.run.state[2], other.run.state[2]);
    Ok(Simulation { spread_rad: [a.min(b), a.max(b)], ..s })
}

/// Steps of both runs of [`simulate_published`] over `duration_s`, s.
pub fn published_steps(duration_s: f64, step_s: f64) -> u64 {
    let steps = |step_s| PublishedSettings { duration_s, step_s, band_m_s: 0.0, samples: 0 }.steps();
    steps(step_s) + steps(0.5 * step_s)
}
