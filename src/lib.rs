//! sprag-design: map to come.
pub mod contact;
pub mod design;
pub mod friction;
pub mod material;
pub mod numeric;
pub mod profile;
pub mod race;
