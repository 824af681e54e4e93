//! Allowables against demands: the designer's margin check.
//!
//! In: a `Design`. Out: [`Margin`] rows, torque capacities. Absent: how forces come about.
//! Equations: none; margin = allowable/demand - 1 unless a row says otherwise, 0 or more is held.

mod body;
mod capacity;
mod hoop;
mod lengthwise;
mod limits;
mod load;
mod overrun;
mod pressed;
mod row;
mod run_out;
mod scenes;
mod sprag;
mod subsurface;
mod table;
mod track_tension;
mod unlike;

pub use body::body_flanks_pa;
pub use capacity::{DemandCourse, courses, nominal_capacity};
pub use hoop::{ring_places_pa, rings_pa};
pub use limits::{Limit, When, limit_of};
pub use load::{Ahead, LoadRows, LoadState, load_state, load_state_at, load_state_with};
pub use overrun::{
    LIFT_OFF_ERROR, LIFT_OFF_TO_RAD_S, OverrunCurve, OverrunPoint, lift_off_rad_s, lift_off_under,
    overrun_at, overrun_curve,
};
pub use pressed::largest_pressures_pa;
pub use row::{BeyondEnd, Demand, Left, Margin, RESOLUTION, Rule, lowest_capacity};
pub use run_out::{OffCentreEnd, Round, RunOut, Seat, SpragLoad, Survey, run_out_margins};
pub use scenes::{SceneDemand, scene_demand};
pub use subsurface::shear_in;
pub use table::{CONTACT, END_OF_PROFILE, FILM, KEEP_CONTACT, LIFT_OFF, LIMITS, SLIP, allowed_opening_m};
pub use track_tension::{TrackPatch, TrackTension, track_tension};
pub use unlike::unlike_margins;

use crate::clutch::{Clutch, Scenario};
use crate::design::{Design, Limits};
use crate::follow::Follow;
use crate::scenario::{AtRest, Settings};
use crate::wedge::{NoCurve, NoElastic, WedgeCurve};
use run_out::run_out_margins_until;
use unlike::unlike_margins_until;

/// Why no margins can be computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoMargins {
    /// The profile cannot be placed.
    #[error("the profile cannot be placed: {0}")]
    Profile(crate::profile::ProfileError),
    /// The outline does not close.
    #[error("the outline does not close: {0}")]
    Outline(crate::profile::OutlineError),
    /// No wedge curve.
    #[error("no wedge curve: {0}")]
    Curve(NoCurve),
}

impl NoMargins {
    /// Keys of the design file that decide it.
    pub fn keys(&self) -> &'static str {
        match self {
            Self::Outline(_) => "sprags.flanks, sprags.inner_arcs",
            Self::Curve(NoCurve::NoElastic(NoElastic::Race(_))) => "races, material",
            Self::Curve(NoCurve::NoElastic(NoElastic::ThinRace { .. })) => {
                "races.inner_bore_radius_mm with races.inner_radius_mm, races.outer_outside_radius_mm with races.outer_radius_mm"
            }
            Self::Curve(NoCurve::NoElastic(NoElastic::Contact(_))) => "contact, material, sprags.length_mm",
            Self::Curve(NoCurve::NoConvergence) => {
                "contact, material, sprags.length_mm, sprags.inner_arcs, races"
            }
            Self::Profile(_) | Self::Curve(NoCurve::NoFirstContact) => {
                "sprags.outer_radius_mm, sprags.centre_distance_mm, sprags.inner_arcs, races.inner_radius_mm, \
                 races.outer_radius_mm"
            }
        }
    }
}

impl Clutch {
    /// Its wedge curve at rest.
    ///
    /// # Errors
    /// [`NoMargins`] where there is none.
    pub fn curve(&self) -> Result<WedgeCurve, NoMargins> {
        let profile = self.profile().map_err(NoMargins::Profile)?;
        WedgeCurve::build(self, &profile, 0.0).map_err(NoMargins::Curve)
    }
}

/// All margins of `design`: first those of the load state, each with its torque capacity, then those of the scenarios named in
/// `scenes`, as a rule [`Design::check_scenarios`].
///
/// # Errors
/// [`NoMargins`] where there is no clutch to speak of; a scenario that cannot start is a row with margin -1.
pub fn margins(design: &Design, scenes: &[String], settings: &Settings) -> Result<Vec<Margin>, NoMargins> {
    let state = load_state(design)?;
    let mut rows = load_margins(design, &design.limits, Capacities::Wanted, &state);
    for scenario in design.scenarios.iter().filter(|scenario| scenes.contains(&scenario.name)) {
        rows.extend(scene_margins(scenario, &design.limits, true, Some(state.at_rest(design)), settings));
    }
    Ok(rows)
}

/// Whether rows have the torque at which each limit would be reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Capacities {
    /// They are computed.
    Wanted,
    /// They are left out.
    LeftOut,
}

/// All margins that are no scene's, with what they are read from: the load state, and the load round the circumference where
/// the axes lie apart.
///
/// # Errors
/// [`NoMargins`].
pub fn static_margins(
    design: &Design,
    capacities: Capacities,
) -> Result<(LoadState, Vec<Margin>, Option<RunOut>), NoMargins> {
    static_margins_until(design, capacities, &Follow::nobody())
}

/// The same; stopped by `follow`, they mean nothing.
///
/// # Errors
/// [`NoMargins`].
pub(crate) fn static_margins_until(
    design: &Design,
    capacities: Capacities,
    follow: &Follow,
) -> Result<(LoadState, Vec<Margin>, Option<RunOut>), NoMargins> {
    let state = load_state(design)?;
    let mut rows = load_margins(design, &design.limits, capacities, &state);
    let (of_sprags, ring) = single_sprag_margins(design, &design.limits, capacities, &state, follow);
    rows.extend(of_sprags);
    Ok((state, rows, ring))
}

/// The margins of sprags off centre and of unlike ones in the load state `state` of `design`, and the load round the circumference
/// where the axes lie apart; stopped by `follow`, they mean nothing.
pub(crate) fn single_sprag_margins(
    design: &Design,
    limits: &Limits,
    capacities: Capacities,
    state: &LoadState,
    follow: &Follow,
) -> (Vec<Margin>, Option<RunOut>) {
    let ring = if follow.stopped() { None } else { RunOut::new(design, state) };
    let off_centre =
        ring.as_ref().map(|ring| run_out_margins_until(design, limits, ring, capacities, follow));
    let mut rows = off_centre.unwrap_or_default();
    rows.extend(unlike_margins_until(design, limits, state, capacities, follow));
    (rows, ring)
}

/// The margins of the load state `state` of `design` alone.
pub fn load_margins(
    design: &Design,
    limits: &Limits,
    capacities: Capacities,
    state: &LoadState,
) -> Vec<Margin> {
    load_rows(design, limits, capacities, state).rows
}

/// The same with what they say of the states on the way to a torque.
pub fn load_rows(design: &Design, limits: &Limits, capacities: Capacities, state: &LoadState) -> LoadRows {
    load_rows_by(design, limits, capacities, state, |_, _| {})
}

/// The same, the rows of each state, at rest and while it turns, changed by `change` before the worse are taken.
pub fn load_rows_by(
    design: &Design,
    limits: &Limits,
    capacities: Capacities,
    state: &LoadState,
    change: impl Fn(&mut [Margin], &LoadState),
) -> LoadRows {
    let rows = |state: &LoadState| {
        let mut found = load::rows(design, limits, state);
        if capacities == Capacities::Wanted {
            capacity::fill(&mut found.rows, design, limits, state);
        }
        change(&mut found.rows, state);
        found
    };
    let found = rows(state);
    match limits.at_speed_rad_s {
        None => found,
        Some(speed) => {
            let turning = state.turning(design, speed);
            found.or_turning(turning.map(|turning| (rows(&turning), turning.curve.end_torque_nm())))
        }
    }
}

/// The margins of one scenario, slip, contact and, with a limit on it, Hertz pressure; none of a steady overrun, where
/// A slides and nothing is to stick (limits `keep-contact` and `lift-off` hold that). Scenarios know nothing of one
/// another, so a caller may take them in parallel; `known`: a curve that need not be built again.
pub fn scene_margins(
    scenario: &Scenario,
    limits: &Limits,
    required: bool,
    known: Option<AtRest>,
    settings: &Settings,
) -> Vec<Margin> {
    if scenario.kind.is_overrun() {
        return Vec::new();
    }
    scene_rows(scenario, &scene_demand(scenario, known, settings), limits, required)
}

/// The same margins from a demand that is known.
pub fn scene_rows(scenario: &Scenario, found: &SceneDemand, limits: &Limits, required: bool) -> Vec<Margin> {
    scenes::rows(&scenario.name, found, limits, required)
}

/// The same margins of a scene of which nothing is known: a search has them of a neighbour that it does not follow.
pub(crate) fn unknown_scene_rows(scenario: &Scenario, limits: &Limits) -> Vec<Margin> {
    scenes::unknown_rows(&scenario.name, limits)
}
