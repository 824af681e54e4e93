//! The answer's keys for programs.

use super::Story;
use super::made::{MadeBody, RobustFound};
use super::realised::Flanked;
use super::relief::ReliefBody;
use super::steps::{Bound, Steps};
use super::words::{known, price_sentence};
use crate::margin::Margin;
use crate::optimise::{Branch, ClimbRecord, Front, Influence, Names, PriceKind, Search, Status, Variable};
use serde::Serialize;
use std::collections::BTreeMap;

/// Numbers by the names of variables or objectives.
pub(super) type Named = BTreeMap<String, f64>;

/// A design of the search.
#[derive(Debug, Clone, Serialize)]
pub struct Found {
    /// Values of the variables, in the units of their names.
    pub variables: Named,
    /// The objective, in its own unit; `None` of a least margin that some scene does not have.
    pub objective: Option<f64>,
    /// Margins of that design.
    pub margins: Vec<SearchRow>,
}

/// A margin of a design of the search.
#[derive(Debug, Clone, Serialize)]
pub struct SearchRow {
    /// Code for scripts.
    pub code: String,
    /// Name for people.
    pub name: String,
    /// Unit of demand and allowable.
    pub unit: &'static str,
    /// Allowable, in `unit`; of slip the wanted slip margin.
    pub allowable: Option<f64>,
    /// Margin as a number; 0 or more is held.
    pub margin: f64,
    /// Of slip rows static over required friction, less 1.
    pub slip_margin: Option<f64>,
    /// Demand, in `unit`, where it is a number.
    pub demand: Option<f64>,
}

/// What a margin gained or lost when it was looked at in full.
#[derive(Debug, Clone, Serialize)]
pub struct CodeChange {
    /// Code of the margin.
    pub code: String,
    /// In full less as searched.
    pub change: f64,
}

/// Influence of the variables.
#[derive(Debug, Clone, Serialize)]
pub struct Slopes {
    /// The variables, in the order of each row; absent where they are all continuous ones of the file.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub variables: Option<Vec<String>>,
    /// Codes of the objectives.
    pub objectives: Vec<String>,
    /// Codes of the limits.
    pub limits: Vec<String>,
    /// Change of each objective over the whole range of each variable.
    pub d_objectives_per_range: Vec<Vec<f64>>,
    /// The same of each limit.
    pub d_limits_per_range: Vec<Vec<f64>>,
}

/// A point of the front; without a front the optimum alone.
#[derive(Debug, Clone, Serialize)]
pub struct FrontBody {
    /// Values of the variables.
    pub variables: Named,
    /// Objectives of the front, each in its own unit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub objectives: Option<Named>,
    /// The objective, of an optimum that is no part of a front.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub objective: Option<f64>,
}

/// A climb.
#[derive(Debug, Clone, Serialize)]
pub struct Climb {
    /// Where it came from.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub from: Option<String>,
    /// The whole numbers that it was kept at.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub values: Option<Named>,
    /// How it ended, or why it did not begin.
    pub ended: String,
    /// Least scaled objective; null where it did not begin.
    pub least_scaled_objective: f64,
    /// Largest violation of a limit; null where it did not begin.
    pub violation: f64,
    /// Evaluations of the clutch.
    pub evaluations: usize,
    /// Derivatives of all margins along one variable beside them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub derivatives: Option<usize>,
}

/// Optima met, and how many are to be expected.
#[derive(Debug, Clone, Serialize)]
pub struct OptimaBody {
    /// Climbs that converged within the limits.
    pub climbs: usize,
    /// Different optima among their ends.
    pub seen: usize,
    /// How many there are in all, as far as that can be told.
    pub expected: Option<f64>,
}

/// What a limit or a bound costs at the optimum.
#[derive(Debug, Clone, Serialize)]
pub struct PriceBody {
    /// Code of the limit, or the variable.
    pub of: String,
    /// `limit`, `margin`, `lower-bound` or `upper-bound`.
    pub kind: &'static str,
    /// The allowable or the bound.
    pub value: f64,
    /// Its unit.
    pub unit: String,
    /// Gain of the objective per `unit`.
    pub gain_per_unit: f64,
    /// In words.
    pub sentence: String,
}

/// Keys of the answer.
#[derive(Debug, Clone, Serialize)]
pub struct SearchBody {
    /// How the best climb ended: `converged`, `infeasible`, `evaluation-limit`, `interrupted`, `stalled`.
    pub status: &'static str,
    /// What was made better.
    pub aim: &'static str,
    /// Whether every margin of the design found is held.
    pub feasible: bool,
    /// Whether it can be made: a search that is stopped may have a free centroid, for which there are no flanks yet.
    pub makeable: bool,
    /// Codes of the margins that are not.
    pub not_held: Vec<String>,
    /// The design found.
    pub best: Found,
    /// Values in the design file.
    pub in_file: Named,
    /// Where the search began.
    pub start: Found,
    /// How far the objective is off: its change when the optimum is looked at in full at a tenth of the tolerance.
    pub objective_error: f64,
    /// Evaluations of the clutch in all.
    pub evaluations: usize,
    /// Derivatives of all margins along one variable beside them, each at 0.3 to 1.1 times the cost.
    pub derivatives: usize,
    /// Evaluations of the best climb at which there was no clutch.
    pub failed_evaluations: usize,
    /// What holds the optimum where it is.
    pub active_constraints: Vec<String>,
    /// Limits that no design near holds together.
    pub fighting_limits: Vec<String>,
    /// Variables that move no margin.
    pub dropped_variables: Vec<String>,
    /// Change of each margin over the whole range of each variable, at the start.
    pub influence: Slopes,
    /// The same at the optimum.
    pub sensitivities: Option<Slopes>,
    /// Points of the front, or the optimum as the only one.
    pub pareto: Vec<FrontBody>,
    /// Seed of everything random.
    pub seed: u64,
    /// Climbs.
    pub starts: Vec<Climb>,
    /// Optima that they met, and how many are to be expected.
    pub optima: OptimaBody,
    /// Whole numbers that were tried.
    pub whole_numbers: Vec<Climb>,
    /// What each active limit and bound costs.
    pub prices: Vec<PriceBody>,
    /// What margins gained or lost when they were looked at in full.
    pub change_in_full: Vec<CodeChange>,
    /// What would free an infeasible problem.
    pub relief: Option<ReliefBody>,
    /// Flanks for a free centroid.
    pub realised: Option<Flanked>,
    /// What the search came to with its centroid free and its mass given: a bound, no flanks were asked for.
    pub free_centroid: Option<Bound>,
    /// The answer before its lengths were put in steps: a bound.
    pub unrounded: Option<Bound>,
    /// Its lengths in steps.
    pub steps: Option<Steps>,
    /// What every limit keeps of its margin.
    pub reserve: f64,
    /// The optimum as it may be made.
    pub tolerances: Option<MadeBody>,
    /// The design that holds at every corner of the tolerances.
    pub robust: Option<RobustFound>,
    /// What was asked and could not be done.
    pub not_done: Vec<String>,
}

impl SearchBody {
    pub(super) fn of(story: &Story) -> Self {
        let (found, made) = (&story.found, story.made());
        let (before, after) = story.objective();
        let fighting = match story.status() {
            Status::Infeasible { fighting, .. } => fighting.as_slice(),
            _ => &[],
        };
        let changes = story.margins().iter().zip(story.as_searched());
        Self {
            status: story.status().name(),
            aim: found.aim.name(),
            feasible: story.feasible(),
            makeable: story.makeable(),
            not_held: story.not_held(),
            best: Found {
                variables: best(story),
                objective: known(found.aim, after),
                margins: rows(story.margins()),
            },
            in_file: values(found, |v| v.given),
            start: Found {
                variables: values(found, |v| v.start),
                objective: known(found.aim, before),
                margins: rows(&found.start),
            },
            objective_error: story.objective_error(),
            evaluations: story.evaluations(),
            derivatives: story.derivatives(),
            failed_evaluations: found.outcome.failures,
            active_constraints: story.active(),
            fighting_limits: fighting
                .iter()
                .filter_map(|&i| story.last().names.limits.get(i).cloned())
                .collect(),
            dropped_variables: found.variables.iter().filter(|v| v.dropped).map(|v| v.name.clone()).collect(),
            influence: Slopes::of(None, &found.names, &found.influence),
            sensitivities: made
                .sensitivity
                .as_ref()
                .map(|s| Slopes::of(Some(made.searched.clone()), &made.names, s)),
            pareto: pareto(story),
            seed: story.seed,
            starts: found.starts.iter().map(Climb::start).collect(),
            optima: OptimaBody {
                climbs: found.optima.climbs,
                seen: found.optima.seen,
                expected: found.optima.expected(),
            },
            whole_numbers: found
                .branches
                .iter()
                .filter(|b| !b.values.is_empty())
                .map(Climb::branch)
                .collect(),
            prices: made.prices.iter().map(|p| PriceBody::of(made, p)).collect(),
            change_in_full: changes
                .map(|(full, searched)| CodeChange {
                    code: full.code(),
                    change: full.margin() - searched.margin(),
                })
                .collect(),
            relief: story.relief.as_ref().map(|r| ReliefBody::of(story, r)),
            realised: story.realised.as_ref().map(Flanked::of),
            free_centroid: story.realised.as_ref().map(|_| Bound::of(found)),
            unrounded: story.on_grid().map(|_| Bound::of(made)),
            steps: story.stepped.as_ref().map(Steps::of),
            reserve: found.problem.reserve(),
            tolerances: story.within.as_ref().map(MadeBody::of),
            robust: story.robust.as_ref().map(|r| RobustFound::of(story, r)),
            not_done: story.why.clone(),
        }
    }
}

pub(super) fn values(found: &Search, pick: fn(&Variable) -> f64) -> Named {
    found.variables.iter().map(|v| (v.name.clone(), pick(v))).collect()
}

/// The answer's variables.
fn best(story: &Story) -> Named {
    story.made().variables.iter().map(|v| (v.name.clone(), story.value(v))).collect()
}

fn rows(list: &[Margin]) -> Vec<SearchRow> {
    list.iter().map(SearchRow::of).collect()
}

fn ended(how: &Result<Status, String>) -> String {
    how.as_ref().map_or_else(Clone::clone, |status| status.name().to_owned())
}

/// The front, or the optimum as the only point of one.
fn pareto(story: &Story) -> Vec<FrontBody> {
    let point = |front: &Front, x: &[f64], values: &[f64]| FrontBody {
        variables: front.variables.iter().cloned().zip(x.iter().copied()).collect(),
        objectives: Some(
            front.aims.iter().map(|a| a.name().to_owned()).zip(values.iter().copied()).collect(),
        ),
        objective: None,
    };
    match &story.front {
        Some(front) => front.points.iter().map(|p| point(front, &p.x, &p.values)).collect(),
        None => {
            vec![FrontBody {
                variables: best(story),
                objectives: None,
                objective: known(story.found.aim, story.objective().1),
            }]
        }
    }
}

impl SearchRow {
    fn of(m: &Margin) -> Self {
        Self {
            code: m.code(),
            name: m.full_name(),
            unit: m.limit.unit,
            allowable: m.shown_allowable(),
            margin: m.margin(),
            slip_margin: m.slip_margin(),
            demand: m.demand_in_unit(),
        }
    }
}

impl Slopes {
    fn of(variables: Option<Vec<String>>, names: &Names, table: &Influence) -> Self {
        Self {
            variables,
            objectives: names.objectives.clone(),
            limits: names.limits.clone(),
            d_objectives_per_range: table.objectives.clone(),
            d_limits_per_range: table.limits.clone(),
        }
    }
}

impl Climb {
    fn start(s: &ClimbRecord) -> Self {
        Self {
            from: Some(s.from.clone()),
            values: None,
            ended: ended(&s.ended),
            least_scaled_objective: s.least_margin,
            violation: s.violation,
            evaluations: s.evaluations,
            derivatives: Some(s.derivatives),
        }
    }

    fn branch(b: &Branch) -> Self {
        Self {
            from: None,
            values: Some(b.values.iter().cloned().collect()),
            ended: ended(&b.ended),
            least_scaled_objective: b.least_margin,
            violation: b.violation,
            evaluations: b.evaluations,
            derivatives: None,
        }
    }
}

impl PriceBody {
    fn of(found: &Search, p: &crate::optimise::Price) -> Self {
        let kind = match p.kind {
            PriceKind::Limit => "limit",
            PriceKind::Margin => "margin",
            PriceKind::Lower => "lower-bound",
            PriceKind::Upper => "upper-bound",
        };
        Self {
            of: p.of.clone(),
            kind,
            value: p.value,
            unit: p.unit.clone(),
            gain_per_unit: p.gain_per_unit,
            sentence: price_sentence(found.aim, p),
        }
    }
}
