//! What is still to come of a motion, as its last periods tell it.
//!
//! About a motion that repeats, or rests, what lies a period apart differs by x_(k+1) - x_k = M (x_k - x_(k-1)), M a matrix of 4 by 4, but
//! for squares of the difference. So the differences of anything that the state decides, at whatever phase of the period, obey one
//! recurrence (Cayley and Hamilton):
//!
//!   d_k = c_1 d_(k-1) + c_2 d_(k-2) + c_3 d_(k-3) + c_4 d_(k-4).
//!
//! The c are those that states at [`PHASES`] of the last periods fit best (Schmid, *Dynamic mode decomposition of numerical and
//! experimental data*, J. Fluid Mech. 656, 2010). What squares leave out shows in what one period foresees otherwise than the one before.

use super::stick::{Pair, Sight};
use crate::ode::dop853::hermite;
use nalgebra::{Matrix4, Vector4};
use std::cmp::Ordering;

/// Terms of the recurrence: as many as the state has components.
pub(super) const ORDER: usize = 4;
/// Whole periods from which it follows.
const KEPT: usize = ORDER + 2;
/// Parts of a period at which the state is kept: uneven, so that no swing is met each time where it passes zero.
const PHASES: [f64; 8] = [0.0, 0.09, 0.23, 0.34, 0.47, 0.61, 0.72, 0.88];
/// What keeps the fit defined where fewer swings than four are left, as a part of the squares of a difference.
const LEAST: f64 = 1e-12;
/// Periods that are foreseen one by one; what still moves then is not foreseen.
const MOST_AHEAD: usize = 300;

/// States of the last periods.
#[derive(Debug, Clone)]
pub(super) struct Rhythm {
    period_s: f64,
    /// Where the first period began, s.
    from_s: f64,
    /// Phases seen since.
    count: usize,
    /// States at the phases, of the period that has begun first.
    states: [[Pair; PHASES.len()]; KEPT + 1],
}

impl Rhythm {
    /// Of periods of `period_s` (s) from `from_s` (s) on.
    pub(super) fn new(period_s: f64, from_s: f64) -> Self {
        Self { period_s, from_s, count: 0, states: [[[f64::NAN; 4]; PHASES.len()]; KEPT + 1] }
    }

    /// Periods that have begun.
    pub(super) fn begun(&self) -> usize {
        self.count.div_ceil(PHASES.len())
    }

    /// Keep the states of the phases that a step, `probed`, came by up to `until_s`. True: a period has begun.
    pub(super) fn note(&mut self, probed: &[Sight], until_s: f64) -> bool {
        let mut begun = false;
        loop {
            let (period, phase) = (self.count / PHASES.len(), self.count % PHASES.len());
            let t = self.from_s + (period as f64 + PHASES[phase]) * self.period_s;
            if t > until_s {
                return begun;
            }
            if phase == 0 {
                begun = true;
                self.states.rotate_right(1);
            }
            self.states[0][phase] = between(probed, t);
            self.count += 1;
        }
    }

    /// c_1 to c_4 by the last whole periods; `None` before there are as many as it takes.
    pub(super) fn recurrence(&self) -> Option<[f64; ORDER]> {
        if self.begun() <= KEPT {
            return None;
        }
        let difference = |k: usize, phase: usize| -> Pair {
            std::array::from_fn(|i| self.states[k + 1][phase][i] - self.states[k + 2][phase][i])
        };
        let mut differences: [[Pair; PHASES.len()]; ORDER + 1] =
            std::array::from_fn(|k| std::array::from_fn(|phase| difference(k, phase)));
        // Each component of the state counts as much as the others.
        let mut squares = [0.0; 4];
        for d in differences[..2].as_flattened() {
            (0..4).for_each(|i| squares[i] += d[i] * d[i]);
        }
        let weight = squares.map(|squares| if squares > 0.0 { 1.0 / f64::sqrt(squares) } else { 0.0 });
        for d in differences.as_flattened_mut() {
            (0..4).for_each(|i| d[i] *= weight[i]);
        }
        let product = |a: usize, b: usize| -> f64 {
            let mut sums = [0.0; 4];
            for (x, y) in differences[a].iter().zip(&differences[b]) {
                (0..4).for_each(|i| sums[i] += x[i] * y[i]);
            }
            sums.iter().sum()
        };
        let length: [f64; ORDER] = std::array::from_fn(|i| product(i + 1, i + 1).sqrt());
        if length.contains(&0.0) {
            return Some([0.0; ORDER]);
        }
        let matrix = Matrix4::from_fn(|i, j| match i.cmp(&j) {
            // The upper triangle is not read.
            Ordering::Less => 0.0,
            Ordering::Equal => 1.0 + LEAST,
            Ordering::Greater => product(i + 1, j + 1) / (length[i] * length[j]),
        });
        let right = Vector4::from_fn(|i, _| product(i + 1, 0) / length[i]);
        let c = matrix.cholesky()?.solve(&right);
        Some(std::array::from_fn(|i| c[i] / length[i]))
            .filter(|c: &[f64; ORDER]| c.iter().all(|c| c.is_finite()))
    }
}

/// Rises from period to period that follow on those of `values`, the last first, by the recurrence `c`.
fn rises(c: &[f64; ORDER], values: &[f64; ORDER + 1]) -> impl Iterator<Item = f64> {
    let mut last: [f64; ORDER] = std::array::from_fn(|j| values[j] - values[j + 1]);
    std::iter::repeat_with(move || {
        let next = c.iter().zip(&last).map(|(c, rise)| c * rise).sum();
        last.rotate_right(1);
        last[0] = next;
        next
    })
}

/// How far above the last of `values`, the last first, comes by the recurrence `c` within `left` periods, at most; `None` where it does not
/// come to rest, to `fine`.
pub(super) fn rise_ahead(c: &[f64; ORDER], values: &[f64; ORDER + 1], left: usize, fine: f64) -> Option<f64> {
    let mut coming = rises(c, values);
    let (mut sum, mut most) = (0.0, f64::NEG_INFINITY);
    for _ in 0..left.min(MOST_AHEAD) {
        sum += coming.next()?;
        most = most.max(sum);
    }
    let rests = left <= MOST_AHEAD || coming.take(ORDER).all(|rise| rise.abs() <= fine);
    (rests && sum.is_finite()).then_some(most)
}

/// State at `t` (s) within a step that was `probed`, by cubics from probe to probe.
fn between(probed: &[Sight], t: f64) -> Pair {
    let k = probed[1..].iter().position(|p| t <= p.t).unwrap_or(probed.len() - 2);
    let (a, b) = (&probed[k], &probed[k + 1]);
    let h = b.t - a.t;
    let [slope_a, slope_b] = [a, b].map(|p| [p.y[2], p.y[3], p.rates[0], p.rates[1]]);
    hermite((t - a.t) / h, h, [&a.y, &b.y], [&slope_a, &slope_b])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What `swings` (decay and angle of each in a period, amplitude) leave at `t` periods of what component `i` of the state does.
    fn seen(swings: &[[f64; 3]], t: f64, i: usize) -> f64 {
        let forced = (std::f64::consts::TAU * t + i as f64).sin();
        let one =
            |[decay, angle, size]: &[f64; 3]| size * (-decay * t).exp() * (angle * t + 0.7 * i as f64).cos();
        1.0 + forced + swings.iter().map(one).sum::<f64>()
    }

    fn rhythm(swings: &[[f64; 3]], periods: usize) -> Rhythm {
        let mut rhythm = Rhythm::new(1.0, 0.0);
        for period in 0..=periods {
            rhythm.states.rotate_right(1);
            rhythm.states[0] =
                PHASES.map(|phase| std::array::from_fn(|i| seen(swings, period as f64 + phase, i)));
        }
        rhythm.count = periods * PHASES.len() + 1;
        rhythm
    }

    #[test]
    fn swings_that_die_away_are_foreseen() {
        let two = [[0.3, 1.9, 0.02], [0.12, 4.4, 0.005]];
        // Two swings, one alone, and one that neither turns nor swings.
        for swings in [&two[..], &two[..1], &[[0.2, 0.0, 0.01]]] {
            assert!(rhythm(swings, KEPT - 1).recurrence().is_none());
            let c = rhythm(swings, KEPT).recurrence().unwrap();
            let high = |period: usize| seen(swings, period as f64 + 0.2, 2);
            let last = KEPT - 1;
            let values = std::array::from_fn(|j| high(last - j));
            for left in [1, 2, 30] {
                let rise = rise_ahead(&c, &values, left, 0.0).unwrap();
                let most = (1..=left).map(|k| high(last + k)).fold(f64::NEG_INFINITY, f64::max);
                let off = values[0] + rise - most;
                assert!(off.abs() < 1e-9, "{swings:?}, {left}: {off:e}");
            }
        }
    }

    #[test]
    fn what_does_not_come_to_rest_is_not_foreseen_for_ever() {
        let swings = [[0.0, 2.0, 0.01], [0.5, 1.0, 0.01]];
        let c = rhythm(&swings, KEPT).recurrence().unwrap();
        let values = std::array::from_fn(|j| seen(&swings, (KEPT - 1 - j) as f64, 0));
        assert!(rise_ahead(&c, &values, MOST_AHEAD, 1e-6).is_some());
        assert!(rise_ahead(&c, &values, MOST_AHEAD + 1, 1e-6).is_none());
    }
}
