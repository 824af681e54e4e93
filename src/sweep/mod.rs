//! The box of a design's variables looked at as a whole: its points by their number, margins at each.
//!
//! In: a `Design` with its `[optimize]` table. Out: [`BoxSample`], points that are the same whoever computes them; [`Sweep`], margins
//! at a point. Absent: files, text; which points are worth looking at.
//! Equations: none.

mod parts;
mod row;
mod sampling;

pub use parts::SweepPart;
pub use row::{Decides, NextPoint, NoSweep, Sweep, SweepEnd, SweepRow, SweepSettings};
pub use sampling::{BoxSample, NoSample, Sampling};
