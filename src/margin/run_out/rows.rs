//! The worst sprag against the limits that hold for all.

use super::{RunOut, SpragLoad, Survey};
use crate::design::{Design, Limits};
use crate::follow::Follow;
use crate::margin::Capacities;
use crate::margin::limits::{Limit, Of};
use crate::margin::load::{beyond, not_carried};
use crate::margin::table::{END_OF_PROFILE, LIMITS};
use crate::margin::{BeyondEnd, Demand, Margin};
use crate::numeric::root;

/// Torques looked at between none and the end, for what is reached on the way: a choice.
const LOOKS: usize = 12;
/// Resolution of a torque capacity, of the end's torque.
const CAPACITY: f64 = 1e-5;

/// Rows of the worst sprag; a torque beyond the end shows its demand there and continues as the shortfall of torque.
pub fn run_out_margins(
    design: &Design,
    limits: &Limits,
    ring: &RunOut,
    capacities: Capacities,
) -> Vec<Margin> {
    run_out_margins_until(design, limits, ring, capacities, &Follow::nobody())
}

/// The same; stopped by `follow`, they mean nothing.
pub(in crate::margin) fn run_out_margins_until(
    design: &Design,
    limits: &Limits,
    ring: &RunOut,
    capacities: Capacities,
    follow: &Follow,
) -> Vec<Margin> {
    let end = ring.end.torque_nm;
    let mut rows = Vec::new();
    let asked = limits.largest_torque_nm();
    if let Some(torque) = asked {
        rows.extend(end_row(ring, torque, end));
    }
    // A hair below the end, where every sprag still has its curve.
    let last = end * (1.0 - 1e-9);
    let looks = (1..=LOOKS).take_while(|_| !follow.stopped());
    let surveys: Vec<Survey> =
        looks.filter_map(|i| ring.survey(last * i as f64 / LOOKS as f64).ok()).collect();
    if let Some(torque) = limits.usual_torque_nm()
        && let Ok(survey) = ring.survey(torque.min(last))
    {
        rows.extend(share_row(limits, ring, &survey));
    }
    rows.extend(re_engagement_row(design, ring));
    // The end of the profile last.
    let (end_of_profile, others): (Vec<&'static Limit>, Vec<_>) =
        LIMITS.iter().partition(|limit| *limit == &&END_OF_PROFILE);
    for limit in others.into_iter().chain(end_of_profile) {
        if follow.stopped() {
            break;
        }
        let Of::Sprag { allowed, demand, below_torque } = limit.of else { continue };
        let (Some(torque), Some(allowed)) = (limit.when.torque_nm(limits), allowed(design, limits)) else {
            continue;
        };
        let worst = |s: &Survey| s.worst(|p| demand(design, limits, p));
        let mut found = ring.survey(torque.min(last)).ok().as_ref().and_then(worst);
        if let Some(demand_below) = below_torque {
            let below = surveys.iter().filter(|s| s.torque_nm < torque).filter_map(|s| s.worst(demand_below));
            found = below.chain(found).max_by(|a, b| a.0.total_cmp(&b.0));
        }
        let (demand, where_) = match found {
            Some((value, sprag)) => (beyond(value, torque, end), ring.words(&sprag)),
            None => (nothing_found(torque, end), "no equilibrium of the sprags was found".to_owned()),
        };
        let name = format!("{}, worst sprag off centre: {where_}", (limit.name)(limits));
        // What is not reached before the end has none: `run-out-end` is that of all.
        let over = |s: &Survey| worst(s).map_or(f64::NAN, |(value, _)| value - allowed);
        let capacity = (capacities == Capacities::Wanted).then(|| reached(ring, &surveys, &over)).flatten();
        rows.push(Margin {
            off_centre: true,
            name,
            aside: not_carried(torque, end),
            torque_capacity_nm: capacity,
            ..Margin::new(limit, demand, allowed)
        });
    }
    rows
}

/// What stands for a demand where no equilibrium of the sprags was found.
fn nothing_found(torque: f64, end: f64) -> Demand {
    match end >= torque {
        true => Demand::MoreThan(0.0),
        false => Demand::Overloaded { at_end: Some(0.0), beyond: BeyondEnd::Lost },
    }
}

/// Torque at which `over` first rises to 0, N m; `None`: not before the end.
fn reached(ring: &RunOut, surveys: &[Survey], over: &dyn Fn(&Survey) -> f64) -> Option<f64> {
    let end = surveys.last()?.torque_nm;
    if over(surveys.first()?) >= 0.0 {
        return Some(0.0);
    }
    let pair = surveys.windows(2).find(|w| over(&w[0]) < 0.0 && over(&w[1]) >= 0.0)?;
    let [a, b] = [&pair[0], &pair[1]];
    let at = |torque: f64| ring.survey(torque).map_or(f64::NAN, |s| over(&s));
    root::bracketed(a.torque_nm, b.torque_nm, over(a), over(b), CAPACITY * end, at).or(Some(a.torque_nm))
}

/// The limit that is computed as `of`.
fn of(of: fn(&Of) -> bool) -> Option<&'static Limit> {
    LIMITS.iter().copied().find(|limit| of(&limit.of))
}

fn end_row(ring: &RunOut, torque: f64, end: f64) -> Option<Margin> {
    let limit = of(|of| matches!(of, Of::RunOutEnd))?;
    let stop = ring.end;
    let who = stop.seat.map_or("no sprag touches both races".to_owned(), |seat| {
        format!("the sprag {}, {}", degrees(ring.seats[seat].azimuth_rad), stop.reason.name())
    });
    Some(Margin {
        name: format!("{}: {who}", limit.name()),
        torque_capacity_nm: Some(end),
        ..Margin::new(limit, Demand::Value(torque), end)
    })
}

/// Shown only: the pressures that follow are the limits.
fn share_row(limits: &Limits, ring: &RunOut, survey: &Survey) -> Option<Margin> {
    let (share, sprag) = survey.worst_round().share();
    let allowed_pa = match limits.nominal_torque_nm {
        Some(_) => limits.hertz_nominal_pa,
        None => limits.hertz_peak_pa,
    }?;
    // Force at which that sprag's pressure meets its limit: p_0^2 ~ N, but for the curvature, which changes slowly.
    let curve = ring.seats[sprag.seat].curve.as_ref().ok()?;
    let p = curve.at_normal(sprag.normal_n.min(curve.arc_end_n(curve.arc_count() - 1)))?;
    let most_pa = p.hertz_inner_pa.max(p.hertz_outer_pa);
    let allowable = share * (allowed_pa / most_pa).powi(2);
    let limit = of(|of| matches!(of, Of::RunOutShare))?;
    Some(Margin {
        name: format!("{}: {}", limit.name(), ring.words(&sprag)),
        required: false,
        ..Margin::new(limit, Demand::Value(share), allowable)
    })
}

/// tan omega at first contact in the gap where it is largest.
fn re_engagement_row(design: &Design, ring: &RunOut) -> Option<Margin> {
    let kinetic = design.clutch.friction.kinetic;
    let touching = ring.seats.iter().filter_map(|s| Some((s.curve.as_ref().ok()?.touch().t_ratio, s)));
    let (first, seat) = touching.max_by(|a, b| a.0.total_cmp(&b.0))?;
    let limit = of(|of| matches!(of, Of::ReEngagement))?;
    Some(Margin {
        off_centre: true,
        name: format!("{}, worst sprag off centre: {}", limit.name(), degrees(seat.azimuth_rad)),
        ..Margin::new(limit, Demand::Value(first), kinetic)
    })
}

fn degrees(azimuth_rad: f64) -> String {
    format!("{:.0} deg from the widest gap", azimuth_rad.to_degrees())
}

impl RunOut {
    /// Where a sprag stands, and where it engaged if it was brought on since.
    pub fn words(&self, sprag: &SpragLoad) -> String {
        let stands = degrees(self.seats[sprag.seat].azimuth_rad);
        match sprag.engaged == sprag.seat {
            true => stands,
            false => {
                format!("{stands}, engaged at {:.0} deg", self.seats[sprag.engaged].azimuth_rad.to_degrees())
            }
        }
    }
}
