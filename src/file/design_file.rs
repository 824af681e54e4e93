//! The design file as written: one struct per table, in the file's units.
//!
//! In: TOML text. Out: these structs, and through schemars the JSON Schema that both `schema` prints and
//! [`super::shape`] enforces, so ranges of single keys are stated here and nowhere else. Absent: rules that
//! join several keys ([`super::check`]). Equations: none. The doc comments are the schema's descriptions.

use super::cage_file::CageFile;
use super::contact_file::ContactFile;
use super::drivetrain_file::DriveFile;
use super::life_file::LifeFile;
use super::lubrication_file::LubricationFile;
use super::scenario_file::ScenarioFile;
use super::sharing_file::SharingFile;
use super::task_file::{CheckFile, OptimizeFile};
use super::tolerances_file::TolerancesFile;
use crate::clutch::{Carrier, Rim};
use crate::design::LimitsFile;
use schemars::JsonSchema;
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
    /// Cage that turns with the inner race and carries the sprags; absent: free and massless, the sprags ride with the outer race.
    pub cage: Option<CageFile>,
    /// Material: the three keys for all bodies alike, or the tables sprag, inner_race and outer_race.
    pub material: MaterialFile,
    /// Friction law (12).
    pub friction: FrictionFile,
    /// Temperatures of the bodies in service; absent: all at the reference temperature.
    pub thermal: Option<ThermalFile>,
    /// Oil or grease, roughness and what leads heat away; absent: no film, friction law (12) alone.
    pub lubrication: Option<LubricationFile>,
    /// Local contact law; absent: elastic, square ends.
    #[serde(default)]
    pub contact: ContactFile,
    /// Allowables of the margin check; an absent one is not checked.
    #[serde(default)]
    pub limits: LimitsFile,
    /// What `check` holds the design to; absent: static limits only.
    #[serde(default)]
    pub check: CheckFile,
    /// What the clutch goes through in its life, and what its bodies bear; absent: `life` has nothing to do.
    pub life: Option<LifeFile>,
    /// Sprags one by one, their deviations drawn or given; absent: all alike.
    pub sharing: Option<SharingFile>,
    /// Scenarios, each with a unique name.
    #[serde(default)]
    pub scenarios: Vec<ScenarioFile>,
    /// Inertias beside the clutch, on either side of it, in every scenario that moves; absent: the races alone.
    #[serde(default)]
    pub drivetrain: Vec<DriveFile>,
    /// Task of the optimiser; absent: `optimize` has nothing to do.
    pub optimize: Option<OptimizeFile>,
    /// What the clutch is made to; absent: nothing varies.
    pub tolerances: Option<TolerancesFile>,
}

/// Shape and number of the sprags. Body frame: origin C_e, y radially outward along OC_e at first contact
/// at rest, x towards positive azimuth.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
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
    /// Distance e_1 between the centres of the first inner arc and of the outer arc, mm; none with strut_angle_deg.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub centre_distance_mm: Option<f64>,
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
    /// Inner arcs in the order in which engagement reaches them; absent where inner_spiral begins at first contact.
    #[serde(default)]
    #[schemars(length(min = 1))]
    pub inner_arcs: Vec<InnerArcFile>,
    /// A spiral behind the inner arcs, or in place of them; absent: arcs alone.
    pub inner_spiral: Option<InnerSpiralFile>,
    /// Straight flanks that close the outline; absent: both at half of width_mm, or none where that is 0.
    pub flanks: Option<FlanksFile>,
}

/// Centroid of a sprag in its body frame, mm.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct CentroidFile {
    /// x, towards positive azimuth, mm.
    pub x_mm: f64,
    /// y, radially outward from C_e, mm.
    pub y_mm: f64,
}

/// One inner arc.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct InnerArcFile {
    /// Radius of the arc, mm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub radius_mm: f64,
    /// Turn of the contact direction in the body, from first contact at rest, at which the arc ends, rad.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = std::f64::consts::FRAC_PI_2))]
    pub until_rad: f64,
}

/// A piece of the inner profile whose radius of curvature grows by the same part for every radian of turn. Tangent arcs stand
/// for it, which begin and end on it; every answer says how far they lie beside it.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct InnerSpiralFile {
    /// constant-strut-angle: the curve that keeps the strut angle of its beginning between these races, a logarithmic spiral
    /// about C_e less outer_radius_mm times inner over outer track radius; logarithmic: the spiral of start_radius_mm and
    /// rise. Absent: constant-strut-angle.
    #[serde(default)]
    pub curve: SpiralCurveFile,
    /// Strut angle omega at first contact at rest, deg, by which the sprag lies between the races; where there are inner_arcs
    /// the centre distance says it.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 45))]
    pub strut_angle_deg: Option<f64>,
    /// Radius of curvature where a logarithmic spiral begins, mm: its distance from the pole times the root of 1 + rise^2.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub start_radius_mm: Option<f64>,
    /// Growth of a logarithmic spiral's radius per rad of turn over the radius, tangent of the angle between the radius from
    /// its pole and its normal; 0: an arc. Absent: the tangent of the strut angle where it begins, the pole on the strut.
    #[schemars(extend("minimum" = -1, "maximum" = 1))]
    pub rise: Option<f64>,
    /// Turn of the contact direction in the body, from first contact at rest, at which the spiral ends, rad.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = std::f64::consts::FRAC_PI_2))]
    pub until_rad: f64,
    /// Steps into which its turn is cut, each of which two arcs stand for; absent: 12.
    #[schemars(extend("minimum" = 1, "maximum" = 100))]
    pub steps: Option<usize>,
}

#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(super) enum SpiralCurveFile {
    #[default]
    ConstantStrutAngle,
    Logarithmic,
}

/// The two straight flanks. The strut line runs from the inner contact A to the outer contact B at first contact at
/// rest; distances are measured from its middle, mm, and leans against it, rad, positive where the sprag grows wider
/// outwards.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct FlanksFile {
    /// Flank on the side of negative x, mm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub rear_mm: f64,
    /// Flank on the side of positive x, mm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub front_mm: f64,
    /// Lean of the rear flank, rad.
    #[serde(default)]
    #[schemars(extend("minimum" = -crate::profile::STEEPEST_RAD, "maximum" = crate::profile::STEEPEST_RAD))]
    pub rear_tilt_rad: f64,
    /// Lean of the front flank, rad.
    #[serde(default)]
    #[schemars(extend("minimum" = -crate::profile::STEEPEST_RAD, "maximum" = crate::profile::STEEPEST_RAD))]
    pub front_tilt_rad: f64,
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
    /// Inertia I_bi of the inner race and all that is fixed to it, kg m^2; absent: that of the ring alone, by its radii, width
    /// and density.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub inner_inertia_kg_m2: Option<f64>,
    /// Inertia I_be of the outer race and all that is fixed to it, kg m^2; absent: that of the ring alone.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub outer_inertia_kg_m2: Option<f64>,
    /// Viscous damping C_rl between the races, N m s/rad.
    #[schemars(extend("minimum" = 0))]
    pub viscous_damping_nm_s_per_rad: f64,
    /// Interference fits of the races with shaft and housing; absent: loose. The radii above are then as made.
    pub press_fit: Option<PressFitFile>,
    /// Axes of the two tracks apart by a known amount; absent: concentric.
    pub eccentricity: Option<EccentricityFile>,
    /// What holds the bore of the inner race against load: nothing, or a shaft so stiff that the bore keeps its radius and does
    /// not slide on it; absent: free.
    #[serde(default)]
    pub inner_rim: Rim,
    /// What holds the outside of the outer race against load: nothing, or a housing so stiff that the outside keeps its radius
    /// and does not slide in it; absent: free.
    #[serde(default)]
    pub outer_rim: Rim,
}

/// Tracks off centre, for the rows run-out-* of `check`: every sprag in its own gap. Not a tolerance: [tolerances] has
/// run_out_mm for an amount that is not known.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct EccentricityFile {
    /// Distance between the axes of the two tracks, mm: half of what a dial indicator reads (TIR).
    #[schemars(extend("minimum" = 0))]
    pub offset_mm: f64,
    /// Whether the engaged clutch turns against the offset (bearings out of line); absent or false: the offset stays with
    /// the sprags (a track that runs out, or a clutch that stands).
    #[serde(default)]
    pub turning: bool,
    /// The race that the offset stays with while the clutch winds up: the one whose track runs out, or that stands while
    /// the bearings are off centre; absent: outer-race.
    #[serde(default)]
    pub stays_with: Carrier,
    /// Radial stiffness of the bearings of both races together, N/um; 0: a race that floats on the sprags once they
    /// are engaged; absent: stiff, the offset stays as it is.
    #[schemars(extend("minimum" = 0))]
    pub bearing_stiffness_n_per_um: Option<f64>,
}

/// Interference fits at the reference temperature. Shaft and housing are of the material, the width and the temperature
/// of the race that they are joined with.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct PressFitFile {
    /// Interference of the shaft in the bore of the inner race, on diameter, um.
    #[schemars(extend("minimum" = 0))]
    pub inner_interference_um: Option<f64>,
    /// Bore radius of the shaft, mm; absent or 0: solid.
    #[serde(default)]
    #[schemars(extend("minimum" = 0))]
    pub shaft_bore_radius_mm: f64,
    /// Interference of the housing on the outside of the outer race, on diameter, um.
    #[schemars(extend("minimum" = 0))]
    pub outer_interference_um: Option<f64>,
    /// Outside radius of the housing, mm.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub housing_outside_radius_mm: Option<f64>,
}

/// Temperatures in service, degrees Celsius; each even throughout its body. Expansion comes from the materials.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ThermalFile {
    /// Temperature at which the dimensions of this file are measured, C; absent: 20.
    #[schemars(extend("minimum" = -273.15, "maximum" = 1500.0))]
    pub reference_c: Option<f64>,
    /// Temperature of the inner race, C.
    #[schemars(extend("minimum" = -273.15, "maximum" = 1500.0))]
    pub inner_race_c: f64,
    /// Temperature of the outer race, C.
    #[schemars(extend("minimum" = -273.15, "maximum" = 1500.0))]
    pub outer_race_c: f64,
    /// Temperature of the sprags, C.
    #[schemars(extend("minimum" = -273.15, "maximum" = 1500.0))]
    pub sprags_c: f64,
}

/// Energizing spring.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SpringFile {
    /// Stiffness K_r per sprag, N m/rad; 0: no spring.
    #[schemars(extend("minimum" = 0))]
    pub stiffness_nm_per_rad: f64,
    /// Drag torque C_f of the whole clutch in slow overrun at a sliding friction of 0.1, N m; fixes the spring's free
    /// angle. Drag that is computed is at the design's own friction over speed.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub drag_torque_nm: f64,
}

/// Material: keys for all bodies alike, or the tables sprag, inner_race and outer_race.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct MaterialFile {
    /// Name of a steel that `sprag-design materials` lists; its values stand where the other keys are absent.
    #[schemars(length(min = 1))]
    pub name: Option<String>,
    /// Young's modulus of all bodies, GPa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub youngs_modulus_gpa: Option<f64>,
    /// Poisson's ratio of all bodies.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 0.5))]
    pub poisson_ratio: Option<f64>,
    /// Density of all bodies, kg/m^3.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub density_kg_m3: Option<f64>,
    /// Linear thermal expansion of all bodies, um/(m K); read with [thermal].
    #[schemars(extend("minimum" = 0))]
    pub expansion_um_per_m_k: Option<f64>,
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
    /// Name of a steel that `sprag-design materials` lists; its values stand where the other keys are absent.
    #[schemars(length(min = 1))]
    pub name: Option<String>,
    /// Young's modulus, GPa.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub youngs_modulus_gpa: Option<f64>,
    /// Poisson's ratio.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 0.5))]
    pub poisson_ratio: Option<f64>,
    /// Density, kg/m^3.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub density_kg_m3: Option<f64>,
    /// Linear thermal expansion, um/(m K); read with [thermal].
    #[schemars(extend("minimum" = 0))]
    pub expansion_um_per_m_k: Option<f64>,
}

/// Friction law (12): mu = kinetic + (static - kinetic) exp(-decay |v|).
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct FrictionFile {
    /// Static coefficient mu_s.
    #[serde(rename = "static")]
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 2))]
    pub static_: f64,
    /// Kinetic coefficient mu_c, at most the static one.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 2))]
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
