//! Pressure along the length of the contacts, by slices.

use super::LawCurve;
use crate::answer::page::half;
use crate::contact::ContactError;
use crate::report::{Plot, Rows, Table, Unit};
use crate::wedge::{Along, Edge, Lengthwise, Peak, Side, along};
use serde::Serialize;

/// Torques of the map.
const TORQUES: usize = 6;

/// Pressure over torque and length, at A and B.
#[derive(Debug, Clone)]
pub struct PressureMap {
    /// The torques.
    pub rows: Vec<PressureRow>,
}

/// Both contacts under one torque.
#[derive(Debug, Clone)]
pub struct PressureRow {
    /// Torque, N m.
    pub torque_nm: f64,
    /// At A.
    pub inner: Along,
    /// At B.
    pub outer: Along,
}

/// The map in JSON, per contact; lengths from the middle of the contact.
#[derive(Debug, Clone, Serialize)]
pub struct PressureBody {
    /// Torques, N m.
    pub torques_nm: Vec<f64>,
    /// At A.
    pub inner: ContactBody,
    /// At B.
    pub outer: ContactBody,
}

/// Pressure along one contact.
#[derive(Debug, Clone, Serialize)]
pub struct ContactBody {
    /// Places from the middle of the contact, mm.
    pub y_mm: Vec<f64>,
    /// Pressure there, MPa, one list per torque.
    pub pressure_mpa: Vec<Vec<f64>>,
    /// The largest of each torque.
    pub peak: Vec<PeakBody>,
}

/// Largest pressure along a contact.
#[derive(Debug, Clone, Serialize)]
pub struct PeakBody {
    /// Pressure, MPa.
    pub mpa: f64,
    /// Where, from the middle of the contact, mm.
    pub y_mm: f64,
    /// `bounded`, or why the value is one of the slice width: `singular-at-the-end`, `flush-ends`; `unloaded`.
    pub kind: &'static str,
    /// Width of a slice, mm.
    pub slice_width_mm: f64,
}

impl PressureMap {
    /// Of `law` at torques spread over its rows.
    ///
    /// # Errors
    /// As [`along`].
    pub fn of(law: &LawCurve, how: Lengthwise) -> Result<Self, ContactError> {
        let carried: Vec<f64> = law.rows.iter().filter(|r| r.1.is_some()).map(|r| r.0).collect();
        let last = carried.len().saturating_sub(1);
        let mut picked: Vec<usize> = (1..=TORQUES).map(|i| last * i / TORQUES).collect();
        picked.dedup();
        let elastic = &law.curve.statics().elastic;
        let mut rows = Vec::new();
        for torque_nm in picked.into_iter().filter_map(|i| carried.get(i).copied()) {
            let Some(p) = law.curve.at_torque(torque_nm) else { continue };
            let inner = along(&law.clutch, &elastic.inner_contact[p.arc], Side::Inner, p.normal_inner_n, how);
            let outer = along(&law.clutch, &elastic.outer_contact, Side::Outer, p.normal_outer_n, how);
            rows.push(PressureRow { torque_nm, inner: inner?, outer: outer? });
        }
        Ok(Self { rows })
    }

    fn plot(&self, title: &str, of: impl Fn(&PressureRow) -> &Along) -> String {
        let mut plot = Plot::new("Along the contact, mm", title);
        for row in &self.rows {
            let found = of(row);
            let points = found.y_m.iter().zip(&found.pressure_pa);
            let points = points.map(|(y, p)| [Unit::Millimetre.from_si(*y), Unit::Megapascal.from_si(*p)]);
            plot = plot.curve(&Unit::NewtonMetre.show_plain(row.torque_nm, 3), points.collect());
        }
        half(plot)
    }

    /// Pressure over the length, a curve per torque, at A and B.
    pub(super) fn figures(&self) -> [(String, &'static str); 2] {
        [
            (self.plot("Peak pressure along A, MPa", |r| &r.inner), "Inner contact."),
            (self.plot("Peak pressure along B, MPa", |r| &r.outer), "Outer contact."),
        ]
    }

    /// Middle, largest value, where and of what kind.
    pub(super) fn table(&self) -> Table {
        let words = |found: &Along| {
            let width = Unit::Millimetre.show(slice_width(found), 3);
            match peak(found).2 {
                SINGULAR => format!("singular at the end, value at slices of {width}"),
                FLUSH => format!("flush ends, bounded but not known: value at slices of {width}"),
                other => other.to_owned(),
            }
        };
        Rows::of(self.rows.iter().flat_map(|r| [(r, "A", &r.inner), (r, "B", &r.outer)]))
            .number("torque_nm", "Torque", Unit::NewtonMetre, 4, |(r, ..)| r.torque_nm)
            .text("contact", "Contact", |(_, name, _)| *name)
            .number("middle_mpa", "Middle", Unit::Megapascal, 4, |(.., found)| {
                found.pressure_pa.get(found.pressure_pa.len() / 2).copied().unwrap_or(0.0)
            })
            .number("largest_mpa", "Largest", Unit::Megapascal, 4, |(.., found)| peak(found).0)
            .number("at_mm", "at", Unit::Millimetre, 3, |(.., found)| peak(found).1)
            .text("kind", "What it is", |(.., found)| words(found))
            .table()
    }

    pub(super) fn body(&self) -> PressureBody {
        let mm = |m: f64| Unit::Millimetre.from_si(m);
        let mpa = |pa: f64| Unit::Megapascal.from_si(pa);
        let largest = |found: &Along| {
            let (pa, y_m, kind) = peak(found);
            PeakBody { mpa: mpa(pa), y_mm: mm(y_m), kind, slice_width_mm: mm(slice_width(found)) }
        };
        let contact = |of: fn(&PressureRow) -> &Along| {
            let all = || self.rows.iter().map(of);
            ContactBody {
                y_mm: all().take(1).flat_map(|found| &found.y_m).map(|y| mm(*y)).collect(),
                pressure_mpa: all().map(|f| f.pressure_pa.iter().map(|pa| mpa(*pa)).collect()).collect(),
                peak: all().map(largest).collect(),
            }
        };
        PressureBody {
            torques_nm: self.rows.iter().map(|r| r.torque_nm).collect(),
            inner: contact(|r| &r.inner),
            outer: contact(|r| &r.outer),
        }
    }
}

const SINGULAR: &str = "singular-at-the-end";
const FLUSH: &str = "flush-ends";

fn slice_width(found: &Along) -> f64 {
    match found.y_m.as_slice() {
        [a, b, ..] => b - a,
        _ => 0.0,
    }
}

/// Largest pressure, Pa, its place, m, and kind.
fn peak(found: &Along) -> (f64, f64, &'static str) {
    match found.peak {
        Peak::None => (0.0, 0.0, "unloaded"),
        Peak::Bounded { pressure_pa, y_m } => (pressure_pa, y_m, "bounded"),
        Peak::AtEnd { end, edge } => {
            let y = if end == 0 { found.y_m.first() } else { found.y_m.last() };
            let (value, kind) = match edge {
                Edge::Singular { value_at_slice_width_pa, .. } => (value_at_slice_width_pa, SINGULAR),
                Edge::Flush { value_at_slice_width_pa, .. } => (value_at_slice_width_pa, FLUSH),
                Edge::Bounded { pressure_pa } => (pressure_pa, "bounded"),
                Edge::Open => (0.0, "unloaded"),
            };
            (value, y.copied().unwrap_or(0.0), kind)
        }
    }
}
