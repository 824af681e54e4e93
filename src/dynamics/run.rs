//! Event-driven integration: smooth inside a mode, every change of mode located.

use super::choose::{Known, choose};
use super::crossing::cross;
use super::events::{EVENTS, INNER, LOWER, OUTER, UPPER, events};
use super::model::{Forces, Grip, Mode, Model, N_STATE, Place, State};
use crate::numeric::root;
use crate::ode::dop853::{self, Counters, Dense, Step, Tolerance};
use std::sync::atomic::{AtomicBool, Ordering};

/// Settings of a run.
#[derive(Debug, Clone, Copy)]
pub struct RunSettings {
    /// Relative tolerance of a step, pure number; absolute ones follow (rad, rad/s, m).
    pub tolerance: f64,
    /// End time, s.
    pub duration_s: f64,
    /// Longest step, s.
    pub longest_step_s: f64,
    /// Largest number of mode changes before the run ends with a name.
    pub most_events: u64,
    /// Largest number of steps before the run ends with a name.
    pub most_steps: u64,
    /// Number of equidistant samples to keep (0: none).
    pub samples: usize,
    /// Pure rolling: no friction limit, contact held by tension below first contact.
    pub rolling: bool,
    /// Set from outside to end the run at the next step.
    pub interrupt: Option<&'static AtomicBool>,
}

/// Why a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stop {
    /// The end of the scenario.
    Finished,
    /// The contact left the profile or the sprag rolled over at the curve's end.
    CurveEnd,
    /// The open sprag turned back out of reach.
    FellAway,
    /// Too many mode changes.
    EventLimit,
    /// Too many steps, or a step that became too short.
    StepLimit,
    /// The right-hand side ceased to be finite.
    NotFinite,
    /// Asked to stop from outside.
    Interrupted,
}

impl Stop {
    /// Name in reports and JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::Finished => "finished",
            Self::CurveEnd => "curve-end",
            Self::FellAway => "fell-away",
            Self::EventLimit => "event-limit",
            Self::StepLimit => "step-limit",
            Self::NotFinite => "not-finite",
            Self::Interrupted => "interrupted",
        }
    }

    /// Whether the run says what becomes of the clutch: it reached its end or left the curve.
    pub fn concludes(self) -> bool {
        matches!(self, Self::Finished | Self::CurveEnd | Self::FellAway)
    }
}

/// Slip at one contact.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SlipRecord {
    /// Time in slip under load, s.
    pub time_s: f64,
    /// Path of slip, int |v| dt, m.
    pub distance_m: f64,
    /// Signed slip, int v dt, m.
    pub net_m: f64,
}

/// Located extremes of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peaks {
    /// Largest |T_bi|/N_bi while A is in contact.
    pub tan_inner: f64,
    /// Largest |T_be|/N_be while A is in contact.
    pub tan_outer: f64,
    /// Smallest N_bi, N (negative: tension of the pure-rolling run).
    pub normal_min_n: f64,
    /// Largest N_bi, N.
    pub normal_max_n: f64,
    /// Largest N_be, N.
    pub normal_outer_max_n: f64,
    /// When each was reached first, s, in the order above.
    pub at_s: [f64; 5],
}

impl Peaks {
    /// Nothing seen yet.
    pub const NONE: Self = Self {
        tan_inner: 0.0,
        tan_outer: 0.0,
        normal_min_n: f64::INFINITY,
        normal_max_n: 0.0,
        normal_outer_max_n: 0.0,
        at_s: [0.0; 5],
    };
}

/// One sample.
#[derive(Debug, Clone, Copy)]
pub struct Sample {
    /// Time, s.
    pub t: f64,
    /// State.
    pub state: State,
    /// Forces there.
    pub forces: Forces,
    /// Mode there.
    pub mode: Mode,
}

/// The first moment at which A carries load without overrunning: at once in a torsional scene, at the reversal
/// in an engagement. What slipped before belongs to the free run.
#[derive(Debug, Clone, Copy)]
pub struct Engaged {
    /// Time, s.
    pub t_s: f64,
    /// State there.
    pub state: State,
    /// Place of the contact there.
    pub place: Place,
    /// Slip at A up to it.
    pub inner: SlipRecord,
    /// Slip at B up to it.
    pub outer: SlipRecord,
}

/// A finished run.
#[derive(Debug, Clone)]
pub struct Run {
    /// Why it ended.
    pub stop: Stop,
    /// Time reached, s.
    pub t_s: f64,
    /// State there.
    pub state: State,
    /// Mode there.
    pub mode: Mode,
    /// Slip at A.
    pub inner: SlipRecord,
    /// Slip at B.
    pub outer: SlipRecord,
    /// Total time without contact at A, s.
    pub open_s: f64,
    /// Longest stretch without contact at A, s.
    pub longest_open_s: f64,
    /// Extremes.
    pub peaks: Peaks,
    /// Located mode changes.
    pub events: u64,
    /// Work of the integrator.
    pub counters: Counters,
    /// Equidistant samples.
    pub samples: Vec<Sample>,
    /// When the clutch began to be one; `None`: it overran or was open to the end.
    pub engaged: Option<Engaged>,
    /// Every mode with the time at which it began, s; empty where no samples were asked for.
    pub modes: Vec<(f64, Mode)>,
}

/// Shortest step that is still taken, s.
const SHORTEST_STEP_S: f64 = 1e-15;
const GLANCES: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

struct Driver<'a> {
    model: &'a Model,
    settings: &'a RunSettings,
    tolerance: Tolerance<N_STATE>,
    run: Run,
    /// Start of the current stretches, for slip times and open time.
    open_since: Option<f64>,
    /// Windup reference of stick: theta_bi - theta_be + W(alpha) is kept while both stick.
    phase: Option<f64>,
    next_sample: usize,
    h: f64,
}

/// Integrate from `state` at t = 0 in `mode`.
pub fn run(model: &Model, state: State, mode: Mode, settings: &RunSettings) -> Run {
    let tol = settings.tolerance;
    let (angle, rate, slip) = (1e-2 * tol, 10.0 * tol, 1e-3 * tol);
    let absolute = [angle, angle, angle, angle, rate, rate, rate, rate, slip, slip];
    let mut driver = Driver {
        model,
        settings,
        tolerance: Tolerance { relative: tol, absolute },
        run: Run {
            stop: Stop::Finished,
            t_s: 0.0,
            state,
            mode,
            inner: SlipRecord::default(),
            outer: SlipRecord::default(),
            open_s: 0.0,
            longest_open_s: 0.0,
            peaks: Peaks::NONE,
            events: 0,
            counters: Counters::default(),
            samples: Vec::with_capacity(settings.samples),
            engaged: None,
            modes: Vec::new(),
        },
        open_since: (mode.place == Place::Open).then_some(0.0),
        phase: None,
        next_sample: 0,
        h: settings.longest_step_s * 0.01,
    };
    driver.enter(mode);
    driver.look(state, 0.0);
    driver.integrate();
    driver.finish()
}

impl Driver<'_> {
    fn integrate(&mut self) {
        let model = self.model;
        while self.run.t_s < self.settings.duration_s {
            if self.settings.interrupt.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
                return self.stop(Stop::Interrupted);
            }
            let mode = self.run.mode;
            let (t, y) = (self.run.t_s, self.run.state);
            let mut rhs = |t: f64, y: &State| model.slope(&mode, t, y).ok_or(());
            self.run.counters.rhs_evaluations += 1;
            let Ok(slope) = rhs(t, &y) else { return self.stop(Stop::NotFinite) };
            let rest = self.settings.duration_s - t;
            let mut h = self.h.min(self.settings.longest_step_s).min(rest);
            let step = loop {
                let trial = dop853::step(&mut rhs, t, &y, &slope, h, &self.tolerance, &mut self.run.counters);
                match trial {
                    Ok(s) if s.error <= 1.0 => break s,
                    Ok(s) => h = s.next_h().min(0.9 * h),
                    Err(()) => h *= 0.25,
                }
                self.run.counters.rejections += 1;
                if h < SHORTEST_STEP_S {
                    return self.stop(Stop::StepLimit);
                }
            };
            if self.run.counters.steps >= self.settings.most_steps {
                return self.stop(Stop::StepLimit);
            }
            if !self.advance(&step, &mut rhs) {
                return;
            }
        }
    }

    /// Take the step up to its first event, if any. False: the run has ended.
    fn advance(
        &mut self,
        step: &Step<N_STATE>,
        rhs: &mut impl FnMut(f64, &State) -> Result<State, ()>,
    ) -> bool {
        let mode = self.run.mode;
        let grips = !self.settings.rolling;
        let at = |t: f64, y: &State| events(self.model, &mode, t, y, grips);
        // Which events can fire: those that are positive now, or have become so inside the step.
        let mut before = at(step.t, &step.y0);
        let mut from = 0.0;
        let mut dense: Option<Dense<N_STATE>> = None;
        for theta in GLANCES {
            let t = step.t + theta * step.h;
            let y = if theta == 1.0 { step.y1 } else { step.glance(theta) };
            let now = at(t, &y);
            let suspect = (0..EVENTS).any(|i| now[i] < 0.0);
            if suspect {
                let d = match &dense {
                    Some(d) => d.clone(),
                    None => match step.dense(rhs, &mut self.run.counters) {
                        Ok(d) => d,
                        Err(()) => {
                            self.stop(Stop::NotFinite);
                            return false;
                        }
                    },
                };
                let first = self.first_event(&d, step, from, theta, &before, &mode, grips);
                dense = Some(d);
                match first {
                    Found::Nothing => {}
                    Found::At(theta, which) => return self.land(step, theta, which, rhs),
                    Found::TooCoarse => {
                        // The event function is negative from the start: look closer, then give way.
                        let h = step.h * 0.125 * theta;
                        if h > 1e-13 {
                            self.h = h;
                            return true;
                        }
                        return self.give_way(&now);
                    }
                }
            }
            before = now;
            from = theta;
        }
        self.h = step.next_h();
        self.accept(step, step.t + step.h, step.y1, rhs)
    }

    /// Earliest zero between the fractions `from` and `to` of the step.
    fn first_event(
        &self,
        dense: &Dense<N_STATE>,
        step: &Step<N_STATE>,
        from: f64,
        to: f64,
        before: &[f64; EVENTS],
        mode: &Mode,
        grips: bool,
    ) -> Found {
        let mut first = Found::Nothing;
        let mut earliest = f64::INFINITY;
        let value = |theta: f64, i: usize| {
            let t = step.t + theta * step.h;
            events(self.model, mode, t, &dense.at(t), grips)[i]
        };
        for (i, &at_first) in before.iter().enumerate() {
            let end = value(to, i);
            if end >= 0.0 {
                continue;
            }
            let mut start = from;
            let mut at_start = if from == 0.0 { at_first } else { value(from, i) };
            if at_start <= 0.0 {
                // Starts at zero (a contact just released): find where it has become positive.
                let inside = [0.02, 0.1, 0.25, 0.5, 0.75].map(|f| from + f * (to - from));
                match inside.into_iter().find(|&theta| value(theta, i) > 0.0) {
                    Some(theta) => (start, at_start) = (theta, value(theta, i)),
                    None => return Found::TooCoarse,
                }
            }
            if let Some(theta) = root::bracketed(start, to, at_start, end, 1e-13, |x| value(x, i))
                && theta < earliest
            {
                earliest = theta;
                first = Found::At(theta, i);
            }
        }
        first
    }

    /// Take the step only up to the event and change the mode there.
    fn land(
        &mut self,
        step: &Step<N_STATE>,
        theta: f64,
        which: usize,
        rhs: &mut impl FnMut(f64, &State) -> Result<State, ()>,
    ) -> bool {
        let h = theta * step.h;
        let t = step.t + h;
        let mut y = step.y0;
        if h > 0.0 {
            self.run.counters.rhs_evaluations += 1;
            let Ok(slope) = rhs(step.t, &step.y0) else {
                self.stop(Stop::NotFinite);
                return false;
            };
            let counters = &mut self.run.counters;
            let Ok(part) = dop853::step(rhs, step.t, &step.y0, &slope, h, &self.tolerance, counters) else {
                self.stop(Stop::NotFinite);
                return false;
            };
            y = part.y1;
            self.h = step.h;
            if !self.accept(&part, t, y, rhs) {
                return false;
            }
            y = self.run.state;
        }
        self.run.events += 1;
        if self.run.events > self.settings.most_events {
            self.stop(Stop::EventLimit);
            return false;
        }
        self.change(which, t, y)
    }

    /// Change of mode at event `which`.
    fn change(&mut self, which: usize, t: f64, mut y: State) -> bool {
        let model = self.model;
        let mode = self.run.mode;
        let f = model.forces(&mode, t, &y);
        let known = |grip: Grip, here: bool, tangential: f64, outward: f64| match grip {
            Grip::Stick if here => Known::Released(outward * tangential.signum()),
            Grip::Stick | Grip::Slip(_) if here => Known::Still,
            Grip::Stick => Known::Still,
            Grip::Slip(s) => Known::Slips(s),
        };
        // T_bi = -sgn(v_A) mu N, T_be = +sgn(v_B) mu N.
        let inner = known(mode.inner, which == INNER, f.t_bi, -1.0);
        let outer = known(mode.outer, which == OUTER, f.t_be, 1.0);
        let place = match which {
            LOWER => match mode.place {
                Place::Arc(0) if self.settings.rolling => Place::Tension,
                Place::Arc(0) => Place::Open,
                Place::Arc(k) => Place::Arc(k - 1),
                Place::Open | Place::Tension => {
                    self.stop(Stop::FellAway);
                    return false;
                }
            },
            UPPER => match mode.place {
                Place::Arc(k) if k + 1 < model.curve.arc_count() => Place::Arc(k + 1),
                Place::Arc(_) => {
                    self.stop(Stop::CurveEnd);
                    return false;
                }
                Place::Open | Place::Tension => Place::Arc(0),
            },
            _ => mode.place,
        };
        let next = if which == LOWER || which == UPPER {
            self.pass(&mode, place, t, &mut y, inner, outer)
        } else {
            choose(model, t, &y, place, inner, outer)
        };
        self.run.state = y;
        self.enter(next);
        true
    }

    /// Pass into another place; a closed contact that touches begins in slip unless v = 0.
    fn pass(&mut self, mode: &Mode, place: Place, t: f64, y: &mut State, inner: Known, outer: Known) -> Mode {
        let model = self.model;
        let (p, q) = (model.point(mode.place, y[0]), model.point(place, y[0]));
        let rates = model.rates(mode, &p, y);
        let touching = mode.place == Place::Open;
        let held =
            Mode { place, inner: if touching { Grip::Slip(1.0) } else { mode.inner }, outer: mode.outer };
        let after = cross(model, &held, &p, &q, rates);
        y[4..8].copy_from_slice(&after);
        if self.settings.rolling {
            return Mode { place, ..*mode };
        }
        let (v_a, v_b) = model.slip_velocities(&q, &after);
        let inner = match inner {
            _ if touching => moving(v_a),
            Known::Slips(_) => moving(v_a),
            other => other,
        };
        let outer = if matches!(outer, Known::Slips(_)) { moving(v_b) } else { outer };
        choose(model, t, y, place, inner, outer)
    }

    /// An event function is negative right after a change although the choice was consistent to rounding:
    /// settle it by choosing again with every still contact free.
    fn give_way(&mut self, now: &[f64; EVENTS]) -> bool {
        self.run.events += 1;
        if self.run.events > self.settings.most_events {
            self.stop(Stop::EventLimit);
            return false;
        }
        let mode = self.run.mode;
        let (t, y) = (self.run.t_s, self.run.state);
        let again = |grip: Grip, negative: bool| match grip {
            Grip::Slip(s) if !negative => Known::Slips(s),
            _ => Known::Still,
        };
        let next = if now[LOWER] < 0.0 || now[UPPER] < 0.0 {
            let which = if now[LOWER] < 0.0 { LOWER } else { UPPER };
            return self.change(which, t, y);
        } else {
            choose(
                self.model,
                t,
                &y,
                mode.place,
                again(mode.inner, now[INNER] < 0.0),
                again(mode.outer, now[OUTER] < 0.0),
            )
        };
        if next == mode {
            // Nothing better: go on in this mode for a step that rounding cannot undo.
            self.run.t_s = t + 1e-12;
            let rhs = |t: f64, y: &State| self.model.slope(&mode, t, y).ok_or(());
            let Ok(slope) = rhs(t, &y) else {
                self.stop(Stop::NotFinite);
                return false;
            };
            for (y, rate) in self.run.state.iter_mut().zip(slope) {
                *y += 1e-12 * rate;
            }
        }
        self.enter(next);
        true
    }

    fn enter(&mut self, mode: Mode) {
        let (t, y) = (self.run.t_s, &mut self.run.state);
        let p = self.model.point(mode.place, y[0]);
        let rates = self.model.rates(&mode, &p, y);
        y[4..8].copy_from_slice(&rates);
        let both = mode.inner == Grip::Stick && mode.outer == Grip::Stick;
        let closed = matches!(mode.place, Place::Arc(_));
        self.phase = (both && closed).then(|| y[2] - y[3] + self.model.curve.windup_rad(y[0]));
        match (mode.place == Place::Open, self.open_since) {
            (true, None) => self.open_since = Some(t),
            (false, Some(since)) => {
                self.run.open_s += t - since;
                self.run.longest_open_s = self.run.longest_open_s.max(t - since);
                self.open_since = None;
            }
            _ => {}
        }
        self.run.mode = mode;
        self.run.note_engagement();
        if self.settings.samples > 0 && self.run.modes.last().is_none_or(|last| last.1 != mode) {
            self.run.modes.push((t, mode));
        }
    }

    /// Take over an accepted step: constraint, peaks, samples, slip records.
    fn accept(
        &mut self,
        step: &Step<N_STATE>,
        t: f64,
        mut y: State,
        rhs: &mut impl FnMut(f64, &State) -> Result<State, ()>,
    ) -> bool {
        let mode = self.run.mode;
        self.run.counters.steps += 1;
        if let Some(phase) = self.phase {
            // Rolling keeps theta_bi - theta_be = -W(alpha): one Newton step removes the drift of the step.
            let p = self.model.point(mode.place, y[0]);
            let miss = y[2] - y[3] + self.model.curve.windup_rad(y[0]) - phase;
            y[0] -= miss / (p.rho_i + p.rho_e);
        }
        let before = self.run.state;
        if mode.place != Place::Open {
            for (record, grip, i) in
                [(&mut self.run.inner, mode.inner, 8), (&mut self.run.outer, mode.outer, 9)]
            {
                if matches!(grip, Grip::Slip(_)) {
                    record.time_s += t - step.t;
                    record.net_m += y[i] - before[i];
                    record.distance_m += (y[i] - before[i]).abs();
                }
            }
        }
        let mut ok = true;
        if let Err(()) = self.watch(step, t, rhs) {
            self.stop(Stop::NotFinite);
            ok = false;
        }
        self.run.t_s = t;
        self.run.state = y;
        ok
    }

    /// Extremes and samples inside the step.
    fn watch(
        &mut self,
        step: &Step<N_STATE>,
        t_end: f64,
        rhs: &mut impl FnMut(f64, &State) -> Result<State, ()>,
    ) -> Result<(), ()> {
        let mode = self.run.mode;
        let model = self.model;
        let figures = |t: f64, y: &State| {
            let f = model.forces(&mode, t, y);
            let ratio = |a: f64, b: f64| if b > 0.0 { a.abs() / b } else { 0.0 };
            let closed = matches!(mode.place, Place::Arc(_));
            if closed {
                [ratio(f.t_bi, f.n_bi), ratio(f.t_be, f.n_be), -f.n_bi, f.n_bi, f.n_be]
            } else {
                [0.0, 0.0, -f.n_bi, f.n_bi, f.n_be]
            }
        };
        let thetas = [0.0, 0.25, 0.5, 0.75, 1.0];
        let values = thetas.map(|theta| {
            let y = match theta {
                0.0 => step.y0,
                1.0 => step.y1,
                _ => step.glance(theta),
            };
            figures(step.t + theta * step.h, &y)
        });
        let p = &mut self.run.peaks;
        let mut best = [p.tan_inner, p.tan_outer, -p.normal_min_n, p.normal_max_n, p.normal_outer_max_n];
        let mut at_s = p.at_s;
        let samples = self.settings.samples;
        let wants_sample =
            samples > 0 && self.next_sample < samples && self.sample_time(self.next_sample) <= t_end;
        let mut dense = None;
        for i in 0..best.len() {
            for (j, theta) in [(0, 0.0), (4, 1.0)] {
                if values[j][i] > best[i] {
                    (best[i], at_s[i]) = (values[j][i], step.t + theta * step.h);
                }
            }
            for j in 0..thetas.len() {
                let (left, right) = (j.saturating_sub(1), (j + 1).min(thetas.len() - 1));
                let peak = values[j][i];
                let top = peak >= values[left][i] && peak >= values[right][i];
                // The true peak of a parabola lies above the highest of three points by at most an eighth of
                // their second difference; twice that is allowed for before a look is thought idle.
                let m = j.clamp(1, thetas.len() - 2);
                let bend = (values[m - 1][i] - 2.0 * values[m][i] + values[m + 1][i]).abs();
                if top && peak + 0.25 * bend > best[i] {
                    let d = match &dense {
                        Some(d) => d,
                        None => dense.insert(step.dense(rhs, &mut self.run.counters)?),
                    };
                    let value = |theta: f64| {
                        let t = step.t + theta * step.h;
                        figures(t, &d.at(t))[i]
                    };
                    let (theta, found) = golden(thetas[left], thetas[right], value);
                    if found > best[i] {
                        (best[i], at_s[i]) = (found, step.t + theta * step.h);
                    }
                }
            }
        }
        if wants_sample {
            let d = match dense {
                Some(d) => d,
                None => step.dense(rhs, &mut self.run.counters)?,
            };
            while self.next_sample < samples && self.sample_time(self.next_sample) <= t_end {
                let t = self.sample_time(self.next_sample);
                let state = d.at(t);
                self.run.samples.push(Sample { t, state, forces: model.forces(&mode, t, &state), mode });
                self.next_sample += 1;
            }
        }
        self.run.peaks = Peaks {
            tan_inner: best[0],
            tan_outer: best[1],
            normal_min_n: -best[2],
            normal_max_n: best[3],
            normal_outer_max_n: best[4],
            at_s,
        };
        Ok(())
    }

    fn sample_time(&self, i: usize) -> f64 {
        self.settings.duration_s * i as f64 / (self.settings.samples.max(2) - 1) as f64
    }

    fn look(&mut self, y: State, t: f64) {
        let f = self.model.forces(&self.run.mode, t, &y);
        let p = &mut self.run.peaks;
        p.normal_min_n = p.normal_min_n.min(f.n_bi);
        p.normal_max_n = p.normal_max_n.max(f.n_bi);
    }

    fn stop(&mut self, why: Stop) {
        self.run.stop = why;
    }

    fn finish(mut self) -> Run {
        if let Some(since) = self.open_since {
            let stretch = self.run.t_s - since;
            self.run.open_s += stretch;
            self.run.longest_open_s = self.run.longest_open_s.max(stretch);
        }
        self.run
    }
}

impl Run {
    /// Remember the first moment at which A carries load without overrunning.
    pub(super) fn note_engagement(&mut self) {
        let holds = matches!(self.mode.place, Place::Arc(_)) && self.mode.inner != Grip::Slip(1.0);
        if self.engaged.is_none() && holds {
            self.engaged = Some(Engaged {
                t_s: self.t_s,
                state: self.state,
                place: self.mode.place,
                inner: self.inner,
                outer: self.outer,
            });
        }
    }
}

impl SlipRecord {
    /// What slipped since `earlier`.
    pub fn since(&self, earlier: &Self) -> Self {
        Self {
            time_s: self.time_s - earlier.time_s,
            distance_m: self.distance_m - earlier.distance_m,
            net_m: self.net_m - earlier.net_m,
        }
    }
}

enum Found {
    Nothing,
    At(f64, usize),
    TooCoarse,
}

fn moving(v: f64) -> Known {
    if v == 0.0 { Known::Still } else { Known::Slips(v.signum()) }
}

/// Place and value of the largest value of a unimodal function on [a, b].
fn golden(mut a: f64, mut b: f64, f: impl Fn(f64) -> f64) -> (f64, f64) {
    const RATIO: f64 = 0.618_033_988_749_894_9;
    let (mut c, mut d) = (b - RATIO * (b - a), a + RATIO * (b - a));
    let (mut fc, mut fd) = (f(c), f(d));
    for _ in 0..24 {
        if fc > fd {
            (b, d, fd) = (d, c, fc);
            c = b - RATIO * (b - a);
            fc = f(c);
        } else {
            (a, c, fc) = (c, d, fd);
            d = a + RATIO * (b - a);
            fd = f(d);
        }
    }
    if fc > fd { (c, fc) } else { (d, fd) }
}
