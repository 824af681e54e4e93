//! The design files that `optimize` writes: who wrote them, from what, then the file searched from with its comments, the
//! new values, and what these were.

use super::Context;
use super::output::{VERSION, folder_of};
use crate::design::{Design, EditError, with_history_names, with_notes};
use crate::optimise::Search;
use std::path::{Path, PathBuf};

/// First line of every design file that this command writes.
pub const WRITTEN_BY: &str = "# Written by sprag-design optimize";

/// The new design file, to lie at `path`.
///
/// # Errors
/// [`EditError`] where the text found is no design file.
pub fn file_text(
    design: &Design,
    found: &Search,
    path: &Path,
    context: &Context,
) -> Result<String, EditError> {
    let changes: String = found
        .variables
        .iter()
        .filter(|v| v.best != v.given)
        .map(|v| format!("#   {}: {} -> {}\n", v.name, v.given, v.best))
        .collect();
    let not_real = match found.wants_centroid() {
        true => "# The centroid was free and the mass given: no flanks that give them are in this file.\n",
        false => "",
    };
    let head = format!(
        "{WRITTEN_BY} {VERSION} from {:?} (sha256 {})\n# by: {}\n# {} {:.6} -> {:.6} {}\n{not_real}{changes}{END}\n",
        design.name,
        design.hash,
        context.command_line,
        found.aim.words(),
        found.objective.0,
        found.objective.1,
        found.aim.unit(),
    );
    Ok(head + &body(design, &found.file, path)?)
}

/// A further design file, to lie at `path`: `what` it is in a few words.
///
/// # Errors
/// As [`file_text`].
pub fn further_text(design: &Design, what: &str, text: &str, path: &Path) -> Result<String, EditError> {
    Ok(format!("{WRITTEN_BY} {VERSION}: {what}\n{END}\n{}", body(design, text, path)?))
}

/// Last line of a head.
const END: &str = "#";

/// `text` without the head of an earlier search, whose figures are not those of this file; with a note on each value that
/// is not that of `design`, and histories named from where `path` lies.
fn body(design: &Design, text: &str, path: &Path) -> Result<String, EditError> {
    let noted = with_notes(&design.source, without_head(text))?;
    let here = |folder: &Path| match folder.as_os_str().is_empty() {
        true => std::fs::canonicalize("."),
        false => std::fs::canonicalize(folder),
    };
    match (here(&design.folder), here(&folder_of(path))) {
        (Ok(from), Ok(to)) if from != to => with_history_names(&noted, &|name| moved(name, &from, &to)),
        _ => Ok(noted),
    }
}

/// The file that a design in `from` calls `name`, as one in `to` does, the shortest way; whole paths stay.
fn moved(name: &str, from: &Path, to: &Path) -> String {
    let there: PathBuf = from.join(name);
    let folder = there.parent().and_then(|folder| std::fs::canonicalize(folder).ok());
    let there = folder.zip(there.file_name()).map_or(there.clone(), |(folder, file)| folder.join(file));
    match Path::new(name).is_absolute() {
        true => name.to_owned(),
        false => pathdiff::diff_paths(&there, to).unwrap_or(there).display().to_string(),
    }
}

fn without_head(text: &str) -> &str {
    if !text.starts_with(WRITTEN_BY) {
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
        let head = format!("{WRITTEN_BY} 0.1.0 from \"x\"\n# by: y\n#   a: 1 -> 2\n#\n");
        assert_eq!(
            without_head(&format!("{head}# Why this file exists.\nschema = 1\n")),
            "# Why this file exists.\nschema = 1\n"
        );
        assert_eq!(without_head("# Why.\n#\nschema = 1\n"), "# Why.\n#\nschema = 1\n");
        for (end, rest) in [("", "# Why.\n#\nschema = 1\n"), ("#\n", "# Why.\n#\nschema = 1\n")] {
            assert_eq!(without_head(&format!("{WRITTEN_BY} 0.1.0: z\n{end}{rest}")), rest);
        }
    }

    #[test]
    fn a_history_is_named_from_the_new_place() {
        let (from, to) = (Path::new("/a/designs"), Path::new("/a/out/new"));
        assert_eq!(Path::new(&moved("t.csv", from, to)), Path::new("../../designs/t.csv"));
        assert_eq!(Path::new(&moved("../data/t.csv", from, to)), Path::new("../../designs/../data/t.csv"));
        assert_eq!(moved("/t.csv", from, to), "/t.csv");
    }
}
