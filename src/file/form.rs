//! A design file read once, to be had again with other values of some of its numbers.
//!
//! In: a text, names of variables, their values. Out: [`Design`]s without a text. Absent: why one is refused; the text with
//! the values in it says that. Equations: none.

use super::document::{value_at, value_at_mut};
use super::edit::lean;
use super::history::{self, HistoryKind};
use super::open;
use super::shape;
use super::variables::variable_path;
use crate::design::Design;
use std::collections::BTreeMap;
use std::path::Path;
use toml::{Table, Value};

/// Rows of histories by their names in the file.
type Histories = BTreeMap<(String, HistoryKind), Vec<[f64; 2]>>;

/// A design file without `[optimize]` and without scenarios that nobody asks for, with gaps where the values of some variables
/// stand. Neither the text nor the histories are read again.
#[derive(Debug, Clone)]
pub struct DesignForm {
    table: Table,
    /// Path of each variable.
    gaps: Vec<String>,
    histories: Histories,
}

impl DesignForm {
    /// Of `source`, whose histories lie in `folder`, with gaps for `variables` and the scenarios whose name `keep` picks. `None`
    /// where a variable has no place of its own, or the text is refused.
    pub fn of(
        source: &str,
        folder: &Path,
        variables: &[String],
        keep: &dyn Fn(&str) -> bool,
    ) -> Option<Self> {
        let table = lean(source, keep).ok()?;
        let arcs = table.get("sprags")?.get("inner_arcs")?.as_array()?.len();
        let place = |name: &String| {
            let path = variable_path(name, arcs)?;
            value_at(&table, &path).filter(|v| v.is_float() || v.is_integer()).map(|_| path)
        };
        let gaps = variables.iter().map(place).collect::<Option<Vec<_>>>()?;
        let mut histories = Histories::new();
        let mut load = |name: &str, kind: HistoryKind| {
            let path = open::history_path(folder, name).map_err(|_| None)?;
            let text = open::read_text(&path, open::MOST_TABLE).map_err(|_| None)?;
            let rows = history::rows(&text, kind).map_err(|_| None)?;
            histories.insert((name.to_owned(), kind), rows.clone());
            Ok(rows)
        };
        Design::of_table(&table, &mut load)?;
        Some(Self { table, gaps, histories })
    }

    /// The design with its variables at `x`, each in the unit of its name. `None` where it is refused.
    pub fn at(&self, x: &[f64]) -> Option<Design> {
        let mut table = self.table.clone();
        for (path, &value) in self.gaps.iter().zip(x) {
            let number = match shape::kind_of(path) {
                _ if !value.is_finite() || shape::out_of_range(path, value).is_some() => return None,
                Some("integer") if value == value.round() => Value::Integer(value as i64),
                Some("integer") => return None,
                // Of a zero without its sign.
                _ => Value::Float(value + 0.0),
            };
            *value_at_mut(&mut table, path)? = number;
        }
        let mut load = |name: &str, kind| {
            let rows = self.histories.get(&(name.to_owned(), kind));
            rows.cloned().ok_or(None)
        };
        Design::of_table(&table, &mut load)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::with_values;

    /// Values of `text` in a form and in the text.
    fn both(text: &str, folder: &Path, values: &[(&str, f64)]) -> (Option<Design>, Option<Design>) {
        let names: Vec<String> = values.iter().map(|(name, _)| (*name).to_owned()).collect();
        let x: Vec<f64> = values.iter().map(|(_, value)| *value).collect();
        let form = DesignForm::of(text, folder, &names, &|_| true).unwrap();
        let written = with_values(text, values).unwrap_or_default();
        (form.at(&x), Design::parse_in(folder, &written, "a.toml").ok())
    }

    #[test]
    fn a_form_says_what_the_text_says() {
        let folder = Path::new("designs");
        let elastic = include_str!("../../designs/huang2017-elastic.toml");
        let starter = include_str!("../../designs/starter.toml");
        let bench = include_str!("../../designs/huang2017-bench.toml");
        let r_i1 = ("r_i1_mm", 4.0);
        let cases: [(&str, &[(&str, f64)]); 5] = [
            (elastic, &[("r_i1_mm", 4.01), ("r_i2_mm", 4.123), ("junction_1_rad", 0.061)]),
            (starter, &[r_i1, ("count", 14.0), ("friction.static", 0.11)]),
            (bench, &[r_i1]),
            // Refused by the schema, by a rule, and as no number.
            (elastic, &[("r_i2_mm", -1.0)]),
            (elastic, &[("r_i1_mm", 50.0)]),
        ];
        for (text, values) in cases {
            let (form, written) = both(text, folder, values);
            let said = |d: &Design| format!("{:?} {:?} {:?}", d.clutch, d.limits, d.scenarios);
            assert_eq!(form.as_ref().map(said), written.as_ref().map(said), "{values:?}");
        }
        assert!(both(elastic, folder, &[("r_i2_mm", 4.1)]).0.is_some());
        assert!(both(starter, folder, &[("count", 14.5)]).0.is_none());
        let none = DesignForm::of(elastic, folder, &["r_i1_mm".to_owned()], &|_| true).unwrap();
        assert!(none.at(&[f64::NAN]).is_none());
        assert!(DesignForm::of(elastic, folder, &["r_i9_mm".to_owned()], &|_| true).is_none());
    }

    #[test]
    fn histories_are_read_once() {
        let folder = std::env::temp_dir().join(format!("sprag-form-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let file = folder.join("torque.csv");
        std::fs::write(&file, "time_s,torque_nm\n0,1\n0.1,5\n").unwrap();
        let text = include_str!("../../designs/huang2017-multi-arc.toml").to_owned()
            + "\n[[scenarios]]\nname = \"told\"\nkind = \"transient\"\ntorque_history_csv = \"torque.csv\"\nduration_s = 0.1\n\
               abutment_stiffness_nm_per_rad = 2e4\n";
        let read = Design::parse_in(&folder, &text, "a.toml").unwrap();
        let form = DesignForm::of(&text, &folder, &["r_i2_mm".to_owned()], &|name| name == "told").unwrap();
        std::fs::remove_dir_all(&folder).unwrap();
        let again = form.at(&[4.1]).unwrap();
        let told = |d: &Design| d.scenario("told").map(|s| s.torque_history.clone());
        assert!(told(&read).is_some() && told(&read) == told(&again));
        assert_eq!(again.scenarios.len(), 1);
    }
}
