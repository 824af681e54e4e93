//! What an objective measures of a clutch, more being better.

use std::f64::consts::PI;

use crate::design::{Design, Limits, Objective};
use crate::margin::{
    LIFT_OFF_TO_RAD_S, LoadState, Margin, When, largest_pressures_pa, lift_off_rad_s, overrun_at,
};

const RPM_PER_RAD_S: f64 = 30.0 / PI;

/// One objective, with the shift and the scale at which it joins the least margin: (measure - from)/span.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Goal {
    /// The objective.
    pub objective: Objective,
    /// Measure that counts as 0, in the measure's unit.
    pub from: f64,
    /// Measure's range that counts as 1, above 0.
    pub span: f64,
}

impl Goal {
    /// The objective alone, at a span that makes it of order one.
    pub fn plain(objective: Objective, limits: &Limits) -> Self {
        let span = match objective {
            Objective::TorqueCapacity => limits.peak_torque_nm.unwrap_or(1.0),
            other => other.span(),
        };
        Self { objective, from: 0.0, span }
    }

    /// The measure as it joins the least margin.
    pub fn scaled(&self, measure: f64) -> f64 {
        (measure - self.from) / self.span
    }
}

/// One number that a goal raises, in the unit of [`Objective::unit`] times [`Objective::sense`].
#[derive(Debug, Clone, PartialEq)]
pub struct Measure {
    /// Goal it belongs to.
    pub goal: usize,
    /// What it is, such as `slip:high-6`, `capacity:hoop-inner`, `pressure:inner`.
    pub code: String,
    /// Its value; the least of a goal's measures is the goal.
    pub value: f64,
}

/// Code of the measure that is the torque capacity of a row.
pub(super) fn capacity_of(row: &Margin) -> String {
    format!("capacity:{}", row.code())
}

/// Pressure of a contact whose slices find none, MPa.
const NOT_KNOWN_MPA: f64 = 1e5;

/// Measures of `objective`; their count depends on the question alone, not on the clutch.
pub(super) fn measures(
    objective: Objective,
    design: &Design,
    limits: &Limits,
    target: &[[f64; 2]],
    state: &LoadState,
    rows: &[Margin],
) -> Vec<Measure> {
    let measure = |code: String, value: f64| Measure { goal: 0, code, value };
    let races = &design.clutch.races;
    // kg and m into the objective's g and mm.
    let less = |si: f64| vec![measure(objective.name().to_owned(), -1e3 * si)];
    match objective {
        Objective::ContactMargin => {
            rows.iter().filter(|m| m.is_contact()).map(|m| measure(m.code(), m.margin())).collect()
        }
        Objective::KeepContact | Objective::LiftOff => {
            let speed = lift_off_rad_s(design, state, LIFT_OFF_TO_RAD_S).unwrap_or(LIFT_OFF_TO_RAD_S);
            vec![measure("lift-off".to_owned(), objective.sense() * speed * RPM_PER_RAD_S)]
        }
        Objective::Drag => {
            let fast = limits.keep_contact_to_rad_s.filter(|&speed| speed > 0.0);
            let speeds = [("slow", 0.0)].into_iter().chain(fast.map(|speed| ("at-speed", speed)));
            let drag = |speed| {
                let [ahead, outer] = design.clutch.overrun_of_carrier(speed);
                overrun_at(design, state, outer, ahead).map_or(0.0, |p| p.state.drag_torque_nm)
            };
            speeds.map(|(when, speed)| measure(format!("drag:{when}"), -drag(speed))).collect()
        }
        Objective::Mass => less(design.clutch.mass_kg()),
        Objective::Width => less(races.width_m),
        Objective::OutsideDiameter => less(2.0 * races.outer_outside_radius_m),
        Objective::SlipMargin => {
            rows.iter().filter_map(|m| Some(measure(m.code(), m.slip_measure()?))).collect()
        }
        // Peak and nominal torque grow in proportion.
        Objective::TorqueCapacity => {
            let peak = limits.peak_torque_nm.unwrap_or(1.0);
            let nominal = limits.nominal_torque_nm.unwrap_or(peak);
            rows.iter()
                .filter_map(|m| {
                    let at = if m.limit.when == When::Nominal { nominal } else { peak };
                    Some(measure(capacity_of(m), m.torque_capacity_nm? / at * peak))
                })
                .collect()
        }
        Objective::PeakPressure => {
            let torque = limits.peak_torque_nm.unwrap_or(1.0);
            let (_, beyond) = at(state, torque);
            let [inner, outer] = largest_pressures_pa(state, torque);
            // Pressure grows with the root of the load; beyond the curve's end that goes on.
            let even = [("inner", inner), ("outer", outer)]
                .map(|(place, p)| measure(format!("pressure:{place}"), -p * 1e-6 * beyond.sqrt()));
            // Where the file limits the pressure along the contacts, that is what is pressed; not known: worse than any that is.
            let along = rows.iter().filter(|m| m.limit.is_along());
            let along = along.map(|m| {
                let mpa = m.demand_in_unit().map_or(NOT_KNOWN_MPA, |mpa| mpa * beyond.sqrt());
                measure(format!("pressure:{}", m.code()), -mpa)
            });
            even.into_iter().chain(along).collect()
        }
        Objective::Windup => {
            let torque = limits.nominal_torque_nm.unwrap_or(1.0);
            let (windup_rad, beyond) = at(state, torque);
            vec![measure("windup".to_owned(), -windup_rad.to_degrees() * beyond)]
        }
        Objective::StiffnessCurve => target
            .iter()
            .flat_map(|&[torque, wanted]| {
                let (windup_rad, beyond) = at(state, torque);
                let off = windup_rad * beyond / wanted - 1.0;
                [measure(format!("softer:{torque}"), -off), measure(format!("stiffer:{torque}"), off)]
            })
            .collect(),
    }
}

/// Windup, rad, at `torque`, or at the curve's end; and by what the torque lies beyond.
fn at(state: &LoadState, torque: f64) -> (f64, f64) {
    let curve = &state.curve;
    let last = curve.arc_end_n(curve.arc_count() - 1);
    let end = curve.end_torque_nm();
    let windup_rad = curve.at_torque(torque).or_else(|| curve.at_normal(last)).map_or(0.0, |p| p.windup_rad);
    (windup_rad, if torque > end && end > 0.0 { torque / end } else { 1.0 })
}
