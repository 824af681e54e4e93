//! Accelerations and contact forces in a given mode.

use nalgebra::{Matrix2, Vector2};
use serde::{Deserialize, Serialize};

use super::carried::Carried;
use super::drive::{Drive, Loads};
use crate::clutch::Clutch;
use crate::friction::{FilmFriction, Stribeck};
use crate::wedge::{WedgeCurve, WedgePoint};

/// Length of the state: 4 angles (rad), 4 rates (rad/s), signed slip distances at A and B (m).
pub const N_STATE: usize = 10;
/// Where in it the distances at A and, behind it, at B stand; surfaces that do not touch add to them too.
pub(super) const SLIP: usize = 8;
/// alpha, phi, theta_bi, theta_be, their rates, slip at A, slip at B.
pub type State = [f64; N_STATE];

/// What one contact does.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Grip {
    /// Rolls without slip; the force is a constraint.
    Stick,
    /// Slips; the sign is that of v.
    Slip(f64),
}

/// Where the inner contact is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Place {
    /// No normal force at A.
    Open,
    /// On arc k of the curve.
    Arc(usize),
    /// Pure-rolling run only: below first contact, held by tension.
    Tension,
    /// A driven cage carries the sprag with the inner race; the grip at A says whether B presses on the outer race ([`Mode::PRESSED`])
    /// or is off it ([`Mode::OFF`]).
    Carried,
}

/// Mode of motion: within one, everything is smooth.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Mode {
    /// Where A is.
    pub place: Place,
    /// Grip at A; means nothing while open, and something else while carried ([`Place::Carried`]).
    pub inner: Grip,
    /// Grip at B.
    pub outer: Grip,
}

impl Mode {
    /// Stands for the grip at A of a carried sprag that presses on the outer race.
    pub const PRESSED: Grip = Grip::Stick;
    /// The same of one that is off it.
    pub const OFF: Grip = Grip::Slip(1.0);

    /// Whether a cage carries sprags that are off the outer race.
    pub fn is_off(&self) -> bool {
        self.place == Place::Carried && self.inner == Self::OFF
    }

    /// Whether A and B slip under load, that is in contact.
    pub fn slips_under_load(&self) -> [bool; 2] {
        let touches = self.place != Place::Open && !self.is_off();
        [self.inner, self.outer].map(|grip| touches && matches!(grip, Grip::Slip(_)))
    }
}

/// A clutch under loads, ready to be integrated.
#[derive(Debug, Clone)]
pub struct Model {
    /// Wedge curve at the mean speed.
    pub curve: WedgeCurve,
    /// Friction law.
    pub friction: Stribeck,
    /// What takes its place at A where that slides on a film.
    pub film: Option<FilmFriction>,
    /// Whether B rolls without slip whatever that takes (Vernay's assumption).
    pub outer_holds: bool,
    /// How a driven cage carries the sprags in overrun; `None`: they ride with the outer race.
    pub carried: Option<Carried>,
    /// Loads.
    pub loads: Loads,
    /// What acts over time beside them.
    pub drive: Drive,
    /// alpha_max of the spring, rad.
    pub alpha_max_rad: f64,
    /// Normal force from which on a contact counts as loaded, N; 0: always.
    pub loaded_n: f64,
    /// Wear of sprag and race per load and path, m^2/N (Archard); `None`: not known.
    pub wear_m2_per_n: Option<[f64; 2]>,
    pub(super) count: f64,
    pub(super) mass_kg: f64,
    pub(super) inertia_kg_m2: f64,
    /// Stiffness of the spring of one sprag, N m/rad.
    pub spring_nm_per_rad: f64,
    pub(super) inner_inertia_kg_m2: f64,
    pub(super) outer_inertia_kg_m2: f64,
    pub(super) damping_nm_s_per_rad: f64,
    pub(super) hunt_crossley_s_per_m: f64,
}

/// Forces at one instant, per sprag.
#[derive(Debug, Clone, Copy)]
pub struct Forces {
    /// Accelerations of alpha, phi, theta_bi, theta_be, rad/s^2.
    pub acceleration: [f64; 4],
    /// T_bi, N.
    pub t_bi: f64,
    /// T_be, N.
    pub t_be: f64,
    /// N_bi, N.
    pub n_bi: f64,
    /// N_be from the radial equation, N.
    pub n_be: f64,
    /// v_A, m/s.
    pub v_a: f64,
    /// v_B, m/s.
    pub v_b: f64,
}

/// A sprag between races whose motion is left open: what [`Model::loose`] says.
pub(super) struct Loose {
    /// (alpha'', phi'') without T_bi and T_be, rad/s^2.
    pub(super) free: Vector2<f64>,
    /// What one newton of T_bi on each sprag does to them.
    pub(super) column_i: Vector2<f64>,
    /// The same of T_be.
    pub(super) column_e: Vector2<f64>,
    n_bi: f64,
    v_a: f64,
    v_b: f64,
    /// Whether what follows of the radial equation is known.
    radial: bool,
    sin_bg: f64,
    sin_g: f64,
    cos_g: f64,
    /// What presses the sprag outward without T_bi and T_be, N.
    press: f64,
}

impl Forces {
    /// None at all.
    pub(super) const NONE: Self =
        Self { acceleration: [0.0; 4], t_bi: 0.0, t_be: 0.0, n_bi: 0.0, n_be: 0.0, v_a: 0.0, v_b: 0.0 };
}

impl Loose {
    /// N_be by the radial equation, N; 0 where that is left out.
    #[inline(always)]
    pub(super) fn outer_n(&self, t_bi: f64, t_be: f64) -> f64 {
        if self.radial { (self.press + t_bi * self.sin_bg - t_be * self.sin_g) / self.cos_g } else { 0.0 }
    }

    /// All of it under `t` = (T_bi, T_be) with the races at `races` (rad/s^2).
    #[inline(always)]
    pub(super) fn forces(&self, [t_bi, t_be]: [f64; 2], n_be: f64, races: [f64; 2]) -> Forces {
        let sprag = self.free + self.column_i * t_bi + self.column_e * t_be;
        Forces {
            acceleration: [sprag[0], sprag[1], races[0], races[1]],
            t_bi,
            t_be,
            n_bi: self.n_bi,
            n_be,
            v_a: self.v_a,
            v_b: self.v_b,
        }
    }
}

impl Model {
    /// Put a clutch under loads. `bench_inertia_kg_m2` is added to the inner race.
    pub fn new(
        clutch: &Clutch,
        curve: WedgeCurve,
        loads: Loads,
        alpha_max_rad: f64,
        bench_inertia_kg_m2: f64,
    ) -> Self {
        Self {
            curve,
            friction: Stribeck::of(&clutch.friction),
            film: None,
            outer_holds: clutch.friction.outer_holds,
            carried: None,
            loads,
            drive: Drive::default(),
            alpha_max_rad,
            loaded_n: 0.0,
            wear_m2_per_n: clutch.lubrication.as_ref().map(|l| [l.sprag_wear_m2_per_n, l.race_wear_m2_per_n]),
            count: clutch.sprags.count as f64,
            mass_kg: clutch.sprags.mass_kg,
            inertia_kg_m2: clutch.sprags.inertia_kg_m2,
            spring_nm_per_rad: clutch.spring.stiffness_nm_per_rad,
            inner_inertia_kg_m2: clutch.races.inner_inertia_kg_m2 + bench_inertia_kg_m2,
            outer_inertia_kg_m2: clutch.races.outer_inertia_kg_m2,
            damping_nm_s_per_rad: clutch.races.viscous_damping_nm_s_per_rad,
            hunt_crossley_s_per_m: clutch.hunt_crossley_s_per_m,
        }
    }

    /// The same for `count` of its sprags alone, on their own curve and with their own friction.
    pub fn of_sprags(&self, count: usize, curve: WedgeCurve, friction: Stribeck) -> Self {
        Self { curve, friction, count: count as f64, ..self.clone() }
    }

    /// The same with springs `factor` times as stiff, turned to the same alpha_max: each moment times that.
    pub fn with_spring(self, factor: f64) -> Self {
        Self { spring_nm_per_rad: factor * self.spring_nm_per_rad, ..self }
    }

    /// Geometry and normal force at `alpha` with the functions of `place`.
    #[inline(always)]
    pub fn point(&self, place: Place, alpha: f64) -> WedgePoint {
        match place {
            Place::Arc(k) => self.curve.in_arc(k, alpha),
            Place::Open | Place::Carried => self.curve.open(alpha),
            Place::Tension => self.curve.mirrored(alpha),
        }
    }

    /// Rates with the rolling constraints of `mode` put in exactly: (alpha', phi', theta_bi', theta_be').
    /// The light sprag follows the heavy races: both stick, alpha' = (theta_be' - theta_bi')/(rho_i + rho_e),
    /// phi' = theta_bi' + rho_i alpha'; one sticks, phi' follows that race. A cage that carries the sprags: alpha' = 0, phi' = theta_bi'.
    #[inline]
    pub fn rates<const N: usize>(&self, mode: &Mode, p: &WedgePoint, y: &[f64; N]) -> [f64; 4] {
        let [mut da, mut dp, di, de] = [y[4], y[5], y[6], y[7]];
        if mode.place == Place::Carried {
            return [0.0, di, di, de];
        }
        let inner_sticks = mode.inner == Grip::Stick && mode.place != Place::Open;
        match (inner_sticks, mode.outer == Grip::Stick) {
            (true, true) => {
                da = (de - di) / (p.rho_i + p.rho_e);
                dp = di + p.rho_i * da;
            }
            (true, false) => dp = di + p.rho_i * da,
            (false, true) => dp = de - p.rho_e * da,
            (false, false) => {}
        }
        [da, dp, di, de]
    }

    /// Slip velocities (v_A, v_B), m/s.
    #[inline]
    pub fn slip_velocities(&self, p: &WedgePoint, rates: &[f64; 4]) -> (f64, f64) {
        use crate::kinematics::{slip_velocity_inner, slip_velocity_outer};
        (
            slip_velocity_inner(p.oa, p.rho_i, rates[0], rates[1], rates[2]),
            slip_velocity_outer(p.ob, p.rho_e, rates[0], rates[1], rates[3]),
        )
    }

    /// mu at A, sliding at `speed_m_s` >= 0 under `n_bi`, N.
    #[inline(always)]
    fn sliding_inner(&self, speed_m_s: f64, n_bi: f64) -> f64 {
        match &self.film {
            None => self.friction.coefficient(speed_m_s),
            Some(film) => film.coefficient(speed_m_s, n_bi),
        }
    }

    /// Inverse of the sprags' 2x2 mass matrix in (alpha, phi), 1/(kg m^2):
    /// n_s [[I_g, I_g], [I_g, I_g + m_g OC_g^2]].
    #[inline]
    fn sprag_inverse(&self, oc_g: f64) -> Matrix2<f64> {
        let orbit = self.mass_kg * oc_g * oc_g;
        let i = self.inertia_kg_m2;
        Matrix2::new((i + orbit) / (i * orbit), -1.0 / orbit, -1.0 / orbit, 1.0 / orbit) / self.count
    }

    /// I_g + m_g OC_g^2 of one sprag, kg m^2.
    #[inline(always)]
    pub(super) fn orbit_kg_m2(&self, p: &WedgePoint) -> f64 {
        self.inertia_kg_m2 + self.mass_kg * p.oc_g * p.oc_g
    }

    /// Mean speed Omega at `t`, rad/s, and its rate, rad/s^2.
    #[inline]
    pub fn mean_speed(&self, t: f64) -> (f64, f64) {
        self.drive.speed_rad_s.as_ref().map_or((self.curve.speed_rad_s(), 0.0), |c| c.at(t))
    }

    /// T_bi that static equilibrium demands at mean speed `speed`, N: that of the curve, its centrifugal force
    /// exchanged for the present one, T_bi = [N_bi OB sin beta - F_c OB sin gamma]/(OB cos beta - OA).
    #[inline]
    pub(super) fn static_tangential_n(&self, p: &WedgePoint, speed: f64) -> f64 {
        let in_curve = self.curve.speed_rad_s();
        if speed == in_curve {
            return p.t_static;
        }
        let more = self.mass_kg * p.oc_g * (speed * speed - in_curve * in_curve);
        p.t_static - more * p.ob * p.gamma.sin() / (p.ob * (p.beta_gamma - p.gamma).cos() - p.oa)
    }

    /// Accelerations and forces at time `t` (s) in `mode`.
    ///
    /// Eq. (13), Eq. (15), in the energy-consistent form: OC_g' times the radial equation is added to the
    /// moment about G and moments are taken about O, so that friction enters with b_i*, b_e* and the normal
    /// forces only through U' = C_Omega (rho_i + rho_e)/n_s:
    ///
    ///   I_g(alpha''+phi'') = b_i* T_bi + b_e* T_be + K_r(alpha_max - alpha) - U' + m_g OC_g OC_g'(phi'^2 - Omega^2)
    ///   I_g(alpha''+phi'') + m_g OC_g^2 phi'' + 2 m_g OC_g OC_g' alpha' phi' = T_be OB - T_bi OA
    ///   I_bi theta_bi'' = n_s T_bi OA - C_rl(theta_bi' - theta_be') + C_bi
    ///   I_be theta_be'' = -n_s T_be OB - C_rl(theta_be' - theta_bi') + C_be - k_ab theta_be
    ///
    /// The printed (13) counts the spring as a couple without reaction, has no Coriolis term and "mg OC_g" for
    /// m_g OC_g phi''; the printed (15) has no abutment. N_be closes radially:
    /// N_be cos gamma = N_bi cos(beta+gamma) + T_bi sin(beta+gamma) - T_be sin gamma + m_g OC_g phi'^2.
    ///
    /// Where the mean speed is a course in time, angles are measured from its integral, each inertia is slowed by
    /// its own d Omega/dt, and U' holds the centrifugal force of the momentary speed; the growth of the race stays
    /// that of the curve's speed.
    ///
    /// A race that its flange moves at a given acceleration has that in place of (15): no force of a contact changes it.
    /// The rows of the constraints stay independent, by alpha and phi alone.
    #[doc(alias = "Eq. (13)")]
    #[doc(alias = "Eq. (15)")]
    pub fn forces<const N: usize>(&self, mode: &Mode, t: f64, y: &[f64; N]) -> Forces {
        let p = self.point(mode.place, y[0]);
        let rates = self.rates(mode, &p, y);
        self.forces_at(mode, t, y, &p, &rates)
    }

    pub(super) fn forces_at<const N: usize>(
        &self,
        mode: &Mode,
        t: f64,
        y: &[f64; N],
        p: &WedgePoint,
        rates: &[f64; 4],
    ) -> Forces {
        self.forces_with::<true, N>(mode, t, y, p, rates)
    }

    /// The same; without `RADIAL` the radial equation is left out where B holds, which does not need it, and N_be is 0.
    #[inline(always)]
    pub(super) fn forces_with<const RADIAL: bool, const N: usize>(
        &self,
        mode: &Mode,
        t: f64,
        y: &[f64; N],
        p: &WedgePoint,
        rates: &[f64; 4],
    ) -> Forces {
        let n = self.count;
        let [f_i, f_e] = self.race_loads_nm(t, y, rates);
        if mode.place == Place::Carried {
            return self.carried_forces(mode, t, p, rates, [f_i, f_e]);
        }
        let loose = self.loose::<RADIAL, N>(mode, t, y, p, rates);
        let (mut free_i, mut free_e) = (f_i / self.inner_inertia_kg_m2, f_e / self.outer_inertia_kg_m2);
        let mut race_i = n * p.oa / self.inner_inertia_kg_m2;
        let mut race_e = -n * p.ob / self.outer_inertia_kg_m2;
        let [held_i, held_e] = self.held_rad_s2();
        if let Some(given) = held_i {
            (free_i, race_i) = (given, 0.0);
        }
        if let Some(given) = held_e {
            (free_e, race_e) = (given, 0.0);
        }
        let (a, b) = self.grips(mode, p, rates, &loose, [free_i, free_e], [race_i, race_e]);
        let determinant = a[(0, 0)] * a[(1, 1)] - a[(0, 1)] * a[(1, 0)];
        let mut t_bi = (b[0] * a[(1, 1)] - b[1] * a[(0, 1)]) / determinant;
        let mut t_be = (a[(0, 0)] * b[1] - a[(1, 0)] * b[0]) / determinant;
        let mut n_be = loose.outer_n(t_bi, t_be);
        if n_be < 0.0 && mode.outer != Grip::Stick {
            // B has let go: no force there.
            n_be = 0.0;
            t_be = 0.0;
            if mode.inner == Grip::Stick && mode.place != Place::Open {
                t_bi = b[0] / a[(0, 0)];
            }
        }
        loose.forces([t_bi, t_be], n_be, [free_i + race_i * t_bi, free_e + race_e * t_be])
    }

    /// What acts on inner and outer race beside the sprags, N m.
    #[inline(always)]
    pub(super) fn race_loads_nm<const N: usize>(&self, t: f64, y: &[f64; N], rates: &[f64; 4]) -> [f64; 2] {
        let [_, _, di, de] = *rates;
        let spin = self.mean_speed(t).1;
        let drag = self.damping_nm_s_per_rad * (di - de);
        let [torque_i, torque_e] = self.torques_on_nm(t, y);
        [
            torque_i - drag - self.inner_inertia_kg_m2 * spin,
            torque_e + drag - self.loads.abutment_nm_per_rad * y[3] - self.outer_inertia_kg_m2 * spin,
        ]
    }

    /// One sprag of the `count` by itself: what it does without T_bi and T_be, and what these do to it.
    #[inline(always)]
    pub(super) fn loose<const RADIAL: bool, const N: usize>(
        &self,
        mode: &Mode,
        t: f64,
        y: &[f64; N],
        p: &WedgePoint,
        rates: &[f64; 4],
    ) -> Loose {
        let [da, dp, _, _] = *rates;
        let n = self.count;
        let (speed, spin) = self.mean_speed(t);
        let phi_rate = speed + dp;
        let open = mode.place == Place::Open;
        let (v_a, v_b) = self.slip_velocities(p, rates);
        // What acts without T_bi, T_be.
        let wedge = self.static_tangential_n(p, speed) * p.oa * (p.rho_i + p.rho_e);
        let swing = self.mass_kg * p.oc_g * p.oc_g_slope;
        let centrifugal = if open { phi_rate * phi_rate } else { phi_rate * phi_rate - speed * speed };
        let (n_bi, damping) = self.damped(p, speed, da);
        let mut f_alpha = n
            * (damping + self.spring_nm_per_rad * (self.alpha_max_rad - y[0])
                - if open { p.t_static * p.oa * (p.rho_i + p.rho_e) } else { wedge }
                + swing * centrifugal
                - self.inertia_kg_m2 * spin);
        if let Some(film) = &self.film {
            // The film's pressure acts ahead of A: N_bi x_p (1 + rho_i), by virtual work.
            f_alpha += n * n_bi * film.ahead_m(v_a.max(0.0), n_bi) * (1.0 + p.rho_i);
        }
        let orbit = self.orbit_kg_m2(p);
        let f_phi = -n * (2.0 * swing * da * phi_rate + orbit * spin);
        let inverse = self.sprag_inverse(p.oc_g);
        let radial = RADIAL || mode.outer != Grip::Stick;
        let of = |angle: f64| if radial { angle.sin_cos() } else { (0.0, 1.0) };
        let ((sin_bg, cos_bg), (sin_g, cos_g)) = (of(p.beta_gamma), of(p.gamma));
        Loose {
            free: inverse * Vector2::new(f_alpha, f_phi),
            column_i: inverse * Vector2::new(n * p.rho_i * p.oa, -n * p.oa),
            column_e: inverse * Vector2::new(n * p.rho_e * p.ob, n * p.ob),
            n_bi,
            v_a,
            v_b,
            radial,
            sin_bg,
            sin_g,
            cos_g,
            press: n_bi * cos_bg + self.mass_kg * p.oc_g * phi_rate * phi_rate,
        }
    }

    /// `of` where phi' counts `along` times in the slip rates of A and B, so that the forces turn the sprag by as much.
    pub(super) fn turned_along(&self, of: Loose, p: &WedgePoint, along: [f64; 2]) -> Loose {
        let (inverse, n) = (self.sprag_inverse(p.oc_g), self.count);
        Loose {
            column_i: inverse * Vector2::new(n * p.rho_i * p.oa, -n * p.oa * along[0]),
            column_e: inverse * Vector2::new(n * p.rho_e * p.ob, n * p.ob * along[1]),
            ..of
        }
    }

    /// A x = b for x = (T_bi, T_be): rolling where a contact holds, friction where it slips. The races go at `free` (rad/s^2)
    /// without x, and at `race` more for a newton of T_bi (T_be) on each sprag.
    #[inline(always)]
    pub(super) fn grips(
        &self,
        mode: &Mode,
        p: &WedgePoint,
        rates: &[f64; 4],
        of: &Loose,
        [free_i, free_e]: [f64; 2],
        [race_i, race_e]: [f64; 2],
    ) -> (Matrix2<f64>, Vector2<f64>) {
        let da = rates[0];
        let open = mode.place == Place::Open;
        // Rows of the constraints: theta_bi'' - phi'' + rho_i alpha'' + rho_i' alpha'^2 = 0 at A,
        // theta_be'' - phi'' - rho_e alpha'' - rho_e' alpha'^2 = 0 at B.
        let row_i = |v: &Vector2<f64>, race: f64| race - v[1] + p.rho_i * v[0];
        let row_e = |v: &Vector2<f64>, race: f64| race - v[1] - p.rho_e * v[0];
        let (mut a, mut b) = (Matrix2::zeros(), Vector2::zeros());
        if mode.inner == Grip::Stick && !open {
            a[(0, 0)] = row_i(&of.column_i, race_i);
            a[(0, 1)] = row_i(&of.column_e, 0.0);
            b[0] = -(row_i(&of.free, free_i) + p.rho_i_slope * da * da);
        } else {
            a[(0, 0)] = 1.0;
            b[0] = match mode.inner {
                Grip::Slip(s) if !open => -s * self.sliding_inner((s * of.v_a).max(0.0), of.n_bi) * of.n_bi,
                _ => 0.0,
            };
        }
        match mode.outer {
            Grip::Stick => {
                a[(1, 0)] = row_e(&of.column_i, 0.0);
                a[(1, 1)] = row_e(&of.column_e, race_e);
                b[1] = -(row_e(&of.free, free_e) - p.rho_e_slope * da * da);
            }
            Grip::Slip(s) => {
                // T_be = s mu N_be and the radial equation together.
                let mu = s * self.friction.coefficient((s * of.v_b).max(0.0));
                let share = mu / (of.cos_g + mu * of.sin_g);
                a[(1, 0)] = -share * of.sin_bg;
                a[(1, 1)] = 1.0;
                b[1] = share * of.press;
            }
        }
        (a, b)
    }

    /// Normal force at A with Hunt and Crossley's damping (N), and the generalized force of the damping of both
    /// contacts on alpha (N m per sprag).
    ///
    /// N(1 + c delta') at each contact, never below 0, delta' the rate of approach: delta_i' = -OC_i' alpha' and
    /// delta_e' = OC_e' alpha' by the motion of a rigid sprag whose centroid moves by OC_g' (slopes by alpha):
    ///
    ///   OC_i' = OC_g' cos(beta+gamma) - OC_g sin(beta+gamma)      OC_e' = OC_g' cos gamma - OC_g sin gamma
    ///
    /// Normal forces act through O, so they do work on alpha alone: Q = -c alpha' (N_bi delta_i'^2 + N_be delta_e'^2),
    /// slopes by alpha, which takes power at every alpha'. N_be here is that of static equilibrium at N_bi.
    #[inline]
    pub(super) fn damped(&self, p: &WedgePoint, speed: f64, alpha_rate: f64) -> (f64, f64) {
        let c = self.hunt_crossley_s_per_m;
        if c == 0.0 || p.n_bi <= 0.0 {
            return (p.n_bi, 0.0);
        }
        let (sin_bg, cos_bg) = p.beta_gamma.sin_cos();
        let (sin_g, cos_g) = p.gamma.sin_cos();
        let slope_i = p.oc_g * sin_bg - p.oc_g_slope * cos_bg;
        let slope_e = p.oc_g_slope * cos_g - p.oc_g * sin_g;
        let t = self.static_tangential_n(p, speed);
        let n_be =
            (p.n_bi * cos_bg + t * (sin_bg - p.oa / p.ob * sin_g) + self.mass_kg * p.oc_g * speed * speed)
                / cos_g;
        let more_i = (c * slope_i * alpha_rate).max(-1.0) * p.n_bi;
        let more_e = (c * slope_e * alpha_rate).max(-1.0) * n_be.max(0.0);
        (p.n_bi + more_i, -(more_i * slope_i + more_e * slope_e))
    }

    /// Right-hand side of the first-order system; `None` where it is not finite.
    #[inline(always)]
    pub fn slope<const N: usize>(&self, mode: &Mode, t: f64, y: &[f64; N]) -> Option<[f64; N]> {
        let p = self.point(mode.place, y[0]);
        let rates = self.rates(mode, &p, y);
        let f = self.forces_with::<false, N>(mode, t, y, &p, &rates);
        self.slope_of(mode, t, y, &rates, &f)
    }

    /// The right-hand side where rates and forces are known.
    #[inline(always)]
    pub(super) fn slope_of<const N: usize>(
        &self,
        mode: &Mode,
        t: f64,
        y: &[f64; N],
        rates: &[f64; 4],
        f: &Forces,
    ) -> Option<[f64; N]> {
        let slips_a = matches!(mode.inner, Grip::Slip(_)) && mode.place != Place::Open;
        let slips_b = matches!(mode.outer, Grip::Slip(_));
        let a = f.acceleration;
        let of_clutch = [
            rates[0],
            rates[1],
            rates[2],
            rates[3],
            a[0],
            a[1],
            a[2],
            a[3],
            if slips_a { f.v_a } else { 0.0 },
            if slips_b { f.v_b } else { 0.0 },
        ];
        let mut out = [0.0; N];
        out[..N_STATE].copy_from_slice(&of_clutch);
        if N > N_STATE
            && let Some(train) = &self.drive.train
        {
            train.slope(t, y, self.mean_speed(t), [a[2], a[3]], &mut out);
        }
        // NaN where one is not finite.
        let finite = out.iter().map(|v| 0.0 * v).sum::<f64>() == 0.0;
        finite.then_some(out)
    }

    /// What the springs of all sprags press with at most, N m.
    pub fn spring_most_nm(&self) -> f64 {
        self.count * self.spring_nm_per_rad * self.alpha_max_rad.abs()
    }

    /// Kinetic and stored energy apart from the wedge (J): races, sprags, spring, abutment.
    pub fn energy_without_wedge<const N: usize>(
        &self,
        p: &WedgePoint,
        rates: &[f64; 4],
        y: &[f64; N],
    ) -> f64 {
        let [da, dp, di, de] = *rates;
        let sprag = 0.5 * self.inertia_kg_m2 * (da + dp).powi(2) + 0.5 * self.mass_kg * (p.oc_g * dp).powi(2);
        let spring = 0.5 * self.spring_nm_per_rad * (self.alpha_max_rad - y[0]).powi(2);
        self.count * (sprag + spring)
            + 0.5 * self.inner_inertia_kg_m2 * di * di
            + 0.5 * self.outer_inertia_kg_m2 * de * de
            + 0.5 * self.loads.abutment_nm_per_rad * y[3] * y[3]
    }
}
