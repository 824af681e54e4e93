//! The curve as tables: one law in full, several side by side, all of it as CSV.

use super::{LawCurve, StiffnessStudy, fem, junctions};
use crate::answer::roll_over::sentence;
use crate::report::{Cell, Column, Screen, Table, Unit, significant};
use crate::wedge::{RollOver, StaticPoint};

/// The columns of a row, without the law's name.
fn columns() -> Vec<Column> {
    vec![
        Column::number("torque_nm", "Torque", Unit::NewtonMetre, 4),
        Column::number("normal_inner_n", "N A", Unit::Newton, 5),
        Column::number("normal_outer_n", "N B", Unit::Newton, 5),
        Column::number("tan_omega", "tan ω", Unit::One, 4),
        Column::number("tan_nu", "tan ν", Unit::One, 4),
        Column::number("alpha_rad", "α", Unit::Radian, 4),
        Column::number("windup_deg", "Windup", Unit::Degree, 5),
        Column::number("k_secant_nm_per_rad", "K sec", Unit::NewtonMetrePerRadian, 5),
        Column::number("k_tangent_nm_per_rad", "K tan", Unit::NewtonMetrePerRadian, 5),
        Column::number("arc", "Arc", Unit::One, 1),
        Column::number("hertz_inner_mpa", "p₀ A", Unit::Megapascal, 4),
        Column::number("hertz_outer_mpa", "p₀ B", Unit::Megapascal, 4),
    ]
}

fn cells(torque_nm: f64, point: Option<&StaticPoint>) -> Vec<Cell> {
    let Some(p) = point else { return vec![torque_nm.into()] };
    vec![
        torque_nm.into(),
        p.normal_inner_n.into(),
        p.normal_outer_n.into(),
        p.tan_omega.into(),
        p.tan_nu.into(),
        p.alpha_rad.into(),
        p.windup_rad.into(),
        p.k_secant_nm_per_rad.into(),
        p.k_tangent_nm_per_rad.into(),
        (p.arc + 1).into(),
        p.hertz_inner_pa.into(),
        p.hertz_outer_pa.into(),
    ]
}

/// One law in full. A torque beyond the curve's end is a row that says so.
pub(super) fn full(law: &LawCurve) -> Table {
    let mut table = Table::new(columns());
    let beyond = law.rows.iter().any(|(_, p)| p.is_none());
    if beyond {
        table.columns.push(Column::text("state", "State"));
    }
    for (torque, point) in &law.rows {
        let mut row = cells(*torque, point.as_ref());
        if beyond {
            row.resize(columns().len(), Cell::Empty);
            row.push(state(point.as_ref()).into());
        }
        table.row(row);
    }
    table
}

fn state(point: Option<&StaticPoint>) -> &'static str {
    if point.is_some() { "carried" } else { "beyond the end" }
}

/// Points of every law at each torque of the table.
fn side_by_side(laws: &[LawCurve]) -> impl Iterator<Item = (f64, Vec<Option<&StaticPoint>>)> {
    let torques = laws.first().map(|l| l.rows.iter().map(|r| r.0)).into_iter().flatten();
    torques
        .enumerate()
        .map(|(i, torque)| (torque, laws.iter().map(|l| l.rows.get(i).and_then(|r| r.1.as_ref())).collect()))
}

fn one_column_each(laws: &[LawCurve], unit: Unit) -> Vec<Column> {
    let torque = Column::number("torque_nm", "Torque", Unit::NewtonMetre, 4);
    let each = laws.iter().map(|l| Column::number(l.name.facts().key, l.name.facts().key, unit, 5));
    std::iter::once(torque).chain(each).collect()
}

/// Windup of the laws side by side, and its difference to that of the first.
pub(super) fn windups(laws: &[LawCurve]) -> Table {
    let mut columns = one_column_each(laws, Unit::Degree);
    columns.extend(laws.iter().skip(1).map(|l| {
        let key = l.name.facts().key;
        Column::number(&format!("{key}_difference"), &format!("{key} diff."), Unit::Percent, 3)
    }));
    let mut table = Table::new(columns);
    for (torque, points) in side_by_side(laws) {
        let windup = |p: &Option<&StaticPoint>| p.map(|p| p.windup_rad);
        let reference = points.first().and_then(windup);
        let mut row: Vec<Cell> = vec![torque.into()];
        row.extend(points.iter().map(|p| Cell::from(windup(p))));
        row.extend(
            points.iter().skip(1).map(|p| Cell::from(windup(p).zip(reference).map(|(w, r)| w / r - 1.0))),
        );
        table.row(row);
    }
    table
}

/// Tangent stiffness of the laws side by side.
pub(super) fn tangents(laws: &[LawCurve]) -> Table {
    let mut table = Table::new(one_column_each(laws, Unit::NewtonMetrePerRadian));
    for (torque, points) in side_by_side(laws) {
        let mut row: Vec<Cell> = vec![torque.into()];
        row.extend(points.iter().map(|p| Cell::from(p.map(|p| p.k_tangent_nm_per_rad))));
        table.row(row);
    }
    table
}

/// Every row of every law.
pub fn csv_table(laws: &[LawCurve]) -> Table {
    let mut all = vec![Column::text("contact", "Contact law")];
    all.extend(columns());
    all.push(Column::text("state", "State"));
    let mut table = Table::new(all);
    for law in laws {
        for (torque, point) in &law.rows {
            let mut row: Vec<Cell> = vec![law.name.facts().key.into()];
            row.extend(cells(*torque, point.as_ref()));
            row.resize(columns().len() + 1, Cell::Empty);
            row.push(state(point.as_ref()).into());
            table.row(row);
        }
        // Who asks for a torque that is not carried gets what becomes of the sprags.
        let asked = law.rows.iter().any(|(_, p)| p.is_none());
        for cells in law.beyond.iter().filter(|_| asked).flat_map(way_over) {
            let mut row: Vec<Cell> = vec![law.name.facts().key.into()];
            row.extend(cells);
            row.push("rolls over".into());
            table.row(row);
        }
    }
    table
}

/// The way over the sprags' highest place, as rows of [`columns`].
fn way_over(way: &RollOver) -> impl Iterator<Item = Vec<Cell>> + '_ {
    way.branch.iter().map(|p| {
        let mut row: Vec<Cell> =
            vec![p.torque_nm.into(), p.normal_inner_n.into(), Cell::Empty, p.tan_omega.into()];
        row.extend([Cell::Empty, p.alpha_rad.into(), p.windup_rad.into()]);
        row.resize(columns().len(), Cell::Empty);
        row
    })
}

/// The answer for a terminal.
pub(super) fn text(study: &StiffnessStudy, screen: Screen) -> String {
    let (design, laws) = (&study.design, study.laws());
    let mut out = format!("{}  {}\n\n", design.name, design.short_hash());
    for law in laws {
        out.push_str(&format!("{}\n", law.clutch.contact.description(&law.clutch.axial)));
    }
    out.push('\n');
    match laws {
        [one] => out.push_str(&full(one).to_text(screen)),
        _ => out.push_str(&format!(
            "Windup, and its difference to that of the first law\n{}\nTangent stiffness\n{}",
            windups(laws).to_text(screen),
            tangents(laws).to_text(screen)
        )),
    }
    out.push('\n');
    for law in laws {
        out.push_str(&format!(
            "{}: curve ends {}{}\n",
            law.name.facts().key,
            end_text(law),
            junction_text(law)
        ));
        if let Some(way) = &law.beyond {
            out.push_str(&format!("{}\n", sentence(way)));
        }
    }
    if let Some(fem) = &study.fem {
        out.push_str(&format!(
            "\nAgainst finite elements\n{}\n{}\n",
            fem::table(study, fem).to_text(screen),
            fem::findings(study, fem).join("\n")
        ));
    }
    if let Some(map) = &study.pressure {
        out.push_str(&format!("\nPressure along the length\n{}\n", map.table().to_text(screen)));
    }
    if laws.len() > 1 {
        if laws.iter().flat_map(|l| &l.rows).any(|(_, p)| p.is_none()) {
            out.push_str("–: beyond the end of the law's curve\n");
        }
        out.push_str("Forces, angles and pressures of every law: --json, --csv or --report\n");
    }
    out
}

/// Junction torques in words, e.g. `; junctions 1|2 at 14.1 Nm, 2|3 at 33.3 Nm`.
pub(super) fn junction_text(law: &LawCurve) -> String {
    let junctions = junctions(&law.curve);
    if junctions.is_empty() {
        return String::new();
    }
    let each: Vec<String> =
        junctions.iter().map(|j| format!("{} at {} Nm", j.label(), significant(j.torque_nm, 4))).collect();
    format!("; junctions {}", each.join(", "))
}

/// Where the curve of a law ends, in words.
pub(super) fn end_text(law: &LawCurve) -> String {
    let (reason, _) = law.curve.end();
    let torque = Unit::NewtonMetre.show(law.curve.end_torque_nm(), 5);
    format!("{} at {torque}", reason.name())
}
