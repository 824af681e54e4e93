//! The design files that come of a search: who wrote them, from what, then the file searched from with its comments, the
//! new values, and what these were.

use super::words::shown;
use super::{SearchAnswer, Story};
use crate::answer::{TOOL, VERSION, WRITTEN_BY};
use crate::design::Design;
use crate::file::{DesignError, EditError, with_notes};
use crate::optimise::{Status, Variable};
use crate::size::NOT_OPTIMISED;

/// Middle of the name of the robust design.
pub const ROBUST: &str = "robust";
/// Middle of the name of the nearest design where none is feasible.
pub const NEAREST: &str = "nearest";

/// A design file that a search is worth.
#[derive(Debug)]
pub struct SearchFile {
    /// Middle of its name, [`ROBUST`] or [`NEAREST`]; absent: the design found.
    pub middle: Option<&'static str>,
    /// Its text, or why there is none.
    pub text: Result<String, NoFile>,
}

/// Why a design file was not made.
#[derive(Debug, thiserror::Error)]
pub enum NoFile {
    /// The text found is no design file.
    #[error("{0}")]
    Edit(EditError),
    /// The file would be refused.
    #[error(
        "not written, it would be a design file that this tool refuses; report this as a fault of {TOOL}; {0}"
    )]
    Refused(DesignError),
}

impl SearchAnswer {
    /// Design files that the search is worth, found from `design`: the design found, the robust one, or where none holds every
    /// limit the nearest. None of a search that was stopped before it had a better one. `command`: who asked for it.
    pub fn files(&self, design: &Design, command: &str) -> Vec<SearchFile> {
        let story = &self.story;
        let interrupted = story.status() == &Status::Interrupted;
        let file = |middle, text: Result<String, EditError>| SearchFile {
            middle,
            text: text.map_err(NoFile::Edit).and_then(|text| read_again(design, text)),
        };
        // Stopped before there were flanks: the best so far is better than nothing, and says what it lacks.
        if story.feasible() && (story.makeable() || interrupted) {
            if interrupted && !story.improved() && story.found.start_feasible() {
                return Vec::new();
            }
            let robust = story.robust.as_ref().map(|robust| {
                let what = match robust.made.held() {
                    true => "held at every corner of [tolerances]",
                    false => "as near as was found to holding every corner of [tolerances], not held at all",
                };
                file(Some(ROBUST), further_text(design, what, &robust.file))
            });
            return std::iter::once(file(None, file_text(design, story, command))).chain(robust).collect();
        }
        if interrupted {
            return Vec::new();
        }
        let why = match story.feasible() {
            true => "no flanks give its centroid".to_owned(),
            false => format!("not held: {}", story.not_held().join(", ")),
        };
        let what = format!("the nearest design found, NOT FEASIBLE: {why}");
        vec![file(Some(NEAREST), further_text(design, &what, story.file()))]
    }
}

/// `text` if it reads as a design with the histories of `design`.
fn read_again(design: &Design, text: String) -> Result<String, NoFile> {
    match Design::parse_in(&design.folder, &text, "the design found") {
        Ok(_) => Ok(text),
        Err(why) => Err(NoFile::Refused(why)),
    }
}

/// The new design file.
fn file_text(design: &Design, story: &Story, command: &str) -> Result<String, EditError> {
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
fn further_text(design: &Design, what: &str, text: &str) -> Result<String, EditError> {
    Ok(format!("{WRITTEN_BY} optimize {VERSION}: {what}\n{END}\n{}", body(design, text)?))
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
    fn a_design_that_would_be_refused_is_no_file_but_a_sentence() {
        let text = include_str!("../../../designs/huang2017-multi-arc.toml");
        let design = Design::parse(text, "a.toml").unwrap();
        assert_eq!(read_again(&design, text.to_owned()).unwrap(), text);
        let why = read_again(&design, text.replacen("count = 12 ", "count = 0 ", 1)).unwrap_err().to_string();
        assert!(why.starts_with("not written") && why.contains("sprags.count"), "{why}");
    }

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
