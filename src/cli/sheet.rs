//! `sheet`: the design sheet.

use super::check::checked;
use super::exit::{Exit, Failure};
use super::output::path_text;
use super::{Context, Run};
use clap::Args;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  sprag-design sheet designs/huang2017-multi-arc.toml
  sprag-design sheet designs/huang2017-multi-arc.toml --report sheet.html

The page is written to --report, or beside FILE as FILE-sheet.html. It prints on A4; a PDF is made by printing it. The numbers
and the exit code are those of `check`; --json and --csv give what they give there.";

/// Arguments of `sheet`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct SheetArgs {
    /// Design file (TOML)
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
}

impl Run for SheetArgs {
    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        let mut context = context.clone();
        let path = context.outputs.report.clone().unwrap_or_else(|| beside(&self.file));
        context.outputs.report = Some(path.clone());
        context.outputs.check(&[&self.file], &[])?;
        let design = context.design(&self.file)?;
        let (check, run_time_s) = checked(&design, &self.file, &context)?;
        let exit = context.deliver(&check.sheet(), run_time_s)?;
        if context.outputs.unwritten().is_empty() {
            context.answer(&format!("written to {}\n", path_text(&path)))?;
        }
        Ok(exit)
    }
}

/// `my-clutch-sheet.html` of `my-clutch.toml`.
fn beside(file: &Path) -> PathBuf {
    let stem = file.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned());
    file.with_file_name(format!("{stem}-sheet.html"))
}
