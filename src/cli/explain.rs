//! `explain`: what a code, a key or a name means.

use super::exit::{Exit, Failure};
use super::{Context, output};
use crate::answer::explanation::{Explanation, all, explain, groups, unknown};
use clap::Args;
use serde_json::json;

const EXAMPLES: &str = "\
Examples:
  sprag-design explain
  sprag-design explain hoop-inner
  sprag-design explain sprags.centre_distance_mm
  sprag-design explain r_i2_mm

Without a name every name is listed.";

/// Arguments of `explain`.
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct ExplainArgs {
    /// Code of a limit, dotted key of the design file, variable, objective, contact law or command
    #[arg(value_name = "NAME")]
    pub name: Option<String>,
}

/// Tables of the file, and the command that shows what they come to, where it has another name.
const SHOWN_BY: [(&str, &str); 6] = [
    ("lubrication", "overrun FILE"),
    ("scenarios", "simulate FILE --scenario NAME"),
    ("drivetrain", "simulate FILE --scenario NAME"),
    ("limits", "check FILE"),
    ("thermal", "check FILE"),
    ("tolerances", "optimize FILE -o NEW.toml"),
];

/// Run the command.
///
/// # Errors
/// [`Failure::Malformed`] where nothing has that name.
pub fn run(args: &ExplainArgs, context: &Context) -> Result<Exit, Failure> {
    let Some(name) = &args.name else {
        context.answer(&all())?;
        if context.json {
            let names: Vec<_> =
                groups().into_iter().map(|(kind, names)| json!({ "kind": kind, "names": names })).collect();
            output::print_json(&json!({ "tool": output::TOOL, "version": output::VERSION, "names": names }))?;
        }
        return Ok(Exit::Held);
    };
    let command = super::command()
        .find_subcommand(name)
        .and_then(|c| c.get_about())
        .map(|about| ("command", format!("sprag-design {name}: {about}; see sprag-design {name} --help")));
    let mut found = match (explain(name), &command) {
        (Some(found), _) => found,
        (None, Some(_)) => Explanation { kind: "a command", lines: Vec::new() },
        (None, None) => return Err(Failure::malformed(unknown(name))),
    };
    if let (None, Some((_, example))) = (&command, SHOWN_BY.iter().find(|(table, _)| table == name)) {
        found.lines.push(("shown by", format!("sprag-design {example}")));
    }
    found.lines.extend(command);
    let mut text = format!("{name}: {}\n", found.kind);
    for (heading, line) in &found.lines {
        text.push_str(&format!("  {heading:<11} {line}\n"));
    }
    context.answer(&text)?;
    if context.json {
        let lines: serde_json::Map<_, _> =
            found.lines.iter().map(|(heading, line)| ((*heading).to_owned(), json!(line))).collect();
        let object = json!({ "tool": output::TOOL, "version": output::VERSION, "name": name, "kind": found.kind, "says": lines });
        output::print_json(&object)?;
    }
    Ok(Exit::Held)
}
