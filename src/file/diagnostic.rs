//! Why a design file is refused, said so that it can be mended.
//!
//! In: places in the text and words. Out: [`DesignError`], as plain text, as a `miette` diagnostic with the
//! lines of the file, or as JSON. Absent: rules, printing, exit codes (2, set by the command line).
//! Equations: none.

use std::fmt;
use std::ops::Range;

use miette::{Diagnostic, LabeledSpan, NamedSource, SourceCode};
use serde_json::{Value, json};

/// Whether a character may not go to a terminal or into a comment as it is: control characters, and marks that turn the
/// direction of writing, so that a text reads otherwise than it says.
pub fn unprintable(c: char) -> bool {
    c.is_control() || matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// A text as it may be shown on a terminal: what is [`unprintable`] as its escape, but line breaks and tabs.
pub fn shown(text: &str) -> String {
    let escaped = |c: char| match c {
        '\n' | '\t' => c.to_string(),
        c if unprintable(c) => c.escape_unicode().to_string(),
        c => c.to_string(),
    };
    text.chars().map(escaped).collect()
}

/// The same with as many bytes as before, so that places in it hold.
fn masked(text: &str) -> String {
    let mask = |c: char| match (c, c.len_utf8()) {
        ('\n' | '\t' | '\r', _) => c,
        (c, 1) if unprintable(c) => '?',
        (c, 2) if unprintable(c) => '\u{bf}',
        (c, _) if unprintable(c) => '\u{fffd}',
        (c, _) => c,
    };
    text.chars().map(mask).collect()
}

/// Most problems that are collected of one file, and most that are told in words.
pub(super) const MOST_COLLECTED: usize = 200;
const MOST_TOLD: usize = 20;
/// Longest line that is shown beside its problem, bytes.
const LONGEST_SHOWN: usize = 1000;

/// A place in a design file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TextPlace {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// Bytes in the file.
    pub span: Range<usize>,
}

impl TextPlace {
    /// The place of a byte range of `source`; a range that ends beyond it, or inside a character, is cut.
    pub(super) fn of(source: &str, span: Range<usize>) -> Self {
        let start = floor(source, span.start);
        let end = floor(source, span.end).max(start);
        let before = &source[..start];
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        let line = before.bytes().filter(|&b| b == b'\n').count() + 1;
        Self { line, column: before[line_start..].chars().count() + 1, span: start..end }
    }
}

fn floor(source: &str, at: usize) -> usize {
    (0..=at.min(source.len())).rev().find(|&i| source.is_char_boundary(i)).unwrap_or(0)
}

/// One thing wrong with a design file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Problem {
    /// Dotted path of the key, rows of arrays counted from 0: `sprags.inner_arcs[1].radius_mm`; empty where no key is at fault.
    pub key: String,
    /// Where; `None` where the file could not be read at all.
    pub place: Option<TextPlace>,
    /// What stands there.
    pub found: String,
    /// What may stand there.
    pub allowed: String,
    /// How to mend it.
    pub help: String,
    /// The other keys that take part, with their places.
    pub also: Vec<(String, TextPlace)>,
}

/// Paths count rows from 0, variables and plots the arcs from 1: behind `sprags.inner_arcs[0].radius_mm` the number of the arc
/// for people; nothing behind the path of another key.
fn arc_in_words(key: &str) -> String {
    let row = key.split_once("sprags.inner_arcs[").and_then(|(_, rest)| rest.split_once(']'));
    row.and_then(|(k, _)| k.parse::<usize>().ok())
        .map_or(String::new(), |k| format!(" (inner arc {})", k + 1))
}

/// What is found where a key is needed and absent.
pub(super) const NO_SUCH_KEY: &str = "no such key";

impl Problem {
    /// Name of a key that is needed and absent, where all that is to be said of it is to add it.
    fn absent(&self) -> Option<&str> {
        let name = self.key.rsplit('.').next()?;
        (self.found == NO_SUCH_KEY && self.help.starts_with(&format!("add {name} = ..."))).then_some(name)
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.key.is_empty() {
            write!(f, "{}{}: ", self.key, arc_in_words(&self.key))?;
        }
        if self.absent().is_some() {
            return write!(f, "{NO_SUCH_KEY}; {}: {}", self.help, self.allowed);
        }
        write!(f, "found {}; allowed: {}; to mend: {}", self.found, self.allowed, self.help)
    }
}

/// A refused design file with everything found wrong in it, in the order of the file.
///
/// Displays as one line per problem, `file:line:column: key: found ...; allowed: ...; to mend: ...`; of many the first 20,
/// and how many more there are. No more than the first 200 found are kept.
#[derive(Debug)]
pub struct DesignError {
    file: String,
    /// What was set in the file's text before it was looked at, in words behind its name; empty: nothing.
    set: String,
    source: Option<Box<NamedSource<String>>>,
    problems: Vec<Problem>,
}

impl DesignError {
    /// Problems of a text that could be read; an empty `source` is not shown beside them.
    pub(super) fn in_source(file: &str, source: &str, mut problems: Vec<Problem>) -> Self {
        problems.sort_by_key(|p| p.place.as_ref().map_or(0, |place| place.span.start));
        for p in &mut problems {
            for words in [&mut p.key, &mut p.found, &mut p.allowed, &mut p.help] {
                *words = shown(words);
            }
        }
        let file = shown(file);
        let short = !source.is_empty() && source.lines().all(|line| line.len() <= LONGEST_SHOWN);
        let source = short.then(|| Box::new(NamedSource::new(&file, masked(source)).with_language("TOML")));
        Self { file, set: String::new(), source, problems }
    }

    /// The same of a text that the file does not hold: with `settings` (path, value) set in it.
    pub(super) fn with_set(mut self, settings: &[(String, String)]) -> Self {
        let each: Vec<String> = settings.iter().map(|(key, value)| format!("{key}={value}")).collect();
        self.set = shown(&format!(" with {}", each.join(", ")));
        let name = format!("{}{}", self.file, self.set);
        self.source = self
            .source
            .map(|text| Box::new(NamedSource::new(name, text.inner().clone()).with_language("TOML")));
        self
    }

    /// A file that could not be read.
    pub(super) fn unreadable(file: &str, found: String, allowed: &str, help: &str) -> Self {
        let problem = Problem {
            key: String::new(),
            place: None,
            found,
            allowed: allowed.to_owned(),
            help: help.to_owned(),
            also: Vec::new(),
        };
        Self { file: shown(file), set: String::new(), source: None, problems: vec![problem] }
    }

    /// Name of the file.
    pub fn file(&self) -> &str {
        &self.file
    }

    /// What is wrong, at least one entry and at most 200, in the order of the file.
    pub fn problems(&self) -> &[Problem] {
        &self.problems
    }

    /// The same as JSON: `{"file", "problems": [{"key", "line", "column", "found", "allowed", "help",
    /// "also": [{"key", "line", "column"}]}]}`; line and column are null where the file could not be read.
    pub fn to_json(&self) -> Value {
        let problem = |p: &Problem| {
            let also: Vec<Value> = p
                .also
                .iter()
                .map(|(key, place)| json!({"key": key, "line": place.line, "column": place.column}))
                .collect();
            json!({
                "key": p.key,
                "line": p.place.as_ref().map(|place| place.line),
                "column": p.place.as_ref().map(|place| place.column),
                "found": p.found,
                "allowed": p.allowed,
                "help": p.help,
                "also": also,
            })
        };
        json!({"file": self.file, "problems": self.problems.iter().map(problem).collect::<Vec<_>>()})
    }
}

impl fmt::Display for DesignError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, problem) in self.problems.iter().take(MOST_TOLD).enumerate() {
            let line_break = if i == 0 { "" } else { "\n" };
            write!(f, "{line_break}{}{}:", self.file, self.set)?;
            if let Some(place) = &problem.place {
                write!(f, "{}:{}:", place.line, place.column)?;
            }
            write!(f, " {problem}")?;
        }
        match self.problems.len() {
            n if n >= MOST_COLLECTED => {
                write!(f, "\n{}: and {} more or still more", self.file, n - MOST_TOLD)
            }
            n if n > MOST_TOLD => write!(f, "\n{}: and {} more", self.file, n - MOST_TOLD),
            _ => Ok(()),
        }
    }
}

impl std::error::Error for DesignError {}

impl Diagnostic for DesignError {
    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.source.as_deref().map(|s| s as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        // Keys that are absent at one place are one label.
        let told = || self.problems.iter().take(MOST_TOLD);
        let mut absent: Vec<(Range<usize>, Vec<&str>)> = Vec::new();
        for (place, name) in told().filter_map(|p| Some((p.place.as_ref()?, p.absent()?))) {
            match absent.iter_mut().find(|(span, _)| *span == place.span) {
                Some((_, names)) => names.push(name),
                None => absent.push((place.span.clone(), vec![name])),
            }
        }
        let absent = absent.into_iter().map(|(span, names)| {
            LabeledSpan::new_primary_with_span(Some(format!("without {}", names.join(", "))), span)
        });
        let labels = told().filter(|p| p.absent().is_none()).flat_map(|p| {
            let first = p.place.iter().map(|place| {
                LabeledSpan::new_primary_with_span(
                    Some(format!("allowed: {}", p.allowed)),
                    place.span.clone(),
                )
            });
            let also = p
                .also
                .iter()
                .map(|(key, place)| LabeledSpan::new_with_span(Some(key.clone()), place.span.clone()));
            first.chain(also)
        });
        Some(Box::new(labels.chain(absent)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_arc_is_named_by_its_path_and_by_its_number() {
        let said = |key: &str| {
            let [found, allowed, help] = ["-1", "above 0", "give a length"].map(str::to_owned);
            Problem { key: key.to_owned(), place: None, found, allowed, help, also: Vec::new() }.to_string()
        };
        let arc = said("sprags.inner_arcs[1].radius_mm");
        assert!(arc.starts_with("sprags.inner_arcs[1].radius_mm (inner arc 2): found -1; allowed"), "{arc}");
        assert!(said("sprags.count").starts_with("sprags.count: found"));
    }

    #[test]
    fn columns_count_characters_and_spans_never_leave_the_text() {
        let text = "a = 1\nµ = \"é\" # x\n";
        let at = text.find('#').unwrap();
        let place = TextPlace::of(text, at..at + 1);
        assert_eq!((place.line, place.column), (2, 9));
        assert_eq!(TextPlace::of(text, 7..7).span, 6..6, "inside the µ");
        assert_eq!(TextPlace::of(text, 900..1000).span, text.len()..text.len());
        assert_eq!(TextPlace::of("", 0..5), TextPlace { line: 1, column: 1, span: 0..0 });
    }

    #[test]
    fn what_is_masked_keeps_its_length_and_what_is_shown_its_meaning() {
        let text = "a\u{1b}[31m\u{9b}\u{202e}\u{7f}\r\n\tb µ";
        assert_eq!(masked(text).len(), text.len());
        assert_eq!(masked(text), "a?[31m\u{bf}\u{fffd}?\r\n\tb µ");
        assert_eq!(shown(text), "a\\u{1b}[31m\\u{9b}\\u{202e}\\u{7f}\\u{d}\n\tb µ");
    }
}
