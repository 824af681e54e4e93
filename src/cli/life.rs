//! `life`: what a life of loads does to the clutch.

use super::context::timed;
use super::exit::{Exit, Failure};
use super::{Context, Run};
use crate::answer::life::NoLife;
use clap::Args;
use std::path::PathBuf;

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

impl Run for LifeArgs {
    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        context.each(&self.files, |file, design| {
            let (found, run_time_s) = timed(|| design.life());
            let found = found.map_err(|why| match why {
                NoLife::NoClutch(why) => Failure::no_clutch(file, &why),
                NoLife::NoService { .. } | NoLife::NoSwing { .. } => Failure::of(file, why),
            })?;
            context.deliver(&found, run_time_s)
        })
    }
}
