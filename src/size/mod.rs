//! A first design from what a clutch shall do.
//!
//! In: [`Ask`]: bore, torque, speed, safety, friction. Out: [`Sized`], a design file that holds its own limits, or what stands
//! in the way and how near one comes. Absent: the search for a better one (`optimise`), allowables other than those in the
//! file. Equations: triangle (9) turned round for e_1; the rest is asked of `margin`.

mod ask;
mod proportions;
mod search;

pub use ask::{Ask, BadAsk};
pub use search::{NoSize, Sized, Tried, size};
