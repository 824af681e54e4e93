//! The right-hand side of all sprags: forces of each, accelerations of the races under their sum.

use super::{EACH, FIRST_WORK, HEAD, PROBES, SpragGroup, SpragMotion, state_of};
use crate::dynamics::choose::EXCESS;
use crate::dynamics::events::{INNER, OUTER, Probe, probe_of, without_forces};
use crate::dynamics::model::{Forces, Grip, Loose, Mode, Model, Place};
use crate::dynamics::{N_STATE, State};
use crate::ode::rhs::RightHandSide;
use crate::wedge::WedgePoint;
use nalgebra::{Matrix2, Vector2};

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
        p: &WedgePoint,
        rates: &[f64; 4],
    ) -> Self {
        let of = model.loose::<RADIAL, N_STATE>(mode, t, own, p, rates);
        let (a, b) = model.grips(mode, p, rates, &of, [0.0; 2], [0.0; 2]);
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

    /// Forces where the races go at `x`, rad/s^2; whether B has let go of what it is not held by.
    fn under(&mut self, x: &Vector2<f64>) -> (Forces, bool) {
        let t = self.still - self.yields * x;
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
    pub(super) motions: Vec<SpragMotion>,
    /// theta_be - theta_bi from which the windup counts that a waiting group waits for, rad.
    pub(super) reference_rad: f64,
    parts: Vec<Option<GroupRhs>>,
    pub(super) seen: Vec<Option<Seen>>,
    pub(super) probes: [Vec<Probe>; PROBES],
}

/// What a newton of T_bi and of T_be on each sprag of `model` does to the races, N m.
pub(super) fn arms(model: &Model, p: &WedgePoint) -> [f64; 2] {
    [model.count * p.oa, -model.count * p.ob]
}

impl<'a> Rhs<'a> {
    pub(super) fn new(groups: &'a [SpragGroup], motions: Vec<SpragMotion>, reference_rad: f64) -> Self {
        let n = groups.len();
        Self {
            groups,
            motions,
            reference_rad,
            parts: (0..n).map(|_| None).collect(),
            seen: vec![None; n],
            probes: std::array::from_fn(|_| vec![Probe::NOTHING; n]),
        }
    }

    /// Torques on the races but for those of the sprags, N m.
    pub(super) fn torques_nm(&self, t: f64, y: &[f64]) -> Vector2<f64> {
        let races = &self.groups[0].model;
        let drag = races.damping_nm_s_per_rad * (y[2] - y[3]);
        let [torque_i, torque_e] = races.torques_nm(t);
        Vector2::new(torque_i - drag, torque_e + drag - races.loads.abutment_nm_per_rad * y[1])
    }

    /// All forces at (t, y), left in `seen`; the accelerations of the races, rad/s^2.
    pub(super) fn look<const RADIAL: bool>(&mut self, t: f64, y: &[f64]) -> Vector2<f64> {
        let races = &self.groups[0].model;
        let f = self.torques_nm(t, y);
        for (g, (group, motion)) in self.groups.iter().zip(&self.motions).enumerate() {
            (self.parts[g], self.seen[g]) = (None, None);
            if motion.waits {
                continue;
            }
            let (model, mode) = (&group.model, &motion.mode);
            let own = state_of(y, g);
            let p = model.point(mode.place, own[0]);
            let rates = model.rates(mode, &p, &own);
            self.parts[g] = Some(GroupRhs::new::<RADIAL>(model, mode, t, &own, &p, &rates));
            // Forces follow below.
            self.seen[g] = Some(Seen { point: p, rates, forces: Forces::NONE });
        }
        // A contact B that lets go changes the system, at most once each.
        loop {
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
            let determinant = mass[(0, 0)] * mass[(1, 1)] - mass[(0, 1)] * mass[(1, 0)];
            let x = Vector2::new(
                (torque[0] * mass[(1, 1)] - torque[1] * mass[(0, 1)]) / determinant,
                (mass[(0, 0)] * torque[1] - mass[(1, 0)] * torque[0]) / determinant,
            );
            let mut again = false;
            for (part, seen) in self.parts.iter_mut().zip(&mut self.seen) {
                let (Some(part), Some(seen)) = (part, seen) else { continue };
                let (forces, lets_go) = part.under(&x);
                (seen.forces, again) = (forces, again || lets_go);
            }
            if !again {
                return x;
            }
        }
    }

    /// Rate of alpha (rad/s) and forces of group `g` in `mode` while the races go at `x`, rad/s^2, whatever the others do.
    pub(super) fn between(
        &self,
        g: usize,
        mode: &Mode,
        t: f64,
        y: &[f64],
        x: &Vector2<f64>,
    ) -> (f64, Forces) {
        let (model, own) = (&self.groups[g].model, state_of(y, g));
        let p = model.point(mode.place, own[0]);
        let rates = model.rates(mode, &p, &own);
        let mut part = GroupRhs::new::<true>(model, mode, t, &own, &p, &rates);
        let (forces, lets_go) = part.under(x);
        (rates[0], if lets_go { part.under(x).0 } else { forces })
    }

    /// What is seen of group `g` after [`Self::look`] at y.
    pub(super) fn probe(&self, g: usize, y: &[f64]) -> Probe {
        let motion = &self.motions[g];
        match (&self.seen[g], self.groups[g].lag_rad) {
            (Some(s), _) => {
                let model = &self.groups[g].model;
                let own = state_of(y, g);
                let mut seen = probe_of(model, &motion.mode, &own, &s.point, &s.forces, true);
                let (mu, f) = (model.friction.static_, &s.forces);
                if motion.mode.inner == Grip::Stick && motion.mode.place != Place::Open {
                    seen.events[INNER] += SLACK * mu * f.n_bi;
                }
                if motion.mode.outer == Grip::Stick && !model.outer_holds {
                    seen.events[OUTER] += SLACK * mu * f.n_be;
                }
                seen
            }
            (None, lag) => {
                let left = lag.unwrap_or(f64::INFINITY) - (y[1] - y[0] - self.reference_rad);
                Probe { events: [1.0, left, 1.0, 1.0], figures: [0.0; 5], ..Probe::NOTHING }
            }
        }
    }

    /// Group `g` looked at in (t, y).
    pub(super) fn sight(&mut self, g: usize, t: f64, y: &[f64]) -> Probe {
        self.look::<true>(t, y);
        self.probe(g, y)
    }

    /// Event function `which` of group `g` at (t, y) alone: the ends of a place need no forces, a slip velocity no friction.
    pub(super) fn event(&mut self, g: usize, which: usize, t: f64, y: &[f64]) -> f64 {
        let (model, motion) = (&self.groups[g].model, &self.motions[g]);
        let own = state_of(y, g);
        let known = if motion.waits { None } else { without_forces(model, &motion.mode, &own, which) };
        known.unwrap_or_else(|| self.sight(g, t, y).events[which])
    }

    /// The slope after [`Self::look`] at y; `Err` where it is not finite.
    fn slope_there<const N: usize>(&self, t: f64, y: &[f64; N], x: &Vector2<f64>) -> Result<[f64; N], ()> {
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
        }
        let [torque_i, torque_e] = races.torques_nm(t);
        let works = [friction, damping, torque_i * di, torque_e * de];
        out[FIRST_WORK..HEAD - 1].copy_from_slice(&works);
        out[HEAD - 1] = through + works[1..].iter().map(|w| w.abs()).sum::<f64>();
        let finite = out.iter().map(|v| 0.0 * v).sum::<f64>() == 0.0;
        if finite { Ok(out) } else { Err(()) }
    }

    /// Rolling rates put in exactly, and the energy in motion and stored but for the contacts, J.
    pub(super) fn energy_j(&self, y: &[f64]) -> f64 {
        let races = &self.groups[0].model;
        let own = |g: usize| self.energy_of_j(g, y);
        (0..self.groups.len()).map(own).sum::<f64>()
            + 0.5 * races.inner_inertia_kg_m2 * y[2] * y[2]
            + 0.5 * races.outer_inertia_kg_m2 * y[3] * y[3]
            + 0.5 * races.loads.abutment_nm_per_rad * y[1] * y[1]
    }

    /// Energy of group `g` from first contact on, J; none while it waits.
    pub(super) fn energy_of_j(&self, g: usize, y: &[f64]) -> f64 {
        let (model, motion) = (&self.groups[g].model, &self.motions[g]);
        if motion.waits {
            return 0.0;
        }
        let own = state_of(y, g);
        let p = model.point(motion.mode.place, own[0]);
        let [da, dp, ..] = model.rates(&motion.mode, &p, &own);
        let mut alone = own;
        alone[3] = 0.0;
        model.energy_without_wedge(&p, &[da, dp, 0.0, 0.0], &alone)
            + model.wedge_energy_j(model.curve.first_contact_rad(), own[0])
    }
}

impl<const N: usize> RightHandSide<N> for Rhs<'_> {
    type Failure = ();

    fn slope(&mut self, t: f64, y: &[f64; N]) -> Result<[f64; N], ()> {
        let x = self.look::<false>(t, y);
        self.slope_there(t, y, &x)
    }

    fn slope_at_probe(&mut self, probe: usize, t: f64, y: &[f64; N]) -> Result<[f64; N], ()> {
        let x = self.look::<true>(t, y);
        for g in 0..self.groups.len() {
            self.probes[probe][g] = self.probe(g, y);
        }
        self.slope_there(t, y, &x)
    }
}
