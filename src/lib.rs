//! sprag-design: map to come.
pub mod cli;
pub mod design;
pub mod material;
pub mod profile;
pub mod report;
