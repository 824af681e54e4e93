//! Where a step is looked at, mostly for nothing: the states at which an explicit step evaluates its right-hand side
//! from its sixth stage on are good to order 5, and an evaluation of the forces is all that a look takes.

use super::events::{EVENTS, LOWER, Look, UPPER, look, seen};
use super::model::{Forces, Mode, Model, N_STATE, Place, State};
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
/// The same where stages beyond it would be of no use.
const BEYOND_A_CUSP: f64 = 1.002;

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

    /// Where the looks at an explicit trial step of length `h` (s) from `t`, `first` at its start, show the first event
    /// that `counts`, as a fraction of the step, and which; one at the very start is none.
    fn event(&self, t: f64, h: f64, first: &Look, counts: impl Fn(usize) -> bool) -> Option<(f64, usize)> {
        let (mut from, mut before) = (0.0, first.events);
        for &to in &dop853::LOOKS[1..] {
            let Some(seen) = self.at(t + to * h) else { break };
            let crossing = |i: usize| {
                let (a, b) = (before[i], seen.events[i]);
                (counts(i) && a > 0.0 && b < 0.0).then(|| (from + a / (a - b) * (to - from), i))
            };
            let earliest = (0..EVENTS).filter_map(crossing).min_by(|a, b| a.0.total_cmp(&b.0));
            if earliest.is_some() {
                return earliest.filter(|(way, _)| *way > AT_START);
            }
            (from, before) = (to, seen.events);
        }
        None
    }

    /// How much of an explicit trial step of length `h` (s) from `t` that has failed is worth another trial: a little more
    /// than up to its first event, beyond which another right-hand side acts. `cusp`: the event beyond which this one is
    /// rough.
    pub(super) fn useful(&self, t: f64, h: f64, first: &Look, cusp: Option<usize>) -> f64 {
        let beyond = |i: usize| if Some(i) == cusp { BEYOND_A_CUSP } else { BEYOND };
        self.event(t, h, first, |_| true).map_or(h, |(way, i)| beyond(i) * way * h)
    }

    /// How much of such a step lies before the event `cusp`, and a little more.
    pub(super) fn smooth(&self, t: f64, h: f64, first: &Look, cusp: Option<usize>) -> f64 {
        let way = cusp.and_then(|cusp| self.event(t, h, first, |i| i == cusp));
        way.map_or(h, |(way, _)| (BEYOND_A_CUSP * way * h).min(h))
    }

    /// The right-hand side in one mode, what it sees on its way kept. Always inlined: its slope is written into the step,
    /// not copied there.
    pub(super) fn slope_in<'a>(
        &'a self,
        model: &'a Model,
        mode: Mode,
        grips: bool,
    ) -> impl Fn(f64, &State) -> Result<State, ()> + 'a {
        #[inline(always)]
        move |t, y| {
            let (list, next) = &mut *self.last.borrow_mut();
            let place = &mut list[*next];
            *next = (*next + 1) % KEPT;
            let note = |p: &WedgePoint, f: &Forces| *place = (t, seen(model, &mode, y, p, f, grips));
            model.slope_noting(&mode, t, y, note).ok_or(())
        }
    }
}

/// The event at which `place` ends at first contact, where rho and the slope of N have infinite slopes.
pub(super) fn cusp(place: Place) -> Option<usize> {
    match place {
        Place::Arc(0) => Some(LOWER),
        Place::Tension => Some(UPPER),
        Place::Arc(_) | Place::Open => None,
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
        let x = [self.at[m - 1], self.at[m], self.at[m + 1]];
        let (bend, top) = parabola(x, [value(m - 1), value(m), value(m + 1)]);
        (bend, (x[1] - x[0]).max(x[2] - x[1]), top)
    }

    /// How far a function may rise between the looks beside `j` above all looks: the top of the parabola lies above the
    /// nearest of three points by at most g^2/4 |second divided difference|, g the wider gap; twice that is allowed for.
    /// 0 at an end that the parabola passes a quarter of a gap before its top, or where it has none: a function that bends
    /// upwards is largest at the end itself.
    pub(super) fn overshoot(&self, j: usize, value: impl Fn(usize) -> f64) -> f64 {
        let (bend, gap, top) = self.parabola(j, value);
        let beyond = j == 0 && top < -0.25 * gap || j + 1 == self.count && top > 1.0 + 0.25 * gap;
        if beyond { 0.0 } else { 0.5 * (-bend).max(0.0) * gap * gap }
    }

    /// Where a function is zero between look `left` and the next, by the parabola of the fraction over its values at those
    /// and at a third beside them: a guess, no number where it has none.
    pub(super) fn zero(&self, left: usize, value: impl Fn(usize) -> f64) -> f64 {
        let (a, b) = (left, (left + 1).min(self.count - 1));
        let c = if b + 1 < self.count { b + 1 } else { left.saturating_sub(1) };
        let (fa, fb, fc) = (value(a), value(b), value(c));
        let rise = (self.at[b] - self.at[a]) / (fb - fa);
        let bend = ((self.at[c] - self.at[b]) / (fc - fb) - rise) / (fc - fa);
        self.at[a] - rise * fa + bend * fa * fb
    }

    /// Where the extreme beside look `j` is to be looked for first.
    pub(super) fn extreme(&self, j: usize, value: impl Fn(usize) -> f64) -> f64 {
        let (left, right) = self.beside(j);
        let (.., top) = self.parabola(j, value);
        if top.is_finite() { top.clamp(self.at[left], self.at[right]) } else { self.at[j] }
    }
}

/// Second divided difference of three points, and where the parabola through them is level.
pub(super) fn parabola([a, m, b]: [f64; 3], [fa, fm, fb]: [f64; 3]) -> (f64, f64) {
    let rise = (fm - fa) / (m - a);
    let bend = ((fb - fm) / (b - m) - rise) / (b - a);
    (bend, 0.5 * (a + m) - 0.5 * rise / bend)
}
