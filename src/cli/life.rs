//! `life`: what a life of loads does to the clutch.

use super::exit::{Exit, Failure};
use super::output::path_text;
use super::{Context, parts};
use crate::answer::life::NoLife;
use clap::Args;
use std::path::{Path, PathBuf};
use std::time::Instant;

const EXAMPLES: &str = "\
Examples:
  sprag-design life designs/indexing-life.toml
  sprag-design life designs/indexing-life.toml --report life.html
  sprag-design life designs/indexing-life.toml --set life.friction_scatter=0.15 --json

The loads and what the bodies bear stand in the table [life] of the design: `sprag-design explain life`. Pitting of sprags and
races and fatigue of the races as rings are summed over all loads (Miner); exit code 1 where a life is used up before its end,
a load indents a contact, a torque slips or is not carried, or more slips by chance are expected than slips_allowed.";

/// Arguments of `life`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct LifeArgs {
    /// Design files (TOML) with a table `life`
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<PathBuf>,
}

/// Run the command.
///
/// # Errors
/// [`Failure`].
pub fn run(args: &LifeArgs, context: &Context) -> Result<Exit, Failure> {
    let inputs: Vec<&Path> = args.files.iter().map(PathBuf::as_path).collect();
    context.outputs.check(&inputs, &[])?;
    parts::each(&args.files, context, |file| one(file, context))
}

fn one(file: &Path, context: &Context) -> Result<Exit, Failure> {
    let design = parts::read_design(file, context)?;
    let started = Instant::now();
    let found = design.life().map_err(|why| match why {
        NoLife::NoClutch(why) => parts::no_clutch(file, &why),
        NoLife::NoService => Failure::malformed(format!("{}: {why}", path_text(file))),
    })?;
    let run_time_s = started.elapsed().as_secs_f64();
    context.outputs.write_csv(&found.loads());
    context.outputs.write_report(|| found.page(&context.provenance(run_time_s)));
    context.answer(&found.text(context.screen))?;
    context.print(&found.envelope(run_time_s))?;
    Ok(if found.life.held() { Exit::Held } else { Exit::NotHeld })
}
