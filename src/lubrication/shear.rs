//! Forces along a film: shear by sliding and by rolling, what heat takes of it, and what the asperities carry.

use super::film::{BREAKS, Film, FilmContact, Fluid};
use std::f64::consts::PI;

/// Forces on the faster of two surfaces, against its motion, N.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shear {
    /// By sliding (Couette).
    pub couette_n: f64,
    /// By the pressure gradient (rolling).
    pub rolling_n: f64,
    /// Mean pressure of the film, Pa.
    pub pressure_pa: f64,
    /// Nahme's number beta eta v^2/k.
    pub nahme: f64,
}

/// Shear of the full film `film` between a surface that moves at `sliding_m_s` and one that stands.
///
/// Couette: eta v l C with C = integral dx/h: of a rigid contact up to where the film breaks 2.0144 sqrt(2 R/h_0), of a
/// flat one 2 a/h, together the root of the squares of both; viscosity at the mean pressure load/(l h C) by Roelands,
/// at the walls' temperature, times [`nahme_factor`]; the stress bends round to its limit, tau/sqrt(1 + (tau/tau_L)^2)
/// (Lee and Hamrock 1990). Rolling: integral (h/2) dp/dx dx of the rigid contact, 3.251 eta u l sqrt(2 R/h_0), u = v/2.
/// Both against the numerical solution in `tests/service/lubrication.rs`.
pub fn shear(
    contact: &FilmContact,
    fluid: &Fluid,
    film: &Film,
    load_n: f64,
    sliding_m_s: f64,
    thinning_per_k: f64,
) -> Shear {
    let FilmContact { radius_m, length_m, .. } = *contact;
    let h = film.thickness_m;
    if h <= 0.0 {
        return Shear { couette_n: 0.0, rolling_n: 0.0, pressure_pa: 0.0, nahme: 0.0 };
    }
    let c = BREAKS;
    let end = 1.0 + c * c;
    let angle = c.atan() + 0.5 * PI;
    let wedge = (2.0 * radius_m * end / h).sqrt();
    let rigid = angle * wedge;
    let path = rigid.hypot(2.0 * contact.half_width_m(load_n) / h);
    let area = length_m * h * path;
    let pressure_pa = load_n / area;
    let viscosity = fluid.viscosity_pa_s * roelands(fluid, pressure_pa);
    let nahme = thinning_per_k * viscosity * sliding_m_s * sliding_m_s / super::OIL_CONDUCTIVITY;
    let newtonian_pa = viscosity * sliding_m_s / h * nahme_factor(nahme);
    let gradient = 6.0 * (angle - 0.5 * end * (c / end + angle));
    Shear {
        couette_n: area * newtonian_pa / (newtonian_pa / limiting_pa(pressure_pa)).hypot(1.0),
        rolling_n: gradient * fluid.viscosity_pa_s * 0.5 * sliding_m_s * length_m * wedge,
        pressure_pa,
        nahme,
    }
}

/// Shear stress that an oil under pressure bears at most, Pa: tau_L = 2 MPa + 0.06 p, typical of mineral oils (0.04 to 0.1 of the
/// pressure: Bair and Winer 1979).
fn limiting_pa(pressure_pa: f64) -> f64 {
    2e6 + 0.06 * pressure_pa
}

/// eta(p)/eta(0) by Roelands (1966), Z from alpha: exp[(ln eta + 9.67)((1 + p/196.2 MPa)^Z - 1)], Z = alpha 196.2 MPa/(ln eta + 9.67).
pub fn roelands(fluid: &Fluid, pressure_pa: f64) -> f64 {
    let level = fluid.viscosity_pa_s.ln() + 9.67;
    let z = fluid.pressure_coefficient_per_pa * 1.962e8 / level;
    (level * ((1.0 + pressure_pa / 1.962e8).powf(z) - 1.0)).exp()
}

/// What the heat of its own shear leaves of the shear stress between two walls at equal temperature, 0 to 1: Nahme (1940),
/// eta ~ exp(-beta T), Na = beta eta v^2/k: asinh(g)/(g sqrt(1 + g^2)), g^2 = Na/8.
pub fn nahme_factor(nahme: f64) -> f64 {
    let g = (nahme / 8.0).max(0.0).sqrt();
    // The series to a part of 1e-12.
    if g < 1e-3 { 1.0 - 2.0 / 3.0 * g * g } else { g.asinh() / (g * g.hypot(1.0)) }
}

/// Share of the load that asperities carry at lambda = h/sigma: 1/(1 + lambda)^2, Olver and Spikes (1998), fitted to measured
/// traction between boundary and full film.
pub fn asperity_share(lambda: f64) -> f64 {
    (1.0 + lambda).powi(-2)
}
