//! Limits on what one static state demands, held at nominal or at peak torque: one list for rows, capacities and courses.

use super::body::body_stress_pa;
use super::gap::YIELDS;
use super::hoop::HOOPS;
use super::load::LoadState;
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
    code.starts_with("hertz-nominal") || YIELDS.iter().any(|y| y.code == code && y.when == When::Nominal)
}

const MPA: (&str, f64) = ("MPa", 1e-6);

/// All that `limits` names, in the order of the rows.
pub(super) fn held<'a>(design: &'a Design, limits: &'a Limits, state: &'a LoadState) -> Vec<Held<'a>> {
    let mut list: Vec<Held<'a>> = Vec::new();
    let elastic = &state.curve.statics().elastic;
    let clutch = &design.clutch;
    let mut add = |code, name: &'static str, unit, when, allowed: (f64, bool), demand| {
        let (allowed, required) = allowed;
        list.push(Held { code, name: Box::new(|_| name.to_owned()), unit, when, allowed, required, demand });
    };
    let inner = || -> Box<dyn Fn(&StaticPoint) -> f64 + 'a> { Box::new(|p| p.hertz_inner_pa) };
    let outer = || -> Box<dyn Fn(&StaticPoint) -> f64 + 'a> { Box::new(|p| p.hertz_outer_pa) };
    if let Some(allowed) = limits.hertz_nominal_pa.map(|a| (a, true)) {
        let name = [
            "Hertz pressure, inner contact, nominal torque",
            "Hertz pressure, outer contact, nominal torque",
        ];
        add("hertz-nominal-inner", name[0], MPA, When::Nominal, allowed, inner());
        add("hertz-nominal-outer", name[1], MPA, When::Nominal, allowed, outer());
    }
    for y in &YIELDS {
        if let Some(allowed) = (y.allowed)(limits, design) {
            let count = clutch.sprags.count;
            let demand = Box::new(move |p: &StaticPoint| (y.demand)(elastic, count, p));
            add(y.code, y.name, y.unit, y.when, (allowed, true), demand);
        }
    }
    if let Some(allowed) = limits.hertz_peak_pa.map(|a| (a, true)) {
        let name =
            ["Hertz pressure, inner contact, peak torque", "Hertz pressure, outer contact, peak torque"];
        add("hertz-peak-inner", name[0], MPA, When::Peak, allowed, inner());
        add("hertz-peak-outer", name[1], MPA, When::Peak, allowed, outer());
    }
    for hoop in &HOOPS {
        if let Some(allowed) = (hoop.allowed)(limits) {
            let demand = Box::new(move |p: &StaticPoint| hoop.demand_pa(clutch, elastic, p));
            add(hoop.code, hoop.name, MPA, When::Peak, allowed, demand);
        }
    }
    if let Some(allowed) = limits.body_yield_pa {
        let name = "compression of the sprag's body half way between the contacts, peak torque";
        let demand = Box::new(move |p: &StaticPoint| body_stress_pa(design, state, p));
        add("body-yield", name, MPA, When::Peak, (allowed, true), demand);
    }
    for below in &SUBSURFACE {
        if let Some((allowed, from_m)) = (below.allowed)(limits) {
            let at = move |p: &StaticPoint| below.demand(design, from_m, p);
            list.push(Held {
                code: below.code,
                name: Box::new(move |p| format!("{}, {:.3} mm deep", below.name, at(p).1 * 1e3)),
                unit: MPA,
                when: When::Peak,
                allowed,
                required: true,
                demand: Box::new(move |p| at(p).0),
            });
        }
    }
    list
}
