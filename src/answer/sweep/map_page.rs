//! The map of a sweep as text, JSON and page.

use super::head::{Holds, SweepHead};
use super::map::{MapPair, MapPoint, MapVariable, SweepMap};
use crate::answer::{Provenance, TOOL, VERSION};
use crate::file::variable_unit;
use crate::report::heat::{KINDS, SHADES};
use crate::report::{
    HeatMap, Page, PageHead, Parallel, Rows, Screen, Shade, Table, Tone, Unit, plain, significant,
};
use serde::Serialize;

/// Axes of the parallel coordinates: more would be too narrow for their names.
const MOST_AXES: usize = 9;

/// Least and greatest value of a variable, in the unit of its name.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct MapRange {
    /// The least.
    pub from: f64,
    /// The greatest.
    pub to: f64,
}

/// Keys of `map`.
#[derive(Debug, Clone, Serialize)]
pub struct MapBody<'a> {
    /// The best point.
    pub best: Option<&'a MapPoint>,
    /// The column that is mapped.
    pub by: &'a str,
    /// Which limit decides at how many points.
    pub deciding: Rows<&'a (String, u64)>,
    /// Name of the design; null: the table does not say.
    pub design: Option<&'a str>,
    /// SHA-256 of the design's file.
    pub design_hash: Option<&'a str>,
    /// Points that hold every limit.
    pub held: u64,
    /// Points.
    pub points: u64,
    /// Which points were taken.
    pub sampling: Option<&'a str>,
    /// The program.
    pub tool: &'static str,
    /// Each variable: its range, that of the points that are held, its value at the best point.
    pub variables: Rows<(usize, &'a MapVariable)>,
    /// The answer in a sentence.
    pub verdict: String,
    /// Version of the program.
    pub version: &'static str,
    /// Points without a clutch.
    pub without_clutch: u64,
}

impl SweepMap {
    /// In a sentence.
    pub fn verdict(&self) -> String {
        let share = Unit::Percent.show(self.held as f64 / self.points.max(1) as f64, 3);
        let void = match self.void {
            0 => String::new(),
            n => format!("; at {n} there is no clutch"),
        };
        format!("{} of {} points hold every limit ({share}){void}", self.held, self.points)
    }

    /// The unit in which people read what is mapped: of a margin per cent, as everywhere.
    fn unit(&self) -> Unit {
        let is_margin = self.by == "margin" || self.by.starts_with("limit.");
        if is_margin { Unit::Percent } else { Unit::One }
    }

    /// What is mapped, with its unit apart.
    fn by_title(&self) -> String {
        match self.unit() {
            Unit::One => self.by.clone(),
            unit => format!("{}, {}", self.by, unit.symbol()),
        }
    }

    /// The best point, in words.
    fn best_words(&self) -> Option<String> {
        let best = self.best.as_ref()?;
        let x: Vec<String> = self
            .variables
            .iter()
            .zip(&best.x)
            .map(|(v, x)| format!("{} = {}", v.name, plain(*x, 6)))
            .collect();
        let value = self.unit().show(best.value, 4);
        let what = match (best.held, best.least) {
            (true, Some(least)) => {
                format!("Best point held: {}, least objective {}", best.index, significant(least, 4))
            }
            (true, None) => format!("Best point held: {}, {} {}", best.index, self.by, value),
            (false, _) => format!("Nearest point: {}, {} {}", best.index, self.by, value),
        };
        Some(format!("{what}; {}", x.join(", ")))
    }

    /// Each variable: its range, and that of the points that are held.
    pub fn variables_table(&self) -> Table {
        self.variable_rows().table()
    }

    fn variable_rows(&self) -> Rows<(usize, &MapVariable)> {
        let digits = 5;
        let range = |[from, to]: [f64; 2]| MapRange { from, to };
        Rows::of(self.variables.iter().enumerate())
            .text("name", "Variable", |(_, v)| v.name.as_str())
            .number("from", "From", Unit::One, digits, |(_, v)| v.range[0])
            .number("to", "To", Unit::One, digits, |(_, v)| v.range[1])
            .number("held_from", "Held from", Unit::One, digits, |(_, v)| v.held.map(|held| held[0]))
            .number("held_to", "Held to", Unit::One, digits, |(_, v)| v.held.map(|held| held[1]))
            .number("best", "Best point", Unit::One, digits, |(i, _)| Some(*self.best.as_ref()?.x.get(*i)?))
            .json("range", move |(_, v)| range(v.range))
            .json("held", move |(_, v)| v.held.map(range))
    }

    /// What decides, most often first: places in [`SweepMap::deciding`].
    fn ranked(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.deciding.len()).collect();
        order.sort_by_key(|&i| std::cmp::Reverse(self.deciding[i].1));
        order
    }

    /// Which limit decides at how many points.
    pub fn deciding_table(&self) -> Table {
        self.deciding_rows().table()
    }

    fn deciding_rows(&self) -> Rows<&(String, u64)> {
        let all: u64 = self.deciding.iter().map(|(_, n)| n).sum();
        Rows::of(self.ranked().into_iter().map(|i| &self.deciding[i]))
            .text("code", "Limit that decides", |(code, _)| code.as_str())
            .number("points", "Points", Unit::One, 9, |(_, points)| *points)
            .number("share", "Share", Unit::One, 3, |(_, points)| *points as f64 / all.max(1) as f64)
            .shown_in(Unit::Percent)
    }

    /// What the tables do not say.
    fn remarks(&self) -> Vec<String> {
        let mut all: Vec<String> = self.best_words().into_iter().collect();
        if let Some(SweepHead { points, holds: Holds::Margins { scenes, .. }, .. }) = &self.head {
            let scenes = match scenes.as_str() {
                "none" => "static margins alone".to_owned(),
                scenes => format!("static margins and scenes: {scenes}"),
            };
            all.push(format!("Points: {points}; {scenes}"));
        }
        if self.pairs_left > 0 {
            all.push(format!("{} more pairs of variables: --over X,Y", self.pairs_left));
        }
        all
    }

    /// The answer on a terminal.
    pub fn text(&self, screen: Screen) -> String {
        let name = self.head.as_ref().map_or(String::new(), |head| {
            format!("{}  {}\n\n", head.design, head.design_hash.get(..12).unwrap_or(&head.design_hash))
        });
        let deciding = if self.deciding.is_empty() {
            String::new()
        } else {
            format!("{}\n", self.deciding_table().to_text(screen))
        };
        format!(
            "{name}{}\n{deciding}{}\n{}\n",
            self.variables_table().to_text(screen),
            self.remarks().join("\n"),
            self.verdict()
        )
    }

    /// The answer as one JSON object.
    pub fn object(&self) -> MapBody<'_> {
        let head = self.head.as_ref();
        MapBody {
            tool: TOOL,
            version: VERSION,
            design: head.map(|h| h.design.as_str()),
            design_hash: head.map(|h| h.design_hash.as_str()),
            sampling: head.map(|h| h.points.as_str()),
            by: &self.by,
            verdict: self.verdict(),
            points: self.points,
            without_clutch: self.void,
            held: self.held,
            variables: self.variable_rows(),
            deciding: self.deciding_rows(),
            best: self.best.as_ref(),
        }
    }

    /// The answer as a page.
    pub fn page(&self, provenance: &Provenance) -> Page {
        let of =
            |text: fn(&SweepHead) -> &str| self.head.as_ref().map_or(String::new(), |h| text(h).to_owned());
        let mut page = Page::new(PageHead {
            title: "Map of a sweep".to_owned(),
            tool: TOOL.to_owned(),
            version: VERSION.to_owned(),
            command: provenance.command.clone(),
            design: of(|h| &h.design),
            design_hash: of(|h| &h.design_hash),
        });
        page.verdict_in(if self.held > 0 { Tone::Plain } else { Tone::Bad }, &self.verdict());
        page.list(self.remarks());
        page.heading("Planes");
        page.paragraph(
            "Each tile shows its best point: of those that hold every limit, where there are any, the one with the largest value; the \
             other variables are whatever the points have them. The line is the border of what is held.",
        );
        for pair in &self.pairs {
            let mut figures = vec![(self.shaded(pair).to_figure(), "")];
            if !self.deciding.is_empty() {
                figures.push((self.kinds(pair).to_figure(), ""));
            }
            page.figures(&figures);
        }
        let parallel = self.parallel();
        if parallel.axes.len() > 1 {
            page.heading("Points across all variables");
            page.figure(
                &parallel.to_figure(),
                &format!(
                    "{} points, evenly taken from the table; green: every limit is held, red: one is not. Last axis: {}.",
                    parallel.lines.len(),
                    self.by
                ),
            );
        }
        page.heading("Variables").table(
            "Held: least and greatest value of points that hold every limit.",
            &self.variables_table(),
        );
        if !self.deciding.is_empty() {
            page.heading("What decides")
                .table("The limit with the least margin, at all points.", &self.deciding_table());
        }
        // Numbers that are none become null; the object holds nothing else that has no JSON form.
        page.results("results", &serde_json::to_value(self.object()).unwrap_or_default());
        page
    }

    fn plane(&self, pair: &MapPair, title: String) -> HeatMap {
        let [x, y] = pair.axes.map(|i| &self.variables[i]);
        HeatMap {
            title,
            x_title: axis_title(&x.name),
            y_title: axis_title(&y.name),
            x_edges: x.edges().to_vec(),
            y_edges: y.edges().to_vec(),
            tiles: Vec::new(),
            legend: Vec::new(),
        }
    }

    /// The value of the best point of each tile.
    fn shaded(&self, pair: &MapPair) -> HeatMap {
        let known = pair.tiles.iter().filter_map(|t| Some((t.best?, t.held > 0)));
        let [held, broken] = [true, false].map(|side| {
            let values = known.clone().filter(move |(_, held)| *held == side).map(|(value, _)| value);
            values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
        });
        let shade = |value: f64, from: f64, to: f64| {
            let share = if to == from { 1.0 } else { (value - from) / (to - from) };
            (share * f64::from(SHADES)).clamp(0.0, f64::from(SHADES - 1)) as u8
        };
        let tile = |t: &super::Cells| match t.best {
            None if t.points == 0 => (Shade::Blank, None),
            None => (Shade::Void, Some(false)),
            Some(v) if t.held > 0 => (Shade::Held(shade(v, held[0], held[1])), Some(true)),
            Some(v) => (Shade::Broken(shade(v, broken[1], broken[0])), Some(false)),
        };
        let tiles: Vec<(Shade, Option<bool>)> = pair.tiles.iter().map(tile).collect();
        let ends = |[low, high]: [f64; 2], shade: fn(u8) -> Shade, words: &str, from_low: bool| {
            let (first, last) = if from_low { (low, high) } else { (high, low) };
            let one = |k: u8, value: f64| (shade(k), format!("{words} {}", self.unit().show(value, 2)));
            match (low <= high, low == high) {
                (false, _) => vec![],
                (true, true) => vec![one(SHADES - 1, first)],
                (true, false) => vec![one(0, first), one(SHADES - 1, last)],
            }
        };
        let mut legend = ends(held, Shade::Held, "held:", true);
        legend.extend(ends(broken, Shade::Broken, "not held:", false));
        legend.extend(void_entry(&tiles));
        HeatMap { tiles, legend, ..self.plane(pair, self.by_title()) }
    }

    /// What decides at the best point of each tile.
    fn kinds(&self, pair: &MapPair) -> HeatMap {
        let mut counts = vec![0_usize; self.deciding.len()];
        pair.tiles.iter().filter_map(|t| t.decides).for_each(|i| counts[i] += 1);
        let mut order: Vec<usize> = (0..counts.len()).filter(|&i| counts[i] > 0).collect();
        order.sort_by_key(|&i| std::cmp::Reverse(counts[i]));
        let kind = |code: usize| order.iter().position(|&i| i == code).unwrap_or(KINDS).min(KINDS);
        let tile = |t: &super::Cells| match (t.points, t.best, t.decides) {
            (0, ..) => (Shade::Blank, None),
            (_, Some(_), Some(code)) => (Shade::Kind(kind(code)), Some(t.held > 0)),
            _ => (Shade::Void, Some(false)),
        };
        let tiles: Vec<(Shade, Option<bool>)> = pair.tiles.iter().map(tile).collect();
        let named = order.iter().take(KINDS).enumerate();
        let mut legend: Vec<(Shade, String)> =
            named.map(|(k, &i)| (Shade::Kind(k), self.deciding[i].0.clone())).collect();
        if order.len() > KINDS {
            legend.push((Shade::Kind(KINDS), "another".to_owned()));
        }
        legend.extend(void_entry(&tiles));
        HeatMap { tiles, legend, ..self.plane(pair, "What decides".to_owned()) }
    }

    fn parallel(&self) -> Parallel {
        let varying: Vec<usize> = (0..self.variables.len()).filter(|&i| self.variables[i].varies()).collect();
        let shown = &varying[..varying.len().min(MOST_AXES - 1)];
        let mut axes: Vec<(String, [f64; 2])> =
            shown.iter().map(|&i| (axis_title(&self.variables[i].name), self.variables[i].range)).collect();
        let unit = self.unit();
        let values = self.some.iter().map(|p| unit.from_si(p.value));
        let range =
            values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)]);
        axes.push((self.by_title(), range));
        let line = |p: &super::MapPoint| {
            (shown.iter().map(|&i| p.x[i]).chain([unit.from_si(p.value)]).collect::<Vec<f64>>(), p.held)
        };
        Parallel { axes, lines: self.some.iter().map(line).collect() }
    }
}

/// An entry of the legend where a tile has points but no clutch.
fn void_entry(tiles: &[(Shade, Option<bool>)]) -> Option<(Shade, String)> {
    let void = tiles.iter().any(|(shade, _)| *shade == Shade::Void);
    void.then(|| (Shade::Void, "no clutch".to_owned()))
}

/// A variable's name with its unit apart: `r_i2, mm`.
fn axis_title(name: &str) -> String {
    let unit = variable_unit(name).filter(|unit| !unit.is_empty());
    let bare =
        unit.and_then(|unit| name.strip_suffix(&unit.to_lowercase().replace('µ', "u"))?.strip_suffix('_'));
    match (bare, unit) {
        (Some(bare), Some(unit)) => format!("{bare}, {unit}"),
        _ => name.to_owned(),
    }
}
