//! The JSON object of `simulate`.

use super::Scene;
use crate::cli::left_out::LeftOut;
use crate::design::ScenarioKind;
use crate::dynamics::{EnergyBalance, SlipRecord, Stop};
use crate::scenario::ErrorEstimate;
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
    peak_tan_demand: f64,
    normal_min_n: f64,
    normal_max_n: f64,
    hertz_peak_mpa: f64,
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

/// Keys of `simulate`; null where a figure does not exist for the scenario.
#[derive(Debug, Default, Serialize)]
pub(super) struct Body {
    scenario: String,
    kind: &'static str,
    method: &'static str,
    verdict: Option<&'static str>,
    stop: &'static str,
    /// Why the scenario has no start.
    reason: Option<String>,
    t_end_s: Option<f64>,
    theta_inner_end_rad: Option<f64>,
    theta_outer_end_rad: Option<f64>,
    offset_rad: Option<f64>,
    slip: Slips,
    contact_lost_s: Option<f64>,
    peak_tan_demand: Option<f64>,
    required_static_friction: Option<f64>,
    slip_margin: Option<f64>,
    contact_margin: Option<f64>,
    normal_min_n: Option<f64>,
    normal_max_n: Option<f64>,
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
    rhs_evaluations: Option<u64>,
    error_estimates: Option<Errors>,
    #[serde(skip_serializing_if = "Option::is_none")]
    energy_balance: Option<Energy>,
    /// Inputs of an engagement that the paper does not publish for its Figure 8.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    assumptions: Vec<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tolerance_reached: Option<bool>,
    /// Smallest and largest theta_inner_end over the runs made, where the tolerance is not reached.
    #[serde(skip_serializing_if = "Option::is_none")]
    spread_rad: Option<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    initial_slip_s: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    drag_torque_nm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    lift_off_rpm: Option<f64>,
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
    fn of(e: &ErrorEstimate) -> Self {
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
            normal_min_n: e.normal_min_n,
            normal_max_n: e.normal_max_n,
            hertz_peak_mpa: e.hertz_peak_pa / 1e6,
            required_static_friction: e.required_friction,
            slip_margin: e.slip_margin,
            contact_margin: e.contact_margin,
        }
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
        let s = match &scene.outcome {
            Err(why) => return Self { stop: "no-start", reason: Some(why.to_string()), ..base },
            Ok((_, s)) => s,
        };
        let overruns = matches!(scene.scenario.kind, ScenarioKind::Overrun { .. });
        let known = s.demand.filter(|d| d.gave_up.is_none());
        Self {
            stop: s.stop.name(),
            t_end_s: Some(s.t_s),
            theta_inner_end_rad: Some(s.theta_inner_rad),
            theta_outer_end_rad: Some(s.theta_outer_rad),
            offset_rad: Some(s.offset_rad),
            slip: Slips { inner: Slip::of(&s.inner), outer: Slip::of(&s.outer) },
            contact_lost_s: Some(s.contact_lost_s),
            peak_tan_demand: Some(s.peaks.tan_inner.max(s.peaks.tan_outer)),
            required_static_friction: known.and_then(|d| d.required_friction),
            slip_margin: known.map(|d| d.slip_margin),
            contact_margin: known.map(|d| d.contact_margin),
            normal_min_n: Some(s.peaks.normal_min_n),
            normal_max_n: Some(s.peaks.normal_max_n),
            hertz_peak_mpa: Some(s.hertz_peak_pa / 1e6),
            hertz_static_mpa: Some(s.hertz_static_pa / 1e6),
            hertz_least_mpa: Some(s.hertz_least_pa / 1e6),
            hertz_rated_mpa: super::facts::rated_pa(scene).map(|p| p / 1e6),
            events: Some(s.events),
            zeno_closures: Some(s.zeno_closures),
            inconsistent_choices: Some(s.inconsistent_choices),
            fast_motion: s.fast_motion.map(|f| Fast {
                rate_rad_s: f.rate_rad_s,
                amplitude_rad: f.amplitude_rad,
                of: f.of,
            }),
            steps: Some(s.steps),
            rhs_evaluations: Some(s.rhs_evaluations),
            error_estimates: s.error.as_ref().filter(|_| s.stop != Stop::Interrupted).map(Errors::of),
            energy_balance: s.energy.as_ref().map(Energy::of),
            assumptions: match scene.scenario.kind {
                ScenarioKind::Engagement { .. } => {
                    vec!["free_run_rpm", "reversing_torque_nm", "stop_stiffness_nm_per_rad"]
                }
                _ => Vec::new(),
            },
            tolerance_reached: s.error.filter(|_| scene.method == "event").map(|_| s.tolerance_reached),
            spread_rad: s.error.filter(|_| !s.tolerance_reached).map(|_| s.spread_rad),
            initial_slip_s: s.initial_slip_s(),
            drag_torque_nm: s.overrun.filter(|_| overruns).map(|o| o.drag_torque_nm),
            lift_off_rpm: super::facts::lift_off_rad_s(scene).map(|w| w * 30.0 / std::f64::consts::PI),
            ..base
        }
    }
}
