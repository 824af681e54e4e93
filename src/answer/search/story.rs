//! Everything that was asked of one search, in order: the search, what would free it, flanks, front, tolerances.

use super::SearchSettings;
use crate::design::Design;
use crate::margin::Margin;
use crate::optimise::{
    Alone, Desk, Fidelity, Front, Loosened, NoSearch, OnGrid, Realised, Relief, Robust, RobustSearch, Search,
    SearchMethod, Settings, Status, Stepped, Variable, alone, front, loosened, realise, relief, robust,
    search, spread, stepped,
};
use crate::scenario;

/// Everything that was asked of one search; what a stop cuts off is left out.
#[derive(Debug, Clone)]
pub struct Story {
    /// The search.
    pub found: Search,
    /// Flanks for a centroid that was free, and the search carried on with them: the clutch that can be made.
    pub realised: Option<Realised>,
    /// Its lengths in steps.
    pub stepped: Option<Stepped>,
    /// The step that its lengths were to have, mm, where the search was stopped before.
    pub steps_missed_mm: Option<f64>,
    /// What would free an infeasible problem.
    pub relief: Option<Relief>,
    /// Single numbers let go in an infeasible problem, the variables with them.
    pub loosened: Vec<Loosened>,
    /// What the limits that do not hold come to one by one.
    pub alone: Vec<Alone>,
    /// Front.
    pub front: Option<Front>,
    /// The optimum as it may be made.
    pub within: Option<Robust>,
    /// The optimum that holds at every corner.
    pub robust: Option<RobustSearch>,
    /// Whether a robust design was asked for.
    pub wants_robust: bool,
    /// Seed of everything random.
    pub seed: u64,
    /// Whether it was stopped. A climb may have converged before others were; the search has not.
    pub stopped: bool,
    /// What was asked and could not be done.
    pub why: Vec<String>,
}

/// Search, and whatever else `settings` wants of what is found.
pub(super) fn run(design: &Design, settings: &SearchSettings, desk: &Desk) -> Result<Story, NoSearch> {
    settings.validate(design)?;
    let mut design = design.clone();
    let task = design.optimize.as_mut().ok_or(NoSearch::NoTask)?;
    task.step_mm = settings.step_mm.unwrap_or(task.step_mm);
    task.reserve = settings.reserve.unwrap_or(task.reserve);
    let seed = task.seed;
    let (starts, most_starts) = settings.climbs();
    let climb = Settings { max_evaluations: settings.evaluations, ..Settings::default() };
    let method = SearchMethod { climb, starts, most_starts, swarm: settings.swarm, seed };
    let scene = scenario::Settings { tolerance: settings.tolerance, ..Default::default() };
    let found = search(&design, &method, Fidelity { settings: scene, reduced: !settings.full }, desk)?;
    let mut story = Story {
        found,
        realised: None,
        stepped: None,
        steps_missed_mm: None,
        relief: None,
        loosened: Vec::new(),
        alone: Vec::new(),
        front: None,
        within: None,
        robust: None,
        wants_robust: settings.robust,
        seed,
        stopped: false,
        why: Vec::new(),
    };
    story.go_on(&design, settings, &method, desk);
    story.stopped = desk.stopped();
    if story.stopped {
        story.why.push("stopped; what was not reached is left out".to_owned());
    }
    Ok(story)
}

impl Story {
    fn go_on(&mut self, design: &Design, settings: &SearchSettings, method: &SearchMethod, desk: &Desk) {
        let Some(task) = &design.optimize else { return };
        let ended = matches!(self.found.outcome.status, Status::Infeasible { .. } | Status::Stalled(_));
        if ended && !self.found.feasible() {
            let (problem, outcome) = (&self.found.problem, &self.found.outcome);
            self.relief = Some(relief(design, problem, outcome, desk));
            if !desk.stopped() {
                self.loosened = loosened(design, &self.found, desk);
                self.alone = alone(&self.found, desk);
            }
        }
        if !self.found.feasible() {
            return;
        }
        if self.found.wants_centroid() && !desk.stopped() {
            match realise(&self.found, task, method, desk) {
                Ok(realised) => self.realised = realised,
                Err(why) => self.why.push(format!("the centroid cannot be realised: {why}")),
            }
        }
        if !self.feasible() || !self.makeable() {
            return;
        }
        match desk.stopped() {
            false => self.stepped = stepped(self.made(), task.step_mm, desk),
            true => self.steps_missed_mm = Some(task.step_mm).filter(|step_mm| *step_mm > 0.0),
        }
        if !settings.front.is_empty() && !desk.stopped() {
            match front(self.made(), task, &settings.front, settings.front_steps, method, desk) {
                Ok(front) => self.front = Some(front),
                Err(why) => self.why.push(format!("no front: {why}")),
            }
        }
        if let (true, Some(of), false) = (settings.robust, &design.tolerances, desk.stopped()) {
            let (problem, x) = (self.made().problem.clone(), self.x().to_vec());
            let draws = (settings.draws, method.seed);
            match spread(&problem, &x, of, draws, desk) {
                Ok(within) => self.within = Some(within),
                Err(why) => self.why.push(why.to_string()),
            }
            let (lo, hi) = self.made().bounds();
            match robust(&problem, &x, (&lo, &hi), task.step_mm, of, draws, method, desk) {
                Ok(robust) => self.robust = Some(robust),
                Err(why) => self.why.push(format!("no robust design: {why}")),
            }
            // Corners and draws that were not looked at are none at which the clutch is impossible.
            if desk.stopped() {
                (self.within, self.robust) = (None, None);
            }
        }
    }

    /// The search whose design is the answer: with flanks in place of a centroid that was free.
    pub fn made(&self) -> &Search {
        self.realised.as_ref().map_or(&self.found, |realised| &realised.made)
    }

    /// Whether the answer can be made: its centroid was never free, or there are flanks.
    pub fn makeable(&self) -> bool {
        !self.found.wants_centroid() || self.realised.is_some()
    }

    /// The answer in steps, where that was asked and found.
    pub fn on_grid(&self) -> Option<&OnGrid> {
        self.stepped.as_ref()?.found.as_ref().ok()
    }

    /// Values of the variables of [`Self::made`] that were searched.
    pub fn x(&self) -> &[f64] {
        self.on_grid().map_or(&self.made().outcome.x, |on_grid| &on_grid.x)
    }

    /// The answer's value of a variable of [`Self::made`].
    pub fn value(&self, of: &Variable) -> f64 {
        let at = self.made().searched.iter().position(|name| *name == of.name);
        at.map_or(of.best, |at| self.x()[at])
    }

    /// Margins of the answer, in full and at a tenth of the search's tolerance.
    pub fn margins(&self) -> &[Margin] {
        self.on_grid().map_or(&self.made().best, |on_grid| &on_grid.rows)
    }

    /// The same as the search had them.
    pub fn as_searched(&self) -> &[Margin] {
        self.on_grid().map_or(&self.made().as_searched, |on_grid| &on_grid.as_searched)
    }

    /// Margin of the given design for the same limit.
    pub fn before(&self, after: &Margin) -> Option<&Margin> {
        self.found.start.iter().find(|m| m.is_of(after))
    }

    /// The objective of the given design and of the answer, in its own unit.
    pub fn objective(&self) -> (f64, f64) {
        (self.found.objective.0, self.on_grid().map_or(self.made().objective.1, |on_grid| on_grid.objective))
    }

    /// Change of the objective when the answer is looked at in full at a tenth of the tolerance.
    pub fn objective_error(&self) -> f64 {
        self.on_grid().map_or(self.made().objective_error, |on_grid| on_grid.objective_error)
    }

    /// Whether the answer holds every limit with the reserve.
    pub fn feasible(&self) -> bool {
        self.not_held().is_empty()
    }

    /// Whether a margin is held with the reserve.
    pub fn held(&self, m: &Margin) -> bool {
        self.found.problem.held(m)
    }

    /// Codes of the margins that the answer does not hold.
    pub fn not_held(&self) -> Vec<String> {
        self.margins().iter().filter(|m| !self.held(m)).map(Margin::code).collect()
    }

    /// Whether the objective is better than that of the given design.
    pub fn improved(&self) -> bool {
        let (before, after) = self.objective();
        (after - before) * self.found.aim.sense() > 0.0
    }

    /// Design file of the answer.
    pub fn file(&self) -> &str {
        self.on_grid().map_or(&self.made().file, |on_grid| &on_grid.file)
    }

    /// Evaluations of the clutch: of the search, with flanks, in steps.
    pub fn evaluations(&self) -> usize {
        let flanks = self.realised.as_ref().map_or(0, |realised| 1 + realised.made.evaluations);
        self.found.evaluations + flanks + self.stepped.as_ref().map_or(0, |stepped| stepped.evaluations)
    }

    /// Derivatives along one variable, of the same.
    pub fn derivatives(&self) -> usize {
        let flanks = self.realised.as_ref().map_or(0, |realised| realised.made.derivatives);
        self.found.derivatives + flanks + self.stepped.as_ref().map_or(0, |stepped| stepped.derivatives)
    }

    /// The search that [`Self::status`] is of: the first that did not converge.
    pub fn last(&self) -> &Search {
        let first = self.found.outcome.status != Status::Converged;
        if first { &self.found } else { self.made() }
    }

    /// How it ended.
    pub fn status(&self) -> &Status {
        if self.stopped { &Status::Interrupted } else { &self.last().outcome.status }
    }

    /// Why the robust design that was asked for is not there; `None` where it is, or none was asked for.
    pub fn not_robust(&self) -> Option<&'static str> {
        match (&self.robust, self.wants_robust) {
            (_, false) => None,
            (None, true) => Some("no robust design found"),
            (Some(robust), true) => (!robust.made.held())
                .then_some("no design found that holds every limit at every corner of the tolerances"),
        }
    }

    /// How the search at the corners ended; where there was nothing to do, that of the optimum.
    pub fn robust_status<'s>(&'s self, robust: &'s RobustSearch) -> &'s Status {
        if robust.rounds == 0 { &self.made().outcome.status } else { &robust.status }
    }
}
