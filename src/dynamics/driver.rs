//! Event-driven integration: smooth inside a mode, every change of mode located.

use super::change::Next;
use super::cusp::{cusp, near_the_cusp, towards_the_cusp_s};
use super::energy::Audit;
use super::events::{EVENTS, INNER, LOWER, OUTER, Probe, UPPER, event, probe};
use super::model::{Grip, Mode, Model, N_STATE, Place, SLIP};
use super::probes::{NeverPositive, Observed, Probes, Trail};
use super::repeat::Repeat;
use super::run::{FastMotion, Run, RunSettings, Stop, tolerance_at};
use super::slip_heat::SlipWatch;
use super::turns::{Turns, turn};
use super::watch::{Watch, highest, sample_extremes};
use super::zeno::{Zeno, resolution_s};
use crate::ode::adaptive::{Adaptive, Size};
use crate::ode::rhs::RightHandSide;
use crate::ode::step::{Counters, Dense, Room, Step, Tolerance};
use nalgebra::Const;

/// Size of angles (rad), rates (rad/s) and distances (m) below which the increments of a Jacobian do not follow them.
const SMALL: f64 = 1e-3;

/// How exactly the change of a grip is located, as a fraction of a step's length over the tolerance: v or |T| - mu N is
/// nearly zero there in either mode, so what is late by this is wrong by far less than the tolerance.
const WIDTH: f64 = 1e-5;
/// The same for the ends of a place, which alpha must not miss, and at least, as a fraction of a step's length.
const FINEST_WIDTH: f64 = 1e-13;

/// From here on, as a fraction of the way to an event, another is at the same time.
const TOGETHER: f64 = 1.0 - 1e-9;

pub(super) struct Driver<'a, const N: usize = N_STATE>
where
    Const<N>: Size,
{
    pub(super) model: &'a Model,
    pub(super) settings: &'a RunSettings,
    pub(super) run: Run<N>,
    /// Start of the current stretch without contact.
    pub(super) open_since: Option<f64>,
    /// Windup reference of stick: theta_bi - theta_be + W(alpha) is kept while both stick.
    pub(super) phase: Option<f64>,
    pub(super) watch: Watch<'a>,
    /// Works so far, where they are counted.
    pub(super) audit: Option<Audit>,
    /// Slip so far, where its heat is counted.
    pub(super) slip_watch: Option<SlipWatch>,
    pub(super) zeno: Zeno,
    /// Ends of periods, where whole ones may be jumped.
    pub(super) repeat: Option<Repeat<N>>,
    /// Turns of the sprag where nothing that acts changes.
    pub(super) turns: Turns,
    /// Changes of mode in what was not integrated.
    pub(super) passed_events: u64,
    /// When the mode has changed last, s, and at which event.
    pub(super) landed: (f64, usize),
    pub(super) stepper: Adaptive<N>,
    /// Relative tolerance of its steps, that of the settings but where a motion that repeats is run more finely.
    pub(super) tolerance: f64,
    /// Slope and probe at the present state where the last step has left them.
    pub(super) slope: Option<[f64; N]>,
    pub(super) probed: Option<Probe>,
    /// Path of slip at A that ends the run, as slip under load does, m.
    most_slip_m: Option<f64>,
    /// Last step length by kind of mode: in slip the sprag is a hundred times faster than the races.
    pub(super) lengths: [f64; KINDS],
}

/// Kinds of mode.
pub(super) const KINDS: usize = 8;

/// Which contacts hold, for the memory of step lengths.
fn kind(mode: &Mode) -> usize {
    usize::from(mode.inner == Grip::Stick)
        + 2 * usize::from(mode.outer == Grip::Stick)
        + 4 * usize::from(matches!(mode.place, Place::Open | Place::Carried))
}

/// The right-hand side in one mode.
pub(super) fn slope_in<const N: usize>(
    model: &Model,
    mode: Mode,
) -> impl Fn(f64, &[f64; N]) -> Result<[f64; N], ()> {
    move |t, y| model.slope(&mode, t, y).ok_or(())
}

impl<'a, const N: usize> Driver<'a, N>
where
    Const<N>: Size,
{
    /// At t = 0, looked at once, not yet moved.
    pub(super) fn new(model: &'a Model, state: [f64; N], mode: Mode, settings: &'a RunSettings) -> Self {
        let mut driver = Self {
            model,
            settings,
            run: Run::start(state, mode, settings.samples),
            open_since: (mode.place == Place::Open || mode.is_off()).then_some(0.0),
            phase: None,
            watch: Watch::new(model, settings),
            audit: None,
            slip_watch: settings.slip_heat.then(SlipWatch::new),
            zeno: Zeno::new(),
            repeat: settings.jump_period_s.map(Repeat::new),
            turns: Turns::NONE,
            passed_events: 0,
            landed: (f64::NAN, EVENTS),
            stepper: Adaptive::new(settings.tolerance_in(&mode), settings.longest_step_s * 0.1, SMALL),
            tolerance: settings.tolerance,
            slope: None,
            probed: None,
            most_slip_m: None,
            lengths: [f64::INFINITY; KINDS],
        };
        driver.enter(Next::of_mode(mode));
        driver.watch.begin(&mut driver.run);
        driver.audit = settings.energy.then(|| Audit::begin(model, &driver.run));
        driver
    }

    /// A path of slip at A of `most_slip_m`, where there is one, ends the run, as slip under load does.
    pub(super) fn end_by_slip(&mut self, most_slip_m: Option<f64>) {
        self.most_slip_m = most_slip_m;
        self.run.asked_under_load = most_slip_m.map(|_| 0.0);
    }

    /// Integrate to the end, whatever that is.
    pub(super) fn run(mut self) -> Run<N> {
        self.settings.follow.begin_run();
        self.begin();
        self.integrate();
        self.finish()
    }

    /// A contact that cannot hold where the run begins lets go at once.
    pub(super) fn begin(&mut self) {
        let mut now = probe(self.model, &self.run.mode, 0.0, &self.run.state, !self.settings.rolling).events;
        (now[LOWER], now[UPPER]) = (1.0, 1.0);
        if now[INNER] < 0.0 || now[OUTER] < 0.0 {
            self.choose_again(&now);
        }
    }

    pub(super) fn integrate(&mut self) {
        let (trail, mut room, mut probes) = (Trail::new(), Room::new(), Probes::new());
        while self.run.t_s < self.settings.duration_s {
            if self.settings.follow.stopped() {
                return self.stop(Stop::Interrupted);
            }
            self.settings.follow.tell(self.run.t_s);
            if self.most_slip_m.is_some_and(|path| self.run.has_slipped(self.model.loaded_n, path)) {
                return self.stop(Stop::Slipped);
            }
            let period = Repeat::left_s(self);
            if self.run.t_s >= self.settings.duration_s {
                return;
            }
            let past = self.model.drive.past_break_s(self.run.t_s);
            if past >= self.settings.duration_s {
                self.run.t_s = self.settings.duration_s;
                return;
            }
            if past != self.run.t_s {
                // Beyond a knot other forces act: nothing of the last step serves the next.
                (self.slope, self.probed) = (None, None);
                self.run.t_s = past;
            }
            Turns::watch(self);
            let work = self.run.counters.steps + self.run.counters.rejections;
            let (t, y) = (self.run.t_s, self.run.state);
            let mut rhs = trail.slope_in(self.model, self.run.mode, !self.settings.rolling);
            let slope = match self.slope.take().zip(self.probed.take()) {
                Some((slope, probe)) => {
                    trail.begin(probe);
                    slope
                }
                None => {
                    self.run.counters.rhs_evaluations += 1;
                    match rhs.slope_at_probe(0, t, &y) {
                        Ok(slope) => slope,
                        Err(()) => return self.stop(Stop::NotFinite),
                    }
                }
            };
            let longest = self.settings.longest_step_s;
            let rest = self.settings.duration_s.min(self.model.drive.next_break_s(t)) - t;
            let mode = &self.run.mode;
            let rest = rest
                .min(towards_the_cusp_s(mode, y[0] - self.model.curve.first_contact_rad(), y[4]))
                .min(period);
            let counters = &mut self.run.counters;
            let cusp = cusp(self.run.mode.place);
            let useful = |h: f64| trail.useful(h, cusp);
            let smooth = |h: f64| trail.smooth(h, cusp);
            let ahead = (&useful, &smooth);
            let step = self.stepper.step(&mut room, &mut rhs, ahead, t, &y, &slope, longest, rest, counters);
            match step.filter(|_| work < self.settings.most_steps) {
                Some(step) => {
                    let mode = self.run.mode;
                    probes.take(self.model, &mode, !self.settings.rolling, &step, &trail);
                    if !self.advance(&step, &slope, &probes, &mut rhs) {
                        return;
                    }
                }
                None => return self.stop(Stop::StepLimit),
            }
        }
    }

    /// Take the step up to its first event, if any. False: the run has ended.
    fn advance(&mut self, step: &Step<N>, slope: &[f64; N], probes: &Probes, rhs: &mut Observed) -> bool {
        let mut dense: Option<Dense<N>> = None;
        for i in 1..probes.count() {
            if probes.get(i).events.iter().any(|&e| e < 0.0) {
                let d = match &dense {
                    Some(d) => d,
                    None => match step.dense(rhs, &mut self.run.counters) {
                        Ok(d) => dense.insert(d),
                        Err(()) => {
                            self.stop(Stop::NotFinite);
                            return false;
                        }
                    },
                };
                let theta = probes.at(i);
                match self.first_event(d, step, probes, i - 1, theta, &probes.get(i).events) {
                    Found::Nothing => {}
                    Found::At(theta, which) if !self.stays(step, theta, which) => {
                        return self.land(step, probes, theta, which, d, rhs);
                    }
                    Found::At(..) | Found::TooCoarse => {
                        // The event function is negative from the start: probe closer, then give way.
                        let h = step.h() * 0.125 * theta;
                        if h > 1e-13 {
                            self.stepper.h = h;
                            (self.slope, self.probed) = (Some(*slope), Some(*probes.get(0)));
                            return true;
                        }
                        return self.choose_again(&probes.get(i).events);
                    }
                }
            }
        }
        match self.crest(step, probes, dense, None, rhs) {
            Ok(Some((theta, which, d))) => return self.land(step, probes, theta, which, &d, rhs),
            Ok(None) => {
                if let Some((theta, d)) = self.turn_in(step, rhs) {
                    return self.end_period(step, probes, theta, &d, rhs);
                }
                if self.remember(step, probes, rhs).is_err() {
                    self.stop(Stop::NotFinite);
                    return false;
                }
                self.accept(step, probes.end());
            }
            Err(()) => {
                self.stop(Stop::NotFinite);
                return false;
            }
        }
        // The end of an explicit step is the first stage of the next; the correction of the windup in between is
        // of the size of the step's error.
        if let Step::Explicit(s) = step {
            (self.slope, self.probed) = (Some(*s.slope1()), Some(*probes.end()));
        }
        true
    }

    /// Whether event `which` at `theta` is that at which the mode has just changed: what is zero there is no more than
    /// rounding above zero, and in a step as long as this one it may have risen and fallen again unseen.
    fn stays(&self, step: &Step<N>, theta: f64, which: usize) -> bool {
        let t = step.t();
        t + theta * step.h() == t && self.landed == (t, which)
    }

    /// The first event of a function that dips below zero and rises again between two probes: where its lowest probe
    /// is nearer to zero than it can fall between probes. A step may have been cut where event `landed` is.
    fn crest(
        &mut self,
        step: &Step<N>,
        probes: &Probes,
        mut dense: Option<Dense<N>>,
        landed: Option<usize>,
        rhs: &mut Observed,
    ) -> Result<Option<(f64, usize, Dense<N>)>, ()> {
        let (model, mode, grips) = (self.model, self.run.mode, !self.settings.rolling);
        for i in 0..EVENTS {
            let e = |j: usize| probes.get(j).events[i];
            // A contact just released starts at zero and rises: that is no dip.
            for j in 1..probes.count() {
                if landed == Some(i) && j + 1 == probes.count() {
                    continue;
                }
                let (left, right) = probes.beside(j);
                let bottom = e(j) <= e(left) && e(j) <= e(right);
                if !bottom || e(j) >= probes.overshoot(j, |j| -e(j)) {
                    continue;
                }
                let d = match dense.take() {
                    Some(d) => d,
                    None => step.dense(rhs, &mut self.run.counters)?,
                };
                let (start, length) = (step.t(), step.h());
                let value = |theta: f64| {
                    let elapsed = theta * length;
                    -event(model, &mode, start + elapsed, &d.after(elapsed), grips, i)
                };
                let (from, until) = (probes.at(left), probes.at(right));
                let (theta, depth) = highest(from, probes.extreme(j, e), until, 0.0, 0.0, value);
                if depth > 0.0 {
                    let elapsed = theta * length;
                    let there = probe(model, &mode, start + elapsed, &d.after(elapsed), grips).events;
                    if let Found::At(theta, which) = self.first_event(&d, step, probes, left, theta, &there)
                        && (landed.is_none() || theta < TOGETHER)
                    {
                        return Ok(Some((theta, which, d)));
                    }
                }
                dense = Some(d);
            }
        }
        Ok(None)
    }

    /// Earliest zero between probe `left` and the fraction `to` of the step, where `after` is seen.
    fn first_event(
        &self,
        dense: &Dense<N>,
        step: &Step<N>,
        probes: &Probes,
        left: usize,
        to: f64,
        after: &[f64; EVENTS],
    ) -> Found {
        let (mode, grips) = (self.run.mode, !self.settings.rolling);
        let mut first = Found::Nothing;
        let mut earliest = f64::INFINITY;
        for i in (0..EVENTS).filter(|&i| after[i] < 0.0) {
            let value = |theta: f64| {
                let elapsed = theta * step.h();
                event(self.model, &mode, step.t() + elapsed, &dense.after(elapsed), grips, i)
            };
            let width = if i == INNER || i == OUTER { WIDTH * self.settings.tolerance } else { 0.0 };
            match probes.crossing(left, to, after[i], |probe| probe.events[i], width.max(FINEST_WIDTH), value)
            {
                Ok(Some(theta)) if theta < earliest => {
                    earliest = theta;
                    first = Found::At(theta, i);
                }
                Ok(_) => {}
                Err(NeverPositive) => return Found::TooCoarse,
            }
        }
        first
    }

    /// Take the step only up to the event and change the mode there.
    fn land(
        &mut self,
        step: &Step<N>,
        probes: &Probes,
        theta: f64,
        which: usize,
        dense: &Dense<N>,
        rhs: &mut Observed,
    ) -> bool {
        let (model, mode) = (self.model, self.run.mode);
        let grips = !self.settings.rolling;
        let sight = |theta: f64| sight(model, &mode, grips, step, dense, theta);
        let mut there = sight(theta);
        let theta = probes.beyond_a_jump(theta, which, &mut there, sight);
        if self.awaits_turns()
            && let Some(theta) = turn(dense, step.h(), theta)
        {
            return self.end_period(step, probes, theta, dense, rhs);
        }
        let h = theta * step.h();
        if h > 0.0 {
            if cusp(mode.place) == Some(which)
                && let Some((theta, which)) = self.before_the_cusp(step, probes, theta, dense)
            {
                return self.land(step, probes, theta, which, dense, rhs);
            }
            let probes = probes.until(theta, sight, there);
            let part = step.until(h, dense);
            // Another function may have dipped below zero on the way, or still be there.
            match self.crest(&part, &probes, None, Some(which), rhs) {
                Ok(None) => {}
                Ok(Some((theta, which, dense))) => {
                    return self.land(&part, &probes, theta, which, &dense, rhs);
                }
                Err(()) => {
                    self.stop(Stop::NotFinite);
                    return false;
                }
            }
            // A step that was short because the event was expected says little of how long the next in this mode may be.
            self.stepper.h = step.h().max(self.lengths[kind(&mode)].min(self.stepper.h));
            if self.remember(&part, &probes, rhs).is_err() {
                self.stop(Stop::NotFinite);
                return false;
            }
            self.accept(&part, probes.end());
        }
        let (t, y) = (step.t() + h, self.run.state);
        self.landed = (t, which);
        if !self.count_event() {
            return false;
        }
        match self.zeno.note(
            t,
            std::array::from_fn(|i| i == which),
            resolution_s(&self.run.state, self.settings),
        ) {
            Some(limit) => {
                self.close(&limit, t, y);
                true
            }
            None => self.change(which, t, y),
        }
    }

    /// The first event before the cusp at first contact, which lies at `theta`, that shows only near it.
    fn before_the_cusp(
        &self,
        step: &Step<N>,
        probes: &Probes,
        theta: f64,
        dense: &Dense<N>,
    ) -> Option<(f64, usize)> {
        let (mode, grips) = (self.run.mode, !self.settings.rolling);
        let near = near_the_cusp(step, theta, dense);
        let left = probes.last_before(near)?;
        let elapsed = near * step.h();
        let there = probe(self.model, &mode, step.t() + elapsed, &dense.after(elapsed), grips).events;
        match self.first_event(dense, step, probes, left, near, &there) {
            Found::At(theta, which) => Some((theta, which)),
            Found::Nothing | Found::TooCoarse => None,
        }
    }

    /// Extremes, samples and works inside a step that is taken.
    pub(super) fn remember(&mut self, step: &Step<N>, probes: &Probes, rhs: &mut Observed) -> Result<(), ()> {
        self.watch.step(&mut self.run, self.repeat.as_mut(), step, probes, rhs)?;
        let mode = &self.run.mode;
        let rubs = SlipWatch::sees(mode) && self.run.engaged.is_some();
        let slip_watch = self.slip_watch.as_mut().filter(|_| rubs);
        if self.audit.is_none() && slip_watch.is_none() {
            return Ok(());
        }
        // Evaluations of such a watch are none of the run's.
        let Ok(dense) = step.dense(rhs, &mut Counters::default()) else { return Ok(()) };
        let times = [step.t(), step.t() + step.h()];
        if let Some(audit) = &mut self.audit {
            audit.step(self.model, mode, times, &dense);
        }
        if let Some(watch) = slip_watch {
            watch.step(self.model, mode, times, &dense);
        }
        Ok(())
    }

    /// False where there have been too many.
    pub(super) fn count_event(&mut self) -> bool {
        let go_on = self.run.events - self.passed_events < self.settings.most_events;
        if go_on {
            self.run.events += 1;
        } else {
            self.stop(Stop::EventLimit);
        }
        go_on
    }

    /// The right-hand side becomes that of `mode`.
    pub(super) fn renew(&mut self, mode: Mode) {
        let (old, new) = (kind(&self.run.mode), kind(&mode));
        if old != new {
            self.lengths[old] = self.stepper.h;
            self.stepper.h = self.stepper.h.min(self.settings.longest_step_s).min(self.lengths[new]);
            if self.lengths[new].is_finite() {
                self.stepper.h = self.lengths[new];
            }
        }
        self.stepper.forget();
        let datum = self.stepper.tolerance.datum;
        self.stepper.tolerance = Tolerance { datum, ..tolerance_at(self.tolerance, &mode) };
        (self.slope, self.probed) = (None, None);
    }

    /// Take over an accepted step, at whose end `end` is seen: constraint, slip records.
    pub(super) fn accept(&mut self, step: &Step<N>, end: &Probe) {
        let mode = self.run.mode;
        let (t, mut y) = (step.t() + step.h(), *step.y1());
        self.run.counters.steps += 1;
        if let Some(phase) = self.phase {
            // Rolling keeps theta_bi - theta_be = -W(alpha): one Newton step removes the drift of the step.
            let miss = y[2] - y[3] + end.windup - phase;
            y[0] -= miss / end.rho;
        }
        let before = self.run.state;
        let records = [&mut self.run.inner, &mut self.run.outer];
        for (i, (record, slips)) in (SLIP..).zip(records.into_iter().zip(mode.slips_under_load())) {
            if slips {
                record.time_s += t - step.t();
                record.net_m += y[i] - before[i];
                record.distance_m += (y[i] - before[i]).abs();
            }
        }
        if mode.place == Place::Carried && self.run.engaged.is_some() {
            self.run.carried_m += (y[9] - before[9]).abs();
        }
        self.run.t_s = t;
        self.run.state = y;
    }

    pub(super) fn stop(&mut self, why: Stop) {
        self.run.stop = why;
    }

    pub(super) fn finish(mut self) -> Run<N> {
        self.run.energy = self.audit.map(|audit| audit.balance(self.model, &self.run));
        self.run.slip_heat = self.slip_watch.map_or([None; 2], |watch| watch.heat());
        sample_extremes(&mut self.run);
        if matches!(self.run.stop, Stop::StepLimit | Stop::EventLimit) {
            let mut rhs = slope_in(self.model, self.run.mode);
            let (t, y) = (self.run.t_s, self.run.state);
            let fast = self.stepper.fastest(&mut rhs, t, &y, &mut self.run.counters);
            self.run.fast_motion = fast.map(|(rate, part)| FastMotion::of(rate, &part));
        }
        if let Some(since) = self.open_since {
            self.run.end_open(since, self.run.t_s);
        }
        self.run
    }
}

/// What is seen in `mode` at the fraction `theta` of `step`.
pub(super) fn sight<const N: usize>(
    model: &Model,
    mode: &Mode,
    grips: bool,
    step: &Step<N>,
    dense: &Dense<N>,
    theta: f64,
) -> Probe {
    let elapsed = theta * step.h();
    probe(model, mode, step.t() + elapsed, &dense.after(elapsed), grips)
}

enum Found {
    Nothing,
    At(f64, usize),
    TooCoarse,
}
