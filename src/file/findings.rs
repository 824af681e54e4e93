//! Collects what the rules that join several keys object to.
//!
//! In: keys, what they allow, how to mend. Out: [`Problem`]s at the right line, also where a scenario or
//! `[optimize]` overrides a table. Absent: the rules. Equations: none.

use toml::de::DeValue;

use super::diagnostic::{MOST_COLLECTED, NO_SUCH_KEY, Problem};
use super::document::{Document, value_at};

/// Problems of one document; `scope` is the path of the table whose overrides are being checked, or empty.
pub(super) struct Findings<'d, 'a> {
    table: &'d toml::Table,
    /// Where everything stands; `None`: nobody will be told, a problem is one without its place.
    doc: Option<&'d Document<'a>>,
    scope: String,
    pub problems: Vec<Problem>,
}

impl<'d, 'a> Findings<'d, 'a> {
    pub fn new(table: &'d toml::Table, doc: Option<&'d Document<'a>>) -> Self {
        Self { table, doc, scope: String::new(), problems: Vec::new() }
    }

    /// Whether the file has something at a dotted path.
    pub fn has(&self, path: &str) -> bool {
        value_at(self.table, path).is_some()
    }

    /// The number at a dotted path.
    pub fn number(&self, path: &str) -> Option<f64> {
        let value = value_at(self.table, path)?;
        value.as_float().or_else(|| value.as_integer().map(|i| i as f64))
    }

    /// The text at a dotted path.
    pub fn text(&self, path: &str) -> Option<&'d str> {
        value_at(self.table, path)?.as_str()
    }

    /// Check overrides found under `scope`: keys are looked for there first.
    pub fn within<T>(&mut self, scope: &str, check: impl FnOnce(&mut Self) -> T) -> T {
        let outer = std::mem::replace(&mut self.scope, scope.to_owned());
        let answer = check(self);
        self.scope = outer;
        answer
    }

    /// Refuse the value of `keys[0]`, the other keys taking part. Within a scope the overridden key comes
    /// first. Where none is overridden, the base table has been refused for it already; should it not have
    /// been, the whole override is at fault, so that nothing is let through in silence.
    pub fn refuse(&mut self, keys: &[&str], allowed: String, help: String) {
        if self.problems.len() >= MOST_COLLECTED {
            return;
        }
        let Some(doc) = self.doc else {
            let key = keys.first().map_or(String::new(), |key| (*key).to_owned());
            let (found, also) = (String::new(), Vec::new());
            self.problems.push(Problem { key, place: None, found, allowed, help, also });
            return;
        };
        let scoped = |key: &str| match self.scope.as_str() {
            "" => Some(key.to_owned()),
            scope => Some(format!("{scope}.{key}")).filter(|path| doc.entry(path).is_some()),
        };
        let first = keys.iter().position(|k| scoped(k).is_some());
        let mut paths: Vec<String> =
            keys.iter().map(|k| scoped(k).unwrap_or_else(|| (*k).to_owned())).collect();
        let key = match first {
            Some(first) => paths.remove(first),
            None if self.problems.is_empty() => self.scope.clone(),
            None => return,
        };
        let place = Some(doc.place_of(&key));
        let mut found = found_at(doc, &key);
        let mut also = Vec::new();
        let mut joint = " with ";
        for path in paths {
            let Some(entry) = doc.entry(&path) else { continue };
            if !matches!(entry.value.get_ref(), DeValue::Table(_) | DeValue::Array(_)) {
                found.push_str(&format!("{joint}{path} = {}", found_at(doc, &path)));
                joint = ", ";
            }
            let place = doc.place_of(&path);
            also.push((path, place));
        }
        self.problems.push(Problem { key, place, found, allowed, help, also });
    }
}

fn found_at(doc: &Document<'_>, path: &str) -> String {
    doc.entry(path).map_or_else(|| NO_SUCH_KEY.to_owned(), |e| doc.text_of(e.value))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_override_is_pointed_at_and_a_fault_of_the_base_is_told_once() {
        let text = "[a]\nx = 1\n[[rows]]\n[rows.a]\ny = 2\n";
        let doc = Document::parse(text).unwrap_or_else(|p| panic!("{p:?}"));
        let table = doc.table().unwrap();
        let refused = |keys: &[&str], before: usize| {
            let mut out = Findings::new(&table, Some(&doc));
            (0..before).for_each(|_| out.refuse(&["a.x"], String::new(), String::new()));
            out.within("rows[0]", |out| out.refuse(keys, String::new(), String::new()));
            out.problems.iter().skip(before).map(|p| (p.key.clone(), p.found.clone())).collect::<Vec<_>>()
        };
        let overridden = ("rows[0].a.y".to_owned(), "2 with a.x = 1".to_owned());
        assert_eq!(refused(&["a.x", "a.y"], 0), [overridden]);
        assert_eq!(refused(&["a.x"], 1), []);
        assert_eq!(refused(&["a.x"], 0), [("rows[0]".to_owned(), "a table with a.x = 1".to_owned())]);
    }
}
