//! The file of a search's record: appended, so that a stop at any moment loses at most what is under way. What its rows hold and which of
//! them are believed says `crate::journal`; all others stay in the file. The optimum found is computed anew in every search, whatever a
//! journal says of it.
//!
//! One search at a time: the file is locked as long as it is written. It is changed only after its header was read.

use super::exit::Failure;
pub use crate::journal::model;
use crate::journal::{JournalRows, JournalText, header};
use crate::optimise::{Entry, Journal, ProblemId};
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{ErrorKind, Read, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// An open journal file with what it held when it was opened.
#[derive(Debug)]
pub struct JournalFile {
    path: PathBuf,
    file: File,
    rows: JournalRows,
    /// First failure to write; the search goes on without the journal, the end reports it.
    pub failed: Option<String>,
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
        if out.rows.of_design() == 0 {
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
        let rows = JournalRows::new(model, design);
        let mut out = Self { path: path.to_path_buf(), file, rows, failed: None };
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
            out.line(&header());
            return out.failed.as_ref().map_or(Ok(()), |why| Err(named(path, why))).map(|()| out);
        }
        out.rows.read(&text[..whole]);
        Ok(out)
    }

    /// What of the file is not used, in words.
    pub fn unused(&self) -> Option<String> {
        let list = self.rows.unused()?;
        Some(format!("{}: {list}: kept there, not used", self.path.display()))
    }

    /// Delete the file: the search is over, nothing is left to resume.
    pub fn discard(self) {
        let _ = std::fs::remove_file(&self.path);
    }

    /// Entries of a problem.
    pub fn known(&self, problem: &ProblemId) -> Journal {
        self.rows.known(problem)
    }

    /// How many entries there were.
    pub fn entries(&self) -> usize {
        self.rows.entries()
    }

    /// Append one evaluation and hand it to the system.
    pub fn append(&mut self, problem: &ProblemId, entry: &Entry) {
        let line = self.rows.line(problem, entry);
        self.line(&line);
    }

    /// Nothing is written behind a line that failed: what is left of it would be glued to the next.
    fn line(&mut self, line: &str) {
        if self.failed.is_none() {
            // One call: a kill leaves a whole line or a torn one, never two mixed.
            self.failed = self.file.write_all(line.as_bytes()).err().map(|e| e.to_string());
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

/// The journal beside the design to be written.
pub fn path_for(output: &Path) -> PathBuf {
    let mut name = output.as_os_str().to_owned();
    name.push(".journal");
    PathBuf::from(name)
}
