//! A first design from what a clutch shall do.
//!
//! In: [`Wish`], filled up to [`Requirements`]: space, torques, speeds, friction, steel, purpose. Out: [`Sized`], a design file that
//! holds its own limits with the alternatives to it, or what stands in the way and how near one comes. Absent: the search for a better
//! one (`optimise`), allowables other than those in the file. Equations: triangle (9) turned round for e_1; the rest is asked of
//! `margin`.

mod asked;
mod decider;
mod finish;
mod proportions;
mod purpose;
mod requirements;
mod search;

pub use asked::{ASKED, Unnamed, WishNumber, WishUnit, asked};
pub use decider::Decider;
pub use finish::{Drag, Made, NOT_OPTIMISED, WARMER_K};
pub use purpose::{Excitation, Given, PURPOSES, Purpose, purpose};
pub use requirements::{
    BadRequirement, FRICTION, PEAK_OVER_NOMINAL, Requirements, TorqueSwing, Wish, torques_nm,
};
pub use search::{NoSize, Sized, Tried, WouldDo, size};
