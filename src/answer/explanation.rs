//! What a limit, a key, a variable or another name means.

use crate::clutch::LAWS;
use crate::design::{LIMIT_KEYS, NEW_SCENES, OVERRUN, Objective, did_you_mean};
use crate::file::{
    KindKeys, SCENARIO_KINDS, VARIABLES, allowed, keys_of, paths_of, shape_of, unit_of_key, variable_path,
};
use crate::margin::{LIMITS, When, limit_of};
use crate::scenario::FIGURES;
use crate::size::PURPOSES;

/// What is known of a name: its kind, and lines of a heading and a text.
#[derive(Debug, Clone, PartialEq)]
pub struct Explanation {
    /// What kind of name it is.
    pub kind: &'static str,
    /// The lines.
    pub lines: Vec<(&'static str, String)>,
}

/// Every name that is explained, by kind.
pub fn groups() -> Vec<(&'static str, Vec<String>)> {
    let owned = |names: &mut dyn Iterator<Item = &'static str>| names.map(str::to_owned).collect::<Vec<_>>();
    vec![
        ("limits", owned(&mut LIMITS.iter().map(|l| l.code))),
        (
            "variables of [optimize], beside any number of the clutch by its dotted key",
            owned(&mut VARIABLES.iter().map(|(name, ..)| *name)),
        ),
        ("objectives of [optimize]", owned(&mut Objective::ALL.iter().map(|o| o.name()))),
        ("contact laws", owned(&mut LAWS.iter().map(|l| l.key))),
        ("kinds of scenario", owned(&mut SCENARIO_KINDS.iter().map(|k| k.name))),
        ("what `new` designs a clutch for", owned(&mut PURPOSES.iter().map(|p| p.name))),
        ("scenes of the files that `new` writes", owned(&mut NEW_SCENES.iter().map(|s| s.name))),
        ("tables of the design file", keys_of("").into_iter().map(str::to_owned).collect()),
    ]
}

/// Those whose kind begins with one of `kinds`, as text.
pub fn listed(kinds: &[&str]) -> String {
    let mut text = String::new();
    for (kind, names) in groups().iter().filter(|(kind, _)| kinds.iter().any(|k| kind.starts_with(k))) {
        text.push_str(&format!("{kind}:\n"));
        names.chunks(4).for_each(|row| text.push_str(&format!("  {}\n", row.join(", "))));
    }
    text
}

/// What `name` is, if anything; what else is called so; of a kind of names, such as `variables`, those too.
pub fn explain(name: &str) -> Option<Explanation> {
    let of: [fn(&str) -> Option<Explanation>; 10] =
        [limit, objective, law, scenario_kind, purpose, key, bare, scene, figure, word];
    let mut senses = of.into_iter().filter_map(|kind_of_name| kind_of_name(name));
    let mut found = senses.next();
    if let Some(found) = &mut found {
        // A limit names the objective of its name itself, and a key without its table the one with it.
        let told = |other: &Explanation| {
            found.kind == "a limit" && other.kind == OBJECTIVE
                || found.kind.contains("the design file") && other.kind == KEYS
        };
        let others: Vec<Explanation> = senses.filter(|other| !told(other)).collect();
        let also = |other: Explanation| {
            let parts = other.lines.iter().filter(|(heading, _)| ["key", "is"].contains(heading));
            let parts: Vec<&str> =
                parts.map(|(_, line)| line.as_str()).filter(|line| *line != name).collect();
            // A key and what it is; else one thing after another.
            let between = if other.lines.iter().any(|line| line.0 == "is") { ": " } else { "; " };
            (!parts.is_empty()).then(|| ("also", format!("{}: {}", other.kind, parts.join(between))))
        };
        found.lines.extend(others.into_iter().filter_map(also));
    }
    // The first word of a kind, where that is a plural.
    let of_kind =
        |(kind, _): &(&str, Vec<String>)| name.ends_with('s') && kind.split(' ').next() == Some(name);
    let Some((kind, names)) = groups().into_iter().find(of_kind) else { return found };
    let mut found = found.unwrap_or(Explanation { kind: "names that `explain` explains", lines: Vec::new() });
    found.lines.push(("lists", kind.to_owned()));
    found.lines.extend(names.chunks(4).map(|row| ("names", row.join(", "))));
    Some(found)
}

/// What an objective is.
const OBJECTIVE: &str = "an objective of [optimize]";
/// What a key is that several tables have.
const KEYS: &str = "a key of several tables";

fn limit(code: &str) -> Option<Explanation> {
    let limit = limit_of(code)?;
    let scene =
        code.split_once(':').map_or("a scenario", |(_, scene)| scene.split(" @ ").next().unwrap_or(scene));
    let mut lines = vec![
        ("holds", limit.name().replace("{scene}", scene)),
        ("is", limit.explanation.split_whitespace().collect::<Vec<_>>().join(" ")),
        ("formula", limit.formula.to_owned()),
        ("source", limit.source.to_owned()),
        ("margin", limit.rule.words().to_owned()),
    ];
    if !limit.unit.is_empty() && limit.unit != "1" {
        lines.push(("unit", limit.unit.to_owned()));
    }
    lines.push((
        "allowed by",
        limit.key.map_or("the design itself".to_owned(), |key| format!("limits.{key}")),
    ));
    if let Some(also) = Objective::ALL.into_iter().find(|o| o.name() == code) {
        let better = if also.sense() > 0.0 { "more" } else { "less" };
        lines.push(("also", format!("an objective of [optimize]: {}; {better} is better", also.words())));
    }
    Some(Explanation { kind: "a limit", lines })
}

fn objective(name: &str) -> Option<Explanation> {
    let o = Objective::ALL.into_iter().find(|o| o.name() == name)?;
    let better = if o.sense() > 0.0 { "more" } else { "less" };
    let mut lines = vec![("is", o.words().to_owned()), ("better", better.to_owned())];
    if !o.unit().is_empty() {
        lines.push(("unit", o.unit().to_owned()));
    }
    Some(Explanation { kind: OBJECTIVE, lines })
}

fn law(name: &str) -> Option<Explanation> {
    let law = LAWS.iter().find(|l| l.key == name)?;
    Some(Explanation { kind: "a contact law, contact.law", lines: vec![("is", law.title.to_owned())] })
}

fn scenario_kind(name: &str) -> Option<Explanation> {
    let kind = SCENARIO_KINDS.iter().find(|k| k.name == name)?;
    let mut lines = vec![("is", kind.words.to_owned()), ("needs", kind.required.join(", "))];
    if !kind.optional.is_empty() {
        lines.push(("may have", kind.optional.join(", ")));
    }
    Some(Explanation { kind: "a kind of scenario, scenarios[].kind", lines })
}

fn purpose(name: &str) -> Option<Explanation> {
    let purpose = PURPOSES.iter().find(|p| p.name == name)?;
    let is = format!("a clutch that {}", purpose.words);
    Some(Explanation { kind: "what a clutch is for, `new --for`", lines: vec![("is", is)] })
}

fn scene(name: &str) -> Option<Explanation> {
    let scene = NEW_SCENES.iter().find(|s| s.name == name)?;
    let mut lines = vec![("is", scene.words.to_owned()), ("kind", scene.kind.to_owned())];
    if scene.kind != OVERRUN.kind {
        let rows = LIMITS.iter().filter(|l| l.when == When::Scene).map(|l| format!("{}:{name}", l.code));
        lines.push(("in check", rows.collect::<Vec<_>>().join(", ")));
    }
    lines.push(("try", format!("`sprag-design simulate FILE --scenario {name}`")));
    Some(Explanation { kind: "a scene of the files that `new` writes", lines })
}

/// A figure of a simulation by its line there, or by its key in JSON.
fn figure(name: &str) -> Option<Explanation> {
    let label = |f: &&crate::scenario::Figure| f.line.is_some_and(|line| line.label == name);
    let figure = FIGURES.iter().find(label).or_else(|| FIGURES.iter().find(|f| f.key == name))?;
    let lines = vec![("is", figure.words.to_owned()), ("in JSON", figure.key.to_owned())];
    Some(Explanation { kind: "a figure of `simulate`", lines })
}

/// The guide's page of words and symbols: the one place that has them.
const WORDS: &str = include_str!("../../docs/src/words.md");

/// A word or a symbol of that page: its row, the sense in the last column.
fn word(name: &str) -> Option<Explanation> {
    let plain = |text: &str| text.replace(['`', '*'], "").trim().to_owned();
    let wanted = plain(name).to_lowercase();
    let rows = WORDS.lines().filter_map(|line| {
        let cells: Vec<&str> = line.trim().strip_prefix('|')?.strip_suffix('|')?.split(" | ").collect();
        Some((plain(cells.first()?), cells.iter().skip(1).map(|cell| plain(cell)).collect::<Vec<_>>()))
    });
    let is = |heading: &str| {
        let heading = heading.to_lowercase();
        heading == wanted
            || heading.split(", ").any(|one| one == wanted || one.split(' ').next_back() == Some(&wanted))
    };
    let all: Vec<_> = rows.filter(|(heading, _)| is(heading)).collect();
    // r_e is not R_e, where both are there.
    let exact = plain(name);
    let to_the_letter =
        all.iter().filter(|(heading, _)| heading.split(", ").any(|one| one == exact)).cloned();
    let to_the_letter: Vec<_> = to_the_letter.collect();
    let lines: Vec<(&'static str, String)> = if to_the_letter.is_empty() { all } else { to_the_letter }
        .into_iter()
        .flat_map(|(heading, cells)| {
            let file = (cells.len() > 1 && cells[0] != "–").then(|| ("in the file", cells[0].clone()));
            file.into_iter().chain(cells.last().map(|sense| ("is", format!("{heading}: {sense}"))))
        })
        .collect();
    (!lines.is_empty()).then_some(Explanation { kind: "a word of this tool", lines })
}

/// A key without the tables that it stands in.
fn bare(name: &str) -> Option<Explanation> {
    match paths_of(name).as_slice() {
        [] => None,
        [only] => {
            let mut found = key(only)?;
            found.lines.insert(0, ("key", only.clone()));
            Some(found)
        }
        several => {
            let one = |path: &String| {
                let is = key(path).and_then(|found| found.lines.into_iter().find(|line| line.0 == "is"));
                ("key", format!("{path}: {}", is.map_or(String::new(), |line| line.1)))
            };
            Some(Explanation { kind: KEYS, lines: several.iter().map(one).collect() })
        }
    }
}

/// Of the `keys` of a scenario those of every kind, and those of each.
fn keys_by_kind(keys: &[&str]) -> Vec<(&'static str, String)> {
    let of_a_kind =
        |key: &&&str| SCENARIO_KINDS.iter().any(|k| k.required.contains(*key) || k.optional.contains(*key));
    let of_any: Vec<&str> = keys.iter().filter(|key| !of_a_kind(key)).copied().collect();
    let one = |kind: &KindKeys| {
        let may = kind.optional.join(", ");
        let may = if may.is_empty() { may } else { format!("; may have {may}") };
        ("by kind", format!("{}: needs {}{may}", kind.name, kind.required.join(", ")))
    };
    std::iter::once(("of any kind", of_any.join(", "))).chain(SCENARIO_KINDS.iter().map(one)).collect()
}

/// Units in a description as people read them.
fn in_micrometres(text: &str) -> String {
    text.replace(", um", ", µm").replace("N/um", "N/µm")
}

fn key(name: &str) -> Option<Explanation> {
    /// As many arcs as names may count.
    const ARCS: usize = 100;
    let path = variable_path(name, ARCS).unwrap_or_else(|| name.to_owned());
    let schema = shape_of(&path)?;
    let mut lines = Vec::new();
    if path != name {
        lines.push(("key", path.clone()));
    }
    let description = schema.get("description").and_then(|v| v.as_str()).unwrap_or("");
    let description = description.split_whitespace().collect::<Vec<_>>().join(" ");
    lines.push(("is", in_micrometres(&description)));
    lines.extend(of_arc(name).map(|words| ("here", words)));
    let key = path.rsplit('.').next()?;
    let of_limit = || LIMIT_KEYS.iter().find(|l| path == format!("limits.{}", l.name)).map(|l| l.unit);
    if let Some(unit) = unit_of_key(key).or_else(of_limit).filter(|unit| !unit.is_empty()) {
        lines.push(("unit", unit.to_owned()));
    }
    let at_it: Vec<&str> =
        LIMITS.iter().filter(|l| l.when.key().is_some_and(|at| at == key)).map(|l| l.code).collect();
    if !at_it.is_empty() {
        lines.push(("held at it", at_it.join(", ")));
    }
    // Of an array of tables those of one row.
    let keys = [path.clone(), format!("{path}[0]")].iter().flat_map(|at| keys_of(at)).collect::<Vec<_>>();
    lines.push(if keys.is_empty() { ("allowed", allowed(schema)) } else { ("keys", keys.join(", ")) });
    if path == "scenarios" {
        lines.extend(keys_by_kind(&keys));
    }
    if path != name {
        lines.push((
            "try",
            format!("`sprag-design check FILE --set {path}=VALUE`, or its slider in the studio"),
        ));
    }
    Some(Explanation {
        kind: if keys.is_empty() { "a key of the design file" } else { "a table of the design file" },
        lines,
    })
}

/// What a variable of one arc is, with the number of that arc: `r_i2_mm`.
fn of_arc(name: &str) -> Option<String> {
    let (k, words) = VARIABLES.iter().find_map(|(pattern, _, words)| {
        let (before, behind) = pattern.split_once("{k}")?;
        let k: usize = name.strip_prefix(before)?.strip_suffix(behind)?.parse().ok()?;
        Some((k, words))
    })?;
    let words = words.replace("k+1", &(k + 1).to_string()).replace("arc k", &format!("arc {k}"));
    Some(format!("{words}; arcs count from 1, from first contact on, rows of the file from 0"))
}

/// The refusal of a name that nothing has, with the nearest one.
pub fn unknown(name: &str) -> String {
    let groups = groups();
    let all: Vec<&str> = groups.iter().flat_map(|(_, names)| names.iter().map(String::as_str)).collect();
    let near = did_you_mean(name, &all);
    format!(
        "nothing is called {name:?}{near}; `explain` alone lists every name. A scene has the name that its file gives it: \
         `explain scenarios` tells what one is, `simulate FILE --scenario NAME` what becomes of it"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_that_is_listed_is_explained() {
        for (kind, names) in groups() {
            for name in names {
                let asked = name.replace("{k}", "1");
                let found = explain(&asked).unwrap_or_else(|| panic!("{kind}: {asked}"));
                assert!(found.lines.iter().any(|(_, line)| line.len() > 5), "{asked}: {:?}", found.lines);
            }
        }
        let holds = |name: &str| explain(name).unwrap().lines[0].1.clone();
        assert!(
            holds("slip:high-10").contains("that high-10 needs")
                && holds("slip").contains("that a scenario needs")
        );
        assert!(holds("contact:swing @ +friction").contains("force in swing over"));
        assert!(explain("run-out-grip-inner").is_some());
        assert!(explain("torsional-excitation").unwrap().lines[1].1.contains("amplitude_nm"));
        assert!(explain("two-speed").unwrap().lines[0].1.contains("lower gear"));
        let keys =
            |name: &str| explain(name).unwrap().lines.iter().find(|l| l.0 == "keys").unwrap().1.clone();
        assert!(keys("scenarios").contains("preload_nm") && keys("races").contains("width_mm"));
        // Every key of a scenario belongs to a kind, or to all of them.
        let scenes = explain("scenarios").unwrap();
        let of = |heading: &str| {
            scenes.lines.iter().filter(|l| l.0 == heading).map(|l| l.1.as_str()).collect::<Vec<_>>()
        };
        assert_eq!(of("of any kind"), ["contact, friction, kind, material, name, races, sprags, spring"]);
        assert_eq!(of("by kind").len(), SCENARIO_KINDS.len());
        assert_eq!(of("by kind")[0], "static: needs torque_nm; may have start");
        assert!(of_arc("r_i2_mm").unwrap().starts_with("radius of inner arc 2;"));
        assert!(of_arc("junction_1_rad").unwrap().contains("arc 1 gives way to arc 2;"));
        // A key without its table: the one that there is, or each.
        let only = explain("size_within_um").unwrap();
        assert_eq!(only.lines[0], ("key", "sharing.size_within_um".to_owned()));
        assert!(only.lines.contains(&("unit", "µm".to_owned())) && only.lines[1].1.ends_with(", µm."));
        let start = explain("start").unwrap();
        let paths: Vec<&str> = start.lines.iter().filter_map(|l| l.1.split(':').next()).collect();
        assert_eq!(paths, ["scenarios[0].start", "sharing.start"]);
        assert_eq!(explain("flanks").unwrap().lines[0].1, "sprags.flanks");
        for (name, sense) in [
            ("γ", "azimuth"),
            ("gamma", "azimuth"),
            ("p₀", "largest"),
            ("shown only", "information"),
            ("(12)", "paper"),
        ] {
            let found = explain(name).unwrap_or_else(|| panic!("{name}"));
            assert!(found.lines.iter().any(|(_, line)| line.contains(sense)), "{name}: {:?}", found.lines);
        }
        let unit = |name: &str| explain(name).unwrap().lines.into_iter().find(|l| l.0 == "unit").unwrap().1;
        assert_eq!((unit("keep_contact_to_rpm").as_str(), unit("gap_peak_mm").as_str()), ("rpm", "mm"));
        // One name of several things: each of them is told.
        let swing = explain("swing").unwrap();
        assert_eq!(swing.kind, "a scene of the files that `new` writes");
        let lines =
            swing.lines.iter().map(|(heading, line)| format!("{heading} {line}\n")).collect::<String>();
        for said in [
            "is The torque on the outer race swings",
            "slip:swing, contact:swing",
            "also a word of this tool: steady overrun, swing, growth",
        ] {
            assert!(lines.contains(said), "{said}: {lines}");
        }
        assert_eq!(explain("largest Hertz pressure").unwrap().kind, "a figure of `simulate`");
        // A kind of names lists them, beside what the word is in the file.
        for (kind, names) in groups().into_iter().filter(|(kind, _)| !kind.starts_with(['c', 'w'])) {
            let found = explain(kind.split(' ').next().unwrap()).unwrap();
            let listed: Vec<&str> =
                found.lines.iter().filter(|l| l.0 == "names").flat_map(|l| l.1.split(", ")).collect();
            assert_eq!(listed, names, "{kind}");
        }
        assert!(
            keys("variables").contains("scales")
                && explain("contact").unwrap().lines.iter().filter(|line| line.0 != "also").count() == 6
        );
        assert!(explain("limits.hertz_peak_mpa").is_some() && explain("nothing").is_none());
        assert!(unknown("hoop-iner").contains("did you mean hoop-inner?"));
    }
}
