//! Deformation and mean hoop stress of the races and of the bodies pressed between them.
//!
//! In: radii, width, material, normal forces, speed. Out: radial growth, compression, hoop stress, mean and with
//! the bending between the contacts, torsion between track and rim. Absent: local contact. Equations: (5), (6), (7);
//! Michell's ring; Lame's press fit.

mod beside;
mod body;
mod harmonic;
mod influence;
mod press_fit;
mod rim;
mod ring;
#[cfg(test)]
mod shooting;
mod torsion;

pub use beside::TrackHoop;
pub use body::body_compliance_m_per_n;
pub use influence::RingInfluence;
pub use press_fit::PressFit;
pub use rim::Rim;
pub use ring::{Race, RaceError};
pub use torsion::twist_rad_per_nm;
