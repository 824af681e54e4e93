//! sprag-design: map to come.
pub mod design;
pub mod material;
pub mod optimise;
pub mod profile;
