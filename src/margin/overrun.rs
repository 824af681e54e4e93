//! Overrun: how hard the sprags rub, what they drag, and at which speed they lift off.
//!
//! The sprags ride with the outer race, so their speed is that of the outer race: where the inner race alone runs they
//! are at rest and nothing but sliding friction changes with the speed; where the outer race runs, the centrifugal
//! force acts at G. It presses the sprags in where G lies behind C_e (gamma > 0, an engaging design) and lifts them off
//! the inner race where G lies ahead (gamma < 0, a disengaging one).

use super::load::LoadState;
use crate::design::Design;
use crate::dynamics::{Overrun, Swing};
use crate::follow::Follow;
use crate::kinematics::levers;
use crate::numeric::root;
use crate::scenario::{Lubricated, sliding};
use crate::wedge::{FIRST_CONTACT_N, NoCurve, WedgeCurve};

/// One steady overrun.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OverrunPoint {
    /// Speed at which the inner contact slides: that of the race that runs, the other one at rest, rad/s, not negative.
    pub speed_rad_s: f64,
    /// Friction coefficient of the sliding inner contact at that speed, pure number.
    pub friction: f64,
    /// Equilibrium of one sprag, and the drag torque of all.
    pub state: Overrun,
    /// Contact A on its film, and its heat; `None` without `[lubrication]` and where A is open.
    pub lubricated: Option<Lubricated>,
    /// The small swing about that equilibrium, races at constant speeds; `None` where A is open or nothing slides.
    pub swing: Option<Swing>,
    /// The same with the film's friction alone, without its squeeze; `None` without a film.
    pub swing_by_friction: Option<Swing>,
    /// Growth of the outer track, (7), m.
    pub growth_m: f64,
    /// Hoop stress at the bore of the outer race by rotation alone, Pa, tension positive.
    pub rotation_hoop_pa: f64,
}

/// Overrun of both kinds against speed.
#[derive(Debug, Clone, PartialEq)]
pub struct OverrunCurve {
    /// The outer race runs, the inner one stands; speeds rise from 0.
    pub outer_race: Vec<OverrunPoint>,
    /// The inner race runs, the outer one and the sprags stand.
    pub inner_race: Vec<OverrunPoint>,
    /// gamma at first contact at rest, rad: positive engages at speed, negative disengages.
    pub gamma_rad: f64,
}

/// Speeds of a curve.
const SPEEDS: usize = 25;

/// Steady overrun from rest to `up_to_rad_s`; where `follow` is stopped, as far as it has come.
///
/// # Errors
/// [`NoCurve`] where the curve at rest cannot be built; a speed at which there is no first contact ends the curve.
pub fn overrun_curve(
    design: &Design,
    state: &LoadState,
    up_to_rad_s: f64,
    follow: &Follow,
) -> Result<OverrunCurve, NoCurve> {
    // The first arc is all that overrun feels.
    let build = |speed: f64| WedgeCurve::build_reaching(&design.clutch, &state.profile, speed, Some(0.0));
    let point = |curve: &WedgeCurve, speed: f64| point(design, state, curve, speed);
    let rest = build(0.0)?;
    let speeds = (0..SPEEDS).map(|i| up_to_rad_s * i as f64 / (SPEEDS - 1) as f64);
    let speeds = speeds.take_while(|_| !follow.stopped());
    let inner_race = speeds.clone().map(|speed| point(&rest, speed)).collect();
    let outer_race = speeds.map_while(|speed| build(speed).ok().map(|curve| point(&curve, speed))).collect();
    Ok(OverrunCurve { outer_race, inner_race, gamma_rad: state.curve.statics().gamma0_rad() })
}

/// The steady overrun in which the outer race runs at `outer_rad_s` and the inner one slides past it at `sliding_rad_s`.
///
/// # Errors
/// [`NoCurve`] where there is no first contact at that speed.
pub fn overrun_at(
    design: &Design,
    state: &LoadState,
    outer_rad_s: f64,
    sliding_rad_s: f64,
) -> Result<OverrunPoint, NoCurve> {
    let curve = WedgeCurve::build_reaching(&design.clutch, &state.profile, outer_rad_s, Some(0.0))?;
    Ok(point(design, state, &curve, sliding_rad_s))
}

/// The sprags at the speed of `curve`, sliding at `speed_rad_s`.
fn point(design: &Design, state: &LoadState, curve: &WedgeCurve, speed_rad_s: f64) -> OverrunPoint {
    let clutch = &design.clutch;
    let ring = &state.curve.statics().elastic.outer_race;
    let found = sliding(clutch, curve, state.alpha_max_rad, speed_rad_s);
    OverrunPoint {
        speed_rad_s,
        friction: found.friction,
        state: found.state,
        lubricated: found.lubricated,
        swing_by_friction: found
            .lubricated
            .and_then(|l| l.swing_by_friction(&found.state, clutch, curve, state.alpha_max_rad, speed_rad_s)),
        swing: found.swing(clutch, curve, state.alpha_max_rad, speed_rad_s),
        growth_m: ring.centrifugal_bore_growth_m(curve.speed_rad_s()),
        rotation_hoop_pa: ring.rotating_bore_hoop_pa(curve.speed_rad_s()),
    }
}

/// (opening moment of the centrifugal force, closing moment of the spring) on one sprag about G at first contact
/// at overrun speed `speed_rad_s`, N m. Contact is kept while the first is smaller. Zero load at A, and with it no
/// friction there (|T_bi| <= mu N_bi) nor at B (T_be OB = T_bi OA): h_e N_be = h_e m_g OC_g Omega^2/cos gamma, which closes
/// for gamma > 0 and opens for gamma < 0. The closure's own N_be is not that: it holds the sprag without a spring, by the
/// T_bi at N_bi = 0 that this takes (its `t_offset_n`), which a contact without load does not have.
pub(super) fn overrun_moments(design: &Design, state: &LoadState, speed_rad_s: f64) -> (f64, f64) {
    let spring = design.clutch.spring.stiffness_nm_per_rad;
    // First contact at speed: only the touch of the curve is needed, a closure at N -> 0.
    let statics = state.curve.statics();
    match statics.closure(0, FIRST_CONTACT_N, speed_rad_s, 0.0) {
        Ok(c) => {
            let l = levers(c.lengths.oa.v, c.lengths.ob.v, c.oc_g.v, c.beta.v + c.gamma.v, c.gamma.v);
            let centrifugal_n = design.clutch.sprags.mass_kg * c.oc_g.v * speed_rad_s * speed_rad_s;
            let n_be = centrifugal_n / c.gamma.v.cos();
            (-l.h_e * n_be, spring * (state.alpha_max_rad - c.alpha.v))
        }
        Err(_) => (1.0, 0.0),
    }
}

/// Speed up to which a lift-off is looked for, rad/s: 60 000 turns a minute, a choice.
pub const LIFT_OFF_TO_RAD_S: f64 = 60_000.0 * std::f64::consts::PI / 30.0;

/// How exactly the speed of lift-off is located, by the range in which it is looked for.
pub const LIFT_OFF_ERROR: f64 = 1e-12;

/// Lift-off speed of the outer race, rad/s: opening = closing moment, which is where [`overrun_at`] ends to find a normal
/// force at A; `None` where contact is kept to `up_to`.
pub fn lift_off_rad_s(design: &Design, state: &LoadState, up_to_rad_s: f64) -> Option<f64> {
    let left = |speed: f64| {
        let (opening, closing) = overrun_moments(design, state, speed);
        closing - opening
    };
    let (a, b) = (left(0.0), left(up_to_rad_s));
    if a <= 0.0 {
        return Some(0.0);
    }
    if b > 0.0 {
        return None;
    }
    root::bracketed(0.0, up_to_rad_s, a, b, LIFT_OFF_ERROR * up_to_rad_s, left)
}
