//! The design file: read, checked, changed; the checked, immutable design that comes of it.
//!
//! In: a design file (TOML, mm, rad, GPa, rev/min). Out: [`Design`], SI, or [`DesignError`] with every key at fault; texts
//! with values changed. Absent: any physics; what a clutch is (`clutch`). Equations: none.

mod axial;
mod check;
mod contact_file;
mod diagnostic;
mod document;
mod draft;
mod drivetrain;
mod drivetrain_file;
mod eccentricity;
mod edit;
mod file;
mod findings;
mod form;
mod geometry;
mod history;
mod inputs;
mod life_file;
mod limits;
mod lubrication_file;
mod notes;
mod objective;
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
mod which;

pub use check::{rad_s, rpm};
pub use diagnostic::{DesignError, Problem, TextPlace, shown, unprintable};
pub use draft::{BOX, Draft, DraftScene, KINETIC_SHARE};
pub use edit::{
    EditError, content, other_variables, value_at, with_flanks, with_keys, with_limits, with_spiral,
    with_sprag, with_values,
};
pub use form::DesignForm;
pub use history::is_history;
pub use inputs::{Input, inputs, unit_of_path};
pub use limits::{LIMIT_KEYS, LimitKey, Limits};
pub use notes::with_notes;
pub use objective::{Link, Objective, Optimize, OptimizeVariable, multiple};
pub use open::{MOST_RESULT, MOST_TABLE, Unread, read_text};
pub use read::foreign;
pub use scenarios::{KindKeys, SCENARIO_KINDS};
pub use set::with_setting;
pub use shape::{allowed, keys_of, nearest, paths_of, schema, shape_of};
pub use steels::{beside_the_name, names_of_bodies, nearest_steel};
pub use variables::{VARIABLES, is_whole, unit_of_key, variable_names, variable_path, variable_unit};
pub use which::WhichScenario;

use crate::clutch::{Clutch, Scenario, Service, Sharing, Tolerances};

/// A checked clutch design. Built only by reading a file; never changed afterwards.
#[derive(Debug, Clone, PartialEq)]
pub struct Design {
    /// Name.
    pub name: String,
    /// The clutch.
    pub clutch: Clutch,
    /// Allowables.
    pub limits: Limits,
    /// Names of the scenarios that must hold in `check`.
    pub check_scenarios: Vec<String>,
    /// All scenarios.
    pub scenarios: Vec<Scenario>,
    /// The optimiser's task, if any.
    pub optimize: Option<Optimize>,
    /// What the clutch is made to, if the file says.
    pub tolerances: Option<Tolerances>,
    /// What it goes through in its life, if the file says.
    pub service: Option<Service>,
    /// What sets its sprags apart, if the file says; all alike otherwise.
    pub sharing: Option<Sharing>,
    /// SHA-256 (hex) of the file's text and of the histories that it names.
    pub hash: String,
    /// The file's text, kept for reports and for `optimize` to edit.
    pub source: String,
    /// Where the file lies: its histories are named from there.
    pub folder: std::path::PathBuf,
    /// The files of its histories.
    pub histories: Vec<std::path::PathBuf>,
}

impl Design {
    /// The scenario of that name.
    pub fn scenario(&self, name: &str) -> Option<&Scenario> {
        self.scenarios.iter().find(|s| s.name == name)
    }

    /// The first twelve digits of its hash, by which answers name it.
    pub fn short_hash(&self) -> &str {
        self.hash.get(..12).unwrap_or(&self.hash)
    }
}
