//! Sprags one by one: what each carries where they are unlike, the races bend, run out and give way.
//!
//! In: a clutch with `Sharing`, its curve at rest, a torque. Out: [`Unlike`], [`Shared`]: force, friction and pressure of each
//! sprag, shift of the race. Absent: allowables (`margin`), inertia. Equations: none of the paper's; those below.
//!
//! All sprags see one windup W of the races. Sprag i has the normal force that the clutch's own curve has at its own windup
//! y_i, N_i = N(y_i) for y_i > 0 and none below, and
//!
//!   y_i + g_i(N_i) - g(N_i) = W + r_i + v_e/R_e - v_i/R_i,
//!
//! g the rigid rolling that brings a sprag to where it stands ([`crate::wedge::Borne`]), g_i with its own size, its tracks as
//! the other sprags bend them and the axis of the inner race where it lies, r_i its windup when torque begins, v the way
//! that its place of each track gives along the track. Beside these n equations: sum T_i OA_i = C, and, where the
//! axes are not held, sum F_i = k shift. A sprag alike has g_i = g, so a clutch of such is the paper's, whatever bends.
//!
//! **Nothing twice.** The curve's law is that of n sprags loaded alike: it has the local contact, the mean growth of n forces, and
//! (elastic law) the bending between them. Of forces N_j the track recedes at i by sum_j G(theta_i - theta_j) N_j, G(0) of
//! it local and unbounded; the law has N_i sum_j G(j 2 pi/n). Their difference
//!
//!   u_i = sum_{j != i} G(theta_i - theta_j) N_j - N_i sum_{j != 0} G(j 2 pi/n)
//!
//! has no G(0) any more: what a sprag does to itself stays with the law, what it has from its neighbours is theirs. Forces along
//! the tracks go the same way. G is [`crate::race::RingInfluence`], which leaves motion of the race as a whole (its axis) to the shift.
//!
//! Newton in (y, W, shift): dN/dy falls to 0 where a sprag comes off, so the set of sprags in contact follows from the signs of y.

mod draw;
mod engage;
mod failing;
mod newton;
mod pops;
mod turn;

pub use draw::{OneSprag, drawn};
pub use failing::Loss;
pub use newton::{Asked, NotShared};
pub use pops::{PopPoint, Pops};
pub use turn::Turn;

use crate::clutch::{Carrier, Clutch, Sharing, Standing, TrackWave};
use crate::race::RingInfluence;
use crate::wedge::{FIRST_CONTACT_N, SpragDeviation, Statics, WedgeCurve};
use std::f64::consts::TAU;

/// A clutch of unlike sprags.
#[derive(Debug, Clone)]
pub struct Unlike<'a> {
    curve: &'a WedgeCurve,
    /// The sprags as drawn and given.
    pub sprags: Vec<OneSprag>,
    /// Why a sprag carries nothing at any torque; `None`: it can carry.
    pub idle: Vec<Option<Idle>>,
    /// Friction that each needs to grip at its touch, 0 where it does not touch.
    pub first_friction: Vec<f64>,
    /// Windup, rad, from which on each takes load, without bending, races engaged as `phase_rad` says; `None`: idle.
    pub lag_rad: Vec<Option<f64>>,
    /// Distance of the axes, m.
    pub offset_m: f64,
    /// Azimuth of the widest gap from sprag 0 when torque begins, rad.
    pub phase_rad: f64,
    carrier: Carrier,
    /// Radial stiffness, N/m; infinite: held.
    pub stiffness_n_per_m: f64,
    /// Tracks out of round as made.
    tracks: Vec<TrackWave>,
    /// r_i, rad.
    start_rad: Vec<f64>,
    /// Turn of the race with the offset against each sprag at its touch, rad.
    turned_rad: Vec<f64>,
    bending: [Bending; 2],
}

named! {
    /// Why a sprag carries nothing.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Idle {
        /// It is not there.
        Missing = "missing",
        /// It does not stand between the tracks: too large for its gap.
        DoesNotFit = "does not fit",
        /// Its gap is too wide: it touches both tracks nowhere on its profile.
        DoesNotTouch = "does not touch",
        /// Its friction does not hold it at the touch.
        Slips = "slips",
    }
    /// In words.
    pub fn words;
}

/// RingInfluence of each sprag on each place of one race, less what the law of even sprags has; m/N.
#[derive(Debug, Clone)]
struct Bending {
    influence: RingInfluence,
    /// By place and sprag: rows and columns of [`RingInfluence::at`].
    matrix: Vec<Vec<[[f64; 2]; 2]>>,
}

impl Bending {
    fn new(influence: RingInfluence, azimuths: &[f64]) -> Self {
        let n = azimuths.len();
        let mut law = [[0.0; 2]; 2];
        for k in 1..n {
            add(&mut law, &influence.at(TAU * k as f64 / n as f64), -1.0);
        }
        let row = |i: usize| {
            let other = |j: usize| if i == j { law } else { influence.at(azimuths[i] - azimuths[j]) };
            (0..n).map(other).collect()
        };
        let matrix = (0..n).map(row).collect();
        Self { influence, matrix }
    }
}

fn add(sum: &mut [[f64; 2]; 2], more: &[[f64; 2]; 2], factor: f64) {
    for (sum, more) in sum.iter_mut().flatten().zip(more.iter().flatten()) {
        *sum += factor * more;
    }
}

/// A vector turned by `angle_rad`.
fn rotated([x, y]: [f64; 2], angle_rad: f64) -> [f64; 2] {
    let (s, c) = angle_rad.sin_cos();
    [x * c - y * s, x * s + y * c]
}

/// One sprag at a torque.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Bears {
    /// Its own windup, rad; at and below 0 it carries nothing.
    pub own_rad: f64,
    /// N_bi, N.
    pub normal_inner_n: f64,
    /// N_be, N.
    pub normal_outer_n: f64,
    /// T_bi OA, N m.
    pub torque_nm: f64,
    /// T_bi/N_bi.
    pub tan_omega: f64,
    /// T_be/N_be.
    pub tan_nu: f64,
    /// p_0 at A, Pa.
    pub hertz_inner_pa: f64,
    /// p_0 at B, Pa.
    pub hertz_outer_pa: f64,
    /// Turn of the contact on the profile, rad.
    pub turn_rad: f64,
    /// By how much inner and outer track recede beside the law of even sprags, m.
    pub bent_m: [f64; 2],
    /// T_be, N.
    tangent_outer_n: f64,
    /// T_bi, N.
    tangent_inner_n: f64,
}

impl Bears {
    /// Static friction that it needs.
    pub fn required_friction(&self) -> f64 {
        self.tan_omega.max(self.tan_nu)
    }

    /// Largest pressure of both contacts, Pa.
    pub fn hertz_pa(&self) -> f64 {
        self.hertz_inner_pa.max(self.hertz_outer_pa)
    }
}

/// All sprags at one torque.
#[derive(Debug, Clone, PartialEq)]
pub struct Shared {
    /// N m.
    pub torque_nm: f64,
    /// Windup since a sprag as drawn would touch concentric races (caged) or since all touch (sprung), rad.
    pub windup_rad: f64,
    /// Turn of the widest gap against the sprags since the clutch engaged, rad.
    pub turned_rad: f64,
    /// How far the inner race has given way, m: x towards sprag 0, y a quarter turn on.
    pub shift_m: [f64; 2],
    /// Resultant of the contacts on the inner race, N, in the same frame.
    pub radial_n: [f64; 2],
    /// By number.
    pub loads: Vec<Bears>,
    /// Steps of Newton's method.
    pub steps: usize,
}

impl Shared {
    /// Normal force of each sprag over the mean of all places, missing ones counted.
    pub fn shares(&self) -> Vec<f64> {
        let mean = self.loads.iter().map(|l| l.normal_inner_n).sum::<f64>() / self.loads.len() as f64;
        self.loads.iter().map(|l| if mean > 0.0 { l.normal_inner_n / mean } else { 0.0 }).collect()
    }

    /// The sprag of which `demand` is largest, and that.
    pub fn worst(&self, demand: impl Fn(&Bears) -> f64) -> (usize, f64) {
        let mut worst = (0, f64::NEG_INFINITY);
        for (i, load) in self.loads.iter().enumerate() {
            if demand(load) > worst.1 {
                worst = (i, demand(load));
            }
        }
        worst
    }

    /// How many carry.
    pub fn carrying(&self) -> usize {
        self.loads.iter().filter(|l| l.normal_inner_n > 0.0).count()
    }
}

impl<'a> Unlike<'a> {
    /// The clutch whose curve at rest is `curve`, of sprags as `sharing` has them, engaged while the widest gap (if
    /// the axes lie apart) stands
    /// `phase_rad` ahead of sprag 0.
    pub fn new(clutch: &Clutch, sharing: &Sharing, curve: &'a WedgeCurve, phase_rad: f64) -> Self {
        let n = clutch.sprags.count;
        let sprags = drawn(sharing, n, clutch.friction.static_);
        let azimuths: Vec<f64> = sprags.iter().map(|s| s.azimuth_rad).collect();
        let elastic = &curve.statics().elastic;
        let bending =
            [&elastic.inner_race, &elastic.outer_race].map(|race| Bending::new(race.influence(), &azimuths));
        let eccentricity = clutch.races.eccentricity;
        let mut clutch = Self {
            curve,
            sprags,
            idle: vec![None; n],
            first_friction: vec![0.0; n],
            lag_rad: vec![None; n],
            offset_m: eccentricity.map_or(0.0, |e| e.offset_m),
            phase_rad,
            carrier: eccentricity.map_or(Carrier::default(), |e| e.carrier),
            stiffness_n_per_m: sharing
                .stiffness_n_per_m
                .or(eccentricity.map(|e| e.stiffness_n_per_m))
                .unwrap_or(f64::INFINITY),
            tracks: sharing.tracks.clone(),
            start_rad: vec![0.0; n],
            turned_rad: vec![0.0; n],
            bending,
        };
        clutch.stand_all(sharing.start);
        clutch
    }

    /// The same engaged while the widest gap stands `phase_rad` ahead of sprag 0.
    pub fn engaged_at(&self, start: Standing, phase_rad: f64) -> Self {
        let mut other = Self { phase_rad, ..self.clone() };
        other.stand_all(start);
        other
    }

    fn stand_all(&mut self, start: Standing) {
        for i in 0..self.sprags.len() {
            self.idle[i] = None;
            self.lag_rad[i] = None;
            self.stand(i, start);
        }
    }

    /// Put sprag `i` where it stands when torque begins.
    fn stand(&mut self, i: usize, start: Standing) {
        let sprag = self.sprags[i];
        if sprag.missing {
            self.idle[i] = Some(Idle::Missing);
            return;
        }
        let (axis_m, made_m) = (self.axis_m(0.0), self.made_m(i, 0.0));
        let mut statics = self.curve.statics().clone();
        if start == Standing::Sprung && self.offset_m > 0.0 {
            let there = rotated(axis_m, -sprag.azimuth_rad);
            self.turned_rad[i] = statics.touch_turn_rad(there, self.carrier).unwrap_or(0.0);
        }
        let mut touch = |size_m: f64, off: bool| {
            let (offset_m, [inner_m, outer_m]) =
                if off { (self.offset_at(i, axis_m), made_m) } else { ([0.0; 2], [0.0; 2]) };
            statics.set_apart(SpragDeviation { size_m, inner_m, outer_m, offset_m, carrier: self.carrier });
            statics.borne(FIRST_CONTACT_N)
        };
        let own = touch(sprag.size_m, true);
        // A sprag that lacks `gap_m` stands where one larger by that would touch.
        let stands_at = match start {
            Standing::Sprung => touch(sprag.size_m + sprag.gap_m, true).map(|b| b.rolled.v),
            Standing::Caged => {
                let held = [touch(sprag.size_m + sprag.gap_m, false), touch(sprag.size_m, false)];
                held[0].zip(held[1]).map(|(gone, own)| gone.rolled.v - own.rolled.v)
            }
        };
        let (Some(own), Some(stands_at)) = (own, stands_at) else {
            self.idle[i] = Some(Idle::DoesNotFit);
            return;
        };
        let needs = (own.closure.t_bi.v / own.closure.n_bi).max(own.closure.t_be.v / own.closure.n_be.v);
        self.first_friction[i] = needs;
        self.start_rad[i] = stands_at;
        self.idle[i] = if !self.curve.statics().on_profile(own.turn_rad) {
            Some(Idle::DoesNotTouch)
        } else if needs > sprag.friction {
            Some(Idle::Slips)
        } else {
            None
        };
        if self.idle[i].is_none() {
            self.lag_rad[i] = Some(own.rolled.v - stands_at);
        }
    }

    /// What sets sprag `i` apart as made when torque begins, between races on one axis: its size, and its tracks.
    pub fn as_made(&self, i: usize) -> SpragDeviation {
        let [inner_m, outer_m] = self.made_m(i, 0.0);
        SpragDeviation { size_m: self.sprags[i].size_m, inner_m, outer_m, ..SpragDeviation::default() }
    }

    /// How much inner and outer track recede from the gap at sprag `i` as they are made, m, when the widest gap has turned on by
    /// `turned_rad`. The outer track stays with the sprags, the inner one with the widest gap; what they walk on their tracks meanwhile is
    /// small beside a lobe.
    fn made_m(&self, i: usize, turned_rad: f64) -> [f64; 2] {
        let at_rad = self.sprags[i].azimuth_rad;
        let mut recede_m = [0.0; 2];
        for wave in &self.tracks {
            match wave.outer {
                true => recede_m[1] += wave.larger_m(at_rad),
                false => recede_m[0] -= wave.larger_m(at_rad - self.phase_rad - turned_rad),
            }
        }
        recede_m
    }

    /// Axis of the inner race against that of the outer, m, in the frame of sprag 0, when the widest gap has turned on by
    /// `turned_rad`.
    fn axis_m(&self, turned_rad: f64) -> [f64; 2] {
        rotated([-self.offset_m, 0.0], self.phase_rad + turned_rad)
    }

    /// The same as sprag `i` has it before it rolls on, along its radius and across.
    fn offset_at(&self, i: usize, axis_m: [f64; 2]) -> [f64; 2] {
        if axis_m == [0.0; 2] {
            return axis_m;
        }
        rotated(axis_m, -(self.sprags[i].azimuth_rad + self.turned_rad[i]))
    }

    /// How far both tracks together recede at sprag `at[i]` for a newton of normal force of sprag `at[j]`, beside the
    /// law of even sprags, by rows, m/N: what one sprag's contacts would have to come together for the same work. For
    /// one newton of N_bi the forces on the tracks are
    /// `inner` (normal, along, in its positive sense) and `outer`. Symmetric.
    pub fn opens_m_per_n(&self, at: &[usize], inner: [f64; 2], outer: [f64; 2]) -> Vec<f64> {
        let work = |race: usize, [n, t]: [f64; 2], i: usize, j: usize| {
            let [[nn, nt], [tn, tt]] = self.bending[race].matrix[i][j];
            n * (nn * n + nt * t) + t * (tn * n + tt * t)
        };
        let entry = |i: usize, j: usize| {
            let one = |i, j| work(0, inner, i, j) + work(1, outer, i, j);
            0.5 * (one(i, j) + one(j, i))
        };
        at.iter().flat_map(|&i| at.iter().map(move |&j| (i, j))).map(|(i, j)| entry(i, j)).collect()
    }

    /// The same between races that do not bend unevenly: each sprag yields as one of sprags alike.
    pub fn unbent(&self) -> Self {
        let mut stiff = self.clone();
        for entry in stiff.bending.iter_mut().flat_map(|b| &mut b.matrix).flatten() {
            *entry = [[0.0; 2]; 2];
        }
        stiff
    }

    /// The clutch without sprag `i`.
    pub fn without(&self, i: usize) -> Self {
        let mut left = self.clone();
        left.idle[i] = Some(Idle::Missing);
        left.lag_rad[i] = None;
        left
    }

    /// The clutch's own curve at rest.
    pub fn curve(&self) -> &WedgeCurve {
        self.curve
    }

    /// Statics of one sprag as drawn.
    fn statics(&self) -> &Statics {
        self.curve.statics()
    }

    /// Growth of the mean radius and amplitudes of the harmonics 2 to `most` of both races' radii, inner race first, m.
    pub fn out_of_round_m(&self, shared: &Shared, most: usize) -> [Vec<f64>; 2] {
        [0, 1].map(|race| {
            let forces: Vec<(f64, f64, f64)> = self
                .sprags
                .iter()
                .zip(&shared.loads)
                .map(|(s, l)| match race {
                    0 => (s.azimuth_rad, l.normal_inner_n, l.tangent_inner_n),
                    _ => (s.azimuth_rad, l.normal_outer_n, -l.tangent_outer_n),
                })
                .collect();
            let influence = &self.bending[race].influence;
            let total = forces.iter().map(|f| f.1).sum();
            let mean = influence.mean_growth_m(total);
            std::iter::once(mean).chain((2..=most).map(|m| influence.amplitude_m(m, &forces))).collect()
        })
    }
}
