//! `optimize`: a better design, and how it was found.

use super::Context;
use super::exit::{Exit, Failure};
use clap::Args;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  sprag-design optimize designs/huang2017-multi-arc.toml -o better.toml --report better.html
  sprag-design optimize designs/huang2017-multi-arc.toml -o better.toml --resume
  sprag-design optimize designs/huang2017-multi-arc.toml --json --quiet > best.json

Ctrl-C stops the search and writes the best design found so far; --resume goes on from there.";

/// Arguments of `optimize`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct OptimizeArgs {
    /// Design file (TOML) with an optimize table
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Where to write the better design file
    #[arg(long, short, value_name = "NEW.toml")]
    pub output: Option<PathBuf>,
    /// Go on from the journal of an interrupted search; the result is the same as without the break
    #[arg(long)]
    pub resume: bool,
}

/// Run the command.
///
/// # Errors
/// [`Failure`].
pub fn run(args: &OptimizeArgs, context: &Context) -> Result<Exit, Failure> {
    let new: Vec<&Path> = args.output.iter().map(PathBuf::as_path).collect();
    context.outputs.check(&args.file, &new)?;
    Err(Failure::Failed("optimize is not wired yet".into()))
}
