//! `[check]` and `[optimize]` as written.
//!
//! In: TOML text. Out: these structs, in the file's units; see [`super::design_file`]. Absent: rules that join several keys.
//! Equations: none. The doc comments are the schema's descriptions.

use crate::design::LimitsFile;
use crate::design::Objective;
use schemars::JsonSchema;
use serde::Deserialize;

/// What `check` holds the design to.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct CheckFile {
    /// Names of the scenarios that must hold; the others are shown only.
    pub scenarios: Vec<String>,
}

/// Task of the optimiser.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct OptimizeFile {
    /// What is made better: slip-margin or contact-margin (the smallest over the scenarios), torque-capacity, peak-pressure,
    /// windup (at nominal torque), stiffness-curve (windups as in target), keep-contact or lift-off (the speed of lift-off,
    /// more or less of it), drag, mass, width or outside-diameter. `explain NAME` says more of each.
    pub objective: Objective,
    /// Names of the scenarios whose smallest slip margin is maximised, or which are limits of another objective, which can do without any.
    #[serde(default)]
    pub scenarios: Vec<String>,
    /// Wanted windups of stiffness-curve: pairs of torque, N m, and windup, deg.
    #[serde(default)]
    pub target: Vec<[f64; 2]>,
    /// Design variables.
    #[schemars(length(min = 1))]
    pub variables: Vec<VariableFile>,
    /// Limits that replace those of the limits table for the search and are written into the new file.
    #[serde(default)]
    pub limits: LimitsFile,
    /// Step in which lengths can be made, mm: those of the optimum are rounded to multiples of it, to a side that holds every
    /// limit. 0: no rounding.
    #[serde(default = "step_mm")]
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub step_mm: f64,
    /// What every margin keeps beyond its limit, room in the outline apart: 0.05 holds each limit with 5 % to spare.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 1))]
    pub reserve: f64,
    /// Seed of everything random.
    pub seed: u64,
}

/// What grinding of profiles keeps to without special care: a choice.
fn step_mm() -> f64 {
    0.005
}

/// One design variable with its bounds, in the unit of its name.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct VariableFile {
    /// Name of the variable, such as r_i2_mm.
    pub name: String,
    /// Lower bound.
    pub min: f64,
    /// Upper bound.
    pub max: f64,
    /// Further numbers of the clutch, by dotted path, that change by the same amount: with length_mm say races.width_mm.
    #[serde(default)]
    pub moves: Vec<String>,
    /// Further numbers of the clutch, by dotted path, that stay in proportion to it.
    #[serde(default)]
    pub scales: Vec<String>,
}
