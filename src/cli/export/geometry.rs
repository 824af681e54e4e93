//! A design as a drawing, a solid or a table of its arcs.

use super::{ExportArgs, Format, PartName, TableName};
use crate::cli::exit::{Exit, Failure};
use crate::cli::left_out::LeftOut;
use crate::cli::parts::Answer;
use crate::cli::{Context, output, parts};
use crate::clutch::{Clutch, EndProfile};
use crate::design::Design;
use crate::export::rows::{Point, Row, arcs, points};
use crate::export::{Part, Subject, dxf::dxf, step::step, svg::svg};
use crate::margin::NoMargins;
use crate::profile::{Outline, Profile};
use crate::report::{Cell, Column, Table, Unit};
use serde_json::{Value, json};
use std::time::Instant;

/// Smallest deviation of points, mm: a hundredth of what a length standard resolves, and file sizes stay bounded.
const LEAST_DEVIATION_MM: f64 = 1e-5;
/// Deviation of points if none is asked for, mm.
const DEVIATION_MM: f64 = 1e-3;
/// From here the drawn sprag is said to weigh otherwise than the one computed.
const OTHER_MASS: f64 = 5e-3;

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
    let made = design.as_made().map_err(|refused| Failure::Malformed(miette::Report::new(refused)))?;
    let profile = made.profile().map_err(|e| parts::no_clutch(&args.file, &NoMargins::Profile(e)))?;
    let part = part(args.part.unwrap_or(PartName::Sprag));
    let outline = match made.sprags.flanks {
        Some(flanks) => Some(
            Outline::closed(&profile, &flanks)
                .map_err(|e| parts::no_clutch(&args.file, &NoMargins::Outline(e)))?,
        ),
        None => None,
    };
    let listed = args.format == Format::Csv && args.table != Some(TableName::Points) && part == Part::Sprag;
    if outline.is_none() && part.has_sprag() && !listed {
        return Err(open(args, &profile));
    }
    let subject = Subject {
        name: &design.name,
        hash: &design.hash,
        clutch: &made,
        profile: &profile,
        outline: outline.as_ref(),
    };
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
    if part.has_sprag() {
        notes(&subject, context);
    }
    let rows = arcs(part, &subject);
    let answer = Answer {
        design,
        run_time_s,
        left_out: left_out(&made, args.format, part),
        error_estimate: None,
        body: json!({
            "format": args.format.name(),
            "part": part.name(),
            "written": written.map(|path| path.display().to_string()),
            "bytes": text.len(),
            "mass_over_given": subject.mass_excess().map(|excess| 1.0 + excess),
            "arcs": rows.iter().map(row_json).collect::<Vec<_>>(),
        }),
    };
    answer.print(context)?;
    if let Some(path) = written {
        context.message(&format!(
            "{}: {}, mm, {} arcs and flanks, {:.1} kB",
            path.display(),
            part.name(),
            rows.len(),
            text.len() as f64 * 1e-3
        ));
    }
    Ok(Exit::Held)
}

fn part(name: PartName) -> Part {
    match name {
        PartName::Sprag => Part::Sprag,
        PartName::Inner => Part::Inner,
        PartName::Outer => Part::Outer,
        PartName::Clutch => Part::Clutch,
    }
}

/// The refusal of a sprag that no flanks close.
fn open(args: &ExportArgs, profile: &Profile) -> Failure {
    let file = args.file.display();
    let narrowest = match Outline::narrowest_flanks(profile) {
        Ok((rear, front)) => {
            let up = |m: f64| (m * 1e6).ceil() / 1e3;
            format!(
                ", for example flanks = {{ rear_mm = {}, front_mm = {} }}, the narrowest",
                up(rear),
                up(front)
            )
        }
        Err(_) => String::new(),
    };
    Failure::NoClutch(format!(
        "{file}: the outline of the sprag is open: found neither sprags.flanks nor a sprags.width_mm above 0, and --format {} \
         needs a closed outline; give [sprags] flanks{narrowest}; or let optimize find them with \
         flank_rear_mm and flank_front_mm among its variables. Without flanks there are --part inner, --part outer and \
         --format csv --table arcs",
        args.format.name()
    ))
}

/// What the one who makes the sprag should know.
fn notes(subject: &Subject, context: &Context) {
    if let Some(excess) = subject.mass_excess().filter(|e| e.abs() > OTHER_MASS) {
        context.message(&format!(
            "note: the sprag drawn weighs {:+.1} % against the mass_kg that the design gives and computes with; leave out \
             mass_kg, inertia_kg_m2 and centroid, and they follow from the outline",
            1e2 * excess
        ));
    }
}

fn left_out(clutch: &Clutch, format: Format, part: Part) -> Vec<LeftOut> {
    let mut list = vec![LeftOut::new(
        "edges, chamfers, grooves for the spring, cage",
        "the design holds working surfaces and flanks, nothing else",
        "mass and inertia of what is added or cut away",
    )];
    if part.has_sprag() && format == Format::Step && clutch.axial.end_profile != EndProfile::Square {
        list.push(LeftOut::new(
            "the profile of the ends",
            "solids are prisms; the drop towards the ends is micrometres",
            "the edge pressure of square ends, if made so: see [axial]",
        ));
    }
    list
}

fn csv(part: Part, subject: &Subject, args: &ExportArgs, deviation_mm: f64) -> Result<String, Failure> {
    let table = match args.table.unwrap_or(TableName::Arcs) {
        TableName::Arcs => arcs_table(&arcs(part, subject)),
        TableName::Points => points_table(&points(part, subject, 1e-3 * deviation_mm)),
    };
    let bytes = table.to_csv().map_err(|e| Failure::Failed(format!("CSV: {e}")))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

fn arcs_table(rows: &[Row]) -> Table {
    let length = |key: &str| Column::number(key, key, Unit::Millimetre, 6);
    let mut table = Table::new(vec![
        Column::text("body", "Body"),
        Column::text("surface", "Surface"),
        Column::text("kind", "Kind"),
        length("centre_x_mm"),
        length("centre_y_mm"),
        length("radius_mm"),
        Column::number("start_deg", "From", Unit::Degree, 6),
        Column::number("end_deg", "To", Unit::Degree, 6),
        length("start_x_mm"),
        length("start_y_mm"),
        length("end_x_mm"),
        length("end_y_mm"),
    ]);
    for r in rows {
        let kind = if r.circle_m.is_some() { "arc" } else { "line" };
        let circle = r.circle_m.map(|([x, y], radius)| [x, y, radius]);
        let ends = r.ends_m.map(|[[a, b], [c, d]]| [a, b, c, d]);
        let mut cells: Vec<Cell> = vec![r.body.as_str().into(), r.surface.as_str().into(), kind.into()];
        cells.extend((0..3).map(|i| Cell::from(circle.map(|c| c[i]))));
        cells.extend((0..2).map(|i| Cell::from(r.angles_rad.map(|a| a[i]))));
        cells.extend((0..4).map(|i| Cell::from(ends.map(|e| e[i]))));
        table.row(cells);
    }
    table
}

fn points_table(points: &[Point]) -> Table {
    let mut table = Table::new(vec![
        Column::text("body", "Body"),
        Column::text("surface", "Surface"),
        Column::number("x_mm", "x", Unit::Millimetre, 6),
        Column::number("y_mm", "y", Unit::Millimetre, 6),
    ]);
    for p in points {
        table.row(vec![
            p.body.as_str().into(),
            p.surface.as_str().into(),
            p.at_m[0].into(),
            p.at_m[1].into(),
        ]);
    }
    table
}

fn row_json(r: &Row) -> Value {
    let mm = |m: f64| Unit::Millimetre.from_si(m);
    json!({
        "body": r.body,
        "surface": r.surface,
        "centre_mm": r.circle_m.map(|(c, _)| c.map(mm)),
        "radius_mm": r.circle_m.map(|(_, radius)| mm(radius)),
        "angles_deg": r.angles_rad.map(|a| a.map(f64::to_degrees)),
        "ends_mm": r.ends_m.map(|e| e.map(|p| p.map(mm))),
    })
}
