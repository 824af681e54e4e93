//! `export`: the design for other programs, and their results read back.

mod deck;
mod fmu;
mod geometry;
mod result;

use super::exit::{Exit, Failure};
use super::origin::FileKind;
use super::{Context, Run, positive};
use crate::export::Part;
use crate::export::calculix::Variant;
use crate::export::fmu::Fmi;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  sprag-design export designs/starter.toml --format dxf -o sprag.dxf
  sprag-design export designs/starter.toml --format step --part clutch -o clutch.step
  sprag-design export designs/starter.toml --format svg --part clutch -o clutch.svg
  sprag-design export designs/starter.toml --format csv -o arcs.csv
  sprag-design export designs/starter.toml --format csv --table points --deviation-mm 0.001 -o points.csv
  sprag-design export designs/huang2017-single-arc.toml --format calculix --torque 26.8 -o clutch.inp
  ccx -i clutch
  sprag-design export designs/huang2017-single-arc.toml --format calculix --read clutch.dat --torques 3.34,10,16.8
  sprag-design export designs/huang2017-multi-arc.toml --format calculix --variant solid --mesh 0.05 -o solid.inp
  sprag-design export designs/starter.toml --format fmu -o clutch.fmu

Drawings, solids and tables are in mm, at first contact without load, as made: before press fits, at the reference temperature.
A sprag has its origin in C_e, y outward; races and clutch lie about the axis O. Seen so, the clutch engages when the inner race
turns counterclockwise against the outer one. dxf: release 12, closed polylines with bulges for exact arcs, layers SPRAG, RACES,
CENTRES, CENTRE_LINES, ARC_ENDS, TEXT. step: AP214, prisms with square ends; the clutch is an assembly.

fmu: the clutch between two flanges, torques in, motion out, for co-simulation. It needs the library that goes inside: the release
archive has it beside the program, Python's wheel and `cargo install` have not; fmu/build.sh of the source builds it, with Rust's
cargo. It serves both versions of FMI, on the platform that it was built on. A [[drivetrain]] does not go along: it is refused, or
left out by --clutch-alone.

A deck holds one sector, meshed, and needs nothing else. CalculiX: apt-get install calculix-ccx.";

/// Formats.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Drawing, true arcs on named layers
    Dxf,
    /// Solid for CAD, true cylinders
    Step,
    /// Drawing at full size, true arcs
    Svg,
    /// Table of arcs, or of points on them
    Csv,
    /// Finite-element deck of one sector for CalculiX
    Calculix,
    /// Unit for co-simulation (FMI)
    Fmu,
}

impl Format {
    fn kind(self) -> FileKind {
        match self {
            Self::Dxf => FileKind::Dxf,
            Self::Step => FileKind::Step,
            Self::Svg => FileKind::Svg,
            Self::Csv => FileKind::Table,
            Self::Calculix => FileKind::Deck,
            Self::Fmu => FileKind::Unit,
        }
    }

    fn name(self) -> String {
        self.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
    }
}

/// Tables by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum TableName {
    /// Centre, radius, angles and ends of every arc and flank
    Arcs,
    /// Points on the surfaces
    Points,
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
    /// dxf, step, svg, csv: which part [default: sprag]
    #[arg(long, value_enum)]
    pub part: Option<Part>,
    /// csv: which table [default: arcs]
    #[arg(long, value_enum)]
    pub table: Option<TableName>,
    /// csv, points: the most that a chord between two points leaves its arc, mm [default: 0.001]
    #[arg(long, value_name = "MM", allow_hyphen_values = true, value_parser = positive)]
    pub deviation_mm: Option<f64>,
    /// fmu: version of FMI [default: 2]
    #[arg(long, value_enum)]
    pub fmi: Option<Fmi>,
    /// fmu: the library that fmu/build.sh has built [default: looked for beside this program]
    #[arg(long, value_name = "PATH")]
    pub library: Option<PathBuf>,
    /// fmu: leave `[[drivetrain]]` out, where the design has one; the other program has what lies beyond the flanges
    #[arg(long)]
    pub clutch_alone: bool,
    /// calculix: where the material is held along the axis [default: layer]
    #[arg(long, value_enum)]
    pub variant: Option<Variant>,
    /// calculix: spacing of the mesh at the contacts, mm [default: 0.025]
    #[arg(long, value_name = "MM", allow_hyphen_values = true, value_parser = positive)]
    pub mesh: Option<f64>,
    /// calculix: torque to be reached, Nm [default: the design's nominal torque]
    #[arg(long, value_name = "NM", allow_hyphen_values = true, value_parser = positive)]
    pub torque: Option<f64>,
    /// calculix: increments of the turning step [default: 12, more where the contacts travel far]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub increments: Option<usize>,
    /// calculix: coefficient of friction of the deck; it is to stick, the design's own is not used [default: 0.3]
    #[arg(long, value_name = "MU", allow_hyphen_values = true, value_parser = positive)]
    pub friction: Option<f64>,
    /// calculix: read this result of ccx instead of writing; the deck is looked for beside it, as .inp
    #[arg(long, value_name = "RESULT.dat")]
    pub read: Option<PathBuf>,
    /// calculix: torques at which the result is read, Nm, comma separated [default: every increment]
    #[arg(long, value_name = "NM,...", allow_hyphen_values = true, value_parser = positive, value_delimiter = ',', requires = "read")]
    pub torques: Vec<f64>,
}

impl Run for ExportArgs {
    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        refuse_meaningless(self)?;
        let inputs: Vec<_> = std::iter::once(&self.file)
            .chain(&self.read)
            .chain(&self.library)
            .map(PathBuf::as_path)
            .collect();
        let others: Vec<_> = self.output.iter().map(|path| (path.as_path(), self.format.kind())).collect();
        context.outputs.check(&inputs, &others)?;
        let design = context.design(&self.file)?;
        match (&self.read, self.format) {
            (Some(dat), _) => result::run(&design, dat, &self.torques, context),
            (None, Format::Calculix) => deck::run(&design, self, context),
            (None, Format::Fmu) => fmu::run(&design, self, context),
            (None, _) => geometry::run(&design, self, context),
        }
    }
}

/// Refuse flags that mean nothing to the format.
fn refuse_meaningless(args: &ExportArgs) -> Result<(), Failure> {
    let deck = args.format == Format::Calculix;
    let unit = args.format == Format::Fmu;
    let points = args.table == Some(TableName::Points);
    let given = [
        ("part", args.part.is_some(), !deck && !unit, "dxf, step, svg, csv"),
        ("table", args.table.is_some(), args.format == Format::Csv, "csv"),
        ("deviation-mm", args.deviation_mm.is_some(), points, "csv with --table points"),
        ("fmi", args.fmi.is_some(), unit, "fmu"),
        ("library", args.library.is_some(), unit, "fmu"),
        ("clutch-alone", args.clutch_alone, unit, "fmu"),
        ("variant", args.variant.is_some(), deck, "calculix"),
        ("mesh", args.mesh.is_some(), deck, "calculix"),
        ("torque", args.torque.is_some(), deck, "calculix"),
        ("increments", args.increments.is_some(), deck, "calculix"),
        ("friction", args.friction.is_some(), deck, "calculix"),
        ("read", args.read.is_some(), deck, "calculix"),
    ];
    match given.into_iter().find(|(_, given, means, _)| *given && !means) {
        Some((flag, _, _, of)) => Err(Failure::malformed(format!(
            "--{flag} has no meaning here (--format {}): it belongs to --format {of}; leave it out",
            args.format.name()
        ))),
        None => Ok(()),
    }
}
