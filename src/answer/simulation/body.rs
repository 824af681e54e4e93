//! The figures of a simulation by their keys in JSON.

use super::train::{Eigenfrequency, of_drivetrain};
use super::{Ran, SimulationErrors};
use crate::answer::left_out::LeftOut;
use crate::answer::roll_over::BeyondBody;
use crate::design::rpm;
use crate::dynamics::{EnergyBalance, SlipWork, Stop};
use crate::report::Unit;
use crate::scenario::{Prepared, Simulation, overrun_swing};
use serde::Serialize;

/// Slip at one contact.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Slip {
    /// Time of slip, s.
    pub time_s: Option<f64>,
    /// Path of slip, mm.
    pub distance_mm: Option<f64>,
    /// Net slip, mm; positive towards overrunning.
    pub net_mm: Option<f64>,
    /// Work, heat and wear of all of it; null where nothing slips, and by the published scheme.
    pub heat: Option<SlipHeat>,
    /// The slip with the most work.
    pub worst: Option<WorstSlip>,
}

/// Work, heat and wear of slip at one contact of one sprag.
#[derive(Debug, Clone, Serialize)]
pub struct SlipHeat {
    /// Work of friction, J.
    pub work_j: f64,
    /// Largest power of friction, W.
    pub power_w: f64,
    /// Largest heat of both bodies over the Hertz flat, W/mm2.
    pub flux_w_per_mm2: f64,
    /// Largest rise of the hottest place above the bodies, K.
    pub flash_k: f64,
    /// Peclet number then; below some 5 heat goes sideways too, and the rise is less.
    pub peclet: f64,
    /// Depth worn off the sprag if asperities carry all, um; null without `[lubrication]`.
    pub sprag_wear_um: Option<f64>,
    /// Depth worn off the place of the race that most slips over, um; at most, null as above.
    pub race_wear_um: Option<f64>,
}

/// The slip with the most work at one contact; a stick of less time than its heat takes to go sideways does not end it.
#[derive(Debug, Clone, Serialize)]
pub struct WorstSlip {
    /// When it begins, s.
    pub from_s: f64,
    /// Its time in slip, s.
    pub time_s: f64,
    /// Its path, mm.
    pub path_mm: f64,
    /// Its work, heat and wear.
    pub heat: SlipHeat,
}

/// Slip at both contacts.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Slips {
    /// At the inner contact.
    pub inner: Slip,
    /// At the outer contact.
    pub outer: Slip,
}

/// Where the energy went, J: works (positive: brought in), changes, what the balance leaves over.
#[derive(Debug, Clone, Serialize)]
pub struct Energy {
    /// Work of friction at A of all sprags, J.
    pub friction_inner_j: f64,
    /// The same at B, J.
    pub friction_outer_j: f64,
    /// Work of the damping between the races, J.
    pub race_damping_j: f64,
    /// Work of contact damping, J.
    pub contact_damping_j: f64,
    /// Work of the torque on the inner race, J.
    pub torque_inner_j: f64,
    /// The same on the outer race, J.
    pub torque_outer_j: f64,
    /// Work of what turns at the mean speed, J.
    pub frame_j: f64,
    /// Change of kinetic energy, J.
    pub kinetic_change_j: f64,
    /// Change of what contacts, races, springs hold, J.
    pub stored_change_j: f64,
    /// Energy that went through, J.
    pub through_j: f64,
    /// What the balance leaves over, J.
    pub residual_j: f64,
    /// Residual by the energy that went through.
    pub relative: f64,
}

/// The fastest motion.
#[derive(Debug, Clone, Serialize)]
pub struct Fast {
    /// Its rate, rad/s.
    pub rate_rad_s: f64,
    /// Its amplitude, rad.
    pub amplitude_rad: f64,
    /// What moves.
    pub of: &'static str,
}

/// A figure that is the largest or smallest of a run.
#[derive(Debug, Clone, Serialize)]
pub struct Extreme {
    /// The figure, SI.
    pub value: f64,
    /// When it was reached first.
    pub at_s: f64,
    /// By how much that moved between the last runs: of extremes that are equal within their error any may be named.
    pub at_moved_s: Option<f64>,
}

/// The extremes of a run.
#[derive(Debug, Clone, Serialize)]
pub struct Extremes {
    /// Largest |T|/N at A.
    pub tan_inner: Extreme,
    /// Largest |T|/N at B.
    pub tan_outer: Extreme,
    /// Smallest N_bi.
    pub normal_min_n: Extreme,
    /// Largest N_bi.
    pub normal_max_n: Extreme,
    /// Largest N_be.
    pub normal_outer_max_n: Extreme,
}

/// The state of a static scenario or of a steady overrun.
#[derive(Debug, Clone, Serialize)]
pub struct Equilibrium {
    /// Rotation of the sprag, rad.
    pub alpha_rad: f64,
    /// Torque, or drag, of the clutch, N m.
    pub torque_nm: f64,
    /// N_bi, N.
    pub normal_inner_n: f64,
    /// N_be, N.
    pub normal_outer_n: f64,
    /// |T|/N at A.
    pub tan_inner: f64,
    /// |T|/N at B.
    pub tan_outer: f64,
    /// Null in overrun, as are the stiffnesses.
    pub windup_rad: Option<f64>,
    /// Secant stiffness, N m/rad.
    pub k_secant_nm_per_rad: Option<f64>,
    /// Tangent stiffness, N m/rad.
    pub k_tangent_nm_per_rad: Option<f64>,
    /// Error of each figure, also of margins and pressure, by its own size.
    pub relative_error: f64,
    /// That of the pressure: with its shape where a junction lies under the inner contact.
    pub hertz_relative_error: f64,
}

/// Keys of `simulate`; null where a figure does not exist for the scenario.
#[derive(Debug, Clone, Default, Serialize)]
pub struct SimulationBody {
    /// Name of the scenario.
    pub scenario: String,
    /// Kind of the scenario.
    pub kind: &'static str,
    /// `event`, `published`, or `equilibrium` where nothing is integrated.
    pub method: &'static str,
    /// `sticks`, `slips-overrunning`, `slips-engaging`, `disengages`, `overloaded`, `at-threshold`.
    pub verdict: Option<&'static str>,
    /// Why the run ended; `no-start` where the clutch has no such start.
    pub stop: &'static str,
    /// Why the scenario has no start, or why a run did not come to its end and what would let it.
    pub reason: Option<String>,
    /// Time reached, s.
    pub t_end_s: Option<f64>,
    /// Rotation of the inner race at the end, rad.
    pub theta_inner_end_rad: Option<f64>,
    /// Rotation of the outer race at the end, rad.
    pub theta_outer_end_rad: Option<f64>,
    /// Offset that slip leaves between the races, rad; positive towards overrunning.
    pub offset_rad: Option<f64>,
    /// Slip at both contacts.
    pub slip: Slips,
    /// Time without contact, s.
    pub contact_lost_s: Option<f64>,
    /// Largest tangential over normal force, either contact.
    pub peak_tan_demand: Option<f64>,
    /// Static friction from which on the scene sticks.
    pub required_static_friction: Option<f64>,
    /// How that was found. `rolling`: the largest tangential over normal force in pure rolling; `bisection`: by runs with
    /// slip, where rolling unloads the contact.
    pub required_static_friction_by: Option<&'static str>,
    /// Static over required friction, less 1.
    pub slip_margin: Option<f64>,
    /// Smallest normal force at the inner contact in pure rolling over that of the static load; negative by the pull that
    /// rolling would need.
    pub contact_margin: Option<f64>,
    /// Smallest normal force of one sprag at the inner contact, N.
    pub normal_min_n: Option<f64>,
    /// Largest normal force of one sprag at the inner contact, N.
    pub normal_max_n: Option<f64>,
    /// Extremes of the run, with their times.
    pub extremes: Option<Extremes>,
    /// The state of a static scenario or of a steady overrun, where nothing is integrated.
    pub equilibrium: Option<Equilibrium>,
    /// Largest Hertz pressure, MPa.
    pub hertz_peak_mpa: Option<f64>,
    /// Hertz pressure of the static load, MPa.
    pub hertz_static_mpa: Option<f64>,
    /// Hertz pressure at the inner contact at the smallest normal force, MPa.
    pub hertz_least_mpa: Option<f64>,
    /// Hertz pressure at the inner contact at nominal torque, MPa.
    pub hertz_rated_mpa: Option<f64>,
    /// Changes of mode: sticking, slipping, open.
    pub events: Option<u64>,
    /// Sequences of ever faster changes of mode that were closed at their limit.
    pub zeno_closures: Option<u64>,
    /// Changes of mode at which no mode was consistent with the forces.
    pub inconsistent_choices: Option<u64>,
    /// What was fastest where the run gave up.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fast_motion: Option<Fast>,
    /// Steps of the integrator, of all runs.
    pub steps: Option<u64>,
    /// Steps refused and tried again, of all runs.
    pub rejections: Option<u64>,
    /// Evaluations of the equations of motion, of all runs.
    pub rhs_evaluations: Option<u64>,
    /// Errors of the figures by name.
    pub error_estimates: Option<SimulationErrors>,
    /// Where the energy went, J.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub energy_balance: Option<Energy>,
    /// Eigenfrequencies of races and drivetrain with the clutch engaged, lowest first; none without a drivetrain.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub eigenfrequencies: Vec<Eigenfrequency>,
    /// Inputs of an engagement that the paper does not publish for its Figure 8.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub assumptions: Vec<&'static str>,
    /// Whether every error is below the tolerance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance_reached: Option<bool>,
    /// The figure whose error is largest by its natural size, where the tolerance is not reached, and that.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub worst_figure: Option<(&'static str, f64)>,
    /// Why a run with finer steps than those that answer did not come to its end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub finer_gave_up: Option<&'static str>,
    /// Smallest and largest rotation of the inner race at the end over the runs made, rad, where the tolerance is not
    /// reached.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spread_rad: Option<[f64; 2]>,
    /// How long the inner contact slips after a reversal, s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub initial_slip_s: Option<f64>,
    /// Drag torque of a steady overrun, N m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drag_torque_nm: Option<f64>,
    /// Speed of the outer race at which the sprags lift off, rev/min; absent where they stay on up to 60 000.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lift_off_rpm: Option<f64>,
    /// Growth of a small swing of the sprags about a steady overrun, races at constant speeds, 1/s; positive: the overrun does
    /// not stay. Absent where they are off.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub growth_rate_per_s: Option<f64>,
    /// Frequency of that swing, Hz.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub swing_frequency_hz: Option<f64>,
    /// Normal force at the inner contact about which they swing, by the equations of motion, N.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub swing_normal_inner_n: Option<f64>,
    /// What comes after the end of the curve, where the scene goes there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beyond: Option<BeyondBody>,
    /// Terms that the planner looked at and kept.
    pub kept: Vec<LeftOut>,
    /// What a reader must know beside the figures.
    pub notes: Vec<String>,
}

impl Slip {
    fn of(s: &Simulation, contact: usize) -> Self {
        let record = [&s.inner, &s.outer][contact];
        let heat = |work: &SlipWork| SlipHeat::of(work, s.wear_m2_per_n);
        Self {
            time_s: Some(record.time_s),
            distance_mm: Some(record.distance_m * 1e3),
            net_mm: Some(record.net_m * 1e3),
            heat: s.slipped(contact).as_ref().map(heat),
            worst: s.slip_heat[contact].map(|h| WorstSlip {
                from_s: h.worst.from_s,
                time_s: h.worst.time_s,
                path_mm: h.worst.path_m * 1e3,
                heat: heat(&h.worst),
            }),
        }
    }
}

impl SlipHeat {
    fn of(work: &SlipWork, wear_m2_per_n: Option<[f64; 2]>) -> Self {
        let wear_um = wear_m2_per_n.map(|k| work.wear_m(k).map(|m| Unit::Micrometre.from_si(m)));
        Self {
            work_j: work.work_j,
            power_w: work.power_w,
            flux_w_per_mm2: Unit::WattPerSquareMillimetre.from_si(work.flux_w_m2),
            flash_k: work.flash_k,
            peclet: work.peclet,
            sprag_wear_um: wear_um.map(|um| um[0]),
            race_wear_um: wear_um.map(|um| um[1]),
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
    fn of(scene: &Ran, prepared: &Prepared, s: &Simulation) -> Option<Self> {
        let relative_error = s.equilibrium_error?;
        let alpha_rad = prepared.state[0];
        let hertz_relative_error = relative_error + scene.shape_error(prepared, s.peaks.normal_max_n);
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

impl SimulationBody {
    pub(super) fn of(scene: &Ran, notes: Vec<String>) -> Self {
        let base = Self {
            scenario: scene.scenario.name.clone(),
            beyond: scene.beyond.as_ref().map(BeyondBody::of),
            kind: scene.scenario.kind.name(),
            method: scene.method,
            verdict: scene.verdict(),
            kept: scene.kept.iter().map(|t| LeftOut::new(t.term, &t.why, &t.cost)).collect(),
            notes,
            ..Self::default()
        };
        let (prepared, s) = match &scene.outcome {
            Err(why) => return Self { stop: "no-start", reason: Some(why.to_string()), ..base },
            Ok((prepared, s)) => (prepared, s),
        };
        let overruns = scene.scenario.kind.is_overrun();
        let swing = overrun_swing(&scene.scenario, prepared);
        let known = s.demand.filter(|d| d.gave_up.is_none());
        Self {
            stop: s.stop.name(),
            reason: scene.given_up(),
            t_end_s: Some(s.t_s),
            theta_inner_end_rad: Some(s.theta_inner_rad),
            theta_outer_end_rad: Some(s.theta_outer_rad),
            offset_rad: Some(s.offset_rad),
            slip: Slips { inner: Slip::of(s, 0), outer: Slip::of(s, 1) },
            contact_lost_s: Some(s.contact_lost_s),
            peak_tan_demand: Some(s.peaks.tan_inner.max(s.peaks.tan_outer)),
            required_static_friction: known.and_then(|d| d.required_friction),
            required_static_friction_by: known
                .filter(|d| d.finished)
                .map(|d| if d.by_bisection { "bisection" } else { "rolling" }),
            slip_margin: known.and_then(|d| d.slip_margin),
            contact_margin: known.filter(|d| d.finished || d.contact_margin < 0.0).map(|d| d.contact_margin),
            normal_min_n: Some(s.peaks.normal_min_n),
            normal_max_n: Some(s.peaks.normal_max_n),
            extremes: s.equilibrium_error.is_none().then(|| Extremes::of(s)),
            equilibrium: Equilibrium::of(scene, prepared, s),
            hertz_peak_mpa: Some(s.hertz_peak_pa / 1e6),
            hertz_static_mpa: Some(s.hertz_static_pa / 1e6),
            hertz_least_mpa: Some(s.hertz_least_pa / 1e6),
            hertz_rated_mpa: scene.rated().map(|p| p.hertz_inner_pa / 1e6),
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
                .map(|e| SimulationErrors::of(scene, prepared, s, e)),
            energy_balance: s.energy.as_ref().map(Energy::of),
            eigenfrequencies: of_drivetrain(prepared),
            assumptions: scene.scenario.assumptions().to_vec(),
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
            lift_off_rpm: scene.lift_off_rad_s().map(rpm),
            ..base
        }
    }
}
