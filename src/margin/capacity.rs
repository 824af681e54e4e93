//! How each static limit's demand runs with torque, and the torque at which it would be reached.

use super::Margin;
use super::limits::{Limit, Of, When};
use super::load::{LoadCase, LoadState, clearances_m, profile_capacity};
use super::pressed::tops;
use super::sprag::grip;
use super::table::{END_OF_PROFILE, GRIP_INNER, LIMITS};
use crate::design::{Design, Limits};
use crate::numeric::root;
use crate::wedge::StaticPoint;

/// What one limit bounds, as a function of the static state; demand and allowable in the same unit.
struct Bounded<'a> {
    limit: &'static Limit,
    allowed: f64,
    demand: Box<dyn Fn(&StaticPoint) -> f64 + 'a>,
}

impl Bounded<'_> {
    /// Torque at which the limit is reached, N m.
    fn reached(&self, state: &LoadState) -> f64 {
        torque_where(state, self.allowed, self.limit.pressed, &*self.demand)
    }
}

/// The same of `limit`, where it depends on torque and `case` asks for it.
fn bounded<'a>(case: LoadCase<'a>, limit: &'static Limit) -> Option<Bounded<'a>> {
    let LoadCase { design, limits, state } = case;
    match limit.of {
        Of::RollOver => Some(Bounded {
            limit,
            allowed: state.curve.roll_over_torque_nm(),
            demand: Box::new(|p| p.torque_nm),
        }),
        // Clearance used up, so that it rises to 1 where neighbours touch.
        Of::Neighbours => {
            let clearance_m = clearances_m(design, state)?;
            let free = clearance_m(&StaticPoint::UNLOADED);
            let used = move |p: &StaticPoint| 1.0 - clearance_m(p) / free;
            Some(Bounded { limit, allowed: 1.0, demand: Box::new(used) })
        }
        _ => {
            let (allowed, _) = limit.allowed(design, limits)?;
            let demand = move |p: &StaticPoint| limit.demand(&case, p).unwrap_or(f64::NAN);
            Some(Bounded { limit, allowed, demand: Box::new(demand) })
        }
    }
}

/// Fill `torque_capacity_nm` of the rows that depend on torque.
pub(super) fn fill(rows: &mut [Margin], design: &Design, limits: &Limits, state: &LoadState) {
    let case = LoadCase { design, limits, state };
    for row in rows {
        row.torque_capacity_nm = match row.limit.of {
            Of::RollOver => Some(row.allowable),
            _ if row.limit == &END_OF_PROFILE => Some(profile_capacity(state)),
            _ => bounded(case, row.limit).map(|b| b.reached(state)),
        };
    }
}

/// Demand over allowable of one limit along the curve.
#[derive(Debug, Clone, PartialEq)]
pub struct DemandCourse {
    /// Code of its row.
    pub code: String,
    /// Whether it counts for the verdict.
    pub required: bool,
    /// (torque N m, demand/allowable, pure number), in the order of the points asked for; the limit is reached at 1.
    pub points: Vec<[f64; 2]>,
}

/// The courses of all limits in `rows` that depend on torque, at the static states `points`.
pub fn courses(
    rows: &[Margin],
    design: &Design,
    limits: &Limits,
    state: &LoadState,
    points: &[StaticPoint],
) -> Vec<DemandCourse> {
    let case = LoadCase { design, limits, state };
    let course = |row: &Margin| {
        let b = bounded(case, row.limit).filter(|_| !row.off_centre && row.corner.is_none())?;
        let points = points.iter().map(|p| [p.torque_nm, (b.demand)(p) / b.allowed]).collect();
        Some(DemandCourse { code: row.code(), required: row.required, points })
    };
    rows.iter().filter_map(course).collect()
}

/// Smallest normal force at which the quantity rises to `allowed`, as a torque; the end of the curve if it never
/// does. Stresses grow with the normal force; tan omega too, on a profile that steepens. The friction for an axial
/// load falls from infinity first: what counts is where it rises again, and where it was never low enough, 0. Of what the inner contact's
/// pressure decides (`pressed`) the tops of that are looked at too.
fn torque_where(state: &LoadState, allowed: f64, pressed: bool, value: &dyn Fn(&StaticPoint) -> f64) -> f64 {
    let curve = &state.curve;
    let last = curve.arc_end_n(curve.arc_count() - 1);
    let miss = |n: f64| curve.at_normal(n).map_or(f64::NAN, |p| value(&p) - allowed);
    let torque = |n: f64| curve.at_normal(n).map_or(0.0, |p| p.torque_nm);
    const LOOKS: usize = 64;
    let (mut a, mut fa) = (1e-6 * last, miss(1e-6 * last));
    let mut looks: Vec<f64> = (1..=LOOKS).map(|i| last * i as f64 / LOOKS as f64).collect();
    if pressed {
        let tops = tops(state, last).into_iter().map(|(_, top)| top.normal_inner_n);
        looks.extend(tops.filter(|n| (a..last).contains(n)));
        looks.sort_by(f64::total_cmp);
    }
    for b in looks {
        let fb = miss(b);
        if fa < 0.0 && fb >= 0.0 {
            return root::bracketed(a, b, fa, fb, 1e-10 * last, miss).map_or(torque(b), torque);
        }
        (a, fa) = (b, fb);
    }
    if fa < 0.0 { torque(last) } else { 0.0 }
}

/// Torque from which on, up to `up_to_nm`, friction of both contacts carries the axial load as well, N m: the last
/// state below it at which a contact would need more than `mu`. 0 where that never happens, `None` where it happens
/// at `up_to_nm` itself (or at the curve's end, if that comes first).
pub(super) fn axial_from_nm(
    design: &Design,
    limits: &Limits,
    state: &LoadState,
    up_to_nm: f64,
) -> Option<f64> {
    let curve = &state.curve;
    let mu = design.clutch.friction.static_;
    let end = curve.arc_end_n(curve.arc_count() - 1);
    let last = curve.at_torque(up_to_nm).map_or(end, |p| p.normal_inner_n);
    let over = |n: f64| {
        curve.at_normal(n).map_or(f64::NAN, |p| {
            let [inner, outer] = grip(design, limits, &p);
            // Bounded, so that the bracketing is not led astray by the infinite demand at no load.
            (inner.max(outer) / mu - 1.0).min(1.0)
        })
    };
    if over(last) > 0.0 {
        return None;
    }
    // Down from the top in octaves: the demand rises as 1/N below.
    let (mut b, mut fb) = (last, over(last));
    for _ in 0..60 {
        let a = 0.7 * b;
        let fa = over(a);
        if fa > 0.0 {
            let n = root::bracketed(a, b, fa, fb, 1e-12 * last, over)?;
            return curve.at_normal(n).map(|p| p.torque_nm);
        }
        (b, fb) = (a, fa);
    }
    Some(0.0)
}

/// Smallest torque (N m) at which a limit on nominal torque, the grip at either contact or the curve's end is reached,
/// and the code of what decides; `None` where `limits` holds none of them.
pub fn nominal_capacity(design: &Design, limits: &Limits, state: &LoadState) -> Option<(f64, &'static str)> {
    // What does not grip at first contact never gets as far as the torque at which it would.
    if state.first_tan_omega >= design.clutch.friction.static_ {
        return Some((0.0, GRIP_INNER.code));
    }
    let case = LoadCase { design, limits, state };
    let all = || LIMITS.iter().filter_map(|limit| bounded(case, limit));
    let nominal = |b: &Bounded| b.limit.when == When::Nominal;
    if !all().any(|b| nominal(&b)) {
        return None;
    }
    // Limits of which states on the way count are those of the grip.
    let grips = |b: &Bounded| matches!(b.limit.of, Of::Sprag { below_torque: Some(_), .. });
    let reached = all().filter(|b| nominal(b) || grips(b)).map(|b| (b.reached(state), b.limit.code));
    let end = (state.curve.end_torque_nm(), "end-of-curve");
    Some(reached.fold(end, |least, found| if found.0 < least.0 { found } else { least }))
}
