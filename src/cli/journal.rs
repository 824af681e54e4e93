//! The record of a search: one CSV row per evaluation, appended, so that a stop at any moment loses at most what is
//! under way, and later searches of the same problem need not repeat it.
//!
//! Columns: `model` (tool and version), `design` (hash of what the design file says, comments apart), `problem` (hash of everything that an
//! evaluation depends on but the variables), `hash` (of problem and inputs), `variables` and `x` (canonical inputs),
//! `outcome` (`ok`, `refused`, `not-finite`, `shape`), `objectives`, `limits`, `tie_break`, `error` (tolerance of the
//! evaluation), `detail` (why it failed). Lists within a cell are separated by semicolons; numbers read back exactly.

use super::exit::Failure;
use crate::optimise::{Entry, Evaluation, Failure as NoMargins, Journal, Part, ProblemId};
use sha2::{Digest, Sha256};
use std::collections::HashMap;
use std::fs::{File, OpenOptions};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Names of the columns.
const COLUMNS: [&str; 12] = [
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
];

/// An open journal file with what it held when it was opened.
#[derive(Debug)]
pub struct JournalFile {
    path: PathBuf,
    file: File,
    model: String,
    design: String,
    /// Entries of every problem, by its hash.
    known: HashMap<String, Vec<Entry>>,
    /// Entries of this design among them.
    of_design: usize,
    /// First failure to write; the search goes on, the end reports it.
    pub failed: Option<String>,
}

fn named(path: &Path, e: &dyn std::fmt::Display) -> Failure {
    Failure::Failed(format!("{}: {e}", path.display()))
}

impl JournalFile {
    /// Begin a journal at `path`; an old one is replaced.
    ///
    /// # Errors
    /// [`Failure::Failed`] naming the path.
    pub fn begin(path: &Path, model: &str, design: &str) -> Result<Self, Failure> {
        let file = File::create(path).map_err(|e| named(path, &e))?;
        let mut out = Self::around(path, file, model, design);
        out.row(&COLUMNS.map(str::to_owned));
        match out.failed.take() {
            Some(why) => Err(named(path, &why)),
            None => Ok(out),
        }
    }

    /// Take up the journal at `path`, or begin it where there is none. A last line cut short by a kill is dropped;
    /// rows of another version of the program are kept and not used.
    ///
    /// # Errors
    /// [`Failure::Malformed`] where the file is no journal; [`Failure::Failed`] where it cannot be read.
    pub fn open(path: &Path, model: &str, design: &str) -> Result<Self, Failure> {
        let text = match std::fs::read(path) {
            Ok(text) => text,
            Err(e) if e.kind() == ErrorKind::NotFound => return Self::begin(path, model, design),
            Err(e) => return Err(named(path, &e)),
        };
        let whole = text.iter().rposition(|b| *b == b'\n').map_or(0, |at| at + 1);
        let mut rows = csv::ReaderBuilder::new().flexible(true).from_reader(&text[..whole]);
        if rows.headers().is_ok_and(|h| !h.iter().eq(COLUMNS)) {
            return Err(Failure::malformed(format!("{} is no journal of a search", path.display())));
        }
        let file = OpenOptions::new().append(true).open(path).map_err(|e| named(path, &e))?;
        file.set_len(whole as u64).map_err(|e| named(path, &e))?;
        let mut out = Self::around(path, file, model, design);
        for row in rows.records().flatten() {
            if let Some((problem, entry)) = entry_of(&row).filter(|_| row.get(0) == Some(model)) {
                out.of_design += usize::from(row.get(1) == Some(design));
                out.known.entry(problem).or_default().push(entry);
            }
        }
        Ok(out)
    }

    /// As [`Self::open`], for `--resume`: there must be something to go on with.
    ///
    /// # Errors
    /// Also [`Failure::Malformed`] where there is no journal, or none of its rows belong to this design and version.
    pub fn resume(path: &Path, model: &str, design: &str) -> Result<Self, Failure> {
        if !path.exists() {
            return Err(Failure::malformed(format!(
                "--resume: {}: there is no such file, so there is no search to go on with",
                path.display()
            )));
        }
        let out = Self::open(path, model, design)?;
        if out.of_design == 0 {
            return Err(Failure::malformed(format!(
                "--resume: no row of {} belongs to what this design file says now and to {model}; start without --resume",
                path.display()
            )));
        }
        Ok(out)
    }

    fn around(path: &Path, file: File, model: &str, design: &str) -> Self {
        Self {
            path: path.to_path_buf(),
            file,
            model: model.to_owned(),
            design: design.to_owned(),
            known: HashMap::new(),
            of_design: 0,
            failed: None,
        }
    }

    /// Entries of a problem.
    pub fn known(&self, problem: &ProblemId) -> Journal {
        Journal::from_entries(self.known.get(&problem.hash).into_iter().flatten().cloned())
    }

    /// How many entries there were.
    pub fn entries(&self) -> usize {
        self.known.values().map(Vec::len).sum()
    }

    /// Append one evaluation and hand it to the system.
    pub fn append(&mut self, problem: &ProblemId, entry: &Entry) {
        let x = joined(&entry.x);
        let hash = Sha256::digest(format!("{};{x}", problem.hash).as_bytes());
        let hash: String = hash.iter().take(16).map(|byte| format!("{byte:02x}")).collect();
        let (outcome, objectives, limits, tie_break, detail) = match &entry.outcome {
            Ok(e) => ("ok", joined(&e.objectives), joined(&e.limits), number(e.tie_break), String::new()),
            Err(why) => {
                let (kind, detail) = typed(why);
                (kind, String::new(), String::new(), String::new(), detail)
            }
        };
        self.row(&[
            self.model.clone(),
            self.design.clone(),
            problem.hash.clone(),
            hash,
            problem.variables.join(";"),
            x,
            outcome.to_owned(),
            objectives,
            limits,
            tie_break,
            problem.error.clone(),
            detail,
        ]);
    }

    fn row(&mut self, cells: &[String; 12]) {
        let mut line = csv::Writer::from_writer(Vec::new());
        let written = line.write_record(cells).map_err(|e| e.to_string()).and_then(|()| {
            let bytes = line.into_inner().map_err(|e| e.to_string())?;
            // One call: a kill leaves a whole line or a torn one, never two mixed.
            self.file.write_all(&bytes).map_err(|e| e.to_string())
        });
        if let Err(why) = written {
            self.failed.get_or_insert(why);
        }
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }
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

fn typed(why: &NoMargins) -> (&'static str, String) {
    match why {
        NoMargins::Refused(why) => ("refused", why.clone()),
        NoMargins::NotFinite { part, index } => ("not-finite", format!("{part:?};{index}")),
        NoMargins::Shape { expected, found } => {
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
        "refused" => Err(NoMargins::Refused(cell(11)?.to_owned())),
        "not-finite" => {
            let (part, index) = cell(11)?.split_once(';')?;
            let part = [Part::Objective, Part::Limit, Part::TieBreak]
                .into_iter()
                .find(|p| format!("{p:?}") == part)?;
            Err(NoMargins::NotFinite { part, index: index.parse().ok()? })
        }
        "shape" => {
            let counts: Option<Vec<usize>> = cell(11)?.split(';').map(|v| v.parse().ok()).collect();
            let [a, b, c, d] = counts?[..] else { return None };
            Err(NoMargins::Shape { expected: (a, b), found: (c, d) })
        }
        _ => return None,
    };
    Some((cell(2)?.to_owned(), Entry { x: numbers(cell(5)?)?, outcome }))
}

/// The journal beside the design to be written.
pub fn path_for(output: &Path) -> PathBuf {
    let mut name = output.as_os_str().to_owned();
    name.push(".journal");
    PathBuf::from(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn problem() -> ProblemId {
        ProblemId { hash: "p".into(), variables: vec!["r_i2_mm".into(), "x".into()], error: "1e-6".into() }
    }

    fn entry(x: f64, outcome: Result<Evaluation, NoMargins>) -> Entry {
        Entry { x: vec![x, -0.1], outcome }
    }

    #[test]
    fn a_torn_journal_gives_back_every_whole_row_to_the_bit() {
        let folder = std::env::temp_dir().join(format!("sprag-journal-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let path = folder.join("a.toml.journal");
        let mut file = JournalFile::begin(&path, "t 1", "d").unwrap();
        let good =
            Evaluation { objectives: vec![0.1 + 0.2, -1e-300], limits: vec![1.0 / 3.0], tie_break: 4.2 };
        let entries = [
            entry(0.1, Ok(good)),
            entry(0.2, Err(NoMargins::Refused("a, \"b\";\nc".into()))),
            entry(0.3, Err(NoMargins::NotFinite { part: Part::Limit, index: 3 })),
            entry(0.4, Err(NoMargins::Shape { expected: (1, 2), found: (3, 4) })),
        ];
        entries.iter().for_each(|e| file.append(&problem(), e));
        drop(file);
        // A kill in the middle of a number: what is left of the line would still read as a row.
        let mut torn = OpenOptions::new().append(true).open(&path).unwrap();
        torn.write_all(b"t 1,d,p,h,r_i2_mm;x,0.5;0.1,ok,0.1,0.1,0.1,1e-6,").unwrap();
        drop(torn);
        let mut file = JournalFile::resume(&path, "t 1", "d").unwrap();
        assert_eq!(file.known(&problem()).entries(), &entries);
        let more = entry(0.6, Err(NoMargins::Refused("late".into())));
        file.append(&problem(), &more);
        drop(file);
        let file = JournalFile::open(&path, "t 1", "d").unwrap();
        assert_eq!(file.known(&problem()).entries().last(), Some(&more));
        // Another version knows nothing of it, another design has nothing to resume, another problem no entries.
        assert_eq!(JournalFile::open(&path, "t 2", "d").unwrap().entries(), 0);
        assert!(matches!(JournalFile::resume(&path, "t 1", "e"), Err(Failure::Malformed(_))));
        let other = ProblemId { hash: "q".into(), ..problem() };
        assert!(file.known(&other).entries().is_empty());
        std::fs::write(&path, "a,b\n1,2\n").unwrap();
        assert!(matches!(JournalFile::open(&path, "t 1", "d"), Err(Failure::Malformed(_))));
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
