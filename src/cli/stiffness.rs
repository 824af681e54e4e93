//! `stiffness`: the static curve, for one contact law or several side by side.

use super::exit::{Exit, Failure};
use super::{Context, positive};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  sprag-design stiffness designs/huang2017-multi-arc.toml
  sprag-design stiffness designs/huang2017-multi-arc.toml --torques 3.34,16.8,50
  sprag-design stiffness designs/huang2017-multi-arc.toml --contact roller,hertz,slice --max-torque 50 --report laws.html";

/// Contact laws by their names in the design file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ContactName {
    /// Roller law, coefficient of the design (or 3.944e-5, mm and N)
    Roller,
    /// Roller law with the coefficient of DIN 26281
    Din26281,
    /// Logarithmic line contact, knows the radius
    Hertz,
    /// Slice method (1)-(4)
    Slice,
}

/// Arguments of `stiffness`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct StiffnessArgs {
    /// Design file (TOML)
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Contact laws to compare, comma separated [default: the design's]
    #[arg(long, value_name = "LAW,...", value_enum, value_delimiter = ',')]
    pub contact: Vec<ContactName>,
    /// Torques of the table, Nm, comma separated
    #[arg(long, value_name = "NM,...", value_parser = positive, value_delimiter = ',', conflicts_with = "max_torque")]
    pub torques: Vec<f64>,
    /// Largest torque of an even table, Nm [default: the design's peak torque]
    #[arg(long, value_name = "NM", value_parser = positive)]
    pub max_torque: Option<f64>,
}

/// Run the command.
///
/// # Errors
/// [`Failure`].
pub fn run(args: &StiffnessArgs, context: &Context) -> Result<Exit, Failure> {
    context.outputs.check(&args.file, &[])?;
    Err(Failure::Failed("stiffness is not wired yet".into()))
}
