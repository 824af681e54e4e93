//! Limits that follow from the static load state, first contact and overrun.

use super::capacity::axial_from_nm;
use super::limits::{Limit, Of, When};
use super::overrun::{overrun_at, overrun_moments};
use super::row::{Beyond, Demand, Margin};
use super::table::LIMITS;
use super::{NoMargins, curve_at_rest};
use crate::design::{Design, Limits};
use crate::dynamics::alpha_max_rad;
use crate::profile::{Outline, Profile, clearance_m};
use crate::scenario::AtRest;
use crate::wedge::{AtSpeeds, Effort, Elastic, EndReason, StaticPoint, WedgeCurve};

/// What the static limits are read from: the wedge without its energizing spring, which at such torques presses by parts in
/// ten thousand harder and lowers |T|/N.
#[derive(Debug, Clone)]
pub struct LoadState {
    /// Placed profile.
    pub profile: Profile,
    /// Closed outline; absent where the design names no flanks.
    pub outline: Option<Outline>,
    /// Curve at rest.
    pub curve: WedgeCurve,
    /// Its curves at speed, as far as scenes have asked for them.
    pub at_speeds: AtSpeeds,
    /// alpha_max of the spring, rad.
    pub alpha_max_rad: f64,
    /// tan omega at first contact.
    pub first_tan_omega: f64,
    /// Whether rows that count over all states on the way to a torque look at its ends alone: see [`ends_decide`].
    pub ends_alone: bool,
}

impl LoadState {
    /// The curve of `design`, whose state this is, for its scenes.
    pub fn at_rest<'a>(&'a self, design: &'a Design) -> AtRest<'a> {
        AtRest { clutch: &design.clutch, curve: &self.curve, at_speeds: &self.at_speeds }
    }
}

/// Build it.
///
/// # Errors
/// [`NoMargins`].
pub fn load_state(design: &Design) -> Result<LoadState, NoMargins> {
    load_state_at(design, Effort::Full)
}

/// The same with a curve at `effort`.
///
/// # Errors
/// [`NoMargins`].
pub fn load_state_at(design: &Design, effort: Effort) -> Result<LoadState, NoMargins> {
    let (profile, curve) = curve_at_rest(design, effort)?;
    let flanks = design.clutch.sprags.flanks;
    let outline = flanks.map(|f| Outline::closed(&profile, &f)).transpose().map_err(NoMargins::Outline)?;
    let first_tan_omega = curve.touch().t_ratio;
    let alpha_max_rad = alpha_max_rad(&design.clutch, &curve);
    let at_speeds = AtSpeeds::default();
    Ok(LoadState { profile, outline, curve, at_speeds, alpha_max_rad, first_tan_omega, ends_alone: false })
}

/// A load state with what is asked of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct LoadCase<'a> {
    pub design: &'a Design,
    pub limits: &'a Limits,
    pub state: &'a LoadState,
}

impl<'a> LoadCase<'a> {
    pub fn elastic(&self) -> &'a Elastic {
        &self.state.curve.statics().elastic
    }

    /// Number of sprags.
    pub fn count(&self) -> usize {
        self.design.clutch.sprags.count
    }
}

/// The static state at the torque of a limit, or at the end of the curve where that comes first.
struct Reached {
    torque_nm: f64,
    end_nm: f64,
    p: StaticPoint,
    /// States below it, rising.
    below: Vec<StaticPoint>,
}

impl Reached {
    fn new(case: &LoadCase, torque_nm: f64) -> Self {
        let end_nm = case.state.curve.end_torque_nm();
        let p = at(&case.state.curve, carried(torque_nm, end_nm));
        Self { torque_nm, end_nm, p, below: below(case.state, &p) }
    }

    /// A demand at this state.
    fn demand(&self, value: f64) -> Demand {
        beyond(value, self.torque_nm, self.end_nm)
    }

    fn row(&self, limit: &'static Limit, name: &str, value: f64, allowable: f64) -> Margin {
        let aside = not_carried(self.torque_nm, self.end_nm);
        Margin { name: name.to_owned(), aside, ..Margin::new(limit, self.demand(value), allowable) }
    }
}

pub(super) fn rows(design: &Design, limits: &Limits, state: &LoadState) -> Vec<Margin> {
    let case = LoadCase { design, limits, state };
    let reached = |when: When| when.torque_nm(limits).map(|torque_nm| Reached::new(&case, torque_nm));
    let (nominal, peak) = (reached(When::Nominal), reached(When::Peak));
    let row = |limit: &&'static Limit| match limit.when {
        When::Nominal => loaded_row(&case, limit, nominal.as_ref()?),
        When::Peak => loaded_row(&case, limit, peak.as_ref()?),
        _ => unloaded_row(&case, limit),
    };
    LIMITS.iter().filter_map(row).collect()
}

/// The row of a limit that is held at a torque.
fn loaded_row(case: &LoadCase, limit: &'static Limit, reached: &Reached) -> Option<Margin> {
    let LoadCase { design, limits, state } = *case;
    let Reached { torque_nm, end_nm, p, ref below } = *reached;
    let name = (limit.name)(limits);
    match limit.of {
        Of::RollOver => Some(reached.row(limit, name, torque_nm, state.curve.roll_over_torque_nm())),
        Of::AxialFrom => {
            limits.axial_load_n.filter(|n| *n > 0.0)?;
            let wanted = limits.nominal_torque_nm.unwrap_or(torque_nm);
            let from = axial_from_nm(design, limits, state, torque_nm);
            let demand = from.map_or(Demand::MoreThan(torque_nm.min(end_nm)), Demand::Value);
            Some(Margin { required: false, ..Margin::new(limit, demand, wanted) })
        }
        Of::Neighbours => {
            // Clearance itself, relative to the sprag's height: smooth through contact.
            let gap_m = clearance_up_to_m(design, state, &p, below)?;
            let height_m = design.clutch.races.outer_radius_m - design.clutch.races.inner_radius_m;
            Some(Margin { reference: height_m, ..reached.row(limit, name, 0.0, gap_m) })
        }
        _ => {
            let (allowed, required) = limit.allowed(design, limits)?;
            let value = limit.largest(case, &p, below)?;
            let name = limit.name_at(case, required, &p);
            Some(Margin { required, ..reached.row(limit, &name, value, allowed) })
        }
    }
}

/// The row of a limit at first contact or in overrun.
fn unloaded_row(case: &LoadCase, limit: &'static Limit) -> Option<Margin> {
    let LoadCase { design, limits, state } = *case;
    let (demand, allowable) = match limit.of {
        Of::ReEngagement => (state.first_tan_omega, design.clutch.friction.kinetic),
        Of::KeepContact => overrun_moments(design, state, limits.keep_contact_to_rad_s?),
        Of::LiftOff => {
            let (opening, closing) = overrun_moments(design, state, limits.lift_off_by_rad_s?);
            (closing, opening)
        }
        // Sprags that the spring does not press on need no film.
        Of::Film => {
            let (wanted, speed) = (limits.film_lambda?, limits.film_at_rad_s?);
            let point = overrun_at(design, state, 0.0, speed).ok()?;
            (wanted, point.lubricated?.film.lambda)
        }
        _ => return None,
    };
    Some(Margin::new(limit, Demand::Value(demand), allowable))
}

/// States looked at between no load and the peak, beside the peak itself: a choice; demands are smooth but at
/// junctions, which divide the curve into a few pieces.
const LOOKS: usize = 24;

/// Whether none of the rows that count over all states on the way to a torque has its worst between no load and that torque:
/// then none has in the state of a neighbour either that differs by next to nothing.
pub fn ends_decide(design: &Design, limits: &Limits, state: &LoadState) -> bool {
    let case = LoadCase { design, limits, state };
    let decide = |when: When| {
        let Some(torque_nm) = when.torque_nm(limits) else { return true };
        let Reached { p, below, .. } = Reached::new(&case, torque_nm);
        LIMITS.iter().filter(|limit| limit.when == when).all(|limit| match limit.of {
            Of::Neighbours => {
                let up_to = |below| clearance_up_to_m(design, state, &p, below);
                up_to(&below) == up_to(&[])
            }
            Of::Sprag { below_torque: Some(_), .. } => {
                limit.largest(&case, &p, &below) == limit.largest(&case, &p, &[])
            }
            _ => true,
        })
    };
    decide(When::Nominal) && decide(When::Peak)
}

/// States below `peak`, rising.
fn below(state: &LoadState, peak: &StaticPoint) -> Vec<StaticPoint> {
    if state.ends_alone {
        return Vec::new();
    }
    let last_n = peak.normal_inner_n;
    (1..LOOKS).filter_map(|i| state.curve.at_normal(last_n * i as f64 / LOOKS as f64)).collect()
}

/// Clearance between neighbouring sprags in a static state, m; `None` without flanks.
pub(super) fn clearance_at_m(design: &Design, state: &LoadState, p: &StaticPoint) -> Option<f64> {
    let outline = state.outline.as_ref()?;
    let (oc_e, rotation) = match state.curve.closure_at_normal(p.normal_inner_n) {
        Some((_, c)) if p.normal_inner_n > 0.0 => (c.lengths.oc_e.v, c.rotation.v),
        _ => (state.profile.outer_centre_distance_m, 0.0),
    };
    Some(clearance_m(outline, oc_e, rotation, design.clutch.sprags.count))
}

/// The smallest from no load over the states `below` to `peak`.
fn clearance_up_to_m(
    design: &Design,
    state: &LoadState,
    peak: &StaticPoint,
    below: &[StaticPoint],
) -> Option<f64> {
    let all = [&StaticPoint::UNLOADED, peak].into_iter().chain(below);
    all.map(|p| clearance_at_m(design, state, p)).reduce(|a, b| Some(a?.min(b?)))?
}

/// The torque, or one a hair below the curve's end where that comes first.
fn carried(torque_nm: f64, end_nm: f64) -> f64 {
    if torque_nm > end_nm && end_nm > 0.0 { end_nm * (1.0 - 1e-12) } else { torque_nm }
}

/// A demand at a torque, or where the curve ends before, at `end`; one that is infinite no friction meets.
pub(super) fn beyond(value: f64, torque: f64, end: f64) -> Demand {
    match end >= torque {
        true if value.is_finite() => Demand::Value(value),
        true => Demand::NoneSuffices,
        false => Demand::Overloaded {
            at_end: Some(value).filter(|v| v.is_finite()),
            beyond: Beyond::Short(end / torque - 1.0),
        },
    }
}

/// Behind the name of a row: that its torque is not carried, where the curve ends below it.
pub(super) fn not_carried(torque_nm: f64, end_nm: f64) -> Option<String> {
    match end_nm >= torque_nm {
        true => None,
        false => Some(format!(
            "not carried, demand and clearance are those at the end of the curve, {end_nm:.4} Nm, the margin is at most \
             what the torque lacks"
        )),
    }
}

/// Static point at `torque`, or at the curve's end if that comes first.
fn at(curve: &WedgeCurve, torque: f64) -> StaticPoint {
    let last = curve.arc_end_n(curve.arc_count() - 1);
    curve.at_torque(torque).or_else(|| curve.at_normal(last)).unwrap_or(StaticPoint::UNLOADED)
}

/// Whether and where the curve ends below roll-over: for the capacity of the profile itself.
pub(super) fn profile_capacity(state: &LoadState) -> f64 {
    match state.curve.end().0 {
        EndReason::OffProfile => state.curve.end_torque_nm(),
        _ => state.curve.roll_over_torque_nm(),
    }
}
