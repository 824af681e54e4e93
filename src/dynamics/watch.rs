//! What a run remembers of each step: located extremes and samples, never read off step ends alone.

use super::events::{FIGURES, N_BE, N_BI, Probe, probe};
use super::model::{Grip, Mode, Model, SLIP};
use super::probes::{Observed, Probes, parabola};
use super::repeat::Repeat;
use super::run::{Run, RunSettings, Sample};
use crate::ode::adaptive::Size;
use crate::ode::step::{Dense, Step};
use nalgebra::Const;

/// What watches a run.
pub(super) struct Watch<'a> {
    model: &'a Model,
    settings: &'a RunSettings,
    /// The equidistant sample that comes next.
    pub(super) next_sample: usize,
}

/// A record of a figure: when, s, what, N_bi there, N, and the state.
struct Top<const N: usize> {
    t: f64,
    value: f64,
    normal_n: f64,
    state: [f64; N],
}

/// The larger |T|/N of the contacts that stick in `mode` where A carries [`Model::loaded_n`] or more; else 0.
fn asked_under_load(model: &Model, mode: &Mode, seen: &Probe) -> f64 {
    let [inner, outer, _, n_bi, _] = seen.figures;
    let of = |sticks: bool, asked: f64| if sticks && n_bi >= model.loaded_n { asked } else { 0.0 };
    of(mode.inner == Grip::Stick, inner).max(of(mode.outer == Grip::Stick && !model.outer_holds, outer))
}

impl<'a> Watch<'a> {
    pub(super) fn new(model: &'a Model, settings: &'a RunSettings) -> Self {
        Self { model, settings, next_sample: 0 }
    }

    /// Extremes and samples inside a step of `run`, those of a template too.
    pub(super) fn step<const N: usize>(
        &mut self,
        run: &mut Run<N>,
        repeat: Option<&mut Repeat<N>>,
        step: &Step<N>,
        probes: &Probes,
        rhs: &mut Observed,
    ) -> Result<(), ()>
    where
        Const<N>: Size,
    {
        let (mode, model) = (run.mode, self.model);
        let (start, length) = (step.t(), step.h());
        let t_end = start + length;
        let mut peaks = run.peaks;
        let samples = self.settings.samples;
        let wants_sample =
            samples > 0 && self.next_sample < samples && self.sample_time(self.next_sample) <= t_end;
        let mut dense = None;
        for (i, (&bound, best)) in self.bounds().iter().zip(peaks.figures()).enumerate() {
            let value = |seen: &Probe| seen.figures[i];
            if let Some(top) = self.record(run, &mut dense, step, probes, rhs, (best, bound), value)? {
                peaks.keep(i, top.t, top.value, top.normal_n);
                self.keep_extreme(run, i, top.t, top.state);
            }
        }
        if let Some(best) = run.asked_under_load.filter(|_| run.engaged.is_some()) {
            let value = |seen: &Probe| asked_under_load(model, &mode, seen);
            let bounds = (best, f64::INFINITY);
            if let Some(top) = self.record(run, &mut dense, step, probes, rhs, bounds, value)? {
                run.asked_under_load = Some(top.value);
            }
        }
        if samples > 0 {
            for j in 0..probes.count() {
                let seen = probes.get(j);
                // No more than a parabola can rise between the probes.
                let radial = |j: usize| probes.get(j).radial_m_s2.abs();
                let rate = |j: usize| probes.get(j).outer_rate_rad_s.abs();
                let [radial, rate] =
                    [radial(j) + probes.overshoot(j, radial), rate(j) + probes.overshoot(j, rate)];
                run.neglected.note(radial, seen.figures[N_BE], rate);
            }
        }
        if wants_sample {
            let d = match dense {
                Some(d) => d,
                None => step.dense(rhs, &mut run.counters)?,
            };
            while self.next_sample < samples && self.sample_time(self.next_sample) <= t_end {
                let t = self.sample_time(self.next_sample);
                let state = d.at(t);
                let sample = self.sample(run, t, state);
                run.samples.push(sample);
                self.next_sample += 1;
            }
        }
        run.peaks = peaks;
        if let Some(repeat) = repeat.filter(|repeat| samples > 0 && repeat.wants_template(t_end)) {
            let d = step.dense(rhs, &mut run.counters)?;
            repeat.sample_template(t_end, |t| self.sample(run, t, d.at(t)));
        }
        Ok(())
    }

    /// The largest `value`, `bound` at most, inside a step of `run` where that is above `best`.
    #[allow(clippy::too_many_arguments)]
    fn record<const N: usize>(
        &self,
        run: &mut Run<N>,
        dense: &mut Option<Dense<N>>,
        step: &Step<N>,
        probes: &Probes,
        rhs: &mut Observed,
        (mut best, bound): (f64, f64),
        value: impl Fn(&Probe) -> f64,
    ) -> Result<Option<Top<N>>, ()>
    where
        Const<N>: Size,
    {
        let (start, length, mode) = (step.t(), step.h(), run.mode);
        let fine = 1e-3 * self.settings.tolerance;
        let value_at = |j: usize| value(probes.get(j)).min(bound);
        let mut top = None;
        for (j, t) in [(0, start), (probes.count() - 1, start + length)] {
            if value_at(j) > best {
                best = value_at(j);
                let state = if j == 0 { run.state } else { *step.y1() };
                top = Some(Top { t, value: best, normal_n: probes.get(j).figures[N_BI], state });
            }
        }
        for j in 0..probes.count() {
            let enough = best + fine * best.abs();
            if enough >= bound {
                break;
            }
            let (left, right) = probes.beside(j);
            let is_top = value_at(j) >= value_at(left) && value_at(j) >= value_at(right);
            if is_top && value_at(j) + probes.overshoot(j, value_at) > enough {
                let d = match dense {
                    Some(d) => d,
                    None => dense.insert(step.dense(rhs, &mut run.counters)?),
                };
                let seen = |theta: f64| {
                    let elapsed = theta * length;
                    probe(self.model, &mode, start + elapsed, &d.after(elapsed), false)
                };
                let inside = |theta: f64| value(&seen(theta));
                let (from, guess, until) = (probes.at(left), probes.extreme(j, value_at), probes.at(right));
                let (theta, found) = highest(from, guess, until, enough, fine * value_at(j).abs(), inside);
                if found > best {
                    best = found.min(bound);
                    let (t, state) = (start + theta * length, d.after(theta * length));
                    top = Some(Top { t, value: best, normal_n: seen(theta).figures[N_BI], state });
                }
            }
        }
        Ok(top)
    }

    /// What no figure can exceed: a real clutch slips at mu_s and has no tension. Pure rolling knows no such bounds.
    fn bounds(&self) -> [f64; FIGURES] {
        if self.settings.rolling {
            return [f64::INFINITY; FIGURES];
        }
        let mu = self.model.friction.static_;
        let outer = if self.model.outer_holds { f64::INFINITY } else { mu };
        [mu, outer, 0.0, f64::INFINITY, f64::INFINITY]
    }

    pub(super) fn sample_time(&self, i: usize) -> f64 {
        let [from, until] = self.settings.history.window_s.unwrap_or([0.0, self.settings.duration_s]);
        from + (until - from) * i as f64 / (self.settings.samples.max(2) - 1) as f64
    }

    /// `state` at `t` (s) within the step that begins where `run` stands.
    fn sample<const N: usize>(&self, run: &Run<N>, t: f64, state: [f64; N]) -> Sample<N> {
        let (mode, records) = (run.mode, [run.inner, run.outer]);
        let slips = mode.slips_under_load();
        let slip_m = std::array::from_fn(|i| {
            records[i].net_m + if slips[i] { state[SLIP + i] - run.state[SLIP + i] } else { 0.0 }
        });
        Sample { t, state, slip_m, forces: self.model.forces(&mode, t, &state), mode }
    }

    /// Whether something at `t` (s) is to be a sample beside the equidistant ones.
    fn marks(&self, t: f64) -> bool {
        let RunSettings { samples, history, .. } = self.settings;
        *samples > 0 && history.marks && history.window_s.is_none_or(|[from, until]| from <= t && t <= until)
    }

    /// The mode of `run` has changed at `t` (s).
    pub(super) fn mark<const N: usize>(&self, run: &mut Run<N>, t: f64) {
        if self.marks(t) && run.marked < self.settings.samples {
            run.samples.push(self.sample(run, t, run.state));
            run.marked += 1;
        }
    }

    /// Extreme `i` of `run` so far is at `t` (s).
    fn keep_extreme<const N: usize>(&self, run: &mut Run<N>, i: usize, t: f64, state: [f64; N]) {
        if self.marks(t) {
            run.extremes[i] = Some(self.sample(run, t, state));
        }
    }

    /// Extremes of N_bi where `run` begins.
    pub(super) fn begin<const N: usize>(&self, run: &mut Run<N>) {
        let f = self.model.forces(&run.mode, run.t_s, &run.state);
        let p = &mut run.peaks;
        p.normal_min_n = p.normal_min_n.min(f.n_bi);
        p.normal_max_n = p.normal_max_n.max(f.n_bi);
    }
}

/// The extremes of `run` join its samples.
pub(super) fn sample_extremes<const N: usize>(run: &mut Run<N>) {
    run.samples.extend(run.extremes.iter_mut().filter_map(Option::take));
    run.samples.sort_by(|a, b| a.t.total_cmp(&b.t));
}

/// Place and value of the largest value of a smooth function with one hump on [a, b], looked for about `guess` first:
/// parabolas through the last three points, golden sections where those leave the bracket; to 1e-5 of [a, b], so 1e-10
/// in the value, or until what is left to climb is below `fine`, at most or by a second parabola. Given up as soon as
/// `worth` cannot be reached any more: a hump that is no record is not climbed.
pub(super) fn highest(
    mut a: f64,
    guess: f64,
    mut b: f64,
    worth: f64,
    fine: f64,
    mut f: impl FnMut(f64) -> f64,
) -> (f64, f64) {
    const GOLDEN: f64 = 0.381_966_011_250_105_1;
    let enough = 1e-5 * (b - a);
    // Three points about the guess, or about the top of the parabola through those; the whole of [a, b] where neither holds it.
    let near = 0.1 * (b - a);
    let (mut m, mut fa, mut fm, mut fb) = (guess, 0.0, 0.0, 0.0);
    for tries in 0..3 {
        let from = if tries < 2 { (m - near).clamp(a, b - 2.0 * near) } else { a };
        let until = if tries < 2 { from + 2.0 * near } else { b };
        if !(from < m && m < until) || tries == 2 {
            m = 0.5 * (from + until);
        }
        (fa, fm, fb) = (f(from), f(m), f(until));
        if fm >= fa && fm >= fb || tries == 2 {
            (a, b) = (from, until);
            break;
        }
        // Higher at one of them, which may be an end that the function does not turn before.
        let (bend, top) = parabola([from, m, until], [fa, fm, fb]);
        let rises = fb > fa;
        let at_end = if rises { until >= b - enough } else { from <= a + enough };
        if at_end && (bend >= 0.0 || top <= from || top >= until) {
            return if rises { (until, fb) } else { (from, fa) };
        }
        // No record, not even with its top half of [a, b] away.
        if fa.max(fb) + 0.25 * bend.abs() * (b - a).powi(2) < worth {
            return (m, fm);
        }
        m = if bend < 0.0 {
            top.clamp(a, b)
        } else if rises {
            b
        } else {
            a
        };
    }
    for i in 0..20 {
        // The parabola's top lies above the nearest of its points by at most g^2/4 |bend|, g the wider gap.
        let (bend, mut x) = parabola([a, m, b], [fa, fm, fb]);
        let gap = (m - a).max(b - m);
        let left = 0.5 * bend.abs() * gap * gap;
        if left < fine || fm.max(fa).max(fb) + left < worth {
            break;
        }
        // Every third step in the larger part, or a bracket might shrink from one side for ever.
        let nothing = i > 0 && bend.abs() * (x - m) * (x - m) < 0.1 * fine;
        if !(x > a && x < b) || i % 3 == 2 && !nothing {
            x = if b - m > m - a { m + GOLDEN * (b - m) } else { m - GOLDEN * (m - a) };
        } else if nothing || (x - m).abs() < enough {
            break;
        }
        let fx = f(x);
        match (fx > fm, x > m) {
            (true, true) => (a, fa) = (m, fm),
            (true, false) => (b, fb) = (m, fm),
            (false, true) => (b, fb) = (x, fx),
            (false, false) => (a, fa) = (x, fx),
        }
        if fx > fm {
            (m, fm) = (x, fx);
        }
        if b - a < enough {
            break;
        }
    }
    if fm >= fa && fm >= fb {
        (m, fm)
    } else if fa > fb {
        (a, fa)
    } else {
        (b, fb)
    }
}

#[cfg(test)]
mod tests {
    use super::highest;

    #[test]
    fn the_top_of_a_hump_is_found_inside_and_at_an_end() {
        for top in [0.05, 0.3, 0.5, 0.77, 1.0] {
            for guess in [0.0, top - 0.05, top, 0.5, 1.0] {
                let (x, value) = highest(0.0, guess, 1.0, 0.0, 0.0, |x: f64| (1.3 * (x - top)).cos());
                assert!((x - top).abs() < 1e-4 && (value - 1.0).abs() < 1e-9, "{top} {guess}: {x} {value}");
            }
        }
        assert_eq!(highest(0.0, 1.0, 1.0, 0.0, 0.0, |x| x).0, 1.0);
        // One that is no record.
        let asked = std::cell::Cell::new(0);
        highest(0.0, 0.4, 1.0, 1.3, 0.0, |x: f64| {
            asked.set(asked.get() + 1);
            (1.3 * (x - 0.5)).cos()
        });
        assert!(asked.get() <= 5, "{}", asked.get());
        // A kink.
        assert!((highest(0.0, 0.4, 1.0, -1.0, 0.0, |x: f64| -(x - 0.3).abs()).1).abs() < 1e-3);
    }
}
