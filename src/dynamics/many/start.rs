//! Where a run of many sprags begins.

use super::axes::{Axes, rotated};
use super::{ManyStart, SpragGroup, SpragMotion};
use crate::dynamics::model::{Grip, Mode, Place, State};
use crate::numeric::root;
use crate::wedge::WedgeCurve;
use nalgebra::{Matrix4, Vector4};

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
            shift_m: [0.0; 2],
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

/// The same where the axes do not meet or may give way, which they do with the load: each group at its own alpha of one windup since torque
/// began, its azimuth what it has rolled along by then.
pub fn settled_off_centre(
    groups: &[SpragGroup],
    axes: &Axes,
    torque_nm: f64,
    spring: bool,
) -> Option<ManyStart> {
    let rest = Rest { groups, axes, torque_nm, spring };
    let mut at = if torque_nm > 0.0 { rest.balanced()? } else { Vector4::zeros() };
    if axes.bearing.is_none() {
        (at[2], at[3]) = (0.0, 0.0);
    }
    let each = |group: &SpragGroup| Some(rest.stands(group, &at)?.map(|found| found.state));
    let mut start = ManyStart::of(&groups.iter().map(each).collect::<Option<Vec<_>>>()?)?;
    start.races = [at[1] - at[0], at[1], 0.0, 0.0];
    start.shift_m = [at[2], at[3]];
    Some(start)
}

/// Rest under a torque; what is sought is windup, theta_be (rad) and the shift of the axis (m).
struct Rest<'a> {
    groups: &'a [SpragGroup],
    axes: &'a Axes,
    torque_nm: f64,
    spring: bool,
}

/// A group at rest, and what all of it does to the races (N m) and the axis (N).
struct GroupAtRest {
    state: (State, Mode),
    acts: Vector4<f64>,
}

impl Rest<'_> {
    /// Group `group` at `at`; `None`: it has come to its end, within: it does not touch yet.
    fn stands(&self, group: &SpragGroup, at: &Vector4<f64>) -> Option<Option<GroupAtRest>> {
        let off = group.off_centre.as_ref()?;
        let curve = &group.model.curve;
        let touch = curve.first_contact_rad();
        let seen = |k: usize, alpha: f64, axis_m: [f64; 2], phi: f64| {
            off.turns.at(k, alpha, rotated(axis_m, -(off.azimuth_rad + phi)))
        };
        let begun = seen(0, touch, self.axes.offset_m(0.0, [0.0; 2]), 0.0);
        let races = [at[1] - at[0], at[1]];
        let offset = self.axes.offset_m(0.0, races);
        let axis_m = [offset[0] + at[2], offset[1] + at[3]];
        let mut phi = at[1];
        let mut alpha = touch;
        // Its azimuth moves the axis by a hundredth of what it rolls.
        for _ in 0..40 {
            let left = |alpha: f64| {
                let [a, b] = seen(curve.arc_at(alpha), alpha, axis_m, phi);
                let more = a.value + b.value - begun[0].value - begun[1].value;
                curve.windup_rad(alpha) + more + group.lag_rad.unwrap_or(0.0) - at[0]
            };
            let (low, high) = (left(touch), left(curve.end().1));
            if low > 0.0 && group.lag_rad.is_some() {
                return Some(None);
            }
            let found = if low >= 0.0 {
                touch
            } else {
                root::bracketed(touch, curve.end().1, low, high, 1e-17, left)?
            };
            let rolled = seen(curve.arc_at(found), found, axis_m, phi)[1].value - begun[1].value;
            let next = at[1] - curve.outer_roll_rad(found) - rolled;
            let done = (found - alpha).abs() <= 1e-15 && (next - phi).abs() <= 1e-15;
            (alpha, phi) = (found, next);
            if done {
                break;
            }
        }
        let loaded = alpha > touch;
        let place = if loaded { Place::Arc(curve.arc_at(alpha)) } else { Place::Open };
        let mut state = [0.0; super::N_STATE];
        (state[0], state[1], state[2], state[3]) = (alpha, phi, races[0], races[1]);
        let mode = Mode { place, inner: Grip::Stick, outer: Grip::Stick };
        let mut acts = Vector4::zeros();
        if loaded {
            let mut y = [0.0; super::HEAD + super::EACH + super::axes::AXIS];
            (y[0], y[1]) = (races[0], races[1]);
            let tail = y.len() - super::axes::AXIS;
            (y[tail], y[tail + 1]) = (at[2], at[3]);
            let sight = group.sight(Some(self.axes), 1, place, 0.0, &y, &state);
            let (model, p) = (&group.model, &sight.point);
            let axes = sight.axes.as_ref()?;
            let pressed = match self.spring {
                true => model.spring_nm_per_rad * (model.alpha_max_rad - alpha),
                false => 0.0,
            };
            // Moments of phi and alpha: along_A T_bi OA = along_B T_be OB, rho_i T_bi OA + rho_e T_be OB = U' - spring.
            let passes = axes.along[0] / axes.along[1];
            let load = p.t_static * p.oa * (p.rho_i + p.rho_e) - pressed;
            let inner_nm = model.count * load / (p.rho_i + p.rho_e * passes);
            acts = axes.races[0] * inner_nm - axes.races[1] * (passes * inner_nm);
        }
        Some(Some(GroupAtRest { state: (state, mode), acts }))
    }

    /// What is missed at `at`, N m and N.
    fn missed(&self, at: &Vector4<f64>) -> Option<Vector4<f64>> {
        let mut acts = Vector4::zeros();
        let mut stand = 0;
        for group in self.groups {
            if let Some(found) = self.stands(group, at)? {
                (acts, stand) = (acts + found.acts, stand + 1);
            }
        }
        let abutment = self.groups.first()?.model.loads.abutment_nm_per_rad;
        let outer = if abutment > 0.0 { acts[1] - abutment * at[1] } else { -at[1] };
        let pulls = self.axes.pulls_n([[at[2], at[3]], [0.0; 2]]);
        let axis: [f64; 2] = match self.axes.bearing {
            Some(_) => [acts[2] + pulls[0], acts[3] + pulls[1]],
            None => [-at[2], -at[3]],
        };
        (stand > 0).then(|| Vector4::new(acts[0] - self.torque_nm, outer, axis[0], axis[1]))
    }

    /// Newton's method by differences, its steps halved where they lead further off.
    fn balanced(&self) -> Option<Vector4<f64>> {
        let outer = match self.groups.first()?.model.loads.abutment_nm_per_rad {
            abutment if abutment > 0.0 => -self.torque_nm / abutment,
            _ => 0.0,
        };
        let ends = self.groups.iter().map(|g| g.model.curve.end_windup_rad() + g.lag_rad.unwrap_or(0.0));
        let most = 0.9 * ends.fold(f64::INFINITY, f64::min);
        let alone =
            |windup: f64| self.missed(&Vector4::new(windup, outer, 0.0, 0.0)).map_or(f64::NAN, |m| m[0]);
        let mut high = 1e-3 * most;
        while alone(high) < 0.0 && high < most {
            high = (2.0 * high).min(most);
        }
        let windup = root::bracketed(0.0, high, -self.torque_nm, alone(high), 1e-12, alone)?;
        let mut at = Vector4::new(windup, outer, 0.0, 0.0);
        let reach_m = |g: &SpragGroup| g.off_centre.as_ref().map_or(0.0, |off| off.turns.reach_m());
        let reach_m = self.groups.iter().map(reach_m).fold(0.0, f64::max);
        let steps = [1e-6, 1e-6, 1e-4 * reach_m, 1e-4 * reach_m];
        let push = self.torque_nm / self.groups.first()?.model.curve.touch().lengths.oa.v;
        let scale = Vector4::new(self.torque_nm, self.torque_nm, push, push);
        let size = |miss: &Vector4<f64>| miss.component_div(&scale).amax();
        let mut miss = self.missed(&at)?;
        for _ in 0..60 {
            if size(&miss) < 1e-13 {
                break;
            }
            let mut slopes = Matrix4::zeros();
            for i in 0..4 {
                let side = |sign: f64| {
                    let mut to = at;
                    to[i] += sign * steps[i];
                    self.missed(&to)
                };
                slopes.set_column(i, &((side(1.0)? - side(-1.0)?) / (2.0 * steps[i])));
            }
            let step = slopes.lu().solve(&miss)?;
            let mut part = 1.0;
            loop {
                let to = at - step * part;
                let there = self.missed(&to);
                match there {
                    Some(there) if size(&there) < size(&miss) => {
                        (at, miss) = (to, there);
                        break;
                    }
                    // Rounding lets it come no nearer.
                    _ if part < 1e-3 => return (size(&miss) < 1e-9).then_some(at),
                    _ => part *= 0.5,
                }
            }
        }
        (size(&miss) < 1e-9).then_some(at)
    }
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
