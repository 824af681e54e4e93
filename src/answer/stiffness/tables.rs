//! The curve as tables: one law in full, several side by side, all of it as CSV.

use super::{LawCurve, StiffnessStudy, fem, junctions};
use crate::answer::roll_over::sentence;
use crate::report::{Rows, Screen, Table, Unit, significant};
use crate::wedge::{OverPoint, StaticPoint};

/// A line of a curve.
enum Line<'a> {
    /// A torque asked for, N m, and its state where it is carried.
    Asked(f64, Option<&'a StaticPoint>),
    /// A place on the way over the sprags' highest place.
    Over(&'a OverPoint),
}

impl Line<'_> {
    fn torque_nm(&self) -> f64 {
        match self {
            Self::Asked(torque_nm, _) => *torque_nm,
            Self::Over(p) => p.torque_nm,
        }
    }

    fn of(&self, point: impl Fn(&StaticPoint) -> f64) -> Option<f64> {
        match self {
            Self::Asked(_, p) => p.map(point),
            Self::Over(_) => None,
        }
    }

    /// The same of what the way over has too.
    fn of_both(&self, point: impl Fn(&StaticPoint) -> f64, over: impl Fn(&OverPoint) -> f64) -> Option<f64> {
        match self {
            Self::Asked(..) => self.of(point),
            Self::Over(p) => Some(over(p)),
        }
    }

    fn state(&self) -> &'static str {
        match self {
            Self::Asked(_, Some(_)) => "carried",
            Self::Asked(_, None) => "beyond the end",
            Self::Over(_) => "rolls over",
        }
    }
}

/// The torques asked for, each with the key of its law.
fn asked(law: &LawCurve) -> impl Iterator<Item = (&'static str, Line<'_>)> {
    law.rows.iter().map(|(torque, p)| (law.name.facts().key, Line::Asked(*torque, p.as_ref())))
}

fn lines<'a>(all: impl IntoIterator<Item = (&'static str, Line<'a>)>) -> Table {
    Rows::of(all)
        .text("contact", "Contact law", |(key, _)| *key)
        .number("torque_nm", "Torque", Unit::NewtonMetre, 4, |(_, l)| l.torque_nm())
        .number("normal_inner_n", "N A", Unit::Newton, 5, |(_, l)| {
            l.of_both(|p| p.normal_inner_n, |p| p.normal_inner_n)
        })
        .number("normal_outer_n", "N B", Unit::Newton, 5, |(_, l)| l.of(|p| p.normal_outer_n))
        .number("tan_omega", "tan ω", Unit::One, 4, |(_, l)| l.of_both(|p| p.tan_omega, |p| p.tan_omega))
        .number("tan_nu", "tan ν", Unit::One, 4, |(_, l)| l.of(|p| p.tan_nu))
        .number("alpha_rad", "α", Unit::Radian, 4, |(_, l)| l.of_both(|p| p.alpha_rad, |p| p.alpha_rad))
        .number("windup_deg", "Windup", Unit::Degree, 5, |(_, l)| {
            l.of_both(|p| p.windup_rad, |p| p.windup_rad)
        })
        .number("k_secant_nm_per_rad", "K sec", Unit::NewtonMetrePerRadian, 5, |(_, l)| {
            l.of(|p| p.k_secant_nm_per_rad)
        })
        .number("k_tangent_nm_per_rad", "K tan", Unit::NewtonMetrePerRadian, 5, |(_, l)| {
            l.of(|p| p.k_tangent_nm_per_rad)
        })
        .number("arc", "Arc", Unit::One, 1, |(_, l)| match l {
            Line::Asked(_, p) => p.map(|p| p.arc + 1),
            Line::Over(_) => None,
        })
        .number("hertz_inner_mpa", "p₀ A", Unit::Megapascal, 4, |(_, l)| l.of(|p| p.hertz_inner_pa))
        .number("hertz_outer_mpa", "p₀ B", Unit::Megapascal, 4, |(_, l)| l.of(|p| p.hertz_outer_pa))
        .text("state", "State", |(_, l)| l.state())
        .table()
}

/// One law in full. A torque beyond the curve's end is a row that says so.
pub(super) fn full(law: &LawCurve) -> Table {
    let beyond = law.rows.iter().any(|(_, p)| p.is_none());
    let mut table = lines(asked(law));
    for column in &mut table.columns {
        column.for_people = column.key != "contact" && (beyond || column.key != "state");
    }
    table
}

/// The torques of the table, each with its place in the rows of the laws.
fn torques(laws: &[LawCurve]) -> Rows<(usize, f64)> {
    let all = laws.first().map_or(&[][..], |law| &law.rows);
    Rows::of(all.iter().map(|row| row.0).enumerate()).number(
        "torque_nm",
        "Torque",
        Unit::NewtonMetre,
        4,
        |(_, torque)| *torque,
    )
}

/// Key of a law, and heading.
fn named(law: &&LawCurve) -> (String, String) {
    let key = law.name.facts().key;
    (key.to_owned(), key.to_owned())
}

fn at<'a>(law: &'a LawCurve, (i, _): &(usize, f64)) -> Option<&'a StaticPoint> {
    law.rows.get(*i)?.1.as_ref()
}

/// Windup of the laws side by side, and its difference to that of the first.
pub(super) fn windups(laws: &[LawCurve]) -> Table {
    let windup = |law: &LawCurve, row: &(usize, f64)| Some(at(law, row)?.windup_rad);
    let difference = |law: &&LawCurve| {
        let key = law.name.facts().key;
        (format!("{key}_difference"), format!("{key} diff."))
    };
    torques(laws)
        .each(laws, named, Unit::Degree, 5, |row, law| windup(law, row))
        .each(laws.iter().skip(1), difference, Unit::Percent, 3, |row, law| {
            Some(windup(law, row)? / windup(laws.first()?, row)? - 1.0)
        })
        .table()
}

/// Tangent stiffness of the laws side by side.
pub(super) fn tangents(laws: &[LawCurve]) -> Table {
    torques(laws)
        .each(laws, named, Unit::NewtonMetrePerRadian, 5, |row, law| Some(at(law, row)?.k_tangent_nm_per_rad))
        .table()
}

/// Every row of every law. Who asks for a torque that is not carried gets what becomes of the sprags.
pub(super) fn csv_table(laws: &[LawCurve]) -> Table {
    lines(laws.iter().flat_map(|law| {
        let over = law.beyond.iter().filter(|_| law.rows.iter().any(|(_, p)| p.is_none()));
        let over = over.flat_map(|way| &way.branch).map(|p| (law.name.facts().key, Line::Over(p)));
        asked(law).chain(over)
    }))
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
