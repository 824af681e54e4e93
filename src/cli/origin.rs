//! What a file is by its name, and whether this tool has written it: somebody else's file is not replaced in silence.

use crate::answer::WRITTEN_BY;
use crate::answer::sweep::SweepHead;
use crate::file::is_history;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// As much of a file as is looked at, bytes.
const HEAD: u64 = 65_536;
/// First word of what a drawing, a solid, a page or a deck says of itself, with its version behind.
const MARK: &str = "sprag-design ";

/// What is written into a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileKind {
    /// A table, CSV.
    Table,
    /// A journal, CSV: never replaced; whether it is one, and whose, says its own header when it is opened.
    Journal,
    /// A page.
    Page,
    /// A design file.
    Design,
    /// A finite-element deck.
    Deck,
    /// A drawing, DXF.
    Dxf,
    /// A drawing, SVG.
    Svg,
    /// A solid, STEP.
    Step,
    /// A co-simulation unit, FMU.
    Unit,
}

/// Kind, noun, endings, and whether this tool wrote a file that begins so.
type Facts = (FileKind, &'static str, &'static [&'static str], fn(&str) -> bool);

/// Of every kind. A journal has the ending of a table, which stands before it.
const KINDS: [Facts; 9] = [
    (FileKind::Table, "table", &["csv"], |head| {
        let ours = |line: &str| is_our_header(line) || SweepHead::begins(line);
        !is_history(head) && head.lines().next().is_some_and(ours)
    }),
    (FileKind::Journal, "journal", &["csv"], |_| true),
    (FileKind::Page, "page", &["html", "htm"], |head| line_is_ours(head, 0, "<!-- ")),
    (FileKind::Design, "design file", &["toml"], |head| {
        // What `new`, `size` and the studio write is gone on with by hand.
        let by = |command: &&str| head.strip_prefix(WRITTEN_BY).is_some_and(|rest| rest.starts_with(command));
        [" optimize ", " import ", " identify "].iter().any(by)
    }),
    (FileKind::Deck, "deck", &["inp"], |head| (0..8).any(|n| line_is_ours(head, n, "** "))),
    (FileKind::Dxf, "DXF drawing", &["dxf"], |head| line_is_ours(head, 1, "")),
    (FileKind::Svg, "SVG drawing", &["svg"], |head| line_is_ours(head, 1, "<desc>")),
    (FileKind::Step, "STEP solid", &["step", "stp"], |head| line_is_ours(head, 1, "/* ")),
    // Its description comes first, as it is.
    (FileKind::Unit, "co-simulation unit", &["fmu"], |head| {
        head.starts_with("PK") && head.contains("generationTool=\"sprag-design ")
    }),
];

/// Endings of files that this tool never writes.
const OTHERS: [&str; 10] = ["json", "pdf", "png", "jpg", "xls", "xlsx", "ods", "doc", "docx", "zip"];

impl FileKind {
    fn facts(self) -> &'static Facts {
        static ALL: [Facts; KINDS.len()] = KINDS;
        &ALL[self as usize]
    }

    /// The kind in one word.
    pub fn noun(self) -> &'static str {
        self.facts().1
    }

    /// Refuse a name whose ending says another kind of file; a page says by its ending that it is one, since programs open
    /// it by that.
    ///
    /// # Errors
    /// What is wrong with the name, in words.
    pub fn fits(self, path: &Path) -> Result<(), String> {
        let ending = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
        let own = self.facts().2;
        if own.contains(&&*ending) {
            return Ok(());
        }
        let noun = self.noun();
        let other = KINDS.iter().find(|(_, _, endings, _)| endings.contains(&&*ending));
        match other {
            Some((_, there, ..)) if path.exists() => {
                Err(format!("is a {there} already; a {noun} does not overwrite it"))
            }
            None if self != Self::Page && !OTHERS.contains(&&*ending) => Ok(()),
            _ => {
                let own = own.iter().map(|e| format!(".{e}")).collect::<Vec<_>>().join(" or ");
                Err(format!("a {noun} is written there; let its name end in {own}"))
            }
        }
    }

    /// Whether the file at `path` is of this kind and written by this tool, or empty.
    pub fn is_ours(self, path: &Path) -> bool {
        head_of(path).is_some_and(|head| head.is_empty() || self.wrote(&head))
    }

    /// Whether it is a design that this tool has begun and a person goes on with: of `new`, `size` or the studio.
    pub fn is_work(self, path: &Path) -> bool {
        self == Self::Design
            && head_of(path).is_some_and(|head| head.starts_with(WRITTEN_BY) && !self.wrote(&head))
    }

    fn wrote(self, head: &str) -> bool {
        (self.facts().3)(head)
    }
}

/// Whether line `n` of a file, from 0, is `before` and our mark.
fn line_is_ours(head: &str, n: usize, before: &str) -> bool {
    head.lines().nth(n).and_then(|line| line.strip_prefix(before)).is_some_and(|rest| rest.starts_with(MARK))
}

/// The beginning of a file; `None`: it cannot be read.
fn head_of(path: &Path) -> Option<String> {
    let mut head = Vec::new();
    File::open(path).ok()?.take(HEAD).read_to_end(&mut head).ok()?;
    Some(String::from_utf8_lossy(&head).into_owned())
}

/// Names of columns as this tool writes them: two or more, lower case, unit behind an underscore.
fn is_our_header(line: &str) -> bool {
    let ours = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || "_.[]".contains(c);
    line.contains(',') && line.split(',').all(|name| !name.is_empty() && name.chars().all(ours))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_we_wrote_is_known_by_its_first_lines() {
        for (kind, ours, theirs) in [
            (FileKind::Design, "# Written by sprag-design optimize 1\nschema = 1\n", "schema = 1\n"),
            (FileKind::Design, "# Written by sprag-design import 1\n", "# Written by sprag-design size 1\n"),
            (FileKind::Page, "<!-- sprag-design 1; -->\n", "<!DOCTYPE html>\n"),
            (FileKind::Deck, "** a\n** b\n** sprag-design design = 0\n", "*NODE\n"),
            (FileKind::Dxf, "999\nsprag-design 1; design 0\n", "  0\nSECTION\n  2\nHEADER\n"),
            (FileKind::Svg, "<svg>\n<desc>sprag-design 1</desc>\n", "<svg>\n<g/>\n"),
            (FileKind::Step, "ISO-10303-21;\n/* sprag-design 1 */\n", "ISO-10303-21;\nHEADER;\n"),
            (FileKind::Unit, "PK<a generationTool=\"sprag-design 1\">", "PK<a generationTool=\"other 1\">"),
            (FileKind::Table, "code,name,demand\n1,2,3\n", "Time [s];Torque\n"),
            (FileKind::Table, "label,races.inner_radius_mm,torque_nm\n", "time_s,torque_nm\n0,1\n"),
            (FileKind::Table, "model,design\n", "notes\n"),
            (FileKind::Table, "# sprag-design sweep 0.2.0; vectors; a\n", "# by hand\n"),
        ] {
            assert_eq!(kind.facts().0, kind);
            assert!(kind.wrote(ours) && !kind.wrote(theirs), "{kind:?}");
        }
    }

    #[test]
    fn a_name_says_what_may_be_written_there() {
        for (kind, name, fits) in [
            (FileKind::Page, "a.html", true),
            (FileKind::Page, "a.HTM", true),
            (FileKind::Page, "a.pdf", false),
            (FileKind::Page, "a", false),
            (FileKind::Page, "a.txt", false),
            (FileKind::Table, "a.csv", true),
            (FileKind::Table, "a.txt", true),
            (FileKind::Table, "a.toml.journal", true),
            (FileKind::Table, "a.json", false),
            (FileKind::Table, "a.html", false),
            (FileKind::Design, "a.toml", true),
            (FileKind::Design, "a.csv", false),
            (FileKind::Deck, "a", true),
            (FileKind::Deck, "a.pdf", false),
            (FileKind::Step, "a.STP", true),
            (FileKind::Unit, "a.fmu", true),
            (FileKind::Unit, "a.zip", false),
            (FileKind::Dxf, "a.svg", false),
        ] {
            assert_eq!(kind.fits(Path::new(name)).is_ok(), fits, "{kind:?} {name}");
        }
    }
}
