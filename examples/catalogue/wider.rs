//! What else might rate the sizes: limits that the maker does not print beside those that he does, each at the level that suits the
//! catalogue best, alone and two by two.

use sprag_design::design::{LIMIT_KEYS, Limits};
use sprag_design::margin::{Capacities, load_margins};
use sprag_design::report::{Column, Page, Table, Unit, significant};

use crate::size::{Size, power_law};
use crate::study::{Study, rms};

/// A rule with the levels that are tried.
struct Rule {
    name: &'static str,
    /// Its limit's key, in whose unit the levels are.
    key: &'static str,
    /// Codes of its rows.
    codes: &'static [&'static str],
    levels: [f64; 2],
    unit: Unit,
}

/// Depth at which shear in the core is looked at, mm.
const CASE_MM: f64 = 1.0;
/// Levels that are tried of each.
const STEPS: usize = 120;
/// Pairs that are shown.
const NEAREST: usize = 8;

const fn rule(
    name: &'static str,
    key: &'static str,
    codes: &'static [&'static str],
    levels: [f64; 2],
    unit: Unit,
) -> Rule {
    Rule { name, key, codes, levels, unit }
}

const RULES: [Rule; 9] = [
    rule(
        "pressure, the larger of both contacts",
        "hertz_nominal_mpa",
        &["hertz-nominal-inner", "hertz-nominal-outer"],
        [2500.0, 5500.0],
        Unit::Megapascal,
    ),
    rule(
        "pressure at the outer contact",
        "hertz_nominal_mpa",
        &["hertz-nominal-outer"],
        [1500.0, 3500.0],
        Unit::Megapascal,
    ),
    rule("race gap", "gap_nominal_mm", &["gap-nominal"], [8.36, 8.66], Unit::Millimetre),
    rule("windup", "windup_nominal_deg", &["windup-nominal"], [1.0, 4.5], Unit::Degree),
    rule(
        "equivalent stress of the outer race",
        "equivalent_outer_mpa",
        &["equivalent-outer"],
        [200.0, 900.0],
        Unit::Megapascal,
    ),
    rule(
        "mean hoop stress of the outer race",
        "hoop_outer_mpa",
        &["hoop-outer"],
        [100.0, 600.0],
        Unit::Megapascal,
    ),
    rule(
        "hoop stress of the outer race with its bending",
        "hoop_outer_bending_mpa",
        &["hoop-outer-bending"],
        [150.0, 1200.0],
        Unit::Megapascal,
    ),
    rule(
        "largest shear below a contact",
        "case_shear_mpa",
        &["subsurface-inner", "subsurface-outer"],
        [700.0, 1800.0],
        Unit::Megapascal,
    ),
    rule(
        "shear 1 mm below a contact",
        "core_shear_mpa",
        &["subsurface-core-inner", "subsurface-core-outer"],
        [80.0, 800.0],
        Unit::Megapascal,
    ),
];

impl Rule {
    fn level(&self, step: usize) -> f64 {
        let [least, most] = self.levels;
        least + (most - least) * step as f64 / STEPS as f64
    }

    /// Torque of `size` at which the rule is reached at `level`, over the catalogue's; where the curve ends before, its end.
    fn ratio(&self, size: &Size, level: f64) -> f64 {
        let torque_nm = Some(size.row.torque_nm);
        let mut limits =
            Limits { nominal_torque_nm: torque_nm, peak_torque_nm: torque_nm, ..Limits::default() };
        limits.case_depth_m = Some(1e-3 * CASE_MM);
        if let Some(key) = LIMIT_KEYS.iter().find(|k| k.name == self.key) {
            limits = key.with(&limits, level);
        }
        let rows = load_margins(&size.design, &limits, Capacities::Wanted, &size.state);
        let rows = rows.iter().filter(|r| self.codes.contains(&r.code().as_str()));
        rows.filter_map(|r| r.torque_capacity_nm).fold(size.state.curve.end_torque_nm(), f64::min)
            / size.row.torque_nm
    }
}

/// Ratios to the catalogue by level and size.
type Ratios = Vec<Vec<f64>>;

/// How far off ratios are in the mean.
fn off(ratios: impl Iterator<Item = f64>) -> f64 {
    rms(&ratios.map(|r| r - 1.0).collect::<Vec<_>>())
}

/// The two levels at which the smaller of both rules is nearest to the catalogue, and how far off that is.
fn best_pair(a: &Ratios, b: &Ratios) -> ([usize; 2], f64) {
    let mut best = ([0, 0], f64::INFINITY);
    for (i, one) in a.iter().enumerate() {
        for (j, other) in b.iter().enumerate() {
            let off = off(one.iter().zip(other).map(|(x, y)| x.min(*y)));
            if off < best.1 {
                best = ([i, j], off);
            }
        }
    }
    best
}

/// What each rule gives at its best level, and the pairs that are nearest, with the profile of the rules as printed.
pub(crate) fn wider(page: &mut Page, study: &Study) {
    let sizes = &study.printed.sizes;
    let of = |rule: &Rule| -> Ratios {
        (0..=STEPS).map(|k| sizes.iter().map(|s| rule.ratio(s, rule.level(k))).collect()).collect()
    };
    let all: Vec<Ratios> = RULES.iter().map(of).collect();
    let told =
        |rule: &Rule, step: usize| format!("{} {}", significant(rule.level(step), 3), rule.unit.symbol());
    page.heading("What else might rate them");
    page.paragraph(
        "Limits that the maker does not print beside those that he does, each at the level that suits the catalogue best, with the \
         profile of the rules as printed; where the curve ends before, its end counts. A hardness, a safety and ISO 76's permanent indentation of 1e-4 of the \
         diameter (4000 MPa) are one number for all sizes: the rule of pressure, or of shear, at another level.",
    );
    let mut table = Table::new(vec![
        Column::text("rule", "Rule alone"),
        Column::text("level", "Best level"),
        Column::number("exponent_d", "grows as d^", Unit::One, 3),
        Column::number("rms", "rms off the catalogue", Unit::Percent, 3),
    ]);
    for (rule, ratios) in RULES.iter().zip(&all) {
        let each = ratios.iter().map(|at| off(at.iter().copied())).enumerate();
        let Some((step, rms)) = each.min_by(|a, b| a.1.total_cmp(&b.1)) else { continue };
        let points: Vec<_> = sizes
            .iter()
            .zip(&ratios[step])
            .map(|(s, r)| (s.row.inner_mm, s.row.length_mm, r * s.row.torque_nm))
            .collect();
        table.row(vec![rule.name.into(), told(rule, step).into(), power_law(&points).0.into(), rms.into()]);
    }
    page.table("One rule for all sizes.", &table);
    let mut pairs = Vec::new();
    for second in 0..RULES.len() {
        for first in 0..second {
            let (steps, off) = best_pair(&all[first], &all[second]);
            pairs.push(([first, second], steps, off));
        }
    }
    pairs.sort_by(|a, b| a.2.total_cmp(&b.2));
    let mut two = Table::new(vec![
        Column::text("first", "One rule"),
        Column::text("second", "and another"),
        Column::number("rms", "rms off the catalogue", Unit::Percent, 3),
    ]);
    for (rules, steps, rms) in pairs.into_iter().take(NEAREST) {
        let [first, second] =
            [0, 1].map(|k| format!("{}, {}", RULES[rules[k]].name, told(&RULES[rules[k]], steps[k])));
        two.row(vec![first.into(), second.into(), rms.into()]);
    }
    page.table("The smaller of two rules: the nearest pairs.", &two);
}
