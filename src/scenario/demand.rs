//! What a scene demands of friction and contact if it is to roll throughout, and how runs are set up.

use super::bisected::{MOST_FRICTION, bisected};
use super::prepare::Prepared;
use super::simulate::Settings;
use crate::dynamics::{
    Jump, Model, Rolling, RollingTrack, Run, RunSettings, Stop, rolling, rolling_quickly, rolling_read_again,
    rolling_retraced, rolling_tracked, run,
};

/// What pure rolling would demand: the basis of slip margin and contact margin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollingDemand {
    /// mu_req: the static friction from which on the scene sticks, that is, no contact begins to slip while A carries
    /// [`Model::loaded_n`](crate::dynamics::Model::loaded_n) (1 % of the load of the largest torque) and the path of slip at A
    /// is no more than 1 um. Where the rolling run asks for most while A is loaded, its peak of |T|/N. `None`: no friction up
    /// to 1 suffices.
    pub required_friction: Option<f64>,
    /// Whether mu_req was bisected by runs with slip, because the contact of the rolling run all but opens.
    pub by_bisection: bool,
    /// mu_s/mu_req - 1; `None` where no friction suffices.
    pub slip_margin: Option<f64>,
    /// N_min/N_static of the rolling run, below zero by the tension that rolling would need; without a static load
    /// N_min/N_max.
    pub contact_margin: f64,
    /// Largest N_bi and N_be of the rolling run, N.
    pub normal_max_n: [f64; 2],
    /// Whether the rolling run reached its end, engaged.
    pub finished: bool,
    /// Whether it went beyond the end of the curve instead: the sprag rolls over or leaves its profile.
    pub overloaded: bool,
    /// Whether the scene begins in overrun and ends before the clutch engages: then nothing of it holds.
    pub never_engages: bool,
    /// Where it met a limit of work instead, or ceased to be finite: then nothing of it holds.
    pub gave_up: Option<Stop>,
    /// Whether it was interrupted from outside; then nothing of it holds.
    pub interrupted: bool,
    /// Right-hand sides it took.
    pub rhs_evaluations: u64,
}

/// Steps per period at least: six looks in each see every half wave. Tolerances below 1e-4 take shorter ones anyway.
pub(super) const STEPS_PER_PERIOD: f64 = 4.0;
/// The same where peaks of a single run must be good to a hundredth of the tolerance.
pub(super) const STEPS_PER_PERIOD_OF_DEMAND: f64 = 14.0;

/// What periods that are jumped may move a figure by, as a part of the error that it may have.
const JUMPED: f64 = 0.1;

/// How fine a run is.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fineness {
    /// Relative tolerance of its steps.
    pub(super) tolerance: f64,
    /// Its longest step as a part of the one chosen.
    pub(super) longest: f64,
    /// Whether its pure-rolling run may be the quick one, and its tolerance.
    pub(super) quick: Option<f64>,
}

impl Fineness {
    /// Of a run that no other follows.
    pub(super) fn single(tolerance: f64) -> Self {
        Self { tolerance, longest: 1.0, quick: None }
    }
}

pub(super) fn run_settings(
    prepared: &Prepared,
    settings: &Settings,
    fineness: Fineness,
    samples: usize,
    per_period: f64,
) -> RunSettings {
    let chosen = || prepared.period_s.map_or(prepared.duration_s / 200.0, |p| p / per_period);
    let [most_steps, most_events] = settings.limits(prepared);
    let longest_step_s = fineness.longest * settings.longest_step_s.unwrap_or_else(chosen);
    RunSettings {
        tolerance: fineness.tolerance,
        duration_s: prepared.duration_s,
        longest_step_s,
        most_events,
        most_steps,
        samples,
        jump_period_s: settings.jump_period_s(prepared),
        jump_swings: !settings.every_period,
        jump_error: JUMPED * settings.tolerance,
        rolling: false,
        energy: settings.energy,
        slip_heat: settings.slip_heat,
        history: settings.history,
        follow: settings.follow.clone(),
    }
}

/// Pure-rolling demand of a prepared scenario; static kinds read it off the curve. An engagement is rolled from
/// the moment at which it has ceased to overrun. Where rolling would need tension, or unloads the contact and asks for most
/// there, no peak of |T|/N says what friction suffices: then that is bisected.
pub fn demand(prepared: &Prepared, settings: &Settings) -> RollingDemand {
    demand_at(prepared, settings, Fineness::single(0.1 * settings.tolerance), None)
}

/// Tolerance of the steps of a quick run over that of its figures: a step's error is a fifth of it at most, over
/// [`STEPS_PER_PERIOD_OF_DEMAND`] steps in a period mostly far less, and what it leaves decays.
const QUICK: f64 = 2.0;
/// The same where no period bounds the steps.
const QUICK_WITHOUT_PERIOD: f64 = 0.1;

/// Tolerance of the steps of a quick run.
fn quick_tolerance(prepared: &Prepared, settings: &Settings) -> f64 {
    settings.tolerance * if prepared.period_s.is_some() { QUICK } else { QUICK_WITHOUT_PERIOD }
}

/// As [`demand`], for a search: two equations instead of ten where contact is kept. What it differs by from
/// [`demand`] stays below the tolerance (test `the_quick_demand_is_the_demand`); where next to nothing damps the swing, below four of them,
/// where rolling needs tension, below five.
/// It ends before its scene once no more can come ([`crate::dynamics`]'s `settled`).
pub fn demand_quickly(prepared: &Prepared, settings: &Settings) -> RollingDemand {
    let single = Fineness::single(0.1 * settings.tolerance);
    let fineness = Fineness { quick: Some(quick_tolerance(prepared, settings)), ..single };
    demand_at(prepared, settings, fineness, None)
}

/// The same at steps as fine as asked for; `near`: the mu_req that was bisected at coarser ones.
pub(super) fn demand_at(
    prepared: &Prepared,
    settings: &Settings,
    fineness: Fineness,
    near: Option<f64>,
) -> RollingDemand {
    if prepared.duration_s == 0.0 {
        return at_rest(prepared);
    }
    roll(prepared, &unaudited(settings), fineness, 0, STEPS_PER_PERIOD_OF_DEMAND, near).1
}

/// mu_s/mu_req - 1.
pub(super) fn slip_margin(model: &Model, required_friction: Option<f64>) -> Option<f64> {
    required_friction.map(|mu| model.friction.static_ / mu - 1.0)
}

/// What a static scenario demands.
fn at_rest(prepared: &Prepared) -> RollingDemand {
    let f = prepared.at_rest();
    let required = f.map(|f| f.required_friction());
    RollingDemand {
        required_friction: required,
        by_bisection: false,
        slip_margin: slip_margin(&prepared.model, required),
        contact_margin: 1.0,
        normal_max_n: f.map_or([0.0; 2], |f| [f.normal_inner_n, f.normal_outer_n]),
        finished: true,
        overloaded: false,
        never_engages: false,
        gave_up: None,
        interrupted: false,
        rhs_evaluations: 0,
    }
}

/// The same with what it integrated, for [`demand_retraced`]; `None` where it integrated nothing, or not what rolls from start to
/// end: an engagement, one that meets the end of the curve; and where friction is bisected, unless none suffices.
pub fn demand_tracked(prepared: &Prepared, settings: &Settings) -> (RollingDemand, Option<RollingTrack>) {
    let by_peaks = || {
        if prepared.duration_s == 0.0 || prepared.overrun.is_some() {
            return None;
        }
        let single = Fineness::single(0.1 * settings.tolerance);
        let s = run_settings(prepared, &unaudited(settings), single, 0, STEPS_PER_PERIOD_OF_DEMAND);
        let (model, state, place) = (&prepared.model, prepared.state, prepared.mode.place);
        let quick = quick_tolerance(prepared, settings);
        let (found, track) = rolling_tracked(model, state, place, &s, quick)?;
        let mut demand = of_peaks(prepared, &found);
        if demand.finished && found.required_friction.is_none() {
            let fineness = Fineness { quick: Some(quick), ..single };
            bisect(&mut demand, prepared, settings, fineness, None, 0.0);
        }
        let has_slopes = !demand.by_bisection || demand.required_friction.is_none();
        demand.finished.then(|| (demand, Some(track).filter(|_| has_slopes)))
    };
    by_peaks().unwrap_or_else(|| (demand_quickly(prepared, settings), None))
}

/// Demand of a scene like the one whose `track` is given, so near to it that the difference counts to the first order alone:
/// differences of such demands are derivatives. A static scene needs no track. `None` without one, and where the neighbour goes
/// another way.
pub fn demand_retraced(prepared: &Prepared, track: Option<&RollingTrack>) -> Option<RollingDemand> {
    if prepared.duration_s == 0.0 {
        return Some(at_rest(prepared));
    }
    let found = rolling_retraced(&prepared.model, prepared.state, prepared.mode.place, track?)?;
    Some(of_peaks(prepared, &found))
}

/// The same of the very scene whose `track` is given.
pub fn demand_read_again(prepared: &Prepared, track: &RollingTrack) -> Option<RollingDemand> {
    let found = rolling_read_again(&prepared.model, prepared.state, prepared.mode.place, track)?;
    Some(of_peaks(prepared, &found))
}

/// Demand of a pure-rolling run whose peak of |T|/N says what friction suffices.
fn of_peaks(prepared: &Prepared, r: &Rolling) -> RollingDemand {
    let required_friction = r.required_friction.filter(|&mu| mu <= MOST_FRICTION);
    RollingDemand {
        required_friction,
        by_bisection: false,
        slip_margin: slip_margin(&prepared.model, required_friction),
        contact_margin: r.contact_margin(prepared.static_normal_n),
        normal_max_n: [r.run.peaks.normal_max_n, r.run.peaks.normal_outer_max_n],
        finished: r.stop == Stop::Finished,
        overloaded: r.stop == Stop::CurveEnd,
        never_engages: false,
        gave_up: r.stop.gave_up().then_some(r.stop),
        interrupted: r.stop == Stop::Interrupted,
        rhs_evaluations: r.run.counters.rhs_evaluations,
    }
}

/// Without an energy balance and the heat of slip, which cost some fifteen evaluations a step each and of these runs are not asked for.
pub(super) fn unaudited(settings: &Settings) -> Settings {
    Settings { energy: false, slip_heat: false, ..settings.clone() }
}

/// The pure-rolling run of a prepared scenario that is integrated, and its demand.
pub(super) fn roll(
    prepared: &Prepared,
    settings: &Settings,
    fineness: Fineness,
    samples: usize,
    per_period: f64,
    near: Option<f64>,
) -> (Run, RollingDemand) {
    let mut s = run_settings(prepared, settings, fineness, samples, per_period);
    let (mut state, mut place) = (prepared.state, prepared.mode.place);
    let mut before = 0;
    let mut model = std::borrow::Cow::Borrowed(&prepared.model);
    let mut never_engages = false;
    let mut left_out_s = 0.0;
    if prepared.overrun.is_some() {
        let free = run(&prepared.model, prepared.state, prepared.mode, &s);
        before = free.counters.rhs_evaluations;
        left_out_s = stand_by_left_out_s(&prepared.model, &free.jumps);
        never_engages = free.stop == Stop::Finished && free.engaged.is_none();
        if let Some(start) = free.engaged {
            (state, place) = (start.state, start.place);
            s.duration_s -= start.t_s;
            model.to_mut().drive = prepared.model.drive.from(start.t_s).after(&free);
        }
    }
    let r: Rolling = match fineness.quick {
        Some(tolerance) => rolling_quickly(&model, state, place, &s, tolerance),
        None => rolling(&model, state, place, &s),
    };
    let mut demand = of_peaks(prepared, &r);
    demand.never_engages = never_engages;
    demand.finished &= !never_engages;
    demand.rhs_evaluations += before;
    if !demand.finished {
        (demand.required_friction, demand.slip_margin) = (None, None);
    } else if r.required_friction.is_none() {
        bisect(&mut demand, prepared, settings, fineness, near, left_out_s);
    }
    (r.run, demand)
}

/// Friction of a `demand` whose rolling run says nothing of it.
fn bisect(
    demand: &mut RollingDemand,
    prepared: &Prepared,
    settings: &Settings,
    fineness: Fineness,
    near: Option<f64>,
    left_out_s: f64,
) {
    let found = bisected(prepared, settings, fineness, near, left_out_s);
    demand.by_bisection = true;
    demand.required_friction = found.required;
    demand.slip_margin = slip_margin(&prepared.model, found.required);
    demand.rhs_evaluations += found.rhs_evaluations;
    demand.interrupted |= found.interrupted;
}

/// What a scene that begins in overrun need not stand by where friction is bisected, s: from when its swings repeat, by `jumps`, until
/// what acts changes. Under another friction they may swing on as they began, so that each trial would be run from end to end. The
/// torque then finds another phase and amplitude of the swing, which no error tells of: what is left out is said.
pub(crate) fn stand_by_left_out_s(model: &Model, jumps: &[Jump]) -> f64 {
    let of_start = |jump: &Jump| {
        let until_s = model.still_until_s(model.drive.past_break_s(0.0))?;
        (jump.from_s < until_s).then_some(until_s - jump.from_s)
    };
    jumps.first().and_then(of_start).unwrap_or(0.0)
}
