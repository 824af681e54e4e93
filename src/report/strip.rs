//! Coloured bands over time, one row per thing observed: which state held when.

use super::plot::{Axis, LEFT_PX, PITCH_X_PX, RIGHT_PX, draw_below};
use super::svg::{Anchor, INK, PHONE_PX, RULE, SERIES, SOFT, Svg, for_both, rectangle, text_width};

/// A stretch in one state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// Begin, in the unit of the axis.
    pub from: f64,
    /// End.
    pub until: f64,
    /// Index into the states; 0 is the ordinary one, over which the others are drawn.
    pub state: usize,
}

/// Rows of spans over one axis. As wide as a [`super::Plot`] and with the same left and right margins, so that
/// both can stand one above the other.
#[derive(Debug, Clone, PartialEq)]
pub struct Strip {
    /// Title of the axis with its unit.
    pub title: String,
    /// Begin and end of the axis.
    pub range: [f64; 2],
    /// Names of the states, for the legend; at most six.
    pub states: Vec<String>,
    /// Name and spans of each row.
    pub rows: Vec<(String, Vec<Span>)>,
}

const WIDTH_PX: f64 = 720.0;
const TOP_PX: f64 = 26.0;
const ROW_PX: f64 = 24.0;
const BAND_PX: f64 = 16.0;
/// A further row of the legend.
const LEGEND_PX: f64 = 17.0;
const BOTTOM_PX: f64 = 46.0;
/// However short, a span that is not the ordinary state stays visible.
const LEAST_PX: f64 = 0.8;

fn colour(state: usize) -> &'static str {
    // The ordinary state is quiet, the others have the colours of the curves.
    if state == 0 { RULE } else { SERIES[state % SERIES.len()] }
}

impl Strip {
    /// The SVG. Shorter spans lie over longer ones of the same row, and neighbours that would fall on the same
    /// pixel are drawn once.
    pub fn to_svg(&self) -> String {
        self.drawn(WIDTH_PX)
    }

    /// The figure of a page.
    pub fn to_figure(&self) -> String {
        for_both(&self.to_svg(), &self.drawn(PHONE_PX))
    }

    fn drawn(&self, width_px: f64) -> String {
        let legend = self.placed_legend(width_px);
        let top_px = TOP_PX + LEGEND_PX * legend.last().map_or(0.0, |(_, row)| *row);
        let height = top_px + ROW_PX * self.rows.len() as f64 + BOTTOM_PX;
        let mut svg = Svg::new(width_px, height, &format!("States over {}", self.title));
        let [low, high] = self.sound_range();
        let axis = Axis { log: false, range: [low, high], px: [LEFT_PX, width_px - RIGHT_PX] };
        // As the plots above and below.
        let axis = axis.begun(PITCH_X_PX);
        let x = |at: f64| axis.at(at.clamp(low, high));
        for ((state, name), (at, row)) in self.states.iter().enumerate().zip(legend) {
            let y = LEGEND_PX * row;
            svg.path(&rectangle([at, y + 4.0], [14.0, 12.0]), &format!("fill=\"{}\"", colour(state)));
            svg.bare_text([at + 19.0, y + 14.0], Anchor::Start, INK, name);
        }
        for (number, (name, spans)) in self.rows.iter().enumerate() {
            let y = top_px + ROW_PX * number as f64;
            svg.bare_text([LEFT_PX - 8.0, y + 12.5], Anchor::End, INK, name);
            for state in 0..self.states.len() {
                // What would fall on one pixel becomes one rectangle.
                let mut bands: Vec<[f64; 2]> = Vec::new();
                for span in spans.iter().filter(|s| s.state == state && s.until > s.from) {
                    let (from, until) = (x(span.from), x(span.until).max(x(span.from) + LEAST_PX));
                    match bands.last_mut() {
                        Some(last) if from <= last[1] => last[1] = until.max(last[1]),
                        _ => bands.push([from, until]),
                    }
                }
                let d: String = bands
                    .iter()
                    .map(|[from, until]| rectangle([*from, y], [until - from, BAND_PX]))
                    .collect();
                if !d.is_empty() {
                    svg.path(&d, &format!("fill=\"{}\"", colour(state)));
                }
            }
        }
        let y = height - BOTTOM_PX + 2.0;
        svg.line([LEFT_PX, y], [width_px - RIGHT_PX, y], &format!("stroke=\"{SOFT}\" fill=\"none\""));
        draw_below(&mut svg, &axis, &axis.ticks(PITCH_X_PX), y, &self.title, width_px);
        svg.finish()
    }

    /// Place (px) and row of each state's name.
    fn placed_legend(&self, width_px: f64) -> Vec<(f64, f64)> {
        let (mut at, mut row) = (LEFT_PX, 0.0);
        let place = |name: &String| {
            let wide = 19.0 + text_width(name, 12.0) + 16.0;
            if at > LEFT_PX && at + wide > width_px {
                (at, row) = (LEFT_PX, row + 1.0);
            }
            at += wide;
            (at - wide, row)
        };
        self.states.iter().map(place).collect()
    }

    /// The range, or one that can be drawn.
    fn sound_range(&self) -> [f64; 2] {
        let [low, high] = self.range;
        if low.is_finite() && high.is_finite() && high > low { self.range } else { [0.0, 1.0] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn strip(spans: Vec<Span>) -> String {
        let states = ["stick", "slip"].map(str::to_owned).to_vec();
        Strip { title: "Time, ms".into(), range: [0.0, 300.0], states, rows: vec![("A".into(), spans)] }
            .to_svg()
    }

    #[test]
    fn a_short_span_stays_visible_and_thousands_of_them_stay_few() {
        let one = strip(vec![Span { from: 100.0, until: 100.001, state: 1 }]);
        assert!(one.contains("h0.8v16"), "{one}");
        let many = (0..30_000).map(|i| Span {
            from: 0.01 * f64::from(i),
            until: 0.01 * f64::from(i) + 0.005,
            state: 1,
        });
        let svg = strip(many.collect());
        assert!(svg.len() < 60_000, "{} bytes", svg.len());
    }

    #[test]
    fn an_empty_or_senseless_strip_is_still_a_figure() {
        let mut strip = Strip { title: "t".into(), range: [0.0, 0.0], states: vec![], rows: vec![] };
        assert!(strip.to_svg().ends_with("</svg>"));
        strip.range = [f64::NAN, 1.0];
        assert!(!strip.to_svg().contains("NaN"));
    }
}
