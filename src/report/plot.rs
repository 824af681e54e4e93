//! XY plots: axes, grid and curves; the legend and the labels of markers stand above the frame, where they can
//! cover no curve.

mod axis;
mod scale;
mod style;

use super::svg::{Anchor, INK, PHONE_PX, RULE, SOFT, Svg, begin_within, for_both, polyline, text_width};
use scale::{Extent, thinned};
use style::{Style, styles};

pub(super) use axis::{Axis, draw_below, draw_left, left_px};

/// How a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Dash {
    /// Full line.
    #[default]
    Solid,
    /// Dashes.
    Dashed,
    /// Dots.
    Dotted,
    /// A thin grey line, for what is to be seen and not to be told apart. A curve like the one before it has no place in the
    /// legend of its own.
    Faint,
}

/// One named curve, in the units of the axis titles.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Name in the legend.
    pub name: String,
    /// Points; one that is not finite interrupts the line (on a logarithmic axis also one that is not positive).
    pub points: Vec<[f64; 2]>,
    /// Line style.
    pub dash: Dash,
    /// Draw the points as dots too, for few computed points.
    pub dots: bool,
    /// Place of its colour in the series, for what keeps its colour in several plots; else by its place in the plot.
    pub colour: Option<usize>,
}

impl Curve {
    /// A full line.
    pub fn new(name: &str, points: Vec<[f64; 2]>) -> Self {
        Self { name: name.to_owned(), points, dash: Dash::Solid, dots: false, colour: None }
    }
}

impl Curve {
    /// The same in the colour at that place of the series.
    pub fn coloured(self, colour: usize) -> Self {
        Self { colour: Some(colour), ..self }
    }
}

/// A vertical line with a label, e.g. a junction.
#[derive(Debug, Clone, PartialEq)]
pub struct Marker {
    /// Place on the x axis, in its unit.
    pub at: f64,
    /// Label.
    pub label: String,
}

/// A plot under construction.
#[derive(Debug, Clone, PartialEq)]
pub struct Plot {
    /// Title of the x axis with its unit.
    pub x_title: String,
    /// Title of the y axis with its unit.
    pub y_title: String,
    /// Curves, drawn in this order.
    pub curves: Vec<Curve>,
    /// Vertical lines.
    pub markers: Vec<Marker>,
    /// Horizontal lines, e.g. an allowable.
    pub levels: Vec<Marker>,
    /// Logarithmic x axis.
    pub log_x: bool,
    /// Logarithmic y axis.
    pub log_y: bool,
    /// Size in px; the page scales it down where it is narrower.
    pub size_px: [f64; 2],
}

const TEXT_PX: f64 = 12.0;
/// Room for the title above legend and frame.
const TITLE_PX: f64 = 19.0;
const ROW_PX: f64 = 17.0;
/// Left margin of figures with an axis.
pub(super) const LEFT_PX: f64 = 66.0;
/// Right margin of figures with an axis.
pub(super) const RIGHT_PX: f64 = 18.0;
const BOTTOM_PX: f64 = 50.0;
const MARKER_ROWS: usize = 3;
/// Room for the text of a tick of an x axis.
pub(super) const PITCH_X_PX: f64 = 60.0;
/// The same on a linear y axis, and on a logarithmic one, where every power of ten is wanted.
const PITCH_Y_PX: [f64; 2] = [32.0, 18.0];

impl Plot {
    /// An empty plot with linear axes.
    pub fn new(x_title: &str, y_title: &str) -> Self {
        Self {
            x_title: x_title.to_owned(),
            y_title: y_title.to_owned(),
            curves: Vec::new(),
            markers: Vec::new(),
            levels: Vec::new(),
            log_x: false,
            log_y: false,
            size_px: [720.0, 380.0],
        }
    }

    /// Add a full-line curve.
    pub fn curve(mut self, name: &str, points: Vec<[f64; 2]>) -> Self {
        self.curves.push(Curve::new(name, points));
        self
    }

    /// Add a vertical line with its label.
    pub fn marker(mut self, at: f64, label: &str) -> Self {
        self.markers.push(Marker { at, label: label.to_owned() });
        self
    }

    /// Add a horizontal line with its label.
    pub fn level(mut self, at: f64, label: &str) -> Self {
        self.levels.push(Marker { at, label: label.to_owned() });
        self
    }

    /// The size in px.
    pub fn sized(mut self, width_px: f64, height_px: f64) -> Self {
        self.size_px = [width_px, height_px];
        self
    }

    /// Where the frame of a plot of this width begins and ends, as parts of it.
    pub fn frame(width_px: f64) -> [f64; 2] {
        [LEFT_PX / width_px, 1.0 - RIGHT_PX / width_px]
    }

    /// The SVG. Curves without a single drawable point stay in the legend, named as having no data.
    pub fn to_svg(&self) -> String {
        let [width, height] = self.size_px;
        let extent = self.extent();
        let [x_range, y_range] = extent.ranges(self.log_x, self.log_y);
        let legend = self.legend_rows();
        let left = self.left_px(y_range, height);
        let x = Axis { log: self.log_x, range: x_range, px: [left, width - RIGHT_PX] }.begun(PITCH_X_PX);
        let markers = self.placed_markers(&x, &extent);
        let marker_rows = markers.iter().filter_map(|m| m.2).max().map_or(0, |row| row + 1);
        let title = self.title();
        let title_px = if title.is_empty() { 0.0 } else { TITLE_PX };
        let top_px = 10.0 + title_px + ROW_PX * (legend.len() + marker_rows) as f64;
        let y = Axis { log: self.log_y, range: y_range, px: [height - BOTTOM_PX, top_px] };
        let y = y.begun(PITCH_Y_PX[usize::from(self.log_y)]);
        let styles = styles(&self.curves);
        let mut svg = Svg::new(width, height, &format!("{} over {}", self.y_title, self.x_title));
        self.draw_axes(&mut svg, &x, &y);
        self.draw_curves(&mut svg, &x, &y, &styles);
        svg.title_text([begin_within(LEFT_PX, &title, width), 15.0], &title);
        self.draw_legend(&mut svg, &legend, &styles, title_px);
        self.draw_markers(&mut svg, &x, &markers, top_px);
        self.draw_levels(&mut svg, &x, &y, top_px);
        if extent.is_empty() {
            svg.text([width / 2.0, height / 2.0], Anchor::Middle, SOFT, "no data");
        }
        svg.finish()
    }

    /// The figure of a page.
    pub fn to_figure(&self) -> String {
        let [_, height] = self.size_px;
        let mut phone = self.clone().sized(PHONE_PX, height.min(320.0));
        // What more the legend takes is not taken from the frame.
        let more = phone.legend_rows().len().saturating_sub(self.legend_rows().len());
        phone.size_px[1] += ROW_PX * more as f64;
        for_both(&self.to_svg(), &phone.to_svg())
    }

    /// Where the frame begins: farther in where the numbers of its axis would run into their title.
    fn left_px(&self, range: [f64; 2], height: f64) -> f64 {
        let log = usize::from(self.log_y);
        let y = Axis { log: self.log_y, range, px: [height - BOTTOM_PX, ROW_PX] }.begun(PITCH_Y_PX[log]);
        axis::left_px(&y.ticks(PITCH_Y_PX[log]))
    }

    /// Where the legend begins.
    fn legend_px(&self) -> f64 {
        if self.size_px[0] > PHONE_PX { LEFT_PX } else { 2.0 }
    }

    /// What is drawn against what, without units; nothing where an axis has no name.
    fn title(&self) -> String {
        let (y, x) = (without_unit(&self.y_title), without_unit(&self.x_title));
        // A name begins small behind "against", a symbol stays.
        let mut letters = x.chars();
        let small = match (letters.next(), letters.next()) {
            (Some(first), Some(second)) if second.is_lowercase() => {
                format!("{}{}", first.to_lowercase(), &x[first.len_utf8()..])
            }
            _ => x.to_owned(),
        };
        if y.is_empty() || x.is_empty() { String::new() } else { format!("{y} against {small}") }
    }

    fn drawable(&self, &[x, y]: &[f64; 2]) -> bool {
        x.is_finite() && y.is_finite() && (!self.log_x || x > 0.0) && (!self.log_y || y > 0.0)
    }

    /// Levels that can be drawn.
    fn sound_levels(&self) -> impl Iterator<Item = &Marker> {
        self.levels.iter().filter(|l| l.at.is_finite() && (!self.log_y || l.at > 0.0))
    }

    fn extent(&self) -> Extent {
        let mut extent = Extent::default();
        let points = self.curves.iter().flat_map(|c| &c.points);
        points.filter(|p| self.drawable(p)).for_each(|p| extent.add(*p));
        // A dot on the first or last decade would lie on the frame.
        for p in self.curves.iter().filter(|c| c.dots).flat_map(|c| &c.points).filter(|p| self.drawable(p)) {
            for by in [0.9, 1.1] {
                let beside =
                    [(self.log_x, p[0]), (self.log_y, p[1])].map(|(log, v)| if log { by * v } else { v });
                extent.add(beside);
            }
        }
        for level in self.sound_levels() {
            extent.y = (extent.y.0.min(level.at), extent.y.1.max(level.at));
        }
        extent
    }

    /// Grid, frame, ticks with their texts, titles.
    fn draw_axes(&self, svg: &mut Svg, x: &Axis, y: &Axis) {
        let ([left, right], [bottom, top]) = (x.px, y.px);
        let (x_ticks, y_ticks) = (x.ticks(PITCH_X_PX), y.ticks(PITCH_Y_PX[usize::from(self.log_y)]));
        let upright = x_ticks.iter().filter(|t| !t.text.is_empty()).map(|t| [[t.px, bottom], [t.px, top]]);
        let level = y_ticks.iter().filter(|t| !t.text.is_empty()).map(|t| [[left, t.px], [right, t.px]]);
        let grid: String = upright.chain(level).map(|line| polyline(&line, false)).collect();
        svg.path(&grid, &format!("fill=\"none\" stroke=\"{RULE}\""));
        let frame = [[left, top], [right, top], [right, bottom], [left, bottom]];
        let style = format!("fill=\"none\" stroke=\"{SOFT}\"");
        svg.path(&polyline(&frame, true), &style);
        draw_below(svg, x, &x_ticks, bottom, &self.x_title, self.size_px[0]);
        draw_left(svg, y, &y_ticks, left, &self.y_title, self.size_px[1]);
    }

    /// Lines between gaps, and dots; a point alone between gaps has no line and is shown as a dot in any case.
    fn draw_curves(&self, svg: &mut Svg, x: &Axis, y: &Axis, styles: &[Style]) {
        let at = |&[px, py]: &[f64; 2]| [x.at(px), y.at(py)];
        let mut dots = Vec::new();
        for (curve, style) in self.curves.iter().zip(styles) {
            for run in curve.points.split(|p| !self.drawable(p)).filter(|run| !run.is_empty()) {
                if run.len() > 1 {
                    let line: Vec<[f64; 2]> = thinned(run, self.size_px[0]).iter().map(at).collect();
                    let width_px = if curve.dash == Dash::Faint { 1.0 } else { 1.8 };
                    svg.path(&polyline(&line, false), &style.line(width_px));
                }
                if curve.dots || run.len() == 1 {
                    dots.extend(run.iter().map(|p| (at(p), style.css())));
                }
            }
        }
        dots.into_iter().for_each(|(at, colour)| svg.dot(at, 2.8, &format!("fill=\"{colour}\"")));
    }

    /// Legend entries (index into `curves`), packed into rows.
    fn legend_rows(&self) -> Vec<Vec<(usize, f64)>> {
        let mut rows: Vec<Vec<(usize, f64)>> = Vec::new();
        if self.curves.len() < 2 && self.curves.iter().all(|c| c.name.is_empty()) {
            return rows;
        }
        let mut x = f64::INFINITY;
        let faint = |index: usize| self.curves.get(index).is_some_and(|c| c.dash == Dash::Faint);
        for index in (0..self.curves.len()).filter(|&index| !(faint(index) && faint(index.wrapping_sub(1)))) {
            let width = 34.0 + text_width(&self.legend_name(index), TEXT_PX) + 14.0;
            if x + width > self.size_px[0] - RIGHT_PX || rows.is_empty() {
                rows.push(Vec::new());
                x = self.legend_px();
            }
            if let Some(row) = rows.last_mut() {
                row.push((index, x));
            }
            x += width;
        }
        rows
    }

    fn legend_name(&self, index: usize) -> String {
        let Some(curve) = self.curves.get(index) else { return String::new() };
        let empty = curve.points.iter().all(|p| !(p[0].is_finite() && p[1].is_finite()));
        if empty { format!("{} (no data)", curve.name) } else { curve.name.clone() }
    }

    fn draw_legend(&self, svg: &mut Svg, rows: &[Vec<(usize, f64)>], styles: &[Style], title_px: f64) {
        for (number, row) in rows.iter().enumerate() {
            let y = 14.0 + title_px + ROW_PX * number as f64;
            for &(index, x) in row {
                let Some(style) = styles.get(index) else { continue };
                svg.line([x, y - 4.0], [x + 26.0, y - 4.0], &style.line(2.4));
                svg.bare_text([x + 32.0, y], Anchor::Start, INK, &self.legend_name(index));
            }
        }
    }

    /// Markers within the data, each with the middle of its label (px) and the label's row above the frame;
    /// no row where the labels crowd: then the line stays and the label goes, nothing is overprinted.
    fn placed_markers<'a>(&'a self, x: &Axis, extent: &Extent) -> Vec<(&'a Marker, f64, Option<usize>)> {
        let inside = |m: &&Marker| m.at >= extent.x.0 && m.at <= extent.x.1 && (!self.log_x || m.at > 0.0);
        let mut shown: Vec<&Marker> = self.markers.iter().filter(inside).collect();
        shown.sort_by(|a, b| a.at.total_cmp(&b.at));
        let mut free_from = [f64::NEG_INFINITY; MARKER_ROWS];
        let place = |marker: &'a Marker| {
            let half = text_width(&marker.label, TEXT_PX) / 2.0;
            let middle = axis::within(x.at(marker.at), &marker.label, self.size_px[0]);
            let row = free_from.iter().position(|&free| free < middle - half - 4.0);
            if let Some(free) = row.and_then(|r| free_from.get_mut(r)) {
                *free = middle + half;
            }
            (marker, middle, row)
        };
        shown.into_iter().map(place).collect()
    }

    fn draw_markers(&self, svg: &mut Svg, x: &Axis, markers: &[(&Marker, f64, Option<usize>)], top_px: f64) {
        let style = format!("fill=\"none\" stroke=\"{SOFT}\" stroke-dasharray=\"4 3\"");
        for &(marker, middle, row) in markers {
            let at = x.at(marker.at);
            let y = top_px - 5.0 - ROW_PX * row.unwrap_or(0) as f64;
            let from = if row.is_some() { y + 2.0 } else { top_px };
            svg.line([at, from], [at, self.size_px[1] - BOTTOM_PX], &style);
            if row.is_some() {
                svg.text([middle, y], Anchor::Middle, SOFT, &marker.label);
            }
        }
    }

    fn draw_levels(&self, svg: &mut Svg, x: &Axis, y: &Axis, top_px: f64) {
        let [left, right] = x.px;
        let style = format!("fill=\"none\" stroke=\"{SOFT}\" stroke-width=\"1.2\" stroke-dasharray=\"7 4\"");
        for level in self.sound_levels() {
            let at = y.at(level.at);
            svg.line([left, at], [right, at], &style);
            let above = at >= top_px + ROW_PX;
            let heights = if above { [at - 5.0, at + 14.0] } else { [at + 14.0, at + 14.0] };
            let ends = [(right - 5.0, Anchor::End), (left + 5.0, Anchor::Start)];
            let wide = text_width(&level.label, TEXT_PX);
            // At the right end above its line, or where no curve runs through it.
            let mut places = heights.into_iter().flat_map(|h| ends.map(|(end, anchor)| ([end, h], anchor)));
            let first = ([right - 5.0, heights[0]], Anchor::End);
            let free = |([end, h], anchor): &([f64; 2], Anchor)| {
                let from = if matches!(anchor, Anchor::End) { end - wide } else { *end };
                h + 3.0 < y.px[0]
                    && !self.crosses(x, y, [from - 2.0, from + wide + 2.0], [h - TEXT_PX, h + 3.0])
            };
            let (place, anchor) = places.find(free).unwrap_or(first);
            svg.text(place, anchor, SOFT, &level.label);
        }
    }

    /// Whether a curve runs through a box, px.
    fn crosses(&self, x: &Axis, y: &Axis, wide: [f64; 2], high: [f64; 2]) -> bool {
        /// Places looked at between two points.
        const BETWEEN: usize = 16;
        let inside = |[a, b]: [f64; 2]| wide[0] <= a && a <= wide[1] && high[0] <= b && b <= high[1];
        let px = |&[a, b]: &[f64; 2]| [x.at(a), y.at(b)];
        let between = |pair: &[[f64; 2]]| {
            let [a, b] = [px(&pair[0]), px(&pair[1])];
            (0..=BETWEEN).any(|i| {
                let t = i as f64 / BETWEEN as f64;
                inside([a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])])
            })
        };
        self.curves
            .iter()
            .flat_map(|c| c.points.split(|p| !self.drawable(p)))
            .any(|run| run.iter().any(|p| inside(px(p))) || run.windows(2).any(between))
    }
}

/// The name in an axis title: what stands before the unit.
fn without_unit(title: &str) -> &str {
    const UNITS: [&str; 24] = [
        "°C", "°", "deg", "rad", "mrad", "Nm", "mNm", "Nm/rad", "N", "kN", "MPa", "GPa", "mm", "µm", "m",
        "ms", "s", "Hz", "rpm", "rad/s", "%", "g", "W", "J",
    ];
    match title.rsplit_once(", ") {
        Some((name, unit)) if UNITS.contains(&unit) => name,
        _ => title,
    }
}

#[cfg(test)]
mod tests;
