//! `compare`: several designs side by side.

mod figures;
mod page;
mod tables;

use super::Context;
use super::exit::{Exit, Failure};
use super::left_out::left_out;
use super::parts::{self, Answer};
use crate::answer::check::{LIFT_OFF_TO_RAD_S, fine};
use crate::compare::{Row, Scene, Subject, inputs_that_differ, margins, proud_m, scenes};
use crate::design::{Design, Input};
use crate::margin::Margin;
use crate::report::{Unit, greek};
use clap::Args;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::time::Instant;

const EXAMPLES: &str = "\
Examples:
  sprag-design compare before.toml after.toml
  sprag-design compare before.toml after.toml --report compare.html
  sprag-design compare a.toml b.toml c.toml --csv - | column -s, -t

The first design is the one before: dashed in every drawing and curve. Exit code 0 whatever is held: this is a comparison, `check`
gives a verdict. Every figure is that of `check`, `stiffness` and `simulate`.";

/// Designs that stand side by side on paper.
const MOST: usize = 6;

/// Arguments of `compare`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct CompareArgs {
    /// Design files (TOML), two to six, the one before first
    #[arg(value_name = "FILE", required = true, num_args = 2..=MOST)]
    pub files: Vec<PathBuf>,
}

/// All that is shown.
struct Compared<'a> {
    subjects: &'a [Subject],
    files: &'a [PathBuf],
    inputs: Vec<Row<Input>>,
    margins: Vec<Row<&'a Margin>>,
    scenes: Vec<Row<&'a Scene>>,
}

/// A, B, C ...: short enough for a heading.
fn letter(i: usize) -> String {
    char::from(b'A' + u8::try_from(i).unwrap_or(0)).to_string()
}

/// Run the command.
///
/// # Errors
/// [`Failure`].
pub fn run(args: &CompareArgs, context: &Context) -> Result<Exit, Failure> {
    let files: Vec<&Path> = args.files.iter().map(PathBuf::as_path).collect();
    context.outputs.check(&files, &[])?;
    let designs: Vec<Design> =
        args.files.iter().map(|file| parts::read_design(file, context)).collect::<Result<_, _>>()?;
    let started = Instant::now();
    let settings = fine(&context.follow);
    let progress = context.progress("margins", "designs", Some(designs.len() as u64));
    let mut subjects = Vec::with_capacity(designs.len());
    for (design, file) in designs.into_iter().zip(&args.files) {
        let subject =
            Subject::new(design, LIFT_OFF_TO_RAD_S, &settings).map_err(|why| parts::no_clutch(file, &why))?;
        if context.follow.stopped() {
            return Err(Failure::Interrupted);
        }
        subjects.push(subject);
        progress.advance(1);
    }
    drop(progress);
    let run_time_s = started.elapsed().as_secs_f64();
    let all: Vec<&Design> = subjects.iter().map(|s| &s.design).collect();
    let compared = Compared {
        inputs: inputs_that_differ(&all),
        margins: margins(&subjects),
        scenes: scenes(&subjects),
        subjects: &subjects,
        files: &args.files,
    };
    let Some(first) = subjects.first() else { return Ok(Exit::Held) };
    let answer = Answer {
        design: &first.design,
        run_time_s,
        left_out: left_out(&first.design.clutch),
        error_estimate: None,
        body: compared.json(),
    };
    context.outputs.write_csv(&tables::csv(&compared));
    context.outputs.write_report(|| page::page(&compared, &answer, context));
    context.answer(&tables::text(&compared, context.screen))?;
    answer.print(context)?;
    Ok(Exit::Held)
}

impl Compared<'_> {
    /// What it comes to, in one line.
    fn banner(&self) -> String {
        let one = |(i, s): (usize, &Subject)| {
            let held = if s.held() { "held" } else { "NOT HELD" };
            match s.deciding() {
                Some(m) => {
                    format!("{} {held}, margin {} ({})", letter(i), super::check::margin_text(m), m.code())
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
                    "name": s.design.name, "file": file.display().to_string(), "design_hash": s.design.hash,
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
fn values<T>(row: &Row<T>, value: impl Fn(&T) -> Value) -> Vec<Value> {
    row.values.iter().map(|v| v.as_ref().map_or(Value::Null, &value)).collect()
}

/// Unit behind the key of an input.
fn with_unit(row: &Row<Input>) -> String {
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
            "farthest apart {} at a turn of {}",
            Unit::Micrometre.show(*h, 3),
            Unit::Radian.show(*turn, 3)
        ))
    })
}

/// By how much each profile stands outside the first one.
fn proud<'a>(subjects: &'a [Subject]) -> impl Iterator<Item = Vec<[f64; 2]>> + 'a {
    let (first, others) = subjects.split_at(1);
    others.iter().flat_map(move |s| first.iter().map(move |f| proud_m(&f.state.profile, &s.state.profile)))
}
