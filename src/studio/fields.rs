//! Every number of a design that the page lets one change: from the file and its schema.

use crate::design::Design;
use crate::file::{Input, inputs, shape_of, variable_path};
use crate::report::Unit;
use serde::Serialize;

/// One number or choice of the file.
#[derive(Debug, Clone, Serialize)]
pub struct Field {
    /// Dotted path, as `--set` takes it.
    pub path: String,
    /// Table that it stands in, such as `sprags` or `scenarios[high-10]`.
    pub group: String,
    /// The rest of the path.
    pub label: String,
    /// Unit as printed; empty for a pure number or a choice.
    pub unit: String,
    /// Value of a number, in the file's unit.
    pub value: Option<f64>,
    /// Ends of its slider: the bounds of `[optimize]` where it is a variable there, else a quarter to both sides, within what
    /// the file format allows, of an allowed gap from the gap at rest to three times what is allowed beside it. A 0 that is no variable has none of that: it goes to the size of the largest like number of the
    /// file, or to 1.
    pub range: Option<[f64; 2]>,
    /// Whether it takes whole numbers only.
    pub whole: bool,
    /// Text of a choice, and what may be chosen.
    pub choice: Option<(String, Vec<String>)>,
    /// What it is, in the words of the file format.
    pub meaning: String,
}

/// Tables that ask for other things than this clutch.
const APART: &[&str] = &["schema", "name", "optimize", "identify", "tolerances", "check"];

/// All of them, in the order of the file.
pub fn fields(design: &Design) -> Vec<Field> {
    let table = |path: &str| path.split(['.', '[']).next().unwrap_or("").to_owned();
    let own = inputs(&design.source).into_iter().filter(|i| !APART.contains(&table(&i.path).as_str()));
    let own: Vec<Input> = own.collect();
    let key = |path: &str| path.rsplit('.').next().unwrap_or("").to_owned();
    let like = |path: &str| {
        let same = own.iter().filter(|i| key(&i.path) == key(path));
        same.filter_map(|i| i.number).fold(0.0, |most: f64, x| if x.abs() > most.abs() { x } else { most })
    };
    own.iter().filter_map(|input| field(design, input.clone(), like(&input.path))).collect()
}

/// One of them; `like` is the largest number of the file under the same key.
fn field(design: &Design, input: Input, like: f64) -> Option<Field> {
    let Input { path, unit, text: typed, number } = input;
    let schema = shape_of(&path)?;
    let text = |key: &str| schema.get(key).and_then(|v| v.as_str()).unwrap_or("").to_owned();
    let bound = |key: &str| schema.get(key).and_then(serde_json::Value::as_f64);
    let listed = schema.get("enum").and_then(|v| v.as_array()).filter(|_| number.is_none());
    let choice =
        listed.map(|all| (typed, all.iter().filter_map(|v| v.as_str().map(str::to_owned)).collect()));
    if number.is_none() && choice.is_none() {
        return None;
    }
    let (group, label) = match path.find('.') {
        Some(at) => (path[..at].to_owned(), path[at + 1..].to_owned()),
        None => (String::new(), path.clone()),
    };
    let arcs = design.clutch.sprags.listed_arcs();
    let task = design.optimize.iter().flat_map(|o| &o.variables);
    let bounds = task
        .filter(|v| variable_path(&v.name, arcs).as_deref() == Some(path.as_str()))
        .map(|v| [v.min, v.max])
        .next();
    let whole = schema.get("type").and_then(|v| v.as_str()) == Some("integer");
    let around = |x: f64| {
        let low = bound("minimum").or(bound("exclusiveMinimum")).unwrap_or(f64::NEG_INFINITY);
        let high = bound("maximum").or(bound("exclusiveMaximum")).unwrap_or(f64::INFINITY);
        let half = if whole { (0.25 * x.abs()).ceil().max(2.0) } else { 0.25 * x.abs() };
        [(x - half).max(low), (x + half).min(high)]
    };
    // An allowed gap differs little from the gap: from just above that on, to a few times what is allowed beside it.
    let about_the_gap = |x: f64| {
        let races = &design.clutch.races;
        let gap = Unit::Millimetre.from_si(races.outer_radius_m - races.inner_radius_m);
        let growth = x - gap;
        let is_gap = path.starts_with("limits.gap_") && growth > 0.0;
        is_gap.then_some([gap + 0.05 * growth, gap + 3.0 * growth])
    };
    let from_zero = |like: f64| {
        let [low, high] = around(if like == 0.0 { 1.0 } else { like });
        [low.min(0.0), high.max(0.0)]
    };
    let range = number.map(|x| match bounds {
        Some([low, high]) => [low.min(x), high.max(x)],
        None if x != 0.0 => about_the_gap(x).unwrap_or_else(|| around(x)),
        None => from_zero(like),
    });
    Some(Field {
        meaning: text("description"),
        path,
        group,
        label,
        unit: unit.to_owned(),
        value: number,
        range,
        whole,
        choice,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::with_setting;

    #[test]
    fn an_allowed_gap_slides_about_the_gap() {
        let text = include_str!("../../designs/series-833-small.toml");
        let text = with_setting(text, "limits.gap_nominal_mm", "8.46").unwrap();
        let text = with_setting(&text, "limits.gap_peak_mm", "8.6").unwrap();
        let design = Design::parse(&text, "a.toml").unwrap();
        let of = |path: &str| fields(&design).into_iter().find(|f| f.path == path).unwrap();
        for path in ["limits.gap_nominal_mm", "limits.gap_peak_mm"] {
            let field = of(path);
            let (x, [low, high]) = (field.value.unwrap(), field.range.unwrap());
            let gap = Unit::Millimetre
                .from_si(design.clutch.races.outer_radius_m - design.clutch.races.inner_radius_m);
            assert!(
                gap < low && low < x && x < high && high - low < 3.0 * (x - gap),
                "{path}: {low} {x} {high}"
            );
        }
    }

    #[test]
    fn every_field_can_be_set_to_its_own_value_and_has_a_meaning() {
        let text = include_str!("../../designs/huang2017-multi-arc.toml");
        let design = Design::parse(text, "a.toml").unwrap();
        let all = fields(&design);
        assert!(all.len() > 50, "{}", all.len());
        for f in &all {
            let value = f.value.map_or_else(|| f.choice.clone().unwrap().0, |v| v.to_string());
            let new = with_setting(text, &f.path, &value).unwrap();
            assert_eq!(
                Design::parse(&new, "a.toml").unwrap().content_hash(),
                design.content_hash(),
                "{}",
                f.path
            );
            assert!(!f.meaning.is_empty() || f.path.ends_with("name"), "{}", f.path);
        }
        assert!(
            all.iter()
                .all(|f| f.value.is_none_or(|x| f.range.is_some_and(|[a, b]| a <= x && x <= b && a < b)))
        );
        let of = |path: &str| all.iter().find(|f| f.path == path).unwrap();
        assert_eq!(of("sprags.inner_arcs[1].radius_mm").unit, "mm");
        assert_eq!(of("limits.hertz_peak_mpa").unit, "MPa");
        assert_eq!(of("scenarios[high-10].amplitude_nm").unit, "Nm");
        let by_unit = all.iter().filter(|f| f.value.is_some() && f.unit.is_empty());
        let bare: Vec<&str> = by_unit.map(|f| f.path.as_str()).collect();
        assert!(
            bare.iter().all(|p| [
                "count",
                "static",
                "kinetic",
                "poisson_ratio",
                "slip_margin",
                "roller_coefficient",
                "slices",
                "samples"
            ]
            .iter()
            .any(|k| p.ends_with(k))),
            "{bare:?}"
        );
    }
}
