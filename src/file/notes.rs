//! Says behind each value of a design file that a program has changed what it was.
//!
//! In: the text before, the text after. Out: the text after with notes. Absent: who changes what (`edit`). Equations:
//! none. A note ends the line of its key, or of the row of an array whose rows have a line each; elsewhere within arrays and
//! inline tables no line has room for one, and it stands behind the whole. An earlier note there gives way; all other
//! comments stay.

use toml_edit::{Array, Item, RawString, Table, Value};

use super::edit::{EditError, parse};

/// How notes begin.
const MARKS: [&str; 2] = ["changed by optimize", "added by optimize"];

/// Numbers apart by less are the same: unit changes to SI and back round.
const SAME: f64 = 1e-12;

/// `new` with a note on every number that differs from that of `old`, and on every key that is new; the task in
/// `[optimize]` is not looked at.
///
/// # Errors
/// [`EditError::Syntax`].
pub fn with_notes(old: &str, new: &str) -> Result<String, EditError> {
    let old = parse(old)?;
    let mut document = parse(new)?;
    for (key, item) in document.iter_mut().filter(|(key, _)| *key != "optimize") {
        note_item(old.get(key.get()), item);
    }
    Ok(document.to_string())
}

fn note_item(old: Option<&Item>, item: &mut Item) {
    match item {
        Item::Value(value) => note_value(old, value),
        Item::Table(table) => note_table(old.and_then(Item::as_table), table),
        Item::ArrayOfTables(rows) => {
            let before = old.and_then(Item::as_array_of_tables);
            for (i, row) in rows.iter_mut().enumerate() {
                note_table(before.and_then(|rows| rows.get(i)), row);
            }
        }
        Item::None => {}
    }
}

fn note_table(old: Option<&Table>, table: &mut Table) {
    for (key, item) in table.iter_mut() {
        note_item(old.and_then(|table| table.get(key.get())), item);
    }
}

fn note_value(old: Option<&Item>, value: &mut Value) {
    let note = match old.and_then(Item::as_value) {
        None => Some(MARKS[1].to_owned()),
        Some(old) => {
            let mut list = Vec::new();
            match (old.as_array(), value.as_array_mut()) {
                (Some(old), Some(rows)) => note_rows(old, rows, &mut list),
                _ => differences("", old, value, &mut list),
            }
            words(&list)
        }
    };
    if let Some(note) = note {
        let suffix = value.decor().suffix().and_then(RawString::as_str).unwrap_or_default();
        let noted = with_note(suffix, &note);
        value.decor_mut().set_suffix(noted);
    }
}

/// Notes on the rows of an array that have a line each; the changes of the others go to `list`.
fn note_rows(old: &Array, rows: &mut Array, list: &mut Vec<(String, String)>) {
    for i in 0..rows.len() {
        let row = format!("row {}", i + 1);
        let mut of_row = Vec::new();
        match (old.get(i), rows.get(i)) {
            (Some(old), Some(new)) => differences("", old, new, &mut of_row),
            _ => of_row.push((String::new(), "none".to_owned())),
        }
        let Some(note) = words(&of_row) else { continue };
        // What follows the comma belongs to the next row, or to the array's end.
        let last = i + 1 == rows.len();
        let after = match last {
            true => Some(rows.trailing()).filter(|_| rows.trailing_comma()),
            false => rows.get(i + 1).and_then(|next| next.decor().prefix()),
        };
        let line = after.and_then(RawString::as_str).and_then(|text| text.split_once('\n'));
        match line.map(|(comment, rest)| format!("{}\n{rest}", with_note(comment, &note))) {
            Some(text) if last => rows.set_trailing(text),
            Some(text) => {
                if let Some(next) = rows.get_mut(i + 1) {
                    next.decor_mut().set_prefix(text);
                }
            }
            None => list.extend(of_row.into_iter().map(|(place, was)| (joined(&row, &place), was))),
        }
    }
}

/// A note on changes, of which one without a place is that of the value itself.
fn words(list: &[(String, String)]) -> Option<String> {
    let changed = MARKS[0];
    match list {
        [] => None,
        [(place, was)] if place.is_empty() => Some(format!("{changed} from {was}")),
        all => {
            let each: Vec<String> = all.iter().map(|(place, was)| format!("{place} from {was}")).collect();
            Some(format!("{changed}: {}", each.join(", ")))
        }
    }
}

/// What ends a line, blanks and perhaps a comment, with `note` in place of an earlier one.
fn with_note(end: &str, note: &str) -> String {
    let kept = MARKS.iter().find_map(|mark| end.split_once(mark)).map_or(end, |(before, _)| before);
    let kept = kept.trim_end_matches([' ', ';']);
    match kept.trim_matches([' ', '\t', '#']).is_empty() {
        true => format!("  # {note}"),
        false => format!("{kept}; {note}"),
    }
}

fn joined(place: &str, step: &str) -> String {
    format!("{place} {step}").trim().to_owned()
}

/// Place within the value and old text of each number that differs.
fn differences(place: &str, old: &Value, new: &Value, list: &mut Vec<(String, String)>) {
    let number = |v: &Value| v.as_float().or_else(|| v.as_integer().map(|i| i as f64));
    let within = |step: &str| joined(place, step);
    if let (Some(a), Some(b)) = (number(old), number(new)) {
        if (a - b).abs() > SAME * a.abs() {
            list.push((place.to_owned(), text(old)));
        }
        return;
    }
    if let (Some(old), Some(new)) = (old.as_array(), new.as_array()) {
        for (i, value) in new.iter().enumerate() {
            match old.get(i) {
                Some(before) => differences(&within(&format!("row {}", i + 1)), before, value, list),
                None => list.push((within(&format!("row {}", i + 1)), "none".to_owned())),
            }
        }
    }
    if let (Some(old), Some(new)) = (old.as_inline_table(), new.as_inline_table()) {
        for (key, value) in new.iter() {
            match old.get(key) {
                Some(before) => differences(&within(key), before, value, list),
                None => list.push((within(key), "none".to_owned())),
            }
        }
    }
}

/// A value without the blanks and comments around it.
fn text(value: &Value) -> String {
    value.clone().decorated("", "").to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    const OLD: &str = "\
a = 1.0          # assumed
b = 2
list = [         # arcs
  { r = 4.02, u = 0.06 },   # first
  { r = 4.08, u = 0.12 },
]
c = { x = 0.1, y = 0.5 }

[[rows]]
k = 1.5
[optimize]
min = 1.0
";

    #[test]
    fn each_change_is_noted_once_and_other_comments_stay() {
        let new = OLD
            .replace("a = 1.0", "a = 1.25")
            .replace("r = 4.08", "r = 3.6")
            .replace("x = 0.1", "x = -0.2")
            .replace("k = 1.5", "k = 1.5000000000000002\nd = 3.0")
            .replace("min = 1.0", "min = 2.0");
        let noted = with_notes(OLD, &new).unwrap();
        let wanted = new
            .replace("# assumed", "# assumed; changed by optimize from 1.0")
            .replace("u = 0.12 },", "u = 0.12 },  # changed by optimize: r from 4.08")
            .replace("y = 0.5 }", "y = 0.5 }  # changed by optimize: x from 0.1")
            .replace("d = 3.0", "d = 3.0  # added by optimize");
        assert_eq!(noted, wanted);
        // Rows on one line, and a row that is new.
        let (old, new) =
            ("list = [{ r = 1 }, { r = 2 }] # a\n", "list = [{ r = 1 }, { r = 3 }, { r = 4 }] # a\n");
        let noted_rows = with_notes(old, new).unwrap();
        assert!(
            noted_rows.ends_with("] # a; changed by optimize: row 2 r from 2, row 3 from none\n"),
            "{noted_rows}"
        );
        // Again: what moves once more gets a new note in place of the old one, what stays keeps it.
        let newer = noted.replace("a = 1.25", "a = 1.5");
        let again = with_notes(&noted, &newer).unwrap();
        assert_eq!(again, newer.replace("by optimize from 1.0", "by optimize from 1.25"));
        assert_eq!(with_notes(&again, &again).unwrap(), again);
    }
}
