//! `schema`: the JSON Schema of the design file.

use super::Context;
use super::exit::{Exit, Failure};

/// Run the command.
///
/// # Errors
/// [`Failure`].
pub fn run(_context: &Context) -> Result<Exit, Failure> {
    Err(Failure::Failed("schema is not wired yet".into()))
}
