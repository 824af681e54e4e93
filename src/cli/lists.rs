//! `materials`, `oils`, `schema`, `completions`: what is known without a design.

use super::exit::{Exit, Failure};
use super::{Context, Run, Without, command, output};
use crate::answer::{oils, steels};
use crate::file::schema;
use crate::report::Rows;
use clap::Args;
use clap_complete::Shell;
use serde_json::json;

/// Arguments of `materials`.
#[derive(Debug, Args)]
pub struct MaterialsArgs {}

/// Arguments of `oils`.
#[derive(Debug, Args)]
pub struct OilsArgs {}

/// Arguments of `schema`.
#[derive(Debug, Args)]
pub struct SchemaArgs {}

/// Arguments of `completions`.
#[derive(Debug, Args)]
pub struct CompletionsArgs {
    /// The shell
    pub shell: Shell,
}

impl Run for MaterialsArgs {
    const WITHOUT: Without =
        ("steels are a table, they have no page", &["report", "set", "threads", "quiet"]);

    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        listed("materials", steels::list(), &steels::text(context.screen), context)
    }
}

impl Run for OilsArgs {
    const WITHOUT: Without = ("oils are a table, they have no page", &["report", "set", "threads", "quiet"]);

    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        listed("oils", oils::list(), &oils::text(context.screen), context)
    }
}

fn listed<T: Clone>(key: &str, list: Rows<T>, text: &str, context: &Context) -> Result<Exit, Failure> {
    context.reads([])?;
    context.outputs.refuse_foreign()?;
    context.outputs.write_csv(&list.clone().table());
    context.object(|| json!({ key: list.objects() }))?;
    context.answer(text)?;
    Ok(Exit::Held)
}

impl Run for SchemaArgs {
    const WITHOUT: Without =
        ("its answer is one JSON object", &["csv", "report", "set", "force", "threads", "quiet"]);

    /// The schema is JSON already, so `--json` changes nothing.
    fn run(&self, _: &Context) -> Result<Exit, Failure> {
        let text =
            serde_json::to_string_pretty(&schema()).map_err(|e| Failure::Failed(format!("JSON: {e}")))?;
        output::print(&(text + "\n"))?;
        Ok(Exit::Held)
    }
}

impl Run for CompletionsArgs {
    const WITHOUT: Without =
        ("its answer is a script", &["json", "csv", "report", "set", "force", "threads", "quiet"]);

    fn run(&self, _: &Context) -> Result<Exit, Failure> {
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut command(), output::TOOL, &mut script);
        output::print(&String::from_utf8_lossy(&script))?;
        Ok(Exit::Held)
    }
}
