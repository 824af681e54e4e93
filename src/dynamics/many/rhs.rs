//! The right-hand side of all sprags: forces of each, accelerations of the races under their sum.

use super::axes::{AXIS, Axes, SeenAxes, Sight};
use super::bending::{BendingWork, Bent, Rings};
use super::carried::{Rides, Riding};
use super::{EACH, FIRST_WORK, HEAD, PROBES, SpragGroup, SpragMotion, state_of};
use crate::dynamics::choose::EXCESS;
use crate::dynamics::events::{INNER, LEAVE_RAD, LOWER, OUTER, Probe, UPPER, probe_of, without_forces};
use crate::dynamics::model::{Forces, Grip, Loose, Mode, Model, Place};
use crate::dynamics::{N_STATE, State};
use crate::ode::rhs::RightHandSide;
use crate::wedge::WedgePoint;
use nalgebra::{Matrix2, Matrix4, Vector2, Vector4};
use std::cell::RefCell;

/// A contact is released where it asks for this much more than its limit, as a part of that. A choice takes a stick that asks for up
/// to [`EXCESS`] more, so what it has chosen does not fall at once; and a slip begins with an acceleration that rounding cannot turn
/// round, however slowly the limit is passed: sprags that have slipped come to nearly one state, and to their limits within nanoseconds.
const SLACK: f64 = 2.0 * EXCESS;

/// One group at one instant.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen {
    pub(super) point: WedgePoint,
    pub(super) rates: [f64; 4],
    pub(super) forces: Forces,
}

/// One group while the races' accelerations are sought.
pub(super) struct GroupRhs {
    of: Loose,
    a: Matrix2<f64>,
    b: Vector2<f64>,
    holds: [bool; 2],
    /// T at x = 0, N, and -dT/dx.
    still: Vector2<f64>,
    yields: Matrix2<f64>,
    let_go: bool,
}

impl GroupRhs {
    /// Of a group of `model` in `mode`.
    fn new<const RADIAL: bool>(
        model: &Model,
        mode: &Mode,
        t: f64,
        own: &State,
        sight: &Sight,
        rates: &[f64; 4],
    ) -> Self {
        let (p, axes) = (&sight.point, &sight.axes);
        let mut of = model.loose::<RADIAL, N_STATE>(mode, t, own, p, rates);
        if let Some(seen) = axes {
            of = model.turned_along(of, p, seen.along);
        }
        let (mut a, mut b) = model.grips(mode, p, rates, &of, [0.0; 2], [0.0; 2]);
        if let Some(seen) = axes {
            seen.roll(mode, p, rates, [own[6], own[7]], &of, (&mut a, &mut b));
        }
        let holds = [mode.inner == Grip::Stick && mode.place != Place::Open, mode.outer == Grip::Stick];
        let (still, yields) = (Vector2::zeros(), Matrix2::zeros());
        let mut part = Self { of, a, b, holds, still, yields, let_go: false };
        part.solve();
        part
    }

    fn solve(&mut self) {
        let (a, b) = (&self.a, &self.b);
        let [inner, outer] = self.holds.map(|holds| f64::from(u8::from(holds)));
        if self.let_go {
            self.still = Vector2::new(b[0] / a[(0, 0)], 0.0);
            self.yields = Matrix2::new(inner / a[(0, 0)], 0.0, 0.0, 0.0);
            return;
        }
        let determinant = a[(0, 0)] * a[(1, 1)] - a[(0, 1)] * a[(1, 0)];
        let solved = |u: f64, v: f64| {
            Vector2::new(
                (u * a[(1, 1)] - v * a[(0, 1)]) / determinant,
                (a[(0, 0)] * v - a[(1, 0)] * u) / determinant,
            )
        };
        self.still = solved(b[0], b[1]);
        self.yields = Matrix2::from_columns(&[solved(inner, 0.0), solved(0.0, outer)]);
    }

    /// Forces where the races go at `x`, rad/s^2, of a sprag that sees the axes so; whether B has let go of what it is not held by.
    fn under(&mut self, x: &Vector4<f64>, axes: Option<&SeenAxes>) -> (Forces, bool) {
        // What x of the races and the axis is to the two contacts, rad/s^2.
        let races = match axes {
            None => Vector2::new(x[0], x[1]),
            Some(seen) => Vector2::new(seen.races[0].dot(x), seen.races[1].dot(x)),
        };
        let t = self.still - self.yields * races;
        let n_be = if self.let_go { 0.0 } else { self.of.outer_n(t[0], t[1]) };
        let lets_go = n_be < 0.0 && !self.holds[1];
        if lets_go {
            self.let_go = true;
            self.solve();
        }
        (self.of.forces([t[0], t[1]], n_be, [x[0], x[1]]), lets_go)
    }
}

/// The right-hand side while every group is in one mode, with what it sees on its way.
pub(super) struct Rhs<'a> {
    pub(super) groups: &'a [SpragGroup],
    pub(super) axes: Option<&'a Axes>,
    /// Races that bend, as the sprags stood when they were asked last.
    bent: Option<RefCell<Bent<'a>>>,
    pub(super) motions: Vec<SpragMotion>,
    /// At all sprags, so far.
    pub(super) looks: u64,
    /// theta_be - theta_bi from which the windup counts that a waiting group waits for, rad.
    pub(super) reference_rad: f64,
    parts: Vec<Option<GroupRhs>>,
    /// Groups that a cage carries.
    pub(super) riding: Vec<Riding>,
    pub(super) seen: Vec<Option<Seen>>,
    /// How each of those sees the axes; empty where these meet and are held.
    sees: Vec<Option<SeenAxes>>,
    pub(super) probes: [Vec<Probe>; PROBES],
    /// What the bearings hold at each probe, N.
    pub(super) bearing_probes_n: [f64; PROBES],
}

/// What a newton of T_bi and of T_be on each sprag of `model` does to the races, N m.
pub(super) fn arms(model: &Model, p: &WedgePoint) -> [f64; 2] {
    [model.count * p.oa, -model.count * p.ob]
}

impl<'a> Rhs<'a> {
    pub(super) fn new(
        groups: &'a [SpragGroup],
        axes: Option<&'a Axes>,
        rings: Option<&'a Rings>,
        motions: Vec<SpragMotion>,
        reference_rad: f64,
    ) -> Self {
        let n = groups.len();
        Self {
            groups,
            axes,
            bent: rings.map(|rings| RefCell::new(Bent::new(rings))),
            motions,
            looks: 0,
            reference_rad,
            parts: (0..n).map(|_| None).collect(),
            riding: Vec::new(),
            seen: vec![None; n],
            sees: vec![None; axes.map_or(0, |_| n)],
            probes: std::array::from_fn(|_| vec![Probe::NOTHING; n]),
            bearing_probes_n: [0.0; PROBES],
        }
    }

    /// Where group `g` stands in its place, `own` its state in y.
    pub(super) fn stands(&self, g: usize, place: Place, t: f64, y: &[f64], own: &State) -> Sight {
        self.bend(y);
        self.stands_there(g, place, t, y, own)
    }

    /// The same where the races are bent as `y` has them already.
    pub(super) fn stands_there(&self, g: usize, place: Place, t: f64, y: &[f64], own: &State) -> Sight {
        let bent = self.bent.as_ref().filter(|_| matches!(place, Place::Arc(_) | Place::Open));
        let more_n = bent.and_then(|bent| Some(bent.try_borrow().ok()?.more_n(g)));
        self.groups[g].sight(self.axes, self.groups.len(), place, t, y, own, more_n)
    }

    /// Bend the races as `y` has the sprags.
    pub(super) fn bend(&self, y: &[f64]) {
        self.bent(y, |_| ());
    }

    /// Whether the races bend.
    pub(super) fn bends(&self) -> bool {
        self.bent.is_some()
    }

    /// Work of that so far.
    pub(super) fn bending_work(&self) -> BendingWork {
        self.bent.as_ref().map_or(BendingWork::default(), |bent| bent.borrow().work)
    }

    /// `of` the bent races where the sprags stand as `y` has them; `None`: they do not bend.
    pub(super) fn bent<T>(&self, y: &[f64], of: impl FnOnce(&Bent<'a>) -> T) -> Option<T> {
        let mut bent = self.bent.as_ref()?.try_borrow_mut().ok()?;
        bent.stand(self.groups, &self.motions, y);
        Some(of(&bent))
    }

    /// How far group `g` is pressed at `alpha`, as an angle from first contact, rad, where the races are bent already.
    pub(super) fn pressed_there_rad(&self, g: usize, alpha: f64) -> f64 {
        let bent = self.bent.as_ref().and_then(|bent| Some(bent.try_borrow().ok()?.pressed_rad(g)));
        bent.unwrap_or(alpha - self.groups[g].model.curve.first_contact_rad())
    }

    /// alpha at which group `g` touches, rad.
    pub(super) fn touch_rad(&self, g: usize, y: &[f64]) -> f64 {
        let own = self.groups[g].model.curve.first_contact_rad();
        self.bent(y, |bent| bent.touch_rad(g)).unwrap_or(own)
    }

    /// Event function `which` of group `g`, `pressed_rad` from first contact, where contact is lost or found between races that bend.
    fn bent_event(&self, g: usize, which: usize, pressed_rad: impl Fn() -> Option<f64>) -> Option<f64> {
        match (which, self.motions[g].mode.place) {
            (LOWER, Place::Arc(0)) => Some(pressed_rad()? + LEAVE_RAD),
            (UPPER, Place::Open) => Some(-pressed_rad()?),
            _ => None,
        }
    }

    /// Rates of group `g` with its rolling constraints put in exactly.
    pub(super) fn goes(&self, g: usize, mode: &Mode, sight: &Sight, y: &[f64], own: &State) -> [f64; 4] {
        self.groups[g].rates(self.axes, self.groups.len(), mode, sight, y, own)
    }

    /// The axes, where they may move.
    pub(super) fn moved(&self) -> Option<(&'a Axes, usize)> {
        let axes = self.axes?;
        axes.bearing.map(|_| (axes, HEAD + EACH * self.groups.len()))
    }

    /// Push of all sprags on the axis of the inner race after [`Self::look`], N.
    pub(super) fn push_n(&self) -> [f64; 2] {
        let mut push = [0.0; 2];
        for ((seen, axes), group) in self.seen.iter().zip(&self.sees).zip(self.groups) {
            let (Some(seen), Some(axes)) = (seen, axes) else { continue };
            let [inner, outer] = arms(&group.model, &seen.point);
            for (i, push) in push.iter_mut().enumerate() {
                *push += inner * seen.forces.t_bi * axes.races[0][2 + i]
                    + outer * seen.forces.t_be * axes.races[1][2 + i];
            }
        }
        push
    }

    /// What the bearings hold after [`Self::look`] at y, N.
    pub(super) fn bearing_n(&self, y: &[f64]) -> f64 {
        let Some(axes) = self.axes else { return 0.0 };
        let [x, y] = match axes.bearing {
            None => self.push_n(),
            Some(b) => axes.shift(y, self.groups.len())[0].map(|s| b.stiffness_n_per_m * s),
        };
        x.hypot(y)
    }

    /// Torques on the races but for those of the sprags, N m.
    pub(super) fn torques_nm(&self, t: f64, y: &[f64]) -> Vector2<f64> {
        let races = &self.groups[0].model;
        let drag = races.damping_nm_s_per_rad * (y[2] - y[3]);
        let [torque_i, torque_e] = races.torques_nm(t);
        Vector2::new(torque_i - drag, torque_e + drag - races.loads.abutment_nm_per_rad * y[1])
    }

    /// All forces at (t, y), left in `seen`; the accelerations of the races, rad/s^2.
    pub(super) fn look<const RADIAL: bool>(&mut self, t: f64, y: &[f64]) -> Vector4<f64> {
        let races = &self.groups[0].model;
        let f = self.torques_nm(t, y);
        self.looks += 1;
        self.bend(y);
        self.riding.clear();
        for (g, (group, motion)) in self.groups.iter().zip(&self.motions).enumerate() {
            (self.parts[g], self.seen[g]) = (None, None);
            if motion.waits {
                continue;
            }
            let (model, mode) = (&group.model, &motion.mode);
            let own = state_of(y, g);
            let sight = self.stands_there(g, mode.place, t, y, &own);
            let rates = self.goes(g, mode, &sight, y, &own);
            if mode.place == Place::Carried {
                self.riding.push(Riding::new(model, g, t, &sight.point, &rates));
            } else {
                self.parts[g] = Some(GroupRhs::new::<RADIAL>(model, mode, t, &own, &sight, &rates));
            }
            // Forces follow below.
            self.seen[g] = Some(Seen { point: sight.point, rates, forces: Forces::NONE });
            if self.axes.is_some() {
                self.sees[g] = sight.axes;
            }
        }
        // A contact B that lets go changes the system, at most once each.
        loop {
            if self.axes.is_some() {
                let x = self.pushed(&f, y);
                if !self.lets_go(&x) {
                    return x;
                }
                continue;
            }
            let mut mass = Matrix2::new(races.inner_inertia_kg_m2, 0.0, 0.0, races.outer_inertia_kg_m2);
            let mut torque = f;
            let parts = self.parts.iter().zip(&self.seen).zip(self.groups);
            for ((part, seen), group) in parts {
                let (Some(part), Some(seen)) = (part, seen) else { continue };
                for (row, arm) in arms(&group.model, &seen.point).into_iter().enumerate() {
                    torque[row] += arm * part.still[row];
                    mass[(row, 0)] += arm * part.yields[(row, 0)];
                    mass[(row, 1)] += arm * part.yields[(row, 1)];
                }
            }
            for riding in &self.riding {
                riding.turns_with(&mut mass, &mut torque);
            }
            let determinant = mass[(0, 0)] * mass[(1, 1)] - mass[(0, 1)] * mass[(1, 0)];
            let x = Vector4::new(
                (torque[0] * mass[(1, 1)] - torque[1] * mass[(0, 1)]) / determinant,
                (mass[(0, 0)] * torque[1] - mass[(1, 0)] * torque[0]) / determinant,
                0.0,
                0.0,
            );
            let (lets_go, rides) = (self.lets_go(&x), self.ride_under(t, &x));
            match rides {
                Rides::Settled if !lets_go => return x,
                Rides::NoConvergence => return Vector4::repeat(f64::NAN),
                _ => {}
            }
        }
    }

    /// Forces of all while the races go at `x`; whether a contact B has let go.
    fn lets_go(&mut self, x: &Vector4<f64>) -> bool {
        let mut again = false;
        for (g, (part, seen)) in self.parts.iter_mut().zip(&mut self.seen).enumerate() {
            let (Some(part), Some(seen)) = (part, seen) else { continue };
            let axes = self.sees.get(g).and_then(Option::as_ref);
            let (forces, lets_go) = part.under(x, axes);
            (seen.forces, again) = (forces, again || lets_go);
        }
        again
    }

    /// Accelerations of races and axis where the axes do not meet; `f` the torques from outside, N m.
    fn pushed(&self, f: &Vector2<f64>, y: &[f64]) -> Vector4<f64> {
        let inertia = self.inertia();
        let mut mass = Matrix4::from_diagonal(&inertia);
        let mut force = self.outside(f, y);
        let all = self.parts.iter().zip(&self.seen).zip(&self.sees).zip(self.groups);
        for (((part, seen), axes), group) in all {
            let (Some(part), Some(seen), Some(axes)) = (part, seen, axes) else { continue };
            let arms = arms(&group.model, &seen.point);
            for (contact, arm) in arms.into_iter().enumerate() {
                let acts = axes.races[contact] * arm;
                force += acts * part.still[contact];
                for other in 0..2 {
                    mass += acts * axes.races[other].transpose() * part.yields[(contact, other)];
                }
            }
        }
        if self.moved().is_some() {
            return mass.lu().solve(&force).unwrap_or(Vector4::repeat(f64::NAN));
        }
        let determinant = mass[(0, 0)] * mass[(1, 1)] - mass[(0, 1)] * mass[(1, 0)];
        Vector4::new(
            (force[0] * mass[(1, 1)] - force[1] * mass[(0, 1)]) / determinant,
            (mass[(0, 0)] * force[1] - mass[(1, 0)] * force[0]) / determinant,
            0.0,
            0.0,
        )
    }

    /// Inertia of the races, kg m^2, and of the axis, kg; 1 where that is held.
    pub(super) fn inertia(&self) -> Vector4<f64> {
        let races = &self.groups[0].model;
        let mass = self.axes.and_then(|axes| axes.bearing).map_or(1.0, |b| b.mass_kg);
        Vector4::new(races.inner_inertia_kg_m2, races.outer_inertia_kg_m2, mass, mass)
    }

    /// Torques `f` on the races (N m) and forces on the axis (N) but for those of the sprags.
    pub(super) fn outside(&self, f: &Vector2<f64>, y: &[f64]) -> Vector4<f64> {
        let [x, y] = self.axes.map_or([0.0; 2], |axes| axes.pulls_n(axes.shift(y, self.groups.len())));
        Vector4::new(f[0], f[1], x, y)
    }

    /// What contacts under `forces` do to races (N m) and axis (N, where it may move).
    pub(super) fn acts(&self, g: usize, sight: &Sight, forces: &Forces) -> Vector4<f64> {
        let [inner, outer] = arms(&self.groups[g].model, &sight.point);
        let (t_bi, t_be) = (inner * forces.t_bi, outer * forces.t_be);
        let Some(axes) = &sight.axes else { return Vector4::new(t_bi, t_be, 0.0, 0.0) };
        let mut acts = axes.races[0] * t_bi + axes.races[1] * t_be;
        if self.moved().is_none() {
            (acts[2], acts[3]) = (0.0, 0.0);
        }
        acts
    }

    /// Rate of alpha (rad/s) and forces of group `g` in `mode` while the races go at `x`, rad/s^2, whatever the others do; the races
    /// are bent as `y` has them already.
    pub(super) fn between(
        &self,
        g: usize,
        mode: &Mode,
        t: f64,
        y: &[f64],
        x: &Vector4<f64>,
    ) -> (f64, Forces) {
        let (model, own) = (&self.groups[g].model, state_of(y, g));
        let sight = self.stands_there(g, mode.place, t, y, &own);
        let rates = self.goes(g, mode, &sight, y, &own);
        let mut part = GroupRhs::new::<true>(model, mode, t, &own, &sight, &rates);
        let axes = sight.axes.as_ref();
        let (mut forces, lets_go) = part.under(x, axes);
        if lets_go {
            forces = part.under(x, axes).0;
        }
        if let Some(seen) = axes {
            // What a slip's rate is asked for.
            let races = seen.races_rad_s2(&rates, [own[6], own[7]], x, forces.acceleration[1]);
            forces.acceleration[2..].copy_from_slice(&races);
        }
        (rates[0], forces)
    }

    /// What is seen of group `g` after [`Self::look`] at y.
    pub(super) fn probe(&self, g: usize, t: f64, y: &[f64]) -> Probe {
        let motion = &self.motions[g];
        match (&self.seen[g], self.groups[g].lag_rad) {
            (Some(s), _) if motion.mode.place == Place::Carried => self.probe_carried(g, s, y),
            (Some(s), _) => {
                let model = &self.groups[g].model;
                let own = state_of(y, g);
                let mut seen = probe_of(model, &motion.mode, t, &own, &s.point, &s.forces, true);
                // They are bent as y has them.
                let pressed_rad = || Some(self.bent.as_ref()?.try_borrow().ok()?.pressed_rad(g));
                for which in [LOWER, UPPER] {
                    let bent = self.bent_event(g, which, pressed_rad);
                    seen.events[which] = bent.unwrap_or(seen.events[which]);
                }
                let (mu, f) = (model.friction.static_, &s.forces);
                if motion.mode.inner == Grip::Stick && motion.mode.place != Place::Open {
                    seen.events[INNER] += SLACK * mu * f.n_bi;
                }
                if motion.mode.outer == Grip::Stick && !model.outer_holds {
                    seen.events[OUTER] += SLACK * mu * f.n_be;
                }
                seen
            }
            (None, _) if motion.gone => Probe { events: [1.0; 4], figures: [0.0; 5], ..Probe::NOTHING },
            (None, lag) => {
                let left = lag.unwrap_or(f64::INFINITY) - (y[1] - y[0] - self.reference_rad)
                    + self.touches_later_rad(g, t, y);
                Probe { events: [1.0, left, 1.0, 1.0], figures: [0.0; 5], ..Probe::NOTHING }
            }
        }
    }

    /// Group `g` looked at in (t, y).
    pub(super) fn sight(&mut self, g: usize, t: f64, y: &[f64]) -> Probe {
        self.look::<true>(t, y);
        self.probe(g, t, y)
    }

    /// Event function `which` of group `g` at (t, y) alone: the ends of a place need no forces, a slip velocity no friction.
    pub(super) fn event(&mut self, g: usize, which: usize, t: f64, y: &[f64]) -> f64 {
        let (model, motion) = (&self.groups[g].model, &self.motions[g]);
        let own = state_of(y, g);
        if !motion.waits
            && let Some(bent) = self.bent_event(g, which, || self.bent(y, |bent| bent.pressed_rad(g)))
        {
            return bent;
        }
        let slips = (which == INNER || which == OUTER) && self.groups[g].off_centre.is_some();
        if slips && !motion.waits {
            let sight = self.stands(g, motion.mode.place, t, y, &own);
            let rates = self.goes(g, &motion.mode, &sight, y, &own);
            let (v_a, v_b) = model.slip_velocities(&sight.point, &rates);
            match (which, motion.mode.inner, motion.mode.outer) {
                (INNER, Grip::Slip(s), _) if motion.mode.place != Place::Open => return s * v_a,
                (OUTER, _, Grip::Slip(s)) => return s * v_b,
                _ => return self.sight(g, t, y).events[which],
            }
        }
        let known = if motion.waits { None } else { without_forces(model, &motion.mode, &own, which) };
        known.unwrap_or_else(|| self.sight(g, t, y).events[which])
    }

    /// The slope after [`Self::look`] at y; `Err` where it is not finite.
    fn slope_there<const N: usize>(&self, t: f64, y: &[f64; N], x: &Vector4<f64>) -> Result<[f64; N], ()> {
        let mut out = [0.0; N];
        let races = &self.groups[0].model;
        let (di, de) = (y[2], y[3]);
        out[..4].copy_from_slice(&[di, de, x[0], x[1]]);
        let (mut friction, mut through) = (0.0, 0.0);
        let mut damping = -races.damping_nm_s_per_rad * (di - de).powi(2);
        for (g, seen) in self.seen.iter().enumerate() {
            let Some(s) = seen else { continue };
            let (model, mode) = (&self.groups[g].model, &self.motions[g].mode);
            let f = &s.forces;
            let slips = |grip: Grip| f64::from(u8::from(matches!(grip, Grip::Slip(_))));
            let slips_a = if mode.place == Place::Open { 0.0 } else { slips(mode.inner) };
            let slips_b = slips(mode.outer);
            let at = HEAD + EACH * g;
            out[at..at + EACH].copy_from_slice(&[
                s.rates[0],
                s.rates[1],
                f.acceleration[0],
                f.acceleration[1],
                slips_a * f.v_a,
                slips_b * f.v_b,
            ]);
            let works = [model.count * f.t_bi * f.v_a * slips_a, -model.count * f.t_be * f.v_b * slips_b];
            friction += works[0] + works[1];
            through += works[0].abs() + works[1].abs();
            let speed = model.curve.speed_rad_s();
            damping += model.count * model.damped(&s.point, speed, s.rates[0]).1 * s.rates[0];
            if let Some(Some(seen)) = self.sees.get(g) {
                let (inner, outer) = (f.t_bi * s.point.oa, f.t_be * s.point.ob);
                damping += model.count * seen.taken_w(inner, outer);
            }
        }
        if let Some((axes, at)) = self.moved() {
            let shift = axes.shift(y, self.groups.len());
            out[at..at + AXIS].copy_from_slice(&[shift[1][0], shift[1][1], x[2], x[3]]);
            damping += axes.energy_j(shift).1;
        }
        let [torque_i, torque_e] = races.torques_nm(t);
        let works = [friction, damping, torque_i * di, torque_e * de];
        out[FIRST_WORK..HEAD - 1].copy_from_slice(&works);
        out[HEAD - 1] = through + works[1..].iter().map(|w| w.abs()).sum::<f64>();
        let finite = out.iter().map(|v| 0.0 * v).sum::<f64>() == 0.0;
        if finite { Ok(out) } else { Err(()) }
    }
}

impl<const N: usize> RightHandSide<N> for Rhs<'_> {
    type Failure = ();

    fn used(&self) -> usize {
        HEAD + EACH * self.groups.len() + self.moved().map_or(0, |_| AXIS)
    }

    fn slope(&mut self, t: f64, y: &[f64; N]) -> Result<[f64; N], ()> {
        let x = self.look::<false>(t, y);
        self.slope_there(t, y, &x)
    }

    fn slope_at_probe(&mut self, probe: usize, t: f64, y: &[f64; N]) -> Result<[f64; N], ()> {
        let x = self.look::<true>(t, y);
        for g in 0..self.groups.len() {
            self.probes[probe][g] = self.probe(g, t, y);
        }
        self.bearing_probes_n[probe] = self.bearing_n(y);
        self.slope_there(t, y, &x)
    }
}
