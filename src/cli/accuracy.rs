//! `accuracy`: error against work of every method and fidelity, and the stability map.

mod body;
mod map;
mod page;
mod tables;
mod verdict;

use super::exit::{Exit, Failure};
use super::left_out::left_out;
use super::parts::{self, Answer};
use super::{Context, positive};
use crate::accuracy::{self, Judged, Precision, PrecisionSettings, WorkLimit, cases};
use crate::clutch::Scenario;
use crate::design::Design;
use body::Body;
use clap::Args;
use serde_json::json;
use std::path::PathBuf;
use std::time::Instant;

const EXAMPLES: &str = "\
Examples:
  sprag-design accuracy designs/huang2017-multi-arc.toml --report accuracy.html
  sprag-design accuracy designs/huang2017-multi-arc.toml --scenario high-10 --min-step 1e-5 --cases 0
  sprag-design accuracy designs/huang2017-multi-arc.toml --cases 2000 --seed 7 --json

Every case of the map is made by the seed and its number alone; the map is the same for any number of threads.
Times are medians of repeated runs of one thread on this machine and are never the same twice; beside other programs
long runs are interrupted more often than short ones, so compare methods on a quiet machine.
Ctrl-C writes the scenes and cases that are finished and ends with 130.";

/// Scenes compared by default, where the design has them: sticking, repeatedly opening, high preload, last arc.
const USUAL: [&str; 4] = ["high-6", "high-10", "low-10", "rated-45"];
/// Most cases that one command takes on: some hours.
const MOST_CASES: i64 = 100_000;

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
    /// Smallest step of the published scheme, s, 1e-8 to 1e-4
    #[arg(long, value_name = "S", default_value_t = 1e-7, allow_hyphen_values = true, value_parser = positive)]
    pub min_step: f64,
}

/// What was found.
struct Study {
    scenes: Vec<Precision>,
    /// Scenes that have no start, with the reason.
    without_start: Vec<(String, String)>,
    seed: u64,
    limit: WorkLimit,
    cases: Vec<Judged>,
    map_time_s: f64,
    /// Whether Ctrl-C cut it short: scenes and cases are those that were finished.
    interrupted: bool,
}

/// Run the command.
///
/// # Errors
/// [`Failure`].
pub fn run(args: &AccuracyArgs, context: &Context) -> Result<Exit, Failure> {
    context.outputs.check(&[&args.file], &[])?;
    if !(1e-8..=1e-4).contains(&args.min_step) {
        return Err(Failure::malformed(format!("--min-step {:e}: allowed: 1e-8 to 1e-4", args.min_step)));
    }
    let design = parts::read_design(&args.file, context)?;
    let scenarios = chosen(args, &design)?;
    let start = Instant::now();
    let study = study(args, context, &design, &scenarios);
    let worst = study.scenes.iter().map(|s| s.reference_error[0]).fold(0.0, f64::max);
    let answer = Answer {
        design: &design,
        run_time_s: start.elapsed().as_secs_f64(),
        left_out: left_out(&design.clutch),
        error_estimate: Some(json!(worst)),
        body: Body::of(&study),
    };
    context.outputs.write_csv(&tables::points(&study.scenes));
    context.outputs.write_report(|| page::page(&study, &answer, context));
    context.answer(&tables::text(&study, context.screen))?;
    answer.print(context)?;
    Ok(if study.interrupted { Exit::Interrupted } else { Exit::Held })
}

fn is_torsional(scenario: &Scenario) -> bool {
    scenario.kind.frequency_hz().is_some()
}

fn chosen<'a>(args: &AccuracyArgs, design: &'a Design) -> Result<Vec<&'a Scenario>, Failure> {
    if args.scenario.is_empty() {
        let torsional = || design.scenarios.iter().filter(|s| is_torsional(s));
        let usual: Vec<_> = torsional().filter(|s| USUAL.contains(&s.name.as_str())).collect();
        return Ok(if usual.is_empty() { torsional().collect() } else { usual });
    }
    let mut found: Vec<&Scenario> = Vec::new();
    for name in &args.scenario {
        let scenario =
            design.scenario(name).ok_or_else(|| super::simulate::unknown(name, design, &args.file))?;
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
fn study(args: &AccuracyArgs, context: &Context, design: &Design, scenarios: &[&Scenario]) -> Study {
    let follow = context.follow.clone();
    let mut settings = PrecisionSettings { follow: follow.clone(), ..PrecisionSettings::default() };
    // A hair of room: 1e-7 as typed and as listed are the same step.
    settings.steps_s.retain(|&s| s >= 0.999 * args.min_step);
    let progress =
        context.progress("methods", "settings", Some((scenarios.len() * settings.points()) as u64));
    let (mut scenes, mut without_start) = (Vec::new(), Vec::new());
    for scenario in scenarios {
        progress.describe(&scenario.name);
        match accuracy::precision(scenario, &settings, &|| progress.advance(1)) {
            Ok(Some(found)) => scenes.push(found),
            Ok(None) => break,
            Err(why) => without_start.push((scenario.name.clone(), why.to_string())),
        }
    }
    drop(progress);
    let limit = WorkLimit { follow, ..WorkLimit::default() };
    let wanted = cases(args.seed, args.cases as usize);
    let progress = context.progress("stability map", "cases", Some(u64::from(args.cases)));
    let start = Instant::now();
    let cases = accuracy::map(&design.clutch, &wanted, &limit, &|| progress.advance(1));
    drop(progress);
    let map_time_s = start.elapsed().as_secs_f64();
    let interrupted = context.follow.stopped();
    Study { scenes, without_start, seed: args.seed, limit, cases, map_time_s, interrupted }
}
