//! The verdict: one rule, of all sprags as one and of each by itself.

use super::answer::Verdict;
use crate::clutch::Scenario;
use crate::dynamics::Stop;

/// Net slip beyond which a scene counts as slipped, m (INTERFACE: 1 um).
pub const SLIPPED_M: f64 = 1e-6;
/// Stretch without contact beyond which a scene counts as disengaged, s (INTERFACE: 1 ms).
const LOST_S: f64 = 1e-3;

/// What a verdict is of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Went {
    /// Why the run ended.
    pub stop: Stop,
    /// Longest stretch without contact, s.
    pub longest_open_s: f64,
    /// Whether a driven cage carries the sprag at the end.
    pub carried: bool,
    /// N_bi at the end, N.
    pub end_n: f64,
    /// Signed slip at A since the clutch engaged, positive towards overrunning, and the path that B slid with a driven cage, m.
    pub net_m: f64,
}

impl Went {
    /// The verdict where `net_m` is known to `error_m`; `None` where the run ended before it could be told. A sprag that touches without
    /// a force is open.
    pub fn verdict(&self, error_m: f64) -> Option<Verdict> {
        if self.stop == Stop::FellAway || self.longest_open_s > LOST_S {
            return Some(Verdict::Disengages);
        }
        if self.stop == Stop::CurveEnd {
            return Some(Verdict::Overloaded);
        }
        if self.stop != Stop::Finished {
            return None;
        }
        Some(if self.carried {
            Verdict::SlipsOverrunning
        } else if self.end_n <= 0.0 {
            Verdict::Disengages
        } else if (self.net_m.abs() - SLIPPED_M).abs() <= error_m {
            Verdict::AtThreshold
        } else if self.net_m > SLIPPED_M {
            Verdict::SlipsOverrunning
        } else if self.net_m < -SLIPPED_M {
            Verdict::SlipsEngaging
        } else {
            Verdict::Sticks
        })
    }
}

/// Path towards engaging of a slip of `path_m` in all and `net_m` net, m.
pub fn engaging_m(path_m: f64, net_m: f64) -> f64 {
    0.5 * (path_m - net_m)
}

impl Verdict {
    /// Whether the clutch does what `scenario` asks: hold, or let go where the torque turns round, without having slipped by more than
    /// [`SLIPPED_M`] towards engaging before, under a load that friction does not hold. Where a drivetrain makes it overrun nobody has
    /// said whether it is to.
    pub fn is_as_asked(self, scenario: &Scenario, slipped_engaging_m: f64) -> bool {
        match self {
            Self::Sticks => true,
            Self::SlipsOverrunning => scenario.lets_go() == Some(true) && slipped_engaging_m <= SLIPPED_M,
            _ => false,
        }
    }
}
