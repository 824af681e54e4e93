//! Limits that follow from the scenarios: slip margin, contact margin, Hertz pressure.

use super::Margin;
use crate::design::{Limits, Scenario};
use crate::scenario::{Demand, NoScenario, Prepared, Settings, demand, prepare};

/// Rolling demand of one scenario, with the Hertz pressure that comes with it.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneDemand {
    /// Demand, or why the scenario cannot start.
    pub demand: Result<Demand, NoScenario>,
    /// mu_s of the scenario.
    pub static_friction: f64,
    /// Largest p_0 of the rolling run, Pa: the tie-breaker of the optimiser.
    pub hertz_peak_pa: f64,
}

impl SceneDemand {
    /// The demand found for a scenario as it was prepared.
    pub fn of(scenario: &Scenario, prepared: &Prepared, found: Demand) -> Self {
        let peak = prepared.model.curve.at_normal(found.normal_max_n[0]);
        let static_friction = scenario.clutch.friction.static_;
        Self { demand: Ok(found), static_friction, hertz_peak_pa: peak.map_or(0.0, |r| r.hertz_inner_pa) }
    }

    /// Slip margin; -1 where there is none.
    pub fn slip_margin(&self) -> f64 {
        self.demand.as_ref().map_or(-1.0, |d| if d.finished { d.slip_margin } else { -1.0 })
    }
    /// Contact margin; -1 where the scenario does not start or run.
    pub fn contact_margin(&self) -> f64 {
        self.demand.as_ref().map_or(-1.0, |d| if d.finished { d.contact_margin } else { -1.0 })
    }
}

/// Evaluate one scenario's rolling demand.
pub fn scene_demand(scenario: &Scenario, settings: &Settings) -> SceneDemand {
    let static_friction = scenario.clutch.friction.static_;
    match prepare(scenario) {
        Ok(p) => SceneDemand::of(scenario, &p, demand(&p, settings)),
        Err(e) => SceneDemand { demand: Err(e), static_friction, hertz_peak_pa: 0.0 },
    }
}

pub(super) fn rows(name: &str, d: &SceneDemand, limits: &Limits, required: bool) -> Vec<Margin> {
    let wanted = limits.slip_margin.unwrap_or(0.0);
    let allowed = d.static_friction / (1.0 + wanted);
    let found = d.demand.as_ref().ok();
    let need = found.and_then(|d| d.required_friction);
    let gave_up = found.and_then(|d| d.gave_up);
    let overload = match &d.demand {
        Err(why @ NoScenario::NotCarried { .. }) => Some(why.to_string()),
        Ok(d) if d.overloaded => Some("rolling goes beyond the end of the curve".to_owned()),
        _ => None,
    };
    let row = |kind: &str, what: String, unit, demand: f64, allowable: f64, margin: f64| Margin {
        code: format!("{kind}:{name}"),
        name: match (gave_up, &overload) {
            (Some(stop), _) => format!("{what}: not computed, {}", stop.name()),
            (None, Some(why)) => format!("{what}: overloaded, {why}"),
            (None, None) => what,
        },
        demand,
        allowable,
        unit,
        margin: if gave_up.is_none() { margin } else { -1.0 },
        torque_capacity_nm: None,
        required,
        computed: gave_up.is_none(),
        overloaded: overload.is_some(),
    };
    let mut rows = vec![
        row(
            "slip",
            format!("friction that {name} needs to stick, against mu_s/(1 + {wanted})"),
            "1",
            // No friction suffices: the demand is beyond any coefficient.
            need.unwrap_or(f64::MAX),
            allowed,
            need.map_or(-1.0, |n| allowed / n - 1.0),
        ),
        row(
            "contact",
            format!("smallest normal force in {name} over the static one"),
            "1",
            0.0,
            d.contact_margin(),
            d.contact_margin(),
        ),
    ];
    if let Some(allowed) = limits.hertz_peak_pa {
        let margin = match found {
            Some(demand) if demand.finished => super::ratio(d.hertz_peak_pa, allowed),
            _ => -1.0,
        };
        let what = format!("largest Hertz pressure, inner contact, in {name} if it rolls throughout");
        rows.push(row("hertz", what, "MPa", d.hertz_peak_pa * 1e-6, allowed * 1e-6, margin));
    }
    rows
}
