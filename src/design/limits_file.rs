//! Limits, `[check]` and `[optimize]` as written.
//!
//! In: TOML text. Out: these structs, in the file's units; see [`super::file`]. Absent: rules that join several keys.
//! Equations: none. The doc comments are the schema's descriptions.

use super::objective::ObjectiveFile;
use schemars::JsonSchema;
use serde::Deserialize;

/// Allowables of the margin check; an absent one is not checked.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct LimitsFile {
    /// true: Hertz pressures and mean hoop stresses that are absent here are those which the library allows the
    /// materials that [material] names, with the torques at which they are held.
    pub from_material: Option<bool>,
    /// Torque at which hertz_nominal_mpa is held, N m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub nominal_torque_nm: Option<f64>,
    /// Torque at which Hertz peak, hoop, end of profile and roll-over are held, N m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub peak_torque_nm: Option<f64>,
    /// Allowed Hertz pressure at nominal torque, MPa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub hertz_nominal_mpa: Option<f64>,
    /// Allowed Hertz pressure at peak torque, MPa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub hertz_peak_mpa: Option<f64>,
    /// Allowed magnitude of the inner race's mean hoop stress at peak torque, MPa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub hoop_inner_mpa: Option<f64>,
    /// Allowed mean hoop stress of the outer race at peak torque, MPa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub hoop_outer_mpa: Option<f64>,
    /// Allowed hoop stress of the inner race with ring bending at peak torque, magnitude, MPa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub hoop_inner_bending_mpa: Option<f64>,
    /// Allowed hoop stress of the outer race with ring bending at peak torque, MPa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub hoop_outer_bending_mpa: Option<f64>,
    /// Depth of the hardened case of sprag and races, mm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub case_depth_mm: Option<f64>,
    /// Allowed largest shear below a contact at peak torque, MPa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub case_shear_mpa: Option<f64>,
    /// Allowed shear below a contact at case_depth_mm and deeper at peak torque, MPa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub core_shear_mpa: Option<f64>,
    /// Allowed compression of the sprag's body, half way between its contacts, at peak torque, MPa; needs flanks or
    /// a width_mm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub body_yield_mpa: Option<f64>,
    /// Axial load from race to race through all sprags while they are engaged, N; lowers the friction reserve.
    #[schemars(extend("minimum" = 0))]
    pub axial_load_n: Option<f64>,
    /// Allowed race gap at nominal torque, mm: outer minus inner track radius at rest and the growth of both races.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub gap_nominal_mm: Option<f64>,
    /// Allowed race gap at peak torque, mm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub gap_peak_mm: Option<f64>,
    /// Allowed windup at nominal torque, deg.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub windup_nominal_deg: Option<f64>,
    /// Allowed equivalent stress (von Mises) of the inner race under the mean track pressure at nominal torque, MPa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub equivalent_inner_mpa: Option<f64>,
    /// Allowed equivalent stress (von Mises) of the outer race under the mean track pressure at nominal torque, MPa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub equivalent_outer_mpa: Option<f64>,
    /// Smallest slip margin wanted, static friction over required friction minus 1.
    #[schemars(extend("minimum" = 0))]
    pub slip_margin: Option<f64>,
    /// Overrun speed up to which the sprags must not lift off, rev/min.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub keep_contact_to_rpm: Option<f64>,
    /// Overrun speed of the outer race by which the sprags must have lifted off the inner race, rev/min.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub lift_off_by_rpm: Option<f64>,
}

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
    /// What is made better: slip-margin (the smallest over the scenarios), torque-capacity, peak-pressure, windup (at
    /// nominal torque) or stiffness-curve (windups as in target).
    pub objective: ObjectiveFile,
    /// Names of the scenarios whose smallest slip margin is maximised, or which are limits of another objective.
    #[schemars(length(min = 1))]
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
    /// Seed of everything random.
    pub seed: u64,
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
}
