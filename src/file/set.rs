//! Sets what a design file says at a dotted path, as somebody types it: `sprags.inner_arcs[1].radius_mm=4.1`.
//!
//! In: text, path, value as typed. Out: text with its comments kept. Absent: whether the new design is in order (parse it).
//! Equations: none.

use toml_edit::{Item, Table, Value};

use super::edit::{EditError, arcs, parse, replace};
use super::shape;
use super::variables::{variable_names, variable_path};
use crate::clutch::{LAWS, LawFacts};
use crate::design::nearest;

/// The text with `value` at `path`: a dotted path of the file, a row of an array by its number from 0 or by its `name`
/// (`scenarios[high-10].amplitude_nm`), or a variable's short name (`r_i2_mm`). A key that is not there is added, also its
/// table; a value that is no TOML is a text; an empty one removes the key. With a contact law goes what the new one does not read.
///
/// # Errors
/// [`EditError`].
pub fn with_setting(source: &str, path: &str, value: &str) -> Result<String, EditError> {
    let mut document = parse(source)?;
    let arcs = arcs(&document);
    let path = variable_path(path, arcs).unwrap_or_else(|| path.to_owned());
    refuse_unknown(&path, arcs, document.as_item())?;
    let typed = value.trim();
    let new = as_wanted(&path, typed.parse::<Value>().unwrap_or_else(|_| Value::from(typed)));
    let (before, last) = path.rsplit_once('.').map_or((None, path.as_str()), |(b, l)| (Some(b), l));
    let missing = || EditError::MissingKey { key: path.clone() };
    let mut item = document.as_item_mut();
    for step in before.into_iter().flat_map(|b| b.split('.')) {
        let rows = rows_beside(item, step);
        item = step_into(item, step).ok_or_else(|| match rows.is_empty() {
            true => missing(),
            false => EditError::UnknownName { name: path.clone(), known: renamed(&path, step, &rows) },
        })?;
    }
    if typed.is_empty() {
        item.as_table_like_mut().and_then(|table| table.remove(last)).ok_or_else(missing)?;
    } else {
        put(item, last, new).ok_or_else(missing)?;
    }
    if let (Some(law), Some(table)) = (law_of(&path, typed), item.as_table_like_mut()) {
        let read = [("roller_coefficient", law.reads_coefficient), ("stress_state", law.reads_stress_state)];
        read.into_iter().filter(|(_, read)| !read).for_each(|(key, _)| drop(table.remove(key)));
    }
    Ok(document.to_string())
}

/// 36.0 as 36 where a whole number is wanted.
fn as_wanted(path: &str, value: Value) -> Value {
    let whole = value.as_float().filter(|v| *v == v.round() && v.abs() < 9e15);
    match whole.filter(|_| shape::kind_of(path) == Some("integer")) {
        Some(whole) => Value::from(whole as i64),
        None => value,
    }
}

/// The contact law that is set, if it is that.
fn law_of(path: &str, typed: &str) -> Option<&'static LawFacts> {
    LAWS.iter().find(|law| path == "contact.law" && law.key == typed.trim_matches('"'))
}

/// Refuse a path that no design file has.
pub(super) fn refuse_unknown(path: &str, arcs: usize, document: &Item) -> Result<(), EditError> {
    if shape::is_known(path) {
        return Ok(());
    }
    let meant = in_scenes(path, document);
    if !meant.is_empty() {
        return Err(EditError::UnknownName { name: path.to_owned(), known: meant });
    }
    // The keys beside it, of the deepest table that is there.
    let mut table = path;
    while let Some((before, _)) = table.rsplit_once('.') {
        table = before;
        let keys = shape::keys_of(table);
        if !keys.is_empty() {
            let known = keys.iter().map(|key| format!("{table}.{key}")).collect();
            return Err(EditError::UnknownName { name: path.to_owned(), known });
        }
    }
    let mut known = variable_names(arcs);
    known.extend(shape::keys_of("").iter().map(|table| format!("{table}...")));
    Err(EditError::UnknownName { name: path.to_owned(), known })
}

/// What may be meant by a key of a scene without the scene, or with its name in another form (`scenarios.swing.frequency_hz`): the
/// path in each scene of the file that has the key.
fn in_scenes(path: &str, document: &Item) -> Vec<String> {
    let mut steps: Vec<&str> = path.split('.').collect();
    if steps.first() == Some(&"scenarios") {
        steps.remove(0);
    }
    let Some(key) = steps.pop() else { return Vec::new() };
    if !shape::keys_of("scenarios[0]").contains(&key) {
        return Vec::new();
    }
    let rows = document.get("scenarios").and_then(Item::as_array_of_tables);
    let rows = rows.into_iter().flatten().filter(|row| row.contains_key(key));
    let names: Vec<&str> = rows.filter_map(|row| row.get("name").and_then(Item::as_str)).collect();
    let meant = match steps[..] {
        [] => names,
        [scene] => nearest(scene, &names).into_iter().collect(),
        _ => Vec::new(),
    };
    meant.into_iter().map(|name| format!("scenarios[{name}].{key}")).collect()
}

/// The item that one step of a path names; a table that is absent is made.
fn step_into<'d>(item: &'d mut Item, step: &str) -> Option<&'d mut Item> {
    let (name, row) = match step.split_once('[') {
        Some((name, row)) => (name, Some(row.strip_suffix(']')?)),
        None => (step, None),
    };
    let table = item.as_table_like_mut()?;
    if row.is_none() && !table.contains_key(name) {
        table.insert(name, Item::Table(Table::new()));
    }
    let inner = table.get_mut(name)?;
    let Some(row) = row else { return Some(inner) };
    let at = match row.parse::<usize>() {
        Ok(at) => at,
        Err(_) => named_row(inner, row)?,
    };
    inner.get_mut(at)
}

/// What `step` may ask for where it asks for a row: each that has a name, `scenarios[swing]`.
fn rows_beside(item: &Item, step: &str) -> Vec<String> {
    let Some((name, _)) = step.split_once('[') else { return Vec::new() };
    let rows = item.get(name).and_then(Item::as_array_of_tables);
    let names = rows.into_iter().flatten().filter_map(|row| row.get("name").and_then(Item::as_str));
    names.map(|row| format!("{name}[{row}]")).collect()
}

/// `path` with each of `rows` in place of `step`.
fn renamed(path: &str, step: &str, rows: &[String]) -> Vec<String> {
    rows.iter().map(|row| path.replacen(step, row, 1)).collect()
}

/// Place of the row whose `name` is this.
pub(super) fn named_row(rows: &Item, name: &str) -> Option<usize> {
    let is = |row: Option<&str>| row == Some(name);
    match rows {
        Item::ArrayOfTables(rows) => rows.iter().position(|row| is(row.get("name").and_then(Item::as_str))),
        Item::Value(Value::Array(rows)) => {
            rows.iter().position(|row| is(row.as_inline_table().and_then(|t| t.get("name")?.as_str())))
        }
        _ => None,
    }
}

/// Whether the comment behind a value calls it a guess, as `new` does: another value is none.
fn is_guess(value: &Value) -> bool {
    let behind = value.decor().suffix().and_then(|suffix| suffix.as_str()).unwrap_or_default();
    behind.trim_start_matches([' ', '\t', '#']).starts_with("guess")
}

/// A value without what stands around it.
fn bare(value: &Value) -> String {
    value.clone().decorated("", "").to_string()
}

/// Put a value under a key of `item` and keep the blanks and comments around the one that stood there.
fn put(item: &mut Item, key: &str, mut new: Value) -> Option<()> {
    let (key, row) = match key.split_once('[') {
        Some((key, row)) => (key, Some(row.strip_suffix(']')?.parse::<usize>().ok()?)),
        None => (key, None),
    };
    let table = item.as_table_like_mut()?;
    match (table.get_mut(key), row) {
        (Some(rows), Some(row)) => {
            let old = rows.as_array_mut()?.get_mut(row)?;
            *new.decor_mut() = old.decor().clone();
            *old = new;
        }
        (None, Some(_)) => return None,
        (Some(old), None) if !old.is_none() => {
            // 6 in place of 6.5 is still a number with decimals.
            if let (Some(whole), true) = (new.as_integer(), old.is_float()) {
                new = Value::from(whole as f64);
            }
            let settled = old.as_value().is_some_and(|old| is_guess(old) && bare(old) != bare(&new));
            replace(old, new);
            if let (true, Some(new)) = (settled, old.as_value_mut()) {
                new.decor_mut().set_suffix("");
            }
        }
        (_, None) => {
            table.insert(key, Item::Value(new));
        }
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::Design;

    const DESIGN: &str = include_str!("../../designs/huang2017-multi-arc.toml");

    #[test]
    fn what_is_set_is_read_and_comments_stay() {
        let new = with_setting(DESIGN, "sprags.inner_arcs[1].radius_mm", "4.2").unwrap();
        let new = with_setting(&new, "r_i3_mm", "4.5").unwrap();
        let new = with_setting(&new, "scenarios[high-10].amplitude_nm", "9").unwrap();
        let new = with_setting(&new, "contact.law", "elastic").unwrap();
        let new = with_setting(&new, "name", "with a blank").unwrap();
        let design = Design::parse(&new, "new.toml").unwrap();
        let radius = |k: usize| format!("{:.9e}", design.clutch.sprags.inner_arcs[k].radius_m);
        assert_eq!((radius(1).as_str(), radius(2).as_str()), ("4.200000000e-3", "4.500000000e-3"));
        assert_eq!(design.name, "with a blank");
        // The coefficient that the new law does not read goes with its line.
        assert_eq!(new.lines().count(), DESIGN.lines().count() - 1);
        let comments =
            |text: &str| text.lines().filter(|l| l.contains('#') && !l.contains("roller_coeff")).count();
        assert_eq!(comments(&new), comments(DESIGN));
        let without = with_setting(&new, "limits.hoop_inner_mpa", "").unwrap();
        assert_eq!(Design::parse(&without, "new.toml").unwrap().limits.hoop_inner_pa, None);
    }

    #[test]
    fn a_whole_number_may_have_a_point() {
        assert_eq!(with_setting(DESIGN, "count", "11.0"), with_setting(DESIGN, "sprags.count", "11"));
        let half = with_setting(DESIGN, "count", "11.5").unwrap();
        let why = Design::parse(&half, "new.toml").unwrap_err().to_string();
        assert!(why.contains("11.5") && why.contains("whole number"), "{why}");
    }

    #[test]
    fn a_limit_that_is_not_there_is_added() {
        let new = with_setting(DESIGN, "limits.windup_nominal_deg", "2.5").unwrap();
        let design = Design::parse(&new, "new.toml").unwrap();
        assert_eq!(design.limits.windup_nominal_rad, Some(2.5_f64.to_radians()));
    }

    #[test]
    fn a_guess_that_was_settled_is_none() {
        let text = DESIGN.replace("width_mm = 6.0", "width_mm = 6.0  # guess: as another\n#");
        let path = "races.width_mm";
        assert!(with_setting(&text, path, "6.0").unwrap().contains("guess"));
        assert!(!with_setting(&text, path, "8.0").unwrap().contains("guess"));
    }

    #[test]
    fn a_scene_misspelt_before_a_key_is_meant_by_it() {
        for path in ["scenarios.hihg-10.amplitude_nm", "high10.amplitude_nm"] {
            let refused = with_setting(DESIGN, path, "1").unwrap_err().to_string();
            assert!(refused.contains("scenarios[high-10].amplitude_nm"), "{path}: {refused}");
        }
    }

    #[test]
    fn what_no_design_has_is_refused_with_what_there_is() {
        for path in [
            "sprags.cuont",
            "r_i9_mm",
            "nothing",
            "",
            "sprags..count",
            "limits.hertz",
            "scenarios[nobody].kind",
        ] {
            let refused = with_setting(DESIGN, path, "1").unwrap_err().to_string();
            assert!(refused.contains("there are") || refused.contains("holds no"), "{path}: {refused}");
        }
    }
}
