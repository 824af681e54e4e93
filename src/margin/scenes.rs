//! Limits that follow from the scenarios: slip margin and contact margin.

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
    let need = d.demand.as_ref().ok().and_then(|d| d.required_friction);
    let slip = Margin {
        code: format!("slip:{name}"),
        name: format!("friction that {name} needs to stick, against mu_s/(1 + {wanted})"),
        // No friction suffices: the demand is beyond any coefficient.
        demand: need.unwrap_or(f64::MAX),
        allowable: allowed,
        unit: "1",
        margin: need.map_or(-1.0, |n| allowed / n - 1.0),
        torque_capacity_nm: None,
        required,
    };
    let contact = Margin {
        code: format!("contact:{name}"),
        name: format!("smallest normal force in {name} over the static one"),
        demand: 0.0,
        allowable: d.contact_margin(),
        unit: "1",
        margin: d.contact_margin(),
        torque_capacity_nm: None,
        required,
    };
    vec![slip, contact]
}
