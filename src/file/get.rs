//! What a design file says at a dotted path, or under a variable's short name.
//!
//! In: text, path as [`with_setting`](super::with_setting) takes it. Out: the value. Absent: what is taken where the file says nothing.
//! Equations: none.

use super::edit::EditError;
use super::set::{named_row, refuse_unknown};
use super::variables::variable_path;
use toml_edit::{DocumentMut, Item};

/// Why there is no value.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum NoSetting {
    /// No design file has such a key.
    #[error("{0}")]
    Edit(EditError),
    /// This one has not.
    #[error("the design holds no {key}; it holds {}", .held.join(", "))]
    NotHeld {
        /// Dotted path of the key.
        key: String,
        /// What stands beside it.
        held: Vec<String>,
    },
}

/// The value at `path`: a dotted path of the file, a row of an array by its number from 0 or by its `name`
/// (`scenarios[high-10].amplitude_nm`), or a variable's short name (`r_i2_mm`).
///
/// # Errors
/// [`NoSetting`].
pub fn setting_at(source: &str, path: &str) -> Result<serde_json::Value, NoSetting> {
    let document = super::edit::parse(source).map_err(NoSetting::Edit)?;
    let arcs = super::edit::arcs(&document);
    let path = variable_path(path, arcs).unwrap_or_else(|| path.to_owned());
    refuse_unknown(&path, arcs, document.as_item()).map_err(NoSetting::Edit)?;
    let numbered = numbered(&document, &path)?;
    let table: toml::Table =
        toml::from_str(source).map_err(|e| NoSetting::Edit(EditError::Syntax(e.message().to_owned())))?;
    let value = super::document::value_at(&table, &numbered).and_then(|v| serde_json::to_value(v).ok());
    value.ok_or_else(|| NoSetting::NotHeld { key: path, held: Vec::new() })
}

/// The path with every row by its number.
fn numbered(document: &DocumentMut, path: &str) -> Result<String, NoSetting> {
    let mut item = document.as_item();
    let mut way = String::new();
    for step in path.split('.') {
        let dot = if way.is_empty() { "" } else { "." };
        let (name, row) = match step.split_once('[') {
            Some((name, row)) => (name, Some(row.trim_end_matches(']'))),
            None => (step, None),
        };
        let inner = item.get(name).filter(|inner| !inner.is_none());
        let Some(inner) = inner else {
            let keys = item.as_table_like().into_iter().flat_map(|table| table.iter());
            let held = keys.map(|(key, _)| format!("{way}{dot}{key}")).collect();
            return Err(NoSetting::NotHeld { key: path.to_owned(), held });
        };
        way = format!("{way}{dot}{name}");
        item = inner;
        let Some(row) = row else { continue };
        let at = row.parse::<usize>().ok().or_else(|| named_row(inner, row));
        match at.and_then(|at| Some((at, inner.get(at)?))) {
            Some((at, found)) => {
                way = format!("{way}[{at}]");
                item = found;
            }
            None => {
                let held = rows(inner).into_iter().map(|row| format!("{way}[{row}]")).collect();
                return Err(NoSetting::NotHeld { key: path.to_owned(), held });
            }
        }
    }
    Ok(way)
}

/// The rows of an array, by their names where they have some.
fn rows(item: &Item) -> Vec<String> {
    let name = |row: &Item| row.get("name").and_then(Item::as_str).map(str::to_owned);
    (0..).map_while(|i| item.get(i).map(|row| name(row).unwrap_or_else(|| i.to_string()))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const DESIGN: &str = include_str!("../../designs/huang2017-multi-arc.toml");

    #[test]
    fn what_the_file_says_is_found_by_short_name_by_path_and_by_row() {
        let at = |path: &str| setting_at(DESIGN, path).unwrap();
        assert_eq!(at("count"), at("sprags.count"));
        assert!(at("count").is_u64());
        assert_eq!(at("r_i2_mm"), at("sprags.inner_arcs[1].radius_mm"));
        assert_eq!(at("scenarios[high-10].name"), "high-10");
        assert!(
            at("scenarios[0]").is_object() && at("sprags.inner_arcs").is_array() && at("limits").is_object()
        );
    }

    #[test]
    fn what_is_not_there_is_told_with_what_is() {
        for (path, word) in [
            ("friction.statik", "friction.static"),
            ("r_i9_mm", "r_i2_mm"),
            ("", "there are"),
            ("limits.windup_nominal_deg", "it holds limits."),
            ("scenarios[nobody].name", "scenarios[high-10]"),
            ("sprags.inner_arcs[9].radius_mm", "sprags.inner_arcs[2]"),
            ("cage", "friction"),
        ] {
            let why = setting_at(DESIGN, path).unwrap_err().to_string();
            assert!(why.contains(word), "{path}: {why}");
        }
    }
}
