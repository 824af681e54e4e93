//! Overrun: how hard the sprags rub, what they drag, and at which speed they lift off.
//!
//! Without a driven cage the sprags ride with the outer race, so their speed is that of the outer race: where the inner race alone runs they
//! are at rest and nothing but sliding friction changes with the speed; where the outer race runs, the centrifugal
//! force acts at G. It presses the sprags in where G lies behind C_e (gamma > 0, an engaging design) and lifts them off
//! the inner race where G lies ahead (gamma < 0, a disengaging one). A cage that the inner race drives carries them with that one:
//! then B slides, the centrifugal force is that of the inner race's speed, and lifts them off the outer race.

use super::load::LoadState;
use crate::design::Design;
use crate::dynamics::{Overrun, Swing, pivot_moments};
use crate::follow::Follow;
use crate::kinematics::levers;
use crate::numeric::root;
use crate::scenario::{Lubricated, sliding, touch};
use crate::wedge::{FIRST_CONTACT_N, NoCurve, WedgeCurve};

/// One steady overrun.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OverrunPoint {
    /// Speed of the races against one another, at which the inner contact slides, in a driven cage the outer one, rad/s, not negative.
    pub speed_rad_s: f64,
    /// Friction coefficient of the sliding contact at that speed, pure number.
    pub friction: f64,
    /// Equilibrium of one sprag, and the drag torque of all.
    pub state: Overrun,
    /// That contact on its film, and its heat; `None` without `[lubrication]` and where it is open.
    pub lubricated: Option<Lubricated>,
    /// The small swing about that equilibrium, races at constant speeds; `None` where the sliding contact is open or nothing slides.
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
    /// The inner race runs, the outer one stands, and the sprags with it unless a cage carries them.
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
    let build = |speed: f64| touch(&design.clutch, &state.profile, speed);
    let point = |curve: &WedgeCurve, ahead: f64| point(design, state, curve, ahead);
    let rest = build(0.0)?;
    let speeds = (0..SPEEDS).map(|i| up_to_rad_s * i as f64 / (SPEEDS - 1) as f64);
    let speeds = speeds.take_while(|_| !follow.stopped());
    let inner_race = speeds.clone().map(|speed| point(&rest, speed)).collect();
    let outer_race = speeds.map_while(|speed| build(speed).ok().map(|curve| point(&curve, -speed))).collect();
    Ok(OverrunCurve { outer_race, inner_race, gamma_rad: state.curve.statics().gamma0_rad() })
}

/// The steady overrun in which the outer race runs at `outer_rad_s` and the inner one is ahead of it by `ahead_rad_s`: behind it, as
/// where it stands, if that is negative.
///
/// # Errors
/// [`NoCurve`] where there is no first contact at that speed.
pub fn overrun_at(
    design: &Design,
    state: &LoadState,
    outer_rad_s: f64,
    ahead_rad_s: f64,
) -> Result<OverrunPoint, NoCurve> {
    let curve = touch(&design.clutch, &state.profile, outer_rad_s)?;
    Ok(point(design, state, &curve, ahead_rad_s))
}

/// The outer race at the speed of `curve`, the inner one ahead by `ahead_rad_s`.
fn point(design: &Design, state: &LoadState, curve: &WedgeCurve, ahead_rad_s: f64) -> OverrunPoint {
    let speed_rad_s = ahead_rad_s.abs();
    let clutch = &design.clutch;
    let ring = &state.curve.statics().elastic.outer_race;
    let found = sliding(clutch, curve, state.alpha_max_rad, ahead_rad_s);
    OverrunPoint {
        speed_rad_s,
        friction: found.friction,
        state: found.state,
        lubricated: found.lubricated,
        swing_by_friction: found
            .lubricated
            .and_then(|l| l.swing_by_friction(&found.state, clutch, curve, state.alpha_max_rad, ahead_rad_s)),
        swing: found.swing(clutch, curve, state.alpha_max_rad, ahead_rad_s),
        growth_m: ring.centrifugal_bore_growth_m(curve.speed_rad_s()),
        rotation_hoop_pa: ring.rotating_bore_hoop_pa(curve.speed_rad_s()),
    }
}

/// (opening moment of the centrifugal force, closing moment of the spring) on one sprag about G at first contact
/// at overrun speed `speed_rad_s`, N m. Contact is kept while the first is smaller. Zero load at A, and with it no
/// friction there (|T_bi| <= mu N_bi) nor at B (T_be OB = T_bi OA): h_e N_be = h_e m_g OC_g Omega^2/cos gamma, which closes
/// for gamma > 0 and opens for gamma < 0. The closure's own N_be is not that: it holds the sprag without a spring, by the
/// T_bi at N_bi = 0 that this takes (its `t_offset_n`), which a contact without load does not have. In a driven cage about its pivot,
/// `speed_rad_s` that of the inner race, the outer one at rest ([`crate::dynamics::overrun_in_cage`]).
pub(super) fn overrun_moments(design: &Design, state: &LoadState, speed_rad_s: f64) -> (f64, f64) {
    if let Some(cage) = &design.clutch.cage {
        return pivot_moments(&design.clutch, cage, &state.curve, state.alpha_max_rad, speed_rad_s);
    }
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

/// A first turn, by the range in which lift-off is looked for: a choice, 0.06 rpm.
const FIRST_TURN: f64 = 1e-6;

/// Lift-off speed, rad/s, of the outer race, in a driven cage of the inner one: opening = closing moment, which is where [`overrun_at`]
/// ends to find a normal force at the sliding contact; `None` where contact is kept to `up_to`.
pub fn lift_off_rad_s(design: &Design, state: &LoadState, up_to_rad_s: f64) -> Option<f64> {
    lift_off_under(design, state, 1.0, up_to_rad_s)
}

/// The same where the spring presses `times` as hard.
pub fn lift_off_under(design: &Design, state: &LoadState, times: f64, up_to_rad_s: f64) -> Option<f64> {
    let left = |speed: f64| {
        let (opening, closing) = overrun_moments(design, state, speed);
        times * closing - opening
    };
    // Without a spring nothing presses at rest, and the first turn decides.
    let from = if left(0.0) == 0.0 { FIRST_TURN * up_to_rad_s } else { 0.0 };
    let (a, b) = (left(from), left(up_to_rad_s));
    if a <= 0.0 {
        return Some(0.0);
    }
    if b > 0.0 {
        return None;
    }
    root::bracketed(from, up_to_rad_s, a, b, LIFT_OFF_ERROR * up_to_rad_s, left)
}
