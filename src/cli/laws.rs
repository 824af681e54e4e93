//! The contact laws that can be asked for.

use crate::clutch::{LAWS, LawName};
use clap::ValueEnum;
use clap::builder::PossibleValue;

/// Contact laws by their names in the design file.
impl ValueEnum for LawName {
    fn value_variants<'a>() -> &'a [Self] {
        const NAMES: [LawName; LAWS.len()] = {
            let mut names = [LawName::Roller; LAWS.len()];
            let mut i = 0;
            while i < LAWS.len() {
                names[i] = LAWS[i].name;
                i += 1;
            }
            names
        };
        &NAMES
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.facts().key).help(self.facts().title))
    }
}
