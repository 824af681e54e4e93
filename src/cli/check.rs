//! `check`: the designer margin check.

use super::Context;
use super::exit::{Exit, Failure};
use clap::Args;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  sprag-design check designs/huang2017-multi-arc.toml
  sprag-design check designs/huang2017-multi-arc.toml --report check.html
  sprag-design check designs/huang2017-multi-arc.toml --json | jq '.margins[] | select(.margin < 0)'";

/// Arguments of `check`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct CheckArgs {
    /// Design file (TOML)
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
}

/// Run the command.
///
/// # Errors
/// [`Failure`].
pub fn run(args: &CheckArgs, context: &Context) -> Result<Exit, Failure> {
    context.outputs.check(&args.file, &[])?;
    Err(Failure::Failed("check is not wired yet".into()))
}
