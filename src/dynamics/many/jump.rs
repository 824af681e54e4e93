//! What the rates of all do where some sprags cross a junction.
//!
//! An impulse J = (J_A, J_B) of the contacts of one changes the rates X of races and axis by M^-1 R^T J, R X being what its contacts see of
//! them (`axes`; between axes that meet the rates of the races themselves), M the inertia of all but that sprag. What it sees of them then has the
//! inertia (R M^-1 R^T)^-1 of two races.

use super::axes::Sight;
use super::run::Going;
use super::{EACH, HEAD, state_of};
use crate::dynamics::crossing::{cross_between, cross_to_another_orbit};
use crate::dynamics::model::{Grip, Mode, Place};
use nalgebra::{Matrix2, Matrix2x4, Matrix4, Vector2, Vector4};

/// A group that goes with the races as another crosses a junction.
struct TurnsAlong {
    /// What it adds to the races as it sees them, kg m^2.
    inertia: Matrix2<f64>,
    /// What alpha' takes from a jump of their rates, as it sees them.
    takes: [f64; 2],
    /// How it sees them.
    sees: Option<Matrix2x4<f64>>,
}

/// What phi' counts in the rolling of A and B.
fn along(sight: &Sight) -> [f64; 2] {
    sight.axes.as_ref().map_or([1.0; 2], |axes| axes.along)
}

impl<const N: usize> Going<'_, N> {
    /// Inertia of races (kg m^2) and axis (kg) with all groups but `those`: a sprag that rolls on both races turns along, one that rolls on
    /// one alone keeps the momentum of alpha, one that a cage carries goes with the inner race.
    pub(super) fn inertia_with_all_but(&self, those: &[usize]) -> Matrix4<f64> {
        let mut sum = Matrix4::from_diagonal(&self.rhs.inertia());
        for other in (0..self.groups.len()).filter(|other| !those.contains(other)) {
            let Some(turns) = self.turns_along(other) else { continue };
            match turns.sees {
                None => (0..4).for_each(|i| sum[(i / 2, i % 2)] += turns.inertia[(i / 2, i % 2)]),
                Some(rows) => sum += rows.transpose() * turns.inertia * rows,
            }
        }
        sum
    }

    /// R of a sprag in `sight`; `None`: the axes meet and are held. Held ones do not move.
    fn sees(&self, sight: &Sight) -> Option<Matrix2x4<f64>> {
        let mut rows = Matrix2x4::from_rows(&sight.axes.as_ref()?.races.map(|row| row.transpose()));
        if self.rhs.moved().is_none() {
            rows.fixed_columns_mut::<2>(2).fill(0.0);
        }
        Some(rows)
    }

    fn turns_along(&self, g: usize) -> Option<TurnsAlong> {
        let (model, motion) = (&self.groups[g].model, &self.rhs.motions[g]);
        if motion.waits {
            return None;
        }
        let sight = self.rhs.stands(g, motion.mode.place, self.t_s, &self.y, &state_of(&self.y, g));
        let (p, sees) = (sight.point, self.sees(&sight));
        let (n, i) = (model.count, model.inertia_kg_m2);
        let orbit = model.mass_kg * p.oc_g * p.oc_g;
        if motion.mode.place == Place::Carried {
            return Some(TurnsAlong {
                inertia: Matrix2::new(n * (i + orbit), 0.0, 0.0, 0.0),
                takes: [0.0; 2],
                sees,
            });
        }
        let inner = motion.mode.inner == Grip::Stick && motion.mode.place != Place::Open;
        let outer = motion.mode.outer == Grip::Stick;
        let [e_a, e_b] = along(&sight);
        // One race alone: e phi' = theta' + s alpha', s its rolling ratio with its sign.
        let one = |s: f64, e: f64| {
            let s = s / e;
            let along = (i * (1.0 + s) + orbit * s) / e;
            let own = i * (1.0 + s).powi(2) + orbit * s * s;
            (n * i * orbit / own / (e * e), -along / own)
        };
        let (inertia, takes) = match (inner, outer) {
            (true, true) => {
                let r = p.rho_i * e_b + p.rho_e * e_a;
                // (alpha', phi') by the rates of the races.
                let (a, f) = ([-e_b / r, e_a / r], [p.rho_e / r, p.rho_i / r]);
                let entry =
                    |u: usize, v: usize| n * (i * (a[u] + f[u]) * (a[v] + f[v]) + orbit * f[u] * f[v]);
                (Matrix2::new(entry(0, 0), entry(0, 1), entry(1, 0), entry(1, 1)), [0.0; 2])
            }
            (true, false) => {
                let (mass, takes) = one(p.rho_i, e_a);
                (Matrix2::new(mass, 0.0, 0.0, 0.0), [takes, 0.0])
            }
            (false, true) => {
                let (mass, takes) = one(-p.rho_e, e_b);
                (Matrix2::new(0.0, 0.0, 0.0, mass), [0.0, takes])
            }
            (false, false) => return None,
        };
        Some(TurnsAlong { inertia, takes, sees })
    }

    /// The rates of races (rad/s) and axis (m/s) jump by `more` as groups `those` cross a junction or are taken along: the others follow.
    /// Whether they do.
    pub(super) fn push(&mut self, more: Vector4<f64>, those: &[usize]) -> bool {
        if more == Vector4::zeros() {
            return false;
        }
        for other in (0..self.groups.len()).filter(|other| !those.contains(other)) {
            if let Some(turns) = self.turns_along(other) {
                let [inner, outer] = match turns.sees {
                    None => [more[0], more[1]],
                    Some(rows) => (rows * more).into(),
                };
                self.y[HEAD + EACH * other + 2] += turns.takes[0] * inner + turns.takes[1] * outer;
            }
        }
        self.y[2] += more[0];
        self.y[3] += more[1];
        if let Some((_, at)) = self.rhs.moved() {
            self.y[at + 2] += more[2];
            self.y[at + 3] += more[3];
        }
        true
    }

    /// Groups `those`, alike and in one state, pass from their place into `place` with the rates that keep energy and momenta.
    /// Whether the races jump.
    pub(super) fn cross(&mut self, those: &[usize], place: Place) -> bool {
        let Some(&g) = those.first() else { return false };
        let model = &self.groups[g].model;
        let mode = self.rhs.motions[g].mode;
        let own = state_of(&self.y, g);
        let [p, q] = [mode.place, place].map(|at| self.rhs.stands(g, at, self.t_s, &self.y, &own));
        let mut rates = self.rhs.goes(g, &mode, &p, &self.y, &own);
        let along = along(&p);
        // Of the races as it sees them, without what its own phi' is to that.
        for contact in 0..2 {
            rates[2 + contact] -= (1.0 - along[contact]) * rates[1];
        }
        let touching = mode.place == Place::Open;
        let held = Mode { place, inner: if touching { Grip::Slip(1.0) } else { mode.inner }, ..mode };
        let all = self.inertia_with_all_but(those);
        let times = those.len() as f64;
        // Several in one state to the last bit stand all round: they push the axis nowhere.
        let sees = self.sees(&p).filter(|_| those.len() == 1).zip(all.try_inverse());
        let seen = sees.and_then(|(rows, yields)| {
            Some((rows, yields, (rows * yields * rows.transpose()).try_inverse()?))
        });
        let races = seen.map_or(all.fixed_view::<2, 2>(0, 0).into_owned(), |(_, _, races)| races);
        let points = [&p.point, &q.point];
        // Between races that bend contact is lost and found away from first contact, where an open sprag at rest has another OC_g.
        let opens = touching || place == Place::Open;
        let after = if opens && self.rhs.bends() && p.point.oc_g != q.point.oc_g {
            cross_to_another_orbit(model, times, &held, points, rates, &races, along)
        } else {
            cross_between(model, times, &held, points, rates, &races, along)
        };
        let jump = Vector2::new(after[2] - rates[2], after[3] - rates[3]);
        let more = match seen {
            None => Vector4::new(jump[0], jump[1], 0.0, 0.0),
            Some((rows, yields, races)) => yields * rows.transpose() * (races * jump),
        };
        let pushed = self.push(more, those);
        for &g in those {
            let at = HEAD + EACH * g;
            (self.y[at + 2], self.y[at + 3]) = (after[0], after[1]);
            self.rhs.motions[g].mode = held;
        }
        // A group that rolls follows its races.
        self.hold();
        pushed
    }
}
