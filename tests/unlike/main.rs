//! Sprags one by one, and races off centre or bent.

#[path = "../common/scenes.rs"]
mod scenes;

mod bending;
mod by_chance;
mod cost;
mod driven_cage;
mod each_sprag;
mod junctions;
mod off_centre;
mod sharing;
mod turning_track;
mod verdict;
