//! `evaluate`: the optimiser's evaluator for other programs, a vector per line in, margins per line out.

use super::exit::{Exit, Failure};
use super::interrupt::next;
use super::sweep::PointArgs;
use super::{Context, Run, Without, evaluate_points, output};
use crate::answer::search::{EvaluatedLine, describe_problem, evaluate_line};
use crate::design::{Design, Optimize};
use crate::optimise::{ClutchProblem, Corner, corners};
use crate::sweep::NoSample;
use clap::Args;
use std::io::BufRead;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, SyncSender, channel, sync_channel};

const EXAMPLES: &str = "\
Examples:
  echo '[3.6, 4.2, -0.2, 0.2]' | sprag-design evaluate designs/huang2017-multi-arc.toml
  sprag-design evaluate designs/huang2017-multi-arc.toml --describe
  sprag-design evaluate designs/huang2017-multi-arc.toml --vectors vectors.csv --csv margins.csv
  sprag-design evaluate designs/huang2017-multi-arc.toml --static --sobol 1e6 --part 3/8 --csv part-3.csv

Each line on standard input is a JSON array: the values of the variables of [optimize], in the file's order and units.
Each gets one line on standard output, in the order of the lines and as soon as it is known; several lines are evaluated
side by side, as --threads says, with the same answers for any number of threads. An answer: x; objectives (the least of them is what `optimize`
maximises); limits (each must be 0 or more); least, the least objective; violation, how far the worst limit, or the wanted slip
margin where that is an objective, is missed; feasible: nothing is.
Where x is out of bounds or there is no clutch at it: x and refused, the reason. A line that is no such array: malformed, and exit code 2 at
the end. --describe tells names, bounds and start first. Ctrl-C ends at once (exit code 130), and so does a reader that
goes away before the last answer (exit code 141, as of programs that a closed pipe ends).

With --vectors, --sobol or --grid the answer is a table instead, to standard output or --csv: a line for each point with its number,
variables, least objective, least margin of all limits and of the wanted slip margin and what has it (margin, deciding), feasible (1 or 0),
objectives, limits, and the reason where there is no clutch. The same bytes for any number of threads and, but for the first two lines of each file, for any
parts. A file that is there, whole and of the same question, is left as it is (--force: computed again); one that was cut is made anew.
Exit code 0 whatever is held. `map` draws it.";

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
    /// Without the scenes of the table `optimize`: static margins alone
    #[arg(long = "static")]
    pub at_rest: bool,
    /// As drawn and at every corner of `[tolerances]` at once, as `optimize --robust` is held: each row once for each of them
    #[arg(long)]
    pub robust: bool,
    /// Points to draw instead of lines to read.
    #[command(flatten)]
    pub points: PointArgs,
    /// Points from a table (CSV): a column for each variable, as `sample` writes it or anybody else
    #[arg(long, value_name = "PATH.csv", conflicts_with_all = ["sobol", "grid"], help_heading = "Points")]
    pub vectors: Option<PathBuf>,
    /// Columns of the table, the point's number first in any case: names, or variables, objectives, limits [default: all]
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', help_heading = "Points")]
    pub columns: Vec<String>,
}

impl Run for EvaluateArgs {
    const WITHOUT: Without = ("its answer is a JSON object for each line that it reads", &["json", "report"]);
    const NAMES: &[&str] = &["variables"];

    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        let of_points = self.vectors.is_some() || self.points.sampling().is_some();
        if !of_points {
            refuse_of_points_alone(self, context)?;
        }
        let design = context.design(&self.file)?;
        let Some(task) = design.optimize.as_ref() else {
            return Err(Failure::of(&self.file, NoSample::NoTask));
        };
        if of_points {
            if self.robust {
                return Err(Failure::malformed(
                    "--robust goes with lines of JSON: a table has one row for each limit",
                ));
            }
            if self.describe {
                return Err(Failure::malformed(
                    "--describe goes with lines of JSON; a table names its columns itself",
                ));
            }
            return evaluate_points::run(self, &design, context);
        }
        let problem = ClutchProblem::of_task(&design, task, self.full);
        let problem = if self.at_rest { problem.at_rest() } else { problem };
        let problem = if self.robust { at_every_corner(&problem, &design)? } else { problem };
        if self.describe {
            output::print_json(&describe_problem(&design, &problem))?;
        }
        // Lines in the order in which they came, each with the place where its answer will appear; as many as keep every thread
        // at work, no more of the input is read ahead.
        let (queue, places) = sync_channel(2 * rayon::current_num_threads());
        let asked = Arc::new((problem, task.clone()));
        std::thread::spawn(move || read_lines(&asked, &queue));
        let mut malformed = false;
        while let Some(place) = next(&places, &context.follow)? {
            let Some(reply) = next(&place, &context.follow)? else { break };
            let (value, is_malformed) = reply?;
            malformed |= is_malformed;
            if !output::heard(&output::json_line(&value)?)? {
                return Ok(Exit::Unheard);
            }
        }
        Ok(if malformed { Exit::Malformed } else { Exit::Held })
    }
}

/// `problem` as drawn and at every corner of the tolerances.
fn at_every_corner(problem: &ClutchProblem, design: &Design) -> Result<ClutchProblem, Failure> {
    let of = design.tolerances.ok_or_else(|| {
        Failure::malformed("--robust needs a [tolerances] table: what the clutch is made to")
    })?;
    Ok(problem.at_corners(std::iter::once(Corner::NOMINAL).chain(corners(&of)).collect()))
}

/// Refuse what means something of a table of points alone.
fn refuse_of_points_alone(args: &EvaluateArgs, context: &Context) -> Result<(), Failure> {
    if context.outputs.csv.is_some() {
        let why = "its answer is a JSON object for each line that it reads";
        return Err(Failure::malformed(format!(
            "--csv has no meaning with evaluate: {why}; with --vectors, --sobol or --grid it is a table"
        )));
    }
    if args.points.is_part() || !args.columns.is_empty() {
        return Err(Failure::malformed(
            "--part, --first, --count and --columns are of a table of points: --vectors, --sobol or --grid",
        ));
    }
    Ok(())
}

/// The answer to a line, and whether the line was no vector.
type Reply = Result<(EvaluatedLine, bool), Failure>;

/// Hands out the lines of standard input to the threads, until there are none or nobody wants the answers.
fn read_lines(asked: &Arc<(ClutchProblem, Optimize)>, queue: &SyncSender<Receiver<Reply>>) {
    for (at, text) in std::io::stdin().lock().split(b'\n').enumerate() {
        if text.as_ref().is_ok_and(|text| text.trim_ascii().is_empty()) {
            continue;
        }
        let (answer, place) = channel();
        if queue.send(place).is_err() {
            return;
        }
        let asked = Arc::clone(asked);
        // Where the answer is no longer wanted there is nobody to tell.
        rayon::spawn(move || {
            let text = text.map_err(|e| Failure::Failed(format!("standard input: {e}")));
            let _ = answer.send(text.map(|text| evaluate_line(&asked.0, &asked.1, at + 1, &text)));
        });
    }
}
