//! Histories of a design that is written into another folder: copied beside it, because a design reads nothing from
//! elsewhere.

use super::exit::Failure;
use super::output::{Outputs, folder_of};
use crate::design::Design;
use crate::file::{MOST_TABLE, read_text};
use std::path::{Path, PathBuf};

/// Files to be written beside a new design.
#[derive(Debug, Default)]
pub struct Histories(Vec<(PathBuf, String)>);

impl Histories {
    /// Those that `design` needs at `new` and that are not there yet.
    ///
    /// # Errors
    /// [`Failure::Malformed`] where another file lies in the place of one, or one can no longer be read.
    pub fn beside(design: &Design, new: &Path) -> Result<Self, Failure> {
        let mut out = Self::default();
        for from in &design.histories {
            let to = folder_of(new).join(from.strip_prefix(&design.folder).unwrap_or(from));
            let unread = |why| Failure::of(from, why);
            let text = read_text(from, MOST_TABLE).map_err(unread)?;
            if !to.exists() {
                out.0.push((to, text));
            } else if read_text(&to, MOST_TABLE).as_ref() != Ok(&text) {
                return Err(Failure::malformed(format!(
                    "{}: another file than the design's {}, which is to be copied there: a design and its histories lie in \
                     one folder; write the new design into another folder with -o",
                    to.display(),
                    from.display()
                )));
            }
        }
        Ok(out)
    }

    /// Write them; `false` where one could not be written.
    pub fn write(&self, outputs: &Outputs) -> bool {
        self.0.iter().all(|(to, text)| outputs.write_new(to, text.as_bytes()))
    }
}
