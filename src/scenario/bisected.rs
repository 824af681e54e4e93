//! The friction that a scene needs whose pure-rolling run says nothing of it: whole runs with slip, between one that slips and one that
//! sticks.

use super::answer::Verdict;
use super::demand::{Fineness, STEPS_PER_PERIOD_OF_DEMAND, run_settings, unaudited};
use super::figures::ErrorEstimate;
use super::prepare::Prepared;
use super::simulate::{Settings, verdict};
use super::verdict::SLIPPED_M;
#[cfg(doc)]
use crate::dynamics::Model;
use crate::dynamics::{Stop, run_while_it_sticks};
use crate::friction::Stribeck;

/// Largest coefficient that is tried where the contact opens: no pair of materials of a clutch has more.
pub(super) const MOST_FRICTION: f64 = 1.0;
/// Smallest coefficient that is tried, about; where even that suffices it is the answer.
const LEAST_FRICTION: f64 = 1e-3;
/// Ratio of one coefficient that is tried to the next, on the way down from mu_s: small, because below a friction that does
/// not suffice another may.
const DOWN: f64 = 1.2;
/// Least relative width at which the bisection ends; else it is the tolerance of the runs.
const NARROWEST: f64 = 1e-12;

/// How far beside the friction that a run asked for under load it is tried whether that decides, as a part of it.
const BESIDE: f64 = 1e-3;
/// Of what an estimate has moved by since the last one, the part by which it is tried beside it; of a bracket, the part by which beside an
/// estimate at which the scene has slipped.
const DOUBT: f64 = 0.1;
/// Trials that leave more than half of the bracket before the middle is tried.
const PATIENCE: u32 = 3;

/// What [`bisected`] found.
pub(super) struct Bisected {
    /// mu_req: the middle, by ratio, of the last bracket, so that bisections of different width do not agree by chance.
    /// `None`: the scene sticks neither at [`MOST_FRICTION`] nor half way there.
    pub(super) required: Option<f64>,
    pub(super) rhs_evaluations: u64,
    pub(super) interrupted: bool,
}

/// Ways in which a scene is one that slips.
const KINDS: usize = 3;

/// A run at one static friction.
#[derive(Debug, Clone, Copy)]
struct Trial {
    mu: f64,
    sticks: bool,
    /// Largest |T|/N that a contact was asked for while it stuck under load, over mu; largest N_bi at which one began to slip, over
    /// [`Model::loaded_n`]; path of slip over [`SLIPPED_M`]: 1 is where it slips.
    used: [f64; KINDS],
}

impl Trial {
    /// |T|/N that it asked for under load.
    fn asked(&self) -> f64 {
        self.used[0] * self.mu
    }
}

/// The static friction from which on the scene sticks. The kinetic coefficient is lowered with the static one where it would exceed it.
///
/// 1. Bracket. A coarser search has ended at `near`: a narrow bracket about it, then a wider one. Otherwise from mu_s: where it sticks
///    there, about what that run asked for under load, then down in steps of [`DOWN`] until the scene slips; up to [`MOST_FRICTION`]
///    where it slips there.
/// 2. Close it until it is as narrow as the tolerance of the runs, by [`Bracket::next`].
///
/// More friction is not always better, so several brackets may exist; this takes the one next to mu_s.
///
/// A scene that stands by in overrun before it is driven stands by shorter: `left_out_s` of it are left out.
pub(super) fn bisected(
    prepared: &Prepared,
    settings: &Settings,
    fineness: Fineness,
    near: Option<f64>,
    left_out_s: f64,
) -> Bisected {
    let mut s = run_settings(prepared, &unaudited(settings), fineness, 0, STEPS_PER_PERIOD_OF_DEMAND);
    let law = prepared.model.friction;
    let mut model = prepared.model.clone();
    if left_out_s > 0.0 {
        s.duration_s -= left_out_s;
        s.jump_swings = false;
        model.drive = model.drive.from(left_out_s);
    }
    let loaded_n = prepared.model.loaded_n;
    let (mut rhs_evaluations, mut interrupted) = (0, false);
    let mut at = |mu: f64| {
        model.friction = Stribeck { static_: mu, kinetic: law.kinetic.min(mu), ..law };
        let (state, mode) = prepared.start_under(&model.friction);
        let r = run_while_it_sticks(&model, state, mode, &s, SLIPPED_M);
        rhs_evaluations += r.counters.rhs_evaluations;
        interrupted |= r.stop == Stop::Interrupted;
        let sticks = verdict(prepared, &r, &ErrorEstimate::default()) == Some(Verdict::Sticks)
            && !r.has_slipped(loaded_n, SLIPPED_M);
        let asked = r.asked_under_load.unwrap_or(0.0);
        let used = [asked / mu, r.slip_begins_n / loaded_n, r.slipped_m() / SLIPPED_M];
        Trial { mu, sticks, used }
    };
    let width = fineness.tolerance.max(NARROWEST);
    let required = closed(&mut at, law.static_, near, width);
    Bisected { required, rhs_evaluations, interrupted }
}

/// The middle of the bracket that is narrower than `width`, as a part of it.
fn closed(at: &mut dyn FnMut(f64) -> Trial, mu_s: f64, near: Option<f64>, width: f64) -> Option<f64> {
    bracket(at, mu_s, near, width).map(|found| match found {
        Ok(mut bracket) => {
            while bracket.is_wider_than(width) {
                let mu = bracket.next(width);
                bracket.take(at(mu));
            }
            bracket.middle()
        }
        Err(least) => least,
    })
}

/// The first bracket; `Some(Err)`: what suffices where next to nothing does; `None`: nothing suffices.
fn bracket(
    at: &mut dyn FnMut(f64) -> Trial,
    mu_s: f64,
    near: Option<f64>,
    width: f64,
) -> Option<Result<Bracket, f64>> {
    for by in [30.0 * width, 1e3 * width] {
        if let Some(found) = near.and_then(|mu| about(at, mu, by)) {
            return Some(Ok(found));
        }
    }
    let mut low = at(mu_s);
    if !low.sticks {
        let more = [MOST_FRICTION, (mu_s * MOST_FRICTION).sqrt()].into_iter().filter(|&mu| mu > mu_s);
        let high = more.map(at).find(|trial| trial.sticks)?;
        return Some(Ok(Bracket::new(low, high)));
    }
    if low.asked() >= LEAST_FRICTION
        && low.asked() * (1.0 + BESIDE) < mu_s
        && let Some(found) = about(at, low.asked(), BESIDE)
    {
        return Some(Ok(Bracket { before: Some(low), ..found }));
    }
    let mut before = None;
    while low.mu >= LEAST_FRICTION {
        let high = low;
        low = at(high.mu / DOWN);
        if !low.sticks {
            return Some(Ok(Bracket { before, ..Bracket::new(low, high) }));
        }
        before = Some(high);
    }
    Some(Err(low.mu))
}

/// The bracket that reaches `by` times `mu` to both sides, if it is one; the run that slips, the shorter one, first.
fn about(at: &mut dyn FnMut(f64) -> Trial, mu: f64, by: f64) -> Option<Bracket> {
    let low = Some(at(mu / (1.0 + by))).filter(|low| !low.sticks)?;
    let high = Some(at(mu * (1.0 + by))).filter(|high| high.sticks)?;
    Some(Bracket::new(low, high))
}

/// Between a friction at which a scene slips and one at which it sticks.
struct Bracket {
    low: Trial,
    high: Trial,
    /// What stuck before `high`.
    before: Option<Trial>,
    /// The last estimate of what lies between.
    estimate: f64,
    /// Trials in a row that left more than half.
    long: u32,
}

impl Bracket {
    fn new(low: Trial, high: Trial) -> Self {
        Self { low, high, before: None, estimate: f64::NAN, long: 0 }
    }

    fn is_wider_than(&self, width: f64) -> bool {
        self.high.mu > self.low.mu * (1.0 + width)
    }

    fn middle(&self) -> f64 {
        (self.low.mu * self.high.mu).sqrt()
    }

    /// The friction at which the scene begins to slip, as the last two that stuck have it: what each used, on, as a power of mu. What
    /// was asked for under load hardly depends on mu. No number where they do not tell.
    fn extrapolated(&self) -> f64 {
        let of = |kind: usize| {
            let (mu, used) = (self.high.mu, self.high.used[kind]);
            let power = match self.before {
                Some(before) => (used / before.used[kind]).ln() / (mu / before.mu).ln(),
                None if kind == 0 => -1.0,
                None => f64::NAN,
            };
            (power < 0.0 && used > 0.0).then(|| mu * used.powf(-1.0 / power))
        };
        (0..KINDS).filter_map(of).fold(f64::NAN, f64::max)
    }

    /// The next friction to be tried, between the two: a little beside what is estimated, on the side of the end that is farther, so
    /// that both ends close in on it. The middle where nothing is.
    fn next(&mut self, width: f64) -> f64 {
        let estimate = self.extrapolated();
        let moved = (estimate / self.estimate).ln().abs();
        self.estimate = estimate;
        let [below, above] = [estimate / self.low.mu, self.high.mu / estimate].map(f64::ln);
        let doubt = moved.min(below.min(above));
        let beside = (DOUBT * doubt).max(width / 3.0);
        let trial = if below < above { estimate * (1.0 + beside) } else { estimate / (1.0 + beside) };
        match self.long < PATIENCE {
            true if self.low.mu < trial && trial < self.high.mu => trial,
            // It has slipped there: not much more will do.
            true if trial <= self.low.mu && -below < (self.high.mu / self.low.mu).ln() => {
                self.low.mu * (self.high.mu / self.low.mu).powf(DOUBT)
            }
            _ => self.middle(),
        }
    }

    /// `trial` becomes one of its ends.
    fn take(&mut self, trial: Trial) {
        let before = (self.high.mu / self.low.mu).ln();
        if trial.sticks {
            self.before = Some(std::mem::replace(&mut self.high, trial));
        } else {
            self.low = trial;
        }
        let halved = (self.high.mu / self.low.mu).ln() <= 0.5 * before;
        self.long = if halved { 0 } else { self.long + 1 };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDTH: f64 = 1e-7;

    /// What is found with mu_s where a run uses `used`, and by how many runs.
    fn found(mu_s: f64, near: Option<f64>, used: impl Fn(f64) -> [f64; KINDS]) -> (Option<f64>, usize) {
        let mut runs = 0;
        let mut at = |mu: f64| {
            runs += 1;
            let used = used(mu);
            Trial { mu, sticks: used.iter().all(|used| *used < 1.0), used }
        };
        (closed(&mut at, mu_s, near, WIDTH), runs)
    }

    #[test]
    fn what_decides_is_closed_in_on_in_few_runs() {
        let wanted = 0.0794;
        // |T|/N under load, which knows the slip in between a little; the force at which slip begins; the path, ever steeper.
        let asked = |mu: f64| [wanted * (1.0 + 1e-3 * (mu - wanted)) / mu, 0.0, 0.0];
        let force = |mu: f64| [0.2, (wanted / mu).powf(0.98 + 0.1 * mu), 0.0];
        let path = |mu: f64| [0.2, 0.0, 1.0 - 0.3 * (mu / wanted).ln() + 0.05 * (mu / wanted).ln().powi(2)];
        for (of, most) in [(&asked as &dyn Fn(f64) -> [f64; KINDS], 9), (&force, 13), (&path, 14)] {
            for mu_s in [0.12, 0.06] {
                let (mu, runs) = found(mu_s, None, of);
                let off = (mu.unwrap() / wanted - 1.0).abs();
                assert!(off < WIDTH && runs <= most, "{mu_s}: {off:e} after {runs}");
                let (mu, runs) = found(mu_s, Some(wanted * (1.0 + 1e-6)), of);
                assert!(
                    (mu.unwrap() / wanted - 1.0).abs() < WIDTH && runs <= 6,
                    "{mu_s}: {runs} beside a guess"
                );
            }
        }
    }

    #[test]
    fn where_nothing_tells_the_bracket_is_halved() {
        let step = |mu: f64| if mu < 0.0794 { [1.0; KINDS] } else { [0.3, 0.0, 0.0] };
        let (mu, runs) = found(0.12, None, step);
        assert!((mu.unwrap() / 0.0794 - 1.0).abs() < WIDTH && runs < 34, "{runs}");
        // Nothing suffices; next to nothing does.
        assert_eq!(found(0.12, None, |_| [0.0, 2.0, 0.0]).0, None);
        assert!(found(0.12, None, |_| [0.0; KINDS]).0.unwrap() < LEAST_FRICTION);
    }
}
