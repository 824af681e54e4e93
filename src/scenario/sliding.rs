//! Steady overrun as it is: friction by (12), or by the film at the temperature of its heat balance.

use super::prepare::sliding_friction;
use crate::clutch::{Clutch, Lubrication, Scenario, Sprags};
use crate::dynamics::{
    Overrun, SlidingContact, Swing, overrun_in_cage, overrun_under, swing_in_cage,
    swing_in_cage_with_friction, swing_on_film, swing_with_friction,
};
use crate::friction::{FilmFriction, FilmState};
use crate::lubrication::{FilmContact, Heat, Network, moving_strip, squeeze_out_s, standing_strip};
use crate::numeric::root;
use crate::profile::Profile;
use crate::wedge::{NoCurve, WedgeCurve};
use std::borrow::Cow;
use std::f64::consts::PI;

/// Steady overrun with what lubricates it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sliding {
    /// Forces of one sprag, and the drag of all.
    pub state: Overrun,
    /// Friction coefficient of the contact that slides; (12)'s where it is open.
    pub friction: f64,
    /// That contact on its film; `None` without `[lubrication]` and where it is open.
    pub lubricated: Option<Lubricated>,
}

/// The sliding contact on its film, and where its heat goes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lubricated {
    /// Its law at that temperature.
    pub law: FilmFriction,
    /// The film.
    pub film: FilmState,
    /// Temperature of the film, C.
    pub film_c: f64,
    /// Where the heat goes.
    pub heat: Heat,
}

/// Heat that goes from a wetted steel surface to oil that splashes, W/(m^2 K): an estimate, 50 in mist to 1000 in a jet.
const TO_OIL_W_PER_M2_K: f64 = 200.0;

/// The sprags of `clutch` on `curve`, which is that of the outer race's speed, the inner race ahead by `ahead_rad_s`. In a cage that
/// the inner race drives, the curve is that of weightless sprags, as of [`overrun_in_cage`].
pub fn sliding(clutch: &Clutch, curve: &WedgeCurve, alpha_max_rad: f64, ahead_rad_s: f64) -> Sliding {
    let sliding_rad_s = ahead_rad_s.abs();
    let by_law = sliding_friction(clutch, sliding_rad_s);
    let lubricated = clutch.lubrication.as_ref().and_then(|lubrication| {
        let steady = Steady { clutch, lubrication, curve, alpha_max_rad, ahead_rad_s };
        steady.at(steady.balanced_c()?)
    });
    match lubricated {
        Some((state, lubricated)) => {
            let friction = if clutch.slides_outside() { state.tan_outer } else { state.tan_inner };
            Sliding { state, friction, lubricated: Some(lubricated) }
        }
        None => {
            let state =
                steady_under(clutch, curve, alpha_max_rad, ahead_rad_s, |_| SlidingContact::dry(by_law));
            Sliding { state, friction: by_law, lubricated: None }
        }
    }
}

/// A curve as far as overrun feels it, the first contact at that speed of the outer race; in a driven cage without the sprags' weight,
/// whose force is that of another speed.
///
/// # Errors
/// [`NoCurve`].
pub fn touch(clutch: &Clutch, profile: &Profile, outer_rad_s: f64) -> Result<WedgeCurve, NoCurve> {
    let clutch = match clutch.cage {
        Some(_) if outer_rad_s != 0.0 => {
            let sprags = Sprags { mass_kg: 0.0, ..clutch.sprags.clone() };
            Cow::Owned(Clutch { sprags, ..clutch.clone() })
        }
        _ => Cow::Borrowed(clutch),
    };
    WedgeCurve::build_reaching(&clutch, profile, outer_rad_s, Some(0.0))
}

/// The equilibrium whose contact slides so under its load; arguments as of [`sliding()`].
pub(super) fn steady_under(
    clutch: &Clutch,
    curve: &WedgeCurve,
    alpha_max_rad: f64,
    ahead_rad_s: f64,
    friction: impl Fn(f64) -> SlidingContact,
) -> Overrun {
    match &clutch.cage {
        Some(cage) => {
            let cage_rad_s = curve.speed_rad_s() + ahead_rad_s;
            overrun_in_cage(clutch, cage, curve, alpha_max_rad, cage_rad_s, friction)
        }
        None => overrun_under(clutch, curve, alpha_max_rad, friction),
    }
}

/// Speed of a driven cage, rad/s, and at which B slides in it, m/s; arguments as of [`sliding()`].
fn in_cage(clutch: &Clutch, curve: &WedgeCurve, ahead_rad_s: f64) -> [f64; 2] {
    [curve.speed_rad_s() + ahead_rad_s, ahead_rad_s.abs() * clutch.sliding_track_m()]
}

impl Sliding {
    /// The small swing about it; arguments as of [`sliding()`].
    pub fn swing(
        &self,
        clutch: &Clutch,
        curve: &WedgeCurve,
        alpha_max_rad: f64,
        ahead_rad_s: f64,
    ) -> Option<Swing> {
        let film = self.lubricated.as_ref().map(|l| &l.law);
        swing_about(&self.state, clutch, curve, alpha_max_rad, ahead_rad_s, film)
    }
}

/// The small swing about `steady`; arguments as of [`sliding()`].
pub(super) fn swing_about(
    steady: &Overrun,
    clutch: &Clutch,
    curve: &WedgeCurve,
    alpha_max_rad: f64,
    ahead_rad_s: f64,
    film: Option<&FilmFriction>,
) -> Option<Swing> {
    if clutch.slides_outside() {
        let speeds = in_cage(clutch, curve, ahead_rad_s);
        return swing_in_cage(clutch, curve, alpha_max_rad, steady, speeds, film);
    }
    swing_on_film(clutch, curve, alpha_max_rad, steady, ahead_rad_s.abs(), film)
}

impl Lubricated {
    /// The small swing with the film's friction alone, without what its thickness does; arguments as of [`Sliding::swing`].
    pub fn swing_by_friction(
        &self,
        steady: &Overrun,
        clutch: &Clutch,
        curve: &WedgeCurve,
        alpha_max_rad: f64,
        ahead_rad_s: f64,
    ) -> Option<Swing> {
        if clutch.slides_outside() {
            let speeds = in_cage(clutch, curve, ahead_rad_s);
            return swing_in_cage_with_friction(clutch, curve, alpha_max_rad, steady, speeds, &self.law);
        }
        swing_with_friction(clutch, curve, alpha_max_rad, steady, ahead_rad_s.abs(), Some(&self.law))
    }
}

/// A film that the force of an overrun squeezes out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SqueezedOut {
    /// That force, of one sprag at A, N.
    pub normal_n: f64,
    /// Thickness of the film in the overrun, m.
    pub thickness_m: f64,
    /// Time down to the roughness, s; 0: it is thinner from the start.
    pub time_s: f64,
}

/// The film at A of a scene that begins in overrun, `start`, once nothing slides any more; `None` without one, as in a driven cage.
pub fn squeezed_out(scenario: &Scenario, start: &Overrun) -> Option<SqueezedOut> {
    let clutch = Some(&scenario.clutch).filter(|clutch| !clutch.slides_outside())?;
    let law = FilmFriction::of(clutch, clutch.lubrication.as_ref()?.temperature_c)?;
    let [ahead, _] = Some(&scenario.kind).filter(|kind| !kind.is_overrun())?.overrun_rad_s()?;
    let normal_n = Some(start.normal_inner_n).filter(|n| *n > 0.0)?;
    let thickness_m = law.at(ahead.abs() * clutch.races.inner_radius_m, normal_n).film.thickness_m;
    let time_s = squeeze_out_s(&law.contact, &law.fluid, thickness_m, law.roughness_m, normal_n);
    Some(SqueezedOut { normal_n, thickness_m, time_s })
}

/// A lubricated overrun whose temperature is looked for.
struct Steady<'a> {
    clutch: &'a Clutch,
    lubrication: &'a Lubrication,
    curve: &'a WedgeCurve,
    alpha_max_rad: f64,
    ahead_rad_s: f64,
}

impl Steady<'_> {
    fn sliding_rad_s(&self) -> f64 {
        self.ahead_rad_s.abs()
    }

    /// With the film at `film_c`; `None` where the contact is open.
    fn at(&self, film_c: f64) -> Option<(Overrun, Lubricated)> {
        let law = FilmFriction::in_overrun(self.clutch, film_c)?;
        let speed = self.sliding_rad_s() * self.clutch.sliding_track_m();
        let state = steady_under(self.clutch, self.curve, self.alpha_max_rad, self.ahead_rad_s, |n| {
            SlidingContact::on(&law, speed, n)
        });
        if state.sliding_n <= 0.0 {
            return None;
        }
        let film = law.at(speed, state.sliding_n);
        let network = self.network(&law, &state);
        let drag_w = state.drag_torque_nm * self.sliding_rad_s();
        let heat = network.solve(drag_w, self.slips_w(), self.lubrication.temperature_c)?;
        let heat = if self.clutch.slides_outside() { heat.inside_out() } else { heat };
        Some((state, Lubricated { law, film, film_c, heat }))
    }

    /// Heat of slips at A into the bodies of [`Network`], W: half of it into the sprags and half into the inner race, of one steel and
    /// under one flash. Where B slides that race is the farther one.
    fn slips_w(&self) -> [f64; 3] {
        let half_w = 0.5 * self.lubrication.slip_heat_w;
        if self.clutch.slides_outside() { [0.0, half_w, half_w] } else { [half_w, half_w, 0.0] }
    }

    /// Temperature of the film, C: the mean of the bodies beside it, where what they reach is what the film was taken to have.
    /// `None` where the contact is open.
    fn balanced_c(&self) -> Option<f64> {
        let oil_c = self.lubrication.temperature_c;
        let left = |film_c: f64| {
            self.at(film_c).map_or(oil_c - film_c, |(_, l)| {
                let t = l.heat.temperatures;
                let race = if self.clutch.slides_outside() { t.outer_race } else { t.inner_race };
                0.5 * (race + t.sprags) - film_c
            })
        };
        self.at(oil_c)?;
        if !self.lubrication.heat_balance {
            return Some(oil_c);
        }
        let at_oil = left(oil_c);
        if at_oil <= 0.0 {
            return Some(oil_c);
        }
        // Warmer oil drags less, or at most as its asperities do.
        let high = (0..40).map(|i| oil_c + at_oil * 1.5f64.powi(i)).find(|&c| left(c) <= 0.0)?;
        root::bracketed(oil_c, high, at_oil, left(high), 1e-11 * high.abs().max(1.0), left)
    }

    /// Conductances: those of the file, the others by the surfaces of plain rings; contacts as strips as wide as they are flattened, or
    /// wetted where that is more. Where B slides, both races stand for each other.
    fn network(&self, law: &FilmFriction, state: &Overrun) -> Network {
        let Clutch { races, sprags, .. } = self.clutch;
        let outside = self.clutch.slides_outside();
        let speed = self.sliding_rad_s() * self.clutch.sliding_track_m();
        let film = law.at(speed, state.sliding_n).film;
        let contact = &law.contact;
        let wetted = (2.0 * contact.radius_m * film.thickness_m).sqrt();
        let half = contact.half_width_m(state.sliding_n).hypot(wetted);
        let of_a = || FilmFriction::of(self.clutch, self.lubrication.temperature_c).map(|law| law.contact);
        let (other, pressed_n, far) = match outside.then(of_a).flatten() {
            Some(a) => (a, state.normal_inner_n, a.radius_m),
            None => {
                let b = FilmContact { radius_m: FilmFriction::outer_radius_m(self.clutch), ..*contact };
                (b, state.normal_outer_n, sprags.outer_radius_m)
            }
        };
        let other_half = other.half_width_m(pressed_n).max(1e-6);
        let count = sprags.count as f64;
        let length = count * contact.length_m;
        let ring = |r: f64, far: f64| {
            2.0 * PI * (r * races.width_m + (r * r - far * far).abs() + far * races.width_m)
        };
        let areas = [
            ring(races.inner_radius_m, races.inner_bore_radius_m),
            2.0 * count * sprags.length_m * (races.outer_radius_m - races.inner_radius_m),
            ring(races.outer_radius_m, races.outer_outside_radius_m),
        ];
        let given = self.lubrication.to_oil_w_per_k;
        let to_oil = |i: usize| given[i].unwrap_or(TO_OIL_W_PER_M2_K * areas[i]);
        let mut to_oil: [f64; 3] = std::array::from_fn(to_oil);
        if outside {
            to_oil.reverse();
        }
        Network {
            into_race: moving_strip(length, half, speed).max(1e-9),
            into_sprags: standing_strip(length, half, contact.radius_m),
            through_outer: 0.5 * standing_strip(length, other_half, far),
            to_oil,
        }
    }
}
