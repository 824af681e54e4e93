//! `schema`: the JSON Schema of the design file.

use super::exit::{Exit, Failure};
use super::output;

/// Run the command. The schema is JSON already, so `--json` changes nothing.
///
/// # Errors
/// [`Failure`].
pub fn run() -> Result<Exit, Failure> {
    let text = serde_json::to_string_pretty(&crate::design::schema())
        .map_err(|e| Failure::Failed(format!("JSON: {e}")))?;
    output::print(&(text + "\n"))?;
    Ok(Exit::Held)
}
