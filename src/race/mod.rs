//! Deformation and mean hoop stress of the races and of the bodies pressed between them.
//!
//! In: radii, width, material, normal forces, speed. Out: radial growth, compression, hoop stress.
//! Absent: bending between the contacts (only the mean pressure acts, so the hoop stress between twelve
//! contacts is 20-30 % higher in places), local contact. Equations: (5), (6), (7).

mod body;
mod ring;
#[cfg(test)]
mod shooting;

pub use body::body_compliance_m_per_n;
pub use ring::{Race, RaceError};
