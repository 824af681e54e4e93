//! A stretch of a scene's time as its figures show it: the whole of it, or its first event enlarged.

use super::{HistoryRow, word};
use crate::dynamics::{Mode, Place};
use crate::report::{Curve, Dash, Plot, Span, Strip};
use crate::scenario::Simulation;

/// Of the whole, ms: in words on the axis.
const TIME: &str = "Time, ms";
/// Changes of mode that belong to an event.
const CHANGES: usize = 6;
/// Samples without which a stretch shows no course.
const LEAST_SAMPLES: f64 = 48.0;
/// The longest part of the history that is still an enlargement.
const MOST_OF_IT: f64 = 0.2;
/// Part of an event's length that is shown before it.
const BEFORE: f64 = 0.25;

/// From when until when, and how its time is counted.
pub(super) struct Stretch {
    from_s: f64,
    until_s: f64,
    /// Where the axis has its zero.
    zero_s: f64,
    per_s: f64,
    title: String,
}

impl Stretch {
    /// All of it.
    pub(super) fn whole(s: &Simulation) -> Self {
        Self { from_s: 0.0, until_s: s.t_s, zero_s: 0.0, per_s: 1e3, title: TIME.to_owned() }
    }

    /// Around the first change of what a contact does, with what that is and when, s; none where nothing changes, or where the
    /// samples are too few to show it.
    pub(super) fn first_event(s: &Simulation, rows: &[HistoryRow]) -> Option<(Self, &'static str, f64)> {
        let (begin_s, end_s) = (rows.first()?.sample.t, rows.last()?.sample.t);
        let changes = || {
            let pairs = s.modes.iter().zip(s.modes.iter().skip(1));
            pairs.filter_map(|((_, old), (at_s, new))| Some((*at_s, change(old, new)?)))
        };
        let (at_s, what) = changes().next().filter(|(at_s, _)| (begin_s..=end_s).contains(at_s))?;
        let spacing_s = (end_s - begin_s) / (rows.len() as f64 - 1.0).max(1.0);
        let (least_s, most_s) = (LEAST_SAMPLES * spacing_s, MOST_OF_IT * (end_s - begin_s));
        if least_s.is_nan() || least_s > most_s {
            return None;
        }
        let last_s = changes().nth(CHANGES).map_or(end_s, |c| c.0);
        let length_s = (last_s - at_s).clamp(least_s, most_s);
        let (unit, per_s) = if length_s < 1e-3 { ("µs", 1e6) } else { ("ms", 1e3) };
        let stretch = Self {
            from_s: (at_s - BEFORE * length_s).max(begin_s),
            until_s: (at_s + length_s).min(end_s),
            zero_s: at_s,
            per_s,
            title: format!("Time since {what}, {unit}"),
        };
        Some((stretch, what, at_s))
    }

    /// An empty plot over it.
    pub(super) fn plot(&self, y_title: &str) -> Plot {
        Plot::new(&self.title, y_title).sized(720.0, 300.0)
    }

    /// An instant on its axis.
    pub(super) fn at(&self, t_s: f64) -> f64 {
        (t_s - self.zero_s) * self.per_s
    }

    /// A value of the rows within it.
    pub(super) fn points(&self, rows: &[HistoryRow], value: &dyn Fn(&HistoryRow) -> f64) -> Vec<[f64; 2]> {
        let within = rows.iter().filter(|r| (self.from_s..=self.until_s).contains(&r.sample.t));
        super::page::envelope(within.map(|r| [self.at(r.sample.t), value(r)]).collect())
    }

    /// Levels all along it as a curve: their name stands in the legend, where it covers no other curve.
    pub(super) fn levels(&self, name: &str, at: &[f64]) -> Curve {
        let ends = [self.at(self.from_s), self.at(self.until_s)];
        let points = at.iter().flat_map(|&y| [[ends[0], y], [ends[1], y], [f64::NAN, y]]).collect();
        Curve { dash: Dash::Dashed, ..Curve::new(name, points).coloured(5) }
    }

    /// What each contact does.
    pub(super) fn strip(&self, s: &Simulation) -> Strip {
        let words = ["stick", "slip+", "slip-", "open"];
        let spans = |inner: bool| -> Vec<Span> {
            let ends = s.modes.iter().skip(1).map(|m| m.0).chain([s.t_s]);
            let state = |mode: &Mode| match word(mode, inner) {
                "cage" => 3,
                other => words.iter().position(|w| *w == other).unwrap_or(0),
            };
            let within = |t: f64| self.at(t.clamp(self.from_s, self.until_s));
            let span = |((from, mode), until): (&(f64, Mode), f64)| Span {
                from: within(*from),
                until: within(until),
                state: state(mode),
            };
            s.modes.iter().zip(ends).map(span).collect()
        };
        let carried = s.modes.iter().any(|(_, mode)| mode.place == Place::Carried);
        let apart = if carried { "open, or carried by the cage" } else { "open" };
        Strip {
            title: self.title.clone(),
            range: [self.at(self.from_s), self.at(self.until_s)],
            states: ["sticks", "slips, race ahead", "slips, race behind", apart].map(str::to_owned).to_vec(),
            rows: vec![("inner".to_owned(), spans(true)), ("outer".to_owned(), spans(false))],
        }
    }
}

/// What a contact does in `new` that it did not do in `old`; none where only the arc is another.
fn change(old: &Mode, new: &Mode) -> Option<&'static str> {
    let changed = |inner: bool| Some((word(old, inner), word(new, inner))).filter(|(a, b)| a != b);
    let what = |(before, after): (&str, &str), inner: bool| match (before, after, inner) {
        (_, "cage", true) => "the cage takes the sprags along",
        ("cage", _, true) => "the outer race catches up",
        ("open", _, false) => "the outer contact closes",
        (_, "open", false) => "the outer contact opens",
        ("open", ..) => "the inner contact closes",
        (_, "open", _) => "the inner contact opens",
        (_, "stick", true) => "the inner contact sticks",
        (_, "stick", false) => "the outer contact sticks",
        ("stick", _, true) => "the inner contact slips",
        ("stick", _, false) => "the outer contact slips",
        (_, _, true) => "the inner contact slips the other way",
        (_, _, false) => "the outer contact slips the other way",
    };
    [true, false].into_iter().find_map(|inner| Some(what(changed(inner)?, inner)))
}
