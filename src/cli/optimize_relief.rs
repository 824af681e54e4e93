//! What `optimize` says of an infeasible problem: what would free it.

use super::optimize_story::{Part, Story};
use crate::optimise::{Alone, Freed, Loosened, Relief};
use crate::report::significant;

/// "preload of high-10: 3.34 Nm must become at least 5.2 Nm".
pub fn freed_sentence(f: &Freed) -> String {
    let value = |v: f64| format!("{} {}", significant(v, 4), f.unit);
    match f.needed {
        Some(v) if v >= f.given => {
            format!("{} in {}: at least {} instead of {}", f.what, f.scenario, value(v), value(f.given))
        }
        Some(v) => {
            format!("{} in {}: at most {} instead of {}", f.what, f.scenario, value(v), value(f.given))
        }
        None => format!("{} in {}: no value up to {} frees it alone", f.what, f.scenario, value(f.tried_to)),
    }
}

/// "limits.hoop_inner_mpa: at least 541 MPa instead of 480 MPa", the variables chosen anew.
pub fn loosened_sentence(l: &Loosened) -> Option<String> {
    let value = |v: f64| format!("{} {}", significant(v, 4), l.unit).trim_end().to_owned();
    let needed = l.needed?;
    let bound = if needed > l.given { "at least" } else { "at most" };
    Some(format!("{}: {bound} {} instead of {}", l.key, value(needed), value(l.given)))
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
