//! The worst sprag against the limits that hold for all.

use super::{RunOut, SpragLoad, Survey};
use crate::design::{Design, Limits};
use crate::margin::load::{beyond, said};
use crate::margin::sprag::of_sprag;
use crate::margin::{Margin, ratio};
use crate::numeric::root;

/// Torques looked at between none and the end, for what is reached on the way: a choice.
const LOOKS: usize = 12;
/// Resolution of a torque capacity, of the end's torque.
const CAPACITY: f64 = 1e-5;

/// Rows of the worst sprag; a torque beyond the end shows its demand there and continues as the shortfall of torque.
/// `capacities` asks for the torques at which the limits would be reached.
pub fn run_out_margins(design: &Design, limits: &Limits, ring: &RunOut, capacities: bool) -> Vec<Margin> {
    let end = ring.end.torque_nm;
    let mut rows = Vec::new();
    let asked = limits.peak_torque_nm.or(limits.nominal_torque_nm);
    if let Some(torque) = asked {
        rows.push(end_row(ring, torque, end));
    }
    // A hair below the end, where every sprag still has its curve.
    let last = end * (1.0 - 1e-9);
    let surveys: Vec<Survey> =
        (1..=LOOKS).filter_map(|i| ring.survey(last * i as f64 / LOOKS as f64).ok()).collect();
    if let Some(torque) = limits.nominal_torque_nm.or(limits.peak_torque_nm)
        && let Ok(survey) = ring.survey(torque.min(last))
    {
        rows.extend(share_row(limits, ring, &survey));
    }
    rows.extend(re_engagement_row(design, ring));
    for limit in of_sprag() {
        let (Some(torque), Some(allowed)) = (limit.when.torque_nm(limits), (limit.allowed)(design, limits))
        else {
            continue;
        };
        let worst = |s: &Survey| s.worst(|p| (limit.demand)(design, limits, p));
        let mut found = ring.survey(torque.min(last)).ok().as_ref().and_then(worst);
        if let Some(way) = limit.on_the_way {
            let below = surveys.iter().filter(|s| s.torque_nm < torque).filter_map(|s| s.worst(way));
            found = below.chain(found).max_by(|a, b| a.0.total_cmp(&b.0));
        }
        let (value, where_) = match found {
            Some((value, sprag)) => (value, ring.words(&sprag)),
            None => (0.0, "no equilibrium of the sprags was found".to_owned()),
        };
        let name = format!("{}, worst sprag off centre: {where_}", (limit.name)(limits));
        let (unit, per_si) = limit.unit;
        // What is not reached before the end has none: `run-out-end` is that of all.
        let over = |s: &Survey| worst(s).map_or(f64::NAN, |(value, _)| value - allowed);
        let capacity = capacities.then(|| reached(ring, &surveys, &over)).flatten();
        rows.push(Margin {
            code: format!("run-out-{}", limit.code),
            name: said(&name, torque, end),
            demand: value * per_si,
            allowable: allowed * per_si,
            unit,
            margin: if found.is_some() { beyond(ratio(value, allowed), torque, end) } else { -1.0 },
            torque_capacity_nm: capacity,
            required: true,
            computed: true,
            overloaded: end < torque,
        });
    }
    rows
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

fn end_row(ring: &RunOut, torque: f64, end: f64) -> Margin {
    let stop = ring.end;
    let who = stop.seat.map_or("no sprag touches both races".to_owned(), |seat| {
        format!("the sprag {}, {}", degrees(ring.seats[seat].azimuth_rad), stop.reason.name())
    });
    Margin {
        code: "run-out-end".into(),
        name: format!("peak torque against that at which the first sprag off centre comes to its end: {who}"),
        demand: torque,
        allowable: end,
        unit: "Nm",
        margin: end / torque - 1.0,
        torque_capacity_nm: Some(end),
        required: true,
        computed: true,
        overloaded: false,
    }
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
    Some(Margin {
        code: "run-out-share".into(),
        name: format!(
            "largest normal force of a sprag over the mean, against that of the Hertz limit (p_0^2 ~ N): {}",
            ring.words(&sprag)
        ),
        demand: share,
        allowable,
        unit: "1",
        margin: allowable / share - 1.0,
        torque_capacity_nm: None,
        required: false,
        computed: true,
        overloaded: false,
    })
}

/// tan omega at first contact in the gap where it is largest.
fn re_engagement_row(design: &Design, ring: &RunOut) -> Option<Margin> {
    let kinetic = design.clutch.friction.kinetic;
    let touching = ring.seats.iter().filter_map(|s| Some((s.curve.as_ref().ok()?.touch().t_ratio, s)));
    let (first, seat) = touching.max_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(Margin {
        code: "run-out-re-engagement".into(),
        name: format!(
            "tan omega at first contact against mu_c, worst sprag off centre: {}",
            degrees(seat.azimuth_rad)
        ),
        demand: first,
        allowable: kinetic,
        unit: "1",
        margin: ratio(first, kinetic),
        torque_capacity_nm: None,
        required: true,
        computed: true,
        overloaded: false,
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
