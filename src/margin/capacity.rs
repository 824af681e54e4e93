//! Torque at which each static limit would be reached.

use super::Margin;
use super::gap::YIELDS;
use super::hoop::HOOPS;
use super::load::{LoadState, grip, profile_capacity};
use super::subsurface::SUBSURFACE;
use crate::design::{Design, Limits};
use crate::numeric::root;
use crate::wedge::StaticPoint;

/// Fill `torque_capacity_nm` of the rows that depend on torque.
pub(super) fn fill(rows: &mut [Margin], design: &Design, limits: &Limits, state: &LoadState) {
    let count = design.clutch.sprags.count;
    let elastic = &state.curve.statics().elastic;
    let mu = design.clutch.friction.static_;
    for row in rows {
        if let Some(hoop) = HOOPS.iter().find(|h| h.code == row.code) {
            let allowed = (hoop.allowed)(limits).map(|(allowed, _)| allowed);
            let value = |p: &StaticPoint| (hoop.demand)(elastic, count, p);
            row.torque_capacity_nm = allowed.map(|a| torque_where(state, a, &value));
            continue;
        }
        if let Some(y) = YIELDS.iter().find(|y| y.code == row.code) {
            let value = |p: &StaticPoint| (y.demand)(elastic, count, p);
            row.torque_capacity_nm =
                (y.allowed)(limits, design).map(|allowed| torque_where(state, allowed, &value));
            continue;
        }
        if let Some(below) = SUBSURFACE.iter().find(|b| b.code == row.code) {
            row.torque_capacity_nm = (below.allowed)(limits).map(|(allowed, from_m)| {
                torque_where(state, allowed, &|p| below.demand(design, from_m, p).0)
            });
            continue;
        }
        let value: Box<dyn Fn(&StaticPoint) -> f64> = match row.code.as_str() {
            "hertz-nominal-inner" | "hertz-peak-inner" => Box::new(|p| p.hertz_inner_pa),
            "hertz-nominal-outer" | "hertz-peak-outer" => Box::new(|p| p.hertz_outer_pa),
            "grip-inner" => Box::new(|p| grip(design, limits, p)[0]),
            "grip-outer" => Box::new(|p| grip(design, limits, p)[1]),
            "end-of-profile" => {
                row.torque_capacity_nm = Some(profile_capacity(state));
                continue;
            }
            "roll-over" => {
                row.torque_capacity_nm = Some(row.allowable);
                continue;
            }
            _ => continue,
        };
        let allowed = match row.code.as_str() {
            "hertz-nominal-inner" | "hertz-nominal-outer" => limits.hertz_nominal_pa,
            "hertz-peak-inner" | "hertz-peak-outer" => limits.hertz_peak_pa,
            _ => Some(mu),
        };
        row.torque_capacity_nm = allowed.map(|a| torque_where(state, a, &value));
    }
}

/// Smallest normal force at which the quantity rises to `allowed`, as a torque; the end of the curve if it never
/// does. Stresses grow with the normal force; tan omega too, on a profile that steepens. The friction for an axial
/// load falls from infinity first: what counts is where it rises again, and where it was never low enough, 0.
fn torque_where(state: &LoadState, allowed: f64, value: &dyn Fn(&StaticPoint) -> f64) -> f64 {
    let curve = &state.curve;
    let last = curve.arc_end_n(curve.arc_count() - 1);
    let miss = |n: f64| curve.at_normal(n).map_or(f64::NAN, |p| value(&p) - allowed);
    let torque = |n: f64| curve.at_normal(n).map_or(0.0, |p| p.torque_nm);
    const LOOKS: usize = 64;
    let (mut a, mut fa) = (1e-6 * last, miss(1e-6 * last));
    for i in 1..=LOOKS {
        let b = last * i as f64 / LOOKS as f64;
        let fb = miss(b);
        if fa < 0.0 && fb >= 0.0 {
            return root::bracketed(a, b, fa, fb, 1e-10 * last, miss).map_or(torque(b), torque);
        }
        (a, fa) = (b, fb);
    }
    if fa < 0.0 { torque(last) } else { 0.0 }
}

/// Smallest torque (N m) at which a limit on nominal torque, the grip at either contact or the curve's end is reached,
/// and the code of what decides; `None` where `limits` holds none of them.
pub fn nominal_capacity(design: &Design, limits: &Limits, state: &LoadState) -> Option<(f64, &'static str)> {
    let count = design.clutch.sprags.count;
    let elastic = &state.curve.statics().elastic;
    let mu = design.clutch.friction.static_;
    // What does not grip at first contact never gets as far as the torque at which it would.
    if state.first_tan_omega >= mu {
        return Some((0.0, "grip-inner"));
    }
    let mut least = (state.curve.end_torque_nm(), "end-of-curve");
    let mut any = false;
    let mut take = |code, allowed: f64, value: &dyn Fn(&StaticPoint) -> f64| {
        let torque = torque_where(state, allowed, value);
        if torque < least.0 {
            least = (torque, code);
        }
    };
    if let Some(allowed) = limits.hertz_nominal_pa {
        any = true;
        take("hertz-nominal-inner", allowed, &|p| p.hertz_inner_pa);
        take("hertz-nominal-outer", allowed, &|p| p.hertz_outer_pa);
    }
    // Those that are held at the nominal torque itself.
    let nominal = Limits { nominal_torque_nm: Some(1.0), peak_torque_nm: None, ..*limits };
    for y in YIELDS.iter().filter(|y| (y.torque_nm)(&nominal).is_some()) {
        if let Some(allowed) = (y.allowed)(limits, design) {
            any = true;
            take(y.code, allowed, &|p| (y.demand)(elastic, count, p));
        }
    }
    take("grip-inner", mu, &|p| grip(design, limits, p)[0]);
    take("grip-outer", mu, &|p| grip(design, limits, p)[1]);
    any.then_some(least)
}
