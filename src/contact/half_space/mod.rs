//! The contact of two half-spaces on a grid over the patch: the reference for the slice method.
//!
//! In: a gap over the patch or an [`super::AxialFit`], contact modulus, force. Out: pressure cell by cell, line
//! load, approach, status. Absent: friction, bodies of finite thickness; free ends only by a mirror factor.
//! Equations: Love's rectangle, Polonsky and Keer's conjugate gradients, Guilbault's free-end factor.

mod conjugate;
mod finite_line;
mod influence;

pub use conjugate::{ConjugateSettings, HalfSpaceStatus};
pub use finite_line::{HalfSpaceLine, HalfSpaceLineSolution, free_end_factor};
pub use influence::{HalfSpaceGrid, PatchSolution};
