//! Changes of mode that accumulate: infinitely many in a finite time, closed at their limit.
//!
//! The rule. Thirteen changes make three spans of four (open, close, slip and stick are one cycle at most). They
//! accumulate where each span is at most 0.9 of the one before, or all are nothing. What is left is then the
//! geometric series s r/(1 - r), r the last ratio. Once that and the last span are shorter than the time in which
//! any angle moves by its tolerance, the run goes to the limit: time by what is left, angles at their rates, v = 0
//! at every contact whose grip took part, alpha at its bound with alpha' = 0 where the place did. There the mode is
//! chosen anew. Contacts of this model yield, so a bounce takes time and a sequence is finite unless a drive or
//! rounding feeds it; the rule bounds the work where one does.

use super::events::EVENTS;
use super::model::Place;
use super::run::RunSettings;
use crate::wedge::WedgeCurve;

const CYCLE: usize = 4;
pub(super) const KEPT: usize = 3 * CYCLE + 1;
/// Largest ratio of one span to the last that counts as shrinking: a choice.
const SHRINKS: f64 = 0.9;

/// The last changes of mode: when, and which event functions fell.
#[derive(Debug, Clone)]
pub(super) struct Zeno {
    pub(super) last: [(f64, [bool; EVENTS]); KEPT],
}

/// Where a sequence leads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Accumulation {
    /// Time to it from the last change, s.
    pub(super) left_s: f64,
    /// Which event functions took part.
    pub(super) took_part: [bool; EVENTS],
}

impl Zeno {
    pub(super) fn new() -> Self {
        Self { last: [(f64::NEG_INFINITY, [false; EVENTS]); KEPT] }
    }

    /// Note a change at `t` (s); the limit where they accumulate within `resolution` (s).
    pub(super) fn note(&mut self, t: f64, fell: [bool; EVENTS], resolution_s: f64) -> Option<Accumulation> {
        self.last.rotate_left(1);
        self.last[KEPT - 1] = (t, fell);
        if self.last[0].0 == f64::NEG_INFINITY {
            return None;
        }
        let span = |i: usize| self.last[(i + 1) * CYCLE].0 - self.last[i * CYCLE].0;
        let (first, second, third) = (span(0), span(1), span(2));
        let shrinks = second <= SHRINKS * first && third <= SHRINKS * second;
        let ratio = if second > 0.0 { third / second } else { 0.0 };
        let left_s = third * ratio / (1.0 - ratio);
        if !shrinks || left_s.max(third) > resolution_s {
            return None;
        }
        let took_part =
            std::array::from_fn(|i| self.last[KEPT - 1 - CYCLE..].iter().any(|(_, fell)| fell[i]));
        *self = Self::new();
        Some(Accumulation { left_s, took_part })
    }
}

/// Time in which no angle of `state` moves by its tolerance, s; at most a millionth of the scene.
pub(super) fn resolution_s<const N: usize>(state: &[f64; N], settings: &RunSettings) -> f64 {
    let rate = state[4..8].iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    (1e-2 * settings.tolerance / rate.max(f64::MIN_POSITIVE)).min(1e-6 * settings.duration_s)
}

/// The bound of `place` nearest to `alpha` (rad), with the places below and above it; `rolling`: as in tension below first contact.
pub(super) fn bound(curve: &WedgeCurve, place: Place, rolling: bool, alpha: f64) -> (f64, Place, Place) {
    let below = |k: usize| if k == 0 { Place::Open } else { Place::Arc(k - 1) };
    let from = |k: usize| if k == 0 { curve.first_contact_rad() } else { curve.arc_end_rad(k - 1) };
    match place {
        Place::Open | Place::Tension => (from(0), place, Place::Arc(0)),
        Place::Carried => (from(0), Place::Open, Place::Arc(0)),
        Place::Arc(k) if k + 1 < curve.arc_count() && curve.arc_end_rad(k) - alpha < alpha - from(k) => {
            (curve.arc_end_rad(k), Place::Arc(k), Place::Arc(k + 1))
        }
        Place::Arc(k) if rolling && k == 0 => (from(k), Place::Tension, Place::Arc(k)),
        Place::Arc(k) => (from(k), below(k), Place::Arc(k)),
    }
}

#[cfg(test)]
mod tests {
    use super::super::events::UPPER;
    use super::*;

    /// A ball with restitution 0.8: gaps shrink by it, the sum is known.
    #[test]
    fn a_bouncing_ball_comes_to_rest_at_its_known_time() {
        let (mut zeno, mut t, mut gap) = (Zeno::new(), 0.0, 0.3);
        let end = gap / (1.0 - 0.8);
        let mut fell = [false; EVENTS];
        fell[UPPER] = true;
        for n in 0..200 {
            if let Some(limit) = zeno.note(t, fell, 1e-9) {
                assert!((t + limit.left_s - end).abs() < 1e-14, "{}", t + limit.left_s - end);
                assert_eq!(limit.took_part, fell);
                assert!((80..110).contains(&n), "{n}");
                return;
            }
            t += gap;
            gap *= 0.8;
        }
        panic!("never closed");
    }

    #[test]
    fn an_even_sequence_is_left_alone_however_fast() {
        let mut zeno = Zeno::new();
        for i in 0..1000 {
            assert_eq!(zeno.note(1e-12 * f64::from(i), [true; EVENTS], 1e-9), None);
        }
    }
}
