//! Why a fit came to no end.

use crate::numeric::setting::BadSetting;

/// Why nothing can be fitted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoFit {
    /// No unknown, or one twice.
    #[error("{0}")]
    Unknowns(String),
    /// An unknown that the design does not have, or bounds that are none.
    #[error("unknown {name:?}: {why}")]
    Unknown {
        /// Its name.
        name: String,
        /// What is wrong.
        why: String,
    },
    /// A setting out of its range.
    #[error("{0}")]
    Setting(BadSetting),
    /// No observation takes part in the fit.
    #[error("no row of the data is there for the fit")]
    NothingToFit,
    /// No design between the bounds answers every observation.
    #[error("none of {tried} designs between the bounds can be compared with every row of the fit; {why}")]
    Nowhere {
        /// Designs tried.
        tried: usize,
        /// The last reason and the label of its row.
        why: String,
    },
    /// Stopped from outside, with the best design met until then, if any.
    #[error("stopped")]
    Stopped(Option<SoFar>),
}

/// The best design of a search that was stopped.
#[derive(Debug, Clone, PartialEq)]
pub struct SoFar {
    /// Values of the unknowns, in their order and units.
    pub values: Vec<f64>,
    /// Sum of the squared scaled residuals there.
    pub sum: f64,
    /// Designs compared with every row of the fit until then.
    pub evaluations: usize,
    /// Text of the design file with these values.
    pub source: String,
}
