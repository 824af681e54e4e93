//! What a table of margins shows: how much of the box is held, what decides, and planes over two variables.
//!
//! Read twice, row by row: ranges first, then the planes; the memory does not grow with the table.

use super::head::{Holds, SweepHead};
use super::lines::{FIXED, ROWS};
use super::table::{NoTable, Records};
use crate::design::did_you_mean;
use crate::margin::RESOLUTION;
use std::collections::BTreeSet;
use std::io::Read;

/// Values of a variable that are told apart: with more of them it is taken as continuous.
const MOST_VALUES: usize = 64;
/// Tiles along an axis of a continuous variable.
const TILES: [f64; 2] = [4.0, 36.0];
/// Points in a tile that are wanted, on the average.
const PER_TILE: f64 = 20.0;
/// Planes that are drawn where nobody says which.
const MOST_PAIRS: usize = 6;
/// Points kept for parallel coordinates: between half of them and all.
const KEPT: usize = 400;

/// A variable of the table.
#[derive(Debug, Clone, PartialEq)]
pub struct MapVariable {
    /// Name, with its unit.
    pub name: String,
    /// Least and greatest value of all points.
    pub range: [f64; 2],
    /// The same of points that hold every limit; none where no point does.
    pub held: Option<[f64; 2]>,
    /// Its values, where they are few.
    values: BTreeSet<u64>,
    /// Edges of the tiles.
    edges: Vec<f64>,
}

impl MapVariable {
    /// Edges of its tiles, rising.
    pub fn edges(&self) -> &[f64] {
        &self.edges
    }

    /// Whether it has more than one value.
    pub fn varies(&self) -> bool {
        self.range[1] > self.range[0]
    }

    fn tile(&self, value: f64) -> usize {
        let last = self.edges.len().saturating_sub(2);
        self.edges.partition_point(|edge| *edge <= value).saturating_sub(1).min(last)
    }
}

/// A point that is remembered.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct MapPoint {
    /// Whether every limit is held.
    pub held: bool,
    /// Its number.
    pub index: u64,
    /// The least objective, where there is one.
    pub least: Option<f64>,
    /// What is mapped.
    pub value: f64,
    /// Values of the variables.
    pub x: Vec<f64>,
}

/// What lies in one tile.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Cells {
    /// Points.
    pub points: u64,
    /// Points that hold every limit.
    pub held: u64,
    /// Largest value: of the points held, where there are any.
    pub best: Option<f64>,
    /// What decides there: its place among [`SweepMap::deciding`].
    pub decides: Option<usize>,
}

/// A plane over two variables.
#[derive(Debug, Clone, PartialEq)]
pub struct MapPair {
    /// Places of the two variables: to the right, upwards.
    pub axes: [usize; 2],
    /// Tiles, row by row from the lowest.
    pub tiles: Vec<Cells>,
}

/// A table of margins, looked at.
#[derive(Debug, Clone)]
pub struct SweepMap {
    /// Its first line, where it has one.
    pub head: Option<SweepHead>,
    /// The column that is mapped.
    pub by: String,
    /// Variables, in the order of the table.
    pub variables: Vec<MapVariable>,
    /// Points.
    pub points: u64,
    /// Points without a clutch.
    pub void: u64,
    /// Points that hold every limit.
    pub held: u64,
    /// What decides, and at how many points.
    pub deciding: Vec<(String, u64)>,
    /// Of the points held the one with the largest least objective, or value; else the one with the largest value.
    pub best: Option<MapPoint>,
    /// Planes.
    pub pairs: Vec<MapPair>,
    /// Pairs of variables that no plane shows.
    pub pairs_left: usize,
    /// Some points, evenly taken from the table.
    pub some: Vec<MapPoint>,
    names: Vec<String>,
    columns: Columns,
    /// Points with a value that the second reading has met.
    seen: u64,
    /// Each so many of them are kept.
    stride: u64,
}

/// Places of what is read.
#[derive(Debug, Clone, Default)]
struct Columns {
    index: Option<usize>,
    by: usize,
    least: Option<usize>,
    deciding: Option<usize>,
    feasible: Option<usize>,
    variables: Vec<usize>,
}

impl SweepMap {
    /// A map of the column `by`, nothing read yet.
    pub fn of(by: &str) -> Self {
        Self {
            head: None,
            by: by.to_owned(),
            variables: Vec::new(),
            points: 0,
            void: 0,
            held: 0,
            deciding: Vec::new(),
            best: None,
            pairs: Vec::new(),
            pairs_left: 0,
            some: Vec::new(),
            names: Vec::new(),
            columns: Columns::default(),
            seen: 0,
            stride: 1,
        }
    }

    /// First reading of one part: columns and ranges.
    ///
    /// # Errors
    /// [`NoTable`]: no table of margins, or one of another sweep than the parts before.
    pub fn survey(&mut self, part: impl Read) -> Result<(), NoTable> {
        let mut records = Records::open(part)?;
        self.take_columns(&records.head, &records.names)?;
        while let Some(row) = records.next_row()? {
            let x: Option<Vec<f64>> =
                self.columns.variables.iter().map(|&at| row.get(at).and_then(finite)).collect();
            let Some(x) = x else {
                return Err(NoTable {
                    line: records.line(),
                    what: "a variable is no finite number".to_owned(),
                });
            };
            for (v, x) in self.variables.iter_mut().zip(x) {
                v.range = [v.range[0].min(x), v.range[1].max(x)];
                if v.values.len() <= MOST_VALUES {
                    v.values.insert(ordered(x));
                }
            }
            self.points += 1;
        }
        Ok(())
    }

    fn take_columns(&mut self, head: &Option<SweepHead>, names: &[String]) -> Result<(), NoTable> {
        if let Some(SweepHead { holds: Holds::Vectors, .. }) = head {
            return Err(NoTable::whole("vectors without margins; `evaluate --vectors` computes them"));
        }
        if !self.names.is_empty() {
            if self.names != names {
                return Err(NoTable::whole("other columns than in the first table"));
            }
            return match (&self.head, head) {
                (Some(first), Some(head)) => head.differs(first).map_or(Ok(()), |why| {
                    Err(NoTable::whole(format!("another sweep than the first table: {why}")))
                }),
                _ => Ok(()),
            };
        }
        let place = |name: &str| names.iter().position(|n| n == name);
        let rows = |name: &str| ROWS.iter().any(|prefix| name.starts_with(prefix));
        let variables: Vec<usize> =
            (0..names.len()).filter(|&i| !FIXED.contains(&names[i].as_str()) && !rows(&names[i])).collect();
        let Some(by) = place(&self.by) else {
            let (by, near) = (&self.by, did_you_mean(&self.by, names));
            return Err(NoTable::whole(format!("no column {by}; there are: {}{near}", names.join(", "))));
        };
        if variables.is_empty() {
            return Err(NoTable::whole(
                "no column is a variable; ask `evaluate` for --columns variables too",
            ));
        }
        let fresh = |&at: &usize| MapVariable {
            name: names[at].clone(),
            range: [f64::INFINITY, f64::NEG_INFINITY],
            held: None,
            values: BTreeSet::new(),
            edges: Vec::new(),
        };
        self.variables = variables.iter().map(fresh).collect();
        self.columns = Columns {
            index: place(FIXED[0]),
            by,
            least: place(FIXED[1]),
            deciding: place(FIXED[3]),
            feasible: place(FIXED[4]),
            variables,
        };
        self.head.clone_from(head);
        self.names = names.to_vec();
        Ok(())
    }

    /// Between both readings: the planes, over each pair of `over`, or over the first pairs of variables that vary.
    ///
    /// # Errors
    /// [`NoTable`]: no rows, or a name that is no variable of the table.
    pub fn lay_out(&mut self, over: &[[String; 2]]) -> Result<(), NoTable> {
        if self.points == 0 {
            return Err(NoTable::whole("a table without rows"));
        }
        let wanted = (self.points as f64 / PER_TILE).sqrt().clamp(TILES[0], TILES[1]) as usize;
        for v in &mut self.variables {
            v.edges = edges(v, self.points, wanted);
        }
        let place = |name: &String| {
            let known: Vec<&str> = self.variables.iter().map(|v| v.name.as_str()).collect();
            known.iter().position(|n| n == name).ok_or_else(|| {
                let near = did_you_mean(name, &known);
                NoTable::whole(format!("no variable {name}; there are: {}{near}", known.join(", ")))
            })
        };
        let varying: Vec<usize> = (0..self.variables.len()).filter(|&i| self.variables[i].varies()).collect();
        let all: Vec<[usize; 2]> = varying
            .iter()
            .enumerate()
            .flat_map(|(k, &i)| varying[k + 1..].iter().map(move |&j| [i, j]))
            .collect();
        let axes: Vec<[usize; 2]> = match over {
            [] => all.iter().copied().take(MOST_PAIRS).collect(),
            over => over.iter().map(|[x, y]| Ok([place(x)?, place(y)?])).collect::<Result<_, NoTable>>()?,
        };
        self.pairs_left = all.len().saturating_sub(axes.len());
        let tiles = |&[i, j]: &[usize; 2]| {
            let count = |k: usize| self.variables[k].edges.len() - 1;
            vec![Cells::default(); count(i) * count(j)]
        };
        self.pairs = axes.iter().map(|axes| MapPair { axes: *axes, tiles: tiles(axes) }).collect();
        Ok(())
    }

    /// Second reading of one part, in the same order as the first.
    ///
    /// # Errors
    /// [`NoTable`].
    pub fn add(&mut self, part: impl Read) -> Result<(), NoTable> {
        let mut records = Records::open(part)?;
        let mut at = 0;
        while let Some(row) = records.next_row()? {
            let cell = |at: usize| row.get(at).unwrap_or_default().trim();
            let c = &self.columns;
            let value = finite(cell(c.by));
            let x: Vec<f64> = c.variables.iter().filter_map(|&at| finite(cell(at))).collect();
            let held = match c.feasible {
                Some(at) => cell(at) == "1",
                None => value.is_some_and(|v| v >= -RESOLUTION),
            };
            let point = MapPoint {
                index: c.index.and_then(|at| cell(at).parse().ok()).unwrap_or(at),
                value: value.unwrap_or(f64::NEG_INFINITY),
                least: c.least.and_then(|at| finite(cell(at))),
                held: held && value.is_some(),
                x,
            };
            let code = c.deciding.map(|at| cell(at).to_owned()).filter(|code| !code.is_empty());
            if point.x.len() != self.variables.len() {
                return Err(NoTable::whole("the table has changed since it was read first"));
            }
            self.count(point, value.is_some(), code);
            at += 1;
        }
        Ok(())
    }

    fn count(&mut self, point: MapPoint, known: bool, code: Option<String>) {
        let decides = code.map(|code| {
            let at = self.deciding.iter().position(|(name, _)| *name == code).unwrap_or_else(|| {
                self.deciding.push((code, 0));
                self.deciding.len() - 1
            });
            self.deciding[at].1 += 1;
            at
        });
        for pair in &mut self.pairs {
            let [i, j] = pair.axes;
            let (x, y) = (&self.variables[i], &self.variables[j]);
            let place = y.tile(point.x[j]) * (x.edges.len() - 1) + x.tile(point.x[i]);
            pair.tiles[place].add(&point, known, decides);
        }
        if !known {
            self.void += 1;
            return;
        }
        if point.held {
            self.held += 1;
            for (v, x) in self.variables.iter_mut().zip(&point.x) {
                v.held = Some(v.held.map_or([*x; 2], |[low, high]| [low.min(*x), high.max(*x)]));
            }
        }
        let rank = |p: &MapPoint| (p.held, if p.held { p.least.unwrap_or(p.value) } else { p.value });
        if self.best.as_ref().is_none_or(|best| rank(&point) > rank(best)) {
            self.best = Some(point.clone());
        }
        if self.seen.is_multiple_of(self.stride) {
            self.some.push(point);
        }
        self.seen += 1;
        if self.some.len() > KEPT {
            let mut keep = false;
            self.some.retain(|_| {
                keep = !keep;
                keep
            });
            self.stride *= 2;
        }
    }
}

impl Cells {
    fn add(&mut self, point: &MapPoint, known: bool, decides: Option<usize>) {
        self.points += 1;
        if !known {
            return;
        }
        let first_held = point.held && self.held == 0;
        self.held += u64::from(point.held);
        // Behind a point that is held, those that are not count no more.
        let counts = point.held || self.held == 0;
        if first_held || (counts && self.best.is_none_or(|best| point.value > best)) {
            self.best = Some(point.value);
            self.decides = decides;
        }
    }
}

/// A cell as a finite number.
fn finite(cell: &str) -> Option<f64> {
    cell.trim().parse().ok().filter(|v: &f64| v.is_finite())
}

/// Bits that are ordered as the numbers are.
fn ordered(x: f64) -> u64 {
    let bits = (x + 0.0).to_bits();
    if bits >> 63 == 1 { !bits } else { bits | 1 << 63 }
}

fn unordered(bits: u64) -> f64 {
    f64::from_bits(if bits >> 63 == 1 { bits & !(1 << 63) } else { !bits })
}

/// Edges of the tiles of a variable: between its values where these come again and again, else `wanted` even ones.
fn edges(v: &MapVariable, points: u64, wanted: usize) -> Vec<f64> {
    let [low, high] = v.range;
    if !v.varies() {
        let half = if low == 0.0 { 0.5 } else { 0.05 * low.abs() };
        return vec![low - half, low + half];
    }
    let few = v.values.len() <= MOST_VALUES && points >= 2 * v.values.len() as u64;
    if !few {
        return (0..=wanted).map(|k| low + (high - low) * (k as f64 / wanted as f64)).collect();
    }
    let values: Vec<f64> = v.values.iter().map(|bits| unordered(*bits)).collect();
    let mut edges: Vec<f64> = values.windows(2).map(|w| 0.5 * (w[0] + w[1])).collect();
    let (first, last) = (values[1] - values[0], values[values.len() - 1] - values[values.len() - 2]);
    edges.insert(0, low - 0.5 * first);
    edges.push(high + 0.5 * last);
    edges
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = "index,x_mm,y_mm,margin,deciding,feasible\n\
        0,0,-1,-0.5,hoop,0\n1,0,1,0.1,hertz,1\n2,1,-1,-0.2,hoop,0\n3,1,1,0.3,hertz,1\n4,2,-1,,,0\n5,2,1,0.2,hoop,1\n";

    fn mapped(table: &str, over: &[[String; 2]]) -> Result<SweepMap, NoTable> {
        let mut map = SweepMap::of("margin");
        map.survey(table.as_bytes())?;
        map.lay_out(over)?;
        map.add(table.as_bytes())?;
        Ok(map)
    }

    #[test]
    fn a_grid_becomes_its_own_tiles() {
        let map = mapped(TABLE, &[]).unwrap();
        assert_eq!((map.points, map.void, map.held), (6, 1, 3));
        assert_eq!(map.variables[0].edges, [-0.5, 0.5, 1.5, 2.5]);
        assert_eq!(map.variables[1].held, Some([1.0, 1.0]));
        assert_eq!(map.deciding, [("hoop".to_owned(), 3), ("hertz".to_owned(), 2)]);
        let best: Vec<Option<f64>> = map.pairs[0].tiles.iter().map(|t| t.best).collect();
        assert_eq!(best, [Some(-0.5), Some(-0.2), None, Some(0.1), Some(0.3), Some(0.2)]);
        assert_eq!(map.best.as_ref().map(|b| b.index), Some(3));
        assert_eq!(map.some.len(), 5);
    }

    #[test]
    fn joined_parts_are_read_as_one_table_and_foreign_ones_are_refused() {
        let names = TABLE.lines().next().unwrap();
        let joined = TABLE.replace("\n3,", &format!("\n{names}\n3,"));
        assert_eq!(mapped(&joined, &[]).unwrap().pairs, mapped(TABLE, &[]).unwrap().pairs);
        let over = |x: &str| mapped(TABLE, &[[x.to_owned(), "y_mm".to_owned()]]).unwrap_err().to_string();
        assert!(over("x_m").contains("did you mean x_mm?"));
        for (table, word) in [
            (TABLE.replace("2,1,-1", "2,1,nan"), "line 4: a variable is no finite number"),
            (TABLE.replace("2,1,-1", "2,1"), "line 4: 5 values for 6 columns"),
            (TABLE.replace("margin", "m"), "no column margin"),
            (format!("{names}\n"), "without rows"),
            (String::new(), "no line with the names"),
        ] {
            let why = mapped(&table, &[]).unwrap_err().to_string();
            assert!(why.contains(word), "{why}");
        }
    }

    #[test]
    fn numbers_are_ordered_as_their_bits() {
        let values = [-2.0, -1e-9, 0.0, 1e-300, 3.5];
        assert!(values.map(ordered).is_sorted());
        assert_eq!(values.map(ordered).map(unordered), values);
    }

    #[test]
    fn few_points_are_kept_of_many() {
        let rows: String = (0..10_000).map(|i| format!("{i},{}.5,{},0.1,a,1\n", i % 977, i % 7)).collect();
        let names = TABLE.lines().next().unwrap();
        let map = mapped(&format!("{names}\n{rows}"), &[]).unwrap();
        assert!((KEPT / 2..=KEPT).contains(&map.some.len()), "{}", map.some.len());
        assert_eq!(map.variables[0].edges.len() - 1, 22);
        assert_eq!(map.variables[1].edges.len() - 1, 7);
    }
}
