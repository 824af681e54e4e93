//! `check`: the designer margin check.

use super::context::timed;
use super::exit::{Exit, Failure};
use super::origin::FileKind;
use super::{Context, Run};
use crate::answer::check::{CheckAnswer, NoCheck};
use crate::design::Design;
use clap::Args;
use std::path::{Path, PathBuf};

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
    /// Say how the table is to be read, too
    #[arg(long)]
    pub notes: bool,
    /// Refused with what is meant.
    #[arg(long = "overrun-rpm", value_name = "RPM", hide = true, value_parser = speed_of_the_file)]
    pub overrun_rpm: Option<f64>,
}

fn speed_of_the_file(_: &str) -> Result<f64, String> {
    Err("speeds are the file's: --set limits.keep_contact_to_rpm=3000, or a scene of kind overrun; `overrun --speeds` with an oil".to_owned())
}

impl Run for CheckArgs {
    const NAMES: &[&str] = &["limits"];

    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        let others: Vec<_> = self.overrun_csv.iter().map(|path| (path.as_path(), FileKind::Table)).collect();
        let inputs: Vec<&Path> = self.files.iter().map(PathBuf::as_path).collect();
        context.outputs.check(&inputs, &others)?;
        if self.files.len() > 1 && self.overrun_csv.is_some() {
            return Err(Failure::malformed("--overrun-csv is of one FILE"));
        }
        context.each(&self.files, |file, design| {
            let (found, run_time_s) = checked(design, file, context)?;
            if let Some(path) = &self.overrun_csv {
                context.outputs.write_table(path, &found.body.overrun.table());
            }
            match self.notes {
                true => context.deliver_as(&found, CheckAnswer::text_with_notes, run_time_s),
                false => context.deliver(&found, run_time_s),
            }
        })
    }
}

/// The check, and the time that it took, s.
pub(super) fn checked(
    design: &Design,
    file: &Path,
    context: &Context,
) -> Result<(CheckAnswer, f64), Failure> {
    let progress = context.progress("margins", "scenarios", Some(design.scenarios.len() as u64));
    let (found, run_time_s) = timed(|| design.check(&progress.told_by(&context.follow)));
    let found = found.map_err(|why| match why {
        NoCheck::NoClutch(why) => Failure::no_clutch(file, &why),
        NoCheck::Stopped => Failure::Interrupted,
    })?;
    Ok((found, run_time_s))
}
