//! `evaluate`: the optimiser's evaluator for other programs, a vector per line in, margins per line out.

use super::exit::{Exit, Failure};
use super::{Context, output, parts};
use crate::design::{Design, Optimize};
use crate::optimise::{ClutchProblem, Evaluate, Fidelity, Looked};
use clap::Args;
use serde_json::{Value, json};
use std::io::BufRead;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  echo '[3.6, 4.2, -0.2, 0.2]' | sprag-design evaluate designs/huang2017-multi-arc.toml
  sprag-design evaluate designs/huang2017-multi-arc.toml --describe

Each line on standard input is a JSON array: the values of the variables of [optimize], in the file's order and units.
Each gets one line on standard output, in order and at once: x; objectives (the least of them is what `optimize`
maximises); limits (each must be 0 or more); least, the least objective; violation, the largest -limit or 0; feasible.
Where x is out of bounds or there is no clutch at it: x and refused, the reason. A line that is no such array: malformed, and exit code 2 at
the end. --describe tells names, bounds and start first.";

/// Arguments of `evaluate`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct EvaluateArgs {
    /// Design file (TOML) with an optimize table
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Print one line about the problem before anything else: variables with bounds and start, names of the rows
    #[arg(long)]
    pub describe: bool,
    /// Leave nothing out that a scene cannot feel
    #[arg(long)]
    pub full: bool,
}

/// Run the command.
///
/// # Errors
/// [`Failure`].
pub fn run(args: &EvaluateArgs, context: &Context) -> Result<Exit, Failure> {
    let design = parts::read_design(&args.file, context)?;
    let Some(task) = design.optimize.as_ref() else {
        return Err(Failure::malformed(format!(
            "{}: the design has no [optimize] table; add one with objective, scenarios and variables",
            args.file.display()
        )));
    };
    let variables: Vec<String> = task.variables.iter().map(|v| v.name.clone()).collect();
    let fidelity = Fidelity { reduced: !args.full, ..Fidelity::default() };
    let problem = ClutchProblem::new(&design, task, variables, fidelity);
    if args.describe {
        line(&description(&design, &problem))?;
    }
    let mut malformed = false;
    for (at, text) in std::io::stdin().lock().split(b'\n').enumerate() {
        if context.interrupt.requested() {
            return Err(Failure::Interrupted);
        }
        let text = text.map_err(|e| Failure::Failed(format!("standard input: {e}")))?;
        if text.trim_ascii().is_empty() {
            continue;
        }
        let count = problem.variables().len();
        let read: Result<Vec<f64>, String> = match std::str::from_utf8(&text) {
            Ok(text) => serde_json::from_str(text).map_err(|e| e.to_string()),
            Err(e) => Err(format!("no UTF-8 text: {e}")),
        };
        match read.and_then(|x| {
            if x.len() == count { Ok(x) } else { Err(format!("{} numbers, not {count}", x.len())) }
        }) {
            Ok(x) => line(&match outside(task, &x) {
                Some(why) => json!({ "x": x, "refused": why }),
                None => answer(&problem, &x),
            })?,
            Err(why) => {
                malformed = true;
                line(&json!({ "malformed": format!("line {}: {why}", at + 1) }))?;
            }
        }
    }
    Ok(if malformed { Exit::Malformed } else { Exit::Held })
}

/// The first value beyond its bounds, in words.
fn outside(task: &Optimize, x: &[f64]) -> Option<String> {
    let (i, (v, x)) =
        task.variables.iter().zip(x).enumerate().find(|(_, (v, x))| !(v.min..=v.max).contains(x))?;
    Some(format!("x[{i}], {} = {x}, lies outside its bounds {} to {}", v.name, v.min, v.max))
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
fn description(design: &Design, problem: &ClutchProblem) -> Value {
    let Some(task) = design.optimize.as_ref() else { return Value::Null };
    let start: Vec<f64> = task.variables.iter().map(|v| v.start).collect();
    let names = problem.look_at(&start).map(|looked: Looked| problem.names(&looked)).ok();
    let variables: Vec<Value> = task
        .variables
        .iter()
        .map(|v| json!({ "name": v.name, "min": v.min, "max": v.max, "start": v.start, "whole": v.whole }))
        .collect();
    json!({
        "tool": output::TOOL, "version": output::VERSION, "design": design.name, "design_hash": design.hash,
        "aim": task.objective.name(), "variables": variables,
        "objectives": names.as_ref().map(|n| &n.objectives), "limits": names.as_ref().map(|n| &n.limits),
    })
}

fn line(value: &Value) -> Result<(), Failure> {
    output::print(&format!("{value}\n"))
}
