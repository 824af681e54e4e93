//! `identify`: unknown parameters of a design from measured or published numbers.

mod body;
mod page;

use super::Context;
use super::exit::{Exit, Failure};
use super::histories::Histories;
use super::left_out::left_out;
use super::origin::{Kind, WRITTEN_BY};
use super::output::{TOOL, VERSION};
use super::parts::{self, Answer};
use crate::design::{Design, MOST_TABLE, read_text};
use crate::identify::{FitSettings, Identified, NoFit, SoFar, Unknown, identify, observations};
use crate::report::Screen;
use body::{Body, estimates, in_short, residuals, sentences, verdict};
use clap::Args;
use serde_json::json;
use std::path::PathBuf;
use std::time::Instant;

const EXAMPLES: &str = "\
Examples:
  sprag-design identify clutch.toml --data windup.csv --unknown r_i2_mm:3.9:4.4,r_i3_mm:3.9:4.6 -o found.toml
  sprag-design identify clutch.toml --data bench.csv --unknown friction.static:0.05:0.2 --report found.html

The data are a CSV table, one row per test. Columns, in any order: torque_nm with any of windup_deg, normal_inner_n,
normal_outer_n, tan_omega, hertz_inner_mpa, hertz_outer_mpa, k_secant_nm_per_rad, k_tangent_nm_per_rad; the thresholds
nominal_torque_nm (where the first limit on nominal torque is reached), end_torque_nm, lift_off_rpm; each of these with
its standard error as <column>_sigma, without which all count in proportion; dotted keys that a row changes in the
design, such as races.inner_radius_mm; label; use = fit, check (compared only) or skip.

An unknown counts as determined where its 95 % interval is narrower than its bounds and, within bounds of one sign, than its
value, and no correlation with another exceeds 0.99: beyond, an error of the model of 1 % moves each of the two by up to 7 %
or more, and they are determined only together. An unknown that moves nothing in the data is said to, keeps the file's value,
and the others are judged without it. Whole numbers, such as sprags.count, are refused. Bounds are those of --unknown; those in [optimize] bind optimize alone.

Exit codes: 0 every unknown is determined; 1 the data leave one undetermined, or determine two only together, or no design fits between the bounds; 130
stopped by Ctrl-C, the best design so far is told, and written where -o names a file.";

/// Arguments of `identify`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct IdentifyArgs {
    /// Design file (TOML)
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// What was measured (CSV)
    #[arg(long, value_name = "DATA.csv")]
    pub data: PathBuf,
    /// Unknowns with their bounds: a variable of optimize or the dotted path of a number in the file
    #[arg(long, value_name = "NAME:MIN:MAX,..", required = true, value_delimiter = ',', value_parser = unknown)]
    pub unknown: Vec<Unknown>,
    /// Where to write the design file with the values found
    #[arg(long, short, value_name = "NEW.toml")]
    pub output: Option<PathBuf>,
    /// Starts of the search: the file's own values, the others at random between the bounds
    #[arg(long, value_name = "N", default_value_t = 4, allow_negative_numbers = true, value_parser = clap::value_parser!(u16).range(1..=1000))]
    pub starts: u16,
    /// Seed of the random starts
    #[arg(long, value_name = "N", default_value_t = 1, allow_negative_numbers = true)]
    pub seed: u64,
    /// Most evaluations of the simplex search of one start
    #[arg(long, value_name = "N", default_value_t = 200, allow_negative_numbers = true, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub evaluations: u32,
}

/// `NAME:MIN:MAX`.
fn unknown(text: &str) -> Result<Unknown, String> {
    let parts: Vec<&str> = text.split(':').map(str::trim).collect();
    let [name, min, max] = parts.as_slice() else {
        return Err("NAME:MIN:MAX is needed, such as r_i1_mm:3.5:4.5".to_owned());
    };
    let bound = |text: &str| match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        _ => Err(format!("{text:?} is no finite number")),
    };
    let (min, max) = (bound(min)?, bound(max)?);
    if min >= max {
        return Err(format!("the lower bound {min} is not below the upper bound {max}"));
    }
    Ok(Unknown { name: (*name).to_owned(), min, max })
}

/// Run the command.
///
/// # Errors
/// [`Failure`].
pub fn run(args: &IdentifyArgs, context: &Context) -> Result<Exit, Failure> {
    let others: Vec<_> = args.output.iter().map(|path| (path.as_path(), Kind::Design)).collect();
    context.outputs.check(&[&args.file, &args.data], &others)?;
    let design = parts::read_design(&args.file, context)?;
    let named = |why: String| Failure::malformed(format!("{}: {why}", args.data.display()));
    let histories =
        args.output.as_deref().map(|new| Histories::beside(&design, new)).transpose()?.unwrap_or_default();
    let text = read_text(&args.data, MOST_TABLE).map_err(|e| named(e.to_string()))?;
    let data = observations(&text).map_err(|fault| named(fault.to_string()))?;
    let settings = FitSettings {
        starts: usize::from(args.starts),
        seed: args.seed,
        evaluations: args.evaluations as usize,
    };
    context.message(&format!(
        "{} observations, {} unknowns, {} starts, seed {}",
        data.len(),
        args.unknown.len(),
        settings.starts,
        settings.seed
    ));
    let started = Instant::now();
    let found = identify(&design, &data, &args.unknown, &settings, &context.follow);
    let run_time_s = started.elapsed().as_secs_f64();
    let found = match found {
        Ok(found) => found,
        Err(NoFit::Stopped(None)) => return Err(Failure::Interrupted),
        Err(NoFit::Stopped(Some(so_far))) => {
            return stopped(args, (&design, &histories), &so_far, run_time_s, context);
        }
        Err(why @ NoFit::Nowhere { .. }) => {
            context.answer(&format!("{why}\n"))?;
            if context.json {
                super::output::print_json(
                    &json!({ "tool": TOOL, "version": VERSION, "error": { "message": why.to_string() } }),
                )?;
            }
            return Ok(Exit::NotHeld);
        }
        Err(why) => return Err(Failure::malformed(format!("{}: {why}", args.file.display()))),
    };
    let write = |path: &&std::path::Path| {
        let text = new_file(&design, &found, context);
        histories.write(&context.outputs) && context.outputs.write(path, Kind::Design, text.as_bytes())
    };
    let body = Body::new(&found, args.output.as_deref().filter(write));
    let determined = body.determined;
    let answer = Answer {
        design: &design,
        run_time_s,
        left_out: left_out(&design.clutch),
        error_estimate: Some(json!({ "residual_sigma": found.knowledge.residual_sigma })),
        body,
    };
    context.outputs.write_csv(&residuals(&found));
    context.outputs.write_report(|| page::page(&design, &found, &answer, context));
    context.answer(&text_of(&design, &found, context.screen))?;
    answer.print(context)?;
    Ok(if determined { Exit::Held } else { Exit::NotHeld })
}

/// What a search that was stopped had found: its best design, without error bars.
fn stopped(
    args: &IdentifyArgs,
    (design, histories): (&Design, &Histories),
    so_far: &SoFar,
    run_time_s: f64,
    context: &Context,
) -> Result<Exit, Failure> {
    let named = || args.unknown.iter().zip(&so_far.values);
    let write = |path: &&std::path::PathBuf| {
        let values: String = named().map(|(u, value)| format!("#   {}: {value}\n", u.name)).collect();
        let remark = format!(
            "# stopped by Ctrl-C: the best of {} designs, not the end of the search\n",
            so_far.evaluations
        );
        let text = head(design, context) + &remark + &values + "#\n" + &so_far.source;
        histories.write(&context.outputs) && context.outputs.write(path, Kind::Design, text.as_bytes())
    };
    let written = args.output.as_ref().filter(write).map(|path| path.display().to_string());
    let values: Vec<String> = named().map(|(u, value)| format!("  {} = {value}\n", u.name)).collect();
    context.answer(&format!(
        "stopped by Ctrl-C: the best of {} designs so far, sum of squared scaled residuals {:.6e}; the search has not ended, and how \
         well the values are known was not looked at\n{}{}",
        so_far.evaluations,
        so_far.sum,
        values.concat(),
        written.as_ref().map_or(String::new(), |path| format!("Written: {path}\n")),
    ))?;
    let unknowns: Vec<_> = named()
        .map(|(u, value)| json!({ "name": u.name, "min": u.min, "max": u.max, "value": value }))
        .collect();
    let body = json!({
        "interrupted": true, "converged": false, "unknowns": unknowns, "sum_of_squares": so_far.sum,
        "evaluations": so_far.evaluations, "written": written,
    });
    let left_out = left_out(&design.clutch);
    Answer { design, run_time_s, left_out, error_estimate: None, body }.print(context)?;
    Ok(Exit::Interrupted)
}

/// First lines of a file written by this command.
fn head(design: &Design, context: &Context) -> String {
    let (name, hash) = (&design.name, &design.hash);
    format!("{WRITTEN_BY} identify {VERSION} from {name:?} (sha256 {hash})\n# by: {}\n", context.command_line)
}

/// The old file with its comments, the values found, and who found them.
fn new_file(design: &Design, found: &Identified, context: &Context) -> String {
    let changes: String = found
        .unknowns
        .iter()
        .zip(&found.before)
        .zip(&found.knowledge.estimates)
        .map(|((u, before), e)| {
            let width = e.half_width.map_or(String::new(), |w| format!(" +- {w:.3e} (95 %)"));
            let doubt = e.doubt.map_or(String::new(), |doubt| format!(", {}", in_short(found, doubt)));
            format!("#   {}: {} -> {}{width}{doubt}\n", u.name, before, e.value)
        })
        .collect();
    head(design, context) + &changes + "#\n" + &found.source
}

fn text_of(design: &Design, found: &Identified, screen: Screen) -> String {
    let mut out = format!(
        "{}  {}\n\n{}\n{}\n",
        design.name,
        design.hash.get(..12).unwrap_or(&design.hash),
        estimates(found).to_text(screen),
        residuals(found).to_text(screen)
    );
    for line in std::iter::once(verdict(found)).chain(sentences(found)) {
        out.push_str(&line);
        out.push('\n');
    }
    out
}
