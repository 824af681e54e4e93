//! An infeasible problem: what would free it.

use super::Story;
use super::body::Named;
use super::parts::StoryPart;
use crate::optimise::{self, Freed};
use crate::report::significant;
use serde::Serialize;

/// What would free an infeasible problem.
#[derive(Debug, Clone, Serialize)]
pub struct ReliefBody {
    /// Parameters of scenarios, the profile held.
    pub freed: Vec<FreedBody>,
    /// Limits that do not hold and belong to no scenario.
    pub other_limits: Vec<String>,
    /// Single numbers, the variables chosen anew.
    pub numbers: Vec<LoosenedBody>,
    /// Limits looked at one by one.
    pub limits_alone: Vec<AloneBody>,
    /// Evaluations spent.
    pub evaluations: usize,
}

/// A parameter of a scenario that would free it alone.
#[derive(Debug, Clone, Serialize)]
pub struct FreedBody {
    /// The parameter and the value that frees it.
    #[serde(flatten)]
    pub freed: Freed,
    /// In words.
    pub sentence: String,
}

/// A single number that would free the problem.
#[derive(Debug, Clone, Serialize)]
pub struct LoosenedBody {
    /// Dotted path of the key, or the name of a design variable.
    pub key: String,
    /// Its unit; empty for a pure number.
    pub unit: &'static str,
    /// Value in the file.
    pub given: f64,
    /// Value that frees it, if one was found.
    pub needed: Option<f64>,
    /// Least value looked at.
    pub tried_from: f64,
    /// Greatest value looked at.
    pub tried_to: f64,
    /// In words, where a value was found.
    pub sentence: Option<String>,
}

/// A limit looked at alone.
#[derive(Debug, Clone, Serialize)]
pub struct AloneBody {
    /// Its code.
    pub code: String,
    /// The largest margin found.
    pub margin: f64,
    /// The variables that move for it.
    pub variables: Named,
    /// In words.
    pub sentence: String,
}

impl ReliefBody {
    pub(super) fn of(story: &Story, r: &optimise::Relief) -> Self {
        let freed = r.freed.iter().map(|f| FreedBody { freed: f.clone(), sentence: freed_sentence(f) });
        let numbers = story.loosened.iter().map(|l| LoosenedBody {
            key: l.key.clone(),
            unit: l.unit,
            given: l.given,
            needed: l.needed,
            tried_from: l.between.0,
            tried_to: l.between.1,
            sentence: loosened_sentence(l),
        });
        let limits_alone = story.alone.iter().map(|a| AloneBody {
            code: a.code.clone(),
            margin: a.margin,
            variables: a.changes.iter().cloned().collect(),
            sentence: alone_sentence(a),
        });
        Self {
            freed: freed.collect(),
            other_limits: r.other_limits.clone(),
            numbers: numbers.collect(),
            limits_alone: limits_alone.collect(),
            evaluations: r.evaluations + story.loosened.iter().map(|l| l.evaluations).sum::<usize>(),
        }
    }
}

/// "at least 5.2001 Nm instead of 3.34 Nm": five digits, rounded to the side that frees.
fn bound(needed: f64, given: f64, unit: &str) -> String {
    let size = if needed == 0.0 { 1.0 } else { needed.abs() };
    let digit = 10.0_f64.powi(size.log10().floor() as i32 - 4);
    let (word, rounded) = match needed > given {
        true => ("at least", (needed / digit).ceil() * digit),
        false => ("at most", (needed / digit).floor() * digit),
    };
    let shown = |v: f64, digits: usize| format!("{} {unit}", significant(v, digits)).trim_end().to_owned();
    format!("{word} {} instead of {}", shown(rounded, 5), shown(given, 5))
}

/// "preload in high-10: at least 5.2001 Nm instead of 3.34 Nm".
fn freed_sentence(f: &Freed) -> String {
    let value = |v: f64| format!("{} {}", significant(v, 4), f.unit);
    match f.needed {
        Some(v) => format!("{} in {}: {}", f.what, f.scenario, bound(v, f.given, f.unit)),
        None => format!(
            "{} in {}: frees it at no value between {} and {}, the last one looked at",
            f.what,
            f.scenario,
            value(f.given),
            value(f.tried_to)
        ),
    }
}

/// "limits.hoop_inner_mpa: at least 541 MPa instead of 480 MPa", the variables chosen anew.
fn loosened_sentence(l: &optimise::Loosened) -> Option<String> {
    Some(format!("{}: {}", l.key, bound(l.needed?, l.given, l.unit)))
}

/// "keep-contact: the variables hold it, but for the other limits: centroid_x_mm = -0.22".
fn alone_sentence(a: &optimise::Alone) -> String {
    let changes: Vec<String> =
        a.changes.iter().map(|(name, v)| format!("{name} = {}", significant(*v, 4))).collect();
    match a.margin >= 0.0 {
        true => format!(
            "{}: not held there, but the variables alone can hold it, the other limits left aside, with {}",
            a.code,
            changes.join(", ")
        ),
        false => format!(
            "{}: no values of the variables were found that hold it, even with all other limits left aside; its margin is {} \
             at best",
            a.code,
            significant(a.margin, 3)
        ),
    }
}

/// "length_mm (4.8 to 7.2)".
fn looked_at(l: &optimise::Loosened) -> String {
    let (from, to) = l.between;
    format!("{} ({} to {})", l.key, significant(from, 4), significant(to, 4))
}

/// Parts of the answer: what frees the problem, what frees its scenarios.
pub(super) fn relief_parts(story: &Story, relief: &optimise::Relief) -> Vec<StoryPart> {
    let mut lines: Vec<String> = story.loosened.iter().filter_map(loosened_sentence).collect();
    let in_vain: Vec<String> = story.loosened.iter().filter(|l| l.needed.is_none()).map(looked_at).collect();
    if !in_vain.is_empty() {
        lines.push(format!("no value was found that frees it alone: {}", in_vain.join(", ")));
    }
    lines.extend(story.alone.iter().map(alone_sentence));
    // A parameter that was turned in vain says nothing beside one that frees its scenario.
    let frees = |scene: &str| relief.freed.iter().any(|f| f.scenario == scene && f.needed.is_some());
    let of_scenes: Vec<String> = relief
        .freed
        .iter()
        .filter(|f| f.needed.is_some() || !frees(&f.scenario))
        .map(freed_sentence)
        .collect();
    let part = |heading, lines| StoryPart { heading, lines, ..StoryPart::default() };
    [
        part("What would free it (one change alone, the variables chosen anew)", lines),
        part("What would free a scenario (profile of least violation, one change alone)", of_scenes),
    ]
    .into_iter()
    .filter(|part| !part.lines.is_empty())
    .collect()
}

#[cfg(test)]
mod tests {
    use super::bound;

    #[test]
    fn a_bound_is_rounded_to_the_side_that_frees() {
        assert_eq!(bound(563.7042, 480.0, "MPa"), "at least 563.71 MPa instead of 480.00 MPa");
        assert_eq!(bound(0.407_879, 0.45, ""), "at most 0.40787 instead of 0.45000");
        assert_eq!(bound(-0.218_123, -0.2, "mm"), "at most \u{2212}0.21813 mm instead of \u{2212}0.20000 mm");
    }
}
