//! Where a step is looked at, mostly for nothing: the states at which an explicit step evaluates its right-hand side
//! from its sixth stage on are good to order 5, and an evaluation of the forces is all that a look takes.

use super::events::{Look, look, seen};
use super::model::{Forces, Mode, Model, N_STATE, State};
use crate::ode::dop853;
use crate::ode::step::Step;
use crate::wedge::WedgePoint;
use std::cell::RefCell;

/// Most looks at a step.
const MOST: usize = dop853::LOOKS.len();
/// Evaluations that are remembered: more than a step and a failed trial of an implicit one make.
const KEPT: usize = 64;
/// Up to here, as a part of a step, an event counts as at its start.
const AT_START: f64 = 1e-3;
/// How far beyond an event that is expected a step goes, in parts of the way there.
const BEYOND: f64 = 1.25;

/// The last evaluations of a right-hand side: when, and what was seen.
pub(super) struct Trail {
    last: RefCell<([(f64, Look); KEPT], usize)>,
}

impl Trail {
    pub(super) fn new() -> Self {
        Self { last: RefCell::new(([(f64::NAN, Look::NOTHING); KEPT], 0)) }
    }

    /// What the last evaluation saw.
    pub(super) fn newest(&self) -> Look {
        let (list, next) = &*self.last.borrow();
        list[(next + KEPT - 1) % KEPT].1
    }

    /// What the last evaluation at exactly `t` (s) saw.
    fn at(&self, t: f64) -> Option<Look> {
        let (list, next) = &*self.last.borrow();
        (1..=KEPT).map(|back| &list[(next + KEPT - back) % KEPT]).find(|(when, _)| *when == t).map(|l| l.1)
    }

    /// How much of an explicit trial step of length `h` (s) from `t` that has failed is worth another trial: beyond the
    /// first event another right-hand side acts, and this one may be rough (N has no second derivative at first contact).
    /// A little more than up to where the looks, `first` at its start, show the event.
    pub(super) fn useful(&self, t: f64, h: f64, first: &Look) -> f64 {
        let (mut from, mut before) = (0.0, first.events);
        for &to in &dop853::LOOKS[1..] {
            let Some(seen) = self.at(t + to * h) else { break };
            let crossing = |(a, b): (f64, f64)| if a > 0.0 && b < 0.0 { a / (a - b) } else { f64::INFINITY };
            let part = before.into_iter().zip(seen.events).map(crossing).fold(f64::INFINITY, f64::min);
            if part.is_finite() {
                let way = from + part * (to - from);
                // One at the very start is no matter of the length.
                return if way > AT_START { BEYOND * way * h } else { h };
            }
            (from, before) = (to, seen.events);
        }
        h
    }

    /// The right-hand side in one mode, what it sees on its way kept.
    pub(super) fn slope_in<'a>(
        &'a self,
        model: &'a Model,
        mode: Mode,
        grips: bool,
    ) -> impl Fn(f64, &State) -> Result<State, ()> + 'a {
        move |t, y| {
            let (list, next) = &mut *self.last.borrow_mut();
            let place = &mut list[*next];
            *next = (*next + 1) % KEPT;
            let note = |p: &WedgePoint, f: &Forces| *place = (t, seen(model, &mode, y, p, f, grips));
            model.slope_noting(&mode, t, y, note).ok_or(())
        }
    }
}

/// A step looked at, from its start to its end.
#[derive(Debug, Clone, Copy)]
pub(super) struct Looks {
    /// Where, as fractions of the step's length.
    at: [f64; MOST],
    seen: [Look; MOST],
    count: usize,
}

impl Looks {
    /// At nothing yet.
    pub(super) fn new() -> Self {
        Self { at: [0.0; MOST], seen: [Look::NOTHING; MOST], count: 0 }
    }

    /// At an accepted step in `mode` of which the start has been seen as `first`.
    pub(super) fn take(
        &mut self,
        model: &Model,
        mode: &Mode,
        grips: bool,
        step: &Step<N_STATE>,
        first: &Look,
        trail: &Trail,
    ) {
        self.count = 0;
        self.push(0.0, *first);
        for &theta in &step.looks()[1..] {
            let t = step.t() + theta * step.h();
            let known = if step.is_explicit() { trail.at(t) } else { None };
            let seen = known.unwrap_or_else(|| {
                let y = if theta == 1.0 { *step.y1() } else { step.glance(theta) };
                look(model, mode, t, &y, grips)
            });
            self.push(theta, seen);
        }
    }

    /// At the first `theta` of the step, at whose end `last` is seen; `inside` is what is seen half way where no look
    /// lies before.
    pub(super) fn until(&self, theta: f64, inside: impl FnOnce(f64) -> Look, last: Look) -> Self {
        let before = self.at[..self.count].iter().filter(|&&a| a < theta).count().min(MOST - 1);
        let mut part = *self;
        part.count = before;
        for a in &mut part.at[..before] {
            *a /= theta;
        }
        if before == 1 {
            part.push(0.5, inside(0.5 * theta));
        }
        part.push(1.0, last);
        part
    }

    fn push(&mut self, at: f64, seen: Look) {
        (self.at[self.count], self.seen[self.count]) = (at, seen);
        self.count += 1;
    }

    /// Number of looks, three at least.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// Where look `j` is, as a fraction of the step.
    pub(super) fn at(&self, j: usize) -> f64 {
        self.at[j]
    }

    /// What look `j` sees.
    pub(super) fn seen(&self, j: usize) -> &Look {
        &self.seen[j]
    }

    /// The last one.
    pub(super) fn end(&self) -> &Look {
        &self.seen[self.count - 1]
    }

    /// The looks beside `j`, itself at an end.
    pub(super) fn beside(&self, j: usize) -> (usize, usize) {
        (j.saturating_sub(1), (j + 1).min(self.count - 1))
    }

    /// The parabola through the looks about `j`: its second divided difference, the wider gap, where its top lies.
    fn parabola(&self, j: usize, value: impl Fn(usize) -> f64) -> (f64, f64, f64) {
        let m = j.clamp(1, self.count - 2);
        let (before, after) = (self.at[m] - self.at[m - 1], self.at[m + 1] - self.at[m]);
        let rise = (value(m) - value(m - 1)) / before;
        let bend = ((value(m + 1) - value(m)) / after - rise) / (before + after);
        (bend, before.max(after), self.at[m] - 0.5 * before - 0.5 * rise / bend)
    }

    /// How far a function may rise between the looks beside `j` above all looks, or fall below them: the top of the
    /// parabola lies above the nearest of three points by at most g^2/4 |second divided difference|, g the wider gap;
    /// twice that is allowed for. 0 at an end that the parabola passes a quarter of a gap before its top.
    pub(super) fn overshoot(&self, j: usize, value: impl Fn(usize) -> f64) -> f64 {
        let (bend, gap, top) = self.parabola(j, value);
        let beyond = j == 0 && top < -0.25 * gap || j + 1 == self.count && top > 1.0 + 0.25 * gap;
        if beyond { 0.0 } else { 0.5 * bend.abs() * gap * gap }
    }

    /// Where the extreme beside look `j` is to be looked for first.
    pub(super) fn extreme(&self, j: usize, value: impl Fn(usize) -> f64) -> f64 {
        let (left, right) = self.beside(j);
        let (.., top) = self.parabola(j, value);
        if top.is_finite() { top.clamp(self.at[left], self.at[right]) } else { self.at[j] }
    }
}
