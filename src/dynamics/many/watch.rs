//! What a run of many sprags remembers of each step: located extremes and samples.

use super::PROBES;
use super::found::ManySample;
use super::run::Going;
use crate::dynamics::events::{N_BI, Probe};
use crate::dynamics::probes::{Grid, parabola};
use crate::ode::dop853::{self, Dense, Step};

/// Of a figure that is a record, as a part of the tolerance: how nearly its top is found.
const FINE: f64 = 1e-3;
/// How far beside a guess of a top is looked first, as a part of the bracket.
const NEAR: f64 = 0.1;
/// Looks at most for one top.
const CLIMBS: usize = 20;
/// Looks through which a polynomial tells where a top lies, at least and at most.
const FEWEST: usize = 5;
const MOST_NEAR: usize = 7;
/// How far apart those lie at least, as a part of the first ones' way.
const APART: f64 = 0.01;
/// Nearer than this, as a part of a step, two looks are one.
const ENOUGH: f64 = 1e-6;

/// Where in a step all sprags have been looked at for the top of one figure: those of the others lie near by.
struct Looks<const N: usize> {
    dense: Option<Dense<N>>,
    /// Ascending, as parts of the step.
    at: Vec<f64>,
    seen: Vec<Vec<Probe>>,
    whole: Vec<Whole>,
}

/// What is of all sprags together at one time, N.
#[derive(Clone, Copy)]
struct Whole {
    /// Mean N_bi of those that run.
    mean_n: f64,
    /// What the bearings hold.
    bearing_n: f64,
}

impl<const N: usize> Default for Looks<N> {
    fn default() -> Self {
        Self { dense: None, at: Vec::new(), seen: Vec::new(), whole: Vec::new() }
    }
}

/// The top of the polynomial through some of the `looks` (where and what) that lies next to `guess` in `within`, if its last term there is
/// less than `fine`. None of them nearer to one another than `apart`, where rounding would be all that tells them apart.
fn crest(
    mut looks: Vec<(f64, f64)>,
    guess: f64,
    within: [f64; 2],
    apart: f64,
    fine: f64,
) -> Option<(f64, f64)> {
    looks.sort_by(|a, b| (a.0 - guess).abs().total_cmp(&(b.0 - guess).abs()));
    let mut near: Vec<(f64, f64)> = Vec::with_capacity(MOST_NEAR);
    for look in looks {
        if near.len() < MOST_NEAR && near.iter().all(|kept| (kept.0 - look.0).abs() >= apart) {
            near.push(look);
        }
    }
    let n = near.len();
    if n < FEWEST {
        return None;
    }
    // Divided differences.
    let mut c: Vec<f64> = near.iter().map(|at| at.1).collect();
    for order in 1..n {
        for i in (order..n).rev() {
            c[i] = (c[i] - c[i - 1]) / (near[i].0 - near[i - order].0);
        }
    }
    // Value, slope and second slope.
    let at = |x: f64| {
        let (mut value, mut slope, mut bend) = (c[n - 1], 0.0, 0.0);
        for k in (0..n - 1).rev() {
            let way = x - near[k].0;
            bend = bend * way + 2.0 * slope;
            slope = slope * way + value;
            value = value * way + c[k];
        }
        [value, slope, bend]
    };
    let mut top = guess;
    for _ in 0..4 {
        let [_, slope, bend] = at(top);
        top -= slope / bend;
    }
    let [value, slope, bend] = at(top);
    // Next to a look the value is known, but not where the top is: it counts as far off as the next one.
    let ways = near[1..n - 1].iter().map(|k| top - k.0);
    let last = c[n - 1] * (top - near[1].0) * ways.product::<f64>();
    let sits = bend < 0.0 && slope * slope < fine * -bend;
    (within[0] <= top && top <= within[1] && sits && last.abs() < fine).then_some((top, value))
}

/// A figure of one group whose largest value is kept.
#[derive(Clone, Copy)]
enum Watched {
    /// N_bi, N.
    Normal,
    /// |T|/N at this contact while A is loaded.
    Tan(usize),
    /// N_bi over the mean of all sprags that run, while that is loaded.
    Share,
    /// What the bearings hold, of all, N.
    Bearing,
}

impl<const N: usize> Going<'_, N> {
    /// Extremes of all groups in the step.
    pub(super) fn watch(&mut self, step: &Step<N>) -> Result<(), ()> {
        let mut looks = Looks::default();
        let whole: [Whole; PROBES] = std::array::from_fn(|j| Whole {
            mean_n: self.mean_n(&self.rhs.probes[j]),
            bearing_n: self.rhs.bearing_probes_n[j],
        });
        for g in 0..self.groups.len() {
            if self.rhs.motions[g].waits {
                continue;
            }
            for figure in [Watched::Normal, Watched::Tan(0), Watched::Tan(1), Watched::Share] {
                let course = &self.out.courses[g];
                let best = match figure {
                    Watched::Normal => course.normal_max_n,
                    Watched::Tan(contact) => course.tan[contact],
                    Watched::Share => course.share,
                    Watched::Bearing => continue,
                };
                let probes = &self.rhs.probes;
                let values: [f64; PROBES] =
                    std::array::from_fn(|j| self.figure(g, figure, &probes[j][g], &whole[j]));
                let found = self.most(step, &mut looks, g, figure, &values, best)?;
                let Some((part, most)) = found else { continue };
                let (t, course) = (step.t + part * step.h, &mut self.out.courses[g]);
                match figure {
                    Watched::Normal => (course.normal_max_n, course.normal_max_s) = (most, t),
                    Watched::Tan(contact) => course.tan[contact] = most,
                    Watched::Share => (course.share, course.share_s) = (most, t),
                    Watched::Bearing => {}
                }
            }
        }
        if self.rhs.axes.is_some() {
            let values = self.rhs.bearing_probes_n;
            let best = self.out.bearing_max_n;
            if let Some((part, most)) = self.most(step, &mut looks, 0, Watched::Bearing, &values, best)? {
                (self.out.bearing_max_n, self.out.bearing_max_s) = (most, step.t + part * step.h);
            }
            for y in [&step.y0, &step.y1] {
                let [x, y] = self.axis_m(step.t, y);
                self.out.axis_max_m = self.out.axis_max_m.max(x.hypot(y));
            }
        }
        Ok(())
    }

    /// Where, as a part of the step, and how large a figure is at its largest, if that is a record.
    fn most(
        &mut self,
        step: &Step<N>,
        looks: &mut Looks<N>,
        g: usize,
        figure: Watched,
        values: &[f64; PROBES],
        record: f64,
    ) -> Result<Option<(f64, f64)>, ()> {
        let (grid, mut best) = (Grid { at: &dop853::PROBES }, (f64::NAN, record));
        for j in [0, PROBES - 1] {
            if values[j] > best.1 {
                best = (dop853::PROBES[j], values[j]);
            }
        }
        let bound = match figure {
            Watched::Tan(_) => self.groups[g].model.friction.static_,
            Watched::Normal | Watched::Share | Watched::Bearing => f64::INFINITY,
        };
        let fine = FINE * self.settings.tolerance;
        for j in 0..PROBES {
            let enough = best.1 + fine * best.1.abs();
            if enough >= bound {
                break;
            }
            let (left, right) = grid.beside(j);
            let top = values[j] >= values[left] && values[j] >= values[right];
            // Where a load begins to count its figure jumps: what the probes see is enough.
            let smooth = values[left] > 0.0 && values[right] > 0.0;
            if !top || !smooth || values[j] + grid.overshoot(j, |j| values[j]) <= enough {
                if !smooth && values[j] > best.1 {
                    best = (dop853::PROBES[j], values[j]);
                }
                continue;
            }
            let between = [grid.at[left], grid.extreme(j, |j| values[j]), grid.at[right]];
            let found = self.climb(step, looks, (g, figure), between, enough, fine * values[j].abs())?;
            if found.1 > best.1 {
                best = found;
            }
        }
        best.1 = best.1.min(bound);
        Ok((best.1 > record).then_some(best))
    }

    /// The largest value of a figure in a part of the step, first looked for at its middle one, by parabolas through
    /// what has been looked at there, for whichever figure; given up where `worth` cannot be reached.
    fn climb(
        &mut self,
        step: &Step<N>,
        looks: &mut Looks<N>,
        (g, figure): (usize, Watched),
        [from, guess, until]: [f64; 3],
        worth: f64,
        fine: f64,
    ) -> Result<(f64, f64), ()> {
        let near = NEAR * (until - from);
        let middle = guess.clamp(from + near, until - near);
        for part in [middle - near, middle, middle + near] {
            self.look_at(step, looks, part, 0.5 * near)?;
        }
        let mut stride = near;
        let mut found = (middle, f64::NEG_INFINITY);
        for _ in 0..CLIMBS {
            let inside: Vec<usize> =
                (0..looks.at.len()).filter(|&j| looks.at[j] >= from && looks.at[j] <= until).collect();
            let value = |j: usize| self.figure(g, figure, &looks.seen[j][g], &looks.whole[j]);
            let values: Vec<f64> = inside.iter().map(|&j| value(j)).collect();
            let Some(m) = (0..inside.len()).max_by(|&a, &b| values[a].total_cmp(&values[b])) else { break };
            let at = |j: usize| looks.at[inside[j]];
            found = (at(m), values[m]);
            let next = if m == 0 || m + 1 == inside.len() {
                // It rises beyond what has been looked at.
                stride *= 2.0;
                if m == 0 { (at(m) - stride).max(from) } else { (at(m) + stride).min(until) }
            } else {
                let (x, f) = ([m - 1, m, m + 1].map(at), [m - 1, m, m + 1].map(|j| values[j]));
                let (bend, top) = parabola(x, f);
                let [below, above] = [x[1] - x[0], x[2] - x[1]];
                let gap = below.max(above);
                if found.1 + 0.5 * bend.abs() * gap * gap < worth {
                    break;
                }
                // Where the top lies, and how far a third slope, taken for one of the size of the second in a step, moves it.
                if bend.abs() * (top - x[1]).abs().max(below * above).powi(2) < 0.1 * fine {
                    break;
                }
                let all = (0..inside.len()).map(|j| (at(j), values[j])).collect();
                if let Some((part, value)) = crest(all, top, [x[0], x[2]], APART * near, 0.1 * fine) {
                    found = (part, value.max(found.1));
                    break;
                }
                let apart = 0.1 * gap * if above > below { 1.0 } else { -1.0 };
                if (top - x[1]).abs() < ENOUGH { x[1] + apart } else { top }
            };
            if next == found.0 || !self.look_at(step, looks, next, ENOUGH)? {
                break;
            }
        }
        Ok(found)
    }

    /// All sprags at a part of the step, unless they have been looked at nearer than `within`; whether that is new.
    fn look_at(&mut self, step: &Step<N>, looks: &mut Looks<N>, part: f64, within: f64) -> Result<bool, ()> {
        let place = looks.at.partition_point(|&at| at < part);
        let beside = [place.checked_sub(1), Some(place)].into_iter().flatten();
        if beside.filter_map(|j| looks.at.get(j)).any(|at| (at - part).abs() <= within) {
            return Ok(false);
        }
        let dense = match &looks.dense {
            Some(dense) => dense,
            None => looks.dense.insert(step.dense(&mut self.rhs, &mut self.out.counters)?),
        };
        let (t, y) = (step.t + part * step.h, dense.after(part * step.h));
        self.rhs.look::<true>(t, &y);
        looks.at.insert(place, part);
        let seen: Vec<_> = (0..self.groups.len()).map(|g| self.rhs.probe(g, t, &y)).collect();
        looks.whole.insert(place, Whole { mean_n: self.mean_n(&seen), bearing_n: self.rhs.bearing_n(&y) });
        looks.seen.insert(place, seen);
        Ok(true)
    }

    /// A figure where `seen` is seen of group `g` and `whole` of all.
    fn figure(&self, g: usize, figure: Watched, seen: &Probe, whole: &Whole) -> f64 {
        let own = &seen.figures;
        let loaded_n = self.groups[g].model.loaded_n;
        match figure {
            Watched::Normal => own[N_BI],
            Watched::Tan(contact) if own[N_BI] >= loaded_n => own[contact],
            Watched::Tan(_) => 0.0,
            Watched::Share if whole.mean_n > 0.0 && whole.mean_n >= loaded_n => own[N_BI] / whole.mean_n,
            Watched::Share => 0.0,
            Watched::Bearing => whole.bearing_n,
        }
    }

    /// Axis of the inner race against that of the outer in the frame of the mean speed, m.
    fn axis_m(&self, t: f64, y: &[f64; N]) -> [f64; 2] {
        let Some(axes) = self.rhs.axes else { return [0.0; 2] };
        let [[x, across], _] = axes.shift(y, self.groups.len());
        let offset = axes.offset_m(t, [y[0], y[1]]);
        [offset[0] + x, offset[1] + across]
    }

    /// Mean N_bi of all that run, N.
    fn mean_n(&self, seen: &[Probe]) -> f64 {
        let (mut sum, mut all) = (0.0, 0.0);
        for (group, seen) in self.groups.iter().zip(seen) {
            (sum, all) = (sum + group.model.count * seen.figures[N_BI], all + group.model.count);
        }
        sum / all
    }

    pub(super) fn sample_start(&mut self) {
        if self.settings.samples > 0 {
            let (t, y) = (self.t_s, self.y);
            self.keep(t, &y);
        }
    }

    pub(super) fn sample(&mut self, step: &dop853::Step<N>) -> Result<(), ()> {
        let many = self.settings.samples;
        let last = many.max(2) - 1;
        let time = |i: usize| self.settings.duration_s * i as f64 / last as f64;
        let mut dense = None;
        while self.out.samples.len() < many && time(self.out.samples.len()) <= step.t + step.h {
            let d = match &dense {
                Some(d) => d,
                None => {
                    let found = step.dense(&mut self.rhs, &mut self.out.counters)?;
                    dense.insert(found)
                }
            };
            let t = time(self.out.samples.len());
            let y = d.at(t);
            self.keep(t, &y);
        }
        Ok(())
    }

    fn keep(&mut self, t: f64, y: &[f64; N]) {
        self.rhs.look::<true>(t, y);
        let probes: Vec<_> = (0..self.groups.len()).map(|g| self.rhs.probe(g, t, y)).collect();
        self.out.samples.push(ManySample {
            t_s: t,
            races: [y[0], y[1], y[2], y[3]],
            normal_n: probes.iter().map(|p| p.figures[N_BI]).collect(),
            tan: probes.iter().map(|p| [p.figures[0], p.figures[1]]).collect(),
            motions: self.rhs.motions.clone(),
            axis_m: self.axis_m(t, y),
            bearing_n: self.rhs.bearing_n(y),
        });
    }
}

#[cfg(test)]
mod tests {
    use super::crest;

    /// A smooth top is told as nearly as is claimed or not at all, a kink is not taken for one.
    #[test]
    fn a_top_between_looks_is_told_to_what_is_claimed() {
        let fine = 1e-12;
        let looks = |of: &dyn Fn(f64) -> f64, width: f64| -> Vec<(f64, f64)> {
            [-1.0, -0.4, 0.15, 0.5, 0.62, 0.9, 1.1].map(|x| (width * x, of(width * x))).to_vec()
        };
        let skew = |x: f64| 1.0 / (1.0 + x * x * (1.0 + 0.5 * x));
        let kink = |x: f64| 1.0 - x.abs().powf(1.5);
        let mut told = 0;
        for i in 0..40 {
            let width = 0.8_f64.powi(i);
            let within = [-width, width];
            if let Some((at, value)) = crest(looks(&skew, width), 0.1 * width, within, 0.01 * width, fine) {
                told += 1;
                assert!((value - 1.0).abs() < 2.0 * fine, "{width}: {at} {value}");
            }
            assert!(
                width < 1e-6 || crest(looks(&kink, width), 0.1 * width, within, 0.01 * width, fine).is_none()
            );
        }
        assert!((10..40).contains(&told), "{told}");
    }
}
