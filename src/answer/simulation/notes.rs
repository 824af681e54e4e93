//! What a reader must know beside the figures of a scene: why a run gave up, what is in doubt, what was not felt.

use super::settings::MOST_ROWS;
use super::{Effect, Ran, SimulationSettings};
use crate::clutch::Scenario;
use crate::dynamics::{Stop, Swing};
use crate::report::Unit;
use crate::scenario::{Simulation, overrun_swing};

/// A published run whose angle moves by more than this when its step is halved has not converged, rad.
const CONVERGED_RAD: f64 = 1e-4;

/// What a reader must know beside the figures.
pub(super) fn of(scene: &Ran, damping: Option<&Effect>, settings: &SimulationSettings) -> Vec<String> {
    let mut notes = super::unfelt::notes(&scene.scenario);
    let simulation = scene.simulation();
    if let Ok((prepared, _)) = &scene.outcome
        && let Some(swing) = overrun_swing(&scene.scenario, prepared).filter(Swing::grows)
    {
        notes.push(format!(
            "warning: this overrun does not stay: races at constant speeds, a small swing of the sprags grows by {} at {}; drag \
             and forces are those of the equilibrium, not what the clutch does; a transient scenario with overrun_rpm shows \
             that",
            Unit::PerSecond.show(swing.growth_rate_per_s, 3),
            Unit::Hertz.show(swing.frequency_hz, 3),
        ));
    }
    if scene.method == "equilibrium" {
        if settings.is_published() || settings.step_s.is_some() {
            notes.push("an equilibrium: nothing is integrated, --method and --step say nothing".into());
        }
    } else if let Some(s) = simulation
        && (s.verdict.is_none() || s.stop.gave_up())
    {
        let lead = if s.verdict.is_none() { "no verdict" } else { "not to the end" };
        let why = scene.given_up().unwrap_or_else(|| "only one of two runs came to its end".to_owned());
        notes
            .push(format!("{lead}: {why}; the figures hold up to {:.6} s, without an error estimate", s.t_s));
    }
    if let Some(rows) = fewer(settings, &scene.scenario) {
        notes.push(rows);
    }
    notes.extend(damping.and_then(Effect::note));
    if let Some(s) = simulation
        && let Some(fast) = s.fast_motion
    {
        notes.push(format!(
            "the fastest motion where the run gave up: the {} at {:.2e} rad/s with an amplitude of {:.1e} rad",
            fast.of, fast.rate_rad_s, fast.amplitude_rad
        ));
    }
    notes.extend(above_peak(scene));
    if let Some(s) = simulation.filter(|s| s.zeno_closures > 0) {
        notes.push(format!("accumulating changes of mode were closed at their limit: {}", s.zeno_closures));
    }
    if let Some(s) = simulation.filter(|s| s.inconsistent_choices > 0) {
        notes.push(format!(
            "no choice of stick and slip was consistent at {} changes of mode; the nearest was taken",
            s.inconsistent_choices
        ));
    }
    if let Some(s) =
        simulation.filter(|s| scene.method == "event" && s.error.is_some() && !s.tolerance_reached)
    {
        let [low, high] = s.spread_rad;
        let (figure, by) = worst(s);
        let finer = s.finer_gave_up.and(scene.given_up()).map_or(String::new(), |why| format!("; {why}"));
        notes.push(format!(
            "the tolerance is not reached: furthest from it is the {figure}, off by {by:.1e} of its natural size{finer}; \
             theta_inner_end lies between {low:.9} and {high:.9} rad over the runs made"
        ));
    }
    let moved = simulation.and_then(|s| s.error).map_or(0.0, |e| e.theta_inner_rad);
    if scene.method == "published" && moved > CONVERGED_RAD {
        notes.push(format!(
            "the published scheme has not converged: half the step moves theta_inner_end by {moved:.2e} rad; \
             --method event does converge"
        ));
    }
    notes
}

/// A sentence where the sprags are pressed harder than peak torque would.
fn above_peak(scene: &Ran) -> Option<String> {
    let (prepared, s) = (&scene.outcome.as_ref().ok()?.0, scene.simulation()?);
    let peak_nm = scene.design.limits.peak_torque_nm?;
    let torque_nm = prepared.model.curve.at_normal(s.peaks.normal_max_n)?.torque_nm;
    let nm = |nm: f64| Unit::NewtonMetre.show(nm, 4);
    (nm(torque_nm) != nm(peak_nm) && torque_nm > peak_nm).then(|| {
        format!(
            "the largest normal force is that of a steady {}: more than peak_torque_nm of [limits], {}",
            nm(torque_nm),
            nm(peak_nm)
        )
    })
}

/// A sentence where the scene is so long that its history has fewer rows than show it well.
fn fewer(settings: &SimulationSettings, scenario: &Scenario) -> Option<String> {
    let (rows, history) = settings.history(scenario);
    (history.marks && rows == MOST_ROWS).then(|| {
        format!(
            "the history has {rows} rows, too few to show every swing; --window A:B shows a part of it finely"
        )
    })
}

/// The figure furthest from the tolerance, and its error by its natural size; what the energy balance leaves over is one.
pub(super) fn worst(s: &Simulation) -> (&'static str, f64) {
    let left = s.energy.map_or(0.0, |e| e.relative().abs());
    let figure = s.error.map_or(("", 0.0), |e| s.scales.worst_figure(&e));
    if figure.1 < left { ("energy left over", left) } else { figure }
}

/// A limit that lets a run go on which met `limit` at `t_s` of `duration_s`, s: half as much again as it would take at that
/// rate, at least twice and at most a hundred times as much, in one digit.
fn enough(limit: u64, t_s: f64, duration_s: f64) -> u64 {
    let wanted = limit as f64 * (1.5 * duration_s / t_s).clamp(2.0, 100.0);
    let digit = 10f64.powf(wanted.log10().floor());
    ((wanted / digit).ceil() * digit) as u64
}

impl Ran {
    /// Why a run did not come to its end, and what would let it.
    pub fn given_up(&self) -> Option<String> {
        let s = self.simulation()?;
        let duration_s = self.scenario.kind.duration_s()?;
        let finer = if s.finer_gave_up.is_some() { "a finer run " } else { "the run " };
        let Some(g) = s.gave_up else {
            return (s.stop == Stop::Interrupted).then(|| "stopped by Ctrl-C".to_owned());
        };
        let at = format!("at {:.6} s of {duration_s} s", g.t_s);
        let met = |limit: u64, what: &str, flag: &str| {
            let more = enough(limit, g.t_s, duration_s);
            format!("{finer}met its limit of {limit} {what} {at}; {flag} {more} would take it further")
        };
        Some(match (g.stop, g.limit) {
            (Stop::Interrupted, _) => format!("{finer}was stopped by Ctrl-C {at}"),
            (Stop::StepLimit, Some(limit)) => met(limit, "steps", "--max-steps"),
            (Stop::EventLimit, Some(limit)) => met(limit, "changes of mode", "--max-changes"),
            (Stop::StepLimit, None) => format!("the steps of {finer}became too short {at}"),
            _ => format!("the equations of {finer}ceased to be finite {at}"),
        })
    }
}
