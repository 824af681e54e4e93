//! The command line: the only room that knows paths, prints, and sets the exit code.
//!
//! In: arguments, a design file. Out: text or one JSON object on standard output, files, messages on standard error.
//! Absent: physics, units (`report` changes them), allowables (`margin` has them).
//! Equations: none.

pub mod accuracy;
pub mod check;
mod clock;
mod command_line;
pub mod compare;
pub mod evaluate;
mod evaluate_points;
pub mod exit;
pub mod explain;
pub mod export;
pub mod histories;
pub mod identify;
pub mod import;
pub mod interrupt;
pub mod journal;
mod laws;
pub mod life;
mod made;
pub mod map;
pub mod materials;
pub mod new;
pub mod oils;
pub mod optimize;
pub mod origin;
pub mod output;
pub mod overrun;
pub mod parts;
pub mod progress;
pub mod reengage;
pub mod resonance;
pub mod sample;
pub mod schema;
pub mod sharing;
pub mod sheet;
pub mod simulate;
pub mod size;
pub mod stiffness;
pub mod studio;
pub mod sweep;

use crate::answer::{Envelope, Provenance};
use crate::follow::Follow;
use crate::report::Screen;
use clap::{Args, CommandFactory, FromArgMatches, Parser, Subcommand};
use command_line::{command_line, missing_value};
use exit::{Exit, Failure};
use output::Outputs;
use progress::ProgressLine;
use serde::Serialize;
use serde_json::json;
use std::ffi::OsString;
use std::io::IsTerminal;
use std::path::PathBuf;
use std::process::ExitCode;

const EXAMPLES: &str = "\
Examples:
  sprag-design new
  sprag-design check designs/huang2017-multi-arc.toml
  sprag-design sheet designs/huang2017-multi-arc.toml
  sprag-design compare before.toml after.toml --report compare.html
  sprag-design stiffness designs/huang2017-multi-arc.toml --max-torque 50 --csv curve.csv
  sprag-design simulate designs/huang2017-multi-arc.toml --scenario high-10 --report high-10.html
  sprag-design check designs/huang2017-multi-arc.toml --set r_i2_mm=4.2 --set friction.static=0.11
  sprag-design studio designs/huang2017-multi-arc.toml
  sprag-design optimize designs/huang2017-multi-arc.toml -o better.toml
  sprag-design accuracy designs/huang2017-multi-arc.toml --report accuracy.html

Exit codes:
  0 done, all margins held     1 a margin is not held, or no feasible design found
  2 malformed command line or design file     3 answer not computed or not written
  130 stopped by Ctrl-C; what had been found is written by optimize, identify, simulate, accuracy, reengage and
      resonance (amplitudes that are done), nothing by the others (studio: 0, Ctrl-C is how it ends)
  141 the reader of the answers of evaluate has gone before the last

A file that is there already is replaced only if this tool has written it (its first lines say so; of a table: the names of
its columns); --force replaces any. What cannot be written costs no answer: it is printed, with exit code 3.
With --json whatever is refused or fails is one JSON object too: tool, version, error (message; of a refused design file
also file and problems), with the same exit code.";

#[derive(Debug, Parser)]
#[command(
    name = output::TOOL,
    version,
    about = "Design and optimise multi-arc sprag clutches: margins, stiffness, stick-slip, search",
    after_help = EXAMPLES,
    max_term_width = 100
)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    #[command(flatten)]
    common: Common,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// A live page in the browser: change a number and see what it does
    Studio(studio::StudioArgs),
    /// Hold the design against each of its limits: demand, allowable, margin, torque capacity
    Check(check::CheckArgs),
    /// The design sheet: answer, dimensioned drawing, margins, scenes and all inputs, to print on A4
    Sheet(sheet::SheetArgs),
    /// Two to six designs side by side: inputs that differ, margins, curves, scenes
    Compare(compare::CompareArgs),
    /// Torque against windup, forces, angles and stiffness, for one contact law or several
    Stiffness(stiffness::StiffnessArgs),
    /// Run one scenario of the design: histories, slip, contact loss and a verdict
    Simulate(simulate::SimulateArgs),
    /// Life under repeated loads: pitting, fatigue of the races, indentation, slip by chance
    Life(life::LifeArgs),
    /// Sprags one by one: what each carries where they are unlike, races bend, run out and give way
    Sharing(sharing::SharingArgs),
    /// Slip under load, and the blow when the clutch grips again
    Reengage(reengage::ReengageArgs),
    /// Periodic states of a torsional excitation: one, or a map over frequency and amplitude
    Resonance(resonance::ResonanceArgs),
    /// Overrun on a film of oil: film, drag, heat, temperatures, stability, wear, flash of a slip
    Overrun(overrun::OverrunArgs),
    /// Search for a better design within the limits
    Optimize(optimize::OptimizeArgs),
    /// Margins of one vector of variables per line, for other optimisers
    Evaluate(evaluate::EvaluateArgs),
    /// Points of the box of the variables, for `evaluate` and other programs
    Sample(sample::SampleArgs),
    /// Plots of a sweep: margins over two variables, what decides, the border of what is held
    Map(map::MapArgs),
    /// Error against run time of every method and fidelity, and the stability map
    Accuracy(accuracy::AccuracyArgs),
    /// Your own clutch: asks what it is for, its space, torque and speeds, and writes the design file
    New(new::NewArgs),
    /// A first design file from space, torque, speeds, friction and steel
    Size(size::SizeArgs),
    /// Find unknown parameters from measured or published numbers, and what these cannot tell apart
    Identify(identify::IdentifyArgs),
    /// Write the design as a drawing (DXF, SVG), a solid (STEP), a table of arcs, a CalculiX deck or a co-simulation unit (FMU)
    Export(export::ExportArgs),
    /// A drawn or measured sprag (DXF, or a table of points) as a design file
    Import(import::ImportArgs),
    /// What a limit, a key, a variable or another name means, and what moves it
    Explain(explain::ExplainArgs),
    /// List the steels that a design may name, with their constants, allowed stresses and sources
    Materials,
    /// List the oils and greases that a design may name, with viscosities and sources
    Oils,
    /// Print the JSON Schema of the design file
    Schema,
    /// Print a completion script for a shell
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
}

#[derive(Debug, Args)]
#[command(next_help_heading = "Output")]
struct Common {
    /// Print one JSON object on standard output and nothing else there
    #[arg(long, global = true)]
    json: bool,
    /// Write the result table as CSV, units in the column names; - writes it to standard output in place of the text
    #[arg(long, global = true, value_name = "PATH")]
    csv: Option<PathBuf>,
    /// Write a self-contained HTML page with drawing, curves and tables; a PDF is made by printing it (A4)
    #[arg(long, global = true, value_name = "PATH.html")]
    report: Option<PathBuf>,
    /// Set a value of the design before anything else, as often as wanted: a dotted path of the file
    /// (`sprags.inner_arcs[0].radius_mm=4.1`, rows count from 0) or a variable's short name (`r_i1_mm=4.1`, arcs from 1);
    /// checked like the file, which stays as it is
    #[arg(long, global = true, value_name = "KEY=VALUE", value_parser = setting)]
    set: Vec<(String, String)>,
    /// Replace files that this tool has not written, too
    #[arg(long, global = true)]
    force: bool,
    /// Number of threads [default: all cores]
    #[arg(long, global = true, value_name = "N", allow_negative_numbers = true, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// No progress and no messages, only the answer and errors
    #[arg(long, short, global = true)]
    quiet: bool,
}

/// What every command may use of the outside world.
#[derive(Debug, Clone)]
pub struct Context {
    /// One JSON object instead of text on standard output.
    pub json: bool,
    /// No progress, no messages.
    pub quiet: bool,
    /// What the answer is printed on.
    pub screen: Screen,
    /// Files to write.
    pub outputs: Outputs,
    /// What `--set` sets: path and value as typed.
    pub set: Vec<(String, String)>,
    /// The command line as typed, for the reports.
    pub command_line: String,
    /// Stopped by Ctrl-C.
    pub follow: Follow,
}

impl Context {
    /// A message on standard error, unless `--quiet`.
    pub fn message(&self, text: &str) {
        if !self.quiet {
            output::note(text);
        }
    }

    /// A progress line on standard error; `unit` names the steps, `total` counts them if known.
    pub fn progress(&self, what: &str, unit: &str, total: Option<u64>) -> ProgressLine {
        ProgressLine::new(!self.quiet, what, unit, total)
    }

    /// How an answer came about that took `run_time_s`, s.
    pub fn provenance(&self, run_time_s: f64) -> Provenance {
        Provenance { command: self.command_line.clone(), run_time_s }
    }

    /// The one JSON object of `--json`, with what could not be written until now; nothing without it.
    ///
    /// # Errors
    /// [`Failure::Failed`] where standard output cannot be written.
    pub fn print<B: Serialize>(&self, answer: &Envelope<'_, B>) -> Result<(), Failure> {
        if self.json { output::print_json(&answer.object(self.outputs.unwritten())) } else { Ok(()) }
    }

    /// The answer as text on standard output; nothing with `--json` and with `--csv -`.
    ///
    /// # Errors
    /// [`Failure::Failed`] where standard output cannot be written.
    pub fn answer(&self, text: &str) -> Result<(), Failure> {
        if self.json || self.outputs.csv_is_answer() { Ok(()) } else { output::print(text) }
    }
}

/// Run the program.
pub fn run() -> ExitCode {
    run_from(std::env::args_os()).into()
}

/// Run the program with `args`, its own name first, as another program does that carries this one: its answer goes to standard
/// output, Ctrl-C is caught from then on. `--threads` holds for the process, and once. The exit code.
pub fn run_from<A: Into<OsString>>(args: impl IntoIterator<Item = A>) -> u8 {
    // A path that is no Unicode loses what cannot be shown.
    let text = |arg: A| arg.into().to_string_lossy().into_owned();
    ended(args.into_iter().map(text).collect()).code()
}

fn ended(args: Vec<String>) -> Exit {
    let parsed = missing_value(&args).map_or_else(|| command().try_get_matches_from(&args), Err);
    let cli = match parsed.and_then(|matches| Cli::from_arg_matches(&matches)) {
        Ok(cli) => cli,
        Err(e) if e.use_stderr() => {
            // The message repeats what was typed.
            let message = e.render().to_string();
            if args.iter().take_while(|arg| *arg != "--").any(|arg| arg == "--json") {
                let _ = output::print_json(&json!({
                    "tool": output::TOOL, "version": output::VERSION, "error": { "message": message.trim_end() },
                }));
            }
            output::note(message.trim_end());
            return Exit::Malformed;
        }
        Err(help_or_version) => {
            let _ = help_or_version.print();
            return Exit::Held;
        }
    };
    let json = cli.common.json && takes(name_of(&cli.command), "json");
    exit::keep_names_whole();
    match dispatch(cli, &args) {
        Ok(exit) => exit,
        Err(failure) => {
            if json {
                // Standard output may be what has failed; standard error says it in words.
                let _ = output::print_json(&json!({
                    "tool": output::TOOL, "version": output::VERSION, "error": failure.to_json(),
                }));
            }
            match &failure {
                Failure::Malformed(report) => output::note_painted(&format!("{report:?}")),
                Failure::Failed(text) | Failure::NoClutch(text) => output::note(&format!("error: {text}")),
                Failure::Interrupted => output::note("stopped"),
            }
            failure.exit()
        }
    }
}

/// The command line with its help: each command shows only the options that mean something to it.
fn command() -> clap::Command {
    let root = Cli::command();
    let common: Vec<clap::Arg> = root.get_arguments().filter(|a| a.is_global_set()).cloned().collect();
    let whole = MEANINGLESS.iter().fold(root, |root, (name, _, without)| {
        let hidden = common.iter().filter(|a| without.contains(&a.get_id().as_str()));
        let hidden: Vec<clap::Arg> = hidden.map(|a| a.clone().hide(true)).collect();
        root.mut_subcommand(name, |command| command.args(hidden))
    });
    let folded = |command: clap::Command| {
        let after = command.get_after_help().map(|text| in_paragraphs(&text.to_string()));
        after.into_iter().fold(command, |command, text| command.after_help(text))
    };
    folded(whole.mut_subcommands(folded))
}

/// The text with each paragraph on a line of its own, for the terminal to fold: lines that neither are indented nor follow a
/// heading or an indented one go on where the one before ends.
fn in_paragraphs(text: &str) -> String {
    let mut whole = String::new();
    let mut open = false;
    for line in text.lines() {
        let plain = !line.is_empty() && !line.starts_with(' ');
        if !whole.is_empty() {
            whole.push(if open && plain { ' ' } else { '\n' });
        }
        whole.push_str(line);
        open = plain && !line.ends_with(':');
    }
    whole
}

fn dispatch(cli: Cli, args: &[String]) -> Result<Exit, Failure> {
    refuse_meaningless(&cli.command, &cli.common)?;
    let context = context(cli.common, args)?;
    let exit = match cli.command {
        Command::Studio(args) => studio::run(&args, &context),
        Command::Check(args) => check::run(&args, &context),
        Command::Sheet(args) => sheet::run(&args, &context),
        Command::Compare(args) => compare::run(&args, &context),
        Command::Stiffness(args) => stiffness::run(&args, &context),
        Command::Simulate(args) => simulate::run(&args, &context),
        Command::Life(args) => life::run(&args, &context),
        Command::Sharing(args) => sharing::run(&args, &context),
        Command::Reengage(args) => reengage::run(&args, &context),
        Command::Resonance(args) => resonance::run(&args, &context),
        Command::Overrun(args) => overrun::run(&args, &context),
        Command::Optimize(args) => optimize::run(&args, &context),
        Command::Evaluate(args) => evaluate::run(&args, &context),
        Command::Sample(args) => sample::run(&args, &context),
        Command::Map(args) => map::run(&args, &context),
        Command::Accuracy(args) => accuracy::run(&args, &context),
        Command::New(args) => new::run(&args, &context),
        Command::Size(args) => size::run(&args, &context),
        Command::Identify(args) => identify::run(&args, &context),
        Command::Export(args) => export::run(&args, &context),
        Command::Import(args) => import::run(&args, &context),
        Command::Explain(args) => explain::run(&args, &context),
        Command::Materials => materials::run(&context),
        Command::Oils => oils::run(&context),
        Command::Schema => schema::run(),
        Command::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut command(), output::TOOL, &mut script);
            output::print(&String::from_utf8_lossy(&script))?;
            Ok(Exit::Held)
        }
    }?;
    Ok(if context.outputs.unwritten().is_empty() { exit } else { Exit::Failed })
}

/// Commands, why common options mean nothing to them, and which.
const MEANINGLESS: [(&str, &str, &[&str]); 11] = [
    ("explain", "its answer is a few words", &["csv", "report", "set", "force", "threads", "quiet"]),
    ("new", "it makes a design, it reads none", &["set"]),
    ("size", "it makes a design, it reads none", &["set"]),
    ("studio", "its answers are shown in the browser", &["json", "csv", "report", "force"]),
    ("materials", "steels are a table, they have no page", &["report", "set", "threads", "quiet"]),
    ("oils", "oils are a table, they have no page", &["report", "set", "threads", "quiet"]),
    ("schema", "its answer is one JSON object", &["csv", "report", "set", "force", "threads", "quiet"]),
    ("completions", "its answer is a script", &["json", "csv", "report", "set", "force", "threads", "quiet"]),
    ("evaluate", "its answer is a JSON object for each line that it reads", &["json", "report"]),
    ("sample", "its answer is a table of points", &["json", "report", "threads"]),
    ("map", "its tables name the design", &["set", "threads", "quiet"]),
];

fn takes(command: &str, option: &str) -> bool {
    MEANINGLESS.iter().all(|(name, _, without)| *name != command || !without.contains(&option))
}

fn name_of(command: &Command) -> &'static str {
    match command {
        Command::Studio(_) => "studio",
        Command::Check(_) => "check",
        Command::Sheet(_) => "sheet",
        Command::Compare(_) => "compare",
        Command::Stiffness(_) => "stiffness",
        Command::Simulate(_) => "simulate",
        Command::Life(_) => "life",
        Command::Sharing(_) => "sharing",
        Command::Reengage(_) => "reengage",
        Command::Resonance(_) => "resonance",
        Command::Overrun(_) => "overrun",
        Command::Optimize(_) => "optimize",
        Command::Evaluate(_) => "evaluate",
        Command::Sample(_) => "sample",
        Command::Map(_) => "map",
        Command::Accuracy(_) => "accuracy",
        Command::New(_) => "new",
        Command::Size(_) => "size",
        Command::Identify(_) => "identify",
        Command::Export(_) => "export",
        Command::Import(_) => "import",
        Command::Explain(_) => "explain",
        Command::Materials => "materials",
        Command::Oils => "oils",
        Command::Schema => "schema",
        Command::Completions { .. } => "completions",
    }
}

/// Refuse `--json`, `--csv`, `--report` and `--set` where a command has no such answer; --force, --threads and --quiet, which then
/// change nothing, are let pass.
fn refuse_meaningless(command: &Command, common: &Common) -> Result<(), Failure> {
    let given = [
        ("json", common.json),
        ("csv", common.csv.is_some()),
        ("report", common.report.is_some()),
        ("set", !common.set.is_empty()),
    ];
    let command = name_of(command);
    let Some((name, why, without)) = MEANINGLESS.iter().find(|(name, ..)| *name == command) else {
        return Ok(());
    };
    match given.into_iter().find(|(flag, given)| *given && without.contains(flag)) {
        Some((flag, _)) => Err(Failure::malformed(format!("--{flag} has no meaning with {name}: {why}"))),
        None => Ok(()),
    }
}

fn context(common: Common, args: &[String]) -> Result<Context, Failure> {
    if common.json && common.csv.as_deref().is_some_and(output::is_standard_output) {
        return Err(Failure::malformed(
            "--csv - and --json both write to standard output: give --csv a file",
        ));
    }
    let follow = interrupt::install(common.quiet);
    if let Some(threads) = common.threads {
        rayon::ThreadPoolBuilder::new()
            .num_threads(usize::from(threads))
            .build_global()
            .map_err(|e| Failure::Failed(format!("--threads {threads}: {e}")))?;
    }
    // NO_COLOR counts when set to anything but nothing (no-color.org).
    let refused = std::env::var_os("NO_COLOR").is_some_and(|v| !v.is_empty());
    let out = std::io::stdout();
    let terminal = out.is_terminal();
    // A pipe or a file takes lines of any length.
    let columns = terminal_size::terminal_size_of(&out).filter(|_| terminal).map(|(w, _)| usize::from(w.0));
    Ok(Context {
        json: common.json,
        quiet: common.quiet,
        screen: Screen { colour: terminal && !refused, columns },
        outputs: Outputs::new(common.csv, common.report, common.force),
        set: common.set,
        command_line: command_line(args.iter().cloned()),
        follow,
    })
}

/// A path and a value, for `--set`.
fn setting(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((path, value)) if !path.trim().is_empty() => Ok((path.trim().to_owned(), value.to_owned())),
        _ => Err("KEY=VALUE is needed, such as sprags.inner_arcs[1].radius_mm=4.1 or r_i2_mm=4.1".to_owned()),
    }
}

/// A number, for flags that say its unit.
fn number(text: &str) -> Result<f64, String> {
    let bare = || "a number is needed, with a point and without its unit, such as 1800 or 0.5".to_owned();
    text.trim().parse::<f64>().map_err(|_| bare())
}

/// A finite number above zero, for flags.
fn positive(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if value.is_finite() && value > 0.0 => Ok(value),
        Ok(_) => Err("a finite number above zero is needed".to_owned()),
        Err(_) => Err("not a number".to_owned()),
    }
}

#[cfg(test)]
mod tests;
