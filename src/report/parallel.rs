//! Parallel coordinates: an upright axis for each quantity, a line across all of them for each point.

use super::number::plain;
use super::svg::{Anchor, BAD, GOOD, INK, PHONE_PX, SOFT, Svg, for_both, polyline, text_width};

/// The figure.
#[derive(Debug, Clone, PartialEq)]
pub struct Parallel {
    /// Name and range of each axis.
    pub axes: Vec<(String, [f64; 2])>,
    /// Value on each axis, and whether the point is held; held ones are drawn last.
    pub lines: Vec<(Vec<f64>, bool)>,
}

const WIDTH_PX: f64 = 720.0;
/// Length of the axes.
const AXIS_PX: f64 = 254.0;
const TOP_PX: f64 = 26.0;
/// A row of names.
const ROW_PX: f64 = 17.0;
const TEXT_PX: f64 = 12.0;

impl Parallel {
    /// The figure of a page.
    pub fn to_figure(&self) -> String {
        for_both(&self.drawn(WIDTH_PX, 60.0, 2), &self.drawn(PHONE_PX, 34.0, 4))
    }

    /// So wide, with so much room beside the outermost axes, px; names of neighbours stand in so many rows.
    fn drawn(&self, width: f64, side: f64, rows: usize) -> String {
        let bottom = TOP_PX + AXIS_PX;
        let mut svg = Svg::new(width, bottom + 26.0 + ROW_PX * rows as f64, "Points across all variables");
        let pitch = (width - 2.0 * side) / (self.axes.len().saturating_sub(1).max(1)) as f64;
        let x = |i: usize| side + pitch * i as f64;
        let y = |value: f64, [low, high]: [f64; 2]| {
            let share = if high > low { ((value - low) / (high - low)).clamp(0.0, 1.0) } else { 0.5 };
            bottom - share * AXIS_PX
        };
        for (held, colour, opacity) in [(false, BAD, 0.22), (true, GOOD, 0.7)] {
            let lines = self.lines.iter().filter(|line| line.1 == held);
            let path: String = lines
                .map(|(values, _)| {
                    let points = self.axes.iter().zip(values).enumerate();
                    let points: Vec<[f64; 2]> = points.map(|(i, ((_, r), v))| [x(i), y(*v, *r)]).collect();
                    polyline(&points, false)
                })
                .collect();
            if !path.is_empty() {
                let style = format!("fill=\"none\" stroke=\"{colour}\" stroke-opacity=\"{opacity}\"");
                svg.path(&path, &style);
            }
        }
        for (i, (name, [low, high])) in self.axes.iter().enumerate() {
            let at = x(i);
            svg.line([at, TOP_PX], [at, bottom], &format!("fill=\"none\" stroke=\"{SOFT}\""));
            svg.text([at, TOP_PX - 8.0], Anchor::Middle, SOFT, &plain(*high, 4));
            svg.text([at, bottom + 15.0], Anchor::Middle, SOFT, &plain(*low, 4));
            let half = text_width(name, TEXT_PX) / 2.0;
            let middle = at.min(width - half - 2.0).max(half + 2.0);
            let row = bottom + 33.0 + ROW_PX * (i % rows) as f64;
            svg.bare_text([middle, row], Anchor::Middle, INK, name);
        }
        svg.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_one_kind_are_one_path_and_nothing_is_nan() {
        let axes = vec![("r, mm".to_owned(), [0.0, 1.0]), ("n".to_owned(), [3.0, 3.0])];
        let lines = vec![(vec![0.1, 3.0], true), (vec![0.5, 3.0], false), (vec![0.9, f64::NAN], true)];
        let svg = Parallel { axes, lines }.to_figure();
        assert_eq!(svg.matches("stroke-opacity").count(), 2 * 2);
        assert!(!svg.contains("NaN"));
        assert!(Parallel { axes: vec![], lines: vec![] }.to_figure().ends_with("</svg>"));
    }
}
