//! `reengage`: slip under load and the blow when the clutch grips again.

use super::context::timed;
use super::exit::{Exit, Failure};
use super::{Context, Run, positive};
use crate::answer::reengagement::{NoReengagement, ReengagementSettings};
use crate::design::rad_s;
use clap::Args;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  sprag-design reengage designs/starter.toml --torque 50 --inner-inertia 0.05 --outer-inertia 0.05 --friction 0.06
  sprag-design reengage designs/starter.toml --torque 50 --friction 0.06 --paths 0.1,1,10 --report blow.html
  sprag-design reengage designs/starter.toml --torque 50 --paths 1 --over-friction 0.02,0.04,0.06 --over-inertia 0.01,0.05
  sprag-design reengage designs/indexing.toml --torque 100 --friction 0.06 --inner-inertia 0.02 --outer-held

The clutch carries a torque; its friction falls, it slips, and after a path of slip the friction is back: how large is the blow? The
inertias are those of the races with all that turns rigidly with them. Exit code 1 where a blow is beyond what the limits at
peak torque allow, or the sprags are thrown out of reach.";

/// Arguments of `reengage`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct ReengageArgs {
    /// Design files (TOML)
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<PathBuf>,
    /// Torque carried when the slip begins, Nm [default: limits.nominal_torque_nm]
    #[arg(long, value_name = "NM", allow_hyphen_values = true, value_parser = positive)]
    pub torque: Option<f64>,
    /// What turns with the inner race, kg m², the race included [default: races.inner_inertia_kg_m2 of the file, else the race alone]
    #[arg(long, value_name = "KG_M2", allow_hyphen_values = true, value_parser = positive)]
    pub inner_inertia: Option<f64>,
    /// What turns with the outer race, kg m², the race included [default: races.outer_inertia_kg_m2 of the file, else the race alone]
    #[arg(long, value_name = "KG_M2", allow_hyphen_values = true, value_parser = positive)]
    pub outer_inertia: Option<f64>,
    /// The outer race keeps its speed whatever acts on it: in a housing, say [default: where the design names no speed of it]
    #[arg(long, conflicts_with = "outer_inertia")]
    pub outer_held: bool,
    /// The outer race is free to turn
    #[arg(long, conflicts_with = "outer_held")]
    pub outer_free: bool,
    /// Friction of the contacts while they slip [default: 0.95 of what the torque needs]
    #[arg(long, value_name = "MU", allow_hyphen_values = true, value_parser = positive)]
    pub friction: Option<f64>,
    /// Speed of both races when the slip begins, rpm [default: the largest at which a scenario of the file carries torque, else 0]
    #[arg(long, value_name = "RPM", allow_hyphen_values = true)]
    pub speed: Option<f64>,
    /// Paths of slip at the inner track after which the friction is back, mm, rising [default: 0.1,0.3,1,3,10,30]
    #[arg(long, value_name = "MM,...", allow_hyphen_values = true, value_parser = positive, value_delimiter = ',')]
    pub paths: Option<Vec<f64>>,
    /// Table of blows over frictions in slip, and over --over-inertia where given
    #[arg(long, value_name = "MU,...", allow_hyphen_values = true, value_parser = positive, value_delimiter = ',')]
    pub over_friction: Vec<f64>,
    /// Table of blows over what turns with the inner race, kg m², and over --over-friction where given
    #[arg(long, value_name = "KG_M2,...", allow_hyphen_values = true, value_parser = positive, value_delimiter = ',')]
    pub over_inertia: Vec<f64>,
}

impl Run for ReengageArgs {
    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        let usual = ReengagementSettings::default();
        let paths_m = self.paths.as_ref().map(|list| list.iter().map(|mm| 1e-3 * mm).collect());
        let settings = ReengagementSettings {
            torque_nm: self.torque,
            inertia_kg_m2: [self.inner_inertia, self.outer_inertia],
            outer_held: (self.outer_held || self.outer_free).then_some(self.outer_held),
            friction: self.friction,
            speed_rad_s: self.speed.map(rad_s),
            paths_m: paths_m.unwrap_or(usual.paths_m),
            over_friction: self.over_friction.clone(),
            over_inner_inertia_kg_m2: self.over_inertia.clone(),
            follow: context.follow.clone(),
        };
        context.each(&self.files, |file, design| {
            let (found, run_time_s) = timed(|| design.reengagement(&settings));
            let found = found.map_err(|why| match why {
                NoReengagement::Refused(_) => Failure::malformed(why.to_string()),
                why => Failure::of(file, why),
            })?;
            context.deliver(&found, run_time_s)
        })
    }
}
