//! Evaluations of a clutch, and the slopes of its margins beside one.

use super::{ClutchProblem, LoadedRows, StateAt, Way};
use crate::clutch::{Scenario, ScenarioKind};
use crate::design::{Design, Link};
use crate::fidelity;
use crate::margin::{
    LoadRows, LoadState, Margin, SceneDemand, scene_margins, scene_rows, unknown_scene_rows,
};
use crate::optimise::evaluate::{Evaluate, Evaluation, NoEvaluation};
use crate::scenario::{AtRest, Prepared, RollingTrack, demand_read_again, demand_retraced};
use std::collections::{HashMap, VecDeque};
use std::sync::{Arc, Mutex};

/// What an evaluation stood on: by the number of the corner its load state and the rows of that, by that number and the name of the
/// scene what that integrated and for which model.
#[derive(Debug, Default)]
struct Tracks {
    states: HashMap<usize, Arc<LoadState>>,
    loaded: HashMap<usize, LoadRows>,
    scenes: HashMap<(usize, String), (RollingTrack, Prepared)>,
}

/// Points beside an evaluation, and by how much each changes its measures.
type Answered = (Vec<Vec<f64>>, Vec<Vec<f64>>);

/// A quick evaluation: where, its tracks, and the changes that were asked for beside it.
#[derive(Debug)]
struct Past {
    x: Vec<f64>,
    tracks: Arc<Tracks>,
    asked: Option<Answered>,
}

/// The latest of them, so that slopes there need not integrate again; what is not there any more comes to the same bits. A problem
/// that is another begins without.
#[derive(Debug, Default)]
pub(super) struct Recent(Mutex<VecDeque<Past>>);

impl Recent {
    /// As many as climbs side by side may ask for before one of them comes back to its own: a megabyte each.
    const MOST: usize = 32;

    /// What `what` finds in the evaluation at `x`.
    fn at<T>(&self, x: &[f64], what: impl FnOnce(&mut Past) -> Option<T>) -> Option<T> {
        let mut known = self.0.lock().unwrap_or_else(|e| e.into_inner());
        known.iter_mut().find(|past| past.x == x).and_then(what)
    }

    /// Steps that a scene took at a corner in the evaluation before: about those that it will take.
    pub(super) fn steps(&self, corner: usize, scene: &str) -> usize {
        let known = self.0.lock().unwrap_or_else(|e| e.into_inner());
        let scenes = known.front().map(|past| &past.tracks.scenes);
        let track = scenes.and_then(|scenes| scenes.get(&(corner, scene.to_owned())));
        track.map_or(0, |(track, _)| track.steps())
    }

    fn keep(&self, x: &[f64], tracks: &Arc<Tracks>) {
        let mut known = self.0.lock().unwrap_or_else(|e| e.into_inner());
        known.truncate(Self::MOST - 1);
        known.push_front(Past { x: x.to_vec(), tracks: tracks.clone(), asked: None });
    }
}

impl Clone for Recent {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl ClutchProblem {
    /// The rows of a scene as a neighbour of the one whose track is given. `as_it_was`: the neighbour is that scene itself.
    fn scene_beside(
        &self,
        scenario: &Scenario,
        known: AtRest,
        track: Option<&(RollingTrack, Prepared)>,
        as_it_was: bool,
    ) -> Vec<Margin> {
        let moves = !matches!(scenario.kind, ScenarioKind::Static { .. } | ScenarioKind::Overrun { .. });
        let rows = |prepared: &Prepared, found| match found {
            Some(found) => {
                scene_rows(scenario, &SceneDemand::of(scenario, prepared, found), &self.limits, true)
            }
            None => unknown_scene_rows(scenario, &self.limits),
        };
        match track {
            None if moves => unknown_scene_rows(scenario, &self.limits),
            // Slopes are those of quick curves, whatever the run took.
            Some((track, prepared)) if as_it_was && prepared.model.curve.effort() == self.effort() => {
                rows(prepared, demand_read_again(prepared, track))
            }
            _ => match fidelity::plan_at(scenario, Some(known), self.effort()) {
                Ok((_, prepared)) => {
                    rows(&prepared, demand_retraced(&prepared, track.map(|(track, _)| track)))
                }
                Err(_) => scene_margins(scenario, &self.limits, true, Some(known), &self.fidelity.settings),
            },
        }
    }

    /// The evaluation at `x`, and what it stood on.
    fn tracked(&self, x: &[f64]) -> Result<(Evaluation, Arc<Tracks>), NoEvaluation> {
        let tracks = Mutex::new(Tracks::default());
        let kept = || tracks.lock().unwrap_or_else(|e| e.into_inner());
        let build = self.state();
        let state = |k: usize, design: &Design| {
            let state = build(k, design)?;
            kept().states.insert(k, state.clone());
            Ok(state)
        };
        let scene = |k: usize, scenario: &Scenario, known: AtRest| {
            let (rows, track) = self.scene(scenario, known);
            track.map(|track| kept().scenes.insert((k, scenario.name.clone()), track));
            rows
        };
        let loaded = |k: usize, design: &Design, state: &LoadState| {
            let found = self.loaded(design, state);
            let rows = found.rows.clone();
            kept().loaded.insert(k, found);
            rows
        };
        let assessed = self.assess_at_with(x, &Way { state: &state, loaded: &loaded, scene: &scene })?;
        let tracks = tracks.into_inner().unwrap_or_else(|e| e.into_inner());
        Ok((self.evaluation(&assessed), Arc::new(tracks)))
    }

    /// The outputs of the evaluation that `tracks` is of, at its own `x`, with every scene as a neighbour has it.
    fn here(&self, x: &[f64], tracks: &Tracks) -> Option<Vec<f64>> {
        let build = self.state();
        let state = |k: usize, design: &Design| {
            let known = tracks.states.get(&k).cloned().map_or_else(|| build(k, design), Ok)?;
            Ok(Arc::new(LoadState { at_speeds: known.at_speeds.for_slopes(), ..(*known).clone() }))
        };
        let loaded = |k: usize, design: &Design, state: &LoadState| {
            tracks.loaded.get(&k).map_or_else(|| self.loaded(design, state).rows, |found| found.rows.clone())
        };
        self.retraced(x, tracks, (&state, &loaded), true)
    }

    /// The same at a neighbour `x` of it.
    fn beside(&self, x: &[f64], tracks: &Tracks) -> Option<Vec<f64>> {
        let state = |k: usize, design: &Design| {
            let state = self.state_beside(design, tracks.states.get(&k).map(Arc::as_ref))?;
            let looks = tracks.loaded.get(&k).map(|found| found.deciding.clone());
            Ok(Arc::new(LoadState { looks, ..state }))
        };
        let loaded = |_: usize, design: &Design, state: &LoadState| self.loaded(design, state).rows;
        self.retraced(x, tracks, (&state, &loaded), false)
    }

    /// Outputs at `x` with these load states and rows of them, and every scene as the neighbour of the one in `tracks`; NaN where that has
    /// none.
    fn retraced(
        &self,
        x: &[f64],
        tracks: &Tracks,
        (state, loaded): (&StateAt, &LoadedRows),
        as_it_was: bool,
    ) -> Option<Vec<f64>> {
        let scene = |k: usize, scenario: &Scenario, known: AtRest| {
            let track = tracks.scenes.get(&(k, scenario.name.clone()));
            self.scene_beside(scenario, known, track, as_it_was)
        };
        let assessed = self.assess_at_with(x, &Way { state, loaded, scene: &scene }).ok()?;
        Some(self.evaluation(&assessed).outputs())
    }
}

impl Evaluate for ClutchProblem {
    fn threads_are_free(&self) -> bool {
        self.climbs.leave_threads()
    }

    fn evaluate(&self, x: &[f64]) -> Result<Evaluation, NoEvaluation> {
        let (found, tracks) = self.tracked(x)?;
        if self.quick {
            self.recent.keep(x, &tracks);
        }
        Ok(found)
    }

    /// Of a search's quick evaluations. What a static state demands has its own equilibria at each point, to 1e-12, what a scene
    /// demands its run taken again by the neighbour ([`demand_retraced`]). Without a change: demands that are bisected, because the
    /// motion unloads the contact, and found, and scenes that do more than roll; and everything where lengths go with a variable in steps.
    fn changes(&self, x: &[f64], beside: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
        let in_steps = |(name, link): &(String, Link)| link.step.is_some() && self.variables.contains(name);
        if !self.quick || self.links.iter().any(in_steps) {
            return None;
        }
        let asked_before = |past: &mut Past| past.asked.clone().filter(|(points, _)| points == beside);
        if let Some((_, changes)) = self.recent.at(x, asked_before) {
            return Some(changes);
        }
        let tracks = match self.recent.at(x, |past| Some(past.tracks.clone())) {
            Some(known) => known,
            None => self.tracked(x).ok()?.1,
        };
        let of = |(_, at): (usize, &Vec<f64>)| self.beside(at, &tracks);
        let (here, there) =
            self.climbs.both(|| self.here(x, &tracks), || self.climbs.each(beside, |_| 0, of));
        let here = here?;
        let change = |there: Option<Vec<f64>>| match there {
            Some(there) if there.len() == here.len() => there.iter().zip(&here).map(|(b, a)| b - a).collect(),
            _ => Vec::new(),
        };
        let changes: Vec<Vec<f64>> = there.into_iter().map(change).collect();
        let answered = Some((beside.to_vec(), changes.clone()));
        self.recent.at(x, |past| past.asked.replace(answered?));
        Some(changes)
    }
}
