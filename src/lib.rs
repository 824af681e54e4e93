//! sprag-design: map to come.
pub mod cli;
pub mod contact;
pub mod design;
pub mod dynamics;
pub mod friction;
pub mod kinematics;
pub mod margin;
pub mod material;
pub mod numeric;
pub mod ode;
pub mod optimise;
pub mod profile;
pub mod race;
pub mod report;
pub mod scenario;
pub mod wedge;
