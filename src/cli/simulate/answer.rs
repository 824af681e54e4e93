//! The JSON object of `simulate`.

use super::Scene;
use super::facts::shape_error;
use crate::cli::left_out::LeftOut;
use crate::design::ScenarioKind;
use crate::dynamics::{EnergyBalance, SlipRecord, Stop};
use crate::scenario::{ErrorEstimate, Prepared, Simulation, overrun_swing};
use serde::Serialize;

/// Slip at one contact.
#[derive(Debug, Default, Serialize)]
pub(super) struct Slip {
    time_s: Option<f64>,
    distance_mm: Option<f64>,
    net_mm: Option<f64>,
}

/// Slip at both contacts.
#[derive(Debug, Default, Serialize)]
pub(super) struct Slips {
    inner: Slip,
    outer: Slip,
}

/// Differences between the two runs.
#[derive(Debug, Serialize)]
struct Errors {
    theta_inner_rad: f64,
    theta_outer_rad: f64,
    offset_rad: f64,
    net_slip_mm: f64,
    net_slip_outer_mm: f64,
    slip_distance_mm: [f64; 2],
    slip_time_s: [f64; 2],
    contact_lost_s: f64,
    /// The larger of the two below.
    peak_tan_demand: f64,
    tan_inner: f64,
    tan_outer: f64,
    normal_min_n: f64,
    normal_max_n: f64,
    normal_outer_max_n: f64,
    hertz_peak_mpa: f64,
    hertz_least_mpa: f64,
    initial_slip_s: f64,
    required_static_friction: f64,
    slip_margin: f64,
    contact_margin: f64,
}

/// Where the energy went, J: works (positive: brought in), changes, what the balance leaves over.
#[derive(Debug, Serialize)]
struct Energy {
    friction_inner_j: f64,
    friction_outer_j: f64,
    race_damping_j: f64,
    contact_damping_j: f64,
    torque_inner_j: f64,
    torque_outer_j: f64,
    frame_j: f64,
    kinetic_change_j: f64,
    stored_change_j: f64,
    through_j: f64,
    residual_j: f64,
    /// Residual by the energy that went through.
    relative: f64,
}

/// The fastest motion.
#[derive(Debug, Serialize)]
struct Fast {
    rate_rad_s: f64,
    amplitude_rad: f64,
    of: &'static str,
}

/// A figure that is the largest or smallest of a run.
#[derive(Debug, Serialize)]
struct Extreme {
    value: f64,
    /// When it was reached first.
    at_s: f64,
    /// By how much that moved between the last runs: of extremes that are equal within their error any may be named.
    at_moved_s: Option<f64>,
}

#[derive(Debug, Serialize)]
struct Extremes {
    tan_inner: Extreme,
    tan_outer: Extreme,
    normal_min_n: Extreme,
    normal_max_n: Extreme,
    normal_outer_max_n: Extreme,
}

/// The state of a static scenario or of a steady overrun.
#[derive(Debug, Serialize)]
struct Equilibrium {
    alpha_rad: f64,
    torque_nm: f64,
    normal_inner_n: f64,
    normal_outer_n: f64,
    tan_inner: f64,
    tan_outer: f64,
    /// Null in overrun, as are the stiffnesses.
    windup_rad: Option<f64>,
    k_secant_nm_per_rad: Option<f64>,
    k_tangent_nm_per_rad: Option<f64>,
    /// Error of each figure, also of margins and pressure, by its own size.
    relative_error: f64,
    /// That of the pressure: with its shape where a junction lies under the inner contact.
    hertz_relative_error: f64,
}

/// Keys of `simulate`; null where a figure does not exist for the scenario.
#[derive(Debug, Default, Serialize)]
pub(super) struct Body {
    scenario: String,
    kind: &'static str,
    method: &'static str,
    verdict: Option<&'static str>,
    stop: &'static str,
    /// Why the scenario has no start, or why a run did not come to its end and what would let it.
    reason: Option<String>,
    t_end_s: Option<f64>,
    theta_inner_end_rad: Option<f64>,
    theta_outer_end_rad: Option<f64>,
    offset_rad: Option<f64>,
    slip: Slips,
    contact_lost_s: Option<f64>,
    peak_tan_demand: Option<f64>,
    required_static_friction: Option<f64>,
    /// `rolling`: the peak of |T|/N in pure rolling; `bisection`: by runs with slip, where rolling unloads the contact.
    required_static_friction_by: Option<&'static str>,
    slip_margin: Option<f64>,
    contact_margin: Option<f64>,
    normal_min_n: Option<f64>,
    normal_max_n: Option<f64>,
    extremes: Option<Extremes>,
    equilibrium: Option<Equilibrium>,
    hertz_peak_mpa: Option<f64>,
    hertz_static_mpa: Option<f64>,
    hertz_least_mpa: Option<f64>,
    hertz_rated_mpa: Option<f64>,
    events: Option<u64>,
    zeno_closures: Option<u64>,
    inconsistent_choices: Option<u64>,
    /// What was fastest where the run gave up.
    #[serde(skip_serializing_if = "Option::is_none")]
    fast_motion: Option<Fast>,
    steps: Option<u64>,
    rejections: Option<u64>,
    rhs_evaluations: Option<u64>,
    error_estimates: Option<Errors>,
    #[serde(skip_serializing_if = "Option::is_none")]
    energy_balance: Option<Energy>,
    /// Inputs of an engagement that the paper does not publish for its Figure 8.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    assumptions: Vec<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tolerance_reached: Option<bool>,
    /// The figure whose error is largest by its natural size, where the tolerance is not reached, and that.
    #[serde(skip_serializing_if = "Option::is_none")]
    worst_figure: Option<(&'static str, f64)>,
    /// Why a run with finer steps than those that answer did not come to its end.
    #[serde(skip_serializing_if = "Option::is_none")]
    finer_gave_up: Option<&'static str>,
    /// Smallest and largest theta_inner_end over the runs made, where the tolerance is not reached.
    #[serde(skip_serializing_if = "Option::is_none")]
    spread_rad: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    initial_slip_s: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    drag_torque_nm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    lift_off_rpm: Option<f64>,
    /// Of a small swing of the sprags about a steady overrun, races at held speeds; + grows. Absent where they are off.
    #[serde(skip_serializing_if = "Option::is_none")]
    growth_rate_per_s: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    swing_frequency_hz: Option<f64>,
    /// N_bi about which they swing: that of the equations of motion.
    #[serde(skip_serializing_if = "Option::is_none")]
    swing_normal_inner_n: Option<f64>,
    /// Terms that the planner looked at and kept.
    kept: Vec<LeftOut>,
    notes: Vec<String>,
}

impl Slip {
    fn of(record: &SlipRecord) -> Self {
        Self {
            time_s: Some(record.time_s),
            distance_mm: Some(record.distance_m * 1e3),
            net_mm: Some(record.net_m * 1e3),
        }
    }
}

impl Energy {
    fn of(e: &EnergyBalance) -> Self {
        Self {
            friction_inner_j: e.friction_inner_j,
            friction_outer_j: e.friction_outer_j,
            race_damping_j: e.race_damping_j,
            contact_damping_j: e.contact_damping_j,
            torque_inner_j: e.torque_inner_j,
            torque_outer_j: e.torque_outer_j,
            frame_j: e.frame_j,
            kinetic_change_j: e.kinetic_j,
            stored_change_j: e.stored_j,
            through_j: e.through_j,
            residual_j: e.residual_j(),
            relative: e.relative(),
        }
    }
}

impl Errors {
    fn of(scene: &Scene, prepared: &Prepared, s: &Simulation, e: &ErrorEstimate) -> Self {
        let shape = |pa: f64, normal_n: f64| pa * shape_error(scene, prepared, normal_n);
        let peak = e.hertz_peak_pa + shape(s.hertz_peak_pa, s.peaks.normal_max_n);
        let least = e.hertz_least_pa + shape(s.hertz_least_pa, s.peaks.normal_min_n);
        Self {
            theta_inner_rad: e.theta_inner_rad,
            theta_outer_rad: e.theta_outer_rad,
            offset_rad: e.offset_rad,
            net_slip_mm: e.net_slip_m * 1e3,
            net_slip_outer_mm: e.net_slip_outer_m * 1e3,
            slip_distance_mm: e.slip_distance_m.map(|d| d * 1e3),
            slip_time_s: e.slip_time_s,
            contact_lost_s: e.contact_lost_s,
            peak_tan_demand: e.tan_demand[0].max(e.tan_demand[1]),
            tan_inner: e.tan_demand[0],
            tan_outer: e.tan_demand[1],
            normal_min_n: e.normal_min_n,
            normal_max_n: e.normal_max_n,
            normal_outer_max_n: e.normal_outer_max_n,
            hertz_peak_mpa: peak / 1e6,
            hertz_least_mpa: least / 1e6,
            initial_slip_s: e.initial_slip_s,
            required_static_friction: e.required_friction,
            slip_margin: e.slip_margin,
            contact_margin: e.contact_margin,
        }
    }
}

impl Extremes {
    fn of(s: &Simulation) -> Self {
        let p = s.peaks;
        let one = |value: f64, i: usize| Extreme {
            value,
            at_s: p.at_s[i],
            at_moved_s: s.error.map(|e| e.extremes_at_s[i]),
        };
        Self {
            tan_inner: one(p.tan_inner, 0),
            tan_outer: one(p.tan_outer, 1),
            normal_min_n: one(p.normal_min_n, 2),
            normal_max_n: one(p.normal_max_n, 3),
            normal_outer_max_n: one(p.normal_outer_max_n, 4),
        }
    }
}

impl Equilibrium {
    fn of(scene: &Scene, prepared: &Prepared, s: &Simulation) -> Option<Self> {
        let relative_error = s.equilibrium_error?;
        let alpha_rad = prepared.state[0];
        let hertz_relative_error = relative_error + shape_error(scene, prepared, s.peaks.normal_max_n);
        if let Some(o) = s.overrun {
            return Some(Self {
                alpha_rad,
                torque_nm: o.drag_torque_nm,
                normal_inner_n: o.normal_inner_n,
                normal_outer_n: o.normal_outer_n,
                tan_inner: o.tan_inner,
                tan_outer: o.tan_outer,
                windup_rad: None,
                k_secant_nm_per_rad: None,
                k_tangent_nm_per_rad: None,
                relative_error,
                hertz_relative_error,
            });
        }
        let row = prepared.at_rest()?;
        Some(Self {
            alpha_rad,
            torque_nm: row.torque_nm,
            normal_inner_n: row.normal_inner_n,
            normal_outer_n: row.normal_outer_n,
            tan_inner: row.tan_omega,
            tan_outer: row.tan_nu,
            windup_rad: Some(row.windup_rad),
            k_secant_nm_per_rad: Some(row.k_secant_nm_per_rad),
            k_tangent_nm_per_rad: Some(row.k_tangent_nm_per_rad),
            relative_error,
            hertz_relative_error,
        })
    }
}

impl Body {
    pub(super) fn of(scene: &Scene) -> Self {
        let kind = match scene.scenario.kind {
            ScenarioKind::Static { .. } => "static",
            ScenarioKind::TorsionalExcitation { .. } => "torsional-excitation",
            ScenarioKind::Engagement { .. } => "engagement",
            ScenarioKind::Overrun { .. } => "overrun",
            ScenarioKind::Transient { .. } => "transient",
        };
        let base = Self {
            scenario: scene.scenario.name.clone(),
            kind,
            method: scene.method,
            verdict: scene.verdict(),
            kept: scene.planned[1].iter().map(|t| LeftOut::new(t.term, &t.why, &t.cost)).collect(),
            notes: scene.notes.clone(),
            ..Self::default()
        };
        let (prepared, s) = match &scene.outcome {
            Err(why) => return Self { stop: "no-start", reason: Some(why.to_string()), ..base },
            Ok((prepared, s)) => (prepared, s),
        };
        let overruns = matches!(scene.scenario.kind, ScenarioKind::Overrun { .. });
        let swing = overrun_swing(scene.scenario, prepared);
        let known = s.demand.filter(|d| d.gave_up.is_none());
        Self {
            stop: s.stop.name(),
            reason: scene.given_up(),
            t_end_s: Some(s.t_s),
            theta_inner_end_rad: Some(s.theta_inner_rad),
            theta_outer_end_rad: Some(s.theta_outer_rad),
            offset_rad: Some(s.offset_rad),
            slip: Slips { inner: Slip::of(&s.inner), outer: Slip::of(&s.outer) },
            contact_lost_s: Some(s.contact_lost_s),
            peak_tan_demand: Some(s.peaks.tan_inner.max(s.peaks.tan_outer)),
            required_static_friction: known.and_then(|d| d.required_friction),
            required_static_friction_by: known
                .filter(|d| d.finished)
                .map(|d| if d.by_bisection { "bisection" } else { "rolling" }),
            slip_margin: known.map(|d| d.slip_margin),
            contact_margin: known.filter(|d| d.finished || d.contact_margin < 0.0).map(|d| d.contact_margin),
            normal_min_n: Some(s.peaks.normal_min_n),
            normal_max_n: Some(s.peaks.normal_max_n),
            extremes: s.equilibrium_error.is_none().then(|| Extremes::of(s)),
            equilibrium: Equilibrium::of(scene, prepared, s),
            hertz_peak_mpa: Some(s.hertz_peak_pa / 1e6),
            hertz_static_mpa: Some(s.hertz_static_pa / 1e6),
            hertz_least_mpa: Some(s.hertz_least_pa / 1e6),
            hertz_rated_mpa: super::facts::rated(scene).map(|p| p.hertz_inner_pa / 1e6),
            events: Some(s.events),
            zeno_closures: Some(s.zeno_closures),
            inconsistent_choices: Some(s.inconsistent_choices),
            fast_motion: s.fast_motion.map(|f| Fast {
                rate_rad_s: f.rate_rad_s,
                amplitude_rad: f.amplitude_rad,
                of: f.of,
            }),
            steps: Some(s.steps),
            rejections: Some(s.rejections),
            rhs_evaluations: Some(s.rhs_evaluations),
            error_estimates: s
                .error
                .as_ref()
                .filter(|_| s.stop != Stop::Interrupted)
                .map(|e| Errors::of(scene, prepared, s, e)),
            energy_balance: s.energy.as_ref().map(Energy::of),
            assumptions: match scene.scenario.kind {
                ScenarioKind::Engagement { .. } => {
                    vec!["free_run_rpm", "reversing_torque_nm", "stop_stiffness_nm_per_rad"]
                }
                _ => Vec::new(),
            },
            tolerance_reached: (scene.method != "published" && s.stop != Stop::Interrupted)
                .then_some(s.tolerance_reached),
            worst_figure: s.error.filter(|_| !s.tolerance_reached).map(|_| super::notes::worst(s)),
            finer_gave_up: s.finer_gave_up.map(Stop::name),
            spread_rad: s.error.filter(|_| !s.tolerance_reached).map(|_| s.spread_rad),
            initial_slip_s: s.initial_slip_s(),
            drag_torque_nm: s.overrun.filter(|_| overruns).map(|o| o.drag_torque_nm),
            growth_rate_per_s: swing.map(|w| w.growth_rate_per_s),
            swing_frequency_hz: swing.map(|w| w.frequency_hz),
            swing_normal_inner_n: swing.map(|w| w.normal_inner_n),
            lift_off_rpm: super::facts::lift_off_rad_s(scene).map(|w| w * 30.0 / std::f64::consts::PI),
            ..base
        }
    }
}
