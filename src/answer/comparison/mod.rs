//! What a comparison of designs answers: inputs that differ, margins, figures, scenes.

mod figures;
mod page;
mod tables;

use super::check::{fine, margin_text};
use super::left_out::left_out_of;
use super::{Answer, Envelope, Finding, Provenance};
use crate::compare::{Scene, SideBySide, Subject, inputs_that_differ, margins, proud_m, scenes};
use crate::design::Design;
use crate::file::Input;
use crate::follow::{Follow, News};
use crate::margin::{LIFT_OFF_TO_RAD_S, Margin, NoMargins};
use crate::report::{Page, Rows, Screen, Table, Unit, greek};
use serde_json::{Value, json};
use std::path::Path;

/// Designs with all that differs.
#[derive(Debug, Clone)]
pub struct Comparison<'a> {
    /// The design before, under whose name the answer stands.
    pub first: &'a Design,
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

/// Statics, margins and scenes of each design; `follow` is told of each that is done.
///
/// # Errors
/// [`NoComparison`].
pub fn subjects(designs: Vec<Design>, follow: &Follow) -> Result<Vec<Subject>, NoComparison> {
    let settings = fine(follow);
    let mut subjects = Vec::with_capacity(designs.len());
    for (i, design) in designs.into_iter().enumerate() {
        let subject = Subject::new(design, LIFT_OFF_TO_RAD_S, &settings)
            .map_err(|why| NoComparison::NoClutch(i, why))?;
        if follow.stopped() {
            return Err(NoComparison::Stopped);
        }
        subjects.push(subject);
        follow.news(News::Done);
    }
    Ok(subjects)
}

impl<'a> Comparison<'a> {
    /// Of designs, the one before first; `files`: where each comes from. None of no designs.
    pub fn of(subjects: &'a [Subject], files: &'a [String]) -> Option<Self> {
        let all: Vec<&Design> = subjects.iter().map(|s| &s.design).collect();
        Some(Self {
            first: all.first()?,
            inputs: inputs_that_differ(&all),
            margins: margins(subjects),
            scenes: scenes(subjects),
            subjects,
            files,
        })
    }

    fn json(&self) -> Value {
        let designs = Rows::of(self.subjects.iter().zip(self.files))
            .json("name", |(s, _)| s.design.name.as_str())
            .json("file", |(_, file)| file.as_str())
            .json("design_hash", |(s, _)| s.design.hash.as_str())
            .json("pass", |(s, _)| s.held())
            .json("deciding", |(s, _)| s.deciding().map(|m| m.code()));
        let inputs = Rows::of(&self.inputs)
            .json("path", |row| row.key.as_str())
            .json("unit", |row| unit_of(row))
            .json("values", |row| values(row, |i| i.number.map_or_else(|| json!(i.text), |n| json!(n))));
        let figures = Rows::of(&figures::FIGURES)
            .json("key", |f| f.key)
            .json("unit", |f| f.unit.symbol())
            .json("values", |f| self.subjects.iter().map(|s| f.shown(s)).collect::<Vec<_>>());
        let margins = Rows::of(&self.margins)
            .json("code", |row| row.key.as_str())
            .json("required", |row| values(row, |m| m.required))
            .json("held", |row| values(row, |m| m.held()))
            .json("margins", |row| values(row, |m| m.margin()))
            .json("torque_capacities_nm", |row| values(row, |m| m.torque_capacity_nm));
        let scenes = Rows::of(&self.scenes)
            .json("name", |row| row.key.as_str())
            .json("required_friction", |row| values(row, |s| tables::required_friction(s)))
            .json("slip_margin", |row| values(row, |s| s.found.slip_margin()))
            .json("contact_margin", |row| values(row, |s| s.found.contact_margin()));
        json!({
            "designs": designs.objects(), "inputs": inputs.objects(), "figures": figures.objects(), "margins": margins.objects(),
            "scenes": scenes.objects(),
        })
    }
}

impl Answer for Comparison<'_> {
    type Body<'a>
        = Value
    where
        Self: 'a;

    /// Figures alone: which design is better is for its reader to say.
    fn outcome(&self) -> Finding {
        Finding::Shown
    }

    fn verdict(&self) -> String {
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

    /// Everything, one value a row and design.
    fn table(&self) -> Table {
        tables::csv(self)
    }

    fn text(&self, screen: Screen) -> String {
        tables::text(self, screen)
    }

    fn page(&self, provenance: &Provenance) -> Page {
        page::page(self, provenance)
    }

    fn envelope(&self, run_time_s: f64) -> Envelope<'_, Value> {
        let left_out = left_out_of(self.first);
        Envelope { design: self.first, run_time_s, left_out, error_estimate: None, body: self.json() }
    }
}

/// One value of each design; none of a design without it.
fn values<T, V>(row: &SideBySide<T>, value: impl Fn(&T) -> V) -> Vec<Option<V>> {
    row.values.iter().map(|v| v.as_ref().map(&value)).collect()
}

/// Unit of an input; empty for a pure number.
fn unit_of(row: &SideBySide<Input>) -> &'static str {
    row.values.iter().flatten().map(|i| i.unit).next().unwrap_or("")
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
