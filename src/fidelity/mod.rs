//! What a scene can leave out: terms that it cannot feel are dropped before the run, each with its cost.
//!
//! In: a `Scenario`, settings, [`Terms`]. Out: [`Planned`]: the simulation and what it left out
//! or kept. Absent: how scenes run (scenario), printing. Equations: none; costs are bounds in theta_bi, rad.

mod plan;
mod run;

pub use crate::scenario::Terms;
pub use crate::wedge::Effort;
pub use plan::{Plan, Term, curves_asked, plan, plan_at};
pub use run::{Planned, simulate};
