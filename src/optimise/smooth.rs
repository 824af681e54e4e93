//! Margins as a search needs them: without a jump where the curve ends below the torque of a limit, and with a row for
//! what would otherwise be a wall.

use crate::design::{Design, Limits};
use crate::margin::{LoadState, Margin, load_margins};
use crate::profile::Outline;

/// Half width that flanks keep beyond what the profile needs, and short of what its arcs reach: a choice. Races under
/// load move the end of the working profile, and the contact has a width.
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
    capacities: bool,
    state: &LoadState,
) -> Vec<Margin> {
    let mut rows = load_margins(design, limits, capacities, state);
    let curve = &state.curve;
    let end = curve.end_torque_nm();
    let short = |t: Option<f64>| t.is_some_and(|t| t > end);
    if !(short(limits.nominal_torque_nm) || short(limits.peak_torque_nm)) || end <= 0.0 {
        return rows;
    }
    let carried = |t: Option<f64>| t.map(|t| t.min(end * (1.0 - 1e-12)));
    let at_end = Limits {
        nominal_torque_nm: carried(limits.nominal_torque_nm),
        peak_torque_nm: carried(limits.peak_torque_nm),
        ..*limits
    };
    let turn = |torque: f64| curve.at_torque(torque).map(|p| p.contact_turn_rad);
    let last = end * (1.0 - 1e-12);
    let grown = turn(last).zip(turn(last * (1.0 - BACK))).map(|(b, a)| (b / a).ln() / -(1.0 - BACK).ln());
    let power = grown.filter(|p| p.is_finite() && *p > 0.0).unwrap_or(1.0);
    let stresses = load_margins(design, &at_end, false, state);
    for row in &mut rows {
        match row.code.as_str() {
            "end-of-profile" => {
                let left = turn(last).map_or(0.0, |t| state.profile.end_turn_rad() / t - 1.0);
                let torque = limits.peak_torque_nm.unwrap_or(end);
                // Where the sprag rolls over first some profile is left: then the shortfall begins there.
                row.margin = left.max(0.0) + (end / torque).min(1.0).powf(power) - 1.0;
            }
            "roll-over" => {
                let torque = limits.peak_torque_nm.unwrap_or(end);
                row.margin = curve.roll_over_torque_nm() / torque - 1.0;
            }
            code => {
                if let Some(there) = stresses.iter().find(|s| s.code == code) {
                    row.margin = there.margin;
                }
            }
        }
    }
    rows
}

/// Codes of the rows of [`flank_rows`], rear and front, inside and outside.
const ROOMS: [&str; 4] =
    ["flank-rear-inside", "flank-rear-outside", "flank-front-inside", "flank-front-outside"];

/// Whether `code` is a row of [`flank_rows`], whose margin is a difference, not a ratio.
pub(super) fn is_room(code: &str) -> bool {
    ROOMS.contains(&code)
}

/// Four rows: what each flank has left inside and outside, less [`ROOM`].
pub(super) fn flank_rows(design: &Design, state: &LoadState) -> Vec<Margin> {
    let Some(flanks) = design.clutch.sprags.flanks else { return Vec::new() };
    let Ok(room) = Outline::room(&state.profile, &flanks) else { return Vec::new() };
    let rows = ROOMS.into_iter().zip(room.into_iter().flatten());
    rows.map(|(code, left)| Margin {
        code: code.to_owned(),
        name: "half width left until the flank no longer closes the profile, over the half width".to_owned(),
        demand: ROOM,
        allowable: left,
        unit: "1",
        margin: left - ROOM,
        torque_capacity_nm: None,
        required: true,
        computed: true,
        overloaded: false,
    })
    .collect()
}
