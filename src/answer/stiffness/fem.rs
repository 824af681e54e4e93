//! Finite-element results beside the laws.

use super::{LawCurve, StiffnessStudy};
use crate::report::{Rows, Table, Unit};
use crate::wedge::WedgeCurve;
use serde::Serialize;

/// Rows of a result, torque ascending.
#[derive(Debug, Clone)]
pub struct Fem {
    /// The rows.
    pub rows: Vec<FemRow>,
    /// Whether the table says how far its races twist between rim and track, which is taken off its windup.
    pub untwisted: bool,
}

/// One row of finite elements.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FemRow {
    /// Torque, N m.
    pub torque_nm: f64,
    /// Windup, track against track where the table allows it, rad.
    pub windup_rad: f64,
    /// N_bi, N, where the table has it.
    pub normal_n: Option<f64>,
}

impl Fem {
    /// Rows of a CSV with the columns `torque_nm`, `windup_deg` and `normal_inner_n` or `normal_n` if there; with a column
    /// `races_twist_deg` windup is that of the rims and the column is taken off; `model`: texts
    /// separated by |, one of which the column `model` must hold; `name`: what errors call the table.
    ///
    /// # Errors
    /// What is wrong with the table, with name and line.
    pub fn parse(text: &str, name: &str, model: Option<&str>) -> Result<Self, String> {
        let fault = |line: u64, what: &str| format!("{name}:{line}: {what}");
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let headers = reader.headers().map_err(|e| fault(1, &e.to_string()))?.clone();
        let column = |wanted: &[&str]| headers.iter().position(|h| wanted.contains(&h.trim()));
        let missing = |what: &str| {
            let found = headers.iter().collect::<Vec<_>>().join(", ");
            fault(1, &format!("no column {what}; found: {found}"))
        };
        let torque = column(&["torque_nm"]).ok_or_else(|| missing("torque_nm"))?;
        let windup = column(&["windup_deg"]).ok_or_else(|| missing("windup_deg"))?;
        let twist = column(&["races_twist_deg"]);
        let normal = column(&["normal_inner_n", "normal_n"]);
        let model_at = match model {
            Some(_) => Some(column(&["model"]).ok_or_else(|| missing("model, which --fem-model reads"))?),
            None => None,
        };
        let mut rows = Vec::new();
        for record in reader.records() {
            let record = record.map_err(|e| format!("{name}: {e}"))?;
            let line = record.position().map_or(0, csv::Position::line);
            let text = |at: usize| record.get(at).unwrap_or_default().trim();
            if let (Some(model), Some(at)) = (model, model_at)
                && !model.split('|').any(|m| text(at).contains(m.trim()))
            {
                continue;
            }
            let number = |at: usize, what: &str| match text(at).parse::<f64>() {
                Ok(v) if v > 0.0 && v.is_finite() => Ok(v),
                _ => Err(fault(line, &format!("{what}: found \"{}\"; allowed: a number above 0", text(at)))),
            };
            let twist_deg = twist.map_or(Ok(0.0), |at| number(at, "races_twist_deg"))?;
            let between_tracks_deg = number(windup, "windup_deg")? - twist_deg;
            if between_tracks_deg <= 0.0 {
                return Err(fault(line, "races_twist_deg is not less than windup_deg"));
            }
            rows.push(FemRow {
                torque_nm: number(torque, "torque_nm")?,
                windup_rad: between_tracks_deg.to_radians(),
                normal_n: normal.map(|at| number(at, "normal_n")).transpose()?,
            });
        }
        if rows.is_empty() {
            let of = model.map_or(String::new(), |m| format!(" whose model holds \"{m}\""));
            return Err(format!("{name}: no rows{of}"));
        }
        rows.sort_by(|a, b| a.torque_nm.total_cmp(&b.torque_nm));
        Ok(Self { rows, untwisted: twist.is_some() })
    }
}

/// A law against one row; absent beyond the end of a curve or where the file has no force.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Distance {
    /// Windup over that of finite elements, less one.
    pub windup: Option<f64>,
    /// The same with local deformation alone.
    pub windup_local_only: Option<f64>,
    /// Normal force at A over that of finite elements, less one.
    pub normal: Option<f64>,
}

/// One row of the JSON, with the distance of each law.
#[derive(Debug, Clone, Serialize)]
pub struct FemPoint {
    /// Torque, N m.
    pub torque_nm: f64,
    /// Windup, degrees.
    pub windup_deg: f64,
    /// N_bi, N.
    pub normal_inner_n: Option<f64>,
    /// Distance of each law, in the order of the laws.
    pub laws: Vec<Distance>,
}

pub(super) fn points(study: &StiffnessStudy, fem: &Fem) -> Vec<FemPoint> {
    let row = |row: &FemRow| FemPoint {
        torque_nm: row.torque_nm,
        windup_deg: Unit::Degree.from_si(row.windup_rad),
        normal_inner_n: row.normal_n,
        laws: study.laws().iter().map(|l| distance(l, row)).collect(),
    };
    fem.rows.iter().map(row).collect()
}

/// Distance of a law to a row.
pub(super) fn distance(law: &LawCurve, row: &FemRow) -> Distance {
    let windup =
        |curve: &WedgeCurve| curve.at_torque(row.torque_nm).map(|p| p.windup_rad / row.windup_rad - 1.0);
    let normal = law.curve.at_torque(row.torque_nm).zip(row.normal_n);
    Distance {
        windup: windup(&law.curve),
        windup_local_only: windup(&law.local),
        normal: normal.map(|(p, n)| p.normal_inner_n / n - 1.0),
    }
}

/// Distances of every law at every row.
pub(super) fn table(study: &StiffnessStudy, fem: &Fem) -> Table {
    type Of = fn(&Distance) -> Option<f64>;
    let each = study.laws().iter().flat_map(|law| {
        let key = law.name.facts().key;
        let columns: [(&str, String, usize, Of); 3] = [
            ("windup", format!("{key}: windup"), 3, |d| d.windup),
            ("local", "local only".to_owned(), 3, |d| d.windup_local_only),
            ("normal", "N".to_owned(), 2, |d| d.normal),
        ];
        columns.map(|(of, heading, digits, value)| (law, format!("{key}_{of}"), heading, digits, value))
    });
    let rows = Rows::of(&fem.rows)
        .number("torque_nm", "Torque", Unit::NewtonMetre, 4, |row| row.torque_nm)
        .number("fem_windup_deg", "FE windup", Unit::Degree, 4, |row| row.windup_rad);
    let rows = each.fold(rows, |rows, (law, key, heading, digits, value)| {
        rows.number(&key, &heading, Unit::Percent, digits, |row| value(&distance(law, row)))
    });
    rows.table()
}

/// Largest magnitude of a distance over the rows of a law.
fn worst(law: &LawCurve, fem: &Fem, of: impl Fn(&Distance) -> Option<f64>) -> Option<f64> {
    let each = fem.rows.iter().filter_map(|row| of(&distance(law, row)));
    each.map(f64::abs).reduce(f64::max)
}

/// What the rows say of the laws, and whether the paper's order holds: slices nearer than the roller law, local plus
/// structural nearer than local alone.
pub(super) fn findings(study: &StiffnessStudy, fem: &Fem) -> Vec<String> {
    let percent = |x: f64| format!("{} %", crate::report::significant(100.0 * x, 3));
    let mut out = vec![match fem.untwisted {
        true => "compared track with track: the torsion of the races, column races_twist_deg, is taken off",
        false => "compared as if track with track: the table does not say how far its races twist (races_twist_deg)",
    }
    .to_owned()];
    for law in study.laws() {
        let (whole, local) = (worst(law, fem, |d| d.windup), worst(law, fem, |d| d.windup_local_only));
        if let (Some(whole), Some(local)) = (whole, local) {
            let nearer = if whole < local { "nearer" } else { "farther off" };
            out.push(format!(
                "{}: at most {} off, local deformation alone {}: local plus structural is {nearer}",
                law.name.facts().key,
                percent(whole),
                percent(local)
            ));
        }
    }
    let of = |key: &str| {
        study.laws().iter().find(|l| l.name.facts().key == key).and_then(|l| worst(l, fem, |d| d.windup))
    };
    if let (Some(roller), Some(slice)) = (of("roller").or(of("din26281")), of("slice")) {
        let (nearer, holds) =
            if slice < roller { ("nearer to", "holds") } else { ("farther from", "does not hold") };
        out.push(format!(
            "the paper's order {holds}: slices are {nearer} finite elements than its Hertz curve, the roller law ({} \
             against {})",
            percent(slice),
            percent(roller)
        ));
    }
    out
}
