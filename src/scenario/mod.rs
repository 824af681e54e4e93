//! Questions put to the dynamics: one named scenario in, histories and a verdict out.
//!
//! In: a `Scenario` of the design. Out: [`Simulation`]. Absent: allowables (margin), files.
//! Equations: none of its own; definitions of offset, slip margin, contact margin and verdict.

mod answer;
mod bisected;
mod demand;
mod equilibrium;
mod error;
mod figures;
mod periodic;
mod prepare;
#[cfg(feature = "validation")]
mod published;
mod resonance;
mod roll_over;
mod simulate;
mod sliding;
mod train;
mod verdict;

pub use crate::dynamics::RollingTrack;
pub use answer::{GaveUp, Simulation, Verdict};
pub(crate) use demand::stand_by_left_out_s;
pub use demand::{RollingDemand, demand, demand_quickly, demand_read_again, demand_retraced, demand_tracked};
pub use equilibrium::overrun_swing;
pub use error::Scales;
pub use figures::{ErrorEstimate, FIGURES, Figure, Group, Line, Quantity, figures_of};
pub use periodic::{MotionKind, Steady, closely, steady_motion};
pub use prepare::{
    AtRest, FreeRun, NoScenario, Prepared, Reduction, prepare, prepare_reduced, sliding_friction,
};
#[cfg(feature = "validation")]
pub use published::{published_steps, simulate_published};
pub use resonance::{ResonanceCell, resonance};
pub use roll_over::{Beyond, Fate, beyond};
pub use simulate::{Settings, TOLERANCES, Terms, simulate, simulate_prepared};
pub use sliding::{Lubricated, Sliding, SqueezedOut, sliding, squeezed_out, touch};
pub use verdict::{SLIPPED_M, Went, engaging_m};
