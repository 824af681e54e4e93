//! What a limit or a bound costs at the optimum: multipliers as derivatives of the objective.

use super::influence::Influence;
use super::outcome::Outcome;
use super::problem::{ClutchProblem, Looked};

/// Share of the largest price below which one is rounding of the interior point.
const NEGLIGIBLE: f64 = 1e-4;

/// Price of one limit or bound.
#[derive(Debug, Clone, PartialEq)]
pub struct Price {
    /// Margin code of the limit, or the variable whose bound it is.
    pub of: String,
    /// What holds.
    pub kind: PriceKind,
    /// Unit of the allowable or of the variable.
    pub unit: String,
    /// d(objective in its own unit, more being better)/d(allowable or bound, in `unit`), loosened; 0 or more.
    pub gain_per_unit: f64,
    /// The allowable or the bound.
    pub value: f64,
}

/// What a price is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PriceKind {
    /// A ratio of allowable and demand: its allowable raised.
    Limit,
    /// A margin that is no such ratio (clearance, contact, room): less of it asked for.
    Margin,
    /// A variable's lower bound: lowered.
    Lower,
    /// A variable's upper bound: raised.
    Upper,
}

/// Prices at the optimum, dearest first in what one percent of the value buys.
///
/// With dt = sum lambda_i dm_i + sum mu_j dc_j (t the least scaled objective): a margin c = allowable/demand - 1 grows by
/// dA/demand with its allowable A; a variable on its bound gains by the Lagrangian's slope sum lambda m' + sum mu c' per
/// range, divided by the range.
pub(super) fn prices(
    problem: &ClutchProblem,
    best: &Looked,
    outcome: &Outcome,
    table: &Influence,
    (lo, hi): (&[f64], &[f64]),
) -> Vec<Price> {
    let span = problem.goals()[0].span;
    let rows = problem.limit_rows(&best.rows);
    let (lambda, mu) = (&outcome.objective_multipliers, &outcome.limit_multipliers);
    let mut found = Vec::new();
    for (row, mu) in rows.iter().zip(mu) {
        let is_ratio =
            (row.allowable / row.demand - 1.0 - row.margin).abs() <= 1e-6 * (1.0 + row.margin.abs());
        let (kind, unit, per_unit, value) = match is_ratio {
            true => (PriceKind::Limit, row.unit, 1.0 / row.demand, row.allowable),
            false => (PriceKind::Margin, "1", 1.0, 1.0),
        };
        let gain_per_unit = mu * per_unit * span;
        if gain_per_unit > 0.0 {
            found.push(Price { of: row.code.clone(), kind, unit: unit.to_owned(), gain_per_unit, value });
        }
    }
    for (i, name) in problem.variables().iter().enumerate() {
        let slope = |weights: &[f64], rows: &[Vec<f64>]| -> f64 {
            weights.iter().zip(rows).map(|(w, row)| w * row[i]).sum()
        };
        let per_range = slope(lambda, &table.objectives) + slope(mu, &table.limits);
        let (kind, value) = match (outcome.x[i] == lo[i], outcome.x[i] == hi[i]) {
            (true, false) if per_range < 0.0 => (PriceKind::Lower, lo[i]),
            (false, true) if per_range > 0.0 => (PriceKind::Upper, hi[i]),
            _ => continue,
        };
        found.push(Price {
            of: name.clone(),
            kind,
            unit: unit_of(name).to_owned(),
            gain_per_unit: per_range.abs() * span / (hi[i] - lo[i]),
            value,
        });
    }
    let weight = |p: &Price| p.gain_per_unit * p.value.abs();
    let dearest = found.iter().map(weight).fold(0.0, f64::max);
    found.retain(|p| weight(p) > NEGLIGIBLE * dearest);
    found.sort_by(|a, b| weight(b).total_cmp(&weight(a)));
    found
}

/// Unit at the end of a variable's name.
fn unit_of(name: &str) -> &'static str {
    ["_mm", "_rad", "_mpa", "_nm"]
        .into_iter()
        .find(|u| name.ends_with(u))
        .map_or("", |u| u.trim_start_matches('_'))
}
