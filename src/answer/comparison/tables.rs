//! The comparison as tables and text.

use super::figures::FIGURES;
use super::{Comparison, farthest, letter, proud, with_unit};
use crate::answer::check::{in_place_of_margin, margin_cell};
use crate::compare::Scene;
use crate::margin::{LIFT_OFF_TO_RAD_S, Margin};
use crate::report::{Cell, Column, Rows, Screen, Table, Unit, significant};

/// Friction that a scene needs; none where none suffices or it does not run.
pub(super) fn required_friction(scene: &Scene) -> Option<f64> {
    scene.found.demand.as_ref().ok().filter(|d| d.finished).and_then(|d| d.required_friction)
}

/// A leading column, one of each design, and where there are two what changes.
fn columns(
    compared: &Comparison<'_>,
    heading: &str,
    (unit, digits): (Unit, usize),
    change: Option<&str>,
) -> Vec<Column> {
    let mut columns = vec![Column::text("key", heading)];
    let count = compared.subjects.len();
    columns.extend((0..count).map(|i| Column::number(&format!("value_{}", i + 1), &letter(i), unit, digits)));
    columns.extend(change.filter(|_| count == 2).map(|h| Column::number("change", h, Unit::Percent, 3)));
    columns
}

/// Relative change of two numbers.
fn change(values: &[Option<f64>]) -> Option<Cell> {
    let [before, after] = values else { return None };
    let (a, b) = ((*before)?, (*after)?);
    Some(if a == b { "=".into() } else { Cell::Si(b / a - 1.0) })
}

/// Letters, names, files, hashes.
pub(super) fn designs(compared: &Comparison<'_>) -> Table {
    Rows::of(compared.subjects.iter().zip(compared.files).enumerate())
        .text("letter", "", |(i, _)| letter(*i))
        .text("name", "Design", |(_, (s, _))| s.design.name.as_str())
        .text("file", "File", |(_, (_, file))| file.as_str())
        .text("hash", "Hash", |(_, (s, _))| s.design.short_hash())
        .text("verdict", "Required limits", |(_, (s, _))| {
            Cell::Verdict(s.held(), if s.held() { "held" } else { "NOT HELD" }.to_owned())
        })
        .table()
}

pub(super) fn inputs(compared: &Comparison<'_>) -> Table {
    let mut table = Table::new(columns(compared, "Input", (Unit::One, 5), Some("Change")));
    for row in &compared.inputs {
        let mut cells: Vec<Cell> = vec![with_unit(row).into()];
        cells.extend(row.values.iter().map(|v| v.as_ref().map_or(Cell::Empty, |i| i.text.as_str().into())));
        let numbers: Vec<Option<f64>> =
            row.values.iter().map(|v| v.as_ref().and_then(|i| i.number)).collect();
        cells.extend(change(&numbers));
        table.row(cells);
    }
    table
}

pub(super) fn figures(compared: &Comparison<'_>) -> Table {
    let mut table = Table::new(columns(compared, "Figure", (Unit::One, 5), Some("Change")));
    for figure in &FIGURES {
        let values: Vec<Option<f64>> = compared.subjects.iter().map(|s| figure.shown(s)).collect();
        if values.iter().all(Option::is_none) {
            continue;
        }
        let mut cells: Vec<Cell> = vec![figure.unit.heading(figure.name).into()];
        cells.extend(values.iter().map(|v| Cell::from(*v)));
        cells.extend(change(&values));
        table.row(cells);
    }
    table
}

/// Margins in percent; those that do not count are named so.
pub(super) fn margins(compared: &Comparison<'_>) -> Table {
    let mut table = Table::new(columns(compared, "Limit", (Unit::Percent, 3), None));
    if compared.subjects.len() == 2 {
        // A difference of per cents is not per cent of anything.
        table.columns.push(Column::number("change", "B − A, points", Unit::One, 3));
    }
    table.columns.push(Column::text("verdict", "Verdict"));
    for row in &compared.margins {
        let mut cells: Vec<Cell> = vec![row.key.as_str().into()];
        cells.extend(row.values.iter().map(|m| m.map_or(Cell::Empty, margin_cell)));
        if let [a, b] = row.values.as_slice() {
            cells.push(match (a, b) {
                (Some(a), Some(b)) if a.shown_margin() == b.shown_margin() => "=".into(),
                (Some(a), Some(b)) if [a, b].into_iter().any(|m| in_place_of_margin(m).is_some()) => {
                    Cell::Empty
                }
                (Some(a), Some(b)) => Unit::Percent.from_si(shown(b) - shown(a)).into(),
                _ => Cell::Empty,
            });
        }
        let counted: Vec<usize> =
            (0..row.values.len()).filter(|&i| row.values[i].is_some_and(|m| m.required)).collect();
        let lost: Vec<String> = counted
            .iter()
            .filter(|&&i| row.values[i].is_some_and(|m| !m.held()))
            .map(|&i| letter(i))
            .collect();
        cells.push(match (counted.as_slice(), lost.as_slice()) {
            ([], _) => "shown".into(),
            (_, []) => Cell::Verdict(true, "held".into()),
            (_, lost) => Cell::Verdict(false, format!("NOT HELD: {}", lost.join(", "))),
        });
        table.row(cells);
    }
    table
}

/// Friction that each scene needs, and its slip margin against the friction of the design.
pub(super) fn scenes(compared: &Comparison<'_>) -> Table {
    let count = compared.subjects.len();
    let mut table = Table::new(vec![Column::text("key", "Scene")]);
    for i in 0..count {
        let heading = format!("μ required, {}", letter(i));
        table.columns.push(Column::number(&format!("required_friction_{}", i + 1), &heading, Unit::One, 4));
    }
    for i in 0..count {
        let heading = format!("Slip margin, {}", letter(i));
        table.columns.push(Column::number(&format!("slip_margin_{}", i + 1), &heading, Unit::Percent, 3));
    }
    for row in &compared.scenes {
        let mut cells: Vec<Cell> = vec![row.key.as_str().into()];
        let friction = |s: &Scene| match (required_friction(s), &s.found.demand) {
            (Some(mu), _) => mu.into(),
            (None, Ok(d)) if d.finished => "none suffices".into(),
            (None, _) => "does not run".into(),
        };
        cells.extend(row.values.iter().map(|s| s.map_or(Cell::Empty, friction)));
        cells.extend(row.values.iter().map(|s| s.map_or(Cell::Empty, |s| s.found.slip_margin().into())));
        table.row(cells);
    }
    table
}

/// Everything, one value a row and design: section, key, unit, values.
pub(super) fn csv(compared: &Comparison<'_>) -> Table {
    let mut table = Table::new(vec![
        Column::text("section", "Section"),
        Column::text("key", "Key"),
        Column::text("unit", "Unit"),
    ]);
    let count = compared.subjects.len();
    table
        .columns
        .extend((0..count).map(|i| Column::number(&format!("value_{}", i + 1), &letter(i), Unit::One, 5)));
    let mut row = |section: &str, key: &str, unit: &str, cells: Vec<Cell>| {
        let mut all: Vec<Cell> = vec![section.into(), key.into(), unit.into()];
        all.extend(cells);
        table.row(all);
    };
    for r in &compared.inputs {
        let unit = r.values.iter().flatten().map(|i| i.unit).next().unwrap_or("");
        let cell = |v: &Option<crate::design::Input>| match v {
            Some(i) => i.number.map_or_else(|| Cell::Text(i.text.clone()), Cell::Si),
            None => Cell::Empty,
        };
        row("input", &r.key, unit, r.values.iter().map(cell).collect());
    }
    for f in &FIGURES {
        let cells = compared.subjects.iter().map(|s| Cell::from(f.shown(s))).collect();
        row("figure", f.key, f.unit.symbol(), cells);
    }
    for r in &compared.margins {
        let cells = r.values.iter().map(|m| Cell::from(m.map(shown))).collect();
        row("margin", &r.key, "", cells);
    }
    for r in &compared.scenes {
        let friction = r.values.iter().map(|s| Cell::from(s.and_then(required_friction))).collect();
        row("required_friction", &r.key, "", friction);
        let slip = r.values.iter().map(|s| Cell::from(s.and_then(|s| s.found.slip_margin()))).collect();
        row("slip_margin", &r.key, "", slip);
    }
    table
}

pub(super) fn text(compared: &Comparison<'_>, screen: Screen) -> String {
    let mut out = format!("{}\n{}\n\n", designs(compared).to_text(screen), compared.banner());
    let mut part = |heading: &str, table: Table| {
        if !table.rows.is_empty() {
            out.push_str(&format!("{heading}\n{}\n", table.to_text(screen)));
        }
    };
    part("Inputs that differ", inputs(compared));
    part("Figures", figures(compared));
    part("Margins", margins(compared));
    part("Scenes", scenes(compared));
    for (i, points) in proud(compared.subjects).enumerate() {
        if let Some(apart) = farthest(&points) {
            out.push_str(&format!("Profiles of A and {}: {apart}\n", letter(i + 1)));
        }
    }
    if compared.subjects.iter().any(|s| s.lift_off_rad_s.is_none()) {
        let to = significant(Unit::Rpm.from_si(LIFT_OFF_TO_RAD_S), 2);
        out.push_str(&format!("lift-off –: contact is kept up to {to} rpm at least\n"));
    }
    out
}

/// A margin as `check` shows it, of slip the slip margin itself.
fn shown(m: &Margin) -> f64 {
    m.shown_margin().unwrap_or(m.margin())
}
