//! The state on the way to a torque in which the inner contact is pressed most.
//!
//! Pressure rises with the force on one arc. Behind a junction to a far larger radius it may fall while the torque rises; the outer contact
//! has one radius.

use super::load::{LOOKS, LoadState, at};
use crate::numeric::golden::top;
use crate::wedge::StaticPoint;

/// Tops of the inner contact's pressure below the inner normal force `until_n`, N, each with the number of the look beside it; of those
/// looks alone that the state names.
pub(super) fn tops(state: &LoadState, until_n: f64) -> Vec<(usize, StaticPoint)> {
    let curve = &state.curve;
    let arcs = curve.arc_count();
    if arcs == 1 {
        return Vec::new();
    }
    let step_n = until_n / LOOKS as f64;
    let pressed = |n: f64| curve.at_normal(n).map_or(0.0, |p| p.hertz_inner_pa);
    let look = |k: usize| pressed(k as f64 * step_n);
    let mut near = state.looks.clone().unwrap_or_else(|| {
        let looks: Vec<f64> = (0..=LOOKS).map(look).collect();
        let mut near: Vec<usize> =
            (1..LOOKS).filter(|&k| looks[k] > looks[k + 1] && looks[k] >= looks[k - 1]).collect();
        // Tops between two looks: at a junction, or just before the end.
        let ends = (0..arcs - 1).map(|arc| curve.arc_end_n(arc)).filter(|n| *n < until_n);
        let falls = ends.filter(|n| pressed(*n) > pressed((n + 0.2 * step_n).min(until_n)));
        near.extend(falls.map(|n| (n / step_n).round() as usize));
        near.extend((pressed(0.999 * until_n) > looks[LOOKS]).then_some(LOOKS - 1));
        near
    });
    near.iter_mut().for_each(|k| *k = (*k).clamp(1, LOOKS - 1));
    near.sort_unstable();
    near.dedup();
    let polished = |k: usize| {
        let n = top((k - 1) as f64 * step_n, (k + 1) as f64 * step_n, pressed);
        Some((k, curve.at_normal(n)?))
    };
    near.into_iter().filter_map(polished).collect()
}

/// The state below `peak` in which the inner contact is pressed most, with the number of the look beside it; `None` where that is pressed
/// less than at `peak`.
pub(super) fn most_pressed(state: &LoadState, peak: &StaticPoint) -> Option<(usize, StaticPoint)> {
    let more = |(_, p): &(usize, StaticPoint)| p.hertz_inner_pa > peak.hertz_inner_pa;
    let tops = tops(state, peak.normal_inner_n).into_iter().filter(more);
    tops.max_by(|a, b| a.1.hertz_inner_pa.total_cmp(&b.1.hertz_inner_pa))
}

/// Largest pressures p_0 of inner and outer contact up to `torque_nm`, N m, or to the curve's end, Pa.
pub fn largest_pressures_pa(state: &LoadState, torque_nm: f64) -> [f64; 2] {
    let peak = at(&state.curve, torque_nm);
    let inner = most_pressed(state, &peak).map_or(peak.hertz_inner_pa, |(_, p)| p.hertz_inner_pa);
    [inner, peak.hertz_outer_pa]
}
