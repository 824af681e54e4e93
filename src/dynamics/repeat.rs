//! A long run whose motion repeats: whole periods are jumped, what they would add is added.
//!
//! The run ends a step at every whole period. There it compares: the state that returns with that of a period before (alpha,
//! theta_be on its abutment, rates, twists of shafts), and what a period adds (angles that run on, slip, open time, works)
//! with what the one before added, each by its natural size. Let g be the largest of all, what is added counted n times, n the
//! periods left. What is still to come moves any figure by less than
//!
//! * g r/(1 - r) of a decay, r the ratio by which g has fallen from period to period of late;
//! * [`HIDDEN`] times the largest g over one to [`STEADY`] periods, where that is no larger than over one: what is left scatters by
//!   the steps of integration, and no trend of a seventh of it a period is in it.
//!
//! Once the smaller stays below the tolerance of the steps, or [`super::RunSettings::jump_error`], for [`STEADY`] periods in a row,
//! each with as many changes of mode, one more period is run, the template of all samples to come, and n of it are added. Runs at
//! several tolerances jump each for itself, so their difference holds what the jump did too.
//!
//! Three things let a motion repeat that does:
//!
//! * Every period begins with the same length of step, and what runs on counts for the tolerance as from the period before: where
//!   contact stays or opens softly, equal states are then left by equal steps, and g falls to rounding.
//! * Where it does not, since many short slips make the choice of steps erratic, g stays at the scatter of the steps, n times
//!   some hundredth of their tolerance. Then the tolerance falls by [`FINER`], for the periods that follow alone: what is added is
//!   better known than one period of the run.
//! * A motion that repeats with every second to [`STEADY`]th period only is compared and added by so many.
//!
//! A motion that does not repeat within [`PATIENCE`] finer periods, a chaotic one, is run to the end as it began.
//!
//! Where nothing that acts changes the swings of a sprag are the periods ([`super::turns`]). They end where it turns, not at given
//! times, and may come to repeat slowly: steps become finer where the differences have not fallen by half within [`STUCK`] turns, and
//! the run goes on as it began where they cannot.

use super::driver::{Driver, KINDS};
use super::model::{Mode, Model, N_STATE};
use super::run::{Sample, SlipRecord};
use super::zeno::Zeno;
use crate::ode::adaptive::{Pace, Size};
use nalgebra::Const;

/// Periods in a row that must be alike: a choice.
const STEADY: usize = 8;
/// What a decay too slow to show in the scatter may add, by the scatter: a choice.
const HIDDEN: f64 = 10.0;
/// What the tolerance of the steps falls by where their scatter is too large: a choice.
const FINER: f64 = 1e-3;
/// Least tolerance of steps.
const FINEST: f64 = 1e-12;
/// What of the tolerance of the steps may be left in what a period adds, at most, for all that differs to count as their scatter.
const SCATTER: f64 = 10.0;
/// Finer periods that are run in vain at most: a choice.
const PATIENCE: u64 = 400;
/// What the difference to the period so many before may be of that to the one before where a motion repeats with so many: a choice.
const SEVERAL: f64 = 0.1;
/// Turns within which the differences have to fall by half, or steps become finer: a choice, half a tenth of a second of a sprag that
/// swings in overrun.
const STUCK: u64 = 200;
/// Least ratio of a difference to the one before that is believed.
const LEAST_RATIO: f64 = 0.5;

/// Periods that a run has not integrated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jump {
    /// From when on, s.
    pub from_s: f64,
    /// How many.
    pub periods: u64,
    /// Length of each, s.
    pub period_s: f64,
    /// What they may be wrong by in any figure, by its natural size.
    pub error: f64,
    /// Changes of mode within each.
    pub events: u64,
}

/// Slip at A and B (time, path, net), time open, path of a carried B, and what the energy balance counts.
const ADDED: usize = 16;

/// What a run has come to at the end of a whole period.
#[derive(Debug, Clone, Copy)]
struct Section<const N: usize> {
    t_s: f64,
    state: [f64; N],
    mode: Mode,
    events: u64,
    added: [f64; ADDED],
}

/// The ends of periods so far.
#[derive(Debug, Clone)]
pub(super) struct Repeat<const N: usize> {
    /// Period of what acts, or the last one from turn to turn, s.
    base_s: f64,
    /// Turns still to come in the present period, where turns end periods.
    turns: Option<u64>,
    /// Where what acts changes, s: nothing is jumped beyond.
    until_s: f64,
    /// With how many of these the motion is taken to repeat: a period from here on.
    each: u64,
    /// How many before may be alike, and for how many ends that has been so.
    several: (usize, usize),
    /// Base periods run.
    count: u64,
    /// How many had been when length or steps of a period last changed.
    since: u64,
    /// How many when the differences had last fallen by half since then, and what was left.
    hope: (u64, f64),
    /// Its last ends, the newest last.
    sections: Vec<Section<N>>,
    /// The last differences, the newest first.
    differences: [f64; STEADY],
    alike: usize,
    /// Length of the first step of a period, and of those by kind of mode.
    pace: Option<(Pace, [f64; KINDS])>,
    /// A template begins here: its start, the periods to add, their error.
    template: Option<(Section<N>, u64, f64)>,
    /// Samples to come: number, whole periods later than the template, time within it (s); the earliest last.
    wanted: Vec<(usize, f64, f64)>,
    /// Those of the template, in the order of their phases.
    taken: Vec<(usize, f64, Sample<N>)>,
}

impl<const N: usize> Repeat<N> {
    /// Of what acts with `period_s`.
    pub(super) fn new(period_s: f64) -> Self {
        Self {
            base_s: period_s,
            turns: None,
            until_s: f64::INFINITY,
            each: 1,
            several: (1, 0),
            count: 0,
            since: 0,
            hope: (0, f64::INFINITY),
            sections: Vec::with_capacity(STEADY + 2),
            differences: [f64::INFINITY; STEADY],
            alike: 0,
            pace: None,
            template: None,
            wanted: Vec::new(),
            taken: Vec::new(),
        }
    }

    /// From turn to turn, some `period_s` apart, until what acts changes at `until_s`.
    pub(super) fn of_turns(period_s: f64, until_s: f64) -> Self {
        Self { turns: Some(1), until_s, ..Self::new(period_s) }
    }

    /// Whether turns end periods.
    pub(super) fn awaits_turns(&self) -> bool {
        self.turns.is_some()
    }

    /// The sprag has turned.
    pub(super) fn turn(&mut self) {
        self.turns = self.turns.map(|left| left.saturating_sub(1));
    }

    /// Whether the present period is over at `t`, s.
    fn is_over(&self, t: f64) -> bool {
        self.turns.map_or_else(|| t >= self.end_s() * (1.0 - 1e-14), |left| left == 0)
    }

    /// End of the present period, s; where turns end it, as the one before lets expect.
    pub(super) fn end_s(&self) -> f64 {
        match (self.turns, self.sections.last()) {
            (Some(_), Some(last)) => last.t_s + self.period_s(),
            _ => (self.count + self.each) as f64 * self.base_s,
        }
    }

    /// Length of a period, s.
    fn period_s(&self) -> f64 {
        self.each as f64 * self.base_s
    }
}

impl<const N: usize> Repeat<N>
where
    Const<N>: Size,
{
    /// Time to the end of the period of `driver`'s run, s; at its end what is there is compared, and periods are jumped where it repeats.
    pub(super) fn left_s(driver: &mut Driver<'_, N>) -> f64 {
        let Some(mut repeat) = driver.repeat.take() else { return f64::INFINITY };
        if repeat.is_over(driver.run.t_s) {
            repeat.count += repeat.each;
            repeat.turns = repeat.turns.map(|_| repeat.each);
            match repeat.template.take() {
                Some((start, periods, error)) => {
                    let turns = repeat.awaits_turns();
                    repeat.jump(driver, &start, periods, error);
                    if turns {
                        Self::leave(driver);
                    }
                    return f64::INFINITY;
                }
                None => repeat.compare(driver),
            }
            let finer = driver.tolerance < driver.settings.tolerance;
            if !repeat.awaits_turns() && finer && repeat.count - repeat.since > PATIENCE {
                driver.tolerance = driver.settings.tolerance;
                driver.renew(driver.run.mode);
                return f64::INFINITY;
            }
            let stuck = repeat.template.is_none() && repeat.count - repeat.hope.0 > STUCK;
            if repeat.awaits_turns() && stuck {
                if !driver.refine() {
                    Self::leave(driver);
                    return f64::INFINITY;
                }
                repeat.start_again();
            }
            repeat.begin_alike(driver);
        }
        let left_s = repeat.end_s() - driver.run.t_s;
        let cut_s = if repeat.awaits_turns() { f64::INFINITY } else { left_s };
        driver.repeat = Some(repeat);
        cut_s
    }

    /// Nothing is compared any more: `driver`'s run goes on at its own tolerance.
    pub(super) fn leave(driver: &mut Driver<'_, N>) {
        driver.repeat = None;
        driver.tolerance = driver.settings.tolerance;
        driver.stepper.tolerance.datum = [0.0; N];
        driver.renew(driver.run.mode);
    }

    /// The next period begins as every other: its steps are then those of the one before where its state is.
    fn begin_alike(&mut self, driver: &mut Driver<'_, N>) {
        let pace = (driver.stepper.pace(), driver.lengths);
        if self.count - self.since <= STEADY as u64 * self.each {
            self.pace = Some(pace);
        }
        let (pace, lengths) = self.pace.unwrap_or(pace);
        driver.stepper.go_on_at(pace);
        driver.lengths = lengths;
        (driver.slope, driver.probed) = (None, None);
        if let [.., before, _] = self.sections[..] {
            let runs_on = |i: usize| if runs_on(driver.model, i) { before.state[i] } else { 0.0 };
            driver.stepper.tolerance.datum = std::array::from_fn(runs_on);
        }
        driver.renew(driver.run.mode);
    }

    /// What has come back at the end of a period of `driver`'s run, and whether the next is a template.
    fn compare(&mut self, driver: &mut Driver<'_, N>) {
        let now = Section::of(driver);
        self.sections.push(now);
        let last = self.sections.len() - 1;
        if last < 2 {
            return;
        }
        if self.awaits_turns() {
            self.base_s = (now.t_s - self.sections[last - 1].t_s) / self.each as f64;
        }
        let period_s = self.period_s();
        let until_s = driver.settings.duration_s.min(self.until_s);
        let left = ((until_s - driver.run.t_s) / period_s * (1.0 + 1e-12)).floor();
        // One is run as a template.
        let periods = left - 1.0;
        let s = &self.sections;
        let gained = |k: usize| gain(&s[k - 1], &s[k]);
        let off = |lag: usize| {
            difference(&*driver, period_s, &s[last - lag], &now, &gained(last - lag), &gained(last), periods)
        };
        self.differences.rotate_right(1);
        self.differences[0] = off(1);
        let largest = |d: &[f64]| d.iter().fold(0.0, |a: f64, b| a.max(*b));
        let (recent, earlier) = self.differences.split_at(STEADY / 2);
        let (recent, earlier) = (largest(recent), largest(earlier));
        if self.awaits_turns() && recent < 0.5 * self.hope.1 {
            self.hope = (self.count, recent);
        }
        let decay = (recent / earlier).powf(2.0 / STEADY as f64).max(LEAST_RATIO);
        let decays = if decay < 1.0 { recent * decay / (1.0 - decay) } else { f64::INFINITY };
        let whole = last == STEADY + 1;
        // All lags, so that a motion that repeats with every second period only is none.
        let lags: [f64; STEADY] = std::array::from_fn(|k| if whole { off(k + 1) } else { f64::INFINITY });
        let apart = largest(&lags);
        let is_scatter = whole && apart <= 2.0 * recent.max(earlier);
        let error = decays.min(if is_scatter { HIDDEN * apart } else { f64::INFINITY });
        let allowed = driver.settings.tolerance.max(driver.settings.jump_error);
        let alike = now.mode == s[last - 1].mode && gained(last - 1).2 == gained(last).2;
        self.alike = if alike && error <= allowed { self.alike + 1 } else { 0 };
        if whole {
            self.sections.remove(0);
        }
        if self.alike == 0 && whole {
            let of_steps = is_scatter && apart <= SCATTER * periods * driver.tolerance;
            self.mend(driver, &lags, of_steps);
        }
        if self.alike < STEADY || periods < 1.0 {
            return;
        }
        let periods = periods as u64;
        self.template = Some((now, periods, error));
        if let Some(watch) = &mut driver.slip_watch {
            watch.mark();
        }
        let from = self.end_s();
        let start_s = driver.run.t_s;
        // A sample at the very end is one of them, whatever rounding says.
        let until = match self.turns {
            None => (self.count + self.each * (1 + periods)) as f64 * self.base_s * (1.0 + 1e-12),
            Some(_) => start_s + (1 + periods) as f64 * period_s,
        };
        // Not beyond the template's last step, whatever rounding says, and turns are a little less equal.
        let within = if self.awaits_turns() { from - 1e-6 * period_s } else { from * (1.0 - 1e-13) };
        self.wanted = (driver.watch.next_sample..driver.settings.samples)
            .map(|i| (i, driver.watch.sample_time(i)))
            .skip_while(|&(_, t)| t <= from)
            .take_while(|&(_, t)| t <= until)
            .map(|(i, t)| {
                let later = ((t - start_s) / period_s).floor();
                (i, later, (t - later * period_s).min(within))
            })
            .collect();
        self.wanted.sort_by(|a, b| b.2.total_cmp(&a.2));
    }

    /// What keeps a motion from repeating is done away with: it repeats with several periods, by the differences to the last,
    /// `lags`, or all that differs is `of_steps`.
    fn mend(&mut self, driver: &mut Driver<'_, N>, lags: &[f64; STEADY], of_steps: bool) {
        let lag = (2..=STEADY).find(|lag| lags[lag - 1] < SEVERAL * lags[0]).unwrap_or(1);
        let ends = if lag == self.several.0 { self.several.1 + 1 } else { 1 };
        self.several = (lag, ends);
        if lag > 1 && ends >= STEADY && self.each == 1 {
            self.each = lag as u64;
        } else if !(of_steps && driver.refine()) {
            return;
        }
        self.start_again();
    }

    /// The periods to come are compared with one another alone.
    fn start_again(&mut self) {
        self.since = self.count;
        self.hope = (self.count, f64::INFINITY);
        self.differences = [f64::INFINITY; STEADY];
        self.sections.drain(..self.sections.len() - 1);
    }

    /// Add to `driver`'s run `periods` of the template that began at `start` and ends now. The rest of the run, less than a period, is run.
    fn jump(mut self, driver: &mut Driver<'_, N>, start: &Section<N>, periods: u64, error: f64) {
        let (model, now) = (driver.model, Section::of(driver));
        let (drift, added, events) = gain(start, &now);
        let n = periods as f64;
        let period_s = if self.awaits_turns() { now.t_s - start.t_s } else { self.period_s() };
        let span_s = n * period_s;
        let from_s = driver.run.t_s;
        for (number, later, sample) in &mut self.taken {
            sample.t = driver.watch.sample_time(*number);
            for i in (0..N).filter(|&i| runs_on(model, i)) {
                sample.state[i] += *later * drift[i];
            }
            for (slip, by) in sample.slip_m.iter_mut().zip([added[2], added[5]]) {
                *slip += *later * by;
            }
        }
        self.taken.sort_by_key(|t| t.0);
        driver.watch.next_sample =
            self.taken.last().map_or(driver.watch.next_sample, |t| driver.watch.next_sample.max(t.0 + 1));
        driver.run.samples.extend(self.taken.iter().map(|t| t.2));
        for (i, drift) in drift.iter().enumerate() {
            let runs_on = f64::from(u8::from(runs_on(model, i)));
            driver.run.state[i] += runs_on * n * drift;
        }
        let more = |s: &mut SlipRecord, by: &[f64]| {
            s.time_s += n * by[0];
            s.distance_m += n * by[1];
            s.net_m += n * by[2];
        };
        more(&mut driver.run.inner, &added[..3]);
        more(&mut driver.run.outer, &added[3..6]);
        driver.run.open_s += n * added[6];
        driver.run.carried_m += n * added[7];
        driver.open_since = driver.open_since.map(|since| since + span_s);
        driver.run.events += periods * events;
        driver.passed_events += periods * events;
        if let Some(audit) = &mut driver.audit {
            audit.add(n, &added[8..]);
        }
        if let Some(watch) = &mut driver.slip_watch {
            watch.repeat(n, span_s);
        }
        driver.phase =
            driver.phase.map(|phase| phase + n * (drift[2] - if runs_on(model, 3) { drift[3] } else { 0.0 }));
        driver.run.t_s = match self.turns {
            None => (self.count + self.each * periods) as f64 * self.base_s,
            Some(_) => from_s + span_s,
        };
        (driver.slope, driver.probed) = (None, None);
        (driver.zeno, driver.landed) = (Zeno::new(), (f64::NAN, super::events::EVENTS));
        driver.run.jumps.push(Jump { from_s, periods, period_s, error, events });
    }

    /// Whether a sample of the template lies before `until_s`.
    pub(super) fn wants_template(&self, until_s: f64) -> bool {
        self.wanted.last().is_some_and(|wanted| wanted.2 <= until_s)
    }

    /// Samples of the template within its step, which ends at `until_s`: taken by `at`.
    pub(super) fn sample_template(&mut self, until_s: f64, at: impl Fn(f64) -> Sample<N>) {
        while let Some(&(number, later, t)) = self.wanted.last() {
            if t > until_s {
                break;
            }
            self.wanted.pop();
            self.taken.push((number, later, at(t)));
        }
    }
}

impl<const N: usize> Driver<'_, N>
where
    Const<N>: Size,
{
    /// Steps scatter less from the next period on, where they can.
    fn refine(&mut self) -> bool {
        let can = self.tolerance > FINEST;
        self.tolerance = self.tolerance.min((FINER * self.tolerance).max(FINEST));
        can
    }
}

/// g of this module.
fn difference<const N: usize>(
    driver: &Driver<'_, N>,
    period_s: f64,
    last: &Section<N>,
    now: &Section<N>,
    before: &([f64; N], [f64; ADDED], u64),
    gained: &([f64; N], [f64; ADDED], u64),
    periods: f64,
) -> f64
where
    Const<N>: Size,
{
    let radius_m = driver.model.curve.touch().lengths.oa.v;
    let rate = std::f64::consts::TAU / period_s;
    let through = now.added[ADDED - 1].max(f64::MIN_POSITIVE);
    let state = (0..N).map(|i| {
        if runs_on(driver.model, i) {
            let size = if (8..N_STATE).contains(&i) { radius_m } else { 1.0 };
            periods * (gained.0[i] - before.0[i]).abs() / size
        } else {
            let is_rate = (4..8).contains(&i) || i >= N_STATE && i % 2 == 1;
            let size = if is_rate { rate } else { 1.0 };
            (now.state[i] - last.state[i]).abs() / size
        }
    });
    // What went through is a measure, and no figure.
    let added = (0..ADDED - 1).map(|i| {
        let size = match i {
            0 | 3 | 6 => driver.settings.duration_s,
            1 | 2 | 4 | 5 | 7 => radius_m,
            // Both grow with the periods.
            _ => through * (1.0 + periods / driver.run.t_s * period_s),
        };
        periods * (gained.1[i] - before.1[i]).abs() / size
    });
    // What moves alpha tells in the force: dN/N is some dalpha/alpha.
    let pressed = (now.state[0] - last.state[0]).abs() / now.state[0].abs().max(1e-3);
    state.chain(added).fold(pressed, |a, b| if b.is_nan() { f64::INFINITY } else { a.max(b) })
}

/// What runs on: phi and the races as far as nothing holds them, slip.
fn runs_on(model: &Model, i: usize) -> bool {
    matches!(i, 1 | 2 | 8 | 9) || i == 3 && model.loads.abutment_nm_per_rad == 0.0
}

impl<const N: usize> Section<N> {
    fn of(driver: &Driver<'_, N>) -> Self
    where
        Const<N>: Size,
    {
        let run = &driver.run;
        let slip = |s: &SlipRecord| [s.time_s, s.distance_m, s.net_m];
        let open = run.open_s + driver.open_since.map_or(0.0, |since| run.t_s - since);
        let mut added = [0.0; ADDED];
        added[..3].copy_from_slice(&slip(&run.inner));
        added[3..6].copy_from_slice(&slip(&run.outer));
        (added[6], added[7]) = (open, run.carried_m);
        if let Some(audit) = &driver.audit {
            added[8..].copy_from_slice(&audit.sums());
        }
        Self { t_s: run.t_s, state: run.state, mode: run.mode, events: run.events, added }
    }
}

/// What lies between two ends of a period: of the state, of what is added, of changes of mode.
fn gain<const N: usize>(from: &Section<N>, until: &Section<N>) -> ([f64; N], [f64; ADDED], u64) {
    (
        std::array::from_fn(|i| until.state[i] - from.state[i]),
        std::array::from_fn(|i| until.added[i] - from.added[i]),
        until.events - from.events,
    )
}
