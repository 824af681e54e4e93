//! `check`: the designer margin check.

use super::exit::{Exit, Failure};
use super::origin::FileKind;
use super::{Context, parts};
use crate::answer::check::{CheckAnswer, CheckBody, NoCheck, check, csv_table};
use crate::design::Design;
use clap::Args;
use std::path::{Path, PathBuf};
use std::time::Instant;

const EXAMPLES: &str = "\
Examples:
  sprag-design check designs/huang2017-multi-arc.toml
  sprag-design check designs/huang2017-multi-arc.toml --report check.html
  sprag-design check designs/huang2017-multi-arc.toml --json | jq '.margins[] | select(.held | not)'";

/// Arguments of `check`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct CheckArgs {
    /// Design files (TOML); of more than one the answers follow one another, with --json a line each
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<PathBuf>,
    /// Write drag torque, contact forces and growth of the outer race against speed as CSV
    #[arg(long, value_name = "PATH")]
    pub overrun_csv: Option<PathBuf>,
    /// Refused with what is meant.
    #[arg(long = "overrun-rpm", value_name = "RPM", hide = true, value_parser = speed_of_the_file)]
    pub overrun_rpm: Option<f64>,
}

fn speed_of_the_file(_: &str) -> Result<f64, String> {
    Err("speeds are the file's: --set limits.keep_contact_to_rpm=3000, or a scene of kind overrun; `overrun --speeds` with an oil".to_owned())
}

/// Run the command.
///
/// # Errors
/// [`Failure`].
pub fn run(args: &CheckArgs, context: &Context) -> Result<Exit, Failure> {
    let others: Vec<_> = args.overrun_csv.iter().map(|path| (path.as_path(), FileKind::Table)).collect();
    let inputs: Vec<&Path> = args.files.iter().map(PathBuf::as_path).collect();
    context.outputs.check(&inputs, &others)?;
    if args.files.len() > 1 && args.overrun_csv.is_some() {
        return Err(Failure::malformed("--overrun-csv is of one FILE"));
    }
    parts::each(&args.files, context, |file| one(args, file, context))
}

fn one(args: &CheckArgs, file: &Path, context: &Context) -> Result<Exit, Failure> {
    let design = parts::read_design(file, context)?;
    let (found, run_time_s) = checked(&design, file, context)?;
    context.outputs.write_csv(&csv_table(&found.rows, found.state.curve.end_torque_nm()));
    if let Some(path) = &args.overrun_csv {
        context.outputs.write_table(path, &found.body.overrun.table());
    }
    context.outputs.write_report(|| found.page(&design, &context.provenance(run_time_s)));
    context.answer(&found.text(&design, context.screen))?;
    context.print(&found.envelope(&design, run_time_s))?;
    Ok(exit(&found.body))
}

/// The check, and the time that it took, s.
pub(super) fn checked(
    design: &Design,
    file: &Path,
    context: &Context,
) -> Result<(CheckAnswer, f64), Failure> {
    let progress = context.progress("margins", "scenarios", Some(design.scenarios.len() as u64));
    let started = Instant::now();
    let found = check(design, &context.follow, &|| progress.advance(1)).map_err(|why| match why {
        NoCheck::NoClutch(why) => parts::no_clutch(file, &why),
        NoCheck::Stopped => Failure::Interrupted,
    })?;
    Ok((found, started.elapsed().as_secs_f64()))
}

/// What the verdict comes to.
pub(super) fn exit(body: &CheckBody) -> Exit {
    match body.held() {
        Some(true) => Exit::Held,
        Some(false) => Exit::NotHeld,
        None => Exit::Failed,
    }
}
