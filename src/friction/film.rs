//! Friction of a contact on a film of oil, over sliding speed and load.

use crate::clutch::Clutch;
use crate::lubrication::{Film, FilmContact, Fluid, Shear, asperity_share, film, shear, squeeze_n_s_per_m};

/// Contact of a clutch that overruns: the race slides through it, the sprag stands.
///
/// T = phi mu_b N + (1 - phi)(couette + rolling), phi the asperities' share at lambda = h/sigma: a Stribeck curve
/// that nothing is fitted to but phi.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmFriction {
    /// Sprag and race.
    pub contact: FilmContact,
    /// The oil at the temperature of the contact.
    pub fluid: Fluid,
    /// -d ln eta/dT there, 1/K.
    pub thinning_per_k: f64,
    /// sigma, m.
    pub roughness_m: f64,
    /// mu_b.
    pub boundary: f64,
}

/// The contact at one sliding speed under one load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmState {
    /// The film.
    pub film: Film,
    /// lambda = h/sigma.
    pub lambda: f64,
    /// Share of the load that asperities carry.
    pub asperities: f64,
    /// Shear of a full film.
    pub shear: Shear,
    /// Force along the surface, N.
    pub tangential_n: f64,
}

impl FilmFriction {
    /// Contact A of `clutch` with its oil at `temperature_c`; `None` without `[lubrication]`.
    pub fn of(clutch: &Clutch, temperature_c: f64) -> Option<Self> {
        let radius = clutch.sprags.inner_arcs.first()?.radius_m;
        let radius_m = 1.0 / (1.0 / clutch.races.inner_radius_m + 1.0 / radius);
        Self::on(clutch, clutch.materials.inner_race.plane_strain_compliance(), radius_m, temperature_c)
    }

    /// The contact that slides in overrun: A, or B in a cage that the inner race drives.
    pub fn in_overrun(clutch: &Clutch, temperature_c: f64) -> Option<Self> {
        if !clutch.slides_outside() {
            return Self::of(clutch, temperature_c);
        }
        let race = clutch.materials.outer_race.plane_strain_compliance();
        Self::on(clutch, race, Self::outer_radius_m(clutch), temperature_c)
    }

    /// R of 1/R = 1/r_e - 1/R_e, m.
    pub fn outer_radius_m(clutch: &Clutch) -> f64 {
        1.0 / (1.0 / clutch.sprags.outer_radius_m - 1.0 / clutch.races.outer_radius_m)
    }

    /// A sprag on a race of that compliance, 1/Pa, radius of the contact `radius_m`.
    fn on(clutch: &Clutch, race_per_pa: f64, radius_m: f64, temperature_c: f64) -> Option<Self> {
        let lubrication = clutch.lubrication.as_ref()?;
        let sprag = clutch.materials.sprag;
        Some(Self {
            contact: FilmContact {
                radius_m,
                modulus_pa: 2.0 / (sprag.plane_strain_compliance() + race_per_pa),
                length_m: clutch.contact_length_m(),
            },
            fluid: Fluid {
                viscosity_pa_s: lubrication.oil.viscosity_pa_s(temperature_c),
                pressure_coefficient_per_pa: lubrication.oil.pressure_coefficient_per_pa(temperature_c),
            },
            thinning_per_k: lubrication.oil.thinning_per_k(temperature_c),
            roughness_m: lubrication.roughness_m(),
            boundary: lubrication.boundary_friction,
        })
    }

    /// Sliding at `speed_abs_m_s` under `normal_n` > 0 of one sprag.
    pub fn at(&self, speed_abs_m_s: f64, normal_n: f64) -> FilmState {
        let film = film(&self.contact, &self.fluid, speed_abs_m_s, normal_n);
        let lambda = film.thickness_m / self.roughness_m;
        let asperities = asperity_share(lambda);
        let shear = shear(&self.contact, &self.fluid, &film, normal_n, speed_abs_m_s, self.thinning_per_k);
        let tangential_n =
            asperities * self.boundary * normal_n + (1.0 - asperities) * (shear.couette_n + shear.rolling_n);
        FilmState { film, lambda, asperities, shear, tangential_n }
    }

    /// What a sprag feels of it, by one look at the film:
    ///
    /// * T/N; that of the asperities without a load, where T is none.
    /// * x_p, how far ahead of the contact, where the race comes from, the film's pressure acts, m: the moments on the film are in balance,
    ///   so x_p N = 2 R F with F the rolling shear of either surface, whatever the regime; the asperities' part acts at the contact.
    /// * How far apart it keeps the bodies, m: h_0 of rigid ones; without a load there is no end to it.
    pub fn felt(&self, speed_abs_m_s: f64, normal_n: f64) -> [f64; 3] {
        if normal_n > LEAST_N {
            let state = self.at(speed_abs_m_s, normal_n);
            let rolling = (1.0 - state.asperities) * 2.0 * self.contact.radius_m * state.shear.rolling_n;
            [state.tangential_n / normal_n, rolling / normal_n, state.film.least_m()]
        } else {
            [self.boundary, 0.0, if speed_abs_m_s > 0.0 { f64::INFINITY } else { 0.0 }]
        }
    }

    /// T/N of [`Self::felt`].
    pub fn coefficient(&self, speed_abs_m_s: f64, normal_n: f64) -> f64 {
        self.felt(speed_abs_m_s, normal_n)[0]
    }

    /// x_p of [`Self::felt`], m.
    pub fn ahead_m(&self, speed_abs_m_s: f64, normal_n: f64) -> f64 {
        self.felt(speed_abs_m_s, normal_n)[1]
    }

    /// How the film follows a change, about the state at a speed and a load: (-dN/dh at that speed, N/m; dh/dv at that load, s; c, N s/m).
    pub fn compliance(&self, speed_m_s: f64, normal_n: f64) -> [f64; 3] {
        let h = |v: f64, n: f64| film(&self.contact, &self.fluid, v, n).thickness_m;
        let (dn, dv) = (BESIDE * normal_n, BESIDE * speed_m_s);
        let by_load = (h(speed_m_s, normal_n + dn) - h(speed_m_s, normal_n - dn)) / (2.0 * dn);
        let by_speed = (h(speed_m_s + dv, normal_n) - h(speed_m_s - dv, normal_n)) / (2.0 * dv);
        [-1.0 / by_load, by_speed, squeeze_n_s_per_m(&self.contact, &self.fluid, h(speed_m_s, normal_n))]
    }
}

/// Load below which there is none, N: a choice.
const LEAST_N: f64 = 1e-9;
/// Part of load and speed over which differences are taken.
const BESIDE: f64 = 1e-4;
