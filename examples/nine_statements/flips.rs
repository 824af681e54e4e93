//! Tables and bars of the thresholds.

use std::error::Error;

use rayon::prelude::*;
use sprag_design::design::Design;
use sprag_design::report::{Bar, Bars, Cell, Column, Page, Table, Tone, Unit, greek, significant};
use sprag_design::scenario::{Settings, simulate};

use crate::cells::label;
use crate::claims::scene;
use crate::statement::{AT_THRESHOLD, STATEMENTS};
use crate::thresholds::{Flip, Flips, Unknown, all};

type Side = [Option<Option<Flip>>];

/// The nearest flip of one side among the cells that `counts` admits.
fn nearest(side: &Side, counts: impl Fn(usize) -> bool) -> Option<(usize, &Flip)> {
    let found = side.iter().enumerate().filter(|(i, _)| counts(*i));
    let found = found.filter_map(|(i, f)| f.as_ref()?.as_ref().map(|f| (i, f)));
    found.min_by(|a, b| a.1.between[1].ln().abs().total_cmp(&b.1.between[1].ln().abs()))
}

fn percent(flip: &Flip) -> f64 {
    100.0 * (flip.between[1] - 1.0)
}

/// Digits that the bracket, 0.2 % of the move, supports.
fn signed(value: f64) -> String {
    format!("{}{}", if value > 0.0 { "+" } else { "" }, significant(value, 3))
}

/// "-4.58 % = 95.42 Hz: 16.8 Nm ..., 6 Nm slips-engaging".
fn told(unknown: &Unknown, found: Option<(usize, &Flip)>, up: bool) -> String {
    match found {
        Some((cell, flip)) => format!(
            "{} % ({} {}): {} {}",
            signed(percent(flip)),
            signed(unknown.value * (flip.between[1] - 1.0)),
            unknown.unit,
            STATEMENTS[cell].scene,
            flip.becomes
        ),
        None => {
            let bound = if up { unknown.bound } else { 1.0 / unknown.bound };
            format!("none up to a factor of {}", significant(bound, 3))
        }
    }
}

/// A bar chart is cut here, %.
const WIDEST: f64 = 10.0;

fn bars(unknowns: &[Unknown], flips: &Flips, title: &str, counts: impl Fn(usize) -> bool + Copy) -> String {
    let mut bars = Bars {
        title: title.to_owned(),
        bars: Vec::new(),
        marks: [-10.0, -5.0, -1.0, 1.0, 5.0, 10.0].map(|m| (m, format!("{m} %"))).to_vec(),
        range: (-WIDEST, WIDEST),
    };
    for (unknown, sides) in unknowns.iter().zip(flips) {
        for (side, up) in sides.iter().zip([false, true]) {
            let found = nearest(side, counts);
            let value = found.map_or(if up { f64::MAX } else { f64::MIN }, |f| percent(f.1));
            let text = found.map_or("none".to_owned(), |(c, f)| {
                format!("{} % {}", signed(percent(f)), STATEMENTS[c].scene)
            });
            let tone = match found {
                None => Tone::Good,
                Some((_, f)) if percent(f).abs() < 1.0 => Tone::Bad,
                Some(_) => Tone::Plain,
            };
            let label = format!("{} {}", greek(unknown.symbol), if up { "up" } else { "down" });
            bars.bars.push(Bar { label, value, text, tone });
        }
    }
    bars.to_figure()
}

/// Half of the last printed digit of 4.68 and 0.62 mm.
const ROUNDING_M: f64 = 5e-6;

type Anyhow<T> = Result<T, Box<dyn Error + Send + Sync>>;

/// Friction that the third row needs, and which statements hold, at the corners of the rounding.
fn rounding(design: &Design) -> Anyhow<Table> {
    let mut table = Table::new(vec![Column::text("move", "Move")]);
    table.columns.extend(
        ["6 Nm", "8 Nm", "10 Nm"]
            .map(|a| Column::number(a, &format!("mu needed at 16.8 Nm, {a}"), Unit::One, 5)),
    );
    table.columns.push(Column::text("flipped", "Statements that no longer hold"));
    let moves = [
        ("as printed", 0.0, 0.0),
        ("e_1 - 5 µm", -1.0, 0.0),
        ("e_1 + 5 µm", 1.0, 0.0),
        ("r_e - 5 µm", 0.0, -1.0),
        ("r_e + 5 µm", 0.0, 1.0),
    ];
    for (name, e_1, r_e) in moves {
        let runs = STATEMENTS
            .par_iter()
            .map(|s| {
                let mut scene = scene(design, s.scene)?.clone();
                scene.clutch.sprags.centre_distance_m += e_1 * ROUNDING_M;
                scene.clutch.sprags.outer_radius_m += r_e * ROUNDING_M;
                Ok(simulate(&scene, &Settings::default())?)
            })
            .collect::<Anyhow<Vec<_>>>()?;
        let mut row: Vec<Cell> = vec![name.into()];
        row.extend(runs[6..].iter().map(|r| Cell::from(r.demand.and_then(|d| d.required_friction))));
        let flipped: Vec<String> = STATEMENTS
            .iter()
            .zip(&runs)
            .filter(|(s, r)| !s.agrees(r.verdict))
            .map(|(s, r)| format!("{} {}", s.scene, r.verdict.map_or(r.stop.name(), |v| v.name())))
            .collect();
        row.push(if flipped.is_empty() { "none".into() } else { flipped.join("; ").into() });
        table.row(row);
    }
    Ok(table)
}

/// What the flips of e_1 and r_e say in µm.
fn split(unknowns: &[Unknown], flips: &Flips) -> Vec<String> {
    let of_micrometres = unknowns.iter().zip(flips).filter(|(u, _)| u.unit == "µm");
    of_micrometres
        .map(|(u, sides)| {
            let um = |side: &Side, cell: usize| {
                side[cell].as_ref().and_then(|f| f.as_ref()).map_or("no flip".to_owned(), |f| {
                    format!("{} µm ({})", signed(u.value * (f.between[1] - 1.0)), f.becomes)
                })
            };
            let both = |cell: usize| format!("{} / {}", um(&sides[0], cell), um(&sides[1], cell));
            format!(
                "{}, down / up. 16.8 Nm at 0.082: 6 Nm {}; 8 Nm {}; 10 Nm {}. 3.34 Nm: 8 Nm {}. The rounding of the printed value is 5 µm",
                u.symbol,
                both(6),
                both(7),
                both(8),
                both(1)
            )
        })
        .collect()
}

/// The section on thresholds.
pub fn write(page: &mut Page, design: &Design, unknowns: &[Unknown]) -> Anyhow<()> {
    let flips = all(design, unknowns);
    page.heading("How far each unknown can move before a statement flips");
    let mut first = Table::new(vec![
        Column::text("unknown", "Unknown"),
        Column::text("value", "Value"),
        Column::text("all", "First flip of its cells, down and up"),
        Column::text("without", "Without the cell at its threshold"),
    ]);
    for (u, sides) in unknowns.iter().zip(&flips) {
        for (side, up) in sides.iter().zip([false, true]) {
            let value = format!("{} {}", u.value, u.unit);
            let all = told(u, nearest(side, |_| true), up);
            let without = told(u, nearest(side, |i| i != AT_THRESHOLD), up);
            let name = if up { "" } else { u.name };
            first.row(vec![
                greek(name).into(),
                if up { "".into() } else { value.into() },
                all.clone().into(),
                if all == without { "the same".into() } else { without.into() },
            ]);
        }
    }
    page.paragraph(
        "One unknown at a time, all else as in the design file, outwards in 20 to 26 moves and then bisected: what is \
         printed is the first move that flips a statement, to 0.2 % of itself. A flip to 'sticks' is a net slip below \
         1 µm, so the cell at its threshold flips before its friction exceeds what sticking takes.",
    );
    page.paragraph(
        "mu_c and gamma_b decide nothing where mu_s is 0.12: slip at 3.34 Nm happens near N = 0, towards overrunning, and ends because the spring and the returning torque load the contact again. Slip under load is another matter (mu_s = 0.082): with mu_c below tan omega, \
         0.0809 at 16.8 Nm, it runs away.",
    );
    page.table("", &first);
    page.figure(
        &bars(unknowns, &flips, "First flip of nine", |_| true),
        "First flip among all its cells, %, cut at 10 %. Red: below 1 %.",
    );
    page.figure(
        &bars(unknowns, &flips, "First flip of eight", |i| i != AT_THRESHOLD),
        &format!("The same without {}.", label(AT_THRESHOLD)),
    );
    let mut matrix = Table::new(vec![Column::text("unknown", "Unknown")]);
    matrix.columns.extend(STATEMENTS.iter().map(|s| Column::text(s.scene, s.scene)));
    for (u, sides) in unknowns.iter().zip(&flips) {
        for (side, up) in sides.iter().zip([false, true]) {
            let mut row: Vec<Cell> =
                vec![format!("{} {}", greek(u.symbol), if up { "up" } else { "down" }).into()];
            row.extend(side.iter().map(|f| match f {
                None => Cell::Empty,
                Some(None) => "holds".into(),
                Some(Some(f)) => signed(percent(f)).into(),
            }));
            matrix.row(row);
        }
    }
    page.table("Move at which each statement flips, %; holds: not up to the bound", &matrix);
    page.heading("The rounding of e_1 and r_e");
    page.list(split(unknowns, &flips));
    page.table("", &rounding(design)?);
    Ok(())
}
