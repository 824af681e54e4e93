//! One scene: every method at every setting, its error, its work and its time.

use std::time::Instant;

use cpu_time::ThreadTime;
use sprag_design::clutch::Scenario;
use sprag_design::dynamics::{PublishedSettings, RunSettings, Stop, published, run};
use sprag_design::scenario::{NoScenario, Prepared, prepare};

use crate::clutch::Answer;
use crate::differential;
use crate::diffsol_peer::{self, Kind};

/// A way to an answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    Ours,
    /// Ours without a longest step.
    OursLong,
    Dop853,
    /// Event functions looked at as often as by ours.
    Dop853Looks,
    /// The crate's own root finder.
    Dop853Own,
    Radau5,
    Diffsol(Kind),
    Published,
}

/// All, ours first.
pub const METHODS: [Method; 11] = [
    Method::Ours,
    Method::OursLong,
    Method::Dop853,
    Method::Dop853Looks,
    Method::Dop853Own,
    Method::Diffsol(Kind::Tsit45),
    Method::Radau5,
    Method::Diffsol(Kind::Bdf),
    Method::Diffsol(Kind::TrBdf2),
    Method::Diffsol(Kind::Esdirk34),
    Method::Published,
];

impl Method {
    /// Name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ours => "ours, one run",
            Self::OursLong => "ours, steps of any length",
            Self::Dop853 => "differential-equations dop853",
            Self::Dop853Looks => "differential-equations dop853, four looks a step",
            Self::Dop853Own => "differential-equations dop853, its own root finder",
            Self::Radau5 => "differential-equations radau5",
            Self::Diffsol(Kind::Bdf) => "diffsol BDF",
            Self::Diffsol(Kind::TrBdf2) => "diffsol TR-BDF2",
            Self::Diffsol(Kind::Esdirk34) => "diffsol ESDIRK34",
            Self::Diffsol(Kind::Tsit45) => "diffsol tsit45",
            Self::Published => "published RK4, band 1e-4 m/s",
        }
    }

    /// Whether it is an integrator of others; one that looks as ours does, or with a root finder shown wrong, is none.
    pub fn is_peer(self) -> bool {
        matches!(self, Self::Dop853 | Self::Radau5 | Self::Diffsol(_))
    }

    fn settings(self) -> Vec<f64> {
        match self {
            Self::Published => vec![1e-4, 3e-5, 1e-5, 3e-6, 1e-6],
            _ => [1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4]
                .into_iter()
                .chain((4..=11).map(|i| 10f64.powi(-i)))
                .collect(),
        }
    }
}

/// One setting of a method.
pub struct Point {
    pub method: Method,
    /// Tolerance, or step, s.
    pub setting: f64,
    /// Where it failed and how, or the answer.
    pub found: Result<Answer, String>,
    /// |theta_bi - reference| at the end, rad.
    pub error_rad: Option<f64>,
    /// Median time of the thread, s, and median wall time, s.
    pub seconds: f64,
    pub wall_s: f64,
    pub runs: usize,
}

/// One scene.
pub struct Scene {
    pub name: String,
    pub what: &'static str,
    /// theta_bi by our run next to rounding, rad; what it moves by at ten times its tolerance and twice its longest step.
    pub reference_rad: f64,
    pub reference_error_rad: f64,
    pub changes: u64,
    pub points: Vec<Point>,
}

/// As in the report of the command `accuracy`.
const TIGHTEST: f64 = 1e-13;
const REFERENCE_STEPS: f64 = 40.0;
const STEPS: f64 = 4.0;
const BAND_M_S: f64 = 1e-4;
/// Time for all runs of one setting, s, and their number.
const TIME_S: f64 = 0.05;
const RUNS: std::ops::RangeInclusive<usize> = 1..=9;

fn longest_s(p: &Prepared, per_period: f64) -> f64 {
    p.period_s.unwrap_or(p.duration_s / 25.0) / per_period
}

fn ours(p: &Prepared, tolerance: f64, per_period: f64) -> Result<Answer, String> {
    let settings = RunSettings {
        tolerance,
        duration_s: p.duration_s,
        longest_step_s: longest_s(p, per_period),
        most_steps: 5_000_000,
        ..RunSettings::default()
    };
    let r = run(&p.model, p.state, p.mode, &settings);
    let answer = Answer { theta_rad: r.state[2], rhs: r.counters.rhs_evaluations, changes: r.events };
    if r.stop == Stop::Finished {
        Ok(answer)
    } else {
        Err(format!("{} at {:.7} ms", r.stop.name(), 1e3 * r.t_s))
    }
}

fn go(p: &Prepared, method: Method, setting: f64) -> Result<Answer, String> {
    let longest = longest_s(p, STEPS);
    match method {
        Method::Ours => ours(p, setting, STEPS),
        Method::OursLong => ours(p, setting, p.period_s.unwrap_or(p.duration_s / 25.0) / p.duration_s),
        Method::Dop853Looks => differential::dop853(p, setting, longest, true),
        Method::Dop853Own => differential::dop853_own_events(p, setting, longest),
        Method::Dop853 => differential::dop853(p, setting, longest, false),
        Method::Radau5 => differential::radau5(p, setting, longest),
        Method::Diffsol(kind) => diffsol_peer::run(p, kind, setting),
        Method::Published => {
            let s = PublishedSettings {
                duration_s: p.duration_s,
                step_s: setting,
                band_m_s: BAND_M_S,
                samples: 0,
            };
            let r = published(&p.model, p.state, &s, &mut |_| true);
            let answer = Answer { theta_rad: r.state[2], rhs: r.counters.rhs_evaluations, changes: r.events };
            if r.stop == Stop::Finished {
                Ok(answer)
            } else {
                Err(format!("{} at {:.7} ms", r.stop.name(), 1e3 * r.t_s))
            }
        }
    }
}

/// Run a scene by every method. Settings take turns, so that what else the machine does falls on all alike.
pub fn scene(scenario: &Scenario, what: &'static str) -> Result<Scene, Box<dyn std::error::Error>> {
    let p = prepare(scenario).map_err(|e: NoScenario| e.to_string())?;
    let fine = ours(&p, TIGHTEST, REFERENCE_STEPS)?;
    let coarse = ours(&p, 10.0 * TIGHTEST, 0.5 * REFERENCE_STEPS)?;
    let mut times: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut points = Vec::new();
    let timed = |method: Method, setting: f64| {
        let (wall, own) = (Instant::now(), ThreadTime::now());
        let found = std::hint::black_box(go(&p, method, setting));
        (found, [own.elapsed().as_secs_f64(), wall.elapsed().as_secs_f64()])
    };
    for method in METHODS {
        for setting in method.settings() {
            let (found, seconds) = timed(method, setting);
            let error_rad = found.as_ref().ok().map(|a| (a.theta_rad - fine.theta_rad).abs());
            times.push(vec![seconds]);
            let [seconds, wall_s] = seconds;
            points.push(Point { method, setting, found, error_rad, seconds, wall_s, runs: 1 });
        }
    }
    let wanted: Vec<usize> = points
        .iter()
        .map(|p| match p.found {
            Ok(_) => ((TIME_S / p.seconds) as usize).clamp(*RUNS.start(), *RUNS.end()),
            Err(_) => 1,
        })
        .collect();
    for round in 1..*RUNS.end() {
        for (i, point) in points.iter().enumerate() {
            if round < wanted[i] {
                times[i].push(timed(point.method, point.setting).1);
            }
        }
    }
    let median = |times: &[[f64; 2]], which: usize| {
        let mut each: Vec<f64> = times.iter().map(|t| t[which]).collect();
        each.sort_by(f64::total_cmp);
        each[each.len() / 2]
    };
    for (point, times) in points.iter_mut().zip(&times) {
        (point.seconds, point.wall_s, point.runs) = (median(times, 0), median(times, 1), times.len());
    }
    Ok(Scene {
        name: scenario.name.clone(),
        what,
        reference_rad: fine.theta_rad,
        reference_error_rad: (coarse.theta_rad - fine.theta_rad).abs(),
        changes: fine.changes,
        points,
    })
}

/// Time and right-hand sides at one error.
#[derive(Debug, Clone, Copy)]
pub struct AtError {
    pub seconds: f64,
    pub rhs: f64,
    /// Whether its coarsest setting is better than asked for: it is not run coarser.
    pub better: bool,
}

impl Scene {
    /// Points of one method, the finest last.
    pub fn of(&self, method: Method) -> impl DoubleEndedIterator<Item = &Point> {
        self.points.iter().filter(move |p| p.method == method)
    }

    /// Least time at the error `wanted` (rad): of the settings at which it and all finer ones stay below, or between the
    /// coarsest of them and the next coarser one, logarithms interpolated. A point that is right by chance does not count,
    /// nor does one that failed.
    pub fn at_error(&self, method: Method, wanted: f64) -> Option<AtError> {
        let points: Vec<&Point> = self.of(method).collect();
        let good = |p: &&Point| p.error_rad.is_some_and(|e| e <= wanted);
        let from = points.iter().rposition(|p| !good(p)).map_or(0, |i| i + 1);
        let fine = points.get(from)?;
        let rhs = |p: &Point| p.found.as_ref().map_or(f64::NAN, |a| a.rhs as f64);
        let fastest = points[from..].iter().min_by(|a, b| a.seconds.total_cmp(&b.seconds))?;
        let plain = AtError { seconds: fastest.seconds, rhs: rhs(fastest), better: from == 0 };
        let Some(coarse) = from.checked_sub(1).and_then(|i| points[i].error_rad.map(|e| (points[i], e)))
        else {
            return Some(plain);
        };
        let (log_fine, log_coarse) = (fine.error_rad?.max(1e-16).ln(), coarse.1.ln());
        let share = (log_coarse - wanted.ln()) / (log_coarse - log_fine);
        let between = |a: f64, b: f64| (a.ln() + share * (b.ln() - a.ln())).exp();
        let interpolated = AtError {
            seconds: between(coarse.0.seconds, fine.seconds),
            rhs: between(rhs(coarse.0), rhs(fine)),
            better: false,
        };
        Some(if interpolated.seconds < plain.seconds { interpolated } else { plain })
    }

    /// The tightest setting of a method that gave an answer, with its difference to the reference, rad.
    pub fn tightest(&self, method: Method) -> Option<(&Point, f64)> {
        self.of(method).rev().find_map(|p| Some((p, p.error_rad?)))
    }
}
