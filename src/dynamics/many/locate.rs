//! The first events in a step: which event functions of which sprags fall through zero there, together.

use super::PROBES;
use super::change::Falls;
use super::run::{AT_ONCE_S, Going};
use crate::dynamics::cusp::cusp;
use crate::dynamics::events::{EVENTS, INNER, LOWER, OUTER, Probe};
use crate::dynamics::probes::{NeverPositive, Probes};
use crate::dynamics::watch::highest;
use crate::ode::dop853;
use crate::wedge::RHO_STEEPEST_RAD;

/// How exactly the change of a grip is located, as a fraction of a step over the tolerance, and at least; as of one sprag.
const WIDTH: [f64; 2] = [1e-5, 1e-13];
/// From here on, as a fraction of the way to an event, another is at the same time: sprags alike come to theirs together.
const TOGETHER: f64 = 1.0 - 1e-10;
/// In a step that has been cut at an event that function tells nothing from here on.
const AT_ITS_END: f64 = 0.9;

/// What a step comes to.
pub(super) enum First {
    Nothing,
    /// These, at this fraction of it.
    At(f64, Falls),
    /// These, up to this fraction of it, but from its start on.
    AtOnce(f64, Falls),
}

/// A step on which events are looked for, its dense output once that is asked for.
struct Sought<'s, const N: usize> {
    step: &'s dop853::Step<N>,
    dense: Option<dop853::Dense<N>>,
    /// Zeros found: where, whose, which.
    zeros: Vec<(f64, usize, usize)>,
}

impl<const N: usize> Going<'_, N> {
    /// The first events in `step` but for `cut`, which lie at its end.
    pub(super) fn first_events(&mut self, step: &dop853::Step<N>, cut: &Falls) -> Result<First, ()> {
        let mut sought = Sought { step, dense: None, zeros: Vec::new() };
        let mut early = vec![[false; EVENTS]; self.groups.len()];
        for to in 1..PROBES {
            for g in 0..self.groups.len() {
                for which in 0..EVENTS {
                    let after = self.rhs.probes[to][g].events[which];
                    if after >= 0.0 || cut[g][which] && to + 1 == PROBES {
                        continue;
                    }
                    let probes = self.probes(g);
                    let (left, at) = (to - 1, dop853::PROBES[to]);
                    match self.zero(&mut sought, &probes, (g, which), left, at, after)? {
                        Ok(Some(zero)) if self.stays(step, zero, (g, which)) => early[g][which] = true,
                        Ok(Some(zero)) if cut[g][which] && zero > AT_ITS_END => {}
                        Ok(Some(zero)) => sought.zeros.push((zero, g, which)),
                        Ok(None) => {}
                        Err(NeverPositive) => early[g][which] = true,
                    }
                }
            }
            if early.iter().flatten().any(|&fell| fell) {
                return Ok(First::AtOnce(dop853::PROBES[to], early));
            }
            if !sought.zeros.is_empty() {
                return self.earliest(&mut sought);
            }
        }
        self.dips(&mut sought, cut)?;
        if sought.zeros.is_empty() {
            self.before_the_cusp(&mut sought, cut)?;
        }
        if sought.zeros.is_empty() { Ok(First::Nothing) } else { self.earliest(&mut sought) }
    }

    /// What has been seen of group `g` in the step.
    pub(super) fn probes(&self, g: usize) -> Probes {
        Probes::of(|j| (dop853::PROBES[j], self.rhs.probes[j][g]), PROBES)
    }

    /// Whether the zero of that function is where it has just been zero: what lies between is rounding.
    fn stays(&self, step: &dop853::Step<N>, zero: f64, (g, which): (usize, usize)) -> bool {
        step.t + zero * step.h - self.landed.0 <= AT_ONCE_S && self.landed.1[g][which]
    }

    /// The first of the zeros, and those that fall together with it.
    fn earliest(&mut self, sought: &mut Sought<N>) -> Result<First, ()> {
        let first = sought.zeros.iter().map(|zero| zero.0).fold(f64::INFINITY, f64::min);
        let mut falls = vec![[false; EVENTS]; self.groups.len()];
        let mut last = first;
        for &(zero, g, which) in sought.zeros.iter().filter(|zero| TOGETHER * zero.0 <= first) {
            falls[g][which] = true;
            last = last.max(zero);
        }
        let Some(&(_, g, which)) = sought.zeros.iter().find(|zero| zero.0 == last) else {
            return Ok(First::Nothing);
        };
        let probes = self.probes(g);
        let d = self.dense(sought)?;
        let (t, h) = (sought.step.t, sought.step.h);
        let mut there = self.rhs.sight(g, t + last * h, &d.after(last * h));
        let rhs = std::cell::RefCell::new(&mut self.rhs);
        let sight = |part: f64| rhs.borrow_mut().sight(g, t + part * h, &d.after(part * h));
        Ok(First::At(probes.beyond_a_jump(last, which, &mut there, sight), falls))
    }

    fn dense(&mut self, sought: &mut Sought<N>) -> Result<dop853::Dense<N>, ()> {
        if sought.dense.is_none() {
            sought.dense = Some(sought.step.dense(&mut self.rhs, &mut self.out.counters)?);
        }
        sought.dense.clone().ok_or(())
    }

    /// Where a function that is `after` < 0 at the fraction `to` falls through zero beyond probe `left`.
    fn zero(
        &mut self,
        sought: &mut Sought<N>,
        probes: &Probes,
        (g, which): (usize, usize),
        left: usize,
        to: f64,
        after: f64,
    ) -> Result<Result<Option<f64>, NeverPositive>, ()> {
        let d = self.dense(sought)?;
        let grips = which == INNER || which == OUTER;
        let width = if grips { WIDTH[0] * self.settings.tolerance } else { 0.0 };
        let rhs = std::cell::RefCell::new(&mut self.rhs);
        let (t, h) = (sought.step.t, sought.step.h);
        let value = |part: f64| rhs.borrow_mut().event(g, which, t + part * h, &d.after(part * h));
        Ok(probes.crossing(left, to, after, |probe: &Probe| probe.events[which], width.max(WIDTH[1]), value))
    }

    /// Functions that dip below zero between two probes and rise again.
    fn dips(&mut self, sought: &mut Sought<N>, cut: &Falls) -> Result<(), ()> {
        let functions = (0..self.groups.len()).flat_map(|g| (0..EVENTS).map(move |which| (g, which)));
        for (g, which) in functions {
            for j in 1..PROBES {
                let e = |j: usize| self.rhs.probes[j][g].events[which];
                let (left, right) = (j - 1, (j + 1).min(PROBES - 1));
                if cut[g][which] && j + 1 == PROBES || !(e(j) <= e(left) && e(j) <= e(right)) {
                    continue;
                }
                let probes = self.probes(g);
                let of = |j: usize| probes.get(j).events[which];
                if of(j) >= probes.overshoot(j, |j| -of(j)) {
                    continue;
                }
                let d = self.dense(sought)?;
                let (t, h) = (sought.step.t, sought.step.h);
                let rhs = &mut self.rhs;
                let value = |part: f64| -rhs.event(g, which, t + part * h, &d.after(part * h));
                let (from, until) = (probes.at(left), probes.at(right));
                let (bottom, depth) = highest(from, probes.extreme(j, of), until, 0.0, 0.0, value);
                if depth <= 0.0 {
                    continue;
                }
                if let Ok(Some(zero)) = self.zero(sought, &probes, (g, which), left, bottom, -depth)?
                    && !(cut[g][which] && zero > AT_ITS_END)
                    && !self.stays(sought.step, zero, (g, which))
                {
                    sought.zeros.push((zero, g, which));
                }
            }
        }
        Ok(())
    }

    /// In a step that has been cut where a contact is lost: what shows only near that cusp, as in the one-sprag model.
    fn before_the_cusp(&mut self, sought: &mut Sought<N>, cut: &Falls) -> Result<(), ()> {
        for g in (0..self.groups.len()).filter(|&g| cut[g][LOWER]) {
            let motion = self.rhs.motions[g];
            if motion.waits || cusp(motion.mode.place) != Some(LOWER) {
                continue;
            }
            let rate = sought.step.y1[super::HEAD + super::EACH * g + 2];
            let near = 1.0 - RHO_STEEPEST_RAD / (rate * sought.step.h).abs();
            let probes = self.probes(g);
            let Some(left) = probes.last_before(near) else { continue };
            let d = self.dense(sought)?;
            let elapsed = near * sought.step.h;
            let there = self.rhs.sight(g, sought.step.t + elapsed, &d.after(elapsed)).events;
            for which in [INNER, OUTER].into_iter().filter(|&which| there[which] < 0.0 && !cut[g][which]) {
                if let Ok(Some(zero)) = self.zero(sought, &probes, (g, which), left, near, there[which])? {
                    sought.zeros.push((zero, g, which));
                }
            }
        }
        Ok(())
    }
}
