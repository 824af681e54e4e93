//! Where answers go: standard output, or files written whole or not at all.

use super::exit::Failure;
use crate::report::{Page, Table};
use serde::Serialize;
use serde_json::Value;
use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Program name in every output.
pub const TOOL: &str = env!("CARGO_PKG_NAME");
/// Program version in every output.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// What every JSON object begins with; the command's own keys follow.
#[derive(Debug, Serialize)]
pub struct Envelope<'a, L: Serialize, B: Serialize> {
    tool: &'static str,
    version: &'static str,
    design: &'a str,
    design_hash: &'a str,
    run_time_s: f64,
    left_out: &'a L,
    #[serde(skip_serializing_if = "Option::is_none")]
    error_estimate: Option<Value>,
    #[serde(flatten)]
    body: &'a B,
}

impl<'a, L: Serialize, B: Serialize> Envelope<'a, L, B> {
    /// `run_time_s`: wall time of the computation alone. `left_out`: a list of the terms left out, each
    /// with its reason and cost. `error_estimate`: a number or an object of numbers. `body`: a struct or map with the command's own keys.
    pub fn new(
        design: &'a str,
        design_hash: &'a str,
        run_time_s: f64,
        left_out: &'a L,
        error_estimate: Option<Value>,
        body: &'a B,
    ) -> Self {
        Self { tool: TOOL, version: VERSION, design, design_hash, run_time_s, left_out, error_estimate, body }
    }
}

/// Print to standard output. A reader that has gone (`| head`) is no failure.
///
/// # Errors
/// [`Failure::Failed`] where standard output cannot be written for another reason (full disk).
pub fn print(text: &str) -> Result<(), Failure> {
    heard(text).map(|_| ())
}

/// As [`print()`]; `false` where the reader has gone, so that nothing more need be computed.
///
/// # Errors
/// As [`print()`].
pub fn heard(text: &str) -> Result<bool, Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Ok(()) => Ok(true),
        Err(e) if e.kind() == ErrorKind::BrokenPipe => Ok(false),
        Err(e) => Err(Failure::Failed(format!("standard output: {e}"))),
    }
}

/// One line on standard error. A reader that has gone is nobody to complain to.
pub fn note(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}

/// One JSON object on one line of standard output.
///
/// # Errors
/// As [`print()`]; also where `value` has no JSON form.
pub fn print_json(value: &impl Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string(value).map_err(|e| Failure::Failed(format!("JSON: {e}")))?;
    print(&(text + "\n"))
}

/// What is written into a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A table or journal, CSV.
    Table,
    /// A page.
    Page,
    /// A design file.
    Design,
    /// A finite-element deck.
    Deck,
}

impl Kind {
    /// The kind that a file is of by its name; `None` where that says nothing.
    fn of(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
            "csv" => Some(Self::Table),
            "html" | "htm" => Some(Self::Page),
            "toml" => Some(Self::Design),
            "inp" => Some(Self::Deck),
            _ => None,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Table => "a table",
            Self::Page => "a page",
            Self::Design => "a design file",
            Self::Deck => "a deck",
        }
    }
}

/// Files that may be written, checked before any computing begins.
#[derive(Debug, Clone, Default)]
pub struct Outputs {
    /// `--csv`.
    pub csv: Option<PathBuf>,
    /// `--report`.
    pub report: Option<PathBuf>,
}

impl Outputs {
    /// Refuse what would only fail, or do harm, after the work is done: the input as an output, one file
    /// for two outputs, a folder that is not there, a file that is of another kind by its name. `inputs`: files that the
    /// command reads, the design first; `others`: further outputs of the command.
    ///
    /// # Errors
    /// [`Failure::Malformed`] naming the path.
    pub fn check(&self, inputs: &[&Path], others: &[(&Path, Kind)]) -> Result<(), Failure> {
        let csv = self.csv.iter().map(|path| (path.as_path(), Kind::Table));
        let report = self.report.iter().map(|path| (path.as_path(), Kind::Page));
        let mut seen: Vec<PathBuf> = Vec::new();
        for (path, kind) in csv.chain(report).chain(others.iter().copied()) {
            if path.is_dir() {
                return Err(refused(path, "is a folder, a file is needed"));
            }
            let folder = folder_of(path);
            if !folder.is_dir() {
                return Err(refused(path, &format!("the folder {} does not exist", folder.display())));
            }
            let here = resolved(path);
            match inputs.iter().position(|input| here == resolved(input)) {
                Some(0) => return Err(refused(path, "is the design file itself; it is never overwritten")),
                Some(_) => return Err(refused(path, "is read by this command; it is never overwritten")),
                None => {}
            }
            // Two outputs to /dev/null or to a terminal do no harm.
            if is_special(path) {
                continue;
            }
            if seen.contains(&here) {
                return Err(refused(path, "is named for two outputs"));
            }
            if let Some(there) = Kind::of(path).filter(|there| *there != kind && path.exists()) {
                let (there, new) = (there.name(), kind.name());
                return Err(refused(path, &format!("is {there} already; {new} does not overwrite it")));
            }
            seen.push(here);
        }
        Ok(())
    }

    /// Write the table if `--csv` was given.
    ///
    /// # Errors
    /// [`Failure::Failed`] naming the path.
    pub fn write_csv(&self, table: &Table) -> Result<(), Failure> {
        self.csv.as_deref().map_or(Ok(()), |path| write_table(path, table))
    }

    /// Write the page if `--report` was given; it is only made then.
    ///
    /// # Errors
    /// [`Failure::Failed`] naming the path.
    pub fn write_report(&self, page: impl FnOnce() -> Page) -> Result<(), Failure> {
        let Some(path) = &self.report else { return Ok(()) };
        write_whole(path, page().to_html().as_bytes())
    }
}

/// Write a table as CSV.
///
/// # Errors
/// [`Failure::Failed`] naming the path.
pub fn write_table(path: &Path, table: &Table) -> Result<(), Failure> {
    let bytes = table.to_csv().map_err(|e| Failure::Failed(format!("{}: {e}", path.display())))?;
    write_whole(path, &bytes)
}

fn refused(path: &Path, why: &str) -> Failure {
    Failure::malformed(format!("{}: {why}", path.display()))
}

/// The folder that a path lies in.
pub fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_path_buf(),
        _ => PathBuf::from("."),
    }
}

/// The path with links and dots resolved, also where the file itself is not there yet.
fn resolved(path: &Path) -> PathBuf {
    fs::canonicalize(path).unwrap_or_else(|_| {
        let folder = fs::canonicalize(folder_of(path)).unwrap_or_else(|_| folder_of(path));
        path.file_name().map_or(folder.clone(), |name| folder.join(name))
    })
}

/// A device or pipe: written to, never replaced.
fn is_special(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|m| !m.is_file() && !m.is_dir())
}

/// Write `bytes` so that `path` holds either its old content or all of the new, whatever happens in
/// between: a temporary file beside it, flushed to disk, then renamed over it.
///
/// # Errors
/// [`Failure::Failed`] naming the path; the temporary file is removed.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let named = |e: io::Error| Failure::Failed(format!("cannot write {}: {e}", path.display()));
    if is_special(path) {
        let mut device = OpenOptions::new().write(true).open(path).map_err(named)?;
        return device.write_all(bytes).map_err(named);
    }
    // Behind a link the linked file is replaced, not the link.
    let target = resolved(path);
    let name =
        target.file_name().ok_or_else(|| refused(path, "names no file"))?.to_string_lossy().into_owned();
    let folder = folder_of(&target);
    let temporary = Temporary(folder.join(format!(".{name}.{}.tmp", std::process::id())));
    let mut file = OpenOptions::new().write(true).create_new(true).open(&temporary.0).map_err(named)?;
    file.write_all(bytes).map_err(named)?;
    if let Ok(old) = fs::metadata(&target) {
        file.set_permissions(old.permissions()).map_err(named)?;
    }
    file.sync_all().map_err(named)?;
    drop(file);
    fs::rename(&temporary.0, &target).map_err(named)?;
    // The rename itself reaches the disk with the folder; where folders cannot be opened (Windows) it does so anyway.
    if let Ok(folder) = File::open(&folder) {
        let _ = folder.sync_all();
    }
    Ok(())
}

/// Removed when dropped; after the rename there is nothing left to remove.
struct Temporary(PathBuf);

impl Drop for Temporary {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.0);
    }
}

#[cfg(test)]
mod tests;
