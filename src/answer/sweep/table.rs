//! Records of a file of a sweep: its first line understood, names and rows apart, lines of joined parts skipped.

use super::head::SweepHead;
use csv::StringRecord;
use std::io::{BufReader, Read};

/// What is wrong with a file of a sweep.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}{what}", if *.line > 0 { format!("line {line}: ") } else { String::new() })]
pub struct NoTable {
    /// Line; 0 where it is the whole file.
    pub line: u64,
    /// What is wrong, in words.
    pub what: String,
}

impl NoTable {
    pub(super) fn whole(what: impl Into<String>) -> Self {
        Self { line: 0, what: what.into() }
    }
}

/// A file under reading.
pub(super) struct Records<R: Read> {
    reader: csv::Reader<BufReader<R>>,
    pub head: Option<SweepHead>,
    pub names: Vec<String>,
    record: StringRecord,
}

impl<R: Read> Records<R> {
    /// With head and names read.
    pub fn open(from: R) -> Result<Self, NoTable> {
        let reader =
            csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(BufReader::new(from));
        let mut file = Self { reader, head: None, names: Vec::new(), record: StringRecord::new() };
        loop {
            if !file.next_record()? {
                return Err(NoTable::whole("no line with the names of columns"));
            }
            if !file.is_remark()? {
                file.names = file.record.iter().map(|name| name.trim().to_owned()).collect();
                if let Some(name) = file.names.first_mut() {
                    *name = name.trim_start_matches('\u{feff}').to_owned();
                }
                return Ok(file);
            }
        }
    }

    fn next_record(&mut self) -> Result<bool, NoTable> {
        let line = self.reader.position().line();
        self.reader.read_record(&mut self.record).map_err(|e| NoTable { line, what: e.to_string() })
    }

    /// Line of the present record.
    pub fn line(&self) -> u64 {
        self.record.position().map_or(0, csv::Position::line)
    }

    /// Whether the record is a remark; a head is taken or compared.
    fn is_remark(&mut self) -> Result<bool, NoTable> {
        if !self.record.get(0).is_some_and(|first| first.starts_with('#')) {
            return Ok(false);
        }
        // A name may hold commas.
        let text = self.record.iter().collect::<Vec<_>>().join(",");
        if SweepHead::begins(&text) {
            let fault = |what: String| NoTable { line: self.line(), what };
            let head: SweepHead = text
                .parse()
                .map_err(|()| fault("the first line of a sweep, but cut or changed".to_owned()))?;
            match &self.head {
                None if self.names.is_empty() => self.head = Some(head),
                None => return Err(fault("rows of a sweep behind rows of something else".to_owned())),
                Some(first) => {
                    if let Some(why) = head.differs(first) {
                        return Err(fault(format!("parts of two sweeps in one file: {why}")));
                    }
                }
            }
        }
        Ok(true)
    }

    /// The next row, as wide as the names, its cells as they stand there; `None` at the end.
    pub fn next_row(&mut self) -> Result<Option<&StringRecord>, NoTable> {
        loop {
            if !self.next_record()? {
                return Ok(None);
            }
            let again = self.record.iter().map(str::trim).eq(self.names.iter().map(String::as_str));
            if self.is_remark()? || again {
                continue;
            }
            if self.record.len() != self.names.len() {
                let (found, wanted) = (self.record.len(), self.names.len());
                let what = format!("{found} values for {wanted} columns");
                return Err(NoTable { line: self.line(), what });
            }
            return Ok(Some(&self.record));
        }
    }
}
