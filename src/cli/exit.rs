//! Exit codes, promised to scripts.

use crate::answer::Finding;
use crate::design::WhichScenario;
use crate::file::{DesignError, shown};
use crate::margin::NoMargins;
use serde_json::{Value, json};
use std::fmt::Display;
use std::path::Path;
use std::process::ExitCode;

/// How the program ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Exit {
    /// 0: done, and every margin asked about is held.
    Held,
    /// 1: done, and one margin is not held, or no feasible design was found.
    NotHeld,
    /// 2: the question was malformed: command line or design file.
    Malformed,
    /// 3: the answer could not be computed, written or printed.
    Failed,
    /// 130: stopped by Ctrl-C (128 + SIGINT); what had been found is written where a part of the answer is one.
    Interrupted,
    /// 141: whoever read the answers of `evaluate` has gone before the last (128 + SIGPIPE, which other programs die of).
    Unheard,
}

impl Exit {
    /// The number.
    pub fn code(self) -> u8 {
        match self {
            Self::Held => 0,
            Self::NotHeld => 1,
            Self::Malformed => 2,
            Self::Failed => 3,
            Self::Interrupted => 130,
            Self::Unheard => 141,
        }
    }
}

impl Exit {
    /// Of a verdict.
    pub fn of(held: bool) -> Self {
        if held { Self::Held } else { Self::NotHeld }
    }
}

impl From<Finding> for Exit {
    fn from(outcome: Finding) -> Self {
        match outcome {
            Finding::Held | Finding::Shown => Self::Held,
            Finding::NotHeld => Self::NotHeld,
            Finding::NotKnown => Self::Failed,
            Finding::Stopped => Self::Interrupted,
        }
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit.code())
    }
}

/// Why a command has no answer.
#[derive(Debug)]
pub enum Failure {
    /// The design file or a flag makes no sense; the report points at the place.
    Malformed(miette::Report),
    /// The design file is in order, but there is no clutch to answer for.
    NoClutch(String),
    /// Something outside failed: reading, writing, memory.
    Failed(String),
    /// Ctrl-C.
    Interrupted,
    /// Several, of one file each.
    Several(Vec<Failure>),
}

/// Messages are wrapped at blanks: a name with hyphens, which may be typed again, stays whole. To be called before the first.
pub fn keep_names_whole() {
    let handler = |_: &dyn miette::Diagnostic| -> Box<dyn miette::ReportHandler> {
        Box::new(
            miette::MietteHandlerOpts::new().word_splitter(textwrap::WordSplitter::NoHyphenation).build(),
        )
    };
    // Refused where a program that carries this one has a handler of its own.
    let _ = miette::set_hook(Box::new(move |of| handler(of)));
}

impl Failure {
    /// A malformed question in one sentence, without a place in a file; control characters in it are shown, not sent.
    pub fn malformed(message: impl AsRef<str>) -> Self {
        Self::Malformed(miette::Report::msg(shown(message.as_ref())))
    }

    /// As [`Self::malformed`], of a file.
    pub fn of(file: &Path, why: impl Display) -> Self {
        Self::malformed(format!("{}: {why}", file.display()))
    }

    /// It is not known which scenario is meant.
    pub fn which(file: &Path, why: WhichScenario) -> Self {
        match why {
            WhichScenario::Several { known } => {
                Self::of(file, format!("needed: --scenario NAME; the design has: {}", known.join(", ")))
            }
            why => Self::of(file, why),
        }
    }

    /// The refusal of a clutch that has no curve: file, reason, and the keys that decide it.
    pub fn no_clutch(file: &Path, why: &NoMargins) -> Self {
        Self::NoClutch(format!("{}: {why}; keys that decide it: {}", file.display(), why.keys()))
    }

    /// All of them as one; `None` of none.
    pub fn of_all(mut all: Vec<Self>) -> Option<Self> {
        if all.len() > 1 { Some(Self::Several(all)) } else { all.pop() }
    }

    /// For programs: `message`; of a refused design file also `file` and `problems`; of several, beside what the first has, all
    /// messages as lines and each whole in `errors`.
    pub fn to_json(&self) -> Value {
        if let Self::Several(all) = self {
            let each: Vec<Value> = all.iter().map(Self::to_json).collect();
            let messages: Vec<&str> = each.iter().filter_map(|error| error["message"].as_str()).collect();
            let mut error = each.first().cloned().unwrap_or_default();
            error["message"] = messages.join("\n").into();
            error["errors"] = each.into();
            return error;
        }
        let message = match self {
            Self::Malformed(report) => report.to_string(),
            Self::Failed(text) | Self::NoClutch(text) => text.clone(),
            Self::Interrupted | Self::Several(_) => "stopped".to_owned(),
        };
        let refused = match self {
            Self::Malformed(report) => report.downcast_ref::<DesignError>(),
            _ => None,
        };
        let mut error = refused.map_or_else(|| json!({}), DesignError::to_json);
        error["message"] = message.into();
        error
    }

    /// The code that goes with it, of several the largest.
    pub fn exit(&self) -> Exit {
        match self {
            Self::Several(all) => {
                let each = all.iter().map(Self::exit);
                each.max_by_key(|exit| exit.code()).unwrap_or(Exit::Failed)
            }
            Self::Malformed(_) | Self::NoClutch(_) => Exit::Malformed,
            Self::Failed(_) => Exit::Failed,
            Self::Interrupted => Exit::Interrupted,
        }
    }
}

impl From<DesignError> for Failure {
    fn from(refused: DesignError) -> Self {
        Self::Malformed(miette::Report::new(refused))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wedge::NoCurve;

    #[test]
    fn the_codes_are_those_promised() {
        let codes =
            [Exit::Held, Exit::NotHeld, Exit::Malformed, Exit::Failed, Exit::Interrupted, Exit::Unheard]
                .map(Exit::code);
        assert_eq!(codes, [0, 1, 2, 3, 130, 141]);
    }

    #[test]
    fn a_clutch_without_a_curve_is_told_with_file_and_keys() {
        let why = NoMargins::Curve(NoCurve::NoConvergence);
        let text = Failure::no_clutch(Path::new("a.toml"), &why).to_json()["message"].to_string();
        for word in ["a.toml", "did not converge", "contact, material", "sprags.inner_arcs"] {
            assert!(text.contains(word), "{text}");
        }
    }
}
