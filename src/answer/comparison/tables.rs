//! The comparison as tables and text.

use super::figures::{FIGURES, Figure};
use super::{Comparison, farthest, letter, proud, unit_of, with_unit};
use crate::answer::Answer;
use crate::answer::check::{in_place_of_margin, margin_cell, no_friction};
use crate::compare::{Scene, SideBySide};
use crate::file::Input;
use crate::margin::{LIFT_OFF_TO_RAD_S, Margin};
use crate::report::{Cell, Rows, Screen, Table, Unit, significant};

/// Friction that a scene needs; none where none suffices or it does not run.
pub(super) fn required_friction(scene: &Scene) -> Option<f64> {
    scene.found.demand.as_ref().ok().filter(|d| d.finished).and_then(|d| d.required_friction)
}

/// A column of each design, under its letter.
fn by_design<T>(
    rows: Rows<T>,
    compared: &Comparison<'_>,
    (unit, digits): (Unit, usize),
    cell: impl Fn(&T, usize) -> Cell,
) -> Rows<T> {
    let name = |i: &usize| (format!("value_{}", i + 1), letter(*i));
    rows.each(0..compared.subjects.len(), name, unit, digits, |row, i| cell(row, *i))
}

/// The same of numbers, and of two designs what changes.
fn with_change<T>(
    rows: Rows<T>,
    compared: &Comparison<'_>,
    cell: impl Fn(&T, usize) -> Cell,
    number: impl Fn(&T, usize) -> Option<f64>,
) -> Table {
    let rows = by_design(rows, compared, (Unit::One, 5), cell);
    match compared.subjects.len() {
        2 => rows
            .number("change", "Change", Unit::Percent, 3, |row| change(number(row, 0)?, number(row, 1)?))
            .table(),
        _ => rows.table(),
    }
}

/// Relative change of two numbers.
fn change(a: f64, b: f64) -> Option<Cell> {
    Some(if a == b { "=".into() } else { Cell::Si(b / a - 1.0) })
}

/// Letters, names, files, hashes.
pub(super) fn designs(compared: &Comparison<'_>) -> Table {
    Rows::of(compared.subjects.iter().zip(compared.files).enumerate())
        .text("letter", "", |(i, _)| letter(*i))
        .text("name", "Design", |(_, (s, _))| s.design.name.as_str())
        .text("file", "File", |(_, (_, file))| file.as_str())
        .text("hash", "Hash", |(_, (s, _))| s.design.short_hash())
        .text("verdict", "Required limits", |(_, (s, _))| Cell::held(s.held()))
        .table()
}

pub(super) fn inputs(compared: &Comparison<'_>) -> Table {
    let rows = Rows::of(&compared.inputs).text("key", "Input", |row| with_unit(row));
    let text = |row: &&SideBySide<Input>, i: usize| row.values[i].as_ref().map(|v| v.text.as_str()).into();
    with_change(rows, compared, text, |row, i| row.values[i].as_ref()?.number)
}

pub(super) fn figures(compared: &Comparison<'_>) -> Table {
    let known = |figure: &&Figure| compared.subjects.iter().any(|s| figure.shown(s).is_some());
    let rows = Rows::of(FIGURES.iter().filter(known)).text("key", "Figure", |f| f.unit.heading(f.name));
    let of = |figure: &&Figure, i: usize| figure.shown(&compared.subjects[i]);
    with_change(rows, compared, |figure, i| of(figure, i).into(), of)
}

/// Margins in percent; those that do not count are named so.
pub(super) fn margins(compared: &Comparison<'_>) -> Table {
    type Row<'r, 'm> = &'r SideBySide<&'m Margin>;
    let rows = Rows::of(&compared.margins).text("key", "Limit", |row| row.key.as_str());
    let mut rows = by_design(rows, compared, (Unit::Percent, 3), |row, i| {
        row.values[i].map_or(Cell::Empty, margin_cell)
    });
    if compared.subjects.len() == 2 {
        // A difference of per cents is not per cent of anything.
        rows = rows.number("change", "B − A, points", Unit::One, 3, |row| {
            let [Some(a), Some(b)] = row.values.as_slice() else { return Cell::Empty };
            match [a, b].into_iter().any(|m| in_place_of_margin(m).is_some()) {
                _ if a.shown_margin() == b.shown_margin() => "=".into(),
                true => Cell::Empty,
                false => Unit::Percent.from_si(shown(b) - shown(a)).into(),
            }
        });
    }
    let verdict = |row: &Row<'_, '_>| {
        let counted =
            || row.values.iter().enumerate().filter_map(|(i, m)| Some((i, m.filter(|m| m.required)?)));
        let lost: Vec<String> = counted().filter(|(_, m)| !m.held()).map(|(i, _)| letter(i)).collect();
        match (counted().next(), lost.as_slice()) {
            (None, _) => "shown".into(),
            (_, []) => Cell::held(true),
            (_, lost) => Cell::Verdict(false, format!("NOT HELD: {}", lost.join(", "))),
        }
    };
    rows.text("verdict", "Verdict", verdict).table()
}

/// Friction that each scene needs, and its slip margin against the friction of the design.
pub(super) fn scenes(compared: &Comparison<'_>) -> Table {
    let friction = |s: &Scene| match (required_friction(s), &s.found.demand) {
        (Some(mu), _) => mu.into(),
        (None, Ok(d)) if d.finished => no_friction(s.found.is_to_let_go).into(),
        (None, _) => "does not run".into(),
    };
    let under = |key: &'static str, heading: &'static str| {
        move |i: &usize| (format!("{key}_{}", i + 1), format!("{heading}, {}", letter(*i)))
    };
    let designs = || 0..compared.subjects.len();
    Rows::of(&compared.scenes)
        .text("key", "Scene", |row| row.key.as_str())
        .each(designs(), under("required_friction", "μ required"), Unit::One, 4, |row, i| {
            row.values[*i].map_or(Cell::Empty, friction)
        })
        .each(designs(), under("slip_margin", "Slip margin"), Unit::Percent, 3, |row, i| {
            row.values[*i].and_then(|s| s.found.slip_margin())
        })
        .table()
}

/// Everything, one value a row and design: section, key, unit, values.
pub(super) fn csv(compared: &Comparison<'_>) -> Table {
    let mut all: Vec<(&str, &str, &str, Vec<Cell>)> = Vec::new();
    for r in &compared.inputs {
        let cell = |v: &Option<Input>| {
            v.as_ref().map(|i| i.number.map_or_else(|| Cell::Text(i.text.clone()), Cell::Si)).into()
        };
        all.push(("input", &r.key, unit_of(r), r.values.iter().map(cell).collect()));
    }
    for f in &FIGURES {
        let cells = compared.subjects.iter().map(|s| f.shown(s).into()).collect();
        all.push(("figure", f.key, f.unit.symbol(), cells));
    }
    for r in &compared.margins {
        all.push(("margin", &r.key, "", r.values.iter().map(|m| m.map(shown).into()).collect()));
    }
    for r in &compared.scenes {
        let of =
            |value: fn(&Scene) -> Option<f64>| r.values.iter().map(|s| s.and_then(value).into()).collect();
        all.push(("required_friction", &r.key, "", of(required_friction)));
        all.push(("slip_margin", &r.key, "", of(|s| s.found.slip_margin())));
    }
    let rows = Rows::of(all)
        .text("section", "Section", |(section, ..)| *section)
        .text("key", "Key", |(_, key, ..)| *key)
        .text("unit", "Unit", |(.., unit, _)| *unit);
    by_design(rows, compared, (Unit::One, 5), |(.., values), i| values[i].clone()).table()
}

pub(super) fn text(compared: &Comparison<'_>, screen: Screen) -> String {
    let mut out = format!("{}\n{}\n\n", designs(compared).to_text(screen), compared.verdict());
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
