//! The checked, immutable design: a clutch with its limits, its scenarios and what is asked of it.
//!
//! In: values that somebody has checked (`file`, for one). Out: [`Design`], SI, with [`Limits`] and the task [`Optimize`]; the units in
//! which these are written. Absent: TOML, which reads and changes a design (`file`); any physics; what a clutch is (`clutch`).
//! Equations: none.

mod draft;
mod limits;
mod objective;
mod units;
mod which;

pub use draft::{
    BOX, Draft, DraftScene, ENGAGE, KINETIC_SHARE, NEW_SCENES, NewScene, OVERRUN, RATED_STATIC, RATED_STEP,
    RESERVE, SWING, USUAL_SLIDING_RAD_S, VISCOUS_SHARE,
};
pub(crate) use limits::LimitsFile;
pub use limits::{LIMIT_KEYS, LimitKey, Limits};
pub use objective::{Link, Objective, Optimize, OptimizeVariable, multiple};
pub(crate) use units::{m, pa};
pub use units::{rad_s, rpm};
pub use which::{WhichScenario, did_you_mean, nearest};

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
