//! `stiffness`: the static curve, for one contact law or several side by side.

mod body;
mod fem;
mod laws;
mod page;
mod pressure;
mod tables;

use super::exit::{Exit, Failure};
use super::left_out::{LeftOut, at_rest, left_out};
use super::parts::{self, Answer};
use super::{Context, positive};
use crate::design::{Clutch, Design, LawName};
use crate::margin::NoMargins;
use crate::profile::Profile;
use crate::report::Unit;
use crate::scenario::place_profile;
use crate::wedge::{StaticPoint, WedgeCurve};
use body::Body;
use clap::Args;
use fem::Fem;
use pressure::PressureMap;
pub use pressure::PressureName;
use rayon::prelude::*;
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

/// Rows of an even table.
const EVEN_ROWS: usize = 20;
/// Smallest torque that the curve's root finding resolves to six digits, N m.
const SMALLEST_NM: f64 = 1e-6;

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

/// One law's curve and the rows asked for.
struct LawCurve {
    name: LawName,
    /// The clutch with this law.
    clutch: Clutch,
    curve: WedgeCurve,
    /// The same with local deformation alone.
    local: WedgeCurve,
    /// Static point at each torque of the table; none beyond the curve's end.
    rows: Vec<(f64, Option<StaticPoint>)>,
}

/// One design with all that was asked of it.
struct Study {
    design: Design,
    profile: Profile,
    laws: Vec<LawCurve>,
    fem: Option<Fem>,
    /// Pressure along the length with the first law; absent: not asked for.
    pressure: Option<PressureMap>,
    run_time_s: f64,
}

/// Run the command.
///
/// # Errors
/// [`Failure`].
pub fn run(args: &StiffnessArgs, context: &Context) -> Result<Exit, Failure> {
    let inputs: Vec<&Path> = args.files.iter().chain(&args.fem).map(PathBuf::as_path).collect();
    context.outputs.check(&inputs, &[])?;
    refuse_tiny(args)?;
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
        context.outputs.write_csv(&tables::csv(&study.laws));
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
    let profile = place_profile(&design.clutch)
        .map_err(|e| parts::no_clutch(&args.files[i], &NoMargins::Profile(e)))?;
    let started = Instant::now();
    let laws = compute(args, &args.files[i], (&design, &profile), context)?;
    let shaped = (!design.clutch.axial.is_straight()).then_some(PressureName::Slices);
    let pressure = match (laws.first(), args.pressure.or(shaped)) {
        (Some(law), Some(how)) => Some(PressureMap::of(law, how)?),
        _ => None,
    };
    Ok(Study { design, profile, laws, fem, pressure, run_time_s: started.elapsed().as_secs_f64() })
}

fn answer(study: &Study) -> Answer<'_, Body> {
    // A term that one of the laws compared does hold is left out by the others all the same.
    let mut terms: Vec<LeftOut> = Vec::new();
    for term in study.laws.iter().flat_map(|l| left_out(&l.clutch)) {
        if terms.iter().all(|t| t.term != term.term) {
            terms.push(term);
        }
    }
    terms.push(at_rest());
    let truncation = study.laws.iter().map(|l| l.curve.truncation()).fold(0.0, f64::max);
    Answer {
        design: &study.design,
        run_time_s: study.run_time_s,
        left_out: terms,
        error_estimate: Some(truncation.into()),
        body: Body::new(study),
    }
}

fn refuse_tiny(args: &StiffnessArgs) -> Result<(), Failure> {
    let least = args.max_torque.map(|t| t / EVEN_ROWS as f64);
    match args.torques.iter().copied().chain(least).find(|&t| t < SMALLEST_NM) {
        Some(torque) => Err(Failure::malformed(format!(
            "a torque of {torque:e} Nm is too small: allowed from {SMALLEST_NM:e} Nm up"
        ))),
        None => Ok(()),
    }
}

/// Curves of the laws asked for, in parallel, and their rows at the torques asked for.
fn compute(
    args: &StiffnessArgs,
    file: &Path,
    (design, profile): (&Design, &Profile),
    context: &Context,
) -> Result<Vec<LawCurve>, Failure> {
    let names = laws::asked(&args.contact, &design.clutch.contact);
    let progress = context.progress("curves", "contact laws", Some(names.len() as u64));
    let curves = names
        .par_iter()
        .map(|&name| {
            if context.interrupt.requested() {
                return Err(Failure::Interrupted);
            }
            let contact = name.beside(&design.clutch.contact);
            let clutch = Clutch { contact, ..design.clutch.clone() };
            let none = |e| parts::no_clutch(file, &NoMargins::Curve(e));
            let curve = WedgeCurve::build(&clutch, profile, 0.0).map_err(none)?;
            let local = WedgeCurve::build_local(&clutch, profile).map_err(none)?;
            progress.advance(1);
            Ok((name, clutch, curve, local))
        })
        .collect::<Result<Vec<_>, Failure>>()?;
    let torques = torques(args, design, &curves);
    let laws = curves.into_par_iter().map(|(name, clutch, curve, local)| {
        let rows = torques.iter().map(|&t| (t, curve.at_torque(t))).collect();
        LawCurve { name, clutch, curve, local, rows }
    });
    Ok(laws.collect())
}

/// Torques of the table, N m: those asked for, or an even table up to the largest asked for, else up to the
/// design's peak torque or the first end of a curve, whichever comes first.
fn torques(
    args: &StiffnessArgs,
    design: &Design,
    curves: &[(LawName, Clutch, WedgeCurve, WedgeCurve)],
) -> Vec<f64> {
    if !args.torques.is_empty() {
        return args.torques.clone();
    }
    let first_end = curves.iter().map(|c| c.2.end_torque_nm()).fold(f64::INFINITY, f64::min);
    let largest = args
        .max_torque
        .unwrap_or_else(|| design.limits.peak_torque_nm.map_or(first_end, |peak| peak.min(first_end)));
    (1..=EVEN_ROWS).map(|i| largest * i as f64 / EVEN_ROWS as f64).collect()
}

/// Where the curve of a law ends, in words.
fn end_text(law: &LawCurve) -> String {
    let (reason, _) = law.curve.end();
    let torque = Unit::NewtonMetre.show(law.curve.end_torque_nm(), 5);
    format!("{} at {torque}", reason.name())
}
