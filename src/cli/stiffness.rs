//! `stiffness`: the static curve, for one contact law or several side by side.

mod fem;
mod laws;
mod page;
mod pressure;
mod tables;

use super::exit::{Exit, Failure};
use super::parts::{self, Answer};
use super::{Context, positive};
use crate::answer::stiffness::{self, Ask, LawCurve, NoStiffness, StiffnessAnswer, curves};
use crate::clutch::LawName;
use crate::design::Design;
use crate::margin::NoMargins;
use crate::profile::Profile;
use crate::report::Unit;
use clap::Args;
use fem::{Fem, FemJson};
pub use pressure::PressureName;
use pressure::{PressureJson, PressureMap};
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::time::Instant;

const EXAMPLES: &str = "\
Examples:
  sprag-design stiffness designs/huang2017-multi-arc.toml
  sprag-design stiffness designs/huang2017-multi-arc.toml --torques 3.34,16.8,50
  sprag-design stiffness designs/huang2017-multi-arc.toml --contact roller,hertz,slice --max-torque 50 --report laws.html
  sprag-design stiffness designs/huang2017-multi-arc.toml --contact roller,slice,elastic --pressure --report map.html
  sprag-design stiffness designs/huang2017-multi-arc.toml --contact roller,slice,elastic --fem result.csv

Finite elements: a CSV with the columns torque_nm and windup_deg, normal_inner_n or normal_n if there; what
`export --format calculix --read ... --csv` writes is one. Several FILEs go onto one page, each with its --fem.";

/// Arguments of `stiffness`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct StiffnessArgs {
    /// Design files (TOML); more than one only with --report
    #[arg(value_name = "FILE", required = true)]
    pub files: Vec<PathBuf>,
    /// Contact laws to compare, comma separated [default: the design's]
    #[arg(long, value_name = "LAW,...", value_enum, value_delimiter = ',')]
    pub contact: Vec<LawName>,
    /// Torques of the table, Nm, comma separated
    #[arg(long, value_name = "NM,...", allow_hyphen_values = true, value_parser = positive, value_delimiter = ',', conflicts_with = "max_torque")]
    pub torques: Vec<f64>,
    /// Largest torque of an even table, Nm [default: the design's peak torque]
    #[arg(long, value_name = "NM", allow_hyphen_values = true, value_parser = positive)]
    pub max_torque: Option<f64>,
    /// Finite-element result to compare with, CSV; once for each FILE, in their order
    #[arg(long, value_name = "PATH")]
    pub fem: Vec<PathBuf>,
    /// Rows of --fem whose column `model` holds one of these texts, separated by | [default: all]
    #[arg(long, value_name = "TEXT|...", requires = "fem")]
    pub fem_model: Option<String>,
    /// Pressure along the length of the contacts; on by itself, by slices, with an end profile or a tilt
    #[arg(long, value_name = "HOW", value_enum, num_args = 0..=1, require_equals = true, default_missing_value = "slices")]
    pub pressure: Option<PressureName>,
}

/// One design with all that was asked of it.
struct Study {
    design: Design,
    profile: Profile,
    found: StiffnessAnswer,
    fem: Option<Fem>,
    /// Pressure along the length with the first law; absent: not asked for.
    pressure: Option<PressureMap>,
    run_time_s: f64,
}

impl Study {
    fn laws(&self) -> &[LawCurve] {
        &self.found.laws
    }
}

/// Keys of `stiffness`: the curves, and what was asked beside them.
#[derive(Debug, Clone, Serialize)]
struct Body {
    #[serde(flatten)]
    curves: stiffness::Body,
    /// Finite elements and the distance of each law to them, in the order of `laws`.
    #[serde(skip_serializing_if = "Option::is_none")]
    fem: Option<Vec<FemJson>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pressure: Option<PressureJson>,
}

/// Run the command.
///
/// # Errors
/// [`Failure`].
pub fn run(args: &StiffnessArgs, context: &Context) -> Result<Exit, Failure> {
    let inputs: Vec<&Path> = args.files.iter().chain(&args.fem).map(PathBuf::as_path).collect();
    context.outputs.check(&inputs, &[])?;
    args.ask(context).validate().map_err(|why| Failure::malformed(why.to_string()))?;
    let several = args.files.len() > 1;
    if several && (context.json || context.outputs.csv.is_some() || context.outputs.report.is_none()) {
        return Err(Failure::malformed(
            "several FILEs make one page: --report PATH.html, without --json and --csv",
        ));
    }
    if !args.fem.is_empty() && args.fem.len() != args.files.len() {
        let (fem, files) = (args.fem.len(), args.files.len());
        return Err(Failure::malformed(format!(
            "{fem} --fem for {files} FILEs: give one for each, in their order"
        )));
    }
    let studies = (0..args.files.len()).map(|i| study(args, i, context)).collect::<Result<Vec<_>, _>>()?;
    let answers: Vec<_> = studies.iter().map(answer).collect();
    if let [study] = studies.as_slice() {
        context.outputs.write_csv(&tables::csv(study.laws()));
    }
    context.outputs.write_report(|| page::page(&studies, &answers, context));
    for (study, answer) in studies.iter().zip(&answers) {
        context.answer(&tables::text(study, context.screen))?;
        answer.print(context)?;
    }
    Ok(Exit::Held)
}

/// What is asked of the `i`-th file.
fn study(args: &StiffnessArgs, i: usize, context: &Context) -> Result<Study, Failure> {
    let design = parts::read_design(&args.files[i], context)?;
    let fem = args.fem.get(i).map(|path| Fem::read(path, args.fem_model.as_deref())).transpose()?;
    let profile =
        design.clutch.profile().map_err(|e| parts::no_clutch(&args.files[i], &NoMargins::Profile(e)))?;
    let started = Instant::now();
    let ask = args.ask(context);
    let count = ask.laws_of(&design.clutch.contact).len() as u64;
    let progress = context.progress("curves", "contact laws", Some(count));
    let laws = curves(&design, &profile, &ask, &|| progress.advance(1)).map_err(|why| match why {
        NoStiffness::NoClutch(why) => parts::no_clutch(&args.files[i], &why),
        NoStiffness::Torque(_) => Failure::malformed(why.to_string()),
        NoStiffness::Stopped => Failure::Interrupted,
    })?;
    drop(progress);
    let shaped = (!design.clutch.axial.is_straight()).then_some(PressureName::Slices);
    let pressure = match (laws.first(), args.pressure.or(shaped)) {
        (Some(law), Some(how)) => Some(PressureMap::of(law, how)?),
        _ => None,
    };
    let run_time_s = started.elapsed().as_secs_f64();
    Ok(Study { design, profile, found: StiffnessAnswer::of(laws), fem, pressure, run_time_s })
}

impl StiffnessArgs {
    fn ask(&self, context: &Context) -> Ask {
        Ask {
            laws: self.contact.clone(),
            torques_nm: self.torques.clone(),
            max_torque_nm: self.max_torque,
            follow: context.follow.clone(),
        }
    }
}

fn answer(study: &Study) -> Answer<'_, Body> {
    Answer {
        design: &study.design,
        run_time_s: study.run_time_s,
        left_out: study.found.left_out.clone(),
        error_estimate: Some(study.found.error_relative.into()),
        body: Body {
            curves: study.found.body.clone(),
            fem: study.fem.as_ref().map(|fem| fem::json(study, fem)),
            pressure: study.pressure.as_ref().map(PressureMap::to_json),
        },
    }
}

/// Where the curve of a law ends, in words.
fn end_text(law: &LawCurve) -> String {
    let (reason, _) = law.curve.end();
    let torque = Unit::NewtonMetre.show(law.curve.end_torque_nm(), 5);
    format!("{} at {torque}", reason.name())
}
