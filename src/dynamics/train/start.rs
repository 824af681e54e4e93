//! Where a drivetrain starts: what the clutch carries then, and how far every shaft is twisted.
//!
//! Races and bodies turn at the mean speed, those on the side of a race that runs ahead with it. Every side moves as one
//! piece: with the acceleration of what is driven on it; not at all where an abutment holds it; else as its torques have it,
//! both sides alike while the clutch holds them together. Sources count by their mean over a turn. The inertia of the sprags
//! is left out of that.

use super::super::model::{Grip, Mode, Model, Place, State};
use super::{BODIES, MOST_MORE, Motion, Train};

/// What a side feels at the start, without the clutch.
struct Sides {
    /// Torques from outside, drags and inertia forces of the mean speed, N m.
    torque_nm: [f64; 2],
    inertia_kg_m2: [f64; 2],
    /// The same by body.
    by_body: [f64; BODIES],
    /// Acceleration of what is driven, rad/s^2, where there is one.
    given: [Option<f64>; 2],
}

impl Model {
    /// With a drivetrain: what turns with the races without a shaft counts as theirs.
    pub fn joined(mut self, train: Option<Train>) -> Self {
        if let Some(train) = train {
            let [inner, outer] = train.rigid.map(|r| r.inertia_kg_m2);
            self.inner_inertia_kg_m2 += inner;
            self.outer_inertia_kg_m2 += outer;
            self.drive.train = Some(train);
        }
        self
    }

    /// What the clutch carries at the start, N m, and the turn of the outer race against its abutment that a drivetrain adds,
    /// rad, which is told; `asked_nm`: what the scene alone asks for.
    pub fn carries(&mut self, asked_nm: f64) -> (f64, f64) {
        let Some(train) = &self.drive.train else { return (asked_nm, 0.0) };
        let (torque_nm, turn) = train.carries(self, asked_nm);
        if let Some(train) = &mut self.drive.train {
            train.carried_nm = Some(torque_nm);
        }
        (torque_nm, turn)
    }
}

impl Train {
    /// What its torques bring at most on either side, N m: peaks of histories, the mean of gas. Orders swing about that, as an
    /// excitation does about its preload: they count where nothing else acts.
    pub fn largest_nm(&self) -> f64 {
        let side = self.sides();
        let most = |of_orders: bool| {
            let mut sum = [0.0; 2];
            for act in self.acts.iter().filter(|act| act.torque.is_order() == of_orders) {
                sum[side[act.body]] += act.ratio.abs() * act.torque.largest_nm();
            }
            sum[0].max(sum[1])
        };
        let borne = most(false);
        if borne > 0.0 { borne } else { most(true) }
    }

    /// `rates`: of the races at the start, rad/s; the bodies of a side turn as its race does.
    fn at_sides(&self, model: &Model, rates: [f64; 2]) -> Sides {
        let (speed, spin) = model.mean_speed(0.0);
        let side = self.sides();
        let races = [model.inner_inertia_kg_m2, model.outer_inertia_kg_m2];
        let past_s = model.drive.past_break_s(0.0);
        let acting = model.torques_nm(past_s);
        let mut by_body = [0.0; BODIES];
        let (mut inertia_kg_m2, mut given) = (races, [None; 2]);
        for race in [0, 1] {
            let drag = self.rigid[race].drag_nm_s_per_rad * (speed + rates[race]);
            by_body[race] = acting[race] - drag - races[race] * spin;
        }
        for (b, body) in (2..).zip(&self.bodies) {
            match &body.motion {
                Motion::Free(_) => {
                    let inertia = body.fixed.inertia_kg_m2;
                    inertia_kg_m2[side[b]] += inertia;
                    by_body[b] = -body.fixed.drag_nm_s_per_rad * (speed + rates[side[b]]) - inertia * spin;
                }
                Motion::Given(turned, _) => given[side[b]] = Some(turned.speed(past_s).1 - spin),
            }
        }
        for act in &self.acts {
            let driven = self.is_given(act.body);
            if !driven {
                by_body[act.body] += act.ratio * act.torque.mean_at_start();
            }
        }
        let mut torque_nm = [0.0; 2];
        for (b, torque) in by_body.iter().enumerate().take(2 + self.bodies.len()) {
            torque_nm[side[b]] += torque;
        }
        Sides { torque_nm, inertia_kg_m2, by_body, given }
    }

    /// Torque that the clutch carries, engaging positive, where both sides start at the mean speed, N m, and the turn of the
    /// outer race against its abutment that the drivetrain adds, rad. `asked_nm`: what the scene alone asks for.
    fn carries(&self, model: &Model, asked_nm: f64) -> (f64, f64) {
        let sides = self.at_sides(model, [0.0; 2]);
        let ([inner, outer], [of_inner, of_outer]) = (sides.torque_nm, sides.inertia_kg_m2);
        let held = model.loads.abutment_nm_per_rad > 0.0;
        let torque_nm = match sides.given {
            [Some(_), Some(_)] => asked_nm,
            [Some(_), None] if held => asked_nm,
            [Some(a), None] => outer - of_outer * a,
            [None, Some(a)] if !held => of_inner * a - inner,
            [None, _] if held => -inner,
            _ => of_inner * (inner + outer) / (of_inner + of_outer) - inner,
        };
        let torque_nm = torque_nm.max(0.0);
        let turn = if held { outer / model.loads.abutment_nm_per_rad } else { 0.0 };
        (torque_nm, turn)
    }

    /// The drivetrain as it stands at t = 0 beside `state` and `mode` of the clutch, with its twists and their rates.
    pub(super) fn at_start(&self, model: &Model, state: &State, mode: &Mode) -> (Self, [f64; MOST_MORE]) {
        if let Some(more) = self.begins {
            return (self.clone(), more);
        }
        let sides = self.at_sides(model, [state[6], state[7]]);
        let slides = slipping(mode).is_some() || mode.place == Place::Carried;
        let carried_nm = self.carried_nm.filter(|_| !slides);
        let clutch_nm = carried_nm.unwrap_or_else(|| friction_nm(model, state, mode));
        let on_side = [sides.torque_nm[0] + clutch_nm, sides.torque_nm[1] - clutch_nm];
        let held = model.loads.abutment_nm_per_rad > 0.0;
        let acceleration: [f64; 2] = std::array::from_fn(|s| {
            sides.given[s].unwrap_or(if held && s == 1 { 0.0 } else { on_side[s] / sides.inertia_kg_m2[s] })
        });
        let side = self.sides();
        // What each shaft passes on, from the ends towards the races.
        let mut passes = sides.by_body;
        for (index, body) in self.bodies.iter().enumerate().rev() {
            let b = 2 + index;
            match body.motion {
                Motion::Free(_) => passes[b] -= body.fixed.inertia_kg_m2 * acceleration[side[b]],
                Motion::Given(..) => {
                    let s = side[b];
                    passes[b] = sides.inertia_kg_m2[s] * acceleration[s] - on_side[s];
                }
            }
            passes[body.parent] += passes[b];
        }
        let mut train = self.clone();
        let (mut more, mut angle) = ([0.0; MOST_MORE], [0.0; BODIES]);
        (angle[0], angle[1]) = (state[2], state[3]);
        for (b, body) in (2..).zip(&mut train.bodies) {
            let twist = passes[b] / body.stiffness_nm_per_rad;
            angle[b] = angle[body.parent] + twist;
            match &mut body.motion {
                Motion::Free(k) => more[2 * *k] = twist,
                Motion::Given(_, at_start) => *at_start = angle[b],
            }
        }
        (train, more)
    }
}

/// The sign of a slip at A under load.
fn slipping(mode: &Mode) -> Option<f64> {
    match mode.inner {
        Grip::Slip(sign) if mode.place != Place::Open => Some(sign),
        _ => None,
    }
}

/// Torque of the clutch on the inner race by friction at A, N m; 0 where that does not slip.
fn friction_nm(model: &Model, state: &State, mode: &Mode) -> f64 {
    let p = model.point(mode.place, state[0]);
    if mode.place == Place::Carried {
        // Before the cage is accelerated.
        let rates = model.rates(mode, &p, state);
        return model.carried_drag_nm(0.0, &p, &rates);
    }
    if slipping(mode).is_none() {
        return 0.0;
    }
    let v_a = model.slip_velocities(&p, &model.rates(mode, &p, state)).0;
    -v_a.signum() * model.friction.coefficient(v_a.abs()) * p.n_bi * p.oa * model.count
}
