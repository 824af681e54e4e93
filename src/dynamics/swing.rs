//! Whether a steady overrun stays: growth and frequency of the sprag's swing about it.

use nalgebra::{DMatrix, Matrix2};

use super::drive::{Drive, FlangeDrive, Loads};
use super::model::{Grip, Mode, Model, N_STATE, Place};
use super::start::Overrun;
use crate::clutch::Clutch;
use crate::friction::FilmFriction;
use crate::numeric::eigen::eigenvalues;
use crate::numeric::root;
use crate::wedge::{WedgeCurve, WedgePoint};

/// A small swing of the sprag about steady overrun, alpha - alpha_0 ~ exp(growth t) cos(2 pi frequency t).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Swing {
    /// Growth rate, 1/s; negative: the swing dies away, 0: it stays, or what it does is less than differences can tell.
    pub growth_rate_per_s: f64,
    /// Frequency, Hz; 0: it creeps and does not swing.
    pub frequency_hz: f64,
    /// N_bi of the equilibrium of the equations of motion, N, about which the sprag swings. Some 0.2 % less than that of
    /// [`Overrun`]: see [`swing()`].
    pub normal_inner_n: f64,
}

/// Growth within that part of the circular frequency is none: what the differences below cannot tell from 0 (a choice).
const RESOLVED: f64 = 1e-7;

impl Swing {
    /// Of the eigenvalue with the largest real part; a growth that is not resolved is none.
    pub(super) fn of(growth_rate_per_s: f64, rad_s: f64, normal_inner_n: f64) -> Self {
        let resolved = growth_rate_per_s.abs() > RESOLVED * rad_s;
        Self {
            growth_rate_per_s: if resolved { growth_rate_per_s } else { 0.0 },
            frequency_hz: rad_s / std::f64::consts::TAU,
            normal_inner_n,
        }
    }

    /// Whether the sprags leave the equilibrium by themselves.
    pub fn grows(&self) -> bool {
        self.growth_rate_per_s > 0.0
    }
}

/// How far beside the equilibrium accelerations are taken, as a part of what they change over: a choice between
/// rounding, which falls with it, and the second order of the difference.
const BESIDE: f64 = 1e-4;

/// The swing about the steady overrun `steady` ([`super::overrun()`] of the same arguments), A sliding at `overrun_rad_s`;
/// `None` where A is open or does not slide, and where the equations of motion open it.
///
/// Both races keep their speeds: they are far heavier than a sprag, and what drives them is not asked. B sticks, so
/// phi' = theta_be' - rho_e alpha' and one sprag has one freedom, alpha'' = f(alpha, alpha'), the right-hand side of the
/// dynamics ([`Model::forces`]). About its equilibrium f = 0
///
///   d/dt (alpha, alpha') = [[0, 1], [df/dalpha, df/dalpha']] (alpha, alpha'),
///
/// whose eigenvalues are growth +- i 2 pi frequency, by central differences of f. With the inertia I = I_g (1 - rho_e)^2 +
/// m_g OC_g^2 rho_e^2 and v_A = OA(Omega_o + (rho_i + rho_e) alpha')
///
///   df/dalpha' = -[dmu/dv N_bi (OA (rho_i + rho_e))^2 + damping of the contacts]/I:
///
/// friction that falls with speed feeds the swing, friction that rises and damped contacts take from it.
///
/// The equilibrium of [`super::overrun()`] is another by a little. There moments about G hold with the N_be of the radial
/// equation. The dynamics put U'(alpha) in the place of N_bi delta_i' + N_be delta_e', without which stick would not keep its
/// energy, and in U' stands the N_be of a static load at that alpha. What is left over at the equilibrium of the statics is
///
///   I alpha'' = (N_be - N_be,static) delta_e',   delta_e' = OC_g' cos gamma - OC_g sin gamma:
///
/// friction turned round (-mu N_bi for tan omega N_bi) presses B a little less.
pub fn swing(
    clutch: &Clutch,
    curve: &WedgeCurve,
    alpha_max_rad: f64,
    steady: &Overrun,
    overrun_rad_s: f64,
) -> Option<Swing> {
    swing_with_friction(clutch, curve, alpha_max_rad, steady, overrun_rad_s, None)
}

/// The same with the friction of `film` at A, which follows load and speed at once, and nothing else of it.
pub fn swing_with_friction(
    clutch: &Clutch,
    curve: &WedgeCurve,
    alpha_max_rad: f64,
    steady: &Overrun,
    overrun_rad_s: f64,
    film: Option<&FilmFriction>,
) -> Option<Swing> {
    Some(Beside::of(clutch, curve, alpha_max_rad, steady, overrun_rad_s, film)?.swing())
}

/// The same with A on `film`; without one as [`swing()`]. `None` too where the eigenvalues are not found.
///
/// The film is a spring and a damper in line with the bodies. With its change of thickness delta, A's bodies feel
/// alpha + delta/X', X' = tan omega OA (rho_i + rho_e) being what a turn presses the wedge together by, so that
///
///   d/dt (alpha, alpha', delta) = (alpha', f_alpha (alpha + delta/X') + f_alpha' alpha',
///                                 -[N' (alpha + delta/X') + k (delta - h_v OA (rho_i + rho_e) alpha')]/c)
///
/// about the equilibrium, with N' = dN_bi/dalpha, the film's k = -dN/dh, h_v = dh/dv and squeeze damping c
/// ([`FilmFriction::compliance`]). In f friction follows load and speed at once.
pub fn swing_on_film(
    clutch: &Clutch,
    curve: &WedgeCurve,
    alpha_max_rad: f64,
    steady: &Overrun,
    overrun_rad_s: f64,
    film: Option<&FilmFriction>,
) -> Option<Swing> {
    let beside = Beside::of(clutch, curve, alpha_max_rad, steady, overrun_rad_s, film)?;
    let Some(film) = film else { return Some(beside.swing()) };
    let p = &beside.point;
    let turn = p.oa * (p.rho_i + p.rho_e);
    let pressed = curve.touch().t_ratio * turn;
    let normal = |x: f64| curve.in_arc(0, curve.first_contact_rad() + x).n_bi;
    let x = beside.pressed_in_rad;
    let by_turn = (normal(x * (1.0 + BESIDE)) - normal(x * (1.0 - BESIDE))) / (2.0 * BESIDE * x);
    let [stiffness, by_speed, squeeze] = film.compliance(overrun_rad_s * p.oa, p.n_bi);
    // The third unknown is delta/X', rad.
    let rate = [-by_turn, stiffness * by_speed * turn, -by_turn - stiffness * pressed]
        .map(|of| of / (squeeze * pressed));
    let matrix = [[0.0, 1.0, 0.0], [beside.by_alpha, beside.by_rate, beside.by_alpha], rate];
    let eigenvalues = eigenvalues(DMatrix::from_row_slice(3, 3, matrix.as_flattened()))?;
    let growth = eigenvalues.iter().map(|l| l.re).fold(f64::NEG_INFINITY, f64::max);
    Some(Swing::of(growth, eigenvalues.iter().map(|l| l.im).fold(0.0, f64::max), p.n_bi))
}

/// The equilibrium of the equations of motion and how they change beside it.
struct Beside {
    /// alpha beyond first contact, rad.
    pressed_in_rad: f64,
    point: WedgePoint,
    by_alpha: f64,
    by_rate: f64,
}

impl Beside {
    fn of(
        clutch: &Clutch,
        curve: &WedgeCurve,
        alpha_max_rad: f64,
        steady: &Overrun,
        overrun_rad_s: f64,
        film: Option<&FilmFriction>,
    ) -> Option<Self> {
        if steady.normal_inner_n <= 0.0 || overrun_rad_s <= 0.0 {
            return None;
        }
        let still = Loads { inner_nm: 0.0, amplitude_nm: 0.0, omega_rad_s: 0.0, abutment_nm_per_rad: 0.0 };
        // Flanges keep the speeds of both races.
        let held = Model {
            film: film.copied(),
            drive: Drive { flanges: Some([FlangeDrive::Acceleration(0.0); 2]), ..Drive::default() },
            ..Model::new(clutch, curve.clone(), still, alpha_max_rad, 0.0)
        };
        let mode = Mode { place: Place::Arc(0), inner: Grip::Slip(1.0), outer: Grip::Stick };
        let f = |alpha: f64, alpha_rate: f64| {
            let mut y = [0.0; N_STATE];
            (y[0], y[4], y[6]) = (alpha, alpha_rate, overrun_rad_s);
            held.forces(&mode, 0.0, &y).acceleration[0]
        };
        // From first contact on: alpha'' falls with alpha, and the equilibrium of the statics is near.
        let touch = curve.first_contact_rad();
        let near = steady.alpha_rad - touch;
        let at = |x: f64| f(touch + x, 0.0);
        let low = (0..60).map(|i| near * 0.5_f64.powi(i)).find(|&x| at(x) >= 0.0)?;
        let high = (0..60).map(|i| near * 2.0_f64.powi(i)).find(|&x| at(x) <= 0.0)?;
        let x =
            if low == high { low } else { root::bracketed(low, high, at(low), at(high), 1e-15 * high, at)? };
        let by_alpha = (at(x * (1.0 + BESIDE)) - at(x * (1.0 - BESIDE))) / (2.0 * BESIDE * x);
        let p = curve.in_arc(0, touch + x);
        // alpha' changes friction over the sliding speed, or over 1/gamma_b where that is less.
        let least = overrun_rad_s.min(1.0 / (held.friction.decay_s_per_m * p.oa));
        let beside = BESIDE * least / (p.rho_i + p.rho_e);
        let by_rate = (f(touch + x, beside) - f(touch + x, -beside)) / (2.0 * beside);
        Some(Self { pressed_in_rad: x, point: p, by_alpha, by_rate })
    }

    fn swing(&self) -> Swing {
        let eigenvalues = Matrix2::new(0.0, 1.0, self.by_alpha, self.by_rate).complex_eigenvalues();
        let growth = eigenvalues.iter().map(|l| l.re).fold(f64::NEG_INFINITY, f64::max);
        Swing::of(growth, eigenvalues[0].im.abs(), self.point.n_bi)
    }
}
