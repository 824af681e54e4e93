//! The design file as written: one struct per table, in the file's units.
//!
//! In: TOML text. Out: these structs, and through schemars the JSON Schema that both `schema` prints and
//! [`super::shape`] enforces, so ranges of single keys are stated here and nowhere else. Absent: rules that
//! join several keys ([`super::check`]). Equations: none. The doc comments are the schema's descriptions.

use super::contact_file::ContactFile;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::Deserialize;

/// A sprag clutch design. Lengths in mm, torques in N m, angles in rad, speeds in rev/min.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct DesignFile {
    /// Version of this file format; 1.
    #[serde(rename = "schema")]
    #[schemars(extend("const" = 1))]
    pub _schema: u32,
    /// Name of the design, for reports.
    #[schemars(length(min = 1))]
    pub name: String,
    /// Shape and number of the sprags.
    pub sprags: SpragsFile,
    /// The two races.
    pub races: RacesFile,
    /// Energizing spring.
    pub spring: SpringFile,
    /// Material: the three keys for all bodies alike, or the tables sprag, inner_race and outer_race.
    pub material: MaterialFile,
    /// Friction law (12).
    pub friction: FrictionFile,
    /// Local contact law; absent: elastic, square ends.
    #[serde(default)]
    pub contact: ContactFile,
    /// Allowables of the margin check; an absent one is not checked.
    #[serde(default)]
    pub limits: LimitsFile,
    /// What `check` holds the design to; absent: static limits only.
    #[serde(default)]
    pub check: CheckFile,
    /// Scenarios, each with a unique name.
    #[serde(default)]
    pub scenarios: Vec<ScenarioFile>,
    /// Task of the optimiser; absent: `optimize` has nothing to do.
    pub optimize: Option<OptimizeFile>,
}

/// Shape and number of the sprags. Body frame: origin C_e, y radially outward along OC_e at first contact
/// at rest, x towards positive azimuth.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SpragsFile {
    /// Number of sprags n_s.
    #[schemars(extend("minimum" = 3))]
    pub count: usize,
    /// Length of a sprag along the clutch axis, mm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub length_mm: f64,
    /// Radius r_e of the outer arc, mm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub outer_radius_mm: f64,
    /// Distance e_1 between the centres of the first inner arc and of the outer arc, mm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub centre_distance_mm: f64,
    /// Width b of the sprag's body in (6), mm; omitted or 0: no body compression.
    #[serde(default)]
    #[schemars(extend("minimum" = 0))]
    pub width_mm: f64,
    /// Mass of one sprag, kg; with inertia and centroid, or none of the three: then from the profile.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub mass_kg: Option<f64>,
    /// Inertia of one sprag about its centroid, kg m^2.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub inertia_kg_m2: Option<f64>,
    /// Centroid of a sprag in its body frame.
    pub centroid: Option<CentroidFile>,
    /// Inner arcs in the order in which engagement reaches them.
    #[schemars(length(min = 1))]
    pub inner_arcs: Vec<InnerArcFile>,
    /// Straight flanks that close the outline; absent: both at half of width_mm, or none where that is 0.
    pub flanks: Option<FlanksFile>,
}

/// Centroid of a sprag in its body frame, mm.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct CentroidFile {
    /// x, towards positive azimuth, mm.
    pub x_mm: f64,
    /// y, radially outward from C_e, mm.
    pub y_mm: f64,
}

/// One inner arc.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct InnerArcFile {
    /// Radius of the arc, mm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub radius_mm: f64,
    /// Turn of the contact direction in the body, from first contact at rest, at which the arc ends, rad.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = std::f64::consts::FRAC_PI_2))]
    pub until_rad: f64,
}

/// Distances of the two straight flanks from the strut line, to which they are parallel, mm: the line from the
/// inner contact A to the outer contact B at first contact at rest.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct FlanksFile {
    /// Flank on the side of negative x, mm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub rear_mm: f64,
    /// Flank on the side of positive x, mm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub front_mm: f64,
}

/// The two races.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct RacesFile {
    /// Bore radius R_id of the inner race, mm; 0: solid shaft.
    #[schemars(extend("minimum" = 0))]
    pub inner_bore_radius_mm: f64,
    /// Track radius R_i of the inner race, mm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub inner_radius_mm: f64,
    /// Track radius R_e of the outer race, mm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub outer_radius_mm: f64,
    /// Outside radius R_ed of the outer race, mm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub outer_outside_radius_mm: f64,
    /// Axial width of both races, l of (5), mm; at least the sprags' length.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub width_mm: f64,
    /// Inertia I_bi of the inner race, kg m^2.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub inner_inertia_kg_m2: f64,
    /// Inertia I_be of the outer race, kg m^2.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub outer_inertia_kg_m2: f64,
    /// Viscous damping C_rl between the races, N m s/rad.
    #[schemars(extend("minimum" = 0))]
    pub viscous_damping_nm_s_per_rad: f64,
}

/// Energizing spring.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SpringFile {
    /// Stiffness K_r per sprag, N m/rad; 0: no spring.
    #[schemars(extend("minimum" = 0))]
    pub stiffness_nm_per_rad: f64,
    /// Drag torque C_f of the whole clutch in slow overrun, N m; fixes the spring's free angle.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub drag_torque_nm: f64,
}

/// Material: the three keys for all bodies alike, or the tables sprag, inner_race and outer_race.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct MaterialFile {
    /// Young's modulus of all bodies, GPa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub youngs_modulus_gpa: Option<f64>,
    /// Poisson's ratio of all bodies.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 0.5))]
    pub poisson_ratio: Option<f64>,
    /// Density of all bodies, kg/m^3.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub density_kg_m3: Option<f64>,
    /// Material of the sprags.
    pub sprag: Option<BodyFile>,
    /// Material of the inner race.
    pub inner_race: Option<BodyFile>,
    /// Material of the outer race.
    pub outer_race: Option<BodyFile>,
}

/// Material of one body.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct BodyFile {
    /// Young's modulus, GPa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub youngs_modulus_gpa: f64,
    /// Poisson's ratio.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 0.5))]
    pub poisson_ratio: f64,
    /// Density, kg/m^3.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub density_kg_m3: f64,
}

/// Friction law (12): mu = kinetic + (static - kinetic) exp(-decay |v|).
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct FrictionFile {
    /// Static coefficient mu_s.
    #[serde(rename = "static")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub static_: f64,
    /// Kinetic coefficient mu_c, at most the static one.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub kinetic: f64,
    /// Decay gamma_b with sliding speed, s/m.
    #[schemars(extend("minimum" = 0))]
    pub decay_s_per_m: f64,
    /// stribeck: (12) at both races; vernay: at the inner race Coulomb friction with the static coefficient at
    /// every speed, at the outer race no slip.
    #[serde(default)]
    pub model: FrictionModelFile,
}

#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(super) enum FrictionModelFile {
    #[default]
    Stribeck,
    Vernay,
}

/// Allowables of the margin check; an absent one is not checked.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct LimitsFile {
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
    /// Axial load from race to race through all sprags while they are engaged, N; lowers the friction reserve.
    #[schemars(extend("minimum" = 0))]
    pub axial_load_n: Option<f64>,
    /// Smallest slip margin wanted, static friction over required friction minus 1.
    #[schemars(extend("minimum" = 0))]
    pub slip_margin: Option<f64>,
    /// Overrun speed up to which the sprags must not lift off, rev/min.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub keep_contact_to_rpm: Option<f64>,
}

/// What `check` holds the design to.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct CheckFile {
    /// Names of the scenarios that must hold; the others are shown only.
    pub scenarios: Vec<String>,
}

/// One scenario. Keys belong to kinds: static: torque_nm; torsional-excitation: preload_nm, amplitude_nm,
/// frequency_hz, abutment_stiffness_nm_per_rad, duration_s, speed_rpm; engagement: free_run_rpm,
/// reversing_torque_nm, stop_stiffness_nm_per_rad, bench_inertia_kg_m2, duration_s; overrun: speed_rpm,
/// overrun_rpm; transient: abutment_stiffness_nm_per_rad, duration_s, preload_nm, torque_step_nm, step_time_s,
/// torque_history_csv, speed_rpm, speed_history_csv, overrun_rpm. Any of the clutch's tables may be overridden in part.
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
    /// torsional-excitation and transient: stiffness that ties the outer race to ground, N m/rad.
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
    /// transient: CSV file, named from the design file's folder, with the columns time_s and speed_rpm: the mean
    /// speed, straight between the rows.
    #[schemars(length(min = 1))]
    pub speed_history_csv: Option<String>,
    /// overrun and transient: by how much the inner race is faster than the outer, in a transient at the start,
    /// rev/min.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub overrun_rpm: Option<f64>,
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
pub(super) enum KindFile {
    Static,
    TorsionalExcitation,
    Engagement,
    Overrun,
    Transient,
}

/// Task of the optimiser.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct OptimizeFile {
    /// What is maximised; slip-margin: the smallest over the scenarios.
    pub objective: ObjectiveFile,
    /// Names of the scenarios whose smallest slip margin is maximised.
    #[schemars(length(min = 1))]
    pub scenarios: Vec<String>,
    /// Design variables.
    #[schemars(length(min = 1))]
    pub variables: Vec<VariableFile>,
    /// Limits that replace those of the limits table for the search and are written into the new file.
    #[serde(default)]
    pub limits: LimitsFile,
    /// Seed of everything random.
    pub seed: u64,
}

#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(super) enum ObjectiveFile {
    SlipMargin,
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

/// The schema of a table of which any key may be left out (tables within it as well; rows of arrays stay whole).
fn part_of<T: JsonSchema>(generator: &mut SchemaGenerator) -> Schema {
    let mut schema = T::json_schema(generator);
    super::shape::let_all_keys_be_absent(&mut schema);
    schema
}
