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
/// Nearer than this, as a part of a step, two looks are one.
const ENOUGH: f64 = 1e-6;

/// Where in a step all sprags have been looked at for the top of one figure: those of the others lie near by.
struct Looks<const N: usize> {
    dense: Option<Dense<N>>,
    /// Ascending, as parts of the step.
    at: Vec<f64>,
    seen: Vec<Vec<Probe>>,
    bearing_n: Vec<f64>,
}

impl<const N: usize> Default for Looks<N> {
    fn default() -> Self {
        Self { dense: None, at: Vec::new(), seen: Vec::new(), bearing_n: Vec::new() }
    }
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
                let (probes, held) = (&self.rhs.probes, &self.rhs.bearing_probes_n);
                let values: [f64; PROBES] =
                    std::array::from_fn(|j| self.figure(g, figure, &probes[j], held[j]));
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
            let value = |j: usize| self.figure(g, figure, &looks.seen[j], looks.bearing_n[j]);
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
        looks.seen.insert(place, (0..self.groups.len()).map(|g| self.rhs.probe(g, t, &y)).collect());
        looks.bearing_n.insert(place, self.rhs.bearing_n(&y));
        Ok(true)
    }

    /// A figure where `seen` is seen of all and the bearings hold `bearing_n`, N.
    fn figure(&self, g: usize, figure: Watched, seen: &[Probe], bearing_n: f64) -> f64 {
        let own = &seen[g].figures;
        let loaded_n = self.groups[g].model.loaded_n;
        match figure {
            Watched::Normal => own[N_BI],
            Watched::Tan(contact) if own[N_BI] >= loaded_n => own[contact],
            Watched::Tan(_) => 0.0,
            Watched::Share => self.share(own[N_BI], |g| seen[g].figures[N_BI], loaded_n),
            Watched::Bearing => bearing_n,
        }
    }

    /// Axis of the inner race against that of the outer in the frame of the mean speed, m.
    fn axis_m(&self, t: f64, y: &[f64; N]) -> [f64; 2] {
        let Some(axes) = self.rhs.axes else { return [0.0; 2] };
        let [[x, across], _] = axes.shift(y, self.groups.len());
        let offset = axes.offset_m(t, [y[0], y[1]]);
        [offset[0] + x, offset[1] + across]
    }

    /// `own` over the mean of all; 0 where that is less than `loaded_n`, N.
    fn share(&self, own: f64, normal_n: impl Fn(usize) -> f64, loaded_n: f64) -> f64 {
        let (mut sum, mut all) = (0.0, 0.0);
        for (g, group) in self.groups.iter().enumerate() {
            (sum, all) = (sum + group.model.count * normal_n(g), all + group.model.count);
        }
        let mean = sum / all;
        if mean > 0.0 && mean >= loaded_n { own / mean } else { 0.0 }
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
