//! Where answers go: standard output, or files written whole or not at all.

use super::exit::Failure;
use super::origin::FileKind;
pub use crate::answer::{TOOL, VERSION};
use crate::file::shown;
use crate::report::{Page, Table};
use serde::Serialize;
use serde_json::{Value, json};
use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// Print to standard output. A reader that has gone (`| head`) is no failure.
///
/// # Errors
/// [`Failure::Failed`] where standard output cannot be written for another reason (full disk).
pub fn print(text: &str) -> Result<(), Failure> {
    heard(text).map(|_| ())
}

/// The text with lines of more than `columns` characters folded at blanks, what goes on set in by two more than they are.
pub fn folded(text: &str, columns: usize) -> String {
    let fold = |line: &str| {
        let bare = line.trim_end_matches('\n');
        if textwrap::core::display_width(bare) <= columns {
            return line.to_owned();
        }
        let first = " ".repeat(bare.len() - bare.trim_start().len());
        let further = format!("{first}  ");
        let options = textwrap::Options::new(columns)
            .initial_indent(&first)
            .subsequent_indent(&further)
            .break_words(false)
            .word_splitter(textwrap::WordSplitter::NoHyphenation);
        textwrap::fill(bare.trim_start(), options) + &line[bare.len()..]
    };
    text.split_inclusive('\n').map(fold).collect()
}

/// As [`print()`]; `false` where the reader has gone, so that nothing more need be computed.
///
/// # Errors
/// As [`print()`].
pub fn heard(text: &str) -> Result<bool, Failure> {
    heard_bytes(text.as_bytes())
}

/// The same of bytes.
///
/// # Errors
/// As [`print()`].
pub fn heard_bytes(bytes: &[u8]) -> Result<bool, Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(bytes).and_then(|()| out.flush()) {
        Ok(()) => Ok(true),
        Err(e) if e.kind() == ErrorKind::BrokenPipe => Ok(false),
        Err(e) => Err(Failure::Failed(format!("standard output: {e}"))),
    }
}

/// Lines on standard error; control characters are shown, not sent. A reader that has gone is nobody to complain to.
pub fn note(text: &str) {
    note_painted(&shown(text));
}

/// The same of a text whose colours are ours.
pub fn note_painted(text: &str) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}

/// A question on standard error; its answer comes on the same line.
pub fn ask(text: &str) {
    let mut out = io::stderr().lock();
    let _ = write!(out, "{}", shown(text)).and_then(|()| out.flush());
}

/// A path as it is shown on a terminal.
pub fn path_text(path: &Path) -> String {
    shown(&path.display().to_string())
}

/// One JSON object as a line.
///
/// # Errors
/// Where `value` has no JSON form.
pub fn json_line(value: &impl Serialize) -> Result<String, Failure> {
    let text = serde_json::to_string(value).map_err(|e| Failure::Failed(format!("JSON: {e}")))?;
    Ok(text + "\n")
}

/// One JSON object on one line of standard output.
///
/// # Errors
/// As [`print()`]; also where `value` has no JSON form.
pub fn print_json(value: &impl Serialize) -> Result<(), Failure> {
    print(&json_line(value)?)
}

/// The object with tool and version before its keys.
pub fn signed(keys: Value) -> Value {
    let mut object = json!({ "tool": TOOL, "version": VERSION });
    if let (Value::Object(all), Value::Object(keys)) = (&mut object, keys) {
        all.extend(keys);
    }
    object
}

/// Files that may be written, checked before any computing begins.
#[derive(Debug, Clone, Default)]
pub struct Outputs {
    /// `--csv`.
    pub csv: Option<PathBuf>,
    /// `--report`.
    pub report: Option<PathBuf>,
    /// `--force`: files that this tool has not written may be replaced too.
    pub force: bool,
    /// Why files could not be written, one entry each.
    unwritten: Arc<Mutex<Vec<String>>>,
}

/// Why a file is kept that somebody may have gone on with.
const WORK: &str = "exists, and may hold work of yours; name another file, or replace it with --force";

/// Why a folder is refused where a file is to be written.
const FOLDER: &str = "is a folder; name a file in it";

impl Outputs {
    /// Those of the command line.
    pub fn new(csv: Option<PathBuf>, report: Option<PathBuf>, force: bool) -> Self {
        Self { csv, report, force, unwritten: Arc::default() }
    }

    /// Refuse what would only fail, or do harm, after the work is done: the input as an output, one file
    /// for two outputs, a folder that is not there or takes no file, a name that says another kind of file, a file that somebody else has
    /// made. `inputs`: files that the command reads, the design first; `others`: further outputs of the command.
    ///
    /// # Errors
    /// [`Failure::Malformed`] naming the path.
    pub fn check(&self, inputs: &[&Path], others: &[(&Path, FileKind)]) -> Result<(), Failure> {
        let csv = self
            .csv
            .iter()
            .filter(|path| !is_standard_output(path))
            .map(|path| (path.as_path(), FileKind::Table));
        let report = self.report.iter().map(|path| (path.as_path(), FileKind::Page));
        let mut seen: Vec<PathBuf> = Vec::new();
        for (path, kind) in csv.chain(report).chain(others.iter().copied()) {
            if path.is_dir() {
                return Err(Failure::of(path, FOLDER));
            }
            let folder = folder_of(path);
            if !folder.is_dir() {
                return Err(Failure::of(path, format!("the folder {} does not exist", folder.display())));
            }
            let here = resolved(path);
            match inputs.iter().position(|input| here == resolved(input)) {
                Some(0) => {
                    return Err(Failure::of(path, "is the design file itself; it is never overwritten"));
                }
                Some(_) => return Err(Failure::of(path, "is read by this command; it is never overwritten")),
                None => {}
            }
            // Two outputs to /dev/null or to a terminal do no harm.
            if is_special(path) {
                continue;
            }
            if seen.contains(&here) {
                return Err(Failure::of(path, "is named for two outputs"));
            }
            kind.fits(path).map_err(|why| Failure::of(path, why))?;
            // Only writing tells: rights, a disk that is read only or full.
            let folder = folder_of(&here);
            let writable = Temporary::create(&folder);
            writable.map_err(|why| {
                Failure::of(path, format!("cannot be written: {}: {why}", folder.display()))
            })?;
            seen.push(here);
        }
        others
            .iter()
            .try_for_each(|(path, kind)| self.may_replace(path, *kind).map_err(|why| Failure::of(path, why)))
    }

    /// Refuse a `--csv` or `--report` that somebody else has made. Apart, because what the command reads is known first.
    ///
    /// # Errors
    /// [`Failure::Malformed`] naming the path.
    pub fn refuse_foreign(&self) -> Result<(), Failure> {
        let own = [(&self.csv, FileKind::Table), (&self.report, FileKind::Page)];
        own.into_iter()
            .filter_map(|(path, kind)| Some((path.as_deref()?, kind)))
            .try_for_each(|(path, kind)| self.may_replace(path, kind).map_err(|why| Failure::of(path, why)))
    }

    /// Refuse a file that is there already, whoever has written it: of a command that reads no design and would put a new one
    /// in the place of an edited one.
    ///
    /// # Errors
    /// [`Failure::Malformed`] naming the path.
    pub fn refuse_work(&self, path: &Path) -> Result<(), Failure> {
        if path.is_dir() {
            return Err(Failure::of(path, FOLDER));
        }
        let empty = fs::metadata(path).map_or(true, |m| m.len() == 0);
        if self.force || is_special(path) || empty {
            return Ok(());
        }
        Err(Failure::of(path, WORK))
    }

    /// Whether what stands at `path` may be replaced by a file of this kind; why not.
    fn may_replace(&self, path: &Path, kind: FileKind) -> Result<(), String> {
        if self.force || is_standard_output(path) || is_special(path) || !path.exists() || kind.is_ours(path)
        {
            return Ok(());
        }
        if kind.is_work(path) {
            return Err(WORK.to_owned());
        }
        Err(format!(
            "exists, and it is no {} that {TOOL} has written; name another file, or replace it with --force",
            kind.noun()
        ))
    }

    /// Write a file. What fails is said at once, kept for the answer, and makes the exit code 3; the answer itself does not
    /// wait for a disk. `false`: not written.
    pub fn write(&self, path: &Path, kind: FileKind, bytes: &[u8]) -> bool {
        let written = self
            .may_replace(path, kind)
            .map_err(|why| format!("cannot write {}: {why}", path.display()))
            .and_then(|()| write_whole(path, bytes));
        written.map_err(|why| self.lost(why)).is_ok()
    }

    /// Write a file that is not there yet, with its folders.
    pub fn write_new(&self, path: &Path, bytes: &[u8]) -> bool {
        let named = |e: io::Error| format!("cannot write {}: {e}", path.display());
        let made = fs::create_dir_all(folder_of(path)).map_err(named);
        made.and_then(|()| write_whole(path, bytes)).map_err(|why| self.lost(why)).is_ok()
    }

    /// Take note of a file that could not be written.
    pub fn lost(&self, why: String) {
        note(&format!("error: {why}"));
        self.unwritten.lock().unwrap_or_else(PoisonError::into_inner).push(why);
    }

    /// Why files could not be written, one entry each.
    pub fn unwritten(&self) -> Vec<String> {
        self.unwritten.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Write a table as CSV.
    pub fn write_table(&self, path: &Path, table: &Table) {
        match table.to_csv() {
            Ok(bytes) => drop(self.write(path, FileKind::Table, &bytes)),
            Err(why) => self.lost(format!("{}: {why}", path.display())),
        }
    }

    /// Whether the table takes the place of the text on standard output.
    pub fn csv_is_answer(&self) -> bool {
        self.csv.as_deref().is_some_and(is_standard_output)
    }

    /// Write the table if `--csv` was given.
    pub fn write_csv(&self, table: &Table) {
        match &self.csv {
            Some(path) if is_standard_output(path) => {
                let csv = table.to_csv().map_err(|why| Failure::Failed(why.to_string()));
                let printed = csv.and_then(|bytes| print(&String::from_utf8_lossy(&bytes)));
                if let Err(why) = printed {
                    self.lost(why.to_json()["message"].as_str().unwrap_or_default().to_owned());
                }
            }
            Some(path) => self.write_table(path, table),
            None => {}
        }
    }

    /// Write the page if `--report` was given; it is only made then.
    pub fn write_report(&self, page: impl FnOnce() -> Page) {
        if let Some(path) = &self.report {
            self.write(path, FileKind::Page, page().to_html().as_bytes());
        }
    }
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

/// `-`: the table goes to standard output.
pub fn is_standard_output(path: &Path) -> bool {
    path == Path::new("-")
}

/// A device or pipe: written to, never replaced.
fn is_special(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|m| !m.is_file() && !m.is_dir())
}

/// Write `bytes` so that `path` holds either its old content or all of the new, whatever happens in between.
///
/// # Errors
/// What failed, naming the path; the temporary file is removed.
fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), String> {
    let named = |e: io::Error| format!("cannot write {}: {e}", path.display());
    write_by(path, named, |file| file.write_all(bytes).map_err(named))
}

/// Let `fill` write so that `path` holds either its old content or all of the new, whatever happens in
/// between: a temporary file beside it, flushed to disk, then renamed over it.
///
/// # Errors
/// What `fill` says, or what failed, as `named` puts it; the temporary file is removed.
pub fn write_by<E>(
    path: &Path,
    named: impl Fn(io::Error) -> E,
    fill: impl FnOnce(&mut File) -> Result<(), E>,
) -> Result<(), E> {
    if is_special(path) {
        return fill(&mut OpenOptions::new().write(true).open(path).map_err(named)?);
    }
    // Behind a link the linked file is replaced, not the link.
    let target = resolved(path);
    let folder = folder_of(&target);
    let (temporary, mut file) = Temporary::create(&folder).map_err(&named)?;
    fill(&mut file)?;
    if let Ok(old) = fs::metadata(&target) {
        file.set_permissions(old.permissions()).map_err(&named)?;
    }
    file.sync_all().map_err(&named)?;
    drop(file);
    fs::rename(&temporary.0, &target).map_err(&named)?;
    // The rename itself reaches the disk with the folder; where folders cannot be opened (Windows) it does so anyway.
    if let Ok(folder) = File::open(&folder) {
        let _ = folder.sync_all();
    }
    Ok(())
}

/// A file of our own making: removed when dropped; after the rename there is nothing left to remove.
struct Temporary(PathBuf);

/// Names that are tried: one that is taken belongs to somebody else, or to a run that was killed.
const MOST_NAMES: u32 = 10_000;

impl Temporary {
    /// A new file in `folder`, under a name that nobody has.
    fn create(folder: &Path) -> io::Result<(Self, File)> {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        let mut taken = io::Error::from(ErrorKind::AlreadyExists);
        for _ in 0..MOST_NAMES {
            let number = NEXT.fetch_add(1, Ordering::Relaxed);
            let path = folder.join(format!(".{TOOL}-{}-{number}.tmp", std::process::id()));
            match OpenOptions::new().write(true).create_new(true).open(&path) {
                Ok(file) => return Ok((Self(path), file)),
                Err(e) if e.kind() == ErrorKind::AlreadyExists => taken = e,
                Err(e) => return Err(e),
            }
        }
        Err(taken)
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.0);
    }
}

#[cfg(test)]
mod tests;
