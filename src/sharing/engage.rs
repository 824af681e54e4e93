//! An engagement: the torque rises, one sprag after another takes load.

use super::{Asked, NotShared, Shared, Unlike};

/// Parts of the torque at which an engagement is looked at.
const PARTS: [f64; 13] = [0.003, 0.01, 0.03, 0.06, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.85, 1.0];

impl Unlike<'_> {
    /// The sprags as the torque rises to `torque_nm`, the widest gap turned on by `turned_rad`.
    pub fn engagement(&self, torque_nm: f64, turned_rad: f64) -> Vec<(f64, Result<Shared, NotShared>)> {
        let at = |part: f64| (part * torque_nm, self.carrying(Asked::Torque(part * torque_nm), turned_rad));
        PARTS.into_iter().map(at).collect()
    }

    /// Torque, N m, at which each sprag takes load, 0 for the first; `None`: not before one comes to its end, or never.
    pub fn catches_nm(&self, turned_rad: f64) -> Vec<Option<f64>> {
        let first = self.lag_rad.iter().flatten().copied().fold(f64::INFINITY, f64::min);
        let one = |i: usize| {
            let lag = self.lag_rad[i]?;
            // Together with the first, to rounding.
            if lag - first <= 1e-12 {
                return Some(0.0);
            }
            self.carrying(Asked::Touch(i), turned_rad).ok().map(|found| found.torque_nm)
        };
        (0..self.sprags.len()).map(one).collect()
    }
}
