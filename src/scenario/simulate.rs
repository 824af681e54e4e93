//! Run a scenario and say what happened.

use std::sync::atomic::AtomicBool;

use super::demand::{Demand, demand, roll};
use super::prepare::{NoScenario, Prepared, prepare};
use crate::design::Scenario;
use crate::dynamics::{
    Engaged, Grip, Mode, Overrun, Peaks, Place, PublishedSettings, Run, RunSettings, Sample, SlipRecord,
    Stop, published, run,
};

/// Settings of a simulation.
#[derive(Debug, Clone, Copy)]
pub struct Settings {
    /// Relative tolerance of a step. Default 1e-8: errors of the angles stay below 1e-8 rad in the paper's scenes.
    pub tolerance: f64,
    /// Longest step, s; `None`: a twentieth of the excitation's period, or 1/200 of the duration without one.
    pub longest_step_s: Option<f64>,
    /// Samples of the history, 0 for none.
    pub samples: usize,
    /// Mode changes before the run ends with a name.
    pub most_events: u64,
    /// Steps before the run ends with a name.
    pub most_steps: u64,
    /// Set from outside to end the runs at the next step.
    pub interrupt: Option<&'static AtomicBool>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            tolerance: 1e-8,
            longest_step_s: None,
            samples: 0,
            most_events: 200_000,
            most_steps: 5_000_000,
            interrupt: None,
        }
    }
}

/// What the clutch did.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// No net slip beyond 1 um at the inner contact.
    Sticks,
    /// Net slip towards overrunning.
    SlipsOverrunning,
    /// Net slip towards engaging.
    SlipsEngaging,
    /// Contact open at the end, or for more than 1 ms at a stretch, or the run left the curve.
    Disengages,
    /// Closer to another verdict than the error estimate.
    AtThreshold,
}

impl Verdict {
    /// Name in reports and JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sticks => "sticks",
            Self::SlipsOverrunning => "slips-overrunning",
            Self::SlipsEngaging => "slips-engaging",
            Self::Disengages => "disengages",
            Self::AtThreshold => "at-threshold",
        }
    }
}

/// Differences between the two runs of a simulation.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ErrorEstimate {
    /// theta_bi at the end, rad.
    pub theta_inner_rad: f64,
    /// theta_be at the end, rad.
    pub theta_outer_rad: f64,
    /// Offset, rad.
    pub offset_rad: f64,
    /// Net slip at A, m.
    pub net_slip_m: f64,
    /// Smallest N_bi, N.
    pub normal_min_n: f64,
    /// Slip margin.
    pub slip_margin: f64,
}

/// Result of a simulation.
#[derive(Debug, Clone)]
pub struct Simulation {
    /// Verdict; `None` where the run was interrupted or gave up before one was reached.
    pub verdict: Option<Verdict>,
    /// Why the run ended.
    pub stop: Stop,
    /// Time reached, s.
    pub t_s: f64,
    /// theta_bi at the end, rad.
    pub theta_inner_rad: f64,
    /// theta_be at the end, rad.
    pub theta_outer_rad: f64,
    /// Change of (theta_bi - theta_be) + W(alpha) over the run, rad; + towards overrunning. In an engagement since
    /// A ceased to overrun, as all slip.
    pub offset_rad: f64,
    /// Slip at A.
    pub inner: SlipRecord,
    /// Slip at B.
    pub outer: SlipRecord,
    /// Time without contact, s.
    pub contact_lost_s: f64,
    /// Extremes.
    pub peaks: Peaks,
    /// Largest Hertz pressure, Pa.
    pub hertz_peak_pa: f64,
    /// Hertz pressure of the static load that the scene is about (preload, reversing or largest torque), Pa.
    pub hertz_static_pa: f64,
    /// Hertz pressure at A at the smallest N_bi, Pa.
    pub hertz_least_pa: f64,
    /// N_bi at the start, N.
    pub static_normal_n: f64,
    /// Rolling demand; `None` where the run was interrupted, and in overrun, where nothing is to stick.
    pub demand: Option<Demand>,
    /// Whether the friction law was left out: the pure-rolling run is the run.
    pub rolled: bool,
    /// Mode changes.
    pub events: u64,
    /// Steps of both runs.
    pub steps: u64,
    /// Right-hand sides of all runs.
    pub rhs_evaluations: u64,
    /// Error estimate; `None` for static kinds, which are exact to 1e-12, and where the run was interrupted.
    pub error: Option<ErrorEstimate>,
    /// History.
    pub samples: Vec<Sample>,
    /// When A first carried load without overrunning; `None`: never, or an equilibrium.
    pub engaged: Option<Engaged>,
    /// Modes with the times at which they began, s; empty without samples.
    pub modes: Vec<(f64, Mode)>,
    /// Steady overrun: the whole of that scenario, the start of an engagement.
    pub overrun: Option<Overrun>,
}

pub(super) fn run_settings(
    prepared: &Prepared,
    settings: &Settings,
    tolerance: f64,
    samples: usize,
) -> RunSettings {
    // Short enough for four looks per step to see every half wave of excitation.
    let chosen = || prepared.period_s.map_or(prepared.duration_s / 200.0, |p| p / 20.0);
    let longest_step_s = settings.longest_step_s.unwrap_or_else(chosen);
    RunSettings {
        tolerance,
        duration_s: prepared.duration_s,
        longest_step_s,
        most_events: settings.most_events,
        most_steps: settings.most_steps,
        samples,
        rolling: false,
        interrupt: settings.interrupt,
    }
}

/// Simulate `scenario` with the event-driven scheme, at a tenth of the tolerance and at the tolerance; the finer
/// run is the answer and the difference its error estimate.
///
/// # Errors
/// [`NoScenario`] where the scenario has no start; whatever happens afterwards is a result.
pub fn simulate(scenario: &Scenario, settings: &Settings) -> Result<Simulation, NoScenario> {
    Ok(simulate_prepared(&prepare(scenario)?, settings, false))
}

/// As [`simulate`], from a prepared scenario. `reduced`: where the pure-rolling run never asks for as much friction
/// as there is, it is the run, and the scene is not integrated twice.
pub fn simulate_prepared(prepared: &Prepared, settings: &Settings, reduced: bool) -> Simulation {
    if prepared.duration_s == 0.0 {
        return steady(prepared, settings);
    }
    let fine = attempt(prepared, settings, 0.1 * settings.tolerance, settings.samples, reduced);
    let other = (!fine.interrupted()).then(|| attempt(prepared, settings, settings.tolerance, 0, reduced));
    conclude(prepared, fine, other)
}

/// One run with the demand of pure rolling beside it.
struct Try {
    run: Run,
    /// `None`: nothing is to stick, or interrupted.
    demand: Option<Demand>,
    /// Whether the run is the pure-rolling run.
    rolled: bool,
}

impl Try {
    fn new(prepared: &Prepared, run: Run, demand: impl FnOnce() -> Demand) -> Self {
        // What overruns to the end is not to stick: there is no demand.
        let holds = prepared.overrun.is_none() || run.engaged.is_some();
        let demand = (holds && run.stop != Stop::Interrupted).then(demand);
        Self { run, demand, rolled: false }
    }

    fn interrupted(&self) -> bool {
        self.run.stop == Stop::Interrupted || self.demand.is_some_and(|d| d.interrupted)
    }

    fn rhs_evaluations(&self) -> u64 {
        let own = if self.rolled { 0 } else { self.run.counters.rhs_evaluations };
        own + self.demand.map_or(0, |d| d.rhs_evaluations)
    }
}

/// How far static friction must exceed what rolling needs before the friction law is left out.
const RESERVE: f64 = 1e-6;

fn attempt(prepared: &Prepared, settings: &Settings, tolerance: f64, samples: usize, reduced: bool) -> Try {
    let mode = prepared.mode;
    let stuck = mode.inner == Grip::Stick && mode.outer == Grip::Stick && mode.place != Place::Open;
    let s = Settings { tolerance, samples, ..*settings };
    let go = || run(&prepared.model, prepared.state, mode, &run_settings(prepared, &s, tolerance, samples));
    if !(reduced && stuck && prepared.overrun.is_none()) {
        return Try::new(prepared, go(), || demand(prepared, &s));
    }
    let (rolling, demand) = roll(prepared, &s);
    let suffices = demand.finished && !demand.by_bisection && demand.slip_margin > RESERVE;
    if suffices || demand.interrupted {
        return Try { run: rolling, demand: Some(demand), rolled: true };
    }
    Try::new(prepared, go(), || demand)
}

/// Simulate `scenario` with the paper's own scheme, kept as a reference: at `step_s` and at half of it; the
/// first is the answer, the difference its error estimate, which is large because the scheme does not converge.
/// `go_on` is asked now and then with the steps taken so far, of [`published_steps`]; false interrupts.
///
/// # Errors
/// As [`simulate`].
pub fn simulate_published(
    scenario: &Scenario,
    settings: &Settings,
    step_s: f64,
    band_m_s: f64,
    go_on: &mut dyn FnMut(u64) -> bool,
) -> Result<Simulation, NoScenario> {
    let prepared = prepare(scenario)?;
    if prepared.duration_s == 0.0 {
        return Ok(steady(&prepared, settings));
    }
    let duration_s = prepared.duration_s;
    let mut go = |step_s: f64, samples: usize, before: u64, tolerance: f64| {
        let s = PublishedSettings { duration_s, step_s, band_m_s, samples };
        let run = published(&prepared.model, prepared.state, &s, &mut |steps| go_on(before + steps));
        Try::new(&prepared, run, || demand(&prepared, &Settings { tolerance, ..*settings }))
    };
    let answer = go(step_s, settings.samples, 0, 0.1 * settings.tolerance);
    let before = answer.run.counters.steps;
    let other = (!answer.interrupted()).then(|| go(0.5 * step_s, 0, before, settings.tolerance));
    Ok(conclude(&prepared, answer, other))
}

/// Steps of both runs of [`simulate_published`] over `duration_s`.
pub fn published_steps(duration_s: f64, step_s: f64) -> u64 {
    let steps = |step_s| PublishedSettings { duration_s, step_s, band_m_s: 0.0, samples: 0 }.steps();
    steps(step_s) + steps(0.5 * step_s)
}

/// The answer `fine`, its error by `other` (absent: interrupted), the verdict.
fn conclude(prepared: &Prepared, fine: Try, other: Option<Try>) -> Simulation {
    let finished = other.filter(|o| !o.interrupted());
    let fine_offset = offset(prepared, &fine.run);
    let error = finished.as_ref().map(|o| ErrorEstimate {
        theta_inner_rad: (fine.run.state[2] - o.run.state[2]).abs(),
        theta_outer_rad: (fine.run.state[3] - o.run.state[3]).abs(),
        offset_rad: (fine_offset - offset(prepared, &o.run)).abs(),
        net_slip_m: (slips(&fine.run)[0].net_m - slips(&o.run)[0].net_m).abs(),
        normal_min_n: (fine.run.peaks.normal_min_n - o.run.peaks.normal_min_n).abs(),
        slip_margin: fine.demand.zip(o.demand).map_or(0.0, |(f, c)| (f.slip_margin - c.slip_margin).abs()),
    });
    let agreed = error.zip(finished.as_ref()).and_then(|(error, other)| {
        let (a, b) = (verdict(&fine.run, &error)?, verdict(&other.run, &error)?);
        Some(if a == b { a } else { Verdict::AtThreshold })
    });
    let rhs_evaluations = fine.rhs_evaluations() + finished.as_ref().map_or(0, Try::rhs_evaluations);
    let steps = fine.run.counters.steps + finished.as_ref().map_or(0, |o| o.run.counters.steps);
    let demand = fine.demand.filter(|_| finished.is_some());
    let (rolled, fine) = (fine.rolled, fine.run);
    Simulation {
        verdict: agreed,
        // No estimate means that one of the runs was interrupted.
        stop: if error.is_none() { Stop::Interrupted } else { fine.stop },
        t_s: fine.t_s,
        theta_inner_rad: fine.state[2],
        theta_outer_rad: fine.state[3],
        offset_rad: fine_offset,
        inner: slips(&fine)[0],
        outer: slips(&fine)[1],
        contact_lost_s: fine.open_s,
        peaks: fine.peaks,
        hertz_peak_pa: hertz_peak(prepared, fine.peaks.normal_max_n, fine.peaks.normal_outer_max_n),
        hertz_static_pa: hertz_at(prepared, prepared.static_normal_n),
        hertz_least_pa: hertz_at(prepared, fine.peaks.normal_min_n),
        static_normal_n: prepared.static_normal_n,
        demand,
        rolled,
        events: fine.events,
        steps,
        rhs_evaluations,
        error,
        samples: fine.samples,
        engaged: fine.engaged,
        modes: fine.modes,
        overrun: prepared.overrun,
    }
}

fn offset(prepared: &Prepared, run: &Run) -> f64 {
    let phase = |y: &crate::dynamics::State| y[2] - y[3] + prepared.model.curve.windup_rad(y[0]);
    phase(&run.state) - phase(&run.engaged.map_or(prepared.state, |e| e.state))
}

/// Slip at A and B since the clutch engaged.
fn slips(run: &Run) -> [SlipRecord; 2] {
    let zero = SlipRecord::default();
    let (inner, outer) = run.engaged.map_or((zero, zero), |e| (e.inner, e.outer));
    [run.inner.since(&inner), run.outer.since(&outer)]
}

fn hertz_peak(prepared: &Prepared, n_bi: f64, n_be: f64) -> f64 {
    let elastic = &prepared.model.curve.statics().elastic;
    let inner = prepared.model.curve.at_normal(n_bi).map_or(0.0, |p| p.hertz_inner_pa);
    inner.max(elastic.outer_contact.peak_pressure_pa(n_be.max(0.0)))
}

/// p_0 at A at static equilibrium with `n_bi`, Pa; 0 without load.
fn hertz_at(prepared: &Prepared, n_bi: f64) -> f64 {
    let row = (n_bi > 0.0).then(|| prepared.model.curve.at_normal(n_bi)).flatten();
    row.map_or(0.0, |p| p.hertz_inner_pa)
}

/// Net slip beyond which a scene counts as slipped, m (INTERFACE: 1 um).
const SLIPPED_M: f64 = 1e-6;
/// Stretch without contact beyond which a scene counts as disengaged, s (INTERFACE: 1 ms).
const LOST_S: f64 = 1e-3;

/// `None` where the run ended before it could be told.
pub(super) fn verdict(run: &Run, error: &ErrorEstimate) -> Option<Verdict> {
    let left = matches!(run.stop, Stop::CurveEnd | Stop::FellAway);
    if left || run.longest_open_s > LOST_S {
        return Some(Verdict::Disengages);
    }
    if run.stop != Stop::Finished {
        return None;
    }
    let net = slips(run)[0].net_m;
    Some(if run.mode.place == Place::Open {
        Verdict::Disengages
    } else if (net.abs() - SLIPPED_M).abs() <= error.net_slip_m {
        Verdict::AtThreshold
    } else if net > SLIPPED_M {
        Verdict::SlipsOverrunning
    } else if net < -SLIPPED_M {
        Verdict::SlipsEngaging
    } else {
        Verdict::Sticks
    })
}

/// Static and overrunning scenarios: equilibrium, no integration.
fn steady(prepared: &Prepared, settings: &Settings) -> Simulation {
    let demand = prepared.overrun.is_none().then(|| demand(prepared, settings));
    let row = prepared.model.curve.at_normal(prepared.static_normal_n);
    let (n_bi, n_be, tan_inner, tan_outer) = match (prepared.overrun, row) {
        (Some(o), _) => (o.normal_inner_n, o.normal_outer_n, o.tan_inner, o.tan_outer),
        (None, Some(r)) => (r.normal_inner_n, r.normal_outer_n, r.tan_omega, r.tan_nu),
        (None, None) => (0.0, 0.0, 0.0, 0.0),
    };
    let verdict = match prepared.overrun {
        Some(o) if o.normal_inner_n > 0.0 => Verdict::SlipsOverrunning,
        Some(_) => Verdict::Disengages,
        None if demand.is_some_and(|d| d.slip_margin > 0.0) => Verdict::Sticks,
        // A sprag whose demand exceeds mu_s is squeezed out backwards under torque.
        None => Verdict::SlipsEngaging,
    };
    Simulation {
        verdict: Some(verdict),
        stop: Stop::Finished,
        t_s: 0.0,
        theta_inner_rad: prepared.state[2],
        theta_outer_rad: prepared.state[3],
        offset_rad: 0.0,
        inner: SlipRecord::default(),
        outer: SlipRecord::default(),
        contact_lost_s: 0.0,
        peaks: Peaks {
            tan_inner,
            tan_outer,
            normal_min_n: n_bi,
            normal_max_n: n_bi,
            normal_outer_max_n: n_be,
            ..Peaks::NONE
        },
        hertz_peak_pa: hertz_peak(prepared, n_bi, n_be),
        hertz_static_pa: hertz_peak(prepared, n_bi, n_be),
        hertz_least_pa: hertz_at(prepared, n_bi),
        static_normal_n: n_bi,
        demand,
        rolled: false,
        events: 0,
        steps: 0,
        rhs_evaluations: 0,
        error: None,
        samples: Vec::new(),
        engaged: None,
        modes: Vec::new(),
        overrun: prepared.overrun,
    }
}

impl Simulation {
    /// How long A slips after an overrun has been reversed, s: from the instant at which v_A has fallen to 0 under
    /// load to the first stick (the paper: about 0.5 ms). `None` without an overrun, samples or a stick.
    pub fn initial_slip_s(&self) -> Option<f64> {
        self.overrun?;
        let from = self.engaged?.t_s;
        let sticks = |m: &Mode| matches!(m.place, Place::Arc(_)) && m.inner == Grip::Stick;
        let until = self.modes.iter().find(|(t, m)| *t >= from && sticks(m))?.0;
        Some(until - from)
    }
}
