//! What a comparison of designs answers: inputs that differ, margins, figures, scenes.

mod figures;
mod page;
mod tables;

use super::check::{fine, margin_text};
use super::left_out::left_out_of;
use super::{Envelope, Provenance};
use crate::compare::{Scene, SideBySide, Subject, inputs_that_differ, margins, proud_m, scenes};
use crate::design::{Design, Input};
use crate::follow::Follow;
use crate::margin::{LIFT_OFF_TO_RAD_S, Margin, NoMargins};
use crate::report::{Page, Screen, Table, Unit, greek};
use serde_json::{Value, json};
use std::path::Path;

/// Designs with all that differs.
#[derive(Debug, Clone)]
pub struct Comparison<'a> {
    /// The designs, the one before first.
    pub subjects: &'a [Subject],
    /// Where each comes from.
    pub files: &'a [String],
    /// Inputs that differ.
    pub inputs: Vec<SideBySide<Input>>,
    /// Margins side by side.
    pub margins: Vec<SideBySide<&'a Margin>>,
    /// Scenes side by side.
    pub scenes: Vec<SideBySide<&'a Scene>>,
}

/// A, B, C ...: short enough for a heading.
fn letter(i: usize) -> String {
    char::from(b'A' + u8::try_from(i).unwrap_or(0)).to_string()
}

/// The letter of a design with the name of its file: designs out of one another have one name.
fn label(compared: &Comparison<'_>, i: usize) -> String {
    let file = compared.files.get(i).and_then(|file| Path::new(file).file_name());
    file.map_or_else(|| letter(i), |file| format!("{}, {}", letter(i), file.to_string_lossy()))
}

/// Why designs were not compared.
#[derive(Debug, Clone, PartialEq)]
pub enum NoComparison {
    /// Of the design with this number, from 0, there is no clutch to speak of.
    NoClutch(usize, NoMargins),
    /// [`Follow`] was stopped.
    Stopped,
}

/// Statics, margins and scenes of each design; `done` is told of each that is done.
///
/// # Errors
/// [`NoComparison`].
pub fn subjects(
    designs: Vec<Design>,
    follow: &Follow,
    done: &dyn Fn(),
) -> Result<Vec<Subject>, NoComparison> {
    let settings = fine(follow);
    let mut subjects = Vec::with_capacity(designs.len());
    for (i, design) in designs.into_iter().enumerate() {
        let subject = Subject::new(design, LIFT_OFF_TO_RAD_S, &settings)
            .map_err(|why| NoComparison::NoClutch(i, why))?;
        if follow.stopped() {
            return Err(NoComparison::Stopped);
        }
        subjects.push(subject);
        done();
    }
    Ok(subjects)
}

impl<'a> Comparison<'a> {
    /// Of designs, the one before first; `files`: where each comes from.
    pub fn of(subjects: &'a [Subject], files: &'a [String]) -> Self {
        let all: Vec<&Design> = subjects.iter().map(|s| &s.design).collect();
        Self {
            inputs: inputs_that_differ(&all),
            margins: margins(subjects),
            scenes: scenes(subjects),
            subjects,
            files,
        }
    }

    /// The answer with the keys that all answers share, under the name of the first design; `run_time_s`: what it took, s.
    /// None of no designs.
    pub fn envelope(&self, run_time_s: f64) -> Option<Envelope<'a, Value>> {
        let design = &self.subjects.first()?.design;
        let left_out = left_out_of(design);
        Some(Envelope { design, run_time_s, left_out, error_estimate: None, body: self.json() })
    }

    /// Everything, one value a row and design, for CSV.
    pub fn csv_table(&self) -> Table {
        tables::csv(self)
    }

    /// The answer on a terminal.
    pub fn text(&self, screen: Screen) -> String {
        tables::text(self, screen)
    }

    /// The answer as a page, under the name of the first design. None of no designs.
    pub fn page(&self, provenance: &Provenance) -> Option<Page> {
        Some(page::page(self, &self.envelope(provenance.run_time_s)?, &provenance.command))
    }

    /// What it comes to, in one line.
    fn banner(&self) -> String {
        let one = |(i, s): (usize, &Subject)| {
            let held = if s.held() { "held" } else { "NOT HELD" };
            match s.deciding() {
                Some(m) => {
                    format!("{} {held}, margin {} ({})", letter(i), margin_text(m), m.code())
                }
                None => format!("{} {held}, no limit named", letter(i)),
            }
        };
        let inputs = match self.inputs.len() {
            0 => "no input differs".to_owned(),
            1 => "1 input differs".to_owned(),
            n => format!("{n} inputs differ"),
        };
        let each: Vec<String> = self.subjects.iter().enumerate().map(one).collect();
        format!("{}; {inputs}", each.join("; "))
    }

    fn json(&self) -> Value {
        let designs: Vec<Value> = self
            .subjects
            .iter()
            .zip(self.files)
            .map(|(s, file)| {
                json!({
                    "name": s.design.name, "file": file, "design_hash": s.design.hash,
                    "pass": s.held(), "deciding": s.deciding().map(|m| m.code()),
                })
            })
            .collect();
        let input = |i: &Input| i.number.map_or_else(|| json!(i.text), |n| json!(n));
        let inputs: Vec<Value> = self
            .inputs
            .iter()
            .map(|row| {
                let unit = row.values.iter().flatten().map(|i| i.unit).next().unwrap_or("");
                json!({ "path": row.key, "unit": unit, "values": values(row, input) })
            })
            .collect();
        let margins: Vec<Value> = self
            .margins
            .iter()
            .map(|row| {
                json!({
                    "code": row.key,
                    "required": values(row, |m| json!(m.required)),
                    "held": values(row, |m| json!(m.held())),
                    "margins": values(row, |m| json!(m.margin())),
                    "torque_capacities_nm": values(row, |m| json!(m.torque_capacity_nm)),
                })
            })
            .collect();
        let figures: Vec<Value> = figures::FIGURES
            .iter()
            .map(|f| {
                let values: Vec<Option<f64>> = self.subjects.iter().map(|s| f.shown(s)).collect();
                json!({ "key": f.key, "unit": f.unit.symbol(), "values": values })
            })
            .collect();
        let scenes: Vec<Value> = self
            .scenes
            .iter()
            .map(|row| {
                json!({
                    "name": row.key,
                    "required_friction": values(row, |s| json!(tables::required_friction(s))),
                    "slip_margin": values(row, |s| json!(s.found.slip_margin())),
                    "contact_margin": values(row, |s| json!(s.found.contact_margin())),
                })
            })
            .collect();
        json!({ "designs": designs, "inputs": inputs, "figures": figures, "margins": margins, "scenes": scenes })
    }
}

/// One value of each design; null of a design without it.
fn values<T>(row: &SideBySide<T>, value: impl Fn(&T) -> Value) -> Vec<Value> {
    row.values.iter().map(|v| v.as_ref().map_or(Value::Null, &value)).collect()
}

/// Unit behind the key of an input.
fn with_unit(row: &SideBySide<Input>) -> String {
    match row.values.iter().flatten().map(|i| i.unit).find(|u| !u.is_empty()) {
        Some(unit) => format!("{}, {unit}", row.key),
        None => row.key.clone(),
    }
}

/// What is worth a word where profiles are laid over one another.
fn farthest(points: &[[f64; 2]]) -> Option<String> {
    let [turn, h] = points.iter().max_by(|a, b| a[1].abs().total_cmp(&b[1].abs()))?;
    (h.abs() > 1e-12).then(|| {
        greek(&format!(
            "farthest apart {} ({} A) at a turn of {}",
            Unit::Micrometre.show(h.abs(), 3),
            if *h > 0.0 { "outside" } else { "inside" },
            Unit::Radian.show(*turn, 3)
        ))
    })
}

/// By how much each profile stands outside the first one.
fn proud<'a>(subjects: &'a [Subject]) -> impl Iterator<Item = Vec<[f64; 2]>> + 'a {
    let (first, others) = subjects.split_at(1);
    others.iter().flat_map(move |s| first.iter().map(move |f| proud_m(&f.state.profile, &s.state.profile)))
}
