//! `compare`: several designs side by side.

use super::exit::{Exit, Failure};
use super::{Context, parts};
use crate::answer::comparison::{Comparison, NoComparison, subjects};
use crate::design::Design;
use clap::Args;
use std::path::{Path, PathBuf};
use std::time::Instant;

const EXAMPLES: &str = "\
Examples:
  sprag-design compare before.toml after.toml
  sprag-design compare before.toml after.toml --report compare.html
  sprag-design compare a.toml b.toml c.toml --csv - | column -s, -t

The first design is the one before: dashed in every drawing and curve. Exit code 0 whatever is held: this is a comparison, `check`
gives a verdict. Every figure is that of `check`, `stiffness` and `simulate`.";

/// Designs that stand side by side on paper.
const MOST: usize = 6;

/// Arguments of `compare`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct CompareArgs {
    /// Design files (TOML), two to six, the one before first
    #[arg(value_name = "FILE", required = true, num_args = 2..=MOST)]
    pub files: Vec<PathBuf>,
}

/// Run the command.
///
/// # Errors
/// [`Failure`].
pub fn run(args: &CompareArgs, context: &Context) -> Result<Exit, Failure> {
    let files: Vec<&Path> = args.files.iter().map(PathBuf::as_path).collect();
    context.outputs.check(&files, &[])?;
    let designs: Vec<Design> =
        args.files.iter().map(|file| parts::read_design(file, context)).collect::<Result<_, _>>()?;
    let started = Instant::now();
    let progress = context.progress("margins", "designs", Some(designs.len() as u64));
    let subjects = subjects(designs, &context.follow, &|| progress.advance(1)).map_err(|why| match why {
        NoComparison::NoClutch(i, why) => parts::no_clutch(&args.files[i], &why),
        NoComparison::Stopped => Failure::Interrupted,
    })?;
    drop(progress);
    let run_time_s = started.elapsed().as_secs_f64();
    let names: Vec<String> = args.files.iter().map(|file| file.display().to_string()).collect();
    let compared = Comparison::of(&subjects, &names);
    context.outputs.write_csv(&compared.csv_table());
    context.outputs.write_report(|| compared.page(&context.provenance(run_time_s)).unwrap_or_default());
    context.answer(&compared.text(context.screen))?;
    if let Some(answer) = compared.envelope(run_time_s) {
        context.print(&answer)?;
    }
    Ok(Exit::Held)
}
