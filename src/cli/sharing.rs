//! `sharing`: what each sprag carries.

use super::context::timed;
use super::exit::{Exit, Failure};
use super::{Context, Run, positive};
use crate::answer::sharing::NoSharing;
use crate::scenario::Settings;
use clap::Args;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  sprag-design sharing designs/unlike-sprags.toml
  sprag-design sharing designs/unlike-sprags.toml --torque 40 --report sharing.html
  sprag-design sharing designs/unlike-sprags.toml --set sharing.seed=7 --json
  sprag-design sharing designs/unlike-sprags.toml --scenario NAME --report scene.html

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
    /// A scenario of the design, run with its sprags one by one: who catches, who slips, shares over time
    #[arg(long, value_name = "NAME", conflicts_with = "torque")]
    pub scenario: Option<String>,
    /// Most steps of a run of the scenario, refused ones included; a run that meets the limit gives up [default: as `simulate`]
    #[arg(long, value_name = "N", allow_negative_numbers = true, requires = "scenario",
          value_parser = clap::value_parser!(u64).range(1..))]
    pub max_steps: Option<u64>,
}

impl Run for SharingArgs {
    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        context.each(&self.files, |file, design| {
            if let Some(name) = &self.scenario {
                let (follow, most_steps) = (context.follow.clone(), self.max_steps);
                let settings = Settings { follow, most_steps, ..Settings::default() };
                let (found, run_time_s) = timed(|| design.sharing_in_scene(name, &settings));
                let found = found.map_err(|why| Failure::of(file, why))?;
                return context.deliver(&found, run_time_s);
            }
            let (found, run_time_s) = timed(|| design.sharing(self.torque));
            let found = found.map_err(|why| match why {
                NoSharing::NoClutch(why) => Failure::no_clutch(file, &why),
                why => Failure::of(file, why),
            })?;
            context.deliver(&found, run_time_s)
        })
    }
}
