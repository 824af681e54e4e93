//! What yields as a whole: opening of the race gap, windup, equivalent stress of the races.

use super::held::When;
use crate::design::{Design, Limits};
use crate::wedge::{Elastic, StaticPoint};

/// One limit on a whole deformation or on the mean stress of a race.
pub(super) struct Yield {
    pub code: &'static str,
    pub name: &'static str,
    /// Unit as printed, and by what SI is multiplied for it.
    pub unit: (&'static str, f64),
    /// Torque at which it is held.
    pub when: When,
    /// Allowable, SI. That of a gap is its opening: the allowed gap less the gap at rest.
    pub allowed: fn(&Limits, &Design) -> Option<f64>,
    /// Demand, SI, of a clutch with that many sprags.
    pub demand: fn(&Elastic, usize, &StaticPoint) -> f64,
}

const MM: (&str, f64) = ("mm", 1e3);
const MPA: (&str, f64) = ("MPa", 1e-6);
const DEG: (&str, f64) = ("deg", 180.0 / std::f64::consts::PI);

fn opening(gap_m: Option<f64>, design: &Design) -> Option<f64> {
    let r = &design.clutch.races;
    gap_m.map(|gap| gap - (r.outer_radius_m - r.inner_radius_m))
}

const GAP: Yield = Yield {
    code: "gap-nominal",
    name: "opening of the race gap, nominal torque",
    unit: MM,
    when: When::Nominal,
    allowed: |l, d| opening(l.gap_nominal_m, d),
    demand: |e, _, p| e.gap_opening_m(p.normal_inner_n, p.normal_outer_n),
};

pub(super) const YIELDS: [Yield; 5] = [
    GAP,
    Yield {
        code: "windup-nominal",
        name: "windup, nominal torque",
        unit: DEG,
        when: When::Nominal,
        allowed: |l, _| l.windup_nominal_rad,
        demand: |_, _, p| p.windup_rad,
    },
    Yield {
        code: "equivalent-inner",
        name: "equivalent stress of the inner race, nominal torque",
        unit: MPA,
        when: When::Nominal,
        allowed: |l, _| l.equivalent_inner_pa,
        demand: |e, count, p| e.inner_race.equivalent_pa(count, p.normal_inner_n),
    },
    Yield {
        code: "equivalent-outer",
        name: "equivalent stress of the outer race, nominal torque",
        unit: MPA,
        when: When::Nominal,
        allowed: |l, _| l.equivalent_outer_pa,
        demand: |e, count, p| e.outer_race.equivalent_pa(count, p.normal_outer_n),
    },
    Yield {
        code: "gap-peak",
        name: "opening of the race gap, peak torque",
        when: When::Peak,
        allowed: |l, d| opening(l.gap_peak_m, d),
        ..GAP
    },
];
