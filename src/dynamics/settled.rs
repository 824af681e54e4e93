//! When a run that rolls may end before its scene: what is still to come stays below what has been.
//!
//! Damping takes away what a motion has begun with and leaves what its excitation keeps up, so most scenes ask for most within
//! their first periods. After each period the recurrence of [`super::foresee`] tells how high each figure will come; what the period
//! before foresaw otherwise is its doubt. The run ends once every record stays [`SAFE`] doubts above all that comes.

use super::events::FIGURES;
use super::foresee::{ORDER, Rhythm, rise_ahead};
use super::probes::Grid;
use super::stick::{Rolls, Sight};
use crate::ode::dop853::PROBES;

/// Doubts by which a record is to stay above what comes: a choice. One period's is mostly half of the one before, so that what is foreseen
/// will still move by one.
const SAFE: f64 = 3.0;
/// What is left of a doubt after a period at least: two that agree by chance do not do so twice.
const LEFT: f64 = 0.25;
/// Part of a record down to which what comes is to be at rest where the scene is longer than is foreseen.
const FINE: f64 = 1e-6;
/// Where nothing repeats, periods that the run is taken to have: free swings die away by any clock.
const CLOCK: f64 = 32.0;

/// The most that was foreseen of a figure a period ago, and its doubt.
#[derive(Debug, Clone, Copy)]
struct Most {
    value: f64,
    doubt: f64,
}

/// What the last periods were like.
#[derive(Debug, Clone)]
pub(super) struct Settled {
    period_s: f64,
    /// `None`: the torque's course goes on.
    rhythm: Option<Rhythm>,
    /// About the most that each figure was, in the period that has begun first.
    highs: [[f64; FIGURES]; ORDER + 2],
    foreseen: [Most; FIGURES],
}

impl Settled {
    /// Of a run over `duration_s` under what repeats with `omega_rad_s`; 0: nothing does.
    pub(super) fn new(omega_rad_s: f64, duration_s: f64) -> Self {
        let period_s =
            if omega_rad_s > 0.0 { std::f64::consts::TAU / omega_rad_s } else { duration_s / CLOCK };
        Self {
            period_s,
            rhythm: None,
            highs: [[f64::NEG_INFINITY; FIGURES]; ORDER + 2],
            foreseen: [Most { value: f64::NAN, doubt: f64::NAN }; FIGURES],
        }
    }

    /// Look at the step of `rolls` that was taken up to `until_s`, whose probes lie within `range`. True: no figure of the time up to
    /// `end_s` can come to `records`.
    pub(super) fn after(
        &mut self,
        rolls: &Rolls,
        [until_s, end_s]: [f64; 2],
        range: &[[f64; 2]; FIGURES],
        records: &[f64; FIGURES],
    ) -> bool {
        let Some(rhythm) = &mut self.rhythm else {
            if rolls.next_knot_s(until_s).is_infinite() {
                self.rhythm = Some(Rhythm::new(self.period_s, until_s));
            }
            return false;
        };
        // The first rises are those above the second period.
        if rhythm.begun() > 1 {
            rise(&mut self.highs[0], range, &rolls.probed);
        }
        if !rhythm.note(&rolls.probed, until_s) {
            return false;
        }
        let recurrence = rhythm.recurrence();
        let left = ((end_s - until_s) / self.period_s).ceil() as usize + 1;
        // Each, so that the next period has what this one foresees.
        let below = recurrence
            .map(|c| std::array::from_fn(|i| self.is_below(&c, i, left, records[i])))
            .is_some_and(|below: [bool; FIGURES]| below.iter().all(|below| *below));
        self.highs.rotate_right(1);
        self.highs[0] = [f64::NEG_INFINITY; FIGURES];
        rise(&mut self.highs[0], range, &rolls.probed);
        below
    }

    /// Whether figure `i` stays below its `record` in the `left` periods to come, by `c`.
    fn is_below(&mut self, c: &[f64; ORDER], i: usize, left: usize, record: f64) -> bool {
        let values: [f64; ORDER + 1] = std::array::from_fn(|j| self.highs[j][i]);
        let before = self.foreseen[i];
        let rise = rise_ahead(c, &values, left, FINE * record.abs()).unwrap_or(f64::NAN);
        let value = values[0] + rise;
        let change = (value.max(values[0]) - before.value).abs();
        self.foreseen[i] = Most { value, doubt: change };
        let doubt = if change.is_nan() { change } else { change.max(LEFT * before.doubt) };
        record - value > SAFE * doubt
    }
}

/// A step with these `probes`, whose figures lie within `range`, is of the period whose highs are `high`.
fn rise(high: &mut [f64; FIGURES], range: &[[f64; 2]; FIGURES], probes: &[Sight]) {
    for (i, (high, [low, top])) in high.iter_mut().zip(range).enumerate() {
        if top + (top - low) > *high {
            let value = |j: usize| probes[j].figures[i];
            let most = (1..probes.len()).fold(0, |most, j| if value(j) > value(most) { j } else { most });
            *high = high.max(value(most) + Grid { at: &PROBES }.overshoot(most, value));
        }
    }
}
