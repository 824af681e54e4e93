//! The worst of unlike sprags against the limits that hold for all, over a turn of the races. Sprags alike between races off centre are
//! unlike in their gaps, and press on one another by the rings: that the rows `run-out-*` leave out.

use super::limits::{Of, When};
use super::load::{LoadState, not_carried};
use super::row::{BeyondEnd, Demand, Margin};
use super::table::LIMITS;
use crate::clutch::Sharing;
use crate::design::{Design, Limits};
use crate::follow::Follow;
use crate::margin::Capacities;
use crate::numeric::root;
use crate::sharing::{Bears, Shared, Turn};
use std::cell::RefCell;

/// Resolution of a torque capacity, of the torque asked for.
const CAPACITY: f64 = 1e-5;

/// The sprags one by one over a turn of the races, as the table sharing has them, alike where the axes lie apart without one; `None` where
/// nothing sets them apart.
fn one_by_one<'a>(design: &Design, state: &'a LoadState) -> Option<Turn<'a>> {
    let clutch = &design.clutch;
    match &design.sharing {
        Some(sharing) => Some(Turn::new(clutch, sharing, &state.curve)),
        None => clutch.races.eccentricity.map(|_| Turn::new(clutch, &Sharing::default(), &state.curve)),
    }
}

/// A turn, and what it has found so far, by torque. Once `follow` is stopped it finds nothing more.
struct Found<'a> {
    turn: Turn<'a>,
    follow: &'a Follow,
    at: RefCell<Vec<(f64, Option<Vec<Shared>>)>>,
    ends: RefCell<Vec<(f64, Option<f64>)>>,
}

impl Found<'_> {
    /// What `of` says of the sprags at `torque_nm`; `None` where that is not carried.
    fn at<T>(&self, torque_nm: f64, of: impl Fn(&[Shared]) -> Option<T>) -> Option<T> {
        let known = self.at.borrow().iter().position(|(torque, _)| *torque == torque_nm);
        let k = known.unwrap_or_else(|| {
            let found = (!self.follow.stopped()).then(|| self.turn.at(torque_nm).ok()).flatten();
            self.at.borrow_mut().push((torque_nm, found));
            self.at.borrow().len() - 1
        });
        self.at.borrow()[k].1.as_deref().and_then(of)
    }

    /// Torque up to `beyond_nm` that is carried at every place; `None`: all of it.
    fn end(&self, beyond_nm: f64) -> Option<f64> {
        let known = self.ends.borrow().iter().find(|(beyond, _)| *beyond == beyond_nm).map(|found| found.1);
        known.unwrap_or_else(|| {
            if self.follow.stopped() {
                return None;
            }
            let end = self.turn.end(beyond_nm).map(|(held, _)| held);
            self.ends.borrow_mut().push((beyond_nm, end));
            end
        })
    }
}

/// Rows of the worst sprag where something sets the sprags apart; a torque beyond the end shows the demand there and continues
/// as the shortfall of torque.
pub fn unlike_margins(
    design: &Design,
    limits: &Limits,
    state: &LoadState,
    capacities: Capacities,
) -> Vec<Margin> {
    unlike_margins_until(design, limits, state, capacities, &Follow::nobody())
}

/// The same; stopped by `follow`, they mean nothing.
pub(super) fn unlike_margins_until(
    design: &Design,
    limits: &Limits,
    state: &LoadState,
    capacities: Capacities,
    follow: &Follow,
) -> Vec<Margin> {
    let Some(turn) = one_by_one(design, state) else { return Vec::new() };
    let turn = Found { turn, follow, at: RefCell::default(), ends: RefCell::default() };
    let sprags = &turn.turn.first().sprags;
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
        let at = |torque: f64| turn.at(torque, |turned| worst(limit.of, turned));
        let found = at(torque).or_else(|| {
            end_nm = turn.end(torque).unwrap_or(torque);
            at(end_nm)
        });
        let demand = match (found, end_nm < torque) {
            (Some((value, _)), false) => Demand::Value(value),
            (value, _) => Demand::Overloaded {
                at_end: value.map(|(value, _)| value),
                beyond: BeyondEnd::Short((end_nm / torque - 1.0).min(0.0)),
            },
        };
        let over = |torque: f64| at(torque).map_or(f64::NAN, |(value, _)| value - allowed);
        let who = found.map_or("none carries".to_owned(), |(_, i)| format!("sprag {}", i + 1));
        let alike = if design.sharing.is_none() { ", alike but for their gaps off centre" } else { "" };
        rows.push(Margin {
            name: format!("{}: {who}{alike}", limit.name()),
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
    turn: &Found,
    state: &LoadState,
    torque_nm: f64,
    end_nm: f64,
    over: &dyn Fn(f64) -> f64,
) -> Option<f64> {
    let (mut a, mut at_a) = (1e-6 * torque_nm, over(1e-6 * torque_nm));
    if at_a >= 0.0 {
        return Some(0.0);
    }
    // Steps of a quarter of the torque, up to the end of the curve: as many at once as make a quarter of what is carried already. Of
    // those the first that is not below 0 is looked for by halves.
    let step_nm = 0.25 * torque_nm;
    let mut most = if end_nm < torque_nm { end_nm } else { state.curve.end_torque_nm() };
    let on = |from: f64, steps: usize| {
        let mut b = from;
        for _ in 0..steps {
            let next = (b + step_nm).min(most);
            if next <= b {
                break;
            }
            b = next;
        }
        b
    };
    while a < most {
        let mut steps = ((a / torque_nm) as usize).max(1);
        let mut b = on(a, steps);
        if b <= a {
            return None;
        }
        let mut at_b = over(b);
        if at_b < 0.0 {
            (a, at_a) = (b, at_b);
            continue;
        }
        while steps > 1 {
            let half = steps / 2;
            let middle = on(a, half);
            let at = over(middle);
            if at < 0.0 {
                (a, at_a, steps) = (middle, at, steps - half);
            } else {
                (b, at_b, steps) = (middle, at, half);
            }
        }
        if at_b.is_nan() {
            // Unlike sprags end before the curve of sprags alike does.
            most = turn.end(b)?;
            b = most;
            at_b = over(b);
        }
        return if at_b >= 0.0 {
            root::bracketed(a, b, at_a, at_b, CAPACITY * torque_nm, over)
        } else {
            None
        };
    }
    None
}
