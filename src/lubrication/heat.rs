//! Mean temperatures: a lumped network of the bodies.

use nalgebra::{Matrix4, Vector4};
use std::f64::consts::PI;

/// Thermal conductivity of hardened bearing steel, W/(m K): 40 to 46.
pub const STEEL_CONDUCTIVITY: f64 = 46.0;
/// sqrt(k rho c) of it, J/(m^2 K s^(1/2)): rho 7850 kg/m^3, c 475 J/(kg K).
pub const STEEL_EFFUSIVITY: f64 = 13_097.0;
/// kappa = k/(rho c) of it, m^2/s.
pub const STEEL_DIFFUSIVITY_M2_S: f64 = 1.2336e-5;

/// Conductances between contact A, inner race, sprags, outer race and the oil with its housing, W/K; all above 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Network {
    /// From the rubbing contacts into the inner race.
    pub into_race: f64,
    /// From the rubbing contacts into the sprags.
    pub into_sprags: f64,
    /// From the sprags through contact B into the outer race.
    pub through_outer: f64,
    /// From inner race, sprags and outer race to the oil.
    pub to_oil: [f64; 3],
}

/// Mean temperatures, C.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Temperatures {
    /// Surfaces of the rubbing contact.
    pub contact: f64,
    /// Inner race.
    pub inner_race: f64,
    /// Sprags.
    pub sprags: f64,
    /// Outer race.
    pub outer_race: f64,
}

/// A solved network.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Heat {
    /// Temperatures.
    pub temperatures: Temperatures,
    /// Heat made in the contacts, W, slips with it.
    pub heat_w: f64,
    /// What the oil takes from inner race, sprags, outer race, W.
    pub to_oil_w: [f64; 3],
}

impl Heat {
    /// The same with inner and outer race in each other's place: the heat was made at the outer one.
    pub fn inside_out(self) -> Self {
        let Temperatures { inner_race, outer_race, .. } = self.temperatures;
        let [inner, sprags, outer] = self.to_oil_w;
        let temperatures =
            Temperatures { inner_race: outer_race, outer_race: inner_race, ..self.temperatures };
        Self { temperatures, to_oil_w: [outer, sprags, inner], ..self }
    }

    /// What the balance leaves, by the heat made; 0 without heat.
    pub fn balance_error(&self) -> f64 {
        let left = (self.heat_w - self.to_oil_w.iter().sum::<f64>()).abs();
        if self.heat_w > 0.0 { left / self.heat_w } else { left }
    }
}

impl Network {
    /// Temperatures at which what the contacts make, `heat_w`, and what goes into inner race, sprags and outer race by themselves,
    /// `bodies_w`, goes to oil of `oil_c`. Linear: K (T - T_oil) = (heat, bodies), K symmetric.
    pub fn solve(&self, heat_w: f64, bodies_w: [f64; 3], oil_c: f64) -> Option<Heat> {
        let Self { into_race: r, into_sprags: s, through_outer: o, to_oil: [i, p, e] } = *self;
        let k = Matrix4::from([
            [r + s, -r, -s, 0.0],
            [-r, r + i, 0.0, 0.0],
            [-s, 0.0, s + o + p, -o],
            [0.0, 0.0, -o, o + e],
        ]);
        let [race_w, sprags_w, outer_w] = bodies_w;
        let rise = k.cholesky()?.solve(&Vector4::new(heat_w, race_w, sprags_w, outer_w));
        let temperatures = Temperatures {
            contact: oil_c + rise[0],
            inner_race: oil_c + rise[1],
            sprags: oil_c + rise[2],
            outer_race: oil_c + rise[3],
        };
        let heat_w = heat_w + bodies_w.iter().sum::<f64>();
        Some(Heat { temperatures, heat_w, to_oil_w: [i * rise[1], p * rise[2], e * rise[3]] })
    }
}

/// Conductance of `length_m` of a standing strip of half width `half_m` into a body of size `far_m`, W/K: heat spreads in half
/// circles, pi k l/ln(2 far/half).
pub fn standing_strip(length_m: f64, half_m: f64, far_m: f64) -> f64 {
    PI * STEEL_CONDUCTIVITY * length_m / (2.0 * far_m / half_m).ln().max(1.0)
}

/// The same of a strip under which the surface moves at `speed_m_s`, mean temperature of the strip: Jaeger's fast source,
/// q'' = (3 sqrt(pi)/4) e dT/sqrt(t), t = 2 b/v.
pub fn moving_strip(length_m: f64, half_m: f64, speed_m_s: f64) -> f64 {
    0.75 * PI.sqrt() * STEEL_EFFUSIVITY * length_m * (2.0 * half_m * speed_m_s).sqrt()
}
