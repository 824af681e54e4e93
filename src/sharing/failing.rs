//! Sprags lost one after another: the most pressed one fails, the others take its share.

use super::{Asked, NotShared, Shared, Unlike};

/// The clutch after a loss.
#[derive(Debug, Clone, PartialEq)]
pub struct Loss {
    /// Number of the sprag that is lost.
    pub lost: usize,
    /// What the others carry then; why they do not.
    pub left: Result<Shared, NotShared>,
}

impl Unlike<'_> {
    /// At `torque_nm`, from `whole` on: the most pressed sprag is lost, and again, until those left do not carry the torque or one of
    /// them is pressed beyond `allowed_pa`. The last entry is that; empty: `whole` is beyond it already.
    pub fn losses(&self, whole: &Shared, allowed_pa: f64) -> Vec<Loss> {
        let mut left = self.clone();
        let mut now = whole.clone();
        let mut losses = Vec::new();
        while now.worst(|l| l.hertz_pa()).1 <= allowed_pa {
            let (lost, _) = now.worst(|l| l.hertz_pa());
            left = left.without(lost);
            let after = left.carrying(Asked::Torque(whole.torque_nm), whole.turned_rad);
            losses.push(Loss { lost, left: after.clone() });
            match after {
                Ok(after) => now = after,
                Err(_) => break,
            }
        }
        losses
    }
}
