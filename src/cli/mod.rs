//! The command line: the only room that knows paths, prints, and sets the exit code.
//!
//! In: arguments, a design file. Out: text or one JSON object on standard output, files, messages on standard error.
//! Absent: physics, units (`report` changes them), allowables (`margin` has them).
//! Equations: none.

mod accuracy;
mod check;
mod choices;
mod clock;
mod command_line;
mod compare;
mod context;
mod evaluate;
mod evaluate_points;
pub mod exit;
mod explain;
mod export;
mod feed;
mod histories;
mod identify;
mod import;
mod interrupt;
pub mod journal;
mod life;
mod lists;
mod made;
mod map;
mod new;
mod optimize;
mod origin;
pub mod output;
mod overrun;
mod progress;
mod reengage;
mod resonance;
mod sample;
mod sharing;
mod sheet;
mod simulate;
mod stiffness;
mod studio;
mod sweep;

use crate::answer::explanation::listed;
use clap::{Args, CommandFactory, FromArgMatches, Parser, Subcommand};
use command_line::missing_value;
use context::{Common, Context};
use exit::{Exit, Failure};
use serde_json::json;
use std::ffi::OsString;
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
  130 stopped by Ctrl-C; what had been found is written by optimize, identify, simulate, accuracy, reengage, feed,
      sharing --scenario and resonance (amplitudes that are done), nothing by the others (studio: 0, Ctrl-C is how it ends)
  141 the reader of the answers of evaluate has gone before the last

A file that is there already is replaced only if this tool has written it (its first lines say so; of a table: the names of
its columns) and nobody goes on with it by hand, as with designs of new, size and the studio; --force replaces any.
What cannot be written costs no answer: it is printed, with exit code 3; a folder that is not there is refused first, with 2.
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

/// A command: its arguments, and what it does with them.
trait Run: Args {
    /// Common options that mean nothing to it, and why.
    const WITHOUT: Without = ("", &[]);
    /// Kinds of names, as `explain` has them, that its help lists.
    const NAMES: &[&str] = &[];

    /// Run the command.
    fn run(&self, context: &Context) -> Result<Exit, Failure>;
}

/// Why options mean nothing to a command, and which.
type Without = (&'static str, &'static [&'static str]);

/// The commands in the order of the help: what each does in a line, its name, its arguments.
macro_rules! commands {
    ($($(#[$($about:tt)+])+ $name:ident($args:ty),)+) => {
        #[derive(Debug, Subcommand)]
        enum Command {
            $($(#[$($about)+])+ $name($args),)+
        }

        impl Command {
            fn run(&self, context: &Context) -> Result<Exit, Failure> {
                match self {
                    $(Self::$name(args) => args.run(context),)+
                }
            }
        }

        /// What means nothing to the command of that name, and the kinds of names that its help lists.
        fn of_command(command: &str) -> (Without, &'static [&'static str]) {
            $(if command.eq_ignore_ascii_case(stringify!($name)) {
                return (<$args as Run>::WITHOUT, <$args as Run>::NAMES);
            })+
            (("", &[]), &[])
        }
    };
}

commands! {
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
    /// Strokes of an indexing drive: what each feeds, up to which frequency
    Feed(feed::FeedArgs),
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
    Size(new::SizeArgs),
    /// Find unknown parameters from measured or published numbers, and what these cannot tell apart
    Identify(identify::IdentifyArgs),
    /// Write the design as a drawing (DXF, SVG), a solid (STEP), a table of arcs, a CalculiX deck or a co-simulation unit (FMU)
    Export(export::ExportArgs),
    /// A drawn or measured sprag (DXF, or a table of points) as a design file
    Import(import::ImportArgs),
    /// What a limit, a key, a variable or another name means, and what moves it
    Explain(explain::ExplainArgs),
    /// List the steels that a design may name, with their constants, allowed stresses and sources
    Materials(lists::MaterialsArgs),
    /// List the oils and greases that a design may name, with viscosities and sources
    Oils(lists::OilsArgs),
    /// Print the JSON Schema of the design file
    Schema(lists::SchemaArgs),
    /// Print a completion script for a shell
    Completions(lists::CompletionsArgs),
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
    let named = |matches: clap::ArgMatches| {
        Ok((Cli::from_arg_matches(&matches)?, matches.subcommand_name().unwrap_or_default().to_owned()))
    };
    let (cli, name) = match parsed.and_then(named) {
        Ok(cli) => cli,
        Err(e) if e.use_stderr() => {
            // The message repeats what was typed.
            let message = e.render().to_string();
            if args.iter().take_while(|arg| *arg != "--").any(|arg| arg == "--json") {
                let refused = json!({ "error": { "message": message.trim_end() } });
                let _ = output::print_json(&output::signed(refused));
            }
            output::note(message.trim_end());
            return Exit::Malformed;
        }
        Err(help_or_version) => {
            let _ = help_or_version.print();
            return Exit::Held;
        }
    };
    let json = cli.common.json;
    exit::keep_names_whole();
    match dispatch(cli, &name, &args) {
        Ok(exit) => exit,
        Err(failure) => {
            if json {
                // Standard output may be what has failed; standard error says it in words.
                let _ = output::print_json(&output::signed(json!({ "error": failure.to_json() })));
            }
            tell(&failure);
            failure.exit()
        }
    }
}

/// A failure in words on standard error.
fn tell(failure: &Failure) {
    match failure {
        Failure::Malformed(report) => output::note_painted(&format!("{report:?}")),
        Failure::Failed(text) | Failure::NoClutch(text) => output::note(&format!("error: {text}")),
        Failure::Interrupted => output::note("stopped"),
        Failure::Several(all) => all.iter().for_each(tell),
    }
}

/// The command line with its help: each command shows only the options that mean something to it.
fn command() -> clap::Command {
    let root = Cli::command();
    let common: Vec<clap::Arg> = root.get_arguments().filter(|a| a.is_global_set()).cloned().collect();
    let folded = |command: clap::Command| {
        let names = match of_command(command.get_name()).1 {
            [] => String::new(),
            kinds => format!("\n\nNames, which `explain` explains:\n\n{}", listed(kinds)),
        };
        let after = command.get_after_help().map(|text| in_paragraphs(&text.to_string()) + names.trim_end());
        after.into_iter().fold(command, |command, text| command.after_help(text))
    };
    let hidden = |command: clap::Command| {
        let options = of_command(command.get_name()).0.1;
        let hidden = common.iter().filter(|a| options.contains(&a.get_id().as_str()));
        let hidden: Vec<clap::Arg> = hidden.map(|a| a.clone().hide(true)).collect();
        command.args(hidden)
    };
    folded(root.mut_subcommands(|command| folded(hidden(command))))
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

fn dispatch(cli: Cli, name: &str, args: &[String]) -> Result<Exit, Failure> {
    let (why, options) = of_command(name).0;
    // --force, --threads and --quiet, which then change nothing, are let pass.
    if let Some(flag) = cli.common.answers().into_iter().flatten().find(|flag| options.contains(flag)) {
        return Err(Failure::malformed(format!("--{flag} has no meaning with {name}: {why}")));
    }
    let context = Context::new(cli.common, args)?;
    let exit = cli.command.run(&context)?;
    Ok(if context.outputs.unwritten().is_empty() { exit } else { Exit::Failed })
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
