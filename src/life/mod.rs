//! What clutches fail of in time: pitting of contacts, fatigue of rings and sprags, indentation by a single load, slip by chance.
//!
//! In: a `Design` with its [`Service`], and its static curve. Out: [`Life`]: each load with what it does, each place with the
//! part of its life that is used up; wear in overrun and by slips, and the clutch as it wears. Absent: dynamics (torques are as given).
//! Equations: Miner's sum, the power laws of [`crate::clutch::PittingStrength`] and [`crate::clutch::FatigueStrength`], Goodman's mean stress.
//!
//! An engagement presses each sprag once along the path that its contact walks, always the same path: the sprag has one load
//! cycle an engagement. A place of a track is met only where a sprag stands: n_s (walk + 2 a)/(2 pi R) times an engagement
//! in the mean where sprags come to stand anywhere. The pressure of a cycle is the largest, that at the torque. The stress of a
//! ring swings from that at the least to that at the largest torque of a cycle, from that of the fit at rest on, bending between the
//! sprags included: as if the worst place were the same each time. The body of a sprag swings so at either flank of its narrowest
//! section, pressed by the strut force and bent by it.

pub mod count;
mod outline_worn;
pub mod slip;
mod wear;
mod worn;

pub use outline_worn::{BLUNT, BLUNT_BY_RADIUS, Worn, WornOutside, worn};
pub use wear::{HourlyWear, SlipEffect, hourly_wear, slip_effect};
pub use worn::{Broken, Wear, WornLife, WornState, worn_life, worn_life_with, worn_state};

use crate::clutch::{CoreStrength, FatigueStrength, PittingStrength, Service};
use crate::design::Design;
use crate::margin::{LoadState, NoMargins, body_flanks_pa, load_state, ring_places_pa, rings_pa, shear_in};
use crate::wedge::StaticPoint;
use count::{engagements, rainflow, turning_points};
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Largest pressure of line contacts at which the permanent indentation of both bodies together is 1e-4 of the roller's
/// diameter, Pa, hardness at least 58 HRC: ISO 76:2006, roller bearings.
pub const INDENTING_PA: f64 = 4.0e9;

/// Classes of torque that histories are counted in, each counted at its upper edge: pressures come out at most half a
/// hundredth too high.
const CLASSES: usize = 100;

/// Where a life is used up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LifePlace {
    /// Sprag, at its contact with the inner race.
    SpragInside,
    /// Sprag, at its contact with the outer race.
    SpragOutside,
    /// Track of the inner race.
    InnerTrack,
    /// Track of the outer race.
    OuterTrack,
    /// Core of the sprag below its case, at its contact with the inner race.
    SpragCoreInside,
    /// Core of the sprag below its case, at its contact with the outer race.
    SpragCoreOutside,
    /// Core of the inner race below its case.
    InnerCore,
    /// Core of the outer race below its case.
    OuterCore,
    /// Inner race as a ring.
    InnerRing,
    /// Outer race as a ring.
    OuterRing,
    /// Sprag, half way between its contacts.
    SpragBody,
}

impl LifePlace {
    /// All, contacts first.
    pub const ALL: [Self; 11] = [
        Self::SpragInside,
        Self::SpragOutside,
        Self::InnerTrack,
        Self::OuterTrack,
        Self::SpragCoreInside,
        Self::SpragCoreOutside,
        Self::InnerCore,
        Self::OuterCore,
        Self::InnerRing,
        Self::OuterRing,
        Self::SpragBody,
    ];

    /// The surfaces that contacts press, in the order of [`Self::ALL`].
    pub fn contacts() -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().filter(|place| place.is_contact() && !place.is_core())
    }

    /// Whether it lies below a hardened case.
    pub fn is_core(self) -> bool {
        matches!(self, Self::SpragCoreInside | Self::SpragCoreOutside | Self::InnerCore | Self::OuterCore)
    }

    /// Whether a contact is pressed there; else a body swings between two stresses.
    pub fn is_contact(self) -> bool {
        !matches!(self, Self::InnerRing | Self::OuterRing | Self::SpragBody)
    }

    fn is_inside(self) -> bool {
        matches!(self, Self::SpragInside | Self::InnerTrack | Self::SpragCoreInside | Self::InnerCore)
    }

    /// Contacts in one engagement, of those that places of the tracks see.
    fn times(self, passes: [f64; 2]) -> f64 {
        match self {
            Self::InnerTrack | Self::InnerCore => passes[0],
            Self::OuterTrack | Self::OuterCore => passes[1],
            _ => 1.0,
        }
    }

    /// Code and words.
    pub fn names(self) -> (&'static str, &'static str) {
        match self {
            Self::SpragInside => ("pitting-sprag-inside", "pitting of the sprags, inner contact"),
            Self::SpragOutside => ("pitting-sprag-outside", "pitting of the sprags, outer contact"),
            Self::InnerTrack => ("pitting-inner-track", "pitting of the inner race"),
            Self::OuterTrack => ("pitting-outer-track", "pitting of the outer race"),
            Self::SpragCoreInside => {
                ("core-sprag-inside", "fatigue of the sprags below the case, inner contact")
            }
            Self::SpragCoreOutside => {
                ("core-sprag-outside", "fatigue of the sprags below the case, outer contact")
            }
            Self::InnerCore => ("core-inner-race", "fatigue of the inner race below the case"),
            Self::OuterCore => ("core-outer-race", "fatigue of the outer race below the case"),
            Self::InnerRing => ("fatigue-inner-ring", "fatigue of the inner race as a ring"),
            Self::OuterRing => ("fatigue-outer-ring", "fatigue of the outer race as a ring"),
            Self::SpragBody => ("fatigue-sprag-body", "fatigue of the sprags' bodies"),
        }
    }
}

/// A load and what one engagement at it does.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadEffect {
    /// Torque, N m.
    pub torque_nm: f64,
    /// Engagements in the life.
    pub engagements: f64,
    /// The static state; `None`: the clutch does not carry this torque.
    pub state: Option<StaticPoint>,
    /// Hoop stress of inner and outer race with bending, Pa, magnitudes; 0 where not carried.
    pub hoop_pa: [f64; 2],
    /// What the contact walks on the sprag and on the race from first contact on, inner and outer, m.
    pub walk_m: [f64; 2],
    /// Contacts that a place of the track sees in one engagement, inner and outer track.
    pub passes: [f64; 2],
    /// Static friction that holds this torque, the larger of both contacts; `None`: the clutch does not carry it.
    pub required_friction: Option<f64>,
    /// Probability of slip; `None` where friction has no scatter.
    pub slip: Option<f64>,
}

/// How much of a place's life is used up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Used {
    /// Where.
    pub place: LifePlace,
    /// Miner's sum over the life asked for, 1 or less being held; `None` where the strength is not given.
    pub sum: Option<f64>,
    /// Cycles in the life.
    pub cycles: f64,
    /// Torque of the load that uses up most, N m.
    pub mostly_nm: f64,
}

impl Used {
    /// How often the life asked for fits in; infinite where nothing is used up.
    pub fn lives(&self) -> Option<f64> {
        self.sum.map(|sum| if sum > 0.0 { 1.0 / sum } else { f64::INFINITY })
    }

    /// Whether it is used up before the end of the life; not where its strength is not given.
    pub fn is_up(&self) -> bool {
        self.sum.is_some_and(|sum| sum > 1.0)
    }
}

/// All of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Life {
    /// Loads by torque, falling; those of histories in classes.
    pub loads: Vec<LoadEffect>,
    /// Each place.
    pub used: Vec<Used>,
    /// Largest torque, N m.
    pub largest_nm: f64,
    /// By what a single load may exceed the largest until it indents, load over load: (4000 MPa/p_0)^2, inner and outer contact.
    pub indentation: [f64; 2],
    /// Peak torque of the limits, N m, where it is above every load, and whether it would indent a contact.
    pub peak_beyond: Option<(f64, bool)>,
    /// Slips that are expected in the life.
    pub slips: Option<f64>,
    /// How many of them are allowed; `None`: nobody has said.
    pub slips_allowed: Option<f64>,
    /// Engagements in the life.
    pub engagements: f64,
    /// Mean static friction.
    pub friction: f64,
}

impl Life {
    /// Whether the clutch carries every load without slip, friction and torque at their means, no load indents a contact, every
    /// known life is long enough, and no more slips are expected than are allowed.
    pub fn held(&self) -> bool {
        self.loads.iter().all(|l| l.state.is_some())
            && self.slipping().is_none()
            && !self.indents()
            && !self.slips_too_often()
            && !self.used.iter().any(Used::is_up)
    }

    /// Whether the largest load indents a contact.
    pub fn indents(&self) -> bool {
        self.indentation.iter().any(|factor| *factor < 1.0)
    }

    /// Whether more slips are expected than are allowed.
    pub fn slips_too_often(&self) -> bool {
        self.slips.zip(self.slips_allowed).is_some_and(|(expected, allowed)| expected > allowed)
    }

    /// Places whose life is not known, because no strength of theirs is given or a load is not carried.
    pub fn not_known(&self) -> impl Iterator<Item = LifePlace> {
        self.used.iter().filter(|u| u.sum.is_none()).map(|u| u.place)
    }

    /// The largest load that slips with friction and torque at their means.
    pub fn slipping(&self) -> Option<&LoadEffect> {
        self.loads.iter().find(|l| l.required_friction.is_some_and(|needed| needed > self.friction))
    }

    /// The place whose life is used up most.
    pub fn decides(&self) -> Option<&Used> {
        self.used
            .iter()
            .filter(|u| u.sum.is_some())
            .max_by(|a, b| a.sum.unwrap_or(0.0).total_cmp(&b.sum.unwrap_or(0.0)))
    }
}

/// The life of `design` in `service`; its swings left out, which are loads once the torques between which they swing are known.
///
/// # Errors
/// [`NoMargins`] where there is no clutch to speak of.
pub fn life(design: &Design, service: &Service) -> Result<Life, NoMargins> {
    let state = load_state(design)?;
    let (counted, cycles) = counted(service);
    let loads: Vec<LoadEffect> =
        counted.iter().rev().map(|(torque_nm, n)| effect(design, service, &state, *torque_nm, *n)).collect();
    let there = |place: &LifePlace| match place {
        LifePlace::SpragBody => design.clutch.sprags.flanks.is_some(),
        place => !place.is_core() || service.core.is_some(),
    };
    let places = LifePlace::ALL.into_iter().filter(there);
    let used = places.map(|place| used(design, service, &state, place, &loads, &cycles)).collect();
    let largest = loads.first();
    let indents = |pa: Option<f64>| pa.map_or(0.0, |pa| (INDENTING_PA / pa).powi(2));
    let largest_nm = largest.map_or(0.0, |l| l.torque_nm);
    let peak = design.limits.peak_torque_nm.filter(|nm| *nm > largest_nm);
    let pressed = |nm| state.curve.at_torque(nm).map_or(0.0, |p| p.hertz_inner_pa.max(p.hertz_outer_pa));
    Ok(Life {
        peak_beyond: peak.map(|nm| (nm, pressed(nm) > INDENTING_PA)),
        used,
        largest_nm,
        indentation: [
            indents(largest.and_then(|l| Some(l.state?.hertz_inner_pa))),
            indents(largest.and_then(|l| Some(l.state?.hertz_outer_pa))),
        ],
        slips: loads.iter().map(|l| Some(l.slip? * l.engagements)).sum(),
        engagements: loads.iter().map(|l| l.engagements).sum(),
        slips_allowed: service.slips_allowed,
        friction: design.clutch.friction.static_,
        loads,
    })
}

/// Engagements by torque (N m), rising, and cycles of the bodies: (least, largest torque, number).
type Counted = (Vec<(f64, f64)>, Vec<[f64; 3]>);

fn counted(service: &Service) -> Counted {
    let mut loads: Vec<(f64, f64)> = Vec::new();
    let mut cycles: Vec<[f64; 3]> = Vec::new();
    for load in &service.loads {
        loads.push((load.torque_nm, load.engagements));
        cycles.push([load.from_nm, load.torque_nm, load.engagements]);
    }
    for history in &service.histories {
        let points = turning_points(&history.rows);
        let largest = points.iter().copied().fold(0.0, f64::max);
        let class = |torque: f64| (torque / largest * CLASSES as f64).ceil() as usize;
        let torque = |class: usize| largest * class as f64 / CLASSES as f64;
        let mut by_peak: BTreeMap<usize, f64> = BTreeMap::new();
        let swings = rainflow(&points);
        for (peak, n) in engagements(&points, &swings) {
            *by_peak.entry(class(peak)).or_default() += n * history.times;
        }
        loads.extend(by_peak.into_iter().map(|(k, n)| (torque(k), n)));
        let mut by_swing: BTreeMap<(usize, usize), f64> = BTreeMap::new();
        for cycle in swings.iter().filter(|c| c.to_nm > 0.0) {
            // The least torque in its lower class: the swing comes out larger.
            let low = (cycle.from_nm / largest * CLASSES as f64).floor() as usize;
            *by_swing.entry((low, class(cycle.to_nm))).or_default() += cycle.count * history.times;
        }
        cycles.extend(by_swing.into_iter().map(|((a, b), n)| [torque(a), torque(b), n]));
    }
    loads.sort_by(|a, b| a.0.total_cmp(&b.0));
    (loads, cycles)
}

/// What one engagement at `torque_nm` does.
pub fn effect(
    design: &Design,
    service: &Service,
    state: &LoadState,
    torque_nm: f64,
    engagements: f64,
) -> LoadEffect {
    let required =
        |torque: f64| state.curve.at_torque(torque).map_or(f64::INFINITY, |p| p.required_friction());
    let scatter = [service.friction_scatter, service.torque_scatter];
    let friction = design.clutch.friction.static_;
    let slip = (scatter[0] > 0.0).then(|| slip::probability(friction, torque_nm, scatter, required));
    LoadEffect { engagements, slip, ..once(design, service, state, torque_nm) }
}

/// One engagement at `torque_nm`, without chance.
fn once(design: &Design, service: &Service, state: &LoadState, torque_nm: f64) -> LoadEffect {
    let p = state.curve.at_torque(torque_nm);
    let walk_m = p.map_or([0.0; 2], |p| walks_m(design, state, &p));
    let hoop_pa = p.map_or([0.0; 2], |p| rings_pa(design, state, &p));
    LoadEffect {
        torque_nm,
        engagements: 1.0,
        state: p,
        hoop_pa,
        walk_m,
        passes: p.map_or([0.0; 2], |p| passes(design, service, &p, walk_m)),
        required_friction: p.map(|p| p.required_friction()),
        slip: None,
    }
}

/// Contacts that a place of the inner and of the outer track sees in one engagement up to `p`, on the way to which the contacts
/// walk `walk_m`.
fn passes(design: &Design, service: &Service, p: &StaticPoint, walk_m: [f64; 2]) -> [f64; 2] {
    let clutch = &design.clutch;
    let half_m = |pa: f64, n: f64| {
        if pa > 0.0 { 2.0 * n / (PI * clutch.contact_length_m() * pa) } else { 0.0 }
    };
    let races = &clutch.races;
    let around = |walk: f64, half: f64, radius: f64| match service.same_places {
        true => 1.0,
        false => clutch.sprags.count as f64 * (walk + 2.0 * half) / (2.0 * PI * radius),
    };
    [
        around(walk_m[0], half_m(p.hertz_inner_pa, p.normal_inner_n), races.inner_radius_m),
        around(walk_m[1], half_m(p.hertz_outer_pa, p.normal_outer_n), races.outer_radius_m),
    ]
}

/// Lengths of the inner and the outer arc between first contact and the contact at `p`, m: rolling lays the same length on the
/// race.
fn walks_m(design: &Design, state: &LoadState, p: &StaticPoint) -> [f64; 2] {
    let sprags = &design.clutch.sprags;
    let (mut inner, mut from) = (0.0, 0.0);
    for arc in &sprags.inner_arcs {
        let until = arc.until_rad.min(p.contact_turn_rad);
        inner += arc.radius_m * (until - from).max(0.0);
        from = arc.until_rad;
    }
    // B lies on the line from O through C_e: what the body turns against that line, the contact walks.
    let turned = state.curve.closure_at_normal(p.normal_inner_n).map_or(0.0, |(_, c)| c.rotation.v);
    [inner, sprags.outer_radius_m * turned]
}

/// Miner's sum of a place.
fn used(
    design: &Design,
    service: &Service,
    state: &LoadState,
    place: LifePlace,
    loads: &[LoadEffect],
    cycles: &[[f64; 3]],
) -> Used {
    // (cycles, part of the life that they use up, torque)
    let parts: Vec<(f64, Option<f64>, f64)> = match place.is_contact() {
        false => {
            let one = |[from, to, n]: &[f64; 3]| {
                let part = swing_part(design, service, state, place, *from, *to);
                (*n, part.map(|part| n * part), *to)
            };
            cycles.iter().map(one).collect()
        }
        true => {
            let one = |l: &LoadEffect| {
                let n = l.engagements * place.times(l.passes);
                (n, contact_part(design, service, l.state.as_ref(), place).map(|part| n * part), l.torque_nm)
            };
            loads.iter().map(one).collect()
        }
    };
    let share = |(_, part, _): &(f64, Option<f64>, f64)| part.unwrap_or(0.0);
    let mostly = parts.iter().max_by(|a, b| share(a).total_cmp(&share(b)));
    Used {
        place,
        sum: parts.iter().map(|(_, part, _)| *part).sum(),
        cycles: parts.iter().map(|p| p.0).sum(),
        mostly_nm: mostly.map_or(0.0, |p| p.2),
    }
}

/// Part of a place's life that one engagement at `torque_nm` uses up; `None` where its strength is not given or the torque not
/// carried.
pub fn part_at(
    design: &Design,
    service: &Service,
    state: &LoadState,
    place: LifePlace,
    torque_nm: f64,
) -> Option<f64> {
    match place.is_contact() {
        false => swing_part(design, service, state, place, 0.0, torque_nm),
        true => {
            let load = once(design, service, state, torque_nm);
            contact_part(design, service, load.state.as_ref(), place)
                .map(|part| part * place.times(load.passes))
        }
    }
}

/// One swing of a body between two torques.
fn swing_part(
    design: &Design,
    service: &Service,
    state: &LoadState,
    place: LifePlace,
    from_nm: f64,
    to_nm: f64,
) -> Option<f64> {
    let stresses_pa = |torque: f64| {
        let p = if torque > 0.0 { Some(state.curve.at_torque(torque)?) } else { None };
        match (place, &p) {
            (LifePlace::SpragBody, Some(p)) => body_flanks_pa(design, state, p),
            (LifePlace::SpragBody, None) => Some([0.0; 2]),
            (LifePlace::InnerRing, p) => Some(ring_places_pa(design, state, 0, p.as_ref())),
            (_, p) => Some(ring_places_pa(design, state, 1, p.as_ref())),
        }
    };
    let (low, high) = (stresses_pa(from_nm)?, stresses_pa(to_nm)?);
    let strength = if place == LifePlace::SpragBody { service.sprags } else { service.rings }?;
    let parts = low.into_iter().zip(high).map(|(low, high)| strength.part(low, high));
    parts.max_by(f64::total_cmp)
}

/// One contact at the pressure of a load, whose state is `p`, or what lies below it.
fn contact_part(
    design: &Design,
    service: &Service,
    p: Option<&StaticPoint>,
    place: LifePlace,
) -> Option<f64> {
    let p = p?;
    let (pa, normal_n) = match place.is_inside() {
        true => (p.hertz_inner_pa, p.normal_inner_n),
        false => (p.hertz_outer_pa, p.normal_outer_n),
    };
    if place.is_core() {
        let core = service.core.as_ref()?;
        return Some(core.part(shear_in(&design.clutch, (pa, normal_n), core.depth_m).0));
    }
    service.pitting.as_ref().map(|strength| strength.part(pa))
}

impl CoreStrength {
    /// Part of the life that one cycle at the shear `pa` uses up.
    pub fn part(&self, pa: f64) -> f64 {
        (pa / self.shear_pa).powf(self.exponent) / self.cycles
    }
}

impl PittingStrength {
    /// Part of the life that one cycle at the pressure `pa` uses up.
    pub fn part(&self, pa: f64) -> f64 {
        (pa / self.pressure_pa).powf(self.exponent) / self.cycles
    }
}

impl FatigueStrength {
    /// Part of the life that one swing between two stresses (Pa) uses up: the amplitude about zero that does as much, after
    /// Goodman, sigma_a/(1 - sigma_m/R_m); all of it where the larger one breaks the body.
    pub fn part(&self, low_pa: f64, high_pa: f64) -> f64 {
        if low_pa.max(high_pa) >= self.ultimate_pa {
            return 1.0;
        }
        let (amplitude, mean) = (0.5 * (high_pa - low_pa).abs(), 0.5 * (high_pa + low_pa));
        let left = 1.0 - mean.max(0.0) / self.ultimate_pa;
        (amplitude / left / self.amplitude_pa).powf(self.exponent) / self.cycles
    }
}
