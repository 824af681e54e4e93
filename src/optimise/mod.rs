//! Maximising the least of several margins under limits and bounds, by SQP.
//!
//! In: a problem as [`Evaluate`] (margins at x, or a failure), a start and a box. Out: [`Outcome`], with a status,
//! multipliers, history and journal; [`Influence`], the derivative table. Absent: clutches, files, several starts.
//! Equations: those of the method, named in `sqp`; none of the paper.

mod difference;
mod driver;
mod evaluate;
mod hessian;
mod influence;
mod journal;
mod noise;
mod outcome;
mod poll;
mod problem;
mod qp;
mod search;
mod settings;
mod space;
mod sqp;
mod step;
mod view;

pub use driver::maximise_least_margin;
pub use evaluate::{Evaluate, Evaluation, Failure, Part};
pub use influence::{Influence, NO_INFLUENCE, influence};
pub use journal::{Entry, Journal, Run, Watch};
pub use outcome::{Active, Cause, Iteration, Outcome, Refusal, Residuals, Status, Tried};
pub use problem::{ClutchProblem, Names, finished_file};
pub use search::{NoSearch, Search, Variable, search};
pub use settings::{BadSetting, Noise, Settings};
pub use view::Phase;
