//! Answers as a library user gets them and as programs read them: what is computed, with errors, notes and what was left out.
//!
//! In: a `Design` and a question. Out: serde types ([`check::CheckAnswer`], [`stiffness::StiffnessAnswer`],
//! [`simulation::SimulationAnswer`], [`search::SearchAnswer`] ...) whose JSON, tables, words and page are those of the command.
//! Absent: arguments, files, printing.
//! Equations: none; definitions of what a scene leaves out and of the effect of contact damping.

#[cfg(feature = "validation")]
pub mod accuracy;
mod alike;
pub mod check;
pub mod co_simulation;
pub mod comparison;
mod drawn;
mod envelope;
pub mod explanation;
pub mod exported;
pub mod feed;
pub mod finite_elements;
pub mod identification;
pub mod imported;
mod inertia;
pub mod left_out;
pub mod life;
pub mod oils;
pub mod overrun;
pub mod page;
pub mod reengagement;
pub mod resonance;
pub mod roll_over;
pub mod search;
pub mod sharing;
pub mod sharing_scene;
pub mod simulation;
pub mod sizing;
pub mod steels;
pub mod stiffness;
pub mod sweep;
mod under_load;

use envelope::Said;
pub use envelope::{Answer, ByAlphabet, Envelope, Finding, Provenance, TOOL, VERSION, WRITTEN_BY};
pub use left_out::LeftOut;

/// Torque of a table or scene that is suggested for a clutch, N m.
pub(crate) fn example_torque_nm(design: &crate::design::Design) -> f64 {
    design.limits.usual_torque_nm().unwrap_or(100.0)
}
