//! Sprags come to events at one time: places first, then the modes of all together.

use super::choose::as_it_is;
use super::found::{Apart, FirstSlip};
use super::run::Going;
use super::{EACH, HEAD, SpragMotion, state_of};
use crate::dynamics::change::moving;
use crate::dynamics::choose::Known;
use crate::dynamics::events::{EVENTS, INNER, LOWER, OUTER, UPPER};
use crate::dynamics::model::{Grip, Mode, Place};
use crate::dynamics::run::Stop;
use crate::ode::rhs::RightHandSide;
use crate::wedge::OverEnd;

/// Which event functions of which group have fallen at one time.
pub(super) type Falls = Vec<[bool; EVENTS]>;

/// How far a run goes on where no mode is better than one that contradicts itself, s.
const NUDGE_S: f64 = 1e-12;

impl<const N: usize> Going<'_, N> {
    /// Rates of all sprags with their rolling constraints put in exactly.
    pub(super) fn hold(&mut self) {
        for (g, motion) in self.rhs.motions.iter().enumerate().filter(|(_, m)| !m.waits) {
            let own = state_of(&self.y, g);
            let sight = self.rhs.stands(g, motion.mode.place, self.t_s, &self.y, &own);
            let [da, dp, ..] = self.rhs.goes(g, &motion.mode, &sight, &self.y, &own);
            let at = HEAD + EACH * g;
            (self.y[at + 2], self.y[at + 3]) = (da, dp);
        }
    }

    /// The events `falls` happen now. False: the run has ended.
    pub(super) fn change(&mut self, falls: &Falls) -> bool {
        for (g, _) in falls.iter().enumerate().filter(|(_, fell)| fell.contains(&true)) {
            if !self.count_event(g) {
                return false;
            }
        }
        self.hold();
        let (t, y) = (self.t_s, self.y);
        self.rhs.look::<true>(t, &y);
        let before = self.rhs.motions.clone();
        let mut known: Vec<_> = before.iter().map(|motion| as_it_is(&motion.mode)).collect();
        for (g, fell) in falls.iter().enumerate() {
            let (mode, Some(seen)) = (before[g].mode, self.rhs.seen[g]) else { continue };
            if mode.place == Place::Carried {
                continue;
            }
            // T_bi = -sgn(v_A) mu N, T_be = +sgn(v_B) mu N.
            let slips = [-seen.forces.t_bi, seen.forces.t_be];
            for (contact, (which, grip)) in [(INNER, mode.inner), (OUTER, mode.outer)].into_iter().enumerate()
            {
                if fell[which] {
                    known[g][contact] = match grip {
                        Grip::Stick => Known::Released(slips[contact].signum()),
                        Grip::Slip(_) => Known::Still,
                    };
                }
            }
        }
        let mut left: Vec<usize> = (0..falls.len()).filter(|&g| falls[g][LOWER] || falls[g][UPPER]).collect();
        self.catch_up(falls, &mut known);
        let taken = self.take_along(falls);
        let mut jumps = vec![!taken.is_empty(); falls.len()];
        left.retain(|g| !taken.contains(g));
        while let Some(&g) = left.first() {
            if before[g].waits {
                if !self.stays_off(g) {
                    self.touches(g);
                }
                known[g] = [Known::Still; 2];
                left.remove(0);
                continue;
            }
            let Some(place) = self.goes_to(g, if falls[g][LOWER] { LOWER } else { UPPER }) else {
                if self.out.stop != Stop::Finished {
                    return false;
                }
                self.is_gone(g);
                left.remove(0);
                continue;
            };
            let alike = |other: &usize| self.same(g, *other) && falls[*other] == falls[g];
            let those: Vec<usize> = left.iter().copied().filter(alike).collect();
            left.retain(|other| !those.contains(other));
            let touching = before[g].mode.place == Place::Open;
            let pushed = self.cross(&those, place);
            for &g in &those {
                // A closed contact that touches begins in slip unless v = 0.
                if touching {
                    known[g][0] = Known::Slips(1.0);
                }
                jumps[g] = true;
            }
            jumps.iter_mut().for_each(|jumps| *jumps |= pushed);
        }
        self.turn_round(&mut known, &jumps);
        self.choose(&known, &before, |g| falls[g].contains(&true))
    }

    /// The velocities of some have jumped: slips go on in the sense that they have now.
    fn turn_round(&mut self, known: &mut [[Known; 2]], jumps: &[bool]) {
        let free = |m: &SpragMotion| !m.waits && m.mode.place != Place::Carried;
        for (g, motion) in self.rhs.motions.iter().enumerate().filter(|(g, m)| jumps[*g] && free(m)) {
            let (model, own) = (&self.groups[g].model, state_of(&self.y, g));
            let q = self.rhs.stands(g, motion.mode.place, self.t_s, &self.y, &own);
            let rates = self.rhs.goes(g, &motion.mode, &q, &self.y, &own);
            let (v_a, v_b) = model.slip_velocities(&q.point, &rates);
            for (known, v) in known[g].iter_mut().zip([v_a, v_b]) {
                if matches!(known, Known::Slips(_)) {
                    *known = moving(v);
                }
            }
        }
    }

    /// Where group `g` goes beyond the end `which` of its place; `None`: the run has ended.
    fn goes_to(&mut self, g: usize, which: usize) -> Option<Place> {
        let model = &self.groups[g].model;
        let at = HEAD + EACH * g;
        // Exactly at the bound; first contact is left only a little below it.
        match (which, self.rhs.motions[g].mode.place) {
            (LOWER, Place::Arc(0)) => Some(Place::Open),
            (LOWER, Place::Arc(k)) => {
                self.y[at] = model.curve.arc_end_rad(k - 1);
                Some(Place::Arc(k - 1))
            }
            (LOWER, _) => {
                self.stop(Stop::FellAway, Some(g));
                None
            }
            (_, Place::Arc(k)) if k + 1 < model.curve.place_count() => {
                if k + 1 == model.curve.arc_count() {
                    self.out.courses[g].over_s.get_or_insert(self.t_s);
                }
                self.y[at] = model.curve.arc_end_rad(k);
                Some(Place::Arc(k + 1))
            }
            (_, Place::Arc(_)) => {
                if self.groups[g].over == Some(OverEnd::ContactLost) {
                    if (0..self.groups.len()).any(|other| other != g && !self.rhs.motions[other].gone) {
                        return None;
                    }
                    // The last of all.
                    self.out.courses[g].gone_s = Some(self.t_s);
                }
                self.stop(Stop::CurveEnd, Some(g));
                None
            }
            _ => {
                self.y[at] = self.rhs.touch_rad(g, &self.y);
                Some(Place::Arc(model.curve.arc_at(self.y[at])))
            }
        }
    }

    /// Group `g` has gone over and lost contact: it bears nothing any more. What it has stored and how it moves goes with it.
    fn is_gone(&mut self, g: usize) {
        let before = self.rhs.energy_j(self.t_s, &self.y);
        self.out.courses[g].gone_s = Some(self.t_s);
        self.rhs.motions[g] = SpragMotion { gone: true, ..SpragMotion::waiting() };
        self.appeared_j += self.rhs.energy_j(self.t_s, &self.y) - before;
    }

    /// Whether groups `g` and `other` cross as one: alike in what moves, and in one state to the last bit.
    fn same(&self, g: usize, other: usize) -> bool {
        let [a, b] = [g, other].map(|g| &self.groups[g].model);
        let [p, q] = [g, other].map(|g| &self.rhs.motions[g]);
        let bits = |g: usize| state_of(&self.y, g).map(f64::to_bits);
        a.count == b.count
            && a.curve.first_contact_rad() == b.curve.first_contact_rad()
            && p.mode == q.mode
            && p.waits == q.waits
            && bits(g)[..8] == bits(other)[..8]
    }

    /// A sprag that has waited is at first contact and rolls as the races do.
    fn touches(&mut self, g: usize) {
        let at = HEAD + EACH * g;
        self.y[at] = self.rhs.touch_rad(g, &self.y);
        if self.rhs.axes.is_some() {
            // It has been turned along with the outer race.
            self.y[at + 1] = self.y[1];
        }
        let mode = Mode { place: Place::Arc(0), inner: Grip::Stick, outer: Grip::Stick };
        self.rhs.motions[g] = SpragMotion::touching(mode);
        self.hold();
        self.appeared_j += self.rhs.energy_of_j(g, self.t_s, &self.y);
    }

    /// The consistent modes of all; `entered`: which begin anew even in the mode that they had `before`. False: the run has ended.
    fn choose(
        &mut self,
        known: &[[Known; 2]],
        before: &[SpragMotion],
        entered: impl Fn(usize) -> bool,
    ) -> bool {
        let (t, y) = (self.t_s, self.y);
        let consistent = self.rhs.choose(t, &y, known);
        self.out.inconsistent_choices += u64::from(!consistent);
        for (g, before) in before.iter().enumerate() {
            let motion = self.rhs.motions[g];
            if motion.waits || !entered(g) && motion.mode == before.mode {
                continue;
            }
            if !entered(g) && !self.count_event(g) {
                return false;
            }
            self.enter(g, before);
        }
        true
    }

    /// Event functions `falls` are negative right at the start: chosen again with every still contact free.
    pub(super) fn give_way(&mut self, falls: &Falls) -> bool {
        let ends = |fell: &[bool; EVENTS]| fell[LOWER] || fell[UPPER];
        if falls
            .iter()
            .enumerate()
            .any(|(g, fell)| self.rhs.motions[g].waits && fell.contains(&true) || ends(fell))
        {
            return self.change(falls);
        }
        self.hold();
        let before = self.rhs.motions.clone();
        let mut known: Vec<_> = before.iter().map(|motion| as_it_is(&motion.mode)).collect();
        for (known, fell) in known.iter_mut().zip(falls) {
            for (known, which) in known.iter_mut().zip([INNER, OUTER]) {
                if fell[which] {
                    *known = Known::Still;
                }
            }
        }
        self.catch_up(falls, &mut known);
        if !self.choose(&known, &before, |_| false) {
            return false;
        }
        if before.iter().zip(&self.rhs.motions).any(|(before, now)| before.mode != now.mode) {
            return true;
        }
        // Nothing better: on in these modes for a step that rounding cannot undo, twice as far where that has just been so; a slip
        // against its sign then turns round.
        if !self.count_event(0) {
            return false;
        }
        let Ok(slope) = self.rhs.slope(self.t_s, &self.y) else {
            self.stop(Stop::NotFinite, None);
            return false;
        };
        let again = self.t_s - self.nudged.0 <= self.nudged.1;
        let nudge_s = if again { 2.0 * self.nudged.1 } else { NUDGE_S };
        self.t_s += nudge_s;
        self.nudged = (self.t_s, nudge_s);
        for (y, rate) in self.y.iter_mut().zip(slope) {
            *y += nudge_s * rate;
        }
        for g in (0..falls.len()).filter(|&g| falls[g].contains(&true)) {
            let own = state_of(&self.y, g);
            let mode = self.rhs.motions[g].mode;
            let sight = self.rhs.stands(g, mode.place, self.t_s, &self.y, &own);
            let rates = self.rhs.goes(g, &mode, &sight, &self.y, &own);
            let (v_a, v_b) = self.groups[g].model.slip_velocities(&sight.point, &rates);
            let with = |grip: Grip, v: f64| match grip {
                Grip::Slip(s) if s * v < 0.0 => Grip::Slip(-s),
                _ => grip,
            };
            let before = self.rhs.motions[g];
            self.rhs.motions[g].mode =
                Mode { inner: with(mode.inner, v_a), outer: with(mode.outer, v_b), ..mode };
            self.enter(g, &before);
        }
        true
    }

    /// Group `g` goes on in the mode that it has now, `before` it was another.
    pub(super) fn enter(&mut self, g: usize, before: &SpragMotion) {
        let model = &self.groups[g].model;
        let own = state_of(&self.y, g);
        let mode = self.rhs.motions[g].mode;
        let sight = self.rhs.stands(g, mode.place, self.t_s, &self.y, &own);
        let p = sight.point;
        let closed = |mode: &Mode| matches!(mode.place, Place::Arc(_));
        let both = mode.inner == Grip::Stick && mode.outer == Grip::Stick;
        self.rhs.motions[g].phase = (both && closed(&mode)).then(|| own[2] - own[3] + p.windup);
        let [da, dp, ..] = self.rhs.goes(g, &mode, &sight, &self.y, &own);
        let at = HEAD + EACH * g;
        (self.y[at + 2], self.y[at + 3]) = (da, dp);
        let course = &mut self.out.courses[g];
        if course.catches_s.is_none() && closed(&mode) && mode.inner != Grip::Slip(1.0) {
            course.catches_s = Some(self.t_s);
            course.before_m = [course.net_m[0], course.path_m[0]];
        } else if course.catches_s.is_some()
            && course.slips.is_none()
            && closed(&before.mode)
            && closed(&mode)
        {
            let begins = |from: Grip, to: Grip| from == Grip::Stick && to != Grip::Stick;
            let [a, b] = [begins(before.mode.inner, mode.inner), begins(before.mode.outer, mode.outer)];
            let under_load = (a || b) && p.n_bi >= model.loaded_n;
            course.slips = under_load.then_some(FirstSlip { t_s: self.t_s, inner: a, normal_n: p.n_bi });
        }
        match (mode.place == Place::Open || mode.is_off(), self.apart[g]) {
            (true, None) => {
                self.apart[g] = Some(Apart { since_s: self.t_s, caught: course.catches_s.is_some() });
            }
            (false, Some(apart)) => {
                course.end_apart(apart, before.mode.place, self.t_s);
                self.apart[g] = None;
            }
            _ => {}
        }
    }
}
