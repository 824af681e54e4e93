//! `explain`: what a code, a key or a name means.

use super::exit::{Exit, Failure};
use super::{Context, Run, Without};
use crate::answer::explanation::{Explanation, explain, groups, listed, unknown};
use clap::Args;
use serde_json::{Map, json};

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
    ("tolerances", "optimize FILE -o NEW.toml --robust"),
];

impl Run for ExplainArgs {
    const WITHOUT: Without =
        ("its answer is a few words", &["csv", "report", "set", "force", "threads", "quiet"]);

    fn run(&self, context: &Context) -> Result<Exit, Failure> {
        let Some(name) = &self.name else {
            context.answer(&listed(&[""]))?;
            let group = |(kind, names)| json!({ "kind": kind, "names": names });
            context.object(|| json!({ "names": groups().into_iter().map(group).collect::<Vec<_>>() }))?;
            return Ok(Exit::Held);
        };
        let command = super::command().find_subcommand(name).and_then(|c| c.get_about()).map(|about| {
            ("command", format!("sprag-design {name}: {about}; see sprag-design {name} --help"))
        });
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
        // Lines of one heading stand below one another.
        let mut says: Vec<(&str, String)> = Vec::new();
        for (heading, line) in &found.lines {
            match says.iter_mut().find(|(other, _)| other == heading) {
                Some((_, lines)) => *lines = format!("{lines}\n{line}"),
                None => says.push((heading, line.clone())),
            }
        }
        let says = says.into_iter().map(|(heading, lines)| (heading.to_owned(), json!(lines)));
        context
            .object(|| json!({ "name": name, "kind": found.kind, "says": says.collect::<Map<_, _>>() }))?;
        Ok(Exit::Held)
    }
}
