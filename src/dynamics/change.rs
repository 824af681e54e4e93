//! What happens at a change of mode: where A goes, which contacts slip, how the velocities jump, where changes that accumulate lead.

use super::choose::{Known, choose};
use super::crossing::cross;
use super::driver::Driver;
use super::events::{EVENTS, INNER, LOWER, OUTER, UPPER, probe_of};
use super::model::{Forces, Grip, Mode, N_STATE, Place};
use super::run::Stop;
use super::start::settled;
use super::zeno::{Accumulation, bound, resolution_s};
use crate::ode::adaptive::Size;
use crate::wedge::WedgePoint;
use nalgebra::Const;

/// A mode to enter, and the point of the curve and the forces in it where they are known at the present time and state.
pub(super) struct Next {
    mode: Mode,
    forces: Option<(WedgePoint, Forces)>,
}

impl Next {
    /// Nothing known but the mode.
    pub(super) fn of_mode(mode: Mode) -> Self {
        Self { mode, forces: None }
    }
}

impl<const N: usize> Driver<'_, N>
where
    Const<N>: Size,
{
    /// Change of mode at event `which`.
    pub(super) fn change(&mut self, which: usize, t: f64, mut y: [f64; N]) -> bool {
        let model = self.model;
        let mode = self.run.mode;
        let p = self.hold(&mut y);
        if mode.place == Place::Carried {
            self.catch_up(which, t, &mut y, &p);
            return true;
        }
        let forces = || model.forces_at(&mode, t, &y, &p, &model.rates(&mode, &p, &y));
        let known = |grip: Grip, here: bool, slips: &dyn Fn() -> f64| match grip {
            Grip::Stick if here => Known::Released(slips().signum()),
            Grip::Stick => Known::Still,
            Grip::Slip(_) if here => Known::Still,
            Grip::Slip(s) => Known::Slips(s),
        };
        // T_bi = -sgn(v_A) mu N, T_be = +sgn(v_B) mu N.
        let inner = known(mode.inner, which == INNER, &|| -forces().t_bi);
        let outer = known(mode.outer, which == OUTER, &|| forces().t_be);
        let place = match which {
            LOWER => match mode.place {
                Place::Arc(0) if self.settings.rolling => Place::Tension,
                Place::Arc(0) => Place::Open,
                Place::Arc(k) => Place::Arc(k - 1),
                Place::Open | Place::Tension | Place::Carried => {
                    self.stop(Stop::FellAway);
                    return false;
                }
            },
            UPPER => match mode.place {
                Place::Arc(k) if k + 1 < model.curve.place_count() => Place::Arc(k + 1),
                Place::Arc(_) => {
                    self.stop(Stop::CurveEnd);
                    return false;
                }
                Place::Open | Place::Tension | Place::Carried => Place::Arc(0),
            },
            _ => mode.place,
        };
        let touches = matches!((which, mode.place), (LOWER, Place::Arc(0)) | (UPPER, Place::Open));
        if touches && !self.settings.rolling && self.take_along(t, &mut y, &p) {
            return true;
        }
        let next = if which == LOWER || which == UPPER {
            self.pass(&mode, &p, place, t, &mut y, inner, outer)
        } else {
            self.chosen(t, &y, p, place, inner, outer)
        };
        self.run.state = y;
        self.enter(next);
        true
    }

    /// Carried sprags where the outer race comes to run as fast as they, or where they come off it or back to it: one that is as fast, or
    /// faster, takes them into the wedge.
    fn catch_up(&mut self, which: usize, t: f64, y: &mut [f64; N], p: &WedgePoint) {
        let mode = self.run.mode;
        let lags = matches!(mode.outer, Grip::Slip(s) if s < 0.0);
        let next = match (which == OUTER, mode.is_off()) {
            (true, true) => Mode { outer: if lags { Grip::Slip(1.0) } else { Grip::Slip(-1.0) }, ..mode },
            (false, false) => Mode { inner: Mode::OFF, ..mode },
            (false, true) if lags => Mode { inner: Mode::PRESSED, ..mode },
            _ => return self.wedge_in(lags, t, y, p),
        };
        self.run.state = *y;
        self.enter(Next::of_mode(next));
    }

    /// Carried sprags are let go at an outer race that is as fast as they (`lags`: was slower until now), or faster.
    fn wedge_in(&mut self, lags: bool, t: f64, y: &mut [f64; N], p: &WedgePoint) {
        let (model, mode) = (self.model, self.run.mode);
        let rates = model.rates(&mode, p, y);
        let load_nm = model.race_loads_nm(t, y, &rates)[0];
        let tilt_rad = model
            .carried
            .map_or(0.0, |carried| model.ride(&carried, t, p, &rates, load_nm, false).0.tilt_rad);
        let v_b = model.slip_velocities(p, &rates).1;
        let outer = if lags { Known::Still } else { moving(v_b.max(0.0)) };
        let from = y[0];
        let place = if tilt_rad > 0.0 {
            y[0] -= tilt_rad;
            Place::Open
        } else {
            // Pressed in as its spring does between races that stand still against one another.
            let pressed = settled(model, 0.0);
            y[0] = pressed.map_or(from, |(state, _)| state[0]);
            pressed.map_or(Place::Arc(0), |(_, place)| place)
        };
        if let Some(audit) = &mut self.audit {
            audit.set(model, y, from);
        }
        let next = self.chosen(t, y, model.point(place, y[0]), place, Known::Still, outer);
        self.run.state = *y;
        self.enter(next);
    }

    /// A driven cage takes sprags along that touch, or cease to, behind the inner race. False: there is none, or they are ahead.
    fn take_along(&mut self, t: f64, y: &mut [f64; N], p: &WedgePoint) -> bool {
        let model = self.model;
        if model.carried.is_none() {
            return false;
        }
        let before = model.rates(&self.run.mode, p, y);
        let along = model.taken_along_rad_s(p, before);
        if before[3] >= along || before[1] > before[2] {
            return false;
        }
        let after = [0.0, along, along, before[3]];
        if let Some(audit) = &mut self.audit {
            audit.taken_along(model, y, p, [&before, &after]);
        }
        y[0] = model.curve.first_contact_rad();
        y[4..8].copy_from_slice(&after);
        (self.run.t_s, self.run.state) = (t, *y);
        let pressed = Mode { place: Place::Carried, inner: Mode::PRESSED, outer: Grip::Slip(-1.0) };
        let stays = model.stays_nm(&pressed, t, y, &model.point(Place::Carried, y[0])) > 0.0;
        let mode = if stays { pressed } else { Mode { inner: Mode::OFF, ..pressed } };
        self.enter(Next::of_mode(mode));
        true
    }

    /// Put the rolling constraints of the present mode into the rates of `y`. The integrated rates of the sprag drift off
    /// them by the tolerance; a contact that leaves stick with that as its slip velocity would slip the wrong way.
    /// Returns the point of the curve there.
    fn hold(&self, y: &mut [f64; N]) -> WedgePoint {
        let mode = &self.run.mode;
        let p = self.model.point(mode.place, y[0]);
        let rates = self.model.rates(mode, &p, y);
        y[4..8].copy_from_slice(&rates);
        p
    }

    /// Pass into another place; a closed contact that touches begins in slip unless v = 0.
    fn pass(
        &mut self,
        mode: &Mode,
        p: &WedgePoint,
        place: Place,
        t: f64,
        y: &mut [f64; N],
        inner: Known,
        outer: Known,
    ) -> Next {
        let model = self.model;
        let q = model.point(place, y[0]);
        let rates = model.rates(mode, p, y);
        let touching = mode.place == Place::Open;
        let held =
            Mode { place, inner: if touching { Grip::Slip(1.0) } else { mode.inner }, outer: mode.outer };
        let after = cross(model, &held, p, &q, rates);
        if let Some(audit) = &mut self.audit {
            audit.jump(model, y, (p, &rates), (&q, &after));
        }
        y[4..8].copy_from_slice(&after);
        if self.settings.rolling {
            return Next::of_mode(Mode { place, ..*mode });
        }
        let (v_a, v_b) = model.slip_velocities(&q, &after);
        let inner = match inner {
            _ if touching => moving(v_a),
            Known::Slips(_) => moving(v_a),
            other => other,
        };
        let outer = if matches!(outer, Known::Slips(_)) { moving(v_b) } else { outer };
        self.chosen(t, y, q, place, inner, outer)
    }

    /// The next mode where the curve is `p`; one that contradicts itself is counted.
    pub(super) fn chosen(
        &mut self,
        t: f64,
        y: &[f64; N],
        p: WedgePoint,
        place: Place,
        inner: Known,
        outer: Known,
    ) -> Next {
        let choice = choose(self.model, t, y, &p, place, inner, outer);
        self.run.inconsistent_choices += u64::from(!choice.consistent);
        Next { mode: choice.mode, forces: choice.forces.map(|f| (p, f)) }
    }

    /// An event function is negative right after a change although the choice was consistent to rounding:
    /// settle it by choosing again with every still contact free.
    pub(super) fn choose_again(&mut self, now: &[f64; EVENTS]) -> bool {
        if !self.count_event() {
            return false;
        }
        let mode = self.run.mode;
        let (t, mut y) = (self.run.t_s, self.run.state);
        let p = self.hold(&mut y);
        self.run.state = y;
        if let Some(limit) =
            self.zeno.note(t, now.map(|e| e < 0.0), resolution_s(&self.run.state, self.settings))
        {
            self.close(&limit, t, y);
            return true;
        }
        if mode.place == Place::Carried {
            self.catch_up(if now[OUTER] < 0.0 { OUTER } else { INNER }, t, &mut y, &p);
            return true;
        }
        let again = |grip: Grip, negative: bool| match grip {
            Grip::Slip(s) if !negative => Known::Slips(s),
            _ => Known::Still,
        };
        if now[LOWER] < 0.0 || now[UPPER] < 0.0 {
            let which = if now[LOWER] < 0.0 { LOWER } else { UPPER };
            return self.change(which, t, y);
        }
        let (inner, outer) = (again(mode.inner, now[INNER] < 0.0), again(mode.outer, now[OUTER] < 0.0));
        let mut next = self.chosen(t, &y, p, mode.place, inner, outer);
        if next.mode == mode {
            // Nothing better: go on in this mode for a step that rounding cannot undo. A slip whose velocity is against its
            // sign even then slips the other way.
            self.run.t_s = t + 1e-12;
            let rhs = |t: f64, y: &[f64; N]| self.model.slope(&mode, t, y).ok_or(());
            let Ok(slope) = rhs(t, &y) else {
                self.stop(Stop::NotFinite);
                return false;
            };
            for (y, rate) in self.run.state.iter_mut().zip(slope) {
                *y += 1e-12 * rate;
            }
            let y = &self.run.state;
            let p = self.model.point(mode.place, y[0]);
            let (v_a, v_b) = self.model.slip_velocities(&p, &self.model.rates(&mode, &p, y));
            let with = |grip: Grip, v: f64| match grip {
                Grip::Slip(s) if s * v < 0.0 => Grip::Slip(-s),
                _ => grip,
            };
            next = Next::of_mode(Mode { inner: with(mode.inner, v_a), outer: with(mode.outer, v_b), ..mode });
        }
        self.enter(next);
        true
    }

    /// Go to the limit of accumulating changes.
    pub(super) fn close(&mut self, limit: &Accumulation, t: f64, mut y: [f64; N]) {
        let (model, mode) = (self.model, self.run.mode);
        let took = |i: usize| limit.took_part[i];
        let t = t + limit.left_s;
        for i in 0..4 {
            y[i] += limit.left_s * y[4 + i];
        }
        for twist in y[N_STATE..].chunks_exact_mut(2) {
            twist[0] += limit.left_s * twist[1];
        }
        let free = |grip: Grip, took: bool| if took { Grip::Stick } else { grip };
        let (inner, outer) = (free(mode.inner, took(INNER)), free(mode.outer, took(OUTER)));
        let known = |grip: Grip| match grip {
            Grip::Stick => Known::Still,
            Grip::Slip(s) => Known::Slips(s),
        };
        let mut place = mode.place;
        let at_bound = (took(LOWER) || took(UPPER))
            .then(|| bound(&model.curve, mode.place, self.settings.rolling, y[0]));
        if let Some((alpha, lower, upper)) = at_bound {
            (y[0], y[4], place) = (alpha, 0.0, upper);
            let held = Mode { place, inner, outer };
            if model.forces(&held, t, &y).acceleration[0] < 0.0 {
                place = lower;
            }
        }
        if place == Place::Carried {
            place = Place::Arc(0);
        }
        let held = Mode { place, inner, outer };
        let p = model.point(place, y[0]);
        let rates = model.rates(&held, &p, &y);
        y[4..8].copy_from_slice(&rates);
        let next = self.chosen(t, &y, p, place, known(inner), known(outer));
        (self.run.t_s, self.run.state) = (t, y);
        self.run.zeno_closures += 1;
        self.enter(next);
    }

    /// Go on in `next` from the present time and state.
    pub(super) fn enter(&mut self, next: Next) {
        let mode = next.mode;
        let (t, y) = (self.run.t_s, &mut self.run.state);
        let p = next.forces.map_or_else(|| self.model.point(mode.place, y[0]), |(p, _)| p);
        let rates = self.model.rates(&mode, &p, y);
        y[4..8].copy_from_slice(&rates);
        let both = mode.inner == Grip::Stick && mode.outer == Grip::Stick;
        let closed = matches!(mode.place, Place::Arc(_));
        self.phase = (both && closed).then(|| y[2] - y[3] + p.windup);
        let apart = mode.place == Place::Open || mode.is_off();
        match (apart, self.open_since) {
            (true, None) => self.open_since = Some(t),
            (false, Some(since)) => {
                self.run.end_open(since, t);
                self.open_since = None;
            }
            _ => {}
        }
        self.note_slip(&mode, p.n_bi);
        self.renew(mode);
        if let Some((p, f)) = next.forces {
            let probe = probe_of(self.model, &mode, t, &self.run.state, &p, &f, !self.settings.rolling);
            (self.slope, self.probed) =
                (self.model.slope_of(&mode, t, &self.run.state, &rates, &f), Some(probe));
        }
        self.run.mode = mode;
        self.run.note_engagement();
        if self.settings.samples > 0 && self.run.modes.last().is_none_or(|last| last.1 != mode) {
            self.run.modes.push((t, mode));
            self.watch.mark(&mut self.run, t);
        }
    }

    /// Remember under what load a contact that held begins to slip on entering `next`.
    fn note_slip(&mut self, next: &Mode, n_bi: f64) {
        let closed = |mode: &Mode| matches!(mode.place, Place::Arc(_));
        let run = &mut self.run;
        let begins = |from: Grip, to: Grip| from == Grip::Stick && to != Grip::Stick;
        let slips = begins(run.mode.inner, next.inner) || begins(run.mode.outer, next.outer);
        if slips && closed(&run.mode) && closed(next) && run.engaged.is_some() {
            run.slip_begins_n = run.slip_begins_n.max(n_bi);
        }
    }
}

pub(super) fn moving(v: f64) -> Known {
    if v == 0.0 { Known::Still } else { Known::Slips(v.signum()) }
}
