//! Where a run of many sprags begins.

use super::axes::Axes;
use super::bending::{Bent, Rings, pressed};
use super::{ManyStart, SpragGroup, SpragMotion};
use crate::dynamics::model::{Grip, Mode, Place, State};
use crate::numeric::root;
use crate::wedge::WedgeCurve;
use nalgebra::{Matrix4, Vector4};
use std::cell::RefCell;

impl SpragMotion {
    /// In `mode`, touching.
    pub fn touching(mode: Mode) -> Self {
        Self { mode, waits: false, gone: false, phase: None }
    }

    /// Not touching yet.
    pub fn waiting() -> Self {
        let mode = Mode { place: Place::Open, inner: Grip::Stick, outer: Grip::Stick };
        Self { mode, waits: true, gone: false, phase: None }
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
/// `None` where it is not carried before one comes to its end. `rings`: where the races bend.
pub fn settled_together(
    groups: &[SpragGroup],
    rings: Option<&Rings>,
    torque_nm: f64,
    spring: bool,
) -> Option<ManyStart> {
    let bent = rings.map(|rings| RefCell::new(Bent::new(rings)));
    // Between races that bend a sprag may be pressed before its lag is over.
    let own = |group: &SpragGroup, windup: f64| -> Option<(f64, Place)> {
        let windup = windup - group.lag_rad.unwrap_or(0.0);
        match rings {
            Some(_) if windup < 0.0 => Some(before_touch(&group.model.curve, windup)),
            _ => (windup >= 0.0).then(|| alpha_at_windup(&group.model.curve, windup)).flatten(),
        }
    };
    // How much more each is pressed than on its own curve, N; `None`: it does not touch.
    let stand = |windup: f64| {
        let Some(bent) = &bent else { return };
        let mut bent = bent.borrow_mut();
        for (g, group) in groups.iter().enumerate() {
            let at = own(group, windup);
            bent.place(g, at.map_or(0.0, |at| at.0), at.and_then(|at| arc_of(at.1)), &group.model);
        }
        bent.solve();
    };
    let carried = |windup: f64| -> f64 {
        stand(windup);
        let one = |(g, group): (usize, &SpragGroup)| {
            let model = &group.model;
            let Some((alpha, place)) = own(group, windup) else { return 0.0 };
            let mut p = model.point(place, alpha);
            if let Some(bent) = &bent {
                let bent = bent.borrow();
                if bent.pressed_rad(g) < 0.0 {
                    return 0.0;
                }
                p = pressed(p, bent.more_n(g), 0.0);
            }
            let pressed = if spring { model.spring_nm_per_rad * (model.alpha_max_rad - alpha) } else { 0.0 };
            model.count * (p.t_static * p.oa - pressed / (p.rho_i + p.rho_e))
        };
        groups.iter().enumerate().map(one).sum()
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
    stand(windup);
    let each = |(g, group): (usize, &SpragGroup)| {
        let (alpha, place) = own(group, windup)?;
        let off = bent.as_ref().is_some_and(|bent| loaded && bent.borrow().pressed_rad(g) < 0.0);
        if off && group.lag_rad.is_some() {
            return None;
        }
        let place = if loaded && !off { place } else { Place::Open };
        let mut y = [0.0; super::N_STATE];
        (y[0], y[2], y[3]) = (alpha, outer - windup, outer);
        Some((y, Mode { place, inner: Grip::Stick, outer: Grip::Stick }))
    };
    ManyStart::of(&groups.iter().enumerate().map(each).collect::<Vec<_>>())
}

fn arc_of(place: Place) -> Option<usize> {
    match place {
        Place::Arc(k) => Some(k),
        _ => None,
    }
}

/// alpha, rad, of a sprag that lacks `windup_rad` < 0 to first contact, rolling.
fn before_touch(curve: &WedgeCurve, windup_rad: f64) -> (f64, Place) {
    let touch = curve.first_contact_rad();
    let p = curve.in_arc(0, touch);
    (touch + windup_rad / (p.rho_i + p.rho_e), Place::Arc(0))
}

/// The same where the axes do not meet or may give way, which they do with the load: each group at its own alpha of one windup since torque
/// began, its azimuth what it has rolled along by then.
pub fn settled_off_centre(
    groups: &[SpragGroup],
    axes: &Axes,
    rings: Option<&Rings>,
    torque_nm: f64,
    spring: bool,
) -> Option<ManyStart> {
    let bent = rings.map(|rings| RefCell::new(Bent::new(rings)));
    let rest = Rest { groups, axes, bent, torque_nm, spring };
    let mut at = if torque_nm > 0.0 { rest.balanced()? } else { Vector4::zeros() };
    if axes.bearing.is_none() {
        (at[2], at[3]) = (0.0, 0.0);
    }
    let states = rest.all_stand(&at)?;
    let mut start = ManyStart::of(&states)?;
    start.races = [at[1] - at[0], at[1], 0.0, 0.0];
    start.shift_m = [at[2], at[3]];
    Some(start)
}

/// Rest under a torque; what is sought is windup, theta_be (rad) and the shift of the axis (m).
struct Rest<'a> {
    groups: &'a [SpragGroup],
    axes: &'a Axes,
    /// Races that bend.
    bent: Option<RefCell<Bent<'a>>>,
    torque_nm: f64,
    spring: bool,
}

/// A group at rest; `None`: it does not touch yet.
type Stand = Option<(State, Mode)>;

impl Rest<'_> {
    /// All groups at `at`; `None`: one has come to its end.
    fn all_stand(&self, at: &Vector4<f64>) -> Option<Vec<Stand>> {
        let mut all: Vec<Stand> =
            self.groups.iter().map(|group| self.stands(group, at)).collect::<Option<_>>()?;
        let Some(bent) = &self.bent else { return Some(all) };
        let mut bent = bent.borrow_mut();
        for (g, (group, stand)) in self.groups.iter().zip(&all).enumerate() {
            let at = stand.map_or((0.0, None), |(state, mode)| (state[0], arc_of(mode.place)));
            bent.place(g, at.0, at.1, &group.model);
        }
        bent.solve();
        for (g, (group, stand)) in self.groups.iter().zip(&mut all).enumerate() {
            if let Some((_, mode)) = stand
                && bent.pressed_rad(g) < 0.0
            {
                mode.place = Place::Open;
                if group.lag_rad.is_some() {
                    *stand = None;
                }
            }
        }
        Some(all)
    }

    /// Group `group` at `at` by how the races have rolled it; `None`: it has come to its end, within: it does not touch yet.
    fn stands(&self, group: &SpragGroup, at: &Vector4<f64>) -> Option<Stand> {
        let off = group.off_centre.as_ref()?;
        let curve = &group.model.curve;
        let touch = curve.first_contact_rad();
        let seen = |k: usize, alpha: f64, axis_m: [f64; 2], phi: f64, race: f64| {
            off.turns.at(k, alpha, off.seen_m(axis_m, phi, race))
        };
        let begun = seen(0, touch, self.axes.offset_m(0.0, [0.0; 2]), 0.0, 0.0);
        let races = [at[1] - at[0], at[1]];
        let offset = self.axes.offset_m(0.0, races);
        let axis_m = [offset[0] + at[2], offset[1] + at[3]];
        let mut phi = at[1];
        let mut alpha = touch;
        // Its azimuth moves the axis by a hundredth of what it rolls.
        for _ in 0..40 {
            let left = |alpha: f64| {
                let [a, b] = seen(curve.arc_at(alpha), alpha, axis_m, phi, races[0]);
                let more = a.value + b.value - begun[0].value - begun[1].value;
                curve.windup_rad(alpha) + more + group.lag_rad.unwrap_or(0.0) - at[0]
            };
            let (low, high) = (left(touch), left(curve.end().1));
            if low > 0.0 && group.lag_rad.is_some() && self.bent.is_none() {
                return Some(None);
            }
            let found = if low >= 0.0 && self.bent.is_some() {
                before_touch(curve, -low).0
            } else if low >= 0.0 {
                touch
            } else {
                root::bracketed(touch, curve.end().1, low, high, 1e-17, left)?
            };
            let rolled = seen(curve.arc_at(found), found, axis_m, phi, races[0])[1].value - begun[1].value;
            let next = at[1] - curve.outer_roll_rad(found) - rolled;
            let done = (found - alpha).abs() <= 1e-15 && (next - phi).abs() <= 1e-15;
            (alpha, phi) = (found, next);
            if done {
                break;
            }
        }
        let loaded = alpha > touch || self.bent.is_some();
        let place = if loaded { Place::Arc(curve.arc_at(alpha)) } else { Place::Open };
        let mut state = [0.0; super::N_STATE];
        (state[0], state[1], state[2], state[3]) = (alpha, phi, races[0], races[1]);
        let mode = Mode { place, inner: Grip::Stick, outer: Grip::Stick };
        Some(Some((state, mode)))
    }

    /// What all of group `g` does to the races (N m) and the axis (N) where it stands.
    fn acts(&self, g: usize, at: &Vector4<f64>, (state, mode): &(State, Mode)) -> Option<Vector4<f64>> {
        let (group, races, alpha) = (&self.groups[g], [at[1] - at[0], at[1]], state[0]);
        let mut acts = Vector4::zeros();
        if mode.place != Place::Open {
            let mut y = [0.0; super::HEAD + super::EACH + super::axes::AXIS];
            (y[0], y[1]) = (races[0], races[1]);
            let tail = y.len() - super::axes::AXIS;
            (y[tail], y[tail + 1]) = (at[2], at[3]);
            let more_n = self.bent.as_ref().map(|bent| bent.borrow().more_n(g));
            let sight = group.sight(Some(self.axes), 1, mode.place, 0.0, &y, state, more_n);
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
        Some(acts)
    }

    /// What is missed at `at`, N m and N.
    fn missed(&self, at: &Vector4<f64>) -> Option<Vector4<f64>> {
        let mut acts = Vector4::zeros();
        let mut stand = 0;
        for (g, found) in self.all_stand(at)?.iter().enumerate() {
            if let Some(found) = found {
                (acts, stand) = (acts + self.acts(g, at, found)?, stand + 1);
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
