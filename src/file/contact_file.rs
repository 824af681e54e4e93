//! `[contact]` as it stands in the file: law, and what the contacts are like along the axis.
//!
//! In: TOML. Out: structs in the file's units, ranges stated in their schema. Absent: rules that join keys
//! ([`super::check`], [`super::axial`]). Equations: none.

use crate::clutch::{LawName, StressState};
use schemars::JsonSchema;
use serde::Deserialize;

/// Local contact law, and how sprag and race lie along the axis.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ContactFile {
    /// Which law; absent: elastic. Only roller and slice take a roller_coefficient.
    #[serde(default)]
    pub law: LawName,
    /// Coefficient K of the roller law K N^0.9/l^0.8, for N and mm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub roller_coefficient: Option<f64>,
    /// Number of slices along a contact, for the slice law, end profiles, tilt and pressure along the length;
    /// absent: 60.
    #[schemars(extend("minimum" = 2, "maximum" = 2000))]
    pub slices: Option<usize>,
    /// Shape of the sprag along its length, at both contacts; absent: square ends.
    pub end_profile: Option<EndProfileFile>,
    /// Tilt of the sprags against the races in the plane of axis and normal, mrad; absent: 0.
    #[schemars(extend("minimum" = -100, "maximum" = 100))]
    pub tilt_mrad: Option<f64>,
    /// How far the middle of the sprags lies from the middle of the races, along the axis, mm; absent: 0.
    pub axial_offset_mm: Option<f64>,
    /// Hunt and Crossley's damping: the normal force is raised by this times the rate of approach, s/m; steel
    /// 0.08 to 0.32; absent or 0: none, as in the paper.
    #[serde(default)]
    #[schemars(extend("minimum" = 0, "maximum" = 10))]
    pub hunt_crossley_s_per_m: f64,
    /// Stress state of the elastic law; absent: layer.
    #[schemars(with = "StressState")]
    #[serde(default)]
    pub stress_state: Option<StressState>,
}

/// Drop of the sprag's surface along its length; each kind reads its own keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct EndProfileFile {
    /// Kind: square (straight to a sharp end), lundberg (logarithmic, for design_load_n), crown (arc of radius_mm
    /// over the whole length), end-relief (arcs of radius_mm over the last length_mm), fujiwara-kawase (logarithmic,
    /// for design_load_n with load_factor, crowned_ratio, end_drop_um), table (points).
    pub kind: EndKindFile,
    /// lundberg, fujiwara-kawase: normal force of one sprag for which the profile is made, N.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub design_load_n: Option<f64>,
    /// crown, end-relief: radius of the arc in the plane of the axis, mm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub radius_mm: Option<f64>,
    /// end-relief: length of the relieved part at each end, mm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub length_mm: Option<f64>,
    /// fujiwara-kawase: factor K_1 on the design load.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub load_factor: Option<f64>,
    /// fujiwara-kawase: K_2, crowned part of half the length.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 1))]
    pub crowned_ratio: Option<f64>,
    /// fujiwara-kawase: z_m, drop at the very end, um.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub end_drop_um: Option<f64>,
    /// table: measured points, from one end of the sprag to the other.
    #[schemars(length(min = 2))]
    pub points: Option<Vec<ProfilePointFile>>,
}

/// One point of a measured profile.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ProfilePointFile {
    /// Position along the axis from the middle of the sprag, mm.
    pub y_mm: f64,
    /// Drop below the straight line, um.
    #[schemars(extend("minimum" = 0))]
    pub drop_um: f64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(super) enum EndKindFile {
    Square,
    Lundberg,
    Crown,
    EndRelief,
    FujiwaraKawase,
    Table,
}
