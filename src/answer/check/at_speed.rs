//! What the rows without a scene leave out: they are at rest, and the clutch carries its torque while the races turn.

use crate::design::Design;
use crate::margin::{LoadState, Margin};
use crate::report::{Unit, significant};
use crate::wedge::WedgeCurve;
use serde::Serialize;

/// The clutch at the largest mean speed at which the design lets it carry torque; absent where it names none.
#[derive(Debug, Clone, Serialize)]
pub struct AtSpeedSection {
    /// That speed, rev/min.
    pub speed_rpm: f64,
    /// The scene that has it.
    pub scenario: String,
    /// Torque at which the curve ends there, N m; null: no curve was found.
    pub end_torque_nm: Option<f64>,
    /// Static friction that the largest torque of the limits needs there; null: not carried, or no such torque.
    pub required_friction: Option<f64>,
    /// The same at rest.
    pub required_friction_at_rest: Option<f64>,
    /// Hoop stress that rotation alone gives the outer race, MPa.
    pub rotation_hoop_outer_mpa: f64,
    /// Whether the limits are held at that speed, or a higher one, anyway.
    #[serde(skip)]
    is_held_there: bool,
    #[serde(skip)]
    asked_nm: Option<f64>,
    #[serde(skip)]
    end_at_rest_nm: f64,
    /// Codes of the rows of the outer race's hoop stress that are held at rest and would not be with what rotation adds.
    #[serde(skip)]
    breaks: Vec<String>,
}

impl AtSpeedSection {
    pub(super) fn new(design: &Design, state: &LoadState, rows: &[Margin]) -> Option<Self> {
        let carrying = design.scenarios.iter().filter(|s| !s.kind.is_overrun());
        let turning = carrying.map(|s| {
            let history = s.speed_history.iter().flatten().map(|row| row[1]).fold(0.0, f64::max);
            (s, if history > 0.0 { history } else { s.mean_speed_rad_s() })
        });
        let (scene, speed) =
            turning.filter(|(_, w)| *w > 0.0 && w.is_finite()).max_by(|a, b| a.1.total_cmp(&b.1))?;
        // Scenes have asked for it, as a rule.
        let curve = state.turning(design, speed).map(|turning| turning.curve);
        let asked_nm = design.limits.largest_torque_nm();
        let friction = |curve: &WedgeCurve| Some(curve.at_torque(asked_nm?)?.required_friction());
        let hoop_pa = state.curve.statics().elastic.outer_race.rotating_bore_hoop_pa(speed);
        let breaks = |r: &&Margin| {
            let (demand, allowed) = (r.demand.value(), r.allowable);
            r.required
                && r.held()
                && r.limit.code.starts_with("hoop-outer")
                && demand.is_some_and(|pa| pa + hoop_pa > allowed)
        };
        Some(Self {
            speed_rpm: Unit::Rpm.from_si(speed),
            scenario: scene.name.clone(),
            end_torque_nm: curve.as_ref().map(WedgeCurve::end_torque_nm),
            required_friction: curve.as_ref().and_then(friction),
            required_friction_at_rest: friction(&state.curve),
            rotation_hoop_outer_mpa: Unit::Megapascal.from_si(hoop_pa),
            is_held_there: design.limits.at_speed_rad_s.is_some_and(|held| held >= speed),
            asked_nm,
            end_at_rest_nm: state.curve.end_torque_nm(),
            breaks: rows.iter().filter(breaks).map(Margin::code).collect(),
        })
    }

    /// Whether a limit that is held at rest is not there.
    fn fails(&self) -> bool {
        if self.is_held_there {
            return false;
        }
        let short = self.asked_nm.filter(|nm| *nm <= self.end_at_rest_nm);
        !self.breaks.is_empty() || short.is_some_and(|nm| self.end_torque_nm.is_none_or(|end| end < nm))
    }

    /// What speed changes, in words.
    fn words(&self) -> String {
        let nm = |torque| Unit::NewtonMetre.show(torque, 4);
        let end = self.end_torque_nm.map_or("no curve is found".to_owned(), |end| {
            format!("the curve ends at {} ({} at rest)", nm(end), nm(self.end_at_rest_nm))
        });
        let friction = match (self.asked_nm, self.required_friction, self.required_friction_at_rest) {
            (Some(asked), Some(there), Some(rest)) => format!(
                ", {} need a friction of {} ({})",
                nm(asked),
                significant(there, 4),
                significant(rest, 4)
            ),
            (Some(asked), None, Some(_)) => format!(", {} are not carried", nm(asked)),
            _ => String::new(),
        };
        let breaks = match self.breaks.as_slice() {
            [] => String::new(),
            codes => format!(", more than {} has left", codes.join(", ")),
        };
        format!(
            "{end}{friction}, rotation adds {} MPa to the hoop stress of the outer race{breaks}",
            significant(self.rotation_hoop_outer_mpa, 3)
        )
    }

    /// A warning where a limit that is held at rest is not there.
    pub fn warning(&self) -> Option<String> {
        self.fails().then(|| {
            format!(
                "Warning: rows without a scene are at rest; at {0} rpm ({1}) {2}; at_speed_rpm = {0} in [limits] holds them there",
                significant(self.speed_rpm, 4),
                self.scenario,
                self.words()
            )
        })
    }
}
