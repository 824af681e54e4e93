//! `reengage`: slip under load and the blow when the clutch grips again.

use super::exit::{Exit, Failure};
use super::output::path_text;
use super::{Context, parts, positive};
use crate::answer::reengagement::{NoReengagement, ReengagementSettings};
use crate::dynamics::Stop;
use clap::Args;
use std::f64::consts::PI;
use std::path::{Path, PathBuf};
use std::time::Instant;

const EXAMPLES: &str = "\
Examples:
  sprag-design reengage designs/starter.toml --torque 50 --inner-inertia 0.05 --outer-inertia 0.05 --friction 0.06
  sprag-design reengage designs/starter.toml --torque 50 --friction 0.06 --paths 0.1,1,10 --report blow.html
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
    /// The outer race keeps its speed whatever acts on it: in a housing, say
    #[arg(long, conflicts_with = "outer_inertia")]
    pub outer_held: bool,
    /// Friction of the contacts while they slip [default: 0.95 of what the torque needs]
    #[arg(long, value_name = "MU", allow_hyphen_values = true, value_parser = positive)]
    pub friction: Option<f64>,
    /// Speed of both races when the slip begins, rpm
    #[arg(long, value_name = "RPM", allow_hyphen_values = true, default_value_t = 0.0)]
    pub speed: f64,
    /// Paths of slip at the inner track after which the friction is back, mm, rising [default: 0.1,0.3,1,3,10,30]
    #[arg(long, value_name = "MM,...", allow_hyphen_values = true, value_parser = positive, value_delimiter = ',')]
    pub paths: Option<Vec<f64>>,
}

/// Run the command.
///
/// # Errors
/// [`Failure`].
pub fn run(args: &ReengageArgs, context: &Context) -> Result<Exit, Failure> {
    let inputs: Vec<&Path> = args.files.iter().map(PathBuf::as_path).collect();
    context.outputs.check(&inputs, &[])?;
    parts::each(&args.files, context, |file| one(args, file, context))
}

fn one(args: &ReengageArgs, file: &Path, context: &Context) -> Result<Exit, Failure> {
    let design = parts::read_design(file, context)?;
    let plain = ReengagementSettings::default();
    let settings = ReengagementSettings {
        torque_nm: args.torque,
        inertia_kg_m2: [args.inner_inertia, args.outer_inertia],
        outer_held: args.outer_held,
        friction: args.friction,
        speed_rad_s: args.speed * PI / 30.0,
        paths_m: args.paths.as_ref().map_or(plain.paths_m, |list| list.iter().map(|mm| 1e-3 * mm).collect()),
        follow: context.follow.clone(),
    };
    let started = Instant::now();
    let found = match design.reengagement(&settings) {
        Ok(found) => found,
        Err(why @ NoReengagement::Refused(_)) => return Err(Failure::malformed(why.to_string())),
        Err(why) => return Err(Failure::malformed(format!("{}: {why}", path_text(file)))),
    };
    let run_time_s = started.elapsed().as_secs_f64();
    context.outputs.write_csv(&found.blows());
    context.outputs.write_report(|| found.page(&context.provenance(run_time_s)));
    context.answer(&found.text(context.screen))?;
    context.print(&found.envelope(run_time_s))?;
    let ends =
        found.found.list.iter().filter_map(|blow| blow.ended).chain(found.found.ended.map(|end| end.stop));
    Ok(match ends.last() {
        Some(Stop::Interrupted) => Exit::Interrupted,
        Some(stop) if stop.gave_up() => Exit::Failed,
        _ if found.held() => Exit::Held,
        _ => Exit::NotHeld,
    })
}
