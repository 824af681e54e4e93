//! Run a scenario and say what happened.

use super::prepare::{NoScenario, Prepared, prepare};
use crate::design::Scenario;
use crate::dynamics::{
    Peaks, Place, PublishedRun, Rolling, Run, RunSettings, Sample, SlipRecord, Stop, published, rolling, run,
};

/// Integration method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// Event-driven, the default.
    Event,
    /// The paper's RK4 with a narrow band.
    Published {
        /// Time step, s.
        step_s: f64,
        /// Half width D_V of the band of zero velocity, m/s.
        band_m_s: f64,
    },
}

/// Settings of a simulation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Relative tolerance of a step. Default 1e-8: errors of the angles stay below 1e-8 rad in the paper's scenes.
    pub tolerance: f64,
    /// Samples of the history, 0 for none.
    pub samples: usize,
    /// Mode changes before the run ends with a name.
    pub most_events: u64,
    /// Steps before the run ends with a name.
    pub most_steps: u64,
}

impl Default for Settings {
    fn default() -> Self {
        Self { tolerance: 1e-8, samples: 0, most_events: 200_000, most_steps: 5_000_000 }
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

/// What pure rolling would demand: the basis of slip margin and contact margin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Demand {
    /// mu_req; `None`: no friction suffices, contact would open.
    pub required_friction: Option<f64>,
    /// mu_s/mu_req - 1; -1 where no friction suffices.
    pub slip_margin: f64,
    /// N_min/N_static of the rolling run, below zero by the tension that rolling would need.
    pub contact_margin: f64,
    /// Largest N_bi and N_be of the rolling run, N.
    pub normal_max_n: [f64; 2],
    /// Whether the rolling run reached its end; if not, it left the profile or rolled over.
    pub finished: bool,
    /// Right-hand sides it took.
    pub rhs_evaluations: u64,
}

/// Differences between the run and one at a tenth of the tolerance.
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
    /// Verdict.
    pub verdict: Verdict,
    /// Why the run ended.
    pub stop: Stop,
    /// Time reached, s.
    pub t_s: f64,
    /// theta_bi at the end, rad.
    pub theta_inner_rad: f64,
    /// theta_be at the end, rad.
    pub theta_outer_rad: f64,
    /// Change of (theta_bi - theta_be) + W(alpha) over the run, rad; + towards overrunning.
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
    /// N_bi at the start, N.
    pub static_normal_n: f64,
    /// Rolling demand.
    pub demand: Demand,
    /// Mode changes.
    pub events: u64,
    /// Steps of both runs.
    pub steps: u64,
    /// Right-hand sides of all runs.
    pub rhs_evaluations: u64,
    /// Error estimate; `None` for static kinds, which are exact to 1e-12.
    pub error: Option<ErrorEstimate>,
    /// History.
    pub samples: Vec<Sample>,
    /// Steady drag torque, N m, for overrun.
    pub drag_torque_nm: Option<f64>,
}

fn run_settings(prepared: &Prepared, settings: &Settings, tolerance: f64, samples: usize) -> RunSettings {
    // Short enough for four looks per step to see every half wave of excitation.
    let longest_step_s = prepared.period_s.map_or(prepared.duration_s / 200.0, |p| p / 20.0);
    RunSettings {
        tolerance,
        duration_s: prepared.duration_s,
        longest_step_s,
        most_events: settings.most_events,
        most_steps: settings.most_steps,
        samples,
        rolling: false,
    }
}

/// Pure-rolling demand of a prepared scenario. Static kinds read it off the curve.
pub fn demand(prepared: &Prepared, settings: &Settings) -> Demand {
    let mu = prepared.model.friction.static_;
    if prepared.duration_s == 0.0 {
        let f = prepared.model.curve.at_normal(prepared.static_normal_n);
        let required = f.map(|f| f.tan_omega.max(f.tan_nu));
        return Demand {
            required_friction: required,
            slip_margin: required.map_or(-1.0, |r| mu / r - 1.0),
            contact_margin: 1.0,
            normal_max_n: f.map_or([0.0; 2], |f| [f.normal_inner_n, f.normal_outer_n]),
            finished: true,
            rhs_evaluations: 0,
        };
    }
    let s = run_settings(prepared, settings, settings.tolerance, 0);
    let r: Rolling = rolling(&prepared.model, prepared.state, prepared.mode.place, &s);
    let finished = r.stop == Stop::Finished;
    let required = r.required_friction.filter(|_| finished);
    Demand {
        required_friction: required,
        slip_margin: required.map_or(-1.0, |q| mu / q - 1.0),
        contact_margin: r.normal_min_n / prepared.static_normal_n.max(f64::MIN_POSITIVE),
        normal_max_n: [r.run.peaks.normal_max_n, r.run.peaks.normal_outer_max_n],
        finished,
        rhs_evaluations: r.run.counters.rhs_evaluations,
    }
}

/// Simulate `scenario` with the event-driven scheme, at the tolerance and at a tenth of it; the finer run is
/// the answer and the difference its error estimate.
///
/// # Errors
/// [`NoScenario`] where the scenario has no start; whatever happens afterwards is a result.
pub fn simulate(scenario: &Scenario, settings: &Settings) -> Result<Simulation, NoScenario> {
    let prepared = prepare(scenario)?;
    let demand_now = demand(&prepared, settings);
    if prepared.duration_s == 0.0 {
        return Ok(steady(&prepared, demand_now));
    }
    let coarse = run(
        &prepared.model,
        prepared.state,
        prepared.mode,
        &run_settings(&prepared, settings, settings.tolerance, 0),
    );
    let fine_settings = run_settings(&prepared, settings, 0.1 * settings.tolerance, settings.samples);
    let fine = run(&prepared.model, prepared.state, prepared.mode, &fine_settings);
    let fine_demand = demand(&prepared, &Settings { tolerance: 0.1 * settings.tolerance, ..*settings });
    let (offset, coarse_offset) = (offset(&prepared, &fine), offset(&prepared, &coarse));
    let error = ErrorEstimate {
        theta_inner_rad: (fine.state[2] - coarse.state[2]).abs(),
        theta_outer_rad: (fine.state[3] - coarse.state[3]).abs(),
        offset_rad: (offset - coarse_offset).abs(),
        net_slip_m: (fine.inner.net_m - coarse.inner.net_m).abs(),
        normal_min_n: (fine.peaks.normal_min_n - coarse.peaks.normal_min_n).abs(),
        slip_margin: (fine_demand.slip_margin - demand_now.slip_margin).abs(),
    };
    let mut out = Simulation {
        verdict: verdict(&fine, &error),
        stop: fine.stop,
        t_s: fine.t_s,
        theta_inner_rad: fine.state[2],
        theta_outer_rad: fine.state[3],
        offset_rad: offset,
        inner: fine.inner,
        outer: fine.outer,
        contact_lost_s: fine.open_s,
        peaks: fine.peaks,
        hertz_peak_pa: hertz_peak(&prepared, fine.peaks.normal_max_n, fine.peaks.normal_outer_max_n),
        static_normal_n: prepared.static_normal_n,
        demand: fine_demand,
        events: fine.events,
        steps: fine.counters.steps + coarse.counters.steps,
        rhs_evaluations: fine.counters.rhs_evaluations
            + coarse.counters.rhs_evaluations
            + fine_demand.rhs_evaluations
            + demand_now.rhs_evaluations,
        error: Some(error),
        samples: fine.samples,
        drag_torque_nm: prepared.overrun.map(|o| o.drag_torque_nm),
    };
    if verdict(&coarse, &error) != out.verdict {
        out.verdict = Verdict::AtThreshold;
    }
    Ok(out)
}

/// The published scheme on the same start.
///
/// # Errors
/// As [`simulate`].
pub fn run_published(scenario: &Scenario, step_s: f64, band_m_s: f64) -> Result<PublishedRun, NoScenario> {
    let p = prepare(scenario)?;
    Ok(published(&p.model, p.state, p.duration_s, step_s, band_m_s))
}

fn offset(prepared: &Prepared, run: &Run) -> f64 {
    let phase = |y: &crate::dynamics::State| y[2] - y[3] + prepared.model.curve.windup_rad(y[0]);
    phase(&run.state) - phase(&prepared.state)
}

fn hertz_peak(prepared: &Prepared, n_bi: f64, n_be: f64) -> f64 {
    let elastic = &prepared.model.curve.statics().elastic;
    let inner = prepared.model.curve.at_normal(n_bi).map_or(0.0, |p| p.hertz_inner_pa);
    inner.max(elastic.outer_contact.peak_pressure_pa(n_be.max(0.0)))
}

/// Net slip beyond which a scene counts as slipped, m (INTERFACE: 1 um).
const SLIPPED_M: f64 = 1e-6;
/// Stretch without contact beyond which a scene counts as disengaged, s (INTERFACE: 1 ms).
const LOST_S: f64 = 1e-3;

fn verdict(run: &Run, error: &ErrorEstimate) -> Verdict {
    let left = matches!(run.stop, Stop::CurveEnd | Stop::FellAway);
    if left || run.mode.place == Place::Open || run.longest_open_s > LOST_S {
        return Verdict::Disengages;
    }
    if run.stop != Stop::Finished || (run.inner.net_m.abs() - SLIPPED_M).abs() <= error.net_slip_m {
        return Verdict::AtThreshold;
    }
    if run.inner.net_m > SLIPPED_M {
        Verdict::SlipsOverrunning
    } else if run.inner.net_m < -SLIPPED_M {
        Verdict::SlipsEngaging
    } else {
        Verdict::Sticks
    }
}

/// Static and overrunning scenarios: equilibrium, no integration.
fn steady(prepared: &Prepared, demand: Demand) -> Simulation {
    let row = prepared.model.curve.at_normal(prepared.static_normal_n);
    let (n_bi, n_be, tan_inner, tan_outer) = match (prepared.overrun, row) {
        (Some(o), _) => (o.normal_inner_n, o.normal_outer_n, prepared.model.friction.kinetic, o.tan_outer),
        (None, Some(r)) => (r.normal_inner_n, r.normal_outer_n, r.tan_omega, r.tan_nu),
        (None, None) => (0.0, 0.0, 0.0, 0.0),
    };
    let verdict = match prepared.overrun {
        Some(o) if o.normal_inner_n > 0.0 => Verdict::SlipsOverrunning,
        Some(_) => Verdict::Disengages,
        None if demand.slip_margin > 0.0 => Verdict::Sticks,
        // A sprag whose demand exceeds mu_s is squeezed out backwards under torque.
        None => Verdict::SlipsEngaging,
    };
    Simulation {
        verdict,
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
        },
        hertz_peak_pa: hertz_peak(prepared, n_bi, n_be),
        static_normal_n: n_bi,
        demand,
        events: 0,
        steps: 0,
        rhs_evaluations: 0,
        error: None,
        samples: Vec::new(),
        drag_torque_nm: prepared.overrun.map(|o| o.drag_torque_nm),
    }
}
