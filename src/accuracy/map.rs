//! One case of the stability map: run, run again at half the tolerance, compared.

use rayon::prelude::*;

use super::cases::Case;
use crate::clutch::Clutch;
use crate::dynamics::Stop;
use crate::fidelity::{self, Terms};
use crate::follow::{Follow, News};
use crate::scenario::{FIGURES, NoScenario, Settings, Simulation, Verdict};

/// What one case may cost.
#[derive(Debug, Clone)]
pub struct WorkLimit {
    /// As [`Settings::tolerance`].
    pub tolerance: f64,
    /// Steps of one run, rejected ones included.
    pub most_steps: u64,
    /// Changes of mode of one run.
    pub most_events: u64,
    /// Steps of one run, and half as many changes of mode, of a case that met these limits without a verdict and is run once
    /// more; `None`: none is.
    pub most_steps_again: Option<u64>,
    /// Ends the runs.
    pub follow: Follow,
}

impl Default for WorkLimit {
    /// A tenth of the command's own limit of steps: most cases need a thousandth of it.
    fn default() -> Self {
        Self {
            tolerance: 1e-6,
            most_steps: 20_000,
            most_events: 5_000,
            most_steps_again: None,
            follow: Follow::nobody(),
        }
    }
}

/// How a case ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CaseEnd {
    /// A verdict.
    Verdict(Verdict),
    /// None, for this reason.
    Stopped(Stop),
    /// The preload exceeds what the curve carries.
    NotCarried,
    /// No curve at this speed.
    NoCurve,
}

impl CaseEnd {
    /// Name in reports and JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::Verdict(v) => v.name(),
            // Both runs finished, yet with different figures for what decides: no verdict common to both.
            Self::Stopped(Stop::Finished) => "undecided",
            Self::Stopped(s) => s.name(),
            Self::NotCarried => "not-carried",
            Self::NoCurve => "no-curve",
        }
    }

    /// The verdict, where it is one.
    pub fn verdict(self) -> Option<Verdict> {
        match self {
            Self::Verdict(v) => Some(v),
            _ => None,
        }
    }

    /// Whether there was a start to run from.
    pub fn starts(self) -> bool {
        !matches!(self, Self::NotCarried | Self::NoCurve)
    }

    /// Whether the case met its limit of work. Numbers that are none would be a fault of the program, not a matter of work:
    /// they are counted apart ([`Judged::not_finite`]).
    pub fn met_a_limit(self) -> bool {
        matches!(self, Self::Stopped(stop) if stop.gave_up() && stop != Stop::NotFinite)
    }
}

/// What half the tolerance makes of the verdicts of a map.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, serde::Serialize)]
pub struct Halved {
    /// Verdicts at the tolerance.
    pub verdicts: usize,
    /// Those of them that become another, neither being `at-threshold`.
    pub changed: usize,
    /// Those that become `at-threshold`, or were it.
    pub at_threshold: usize,
    /// Those that end without a verdict instead: at a limit of work, or undecided.
    pub lost: usize,
    /// Cases without a verdict that have one there.
    pub gained: usize,
    /// Verdicts whose tolerance was not reached, at it or at half of it.
    pub not_reached: usize,
}

impl Halved {
    /// Count `cases`.
    pub fn of(cases: &[Judged]) -> Self {
        let mut found = Self::default();
        for case in cases {
            let [a, b] = case.verdicts();
            found.verdicts += usize::from(a.is_some());
            found.changed += usize::from(case.verdict_changes);
            found.at_threshold += usize::from(a.zip(b).is_some_and(|(a, b)| a != b && !case.verdict_changes));
            found.lost += usize::from(a.is_some() && b.is_none());
            found.gained += usize::from(a.is_none() && b.is_some());
            found.not_reached += usize::from(a.is_some() && !case.converged);
        }
        found
    }
}

/// A case with what became of it.
#[derive(Debug, Clone)]
pub struct Judged {
    /// The case.
    pub case: Case,
    /// Outcome at the tolerance, and at half of it.
    pub outcomes: [CaseEnd; 2],
    /// Whether half the tolerance changes the verdict, neither being `at-threshold`.
    pub verdict_changes: bool,
    /// First figure of the answers that is not finite.
    pub not_finite: Option<&'static str>,
    /// Whether the tolerance was reached, in both.
    pub converged: bool,
    /// theta_bi at the end in both, rad.
    pub theta_inner_rad: [f64; 2],
    /// Time reached, s.
    pub t_s: f64,
    /// Changes of mode of the answering run.
    pub events: u64,
    /// Steps of both answers, those of all their runs.
    pub steps: u64,
    /// Right-hand sides of both answers.
    pub rhs_evaluations: u64,
    /// Fastest rate in the motion where the limit of steps was met, rad/s.
    pub fastest_rad_s: Option<f64>,
    /// Whether this is what it came to when it was run once more ([`WorkLimit::most_steps_again`]).
    pub again: bool,
}

impl Judged {
    /// Verdict at the tolerance, and at half of it.
    pub fn verdicts(&self) -> [Option<Verdict>; 2] {
        self.outcomes.map(CaseEnd::verdict)
    }
}

/// All `cases` on `clutch`, in parallel; the results are in their order, the same for any number of threads.
/// [`WorkLimit::follow`] is told of each. Once interrupted, those that were finished.
pub fn map(clutch: &Clutch, cases: &[Case], limit: &WorkLimit) -> Vec<Judged> {
    let one = |case: &Case| {
        if limit.follow.stopped() {
            return None;
        }
        let judged = judge(clutch, case, limit);
        limit.follow.news(News::Done);
        (!judged.outcomes.contains(&CaseEnd::Stopped(Stop::Interrupted))).then_some(judged)
    };
    cases.par_iter().with_max_len(1).filter_map(one).collect()
}

/// One case.
pub fn judge(clutch: &Clutch, case: &Case, limit: &WorkLimit) -> Judged {
    let found = judge_within(clutch, case, limit);
    let Some(most_steps) = limit.most_steps_again.filter(|_| found.outcomes[0].met_a_limit()) else {
        return found;
    };
    let more = WorkLimit { most_steps, most_events: most_steps / 2, ..limit.clone() };
    Judged { again: true, ..judge_within(clutch, case, &more) }
}

fn judge_within(clutch: &Clutch, case: &Case, limit: &WorkLimit) -> Judged {
    let scenario = case.scenario(clutch);
    let go = |tolerance: f64| {
        let settings = Settings {
            tolerance,
            most_steps: Some(limit.most_steps),
            most_events: Some(limit.most_events),
            follow: limit.follow.unseen(),
            ..Settings::default()
        };
        fidelity::simulate(&scenario, &settings, Terms::Felt).map(|p| p.simulation)
    };
    let answers = [go(limit.tolerance), go(0.5 * limit.tolerance)];
    let outcomes = [outcome(&answers[0]), outcome(&answers[1])];
    let [a, b] = &answers;
    let found = || a.iter().chain(b);
    let first = a.as_ref().ok();
    Judged {
        case: *case,
        outcomes,
        verdict_changes: changes(outcomes),
        not_finite: found().find_map(not_finite),
        converged: found().all(|s| s.tolerance_reached),
        theta_inner_rad: [a, b].map(|s| s.as_ref().map_or(0.0, |s| s.theta_inner_rad)),
        t_s: first.map_or(0.0, |s| s.t_s),
        events: first.map_or(0, |s| s.events),
        steps: found().map(|s| s.steps).sum(),
        rhs_evaluations: found().map(|s| s.rhs_evaluations).sum(),
        fastest_rad_s: first.and_then(|s| s.fast_motion).map(|f| f.rate_rad_s),
        again: false,
    }
}

/// Whether one verdict has become another, neither being `at-threshold`.
fn changes(outcomes: [CaseEnd; 2]) -> bool {
    match outcomes.map(CaseEnd::verdict) {
        [Some(a), Some(b)] => a != b && a != Verdict::AtThreshold && b != Verdict::AtThreshold,
        _ => false,
    }
}

fn outcome(answer: &Result<Simulation, NoScenario>) -> CaseEnd {
    match answer {
        Ok(s) => s.verdict.map_or(CaseEnd::Stopped(s.stop), CaseEnd::Verdict),
        Err(NoScenario::NotCarried { .. }) => CaseEnd::NotCarried,
        Err(_) => CaseEnd::NoCurve,
    }
}

/// Name of the first figure that is no finite number.
fn not_finite(s: &Simulation) -> Option<&'static str> {
    let p = s.peaks;
    let d = s.demand;
    let demand = |f: fn(&crate::scenario::RollingDemand) -> f64| d.as_ref().map_or(0.0, f);
    let slips = [s.inner, s.outer].map(|r| r.time_s + r.distance_m + r.net_m);
    let e = s.error.unwrap_or_default();
    [
        ("theta_inner_rad", s.theta_inner_rad),
        ("theta_outer_rad", s.theta_outer_rad),
        ("offset_rad", s.offset_rad),
        ("inner", slips[0]),
        ("outer", slips[1]),
        ("contact_lost_s", s.contact_lost_s),
        ("peaks.tan", p.tan_inner + p.tan_outer),
        ("peaks.normal_min_n", p.normal_min_n),
        ("peaks.normal_max_n", p.normal_max_n + p.normal_outer_max_n),
        ("hertz", s.hertz_peak_pa + s.hertz_static_pa + s.hertz_least_pa),
        ("static_normal_n", s.static_normal_n),
        ("demand.required_friction", demand(|d| d.required_friction.unwrap_or(0.0))),
        ("demand.slip_margin", demand(|d| d.slip_margin.unwrap_or(0.0))),
        ("demand.contact_margin", demand(|d| d.contact_margin)),
        ("demand.normal_max_n", demand(|d| d.normal_max_n[0] + d.normal_max_n[1])),
        ("spread_rad", s.spread_rad[1] - s.spread_rad[0]),
        ("fastest_rad_s", s.fast_motion.map_or(0.0, |f| f.rate_rad_s)),
    ]
    .into_iter()
    .chain(FIGURES.iter().map(|figure| (figure.words, (figure.error)(&e))))
    .find(|(_, value)| !value.is_finite())
    .map(|(name, _)| name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accuracy::cases;

    #[test]
    fn what_half_the_tolerance_does_to_a_verdict_is_counted_once() {
        let made = |outcomes: [CaseEnd; 2], converged: bool| Judged {
            case: cases(1, 1)[0],
            verdict_changes: changes(outcomes),
            outcomes,
            not_finite: None,
            converged,
            theta_inner_rad: [0.0; 2],
            t_s: 0.0,
            events: 0,
            steps: 0,
            rhs_evaluations: 0,
            fastest_rad_s: None,
            again: false,
        };
        let [sticks, slips, near] =
            [Verdict::Sticks, Verdict::SlipsEngaging, Verdict::AtThreshold].map(CaseEnd::Verdict);
        let limit = CaseEnd::Stopped(Stop::StepLimit);
        let all = [
            made([sticks, sticks], true),
            made([sticks, sticks], false),
            made([sticks, slips], true),
            made([near, slips], false),
            made([slips, limit], false),
            made([limit, sticks], false),
            made([limit, limit], false),
            made([CaseEnd::NotCarried, CaseEnd::NotCarried], true),
        ];
        let wanted = Halved { verdicts: 5, changed: 1, at_threshold: 1, lost: 1, gained: 1, not_reached: 3 };
        assert_eq!(Halved::of(&all), wanted);
    }
}
