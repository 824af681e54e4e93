//! Writes new values into the text of a design file and keeps its comments and its order; what it says without them.
//!
//! In: text, variables or limits in the file's units. Out: text. Absent: checking the new design (parse
//! it). Equations: none. Numbers are written in the shortest form that reads back as the same double.

use toml_edit::{DocumentMut, Item, Table, Value};

use super::document::step_of;
use super::shape;
use super::variables::{variable_names, variable_path};
use crate::profile::Flanks;

/// Why a value cannot be written.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum EditError {
    /// The text is no TOML.
    #[error("the design is no TOML: {0}")]
    Syntax(String),
    /// No such variable or limit.
    #[error("no {name:?}; there are {}", .known.join(", "))]
    UnknownName {
        /// The name asked for.
        name: String,
        /// The names there are.
        known: Vec<String>,
    },
    /// The file does not hold the key that the variable sets.
    #[error("the design holds no {key}")]
    MissingKey {
        /// Dotted path of the key.
        key: String,
    },
    /// The value is not finite.
    #[error("the value of {name} is not a finite number")]
    NotFinite {
        /// The name it was meant for.
        name: String,
    },
}

/// The text with design variables set, each in the unit of its name ([`VARIABLES`](super::VARIABLES)).
///
/// # Errors
/// [`EditError`]; nothing is written where one value cannot be.
pub fn with_values(source: &str, values: &[(&str, f64)]) -> Result<String, EditError> {
    let mut document = parse(source)?;
    let arcs = arcs(&document);
    for &(name, value) in values {
        let path = variable_path(name, arcs)
            .ok_or_else(|| EditError::UnknownName { name: name.to_owned(), known: variable_names(arcs) })?;
        put(&mut document, name, &path, value)?;
    }
    Ok(document.to_string())
}

/// How many inner arcs the text has.
pub(super) fn arcs(document: &DocumentMut) -> usize {
    match document.get("sprags").and_then(|s| s.get("inner_arcs")) {
        Some(Item::Value(Value::Array(rows))) => rows.len(),
        Some(Item::ArrayOfTables(rows)) => rows.len(),
        _ => 0,
    }
}

/// Sets one key; a whole number where the schema wants one.
fn put(document: &mut DocumentMut, name: &str, path: &str, value: f64) -> Result<(), EditError> {
    let number = match shape::kind_of(path) {
        Some("integer") if value == value.round() && value.abs() < 9e15 => Value::from(value as i64),
        _ => finite(name, value)?,
    };
    let item = item_at(document, path).filter(|item| item.is_integer() || item.is_float());
    replace(item.ok_or_else(|| EditError::MissingKey { key: path.to_owned() })?, number);
    Ok(())
}

/// The text with flanks set, and without mass, inertia and centroid: these then follow from the outline.
///
/// # Errors
/// [`EditError`].
pub fn with_flanks(source: &str, flanks: &Flanks) -> Result<String, EditError> {
    let mut document = parse(source)?;
    let missing = || EditError::MissingKey { key: "sprags".to_owned() };
    let sprags = document.get_mut("sprags").and_then(Item::as_table_like_mut).ok_or_else(missing)?;
    for key in ["mass_kg", "inertia_kg_m2", "centroid", "flanks"] {
        sprags.remove(key);
    }
    let mut table = toml_edit::InlineTable::new();
    let mm = |m: f64| m * 1e3;
    for (key, value) in [
        ("rear_mm", mm(flanks.rear_m)),
        ("front_mm", mm(flanks.front_m)),
        ("rear_tilt_rad", flanks.rear_tilt_rad),
        ("front_tilt_rad", flanks.front_tilt_rad),
    ] {
        table.insert(key, finite(key, value)?);
    }
    sprags.insert("flanks", Item::Value(Value::InlineTable(table)));
    Ok(document.to_string())
}

/// The text with another sprag: r_e and e_1, m, inner arcs (radius m, end rad), flanks. Lengths to 0.01 um, angles to
/// 1e-6 rad. Mass, inertia and centroid then follow from the outline; a task for `optimize`, whose variables belong to the
/// sprag before, goes.
///
/// # Errors
/// [`EditError`].
pub fn with_sprag(
    source: &str,
    outer_radius_m: f64,
    centre_distance_m: f64,
    arcs: &[(f64, f64)],
    flanks: &Flanks,
) -> Result<String, EditError> {
    let mm = |m: f64| (m * 1e8).round() / 1e5;
    let rad = |angle: f64| (angle * 1e6).round() / 1e6;
    let round = |m: f64| mm(m) * 1e-3;
    let rounded = Flanks {
        rear_m: round(flanks.rear_m),
        front_m: round(flanks.front_m),
        rear_tilt_rad: rad(flanks.rear_tilt_rad),
        front_tilt_rad: rad(flanks.front_tilt_rad),
    };
    let mut document = parse(&with_flanks(source, &rounded)?)?;
    document.remove("optimize");
    let missing = || EditError::MissingKey { key: "sprags".to_owned() };
    let sprags = document.get_mut("sprags").and_then(Item::as_table_like_mut).ok_or_else(missing)?;
    let mut values =
        vec![("outer_radius_mm", mm(outer_radius_m)), ("centre_distance_mm", mm(centre_distance_m))];
    // b of (6) where the file has it.
    if sprags.contains_key("width_mm") {
        values.push(("width_mm", mm(flanks.rear_m + flanks.front_m)));
    }
    for (key, value) in values {
        sprags.insert(key, Item::Value(finite(key, value)?));
    }
    let mut rows = toml_edit::Array::new();
    for (radius_m, until_rad) in arcs {
        let mut row = toml_edit::InlineTable::new();
        row.insert("radius_mm", finite("radius_mm", mm(*radius_m))?);
        row.insert("until_rad", finite("until_rad", rad(*until_rad))?);
        rows.push(row);
    }
    sprags.insert("inner_arcs", Item::Value(Value::Array(rows)));
    sprags.remove("inner_spiral");
    Ok(document.to_string())
}

/// The text with a spiral from first contact on in place of the inner arcs, [`with_sprag`] before it: strut angle and end, rad; of a
/// logarithmic one its radius at first contact, m, and its rise. Angles to 1e-6 rad or 1e-5 deg.
///
/// # Errors
/// [`EditError`].
pub fn with_spiral(
    source: &str,
    strut_rad: f64,
    until_rad: f64,
    logarithmic: Option<(f64, f64)>,
) -> Result<String, EditError> {
    let mut document = parse(source)?;
    let missing = || EditError::MissingKey { key: "sprags".to_owned() };
    let sprags = document.get_mut("sprags").and_then(Item::as_table_like_mut).ok_or_else(missing)?;
    sprags.remove("inner_arcs");
    sprags.remove("centre_distance_mm");
    let round = |value: f64, to: f64| (value * to).round() / to;
    let mut spiral = toml_edit::InlineTable::new();
    if logarithmic.is_some() {
        spiral.insert("curve", "logarithmic".into());
    }
    let mut values = vec![("strut_angle_deg", round(strut_rad.to_degrees(), 1e5))];
    if let Some((radius_m, rise)) = logarithmic {
        values.extend([("start_radius_mm", round(radius_m * 1e3, 1e5)), ("rise", round(rise, 1e6))]);
    }
    values.push(("until_rad", round(until_rad, 1e6)));
    for (key, value) in values {
        spiral.insert(key, finite(key, value)?);
    }
    sprags.insert("inner_spiral", Item::Value(Value::InlineTable(spiral)));
    Ok(document.to_string())
}

/// The text with other variables of `[optimize]`: without those whose name `drop` picks, with `more` behind the others, each
/// with its bounds. Where there is no such table nothing changes.
///
/// # Errors
/// [`EditError`].
pub fn other_variables(
    source: &str,
    drop: &dyn Fn(&str) -> bool,
    more: &[(&str, (f64, f64))],
) -> Result<String, EditError> {
    let mut document = parse(source)?;
    let row = |name: &str, (min, max): (f64, f64)| -> Result<toml_edit::InlineTable, EditError> {
        let mut row = toml_edit::InlineTable::new();
        row.insert("name", Value::from(name));
        row.insert("min", finite(name, min)?);
        row.insert("max", finite(name, max)?);
        Ok(row)
    };
    match document.get_mut("optimize").and_then(|o| o.get_mut("variables")) {
        Some(Item::Value(Value::Array(rows))) => {
            let name = |row: &Value| {
                row.as_inline_table()
                    .and_then(|t| t.get("name")?.as_str().map(str::to_owned))
                    .unwrap_or_default()
            };
            // A line of its own, as far in as the first; no comment of another's.
            let lead = rows.iter().next().and_then(|first| first.decor().prefix()?.as_str());
            let lead = lead.map_or(" ", |text| &text[text.rfind('\n').unwrap_or(0)..]).to_owned();
            rows.retain(|row| !drop(&name(row)));
            for &(name, bounds) in more {
                let mut value = Value::InlineTable(row(name, bounds)?);
                value.decor_mut().set_prefix(lead.as_str());
                rows.push_formatted(value);
            }
        }
        Some(Item::ArrayOfTables(rows)) => {
            rows.retain(|row| {
                let name = row.get("name").and_then(Item::as_str);
                !name.is_some_and(drop)
            });
            for &(name, bounds) in more {
                rows.push(row(name, bounds)?.into_table());
            }
        }
        _ => {}
    }
    Ok(document.to_string())
}

/// The text without the tables and keys at dotted paths; what is not there is not missed.
///
/// # Errors
/// [`EditError::Syntax`].
pub(super) fn without_keys(source: &str, paths: &[&str]) -> Result<String, EditError> {
    let mut document = parse(source)?;
    for path in paths {
        let (table, key) = path.rsplit_once('.').unwrap_or(("", path));
        let table =
            if table.is_empty() { Some(document.as_item_mut()) } else { item_at(&mut document, table) };
        if let Some(table) = table.and_then(Item::as_table_like_mut) {
            table.remove(key);
        }
    }
    Ok(document.to_string())
}

/// The text with the numbers at dotted paths set, such as `races.inner_radius_mm` or `sprags.count`, in the units of
/// their keys; keys of `[limits]` as [`with_limits`]. A key that is a whole number stays one.
///
/// # Errors
/// [`EditError`]; nothing is written where one value cannot be.
pub fn with_keys(source: &str, values: &[(&str, f64)]) -> Result<String, EditError> {
    let mut document = parse(source)?;
    let mut limits = Vec::new();
    for &(path, value) in values {
        if let Some(name) = path.strip_prefix("limits.") {
            limits.push((name, value));
            continue;
        }
        put(&mut document, path, path, value)?;
    }
    with_limits(&document.to_string(), &limits)
}

/// The number at a dotted path.
pub fn value_at(source: &str, path: &str) -> Option<f64> {
    let mut document = parse(source).ok()?;
    let item = item_at(&mut document, path)?;
    item.as_float().or_else(|| item.as_integer().map(|i| i as f64))
}

/// The text with keys of `[limits]` set, in the units of their names; keys that are new are added at the
/// table's end, the table at the file's end.
///
/// # Errors
/// [`EditError`]; nothing is written where one value cannot be.
pub fn with_limits(source: &str, limits: &[(&str, f64)]) -> Result<String, EditError> {
    let mut document = parse(source)?;
    let known = shape::keys_of("limits");
    for &(name, value) in limits {
        if !known.contains(&name) {
            let known = known.iter().map(|k| (*k).to_owned()).collect();
            return Err(EditError::UnknownName { name: name.to_owned(), known });
        }
        let number = finite(name, value)?;
        let table = document.entry("limits").or_insert_with(|| Item::Table(Table::new()));
        let table =
            table.as_table_like_mut().ok_or_else(|| EditError::MissingKey { key: "limits".to_owned() })?;
        match table.get_mut(name) {
            Some(item) => replace(item, number),
            None => {
                table.insert(name, Item::Value(number));
            }
        }
    }
    Ok(document.to_string())
}

/// What the text says without the tables `apart`: keys and values as TOML in one layout, no comments. Two texts that say
/// the same have the same content.
///
/// # Errors
/// [`EditError::Syntax`].
pub fn content(source: &str, apart: &[&str]) -> Result<String, EditError> {
    let syntax = |what: String| EditError::Syntax(what);
    let mut all: toml::Table = toml::from_str(source).map_err(|e| syntax(e.message().to_owned()))?;
    all.retain(|key, _| !apart.contains(&key));
    toml::to_string(&all).map_err(|e| syntax(e.to_string()))
}

/// What the text says without `[optimize]` and without the scenarios whose name `keep` does not pick: what an evaluation reads.
/// What names one of these in `[check]` goes as well.
///
/// # Errors
/// [`EditError::Syntax`].
pub(super) fn lean(source: &str, keep: &dyn Fn(&str) -> bool) -> Result<toml::Table, EditError> {
    let syntax = |what: String| EditError::Syntax(what);
    let mut all: toml::Table = toml::from_str(source).map_err(|e| syntax(e.message().to_owned()))?;
    all.remove("optimize");
    let kept = |name: Option<&toml::Value>| name.and_then(toml::Value::as_str).is_none_or(keep);
    if let Some(toml::Value::Array(scenarios)) = all.get_mut("scenarios") {
        scenarios.retain(|scenario| kept(scenario.get("name")));
    }
    let checked = all.get_mut("check").and_then(|check| check.get_mut("scenarios"));
    if let Some(toml::Value::Array(names)) = checked {
        names.retain(|name| kept(Some(name)));
    }
    Ok(all)
}

pub(super) fn parse(source: &str) -> Result<DocumentMut, EditError> {
    source.parse().map_err(|e: toml_edit::TomlError| EditError::Syntax(e.message().to_owned()))
}

/// A number as a value; of a zero without its sign.
fn finite(name: &str, value: f64) -> Result<Value, EditError> {
    if value.is_finite() {
        Ok(Value::from(value + 0.0))
    } else {
        Err(EditError::NotFinite { name: name.to_owned() })
    }
}

/// Put a value where one stands and keep the blanks and comments around it.
pub(super) fn replace(item: &mut Item, mut number: Value) {
    if let Some(old) = item.as_value() {
        *number.decor_mut() = old.decor().clone();
    }
    *item = Item::Value(number);
}

fn item_at<'d>(document: &'d mut DocumentMut, path: &str) -> Option<&'d mut Item> {
    let mut item = document.as_item_mut();
    for step in path.split('.') {
        let (name, row) = step_of(step)?;
        item = item.get_mut(name)?;
        if let Some(row) = row {
            item = item.get_mut(row)?;
        }
        // toml_edit answers an absent key with a new, empty item.
        if item.is_none() {
            return None;
        }
    }
    Some(item)
}
