//! Many unlike sprags between two races: each rolls, slips and lifts by itself, the two rotations couple them.
//!
//! Sprag g has the equations of [`Model::forces`] on its own curve. Given the accelerations x = (theta_bi'', theta_be'') of the
//! races, its rows (rolling where a contact holds, friction where it slips) are two linear equations for its T = (T_bi, T_be),
//!
//!   A_g T_g = b_g - S_g x,   S_g = diag(1 where A holds, 1 where B holds),   so   T_g = A_g^-1 b_g - A_g^-1 S_g x,
//!
//! and (15) with the sum over all of them is one 2x2 system:
//!
//!   [I + sum n_g R_g A_g^-1 S_g] x = f + sum n_g R_g A_g^-1 b_g,   I = diag(I_bi, I_be),   R_g = diag(OA_g, -OB_g),
//!
//! f the torques from outside, the damping between the races and the abutment. n_g sprags that are alike are computed once.
//! With one group this is [`Model::forces`].
//!
//! A sprag that lacks something to touch waits: until the races have wound up by its lag since torque began (in an overrun, since
//! they turned back) it is turned along without a force, as in statics. Then it is at first contact, rolling, and its grip
//! is chosen.
//!
//! State: theta_bi, theta_be, their rates, five works, then of each group alpha, phi, their rates and the slips at A and B.

mod change;
mod found;
mod run;
mod start;

pub use found::{FirstSlip, ManyRun, ManySample, SpragCourse};
pub use run::run_many;
pub use start::settled_together;

use super::events::{EVENTS, Probe, probe_of};
use super::model::{Forces, Grip, Loose, Mode, Model, Place};
use super::{N_STATE, State};
use crate::ode::rhs::RightHandSide;
use crate::wedge::WedgePoint;
use nalgebra::{Matrix2, Vector2};

/// Races and works.
const HEAD: usize = 9;
/// Of one group.
const EACH: usize = 6;
/// Works: friction, damping, torque on the inner and on the outer race, sum of all magnitudes.
const WORKS: usize = 5;
const FIRST_WORK: usize = HEAD - WORKS;
/// Probes at a step.
const PROBES: usize = crate::ode::dop853::PROBES.len();

/// Sprags that are alike, as many as `model` counts.
#[derive(Debug, Clone)]
pub struct SpragGroup {
    /// Their own curve, friction and spring; races and loads of the first group count for all.
    pub model: Model,
    /// Windup of the races from which on they touch, rad; `None`: they touch at the start.
    pub lag_rad: Option<f64>,
}

/// Where a group is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpragMotion {
    /// What its contacts do; means nothing while it waits.
    pub mode: Mode,
    /// Whether it does not touch yet.
    pub waits: bool,
    /// theta_bi - theta_be + W(alpha) while both contacts hold, rad.
    phase: Option<f64>,
}

/// Where a run begins.
#[derive(Debug, Clone)]
pub struct ManyStart {
    /// Angles (rad) and rates (rad/s) of both races, inner first.
    pub races: [f64; 4],
    /// alpha and its rate, phi and its rate of each group.
    pub sprags: Vec<[f64; 4]>,
    /// What each does.
    pub motions: Vec<SpragMotion>,
}

/// One group at one instant.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen {
    pub(super) point: WedgePoint,
    pub(super) rates: [f64; 4],
    pub(super) forces: Forces,
}

/// One group while the races' accelerations are sought.
struct Part {
    of: Loose,
    a: Matrix2<f64>,
    b: Vector2<f64>,
    holds: [bool; 2],
    /// T at x = 0, N, and -dT/dx.
    still: Vector2<f64>,
    yields: Matrix2<f64>,
    let_go: bool,
}

impl Part {
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

    fn tangential(&self, x: &Vector2<f64>) -> [f64; 2] {
        let t = self.still - self.yields * x;
        [t[0], t[1]]
    }
}

/// The right-hand side while every group is in one mode, with what it sees on its way.
struct Rhs<'a> {
    groups: &'a [SpragGroup],
    motions: Vec<SpragMotion>,
    /// theta_be - theta_bi from which the windup counts that a waiting group waits for, rad.
    reference_rad: f64,
    parts: Vec<Option<Part>>,
    seen: Vec<Option<Seen>>,
    probes: [Vec<Probe>; PROBES],
}

/// The state of group `g` in the order of the one-sprag model.
fn state_of<const N: usize>(y: &[f64; N], g: usize) -> State {
    let s = &y[HEAD + EACH * g..HEAD + EACH * (g + 1)];
    [s[0], s[1], y[0], y[1], s[2], s[3], y[2], y[3], s[4], s[5]]
}

impl<'a> Rhs<'a> {
    fn new(groups: &'a [SpragGroup], motions: Vec<SpragMotion>, reference_rad: f64) -> Self {
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

    /// All forces at (t, y), left in `seen`.
    fn look<const RADIAL: bool, const N: usize>(&mut self, t: f64, y: &[f64; N]) {
        let races = &self.groups[0].model;
        let drag = races.damping_nm_s_per_rad * (y[2] - y[3]);
        let [torque_i, torque_e] = races.torques_nm(t);
        let f = Vector2::new(torque_i - drag, torque_e + drag - races.loads.abutment_nm_per_rad * y[1]);
        for (g, (group, motion)) in self.groups.iter().zip(&self.motions).enumerate() {
            (self.parts[g], self.seen[g]) = (None, None);
            if motion.waits {
                continue;
            }
            let (model, mode) = (&group.model, &motion.mode);
            let own = state_of(y, g);
            let p = model.point(mode.place, own[0]);
            let rates = model.rates(mode, &p, &own);
            let of = model.loose::<RADIAL, N_STATE>(mode, t, &own, &p, &rates);
            let (a, b) = model.grips(mode, &p, &rates, &of, [0.0; 2], [0.0; 2]);
            let holds = [mode.inner == Grip::Stick && mode.place != Place::Open, mode.outer == Grip::Stick];
            let zero = (Vector2::zeros(), Matrix2::zeros());
            let mut part = Part { of, a, b, holds, still: zero.0, yields: zero.1, let_go: false };
            part.solve();
            // Accelerations follow below; forces until then are none.
            let forces = part.of.forces([0.0; 2], 0.0, [0.0; 2]);
            (self.parts[g], self.seen[g]) = (Some(part), Some(Seen { point: p, rates, forces }));
        }
        // A contact B that lets go changes the system, at most once each.
        for _ in 0..=self.groups.len() {
            let mut mass = Matrix2::new(races.inner_inertia_kg_m2, 0.0, 0.0, races.outer_inertia_kg_m2);
            let mut torque = f;
            let parts = self.parts.iter().zip(&self.seen).zip(self.groups);
            for ((part, seen), group) in parts {
                let (Some(part), Some(seen)) = (part, seen) else { continue };
                let n = group.model.count;
                for (row, arm) in [n * seen.point.oa, -n * seen.point.ob].into_iter().enumerate() {
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
                let t = part.tangential(&x);
                let n_be = if part.let_go { 0.0 } else { part.of.outer_n(t[0], t[1]) };
                if n_be < 0.0 && !part.holds[1] {
                    part.let_go = true;
                    part.solve();
                    again = true;
                }
                seen.forces = part.of.forces(t, n_be, [x[0], x[1]]);
            }
            if !again {
                return;
            }
        }
    }

    /// What is seen of group `g` after [`Self::look`] at y.
    fn probe<const N: usize>(&self, g: usize, y: &[f64; N]) -> Probe {
        let motion = &self.motions[g];
        match (&self.seen[g], self.groups[g].lag_rad) {
            (Some(s), _) => {
                let own = state_of(y, g);
                probe_of(&self.groups[g].model, &motion.mode, &own, &s.point, &s.forces, true)
            }
            (None, lag) => {
                let left = lag.unwrap_or(f64::INFINITY) - (y[1] - y[0] - self.reference_rad);
                Probe { events: [1.0, left, 1.0, 1.0], figures: [0.0; 5], ..Probe::NOTHING }
            }
        }
    }

    /// Event functions of group `g` at (t, y).
    fn events<const N: usize>(&mut self, g: usize, t: f64, y: &[f64; N]) -> [f64; EVENTS] {
        self.look::<true, N>(t, y);
        self.probe(g, y).events
    }

    /// The slope after [`Self::look`] at y; `Err` where it is not finite.
    fn slope_there<const N: usize>(&self, t: f64, y: &[f64; N]) -> Result<[f64; N], ()> {
        let mut out = [0.0; N];
        let races = &self.groups[0].model;
        let (di, de) = (y[2], y[3]);
        (out[0], out[1]) = (di, de);
        let (mut friction, mut through) = (0.0, 0.0);
        let mut damping = -races.damping_nm_s_per_rad * (di - de).powi(2);
        let mut moved = false;
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
            if !moved {
                (out[2], out[3]) = (f.acceleration[2], f.acceleration[3]);
                moved = true;
            }
            let works = [model.count * f.t_bi * f.v_a * slips_a, -model.count * f.t_be * f.v_b * slips_b];
            friction += works[0] + works[1];
            through += works[0].abs() + works[1].abs();
            let speed = model.curve.speed_rad_s();
            damping += model.count * model.damped(&s.point, speed, s.rates[0]).1 * s.rates[0];
        }
        let [torque_i, torque_e] = races.torques_nm(t);
        if !moved {
            let drag = races.damping_nm_s_per_rad * (di - de);
            out[2] = (torque_i - drag) / races.inner_inertia_kg_m2;
            out[3] = (torque_e + drag - races.loads.abutment_nm_per_rad * y[1]) / races.outer_inertia_kg_m2;
        }
        let works = [friction, damping, torque_i * di, torque_e * de];
        out[FIRST_WORK..HEAD - 1].copy_from_slice(&works);
        out[HEAD - 1] = through + works[1..].iter().map(|w| w.abs()).sum::<f64>();
        let finite = out.iter().map(|v| 0.0 * v).sum::<f64>() == 0.0;
        if finite { Ok(out) } else { Err(()) }
    }

    /// Rolling rates put in exactly, and the energy in motion and stored but for the contacts, J.
    fn energy_j<const N: usize>(&self, y: &[f64; N]) -> f64 {
        let races = &self.groups[0].model;
        let own = |g: usize| self.energy_of_j(g, y);
        (0..self.groups.len()).map(own).sum::<f64>()
            + 0.5 * races.inner_inertia_kg_m2 * y[2] * y[2]
            + 0.5 * races.outer_inertia_kg_m2 * y[3] * y[3]
            + 0.5 * races.loads.abutment_nm_per_rad * y[1] * y[1]
    }

    /// Energy of group `g` from first contact on, J; none while it waits.
    fn energy_of_j<const N: usize>(&self, g: usize, y: &[f64; N]) -> f64 {
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
        self.look::<false, N>(t, y);
        self.slope_there(t, y)
    }

    fn slope_at_probe(&mut self, probe: usize, t: f64, y: &[f64; N]) -> Result<[f64; N], ()> {
        self.look::<true, N>(t, y);
        for g in 0..self.groups.len() {
            self.probes[probe][g] = self.probe(g, y);
        }
        self.slope_there(t, y)
    }
}
