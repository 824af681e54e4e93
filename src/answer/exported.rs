//! What an export says beside the file: the arcs as tables and JSON, what a drawing or a solid leaves out.

use super::Envelope;
use super::left_out::LeftOut;
use crate::clutch::EndProfile;
use crate::design::Design;
use crate::export::rows::{SurfacePoint, SurfaceRow, arcs, points};
use crate::export::{DrawnClutch, MadeClutch, NoPart, Part, dxf::dxf, step::step, svg::svg};
use crate::report::{Cell, Column, Rows, Table, Unit};
use serde::Serialize;

/// From here the drawn sprag is said to weigh otherwise than the one computed.
const OTHER_MASS: f64 = 5e-3;

/// Smallest deviation of points, mm: a hundredth of what a length standard resolves, and file sizes stay bounded.
pub const LEAST_DEVIATION_MM: f64 = 1e-5;
/// Deviation of points if none is asked for, mm.
pub const DEVIATION_MM: f64 = 1e-3;

/// What a part is written as.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PartFormat {
    /// Drawing, DXF.
    Dxf,
    /// Solid, STEP.
    Step,
    /// Drawing, SVG.
    Svg,
    /// Table of arcs and flanks, CSV.
    Arcs,
    /// Table of points on them, CSV; the most that a chord between two leaves its arc, mm.
    Points {
        /// From [`LEAST_DEVIATION_MM`] on.
        deviation_mm: f64,
    },
}

impl PartFormat {
    /// Name of the format.
    pub fn name(self) -> &'static str {
        match self {
            Self::Dxf => "dxf",
            Self::Step => "step",
            Self::Svg => "svg",
            Self::Arcs | Self::Points { .. } => "csv",
        }
    }

    /// The clutch of a design, as `part` can be written of it in this format.
    ///
    /// # Errors
    /// [`NoPart`].
    pub fn made(self, design: &Design, part: Part) -> Result<MadeClutch, NoPart> {
        let made = design.made_clutch()?;
        // The arcs of a sprag are known without its flanks.
        if self != Self::Arcs || part != Part::Sprag {
            made.closed(part)?;
        }
        Ok(made)
    }

    /// The file.
    ///
    /// # Errors
    /// What a table says that cannot be written.
    pub fn text(self, part: Part, subject: &DrawnClutch<'_>) -> Result<String, String> {
        let table = match self {
            Self::Dxf => return Ok(dxf(part, subject)),
            Self::Svg => return Ok(svg(part, subject)),
            Self::Step => return Ok(step(part, subject)),
            Self::Arcs => arcs_table(&arcs(part, subject)),
            Self::Points { deviation_mm } => points_table(&points(part, subject, 1e-3 * deviation_mm)),
        };
        let bytes = table.to_csv().map_err(|e| format!("CSV: {e}"))?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }
}

/// A part of a design as a drawing, a solid or a table.
#[derive(Debug, Clone, Copy)]
pub struct Exported<'a> {
    /// The design.
    pub design: &'a Design,
    /// What is drawn of it.
    pub subject: &'a DrawnClutch<'a>,
    /// Which part.
    pub part: Part,
    /// Its format.
    pub format: PartFormat,
    /// Length of the file, bytes.
    pub bytes: usize,
}

/// An arc or a flank.
#[derive(Debug, Clone, Serialize)]
pub struct ArcBody {
    /// Azimuths of its ends from the centre, deg.
    pub angles_deg: Option<[f64; 2]>,
    /// The body that it bounds.
    pub body: String,
    /// Centre, mm; null of a flank.
    pub centre_mm: Option<[f64; 2]>,
    /// Its ends, mm; null of a full circle.
    pub ends_mm: Option<[[f64; 2]; 2]>,
    /// Radius, mm.
    pub radius_mm: Option<f64>,
    /// Name of the arc or flank.
    pub surface: String,
}

/// Keys of `export`.
#[derive(Debug, Clone, Serialize)]
pub struct ExportedBody<'a> {
    /// Every arc and flank.
    pub arcs: Vec<ArcBody>,
    /// Length of the file, bytes.
    pub bytes: usize,
    /// Name of the format.
    pub format: &'a str,
    /// Mass of the drawn sprag over the one that the design gives; null: it gives none.
    pub mass_over_given: Option<f64>,
    /// Which part is drawn.
    pub part: &'static str,
    /// Where the file is.
    pub written: Option<&'a str>,
}

impl ArcBody {
    fn of(row: SurfaceRow) -> Self {
        let mm = |m: f64| Unit::Millimetre.from_si(m);
        Self {
            body: row.body,
            surface: row.surface,
            centre_mm: row.circle_m.map(|(centre, _)| centre.map(mm)),
            radius_mm: row.circle_m.map(|(_, radius)| mm(radius)),
            angles_deg: row.angles_rad.map(|a| a.map(f64::to_degrees)),
            ends_mm: row.ends_m.map(|e| e.map(|p| p.map(mm))),
        }
    }
}

impl<'a> Exported<'a> {
    /// The answer with the keys that all answers share; `run_time_s`: what it took, s; `written`: where the file is.
    pub fn envelope(&self, run_time_s: f64, written: Option<&'a str>) -> Envelope<'a, ExportedBody<'a>> {
        let body = ExportedBody {
            format: self.format.name(),
            part: self.part.name(),
            written,
            bytes: self.bytes,
            mass_over_given: self.subject.mass_excess().map(|excess| 1.0 + excess),
            arcs: arcs(self.part, self.subject).into_iter().map(ArcBody::of).collect(),
        };
        Envelope { design: self.design, run_time_s, left_out: self.left_out(), error_estimate: None, body }
    }

    /// What the one who makes the sprag should know.
    pub fn note(&self) -> Option<String> {
        let excess = self.subject.mass_excess().filter(|e| self.part.has_sprag() && e.abs() > OTHER_MASS)?;
        Some(format!(
            "note: the sprag drawn weighs {:+.1} % against the mass_kg that the design gives and computes with; leave out \
             mass_kg, inertia_kg_m2 and centroid, and they follow from the outline",
            1e2 * excess
        ))
    }

    fn left_out(&self) -> Vec<LeftOut> {
        let mut list = vec![LeftOut::new(
            "edges, chamfers, grooves for the spring, cage",
            "the design holds working surfaces and flanks, nothing else",
            "mass and inertia of what is added or cut away",
        )];
        if self.part.has_sprag()
            && self.format == PartFormat::Step
            && self.subject.clutch.axial.end_profile != EndProfile::Square
        {
            list.push(LeftOut::new(
                "the profile of the ends",
                "solids are prisms; the drop towards the ends is micrometres",
                "the edge pressure of square ends, if made so: see [axial]",
            ));
        }
        list
    }
}

/// Every arc and flank, for CSV.
fn arcs_table(rows: &[SurfaceRow]) -> Table {
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

/// Points on them, for CSV.
fn points_table(points: &[SurfacePoint]) -> Table {
    Rows::of(points)
        .text("body", "Body", |p| p.body.as_str())
        .text("surface", "Surface", |p| p.surface.as_str())
        .number("x_mm", "x", Unit::Millimetre, 6, |p| p.at_m[0])
        .number("y_mm", "y", Unit::Millimetre, 6, |p| p.at_m[1])
        .table()
}
