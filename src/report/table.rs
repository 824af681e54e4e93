//! One table, four faces: aligned text for the terminal, HTML for the page, CSV and JSON for programs.

use super::number::{MISSING, Unit, significant};
use super::page::escape;
use serde::{Serialize, Serializer};
use serde_json::{Map, Value, json};

/// One column.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Name in the CSV header and in JSON, unit included (`torque_nm`).
    pub key: String,
    /// Unit of the numbers there: that of the key.
    pub key_unit: Unit,
    /// Name for people, without the unit.
    pub heading: String,
    /// Unit in which people see the numbers.
    pub unit: Unit,
    /// Significant digits for people; programs get all of them.
    pub digits: usize,
    /// Whether people see it at all.
    pub for_people: bool,
}

impl Column {
    /// A column of numbers.
    pub fn number(key: &str, heading: &str, unit: Unit, digits: usize) -> Self {
        Self {
            key: key.to_owned(),
            key_unit: unit,
            heading: heading.to_owned(),
            unit,
            digits,
            for_people: true,
        }
    }

    /// A column of words.
    pub fn text(key: &str, heading: &str) -> Self {
        Self::number(key, heading, Unit::One, 1)
    }
}

/// One cell.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    /// Words.
    Text(String),
    /// A number in SI, shown in the column's unit.
    Si(f64),
    /// A number in SI with a unit of its own, shown with its symbol (tables whose rows differ in kind).
    In(f64, Unit),
    /// A count.
    Count(usize),
    /// A verdict: held or not, and the word for it.
    Verdict(bool, String),
    /// True or false.
    Flag(bool),
    /// What people read in the place of what programs get.
    Told(String, Box<Cell>),
    /// Nothing to say.
    Empty,
}

impl From<&str> for Cell {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Cell {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<f64> for Cell {
    fn from(si: f64) -> Self {
        Self::Si(si)
    }
}

impl<T: Into<Cell>> From<Option<T>> for Cell {
    fn from(what: Option<T>) -> Self {
        what.map_or(Self::Empty, Into::into)
    }
}

impl From<u64> for Cell {
    fn from(count: u64) -> Self {
        Self::Count(usize::try_from(count).unwrap_or(usize::MAX))
    }
}

impl From<usize> for Cell {
    fn from(count: usize) -> Self {
        Self::Count(count)
    }
}

impl From<bool> for Cell {
    fn from(flag: bool) -> Self {
        Self::Flag(flag)
    }
}

impl Cell {
    /// `words` for people, `value` for programs.
    pub fn told(words: &str, value: impl Into<Self>) -> Self {
        Self::Told(words.to_owned(), Box::new(value.into()))
    }

    /// `value` for programs; for people only where it `counts`.
    pub fn only_if(counts: bool, value: impl Into<Self>) -> Self {
        if counts { value.into() } else { Self::told(MISSING, value) }
    }

    /// `held`, or that it is not.
    pub fn held(held: bool) -> Self {
        Self::Verdict(held, if held { "held" } else { "NOT HELD" }.to_owned())
    }

    /// As people read it.
    pub(crate) fn shown(&self, column: &Column) -> String {
        match self {
            Self::Text(text) | Self::Verdict(_, text) | Self::Told(text, _) => text.clone(),
            Self::Flag(flag) => flag.to_string(),
            Self::Si(si) => significant(column.unit.from_si(*si), column.digits),
            Self::In(si, unit) => unit.show(*si, column.digits),
            Self::Count(count) => count.to_string(),
            Self::Empty => MISSING.to_owned(),
        }
    }

    fn is_number(&self) -> bool {
        matches!(self, Self::Si(_) | Self::In(..) | Self::Count(_))
    }

    fn csv(&self, column: &Column) -> String {
        let full = |value: f64| if value.is_finite() { value.to_string() } else { String::new() };
        match self {
            Self::Text(text) | Self::Verdict(_, text) => no_formula(text),
            Self::Si(si) => full(column.key_unit.from_si(*si)),
            Self::In(si, unit) => full(unit.from_si(*si)),
            Self::Count(count) => count.to_string(),
            Self::Flag(flag) => flag.to_string(),
            Self::Told(_, value) => value.csv(column),
            Self::Empty => String::new(),
        }
    }

    /// A number that is none is null.
    fn json(&self, column: &Column) -> Value {
        match self {
            Self::Text(text) | Self::Verdict(_, text) => json!(text),
            Self::Si(si) => json!(column.key_unit.from_si(*si)),
            Self::In(si, unit) => json!(unit.from_si(*si)),
            Self::Count(count) => json!(count),
            Self::Flag(flag) => json!(flag),
            Self::Told(_, value) => value.json(column),
            Self::Empty => Value::Null,
        }
    }
}

/// A text that a spreadsheet would take for a formula, behind an apostrophe (OWASP, CSV injection); a number stays one.
fn no_formula(text: &str) -> String {
    match text.starts_with(['=', '+', '-', '@', '\t', '\r']) && text.parse::<f64>().is_err() {
        true => format!("'{text}"),
        false => text.to_owned(),
    }
}

/// What a table is printed on; by default paper: no colours, lines of any length.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Screen {
    /// Whether verdicts are painted (ANSI).
    pub colour: bool,
    /// Characters in a line, where that is limited.
    pub columns: Option<usize>,
}

/// From so many columns on a table is set closer, to fit the page.
const WIDE_FROM: usize = 9;

/// Columns and rows. A row shorter than the columns is filled with nothing; a longer one adds columns without a heading.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    /// Columns, left to right.
    pub columns: Vec<Column>,
    /// Rows, top to bottom.
    pub rows: Vec<Vec<Cell>>,
    /// So many columns, one at least, say what a row is: where not all columns fit on a screen these come again.
    pub lead: usize,
}

/// A table of things, column by column: each says where its cells come from. What JSON alone has stands beside.
#[derive(Debug, Clone)]
pub struct Rows<T> {
    items: Vec<T>,
    table: Table,
    json: Vec<Map<String, Value>>,
}

impl<T> Rows<T> {
    /// One row for each of `items`, no column yet.
    pub fn of(items: impl IntoIterator<Item = T>) -> Self {
        let items: Vec<T> = items.into_iter().collect();
        let table = Table { rows: vec![Vec::new(); items.len()], ..Table::new(Vec::new()) };
        Self { json: vec![Map::new(); items.len()], items, table }
    }

    /// A further column of numbers.
    pub fn number<C: Into<Cell>>(
        mut self,
        key: &str,
        heading: &str,
        unit: Unit,
        digits: usize,
        cell: impl Fn(&T) -> C,
    ) -> Self {
        self.table.columns.push(Column::number(key, heading, unit, digits));
        self.table.rows.iter_mut().zip(&self.items).for_each(|(row, item)| row.push(cell(item).into()));
        self
    }

    /// A further column of words.
    pub fn text<C: Into<Cell>>(self, key: &str, heading: &str, cell: impl Fn(&T) -> C) -> Self {
        self.number(key, heading, Unit::One, 1, cell)
    }

    /// A further column of numbers for each of `list`, under key and heading by `name`.
    pub fn each<I, C: Into<Cell>>(
        self,
        list: impl IntoIterator<Item = I>,
        name: impl Fn(&I) -> (String, String),
        unit: Unit,
        digits: usize,
        cell: impl Fn(&T, &I) -> C,
    ) -> Self {
        list.into_iter().fold(self, |rows, one| {
            let (key, heading) = name(&one);
            rows.number(&key, &heading, unit, digits, |item| cell(item, &one))
        })
    }

    /// The last column has its numbers in `unit` for people; programs get them in that of the key.
    pub fn shown_in(mut self, unit: Unit) -> Self {
        self.table.columns.iter_mut().last().into_iter().for_each(|column| column.unit = unit);
        self
    }

    /// A further column for programs alone.
    pub fn hidden<C: Into<Cell>>(mut self, key: &str, unit: Unit, cell: impl Fn(&T) -> C) -> Self {
        self = self.number(key, "", unit, 1, cell);
        self.table.columns.iter_mut().last().into_iter().for_each(|column| column.for_people = false);
        self
    }

    /// What JSON alone has, in the place of a column of that key where there is one.
    pub fn json<V: Serialize>(mut self, key: &str, value: impl Fn(&T) -> V) -> Self {
        for (row, item) in self.json.iter_mut().zip(&self.items) {
            row.insert(key.to_owned(), serde_json::to_value(value(item)).unwrap_or_default());
        }
        self
    }

    /// A number in SI that JSON alone has, there in `unit`, that of its key.
    pub fn json_in<N: Into<Option<f64>>>(self, key: &str, unit: Unit, si: impl Fn(&T) -> N) -> Self {
        self.json(key, |item| si(item).into().map(|si| unit.from_si(si)))
    }

    /// The table.
    pub fn table(self) -> Table {
        self.table
    }

    /// JSON: an object for each row, under the keys of the columns and those that it alone has.
    pub fn objects(&self) -> Vec<Value> {
        let mut rows = self.table.objects();
        for (row, more) in rows.iter_mut().zip(&self.json) {
            row.extend(more.clone());
        }
        rows.into_iter().map(Value::Object).collect()
    }

    /// The object of the first row; null without one.
    pub fn object(&self) -> Value {
        self.objects().into_iter().next().unwrap_or_default()
    }
}

/// As [`Rows::objects`].
impl<T> Serialize for Rows<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.objects().serialize(serializer)
    }
}

impl Table {
    /// An empty table.
    pub fn new(columns: Vec<Column>) -> Self {
        Self { columns, rows: Vec::new(), lead: 1 }
    }

    /// Two columns for short facts: what, and how much with its unit.
    pub fn facts() -> Self {
        Self::new(vec![Column::text("quantity", "Quantity"), Column::number("value", "Value", Unit::One, 5)])
    }

    /// Append a row.
    pub fn row(&mut self, cells: Vec<Cell>) -> &mut Self {
        while self.columns.len() < cells.len() {
            let key = format!("column_{}", self.columns.len() + 1);
            self.columns.push(Column::text(&key, ""));
        }
        self.rows.push(cells);
        self
    }

    /// With a last column that has the same words in every row.
    pub fn marked(mut self, key: &str, words: &str) -> Self {
        let columns = self.columns.len();
        self.columns.push(Column::text(key, ""));
        for row in &mut self.rows {
            row.resize(columns, Cell::Empty);
            row.push(words.into());
        }
        self
    }

    /// The columns that people see.
    fn for_people(&self) -> Self {
        self.those(|column| column.for_people)
    }

    fn those(&self, is_kept: impl Fn(&Column) -> bool) -> Self {
        let kept = |cells: &Vec<Cell>| {
            let cells = cells.iter().zip(&self.columns).filter(|(_, column)| is_kept(column));
            cells.map(|(cell, _)| cell.clone()).collect()
        };
        Self {
            columns: self.columns.iter().filter(|column| is_kept(column)).cloned().collect(),
            rows: self.rows.iter().map(kept).collect(),
            lead: self.lead,
        }
    }

    /// Its columns of these keys, in its own order.
    pub fn only(&self, keys: &[&str]) -> Self {
        self.those(|column| keys.contains(&column.key.as_str()))
    }

    /// The rows of which `most` at most are left, and how many are not.
    pub fn first(mut self, most: usize) -> (Self, usize) {
        let more = self.rows.len().saturating_sub(most);
        self.rows.truncate(most);
        (self, more)
    }

    /// JSON: an object for each row, in the units of the keys.
    pub fn objects(&self) -> Vec<Map<String, Value>> {
        let one = |row: &Vec<Cell>| {
            let cells = self.columns.iter().enumerate();
            cells.map(|(i, column)| (column.key.clone(), Self::cell(row, i).json(column))).collect()
        };
        self.rows.iter().map(one).collect()
    }

    /// A column stands right-aligned if it holds at least one number.
    fn is_numeric(&self, index: usize) -> bool {
        self.rows.iter().any(|row| row.get(index).is_some_and(Cell::is_number))
    }

    fn cell(row: &[Cell], index: usize) -> &Cell {
        row.get(index).unwrap_or(&Cell::Empty)
    }

    /// Aligned columns for a terminal, units in the headings. Where they do not fit on the screen, headings take several lines; where
    /// that is not enough, the columns move closer; those that still do not fit follow below, beside those that lead.
    pub fn to_text(&self, screen: Screen) -> String {
        self.for_people().aligned(screen)
    }

    fn aligned(&self, screen: Screen) -> String {
        let shown: Vec<Vec<String>> = self
            .rows
            .iter()
            .map(|row| self.columns.iter().enumerate().map(|(i, c)| Self::cell(row, i).shown(c)).collect())
            .collect();
        let headings: Vec<String> = self.columns.iter().map(|c| c.unit.heading(&c.heading)).collect();
        let cells = |i: usize| shown.iter().filter_map(|row| row.get(i)).map(|s| s.chars().count()).max();
        let wide = |(i, h): (usize, &String)| cells(i).unwrap_or(0).max(h.chars().count());
        let whole = headings.iter().enumerate().map(wide).map(|w| w + BETWEEN.len()).sum::<usize>();
        let fits = screen.columns.is_none_or(|most| whole <= most + BETWEEN.len());
        let headings: Vec<Vec<String>> = headings
            .into_iter()
            .enumerate()
            .map(|(i, h)| if fits { vec![h] } else { in_lines(&h, cells(i).unwrap_or(0)) })
            .collect();
        let width = |(i, lines): (usize, &Vec<String>)| {
            lines.iter().map(|line| line.chars().count()).chain(cells(i)).max().unwrap_or(0)
        };
        let widths: Vec<usize> = headings.iter().enumerate().map(width).collect();
        let fit = |between: &str| blocks(&widths, screen.columns, self.lead.max(1), between.len());
        let (blocks, between) = match (fit(BETWEEN), fit(CLOSER)) {
            (blocks, closer) if blocks.len() > 1 && closer.len() == 1 => (closer, CLOSER),
            (blocks, _) => (blocks, BETWEEN),
        };
        let mut out = String::new();
        let mut line = |block: &[usize], cells: &[String], paint: &dyn Fn(usize) -> Option<bool>| {
            let mut text = String::new();
            for (k, &i) in block.iter().enumerate() {
                if k > 0 {
                    text.push_str(between);
                }
                let cell = &cells[i];
                let padding = " ".repeat(widths[i] - cell.chars().count());
                let painted = match paint(i) {
                    Some(true) => format!("\u{1b}[32m{cell}\u{1b}[0m"),
                    Some(false) => format!("\u{1b}[31m{cell}\u{1b}[0m"),
                    None => cell.clone(),
                };
                if self.is_numeric(i) {
                    text.push_str(&padding);
                    text.push_str(&painted);
                } else {
                    text.push_str(&painted);
                    text.push_str(&padding);
                }
            }
            out.push_str(text.trim_end());
            out.push('\n');
        };
        let rule: Vec<String> = widths.iter().map(|&w| "─".repeat(w)).collect();
        for (k, block) in blocks.iter().enumerate() {
            if k > 0 {
                line(&[], &[], &|_| None);
            }
            // Headings end above the rule.
            let height = block.iter().map(|&i| headings[i].len()).max().unwrap_or(0);
            for row in 0..height {
                let part =
                    |lines: &Vec<String>| (row + lines.len()).checked_sub(height).map(|at| lines[at].clone());
                let parts: Vec<String> =
                    headings.iter().map(|lines| part(lines).unwrap_or_default()).collect();
                line(block, &parts, &|_| None);
            }
            line(block, &rule, &|_| None);
            for (row, cells) in self.rows.iter().zip(&shown) {
                line(block, cells, &|i| match Self::cell(row, i) {
                    Cell::Verdict(held, _) if screen.colour => Some(*held),
                    _ => None,
                });
            }
        }
        out
    }

    /// CSV with one header row of keys, every number in full.
    ///
    /// # Errors
    /// What the `csv` crate says; writing into memory gives it no cause.
    pub fn to_csv(&self) -> Result<Vec<u8>, csv::Error> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(self.columns.iter().map(|c| no_formula(&c.key)))?;
        for row in &self.rows {
            writer.write_record(self.columns.iter().enumerate().map(|(i, c)| Self::cell(row, i).csv(c)))?;
        }
        writer.into_inner().map_err(|e| e.into_error().into())
    }

    /// `<table>` with numbers right-aligned; margin and verdict behind what the row is, so that a phone shows them without scrolling.
    pub fn to_html(&self) -> String {
        self.for_people().answer_first().html()
    }

    fn answer_first(self) -> Self {
        let place =
            |key: &str| self.columns.iter().skip(self.lead).position(|c| c.key == key).map(|k| k + self.lead);
        let Some(verdict) = place("verdict") else { return self };
        let first: Vec<usize> = (0..self.lead).chain([verdict]).chain(place("margin")).collect();
        let order: Vec<usize> =
            first.iter().copied().chain((0..self.columns.len()).filter(|k| !first.contains(k))).collect();
        let sorted = |row: &Vec<Cell>| order.iter().map(|k| Self::cell(row, *k).clone()).collect();
        Self {
            rows: self.rows.iter().map(sorted).collect(),
            columns: order.iter().map(|k| self.columns[*k].clone()).collect(),
            lead: self.lead,
        }
    }

    fn html(&self) -> String {
        let wide = if self.columns.len() >= WIDE_FROM { " class=\"wide\"" } else { "" };
        let mut out = format!("<table{wide}>\n<thead><tr>");
        for (i, column) in self.columns.iter().enumerate() {
            let class = if self.is_numeric(i) { " class=\"n\"" } else { "" };
            out.push_str(&format!("<th{class}>{}", breakable(&escape(&column.heading))));
            if column.unit != Unit::One {
                out.push_str(&format!(" <span class=\"unit\">{}</span>", escape(column.unit.symbol())));
            }
            out.push_str("</th>");
        }
        out.push_str("</tr></thead>\n<tbody>\n");
        for row in &self.rows {
            out.push_str("<tr>");
            for (i, column) in self.columns.iter().enumerate() {
                let cell = Self::cell(row, i);
                let class = match cell {
                    Cell::Verdict(true, _) => " class=\"held\"",
                    Cell::Verdict(false, _) => " class=\"broken\"",
                    _ if self.is_numeric(i) => " class=\"n\"",
                    _ => "",
                };
                let text = escape(&cell.shown(column));
                let text = if matches!(cell, Cell::Text(_)) { breakable(&text) } else { text };
                out.push_str(&format!("<td{class}>{text}</td>"));
            }
            out.push_str("</tr>\n");
        }
        out.push_str("</tbody>\n</table>\n");
        out
    }
}

/// The text of a cell with places where the keys in it may be broken: behind `_`, and behind a point before a letter.
fn breakable(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut letters = text.chars().peekable();
    let mut last = ' ';
    while let Some(c) = letters.next() {
        out.push(c);
        let behind = letters.peek().copied().unwrap_or(' ');
        let ends_part = c == '_' || c == '.' && (last.is_alphanumeric() || last == ']');
        if ends_part && behind.is_ascii_alphabetic() {
            out.push_str("<wbr>");
        }
        last = c;
    }
    out
}

/// What stands between two columns, and where they would not fit otherwise.
const BETWEEN: &str = "  ";
const CLOSER: &str = " ";

/// A heading in lines as wide as its longest word or `cells` at most.
fn in_lines(heading: &str, cells: usize) -> Vec<String> {
    let count = |text: &str| text.chars().count();
    let most = heading.split(' ').map(count).max().unwrap_or(0).max(cells);
    let mut lines: Vec<String> = Vec::new();
    for word in heading.split(' ') {
        match lines.last_mut() {
            Some(line) if count(line) + 1 + count(word) <= most => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// Which columns stand side by side, `between` apart: as many as fit into `most` characters, but one beside the `lead` ones at least.
fn blocks(widths: &[usize], most: Option<usize>, lead: usize, between: usize) -> Vec<Vec<usize>> {
    let mut blocks: Vec<Vec<usize>> = Vec::new();
    for i in 0..widths.len() {
        let taken = |block: &Vec<usize>| block.iter().map(|&j| widths[j] + between).sum::<usize>();
        match blocks.last_mut() {
            None => blocks.push(vec![i]),
            Some(block)
                if block.len() <= lead || most.is_none_or(|most| taken(block) + widths[i] <= most) =>
            {
                block.push(i);
            }
            Some(_) => blocks.push((0..lead).chain([i]).collect()),
        }
    }
    blocks
}

#[cfg(test)]
mod tests;
