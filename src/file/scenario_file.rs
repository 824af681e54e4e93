//! A scenario as written.
//!
//! In: TOML text. Out: these structs, in the file's units; see [`super::design_file`]. Absent: rules that join several keys.
//! Equations: none. The doc comments are the schema's descriptions.

use super::contact_file::ContactFile;
use super::design_file::{FrictionFile, MaterialFile, RacesFile, SpragsFile, SpringFile};
use super::random_torque::RandomTorqueFile;
use super::scenarios::{KindFile, SCENARIO_KINDS};
use crate::clutch::Start;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;
use serde_json::Value;

/// One scenario. Any of the clutch's tables may be overridden in part.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(transform = with_kinds)]
pub(super) struct ScenarioFile {
    /// Unique name.
    #[schemars(length(min = 1))]
    pub name: String,
    /// What happens; decides which keys belong.
    pub kind: KindFile,
    /// static: steady torque, N m.
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
    /// torsional-excitation and transient: stiffness from outer race to ground, N m/rad (some 1e5); that
    /// of a steel shaft 40 mm thick and 200 mm long is 1e5; absent beside a drivetrain: the outer race is free.
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
    #[schemars(with = "Start")]
    pub start: Option<Start>,
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

/// The schema of a table of which any key may be left out (tables within it as well; rows of arrays stay whole).
fn part_of<T: JsonSchema>(generator: &mut SchemaGenerator) -> Schema {
    let mut schema = T::json_schema(generator);
    super::shape::let_all_keys_be_absent(&mut schema);
    schema
}

/// Names the keys of each kind, from their table, in the description.
fn with_kinds(schema: &mut Schema) {
    let kinds =
        SCENARIO_KINDS.map(|k| format!("{}: {}", k.name, [k.required, k.optional].concat().join(", ")));
    let words = format!("One scenario. Keys belong to kinds: {}.", kinds.join("; "));
    if let Some(Value::String(description)) = schema.get_mut("description") {
        *description = description.replacen("One scenario.", &words, 1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A key's words name the kinds that it belongs to before its first colon, and those whose own sense follows behind a semicolon.
    #[test]
    fn keys_say_the_kinds_that_they_belong_to() {
        let schema = schemars::schema_for!(ScenarioFile);
        let properties = schema.get("properties").and_then(Value::as_object).unwrap();
        let mut keys = 0;
        for (key, property) in properties {
            let words = property.get("description").and_then(Value::as_str).unwrap_or("");
            let heads = words.split("; ").filter_map(|part| part.split_once(": ").map(|(head, _)| head));
            let named: Vec<&str> = heads.flat_map(|head| head.split([',', ' '])).collect();
            for kind in SCENARIO_KINDS {
                let belongs = kind.required.contains(&&**key) || kind.optional.contains(&&**key);
                assert_eq!(named.contains(&kind.name), belongs, "{key}, {}: {words}", kind.name);
                keys += usize::from(belongs);
            }
        }
        let all: usize = SCENARIO_KINDS.iter().map(|kind| kind.required.len() + kind.optional.len()).sum();
        assert_eq!(keys, all, "a key of the table is none of the file");
        let words = schema.get("description").and_then(Value::as_str).unwrap();
        assert!(words.contains("static: torque_nm, start; "), "{words}");
    }
}
