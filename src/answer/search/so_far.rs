//! How far a search is, as a progress line says it.

use crate::follow::News;
use crate::optimise::Iteration;

/// Violations below are none.
const NONE_VIOLATED: f64 = 1e-8;

/// How far a search is: kept by whoever follows it, from its news and its steps.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SearchSoFar {
    /// The part of the search that goes on.
    pub part: String,
    /// Evaluations of the clutch, of all parts.
    pub evaluations: u64,
    /// Largest least objective of a step of this part that held every limit.
    pub best: Option<f64>,
    /// The last step of this part.
    pub last: Option<Iteration>,
}

impl SearchSoFar {
    /// Something begins or is done.
    pub fn hear(&mut self, news: News<'_>) {
        match news {
            News::Done => self.evaluations += 1,
            News::Begins(part) if part == self.part => {}
            News::Begins(part) => {
                *self = Self { part: part.to_owned(), evaluations: self.evaluations, ..Self::default() };
            }
        }
    }

    /// A step was tried.
    pub fn see(&mut self, it: &Iteration) {
        self.last = Some(*it);
        if it.violation <= NONE_VIOLATED {
            self.best = Some(self.best.map_or(it.least_margin, |b| b.max(it.least_margin)));
        }
    }

    /// In a line.
    pub fn words(&self) -> String {
        let Some(it) = &self.last else { return self.part.clone() };
        let best = self.best.map_or("none yet".to_owned(), |b| format!("{b:.5}"));
        let violated = match it.violated {
            0 => "every limit held".to_owned(),
            n => format!("{n} limits violated, the worst by {:.1e}", it.violation),
        };
        format!("{}: {:.5}, {violated}, best feasible {best}", self.part, it.least_margin)
    }
}
