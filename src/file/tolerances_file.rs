//! `[tolerances]` as written, and the same in SI.
//!
//! In: TOML text. Out: [`Tolerances`]. Absent: what they do to a clutch (`optimise`). Equations: none. The doc
//! comments are the schema's descriptions.

use crate::clutch::Tolerances;
use crate::design::m;
use schemars::JsonSchema;
use serde::Deserialize;

/// Half ranges about the values of the file: each quantity lies anywhere between its value less and plus this.
#[derive(Debug, Default, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct TolerancesFile {
    /// Track radius of the inner race, mm.
    #[serde(default)]
    #[schemars(extend("minimum" = 0))]
    pub inner_race_radius_mm: f64,
    /// Track radius of the outer race, mm.
    #[serde(default)]
    #[schemars(extend("minimum" = 0))]
    pub outer_race_radius_mm: f64,
    /// Radius r_e of the sprags' outer arc, all sprags alike, mm.
    #[serde(default)]
    #[schemars(extend("minimum" = 0))]
    pub sprag_outer_radius_mm: f64,
    /// Radii of the sprags' inner arcs, all arcs and sprags alike, mm.
    #[serde(default)]
    #[schemars(extend("minimum" = 0))]
    pub sprag_inner_radius_mm: f64,
    /// Eccentricity of the races, mm, its amount and direction unknown: all sprags are looked at in a gap that much narrower
    /// or wider. A known one is resolved round the circumference: eccentricity in [races].
    #[serde(default)]
    #[schemars(extend("minimum" = 0))]
    pub run_out_mm: f64,
    /// Static friction coefficient; the kinetic one keeps its share of it.
    #[serde(default)]
    #[schemars(extend("minimum" = 0))]
    pub friction: f64,
    /// Temperature of the inner race above that of the outer, K: the inner track grows.
    #[serde(default)]
    #[schemars(extend("minimum" = 0))]
    pub temperature_k: f64,
    /// Thermal expansion of the races, 1/K.
    #[serde(default = "steel")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub expansion_per_k: f64,
}

/// Thermal expansion of steel, 1/K: 11.5e-6 (bearing and case-hardening steels, 20-100 C, DIN EN ISO 683-17).
fn steel() -> f64 {
    11.5e-6
}

impl TolerancesFile {
    /// The same in SI.
    pub fn si(&self) -> Tolerances {
        Tolerances {
            inner_race_radius_m: m(self.inner_race_radius_mm),
            outer_race_radius_m: m(self.outer_race_radius_mm),
            sprag_outer_radius_m: m(self.sprag_outer_radius_mm),
            sprag_inner_radius_m: m(self.sprag_inner_radius_mm),
            run_out_m: m(self.run_out_mm),
            friction: self.friction,
            temperature_k: self.temperature_k,
            expansion_per_k: self.expansion_per_k,
        }
    }
}
