//! Colour and line pattern of each curve: no two curves of one plot have both alike.

use super::{Curve, Dash};
use crate::report::svg::{SERIES, SOFT};

/// Patterns of one [`Dash`]: the usual one, and those that follow when all colours are taken with it.
const PATTERNS: usize = 3;

/// How one curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Style {
    /// Place in [`SERIES`].
    colour: usize,
    dash: Dash,
    /// Which of the dash's patterns.
    pattern: usize,
}

impl Style {
    pub(super) fn css(self) -> &'static str {
        if self.dash == Dash::Faint { SOFT } else { SERIES[self.colour] }
    }

    /// Attributes of a line in this style, `width_px` thick.
    pub(super) fn line(self, width_px: f64) -> String {
        let dashes = match (self.dash, self.pattern) {
            (Dash::Solid, 0) | (Dash::Faint, _) => "none",
            (Dash::Solid, 1) => "18 3",
            (Dash::Solid, _) => "18 3 3 3",
            (Dash::Dashed, 0) => "8 4",
            (Dash::Dashed, 1) => "8 4 2 4",
            (Dash::Dashed, _) => "8 4 2 4 2 4",
            (Dash::Dotted, 0) => "2 4",
            (Dash::Dotted, 1) => "1.5 8",
            (Dash::Dotted, _) => "2 3 2 9",
        };
        let colour = self.css();
        let soft = if self.dash == Dash::Faint { " stroke-opacity=\"0.5\"" } else { "" };
        format!(
            "fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width_px}\" stroke-dasharray=\"{dashes}\" \
             stroke-linejoin=\"round\"{soft}"
        )
    }
}

/// One style per curve; faint ones look alike. A curve that names its colour has it; the others take theirs by their place,
/// or the next that is free with their dash; then the next pattern. Only beyond 18 curves of one dash does a pair come again.
pub(super) fn styles(curves: &[Curve]) -> Vec<Style> {
    let mut taken: Vec<Style> = Vec::with_capacity(curves.len());
    for (index, curve) in curves.iter().enumerate() {
        let first = curve.colour.unwrap_or(index);
        let choices = if curve.colour.is_some() { 1 } else { SERIES.len() };
        let style = |pattern: usize, step: usize| Style {
            colour: (first + step) % SERIES.len(),
            dash: curve.dash,
            pattern,
        };
        let mut all = (0..PATTERNS).flat_map(|pattern| (0..choices).map(move |step| (pattern, step)));
        let free = all.find(|&(pattern, step)| !taken.contains(&style(pattern, step)));
        let (pattern, step) = free.unwrap_or((0, 0));
        taken.push(style(pattern, step));
    }
    taken
}
