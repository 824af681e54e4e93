//! `import`: a drawn or measured sprag as a design file.

use super::exit::{Exit, Failure};
use super::origin::FileKind;
use super::{Context, Run, positive};
use crate::answer::imported::{Imported, design_text, in_options, in_proportion};
use crate::design::Design;
use crate::file::{MOST_TABLE, as_guesses, foreign, read_text};
use crate::import::{DrawnUnit, NoImport, SpiralKind, Wanted, read_dxf, read_points, sprag};
use clap::builder::PossibleValue;
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};
use std::time::Instant;

const EXAMPLES: &str = "\
Examples:
  sprag-design import sprag.dxf --template mine.toml -o new.toml
  sprag-design import measured.csv --template mine.toml --arcs 2 -o new.toml
  sprag-design import sprag.dxf --inner-radius 20 --outer-radius 28.33
  sprag-design import sprag.dxf --template mine.toml --spiral constant-strut-angle -o new.toml

Reads the closed outline of one sprag: lines, arcs, polylines with bulges and splines of a DXF (text form, mm; inches are
converted), or a table of x, y in mm, one point a line, in order round it. It may lie anywhere, turned, and turned over.
The outline is cut at its four corners. The straighter two sides are the flanks, the others are fitted by tangent arcs;
beside them stand the two spirals through the same points from first contact on, the curve that keeps the strut angle between these races
and the logarithmic one, each with its deviation; --spiral writes one of them as [sprags.inner_spiral] in place of the arcs.
Races, count, materials and limits are those of the template; an optimize table in it is left out, since its variables belong
to another sprag. Without a template the design is named after the file and has no limits, run-out or scenes; races, count, spring,
friction and steel, as designs/starter.toml has them, are then guesses, and marked so: put in your own, and your limits.
A table of arcs as `export --format csv` writes it is read too.

How many points: the radius of an arc that spans phi rad, seen by N points with noise s, has the standard error
26.8 s/(sqrt(N) phi^2). With 5 um of noise and 1.2 rad, 2 um need 2200 points; 0.12 rad would need 22 million. Short arcs are
not known from a measurement; their standard errors are printed.";

/// Where the numbers come from that nobody gives, if no template is named.
const TEMPLATE: &str = include_str!("../../designs/starter.toml");
/// Its name.
const TEMPLATE_NAME: &str = "designs/starter.toml";
/// Arguments of `import`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct ImportArgs {
    /// Drawing (.dxf) or table of points (any other ending)
    #[arg(value_name = "PROFILE.dxf|PROFILE.csv")]
    pub file: PathBuf,
    /// Where to write the design file [default: it is not written]
    #[arg(long, short, value_name = "NEW.toml")]
    pub output: Option<PathBuf>,
    /// Design file with races, count, materials and limits [default: guesses as designs/starter.toml, and no limits]
    #[arg(long, value_name = "FILE")]
    pub template: Option<PathBuf>,
    /// Radius of the inner race's track, mm [default: the template's]
    #[arg(long, value_name = "MM", allow_hyphen_values = true, value_parser = positive)]
    pub inner_radius: Option<f64>,
    /// Radius of the outer race's track, mm [default: the template's]
    #[arg(long, value_name = "MM", allow_hyphen_values = true, value_parser = positive)]
    pub outer_radius: Option<f64>,
    /// Number of inner arcs, 1 to 6 [default: as many as the points ask for]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = clap::value_parser!(u8).range(1..=6))]
    pub arcs: Option<u8>,
    /// Add inner arcs until no point is farther off, um
    #[arg(long, value_name = "UM", allow_hyphen_values = true, value_parser = positive, conflicts_with = "arcs")]
    pub deviation_um: Option<f64>,
    /// Layer of the DXF that holds the outline [default: SPRAG if there is one, else all]
    #[arg(long, value_name = "NAME")]
    pub layer: Option<String>,
    /// Take the other curved side for the outer arc
    #[arg(long)]
    pub swap: bool,
    /// Write this spiral as [sprags.inner_spiral], in place of tangent arcs
    #[arg(long, value_name = "CURVE", value_enum, conflicts_with_all = ["arcs", "deviation_um"])]
    pub spiral: Option<SpiralKind>,
    /// Unit of the lengths in the file [default: what it names, else mm]
    #[arg(long, value_name = "UNIT", value_enum)]
    pub unit: Option<DrawnUnit>,
}

impl ValueEnum for SpiralKind {
    fn value_variants<'a>() -> &'a [Self] {
        &[Self::ConstantStrutAngle, Self::Logarithmic]
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.name()))
    }
}

impl ValueEnum for DrawnUnit {
    fn value_variants<'a>() -> &'a [Self] {
        &[Self::Millimetre, Self::Inch]
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.name()))
    }
}

impl ImportArgs {
    /// Tracks of the races as given, inner and outer, m.
    fn radii_m(&self) -> [Option<f64>; 2] {
        [self.inner_radius, self.outer_radius].map(|mm| mm.map(|mm| 1e-3 * mm))
    }

    /// What stands round the sprag where nobody says: guesses, under the name of the file that is read, and nothing that the sprag is
    /// held to.
    fn surroundings(&self) -> Result<String, Failure> {
        /// What a starter alone has.
        const ITS_OWN: [&str; 6] = [
            "limits",
            "check",
            "scenarios",
            "races.eccentricity",
            "races.inner_inertia_kg_m2",
            "races.outer_inertia_kg_m2",
        ];
        let name = self.file.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        let radii =
            [("races.inner_radius_mm", self.inner_radius), ("races.outer_radius_mm", self.outer_radius)];
        let given: Vec<&str> = radii.into_iter().filter_map(|(key, mm)| mm.map(|_| key)).collect();
        let text = as_guesses(TEMPLATE, &name, &ITS_OWN, &given, &format!("as {TEMPLATE_NAME}"));
        text.and_then(|text| in_proportion(&text, self.radii_m())).map_err(|e| Failure::Failed(e.to_string()))
    }
}

impl Run for ImportArgs {
    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        let inputs: Vec<&Path> =
            std::iter::once(&self.file).chain(&self.template).map(PathBuf::as_path).collect();
        let others: Vec<_> = self.output.iter().map(|path| (path.as_path(), FileKind::Design)).collect();
        context.outputs.check(&inputs, &others)?;
        context.outputs.refuse_foreign()?;
        if context.outputs.report.is_some() {
            return Err(Failure::malformed(
                "--report has no meaning with import: write the design with -o, then check NEW.toml --report",
            ));
        }
        let refused = |e| Failure::Malformed(miette::Report::new(e));
        let template = match &self.template {
            Some(path) => Design::read(path),
            None => Design::parse(&self.surroundings()?, TEMPLATE_NAME),
        }
        .map_err(refused)?;
        let radii_m = self.radii_m();
        let started = Instant::now();
        let named = |why: String| Failure::of(&self.file, why);
        let text = read_text(&self.file, MOST_TABLE).map_err(|e| named(e.to_string()))?;
        let is_dxf = self.file.extension().is_some_and(|e| e.eq_ignore_ascii_case("dxf"));
        if let (false, Some(kind)) = (is_dxf, foreign(&text)) {
            return Err(named(format!(
                "found {kind}; allowed: a DXF drawing with the ending .dxf, or a table of x, y (`export` writes both)"
            )));
        }
        let drawn = if is_dxf {
            read_dxf(&text, self.layer.as_deref(), self.unit)
        } else {
            read_points(&text, self.unit)
        };
        let told = |why: NoImport| named(in_options(&why.to_string()));
        let drawn = drawn.map_err(told)?;
        let made = template.as_made().map_err(refused)?.races;
        let [inner_m, outer_m] = radii_m;
        let wanted = Wanted {
            tracks_m: [inner_m.unwrap_or(made.inner_radius_m), outer_m.unwrap_or(made.outer_radius_m)],
            arcs: self.arcs.map(usize::from),
            deviation_m: self.deviation_um.map(|um| 1e-6 * um),
            swap: self.swap,
        };
        let found = sprag(&drawn, &wanted).map_err(told)?;
        let spiral = match self.spiral {
            None => None,
            Some(kind) => Some(*found.spirals.iter().find(|s| s.kind == kind).ok_or_else(|| {
                named(format!(
                    "its inner side does not begin as a {} spiral; leave --spiral out",
                    kind.name()
                ))
            })?),
        };
        let source = design_text(&template, &found, spiral.as_ref(), radii_m)
            .map_err(|e| Failure::malformed(format!("the template: {e}")))?;
        let on = self.template.as_ref().map_or(TEMPLATE_NAME.to_owned(), |path| path.display().to_string());
        let answer = Imported {
            drawn: &drawn,
            found: &found,
            template: &on,
            no_template: self.template.is_none(),
            deviation_m: wanted.deviation_m,
            written: spiral,
        };
        let file = self.file.display().to_string();
        let source = format!("{}{source}", answer.head(&file, &context.command_line));
        let folder = self.template.as_deref().and_then(Path::parent).unwrap_or(Path::new(""));
        let design = Design::parse_in(folder, &source, "the imported design").map_err(refused)?;
        let run_time_s = started.elapsed().as_secs_f64();

        let written = self
            .output
            .as_ref()
            .filter(|path| context.outputs.write(path, FileKind::Design, source.as_bytes()))
            .map(|path| path.display().to_string());
        context.outputs.write_csv(&answer.csv_table());
        context.print(&answer.envelope(&design, run_time_s, written.as_deref()))?;
        context.answer(&answer.text(written.as_deref(), context.screen))?;
        Ok(Exit::Held)
    }
}
