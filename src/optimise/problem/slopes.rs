//! Evaluations of a clutch, and the slopes of its margins beside one.

use super::{ClutchProblem, Way};
use crate::clutch::{Scenario, ScenarioKind};
use crate::design::{Design, Link};
use crate::fidelity;
use crate::margin::{
    LoadState, Margin, SceneDemand, ends_decide, scene_margins, scene_rows, unknown_scene_rows,
};
use crate::optimise::evaluate::{Evaluate, Evaluation, NoEvaluation};
use crate::scenario::{AtRest, RollingTrack, demand_retraced};
use rayon::prelude::*;
use std::collections::{HashMap, VecDeque};
use std::sync::atomic::{AtomicBool, Ordering};
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
            return unknown_scene_rows(scenario, &self.limits);
        }
        let Ok((_, prepared)) = fidelity::plan_at(scenario, Some(known), self.effort()) else {
            return scene_margins(scenario, &self.limits, true, Some(known), &self.fidelity.settings);
        };
        match demand_retraced(&prepared, track) {
            Some(found) => {
                scene_rows(scenario, &SceneDemand::of(scenario, &prepared, found), &self.limits, true)
            }
            None => unknown_scene_rows(scenario, &self.limits),
        }
    }

    /// The evaluation at `x`, and what its scenes integrated.
    fn tracked(&self, x: &[f64]) -> Result<(Evaluation, Arc<Tracks>), NoEvaluation> {
        let tracks = Mutex::new(Tracks::new());
        let keep = |of: (usize, String), track| {
            tracks.lock().unwrap_or_else(|e| e.into_inner()).insert(of, track);
        };
        let scene = |k: usize, scenario: &Scenario, known: AtRest| {
            let (rows, track) = self.scene(scenario, known);
            keep((k, scenario.name.clone()), track);
            rows
        };
        let assessed = self.assess_at_with(x, &self.in_whole(&scene))?;
        let tracks = tracks.into_inner().unwrap_or_else(|e| e.into_inner());
        Ok((self.evaluation(&assessed), Arc::new(tracks)))
    }

    /// The evaluation at `x` with every scene as the neighbour of one whose track `tracks` holds; NaN where there is none.
    /// `ends_alone`: known of a neighbour that [`ends_decide`]; `None`: to be seen.
    fn retraced(&self, x: &[f64], tracks: &Tracks, ends_alone: Option<bool>) -> Option<Here> {
        let all_decide = AtomicBool::new(true);
        let scene = |k: usize, scenario: &Scenario, known: AtRest| {
            let track = tracks.get(&(k, scenario.name.clone())).and_then(Option::as_ref);
            self.scene_beside(scenario, known, track)
        };
        let state = |design: &Design, state: LoadState| {
            let decide = ends_alone.unwrap_or_else(|| ends_decide(design, &self.limits, &state));
            all_decide.fetch_and(decide, Ordering::Relaxed);
            LoadState { ends_alone: decide, ..state }
        };
        let assessed = self.assess_at_with(x, &Way { state: &state, scene: &scene }).ok()?;
        let outputs = self.evaluation(&assessed).outputs();
        Some(Here { outputs, ends_decide: all_decide.into_inner() })
    }
}

impl Evaluate for ClutchProblem {
    fn evaluate(&self, x: &[f64]) -> Result<Evaluation, NoEvaluation> {
        let (found, tracks) = self.tracked(x)?;
        if self.quick {
            self.recent.keep(x, &tracks);
        }
        Ok(found)
    }

    /// Of a search's quick evaluations. What a static state demands has its own equilibria at each point, to 1e-12, what a scene
    /// demands its run taken again by the neighbour ([`demand_retraced`]). Without a change: demands that are bisected, because the
    /// motion unloads the contact, and scenes that do more than roll; and everything where lengths go with a variable in steps.
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
        let here = self.retraced(x, &tracks, None)?;
        let change = |at: &Vec<f64>| match self.retraced(at, &tracks, Some(here.ends_decide)) {
            Some(there) if there.outputs.len() == here.outputs.len() => {
                there.outputs.iter().zip(&here.outputs).map(|(b, a)| b - a).collect()
            }
            _ => Vec::new(),
        };
        let changes: Vec<Vec<f64>> = beside.par_iter().map(change).collect();
        let answered = Some((beside.to_vec(), changes.clone()));
        self.recent.at(x, |past| past.asked.replace(answered?));
        Some(changes)
    }
}
