//! A design as a drawing, a solid or a table of its arcs.

use super::{ExportArgs, Format, TableName};
use crate::answer::exported::{DEVIATION_MM, Exported, LEAST_DEVIATION_MM, PartFormat};
use crate::cli::exit::{Exit, Failure};
use crate::cli::{Context, output};
use crate::design::Design;
use crate::export::rows::arcs;
use crate::export::{NoPart, Part};
use crate::margin::NoMargins;
use std::time::Instant;

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
    let format = match args.format {
        Format::Dxf => PartFormat::Dxf,
        Format::Svg => PartFormat::Svg,
        Format::Step => PartFormat::Step,
        Format::Csv | Format::Calculix | Format::Fmu => match args.table.unwrap_or(TableName::Arcs) {
            TableName::Arcs => PartFormat::Arcs,
            TableName::Points => PartFormat::Points { deviation_mm },
        },
    };
    let made = format.made(design, part);
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
    let text = format.text(part, &subject).map_err(Failure::Failed)?;
    let written = match &args.output {
        Some(path) => context.outputs.write(path, args.format.kind(), text.as_bytes()).then_some(path),
        None => None,
    };
    let run_time_s = started.elapsed().as_secs_f64();
    if args.output.is_none() && !context.json {
        output::print(&text)?;
    }
    let answer = Exported { design, subject: &subject, part, format, bytes: text.len() };
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
