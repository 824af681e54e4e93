//! The design file: read, checked, changed.
//!
//! In: a design file (TOML, mm, rad, GPa, rev/min). Out: [`Design`](crate::design::Design), SI, by [`Design::read`](crate::design::Design::read),
//! or [`DesignError`] with every key at fault; texts with values changed. Absent: any physics; what a design is (`design`). Equations: none.

mod axial;
mod cage_file;
mod check;
mod contact_file;
mod design_file;
mod diagnostic;
mod document;
mod draft;
mod drivetrain;
mod drivetrain_file;
mod eccentricity;
mod edit;
mod findings;
mod form;
mod geometry;
mod get;
mod guessed;
mod history;
mod inputs;
mod life_file;
mod lubrication_file;
mod notes;
mod open;
mod outline;
mod random_torque;
mod read;
mod running;
mod scenario_file;
mod scenarios;
mod set;
mod shape;
mod sharing_file;
mod steels;
mod task;
mod task_file;
mod tolerances_file;
mod variables;

pub use diagnostic::{DesignError, Problem, TextPlace, shown, unprintable};
pub use edit::{
    EditError, content, other_variables, value_at, with_flanks, with_keys, with_limits, with_spiral,
    with_sprag, with_values,
};
pub use form::DesignForm;
pub use get::{NoSetting, setting_at};
pub use guessed::as_guesses;
pub use history::is_history;
pub use inputs::{Input, inputs, unit_of_path};
pub use notes::with_notes;
pub use open::{MOST_RESULT, MOST_TABLE, Unread, read_text};
pub use read::foreign;
pub use scenarios::{KindKeys, SCENARIO_KINDS};
pub use set::with_setting;
pub use shape::{allowed, keys_of, paths_of, schema, shape_of};
pub use steels::{a_steel, beside_the_name, names_of_bodies, nearest_steel};
pub use variables::{VARIABLES, is_whole, unit_of_key, variable_names, variable_path, variable_unit};
