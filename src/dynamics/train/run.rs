//! Runs with a drivetrain: the same driver on a longer state.

use super::super::driver::Driver;
use super::super::model::{Mode, Model, N_STATE, State};
use super::super::run::{Engaged, Run, RunSettings, Sample};
use super::{MOST_MORE, Train};
use crate::ode::adaptive::Size;
use nalgebra::Const;

/// What the drivetrain did in a run: twist (rad) and rate of twist (rad/s) of each shaft that is integrated.
#[derive(Debug, Clone, PartialEq)]
pub struct TrainRun {
    /// As it stood at the start.
    pub train: Train,
    /// At the samples of the run.
    pub samples: Vec<[f64; MOST_MORE]>,
    /// At its end.
    pub end: [f64; MOST_MORE],
    /// When the clutch engaged.
    pub(super) engaged: Option<[f64; MOST_MORE]>,
}

/// Lengths of the state with a few shafts and with all: the work of a step goes with the length.
const SHORT: usize = N_STATE + 6;
const LONG: usize = N_STATE + MOST_MORE;

/// Integrate from `state` at t = 0 in `mode`, with the drivetrain of the model where it has one. `most_slip_m`: see
/// [`super::super::run_while_it_sticks`].
pub(in crate::dynamics) fn integrate(
    model: &Model,
    state: State,
    mode: Mode,
    settings: &RunSettings,
    most_slip_m: Option<f64>,
) -> Run {
    match &model.drive.train {
        None => {
            let mut driver = Driver::<N_STATE>::new(model, state, mode, settings);
            driver.end_by_slip(most_slip_m);
            driver.run()
        }
        Some(train) if N_STATE + 2 * train.free() <= SHORT => {
            together::<SHORT>(model, train, state, mode, settings, most_slip_m)
        }
        Some(train) => together::<LONG>(model, train, state, mode, settings, most_slip_m),
    }
}

fn together<const N: usize>(
    model: &Model,
    train: &Train,
    state: State,
    mode: Mode,
    settings: &RunSettings,
    most_slip_m: Option<f64>,
) -> Run
where
    Const<N>: Size,
{
    // The angle of what is driven is such that the start is one.
    let mut model = model.clone();
    let (train, more) = train.at_start(&model, &state, &mode);
    model.drive.train = Some(train.clone());
    let whole = std::array::from_fn(|i| if i < N_STATE { state[i] } else { more[i - N_STATE] });
    let mut driver = Driver::<N>::new(&model, whole, mode, settings);
    driver.end_by_slip(most_slip_m);
    shortened(driver.run(), train)
}

fn of_clutch<const N: usize>(y: &[f64; N]) -> State {
    std::array::from_fn(|i| y[i])
}

fn of_train<const N: usize>(y: &[f64; N]) -> [f64; MOST_MORE] {
    std::array::from_fn(|i| y.get(N_STATE + i).copied().unwrap_or(0.0))
}

fn sample<const N: usize>(s: Sample<N>) -> Sample {
    Sample { t: s.t, state: of_clutch(&s.state), slip_m: s.slip_m, forces: s.forces, mode: s.mode }
}

/// The run of the clutch, with that of the drivetrain beside it.
fn shortened<const N: usize>(run: Run<N>, train: Train) -> Run {
    let train = TrainRun {
        train,
        samples: run.samples.iter().map(|s| of_train(&s.state)).collect(),
        end: of_train(&run.state),
        engaged: run.engaged.map(|e| of_train(&e.state)),
    };
    Run {
        stop: run.stop,
        t_s: run.t_s,
        state: of_clutch(&run.state),
        mode: run.mode,
        inner: run.inner,
        outer: run.outer,
        carried_m: run.carried_m,
        open_s: run.open_s,
        longest_open_s: run.longest_open_s,
        peaks: run.peaks,
        slip_begins_n: run.slip_begins_n,
        asked_under_load: run.asked_under_load,
        events: run.events,
        counters: run.counters,
        zeno_closures: run.zeno_closures,
        inconsistent_choices: run.inconsistent_choices,
        fast_motion: run.fast_motion,
        energy: run.energy,
        slip_heat: run.slip_heat,
        samples: run.samples.into_iter().map(sample).collect(),
        marked: run.marked,
        extremes: run.extremes.map(|s| s.map(sample)),
        neglected: run.neglected,
        engaged: run.engaged.map(|e| Engaged {
            t_s: e.t_s,
            state: of_clutch(&e.state),
            place: e.place,
            inner: e.inner,
            outer: e.outer,
        }),
        hold: run.hold,
        stick: run.stick,
        modes: run.modes,
        jumps: run.jumps,
        train: Some(train),
    }
}
