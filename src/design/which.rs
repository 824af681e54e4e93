//! One of a design's scenarios: by name, or the only one.

use super::{Design, Scenario};

/// The known name that is much like `name`.
pub fn nearest<'k, S: AsRef<str>>(name: &str, known: &'k [S]) -> Option<&'k str> {
    let likeness = |k: &'k str| (strsim::jaro_winkler(&name.to_lowercase(), &k.to_lowercase()), k);
    let best = known.iter().map(|k| likeness(k.as_ref())).max_by(|a, b| a.0.total_cmp(&b.0))?;
    (best.0 > 0.8).then_some(best.1)
}

/// To be said behind a refusal: `"; did you mean races?"`, or nothing.
pub fn did_you_mean<S: AsRef<str>>(name: &str, known: &[S]) -> String {
    nearest(name, known).map_or_else(String::new, |near| format!("; did you mean {near}?"))
}

/// Why it is not known which scenario is meant.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum WhichScenario {
    /// The design has none.
    #[error("the design has no scenarios; add a [[scenarios]] table")]
    None,
    /// None of that name.
    #[error("no scenario {name}; {the} design has: {}", .known.join(", "),
        the = nearest(name, known).map_or_else(|| "the".to_owned(), |near| format!("did you mean {near}? The")))]
    Unknown {
        /// The name.
        name: String,
        /// Those that there are.
        known: Vec<String>,
    },
    /// None is named, and there are several.
    #[error("several scenarios and none is named; the design has: {}", .known.join(", "))]
    Several {
        /// Those that there are.
        known: Vec<String>,
    },
}

impl Design {
    /// The scenario of that name, else the only one of those that are `meant`.
    ///
    /// # Errors
    /// [`WhichScenario`].
    pub fn which_scenario(
        &self,
        name: Option<&str>,
        meant: impl Fn(&Scenario) -> bool,
    ) -> Result<&Scenario, WhichScenario> {
        let names = |of: &mut dyn Iterator<Item = &Scenario>| of.map(|s| s.name.clone()).collect();
        let mut all = self.scenarios.iter();
        if let Some(name) = name {
            let unknown = |known: Vec<String>| match known.is_empty() {
                true => WhichScenario::None,
                false => WhichScenario::Unknown { name: name.to_owned(), known },
            };
            return self.scenario(name).ok_or_else(|| unknown(names(&mut all)));
        }
        let mut meant = all.filter(|s| meant(s));
        match (meant.next(), meant.next()) {
            (None, _) => Err(WhichScenario::None),
            (Some(only), None) => Ok(only),
            (Some(first), Some(second)) => {
                let known = names(&mut [first, second].into_iter().chain(meant));
                Err(WhichScenario::Several { known })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_is_found_by_name_or_alone_and_who_asks_otherwise_is_told_which_there_are() {
        let text = include_str!("../../designs/huang2017-multi-arc.toml");
        let mut design = Design::parse(text, "a.toml").unwrap();
        let which = |design: &Design, name| match design.which_scenario(name, |_| true) {
            Ok(found) => Ok(found.name.clone()),
            Err(why) => Err(why.to_string()),
        };
        assert_eq!(which(&design, Some("high-10")).as_deref(), Ok("high-10"));
        let unknown = which(&design, Some("high-11")).unwrap_err();
        assert!(unknown.contains("no scenario high-11; did you mean high-10? The design has: "), "{unknown}");
        assert!(which(&design, None).unwrap_err().contains("high-10, "));
        design.scenarios.truncate(1);
        assert_eq!(which(&design, None), Ok(design.scenarios[0].name.clone()));
        assert_eq!(design.which_scenario(None, |_| false), Err(WhichScenario::None));
        design.scenarios.clear();
        assert!(which(&design, Some("high-10")).unwrap_err().contains("add a [[scenarios]] table"));
    }
}
