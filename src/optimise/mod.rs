//! A clutch as a vector: made better under limits and bounds, by SQP, from several starts, at corners, on fronts.
//!
//! In: a problem as [`Evaluate`] (margins at x, or a failure), a start and a box; or a `Design` with its task.
//! Out: [`Outcome`] of a climb; [`Search`], [`Front`], [`Robust`], [`Realised`], [`Stepped`], [`Relief`], [`Loosened`] of a design. Absent: files.
//! Equations: those of the methods, named in `sqp`, `swarm`, `pareto`, `robust`; none of the paper.

mod branch;
mod corner;
mod desk;
mod difference;
mod driver;
mod evaluate;
mod freed;
mod goal;
mod grid;
mod hessian;
mod influence;
mod journal;
mod near_corners;
mod noise;
mod outcome;
mod pareto;
mod poll;
mod price;
mod problem;
mod qp;
mod realise;
mod relief;
mod robust;
mod search;
mod settings;
mod side_by_side;
mod smooth;
mod space;
mod sqp;
mod starts;
mod step;
mod swarm;
mod view;

pub use branch::Branch;
pub use corner::{Corner, TOLERANCES, corners, half_ranges, perturbed};
pub use desk::{Desk, Forgetful, ProblemId, Record};
pub use driver::maximise_least_margin;
pub use evaluate::{Evaluate, Evaluation, EvaluationPart, NoEvaluation};
pub use freed::{Alone, Loosened, alone, loosened};
pub use goal::{Goal, Measure};
pub use grid::{OffGrid, OnGrid, Stepped, stepped};
pub use influence::{Influence, NO_INFLUENCE, influence};
pub use journal::{Entry, Journal, SearchRun, Watch};
pub use outcome::{Active, Cause, Iteration, Outcome, Refusal, Residuals, Status, TrialOutcome};
pub use pareto::{Front, FrontPoint, front};
pub use price::{Price, PriceKind};
pub use problem::{Assessment, ClutchProblem, Fidelity, Names};
pub use realise::{Nearest, Realised, is_centroid, realise};
pub use relief::{Freed, Relief, relief};
pub use robust::{Passed, Robust, RobustSearch, Spread, robust, spread};
pub use search::{NoSearch, Search, Variable, search, search_problem};
pub use settings::{Noise, Settings};
pub use starts::{ClimbRecord, Optima, SearchMethod};
pub use swarm::{Swarmed, swarm};
pub use view::Phase;
