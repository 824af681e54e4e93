//! Sweeps as text: vectors out and in, a line of margins for each, and what a table of them shows.
//!
//! Every file of a sweep begins with the same two lines whatever part of it it holds, so that parts joined without the first two
//! lines of all but the first are the whole, byte for byte.

mod head;
mod lines;
mod map;
mod map_page;
mod table;
mod vectors;

pub use head::{Holds, SweepHead};
pub use lines::{ColumnsUnknown, SweepLines};
pub use map::{Cells, MapPair, MapPoint, MapVariable, SweepMap};
pub use map_page::{MapBody, MapRange};
pub use table::NoTable;
pub use vectors::Vectors;

use crate::design::Design;
use crate::sweep::{BoxSample, NoSample, NoSweep, Sampling, Sweep, SweepSettings};

impl Design {
    /// The points of the `[optimize]` table's box that `sampling` means: [`BoxSample::point`] has them one by one.
    ///
    /// # Errors
    /// [`NoSample`].
    ///
    /// ```
    /// use sprag_design::{Design, sweep::{Sampling, SweepSettings}};
    ///
    /// let design = Design::read("designs/huang2017-multi-arc.toml".as_ref())?;
    /// let sample = design.sample(&Sampling::Sobol { count: 1000, seed: 1 })?;
    /// let sweep = design.sweep(&SweepSettings { at_rest: true, ..SweepSettings::default() })?;
    /// let held = (0..20).filter(|&i| sweep.row(sample.point(i)).feasible()).count();
    /// assert!(held < 20);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn sample(&self, sampling: &Sampling) -> Result<BoxSample, NoSample> {
        BoxSample::of(self.optimize.as_ref().ok_or(NoSample::NoTask)?, sampling)
    }

    /// Margins at points of the box.
    ///
    /// # Errors
    /// [`NoSweep`].
    pub fn sweep(&self, settings: &SweepSettings) -> Result<Sweep, NoSweep> {
        Sweep::of(self, settings)
    }
}
