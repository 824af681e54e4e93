//! `compare`: several designs side by side.

use super::context::timed;
use super::exit::{Exit, Failure};
use super::{Context, Run};
use crate::answer::comparison::{Comparison, MOST_COMPARED, NoComparison, subjects};
use clap::Args;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  sprag-design compare before.toml after.toml
  sprag-design compare before.toml after.toml --report compare.html
  sprag-design compare a.toml b.toml c.toml --csv - | column -s, -t

The first design is the one before: dashed in every drawing and curve. Exit code 0 whatever is held: this is a comparison, `check`
gives a verdict. Every figure is that of `check`, `stiffness` and `simulate`.";

/// Arguments of `compare`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct CompareArgs {
    /// Design files (TOML), two to six, the one before first
    #[arg(value_name = "FILE", required = true, num_args = 2..=MOST_COMPARED)]
    pub files: Vec<PathBuf>,
}

impl Run for CompareArgs {
    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        context.reads(&self.files)?;
        let mut failed = Vec::new();
        let read = |file: &PathBuf| context.design(file).map_err(|why| failed.push(why)).ok();
        let designs: Vec<_> = self.files.iter().filter_map(read).collect();
        if let Some(why) = Failure::of_all(failed) {
            return Err(why);
        }
        let progress = context.progress("margins", "designs", Some(designs.len() as u64));
        let (found, run_time_s) = timed(|| subjects(designs, &progress.told_by(&context.follow)));
        let subjects = found.map_err(|why| match why {
            NoComparison::NoClutch(i, why) => Failure::no_clutch(&self.files[i], &why),
            NoComparison::Stopped => Failure::Interrupted,
        })?;
        drop(progress);
        let names: Vec<String> = self.files.iter().map(|file| file.display().to_string()).collect();
        let compared = Comparison::of(&subjects, &names);
        compared.map_or(Ok(Exit::Held), |compared| context.deliver(&compared, run_time_s))
    }
}
