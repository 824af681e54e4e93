//! The record of a search: one CSV row per evaluation, appended, so that a stop at any moment loses at most what is
//! under way, and later searches of the same problem need not repeat it.
//!
//! Columns: `model` (tool, version, and a hash of the sources that compute a margin, made by `build.rs`), `design` (hash of what the design
//! file says, comments apart), `problem` (hash of everything that an evaluation depends on but the variables), `hash` (of problem and
//! inputs), `variables` and `x` (canonical inputs), `outcome` (`ok`, `refused`, `not-finite`, `shape`), `objectives`, `limits`,
//! `tie_break`, `error` (tolerance of the evaluation), `detail` (why it failed), `check` (of all cells before it). Lists within
//! a cell are separated by semicolons; numbers read back exactly; a row is one line.
//!
//! What is believed: a row of this very model whose `check` agrees. All others stay in the file and are not used. `check`
//! tells a damaged or edited row from a whole one; it does not prove that the numbers were computed. The optimum found is
//! computed anew in every search, whatever a journal says of it.
//!
//! One search at a time: the file is locked as long as it is written. It is changed only after its header was read.

use super::exit::Failure;
use super::output::{TOOL, VERSION};
use crate::optimise::{Entry, Evaluation, EvaluationPart, Journal, NoEvaluation, ProblemId};
use sha2::{Digest, Sha256};
use std::collections::HashMap;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{ErrorKind, Read, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

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
    format!("{TOOL} {VERSION} {}", env!("SPRAG_DESIGN_MODEL"))
}

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
    /// Rows of other models, and rows that are no whole ones; neither is used.
    foreign: usize,
    damaged: usize,
    /// First failure to write; the search goes on without the journal, the end reports it.
    pub failed: Option<String>,
}

/// What a file is by its first line.
enum JournalText {
    /// Nothing yet, or the beginning of a first line that a kill cut short.
    Nothing,
    Journal,
    /// A journal by a version that wrote no `check`.
    Earlier,
    Foreign,
}

impl JournalText {
    fn of(text: &[u8]) -> Self {
        let header = COLUMNS.join(",") + "\n";
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

/// One line as cells; `None` where it is none of a CSV table.
fn cells(line: &[u8]) -> Option<csv::StringRecord> {
    csv::ReaderBuilder::new().has_headers(false).from_reader(line).into_records().next()?.ok()
}

fn named(path: &Path, e: &dyn std::fmt::Display) -> Failure {
    Failure::Failed(format!("{}: {e}", path.display()))
}

impl JournalFile {
    /// Begin a journal at `path`. A journal that is there already keeps its rows under the name given back.
    ///
    /// # Errors
    /// As [`Self::open`].
    pub fn begin(path: &Path, model: &str, design: &str) -> Result<(Self, Option<PathBuf>), Failure> {
        let (file, text) = locked(path)?;
        let old = match JournalText::of(&text) {
            JournalText::Journal => text.iter().filter(|b| **b == b'\n').count() > 1,
            JournalText::Earlier => true,
            JournalText::Nothing | JournalText::Foreign => false,
        };
        if !old {
            return Ok((Self::around(path, file, &text, model, design)?, None));
        }
        let kept = free_name(path);
        std::fs::rename(path, &kept).map_err(|e| named(path, &e))?;
        // The old file stays locked until there is a new one.
        let begun = Self::open(path, model, design)?;
        drop(file);
        Ok((begun, Some(kept)))
    }

    /// Take up the journal at `path`, or begin it where there is none. A last line cut short by a kill is dropped.
    ///
    /// # Errors
    /// [`Failure::Malformed`] where the file is no journal, or one of a version without `check`; it is left as it is.
    /// [`Failure::Failed`] where another search is writing it, or it cannot be read.
    pub fn open(path: &Path, model: &str, design: &str) -> Result<Self, Failure> {
        let (file, text) = locked(path)?;
        Self::around(path, file, &text, model, design)
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

    /// The rows of `text`, which `file` holds; only now is the file changed.
    fn around(path: &Path, file: File, text: &[u8], model: &str, design: &str) -> Result<Self, Failure> {
        let refused =
            |why: &str| Failure::malformed(format!("{} {why}; it is left as it is", path.display()));
        let mut out = Self {
            path: path.to_path_buf(),
            file,
            model: model.to_owned(),
            design: design.to_owned(),
            known: HashMap::new(),
            of_design: 0,
            foreign: 0,
            damaged: 0,
            failed: None,
        };
        let whole = match JournalText::of(text) {
            JournalText::Nothing => 0,
            JournalText::Journal => text.iter().rposition(|b| *b == b'\n').map_or(0, |at| at + 1),
            JournalText::Earlier => {
                return Err(refused(
                    "is a journal by an earlier version of the program, whose rows cannot be checked; name another file with --journal",
                ));
            }
            JournalText::Foreign => {
                return Err(refused("is no journal of a search; name another file with --journal"));
            }
        };
        if whole < text.len() {
            out.file.set_len(whole as u64).map_err(|e| named(path, &e))?;
        }
        if whole == 0 {
            out.row(&COLUMNS.map(str::to_owned));
            return out.failed.as_ref().map_or(Ok(()), |why| Err(named(path, why))).map(|()| out);
        }
        for line in text[..whole].split(|b| *b == b'\n').skip(1).filter(|line| !line.is_empty()) {
            out.learn(line);
        }
        Ok(out)
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

    /// What of the file is not used, in words.
    pub fn unused(&self) -> Option<String> {
        let rows = |n: usize, what: &str| {
            (n > 0).then(|| format!("{n} {} {what}", if n == 1 { "row" } else { "rows" }))
        };
        let kinds = [
            rows(self.foreign, "by another version of the program"),
            rows(self.damaged, "whose check disagrees (damaged or edited)"),
        ];
        let kinds: Vec<String> = kinds.into_iter().flatten().collect();
        let list = kinds.join(" and ");
        (!kinds.is_empty()).then(|| format!("{}: {list}: kept there, not used", self.path.display()))
    }

    /// Delete the file: the search is over, nothing is left to resume.
    pub fn discard(self) {
        let _ = std::fs::remove_file(&self.path);
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
        let cells = [
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
        ];
        let check = check(&csv::StringRecord::from(&cells[..]));
        self.row(&std::array::from_fn(|i| cells.get(i).unwrap_or(&check).clone()));
    }

    /// Nothing is written behind a row that failed: what is left of it would be glued to the next.
    fn row(&mut self, cells: &[String; COLUMNS.len()]) {
        if self.failed.is_some() {
            return;
        }
        let mut line = csv::Writer::from_writer(Vec::new());
        let written = line.write_record(cells).map_err(|e| e.to_string()).and_then(|()| {
            let bytes = line.into_inner().map_err(|e| e.to_string())?;
            // One call: a kill leaves a whole line or a torn one, never two mixed.
            self.file.write_all(&bytes).map_err(|e| e.to_string())
        });
        if let Err(why) = written {
            self.failed = Some(why);
        }
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

/// The file at `path` and what it holds; there, if it was not, and locked for as long as it is open.
fn locked(path: &Path) -> Result<(File, Vec<u8>), Failure> {
    let options = OpenOptions::new().read(true).append(true).create(true).to_owned();
    if std::fs::metadata(path).is_ok_and(|there| !there.is_file()) {
        let why = "no regular file; name another one with --journal";
        return Err(Failure::of(path, why));
    }
    let mut file = options.open(path).map_err(|e| named(path, &e))?;
    // A search that is just ending lets go of it in a moment.
    let mut tries = 0..25;
    let lock = loop {
        match file.try_lock() {
            Err(TryLockError::WouldBlock) if tries.next().is_some() => {
                std::thread::sleep(Duration::from_millis(20));
            }
            other => break other,
        }
    };
    match lock {
        Ok(()) => {}
        Err(TryLockError::WouldBlock) => {
            let why = "another search is writing this journal; wait until it has ended, or name another file with --journal";
            return Err(named(path, &why));
        }
        // A file system that knows no locks still keeps a journal.
        Err(TryLockError::Error(e)) if e.kind() == ErrorKind::Unsupported => {}
        Err(TryLockError::Error(e)) => return Err(named(path, &e)),
    }
    let mut text = Vec::new();
    file.read_to_end(&mut text).map_err(|e| named(path, &e))?;
    Ok((file, text))
}

/// `path` with the first number behind it that no file has.
fn free_name(path: &Path) -> PathBuf {
    let numbered = |n: u32| {
        let mut name = path.as_os_str().to_owned();
        name.push(format!(".{n}"));
        PathBuf::from(name)
    };
    (1..).map(numbered).find(|name| !name.exists()).unwrap_or_else(|| numbered(0))
}

/// Of all cells before `check`: the first 16 hex digits of their SHA-256, each cell with a line end behind it.
fn check(row: &csv::StringRecord) -> String {
    let digest =
        row.iter().take(CHECK).fold(Sha256::new(), |sum, cell| sum.chain_update(cell).chain_update("\n"));
    digest.finalize().iter().take(8).map(|byte| format!("{byte:02x}")).collect()
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

/// The journal beside the design to be written.
pub fn path_for(output: &Path) -> PathBuf {
    let mut name = output.as_os_str().to_owned();
    name.push(".journal");
    PathBuf::from(name)
}
