//! Everything that was asked of one search, in order: the search, what would free it, flanks, front, tolerances.

use super::Ask;
use crate::design::Design;
use crate::optimise::{
    Alone, Desk, Fidelity, Front, Loosened, Method, NoSearch, Realised, Relief, Robust, RobustSearch, Search,
    Settings, Status, alone, front, loosened, realise, relief, robust, search, spread,
};
use crate::scenario;

/// Everything that was asked of one search; what a stop cuts off is left out.
#[derive(Debug, Clone)]
pub struct Story {
    /// The search.
    pub found: Search,
    /// Flanks for a centroid that was free.
    pub realised: Option<Realised>,
    /// What would free an infeasible problem.
    pub relief: Option<Relief>,
    /// Single numbers let go in an infeasible problem, the variables with them.
    pub loosened: Vec<Loosened>,
    /// What the limits that do not hold come to one by one.
    pub alone: Vec<Alone>,
    /// Front.
    pub front: Option<Front>,
    /// The optimum as it may be made.
    pub made: Option<Robust>,
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

/// Search, and whatever else `ask` wants of what is found.
pub(super) fn tell(design: &Design, ask: &Ask, desk: &Desk) -> Result<Story, NoSearch> {
    let task = design.optimize.as_ref().ok_or(NoSearch::NoTask)?;
    ask.validate(design)?;
    let (starts, most_starts) = ask.climbs();
    let climb = Settings { max_evaluations: ask.evaluations, ..Settings::default() };
    let method = Method { climb, starts, most_starts, swarm: ask.swarm, seed: task.seed };
    let settings = scenario::Settings { tolerance: ask.tolerance, ..Default::default() };
    let found = search(design, &method, Fidelity { settings, reduced: !ask.full }, desk)?;
    let mut story = Story {
        found,
        realised: None,
        relief: None,
        loosened: Vec::new(),
        alone: Vec::new(),
        front: None,
        made: None,
        robust: None,
        wants_robust: ask.robust,
        seed: task.seed,
        stopped: false,
        why: Vec::new(),
    };
    story.go_on(design, ask, &method, desk);
    story.stopped = desk.stopped();
    Ok(story)
}

impl Story {
    fn go_on(&mut self, design: &Design, ask: &Ask, method: &Method, desk: &Desk) {
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
        if !ask.front.is_empty() && !desk.stopped() {
            match front(&self.found, task, &ask.front, ask.front_steps, method, desk) {
                Ok(front) => self.front = Some(front),
                Err(why) => self.why.push(format!("no front: {why}")),
            }
        }
        if let (true, Some(of), false) = (ask.robust, &design.tolerances, desk.stopped()) {
            let (problem, x) = (&self.found.problem, &self.found.outcome.x);
            let draws = (ask.draws, method.seed);
            self.made =
                spread(problem, x, of, draws, desk).map_err(|why| self.why.push(why.to_string())).ok();
            let (lo, hi) = self.found.bounds();
            match robust(problem, x, (&lo, &hi), of, draws, method, desk) {
                Ok(robust) => self.robust = Some(robust),
                Err(why) => self.why.push(format!("no robust design: {why}")),
            }
            // Corners and draws that were not looked at are none at which the clutch is impossible.
            if desk.stopped() {
                (self.made, self.robust) = (None, None);
            }
        }
        if desk.stopped() {
            self.why.push("stopped; what was not reached is left out".to_owned());
        }
    }

    /// How it ended.
    pub fn status(&self) -> &Status {
        if self.stopped { &Status::Interrupted } else { &self.found.outcome.status }
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
        if robust.rounds == 0 { &self.found.outcome.status } else { &robust.status }
    }
}
