//! Limits on what one static state demands, held at nominal or at peak torque: one list for rows, capacities and courses.

use super::body::body_stress_pa;
use super::gap::YIELDS;
use super::hoop::HOOPS;
use super::load::LoadState;
use super::sprag::{END_OF_PROFILE, NOMINAL_PRESSURE, OfSprag, PEAK_PRESSURE};
use super::subsurface::SUBSURFACE;
use crate::design::{Design, Limits};
use crate::wedge::StaticPoint;

/// Torque at which a limit is held.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum When {
    Nominal,
    Peak,
}

impl When {
    /// That torque, N m, where the limits name it.
    pub fn torque_nm(self, limits: &Limits) -> Option<f64> {
        match self {
            Self::Nominal => limits.nominal_torque_nm,
            Self::Peak => limits.peak_torque_nm,
        }
    }
}

/// One limit.
pub(super) struct Held<'a> {
    pub code: &'static str,
    /// Name for people, at a static state.
    pub name: Box<dyn Fn(&StaticPoint) -> String + 'a>,
    /// Unit as printed, and by what SI is multiplied for it.
    pub unit: (&'static str, f64),
    pub when: When,
    /// Allowable, SI.
    pub allowed: f64,
    /// Whether it counts for the verdict.
    pub required: bool,
    /// Demand of a static state, SI.
    pub demand: Box<dyn Fn(&StaticPoint) -> f64 + 'a>,
}

/// Whether the row `code` is held at nominal torque, those of the worst sprag off centre included.
pub fn at_nominal_torque(code: &str) -> bool {
    let code = code.trim_start_matches("run-out-");
    let of_sprag = |limit: &OfSprag| limit.code == code && limit.when == When::Nominal;
    NOMINAL_PRESSURE.iter().any(of_sprag) || YIELDS.iter().any(|y| y.code == code && y.when == When::Nominal)
}

const MPA: (&str, f64) = ("MPa", 1e-6);

/// All that `limits` names, the grip apart, in the order of the rows.
pub(super) fn held<'a>(design: &'a Design, limits: &'a Limits, state: &'a LoadState) -> Vec<Held<'a>> {
    let mut list: Vec<Held<'a>> = Vec::new();
    let elastic = &state.curve.statics().elastic;
    let clutch = &design.clutch;
    let of_sprag = |limit: &'static OfSprag| {
        let allowed = (limit.allowed)(design, limits)?;
        let demand = Box::new(move |p: &StaticPoint| (limit.demand)(design, limits, p));
        Some(one(limit.code, (limit.name)(limits), limit.unit, limit.when, (allowed, true), demand))
    };
    list.extend(NOMINAL_PRESSURE.iter().filter_map(of_sprag));
    for y in &YIELDS {
        if let Some(allowed) = (y.allowed)(limits, design) {
            let count = clutch.sprags.count;
            let demand = Box::new(move |p: &StaticPoint| (y.demand)(elastic, count, p));
            list.push(one(y.code, y.name, y.unit, y.when, (allowed, true), demand));
        }
    }
    list.extend(PEAK_PRESSURE.iter().filter_map(of_sprag));
    for hoop in &HOOPS {
        if let Some(allowed) = (hoop.allowed)(limits) {
            let demand = Box::new(move |p: &StaticPoint| hoop.demand_pa(clutch, elastic, p));
            let name = move |_: &StaticPoint| match allowed.1 {
                true => hoop.name.to_owned(),
                false => {
                    let own = hoop.code.replace('-', "_");
                    format!("{}, beside the limit on the mean; limits.{own}_mpa would be its own", hoop.name)
                }
            };
            let row = one(hoop.code, hoop.name, MPA, When::Peak, allowed, demand);
            list.push(Held { name: Box::new(name), ..row });
        }
    }
    if let Some(allowed) = limits.body_yield_pa {
        let name = "compression of the sprag's body half way between the contacts, peak torque";
        let demand = Box::new(move |p: &StaticPoint| body_stress_pa(design, state, p));
        list.push(one("body-yield", name, MPA, When::Peak, (allowed, true), demand));
    }
    for below in &SUBSURFACE {
        if let Some((allowed, from_m)) = (below.allowed)(limits) {
            let at = move |p: &StaticPoint| below.demand(design, from_m, p);
            let demand = Box::new(move |p: &StaticPoint| at(p).0);
            let name =
                Box::new(move |p: &StaticPoint| format!("{}, {:.3} mm deep", below.name, at(p).1 * 1e3));
            list.push(Held { name, ..one(below.code, below.name, MPA, When::Peak, (allowed, true), demand) });
        }
    }
    list.extend(of_sprag(&END_OF_PROFILE));
    list
}

/// A limit whose name does not depend on the state; `allowed` with whether it counts for the verdict.
fn one<'a>(
    code: &'static str,
    name: &'static str,
    unit: (&'static str, f64),
    when: When,
    (allowed, required): (f64, bool),
    demand: Box<dyn Fn(&StaticPoint) -> f64 + 'a>,
) -> Held<'a> {
    Held { code, name: Box::new(|_| name.to_owned()), unit, when, allowed, required, demand }
}
