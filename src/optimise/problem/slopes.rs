//! Evaluations of a clutch, and the slopes of its margins beside one.

use super::{ClutchProblem, Names, Way};
use crate::clutch::{Scenario, ScenarioKind};
use crate::design::{Design, Link};
use crate::fidelity;
use crate::margin::{LoadState, Margin, SceneDemand, ends_decide, scene_margins, scene_rows};
use crate::optimise::evaluate::{Evaluate, Evaluation, NoEvaluation};
use crate::scenario::{AtRest, RollingTrack, demand_retraced};
use rayon::prelude::*;
use std::cell::{Cell, RefCell};
use std::collections::{HashMap, VecDeque};
use std::sync::{Arc, Mutex};

/// What the scenes of an evaluation integrated, by the number of the corner and the name of the scene.
type Tracks = HashMap<(usize, String), Option<RollingTrack>>;

/// Points beside an evaluation, and by how much each changes its measures.
type Answered = (Vec<Vec<f64>>, Vec<Vec<f64>>);

/// A quick evaluation: where, its tracks, and the changes that were asked for beside it.
#[derive(Debug)]
struct Past {
    x: Vec<f64>,
    tracks: Arc<Tracks>,
    /// The scene of each of its numbers, where it has one.
    scenes: Vec<Option<String>>,
    asked: Option<Answered>,
}

/// The latest of them, so that slopes there need not integrate again; what is not there any more comes to the same bits. A problem
/// that is another begins without.
#[derive(Debug, Default)]
pub(super) struct Recent(Mutex<VecDeque<Past>>);

impl Recent {
    /// As many as climbs side by side may ask for before one of them comes back to its own: 30 kB each.
    const MOST: usize = 32;

    /// What `what` finds in the evaluation at `x`.
    fn at<T>(&self, x: &[f64], what: impl FnOnce(&mut Past) -> Option<T>) -> Option<T> {
        let mut known = self.0.lock().unwrap_or_else(|e| e.into_inner());
        known.iter_mut().find(|past| past.x == x).and_then(what)
    }

    fn keep(&self, x: &[f64], tracks: &Arc<Tracks>, scenes: Vec<Option<String>>) {
        let mut known = self.0.lock().unwrap_or_else(|e| e.into_inner());
        known.truncate(Self::MOST - 1);
        known.push_front(Past { x: x.to_vec(), tracks: tracks.clone(), scenes, asked: None });
    }
}

impl Clone for Recent {
    fn clone(&self) -> Self {
        Self::default()
    }
}

/// The tracks without those of scenes of which no number is wanted.
fn wanted_of(tracks: &Tracks, scenes: &[Option<String>], wanted: &[bool]) -> Arc<Tracks> {
    let unwanted = |name: &String| {
        let mut rows = scenes.iter().zip(wanted).filter(|(scene, _)| scene.as_ref() == Some(name)).peekable();
        rows.peek().is_some() && rows.all(|(_, wanted)| !*wanted)
    };
    let track = |(key, track): (&(usize, String), &Option<RollingTrack>)| {
        (key.clone(), track.clone().filter(|_| !unwanted(&key.1)))
    };
    Arc::new(tracks.iter().map(track).collect())
}

/// What the evaluation at a point says of those next to it.
struct Here {
    outputs: Vec<f64>,
    /// Whether [`ends_decide`] at every corner.
    ends_decide: bool,
}

impl ClutchProblem {
    /// The rows of a scene as a neighbour of the one whose track is given.
    fn scene_beside(&self, scenario: &Scenario, known: AtRest, track: Option<&RollingTrack>) -> Vec<Margin> {
        let moves = !matches!(scenario.kind, ScenarioKind::Static { .. } | ScenarioKind::Overrun { .. });
        if moves && track.is_none() {
            let unknown = SceneDemand::unknown(scenario);
            return scene_rows(scenario, &unknown, &self.limits, true);
        }
        let Ok((_, prepared)) = fidelity::plan_at(scenario, Some(known), self.effort()) else {
            return scene_margins(scenario, &self.limits, true, Some(known), &self.fidelity.settings);
        };
        let demand = match demand_retraced(&prepared, track) {
            Some(found) => SceneDemand::of(scenario, &prepared, found),
            None => SceneDemand::unknown(scenario),
        };
        scene_rows(scenario, &demand, &self.limits, true)
    }

    /// The evaluation at `x`, what its scenes integrated, and the scene of each of its numbers.
    fn tracked(&self, x: &[f64]) -> Result<(Evaluation, Arc<Tracks>, Vec<Option<String>>), NoEvaluation> {
        let tracks = RefCell::new(Tracks::new());
        let scene = |k: usize, scenario: &Scenario, known: AtRest| {
            let (rows, track) = self.scene(scenario, known);
            tracks.borrow_mut().insert((k, scenario.name.clone()), track);
            rows
        };
        let assessed = self.assess_at_with(x, &self.in_whole(&scene))?;
        let Names { objectives, limits } = self.names(&assessed);
        let scene_of = |code: String| {
            let (_, scene) = code.split_once(':')?;
            Some(scene.split(" @ ").next().unwrap_or(scene).to_owned())
        };
        let scenes = objectives.into_iter().chain(limits).map(scene_of).collect();
        Ok((self.evaluation(&assessed), Arc::new(tracks.into_inner()), scenes))
    }

    /// The evaluation at `x` with every scene as the neighbour of one whose track `tracks` holds; NaN where there is none.
    /// `ends_alone`: known of a neighbour that [`ends_decide`]; `None`: to be seen.
    fn retraced(&self, x: &[f64], tracks: &Tracks, ends_alone: Option<bool>) -> Option<Here> {
        let all_decide = Cell::new(true);
        let scene = |k: usize, scenario: &Scenario, known: AtRest| {
            let track = tracks.get(&(k, scenario.name.clone())).and_then(Option::as_ref);
            self.scene_beside(scenario, known, track)
        };
        let state = |design: &Design, state: LoadState| {
            let decide = ends_alone.unwrap_or_else(|| ends_decide(design, &self.limits, &state));
            all_decide.set(all_decide.get() && decide);
            LoadState { ends_alone: decide, ..state }
        };
        let assessed = self.assess_at_with(x, &Way { state: &state, scene: &scene }).ok()?;
        let outputs = self.evaluation(&assessed).outputs();
        Some(Here { outputs, ends_decide: all_decide.get() })
    }
}

impl Evaluate for ClutchProblem {
    fn evaluate(&self, x: &[f64]) -> Result<Evaluation, NoEvaluation> {
        let (found, tracks, scenes) = self.tracked(x)?;
        if self.quick {
            self.recent.keep(x, &tracks, scenes);
        }
        Ok(found)
    }

    /// Of a search's quick evaluations. What a static state demands has its own equilibria at each point,
    /// to 1e-12, what a scene demands its run taken again by the neighbour ([`demand_retraced`]). Without a change: demands that are bisected, because the
    /// motion unloads the contact, and scenes that do more than roll; and everything where lengths go with a variable in steps.
    fn changes(&self, x: &[f64], beside: &[Vec<f64>]) -> Option<Vec<Vec<f64>>> {
        self.changes_of(x, beside, &[])
    }

    /// A scene of which nothing is wanted is not taken again.
    fn changes_of(&self, x: &[f64], beside: &[Vec<f64>], wanted: &[bool]) -> Option<Vec<Vec<f64>>> {
        let in_steps = |(name, link): &(String, Link)| link.step.is_some() && self.variables.contains(name);
        if !self.quick || self.links.iter().any(in_steps) {
            return None;
        }
        let asked_before = |past: &mut Past| past.asked.clone().filter(|(points, _)| points == beside);
        let all = !wanted.contains(&false);
        if let Some((_, changes)) = self.recent.at(x, asked_before).filter(|_| all) {
            return Some(changes);
        }
        let (tracks, scenes) =
            match self.recent.at(x, |past| Some((past.tracks.clone(), past.scenes.clone()))) {
                Some(known) => known,
                None => self.tracked(x).ok().map(|(_, tracks, scenes)| (tracks, scenes))?,
            };
        let tracks = if all { tracks } else { wanted_of(&tracks, &scenes, wanted) };
        let here = self.retraced(x, &tracks, None)?;
        let change = |at: &Vec<f64>| match self.retraced(at, &tracks, Some(here.ends_decide)) {
            Some(there) if there.outputs.len() == here.outputs.len() => {
                there.outputs.iter().zip(&here.outputs).map(|(b, a)| b - a).collect()
            }
            _ => Vec::new(),
        };
        let changes: Vec<Vec<f64>> = beside.par_iter().map(change).collect();
        if all {
            let answered = Some((beside.to_vec(), changes.clone()));
            self.recent.at(x, |past| past.asked.replace(answered?));
        }
        Some(changes)
    }
}
