//! Designs in other programs' formats, and those programs' answers read back.
//!
//! In: a checked clutch, its profile and outline. Out: strings (drawings DXF and SVG, solids STEP, tables of arcs and
//! points; a finite-element deck; rows from its result; what a unit for co-simulation offers).
//! Absent: paths and running the other program (cli), drawings for people (report).
//! Equations: none of the paper's; statics of a sector, read off the nodes, in `calculix::read`.

pub mod calculix;
pub mod dxf;
pub mod fmu;
mod made;
mod part;
pub mod rows;
mod sheet;
pub mod step;
pub mod svg;

pub use made::{MadeClutch, NoPart};
pub use part::{DrawnClutch, Part};
