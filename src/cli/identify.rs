//! `identify`: unknown parameters of a design from measured or published numbers.

use super::context::timed;
use super::exit::{Exit, Failure};
use super::histories::Histories;
use super::origin::FileKind;
use super::{Context, Run};
use crate::answer::identification::{Identification, StoppedIdentification};
use crate::file::{MOST_TABLE, read_text};
use crate::identify::{FitSettings, NoFit, Unknown, identify, observations};
use clap::Args;
use serde_json::json;
use std::path::PathBuf;

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
    #[arg(long, value_name = "NAME:MIN:MAX,..", required = true, value_delimiter = ',')]
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

impl Run for IdentifyArgs {
    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        let others: Vec<_> = self.output.iter().map(|path| (path.as_path(), FileKind::Design)).collect();
        context.outputs.check(&[&self.file, &self.data], &others)?;
        let design = context.design(&self.file)?;
        let named = |why: String| Failure::of(&self.data, why);
        let histories = self
            .output
            .as_deref()
            .map(|new| Histories::beside(&design, new))
            .transpose()?
            .unwrap_or_default();
        let text = read_text(&self.data, MOST_TABLE).map_err(|e| named(e.to_string()))?;
        let data = observations(&text).map_err(|fault| named(fault.to_string()))?;
        let settings = FitSettings {
            starts: usize::from(self.starts),
            seed: self.seed,
            evaluations: self.evaluations as usize,
        };
        context.message(&format!(
            "{} observations, {} unknowns, {} starts, seed {}",
            data.len(),
            self.unknown.len(),
            settings.starts,
            settings.seed
        ));
        let (found, run_time_s) =
            timed(|| identify(&design, &data, &self.unknown, &settings, &context.follow));
        let found = match found {
            Ok(found) => found,
            Err(NoFit::Stopped(None)) => return Err(Failure::Interrupted),
            Err(NoFit::Stopped(Some(so_far))) => {
                let answer =
                    StoppedIdentification { design: &design, unknowns: &self.unknown, so_far: &so_far };
                let written = written(self, &histories, &answer.file(&context.command_line), context);
                context.answer(&answer.text(written.as_deref()))?;
                context.print(&answer.envelope(run_time_s, written.as_deref()))?;
                return Ok(Exit::Interrupted);
            }
            Err(why @ NoFit::Nowhere { .. }) => {
                context.answer(&format!("{why}\n"))?;
                context.object(|| json!({ "error": { "message": why.to_string() } }))?;
                return Ok(Exit::NotHeld);
            }
            Err(why) => return Err(Failure::of(&self.file, why)),
        };
        let answer = Identification { design: &design, found: &found, written: None };
        let written = written(self, &histories, &answer.file(&context.command_line), context);
        context.deliver(&Identification { written: written.as_deref(), ..answer }, run_time_s)
    }
}

/// Write the design file that `-o` asks for; its name, if it was written.
fn written(args: &IdentifyArgs, histories: &Histories, text: &str, context: &Context) -> Option<String> {
    let path = args.output.as_deref()?;
    let written =
        histories.write(&context.outputs) && context.outputs.write(path, FileKind::Design, text.as_bytes());
    written.then(|| path.display().to_string())
}
