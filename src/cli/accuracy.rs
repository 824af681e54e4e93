//! `accuracy`: error against work of every method and fidelity, and the stability map.

use super::context::timed;
use super::exit::{Exit, Failure};
use super::{Context, Run, positive};
use crate::accuracy::PrecisionSettings;
use crate::answer::accuracy::{AccuracyStudy, is_torsional, usual_scenarios};
use crate::clutch::Scenario;
use crate::design::Design;
use clap::Args;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  sprag-design accuracy designs/huang2017-multi-arc.toml --report accuracy.html
  sprag-design accuracy designs/huang2017-multi-arc.toml --scenario high-10 --min-step 1e-5 --cases 0
  sprag-design accuracy designs/huang2017-multi-arc.toml --cases 2000 --seed 7 --max-steps 200000 --json

Every case of the map is made by the seed and its number alone; the map is the same for any number of threads.
Times are medians of repeated runs of one thread on this machine and are never the same twice; beside other programs
long runs are interrupted more often than short ones, so compare methods on a quiet machine.
Ctrl-C writes the scenes and cases that are finished and ends with 130.";

/// Most cases that one command takes on: some hours.
const MOST_CASES: i64 = 100_000;

/// Fewer steps of a run would be none more.
const MORE_STEPS: u64 = 20_001;

/// Arguments of `accuracy`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct AccuracyArgs {
    /// Design file (TOML)
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Scenarios to compare the methods on, comma separated [default: high-6,high-10,low-10,rated-45, those that the design has; else every torsional one]
    #[arg(long, value_name = "NAME,...", value_delimiter = ',')]
    pub scenario: Vec<String>,
    /// Cases of the stability map; 0: no map
    #[arg(long, value_name = "N", default_value_t = 300, allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(0..=MOST_CASES))]
    pub cases: u32,
    /// Seed of the stability map
    #[arg(long, value_name = "S", default_value_t = 1, allow_negative_numbers = true)]
    pub seed: u64,
    /// Most steps of a run of the map, and half as many changes of mode, where 20000 and 5000 led to no verdict [default: those are not run again]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = clap::value_parser!(u64).range(MORE_STEPS..))]
    pub max_steps: Option<u64>,
    /// Smallest step of the published scheme, s, 1e-8 to 1e-4
    #[arg(long, value_name = "S", default_value_t = 1e-7, allow_hyphen_values = true, value_parser = positive)]
    pub min_step: f64,
}

impl Run for AccuracyArgs {
    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        context.outputs.check(&[&self.file], &[])?;
        if !(1e-8..=1e-4).contains(&self.min_step) {
            return Err(Failure::malformed(format!("--min-step {:e}: allowed: 1e-8 to 1e-4", self.min_step)));
        }
        let design = context.design(&self.file)?;
        let scenarios = chosen(self, &design)?;
        let (study, run_time_s) = timed(|| study(self, context, &design, &scenarios));
        context.deliver(&study, run_time_s)
    }
}

fn chosen<'a>(args: &AccuracyArgs, design: &'a Design) -> Result<Vec<&'a Scenario>, Failure> {
    if args.scenario.is_empty() {
        return Ok(usual_scenarios(design));
    }
    let mut found: Vec<&Scenario> = Vec::new();
    for name in &args.scenario {
        let scenario = design.which_scenario(Some(name), |_| true);
        let scenario = scenario.map_err(|why| Failure::which(&args.file, why))?;
        if !is_torsional(scenario) {
            return Err(Failure::malformed(format!(
                "--scenario {name}: not of the kind torsional-excitation, which alone all methods can run"
            )));
        }
        if found.iter().all(|s| s.name != scenario.name) {
            found.push(scenario);
        }
    }
    Ok(found)
}

/// Everything asked for, or as much of it as was finished before Ctrl-C.
fn study<'d>(
    args: &AccuracyArgs,
    context: &Context,
    design: &'d Design,
    scenarios: &[&Scenario],
) -> AccuracyStudy<'d> {
    let mut settings = PrecisionSettings::down_to(args.min_step, &context.follow);
    let points = (scenarios.len() * settings.points()) as u64;
    let progress = context.progress("methods", "settings", Some(points));
    settings.follow = progress.told_by(&settings.follow);
    let study = AccuracyStudy::of(design, scenarios, &settings);
    drop(progress);
    let progress = context.progress("stability map", "cases", Some(u64::from(args.cases)));
    let follow = progress.told_by(&context.follow);
    study.with_map(args.seed, args.cases as usize, args.max_steps, &follow)
}
