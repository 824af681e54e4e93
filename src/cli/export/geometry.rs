//! A design as a drawing, a solid or a table of its arcs.

use super::{ExportArgs, Format, TableName};
use crate::answer::exported::{Exported, arcs_table, points_table};
use crate::cli::exit::{Exit, Failure};
use crate::cli::{Context, output};
use crate::design::Design;
use crate::export::rows::{arcs, points};
use crate::export::{DrawnClutch, NoPart, Part, dxf::dxf, step::step, svg::svg};
use crate::margin::NoMargins;
use std::time::Instant;

/// Smallest deviation of points, mm: a hundredth of what a length standard resolves, and file sizes stay bounded.
const LEAST_DEVIATION_MM: f64 = 1e-5;
/// Deviation of points if none is asked for, mm.
const DEVIATION_MM: f64 = 1e-3;
pub(super) fn run(design: &Design, args: &ExportArgs, context: &Context) -> Result<Exit, Failure> {
    let deviation_mm = args.deviation_mm.unwrap_or(DEVIATION_MM);
    if deviation_mm < LEAST_DEVIATION_MM {
        return Err(Failure::malformed(format!(
            "--deviation-mm {deviation_mm}: found less than {LEAST_DEVIATION_MM} mm, at least that is needed; for exact arcs \
             take --format dxf, step, or csv with --table arcs"
        )));
    }
    if context.outputs.csv.is_some() || context.outputs.report.is_some() {
        return Err(Failure::malformed(
            "--csv and --report have no meaning here: a table comes with --format csv -o, a page with check --report",
        ));
    }
    if context.json && args.output.is_none() && args.format != Format::Csv {
        return Err(Failure::malformed("--json needs -o: the file cannot go to standard output as well"));
    }
    let started = Instant::now();
    let part = args.part.unwrap_or(Part::Sprag);
    let listed = args.format == Format::Csv && args.table != Some(TableName::Points) && part == Part::Sprag;
    let made = design.made_clutch();
    let made = made.and_then(|made| if listed { Ok(made) } else { made.closed(part).map(|()| made) });
    let made = made.map_err(|why| match why {
        NoPart::Refused(refused) => refused.into(),
        NoPart::Profile(e) => Failure::no_clutch(&args.file, &NoMargins::Profile(e)),
        NoPart::Outline(e) => Failure::no_clutch(&args.file, &NoMargins::Outline(e)),
        NoPart::Open { .. } => Failure::NoClutch(format!(
            "{}: {why}. Without flanks there are --part inner, --part outer and --format csv --table arcs",
            args.file.display()
        )),
    })?;
    let subject = made.drawn(design);
    let text = match args.format {
        Format::Dxf => dxf(part, &subject),
        Format::Svg => svg(part, &subject),
        Format::Step => step(part, &subject),
        Format::Csv | Format::Calculix | Format::Fmu => csv(part, &subject, args, deviation_mm)?,
    };
    let written = match &args.output {
        Some(path) => context.outputs.write(path, args.format.kind(), text.as_bytes()).then_some(path),
        None => None,
    };
    let run_time_s = started.elapsed().as_secs_f64();
    if args.output.is_none() && !context.json {
        output::print(&text)?;
    }
    let answer = Exported {
        design,
        subject: &subject,
        part,
        format: &args.format.name(),
        is_solid: args.format == Format::Step,
        bytes: text.len(),
    };
    if let Some(note) = answer.note() {
        context.message(&note);
    }
    let named = written.map(|path| path.display().to_string());
    context.print(&answer.envelope(run_time_s, named.as_deref()))?;
    if let Some(path) = written {
        context.message(&format!(
            "{}: {}, mm, {} arcs and flanks, {:.1} kB",
            path.display(),
            part.name(),
            arcs(part, &subject).len(),
            text.len() as f64 * 1e-3
        ));
    }
    Ok(Exit::Held)
}

fn csv(part: Part, subject: &DrawnClutch, args: &ExportArgs, deviation_mm: f64) -> Result<String, Failure> {
    let table = match args.table.unwrap_or(TableName::Arcs) {
        TableName::Arcs => arcs_table(&arcs(part, subject)),
        TableName::Points => points_table(&points(part, subject, 1e-3 * deviation_mm)),
    };
    let bytes = table.to_csv().map_err(|e| Failure::Failed(format!("CSV: {e}")))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
