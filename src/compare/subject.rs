//! One of the designs, with all that is compared.

use crate::design::Design;
use crate::margin::{
    Capacities, LoadState, Margin, NoMargins, SceneDemand, lift_off_rad_s, scene_demand, scene_rows,
    static_margins_until,
};
use crate::scenario::Settings;
use crate::wedge::StaticPoint;
use rayon::prelude::*;

/// A scene and what it demands.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Its name.
    pub name: String,
    /// Friction and contact that it needs.
    pub found: SceneDemand,
}

/// A design with its statics and its scenes.
#[derive(Debug, Clone)]
pub struct Subject {
    /// The design.
    pub design: Design,
    /// Statics.
    pub state: LoadState,
    /// All margins, in the order of `check`.
    pub margins: Vec<Margin>,
    /// Scenes in which something is to stick.
    pub scenes: Vec<Scene>,
    /// Overrun speed at which the sprags lift off, rad/s, if they do up to the speed looked to.
    pub lift_off_rad_s: Option<f64>,
}

impl Subject {
    /// Statics and scenes of a design; lift-off is looked for up to `up_to_rad_s`.
    ///
    /// # Errors
    /// [`NoMargins`].
    pub fn new(design: Design, up_to_rad_s: f64, settings: &Settings) -> Result<Self, NoMargins> {
        let (state, mut margins, _) = static_margins_until(&design, Capacities::Wanted, &settings.follow)?;
        let engaging: Vec<_> = design.scenarios.iter().filter(|s| !s.kind.is_overrun()).collect();
        let scenes: Vec<Scene> = engaging
            .par_iter()
            .map(|s| Scene {
                name: s.name.clone(),
                found: scene_demand(s, Some(state.at_rest(&design)), settings),
            })
            .collect();
        for (scenario, scene) in engaging.iter().zip(&scenes) {
            let required = design.check_scenarios.contains(&scenario.name);
            margins.extend(scene_rows(scenario, &scene.found, &design.limits, required));
        }
        let lift_off_rad_s = lift_off_rad_s(&design, &state, up_to_rad_s);
        Ok(Self { design, state, margins, scenes, lift_off_rad_s })
    }

    /// The required limit with the least margin.
    pub fn deciding(&self) -> Option<&Margin> {
        self.margins.iter().filter(|m| m.required).min_by(|a, b| a.margin().total_cmp(&b.margin()))
    }

    /// Whether every required limit is held.
    pub fn held(&self) -> bool {
        self.margins.iter().filter(|m| m.required).all(Margin::held)
    }

    /// Equilibrium at nominal torque, where the limits name it and the curve reaches it.
    pub fn nominal(&self) -> Option<StaticPoint> {
        self.design.limits.nominal_torque_nm.and_then(|t| self.state.curve.at_torque(t))
    }

    /// The same at peak torque.
    pub fn peak(&self) -> Option<StaticPoint> {
        self.design.limits.peak_torque_nm.and_then(|t| self.state.curve.at_torque(t))
    }
}
