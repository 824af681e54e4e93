//! `check`: the designer margin check.

mod charts;
mod page;
mod sections;
pub mod sheet;

use super::Context;
use super::exit::{Exit, Failure};
use super::origin::Kind;
use super::parts::{self, Answer};
use crate::answer::check::{Body, CheckAnswer, NONE_SUFFICES, NoCheck, OVERLOADED, check, csv_table};
pub(super) use crate::answer::check::{ends_first, margin_cell, margin_text, people_table};
use crate::design::Design;
use crate::margin::{Demand, Margin};
use crate::report::{Screen, greek};
use clap::Args;
use std::path::{Path, PathBuf};
use std::time::Instant;

const EXAMPLES: &str = "\
Examples:
  sprag-design check designs/huang2017-multi-arc.toml
  sprag-design check designs/huang2017-multi-arc.toml --report check.html
  sprag-design check designs/huang2017-multi-arc.toml --json | jq '.margins[] | select(.held | not)'";

/// What a capacity in a table of margins means.
pub(super) const REACHED_AT: &str =
    "Reached at: torque at which the limit would be reached; >: not before the curve ends";
/// What the margin of a slip row is.
const SLIP_MARGIN: &str = "Margin of slip rows: the slip margin, static over required friction less 1, held from the wanted one up\n";

/// What a row that is not required is.
const SHOWN_ONLY: &str = "Shown only: for information, without a say in the verdict; `explain` with the limit's name says which key makes it count\n";

/// Arguments of `check`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct CheckArgs {
    /// Design file (TOML)
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Write drag torque, contact forces and growth of the outer race against speed as CSV
    #[arg(long, value_name = "PATH")]
    pub overrun_csv: Option<PathBuf>,
}

/// Run the command.
///
/// # Errors
/// [`Failure`].
pub fn run(args: &CheckArgs, context: &Context) -> Result<Exit, Failure> {
    let others: Vec<_> = args.overrun_csv.iter().map(|path| (path.as_path(), Kind::Table)).collect();
    context.outputs.check(&[&args.file], &others)?;
    let design = parts::read_design(&args.file, context)?;
    let (found, run_time_s) = checked(&design, &args.file, context)?;
    let answer = answered(&design, &found, run_time_s);
    context.outputs.write_csv(&csv_table(&found.rows, found.state.curve.end_torque_nm()));
    if let Some(path) = &args.overrun_csv {
        context.outputs.write_table(path, &found.body.overrun.table());
    }
    context.outputs.write_report(|| page::page(&design, &found, &answer, context));
    context.answer(&text(&design, &found, context.screen))?;
    answer.print(context)?;
    Ok(exit(&found.body))
}

/// The check, and the time that it took, s.
fn checked(design: &Design, file: &Path, context: &Context) -> Result<(CheckAnswer, f64), Failure> {
    let progress = context.progress("margins", "scenarios", Some(design.scenarios.len() as u64));
    let started = Instant::now();
    let found = check(design, &context.follow, &|| progress.advance(1)).map_err(|why| match why {
        NoCheck::NoClutch(why) => parts::no_clutch(file, &why),
        NoCheck::Stopped => Failure::Interrupted,
    })?;
    Ok((found, started.elapsed().as_secs_f64()))
}

/// The check with the keys that all commands share.
fn answered<'a>(design: &'a Design, found: &'a CheckAnswer, run_time_s: f64) -> Answer<'a, &'a Body> {
    Answer {
        design,
        run_time_s,
        left_out: found.left_out.clone(),
        error_estimate: Some(serde_json::json!(found.errors)),
        body: &found.body,
    }
}

fn exit(body: &Body) -> Exit {
    match body.held() {
        Some(true) => Exit::Held,
        Some(false) => Exit::NotHeld,
        None => Exit::Failed,
    }
}

fn text(design: &Design, check: &CheckAnswer, screen: Screen) -> String {
    let body = &check.body;
    let table = people_table(&check.rows, check.state.curve.end_torque_nm()).to_text(screen);
    let mut out = format!("{}  {}\n\n{table}\n", design.name, &design.hash.get(..12).unwrap_or(&design.hash));
    out.push_str(&body.verdict());
    out.push('\n');
    for line in body.remarks().into_iter().chain(overrunning(design)) {
        out.push_str(&greek(&line));
        out.push('\n');
    }
    if check.rows.iter().any(|r| !r.required) {
        out.push_str(SHOWN_ONLY);
    }
    out.push_str(REACHED_AT);
    out.push('\n');
    if check.rows.iter().any(Margin::is_slip) {
        out.push_str(SLIP_MARGIN);
    }
    if check.rows.iter().any(|r| r.demand == Demand::NoneSuffices) {
        out.push_str(&format!("{NONE_SUFFICES}: contact would open, whatever the friction\n"));
    }
    if check.rows.iter().any(|r| r.overloaded() && r.demand.value().is_none()) {
        out.push_str(&format!(
            "{OVERLOADED}: the scene's load goes beyond the end of the curve, where the sprag rolls over or leaves its profile\n"
        ));
    }
    out
}

/// Why steady overruns have no rows, where the design has any.
fn overrunning(design: &Design) -> Option<String> {
    let steady = design.scenarios.iter().filter(|s| s.kind.is_overrun());
    let names: Vec<&str> = steady.map(|s| s.name.as_str()).collect();
    (!names.is_empty()).then(|| {
        format!(
            "No slip or contact row for {}: in steady overrun the inner contact slides and nothing is to stick; limits \
             keep_contact_to_rpm and lift_off_by_rpm hold it",
            names.join(", ")
        )
    })
}
