//! `overrun`: film, drag, heat, swing and wear of a clutch that overruns.

use super::context::timed;
use super::exit::{Exit, Failure};
use super::{Context, Run, number, positive};
use crate::answer::overrun::{NoOverrun, OverrunQuestion, RunningRace};
use clap::{Args, ValueEnum};
use std::f64::consts::PI;
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
    pub race: RaceName,
}

/// A race, as flags have it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum RaceName {
    /// The inner race, past sprags that stand
    Inner,
    /// The outer race, the sprags with it
    Outer,
}

/// A speed at which such a clutch may run.
fn speed(text: &str) -> Result<f64, String> {
    match positive(text)? {
        rpm if rpm <= 100_000.0 => Ok(rpm),
        _ => Err("a speed of at most 100000 rpm is needed".to_owned()),
    }
}

/// A temperature within the range of `lubrication.temperature_c`.
fn oil_temperature(text: &str) -> Result<f64, String> {
    let celsius = number(text)?;
    match (-60.0..=250.0).contains(&celsius) {
        true => Ok(celsius),
        false => Err("a temperature from -60 to 250 C is needed".to_owned()),
    }
}

impl Run for OverrunArgs {
    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        let question = OverrunQuestion {
            race: match self.race {
                RaceName::Inner => RunningRace::Inner,
                RaceName::Outer => RunningRace::Outer,
            },
            speeds_rad_s: self.speeds.iter().map(|rpm| rpm * PI / 30.0).collect(),
            temperatures_c: self.temperatures.clone(),
        };
        context.each(&self.files, |file, design| {
            let (found, run_time_s) = timed(|| design.overrun(&question));
            let found = found.map_err(|why| match why {
                NoOverrun::NoClutch(why) => Failure::no_clutch(file, &why),
                NoOverrun::NoLubrication => Failure::of(file, why),
            })?;
            context.deliver(&found, run_time_s)?;
            Ok(Exit::Held)
        })
    }
}
