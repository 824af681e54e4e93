//! Rows of a sweep as lines of CSV.

use super::head::SweepHead;
use crate::design::{Optimize, did_you_mean};
use crate::optimise::Names;
use crate::sweep::{Decides, Sweep, SweepRow};

/// One column of a table of margins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum SweepColumn {
    Index,
    Variable(usize),
    Least,
    Margin,
    Deciding,
    Feasible,
    Objective(usize),
    Limit(usize),
    Refused,
}

/// Names of the columns that are neither variables nor rows of the problem.
pub(super) const FIXED: [&str; 6] = ["index", "least", "margin", "deciding", "feasible", "refused"];
/// First letters of the columns that are rows of the problem.
pub(super) const ROWS: [&str; 2] = ["objective.", "limit."];

/// A column that there is not.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("no column {name}; there are: {}; groups: variables, objectives, limits{}", .known.join(", "), did_you_mean(name, known))]
pub struct ColumnsUnknown {
    name: String,
    known: Vec<String>,
}

/// The text of a table of margins: two lines first, then one for each row.
#[derive(Debug, Clone)]
pub struct SweepLines {
    head: SweepHead,
    columns: Vec<(SweepColumn, String)>,
    /// Codes of objectives and limits.
    names: Names,
}

impl SweepLines {
    /// Every column of `sweep` under `head`, or those of `chosen` in their order; the number of the point comes first in any case.
    ///
    /// # Errors
    /// [`ColumnsUnknown`].
    pub fn new(head: SweepHead, sweep: &Sweep, chosen: &[String]) -> Result<Self, ColumnsUnknown> {
        let all = all(sweep);
        let mut columns = Vec::new();
        for name in chosen {
            let group = |c: &SweepColumn| {
                matches!(
                    (name.as_str(), c),
                    ("variables", SweepColumn::Variable(_))
                        | ("objectives", SweepColumn::Objective(_))
                        | ("limits", SweepColumn::Limit(_))
                )
            };
            let before = columns.len();
            columns.extend(all.iter().filter(|(c, known)| known == name || group(c)).cloned());
            if columns.len() == before && !["variables", "objectives", "limits"].contains(&name.as_str()) {
                let known = all.into_iter().map(|(_, name)| name).collect();
                return Err(ColumnsUnknown { name: name.clone(), known });
            }
        }
        let columns = if chosen.is_empty() {
            all
        } else {
            columns.retain(|(c, _)| *c != SweepColumn::Index);
            columns.insert(0, all[0].clone());
            columns
        };
        Ok(Self { head, columns, names: sweep.names().clone() })
    }

    /// The first two lines.
    pub fn begin(&self) -> Vec<u8> {
        begun(&self.head, self.columns.iter().map(|(_, name)| name.as_str()))
    }

    /// What was asked.
    pub fn head(&self) -> &SweepHead {
        &self.head
    }

    /// The line of point `index`.
    pub fn line(&self, index: u64, row: &SweepRow) -> Vec<u8> {
        let deciding = row.deciding();
        record(self.columns.iter().map(|(column, _)| match column {
            SweepColumn::Index => index.to_string(),
            SweepColumn::Variable(i) => number(row.x.get(*i).copied()),
            SweepColumn::Least => number(row.least()),
            SweepColumn::Margin => number(deciding.map(|(_, margin)| margin)),
            SweepColumn::Deciding => {
                let name = |(decides, _)| match decides {
                    Decides::Limit(i) => self.names.limits.get(i),
                    Decides::Objective(i) => self.names.objectives.get(i),
                };
                deciding.and_then(name).cloned().unwrap_or_default()
            }
            SweepColumn::Feasible => u8::from(row.feasible()).to_string(),
            SweepColumn::Objective(i) => {
                number(row.found.as_ref().ok().and_then(|e| e.objectives.get(*i).copied()))
            }
            SweepColumn::Limit(i) => number(row.found.as_ref().ok().and_then(|e| e.limits.get(*i).copied())),
            // One line for each point, whatever it says.
            SweepColumn::Refused => {
                row.found.as_ref().err().map(|why| why.replace(['\n', '\r'], " ")).unwrap_or_default()
            }
        }))
    }
}

/// All columns in their order.
fn all(sweep: &Sweep) -> Vec<(SweepColumn, String)> {
    let fixed = |c: SweepColumn, at: usize| (c, FIXED[at].to_owned());
    let names = sweep.names();
    let variables = sweep.task().variables.iter().enumerate();
    let mut all = vec![fixed(SweepColumn::Index, 0)];
    all.extend(variables.map(|(i, v)| (SweepColumn::Variable(i), v.name.clone())));
    all.extend([
        fixed(SweepColumn::Least, 1),
        fixed(SweepColumn::Margin, 2),
        fixed(SweepColumn::Deciding, 3),
        fixed(SweepColumn::Feasible, 4),
    ]);
    let rows = |codes: &[String], prefix: &str, column: fn(usize) -> SweepColumn| {
        let named = |(i, code): (usize, &String)| (column(i), format!("{prefix}{code}"));
        codes.iter().enumerate().map(named).collect::<Vec<_>>()
    };
    all.extend(rows(&names.objectives, ROWS[0], SweepColumn::Objective));
    all.extend(rows(&names.limits, ROWS[1], SweepColumn::Limit));
    all.push(fixed(SweepColumn::Refused, 5));
    all
}

/// The first two lines of a file of vectors.
pub(super) fn begin_vectors(head: &SweepHead, task: &Optimize) -> Vec<u8> {
    begun(head, std::iter::once(FIXED[0]).chain(task.variables.iter().map(|v| v.name.as_str())))
}

/// The line of a point.
pub(super) fn vector_line(index: u64, x: &[f64]) -> Vec<u8> {
    record(std::iter::once(index.to_string()).chain(x.iter().map(|v| number(Some(*v)))))
}

fn begun<'n>(head: &SweepHead, names: impl Iterator<Item = &'n str>) -> Vec<u8> {
    [format!("{head}\n").into_bytes(), record(names)].concat()
}

/// Every digit; nothing where there is no number.
fn number(value: Option<f64>) -> String {
    value.filter(|v| v.is_finite()).map(|v| v.to_string()).unwrap_or_default()
}

/// A line of CSV with its end.
fn record<C: AsRef<[u8]>>(cells: impl Iterator<Item = C>) -> Vec<u8> {
    let mut writer = csv::WriterBuilder::new().flexible(true).from_writer(Vec::new());
    // Writing into memory gives no cause to fail.
    let _ = writer.write_record(cells);
    writer.into_inner().unwrap_or_default()
}
