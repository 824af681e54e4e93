//! Event-driven integration: smooth inside a mode, every change of mode located.

use super::choose::{Known, choose};
use super::crossing::cross;
use super::events::{EVENTS, INNER, LOWER, OUTER, UPPER, events};
use super::model::{Grip, Mode, Model, N_STATE, Place, State};
use super::run::{Peaks, Run, RunSettings, SlipRecord, Stop};
use crate::numeric::root;
use crate::ode::dop853::{self, Counters, Dense, Step, Tolerance};
use std::sync::atomic::Ordering;

/// Shortest step that is still taken, s.
const SHORTEST_STEP_S: f64 = 1e-15;
const GLANCES: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

pub(super) struct Driver<'a> {
    pub(super) model: &'a Model,
    pub(super) settings: &'a RunSettings,
    tolerance: Tolerance<N_STATE>,
    pub(super) run: Run,
    /// Start of the current stretches, for slip times and open time.
    open_since: Option<f64>,
    /// Windup reference of stick: theta_bi - theta_be + W(alpha) is kept while both stick.
    phase: Option<f64>,
    pub(super) next_sample: usize,
    h: f64,
}

impl<'a> Driver<'a> {
    /// At t = 0, looked at once, not yet moved.
    pub(super) fn new(model: &'a Model, state: State, mode: Mode, settings: &'a RunSettings) -> Self {
        let tol = settings.tolerance;
        let (angle, rate, slip) = (1e-2 * tol, 10.0 * tol, 1e-3 * tol);
        let absolute = [angle, angle, angle, angle, rate, rate, rate, rate, slip, slip];
        let mut driver = Self {
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
        driver
    }

    /// Integrate to the end, whatever that is.
    pub(super) fn run(mut self) -> Run {
        self.integrate();
        self.finish()
    }

    fn integrate(&mut self) {
        let model = self.model;
        while self.run.t_s < self.settings.duration_s {
            if self.settings.interrupt.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
                return self.stop(Stop::Interrupted);
            }
            self.run.t_s = model.drive.past_break_s(self.run.t_s);
            let mode = self.run.mode;
            let (t, y) = (self.run.t_s, self.run.state);
            let mut rhs = |t: f64, y: &State| model.slope(&mode, t, y).ok_or(());
            self.run.counters.rhs_evaluations += 1;
            let Ok(slope) = rhs(t, &y) else { return self.stop(Stop::NotFinite) };
            let rest = self.settings.duration_s.min(model.drive.next_break_s(t)) - t;
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
        for (i, &known) in before.iter().enumerate() {
            let end = value(to, i);
            if end >= 0.0 {
                continue;
            }
            let mut start = from;
            let mut at_start = if from == 0.0 { known } else { value(from, i) };
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

enum Found {
    Nothing,
    At(f64, usize),
    TooCoarse,
}

fn moving(v: f64) -> Known {
    if v == 0.0 { Known::Still } else { Known::Slips(v.signum()) }
}
