//! Velocities across a junction or first contact, where OC_g' and the rolling ratios jump.
//!
//! A rolling contact whose ratio jumps must give alpha', phi' a jump too. The jump is the limit of a fast smooth
//! change: momenta of all coordinates but alpha are kept, and so is kinetic energy, hence
//! alpha'+ = alpha'- sqrt(m-/m+) with the effective mass m = M_aa - M_ar M_rr^-1 M_ra of the rolling system.
//! Without rolling contacts nothing jumps.
//!
//! A race that its flange moves at a given speed u keeps that, whatever impulse it takes. Where it rolls it ties phi to alpha
//! (phi' = u + rho_i alpha' at A, u - rho_e alpha' at B), so that the kinetic energy becomes m alpha'^2/2 + g u alpha' + c u^2/2.
//! The middle term is a total derivative and c is no function of alpha: Jacobi's integral keeps m alpha'^2/2, again
//! alpha'+ = alpha'- sqrt(m-/m+). With s phi's slope by alpha, rho_i or -rho_e, and r = rho_i + rho_e,
//! m = n_s (I_g (1 + s)^2 + m_g OC_g^2 s^2), and r^2 times the inertia of the other race where that rolls along. Where
//! both races are moved and roll nothing is left to alpha: alpha' = (u_e - u_i)/r.

use nalgebra::{Matrix2, Matrix3, Vector3};

use super::model::{Grip, Mode, Model, Place};
use crate::wedge::WedgePoint;

/// Rates after the change from `before` to `after`; both points lie at the same alpha.
pub(super) fn cross(
    model: &Model,
    mode_after: &Mode,
    before: &WedgePoint,
    after: &WedgePoint,
    rates: [f64; 4],
) -> [f64; 4] {
    let [inner, outer] = rolling(mode_after);
    let [held_i, held_e] = model.held_rad_s2().map(|held| held.is_some());
    if (held_i && inner) || (held_e && outer) {
        return tied(model, before, after, rates, [inner, outer], [held_i, held_e]);
    }
    let races = Matrix2::new(model.inner_inertia_kg_m2, 0.0, 0.0, model.outer_inertia_kg_m2);
    cross_between(model, 1.0, mode_after, [before, after], rates, &races, [1.0; 2])
}

/// Which contacts roll in `mode`: inner, outer.
fn rolling(mode: &Mode) -> [bool; 2] {
    [mode.inner == Grip::Stick && mode.place != Place::Open, mode.outer == Grip::Stick]
}

/// The same of `times` as many sprags between races that move freely and whose inertia is `races`, kg m^2, with what turns
/// along with them. `along`: what phi' counts in the rolling of A and B, 1 where the axes meet.
pub(super) fn cross_between(
    model: &Model,
    times: f64,
    mode_after: &Mode,
    [before, after]: [&WedgePoint; 2],
    rates: [f64; 4],
    races: &Matrix2<f64>,
    along: [f64; 2],
) -> [f64; 4] {
    let [inner, outer] = rolling(mode_after);
    if !inner && !outer {
        return rates;
    }
    let of = |p: &WedgePoint| reduced(model, times, p, [inner, outer], races, along);
    let ((m_before, coupling_before, _), (m_after, coupling_after, rest)) = (of(before), of(after));
    let Some(rest_inverse) = rest.try_inverse() else { return rates };
    let alpha_rate = scaled(rates[0], m_before, m_after);
    // Momenta of (phi, free races) are kept: M_rr w_r + M_ra alpha' = const.
    let w = Vector3::new(rates[1], if inner { 0.0 } else { rates[2] }, if outer { 0.0 } else { rates[3] });
    let momentum = rest * w + coupling_before * rates[0];
    let w = rest_inverse * (momentum - coupling_after * alpha_rate);
    rated(after, alpha_rate, w, [inner, outer], along)
}

/// The same where G's orbit is another too, rolling or not: what that takes of the kinetic energy at these momenta, alpha' gives.
pub(super) fn cross_to_another_orbit(
    model: &Model,
    times: f64,
    mode_after: &Mode,
    [before, after]: [&WedgePoint; 2],
    rates: [f64; 4],
    races: &Matrix2<f64>,
    along: [f64; 2],
) -> [f64; 4] {
    let [inner, outer] = rolling(mode_after);
    let of = |p: &WedgePoint| reduced(model, times, p, [inner, outer], races, along);
    let ((m_before, coupling_before, rest_before), (m_after, coupling_after, rest)) = (of(before), of(after));
    let inverses = rest_before.try_inverse().zip(rest.try_inverse());
    let Some((inverse_before, inverse)) = inverses else { return rates };
    let w = Vector3::new(rates[1], if inner { 0.0 } else { rates[2] }, if outer { 0.0 } else { rates[3] });
    let momentum = rest_before * w + coupling_before * rates[0];
    let gain = (inverse_before * momentum).dot(&((rest - rest_before) * (inverse * momentum)));
    let squared = (m_before * rates[0] * rates[0] + gain) / m_after;
    let alpha_rate = squared.max(0.0).sqrt().copysign(rates[0]);
    rated(after, alpha_rate, inverse * (momentum - coupling_after * alpha_rate), [inner, outer], along)
}

/// All rates where `w` are those of (phi, free races).
fn rated(
    after: &WedgePoint,
    alpha_rate: f64,
    w: Vector3<f64>,
    [inner, outer]: [bool; 2],
    along: [f64; 2],
) -> [f64; 4] {
    [
        alpha_rate,
        w[0],
        if inner { along[0] * w[0] - after.rho_i * alpha_rate } else { w[1] },
        if outer { along[1] * w[0] + after.rho_e * alpha_rate } else { w[2] },
    ]
}

/// The same where a race that is moved at a given speed rolls; `rolls` and `held`: inner, outer.
fn tied(
    model: &Model,
    before: &WedgePoint,
    after: &WedgePoint,
    [da, _, di, de]: [f64; 4],
    rolls: [bool; 2],
    held: [bool; 2],
) -> [f64; 4] {
    let by_inner = rolls[0] && held[0];
    let both = rolls[0] && rolls[1];
    let da = if both && held[0] && held[1] {
        (de - di) / (after.rho_i + after.rho_e)
    } else {
        let other = match (both, by_inner) {
            (false, _) => 0.0,
            (true, true) => model.outer_inertia_kg_m2,
            (true, false) => model.inner_inertia_kg_m2,
        };
        let mass = |p: &WedgePoint| {
            let slope = if by_inner { p.rho_i } else { -p.rho_e };
            let orbit = model.mass_kg * p.oc_g * p.oc_g;
            model.count * (model.inertia_kg_m2 * (1.0 + slope).powi(2) + orbit * slope * slope)
                + other * (p.rho_i + p.rho_e).powi(2)
        };
        scaled(da, mass(before), mass(after))
    };
    let dp = if by_inner { di + after.rho_i * da } else { de - after.rho_e * da };
    let roll = |here: bool, rate: f64, rolled: f64| if here { rolled } else { rate };
    [
        da,
        dp,
        roll(rolls[0] && !held[0], di, dp - after.rho_i * da),
        roll(rolls[1] && !held[1], de, dp + after.rho_e * da),
    ]
}

/// The rate whose kinetic energy is kept where its effective mass changes.
pub(super) fn scaled(rate: f64, before: f64, after: f64) -> f64 {
    rate * (before / after).max(0.0).sqrt()
}

/// (effective mass of alpha, coupling of alpha to (phi, theta_bi, theta_be), mass of those), kg m^2; a race that
/// rolls is folded into alpha and phi, its own slot holds a unit mass that nothing moves.
fn reduced(
    model: &Model,
    times: f64,
    p: &WedgePoint,
    [inner, outer]: [bool; 2],
    races: &Matrix2<f64>,
    [e_i, e_e]: [f64; 2],
) -> (f64, Vector3<f64>, Matrix3<f64>) {
    let n = times * model.count;
    let i_g = n * model.inertia_kg_m2;
    let orbit = n * model.mass_kg * p.oc_g * p.oc_g;
    let (i_i, i_e, both) = (races[(0, 0)], races[(1, 1)], races[(0, 1)]);
    let (mut aa, mut ap, mut pp) = (i_g, i_g, i_g + orbit);
    let mut rest = Matrix3::from_diagonal(&Vector3::new(0.0, i_i, i_e));
    let mut coupling = Vector3::zeros();
    if inner {
        aa += i_i * p.rho_i * p.rho_i;
        ap -= i_i * p.rho_i * e_i;
        pp += i_i * e_i * e_i;
        rest[(1, 1)] = 1.0;
    }
    if outer {
        aa += i_e * p.rho_e * p.rho_e;
        ap += i_e * p.rho_e * e_e;
        pp += i_e * e_e * e_e;
        rest[(2, 2)] = 1.0;
    }
    // What turns along with both races ties them.
    match (inner, outer) {
        (true, true) => {
            aa -= 2.0 * both * p.rho_i * p.rho_e;
            ap += both * (p.rho_e * e_i - p.rho_i * e_e);
            pp += 2.0 * both * e_i * e_e;
        }
        (true, false) => {
            coupling[2] = -both * p.rho_i;
            (rest[(0, 2)], rest[(2, 0)]) = (both * e_i, both * e_i);
        }
        (false, true) => {
            coupling[1] = both * p.rho_e;
            (rest[(0, 1)], rest[(1, 0)]) = (both * e_e, both * e_e);
        }
        (false, false) => (rest[(1, 2)], rest[(2, 1)]) = (both, both),
    }
    (coupling[0], rest[(0, 0)]) = (ap, pp);
    let alone = coupling[1] == 0.0 && coupling[2] == 0.0;
    let carried = match rest.try_inverse() {
        Some(inverse) if !alone => coupling.dot(&(inverse * coupling)),
        _ => ap * ap / pp,
    };
    (aa - carried, coupling, rest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::Design;
    use crate::dynamics::{FlangeDrive, Loads, Ramp, alpha_max_rad};
    use crate::wedge::WedgeCurve;

    /// A race that is moved is the limit of one whose inertia is large beside the sprags', whose cancellation is then still small.
    #[test]
    fn a_moved_race_crosses_a_junction_as_a_heavy_one() {
        let design = Design::parse(include_str!("../../designs/huang2017-multi-arc.toml"), "design").unwrap();
        let profile = design.clutch.profile().unwrap();
        let curve = WedgeCurve::build(&design.clutch, &profile, 0.0).unwrap();
        let none = Loads { inner_nm: 0.0, amplitude_nm: 0.0, omega_rad_s: 0.0, abutment_nm_per_rad: 0.0 };
        let alpha_max = alpha_max_rad(&design.clutch, &curve);
        let junction = curve.arc_end_rad(0);
        let free = Model::new(&design.clutch, curve, none, alpha_max, 0.0);
        let before = free.point(Place::Arc(0), junction);
        // The paper's junction jumps by less than 1e-3; here enough to be seen.
        let after = free.point(Place::Arc(1), junction);
        let after = WedgePoint { rho_i: 1.05 * after.rho_i, rho_e: 0.97 * after.rho_e, ..after };
        for moved in [[true, false], [false, true], [true, true]] {
            let (mut heavy, mut held) = (free.clone(), free.clone());
            for (race, inertia) in
                [&mut heavy.inner_inertia_kg_m2, &mut heavy.outer_inertia_kg_m2].into_iter().enumerate()
            {
                *inertia = if moved[race] { 10.0 } else { *inertia };
            }
            held.drive.flanges = Some(moved.map(|moved| match moved {
                true => FlangeDrive::Acceleration(0.0),
                false => FlangeDrive::Torque(Ramp::default()),
            }));
            for rolls in [[true, true], [true, false], [false, true]] {
                let grip = |rolls: bool| if rolls { Grip::Stick } else { Grip::Slip(1.0) };
                let mode = Mode { place: Place::Arc(1), inner: grip(rolls[0]), outer: grip(rolls[1]) };
                let mut y = [0.0; 10];
                y[4..8].copy_from_slice(&[7.0, -2.0, 3.0, 5.0]);
                let rates = free.rates(&mode, &before, &y);
                let limit = cross(&heavy, &mode, &before, &after, rates);
                let found = cross(&held, &mode, &before, &after, rates);
                for (a, b) in found.iter().zip(limit) {
                    assert!(
                        (a - b).abs() < 1e-5 * rates[0].abs(),
                        "{moved:?} {rolls:?}: {found:?} {limit:?}"
                    );
                }
                for race in (0..2).filter(|race| moved[*race]) {
                    // Where it does not roll it is solved for with the others, to rounding.
                    assert!((found[2 + race] - rates[2 + race]).abs() < 1e-14, "{moved:?} {rolls:?}");
                }
                // And it rolls on.
                y[4..8].copy_from_slice(&found);
                for (a, b) in found.iter().zip(free.rates(&mode, &after, &y)) {
                    assert!((a - b).abs() < 1e-12 * 10.0, "{moved:?} {rolls:?}");
                }
            }
        }
    }
}
