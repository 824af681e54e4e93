//! The pure-rolling run: how much friction would the scene need, and how near does contact come to opening?

use super::model::{Grip, Mode, Model, Place, State};
use super::retrace::RollingTrack;
use super::run::{Peaks, Run, RunSettings, Stop, run};
use super::stick::stuck;

/// What pure rolling demands.
#[derive(Debug, Clone)]
pub struct Rolling {
    /// Smallest static friction with which the scene sticks throughout: the peak of |T|/N. `None` where that says nothing:
    /// rolling would need tension, or the peak is where the contact all but unloads, below [`Model::loaded_n`]
    /// (|T|/N grows without bound as N falls to 0 with T != 0).
    pub required_friction: Option<f64>,
    /// Smallest N_bi, N; negative: the tension that rolling would need.
    pub normal_min_n: f64,
    /// Whether the run reached its end; otherwise the figures hold up to where it stopped.
    pub stop: Stop,
    /// The run itself.
    pub run: Run,
}

/// Run `model` from `state` with both contacts rolling whatever friction that takes.
pub fn rolling(model: &Model, state: State, place: Place, settings: &RunSettings) -> Rolling {
    let mode = both_roll(place);
    Rolling::of(model, run(model, state, mode, &RunSettings { rolling: true, ..settings.clone() }))
}

/// The same figures, peaks and their times, by the two equations that are left where both contacts roll; where those do not
/// hold, by [`rolling`] itself. `tolerance`: of the steps of the former. The state at the end is not kept.
pub fn rolling_quickly(
    model: &Model,
    state: State,
    place: Place,
    settings: &RunSettings,
    tolerance: f64,
) -> Rolling {
    rolling_tracked(model, state, place, settings, tolerance)
        .map_or_else(|| rolling(model, state, place, settings), |(found, _)| found)
}

/// The same with what [`rolling_retraced`] goes by; `None` where the two equations do not hold.
pub fn rolling_tracked(
    model: &Model,
    state: State,
    place: Place,
    settings: &RunSettings,
    tolerance: f64,
) -> Option<(Rolling, RollingTrack)> {
    let Place::Arc(arc) = place else { return None };
    let found = stuck(model, &state, place, &RunSettings { tolerance, ..settings.clone() })?;
    let mut run = Run::start(state, both_roll(place), 0);
    run.stop = if found.interrupted { Stop::Interrupted } else { Stop::Finished };
    (run.t_s, run.peaks, run.counters, run.events) = (found.t_s, found.peaks, found.counters, found.passed);
    Some((Rolling::of(model, run), RollingTrack::of(arc, found)))
}

/// The figures of a neighbour of the model whose `track` it is, by the same steps: differences of such figures are
/// derivatives. `None` where the neighbour goes another way.
pub fn rolling_retraced(model: &Model, state: State, place: Place, track: &RollingTrack) -> Option<Rolling> {
    Some(with_peaks(model, state, place, track.retraced(model, &state, place)?))
}

/// The same of the model whose `track` it is.
pub fn rolling_read_again(
    model: &Model,
    state: State,
    place: Place,
    track: &RollingTrack,
) -> Option<Rolling> {
    Some(with_peaks(model, state, place, track.read_again(model, &state)?))
}

fn with_peaks(model: &Model, state: State, place: Place, peaks: Peaks) -> Rolling {
    let mut run = Run::start(state, both_roll(place), 0);
    (run.stop, run.peaks) = (Stop::Finished, peaks);
    Rolling::of(model, run)
}

fn both_roll(place: Place) -> Mode {
    Mode {
        place: if matches!(place, Place::Open | Place::Carried) { Place::Arc(0) } else { place },
        inner: Grip::Stick,
        outer: Grip::Stick,
    }
}

impl Rolling {
    /// N_min over the static load, or over the largest where there is none; 0 where nothing ever presses or pulls.
    pub fn contact_margin(&self, static_n: f64) -> f64 {
        let scale = if static_n > 0.0 { static_n } else { self.run.peaks.normal_max_n };
        let margin = self.normal_min_n / scale;
        if margin.is_finite() { margin } else { 0.0 }
    }

    /// What a pure-rolling `run` of `model` demands.
    pub fn of(model: &Model, run: Run) -> Self {
        let p = run.peaks;
        let outer_asks = !model.outer_holds && p.tan_outer > p.tan_inner;
        let asked = if outer_asks { p.tan_outer } else { p.tan_inner };
        let loaded = p.normal_at_tan_n[usize::from(outer_asks)] >= model.loaded_n;
        let required = (p.normal_min_n > 0.0 && loaded).then_some(asked);
        Self { required_friction: required, normal_min_n: p.normal_min_n, stop: run.stop, run }
    }
}
