//! What a run remembers of each step: located extremes and samples, never read off step ends alone.

use super::driver::{Driver, LOOKS};
use super::events::look;
use super::model::{N_STATE, State};
use super::run::{Peaks, Sample};
use crate::ode::step::Step;

impl Driver<'_> {
    /// Extremes and samples inside the step, of which `values` are the figures at [`LOOKS`].
    pub(super) fn watch(
        &mut self,
        step: &Step<N_STATE>,
        values: [[f64; 5]; LOOKS.len()],
        rhs: &mut impl FnMut(f64, &State) -> Result<State, ()>,
    ) -> Result<(), ()> {
        let (mode, model, thetas) = (self.run.mode, self.model, LOOKS);
        let (start, length) = (step.t(), step.h());
        let t_end = start + length;
        let p = &mut self.run.peaks;
        let mut best = [p.tan_inner, p.tan_outer, -p.normal_min_n, p.normal_max_n, p.normal_outer_max_n];
        let mut at_s = p.at_s;
        let samples = self.settings.samples;
        let wants_sample =
            samples > 0 && self.next_sample < samples && self.sample_time(self.next_sample) <= t_end;
        let mut dense = None;
        for i in 0..best.len() {
            for (j, theta) in [(0, 0.0), (4, 1.0)] {
                if values[j][i] > best[i] {
                    (best[i], at_s[i]) = (values[j][i], start + theta * length);
                }
            }
            for j in 0..thetas.len() {
                let (left, right) = (j.saturating_sub(1), (j + 1).min(thetas.len() - 1));
                let peak = values[j][i];
                let top = peak >= values[left][i] && peak >= values[right][i];
                // The true peak of a parabola lies above the highest of three points by at most an eighth of
                // their second difference; twice that is allowed for before a look is thought idle.
                let m = j.clamp(1, thetas.len() - 2);
                let bend = (values[m - 1][i] - 2.0 * values[m][i] + values[m + 1][i]).abs();
                if top && peak + 0.25 * bend > best[i] {
                    let d = match &dense {
                        Some(d) => d,
                        None => dense.insert(step.dense(rhs, &mut self.run.counters)?),
                    };
                    let value = |theta: f64| {
                        let t = start + theta * length;
                        look(model, &mode, t, &d.at(t), false).figures[i]
                    };
                    let (theta, found) = golden(thetas[left], thetas[right], value);
                    if found > best[i] {
                        (best[i], at_s[i]) = (found, start + theta * length);
                    }
                }
            }
        }
        if wants_sample {
            let d = match dense {
                Some(d) => d,
                None => step.dense(rhs, &mut self.run.counters)?,
            };
            while self.next_sample < samples && self.sample_time(self.next_sample) <= t_end {
                let t = self.sample_time(self.next_sample);
                let state = d.at(t);
                self.run.samples.push(Sample { t, state, forces: model.forces(&mode, t, &state), mode });
                self.next_sample += 1;
            }
        }
        self.run.peaks = Peaks {
            tan_inner: best[0],
            tan_outer: best[1],
            normal_min_n: -best[2],
            normal_max_n: best[3],
            normal_outer_max_n: best[4],
            at_s,
        };
        Ok(())
    }

    fn sample_time(&self, i: usize) -> f64 {
        self.settings.duration_s * i as f64 / (self.settings.samples.max(2) - 1) as f64
    }

    /// Extremes of N_bi at one instant.
    pub(super) fn look(&mut self, y: State, t: f64) {
        let f = self.model.forces(&self.run.mode, t, &y);
        let p = &mut self.run.peaks;
        p.normal_min_n = p.normal_min_n.min(f.n_bi);
        p.normal_max_n = p.normal_max_n.max(f.n_bi);
    }
}

/// Place and value of the largest value of a unimodal function on [a, b].
fn golden(mut a: f64, mut b: f64, f: impl Fn(f64) -> f64) -> (f64, f64) {
    const RATIO: f64 = 0.618_033_988_749_894_9;
    let (mut c, mut d) = (b - RATIO * (b - a), a + RATIO * (b - a));
    let (mut fc, mut fd) = (f(c), f(d));
    for _ in 0..24 {
        if fc > fd {
            (b, d, fd) = (d, c, fc);
            c = b - RATIO * (b - a);
            fc = f(c);
        } else {
            (a, c, fc) = (c, d, fd);
            d = a + RATIO * (b - a);
            fd = f(d);
        }
    }
    if fc > fd { (c, fc) } else { (d, fd) }
}
