//! What decides a race space, or stands in its way.

use crate::margin::{Limit, Margin};
use std::fmt;

/// What decides a race space, or stands in its way.
#[derive(Debug, Clone, PartialEq)]
pub enum Decider {
    /// No limit is named.
    Nothing,
    /// The number of sprags is outside the family's.
    Count,
    /// The sprags would be wider than the width asked for.
    Width,
    /// The inner race would be too thin between the bore and the tracks asked for.
    Bore,
    /// The outer race would be too thin within the outside asked for.
    Outside,
    /// No flanks close the sprag's body.
    Flanks,
    /// No spring and front flank hold this limit of overrun.
    Spring(&'static Limit),
    /// The row with the least margin: its limit, its code.
    Row(&'static Limit, String),
    /// The design file would be refused: key, what is allowed.
    Refused {
        /// Key.
        key: String,
        /// What is allowed.
        allowed: String,
    },
    /// Anything else, in words.
    Words(String),
}

impl Decider {
    /// A row.
    pub(super) fn row(row: &Margin) -> Self {
        Self::Row(row.limit, row.code())
    }

    /// The limit that it is about.
    pub fn limit(&self) -> Option<&'static Limit> {
        match self {
            Self::Spring(limit) | Self::Row(limit, _) => Some(limit),
            _ => None,
        }
    }

    /// In the words of an error.
    pub(super) fn words(why: impl fmt::Display) -> Self {
        Self::Words(why.to_string())
    }
}

/// The code for tables.
impl fmt::Display for Decider {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Nothing => "no limit",
            Self::Count => "count",
            Self::Width => "width",
            Self::Bore => "bore",
            Self::Outside => "outside",
            Self::Flanks => "flanks",
            Self::Spring(limit) => limit.code,
            Self::Row(_, code) => code,
            Self::Refused { key, allowed } => return write!(f, "{key}: {allowed}"),
            Self::Words(words) => words,
        })
    }
}
