//! A result of finite elements beside the design's own contact law.

use super::left_out::LeftOut;
use super::page::begun;
use super::{Envelope, Provenance};
use crate::design::Design;
use crate::export::calculix::{Facts, ResultRow};
use crate::report::{Cell, Column, Page, Table, Unit};
use crate::wedge::{StaticPoint, WedgeCurve};
use serde::Serialize;

/// Keys of a result that was read back.
#[derive(Debug, Clone, Serialize)]
pub struct FiniteElementBody {
    /// Who computed it.
    pub source: &'static str,
    /// Variant of the deck.
    pub variant: String,
    /// Spacing of the mesh at the contacts, mm.
    pub mesh_mm: f64,
    /// The rows.
    pub points: Vec<FiniteElementPoint>,
}

/// A row of finite elements beside the design's own law.
#[derive(Debug, Clone, Serialize)]
pub struct FiniteElementPoint {
    /// Torque, N m.
    pub torque_nm: f64,
    /// N_bi, N.
    pub normal_inner_n: f64,
    /// N_be, N.
    pub normal_outer_n: f64,
    /// tan omega at A.
    pub tan_omega: f64,
    /// tan nu at B.
    pub tan_nu: f64,
    /// Windup, degrees.
    pub windup_deg: f64,
    /// Secant stiffness, N m/rad.
    pub k_secant_nm_per_rad: f64,
    /// Largest pressure at A, MPa.
    pub hertz_inner_mpa: Option<f64>,
    /// Windup by the design's law, degrees.
    pub law_windup_deg: Option<f64>,
    /// N_bi by the design's law, N.
    pub law_normal_inner_n: Option<f64>,
}

/// Rows of a result of CalculiX beside the curve of the design.
#[derive(Debug, Clone)]
pub struct FiniteElements<'a> {
    design: &'a Design,
    facts: &'a Facts,
    rows: &'a [ResultRow],
    /// The design's own law at the same torques.
    law: Vec<Option<StaticPoint>>,
}

impl<'a> FiniteElements<'a> {
    /// `rows` of a result whose deck says `facts`.
    pub fn of(design: &'a Design, facts: &'a Facts, rows: &'a [ResultRow]) -> Self {
        let curve =
            design.clutch.profile().ok().and_then(|p| WedgeCurve::build(&design.clutch, &p, 0.0).ok());
        let law = rows.iter().map(|r| curve.as_ref().and_then(|c| c.at_torque(r.torque_nm))).collect();
        Self { design, facts, rows, law }
    }

    /// The rows, the design's law beside them.
    pub fn table(&self) -> Table {
        table(self.rows, &self.law)
    }

    /// The answer with the keys that all answers share; `run_time_s`: what it took, s.
    pub fn envelope(&self, run_time_s: f64) -> Envelope<'a, FiniteElementBody> {
        Envelope {
            design: self.design,
            run_time_s,
            left_out: left_out(self.facts),
            error_estimate: None,
            body: body(self.facts, self.rows, &self.law),
        }
    }

    /// The answer as a page.
    pub fn page(&self, provenance: &Provenance) -> Page {
        let mut page = begun("Finite elements", self.design, &provenance.command);
        page.heading("CalculiX beside the design's contact law").table("", &self.table());
        self.envelope(provenance.run_time_s).close(&mut page);
        page
    }
}

fn body(facts: &Facts, rows: &[ResultRow], law: &[Option<StaticPoint>]) -> FiniteElementBody {
    let points = rows
        .iter()
        .zip(law)
        .map(|(r, l)| FiniteElementPoint {
            torque_nm: r.torque_nm,
            normal_inner_n: r.normal_inner_n,
            normal_outer_n: r.normal_outer_n,
            tan_omega: r.tan_omega,
            tan_nu: r.tan_nu,
            windup_deg: r.windup_rad.to_degrees(),
            k_secant_nm_per_rad: r.torque_nm / r.windup_rad,
            hertz_inner_mpa: r.pressure_inner_pa.map(|p| 1e-6 * p),
            law_windup_deg: l.map(|l| l.windup_rad.to_degrees()),
            law_normal_inner_n: l.map(|l| l.normal_inner_n),
        })
        .collect();
    FiniteElementBody { source: "calculix", variant: facts.variant.clone(), mesh_mm: facts.mesh_mm, points }
}

fn table(rows: &[ResultRow], law: &[Option<StaticPoint>]) -> Table {
    let mut table = Table::new(vec![
        Column::number("torque_nm", "Torque", Unit::NewtonMetre, 5),
        Column::number("normal_inner_n", "N inner", Unit::Newton, 5),
        Column::number("windup_deg", "Windup", Unit::Degree, 5),
        Column::number("hertz_inner_mpa", "Pressure inner", Unit::Megapascal, 4),
        Column::number("tan_omega", "tan ω", Unit::One, 4),
        Column::number("k_secant_nm_per_rad", "Secant", Unit::NewtonMetrePerRadian, 4),
        Column::number("law_normal_inner_n", "N, law", Unit::Newton, 5),
        Column::number("law_windup_deg", "Windup, law", Unit::Degree, 5),
        Column::number("law_over_fe_percent", "Law over FE", Unit::Percent, 3),
    ]);
    for (r, l) in rows.iter().zip(law) {
        table.row(vec![
            r.torque_nm.into(),
            r.normal_inner_n.into(),
            r.windup_rad.into(),
            r.pressure_inner_pa.into(),
            r.tan_omega.into(),
            (r.torque_nm / r.windup_rad).into(),
            l.map(|l| l.normal_inner_n).into(),
            l.map(|l| l.windup_rad).into(),
            l.map_or(Cell::Empty, |l| (l.windup_rad / r.windup_rad - 1.0).into()),
        ]);
    }
    table
}

fn left_out(facts: &Facts) -> Vec<LeftOut> {
    let mut list = vec![
        LeftOut::new(
            "slip and the design's friction",
            "the deck sticks but for a narrow rim of each patch: its friction is its own",
            "none while the clutch sticks",
        ),
        LeftOut::new(
            "separation of windup and shear of the rings",
            "windup is the turn of the outside against the bore, the library's that of rigid races",
            "0.1 % for the clutch of Table 1",
        ),
    ];
    if facts.variant != "solid" {
        list.push(LeftOut::new(
            "width of the races",
            "a plane deck has races as long as the sprag",
            "windup 25 % smaller with races twice as wide (finite elements, clutch of Table 1)",
        ));
    }
    list
}
