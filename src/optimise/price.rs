//! What a limit or a bound costs at the optimum: multipliers as derivatives of the objective.

use super::goal::capacity_of;
use super::influence::Influence;
use super::outcome::Outcome;
use super::problem::{Assessment, ClutchProblem};
use super::settings::Settings;
use crate::file::variable_unit;
use crate::margin::{BeyondEnd, Demand, Margin, Rule, When, courses, load_state};

/// Torque step, relative, over which the slope of a demand is taken below the torque where its limit is reached.
const STEP: f64 = 1e-4;

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

/// Prices at the optimum of what holds it there, dearest first in what one percent of the value buys.
///
/// With dt = sum lambda_i dm_i + sum mu_j dc_j (t the least scaled objective): a margin c = allowable/demand - 1 grows by
/// dA/demand with its allowable A; a torque capacity m, at which the demand D(T) meets A, by dA/(dD/dT); a variable on its
/// bound gains by the Lagrangian's slope sum lambda m' + sum mu c' per range, divided by the range. Multipliers of margins
/// that are not active, and slopes below the tolerance of the climb, are what its subproblem leaves: no prices.
pub(super) fn prices(
    problem: &ClutchProblem,
    best: &Assessment,
    outcome: &Outcome,
    table: &Influence,
    (lo, hi): (&[f64], &[f64]),
    climb: &Settings,
) -> Vec<Price> {
    let span = problem.goals()[0].span;
    let rows = problem.limit_rows(&best.rows);
    let (lambda, mu) = (&outcome.objective_multipliers, &outcome.limit_multipliers);
    let mut found = capacity_prices(problem, best, outcome);
    for &j in &outcome.active.limits {
        let Some((row, mu)) = rows.get(j).zip(mu.get(j)) else { continue };
        let (kind, unit, per_unit, value) = match ratio_of(row) {
            Some(demand) => (PriceKind::Limit, row.limit.unit, 1.0 / demand, row.allowable_in_unit()),
            None => (PriceKind::Margin, "1", 1.0, 1.0),
        };
        let gain_per_unit = mu * per_unit * span;
        if gain_per_unit > 0.0 {
            found.push(Price { of: row.code(), kind, unit: unit.to_owned(), gain_per_unit, value });
        }
    }
    let known = climb.optimality_tolerance * outcome.evaluation.least_margin().abs().max(1.0);
    for (i, name) in problem.variables().iter().enumerate() {
        let slope = |weights: &[f64], rows: &[Vec<f64>]| -> f64 {
            weights.iter().zip(rows).map(|(w, row)| w * row[i]).sum()
        };
        let per_range = slope(lambda, &table.objectives) + slope(mu, &table.limits);
        let (kind, value) = match (outcome.x[i] == lo[i], outcome.x[i] == hi[i]) {
            (true, false) if per_range < -known => (PriceKind::Lower, lo[i]),
            (false, true) if per_range > known => (PriceKind::Upper, hi[i]),
            _ => continue,
        };
        found.push(Price {
            of: name.clone(),
            kind,
            unit: variable_unit(name).unwrap_or_default().to_owned(),
            gain_per_unit: per_range.abs() * span / (hi[i] - lo[i]),
            value,
        });
    }
    let weight = |p: &Price| p.gain_per_unit * p.value.abs();
    found.sort_by(|a, b| weight(b).total_cmp(&weight(a)));
    found
}

/// The demand, in the limit's unit, of a row whose margin is allowable/demand - 1.
fn ratio_of(row: &Margin) -> Option<f64> {
    let ratio = match (row.limit.rule, row.demand) {
        (Rule::Ratio | Rule::Onset | Rule::Slip, Demand::Value(_)) => !row.demands_nothing(),
        (Rule::Ratio, Demand::Overloaded { beyond: BeyondEnd::AsAtEnd { short, .. }, .. }) => {
            short.is_infinite() && !row.demands_nothing()
        }
        (Rule::Reserve, Demand::Value(demand)) => demand > 0.0,
        // 1 - demand/allowable is that too at the limit, to the square of the margin.
        (Rule::Share, Demand::Value(_)) => row.margin().abs() <= 1e-3,
        _ => false,
    };
    row.demand_in_unit().filter(|_| ratio)
}

/// Prices of the allowables that decide a torque capacity; none where no capacity is raised.
fn capacity_prices(problem: &ClutchProblem, best: &Assessment, outcome: &Outcome) -> Vec<Price> {
    let capacities = outcome.active.objectives.iter().filter_map(|&i| {
        let measure = best.measures.get(i)?;
        let row = best.rows.iter().find(|row| capacity_of(row) == measure.code)?;
        Some((row, row.torque_capacity_nm?, outcome.objective_multipliers.get(i)?))
    });
    let capacities: Vec<_> = capacities.filter(|(row, ..)| ratio_of(row).is_some()).collect();
    let Some((design, state)) = problem
        .design_at(&outcome.x)
        .ok()
        .filter(|_| !capacities.is_empty())
        .and_then(|design| load_state(&design).ok().map(|state| (design, state)))
    else {
        return Vec::new();
    };
    let limits = problem.limits();
    let price = |(row, torque_nm, lambda): (&Margin, f64, &f64)| {
        let points: Option<Vec<_>> =
            [2.0, 1.0].iter().map(|k| state.curve.at_torque(torque_nm * (1.0 - k * STEP))).collect();
        let course = courses(std::slice::from_ref(row), &design, limits, &state, &points?).pop()?;
        let [[t0, share0], [t1, share1]] = course.points[..] else { return None };
        // Of demand over allowable, 1/Nm.
        let slope = (share1 - share0) / (t1 - t0);
        // Capacities at nominal torque count by the peak torque in proportion.
        let in_proportion = match row.limit.when {
            When::Nominal => limits.peak_torque_nm.zip(limits.nominal_torque_nm).map_or(1.0, |(p, n)| p / n),
            _ => 1.0,
        };
        let allowable = row.allowable_in_unit();
        let gain_per_unit = lambda * in_proportion / (slope * allowable);
        (gain_per_unit.is_finite() && gain_per_unit > 0.0).then(|| Price {
            of: row.code(),
            kind: PriceKind::Limit,
            unit: row.limit.unit.to_owned(),
            gain_per_unit,
            value: allowable,
        })
    };
    capacities.into_iter().filter_map(price).collect()
}
