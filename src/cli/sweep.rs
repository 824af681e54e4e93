//! What `sample` and `evaluate` share: which points, which part of them, and a file that is there whole or not at all.

use super::exit::Failure;
use super::output::{self, Outputs, is_standard_output, path_text};
use crate::answer::sweep::SweepHead;
use crate::sweep::{Sampling, SweepPart};
use clap::Args;
use std::fs::File;
use std::io::{BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::ops::Range;
use std::path::Path;

/// Which points of the box.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Points")]
pub struct PointArgs {
    /// N scrambled Sobol points over all variables of the table `optimize`
    #[arg(long, value_name = "N", value_parser = counted)]
    pub sobol: Option<u64>,
    /// Seed of the scrambling [default: 1]
    #[arg(long, value_name = "S", requires = "sobol")]
    pub seed: Option<u64>,
    /// Every combination of N values of each variable named, bounds included; the others stay as in the file
    #[arg(long, value_name = "NAME=N,...", value_delimiter = ',', value_parser = step, conflicts_with = "sobol")]
    pub grid: Vec<(String, u64)>,
    /// Part K of M alone
    #[arg(long, value_name = "K/M")]
    pub part: Option<SweepPart>,
    /// From this point on, counted from 0
    #[arg(long, value_name = "I", value_parser = counted, conflicts_with = "part")]
    pub first: Option<u64>,
    /// So many points alone
    #[arg(long, value_name = "N", value_parser = counted, conflicts_with = "part")]
    pub count: Option<u64>,
}

impl PointArgs {
    /// What is to be drawn; none where nothing is.
    pub fn sampling(&self) -> Option<Sampling> {
        let sobol = self.sobol.map(|count| Sampling::Sobol { count, seed: self.seed.unwrap_or(1) });
        sobol.or_else(|| (!self.grid.is_empty()).then(|| Sampling::Grid(self.grid.clone())))
    }

    /// Whether a part alone is asked for.
    pub fn is_part(&self) -> bool {
        self.part.is_some() || self.first.is_some() || self.count.is_some()
    }

    /// The part that is asked for, of `all` points.
    ///
    /// # Errors
    /// [`Failure::Malformed`] where it begins behind the end.
    pub fn range(&self, all: u64) -> Result<Range<u64>, Failure> {
        if let Some(part) = self.part {
            return Ok(part.range(all));
        }
        let first = self.first.unwrap_or(0);
        if first >= all && all > 0 {
            return Err(Failure::malformed(format!(
                "--first {first}: there are {all} points, 0 to {}",
                all - 1
            )));
        }
        Ok(first..first.saturating_add(self.count.unwrap_or(u64::MAX)).min(all))
    }
}

/// A count of points: 1000000 or 1e6.
fn counted(text: &str) -> Result<u64, String> {
    let wide = |value: &f64| (0.0..=9e15).contains(value) && value.fract() == 0.0;
    let read = text.parse().ok().or_else(|| text.parse().ok().filter(wide).map(|value| value as u64));
    read.ok_or_else(|| "a whole number is needed, such as 1000000 or 1e6".to_owned())
}

/// A variable and its number of values.
fn step(text: &str) -> Result<(String, u64), String> {
    let read =
        text.split_once('=').and_then(|(name, n)| Some((name.trim().to_owned(), n.trim().parse().ok()?)));
    read.ok_or_else(|| "NAME=N is needed, such as r_i2_mm=40".to_owned())
}

/// Where lines go: into a file that is there whole or not at all, or to standard output.
pub struct Sink<'a> {
    outputs: &'a Outputs,
}

/// What became of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sunk {
    /// Written.
    Written,
    /// It was there, whole.
    Standing,
    /// The reader of standard output has gone.
    Unheard,
}

/// Takes bytes; `false` where nobody wants more.
pub type Emit<'e> = dyn FnMut(&[u8]) -> Result<bool, Failure> + 'e;

impl<'a> Sink<'a> {
    /// The `--csv` of the command, or standard output.
    pub fn of(outputs: &'a Outputs) -> Self {
        Self { outputs }
    }

    fn file(&self) -> Option<&'a Path> {
        self.outputs.csv.as_deref().filter(|path| !is_standard_output(path))
    }

    /// Where it is, in words.
    pub fn place(&self) -> String {
        self.file().map_or("standard output".to_owned(), path_text)
    }

    /// Fill it, unless the file is there already with the first lines `begin` and `last` as the number of its last point. A file
    /// that begins so and ends elsewhere was cut: it is made anew.
    ///
    /// # Errors
    /// [`Failure::Malformed`] where the file holds another sweep; what `fill` says; [`Failure::Failed`] of a disk.
    pub fn fill(
        &self,
        begin: &[u8],
        last: impl FnOnce() -> Result<Option<u64>, Failure>,
        fill: impl FnOnce(&mut Emit) -> Result<bool, Failure>,
    ) -> Result<Sunk, Failure> {
        let Some(path) = self.file() else {
            let heard = fill(&mut |bytes| output::heard_bytes(bytes))?;
            return Ok(if heard { Sunk::Written } else { Sunk::Unheard });
        };
        if !self.outputs.force && path.is_file() && standing(path, begin, last)? {
            return Ok(Sunk::Standing);
        }
        let failed = |e: std::io::Error| Failure::Failed(format!("cannot write {}: {e}", path_text(path)));
        output::write_by(path, failed, |file| {
            fill(&mut |bytes| file.write_all(bytes).map(|()| true).map_err(failed)).map(drop)
        })?;
        Ok(Sunk::Written)
    }
}

/// A file that is read more than once, which a pipe cannot be; `what` is in it.
///
/// # Errors
/// [`Failure::Malformed`].
pub fn opened_again(path: &Path, what: &str) -> Result<File, Failure> {
    if path.exists() && !path.is_file() {
        return Err(Failure::of(path, format!("is no file: {what} are read twice")));
    }
    File::open(path).map_err(|e| Failure::of(path, format!("cannot be read: {e}")))
}

/// More than a line is long.
const TAIL: u64 = 1 << 16;

/// Whether the file is what is wanted, whole; `false`: it was cut, or is empty.
fn standing(
    path: &Path,
    begin: &[u8],
    last: impl FnOnce() -> Result<Option<u64>, Failure>,
) -> Result<bool, Failure> {
    let failed = |e: std::io::Error| Failure::Failed(format!("cannot read {}: {e}", path_text(path)));
    let mut file = File::open(path).map_err(failed)?;
    let mut found = vec![0; begin.len()];
    let length = file.metadata().map_err(failed)?.len();
    let same = file.read_exact(&mut found).is_ok() && found == begin;
    if !same {
        file.rewind().map_err(failed)?;
        let mut head = Vec::new();
        file.take(begin.len() as u64 + 1).read_to_end(&mut head).map_err(failed)?;
        // Cut within its first lines.
        if begin.starts_with(&head) {
            return Ok(false);
        }
        return Err(Failure::malformed(format!(
            "{}: holds another sweep ({}); name another file, or replace it with --force",
            path_text(path),
            difference(path, begin)
        )));
    }
    file.seek(SeekFrom::Start(length.saturating_sub(TAIL).max(begin.len() as u64 - 1))).map_err(failed)?;
    let mut tail = Vec::new();
    file.read_to_end(&mut tail).map_err(failed)?;
    let ended = tail.strip_suffix(b"\n");
    let line = ended.and_then(|tail| tail.rsplit(|byte| *byte == b'\n').next());
    let number = line.and_then(|line| line.split(|byte| *byte == b',').next());
    let number: Option<u64> = number.and_then(|number| std::str::from_utf8(number).ok()?.parse().ok());
    Ok(ended.is_some() && number == last()?)
}

/// In what the file's first line differs from the first line wanted.
fn difference(path: &Path, begin: &[u8]) -> String {
    let first = |reader: &mut dyn BufRead| -> Option<SweepHead> {
        let mut line = Vec::new();
        reader.take(TAIL).read_until(b'\n', &mut line).ok()?;
        String::from_utf8_lossy(&line).parse().ok()
    };
    let found = File::open(path).ok().and_then(|file| first(&mut BufReader::new(file)));
    match (found, first(&mut &begin[..])) {
        (Some(found), Some(wanted)) => found.differs(&wanted).unwrap_or_else(|| "other columns".to_owned()),
        _ => "its first line is that of no sweep".to_owned(),
    }
}
