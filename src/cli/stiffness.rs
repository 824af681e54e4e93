//! `stiffness`: the static curve, for one contact law or several side by side.

use super::exit::{Exit, Failure};
use super::{Context, Run, positive};
use crate::answer::Answer;
use crate::answer::stiffness::{Fem, NoStiffness, StiffnessSettings, StiffnessStudy, page};
use crate::clutch::LawName;
use crate::file::{MOST_TABLE, read_text};
use crate::wedge::Lengthwise;
use clap::Args;
use std::path::{Path, PathBuf};

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
    /// Design files (TOML); of more than one the answers follow one another, with --report on one page
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
    pub pressure: Option<Lengthwise>,
}

impl Run for StiffnessArgs {
    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        context.reads(self.files.iter().chain(&self.fem))?;
        self.settings(context).validate().map_err(|why| Failure::malformed(why.to_string()))?;
        let several = self.files.len() > 1;
        if several && context.outputs.csv.is_some() {
            return Err(Failure::malformed(
                "--csv is of one FILE; several make one page with --report, or a line each with --json",
            ));
        }
        if !self.fem.is_empty() && self.fem.len() != self.files.len() {
            let (fem, files) = (self.fem.len(), self.files.len());
            return Err(Failure::malformed(format!(
                "{fem} --fem for {files} FILEs: give one for each, in their order"
            )));
        }
        let studies =
            (0..self.files.len()).map(|i| study(self, i, context)).collect::<Result<Vec<_>, _>>()?;
        if let [study] = studies.as_slice() {
            return context.deliver(study, study.run_time_s);
        }
        context.outputs.write_report(|| page(&studies, &context.command_line));
        for study in &studies {
            context.answer(&study.text(context.screen))?;
            context.print(&study.envelope(study.run_time_s))?;
        }
        Ok(Exit::Held)
    }
}

/// What is asked of the `i`-th file.
fn study(args: &StiffnessArgs, i: usize, context: &Context) -> Result<StiffnessStudy, Failure> {
    let design = context.design(&args.files[i])?;
    let fem = args.fem.get(i).map(|path| read_fem(path, args.fem_model.as_deref())).transpose()?;
    let mut settings = args.settings(context);
    let count = settings.laws_of(&design.clutch.contact).len() as u64;
    let progress = context.progress("curves", "contact laws", Some(count));
    settings.follow = progress.told_by(&settings.follow);
    StiffnessStudy::of(design, &settings, fem, args.pressure).map_err(|why| match why {
        NoStiffness::NoClutch(why) => Failure::no_clutch(&args.files[i], &why),
        NoStiffness::Torque(_) => Failure::malformed(why.to_string()),
        NoStiffness::Pressure(_) => {
            Failure::malformed(format!("{why}; take fewer slices or --pressure slices"))
        }
        NoStiffness::Stopped => Failure::Interrupted,
    })
}

/// Finite elements of `--fem`.
fn read_fem(path: &Path, model: Option<&str>) -> Result<Fem, Failure> {
    let name = path.display().to_string();
    let text =
        read_text(path, MOST_TABLE).map_err(|why| Failure::malformed(format!("--fem {name}: {why}")))?;
    Fem::parse(&text, &name, model).map_err(Failure::malformed)
}

impl StiffnessArgs {
    fn settings(&self, context: &Context) -> StiffnessSettings {
        StiffnessSettings {
            laws: self.contact.clone(),
            torques_nm: self.torques.clone(),
            max_torque_nm: self.max_torque,
            follow: context.follow.clone(),
        }
    }
}
