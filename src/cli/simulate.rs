//! `simulate`: one scenario in time.

mod answer;
mod damping;
mod facts;
mod history;
mod left_out;
mod notes;
mod page;
mod told;
mod unfelt;

use super::exit::{Exit, Failure};
use super::parts::{self, Answer};
use super::{Context, positive};
use crate::design::{Design, Scenario, ScenarioKind};
use crate::dynamics::Stop;
use crate::fidelity::{self, Term};
use crate::scenario::{
    NoScenario, Prepared, Settings, Simulation, Verdict, prepare, published_steps, simulate_published,
};
use clap::{Args, ValueEnum};
use serde_json::json;
use std::path::{Path, PathBuf};
use std::time::Instant;

const EXAMPLES: &str = "\
Examples:
  sprag-design simulate designs/huang2017-multi-arc.toml --scenario high-10
  sprag-design simulate designs/huang2017-multi-arc.toml --scenario high-10 --csv history.csv --report high-10.html
  sprag-design simulate designs/huang2017-multi-arc.toml --scenario high-10 --method published --step 2e-6
  sprag-design simulate designs/huang2017-bench.toml --scenario in-and-out --report in-and-out.html

The verdict is the answer: sticks, slips-overrunning, slips-engaging, disengages, overloaded and
at-threshold all exit with 0. A run that meets a limit of work exits with 3, with or without a verdict.";

/// The paper's step, s.
const PUBLISHED_STEP_S: f64 = 1e-5;
/// Half width of the published scheme's band; the paper gives none, a choice.
const PUBLISHED_BAND_M_S: f64 = 1e-4;
/// Tolerances that make sense: below, rounding rules; above, events are missed.
const TOLERANCES: [f64; 2] = [1e-13, 1e-3];
/// Shortest step that makes sense, s: below, rounding of the time rules.
const SHORTEST_STEP_S: f64 = 1e-9;
/// Steps of the published scheme that one command takes on: some hours.
const MOST_STEPS: u64 = 1_000_000_000;
/// Most rows of a history that can be asked for: more than any program reads.
const MOST_SAMPLES: u64 = 10_000_000;

/// How the equations of motion are integrated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Method {
    /// Stick as a constraint, every change of mode located
    Event,
    /// The paper's scheme: Runge-Kutta with a narrow band around zero velocity; does not converge
    Published,
}

/// Arguments of `simulate`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct SimulateArgs {
    /// Design file (TOML)
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Name of one of the design's scenarios
    #[arg(long, value_name = "NAME")]
    pub scenario: String,
    /// Method of integration
    #[arg(long, value_enum, default_value_t = Method::Event)]
    pub method: Method,
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
}

/// A scenario and what became of it.
struct Scene<'a> {
    scenario: &'a Scenario,
    /// The design with the scenario's overrides in its clutch.
    own: Design,
    /// `event`, `published`, or `equilibrium` where nothing is integrated.
    method: &'static str,
    outcome: Result<(Prepared, Simulation), NoScenario>,
    /// Terms that the planner left out, and those it looked at and kept.
    planned: [Vec<Term>; 2],
    /// What contact damping changes, where that was asked.
    damping: Option<damping::Effect>,
    /// What a reader must know beside the figures.
    notes: Vec<String>,
    run_time_s: f64,
}

/// Run the command.
///
/// # Errors
/// [`Failure`].
pub fn run(args: &SimulateArgs, context: &Context) -> Result<Exit, Failure> {
    context.outputs.check(&[&args.file], &[])?;
    refuse_senseless(args)?;
    let design = parts::read_design(&args.file, context)?;
    let scenario =
        design.scenario(&args.scenario).ok_or_else(|| unknown(&args.scenario, &design, &args.file))?;
    let duration = duration_s(scenario);
    if let (Method::Published, Some(duration), Some(step)) = (args.method, duration, args.step)
        && step > duration
    {
        return Err(refused("--step", step, &format!("at most the duration of the scenario, {duration} s")));
    }
    refuse_endless(args, duration)?;
    refuse_outside(args, duration)?;
    let start = Instant::now();
    let event = duration.filter(|_| args.method == Method::Event);
    let run = || computed(args, context, scenario);
    let (outcome, planned) = match told::while_told(&scenario.name, event, context, run) {
        Ok((prepared, simulation, planned)) => (Ok((prepared, simulation)), planned),
        Err(why) => (Err(why), Default::default()),
    };
    let run_time_s = start.elapsed().as_secs_f64();
    let method = match args.method {
        _ if duration.is_none() => "equilibrium",
        Method::Event => "event",
        Method::Published => "published",
    };
    let own = Design { clutch: scenario.clutch.clone(), ..design.clone() };
    let mut scene =
        Scene { scenario, own, method, outcome, planned, damping: None, notes: Vec::new(), run_time_s };
    let other = format!("{}, contact damping changed", scenario.name);
    scene.damping = told::while_told(&other, event, context, || {
        damping::effect(&scene, &settings_of(args, context, scenario))
    });
    scene.notes = notes::of(&scene, args);
    report(&design, &scene, context)
}

fn settings_of(args: &SimulateArgs, context: &Context, scenario: &Scenario) -> Settings {
    let (samples, history) = history::asked(args, scenario);
    let chosen = Settings::default();
    Settings {
        tolerance: args.tolerance.unwrap_or(chosen.tolerance),
        // The published scheme has a step of its own.
        longest_step_s: args.step.filter(|_| args.method == Method::Event),
        samples,
        history,
        most_steps: args.max_steps,
        most_events: args.max_changes,
        energy: true,
        interrupt: Some(context.interrupt.flag()),
        clock: Some(&told::CLOCK),
    }
}

fn computed(
    args: &SimulateArgs,
    context: &Context,
    scenario: &Scenario,
) -> Result<(Prepared, Simulation, [Vec<Term>; 2]), NoScenario> {
    let settings = settings_of(args, context, scenario);
    match args.method {
        Method::Event => {
            let planned = fidelity::simulate(scenario, &settings, args.full)?;
            Ok((planned.prepared, planned.simulation, [planned.left_out, planned.kept]))
        }
        Method::Published => {
            let prepared = prepare(scenario)?;
            let step_s = args.step.unwrap_or(PUBLISHED_STEP_S);
            let total = published_steps(prepared.duration_s, step_s);
            let progress = context.progress("published scheme", "steps", Some(total));
            let band = args.band.unwrap_or(PUBLISHED_BAND_M_S);
            let simulation = simulate_published(scenario, &settings, step_s, band, &mut |steps| {
                progress.set(steps);
                !context.interrupt.requested()
            })?;
            Ok((prepared, simulation, Default::default()))
        }
    }
}

fn report(design: &Design, scene: &Scene, context: &Context) -> Result<Exit, Failure> {
    let answer = Answer {
        design,
        run_time_s: scene.run_time_s,
        left_out: left_out::of(scene),
        error_estimate: scene.simulation().and_then(|s| s.error).map(|e| json!(e.theta_inner_rad)),
        body: answer::Body::of(scene),
    };
    if context.outputs.csv.is_some() {
        context.outputs.write_csv(&history::table(scene));
    }
    context.outputs.write_report(|| page::page(scene, &answer, context));
    answer.print(context)?;
    let facts = facts::table(scene).to_text(context.screen);
    context.answer(&format!("{}\n\n{facts}", scene.verdict_line()))?;
    for note in &scene.notes {
        context.message(&format!("note: {note}"));
    }
    Ok(match scene.simulation() {
        Some(s) if s.stop == Stop::Interrupted || s.finer_gave_up == Some(Stop::Interrupted) => {
            Exit::Interrupted
        }
        Some(s) if s.verdict.is_none() || s.stop.gave_up() => Exit::Failed,
        _ => Exit::Held,
    })
}

/// Duration of a scenario that is integrated, s.
fn duration_s(scenario: &Scenario) -> Option<f64> {
    match scenario.kind {
        ScenarioKind::TorsionalExcitation { duration_s, .. }
        | ScenarioKind::Engagement { duration_s, .. }
        | ScenarioKind::Transient { duration_s, .. } => Some(duration_s),
        ScenarioKind::Static { .. } | ScenarioKind::Overrun { .. } => None,
    }
}

fn refuse_senseless(args: &SimulateArgs) -> Result<(), Failure> {
    if let Some(step) = args.step.filter(|&step| step < SHORTEST_STEP_S) {
        return Err(refused("--step", step, &format!("{SHORTEST_STEP_S:e} s or more")));
    }
    if let Some(x) = args.tolerance {
        refuse_tolerance(x)?;
        if args.method == Method::Published {
            return Err(refused("--tolerance", x, "--step with --method published, whose step is fixed"));
        }
    }
    match (args.method, args.band) {
        (Method::Event, Some(band)) => {
            Err(refused("--band", band, "only with --method published: the event method needs no band"))
        }
        _ => Ok(()),
    }
}

/// Refuse a `--tolerance` that makes no sense.
pub(super) fn refuse_tolerance(x: f64) -> Result<(), Failure> {
    let [low, high] = TOLERANCES;
    match (low..=high).contains(&x) {
        true => Ok(()),
        false => Err(refused("--tolerance", x, &format!("{low:e} to {high:e}; 1e-6 serves well"))),
    }
}

/// Refuse a run of the published scheme that would not end in a day.
fn refuse_endless(args: &SimulateArgs, duration_s: Option<f64>) -> Result<(), Failure> {
    let (Method::Published, Some(duration_s)) = (args.method, duration_s) else { return Ok(()) };
    let step_s = args.step.unwrap_or(PUBLISHED_STEP_S);
    if published_steps(duration_s, step_s) <= MOST_STEPS {
        return Ok(());
    }
    let least = step_s * (published_steps(duration_s, step_s) as f64 / MOST_STEPS as f64);
    let why = format!(
        "{least:.1e} s or more: at most {:e} steps in twice the scenario's {duration_s} s, the second time halved",
        MOST_STEPS as f64
    );
    Err(refused("--step", step_s, &why))
}

/// Two times, s, with a colon between them.
fn window(text: &str) -> Result<[f64; 2], String> {
    let time = |text: &str| text.trim().parse::<f64>().ok().filter(|t| t.is_finite() && *t >= 0.0);
    match text.split_once(':').map(|(a, b)| (time(a), time(b))) {
        Some((Some(a), Some(b))) if a < b => Ok([a, b]),
        _ => Err("two times in seconds are needed, the earlier one first, as in 0.1:0.2".to_owned()),
    }
}

/// Refuse a part of the scene that it does not have, and limits that the published scheme does not know.
fn refuse_outside(args: &SimulateArgs, duration_s: Option<f64>) -> Result<(), Failure> {
    if args.method == Method::Published {
        let given = [
            ("--window", args.window.is_some()),
            ("--max-steps", args.max_steps.is_some()),
            ("--max-changes", args.max_changes.is_some()),
        ];
        if let Some((flag, _)) = given.into_iter().find(|(_, given)| *given) {
            return Err(Failure::malformed(format!("{flag}: only with --method event")));
        }
    }
    match (args.window, duration_s) {
        (Some([_, until]), Some(end)) if until > end => {
            Err(refused("--window", until, &format!("up to the end of the scene at {end} s")))
        }
        _ => Ok(()),
    }
}

fn refused(flag: &str, found: f64, allowed: &str) -> Failure {
    Failure::malformed(format!("{flag} {found:e}: allowed: {allowed}"))
}

/// The refusal of a scenario that the design does not have.
pub(super) fn unknown(name: &str, design: &Design, file: &Path) -> Failure {
    let file = file.display();
    let names: Vec<&str> = design.scenarios.iter().map(|s| s.name.as_str()).collect();
    let likeness = |candidate: &str| strsim::jaro_winkler(candidate, name);
    match names.iter().copied().max_by(|a, b| likeness(a).total_cmp(&likeness(b))) {
        None => Failure::malformed(format!(
            "{file}: the design has no scenarios, --scenario {name} asks for one; add a [[scenarios]] table"
        )),
        Some(nearest) => Failure::malformed(format!(
            "{file}: no scenario {name}, which --scenario asks for; did you mean {nearest}? The design has: {}",
            names.join(", ")
        )),
    }
}

impl Scene<'_> {
    fn simulation(&self) -> Option<&Simulation> {
        self.outcome.as_ref().ok().map(|(_, s)| s)
    }

    /// Verdict by its name, also where the clutch has no start: it does not carry it, or has no curve.
    fn verdict(&self) -> Option<&'static str> {
        match &self.outcome {
            Ok((_, s)) => s.verdict.map(Verdict::name),
            Err(NoScenario::NotCarried { .. }) => Some(Verdict::Overloaded.name()),
            Err(_) => Some(Verdict::Disengages.name()),
        }
    }

    /// Whether the clutch does what the scenario asks: hold, or slip freely in overrun.
    fn held(&self) -> bool {
        let overruns = match self.scenario.kind {
            ScenarioKind::Overrun { .. } => true,
            // A clutch that starts in overrun, or whose torque turns round, is to let go.
            ScenarioKind::Transient { overrun_rad_s, .. } => {
                let turns = |h: &Vec<[f64; 2]>| h.iter().any(|row| row[1] < 0.0);
                overrun_rad_s > 0.0 || self.scenario.torque_history.as_ref().is_some_and(turns)
            }
            _ => false,
        };
        match self.simulation().and_then(|s| s.verdict) {
            Some(Verdict::Sticks) => true,
            Some(Verdict::SlipsOverrunning) => overruns,
            _ => false,
        }
    }

    /// Torque at which the drawing shows the clutch, N m.
    fn drawn_torque_nm(&self) -> Option<f64> {
        match self.scenario.kind {
            ScenarioKind::Static { torque_nm } => Some(torque_nm),
            ScenarioKind::TorsionalExcitation { preload_nm, .. } => Some(preload_nm),
            ScenarioKind::Engagement { reversing_torque_nm, .. } => Some(reversing_torque_nm),
            ScenarioKind::Transient { preload_nm, torque_step_nm, .. } => {
                let rows = self.scenario.torque_history.iter().flatten();
                Some(rows.map(|row| row[1]).fold(preload_nm.max(preload_nm + torque_step_nm), f64::max))
            }
            ScenarioKind::Overrun { .. } => None,
        }
        .filter(|&t| t > 0.0)
    }
}
