//! Limits that follow from the scenarios: slip margin, contact margin, Hertz pressure.

use super::limits::{Limit, Of};
use super::row::{BeyondEnd, Demand, Margin};
use super::table::LIMITS;
use crate::clutch::Scenario;
use crate::design::Limits;
use crate::dynamics::Stop;
use crate::scenario::{self, AtRest, NoScenario, Prepared, Reduction, Settings, prepare_reduced};

/// What is said behind a slip row that no friction holds, and is not to hold.
const LETS_GO: &str = "its torque lets the clutch go, whatever the friction";

/// Rolling demand of one scenario, with the Hertz pressure that comes with it.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneDemand {
    /// Demand, or why the scenario cannot start.
    pub demand: Result<scenario::RollingDemand, NoScenario>,
    /// mu_s of the scenario.
    pub static_friction: f64,
    /// Largest p_0 of the rolling run, Pa: the tie-breaker of the optimiser.
    pub hertz_peak_pa: f64,
    /// Whether the scene's torque is to let the clutch go: that no friction holds it then is no fault of the friction.
    pub is_to_let_go: bool,
}

impl SceneDemand {
    /// The demand found for a scenario as it was prepared.
    pub fn of(scene: &Scenario, prepared: &Prepared, found: scenario::RollingDemand) -> Self {
        let peak = prepared.model.curve.at_normal(found.normal_max_n[0]);
        let static_friction = scene.clutch.friction.static_;
        let hertz_peak_pa = peak.map_or(0.0, |r| r.hertz_inner_pa);
        Self { demand: Ok(found), static_friction, hertz_peak_pa, is_to_let_go: is_to_let_go(scene) }
    }

    /// What rolling demands, where that ran to its end.
    fn whole(&self) -> Option<&scenario::RollingDemand> {
        self.demand.as_ref().ok().filter(|d| d.finished)
    }
    /// Slip margin; `None` where no friction suffices, or the scenario does not start or run.
    pub fn slip_margin(&self) -> Option<f64> {
        self.whole()?.slip_margin
    }
    /// Contact margin; `None` where the scenario does not start or run.
    pub fn contact_margin(&self) -> Option<f64> {
        Some(self.whole()?.contact_margin)
    }
}

fn is_to_let_go(scene: &Scenario) -> bool {
    scene.lets_go() == Some(true)
}

/// Evaluate one scenario's rolling demand; `known`: a curve that need not be built again.
pub fn scene_demand(scene: &Scenario, known: Option<AtRest>, settings: &Settings) -> SceneDemand {
    let static_friction = scene.clutch.friction.static_;
    match prepare_reduced(scene, &Reduction::default(), known) {
        Ok(p) => SceneDemand::of(scene, &p, scenario::demand(&p, settings)),
        Err(e) => {
            let is_to_let_go = is_to_let_go(scene);
            SceneDemand { demand: Err(e), static_friction, hertz_peak_pa: 0.0, is_to_let_go }
        }
    }
}

pub(super) fn rows(name: &str, d: &SceneDemand, limits: &Limits, required: bool) -> Vec<Margin> {
    let found = d.demand.as_ref().ok();
    let not_computed = found.and_then(|d| match d.never_engages {
        true => Some("the clutch does not engage within duration_s"),
        false => d.gave_up.map(Stop::name),
    });
    let overload = match &d.demand {
        Err(why @ NoScenario::NotCarried { .. }) => Some(why.to_string()),
        Ok(d) if d.overloaded => Some("rolling goes beyond the end of the curve".to_owned()),
        _ => None,
    };
    // What is demanded unless the run or the curve came to its end before.
    let demand = |known: Demand| match (not_computed, &overload) {
        (Some(why), _) => Demand::NotComputed(why),
        (None, Some(_)) => Demand::Overloaded { at_end: known.value(), beyond: BeyondEnd::Lost },
        (None, None) => known,
    };
    let row = |limit: &&'static Limit| {
        let wanted = limits.slip_margin.unwrap_or(0.0);
        let (known, allowable, reference) = match limit.of {
            Of::Slip => {
                let need = found.and_then(|d| d.required_friction);
                let none = if d.is_to_let_go { Demand::LetsGo } else { Demand::NoneSuffices };
                let known = need.map_or(none, Demand::Value);
                (known, d.static_friction / (1.0 + wanted), wanted)
            }
            Of::Contact => match d.contact_margin() {
                Some(left) => (Demand::Value(0.0), left, 0.0),
                None => (Demand::NoneSuffices, 0.0, 0.0),
            },
            Of::ScenePressure => {
                let to_the_end = found.is_some_and(|d| d.finished);
                let known = if to_the_end { Demand::Value } else { Demand::MoreThan };
                (known(d.hertz_peak_pa), limits.hertz_peak_pa?, 0.0)
            }
            _ => return None,
        };
        let aside = match (not_computed, &overload) {
            (Some(why), _) => Some(format!("not computed, {why}")),
            (None, Some(why)) => Some(format!("overloaded, {why}")),
            (None, None) => (known == Demand::LetsGo).then(|| LETS_GO.to_owned()),
        };
        let row = Margin { aside, reference, ..Margin::new(limit, demand(known), allowable) };
        Some(of_scene(row, name, required))
    };
    LIMITS.iter().filter_map(row).collect()
}

/// The same rows of a scene of which nothing is known.
pub(super) fn unknown_rows(name: &str, limits: &Limits) -> Vec<Margin> {
    let is_there = |limit: &&&Limit| match limit.of {
        Of::Slip | Of::Contact => true,
        Of::ScenePressure => limits.hertz_peak_pa.is_some(),
        _ => false,
    };
    let row = |limit: &&'static Limit| of_scene(Margin::new(limit, Demand::Unknown, 0.0), name, true);
    LIMITS.iter().filter(is_there).map(row).collect()
}

fn of_scene(row: Margin, scene: &str, required: bool) -> Margin {
    let name = row.name.replace("{scene}", scene);
    Margin { scene: Some(scene.to_owned()), name, required, ..row }
}
