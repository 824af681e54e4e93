//! Single evaluations of a problem as lines of JSON, for other optimisers.

use crate::answer::{TOOL, VERSION};
use crate::design::{Design, Optimize, OptimizeVariable};
use crate::optimise::{Assessment, ClutchProblem, Evaluate};
use serde::Serialize;

/// The answer to a line.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum EvaluatedLine {
    /// A vector with its rows.
    Evaluated {
        /// Whether every limit is held, the wanted slip margin among them.
        feasible: bool,
        /// The least objective.
        least: f64,
        /// Scaled limits, in the order that `--describe` names; 0 or more is held.
        limits: Vec<f64>,
        /// Scaled objectives, in that order.
        objectives: Vec<f64>,
        /// By how much the worst limit is missed, or the wanted slip margin where that is raised.
        violation: f64,
        /// The vector.
        x: Vec<f64>,
    },
    /// A vector at which there is no clutch, or outside its bounds.
    Refused {
        /// Why.
        refused: String,
        /// The vector.
        x: Vec<f64>,
    },
    /// No vector.
    Malformed {
        /// Which line, and why.
        malformed: String,
    },
}

/// A variable of a problem, in the unit of its name.
#[derive(Debug, Clone, Serialize)]
pub struct VariableBody<'a> {
    /// Upper bound.
    pub max: f64,
    /// Lower bound.
    pub min: f64,
    /// Name.
    pub name: &'a str,
    /// Where a search starts.
    pub start: f64,
    /// Whether it is a whole number.
    pub whole: bool,
}

/// What rows and columns of evaluations are.
#[derive(Debug, Clone, Serialize)]
pub struct ProblemBody<'a> {
    /// What is raised.
    pub aim: &'static str,
    /// Name of the design.
    pub design: &'a str,
    /// SHA-256 of the design's file.
    pub design_hash: &'a str,
    /// Names of the limits.
    pub limits: Option<Vec<String>>,
    /// Names of the objectives; null: there is no clutch at the start.
    pub objectives: Option<Vec<String>>,
    /// The program.
    pub tool: &'static str,
    /// The variables, in the order of a vector.
    pub variables: Vec<VariableBody<'a>>,
    /// Version of the program.
    pub version: &'static str,
}

/// The answer to line number `at`, and whether it was no vector.
pub fn evaluate_line(
    problem: &ClutchProblem,
    task: &Optimize,
    at: usize,
    text: &[u8],
) -> (EvaluatedLine, bool) {
    let count = problem.variables().len();
    let read: Result<Vec<f64>, String> = match std::str::from_utf8(text) {
        Ok(text) => serde_json::from_str(text).map_err(|e| e.to_string()),
        Err(e) => Err(format!("no UTF-8 text: {e}")),
    };
    match read
        .and_then(|x| if x.len() == count { Ok(x) } else { Err(format!("{} numbers, not {count}", x.len())) })
    {
        Ok(x) => match task.outside(&x) {
            Some(refused) => (EvaluatedLine::Refused { x, refused }, false),
            None => (answer(problem, x), false),
        },
        Err(why) => (EvaluatedLine::Malformed { malformed: format!("line {at}: {why}") }, true),
    }
}

/// One line of the answer.
fn answer(problem: &ClutchProblem, x: Vec<f64>) -> EvaluatedLine {
    match problem.evaluate(&x) {
        Ok(e) => {
            let (least, violation) = (e.least_margin(), problem.missed(&e));
            let feasible = violation <= crate::margin::RESOLUTION;
            let (objectives, limits) = (e.objectives, e.limits);
            EvaluatedLine::Evaluated { x, objectives, limits, least, violation, feasible }
        }
        Err(why) => EvaluatedLine::Refused { x, refused: why.to_string() },
    }
}

/// What the rows and columns are; `None` of a design without `[optimize]`.
pub fn describe_problem<'a>(design: &'a Design, problem: &ClutchProblem) -> Option<ProblemBody<'a>> {
    let task = design.optimize.as_ref()?;
    let start: Vec<f64> = task.variables.iter().map(|v| v.start).collect();
    let names = problem.assess_at(&start).map(|assessed: Assessment| problem.names(&assessed)).ok();
    let variable = |v: &'a OptimizeVariable| VariableBody {
        name: &v.name,
        min: v.min,
        max: v.max,
        start: v.start,
        whole: v.whole,
    };
    let (objectives, limits) = names.map(|n| (n.objectives, n.limits)).unzip();
    Some(ProblemBody {
        tool: TOOL,
        version: VERSION,
        design: &design.name,
        design_hash: &design.hash,
        aim: task.objective.name(),
        variables: task.variables.iter().map(variable).collect(),
        objectives,
        limits,
    })
}
