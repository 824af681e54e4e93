//! What rubs away: in an hour of overrun and in a slip under load, and how hot that slip gets.

use crate::clutch::{Lubrication, SlipCase};
use crate::design::Design;
use crate::friction::FilmFriction;
use crate::lubrication::{flash_k, flat_depth_m, peclet, track_depth_m};
use crate::margin::{LoadState, OverrunPoint};

/// Depths that an hour of overrun takes, from the load that asperities carry (Archard).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HourlyWear {
    /// Of a sprag in the first hour from its drawn shape, m: it grows with the power 2/3 of time.
    pub sprag_m: f64,
    /// Of the track that they slide on, in every hour alike, m.
    pub race_m: f64,
}

/// Wear in an hour at `point`; `None` without a film, where nothing rubs by asperities that anything is known of.
pub fn hourly_wear(design: &Design, point: &OverrunPoint) -> Option<HourlyWear> {
    let lubrication = design.clutch.lubrication.as_ref()?;
    let on_film = point.lubricated.as_ref()?;
    let contact = &on_film.law.contact;
    let clutch = &design.clutch;
    let track_m = clutch.sliding_track_m();
    let path_m = point.speed_rad_s * track_m * 3600.0;
    let rubbed = on_film.film.asperities * point.state.sliding_n * path_m;
    let all = clutch.sprags.count as f64 * rubbed;
    Some(HourlyWear {
        sprag_m: flat_depth_m(
            lubrication.sprag_wear_m2_per_n * rubbed,
            contact.radius_m,
            contact.length_m,
            contact.half_width_m(point.state.sliding_n),
        ),
        race_m: track_depth_m(lubrication.race_wear_m2_per_n * all, track_m, contact.length_m),
    })
}

/// One slip under load at the inner contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlipEffect {
    /// What slips.
    pub case: SlipCase,
    /// Normal force of one sprag, N.
    pub normal_n: f64,
    /// Friction coefficient.
    pub friction: f64,
    /// Work of friction at the inner contacts of all sprags, J: their heat.
    pub work_j: f64,
    /// Heat of one contact over its flat, W/m^2.
    pub flux_w_m2: f64,
    /// Rise of the hottest place above the bodies, K.
    pub flash_k: f64,
    /// v a/(2 kappa): below some 5 heat goes sideways too, and the flash is less.
    pub peclet: f64,
    /// Depth worn off a sprag, m.
    pub sprag_m: f64,
    /// Depth worn off a place of the race that one sprag slips over, m.
    pub race_m: f64,
}

/// The slip that the file asks for; `None` where it asks for none, or the clutch does not carry that torque.
pub fn slip_effect(design: &Design, state: &LoadState) -> Option<SlipEffect> {
    let Lubrication { temperature_c, sprag_wear_m2_per_n, race_wear_m2_per_n, slip, .. } =
        *design.clutch.lubrication.as_ref()?;
    let case = slip?;
    let point = state.curve.at_torque(case.torque_nm)?;
    let law = FilmFriction::of(&design.clutch, temperature_c)?;
    let (normal_n, half) = (point.normal_inner_n, point.half_width_inner_m);
    let film = law.at(case.speed_m_s, normal_n);
    let friction = film.tangential_n / normal_n;
    let pressure = normal_n / (2.0 * half * law.contact.length_m);
    let flux_w_m2 = friction * pressure * case.speed_m_s;
    Some(SlipEffect {
        case,
        normal_n,
        friction,
        work_j: design.clutch.sprags.count as f64 * friction * normal_n * case.path_m,
        flux_w_m2,
        flash_k: flash_k(flux_w_m2, half, case.speed_m_s, case.path_m),
        peclet: peclet(half, case.speed_m_s, case.path_m / case.speed_m_s),
        sprag_m: sprag_wear_m2_per_n * film.asperities * pressure * case.path_m,
        race_m: race_wear_m2_per_n * film.asperities * pressure * case.path_m.min(2.0 * half),
    })
}
