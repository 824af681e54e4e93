//! The contact laws that can be asked for.

use crate::design::{ContactLaw, LAWS, LawName};
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

/// The laws asked for, each once, in the order asked; the design's own if none was.
pub(super) fn asked(names: &[LawName], design: &ContactLaw) -> Vec<LawName> {
    let mut list: Vec<LawName> = Vec::new();
    for &name in names {
        if !list.contains(&name) {
            list.push(name);
        }
    }
    if list.is_empty() { vec![design.name()] } else { list }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_law_once_and_the_designs_own_by_default() {
        use LawName::{Din26281, Hertz, Roller};
        assert_eq!(asked(&[Hertz, Roller, Hertz], &ContactLaw::Din26281), [Hertz, Roller]);
        assert_eq!(asked(&[], &ContactLaw::Din26281), [Din26281]);
    }
}
