//! Run a scenario and say what happened.

use super::answer::{GaveUp, Simulation, Verdict};
use super::demand::{Fineness, RollingDemand, STEPS_PER_PERIOD, demand_at, roll, run_settings};
use super::equilibrium::steady;
use super::error::Scales;
use super::figures::ErrorEstimate;
use super::prepare::{NoScenario, Prepared, prepare};
use super::verdict::Went;
use crate::clutch::Scenario;
use crate::dynamics::{Grip, History, Place, Run, SlipRecord, Stop, Train, run};
use crate::follow::Follow;

/// Tolerances that make sense, of a run and of a step: below, rounding rules; above, estimates mean little and changes of mode are missed.
pub const TOLERANCES: [f64; 2] = [1e-13, 1e-3];

/// Settings of a simulation.
#[derive(Debug, Clone)]
pub struct Settings {
    /// What the error of every figure of a simulation must stay below: angles in rad, slip as rad at the inner
    /// race, times by the duration, forces by the largest of the run, |T|/N, margins and pressure (by the largest)
    /// as pure numbers. Default 1e-6. Steps are tightened until two runs agree to it. [`demand`](super::demand()) alone runs once,
    /// at steps of a tenth of it.
    pub tolerance: f64,
    /// Longest step, s; `None`: a quarter of the excitation's period (a fourteenth where only the demand is asked for),
    /// or 1/200 of the duration without one.
    pub longest_step_s: Option<f64>,
    /// Samples of the history, 0 for none.
    pub samples: usize,
    /// Mode changes before a run ends with a name; `None`: half as many as steps.
    pub most_events: Option<u64>,
    /// Steps, rejected ones included, before a run ends with a name; `None`: 200 000 (some 3 s of work), more where the
    /// scene is longer than 4 s or has more than 400 periods ([`Settings::limits`]).
    pub most_steps: Option<u64>,
    /// Whether every period of a long scene is integrated. Default no: a scene of more than 400 periods of its excitation
    /// jumps whole periods once they repeat, and so does an overrun in which a sprag swings more often than that and nothing that
    /// acts changes.
    pub every_period: bool,
    /// Whether the energy balance of the run is made up. Default no.
    pub energy: bool,
    /// Whether work, heat and wear of slip are made up. Default no.
    pub slip_heat: bool,
    /// What the samples are of. Default: equidistant ones from start to end.
    pub history: History,
    /// Ends the runs at their next step, and is told how far they are. Of no weight for the answer of a run that comes to its
    /// end. Default: never stops.
    pub follow: Follow,
}

/// Periods up to which every one of a scene is integrated: a choice; some tenth of a second of work.
const LONG: f64 = 400.0;
/// Steps that a run may take at least.
const LEAST_STEPS: f64 = 200_000.0;
/// Steps that it may take for a second of the scene: twice what a sprag takes that trembles in overrun all the time.
const STEPS_PER_S: f64 = 50_000.0;
/// Steps that it may take for a period of the excitation.
const STEPS_OF_A_PERIOD: f64 = 500.0;
/// Steps that it may take at most where nobody asks for more: some two minutes.
const MOST_STEPS: f64 = 1e7;

impl Default for Settings {
    fn default() -> Self {
        Self {
            tolerance: 1e-6,
            longest_step_s: None,
            samples: 0,
            most_events: None,
            most_steps: None,
            every_period: false,
            energy: false,
            slip_heat: false,
            history: History::default(),
            follow: Follow::nobody(),
        }
    }
}

impl Settings {
    /// Period whose repetition a run of `prepared` may jump, s.
    pub(super) fn jump_period_s(&self, prepared: &Prepared) -> Option<f64> {
        let drive = &prepared.model.drive;
        let alone =
            drive.train.as_ref().is_none_or(Train::acts_alike) && drive.next_break_s(0.0) == f64::INFINITY;
        let long = |period_s: &f64| prepared.duration_s > LONG * period_s;
        prepared.period_s.filter(long).filter(|_| alone && !self.every_period)
    }

    /// How many steps and how many mode changes a run of `prepared` may take.
    pub fn limits(&self, prepared: &Prepared) -> [u64; 2] {
        let duration_s = prepared.duration_s;
        let periods = prepared.period_s.map_or(0.0, |period_s| duration_s / period_s);
        let steps =
            LEAST_STEPS.max(STEPS_PER_S * duration_s).max(STEPS_OF_A_PERIOD * periods).min(MOST_STEPS) as u64;
        [self.most_steps.unwrap_or(steps), self.most_events.unwrap_or(steps / 2)]
    }
}

/// Loosest and tightest relative tolerance of a step.
const STEP_TOLERANCES: [f64; 2] = [1e-3, 1e-13];
/// What of the difference between two runs is left in the next, at least: their steps differ tenfold in tolerance, yet where
/// contacts bounce errors fall by fits and starts.
const LEFT: f64 = 0.3;
/// What of it is left in those after that.
const FALLS: f64 = 0.1;
/// Of the explicit steps: the longest step shrinks with the tolerance as if it were all that limits the error, or two runs
/// of steps that nothing else limits would agree, and be wrong together.
const ORDER: f64 = 8.0;

/// How much of the equations a scene is run with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Terms {
    /// Everything.
    All,
    /// What it can feel.
    Felt,
}

/// Simulate `scenario` with the event-driven scheme. Three runs, whose steps differ tenfold in tolerance, the longest by
/// its eighth root: the finest is the answer, its difference to the one before the error estimate, at least three tenths of
/// the difference before that. Where that exceeds the tolerance asked for, a finer run follows, until they agree, a run meets
/// its limit of work, or steps reach rounding.
///
/// # Errors
/// [`NoScenario`] where the scenario has no start; whatever happens afterwards is a result.
pub fn simulate(scenario: &Scenario, settings: &Settings) -> Result<Simulation, NoScenario> {
    Ok(simulate_prepared(&prepare(scenario)?, settings, Terms::All))
}

/// As [`simulate`], from a prepared scenario. Each of the runs has a pure-rolling run beside it, for the demand, and runs that
/// bisect that where rolling unloads the contact. With [`Terms::Felt`], where the pure-rolling run never asks for as much friction
/// as there is, it is the run itself.
pub fn simulate_prepared(prepared: &Prepared, settings: &Settings, terms: Terms) -> Simulation {
    if prepared.duration_s == 0.0 {
        return steady(prepared, settings);
    }
    let coarsest = (100.0 * settings.tolerance).clamp(1000.0 * STEP_TOLERANCES[1], STEP_TOLERANCES[0]);
    let go = |tolerance: f64, samples: usize, before: Option<&Try>, answered: bool| {
        let fineness = Fineness { tolerance, longest: (tolerance / coarsest).powf(1.0 / ORDER), quick: None };
        settings.follow.begin_pass(before.is_none(), tolerance);
        // The coarsest run is never the answer: its energy is not asked for.
        let settings = &Settings { energy: settings.energy && before.is_some(), ..settings.clone() };
        attempt(prepared, settings, fineness, samples, terms, before.and_then(Try::bisected), answered)
    };
    let mut tolerance = coarsest;
    // What is known of a long scene where it is interrupted.
    let early = if settings.history.marks { settings.samples } else { 0 };
    let mut coarse = go(tolerance, early, None, false);
    let (mut work, mut spread) = ([0; 3], [f64::INFINITY, f64::NEG_INFINITY]);
    let (mut before, mut doubts) = (None, [0.0; 2]);
    let (mut told, mut contradicted) = (None, false);
    let mut finished: Option<Simulation> = None;
    loop {
        tolerance *= 0.1;
        let fine = if coarse.interrupted() {
            coarse.clone()
        } else {
            go(tolerance, settings.samples, Some(&coarse), finished.is_some())
        };
        for theta in [&coarse.run, &fine.run].into_iter().filter(|r| !r.stop.gave_up()).map(|r| r.state[2]) {
            spread = [spread[0].min(theta), spread[1].max(theta)];
        }
        let s = conclude(prepared, settings, &fine, &coarse, before, doubts);
        // Runs that do not converge may agree by chance in the end.
        let definite = verdict(prepared, &fine.run, &s.error.unwrap_or_default());
        let definite = definite.filter(|v| *v != Verdict::AtThreshold);
        contradicted |= told.zip(definite).is_some_and(|(a, b)| a != b);
        told = definite.or(told);
        let gave_up = fine.run.stop.gave_up();
        let interrupted = s.stop == Stop::Interrupted;
        let last = gave_up || tolerance < 9.0 * STEP_TOLERANCES[1] || interrupted;
        if last || s.tolerance_reached && before.is_some() {
            let [steps, rejections, rhs_evaluations] = sum([s.steps, s.rejections, s.rhs_evaluations], work);
            // Runs that came to the end say more than a finer one that did not.
            let s = match finished {
                Some(earlier) if gave_up || interrupted => Simulation {
                    finer_gave_up: Some(s.stop),
                    gave_up: s.gave_up,
                    tolerance_reached: false,
                    ..earlier
                },
                _ => s,
            };
            let doubtful = contradicted && !s.tolerance_reached;
            let verdict = s.verdict.map(|v| if doubtful { Verdict::AtThreshold } else { v });
            let spread_rad = if spread[0] <= spread[1] { spread } else { s.spread_rad };
            return Simulation { verdict, steps, rejections, rhs_evaluations, spread_rad, ..s };
        }
        work = sum(work, coarse.work());
        doubts = [doubts[1], s.error.map_or(0.0, |e| e.net_slip_m)];
        let difference = s.off(&answer(prepared, settings, &coarse));
        before = s.error.map(|_| before.map_or(difference, |b| difference.at_least(FALLS, &b)));
        finished = Some(s).filter(|s| s.error.is_some());
        coarse = fine;
    }
}

/// One run with the demand of pure rolling beside it, at one tolerance.
#[derive(Clone)]
pub(super) struct Try {
    pub(super) run: Run,
    /// `None`: nothing is to stick, or interrupted.
    demand: Option<RollingDemand>,
    /// Whether the run is the pure-rolling run.
    rolled: bool,
}

impl Try {
    /// `answered`: coarser runs have come to the end, a run that does not is no answer and needs no demand.
    pub(super) fn new(
        prepared: &Prepared,
        run: Run,
        answered: bool,
        demand: impl FnOnce() -> RollingDemand,
    ) -> Self {
        // What overruns to the end is not to stick: there is no demand.
        let holds = prepared.overrun.is_none() || run.engaged.is_some();
        let in_vain = run.stop == Stop::Interrupted || answered && run.stop.gave_up();
        let demand = (holds && !in_vain).then(demand);
        Self { run, demand, rolled: false }
    }

    /// mu_req where it was bisected.
    fn bisected(&self) -> Option<f64> {
        self.demand.filter(|d| d.by_bisection)?.required_friction
    }

    pub(super) fn interrupted(&self) -> bool {
        self.run.stop == Stop::Interrupted || self.demand.is_some_and(|d| d.interrupted)
    }

    /// Steps and steps refused, right-hand sides, those of the demand too.
    fn work(&self) -> [u64; 3] {
        let c = &self.run.counters;
        let own = if self.rolled { 0 } else { c.rhs_evaluations };
        [c.steps, c.rejections, own + self.demand.map_or(0, |d| d.rhs_evaluations)]
    }
}

fn sum(a: [u64; 3], b: [u64; 3]) -> [u64; 3] {
    std::array::from_fn(|i| a[i] + b[i])
}

/// How many tolerances static friction must exceed what rolling needs before the friction law is left out.
const RESERVE: f64 = 10.0;

fn attempt(
    prepared: &Prepared,
    settings: &Settings,
    fineness: Fineness,
    samples: usize,
    terms: Terms,
    near: Option<f64>,
    answered: bool,
) -> Try {
    let mode = prepared.mode;
    let stuck = mode.inner == Grip::Stick && mode.outer == Grip::Stick && mode.place != Place::Open;
    let go = || {
        let s = run_settings(prepared, settings, fineness, samples, STEPS_PER_PERIOD);
        run(&prepared.model, prepared.state, mode, &s)
    };
    if !(terms == Terms::Felt && stuck && prepared.overrun.is_none()) {
        return Try::new(prepared, go(), answered, || demand_at(prepared, settings, fineness, near));
    }
    let (rolling, demand) = roll(prepared, settings, fineness, samples, STEPS_PER_PERIOD, near);
    let suffices = demand.finished
        && !demand.by_bisection
        && demand.slip_margin.is_some_and(|m| m > RESERVE * settings.tolerance);
    if suffices || demand.interrupted {
        return Try { run: rolling, demand: Some(demand), rolled: true };
    }
    Try::new(prepared, go(), answered, || demand)
}

/// The answer `fine`, its error by `other` and, where there was one, by the difference `before`; the verdict of both. Where
/// they do not agree to the tolerance two may lie near one another by chance: the verdict then is at least as doubtful as
/// the errors of net slip before them, `doubts` (m). Runs that gave up have ended at different times: that is no error, yet
/// a contact that was lost for long before is a verdict. What the energy balance leaves over was seen by no run.
pub(super) fn conclude(
    prepared: &Prepared,
    settings: &Settings,
    fine: &Try,
    other: &Try,
    before: Option<ErrorEstimate>,
    doubts: [f64; 2],
) -> Simulation {
    let whole = !fine.interrupted() && !other.interrupted();
    let gave_up = fine.run.stop.gave_up() || other.run.stop.gave_up();
    let (run, own) = (&fine.run, answer(prepared, settings, fine));
    let difference = || own.off(&answer(prepared, settings, other));
    let error =
        (whole && !gave_up).then(|| before.map_or_else(difference, |b| difference().at_least(LEFT, &b)));
    let balanced = run
        .energy
        .is_none_or(|e| e.residual_j().abs() <= settings.tolerance * e.through_j + rounding_j(prepared, run));
    let tolerance_reached = balanced && error.is_some_and(|e| own.scales.worst(&e) <= settings.tolerance);
    let agreed = || {
        let mut error = error.unwrap_or_default();
        if !tolerance_reached {
            error.net_slip_m = doubts.into_iter().fold(error.net_slip_m, f64::max);
        }
        let (a, b) = (verdict(prepared, run, &error)?, verdict(prepared, &other.run, &error)?);
        Some(if a == b { a } else { Verdict::AtThreshold })
    };
    let [steps, rejections, rhs_evaluations] = sum(fine.work(), if whole { other.work() } else { [0; 3] });
    Simulation {
        verdict: if whole { agreed() } else { None },
        stop: if whole { own.stop } else { Stop::Interrupted },
        demand: own.demand.filter(|_| whole),
        steps,
        rejections,
        rhs_evaluations,
        error,
        tolerance_reached,
        ..own
    }
}

/// What rounding may leave over of an energy balance, J: of what moves and is stored at the end.
fn rounding_j(prepared: &Prepared, run: &Run) -> f64 {
    const ROUNDING: f64 = 1e-13;
    let (model, y) = (&prepared.model, &run.state);
    let p = model.point(run.mode.place, y[0]);
    let there = model.energy_without_wedge(&p, &model.rates(&run.mode, &p, y), y).abs();
    ROUNDING * (there + model.wedge_energy_j(model.curve.first_contact_rad(), y[0]).abs())
}

/// What one run says, without an error or a verdict.
fn answer(prepared: &Prepared, settings: &Settings, of: &Try) -> Simulation {
    let (run, p) = (&of.run, of.run.peaks);
    let [steps, rejections, rhs_evaluations] = of.work();
    let [inner, outer] = slips(run);
    let gave_up = (run.stop.gave_up() || run.stop == Stop::Interrupted).then(|| {
        let [most_steps, most_events] = settings.limits(prepared);
        let taken = run.counters.steps + run.counters.rejections;
        let limit = match run.stop {
            Stop::StepLimit if taken >= most_steps => Some(most_steps),
            Stop::EventLimit => Some(most_events),
            _ => None,
        };
        GaveUp { stop: run.stop, t_s: run.t_s, limit }
    });
    Simulation {
        verdict: None,
        stop: run.stop,
        t_s: run.t_s,
        theta_inner_rad: run.state[2],
        theta_outer_rad: run.state[3],
        offset_rad: offset(prepared, run),
        inner,
        outer,
        carried_m: run.carried_m,
        contact_lost_s: run.open_s,
        peaks: p,
        hertz_peak_pa: hertz_peak(prepared, p.normal_max_n, p.normal_outer_max_n),
        hertz_static_pa: hertz_at(prepared, prepared.static_normal_n),
        hertz_least_pa: hertz_at(prepared, p.normal_min_n),
        static_normal_n: prepared.static_normal_n,
        demand: of.demand,
        rolled: of.rolled,
        events: run.events,
        steps,
        rejections,
        rhs_evaluations,
        error: None,
        equilibrium_error: None,
        scales: Scales::of(prepared, &p),
        tolerance_reached: false,
        finer_gave_up: None,
        gave_up,
        spread_rad: [run.state[2]; 2],
        zeno_closures: run.zeno_closures,
        inconsistent_choices: run.inconsistent_choices,
        fast_motion: run.fast_motion,
        energy: run.energy,
        slip_heat: run.slip_heat,
        wear_m2_per_n: prepared.model.wear_m2_per_n,
        samples: run.samples.clone(),
        neglected: run.neglected,
        engaged: run.engaged,
        first_hold: run.first_hold(),
        modes: run.modes.clone(),
        jumps: run.jumps.clone(),
        train: run.train.clone(),
        overrun: prepared.overrun,
    }
}

pub(super) fn offset(prepared: &Prepared, run: &Run) -> f64 {
    let phase = |y: &crate::dynamics::State| y[2] - y[3] + prepared.model.curve.windup_rad(y[0]);
    phase(&run.state) - phase(&run.engaged.map_or(prepared.state, |e| e.state))
}

/// Slip at A and B since the clutch engaged.
pub(super) fn slips(run: &Run) -> [SlipRecord; 2] {
    let zero = SlipRecord::default();
    let (inner, outer) = run.engaged.map_or((zero, zero), |e| (e.inner, e.outer));
    [run.inner.since(&inner), run.outer.since(&outer)]
}

pub(super) fn hertz_peak(prepared: &Prepared, n_bi: f64, n_be: f64) -> f64 {
    let elastic = &prepared.model.curve.statics().elastic;
    let inner = prepared.model.curve.hertz_inner_pa(n_bi);
    inner.max(elastic.outer_contact.peak_pressure_pa(n_be.max(0.0)))
}

/// p_0 at A at static equilibrium with `n_bi`, Pa; 0 without load.
pub(super) fn hertz_at(prepared: &Prepared, n_bi: f64) -> f64 {
    prepared.model.curve.hertz_inner_pa(n_bi)
}

/// The verdict of one run; `None` where it ended before that could be told.
pub(super) fn verdict(prepared: &Prepared, run: &Run, error: &ErrorEstimate) -> Option<Verdict> {
    let went = Went {
        stop: run.stop,
        longest_open_s: run.longest_open_s,
        carried: run.mode.place == Place::Carried,
        end_n: prepared.model.point(run.mode.place, run.state[0]).n_bi,
        net_m: slips(run)[0].net_m + run.carried_m,
    };
    went.verdict(error.net_slip_m)
}
