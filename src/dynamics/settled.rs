//! When a run that rolls may end before its scene: what is still to come stays below what has been.
//!
//! Damping takes away what a motion has begun with and leaves what its excitation keeps up, so most scenes ask for most within
//! their first periods. At [`PHASES`] of each period the figures are compared with those of a period before. Let d be the largest
//! difference of a figure. A swing that is lambda times itself after a period, lambda complex, |lambda| < 1, is d/|lambda - 1| away from
//! what stays, and differences change by |lambda - 1| of themselves. The run ends when no figure that comes [`SAFE`] times as far
//! above the present period is a record.

use super::events::FIGURES;
use super::probes::Grid;
use super::stick::{Pair, Rolls, Sight};
use crate::ode::dop853::{PROBES, hermite};

/// Parts of a period at which it is compared with the one before: uneven, so that no swing is met each time where it passes zero.
const PHASES: [f64; 8] = [0.0, 0.09, 0.23, 0.34, 0.47, 0.61, 0.72, 0.88];
/// Times what is still to come as the differences tell it: a choice.
const SAFE: f64 = 2.0;
/// Periods whose differences tell how fast they fall.
const KNOWN: usize = 4;
/// Where nothing repeats, periods that the run is taken to have: free swings die away by any clock.
const CLOCK: f64 = 32.0;

/// What one period was like, by figure.
#[derive(Debug, Clone, Copy)]
struct Period {
    /// The most that there was.
    high: [f64; FIGURES],
    /// Largest difference to the period before.
    off: [f64; FIGURES],
    /// Sums of squares of the differences of the period before, and of what differences have changed by since.
    squares: [[f64; FIGURES]; 2],
}

impl Period {
    const NEW: Self =
        Self { high: [f64::NEG_INFINITY; FIGURES], off: [0.0; FIGURES], squares: [[0.0; FIGURES]; 2] };

    /// A step with these `probes`, which lie within `range`, is of this period.
    fn rise(&mut self, range: &[[f64; 2]; FIGURES], probes: &[Sight]) {
        for (i, (high, [low, top])) in self.high.iter_mut().zip(range).enumerate() {
            if top + (top - low) > *high {
                let value = |j: usize| probes[j].figures[i];
                let most = (1..probes.len()).fold(0, |most, j| if value(j) > value(most) { j } else { most });
                *high = high.max(value(most) + Grid { at: &PROBES }.overshoot(most, value));
            }
        }
    }
}

/// What the last periods were like.
#[derive(Debug, Clone)]
pub(super) struct Settled {
    period_s: f64,
    /// Where the first of them began, s; NaN: the torque's course goes on.
    from_s: f64,
    /// Phases seen since.
    count: usize,
    /// Figures at the phases of the last period, and their differences to those before.
    before: [[[f64; FIGURES]; 2]; PHASES.len()],
    /// The last periods, the present one first.
    periods: [Period; KNOWN],
}

impl Settled {
    /// Of a run over `duration_s` under what repeats with `omega_rad_s`; 0: nothing does.
    pub(super) fn new(omega_rad_s: f64, duration_s: f64) -> Self {
        let period_s =
            if omega_rad_s > 0.0 { std::f64::consts::TAU / omega_rad_s } else { duration_s / CLOCK };
        Self {
            period_s,
            from_s: f64::NAN,
            count: 0,
            before: [[[f64::NAN; FIGURES]; 2]; PHASES.len()],
            periods: [Period::NEW; KNOWN],
        }
    }

    /// Look at the step of `rolls` that was taken up to `until_s`, whose probes lie within `range`. True: no figure of the time up to
    /// `end_s` can come to `records`.
    pub(super) fn after(
        &mut self,
        rolls: &mut Rolls,
        [until_s, end_s]: [f64; 2],
        range: &[[f64; 2]; FIGURES],
        records: &[f64; FIGURES],
    ) -> bool {
        if self.from_s.is_nan() {
            if rolls.next_knot_s(until_s).is_finite() {
                return false;
            }
            self.from_s = until_s;
        }
        if self.count >= KNOWN * PHASES.len() {
            self.periods[0].rise(range, &rolls.probed);
        }
        loop {
            let (periods, phase) = (self.count / PHASES.len(), self.count % PHASES.len());
            let t = self.from_s + (periods as f64 + PHASES[phase]) * self.period_s;
            if t > until_s {
                return false;
            }
            if phase == 0 && periods > 0 {
                // The first differences are of the second period, the first squares of the third.
                if periods > KNOWN + 1 && self.is_below(records, (end_s - t) / self.period_s) {
                    return true;
                }
                self.periods.rotate_right(1);
                self.periods[0] = Period::NEW;
                self.periods[0].rise(range, &rolls.probed);
            }
            let figures = rolls.sight(t, &between(&rolls.probed, t)).figures;
            let now = &mut self.periods[0];
            for (i, found) in figures.into_iter().enumerate() {
                let [value, last] = self.before[phase].map(|f| f[i]);
                let off = found - value;
                if off.is_nan() || off.abs() > now.off[i] {
                    now.off[i] = off.abs();
                }
                now.squares[0][i] += last * last;
                now.squares[1][i] += (off - last).powi(2);
                (self.before[phase][0][i], self.before[phase][1][i]) = (found, off);
            }
            self.count += 1;
        }
    }

    /// Whether the `left` periods to come stay below `records`.
    fn is_below(&self, records: &[f64; FIGURES], left: f64) -> bool {
        (0..FIGURES).all(|i| {
            let [d0, d1, d2, d3] = self.periods.map(|p| p.off[i]);
            let (recent, earlier) = (d0.max(d1), d2.max(d3));
            let ratio = (recent / earlier).sqrt();
            let sum = |k: usize| self.periods[0].squares[k][i] + self.periods[1].squares[k][i];
            let turned = (sum(1) / sum(0)).sqrt();
            let more = if ratio < 1.0 { (1.0 / turned.max(1.0 - ratio)).min(left) } else { left };
            let known = d0.is_finite() && d1.is_finite() && d2.is_finite() && d3.is_finite();
            known && self.periods[0].high[i] + SAFE * recent * more < records[i]
        })
    }
}

/// State at `t` (s) within a step that was `probed`, by cubics from probe to probe.
fn between(probed: &[Sight], t: f64) -> Pair {
    let k = probed[1..].iter().position(|p| t <= p.t).unwrap_or(probed.len() - 2);
    let (a, b) = (&probed[k], &probed[k + 1]);
    let h = b.t - a.t;
    let [slope_a, slope_b] = [a, b].map(|p| [p.y[2], p.y[3], p.rates[0], p.rates[1]]);
    hermite((t - a.t) / h, h, [&a.y, &b.y], [&slope_a, &slope_b])
}
