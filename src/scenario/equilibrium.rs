//! Scenes in which nothing moves: static load and steady overrun.

use super::answer::{Simulation, Verdict};
use super::demand::demand;
use super::error::Scales;
use super::prepare::Prepared;
use super::simulate::{Settings, hertz_at, hertz_peak};
use super::sliding::swing_about;
use crate::clutch::{Scenario, ScenarioKind, Start};
use crate::dynamics::{Neglected, Peaks, SlipRecord, Stop, Swing};
use crate::wedge::StaticPoint;

/// Static and overrunning scenarios: equilibrium, no integration.
pub(super) fn steady(prepared: &Prepared, settings: &Settings) -> Simulation {
    let demand = prepared.overrun.is_none().then(|| demand(prepared, settings));
    let row = prepared.at_rest();
    let (n_bi, n_be, tan_inner, tan_outer) = match (prepared.overrun, row) {
        (Some(o), _) => (o.normal_inner_n, o.normal_outer_n, o.tan_inner, o.tan_outer),
        (None, Some(r)) => (r.normal_inner_n, r.normal_outer_n, r.tan_omega, r.tan_nu),
        (None, None) => (0.0, 0.0, 0.0, 0.0),
    };
    let verdict = match prepared.overrun {
        Some(o) if o.sliding_n > 0.0 => Verdict::SlipsOverrunning,
        Some(_) => Verdict::Disengages,
        None if demand.is_some_and(|d| d.slip_margin >= Some(0.0)) => Verdict::Sticks,
        // A sprag whose demand exceeds mu_s is squeezed out backwards under torque.
        None => Verdict::SlipsEngaging,
    };
    let (normal_min_n, normal_max_n, normal_outer_max_n) = (n_bi, n_bi, n_be);
    let peaks = Peaks { tan_inner, tan_outer, normal_min_n, normal_max_n, normal_outer_max_n, ..Peaks::NONE };
    Simulation {
        verdict: Some(verdict),
        stop: Stop::Finished,
        t_s: 0.0,
        theta_inner_rad: prepared.state[2],
        theta_outer_rad: prepared.state[3],
        offset_rad: 0.0,
        inner: SlipRecord::default(),
        outer: SlipRecord::default(),
        carried_m: 0.0,
        contact_lost_s: 0.0,
        peaks,
        hertz_peak_pa: hertz_peak(prepared, n_bi, n_be),
        hertz_static_pa: hertz_peak(prepared, n_bi, n_be),
        hertz_least_pa: hertz_at(prepared, n_bi),
        static_normal_n: n_bi,
        demand,
        rolled: false,
        events: 0,
        steps: 0,
        rejections: 0,
        rhs_evaluations: 0,
        error: None,
        equilibrium_error: Some(equilibrium_error(prepared, row.as_ref())),
        scales: Scales::of(prepared, &peaks),
        tolerance_reached: true,
        finer_gave_up: None,
        gave_up: None,
        spread_rad: [prepared.state[2]; 2],
        zeno_closures: 0,
        inconsistent_choices: 0,
        fast_motion: None,
        energy: None,
        slip_heat: [None; 2],
        wear_m2_per_n: None,
        samples: Vec::new(),
        neglected: Neglected::default(),
        engaged: None,
        first_hold: None,
        modes: Vec::new(),
        jumps: Vec::new(),
        train: None,
        overrun: prepared.overrun,
    }
}

/// The small swing about the steady overrun of `scenario`; `None` for other kinds and for sprags that have lifted off.
pub fn overrun_swing(scenario: &Scenario, prepared: &Prepared) -> Option<Swing> {
    let ScenarioKind::Overrun { overrun_rad_s, .. } = scenario.kind else { return None };
    let (model, steady) = (&prepared.model, prepared.overrun.as_ref()?);
    let film = model.film.as_ref();
    swing_about(steady, &scenario.clutch, &model.curve, model.alpha_max_rad, overrun_rad_s, film)
}

/// To what part every figure of an equilibrium is right: what of the torque is left over, what the windup's interpolation
/// leaves out, and what the curve's iterations stop at; in overrun what of the moments is.
fn equilibrium_error(prepared: &Prepared, row: Option<&StaticPoint>) -> f64 {
    const SETTLED: f64 = 1e-13;
    let torque_nm = -prepared.model.loads.inner_nm;
    match (prepared.overrun, row) {
        (Some(overrun), _) => SETTLED + overrun.relative_error,
        (None, Some(row)) if torque_nm > 0.0 => {
            // Where the spring counts alpha is located to its rounding.
            let located = if prepared.start == Start::Settled { f64::EPSILON / row.alpha_rad } else { 0.0 };
            SETTLED + prepared.model.curve.truncation() + (row.torque_nm / torque_nm - 1.0).abs() + located
        }
        _ => SETTLED,
    }
}
