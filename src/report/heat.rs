//! A plane of tiles over two variables: shades of what is held and of what is not, or colours of kinds, with the border between both.

use super::plot::{Axis, LEFT_PX, PITCH_X_PX, RIGHT_PX, draw_below, draw_left, left_px};
use super::svg::{
    Anchor, BAD, GOOD, INK, PHONE_PX, RULE, SERIES, SOFT, Svg, begin_within, for_both, polyline, rectangle,
    text_width,
};
use std::collections::BTreeMap;

/// How a tile is filled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Shade {
    /// Nothing is known there.
    Blank,
    /// There is nothing to judge.
    Void,
    /// Something was looked for and not found: crossed.
    Missing,
    /// Held, from 0, barely, to [`SHADES`] - 1.
    Held(u8),
    /// Not held, from 0, barely, to [`SHADES`] - 1.
    Broken(u8),
    /// One of several kinds, as a curve of this place in a plot; the last colour stands for all others.
    Kind(usize),
}

/// Shades of one colour.
pub const SHADES: u8 = 10;
/// Kinds with a colour of their own.
pub const KINDS: usize = SERIES.len() - 1;

impl Shade {
    /// Attributes.
    fn style(self) -> String {
        let part = |k: u8| 0.22 + 0.78 * f64::from(k.min(SHADES - 1)) / f64::from(SHADES - 1);
        let fill = |colour: &str, opacity: f64| format!("fill=\"{colour}\" fill-opacity=\"{opacity:.2}\"");
        match self {
            Self::Blank => fill("none", 0.0),
            Self::Missing => format!("fill=\"none\" stroke=\"{SOFT}\" stroke-width=\"0.8\""),
            Self::Void => fill(RULE, 1.0),
            Self::Held(k) => fill(GOOD, part(k)),
            Self::Broken(k) => fill(BAD, 0.8 * part(k)),
            Self::Kind(k) => fill(SERIES[k.min(KINDS)], 0.8),
        }
    }
}

impl Shade {
    /// Path of a tile from its upper left corner: its edges, or a cross in it.
    fn outline(self, [x, y]: [f64; 2], [width, height]: [f64; 2]) -> String {
        match self {
            Self::Missing => {
                let (right, below) = (x + width, y + height);
                polyline(&[[x, y], [right, below]], false) + &polyline(&[[x, below], [right, y]], false)
            }
            _ => rectangle([x, y], [width, height]),
        }
    }
}

/// The plane.
#[derive(Debug, Clone, PartialEq)]
pub struct HeatMap {
    /// Title above the legend.
    pub title: String,
    /// Title of the x axis with its unit.
    pub x_title: String,
    /// Title of the y axis with its unit.
    pub y_title: String,
    /// Edges of the columns, rising; one more than there are columns.
    pub x_edges: Vec<f64>,
    /// Edges of the rows, rising.
    pub y_edges: Vec<f64>,
    /// Tiles row by row, from the lowest: shade, and whether it lies within the border; `None`: nobody knows.
    pub tiles: Vec<(Shade, Option<bool>)>,
    /// What shades stand for.
    pub legend: Vec<(Shade, String)>,
}

const SIZE_PX: [f64; 2] = [500.0, 400.0];
const BOTTOM_PX: f64 = 50.0;
const ROW_PX: f64 = 17.0;
const SWATCH_PX: f64 = 14.0;
const PITCH_Y_PX: f64 = 32.0;

impl HeatMap {
    /// The figure of a page.
    pub fn to_figure(&self) -> String {
        for_both(&self.to_svg(), &self.drawn([PHONE_PX, 340.0]))
    }

    /// The SVG.
    pub fn to_svg(&self) -> String {
        self.drawn(SIZE_PX)
    }

    fn drawn(&self, [width, height]: [f64; 2]) -> String {
        let legend = self.placed_legend(width);
        let rows = legend.last().map_or(0.0, |(_, _, row)| row + 1.0);
        let top = 26.0 + ROW_PX * rows;
        let range = |edges: &[f64]| match edges {
            [low, .., high] if high > low => [*low, *high],
            _ => [0.0, 1.0],
        };
        let y = Axis { log: false, range: range(&self.y_edges), px: [height - BOTTOM_PX, top] };
        let left = left_px(&y.ticks(PITCH_Y_PX));
        let x = Axis { log: false, range: range(&self.x_edges), px: [left, width - RIGHT_PX] };
        let mut svg =
            Svg::new(width, height, &format!("{}: {} over {}", self.title, self.y_title, self.x_title));
        svg.title_text([begin_within(LEFT_PX, &self.title, width), 15.0], &self.title);
        for (shade, at, row) in legend {
            let line = 26.0 + ROW_PX * row;
            let name = &self.legend[at.1].1;
            svg.path(&shade.outline([at.0, line - 2.0], [SWATCH_PX, 12.0]), &shade.style());
            svg.bare_text([at.0 + SWATCH_PX + 5.0, line + 8.0], Anchor::Start, INK, name);
        }
        if self.tiles.len() == self.columns() * self.y_edges.len().saturating_sub(1) {
            self.draw_tiles(&mut svg, &x, &y);
            self.draw_border(&mut svg, &x, &y);
        }
        let frame = rectangle([x.px[0], y.px[1]], [x.px[1] - x.px[0], y.px[0] - y.px[1]]);
        svg.path(&frame, &format!("fill=\"none\" stroke=\"{SOFT}\""));
        draw_below(&mut svg, &x, &x.ticks(PITCH_X_PX), y.px[0], &self.x_title, width);
        draw_left(&mut svg, &y, &y.ticks(PITCH_Y_PX), left, &self.y_title, height);
        svg.finish()
    }

    /// Each entry of the legend with its place: (px, number of the entry), row.
    fn placed_legend(&self, width: f64) -> Vec<(Shade, (f64, usize), f64)> {
        let (mut at, mut row) = (LEFT_PX, 0.0);
        let mut placed = Vec::new();
        for (number, (shade, name)) in self.legend.iter().enumerate() {
            let wide = SWATCH_PX + 5.0 + text_width(name, 12.0) + 12.0;
            if at > LEFT_PX && at + wide > width {
                (at, row) = (LEFT_PX, row + 1.0);
            }
            placed.push((*shade, (at, number), row));
            at += wide;
        }
        placed
    }

    fn columns(&self) -> usize {
        self.x_edges.len().saturating_sub(1)
    }

    /// One path for each shade; neighbours in a row are one rectangle.
    fn draw_tiles(&self, svg: &mut Svg, x: &Axis, y: &Axis) {
        let mut paths: BTreeMap<Shade, String> = BTreeMap::new();
        for (row, (tiles, edges)) in
            self.tiles.chunks(self.columns().max(1)).zip(self.y_edges.windows(2)).enumerate()
        {
            let mut from = 0;
            for run in tiles.chunk_by(|a, b| a.0 == b.0 && a.0 != Shade::Missing) {
                let until = from + run.len();
                let (left, right) = (x.at(self.x_edges[from]), x.at(self.x_edges[until]));
                let (bottom, top) = (y.at(edges[0]), y.at(edges[1]));
                from = until;
                // A hair of overlap, so that no line of paper shows between rows.
                let over = if row > 0 { 0.3 } else { 0.0 };
                let path = paths.entry(run[0].0).or_default();
                path.push_str(&run[0].0.outline([left, top], [right - left, bottom - top + over]));
            }
        }
        for (shade, path) in paths.iter().filter(|(shade, _)| **shade != Shade::Blank) {
            svg.path(path, &shade.style());
        }
    }

    /// A line between tiles within and tiles without.
    fn draw_border(&self, svg: &mut Svg, x: &Axis, y: &Axis) {
        let columns = self.columns();
        let within = |i: usize, j: usize| self.tiles.get(j * columns + i).and_then(|tile| tile.1);
        let differ = |a: Option<bool>, b: Option<bool>| a.zip(b).is_some_and(|(a, b)| a != b);
        let mut path = String::new();
        for j in 0..self.y_edges.len().saturating_sub(1) {
            for i in 0..columns {
                let here = within(i, j);
                let (right, top) = (x.at(self.x_edges[i + 1]), y.at(self.y_edges[j + 1]));
                if i + 1 < columns && differ(here, within(i + 1, j)) {
                    path.push_str(&polyline(&[[right, y.at(self.y_edges[j])], [right, top]], false));
                }
                if differ(here, within(i, j + 1)) {
                    path.push_str(&polyline(&[[x.at(self.x_edges[i]), top], [right, top]], false));
                }
            }
        }
        if !path.is_empty() {
            let style =
                format!("fill=\"none\" stroke=\"{INK}\" stroke-width=\"1.6\" stroke-linecap=\"square\"");
            svg.path(&path, &style);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(tiles: Vec<(Shade, Option<bool>)>) -> HeatMap {
        HeatMap {
            title: "Margin".into(),
            x_title: "x, mm".into(),
            y_title: "y, mm".into(),
            x_edges: vec![0.0, 1.0, 2.0],
            y_edges: vec![0.0, 1.0, 2.0],
            tiles,
            legend: vec![(Shade::Held(9), "held".into()), (Shade::Broken(0), "not held".into())],
        }
    }

    #[test]
    fn the_border_runs_between_known_tiles_that_differ() {
        let (held, broken) = ((Shade::Held(3), Some(true)), (Shade::Broken(3), Some(false)));
        let count = |tiles| map(tiles).to_svg().matches("stroke-linecap=\"square\"").count();
        assert_eq!(count(vec![held, broken, held, held]), 1);
        // What was not found is crossed, each tile for itself.
        let crossed = map(vec![(Shade::Missing, None), (Shade::Missing, None), held, held]).to_svg();
        assert!(crossed.contains("stroke-width=\"0.8\"") && !crossed.contains("NaN"));
        assert_eq!(count(vec![held; 4]), 0);
        assert_eq!(count(vec![held, (Shade::Blank, None), held, (Shade::Blank, None)]), 0);
    }

    #[test]
    fn a_senseless_map_is_still_a_figure() {
        for (x, tiles) in [(vec![], vec![]), (vec![1.0, 1.0], vec![(Shade::Void, None)])] {
            let svg = HeatMap { x_edges: x, tiles, ..map(vec![]) }.to_svg();
            assert!(svg.ends_with("</svg>") && !svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        }
    }
}
