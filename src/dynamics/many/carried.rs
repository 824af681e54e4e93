//! Sprags that a driven cage carries among others.
//!
//! Without play the cage is one body with the inner race and has no coordinate. A carried group moves as `dynamics::carried` has it,
//! phi' = theta_bi', alpha' = 0: n (I_g + m_g OC_g^2) more inertia of that race, and T_be = -mu N_be at OB on both. Under given
//! accelerations of the races each N_be is by itself; it falls with that of the cage, w, linearly on the inner race and on the stop,
//! and by a root of its tilt in between. So with N_be = N_0 + N' (w - w_0) the rows of the races read
//!
//!   [I_bi + sum n (J + mu OB N')] theta_bi'' + ... = f_i + ... - sum n mu OB (N_0 - N' w_0)
//!   I_be theta_be'' - sum n mu OB N' theta_bi'' + ... = f_e + ... + sum n mu OB (N_0 - N' w_0)
//!
//! and Newton's method settles w: in one step where all are linear.
//!
//! Groups that are taken along at one time share the blow: with M the inertia of races and all the others (`jump`), and the momentum
//! that each group has beyond that of the cage,
//!
//!   D = sum n [(I_g + m_g OC_g^2)(phi' - theta_bi') + I_g alpha'],   theta' jumps by M^-1 e_i D/(1 + (M^-1)_ii sum n J).
//!
//! A contact that rolls goes on rolling: what this asks of it is the sprag's own inertia times that jump, of a blow that lasts some
//! 30 us a twentieth of a newton. The energy that is lost counts as such.

use super::change::Falls;
use super::rhs::{Rhs, Seen};
use super::run::Going;
use super::{EACH, HEAD, SpragMotion, state_of};
use crate::dynamics::carried::{Carried, Ride};
use crate::dynamics::change::moving;
use crate::dynamics::choose::Known;
use crate::dynamics::events::{INNER, LOWER, OUTER, Probe, UPPER, figures};
use crate::dynamics::model::{Forces, Grip, Mode, Model, N_STATE, Place};
use crate::dynamics::start::settled;
use crate::wedge::WedgePoint;
use nalgebra::{Matrix2, Vector2, Vector4};

/// Steps of Newton's method for the cage's acceleration at most: one to three are needed.
const MOST: u32 = 40;
/// What it may leave of N_be, as a part of what that is left over from: rounding.
const SETTLED: f64 = 1e-14;

/// A group that a cage carries while the races' accelerations are sought.
#[derive(Debug, Clone, Copy)]
pub(super) struct Riding {
    /// Which.
    pub(super) g: usize,
    /// n (I_g + m_g OC_g^2), kg m^2.
    inertia_kg_m2: f64,
    /// n mu OB, m.
    drags_m: f64,
    cage_rad_s: f64,
    mu: f64,
    /// How it rides at that theta_bi'', rad/s^2; `None`: not known yet.
    ride: Option<Ride>,
    at: f64,
    steps: u32,
}

/// Whether the accelerations are those under which all ride as is taken.
pub(super) enum Rides {
    Settled,
    Again,
    NoConvergence,
}

impl Riding {
    pub(super) fn new(model: &Model, g: usize, t: f64, p: &WedgePoint, rates: &[f64; 4]) -> Self {
        let mu = model.mu_outer(model.slip_velocities(p, rates).1);
        Self {
            g,
            inertia_kg_m2: model.count * model.orbit_kg_m2(p),
            drags_m: model.count * mu * p.ob,
            cage_rad_s: model.mean_speed(t).0 + rates[2],
            mu,
            ride: None,
            at: 0.0,
            steps: 0,
        }
    }

    /// How a sprag of `model` rides while the inner race goes at `inner`, rad/s^2; off the outer race nothing presses there.
    fn ride(&self, model: &Model, carried: &Carried, mode: &Mode, inner: f64) -> Ride {
        let ride = carried.ride(model, self.cage_rad_s, self.mu, [inner, 0.0]);
        if mode.is_off() { Ride { n_be: 0.0, per_w: 0.0, ..ride } } else { ride }
    }

    /// What it is to the races.
    pub(super) fn turns_with(&self, mass: &mut Matrix2<f64>, torque: &mut Vector2<f64>) {
        mass[(0, 0)] += self.inertia_kg_m2;
        let Some(ride) = self.ride else { return };
        let (drag, yields) = (self.drags_m * (ride.n_be - ride.per_w * self.at), self.drags_m * ride.per_w);
        mass[(0, 0)] += yields;
        mass[(1, 0)] -= yields;
        torque[0] -= drag;
        torque[1] += drag;
    }
}

impl Rhs<'_> {
    /// How carried groups ride while the races go at `x`, rad/s^2, and their forces.
    pub(super) fn ride_under(&mut self, t: f64, x: &Vector4<f64>) -> Rides {
        let mut rides = Rides::Settled;
        for riding in &mut self.riding {
            let (model, mode) = (&self.groups[riding.g].model, &self.motions[riding.g].mode);
            let (Some(carried), Some(seen)) = (&model.carried, &mut self.seen[riding.g]) else { continue };
            let ride = riding.ride(model, carried, mode, x[0]);
            let taken = riding.ride.map(|taken| taken.n_be + taken.per_w * (x[0] - riding.at));
            let settled = taken.is_some_and(|taken| (ride.n_be - taken).abs() <= SETTLED * ride.size_n);
            (riding.ride, riding.at, riding.steps) = (Some(ride), x[0], riding.steps + 1);
            seen.forces = model.riding(mode, t, &seen.point, &seen.rates, &ride, [x[0], x[1]]);
            rides = match rides {
                Rides::NoConvergence => Rides::NoConvergence,
                _ if !settled && riding.steps > MOST => Rides::NoConvergence,
                Rides::Settled if settled => Rides::Settled,
                _ => Rides::Again,
            };
        }
        rides
    }

    /// Forces of carried group `g`, where the curve is `p`, while the races go at `x`, rad/s^2, whatever the others do.
    pub(super) fn carried_under(
        &self,
        g: usize,
        t: f64,
        y: &[f64],
        p: &WedgePoint,
        x: &Vector4<f64>,
    ) -> Forces {
        let (model, mode) = (&self.groups[g].model, &self.motions[g].mode);
        let Some(carried) = &model.carried else { return Forces::NONE };
        let rates = model.rates(mode, p, &state_of(y, g));
        let ride = Riding::new(model, g, t, p, &rates).ride(model, carried, mode, x[0]);
        model.riding(mode, t, p, &rates, &ride, [x[0], x[1]])
    }

    /// How carried group `g` rides after [`Self::look`].
    fn rides(&self, g: usize) -> Option<Ride> {
        self.riding.iter().find(|riding| riding.g == g)?.ride
    }

    /// What is seen of carried group `g` after [`Self::look`] at y.
    pub(super) fn probe_carried(&self, g: usize, seen: &Seen, y: &[f64]) -> Probe {
        let mode = &self.motions[g].mode;
        let off_nm = self.rides(g).map_or(f64::NAN, |ride| ride.off_nm);
        let outer = match mode.outer {
            Grip::Slip(s) => s * seen.forces.v_b,
            Grip::Stick => 1.0,
        };
        Probe {
            events: [1.0, 1.0, if mode.is_off() { off_nm } else { -off_nm }, outer],
            figures: figures(false, &seen.forces, 1.0),
            rho: seen.point.rho_i + seen.point.rho_e,
            windup: seen.point.windup,
            radial_m_s2: 0.0,
            outer_rate_rad_s: y[3],
        }
    }
}

impl<const N: usize> Going<'_, N> {
    /// Carried groups where the outer race comes to run as fast, or where they come off that race or back to it (`falls`): one that is as
    /// fast, or faster, takes them into the wedge. What is `known` of the contacts of those then.
    pub(super) fn catch_up(&mut self, falls: &Falls, known: &mut [[Known; 2]]) {
        let comes = |g: &usize| {
            let motion = &self.rhs.motions[*g];
            motion.mode.place == Place::Carried && !motion.waits && (falls[*g][INNER] || falls[*g][OUTER])
        };
        let those: Vec<usize> = (0..falls.len()).filter(comes).collect();
        if those.is_empty() {
            return;
        }
        let (t, y) = (self.t_s, self.y);
        self.rhs.look::<true>(t, &y);
        let before_j = self.rhs.energy_j(t, &y);
        let mut let_go = Vec::new();
        for g in those {
            let mode = self.rhs.motions[g].mode;
            let lags = matches!(mode.outer, Grip::Slip(s) if s < 0.0);
            self.rhs.motions[g].mode = match (falls[g][OUTER], mode.is_off()) {
                (true, true) => Mode { outer: Grip::Slip(if lags { 1.0 } else { -1.0 }), ..mode },
                (false, false) => Mode { inner: Mode::OFF, ..mode },
                (false, true) if lags => Mode { inner: Mode::PRESSED, ..mode },
                _ => {
                    let v_b = self.rhs.seen[g].map_or(0.0, |seen| seen.forces.v_b);
                    known[g] = [Known::Still, if lags { Known::Still } else { moving(v_b.max(0.0)) }];
                    let_go.push(g);
                    self.let_go(g)
                }
            };
        }
        self.stand_bent(&let_go);
        self.appeared_j += self.rhs.energy_j(self.t_s, &self.y) - before_j;
    }

    /// How carried group `g` begins where it is let go: open by its tilt, or pressed in as its spring does between races that stand still
    /// against one another. Its rates are those that it has had.
    fn let_go(&mut self, g: usize) -> Mode {
        let at = HEAD + EACH * g;
        let tilt_rad = self.rhs.rides(g).map_or(0.0, |ride| ride.tilt_rad);
        let mut place = Place::Open;
        if tilt_rad > 0.0 {
            self.y[at] -= tilt_rad;
        } else {
            let pressed = settled(&self.groups[g].model, 0.0);
            place = pressed.map_or(Place::Arc(0), |(_, place)| place);
            self.y[at] = pressed.map_or(self.y[at], |(state, _)| state[0]);
        }
        Mode { place, inner: Grip::Slip(1.0), outer: Grip::Slip(1.0) }
    }

    /// Groups `those` between races that the others, and they, bend: open where the races are apart, no farther in than they touch.
    fn stand_bent(&mut self, those: &[usize]) {
        let apart = |rhs: &Rhs<'_>, y: &[f64; N], g: usize| rhs.bent(y, |bent| bent.pressed_rad(g) < 0.0);
        let closed = |rhs: &Rhs<'_>, g: usize| rhs.motions[g].mode.place != Place::Open;
        // One that opens leaves more of the races to the others.
        while let Some(&g) =
            those.iter().find(|&&g| closed(&self.rhs, g) && apart(&self.rhs, &self.y, g) == Some(true))
        {
            self.rhs.motions[g].mode.place = Place::Open;
        }
        for &g in those {
            if !closed(&self.rhs, g) && apart(&self.rhs, &self.y, g) == Some(false) {
                let at = HEAD + EACH * g;
                self.y[at] = self.y[at].min(self.rhs.touch_rad(g, &self.y));
            }
        }
    }

    /// Group `g`, which has waited, would touch now, and goes on with the cage instead where that turns so fast that it is off the outer
    /// race. Whether it does.
    pub(super) fn stays_off(&mut self, g: usize) -> bool {
        let (t, y, at) = (self.t_s, self.y, HEAD + EACH * g);
        let model = &self.groups[g].model;
        let (Some(carried), None) = (&model.carried, self.rhs.axes) else { return false };
        let x = self.rhs.look::<true>(t, &y);
        let alpha = model.curve.first_contact_rad();
        let p = model.point(Place::Carried, alpha);
        let outer = Grip::Slip(if y[3] < y[2] { -1.0 } else { 1.0 });
        let mode = Mode { place: Place::Carried, inner: Mode::OFF, outer };
        let rates = [0.0, y[2], y[2], y[3]];
        let ride = Riding::new(model, g, t, &p, &rates).ride(model, carried, &mode, x[0]);
        if ride.off_nm <= 0.0 {
            return false;
        }
        (self.y[at], self.y[at + 2], self.y[at + 3]) = (alpha, 0.0, y[2]);
        self.rhs.motions[g] = SpragMotion::touching(mode);
        self.appeared_j += self.rhs.energy_of_j(g, t, &self.y);
        true
    }

    /// A driven cage takes groups along that touch, or cease to (`falls`), behind the inner race while the outer one lags. Which.
    pub(super) fn take_along(&mut self, falls: &Falls) -> Vec<usize> {
        let motions = &self.rhs.motions;
        let comes = |g: &usize| {
            !motions[*g].waits
                && self.groups[*g].model.carried.is_some()
                && match motions[*g].mode.place {
                    Place::Arc(0) => falls[*g][LOWER],
                    Place::Open => falls[*g][UPPER],
                    _ => false,
                }
        };
        let those: Vec<usize> =
            (0..falls.len()).filter(comes).filter(|&g| self.behind(g).is_some()).collect();
        if those.is_empty() || self.rhs.axes.is_some() {
            return Vec::new();
        }
        let (beyond, inertia) = those
            .iter()
            .filter_map(|&g| self.behind(g))
            .fold((0.0, 0.0), |all, one| (all.0 + one[0], all.1 + one[1]));
        let Some(yields) = self.inertia_with_all_but(&those).try_inverse() else { return Vec::new() };
        let more: Vector4<f64> = yields.column(0) * (beyond / (1.0 + yields[(0, 0)] * inertia));
        // Races that are as fast to what steps resolve are left to meet: to rounding either may be behind.
        let resolved = self.settings.tolerance_in::<N_STATE>(&motions[those[0]].mode).absolute[6];
        if self.y[3] + more[1] >= self.y[2] + more[0] - resolved {
            return Vec::new();
        }
        let before_j = self.rhs.energy_j(self.t_s, &self.y);
        self.push(more, &those);
        for &g in &those {
            let at = HEAD + EACH * g;
            self.y[at] = self.groups[g].model.curve.first_contact_rad();
            let outer = Grip::Slip(-1.0);
            self.rhs.motions[g].mode = Mode { place: Place::Carried, inner: Mode::PRESSED, outer };
        }
        self.hold();
        self.appeared_j += self.rhs.energy_j(self.t_s, &self.y) - before_j;
        let (t, y) = (self.t_s, self.y);
        self.rhs.look::<true>(t, &y);
        for &g in &those {
            if self.rhs.rides(g).is_some_and(|ride| ride.off_nm >= 0.0) {
                self.rhs.motions[g].mode.inner = Mode::OFF;
            }
        }
        those
    }

    /// What group `g` has of angular momentum beyond what it would have in the cage, N m s, and its inertia there, kg m^2; `None`: it runs
    /// ahead of the inner race.
    fn behind(&self, g: usize) -> Option<[f64; 2]> {
        let (model, own) = (&self.groups[g].model, state_of(&self.y, g));
        let mode = self.rhs.motions[g].mode;
        let sight = self.rhs.stands(g, mode.place, self.t_s, &self.y, &own);
        let [da, dp, di, _] = self.rhs.goes(g, &mode, &sight, &self.y, &own);
        let orbit = model.orbit_kg_m2(&sight.point);
        let beyond = orbit * (dp - di) + model.inertia_kg_m2 * da;
        (dp <= di).then_some([model.count * beyond, model.count * orbit])
    }
}
