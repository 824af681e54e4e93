//! Scenes and the equations of motion: figures against scripts, balances, limits, the work that they take.

#[path = "../common/program.rs"]
mod program;

mod accumulation;
mod demand;
mod drivetrain;
mod dynamics;
mod element;
mod element_moved;
mod energy;
mod extremes;
mod fidelity;
mod histories;
mod impact;
mod long_scenes;
mod nine_statements;
mod outside;
mod overrun_stability;
mod periodic;
mod quick;
mod ramp;
mod scenes;
mod slip_heat;
mod stability;
mod stand_by;
mod start;
mod stated_errors;
