//! sprag-design: map to come.
pub mod design;
pub mod material;
pub mod numeric;
pub mod ode;
pub mod profile;
