//! The profile as it wears, fed back: torque, engagement angle, gap and lift-off over the hours and engagements of a life.
//!
//! In: a `Design` with oil, a life with overruns, its loads. Out: [`WornLife`]. Absent: a film that changes as the contact conforms (the
//! asperities' share is that of the drawn contact), wear of the contact that does not slide, of cage and springs.
//! Equations: Archard's V = k int N ds, of the load that asperities carry; Carter's creep.
//!
//! # Overrun
//! A sprag that rides on the inner race wears to the race's shape. What is left of it between the races is the drawn
//! sprag, turned on until it overlaps the track by d: the lens between profile and track is the volume worn,
//! V = (4/3) l sqrt(2 R) d^(3/2)
//! ([`flat_depth_m`]), 1/R = 1/r_i + 1/R_i, b = sqrt(2 R d) wide on either side. (As long as the sprag turns by less than R L/(2 r_i^2),
//! L = d(gap)/d(turn), each lens holds those before it.) Engaging, the sprag pivots over the front edge of that flat, b ahead of
//! where the drawn one would touch, until the contact has come to the tangent there: the angle of engagement is larger.
//! The edge is blunt by [`BLUNT`] of its arc, or [`super::BLUNT_BY_RADIUS`]. The track is worn alike all round.
//!
//! # Overrun in a cage
//! A cage carries the sprags with the inner race, and they wear to the outer one: 1/R = 1/r_e - 1/R_e, V and b as above. On the flat C_e is d
//! farther out, the sprag is one of the outer arc r_e - d about the same C_e: it turns on along the inner race, its spring relaxes,
//! and its pivot P goes outward, which the cage allows by its clearance and no more. Engaging, B goes back along the outer arc: the sprag
//! pivots over the edge of the flat, b behind, as one of an outer arc of that edge, until the contact has turned there by b/R
//! and is on the drawn arc: from that force on it carries what the drawn one carries. A force decides what sprag carries
//! it, not the way there (the paper's Figure 5), so either is a curve of its own.
//! A sprag that the cage or a film holds open slides farther ahead on its arc than where it touches when it engages. The flat counts
//! as if it were here, which is a bound: beside it less is missing, and its edge less far back.
//!
//! # Engagements
//! A contact that rolls ds under N creeps by xi ds, xi = 2 T/(pi E* l a) (Carter, small creep): each pass takes
//! k N xi/l off the sprag and, of a place of the track, as often as a sprag passes. Twice an engagement: up and back.
//! Over the path that is taken for a line in the turn, h_0 + h_1 t, by least squares: a parallel curve that is turned by
//! h_1, so arcs stay arcs.

use super::outline_worn::{BLUNT, Worn, blunt_of, worn_with};
use super::{Life, LifePlace, LoadEffect, contact_part, passes, walks_m};
use crate::clutch::{Clutch, Service};
use crate::design::Design;
use crate::lubrication::track_depth_m;
use crate::margin::{
    Capacities, LIFT_OFF_TO_RAD_S, LoadState, Margin, NoMargins, When, lift_off_rad_s, load_margins,
    load_state, overrun_at,
};
use crate::numeric::root;
use crate::wedge::{AtSpeeds, NoCurve, StaticPoint, WedgeCurve};
use std::borrow::Cow;
use std::f64::consts::PI;

/// Parts of the life at which the clutch is looked at, until a limit is broken.
const SHARES: [f64; 12] = [0.0, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0];
/// Steps of wear between two of them.
const STEPS: u32 = 16;
/// Places of the path of an engagement.
const PATH: u32 = 24;

/// Depths worn, m.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Wear {
    /// Volume that overrun has taken off one sprag, m^3.
    pub sprag_m3: f64,
    /// Track of the inner race, by overrun and engagements.
    pub inner_track_m: f64,
    /// Track of the outer race.
    pub outer_track_m: f64,
    /// Off the sprag's inner arcs by engagements: h_0, m, and h_1, m/rad of turn.
    pub inner_arcs_m: [f64; 2],
    /// Off its outer arc.
    pub outer_arc_m: f64,
}

impl Wear {
    fn plus(&self, rate: &Self, part: f64) -> Self {
        Self {
            sprag_m3: self.sprag_m3 + part * rate.sprag_m3,
            inner_track_m: self.inner_track_m + part * rate.inner_track_m,
            outer_track_m: self.outer_track_m + part * rate.outer_track_m,
            inner_arcs_m: std::array::from_fn(|i| self.inner_arcs_m[i] + part * rate.inner_arcs_m[i]),
            outer_arc_m: self.outer_arc_m + part * rate.outer_arc_m,
        }
    }
}

/// Why a clutch is none any more.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Broken {
    /// The sprags no longer span the gap, or have no profile left.
    Gap,
    /// To touch the outer race they would have to go farther out than their cage lets them.
    Cage,
    /// First contact or the largest load asks for more static friction than there is.
    Friction,
    /// First contact asks for more than the kinetic friction that a sliding contact has, where that is a limit.
    Bite,
    /// A sprag rolls over on the edge of its flat below the largest torque, before the contact has left the edge: what it does then is not
    /// followed.
    Edge,
    /// A limit of the file is reached below the largest torque of the life that it is held at.
    Torque,
    /// Sprags lift off below the speed to which contact is to be kept.
    LiftOff,
    /// The curve of the worn clutch was not found: a limit of the method, not of the clutch.
    Unknown,
}

impl Broken {
    /// Code and words.
    pub fn names(self) -> (&'static str, &'static str) {
        match self {
            Self::Gap => ("gap", "the sprags no longer span the gap"),
            Self::Cage => (
                "cage",
                "the cage keeps the sprags off the outer race: they would have to go farther out than its clearance lets them",
            ),
            Self::Friction => {
                ("friction", "the sprags ask for more static friction than there is: they slip")
            }
            Self::Bite => (
                "re-engagement",
                "after overrun the sprags bite no more: they ask for more than the kinetic friction",
            ),
            Self::Edge => ("edge", "the sprags roll over on the edge of their flat below the largest torque"),
            Self::Torque => {
                ("torque", "a limit is reached below the largest torque of the life that it is held at")
            }
            Self::LiftOff => {
                ("lift-off", "the sprags lift off below the speed to which contact is to be kept")
            }
            Self::Unknown => {
                ("unknown", "the curve of the worn clutch was not found, and what follows is not known")
            }
        }
    }
}

/// The clutch after a part of its life.
#[derive(Debug, Clone, PartialEq)]
pub struct WornState {
    /// Part of the life, pure number.
    pub share: f64,
    /// What has worn.
    pub wear: Wear,
    /// Depth of the flat, m.
    pub flat_m: f64,
    /// Half its width, m.
    pub half_flat_m: f64,
    /// By how much the gap has opened at the sprags: tracks, flat, arcs, m.
    pub opened_m: f64,
    /// tan omega at first contact.
    pub first_tan_omega: Option<f64>,
    /// Static friction that the largest load needs; `None`: not carried.
    pub required_friction: Option<f64>,
    /// Torque at which the required limit is reached that its loads come nearest to, N m, and its code; `None`: no limit has one.
    pub capacity: Option<(f64, String)>,
    /// Lift-off, rad/s of the race that carries the sprags round; `None`: contact is kept up to 60 000 turns a minute.
    pub lift_off_rad_s: Option<f64>,
    /// What is left of the clearance outside the pivot in the cage, m; `None` without one.
    pub clearance_m: Option<f64>,
    /// Force of one sprag where it slides in the first overrun of the life, N.
    pub normal_n: f64,
    /// Miner's sum of a whole life in this state, for each of [`LifePlace::contacts`]; `None` where no strength is given or a load is
    /// not carried.
    pub pitting: [Option<f64>; 4],
    /// Why it is no clutch any more.
    pub broken: Option<Broken>,
}

/// Wear over a life.
#[derive(Debug, Clone, PartialEq)]
pub struct WornLife {
    /// Hours of overrun in the life.
    pub hours: f64,
    /// States, until one is broken.
    pub states: Vec<WornState>,
    /// The part of the life after which it would be broken with an edge as sharp as [`BLUNT`], where it has
    /// [`super::BLUNT_BY_RADIUS`]: straight on through the lives with that and with one twice as blunt.
    pub sharp_share: Option<f64>,
    /// How far ahead of where a sprag touches when it engages it slides in the overrun in which that is farthest, as drawn, m; 0 without
    /// a cage.
    pub ahead_m: f64,
}

impl WornLife {
    /// Miner's sum over the life, or over as much of it as the clutch is one, for each of [`LifePlace::contacts`], from the states that it
    /// goes through, straight between them.
    pub fn pitting(&self) -> [Option<f64>; 4] {
        let within = || self.states.iter().filter(|s| s.share <= 1.0);
        std::array::from_fn(|i| {
            let sums: Vec<[f64; 2]> =
                within().map(|s| Some([s.share, s.pitting[i]?])).collect::<Option<_>>()?;
            Some(sums.windows(2).map(|w| 0.5 * (w[1][0] - w[0][0]) * (w[0][1] + w[1][1])).sum())
        })
    }

    /// The part of the life after which a limit is broken, and which; `None`: not within a hundred lives.
    pub fn broken(&self) -> Option<(f64, Broken)> {
        self.states.last().and_then(|s| Some((s.share, s.broken?)))
    }
}

/// What the march needs.
struct March<'a> {
    design: &'a Design,
    state: LoadState,
    /// Margins of the drawn clutch.
    rows: Vec<Margin>,
    service: &'a Service,
    life: &'a Life,
    /// Radius of the edge of a flat, as a part of that of its arc.
    blunt: f64,
    /// Of engagements, a whole life: it does not depend on the wear to first order.
    creep: Wear,
}

/// The sprags on the edge of a flat.
struct OnEdge {
    design: Design,
    state: LoadState,
    /// Torque at which the contact leaves it, N m; infinite where it does not.
    until_nm: f64,
}

/// Wear over the life of `design`; `None` where nothing is known to wear: without oil, or without an overrun in the life.
///
/// # Errors
/// [`NoMargins`] where the drawn clutch is none.
pub fn worn_life(design: &Design, service: &Service, life: &Life) -> Result<Option<WornLife>, NoMargins> {
    let blunt = blunt_of(&design.clutch);
    let Some(mut found) = worn_life_with(design, service, life, blunt)? else { return Ok(None) };
    if blunt != BLUNT
        && let Some((share, _)) = found.broken()
    {
        let blunter = worn_life_with(design, service, life, 2.0 * blunt)?.and_then(|w| w.broken());
        found.sharp_share = blunter.map(|(other, _)| share - (other - share) * (1.0 - BLUNT / blunt));
    }
    Ok(Some(found))
}

/// [`worn_life`] with an edge of the flat of radius `blunt`, as a part of that of its arc.
///
/// # Errors
/// [`NoMargins`] where the drawn clutch is none.
pub fn worn_life_with(
    design: &Design,
    service: &Service,
    life: &Life,
    blunt: f64,
) -> Result<Option<WornLife>, NoMargins> {
    if design.clutch.lubrication.is_none() || service.overruns.is_empty() {
        return Ok(None);
    }
    let state = load_state(design)?;
    let creep = creep(design, &state, &life.loads);
    let rows = load_margins(design, &design.limits, Capacities::Wanted, &state);
    let march = March { design, state, rows, service, life, blunt, creep };
    let hours = service.overruns.iter().map(|o| o.duration_s / 3600.0).sum();
    let (mut states, mut wear): (Vec<WornState>, _) = (Vec::new(), Wear::default());
    for share in SHARES {
        let from = states.last().map_or(0.0, |s| s.share);
        let before = wear;
        wear = march.on(wear, share - from);
        let now = march.state(share, &wear);
        if now.broken.is_none() {
            states.push(now);
            continue;
        }
        // Between the last two: the last share that holds.
        let (mut holds, mut breaks, mut last) = (from, share, now);
        for _ in 0..12 {
            let middle = 0.5 * (holds + breaks);
            let there = march.state(middle, &march.on(before, middle - from));
            if there.broken.is_some() {
                (breaks, last) = (middle, there);
            } else {
                holds = middle;
            }
        }
        states.push(last);
        break;
    }
    Ok(Some(WornLife { hours, states, sharp_share: None, ahead_m: march.ahead_m() }))
}

/// One state of `design` with `wear`, for who has that already; `share`: the part of the life it stands for.
///
/// # Errors
/// [`NoMargins`] where the drawn clutch is none.
pub fn worn_state(
    design: &Design,
    service: &Service,
    life: &Life,
    share: f64,
    wear: &Wear,
) -> Result<WornState, NoMargins> {
    let state = load_state(design)?;
    let creep = Wear::default();
    let rows = load_margins(design, &design.limits, Capacities::Wanted, &state);
    let blunt = blunt_of(&design.clutch);
    Ok(March { design, state, rows, service, life, blunt, creep }.state(share, wear))
}

impl March<'_> {
    /// `wear` after another `share` of the life: Archard's law in steps, each at the mean of the rates at its ends (Heun).
    fn on(&self, wear: Wear, share: f64) -> Wear {
        let part = share / f64::from(STEPS);
        let mut now = wear;
        for _ in 0..STEPS {
            let first = self.rate(&now);
            let second = self.rate(&now.plus(&first, part));
            now = now.plus(&first, 0.5 * part).plus(&second, 0.5 * part);
        }
        now
    }

    /// Design and state in which sprags `found` so worn overrun: the drawn ones with the spring relaxed, in a cage those on their flat.
    fn idle(&self, found: Option<&Worn>) -> Option<(Cow<'_, Design>, LoadState)> {
        let turned_rad = found.map_or(0.0, |worn| worn.turned_rad);
        let alpha_max_rad = self.state.alpha_max_rad - turned_rad;
        let Some(cage) = self.design.clutch.cage else {
            return Some((Cow::Borrowed(self.design), LoadState { alpha_max_rad, ..self.state.clone() }));
        };
        let outside = found?.outside.as_ref()?;
        if outside.seated.cage == Some(cage) && turned_rad == 0.0 {
            return Some((Cow::Borrowed(self.design), self.state.clone()));
        }
        let profile = outside.seated.profile().ok()?;
        // As far as overrun feels it.
        let curve = WedgeCurve::build_reaching(&outside.seated, &profile, 0.0, Some(0.0)).ok()?;
        let design = Design { clutch: outside.seated.clone(), ..self.design.clone() };
        Some((Cow::Owned(design), LoadState { profile, curve, alpha_max_rad, ..self.state.clone() }))
    }

    /// Speeds of the overruns, as of [`overrun_at`], and their durations, s.
    fn overruns(&self) -> impl Iterator<Item = ([f64; 2], f64)> {
        self.service.overruns.iter().filter_map(|overrun| {
            let scenario = self.design.scenario(&overrun.scenario)?;
            Some((scenario.kind.overrun_rad_s()?, overrun.duration_s))
        })
    }

    /// [`WornLife::ahead_m`].
    fn ahead_m(&self) -> f64 {
        if !self.design.clutch.slides_outside() {
            return 0.0;
        }
        let open_rad = self.overruns().filter_map(|([ahead, outer], _)| {
            let point = overrun_at(self.design, &self.state, outer, ahead).ok()?;
            (point.state.sliding_n > 0.0).then_some(-point.state.alpha_rad)
        });
        self.design.clutch.sprags.outer_radius_m * open_rad.fold(0.0, f64::max)
    }

    /// Wear in a whole life at the present rate.
    fn rate(&self, wear: &Wear) -> Wear {
        let Some(oil) = self.design.clutch.lubrication.as_ref() else { return Wear::default() };
        let found = worn_with(self.design, &self.state, wear, self.blunt);
        let mut rate = self.creep;
        let idle = found.as_ref().and_then(|worn| self.idle(Some(worn)));
        let Some((design, state)) = idle else { return rate };
        let clutch = &self.design.clutch;
        let track_m = clutch.sliding_track_m();
        for ([ahead, outer], duration_s) in self.overruns() {
            let Ok(point) = overrun_at(&design, &state, outer, ahead) else { continue };
            let Some(on_film) = point.lubricated.as_ref() else { continue };
            let path_m = ahead.abs() * track_m * duration_s;
            let rubbed = on_film.film.asperities * point.state.sliding_n * path_m;
            rate.sprag_m3 += oil.sprag_wear_m2_per_n * rubbed;
            let all = clutch.sprags.count as f64 * oil.race_wear_m2_per_n * rubbed;
            let track =
                if clutch.slides_outside() { &mut rate.outer_track_m } else { &mut rate.inner_track_m };
            *track += track_depth_m(all, track_m, clutch.contact_length_m());
        }
        rate
    }

    /// Largest torque of the life that a limit is held at, N m: one of the nominal torque allows what comes again and again, so the
    /// loads up to nominal torque count for it, all others for every load. `None`: no such load.
    fn asked_nm(&self, row: &Margin) -> Option<f64> {
        let nominal = self.design.limits.nominal_torque_nm.filter(|_| row.limit.when == When::Nominal);
        let most_nm = nominal.map_or(f64::INFINITY, |nm| nm * (1.0 + 1e-12));
        let counted = self.life.loads.iter().map(|load| load.torque_nm).filter(|nm| *nm <= most_nm);
        counted.reduce(f64::max).filter(|nm| *nm > 0.0)
    }

    /// The sprags of `worn` on the edge of their flat, otherwise in the state `of_worn`; `None` without a flat.
    fn on_edge(&self, worn: Worn, of_worn: &LoadState) -> Result<Option<OnEdge>, NoCurve> {
        let clutch = match worn.outside {
            None => (worn.flat_m[1] > 0.0).then_some((worn.clutch, None)),
            Some(outside) => outside.edge.map(|(clutch, turn_rad)| (clutch, Some(turn_rad))),
        };
        let Some((clutch, turn_rad)) = clutch else { return Ok(None) };
        let state = match turn_rad {
            None => of_worn.clone(),
            Some(_) => load_of_worn(&clutch, of_worn, &self.state.curve)?,
        };
        let curve = &state.curve;
        let torque_nm = |n: f64| curve.at_normal(n).map(|p| p.torque_nm);
        let until_nm = match turn_rad {
            None => torque_nm(curve.arc_end_n(0)).unwrap_or(0.0),
            Some(turn_rad) => {
                let left =
                    |n: f64| curve.closure_at_normal(n).map_or(f64::NAN, |(_, c)| c.rotation.v - turn_rad);
                let end = curve.arc_end_n(curve.arc_count() - 1);
                let leaves_n = root::bracketed(0.0, end, -turn_rad, left(end), 1e-12 * end, left);
                leaves_n.and_then(torque_nm).unwrap_or(f64::INFINITY)
            }
        };
        Ok(Some(OnEdge { design: Design { clutch, ..self.design.clone() }, state, until_nm }))
    }

    /// Miner's sums of a whole life in the state `worn` of the worn `design`. On the `edge` of a flat the contact there counts as pressed as
    /// in the drawn clutch under the same force. Outside, the walk begins where a sprag would touch without its flat: up to b too long.
    fn pitting(&self, design: &Design, worn: &LoadState, edge: Option<&OnEdge>) -> [Option<f64>; 4] {
        let mut sums = [Some(0.0); 4];
        for load in &self.life.loads {
            let edge = edge.filter(|edge| load.torque_nm <= edge.until_nm);
            let (design, worn) = edge.map_or((design, worn), |edge| (&edge.design, &edge.state));
            let p = worn.curve.at_torque(load.torque_nm).and_then(|p| {
                if edge.is_none() {
                    return Some(p);
                }
                let drawn = self.state.curve.at_normal(p.normal_inner_n)?;
                Some(match design.clutch.slides_outside() {
                    false => StaticPoint { hertz_inner_pa: drawn.hertz_inner_pa, ..p },
                    true => StaticPoint { hertz_outer_pa: drawn.hertz_outer_pa, ..p },
                })
            });
            let passes = p.map_or([0.0; 2], |p| passes(design, self.service, &p, walks_m(design, worn, &p)));
            for (sum, place) in sums.iter_mut().zip(LifePlace::contacts()) {
                let part = contact_part(design, self.service, p.as_ref(), place);
                *sum = sum.zip(part).map(|(sum, part)| sum + load.engagements * place.times(passes) * part);
            }
        }
        sums
    }

    fn state(&self, share: f64, wear: &Wear) -> WornState {
        let found = worn_with(self.design, &self.state, wear, self.blunt);
        let [flat_m, half_flat_m] = found.as_ref().map_or([0.0; 2], |w| w.flat_m);
        let clearance_m = found.as_ref().and_then(|w| Some(w.outside.as_ref()?.clearance_m));
        let idle = self.idle(found.as_ref());
        let point =
            self.overruns().next().zip(idle.as_ref()).and_then(|(([ahead, outer], _), (design, state))| {
                overrun_at(design, state, outer, ahead).ok()
            });
        let opened_m =
            wear.inner_track_m + wear.outer_track_m + flat_m + wear.inner_arcs_m[0] + wear.outer_arc_m;
        let mut state = WornState {
            share,
            wear: *wear,
            flat_m,
            half_flat_m,
            opened_m,
            first_tan_omega: None,
            required_friction: None,
            capacity: None,
            lift_off_rad_s: idle
                .as_ref()
                .and_then(|(design, state)| lift_off_rad_s(design, state, LIFT_OFF_TO_RAD_S)),
            clearance_m,
            normal_n: point.map_or(0.0, |p| p.state.sliding_n),
            pitting: [None; 4],
            broken: Some(Broken::Gap),
        };
        let Some((worn, (_, idle))) = found.zip(idle) else { return state };
        if clearance_m.is_some_and(|left_m| left_m < 0.0) {
            return WornState { broken: Some(Broken::Cage), ..state };
        }
        let design = Design { clutch: worn.clutch.clone(), ..self.design.clone() };
        let relaxed = LoadState { alpha_max_rad: idle.alpha_max_rad, ..self.state.clone() };
        let of_worn = match *wear == Wear::default() {
            true => Ok(relaxed),
            false => load_of_worn(&design.clutch, &relaxed, &self.state.curve),
        };
        let both = of_worn.and_then(|of_worn| Ok((self.on_edge(worn, &of_worn)?, of_worn)));
        let (edge, of_worn) = match both {
            Ok(both) => both,
            Err(NoCurve::NoConvergence) => return WornState { broken: Some(Broken::Unknown), ..state },
            Err(_) => return state,
        };
        let edge = edge.as_ref();
        let at_torque = |nm: f64| {
            let on = edge.filter(|edge| nm <= edge.until_nm).map_or(&of_worn, |edge| &edge.state);
            on.curve.at_torque(nm)
        };
        let rows = load_margins(&design, &design.limits, Capacities::Wanted, &of_worn);
        // On the edge of a flat the pressure is that of a radius which nobody knows: there a limit is reached at the
        // force of the drawn clutch.
        let capacity = |row: &Margin| {
            let nm = row.torque_capacity_nm?;
            let Some(edge) = edge.filter(|edge| nm <= edge.until_nm) else { return Some(nm) };
            let drawn = self.rows.iter().find(|drawn| drawn.code() == row.code())?.torque_capacity_nm?;
            let normal_n = self.state.curve.at_torque(drawn)?.normal_inner_n;
            Some(edge.state.curve.at_normal(normal_n)?.torque_nm)
        };
        // The part of its asked torque at which each limit is reached.
        let reached = rows.iter().filter(|r| r.required).filter_map(|row| {
            let (nm, asked_nm) = (capacity(row)?, self.asked_nm(row)?);
            Some((nm / asked_nm, (nm, row.code())))
        });
        let lowest = reached.min_by(|a, b| a.0.total_cmp(&b.0));
        let carries = lowest.as_ref().is_none_or(|(part, _)| *part >= 1.0);
        state.capacity = lowest.map(|(_, capacity)| capacity);
        let first_tan_omega = edge.map_or(of_worn.first_tan_omega, |edge| edge.state.first_tan_omega);
        state.first_tan_omega = Some(first_tan_omega);
        state.pitting = self.pitting(&design, &of_worn, edge);
        state.required_friction = at_torque(self.life.largest_nm).map(|p| p.required_friction());
        let asked = state.required_friction.unwrap_or(f64::INFINITY).max(first_tan_omega);
        let keep = self.design.limits.keep_contact_to_rad_s;
        let rolls = edge.is_some_and(|edge| {
            edge.until_nm.is_infinite() && edge.state.curve.end_torque_nm() < self.life.largest_nm
        });
        state.broken = if rolls && first_tan_omega <= self.design.clutch.friction.static_ {
            Some(Broken::Edge)
        } else if asked > self.design.clutch.friction.static_ {
            Some(Broken::Friction)
        } else if first_tan_omega > self.most_to_bite() {
            Some(Broken::Bite)
        } else if !carries {
            Some(Broken::Torque)
        } else if keep.zip(state.lift_off_rad_s).is_some_and(|(keep, at)| at < keep) {
            Some(Broken::LiftOff)
        } else {
            None
        };
        state
    }

    /// The most that first contact may ask for where sprags are to bite after overrun.
    fn most_to_bite(&self) -> f64 {
        let limit = self.rows.iter().find(|row| row.required && row.code() == "re-engagement");
        limit.map_or(f64::INFINITY, |row| row.allowable)
    }
}

/// The load state of a worn `clutch` whose spring is that of `idle`; its bodies give as those of the `drawn` curve.
fn load_of_worn(clutch: &Clutch, idle: &LoadState, drawn: &WedgeCurve) -> Result<LoadState, NoCurve> {
    let profile = clutch.profile().map_err(|_| NoCurve::NoFirstContact)?;
    let curve = WedgeCurve::build_with_body_of(clutch, &profile, drawn)?;
    let first_tan_omega = curve.touch().t_ratio;
    Ok(LoadState {
        profile,
        outline: None,
        curve,
        at_speeds: AtSpeeds::default(),
        first_tan_omega,
        alpha_max_rad: idle.alpha_max_rad,
        looks: None,
    })
}

/// What engagements of a whole life take by creep.
fn creep(design: &Design, state: &LoadState, loads: &[LoadEffect]) -> Wear {
    let clutch = &design.clutch;
    let Some(oil) = clutch.lubrication.as_ref() else { return Wear::default() };
    let length_m = clutch.contact_length_m();
    let elastic = &state.curve.statics().elastic;
    let (mut path, mut wear) = (Vec::new(), Wear::default());
    for load in loads {
        let Some(top) = load.state else { continue };
        // A contact rolls over a place once up and once back.
        let passes = 2.0 * load.engagements;
        let (mut outer_sum, mut inner_sum) = (0.0, 0.0);
        for i in 1..=PATH {
            let n = top.normal_inner_n * (f64::from(i) - 0.5) / f64::from(PATH);
            let Some(p) = state.curve.at_normal(n) else { continue };
            let depth = |normal_n: f64, tan: f64, half_m: f64, modulus_pa: f64| {
                normal_n / length_m * (2.0 * tan * normal_n / (PI * modulus_pa * length_m * half_m))
            };
            let inner =
                depth(n, p.tan_omega, p.half_width_inner_m, elastic.inner_contact[p.arc].contact_modulus_pa);
            let outside = &elastic.outer_contact;
            let outer = depth(
                p.normal_outer_n,
                p.tan_nu,
                outside.half_width_m(p.normal_outer_n),
                outside.contact_modulus_pa,
            );
            path.push([p.contact_turn_rad, passes * oil.sprag_wear_m2_per_n * inner]);
            (inner_sum, outer_sum) =
                (inner_sum + inner / f64::from(PATH), outer_sum + outer / f64::from(PATH));
        }
        wear.outer_arc_m += passes * oil.sprag_wear_m2_per_n * outer_sum;
        wear.inner_track_m += passes * load.passes[0] * oil.race_wear_m2_per_n * inner_sum;
        wear.outer_track_m += passes * load.passes[1] * oil.race_wear_m2_per_n * outer_sum;
    }
    // Depths of loads add up where their paths lie on one another: the line through the path of each, summed.
    for of_load in path.chunks(PATH as usize) {
        let [h_0, h_1] = line(of_load);
        wear.inner_arcs_m = [wear.inner_arcs_m[0] + h_0, wear.inner_arcs_m[1] + h_1];
    }
    wear
}

/// Least squares y = a + b x through points [x, y].
fn line(points: &[[f64; 2]]) -> [f64; 2] {
    let n = points.len() as f64;
    let [x, y] = [0, 1].map(|i| points.iter().map(|p| p[i]).sum::<f64>() / n);
    let (xx, xy) =
        points.iter().fold((0.0, 0.0), |(xx, xy), p| (xx + (p[0] - x).powi(2), xy + (p[0] - x) * (p[1] - y)));
    let slope = if xx > 0.0 { xy / xx } else { 0.0 };
    [y - slope * x, slope]
}
