//! `[[drivetrain]]` as it stands in the file.
//!
//! In: TOML. Out: structs in the file's units, ranges stated in their schema. Absent: rules that join keys
//! ([`super::drivetrain`]). Equations: none.

use schemars::JsonSchema;
use serde::Deserialize;

/// An inertia beside the clutch, joined towards it by a shaft and gears, or rigidly. Torques and speeds are positive in its
/// own positive sense, which is that of the races where ratios are above 0; on the outer race a positive torque engages the
/// clutch, on the inner race a negative one.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct DriveFile {
    /// Unique name.
    #[schemars(length(min = 1))]
    pub name: String,
    /// What it is joined to, towards the clutch: inner-race, outer-race or the name of another inertia.
    #[schemars(length(min = 1))]
    pub to: String,
    /// Inertia about its own axis, kg m^2; 0, which is a torque without a mass, only without a shaft; absent: 0, as where
    /// its speed is given.
    #[serde(default)]
    #[schemars(extend("minimum" = 0))]
    pub inertia_kg_m2: f64,
    /// Turns of this inertia for one turn of what it is joined to, below 0: it turns the other way; absent: 1.
    pub ratio: Option<f64>,
    /// Torsional stiffness of the shaft between, by the angle of this inertia (gears lie beyond it), N m/rad; absent: rigid.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub stiffness_nm_per_rad: Option<f64>,
    /// Damping of that shaft: torque per rate of its twist, N m s/rad; absent: 0.
    #[schemars(extend("minimum" = 0))]
    pub damping_nm_s_per_rad: Option<f64>,
    /// Torque per its own speed that brakes it, N m s/rad; absent: 0.
    #[schemars(extend("minimum" = 0))]
    pub drag_nm_s_per_rad: Option<f64>,
    /// Constant torque on it, N m.
    pub torque_nm: Option<f64>,
    /// CSV file, named from the design file's folder, with the columns time_s and torque_nm: a torque on it over time,
    /// straight between the rows; two rows at one time are a jump.
    #[schemars(length(min = 1))]
    pub torque_history_csv: Option<String>,
    /// CSV file, named from the design file's folder, with the columns time_s and speed_rpm: its speed, whatever torque that
    /// takes, straight between the rows, of either sign. It needs a shaft and has no inertia, no torque and nothing beyond it.
    #[schemars(length(min = 1))]
    pub speed_history_csv: Option<String>,
    /// Torques that go with its own angle.
    #[serde(default)]
    pub orders: Vec<OrderFile>,
    /// Gas torque of a four-stroke engine whose crank it is.
    pub gas: Option<GasFile>,
}

/// Torque amplitude_nm sin(order angle + phase_rad) with the angle that the inertia has turned.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct OrderFile {
    /// Periods for one turn of the inertia.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub order: f64,
    /// Amplitude, N m.
    #[schemars(extend("minimum" = 0))]
    pub amplitude_nm: f64,
    /// Phase at the start, rad; absent: 0.
    #[serde(default)]
    pub phase_rad: f64,
}

/// Gas torque of an evenly fired four-stroke engine: ideal cycle at constant volume, one polytropic exponent, centred
/// slider-crank; intake and exhaust without torque, torque of the reciprocating masses left out.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct GasFile {
    /// Number of cylinders.
    #[schemars(extend("minimum" = 1, "maximum" = 24))]
    pub cylinders: usize,
    /// Bore of a cylinder, mm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub bore_mm: f64,
    /// Stroke, mm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub stroke_mm: f64,
    /// Largest over smallest volume of a cylinder.
    #[schemars(extend("exclusiveMinimum" = 1, "maximum" = 100))]
    pub compression_ratio: f64,
    /// Crank radius over length of the connecting rod; absent: 0.3.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 0.9))]
    pub rod_ratio: Option<f64>,
    /// Absolute pressure at the start of compression, MPa; absent: 0.1.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub intake_pressure_mpa: Option<f64>,
    /// Exponent of compression and expansion; absent: 1.3.
    #[schemars(extend("minimum" = 1.01, "maximum" = 2))]
    pub polytropic_exponent: Option<f64>,
    /// Mean indicated pressure, MPa; 0 or absent: the engine is turned and does not fire.
    #[serde(default)]
    #[schemars(extend("minimum" = 0))]
    pub mean_pressure_mpa: f64,
    /// Turn of the crank at the start from the upper dead centre at which the first cylinder fires, rad; absent: 0.
    #[serde(default)]
    pub phase_rad: f64,
}
