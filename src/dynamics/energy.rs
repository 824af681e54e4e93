//! Where the energy of a run went: works from outside and losses against what is in motion and stored.
//!
//! In the frame that turns with the mean speed. With x' = (alpha', phi', theta_bi', theta_be') the equations of
//! [`Model::forces`] times x' give, the gyroscopic terms cancelling,
//!
//!   d(E_kin + V)/dt = n_s (T_bi v_A - T_be v_B) - C_rl (theta_bi' - theta_be')^2 + n_s Q alpha'
//!                     + C_bi theta_bi' + C_be theta_be' + P_frame
//!
//! V: races' abutment, springs, and the wedge: n_s int U' dalpha at the curve's speed, the centrifugal potential
//! -n_s m_g OC_g^2 Omega^2/2 while open. P_frame: the inertia forces of d Omega/dt, and the centrifugal force as far as it
//! differs from that of the curve's speed. What the balance leaves over is what integration, changes of mode and
//! the projections at them have done wrong.

use super::model::{Grip, Mode, Model, N_STATE, Place};
use super::run::Run;
use crate::numeric::quadrature;
use crate::ode::adaptive::Size;
use crate::ode::step::Dense;
use crate::wedge::WedgePoint;
use nalgebra::Const;

/// Works over a run, J, positive where they bring energy in; friction and damping take it out.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct EnergyBalance {
    /// Friction at A.
    pub friction_inner_j: f64,
    /// Friction at B.
    pub friction_outer_j: f64,
    /// Viscous damping between the races, in the shafts of a drivetrain and by its drags.
    pub race_damping_j: f64,
    /// Hunt-Crossley damping of the contacts, and what sprags of a driven cage gain or lose that it stops, or that leave it.
    pub contact_damping_j: f64,
    /// Torque on the inner race: preload, step, history or flange; that on the drivetrain of its side.
    pub torque_inner_j: f64,
    /// Torque on the outer race: excitation or flange; that on the drivetrain of its side.
    pub torque_outer_j: f64,
    /// Change of the mean speed.
    pub frame_j: f64,
    /// Change of kinetic energy.
    pub kinetic_j: f64,
    /// Change of stored energy: wedge, springs, abutment, shafts.
    pub stored_j: f64,
    /// Energy that went through: the time integral of the sum of the magnitudes of all powers, and what was in motion at
    /// the start.
    pub through_j: f64,
}

impl EnergyBalance {
    /// Works less change of energy, J: 0 but for errors.
    pub fn residual_j(&self) -> f64 {
        self.friction_inner_j
            + self.friction_outer_j
            + self.race_damping_j
            + self.contact_damping_j
            + self.torque_inner_j
            + self.torque_outer_j
            + self.frame_j
            - self.kinetic_j
            - self.stored_j
    }

    /// The residual by the energy that went through; 0 where none did.
    pub fn relative(&self) -> f64 {
        if self.through_j > 0.0 { self.residual_j() / self.through_j } else { 0.0 }
    }
}

const WORKS: usize = 7;
/// Index of the damping of the contacts among them.
const CONTACT: usize = 3;

impl Model {
    /// Powers in the order of the fields of [`EnergyBalance`], W.
    fn powers<const N: usize>(&self, mode: &Mode, t: f64, y: &[f64; N]) -> [f64; WORKS] {
        let p = self.point(mode.place, y[0]);
        let rates = self.rates(mode, &p, y);
        let f = self.forces_at(mode, t, y, &p, &rates);
        let [da, dp, di, de] = rates;
        let n = self.count;
        let (speed, spin) = self.mean_speed(t);
        let in_curve = self.curve.speed_rad_s();
        let open = mode.place == Place::Open;
        let mut acting = self.torques_nm(t);
        let brought = self.flange_torques_nm(t, y, &p, &rates, &f);
        for (race, held) in self.held_rad_s2().iter().enumerate() {
            acting[race] += held.map_or(0.0, |_| brought[race]);
        }
        let [torque_inner, torque_outer] = acting;
        let slips = |grip: Grip| f64::from(u8::from(matches!(grip, Grip::Slip(_))));
        let frame = if open {
            self.mass_kg * p.oc_g * p.oc_g_slope * (speed * speed - in_curve * in_curve)
        } else {
            -(self.static_tangential_n(&p, speed) - p.t_static) * p.oa * (p.rho_i + p.rho_e)
        };
        let orbit = self.orbit_kg_m2(&p);
        let slowed = n * (self.inertia_kg_m2 * da + orbit * dp)
            + self.inner_inertia_kg_m2 * di
            + self.outer_inertia_kg_m2 * de;
        let mut powers = [
            n * f.t_bi * f.v_a * slips(mode.inner),
            -n * f.t_be * f.v_b * slips(mode.outer),
            -self.damping_nm_s_per_rad * (di - de).powi(2),
            n * self.damped(&p, speed, da).1 * da,
            torque_inner * di,
            torque_outer * de,
            n * frame * da - spin * slowed,
        ];
        if N > N_STATE
            && let Some(train) = &self.drive.train
        {
            let [inner, outer, lost, frame] = train.powers_w(t, y, (speed, spin));
            for (i, more) in [(4, inner), (5, outer), (2, lost), (6, frame)] {
                powers[i] += more;
            }
        }
        powers
    }

    /// Energy stored in the contacts of all sprags between two angles, J: n_s int U' dalpha with U' = T OA (rho_i +
    /// rho_e), arc by arc and in pieces, because an edge of the patch may pass a junction on the way; the centrifugal
    /// potential below first contact.
    pub fn wedge_energy_j(&self, from: f64, to: f64) -> f64 {
        const PIECES: u32 = 20;
        let curve = &self.curve;
        let (low, high) = (from.min(to), from.max(to));
        let touch = curve.first_contact_rad();
        let speed = curve.speed_rad_s();
        let mut sum = 0.0;
        if low < touch && speed != 0.0 {
            sum += self.swung_out_j(low, high.min(touch));
        }
        if high > touch {
            let low = low.max(touch);
            for k in curve.place_at(low)..=curve.place_at(high) {
                let begin = if k == 0 { low } else { curve.arc_end_rad(k - 1).max(low) };
                let piece = (curve.arc_end_rad(k).min(high) - begin) / f64::from(PIECES);
                for i in 0..PIECES {
                    let at = begin + piece * f64::from(i);
                    sum += quadrature::integral(at, at + piece, |alpha| {
                        let p = curve.in_arc(k, alpha);
                        p.t_static * p.oa * (p.rho_i + p.rho_e)
                    });
                }
            }
        }
        self.count * sum * (to - from).signum()
    }

    /// Centrifugal potential of all sprags between two angles without contact at A, J.
    pub(super) fn open_energy_j(&self, from: f64, to: f64) -> f64 {
        if self.curve.speed_rad_s() == 0.0 { 0.0 } else { self.count * self.swung_out_j(from, to) }
    }

    /// The same of one sprag.
    fn swung_out_j(&self, from: f64, to: f64) -> f64 {
        let speed = self.curve.speed_rad_s();
        quadrature::integral(from, to, |alpha| {
            let p = self.curve.open(alpha);
            -self.mass_kg * p.oc_g * p.oc_g_slope * speed * speed
        })
    }
}

/// Kinetic energy and that of springs and abutment of a run, J, and alpha.
fn energies<const N: usize>(model: &Model, run: &Run<N>) -> [f64; 3] {
    let y = &run.state;
    let p = model.point(run.mode.place, y[0]);
    let rates = model.rates(&run.mode, &p, y);
    let still = model.energy_without_wedge(&p, &[0.0; 4], y);
    let [moves, twisted] = match &model.drive.train {
        Some(train) if N > N_STATE => train.energies_j(run.t_s, y, model.mean_speed(run.t_s).0),
        _ => [0.0; 2],
    };
    [model.energy_without_wedge(&p, &rates, y) - still + moves, still + twisted, y[0]]
}

/// What a run keeps to close its balance at the end.
#[derive(Debug, Clone, Copy)]
pub(super) struct Audit {
    works: [f64; WORKS],
    through_j: f64,
    /// Kinetic energy, that of springs and abutment (J), and alpha at the start.
    start: [f64; 3],
}

impl Audit {
    /// Works, and what went through, J.
    pub(super) fn sums(&self) -> [f64; WORKS + 1] {
        std::array::from_fn(|i| self.works.get(i).copied().unwrap_or(self.through_j))
    }

    /// `n` times `more`, in that order, is added.
    pub(super) fn add(&mut self, n: f64, more: &[f64]) {
        let sums = self.works.iter_mut().chain([&mut self.through_j]);
        sums.zip(more).for_each(|(sum, more)| *sum += n * more);
    }

    /// Nothing counted yet, where `run` stands.
    pub(super) fn begin<const N: usize>(model: &Model, run: &Run<N>) -> Self {
        let start = energies(model, run);
        Self { works: [0.0; WORKS], through_j: start[0], start }
    }

    /// Count what flanges that move their race bring when the rates jump from one point of the curve to another: kinetic
    /// energy is kept but for that.
    pub(super) fn jump<const N: usize>(
        &mut self,
        model: &Model,
        y: &[f64; N],
        before: (&WedgePoint, &[f64; 4]),
        after: (&WedgePoint, &[f64; 4]),
    ) {
        if let Some(race) = model.held_rad_s2().iter().position(Option::is_some) {
            // Where both are moved it is told of the inner one alone.
            let [before, after] = [before, after].map(|(p, rates)| model.energy_without_wedge(p, rates, y));
            self.works[4 + race] += after - before;
        }
    }

    /// Count what carried sprags gain or lose that leave their cage at `y`, their alpha so far at `from` (rad).
    pub(super) fn set<const N: usize>(&mut self, model: &Model, y: &[f64; N], from: f64) {
        let at = |alpha: f64| {
            let mut y = *y;
            y[0] = alpha;
            model.energy_without_wedge(&model.point(Place::Open, alpha), &[0.0; 4], &y)
        };
        self.works[CONTACT] += at(y[0]) - at(from) + model.wedge_energy_j(from, y[0]);
    }

    /// Count what is lost where a cage takes sprags along, by the rates before and after.
    pub(super) fn taken_along<const N: usize>(
        &mut self,
        model: &Model,
        y: &[f64; N],
        p: &WedgePoint,
        rates: [&[f64; 4]; 2],
    ) {
        let [before, after] = rates.map(|rates| model.energy_without_wedge(p, rates, y));
        self.works[CONTACT] += after - before;
    }

    /// Count the works of an accepted step between `times` (s), by quadrature over its dense output.
    pub(super) fn step<const N: usize>(
        &mut self,
        model: &Model,
        mode: &Mode,
        [from, until]: [f64; 2],
        dense: &Dense<N>,
    ) where
        Const<N>: Size,
    {
        self.through_j += quadrature::integrals(from, until, |t| {
            let powers = model.powers(mode, t, &dense.at(t));
            let all = powers.iter().map(|p| p.abs()).sum::<f64>();
            let [a, b, c, d, e, f, g] = powers;
            [a, b, c, d, e, f, g, all]
        })
        .into_iter()
        .enumerate()
        .fold(0.0, |all, (i, work)| match self.works.get_mut(i) {
            Some(sum) => {
                *sum += work;
                all
            }
            None => work,
        });
    }

    /// The balance at the end of `run`.
    pub(super) fn balance<const N: usize>(&self, model: &Model, run: &Run<N>) -> EnergyBalance {
        let Self { works, through_j, start } = *self;
        let now = energies(model, run);
        let [friction_inner_j, friction_outer_j, race_damping_j, contact_damping_j, inner, outer, frame_j] =
            works;
        EnergyBalance {
            friction_inner_j,
            friction_outer_j,
            race_damping_j,
            contact_damping_j,
            torque_inner_j: inner,
            torque_outer_j: outer,
            frame_j,
            kinetic_j: now[0] - start[0],
            stored_j: now[1] - start[1] + model.wedge_energy_j(start[2], now[2]),
            through_j,
        }
    }
}
