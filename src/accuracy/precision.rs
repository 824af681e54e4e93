//! Work-precision of one scene: error of theta_bi and of the slip margin over right-hand sides and over time.

use std::time::Instant;

use crate::clutch::Scenario;
use crate::dynamics::{PublishedSettings, Run, RunSettings, Stop, published, run};
use crate::fidelity::{self, Plan};
use crate::follow::{Follow, News};
use crate::scenario::{
    NoScenario, Prepared, Settings, Simulation, Terms, demand, prepare, simulate_prepared,
};

/// What is compared.
#[derive(Debug, Clone)]
pub struct PrecisionSettings {
    /// Tolerances of the event method.
    pub tolerances: Vec<f64>,
    /// Steps of the published scheme, s.
    pub steps_s: Vec<f64>,
    /// Half widths D_V of its band, m/s.
    pub bands_m_s: Vec<f64>,
    /// Time spent on repeating one setting, s.
    pub repeat_s: f64,
    /// Ends the comparison.
    pub follow: Follow,
}

impl Default for PrecisionSettings {
    fn default() -> Self {
        Self {
            tolerances: vec![
                2e-3, 1.5e-3, 1e-3, 7e-4, 5e-4, 3e-4, 2e-4, 1e-4, 5e-5, 3e-5, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9,
                1e-10, 1e-11,
            ],
            steps_s: vec![1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 3e-7, 1e-7],
            bands_m_s: vec![1e-3, 1e-4, 1e-5],
            repeat_s: 0.1,
            follow: Follow::nobody(),
        }
    }
}

impl PrecisionSettings {
    /// The usual settings, without steps of the published scheme below `least_s`, s.
    pub fn down_to(least_s: f64, follow: &Follow) -> Self {
        let mut settings = Self { follow: follow.clone(), ..Self::default() };
        // A hair of room: 1e-7 as typed and as listed are the same step.
        settings.steps_s.retain(|&s| s >= 0.999 * least_s);
        settings
    }

    /// Settings that one scene is run at.
    pub fn points(&self) -> usize {
        3 * self.tolerances.len() + self.bands_m_s.len() * self.steps_s.len()
    }
}

/// A way to an answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scheme {
    /// One run of the event method at a tolerance per step: theta_bi alone.
    OneRun,
    /// The whole answer at a tolerance asked for: slip margin, error estimate, everything in the model.
    Full,
    /// The same without what the scene cannot feel.
    Reduced,
    /// The published scheme with a band of this half width, m/s: theta_bi alone.
    Published(f64),
}

impl Scheme {
    /// Name in JSON and CSV.
    pub fn key(self) -> &'static str {
        match self {
            Self::OneRun => "event-one-run",
            Self::Full => "event-full",
            Self::Reduced => "event-reduced",
            Self::Published(_) => "published",
        }
    }

    /// Half width of the band, m/s.
    pub fn band_m_s(self) -> Option<f64> {
        if let Self::Published(band) = self { Some(band) } else { None }
    }
}

/// One method at one setting.
#[derive(Debug, Clone, Copy)]
pub struct WorkPoint {
    /// Tolerance, pure number, or step, s.
    pub setting: f64,
    /// |theta_bi - reference| at the end, rad; `None`: the run did not come to its end.
    pub theta_error_rad: Option<f64>,
    /// |slip margin - reference|; `None` where the method has none.
    pub margin_error: Option<f64>,
    /// Error of theta_bi that the method itself states, rad.
    pub stated_rad: Option<f64>,
    /// Right-hand sides.
    pub rhs_evaluations: u64,
    /// Median wall time, s.
    pub seconds: f64,
    /// Why the run ended.
    pub stop: Stop,
}

/// One scene.
#[derive(Debug, Clone)]
pub struct Precision {
    /// Name of the scenario.
    pub scene: String,
    /// theta_bi at the end by the reference run, rad.
    pub theta_inner_rad: f64,
    /// Slip margin by the reference run; `None` where no friction suffices.
    pub slip_margin: Option<f64>,
    /// What the reference moves by at ten times its tolerance and twice its longest step: theta_bi (rad), margin.
    pub reference_error: [f64; 2],
    /// Changes of mode of the reference run.
    pub events: u64,
    /// Time to build the model in full and as planned, s.
    pub prepare_s: [f64; 2],
    /// What the planner leaves out.
    pub left_out: Vec<&'static str>,
    /// Methods with their points, the finest setting last.
    pub methods: Vec<(Scheme, Vec<WorkPoint>)>,
}

/// Tolerance per step of the reference run: next to rounding.
const TIGHTEST: f64 = 1e-13;
/// Steps of the reference run per period, and of runs as the tool makes them.
const REFERENCE_STEPS: f64 = 40.0;
const STEPS: f64 = 4.0;
/// Enough for any scene of a design; a run that needs more is left out.
const MOST: u64 = 5_000_000;

/// Compare the methods on `scenario`; `None` where interrupted. [`PrecisionSettings::follow`] is told of each setting.
///
/// # Errors
/// [`NoScenario`] where the scenario has no start.
pub fn precision(scenario: &Scenario, settings: &PrecisionSettings) -> Result<Option<Precision>, NoScenario> {
    let full = prepare(scenario)?;
    let (plan, reduced) = fidelity::plan(scenario, None)?;
    let (_, whole_s) = timed(settings, || drop(prepare(scenario)));
    let (_, planned_s) = timed(settings, || drop(fidelity::plan(scenario, None)));
    let bench = Bench { full, reduced, settings };
    let fine = bench.reference(TIGHTEST, REFERENCE_STEPS);
    let coarse = bench.reference(10.0 * TIGHTEST, 0.5 * REFERENCE_STEPS);
    let reference = (fine.0.state[2], fine.1);
    let mut methods = Vec::new();
    let bands = settings.bands_m_s.iter().map(|&band| Scheme::Published(band));
    for method in [Scheme::OneRun, Scheme::Full, Scheme::Reduced].into_iter().chain(bands) {
        let values = if method.band_m_s().is_some() { &settings.steps_s } else { &settings.tolerances };
        let mut points = Vec::new();
        for &setting in values {
            if bench.interrupted() {
                return Ok(None);
            }
            points.push(bench.point(method, setting, reference));
            settings.follow.news(News::Done);
        }
        methods.push((method, points));
    }
    if bench.interrupted() {
        return Ok(None);
    }
    let Plan { left_out, .. } = plan;
    let rolls = bench.answer(&bench.reduced, 1e-6, Terms::Felt).rolled;
    let law = rolls.then_some("friction law in slip");
    Ok(Some(Precision {
        scene: scenario.name.clone(),
        theta_inner_rad: reference.0,
        slip_margin: reference.1,
        reference_error: [
            (coarse.0.state[2] - reference.0).abs(),
            apart(coarse.1, reference.1).unwrap_or(0.0),
        ],
        events: fine.0.events,
        prepare_s: [whole_s, planned_s],
        left_out: left_out.iter().map(|t| t.term).chain(law).collect(),
        methods,
    }))
}

struct Bench<'a> {
    full: Prepared,
    reduced: Prepared,
    settings: &'a PrecisionSettings,
}

impl Bench<'_> {
    fn interrupted(&self) -> bool {
        self.settings.follow.stopped()
    }

    fn longest_step_s(&self, per_period: f64) -> f64 {
        self.full.period_s.unwrap_or(self.full.duration_s / 25.0) / per_period
    }

    fn run(&self, tolerance: f64, per_period: f64) -> Run {
        let p = &self.full;
        let s = RunSettings {
            tolerance,
            duration_s: p.duration_s,
            longest_step_s: self.longest_step_s(per_period),
            most_events: MOST,
            most_steps: MOST,
            follow: self.settings.follow.unseen(),
            ..RunSettings::default()
        };
        run(&p.model, p.state, p.mode, &s)
    }

    /// A run and the slip margin at one tolerance.
    fn reference(&self, tolerance: f64, per_period: f64) -> (Run, Option<f64>) {
        let s = Settings {
            // `demand` runs at a tenth.
            tolerance: 10.0 * tolerance,
            longest_step_s: Some(self.longest_step_s(per_period)),
            most_steps: Some(MOST),
            follow: self.settings.follow.unseen(),
            ..Settings::default()
        };
        (self.run(tolerance, per_period), demand(&self.full, &s).slip_margin)
    }

    fn answer(&self, prepared: &Prepared, tolerance: f64, terms: Terms) -> Simulation {
        let s = Settings { tolerance, follow: self.settings.follow.unseen(), ..Settings::default() };
        simulate_prepared(prepared, &s, terms)
    }

    fn point(&self, method: Scheme, setting: f64, reference: (f64, Option<f64>)) -> WorkPoint {
        let bare = |run: &Run, seconds: f64| {
            let error = (run.state[2] - reference.0).abs();
            WorkPoint {
                setting,
                theta_error_rad: (run.stop == Stop::Finished).then_some(error),
                margin_error: None,
                stated_rad: None,
                rhs_evaluations: run.counters.rhs_evaluations,
                seconds,
                stop: run.stop,
            }
        };
        let whole = |(s, seconds): (Simulation, f64)| WorkPoint {
            setting,
            theta_error_rad: (s.stop == Stop::Finished).then(|| (s.theta_inner_rad - reference.0).abs()),
            margin_error: s.demand.and_then(|d| apart(d.slip_margin, reference.1)),
            stated_rad: s.error.map(|e| e.theta_inner_rad),
            rhs_evaluations: s.rhs_evaluations,
            seconds,
            stop: s.stop,
        };
        let again = self.settings;
        match method {
            Scheme::OneRun => {
                let (run, seconds) = timed(again, || self.run(setting, STEPS));
                bare(&run, seconds)
            }
            Scheme::Full => whole(timed(again, || self.answer(&self.full, setting, Terms::All))),
            Scheme::Reduced => whole(timed(again, || self.answer(&self.reduced, setting, Terms::Felt))),
            Scheme::Published(band_m_s) => {
                let p = &self.full;
                let s = PublishedSettings { duration_s: p.duration_s, step_s: setting, band_m_s, samples: 0 };
                let go = || published(&p.model, p.state, &s, &mut |_| !self.interrupted());
                let (run, seconds) = timed(again, go);
                bare(&run, seconds)
            }
        }
    }
}

/// The result and the median time of runs repeated for `repeat_s`, at least once.
fn timed<T>(settings: &PrecisionSettings, mut go: impl FnMut() -> T) -> (T, f64) {
    let (mut times, begun) = (Vec::new(), Instant::now());
    loop {
        let start = Instant::now();
        let found = std::hint::black_box(go());
        times.push(start.elapsed().as_secs_f64());
        if begun.elapsed().as_secs_f64() >= settings.repeat_s {
            times.sort_by(f64::total_cmp);
            return (found, times[times.len() / 2]);
        }
    }
}

/// By how much two numbers differ, where both are.
fn apart(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    a.zip(b).map(|(a, b)| (a - b).abs())
}
