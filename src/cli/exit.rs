//! Exit codes, promised to scripts.

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
    /// 130: stopped by Ctrl-C (128 + SIGINT); what had been found is written.
    Interrupted,
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
    /// Something outside failed: reading, writing, memory.
    Failed(String),
    /// Ctrl-C.
    Interrupted,
}

impl Failure {
    /// A malformed question in one sentence, without a place in a file.
    pub fn malformed(message: impl Into<String>) -> Self {
        Self::Malformed(miette::Report::msg(message.into()))
    }

    /// The code that goes with it.
    pub fn exit(&self) -> Exit {
        match self {
            Self::Malformed(_) => Exit::Malformed,
            Self::Failed(_) => Exit::Failed,
            Self::Interrupted => Exit::Interrupted,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_codes_are_those_promised() {
        let codes =
            [Exit::Held, Exit::NotHeld, Exit::Malformed, Exit::Failed, Exit::Interrupted].map(Exit::code);
        assert_eq!(codes, [0, 1, 2, 3, 130]);
    }
}
