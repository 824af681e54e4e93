//! Tables of points: x, y, in mm if the head says nothing else.

use super::dxf::{DrawnCurve, arc, chained};
use super::{Drawn, DrawnUnit, NoImport, TAKEN_FOR_MM, number};
use nalgebra::Vector2;

/// Points at least: fewer say nothing of four sides.
const LEAST: usize = 40;
/// The step from the last point to the first over the longest other step, at most.
const GAP: f64 = 1.5;

pub(super) fn read(text: &str, said: Option<DrawnUnit>) -> Result<Drawn, NoImport> {
    const HELP: &str = "give a table of x, y in mm, one point a line, in order round the outline; or a .dxf";
    let lines = || text.lines().enumerate().filter(|(_, l)| !l.trim().is_empty() && !l.starts_with('#'));
    let Some((at, first)) = lines().next() else {
        return Err(NoImport::new(None, "an empty file", HELP));
    };
    if first.contains('=') {
        return Err(NoImport::new(at + 1, format!("{first:?}, a key as in a design file (TOML)"), HELP));
    }
    if first.trim_start_matches('\u{feff}').trim_start().starts_with('<') {
        return Err(NoImport::new(
            at + 1,
            "an SVG or another XML file",
            "save the outline as .dxf, or as a table of x, y in mm",
        ));
    }
    if first.starts_with("ISO-10303-21") {
        return Err(NoImport::new(1, "a STEP file", super::dxf::STEP_HELP));
    }
    let separator = [';', '\t', ','].into_iter().find(|c| first.contains(*c));
    // With ; between numbers a comma may be the decimal point.
    let cells = |line: &str| -> Vec<String> {
        match separator {
            Some(';') => line.split(';').map(|c| c.trim().replace(',', ".")).collect(),
            Some(c) => line.split(c).map(|c| c.trim().to_owned()).collect(),
            None => line.split_whitespace().map(str::to_owned).collect(),
        }
    };
    let names: Vec<String> = cells(first).iter().map(|n| n.to_lowercase()).collect();
    let has_head = names.iter().all(|n| n.parse::<f64>().is_err());
    let mut remarks = Vec::new();
    let (mut columns, mut scale) = ([0, 1], 1e-3);
    if has_head && names.iter().any(|n| n == "start_x_mm") {
        let rows: Vec<(usize, Vec<String>)> =
            lines().skip(1).map(|(at, line)| (at + 1, cells(line))).collect();
        return arcs(&names, &rows, said);
    }
    if has_head {
        let of = |axis: char| {
            let unit = |n: &String| {
                n.strip_prefix(axis).map(|u| u.trim_matches(|c: char| !c.is_alphanumeric()).to_owned())
            };
            names.iter().position(|n| {
                unit(n).is_some_and(|u| ["", "mm", "in", "inch", "m", "um"].contains(&u.as_str()))
            })
        };
        let (Some(x), Some(y)) = (of('x'), of('y')) else {
            return Err(NoImport::new(1, format!("columns {first:?}"), "name two columns x_mm and y_mm"));
        };
        columns = [x, y];
        let unit = names[x].trim_start_matches('x').trim_matches(|c: char| !c.is_alphanumeric()).to_owned();
        scale = match unit.as_str() {
            "in" | "inch" => {
                remarks.push("inches were converted to millimetres".to_owned());
                25.4e-3
            }
            "m" => 1.0,
            "um" => 1e-6,
            "mm" => 1e-3,
            _ => {
                remarks.push(format!("the table names no unit: {TAKEN_FOR_MM}"));
                1e-3
            }
        };
    } else {
        remarks.push(format!("the table names no unit: {TAKEN_FOR_MM}"));
    }
    if let Some(said) = said {
        remarks = vec![format!("lengths are taken for {}, as asked", said.name())];
        scale = said.metres();
    }
    let mut points_m = Vec::new();
    for (at, line) in lines().skip(usize::from(has_head)) {
        let cells = cells(line);
        let value = |column: usize| match cells.get(column) {
            Some(cell) => number(cell, at + 1).map(|v| scale * v),
            None => Err(NoImport::new(at + 1, format!("{} columns", cells.len()), HELP)),
        };
        points_m.push(Vector2::new(value(columns[0])?, value(columns[1])?));
    }
    closed(&mut points_m)?;
    Ok(Drawn { points_m, kinks: Vec::new(), remarks })
}

/// The arcs and lines of a sprag as `export` writes them.
fn arcs(names: &[String], rows: &[(usize, Vec<String>)], said: Option<DrawnUnit>) -> Result<Drawn, NoImport> {
    const HELP: &str = "write the table again with `export`, or give a table of x, y";
    let scale = said.map_or(1e-3, DrawnUnit::metres);
    let text = |(line, row): &(usize, Vec<String>), name: &str| -> Result<String, NoImport> {
        let cell = names.iter().position(|n| n == name).and_then(|k| row.get(k));
        cell.cloned().ok_or_else(|| NoImport::new(*line, format!("no column {name}"), HELP))
    };
    let value = |row: &(usize, Vec<String>), name: &str| number(&text(row, name)?, row.0);
    let point = |row: &(usize, Vec<String>), x: &str, y: &str| -> Result<Vector2<f64>, NoImport> {
        Ok(scale * Vector2::new(value(row, x)?, value(row, y)?))
    };
    let mut curves = Vec::new();
    for row in rows {
        if text(row, "body")? != "sprag" {
            continue;
        }
        match text(row, "kind")?.as_str() {
            "arc" => {
                let [from, to] = ["start_deg", "end_deg"].map(|name| value(row, name).map(f64::to_radians));
                let (from, centre) = (from?, point(row, "centre_x_mm", "centre_y_mm")?);
                curves.push(arc(row.0, centre, scale * value(row, "radius_mm")?, from, to? - from));
            }
            "line" => {
                let points =
                    vec![point(row, "start_x_mm", "start_y_mm")?, point(row, "end_x_mm", "end_y_mm")?];
                curves.push(DrawnCurve { line: row.0, points, centre: None });
            }
            other => return Err(NoImport::new(row.0, format!("the kind {other:?}"), HELP)),
        }
    }
    if curves.is_empty() {
        return Err(NoImport::new(None, "a table of arcs without a row of the body sprag", HELP));
    }
    chained(curves, Vec::new())
}

/// Refuses what is no closed line; the first point is not repeated at the end.
pub(super) fn closed(points_m: &mut Vec<Vector2<f64>>) -> Result<(), NoImport> {
    closed_joined(points_m)?;
    let longest = points_m.windows(2).map(|w| (w[1] - w[0]).norm()).fold(0.0, f64::max);
    let gap = (points_m[0] - points_m[points_m.len() - 1]).norm();
    if gap > GAP * longest {
        return Err(NoImport::new(
            None,
            format!("an open outline: {:.4} mm from its last point to its first", 1e3 * gap),
            "give the whole outline: inner arcs, flank, outer arc, flank; at least the four corners of what is not measured",
        ));
    }
    Ok(())
}

/// Refuses too few points; the first is not repeated at the end.
pub(super) fn closed_joined(points_m: &mut Vec<Vector2<f64>>) -> Result<(), NoImport> {
    points_m.dedup();
    while points_m.len() > 1 && points_m.first() == points_m.last() {
        points_m.pop();
    }
    if points_m.len() < LEAST {
        return Err(NoImport::new(
            None,
            format!("{} points", points_m.len()),
            &format!("at least {LEAST} are needed; some thousands for radii within micrometres"),
        ));
    }
    Ok(())
}
