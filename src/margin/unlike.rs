//! The worst of unlike sprags against the limits that hold for all, over a turn of the races.

use super::limits::{Of, When};
use super::load::{LoadState, not_carried};
use super::row::{Beyond, Demand, Margin};
use super::table::LIMITS;
use crate::design::{Design, Limits};
use crate::margin::Capacities;
use crate::numeric::root;
use crate::sharing::{Bears, Shared, Turn};

/// Resolution of a torque capacity, of the torque asked for.
const CAPACITY: f64 = 1e-5;

/// Rows of the worst sprag where the design says what sets its sprags apart; a torque beyond the end shows the demand there and continues
/// as the shortfall of torque.
pub fn unlike_margins(
    design: &Design,
    limits: &Limits,
    state: &LoadState,
    capacities: Capacities,
) -> Vec<Margin> {
    let Some(sharing) = &design.sharing else { return Vec::new() };
    let turn = Turn::new(&design.clutch, sharing, &state.curve);
    let sprags = &turn.first().sprags;
    // Friction in units of what the sprag has.
    let demanded = |of: Of, i: usize, load: &Bears| match of {
        Of::UnlikeFriction => load.required_friction() / sprags[i].friction,
        _ => load.hertz_pa(),
    };
    let worst = |of: Of, turned: &[Shared]| {
        let all = turned.iter().flat_map(|s| s.loads.iter().enumerate());
        all.map(|(i, l)| (demanded(of, i, l), i)).max_by(|a, b| a.0.total_cmp(&b.0))
    };
    let mut rows = Vec::new();
    for limit in LIMITS.iter().copied() {
        let allowed = match (limit.of, limit.when) {
            (Of::UnlikePressure, When::Nominal) => limits.hertz_nominal_pa,
            (Of::UnlikePressure, _) => limits.hertz_peak_pa,
            (Of::UnlikeFriction, _) => Some(1.0),
            _ => continue,
        };
        let (Some(allowed), Some(torque)) = (allowed, limit.when.torque_nm(limits)) else { continue };
        let mut end_nm = torque;
        let found = turn.at(torque).or_else(|_| {
            end_nm = turn.end(torque).map_or(torque, |(held, _)| held);
            turn.at(end_nm)
        });
        let found = found.ok().and_then(|turned| worst(limit.of, &turned));
        let demand = match (found, end_nm < torque) {
            (Some((value, _)), false) => Demand::Value(value),
            (value, _) => Demand::Overloaded {
                at_end: value.map(|(value, _)| value),
                beyond: Beyond::Short((end_nm / torque - 1.0).min(0.0)),
            },
        };
        let over = |torque: f64| {
            turn.at(torque)
                .ok()
                .and_then(|turned| worst(limit.of, &turned))
                .map_or(f64::NAN, |(value, _)| value - allowed)
        };
        let who = found.map_or("none carries".to_owned(), |(_, i)| format!("sprag {}", i + 1));
        rows.push(Margin {
            name: format!("{}: {who}", limit.name()),
            aside: not_carried(torque, end_nm),
            torque_capacity_nm: (capacities == Capacities::Wanted)
                .then(|| capacity(&turn, state, torque, end_nm, &over))
                .flatten(),
            ..Margin::new(limit, demand, allowed)
        });
    }
    rows
}

/// Torque at which `over` rises to 0, N m; `None`: not before the end.
fn capacity(
    turn: &Turn,
    state: &LoadState,
    torque_nm: f64,
    end_nm: f64,
    over: &dyn Fn(f64) -> f64,
) -> Option<f64> {
    let (mut a, mut at_a) = (1e-6 * torque_nm, over(1e-6 * torque_nm));
    if at_a >= 0.0 {
        return Some(0.0);
    }
    // Steps of a quarter of the torque, up to the end of the curve.
    let mut most = if end_nm < torque_nm { end_nm } else { state.curve.end_torque_nm() };
    let mut b = a;
    while b < most {
        b = (b + 0.25 * torque_nm).min(most);
        let mut at_b = over(b);
        if at_b.is_nan() {
            // Unlike sprags end before the curve of sprags alike does.
            most = turn.end(b)?.0;
            b = most;
            at_b = over(b);
        }
        if at_b.is_nan() {
            return None;
        }
        if at_b >= 0.0 {
            return root::bracketed(a, b, at_a, at_b, CAPACITY * torque_nm, over);
        }
        (a, at_a) = (b, at_b);
    }
    None
}
