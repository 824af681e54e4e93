//! The profile as it wears, fed back: torque, engagement angle, gap and lift-off over the hours and engagements of a life.
//!
//! In: a `Design` with oil, a life with overruns, its loads. Out: [`WornLife`]. Absent: a film that changes as the contact conforms (the
//! asperities' share is that of the drawn contact), wear of the contact at B in overrun, where sprags ride with the outer race.
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
//! # Engagements
//! A contact that rolls ds under N creeps by xi ds, xi = 2 T/(pi E* l a) (Carter, small creep): each pass takes
//! k N xi/l off the sprag and, of a place of the track, as often as a sprag passes. Twice an engagement: up and back.
//! Over the path that is taken for a line in the turn, h_0 + h_1 t, by least squares: a parallel curve that is turned by
//! h_1, so arcs stay arcs.

use super::outline_worn::{BLUNT, blunt_of, worn_with};
use super::{Life, LifePlace, LoadEffect, contact_part, passes, walks_m};
use crate::clutch::Service;
use crate::design::Design;
use crate::lubrication::track_depth_m;
use crate::margin::{
    Capacities, LIFT_OFF_TO_RAD_S, LoadState, Margin, NoMargins, When, lift_off_rad_s, load_margins,
    load_state, overrun_at,
};
use crate::wedge::{AtSpeeds, NoCurve, StaticPoint, WedgeCurve};
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
    /// First contact or the largest load asks for more static friction than there is.
    Friction,
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
            Self::Friction => {
                ("friction", "the sprags ask for more static friction than there is: they slip")
            }
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
    /// Lift-off of the outer race, rad/s; `None`: contact is kept up to 60 000 turns a minute.
    pub lift_off_rad_s: Option<f64>,
    /// Normal force of one sprag in the first overrun of the life, N.
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
    Ok(Some(WornLife { hours, states, sharp_share: None }))
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

    /// The state of the drawn sprags with the spring relaxed by `turned_rad`.
    fn relaxed(&self, turned_rad: f64) -> LoadState {
        LoadState { alpha_max_rad: self.state.alpha_max_rad - turned_rad, ..self.state.clone() }
    }

    /// Wear in a whole life at the present rate.
    fn rate(&self, wear: &Wear) -> Wear {
        let Some(oil) = self.design.clutch.lubrication.as_ref() else { return Wear::default() };
        let found = worn_with(self.design, &self.state, wear, self.blunt);
        let turned_rad = found.map_or(f64::INFINITY, |w| w.turned_rad);
        let relaxed = self.relaxed(turned_rad.min(PI));
        let clutch = &self.design.clutch;
        let mut rate = self.creep;
        for overrun in &self.service.overruns {
            let scenario = self.design.scenario(&overrun.scenario);
            let Some([ahead, outer]) = scenario.and_then(|s| s.kind.overrun_rad_s()) else { continue };
            let Ok(point) = overrun_at(self.design, &relaxed, outer, ahead) else { continue };
            let Some(on_film) = point.lubricated.as_ref() else { continue };
            let path_m = ahead.abs() * clutch.races.inner_radius_m * overrun.duration_s;
            let rubbed = on_film.film.asperities * point.state.normal_inner_n * path_m;
            rate.sprag_m3 += oil.sprag_wear_m2_per_n * rubbed;
            let all = clutch.sprags.count as f64 * oil.race_wear_m2_per_n * rubbed;
            rate.inner_track_m += track_depth_m(all, clutch.races.inner_radius_m, clutch.contact_length_m());
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

    /// Torque at which the contact leaves the edge of a flat, N m.
    fn leaves_edge_nm(&self, worn: &LoadState) -> f64 {
        worn.curve.at_normal(worn.curve.arc_end_n(0)).map_or(0.0, |p| p.torque_nm)
    }

    /// Miner's sums of a whole life in the state `worn` of the worn `design`. On the edge of a flat, up to `on_edge_nm`, the inner contact
    /// counts as pressed as in the drawn clutch under the same force.
    fn pitting(&self, design: &Design, worn: &LoadState, on_edge_nm: f64) -> [Option<f64>; 4] {
        let mut sums = [Some(0.0); 4];
        for load in &self.life.loads {
            let p = worn.curve.at_torque(load.torque_nm).and_then(|p| {
                let on_edge = load.torque_nm <= on_edge_nm;
                let drawn = if on_edge { self.state.curve.at_normal(p.normal_inner_n)? } else { p };
                Some(StaticPoint { hertz_inner_pa: drawn.hertz_inner_pa, ..p })
            });
            let passes = p.map_or([0.0; 2], |p| passes(design, self.service, &p, walks_m(design, worn, &p)));
            for (sum, place) in sums.iter_mut().zip(LifePlace::contacts()) {
                let part = contact_part(self.service, p.as_ref(), place);
                *sum = sum.zip(part).map(|(sum, part)| sum + load.engagements * place.times(passes) * part);
            }
        }
        sums
    }

    fn state(&self, share: f64, wear: &Wear) -> WornState {
        let found = worn_with(self.design, &self.state, wear, self.blunt);
        let turned_rad = found.as_ref().map_or(0.0, |w| w.turned_rad);
        let [flat_m, half_flat_m] = found.as_ref().map_or([0.0; 2], |w| w.flat_m);
        let relaxed = self.relaxed(turned_rad);
        let first = self
            .service
            .overruns
            .first()
            .and_then(|o| self.design.scenario(&o.scenario)?.kind.overrun_rad_s());
        let point = first.and_then(|[ahead, outer]| overrun_at(self.design, &relaxed, outer, ahead).ok());
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
            lift_off_rad_s: lift_off_rad_s(self.design, &relaxed, LIFT_OFF_TO_RAD_S),
            normal_n: point.map_or(0.0, |p| p.state.normal_inner_n),
            pitting: [None; 4],
            broken: Some(Broken::Gap),
        };
        let Some(worn) = found else { return state };
        let design = Design { clutch: worn.clutch, ..self.design.clone() };
        let of_worn = match load_of_worn(&design, &relaxed, *wear == Wear::default()) {
            Ok(of_worn) => of_worn,
            Err(NoCurve::NoConvergence) => return WornState { broken: Some(Broken::Unknown), ..state },
            Err(_) => return state,
        };
        let rows = load_margins(&design, &design.limits, Capacities::Wanted, &of_worn);
        // On the edge of a flat the pressure is that of a radius which nobody knows: there a limit is reached at the
        // force of the drawn clutch.
        let on_edge_nm = if half_flat_m > 0.0 { self.leaves_edge_nm(&of_worn) } else { 0.0 };
        let capacity = |row: &Margin| {
            let nm = row.torque_capacity_nm?;
            if nm > on_edge_nm {
                return Some(nm);
            }
            let drawn = self.rows.iter().find(|drawn| drawn.code() == row.code())?.torque_capacity_nm?;
            let normal_n = self.state.curve.at_torque(drawn)?.normal_inner_n;
            Some(of_worn.curve.at_normal(normal_n)?.torque_nm)
        };
        // The part of its asked torque at which each limit is reached.
        let reached = rows.iter().filter(|r| r.required).filter_map(|row| {
            let (nm, asked_nm) = (capacity(row)?, self.asked_nm(row)?);
            Some((nm / asked_nm, (nm, row.code())))
        });
        let lowest = reached.min_by(|a, b| a.0.total_cmp(&b.0));
        let carries = lowest.as_ref().is_none_or(|(part, _)| *part >= 1.0);
        state.capacity = lowest.map(|(_, capacity)| capacity);
        state.first_tan_omega = Some(of_worn.first_tan_omega);
        state.pitting = self.pitting(&design, &of_worn, on_edge_nm);
        let largest_nm = self.life.largest_nm;
        state.required_friction = of_worn.curve.at_torque(largest_nm).map(|p| p.required_friction());
        let asked = state.required_friction.unwrap_or(f64::INFINITY).max(of_worn.first_tan_omega);
        let keep = self.design.limits.keep_contact_to_rad_s;
        state.broken = if asked > self.design.clutch.friction.static_ {
            Some(Broken::Friction)
        } else if !carries {
            Some(Broken::Torque)
        } else if keep.zip(state.lift_off_rad_s).is_some_and(|(keep, at)| at < keep) {
            Some(Broken::LiftOff)
        } else {
            None
        };
        state
    }
}

/// The load state of a worn `design`: what its body gives is that of the drawn one. `drawn`: nothing has worn.
fn load_of_worn(design: &Design, drawn_state: &LoadState, drawn: bool) -> Result<LoadState, NoCurve> {
    if drawn {
        return Ok(drawn_state.clone());
    }
    let profile = design.clutch.profile().map_err(|_| NoCurve::NoFirstContact)?;
    let curve = WedgeCurve::build_with_body_of(&design.clutch, &profile, &drawn_state.curve)?;
    let first_tan_omega = curve.touch().t_ratio;
    Ok(LoadState {
        profile,
        outline: None,
        curve,
        at_speeds: AtSpeeds::default(),
        first_tan_omega,
        alpha_max_rad: drawn_state.alpha_max_rad,
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
