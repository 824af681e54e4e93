//! Why a fit came to no end.

use crate::numeric::setting::BadSetting;
use std::fmt;

/// Why nothing can be fitted.
#[derive(Debug, Clone, PartialEq)]
pub enum NoFit {
    /// No unknown, or one twice.
    Unknowns(String),
    /// An unknown that the design does not have, or bounds that are none.
    Unknown {
        /// Its name.
        name: String,
        /// What is wrong.
        why: String,
    },
    /// A setting out of its range.
    Setting(BadSetting),
    /// No observation takes part in the fit.
    NothingToFit,
    /// No design between the bounds answers every observation.
    Nowhere {
        /// Designs tried.
        tried: usize,
        /// The last reason and the label of its row.
        why: String,
    },
    /// Stopped from outside, with the best design met until then, if any.
    Stopped(Option<SoFar>),
}

/// The best design of a search that was stopped.
#[derive(Debug, Clone, PartialEq)]
pub struct SoFar {
    /// Values of the unknowns, in their order and units.
    pub values: Vec<f64>,
    /// Sum of the squared scaled residuals there.
    pub sum: f64,
    /// Designs held against every row of the fit until then.
    pub evaluations: usize,
    /// Text of the design file with these values.
    pub source: String,
}

impl fmt::Display for NoFit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknowns(why) => f.write_str(why),
            Self::Unknown { name, why } => write!(f, "unknown {name:?}: {why}"),
            Self::Setting(bad) => bad.fmt(f),
            Self::NothingToFit => f.write_str("no row of the data is there for the fit"),
            Self::Nowhere { tried, why } => write!(
                f,
                "none of {tried} designs between the bounds can be held against every row of the fit; {why}"
            ),
            Self::Stopped(_) => f.write_str("stopped"),
        }
    }
}

impl std::error::Error for NoFit {}
