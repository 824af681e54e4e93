//! What a run of many sprags remembers of each step: located extremes and samples.

use super::found::ManySample;
use super::run::Going;
use super::{PROBES, state_of};
use crate::dynamics::events::N_BI;
use crate::dynamics::model::Place;
use crate::dynamics::probes::Grid;
use crate::dynamics::watch::highest;
use crate::ode::dop853::{self, Dense, Step};

/// Of a figure that is a record, as a part of the tolerance: how nearly its top is found.
const FINE: f64 = 1e-3;

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
        let mut dense = None;
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
                let values: [f64; PROBES] = std::array::from_fn(|j| self.figure_at_probe(g, figure, j));
                let found = self.most(step, &mut dense, g, figure, &values, best)?;
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
            if let Some((part, most)) = self.most(step, &mut dense, 0, Watched::Bearing, &values, best)? {
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
        dense: &mut Option<Dense<N>>,
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
            if dense.is_none() {
                *dense = Some(step.dense(&mut self.rhs, &mut self.out.counters)?);
            }
            let Some(d) = dense.as_ref() else { return Err(()) };
            let value = |part: f64| self.figure(g, figure, step.t + part * step.h, &d.after(part * step.h));
            let (from, until) = (grid.at[left], grid.at[right]);
            let guess = grid.extreme(j, |j| values[j]);
            let found = highest(from, guess, until, enough, fine * values[j].abs(), value);
            if found.1 > best.1 {
                best = found;
            }
        }
        best.1 = best.1.min(bound);
        Ok((best.1 > record).then_some(best))
    }

    fn figure_at_probe(&self, g: usize, figure: Watched, j: usize) -> f64 {
        let seen = &self.rhs.probes[j];
        let own = &seen[g].figures;
        let loaded_n = self.groups[g].model.loaded_n;
        match figure {
            Watched::Normal => own[N_BI],
            Watched::Tan(contact) if own[N_BI] >= loaded_n => own[contact],
            Watched::Tan(_) => 0.0,
            Watched::Share => self.share(own[N_BI], |g| seen[g].figures[N_BI], loaded_n),
            Watched::Bearing => self.rhs.bearing_probes_n[j],
        }
    }

    fn figure(&mut self, g: usize, figure: Watched, t: f64, y: &[f64; N]) -> f64 {
        let loaded_n = self.groups[g].model.loaded_n;
        match figure {
            Watched::Normal => self.normal_n(g, t, y),
            Watched::Bearing => {
                self.rhs.look::<true>(t, y);
                self.rhs.bearing_n(y)
            }
            Watched::Tan(contact) => self.rhs.sight(g, t, y).figures[contact],
            Watched::Share => self.share(self.normal_n(g, t, y), |g| self.normal_n(g, t, y), loaded_n),
        }
    }

    /// N_bi of group `g` at y, N.
    fn normal_n(&self, g: usize, t: f64, y: &[f64; N]) -> f64 {
        let (model, motion) = (&self.groups[g].model, &self.rhs.motions[g]);
        if motion.waits || motion.mode.place == Place::Open {
            return 0.0;
        }
        let own = state_of(y, g);
        if model.hunt_crossley_s_per_m == 0.0 && !self.rhs.bends() {
            return model.point(motion.mode.place, own[0]).n_bi;
        }
        let sight = self.rhs.stands(g, motion.mode.place, t, y, &own);
        let rates = self.rhs.goes(g, &motion.mode, &sight, y, &own);
        model.damped(&sight.point, model.curve.speed_rad_s(), rates[0]).0
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
