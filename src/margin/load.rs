//! Limits that follow from the static load state, first contact and overrun.

use super::NoMargins;
use super::capacity::axial_from_nm;
use super::limits::{Limit, Of, When};
use super::overrun::{overrun_at, overrun_moments};
use super::pressed::most_pressed;
use super::row::{BeyondEnd, Demand, Margin};
use super::table::LIMITS;
use crate::design::{Design, Limits};
use crate::dynamics::alpha_max_rad;
use crate::numeric::rounded;
use crate::profile::{self, Outline, Profile};
use crate::scenario::AtRest;
use crate::wedge::{AtSpeed, AtSpeeds, Effort, Elastic, EndReason, StaticPoint, Statics, WedgeCurve};

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
    /// The looks at which rows see states on the way to a torque, see [`LoadRows::deciding`]; `None`: all.
    pub looks: Option<Vec<usize>>,
}

impl LoadState {
    /// The curve of `design`, whose state this is, for its scenes.
    pub fn at_rest<'a>(&'a self, design: &'a Design) -> AtRest<'a> {
        AtRest { clutch: &design.clutch, curve: &self.curve, at_speeds: &self.at_speeds }
    }

    /// The same while the clutch turns at `speed_rad_s`; `None` where no curve is found there.
    pub(crate) fn turning(&self, design: &Design, speed_rad_s: f64) -> Option<Self> {
        let whole = AtSpeed { speed_rad_s, reach_nm: None };
        let curve = self.at_speeds.of(self.curve.statics(), &design.clutch, whole)?;
        Some(Self { curve, ..self.clone() })
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
    load_state_with(design, effort, None, &Ahead::default())
}

/// Curves at speed that are built with a load state, because scenes will ask for them.
#[derive(Debug, Clone, Default)]
pub struct Ahead {
    /// Which.
    pub asked: Vec<AtSpeed>,
    /// Whether the curve at rest and those may be built side by side.
    pub side_by_side: bool,
}

/// The same with the curves `ahead`, and next to the clutch of `like`.
///
/// # Errors
/// [`NoMargins`].
pub fn load_state_with(
    design: &Design,
    effort: Effort,
    like: Option<&LoadState>,
    ahead: &Ahead,
) -> Result<LoadState, NoMargins> {
    let clutch = &design.clutch;
    let profile = clutch.profile().map_err(NoMargins::Profile)?;
    let taken = like.map_or(effort, |like| like.curve.effort());
    let statics = Statics::at_effort(clutch, &profile, taken).map_err(NoMargins::Curve)?;
    let at_speeds = like.map_or_else(AtSpeeds::default, |like| like.at_speeds.beside());
    let at_rest = || WedgeCurve::build_on(statics.clone(), clutch, like.map(|like| &like.curve));
    let turning = || {
        for asked in &ahead.asked {
            // Where there is none, the scene says so.
            at_speeds.of(&statics, clutch, *asked);
        }
    };
    // Scenes take them at their own effort alone.
    let curve = if ahead.side_by_side && taken == effort && !ahead.asked.is_empty() {
        rayon::join(at_rest, turning).0
    } else {
        let curve = at_rest();
        if curve.as_ref().is_ok_and(|curve| curve.effort() == effort) {
            turning();
        }
        curve
    };
    let curve = curve.map_err(NoMargins::Curve)?;
    let outline = clutch.sprags.flanks.map(|f| Outline::closed(&profile, &f)).transpose();
    let outline = outline.map_err(NoMargins::Outline)?;
    let first_tan_omega = curve.touch().t_ratio;
    let alpha_max_rad = alpha_max_rad(clutch, &curve);
    Ok(LoadState { profile, outline, curve, at_speeds, alpha_max_rad, first_tan_omega, looks: None })
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
    /// Numbers of the looks at states below it, and these, rising.
    looks: Vec<usize>,
    below: Vec<StaticPoint>,
    /// The one below it in which the inner contact is pressed most, where that is more than at it, with the number of the look beside it.
    pressed: Option<(usize, StaticPoint)>,
}

impl Reached {
    fn new(case: &LoadCase, torque_nm: f64) -> Self {
        let end_nm = case.state.curve.end_torque_nm();
        let p = at(&case.state.curve, carried(torque_nm, end_nm));
        let (looks, below) = below(case.state, &p).unzip();
        let pressed = most_pressed(case.state, &p);
        Self { torque_nm, end_nm, p, looks, below, pressed }
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

/// Margins of a load state.
#[derive(Debug, Clone)]
pub struct LoadRows {
    /// The rows.
    pub rows: Vec<Margin>,
    /// Looks at states between no load and a torque at which a row that counts over all of them has its worst: it has it there in the
    /// state of a neighbour too that differs by next to nothing.
    pub deciding: Vec<usize>,
}

/// Behind the name of a row that is worse while the clutch turns than at rest.
const TURNING: &str = "while it turns";

impl Margin {
    /// Whether it is that of the clutch while it turns, [`Limits::at_speed_rad_s`].
    pub fn turns(&self) -> bool {
        self.aside.as_ref().is_some_and(|aside| aside.starts_with(TURNING))
    }
}

impl LoadRows {
    /// Of each limit that is held at a torque the row at rest or that of the clutch `turning`, which has the torque at the end of its curve
    /// (N m), whichever is worse; lost where that has no curve.
    pub(super) fn or_turning(mut self, turning: Option<(Self, f64)>) -> Self {
        let loaded = |row: &&mut Margin| matches!(row.limit.when, When::Nominal | When::Peak);
        let Some((turning, end_nm)) = turning else {
            for row in self.rows.iter_mut().filter(loaded) {
                row.demand = Demand::Overloaded { at_end: None, beyond: BeyondEnd::Short(-1.0) };
                row.aside = Some(format!("{TURNING}, where no curve is found"));
                row.torque_capacity_nm = row.torque_capacity_nm.map(|_| 0.0);
            }
            return self;
        };
        for row in self.rows.iter_mut().filter(loaded) {
            let there = turning.rows.iter().find(|there| there.limit.code == row.limit.code);
            if let Some(there) = there.filter(|there| there.margin() < row.margin()) {
                let aside = match &there.aside {
                    None => TURNING.to_owned(),
                    Some(aside) => format!("{TURNING}, {aside}"),
                };
                *row = Margin { aside: Some(aside), end_torque_nm: Some(end_nm), ..there.clone() };
            }
        }
        self.deciding.extend(turning.deciding);
        self
    }
}

pub(super) fn rows(design: &Design, limits: &Limits, state: &LoadState) -> LoadRows {
    let mut deciding = Vec::new();
    let case = LoadCase { design, limits, state };
    let reached = |when: When| when.torque_nm(limits).map(|torque_nm| Reached::new(&case, torque_nm));
    let (nominal, peak) = (reached(When::Nominal), reached(When::Peak));
    let mut row = |limit: &&'static Limit| match limit.when {
        When::Nominal => loaded_row(&case, limit, nominal.as_ref()?, &mut deciding),
        When::Peak => loaded_row(&case, limit, peak.as_ref()?, &mut deciding),
        _ => unloaded_row(&case, limit),
    };
    let rows = LIMITS.iter().filter_map(&mut row).collect();
    let on_the_way = [&nominal, &peak].into_iter().flatten().filter_map(|reached| reached.pressed);
    deciding.extend(on_the_way.map(|(look, _)| look));
    LoadRows { rows, deciding }
}

/// The row of a limit that is held at a torque; where a state on the way there is the worst, its look goes to `deciding`.
fn loaded_row(
    case: &LoadCase,
    limit: &'static Limit,
    reached: &Reached,
    deciding: &mut Vec<usize>,
) -> Option<Margin> {
    let LoadCase { design, limits, state } = *case;
    let Reached { torque_nm, end_nm, p, ref looks, ref below, pressed } = *reached;
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
            let clearance_m = clearances_m(design, state)?;
            let at_ends_m = clearance_m(&StaticPoint::UNLOADED).min(clearance_m(&p));
            let on_the_way_m: Vec<f64> = below.iter().map(clearance_m).collect();
            let gap_m = on_the_way_m.iter().copied().fold(at_ends_m, f64::min);
            deciding.extend(
                looks.iter().zip(on_the_way_m).find(|(_, m)| *m < at_ends_m && *m == gap_m).map(|(i, _)| i),
            );
            let height_m = design.clutch.races.outer_radius_m - design.clutch.races.inner_radius_m;
            Some(Margin { reference: height_m, ..reached.row(limit, name, 0.0, gap_m) })
        }
        _ => {
            let (allowed, required) = limit.allowed(design, limits)?;
            let value = limit.largest(case, &p, below)?;
            if !below.is_empty() && limit.largest(case, &p, &[]) != Some(value) {
                let is_largest = |at: &StaticPoint| limit.largest(case, &p, &[*at]) == Some(value);
                deciding.extend(looks.iter().zip(below).find(|(_, at)| is_largest(at)).map(|(i, _)| i));
            }
            let (value, at) = match pressed.filter(|_| limit.pressed) {
                Some((_, on_the_way)) => match limit.demand(case, &on_the_way)? {
                    more if more > value => (more, on_the_way),
                    _ => (value, p),
                },
                None => (value, p),
            };
            let name = limit.name_at(case, required, &at);
            let name = match at.torque_nm < p.torque_nm {
                true => format!("{name}; largest on the way, at {} Nm", rounded(at.torque_nm, 4)),
                false => name,
            };
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
            let demand = Demand::Value(wanted);
            let row = Margin::new(limit, demand, point.lubricated?.film.lambda);
            return Some(match design.clutch.slides_outside() {
                true => Margin { name: row.name.replace("inner", "outer"), ..row },
                false => row,
            });
        }
        _ => return None,
    };
    Some(Margin::new(limit, Demand::Value(demand), allowable))
}

/// States looked at between no load and the peak, beside the peak itself: a choice; demands are smooth but at
/// junctions, which divide the curve into a few pieces.
pub(super) const LOOKS: usize = 24;

/// Numbers of the looks at states below `peak`, and these, rising.
fn below(state: &LoadState, peak: &StaticPoint) -> impl Iterator<Item = (usize, StaticPoint)> {
    let last_n = peak.normal_inner_n;
    let counts = move |i: &usize| state.looks.as_ref().is_none_or(|looks| looks.contains(i));
    let at = move |i: usize| Some((i, state.curve.at_normal(last_n * i as f64 / LOOKS as f64)?));
    (1..LOOKS).filter(counts).filter_map(at)
}

/// Clearance between neighbouring sprags by their static state, m; `None` without flanks.
pub(super) fn clearances_m(design: &Design, state: &LoadState) -> Option<impl Fn(&StaticPoint) -> f64> {
    let clearance_m = profile::clearances_m(state.outline.as_ref()?, design.clutch.sprags.count);
    Some(move |p: &StaticPoint| {
        let (oc_e, rotation) = match state.curve.closure_at_normal(p.normal_inner_n) {
            Some((_, c)) if p.normal_inner_n > 0.0 => (c.lengths.oc_e.v, c.rotation.v),
            _ => (state.profile.outer_centre_distance_m, 0.0),
        };
        clearance_m(oc_e, rotation)
    })
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
            beyond: BeyondEnd::Short(end / torque - 1.0),
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
pub(super) fn at(curve: &WedgeCurve, torque: f64) -> StaticPoint {
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
