//! Horizontal bars with their names on the left: margins against zero, torque capacities against a torque.

use super::svg::{Anchor, BAD, GOOD, INK, PHONE_PX, SERIES, SOFT, Svg, for_both, polyline, text_width};

/// What a bar's colour says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tone {
    /// Held.
    Good,
    /// Not held.
    Bad,
    /// Shown only.
    Soft,
    /// No verdict.
    Plain,
}

/// One bar.
#[derive(Debug, Clone, PartialEq)]
pub struct Bar {
    /// Name on the left.
    pub label: String,
    /// Length, in the unit of the title; one that is not finite is not drawn, its text stays.
    pub value: f64,
    /// Text on the right.
    pub text: String,
    /// Colour.
    pub tone: Tone,
}

/// A chart of bars, one below the other.
#[derive(Debug, Clone, PartialEq)]
pub struct Bars {
    /// Title.
    pub title: String,
    /// Bars, top to bottom.
    pub bars: Vec<Bar>,
    /// Vertical lines with their labels, e.g. the peak torque; zero is always drawn.
    pub marks: Vec<(f64, String)>,
    /// Bars are cut here, with an arrow that says so.
    pub range: (f64, f64),
}

const WIDTH: f64 = 720.0;
const PITCH: f64 = 20.0;
const THICK: f64 = 11.0;
/// The title and two rows of mark labels.
const TOP: f64 = 56.0;
const LABEL_PITCH: f64 = 15.0;

impl Bars {
    /// The figure of a page.
    pub fn to_figure(&self) -> String {
        for_both(&self.to_svg(), &self.drawn(PHONE_PX))
    }

    /// The SVG.
    pub fn to_svg(&self) -> String {
        self.drawn(WIDTH)
    }

    fn drawn(&self, width: f64) -> String {
        let height = TOP + PITCH * self.bars.len() as f64 + 8.0;
        let mut svg = Svg::new(width, height, &self.title);
        svg.title_text([8.0, 15.0], &self.title);
        let widest =
            |texts: &mut dyn Iterator<Item = &String>| texts.map(|t| text_width(t, 12.0)).fold(0.0, f64::max);
        let left = 8.0 + widest(&mut self.bars.iter().map(|b| &b.label));
        let right = width - 8.0 - widest(&mut self.bars.iter().map(|b| &b.text));
        let (low, high) = (self.range.0.min(0.0), self.range.1.max(0.0));
        let span = if high - low > 0.0 { high - low } else { 1.0 };
        let x = |value: f64| {
            left + 6.0 + (right - left - 12.0) * ((value.clamp(low, high) - low) / span).clamp(0.0, 1.0)
        };
        for (row, bar) in self.bars.iter().enumerate() {
            let middle = TOP + PITCH * (row as f64 + 0.5);
            svg.bare_text([left, middle + 4.0], Anchor::End, INK, &bar.label);
            svg.bare_text([right, middle + 4.0], Anchor::Start, colour(bar.tone), &bar.text);
            if bar.value.is_finite() {
                draw_bar(&mut svg, x(0.0), x(bar.value), middle, bar, (low, high));
            }
        }
        let zero = (0.0, "0".to_owned());
        let bottom = height - 6.0;
        let mut marks: Vec<&(f64, String)> = self.marks.iter().chain([&zero]).collect();
        marks.retain(|m| m.0 >= low && m.0 <= high);
        marks.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut free_from = [f64::NEG_INFINITY; 2];
        for (at, label) in marks {
            let (at, dash) = (x(*at), if *at == 0.0 { "" } else { " stroke-dasharray=\"4 3\"" });
            let half = text_width(label, 12.0) / 2.0;
            // Where both rows are taken the line stays and the label goes: nothing is overprinted.
            let row = free_from.iter().position(|&free| at - half > free);
            let raised = LABEL_PITCH * row.unwrap_or(0) as f64;
            svg.line(
                [at, TOP - 4.0 - raised],
                [at, bottom],
                &format!("fill=\"none\" stroke=\"{SOFT}\" stroke-width=\"1\"{dash}"),
            );
            if let Some(free) = row.and_then(|r| free_from.get_mut(r)) {
                svg.bare_text([at, TOP - 9.0 - raised], Anchor::Middle, SOFT, label);
                *free = at + half + 6.0;
            }
        }
        svg.finish()
    }
}

fn draw_bar(svg: &mut Svg, zero: f64, end: f64, middle: f64, bar: &Bar, (low, high): (f64, f64)) {
    let (up, down) = (middle - THICK / 2.0, middle + THICK / 2.0);
    // A margin of zero is still a mark on the line.
    let end = if (end - zero).abs() < 1.5 { zero + 1.5_f64.copysign(bar.value) } else { end };
    let tip = if bar.value > high {
        [end + 5.0, middle]
    } else if bar.value < low {
        [end - 5.0, middle]
    } else {
        [end, middle]
    };
    let style = format!("fill=\"{}\" fill-opacity=\"0.8\"", colour(bar.tone));
    svg.path(&polyline(&[[zero, up], [end, up], tip, [end, down], [zero, down]], true), &style);
}

fn colour(tone: Tone) -> &'static str {
    match tone {
        Tone::Good => GOOD,
        Tone::Bad => BAD,
        Tone::Soft => SOFT,
        Tone::Plain => SERIES[0],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bar(label: &str, value: f64) -> Bar {
        Bar { label: label.into(), value, text: format!("{value}"), tone: Tone::Good }
    }

    #[test]
    fn long_bars_are_cut_with_an_arrow_and_infinite_ones_keep_their_text() {
        let bars = |value| Bars {
            title: "<margins>".into(),
            bars: vec![bar("a&b", 0.5), bar("long", value)],
            marks: vec![(1.0, "wanted".into()), (7.0, "outside".into())],
            range: (-1.0, 2.0),
        };
        let points = |svg: &str| svg.matches('L').count();
        let (inside, beyond) = (bars(1.9).to_svg(), bars(7.0).to_svg());
        assert!(inside.contains("a&amp;b") && inside.contains("wanted") && !inside.contains("outside"));
        assert_eq!(inside.matches("<path").count(), 2 + 2);
        assert_eq!(points(&inside), points(&beyond), "the tip is always a point of the outline");
        let infinite = bars(f64::INFINITY).to_svg();
        assert!(infinite.contains(">inf<") && infinite.matches("<path").count() == 1 + 2);
        assert!(!infinite.contains("NaN"));
    }

    #[test]
    fn nothing_to_compare_is_no_panic() {
        let svg = Bars { title: String::new(), bars: vec![], marks: vec![], range: (0.0, 0.0) }.to_svg();
        assert!(svg.starts_with("<svg") && !svg.contains("NaN"));
    }
}
