//! Every value of a design file, one by one, as it stands there.
//!
//! In: the file's text. Out: [`Input`]. Absent: keys that the file leaves to their defaults; what a value means (`shape`).
//! Equations: none.

use super::variables::{unit_of_key, variable_unit};
use crate::design::LIMIT_KEYS;
use toml_edit::{DocumentMut, Item, TableLike, Value};

/// One value.
#[derive(Debug, Clone, PartialEq)]
pub struct Input {
    /// Dotted path as `--set` takes it; a row of an array by its `name`, else by its number from 0.
    pub path: String,
    /// Unit of the file, as printed; empty for a pure number, a text or a choice.
    pub unit: &'static str,
    /// As typed, a text without its quotes.
    pub text: String,
    /// Where it is a number.
    pub number: Option<f64>,
}

impl Input {
    /// Whether both say the same: numbers by their value, however they are typed, apart from roundings of 1e-12 of it.
    pub fn says_the_same(&self, other: &Self) -> bool {
        match (self.number, other.number) {
            (Some(a), Some(b)) => (a - b).abs() <= 1e-12 * a.abs().max(b.abs()),
            _ => self.text == other.text,
        }
    }
}

/// All of them, in the order of the file; none of a text that is no TOML.
pub fn inputs(source: &str) -> Vec<Input> {
    let mut out = Vec::new();
    if let Ok(document) = source.parse::<DocumentMut>() {
        table("", document.as_table(), &mut out);
    }
    out
}

/// Numbers from here on stand without the zero behind their point.
const LONG: f64 = 1e5;

/// Unit of the number at a dotted path, as printed; empty where it has none.
pub fn unit_of_path(path: &str) -> &'static str {
    let key = path.rsplit('.').next().unwrap_or(path);
    // Also of the sharper limits of [optimize].
    let limit = path.rsplit_once("limits.").and_then(|(_, key)| LIMIT_KEYS.iter().find(|l| l.name == key));
    let variable = || {
        let name = path.strip_prefix("optimize.variables[")?.split(']').next()?;
        variable_unit(name)
    };
    limit.map(|l| l.unit).or_else(|| unit_of_key(key)).or_else(variable).unwrap_or("")
}

fn table(path: &str, table: &dyn TableLike, out: &mut Vec<Input>) {
    for (key, inner) in table.iter() {
        let path = if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
        item(&path, inner, out);
    }
}

fn item(path: &str, item: &Item, out: &mut Vec<Input>) {
    match item {
        Item::Value(v) => value(path, v, out),
        Item::Table(t) => table(path, t, out),
        Item::ArrayOfTables(rows) => {
            for (i, row) in rows.iter().enumerate() {
                table(&row_path(path, i, row), row, out);
            }
        }
        Item::None => {}
    }
}

fn row_path(path: &str, i: usize, row: &dyn TableLike) -> String {
    let name = row.get("name").and_then(Item::as_str);
    format!("{path}[{}]", name.map_or_else(|| i.to_string(), str::to_owned))
}

fn value(path: &str, value: &Value, out: &mut Vec<Input>) {
    match value {
        Value::InlineTable(t) => table(path, t, out),
        Value::Array(rows) if rows.iter().any(Value::is_inline_table) => {
            for (i, row) in rows.iter().enumerate() {
                match row.as_inline_table() {
                    Some(t) => table(&row_path(path, i, t), t, out),
                    None => self::value(&format!("{path}[{i}]"), row, out),
                }
            }
        }
        other => {
            let number = other.as_float().or_else(|| other.as_integer().map(|i| i as f64));
            let bare = other.as_str().map(str::to_owned);
            let text = bare.unwrap_or_else(|| other.clone().decorated("", "").to_string());
            // A list of texts or numbers may stand on several lines.
            let mut text = text.split_whitespace().collect::<Vec<_>>().join(" ");
            // A long number is no easier to read for the zero behind its point.
            if number.is_some_and(|n| n.abs() >= LONG) && text.ends_with(".0") {
                text.truncate(text.len() - 2);
            }
            let unit = if other.is_str() || other.is_bool() { "" } else { unit_of_path(path) };
            out.push(Input { path: path.to_owned(), unit, text, number });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_numbers_stand_without_an_idle_zero() {
        let all =
            inputs("a = 200000000.0\nb = 2e8\nc = 600.0\nd = 9_990_000.0\ne = 100000.5\nf = \"9000000.0\"\n");
        let texts: Vec<&str> = all.iter().map(|i| i.text.as_str()).collect();
        assert_eq!(texts, ["200000000", "2e8", "600.0", "9_990_000", "100000.5", "9000000.0"]);
    }

    #[test]
    fn every_value_comes_once_with_its_unit() {
        let text = include_str!("../../designs/huang2017-multi-arc.toml");
        let all = inputs(text);
        let of = |path: &str| all.iter().filter(|i| i.path == path).collect::<Vec<_>>();
        for (path, text, unit) in [
            ("schema", "1", ""),
            ("sprags.count", "12", ""),
            ("sprags.mass_kg", "1.8e-3", "kg"),
            ("sprags.inner_arcs[1].radius_mm", "4.08", "mm"),
            ("sprags.centroid.x_mm", "0.1935", "mm"),
            ("limits.hertz_peak_mpa", "4600.0", "MPa"),
            ("contact.law", "roller", ""),
            ("scenarios[high-10].amplitude_nm", "10.0", "Nm"),
            ("optimize.limits.keep_contact_to_rpm", "6000", "rpm"),
            ("optimize.variables[r_i2_mm].max", "4.8", "mm"),
        ] {
            let found = of(path);
            assert!(found.len() == 1 && found[0].text == text && found[0].unit == unit, "{path}: {found:?}");
        }
        let mut paths: Vec<&str> = all.iter().map(|i| i.path.as_str()).collect();
        paths.sort_unstable();
        assert!(paths.windows(2).all(|w| w[0] != w[1]));
        fn leaves(value: &toml::Value) -> usize {
            match value {
                toml::Value::Table(t) => t.values().map(leaves).sum(),
                toml::Value::Array(rows) if rows.iter().any(toml::Value::is_table) => {
                    rows.iter().map(leaves).sum()
                }
                _ => 1,
            }
        }
        assert_eq!(all.len(), leaves(&toml::from_str(text).unwrap()));
    }

    #[test]
    fn numbers_are_compared_by_value() {
        let of = |text: &str| inputs(text).remove(0);
        assert!(of("a = 1.8e-3").says_the_same(&of("a = 0.0018")));
        assert!(of("a = 12").says_the_same(&of("a = 12.0")));
        assert!(of("a = 0.3").says_the_same(&of("a = 0.30000000000000004")));
        assert!(!of("a = 0.3").says_the_same(&of("a = 0.3000000001")));
        assert!(!of("a = \"b\"").says_the_same(&of("a = \"c\"")));
        assert!(inputs("no toml at all [").is_empty());
    }
}
