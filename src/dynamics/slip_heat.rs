//! Work, heat and wear of slip at each contact since the clutch engaged: an observation beside the run, by quadrature over the dense
//! output of its accepted steps. Nothing of it comes back into the motion.
//!
//! Pressure and flux are means over the Hertz flat of the normal force of the moment, that of the arc in contact. Slips that follow
//! one another before heat has gone sideways from below the flat ([`stays_s`]) are one: it rests in between, and cools.

use super::model::{Grip, Mode, Model, Place};
use crate::lubrication::{Flash, peclet, stays_s};
use crate::numeric::quadrature;
use crate::ode::adaptive::Size;
use crate::ode::step::Dense;
use nalgebra::Const;

/// What slip at one contact of one sprag has come to.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SlipWork {
    /// When it began, s.
    pub from_s: f64,
    /// Time in slip, s.
    pub time_s: f64,
    /// Path of slip, m.
    pub path_m: f64,
    /// Work of friction, J.
    pub work_j: f64,
    /// Its largest power, W.
    pub power_w: f64,
    /// Largest heat of both bodies over the flat, W/m^2.
    pub flux_w_m2: f64,
    /// Largest rise of the hottest place above the bodies, K ([`Flash`]).
    pub flash_k: f64,
    /// Peclet number then ([`peclet`]): below some 5 heat goes sideways too, and the rise is less.
    pub peclet: f64,
    /// int p |v| dt of the sprag, which stands under the pressure, N/m.
    pub rubbed_sprag_n_per_m: f64,
    /// The same of the place of the race that most goes over: no more than a flat's width of each slip one way, as if all went over
    /// it, N/m.
    pub rubbed_race_n_per_m: f64,
}

/// Slip at one contact of one sprag since the clutch engaged.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Rubbed {
    /// All of it.
    pub whole: SlipWork,
    /// The slip with the most work.
    pub worst: SlipWork,
}

impl SlipWork {
    /// Depths that wear off sprag and race, m, where `k` are their wear per load and path, m^2/N (Archard), and nothing but asperities
    /// carries.
    pub fn wear_m(&self, k: [f64; 2]) -> [f64; 2] {
        [k[0] * self.rubbed_sprag_n_per_m, k[1] * self.rubbed_race_n_per_m]
    }

    fn begin(from_s: f64) -> Self {
        Self { from_s, ..Self::default() }
    }

    fn add(&mut self, piece: &Piece, flash_k: f64, peclet: f64, passing_m: f64) {
        let path_m = piece.speed_m_s * piece.time_s;
        self.time_s += piece.time_s;
        self.path_m += path_m;
        self.work_j += piece.power_w * piece.time_s;
        self.power_w = self.power_w.max(piece.power_w);
        self.flux_w_m2 = self.flux_w_m2.max(piece.over_flat(piece.power_w));
        if flash_k > self.flash_k {
            (self.flash_k, self.peclet) = (flash_k, peclet);
        }
        let pressure_pa = piece.over_flat(piece.normal_n);
        self.rubbed_sprag_n_per_m += pressure_pa * path_m;
        self.rubbed_race_n_per_m += pressure_pa * path_m.min(passing_m);
    }

    /// `n` times what has come since `earlier` is added; what is largest stays.
    fn repeat(&mut self, n: f64, earlier: &Self) {
        self.time_s += n * (self.time_s - earlier.time_s);
        self.path_m += n * (self.path_m - earlier.path_m);
        self.work_j += n * (self.work_j - earlier.work_j);
        self.rubbed_sprag_n_per_m += n * (self.rubbed_sprag_n_per_m - earlier.rubbed_sprag_n_per_m);
        self.rubbed_race_n_per_m += n * (self.rubbed_race_n_per_m - earlier.rubbed_race_n_per_m);
    }
}

/// A piece of slip that is taken for steady.
struct Piece {
    time_s: f64,
    speed_m_s: f64,
    normal_n: f64,
    power_w: f64,
    half_m: f64,
    length_m: f64,
}

impl Piece {
    /// `all` by the area of the flat; 0 where there is none.
    fn over_flat(&self, all: f64) -> f64 {
        let area_m2 = 2.0 * self.half_m * self.length_m;
        if area_m2 > 0.0 { all / area_m2 } else { 0.0 }
    }
}

/// One contact.
#[derive(Debug, Clone, Copy)]
struct Rubbing {
    heat: Rubbed,
    present: SlipWork,
    flash: Flash,
    /// Until when it has slipped, s.
    until_s: f64,
    /// Half width of the present slip's widest flat, m.
    widest_m: f64,
    /// Which way it slips, and how far that way without a rest, m.
    sense: f64,
    leg_m: f64,
}

impl Rubbing {
    fn new() -> Self {
        Self {
            heat: Rubbed::default(),
            present: SlipWork::default(),
            flash: Flash::COLD,
            until_s: f64::NEG_INFINITY,
            widest_m: 0.0,
            sense: 0.0,
            leg_m: 0.0,
        }
    }

    /// It slips from `t` (s) on.
    fn begin(&mut self, t: f64, sense: f64) {
        let rested_s = t - self.until_s;
        if rested_s > stays_s(self.widest_m) {
            (self.present, self.flash, self.widest_m) = (SlipWork::begin(t), Flash::COLD, 0.0);
        } else if rested_s > 0.0 {
            self.flash.rest(rested_s);
        }
        if rested_s > 0.0 || sense != self.sense {
            (self.sense, self.leg_m) = (sense, 0.0);
        }
        if self.heat.whole.time_s == 0.0 {
            self.heat.whole.from_s = t;
        }
    }

    fn slip(&mut self, piece: &Piece) {
        let Piece { time_s, speed_m_s, half_m, .. } = *piece;
        let flash_k = self.flash.slip(piece.over_flat(piece.power_w), half_m, speed_m_s, time_s);
        let peclet = peclet(half_m, speed_m_s, self.present.time_s + time_s);
        let passing_m = (2.0 * half_m - self.leg_m).max(0.0);
        self.present.add(piece, flash_k, peclet, passing_m);
        self.heat.whole.add(piece, flash_k, peclet, passing_m);
        self.leg_m += speed_m_s * time_s;
        self.widest_m = self.widest_m.max(half_m);
    }

    /// It has slipped until `t` (s).
    fn end(&mut self, t: f64) {
        self.until_s = t;
        if self.present.work_j > self.heat.worst.work_j {
            self.heat.worst = self.present;
        }
    }

    /// What has come since it was as `earlier` comes `n` times more, within `span_s`.
    fn repeat(&mut self, n: f64, span_s: f64, earlier: &Self) {
        self.heat.whole.repeat(n, &earlier.heat.whole);
        if self.present.from_s == earlier.present.from_s {
            self.present.repeat(n, &earlier.present);
        } else {
            self.present.from_s += span_s;
        }
        self.end(self.until_s + span_s);
    }
}

/// Both contacts, and as they were at the start of the template of a jump.
#[derive(Debug, Clone)]
pub(super) struct SlipWatch {
    contacts: [Rubbing; 2],
    marked: [Rubbing; 2],
}

/// Which arc is at the inner race, and in which sense each contact slips; `None` where neither does under load.
fn rubs(mode: &Mode) -> Option<(usize, [Option<f64>; 2])> {
    let arc = match mode.place {
        Place::Arc(k) => k,
        Place::Carried => 0,
        Place::Open | Place::Tension => return None,
    };
    let mut senses = [mode.inner, mode.outer].map(|grip| match grip {
        Grip::Slip(sense) => Some(sense),
        Grip::Stick => None,
    });
    if mode.place == Place::Carried {
        senses = [None, senses[1].filter(|_| !mode.is_off())];
    }
    (senses != [None; 2]).then_some((arc, senses))
}

impl SlipWatch {
    /// Nothing has slipped.
    pub(super) fn new() -> Self {
        Self { contacts: [Rubbing::new(); 2], marked: [Rubbing::new(); 2] }
    }

    /// Inner and outer contact; `None`: it has not slipped.
    pub(super) fn heat(&self) -> [Option<Rubbed>; 2] {
        self.contacts.map(|c| Some(c.heat).filter(|heat| heat.whole.time_s > 0.0))
    }

    /// Whether [`Self::step`] has anything to see in `mode`.
    pub(super) fn sees(mode: &Mode) -> bool {
        rubs(mode).is_some()
    }

    /// An accepted step in `mode` between `times` (s).
    pub(super) fn step<const N: usize>(
        &mut self,
        model: &Model,
        mode: &Mode,
        [from, until]: [f64; 2],
        dense: &Dense<N>,
    ) where
        Const<N>: Size,
    {
        let Some((k, senses)) = rubs(mode) else { return };
        let elastic = &model.curve.statics().elastic;
        let arc = (model.curve.first_arc() + k).min(elastic.inner_contact.len() - 1);
        let flats = [&elastic.inner_contact[arc], &elastic.outer_contact];
        let rubbing = || senses.into_iter().enumerate().filter_map(|(i, sense)| Some((i, sense?)));
        rubbing().for_each(|(i, sense)| self.contacts[i].begin(from, sense));
        for (t, time_s) in quadrature::nodes(from, until) {
            let f = model.forces(mode, t, &dense.at(t));
            let each = [(f.n_bi, f.t_bi, f.v_a), (f.n_be, f.t_be, f.v_b)];
            for (i, _) in rubbing() {
                let (normal_n, tangential_n, v) = each[i];
                self.contacts[i].slip(&Piece {
                    time_s,
                    speed_m_s: v.abs(),
                    normal_n: normal_n.max(0.0),
                    power_w: (tangential_n * v).abs(),
                    half_m: flats[i].half_width_m(normal_n),
                    length_m: flats[i].length_m,
                });
            }
        }
        rubbing().for_each(|(i, _)| self.contacts[i].end(until));
    }

    /// The template of a jump begins.
    pub(super) fn mark(&mut self) {
        self.marked = self.contacts;
    }

    /// It comes `n` times more, within `span_s`. A slip that goes on throughout has the flash of the template.
    pub(super) fn repeat(&mut self, n: f64, span_s: f64) {
        for (contact, earlier) in self.contacts.iter_mut().zip(&self.marked) {
            contact.repeat(n, span_s, earlier);
        }
    }
}
