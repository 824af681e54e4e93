//! What a clutch is made to.
//!
//! In: nothing. Out: [`Tolerances`], SI. Absent: what they do to a clutch (`optimise`). Equations: none.

/// Half ranges of what a clutch is made to, SI; 0 where nothing varies.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tolerances {
    /// Inner track radius, m.
    pub inner_race_radius_m: f64,
    /// Outer track radius, m.
    pub outer_race_radius_m: f64,
    /// r_e, m.
    pub sprag_outer_radius_m: f64,
    /// All r_ik together, m.
    pub sprag_inner_radius_m: f64,
    /// Eccentricity of the races of unknown amount, all sprags in the worst gap, m.
    pub run_out_m: f64,
    /// mu_s.
    pub friction: f64,
    /// Inner race above outer race, K.
    pub temperature_k: f64,
    /// Thermal expansion of the races, 1/K.
    pub expansion_per_k: f64,
}
