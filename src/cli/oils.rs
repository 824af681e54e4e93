//! `oils`: the oils and greases that a design may name.

use super::exit::{Exit, Failure};
use super::{Context, output};
use crate::answer::oils::{list, table, text};
use serde_json::json;

/// Run the command.
///
/// # Errors
/// [`Failure`].
pub fn run(context: &Context) -> Result<Exit, Failure> {
    context.outputs.check(&[], &[])?;
    context.outputs.refuse_foreign()?;
    context.outputs.write_csv(&table());
    if context.json {
        output::print_json(&json!({ "tool": output::TOOL, "version": output::VERSION, "oils": list() }))?;
        return Ok(Exit::Held);
    }
    context.answer(&text(context.screen))?;
    Ok(Exit::Held)
}
