//! A scenario as written.
//!
//! In: TOML text. Out: these structs, in the file's units; see [`super::file`]. Absent: rules that join several keys.
//! Equations: none. The doc comments are the schema's descriptions.

use super::contact_file::ContactFile;
use super::file::{FrictionFile, MaterialFile, RacesFile, SpragsFile, SpringFile};
use super::random_torque::RandomTorqueFile;
use super::scenarios::KindFile;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

/// One scenario. Keys belong to kinds: static: torque_nm, start; torsional-excitation: preload_nm, amplitude_nm,
/// frequency_hz, abutment_stiffness_nm_per_rad, duration_s, speed_rpm, start, drivetrain; engagement: free_run_rpm,
/// reversing_torque_nm, stop_stiffness_nm_per_rad, bench_inertia_kg_m2, duration_s, drivetrain; overrun: speed_rpm,
/// overrun_rpm; transient: abutment_stiffness_nm_per_rad, duration_s, preload_nm, torque_step_nm, step_time_s,
/// torque_history_csv, torque_random, speed_rpm, speed_history_csv, overrun_rpm, start, drivetrain. Any of the clutch's tables may be overridden in part.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ScenarioFile {
    /// Unique name.
    #[schemars(length(min = 1))]
    pub name: String,
    /// What happens; decides which keys belong.
    pub kind: KindFile,
    /// static: torque held, N m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub torque_nm: Option<f64>,
    /// torsional-excitation and transient: preload on the inner race, N m.
    #[schemars(extend("minimum" = 0))]
    pub preload_nm: Option<f64>,
    /// torsional-excitation: amplitude of the torque on the outer race, N m.
    #[schemars(extend("minimum" = 0))]
    pub amplitude_nm: Option<f64>,
    /// torsional-excitation: frequency of that torque, Hz.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub frequency_hz: Option<f64>,
    /// torsional-excitation and transient: stiffness that ties the outer race to ground, N m/rad; absent beside a
    /// drivetrain: the outer race is free.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub abutment_stiffness_nm_per_rad: Option<f64>,
    /// torsional-excitation, engagement and transient: duration, s.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub duration_s: Option<f64>,
    /// torsional-excitation and transient: mean speed of the whole clutch, rev/min, absent: 0; overrun: speed of the outer race, rev/min.
    #[schemars(extend("minimum" = 0))]
    pub speed_rpm: Option<f64>,
    /// engagement: overrunning speed of the inner race at the start, rev/min.
    #[schemars(extend("minimum" = 0))]
    pub free_run_rpm: Option<f64>,
    /// engagement: magnitude of the torque that reverses the inner race, N m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub reversing_torque_nm: Option<f64>,
    /// engagement: stiffness of the stop that holds the outer race, N m/rad.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub stop_stiffness_nm_per_rad: Option<f64>,
    /// engagement: inertia of the test bench on the inner race, kg m^2; 0: none.
    #[schemars(extend("minimum" = 0))]
    pub bench_inertia_kg_m2: Option<f64>,
    /// transient: by how much the torque on the inner race jumps, N m, positive: engaging.
    pub torque_step_nm: Option<f64>,
    /// transient: when the torque jumps, s; absent: at the start.
    #[schemars(extend("minimum" = 0))]
    pub step_time_s: Option<f64>,
    /// transient: CSV file, named from the design file's folder, with the columns time_s and torque_nm: the torque
    /// on the inner race, engaging positive, straight between the rows; two rows at one time are a jump.
    #[schemars(length(min = 1))]
    pub torque_history_csv: Option<String>,
    /// transient: a random torque on the inner race beside preload_nm.
    pub torque_random: Option<RandomTorqueFile>,
    /// transient: CSV file, named from the design file's folder, with the columns time_s and speed_rpm: the mean
    /// speed, straight between the rows.
    #[schemars(length(min = 1))]
    pub speed_history_csv: Option<String>,
    /// overrun and transient: by how much the inner race is faster than the outer, rev/min; in an overrun below 0
    /// where the outer race is the faster one, as an engine that runs away from its starter; in a transient at the start,
    /// above 0. Such a transient starts at the sprags' equilibrium of the statics, whose forces lie 0.1 to 0.6 % beside those
    /// that the equations of motion then settle at.
    pub overrun_rpm: Option<f64>,
    /// static, torsional-excitation and transient: the equilibrium at the start: settled (with the energizing spring,
    /// absent: this one) or without-spring (of the torque alone, as in the paper).
    #[serde(default)]
    #[schemars(with = "StartFile")]
    pub start: Option<StartFile>,
    /// torsional-excitation, engagement and transient: names of the inertias of [[drivetrain]] that take part; absent: all
    /// of them, empty: none.
    pub drivetrain: Option<Vec<String>>,
    /// Keys of sprags that differ in this scenario.
    #[serde(default)]
    #[schemars(schema_with = "part_of::<SpragsFile>")]
    pub sprags: Option<toml::Table>,
    /// Keys of races that differ in this scenario.
    #[serde(default)]
    #[schemars(schema_with = "part_of::<RacesFile>")]
    pub races: Option<toml::Table>,
    /// Keys of spring that differ in this scenario.
    #[serde(default)]
    #[schemars(schema_with = "part_of::<SpringFile>")]
    pub spring: Option<toml::Table>,
    /// Keys of material that differ in this scenario.
    #[serde(default)]
    #[schemars(schema_with = "part_of::<MaterialFile>")]
    pub material: Option<toml::Table>,
    /// Keys of friction that differ in this scenario.
    #[serde(default)]
    #[schemars(schema_with = "part_of::<FrictionFile>")]
    pub friction: Option<toml::Table>,
    /// Keys of contact that differ in this scenario.
    #[serde(default)]
    #[schemars(schema_with = "part_of::<ContactFile>")]
    pub contact: Option<toml::Table>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(super) enum StartFile {
    Settled,
    WithoutSpring,
}

/// The schema of a table of which any key may be left out (tables within it as well; rows of arrays stay whole).
fn part_of<T: JsonSchema>(generator: &mut SchemaGenerator) -> Schema {
    let mut schema = T::json_schema(generator);
    super::shape::let_all_keys_be_absent(&mut schema);
    schema
}
