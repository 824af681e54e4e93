//! One sprag changes what its contacts do, the others stay as they are.

use super::found::FirstSlip;
use super::run::{Going, is_end};
use super::{EACH, EVENTS, HEAD, state_of};
use crate::dynamics::change::moving;
use crate::dynamics::choose::{Known, choose_by};
use crate::dynamics::crossing::cross_between;
use crate::dynamics::events::{INNER, LOWER, OUTER, UPPER};
use crate::dynamics::model::{Forces, Grip, Mode, Place};
use crate::dynamics::run::Stop;
use crate::ode::rhs::RightHandSide;
use crate::wedge::WedgePoint;
use nalgebra::Matrix2;

impl<const N: usize> Going<'_, N> {
    /// Rates of all sprags with their rolling constraints put in exactly.
    pub(super) fn hold(&mut self) {
        for (g, motion) in self.rhs.motions.iter().enumerate().filter(|(_, m)| !m.waits) {
            let own = state_of(&self.y, g);
            let model = &self.groups[g].model;
            let p = model.point(motion.mode.place, own[0]);
            let [da, dp, ..] = model.rates(&motion.mode, &p, &own);
            let at = HEAD + EACH * g;
            (self.y[at + 2], self.y[at + 3]) = (da, dp);
        }
    }

    /// SpragGroup `g` at event `which`. False: the run has ended.
    pub(super) fn change(&mut self, g: usize, which: usize) -> bool {
        if self.rhs.motions[g].waits {
            return self.touches(g);
        }
        self.hold();
        let model = &self.groups[g].model;
        let mode = self.rhs.motions[g].mode;
        let at = HEAD + EACH * g;
        let (t, y) = (self.t_s, self.y);
        self.rhs.look::<true, N>(t, &y);
        let Some(seen) = self.rhs.seen[g] else { return true };
        let known = |grip: Grip, here: bool, slips: f64| match grip {
            Grip::Stick if here => Known::Released(slips.signum()),
            Grip::Stick => Known::Still,
            Grip::Slip(_) if here => Known::Still,
            Grip::Slip(s) => Known::Slips(s),
        };
        let inner = known(mode.inner, which == INNER, -seen.forces.t_bi);
        let outer = known(mode.outer, which == OUTER, seen.forces.t_be);
        if !is_end(which) {
            self.choose(g, &seen.point, mode.place, inner, outer);
            return true;
        }
        let place = match (which, mode.place) {
            (LOWER, Place::Arc(0)) => Place::Open,
            (LOWER, Place::Arc(k)) => Place::Arc(k - 1),
            (LOWER, _) => {
                self.stop(Stop::FellAway, Some(g));
                return false;
            }
            (_, Place::Arc(k)) if k + 1 < model.curve.arc_count() => Place::Arc(k + 1),
            (_, Place::Arc(_)) => {
                self.stop(Stop::CurveEnd, Some(g));
                return false;
            }
            _ => Place::Arc(0),
        };
        // Exactly at the bound; first contact is left only a little below it.
        match (which, mode.place) {
            (LOWER, Place::Arc(k)) if k > 0 => self.y[at] = model.curve.arc_end_rad(k - 1),
            (UPPER, Place::Arc(k)) => self.y[at] = model.curve.arc_end_rad(k),
            (UPPER, _) => self.y[at] = model.curve.first_contact_rad(),
            _ => {}
        }
        let own = state_of(&self.y, g);
        let p = model.point(mode.place, own[0]);
        let q = model.point(place, own[0]);
        let touching = mode.place == Place::Open;
        let held = Mode { place, inner: if touching { Grip::Slip(1.0) } else { mode.inner }, ..mode };
        let races = self.races_with_all_but(g);
        let after = cross_between(model, &held, &p, &q, model.rates(&mode, &p, &own), &races);
        self.y[at + 2] = after[0];
        self.y[at + 3] = after[1];
        self.push([after[2] - own[6], after[3] - own[7]], g);
        let (v_a, v_b) = model.slip_velocities(&q, &after);
        let inner = match inner {
            _ if touching => moving(v_a),
            Known::Slips(_) => moving(v_a),
            other => other,
        };
        let outer = if matches!(outer, Known::Slips(_)) { moving(v_b) } else { outer };
        self.choose(g, &q, place, inner, outer);
        true
    }

    /// A sprag that has waited is at first contact and rolls as the races do.
    fn touches(&mut self, g: usize) -> bool {
        let model = &self.groups[g].model;
        let at = HEAD + EACH * g;
        let alpha = model.curve.first_contact_rad();
        let place = Place::Arc(0);
        let mode = Mode { place, inner: Grip::Stick, outer: Grip::Stick };
        self.y[at] = alpha;
        let q = model.point(place, alpha);
        let [da, dp, ..] = model.rates(&mode, &q, &state_of(&self.y, g));
        (self.y[at + 2], self.y[at + 3]) = (da, dp);
        self.rhs.motions[g].waits = false;
        self.rhs.motions[g].mode = mode;
        self.choose(g, &q, place, Known::Still, Known::Still);
        self.appeared_j += self.rhs.energy_of_j(g, &self.y);
        true
    }

    /// The consistent mode of group `g` where its curve is `p`, all others as they are.
    fn choose(&mut self, g: usize, p: &WedgePoint, place: Place, inner: Known, outer: Known) {
        let (t, y) = (self.t_s, self.y);
        let model = &self.groups[g].model;
        let rhs = &mut self.rhs;
        let before = rhs.motions[g].mode;
        let choice = choose_by(model, p, place, inner, outer, |mode| {
            rhs.motions[g].mode = *mode;
            rhs.look::<true, N>(t, &y);
            rhs.seen[g].as_ref().map_or((0.0, Forces::NONE), |seen| (seen.rates[0], seen.forces))
        });
        rhs.motions[g].mode = before;
        self.out.inconsistent_choices += u64::from(!choice.consistent);
        self.enter(g, choice.mode);
    }

    /// An event function is negative right at the start: chosen again with every still contact free.
    pub(super) fn give_way(&mut self, g: usize, now: &[f64; EVENTS]) -> bool {
        if self.rhs.motions[g].waits || now[LOWER] < 0.0 || now[UPPER] < 0.0 {
            let which = if now[LOWER] < 0.0 { LOWER } else { UPPER };
            return self.change(g, which);
        }
        self.hold();
        let mode = self.rhs.motions[g].mode;
        let again = |grip: Grip, negative: bool| match grip {
            Grip::Slip(s) if !negative => Known::Slips(s),
            _ => Known::Still,
        };
        let (inner, outer) = (again(mode.inner, now[INNER] < 0.0), again(mode.outer, now[OUTER] < 0.0));
        let model = &self.groups[g].model;
        let p = model.point(mode.place, state_of(&self.y, g)[0]);
        self.choose(g, &p, mode.place, inner, outer);
        if self.rhs.motions[g].mode != mode {
            return true;
        }
        // Nothing better: on in this mode for a step that rounding cannot undo; a slip against its sign then turns round.
        let Ok(slope) = self.rhs.slope(self.t_s, &self.y) else {
            self.stop(Stop::NotFinite, Some(g));
            return false;
        };
        self.t_s += 1e-12;
        for (y, rate) in self.y.iter_mut().zip(slope) {
            *y += 1e-12 * rate;
        }
        let own = state_of(&self.y, g);
        let p = model.point(mode.place, own[0]);
        let (v_a, v_b) = model.slip_velocities(&p, &model.rates(&mode, &p, &own));
        let with = |grip: Grip, v: f64| match grip {
            Grip::Slip(s) if s * v < 0.0 => Grip::Slip(-s),
            _ => grip,
        };
        self.enter(g, Mode { inner: with(mode.inner, v_a), outer: with(mode.outer, v_b), ..mode });
        true
    }

    /// Go on with group `g` in `mode`.
    pub(super) fn enter(&mut self, g: usize, mode: Mode) {
        let model = &self.groups[g].model;
        let own = state_of(&self.y, g);
        let p = model.point(mode.place, own[0]);
        let before = self.rhs.motions[g].mode;
        let closed = |mode: &Mode| matches!(mode.place, Place::Arc(_));
        let both = mode.inner == Grip::Stick && mode.outer == Grip::Stick;
        self.rhs.motions[g].mode = mode;
        self.rhs.motions[g].phase = (both && closed(&mode)).then(|| own[2] - own[3] + p.windup);
        self.hold();
        let course = &mut self.out.courses[g];
        if course.catches_s.is_none() && closed(&mode) && mode.inner != Grip::Slip(1.0) {
            course.catches_s = Some(self.t_s);
        } else if course.catches_s.is_some() && course.slips.is_none() && closed(&before) && closed(&mode) {
            let begins = |from: Grip, to: Grip| from == Grip::Stick && to != Grip::Stick;
            let [a, b] = [begins(before.inner, mode.inner), begins(before.outer, mode.outer)];
            course.slips = (a || b).then_some(FirstSlip { t_s: self.t_s, inner: a, normal_n: p.n_bi });
        }
        match (mode.place == Place::Open, self.open_since[g]) {
            (true, None) if course.catches_s.is_some() => self.open_since[g] = Some(self.t_s),
            (false, Some(since)) => {
                course.open_s += self.t_s - since;
                self.open_since[g] = None;
            }
            _ => {}
        }
    }

    /// Inertia that an impulse on the races meets, with all groups but `g`, kg m^2: a sprag that rolls on both races turns along,
    /// one that rolls on one alone keeps the momentum of alpha.
    fn races_with_all_but(&self, g: usize) -> Matrix2<f64> {
        let races = &self.groups[0].model;
        let mut sum = Matrix2::new(races.inner_inertia_kg_m2, 0.0, 0.0, races.outer_inertia_kg_m2);
        for other in (0..self.groups.len()).filter(|other| *other != g) {
            let Some(turns) = self.turns_along(other) else { continue };
            sum += turns.0;
        }
        sum
    }

    /// Inertia that group `g` adds to the races, kg m^2, and what alpha' takes from a jump of their rates.
    fn turns_along(&self, g: usize) -> Option<(Matrix2<f64>, [f64; 2])> {
        let (model, motion) = (&self.groups[g].model, &self.rhs.motions[g]);
        if motion.waits {
            return None;
        }
        let p = model.point(motion.mode.place, state_of(&self.y, g)[0]);
        let (n, i) = (model.count, model.inertia_kg_m2);
        let orbit = model.mass_kg * p.oc_g * p.oc_g;
        let inner = motion.mode.inner == Grip::Stick && motion.mode.place != Place::Open;
        let outer = motion.mode.outer == Grip::Stick;
        // One race alone: phi' = theta' + s alpha', s its rolling ratio with its sign.
        let one = |s: f64| {
            let along = i * (1.0 + s) + orbit * s;
            let own = i * (1.0 + s).powi(2) + orbit * s * s;
            (n * i * orbit / own, -along / own)
        };
        Some(match (inner, outer) {
            (true, true) => {
                let r = p.rho_i + p.rho_e;
                // (alpha', phi') by the rates of the races.
                let (a, f) = ([-1.0 / r, 1.0 / r], [p.rho_e / r, p.rho_i / r]);
                let entry =
                    |u: usize, v: usize| n * (i * (a[u] + f[u]) * (a[v] + f[v]) + orbit * f[u] * f[v]);
                (Matrix2::new(entry(0, 0), entry(0, 1), entry(1, 0), entry(1, 1)), [0.0; 2])
            }
            (true, false) => {
                let (mass, takes) = one(p.rho_i);
                (Matrix2::new(mass, 0.0, 0.0, 0.0), [takes, 0.0])
            }
            (false, true) => {
                let (mass, takes) = one(-p.rho_e);
                (Matrix2::new(0.0, 0.0, 0.0, mass), [0.0, takes])
            }
            (false, false) => return None,
        })
    }

    /// The rates of the races jump by `more` (rad/s) as group `g` crosses a junction: the others follow.
    fn push(&mut self, more: [f64; 2], g: usize) {
        if more == [0.0; 2] {
            return;
        }
        for other in (0..self.groups.len()).filter(|other| *other != g) {
            if let Some((_, takes)) = self.turns_along(other) {
                self.y[HEAD + EACH * other + 2] += takes[0] * more[0] + takes[1] * more[1];
            }
        }
        self.y[2] += more[0];
        self.y[3] += more[1];
        // A group that rolls follows its races; that which crosses has its rates already.
        let at = HEAD + EACH * g;
        let kept = [self.y[at + 2], self.y[at + 3]];
        self.hold();
        (self.y[at + 2], self.y[at + 3]) = (kept[0], kept[1]);
    }
}
