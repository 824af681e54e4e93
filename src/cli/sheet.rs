//! `sheet`: the design sheet.

use super::check::{checked, exit};
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
        context.outputs.write_csv(&check.csv_table());
        context.outputs.write_report(|| check.sheet(&design, &context.provenance(run_time_s)));
        let mut lines = vec![check.body.verdict()];
        lines.extend(check.body.capacity_lines());
        if context.outputs.unwritten().is_empty() {
            lines.push(format!("written to {}", path_text(&path)));
        }
        context.answer(&(lines.join("\n") + "\n"))?;
        context.print(&check.envelope(&design, run_time_s))?;
        Ok(exit(&check.body))
    }
}

/// `my-clutch-sheet.html` of `my-clutch.toml`.
fn beside(file: &Path) -> PathBuf {
    let stem = file.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned());
    file.with_file_name(format!("{stem}-sheet.html"))
}
