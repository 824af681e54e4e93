//! Allowables against demands: the designer's margin check.
//!
//! In: a `Design`. Out: [`Margin`] rows, torque capacities. Absent: how forces come about.
//! Equations: none; margin = allowable/demand - 1 unless a row says otherwise, 0 or more is held.

mod body;
mod capacity;
mod gap;
mod held;
mod hoop;
mod load;
mod overrun;
mod run_out;
mod scenes;
mod sprag;
mod subsurface;

pub use capacity::{Course, courses, nominal_capacity};
pub use held::at_nominal_torque;
pub use load::{LoadState, load_state};
pub use overrun::{LIFT_OFF_ERROR, OverrunCurve, OverrunPoint, lift_off_rad_s, overrun_curve};
pub use run_out::{Round, RunOut, Seat, SpragLoad, Stop, Survey, run_out_margins};
pub use scenes::{SceneDemand, scene_demand};

use crate::design::{Design, Limits, Scenario, ScenarioKind};
use crate::scenario::{Settings, place_profile};
use crate::wedge::{NoCurve, WedgeCurve};

/// One limit.
#[derive(Debug, Clone, PartialEq)]
pub struct Margin {
    /// Stable code for scripts.
    pub code: String,
    /// Name for people.
    pub name: String,
    /// Demand, in `unit`.
    pub demand: f64,
    /// Allowable, in `unit`.
    pub allowable: f64,
    /// Unit of demand and allowable as printed; SI inside is not needed for a ratio.
    pub unit: &'static str,
    /// Margin; 0 or more is held.
    pub margin: f64,
    /// Torque at which this limit would be reached, N m, where it depends on torque.
    pub torque_capacity_nm: Option<f64>,
    /// Whether it counts for the verdict; the others are shown only.
    pub required: bool,
    /// Whether demand and margin are known; else a run met its limit of work, and the margin is -1.
    pub computed: bool,
    /// Whether the row goes beyond the end of the curve: its scene, so that the margin is -1 whatever the friction, or its
    /// torque, so that the margin is at most what the torque lacks, end/torque - 1, and the demand that at the end.
    pub overloaded: bool,
}

/// Resolution of a margin: what the optimiser leaves of a limit that it stops at. A margin above minus this is
/// held.
pub const RESOLUTION: f64 = 1e-8;

impl Margin {
    /// Whether the limit is held.
    pub fn held(&self) -> bool {
        self.margin >= -RESOLUTION
    }
}

/// Why no margins can be computed.
#[derive(Debug, Clone, PartialEq)]
pub enum NoMargins {
    /// The profile cannot be placed.
    Profile(crate::profile::ProfileError),
    /// The outline does not close.
    Outline(crate::profile::OutlineError),
    /// No wedge curve.
    Curve(NoCurve),
}

impl std::fmt::Display for NoMargins {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Profile(e) => write!(f, "the profile cannot be placed: {e}"),
            Self::Outline(e) => write!(f, "the outline does not close: {e}"),
            Self::Curve(e) => write!(f, "no wedge curve: {e}"),
        }
    }
}

impl std::error::Error for NoMargins {}

/// All margins of `design` under `limits`: first those of the load state, then those of the scenarios named in
/// `scenes` (required) and, with `others`, of the remaining ones (shown only). `capacities` asks for the torque
/// capacity of each limit as well.
///
/// # Errors
/// [`NoMargins`] where there is no clutch to speak of; a scenario that cannot start is a row with margin -1.
pub fn margins(
    design: &Design,
    limits: &Limits,
    scenes: &[String],
    others: bool,
    capacities: bool,
    settings: &Settings,
) -> Result<Vec<Margin>, NoMargins> {
    let state = load_state(design)?;
    let mut rows = load_margins(design, limits, capacities, &state);
    for scenario in &design.scenarios {
        let required = scenes.contains(&scenario.name);
        if required || others {
            rows.extend(scene_margins(scenario, limits, required, settings));
        }
    }
    Ok(rows)
}

/// The margins of the load state `state` of `design` alone.
pub fn load_margins(design: &Design, limits: &Limits, capacities: bool, state: &LoadState) -> Vec<Margin> {
    let mut rows = load::rows(design, limits, state);
    if capacities {
        capacity::fill(&mut rows, design, limits, state);
    }
    rows
}

/// The margins of one scenario, slip, contact and, with a limit on it, Hertz pressure; none of a steady overrun, where A slides and nothing is to
/// stick (limits `keep-contact` and `lift-off` hold that). Scenarios know nothing of one another, so a caller may
/// take them in parallel.
pub fn scene_margins(
    scenario: &Scenario,
    limits: &Limits,
    required: bool,
    settings: &Settings,
) -> Vec<Margin> {
    match scenario.kind {
        ScenarioKind::Overrun { .. } => Vec::new(),
        _ => scene_rows(scenario, &scene_demand(scenario, settings), limits, required),
    }
}

/// The same margins from a demand that is known.
pub fn scene_rows(scenario: &Scenario, found: &SceneDemand, limits: &Limits, required: bool) -> Vec<Margin> {
    scenes::rows(&scenario.name, found, limits, required)
}

/// The curve of a design at rest.
fn curve_at_rest(design: &Design) -> Result<(crate::profile::Profile, WedgeCurve), NoMargins> {
    let profile = place_profile(&design.clutch).map_err(NoMargins::Profile)?;
    let curve = WedgeCurve::build(&design.clutch, &profile, 0.0).map_err(NoMargins::Curve)?;
    Ok((profile, curve))
}

/// margin = allowable/demand - 1; no demand counts as a margin of 1e6.
fn ratio(demand: f64, allowable: f64) -> f64 {
    if demand.abs() * 1e6 <= allowable.abs() { 1e6 } else { allowable / demand - 1.0 }
}
