//! Questions put to the dynamics: one named scenario in, histories and a verdict out.
//!
//! In: a `Scenario` of the design. Out: [`Simulation`]. Absent: allowables (margin), files.
//! Equations: none of its own; definitions of offset, slip margin, contact margin and verdict.

mod prepare;
mod simulate;

pub use prepare::{NoScenario, Prepared, place_profile, prepare};
pub use simulate::{
    Demand, ErrorEstimate, Settings, Simulation, Verdict, demand, published_steps, simulate,
    simulate_published,
};
