//! Steps up to the first event of any sprag.

use super::found::{ManyRun, ManySample, SpragCourse};
use super::{
    EACH, EVENTS, FIRST_WORK, HEAD, ManyStart, PROBES, Rhs, SpragGroup, SpragMotion, WORKS, state_of,
};
use crate::dynamics::cusp::towards_the_cusp_s;
use crate::dynamics::events::{INNER, LOWER, N_BI, OUTER, UPPER};
use crate::dynamics::model::{Grip, N_STATE, Place};
use crate::dynamics::probes::parabola;
use crate::dynamics::run::{RunSettings, Stop};
use crate::numeric::root;
use crate::ode::dop853;
use crate::ode::rhs::RightHandSide;
use crate::ode::step::{Counters, Tolerance};

/// Shortest step, s.
const SHORTEST_S: f64 = 1e-15;
/// A step begun at an event that falls at once is tried shorter down to this, s.
const AT_ONCE_S: f64 = 1e-13;
/// How exactly an event is located, as a part of its step.
const WIDTH: f64 = 1e-13;

/// Integrate `groups` from `start`; `settings` as of one sprag, of which samples and history beyond equidistant ones, energy, jumps
/// and pure rolling mean nothing here. Up to 64 groups.
pub fn run_many(groups: &[SpragGroup], start: &ManyStart, settings: &RunSettings) -> ManyRun {
    const fn length(groups: usize) -> usize {
        HEAD + EACH * groups
    }
    match groups.len() {
        0..=1 => Going::<{ length(1) }>::new(groups, start, settings).run(),
        2 => Going::<{ length(2) }>::new(groups, start, settings).run(),
        3..=4 => Going::<{ length(4) }>::new(groups, start, settings).run(),
        5..=8 => Going::<{ length(8) }>::new(groups, start, settings).run(),
        9..=12 => Going::<{ length(12) }>::new(groups, start, settings).run(),
        13..=24 => Going::<{ length(24) }>::new(groups, start, settings).run(),
        _ => Going::<{ length(64) }>::new(groups, start, settings).run(),
    }
}

/// A run on its way.
pub(super) struct Going<'a, const N: usize> {
    pub(super) groups: &'a [SpragGroup],
    settings: &'a RunSettings,
    pub(super) rhs: Rhs<'a>,
    pub(super) t_s: f64,
    pub(super) y: [f64; N],
    pub(super) out: ManyRun,
    /// Since when each has been open after it caught, s.
    pub(super) open_since: Vec<Option<f64>>,
    start_j: f64,
    /// Energy of sprags that were turned along before they touched, J.
    pub(super) appeared_j: f64,
}

/// What a step comes to.
enum First {
    Nothing,
    /// At this fraction of it.
    At(f64, usize, usize),
    /// From its start on.
    AtOnce(usize, usize),
}

impl<'a, const N: usize> Going<'a, N> {
    fn new(groups: &'a [SpragGroup], start: &ManyStart, settings: &'a RunSettings) -> Self {
        let mut y = [0.0; N];
        y[..4].copy_from_slice(&start.races);
        for (g, s) in start.sprags.iter().enumerate() {
            let at = HEAD + EACH * g;
            (y[at], y[at + 1], y[at + 2], y[at + 3]) = (s[0], s[2], s[1], s[3]);
        }
        let n = groups.len();
        let out = ManyRun {
            stop: Stop::Finished,
            at_group: None,
            t_s: 0.0,
            races: start.races,
            sprags: Vec::new(),
            courses: vec![SpragCourse::default(); n],
            samples: Vec::with_capacity(settings.samples),
            events: 0,
            inconsistent_choices: 0,
            counters: Counters::default(),
            residual_j: 0.0,
            through_j: 0.0,
        };
        // The windup of a start under load counts from no load, that of an overrun from where the races turn back.
        let reference_rad = (y[1] - y[0]).min(0.0);
        let rhs = Rhs::new(groups, start.motions.clone(), reference_rad);
        let mut going = Self {
            groups,
            settings,
            rhs,
            t_s: 0.0,
            y,
            out,
            open_since: vec![None; n],
            start_j: 0.0,
            appeared_j: 0.0,
        };
        for g in 0..n {
            if !going.rhs.motions[g].waits {
                going.enter(g, going.rhs.motions[g].mode);
            }
        }
        going.start_j = going.rhs.energy_j(&going.y);
        going
    }

    fn run(mut self) -> ManyRun {
        self.settings.follow.begin_run();
        self.rhs.look::<true, N>(0.0, &self.y);
        for g in 0..self.groups.len() {
            let events = self.rhs.probe(g, &self.y).events;
            if events[INNER] < 0.0 || events[OUTER] < 0.0 {
                self.give_way(g, &events);
                self.rhs.look::<true, N>(0.0, &self.y);
            }
        }
        self.integrate();
        self.finish()
    }

    fn integrate(&mut self) {
        let mut step = Box::new(dop853::Step::<N>::new());
        let (mut h, mut slope) = (0.1 * self.settings.longest_step_s, None::<[f64; N]>);
        let until = self.settings.duration_s;
        self.sample_start();
        while self.t_s < until {
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
            let before = h;
            let mut tried = h.min(self.settings.longest_step_s).min(rest);
            let mut rejected = false;
            loop {
                if tried < SHORTEST_S && tried < rest {
                    return self.stop(Stop::StepLimit, None);
                }
                let counters = &mut self.out.counters;
                match step.take(&mut self.rhs, t, &y, &s0, tried, &tolerance, 1.0, counters) {
                    Ok(()) if step.error <= 1.0 => break,
                    Ok(()) => tried = step.next_h().min(0.9 * tried),
                    Err(()) => tried *= 0.25,
                }
                self.out.counters.rejections += 1;
                rejected = true;
            }
            h = if !rejected && tried == rest { before.max(step.next_h()) } else { step.next_h() };
            // Up to the first event: a step of its own, whose stages lie in one mode.
            let mut cut: Option<(usize, usize)> = None;
            loop {
                match self.first_event(&step, cut) {
                    Err(()) => return self.stop(Stop::NotFinite, None),
                    Ok(First::Nothing) => break,
                    Ok(First::At(part, g, which)) => {
                        cut = Some((g, which));
                        let to = part * step.h;
                        if t + to == t {
                            step.h = 0.0;
                            break;
                        }
                        let counters = &mut self.out.counters;
                        if step
                            .take(&mut self.rhs, t, &y, &s0, to, &tolerance, f64::INFINITY, counters)
                            .is_err()
                        {
                            return self.stop(Stop::NotFinite, None);
                        }
                    }
                    Ok(First::AtOnce(g, which)) => {
                        cut = Some((g, which));
                        step.h *= 0.125;
                        if step.h > AT_ONCE_S {
                            h = step.h;
                        }
                        break;
                    }
                }
            }
            let taken = self.out.counters.steps + self.out.counters.rejections;
            if taken >= self.settings.most_steps {
                return self.stop(Stop::StepLimit, None);
            }
            match cut {
                Some((g, which)) if step.h <= AT_ONCE_S => {
                    // Nothing has moved.
                    let mut now = [1.0; EVENTS];
                    now[which] = -1.0;
                    if !self.count_event(g) || !self.give_way(g, &now) {
                        return;
                    }
                    self.together(g);
                }
                Some(_) if step.h == h && h < tried => {}
                Some((g, which)) => {
                    if self.accept(&step).is_err() {
                        return self.stop(Stop::NotFinite, None);
                    }
                    if !self.count_event(g) || !self.change(g, which) {
                        return;
                    }
                    self.together(g);
                }
                None => {
                    if self.accept(&step).is_err() {
                        return self.stop(Stop::NotFinite, None);
                    }
                    slope = Some(*step.slope1());
                    self.rhs.probes.swap(0, PROBES - 1);
                }
            }
            if self.out.stop != Stop::Finished {
                return;
            }
        }
    }

    /// Sprags alike come to their events together: those whose functions have fallen too follow `g` at once.
    fn together(&mut self, g: usize) {
        for other in (0..self.groups.len()).filter(|other| *other != g) {
            let (t, y) = (self.t_s, self.y);
            let now = self.rhs.events(other, t, &y);
            let scale = |i: usize| match i {
                INNER | OUTER => 1e-12 * self.rhs.seen[other].map_or(0.0, |s| s.forces.n_bi + s.forces.n_be),
                _ => 0.0,
            };
            let sticks = |i: usize| match i {
                INNER => self.rhs.motions[other].mode.inner == Grip::Stick,
                OUTER => self.rhs.motions[other].mode.outer == Grip::Stick,
                _ => true,
            };
            let fallen = (0..EVENTS).find(|&i| now[i] < 0.0 || sticks(i) && now[i] < scale(i));
            if let Some(which) = fallen
                && (!self.count_event(other) || !self.change(other, which))
            {
                return;
            }
        }
    }

    fn count_event(&mut self, g: usize) -> bool {
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
        let mut all = Tolerance { relative: 0.0, absolute: [f64::INFINITY; N], integrated: [0.0; N] };
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
        all
    }

    fn towards_a_cusp_s(&self) -> f64 {
        let one = |(g, motion): (usize, &SpragMotion)| {
            if motion.waits {
                return f64::INFINITY;
            }
            let s = state_of(&self.y, g);
            towards_the_cusp_s(&self.groups[g].model, &motion.mode, s[0], s[4])
        };
        self.rhs.motions.iter().enumerate().map(one).fold(f64::INFINITY, f64::min)
    }

    /// The first event in `step` but for `cut`, which lies at its end.
    fn first_event(&mut self, step: &dop853::Step<N>, cut: Option<(usize, usize)>) -> Result<First, ()> {
        let groups = self.groups.len();
        let mut dense: Option<dop853::Dense<N>> = None;
        // Kept beside: looking there writes others.
        for to in 1..PROBES {
            let mut earliest = (f64::INFINITY, 0, 0);
            for g in 0..groups {
                for which in 0..EVENTS {
                    let e = |rhs: &Rhs, j: usize| rhs.probes[j][g].events[which];
                    let here = e(&self.rhs, to);
                    let at_cut = cut == Some((g, which)) && to + 2 >= PROBES;
                    let dips = to + 1 < PROBES
                        && here > 0.0
                        && here <= e(&self.rhs, to - 1)
                        && here <= e(&self.rhs, to + 1);
                    let bottom = if dips {
                        let x = [to - 1, to, to + 1].map(|j| dop853::PROBES[j]);
                        let (bend, x_min) = parabola(x, [to - 1, to, to + 1].map(|j| e(&self.rhs, j)));
                        let under = here - bend * (x_min - x[1]).powi(2);
                        (bend > 0.0 && under < 0.0).then(|| x_min.clamp(x[0], x[2]))
                    } else {
                        None
                    };
                    if at_cut || here >= 0.0 && bottom.is_none() {
                        continue;
                    }
                    let left = (0..to).rev().find(|&j| e(&self.rhs, j) > 0.0);
                    let Some(left) = left else { return Ok(First::AtOnce(g, which)) };
                    let d = match &dense {
                        Some(d) => d,
                        None => {
                            let found = step.dense(&mut self.rhs, &mut self.out.counters)?;
                            dense.insert(found)
                        }
                    };
                    let rhs = &mut self.rhs;
                    let mut value = |part: f64| {
                        let elapsed = part * step.h;
                        rhs.events(g, step.t + elapsed, &d.after(elapsed))[which]
                    };
                    let (a, b) = (dop853::PROBES[left], bottom.unwrap_or(dop853::PROBES[to]));
                    let (at_a, at_b) = (value(a), value(b));
                    if at_b >= 0.0 {
                        continue;
                    }
                    if at_a <= 0.0 {
                        return Ok(First::AtOnce(g, which));
                    }
                    if let Some(part) = root::bracketed(a, b, at_a, at_b, WIDTH, value)
                        && part < earliest.0
                    {
                        earliest = (part, g, which);
                    }
                }
            }
            if earliest.0.is_finite() {
                return Ok(First::At(earliest.0, earliest.1, earliest.2));
            }
        }
        Ok(First::Nothing)
    }

    /// Take over `step`: samples, extremes, slips, the constraint.
    fn accept(&mut self, step: &dop853::Step<N>) -> Result<(), ()> {
        self.out.counters.steps += 1;
        self.watch(step);
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
            if motion.mode.place != Place::Open {
                for contact in 0..2 {
                    let slipped = y[at + 4 + contact] - before[at + 4 + contact];
                    self.out.courses[g].net_m[contact] += slipped;
                    self.out.courses[g].path_m[contact] += slipped.abs();
                }
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

    /// Extremes, by the parabola through the probes beside the largest.
    fn watch(&mut self, step: &dop853::Step<N>) {
        let probes = &self.rhs.probes;
        let counts: Vec<f64> = self.groups.iter().map(|group| group.model.count).collect();
        let all: f64 = counts.iter().sum();
        let mean: [f64; PROBES] = std::array::from_fn(|j| {
            probes[j].iter().zip(&counts).map(|(p, n)| n * p.figures[N_BI]).sum::<f64>() / all
        });
        for (g, course) in self.out.courses.iter_mut().enumerate() {
            if self.rhs.motions[g].waits {
                continue;
            }
            let normal: [f64; PROBES] = std::array::from_fn(|j| probes[j][g].figures[N_BI]);
            let loaded = |j: usize| mean[j] >= self.groups[g].model.loaded_n;
            let (part, most) = top(&normal);
            if most > course.normal_max_n {
                (course.normal_max_n, course.normal_max_s) = (most, step.t + part * step.h);
            }
            for contact in 0..2 {
                let tan = std::array::from_fn(|j| {
                    let carries = normal[j] >= self.groups[g].model.loaded_n;
                    if carries { probes[j][g].figures[contact] } else { 0.0 }
                });
                let most = top(&tan).1.min(self.groups[g].model.friction.static_);
                course.tan[contact] = course.tan[contact].max(most);
            }
            for j in (0..PROBES).filter(|&j| loaded(j) && mean[j] > 0.0) {
                let share = normal[j] / mean[j];
                if share > course.share {
                    (course.share, course.share_s) = (share, step.t + dop853::PROBES[j] * step.h);
                }
            }
        }
    }

    fn sample_start(&mut self) {
        if self.settings.samples > 0 {
            let (t, y) = (self.t_s, self.y);
            self.keep(t, &y);
        }
    }

    fn sample(&mut self, step: &dop853::Step<N>) -> Result<(), ()> {
        let many = self.settings.samples;
        let last = many.max(2) - 1;
        let time = |i: usize| self.settings.duration_s * i as f64 / last as f64;
        let mut dense = None;
        while self.out.samples.len() < many && time(self.out.samples.len()) <= step.t + step.h {
            let d = match &dense {
                Some(d) => d,
                None => {
                    let kept = self.rhs.probes.clone();
                    let found = step.dense(&mut self.rhs, &mut self.out.counters)?;
                    self.rhs.probes = kept;
                    dense.insert(found)
                }
            };
            let t = time(self.out.samples.len());
            let y = d.at(t);
            self.keep(t, &y);
        }
        Ok(())
    }

    fn keep(&mut self, t: f64, y: &[f64; N]) {
        self.rhs.look::<true, N>(t, y);
        let probes: Vec<_> = (0..self.groups.len()).map(|g| self.rhs.probe(g, y)).collect();
        self.out.samples.push(ManySample {
            t_s: t,
            races: [y[0], y[1], y[2], y[3]],
            normal_n: probes.iter().map(|p| p.figures[N_BI]).collect(),
            tan: probes.iter().map(|p| [p.figures[0], p.figures[1]]).collect(),
            motions: self.rhs.motions.clone(),
        });
    }

    fn finish(mut self) -> ManyRun {
        self.hold();
        let now = self.rhs.energy_j(&self.y);
        let works: f64 = self.y[FIRST_WORK..FIRST_WORK + WORKS - 1].iter().sum();
        self.out.residual_j = works + self.appeared_j - (now - self.start_j);
        self.out.through_j = self.y[HEAD - 1];
        for (course, since) in self.out.courses.iter_mut().zip(&self.open_since) {
            course.open_s += since.map_or(0.0, |since| self.t_s - since);
        }
        let alpha_phi = |g: usize| {
            let s = state_of(&self.y, g);
            [s[0], s[1]]
        };
        self.out.sprags = (0..self.groups.len()).map(alpha_phi).collect();
        self.out.t_s = self.t_s;
        self.out.races.copy_from_slice(&self.y[..4]);
        self.out
    }
}

/// Place, as a part of a step, and value of the largest of what the probes show.
fn top(values: &[f64; PROBES]) -> (f64, f64) {
    let mut j = 0;
    for i in 1..PROBES {
        if values[i] > values[j] {
            j = i;
        }
    }
    let (at, most) = (dop853::PROBES[j], values[j]);
    if j == 0 || j + 1 == PROBES {
        return (at, most);
    }
    let beside = [j - 1, j, j + 1];
    let (bend, x) = parabola(beside.map(|i| dop853::PROBES[i]), beside.map(|i| values[i]));
    if bend < 0.0 { (x, most - bend * (x - at).powi(2)) } else { (at, most) }
}

/// Which end of a place an event is.
pub(super) fn is_end(which: usize) -> bool {
    which == LOWER || which == UPPER
}
