//! `simulate`: one scenario in time.

use super::exit::{Exit, Failure};
use super::{Context, positive};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  sprag-design simulate designs/huang2017-multi-arc.toml --scenario high-10
  sprag-design simulate designs/huang2017-multi-arc.toml --scenario high-10 --csv history.csv --report high-10.html
  sprag-design simulate designs/huang2017-multi-arc.toml --scenario high-10 --method published --step 2e-6";

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
    /// Fixed step, s (for the event method: its largest step) [default: chosen by the method]
    #[arg(long, value_name = "S", value_parser = positive)]
    pub step: Option<f64>,
    /// Relative error allowed per step, pure number [default: chosen by the method]
    #[arg(long, value_name = "X", value_parser = positive)]
    pub tolerance: Option<f64>,
    /// Leave no term out, however small
    #[arg(long)]
    pub full: bool,
}

/// Run the command.
///
/// # Errors
/// [`Failure`].
pub fn run(args: &SimulateArgs, context: &Context) -> Result<Exit, Failure> {
    context.outputs.check(&args.file, &[])?;
    Err(Failure::Failed("simulate is not wired yet".into()))
}
