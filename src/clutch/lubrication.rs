//! What lubricates a clutch, and what its rubbing surfaces are like.
//!
//! In: nothing. Out: [`Lubrication`], SI and C. Absent: what comes of it (`friction`, `scenario`). Equations: none.

use crate::lubrication::Oil;

/// Lubricant, surfaces and what leads their heat away.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lubrication {
    /// The oil, or the base oil of the grease.
    pub oil: Oil,
    /// Temperature of oil and housing, C.
    pub temperature_c: f64,
    /// Whether the contact is at the temperature of a heat balance; otherwise at that of the oil.
    pub heat_balance: bool,
    /// Roughness Rq of the race's track, m.
    pub race_roughness_m: f64,
    /// The same of the sprags.
    pub sprag_roughness_m: f64,
    /// Coefficient of friction where asperities carry.
    pub boundary_friction: f64,
    /// Archard's k of the sprags, m^3/(N m).
    pub sprag_wear_m2_per_n: f64,
    /// The same of the race.
    pub race_wear_m2_per_n: f64,
    /// Conductances of inner race, all sprags, outer race to the oil, W/K; `None`: estimated.
    pub to_oil_w_per_k: [Option<f64>; 3],
    /// Mean heat of slips at A beside the drag, all sprags, W.
    pub slip_heat_w: f64,
    /// A slip whose flash temperature and wear are asked for.
    pub slip: Option<SlipCase>,
}

impl Lubrication {
    /// sigma = sqrt(Rq_1^2 + Rq_2^2), m.
    pub fn roughness_m(&self) -> f64 {
        self.race_roughness_m.hypot(self.sprag_roughness_m)
    }
}

/// A slip under load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlipCase {
    /// Torque that the clutch carries, N m.
    pub torque_nm: f64,
    /// Sliding speed of contact A, m/s.
    pub speed_m_s: f64,
    /// How far it slides, m.
    pub path_m: f64,
}
