//! Opening files: regular ones, up to a size, and histories only from the folder of their design.
//!
//! In: paths. Out: text, or what was found instead and what helps. Absent: what the text means. Equations: none.

use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::{Component, Path, PathBuf};

/// Largest design file, bytes: a hundred times the largest that a clutch needs.
pub(super) const MOST_DESIGN: u64 = 1 << 20;
/// Largest history or table of measurements, bytes.
pub const MOST_TABLE: u64 = 32 << 20;
/// Largest result of another program, bytes.
pub const MOST_RESULT: u64 = 2 << 30;

/// Why a file gives no text.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("found {found}; to mend: {help}")]
pub struct Unread {
    /// What was found instead.
    pub found: String,
    /// How to mend it.
    pub help: &'static str,
    /// The text up to the first byte that is no UTF-8 and what follows, as far as it can be shown; empty where nothing was read.
    pub text: String,
    /// Where that byte stands, from 0.
    pub at: usize,
}

/// The text of a regular file of at most `most` bytes: a pipe or device may have no end, and is not opened.
///
/// # Errors
/// [`Unread`].
pub fn read_text(path: &Path, most: u64) -> Result<String, Unread> {
    let unread = |found: String, help| Unread { found, help, text: String::new(), at: 0 };
    let odd = |error: std::io::Error| match error.kind() {
        ErrorKind::NotFound => unread("no such file".to_owned(), "check the path"),
        ErrorKind::PermissionDenied => unread("a file that may not be read".to_owned(), "allow reading it"),
        _ => unread(format!("an error while reading: {error}"), "check the path and the disk"),
    };
    let about = path.metadata().map_err(odd)?;
    if about.is_dir() {
        return Err(unread("a directory".to_owned(), "name a file in it"));
    }
    if !about.is_file() {
        let help = "write what comes from it into a file first, and name that file";
        return Err(unread("a pipe or a device, which may have no end".to_owned(), help));
    }
    let mut bytes = Vec::new();
    File::open(path).and_then(|file| file.take(most + 1).read_to_end(&mut bytes)).map_err(odd)?;
    if bytes.len() as u64 > most {
        return Err(unread(format!("a file of more than {} MB", most >> 20), "name a smaller file"));
    }
    if [[0xff, 0xfe], [0xfe, 0xff]].iter().any(|mark| bytes.starts_with(mark)) {
        let help = "save the file as UTF-8 (\"UTF-8\" in the editor's dialog for saving, not \"Unicode\")";
        return Err(unread("a text in UTF-16".to_owned(), help));
    }
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        Unread {
            found: format!("a byte that is not UTF-8 (byte {} of the file)", at + 1),
            help: "save the file as UTF-8; umlauts of an older encoding in a comment are the usual cause",
            text: String::from_utf8_lossy(error.as_bytes()).into_owned(),
            at,
        }
    })
}

/// The path of the history `name` of a design in `folder`: a design that came from elsewhere reads nothing but what came
/// with it, through a link neither.
///
/// # Errors
/// What was found instead.
pub(super) fn history_path(folder: &Path, name: &str) -> Result<PathBuf, String> {
    let inside = |c: Component| matches!(c, Component::Normal(_) | Component::CurDir);
    if !Path::new(name).components().all(inside) {
        return Err("a path that leaves the folder of the design file".to_owned());
    }
    let path = folder.join(name);
    let home = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    match (path.canonicalize(), home.canonicalize()) {
        (Ok(there), Ok(home)) if !there.starts_with(&home) => {
            Err("a link that leaves the folder of the design file".to_owned())
        }
        _ => Ok(path),
    }
}
