//! What the answer was before it was made makeable: with a free centroid, between the steps of its lengths.

use super::Story;
use super::body::{Named, values};
use super::realised::CodeMargin;
use super::words::shown;
use crate::optimise::{OffGrid, Search, Stepped};
use crate::report::significant;
use serde::Serialize;

/// A design that bounds the answer and is none itself.
#[derive(Debug, Clone, Serialize)]
pub struct Bound {
    /// Values of its variables.
    pub variables: Named,
    /// The objective, in its own unit.
    pub objective: f64,
    /// Evaluations of the clutch.
    pub evaluations: usize,
}

/// Lengths in steps.
#[derive(Debug, Clone, Serialize)]
pub struct Steps {
    /// The step, mm.
    pub step_mm: f64,
    /// Variables that have it.
    pub variables: Vec<String>,
    /// Whether a point of the grid near the optimum holds every limit, so that it is the answer.
    pub found: bool,
    /// Else what the nearest point does not hold; margins less the reserve.
    pub not_held: Vec<CodeMargin>,
    /// Evaluations of the clutch.
    pub evaluations: usize,
}

impl Bound {
    pub(super) fn of(search: &Search) -> Self {
        Self {
            variables: values(search, |v| v.best),
            objective: search.objective.1,
            evaluations: search.evaluations,
        }
    }
}

impl Steps {
    pub(super) fn of(stepped: &Stepped) -> Self {
        let broken = stepped.found.as_ref().err().map_or(&[][..], |off| &off.not_held);
        Self {
            step_mm: stepped.step_mm,
            variables: stepped.variables.clone(),
            found: stepped.found.is_ok(),
            not_held: broken
                .iter()
                .map(|(code, margin)| CodeMargin { code: code.clone(), margin: *margin })
                .collect(),
            evaluations: stepped.evaluations,
        }
    }
}

/// Sentences on the steps.
pub(super) fn lines(story: &Story, stepped: &Stepped) -> Vec<String> {
    let (made, aim) = (story.made(), story.found.aim);
    let at = |x: &[f64]| -> String {
        let of = |name: &String| {
            let i = made.searched.iter().position(|n| n == name)?;
            Some(format!("{name} {}", significant(*x.get(i)?, 7)))
        };
        stepped.variables.iter().filter_map(of).collect::<Vec<_>>().join(", ")
    };
    let near = |off: &OffGrid| {
        let short =
            |(code, left): &(String, f64)| format!("{code} is short by {} %", significant(-100.0 * left, 2));
        let broken: Vec<String> = off.not_held.iter().map(short).collect();
        match off.x.is_empty() {
            true => "no point of it near the optimum is a clutch".to_owned(),
            false => format!("at the nearest, {}, {}", at(&off.x), broken.join(", ")),
        }
    };
    match &stepped.found {
        Ok(_) => vec![format!(
            "lengths are multiples of {} mm; between them (a bound) the search came to {} {} at {}",
            stepped.step_mm,
            aim.words(),
            shown(aim, made.objective.1),
            at(&made.outcome.x)
        )],
        Err(off) => vec![format!(
            "no point near the optimum whose lengths are multiples of {} mm holds every limit ({}); the lengths are left as the \
             search had them",
            stepped.step_mm,
            near(off)
        )],
    }
}
