//! Steps up to the first event of any sprag.

use super::axes::{AXIS, Axes};
use super::bending::Rings;
use super::change::Falls;
use super::found::{Apart, FirstSlip, ManyRun, SpragCourse};
use super::locate::First;
use super::rhs::Rhs;
use super::{
    BendingWork, EACH, FIRST_WORK, HEAD, ManyStart, PROBES, SpragGroup, SpragMotion, WORKS, state_of,
};
use crate::dynamics::cusp::towards_the_cusp_s;
use crate::dynamics::events::{EVENTS, INNER, N_BI, OUTER};
use crate::dynamics::model::{Grip, Mode, N_STATE, Place};
use crate::dynamics::run::{RunSettings, Stop};
use crate::numeric::root;
use crate::ode::dop853;
use crate::ode::rhs::RightHandSide;
use crate::ode::step::{Counters, Tolerance};

/// Shortest step, s.
const SHORTEST_S: f64 = 1e-15;
/// A step begun at an event that falls at once is tried shorter down to this, s.
pub(super) const AT_ONCE_S: f64 = 1e-13;
/// Two events this near, as a fraction of the way there, are one.
const CLOSE: f64 = 1.0 - 1e-10;
/// tan omega, about, for tolerances.
const LEVER: f64 = 0.1;
/// Kinds of motion whose step lengths are remembered: whether any A slips, any B slips, any sprag is open or carried by a cage.
const KINDS: usize = 8;

/// Integrate `groups` from `start`; `settings` as of one sprag, of which samples and history beyond equidistant ones, energy, jumps
/// and pure rolling mean nothing here. Up to 64 groups.
/// `axes`: where these do not meet or may give way, no cage carries there; `rings`: where the races bend, for groups of one sprag each.
pub fn run_many(
    groups: &[SpragGroup],
    axes: Option<&Axes>,
    rings: Option<&Rings>,
    start: &ManyStart,
    settings: &RunSettings,
) -> ManyRun {
    const fn length(groups: usize) -> usize {
        HEAD + EACH * groups
    }
    match (groups.len(), axes) {
        (0..=4, None) => Going::<{ length(4) }>::new(groups, None, rings, start, settings).run(),
        (_, None) => Going::<{ length(64) }>::new(groups, None, rings, start, settings).run(),
        (_, axes) => Going::<{ length(64) + AXIS }>::new(groups, axes, rings, start, settings).run(),
    }
}

/// A run on its way.
pub(super) struct Going<'a, const N: usize> {
    pub(super) groups: &'a [SpragGroup],
    pub(super) settings: &'a RunSettings,
    pub(super) rhs: Rhs<'a>,
    pub(super) t_s: f64,
    pub(super) y: [f64; N],
    pub(super) out: ManyRun,
    /// When sprags have come to an event last, s, and which functions fell.
    pub(super) landed: (f64, Falls),
    /// Where no mode was better last: when it went on, s, and how far it had gone, s.
    pub(super) nudged: (f64, f64),
    /// Where each is without contact now.
    pub(super) apart: Vec<Option<Apart>>,
    /// Last step length by kind of motion, s: in slip a sprag is a hundred times faster than the races.
    lengths: [f64; KINDS],
    start_j: f64,
    /// Energy of sprags that were turned along before they touched, or that a cage takes along or lets go, J.
    pub(super) appeared_j: f64,
}

/// What a step of the run comes to.
enum Went {
    /// Its end, with the slope there.
    On,
    /// An event.
    Changed,
    /// Nothing: it is tried again, this long.
    Again(f64),
    /// The end of the run.
    Ended,
}

impl<'a, const N: usize> Going<'a, N> {
    fn new(
        groups: &'a [SpragGroup],
        axes: Option<&'a Axes>,
        rings: Option<&'a Rings>,
        start: &ManyStart,
        settings: &'a RunSettings,
    ) -> Self {
        let mut y = [0.0; N];
        y[..4].copy_from_slice(&start.races);
        for (g, s) in start.sprags.iter().enumerate() {
            let at = HEAD + EACH * g;
            (y[at], y[at + 1], y[at + 2], y[at + 3]) = (s[0], s[2], s[1], s[3]);
        }
        let n = groups.len();
        if axes.is_some_and(|axes| axes.bearing.is_some()) {
            let at = HEAD + EACH * n;
            y[at..at + 2].copy_from_slice(&start.shift_m);
        }
        let out = ManyRun {
            stop: Stop::Finished,
            at_group: None,
            t_s: 0.0,
            races: start.races,
            sprags: Vec::new(),
            bearing_max_n: 0.0,
            bearing_max_s: 0.0,
            axis_max_m: 0.0,
            courses: vec![SpragCourse::default(); n],
            samples: Vec::with_capacity(settings.samples),
            events: 0,
            inconsistent_choices: 0,
            counters: Counters::default(),
            looks: 0,
            bending: BendingWork::default(),
            residual_j: 0.0,
            through_j: 0.0,
        };
        // The windup of a start under load counts from no load, that of an overrun from where the races turn back.
        let reference_rad = (y[1] - y[0]).min(0.0);
        let rhs = Rhs::new(groups, axes, rings, start.motions.clone(), reference_rad);
        let mut going = Self {
            groups,
            settings,
            rhs,
            t_s: 0.0,
            y,
            out,
            landed: (f64::NAN, vec![[false; EVENTS]; n]),
            nudged: (f64::NAN, 0.0),
            apart: vec![None; n],
            lengths: [f64::INFINITY; KINDS],
            start_j: 0.0,
            appeared_j: 0.0,
        };
        for (g, motion) in start.motions.iter().enumerate().filter(|(_, motion)| !motion.waits) {
            going.enter(g, motion);
        }
        going.start_j = going.rhs.energy_j(0.0, &going.y);
        going
    }

    fn run(mut self) -> ManyRun {
        self.settings.follow.begin_run();
        // A contact that cannot hold where the run begins lets go at once.
        self.rhs.look::<true>(0.0, &self.y);
        let now = (0..self.groups.len()).map(|g| self.rhs.probe(g, 0.0, &self.y).events);
        let grips = |i: usize| i == INNER || i == OUTER;
        let falls: Falls = now.map(|e| std::array::from_fn(|i| grips(i) && e[i] < 0.0)).collect();
        if !falls.iter().flatten().any(|&fell| fell) || self.give_way(&falls) {
            self.integrate();
        }
        self.finish()
    }

    fn integrate(&mut self) {
        let mut step = Box::new(dop853::Step::<N>::new());
        let (mut h, mut slope) = (0.1 * self.settings.longest_step_s, None::<[f64; N]>);
        // The length before a step was shortened because a function fell at its start.
        let mut once = None;
        let until = self.settings.duration_s;
        self.sample_start();
        while self.t_s < until && self.out.stop == Stop::Finished {
            let drive = &self.groups[0].model.drive;
            if self.settings.follow.stopped() {
                return self.stop(Stop::Interrupted, None);
            }
            self.settings.follow.tell(self.t_s);
            let past = drive.past_break_s(self.t_s);
            if past >= until {
                self.t_s = until;
                return;
            }
            if past != self.t_s {
                (self.t_s, slope) = (past, None);
            }
            let (t, y) = (self.t_s, self.y);
            let s0 = match slope.take() {
                Some(slope) => slope,
                None => {
                    self.out.counters.rhs_evaluations += 1;
                    match self.rhs.slope_at_probe(0, t, &y) {
                        Ok(slope) => slope,
                        Err(()) => return self.stop(Stop::NotFinite, None),
                    }
                }
            };
            let rest = until.min(drive.next_break_s(t)) - t;
            let rest = rest.min(self.towards_a_cusp_s());
            let tolerance = self.tolerance();
            let Some(next) = self.step(&mut step, &s0, h, rest, &tolerance) else { return };
            let kind = self.kind();
            match self.advance(&mut step, &s0, &tolerance) {
                Went::On => {
                    (h, slope) = (once.take().unwrap_or(next), Some(*step.slope1()));
                    self.rhs.probes.swap(0, PROBES - 1);
                    self.rhs.bearing_probes_n.swap(0, PROBES - 1);
                }
                Went::Changed => {
                    // A step that was short because the event was expected says little of the next in this kind of motion.
                    h = once.take().unwrap_or(next).max(self.lengths[kind].min(h));
                    let now = self.kind();
                    if now != kind {
                        self.lengths[kind] = h;
                        h = if self.lengths[now].is_finite() { self.lengths[now] } else { h };
                    }
                }
                Went::Again(shorter) => {
                    once = once.or(Some(next));
                    (h, slope) = (shorter, Some(s0));
                }
                Went::Ended => return,
            }
        }
    }

    /// Whether any A slips, any B slips, any sprag is open or carried by a cage.
    fn kind(&self) -> usize {
        let touching = || self.rhs.motions.iter().filter(|m| !m.waits).map(|m| m.mode);
        let slips = |grip: Grip| matches!(grip, Grip::Slip(_));
        let apart = |m: &Mode| matches!(m.place, Place::Open | Place::Carried);
        usize::from(touching().any(|m| slips(m.inner) && !apart(&m)))
            + 2 * usize::from(touching().any(|m| slips(m.outer)))
            + 4 * usize::from(touching().any(|m| apart(&m)))
    }

    /// Take a step of about `h`, at most `rest`; the length of the next. `None`: the run has ended.
    fn step(
        &mut self,
        step: &mut dop853::Step<N>,
        s0: &[f64; N],
        h: f64,
        rest: f64,
        tolerance: &Tolerance<N>,
    ) -> Option<f64> {
        let (t, y) = (self.t_s, self.y);
        let mut tried = h.min(self.settings.longest_step_s).min(rest);
        let mut rejected = false;
        loop {
            let work = self.out.counters.steps + self.out.counters.rejections;
            if tried < SHORTEST_S && tried < rest || work >= self.settings.most_steps {
                self.stop(Stop::StepLimit, None);
                return None;
            }
            let counters = &mut self.out.counters;
            match step.take(&mut self.rhs, t, &y, s0, tried, tolerance, 1.0, counters) {
                Ok(()) if step.error <= 1.0 => break,
                Ok(()) => tried = step.next_h().min(0.9 * tried),
                Err(()) => tried *= 0.25,
            }
            self.out.counters.rejections += 1;
            rejected = true;
        }
        Some(match (rejected, tried == rest) {
            // What was cut short from outside says nothing against the length before.
            (false, true) => h.max(step.next_h()),
            (false, false) => step.next_h(),
            // No longer at once after a rejection: a step bounded by stability would be rejected every other time.
            (true, _) => step.next_h().min(tried),
        })
    }

    /// Take over `step` up to its first events.
    fn advance(&mut self, step: &mut dop853::Step<N>, s0: &[f64; N], tolerance: &Tolerance<N>) -> Went {
        let (t, y) = (self.t_s, self.y);
        let mut cut: Falls = vec![[false; EVENTS]; self.groups.len()];
        let mut events = false;
        // Up to the first events: a step of its own, whose stages lie in one mode.
        loop {
            match self.first_events(step, &cut) {
                Err(()) => return self.fail(),
                Ok(First::Nothing) => break,
                Ok(First::At(part, falls)) => {
                    if events && part > CLOSE {
                        // Together with those at its end.
                        cut.iter_mut().flatten().zip(falls.iter().flatten()).for_each(|(a, b)| *a |= b);
                        break;
                    }
                    (events, cut) = (true, falls);
                    let to = part * step.h;
                    if t + to == t {
                        step.h = 0.0;
                        break;
                    }
                    let counters = &mut self.out.counters;
                    if step.take(&mut self.rhs, t, &y, s0, to, tolerance, f64::INFINITY, counters).is_err() {
                        return self.fail();
                    }
                }
                Ok(First::AtOnce(part, falls)) => {
                    let h = 0.125 * part * step.h;
                    if h > AT_ONCE_S {
                        return Went::Again(h);
                    }
                    // Nothing has moved.
                    return if self.give_way(&falls) { Went::Changed } else { Went::Ended };
                }
            }
        }
        if step.h > 0.0 && self.accept(step).is_err() {
            return self.fail();
        }
        if !events {
            return Went::On;
        }
        self.landed = (self.t_s, cut);
        let falls = self.landed.1.clone();
        if self.change(&falls) { Went::Changed } else { Went::Ended }
    }

    fn fail(&mut self) -> Went {
        self.stop(Stop::NotFinite, None);
        Went::Ended
    }

    pub(super) fn count_event(&mut self, g: usize) -> bool {
        self.out.events += 1;
        if self.out.events > self.settings.most_events {
            self.stop(Stop::EventLimit, Some(g));
            return false;
        }
        true
    }

    pub(super) fn stop(&mut self, why: Stop, at: Option<usize>) {
        (self.out.stop, self.out.at_group) = (why, at);
    }

    /// As of one sprag ([`RunSettings::tolerance_in`]), each by its own mode.
    fn tolerance(&self) -> Tolerance<N> {
        let (absolute, none) = ([f64::INFINITY; N], [0.0; N]);
        let mut all = Tolerance { relative: 0.0, absolute, integrated: none, datum: none };
        for (g, motion) in self.rhs.motions.iter().enumerate().filter(|(_, m)| !m.waits) {
            let own = self.settings.tolerance_in::<N_STATE>(&motion.mode);
            all.relative = own.relative.max(all.relative);
            let a = own.absolute;
            for (i, from) in [2, 3, 6, 7].into_iter().enumerate() {
                all.absolute[i] = all.absolute[i].min(a[from]);
            }
            let at = HEAD + EACH * g;
            all.absolute[at..at + EACH].copy_from_slice(&[a[0], a[1], a[4], a[5], a[8], a[9]]);
        }
        if let Some((_, at)) = self.rhs.moved() {
            // What the axis moves by is to a sprag as much windup as by this over OA tan omega.
            let arm = LEVER * self.groups[0].model.curve.touch().lengths.oa.v;
            for (i, from) in [0, 0, 2, 2].into_iter().enumerate() {
                all.absolute[at + i] = arm * all.absolute[from];
            }
        }
        all
    }

    fn towards_a_cusp_s(&self) -> f64 {
        self.rhs.bend(&self.y);
        let one = |(g, motion): (usize, &SpragMotion)| {
            if motion.waits {
                return f64::INFINITY;
            }
            let s = state_of(&self.y, g);
            towards_the_cusp_s(&motion.mode, self.rhs.pressed_there_rad(g, s[0]), s[4])
        };
        self.rhs.motions.iter().enumerate().map(one).fold(f64::INFINITY, f64::min)
    }

    /// Take over `step`: samples, extremes, slips, the constraint.
    fn accept(&mut self, step: &dop853::Step<N>) -> Result<(), ()> {
        self.out.counters.steps += 1;
        self.watch(step)?;
        self.sample(step)?;
        let (t, before) = (step.t + step.h, self.y);
        let mut y = step.y1;
        for (g, motion) in self.rhs.motions.iter().enumerate().filter(|(_, m)| !m.waits) {
            let at = HEAD + EACH * g;
            let end = &self.rhs.probes[PROBES - 1][g];
            if let Some(phase) = motion.phase {
                // Rolling keeps theta_bi - theta_be = -W(alpha): one Newton step removes the drift of the step.
                y[at] -= (y[0] - y[1] + end.windup - phase) / end.rho;
            }
            if motion.mode.place != Place::Open && !motion.mode.is_off() {
                let slips = [motion.mode.inner, motion.mode.outer].map(|grip| matches!(grip, Grip::Slip(_)));
                let (course, normal_n) = (&mut self.out.courses[g], end.figures[N_BI]);
                // A slip that began unloaded goes on under load.
                let loaded = normal_n > 0.0
                    && normal_n >= self.groups[g].model.loaded_n
                    && motion.mode.place != Place::Carried;
                if course.catches_s.is_some() && course.slips.is_none() && slips.contains(&true) && loaded {
                    course.slips = Some(FirstSlip { t_s: t, inner: slips[0], normal_n });
                }
                for contact in 0..2 {
                    let slipped = y[at + 4 + contact] - before[at + 4 + contact];
                    self.out.courses[g].net_m[contact] += slipped;
                    self.out.courses[g].path_m[contact] += slipped.abs();
                }
            }
            if motion.mode.place == Place::Carried && self.out.courses[g].catches_s.is_some() {
                self.out.courses[g].carried_m += (y[at + 5] - before[at + 5]).abs();
            }
        }
        if self.rhs.motions.iter().any(|m| m.waits) {
            self.turn_back(step)?;
        }
        (self.t_s, self.y) = (t, y);
        Ok(())
    }

    /// The windup counts from where the races have turned back.
    fn turn_back(&mut self, step: &dop853::Step<N>) -> Result<(), ()> {
        let apart = |y: &[f64; N]| y[1] - y[0];
        let rate = |y: &[f64; N]| y[3] - y[2];
        let mut least = apart(&step.y0).min(apart(&step.y1));
        if rate(&step.y0) < 0.0 && rate(&step.y1) > 0.0 {
            let d = step.dense(&mut self.rhs, &mut self.out.counters)?;
            let value = |part: f64| rate(&d.after(part * step.h));
            if let Some(part) = root::bracketed(0.0, 1.0, value(0.0), value(1.0), 1e-9, value) {
                least = least.min(apart(&d.after(part * step.h)));
            }
        }
        self.rhs.reference_rad = self.rhs.reference_rad.min(least);
        Ok(())
    }

    fn finish(mut self) -> ManyRun {
        self.hold();
        let now = self.rhs.energy_j(self.t_s, &self.y);
        let works: f64 = self.y[FIRST_WORK..FIRST_WORK + WORKS - 1].iter().sum();
        let left = works + self.appeared_j - (now - self.start_j);
        self.out.residual_j = if left.is_finite() { left } else { 0.0 };
        self.out.through_j = self.y[HEAD - 1];
        for g in 0..self.groups.len() {
            let motion = self.rhs.motions[g];
            let own = state_of(&self.y, g);
            let sight = self.rhs.stands(g, motion.mode.place, self.t_s, &self.y, &own);
            let course = &mut self.out.courses[g];
            if let Some(apart) = self.apart[g] {
                course.end_apart(apart, motion.mode.place, self.t_s);
            }
            course.carried = !motion.waits && motion.mode.place == Place::Carried;
            course.end_n = if motion.waits { 0.0 } else { sight.point.n_bi };
        }
        let alpha_phi = |g: usize| {
            let s = state_of(&self.y, g);
            [s[0], s[1]]
        };
        self.out.sprags = (0..self.groups.len()).map(alpha_phi).collect();
        self.out.t_s = self.t_s;
        self.out.races.copy_from_slice(&self.y[..4]);
        (self.out.looks, self.out.bending) = (self.rhs.looks, self.rhs.bending_work());
        self.out
    }
}
