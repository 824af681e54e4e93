//! `resonance`: periodic states of a torsional excitation, one or a map over frequency and amplitude.

use super::context::timed;
use super::exit::{Exit, Failure};
use super::output::path_text;
use super::{Context, Run, positive};
use crate::answer::resonance::{
    NoRange, NoResonance, RESONANCE_TOLERANCES, RangeOf, ResonanceQuestion, no_excitation,
};
use crate::design::WhichScenario;
use crate::scenario::Settings;
use clap::Args;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  sprag-design resonance designs/huang2017-multi-arc.toml --scenario high-6
  sprag-design resonance designs/huang2017-multi-arc.toml --scenario high-6 --frequency 20:400 --amplitude 1:20 --report map.html
  sprag-design resonance designs/huang2017-multi-arc.toml --scenario low-10-mu082 --frequency 50:150 --points 21 --csv row.csv

The motion that repeats with the excitation, its start forgotten: found by shooting, with its stability. Without ranges that of
the scenario; with them a map of the friction that rolling needs and of what the clutch does. The state is the answer: rolls, slips,
lifts-off, overloaded, disengages and not-found all exit with 0. Exit code 2: a scenario that is no torsional excitation, or in which a
drivetrain takes part; 130: Ctrl-C, the amplitudes that are done are written.";

/// Arguments of `resonance`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct ResonanceArgs {
    /// Design files (TOML)
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<PathBuf>,
    /// Name of one of the design's scenarios, a torsional excitation [default: the only one of these]
    #[arg(long, value_name = "NAME")]
    pub scenario: Option<String>,
    /// Frequencies, Hz: from and to, or one [default: the scenario's]
    #[arg(long, value_name = "FROM:TO", value_parser = span)]
    pub frequency: Option<[f64; 2]>,
    /// Amplitudes, Nm: from and to, or one [default: the scenario's]
    #[arg(long, value_name = "FROM:TO", value_parser = span)]
    pub amplitude: Option<[f64; 2]>,
    /// Frequencies and amplitudes of the map, ends included, up to 1000 each, 1 where one is asked for; one number for both [default:
    /// 50x50]
    #[arg(long, value_name = "NxM", value_parser = points)]
    pub points: Option<[usize; 2]>,
    /// Error allowed of every figure relative to its natural size, 1e-9 to 1e-3
    #[arg(long, value_name = "X", default_value_t = 1e-6, value_parser = tolerance)]
    pub tolerance: f64,
}

/// FROM:TO, or one number for both.
fn span(text: &str) -> Result<[f64; 2], String> {
    let (from, to) = text.split_once(':').unwrap_or((text, text));
    let both = [positive(from)?, positive(to)?];
    if both[0] <= both[1] { Ok(both) } else { Err("FROM:TO rises, such as 20:400".to_owned()) }
}

/// NxM, or N for both.
fn points(text: &str) -> Result<[usize; 2], String> {
    const MOST: usize = 1000;
    let (x, y) = text.split_once('x').unwrap_or((text, text));
    let count = |n: &str| n.trim().parse().ok().filter(|n| (1..=MOST).contains(n));
    count(x)
        .zip(count(y))
        .map(|(x, y)| [x, y])
        .ok_or_else(|| format!("NxM is needed, such as 50x50, 1 to {MOST} each"))
}

fn tolerance(text: &str) -> Result<f64, String> {
    let value = positive(text)?;
    let [low, high] = RESONANCE_TOLERANCES;
    if (low..=high).contains(&value) { Ok(value) } else { Err(format!("{low:e} to {high:e}")) }
}

/// What is wrong with the flags.
fn no_range(why: NoRange) -> Failure {
    let flag = |of| if of == RangeOf::Frequency { "--frequency" } else { "--amplitude" };
    Failure::malformed(match why {
        NoRange::Points => "--points: needs --frequency FROM:TO, --amplitude FROM:TO or both".to_owned(),
        NoRange::One { of, range: [from, to] } => {
            format!("--points: 1 where {} asks for {from}:{to}; give one of them, or 2 points", flag(of))
        }
    })
}

impl Run for ResonanceArgs {
    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        context.reads(&self.files)?;
        let question =
            ResonanceQuestion::over(self.frequency, self.amplitude, self.points).map_err(no_range)?;
        context.each(&self.files, |file, design| {
            let scenario =
                design.which_scenario(self.scenario.as_deref(), |s| s.kind.frequency_hz().is_some());
            let scenario = scenario.map_err(|why| match why {
                WhichScenario::None => Failure::of(
                    file,
                    no_excitation(design) + "`sprag-design explain scenarios` lists its keys",
                ),
                why => Failure::which(file, why),
            })?;
            // Each is found on the way up and on the way down.
            let total = 2 * question.frequencies_hz.len().max(1) * question.amplitudes_nm.len().max(1);
            let line = context.progress("resonance", "states", Some(total as u64));
            let follow = line.told_by(&context.follow.unseen());
            let settings = Settings { tolerance: self.tolerance, follow, ..Settings::default() };
            let (found, run_time_s) = timed(|| design.resonance(scenario, &question, &settings));
            drop(line);
            let named = |why: &NoResonance| format!("{}: {}: {why}", path_text(file), scenario.name);
            let found = found.map_err(|why| match why {
                NoResonance::Stopped => Failure::Interrupted,
                NoResonance::NoExcitation | NoResonance::Drivetrain | NoResonance::Setting(_) => {
                    Failure::malformed(named(&why))
                }
                NoResonance::NoStart(_) => Failure::NoClutch(named(&why)),
            })?;
            context.deliver(&found, run_time_s)
        })
    }
}
