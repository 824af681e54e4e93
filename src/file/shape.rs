//! Holds a parsed file against the schema: every key known, present, of its type and in its range.
//!
//! In: the tree with places, the JSON Schema of [`super::design_file`]. Out: all problems at once, and the schema
//! itself for `schema`. Absent: rules that join keys. Equations: none.
//!
//! serde would stop at the first fault and knows no ranges; reading the rules from the schema keeps one
//! statement of each. Only what schemars makes of our structs is understood: type, const, enum, bounds,
//! properties, required, items, minItems, minLength.

use std::sync::LazyLock;

use schemars::transform::{RecursiveTransform, Transform};
use schemars::{Schema, generate::SchemaSettings};
use serde_json::Value;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::design_file::DesignFile;
use super::diagnostic::{MOST_COLLECTED, NO_SUCH_KEY, Problem, unprintable};
use super::document::{Document, number_of};
use crate::design::nearest;

/// No quantity of a clutch lies outside; keeps conversions to SI from overflow and underflow.
const MAGNITUDES: std::ops::RangeInclusive<f64> = 1e-30..=1e15;

static SCHEMA: LazyLock<Value> = LazyLock::new(|| {
    let settings = SchemaSettings::draft2020_12().with(|s| s.inline_subschemas = true);
    let mut schema = settings.into_generator().into_root_schema_for::<DesignFile>();
    // TOML has no null: an optional key is left out.
    RecursiveTransform(drop_null).transform(&mut schema);
    RecursiveTransform(list_names).transform(&mut schema);
    if let Some(object) = schema.as_object_mut() {
        object.insert("title".to_owned(), "sprag-design design file".into());
    }
    schema.to_value()
});

/// JSON Schema (draft 2020-12) of the design file; descriptions give unit and meaning of every key.
pub fn schema() -> Value {
    SCHEMA.clone()
}

fn drop_null(schema: &mut Schema) {
    if let Some(Value::Array(types)) = schema.get_mut("type") {
        types.retain(|t| t != "null");
        if let [one] = types.as_slice() {
            let one = one.clone();
            schema.insert("type".to_owned(), one);
        }
    }
    if schema.get("default").is_some_and(Value::is_null) {
        schema.remove("default");
    }
}

/// Of an enum whose variants are explained schemars makes one schema each; a key's own description explains them, so their
/// names are enough.
fn list_names(schema: &mut Schema) {
    let Some(Value::Array(variants)) = schema.get("oneOf") else { return };
    let names = variants.iter().map(|variant| variant.get("const").cloned()).collect::<Option<Vec<_>>>();
    if let Some(names) = names {
        schema.remove("oneOf");
        schema.insert("type".to_owned(), "string".into());
        schema.insert("enum".to_owned(), names.into());
    }
}

/// Strip `required` from a table and the tables in it.
pub(super) fn let_all_keys_be_absent(schema: &mut Schema) {
    schema.remove("required");
    schema.remove("default");
    if let Some(Value::Object(properties)) = schema.get_mut("properties") {
        for property in properties.values_mut() {
            if let Ok(property) = <&mut Schema>::try_from(property) {
                let_all_keys_be_absent(property);
            }
        }
    }
}

/// The JSON Schema of the key at a dotted path; what stands in brackets, the row of an array, is any.
pub fn shape_of(path: &str) -> Option<&'static Value> {
    path.split('.').filter(|_| !path.is_empty()).try_fold(&*SCHEMA, |schema, step| {
        let name = step.split('[').next()?;
        let rows = step.matches('[').count();
        (0..rows).try_fold(schema.get("properties")?.get(name)?, |s, _| s.get("items"))
    })
}

/// Whether a design file may hold something at a dotted path.
pub(super) fn is_known(path: &str) -> bool {
    !path.is_empty() && shape_of(path).is_some()
}

/// Dotted paths of two steps whose last is `name`, or all but: `count` is `sprags.count`.
pub(super) fn paths_that_end_in(name: &str) -> Vec<String> {
    let last = name.rsplit('.').next().unwrap_or(name);
    let tables = keys_of("");
    let paths = || tables.iter().flat_map(|t| keys_of(t).into_iter().map(move |key| (*t, key)));
    let all: Vec<&str> = paths().map(|(_, key)| key).collect();
    let like = nearest(last, &all);
    paths().filter(|(_, key)| Some(*key) == like).map(|(table, key)| format!("{table}.{key}")).collect()
}

/// Dotted paths of all keys named `name`, rows of arrays as `[0]`; what a scene overrides, or a task sharpens, has its path in the
/// clutch's own table.
pub fn paths_of(name: &str) -> Vec<String> {
    fn walk(schema: &Value, path: &str, name: &str, found: &mut Vec<String>) {
        let properties = schema.get("properties").and_then(Value::as_object);
        for (key, property) in properties.into_iter().flatten() {
            let own =
                !path.is_empty() && SCHEMA.get("properties").is_some_and(|tables| tables.get(key).is_some());
            let here = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
            if key == name && !path.is_empty() {
                found.push(here.clone());
            }
            // `scenarios.sprags`, `optimize.limits`: tables of the clutch once more.
            if !own || !["scenarios", "optimize"].contains(&path.trim_end_matches("[0]")) {
                walk(property, &here, name, found);
            }
            if let Some(row) = property.get("items") {
                walk(row, &format!("{here}[0]"), name, found);
            }
        }
    }
    let mut found = Vec::new();
    walk(&SCHEMA, "", name, &mut found);
    found
}

/// "number" or "integer" where the key at a dotted path holds one.
pub(super) fn kind_of(path: &str) -> Option<&'static str> {
    let kind = shape_of(path)?.get("type").and_then(Value::as_str)?;
    ["number", "integer"].contains(&kind).then_some(kind)
}

/// Names of the keys of the table at a dotted path.
pub fn keys_of(path: &str) -> Vec<&'static str> {
    let properties = shape_of(path).and_then(|s| s.get("properties")).and_then(Value::as_object);
    properties.into_iter().flat_map(|p| p.keys().map(String::as_str)).collect()
}

/// What the key at a dotted path may hold, where `value` is outside of it.
pub(super) fn out_of_range(path: &str, value: f64) -> Option<String> {
    shape_of(path).filter(|s| !in_range(s, value)).map(|s| allowed_for(s, Some(value)))
}

/// What the key at a dotted path holds, in the schema's words.
pub(super) fn meaning_of(path: &str) -> String {
    shape_of(path).map(|s| format!("{}: {}", allowed(s), description(s))).unwrap_or_default()
}

/// All departures of the file from the schema.
pub(super) fn problems(doc: &Document<'_>) -> Vec<Problem> {
    let mut walk = Walk { doc, problems: Vec::new() };
    walk.table(&SCHEMA, &doc.root, "", 0..0);
    walk.problems
}

struct Walk<'d, 'a> {
    doc: &'d Document<'a>,
    problems: Vec<Problem>,
}

impl<'a> Walk<'_, 'a> {
    fn refuse(
        &mut self,
        key: &str,
        span: std::ops::Range<usize>,
        found: String,
        allowed: String,
        help: String,
    ) {
        // A file that is all faults is told of the first.
        if self.problems.len() >= MOST_COLLECTED {
            return;
        }
        let place = Some(self.doc.place(span));
        self.problems.push(Problem { key: key.to_owned(), place, found, allowed, help, also: Vec::new() });
    }

    fn table(&mut self, schema: &Value, table: &DeTable<'a>, path: &str, header: std::ops::Range<usize>) {
        let Some(properties) = schema.get("properties").and_then(Value::as_object) else { return };
        let dotted = |name: &str| if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") };
        for (key, value) in table.iter() {
            if self.problems.len() >= MOST_COLLECTED {
                return;
            }
            let name = key.get_ref().as_ref();
            if let Some(property) = properties.get(name) {
                self.value(property, value, &dotted(name), key.span());
            } else {
                let known: Vec<&str> = properties.keys().map(String::as_str).collect();
                let found = format!("the unknown key {name:?}");
                self.refuse(
                    &dotted(name),
                    key.span(),
                    found,
                    known.join(", "),
                    help_for_unknown(name, &known),
                );
            }
        }
        for name in
            schema.get("required").and_then(Value::as_array).into_iter().flatten().filter_map(Value::as_str)
        {
            if !table.contains_key(name) {
                let property = properties.get(name).unwrap_or(&Value::Null);
                let is_table = property.get("properties").is_some();
                let place = if path.is_empty() { "the file".to_owned() } else { format!("[{path}]") };
                let help = if is_table && path.is_empty() {
                    format!("add the table [{name}]")
                } else {
                    format!("add {name} = ... to {place}")
                };
                let what = format!("{}: {}", allowed(property), description(property));
                self.refuse(&dotted(name), header.clone(), NO_SUCH_KEY.to_owned(), what, help);
            }
        }
    }

    fn value(
        &mut self,
        schema: &Value,
        value: &Spanned<DeValue<'a>>,
        path: &str,
        key_span: std::ops::Range<usize>,
    ) {
        let kind = schema.get("type").and_then(Value::as_str);
        let number = kind.filter(|kind| ["number", "integer"].contains(kind));
        let fits = match (kind, value.get_ref()) {
            (Some("object"), DeValue::Table(table)) => return self.table(schema, table, path, key_span),
            (Some("array"), DeValue::Array(rows)) => {
                let items = schema.get("items").unwrap_or(&Value::Null);
                for (i, row) in rows.iter().enumerate() {
                    self.value(items, row, &format!("{path}[{i}]"), row.span());
                }
                rows.len() as f64 >= bound(schema, "minItems").unwrap_or(0.0)
            }
            (Some("string"), DeValue::String(s)) => {
                let listed = schema.get("enum").and_then(Value::as_array);
                let constant = schema.get("const").and_then(Value::as_str);
                listed.is_none_or(|l| l.iter().any(|v| v.as_str() == Some(s.as_ref())))
                    && constant.is_none_or(|c| c == s.as_ref())
                    && !s.chars().any(unprintable)
                    && s.trim().chars().count() as f64 >= bound(schema, "minLength").unwrap_or(0.0)
            }
            (Some("boolean"), DeValue::Boolean(_)) => true,
            (Some("number"), v @ (DeValue::Float(_) | DeValue::Integer(_))) => {
                number_of(v).is_some_and(|x| in_range(schema, x))
            }
            // serde reads an i64; what does not fit is out of range for every key.
            (Some("integer"), v @ DeValue::Integer(_)) => {
                number_of(v).is_some_and(|x| x.abs() < 9e18 && in_range(schema, x))
            }
            _ => false,
        };
        if fits {
            return;
        }
        let is_table = matches!(value.get_ref(), DeValue::Table(_) | DeValue::Array(_));
        let span = if is_table { key_span } else { value.span() };
        let allowed = match value.get_ref() {
            v @ (DeValue::Float(_) | DeValue::Integer(_)) => allowed_for(schema, number_of(v)),
            DeValue::String(s) if s.chars().any(unprintable) => {
                format!("{} and without line breaks or other control characters", allowed(schema))
            }
            _ => allowed(schema),
        };
        let name = path.rsplit('.').next().unwrap_or(path);
        let meant = match value.get_ref() {
            DeValue::String(s) if number.is_some() => number_in(s),
            _ => None,
        };
        let help = match (meant, description(schema)) {
            (Some(meant), _) => {
                format!("write {name} = {meant}: a number with a point, its unit is in the key's name")
            }
            (None, "") => format!("give {name} {allowed}"),
            (None, what) => format!("give {name} {allowed} ({what})"),
        };
        let found = match value.get_ref() {
            DeValue::Array(rows) if rows.is_empty() => "an empty array".to_owned(),
            _ => self.doc.text_of(value),
        };
        self.refuse(path, span, found, allowed, help);
    }
}

/// The number that a text with a comma for a point, or with its unit behind it, stands for.
fn number_in(text: &str) -> Option<f64> {
    let text = text.trim().replacen(',', ".", 1);
    let number = text.trim_end_matches(|c: char| c.is_alphabetic() || "%µ° ".contains(c));
    number.parse().ok().filter(|x: &f64| x.is_finite())
}

fn help_for_unknown(name: &str, known: &[&str]) -> String {
    match nearest(name, known) {
        Some(key) => format!("did you mean {key}? Otherwise remove {name}"),
        None => format!("remove {name} or move it to the table where it belongs"),
    }
}

fn bound(schema: &Value, name: &str) -> Option<f64> {
    schema.get(name).and_then(Value::as_f64)
}

fn in_range(schema: &Value, x: f64) -> bool {
    // Written so that a NaN is outside.
    (x == 0.0 || MAGNITUDES.contains(&x.abs()))
        && bound(schema, "const").is_none_or(|b| x == b)
        && bound(schema, "minimum").is_none_or(|b| x >= b)
        && bound(schema, "exclusiveMinimum").is_none_or(|b| x > b)
        && bound(schema, "maximum").is_none_or(|b| x <= b)
        && bound(schema, "exclusiveMaximum").is_none_or(|b| x < b)
}

/// What a schema allows instead of the number `x`, in words: with the magnitudes where these are what turns it away.
fn allowed_for(schema: &Value, x: Option<f64>) -> String {
    let too_far = |x: f64| x != 0.0 && x.is_finite() && !MAGNITUDES.contains(&x.abs());
    match x {
        Some(x) if too_far(x) => {
            let (least, most) = (MAGNITUDES.start(), MAGNITUDES.end());
            let zero = if in_range(schema, 0.0) { "0 or " } else { "" };
            format!("{}, {zero}of a magnitude from {least:e} to {most:e}", allowed(schema))
        }
        _ => allowed(schema),
    }
}

/// What a schema allows, in words.
pub fn allowed(schema: &Value) -> String {
    if let Some(c) = schema.get("const") {
        return c.to_string();
    }
    if let Some(options) = schema.get("enum").and_then(Value::as_array) {
        return options.iter().map(Value::to_string).collect::<Vec<_>>().join(" or ");
    }
    let kind = match schema.get("type").and_then(Value::as_str) {
        Some("object") => "a table",
        Some("array") if bound(schema, "minItems").is_some() => "an array with at least one entry",
        Some("array") => "an array",
        Some("string") if bound(schema, "minLength").is_some() => "a text that is not empty",
        Some("string") => "a text in quotes",
        Some("integer") => "a whole number",
        Some("boolean") => "true or false",
        _ => "a finite number",
    };
    let bounds = [
        ("exclusiveMinimum", "above"),
        ("minimum", "of at least"),
        ("exclusiveMaximum", "below"),
        ("maximum", "at most"),
    ];
    let words: Vec<String> =
        bounds.iter().filter_map(|(k, w)| bound(schema, k).map(|b| format!("{w} {b}"))).collect();
    if words.is_empty() { kind.to_owned() } else { format!("{kind} {}", words.join(" and ")) }
}

fn description(schema: &Value) -> &str {
    schema.get("description").and_then(Value::as_str).unwrap_or("").trim_end_matches('.')
}
