//! What the model says where something was observed.

use super::observation::{Observation, ObservedQuantity};
use crate::design::{Design, rpm};
use crate::file::{EditError, with_keys};
use crate::margin::{LIFT_OFF_TO_RAD_S, LoadState, lift_off_rad_s, load_state, nominal_capacity};
use crate::wedge::StaticPoint;

/// A predicted number and what decided it.
#[derive(Debug, Clone, PartialEq)]
pub struct Prediction {
    /// In the unit of the observation's column.
    pub value: f64,
    /// Code of the limit that decides a capacity.
    pub decided_by: Option<String>,
}

/// Why there is no prediction.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoPrediction {
    /// A key or a value cannot be put into the design.
    #[error("{0}")]
    Edit(EditError),
    /// The design with these values is refused.
    #[error("the design is refused: {0}")]
    Refused(String),
    /// No load state.
    #[error("{0}")]
    NoState(String),
    /// The curve ends below the torque of the observation.
    #[error("the curve ends at {end_nm:.4} N m, below that torque")]
    BeyondTheCurve {
        /// Where it ends, N m.
        end_nm: f64,
    },
    /// Nothing lifts off below 60 000 rev/min.
    #[error("no lift-off up to 60 000 rpm")]
    NoLiftOff,
    /// No limit of the design depends on the nominal torque.
    #[error("the design has no limit at nominal torque")]
    NoLimit,
}

/// The design with the keys of a row and further values put in (dotted paths, units of the keys; the later wins).
///
/// # Errors
/// [`NoPrediction::Edit`], [`NoPrediction::Refused`].
pub(super) fn design_with(
    base: &Design,
    keys: &[(String, f64)],
    values: &[(String, f64)],
) -> Result<Design, NoPrediction> {
    let all: Vec<(&str, f64)> = keys.iter().chain(values).map(|(k, v)| (k.as_str(), *v)).collect();
    let text = with_keys(&base.source, &all).map_err(NoPrediction::Edit)?;
    Design::parse_in(&base.folder, &text, &base.name).map_err(|e| {
        let first = e.problems().first().map_or_else(String::new, ToString::to_string);
        NoPrediction::Refused(first)
    })
}

/// What `design` with the values `values` (dotted path, value in the key's unit) says for `observations`, which share
/// their keys.
///
/// # Errors
/// [`NoPrediction`] of the design as a whole; that of single numbers stands in their place.
pub fn predict(
    design: &Design,
    values: &[(String, f64)],
    observations: &[&Observation],
) -> Result<Vec<Result<Prediction, NoPrediction>>, NoPrediction> {
    let Some(first) = observations.first() else { return Ok(Vec::new()) };
    let changed = design_with(design, &first.keys, values)?;
    let state = load_state(&changed).map_err(|e| NoPrediction::NoState(e.to_string()))?;
    Ok(observations.iter().map(|o| one(&changed, &state, o)).collect())
}

fn one(design: &Design, state: &LoadState, o: &Observation) -> Result<Prediction, NoPrediction> {
    let plain = |value: f64| Ok(Prediction { value, decided_by: None });
    let at = |read: fn(&StaticPoint) -> f64| {
        let point = o.torque_nm.and_then(|t| state.curve.at_torque(t));
        point.map_or(Err(NoPrediction::BeyondTheCurve { end_nm: state.curve.end_torque_nm() }), |p| {
            plain(read(&p))
        })
    };
    match o.kind {
        ObservedQuantity::Windup => at(|p| p.windup_rad.to_degrees()),
        ObservedQuantity::NormalInner => at(|p| p.normal_inner_n),
        ObservedQuantity::NormalOuter => at(|p| p.normal_outer_n),
        ObservedQuantity::TanOmega => at(|p| p.tan_omega),
        ObservedQuantity::HertzInner => at(|p| p.hertz_inner_pa / 1e6),
        ObservedQuantity::HertzOuter => at(|p| p.hertz_outer_pa / 1e6),
        ObservedQuantity::Secant => at(|p| p.k_secant_nm_per_rad),
        ObservedQuantity::Tangent => at(|p| p.k_tangent_nm_per_rad),
        ObservedQuantity::EndTorque => plain(state.curve.end_torque_nm()),
        ObservedQuantity::LiftOff => lift_off_rad_s(design, state, LIFT_OFF_TO_RAD_S)
            .map_or(Err(NoPrediction::NoLiftOff), |speed| plain(rpm(speed))),
        ObservedQuantity::NominalTorque => nominal_capacity(design, &design.limits, state)
            .map(|(value, code)| Prediction { value, decided_by: Some(code.to_owned()) })
            .ok_or(NoPrediction::NoLimit),
    }
}
