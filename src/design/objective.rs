//! What the optimiser can be asked: what is made better, by which variables.
//!
//! In: nothing. Out: [`Objective`], [`Optimize`]. Absent: how one is computed (`optimise`). Equations: none.

use super::Limits;
use schemars::JsonSchema;
use serde::Deserialize;

/// What is made better, every margin being a limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Objective {
    /// The smallest slip margin mu_s/mu_req - 1 over the scenarios is maximised.
    SlipMargin,
    /// The peak torque, with the nominal torque in proportion, up to which every static limit holds is maximised.
    TorqueCapacity,
    /// The largest Hertz pressure at peak torque is minimised.
    PeakPressure,
    /// The windup at nominal torque is minimised.
    Windup,
    /// The largest relative departure from a table of windups is minimised.
    StiffnessCurve,
}

impl Objective {
    /// All of them, in the order of the file format.
    pub const ALL: [Self; 5] =
        [Self::SlipMargin, Self::TorqueCapacity, Self::PeakPressure, Self::Windup, Self::StiffnessCurve];

    /// Name in files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::SlipMargin => "slip-margin",
            Self::TorqueCapacity => "torque-capacity",
            Self::PeakPressure => "peak-pressure",
            Self::Windup => "windup",
            Self::StiffnessCurve => "stiffness-curve",
        }
    }

    /// Unit in which it is reported; empty for a pure number.
    pub fn unit(self) -> &'static str {
        match self {
            Self::SlipMargin | Self::StiffnessCurve => "",
            Self::TorqueCapacity => "Nm",
            Self::PeakPressure => "MPa",
            Self::Windup => "deg",
        }
    }

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::SlipMargin => "least slip margin",
            Self::TorqueCapacity => "torque capacity",
            Self::PeakPressure => "largest Hertz pressure at peak torque",
            Self::Windup => "windup at nominal torque",
            Self::StiffnessCurve => "largest departure from the target windup",
        }
    }

    /// +1 where more is better, -1 where less is.
    pub fn sense(self) -> f64 {
        match self {
            Self::SlipMargin | Self::TorqueCapacity => 1.0,
            Self::PeakPressure | Self::Windup | Self::StiffnessCurve => -1.0,
        }
    }
}

impl std::fmt::Display for Objective {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

impl std::str::FromStr for Objective {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let names = || Self::ALL.map(Self::name).join(", ");
        Self::ALL
            .into_iter()
            .find(|o| o.name() == text)
            .ok_or_else(|| format!("one of {} is needed", names()))
    }
}

/// One variable of the optimiser, in the unit of its name.
#[derive(Debug, Clone, PartialEq)]
pub struct OptimizeVariable {
    /// Name as in the file, e.g. `r_i2_mm`.
    pub name: String,
    /// Lower bound in the name's unit.
    pub min: f64,
    /// Upper bound in the name's unit.
    pub max: f64,
    /// Value in the file, in the name's unit.
    pub given: f64,
    /// Where the search starts: the value in the file, or the bound nearest to it where it lies outside.
    pub start: f64,
    /// Whether it takes whole numbers only.
    pub whole: bool,
}

/// What `optimize` shall do.
#[derive(Debug, Clone, PartialEq)]
pub struct Optimize {
    /// What is made better.
    pub objective: Objective,
    /// Wanted windups of [`Objective::StiffnessCurve`]: (torque, N m; windup, rad).
    pub target: Vec<[f64; 2]>,
    /// Scenarios whose smallest slip margin is maximised, or which are limits of another objective.
    pub scenarios: Vec<String>,
    /// Design variables.
    pub variables: Vec<OptimizeVariable>,
    /// `[limits]` with the sharper ones of `[optimize]` put in.
    pub limits: Limits,
    /// Step in which lengths can be made, mm; 0: any.
    pub step_mm: f64,
    /// What every margin keeps beyond its limit.
    pub reserve: f64,
    /// Seed of everything random.
    pub seed: u64,
}

/// An objective as written: without a doc comment per variant, which the schema's reader does not know.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(super) enum ObjectiveFile {
    SlipMargin,
    TorqueCapacity,
    PeakPressure,
    Windup,
    StiffnessCurve,
}

impl From<ObjectiveFile> for Objective {
    fn from(written: ObjectiveFile) -> Self {
        match written {
            ObjectiveFile::SlipMargin => Self::SlipMargin,
            ObjectiveFile::TorqueCapacity => Self::TorqueCapacity,
            ObjectiveFile::PeakPressure => Self::PeakPressure,
            ObjectiveFile::Windup => Self::Windup,
            ObjectiveFile::StiffnessCurve => Self::StiffnessCurve,
        }
    }
}
