//! What becomes of a clutch in service: film, heat, wear, life, slips and blows, strokes.

#[path = "../common/program.rs"]
mod program;

mod carried;
mod driven_cage;
mod feed;
mod life;
mod lubrication;
mod reengage;
mod worn;
mod worn_outside;
