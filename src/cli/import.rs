//! `import`: a drawn or measured sprag as a design file.

use super::exit::{Exit, Failure};
use super::left_out::LeftOut;
use super::origin::{Kind, WRITTEN_BY};
use super::output::VERSION;
use super::parts::Answer;
use super::{Context, output, positive};
use crate::design::{Design, MOST_TABLE, read_text, with_keys, with_sprag};
use crate::import::{Arcs, Drawn, STANDARD_ERROR, Sprag, Wanted, read_dxf, read_points, sprag};
use crate::report::{Cell, Column, Table, Unit};
use clap::Args;
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

const EXAMPLES: &str = "\
Examples:
  sprag-design import sprag.dxf --template mine.toml -o new.toml
  sprag-design import measured.csv --template mine.toml --arcs 2 -o new.toml
  sprag-design import sprag.dxf --inner-radius 20 --outer-radius 28.33

Reads the closed outline of one sprag: lines, arcs, polylines with bulges and splines of a DXF (text form, mm; inches are
converted), or a table of x, y in mm, one point a line, in order round it. It may lie anywhere, turned, and turned over.
The outline is cut at its four corners. The straighter two sides are the flanks, the others are fitted by tangent arcs;
a logarithmic spiral is approximated by them, to --deviation-um if given. Races, count, materials and limits are those of
the template; an optimize table in it is left out, since its variables belong to another sprag.

How many points: the radius of an arc that spans phi rad, seen by N points with noise s, has the standard error
26.8 s/(sqrt(N) phi^2). With 5 um of noise and 1.2 rad, 2 um need 2200 points; 0.12 rad would need 22 million. Short arcs are
not known from a measurement; their standard errors are printed.";

/// The template if none is named.
const TEMPLATE: &str = include_str!("../../designs/starter.toml");
/// Its name.
const TEMPLATE_NAME: &str = "designs/starter.toml";
/// A radius less well known than this is said to be so, m.
const UNSURE_M: f64 = 2e-6;

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
    /// Design file with races, count, materials and limits [default: that of designs/starter.toml]
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
}

/// Run the command.
///
/// # Errors
/// [`Failure`].
pub fn run(args: &ImportArgs, context: &Context) -> Result<Exit, Failure> {
    let inputs: Vec<&Path> =
        std::iter::once(&args.file).chain(&args.template).map(PathBuf::as_path).collect();
    let others: Vec<_> = args.output.iter().map(|path| (path.as_path(), Kind::Design)).collect();
    context.outputs.check(&inputs, &others)?;
    context.outputs.refuse_foreign()?;
    if context.outputs.report.is_some() {
        return Err(Failure::malformed(
            "--report has no meaning with import: write the design with -o, then check NEW.toml --report",
        ));
    }
    let refused = |e| Failure::Malformed(miette::Report::new(e));
    let template = match &args.template {
        Some(path) => Design::read(path),
        None => Design::parse(TEMPLATE, TEMPLATE_NAME),
    }
    .map_err(refused)?;
    let tracks: Vec<(&str, f64)> =
        [("races.inner_radius_mm", args.inner_radius), ("races.outer_radius_mm", args.outer_radius)]
            .into_iter()
            .filter_map(|(key, value)| Some((key, value?)))
            .collect();
    let started = Instant::now();
    let named = |why: String| Failure::malformed(format!("{}: {why}", args.file.display()));
    let text = read_text(&args.file, MOST_TABLE).map_err(|e| named(e.to_string()))?;
    let is_dxf = args.file.extension().is_some_and(|e| e.eq_ignore_ascii_case("dxf"));
    let drawn = if is_dxf { read_dxf(&text, args.layer.as_deref()) } else { read_points(&text) };
    let drawn = drawn.map_err(|e| named(e.to_string()))?;
    let made = template.as_made().map_err(refused)?.races;
    let track = |given: Option<f64>, own_m: f64| given.map_or(own_m, |mm| 1e-3 * mm);
    let wanted = Wanted {
        tracks_m: [
            track(args.inner_radius, made.inner_radius_m),
            track(args.outer_radius, made.outer_radius_m),
        ],
        arcs: args.arcs.map(usize::from),
        deviation_m: args.deviation_um.map(|um| 1e-6 * um),
        swap: args.swap,
    };
    let found = sprag(&drawn, &wanted).map_err(|e| named(e.to_string()))?;
    let source = with_sprag(
        &template.source,
        found.outer_radius_m,
        found.centre_distance_m,
        &found.inner_arcs,
        &found.flanks,
    )
    .and_then(|source| with_keys(&source, &tracks))
    .map_err(|e| Failure::malformed(format!("the template: {e}")))?;
    let on = args.template.as_ref().map_or(TEMPLATE_NAME.to_owned(), |path| path.display().to_string());
    let source = format!("{}{source}", head(&on, &found, args, context));
    let folder = args.template.as_deref().and_then(Path::parent).unwrap_or(Path::new(""));
    let design = Design::parse_in(folder, &source, "the imported design").map_err(refused)?;
    let run_time_s = started.elapsed().as_secs_f64();

    let written = match &args.output {
        Some(path) => context.outputs.write(path, Kind::Design, source.as_bytes()).then_some(path),
        None => None,
    };
    let table = table(&found);
    context.outputs.write_csv(&table);
    let answer = Answer {
        design: &design,
        run_time_s,
        left_out: vec![LeftOut::new(
            "edges and chamfers",
            "points within some 2 deg of a corner, seen from the middle, are not fitted",
            "none on the working surfaces",
        )],
        error_estimate: Some(json!({
            "rms_um": worst(&found, |a| a.rms_m),
            "max_um": worst(&found, |a| a.max_m),
        })),
        body: json!({
            "written": written.map(|path| path.display().to_string()),
            "template": on,
            "said": said(&drawn, &found, args),
            "inner": side_json(&found.inner),
            "outer": side_json(&found.outer),
            "sprags": {
                "outer_radius_mm": 1e3 * found.outer_radius_m,
                "centre_distance_mm": 1e3 * found.centre_distance_m,
                "inner_arcs": found.inner_arcs.iter()
                    .map(|(r, until)| json!({ "radius_mm": 1e3 * r, "until_rad": until })).collect::<Vec<_>>(),
                "flanks": {
                    "rear_mm": 1e3 * found.flanks.rear_m, "front_mm": 1e3 * found.flanks.front_m,
                    "rear_tilt_rad": found.flanks.rear_tilt_rad, "front_tilt_rad": found.flanks.front_tilt_rad,
                },
            },
        }),
    };
    answer.print(context)?;
    let mut people = format!("{}\n", table.to_text(context.screen));
    for line in said(&drawn, &found, args) {
        let _ = writeln!(people, "{line}");
    }
    let _ = match written {
        Some(path) => writeln!(people, "written to {}, on the template {on}", output::path_text(path)),
        None => writeln!(people, "no design written: name a file with -o; template {on}"),
    };
    context.answer(&people)?;
    Ok(Exit::Held)
}

fn head(on: &str, found: &Sprag, args: &ImportArgs, context: &Context) -> String {
    format!(
        "{WRITTEN_BY} import {VERSION} from {:?} on the template {on:?}\n# by: {}\n# Farthest point {:.2} um from the inner \
         arcs, {:.2} um from the outer arc; rms {:.2} and {:.2} um. Races, spring, limits are the template's.\n#\n",
        args.file.display().to_string(),
        context.command_line,
        1e6 * found.inner.max_m,
        1e6 * found.outer.max_m,
        1e6 * found.inner.rms_m,
        1e6 * found.outer.rms_m,
    )
}

/// What the reader of the numbers should know, a line each.
fn said(drawn: &Drawn, found: &Sprag, args: &ImportArgs) -> Vec<String> {
    let mut lines = drawn.said.clone();
    if args.template.is_none() {
        lines.push(format!(
            "no --template: races, count, spring, friction and limits are those of {TEMPLATE_NAME}"
        ));
    }
    if found.mirrored {
        lines
            .push("the drawing was turned over: it shows a clutch that locks the other way round".to_owned());
    }
    if found.behind > 0 {
        lines.push(format!("inner arcs that lie behind first contact and are left out: {}", found.behind));
    }
    lines.push(format!(
        "end of the profile, {:.4} rad: chosen, 2 % before the flanks cut it; set until_rad of the last arc to what is ground",
        found.inner_arcs.last().map_or(0.0, |a| a.1)
    ));
    let off = found.inner.max_m;
    if let Some(asked) = args.deviation_um.map(|um| 1e-6 * um).filter(|asked| off > *asked) {
        lines.push(format!(
            "the deviation asked for, {:.3} um, is not reached with {} arcs: the farthest point is {:.3} um off",
            1e6 * asked,
            found.inner.arcs.len(),
            1e6 * off
        ));
    }
    let sides = [("inner arc", &found.inner), ("outer arc", &found.outer)];
    for (name, k, arcs) in sides.iter().flat_map(|(n, a)| (0..a.arcs.len()).map(move |k| (n, k, a))) {
        let arc = &arcs.arcs[k];
        if arc.radius_error_m > UNSURE_M {
            let points = (STANDARD_ERROR * arcs.rms_m / (UNSURE_M * arc.span_rad.powi(2))).powi(2);
            lines.push(format!(
                "{name} {}: the radius is known to {:.1} um (standard error) from {} points over {:.3} rad; 2 um need some {:.0e} \
                 points on it",
                k + 1,
                1e6 * arc.radius_error_m,
                arc.points,
                arc.span_rad,
                points.max(1.0)
            ));
        }
    }
    lines
}

fn worst(found: &Sprag, of: fn(&Arcs) -> f64) -> f64 {
    1e6 * of(&found.inner).max(of(&found.outer))
}

fn table(found: &Sprag) -> Table {
    let mut table = Table::new(vec![
        Column::text("surface", "Surface"),
        Column::number("radius_mm", "Radius", Unit::Millimetre, 7),
        Column::number("radius_standard_error_um", "Standard error", Unit::Micrometre, 3),
        Column::number("span_rad", "Spans", Unit::Radian, 4),
        Column::number("points", "Points", Unit::One, 6),
        Column::number("max_um", "Farthest", Unit::Micrometre, 4),
        Column::number("rms_um", "rms", Unit::Micrometre, 4),
    ]);
    for (name, side) in [("inner arc", &found.inner), ("outer arc", &found.outer)] {
        for (k, arc) in side.arcs.iter().enumerate() {
            table.row(vec![
                if name == "outer arc" { name.into() } else { format!("{name} {}", k + 1).into() },
                arc.radius_m.into(),
                arc.radius_error_m.into(),
                arc.span_rad.into(),
                Cell::Count(arc.points),
                side.max_m.into(),
                side.rms_m.into(),
            ]);
        }
    }
    table
}

fn side_json(side: &Arcs) -> Value {
    let arc = |a: &crate::import::Arc| {
        json!({
            "radius_mm": 1e3 * a.radius_m,
            "radius_standard_error_um": 1e6 * a.radius_error_m,
            "centre_mm": [1e3 * a.centre_m.x, 1e3 * a.centre_m.y],
            "span_rad": a.span_rad,
            "points": a.points,
        })
    };
    json!({
        "max_um": 1e6 * side.max_m,
        "rms_um": 1e6 * side.rms_m,
        "arcs": side.arcs.iter().map(arc).collect::<Vec<_>>(),
    })
}
