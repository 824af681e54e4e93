//! Thickness of the film in a line contact.

use std::f64::consts::PI;

/// Two bodies that touch along a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmContact {
    /// R, 1/R = 1/R_1 + 1/R_2, m.
    pub radius_m: f64,
    /// E', 2/E' = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2, Pa.
    pub modulus_pa: f64,
    /// Length, m.
    pub length_m: f64,
}

impl FilmContact {
    /// Half of the width over which the bodies are flat under `load_n` (Hertz), m.
    pub fn half_width_m(&self, load_n: f64) -> f64 {
        (8.0 * load_n * self.radius_m / (PI * self.modulus_pa * self.length_m)).sqrt()
    }
}

/// A lubricant at one temperature, without pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fluid {
    /// eta, Pa s.
    pub viscosity_pa_s: f64,
    /// alpha, 1/Pa.
    pub pressure_coefficient_per_pa: f64,
}

named! {
    /// What decides a film: whether pressure thickens the oil, and whether the bodies yield.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Regime {
        /// Isoviscous, rigid: Martin.
        IsoviscousRigid = "IR",
        /// Isoviscous, elastic: soft.
        IsoviscousElastic = "IE",
        /// Piezoviscous, rigid.
        PiezoviscousRigid = "VR",
        /// Piezoviscous, elastic: what is commonly called elastohydrodynamic.
        PiezoviscousElastic = "VE",
    }
    /// Short, as in the literature: I or V for the oil, R or E for the bodies.
    pub fn name;
}

/// A film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Film {
    /// Thickness where the pressure is largest, m; 0 without speed.
    pub thickness_m: f64,
    /// Moes' M, load; none without speed.
    pub load: Option<f64>,
    /// Moes' L, lubricant.
    pub lubricant: f64,
    /// What decides it.
    pub regime: Regime,
}

impl Film {
    /// Moes' numbers up to which the formula was compared with a numerical solution (`tests/reference/film.csv`).
    pub const CHECKED: [f64; 2] = [50.0, 15.0];

    /// Part of the contact's relative radius up to which a film is thin, and the contact a parabola.
    pub const THIN: f64 = 0.01;

    /// h_0, where rigid bodies are closest, m: the largest pressure lies ahead of it.
    pub fn least_m(&self) -> f64 {
        least_m(self.thickness_m)
    }

    /// Whether it lies in that range.
    pub fn is_checked(&self) -> bool {
        self.load.is_some_and(|load| load <= Self::CHECKED[0]) && self.lubricant <= Self::CHECKED[1]
    }
}

/// Film of `contact` whose surfaces have the speeds u_1 + u_2 = `speed_sum_m_s` through it, under `load_n` > 0.
///
/// Moes' formula for line contacts (Moes 2000; Venner and Lubrecht 2000), all four regimes in one:
/// U = eta u_s/(E' R), M = w/(E' R l U^(1/2)), L = alpha E' U^(1/4), h = R U^(1/2) H,
///
///   H = [(H_RI^(7/3) + H_EI^(7/3))^(3s/7) + (H_RP^(-7/2) + H_EP^(-7/2))^(-2s/7)]^(1/s),  s = (7 + 8 exp(-2 H_EI/H_RI))/5,
///   H_RI = 3/M,  H_EI = 2.621 M^(-1/5),  H_RP = 1.287 L^(2/3),  H_EP = 1.311 M^(-1/8) L^(3/4).
///
/// In the rigid limit 3/M is the thickness at the largest pressure, 1.226 times the least one, which is Martin's 2.448/M.
pub fn film(contact: &FilmContact, fluid: &Fluid, speed_sum_m_s: f64, load_n: f64) -> Film {
    let FilmContact { radius_m, modulus_pa, length_m } = *contact;
    let u = fluid.viscosity_pa_s * speed_sum_m_s / (modulus_pa * radius_m);
    let m = load_n / (modulus_pa * radius_m * length_m * u.sqrt());
    let l = fluid.pressure_coefficient_per_pa * modulus_pa * u.powf(0.25);
    if u <= 0.0 {
        return Film { thickness_m: 0.0, load: None, lubricant: 0.0, regime: Regime::IsoviscousElastic };
    }
    let (h, regime) = moes(m, l);
    Film { thickness_m: radius_m * u.sqrt() * h, load: Some(m), lubricant: l, regime }
}

/// H and its regime: the stiffer of what the bodies allow an oil that pressure thickens, or the thicker of the two without.
fn moes(m: f64, l: f64) -> (f64, Regime) {
    let (ri, ei) = (3.0 / m, 2.621 * m.powf(-0.2));
    let (rp, ep) = (1.287 * l.powf(2.0 / 3.0), 1.311 * m.powf(-0.125) * l.powf(0.75));
    let s = 0.2 * (7.0 + 8.0 * (-2.0 * ei / ri).exp());
    let iso = (ri.powf(7.0 / 3.0) + ei.powf(7.0 / 3.0)).powf(3.0 / 7.0);
    let piezo = if l > 0.0 { (rp.powf(-3.5) + ep.powf(-3.5)).powf(-2.0 / 7.0) } else { 0.0 };
    let regime = match (piezo > iso, ri > ei, rp < ep) {
        (false, true, _) => Regime::IsoviscousRigid,
        (false, false, _) => Regime::IsoviscousElastic,
        (true, _, true) => Regime::PiezoviscousRigid,
        (true, _, false) => Regime::PiezoviscousElastic,
    };
    let larger = iso.max(piezo);
    (larger * ((iso / larger).powf(s) + (piezo / larger).powf(s)).powf(1.0 / s), regime)
}

/// Where the film of a rigid contact breaks, x/sqrt(2 R h_0), Reynolds' condition p = dp/dx = 0.
pub(super) const BREAKS: f64 = 0.475_406_9;

/// h_0 of a rigid contact whose film is so thick at the largest pressure, m.
fn least_m(thickness_m: f64) -> f64 {
    thickness_m / (1.0 + BREAKS * BREAKS)
}

/// Damping of a film against a change of its thickness, N s/m: Reynolds' equation with dh/dt for rigid surfaces,
/// linear about a steady film that is full up to where it breaks, p = 0 at both ends:
///
///   c = 12 eta l (2 R/h_0)^(3/2) J,  J = integral xi (xi - xi_0)/(1 + xi^2)^3 dxi = 0.1930,
///
/// xi from -infinity to 0.4754 and xi_0 such that the pressure ends at 0; h_0 = h/1.226. Without break J would be pi/8.
pub fn squeeze_n_s_per_m(contact: &FilmContact, fluid: &Fluid, thickness_m: f64) -> f64 {
    let c = BREAKS;
    let end = 1.0 + c * c;
    let least = least_m(thickness_m);
    let angle = c.atan() + 0.5 * PI;
    let second = 0.5 * (c / end + angle);
    let third = c / (4.0 * end * end) + 0.75 * second;
    let first = -0.25 / (end * end);
    let j = second - third - first * first / third;
    12.0 * fluid.viscosity_pa_s * contact.length_m * (2.0 * contact.radius_m / least).powf(1.5) * j
}

/// Time in which `load_n` squeezes a film of that thickness down to `to_m`, s, its pressure balancing the load by
/// [`squeeze_n_s_per_m`] alone: c goes with h^(-3/2), so t = 2 c h (sqrt(h/h_to) - 1)/N. 0 where it is as thin already.
pub fn squeeze_out_s(contact: &FilmContact, fluid: &Fluid, thickness_m: f64, to_m: f64, load_n: f64) -> f64 {
    if thickness_m <= to_m {
        return 0.0;
    }
    let damping = squeeze_n_s_per_m(contact, fluid, thickness_m);
    2.0 * damping * least_m(thickness_m) * ((thickness_m / to_m).sqrt() - 1.0) / load_n
}
