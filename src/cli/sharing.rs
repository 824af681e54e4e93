//! `sharing`: what each sprag carries.

use super::exit::{Exit, Failure};
use super::output::path_text;
use super::{Context, parts, positive};
use crate::answer::sharing::NoSharing;
use clap::Args;
use std::path::{Path, PathBuf};
use std::time::Instant;

const EXAMPLES: &str = "\
Examples:
  sprag-design sharing designs/unlike-sprags.toml
  sprag-design sharing designs/unlike-sprags.toml --torque 40 --report sharing.html
  sprag-design sharing designs/unlike-sprags.toml --set sharing.seed=7 --json

What sets the sprags apart stands in the table [sharing] of the design: `sprag-design explain sharing`. Races bend under uneven
forces, run out ([races.eccentricity]) and give way on their bearings. Exit code 1 where the torque is not carried, a sprag is pressed beyond
the Hertz limit, or needs more friction than it has.";

/// Arguments of `sharing`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct SharingArgs {
    /// Design files (TOML) with a table `sharing`
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<PathBuf>,
    /// Torque, Nm [default: limits.nominal_torque_nm]
    #[arg(long, value_name = "NM", allow_hyphen_values = true, value_parser = positive)]
    pub torque: Option<f64>,
}

/// Run the command.
///
/// # Errors
/// [`Failure`].
pub fn run(args: &SharingArgs, context: &Context) -> Result<Exit, Failure> {
    let inputs: Vec<&Path> = args.files.iter().map(PathBuf::as_path).collect();
    context.outputs.check(&inputs, &[])?;
    parts::each(&args.files, context, |file| one(args, file, context))
}

fn one(args: &SharingArgs, file: &Path, context: &Context) -> Result<Exit, Failure> {
    let design = parts::read_design(file, context)?;
    let started = Instant::now();
    let found = design.sharing(args.torque).map_err(|why| match why {
        NoSharing::NoClutch(why) => parts::no_clutch(file, &why),
        why => Failure::malformed(format!("{}: {why}", path_text(file))),
    })?;
    let run_time_s = started.elapsed().as_secs_f64();
    context.outputs.write_csv(&found.by_sprag());
    context.outputs.write_report(|| found.page(&context.provenance(run_time_s)));
    context.answer(&found.text(context.screen))?;
    context.print(&found.envelope(run_time_s))?;
    Ok(if found.held() { Exit::Held } else { Exit::NotHeld })
}
