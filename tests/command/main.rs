//! The program from outside.

#[path = "../common/program.rs"]
mod program;

mod accuracy;
mod at_speed;
mod cad;
mod check;
mod command_line;
mod compare;
mod export;
mod identify;
mod interrupt;
mod journal;
mod optimize;
mod optimize_made;
mod scenes;
mod sharing_scene;
mod simulate;
mod stiffness;
mod sweep;
