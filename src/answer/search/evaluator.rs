//! Single evaluations of a problem as lines of JSON, for other optimisers.

use crate::answer::{TOOL, VERSION};
use crate::design::{Design, Optimize};
use crate::optimise::{Assessment, ClutchProblem, Evaluate};
use serde_json::{Value, json};

/// The answer to line number `at`, and whether it was no vector.
pub fn evaluate_line(problem: &ClutchProblem, task: &Optimize, at: usize, text: &[u8]) -> (Value, bool) {
    let count = problem.variables().len();
    let read: Result<Vec<f64>, String> = match std::str::from_utf8(text) {
        Ok(text) => serde_json::from_str(text).map_err(|e| e.to_string()),
        Err(e) => Err(format!("no UTF-8 text: {e}")),
    };
    match read
        .and_then(|x| if x.len() == count { Ok(x) } else { Err(format!("{} numbers, not {count}", x.len())) })
    {
        Ok(x) => match task.outside(&x) {
            Some(why) => (json!({ "x": x, "refused": why }), false),
            None => (answer(problem, &x), false),
        },
        Err(why) => (json!({ "malformed": format!("line {at}: {why}") }), true),
    }
}

/// One line of the answer.
fn answer(problem: &ClutchProblem, x: &[f64]) -> Value {
    match problem.evaluate(x) {
        Ok(e) => {
            let violation = e.violation();
            json!({ "x": x, "objectives": e.objectives, "limits": e.limits, "least": e.least_margin(),
                    "violation": violation, "feasible": violation <= crate::margin::RESOLUTION })
        }
        Err(why) => json!({ "x": x, "refused": why.to_string() }),
    }
}

/// What the rows and columns are.
pub fn describe_problem(design: &Design, problem: &ClutchProblem) -> Value {
    let Some(task) = design.optimize.as_ref() else { return Value::Null };
    let start: Vec<f64> = task.variables.iter().map(|v| v.start).collect();
    let names = problem.assess_at(&start).map(|assessed: Assessment| problem.names(&assessed)).ok();
    let variables: Vec<Value> = task
        .variables
        .iter()
        .map(|v| json!({ "name": v.name, "min": v.min, "max": v.max, "start": v.start, "whole": v.whole }))
        .collect();
    json!({
        "tool": TOOL, "version": VERSION, "design": design.name, "design_hash": design.hash,
        "aim": task.objective.name(), "variables": variables,
        "objectives": names.as_ref().map(|n| &n.objectives), "limits": names.as_ref().map(|n| &n.limits),
    })
}
