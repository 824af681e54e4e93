//! A run that rolls, taken again by a neighbour of its model: what its peaks change by, to the first order.
//!
//! The neighbour takes the steps of the run, whatever their error (internal differentiation; Bock, *Numerical treatment of inverse
//! problems in chemical reaction kinetics*, 1981), so that nothing in it chooses, and the difference of two such runs is the
//! derivative of what was integrated, to the rounding of the difference. A step that ended at a junction ends at the
//! neighbour's own, one that ended at a knot of the torque's course at that. A peak is a level place: by the envelope theorem the time
//! at which it comes does not enter. It is read off a parabola through three figures about that time, at the ends of the run and at
//! junctions off the state there. Nothing is integrated beyond the last peak, and of the run itself only the steps that hold one.

use super::events::FIGURES;
use super::model::{Model, Place, State};
use super::run::Peaks;
use super::stick::{Edge, Largest, Leg, Pair, Rolls, Sight, Stuck, first_passage};
use crate::ode::dop853::{Dense, PROBES, Step};
use crate::ode::step::{Counters, Tolerance};

/// Steps of a run and where its figures were largest.
#[derive(Debug, Clone)]
pub struct RollingTrack {
    arc: usize,
    legs: Vec<Leg>,
    peaks: Peaks,
    largest: [Largest; FIGURES],
}

/// The tolerance of steps that nobody judges.
const ANY: Tolerance<4> =
    Tolerance { relative: 1.0, absolute: [1.0; 4], integrated: [0.0; 4], datum: [0.0; 4] };
/// Half of what the parabola about a peak spans, as a part of the step: what it leaves out goes with its fourth power.
const ABOUT: f64 = 0.02;

impl RollingTrack {
    pub(super) fn of(arc: usize, run: Stuck) -> Self {
        let Stuck { legs, peaks, largest, .. } = run;
        Self { arc, legs, peaks, largest }
    }

    /// How many steps it took.
    pub fn steps(&self) -> usize {
        self.legs.len()
    }

    /// Figures that a demand is read from: |T|/N of the contact that asks for more, the ends of N_bi. In tension |T|/N says nothing.
    fn read(&self, model: &Model) -> &'static [usize] {
        let outer_asks = !model.outer_holds && self.peaks.tan_outer > self.peaks.tan_inner;
        match outer_asks {
            _ if self.pulls() => &[2, 3],
            true => &[1, 2, 3],
            false => &[0, 2, 3],
        }
    }

    /// Whether rolling needs tension.
    fn pulls(&self) -> bool {
        self.peaks.normal_min_n <= 0.0
    }

    /// Whether leg `k` begins or ends where the motion has a corner, its figures a jump, or an end.
    fn is_corner(&self, k: usize, edge: Edge) -> bool {
        match edge {
            Edge::Start => k == 0 || self.legs[k - 1].passes || self.legs[k - 1].breaks,
            Edge::End => self.legs[k].passes || self.legs[k].breaks || k + 1 == self.legs.len(),
        }
    }

    /// The peaks of `model`, whose track this is, as [`Self::retraced`] reads those of a neighbour: `state` is its start.
    pub(super) fn read_again(&self, model: &Model, state: &State) -> Option<Peaks> {
        let mut peaks = self.peaks;
        for &i in self.read(model) {
            let Largest { leg, from, .. } = self.largest[i];
            let mut rolls = Rolls::at(model, &from, state);
            self.follow(
                leg,
                &mut rolls,
                (self.legs[leg].from_s, from.now),
                &mut Step::new(),
                &[i],
                &mut peaks,
            )?;
        }
        Some(peaks)
    }

    /// The peaks of `model`, a neighbour of the one whose track this is, from its start `state`; [`Peaks::normal_outer_max_n`] and the
    /// friction at the contact that asks for less stay as they are. `None` where it goes another way: begins on another arc, does not
    /// come to a junction that the run came to, needs tension where the run needs none or none where it does.
    pub(super) fn retraced(&self, model: &Model, state: &State, place: Place) -> Option<Peaks> {
        if place != Place::Arc(self.arc) {
            return None;
        }
        let read = self.read(model);
        let last = read.iter().map(|i| self.largest[*i].leg).max()?;
        let (mut rolls, y) = Rolls::new(model, self.arc, state);
        let (mut t, mut step) = (0.0, Step::new());
        let mut now = rolls.sight(t, &y);
        let mut peaks = self.peaks;
        for (k, leg) in self.legs[..=last].iter().enumerate() {
            let passage = self.follow(k, &mut rolls, (t, now), &mut step, read, &mut peaks)?;
            if let Some((length, mut y)) = passage {
                t += length;
                if !rolls.pass(&mut y) {
                    return None;
                }
                rolls.pass_knot(t);
                now = rolls.sight(t, &y);
            } else {
                t = leg.until_s;
                now = rolls.probed[PROBES.len() - 1];
                if leg.breaks {
                    rolls.pass_knot(t);
                    now = rolls.sight(t, &step.y1);
                }
            }
        }
        (self.pulls() == (peaks.normal_min_n <= 0.0)).then_some(peaks)
    }

    /// Leg `k` from `now` at `t` (s) on; those of the figures `read` that were largest on it go to `peaks`. Where it ends at a junction,
    /// how long it was, s, and with what; `None`: it goes another way.
    fn follow(
        &self,
        k: usize,
        rolls: &mut Rolls,
        (t, now): (f64, Sight),
        step: &mut Step<4>,
        read: &[usize],
        peaks: &mut Peaks,
    ) -> Option<Option<(f64, Pair)>> {
        let (leg, mut counters) = (&self.legs[k], Counters::default());
        let slope = rolls.set_out(now);
        rolls.looks = leg.passes;
        // Nothing is added where it begins when that of the run did.
        let h = leg.length_s + (leg.from_s - t);
        step.take(rolls, t, &now.y, &slope, h, &ANY, f64::INFINITY, &mut counters).ok()?;
        let mut dense = None;
        let theta = match leg.passes {
            true => Some(first_passage(rolls, step, &mut dense, &mut counters)??),
            false => None,
        };
        let length = theta.map_or(h, |theta| theta * h);
        for &i in read.iter().filter(|&&i| self.largest[i].leg == k) {
            if dense.is_none() {
                dense = Some(step.dense(rolls, &mut counters).ok()?);
            }
            let (d, at) = (dense.as_ref()?, self.largest[i]);
            let corner = at.edge.filter(|edge| self.is_corner(k, *edge));
            let value = match corner {
                Some(Edge::Start) => now.figures[i],
                Some(Edge::End) => rolls.sight(t + length, &d.after(length)).figures[i],
                None => top(rolls, d, t, at.t_s - t, h, i),
            };
            peaks.keep(i, at.t_s, value, peaks.normal_at_tan_n[usize::from(i == 1)]);
        }
        Some(theta.zip(dense).map(|(_, d)| (length, d.after(length))))
    }
}

/// Figure `i` at its top near `elapsed` (s) after the start of a step at `t` over `h`.
fn top(rolls: &mut Rolls, dense: &Dense<4>, t: f64, elapsed: f64, h: f64, i: usize) -> f64 {
    let apart = ABOUT * h;
    let mut at = |s: f64| {
        let y: Pair = dense.after(elapsed + s);
        rolls.sight(t + elapsed + s, &y).figures[i]
    };
    let [before, here, after] = [-apart, 0.0, apart].map(&mut at);
    let (rise, bend) = (0.5 * (after - before), after + before - 2.0 * here);
    if bend >= 0.0 {
        return here;
    }
    let to_top = (-rise / bend).clamp(-1.0, 1.0);
    here + to_top * (rise + 0.5 * bend * to_top)
}
