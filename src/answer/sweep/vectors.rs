//! Files of vectors: written from a sampling, read from anybody's CSV.

use super::head::{Holds, SweepHead};
use super::lines::{FIXED, begin_vectors, vector_line};
use super::table::{NoTable, Records};
use crate::design::{Design, OptimizeVariable, did_you_mean};
use crate::sweep::{BoxSample, Sampling};
use sha2::{Digest, Sha256};
use std::io::Read;
use std::ops::Range;

impl BoxSample {
    /// The points of `range` as CSV, chunk by chunk: two lines first, then one for each point.
    pub fn csv<'s>(&'s self, design: &'s Design, range: Range<u64>) -> impl Iterator<Item = Vec<u8>> + 's {
        let head = SweepHead::vectors(design, &self.sampling().to_string());
        let first = design.optimize.iter().map(move |task| begin_vectors(&head, task));
        first.chain(range.map(|i| vector_line(i, &self.point(i))))
    }
}

/// Vectors of one design, read one by one: points with their numbers.
pub struct Vectors<R: Read> {
    records: Records<R>,
    variables: Vec<OptimizeVariable>,
    /// Column of each variable.
    columns: Vec<usize>,
    index: Option<usize>,
    /// The points that the head promises.
    promised: Option<BoxSample>,
    next: u64,
    digest: Sha256,
}

impl<R: Read> Vectors<R> {
    /// From a CSV file: a column for each variable of `design`'s `[optimize]` table, in any order, one named `index` where
    /// points have numbers of their own (else their place in the file, from 0), and maybe the first line that `sample` writes.
    ///
    /// # Errors
    /// [`NoTable`]: vectors of another design, columns that are missing or unknown.
    pub fn open(design: &Design, from: R) -> Result<Self, NoTable> {
        let records = Records::open(from)?;
        let whole = |what: String| NoTable { line: 0, what };
        let task = design.optimize.as_ref();
        let variables = task.map(|task| task.variables.clone()).unwrap_or_default();
        let mut promised = None;
        if let Some(head) = &records.head {
            if !matches!(head.holds, Holds::Vectors) {
                return Err(whole("a table of margins, not of vectors".to_owned()));
            }
            if head.design_hash != design.hash {
                return Err(whole(format!(
                    "vectors of another design, {} ({}); this one is {} ({}). Draw new ones with `sample`",
                    head.design, head.design_hash, design.name, design.hash
                )));
            }
            let sampling: Sampling = head
                .points
                .parse()
                .map_err(|()| whole(format!("points {}: no sampling that `sample` knows", head.points)))?;
            promised = Some(design.sample(&sampling).map_err(|why| whole(why.to_string()))?);
        }
        let names: Vec<&str> = variables.iter().map(|v| v.name.as_str()).collect();
        let mut index = None;
        let mut columns = vec![None; variables.len()];
        for (at, name) in records.names.iter().enumerate() {
            let place = match names.iter().position(|n| n == name) {
                Some(i) => &mut columns[i],
                None if name == FIXED[0] => &mut index,
                None => {
                    let meant = did_you_mean(name, &names);
                    return Err(whole(format!(
                        "column {name} is no variable of [optimize]{meant} Columns: {}, and index if wanted",
                        names.join(", ")
                    )));
                }
            };
            if place.replace(at).is_some() {
                return Err(whole(format!("column {name} stands there twice")));
            }
        }
        if let Some(i) = columns.iter().position(Option::is_none) {
            return Err(whole(format!("no column {}; needed: {}", names[i], names.join(", "))));
        }
        let columns = columns.into_iter().flatten().collect();
        Ok(Self { records, variables, columns, index, promised, next: 0, digest: Sha256::new() })
    }

    /// The next point with its number; `None` at the end.
    ///
    /// # Errors
    /// [`NoTable`]: what is no number, or not the point that the head promises.
    pub fn next_point(&mut self) -> Result<Option<(u64, Vec<f64>)>, NoTable> {
        let Some(row) = self.records.next_row()? else { return Ok(None) };
        let read = |v: &OptimizeVariable, at: usize| {
            let cell = row.get(at).unwrap_or_default().trim();
            match cell.parse::<f64>() {
                Ok(value) if value.is_finite() => Ok(value),
                _ => Err(format!("{} = {cell:?}: a finite number is needed", v.name)),
            }
        };
        let number = |at: usize| {
            let cell = row.get(at).unwrap_or_default().trim();
            cell.parse::<u64>().map_err(|_| format!("index = {cell:?}: a whole number is needed"))
        };
        let x: Result<Vec<f64>, String> =
            self.variables.iter().zip(&self.columns).map(|(v, &at)| read(v, at)).collect();
        let index = self.index.map_or(Ok(self.next), number);
        let line = self.records.line();
        let (x, index) = x.and_then(|x| Ok((x, index?))).map_err(|what| NoTable { line, what })?;
        if let Some(sample) = &self.promised
            && (index >= sample.count() || sample.point(index) != x)
        {
            return Err(NoTable {
                line,
                what: format!(
                    "not point {index} of {}, as the first line says; remove that line if points were changed on purpose",
                    sample.sampling()
                ),
            });
        }
        self.next += 1;
        self.digest.update(index.to_le_bytes());
        x.iter().for_each(|v| self.digest.update(v.to_le_bytes()));
        Ok(Some((index, x)))
    }

    /// Points read so far.
    pub fn count(&self) -> u64 {
        self.next
    }

    /// Which points these are: the head's words, or the file by a digest of what was read so far.
    pub fn points(&self) -> String {
        match &self.promised {
            Some(sample) => sample.sampling().to_string(),
            None => {
                let digest = self.digest.clone().finalize();
                let hex: String = digest.iter().take(8).map(|byte| format!("{byte:02x}")).collect();
                format!("file {hex}")
            }
        }
    }
}
