//! The catalogue's rows, those left out with the reason, and the questions that they become.

use std::error::Error;
use std::f64::consts::PI;
use std::fmt::Write;

/// Race space of the series at rest, mm.
pub(crate) const GAP_MM: f64 = 8.33;
/// Pitch of the sprags at mid-gap, mm; from the weights, see the report.
pub(crate) const PITCH_MM: f64 = 8.0;

/// One row.
#[derive(Debug, Clone)]
pub(crate) struct Row {
    pub(crate) name: String,
    /// Inner track diameter.
    pub(crate) inner_mm: f64,
    /// W.
    pub(crate) width_mm: f64,
    /// Sprag width.
    pub(crate) length_mm: f64,
    pub(crate) torque_nm: f64,
    pub(crate) weight_kg: f64,
}

/// Rows that are not used, and why.
pub(crate) const LEFT_OUT: [(&str, &str); 2] = [
    (
        "FE 8050 Z 25",
        "the designation says a width of 25 mm, the columns 19 mm with sprags of 16 mm; torque and weight are those of a \
         19 mm row",
    ),
    (
        "FE 8103 Z 19",
        "the weight, 0.290 kg, lies between 0.184 kg (Z 16) and 0.300 kg (Z 25) where 0.225 kg belongs: 25 % above every other \
         row's weight per sprag and mm; a row with one misprint is not trusted in the others",
    ),
];

impl Row {
    pub(crate) fn left_out(&self) -> Option<&'static str> {
        LEFT_OUT.iter().find(|(name, _)| *name == self.name).map(|(_, why)| *why)
    }

    /// Sprags at [`PITCH_MM`].
    pub(crate) fn count(&self) -> f64 {
        (PI * (self.inner_mm + GAP_MM) / PITCH_MM).round()
    }

    /// Weight per sprag and mm of W, g.
    pub(crate) fn weight_each_g(&self) -> f64 {
        1e3 * self.weight_kg / (self.count() * self.width_mm)
    }

    /// Keys of the design that this row sets: races as the maker calculates (solid shaft, D/D_L = 1.4, W + 3 mm).
    pub(crate) fn keys(&self) -> [(&'static str, f64); 7] {
        let inner = 0.5 * self.inner_mm;
        let outer = inner + GAP_MM;
        [
            ("races.inner_radius_mm", inner),
            ("races.outer_radius_mm", outer),
            ("races.outer_outside_radius_mm", 1.4 * outer),
            ("races.width_mm", self.width_mm + 3.0),
            ("sprags.count", self.count()),
            ("sprags.length_mm", self.length_mm),
            ("limits.nominal_torque_nm", self.torque_nm),
        ]
    }
}

/// Rows of the catalogue's CSV.
pub(crate) fn read(text: &str) -> Result<Vec<Row>, Box<dyn Error>> {
    let mut rows = Vec::new();
    for line in text.lines().filter(|l| !l.starts_with('#')).skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let number =
            |k: usize| cells.get(k).ok_or("a short row")?.parse::<f64>().map_err(Box::<dyn Error>::from);
        rows.push(Row {
            name: cells[0].to_owned(),
            inner_mm: number(1)?,
            width_mm: number(3)?,
            length_mm: number(4)?,
            torque_nm: number(5)?,
            weight_kg: number(6)?,
        });
    }
    Ok(rows)
}

/// One in `every` of the rows in use goes into the fit, the second row first, chosen without a look at any torque.
pub(crate) fn observations(rows: &[Row], every: usize) -> String {
    let Some(first) = rows.first() else { return String::new() };
    let keys: Vec<&str> = first.keys().iter().map(|(key, _)| *key).collect();
    let mut csv = format!("label,use,{},nominal_torque_nm\n", keys.join(","));
    for (i, row) in rows.iter().filter(|r| r.left_out().is_none()).enumerate() {
        let purpose = if i % every == 1 % every { "fit" } else { "check" };
        let values: Vec<String> = row.keys().iter().map(|(_, v)| v.to_string()).collect();
        let _ = writeln!(csv, "{},{purpose},{},{}", row.name, values.join(","), row.torque_nm);
    }
    csv
}
