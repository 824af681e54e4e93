//! Why flanks do not close a profile, in numbers and in words.

use std::fmt;

/// The two flanks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FlankSide {
    /// Towards negative x: the outer contact travels this way in engagement.
    Rear,
    /// Towards positive x: the inner contact travels this way in engagement.
    Front,
}

/// Why flanks do not close a profile. Every half width is a distance from the middle of the strut line.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum OutlineError {
    /// The profile has no inner arc.
    #[error("the profile has no inner arc")]
    NoArcs,
    /// A half width is not a positive number.
    #[error("the {side} flank is {} mm from the strut line, not above 0", .given_m * 1e3)]
    NotPositive {
        /// The flank.
        side: FlankSide,
        /// Half width given, m.
        given_m: f64,
    },
    /// A flank leans by more than [`STEEPEST_RAD`](super::STEEPEST_RAD).
    #[error("the {side} flank leans by {tilt_rad} rad, more than {} rad either way", super::STEEPEST_RAD)]
    TooSteep {
        /// The flank.
        side: FlankSide,
        /// Lean given, rad.
        tilt_rad: f64,
    },
    /// The flank leaves the inner or the outer contact of first contact outside.
    #[error("the {side} flank, {:.4} mm from the strut line, leaves a contact outside; both need {:.4} mm",
        .given_m * 1e3, .needed_m * 1e3)]
    CutsContact {
        /// The flank.
        side: FlankSide,
        /// Half width given, m.
        given_m: f64,
        /// Half width above which both contacts lie inside, m.
        needed_m: f64,
    },
    /// The flank passes the inner arc, however far that is extended.
    #[error("the {side} flank, {:.4} mm from the strut line, passes the inner arc, which reaches {:.4} mm",
        .given_m * 1e3, .reach_m * 1e3)]
    MissesInner {
        /// The flank.
        side: FlankSide,
        /// Half width given, m.
        given_m: f64,
        /// Half width below which the flank meets the arc, m.
        reach_m: f64,
    },
    /// The flank passes the outer arc.
    #[error("the {side} flank, {:.4} mm from the strut line, passes the outer arc, which reaches {:.4} mm",
        .given_m * 1e3, .reach_m * 1e3)]
    MissesOuter {
        /// The flank.
        side: FlankSide,
        /// Half width given, m.
        given_m: f64,
        /// Half width below which the flank meets the arc, m.
        reach_m: f64,
    },
    /// The front flank cuts off the end of the inner arcs.
    #[error("the front flank, {:.4} mm from the strut line, cuts {lost_rad:.4} rad off the inner arcs; they \
             need {:.4} mm",
        .given_m * 1e3, .needed_m * 1e3)]
    CutsInner {
        /// Turn lost of the working profile, rad.
        lost_rad: f64,
        /// Front half width given, m.
        given_m: f64,
        /// Front half width up to which the working profile reaches, m.
        needed_m: f64,
    },
    /// The rear flank cuts off the end of the outer arc's contact range.
    #[error("the rear flank, {:.4} mm from the strut line, cuts {lost_rad:.4} rad off the outer arc's \
             contact range, \
             which needs {:.4} mm", .given_m * 1e3, .needed_m * 1e3)]
    CutsOuter {
        /// Contact range lost on the outer arc, rad.
        lost_rad: f64,
        /// Rear half width given, m.
        given_m: f64,
        /// Rear half width up to which the contact range reaches, m.
        needed_m: f64,
    },
    /// Inner and outer arc cross before the flank: it has no length.
    #[error("inner and outer arc cross {:.4} mm before they reach the {side} flank", .height_m.abs() * 1e3)]
    NoFlank {
        /// The flank.
        side: FlankSide,
        /// Height of the outer above the inner corner along the strut, m, not positive.
        height_m: f64,
    },
}

impl fmt::Display for FlankSide {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Rear => "rear",
            Self::Front => "front",
        })
    }
}
