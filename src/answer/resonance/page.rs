//! The page of periodic states: maps of what rolling needs and of what the clutch does, curves over frequency.

use super::ResonanceAnswer;
use crate::answer::Said;
use crate::answer::page::half;
use crate::report::heat::SHADES;
use crate::report::{HeatMap, Page, Plot, Shade, Unit, significant};
use crate::scenario::{MotionKind, ResonanceCell};

/// Rows that the plot of mu_req shows.
const CURVES: usize = 6;

pub(super) fn draw(answer: &ResonanceAnswer<'_>, page: &mut Page) {
    let wide = answer.rows.iter().all(|row| row.len() > 1);
    if wide && answer.rows.len() > 1 {
        page.heading("Map");
        page.paragraph(
            "First map: static friction that rolling needs, the deeper green the larger the slip margin, red where there is less; \
             grey: rolling would open the contact; crossed: no rolling motion that repeats was found. Second map: what \
             the clutch does with the friction that it has. The line is the border of what rolls.",
        );
        page.figures(&[(answer.needed().to_figure(), ""), (answer.kinds().to_figure(), "")]);
    }
    if wide {
        let mut needed = Plot::new("Frequency, Hz", "Static friction that rolling needs");
        let mut load = Plot::new("Frequency, Hz", "Largest normal force, N");
        for row in answer.some_rows() {
            let name = row.first().map_or(String::new(), |c| Unit::NewtonMetre.show(c.amplitude_nm, 3));
            let points = |of: &dyn Fn(&ResonanceCell) -> Option<f64>| {
                // Where there is none the line ends.
                row.iter().map(|c| [c.frequency_hz, of(c).unwrap_or(f64::NAN)]).collect::<Vec<_>>()
            };
            needed = needed.curve(&name, points(&|c| c.state.required_friction));
            let largest = |c: &ResonanceCell| Some(c.state.motion.as_ref().ok()?.run.peaks.normal_max_n);
            load = load.curve(&name, points(&largest));
        }
        page.figures(&[
            (
                half(needed),
                &format!("Rolling states that keep contact; there is {}.", significant(answer.friction, 3)),
            ),
            (half(load), "Of the state with the friction that there is."),
        ]);
    } else {
        page.table("The states.", &Said::table(answer));
    }
}

impl ResonanceAnswer<'_> {
    fn some_rows(&self) -> impl Iterator<Item = &Vec<ResonanceCell>> {
        let (last, shown) = (self.rows.len() - 1, self.rows.len().min(CURVES));
        (0..shown).map(move |k| &self.rows[if shown > 1 { k * last / (shown - 1) } else { 0 }])
    }

    fn plane(&self, title: &str) -> HeatMap {
        let of = |cells: Vec<f64>| edges(&cells);
        HeatMap {
            title: title.to_owned(),
            x_title: "Frequency, Hz".to_owned(),
            y_title: "Amplitude, Nm".to_owned(),
            x_edges: of(self.rows.iter().take(1).flatten().map(|c| c.frequency_hz).collect()),
            y_edges: of(self.rows.iter().filter_map(|row| Some(row.first()?.amplitude_nm)).collect()),
            tiles: Vec::new(),
            legend: Vec::new(),
        }
    }

    /// What rolling needs.
    fn needed(&self) -> HeatMap {
        let range = |held: bool| {
            let side = self.cells().filter_map(|c| c.state.slip_margin).filter(|m| (*m >= 0.0) == held);
            side.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], m| [low.min(m), high.max(m)])
        };
        let (held, broken) = (range(true), range(false));
        let needs = |margin: f64| significant(self.friction / (1.0 + margin), 4);
        // What the legend cannot tell apart has one shade.
        let alike = |[from, to]: [f64; 2]| needs(from) == needs(to);
        let shade = |value: f64, from: f64, to: f64| {
            let share = if alike([from, to]) { 1.0 } else { (value - from) / (to - from) };
            (share * f64::from(SHADES)).clamp(0.0, f64::from(SHADES - 1)) as u8
        };
        let tile = |c: &ResonanceCell| match c.state.slip_margin {
            None if c.state.rolling.is_err() => (Shade::Missing, None),
            None => (Shade::Void, Some(false)),
            Some(m) if m >= 0.0 => (Shade::Held(shade(m, held[0], held[1])), Some(true)),
            Some(m) => (Shade::Broken(shade(m, broken[1], broken[0])), Some(false)),
        };
        let tiles: Vec<(Shade, Option<bool>)> = self.cells().map(tile).collect();
        let mut legend = Vec::new();
        if held[0] <= held[1] {
            legend.push((Shade::Held(SHADES - 1), format!("needs {}", needs(held[1]))));
            if !alike(held) {
                legend.push((Shade::Held(0), format!("needs {}", needs(held[0]))));
            }
        }
        if broken[0] <= broken[1] {
            if !alike(broken) {
                legend.push((Shade::Broken(0), format!("needs {}", needs(broken[1]))));
            }
            legend.push((Shade::Broken(SHADES - 1), format!("needs {}", needs(broken[0]))));
        }
        if tiles.iter().any(|(shade, _)| *shade == Shade::Void) {
            legend.push((Shade::Void, "would open".to_owned()));
        }
        if tiles.iter().any(|(shade, _)| *shade == Shade::Missing) {
            legend.push((Shade::Missing, "not found".to_owned()));
        }
        HeatMap { tiles, legend, ..self.plane("Static friction needed to roll") }
    }

    /// What the clutch does.
    fn kinds(&self) -> HeatMap {
        let kind = |c: &ResonanceCell| match c.state.kind {
            _ if c.other.is_some() => 5,
            _ if c.state.is_stable() == Some(false) => 6,
            MotionKind::Rolls => 0,
            MotionKind::Slips => 1,
            MotionKind::LiftsOff => 2,
            MotionKind::Overloaded => 3,
            MotionKind::NotFound => 4,
            MotionKind::Disengages => 7,
        };
        const NAMES: [&str; 8] = [
            "rolls",
            "slips each period",
            "lifts off",
            "overloaded",
            "does not repeat",
            "two states",
            "unstable",
            "disengages",
        ];
        // Green is what rolls; other colours go to those that are there: there are fewer than kinds.
        const OTHERS: [usize; 5] = [1, 3, 0, 4, 5];
        let there: Vec<usize> = (0..NAMES.len()).filter(|k| self.cells().any(|c| kind(c) == *k)).collect();
        let others = || there.iter().filter(|k| **k != 0);
        let shade = |of: usize| match others().position(|k| *k == of) {
            Some(place) => Shade::Kind(OTHERS[place.min(OTHERS.len() - 1)]),
            None => Shade::Held(SHADES / 2),
        };
        let tile = |c: &ResonanceCell| (shade(kind(c)), Some(c.state.kind == MotionKind::Rolls));
        let tiles = self.cells().map(tile).collect();
        let legend = there.iter().map(|&k| (shade(k), NAMES[k].to_owned())).collect();
        HeatMap { tiles, legend, ..self.plane("What the clutch does") }
    }
}

/// Edges between values that rise, half way.
fn edges(values: &[f64]) -> Vec<f64> {
    let [Some(first), Some(last)] = [values.first(), values.last()] else { return Vec::new() };
    let between = values.windows(2).map(|w| 0.5 * (w[0] + w[1]));
    let half = |a: usize| values.get(a + 1).map_or(0.5, |next| 0.5 * (next - values[a]));
    // Neither is negative.
    let ends = [(first - half(0)).max(0.0), last + half(values.len().saturating_sub(2))];
    std::iter::once(ends[0]).chain(between).chain([ends[1]]).collect()
}
