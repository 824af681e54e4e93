//! Where a run of many sprags begins.

use super::{ManyStart, SpragGroup, SpragMotion};
use crate::dynamics::model::{Grip, Mode, Place, State};
use crate::numeric::root;
use crate::wedge::WedgeCurve;

impl SpragMotion {
    /// In `mode`, touching.
    pub fn touching(mode: Mode) -> Self {
        Self { mode, waits: false, phase: None }
    }

    /// Not touching yet.
    pub fn waiting() -> Self {
        let mode = Mode { place: Place::Open, inner: Grip::Stick, outer: Grip::Stick };
        Self { mode, waits: true, phase: None }
    }
}

impl ManyStart {
    /// Every group that touches as the one-sprag model has it, the races as the first of them; the others wait.
    pub fn of(each: &[Option<(State, Mode)>]) -> Option<Self> {
        let (first, _) = each.iter().flatten().next()?;
        let sprag = |of: &Option<(State, Mode)>| of.map_or([0.0; 4], |(y, _)| [y[0], y[4], y[1], y[5]]);
        let motion = |of: &Option<(State, Mode)>| {
            of.map_or(SpragMotion::waiting(), |(_, mode)| SpragMotion::touching(mode))
        };
        Some(Self {
            races: [first[2], first[3], first[6], first[7]],
            sprags: each.iter().map(sprag).collect(),
            motions: each.iter().map(motion).collect(),
        })
    }
}

/// Rest under `torque_nm` >= 0, both races in balance: every group at its own alpha of one windup, `spring`s at work or left out.
/// `None` where it is not carried before one comes to its end.
pub fn settled_together(groups: &[SpragGroup], torque_nm: f64, spring: bool) -> Option<ManyStart> {
    let own = |group: &SpragGroup, windup: f64| -> Option<(f64, Place)> {
        let windup = windup - group.lag_rad.unwrap_or(0.0);
        (windup >= 0.0).then(|| alpha_at_windup(&group.model.curve, windup)).flatten()
    };
    let carried = |windup: f64| -> f64 {
        let one = |group: &SpragGroup| {
            let model = &group.model;
            let Some((alpha, place)) = own(group, windup) else { return 0.0 };
            let p = model.point(place, alpha);
            let pressed = if spring { model.spring_nm_per_rad * (model.alpha_max_rad - alpha) } else { 0.0 };
            model.count * (p.t_static * p.oa - pressed / (p.rho_i + p.rho_e))
        };
        groups.iter().map(one).sum()
    };
    let end = |group: &SpragGroup| {
        let curve = &group.model.curve;
        curve.windup_rad(curve.end().1) + group.lag_rad.unwrap_or(0.0)
    };
    let most = groups.iter().map(end).fold(f64::INFINITY, f64::min);
    let at = |windup: f64| carried(windup) - torque_nm;
    let (low, high) = (at(0.0), at(most));
    let loaded = low < 0.0;
    let windup = if loaded { root::bracketed(0.0, most, low, high, 1e-16, at)? } else { 0.0 };
    let model = &groups.first()?.model;
    let abutment = model.loads.abutment_nm_per_rad;
    let outer = if abutment > 0.0 && torque_nm > 0.0 { -torque_nm / abutment } else { 0.0 };
    let each = |group: &SpragGroup| {
        let (alpha, place) = own(group, windup)?;
        let place = if loaded { place } else { Place::Open };
        let mut y = [0.0; super::N_STATE];
        (y[0], y[2], y[3]) = (alpha, outer - windup, outer);
        Some((y, Mode { place, inner: Grip::Stick, outer: Grip::Stick }))
    };
    ManyStart::of(&groups.iter().map(each).collect::<Vec<_>>())
}

/// alpha, rad, and place where `curve` has rolled by `windup_rad` >= 0; `None` beyond its end.
fn alpha_at_windup(curve: &WedgeCurve, windup_rad: f64) -> Option<(f64, Place)> {
    let mut from = curve.first_contact_rad();
    for k in 0..curve.arc_count() {
        let until = curve.arc_end_rad(k);
        let left = |alpha: f64| curve.windup_rad(alpha) - windup_rad;
        if left(until) >= 0.0 {
            let alpha = root::bracketed(from, until, left(from).min(-0.0), left(until), 1e-17, left)?;
            return Some((alpha, Place::Arc(k)));
        }
        from = until;
    }
    None
}
