//! Where a step is looked at, mostly for nothing: the states at which an explicit step evaluates its right-hand side
//! from its sixth stage on are good to order 5, and an evaluation of the forces is all that a probe takes.

use super::events::{EVENTS, Probe, probe, probe_of};
use super::model::{Mode, Model};
use crate::numeric::root;
use crate::ode::dop853;
use crate::ode::rhs::RightHandSide;
use crate::ode::step::Step;
use std::cell::RefCell;

/// Most probes at a step.
const MOST: usize = dop853::PROBES.len();
/// Up to here, as a part of a step, an event counts as at its start.
const AT_START: f64 = 1e-3;
/// A function that is still this part of what it is elsewhere in the step where it has been located jumps there.
const JUMP: f64 = 1e-3;
/// Up to here, as a part of the way between two probes, their own values do not decide where a function is zero.
const BESIDE_A_LOOK: f64 = 1e-2;
/// How far beyond an event that is expected a step goes, in parts of the way there.
const BEYOND: f64 = 1.25;
/// The same where stages beyond it would be of no use.
const BEYOND_A_CUSP: f64 = 1.002;

/// What has been seen of the present step and the last trial of it: at its start and at [`dop853::PROBES`] as far as that
/// has gone.
pub(super) struct Trail {
    probed: RefCell<([Probe; MOST], usize)>,
}

impl Trail {
    pub(super) fn new() -> Self {
        Self { probed: RefCell::new(([Probe::NOTHING; MOST], 0)) }
    }

    /// A step begins where `first` is seen.
    pub(super) fn begin(&self, first: Probe) {
        let (probes, count) = &mut *self.probed.borrow_mut();
        (probes[0], *count) = (first, 1);
    }

    /// Where the last explicit trial shows the first event that `counts`, as a fraction of the step, and which; one at the
    /// very start is none.
    fn event(&self, counts: impl Fn(usize) -> bool) -> Option<(f64, usize)> {
        let (probes, count) = &*self.probed.borrow();
        for to in 1..*count {
            let [from, until] = [to - 1, to].map(|j| dop853::PROBES[j]);
            let crossing = |i: usize| {
                let (a, b) = (probes[to - 1].events[i], probes[to].events[i]);
                (counts(i) && a > 0.0 && b < 0.0).then(|| (from + a / (a - b) * (until - from), i))
            };
            let earliest = (0..EVENTS).filter_map(crossing).min_by(|a, b| a.0.total_cmp(&b.0));
            if earliest.is_some() {
                return earliest.filter(|(way, _)| *way > AT_START);
            }
        }
        None
    }

    /// How much of an explicit trial step of length `h` (s) that has failed is worth another trial: a little more than up to
    /// its first event, beyond which another right-hand side acts. `cusp`: the event beyond which this one is rough.
    pub(super) fn useful(&self, h: f64, cusp: Option<usize>) -> f64 {
        let beyond = |i: usize| if Some(i) == cusp { BEYOND_A_CUSP } else { BEYOND };
        self.event(|_| true).map_or(h, |(way, i)| beyond(i) * way * h)
    }

    /// How much of such a step lies before the event `cusp`, and a little more.
    pub(super) fn smooth(&self, h: f64, cusp: Option<usize>) -> f64 {
        let way = cusp.and_then(|cusp| self.event(|i| i == cusp));
        way.map_or(h, |(way, _)| (BEYOND_A_CUSP * way * h).min(h))
    }

    /// The right-hand side in one mode, what it sees on its way kept.
    pub(super) fn slope_in<'a>(&'a self, model: &'a Model, mode: Mode, grips: bool) -> Observed<'a> {
        Observed { trail: self, model, mode, grips }
    }
}

/// The right-hand side in one mode, which leaves a trail where it is looked at.
pub(super) struct Observed<'a> {
    trail: &'a Trail,
    model: &'a Model,
    mode: Mode,
    grips: bool,
}

/// Always inlined: a slope is written into the step, not copied there.
impl<const N: usize> RightHandSide<N> for Observed<'_> {
    type Failure = ();

    #[inline(always)]
    fn slope(&mut self, t: f64, y: &[f64; N]) -> Result<[f64; N], ()> {
        self.model.slope(&self.mode, t, y).ok_or(())
    }

    #[inline(always)]
    fn slope_at_probe(&mut self, probe: usize, t: f64, y: &[f64; N]) -> Result<[f64; N], ()> {
        let (model, mode) = (self.model, &self.mode);
        let (probes, count) = &mut *self.trail.probed.borrow_mut();
        let p = model.point(mode.place, y[0]);
        let rates = model.rates(mode, &p, y);
        let f = model.forces_with::<true, N>(mode, t, y, &p, &rates);
        probes[probe] = probe_of(model, mode, t, y, &p, &f, self.grips);
        *count = probe + 1;
        model.slope_of(mode, t, y, &rates, &f).ok_or(())
    }
}

/// An event function was nowhere seen to be positive before it was negative.
pub(super) struct NeverPositive;

/// A step looked at, from its start to its end.
#[derive(Debug, Clone, Copy)]
pub(super) struct Probes {
    /// Where, as fractions of the step's length.
    at: [f64; MOST],
    probed: [Probe; MOST],
    count: usize,
}

impl Probes {
    /// At nothing yet.
    pub(super) fn new() -> Self {
        Self { at: [0.0; MOST], probed: [Probe::NOTHING; MOST], count: 0 }
    }

    /// `count` places and what is there, by `place`.
    pub(super) fn of(place: impl Fn(usize) -> (f64, Probe), count: usize) -> Self {
        let mut probes = Self::new();
        for (at, probe) in (0..count).map(place) {
            probes.push(at, probe);
        }
        probes
    }

    /// At an accepted step in `mode` which has left `trail`.
    pub(super) fn take<const N: usize>(
        &mut self,
        model: &Model,
        mode: &Mode,
        grips: bool,
        step: &Step<N>,
        trail: &Trail,
    ) {
        let (probed, _) = &*trail.probed.borrow();
        self.count = 0;
        for (j, &theta) in step.probes().iter().enumerate() {
            let known = j == 0 || step.is_explicit();
            let probe = if known {
                probed[j]
            } else {
                let y = if theta == 1.0 { *step.y1() } else { step.glance(theta) };
                probe(model, mode, step.t() + theta * step.h(), &y, grips)
            };
            self.push(theta, probe);
        }
    }

    /// At the first `theta` of the step, at whose end `last` is seen; `inside` is what is seen half way where no probe
    /// lies before.
    pub(super) fn until(&self, theta: f64, inside: impl FnOnce(f64) -> Probe, last: Probe) -> Self {
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

    /// `theta`, where event `which` has been located and `there` is seen; where it jumps through zero, a place beyond, at which
    /// what comes next can be told.
    pub(super) fn beyond_a_jump(
        &self,
        theta: f64,
        which: usize,
        there: &mut Probe,
        sight: impl Fn(f64) -> Probe,
    ) -> f64 {
        let size = self.probed[..self.count].iter().map(|l| l.events[which].abs()).fold(0.0, f64::max);
        let jumps = |probe: &Probe| probe.events[which] > JUMP * size;
        if !jumps(there) {
            return theta;
        }
        let mut beside = 1e-13;
        while beside < 1e-6 && theta + beside < 1.0 {
            let beyond = sight(theta + beside);
            if beyond.events[which] < 0.0 {
                *there = beyond;
                return theta + beside;
            }
            beside *= 2.0;
        }
        theta
    }

    /// The last probe before the fraction `theta`.
    pub(super) fn last_before(&self, theta: f64) -> Option<usize> {
        self.at[..self.count].iter().rposition(|&at| at < theta)
    }

    fn push(&mut self, at: f64, probe: Probe) {
        (self.at[self.count], self.probed[self.count]) = (at, probe);
        self.count += 1;
    }

    /// Number of probes, three at least.
    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// Where probe `j` is, as a fraction of the step.
    pub(super) fn at(&self, j: usize) -> f64 {
        self.at[j]
    }

    /// What probe `j` sees.
    pub(super) fn get(&self, j: usize) -> &Probe {
        &self.probed[j]
    }

    /// The last one.
    pub(super) fn end(&self) -> &Probe {
        &self.probed[self.count - 1]
    }

    /// Where the probes are.
    fn grid(&self) -> Grid<'_> {
        Grid { at: &self.at[..self.count] }
    }

    /// As [`Grid::beside`].
    pub(super) fn beside(&self, j: usize) -> (usize, usize) {
        self.grid().beside(j)
    }

    /// As [`Grid::overshoot`].
    pub(super) fn overshoot(&self, j: usize, value: impl Fn(usize) -> f64) -> f64 {
        self.grid().overshoot(j, value)
    }

    /// Where, as a fraction of the step, a function that is `after` < 0 at `to` falls through zero beyond probe `left`, to
    /// `width`. `of` reads it off a probe, `value` knows it anywhere inside the step; `None` where by that it is not negative
    /// at `to`.
    pub(super) fn crossing(
        &self,
        left: usize,
        to: f64,
        after: f64,
        of: impl Fn(&Probe) -> f64,
        width: f64,
        value: impl Fn(f64) -> f64,
    ) -> Result<Option<f64>, NeverPositive> {
        let (from, before) = (self.at[left], of(&self.probed[left]));
        let guess = self.zero(left, |j| of(&self.probed[j]));
        let root = |from: f64, to: f64, at_from: f64, at_to: f64| {
            root::bracketed_near(from, to, at_from, at_to, guess, width, &value)
        };
        // Probes inside a step are a little off `value`, which matters near them alone.
        let near = BESIDE_A_LOOK * (to - from);
        let inside = |theta: &f64| *theta > from + near && *theta < to - near;
        if before > 0.0
            && let Some(theta) = root(from, to, before, after).filter(inside)
        {
            return Ok(Some(theta));
        }
        let end = if to == 1.0 { after } else { value(to) };
        if end >= 0.0 {
            return Ok(None);
        }
        let mut start = (from, if left == 0 { before } else { value(from) });
        if start.1 <= 0.0 {
            // Starts at zero (a contact just released): find where it has become positive.
            let inside = [0.02, 0.1, 0.25, 0.5, 0.75].map(|f| from + f * (to - from));
            let mut values = inside.into_iter().map(|theta| (theta, value(theta)));
            start = values.find(|&(_, e)| e > 0.0).ok_or(NeverPositive)?;
        }
        Ok(root(start.0, to, start.1, end))
    }

    /// Where a function is zero between probe `left` and the next, by the parabola of the fraction over its values at those
    /// and at a third beside them: a guess, no number where it has none.
    fn zero(&self, left: usize, value: impl Fn(usize) -> f64) -> f64 {
        let (a, b) = (left, (left + 1).min(self.count - 1));
        let c = if b + 1 < self.count { b + 1 } else { left.saturating_sub(1) };
        let (fa, fb, fc) = (value(a), value(b), value(c));
        let rise = (self.at[b] - self.at[a]) / (fb - fa);
        let bend = ((self.at[c] - self.at[b]) / (fc - fb) - rise) / (fc - fa);
        self.at[a] - rise * fa + bend * fa * fb
    }

    /// As [`Grid::extreme`].
    pub(super) fn extreme(&self, j: usize, value: impl Fn(usize) -> f64) -> f64 {
        self.grid().extreme(j, value)
    }
}

/// Where a step is looked at, as fractions of its length: three places at least.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grid<'a> {
    pub(super) at: &'a [f64],
}

impl Grid<'_> {
    /// The probes beside `j`, itself at an end.
    #[inline]
    pub(super) fn beside(&self, j: usize) -> (usize, usize) {
        (j.saturating_sub(1), (j + 1).min(self.at.len() - 1))
    }

    /// The parabola through the probes about `j`: its second divided difference, the wider gap, where its top lies.
    #[inline]
    fn parabola(&self, j: usize, value: impl Fn(usize) -> f64) -> (f64, f64, f64) {
        let m = j.clamp(1, self.at.len() - 2);
        let x = [self.at[m - 1], self.at[m], self.at[m + 1]];
        let (bend, top) = parabola(x, [value(m - 1), value(m), value(m + 1)]);
        (bend, (x[1] - x[0]).max(x[2] - x[1]), top)
    }

    /// How far a function may rise between the probes beside `j` above all probes: the top of the parabola lies above the
    /// nearest of three points by at most g^2/4 |second divided difference|, g the wider gap; twice that is allowed for.
    /// 0 at an end that the parabola passes a quarter of a gap before its top, or where it has none: a function that bends
    /// upwards is largest at the end itself.
    #[inline]
    pub(super) fn overshoot(&self, j: usize, value: impl Fn(usize) -> f64) -> f64 {
        let (bend, gap, top) = self.parabola(j, value);
        let beyond = j == 0 && top < -0.25 * gap || j + 1 == self.at.len() && top > 1.0 + 0.25 * gap;
        if beyond { 0.0 } else { 0.5 * (-bend).max(0.0) * gap * gap }
    }

    /// Where the extreme beside probe `j` is to be looked for first.
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
