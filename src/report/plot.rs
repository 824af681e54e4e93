//! XY plots: kuva draws axes, grid and curves; legend and marker labels are placed here, above the
//! frame, where they can cover no curve.

mod scale;
mod style;

use super::svg::{FONT, INK, RULE, SOFT, text_width};
use kuva::prelude::{Layout, LinePlot, Plot as KuvaPlot, SvgBackend, Theme, TickFormat, render_multiple};
use kuva::render::color::Color;
use kuva::render::layout::ComputedLayout;
use kuva::render::render::{Primitive, Scene, TextAnchor};
use scale::{Extent, log_tick, one_decade, thinned, tick};
use std::sync::Arc;
use style::{Style, styles};

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
const ROW_PX: f64 = 17.0;
const LEFT_PX: f64 = 66.0;
const RIGHT_PX: f64 = 18.0;
const BOTTOM_PX: f64 = 50.0;
const MARKER_ROWS: usize = 3;
/// Smallest y that kuva shows on a logarithmic axis, with a decade of room.
const DEEPEST: f64 = 1e-9;

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
        let lift = self.lift();
        let mut lifted = self.clone();
        lifted.curves.iter_mut().flat_map(|c| &mut c.points).for_each(|p| p[1] *= lift);
        lifted.levels.iter_mut().for_each(|level| level.at *= lift);
        lifted.drawn(lift)
    }

    /// Power of ten by which all y are raised where the axis is logarithmic and goes too deep: kuva draws everything
    /// below 1e-10 at 1e-10.
    fn lift(&self) -> f64 {
        let points = self.curves.iter().flat_map(|c| &c.points).map(|p| p[1]);
        let positive = points.chain(self.levels.iter().map(|l| l.at)).filter(|&y| y > 0.0 && y.is_finite());
        let least = positive.fold(1.0, f64::min);
        if self.log_y && least < DEEPEST { 10f64.powf((DEEPEST / least).log10().ceil()) } else { 1.0 }
    }

    /// The SVG of a plot whose y are raised by `lift`, its ticks as they were.
    fn drawn(&self, lift: f64) -> String {
        let drawable = |&[x, y]: &[f64; 2]| {
            x.is_finite() && y.is_finite() && (!self.log_x || x > 0.0) && (!self.log_y || y > 0.0)
        };
        let mut plots: Vec<KuvaPlot> = Vec::new();
        let mut extent = Extent::default();
        let styles = styles(&self.curves);
        for (curve, style) in self.curves.iter().zip(&styles) {
            for run in curve.points.split(|p| !drawable(p)).filter(|run| !run.is_empty()) {
                run.iter().for_each(|p| extent.add(*p));
                plots.push(
                    LinePlot::new()
                        .with_data(thinned(run, self.size_px[0]))
                        .with_color(style.css())
                        .with_stroke_width(1.8)
                        .with_line_style(style.line())
                        .into(),
                );
            }
        }
        for level in self.levels.iter().filter(|l| l.at.is_finite() && (!self.log_y || l.at > 0.0)) {
            extent.y = (extent.y.0.min(level.at), extent.y.1.max(level.at));
        }
        let legend = self.legend_rows();
        let (x_range, y_range) = extent.ranges(self.log_x, self.log_y);
        // Left and right margins are fixed, so where a marker comes to stand is known before the top margin is.
        let ruler = ComputedLayout::from_layout(&self.layout(x_range, y_range, 0.0, lift));
        let markers = self.placed_markers(|x| ruler.map_x(x), &extent);
        let marker_rows = markers.iter().filter_map(|m| m.2).max().map_or(0, |row| row + 1);
        let top_px = 10.0 + ROW_PX * (legend.len() + marker_rows) as f64;
        let layout = self.layout(x_range, y_range, top_px, lift);
        let computed = ComputedLayout::from_layout(&layout);
        let scene = &mut render_multiple(plots, layout);
        // The axes enclose every point, so nothing needs clipping; kuva's clip ids come from a counter of
        // the process: they would clash between figures and make a page depend on what was drawn before.
        scene.defs.clear();
        scene.elements.retain(|e| !matches!(e, Primitive::ClipStart { .. } | Primitive::ClipEnd));
        self.draw_dots(scene, &computed, &styles, drawable);
        self.draw_legend(scene, &legend, &styles);
        self.draw_markers(scene, |x| computed.map_x(x), &markers, top_px);
        self.draw_levels(scene, &computed, top_px);
        if extent.is_empty() {
            add_text(
                scene,
                [self.size_px[0] / 2.0, self.size_px[1] / 2.0],
                TextAnchor::Middle,
                SOFT,
                "no data",
            );
        }
        self.inline(&SvgBackend::new().render_scene(scene))
    }

    fn layout(&self, x_range: (f64, f64), y_range: (f64, f64), top_px: f64, lift: f64) -> Layout {
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
        // Labels of an x axis run into one another sooner than those of a y axis.
        let log = |all: bool, lift: f64| TickFormat::Custom(Arc::new(log_tick(all, lift)));
        layout = match self.log_x {
            true => layout.with_log_x().with_x_tick_format(log(one_decade(x_range), 1.0)),
            false => layout.with_x_tick_format(format(x_range)),
        };
        layout = match self.log_y {
            true => layout.with_log_y().with_y_tick_format(log(true, lift)),
            false => layout.with_y_tick_format(format(y_range)),
        };
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

    fn draw_legend(&self, scene: &mut Scene, rows: &[Vec<(usize, f64)>], styles: &[Style]) {
        for (number, row) in rows.iter().enumerate() {
            let y = 14.0 + ROW_PX * number as f64;
            for &(index, x) in row {
                let Some(style) = styles.get(index) else { continue };
                scene.add(Primitive::Line {
                    x1: x,
                    y1: y - 4.0,
                    x2: x + 26.0,
                    y2: y - 4.0,
                    stroke: style.colour(),
                    stroke_width: 2.4,
                    stroke_dasharray: style.line().dasharray(),
                });
                add_text(scene, [x + 32.0, y], TextAnchor::Start, INK, &self.legend_name(index));
            }
        }
    }

    fn draw_dots(
        &self,
        scene: &mut Scene,
        computed: &ComputedLayout,
        styles: &[Style],
        drawable: impl Fn(&[f64; 2]) -> bool,
    ) {
        for (curve, style) in self.curves.iter().zip(styles) {
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
                        fill: style.colour(),
                        fill_opacity: None,
                        stroke: None,
                        stroke_width: None,
                    });
                }
            }
        }
    }

    /// Markers within the data, each with the middle of its label (px) and the label's row above the frame;
    /// no row where the labels crowd: then the line stays and the label goes, nothing is overprinted.
    fn placed_markers<'a>(
        &'a self,
        map_x: impl Fn(f64) -> f64,
        extent: &Extent,
    ) -> Vec<(&'a Marker, f64, Option<usize>)> {
        let inside = |m: &&Marker| m.at >= extent.x.0 && m.at <= extent.x.1 && (!self.log_x || m.at > 0.0);
        let mut shown: Vec<&Marker> = self.markers.iter().filter(inside).collect();
        shown.sort_by(|a, b| a.at.total_cmp(&b.at));
        let mut free_from = [f64::NEG_INFINITY; MARKER_ROWS];
        let place = |marker: &'a Marker| {
            let half = text_width(&marker.label, TEXT_PX) / 2.0;
            // Kept inside the figure: a label near the edge leans inwards.
            let middle = map_x(marker.at).min(self.size_px[0] - half - 2.0).max(half + 2.0);
            let row = free_from.iter().position(|&free| free < middle - half - 4.0);
            if let Some(free) = row.and_then(|r| free_from.get_mut(r)) {
                *free = middle + half;
            }
            (marker, middle, row)
        };
        shown.into_iter().map(place).collect()
    }

    fn draw_markers(
        &self,
        scene: &mut Scene,
        map_x: impl Fn(f64) -> f64,
        markers: &[(&Marker, f64, Option<usize>)],
        top_px: f64,
    ) {
        for &(marker, middle, row) in markers {
            let x = map_x(marker.at);
            let y = top_px - 5.0 - ROW_PX * row.unwrap_or(0) as f64;
            scene.add(Primitive::Line {
                x1: x,
                y1: if row.is_some() { y + 2.0 } else { top_px },
                x2: x,
                y2: self.size_px[1] - BOTTOM_PX,
                stroke: Color::from(SOFT),
                stroke_width: 1.0,
                stroke_dasharray: Some("4 3".into()),
            });
            if row.is_some() {
                add_text(scene, [middle, y], TextAnchor::Middle, SOFT, &marker.label);
            }
        }
    }

    fn draw_levels(&self, scene: &mut Scene, computed: &ComputedLayout, top_px: f64) {
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
            let label_y = if y < top_px + ROW_PX { y + 14.0 } else { y - 5.0 };
            add_text(scene, [right - 5.0, label_y], TextAnchor::End, SOFT, &level.label);
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

#[cfg(test)]
mod tests;
