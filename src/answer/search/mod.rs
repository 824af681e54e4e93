//! What a search for a better design answers: the design found, its margins, how sure that is, and what else was asked of it.

mod body;
mod evaluator;
mod file;
mod made;
mod parts;
mod realised;
mod relief;
mod report;
mod so_far;
mod steps;
mod story;
mod tables;
mod words;

pub use body::{Climb, CodeChange, Found, FrontBody, OptimaBody, PriceBody, SearchBody, SearchRow, Slopes};
pub use evaluator::{EvaluatedLine, ProblemBody, VariableBody, describe_problem, evaluate_line};
pub use file::{NEAREST, NoFile, ROBUST, SearchFile};
pub use made::{CourseBody, MadeBody, MadeRow, NotHeldAt, RobustFound};
pub use parts::StoryPart;
pub use realised::{CodeMargin, Flanked, FlanksBody, SearchedOn};
pub use relief::{AloneBody, FreedBody, LoosenedBody, ReliefBody};
pub use report::{SearchReport, SearchReportBody};
pub use so_far::SearchSoFar;
pub use steps::{Bound, Steps};
pub use story::Story;
pub use words::Hints;

use super::left_out::{LeftOut, left_out_of};
use crate::design::{Design, Objective};
use crate::file::DesignError;
use crate::follow::Follow;
use crate::optimise::{Desk, Forgetful, NoSearch, Record, Settings};
use crate::scenario;
use serde::{Serialize, Serializer};

/// Climbs where their number is left open: with fewer than 8 even a single optimum met each time proves nothing.
pub const STARTS: usize = 8;
/// The same at most.
pub const MOST_STARTS: usize = 32;

/// How to search, and what else is asked. The default is what `optimize` does without flags.
#[derive(Debug, Clone)]
pub struct SearchSettings {
    /// Most evaluations of each climb; at least 1.
    pub evaluations: usize,
    /// Climbs; `None`: [`STARTS`], and more up to [`MOST_STARTS`] as long as the optima met let expect others.
    pub starts: Option<usize>,
    /// Evaluations of a particle swarm first; `None`: no swarm.
    pub swarm: Option<usize>,
    /// True error allowed of an evaluation in the search.
    pub tolerance: f64,
    /// Whether everything runs in the search too.
    pub full: bool,
    /// Two or three different objectives between which the front is sought; empty: no front.
    pub front: Vec<Objective>,
    /// Steps of the front between any two of its ends; at least 2.
    pub front_steps: usize,
    /// Whether margins are sought within the design's tolerances, and a design that holds them at every corner.
    pub robust: bool,
    /// Draws within the tolerances; at least 1.
    pub draws: usize,
    /// Step of the answer's lengths, mm, 0 to 1; 0: none; `None`: that of the file.
    pub step_mm: Option<f64>,
    /// What every limit keeps of its margin, 0 to 1; `None`: that of the file.
    pub reserve: Option<f64>,
    /// Ends the search; the best design so far is the answer.
    pub follow: Follow,
}

impl Default for SearchSettings {
    fn default() -> Self {
        Self {
            evaluations: Settings::default().max_evaluations,
            starts: None,
            swarm: None,
            tolerance: scenario::Settings::default().tolerance,
            full: false,
            front: Vec::new(),
            front_steps: 8,
            robust: false,
            draws: 200,
            step_mm: None,
            reserve: None,
            follow: Follow::default(),
        }
    }
}

impl SearchSettings {
    /// Climbs, and climbs at most.
    fn climbs(&self) -> (usize, usize) {
        self.starts.map_or((STARTS, MOST_STARTS), |n| (n, n))
    }

    /// Whether it can be asked of `design`.
    ///
    /// # Errors
    /// [`NoSearch::Asked`] with what is allowed.
    pub fn validate(&self, design: &Design) -> Result<(), NoSearch> {
        let twice = self.front.iter().enumerate().any(|(i, aim)| self.front[..i].contains(aim));
        let scenes = design.optimize.as_ref().is_none_or(|task| !task.scenarios.is_empty());
        let fault = if !scenes && self.front.iter().any(|aim| aim.of_scenes()) {
            "a front over a margin of scenarios needs scenarios in [optimize]"
        } else if !self.front.is_empty() && (twice || !(2..=3).contains(&self.front.len())) {
            "a front needs two or three different objectives"
        } else if !self.front.is_empty() && self.front_steps < 2 {
            "a front needs at least two steps between its ends"
        } else if self.robust && design.tolerances.is_none() {
            "a robust design needs a [tolerances] table: what the clutch is made to"
        } else if self.robust && self.draws == 0 {
            "at least one draw within the tolerances is needed"
        } else if self.step_mm.is_some_and(|step| !(0.0..=1.0).contains(&step)) {
            "the step of lengths must lie within 0 and 1 mm"
        } else if self.reserve.is_some_and(|share| !(0.0..=1.0).contains(&share)) {
            "the reserve on limits must lie within 0 and 1"
        } else if self.evaluations == 0 {
            "at least one evaluation is needed"
        } else if self.starts == Some(0) {
            "at least one start is needed"
        } else if !(1e-13..=1e-3).contains(&self.tolerance) {
            "the tolerance of an evaluation must lie within 1e-13 and 1e-3"
        } else {
            return Ok(());
        };
        Err(NoSearch::Asked(fault.to_owned()))
    }
}

/// What a search found.
#[derive(Debug, Clone)]
pub struct SearchAnswer {
    /// The search, and whatever else was asked.
    pub story: Story,
    /// What the model leaves out, each with its cost.
    pub left_out: Vec<LeftOut>,
    /// The figures by keys that `optimize --json` has too.
    pub body: SearchBody,
}

impl Serialize for SearchAnswer {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.body.serialize(serializer)
    }
}

impl SearchAnswer {
    /// The design found.
    ///
    /// # Errors
    /// As [`Design::parse`], where a history of the design has gone meanwhile.
    pub fn design(&self, given: &Design, name_for_errors: &str) -> Result<Design, DesignError> {
        Design::parse_in(&given.folder, self.story.file(), name_for_errors)
    }
}

impl Design {
    /// Search for a better design as the `[optimize]` table says. Nothing is written.
    ///
    /// # Errors
    /// [`NoSearch`]; not finding a feasible design is an answer.
    pub fn optimise(&self, settings: &SearchSettings) -> Result<SearchAnswer, NoSearch> {
        self.optimise_recorded(settings, &mut Forgetful)
    }

    /// The same with a record of every evaluation, which may know some from earlier.
    ///
    /// # Errors
    /// As [`Self::optimise`].
    pub fn optimise_recorded(
        &self,
        settings: &SearchSettings,
        record: &mut dyn Record,
    ) -> Result<SearchAnswer, NoSearch> {
        let desk = Desk::new(&settings.follow, record);
        // Within a pool each evaluation shares threads; a search begins with few of them to do.
        let (story, left_out) = rayon::join(|| story::run(self, settings, &desk), || left_out_of(self));
        let story = story?;
        let body = SearchBody::of(&story);
        Ok(SearchAnswer { story, left_out, body })
    }
}
