//! A parsed design file that knows where every key stands.
//!
//! In: TOML text. Out: values and places by dotted path, and problems that point at them. Absent: what keys
//! mean. Equations: none.

use std::ops::Range;

use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::diagnostic::{MOST_COLLECTED, Problem, TextPlace};

/// Text and tree of a design file.
pub(super) struct Document<'a> {
    pub source: &'a str,
    pub root: DeTable<'a>,
}

/// What a path leads to.
pub(super) struct Entry<'d, 'a> {
    /// The key, or the row of an array.
    pub key_span: Range<usize>,
    pub value: &'d Spanned<DeValue<'a>>,
}

impl<'a> Document<'a> {
    /// Parse; the first syntax error of every line at once.
    pub fn parse(source: &'a str) -> Result<Self, Vec<Problem>> {
        let (root, errors) = DeTable::parse_recoverable(source);
        if errors.is_empty() {
            return Ok(Self { source, root: root.into_inner() });
        }
        // Behind a bracket that is not closed everything is a fault.
        let sound = errors.iter().position(is_left_open).map_or(errors.len(), |open| open + 1);
        let first = errors[..sound].iter().take(MOST_COLLECTED);
        let mut problems: Vec<Problem> = first.map(|e| syntax_problem(source, e)).collect();
        // What follows the first fault of a line is mostly its echo.
        problems.dedup_by_key(|p| p.place.as_ref().map(|place| place.line));
        Err(problems)
    }

    /// Its values without their places.
    pub fn table(&self) -> Result<toml::Table, toml::de::Error> {
        let whole = Spanned::new(0..self.source.len(), self.root.clone());
        toml::Table::deserialize(toml::Deserializer::from(whole))
    }

    /// The entry at a dotted path, `scenarios[2].friction.static`.
    pub fn entry(&self, path: &str) -> Option<Entry<'_, 'a>> {
        let mut entry: Option<Entry<'_, 'a>> = None;
        for step in path.split('.') {
            let (name, rows) = step.split_once('[').map_or((step, ""), |(n, r)| (n, r));
            let table = match &entry {
                None => &self.root,
                Some(e) => e.value.get_ref().as_table()?,
            };
            let (key, value) = table.get_key_value(name)?;
            let mut found = Entry { key_span: key.span(), value };
            for row in rows.split('[').filter(|r| !r.is_empty()) {
                let index: usize = row.strip_suffix(']')?.parse().ok()?;
                let value = found.value.get_ref().as_array()?.get(index)?;
                found = Entry { key_span: value.span(), value };
            }
            entry = Some(found);
        }
        entry
    }

    /// A value as the file prints it, tables and long texts named instead.
    pub fn text_of(&self, value: &Spanned<DeValue<'a>>) -> String {
        match value.get_ref() {
            DeValue::Table(_) => "a table".to_owned(),
            DeValue::Array(_) => "an array".to_owned(),
            DeValue::String(s) => format!("the string {:?}", shortened(s)),
            _ => shortened(self.source.get(value.span()).unwrap_or("?")),
        }
    }

    /// The place of a byte range.
    pub fn place(&self, span: Range<usize>) -> TextPlace {
        TextPlace::of(self.source, span)
    }

    /// Where a reader looks for the key at `path`: its value; the header for a table; for a key that is
    /// absent, the nearest table above it that is there.
    pub fn place_of(&self, path: &str) -> TextPlace {
        let mut path = path;
        loop {
            if let Some(entry) = self.entry(path) {
                let whole = matches!(entry.value.get_ref(), DeValue::Table(_) | DeValue::Array(_));
                return self.place(if whole { entry.key_span } else { entry.value.span() });
            }
            match path.rfind(['.', '[']) {
                Some(i) => path = &path[..i],
                None => return self.place(0..0),
            }
        }
    }
}

/// Name and row, from 0, of one step of a dotted path, such as `inner_arcs[1]`.
pub(super) fn step_of(step: &str) -> Option<(&str, Option<usize>)> {
    match step.split_once('[') {
        Some((name, row)) => Some((name, Some(row.strip_suffix(']')?.parse().ok()?))),
        None => Some((step, None)),
    }
}

/// The value of a table at a dotted path.
pub(super) fn value_at<'t>(table: &'t toml::Table, path: &str) -> Option<&'t toml::Value> {
    let mut steps = path.split('.').map(step_of);
    let (name, row) = steps.next()??;
    let within = |value: &'t toml::Value, row: Option<usize>| row.map_or(Some(value), |row| value.get(row));
    steps.try_fold(within(table.get(name)?, row)?, |value, step| {
        let (name, row) = step?;
        within(value.get(name)?, row)
    })
}

/// The same to be changed.
pub(super) fn value_at_mut<'t>(table: &'t mut toml::Table, path: &str) -> Option<&'t mut toml::Value> {
    let mut steps = path.split('.').map(step_of);
    let (name, row) = steps.next()??;
    let within = |value: &'t mut toml::Value, row: Option<usize>| match row {
        Some(row) => value.get_mut(row),
        None => Some(value),
    };
    steps.try_fold(within(table.get_mut(name)?, row)?, |value, step| {
        let (name, row) = step?;
        within(value.get_mut(name)?, row)
    })
}

/// The number that a TOML value is, integers included.
pub(super) fn number_of(value: &DeValue<'_>) -> Option<f64> {
    match value {
        DeValue::Float(f) => f.as_str().parse().ok(),
        DeValue::Integer(i) => match i.radix() {
            10 => i.as_str().parse().ok(),
            radix => i64::from_str_radix(i.as_str(), radix).ok().map(|i| i as f64),
        },
        _ => None,
    }
}

fn shortened(text: &str) -> String {
    let mut chars = text.chars();
    let start: String = chars.by_ref().take(60).collect();
    if chars.next().is_some() { format!("{start}...") } else { start }
}

/// Whether an inline table or an array goes on where it should have ended.
fn is_left_open(error: &toml::de::Error) -> bool {
    ["inline table", "array element", "between key-value pairs"].iter().any(|s| error.message().contains(s))
}

fn syntax_problem(source: &str, error: &toml::de::Error) -> Problem {
    let place = TextPlace::of(source, error.span().unwrap_or(0..0));
    let (what, expected) = error.message().split_once(", expected ").unwrap_or((error.message(), ""));
    let key = key_on_line(source, place.span.start);
    let text = source[place.span.clone()].trim();
    let found = if text.is_empty() { what.to_owned() } else { format!("{what} at {:?}", shortened(text)) };
    // The parser takes a bare word for a misspelt boolean or a text, and then expects only that.
    let allowed = match expected {
        "" => "TOML",
        _ if what.contains("boolean") || what.contains("quoted") => {
            "a number, a text in quotes, true, false, [an array] or { a table }"
        }
        expected => expected,
    };
    let help = if what.contains("duplicate") {
        "keep one of the two: a key may stand only once in a table".to_owned()
    } else if let Some(comma) = decimal_comma(source.lines().nth(place.line.saturating_sub(1)).unwrap_or(""))
    {
        format!("write the number with a point: {}, not {comma}", comma.replace(',', "."))
    } else if is_left_open(error) {
        format!(
            "close what is open before line {}, column {}: a }} for each {{, a ] for each [",
            place.line, place.column
        )
    } else {
        format!(
            "write line {} as TOML: key = value, text in \"quotes\", a table's name in [brackets]",
            place.line
        )
    };
    Problem {
        key,
        place: Some(place),
        found: found.to_owned(),
        allowed: allowed.to_owned(),
        help,
        also: Vec::new(),
    }
}

/// The number that a line gives a key with a comma between its digits.
fn decimal_comma(line: &str) -> Option<&str> {
    let (_, value) = line.split_once('=')?;
    let value = value.split('#').next().unwrap_or(value).trim();
    let digits = |s: &str| !s.is_empty() && s.chars().all(|c| c.is_ascii_digit());
    value.split_once(',').filter(|(a, b)| digits(a.trim_start_matches('-')) && digits(b)).map(|_| value)
}

/// The key that a reader sees at `at`, read from the text because there is no tree: last header, then what
/// stands before `=`.
fn key_on_line(source: &str, at: usize) -> String {
    let start = source[..at].rfind('\n').map_or(0, |i| i + 1);
    let bare = |s: &str| !s.is_empty() && s.chars().all(|c| c.is_ascii_alphanumeric() || "_-.".contains(c));
    let line = source[start..].lines().next().unwrap_or("");
    let key = line.split_once('=').map(|(k, _)| k.trim()).filter(|k| bare(k));
    let header = source[..start]
        .lines()
        .rev()
        .find_map(|l| l.split('#').next()?.trim().strip_prefix('[')?.strip_suffix(']'))
        .map(|h| h.trim_matches(['[', ']']).trim())
        .filter(|h| bare(h));
    match (header, key) {
        (Some(h), Some(k)) => format!("{h}.{k}"),
        (None, Some(k)) => k.to_owned(),
        (_, None) => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_lead_into_tables_inline_tables_and_rows() {
        let text = "a.b = 0x10\n[[rows]]\nx = 1\n[[rows]]\nx = { y = [1, 2.5] }\n";
        let doc = Document::parse(text).unwrap_or_else(|p| panic!("{p:?}"));
        let table = doc.table().unwrap();
        assert_eq!(value_at(&table, "a.b").and_then(toml::Value::as_integer), Some(16));
        assert_eq!(value_at(&table, "rows[1].x.y[1]").and_then(toml::Value::as_float), Some(2.5));
        assert_eq!(doc.place_of("rows[1].x.y[1]").line, 5);
        assert_eq!(doc.place_of("rows[1].missing.key").line, 4, "the row's header");
        for none in ["", "rows[2]", "rows[x]", "rows[0", "a.b.c", "rows.x", "a[0]"] {
            assert!(doc.entry(none).is_none(), "{none}");
        }
    }

    #[test]
    fn a_syntax_error_names_the_key_on_its_line() {
        let problems = Document::parse("[sprags] # shape\ncount = twelve\n").err().unwrap_or_default();
        assert_eq!(problems[0].key, "sprags.count");
        assert_eq!(problems[0].place.as_ref().map(|p| p.line), Some(2));
    }

    #[test]
    fn what_follows_an_open_bracket_is_no_fault_of_its_own() {
        for (text, line) in [("a = [{ x = 1 ]\nb = 2\n[c]\nd = 3\n", 1), ("a = [1, 2\nb = 3\nc = 4\n", 2)] {
            let problems = Document::parse(text).err().unwrap_or_default();
            assert_eq!(problems.len(), 1, "{problems:?}");
            assert_eq!(problems[0].place.as_ref().map(|p| p.line), Some(line));
            assert!(problems[0].help.starts_with("close what is open"), "{problems:?}");
        }
    }
}
