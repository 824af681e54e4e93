//! The few SVG pieces that the drawings need; coordinates in px, y down.

use super::page::escape;
use std::fmt::Write as _;

/// An SVG under construction.
pub struct Svg {
    width: f64,
    height: f64,
    title: String,
    body: String,
}

/// Where a text's point lies on it.
#[derive(Clone, Copy)]
pub enum Anchor {
    Start,
    Middle,
    End,
}

/// A coordinate with two decimals and no trailing zeros; a number that is none becomes 0, so that no
/// NaN ever reaches a file.
pub fn px(value: f64) -> String {
    if !value.is_finite() {
        return "0".to_owned();
    }
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Path data through `points`, closed or open.
pub fn polyline(points: &[[f64; 2]], closed: bool) -> String {
    let mut d = String::new();
    let mut last = None;
    for &[x, y] in points {
        let here = (px(x), px(y));
        if last.as_ref() == Some(&here) {
            continue;
        }
        let _ = write!(d, "{}{} {}", if last.is_none() { "M" } else { "L" }, here.0, here.1);
        last = Some(here);
    }
    if closed && !d.is_empty() {
        d.push('Z');
    }
    d
}

/// Path data of a rectangle from its upper left corner.
pub fn rectangle([x, y]: [f64; 2], [width, height]: [f64; 2]) -> String {
    format!("M{} {}h{}v{}h-{}Z", px(x), px(y), px(width), px(height), px(width))
}

/// Path data of a full circle.
pub fn circle(centre: [f64; 2], radius: f64) -> String {
    let [x, y] = centre;
    let r = px(radius);
    let (left, right, y) = (px(x - radius), px(x + radius), px(y));
    format!("M{left} {y}A{r} {r} 0 1 0 {right} {y}A{r} {r} 0 1 0 {left} {y}Z")
}

impl Svg {
    pub fn new(width: f64, height: f64, title: &str) -> Self {
        Self { width, height, title: title.to_owned(), body: String::new() }
    }

    /// Make it so high, px.
    pub fn reach(&mut self, height: f64) {
        self.height = height;
    }

    /// A path; `style` holds attributes (`fill="…" stroke="…"`).
    pub fn path(&mut self, d: &str, style: &str) {
        let _ = writeln!(self.body, "<path d=\"{d}\" {style}/>");
    }

    /// Begin a group of this class; `more` holds further attributes.
    pub fn open(&mut self, class: &str, more: &str) {
        let _ = writeln!(self.body, "<g class=\"{class}\" {more}>");
    }

    /// Begin a part of the figure that is cut at its edges, its own origin at `at`.
    pub fn open_part(&mut self, at: [f64; 2], size: [f64; 2]) {
        let ([x, y], [w, h]) = (at.map(px), size.map(px));
        let _ = writeln!(self.body, "<svg x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\">");
    }

    /// End the part.
    pub fn close_part(&mut self) {
        self.body.push_str("</svg>\n");
    }

    /// End the group.
    pub fn close(&mut self) {
        self.body.push_str("</g>\n");
    }

    pub fn line(&mut self, from: [f64; 2], to: [f64; 2], style: &str) {
        self.path(&polyline(&[from, to], false), style);
    }

    pub fn dot(&mut self, at: [f64; 2], radius: f64, style: &str) {
        let _ = writeln!(
            self.body,
            "<circle cx=\"{}\" cy=\"{}\" r=\"{}\" {style}/>",
            px(at[0]),
            px(at[1]),
            px(radius)
        );
    }

    /// Text with a halo of paper colour, so that it stays legible across lines.
    pub fn text(&mut self, at: [f64; 2], anchor: Anchor, colour: &str, text: &str) {
        let halo = format!(
            " stroke=\"{PAPER}\" stroke-width=\"3\" stroke-linejoin=\"round\" paint-order=\"stroke\""
        );
        self.write(at, anchor, colour, &halo, text);
    }

    /// Text on a plain ground.
    pub fn bare_text(&mut self, at: [f64; 2], anchor: Anchor, colour: &str, text: &str) {
        self.write(at, anchor, colour, "", text);
    }

    /// A heading on a plain ground.
    pub fn title_text(&mut self, at: [f64; 2], text: &str) {
        self.write(at, Anchor::Start, INK, " font-weight=\"600\"", text);
    }

    /// Text that reads upwards, its middle at `at`.
    pub fn rising_text(&mut self, at: [f64; 2], colour: &str, text: &str) {
        let turn = format!(" transform=\"rotate(-90 {} {})\"", px(at[0]), px(at[1]));
        self.write(at, Anchor::Middle, colour, &turn, text);
    }

    fn write(&mut self, at: [f64; 2], anchor: Anchor, colour: &str, more: &str, text: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let _ = writeln!(
            self.body,
            "<text x=\"{}\" y=\"{}\" text-anchor=\"{anchor}\" fill=\"{colour}\"{more}>{}</text>",
            px(at[0]),
            px(at[1]),
            escape(text)
        );
    }

    pub fn finish(self) -> String {
        let (w, h) = (px(self.width), px(self.height));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" role=\"img\" \
             font-family=\"{FONT}\" font-size=\"12\">\n<title>{}</title>\n{}</svg>",
            escape(&self.title),
            self.body
        )
    }
}

/// Colours follow the page's (light, dark, print); the second value serves an SVG outside a page.
pub const INK: &str = "var(--ink,#1b1f24)";
pub const SOFT: &str = "var(--soft,#5b6570)";
pub const RULE: &str = "var(--rule,#d5dae0)";
pub const PAPER: &str = "var(--paper,#fff)";
pub const RACE: &str = "var(--race,#e6eaee)";
pub const BODY: &str = "var(--body,#c9d6e4)";
pub const EDGE: &str = "var(--edge,#33485f)";
pub const GOOD: &str = "var(--good,#1a7f4b)";
pub const BAD: &str = "var(--bad,#b3261e)";
/// Colours of curves and overlays, in order.
pub const SERIES: [&str; 6] = [
    "var(--c0,#1f5fa8)",
    "var(--c1,#c2571a)",
    "var(--c2,#2f8f5b)",
    "var(--c3,#8a4fa0)",
    "var(--c4,#a68a00)",
    "var(--c5,#5b6570)",
];
/// Font of all figures.
pub const FONT: &str = "system-ui, 'Segoe UI', 'Helvetica Neue', Arial, sans-serif";

/// Width of `text` in px at `size` px, on the generous side: no font is measured, so labels are given room.
pub fn text_width(text: &str, size: f64) -> f64 {
    0.58 * size * text.chars().count() as f64
}

/// Width of a figure on a phone, px: what a window of 390 px leaves it.
pub const PHONE_PX: f64 = 360.0;

/// A figure as a page has it: drawn for a window, and once more for a phone, where its texts would be too small if it shrank. The
/// page's style shows one of them.
pub fn for_both(window: &str, phone: &str) -> String {
    let classed = |svg: &str, class: &str| svg.replacen("<svg ", &format!("<svg class=\"{class}\" "), 1);
    format!("{}\n{}", classed(window, "window"), classed(phone, "phone"))
}

/// Where a text begins that should begin at `at` and is to end within a figure `width_px` wide.
pub fn begin_within(at: f64, text: &str, width_px: f64) -> f64 {
    at.min(width_px - text_width(text, 12.0) - 2.0).max(2.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_are_short_and_never_nan() {
        assert_eq!(px(1.0), "1");
        assert_eq!(px(-0.001), "0");
        assert_eq!(px(12.3456), "12.35");
        assert_eq!(px(f64::NAN), "0");
    }

    #[test]
    fn repeated_points_are_dropped() {
        assert_eq!(polyline(&[[0.0, 0.0], [0.001, 0.0], [1.0, 2.0]], true), "M0 0L1 2Z");
        assert_eq!(polyline(&[], true), "");
    }
}
