//! What contact damping changes: the same scene with and without it.

use super::{Ran, SimulationSettings};
use crate::clutch::Scenario;
use crate::report::Unit;
use crate::scenario::{Settings, Terms, Verdict, prepare, simulate_prepared};

/// Damping that is tried where a design has none, s/m: the middle of the 0.08 to 0.32 that Hunt and Crossley (1975)
/// give for steel.
const TRIED_S_PER_M: f64 = 0.2;

/// What the other damping does.
#[derive(Debug, Clone, PartialEq)]
pub struct Effect {
    /// Damping of the other run, s/m.
    pub other_s_per_m: f64,
    /// By how much the inner race ends elsewhere, rad.
    pub moved_rad: f64,
    /// Error of that difference, rad.
    pub error_rad: f64,
    /// Verdict of the other run.
    pub verdict: &'static str,
    /// Whether it is that of the scene.
    pub same: bool,
    /// Whether the scene has none, and its contacts only roll: damping then takes from the swing and nothing else.
    pub rolls: bool,
}

impl Ran {
    /// Run the scene once more with the damping taken out, or, where it has none, with some. `None` where a run came to no
    /// answer.
    pub fn damping_effect(&self, settings: &SimulationSettings) -> Option<Effect> {
        let own = self.simulation().filter(|_| self.method == "event")?;
        let own_error = own.error?;
        let given = self.scenario.clutch.hunt_crossley_s_per_m;
        let mut other = Scenario::clone(&self.scenario);
        other.clutch.hunt_crossley_s_per_m = if given == 0.0 { TRIED_S_PER_M } else { 0.0 };
        let run = Settings { samples: 0, ..settings.of_run(&self.scenario) };
        let s = simulate_prepared(&prepare(&other).ok()?, &run, Terms::Felt);
        let error_rad = own_error.theta_inner_rad + s.error?.theta_inner_rad;
        Some(Effect {
            other_s_per_m: other.clutch.hunt_crossley_s_per_m,
            moved_rad: s.theta_inner_rad - own.theta_inner_rad,
            error_rad,
            verdict: s.verdict.map_or("no verdict", Verdict::name),
            same: s.verdict == own.verdict,
            rolls: given == 0.0 && own.contact_lost_s == 0.0 && own.verdict == Some(Verdict::Sticks),
        })
    }
}

impl Effect {
    /// The other run, and what it changes.
    pub fn words(&self) -> String {
        let other = match self.other_s_per_m {
            0.0 => "without contact damping".to_owned(),
            c => format!("with contact damping of {c} s/m (steel: 0.08 to 0.32)"),
        };
        let moved = Unit::Radian.show(self.moved_rad.abs(), 2);
        let verdict =
            if self.same { "the same verdict".to_owned() } else { format!("verdict {}", self.verdict) };
        format!("{other} the inner race ends {moved} elsewhere, {verdict}")
    }

    /// A warning where the result depends on it by more than its error, and by more than how fast a swing dies away.
    pub fn note(&self) -> Option<String> {
        let depends = !self.same || !self.rolls && self.moved_rad.abs() > self.error_rad;
        depends.then(|| format!("the result depends on contact damping: {}", self.words()))
    }
}
