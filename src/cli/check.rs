//! `check`: the designer margin check.

mod body;
mod charts;
mod overrun;
mod page;
mod run_out;
mod running;

use super::exit::{Exit, Failure};
use super::left_out::{left_out, off_centre};
use super::origin::Kind;
use super::parts::{self, Answer};
use super::{Context, interrupt::Interrupt, progress::Progress};
use crate::design::{Design, Scenario, ScenarioKind};
use crate::margin::{
    LoadState, Margin, NoMargins, OverrunCurve, RunOut, lift_off_rad_s, load_margins, load_state,
    run_out_margins, scene_margins,
};
use crate::report::{Screen, Unit};
use crate::scenario::Settings;
use crate::wedge::straddling_error;
use body::{Body, NONE_SUFFICES, OVERLOADED, Source, csv_table};
pub(super) use body::{demand_cell, ends_first, margin_cell, people_table, unit_cell};
use clap::Args;
use rayon::prelude::*;
use std::f64::consts::PI;
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
/// Speed up to which a lift-off of the sprags is looked for, rad/s: 60 000 rpm, beyond any clutch of this kind.
const LIFT_OFF_TO_RAD_S: f64 = 60_000.0 * PI / 30.0;

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

/// Margins of a design and what they were read from.
struct Check {
    state: LoadState,
    rows: Vec<Margin>,
    /// Largest change of a finite scenario margin when the tolerance is ten times finer.
    scene_error: Option<f64>,
    lift_off_rad_s: Option<f64>,
    overrun: OverrunCurve,
    /// Where the design's axes lie apart.
    run_out: Option<RunOut>,
}

/// Run the command.
///
/// # Errors
/// [`Failure`].
pub fn run(args: &CheckArgs, context: &Context) -> Result<Exit, Failure> {
    let others: Vec<_> = args.overrun_csv.iter().map(|path| (path.as_path(), Kind::Table)).collect();
    context.outputs.check(&[&args.file], &others)?;
    let design = parts::read_design(&args.file, context)?;
    let started = Instant::now();
    let check = compute(&design, &args.file, context)?;
    let run_time_s = started.elapsed().as_secs_f64();
    let limits = &design.limits;
    let curve = &check.state.curve;
    let source = Source {
        end: curve.end().0,
        end_torque_nm: curve.end_torque_nm(),
        asked_nm: limits.peak_torque_nm.or(limits.nominal_torque_nm).unwrap_or(0.0),
        lift_off_rad_s: check.lift_off_rad_s,
        searched_to_rad_s: LIFT_OFF_TO_RAD_S,
        overrun: overrun::Section::new(&check.overrun, limits),
        running: running::Section::new(&design, &check.state),
        run_out: check.run_out.as_ref().map(|ring| run_out::Section::new(&design, &check.state, ring)),
    };
    let list = left_out(&design.clutch);
    let left_out = match &source.run_out {
        Some(section) => off_centre(list, section.left_out()),
        None => list,
    };
    let body = Body::new(&check.rows, source);
    let (held, unknown) = (body.pass, body.unknown());
    let answer = Answer {
        design: &design,
        run_time_s,
        left_out,
        error_estimate: Some(serde_json::json!({
            "statics_relative": check.state.curve.truncation(),
            "scenario_margins": check.scene_error,
            // Of inner Hertz pressure, while a junction lies under the contact.
            "hertz_at_junctions_relative": straddling_error(&design.clutch),
        })),
        body,
    };
    context.outputs.write_csv(&csv_table(&check.rows, check.state.curve.end_torque_nm()));
    if let Some(path) = &args.overrun_csv {
        context.outputs.write_table(path, &answer.body.overrun.table());
    }
    context.outputs.write_report(|| page::page(&design, &check, &answer, context));
    context.answer(&text(&design, &check, &answer.body, context.screen))?;
    answer.print(context)?;
    Ok(match (held, unknown) {
        (true, _) => Exit::Held,
        (false, true) => Exit::Failed,
        (false, false) => Exit::NotHeld,
    })
}

/// All margins; the scenarios in parallel, each at two tolerances.
fn compute(design: &Design, file: &Path, context: &Context) -> Result<Check, Failure> {
    let state = load_state(design).map_err(|why| parts::no_clutch(file, &why))?;
    let mut rows = load_margins(design, &design.limits, true, &state);
    let run_out = RunOut::new(design, &state);
    if let Some(ring) = &run_out {
        rows.extend(run_out_margins(design, &design.limits, ring, true));
    }
    let progress = context.progress("margins", "scenarios", Some(design.scenarios.len() as u64));
    let scenes: Vec<Option<(Vec<Margin>, f64)>> = design
        .scenarios
        .par_iter()
        .map(|scenario| scene(design, scenario, context.interrupt, &progress))
        .collect();
    let mut scene_error = None;
    for found in scenes {
        let (margins, error) = found.ok_or(Failure::Interrupted)?;
        rows.extend(margins);
        scene_error = Some(error.max(scene_error.unwrap_or(0.0)));
    }
    let lift_off_rad_s = lift_off_rad_s(design, &state, LIFT_OFF_TO_RAD_S);
    let track_m = design.clutch.races.outer_radius_m;
    let up_to = overrun::up_to_rad_s(&design.limits, lift_off_rad_s, track_m);
    let overrun = overrun::curve(design, &state, up_to, lift_off_rad_s)
        .map_err(|why| parts::no_clutch(file, &NoMargins::Curve(why)))?;
    Ok(Check { state, rows, scene_error, lift_off_rad_s, overrun, run_out })
}

/// Margins of one scenario and their error; nothing once the user asked to stop.
fn scene(
    design: &Design,
    scenario: &Scenario,
    interrupt: Interrupt,
    progress: &Progress,
) -> Option<(Vec<Margin>, f64)> {
    let coarse = Settings { interrupt: Some(interrupt.flag()), ..Settings::default() };
    let fine = Settings { tolerance: 0.1 * coarse.tolerance, ..coarse };
    let required = design.check_scenarios.contains(&scenario.name);
    let at = |settings: &Settings| {
        (!interrupt.requested()).then(|| scene_margins(scenario, &design.limits, required, settings))
    };
    let (coarse, fine) = (at(&coarse)?, at(&fine)?);
    // Rows of a run that was cut short are none.
    if interrupt.requested() {
        return None;
    }
    let error = coarse.iter().zip(&fine).map(|(a, b)| (a.margin - b.margin).abs()).fold(0.0, f64::max);
    progress.advance(1);
    Some((fine, error))
}

fn text(design: &Design, check: &Check, body: &Body, screen: Screen) -> String {
    let table = people_table(&check.rows, check.state.curve.end_torque_nm()).to_text(screen);
    let mut out = format!("{}  {}\n\n{table}\n", design.name, &design.hash.get(..12).unwrap_or(&design.hash));
    out.push_str(&body.verdict());
    out.push('\n');
    for line in body.remarks().into_iter().chain(overrunning(design)) {
        out.push_str(&line);
        out.push('\n');
    }
    out.push_str(REACHED_AT);
    out.push('\n');
    let stands = |r: &&Margin| r.computed && r.demand == f64::MAX;
    if check.rows.iter().filter(stands).any(|r| !r.overloaded) {
        out.push_str(&format!("{NONE_SUFFICES}: contact would open, whatever the friction\n"));
    }
    if check.rows.iter().filter(stands).any(|r| r.overloaded) {
        out.push_str(&format!(
            "{OVERLOADED}: the scene's load goes beyond the end of the curve, where the sprag rolls over or leaves its profile\n"
        ));
    }
    out
}

/// Why steady overruns have no rows, where the design has any.
fn overrunning(design: &Design) -> Option<String> {
    let steady = design.scenarios.iter().filter(|s| matches!(s.kind, ScenarioKind::Overrun { .. }));
    let names: Vec<&str> = steady.map(|s| s.name.as_str()).collect();
    (!names.is_empty()).then(|| {
        format!(
            "No slip or contact row for {}: in steady overrun the inner contact slides and nothing is to stick; limits \
             keep_contact_to_rpm and lift_off_by_rpm hold it",
            names.join(", ")
        )
    })
}

/// A margin in percent; a limit that nothing demands has none.
fn margin_text(margin: f64) -> String {
    if margin >= body::NO_DEMAND {
        "no demand".to_owned()
    } else {
        Unit::Percent.show(body::resolved(margin), 3)
    }
}
