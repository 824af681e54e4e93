//! `optimize`: a better design, and how it was found.

use super::Context;
use super::exit::{Exit, Failure};
use super::journal::{self, Header, JournalFile};
use super::output::{TOOL, VERSION, write_whole};
use super::progress::Progress;
use super::{optimize_answer as answer, parts};
use crate::design::Design;
use crate::optimise::{Entry, Iteration, Journal, NoSearch, Search, Settings, Status, Watch, search};
use clap::Args;
use std::path::{Path, PathBuf};
use std::time::Instant;

const EXAMPLES: &str = "\
Examples:
  sprag-design optimize designs/huang2017-multi-arc.toml -o better.toml --report better.html
  sprag-design optimize designs/huang2017-multi-arc.toml -o better.toml --resume
  sprag-design optimize designs/huang2017-multi-arc.toml --json --quiet > best.json

The objective is the smallest slip margin mu_s/mu_req - 1 over the scenarios of [optimize]; every other margin of
`check` is a limit. Each evaluation goes into NEW.toml.journal at once: Ctrl-C stops the search and writes the best
design found so far, --resume goes on from the journal and ends where an uninterrupted search ends.";

/// Arguments of `optimize`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct OptimizeArgs {
    /// Design file (TOML) with an optimize table
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Where to write the better design file [default: FILE's name with -optimized, in this folder]
    #[arg(long, short, value_name = "NEW.toml")]
    pub output: Option<PathBuf>,
    /// Go on from the journal of an interrupted search; the result is the same as without the break
    #[arg(long)]
    pub resume: bool,
    /// Most evaluations of the clutch
    #[arg(long, value_name = "N", default_value_t = 500, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub evaluations: u32,
}

/// First line of every design file that this command writes.
const WRITTEN_BY: &str = "# Written by sprag-design optimize";

/// Run the command.
///
/// # Errors
/// [`Failure`].
pub fn run(args: &OptimizeArgs, context: &Context) -> Result<Exit, Failure> {
    let new = output_path(args)?;
    let record = journal::path_for(&new);
    context.outputs.check(&args.file, &[&new, &record])?;
    let design = parts::read_design(&args.file, context)?;
    let Some(task) = design.optimize.as_ref() else {
        return Err(Failure::malformed(format!(
            "{}: the design has no [optimize] table; add one with objective, scenarios and variables",
            args.file.display()
        )));
    };
    let header = Header {
        tool: format!("{TOOL} {VERSION}"),
        design_hash: design.hash.clone(),
        variables: task.variables.iter().map(|v| v.name.clone()).collect(),
    };
    let (known, file) = if args.resume {
        journal::resume(&record, &header)?
    } else {
        (Journal::default(), journal::begin(&record, &header)?)
    };
    let resumed = known.entries().len();
    context.message(&format!(
        "{} variables, {} scenarios, seed {} (this search draws nothing at random){}",
        task.variables.len(),
        task.scenarios.len(),
        task.seed,
        if resumed > 0 { format!("; {resumed} evaluations from the journal") } else { String::new() }
    ));
    let settings = Settings { max_evaluations: args.evaluations as usize, ..Settings::default() };
    let mut watch = Watcher { progress: context.progress("search", "evaluations", None), file, best: None };
    let started = Instant::now();
    let found = search(&design, &settings, known, Some(context.interrupt.flag()), Some(&mut watch));
    let run_time_s = started.elapsed().as_secs_f64();
    let Watcher { progress, file, .. } = watch;
    drop(progress);
    if let Some(why) = &file.failed {
        context.message(&format!("warning: {}: {why}; --resume will not work", file.path().display()));
    }
    let found = match found {
        Ok(found) => found,
        Err(NoSearch::Stopped) => return Err(Failure::Interrupted),
        Err(why) => return Err(Failure::malformed(format!("{}: {why}", args.file.display()))),
    };
    finish(&design, &found, &new, file, run_time_s, context)
}

/// Write the design and tell the story.
fn finish(
    design: &Design,
    found: &Search,
    new: &Path,
    file: JournalFile,
    run_time_s: f64,
    context: &Context,
) -> Result<Exit, Failure> {
    let interrupted = found.outcome.status == Status::Interrupted;
    let feasible = found.feasible();
    let improved = feasible && (found.objective.1 > found.objective.0 || !found.start_feasible());
    let written = (feasible && (improved || !interrupted)).then_some(new);
    if let Some(path) = written {
        write_whole(path, answer::file_text(design, found, WRITTEN_BY, context).as_bytes())?;
    }
    let answer = answer::Told { design, found, written, run_time_s, interrupted };
    context.outputs.write_csv(&answer.margin_table())?;
    context.outputs.write_report(|| answer.page(context))?;
    answer.json().print(context)?;
    context.answer(&answer.text(context))?;
    if !interrupted && file.failed.is_none() {
        // The search is over: nothing is left to resume.
        let _ = std::fs::remove_file(file.path());
    }
    Ok(if interrupted {
        Exit::Interrupted
    } else if feasible {
        Exit::Held
    } else {
        Exit::NotHeld
    })
}

/// `-o`, or a name of our own that never replaces somebody else's file.
fn output_path(args: &OptimizeArgs) -> Result<PathBuf, Failure> {
    if let Some(path) = &args.output {
        return Ok(path.clone());
    }
    let stem = args.file.file_stem().map_or_else(|| "design".into(), |s| s.to_string_lossy());
    let path = PathBuf::from(format!("{stem}-optimized.toml"));
    match std::fs::read_to_string(&path) {
        Ok(text) if !text.starts_with(WRITTEN_BY) => Err(Failure::malformed(format!(
            "{} exists and was not written by this command; name the new file with -o",
            path.display()
        ))),
        _ => Ok(path),
    }
}

/// Progress and journal.
struct Watcher {
    progress: Progress,
    file: JournalFile,
    best: Option<f64>,
}

impl Watch for Watcher {
    fn evaluated(&mut self, entry: &Entry) {
        self.file.line(entry);
        self.progress.advance(1);
    }

    fn iterated(&mut self, it: &Iteration) {
        if it.violation <= 1e-8 {
            self.best = Some(self.best.map_or(it.least_margin, |b| b.max(it.least_margin)));
        }
        let best = self.best.map_or("none yet".to_owned(), |b| format!("{b:.5}"));
        self.progress.describe(&format!(
            "least slip margin {:.5}, worst violation {:.1e}, best feasible {best}",
            it.least_margin, it.violation
        ));
    }
}
