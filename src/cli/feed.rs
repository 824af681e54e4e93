//! `feed`: what each stroke of an indexing drive feeds.

use super::context::timed;
use super::exit::{Exit, Failure};
use super::{Context, Run, positive};
use crate::answer::feed::{FeedSettings, NoFeed};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  sprag-design feed designs/indexing.toml --stroke 30 --brake 100 --inertia 0.02
  sprag-design feed designs/indexing.toml --stroke 12 --brake 50 --frequency 5,10,20,40 --allowed 0.05 --report feed.html
  sprag-design feed designs/indexing.toml --stroke 12 --brake 50 --spring 0.5,2,4

One race swings to and fro, the other is fed against a brake. How much does a stroke feed, and up to how many strokes a second?
Between the frequencies it looks too, up to the first loss; the verdict tells of one, the exit code is that of those asked for.
Exit code 1 where strokes of a frequency asked for feed more or less than slow ones by more than is allowed, wind the clutch up
beyond its limits at peak torque, or throw its sprags.";

/// The race that swings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Driver {
    /// The inner race
    Inner,
    /// The outer race
    Outer,
}

/// Arguments of `feed`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct FeedArgs {
    /// Design files (TOML)
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<PathBuf>,
    /// Angle that the driving race turns by and back, deg
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = positive)]
    pub stroke: f64,
    /// Strokes a second, Hz, rising [default: 1,2,5,10,20,50]
    #[arg(long, value_name = "HZ,...", allow_hyphen_values = true, value_parser = positive, value_delimiter = ',')]
    pub frequency: Option<Vec<f64>>,
    /// Torque of the brake on the fed race, Nm [default: limits.nominal_torque_nm]
    #[arg(long, value_name = "NM", allow_hyphen_values = true)]
    pub brake: Option<f64>,
    /// What turns with the fed race, kg m², the race included [default: races.inner_inertia_kg_m2 of
    /// the file, with --driver inner races.outer_inertia_kg_m2, else the race alone]
    #[arg(long, value_name = "KG_M2", allow_hyphen_values = true, value_parser = positive)]
    pub inertia: Option<f64>,
    /// The race that swings
    #[arg(long, value_enum, default_value_t = Driver::Outer)]
    pub driver: Driver,
    /// By how much a stroke may feed more or less than slow ones, deg
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = positive, default_value_t = 0.1)]
    pub allowed: f64,
    /// Other springs to look at: factors of stiffness and drag torque of the file's
    #[arg(long, value_name = "FACTOR,...", allow_hyphen_values = true, value_parser = positive, value_delimiter = ',')]
    pub spring: Vec<f64>,
}

impl Run for FeedArgs {
    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        let usual = FeedSettings::default();
        let settings = FeedSettings {
            stroke_rad: self.stroke.to_radians(),
            frequencies_hz: self.frequency.clone().unwrap_or(usual.frequencies_hz),
            brake_nm: self.brake,
            inertia_kg_m2: self.inertia,
            inner_drives: self.driver == Driver::Inner,
            allowed_rad: self.allowed.to_radians(),
            springs: self.spring.clone(),
            follow: context.follow.clone(),
        };
        context.each(&self.files, |file, design| {
            let (found, run_time_s) = timed(|| design.feed(&settings));
            let found = found.map_err(|why| match why {
                NoFeed::Refused { .. } => Failure::malformed(why.to_string()),
                why => Failure::of(file, why),
            })?;
            context.deliver(&found, run_time_s)
        })
    }
}
