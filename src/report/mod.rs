//! Answers as people read them: units, tables, plots, drawings, one self-contained page.
//!
//! In: SI numbers, curves and outlines. Out: strings (text, HTML, SVG) and bytes (CSV).
//! Absent: physics, allowables, paths, printing; what a number means was decided before it came here.
//! Equations: none; the rotation of the body frame in [`drawing`] and the changes of unit in [`number`].

pub mod bars;
pub mod drawing;
pub mod heat;
pub mod number;
pub mod page;
pub mod parallel;
pub mod plot;
pub mod strip;
mod svg;
pub mod table;

pub use bars::{Bar, Bars, Tone};
pub use drawing::{Drawing, DrawnArc, Live, SpragPose, live};
pub use heat::{HeatMap, Shade};
pub use number::{Unit, error_beside, plain, significant};
pub use page::{Page, PageHead, greek};
pub use parallel::Parallel;
pub use plot::{Curve, Dash, Marker, Plot};
pub use strip::{Span, Strip};
pub use table::{Cell, Column, Rows, Screen, Table};
#[cfg(test)]
mod tests;
