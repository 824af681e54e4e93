//! XY plots: kuva draws axes, grid and curves; legend and marker labels are placed here, above the
//! frame, where they can cover no curve.

use super::number::significant;
use super::svg::{FONT, INK, PAPER, RULE, SERIES, SOFT, text_width};
use kuva::prelude::{Layout, LinePlot, LineStyle, Plot as KuvaPlot, SvgBackend, Theme, TickFormat, render_multiple};
use kuva::render::color::Color;
use kuva::render::layout::ComputedLayout;
use kuva::render::render::{Primitive, Scene, TextAnchor};
use std::sync::Arc;

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
}

impl Curve {
    /// A full line.
    pub fn new(name: &str, points: Vec<[f64; 2]>) -> Self {
        Self { name: name.to_owned(), points, dash: Dash::Solid, dots: false }
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
const ROW_PX: f64 = 17.0;
const LEFT_PX: f64 = 66.0;
const RIGHT_PX: f64 = 18.0;
const BOTTOM_PX: f64 = 50.0;

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

    /// The SVG. Curves without a single drawable point stay in the legend, named as having no data.
    pub fn to_svg(&self) -> String {
        let drawable = |&[x, y]: &[f64; 2]| {
            x.is_finite() && y.is_finite() && (!self.log_x || x > 0.0) && (!self.log_y || y > 0.0)
        };
        let mut plots: Vec<KuvaPlot> = Vec::new();
        let mut extent = Extent::default();
        for (index, curve) in self.curves.iter().enumerate() {
            for run in curve.points.split(|p| !drawable(p)).filter(|run| !run.is_empty()) {
                run.iter().for_each(|p| extent.add(*p));
                plots.push(
                    LinePlot::new()
                        .with_data(thinned(run, self.size_px[0]))
                        .with_color(SERIES[index % SERIES.len()])
                        .with_stroke_width(1.8)
                        .with_line_style(kuva_style(curve.dash))
                        .into(),
                );
            }
        }
        for level in self.levels.iter().filter(|l| l.at.is_finite() && (!self.log_y || l.at > 0.0)) {
            extent.y = (extent.y.0.min(level.at), extent.y.1.max(level.at));
        }
        let legend = self.legend_rows();
        let markers = if extent.is_empty() { Vec::new() } else { self.shown_markers(&extent) };
        let marker_px = if markers.is_empty() { 0.0 } else { ROW_PX };
        let top_px = 10.0 + ROW_PX * legend.len() as f64 + marker_px * self.marker_row_count() as f64;
        let (x_range, y_range) = extent.ranges(self.log_x, self.log_y);
        let layout = self.layout(x_range, y_range, top_px);
        let computed = ComputedLayout::from_layout(&layout);
        let scene = &mut render_multiple(plots, layout);
        // The axes enclose every point, so nothing needs clipping; kuva's clip ids come from a counter of
        // the process: they would clash between figures and make a page depend on what was drawn before.
        scene.defs.clear();
        scene.elements.retain(|e| !matches!(e, Primitive::ClipStart { .. } | Primitive::ClipEnd));
        self.draw_dots(scene, &computed, drawable);
        self.draw_legend(scene, &legend);
        self.draw_markers(scene, &computed, &markers, top_px);
        self.draw_levels(scene, &computed);
        if extent.is_empty() {
            add_text(scene, [self.size_px[0] / 2.0, self.size_px[1] / 2.0], TextAnchor::Middle, SOFT, "no data");
        }
        self.inline(&SvgBackend::new().render_scene(scene))
    }

    fn layout(&self, x_range: (f64, f64), y_range: (f64, f64), top_px: f64) -> Layout {
        let theme = Theme {
            background: "none".into(),
            axis_color: SOFT.into(),
            grid_color: RULE.into(),
            tick_color: SOFT.into(),
            text_color: INK.into(),
            font_family: Some(FONT.into()),
            ..Theme::light()
        };
        let format = |range: (f64, f64)| {
            // One rule for all ticks of an axis: digits from the range, so that 0.5 and 1.0 stand side by side.
            let largest = range.0.abs().max(range.1.abs());
            let span = range.1 - range.0;
            TickFormat::Custom(Arc::new(move |v: f64| tick(v, span, largest)))
        };
        let mut layout = Layout::new(x_range, y_range)
            .with_theme(theme)
            .with_width(self.size_px[0])
            .with_height(self.size_px[1])
            .with_x_label(self.x_title.clone())
            .with_y_label(self.y_title.clone())
            .with_tick_size(TEXT_PX as u32)
            .with_label_size(TEXT_PX as u32 + 1)
            .with_body_size(TEXT_PX as u32)
            .with_box_axes()
            .with_force_margins(LEFT_PX, RIGHT_PX)
            .with_force_margins_y(top_px, BOTTOM_PX)
            .with_x_axis_min(x_range.0)
            .with_x_axis_max(x_range.1)
            .with_y_axis_min(y_range.0)
            .with_y_axis_max(y_range.1);
        if self.log_x {
            layout = layout.with_log_x();
        } else {
            layout = layout.with_x_tick_format(format(x_range));
        }
        if self.log_y {
            layout = layout.with_log_y();
        } else {
            layout = layout.with_y_tick_format(format(y_range));
        }
        layout
    }

    /// Legend entries (index into `curves`), packed into rows.
    fn legend_rows(&self) -> Vec<Vec<(usize, f64)>> {
        let mut rows: Vec<Vec<(usize, f64)>> = Vec::new();
        if self.curves.len() < 2 && self.curves.iter().all(|c| c.name.is_empty()) {
            return rows;
        }
        let mut x = f64::INFINITY;
        for (index, _) in self.curves.iter().enumerate() {
            let width = 34.0 + text_width(&self.legend_name(index), TEXT_PX) + 14.0;
            if x + width > self.size_px[0] - RIGHT_PX || rows.is_empty() {
                rows.push(Vec::new());
                x = LEFT_PX;
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

    fn draw_legend(&self, scene: &mut Scene, rows: &[Vec<(usize, f64)>]) {
        for (number, row) in rows.iter().enumerate() {
            let y = 14.0 + ROW_PX * number as f64;
            for &(index, x) in row {
                let dash = self.curves.get(index).map(|c| kuva_style(c.dash)).and_then(|s| s.dasharray());
                scene.add(Primitive::Line {
                    x1: x,
                    y1: y - 4.0,
                    x2: x + 26.0,
                    y2: y - 4.0,
                    stroke: Color::from(SERIES[index % SERIES.len()]),
                    stroke_width: 2.4,
                    stroke_dasharray: dash,
                });
                add_text(scene, [x + 32.0, y], TextAnchor::Start, INK, &self.legend_name(index));
            }
        }
    }

    fn draw_dots(&self, scene: &mut Scene, computed: &ComputedLayout, drawable: impl Fn(&[f64; 2]) -> bool) {
        for (index, curve) in self.curves.iter().enumerate() {
            // A point alone between gaps has no line: it is shown as a dot in any case.
            let alone = |i: usize| {
                let gap = |j: Option<usize>| j.and_then(|j| curve.points.get(j)).is_none_or(|p| !drawable(p));
                gap(i.checked_sub(1)) && gap(i.checked_add(1))
            };
            for (i, point) in curve.points.iter().enumerate() {
                if drawable(point) && (curve.dots || alone(i)) {
                    scene.add(Primitive::Circle {
                        cx: computed.map_x(point[0]),
                        cy: computed.map_y(point[1]),
                        r: 2.8,
                        fill: Color::from(SERIES[index % SERIES.len()]),
                        fill_opacity: None,
                        stroke: None,
                        stroke_width: None,
                    });
                }
            }
        }
    }

    fn shown_markers(&self, extent: &Extent) -> Vec<&Marker> {
        let inside = |m: &&Marker| m.at >= extent.x.0 && m.at <= extent.x.1 && (!self.log_x || m.at > 0.0);
        let mut shown: Vec<&Marker> = self.markers.iter().filter(inside).collect();
        shown.sort_by(|a, b| a.at.total_cmp(&b.at));
        shown
    }

    /// Rows kept free for marker labels: two let neighbours stand above one another.
    fn marker_row_count(&self) -> usize {
        self.markers.len().min(3)
    }

    fn draw_markers(&self, scene: &mut Scene, computed: &ComputedLayout, markers: &[&Marker], top_px: f64) {
        let rows = self.marker_row_count();
        let mut free_from = vec![f64::NEG_INFINITY; rows];
        for marker in markers {
            let x = computed.map_x(marker.at);
            let half = text_width(&marker.label, TEXT_PX) / 2.0;
            // Kept inside the figure: a label near the edge leans inwards.
            let centre = x.clamp(LEFT_PX + half - 40.0, (self.size_px[0] - half - 2.0).max(LEFT_PX));
            let row = (0..rows).find(|&r| free_from[r] < centre - half - 4.0);
            let y_top = top_px - 5.0 - ROW_PX * row.unwrap_or(0) as f64;
            scene.add(Primitive::Line {
                x1: x,
                y1: if row.is_some() { y_top + 2.0 } else { top_px },
                x2: x,
                y2: self.size_px[1] - BOTTOM_PX,
                stroke: Color::from(SOFT),
                stroke_width: 1.0,
                stroke_dasharray: Some("4 3".into()),
            });
            // Where markers crowd beyond the rows the line stays and the label goes: no overprinting.
            if let Some(row) = row {
                free_from[row] = centre + half;
                add_text(scene, [centre, y_top], TextAnchor::Middle, SOFT, &marker.label);
            }
        }
    }

    fn draw_levels(&self, scene: &mut Scene, computed: &ComputedLayout) {
        for level in self.levels.iter().filter(|l| l.at.is_finite() && (!self.log_y || l.at > 0.0)) {
            let y = computed.map_y(level.at);
            let right = self.size_px[0] - RIGHT_PX;
            scene.add(Primitive::Line {
                x1: LEFT_PX,
                y1: y,
                x2: right,
                y2: y,
                stroke: Color::from(SOFT),
                stroke_width: 1.2,
                stroke_dasharray: Some("7 4".into()),
            });
            add_text(scene, [right - 5.0, y - 5.0], TextAnchor::End, SOFT, &level.label);
        }
    }

    /// kuva's SVG made fit for a page: scaled by its viewBox and titled for screen readers.
    fn inline(&self, svg: &str) -> String {
        let [w, h] = self.size_px;
        let (_, inner) = svg.split_once("-->").unwrap_or(("", svg));
        let title = super::page::escape(&format!("{} over {}", self.y_title, self.x_title));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" role=\"img\" \
             font-family=\"{FONT}\" fill=\"{INK}\">\n<title>{title}</title>{inner}"
        )
    }
}

fn add_text(scene: &mut Scene, at: [f64; 2], anchor: TextAnchor, colour: &str, content: &str) {
    scene.add(Primitive::Text {
        x: at[0],
        y: at[1],
        content: content.to_owned(),
        size: TEXT_PX as u32,
        anchor,
        rotate: None,
        bold: false,
        color: Some(Color::from(colour)),
    });
}

fn kuva_style(dash: Dash) -> LineStyle {
    match dash {
        Dash::Solid => LineStyle::Solid,
        Dash::Dashed => LineStyle::Dashed,
        Dash::Dotted => LineStyle::Dotted,
    }
}

/// `run` with no more points than the eye can tell apart: of each half pixel of index the first, the
/// lowest, the highest and the last stay, so no peak is lost.
fn thinned(run: &[[f64; 2]], width_px: f64) -> Vec<(f64, f64)> {
    let columns = (2.0 * width_px).max(1.0) as usize;
    let pair = |p: &[f64; 2]| (p[0], p[1]);
    if run.len() <= 4 * columns {
        return run.iter().map(pair).collect();
    }
    let mut kept = Vec::with_capacity(4 * columns);
    for chunk in run.chunks(run.len().div_ceil(columns)) {
        let by_y = |a: &usize, b: &usize| chunk[*a][1].total_cmp(&chunk[*b][1]);
        let lowest = (0..chunk.len()).min_by(by_y).unwrap_or(0);
        let highest = (0..chunk.len()).max_by(by_y).unwrap_or(0);
        let mut stay = vec![0, lowest, highest, chunk.len() - 1];
        stay.sort_unstable();
        stay.dedup();
        kept.extend(stay.into_iter().map(|i| pair(&chunk[i])));
    }
    kept
}

/// A tick's text: as many decimals as the spacing of the axis needs.
fn tick(value: f64, span: f64, largest: f64) -> String {
    if !(largest > 0.0 && span > 0.0) {
        return significant(value, 3);
    }
    if !(1e-3..1e6).contains(&largest) {
        return if value.abs() < 1e-9 * largest { "0".to_owned() } else { short_scientific(value) };
    }
    // Some five to ten ticks per axis, steps of 1, 2, 2.5 or 5: two digits below the span's power of ten.
    let decimals = (1.0 - span.log10().floor()).max(0.0) as usize;
    let text = format!("{:.*}", (decimals + 1).min(9), value);
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    let text = if text == "-0" { "0" } else { text };
    text.replace('-', "\u{2212}")
}

fn short_scientific(value: f64) -> String {
    let text = format!("{value:.2e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    format!("{}e{exponent}", mantissa.trim_end_matches('0').trim_end_matches('.'))
}

/// Smallest box around everything drawn.
struct Extent {
    x: (f64, f64),
    y: (f64, f64),
}

impl Default for Extent {
    fn default() -> Self {
        let none = (f64::INFINITY, f64::NEG_INFINITY);
        Self { x: none, y: none }
    }
}

impl Extent {
    fn add(&mut self, [x, y]: [f64; 2]) {
        self.x = (self.x.0.min(x), self.x.1.max(x));
        self.y = (self.y.0.min(y), self.y.1.max(y));
    }

    fn is_empty(&self) -> bool {
        self.x.0 > self.x.1
    }

    /// Axis ranges: x exactly as far as the data, y with a little air; never of zero width.
    fn ranges(&self, log_x: bool, log_y: bool) -> ((f64, f64), (f64, f64)) {
        (widened(self.x, log_x, 0.0), widened(self.y, log_y, 0.05))
    }
}

fn widened(range: (f64, f64), log: bool, air: f64) -> (f64, f64) {
    let (low, high) = range;
    if low > high {
        return if log { (1.0, 10.0) } else { (0.0, 1.0) };
    }
    if log {
        let (low, high) = (low.log10(), high.log10());
        let low = low.floor();
        let high = if high.ceil() > low { high.ceil() } else { low + 1.0 };
        return (10f64.powf(low), 10f64.powf(high));
    }
    let span = high - low;
    if !(span > 1e-12 * low.abs().max(high.abs())) || span < 1e-14 {
        // kuva takes a span below 2e-16 for none, whatever the unit.
        let half = if low == 0.0 { 1.0 } else { 0.1 * low.abs().max(1e-12) };
        return (low - half, high + half);
    }
    // A curve that begins at zero sits on the axis.
    let bottom = if low == 0.0 { 0.0 } else { low - air * span };
    let top = if high == 0.0 { 0.0 } else { high + air * span };
    (bottom, top)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two_curves() -> Plot {
        Plot::new("Torque, Nm", "Windup, deg")
            .curve("single <arc>", (0..50).map(|i| [f64::from(i), 0.1 * f64::from(i)]).collect())
            .curve("gaps", vec![[0.0, 1.0], [1.0, f64::NAN], [2.0, 2.0], [3.0, f64::INFINITY], [4.0, 4.0]])
            .marker(12.0, "1|2")
            .marker(12.5, "2|3")
            .marker(400.0, "off the plot")
            .level(3.0, "allowed")
    }

    #[test]
    fn gaps_and_infinities_leave_no_trace_in_the_svg() {
        let svg = two_curves().to_svg();
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        assert!(svg.contains("single &lt;arc&gt;"));
        assert!(!svg.contains("off the plot"));
        // Three lone points of the second curve, each a dot.
        assert_eq!(svg.matches("<circle").count(), 3);
    }

    #[test]
    fn drawing_twice_gives_the_same_text() {
        assert_eq!(two_curves().to_svg(), two_curves().to_svg());
    }

    #[test]
    fn nothing_to_draw_is_said() {
        for points in [vec![], vec![[f64::NAN, 1.0]]] {
            let svg = Plot::new("x", "y").curve("empty", points).to_svg();
            assert!(svg.contains("no data") && !svg.contains("NaN"), "{svg}");
        }
    }

    #[test]
    fn logarithmic_axes_skip_what_has_no_logarithm() {
        let mut plot = Plot::new("Run time, s", "Error").curve("method", vec![[0.0, 1.0], [1e-3, 1e-9], [1.0, 1e-3]]);
        (plot.log_x, plot.log_y) = (true, true);
        let svg = plot.to_svg();
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    }

    #[test]
    fn a_constant_curve_has_an_axis() {
        let svg = Plot::new("x", "y").curve("flat", vec![[0.0, 3.0], [1.0, 3.0]]).to_svg();
        assert!(!svg.contains("NaN"));
        let (low, high) = widened((3.0, 3.0), false, 0.05);
        assert!(low < 3.0 && high > 3.0);
    }

    #[test]
    fn the_svg_scales_and_names_no_other_place() {
        let svg = two_curves().to_svg();
        assert!(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 720 380\""));
        assert_eq!(svg.matches("http").count(), 1);
        assert!(svg.contains("role=\"img\"") && !svg.contains("<script"));
        // Ids would clash between the figures of a page.
        assert!(!svg.contains(" id="), "{svg}");
    }

    #[test]
    fn thinning_keeps_the_ends_and_every_peak() {
        let mut run: Vec<[f64; 2]> = (0..100_000).map(|i| [f64::from(i), 0.0]).collect();
        run[31_415][1] = 5.0;
        run[27_182][1] = -3.0;
        let kept = thinned(&run, 720.0);
        assert!(kept.len() < 6000 && kept[0] == (0.0, 0.0) && kept[kept.len() - 1] == (99_999.0, 0.0));
        assert!(kept.contains(&(31_415.0, 5.0)) && kept.contains(&(27_182.0, -3.0)));
        assert!(kept.is_sorted_by(|a, b| a.0 < b.0));
        assert_eq!(thinned(&run[..100], 720.0).len(), 100);
    }

    #[test]
    fn ticks_of_one_axis_agree() {
        assert_eq!(tick(0.5, 2.0, 2.0), "0.5");
        assert_eq!(tick(40.0, 100.0, 100.0), "40");
        assert_eq!(tick(-0.0, 100.0, 100.0), "0");
        assert_eq!(tick(2.5e-5, 1e-4, 1e-4), "2.5e-5");
        assert_eq!(tick(-0.0072, 0.02, 0.01), "−0.0072");
    }
}
