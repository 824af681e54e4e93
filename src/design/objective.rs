//! What the optimiser can be asked: what is made better, by which variables.
//!
//! In: nothing. Out: [`Objective`], [`Optimize`]. Absent: how one is computed (`optimise`). Equations: none.

use super::Limits;
use schemars::JsonSchema;
use serde::Deserialize;

/// What is said of an objective.
struct Facts {
    name: &'static str,
    unit: &'static str,
    words: &'static str,
    sense: f64,
    gain: &'static str,
    span: f64,
}

/// Makes of each row a variant with its name in the file and what is said of it.
macro_rules! objectives {
    ($($(#[$doc:meta])+ $variant:ident: $name:tt, $unit:tt, $words:tt, $sense:expr, $gain:tt, $span:expr;)+) => {
        /// What is made better, every margin being a limit.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
        pub enum Objective {
            $($(#[$doc])+ #[serde(rename = $name)] $variant,)+
        }

        impl Objective {
            /// All of them, in the order of the file format.
            pub const ALL: [Self; [$($name),+].len()] = [$(Self::$variant),+];

            fn facts(self) -> Facts {
                match self {
                    $(Self::$variant => {
                        Facts { name: $name, unit: $unit, words: $words, sense: $sense, gain: $gain, span: $span }
                    })+
                }
            }
        }
    };
}

// Name, unit, words, +1 where more is better and -1 where less is, what a gain is one of, the span that weighs as a margin of 1.
objectives! {
    /// The smallest slip margin mu_s/mu_req - 1 over the scenarios is maximised.
    SlipMargin: "slip-margin", "", "least slip margin", 1.0, "slip margin", 1.0;
    /// The peak torque, with the nominal torque in proportion, up to which every static limit holds is maximised.
    TorqueCapacity: "torque-capacity", "Nm", "torque capacity", 1.0, "of torque capacity", 1.0;
    /// The largest Hertz pressure at peak torque is minimised; with along_mpa among the limits that along the contacts.
    PeakPressure: "peak-pressure", "MPa",
        "largest Hertz pressure at peak torque", -1.0, "less pressure", 1000.0;
    /// The windup at nominal torque is minimised.
    Windup: "windup", "deg", "windup at nominal torque", -1.0, "less windup", 1.0;
    /// The largest relative departure from a table of windups is minimised.
    StiffnessCurve: "stiffness-curve", "",
        "largest departure from the target windup", -1.0, "less departure from the target", 1.0;
    /// The smallest contact margin over the scenarios is maximised.
    ContactMargin: "contact-margin", "", "least contact margin of the scenarios", 1.0, "contact margin", 1.0;
    /// The speed of the race that the sprags ride with, up to which they keep contact in overrun, is maximised.
    KeepContact: "keep-contact", "rpm",
        "speed of the outer race, with [cage] of the inner one, up to which the sprags keep contact in overrun", 1.0, "more", 1000.0;
    /// That speed is minimised: the sprags lift off early.
    LiftOff: "lift-off", "rpm",
        "speed of the outer race, with [cage] of the inner one, at which the sprags lift off in overrun", -1.0, "less", 1000.0;
    /// The larger of the drag torques in overrun at rest and at the speed to which contact is to be kept is minimised.
    Drag: "drag", "Nm",
        "drag torque in overrun, the larger of slow and at the speed to which contact is kept", -1.0, "less drag", 0.1;
    /// The mass of sprags and races is minimised.
    Mass: "mass", "g", "mass of sprags and races", -1.0, "less mass", 100.0;
    /// The width of the races is minimised.
    Width: "width", "mm", "width of the races", -1.0, "less width", 10.0;
    /// The outer diameter is minimised.
    OutsideDiameter: "outside-diameter", "mm", "outer diameter", -1.0, "less diameter", 10.0;
}

impl Objective {
    /// Name in files and on the command line.
    pub fn name(self) -> &'static str {
        self.facts().name
    }

    /// Unit in which it is reported; empty for a pure number.
    pub fn unit(self) -> &'static str {
        self.facts().unit
    }

    /// In words.
    pub fn words(self) -> &'static str {
        self.facts().words
    }

    /// Whether it is taken over scenarios, so that it needs one.
    pub fn of_scenes(self) -> bool {
        matches!(self, Self::SlipMargin | Self::ContactMargin)
    }

    /// +1 where more is better, -1 where less is.
    pub fn sense(self) -> f64 {
        self.facts().sense
    }

    /// What a gain of it is one of, as said behind the number and the unit: "less pressure".
    pub fn gain(self) -> &'static str {
        self.facts().gain
    }

    /// A range of its unit that weighs as much as a margin of 1.
    pub fn span(self) -> f64 {
        self.facts().span
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
    /// What goes with it.
    pub links: Vec<Link>,
}

/// A number of the file that goes with a variable: value = by + times * (that of the variable), in the units of both names.
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    /// Dotted path of the number.
    pub path: String,
    /// What is added, in the number's unit.
    pub by: f64,
    /// What the variable is multiplied with.
    pub times: f64,
    /// Step to whose nearest multiple the number is rounded, in its unit; `None`: it is not.
    pub step: Option<f64>,
}

impl Link {
    /// The number where the variable has the value `variable`.
    pub fn value(&self, variable: f64) -> f64 {
        let exact = self.by + self.times * variable;
        self.step.map_or(exact, |step| multiple((exact / step).round(), step))
    }
}

/// `times` steps, to nine decimals: 835 of 0.005 are 4.175.
pub fn multiple(times: f64, step: f64) -> f64 {
    const DECIMALS: f64 = 1e9;
    (times * step * DECIMALS).round() / DECIMALS
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

impl Optimize {
    /// The first value of `x` beyond its bounds, in words; `None`: all lie within.
    pub fn outside(&self, x: &[f64]) -> Option<String> {
        let (i, (v, x)) =
            self.variables.iter().zip(x).enumerate().find(|(_, (v, x))| !(v.min..=v.max).contains(x))?;
        Some(format!("x[{i}], {} = {x}, lies outside its bounds {} to {}", v.name, v.min, v.max))
    }
}
