//! The record of a search: one line per evaluation, so that a stop at any moment loses at most what is under way.

use super::exit::Failure;
use crate::optimise::{Entry, Journal};
use serde::{Deserialize, Serialize};
use std::fs::File;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};

/// First line: what the entries belong to.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Header {
    /// Tool and version: another version may answer otherwise.
    pub tool: String,
    /// Hash of the design file the search started from.
    pub design_hash: String,
    /// Variables, in the order of each entry's x.
    pub variables: Vec<String>,
}

/// An open journal file.
#[derive(Debug)]
pub struct JournalFile {
    path: PathBuf,
    file: File,
    /// First failure to write; the search goes on, the end reports it.
    pub failed: Option<String>,
}

fn named(path: &Path, e: &dyn std::fmt::Display) -> Failure {
    Failure::Failed(format!("{}: {e}", path.display()))
}

/// Begin a journal at `path`; an old one is replaced.
///
/// # Errors
/// [`Failure::Failed`] naming the path.
pub fn begin(path: &Path, header: &Header) -> Result<JournalFile, Failure> {
    let file = File::create(path).map_err(|e| named(path, &e))?;
    let mut out = JournalFile { path: path.to_path_buf(), file, failed: None };
    out.line(header);
    match out.failed.take() {
        Some(why) => Err(named(path, &why)),
        None => Ok(out),
    }
}

/// Take up the journal at `path`. A last line cut short by a kill is dropped.
///
/// # Errors
/// [`Failure::Malformed`] where the file is no journal or belongs to another design, version or set of
/// variables; [`Failure::Failed`] where it cannot be read.
pub fn resume(path: &Path, header: &Header) -> Result<(Journal, JournalFile), Failure> {
    let file = File::open(path).map_err(|e| {
        Failure::malformed(format!("--resume: {}: {e}; there is no search to go on with", path.display()))
    })?;
    let mut lines = BufReader::new(file).lines();
    let first = match lines.next() {
        Some(line) => line.map_err(|e| named(path, &e))?,
        None => String::new(),
    };
    let found: Header = serde_json::from_str(&first)
        .map_err(|_| Failure::malformed(format!("--resume: {} is no journal of a search", path.display())))?;
    if found != *header {
        let what = if found.design_hash != header.design_hash {
            "another design (the file has changed since)"
        } else if found.tool != header.tool {
            "another version of the program"
        } else {
            "other variables"
        };
        return Err(Failure::malformed(format!(
            "--resume: {} belongs to {what}; start without --resume",
            path.display()
        )));
    }
    let mut entries: Vec<Entry> = Vec::new();
    for line in lines {
        let line = line.map_err(|e| named(path, &e))?;
        match serde_json::from_str(&line) {
            Ok(entry) => entries.push(entry),
            Err(_) => break,
        }
    }
    // Written anew, so that a torn last line does not spoil the next one.
    let mut out = begin(path, header)?;
    for entry in &entries {
        out.line(entry);
    }
    Ok((Journal::from_entries(entries), out))
}

impl JournalFile {
    /// Append one line and hand it to the system.
    pub fn line(&mut self, value: &impl Serialize) {
        let written = serde_json::to_string(value)
            .map_err(|e| e.to_string())
            .and_then(|text| self.file.write_all((text + "\n").as_bytes()).map_err(|e| e.to_string()));
        if let Err(why) = written {
            self.failed.get_or_insert(why);
        }
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }
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
    use crate::optimise::Evaluation;

    #[test]
    fn a_torn_journal_gives_back_every_whole_line_and_another_design_is_refused() {
        let folder = std::env::temp_dir().join(format!("sprag-journal-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let path = folder.join("a.toml.journal");
        let header = Header { tool: "t 1".into(), design_hash: "h".into(), variables: vec!["x".into()] };
        let mut file = begin(&path, &header).unwrap();
        let evaluation = Evaluation { objectives: vec![0.1 + 0.2], limits: vec![1.0 / 3.0], tie_break: 0.0 };
        let entry = Entry { x: vec![0.1], outcome: Ok(evaluation) };
        file.line(&entry);
        drop(file);
        // A kill in the middle of a line.
        let mut torn = std::fs::OpenOptions::new().append(true).open(&path).unwrap();
        torn.write_all(b"{\"x\":[1.0,").unwrap();
        drop(torn);
        let (journal, file) = resume(&path, &header).unwrap();
        assert_eq!(journal.entries(), &[entry]);
        drop(file);
        let other = Header { design_hash: "i".into(), ..header };
        assert!(matches!(resume(&path, &other), Err(Failure::Malformed(_))));
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
