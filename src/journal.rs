//! The record of a search as lines of text, so that a later search of the same problem need not repeat it.
//!
//! In: evaluations, or the lines of an earlier record. Out: lines, and the evaluations that they hold. Absent: files and locks (`cli`).
//! Equations: none.
//!
//! A line is a row of CSV: `model` (tool, version, and a hash of the sources that compute a margin, made by `build.rs`), `design` (hash of
//! what the design file says, comments apart), `problem` (hash of everything that an evaluation depends on but the variables), `hash` (of
//! problem and inputs), `variables` and `x` (canonical inputs), `outcome` (`ok`, `refused`, `not-finite`, `shape`), `objectives`,
//! `limits`, `tie_break`, `error` (tolerance of the evaluation), `detail` (why it failed), `check` (of all cells before it). Lists within
//! a cell are separated by semicolons; numbers read back exactly; a row is one line.
//!
//! What is believed: a row of this very model whose `check` agrees. All others are counted and not used. `check` tells a damaged or edited
//! row from a whole one; it does not prove that the numbers were computed.

use crate::optimise::{Entry, Evaluation, EvaluationPart, Journal, NoEvaluation, ProblemId};
use sha2::{Digest, Sha256};
use std::collections::HashMap;

/// Names of the columns.
const COLUMNS: [&str; 13] = [
    "model",
    "design",
    "problem",
    "hash",
    "variables",
    "x",
    "outcome",
    "objectives",
    "limits",
    "tie_break",
    "error",
    "detail",
    "check",
];
/// Where `check` stands: behind everything that it is of.
const CHECK: usize = COLUMNS.len() - 1;

/// What computes a margin: tool, version, hash of its sources.
pub fn model() -> String {
    let (tool, version) = (env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION"));
    format!("{tool} {version} {}", env!("SPRAG_DESIGN_MODEL"))
}

/// The first line of a record.
pub fn header() -> String {
    COLUMNS.join(",") + "\n"
}

/// What a text is by its first line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JournalText {
    /// Nothing yet, or the beginning of a first line that a kill cut short.
    Nothing,
    /// A record, whose rows follow.
    Journal,
    /// A record by a version that wrote no `check`.
    Earlier,
    /// Something else.
    Foreign,
}

impl JournalText {
    /// That of `text`.
    pub fn of(text: &[u8]) -> Self {
        let header = header();
        if header.as_bytes().starts_with(text) && text.len() < header.len() {
            return Self::Nothing;
        }
        let first = text.split(|b| *b == b'\n').next().and_then(cells).unwrap_or_default();
        if first == COLUMNS[..] {
            Self::Journal
        } else if first == COLUMNS[..CHECK] {
            Self::Earlier
        } else {
            Self::Foreign
        }
    }
}

/// The rows of a record that a design and a model can use, and how many they cannot.
#[derive(Debug)]
pub struct JournalRows {
    model: String,
    design: String,
    /// Entries of every problem, by its hash.
    known: HashMap<String, Vec<Entry>>,
    /// Entries of this design among them.
    of_design: usize,
    /// Rows of other models, and rows that are no whole ones; neither is used.
    foreign: usize,
    damaged: usize,
}

impl JournalRows {
    /// None yet, for a `model` as [`model`] has it and the hash of what a design says.
    pub fn new(model: &str, design: &str) -> Self {
        Self {
            model: model.to_owned(),
            design: design.to_owned(),
            known: HashMap::new(),
            of_design: 0,
            foreign: 0,
            damaged: 0,
        }
    }

    /// Take up the whole lines of a record, its first line before them.
    pub fn read(&mut self, text: &[u8]) {
        text.split(|b| *b == b'\n').skip(1).filter(|line| !line.is_empty()).for_each(|line| self.learn(line));
    }

    fn learn(&mut self, line: &[u8]) {
        let row = cells(line).filter(|row| row.len() == COLUMNS.len() && row[CHECK] == check(row));
        let Some(row) = row else {
            self.damaged += 1;
            return;
        };
        match entry_of(&row).filter(|_| row[0] == self.model) {
            Some((problem, entry)) => {
                self.of_design += usize::from(row[1] == self.design);
                self.known.entry(problem).or_default().push(entry);
            }
            None => self.foreign += 1,
        }
    }

    /// What is not used, in words.
    pub fn unused(&self) -> Option<String> {
        let rows = |n: usize, what: &str| {
            (n > 0).then(|| format!("{n} {} {what}", if n == 1 { "row" } else { "rows" }))
        };
        let kinds = [
            rows(self.foreign, "by another version of the program"),
            rows(self.damaged, "whose check disagrees (damaged or edited)"),
        ];
        let kinds: Vec<String> = kinds.into_iter().flatten().collect();
        (!kinds.is_empty()).then(|| kinds.join(" and "))
    }

    /// Entries of a problem.
    pub fn known(&self, problem: &ProblemId) -> Journal {
        Journal::from_entries(self.known.get(&problem.hash).into_iter().flatten().cloned())
    }

    /// How many entries there are.
    pub fn entries(&self) -> usize {
        self.known.values().map(Vec::len).sum()
    }

    /// How many of them are of this design.
    pub fn of_design(&self) -> usize {
        self.of_design
    }

    /// The line of one evaluation.
    pub fn line(&self, problem: &ProblemId, entry: &Entry) -> String {
        let x = joined(&entry.x);
        let hash = hex(Sha256::digest(format!("{};{x}", problem.hash).as_bytes()), 16);
        let (outcome, objectives, limits, tie_break, detail) = match &entry.outcome {
            Ok(e) => ("ok", joined(&e.objectives), joined(&e.limits), number(e.tie_break), String::new()),
            Err(why) => {
                let (kind, detail) = typed(why);
                (kind, String::new(), String::new(), String::new(), detail)
            }
        };
        let mut row = csv::StringRecord::from(vec![
            self.model.as_str(),
            &self.design,
            &problem.hash,
            &hash,
            &problem.variables.join(";"),
            &x,
            outcome,
            &objectives,
            &limits,
            &tie_break,
            &problem.error,
            &detail,
        ]);
        row.push_field(&check(&row));
        let mut line = csv::Writer::from_writer(Vec::new());
        // Into memory: there is nothing that could fail.
        let _ = line.write_record(&row);
        String::from_utf8(line.into_inner().unwrap_or_default()).unwrap_or_default()
    }
}

/// One line as cells; `None` where it is none of a CSV table.
fn cells(line: &[u8]) -> Option<csv::StringRecord> {
    csv::ReaderBuilder::new().has_headers(false).from_reader(line).into_records().next()?.ok()
}

/// The first `bytes` of a digest as hex digits.
fn hex(digest: impl AsRef<[u8]>, bytes: usize) -> String {
    digest.as_ref().iter().take(bytes).map(|byte| format!("{byte:02x}")).collect()
}

/// Of all cells before `check`: the first 16 hex digits of their SHA-256, each cell with a line end behind it.
fn check(row: &csv::StringRecord) -> String {
    let cells = row.iter().take(CHECK);
    hex(cells.fold(Sha256::new(), |sum, cell| sum.chain_update(cell).chain_update("\n")).finalize(), 8)
}

/// Text without line ends, as in JSON, so that a row is one line.
fn one_line(text: &str) -> String {
    let quoted = serde_json::Value::from(text).to_string();
    quoted[1..quoted.len() - 1].to_owned()
}

fn as_written(cell: &str) -> Option<String> {
    serde_json::from_str(&format!("\"{cell}\"")).ok()
}

/// Shortest text that reads back as the same double.
fn number(v: f64) -> String {
    format!("{v:?}")
}

fn joined(values: &[f64]) -> String {
    values.iter().map(|v| number(*v)).collect::<Vec<_>>().join(";")
}

fn numbers(cell: &str) -> Option<Vec<f64>> {
    if cell.is_empty() { Some(Vec::new()) } else { cell.split(';').map(|v| v.parse().ok()).collect() }
}

fn typed(why: &NoEvaluation) -> (&'static str, String) {
    match why {
        NoEvaluation::Refused(why) => ("refused", one_line(why)),
        NoEvaluation::NotFinite { part, index } => ("not-finite", format!("{part:?};{index}")),
        NoEvaluation::Shape { expected, found } => {
            ("shape", format!("{};{};{};{}", expected.0, expected.1, found.0, found.1))
        }
    }
}

/// Problem and entry of one row; `None` for a row that this version does not understand.
fn entry_of(row: &csv::StringRecord) -> Option<(String, Entry)> {
    let cell = |i: usize| row.get(i);
    let outcome = match cell(6)? {
        "ok" => Ok(Evaluation {
            objectives: numbers(cell(7)?)?,
            limits: numbers(cell(8)?)?,
            tie_break: cell(9)?.parse().ok()?,
        }),
        "refused" => Err(NoEvaluation::Refused(as_written(cell(11)?)?)),
        "not-finite" => {
            let (part, index) = cell(11)?.split_once(';')?;
            let part = [EvaluationPart::Objective, EvaluationPart::Limit, EvaluationPart::TieBreak]
                .into_iter()
                .find(|p| format!("{p:?}") == part)?;
            Err(NoEvaluation::NotFinite { part, index: index.parse().ok()? })
        }
        "shape" => {
            let counts: Option<Vec<usize>> = cell(11)?.split(';').map(|v| v.parse().ok()).collect();
            let [a, b, c, d] = counts?[..] else { return None };
            Err(NoEvaluation::Shape { expected: (a, b), found: (c, d) })
        }
        _ => return None,
    };
    Some((cell(2)?.to_owned(), Entry { x: numbers(cell(5)?)?, outcome }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_back_and_what_was_edited_is_not_used() {
        let problem = ProblemId { hash: "p".into(), variables: vec!["a".into()], error: "1e-6".into() };
        let entries = [
            Entry {
                x: vec![0.1, -1e-300],
                outcome: Ok(Evaluation { objectives: vec![1.0 / 3.0], limits: vec![], tie_break: -0.0 }),
            },
            Entry { x: vec![2.0], outcome: Err(NoEvaluation::Refused("two\nlines, \"quoted\"".into())) },
            Entry {
                x: vec![3.0],
                outcome: Err(NoEvaluation::NotFinite { part: EvaluationPart::Limit, index: 4 }),
            },
            Entry { x: vec![4.0], outcome: Err(NoEvaluation::Shape { expected: (1, 2), found: (3, 4) }) },
        ];
        let rows = JournalRows::new("m", "d");
        let lines: Vec<String> = entries.iter().map(|entry| rows.line(&problem, entry)).collect();
        assert!(lines.iter().all(|line| line.matches('\n').count() == 1));
        let text = header() + &lines.concat();
        assert_eq!(JournalText::of(text.as_bytes()), JournalText::Journal);
        let read = |model: &str, text: &str| {
            let mut rows = JournalRows::new(model, "d");
            rows.read(text.as_bytes());
            rows
        };
        let again = read("m", &text);
        assert_eq!((again.entries(), again.of_design(), again.unused()), (4, 4, None));
        assert_eq!(again.known["p"], entries);
        assert_eq!(read("other", &text).entries(), 0);
        let edited = read("m", &text.replace("0.3333", "0.4333"));
        assert_eq!(edited.entries(), 3);
        assert!(edited.unused().unwrap().contains("1 row whose check disagrees"));
    }
}
