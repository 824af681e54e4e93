//! `simulate`: one scenario in time.

use super::clock::while_shown;
use super::context::timed;
use super::exit::{Exit, Failure};
use super::{Context, Run, positive};
use crate::answer::Answer;
use crate::answer::simulation::{
    self as scene, Ran, RefusedSetting, Setting, SimulationAnswer, SimulationSettings,
};
use crate::report::plain;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  sprag-design simulate designs/huang2017-multi-arc.toml --scenario high-10
  sprag-design simulate designs/huang2017-multi-arc.toml --scenario high-10 --csv history.csv --report high-10.html
  sprag-design simulate designs/huang2017-multi-arc.toml --scenario high-10 --figures
  sprag-design simulate designs/huang2017-multi-arc.toml --scenario high-10 --method published --step 2e-6
  sprag-design simulate designs/huang2017-bench.toml --scenario in-and-out --report in-and-out.html

The verdict is the answer: sticks, slips-overrunning, slips-engaging, disengages, overloaded and
at-threshold all exit with 0. A run that meets a limit of work exits with 3, with or without a verdict; so does one whose finer run meets
it, which leaves --tolerance unreached.";

/// Digits to which a refused number is repeated: more than anybody types.
const DIGITS: usize = 15;
/// Most rows of a history that can be asked for: more than any program reads.
const MOST_SAMPLES: u64 = 10_000_000;

/// How the equations of motion are integrated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum MethodName {
    /// Stick as a constraint, every change of mode located
    Event,
    /// The paper's scheme: Runge-Kutta with a narrow band around zero velocity; does not converge
    Published,
}

/// Arguments of `simulate`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct SimulateArgs {
    /// Design files (TOML); of more than one the answers follow one another, with --json a line each
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<PathBuf>,
    /// Name of one of the design's scenarios [default: the only one]
    #[arg(long, value_name = "NAME")]
    pub scenario: Option<String>,
    /// Method of integration
    #[arg(long, value_enum, default_value_t = MethodName::Event)]
    pub method: MethodName,
    /// Fixed step, s, 1e-9 or more (for the event method: its longest step) [default: chosen by the event method, 1e-5 published]
    #[arg(long, value_name = "S", allow_hyphen_values = true, value_parser = positive)]
    pub step: Option<f64>,
    /// True error allowed of every figure of the event method relative to its natural size (an angle: 1 rad, a time: the
    /// duration, a force: the largest), 1e-13 to 1e-3; steps are tightened until two runs agree to it [default: 1e-6]
    #[arg(long, value_name = "X", allow_hyphen_values = true, value_parser = positive)]
    pub tolerance: Option<f64>,
    /// Half width of the band of zero velocity of the published method, m/s [default: 1e-4]
    #[arg(long, value_name = "M_PER_S", allow_hyphen_values = true, value_parser = positive)]
    pub band: Option<f64>,
    /// Most steps of one run, refused ones included; a run that meets the limit gives up [default: 50000 for a second of the
    /// scene or 500 for a period, 200000 at least, 10000000 at most]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = clap::value_parser!(u64).range(1..))]
    pub max_steps: Option<u64>,
    /// Most changes of mode of one run; a run that meets the limit gives up [default: half as many as steps]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = clap::value_parser!(u64).range(1..))]
    pub max_changes: Option<u64>,
    /// Rows of the history, at equal distances [default: 1200; where that is less than 24 for a period or 1000 for a second,
    /// as many as that and a row for each change of mode and each extreme]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = clap::value_parser!(u64).range(2..=MOST_SAMPLES))]
    pub samples: Option<u64>,
    /// Part of the scene that the history shows, from A to B in seconds, as 59.5:60 [default: all of it]
    #[arg(long, value_name = "A:B", allow_hyphen_values = true, value_parser = window)]
    pub window: Option<[f64; 2]>,
    /// Run everything, also what the scene cannot feel (arcs never touched, the friction law where nothing slips)
    #[arg(long)]
    pub full: bool,
    /// Print all figures of the scene, not the ten alone that say most of it
    #[arg(long)]
    pub figures: bool,
}

impl Run for SimulateArgs {
    const NAMES: &[&str] = &["kinds"];

    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        context.reads(&self.files)?;
        let settings = self.settings(context);
        settings.validate().map_err(|why| refusal(why, self.window))?;
        refuse_strangers(self)?;
        context.each(&self.files, |file, design| {
            let scenario = design.which_scenario(self.scenario.as_deref(), |_| true);
            let scenario = scenario.map_err(|why| Failure::which(file, why))?;
            settings.validate_for(scenario).map_err(|why| refusal(why, self.window))?;
            let duration_s = scenario.kind.duration_s();
            let run = || Ran::new(design, scenario, &settings);
            let (ran, run_time_s) = timed(|| while_shown(&scenario.name, duration_s, context, run));
            let other = format!("{}, contact damping changed", scenario.name);
            let damping = while_shown(&other, duration_s, context, || ran.damping_effect(&settings));
            let found = SimulationAnswer::new(ran, damping, &settings);
            let text = if self.figures { SimulationAnswer::text_with_all_figures } else { Answer::text };
            let exit = context.deliver_as(&found, text, run_time_s)?;
            for note in &found.body.notes {
                let word = if note.starts_with("warning: ") { "" } else { "note: " };
                context.message(&format!("{word}{note}"));
            }
            Ok(exit)
        })
    }
}

impl SimulateArgs {
    fn settings(&self, context: &Context) -> SimulationSettings {
        SimulationSettings {
            method: match self.method {
                MethodName::Event => scene::Integration::Event,
                MethodName::Published => scene::Integration::Published { band_m_s: self.band },
            },
            tolerance: self.tolerance,
            step_s: self.step,
            most_steps: self.max_steps,
            most_events: self.max_changes,
            rows: self.samples.and_then(|n| usize::try_from(n).ok()),
            window_s: self.window,
            full: self.full,
            follow: context.follow.clone(),
        }
    }
}

/// The refusal of a setting, by its flag.
fn refusal(why: RefusedSetting, window_s: Option<[f64; 2]>) -> Failure {
    if let (Setting::Window, Some(ends)) = (why.setting, window_s) {
        let [from, until] = ends.map(|t_s| plain(t_s, DIGITS));
        return Failure::malformed(format!("--window {from}:{until}: allowed: {}", why.allowed));
    }
    let flag = match why.setting {
        Setting::Tolerance => "--tolerance",
        Setting::Step => "--step",
        Setting::Window => "--window",
    };
    refused(flag, why.found, &why.allowed)
}

/// Refuse flags that the method does not know.
fn refuse_strangers(args: &SimulateArgs) -> Result<(), Failure> {
    let published = args.method == MethodName::Published;
    let event = "only with --method event";
    // Flag, whether it is given, with its number to be repeated, whether it is of the published method, what is allowed.
    let given = [
        (
            "--tolerance",
            args.tolerance.map(Some),
            false,
            "--step with --method published, whose step is fixed",
        ),
        ("--window", args.window.map(|_| None), false, event),
        ("--max-steps", args.max_steps.map(|_| None), false, event),
        ("--max-changes", args.max_changes.map(|_| None), false, event),
        ("--band", args.band.map(Some), true, "only with --method published: the event method needs no band"),
    ];
    match given.into_iter().find(|(_, given, of_published, _)| given.is_some() && *of_published != published)
    {
        Some((flag, Some(Some(x)), _, allowed)) => Err(refused(flag, x, allowed)),
        Some((flag, _, _, allowed)) => Err(Failure::malformed(format!("{flag}: {allowed}"))),
        None => Ok(()),
    }
}

/// Two times, s, with a colon between them.
fn window(text: &str) -> Result<[f64; 2], String> {
    let time = |text: &str| text.trim().parse::<f64>().ok().filter(|t| t.is_finite() && *t >= 0.0);
    match text.split_once(':').map(|(a, b)| (time(a), time(b))) {
        Some((Some(a), Some(b))) if a < b => Ok([a, b]),
        _ => Err("two times in seconds are needed, the earlier one first, as in 0.1:0.2".to_owned()),
    }
}

fn refused(flag: &str, found: f64, allowed: &str) -> Failure {
    Failure::malformed(format!("{flag} {}: allowed: {allowed}", plain(found, DIGITS)))
}
