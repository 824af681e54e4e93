//! `explain`: what a code, a key or a name means.

use super::exit::{Exit, Failure};
use super::{Context, output};
use crate::clutch::LAWS;
use crate::design::{Objective, VARIABLES, allowed, keys_of, nearest, shape_of, unit_of_key, variable_path};
use crate::margin::{LIMITS, limit_of};
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
    /// Code of a limit, dotted key of the design file, variable, objective or contact law
    #[arg(value_name = "NAME")]
    pub name: Option<String>,
}

/// What is known of a name: its kind, and lines of a heading and a text.
struct Entry {
    kind: &'static str,
    lines: Vec<(&'static str, String)>,
}

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
    let found = entry(name).ok_or_else(|| unknown(name))?;
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

fn groups() -> Vec<(&'static str, Vec<String>)> {
    let owned = |names: &mut dyn Iterator<Item = &'static str>| names.map(str::to_owned).collect::<Vec<_>>();
    vec![
        ("limits, as check, optimize and the studio call them", owned(&mut LIMITS.iter().map(|l| l.code))),
        (
            "variables of [optimize], beside any number of the clutch by its dotted key",
            owned(&mut VARIABLES.iter().map(|(name, ..)| *name)),
        ),
        ("objectives of [optimize]", owned(&mut Objective::ALL.iter().map(|o| o.name()))),
        ("contact laws", owned(&mut LAWS.iter().map(|l| l.key))),
        ("tables of the design file", keys_of("").into_iter().map(str::to_owned).collect()),
    ]
}

fn all() -> String {
    let mut text = String::new();
    for (kind, names) in groups() {
        text.push_str(&format!("{kind}:\n"));
        names.chunks(4).for_each(|row| text.push_str(&format!("  {}\n", row.join(", "))));
    }
    text
}

fn entry(name: &str) -> Option<Entry> {
    limit(name).or_else(|| objective(name)).or_else(|| law(name)).or_else(|| key(name))
}

fn limit(code: &str) -> Option<Entry> {
    let limit = limit_of(code)?;
    let mut lines = vec![
        ("holds", limit.name().to_owned()),
        ("is", limit.explanation.split_whitespace().collect::<Vec<_>>().join(" ")),
        ("margin", limit.rule.words().to_owned()),
    ];
    if !limit.unit.is_empty() && limit.unit != "1" {
        lines.push(("unit", limit.unit.to_owned()));
    }
    lines.push((
        "allowed by",
        limit.key.map_or("the design itself".to_owned(), |key| format!("limits.{key}")),
    ));
    Some(Entry { kind: "a limit", lines })
}

fn objective(name: &str) -> Option<Entry> {
    let o = Objective::ALL.into_iter().find(|o| o.name() == name)?;
    let better = if o.sense() > 0.0 { "more" } else { "less" };
    let mut lines = vec![("is", o.words().to_owned()), ("better", better.to_owned())];
    if !o.unit().is_empty() {
        lines.push(("unit", o.unit().to_owned()));
    }
    Some(Entry { kind: "an objective of [optimize]", lines })
}

fn law(name: &str) -> Option<Entry> {
    let law = LAWS.iter().find(|l| l.key == name)?;
    Some(Entry { kind: "a contact law, contact.law", lines: vec![("is", law.title.to_owned())] })
}

fn key(name: &str) -> Option<Entry> {
    /// As many arcs as names may count.
    const ARCS: usize = 100;
    let path = variable_path(name, ARCS).unwrap_or_else(|| name.to_owned());
    let schema = shape_of(&path)?;
    let mut lines = Vec::new();
    if path != name {
        lines.push(("key", path.clone()));
    }
    let text = |key: &str| schema.get(key).and_then(|v| v.as_str()).unwrap_or("").to_owned();
    lines.push(("is", text("description")));
    let key = path.rsplit('.').next()?;
    if let Some(unit) = unit_of_key(key).filter(|unit| !unit.is_empty()) {
        lines.push(("unit", unit.to_owned()));
    }
    // Of an array of tables those of one row.
    let keys = [path.clone(), format!("{path}[0]")].iter().flat_map(|at| keys_of(at)).collect::<Vec<_>>();
    lines.push(if keys.is_empty() { ("allowed", allowed(schema)) } else { ("keys", keys.join(", ")) });
    Some(Entry {
        kind: if keys.is_empty() { "a key of the design file" } else { "a table of the design file" },
        lines,
    })
}

fn unknown(name: &str) -> Failure {
    let groups = groups();
    let all: Vec<&str> = groups.iter().flat_map(|(_, names)| names.iter().map(String::as_str)).collect();
    let near = nearest(name, &all).map_or(String::new(), |near| format!("; did you mean {near}?"));
    Failure::malformed(format!("nothing is called {name:?}{near}; `explain` alone lists every name"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_that_is_listed_is_explained() {
        for (kind, names) in groups() {
            for name in names {
                let asked = name.replace("{k}", "1");
                let found = entry(&asked).unwrap_or_else(|| panic!("{kind}: {asked}"));
                assert!(found.lines.iter().any(|(_, line)| line.len() > 5), "{asked}: {:?}", found.lines);
            }
        }
        assert!(entry("slip:high-10").is_some() && entry("run-out-grip-inner").is_some());
        let keys = |name: &str| entry(name).unwrap().lines.iter().find(|l| l.0 == "keys").unwrap().1.clone();
        assert!(keys("scenarios").contains("preload_nm") && keys("races").contains("width_mm"));
        assert!(entry("limits.hertz_peak_mpa").is_some() && entry("nothing").is_none());
        assert!(format!("{:?}", unknown("hoop-iner")).contains("did you mean hoop-inner?"));
    }
}
