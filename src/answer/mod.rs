//! Answers as a library user gets them and as programs read them: what is computed, with errors, notes and what was left out.
//!
//! In: a `Design` and a question. Out: serde types ([`check::CheckAnswer`], [`stiffness::StiffnessAnswer`],
//! [`simulation::SimulationAnswer`], [`search::SearchAnswer`]) whose JSON is that of the command.
//! Absent: arguments, files, printing, pages.
//! Equations: none; definitions of what a scene leaves out and of the effect of contact damping.

pub mod check;
pub mod left_out;
pub mod search;
pub mod simulation;
pub mod stiffness;

pub use left_out::LeftOut;
