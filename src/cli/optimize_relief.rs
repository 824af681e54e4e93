//! What `optimize` says of an infeasible problem: what would free it.

use super::optimize_story::{Part, Story};
use crate::optimise::{Alone, Freed, Loosened, Relief};
use crate::report::significant;

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
pub fn freed_sentence(f: &Freed) -> String {
    let value = |v: f64| format!("{} {}", significant(v, 4), f.unit);
    match f.needed {
        Some(v) => format!("{} in {}: {}", f.what, f.scenario, bound(v, f.given, f.unit)),
        None => format!("{} in {}: no value up to {} frees it alone", f.what, f.scenario, value(f.tried_to)),
    }
}

/// "limits.hoop_inner_mpa: at least 541 MPa instead of 480 MPa", the variables chosen anew.
pub fn loosened_sentence(l: &Loosened) -> Option<String> {
    Some(format!("{}: {}", l.key, bound(l.needed?, l.given, l.unit)))
}

/// "keep-contact: the variables hold it, but for the other limits: centroid_x_mm = -0.22".
pub fn alone_sentence(a: &Alone) -> String {
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
fn looked_at(l: &Loosened) -> String {
    let (from, to) = l.between;
    format!("{} ({} to {})", l.key, significant(from, 4), significant(to, 4))
}

/// Parts of the answer: what frees the problem, what frees its scenarios.
pub fn relief_parts(story: &Story, relief: &Relief) -> Vec<Part> {
    let mut lines: Vec<String> = story.loosened.iter().filter_map(loosened_sentence).collect();
    let in_vain: Vec<String> = story.loosened.iter().filter(|l| l.needed.is_none()).map(looked_at).collect();
    if !in_vain.is_empty() {
        lines.push(format!("no value was found that frees it alone: {}", in_vain.join(", ")));
    }
    lines.extend(story.alone.iter().map(alone_sentence));
    let of_scenes: Vec<String> = relief.freed.iter().map(freed_sentence).collect();
    let part = |heading, lines| Part { heading, lines, ..Part::default() };
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
