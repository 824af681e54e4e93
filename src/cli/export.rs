//! `export`: the design for other programs, and their results read back.

mod result;

use super::exit::{Exit, Failure};
use super::origin::Kind;
use super::{Context, output, parts, positive};
use crate::design::Design;
use crate::export::calculix::{Options, Variant, deck};
use crate::margin::NoMargins;
use crate::profile::Outline;
use crate::scenario::place_profile;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  sprag-design export designs/huang2017-single-arc.toml --format calculix --torque 26.8 -o clutch.inp
  ccx -i clutch
  sprag-design export designs/huang2017-single-arc.toml --format calculix --read clutch.dat --torques 3.34,10,16.8
  sprag-design export designs/huang2017-multi-arc.toml --format calculix --variant solid --mesh 0.05 -o solid.inp

The deck holds one sector, meshed, and needs nothing else. CalculiX: apt-get install calculix-ccx.";

/// Layers along half a sprag's length in a solid deck.
const SOLID_LAYERS: usize = 4;

/// Formats.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Finite-element deck of one sector for CalculiX
    Calculix,
}

/// Variants of the deck by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum VariantName {
    /// No strain along the axis; races as long as the sprag
    PlaneStrain,
    /// No stress along the axis; races as long as the sprag
    PlaneStress,
    /// Plane in the middle of the sprag, free at its ends, one layer; races as long as the sprag
    Layer,
    /// Several layers, races as wide as designed; minutes become hours unless --mesh is coarse
    Solid,
}

/// Arguments of `export`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct ExportArgs {
    /// Design file (TOML)
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// What to write
    #[arg(long, value_enum)]
    pub format: Format,
    /// The file to write [default: standard output]
    #[arg(short, long, value_name = "PATH", conflicts_with = "read")]
    pub output: Option<PathBuf>,
    /// Where the material is held along the axis
    #[arg(long, value_enum, default_value_t = VariantName::Layer)]
    pub variant: VariantName,
    /// Spacing of the mesh at the contacts, mm
    #[arg(long, value_name = "MM", allow_hyphen_values = true, value_parser = positive, default_value = "0.025")]
    pub mesh: f64,
    /// Torque to be reached, Nm [default: the design's nominal torque]
    #[arg(long, value_name = "NM", allow_hyphen_values = true, value_parser = positive)]
    pub torque: Option<f64>,
    /// Increments of the turning step [default: 12, more where the contacts travel far]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub increments: Option<usize>,
    /// Coefficient of friction of the deck; it is to stick, the design's own is not used
    #[arg(long, value_name = "MU", allow_hyphen_values = true, value_parser = positive, default_value = "0.3")]
    pub friction: f64,
    /// Read this result of ccx instead of writing; the deck is looked for beside it, as .inp
    #[arg(long, value_name = "RESULT.dat")]
    pub read: Option<PathBuf>,
    /// Torques at which the result is read, Nm, comma separated [default: every increment]
    #[arg(long, value_name = "NM,...", allow_hyphen_values = true, value_parser = positive, value_delimiter = ',', requires = "read")]
    pub torques: Vec<f64>,
}

/// Run the command.
///
/// # Errors
/// [`Failure`].
pub fn run(args: &ExportArgs, context: &Context) -> Result<Exit, Failure> {
    let inputs: Vec<_> = std::iter::once(&args.file).chain(&args.read).map(PathBuf::as_path).collect();
    let others: Vec<_> = args.output.iter().map(|path| (path.as_path(), Kind::Deck)).collect();
    context.outputs.check(&inputs, &others)?;
    let design = parts::read_design(&args.file, context)?;
    if let Some(dat) = &args.read {
        return result::run(&design, dat, &args.torques, context);
    }
    if context.json || context.outputs.csv.is_some() || context.outputs.report.is_some() {
        return Err(Failure::malformed("a deck is neither JSON, table nor page: those come with --read"));
    }
    let text = text(&design, args)?;
    match &args.output {
        Some(path) => {
            if context.outputs.write(path, Kind::Deck, text.as_bytes()) {
                context.message(&format!(
                    "{}: {} variant, {:.1} MB; next: ccx -i {}",
                    path.display(),
                    variant(args.variant).name(),
                    text.len() as f64 * 1e-6,
                    path.with_extension("").display()
                ));
            }
        }
        None => output::print(&text)?,
    }
    Ok(Exit::Held)
}

fn variant(name: VariantName) -> Variant {
    match name {
        VariantName::PlaneStrain => Variant::PlaneStrain,
        VariantName::PlaneStress => Variant::PlaneStress,
        VariantName::Layer => Variant::Layer,
        VariantName::Solid => Variant::Solid { layers: SOLID_LAYERS },
    }
}

fn text(design: &Design, args: &ExportArgs) -> Result<String, Failure> {
    let clutch = &design.clutch;
    let torque_nm = args
        .torque
        .or(design.limits.nominal_torque_nm)
        .ok_or_else(|| Failure::malformed("--torque is needed: the design names no nominal torque"))?;
    let profile = place_profile(clutch).map_err(|e| parts::no_clutch(&args.file, &NoMargins::Profile(e)))?;
    let outline = match clutch.sprags.flanks {
        Some(flanks) => Outline::closed(&profile, &flanks),
        None => Outline::narrowest(&profile),
    }
    .map_err(|e| parts::no_clutch(&args.file, &NoMargins::Outline(e)))?;
    let options = Options {
        variant: variant(args.variant),
        mesh_m: 1e-3 * args.mesh,
        torque_nm,
        friction: args.friction,
        increments: args.increments,
        ..Options::default()
    };
    deck(clutch, &profile, &outline, &options, &design.hash)
        .map_err(|e| Failure::malformed(format!("{}: no deck: {e}", args.file.display())))
}
