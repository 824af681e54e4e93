//! Margins as a search needs them: without a jump where the curve ends below the torque of a limit, and with a row for
//! what would otherwise be a wall.

use crate::design::{Design, Limits};
use crate::margin::{
    self, BeyondEnd, Capacities, Demand, END_OF_PROFILE, LIMITS, LoadRows, LoadState, Margin, When,
};
use crate::profile::Outline;

/// Half width that flanks keep beyond what the profile needs, and short of what its arcs reach, where they are variables: a choice. Races
/// under load move the end of the working profile, and the contact has a width.
pub(super) const ROOM: f64 = 0.02;
/// Step of torque, relative, by which the growth of the turn at the curve's end is measured.
const BACK: f64 = 1e-3;

/// Margins of the load state. Where the curve ends below a limit's torque, `check` counts every stress row as lost by the
/// torque that is short, so that all of them jump at once as the end passes the torque; here stresses stay as at the
/// end, and the end of the profile alone carries the shortfall, with the slope that it had before: the turn grows as
/// torque^p near the end, so its margin turn_end/turn - 1 goes on as (T_end/T)^p - 1.
pub(super) fn load_rows(
    design: &Design,
    limits: &Limits,
    capacities: Capacities,
    state: &LoadState,
) -> LoadRows {
    margin::load_rows_by(design, limits, capacities, state, |rows, state| {
        if state.curve.end_torque_nm() <= 0.0 {
            return;
        }
        for row in rows {
            let Demand::Overloaded { at_end, beyond } = row.demand else { continue };
            let BeyondEnd::Short(lacks) = beyond else { continue };
            let ends = row.limit == &END_OF_PROFILE;
            let short = limits.peak_torque_nm.filter(|_| ends).map(|torque| profile_short(state, torque));
            let beyond = BeyondEnd::AsAtEnd { short: short.unwrap_or(f64::INFINITY), lacks };
            row.demand = Demand::Overloaded { at_end, beyond };
        }
    })
}

/// Margin of the end of the profile at a torque beyond the curve's end, N m.
fn profile_short(state: &LoadState, torque: f64) -> f64 {
    let curve = &state.curve;
    let end = curve.end_torque_nm();
    let turn = |torque: f64| curve.at_torque(torque).map(|p| p.contact_turn_rad);
    let last = end * (1.0 - 1e-12);
    let grown = turn(last).zip(turn(last * (1.0 - BACK))).map(|(b, a)| (b / a).ln() / -(1.0 - BACK).ln());
    let power = grown.filter(|p| p.is_finite() && *p > 0.0).unwrap_or(1.0);
    let left = turn(last).map_or(0.0, |t| state.profile.end_turn_rad() / t - 1.0);
    // Where the sprag rolls over first some profile is left: then the shortfall begins there.
    left.max(0.0) + (end / torque).min(1.0).powf(power) - 1.0
}

/// Four rows: what each flank has left inside and outside, less what it is to `keep`: [`ROOM`] where flanks are variables. A flank that
/// passes an arc is no clutch: without these rows that is a wall, at which a climb stops.
pub(super) fn flank_rows(design: &Design, state: &LoadState, keep: f64) -> Vec<Margin> {
    let Some(flanks) = design.clutch.sprags.flanks else { return Vec::new() };
    let Ok(room) = Outline::room(&state.profile, &flanks) else { return Vec::new() };
    let rows = LIMITS.iter().filter(|limit| limit.when == When::Outline).zip(room.into_iter().flatten());
    rows.map(|(limit, left)| Margin::new(limit, Demand::Value(keep), left)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::margin::load_state;

    /// A clutch that carries its peak torque at rest and not at its speed is not feasible, by what the torque lacks there and more.
    #[test]
    fn limits_are_held_at_the_speed_of_the_clutch() {
        let mut design = Design::read("designs/huang2017-multi-arc.toml".as_ref()).unwrap();
        let rest = load_state(&design).unwrap();
        let speed = 1200.0;
        let end = rest.turning(&design, speed).unwrap().curve.end_torque_nm();
        let peak = 0.5 * (end + rest.curve.end_torque_nm());
        design.limits.peak_torque_nm = Some(peak);
        let ends = |limits: &Limits| {
            let rows = load_rows(&design, limits, Capacities::LeftOut, &rest).rows;
            rows.iter().find(|row| row.limit == &END_OF_PROFILE).unwrap().margin()
        };
        assert!(ends(&design.limits) > 0.0);
        let turning = Limits { at_speed_rad_s: Some(speed), ..design.limits };
        assert!(ends(&turning) < -1e-4 && ends(&turning) > -0.5, "{}", ends(&turning));
    }
}
