//! What a comparison of designs answers: inputs that differ, margins, figures, scenes.

mod body;
mod figures;
mod page;
mod tables;

pub use body::{
    ComparedDesign, ComparedFigure, ComparedInput, ComparedMargin, ComparedScene, ComparisonBody, InputValue,
};

use super::check::{fine, margin_text};
use super::left_out::left_out_of;
use super::{Answer, Envelope, Finding, Provenance};
use crate::compare::{Scene, SideBySide, Subject, inputs_that_differ, margins, proud_m, scenes};
use crate::design::Design;
use crate::file::Input;
use crate::follow::{Follow, News};
use crate::margin::{LIFT_OFF_TO_RAD_S, Margin, NoMargins};
use crate::report::{Page, Screen, Table, Unit, greek};
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

/// Designs that stand side by side on paper.
pub const MOST_COMPARED: usize = 6;

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
}

impl Answer for Comparison<'_> {
    type Body<'a>
        = ComparisonBody<'a>
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

    fn envelope(&self, run_time_s: f64) -> Envelope<'_, ComparisonBody<'_>> {
        let (design, left_out) = (self.first, left_out_of(self.first));
        Envelope { design, run_time_s, left_out, error_estimate: None, body: ComparisonBody::of(self) }
    }
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
