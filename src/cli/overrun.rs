//! `overrun`: film, drag, heat, swing and wear of a clutch that overruns.

use super::context::timed;
use super::exit::{Exit, Failure};
use super::{Context, Run, number, positive};
use crate::answer::overrun::{
    NoOverrun, OIL_TEMPERATURES_C, OVERRUN_SPEEDS_RAD_S, OverrunQuestion, RunningRace,
};
use crate::design::{rad_s, rpm};
use clap::Args;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  sprag-design overrun designs/lubricated.toml
  sprag-design overrun designs/lubricated.toml --speeds 300,1000,3000 --temperatures 20,60,100
  sprag-design overrun designs/lubricated.toml --race outer --report overrun.html
  sprag-design overrun designs/lubricated.toml --set lubrication.oil='\"ISO VG 100\"' --json

Oil, roughness and conductances stand in the table [lubrication] of the design: `sprag-design explain lubrication`;
`sprag-design oils` lists the oils.";

/// Arguments of `overrun`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct OverrunArgs {
    /// Design files (TOML) with a table `lubrication`
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<PathBuf>,
    /// Speeds of the race that runs, rpm, comma separated [default: 50, 100, 200, 500 ... up to lift-off and 50 m/s, and those of the
    /// file's overruns, with --race outer those of its limits too]
    #[arg(long, value_name = "RPM,...", allow_hyphen_values = true, value_parser = speed, value_delimiter = ',')]
    pub speeds: Vec<f64>,
    /// Temperatures of the oil, C, comma separated [default: lubrication.temperature_c]
    #[arg(long, value_name = "C,...", allow_hyphen_values = true, value_parser = oil_temperature, value_delimiter = ',')]
    pub temperatures: Vec<f64>,
    /// Race that runs, the other one stands
    #[arg(long, value_name = "RACE", value_enum, default_value = "inner")]
    pub race: RunningRace,
}

/// A speed at which such a clutch may run.
fn speed(text: &str) -> Result<f64, String> {
    let most = rpm(OVERRUN_SPEEDS_RAD_S[1]).round();
    match positive(text)? {
        rpm if rpm <= most => Ok(rpm),
        _ => Err(format!("a speed of at most {most} rpm is needed")),
    }
}

/// A temperature within the range of `lubrication.temperature_c`.
fn oil_temperature(text: &str) -> Result<f64, String> {
    let celsius = number(text)?;
    let [low, high] = OIL_TEMPERATURES_C;
    match (low..=high).contains(&celsius) {
        true => Ok(celsius),
        false => Err(format!("a temperature from {low} to {high} C is needed")),
    }
}

impl Run for OverrunArgs {
    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        let question = OverrunQuestion {
            race: self.race,
            speeds_rad_s: self.speeds.iter().map(|&rpm| rad_s(rpm)).collect(),
            temperatures_c: self.temperatures.clone(),
        };
        context.each(&self.files, |file, design| {
            let (found, run_time_s) = timed(|| design.overrun(&question));
            let found = found.map_err(|why| match why {
                NoOverrun::NoClutch(why) => Failure::no_clutch(file, &why),
                NoOverrun::NoLubrication | NoOverrun::AtSpeed { .. } | NoOverrun::Setting(_) => {
                    Failure::of(file, why)
                }
            })?;
            context.deliver(&found, run_time_s)
        })
    }
}
