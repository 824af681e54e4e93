//! The design files that come of a search: who wrote them, from what, then the file searched from with its comments, the
//! new values, and what these were.

use super::Story;
use super::words::shown;
use crate::answer::{VERSION, WRITTEN_BY};
use crate::design::{Design, EditError, with_notes};
use crate::optimise::Variable;
use crate::size::NOT_OPTIMISED;

/// The new design file; `command`: who asked for it.
///
/// # Errors
/// [`EditError`] where the text found is no design file.
pub fn file_text(design: &Design, story: &Story, command: &str) -> Result<String, EditError> {
    let found = &story.found;
    let change = |v: &Variable| {
        let after = story.value(v);
        match found.variables.iter().find(|f| f.name == v.name) {
            Some(f) if f.given == after => None,
            Some(f) => Some(format!("#   {}: {} -> {after}\n", v.name, f.given)),
            None => Some(format!("#   {}: {after}, chosen for the centroid\n", v.name)),
        }
    };
    let changes: String = story.made().variables.iter().filter_map(change).collect();
    let not_real = match story.makeable() {
        false => "# The centroid was free and the mass given: no flanks that give them are in this file.\n",
        true => "",
    };
    let (before, after) = story.objective();
    let head = format!(
        "{WRITTEN_BY} optimize {VERSION} from {:?} (sha256 {})\n# by: {}\n# {} {} -> {}\n{not_real}{changes}{END}\n",
        design.name,
        design.hash,
        command,
        found.aim.words(),
        shown(found.aim, before),
        shown(found.aim, after),
    );
    Ok(head + &body(design, story.file())?)
}

/// A further design file: `what` it is in a few words.
///
/// # Errors
/// As [`file_text`].
pub fn further_text(design: &Design, what: &str, text: &str) -> Result<String, EditError> {
    Ok(format!("{WRITTEN_BY} optimize {VERSION}: {what}\n{END}\n{}", body(design, text)?))
}

/// Middle of the name of the robust design.
pub const ROBUST: &str = "robust";
/// Middle of the name of the nearest design where none is feasible.
pub const NEAREST: &str = "nearest";

/// Further design files: middle of the name, what it is, text.
pub fn further_files(story: &Story) -> Vec<(&'static str, &'static str, &str)> {
    let mut files = Vec::new();
    if let Some(robust) = &story.robust {
        let what = match robust.made.held() {
            true => "held at every corner of [tolerances]",
            false => "as near as was found to holding every corner of [tolerances], not held at all",
        };
        files.push((ROBUST, what, robust.file.as_str()));
    }
    files
}

/// Last line of a head.
const END: &str = "#";

/// `text` without the head of an earlier search, whose figures are not those of this file, and without what a first design says
/// of itself; with a note on each value that is not that of `design`.
fn body(design: &Design, text: &str) -> Result<String, EditError> {
    let noted = with_notes(&design.source, without_head(text))?;
    let past = |line: &&str| line.strip_prefix("# ").is_some_and(|said| said.starts_with(NOT_OPTIMISED));
    Ok(noted.split_inclusive('\n').filter(|line| !past(line)).collect())
}

fn without_head(text: &str) -> &str {
    if !text.strip_prefix(WRITTEN_BY).is_some_and(|rest| rest.starts_with(" optimize ")) {
        return text;
    }
    let after_first = text.split_once('\n').map_or("", |(_, rest)| rest);
    let mut rest = after_first;
    // Further lines of ours begin with the command, or there are none; of a head by an earlier version or another hand the
    // first line alone is known to be one.
    let ours = rest.starts_with("# by: ") || rest.lines().next() == Some(END);
    while let Some((line, after)) = rest.split_once('\n').filter(|(line, _)| ours && line.starts_with('#')) {
        rest = after;
        if line == END {
            return rest;
        }
    }
    after_first
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_head_is_taken_off_whole_and_nothing_else() {
        let head = format!("{WRITTEN_BY} optimize 0.1.0 from \"x\"\n# by: y\n#   a: 1 -> 2\n#\n");
        assert_eq!(
            without_head(&format!("{head}# Why this file exists.\nschema = 1\n")),
            "# Why this file exists.\nschema = 1\n"
        );
        assert_eq!(without_head("# Why.\n#\nschema = 1\n"), "# Why.\n#\nschema = 1\n");
        for (end, rest) in [("", "# Why.\n#\nschema = 1\n"), ("#\n", "# Why.\n#\nschema = 1\n")] {
            assert_eq!(without_head(&format!("{WRITTEN_BY} optimize 0.1.0: z\n{end}{rest}")), rest);
        }
    }
}
